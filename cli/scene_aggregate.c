// Scenes that grow aggregates.
#include "scene.h"

#include <clast/aggregate_run.h>
#include <clast/mesh.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

clast_status cli_scene_sk21(cli_lap *b);
clast_status cli_scene_sk21_ellipsoids(cli_lap *b);
clast_status cli_scene_ej15_tight(cli_lap *b);
clast_status cli_scene_ej15_tight_ellipsoids(cli_lap *b);
clast_status cli_scene_spheres(cli_lap *b);
clast_status cli_scene_scans(cli_lap *b);
clast_status cli_scene_grow3(cli_lap *b);
clast_status cli_scene_grow4(cli_lap *b);
clast_status cli_scene_grow5(cli_lap *b);
clast_status cli_scene_tight3(cli_lap *b);
clast_status cli_scene_tight4(cli_lap *b);
clast_status cli_scene_tight5(cli_lap *b);

/// Sets "key=value;key=value;..." of a configuration; '@' stands for the data folder. A key that
/// comes again adds to its list.
static clast_status set_options(clast_aggregate_config *config, const char *data,
                                const char *options)
{
    const char *before = "";
    char item[512];
    for (const char *at = options; *at != '\0';) {
        const int n = (int)strcspn(at, ";");
        const char *key = at;
        const int n_key = (int)strcspn(at, "=");
        const char *value = at + n_key + 1;
        const bool in_data = *value == '@';
        (void)snprintf(item, sizeof item, "%.*s", n_key, key);
        const clast_field *field = clast_fields_find(clast_aggregate_fields, item);
        if (field == NULL) {
            return cli_fail(CLAST_E_USAGE, "scene's option %s does not exist", item);
        }
        (void)snprintf(item, sizeof item, "%s%.*s", in_data ? data : "",
                       n - n_key - 1 - (in_data ? 1 : 0), value + (in_data ? 1 : 0));
        CLI_GUARD(clast_field_set(field, config, item, strcmp(before, field->name) == 0));
        before = field->name;
        at += n + (at[n] == ';' ? 1 : 0);
    }
    return CLAST_OK;
}

/// Grows one aggregate to its end, porosity after each particle, and measures it.
static clast_status grow(const clast_aggregate_config *config, const clast_aggregate_input *input)
{
    clast_aggregate *a = NULL;
    clast_aggregate_result result;
    clast_status status = CLAST_OK;
    CLI_TRY(clast_aggregate_create(&config->params, input, 0, &a));
    CLI_TRY(clast_aggregate_grow(a, INT32_MAX, NULL));
    CLI_TRY(clast_aggregate_measure(a, &result));
done:
    clast_aggregate_destroy(a);
    return status;
}

static clast_status grow_options(cli_lap *b, const char *options)
{
    clast_aggregate_config config;
    clast_aggregate_source source = {0};
    clast_status status = CLAST_OK;
    CLI_TRY(clast_fields_default(clast_aggregate_fields, &config));
    CLI_TRY(set_options(&config, b->data, options));
    CLI_TRY(clast_aggregate_load(&config, &source));
    while (cli_lap_again(b)) {
        cli_lap_start(b);
        CLI_TRY(grow(&config, &source.input));
        cli_lap_stop(b);
    }
done:
    b->value = b->wall;
    clast_aggregate_unload(&source);
    clast_fields_free(clast_aggregate_fields, &config);
    return status;
}

#define ASH_SURFACES                                                                               \
    "core=@/stl/27sk21_shape_coarse.stl;coat=@/stl/27sk21_shape_fine.stl;"                         \
    "coat=@/stl/27sk21_shape_coarse.stl;unit=um;"
// Full axes of the published ellipsoids of coarse and fine ash.
#define ASH_ELLIPSOIDS                                                                             \
    "core=ellipsoid:157e-6,138e-6,116e-6;coat=ellipsoid:28.8e-6,24e-6,11e-6;"                      \
    "coat=ellipsoid:157e-6,138e-6,116e-6;"
