#pragma once
// cairo gives its splines, which call a function by the type of three arguments, functions of two.
// Included into the sources of paths that do.

/// Declares LINE_TO and makes spline_LINE_TO of it, of the type that a spline calls.
#define SPLINE_POINT(line_to)                                                                      \
    static cairo_status_t line_to(void *closure, const cairo_point_t *point);                      \
    static cairo_status_t spline_##line_to(void *closure, const cairo_point_t *point,              \
                                           const cairo_slope_t *tangent)                           \
    {                                                                                              \
        return line_to(closure, point);                                                            \
    }
