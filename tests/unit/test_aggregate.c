/* Unit: aggregates whose geometry is known. */
#include "aggregates.h"

#include "base/alloc.h"
#include <clast/aggregate_run.h>
#include <clast/settling.h>
#include <stdio.h>
#include <string.h>

static double distance(const double a[3], const double b[3])
{
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                (a[2] - b[2]) * (a[2] - b[2]));
}

static void two_spheres_touch_with_the_known_porosity(void **state)
{
    (void)state;
    for (int q = 1; q <= 10; q += 1) {
        support_aggregate s;
        char options[128];
        (void)snprintf(options, sizeof options,
                       "core_size=%d;size_law=uniform;size_low=1;"
                       "size_high=1;n_particle=1",
                       q);
        support_aggregate_make(&s, NULL, 1, options);
        clast_aggregate *a = support_aggregate_run(&s, 0);
        const clast_assembly *all = clast_aggregate_assembly(a);
        assert_int_equal(all->n_grain, 2);
        assert_int_equal(all->n_contact, 1);
        CHECK_REL(distance(all->position[0], all->position[1]), 0.5 * (q + 1), 1e-14);
        CHECK_REL(distance(all->position[0], all->contact_point[0]), 0.5 * q, 1e-14);
        clast_aggregate_result result;
        const double p = q;
        CHECK_OK(clast_aggregate_measure(a, &result));
        CHECK_ABS(result.porosity[0], p * p / (1.0 + p + p * p + p * p * p + p * p * p * p), 1e-6);
        clast_aggregate_destroy(a);
        support_aggregate_free(&s);
    }
}

static void spheres_never_overlap(void **state)
{
    (void)state;
    support_aggregate s;
    support_aggregate_make(&s, NULL, 1,
                           "size_law=lognormal;size_mean=0.3;size_shape=0.5;n_particle=150;"
                           "cone=50deg;rays=10;orientations=4;envelope_every=50");
    clast_aggregate *a = support_aggregate_run(&s, 0);
    const clast_assembly *all = clast_aggregate_assembly(a);
    assert_int_equal(all->n_grain, 151);
    for (int32_t i = 0; i < all->n_grain; ++i) {
        double nearest = HUGE_VAL;
        for (int32_t j = 0; j < all->n_grain; ++j) {
            const double gap = distance(all->position[i], all->position[j]) -
                               0.5 * (all->scale[i] + all->scale[j]);
            nearest = j != i ? fmin(nearest, gap) : nearest;
        }
        assert_true(nearest > -1e-12);
        assert_true(nearest < 1e-12);
    }
    clast_aggregate_result result;
    CHECK_OK(clast_aggregate_measure(a, &result));
    assert_true(result.max_overlap < 1e-12);
    clast_aggregate_destroy(a);
    support_aggregate_free(&s);
}

/* A coat of equal spheres on a core: its grain is their diameter, its porosity that of the shell,
 * and the velocity lies between the solid body's and that of no drag; and why there is none. */
static void coat_has_a_permeability(void **state)
{
    (void)state;
    static const struct {
        const char *options;
        clast_permeable_range range;
    } runs[] = {
        {"core_size=4e-5;n_particle=200;size_low=1e-5;size_high=1e-5", CLAST_PERMEABLE_YES},
        {"core_size=4e-5;n_particle=200;size_low=1e-5;size_high=1e-5;mode=cluster",
         CLAST_PERMEABLE_YES},
        {"core_size=4e-5;n_particle=200;size_low=1e-5;size_high=1e-5;permeability=kozeny_carman",
         CLAST_PERMEABLE_POROSITY},
        {"core_size=1e-3;n_particle=20;size_low=1e-4;size_high=1e-4", CLAST_PERMEABLE_THIN},
        {"core_size=1e-2;n_particle=200;size_low=3e-3;size_high=3e-3", CLAST_PERMEABLE_REYNOLDS}};
    for (size_t i = 0; i < sizeof runs / sizeof runs[0]; ++i) {
        support_aggregate s;
        clast_aggregate_result r;
        support_aggregate_make(&s, NULL, 1, "size_law=uniform;envelope_every=1000");
        support_aggregate_options(&s.config, runs[i].options);
        clast_aggregate *a = support_aggregate_run(&s, 0);
        CHECK_OK(clast_aggregate_measure(a, &r));
        assert_string_equal(clast_permeable_range_text(r.permeable),
                            clast_permeable_range_text(runs[i].range));
        assert_true(isnan(r.settling_velocity_permeable) == (r.permeable != CLAST_PERMEABLE_YES));
        CHECK_REL(r.coat_grain, s.config.params.size_low, 1e-12);
        if (i == 0) {
            const double core = CLAST_PI / 6.0 * 64e-15;
            const double shell = r.envelope[0].volume - core;
            CHECK_REL(r.coat_porosity, 1.0 - 200.0 * CLAST_PI / 6.0 * 1e-15 / shell, 1e-9);
            CHECK_REL(r.drag_permeable,
                      clast_drag_permeable(0.5 * r.d_agg / sqrt(r.permeability), 4e-5 / r.d_agg),
                      1e-9);
        }
        if (r.permeable == CLAST_PERMEABLE_YES) {
            assert_true(r.settling_velocity_permeable > r.settling_velocity);
            assert_true(r.settling_velocity_permeable <
                        1.01 * r.settling_velocity / r.drag_permeable);
        }
        clast_aggregate_destroy(a);
        support_aggregate_free(&s);
    }
}

