// clast porosity: profile and bulk porosity of any assembly.
#include "bed_runs.h"
#include "command.h"
#include "json.h"
#include "lengths.h"
#include "packing.h"
#include "porosity_findings.h"
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
    char *floor, *layer, *trim, *gap, *diameter,
        *fields; ///< as typed: the run's unit says how to read them
    int32_t method;
    double cut;
    bool at_slice, local, chains;
    int32_t rings;
    double core;
    int64_t pores;
    char *columns;
    bool force;
} porosity_config;

/// A run that is measured, {0}: none yet.
typedef struct {
    clast_assembly assembly;
    clast_bed bed, own;              ///< what is measured: the run's own, or given
    clast_mesh surface, own_surface; ///< of each, or empty
    clast_table contacts;            ///< forces, without columns where the run does not know them
    clast_table velocities;          ///< likewise
    clast_packing_report report;     ///< of another program's file
    bool has_own;                    ///< else `own` is nothing
    clast_bed_findings found;
} measured_run;

static void free_run(measured_run *s)
{
    clast_bed_findings_free(&s->found);
    clast_assembly_free(&s->assembly);
    clast_mesh_free(&s->surface);
    clast_mesh_free(&s->own_surface);
    clast_table_free(&s->contacts);
    clast_table_free(&s->velocities);
}

#define FIELD(type, member) #member, .offset = offsetof(porosity_config, member), type
static const clast_field fields[] = {
    {FIELD(CLAST_FIELD_TEXT, bed), 0, 0, 0, "-",
     "container: cylinder:RADIUS[,X,Y], box:X0,Y0,X1,Y1, periodic:X0,Y0,X1,Y1 (x and y), "
     "periodic:X0,Y0,Z0,X1,Y1,Z1[,SHIFT] (all directions; images above lie farther along x by "
     "SHIFT) or mesh:FILE,UNIT (m where the grains' lengths have no unit); none: the run's",
     "", .group = "bed and container", .common = true},
    {FIELD(CLAST_FIELD_TEXT, floor), 0, 0, 0, "-", "height of the bottom, with --bed (as 5mm)",
     "0"},
    {FIELD(CLAST_FIELD_CHOICE, method), CLAST_POROSITY_EXACT, 0, 1, "-",
     "what a grain fills: its true shape, or the sphere of its volume (published)", "exact|spheres",
     .group = "bulk porosity", .common = true},
    {FIELD(CLAST_FIELD_TEXT, layer), 0, 0, 0, "-",
     "height of a slice (as 1mm); 0: 1 mm as published, or a tenth of the mean diameter where that "
     "is below 1 mm, or of a run without unit, whose lengths are bare numbers here too",
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
     "sizes of pores too, from this many quasi-random points of the bed", NULL, .common = true},
    {FIELD(CLAST_FIELD_TEXT, fields), 0, 0, 0, "-",
     "coarse-grained density, velocity and stress too (fields.vti, .csv), by a Gaussian this wide "
     "(its standard deviation, as 3mm), in cells as wide; 0: not",
     "0", .common = true},
    {FIELD(CLAST_FIELD_BOOL, chains), 0, 0, 1, "-",
     "force chains too (chains.vtp, .csv, .svg), of runs that know their forces", NULL,
     .common = true},
    {FIELD(CLAST_FIELD_TEXT, columns), 0, 0, 0, "-",
     "spheres: what the file's columns are, all of them, such as id,x,y,z,d (x, y, z, r or d; "
     "others and - are passed over); none: by their names",
     ""},
    {FIELD(CLAST_FIELD_TEXT, diameter), 0, 0, 0, "-",
     "spheres: diameter of all, instead of the file's; 0: the file's", "0"},
    CLI_FORCE(porosity_config),
    {0},
};
#undef FIELD

static bool ends_with(const char *text, const char *end)
{
    const size_t n = strlen(text);
    const size_t m = strlen(end);
    return n >= m && strcmp(text + n - m, end) == 0;
}

