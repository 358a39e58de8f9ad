/* Unit: decompositions on the caller's arrays: any layout, no memory from the system when repeated,
 * any number beside each other. */
#include "support.h"

#include "base/alloc.h"
#include "math/rng.h"
#include <clast/parallel.h>
#include <clast/workspace.h>
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
    CHECK_STATUS(clast_workspace_cells(workspace, cell, 1), CLAST_E_USAGE);
    CHECK_STATUS(clast_workspace_events(workspace, events, 1), CLAST_E_USAGE);
    for (int k = 0; k < 3; ++k) {
        const clast_decomposition *made = NULL;
        double sum = 0.0;
        CHECK_OK(clast_workspace_decompose(workspace, &layout[k], &c, &made));
        assert_memory_equal(made->cells.of_point, plain.cells.of_point,
                            N * sizeof *plain.cells.of_point);
        CHECK_REL(made->events, plain.events, 0.0);
        CHECK_OK(clast_workspace_cells(workspace, cell, 2));
        CHECK_OK(clast_workspace_events(workspace, events, 3));
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
    CHECK_OK(clast_workspace_cells(workspace, cell, 1));
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
    CHECK_STATUS(clast_workspace_cells(workspace, &cell, 1), CLAST_E_USAGE);
    dense[7] = 0.5;
    CHECK_OK(clast_workspace_decompose(workspace, &points, &c, &made));
    points.dimension = 4;
    CHECK_STATUS(clast_workspace_decompose(workspace, &points, &c, &made), CLAST_E_ARGUMENT);
    clast_workspace_destroy(workspace);
    clast_workspace_destroy(NULL);
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

static void every_refused_allocation_is_told(void **state)
{
    (void)state;
    clast_decompose_config c = config_of("auto");
    CHECK_OK(
        clast_field_set(clast_fields_find(clast_decompose_fields, "tests"), &c, "pearson", false));
    fill(6);
    support_refuse_each_allocation(make_once, &c);
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
#endif
        cmocka_unit_test(threads_of_the_caller_do_not_disturb_each_other),
        cmocka_unit_test(bad_points_are_told_and_leave_no_result),
        cmocka_unit_test(every_refused_allocation_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
