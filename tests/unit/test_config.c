/* Unit: configurations are typed by their field table and refused in one line. */
#include "support.h"

#include <clast/agglomerate.h>
#include <clast/aggregate.h>
#include <clast/decompose.h>
#include <clast/field.h>
#include <clast/fill.h>
#include <clast/harmonics.h>
#include <clast/mesh_repair.h>
#include <clast/pack.h>
#include <clast/porosity_model.h>
#include <clast/render.h>
#include <clast/report.h>
#include <clast/study.h>
#include <stdio.h>
#include <string.h>

static clast_aggregate_config config;

static clast_status parse(const char *text)
{
    return clast_fields_parse("run.yaml", text, clast_aggregate_fields, &config);
}

static void values_carry_units_and_lists_replace(void **state)
{
    (void)state;
    CHECK_OK(clast_fields_default(clast_aggregate_fields, &config));
    CHECK_OK(parse("core: a.stl\ncore-size: 270 um\ncone: 50deg\nrays: 3e1\ncoat: [b.stl, "
                   "c.stl]\nsize: [2 phi, 1mm]\n"));
    CHECK_REL(config.params.core_size, 270e-6, 1e-15);
    CHECK_REL(config.params.cone, 50.0 * CLAST_PI / 180.0, 1e-15);
    assert_int_equal(config.params.rays, 30);
    assert_int_equal(config.coat.n, 2);
    assert_string_equal(config.coat.item[1], "c.stl");
    CHECK_REL(config.params.size.item[0], 0.25e-3, 1e-15);
    clast_fields_free(clast_aggregate_fields, &config);
}

