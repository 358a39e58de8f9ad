#pragma once
#include <clast/status.h>

CLAST_BEGIN

// Charts from one drawing code to SVG, PDF and PNG: axes, lines, steps, scatter, bars, bands, error
// bars, heat maps.

typedef enum {
    CLAST_SERIES_LINE,
    CLAST_SERIES_STEP,   ///< constant from x[i] to x[i+1]
    CLAST_SERIES_POINTS, ///< with vertical error bars where low and high are given
    CLAST_SERIES_BAND,   ///< filled between low and high
    CLAST_SERIES_BARS    ///< bar i spans x[i] to x[i+1] (x has n + 1 values), height y[i]
} clast_series_kind;

/// One set of values; arrays are borrowed. NaN points are left out (a line breaks there).
typedef struct clast_series {
    clast_series_kind kind;
    const char *label; ///< legend entry, or NULL for none
    const double *x, *y;
    const double *low, *high; ///< band or error bars, else NULL
    const double *value;      ///< points coloured by this (with chart.value_axis), else NULL
    int64_t n;
    int32_t colour; ///< 0..7 of the colour-blind-safe set (Okabe and Ito); -1: grey
    bool dashed;
} clast_series;

typedef struct clast_axis {
    const char *label; ///< with its unit: "porosity (-)"
    bool log;
    double low, high; ///< both 0: from the data
} clast_axis;

/// A rectangle of values for a heat map, row-major from low y; borrowed.
typedef struct clast_heat {
    int32_t n_x, n_y;
    const double *value; ///< [n_y][n_x], NaN is left blank
    double x_low, x_high, y_low, y_high;
    const char *const *x_name; ///< [n_x] names of columns in place of ticks, or NULL
    const char *const *y_name; ///< [n_y] names of rows
    bool is_signed;            ///< blue below 0, white at 0, red above: for a symmetric value axis
    bool has_text;             ///< writes each value into its cell
} clast_heat;

/// A word in the plot, centred at a place of the axes.
typedef struct clast_note {
    double x, y;
    const char *text;
} clast_note;

typedef struct clast_chart {
    const char *title; ///< or NULL
    clast_axis x, y;
    clast_axis value_axis; ///< colour bar of a heat map or of coloured points; label NULL for none
    const clast_series *series;
    int32_t n_series;
    const clast_heat *heat; ///< or NULL
    const double *mark_y;   ///< horizontal reference lines, with labels
    const char *const *mark_label;
    int32_t n_mark;
    const clast_note *note;
    int32_t n_note;
    bool equal;           ///< one unit of x is as long as one unit of y
    double width, height; ///< points (1/72 inch); 0: 480 x 340
} clast_chart;

/// Draws the chart into a file: .svg, .pdf or .png (PNG at twice the resolution), atomically.
///
/// @return CLAST_E_USAGE for another extension or an axis without any finite value; CLAST_E_DISK if
/// unwritable
CLAST_API clast_status clast_chart_write(const clast_chart *chart, const char *path);

/// The same in memory as SVG text, for a page; the caller frees *bytes with clast_bytes_free.
CLAST_API clast_status clast_chart_svg(const clast_chart *chart, unsigned char **bytes, size_t *n);
CLAST_API void clast_bytes_free(unsigned char *bytes);

CLAST_END
