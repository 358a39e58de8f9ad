/* Unit: labels of keys and columns, and numbers in the units that people read. */
#include "support.h"

#include "base/field.h"
#include "base/status.h"
#include "report/quantity.h"
#include <clast/field.h>
#include <clast/report.h>
#include <math.h>
#include <string.h>

#define MICRO "\302\265"

static void names_are_found_with_their_units(void **state)
{
    (void)state;
    static const struct {
        const char *key, *place, *label, *unit;
    } cases[] = {
        {"size_m", "history", "Grain size", "m"},
        {"n", "history", "Particles placed", ""},
        {"n", NULL, "Points", ""},
        {"n", "shape", "Grains", ""},
        {"low", "columns", "Least", ""},
        {"n_test", NULL, "Points tested", ""},
        {"n_test", "evolve", "Times that cells were tested for uniformity", ""},
        {"n_particle", "box model", "Number density", "1/m^3"},
        {"n_8_sd", "box model", "Particles of 8 monomers, s.d. of the runs", "1/m^3"},
        {"gel_fraction", "box model", "Share of the mass in the gel, above the largest size", ""},
        {"words", NULL, "Conclusion", ""},
        {"n_run", NULL, "Runs", ""},
        {"density_kg/m^3", NULL, "Bulk density", "kg/m^3"},
        {"density_kg/m3", "grains", "Density", "kg/m^3"},
        {"porosity_surface_hull", "history", "Porosity, surface hull", ""},
        {"surface_hull_m3", "history", "Envelope volume, surface hull", "m^3"},
        {"surface_hull", "envelope", "surface hull", "m^3"},
        {"high_d_agg_m", "history_band", "Aggregate diameter, upper bound", "m"},
        {"mean_porosity_wrap", "history_band", "Porosity, wrap, mean", ""},
        {"envelope.surface_hull", "results", "Envelope volume, surface hull", "m^3"},
        {"interval.d_agg.low", "results", "Aggregate diameter, lower bound", "m"},
        {"interval.porosity.wrap.mean", "results", "Porosity, wrap, mean", ""},
        {"inverse_flatness", "features", "Flatness S/I, inverse", ""},
        {"low_m", "sizes", "Lower limit", "m"},
        {"stress", "cell", "Stress, with that of motion", "Pa"},
        {"mass_left_kg", "walls", "Mass that left", "kg"},
        {"piston_force_z_N", "walls", "piston, force along z", "N"},
        {"piston_torque_x_Nm", "walls", "piston, torque about x", "N m"},
        {"side_wall_angle_rad", "walls", "side_wall, angle", "rad"},
        {"outlet_1_kg", "walls", "outlet_1, mass that left", "kg"},
        {"nobody_knows_Nm", NULL, "", "N m"},
        {"nobody_knows_m", NULL, "", "m"},
        {"nobody_knows", "history", "", ""},
        {"", NULL, "", ""},
        {"_m", NULL, "", ""},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        const clx_quantity q = clx_quantity_of(cases[k].key, cases[k].place);
        assert_string_equal(q.label, cases[k].label);
        assert_string_equal(q.unit, cases[k].unit);
    }
    assert_string_equal(clast_report_unit("field_mass"), "kg");
    assert_string_equal(clast_report_unit("bulk"), "");
    assert_string_equal(clast_report_unit(NULL), "");
}

