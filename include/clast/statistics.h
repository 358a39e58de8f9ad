#pragma once
#include <clast/form.h>

CLAST_BEGIN

// Statistics of samples and of a table's columns: summaries with bootstrap intervals, normality,
// histograms, correlation and principal components.            [docs/theory/statistics.md]

/// Shapiro and Wilk's W of a sample and the probability of a smaller W under a normal law.
///
/// W = (sum a_i x_(i))^2 / sum (x_i - mean)^2, weights a and the normalising transformation of W by
/// Royston's algorithm AS R94.                                             [Royston1992;
/// Royston1995]
///
/// @param x  [n] finite, any order
/// @param p  Royston fitted it for n <= 5000; beyond it is extrapolated
/// @return CLAST_E_FORMAT for fewer than 3 values, a constant sample or values that are not finite
CLAST_API clast_status clast_shapiro_wilk(const double *x, int64_t n, double *w, double *p);

/// How intervals are made: percentiles of statistics of n_resample samples drawn with replacement.
/// [Efron1993 ch. 13]
struct clast_bootstrap {
    int32_t n_resample; ///< 0: no intervals
    double level;       ///< above 0 and below 1; 0.95: from the 2.5 % to the 97.5 % quantile
    uint64_t seed;      ///< resample b is a function of (seed, b) alone
};

CLAST_API clast_bootstrap clast_bootstrap_default(void); ///< 2000 resamples, 0.95, seed 1

enum { CLAST_N_QUANTILE = 7 };

/// Shares of the quantiles in a summary: 0.05, 0.10, 0.25, 0.50, 0.75, 0.90, 0.95.
CLAST_API double clast_quantile_share(int32_t k);

/// What one column is like. What a sample is too small for is NaN (the word nan
/// in CSV, null in JSON).
typedef struct clast_sample_summary {
    int64_t n;          ///< finite values
    int64_t n_left_out; ///< values that were not finite
    double mean;
    double deviation;          ///< divisor n - 1
    double deviation_ml;       ///< divisor n: of the fitted normal
    double skewness, kurtosis; ///< m3 / m2^1.5 and m4 / m2^2 - 3
    double low, high;
    double quantile[CLAST_N_QUANTILE]; ///< linear between order statistics
    double mean_low, mean_high;        ///< bootstrap interval
    double deviation_low, deviation_high;
    double shapiro_w, shapiro_p;
    bool is_constant;
} clast_sample_summary;

/// Columns against columns, and the axes along which they vary.
typedef struct clast_statistics {
    int32_t n;                     ///< columns
    char **name;                   ///< [n] owned
    clast_sample_summary *summary; ///< [n]
    double *r;   ///< [n][n] Pearson, over the rows where both are finite; NaN for constant columns
    double *r_p; ///< [n][n] two-sided p of r = 0
    int32_t n_pca; ///< columns in the principal components: neither constant nor with gaps; 0 where
                   ///< only one is so
    int32_t *pca_column; ///< [n_pca]
    double *variance;    ///< [n_pca] eigenvalues of their correlation matrix, falling
    double *explained;   ///< [n_pca] cumulative share of the variance
    double *loading; ///< [n_pca][n_pca] row k: unit vector of component k, largest entry positive
} clast_statistics;

/// Statistics of every number column of a table. Values that are not finite are left out of their
/// column's summary and of their pairs.
///
/// @param bootstrap  NULL: the default
/// @return CLAST_E_FORMAT for a table without number columns or rows; CLAST_E_ARGUMENT for a level
/// or a number of resamples that cannot be; CLAST_E_MEMORY
/// @note O(resamples rows columns); the same bytes for any thread count
CLAST_API clast_status clast_statistics_of(const clast_table *table,
                                           const clast_bootstrap *bootstrap,
                                           clast_statistics *statistics);
CLAST_API void clast_statistics_free(clast_statistics *statistics);

/// Takes the principal components of the first n_column columns alone (form factors without sizes).
/// CLAST_E_ARGUMENT for n_column below 0.
CLAST_API clast_status clast_statistics_limit_pca(clast_statistics *statistics, int32_t n_column);

/// One row a column: column, n, mean, mean_low, mean_high, deviation, ... shapiro_w, shapiro_p.
CLAST_API clast_status clast_statistics_summary_table(const clast_statistics *statistics,
                                                      clast_table *table);

/// One row a pair of columns: a, b, r, p.
CLAST_API clast_status clast_statistics_correlation_table(const clast_statistics *statistics,
                                                          clast_table *table);

/// One row a component: component, variance, share, explained, then a loading per column.
CLAST_API clast_status clast_statistics_pca_table(const clast_statistics *statistics,
                                                  clast_table *table);

/// Components needed to explain this share of the variance; 0 without components, or of NaN.
CLAST_API int32_t clast_statistics_n_component(const clast_statistics *statistics, double share);

/// Counts of a sample in equal bins, with the normal law of maximum likelihood beside them.
typedef struct clast_histogram {
    int32_t n_bin;
    double *edge;    ///< [n_bin + 1]
    int64_t *count;  ///< [n_bin]
    double *density; ///< [n_bin] count / (n width)
    double mean, deviation_ml;
} clast_histogram;

/// Bins of width 2 IQR n^(-1/3) [Freedman1981], rounded to the nearest of 1, 2 or 5 times a power
/// of ten, with edges at its multiples; at most 200. A sample that is constant, or so nearly that
/// doubles have no edges between, gets one bin. Values that are not finite are left out.
///
/// @return CLAST_E_FORMAT without a finite value, or where mean, deviation or range are beyond what
/// a double holds; CLAST_E_MEMORY
CLAST_API clast_status clast_histogram_of(const double *x, int64_t n, clast_histogram *histogram);
CLAST_API void clast_histogram_free(clast_histogram *histogram);

/// Columns low, high, count, density, normal (mean density of the fitted normal over the bin).
CLAST_API clast_status clast_histogram_table(const clast_histogram *histogram, const char *name,
                                             clast_table *table);

// The statistics of a set of grains as one step: tables and charts into a folder.

typedef struct clast_grain_statistics {
    clast_form_set set;
    clast_statistics statistics;  ///< of the 13 form factors and the size
    int64_t zingg[CLAST_N_ZINGG]; ///< grains in each class
} clast_grain_statistics;

/// Statistics of the grains of a table (columns as clast_form_set_of takes them).
///
/// @param columns    NULL: known by their names
/// @param bootstrap  NULL: the default
CLAST_API clast_status clast_grain_statistics_of(const clast_table *table, const char *columns,
                                                 const clast_bootstrap *bootstrap,
                                                 clast_grain_statistics *statistics);
CLAST_API void clast_grain_statistics_free(clast_grain_statistics *statistics);

/// Writes into an existing folder: factors.csv, statistics.csv, correlation.csv, pca.csv,
/// left_out.csv (if any), histogram_<column>.csv, and as charts zingg, histogram_flatness,
/// histogram_elongation, histogram_size, correlation and pca in the format of `extension` ("svg",
/// "pdf", "png").
///
/// Of libclast_view.
/// @return CLAST_E_DISK; CLAST_E_USAGE for another extension
CLAST_API clast_status clast_grain_statistics_write(const clast_grain_statistics *statistics,
                                                    const char *folder, const char *extension);

CLAST_END
