#pragma once
// Linear least squares y = X b with what a regression report needs, by the singular values of X.
#include "base/status.h"

/// What is to be fitted: y = X b. Borrowed.
typedef struct clx_regression {
    const double *x; ///< [n][p] finite
    const double *y; ///< [n]
    int64_t n;
    int32_t p;
} clx_regression;

typedef struct clx_least_squares {
    int64_t n;          ///< rows
    int32_t p;          ///< columns of X, the constant one among them
    double *b;          ///< [p] coefficients
    double *covariance; ///< [p][p] of b: s^2 (X'X)^-1
    double *fitted;     ///< [n]
    double *leverage;   ///< [n] diagonal of X (X'X)^-1 X'
    double variance;    ///< s^2 = sum of squared residuals / (n - p); 0 for n = p
    double r2;          ///< 1 - residual / total squares about the mean of y
    double condition;   ///< greatest / least singular value of X with columns of unit length
} clx_least_squares;

/// @return CLAST_E_FORMAT if n < p or the columns depend on each other (condition above 1e12);
///         CLAST_E_CONVERGE if LAPACK gives up; CLAST_E_MEMORY; `fit` is then untouched
CLX_SHARED clast_status clx_least_squares_fit(const clx_regression *data, clx_least_squares *fit);
CLX_SHARED void clx_least_squares_free(clx_least_squares *fit);

/// Prediction of each row by the fit of the rows in the other folds.
///
/// @param fold  [n] 0 .. n_fold-1
/// @return as clx_least_squares_fit, with the fold in the message
clast_status clx_cross_validate(const clx_regression *data, const int32_t *fold, int32_t n_fold,
                                double *predicted);

/// Fold of each row: rows in the order of their draws (seed, CLX_STREAM_FOLD, repeat, row) are
/// dealt out in turn, so that fold sizes differ by one at most.
clast_status clx_folds(uint64_t seed, int32_t repeat, int64_t n, int32_t n_fold, int32_t *fold);
