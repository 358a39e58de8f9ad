#pragma once
#include <clast/decompose.h>
#include <clast/form.h>
#include <clast/pairs.h>
#include <clast/porosity.h>
#include <clast/porosity_model.h>
#include <clast/statistics.h>
#include <clast/status.h>

CLAST_BEGIN

// Charts from one drawing code to SVG, PDF and PNG: axes, lines, steps, scatter, bars, bands, error
// bars, heat maps. Of libclast_view.

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
    const double *low,
        *high;           ///< band or error bars, else NULL; a bar of one finite end is an arrow
    const double *value; ///< points coloured by this (with chart.value_axis), else NULL
    int64_t n;
    int32_t colour; ///< 0..7 of the colour-blind-safe set (Okabe and Ito); -1: grey
    bool dashed;
    double width; ///< of a line, points; 0: 1.6
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

/// A word in the plot, centred at a point of the axes.
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

/// The same in memory as SVG text, for a page; the caller frees *bytes with clast_chart_bytes_free.
CLAST_API clast_status clast_chart_svg(const clast_chart *chart, unsigned char **bytes, size_t *n);
CLAST_API void clast_chart_bytes_free(unsigned char *bytes);

// Charts of an aggregation from its tables, as files or as SVG in memory.

/// What to draw, from which table.
typedef enum {
    CLAST_AGGREGATE_CHART_POROSITY, ///< history: every porosity_* column over n
    CLAST_AGGREGATE_CHART_DIAMETER, ///< history: d_agg_m over n
    CLAST_AGGREGATE_CHART_DENSITY,  ///< history: density_kg/m^3 over n
    CLAST_AGGREGATE_CHART_SIZES,    ///< history: distribution of size_m, beside the wanted one
    CLAST_AGGREGATE_CHART_RADIAL,   ///< radial: solid_fraction over radius_low_m
                                    ///< (clast_assembly_radial_profile)
    CLAST_N_AGGREGATE_CHART
} clast_aggregate_chart;

/// File name without extension ("history", "diameter", ...).
CLAST_API const char *clast_aggregate_chart_name(clast_aggregate_chart chart);

/// True when the table has the columns and rows that the chart needs.
CLAST_API bool clast_aggregate_chart_fits(clast_aggregate_chart chart, const clast_table *table);

/// Draws one chart into a file: .svg, .pdf or .png.
///
/// History rows of equal n (repeats) become their mean and a band of one sample standard deviation
/// to either side. Rows that are not finite are left out. Lines of more than 600 points are thinned
/// evenly, first and last kept.
///
/// @param table   history of clast_aggregate_history (column repeat is optional), or radial
/// @param wanted  SIZES only, may be NULL: columns low_m, high_m and count or wanted; else NULL
/// @return CLAST_E_FORMAT when the table does not fit
CLAST_API clast_status clast_aggregate_chart_write(clast_aggregate_chart chart,
                                                   const clast_table *table,
                                                   const clast_table *wanted, const char *path);

/// The same as SVG text; free *bytes with clast_chart_bytes_free.
CLAST_API clast_status clast_aggregate_chart_svg(clast_aggregate_chart chart,
                                                 const clast_table *table,
                                                 const clast_table *wanted, unsigned char **bytes,
                                                 size_t *n);

/// All charts that fit as FOLDER/NAME.svg: history.svg, diameter.svg, density.svg, sizes.svg.
CLAST_API clast_status clast_aggregate_charts_write(const clast_table *history,
                                                    const clast_table *wanted, const char *folder);

// Charts of a decomposition, as in the published figures.

typedef enum {
    CLAST_DECOMPOSE_CHART_POINTS, ///< points by label or, without, by density of their cell, edges
                                  ///< of cells (3-D: seen along the last axis, points alone)
    CLAST_DECOMPOSE_CHART_CDF,    ///< distribution of the bins' densities, thresholds chosen
    CLAST_DECOMPOSE_CHART_SCORE,  ///< expected score over the ideal one for each threshold
    CLAST_DECOMPOSE_CHART_EVENTS, ///< events of each cell over its count
    CLAST_N_DECOMPOSE_CHART
} clast_decompose_chart;

/// File name without extension: "points", "density", "score", "events" ("pair_integral" of a result
/// without beta dt; NULL: of any).
CLAST_API const char *clast_decompose_chart_name(clast_decompose_chart chart,
                                                 const clast_decomposition *result);

/// True when there is something to draw: no thresholds and no bins in one cell or a tree.
CLAST_API bool clast_decompose_chart_fits(clast_decompose_chart chart,
                                          const clast_decomposition *result);

