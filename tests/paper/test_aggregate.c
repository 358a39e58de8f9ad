/* Paper [Rossi and Bonadonna, SCARLET-1.0]: the published engines' numbers, and exact references.
 * Few repeats here, so limits are those of the sampling error; tools/paper_aggregate.py does the
 * long runs. */
#include "aggregates.h"

#include <clast/aggregate_run.h>
#include <stdio.h>
#include <string.h>

/// Sets options "key=value;..." on a fresh configuration, runs all repeats, returns the porosity.
static clast_interval porosity_of(const char *options, clast_interval *diameter)
{
    clast_aggregate_config config;
    clast_aggregate_report report = {0};
    double porosity[64];
    double size[64];
    CHECK_OK(clast_fields_default(clast_aggregate_fields, &config));
    support_aggregate_options(&config, options);
    CHECK_OK(clast_aggregate_run(&config, NULL, NULL, NULL, &report));
    for (int32_t i = 0; i < report.n; ++i) {
        porosity[i] = report.result[i].porosity[0];
        size[i] = report.result[i].d_agg;
    }
    const clast_interval found = clast_interval_of(report.n, porosity, 0.999);
    *diameter = clast_interval_of(report.n, size, 0.999);
    clast_aggregate_report_free(&report);
    clast_fields_free(clast_aggregate_fields, &config);
    return found;
}

#define ASH                                                                                        \
    "core=data/scarlet/stl/27sk21_shape_coarse.stl;coat=data/scarlet/stl/27sk21_shape_fine.stl;"   \
    "core_spheres=data/scarlet/27sk21_shape_coarse_spheres.csv;"                                   \
    "coat_spheres=data/scarlet/27sk21_shape_fine_spheres.csv;size_unit=um;"                        \
    "size_meaning=mean_diameter;order=shuffled;contact=march;envelope=sphere_rays;"                \
    "envelope_every=100000;envelope_rays=10000;solid_union=false;"
#define EJ15 ASH "core_size=40 um;sizes=data/scarlet/ej15_deq_um.csv;"

/// The interval of the mean at level 0.999, widened by the original's own spread, holds the target.
static void check_mean(clast_interval found, double target, double spread)
{
    if (!(target >= found.low - spread && target <= found.high + spread)) {
        fail_msg("mean %g in %g .. %g, published %g", found.mean, found.low, found.high, target);
    }
}

static void figure_engine_is_met(void **state)
{
    (void)state;
    clast_interval size;
    check_mean(porosity_of(EJ15 "flavour=figures;repeats=8", &size), 0.767, 0.004);
    check_mean(size, 167.9e-6, 1e-6);
}

/// The release places sizes as listed.
static void released_engine_is_met(void **state)
{
    (void)state;
    clast_interval size;
    check_mean(porosity_of(EJ15 "order=given;flavour=release;repeats=8", &size), 0.803, 0.003);
}

/// Exact reference of two ellipsoids (integrated here, not published; no spheres): mean +-
/// deviation over 300 repeats.
static void two_ellipsoids_touch_as_the_exact_reference(void **state)
{
    (void)state;
    static const struct {
        const char *options;
        double porosity, deviation;
    } rows[] = {
        {"core=ellipsoid:10,5,2.5;coat=ellipsoid:10,5,2.5;core_size=1;size=1;", 0.389, 0.065},
        {"core=ellipsoid:10,2.5,2.5;coat=ellipsoid:10,2.5,2.5;core_size=2;size=1;", 0.323, 0.072},
        {"core=ellipsoid:10,10,2.5;coat=ellipsoid:10,10,2.5;core_size=5;size=1;", 0.123, 0.050},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        char options[256];
        clast_interval size;
        (void)snprintf(options, sizeof options, "%srepeats=16;seed=5", rows[i].options);
        const clast_interval found = porosity_of(options, &size);
        check_mean(found, rows[i].porosity, 3.5 * rows[i].deviation / sqrt(200.0));
        CHECK_REL(found.deviation, rows[i].deviation, 0.6);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(figure_engine_is_met),
        cmocka_unit_test(released_engine_is_met),
        cmocka_unit_test(two_ellipsoids_touch_as_the_exact_reference),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
