// What a fit's nodes say together: interpolation, chi2, weights.
#include "aggregate/fit.h"

#include "base/alloc.h"
#include <math.h>
#include <stdlib.h>

/// Relative scatter of repeats, pooled over all grown nodes: a few repeats at one node know it
/// poorly.
static double pooled_scatter(const clx_fit *fit, int32_t observable)
{
    CLAST_ASSERT(observable >= 0 && observable < CLX_FIT_N_MODEL);
    double sum = 0.0;
    int32_t n = 0;
    for (int32_t i = 0; i < fit->n_node; ++i) {
        const clx_fit_node *node = &fit->node[i];
        if (node->n_run > 0) {
            const double share = node->deviation[observable] / node->mean[observable];
            sum += share * share;
            ++n;
        }
    }
    return n > 0 ? sqrt(sum / n) : 0.0;
}

static double total_error(const clx_fit *fit, int32_t observable, double model)
{
    // one observed aggregate scatters like one repeat; the model's mean like one over their root
    const double scatter = pooled_scatter(fit, observable) * model;
    const double repeats = fit->config->fit_repeats;
    return sqrt(fit->error[observable] * fit->error[observable] +
                scatter * scatter * (1.0 + 1.0 / repeats));
}

static int by_place(const void *p, const void *q)
{
    const clx_fit_node *a = p;
    const clx_fit_node *b = q;
    if (a->level != b->level) {
        return a->level < b->level ? -1 : 1;
    }
    return (a->replicate > b->replicate) - (a->replicate < b->replicate);
}

static void sort_nodes(clx_fit *fit)
{
    qsort(fit->node, (size_t)fit->n_node, sizeof *fit->node, by_place);
}

/// Adds the N_A between neighbours of one packing, linear in ln N_A.
static clast_status fill_between(clx_fit *fit)
{
    clast_status status = CLAST_OK;
    const int32_t n_grown = fit->n_node;
    sort_nodes(fit);
    for (int32_t i = 0; i + 1 < n_grown; ++i) {
        if (fit->node[i].level != fit->node[i + 1].level) {
            continue;
        }
        const int32_t low = fit->node[i].replicate;
        const int32_t high = fit->node[i + 1].replicate;
        for (int32_t r = low + 1; r < high; ++r) {
            const double t = log((double)r / low) / log((double)high / low);
            clx_fit_node made = {.level = fit->node[i].level, .replicate = r};
            for (int k = 0; k < CLX_FIT_N_MODEL; ++k) {
                made.mean[k] = (1.0 - t) * fit->node[i].mean[k] + t * fit->node[i + 1].mean[k];
                made.deviation[k] =
                    (1.0 - t) * fit->node[i].deviation[k] + t * fit->node[i + 1].deviation[k];
            }
            CLX_TRY(clx_grow(&fit->node, &fit->node_capacity, (int64_t)fit->n_node + 1,
                             sizeof *fit->node));
            fit->node[fit->n_node++] = made;
        }
    }
    sort_nodes(fit);
done:
    return status;
}

void clx_fit_set_chi2(clx_fit *fit)
{
    for (int32_t i = 0; i < fit->n_node; ++i) {
        clx_fit_node *node = &fit->node[i];
        node->chi2 = 0.0;
        node->is_inside = true;
        for (int k = 0; k < CLAST_FIT_N_OBSERVABLE; ++k) {
            if (isfinite(fit->observed[k])) {
                const double off =
                    (node->mean[k] - fit->observed[k]) / total_error(fit, k, node->mean[k]);
                node->chi2 += off * off;
                node->is_inside = node->is_inside && fabs(off) <= 1.0;
            }
        }
    }
}

/// Weights under even chances for packings and ln N_A, summing to 1; returns the best node.
static int32_t set_weights(clx_fit *fit)
{
    CLAST_ASSERT(fit->n_node > 0);
    int32_t best = 0;
    double sum = 0.0;
    for (int32_t i = 1; i < fit->n_node; ++i) {
        best = fit->node[i].chi2 < fit->node[best].chi2 ? i : best;
    }
    for (int32_t i = 0; i < fit->n_node; ++i) {
        clx_fit_node *node = &fit->node[i];
        node->weight = exp(-0.5 * (node->chi2 - fit->node[best].chi2)) / node->replicate;
        sum += node->weight;
    }
    for (int32_t i = 0; i < fit->n_node; ++i) {
        fit->node[i].weight /= sum;
    }
    return best;
}

typedef struct weighed {
    double value, weight;
} weighed;

static int by_value(const void *p, const void *q)
{
    const weighed *a = p;
    const weighed *b = q;
    return (a->value > b->value) - (a->value < b->value);
}

