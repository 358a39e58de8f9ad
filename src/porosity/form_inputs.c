// Features of single forms and of mixtures of forms, from grains or from means and deviations.
#include "porosity/form_inputs.h"

#include "base/alloc.h"
#include "base/status.h"
#include "shape/whole.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/// A spread below this share of the values is rounding.         [docs/theory/statistics.md]
static const double ROUNDING = 64.0 * DBL_EPSILON;

static const char *const statistic[4] = {"mean_", "deviation_", "inverse_mean_",
                                         "inverse_deviation_"};

bool clast_mixture_feature_name(int32_t feature, size_t size, char *text)
{
    if (text == NULL) {
        return false;
    }
    if (feature < 0 || feature >= CLAST_N_MIXTURE_FEATURE) {
        return false;
    }
    (void)snprintf(text, size, "%s%s", statistic[feature / CLAST_N_FORM_FEATURE],
                   clast_form_feature_name(feature % CLAST_N_FORM_FEATURE));
    return true;
}

int32_t clast_form_feature_find(const char *name)
{
    if (name == NULL) {
        return -1;
    }
    for (int32_t f = 0; f < CLAST_N_FORM_FEATURE; ++f) {
        if (strcmp(clast_form_feature_name(f), name) == 0) {
            return f;
        }
    }
    return -1;
}

int32_t clast_mixture_feature_find(const char *name)
{
    if (name == NULL) {
        return -1;
    }
    for (int32_t s = 0; s < 4; ++s) {
        const size_t n = strlen(statistic[s]);
        if (strncmp(name, statistic[s], n) == 0) {
            const int32_t f = clast_form_feature_find(name + n);
            if (f >= 0) {
                return s * CLAST_N_FORM_FEATURE + f;
            }
        }
    }
    return -1;
}

void clx_form_features_of(double flatness, double elongation, double feature[CLAST_N_FORM_FEATURE])
{
    double lis[3];
    double *index = &feature[CLAST_FORM_OBLATE_PROLATE];
    clast_form_lengths(flatness, elongation, 1.0, lis);
    clast_form_features(lis[0], lis[1], lis[2], feature);
    // 10 L/S ((L - I)/(L - S) - 1/2): the rounding of the two terms is all that is left where
    // I = (L + S)/2
    const double term = 10.0 * lis[0] / lis[2] * lis[0] / (lis[0] - lis[2]);
    *index = fabs(*index) <= ROUNDING * term ? 0.0 : *index;
}

/// Sets mean and deviation of one of the 26 features, and their inverses where they have one.
static void set_mixture(clast_form_inputs *in, int32_t feature, double mean, double deviation)
{
    CLAST_ASSERT(feature >= 0 && feature < CLAST_N_FORM_FEATURE);
    const double value[4] = {mean, deviation, mean != 0.0 ? 1.0 / mean : (double)NAN,
                             deviation > 0.0 ? 1.0 / deviation : (double)NAN};
    for (int32_t s = 0; s < 4; ++s) {
        in->mixture[s * CLAST_N_FORM_FEATURE + feature] =
            isfinite(value[s]) ? value[s] : (double)NAN;
    }
}

static clast_form_inputs unknown(void)
{
    clast_form_inputs in = {0};
    for (int32_t k = 0; k < CLAST_N_MIXTURE_FEATURE; ++k) {
        in.mixture[k] = NAN;
    }
    for (int32_t k = 0; k < CLAST_N_FORM_FEATURE; ++k) {
        in.single[k] = NAN;
    }
    return in;
}

/// Moments of feature f over the picked rows of 26, in their order. Sums are of differences from
/// the first grain: equal grains have the deviation 0, whatever their number.
static void moments(const double *row, const int64_t *pick, int64_t n, int32_t f, double *mean,
                    double *deviation)
{
    CLAST_ASSERT(n > 0);
    const double first = row[(pick != NULL ? pick[0] : 0) * CLAST_N_FORM_FEATURE + f];
    double sum = 0.0;
    double square = 0.0;
    double most = 0.0;
    for (int64_t i = 0; i < n; ++i) {
        const double x = row[(pick != NULL ? pick[i] : i) * CLAST_N_FORM_FEATURE + f];
        sum += x - first;
        most = fmax(most, fabs(x));
    }
    const double shift = sum / (double)n;
    for (int64_t i = 0; i < n; ++i) {
        const double x = row[(pick != NULL ? pick[i] : i) * CLAST_N_FORM_FEATURE + f];
        const double d = x - first - shift;
        square += d * d;
    }
    *mean = first + shift;
    *deviation = n > 1 ? sqrt(square / (double)(n - 1)) : 0.0;
    if (*deviation <= ROUNDING * most) {
        *deviation = 0.0; // lengths of one form at two sizes round to two ratios
    }
}

void clx_form_features_rows(const clast_form_set *set, double *row)
{
    for (int64_t i = 0; i < set->n; ++i) {
        clx_form_features_of(set->flatness[i], set->elongation[i], row + i * CLAST_N_FORM_FEATURE);
    }
}

