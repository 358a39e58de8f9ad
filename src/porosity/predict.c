// Porosity and its error from a model and the forms of a bed's grains.
#include <clast/porosity_model.h>

#include "base/alloc.h"
#include "base/status.h"
#include "math/bootstrap.h"
#include "math/sample.h"
#include "porosity/form_inputs.h"
#include "porosity/model.h"
#include "porosity/whole.h"
#include "shape/whole.h"
#include <clast/statistics.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { N_OUTSIDE = sizeof((clast_prediction *)0)->outside / sizeof(int32_t) };

/// Value of a feature by name, NaN where the inputs do not hold it or the kind has no such feature.
static double feature_value(const clast_porosity_model *model, const clast_form_inputs *in,
                            const char *name)
{
    const bool is_single = model->kind == CLAST_MODEL_SINGLE;
    const int32_t f = is_single ? clast_form_feature_find(name) : clast_mixture_feature_find(name);
    return f < 0 ? (double)NAN : is_single ? in->single[f] : in->mixture[f];
}

static clast_status read_input(const clast_porosity_model *model, const clast_form_inputs *in,
                               const char *name, double *value)
{
    clast_status status = CLAST_OK;
    const bool is_spread = strstr(name, "deviation_") != NULL;
    *value = feature_value(model, in, name);
    CLX_CHECK(!(isnan(*value) && model->kind == CLAST_MODEL_MIXTURE && !in->has_deviation),
              CLAST_E_FORMAT,
              "model %s needs the spread of the forms (%s): give two grains or more, or deviations "
              "as in 0.65+-0.17; for equal grains take the single-form model",
              model->name, name);
    CLX_CHECK(!(isnan(*value) && is_spread && !in->is_independent), CLAST_E_FORMAT,
              "model %s: '%s' has no value for these grains: that factor does not vary or is not "
              "defined; the single-form model needs no spread",
              model->name, name);
    CLX_CHECK(!isnan(*value), CLAST_E_FORMAT, "model %s: '%s' cannot be had from %s", model->name,
              name,
              in->is_independent ? "means and deviations; give a table of grains"
                                 : "these grains: it is not defined for one of them");
    CLX_CHECK(isfinite(*value), CLAST_E_FORMAT, "model %s: '%s' is infinite for these grains",
              model->name, name);
done:
    return status;
}

/// Values of a model's terms and ranges from inputs, by feature name.
///
/// @param value  [n_term] of the terms; range_value [n_range] of the ranged features
/// @return CLAST_E_FORMAT names the feature that the inputs do not hold
static clast_status model_values(const clast_porosity_model *model, const clast_form_inputs *inputs,
                                 double *value, double *range_value)
{
    CLX_ARGUMENTS(model, inputs, value, range_value);
    CLX_WHOLE(porosity_model, model);
    clast_status status = CLAST_OK;
    double *found = NULL; // of the terms, then of the ranges
    CLX_CHECK(model->kind != CLAST_MODEL_COLUMNS, CLAST_E_USAGE,
              "model %s takes columns of a table, not forms", model->name);
    CLX_TRY(clx_alloc(&found, (int64_t)model->n_term + model->n_range, sizeof *found));
    for (int32_t k = 0; k < model->n_term; ++k) {
        const clast_model_term *term = &model->term[k];
        if (term->coefficient == 0.0 && model->covariance == NULL && inputs->has_deviation &&
            isnan(feature_value(model, inputs, term->feature))) {
            found[k] = 0.0; // the equation as printed does not have it
        } else {
            CLX_TRY(read_input(model, inputs, term->feature, &found[k]));
        }
    }
    for (int32_t k = 0; k < model->n_range; ++k) {
        CLX_TRY(read_input(model, inputs, model->range[k].feature, &found[model->n_term + k]));
    }
    memcpy(value, found, (size_t)model->n_term * sizeof *found);
    memcpy(range_value, found + model->n_term, (size_t)model->n_range * sizeof *found);
done:
    clx_free(found);
    return status;
}

/// Variance of the porosity from that of the coefficients.
static double coefficient_variance(const clast_porosity_model *m, const double *value)
{
    double sum = 0.0;
    const int32_t p = m->n_term + 1;
    for (int32_t i = 0; i < p; ++i) {
        const double xi = i == 0 ? 1.0 : value[i - 1];
        // a number rounded to a unit 2r lies uniformly within +-r: variance r^2 / 3
        sum += xi * xi * m->rounding * m->rounding / 3.0;
        for (int32_t j = 0; j < p && m->covariance != NULL; ++j) {
            sum += xi * m->covariance[i * p + j] * (j == 0 ? 1.0 : value[j - 1]);
        }
    }
    return fmax(sum, 0.0);
}