static void a_number_reads_in_the_unit_of_its_size(void **state)
{
    (void)state;
    static const struct {
        double value;
        const char *si_unit, *text, *unit;
    } cases[] = {
        {2.7e-4, "m", "270.0", MICRO "m"},
        {0.0, "m", "0", "mm"},
        {1.69e-19, "m", "< 0.001", "nm"},
        {-1.69e-19, "m", "> \342\210\2220.001", "nm"},
        {1.941e-11, "m^3", "0.01941", "mm\302\263"},
        {5.3517e-13, "m^3", "535170", MICRO "m\302\263"},
        {2.07e-5, "m^3", "20.70", "cm\302\263"},
        {1.2e-21, "kg", "0.001200", "fg"},
        {1.5e-8, "kg", "15.00", MICRO "g"},
        {2.5e6, "Pa", "2.500", "MPa"},
        {12.0, "Pa", "12.00", "Pa"},
        {2.1e-5, "J", "21.00", MICRO "J"},
        {0.017453292519943295, "rad", "1.000", "\302\260"},
        {310.0, "kg/m^3", "310.0", "kg/m\302\263"},
        {310.0, "N/m^3", "310.0", "N/m\302\263"}, /* only some units were raised */
        {310.0, "m^2/s^3", "310.0", "m\302\262/s\302\263"},
        {310.0, "m^3/kg", "310.0", "m\302\263/kg"},
        {310.0, "1/m^d", "310.0", "1/m^d"},
        {310.0, "-", "310", ""},
        {310.0, "u", "310.0", "u"},
        {2e-6, "Pa s", "2.000", MICRO "Pa s"},
        {301.0, "", "301", ""},
        {-14.76, "", "-14.76", ""},
        {7.39e-54, "", "7.390\302\240\303\227\302\24010\342\201\273\342\201\265\342\201\264", ""},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        char text[CLX_QUANTITY_SIZE];
        const clx_quantity_scale scale = clx_quantity_scale_for(cases[k].value, cases[k].si_unit);
        clx_quantity_format(cases[k].value, &scale, text);
        assert_string_equal(text, cases[k].text);
        assert_string_equal(scale.name, cases[k].unit);
    }
}

static void the_terminal_reads_the_same_units(void **state)
{
    (void)state;
    double factor = 0.0;
    assert_string_equal(clast_unit_for(3.75e-6, "m", &factor), "um");
    assert_true(factor == 1e6);
    assert_string_equal(clast_unit_for(-0.00808101, "kg", &factor), "g");
    assert_string_equal(clast_unit_for(0.99951, "m", &factor), "m");
    assert_string_equal(clast_unit_for(0.0, "kg", &factor), "g");
    assert_string_equal(clast_unit_for(0.0, "Pa", &factor), "Pa");
    assert_string_equal(clast_unit_for(2e-11, "m^3", &factor), "mm^3");
    assert_string_equal(clast_unit_for(5.0, "furlong", &factor), "furlong");
    assert_true(factor == 1.0);
}

