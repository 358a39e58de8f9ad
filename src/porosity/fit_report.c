// A fitted model with its tables and diagnostics.
#include "porosity/fit.h"

#include "base/alloc.h"
#include "base/status.h"
#include "math/least_squares.h"
#include "math/sample.h"
#include "math/special.h"
#include "porosity/model.h"
#include "porosity/unit_columns.h"
#include <clast/field.h>
#include <clast/porosity_model.h>
#include <clast/table.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { N_OWN = 2 }; // columns row and porosity before the candidates

void clast_porosity_fit_free(clast_porosity_fit *fit)
{
    if (fit == NULL) {
        return;
    }
    clast_porosity_model_free(&fit->model);
    clast_table_free(&fit->ranking);
    clast_table_free(&fit->trials);
    clast_table_free(&fit->terms);
    clast_table_free(&fit->rows);
    *fit = (clast_porosity_fit){0};
}

/// A table of one text column and number columns.
static clast_status start_table(clast_table *t, const char *name, int64_t n_row, const char *text,
                                const char *const *number, int n_number)
{
    clast_status status = CLAST_OK;
    double *unused = NULL;
    CLX_TRY(clast_table_init(t, name, n_row));
    if (text != NULL) {
        CLX_TRY(clast_table_add_text(t, text));
    }
    for (int k = 0; k < n_number; ++k) {
        CLX_TRY(clast_table_add_number(t, number[k], "-", &unused));
    }
done:
    return status;
}

static void state_text(const clx_fit *f, int32_t j, char *text, size_t size)
{
    static const char *const plain[] = {"kept", "not finite in some row", "constant", "", "chosen"};
    if (f->state[j] != CLX_CANDIDATE_REMOVED) {
        (void)snprintf(text, size, "%s", plain[f->state[j]]);
    } else {
        (void)snprintf(text, size, "removed: like %s", f->candidate[f->against[j]].name);
    }
}

static clast_status report_ranking(const clx_fit *f, const clx_fit_validity *v,
                                   clast_porosity_fit *out)
{
    static const char *const number[] = {"r", "p"};
    clast_status status = CLAST_OK;
    double *unused = NULL;
    clast_table *t = &out->ranking;
    CLX_TRY(start_table(t, "ranking", f->m, "feature", number, 2));
    CLX_TRY(clast_table_add_text(t, "state"));
    CLX_TRY(clast_table_add_number(t, "p_family", "-", &unused));
    for (int32_t k = 0; k < f->m; ++k) {
        char text[256];
        const int32_t j = f->rank[k];
        state_text(f, j, text, sizeof text);
        CLX_TRY(clast_table_set_text(t, 0, k, f->candidate[j].name));
        CLX_TRY(clast_table_set_text(t, 3, k, text));
        t->column[1].number[k] = f->r[j];
        t->column[2].number[k] = f->p[j];
        t->column[4].number[k] =
            isnan(f->r[j]) || f->state[j] == CLX_CANDIDATE_NOT_FINITE
                ? (double)NAN
                : clx_fit_share(v->greatest, f->config->n_permutation, fabs(f->r[j]));
        out->n_removed += f->state[j] == CLX_CANDIDATE_REMOVED ? 1 : 0;
    }
done:
    return status;
}

/// Variance inflation 1 / (1 - R^2) of column j of the design against the others; 1 for one
/// feature.
static clast_status inflation(const clx_fit *f, int32_t p, int32_t j, double *vif)
{
    CLAST_ASSERT(j >= 1 && j < p);
    clast_status status = CLAST_OK;
    clx_least_squares ls = {0};
    double *x = NULL;
    double *y = NULL;
    CLX_TRY(clx_alloc(&x, f->n * (p - 1), sizeof *x));
    CLX_TRY(clx_alloc(&y, f->n, sizeof *y));
    for (int64_t i = 0; i < f->n; ++i) {
        int32_t to = 0;
        for (int32_t k = 0; k < p; ++k) {
            if (k != j) {
                x[i * (p - 1) + to++] = f->x[i * p + k];
            }
        }
        y[i] = f->x[i * p + j];
    }
    CLX_TRY(clx_least_squares_fit(&(clx_regression){x, y, f->n, p - 1}, &ls));
    const clx_moments m = clx_sample_moments(y, f->n);
    const double total = m.deviation * m.deviation * (double)(f->n - 1);
    *vif = total / (ls.variance * (double)(ls.n - ls.p)); // 1 - r2 would cancel
done:
    clx_least_squares_free(&ls);
    CLX_FREE(x, y);
    return status;
}

