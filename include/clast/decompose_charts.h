#pragma once
#include <clast/decompose.h>

CLAST_BEGIN

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
CLAST_API clast_status clast_decompose_chart_write(clast_decompose_chart chart,
                                                   const clast_cloud *cloud,
                                                   const clast_decomposition *result,
                                                   const char *path);

CLAST_END
