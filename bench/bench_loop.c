// A step of a flow solver's loop, decomposed under each policy, on one thread: CPU milliseconds,
// median and mean over the steps, on a cloud that drifts. The plain twin is clast_decompose_in at
// each step.
//
//     bench_loop                    one row a size and policy; reference: the limits of a step
//     bench_loop error [n] [steps] [seed] [auto] [first cloud] [first policy]
//                                   what each policy costs and errs, on four drifting clouds:
//                                   events against those of the plain twin at the same step
//     bench_loop run N STEPS POLICY [CLOUD] [auto]
//                                   one policy alone, for a profiler; auto: by pairs where cells do
//                                   not resolve the cloud
#include "drifting.h"

#include <clast/cloud.h>
#include <clast/decompose.h>
#include <clast/machine.h>
#include <clast/pairs.h>
#include <clast/workspace.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static const struct {
    const char *name;
    clast_workspace_policy policy;
    const char *tests;
} policies[] = {
    {"each", {0, 1, 0, 0, 1, 0.05, 0, 0}, NULL},
    {"tests_pearson", {0, 1, 0, 0, 1, 0.05, 0, 0}, "pearson"},
    {"tests_every_50", {CLAST_TESTS_EVERY, 50, 0.5, 0, 1, 0.05, 0, 0}, NULL},
    {"tests_moved", {CLAST_TESTS_MOVED, 1, 0.5, 0, 1, 0.05, 0, 0}, NULL},
    {"tests_never", {CLAST_TESTS_NEVER, 1, 0.5, 0, 1, 0.05, 0, 0}, NULL},
    {"never_cut_every_10", {CLAST_TESTS_NEVER, 1, 0.5, CLAST_CUT_EVERY, 10, 0.05, 0, 0}, NULL},
    {"never_cut_changed", {CLAST_TESTS_NEVER, 1, 0.5, CLAST_CUT_CHANGED, 1, 0.05, 0, 0}, NULL},
    {"pairs_every_50", {CLAST_TESTS_NEVER, 1, 0.5, CLAST_CUT_EACH, 1, 0.05, 50, 0}, NULL},
    {"cut_10_pairs_50", {CLAST_TESTS_NEVER, 1, 0.5, CLAST_CUT_EVERY, 10, 0.05, 50, 0}, NULL},
    {"changed_pairs_50", {CLAST_TESTS_NEVER, 1, 0.5, CLAST_CUT_CHANGED, 1, 0.05, 50, 0}, NULL},
    {"changed_pairs_200", {CLAST_TESTS_NEVER, 1, 0.5, CLAST_CUT_CHANGED, 1, 0.05, 200, 0}, NULL},
    {"moved_cut_changed", {CLAST_TESTS_MOVED, 1, 0.5, CLAST_CUT_CHANGED, 1, 0.05, 0, 0}, NULL},
    {"changed_5000_of_pairs_50",
     {CLAST_TESTS_NEVER, 1, 0.5, CLAST_CUT_CHANGED, 1, 0.05, 50, 5000},
     NULL},
    {"cut_10_5000_of_pairs_50",
     {CLAST_TESTS_NEVER, 1, 0.5, CLAST_CUT_EVERY, 10, 0.05, 50, 5000},
     NULL}};
enum { N_POLICY = sizeof policies / sizeof policies[0], MOST_STEPS = 4000 };

/// By cells alone, or by pairs where these do not resolve the cloud: a cut is then dearer.
static clast_estimator estimator = CLAST_ESTIMATOR_CELLS;

typedef struct {
    clast_workspace *workspace;
    clast_decompose_config config;
    clast_domain domain;
    clast_points points;
} loop;

static double now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

static clast_status begin(int policy, const drifting *cloud, loop *l)
{
    clast_status status = clast_workspace_create(&l->workspace);
    if (status == CLAST_OK) {
        status = clast_fields_default(clast_decompose_fields, &l->config);
        l->config.estimator = estimator;
    }
    if (status == CLAST_OK && policies[policy].tests != NULL) {
        status = clast_field_set(clast_fields_find(clast_decompose_fields, "tests"), &l->config,
                                 policies[policy].tests, false);
    }
    if (status == CLAST_OK) {
        status = clast_domain_parse("box:0,0,0,1,1,1", &l->domain);
    }
    if (status == CLAST_OK) {
        status = clast_workspace_set_policy(l->workspace, &policies[policy].policy);
    }
    l->config.beta_dt = 1e-18; // far from the cap
    l->points =
        (clast_points){.n = cloud->n, .dimension = 3, .x = cloud->x, .stride = 3, .axis_stride = 1};
    return status;
}

static void end(loop *l)
{
    clast_workspace_destroy(l->workspace);
    clast_fields_free(clast_decompose_fields, &l->config);
}

static clast_workspace_calls calls; ///< of the last policy that was timed

