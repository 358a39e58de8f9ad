// clast porosity: profile and bulk porosity of any assembly.
#include "bed_runs.h"
#include "command.h"
#include "json.h"
#include "results.h"

#include <clast/assembly.h>
#include <clast/chart.h>
#include <clast/state.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    char *bed;
    char *floor, *layer, *trim, *gap, *diameter; ///< as typed: the run's unit says how to read them
    int32_t method;
    double cut;
    bool at_slice, local;
    int32_t rings;
    double core;
    int64_t pores;
    char *columns;
    bool force;
} porosity_config;

/// What was typed, in the run's unit.
typedef struct {
    double floor, layer, trim, gap, diameter;
} lengths;

#define FIELD(type, member) #member, .offset = offsetof(porosity_config, member), type
static const clast_field fields[] = {
    {FIELD(CLAST_FIELD_TEXT, bed), 0, 0, 0, "-",
     "container: cylinder:RADIUS[,X,Y], box:X0,Y0,X1,Y1, periodic:X0,Y0,X1,Y1 (x and y), "
     "periodic:X0,Y0,Z0,X1,Y1,Z1 (all directions) or mesh:FILE,UNIT; none: the run's",
     "", .group = "bed and container", .common = true},
    {FIELD(CLAST_FIELD_TEXT, floor), 0, 0, 0, "-", "height of the bottom, with --bed (as 5mm)",
     "0"},
    {FIELD(CLAST_FIELD_CHOICE, method), CLAST_POROSITY_EXACT, 0, 1, "-",
     "true shapes, or each grain as the sphere of its volume (published)", "exact|spheres",
     .group = "bulk porosity", .common = true},
    {FIELD(CLAST_FIELD_TEXT, layer), 0, 0, 0, "-",
     "height of a slice (as 1mm); 0: 1 mm as published, or a tenth of the mean diameter of a run "
     "without unit, whose lengths are bare numbers here too",
     "0", .common = true},
    {FIELD(CLAST_FIELD_F64, cut), 0.5, 0, 1, "-",
     "the bed ends where the porosity rises through this (n_cut)", NULL, .common = true},
    {FIELD(CLAST_FIELD_TEXT, trim), 0, 0, 0, "-",
     "left out at both ends (h_pd; published for periodic beds: 31.5mm)", "0", .common = true},
    {FIELD(CLAST_FIELD_BOOL, at_slice), 0, 0, 1, "-",
     "end the bed with a slice, as the reference program; else between slices", NULL},
    {FIELD(CLAST_FIELD_F64, core), 0, 0, 1e6, "-",
     "porosity without the side walls' share too: of what is farther from them than this many "
     "grain sizes (2 to 3 where the bed is wide enough); 0: not",
     NULL, .common = true},
    {FIELD(CLAST_FIELD_TEXT, gap), 0, 0, 0, "-",
     "grains this close touch (as 10um), where the run does not know its contacts", "0",
     .group = "more measures", .common = true},
    {FIELD(CLAST_FIELD_BOOL, local), 0, 0, 1, "-",
     "porosity around each grain too, by radical Voronoi cells of equal-volume spheres", NULL,
     .common = true},
    {FIELD(CLAST_FIELD_I32, rings), 0, 0, 100000, "-",
     "porosity over the radius of a cylinder too, in this many rings", NULL, .common = true},
    {FIELD(CLAST_FIELD_I64, pores), 0, 0, 1e8, "-",
     "sizes of pores too, from this many even points of the bed", NULL, .common = true},
    {FIELD(CLAST_FIELD_TEXT, columns), 0, 0, 0, "-",
     "spheres: what the file's columns are, such as id,x,y,z,d (x, y, z, r or d; others are passed "
     "over); none: by their names",
     ""},
    {FIELD(CLAST_FIELD_TEXT, diameter), 0, 0, 0, "-",
     "spheres: diameter of all, in place of the file's; 0: the file's", "0"},
    CLI_FORCE(porosity_config),
    {0},
};
#undef FIELD

enum { PORE_BINS = 50 };

