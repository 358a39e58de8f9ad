/* Unit: decompositions on the caller's arrays: any layout, no memory from the system when repeated,
 * any number beside each other. */
#include "drifting.h"
#include "support.h"

#include "base/alloc.h"
#include "math/rng.h"
#include <clast/machine.h>
#include <clast/mesh.h>
#include <clast/workspace.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { N = 3000, RECORD = 8 };
static double dense[3 * N], record[RECORD * N], planes[3 * N], weight[2 * N];

static void fill(uint64_t seed)
{
    for (uint64_t i = 0; i < N; ++i) {
        clx_rng rng = clx_rng_at(seed, CLX_STREAM_TEST, i);
        const double side = clx_rng_uniform(&rng) < 0.7 ? 0.25 : 1.0;
        for (uint64_t j = 0; j < 3; ++j) {
            const double at = side * clx_rng_uniform(&rng);
            dense[3 * i + j] = record[RECORD * i + j] = planes[N * j + i] = at;
        }
        weight[2 * i] = 1.0 + (double)(i % 3);
    }
}

static clast_decompose_config config_of(const char *mesh)
{
    clast_decompose_config c;
    CHECK_OK(clast_fields_default(clast_decompose_fields, &c));
    CHECK_OK(clast_field_set(clast_fields_find(clast_decompose_fields, "domain"), &c,
                             "box:0,0,0,1,1,1", false));
    CHECK_OK(clast_field_set(clast_fields_find(clast_decompose_fields, "mesh"), &c, mesh, false));
    return c;
}

static void any_layout_gives_the_cells_of_dense_arrays(void **state)
{
    (void)state;
    const clast_points layout[3] = {
        {.n = N, .dimension = 3, .x = dense, .stride = 3, .axis_stride = 1},
        {.n = N, .dimension = 3, .x = record, .stride = RECORD, .axis_stride = 1},
        {.n = N, .dimension = 3, .x = planes, .stride = 1, .axis_stride = N}};
    static int32_t cell[2 * N];
    static double events[3 * N];
    clast_decompose_config c = config_of("auto");
    clast_workspace *workspace = NULL;
    clast_decomposition plain = {0};
    fill(1);
    clast_cloud cloud = {.n = N, .dimension = 3, .x = dense};
    CHECK_OK(clast_decompose(&cloud, &c, &plain));
    CHECK_OK(clast_workspace_create(&workspace));
    CHECK_STATUS(clast_workspace_cells(workspace, 1, cell), CLAST_E_USAGE);
    CHECK_STATUS(clast_workspace_events(workspace, 1, events), CLAST_E_USAGE);
    for (int k = 0; k < 3; ++k) {
        const clast_decomposition *made = NULL;
        double sum = 0.0;
        CHECK_OK(clast_workspace_decompose(workspace, &layout[k], &c, &made));
        assert_memory_equal(made->cells.of_point, plain.cells.of_point,
                            N * sizeof *plain.cells.of_point);
        CHECK_REL(made->events, plain.events, 0.0);
        CHECK_OK(clast_workspace_cells(workspace, 2, cell));
        CHECK_OK(clast_workspace_events(workspace, 3, events));
        for (int i = 0; i < N; ++i) {
            assert_int_equal(cell[2 * i], plain.cells.of_point[i]);
            sum += events[3 * i];
        }
        CHECK_REL(sum, plain.events, 1e-12);
    }
    clast_uniformity test;
    CHECK_OK(clast_workspace_test(workspace, &layout[1], &c, &test));
    CHECK_REL(test.score, plain.before.score, 0.0);
    assert_int_equal(test.n_reject, plain.before.n_reject);
    clast_decomposition_free(&plain);
    clast_workspace_destroy(workspace);
    clast_fields_free(clast_decompose_fields, &c);
}

static void weights_are_read_with_their_stride(void **state)
{
    (void)state;
    static double packed[N];
    clast_decompose_config c = config_of("auto");
    clast_workspace *workspace = NULL;
    const clast_decomposition *made = NULL;
    clast_decomposition plain = {0};
    fill(2);
    for (int i = 0; i < N; ++i) {
        packed[i] = weight[2 * i];
    }
    const clast_cloud cloud = {.n = N, .dimension = 3, .x = dense, .weight = packed};
    const clast_points points = {N, 3, dense, 3, 1, weight, 2};
    CHECK_OK(clast_decompose(&cloud, &c, &plain));
    CHECK_OK(clast_workspace_create(&workspace));
    CHECK_OK(clast_workspace_decompose(workspace, &points, &c, &made));
    CHECK_REL(made->events, plain.events, 0.0);
    clast_decomposition_free(&plain);
    clast_workspace_destroy(workspace);
    clast_fields_free(clast_decompose_fields, &c);
}