/// A quantity of the nodes by weight; `list` is scratch [n_node] that holds the values. Where it
/// does not go one way with N_A the best may be its least or greatest value of all: the interval is
/// widened to it.
static clast_fit_estimate estimate(const clx_fit *fit, weighed *list, int32_t best)
{
    CLAST_ASSERT(best >= 0 && best < fit->n_node);
    clast_fit_estimate e = {.best = list[best].value};
    double squares = 0.0;
    double sum = 0.0;
    bool has_low = false;
    for (int32_t i = 0; i < fit->n_node; ++i) {
        list[i].weight = fit->node[i].weight;
        e.mean += list[i].weight * list[i].value;
    }
    for (int32_t i = 0; i < fit->n_node; ++i) {
        squares += list[i].weight * (list[i].value - e.mean) * (list[i].value - e.mean);
    }
    e.deviation = sqrt(squares);
    qsort(list, (size_t)fit->n_node, sizeof *list, by_value);
    e.high = list[fit->n_node - 1].value;
    for (int32_t i = 0; i < fit->n_node; ++i) {
        sum += list[i].weight;
        if (!has_low && sum >= 0.16) {
            e.low = list[i].value;
            has_low = true;
        }
        if (sum >= 0.84) {
            e.high = list[i].value;
            break;
        }
    }
    e.low = fmin(e.low, e.best);
    e.high = fmax(e.high, e.best);
    return e;
}

static clast_status estimate_all(const clx_fit *fit, int32_t best, clast_aggregate_fit *result)
{
    clast_status status = CLAST_OK;
    weighed *list = NULL;
    CLX_TRY(clx_alloc(&list, fit->n_node, sizeof *list));
    for (int32_t i = 0; i < fit->n_node; ++i) {
        const clx_fit_packing *p = &fit->packing[fit->node[i].level];
        list[i].value = log((double)p->rays * p->orientations);
    }
    result->trials = estimate(fit, list, best);
    result->trials.best = exp(result->trials.best);
    result->trials.mean = exp(result->trials.mean);
    result->trials.low = exp(result->trials.low);
    result->trials.high = exp(result->trials.high);
    for (int32_t i = 0; i < fit->n_node; ++i) {
        list[i].value = fit->node[i].replicate;
    }
    result->n_replica = estimate(fit, list, best);
    for (int k = 0; k < CLX_FIT_N_MODEL; ++k) {
        for (int32_t i = 0; i < fit->n_node; ++i) {
            list[i].value = fit->node[i].mean[k];
        }
        *(k == CLX_FIT_POROSITY ? &result->porosity : &result->model[k]) =
            estimate(fit, list, best);
    }
done:
    clx_free(list);
    return status;
}

/// Pulls at the best node and the range of all grown nodes.
static void compare(const clx_fit *fit, const clx_fit_node *best, clast_aggregate_fit *result)
{
    for (int k = 0; k < CLAST_FIT_N_OBSERVABLE; ++k) {
        result->observed[k] = fit->observed[k];
        result->error[k] = fit->error[k];
        result->least[k] = INFINITY;
        result->most[k] = -INFINITY;
        for (int32_t i = 0; i < fit->n_node; ++i) {
            if (fit->node[i].n_run > 0) {
                result->least[k] = fmin(result->least[k], fit->node[i].mean[k]);
                result->most[k] = fmax(result->most[k], fit->node[i].mean[k]);
            }
        }
        if (isfinite(fit->observed[k])) {
            result->pull[k] =
                (best->mean[k] - fit->observed[k]) / total_error(fit, k, best->mean[k]);
            ++result->n_observed;
        }
    }
}

clast_status clx_fit_weigh(clx_fit *fit, clast_aggregate_fit *result)
{
    clast_status status = CLAST_OK;
    clast_aggregate_fit made = {
        .n_level = fit->n_tried, .n_run = fit->n_run, .cut_short = fit->n_tried < fit->n_level};
    CLX_TRY(fill_between(fit));
    clx_fit_set_chi2(fit);
    const int32_t best = set_weights(fit);
    const clx_fit_node *node = &fit->node[best];
    const clx_fit_packing *packing = &fit->packing[node->level];
    made.cone = packing->cone;
    made.rays = packing->rays;
    made.orientations = packing->orientations;
    made.replicate = node->replicate;
    made.chi2 = node->chi2;
    made.at_level = node->level;
    compare(fit, node, &made);
    CLX_TRY(estimate_all(fit, best, &made));
    clx_fit_judge(fit, &made);
    *result = made;
done:
    return status;
}
