/* Unit: configurations are typed by their field table and refused in one line. */
#include "support.h"

#include <clast/agglomerate.h>
#include <clast/aggregate.h>
#include <clast/config.h>
#include <clast/decompose.h>
#include <clast/fill.h>
#include <clast/mesh_repair.h>
#include <clast/pack.h>
#include <clast/porosity_fit.h>
#include <clast/render.h>
#include <clast/report.h>
#include <clast/study.h>
#include <clast/synthesize.h>
#include <stdio.h>
#include <string.h>

static clast_aggregate_config config;

static clast_status parse(const char *text)
{
    return clast_config_parse("run.yaml", text, clast_aggregate_fields, &config);
}

static void values_carry_units_and_lists_replace(void **state)
{
    (void)state;
    CHECK_OK(clast_fields_default(clast_aggregate_fields, &config));
    CHECK_OK(parse("core: a.stl\ncore-size: 270 um\ncone: 50deg\nrays: 3e1\ncoat: [b.stl, "
                   "c.stl]\nsize: [2 phi, 1mm]\n"));
    CHECK_REL(config.core_size, 270e-6, 1e-15);
    CHECK_REL(config.cone, 50.0 * CLAST_PI / 180.0, 1e-15);
    assert_int_equal(config.rays, 30);
    assert_int_equal(config.coat.n, 2);
    assert_string_equal(config.coat.item[1], "c.stl");
    CHECK_REL(config.size.item[0], 0.25e-3, 1e-15);
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
        clast_aggregate_fields,   clast_report_fields,      clast_render_fields,
        clast_decompose_fields,   clast_fill_fields,        clast_agglomerate_fields,
        clast_pack_fields,        clast_synthesize_fields,  clast_study_fields,
        clast_mesh_repair_fields, clast_porosity_fit_fields};
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
        cmocka_unit_test(survives_refused_memory),
        cmocka_unit_test(every_field_reads_its_own_unit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
