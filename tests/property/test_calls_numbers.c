/* Property: calls with numbers that cannot be, which no struct of any bytes meets by chance: a
 * confidence that is none, means of nothing, memory that others gave; and messages that name what
 * the caller has called, and what he gave. */
#include "support.h"

#include <stdlib.h>
#include <string.h>

/* Before: -1 gave infinite bounds, 95 a turned interval, NaN one of the greatest quantile. */
static void confidences_that_cannot_be_have_no_interval(void **state)
{
    (void)state;
    const double bad[] = {(double)NAN, -1.0, 0.0, 1.0, 95.0, (double)INFINITY};
    const double value[2] = {1.0, 3.0};
    clast_table history = {0};
    clast_table band = {0};
    double *n = NULL;
    CHECK_OK(clast_table_init(&history, "history", 2));
    CHECK_OK(clast_table_add_number(&history, "d_agg_m", "m", NULL));
    CHECK_OK(clast_table_add_text(&history, "porosity_said")); /* no numbers, so no band */
    CHECK_OK(clast_table_add_number(&history, "n", "-", &n));
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        const clast_interval i = clast_interval_of(2, value, bad[k]);
        assert_true(i.n == 2 && i.mean == 2.0 && isnan(i.low) && isnan(i.high));
        assert_true(isnan(clast_interval_of(1, value, bad[k]).high));
        CHECK_STATUS(clast_aggregate_band(&history, bad[k], &band), CLAST_E_ARGUMENT);
        assert_int_equal(band.n_column, 0);
    }
    CHECK_OK(clast_aggregate_band(&history, 0.95, &band));
    assert_int_equal(band.n_column, 5);
    clast_table_free(&band);
    n[1] = 1e300; /* particles: more than any memory has rows for */
    CHECK_OK(clast_memory_set_limit(1 << 28));
    CHECK_STATUS(clast_aggregate_band(&history, 0.95, &band), CLAST_E_MEMORY);
    CHECK_OK(clast_memory_set_limit(0));
    clast_table_free(&history);
}

/* Before, the mean of none was 0, and of -1 numbers -0. */
static void a_mean_of_nothing_is_no_number(void **state)
{
    (void)state;
    const double value[2] = {1.0, 3.0};
    for (int32_t n = -1; n <= 0; ++n) {
        const clast_mean m = clast_mean_of(n, value);
        const clast_interval i = clast_interval_of(n, value, 0.95);
        assert_true(m.n == 0 && isnan(m.mean) && isnan(m.low) && isnan(m.high));
        assert_true(i.n == 0 && isnan(i.mean) && isnan(i.low) && isnan(i.high));
    }
    assert_true(isnan(clast_mean_of(2, NULL).mean));
    assert_true(isnan(clast_interval_of(2, NULL, 0.95).mean));
    assert_true(clast_mean_of(2, value).mean == 2.0);
}

/* Before, freeing what the caller had allocated made it negative. */
static void memory_taken_is_never_below_none(void **state)
{
    (void)state;
    clast_mesh mesh = {.n_vert = 100000};
    mesh.vert = calloc(100000, sizeof *mesh.vert);
    assert_non_null(mesh.vert);
    clast_mesh_free(&mesh);
    assert_true(clast_memory_taken() >= 0);
}

/// The message of the last refusal holds this text.
static void check_told(const char *text)
{
    if (strstr(clast_error_detail(), text) == NULL) {
        fail_msg("'%s' does not say '%s'", clast_error_detail(), text);
    }
}

static void messages_name_what_was_called(void **state)
{
    (void)state;
    clast_spectrum_config config;
    clast_spectrum spectrum;
    clast_evolve_config evolving;
    clast_evolve *evolve = NULL;
    const clast_agglomerate_input none = {.n_snapshot = 1};
    clast_agglomerate_config agglomerating = {0};
    clast_agglomeration made;
    clast_pairs pairs;
    const clast_cloud cloud = {.dimension = 3};
    const clast_evolve_input hollow = {0};
    CHECK_OK(clast_fields_default(clast_spectrum_fields, &config));
    CHECK_STATUS(clast_spectrum_evolve(NULL, &config, NULL, NULL, &spectrum), CLAST_E_ARGUMENT);
    check_told("clast_spectrum_evolve: collide is NULL");
    CHECK_STATUS(clast_agglomerate(&none, &agglomerating, NULL, &made), CLAST_E_ARGUMENT);
    check_told("clast_agglomerate: input->snapshot is NULL");
    CHECK_STATUS(clast_pairs_count(NULL, &cloud, &(clast_pairs_config){0}, &pairs),
                 CLAST_E_ARGUMENT);
    check_told("clast_pairs_count: domain is NULL");
    CHECK_OK(clast_fields_default(clast_evolve_fields, &evolving));
    CHECK_STATUS(clast_evolve_create(&evolving, &hollow, &evolve), CLAST_E_ARGUMENT);
    check_told("clast_evolve_create: input->domain is NULL");
    clast_fields_free(clast_evolve_fields, &evolving);
    clast_fields_free(clast_spectrum_fields, &config);
}

/* Before: "lie outside the domain ; give". */
static void a_domain_without_a_name_leaves_no_gap(void **state)
{
    (void)state;
    double x[3] = {0.5, 0.5, 7.0};
    const clast_cloud cloud = {.n = 1, .dimension = 3, .x = x};
    clast_decompose_config config;
    clast_decomposition made;
    clast_domain domain;
    CHECK_OK(clast_fields_default(clast_decompose_fields, &config));
    CHECK_OK(clast_domain_parse("box:0,0,0,1,1,1", &domain));
    assert_string_equal(config.domain, "");
    CHECK_STATUS(clast_decompose_in(&domain, &cloud, &config, &made), CLAST_E_FORMAT);
    check_told("lie outside the domain; give");
    clast_fields_free(clast_decompose_fields, &config);
}

static void numbers_that_are_not_finite_are_told_as_such(void **state)
{
    (void)state;
    const double bad[] = {(double)NAN, (double)INFINITY, -1.0};
    clast_mesh box = {0};
    clast_mesh out = {0};
    clast_drag drag;
    clast_settling settling;
    const clast_fluid air = clast_fluid_air();
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &box));
    CHECK_OK(clast_drag_of_form(1e-3, 1e-3, 1e-3, 1e-3, 2000.0, &drag));
    for (int k = 0; k < 3; ++k) {
        CHECK_STATUS(clast_mesh_weld(&box, bad[k], &out, NULL), CLAST_E_USAGE);
        check_told("must be finite and not negative");
        CHECK_STATUS(clast_terminal_velocity(1e-3, bad[k], &drag, &air, &settling), CLAST_E_USAGE);
        check_told("must be finite and above 0");
    }
    clast_mesh_free(&box);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(confidences_that_cannot_be_have_no_interval),
        cmocka_unit_test(a_mean_of_nothing_is_no_number),
        cmocka_unit_test(memory_taken_is_never_below_none),
        cmocka_unit_test(messages_name_what_was_called),
        cmocka_unit_test(a_domain_without_a_name_leaves_no_gap),
        cmocka_unit_test(numbers_that_are_not_finite_are_told_as_such),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