static void wrong_lines_are_named(void **state)
{
    (void)state;
    const struct {
        const char *text, *says;
    } cases[] = {{"rays: 3\nrayz: 2\n", "run.yaml:2: unknown key 'rayz'; did you mean 'rays'?"},
                 {"cone: 200 deg\n", "outside"},
                 {"cone: 50 furlong\n", "unknown unit 'furlong'; known here: rad, deg"},
                 {"rays: 2.5\n", "not a whole number"},
                 {"rays: [1, 2]\n", "takes one value"},
                 {"rays: 1\nrays: 2\n", "given twice"},
                 {"contact: gentle\n", "none of exact|spheres|march"},
                 {"- a\n- b\n", "expected lines"},
                 {"core: {a: b}\n", "plain value"},
                 {"core: 'open\n", "run.yaml"},
                 {"core_size: nan\n", "not a finite number"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        CHECK_OK(clast_fields_default(clast_aggregate_fields, &config));
        CHECK_STATUS(parse(cases[i].text), CLAST_E_CONFIG);
        if (strstr(clast_error_detail(), cases[i].says) == NULL) {
            fail_msg("'%s' says '%s', expected '%s'", cases[i].text, clast_error_detail(),
                     cases[i].says);
        }
        clast_fields_free(clast_aggregate_fields, &config);
    }
}

/* A hundred thousand brackets took 42 s, as many braces over a minute. */
static void idle_fields_are_found_by_their_rule(void **state)
{
    (void)state;
    const clast_field *f = clast_aggregate_fields;
    const char *why = NULL;
    clast_idle rules[] = {
        {true, "cone|core|size|coat_density", "without growth"}, {false, "rays", "never"}, {0}};
    CHECK_OK(clast_fields_default(f, &config));
    CHECK_OK(parse("size_mean: 1mm\nrays: 2\ncoat_density: [2500]\n")); /* one is the default */
    assert_null(clast_fields_idle(f, &config, rules, &why));
    assert_false(clast_field_is_default(clast_fields_find(f, "size_mean"), &config));
    assert_true(clast_field_is_default(clast_fields_find(f, "coat_density"), &config));
    CHECK_OK(parse("coat_density: [2500, 2600]\n"));
    assert_string_equal(clast_fields_idle(f, &config, rules, &why)->name, "coat_density");
    assert_string_equal(why, "without growth");
    CHECK_OK(parse("core: a.stl\n")); /* before it in the table */
    assert_string_equal(clast_fields_idle(f, &config, rules, &why)->name, "core");
    rules[0].is_idle = false;
    assert_null(clast_fields_idle(f, &config, rules, &why));
    clast_fields_free(f, &config);
}

/* The first name that the rules refuse, and why. */
static const char *refused(const clast_field *fields, const void *values, const clast_idle *rules)
{
    static char text[200];
    const char *why = "";
    const clast_field *f = clast_fields_idle(fields, values, rules, &why);
    (void)snprintf(text, sizeof text, "%s %s", f == NULL ? "none" : f->name, why);
    return text;
}

static void each_configuration_knows_what_it_does_not_look_at(void **state)
{
    (void)state;
    clast_idle rules[CLAST_N_IDLE];
    clast_fill_config fill = {0};
    CHECK_OK(clast_fields_default(clast_fill_fields, &fill));
    assert_string_equal(refused(clast_fill_fields, &fill, clast_fill_idle(&fill, rules)), "none ");
    fill.seed = 4;
    assert_string_equal(refused(clast_fill_fields, &fill, clast_fill_idle(&fill, rules)),
                        "seed with --strategy largest");
    fill.strategy = CLAST_FILL_RANDOM;
    assert_string_equal(refused(clast_fill_fields, &fill, clast_fill_idle(&fill, rules)), "none ");
    clast_fields_free(clast_fill_fields, &fill);
    clast_decompose_config cells = {0};
    CHECK_OK(clast_fields_default(clast_decompose_fields, &cells));
    cells.strict = true;
    assert_true(clast_decompose_takes_tree(&cells));
    assert_string_equal(
        refused(clast_decompose_fields, &cells, clast_decompose_idle(&cells, false, 0, rules)),
        "strict with cells of the tree: --mesh boxes joins bins");
    cells.mesh = CLAST_CELLS_BOXES;
    cells.variable_tolerance = 2.0;
    assert_string_equal(
        refused(clast_decompose_fields, &cells, clast_decompose_idle(&cells, true, 0, rules)),
        "none ");
    assert_string_equal(
        refused(clast_decompose_fields, &cells, clast_decompose_idle(&cells, false, 0, rules)),
        "variable_tolerance without --variable-column");
    clast_fields_free(clast_decompose_fields, &cells);
    clast_agglomerate_config a = {0};
    CHECK_OK(clast_fields_default(clast_agglomerate_fields, &a));
    a.collide.medium.temperature = 400.0;
    assert_string_equal(
        refused(clast_agglomerate_fields, &a,
                clast_agglomerate_idle(&a, &(clast_agglomerate_given){.temperature = true}, rules)),
        "temperature with --temperature-column");
    clast_fields_free(clast_agglomerate_fields, &a);
}

/* A misspelt name in a rule would refuse nothing. */
static void check_names(const clast_idle *rules, const clast_field *fields)
{
    char names[400];
    for (const clast_idle *r = rules; r->names != NULL; ++r) {
        (void)snprintf(names, sizeof names, "%s", r->names);
        for (char *name = strtok(names, "|"); name != NULL; name = strtok(NULL, "|")) {
            if (clast_fields_find(fields, name) == NULL) {
                fail_msg("no field %s", name);
            }
        }
    }
}

static void rules_name_fields(void **state)
{
    (void)state;
    static char empty[] = "";
    clast_idle rules[CLAST_N_IDLE];
    const clast_porosity_fit_config fit = {.use = empty};
    check_names(clast_fill_idle(&(clast_fill_config){0}, rules), clast_fill_fields);
    check_names(clast_render_idle(&(clast_render_config){0}, rules), clast_render_fields);
    check_names(clast_mesh_repair_idle(&(clast_mesh_repair_config){0}, rules),
                clast_mesh_repair_fields);
    check_names(clast_synthesize_idle(&(clast_synthesize_config){0}, rules),
                clast_synthesize_fields);
    check_names(clast_porosity_fit_idle(&fit, true, rules), clast_porosity_fit_fields);
    check_names(clast_agglomerate_idle(&(clast_agglomerate_config){0},
                                       &(clast_agglomerate_given){0}, rules),
                clast_agglomerate_fields);
    assert_null(clast_fill_idle(NULL, rules));
    assert_null(clast_decompose_idle(NULL, true, 0, rules));
}

static void deep_nesting_is_refused_before_it_is_read(void **state)
{
    (void)state;
    enum { DEEP = 100000 };
    static const char *const opening[] = {"[", "{a: ", "- ", "? "};
    static char text[DEEP * 4 + 16];
    for (size_t i = 0; i < sizeof opening / sizeof opening[0]; ++i) {
        char *end = stpcpy(text, "coat:\n  ");
        for (int k = 0; k < DEEP; ++k) {
            end = stpcpy(end, opening[i]);
        }
        CHECK_OK(clast_fields_default(clast_aggregate_fields, &config));
        CHECK_STATUS(parse(text), CLAST_E_CONFIG);
        assert_non_null(strstr(clast_error_detail(), "run.yaml:2:"));
        assert_non_null(strstr(clast_error_detail(), "nested more than 8 deep"));
        clast_fields_free(clast_aggregate_fields, &config);
    }
}

/* core_size: 270 was 270 metres beside surfaces in micrometres, and gave an aggregate of 116 m. */
static void bare_lengths_and_angles_are_refused_with_their_spelling(void **state)
{
    (void)state;
    const struct {
        const char *key, *text, *says;
    } cases[] = {{"core_size", "270", "core_size: 270 has no unit; write 270um"},
                 {"core_size", " 5. ", "core_size: 5 has no unit; write 5mm"},
                 {"core_size", "1e-3", "write 0.001m"},
                 {"size", "20", "size: 20 has no unit; write 20mm"},
                 {"cone", "50", "cone: 50 has no unit; write 50deg"},
                 {"cone", "0.5", "write 0.5rad"}};
    const char *const fine[][2] = {{"core_size", "0"},
                                   {"core_size", "0.27mm"},
                                   {"size", "2 phi"},
                                   {"cone", "0.0"},
                                   {"core_density", "2650"},
                                   {"observed_velocity", "0.3"},
                                   {"core_density", "2.65g/cm3"}};
    CHECK_OK(clast_fields_default(clast_aggregate_fields, &config));
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        const clast_field *f = clast_fields_find(clast_aggregate_fields, cases[i].key);
        CHECK_STATUS(clast_field_set(f, &config, cases[i].text, false), CLAST_E_CONFIG);
        if (strstr(clast_error_detail(), cases[i].says) == NULL) {
            fail_msg("'%s' is not '%s'", clast_error_detail(), cases[i].says);
        }
        if (f->unit[0] == 'm') { // a manifest's number
            CHECK_OK(clast_field_set_si(f, &config, cases[i].text, false));
        }
    }
    for (size_t i = 0; i < sizeof fine / sizeof fine[0]; ++i) {
        const clast_field *f = clast_fields_find(clast_aggregate_fields, fine[i][0]);
        CHECK_OK(clast_field_set(f, &config, fine[i][1], false));
    }
    clast_fields_free(clast_aggregate_fields, &config);
}

