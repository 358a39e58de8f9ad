// Fitting an aggregate to an observation: packings from loose to tight, N_A bracketed at each.
#include "aggregate/fit.h"

#include "base/alloc.h"
#include "base/monitor.h"
#include "base/parallel.h"
#include <clast/assembly.h>
#include <clast/settling.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    N_BETWEEN = 3, ///< nodes grown within a bracket
    HOPELESS = 50  ///< rise of chi2 that ends the path when it comes twice
};

static const char *const PHASE = "fit: aggregates";

void clx_fit_free(clx_fit *fit)
{
    CLX_FREE(fit->packing, fit->node);
    *fit = (clx_fit){0};
}

/// One aggregate of a node, grown by one worker.
typedef struct job {
    const clx_fit *fit;
    clast_aggregate_config config; ///< borrows the lists and texts of the fit's
    int32_t n;
    double (*value)[CLX_FIT_N_MODEL]; ///< [n]
} job;

static clast_status measure_grown(const clast_aggregate *aggregate, double value[CLX_FIT_N_MODEL])
{
    clast_status status = CLAST_OK;
    const clast_fluid air = clast_fluid_air();
    clast_aggregate_result result;
    clast_extent extent;
    clast_drag drag;
    clast_settling fall;
    CLX_TRY(clast_aggregate_measure(aggregate, &result));
    CLX_TRY(clast_assembly_extent(clast_aggregate_assembly(aggregate), &extent));
    CLX_TRY(clast_drag_of_form(extent.width[0], extent.width[1], extent.width[2], result.d_agg,
                               result.density / air.density, &drag));
    CLX_TRY(clast_terminal_velocity(result.d_agg, result.density, &drag, &air, &fall));
    value[CLAST_FIT_SIZE] = result.d_agg;
    value[CLAST_FIT_DENSITY] = result.density;
    value[CLAST_FIT_VELOCITY] = fall.velocity;
    value[CLX_FIT_POROSITY] = result.porosity[0];
done:
    return status;
}

static clast_status grow_one(const job *j, int32_t repeat, double value[CLX_FIT_N_MODEL])
{
    clast_status status = CLAST_OK;
    clast_aggregate *aggregate = NULL;
    CLX_TRY(clast_aggregate_create(&j->config.params, j->fit->input, repeat, &aggregate));
    while (!clast_aggregate_is_done(aggregate)) {
        CLX_TRY(clast_aggregate_grow(aggregate, 1 << 20, NULL));
    }
    CLX_TRY(measure_grown(aggregate, value));
done:
    clast_aggregate_destroy(aggregate);
    return status;
}

static clast_status grow_some(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_status status = CLAST_OK;
    job *j = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        CLX_TRY(grow_one(j, (int32_t)i, j->value[i]));
    }
done:
    return status;
}

static void summarise(const job *j, clx_fit_node *node)
{
    node->n_run = j->n;
    for (int k = 0; k < CLX_FIT_N_MODEL; ++k) {
        double sum = 0.0;
        double squares = 0.0;
        for (int32_t i = 0; i < j->n; ++i) {
            sum += j->value[i][k];
        }
        node->mean[k] = sum / j->n;
        for (int32_t i = 0; i < j->n; ++i) {
            const double d = j->value[i][k] - node->mean[k];
            squares += d * d;
        }
        node->deviation[k] = sqrt(squares / (j->n - 1));
    }
}

static clast_status run_job(job *j)
{
    CLAST_ASSERT(j->n > 0);
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&j->value, j->n, sizeof *j->value));
    CLX_TRY(clx_parallel_try(j->n, 1, grow_some, j));
done:
    return status;
}

/// Aggregates that the whole fit will grow, as far as can be told: a packing not yet searched
/// counts as those that were, the first one as all doublings of N_A and the values between.
static int32_t expected_runs(const clx_fit *fit, int32_t level)
{
    int32_t n_double = 1;
    for (int32_t n = 1; n < fit->config->fit_replicate_max && n_double < 32; ++n_double) {
        n *= 2;
    }
    const int32_t planned = (n_double + N_BETWEEN) * fit->config->fit_repeats;
    const double each = level > 0 ? (double)fit->n_run_before / level : planned;
    const double total = fit->n_run_before + each * (fit->n_level - level);
    const double least = fit->n_run + (double)fit->config->fit_repeats; // it is not the end yet
    return (int32_t)fmin(fmax(total, least), INT32_MAX);
}