static bool ends_with(const char *text, const char *end)
{
    const size_t n = strlen(text);
    const size_t m = strlen(end);
    return n >= m && strcmp(text + n - m, end) == 0;
}

/// A run that is measured.
typedef struct {
    clast_assembly assembly;
    clast_bed bed;
    clast_mesh surface;   ///< of the bed, or empty
    clast_table contacts; ///< forces, without columns where the run does not know them
    bool has_bed;
} subject;

static void subject_free(subject *s)
{
    clast_assembly_free(&s->assembly);
    clast_mesh_free(&s->surface);
    clast_table_free(&s->contacts);
}

/// The grains, and the run's own bed and contact forces where it has them.
static clast_status read_input(const char *input, const porosity_config *config, subject *s)
{
    char path[CLAST_RUN_PATH];
    double diameter = 0.0;
    clast_status found = clast_run_folder_state(input, path);
    if (found == CLAST_OK) { // read_lengths checks its unit, once the file's is known
        found = clast_unit_parse(config->diameter, "m", &diameter);
    }
    if (found != CLAST_OK) {
        return found;
    }
    if (!ends_with(path, ".h5")) {
        const clast_packing_options options = {config->columns, diameter};
        return clast_packing_read(path, &options, &s->assembly);
    }
    if (config->columns[0] != '\0' || diameter > 0.0) {
        return cli_fail(CLAST_E_USAGE,
                        "%s is a run, which knows its grains: leave out --columns and "
                        "--diameter",
                        input);
    }
    const clast_status status = clast_state_read_assembly(path, &s->assembly);
    if (status == CLAST_OK) {
        s->has_bed = clast_bed_read(path, &s->bed, &s->surface) == CLAST_OK;
        (void)clast_state_read_table(path, "contacts", &s->contacts); // other programs have none
    }
    return status;
}

static double mean_diameter(const clast_assembly *a)
{
    return a->n_grain > 0 ? 2.0 * cbrt(0.75 / CLAST_PI * clast_assembly_volume(a) / a->n_grain)
                          : 1.0;
}

/// Everything that is measured.
typedef struct {
    clast_table profile;
    clast_table coordination; ///< without columns where contacts are not known
    clast_table fabric;       ///< directions of contacts and grains
    clast_table local;        ///< without columns unless asked for, as the next
    clast_table radial;
    clast_pores pores;
    clast_table stress; ///< without columns where forces are not known, as the next
    clast_table stress_profile;
    clast_porosity_bulk bulk;
    clast_bed_walls walls;
    clast_porosity_core core; ///< where asked for
    double mean_coordination; ///< NAN where contacts are not known
    clast_overlaps overlaps;
} findings;

static void findings_free(findings *f)
{
    clast_table_free(&f->profile);
    clast_table_free(&f->coordination);
    clast_table_free(&f->fabric);
    clast_table_free(&f->local);
    clast_table_free(&f->radial);
    clast_pores_free(&f->pores);
    clast_table_free(&f->stress);
    clast_table_free(&f->stress_profile);
}

/// Contacts, directions and overlaps. The contacts of a run of clast pack overlap by what their
/// forces need, which that run tells: they are not searched for anew.
static clast_status measure_contacts(subject *s, double gap, findings *f)
{
    clast_assembly *assembly = &s->assembly;
    const clast_bed *bed = &s->bed;
    clast_period period = {.low = {bed->low[0], bed->low[1], bed->floor}};
    const bool is_periodic = clast_bed_period(bed, period.length);
    clast_status status = CLAST_OK;
    f->overlaps = (clast_overlaps){-1, NAN, NAN};
    if (s->contacts.n_column == 0) {
        status = clast_assembly_overlaps(assembly, is_periodic ? &period : NULL, &f->overlaps);
    }
    f->mean_coordination = NAN;
    if (status == CLAST_OK && gap > 0.0) {
        status = clast_assembly_find_contacts_periodic(assembly, gap, is_periodic ? &period : NULL);
    }
    if (status == CLAST_OK && assembly->contact != NULL) {
        f->mean_coordination = 2.0 * assembly->n_contact / assembly->n_grain;
        status = clast_assembly_coordination(assembly, &f->coordination);
    }
    if (status == CLAST_OK) {
        status = clast_fabric(assembly, s->contacts.n_column > 0 ? &s->contacts : NULL,
                              is_periodic ? period.length : NULL, &f->fabric);
    }
    return status;
}

