// What a selected model is worth. Cross-validation with the features selected anew in every
// training set, as errors of features that the held-out beds helped to select are too small
// [Ambroise2002]; and permutations of the porosities among the beds, the whole way
// repeated on each, which say how often chance does as well [Phipson2010].
#include "porosity/fit.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "base/status.h"
#include "math/least_squares.h"
#include "math/rng.h"
#include "math/sample.h"
#include "math/sort.h"
#include <clast/porosity_model.h>
#include <clast/table.h>
#include <math.h>

/// Some of the beds with the candidates that have a value in every bed.
typedef struct {
    double *block;           ///< [m + 1][n]: porosities, then candidates
    clast_column *candidate; ///< [m] names borrowed
    int32_t *index;          ///< [m] candidate of the whole fit
    clx_fit_sample sample;
} part;

static void free_part(part *p)
{
    CLX_FREE(p->block, p->candidate, p->index);
    *p = (part){0};
}

/// Beds that `fold` does not hold out (-1: all of them).
static clast_status gather_part(const clx_fit *fit, const int32_t *fold, int32_t held_out, part *p)
{
    CLAST_ASSERT((fold == NULL) == (held_out < 0));
    clast_status status = CLAST_OK;
    int64_t n = 0;
    int32_t m = 0;
    CLX_TRY(clx_alloc(&p->block, fit->n * ((int64_t)fit->m + 1), sizeof *p->block));
    CLX_TRY(clx_alloc(&p->candidate, fit->m, sizeof *p->candidate));
    CLX_TRY(clx_alloc(&p->index, fit->m, sizeof *p->index));
    for (int32_t j = -1; j < fit->m; ++j) {
        const double *from = j < 0 ? fit->y : fit->candidate[j].number;
        double *to = p->block + (m + (j < 0 ? 0 : 1)) * fit->n;
        if (j >= 0 && fit->state[j] == CLX_CANDIDATE_NOT_FINITE) {
            continue;
        }
        n = 0;
        for (int64_t i = 0; i < fit->n; ++i) {
            if (held_out < 0 || fold[i] != held_out) {
                to[n++] = from[i];
            }
        }
        if (j >= 0) {
            p->candidate[m] = (clast_column){.name = fit->candidate[j].name, .number = to};
            p->index[m++] = j;
        }
    }
    p->sample = (clx_fit_sample){n, p->block, NULL, m, p->candidate};
done:
    return status;
}

/// Selects features on a part of the beds, and fits them.
static clast_status fit_part(const part *p, const clast_porosity_fit_config *config, clx_fit *f,
                             clx_least_squares *ls)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_fit_begin(&p->sample, config, f));
    CLX_TRY(clx_fit_select(f));
    const int32_t n_column = clx_fit_design(f, -1);
    CLX_TRY(clx_least_squares_fit(&(clx_regression){f->x, f->y, f->n, n_column}, ls));
done:
    return status;
}

typedef struct {
    const clx_fit *fit;
    clast_porosity_fit_config config; ///< borrowed texts; folds of the smallest training set
    double *held_out, *mean;          ///< [n_repeat][n] prediction, mean of the training set
    clx_fit_validity *validity;
} validation;

/// Task k: fold k % n_fold of repeat k / n_fold.
static clast_status predict_folds(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_status status = CLAST_OK;
    const validation *v = context;
    const clx_fit *fit = v->fit;
    part p = {0};
    clx_fit f = {0};
    clx_least_squares ls = {0};
    (void)worker;
    for (int64_t k = begin; k < end; ++k) {
        const int64_t first = k / fit->config->n_fold * fit->n;
        const int32_t fold = (int32_t)(k % fit->config->n_fold);
        CLX_TRY(gather_part(fit, fit->fold + first, fold, &p));
        CLX_TRY(fit_part(&p, &v->config, &f, &ls));
        const double mean = clx_sample_moments(p.sample.y, p.sample.n).mean;
        for (int64_t i = 0; i < fit->n; ++i) {
            double sum = ls.b[0];
            if (fit->fold[first + i] != fold) {
                continue;
            }
            for (int32_t t = 0; t < f.n_chosen; ++t) {
                sum += ls.b[1 + t] * fit->candidate[p.index[f.chosen[t]]].number[i];
            }
            v->held_out[first + i] = sum;
            v->mean[first + i] = mean;
        }
        clx_least_squares_free(&ls);
        clx_fit_end(&f);
        free_part(&p);
    }
done:
    if (status != CLAST_OK) {
        clx_fail_prefix("selection without the held-out beds (--validation published leaves it "
                        "out)");
    }
    clx_least_squares_free(&ls);
    clx_fit_end(&f);
    free_part(&p);
    return status;
}

/// Porosities in an order drawn from (seed, permutation).               [Durstenfeld1964]
static void permute(double *y, int64_t n, uint64_t seed, int64_t permutation)
{
    CLAST_ASSERT(n > 0);
    clx_rng rng = clx_rng_at(seed, CLX_STREAM_PERMUTATION, (uint64_t)permutation);
    for (int64_t i = n - 1; i > 0; --i) {
        const int64_t j = clx_rng_below(&rng, i + 1);
        const double other = y[j];
        y[j] = y[i];
        y[i] = other;
    }
}