#ifdef CLAST_ALLOC_INJECT
/* The same points again, and moved ones: nothing is taken from the system, with one thread or two,
 * for each kind of cells. */
static void repeated_calls_take_no_memory(void **state)
{
    static const char *const mesh[] = {"auto", "boxes", "components", "bins", "labels"};
    (void)state;
    const int32_t threads = clast_parallel_threads();
    const clast_points points = {.n = N, .dimension = 3, .x = dense, .stride = 3, .axis_stride = 1};
    for (int k = 0; k < 5; ++k) {
        clast_decompose_config c = config_of(mesh[k]);
        clast_workspace *workspace = NULL;
        const clast_decomposition *made = NULL;
        clast_parallel_set_threads(k == 1 ? 1 : 2);
        fill(3);
        CHECK_OK(clast_workspace_create(&workspace));
        CHECK_OK(clast_workspace_decompose(workspace, &points, &c, &made));
        const int64_t taken = clx_alloc_taken();
        for (int repeat = 0; repeat < 3; ++repeat) {
            CHECK_OK(clast_workspace_decompose(workspace, &points, &c, &made));
        }
        assert_int_equal(clx_alloc_taken(), taken);
        for (int i = 0; i < 3 * N; ++i) { // as a step of a flow would move them
            dense[i] = fmin(1.0, dense[i] * (1.0 + 1e-4 * (i % 3)));
        }
        CHECK_OK(clast_workspace_decompose(workspace, &points, &c, &made));
        assert_int_equal(clx_alloc_taken(), taken);
        clast_workspace_destroy(workspace);
        clast_fields_free(clast_decompose_fields, &c);
    }
    clast_parallel_set_threads(threads);
}

/* Collisions: the caller's particles, the workspace's memory. */
static void repeated_collisions_take_no_memory(void **state)
{
    (void)state;
    static int64_t monomers[N], owner[N];
    static double radius[N], mass[N];
    static int32_t cell[N];
    clast_decompose_config c = config_of("auto");
    clast_collide_config collide = {.alpha = 1.0, .block = 1024, .seed = 1};
    clast_workspace *workspace = NULL;
    const clast_decomposition *made = NULL;
    clast_population particles = {.n = N,
                                  .dimension = 3,
                                  .x = dense,
                                  .monomers = monomers,
                                  .radius = radius,
                                  .mass = mass,
                                  .owner = owner};
    const clast_points points = {.n = N, .dimension = 3, .x = dense, .stride = 3, .axis_stride = 1};
    int64_t n_event = 0;
    int64_t taken = 0;
    collide.medium.constant = 1e-7;
    CHECK_OK(clast_kernel_parse("constant", &collide.kernel));
    fill(4);
    for (int i = 0; i < N; ++i) {
        monomers[i] = 1;
        owner[i] = i;
        radius[i] = mass[i] = 1.0;
    }
    CHECK_OK(clast_workspace_create(&workspace));
    CHECK_OK(clast_workspace_decompose(workspace, &points, &c, &made));
    CHECK_OK(clast_workspace_cells(workspace, 1, cell));
    const clast_collide_cells cells = {
        .n = made->cells.n, .of_particle = cell, .volume = made->cells.volume};
    for (uint64_t step = 0; step < 3; ++step) {
        CHECK_OK(clast_workspace_collide(workspace, &particles, &cells,
                                         (clast_workspace_step){1e-3, step}, &collide, &n_event));
        assert_true(step == 0 || clx_alloc_taken() == taken);
        taken = clx_alloc_taken();
    }
    assert_true(n_event >= 0);
    clast_workspace_destroy(workspace);
    clast_fields_free(clast_decompose_fields, &c);
}
#endif

typedef struct {
    uint64_t seed;
    double x[3 * N];
    double events[4];
    int32_t n_cell[4];
    clast_status status;
} job;

