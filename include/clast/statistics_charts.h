#pragma once
#include <clast/form_set.h>
#include <clast/porosity_fit.h>
#include <clast/statistics.h>

CLAST_BEGIN

// Charts of a set of grains in the style of Rettinger et al. 2022, Fig. 2 and 3, and of a fitted
// model in that of their Fig. 8 and 9. The path's extension (.svg, .pdf, .png) is the format.

/// Zingg diagram: elongation over flatness, with the class borders at 2/3, coloured by size if the
/// set has sizes (log colour where they span more than a factor 5).
CLAST_API clast_status clast_chart_zingg(const clast_form_set *set, const char *path);

/// Histogram of one column as a density, with the normal law of maximum likelihood and, in the
/// legend, its mean and deviation; the title holds Shapiro and Wilk's W and p.
CLAST_API clast_status clast_chart_histogram(const double *x, int64_t n, const char *label,
                                             const char *path);

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