static clast_status fit_permutations(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_status status = CLAST_OK;
    const validation *v = context;
    clx_fit_validity *out = v->validity;
    part p = {0};
    clx_fit f = {0};
    clx_least_squares ls = {0};
    (void)worker;
    for (int64_t k = begin; k < end; ++k) {
        CLX_TRY(gather_part(v->fit, NULL, -1, &p));
        permute(p.block, p.sample.n, v->config.seed, k);
        CLX_TRY(fit_part(&p, v->fit->config, &f, &ls));
        out->r2[k] = ls.r2;
        for (int32_t j = 0; j < f.m; ++j) {
            out->greatest[k] = fmax(out->greatest[k], isnan(f.r[j]) ? 0.0 : fabs(f.r[j]));
        }
        clx_least_squares_free(&ls);
        clx_fit_end(&f);
        free_part(&p);
    }
done:
    clx_least_squares_free(&ls);
    clx_fit_end(&f);
    free_part(&p);
    return status;
}

/// Errors of the predictions of all repeats.
static clast_status score(const validation *v)
{
    clast_status status = CLAST_OK;
    const clx_fit *fit = v->fit;
    const int32_t n_repeat = fit->config->n_repeat;
    clx_fit_validity *out = v->validity;
    double *error = NULL;
    double about_fit = 0.0;
    double about_mean = 0.0;
    out->mean_error = out->median_error = 0.0;
    CLX_TRY(clx_alloc(&error, fit->n, sizeof *error));
    for (int32_t k = 0; k < n_repeat; ++k) {
        double sum = 0.0;
        for (int64_t i = 0; i < fit->n; ++i) {
            const double e = fit->y[i] - v->held_out[k * fit->n + i];
            const double m = fit->y[i] - v->mean[k * fit->n + i];
            error[i] = fabs(e);
            sum += error[i];
            about_fit += e * e;
            about_mean += m * m;
        }
        CLX_TRY(clx_sort_doubles(error, fit->n));
        out->mean_error += sum / (double)fit->n / n_repeat;
        out->median_error += clx_sample_quantile(error, fit->n, 0.5) / n_repeat;
    }
    out->r2_held_out = 1.0 - about_fit / about_mean;
    for (int64_t i = 0; i < fit->n; ++i) {
        out->held_out[i] = v->held_out[i];
    }
done:
    clx_free(error);
    return status;
}

/// Errors of held-out beds, the features selected without them.
static clast_status validate_nested(validation *v)
{
    clast_status status = CLAST_OK;
    const clx_fit *fit = v->fit;
    const clast_porosity_fit_config *c = fit->config;
    CLX_TRY(clx_alloc(&v->held_out, fit->n * c->n_repeat, sizeof *v->held_out));
    CLX_TRY(clx_alloc(&v->mean, fit->n * c->n_repeat, sizeof *v->mean));
    CLX_TRY(clx_alloc(&v->validity->held_out, fit->n, sizeof *v->validity->held_out));
    CLX_TRY(clx_parallel_try((int64_t)c->n_fold * c->n_repeat, 1, predict_folds, v));
    CLX_TRY(score(v));
done:
    CLX_FREE(v->held_out, v->mean);
    v->held_out = v->mean = NULL;
    return status;
}

clast_status clx_fit_validate(const clx_fit *fit, clx_fit_validity *validity)
{
    clast_status status = CLAST_OK;
    const clast_porosity_fit_config *c = fit->config;
    clx_fit_validity out = {.mean_error = NAN, .median_error = NAN, .r2_held_out = NAN};
    validation v = {.fit = fit, .config = *c, .validity = &out};
    const int64_t least = fit->n - (fit->n + c->n_fold - 1) / c->n_fold;
    v.config.n_fold = c->n_fold < least ? c->n_fold : (int32_t)least;
    CLX_TRY(clx_alloc(&out.r2, c->n_permutation, sizeof *out.r2));
    CLX_TRY(clx_alloc(&out.greatest, c->n_permutation, sizeof *out.greatest));
    if (c->validation == CLAST_VALIDATION_NESTED) {
        CLX_TRY(validate_nested(&v));
    }
    CLX_TRY(clx_parallel_try(c->n_permutation, 1, fit_permutations, &v));
    *validity = out;
    out = (clx_fit_validity){0};
done:
    clx_fit_validity_free(&out);
    return status;
}

void clx_fit_validity_free(clx_fit_validity *validity)
{
    CLX_FREE(validity->held_out, validity->r2, validity->greatest);
    *validity = (clx_fit_validity){0};
}

double clx_fit_share(const double *value, int32_t n, double x)
{
    int32_t count = 0;
    for (int32_t k = 0; k < n; ++k) {
        count += value[k] >= x * (1.0 - 1e-12) ? 1 : 0;
    }
    return n > 0 ? (1.0 + count) / (1.0 + n) : (double)NAN;
}
