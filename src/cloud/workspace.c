// Decompositions on the caller's arrays with memory, tests and cells that are kept.
#include <clast/workspace.h>

#include "base/alloc.h"
#include "cloud/contract.h"
#include "cloud/decompose_steps.h"
#include "cloud/reuse.h"
#include "cloud/uniformity.h"
#include "math/special.h"
#include <clast/agglomerate.h>
#include <clast/machine.h>
#include <math.h>
#include <string.h>

/// Points of a count of pairs: fewer seldom resolve a cloud.
enum { LEAST_COUNTED = 1000 };

#define FIELD(type, name) #name, .offset = offsetof(clast_workspace_policy, name), type
const clast_field clast_workspace_fields[] = {
    {FIELD(CLAST_FIELD_CHOICE, tests), CLAST_TESTS_EACH, 0, 0, "-",
     "when the uniformity tests are made; between them the last vote stands",
     "each|every|moved|never", .group = "loop"},
    {FIELD(CLAST_FIELD_I32, tests_every), 50, 1, 1e9, "-", "every: calls from test to test"},
    {FIELD(CLAST_FIELD_F64, tests_moved), 0.5, 0.0, 1e300, "-",
     "moved: standard errors that a mean or covariance moves before the tests are made again"},
    {FIELD(CLAST_FIELD_CHOICE, cells), CLAST_CUT_EACH, 0, 0, "-",
     "when points are cut into cells anew; between, the cells' points and events are counted anew",
     "each|every|changed"},
    {FIELD(CLAST_FIELD_I32, cells_every), 10, 1, 1e9, "-", "every: calls from cut to cut"},
    {FIELD(CLAST_FIELD_F64, cells_level), 0.05, 1e-12, 1.0, "-",
     "changed: level of the chi-square test of the counts since the cut"},
    {FIELD(CLAST_FIELD_I32, pairs_every), 0, 0, 1e9, "-",
     "calls at least between two counts of the pairs of a cloud that cells do not resolve; 0: at "
     "each cut"},
    {FIELD(CLAST_FIELD_I32, pairs_most), 0, 0, 1e9, "-",
     "points that a count of pairs takes at the most, of a greater cloud a part chosen by their "
     "places; 0: all, else at least 1000"},
    {0}};
#undef FIELD

struct clast_workspace {
    clx_pool *pool;
    clast_decomposition last; ///< in the pool, as all below
    int64_t n_point;          ///< of the last call; -1: there is none
    clast_workspace_policy policy;
    clast_workspace_calls calls;
    uint64_t setup;          ///< of the last call, clx_setup_of
    bool has_tests;          ///< `tests` and their moments stand
    bool has_cells;          ///< those of last, with what follows, may be filled again
    clast_uniformity tests;  ///< the last ones
    clx_moments tested;      ///< at the last tests
    clx_blocks counted;      ///< at the last cut
    clx_shown shown;         ///< by the pairs of the last cut
    int64_t since_pairs;     ///< calls since pairs by distance were counted
    int64_t n_cut;           ///< points at the last cut
    clast_uniformity cut_by; ///< vote at the last cut
    clx_cell_cache cache;
};

clast_status clast_workspace_create(clast_workspace **workspace)
{
    clast_status status = CLAST_OK;
    clast_workspace *made = NULL;
    CLX_NEED(workspace);
    CLX_TRY(clx_alloc(&made, 1, sizeof *made));
    CLX_TRY(clx_pool_create(&made->pool));
    made->n_point = -1;
    made->calls = (clast_workspace_calls){
        .since_test = -1, .since_cut = -1, .moved = (double)NAN, .p_change = (double)NAN};
    *workspace = made;
    made = NULL;
done:
    clx_free(made);
    return status;
}

void clast_workspace_destroy(clast_workspace *workspace)
{
    if (workspace != NULL) {
        clx_pool_destroy(workspace->pool);
        clx_free(workspace);
    }
}

