#pragma once
#include <clast/field.h>
#include <clast/porosity_model.h>

CLAST_BEGIN

// Fitting linear porosity models to a table of beds: correlation ranking, removal of features that
// say the same, cross-validated linear models, diagnostics.              [docs/theory/predict.md]

/// Which of the held-out absolute errors decides. The paper's text says "medium", its tables
/// "mean".
typedef enum { CLAST_SCORE_MEAN, CLAST_SCORE_MEDIAN } clast_fit_score;

typedef struct clast_porosity_fit_config {
    char *target;             ///< column with the measured porosity
    char *columns;            ///< columns of the form, as clast_form_set_of takes them
    char *group;              ///< column that names the bed, in both tables of a mixture
    int32_t n_term;           ///< features of the model
    char *use;                ///< "a,b": these features, nothing is selected
    double correlation_limit; ///< features with a greater |r| to a chosen one are removed
    int32_t n_fold, n_repeat; ///< of the cross-validation
    int32_t score;            ///< clast_fit_score
    uint64_t seed;
} clast_porosity_fit_config;

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
    clast_table ranking;        ///< feature, r, p, state: every candidate by falling |r|
    clast_table trials;         ///< step, feature, cv_mean_error, cv_median_error, r2
    clast_table terms;          ///< term, coefficient, standard_error, t, p, vif, low, high
    clast_table rows;  ///< row, porosity, fitted, residual, held_out, leverage, studentised, cook
    int32_t n_removed; ///< candidates removed by the correlation limit
    double condition;  ///< of the scaled design matrix
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
/// are a function of (seed, repeat).
///
/// @param name  of the model; @param source  its source, for people
/// @return CLAST_E_FORMAT with fewer than n_term + 2 beds (or n_fold), no candidate, dependent
/// features
CLAST_API clast_status clast_porosity_fit_data(const clast_fit_data *data,
                                               const clast_porosity_fit_config *config,
                                               const char *name, const char *source,
                                               clast_porosity_fit *fit);
CLAST_API void clast_porosity_fit_free(clast_porosity_fit *fit);

CLAST_END
