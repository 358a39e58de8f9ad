// Grows an aggregate: 40 particles of 30 um on a core of 270 um, each where its centre of mass ends
// closest to the aggregate's; six repeats, and the mean with its interval. The loop is the
// caller's; clast_aggregate_run of libclast_view does the same with a folder of states, tables and
// pictures.
//
//     cc grow_aggregate.c $(pkg-config --cflags --libs clast) -lm && ./a.out
#include <clast/aggregate_run.h>
#include <clast/field.h>
#include <clast/statistics.h>
#include <stdio.h>

/// A key of `clast aggregate --help-all` and its text, with a unit.
static const char *const settings[][2] = {
    {"core", "sphere"},  {"core_size", "270um"}, {"coat", "sphere"}, {"size", "30um"},
    {"replicate", "40"}, {"cone", "30deg"},      {"rays", "20"},     {"seed", "7"},
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

/// Grows repeat `i` to its end and measures it.
static clast_status grow(const clast_aggregate_config *config, const clast_aggregate_source *source,
                         int32_t i, clast_aggregate_result *result)
{
    clast_aggregate *aggregate = NULL;
    clast_status status = clast_aggregate_create(&config->params, &source->input, i, &aggregate);
    while (status == CLAST_OK && !clast_aggregate_is_done(aggregate)) {
        status = clast_aggregate_grow(aggregate, 10, NULL); // particles
    }
    status = status == CLAST_OK ? clast_aggregate_measure(aggregate, result) : status;
    clast_aggregate_destroy(aggregate);
    return status;
}

int main(void)
{
    clast_aggregate_config config;
    clast_aggregate_source source = {0}; // core, coat and sizes, from files or laws
    clast_aggregate_result result[6];
    double porosity[6];
    clast_status status = configure(&config);
    status = status == CLAST_OK ? clast_aggregate_load(&config, &source) : status;
    for (int32_t i = 0; i < 6 && status == CLAST_OK; ++i) {
        status = grow(&config, &source, i, &result[i]);
        porosity[i] = status == CLAST_OK ? result[i].porosity[0] : 0.0;
    }
    if (status != CLAST_OK) {
        (void)fprintf(stderr, "%s\n", clast_error_detail());
    } else {
        const clast_interval mean = clast_interval_of(6, porosity, config.confidence);
        (void)printf("particles         %d on a core\n", result[0].n_particle);
        (void)printf("porosity          %.4f, %.0f %% interval of the mean %.4f to %.4f\n",
                     mean.mean, 100.0 * config.confidence, mean.low, mean.high);
        (void)printf("density           %.1f kg/m^3\n", result[0].density);
        (void)printf("falls in air at   %.4f m/s\n", result[0].settling_velocity);
    }
    clast_aggregate_unload(&source);
    clast_fields_free(clast_aggregate_fields, &config);
    return status == CLAST_OK ? 0 : 1;
}
