// clast export: a run's state to the files that other programs read.
#include "command.h"
#include "idle.h"
#include "json.h"
#include "lengths.h"
#include "packing.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    int32_t level;
    bool points;
    int32_t colour;
    char *table, *unit;
    double density;
    char *columns, *diameter; ///< the second as typed: the file's unit says how to read it
} export_config;

#define FIELD(type, member) #member, .offset = offsetof(export_config, member), type
static const clast_field fields[] = {
    {FIELD(CLAST_FIELD_I32, level), 3, 0, 7, "-",
     "fineness of spheres and ellipsoids: 20 * 4^level triangles", NULL},
    {FIELD(CLAST_FIELD_BOOL, points), 0, 0, 1, "-",
     "VTU of a point a grain, with quaternion and scale, instead of surfaces", NULL},
    {FIELD(CLAST_FIELD_CHOICE, colour), 0, 0, 3, "-", "what colours the grains of a PLY",
     "grain|order|size|shape"},
    {FIELD(CLAST_FIELD_TEXT, table), 0, 0, 0, "-",
     "write this table of the run (.csv or .json) instead of its grains", ""},
    {FIELD(CLAST_FIELD_TEXT, unit), 0, 0, 0, "-",
     "length unit of the coordinates in .stl, .obj and .ply; none: mm, as 3MF has it", ""},
    {FIELD(CLAST_FIELD_F64, density), 0, 0, 1e6, "kg/m^3",
     "of all grains of another program's file that gives none; 0: not known, left out", NULL},
    {FIELD(CLAST_FIELD_TEXT, columns), 0, 0, 0, "-",
     "spheres of another program: what its columns are, all of them, such as id,x,y,z,d (- passes "
     "one over); none: by their names",
     ""},
    {FIELD(CLAST_FIELD_TEXT, diameter), 0, 0, 0, "-",
     "spheres of another program: diameter of all, instead of the file's; 0: the file's", "0"},
    {0},
};
#undef FIELD

/// Options that no file of this name, no table and, once they are known, no such grains look at.
static clast_status check_idle(const cli_common *common, const export_config *c, bool is_run,
                               const clast_assembly *assembly)
{
    const clast_export_given given = {.format = clast_export_format_of_path(common->output),
                                      .has_table = c->table[0] != '\0',
                                      .is_run = is_run,
                                      .points = c->points,
                                      .assembly = assembly};
    clast_idle rules[CLAST_N_IDLE];
    return cli_idle_check(fields, c, clast_export_given_idle(&given, rules));
}

static clast_status report_table(const cli_common *common, const clast_table *table)
{
    if (!common->json) {
        (void)printf("%s: table %s, %lld rows of %d columns\n", cli_name(common->output),
                     table->name, (long long)table->n_row, table->n_column);
        return CLAST_OK;
    }
    json_t *object = json_object();
    cli_json_text(object, "file", common->output);
    cli_json_text(object, "table", table->name);
    cli_json_count(object, "n_row", table->n_row);
    cli_json_count(object, "n_column", table->n_column);
    return cli_print_json(object);
}

static clast_status export_table(const cli_common *common, const char *state, const char *name)
{
    clast_table table = {0};
    const clast_export_format format = clast_export_format_of_path(common->output);
    if (format != CLAST_EXPORT_CSV && format != CLAST_EXPORT_JSON) {
        return cli_fail(CLAST_E_USAGE, "%s: a table is written as .csv or .json", common->output);
    }
    clast_status status = CLAST_OK;
    CLI_TRY(clast_state_read_table(state, name, &table));
    CLI_TRY(format == CLAST_EXPORT_CSV ? clast_table_write_csv(&table, common->output)
                                       : clast_table_write_json(&table, common->output));
    CLI_TRY(report_table(common, &table));
done:
    clast_table_free(&table);
    return status;
}