/// Whether two coordinates are the same double: (di, dj) of them lie di stride = dj axis_stride
/// apart.
static bool overlap(const clast_points *p)
{
    bool is = false;
    for (int64_t j = 1; j < p->dimension; ++j) {
        is = is || (j * p->axis_stride % p->stride == 0 && j * p->axis_stride / p->stride < p->n);
    }
    return is;
}

static clast_status check_points(const clast_points *p)
{
    clast_status status = CLAST_OK;
    const int64_t most = INT64_C(1) << 40; // doubles between two points, or two coordinates
    CLX_CHECK(p->dimension >= 1 && p->dimension <= 3, CLAST_E_ARGUMENT,
              "points have 1, 2 or 3 dimensions, not %d", p->dimension);
    CLX_CHECK(p->n >= 0, CLAST_E_ARGUMENT, "%lld points", (long long)p->n);
    CLX_CHECK(p->n == 0 || p->x != NULL, CLAST_E_ARGUMENT, "%lld points, and x is NULL",
              (long long)p->n);
    CLX_CHECK(p->stride > 0 && p->stride <= most, CLAST_E_ARGUMENT,
              "the stride between points is %lld; 3 for xyzxyz..", (long long)p->stride);
    CLX_CHECK(p->dimension == 1 || (p->axis_stride > 0 && p->axis_stride <= most), CLAST_E_ARGUMENT,
              "the stride between coordinates is %lld; 1 for xyzxyz..", (long long)p->axis_stride);
    CLX_CHECK(!overlap(p), CLAST_E_ARGUMENT,
              "the strides %lld and %lld let points share coordinates", (long long)p->stride,
              (long long)p->axis_stride);
    CLX_CHECK(p->weight == NULL || (p->weight_stride > 0 && p->weight_stride <= most),
              CLAST_E_ARGUMENT, "the stride between weights is %lld", (long long)p->weight_stride);
done:
    return status;
}

/// The caller's points one behind the other; x and weight are the pool's, or borrowed when they lie
/// so already.
static clast_status gather(const clast_points *points, clast_cloud *cloud)
{
    clast_status status = CLAST_OK;
    const int32_t d = points->dimension;
    cloud->n = points->n;
    cloud->dimension = d;
    CLX_TRY(clx_alloc(&cloud->x, points->n, (size_t)d * sizeof *cloud->x));
    for (int64_t i = 0; i < points->n; ++i) {
        for (int32_t j = 0; j < d; ++j) {
            cloud->x[i * d + j] = points->x[i * points->stride + j * points->axis_stride];
        }
    }
    if (points->weight != NULL) {
        CLX_TRY(clx_alloc(&cloud->weight, points->n, sizeof *cloud->weight));
        for (int64_t i = 0; i < points->n; ++i) {
            cloud->weight[i] = points->weight[i * points->weight_stride];
        }
    }
done:
    return status;
}

/// One call: the caller's points and what of the call before still stands.
typedef struct {
    clast_workspace *workspace;
    const clast_decompose_config *config;
    clast_cloud cloud;
    clx_sample sample; ///< points alone, until it is complete
    bool is_complete;  ///< thinned out for weights, filled up by ghosts
    bool is_test, is_cut;
    clx_moments moments;
    clx_blocks blocks;
    double moved, p_change; ///< NAN: not measured
    clast_decomposition made;
} call;