static void *decompose_in_thread(void *context)
{
    job *j = context;
    clast_workspace *workspace = NULL;
    clast_decompose_config c = {0};
    const clast_points points = {.n = N, .dimension = 3, .x = j->x, .stride = 3, .axis_stride = 1};
    j->status = clast_fields_default(clast_decompose_fields, &c);
    if (j->status == CLAST_OK) {
        j->status = clast_field_set(clast_fields_find(clast_decompose_fields, "domain"), &c,
                                    "box:0,0,0,1,1,1", false);
    }
    if (j->status == CLAST_OK) {
        j->status = clast_workspace_create(&workspace);
    }
    for (int k = 0; k < 4 && j->status == CLAST_OK; ++k) {
        const clast_decomposition *made = NULL;
        c.mesh = k;
        j->status = clast_workspace_decompose(workspace, &points, &c, &made);
        if (j->status == CLAST_OK) {
            j->events[k] = made->events;
            j->n_cell[k] = made->cells.n;
        }
    }
    clast_workspace_destroy(workspace);
    clast_fields_free(clast_decompose_fields, &c);
    return NULL;
}

static void threads_of_the_caller_do_not_disturb_each_other(void **state)
{
    (void)state;
    static job alone[2], beside[2];
    pthread_t thread[2];
    for (uint64_t k = 0; k < 2; ++k) {
        fill(10 + k);
        memcpy(alone[k].x, dense, sizeof dense);
        memcpy(beside[k].x, dense, sizeof dense);
        (void)decompose_in_thread(&alone[k]);
        CHECK_OK(alone[k].status);
    }
    for (int k = 0; k < 2; ++k) {
        assert_int_equal(pthread_create(&thread[k], NULL, decompose_in_thread, &beside[k]), 0);
    }
    for (int k = 0; k < 2; ++k) {
        assert_int_equal(pthread_join(thread[k], NULL), 0);
        CHECK_OK(beside[k].status);
        assert_memory_equal(alone[k].events, beside[k].events, sizeof alone[k].events);
        assert_memory_equal(alone[k].n_cell, beside[k].n_cell, sizeof alone[k].n_cell);
    }
}

static void bad_points_are_told_and_leave_no_result(void **state)
{
    (void)state;
    clast_decompose_config c = config_of("auto");
    clast_workspace *workspace = NULL;
    const clast_decomposition *made = NULL;
    int32_t cell = 0;
    clast_points points = {.n = N, .dimension = 3, .x = dense, .stride = 3, .axis_stride = 1};
    fill(5);
    CHECK_OK(clast_workspace_create(&workspace));
    CHECK_OK(clast_workspace_decompose(workspace, &points, &c, &made));
    dense[7] = (double)NAN;
    CHECK_STATUS(clast_workspace_decompose(workspace, &points, &c, &made), CLAST_E_FORMAT);
    assert_null(made);
    CHECK_STATUS(clast_workspace_cells(workspace, 1, &cell), CLAST_E_USAGE);
    dense[7] = 0.5;
    CHECK_OK(clast_workspace_decompose(workspace, &points, &c, &made));
    points.dimension = 4;
    CHECK_STATUS(clast_workspace_decompose(workspace, &points, &c, &made), CLAST_E_ARGUMENT);
    clast_workspace_destroy(workspace);
    clast_workspace_destroy(NULL);
    clast_fields_free(clast_decompose_fields, &c);
}

static void tests_leave_no_decomposition(void **state)
{
    (void)state;
    clast_decompose_config c = config_of("auto");
    clast_workspace *workspace = NULL;
    const clast_decomposition *made = NULL;
    clast_uniformity tests;
    static int32_t cell[N], again[N];
    const clast_points points = {.n = N, .dimension = 3, .x = dense, .stride = 3, .axis_stride = 1};
    fill(5);
    CHECK_OK(clast_workspace_create(&workspace));
    for (int k = 0; k < 2; ++k) {
        CHECK_OK(clast_workspace_test(workspace, &points, &c, &tests));
        CHECK_STATUS(clast_workspace_cells(workspace, 1, k == 0 ? cell : again), CLAST_E_USAGE);
        CHECK_OK(clast_workspace_decompose(workspace, &points, &c, &made));
        CHECK_OK(clast_workspace_cells(workspace, 1, k == 0 ? cell : again));
    }
    assert_memory_equal(cell, again, sizeof cell);
    clast_workspace_destroy(workspace);
    clast_fields_free(clast_decompose_fields, &c);
}

static clast_status make_once(void *context)
{
    clast_workspace *workspace = NULL;
    const clast_decomposition *made = NULL;
    const clast_points points = {
        .n = 30, .dimension = 3, .x = dense, .stride = 3, .axis_stride = 1};
    clast_status status = clast_workspace_create(&workspace);
    if (status == CLAST_OK) {
        status = clast_workspace_decompose(workspace, &points, context, &made);
    }
    clast_workspace_destroy(workspace);
    return status;
}

