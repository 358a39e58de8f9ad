#pragma once
// Building porosity models.
#include <clast/status.h>

typedef struct clast_form_inputs clast_form_inputs;
typedef struct clast_porosity_model clast_porosity_model;
typedef struct clast_prediction clast_prediction;
typedef struct clast_table clast_table;

/// Room for terms, ranges and a covariance of an empty model, texts not yet set.
clast_status clx_model_alloc(const char *name, const char *source, int32_t n_term, int32_t n_range,
                             bool has_covariance, clast_porosity_model *model);

/// Porosity for given values of terms and ranged features. Outside its ranges, or where the values
/// together lie farther out than those of any bed that it was fitted to (by their leverage
/// [Cook1977]), the model still answers, with in_range false; a porosity outside (0, 1) is
/// CLAST_E_LIMIT.
clast_status clx_porosity_model_apply(const clast_porosity_model *model, const double *value,
                                      const double *range_value, clast_prediction *prediction);

/// An empty table of predicted beds: row, porosity, standard_error, in_range.
clast_status clx_predicted_beds_init(int64_t n_row, clast_table *beds);

/// Bed i of such a table: the `answer` to row `row` of the asker's table (from 0) and its
/// prediction; CLAST_E_LIMIT, no bed has such a porosity, leaves NaN.
///
/// @return any other failure, with the row's number before its words
clast_status clx_predicted_bed(clast_status answer, const clast_prediction *p, int64_t row,
                               int64_t i, clast_table *beds);