/// A bed that holds more solid than room is not the one that the grains lie in.
static clast_status check_bed(const clast_porosity_bulk *bulk)
{
    return bulk->porosity >= -1e-2 ? CLAST_OK
                                   : cli_fail(CLAST_E_GEOMETRY,
                                              "grains take %.4g times the room of this bed between "
                                              "z = %g and %g: it is smaller than what holds them, "
                                              "or in another unit (--bed)",
                                              1.0 - bulk->porosity, bulk->z_low, bulk->z_high);
}

static clast_status measure(subject *s, const clast_porosity_options *options, double gap,
                            const porosity_config *config, findings *f)
{
    clast_assembly *assembly = &s->assembly;
    const clast_bed *bed = &s->bed;
    clast_status status = CLAST_OK;
    clast_bed_wrap(bed, assembly);
    status = clast_porosity_profile(assembly, bed, options, &f->profile);
    if (status == CLAST_OK) {
        status = clast_porosity_measure(assembly, bed, options, &f->profile, &f->bulk);
        status = status == CLAST_OK ? check_bed(&f->bulk) : status;
    }
    f->walls = clast_bed_side_walls(bed, assembly);
    if (status == CLAST_OK && config->core > 0.0) {
        status =
            clast_porosity_core_measure(assembly, bed, options, &f->bulk, config->core, &f->core);
    }
    if (status == CLAST_OK) {
        status = measure_contacts(s, gap, f);
    }
    if (status == CLAST_OK && config->local) {
        status = clast_local_porosity(assembly, bed, bed->floor, f->bulk.top, &f->local);
    }
    const double z[2] = {f->bulk.z_low, f->bulk.z_high};
    if (status == CLAST_OK && config->rings > 0) {
        const clast_radial_options rings = {options->method, config->rings, 0};
        status = clast_radial_porosity(assembly, bed, z, &rings, &f->radial);
    }
    if (status == CLAST_OK && config->pores > 0) {
        clast_pore_options pores = {.n_point = config->pores, .n_bin = PORE_BINS};
        (void)clast_bed_period(bed, pores.period);
        status = clast_pores_measure(assembly, bed, z, &pores, &f->pores);
    }
    if (status == CLAST_OK && s->contacts.n_row > 0) {
        status = clast_stress(&s->contacts, bed, z, &f->stress);
        status = status == CLAST_OK
                     ? clast_stress_profile(&s->contacts, bed, &f->profile, &f->stress_profile)
                     : status;
    }
    return status;
}

/// Mean and standard deviation of the local porosity of grains whose cell no wall cuts.
static int64_t local_moments(const clast_table *local, double *mean, double *deviation)
{
    const double *porosity = clast_table_numbers(local, "porosity");
    const double *border = clast_table_numbers(local, "border");
    int64_t n = 0;
    double sum = 0.0;
    double square = 0.0;
    for (int64_t i = 0; porosity != NULL && border != NULL && i < local->n_row; ++i) {
        if (border[i] == 0.0 && isfinite(porosity[i])) {
            ++n;
            sum += porosity[i];
        }
    }
    *mean = n > 0 ? sum / (double)n : (double)NAN;
    for (int64_t i = 0; porosity != NULL && border != NULL && i < local->n_row; ++i) {
        if (border[i] == 0.0 && isfinite(porosity[i])) {
            square += (porosity[i] - *mean) * (porosity[i] - *mean);
        }
    }
    *deviation = n > 1 ? sqrt(square / (double)(n - 1)) : (double)NAN;
    return n;
}

