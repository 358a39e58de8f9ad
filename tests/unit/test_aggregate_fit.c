/* Unit: a fit finds what an aggregate was grown with, and says when nothing explains it. */
#include "support.h"

#include <string.h>

/* A faceted ball of 100 um in a coat of such balls of 20 and 30 um. */
typedef struct scene {
    clast_aggregate_config config;
    clast_assembly core, coat;
    clast_sizes sizes;
    clast_aggregate_input input;
} scene;

static void set_up(scene *s)
{
    static const double no_turn[4] = {1.0, 0.0, 0.0, 0.0};
    clast_shape ball = {0};
    clast_mesh mesh = {0};
    *s = (scene){0};
    CHECK_OK(clast_fields_default(clast_aggregate_fields, &s->config));
    CHECK_OK(clast_mesh_ellipsoid((double[3]){0.5, 0.5, 0.5}, 0, &mesh));
    CHECK_OK(clast_shape_mesh("ball", &mesh, &ball));
    clast_mesh_free(&mesh);
    CHECK_OK(clast_assembly_add_shape(&s->core, &ball, NULL));
    CHECK_OK(clast_assembly_add_grain(&s->core, 0, (double[3]){0, 0, 0}, no_turn, 1e-4, 2500.0));
    CHECK_OK(clast_assembly_add_shape(&s->coat, &ball, NULL));
    CHECK_OK(clast_assembly_add_grain(&s->coat, 0, (double[3]){0, 0, 0}, no_turn, 1.0, 2500.0));
    CHECK_OK(clast_sizes_alloc(2, &s->sizes));
    s->sizes.low[0] = s->sizes.high[0] = 2e-5;
    s->sizes.low[1] = s->sizes.high[1] = 3e-5;
    s->sizes.count[0] = s->sizes.count[1] = 10.0;
    s->input = (clast_aggregate_input){&s->core, 1, &s->coat, &s->sizes};
    clast_shape_free(&ball);
    const clast_field *field = clast_fields_find(clast_aggregate_fields, "coat");
    CHECK_OK(clast_field_set(field, &s->config, "sphere", true));
    field = clast_fields_find(clast_aggregate_fields, "core");
    CHECK_OK(clast_field_set(field, &s->config, "sphere", false));
    field =
        clast_fields_find(clast_aggregate_fields, "size"); /* the input's sizes are what counts */
    CHECK_OK(clast_field_set(field, &s->config, "20 um", true));
    field = clast_fields_find(clast_aggregate_fields, "fit_packing");
    CHECK_OK(clast_field_set(field, &s->config, "1deg:1:1", true));
    CHECK_OK(clast_field_set(field, &s->config, "90deg:4:1", true));
    CHECK_OK(clast_field_set(field, &s->config, "90deg:16:1", true));
    s->config.params.core_size = 1e-4;
    s->config.params.order = CLAST_ORDER_SHUFFLED;
    s->config.fit_replicate_max = 4;
    s->config.fit_repeats = 3;
}

static void tear_down(scene *s)
{
    clast_fields_free(clast_aggregate_fields, &s->config);
    clast_assembly_free(&s->core);
    clast_assembly_free(&s->coat);
    clast_sizes_free(&s->sizes);
}

/* Size and density of one aggregate of another seed. */
static void observe(scene *s, int32_t rays, int32_t replicate)
{
    clast_aggregate *aggregate = NULL;
    clast_aggregate_result result;
    clast_aggregate_config config = s->config;
    config.params.seed = 77;
    config.params.cone = 0.5 * CLAST_PI;
    config.params.rays = rays;
    config.params.replicate = replicate;
    CHECK_OK(clast_aggregate_create(&config.params, &s->input, 0, &aggregate));
    CHECK_OK(clast_aggregate_grow(aggregate, 100000, NULL));
    CHECK_OK(clast_aggregate_measure(aggregate, &result));
    clast_aggregate_destroy(aggregate);
    s->config.observed_size = result.d_agg;
    s->config.observed_size_error = 0.03 * result.d_agg;
    s->config.observed_density = result.density;
    s->config.observed_density_error = 0.05 * result.density;
}