/// Draws one chart as .svg, .pdf or .png. Of more than 20000 points every k-th is drawn.
///
/// @param cloud  whose decomposition it is; one rank's part does but for
/// CLAST_DECOMPOSE_CHART_POINTS
CLAST_API clast_status clast_decompose_chart_write(clast_decompose_chart chart,
                                                   const clast_cloud *cloud,
                                                   const clast_decomposition *result,
                                                   const char *path);

/// Draws mass (and, where the table has it, number) passing over size, wanted and achieved, into a
/// .svg, .pdf or .png.
///
/// @param classes  of clast_grading_compare
CLAST_API clast_status clast_chart_grading(const clast_table *classes, const char *path);

/// Draws g over r (logarithmic) with its 95 % band and the line of a uniform cloud, as .svg, .pdf
/// or .png. Shells without an expected pair are left out.
///
/// @return CLAST_E_USAGE without any shell to draw
CLAST_API clast_status clast_chart_pairs(const clast_pairs *pairs, const char *path);

/// Draws porosity over height with the evaluated interval and the bulk value, as Fig. 7 of the
/// paper, into a .svg, .pdf or .png.
///
/// @param unit  of the heights, for the axis: "m" is drawn in mm
CLAST_API clast_status clast_chart_porosity(const clast_table *profile,
                                            const clast_porosity_bulk *bulk, const char *unit,
                                            const char *path);

/// Draws porosity over the distance from a cylinder's axis, with error bars.
CLAST_API clast_status clast_chart_radial(const clast_table *radial, const char *unit,
                                          const char *path);

/// Draws the share of pore space nearer than delta to a grain.
CLAST_API clast_status clast_chart_pores(const clast_table *pores, const char *unit,
                                         const char *path);

/// Mean profile over height or radius of several runs with its interval, of
/// clast_porosity_mean_profile.
CLAST_API clast_status clast_chart_porosity_band(const clast_table *band, const char *unit,
                                                 const char *path);

/// Normal stresses over height, of clast_stress_profile.
CLAST_API clast_status clast_chart_stress(const clast_table *profile, const char *unit,
                                          const char *path);

/// Force chains of clast_bed_chains seen along y: lines as thick as their force, in four steps of
/// the mean; contacts that are no link of a chain are grey.
///
/// @param unit  of the positions; "m" is drawn in mm
CLAST_API clast_status clast_chart_chains(const clast_table *chains, const char *unit,
                                          const char *path);

// Charts of a set of grains in the style of Rettinger et al. 2022, Fig. 2 and 3, and of a fitted
// model in that of their Fig. 8 and 9. The path's extension (.svg, .pdf, .png) is the format.

/// Zingg diagram: elongation over flatness, with the class borders at 2/3, coloured by size if the
/// set has sizes (log colour where they span more than a factor 5).
CLAST_API clast_status clast_chart_zingg(const clast_form_set *set, const char *path);

/// Histogram of one column as a density, with the normal law of maximum likelihood and, in the
/// legend, its mean and deviation; the title holds Shapiro and Wilk's W and p.
///
/// @param unit  of x, "-", "mm"; of metres a smaller one is drawn; "": model units
CLAST_API clast_status clast_chart_histogram(const double *x, int64_t n, const char *label,
                                             const char *unit, const char *path);

/// Correlation matrix as a heat map; form factors go by their symbols.
CLAST_API clast_status clast_chart_correlation(const clast_statistics *statistics,
                                               const char *path);

/// Share of the variance that each principal component explains, and the running sum.
CLAST_API clast_status clast_chart_pca(const clast_statistics *statistics, const char *path);

typedef enum {
    CLAST_FIT_CHART_FEATURE,   ///< porosity over the first feature, with its own line (Fig. 8)
    CLAST_FIT_CHART_PREDICTED, ///< fitted and held-out over measured porosity (Fig. 9)
    CLAST_FIT_CHART_RESIDUALS, ///< studentised residuals over fitted porosity
    CLAST_FIT_CHART_LEVERAGE,  ///< studentised residuals over leverage
    CLAST_N_FIT_CHART
} clast_fit_chart;

/// "feature", "predicted", "residuals", "leverage".
CLAST_API const char *clast_fit_chart_name(clast_fit_chart chart);
CLAST_API clast_status clast_chart_fit(clast_fit_chart chart, const clast_fit_data *data,
                                       const clast_porosity_fit *fit, const char *path);

CLAST_END