void clx_form_inputs_from_rows(const double *row, const int64_t *pick, int64_t n,
                               clast_form_inputs *inputs)
{
    CLAST_ASSERT(n > 0);
    clast_form_inputs in = unknown();
    double mean[CLAST_N_FORM_FEATURE];
    double deviation[CLAST_N_FORM_FEATURE];
    for (int32_t f = 0; f < CLAST_N_FORM_FEATURE; ++f) {
        moments(row, pick, n, f, &mean[f], &deviation[f]);
    }
    in.has_deviation =
        deviation[CLAST_FORM_FLATNESS] > 0.0 || deviation[CLAST_FORM_ELONGATION] > 0.0;
    for (int32_t f = 0; f < CLAST_N_FORM_FEATURE; ++f) {
        // of one form every feature is one value, also of those that magnify rounding
        const bool is_one = !in.has_deviation && isfinite(deviation[f]);
        set_mixture(&in, f, mean[f], is_one ? 0.0 : deviation[f]);
    }
    const double *m = in.mixture;
    in.n_grain = n;
    in.flatness_mean = m[CLAST_FORM_FLATNESS];
    in.elongation_mean = m[CLAST_FORM_ELONGATION];
    in.equancy_mean = m[CLAST_FORM_EQUANCY];
    in.flatness_deviation = m[CLAST_N_FORM_FEATURE + CLAST_FORM_FLATNESS];
    in.elongation_deviation = m[CLAST_N_FORM_FEATURE + CLAST_FORM_ELONGATION];
    in.equancy_deviation = m[CLAST_N_FORM_FEATURE + CLAST_FORM_EQUANCY];
    clx_form_features_of(in.flatness_mean, in.elongation_mean, in.single);
    *inputs = in;
}

clast_status clast_form_inputs_of(const clast_form_set *set, const int64_t *pick, int64_t n_pick,
                                  clast_form_inputs *inputs)
{
    CLX_ARGUMENTS(set, inputs);
    CLX_WHOLE(form_set, set);
    clast_status status = CLAST_OK;
    double *row = NULL;
    const int64_t n = pick != NULL ? n_pick : set->n;
    CLX_CHECK(n > 0, CLAST_E_FORMAT, "form of a bed: no grains");
    for (int64_t i = 0; pick != NULL && i < n; ++i) {
        CLX_CHECK(pick[i] >= 0 && pick[i] < set->n, CLAST_E_ARGUMENT,
                  "form of a bed: grain %lld of %lld", (long long)pick[i], (long long)set->n);
    }
    CLX_TRY(clx_alloc(&row, set->n * CLAST_N_FORM_FEATURE, sizeof *row));
    clx_form_features_rows(set, row);
    clx_form_inputs_from_rows(row, pick, n, inputs);
done:
    clx_free(row);
    return status;
}

clast_status clast_form_inputs_from_moments(const double mean[2], const double deviation[2],
                                            int64_t n_grain, clast_form_inputs *inputs)
{
    CLX_ARGUMENTS(mean, inputs);
    static const char *const name[2] = {"flatness", "elongation"};
    clast_status status = CLAST_OK;
    clast_form_inputs in = unknown();
    for (int k = 0; k < 2; ++k) {
        CLX_CHECK(mean[k] > 0.0 && mean[k] <= 1.0, CLAST_E_FORMAT,
                  "%s %g: the mean of a ratio S/I or I/L lies above 0 and up to 1", name[k],
                  mean[k]);
        CLX_CHECK(deviation == NULL || (deviation[k] >= 0.0 && isfinite(deviation[k])),
                  CLAST_E_FORMAT, "%s: the deviation %g is negative or not finite", name[k],
                  deviation != NULL ? deviation[k] : 0.0);
    }
    const double fl = mean[0];
    const double el = mean[1];
    const double s_fl = deviation != NULL && deviation[0] > ROUNDING * fl ? deviation[0] : 0.0;
    const double s_el = deviation != NULL && deviation[1] > ROUNDING * el ? deviation[1] : 0.0;
    in.n_grain = n_grain;
    in.has_deviation = s_fl > 0.0 || s_el > 0.0;
    in.is_independent = true;
    in.flatness_mean = fl;
    in.flatness_deviation = s_fl;
    in.elongation_mean = el;
    in.elongation_deviation = s_el;
    in.equancy_mean = fl * el;
    // (el^2 + s_el^2)(fl^2 + s_fl^2) - el^2 fl^2, without its cancellation
    in.equancy_deviation =
        sqrt(el * el * s_fl * s_fl + s_el * s_el * fl * fl + s_el * s_el * s_fl * s_fl);
    set_mixture(&in, CLAST_FORM_FLATNESS, fl, s_fl);
    set_mixture(&in, CLAST_FORM_ELONGATION, el, s_el);
    set_mixture(&in, CLAST_FORM_EQUANCY, in.equancy_mean, in.equancy_deviation);
    clx_form_features_of(fl, el, in.single);
    *inputs = in;
done:
    return status;
}