static clast_workspace_policy policy_of(const char *tests, const char *cells)
{
    clast_workspace_policy p;
    const clast_field *fields = clast_workspace_fields;
    CHECK_OK(clast_fields_default(fields, &p));
    CHECK_OK(clast_field_set(clast_fields_find(fields, "tests"), &p, tests, false));
    CHECK_OK(clast_field_set(clast_fields_find(fields, "cells"), &p, cells, false));
    return p;
}

static clast_workspace *workspace_with(clast_workspace_policy policy)
{
    clast_workspace *workspace = NULL;
    CHECK_OK(clast_workspace_create(&workspace));
    CHECK_OK(clast_workspace_set_policy(workspace, &policy));
    return workspace;
}

static const clast_points dense_points = {
    .n = N, .dimension = 3, .x = dense, .stride = 3, .axis_stride = 1};

/* The first call of any policy gives what clast_decompose gives, but for a vote that none has cast;
 * so do all later ones of the default. */
static void first_call_is_that_of_clast_decompose(void **state)
{
    static const char *const tests[] = {"each", "every", "moved", "never"};
    static const char *const cells[] = {"each", "every", "changed"};
    (void)state;
    clast_decompose_config c = config_of("tree");
    clast_decomposition plain = {0};
    fill(21);
    const clast_cloud cloud = {.n = N, .dimension = 3, .x = dense};
    CHECK_OK(clast_decompose(&cloud, &c, &plain));
    for (int k = 0; k < 12; ++k) {
        const clast_decomposition *made = NULL;
        clast_workspace_calls calls;
        clast_workspace *workspace = workspace_with(policy_of(tests[k / 3], cells[k % 3]));
        CHECK_OK(clast_workspace_decompose(workspace, &dense_points, &c, &made));
        CHECK_OK(clast_workspace_count(workspace, &calls));
        assert_int_equal(calls.n_cut, 1);
        assert_int_equal(calls.n_test, k / 3 == 3 ? 0 : 1);
        assert_int_equal(calls.since_test, k / 3 == 3 ? -1 : 0);
        assert_int_equal(made->before.n_test, k / 3 == 3 ? 0 : plain.before.n_test);
        assert_int_equal(made->stop, k / 3 == 3 ? CLAST_STOP_SPARED : plain.stop);
        assert_true(k / 3 != 3 || isnan(made->before.score));
        assert_memory_equal(made->cells.of_point, plain.cells.of_point,
                            N * sizeof *plain.cells.of_point);
        CHECK_REL(made->events, plain.events, 0.0);
        /* again, by cells that are kept: the same points give the same cells and events */
        CHECK_OK(clast_workspace_decompose(workspace, &dense_points, &c, &made));
        CHECK_OK(clast_workspace_count(workspace, &calls));
        assert_int_equal(calls.n_cut, k % 3 == 0 ? 2 : 1);
        assert_int_equal(calls.n_test, k / 3 == 3 ? 0 : k / 3 == 0 ? 2 : 1);
        assert_memory_equal(made->cells.of_point, plain.cells.of_point,
                            N * sizeof *plain.cells.of_point);
        assert_memory_equal(made->cells.low, plain.cells.low,
                            (size_t)plain.cells.n * sizeof *plain.cells.low);
        CHECK_REL(made->events, plain.events, 1e-12); // of a ratio that is kept
        CHECK_REL(made->events_low, plain.events_low, 1e-12);
        assert_true(made->resolved == plain.resolved);
        if (isfinite(plain.events_high)) {
            CHECK_REL(made->events_high, plain.events_high, 1e-12);
        } else {
            assert_true(isinf(made->events_high));
        }
        clast_workspace_destroy(workspace);
    }
    clast_decomposition_free(&plain);
    clast_fields_free(clast_decompose_fields, &c);
}

/* Cells that are kept hold each point where clast_cells_locate finds it, and their events are those
 * of their counts; for trees and bins, with fewer points than before. */
