// clast shape: how large a grain is and what form it has.
#include "command.h"
#include "idle.h"
#include "results.h"
#include "shape_statistics.h"
#include "shape_words.h"
#include "table_file.h"

#include <clast/table.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    int32_t axes, kind, degree, level;
    bool hull;
    char *unit, *columns, *surfaces, *statistics;
    char *voxels, *voxel_edge, *dataset, *threshold;
    int32_t voxel_type, least_voxels, skip;
    bool big_endian;
    double spacing;
    int32_t resamples;
    uint64_t seed;
    bool force;
} config;

#define TEXT(name, ...)                                                                            \
    {                                                                                              \
#name, .offset = offsetof(config, name), CLAST_FIELD_TEXT, 0, 0, 0, "-", .text = "",       \
               .help = __VA_ARGS__                                                                 \
    }
#define OUTPUT(name, ...)                                                                          \
    {                                                                                              \
#name, .offset = offsetof(config, name), CLAST_FIELD_TEXT, 0, 0, 0, CLAST_UNIT_OUTPUT,     \
               .text = "", .help = __VA_ARGS__                                                     \
    }
static const clast_field fields[] = {
    {"axes", .offset = offsetof(config, axes), CLAST_FIELD_CHOICE, CLAST_AXES_ELLIPSOID, 0, 0, "-",
     "definition of L, I and S behind D and the form factors",
     "ellipsoid|box|fitted|feret|principal", .common = true, .group = "measures"},
    {"hull", .offset = offsetof(config, hull), CLAST_FIELD_BOOL, 0, 0, 1, "-",
     "measure the convex hull (as packings use it), not the surface", NULL, .common = true},
    TEXT(unit,
         "unit of coordinates (mm, um, ...) in files that do not say theirs: results are then SI; "
         "none: model units",
         .common = true),
    {"kind", .offset = offsetof(config, kind), CLAST_FIELD_CHOICE, CLAST_GRAINS_AUTO, 0, 0, "-",
     "what files hold; auto: by name and content", "auto|surface|series|voxels|points|table|clump",
     .common = true, .group = "input"},
    {"degree", .offset = offsetof(config, degree), CLAST_FIELD_I32, -1, -1,
     CLAST_HARMONICS_MAX_DEGREE, "-", "series: terms up to this degree; -1: all", NULL,
     .group = "series and points"},
    {"level", .offset = offsetof(config, level), CLAST_FIELD_I32, 5, 0, 8, "-",
     "series: surface of 20 x 4^level triangles for calipers and boxes", NULL},
    {"spacing", .offset = offsetof(config, spacing), CLAST_FIELD_F64, 0, 0, 1e300, "-",
     "points: grid they were sampled on, in their unit, for a surface; 0: their convex hull", NULL},
    TEXT(voxels, "volume without a header: its sizes NX,NY,NZ, x fastest", .common = true,
         .group = "volumes"),
    {"voxel_type", .offset = offsetof(config, voxel_type), CLAST_FIELD_CHOICE, CLAST_VOLUME_U8, 0,
     0, "-", "type of its values", "u8|i8|u16|i16|u32|i32|f32|f64"},
    {"big_endian", .offset = offsetof(config, big_endian), CLAST_FIELD_BOOL, 0, 0, 1, "-",
     "its values have their high byte first", NULL},
    {"skip", .offset = offsetof(config, skip), CLAST_FIELD_I32, 0, 0, INT32_MAX, "-",
     "bytes before its values", NULL},
    TEXT(voxel_edge, "volume: edges of a voxel, A or A,B,C along x, y, z; none: the file's, or 1",
         .common = true),
    TEXT(dataset, "volume in an HDF5 file: name of the array [z][y][x]"),
    TEXT(threshold,
         "volume: grains are the connected parts above this grey value, their surfaces "
         "its level (of a mask of two values: smoothed, as of labels); none: values are labels, 0 "
         "outside",
         .common = true),
    {"least_voxels", .offset = offsetof(config, least_voxels), CLAST_FIELD_I32, 1, 1, INT32_MAX,
     "-", "volume: grains of fewer voxels are left out", NULL, .common = true},
    TEXT(columns, "table: columns of flatness,elongation or of L,I,S; none: by their names",
         .common = true, .group = "tables"),
    OUTPUT(surfaces, "write each grain's surface (or hull) as PLY into this folder", .common = true,
           .group = "output"),
    OUTPUT(statistics,
           "write statistics of the set into this folder: tables, Zingg diagram, "
           "histograms, correlation, principal components",
           .common = true),
    {"resamples", .offset = offsetof(config, resamples), CLAST_FIELD_I32, 2000, 0, 1e6, "-",
     "statistics: bootstrap resamples for the intervals", NULL},
    {"seed", .offset = offsetof(config, seed), CLAST_FIELD_U64, 1, 0, 1.8446744073709552e19, "-",
     "statistics: random numbers of the resamples", NULL},
    CLI_FORCE(config),
    {0}};