/// How many standard errors of a normal law the vote is from turning, at the level of the tests and
/// at that of a tree's root; 38 at the most, where p ends.
static double vote_margin(const clast_uniformity *tests, const clast_decompose_config *config)
{
    CLAST_ASSERT(tests->n_test >= 0 && tests->n_test <= CLAST_N_TEST);
    double z[CLAST_N_TEST] = {0};
    for (int32_t k = 0; k < tests->n_test; ++k) { // descending
        const double own = -clx_normal_quantile(fmax(tests->vote[k].p, 1e-300));
        int32_t at = k;
        for (; at > 0 && z[at - 1] < own; --at) {
            z[at] = z[at - 1];
        }
        z[at] = own;
    }
    const int32_t needed = clx_uniformity_votes(config->votes, tests->n_test);
    if (tests->n_test < needed) {
        return 0.0;
    }
    const double last = z[needed - 1]; // whose vote decides
    return fmin(fabs(last + clx_normal_quantile(config->level)),
                fabs(last + clx_normal_quantile(config->tree_root_level)));
}

static bool is_test_due(call *c)
{
    const clast_workspace *w = c->workspace;
    const clast_workspace_policy *p = &w->policy;
    if (p->tests == CLAST_TESTS_MOVED) {
        clx_moments_of(&c->cloud, &c->sample, &c->moments);
    }
    if (p->tests == CLAST_TESTS_NEVER || p->tests == CLAST_TESTS_EACH || !w->has_tests) {
        return p->tests != CLAST_TESTS_NEVER;
    }
    if (p->tests == CLAST_TESTS_EVERY) {
        return w->calls.since_test + 1 >= p->tests_every;
    }
    c->moved = clx_moments_drift(&w->tested, &c->moments, c->cloud.dimension);
    return !(c->moved < p->tests_moved * fmax(1.0, vote_margin(&w->tests, c->config)));
}

static bool has_same_vote(const clast_uniformity *a, const clast_uniformity *b,
                          const clast_decompose_config *config)
{
    int32_t change = 0; // tests that reject at the level that splits a tree's root
    for (int32_t k = 0; k < a->n_test; ++k) {
        change += a->vote[k].p < config->tree_root_level ? 1 : 0;
    }
    for (int32_t k = 0; k < b->n_test; ++k) {
        change -= b->vote[k].p < config->tree_root_level ? 1 : 0;
    }
    return a->reject == b->reject && change == 0;
}

/// Whether the policy cuts at this call, before the vote is looked at.
static clast_status find_cut_due(call *c)
{
    clast_status status = CLAST_OK;
    const clast_workspace *w = c->workspace;
    const clast_workspace_policy *p = &w->policy;
    const int64_t n = c->sample.n;
    c->is_cut = !w->has_cells || p->cells == CLAST_CUT_EACH ||
                (p->cells == CLAST_CUT_EVERY && w->calls.since_cut + 1 >= p->cells_every) ||
                3 * n < 2 * w->n_cut || 2 * n > 3 * w->n_cut;
    if (p->cells == CLAST_CUT_CHANGED) {
        const int32_t levels =
            c->is_cut ? clx_blocks_levels(n, c->cloud.dimension) : w->counted.levels;
        CLX_TRY(clx_blocks_count(&c->cloud, &c->sample, levels, &c->blocks));
        if (!c->is_cut) {
            c->p_change = clx_blocks_change(&w->counted, &c->blocks);
            c->is_cut = c->p_change < p->cells_level;
        }
        if (c->is_cut && levels != clx_blocks_levels(n, c->cloud.dimension)) {
            CLX_TRY(clx_blocks_count(&c->cloud, &c->sample,
                                     clx_blocks_levels(n, c->cloud.dimension), &c->blocks));
        }
    }
done:
    return status;
}

static clast_status complete(call *c)
{
    const bool is_complete = c->is_complete;
    c->is_complete = true;
    return is_complete ? CLAST_OK : clx_sample_complete(&c->cloud, c->config, &c->sample);
}

static clast_status test(call *c)
{
    clast_status status = CLAST_OK;
    c->made.before = (clast_uniformity){.score = (double)NAN, .ideal = (double)NAN};
    if (c->is_test) {
        CLX_TRY(complete(c));
        CLX_TRY(clx_decompose_test(&c->sample, c->config, &c->made.before));
    } else if (c->workspace->has_tests) {
        c->made.before = c->workspace->tests;
    }
    c->is_cut = c->is_cut || !has_same_vote(&c->made.before, &c->workspace->cut_by, c->config);
done:
    return status;
}