static void bounds(const double *x, int64_t n, double *low, double *high)
{
    CLAST_ASSERT(n > 0);
    *low = *high = x[0];
    for (int64_t i = 1; i < n; ++i) {
        *low = fmin(*low, x[i]);
        *high = fmax(*high, x[i]);
    }
}

static clast_status report_terms(const clx_fit *f, const clx_least_squares *ls, clast_table *t)
{
    static const char *const number[] = {"coefficient", "standard_error", "t", "p", "vif", "low",
                                         "high"};
    clast_status status = CLAST_OK;
    const bool is_selected =
        f->config->use[0] == '\0' && f->config->validation == CLAST_VALIDATION_NESTED;
    CLX_TRY(start_table(t, "terms", ls->p, "term", number, 7));
    CLX_TRY(clast_table_add_text(t, "unit"));
    for (int32_t j = 0; j < ls->p; ++j) {
        const double error = sqrt(ls->covariance[j * (ls->p + 1)]);
        const double ratio = error > 0.0 ? ls->b[j] / error : HUGE_VAL;
        double value[7] = {ls->b[j], error, ratio, 0.0, NAN, NAN, NAN};
        value[3] = is_selected   ? (double)NAN
                   : error > 0.0 ? clx_student_two_sided(ratio, (double)(ls->n - ls->p))
                                 : 0.0;
        if (j > 0) {
            const clast_column *c = &f->candidate[f->chosen[j - 1]];
            CLX_TRY(inflation(f, ls->p, j, &value[4]));
            bounds(c->number, f->n, &value[5], &value[6]);
            CLX_TRY(clast_table_set_text(t, 0, j, c->name));
            CLX_TRY(clast_table_set_text(t, 8, j, clx_own_unit(c)));
        } else {
            CLX_TRY(clast_table_set_text(t, 0, j, "intercept"));
            CLX_TRY(clast_table_set_text(t, 8, j, "-"));
        }
        for (int k = 0; k < 7; ++k) {
            t->column[1 + k].number[j] = value[k];
        }
    }
done:
    return status;
}

static clast_status report_rows(const clx_fit *f, const clx_least_squares *ls, clast_table *t)
{
    static const char *const number[] = {"row",      "porosity", "fitted",      "residual",
                                         "held_out", "leverage", "studentised", "cook"};
    clast_status status = CLAST_OK;
    CLX_TRY(start_table(t, "rows", f->n, NULL, number, 8));
    for (int64_t i = 0; i < f->n; ++i) {
        const double residual = f->y[i] - ls->fitted[i];
        const double h = ls->leverage[i];
        const double scale = sqrt(ls->variance * fmax(1.0 - h, 1e-300));
        const double r = scale > 0.0 ? residual / scale : 0.0; // internally studentised
        const double k = (double)(ls->n - ls->p);
        const double outer = k > 1.0 && k > r * r ? r * sqrt((k - 1.0) / (k - r * r)) : r;
        const double cook = h < 1.0 ? r * r * h / (ls->p * (1.0 - h)) : HUGE_VAL;
        const double value[8] = {f->row[i],      f->y[i], ls->fitted[i], residual,
                                 f->held_out[i], h,       outer,         cook};
        for (int c = 0; c < 8; ++c) {
            t->column[c].number[i] = value[c];
        }
    }
done:
    return status;
}

/// Features besides the terms whose range says what the beds were like.
static int32_t landmark(const clx_fit *f, clast_model_kind kind, int k)
{
    static const char *const name[2][2] = {{"flatness", "elongation"},
                                           {"mean_flatness", "mean_elongation"}};
    for (int32_t j = 0; j < f->m && kind != CLAST_MODEL_COLUMNS; ++j) {
        if (strcmp(f->candidate[j].name, name[kind == CLAST_MODEL_MIXTURE ? 1 : 0][k]) == 0) {
            for (int32_t c = 0; c < f->n_chosen; ++c) {
                j = f->chosen[c] == j ? f->m : j;
            }
            return j < f->m ? j : -1;
        }
    }
    return -1;
}

/// Term k of the model; a column of the table with its unit.
static clast_status report_term(const clx_fit *f, clast_model_kind kind, int32_t k,
                                double coefficient, clast_model_term *term)
{
    clast_status status = CLAST_OK;
    const clast_column *c = &f->candidate[f->chosen[k]];
    term->coefficient = coefficient;
    CLX_TRY(clx_alloc_text(&term->feature, c->name));
    if (kind == CLAST_MODEL_COLUMNS) {
        CLX_TRY(clx_alloc_text(&term->unit, clx_own_unit(c)));
    }
done:
    return status;
}