static clast_status unit_factor(const config *c, double *factor)
{
    *factor = 0.0;
    return c->unit[0] != '\0' ? clast_unit_factor(c->unit, "m", factor) : CLAST_OK;
}

/// Up to three numbers parted by commas; how many, or 0 for anything else.
static int numbers_of(const char *text, double value[3])
{
    int n = 0;
    for (char *end = NULL; n < 3; text = end + 1) {
        value[n] = strtod(text, &end);
        if (end == text) {
            return 0;
        }
        ++n;
        if (*end == '\0') {
            return n;
        }
        if (*end != ',') {
            return 0;
        }
    }
    return 0;
}

static clast_status volume_options(const config *c, clast_grains_options *o)
{
    double n[3] = {0};
    double *edge = o->volume.edge;
    const int n_edge = c->voxel_edge[0] != '\0' ? numbers_of(c->voxel_edge, edge) : 3;
    if (c->voxels[0] != '\0' && numbers_of(c->voxels, n) != 3) {
        return cli_fail(CLAST_E_USAGE, "voxels: '%s' is not NX,NY,NZ", c->voxels);
    }
    for (int k = 0; k < 3; ++k) {
        edge[k] = n_edge == 1 ? edge[0] : edge[k];
        if (n_edge == 0 || n_edge == 2 || (c->voxel_edge[0] != '\0' && !(edge[k] > 0.0))) {
            return cli_fail(CLAST_E_USAGE, "voxel_edge: '%s' is not one or three numbers above 0",
                            c->voxel_edge);
        }
        if (c->voxels[0] != '\0' && !(n[k] >= 1.0 && n[k] < 0x1p31 && floor(n[k]) == n[k])) {
            return cli_fail(CLAST_E_USAGE, "voxels: '%s' are not sizes", c->voxels);
        }
        o->volume.n[k] = (int32_t)n[k];
    }
    o->volume.type = (clast_volume_type)c->voxel_type;
    o->volume.is_big_endian = c->big_endian;
    o->volume.skip = c->skip;
    o->least_voxels = c->least_voxels;
    o->dataset = c->dataset;
    o->has_threshold = c->threshold[0] != '\0';
    double limit[3] = {0};
    if (o->has_threshold && numbers_of(c->threshold, limit) != 1) {
        return cli_fail(CLAST_E_USAGE, "threshold: '%s' is not a number", c->threshold);
    }
    o->threshold = limit[0];
    return CLAST_OK;
}

static clast_status write_table(const cli_common *common, const cli_shape_result *shape)
{
    clast_table table = {0};
    clast_status status = CLAST_OK;
    if (common->output != NULL) {
        CLI_TRY(clast_grains_table(&shape->grains, shape->axes, shape->in_metres, &table));
        CLI_TRY(cli_table_write(&table, common->output));
    }
done:
    clast_table_free(&table);
    return status;
}

/// The folder of the statistics: manifest, tables, charts, summary.
static clast_status write_statistics(const cli_common *common, const config *c, bool in_metres,
                                     const clast_grain_statistics *statistics,
                                     clast_run_folder *folder)
{
    clast_status status = CLAST_OK;
    json_t *summary = cli_statistics_json(statistics);
    cli_json_text(summary, "unit", in_metres ? "m" : "model");
    for (int32_t i = 0; i < common->n_argument && status == CLAST_OK; ++i) {
        status = clast_run_folder_input(folder, "grains", common->argument[i]);
    }
    if (status == CLAST_OK) {
        status = cli_results_open(folder, fields, c, &c->seed, &(cli_input){NULL, NULL});
    }
    if (status == CLAST_OK) {
        status = clast_grain_statistics_write(statistics, clast_run_folder_path(folder), "svg");
    }
    status = status == CLAST_OK ? cli_results_summary(folder, summary) : status;
    json_decref(summary);
    return clast_run_folder_end(folder, status);
}

/// Sizes of one set are compared: those whose unit nobody knows are taken to be in that of the
/// others.
static void tell_units(const cli_common *common, const cli_shape_result *shape)
{
    const clast_grain_record *known = NULL;
    const clast_grain_record *unknown = NULL;
    for (int64_t i = 0; i < shape->grains.n; ++i) {
        const clast_grain_record *r = &shape->grains.record[i];
        known = r->has_size && r->unit_m > 0.0 ? r : known;
        unknown = r->has_size && r->unit_m <= 0.0 ? r : unknown;
    }
    if (known != NULL && unknown != NULL && !common->quiet) {
        (void)fprintf(stderr,
                      "clast %s: note: %s says its unit of length and %s says none: the statistics "
                      "take them to be the same; --unit says what it is\n",
                      common->command, known->name, unknown->name);
    }
}

