#pragma once
#include <clast/pairs.h>

CLAST_BEGIN

/// Draws g over r (logarithmic) with its 95 % band and the line of a uniform cloud, as .svg, .pdf
/// or .png. Shells without an expected pair are left out.
///
/// @return CLAST_E_USAGE without any shell to draw
CLAST_API clast_status clast_pairs_chart_write(const clast_pairs *pairs, const char *path);

CLAST_END
