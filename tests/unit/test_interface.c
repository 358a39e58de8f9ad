/* Unit: public functions that no command, example or other test calls do what their headers say. */
#include "support.h"

#include <clast/clast.h>
#include <math.h>
#include <string.h>

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
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
