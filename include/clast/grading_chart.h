#pragma once
#include <clast/grading.h>

CLAST_BEGIN

/// Draws mass (and, where the table has it, number) passing over size, wanted and achieved, into a
/// .svg, .pdf or .png.
///
/// @param classes  of clast_grading_compare
CLAST_API clast_status clast_grading_chart_write(const clast_table *classes, const char *path);

CLAST_END
