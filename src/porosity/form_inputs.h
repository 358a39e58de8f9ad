#pragma once
// Inputs of models from features that are known already.
#include <clast/porosity_model.h>

/// The 26 features of one form; an oblate-prolate index of nothing but rounding is 0.
void clx_form_features_of(double flatness, double elongation, double feature[CLAST_N_FORM_FEATURE]);

/// The 26 features of every grain of a set, [n][CLAST_N_FORM_FEATURE].
void clx_form_features_rows(const clast_form_set *set, double *row);

/// Inputs of the picked rows (NULL: all n).
void clx_form_inputs_from_rows(const double *row, const int64_t *pick, int64_t n,
                               clast_form_inputs *inputs);
