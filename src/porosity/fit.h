#pragma once
// Parts of a porosity fit.
#include <clast/status.h>

typedef struct clast_column clast_column;
typedef struct clast_fit_data clast_fit_data;
typedef struct clast_porosity_fit clast_porosity_fit;
typedef struct clast_porosity_fit_config clast_porosity_fit_config;

/// In the results of a study the index of exit_code, behind the last column that was varied; 0: the
/// table is no study's.
int32_t clx_fit_end_of_varied(const clast_table *beds);

/// Beds with candidates, borrowed: all of a fit, or a part of them.
typedef struct clx_fit_sample {
    int64_t n; ///< beds
    const double *y, *row;
    int32_t m;                     ///< candidates
    const clast_column *candidate; ///< [m]
} clx_fit_sample;

/// A fit under way: candidates and which of them are in the model.
typedef struct clx_fit {
    const clast_porosity_fit_config *config;
    int64_t n; ///< beds
    const double *y, *row;
    int32_t m;                     ///< candidates
    const clast_column *candidate; ///< [m] borrowed
    double *r, *p;                 ///< [m] correlation with the porosity
    int32_t *state;                ///< [m] enum clx_candidate
    int32_t *against;              ///< [m] candidate that a removed one is like
    int32_t *rank;                 ///< [m] by falling |r|
    int32_t n_chosen;
    int32_t *chosen;              ///< [m]
    int32_t *fold;                ///< [n_repeat][n]
    double *x, *held_out, *error; ///< scratch [n][m + 1], [n], [n]
    clast_table *trials;          ///< borrowed; NULL: nobody asks
} clx_fit;

typedef enum {
    CLX_CANDIDATE_KEPT,
    CLX_CANDIDATE_NOT_FINITE,
    CLX_CANDIDATE_CONSTANT,
    CLX_CANDIDATE_REMOVED,
    CLX_CANDIDATE_CHOSEN
} clx_candidate;

/// Ranks the candidates and sets aside those without use.
clast_status clx_fit_begin(const clx_fit_sample *sample, const clast_porosity_fit_config *config,
                           clx_fit *fit);
void clx_fit_end(clx_fit *fit);

/// Chooses features by the rule, or those that the configuration names.
clast_status clx_fit_select(clx_fit *fit);

/// Design matrix of the chosen candidates and one more (-1: none) into fit->x; its columns.
int32_t clx_fit_design(clx_fit *fit, int32_t more);

/// Held-out errors of the design of p columns: mean and median, averaged over the repeats; held_out
/// of the last repeat stays in fit->held_out.
clast_status clx_fit_score(clx_fit *fit, int32_t p, double *mean, double *median);

/// What the model is worth: held-out errors with the selection inside the folds, and permutations.
typedef struct clx_fit_validity {
    double mean_error, median_error, r2_held_out; ///< NaN with the published validation
    double *held_out; ///< [n] of the first repeat; NULL with the published validation
    double *r2;       ///< [n_permutation]
    double *greatest; ///< [n_permutation] greatest |r| of a candidate
} clx_fit_validity;

clast_status clx_fit_validate(const clx_fit *fit, clx_fit_validity *validity);
void clx_fit_validity_free(clx_fit_validity *validity);

/// Share of values that reach x, counting x itself: (1 + count) / (1 + n); NaN for n = 0.
double clx_fit_share(const double *value, int32_t n, double x);