static json_t *profile_json(const findings *f)
{
    json_t *rows = json_array();
    const double *low = f->profile.column[0].number; // z_low, z_high, with _m where that is known
    const double *high = f->profile.column[1].number;
    const double *porosity = clast_table_numbers(&f->profile, "porosity");
    for (int64_t k = 0; k < f->profile.n_row; ++k) {
        json_t *row = json_object();
        cli_json_number(row, "z", 0.5 * (low[k] + high[k]));
        cli_json_number(row, "porosity", porosity[k]);
        (void)json_array_append_new(rows, row);
    }
    return rows;
}

static json_t *to_json(const clast_assembly *assembly, const porosity_config *config,
                       const findings *f)
{
    json_t *object = json_object();
    cli_json_text(object, "method", config->method == CLAST_POROSITY_EXACT ? "exact" : "spheres");
    cli_json_count(object, "n_grain", assembly->n_grain);
    cli_json_number(object, "bulk", f->bulk.porosity);
    cli_json_number(object, "z_low", f->bulk.z_low);
    cli_json_number(object, "z_high", f->bulk.z_high);
    cli_json_number(object, "top", f->bulk.top);
    cli_json_number(object, "solid", f->bulk.solid);
    cli_json_number(object, "grain_size", f->walls.size);
    if (isfinite(f->walls.ratio)) {
        cli_json_number(object, "wall_ratio", f->walls.ratio);
    }
    if (config->core > 0.0) {
        cli_json_number(object, "core_depth", f->core.depth);
        cli_json_number(object, "core", f->core.porosity);
        cli_json_number(object, "core_error", f->core.error);
        cli_json_number(object, "wall_share", f->core.share);
    }
    cli_json_number(object, "coordination", f->mean_coordination);
    if (f->overlaps.n >= 0) {
        cli_json_count(object, "n_overlap", f->overlaps.n);
        cli_json_number(object, "max_overlap", f->overlaps.depth);
        cli_json_number(object, "max_overlap_share", f->overlaps.share);
    }
    cli_json_text(object, "unit", assembly->unit);
    if (f->local.n_column > 0) {
        double mean = NAN;
        double deviation = NAN;
        cli_json_count(object, "n_local", local_moments(&f->local, &mean, &deviation));
        cli_json_number(object, "local_mean", mean);
        cli_json_number(object, "local_deviation", deviation);
    }
    if (f->pores.sizes.n_column > 0) {
        cli_json_number(object, "pore_mean", f->pores.mean);
        cli_json_number(object, "pore_porosity", f->pores.porosity);
    }
    json_t *fabric = json_object();
    for (int64_t k = 0; k < f->fabric.n_row; ++k) {
        cli_json_number(fabric, f->fabric.column[0].text[k], f->fabric.column[1].number[k]);
    }
    (void)json_object_set_new(object, "fabric", fabric);
    if (f->stress.n_column > 0) {
        json_t *stress = json_object();
        for (int64_t k = 0; k < f->stress.n_row; ++k) {
            cli_json_number(stress, f->stress.column[0].text[k], f->stress.column[1].number[k]);
        }
        (void)json_object_set_new(object, "stress", stress);
    }
    return object;
}

static clast_status write_tables(const clast_run_folder *run, const clast_assembly *assembly,
                                 findings *f)
{
    char path[CLAST_RUN_PATH];
    clast_status status = CLAST_OK;
    const struct {
        const char *name;
        clast_table *table;
    } files[] = {{"profile.csv", &f->profile}, {"coordination.csv", &f->coordination},
                 {"fabric.csv", &f->fabric},   {"local.csv", &f->local},
                 {"radial.csv", &f->radial},   {"pores.csv", &f->pores.sizes},
                 {"stress.csv", &f->stress},   {"stress_profile.csv", &f->stress_profile}};
    for (size_t k = 0; k < sizeof files / sizeof files[0] && status == CLAST_OK; ++k) {
        if (files[k].table->n_column > 0) {
            if (strcmp(assembly->unit, "m") != 0) {
                cli_table_without_unit(files[k].table);
            }
            status = clast_run_folder_file(run, files[k].name, path);
            status = status == CLAST_OK ? clast_table_write_csv(files[k].table, path) : status;
        }
    }
    return status;
}