static void fit_finds_what_it_was_grown_with(void **state)
{
    (void)state;
    scene s;
    clast_aggregate_fit fit;
    clast_table nodes = {0};
    set_up(&s);
    observe(&s, 4, 3);
    CHECK_OK(clast_aggregate_fit_run(&s.config, &s.input, NULL, &fit, &nodes));
    assert_int_equal(fit.verdict, CLAST_FIT_INSIDE);
    assert_int_equal(fit.n_choice, 2); /* two data, two choices: no p-value */
    assert_int_equal(fit.n_freedom, 0);
    assert_true(isnan(fit.p_value));
    assert_non_null(strstr(fit.words, "no degree of freedom is left"));
    assert_int_equal(fit.packing_edge, 0);
    assert_int_equal(fit.rays, 4);
    assert_in_range(fit.replicate, 2, 4);
    assert_true(fit.n_replica.low <= 3.0 && 3.0 <= fit.n_replica.high);
    assert_true(fit.trials.low <= 4.0 && 4.0 <= fit.trials.high);
    assert_true(fabs(fit.pull[CLAST_FIT_SIZE]) <= 2.0 && fabs(fit.pull[CLAST_FIT_DENSITY]) <= 2.0);
    assert_true(isnan(fit.observed[CLAST_FIT_VELOCITY]));
    assert_true(fit.model[CLAST_FIT_VELOCITY].best > 0.0);
    assert_int_equal(fit.n_observed, 2);
    assert_non_null(strstr(fit.words, "yes, inside the observed interval: size "));
    assert_non_null(strstr(fit.words, " um against "));
    /* the table: weights sum to 1, grown rows have runs, chi2 is least at the best row */
    const double *weight = clast_table_numbers(&nodes, "weight");
    const double *chi2 = clast_table_numbers(&nodes, "chi2");
    double sum = 0.0;
    double least = INFINITY;
    double runs = 0.0;
    for (int64_t i = 0; i < nodes.n_row; ++i) {
        sum += weight[i];
        least = fmin(least, chi2[i]);
        runs += clast_table_numbers(&nodes, "n_run")[i];
    }
    CHECK_REL(sum, 1.0, 1e-12);
    CHECK_REL(least, fit.chi2, 1e-12);
    CHECK_REL(runs, fit.n_run, 1e-15);
    clast_table_free(&nodes);
    tear_down(&s);
}

/* A density of 402 against 310 +- 50 on the border of the grid was called "reached". */
static void fit_says_when_the_best_is_at_the_edge(void **state)
{
    (void)state;
    scene s;
    clast_aggregate_fit fit;
    clast_table nodes = {0};
    char *text = NULL;
    set_up(&s);
    observe(&s, 1, 3);
    s.config.observed_density *= 0.3; /* three times looser than loose */
    s.config.observed_density_error *= 0.3;
    CHECK_OK(clast_aggregate_fit_run(&s.config, &s.input, NULL, &fit, &nodes));
    assert_int_equal(fit.verdict, CLAST_FIT_EDGE);
    assert_int_equal(fit.packing_edge, -1);
    assert_true(fit.pull[CLAST_FIT_DENSITY] > 2.0);
    assert_int_equal(fit.at_level, 0);
    assert_true(fit.least[CLAST_FIT_DENSITY] > s.config.observed_density);
    assert_non_null(strstr(fit.words, "at the edge of what was tried"));
    assert_non_null(strstr(fit.words, "loosest"));
    CHECK_OK(clast_aggregate_fit_json(&fit, &text));
    assert_non_null(strstr(text, "\"verdict\": \"edge\""));
    assert_non_null(strstr(text, "\"packing\": \"loosest\""));
    assert_non_null(strstr(text, "\"p_value\": null"));
    clast_text_free(text);
    clast_table_free(&nodes);
    tear_down(&s);
}

/* One packing alone is the loosest that was tried: 407 against 310 +- 50 was "no, within what was
   tried". */