#define ASH  "class_limit=63 um;size_unit=um;size_meaning=mean_diameter;order=shuffled;"
#define SK21 ASH "core_size=270 um;sizes=@/27sk21_deq_um.csv"
#define EJ15T                                                                                      \
    ASH "core_size=40 um;sizes=@/ej15_deq_um.csv;n_particle=100;cone=50 "                          \
        "deg;rays=30;orientations=10"

clast_status cli_scene_sk21(cli_lap *b)
{
    return grow_options(b, ASH_SURFACES SK21);
}

clast_status cli_scene_sk21_ellipsoids(cli_lap *b)
{
    return grow_options(b, ASH_ELLIPSOIDS SK21);
}

clast_status cli_scene_ej15_tight(cli_lap *b)
{
    return grow_options(b, ASH_SURFACES EJ15T);
}

clast_status cli_scene_ej15_tight_ellipsoids(cli_lap *b)
{
    return grow_options(b, ASH_ELLIPSOIDS EJ15T);
}

#define EQUAL_SPHERES "core=sphere;core_size=1 mm;coat=sphere;size=1 mm;"

clast_status cli_scene_spheres(cli_lap *b)
{
    return grow_options(b, EQUAL_SPHERES "n_particle=1000;replicate=1000;cone=90 deg;rays=100");
}

/// Seconds of processor time a particle of the second half of n takes, porosity after each.
static clast_status grow_half(const clast_aggregate_config *config,
                              const clast_aggregate_input *input, int32_t n, double *each)
{
    clast_aggregate *a = NULL;
    const int32_t half = n / 2;
    clast_status status = CLAST_OK;
    CLI_TRY(clast_aggregate_create(&config->params, input, 0, &a));
    CLI_TRY(clast_aggregate_grow(a, n - half, NULL));
    const double begun = cli_clock_cpu();
    CLI_TRY(clast_aggregate_grow(a, half, NULL));
    *each = (cli_clock_cpu() - begun) / half;
done:
    clast_aggregate_destroy(a);
    return status;
}

/// The least of the repeats, in microseconds, for equal spheres.
static clast_status cost_at(cli_lap *b, const char *search, int32_t n, double *each)
{
    char options[256];
    clast_aggregate_config config;
    clast_aggregate_source source = {0};
    double least = HUGE_VAL;
    clast_status status = CLAST_OK;
    CLI_TRY(clast_fields_default(clast_aggregate_fields, &config));
    (void)snprintf(options, sizeof options, EQUAL_SPHERES "%s;n_particle=%d;replicate=%d", search,
                   n, n);
    CLI_TRY(set_options(&config, b->data, options));
    CLI_TRY(clast_aggregate_load(&config, &source));
    for (int32_t i = 0; i < b->repeats; ++i) {
        double seconds = 0.0;
        cli_lap_start(b);
        CLI_TRY(grow_half(&config, &source.input, n, &seconds));
        cli_lap_stop(b);
        least = fmin(least, seconds);
    }
done:
    *each = 1e6 * least;
    clast_aggregate_unload(&source);
    clast_fields_free(clast_aggregate_fields, &config);
    return status;
}

/// What a particle costs among n, beside what it costs among 100 times log n / log 100.
static clast_status compare_growth(cli_lap *b, const char *search, int32_t n)
{
    double small = 0.0;
    CLI_GUARD(cost_at(b, search, 100, &small));
    b->wall = b->cpu = HUGE_VAL;
    b->reference = small * log(n) / log(100.0);
    CLI_GUARD(cost_at(b, search, n, &b->value));
    return CLAST_OK;
}

#define LOOSE "cone=1 deg;rays=1"
#define TIGHT "cone=90 deg;rays=100"

clast_status cli_scene_grow3(cli_lap *b)
{
    return compare_growth(b, LOOSE, 1000);
}

clast_status cli_scene_grow4(cli_lap *b)
{
    return compare_growth(b, LOOSE, 10000);
}

clast_status cli_scene_grow5(cli_lap *b)
{
    return compare_growth(b, LOOSE, 100000);
}

clast_status cli_scene_tight3(cli_lap *b)
{
    return compare_growth(b, TIGHT, 1000);
}