/* A solver that grows aggregates of its own shapes needs no files and no run: parameters alone. */
static void parameters_alone_are_enough(void **state)
{
    (void)state;
    support_aggregate s;
    clast_aggregate_params params;
    clast_aggregate *a[2] = {NULL, NULL};
    support_aggregate_make(&s, NULL, 1,
                           "n_particle=5;size_law=uniform;size_low=1;size_high=2;cone=0.5;rays=4");
    CHECK_OK(clast_aggregate_params_default(&params));
    params.core_size = 1.0;
    params.n_particle = 5;
    params.size_law = CLAST_SIZE_UNIFORM;
    params.size_low = 1.0;
    params.size_high = 2.0;
    params.cone = 0.5;
    params.rays = 4;
    CHECK_OK(clast_aggregate_create(&params, &s.input, 0, &a[0]));
    CHECK_OK(clast_aggregate_create(&s.config.params, &s.input, 0, &a[1]));
    for (int k = 0; k < 2; ++k) {
        CHECK_OK(clast_aggregate_grow(a[k], 10, NULL));
    }
    const clast_assembly *one = clast_aggregate_assembly(a[0]);
    const clast_assembly *other = clast_aggregate_assembly(a[1]);
    assert_int_equal(one->n_grain, 6);
    assert_int_equal(other->n_grain, 6);
    assert_memory_equal(one->position, other->position, 6 * sizeof *one->position);
    clast_aggregate_destroy(a[0]);
    clast_aggregate_destroy(a[1]);
    s.input.coat = NULL;
    CHECK_STATUS(clast_aggregate_create(&params, &s.input, 0, &a[0]), CLAST_E_ARGUMENT);
    assert_non_null(strstr(clast_error_detail(), "input->coat is NULL"));
    s.input.coat = s.coat;
    params.size_law = CLAST_SIZE_LIST; /* and no sizes with it */
    CHECK_STATUS(clast_aggregate_create(&params, &s.input, 0, &a[0]), CLAST_E_CONFIG);
    clast_aggregate_params_free(&params);
    clast_aggregate_params_free(&params);
    support_aggregate_free(&s);
}

/// Creates, grows, restores and measures; frees all.
static clast_status whole_life(void *context)
{
    support_aggregate *s = context;
    clast_aggregate *a = NULL;
    clast_aggregate *b = NULL;
    clast_table history = {0};
    clast_table members = {0};
    clast_aggregate_result result;
    clast_aggregate_saved saved = {.history = &history, .members = &members};
    clast_status status = clast_aggregate_create(&s->config.params, &s->input, 0, &a);
    status = status == CLAST_OK ? clast_aggregate_grow(a, 2, NULL) : status;
    status = status == CLAST_OK ? clast_aggregate_history(a, &history) : status;
    status = status == CLAST_OK ? clast_aggregate_members(a, &members) : status;
    if (status == CLAST_OK) {
        saved.placed = clast_aggregate_assembly(a);
        status = clast_aggregate_restore(&s->config.params, &s->input, &saved, &b);
    }
    status = status == CLAST_OK ? clast_aggregate_measure(b, &result) : status;
    if (status == CLAST_OK) {
        assert_int_equal(clast_aggregate_n_particle(b), s->config.params.n_particle);
    }
    clast_table_free(&history);
    clast_table_free(&members);
    clast_aggregate_destroy(a);
    clast_aggregate_destroy(b);
    return status;
}