/// The grains, and the run's own bed and contact forces where it has them.
static clast_status read_input(const cli_common *common, const char *input,
                               const porosity_config *config, measured_run *s)
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
        CLI_GUARD(clast_packing_read(path, &options, &s->assembly, &s->report));
        cli_packing_note(common, path, &s->report);
        if (s->assembly.no_density && strcmp(config->fields, "0") != 0) {
            (void)fprintf(stderr,
                          "clast porosity: %s: it gives no densities; the field of density is that "
                          "of grains of 1 kg/m^3\n",
                          cli_name(path));
        }
        return CLAST_OK;
    }
    if (config->columns[0] != '\0' || diameter > 0.0) {
        return cli_fail(CLAST_E_USAGE,
                        "%s is a run, which knows its grains: leave out --columns and "
                        "--diameter",
                        input);
    }
    CLI_GUARD(clast_state_read_assembly(path, &s->assembly));
    s->has_own = clast_bed_read(path, &s->own, &s->own_surface) == CLAST_OK;
    s->bed = s->own;
    (void)clast_state_read_table(path, "contacts", &s->contacts); // aggregates have none
    (void)clast_state_read_table(path, "velocities", &s->velocities);
    return CLAST_OK;
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
    for (int32_t i = 0; i < common->n_argument && run != NULL; ++i) {
        CLI_GUARD(clast_run_folder_state(common->argument[i], path));
        CLI_GUARD(clast_run_folder_input(run, "run", path));
    }
    bed_file(config->bed, path);
    const cli_input inputs[] = {{"bed", path}, {NULL, NULL}};
    return cli_results_open(run, fields, config, NULL, inputs);
}

/// Lengths as typed, in the run's unit.
static clast_status read_lengths(const porosity_config *config, const char *unit,
                                 clast_bed_options *out)
{
    double diameter; // has been read: its unit is looked at
    const struct {
        const char *name, *text;
        double *value;
    } wanted[] = {
        {"floor", config->floor, &out->floor},       {"layer", config->layer, &out->porosity.layer},
        {"trim", config->trim, &out->porosity.trim}, {"gap", config->gap, &out->gap},
        {"diameter", config->diameter, &diameter},   {"fields", config->fields, &out->fields}};
    for (size_t k = 0; k < sizeof wanted / sizeof wanted[0]; ++k) {
        CLI_GUARD(cli_read_length(wanted[k].name, wanted[k].text, unit, wanted[k].value));
    }
    return CLAST_OK;
}

/// Reads a run and measures it; where no layer is given, with that of another run (0: its own).
static clast_status measure_run(const cli_common *common, const char *input,
                                const porosity_config *config, double layer, measured_run *s)
{
    clast_bed_options options = {.porosity = {.method = (clast_porosity_method)config->method,
                                              .cut = config->cut,
                                              .at_slice = config->at_slice},
                                 .core = config->core,
                                 .local = config->local,
                                 .rings = config->rings,
                                 .pores = config->pores,
                                 .chains = config->chains};
    CLI_GUARD(read_input(common, input, config, s));
    CLI_GUARD(read_lengths(config, s->assembly.unit, &options));
    options.porosity.layer = options.porosity.layer == 0.0 ? layer : options.porosity.layer;
    if (config->bed[0] != '\0') {
        CLI_GUARD(cli_check_bed_lengths(config->bed, s->assembly.unit));
        CLI_GUARD(clast_bed_load(config->bed, &s->bed, &s->surface));
    } else if (!s->has_own) {
        return cli_fail(CLAST_E_USAGE,
                        "%s does not say what holds the grains; give --bed, such "
                        "as cylinder:52mm",
                        input);
    }
    const clast_bed_known known = {.bed = &s->bed,
                                   .is_own = config->bed[0] == '\0',
                                   .own = s->has_own ? &s->own : NULL,
                                   .contacts = &s->contacts,
                                   .velocities = &s->velocities};
    const clast_status status = clast_bed_measure(&s->assembly, &known, &options, &s->found);
    return status == CLAST_OK || common->n_argument == 1
               ? status
               : cli_fail(status, "%s: %s", input, clast_error_detail()); // which of them
}

/// The findings of run i join those of the runs before: the first gives the bed and the slices.
static clast_status gather_one(const cli_common *common, int32_t i, const porosity_config *config,
                               cli_bed_runs *runs, clast_bed_findings *first)
{
    const char *input = common->argument[i];
    measured_run s = {0};
    clast_status status = CLAST_OK;
    CLI_TRY(measure_run(common, input, config, first->options.porosity.layer, &s));
    if (i == 0) {
        *first = (clast_bed_findings){.bed = s.found.bed, .options = s.found.options};
    }
    CLI_CHECK(s.found.bed.kind == first->bed.kind, CLAST_E_USAGE,
              "%s and %s lie in containers of two kinds: they are no realisations of one bed",
              common->argument[0], input);
    CLI_CHECK(s.found.bed.is_part == first->bed.is_part, CLAST_E_USAGE,
              "--bed holds the grains of %s and is a part of the packing of %s: no realisations of "
              "one bed; give a greater or a smaller one",
              common->argument[first->bed.is_part ? i : 0],
              common->argument[first->bed.is_part ? 0 : i]);
    CLI_TRY(cli_bed_runs_add(runs, input, s.assembly.unit, cli_porosity_json(&s.assembly, &s.found),
                             &s.found.profile, &s.found.radial));
done:
    free_run(&s);
    return status;
}