/// Statistics of the set, if they are wanted.
static clast_status add_statistics(const cli_common *common, const config *c,
                                   const cli_shape_result *shape, clast_run_folder *folder,
                                   clast_grain_statistics *statistics)
{
    const clast_bootstrap bootstrap = {.n_resample = c->resamples, .level = 0.95, .seed = c->seed};
    clast_table table = {0};
    clast_status status = CLAST_OK;
    if (folder != NULL && shape->grains.n > 0) {
        CLI_TRY(clast_grains_table(&shape->grains, shape->axes, shape->in_metres, &table));
        CLI_TRY(cli_shape_statistics(common->command, &table, &bootstrap, statistics));
        CLI_TRY(write_statistics(common, c, shape->in_metres, statistics, folder));
        if (!shape->in_metres) {
            tell_units(common, shape);
        }
    }
done:
    clast_table_free(&table);
    return status;
}

/// JSON or words about the grains and, if there are any, their statistics.
static clast_status print(const cli_common *common, const cli_shape_result *shape,
                          const clast_grain_statistics *statistics)
{
    if (common->json) {
        json_t *out = cli_shape_json(shape);
        if (statistics->set.n > 0) {
            (void)json_object_set_new(out, "statistics", cli_statistics_json(statistics));
        }
        return cli_print_json(out);
    }
    if (shape->grains.n > 0) {
        cli_shape_words(shape);
    }
    if (statistics->set.n > 0) {
        cli_statistics_words(statistics);
    }
    return CLAST_OK;
}

/// A mask has no grey levels that could be cut between two voxels.
static void tell_masks(const cli_common *common, const clast_grains *grains)
{
    int64_t n = 0;
    for (int64_t i = 0; i < grains->n; ++i) {
        n += grains->record[i].is_smoothed && grains->record[i].kind == CLAST_GRAINS_VOXELS;
    }
    if (n > 0 && !common->quiet) {
        (void)fprintf(
            stderr,
            "clast %s: %lld of %lld grains are of a mask (one value inside, one outside, "
            "no grey levels at --threshold): their surfaces are smoothed as labels' are\n",
            common->command, (long long)n, (long long)grains->n);
    }
}

/// One line for each file or label that could not be measured, and for rows left out.
static clast_status tell_faults(const cli_common *common, const clast_grains *grains)
{
    clast_status worst = CLAST_OK;
    for (int64_t i = 0; i < grains->n_note && !common->quiet; ++i) {
        (void)fprintf(stderr, "clast %s: %s\n", common->command, cli_name(grains->note[i].text));
    }
    for (int64_t i = 0; i + 1 < grains->n_fault; ++i) {
        (void)fprintf(stderr, "clast %s: %s\n", common->command, cli_name(grains->fault[i].text));
    }
    if (grains->n_fault > 0) { // the frame prints the last line
        const clast_grain_fault *last = &grains->fault[grains->n_fault - 1];
        worst = cli_fail(last->status, "%s", last->text);
    }
    return worst;
}

/// Kinds of files have options of their own, bare values too.
static clast_status check_kinds(const config *c, uint32_t kinds)
{
    const clast_grains_options files = {.kind = (clast_grains_kind)c->kind,
                                        .volume.n[0] = c->voxels[0] != '\0'};
    clast_idle rules[CLAST_N_IDLE];
    return cli_idle_check(fields, c, clast_grains_idle(&files, kinds, rules));
}

/// So have statistics; what the files are is known before they are read where --kind says it.
static clast_status check_used(const config *c)
{
    const clast_idle own[] = {{c->statistics[0] == '\0', "resamples|seed", "without --statistics"},
                              {0}};
    CLI_GUARD(cli_idle_check(fields, c, own));
    return check_kinds(c, 0);
}

/// Else once they have been: a file at fault may be of any kind.
static clast_status check_read(const config *c, const clast_grains *grains)
{
    uint32_t found = 0;
    for (int64_t i = 0; i < grains->n; ++i) {
        found |= 1U << grains->record[i].kind;
    }
    return grains->n_fault > 0 ? CLAST_OK : check_kinds(c, found);
}

