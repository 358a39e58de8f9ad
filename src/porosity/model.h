#pragma once
// Building porosity models.
#include <clast/status.h>

typedef struct clast_form_inputs clast_form_inputs;
typedef struct clast_porosity_model clast_porosity_model;
typedef struct clast_prediction clast_prediction;

/// Room for terms, ranges and a covariance of an empty model, texts not yet set.
clast_status clx_model_alloc(const char *name, const char *source, int32_t n_term, int32_t n_range,
                             bool has_covariance, clast_porosity_model *model);

/// Porosity for given values of terms and ranged features. Outside its ranges, or where the values
/// together lie farther out than those of any bed that it was fitted to (by their leverage
/// [Cook1977]), the model still answers, with in_range false; a porosity outside (0, 1) is
/// CLAST_E_LIMIT.
clast_status clx_porosity_model_apply(const clast_porosity_model *model, const double *value,
                                      const double *range_value, clast_prediction *prediction);