/// Charts, then the tables that they are drawn from.
static clast_status write_findings(const clast_run_folder *run, const clast_assembly *assembly,
                                   findings *f)
{
    char path[CLAST_RUN_PATH];
    clast_status status = clast_run_folder_file(run, "profile.svg", path);
    if (status == CLAST_OK) {
        status = clast_porosity_chart_write(&f->profile, &f->bulk, assembly->unit, path);
    }
    if (status == CLAST_OK && f->radial.n_column > 0) {
        status = clast_run_folder_file(run, "radial.svg", path);
        status = status == CLAST_OK ? clast_radial_chart_write(&f->radial, assembly->unit, path)
                                    : status;
    }
    if (status == CLAST_OK && f->stress_profile.n_column > 0) {
        status = clast_run_folder_file(run, "stress.svg", path);
        status = status == CLAST_OK
                     ? clast_stress_chart_write(&f->stress_profile, assembly->unit, path)
                     : status;
    }
    if (status == CLAST_OK && f->pores.sizes.n_column > 0) {
        status = clast_run_folder_file(run, "pores.svg", path);
        status = status == CLAST_OK ? clast_pore_chart_write(&f->pores.sizes, assembly->unit, path)
                                    : status;
    }
    return status == CLAST_OK ? write_tables(run, assembly, f) : status;
}

/// File of --bed mesh:FILE,UNIT, or "".
static void bed_file(const char *bed, char path[4096])
{
    const char *comma = strrchr(bed, ',');
    const char *end = comma != NULL ? comma : bed + strlen(bed);
    path[0] = '\0';
    if (strncmp(bed, "mesh:", 5) == 0) {
        (void)snprintf(path, 4096, "%.*s", (int)(end - bed - 5), bed + 5);
    }
}

/// Makes the folder, which says where the results came from: the state of every run, the bed's
/// surface.
static clast_status open_results(const cli_common *common, const porosity_config *config,
                                 clast_run_folder *run)
{
    char path[CLAST_RUN_PATH];
    clast_status status = CLAST_OK;
    for (int32_t i = 0; i < common->n_argument && run != NULL && status == CLAST_OK; ++i) {
        status = clast_run_folder_state(common->argument[i], path);
        status = status == CLAST_OK ? clast_run_folder_input(run, "run", path) : status;
    }
    bed_file(config->bed, path);
    const cli_input inputs[] = {{"bed", path}, {NULL, NULL}};
    return status == CLAST_OK ? cli_results_open(run, fields, config, NULL, inputs) : status;
}

/// What the side walls do to the bulk porosity.
static void print_walls(const porosity_config *config, const clast_bed *bed, const char *unit,
                        const findings *f)
{
    if (bed->kind == CLAST_BED_MESH) {
        (void)printf("side walls          a surface: its distance in grain sizes is not known\n");
    } else if (!isfinite(f->walls.ratio)) {
        (void)printf("side walls          none: the bed is periodic\n");
    } else {
        (void)printf("side walls          %.4g grain sizes (of %.4g %s, mean by volume) from the "
                     "axis%s\n",
                     f->walls.ratio, f->walls.size, unit,
                     config->core > 0.0     ? ""
                     : f->walls.ratio > 2.5 ? ", which loosen the bed; --core 2 leaves them out"
                                            : ", which loosen the bed");
    }
    if (config->core > 0.0) {
        (void)printf(
            "core                %.6f   +- %.2g, farther than %g grain sizes from the side "
            "walls; their share of the bulk porosity is %.4f\n",
            f->core.porosity, f->core.error, config->core, f->core.share);
    }
}