/* Refusals printed SI: "the cell holds 0.000710419 kg of 0.001 kg". */
static void a_refusal_reads_the_same_units(void **state)
{
    (void)state;
    static const struct {
        double value;
        const char *si_unit, *text;
    } cases[] = {
        {7.10419e-4, "kg", "710.419 mg"},
        {1e-3, "kg", "1 g"},
        {2e-5, "m", "20 um"},
        {-0.25, "m", "-250 mm"},
        {1e6, "m", "1e+06 m"},
        {1e-10, "m", "0.1 nm"},
        {0.0, "m", "0 mm"},
        {0.0, "Pa", "0 Pa"},
        {0.0, "s", "0 s"},
        {NAN, "m", "nan m"},
        {HUGE_VAL, "Pa", "inf Pa"},
        {-HUGE_VAL, "kg", "-inf kg"},
        {6.3192e-6, "s", "6.3192 us"},
        {3600.0, "s", "3600 s"},
        {2e-5, "m^2", "20 mm^2"},
        {2650.0, "kg/m^3", "2650 kg/m^3"},
        {0.3, "-", "0.3"},
        {0.3, NULL, "0.3"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        assert_string_equal(clx_unit_text(cases[k].value, cases[k].si_unit), cases[k].text);
    }
    const char *text[8];
    for (int k = 0; k < 8; ++k) { // as many in one message
        text[k] = clx_unit_text(k + 1.0, "m");
    }
    assert_string_equal(text[0], "1 m");
    assert_string_equal(text[7], "8 m");
}

/* clast printed 12 ug, and --stop-mass 1ug was an unknown unit. */
static void what_is_printed_can_be_read(void **state)
{
    (void)state;
    static const char *const si[] = {"m",     "m^2",   "m^3",   "kg",     "s",     "m/s",
                                     "J",     "N",     "Pa s",  "Pa",     "rad",   "1/m",
                                     "m/s^2", "J/m^2", "J/m^3", "kg/m^3", "1/m^3", "K"};
    for (size_t k = 0; k < sizeof si / sizeof *si; ++k) {
        for (int power = -30; power <= 12; ++power) {
            double factor = 0.0;
            double read = 0.0;
            const char *name = clast_unit_for(pow(10.0, power), si[k], &factor);
            CHECK_OK(clast_unit_factor(name, si[k], &read));
            CHECK_REL(read * factor, 1.0, 1e-15);
            const clx_quantity_scale page = clx_quantity_scale_for(pow(10.0, power), si[k]);
            CHECK_OK(clast_unit_factor(page.name, si[k], &read));
            CHECK_REL(read * page.factor, 1.0, 1e-15);
        }
    }
    double value = 0.0;
    CHECK_OK(clast_unit_parse("1 \316\274g", "kg", &value));
    CHECK_REL(value, 1e-9, 1e-15);
    static const char *const twice[][3] = {
        {"um^2", "um2", "m^2"},          {"mm^3", "mm3", "m^3"},     {"1/mm^3", "1/mm3", "1/m^3"},
        {"m^2/s^3", "m2/s3", "m^2/s^3"}, {"m/s^2", "m/s2", "m/s^2"}, {"mJ/m^2", "mJ/m2", "J/m^2"},
        {"1/min", "/min", "1/s"},        {"1/h", "/h", "1/s"},       {"1/cm^3", "/cm3", "1/m^3"}};
    for (size_t k = 0; k < sizeof twice / sizeof *twice; ++k) {
        double factor[2] = {0.0, 0.0};
        CHECK_OK(clast_unit_factor(twice[k][0], twice[k][2], &factor[0]));
        CHECK_OK(clast_unit_factor(twice[k][1], twice[k][2], &factor[1]));
        CHECK_REL(factor[1], factor[0], 0.0);
    }
    CHECK_OK(clast_unit_parse("60/min", "1/s", &value)); /* of rates only /s was read so */
    CHECK_REL(value, 1.0, 1e-15);
    static const struct { /* runs with a default written out have its bytes; points lie in a domain
                           */
        const char *text, *si;
        double value;
    } same[] = {{"5us", "s", 5e-6},
                {"200us", "s", 2e-4},
                {"7ms", "s", 7e-3},
                {"400um", "m", 400.0 * 1e-6},
                {"104mm", "m", 104.0 * 1e-3}};
    for (size_t k = 0; k < sizeof same / sizeof *same; ++k) {
        CHECK_OK(clast_unit_parse(same[k].text, same[k].si, &value));
        CHECK_REL(value, same[k].value, 0.0);
    }
    const char *of = NULL; /* a number's dimension is its unit's */
    assert_true(clx_unit_is_number("3 phi", &value, &of));
    assert_string_equal(of, "m");
    CHECK_REL(value, 1.25e-4, 1e-15);
    assert_true(clx_unit_is_number("60/min", &value, &of));
    assert_string_equal(of, "1/s");
    assert_true(clx_unit_is_number("0.5", &value, &of));
    assert_string_equal(of, "-");
    assert_false(clx_unit_is_number("5 oz", &value, NULL) ||
                 clx_unit_is_number("mm", &value, NULL));
    CHECK_STATUS(clast_unit_parse("1 oz", "kg", &value), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "known here: kg, g, mg, ug, ng, pg, fg, t"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_found_with_their_units),
        cmocka_unit_test(a_number_reads_in_the_unit_of_its_size),
        cmocka_unit_test(the_terminal_reads_the_same_units),
        cmocka_unit_test(a_refusal_reads_the_same_units),
        cmocka_unit_test(what_is_printed_can_be_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