/// Writes the summary; the object is dropped.
static clast_status write_summary(const clast_run_folder *run, json_t *object)
{
    const clast_status status = cli_results_summary(run, object);
    json_decref(object);
    return status;
}

static clast_status write_several(const cli_common *common, const porosity_config *config,
                                  const cli_bed_runs *runs, clast_run_folder *run)
{
    clast_status status = CLAST_OK;
    CLI_TRY(open_results(common, config, run));
    CLI_TRY(cli_bed_runs_write(runs, run));
    CLI_TRY(write_summary(run, cli_bed_runs_json(runs)));
done:
    return clast_run_folder_end(run, status);
}

/// One bed told twice is one realisation: its interval would be of no width.
static clast_status check_different(const cli_common *common)
{
    char(*hash)[65] = calloc((size_t)common->n_argument, sizeof *hash);
    clast_status status = CLAST_OK;
    CLI_CHECK(hash != NULL, CLAST_E_MEMORY, "no memory for the digests of the runs");
    for (int32_t i = 0; i < common->n_argument; ++i) {
        char path[CLAST_RUN_PATH];
        int64_t n = 0;
        CLI_TRY(clast_run_folder_state(common->argument[i], path));
        CLI_TRY(clast_sha256_file(path, hash[i], &n));
        for (int32_t k = 0; k < i; ++k) {
            CLI_CHECK(strcmp(hash[k], hash[i]) != 0, CLAST_E_USAGE,
                      "%s and %s hold the same bytes: one realisation, not two",
                      common->argument[k], common->argument[i]);
        }
    }
done:
    free(hash);
    return status;
}

static clast_status run_several(const cli_common *common, const porosity_config *config,
                                clast_run_folder *run)
{
    cli_bed_runs runs = {0};
    clast_bed_findings first = {0};
    clast_status status = CLAST_OK;
    CLI_TRY(check_different(common));
    for (int32_t i = 0; i < common->n_argument; ++i) {
        CLI_TRY(gather_one(common, i, config, &runs, &first));
    }
    if (run != NULL) {
        CLI_TRY(write_several(common, config, &runs, run));
    }
    CLI_TRY(common->json ? cli_print_json(cli_bed_runs_json(&runs)) : cli_bed_runs_print(&runs));
done:
    cli_bed_runs_free(&runs);
    return status;
}

static clast_status write_one(const cli_common *common, const porosity_config *config,
                              measured_run *s, clast_run_folder *run)
{
    clast_status status = CLAST_OK;
    CLI_TRY(open_results(common, config, run));
    CLI_TRY(cli_porosity_files(run, &s->assembly, &s->found));
    json_t *object = cli_porosity_json(&s->assembly, &s->found);
    cli_packing_json(object, &s->report);
    CLI_TRY(write_summary(run, object));
done:
    return clast_run_folder_end(run, status);
}

static clast_status run_one(const cli_common *common, const porosity_config *config,
                            clast_run_folder *run)
{
    measured_run s = {0};
    clast_status status = CLAST_OK;
    CLI_TRY(measure_run(common, common->argument[0], config, 0.0, &s));
    if (run != NULL) {
        CLI_TRY(write_one(common, config, &s, run));
    }
    CLI_TRY(cli_porosity_print(common, &s.assembly, &s.found, &s.report));
done:
    free_run(&s);
    return status;
}

static clast_status run(const cli_common *common, void *context)
{
    porosity_config *c = context;
    clast_run_folder *folder = NULL;
    clast_status status = CLAST_OK;
    CLI_TRY(cli_results_begin(common, common->output, &c->force, &folder));
    CLI_TRY((common->n_argument > 1 ? run_several : run_one)(common, c, folder));
done:
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
        "--pores,\nfields.csv and .vti with --fields, chains.csv, .vtp and .svg with --chains.",
    .fields = fields,
    .config_size = sizeof(porosity_config),
    .n_min = 1,
    .n_max = CLI_MOST_RUNS,
    .writes_folder = true,
    .run = run,
};