/// Leverage of the values among those that the model was fitted to; NaN where it does not know.
static double leverage(const clast_porosity_model *m, const double *value)
{
    double sum = 0.0;
    const int32_t p = m->n_term + 1;
    for (int32_t i = 0; i < p && m->covariance != NULL; ++i) {
        const double xi = i == 0 ? 1.0 : value[i - 1];
        for (int32_t j = 0; j < p; ++j) {
            sum += xi * m->covariance[i * p + j] * (j == 0 ? 1.0 : value[j - 1]);
        }
    }
    const bool is_known =
        m->covariance != NULL && isfinite(m->leverage_limit) && m->deviation > 0.0;
    return is_known ? sum / (m->deviation * m->deviation) : (double)NAN;
}

clast_status clx_porosity_model_apply(const clast_porosity_model *model, const double *value,
                                      const double *range_value, clast_prediction *prediction)
{
    CLX_ARGUMENTS(model, value, range_value, prediction);
    CLX_WHOLE(porosity_model, model);
    clast_status status = CLAST_OK;
    clast_prediction p = {.porosity = model->intercept, .model_error = model->deviation};
    for (int32_t k = 0; k < model->n_term; ++k) {
        p.porosity += model->term[k].coefficient * value[k];
    }
    CLX_CHECK(p.porosity > 0.0 && p.porosity < 1.0, CLAST_E_LIMIT,
              "model %s gives the porosity %g, which no bed has: the grains lie far outside its "
              "range",
              model->name, p.porosity);
    p.coefficient_error = sqrt(coefficient_variance(model, value));
    p.standard_error = hypot(p.model_error, p.coefficient_error);
    for (int32_t k = 0; k < model->n_range; ++k) {
        const clast_model_range *r = &model->range[k];
        const double slack = 1e-12 * (fabs(r->low) + fabs(r->high));
        if (range_value[k] < r->low - slack || range_value[k] > r->high + slack) {
            if (p.n_outside < N_OUTSIDE) {
                p.outside[p.n_outside] = k;
            }
            ++p.n_outside;
        }
    }
    p.leverage = leverage(model, value);
    p.in_range = p.n_outside == 0 && !(p.leverage > model->leverage_limit * (1.0 + 1e-9));
    *prediction = p;
done:
    return status;
}

/// Values and application in one.
static clast_status predict(const clast_porosity_model *model, const clast_form_inputs *inputs,
                            clast_prediction *prediction)
{
    clast_status status = CLAST_OK;
    double *value = NULL;
    CLX_TRY(clx_alloc(&value, (int64_t)model->n_term + model->n_range, sizeof *value));
    CLX_TRY(model_values(model, inputs, value, value + model->n_term));
    CLX_TRY(clx_porosity_model_apply(model, value, value + model->n_term, prediction));
    prediction->sampling_error = NAN;
done:
    clx_free(value);
    return status;
}

/// Resamples of two grains, or of equal ones, tell nothing: their deviation is 0.
static void add_sampling(clast_prediction *p, double error)
{
    if (error > 0.0) {
        p->sampling_error = error;
        p->standard_error = hypot(p->standard_error, error);
    }
}

/// Porosities of resamples of the grains; a resample without an answer (all grains equal) is NaN.
static clast_status resample(const clast_porosity_model *model, const clast_form_set *set,
                             const clast_bootstrap *bootstrap, double *deviation)
{
    clast_status status = CLAST_OK;
    int64_t *pick = NULL;
    double *row = NULL;
    double *porosity = NULL;
    int64_t n = 0;
    CLX_TRY(clx_alloc(&pick, set->n, sizeof *pick));
    CLX_TRY(clx_alloc(&row, set->n * CLAST_N_FORM_FEATURE, sizeof *row));
    CLX_TRY(clx_alloc(&porosity, bootstrap->n_resample, sizeof *porosity));
    clx_form_features_rows(set, row);
    for (int32_t b = 0; b < bootstrap->n_resample; ++b) {
        clast_form_inputs in = {0};
        clast_prediction p = {0};
        clx_bootstrap_rows(bootstrap, b, set->n, pick);
        clx_form_inputs_from_rows(row, pick, set->n, &in);
        const clast_status answer = predict(model, &in, &p);
        CLX_CHECK(answer != CLAST_E_MEMORY, answer, "no memory for a resample");
        porosity[n] = p.porosity;
        n += answer == CLAST_OK ? 1 : 0;
    }
    const clx_moments m = clx_sample_moments(porosity, n);
    *deviation = n > 1 && !m.is_constant ? m.deviation : 0.0;
done:
    CLX_FREE(pick, row, porosity);
    return status;
}

