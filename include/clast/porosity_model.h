#pragma once
#include <clast/field.h>
#include <clast/form.h>
#include <clast/status.h>
#include <clast/table.h>

CLAST_BEGIN

// Linear models of a bed's porosity in features of its grains' form: the published ones and those
// of a user's own fit.                                              [docs/theory/predict.md]

/// What a model's features describe.
typedef enum {
    CLAST_MODEL_SINGLE,  ///< one form for all grains: the 13 form factors and inverses
    CLAST_MODEL_MIXTURE, ///< a distribution of forms: mean_, deviation_ and inverse_ of those
    CLAST_MODEL_COLUMNS  ///< columns of a table, one row a bed
} clast_model_kind;

/// "single_form", "form_mixture", "columns".
CLAST_API const char *clast_model_kind_name(clast_model_kind kind);

/// Features of a mixture: mean and standard deviation (divisor n - 1) over the grains of each of
/// the 26 features of a grain, and the inverses of these.                    [Rettinger2022
/// sec. 7.2]
enum { CLAST_N_MIXTURE_FEATURE = 4 * CLAST_N_FORM_FEATURE };

/// Name of feature 0 .. 103 into text: "mean_equancy", "deviation_inverse_equancy",
/// "inverse_mean_equancy", "inverse_deviation_elongation"; false beyond.
CLAST_API bool clast_mixture_feature_name(int32_t feature, size_t size, char *text);

/// Number of the named feature, or -1.
CLAST_API int32_t clast_mixture_feature_find(const char *name);
CLAST_API int32_t clast_form_feature_find(const char *name); ///< 0 .. 25, or -1

/// What is known about the grains of a bed. Features that are not known are NaN.
typedef struct clast_form_inputs {
    int64_t n_grain;     ///< 0: unknown
    bool has_deviation;  ///< the spread of the forms is known, and there is one
    bool is_independent; ///< equancy's moments come from independence of flatness and elongation
    double flatness_mean, flatness_deviation;
    double elongation_mean, elongation_deviation;
    double equancy_mean, equancy_deviation;
    double single[CLAST_N_FORM_FEATURE]; ///< of the mean form (mean flatness, mean elongation)
    double mixture[CLAST_N_MIXTURE_FEATURE];
} clast_form_inputs;

/// Inputs from the grains of a set, all or those in `pick` (with repeats allowed).
///
/// @param pick  [n_pick] indices into the set, or NULL for all
CLAST_API clast_status clast_form_inputs_of(const clast_form_set *set, const int64_t *pick,
                                            int64_t n_pick, clast_form_inputs *inputs);

/// Inputs from means and deviations, flatness and elongation taken as independent:
///
///     mu_EQ = mu_EL mu_FL,   s_EQ^2 = (mu_EL^2 + s_EL^2)(mu_FL^2 + s_FL^2) - mu_EL^2 mu_FL^2
///
/// [Rettinger2022 sec. 7.3]. Of the 104 mixture features those of the three factors (not of their
/// inverses) are known.
///
/// @param deviation  NULL: a single form; else of flatness and of elongation, >= 0
/// @return CLAST_E_FORMAT for means outside (0, 1] or deviations that are negative or not finite
CLAST_API clast_status clast_form_inputs_from_moments(const double mean[2],
                                                      const double deviation[2], int64_t n_grain,
                                                      clast_form_inputs *inputs);

typedef struct clast_model_term {
    char *feature; ///< owned
    double coefficient;
    char *unit; ///< owned; SI unit of a table's own column whose cells have one ("5mm": m), "-" of
                ///< plain numbers; NULL: not known
} clast_model_term;

/// A range that the model's data covered.
typedef struct clast_model_range {
    char *feature; ///< owned; of a term or another feature of the same kind
    double low, high;
} clast_model_range;

/// porosity = intercept + sum coefficient feature.
typedef struct clast_porosity_model {
    char *name;   ///< "single_form_U1"
    char *source; ///< where it comes from, for people
    clast_model_kind kind;
    double intercept;
    int32_t n_term;
    clast_model_term *term; ///< [n_term]
    int32_t n_range;
    clast_model_range *range; ///< [n_range]
    double *covariance;       ///< [n_term + 1][n_term + 1] of intercept and coefficients, or NULL
    double rounding;  ///< half a unit of the last printed digit of coefficients; 0: not rounded
    double deviation; ///< standard deviation of one bed about the model
    int64_t n_bed;    ///< beds it was fitted to
    double r2;        ///< NaN: not known
    double cv_mean_error, cv_median_error; ///< absolute errors in cross-validation; NaN: not known
    double leverage_limit; ///< greatest leverage of a bed that it was fitted to; NaN: not known
} clast_porosity_model;

/// Frees all that a model owns; may be called twice.
CLAST_API void clast_porosity_model_free(clast_porosity_model *model);

enum { CLAST_N_PUBLISHED_MODEL = 5 };