static void kept_cells_hold_the_points_of_the_call(void **state)
{
    static const char *const mesh[] = {"tree", "boxes", "components"};
    (void)state;
    clast_domain domain = {0};
    CHECK_OK(clast_domain_parse("box:0,0,0,1,1,1", &domain));
    for (int k = 0; k < 3; ++k) {
        clast_decompose_config c = config_of(mesh[k]);
        clast_workspace_policy policy = policy_of("every", "every");
        const clast_decomposition *made = NULL;
        double events = 0.0;
        int64_t n = 0;
        policy.tests_every = policy.cells_every = 100;
        c.extrapolate = false;
        c.beta_dt = 1e-9;
        clast_workspace *workspace = workspace_with(policy);
        clast_points points = dense_points;
        fill(22);
        CHECK_OK(clast_workspace_decompose_in(workspace, &domain, &points, &c, &made));
        fill(23); // other points of the same density
        points.n = N - 100;
        CHECK_OK(clast_workspace_decompose_in(workspace, &domain, &points, &c, &made));
        assert_int_equal(made->n, N - 100);
        for (int64_t i = 0; i < N - 100; ++i) {
            assert_int_equal(made->cells.of_point[i],
                             clast_cells_locate(&made->cells, &domain, dense + 3 * i));
        }
        for (int32_t b = 0; b < made->cells.n; ++b) {
            const double count = (double)made->cells.count[b];
            n += made->cells.count[b];
            events += 0.5e-9 * count * (count - 1.0) / made->cells.volume[b];
        }
        assert_int_equal(n, N - 100);
        assert_true(made->cells.n > 1);
        CHECK_REL(made->events, events, 1e-12);
        clast_workspace_destroy(workspace);
        clast_fields_free(clast_decompose_fields, &c);
    }
}

/* every n-th call; moved and changed when there is a reason, and not without one. */
static void policies_test_and_cut_when_they_say(void **state)
{
    (void)state;
    clast_decompose_config c = config_of("tree");
    clast_workspace_policy policy = policy_of("every", "every");
    const clast_decomposition *made = NULL;
    clast_workspace_calls calls;
    policy.tests_every = 3;
    policy.cells_every = 4;
    fill(24);
    clast_workspace *workspace = workspace_with(policy);
    for (int k = 0; k < 9; ++k) {
        CHECK_OK(clast_workspace_decompose(workspace, &dense_points, &c, &made));
        CHECK_OK(clast_workspace_count(workspace, &calls));
        assert_int_equal(calls.since_test, k % 3);
        assert_int_equal(calls.since_cut, k % 4);
    }
    assert_int_equal(calls.n_call, 9);
    CHECK_OK(clast_workspace_forget(workspace));
    CHECK_OK(clast_workspace_decompose(workspace, &dense_points, &c, &made));
    CHECK_OK(clast_workspace_count(workspace, &calls));
    assert_int_equal(calls.since_test + calls.since_cut, 0);
    c.seed = 2; // another configuration
    CHECK_OK(clast_workspace_decompose(workspace, &dense_points, &c, &made));
    CHECK_OK(clast_workspace_count(workspace, &calls));
    assert_int_equal(calls.n_cut, 5);
    clast_workspace_destroy(workspace);

    policy = policy_of("moved", "changed");
    policy.tests_moved = 0.1; // times up to 38, for this vote is far from turning
    workspace = workspace_with(policy);
    for (uint64_t k = 0; k < 4; ++k) {
        for (int i = 0; i < 3 * N && k > 1; ++i) { // squeezed towards a corner: another cloud
            dense[i] *= dense[i];
        }
        CHECK_OK(clast_workspace_decompose(workspace, &dense_points, &c, &made));
        CHECK_OK(clast_workspace_count(workspace, &calls));
        assert_int_equal(calls.n_cut, k < 2 ? 1 : k);
        assert_int_equal(calls.n_test, k < 2 ? 1 : k);
        assert_true(k == 0 ? isnan(calls.moved) : k == 1 ? calls.moved == 0.0 : calls.moved > 5.0);
        assert_true(k == 0   ? isnan(calls.p_change)
                    : k == 1 ? calls.p_change == 1.0
                             : calls.p_change < 1e-6);
    }
    clast_points half = dense_points;
    half.n = N / 2; // cut anew for its number
    CHECK_OK(clast_workspace_decompose(workspace, &half, &c, &made));
    CHECK_OK(clast_workspace_count(workspace, &calls));
    assert_int_equal(calls.since_cut, 0);
    clast_workspace_destroy(workspace);
    clast_fields_free(clast_decompose_fields, &c);
}