static void fit_of_one_packing_ends_at_its_edge(void **state)
{
    (void)state;
    static const double factor[2] = {0.3, 3.0}; /* of the density that it has: looser, tighter */
    static const char *const word[2] = {"loosest", "tightest"};
    for (int k = 0; k < 2; ++k) {
        scene s;
        clast_aggregate_fit fit;
        clast_table nodes = {0};
        set_up(&s);
        const clast_field *field = clast_fields_find(clast_aggregate_fields, "fit_packing");
        CHECK_OK(clast_field_set(field, &s.config, "1deg:1:1", false));
        observe(&s, 1, 3);
        s.config.observed_density *= factor[k];
        s.config.observed_density_error *= factor[k];
        CHECK_OK(clast_aggregate_fit_run(&s.config, &s.input, NULL, &fit, &nodes));
        assert_int_equal(fit.n_level, 1);
        assert_int_equal(fit.packing_edge, k == 0 ? -1 : 1);
        assert_int_equal(fit.verdict, CLAST_FIT_EDGE);
        assert_int_equal(fit.n_freedom, 1);
        assert_non_null(strstr(fit.words, word[k]));
        clast_table_free(&nodes);
        tear_down(&s);
    }
}

/* A velocity that no packing has leaves the choice to size and density, and a degree of freedom. */
static void fit_says_no_within_what_was_tried(void **state)
{
    (void)state;
    scene s;
    clast_aggregate_fit fit;
    clast_table nodes = {0};
    set_up(&s);
    observe(&s, 4, 2);
    s.config.observed_velocity = 1e3;
    s.config.observed_velocity_error = 200.0;
    CHECK_OK(clast_aggregate_fit_run(&s.config, &s.input, NULL, &fit, &nodes));
    assert_int_equal(fit.verdict, CLAST_FIT_NO);
    assert_int_equal(fit.packing_edge, 0);
    assert_int_equal(fit.replicate_edge, 0);
    assert_int_equal(fit.n_freedom, 1);
    CHECK_REL(fit.p_value, erfc(sqrt(0.5 * fit.chi2)), 1e-12); /* chi2 of one normal number */
    assert_non_null(strstr(fit.words, "no, outside the observed interval"));
    assert_non_null(strstr(fit.words, "p-value"));
    clast_table_free(&nodes);
    tear_down(&s);
}

typedef struct progress {
    int32_t n;
    int64_t done, total;
} progress;

static void note_progress(void *context, const char *phase, int64_t done, int64_t total)
{
    progress *p = context;
    assert_non_null(strstr(phase, "aggregates"));
    assert_true(done >= p->done && total >= done && total > 0);
    *p = (progress){p->n + 1, done, total};
}

static void fit_reports_a_total(void **state)
{
    (void)state;
    scene s;
    clast_aggregate_fit fit;
    clast_table nodes = {0};
    progress p = {0};
    const clast_monitor monitor = {.report = note_progress, .context = &p};
    set_up(&s);
    observe(&s, 4, 2);
    CHECK_OK(clast_aggregate_fit_run(&s.config, &s.input, &monitor, &fit, &nodes));
    assert_true(p.n > 3);
    assert_int_equal(p.done, fit.n_run);
    assert_int_equal(p.total, fit.n_run);
    clast_table_free(&nodes);
    tear_down(&s);
}

static void fit_is_the_same_for_any_threads(void **state)
{
    (void)state;
    scene s;
    clast_aggregate_fit fit[2];
    clast_table nodes[2] = {{0}, {0}};
    set_up(&s);
    observe(&s, 1, 2);
    s.config.fit_replicate_max = 3;
    for (int32_t t = 0; t < 2; ++t) {
        clast_parallel_set_threads(t + 1);
        CHECK_OK(clast_aggregate_fit_run(&s.config, &s.input, NULL, &fit[t], &nodes[t]));
    }
    clast_parallel_set_threads(0);
    assert_int_equal(nodes[0].n_row, nodes[1].n_row);
    for (int32_t c = 0; c < nodes[0].n_column; ++c) {
        assert_memory_equal(nodes[0].column[c].number, nodes[1].column[c].number,
                            (size_t)nodes[0].n_row * sizeof(double));
    }
    assert_string_equal(fit[0].words, fit[1].words);
    clast_table_free(&nodes[0]);
    clast_table_free(&nodes[1]);
    tear_down(&s);
}

