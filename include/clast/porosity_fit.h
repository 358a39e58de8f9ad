#pragma once
#include <clast/field.h>
#include <clast/porosity_model.h>

CLAST_BEGIN

// Fitting linear porosity models to a table of beds: correlation ranking, removal of features that
// say the same, cross-validated linear models, diagnostics.              [docs/theory/predict.md]

/// Which of the held-out absolute errors decides. The paper's text says "medium", its tables
/// "mean".
typedef enum { CLAST_SCORE_MEAN, CLAST_SCORE_MEDIAN } clast_fit_score;

/// How a model whose features were selected is judged.
typedef enum {
    CLAST_VALIDATION_NESTED,   ///< features are selected anew without the held-out beds
                               ///< [Ambroise2002]
    CLAST_VALIDATION_PUBLISHED ///< held-out beds had their say in the selection, as in the paper:
                               ///< errors come out too small
} clast_fit_validation;

typedef struct clast_porosity_fit_config {
    char *target;             ///< column with the measured porosity
    char *columns;            ///< columns of the form, as clast_form_set_of takes them
    char *group;              ///< column that names the bed, in both tables of a mixture
    int32_t n_term;           ///< features of the model
    char *use;                ///< "a,b": these features, nothing is selected
    double correlation_limit; ///< features with a greater |r| to a chosen one are removed
    int32_t n_fold, n_repeat; ///< of the cross-validation
    int32_t score;            ///< clast_fit_score
    int32_t validation;       ///< clast_fit_validation
    int32_t n_permutation;    ///< of the porosities among the beds; 0: no p-value
    uint64_t seed;
} clast_porosity_fit_config;

/// Fields of the configuration of fits: keys, defaults, ranges and units; ends with a row of zeros.
extern CLAST_API const clast_field clast_porosity_fit_fields[];

/// Beds with their candidate features.
typedef struct clast_fit_data {
    clast_model_kind kind;
    clast_table beds; ///< columns row (from 1), porosity, then the candidates (NaN: not defined)
    clast_table left_out; ///< columns row, reason
} clast_fit_data;

/// Beds of one form each: 26 features from each row's flatness and elongation or L, I, S.
///
/// Rows without a form or with a porosity that is no number above 0 and below 1 are left out.
CLAST_API clast_status clast_fit_data_single(const clast_table *beds,
                                             const clast_porosity_fit_config *config,
                                             clast_fit_data *data);

/// Beds of mixtures: 104 features of the grains that carry the bed's name in the column `group`.
/// Beds with fewer than two grains are left out.
CLAST_API clast_status clast_fit_data_mixture(const clast_table *beds, const clast_table *grains,
                                              const clast_porosity_fit_config *config,
                                              clast_fit_data *data);

/// Any other table: candidates are the columns of numbers that `columns` names; without names all
/// but the target, and in the results of a study (columns run, ..., exit_code, ...) those between
/// run and exit_code, that is what was varied, unless `use` names features.
///
/// @return CLAST_E_FORMAT for a name without a column of numbers, or when there is no candidate
CLAST_API clast_status clast_fit_data_columns(const clast_table *beds,
                                              const clast_porosity_fit_config *config,
                                              clast_fit_data *data);
CLAST_API void clast_fit_data_free(clast_fit_data *data);

typedef struct clast_porosity_fit {
    clast_porosity_model model; ///< with covariance, ranges and scores
    clast_table ranking;        ///< feature, r, p, state, p_family: every candidate by falling |r|
    clast_table trials;         ///< step, feature, cv_mean_error, cv_median_error, r2
    clast_table terms;  ///< term, coefficient, standard_error, t, p, vif, low, high; p is NaN after
                        ///< a selection (but for the published validation): it knows nothing of it
    clast_table rows;   ///< row, porosity, fitted, residual, held_out, leverage, studentised, cook
    int32_t n_removed;  ///< candidates removed by the correlation limit
    double condition;   ///< of the scaled design matrix
    double r2_held_out; ///< 1 - squares of held-out beds / squares about the mean of the others
    double p_value;     ///< of r2 over n_permutation permutations; NaN without
} clast_porosity_fit;

/// Fits a model.
///
/// 1. Candidates that are not finite in every row or constant are set aside.
/// 2. The candidate with the greatest |Pearson r| to the porosity is the first feature.
/// 3. Candidates with |r| > correlation_limit to a chosen feature are removed. Of the rest, the one
///    whose linear model with the chosen ones has the least error in cross-validation is chosen;
///    until there are n_term or none is left.
/// 4. The last model is fitted to all beds.                             [Rettinger2022 sec. 6.3]
///
/// Errors are absolute errors of held-out beds, pooled over folds and averaged over repeats; folds
/// are a function of (seed, repeat). Steps 2 and 3 are repeated without the beds held out (nested
/// validation), so that a selection among many candidates gains nothing by luck.
///
/// p_value: share of permutations of the porosities, the whole way repeated on each, whose r2 is as
/// great, (1 + count) / (1 + n_permutation); p_family of a candidate: the same with the greatest
/// |r| of all candidates against its own.             [Phipson2010; Westfall1993, single-step maxT]
///
/// @param name  of the model; @param source  its source, for people
/// @return CLAST_E_FORMAT with fewer than n_term + 2 beds (or n_fold), no candidate, dependent
/// features
/// @note n_term m (n_fold n_repeat + 1) small regressions for m candidates, as often again as there
/// are folds, repeats and permutations; threads share those, the bytes do not depend on them
CLAST_API clast_status clast_porosity_fit_data(const clast_fit_data *data,
                                               const clast_porosity_fit_config *config,
                                               const char *name, const char *source,
                                               clast_porosity_fit *fit);
CLAST_API void clast_porosity_fit_free(clast_porosity_fit *fit);

CLAST_END
