// Selection of features for a linear porosity model.                 [Rettinger2022 sec. 6.3, 7.2]
#include "porosity/fit.h"

#include "base/alloc.h"
#include "base/status.h"
#include "math/least_squares.h"
#include "math/sample.h"
#include "math/sort.h"
#include <clast/porosity_model.h>
#include <clast/table.h>
#include <math.h>
#include <string.h>

void clx_fit_end(clx_fit *fit)
{
    CLX_FREE(fit->r, fit->p, fit->state, fit->against, fit->rank, fit->chosen, fit->fold, fit->x,
             fit->held_out, fit->error);
    *fit = (clx_fit){0};
}

static clast_status allocate(clx_fit *f)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&f->r, f->m, sizeof *f->r));
    CLX_TRY(clx_alloc(&f->p, f->m, sizeof *f->p));
    CLX_TRY(clx_alloc(&f->state, f->m, sizeof *f->state));
    CLX_TRY(clx_alloc(&f->against, f->m, sizeof *f->against));
    CLX_TRY(clx_alloc(&f->rank, f->m, sizeof *f->rank));
    CLX_TRY(clx_alloc(&f->chosen, f->m, sizeof *f->chosen));
    CLX_TRY(clx_alloc(&f->fold, f->n * f->config->n_repeat, sizeof *f->fold));
    CLX_TRY(clx_alloc(&f->x, f->n * (f->m + 1), sizeof *f->x));
    CLX_TRY(clx_alloc(&f->held_out, f->n, sizeof *f->held_out));
    CLX_TRY(clx_alloc(&f->error, f->n, sizeof *f->error));
done:
    return status;
}

static void judge(clx_fit *f, int32_t j)
{
    CLAST_ASSERT(j >= 0 && j < f->m);
    int64_t n_used = 0;
    const double *x = f->candidate[j].number;
    f->r[j] = clx_sample_correlation(x, f->y, f->n, &n_used);
    f->p[j] = clx_correlation_p(f->r[j], n_used);
    f->state[j] = CLX_CANDIDATE_KEPT;
    if (n_used < f->n) {
        f->state[j] = CLX_CANDIDATE_NOT_FINITE;
    } else if (isnan(f->r[j]) || clx_sample_moments(x, f->n).is_constant) { // whatever n is
        f->state[j] = CLX_CANDIDATE_CONSTANT;
        f->r[j] = f->p[j] = NAN;
    }
}

/// Insertion sort, stable: of equals the first stays first.
static void rank_all(clx_fit *f)
{
    for (int32_t j = 0; j < f->m; ++j) {
        const double size = isnan(f->r[j]) ? -1.0 : fabs(f->r[j]);
        int32_t k = j;
        for (; k > 0; --k) {
            const double before = f->r[f->rank[k - 1]];
            if ((isnan(before) ? -1.0 : fabs(before)) >= size) {
                break;
            }
            f->rank[k] = f->rank[k - 1];
        }
        f->rank[k] = j;
    }
}

clast_status clx_fit_begin(const clx_fit_sample *sample, const clast_porosity_fit_config *config,
                           clx_fit *fit)
{
    clast_status status = CLAST_OK;
    clx_fit f = {.config = config,
                 .n = sample->n,
                 .row = sample->row,
                 .y = sample->y,
                 .m = sample->m,
                 .candidate = sample->candidate};
    const clx_moments m = clx_sample_moments(f.y, f.n);
    CLX_CHECK(f.m > 0, CLAST_E_FORMAT, "fit: the table has no column besides the porosity");
    CLX_CHECK(f.n >= config->n_fold && f.n >= 4, CLAST_E_FORMAT,
              "fit: %lld beds are too few for %d folds; give more beds or fewer --n-fold",
              (long long)f.n, config->n_fold);
    CLX_CHECK(!m.is_constant, CLAST_E_FORMAT, "fit: all %lld beds have the same porosity %g",
              (long long)f.n, m.mean);
    CLX_TRY(allocate(&f));
    for (int32_t k = 0; k < config->n_repeat; ++k) {
        CLX_TRY(clx_folds(config->seed, k, f.n, config->n_fold, f.fold + k * f.n));
    }
    for (int32_t j = 0; j < f.m; ++j) {
        judge(&f, j);
    }
    rank_all(&f);
    *fit = f;
    f = (clx_fit){0};
done:
    clx_fit_end(&f);
    return status;
}

int32_t clx_fit_design(clx_fit *fit, int32_t more)
{
    CLAST_ASSERT(more < fit->m && fit->n_chosen <= fit->m);
    const int32_t p = 1 + fit->n_chosen + (more >= 0 ? 1 : 0);
    for (int64_t i = 0; i < fit->n; ++i) {
        double *row = fit->x + i * p;
        row[0] = 1.0;
        for (int32_t k = 0; k < fit->n_chosen; ++k) {
            row[1 + k] = fit->candidate[fit->chosen[k]].number[i];
        }
        if (more >= 0) {
            row[p - 1] = fit->candidate[more].number[i];
        }
    }
    return p;
}