/// What the file's bodies hold of the grains' volume, where that is not all.
static void tell_ratios(const clast_export_report *report)
{
    const double facets = 100.0 * (1.0 - report->facet_ratio);
    if (facets >= 5e-4) {
        (void)printf("facets of spheres and ellipsoids hold %.2g %% less volume than they do, and "
                     "touching ones part (finer: --level)\n",
                     facets);
    }
    if (isfinite(report->clump_ratio)) {
        const double high = 100.0 * (report->clump_ratio - 1.0);
        (void)printf("clumps are whole balls, one in another where they overlap: their facets hold "
                     "%.2g %% %s volume than they do\n",
                     fabs(high), high < 0.0 ? "less" : "more");
    }
    if (isfinite(report->ellipsoid_ratio)) {
        (void)printf("ellipsoids of the moments of surfaces and clumps: %.1f %% of their volume, "
                     "of a density that gives each the mass and inertia of its grain\n",
                     100.0 * report->ellipsoid_ratio);
    }
}

/// What is exported.
typedef struct {
    clast_assembly assembly;
    clast_packing_report read; ///< of another program's file; step and box of a run
    bool is_run;
} bed;

/// Whether the ids are those that the grains had in another program's file.
static void tell_ids(const cli_common *common, const bed *b, const clast_export_report *report)
{
    if (b->is_run || !report->has_ids) {
        return;
    }
    if (!report->ids_kept) {
        (void)printf("ids are new: counted from %d in the order of %s\n", report->id_offset,
                     cli_name(common->argument[0]));
    } else if (report->id_offset > 0) {
        (void)printf("ids are those of %s plus 1: LAMMPS and voro++ count from 1\n",
                     cli_name(common->argument[0]));
    }
}

static clast_status report_assembly(const cli_common *common, const bed *b,
                                    const clast_export_report *report)
{
    const clast_assembly *assembly = &b->assembly;
    if (!common->json) {
        (void)printf("%s: %s of %d grain%s", cli_name(common->output),
                     clast_export_format_name(report->format), assembly->n_grain,
                     cli_plural(assembly->n_grain));
        if (report->n_triangle > 0) {
            (void)printf(", %lld triangles", (long long)report->n_triangle);
        }
        (void)printf(", lengths in %s\n", report->unit);
        tell_ratios(report);
        tell_ids(common, b, report);
        return CLAST_OK;
    }
    json_t *object = json_object();
    cli_json_text(object, "file", common->output);
    cli_json_text(object, "format", clast_export_format_name(report->format));
    cli_json_text(object, "unit", report->unit);
    cli_json_count(object, "n_grain", assembly->n_grain);
    cli_json_count(object, "n_shape", assembly->n_shape);
    cli_json_count(object, "n_vertex", report->n_vertex);
    cli_json_count(object, "n_triangle", report->n_triangle);
    cli_json_number(object, "facet_ratio", report->facet_ratio);
    cli_json_number(object, "clump_ratio", report->clump_ratio);
    cli_json_number(object, "ellipsoid_ratio", report->ellipsoid_ratio);
    cli_json_bool(object, "ids_kept", report->ids_kept);
    cli_json_count(object, "id_offset", report->id_offset);
    cli_packing_json(object, &b->read);
    return cli_print_json(object);
}

/// Surfaces without a unit of their own are in mm, as printers take them; NULL: the run's.
static const char *unit_of(const export_config *config, clast_export_format format,
                           const clast_assembly *assembly)
{
    const bool is_bare =
        format == CLAST_EXPORT_STL || format == CLAST_EXPORT_OBJ || format == CLAST_EXPORT_PLY;
    const bool is_known = assembly->unit[0] != '\0' && strcmp(assembly->unit, "model") != 0;
    return config->unit[0] != '\0' ? config->unit : is_bare && is_known ? "mm" : NULL;
}

/// Densities of grains that came without any.
static clast_status set_density(double density, bool is_state, clast_assembly *a)
{
    if (density > 0.0 && !a->no_density) {
        return cli_fail(CLAST_E_USAGE, "density is the %s's own; leave it out",
                        is_state ? "state" : "file");
    }
    for (int32_t i = 0; i < a->n_grain && density > 0.0; ++i) {
        a->density[i] = density;
        a->no_density = false;
    }
    return CLAST_OK;
}

