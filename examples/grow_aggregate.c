// Grows an aggregate: 40 particles of 30 um on a core of 270 um, each where its centre of mass ends
// closest to the aggregate's; six repeats, and the mean with its interval.
//
//     cc grow_aggregate.c $(pkg-config --cflags --libs clast) -lm && ./a.out
#include <clast/aggregate_run.h>
#include <clast/field.h>
#include <clast/statistics.h>
#include <stdio.h>

/// A key of `clast aggregate --help-all` and its text, with a unit.
static const char *const settings[][2] = {
    {"core", "sphere"}, {"core_size", "270um"}, {"coat", "sphere"},
    {"size", "30um"},   {"replicate", "40"},    {"cone", "30deg"},
    {"rays", "20"},     {"repeats", "6"},       {"seed", "7"},
};

static clast_status configure(clast_aggregate_config *config)
{
    clast_status status = clast_fields_default(clast_aggregate_fields, config);
    for (size_t k = 0; k < sizeof settings / sizeof *settings && status == CLAST_OK; ++k) {
        const clast_field *field = clast_fields_find(clast_aggregate_fields, settings[k][0]);
        status = clast_field_set(field, config, settings[k][1], false);
    }
    return status;
}

int main(void)
{
    clast_aggregate_config config;
    clast_aggregate_report report = {0};
    double porosity[6];
    clast_status status = configure(&config);
    if (status == CLAST_OK) { // a folder in place of the first NULL keeps states, tables, pictures
        status = clast_aggregate_run(&config, NULL, NULL, NULL, &report);
    }
    if (status != CLAST_OK) {
        (void)fprintf(stderr, "%s\n", clast_error_detail());
        return 1;
    }
    for (int32_t i = 0; i < report.n; ++i) {
        porosity[i] = report.result[i].porosity[0];
    }
    const clast_interval mean = clast_interval_of(report.n, porosity, report.confidence);
    (void)printf("particles         %d on a core\n", report.result[0].n_particle);
    (void)printf("porosity          %.4f, %.0f %% interval of the mean %.4f to %.4f\n", mean.mean,
                 100.0 * report.confidence, mean.low, mean.high);
    (void)printf("density           %.1f kg/m^3\n", report.result[0].density);
    (void)printf("falls in air at   %.4f m/s\n", report.result[0].settling_velocity);
    clast_aggregate_report_free(&report);
    clast_fields_free(clast_aggregate_fields, &config);
    return 0;
}