static void refused_memory_leaves_nothing(void **state)
{
    (void)state;
    static const char *const runs[] = {
        "n_particle=3;size_law=uniform;size_low=1;size_high=2;envelope=enclosing_sphere",
        "n_particle=3;size_law=uniform;size_low=1;size_high=2;contact=march;"
        "envelope=enclosing_sphere;march_vertices=10",
        "n_particle=4;size_law=uniform;size_low=1;size_high=2;mode=cluster;"
        "envelope=enclosing_sphere"};
    for (int r = 0; r < 3; ++r) {
        support_aggregate s;
        support_aggregate_make(&s, NULL, 1, runs[r]);
        support_refuse_each_allocation(whole_life, &s);
        support_aggregate_free(&s);
    }
}

#ifdef CLAST_ALLOC_INJECT
/// Grows to the end, the k-th allocation refused, and tries again where a call has failed; whether
/// none was refused. A handle that cannot go on says so by every call.
static bool grow_with_one_refused(support_aggregate *s, int64_t k, clast_aggregate_result *result)
{
    clast_aggregate *a = NULL;
    clast_table table = {0};
    CHECK_OK(clast_aggregate_create(&s->config.params, &s->input, 0, &a));
    (void)clx_alloc_refuse(k);
    const clast_status first = clast_aggregate_grow(a, 100, NULL);
    (void)clx_alloc_refuse(0);
    assert_true(first == CLAST_OK || first == CLAST_E_MEMORY);
    const clast_status again = clast_aggregate_grow(a, 100, NULL);
    result->n_grain = 0;
    if (again == CLAST_OK) {
        assert_true(clast_aggregate_is_done(a));
        CHECK_OK(clast_aggregate_measure(a, result));
    } else {
        assert_int_equal(first, CLAST_E_MEMORY);
        assert_int_equal(again, CLAST_E_USAGE);
        CHECK_STATUS(clast_aggregate_measure(a, result), CLAST_E_USAGE);
        CHECK_STATUS(clast_aggregate_history(a, &table), CLAST_E_USAGE);
        CHECK_STATUS(clast_aggregate_members(a, &table), CLAST_E_USAGE);
        assert_null(clast_aggregate_assembly(a));
    }
    clast_aggregate_destroy(a);
    return first == CLAST_OK;
}
#endif

/* A call that lacks memory leaves the aggregate whole, or one that no later call goes on with. */
static void refused_memory_leaves_no_torn_aggregate(void **state)
{
    (void)state;
#ifdef CLAST_ALLOC_INJECT
    static const char *const runs[] = {
        "", "contact=march;march_vertices=10;envelope=enclosing_sphere", "mode=cluster"};
    for (int r = 0; r < 3; ++r) {
        support_aggregate s;
        clast_aggregate_result reference = {0};
        clast_aggregate_result result = {0};
        int n_whole = 0;
        int n_torn = 0;
        bool is_whole = false;
        support_aggregate_make(&s, NULL, 1, "n_particle=5;size_law=uniform;size_low=1;size_high=2");
        support_aggregate_options(&s.config, runs[r]);
        assert_true(grow_with_one_refused(&s, 0, &reference));
        for (int64_t k = 1; !is_whole; k += 1 + k / 16) {
            is_whole = grow_with_one_refused(&s, k, &result);
            n_whole += result.n_grain > 0;
            n_torn += result.n_grain == 0;
            if (result.n_grain > 0) {
                assert_int_equal(result.n_grain, reference.n_grain);
                assert_int_equal(result.n_contact, reference.n_contact);
                assert_true(result.mass == reference.mass);
                assert_true(result.porosity[0] == reference.porosity[0]);
                assert_true(result.max_overlap == reference.max_overlap ||
                            isnan(reference.max_overlap));
            }
        }
        assert_true(n_whole > 1 && n_torn > 0);
        support_aggregate_free(&s);
    }
#endif
}

static void grow_and_measure(const double (*axes)[3], const char *options,
                             clast_aggregate_result *result)
{
    support_aggregate s;
    support_aggregate_make(&s, axes, 1, options);
    clast_aggregate *a = support_aggregate_run(&s, 0);
    CHECK_OK(clast_aggregate_measure(a, result));
    clast_aggregate_destroy(a);
    support_aggregate_free(&s);
}