/// A run's grains, or those of another program's file.
static clast_status read_grains(const cli_common *common, const char *path,
                                const export_config *config, bed *b)
{
    clast_packing_options options = {.columns = config->columns};
    const size_t n = strlen(path);
    const bool is_state = n >= 3 && strcmp(path + n - 3, ".h5") == 0;
    b->is_run = is_state;
    if (is_state) {
        CLI_GUARD(check_idle(common, config, true, NULL));
        CLI_GUARD(clast_state_read_assembly(path, &b->assembly));
        CLI_GUARD(clast_state_read_frame(path, &b->read.frame));
    } else {
        CLI_GUARD(clast_unit_parse(config->diameter, "m", &options.diameter));
        CLI_GUARD(clast_packing_read(path, &options, &b->assembly, &b->read));
        CLI_GUARD(cli_read_length("diameter", config->diameter, b->assembly.unit,
                                  &options.diameter)); // of the file's unit, now that it is known
        cli_packing_note(common, path, &b->read);
    }
    return set_density(config->density, is_state, &b->assembly);
}

static clast_status export_assembly(const cli_common *common, const char *state,
                                    const export_config *config)
{
    bed b = {.read = {.frame = {.step = -1}}};
    clast_export_report report = {0};
    clast_export_options options = {
        .level = config->level, .points = config->points, .colour = (clast_colour)config->colour};
    clast_status status = CLAST_OK;
    CLI_TRY(read_grains(common, state, config, &b));
    CLI_TRY(check_idle(common, config, false, &b.assembly));
    options.unit = unit_of(config, clast_export_format_of_path(common->output), &b.assembly);
    options.frame = &b.read.frame;
    CLI_TRY(clast_assembly_write(&b.assembly, common->output, &options, &report));
    CLI_TRY(report_assembly(common, &b, &report));
done:
    clast_assembly_free(&b.assembly);
    return status;
}

static clast_status run(const cli_common *common, void *context)
{
    const export_config *config = context;
    char state[CLAST_RUN_PATH];
    if (common->output == NULL) {
        return cli_fail(CLAST_E_USAGE, "where to? give -o NAME.3mf (or .stl, .obj, .ply, .vtu, "
                                       ".csv, .json, .dump, .data, .txt, .voro, .xyzd, .conf)");
    }
    if (clast_export_format_of_path(common->output) == CLAST_EXPORT_ANY) {
        return cli_fail(CLAST_E_USAGE,
                        "%s: no export by that name; write .vtu, .stl, .obj, .ply, .3mf, .csv, "
                        ".json, .dump, .data, .txt, .voro, .xyzd or .conf",
                        common->output);
    }
    CLI_GUARD(check_idle(common, config, false, NULL));
    CLI_GUARD(clast_run_folder_state(common->argument[0], state));
    return config->table[0] != '\0' ? export_table(common, state, config->table)
                                    : export_assembly(common, state, config);
}

const cli_command cli_export = {
    .name = "export",
    .arguments = "RUN",
    .summary = "a run's grains as 3MF, STL, OBJ, PLY, VTU, CSV, LAMMPS, YADE, Rockable",
    .example = {"clast export run/ -o grains.vtu", "clast export run/ -o grains.3mf --level 4",
                "clast export run/ --table history -o history.json"},
    .details =
        "RUN is a run's folder, its state.h5, or another program's packing as clast porosity "
        "reads\n"
        "it. The output's name sets the format:\n"
        "  .3mf   for printers: names its unit, mm\n"
        "  .stl   binary, all grains; .obj a group a grain; .ply grain and colour a face: in mm,\n"
        "         or as --unit says; the unit stands in the file's header\n"
        "  .vtu   ParaView: surfaces with grain, order, shape and size, or --points\n"
        "  .csv   a row a grain: pose, scale, length, volume, density, mass, contacts\n"
        "  .json  the same table\n"
        "  .dump  LAMMPS: ellipsoids of equal moments and mass (OVITO shows them); .data its "
        "input\n"
        "  .txt   YADE: x y z r, spheres and clumps; .voro voro++; .xyzd: spheres\n"
        "  .conf  Rockable: spheres and convex surfaces, whose shapes go into the .shp beside\n"
        "Other lengths are in the run's unit (m); --table NAME writes a table of the run. "
        "Densities\n"
        "that a file of another program does not give are left out, or given by --density.",
    .fields = fields,
    .config_size = sizeof(export_config),
    .n_min = 1,
    .n_max = 1,
    .needs_file = true,
    .run = run,
};