static clast_status report(clx_fit *fit, int32_t level)
{
    clx_monitor_report(fit->monitor, PHASE, fit->n_run, expected_runs(fit, level));
    if (clx_monitor_stops(fit->monitor)) {
        return clx_fail(CLAST_E_STOPPED, "stopped after %d aggregates of the fit", fit->n_run);
    }
    return CLAST_OK;
}

/// Grows a node unless it has been; *node is valid until the next call.
static clast_status grow_node(clx_fit *fit, int32_t level, int32_t replicate,
                              const clx_fit_node **node)
{
    CLAST_ASSERT(level >= 0 && level < fit->n_level && replicate >= 1);
    clast_status status = CLAST_OK;
    const clx_fit_packing *packing = &fit->packing[level];
    clx_fit_node made = {.level = level, .replicate = replicate};
    job j = {.fit = fit, .config = *fit->config, .n = fit->config->fit_repeats};
    for (int32_t i = 0; i < fit->n_node; ++i) {
        if (fit->node[i].level == level && fit->node[i].replicate == replicate) {
            *node = &fit->node[i];
            return CLAST_OK;
        }
    }
    j.config.params.cone = packing->cone;
    j.config.params.rays = packing->rays;
    j.config.params.orientations = packing->orientations;
    j.config.params.replicate = replicate;
    j.config.params.envelope_every = 1000000000;
    CLX_TRY(clx_grow(&fit->node, &fit->node_capacity, (int64_t)fit->n_node + 1, sizeof *fit->node));
    CLX_TRY(run_job(&j));
    summarise(&j, &made);
    fit->n_run += j.n;
    fit->node[fit->n_node] = made;
    *node = &fit->node[fit->n_node++];
    CLX_TRY(report(fit, level));
done:
    clx_free(j.value);
    return status;
}

/// Widest deviation that still counts: three errors of the observed size and of the scatter.
static double size_margin(const clx_fit *fit, const clx_fit_node *node)
{
    return 3.0 * hypot(fit->error[CLAST_FIT_SIZE], node->deviation[CLAST_FIT_SIZE]);
}

/// -1, 0, 1: the node's aggregates are too small, may do, too large. Without an observed size all
/// may do.
static int judge_size(const clx_fit *fit, const clx_fit_node *node)
{
    const double off = node->mean[CLAST_FIT_SIZE] - fit->observed[CLAST_FIT_SIZE];
    const double margin = size_margin(fit, node);
    return off < -margin ? -1 : off > margin ? 1 : 0;
}

/// Doubles N_A until the aggregate is too large or the limit is met; then halves both ends of the
/// range of N_A that may do.
static clast_status bracket(clx_fit *fit, int32_t level, int32_t range[2])
{
    clast_status status = CLAST_OK;
    const int32_t limit = fit->config->fit_replicate_max;
    const clx_fit_node *node = NULL;
    int32_t low = 0;          // greatest that is too small
    int32_t high = limit + 1; // least that is too large
    int32_t within = 0;
    for (int32_t n = 1; n <= limit; n = n < limit && 2 * n > limit ? limit : 2 * n) {
        CLX_TRY(grow_node(fit, level, n, &node));
        const int verdict = judge_size(fit, node);
        low = verdict < 0 ? n : low;
        within = verdict == 0 && within == 0 ? n : within;
        if (verdict > 0) {
            high = n;
            break;
        }
    }
    int32_t inside =
        within > 0 ? within : high; // upper end of the search for the first that may do
    while (inside - low > 1) {
        const int32_t middle = low + (inside - low) / 2;
        CLX_TRY(grow_node(fit, level, middle, &node));
        *(judge_size(fit, node) < 0 ? &low : &inside) = middle;
    }
    int32_t last = within > inside ? within : inside;
    while (high - last > 1 && high <= limit) {
        const int32_t middle = last + (high - last) / 2;
        CLX_TRY(grow_node(fit, level, middle, &node));
        *(judge_size(fit, node) > 0 ? &high : &last) = middle;
    }
    range[0] = low > 1 ? low : 1;
    range[1] = high < limit ? high : limit;
done:
    return status;
}