static clast_status print(const cli_common *common, const porosity_config *config,
                          const clast_assembly *assembly, const clast_bed *bed, const findings *f)
{
    const bool is_model = strcmp(assembly->unit, "model") == 0;
    const char *unit = is_model ? "model units" : assembly->unit;
    if (common->json) {
        json_t *object = to_json(assembly, config, f);
        (void)json_object_set_new(object, "profile", profile_json(f));
        return cli_print_json(object);
    }
    (void)printf("%d grain%s, %s\n", assembly->n_grain, cli_plural(assembly->n_grain),
                 config->method == CLAST_POROSITY_EXACT ? "true shapes"
                                                        : "spheres of equal volume");
    (void)printf("bulk porosity       %.6f   from z = %.6g to %.6g %s\n", f->bulk.porosity,
                 f->bulk.z_low, f->bulk.z_high, unit);
    if (bed->kind == CLAST_BED_PERIODIC_3D) {
        (void)printf("bed                 periodic in all three directions: the whole box\n");
    } else {
        (void)printf("top of the bed      %.6g %s   where the porosity rises through %g\n",
                     f->bulk.top, unit, config->cut);
    }
    print_walls(config, bed, unit, f);
    if (f->overlaps.n > 0) {
        (void)printf(
            "overlaps            %d pair%s of grains, the deepest by %.3g %% of the smaller "
            "one's radius (of equal volume); the solid counts what they share twice\n",
            f->overlaps.n, f->overlaps.n == 1 ? "" : "s", 100.0 * f->overlaps.share);
    } else if (f->overlaps.n < 0) {
        (void)printf("overlaps            those of the run's own contacts: max_overlap in its "
                     "summary.json\n");
    } else {
        (void)printf("overlaps            none\n");
    }
    if (isfinite(f->mean_coordination)) {
        (void)printf("mean coordination   %.4f   from %d contacts\n", f->mean_coordination,
                     assembly->n_contact);
    }
    if (f->local.n_column > 0) {
        double mean = NAN;
        double deviation = NAN;
        const int64_t n = local_moments(&f->local, &mean, &deviation);
        if (n > 1) {
            (void)printf(
                "local porosity      %.4f mean, %.4f standard deviation, of %lld grains whose "
                "cells reach no wall\n",
                mean, deviation, (long long)n);
        } else {
            (void)printf(
                "local porosity      every grain's cell but %lld reaches a wall: no mean\n",
                (long long)n);
        }
    }
    if (f->pores.sizes.n_column > 0) {
        (void)printf(
            "pores               %.6g %s   mean distance to the nearest grain; porosity by "
            "points %.4f\n",
            f->pores.mean, unit, f->pores.porosity);
    }
    for (int64_t k = 0; k < f->fabric.n_row; ++k) {
        (void)printf("%-20s %.4f   %s\n", f->fabric.column[0].text[k],
                     f->fabric.column[1].number[k], f->fabric.column[3].text[k]);
    }
    for (int64_t k = 0; k < f->stress.n_row; ++k) {
        (void)printf("%-20s %.4g %s   %s\n", f->stress.column[0].text[k],
                     f->stress.column[1].number[k], f->stress.column[2].text[k],
                     f->stress.column[3].text[k]);
    }
    if (common->output != NULL) {
        (void)printf("tables and profile.svg are in %s\n", common->output);
    }
    return CLAST_OK;
}

/// A length as typed: with its unit for a run in metres, bare in the unit of any other.
static clast_status parse_length(const char *name, const char *text, const char *unit,
                                 double *value)
{
    const bool is_metre = strcmp(unit, "m") == 0;
    const clast_status status =
        is_metre ? clast_unit_parse_asked(text, "m", value) : clast_unit_parse(text, "-", value);
    return status == CLAST_OK
               ? CLAST_OK
               : cli_fail(status, "%s: %s%s", name, clast_error_detail(),
                          is_metre ? "" : "; the run has no unit, so a bare number in its own");
}

static clast_status read_length(const char *name, const char *text, const char *unit, double *value)
{
    const double low = strcmp(name, "floor") == 0 ? -1e9 : 0.0;
    const clast_status status = parse_length(name, text, unit, value);
    if (status != CLAST_OK) {
        return status;
    }
    return *value >= low && *value <= 1e9
               ? CLAST_OK
               : cli_fail(CLAST_E_CONFIG, "%s: %s is outside [%g, 1e9]", name, text, low);
}