/* What is left apart, and which solid overlaps, is part of the result and said in one line. */
static void results_say_what_they_are_of(void **state)
{
    (void)state;
    static const double axes[1][3] = {{3.0, 2.0, 1.0}};
    clast_aggregate_result r[2];
    clast_aggregate_report report = {.n = 1, .result = r};
    char text[400];
    grow_and_measure(NULL,
                     "n_particle=12;size_law=uniform;size_low=1;size_high=1;mode=cluster;n_final=5",
                     &r[0]);
    assert_int_equal(r[0].n_cluster, 5);
    assert_int_equal(r[0].n_grain_all, 12);
    assert_true(r[0].n_grain >= 3 && r[0].n_grain <= 8);
    char expected[80];
    (void)snprintf(expected, sizeof expected, "largest of 5 clusters, %d of 12 grains (",
                   r[0].n_grain);
    assert_ptr_equal(clast_aggregate_report_scope(&report, sizeof text, text), text);
    assert_ptr_equal(strstr(text, expected), text);
    r[1] = r[0];
    r[1].n_cluster = 7;
    report.n = 2;
    (void)clast_aggregate_report_scope(&report, sizeof text, text);
    assert_ptr_equal(text, strstr(text, "largest of 5 to 7 clusters of each repeat ("));
    (void)clast_aggregate_report_scope(&report, 11, text);
    assert_string_equal(text, "largest of");
    report.n = 1;
    grow_and_measure(axes, "n_particle=6;size_law=uniform;size_low=2;size_high=2", &r[0]);
    assert_int_equal(r[0].n_grain_all, 7);
    assert_int_equal(r[0].contact, CLAST_CONTACT_EXACT);
    assert_string_equal(clast_aggregate_report_scope(&report, sizeof text, text), "");
    grow_and_measure(axes, "n_particle=6;size_law=uniform;size_low=2;size_high=2;contact=spheres",
                     &r[0]);
    assert_true(r[0].max_overlap < 1e-12 && r[0].solid_union < 0.999 * r[0].solid_sum);
    (void)clast_aggregate_report_scope(&report, sizeof text, text);
    assert_non_null(strstr(text, "porosity by the sum of the grains' volumes, which overlap by "));
    assert_non_null(strstr(text, "; max_overlap that of the sphere composites"));
    grow_and_measure(axes,
                     "n_particle=6;size_law=uniform;size_low=2;size_high=2;contact=march;"
                     "solid_union=false",
                     &r[0]);
    assert_true(isnan(r[0].max_overlap) && isnan(r[0].max_overlap_relative));
    (void)clast_aggregate_report_scope(&report, sizeof text, text);
    assert_non_null(strstr(text, "which may overlap; max_overlap is not looked for in the march"));
}

/* Clusters side by side went in as one rigid core. */
static void a_core_is_one_piece(void **state)
{
    (void)state;
    static const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    support_aggregate s;
    clast_aggregate *a = NULL;
    support_aggregate_make(&s, NULL, 1, "n_particle=2;size_law=uniform;size_low=1;size_high=1");
    for (int k = 1; k < 4; ++k) {
        const double at[3] = {k < 3 ? k : 9.0, 0.0, 0.0};
        CHECK_OK(clast_assembly_add_grain(&s.core, 0, at, unturned, 1.0, 2500.0));
    }
    CHECK_OK(clast_aggregate_create(&s.config.params, &s.input, 0, &a)); /* contacts not known */
    clast_aggregate_destroy(a);
    a = NULL;
    for (int k = 0; k < 2; ++k) {
        CHECK_OK(clast_assembly_add_contact(&s.core, k, k + 1, (double[3]){k + 0.5, 0.0, 0.0}));
    }
    CHECK_STATUS(clast_aggregate_create(&s.config.params, &s.input, 0, &a), CLAST_E_GEOMETRY);
    assert_non_null(
        strstr(clast_error_detail(), "core: its 4 grains are 2 pieces that do not touch"));
    CHECK_OK(clast_assembly_add_contact(&s.core, 3, 0, (double[3]){4.5, 0.0, 0.0}));
    CHECK_OK(clast_aggregate_create(&s.config.params, &s.input, 0, &a));
    clast_aggregate_destroy(a);
    support_aggregate_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_spheres_touch_with_the_known_porosity),
        cmocka_unit_test(spheres_never_overlap),
        cmocka_unit_test(coat_has_a_permeability),
        cmocka_unit_test(parameters_alone_are_enough),
        cmocka_unit_test(refused_memory_leaves_nothing),
        cmocka_unit_test(refused_memory_leaves_no_torn_aggregate),
        cmocka_unit_test(results_say_what_they_are_of),
        cmocka_unit_test(a_core_is_one_piece),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