static clast_status report_model(const clx_fit *f, clast_model_kind kind,
                                 const clx_least_squares *ls, clast_porosity_model *m)
{
    clast_status status = CLAST_OK;
    int32_t n = 0;
    m->kind = kind;
    m->intercept = ls->b[0];
    m->deviation = sqrt(ls->variance);
    m->n_bed = f->n;
    m->r2 = ls->r2;
    m->leverage_limit = 0.0;
    for (int64_t i = 0; i < ls->n; ++i) {
        m->leverage_limit = fmax(m->leverage_limit, ls->leverage[i]);
    }
    memcpy(m->covariance, ls->covariance, (size_t)ls->p * (size_t)ls->p * sizeof *ls->covariance);
    for (int32_t k = 0; k < f->n_chosen + 2; ++k) {
        const int32_t j = k < f->n_chosen ? f->chosen[k] : landmark(f, kind, k - f->n_chosen);
        if (j < 0) {
            continue;
        }
        CLX_TRY(clx_alloc_text(&m->range[n].feature, f->candidate[j].name));
        bounds(f->candidate[j].number, f->n, &m->range[n].low, &m->range[n].high);
        ++n;
        if (k < f->n_chosen) {
            CLX_TRY(report_term(f, kind, k, ls->b[1 + k], &m->term[k]));
        }
    }
    m->n_range = n;
done:
    return status;
}

/// Model and tables of the chosen features.
static clast_status report(clx_fit *fit, const clast_fit_data *data, clast_porosity_fit *out)
{
    clast_status status = CLAST_OK;
    clx_least_squares ls = {0};
    clx_fit_validity v = {0};
    clast_porosity_model *m = &out->model;
    const int32_t p = clx_fit_design(fit, -1);
    CLX_CHECK(fit->n > p, CLAST_E_FORMAT,
              "fit: %lld beds leave nothing to judge a model of %d features by", (long long)fit->n,
              p - 1);
    CLX_TRY(clx_fit_score(fit, p, &m->cv_mean_error, &m->cv_median_error));
    CLX_TRY(clx_least_squares_fit(&(clx_regression){fit->x, fit->y, fit->n, p}, &ls));
    out->condition = ls.condition;
    CLX_TRY(report_model(fit, data->kind, &ls, m));
    CLX_TRY(clx_fit_validate(fit, &v));
    out->p_value = clx_fit_share(v.r2, fit->config->n_permutation, ls.r2);
    out->r2_held_out = v.r2_held_out; // NaN of the paper's way
    if (fit->config->validation == CLAST_VALIDATION_NESTED) {
        m->cv_mean_error = v.mean_error;
        m->cv_median_error = v.median_error;
        memcpy(fit->held_out, v.held_out, (size_t)fit->n * sizeof *fit->held_out);
    }
    CLX_TRY(report_ranking(fit, &v, out));
    CLX_TRY(report_terms(fit, &ls, &out->terms));
    CLX_TRY(report_rows(fit, &ls, &out->rows));
done:
    clx_fit_validity_free(&v);
    clx_least_squares_free(&ls);
    return status;
}

clast_status clast_porosity_fit_data(const clast_fit_data *data, const char *name,
                                     const char *source, const clast_porosity_fit_config *config,
                                     clast_porosity_fit *fit)
{
    CLX_ARGUMENTS(data, config, name, source, fit);
    CLX_WHOLE(table, &data->beds);
    if ((unsigned)data->kind > CLAST_MODEL_COLUMNS || data->beds.n_column < 2) {
        return clx_fail(CLAST_E_ARGUMENT, "%s: data of an unknown kind, or without porosities",
                        __func__);
    }
    for (int32_t c = 0; c < data->beds.n_column; ++c) {
        CLX_ARRAY(data->beds.column[c].number, data->beds.n_row);
    }
    CLX_GUARD(clast_fields_check(clast_porosity_fit_fields, config));
    static const char *const number[] = {"step", "cv_mean_error", "cv_median_error", "r2"};
    clast_status status = CLAST_OK;
    clast_porosity_fit out = {0};
    clx_fit f = {0};
    const clx_fit_sample sample = {data->beds.n_row, data->beds.column[1].number,
                                   data->beds.column[0].number, data->beds.n_column - N_OWN,
                                   data->beds.column + N_OWN};
    CLX_TRY(clx_fit_begin(&sample, config, &f));
    CLX_TRY(start_table(&out.trials, "trials", 0, "feature", number, 4));
    f.trials = &out.trials;
    CLX_TRY(clx_fit_select(&f));
    CLX_TRY(clx_model_alloc(name, source, f.n_chosen, f.n_chosen + 2, true, &out.model));
    CLX_TRY(report(&f, data, &out));
    *fit = out;
    out = (clast_porosity_fit){0};
done:
    clx_fit_end(&f);
    clast_porosity_fit_free(&out);
    return status;
}