/// The cells of the last cut with the points of this call; cut anew where they do not hold them.
static clast_status refill(call *c)
{
    clast_status status = CLAST_OK;
    clast_workspace *w = c->workspace;
    bool has_all = true;
    const clast_uniformity before = c->made.before;
    c->made = w->last;
    w->last = (clast_decomposition){0};
    c->made.before = before;
    c->made.n = c->sample.n_real;
    c->made.n_test = c->is_test ? c->sample.n_test : c->made.n_test;
    c->made.n_outside = c->cloud.n - c->sample.n_real;
    c->made.n_here = c->cloud.n;
    c->made.events = c->made.events_low = c->made.events_high = 0.0;
    c->made.n_capped = 0;
    CLX_TRY(clx_cell_cache_refill(&w->cache, &c->sample, c->cloud.n, &c->made.cells, &has_all));
    if (!has_all) {
        clast_decomposition_free(&c->made);
        c->made.before = before;
        c->is_cut = true;
    }
done:
    return status;
}

static clast_status cut(call *c)
{
    clast_status status = CLAST_OK;
    clast_workspace *w = c->workspace;
    CLX_TRY(complete(c));
    CLX_TRY(clx_decompose_cells(&c->cloud, &c->sample, c->config, &c->made));
    if (w->policy.tests == CLAST_TESTS_NEVER && c->made.cells.key != NULL &&
        c->made.stop != CLAST_STOP_DEPTH) {
        c->made.stop = CLAST_STOP_SPARED;
    }
    if (w->policy.cells != CLAST_CUT_EACH) {
        CLX_TRY(clx_cell_cache_copy(&c->made.cells, c->cloud.dimension, &w->cache));
    }
done:
    return status;
}

/// Hands all over to the workspace.
static void hand_over(call *c, uint64_t setup)
{
    clast_workspace *w = c->workspace;
    w->last = c->made;
    c->made = (clast_decomposition){0};
    w->n_point = c->cloud.n;
    w->setup = setup;
    w->has_tests = w->has_tests || c->is_test;
    w->has_cells = w->policy.cells != CLAST_CUT_EACH;
    if (c->is_test) {
        w->tested = c->moments;
        w->tests = w->last.before;
    }
    if (c->is_cut) {
        w->n_cut = c->sample.n_real;
        w->cut_by = w->last.before;
        clx_blocks_free(&w->counted);
        w->counted = c->blocks;
        c->blocks = (clx_blocks){0};
    }
    ++w->calls.n_call;
    w->calls.n_test += c->is_test ? 1 : 0;
    w->calls.n_cut += c->is_cut ? 1 : 0;
    w->calls.since_test = c->is_test ? 0 : w->calls.since_test < 0 ? -1 : w->calls.since_test + 1;
    w->calls.since_cut = c->is_cut ? 0 : w->calls.since_cut + 1;
    w->since_pairs = w->shown.is_counted ? 0 : w->since_pairs + 1;
    w->calls.n_pairs += w->shown.is_counted ? 1 : 0;
    w->calls.moved = c->moved;
    w->calls.p_change = c->p_change;
}

static void forget(clast_workspace *w)
{
    w->has_tests = w->has_cells = w->shown.counted.is_known = false;
    w->cut_by = (clast_uniformity){0};
}