/// The published model of this number (0 .. 4): single_form_U1, _U7, _B50 (eqs 17-19),
/// form_mixture_U1, _U7 (eqs 23, 24) of Rettinger et al. 2022.
///
/// Deviation: sqrt(pi/2) times the printed mean absolute error of cross-validation (Tables 9 and
/// 10), which is exact for normal residuals. Ranges: of a mixture those of Table 2, for which the
/// authors hold it applicable, cut at the set-ups of sec. 7.1; of a single form mean +- 2
/// deviations of the 63 grains (Fig. 2), cut at 1, and L/S as far as 63 grains of these laws go
/// (median of their least and greatest), since the paper prints no limits.
CLAST_API clast_status clast_porosity_model_published(int32_t number, clast_porosity_model *model);

/// Number of the published model of this name, or -1.
CLAST_API int32_t clast_porosity_model_find(const char *name);

/// Whether a grading chooses the model, "auto", "single" or "mixture": a name, a file or a model at
/// hand (NULL) has its own.
CLAST_API bool clast_porosity_model_by_grading(const char *model);

typedef struct clast_prediction {
    double porosity;
    double
        standard_error; ///< of the porosity of one such bed: root of the squares of the next three
    double model_error; ///< scatter of beds about the model
    double coefficient_error; ///< of the coefficients: their covariance, or their printed digits
    double sampling_error;    ///< of the features, from a limited number of grains; NaN: not known
    bool in_range;
    double leverage; ///< x' (X'X)^-1 x of the terms' values; NaN where the model holds no limit
    int32_t n_outside;
    int32_t outside[16]; ///< ranges (numbers into model->range) that are left, first 16
} clast_prediction;

/// Porosity of a bed of these grains; with `bootstrap` the sampling error is the deviation of the
/// porosity over resamples of the grains.
CLAST_API clast_status clast_porosity_predict_set(const clast_porosity_model *model,
                                                  const clast_form_set *set,
                                                  const clast_bootstrap *bootstrap,
                                                  clast_form_inputs *inputs,
                                                  clast_prediction *prediction);

/// Porosity from means and deviations; inputs->n_grain > 1 gives the sampling error by the first
/// derivatives, with variances s^2 / n of a mean and s^2 / (2 (n - 1)) of a deviation.
CLAST_API clast_status clast_porosity_predict_moments(const clast_porosity_model *model,
                                                      const clast_form_inputs *inputs,
                                                      clast_prediction *prediction);

/// One row a grain: the single form of that grain as the only one of a bed; columns row (from 1, in
/// the set's table), porosity, standard_error, in_range (1 or 0); porosity and standard_error are
/// NaN where the model gives a porosity outside (0, 1).
CLAST_API clast_status clast_porosity_predict_each(const clast_porosity_model *model,
                                                   const clast_form_set *set, clast_table *beds);

/// One row a bed of a table with the columns that a model of kind CLAST_MODEL_COLUMNS names;
/// columns as above. Rows with a cell that is not finite are left out. Plain numbers are SI.
///
/// @return CLAST_E_FORMAT without such a column, or for one of another unit than the model's
CLAST_API clast_status clast_porosity_predict_columns(const clast_porosity_model *model,
                                                      const clast_table *table, clast_table *beds);

/// How many of such beds have no porosity, and why; "" where all have one.
///
/// @param words  [size], 256 suffice
/// @return words, or ""
CLAST_API const char *clast_porosity_beds_words(const clast_porosity_model *model,
                                                const clast_table *beds, size_t size, char *words);

/// Whether a table that a person wrote has the units of such a model: of what the model has in
/// metres plain numbers may be anything.
///
/// @return CLAST_E_FORMAT names the column that has no unit, or another one
CLAST_API clast_status clast_porosity_model_check_units(const clast_porosity_model *model,
                                                        const clast_table *table);

/// What a prediction is asked for with, of which some options look at none.
typedef struct clast_predict_given {
    const char *model;  ///< as it is typed: "auto", "single", "mixture", a name or a file; NULL: a
                        ///< model at hand
    bool has_table;     ///< of grains or beds, else means and deviations
    bool each;          ///< every row is a bed
    bool takes_columns; ///< a model of kind CLAST_MODEL_COLUMNS
} clast_predict_given;

/// The options of `clast predict` (grading, grains, columns, each, resamples, seed) that such a
/// prediction does not look at (clast_fields_idle). NULL of a NULL.
CLAST_API const clast_idle *clast_porosity_predict_idle(const clast_predict_given *given,
                                                        clast_idle rules[CLAST_N_IDLE]);

/// One row: porosity, the errors, in_range and the inputs' means and deviations.
CLAST_API clast_status clast_porosity_prediction_table(const clast_porosity_model *model,
                                                       const clast_form_inputs *inputs,
                                                       const clast_prediction *prediction,
                                                       clast_table *table);