clast_status cli_scene_tight4(cli_lap *b)
{
    return compare_growth(b, TIGHT, 10000);
}

clast_status cli_scene_tight5(cli_lap *b)
{
    return compare_growth(b, TIGHT, 100000);
}

enum { N_SCAN = 10 };

/// Another grain out of a scan: stretched, sheared and bent by smooth waves of its own number.
static void deform(clast_mesh *mesh, int32_t number)
{
    double low[3];
    double high[3];
    clast_mesh_bounds(mesh, low, high);
    const double size = fmax(high[0] - low[0], fmax(high[1] - low[1], high[2] - low[2]));
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        double *p = mesh->vert[i];
        double x[3];
        for (int k = 0; k < 3; ++k) {
            x[k] = (p[k] - 0.5 * (low[k] + high[k])) / size;
        }
        for (int k = 0; k < 3; ++k) {
            const double phase = 1.7 * number + 2.1 * k;
            const double wave =
                sin(5.0 * x[(k + 1) % 3] + phase) + cos(4.0 * x[(k + 2) % 3] - phase);
            p[k] = (1.0 + 0.3 * sin(phase)) * x[k] + 0.04 * wave;
        }
    }
}

static clast_status add_scan(const char *path, int32_t number, clast_assembly *assembly)
{
    static const double origin[3] = {0.0, 0.0, 0.0};
    static const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    clast_mesh mesh = {0};
    clast_shape shape = {0};
    char name[32];
    (void)snprintf(name, sizeof name, "scan%d", number);
    clast_status status = CLAST_OK;
    CLI_TRY(clast_mesh_read(path, &mesh, NULL));
    deform(&mesh, number);
    CLI_TRY(clast_shape_mesh(name, &mesh, &shape));
    CLI_TRY(clast_assembly_add_shape(assembly, &shape, NULL));
    CLI_TRY(clast_assembly_add_grain(assembly, 0, origin, unturned, 1.0, 2500.0));
done:
    clast_shape_free(&shape);
    clast_mesh_free(&mesh);
    return status;
}

static clast_status grow_scans(cli_lap *b, const clast_aggregate_config *config, const char *path)
{
    clast_assembly *scan = calloc(N_SCAN + 1, sizeof *scan);
    clast_status status = CLAST_OK;
    if (scan == NULL) {
        return cli_fail(CLAST_E_MEMORY, "out of memory for %d shapes", N_SCAN);
    }
    const clast_aggregate_input input = {.core = scan, .n_coat = N_SCAN, .coat = scan + 1};
    cli_lap_start(b);
    for (int32_t i = 0; i <= N_SCAN; ++i) {
        CLI_TRY(add_scan(path, i, &scan[i]));
    }
    CLI_TRY(grow(config, &input));
done:
    cli_lap_stop(b);
    for (int32_t i = 0; i <= N_SCAN; ++i) {
        clast_assembly_free(&scan[i]);
    }
    free(scan);
    return status;
}

clast_status cli_scene_scans(cli_lap *b)
{
    clast_aggregate_config config;
    char path[1024];
    char coats[16 * N_SCAN];
    clast_status status = CLAST_OK;
    CLI_TRY(clast_fields_default(clast_aggregate_fields, &config));
    (void)snprintf(path, sizeof path, "%s/stl/particle.stl", b->data);
    coats[0] = '\0';
    for (int32_t i = 0; i < N_SCAN; ++i) {
        (void)snprintf(coats + strlen(coats), sizeof coats - strlen(coats), "coat=scan%d;", i + 1);
    }
    CLI_TRY(set_options(&config, b->data, coats));
    CLI_TRY(set_options(&config, b->data,
                        "core=scan0;core_size=1;size_law=loguniform;size_low=0.1;size_high=1;"
                        "n_particle=1000"));
    while (cli_lap_again(b)) {
        CLI_TRY(grow_scans(b, &config, path));
    }
done:
    b->value = b->wall;
    clast_fields_free(clast_aggregate_fields, &config);
    return status;
}