static clast_status run_call(call *c, const clast_domain *domain)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_sample_map(clast_comm_one(), &c->cloud, c->config, domain, &c->sample));
    c->is_test = is_test_due(c);
    CLX_TRY(find_cut_due(c));
    if (c->is_cut) {
        clast_decomposition_free(&c->workspace->last); // its blocks are this call's
    }
    CLX_TRY(test(c));
    if (!c->is_cut) {
        CLX_TRY(refill(c));
    }
    if (c->is_cut) {
        clast_decomposition_free(&c->workspace->last);
        CLX_TRY(cut(c));
    }
    if (c->is_cut) {
        c->workspace->shown.is_known = false;
    }
    c->workspace->shown.may_carry =
        c->workspace->since_pairs + 1 < c->workspace->policy.pairs_every;
    c->workspace->shown.pairs_most = c->workspace->policy.pairs_most;
    CLX_TRY(clx_decompose_events(&c->cloud, &c->sample, c->config, &c->workspace->shown, &c->made));
done:
    return status;
}

/// Whether the policy can be kept with this configuration.
static clast_status check_policy(const clast_workspace_policy *policy,
                                 const clast_decompose_config *config)
{
    clast_status status = CLAST_OK;
    const bool spares = policy->tests != CLAST_TESTS_EACH || policy->cells != CLAST_CUT_EACH;
    CLX_CHECK(!config->crossfit || !spares, CLAST_E_CONFIG,
              "crossfit cuts both halves at each call: it goes with the policy tests = each and "
              "cells = each alone");
    CLX_CHECK(policy->tests != CLAST_TESTS_NEVER || config->variant >= CLAST_VARIANT_FAST ||
                  clast_decompose_takes_tree(config),
              CLAST_E_CONFIG,
              "tests = never: these cells are cut where the tests reject; take mesh = tree, or "
              "variant = fast");
    CLX_CHECK(policy->pairs_most == 0 || policy->pairs_most >= LEAST_COUNTED, CLAST_E_CONFIG,
              "pairs_most = %d: a count of pairs takes %d points or more; 0 for all",
              policy->pairs_most, LEAST_COUNTED);
done:
    return status;
}

clast_status clast_workspace_decompose_in(clast_workspace *workspace, const clast_domain *domain,
                                          const clast_points *points,
                                          const clast_decompose_config *config,
                                          const clast_decomposition **result)
{
    CLX_ARGUMENTS(workspace, domain, points, config, result);
    CLX_FLOAT_ENVIRONMENT;
    clast_status status = CLAST_OK;
    call c = {
        .workspace = workspace, .config = config, .moved = (double)NAN, .p_change = (double)NAN};
    clx_pool *before = NULL;
    bool is_in = false;
    CLX_TRY(check_points(points));
    CLX_TRY(clx_decompose_check(domain, &(clast_cloud){.dimension = points->dimension}, config));
    CLX_TRY(check_policy(&workspace->policy, config));
    before = clx_pool_enter(workspace->pool);
    is_in = true;
    *result = NULL;
    workspace->n_point = -1;
    const uint64_t setup = clx_setup_of(domain, config);
    if (setup != workspace->setup) {
        forget(workspace);
    }
    CLX_TRY(gather(points, &c.cloud));
    CLX_TRY(run_call(&c, domain));
    hand_over(&c, setup);
    *result = &workspace->last;
done:
    if (is_in) {
        if (status != CLAST_OK) {
            forget(workspace);
            clast_decomposition_free(&workspace->last);
        }
        clast_decomposition_free(&c.made);
        clx_blocks_free(&c.blocks);
        clx_sample_free(&c.sample);
        clast_cloud_free(&c.cloud);
        (void)clx_pool_enter(before);
    }
    return status;
}

clast_status clast_workspace_decompose(clast_workspace *workspace, const clast_points *points,
                                       const clast_decompose_config *config,
                                       const clast_decomposition **result)
{
    CLX_ARGUMENTS(workspace, points, config, result);
    clast_status status = CLAST_OK;
    clast_domain domain = {0};
    CLX_TRY(clast_fields_check(clast_decompose_fields, config));
    CLX_TRY(check_points(points));
    CLX_TRY(clast_domain_parse(config->domain, &domain));
    CLX_TRY(clast_workspace_decompose_in(workspace, &domain, points, config, result));
done:
    return status;
}