static clast_status run(const cli_common *common, void *config_bytes)
{
    config *c = config_bytes;
    CLI_GUARD(check_used(c));
    CLI_GUARD(cli_table_check(common->output));
    clast_run_folder *folder = NULL;
    double unit_m = 0.0;
    clast_grain_statistics statistics = {0};
    cli_shape_result shape = {.axes = (clast_axes_kind)c->axes, .is_hull = c->hull};
    clast_grains_options options = {
        .kind = (clast_grains_kind)c->kind,
        .hull = c->hull,
        .degree = c->degree,
        .level = c->level,
        .spacing = c->spacing,
        .columns = c->columns[0] != '\0' ? c->columns : NULL,
        .folder = c->surfaces[0] != '\0' ? c->surfaces : NULL,
        .unit = c->unit,
    };
    const clast_monitor monitor = cli_monitor(common);
    clast_status status = CLAST_OK;
    CLI_TRY(cli_results_begin(common, c->statistics, &c->force, &folder));
    CLI_TRY(unit_factor(c, &unit_m));
    CLI_TRY(volume_options(c, &options));
    CLI_TRY(clast_grains_read(common->n_argument, (const char *const *)common->argument, &options,
                              &monitor, &shape.grains));
    CLI_TRY(check_read(c, &shape.grains));
    CLI_TRY(clast_grains_to_metres(&shape.grains, unit_m, &shape.in_metres));
    CLI_TRY(write_table(common, &shape));
    CLI_TRY(add_statistics(common, c, &shape, folder, &statistics));
    CLI_TRY(print(common, &shape, &statistics));
    if (options.has_threshold) {
        tell_masks(common, &shape.grains);
    }
    CLI_TRY(tell_faults(common, &shape.grains));
done:
    clast_run_folder_destroy(folder);
    clast_grains_free(&shape.grains);
    clast_grain_statistics_free(&statistics);
    return status;
}

#define FACTOR(id, name, symbol, label, formula, value, low, high, source)                         \
    "\n  " symbol "  " name " = " formula "  [" source "]"
#define AXES(id, name, what, source) "\n  " name ": " what "  [" source "]"

const cli_command cli_shape = {
    .name = "shape",
    .arguments = "FILE [FILE...]",
    .summary = "size and form of grains: volume, L I S, form factors, roundness",
    .example = {"clast shape data/standin63/grain00.ply data/standin63/grain01.ply",
                "clast shape data/standin63/*.ply --statistics forms/",
                "clast shape scan.stl --unit um --json"},
    .details =
        "Files: surfaces (STL, OBJ, PLY, OFF), coefficients of spherical harmonics (rows n m Re "
        "Im),\nvolumes of labels or, with --threshold, grey values (NRRD, TIFF stack, HDF5 array, "
        "bare "
        "values,\nXsize: ... text), points (x,y,z: CSV, VTK, PLY without faces), clumps of spheres "
        "(x,y,z and\nradius or diameter: the union of the spheres), tables of L,I,S "
        "or flatness,elongation.\n-o FILE.csv or FILE.json writes everything as a table.\n"
        "--statistics FOLDER: means, deviations, quantiles with bootstrap intervals, Shapiro-Wilk, "
        "Pearson,\nprincipal components as CSV; Zingg diagram, histograms, correlation as SVG; "
        "summary.json,\nmanifest.json (docs/theory/statistics.md).\n"
        "Files that cannot be measured get one line on stderr each, the others are measured; exit "
        "code 3.\n\nL >= I >= S by definition (--axes; all are in --json and CSV):" CLAST_AXES_LIST(
            AXES) "\n  D = sqrt((S^2+I^2)/2), the sieve size [Rettinger2022 eq. 1]\n\n"
                  "Form factors (Table 1 of Rettinger et al. 2022; inverses are "
                  "inverse_NAME):" CLAST_FORM_FACTOR_LIST(
                      FACTOR) "\n  Zingg class: S/I and I/L above or below 2/3: sphere, disc, rod, "
                              "blade  [Zingg1935]\n\n"
                              "Shape of the surface (the outer one: closed pores are filled; "
                              "volume, "
                              "moments and L I S by ellipsoid\nare of the solid):"
                              "\n  sphericity = (36 pi V^2)^(1/3)/A  [Wadell1932]"
                              "\n  convexity = V/V(convex hull); hull_volume_added = V(convex "
                              "hull)/V - 1"
                              "\n  roundness = Wadell's: mean radius of the corners of the outline "
                              "of the greatest shadow\n    by the radius of the greatest circle in "
                              "it; none below 1000 triangles or 60 edges of\n    the outline  "
                              "[Wadell1932; ZhengHryciw2015]"
                              "\n  normal_roundness = surface mean of cos(normal, ray from the "
                              "centroid)  [BullardGarboczi2013]"
                              "\n  angularity = mean over directions of |r - r_e|/r_e, r_e of the "
                              "mass-equivalent "
                              "ellipsoid\n    (the radius method in 3-D)  [Masad2001]"
                              "\n  feret_max, feret_min: longest and shortest caliper, exact"
                              "\n  projected_mean = A(convex hull)/4  [Cauchy1841]; projected_min, "
                              "projected_max: least "
                              "and\n    greatest shadow of the hull\n"
                              "Moments of inertia are at density 1. Sources: docs/theory/form.md.",
    .fields = fields,
    .config_size = sizeof(config),
    .n_min = 1,
    .n_max = INT32_MAX,
    .run = run,
};