static bool stop_at_once(void *context)
{
    (void)context;
    return true;
}

static void fit_refuses_what_it_cannot_do(void **state)
{
    (void)state;
    scene s;
    clast_aggregate_fit fit;
    clast_table nodes = {0};
    const clast_monitor monitor = {.stop = stop_at_once};
    set_up(&s);
    CHECK_STATUS(clast_aggregate_fit_run(&s.config, &s.input, NULL, &fit, &nodes), CLAST_E_CONFIG);
    s.config.observed_size = 2e-4;
    CHECK_STATUS(clast_aggregate_fit_run(&s.config, &s.input, NULL, &fit, &nodes), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "size"));
    s.config.observed_size_error = 1e-5;
    s.config.params.rays = 7;
    CHECK_STATUS(clast_aggregate_fit_run(&s.config, &s.input, NULL, &fit, &nodes), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "fit_packing"));
    s.config.params.rays = 1;
    s.config.params.stop_size = 1.0;
    CHECK_STATUS(clast_aggregate_fit_run(&s.config, &s.input, NULL, &fit, &nodes), CLAST_E_CONFIG);
    s.config.params.stop_size = 0.0;
    CHECK_STATUS(clast_aggregate_fit_run(&s.config, &s.input, &monitor, &fit, &nodes),
                 CLAST_E_STOPPED);
    static const char *const wrong[] = {"1deg:1", "1deg:0:1", "1deg:1:1:1", "x:1:1", "200deg:1:1"};
    const clast_field *field = clast_fields_find(clast_aggregate_fields, "fit_packing");
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; ++i) {
        clast_field_clear(field, &s.config);
        CHECK_OK(clast_field_set(field, &s.config, wrong[i], true));
        CHECK_STATUS(clast_aggregate_fit_run(&s.config, &s.input, NULL, &fit, &nodes),
                     CLAST_E_CONFIG);
        assert_non_null(strstr(clast_error_detail(), wrong[i]));
    }
    tear_down(&s);
}

static clast_status make_fit(void *context)
{
    scene *s = context;
    clast_aggregate_fit fit;
    clast_table nodes = {0};
    const clast_status status = clast_aggregate_fit_run(&s->config, &s->input, NULL, &fit, &nodes);
    clast_table_free(&nodes);
    return status;
}

static void fit_survives_refused_memory(void **state)
{
    (void)state;
    scene s;
    set_up(&s);
    s.sizes.count[0] = s.sizes.count[1] = 1.0;
    s.config.observed_size = 1.2e-4;
    s.config.observed_size_error = 1e-5;
    s.config.fit_replicate_max = 1;
    s.config.fit_repeats = 2;
    clast_field_clear(clast_fields_find(clast_aggregate_fields, "fit_packing"), &s.config);
    CHECK_OK(clast_field_set(clast_fields_find(clast_aggregate_fields, "fit_packing"), &s.config,
                             "1deg:1:1", true));
    clast_parallel_set_threads(1);
    support_refuse_each_allocation(make_fit, &s);
    clast_parallel_set_threads(0);
    tear_down(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fit_finds_what_it_was_grown_with),
        cmocka_unit_test(fit_says_when_the_best_is_at_the_edge),
        cmocka_unit_test(fit_of_one_packing_ends_at_its_edge),
        cmocka_unit_test(fit_says_no_within_what_was_tried),
        cmocka_unit_test(fit_reports_a_total),
        cmocka_unit_test(fit_is_the_same_for_any_threads),
        cmocka_unit_test(fit_refuses_what_it_cannot_do),
        cmocka_unit_test(fit_survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
