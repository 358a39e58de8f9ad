// Pours a small bed of ellipsoids into a cylinder, shakes and damps it, and prints its porosity;
// the loop is the caller's, so a program may look at the bed between steps.
//
//     cc pack_bed.c $(pkg-config --cflags --libs clast) && ./a.out
#include <clast/field.h>
#include <clast/pack.h>
#include <stdio.h>

/// A key of `clast pack --help-all` and its text, with a unit.
static const char *const settings[][2] = {
    {"shapes", "ellipsoid:3,2,1.5"},
    {"curve", "6 mm"},
    {"mass", "30g"},
    {"width", "40mm"},
    {"height", "0.15m"},
    {"seed", "3"},
    {"shaking_time", "0.05s"},
};

static clast_status configure(clast_pack_config *config)
{
    clast_status status = clast_fields_default(clast_pack_fields, config);
    for (size_t k = 0; k < sizeof settings / sizeof *settings && status == CLAST_OK; ++k) {
        const clast_field *field = clast_fields_find(clast_pack_fields, settings[k][0]);
        status = clast_field_set(field, config, settings[k][1], false);
    }
    return status;
}

static clast_status run(const clast_pack_config *config, clast_pack_source *source,
                        clast_pack **pack, clast_pack_result *result)
{
    clast_status status = clast_pack_load(config, source); // shapes and curves, from files or laws
    status = status == CLAST_OK ? clast_pack_create(config, &source->input, pack) : status;
    while (status == CLAST_OK && !clast_pack_is_over(*pack)) {
        status = clast_pack_advance(*pack, 1000); // steps
    }
    return status == CLAST_OK ? clast_pack_measure(*pack, result) : status;
}

int main(void)
{
    clast_pack_config config;
    clast_pack_source source = {0};
    clast_pack *pack = NULL;
    clast_pack_result result = {0};
    clast_status status = configure(&config);
    status = status == CLAST_OK ? run(&config, &source, &pack, &result) : status;
    if (status == CLAST_OK) {
        (void)printf("grains        %d\n", result.dem.n_grain);
        (void)printf("bulk porosity %.4f between %.1f and %.1f mm\n", result.porosity,
                     1e3 * result.z_low, 1e3 * result.z_high);
        (void)printf("state hash    %016llx\n", (unsigned long long)result.hash);
    } else {
        (void)fprintf(stderr, "%s\n", clast_error_detail());
    }
    clast_pack_result_free(&result);
    clast_pack_destroy(pack);
    clast_pack_unload(&source);
    clast_fields_free(clast_pack_fields, &config);
    return status == CLAST_OK ? 0 : 1;
}