/// CPU milliseconds of each step of a policy, ascending.
static clast_status time_steps(int policy, drifting_kind kind, int64_t n, int n_step, double *ms)
{
    drifting cloud = {0};
    loop l = {0};
    clast_status status = drifting_start(kind, n, 7, &cloud);
    if (status == CLAST_OK) {
        status = begin(policy, &cloud, &l);
    }
    for (int k = -3; k < n_step && status == CLAST_OK; ++k) { // three to warm up
        const clast_decomposition *made = NULL;
        const double begun = now();
        status = clast_workspace_decompose_in(l.workspace, &l.domain, &l.points, &l.config, &made);
        ms[k < 0 ? 0 : k] = now() - begun;
        drifting_advance(&cloud);
    }
    qsort(ms, (size_t)n_step, sizeof *ms, compare);
    (void)clast_workspace_count(l.workspace, &calls);
    end(&l);
    drifting_free(&cloud);
    return status;
}

static clast_status time_plain(drifting_kind kind, int64_t n, int n_step, double *ms)
{
    drifting cloud = {0};
    loop l = {0};
    clast_status status = drifting_start(kind, n, 7, &cloud);
    if (status == CLAST_OK) {
        status = begin(0, &cloud, &l);
    }
    for (int k = 0; k < n_step && status == CLAST_OK; ++k) {
        clast_decomposition made = {0};
        const clast_cloud plain = {.n = n, .dimension = 3, .x = cloud.x};
        const double begun = now();
        status = clast_decompose_in(&l.domain, &plain, &l.config, &made);
        ms[k] = now() - begun;
        clast_decomposition_free(&made);
        drifting_advance(&cloud);
    }
    qsort(ms, (size_t)n_step, sizeof *ms, compare);
    end(&l);
    drifting_free(&cloud);
    return status;
}

/// Median and mean of the steps, beside the limit.
static void print_times(int64_t n, const char *name, const double *ms, int n_step, double limit)
{
    double mean = 0.0;
    for (int k = 0; k < n_step; ++k) {
        mean += ms[k] / n_step;
    }
    (void)printf("loop_%lld_%s,%.4g,ms cpu a step (median),%g,%.3g\n", (long long)n, name,
                 ms[n_step / 2], limit, ms[n_step / 2] / limit);
    (void)printf("loop_%lld_%s_mean,%.4g,ms cpu a step (mean),%g,%.3g\n", (long long)n, name, mean,
                 limit, mean / limit);
    (void)fflush(stdout);
}

static clast_status times(void)
{
    static double ms[MOST_STEPS];
    clast_status status = CLAST_OK;
    (void)printf("scene,value,unit,reference,ratio\n");
    for (int k = 0; k < 2 && status == CLAST_OK; ++k) {
        const int64_t n = k == 0 ? 20000 : 200000;
        const double limit = k == 0 ? 5.0 : 30.0;
        const int slow = k == 0 ? 15 : 7;
        status = time_plain(DRIFTING_MOVING, n, slow, ms);
        print_times(n, "plain", ms, slow, limit);
        for (int p = 0; p < N_POLICY && status == CLAST_OK; ++p) {
            const int n_step = p == 0 ? slow : k == 0 ? 200 : 100;
            status = time_steps(p, DRIFTING_MOVING, n, n_step, ms);
            print_times(n, policies[p].name, ms, n_step, limit);
        }
    }
    return status;
}

typedef struct {
    double square, worst, mean, truth_mean, truth_square, plain_square, plain_mean, ms;
    int other_vote, n_truth;
    clast_workspace_calls calls;
} tally;

static clast_status compare_step(loop *l, const drifting *cloud, const clast_decomposition *plain,
                                 tally *t)
{
    const clast_decomposition *made = NULL;
    const double begun = now();
    const clast_status status =
        clast_workspace_decompose_in(l->workspace, &l->domain, &l->points, &l->config, &made);
    if (status != CLAST_OK) {
        return status;
    }
    t->ms += now() - begun;
    const double error = made->events / plain->events - 1.0;
    t->mean += error;
    t->square += error * error;
    t->worst = fmax(t->worst, fabs(error));
    t->other_vote += made->before.reject != plain->before.reject ? 1 : 0;
    const double n = (double)cloud->n;
    const double truth = 0.5e-18 * n * (n - 1.0) * drifting_integral(cloud);
    if (truth > 0.0) {
        const double off = made->events / truth - 1.0;
        const double own = plain->events / truth - 1.0;
        t->truth_mean += off;
        t->truth_square += off * off;
        t->plain_mean += own;
        t->plain_square += own * own;
        ++t->n_truth;
    }
    return CLAST_OK;
}

