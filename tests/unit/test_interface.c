/* Unit: public functions that no command, example or other test calls do what their headers say. */
#define _GNU_SOURCE 1 // feenableexcept
#include "support.h"

#include "base/parallel.h"
#include <clast/clast.h>
#include <fenv.h>
#include <math.h>
#include <stdatomic.h>
#include <string.h>
#include <unistd.h>

static void every_number_has_its_name(void **state)
{
    (void)state;
    assert_string_equal(clast_aggregate_fit_observable_name(CLAST_FIT_DENSITY), "density");
    assert_string_equal(clast_aggregate_fit_observable_unit(CLAST_FIT_SIZE), "m");
    assert_string_equal(clast_fit_verdict_name(CLAST_FIT_EDGE), "edge");
    for (int32_t k = 0; k < CLAST_N_AXES; ++k) {
        assert_non_null(clast_axes_source(k));
    }
    assert_null(clast_axes_source(CLAST_N_AXES));
    for (int k = 0; k < CLAST_N_ROW_FAULT; ++k) {
        assert_non_null(clast_row_fault_text((clast_row_fault)k));
    }
}

static void one_form_factor_is_that_of_all(void **state)
{
    (void)state;
    double all[CLAST_N_FORM_FACTOR];
    clast_form_factors(3.0, 2.0, 1.0, all);
    for (int k = 0; k < CLAST_N_FORM_FACTOR; ++k) {
        CHECK_REL(clast_form_factor_value((clast_form_factor)k, 3.0, 2.0, 1.0), all[k], 0.0);
    }
}

static void a_sum_of_kernels_needs_what_each_needs(void **state)
{
    (void)state;
    const clast_kernel_info *row = clast_kernel_table();
    for (int k = 1; k < CLAST_N_KERNEL; ++k) {
        assert_int_equal(clast_kernel_needs(1U | 1U << k), row[0].needs | row[k].needs);
    }
}

static void volume_takes_values_of_either_order(void **state)
{
    (void)state;
    const int32_t n[3] = {2, 1, 1};
    const unsigned char bytes[4] = {1, 2, 3, 4};
    clast_volume v = {0};
    CHECK_OK(clast_volume_alloc(n, &v));
    clast_volume_fill(&v, 0, 2, CLAST_VOLUME_U16, true, bytes);
    CHECK_REL(v.value[1], 0x0304, 0.0);
    clast_volume_fill(&v, 0, 2, CLAST_VOLUME_U16, false, bytes);
    CHECK_REL(v.value[1], 0x0403, 0.0);
    clast_volume_free(&v);
    assert_true(clast_volume_is_known("NRRD0004\n", 9));
    assert_false(clast_volume_is_known("solid x", 7));
}

static void a_ball_has_power_in_degree_zero(void **state)
{
    (void)state;
    clast_harmonics series = {0};
    CHECK_OK(clast_harmonics_alloc(3, &series));
    series.coefficient[0][0] = 3.0;
    CHECK_REL(clast_harmonics_power(&series, 0, 3), 9.0, 1e-15);
    CHECK_ABS(clast_harmonics_power(&series, 1, 3), 0.0, 0.0);
    clast_harmonics_free(&series);
}

static void slices_of_a_cylinder_have_their_volumes(void **state)
{
    (void)state;
    const clast_bed bed = {.kind = CLAST_BED_CYLINDER, .radius = 2.0};
    const double edge[3] = {0.0, 1.0, 3.0};
    double volume[2];
    clast_bed_volumes(&bed, 2, edge, volume);
    CHECK_REL(volume[0], 4.0 * CLAST_PI, 1e-14);
    CHECK_REL(volume[1], 8.0 * CLAST_PI, 1e-14);
}

static void a_configuration_is_checked_and_told(void **state)
{
    (void)state;
    clast_pack_config config;
    char *text = NULL;
    CHECK_OK(clast_fields_default(clast_pack_fields, &config));
    CHECK_OK(clast_fields_json(clast_pack_fields, &config, &text));
    assert_int_equal(text[0], '{');
    assert_non_null(strstr(text, "\"shaking_time\""));
    config.checkpoint_time = NAN;
    CHECK_STATUS(clast_fields_check(clast_pack_fields, &config), CLAST_E_CONFIG);
    clast_text_free(text);
    clast_fields_free(clast_pack_fields, &config);
    assert_int_equal(clast_bootstrap_default().n_resample, 2000);
}

enum { N_LOOP = 2000, N_CALL = 4 };

