#pragma once
// Shapes that a configuration gives by a word instead of a file.
#include <clast/shape.h>

/// Whether the text begins as "ellipsoid:".
bool clx_is_ellipsoid_word(const char *text);

/// "ellipsoid:a,b,c" with full axes, any unit.
clast_status clx_ellipsoid_word(const char *text, const char *name, clast_shape *shape);