clast_status clast_workspace_set_policy(clast_workspace *workspace,
                                        const clast_workspace_policy *policy)
{
    clast_status status = CLAST_OK;
    CLX_NEED(workspace);
    CLX_NEED(policy);
    CLX_TRY(clast_fields_check(clast_workspace_fields, policy));
    workspace->policy = *policy;
    forget(workspace);
done:
    return status;
}

clast_status clast_workspace_forget(clast_workspace *workspace)
{
    clast_status status = CLAST_OK;
    CLX_NEED(workspace);
    forget(workspace);
done:
    return status;
}

clast_status clast_workspace_count(const clast_workspace *workspace, clast_workspace_calls *calls)
{
    clast_status status = CLAST_OK;
    CLX_NEED(workspace);
    CLX_NEED(calls);
    *calls = workspace->calls;
done:
    return status;
}

clast_status clast_workspace_test(clast_workspace *workspace, const clast_points *points,
                                  const clast_decompose_config *config, clast_uniformity *result)
{
    CLX_ARGUMENTS(workspace, points, config, result);
    clast_status status = CLAST_OK;
    const clast_decomposition *made = NULL;
    CLX_TRY(clast_fields_check(clast_decompose_fields, config)); // before two are set
    const clast_workspace_policy policy = workspace->policy;
    clast_decompose_config alone = *config;
    alone.variant = CLAST_VARIANT_TEST;
    alone.crossfit = false;
    workspace->policy = (clast_workspace_policy){0};
    status = clast_workspace_decompose(workspace, points, &alone, &made);
    workspace->policy = policy;
    CLX_TRY(status);
    *result = made->before;
    workspace->n_point = -1; // of its cells nothing was asked
done:
    return status;
}

static clast_status check_output(const clast_workspace *workspace, const void *output,
                                 int64_t stride)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(workspace->n_point >= 0, CLAST_E_USAGE, "the workspace holds no decomposition yet");
    CLX_CHECK(workspace->n_point == 0 || output != NULL, CLAST_E_ARGUMENT,
              "%lld points, and the array to write is NULL", (long long)workspace->n_point);
    CLX_CHECK(stride > 0, CLAST_E_ARGUMENT, "the stride is %lld; 1 for an array without gaps",
              (long long)stride);
done:
    return status;
}

clast_status clast_workspace_cells(const clast_workspace *workspace, int64_t stride, int32_t *cell)
{
    CLX_ARGUMENTS(workspace, cell);
    const clast_status status = check_output(workspace, cell, stride);
    for (int64_t i = 0; status == CLAST_OK && i < workspace->n_point; ++i) {
        cell[i * stride] = workspace->last.cells.of_point[i];
    }
    return status;
}

clast_status clast_workspace_events(const clast_workspace *workspace, int64_t stride,
                                    double *events)
{
    CLX_ARGUMENTS(workspace, events);
    CLX_FLOAT_ENVIRONMENT;
    const clast_status status = check_output(workspace, events, stride);
    for (int64_t i = 0; status == CLAST_OK && i < workspace->n_point; ++i) {
        const clast_cells *cells = &workspace->last.cells;
        const int32_t c = cells->of_point[i];
        events[i * stride] = c >= 0 ? cells->events[c] / (double)cells->count[c] : 0.0;
    }
    return status;
}

clast_status clast_workspace_collide(clast_workspace *workspace, clast_population *particles,
                                     const clast_collide_cells *cells, clast_workspace_step step,
                                     const clast_collide_config *config, int64_t *n_event)
{
    CLX_ARGUMENTS(workspace, particles, cells, config);
    CLX_FLOAT_ENVIRONMENT;
    clx_pool *const before = clx_pool_enter(workspace->pool);
    const clast_status status =
        clast_collide(particles, cells, step.dt, step.step, config, n_event);
    (void)clx_pool_enter(before);
    return status;
}