static clast_status search_level(clx_fit *fit, int32_t level)
{
    CLAST_ASSERT(level >= 0 && level < fit->n_level);
    clast_status status = CLAST_OK;
    const clx_fit_node *node = NULL;
    const int32_t limit = fit->config->fit_replicate_max;
    int32_t range[2] = {1, limit};
    if (isfinite(fit->observed[CLAST_FIT_SIZE])) {
        CLX_TRY(bracket(fit, level, range));
    }
    for (int k = 0; k <= N_BETWEEN + 1; ++k) { // evenly in ln N_A, ends included
        const double n = range[0] * pow((double)range[1] / range[0], k / (N_BETWEEN + 1.0));
        CLX_TRY(grow_node(fit, level, (int32_t)lround(n), &node));
    }
done:
    return status;
}

/// Least chi2 of a packing's nodes.
static double level_chi2(const clx_fit *fit, int32_t level)
{
    double least = INFINITY;
    for (int32_t i = 0; i < fit->n_node; ++i) {
        if (fit->node[i].level == level) {
            least = fmin(least, fit->node[i].chi2);
        }
    }
    return least;
}

clast_status clx_fit_grow(clx_fit *fit)
{
    clast_status status = CLAST_OK;
    for (int32_t level = 0; level < fit->n_level; ++level) {
        double best = INFINITY;
        fit->n_run_before = fit->n_run;
        CLX_TRY(search_level(fit, level));
        fit->n_tried = level + 1;
        clx_fit_set_chi2(fit);
        for (int32_t k = 0; k <= level; ++k) {
            best = fmin(best, level_chi2(fit, k));
        }
        if (level > 0 && level_chi2(fit, level) > best + HOPELESS &&
            level_chi2(fit, level - 1) > best + HOPELESS) {
            break;
        }
    }
    clx_monitor_report(fit->monitor, PHASE, fit->n_run, fit->n_run);
done:
    return status;
}

/// A count after a ':' at *at; 0 when there is none. *at moves past it.
static int32_t parse_count(const char **at)
{
    char *end = NULL;
    if (**at != ':') {
        return 0;
    }
    const long n = strtol(*at + 1, &end, 10);
    const bool is_count = end != *at + 1 && n >= 1 && n <= 1000000;
    *at = end;
    return is_count ? (int32_t)n : 0;
}

static clast_status parse_packing(const char *text, clx_fit_packing *packing)
{
    char cone[64] = "";
    const size_t n = strcspn(text, ":");
    const char *at = text + n;
    if (n < sizeof cone) {
        memcpy(cone, text, n);
    }
    packing->rays = parse_count(&at);
    packing->orientations = parse_count(&at);
    if (packing->rays == 0 || packing->orientations == 0 || *at != '\0' ||
        clast_unit_parse_asked(cone, "rad", &packing->cone) != CLAST_OK ||
        !(packing->cone >= 0.0 && packing->cone <= CLAST_PI)) {
        return clx_fail(CLAST_E_CONFIG,
                        "fit_packing: '%s' is not cone:rays:orientations, like 50deg:30:10", text);
    }
    return CLAST_OK;
}

clast_status clx_fit_packings(clx_fit *fit)
{
    // trials double from step to step, over the half sphere; one trial has no use for its cone
    static const clx_fit_packing path[] = {
        {CLAST_PI / 180.0, 1, 1}, {0.5 * CLAST_PI, 2, 1}, {0.5 * CLAST_PI, 2, 2},
        {0.5 * CLAST_PI, 4, 2},   {0.5 * CLAST_PI, 4, 4}, {0.5 * CLAST_PI, 8, 4},
        {0.5 * CLAST_PI, 8, 8},
    };
    clast_status status = CLAST_OK;
    const clast_text_list *given = &fit->config->fit_packing;
    const int32_t n = given->n > 0 ? given->n : (int32_t)(sizeof path / sizeof path[0]);
    CLX_TRY(clx_alloc(&fit->packing, n, sizeof *fit->packing));
    for (int32_t i = 0; i < n; ++i) {
        if (given->n > 0) {
            CLX_TRY(parse_packing(given->item[i], &fit->packing[i]));
        } else {
            fit->packing[i] = path[i];
        }
        const clx_fit_packing *p = &fit->packing[i];
        CLX_CHECK(i == 0 ||
                      p->rays * (double)p->orientations >= p[-1].rays * (double)p[-1].orientations,
                  CLAST_E_CONFIG, "fit_packing: order the packings from few trials to many");
    }
    fit->n_level = n;
done:
    return status;
}