clast_status clast_porosity_predict_set(const clast_porosity_model *model,
                                        const clast_form_set *set, const clast_bootstrap *bootstrap,
                                        clast_form_inputs *inputs, clast_prediction *prediction)
{
    CLX_ARGUMENTS(model, set, inputs, prediction);
    CLX_WHOLE(porosity_model, model);
    CLX_WHOLE(form_set, set);
    clast_status status = CLAST_OK;
    clast_form_inputs in = {0};
    clast_prediction p = {0};
    CLX_TRY(clast_form_inputs_of(set, NULL, 0, &in));
    CLX_TRY(predict(model, &in, &p));
    if (bootstrap != NULL && bootstrap->n_resample > 1 && set->n > 1) {
        double error = 0.0;
        CLX_TRY(resample(model, set, bootstrap, &error));
        add_sampling(&p, error);
    }
    *inputs = in;
    *prediction = p;
done:
    return status;
}

/// Square of d porosity / d (moment k) times that moment's standard error, by a central difference
/// of a thousandth of it.
static clast_status moment_variance(const clast_porosity_model *model, const clast_form_inputs *in,
                                    int k, double error, double *variance)
{
    clast_status status = CLAST_OK;
    double porosity[2] = {0.0};
    const double step = 1e-3 * error;
    for (int side = 0; side < 2 && error > 0.0; ++side) {
        double v[4] = {in->flatness_mean, in->elongation_mean, in->flatness_deviation,
                       in->elongation_deviation};
        clast_form_inputs moved = {0};
        clast_prediction p = {0};
        v[k] += side == 0 ? -step : step;
        v[k] = k < 2 ? fmin(v[k], 1.0) : v[k];
        CLX_TRY(clast_form_inputs_from_moments(v, in->has_deviation ? v + 2 : NULL, in->n_grain,
                                               &moved));
        CLX_TRY(predict(model, &moved, &p));
        porosity[side] = p.porosity;
    }
    const double slope = error > 0.0 ? (porosity[1] - porosity[0]) / (2.0 * step) : 0.0;
    *variance = slope * slope * error * error;
done:
    return status;
}

clast_status clast_porosity_predict_moments(const clast_porosity_model *model,
                                            const clast_form_inputs *inputs,
                                            clast_prediction *prediction)
{
    CLX_ARGUMENTS(model, inputs, prediction);
    CLX_WHOLE(porosity_model, model);
    clast_status status = CLAST_OK;
    clast_prediction p = {0};
    double sum = 0.0;
    CLX_TRY(predict(model, inputs, &p));
    if (inputs->n_grain > 1 && inputs->has_deviation) {
        const double n = (double)inputs->n_grain;
        const double s[2] = {inputs->flatness_deviation, inputs->elongation_deviation};
        for (int k = 0; k < 4; ++k) {
            double variance = 0.0;
            const double error = k < 2 ? s[k] / sqrt(n) : s[k - 2] / sqrt(2.0 * (n - 1.0));
            CLX_TRY(moment_variance(model, inputs, k, error, &variance));
            sum += variance;
        }
        add_sampling(&p, sqrt(sum));
    }
    *prediction = p;
done:
    return status;
}

clast_status clx_predicted_beds_init(int64_t n_row, clast_table *beds)
{
    static const char *const name[4] = {"row", "porosity", "standard_error", "in_range"};
    clast_status status = clast_table_init(beds, "beds", n_row);
    for (int k = 0; k < 4 && status == CLAST_OK; ++k) {
        status = clast_table_add_number(beds, name[k], "-", NULL);
    }
    return status;
}