static clast_status read_lengths(const porosity_config *config, const char *unit, lengths *out)
{
    const struct {
        const char *name, *text;
        double *value;
    } wanted[] = {{"floor", config->floor, &out->floor},
                  {"layer", config->layer, &out->layer},
                  {"trim", config->trim, &out->trim},
                  {"gap", config->gap, &out->gap},
                  {"diameter", config->diameter, &out->diameter}};
    clast_status status = CLAST_OK;
    for (size_t k = 0; k < sizeof wanted / sizeof wanted[0] && status == CLAST_OK; ++k) {
        status = read_length(wanted[k].name, wanted[k].text, unit, wanted[k].value);
    }
    return status;
}

/// The lengths of --bed, in the unit in which read_length takes the others; what is no number is
/// left to clast_bed_load.
static clast_status check_bed_lengths(const char *bed, const char *unit)
{
    const char *at = strncmp(bed, "mesh:", 5) == 0 ? NULL : strchr(bed, ':');
    clast_status status = CLAST_OK;
    while (at != NULL && status == CLAST_OK) {
        char one[64];
        double value = 0.0;
        const size_t n = strcspn(++at, ",");
        (void)snprintf(one, sizeof one, "%.*s", (int)n, at);
        if (clast_unit_parse(one, "m", &value) == CLAST_OK) {
            status = parse_length("bed", one, unit, &value);
        }
        at = at[n] == ',' ? at + n : NULL;
    }
    return status;
}

/// Reads a run and measures it.
static clast_status measure_run(const char *input, const porosity_config *config, subject *s,
                                findings *found)
{
    lengths typed = {0};
    clast_status status = read_input(input, config, s);
    if (status == CLAST_OK) {
        status = read_lengths(config, s->assembly.unit, &typed);
    }
    if (status == CLAST_OK && config->bed[0] != '\0') {
        clast_mesh_free(&s->surface);
        status = check_bed_lengths(config->bed, s->assembly.unit);
        status = status == CLAST_OK ? clast_bed_load(config->bed, &s->bed, &s->surface) : status;
        const bool has_floor =
            s->bed.kind == CLAST_BED_MESH || s->bed.kind == CLAST_BED_PERIODIC_3D;
        if (status == CLAST_OK && has_floor && typed.floor != 0.0) {
            status = cli_fail(CLAST_E_USAGE, "--bed %s has a bottom of its own: leave out --floor",
                              config->bed);
        }
        s->bed.floor = has_floor ? s->bed.floor : typed.floor;
    } else if (status == CLAST_OK && !s->has_bed) {
        status = cli_fail(CLAST_E_USAGE,
                          "%s does not say what holds the grains; give --bed, such "
                          "as cylinder:52mm",
                          input);
    }
    clast_porosity_options options = clast_porosity_options_default();
    options.method = (clast_porosity_method)config->method;
    options.cut = config->cut;
    options.trim = typed.trim;
    options.at_slice = config->at_slice;
    if (typed.layer > 0.0) {
        options.layer = typed.layer;
    } else if (strcmp(s->assembly.unit, "m") != 0) {
        options.layer = 0.1 * mean_diameter(&s->assembly);
    }
    return status == CLAST_OK ? measure(s, &options, typed.gap, config, found) : status;
}

static clast_status gather(const cli_common *common, const porosity_config *config,
                           cli_bed_runs *runs)
{
    clast_status status = CLAST_OK;
    clast_bed_kind kind = CLAST_BED_CYLINDER;
    for (int32_t i = 0; i < common->n_argument && status == CLAST_OK; ++i) {
        subject s = {0};
        findings found = {0};
        status = measure_run(common->argument[i], config, &s, &found);
        if (status == CLAST_OK && i > 0 && s.bed.kind != kind) {
            status = cli_fail(CLAST_E_USAGE,
                              "%s and %s lie in containers of two kinds: they are no realisations "
                              "of one bed",
                              common->argument[0], common->argument[i]);
        }
        kind = s.bed.kind;
        if (status == CLAST_OK) {
            status = cli_bed_runs_add(runs, common->argument[i], s.assembly.unit,
                                      to_json(&s.assembly, config, &found), &found.profile,
                                      &found.radial);
        }
        findings_free(&found);
        subject_free(&s);
    }
    return status;
}