/* Kept cells are filled by threads, in blocks of points. */
static void kept_cells_have_the_same_bytes_for_any_threads(void **state)
{
    (void)state;
    enum { MANY = 20000, STEPS = 3 };
    static int32_t of_point[STEPS][MANY];
    double events[STEPS][3];
    const int32_t threads = clast_parallel_threads();
    clast_decompose_config c = config_of("tree");
    clast_domain domain = {0};
    CHECK_OK(clast_domain_parse("box:0,0,0,1,1,1", &domain));
    for (int32_t k = 1; k <= 4; k *= 2) {
        drifting cloud = {0};
        clast_workspace *workspace = workspace_with(policy_of("never", "changed"));
        clast_parallel_set_threads(k);
        CHECK_OK(drifting_start(DRIFTING_MOVING, MANY, 31, &cloud));
        for (int step = 0; step < STEPS; ++step) {
            const clast_decomposition *made = NULL;
            const clast_points points = {
                .n = MANY, .dimension = 3, .x = cloud.x, .stride = 3, .axis_stride = 1};
            CHECK_OK(clast_workspace_decompose_in(workspace, &domain, &points, &c, &made));
            const double now[3] = {made->events, made->events_low, made->events_high};
            if (k == 1) {
                memcpy(of_point[step], made->cells.of_point, sizeof of_point[step]);
                memcpy(events[step], now, sizeof now);
            }
            assert_memory_equal(of_point[step], made->cells.of_point, sizeof of_point[step]);
            assert_memory_equal(events[step], now, sizeof now);
            drifting_advance(&cloud);
        }
        drifting_free(&cloud);
        clast_workspace_destroy(workspace);
    }
    clast_parallel_set_threads(threads);
    clast_fields_free(clast_decompose_fields, &c);
}

static bool map_shear(const void *context, const double *x, double *u)
{
    (void)context;
    u[0] = x[0];
    u[1] = x[1] - 0.5 * x[0];
    u[2] = x[2];
    return u[0] >= 0.0 && u[0] <= 1.0 && u[1] >= 0.0 && u[1] <= 1.0 && u[2] >= 0.0 && u[2] <= 1.0;
}

static void unmap_shear(const void *context, const double *u, double *x)
{
    (void)context;
    x[0] = u[0];
    x[1] = u[1] + 0.5 * u[0];
    x[2] = u[2];
}

/* Closed surfaces and the caller's own maps: as clast_decompose_in, and by cells that are kept. */
static void any_domain_is_taken(void **state)
{
    (void)state;
    const clast_domain_map_functions shear = {3, 1.0, map_shear, unmap_shear, NULL};
    const double axes[3] = {1.0, 0.9, 0.8};
    clast_mesh mesh = {0};
    CHECK_OK(clast_mesh_ellipsoid(axes, 2, &mesh));
    for (int k = 0; k < 2; ++k) {
        clast_decompose_config c = config_of("tree");
        clast_domain domain = {0};
        clast_decomposition plain = {0};
        const clast_decomposition *made = NULL;
        clast_workspace *workspace = workspace_with(policy_of("moved", "changed"));
        clast_workspace_calls calls;
        c.outside = CLAST_OUTSIDE_DROP;
        fill(26);
        if (k == 0) {
            CHECK_OK(clast_domain_of_map(&shear, &domain));
        } else {
            CHECK_OK(clast_domain_of_mesh(&mesh, 1.0, &domain));
        }
        const clast_cloud cloud = {.n = N, .dimension = 3, .x = dense};
        CHECK_OK(clast_decompose_in(&domain, &cloud, &c, &plain));
        assert_true(plain.cells.n > 1);
        for (int repeat = 0; repeat < 2; ++repeat) {
            CHECK_OK(clast_workspace_decompose_in(workspace, &domain, &dense_points, &c, &made));
            CHECK_REL(made->events, plain.events, 0.0);
            assert_int_equal(made->n_outside, plain.n_outside);
            assert_memory_equal(made->cells.of_point, plain.cells.of_point,
                                N * sizeof *plain.cells.of_point);
        }
        CHECK_OK(clast_workspace_count(workspace, &calls));
        assert_int_equal(calls.n_cut, 1);
        clast_decomposition_free(&plain);
        clast_workspace_destroy(workspace);
        clast_domain_free(&domain);
        clast_fields_free(clast_decompose_fields, &c);
    }
    clast_mesh_free(&mesh);
}