clast_status clx_predicted_bed(clast_status answer, const clast_prediction *p, int64_t row,
                               int64_t i, clast_table *beds)
{
    const bool is_known = answer == CLAST_OK;
    const double cell[4] = {(double)row + 1.0, is_known ? p->porosity : (double)NAN,
                            is_known ? p->standard_error : (double)NAN,
                            is_known && p->in_range ? 1.0 : 0.0};
    if (!is_known && answer != CLAST_E_LIMIT) {
        clx_fail_prefix("row %lld", (long long)row + 1);
        return answer;
    }
    for (int k = 0; k < 4; ++k) {
        beds->column[k].number[i] = cell[k];
    }
    return CLAST_OK;
}

const char *clast_porosity_beds_words(const clast_porosity_model *model, const clast_table *beds,
                                      size_t size, char *words)
{
    const double *porosity = clast_table_numbers(beds, "porosity");
    const double *row = clast_table_numbers(beds, "row");
    int64_t n = 0;
    double first = 0.0;
    for (int64_t i = 0; porosity != NULL && row != NULL && i < beds->n_row; ++i) {
        first = isnan(porosity[i]) && n == 0 ? row[i] : first;
        n += isnan(porosity[i]) ? 1 : 0;
    }
    if (n == 0) {
        return "";
    }
    (void)snprintf(
        words, size,
        "%lld of %lld beds have no porosity (first: row %lld): model %s gives one outside "
        "0 to 1, they lie far outside its range",
        (long long)n, (long long)beds->n_row, (long long)first, model->name);
    return words;
}

/// One grain of a set as inputs.
static clast_status one_grain(const clast_form_set *set, int64_t i, clast_form_inputs *in)
{
    const double mean[2] = {set->flatness[i], set->elongation[i]};
    return clast_form_inputs_from_moments(mean, NULL, 1, in);
}

clast_status clast_porosity_predict_each(const clast_porosity_model *model,
                                         const clast_form_set *set, clast_table *beds)
{
    CLX_ARGUMENTS(model, set, beds);
    CLX_WHOLE(porosity_model, model);
    CLX_WHOLE(form_set, set);
    clast_status status = CLAST_OK;
    clast_table t = {0};
    CLX_CHECK(model->kind == CLAST_MODEL_SINGLE, CLAST_E_USAGE,
              "model %s is no single-form model: one grain says nothing about a mixture",
              model->name);
    CLX_TRY(clx_predicted_beds_init(set->n, &t));
    for (int64_t i = 0; i < set->n; ++i) {
        clast_form_inputs in = {0};
        clast_prediction p = {0};
        CLX_TRY(one_grain(set, i, &in));
        CLX_TRY(clx_predicted_bed(predict(model, &in, &p), &p, set->row[i], i, &t));
    }
    *beds = t;
    t = (clast_table){0};
done:
    clast_table_free(&t);
    return status;
}

clast_status clast_porosity_prediction_table(const clast_porosity_model *model,
                                             const clast_form_inputs *inputs,
                                             const clast_prediction *prediction, clast_table *table)
{
    CLX_ARGUMENTS(model, inputs, prediction, table);
    CLX_WHOLE(porosity_model, model);
    static const char *const name[] = {
        "porosity",          "standard_error",       "model_error",
        "coefficient_error", "sampling_error",       "in_range",
        "n_grain",           "flatness_mean",        "flatness_deviation",
        "elongation_mean",   "elongation_deviation", "equancy_mean",
        "equancy_deviation"};
    enum { N_NAME = sizeof name / sizeof name[0] };
    const clast_prediction *p = prediction;
    const clast_form_inputs *in = inputs;
    const double value[N_NAME] = {
        p->porosity,          p->standard_error,        p->model_error,
        p->coefficient_error, p->sampling_error,        p->in_range ? 1.0 : 0.0,
        (double)in->n_grain,  in->flatness_mean,        in->flatness_deviation,
        in->elongation_mean,  in->elongation_deviation, in->equancy_mean,
        in->equancy_deviation};
    clast_status status = CLAST_OK;
    clast_table t = {0};
    CLX_TRY(clast_table_init(&t, "prediction", 1));
    CLX_TRY(clast_table_add_text(&t, "model"));
    CLX_TRY(clast_table_set_text(&t, 0, 0, model->name));
    for (int k = 0; k < N_NAME; ++k) {
        double *column = NULL;
        CLX_TRY(clast_table_add_number(&t, name[k], "-", &column));
        column[0] = value[k];
    }
    *table = t;
    t = (clast_table){0};
done:
    clast_table_free(&t);
    return status;
}