/// Events of each call of a flow solver's loop: a dense corner, thinned out, no point, all at one
/// place; and what is left of them after collisions.
static void run_loop(const double *x, double events[N_CALL], int64_t *n_event)
{
    static double at[3 * N_LOOP], size[N_LOOP];
    static int64_t monomers[N_LOOP], owner[N_LOOP];
    static int32_t cell[N_LOOP];
    clast_workspace *workspace = NULL;
    clast_decompose_config config;
    clast_workspace_policy policy;
    clast_collide_config collide;
    clast_domain box;
    CHECK_OK(clast_workspace_create(&workspace));
    CHECK_OK(clast_domain_parse("box:0,0,0,1,1,1", &box));
    CHECK_OK(clast_fields_default(clast_decompose_fields, &config));
    CHECK_OK(clast_fields_default(clast_workspace_fields, &policy));
    policy.tests = CLAST_TESTS_MOVED;
    policy.cells = CLAST_CUT_CHANGED;
    CHECK_OK(clast_workspace_set_policy(workspace, &policy));
    for (int k = 0; k < N_CALL; ++k) {
        static const int64_t n[N_CALL] = {N_LOOP, N_LOOP - 100, 0, N_LOOP};
        const clast_points points = {
            .n = n[k], .dimension = 3, .x = x, .stride = k < 3 ? 3 : 1, .axis_stride = k < 3};
        const clast_points same = {
            .n = n[k], .dimension = 3, .x = at, .stride = 3, .axis_stride = 1};
        const clast_decomposition *made = NULL;
        CHECK_OK(
            clast_workspace_decompose_in(workspace, &box, k < 3 ? &points : &same, &config, &made));
        events[k] = made->events;
    }
    for (int64_t i = 0; i < N_LOOP; ++i) {
        size[i] = 1.0;
        monomers[i] = 1;
        owner[i] = i;
    }
    const double volume = 1.0;
    const clast_collide_cells cells = {.n = 1, .of_particle = cell, .volume = &volume};
    clast_population p = {N_LOOP, 3, at, monomers, size, size, NULL, NULL, owner, NULL};
    CHECK_OK(clast_collide_config_default(&collide));
    CHECK_OK(clast_kernel_parse("constant", &collide.kernel));
    collide.medium.constant = 1e-4;
    CHECK_OK(clast_workspace_collide(workspace, &p, &cells, (clast_workspace_step){1.0, 1},
                                     &collide, n_event));
    clast_workspace_destroy(workspace);
    clast_fields_free(clast_decompose_fields, &config);
}

/* OpenFOAM traps floating-point exceptions unless it is told not to, gfortran with -ffpe-trap: the
   first call of a workspace ended such a solver by SIGFPE. */
static void a_host_may_trap_and_round_as_it_likes(void **state)
{
    (void)state;
    static double x[3 * N_LOOP];
    double events[2][N_CALL];
    int64_t n_event[2];
    uint64_t dice = 1;
    for (int i = 0; i < 3 * N_LOOP; ++i) {
        dice = dice * 6364136223846793005U + 1442695040888963407U;
        const double u = (double)(dice >> 11) * 0x1p-53;
        x[i] = u * u * u;
    }
    run_loop(x, events[0], &n_event[0]);
    assert_int_equal(fesetround(FE_UPWARD), 0);
    (void)feclearexcept(FE_ALL_EXCEPT);
#ifdef __GLIBC__
    const int traps = FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW;
    const bool can_trap = feenableexcept(traps) != -1 && fegetexcept() == traps;
#endif
    run_loop(x, events[1], &n_event[1]);
#ifdef __GLIBC__
    const int left = fegetexcept();
    (void)fedisableexcept(FE_ALL_EXCEPT);
    assert_true(!can_trap || left == traps);
#endif
    assert_int_equal(fegetround(), FE_UPWARD);
    (void)fesetround(FE_TONEAREST);
    assert_memory_equal(events[0], events[1], sizeof events[0]);
    assert_int_equal(n_event[0], n_event[1]);
}

/// Rounding of the threads that were at work.
static void note_rounding(int64_t begin, int64_t end, int32_t worker, void *context)
{
    (void)begin;
    (void)end;
    (void)usleep(100); // so that others wake in time
    atomic_fetch_or((_Atomic int *)context, worker > 0 ? 1 << (fegetround() != FE_TONEAREST) : 0);
}

/* The team keeps the environment that its threads were made in: those of a caller that rounded
   otherwise would have gone on so for ever, in part of the blocks. */
static void threads_round_to_nearest(void **state)
{
    (void)state;
    _Atomic int seen = 0;
    clast_parallel_set_threads(7); // more than were made before
    (void)fesetround(FE_UPWARD);
    for (int k = 0; k < 20 && (seen & 2) == 0; ++k) {
        clx_parallel_for(100, 1, note_rounding, &seen);
    }
    (void)fesetround(FE_TONEAREST);
    clast_parallel_set_threads(0);
    assert_int_equal(seen & 2, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_number_has_its_name),
        cmocka_unit_test(one_form_factor_is_that_of_all),
        cmocka_unit_test(a_sum_of_kernels_needs_what_each_needs),
        cmocka_unit_test(volume_takes_values_of_either_order),
        cmocka_unit_test(a_ball_has_power_in_degree_zero),
        cmocka_unit_test(slices_of_a_cylinder_have_their_volumes),
        cmocka_unit_test(a_configuration_is_checked_and_told),
        cmocka_unit_test(threads_round_to_nearest),
        cmocka_unit_test(a_host_may_trap_and_round_as_it_likes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