/* What cannot be is refused with one line, nothing changed. */
static void policies_that_cannot_be_are_refused(void **state)
{
    (void)state;
    clast_decompose_config c = config_of("tree");
    const clast_decomposition *made = NULL;
    clast_domain domain = {0};
    clast_workspace_calls calls = {.n_call = -7};
    clast_workspace_policy bad = policy_of("every", "each");
    fill(27);
    CHECK_OK(clast_domain_parse("box:0,0,0,1,1,1", &domain));
    CHECK_STATUS(clast_workspace_count(NULL, &calls), CLAST_E_ARGUMENT);
    assert_int_equal(calls.n_call, -7);
    CHECK_STATUS(clast_workspace_forget(NULL), CLAST_E_ARGUMENT);
    CHECK_STATUS(clast_workspace_set_policy(NULL, &bad), CLAST_E_ARGUMENT);
    clast_workspace *workspace = workspace_with(policy_of("never", "changed"));
    CHECK_STATUS(clast_workspace_set_policy(workspace, NULL), CLAST_E_ARGUMENT);
    CHECK_STATUS(clast_workspace_count(workspace, NULL), CLAST_E_ARGUMENT);
    bad.tests_every = 0;
    CHECK_STATUS(clast_workspace_set_policy(workspace, &bad), CLAST_E_CONFIG);
    CHECK_OK(clast_workspace_decompose_in(workspace, &domain, &dense_points, &c, &made));
    const clast_decomposition *const held = made;
    CHECK_STATUS(clast_workspace_decompose_in(workspace, NULL, &dense_points, &c, &made),
                 CLAST_E_ARGUMENT);
    CHECK_STATUS(clast_workspace_decompose_in(workspace, &domain, NULL, &c, &made),
                 CLAST_E_ARGUMENT);
    CHECK_STATUS(clast_workspace_decompose_in(workspace, &domain, &dense_points, NULL, &made),
                 CLAST_E_ARGUMENT);
    CHECK_STATUS(clast_workspace_decompose_in(workspace, &domain, &dense_points, &c, NULL),
                 CLAST_E_ARGUMENT);
    CHECK_STATUS(clast_workspace_decompose_in(NULL, &domain, &dense_points, &c, &made),
                 CLAST_E_ARGUMENT);
    c.crossfit = true; // both halves are cut at each call
    CHECK_STATUS(clast_workspace_decompose_in(workspace, &domain, &dense_points, &c, &made),
                 CLAST_E_CONFIG);
    c.crossfit = false;
    c.mesh = CLAST_CELLS_BOXES; // passes begin and end with a vote
    CHECK_STATUS(clast_workspace_decompose_in(workspace, &domain, &dense_points, &c, &made),
                 CLAST_E_CONFIG);
    assert_ptr_equal(made, held);
    assert_int_equal(made->n, N);
    c.variant = CLAST_VARIANT_FAST;
    CHECK_OK(clast_workspace_decompose_in(workspace, &domain, &dense_points, &c, &made));
    assert_int_equal(made->stop, CLAST_STOP_ONE_PASS);
    clast_workspace_destroy(workspace);
    clast_fields_free(clast_decompose_fields, &c);
}

#ifdef CLAST_ALLOC_INJECT
/* 1000 steps of a cloud that drifts, number and cells changing: blocks and bytes stay. */
static void a_long_loop_keeps_its_heap(void **state)
{
    (void)state;
    clast_decompose_config c = config_of("tree");
    clast_domain domain = {0};
    drifting cloud = {0};
    int64_t taken = 0;
    int64_t live = 0;
    CHECK_OK(
        clast_field_set(clast_fields_find(clast_decompose_fields, "tests"), &c, "pearson", false));
    CHECK_OK(clast_domain_parse("box:0,0,0,1,1,1", &domain));
    CHECK_OK(drifting_start(DRIFTING_GATHERED, 500, 5, &cloud));
    clast_workspace *workspace = workspace_with(policy_of("moved", "changed"));
    for (int k = 0; k < 1400; ++k) {
        const clast_decomposition *made = NULL;
        const clast_points points = {
            .n = cloud.n - k % 40, .dimension = 3, .x = cloud.x, .stride = 3, .axis_stride = 1};
        CHECK_OK(clast_workspace_decompose_in(workspace, &domain, &points, &c, &made));
        drifting_advance(&cloud);
        if (k == 400) { // one period of the cloud
            taken = clx_alloc_taken();
            live = clx_alloc_live();
        }
    }
    assert_int_equal(clx_alloc_taken(), taken);
    assert_true(llabs((long long)(clx_alloc_live() - live)) <= 4); // arrays of the pool in use
    clast_workspace_destroy(workspace);
    drifting_free(&cloud);
    clast_fields_free(clast_decompose_fields, &c);
}
#endif

/* Between counts of pairs the last estimate follows the cells: within 5 % of a count at each step
 * in a blob that moves half its sd in the 24 steps; a tenfold number of points in it is counted
 * anew. */