// Porosity models from files and to files.

/// Reads a model file, JSON as clast_porosity_model_write makes it.
///
/// @return CLAST_E_IO, CLAST_E_FORMAT (with the key), CLAST_E_LIMIT beyond 1 MiB or 1000 terms
CLAST_API clast_status clast_porosity_model_read(const char *path, clast_porosity_model *model);

/// The same from memory; `name` stands for the path in messages.
CLAST_API clast_status clast_porosity_model_parse(const char *name, const void *bytes, size_t n,
                                                  clast_porosity_model *model);

/// Writes the model as JSON that reads back as the same doubles; the file appears whole or not at
/// all.
///
/// @param provenance  [n][2] keys and texts kept with it, may be NULL
CLAST_API clast_status clast_porosity_model_write(const clast_porosity_model *model,
                                                  const char *const (*provenance)[2], int32_t n,
                                                  const char *path);

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
    char *group;              ///< column that names the bed, in both tables of a mixture; of a
                              ///< table's own columns it is no candidate
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

/// The fields that a fit by the others does not look at (clast_fields_idle). NULL of a NULL.
///
/// @param has_group  whether it looks at the column that names the bed: with a second table, of the
///                   beds' grains, and where candidates are a table's own columns
CLAST_API const clast_idle *clast_porosity_fit_idle(const clast_porosity_fit_config *config,
                                                    bool has_group, clast_idle rules[CLAST_N_IDLE]);

/// Beds with their candidate features.
typedef struct clast_fit_data {
    clast_model_kind kind;
    clast_table beds; ///< columns row (from 1), porosity, then the candidates (NaN: not defined)
    clast_table left_out;  ///< columns row, reason
    char unread_count[64]; ///< of the grains: see clast_form_set; ""
    int64_t n_repeated;    ///< beds of mixtures by a name that a row before has, with its grains
    int64_t n_without_bed; ///< grains of beds that are in no row
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
/// but the target and `group`, and in the results of a study (columns run, ..., exit_code, ...)
/// those between run and exit_code but the seed, that is what was varied, and those that `use`
/// names. Texts that are all numbers with a unit of one dimension are SI numbers; with `use` only
/// the named ones and the target cost a row.
///
/// @return CLAST_E_FORMAT for a name without a column of numbers, a `group` other than the default
///         without a column, or when there is no candidate
CLAST_API clast_status clast_fit_data_columns(const clast_table *beds,
                                              const clast_porosity_fit_config *config,
                                              clast_fit_data *data);
CLAST_API void clast_fit_data_free(clast_fit_data *data);

/// A line that people should know of a fit, spelt as `clast fit` prints it on the error stream.
typedef struct clast_fit_note {
    bool is_of_table; ///< the table's name goes before it
    char text[1024];
} clast_fit_note;

/// The features of a fit that names none (`clast fit --features auto`): mixture with a second
/// table, of the beds' grains; single form where the table's columns, or those of `columns`, are a
/// form's by their names, whatever is in them; else the table's own columns.
///
/// @param note  its text is "", or what says that named columns are candidates though their numbers
///              could be a form
CLAST_API clast_status clast_porosity_fit_choose(const clast_table *beds, bool has_grains,
                                                 const clast_porosity_fit_config *config,
                                                 clast_model_kind *kind, clast_fit_note *note);

typedef struct clast_porosity_fit {
    clast_porosity_model model; ///< with covariance, ranges and scores
    clast_table ranking;        ///< feature, r, p, state, p_family: every candidate by falling |r|
    clast_table trials;         ///< step, feature, cv_mean_error, cv_median_error, r2
    clast_table terms;  ///< term, coefficient, standard_error, t, p, vif, low, high, unit; p is NaN
                        ///< after a selection (but for the published validation): it knows nothing
                        ///< of it; unit is that of the term's own values ("-": none)
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
/// validation), so that a selection among many candidates gains nothing by chance.
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
CLAST_API clast_status clast_porosity_fit_data(const clast_fit_data *data, const char *name,
                                               const char *source,
                                               const clast_porosity_fit_config *config,
                                               clast_porosity_fit *fit);
CLAST_API void clast_porosity_fit_free(clast_porosity_fit *fit);

/// What people should know of a fit, line by line: rows that were left out, columns of words that
/// are no candidates, why a selection has fewer features than n_term, the column that names the
/// beds, features that count the rows.
///
/// @param fit     NULL before it is made: the first lines, those of the table alone
/// @param beds    the table that `data` was made of, with this configuration
/// @param number  from 0
/// @return false beyond the last line, and of a NULL; `note` is then untouched
CLAST_API bool clast_porosity_fit_note(const clast_porosity_fit *fit, const clast_table *beds,
                                       const clast_fit_data *data, int32_t number,
                                       const clast_porosity_fit_config *config,
                                       clast_fit_note *note);

CLAST_END