static clast_status make(void *context)
{
    clast_status status = clast_fields_default(clast_aggregate_fields, &config);
    if (status == CLAST_OK) {
        status = parse(context);
        clast_fields_free(clast_aggregate_fields, &config);
    }
    return status;
}

static void survives_refused_memory(void **state)
{
    (void)state;
    char text[] = "core: a.stl\ncoat: [b.stl, c.stl]\nsize: [2 phi, 1mm]\n";
    support_refuse_each_allocation(make, text);
}

/* A number with the unit that --help names is that number, for every option of every command. */
static void every_field_reads_its_own_unit(void **state)
{
    (void)state;
    const clast_field *const tables[] = {
        clast_aggregate_fields,   clast_report_fields,       clast_render_fields,
        clast_decompose_fields,   clast_fill_fields,         clast_agglomerate_fields,
        clast_pack_fields,        clast_synthesize_fields,   clast_study_fields,
        clast_mesh_repair_fields, clast_porosity_fit_fields, clast_spectrum_fields,
        clast_evolve_fields};
    for (size_t k = 0; k < sizeof tables / sizeof tables[0]; ++k) {
        for (const clast_field *f = tables[k]; f->name != NULL; ++f) {
            char text[64];
            double value = 0.0;
            if (f->unit != NULL && f->unit[0] != '-' &&
                (f->type == CLAST_FIELD_F64 || f->type == CLAST_FIELD_F64_LIST)) {
                (void)snprintf(text, sizeof text, "3.5 %s", f->unit);
                if (clast_unit_parse(text, f->unit, &value) != CLAST_OK) {
                    print_message("%s\n", clast_error_detail());
                }
                CHECK_REL(value, 3.5, 1e-15);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_carry_units_and_lists_replace),
        cmocka_unit_test(wrong_lines_are_named),
        cmocka_unit_test(idle_fields_are_found_by_their_rule),
        cmocka_unit_test(each_configuration_knows_what_it_does_not_look_at),
        cmocka_unit_test(rules_name_fields),
        cmocka_unit_test(deep_nesting_is_refused_before_it_is_read),
        cmocka_unit_test(bare_lengths_and_angles_are_refused_with_their_spelling),
        cmocka_unit_test(survives_refused_memory),
        cmocka_unit_test(every_field_reads_its_own_unit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