/// Keeps the summary; the object is dropped.
static clast_status keep_summary(const clast_run_folder *run, json_t *object)
{
    const clast_status status = cli_results_summary(run, object);
    json_decref(object);
    return status;
}

static clast_status run_several(const cli_common *common, const porosity_config *config,
                                clast_run_folder *run)
{
    cli_bed_runs runs = {0};
    clast_status status = gather(common, config, &runs);
    if (status == CLAST_OK && run != NULL) {
        status = open_results(common, config, run);
        status = status == CLAST_OK ? cli_bed_runs_write(&runs, run) : status;
        status = status == CLAST_OK ? keep_summary(run, cli_bed_runs_json(&runs)) : status;
        status = clast_run_folder_end(run, status);
    }
    if (status == CLAST_OK) {
        status =
            common->json ? cli_print_json(cli_bed_runs_json(&runs)) : cli_bed_runs_print(&runs);
    }
    cli_bed_runs_free(&runs);
    return status;
}

static clast_status run_one(const cli_common *common, const porosity_config *config,
                            clast_run_folder *run)
{
    subject s = {0};
    findings found = {0};
    clast_status status = measure_run(common->argument[0], config, &s, &found);
    if (status == CLAST_OK && run != NULL) {
        status = open_results(common, config, run);
        status = status == CLAST_OK ? write_findings(run, &s.assembly, &found) : status;
        status =
            status == CLAST_OK ? keep_summary(run, to_json(&s.assembly, config, &found)) : status;
        status = clast_run_folder_end(run, status);
    }
    if (status == CLAST_OK) {
        status = print(common, config, &s.assembly, &s.bed, &found);
    }
    findings_free(&found);
    subject_free(&s);
    return status;
}

static clast_status run(const cli_common *common, void *context)
{
    porosity_config *c = context;
    clast_run_folder *folder = NULL;
    clast_status status = cli_results_begin(common, common->output, &c->force, &folder);
    if (status == CLAST_OK) {
        status = (common->n_argument > 1 ? run_several : run_one)(common, c, folder);
    }
    clast_run_folder_destroy(folder);
    return status;
}

const cli_command cli_porosity = {
    .name = "porosity",
    .arguments = "RUN [RUN...]",
    .summary = "profile and bulk porosity of a bed, by true shapes or as published",
    .example = {"clast porosity bed/", "clast porosity bed/ --local --rings 10 -o porosity/",
                "clast porosity spheres.csv --bed cylinder:50mm"},
    .details =
        "RUN is a run's folder, its state.h5, or spheres: text, .xyz, LAMMPS dump, VTK points with "
        "columns\nx, y, z and radius or diameter (x_mm: metres), voro++ (id x y z, with "
        "--diameter; "
        "id x y z r), .xyzd.\n"
        "n(z) = 1 - solid volume / (area times layer); solid volumes are exact: spheres and\n"
        "ellipsoids in closed form, surfaces by integration over their cut triangles.\n"
        "The bed ends where n(z), from above, falls through --cut; bulk is the porosity between\n"
        "floor + trim and top - trim (Rettinger et al., section 4.4, eq. 16). As published:\n"
        "  cylinder  --method spheres                 periodic  --method spheres --trim 31.5mm\n"
        "Several RUNs are realisations of one bed: mean, deviation, 95 % interval of every "
        "number;\n"
        "-o FOLDER has them in means.csv, and the mean profile with its band (with --rings over "
        "the\n"
        "radius, too); tables of grains, pores and directions are written for one RUN alone.\n"
        "Runs of clast pack know their contact forces: stress (Love, Weber) between the same\n"
        "heights, and by height in stress_profile.csv.\n"
        "-o FOLDER (not the run's own) writes summary.json, manifest.json, profile.csv, "
        "profile.svg,\n"
        "fabric.csv (directions of contacts and grains), coordination.csv where contacts are "
        "known,\n"
        "local.csv with --local, radial.csv and .svg with --rings, pores.csv and .svg with "
        "--pores.",
    .fields = fields,
    .config_size = sizeof(porosity_config),
    .n_min = 1,
    .n_max = CLI_MOST_RUNS,
    .writes_folder = true,
    .run = run,
};