static void a_count_of_pairs_is_carried_from_cut_to_cut(void **state)
{
    (void)state;
    clast_decompose_config c = config_of("tree");
    clast_workspace *loop[2];
    drifting cloud = {0};
    clast_workspace_policy policy = policy_of("never", "each");
    clast_workspace_calls calls[2] = {{0}};
    CHECK_OK(drifting_start(DRIFTING_MOVING, 3000, 31, &cloud));
    for (int k = 0; k < 2; ++k) {
        policy.pairs_every = k * 10;
        loop[k] = workspace_with(policy);
    }
    const clast_points points = {
        .n = cloud.n, .dimension = 3, .x = cloud.x, .stride = 3, .axis_stride = 1};
    for (int step = 0; step < 24; ++step) {
        const clast_decomposition *made[2] = {NULL};
        for (int k = 0; k < 2; ++k) {
            CHECK_OK(clast_workspace_decompose(loop[k], &points, &c, &made[k]));
            CHECK_OK(clast_workspace_count(loop[k], &calls[k]));
        }
        assert_int_equal(made[1]->estimator, CLAST_ESTIMATOR_PAIRS);
        CHECK_REL(made[1]->events, made[0]->events, 0.05);
        drifting_advance(&cloud);
    }
    assert_int_equal(calls[0].n_pairs, 24);
    const int64_t n_pairs = calls[1].n_pairs; // three by the clock; cells may contradict one
    assert_in_range(n_pairs, 3, 5);
    for (int64_t i = 0; i < 3 * 2700; ++i) { // all but a few points into the blob's middle
        cloud.x[i] = 0.5 + 0.1 * (cloud.x[i] - 0.5);
    }
    const clast_decomposition *last = NULL;
    CHECK_OK(clast_workspace_decompose(loop[1], &points, &c, &last));
    CHECK_OK(clast_workspace_count(loop[1], &calls[1]));
    assert_int_equal(calls[1].n_pairs, n_pairs + 1);
    clast_workspace_destroy(loop[0]);
    clast_workspace_destroy(loop[1]);
    drifting_free(&cloud);
    clast_fields_free(clast_decompose_fields, &c);
}

/* Two calls, the second by cells that are kept. */
static clast_status keep_once(void *context)
{
    clast_workspace *workspace = NULL;
    const clast_decomposition *made = NULL;
    clast_workspace_policy policy = {CLAST_TESTS_MOVED, 1, 0.5, CLAST_CUT_CHANGED, 1, 0.05, 0, 0};
    const clast_points points = {
        .n = 30, .dimension = 3, .x = dense, .stride = 3, .axis_stride = 1};
    clast_status status = clast_workspace_create(&workspace);
    if (status == CLAST_OK) {
        status = clast_workspace_set_policy(workspace, &policy);
    }
    for (int k = 0; k < 2 && status == CLAST_OK; ++k) {
        status = clast_workspace_decompose(workspace, &points, context, &made);
    }
    clast_workspace_destroy(workspace);
    return status;
}

static void every_refused_allocation_is_told(void **state)
{
    (void)state;
    clast_decompose_config c = config_of("auto");
    CHECK_OK(
        clast_field_set(clast_fields_find(clast_decompose_fields, "tests"), &c, "pearson", false));
    fill(6);
    support_refuse_each_allocation(make_once, &c);
    support_refuse_each_allocation(keep_once, &c);
    clast_fields_free(clast_decompose_fields, &c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_layout_gives_the_cells_of_dense_arrays),
        cmocka_unit_test(weights_are_read_with_their_stride),
#ifdef CLAST_ALLOC_INJECT
        cmocka_unit_test(repeated_calls_take_no_memory),
        cmocka_unit_test(repeated_collisions_take_no_memory),
        cmocka_unit_test(a_long_loop_keeps_its_heap),
#endif
        cmocka_unit_test(threads_of_the_caller_do_not_disturb_each_other),
        cmocka_unit_test(bad_points_are_told_and_leave_no_result),
        cmocka_unit_test(tests_leave_no_decomposition),
        cmocka_unit_test(first_call_is_that_of_clast_decompose),
        cmocka_unit_test(kept_cells_hold_the_points_of_the_call),
        cmocka_unit_test(policies_test_and_cut_when_they_say),
        cmocka_unit_test(a_count_of_pairs_is_carried_from_cut_to_cut),
        cmocka_unit_test(kept_cells_have_the_same_bytes_for_any_threads),
        cmocka_unit_test(any_domain_is_taken),
        cmocka_unit_test(policies_that_cannot_be_are_refused),
        cmocka_unit_test(every_refused_allocation_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