clast_status clx_fit_score(clx_fit *fit, int32_t p, double *mean, double *median)
{
    CLAST_ASSERT(p >= 1 && p <= fit->m + 1);
    clast_status status = CLAST_OK;
    const clx_regression data = {fit->x, fit->y, fit->n, p};
    const int32_t n_repeat = fit->config->n_repeat;
    double sum[2] = {0.0};
    for (int32_t k = n_repeat - 1; k >= 0; --k) { // the first repeat's predictions stay
        CLX_TRY(
            clx_cross_validate(&data, fit->fold + k * fit->n, fit->config->n_fold, fit->held_out));
        double total = 0.0;
        for (int64_t i = 0; i < fit->n; ++i) {
            fit->error[i] = fabs(fit->held_out[i] - fit->y[i]);
            total += fit->error[i];
        }
        CLX_TRY(clx_sort_doubles(fit->error, fit->n));
        sum[0] += total / (double)fit->n;
        sum[1] += clx_sample_quantile(fit->error, fit->n, 0.5);
    }
    *mean = sum[0] / n_repeat;
    *median = sum[1] / n_repeat;
done:
    return status;
}

static clast_status note_trial(clx_fit *f, int32_t candidate, double mean, double median, double r2)
{
    clast_status status = CLAST_OK;
    clast_table *t = f->trials;
    const int64_t k = t != NULL ? t->n_row : 0;
    if (t == NULL) {
        return CLAST_OK;
    }
    const double value[4] = {f->n_chosen + 1.0, mean, median, r2};
    CLX_TRY(clast_table_resize(t, k + 1));
    CLX_TRY(clast_table_set_text(t, 0, k, f->candidate[candidate].name));
    for (int c = 0; c < 4; ++c) {
        t->column[1 + c].number[k] = value[c];
    }
done:
    return status;
}

/// Scores the model with one candidate more. Candidates that depend on the chosen ones score NaN.
static clast_status try_candidate(clx_fit *f, int32_t candidate, double *score)
{
    clast_status status = CLAST_OK;
    clx_least_squares ls = {0};
    double mean = NAN;
    double median = NAN;
    double r2 = NAN;
    const int32_t p = clx_fit_design(f, candidate);
    const clx_regression data = {f->x, f->y, f->n, p};
    status = clx_fit_score(f, p, &mean, &median);
    status = status == CLAST_OK ? clx_least_squares_fit(&data, &ls) : status;
    if (status == CLAST_E_FORMAT) {
        status = CLAST_OK;
        mean = median = NAN;
    } else if (status == CLAST_OK) {
        r2 = ls.r2;
    }
    *score = f->config->score == CLAST_SCORE_MEDIAN ? median : mean;
    if (status == CLAST_OK) {
        status = note_trial(f, candidate, mean, median, r2);
    }
    clx_least_squares_free(&ls);
    return status;
}

static void choose(clx_fit *f, int32_t candidate)
{
    CLAST_ASSERT(candidate >= 0 && candidate < f->m && f->n_chosen < f->m);
    f->chosen[f->n_chosen++] = candidate;
    f->state[candidate] = CLX_CANDIDATE_CHOSEN;
    for (int32_t j = 0; j < f->m; ++j) {
        int64_t n_used = 0;
        if (f->state[j] != CLX_CANDIDATE_KEPT) {
            continue;
        }
        const double r = clx_sample_correlation(f->candidate[j].number,
                                                f->candidate[candidate].number, f->n, &n_used);
        if (fabs(r) > f->config->correlation_limit) {
            f->state[j] = CLX_CANDIDATE_REMOVED;
            f->against[j] = candidate;
        }
    }
}

static clast_status choose_named(clx_fit *f)
{
    clast_status status = CLAST_OK;
    for (const char *at = f->config->use; *at != '\0';) {
        const size_t length = strcspn(at, ",");
        int32_t found = -1;
        for (int32_t j = 0; j < f->m; ++j) {
            const char *name = f->candidate[j].name;
            found = strlen(name) == length && strncmp(name, at, length) == 0 ? j : found;
        }
        CLX_CHECK(found >= 0, CLAST_E_FORMAT, "fit: there is no feature '%.*s'", (int)length, at);
        CLX_CHECK(f->state[found] == CLX_CANDIDATE_KEPT || f->state[found] == CLX_CANDIDATE_REMOVED,
                  CLAST_E_FORMAT,
                  "fit: feature '%.*s' is constant, not finite in some row or twice in the list",
                  (int)length, at);
        double score = 0.0;
        CLX_TRY(try_candidate(f, found, &score));
        choose(f, found);
        at += length + (at[length] == ',' ? 1 : 0);
    }
done:
    return status;
}

clast_status clx_fit_select(clx_fit *fit)
{
    clast_status status = CLAST_OK;
    double score = NAN;
    if (fit->config->use[0] != '\0') {
        return choose_named(fit);
    }
    int32_t best = -1;
    for (int32_t k = fit->m - 1; k >= 0; --k) {
        best = fit->state[fit->rank[k]] == CLX_CANDIDATE_KEPT ? fit->rank[k] : best;
    }
    CLX_CHECK(best >= 0, CLAST_E_FORMAT,
              "fit: every one of the %d features is constant or not finite in some row", fit->m);
    CLX_TRY(try_candidate(fit, best, &score));
    choose(fit, best);
    while (fit->n_chosen < fit->config->n_term) {
        double least = HUGE_VAL;
        best = -1;
        for (int32_t j = 0; j < fit->m; ++j) {
            if (fit->state[j] != CLX_CANDIDATE_KEPT) {
                continue;
            }
            CLX_TRY(try_candidate(fit, j, &score));
            best = score < least ? j : best;
            least = score < least ? score : least;
        }
        if (best < 0) {
            break; // nothing is left that adds anything
        }
        choose(fit, best);
    }
done:
    return status;
}