static void print_row(drifting_kind kind, int64_t n, int p, int n_step, const tally *t)
{
    const double truths = t->n_truth > 0 ? t->n_truth : (double)NAN;
    const bool votes = policies[p].policy.tests != CLAST_TESTS_NEVER;
    const double other_vote = votes ? (double)t->other_vote / n_step : (double)NAN;
    (void)printf("%s,%lld,%s,%.2f,%.3f,%.3f,%+.4f,%.4f,%.4f,%.3f,%+.4f,%.4f,%+.4f,%.4f\n",
                 drifting_name[kind], (long long)n, policies[p].name, t->ms / n_step,
                 (double)t->calls.n_test / n_step, (double)t->calls.n_cut / n_step,
                 t->mean / n_step, sqrt(t->square / n_step), t->worst, other_vote,
                 t->truth_mean / truths, sqrt(t->truth_square / truths), t->plain_mean / truths,
                 sqrt(t->plain_square / truths));
    (void)fflush(stdout);
}

static clast_status errors(drifting_kind kind, int64_t n, int n_step, uint64_t seed,
                           int first_policy)
{
    loop l[N_POLICY] = {{0}};
    static tally t[N_POLICY];
    drifting cloud = {0};
    clast_status status = drifting_start(kind, n, seed, &cloud);
    memset(t, 0, sizeof t);
    for (int p = 0; p < N_POLICY && status == CLAST_OK; ++p) {
        status = begin(p, &cloud, &l[p]);
    }
    for (int k = 0; k < n_step && status == CLAST_OK; ++k) {
        clast_decomposition plain = {0};
        const clast_cloud all = {.n = n, .dimension = 3, .x = cloud.x};
        status = clast_decompose_in(&l[0].domain, &all, &l[0].config, &plain);
        for (int p = first_policy; p < N_POLICY && status == CLAST_OK; ++p) {
            status = compare_step(&l[p], &cloud, &plain, &t[p]);
        }
        clast_decomposition_free(&plain);
        drifting_advance(&cloud);
    }
    for (int p = first_policy; p < N_POLICY && status == CLAST_OK; ++p) {
        (void)clast_workspace_count(l[p].workspace, &t[p].calls);
        print_row(kind, n, p, n_step, &t[p]);
    }
    for (int p = 0; p < N_POLICY; ++p) {
        end(&l[p]);
    }
    drifting_free(&cloud);
    return status;
}

/// The number after the argument, or what it is without one.
static int64_t number(int argc, char **argv, int at, int64_t otherwise)
{
    return argc > at ? (int64_t)strtod(argv[at], NULL) : otherwise;
}

static clast_estimator estimator_of(int argc, char **argv, int at)
{
    return argc > at && strcmp(argv[at], "auto") == 0 ? CLAST_ESTIMATOR_AUTO
                                                      : CLAST_ESTIMATOR_CELLS;
}

/// Median and mean of the steps of one policy.
static clast_status run(int argc, char **argv)
{
    static double ms[MOST_STEPS];
    clast_status status = CLAST_OK;
    const int n_step = (int)number(argc, argv, 3, 1);
    const drifting_kind kind = (drifting_kind)number(argc, argv, 5, DRIFTING_MOVING);
    estimator = estimator_of(argc, argv, 6);
    for (int p = 0; p < N_POLICY && n_step > 0 && n_step <= MOST_STEPS; ++p) {
        if (strcmp(policies[p].name, argv[4]) == 0) {
            status = time_steps(p, kind, number(argc, argv, 2, 20000), n_step, ms);
            double mean = 0.0;
            for (int k = 0; k < n_step; ++k) {
                mean += ms[k] / n_step;
            }
            (void)printf("%.4g ms median, %.4g mean, %.4g most; of %lld calls %lld tested, %lld "
                         "cut, %lld counted pairs\n",
                         ms[n_step / 2], mean, ms[n_step - 1], (long long)calls.n_call,
                         (long long)calls.n_test, (long long)calls.n_cut, (long long)calls.n_pairs);
        }
    }
    return status;
}

int main(int argc, char **argv)
{
    clast_status status = CLAST_OK;
    clast_parallel_set_threads(1);
    if (argc > 1 && strcmp(argv[1], "error") == 0) {
        (void)printf("cloud,n,policy,ms_a_step,tests_a_step,cuts_a_step,bias,rms,worst,other_vote,"
                     "bias_to_truth,rms_to_truth,plain_bias_to_truth,plain_rms_to_truth\n");
        estimator = estimator_of(argc, argv, 5);
        for (int kind = (int)number(argc, argv, 6, 0); kind < N_DRIFTING && status == CLAST_OK;
             ++kind) {
            status = errors((drifting_kind)kind, number(argc, argv, 2, 20000),
                            (int)number(argc, argv, 3, 200), (uint64_t)number(argc, argv, 4, 1),
                            (int)number(argc, argv, 7, 1));
        }
    } else if (argc > 4 && strcmp(argv[1], "run") == 0) {
        status = run(argc, argv);
    } else {
        status = times();
    }
    if (status != CLAST_OK) {
        (void)fprintf(stderr, "bench_loop: %s\n", clast_error_detail());
    }
    return clast_status_exit_code(status);
}
