// clast export: a run's state to the files that other programs read.
#include "command.h"
#include "json.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

typedef struct {
    int32_t level;
    bool points;
    int32_t colour;
    char *table;
} export_config;

#define FIELD(type, member) #member, offsetof(export_config, member), type
static const clast_field fields[] = {
    {FIELD(CLAST_FIELD_I32, level), 3, 0, 7, "-",
     "fineness of spheres and ellipsoids: 20 * 4^level triangles", NULL},
    {FIELD(CLAST_FIELD_BOOL, points), 0, 0, 1, "-",
     "VTU of a point a grain, with quaternion and scale, instead of surfaces", NULL},
    {FIELD(CLAST_FIELD_CHOICE, colour), 0, 0, 3, "-", "what colours the grains of a PLY",
     "grain|order|size|shape"},
    {FIELD(CLAST_FIELD_TEXT, table), 0, 0, 0, "-",
     "write this table of the run (.csv or .json) instead of its grains", ""},
    {0},
};
#undef FIELD

/// RUN is a state file or a folder that holds state.h5; what is not there is found by reading it.
static clast_status find_state(const char *run, char *path, size_t size)
{
    struct stat info;
    const bool is_folder = stat(run, &info) == 0 && S_ISDIR(info.st_mode);
    const int n = snprintf(path, size, is_folder ? "%s/state.h5" : "%s", run);
    return n > 0 && (size_t)n < size ? CLAST_OK
                                     : cli_fail(CLAST_E_IO, "%s: the path is too long", run);
}

static clast_status report_table(const cli_common *common, const clast_table *table)
{
    if (!common->json) {
        (void)printf("%s: table %s, %lld rows of %d columns\n", common->output, table->name,
                     (long long)table->n_row, table->n_column);
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
    clast_status status = clast_state_read_table(state, name, &table);
    if (status == CLAST_OK) {
        status = format == CLAST_EXPORT_CSV ? clast_table_write_csv(&table, common->output)
                                            : clast_table_write_json(&table, common->output);
    }
    if (status == CLAST_OK) {
        status = report_table(common, &table);
    }
    clast_table_free(&table);
    return status;
}

static clast_status report_assembly(const cli_common *common, const clast_assembly *assembly,
                                    const clast_export_report *report)
{
    if (!common->json) {
        (void)printf("%s: %s of %d grains", common->output,
                     clast_export_format_name(report->format), assembly->n_grain);
        if (report->n_triangle > 0) {
            (void)printf(", %lld triangles", (long long)report->n_triangle);
        }
        (void)putchar('\n');
        return CLAST_OK;
    }
    json_t *object = json_object();
    cli_json_text(object, "file", common->output);
    cli_json_text(object, "format", clast_export_format_name(report->format));
    cli_json_text(object, "unit", assembly->unit);
    cli_json_count(object, "n_grain", assembly->n_grain);
    cli_json_count(object, "n_shape", assembly->n_shape);
    cli_json_count(object, "n_vertex", report->n_vertex);
    cli_json_count(object, "n_triangle", report->n_triangle);
    return cli_print_json(object);
}

static clast_status export_assembly(const cli_common *common, const char *state,
                                    const export_config *config)
{
    clast_assembly assembly = {0};
    clast_export_report report = {0};
    const clast_export_options options = {
        .level = config->level, .points = config->points, .colour = (clast_colour)config->colour};
    clast_status status = clast_state_read_assembly(state, &assembly);
    if (status == CLAST_OK) {
        status = clast_assembly_write(&assembly, common->output, &options, &report);
    }
    if (status == CLAST_OK) {
        status = report_assembly(common, &assembly, &report);
    }
    clast_assembly_free(&assembly);
    return status;
}

static clast_status run(const cli_common *common, void *context)
{
    const export_config *config = context;
    char state[4096];
    if (common->output == NULL) {
        return cli_fail(CLAST_E_USAGE, "where to? give -o NAME.vtu (or .stl, .obj, .ply, .3mf, "
                                       ".csv, .json, .dump)");
    }
    if (clast_export_format_of_path(common->output) == CLAST_EXPORT_ANY) {
        return cli_fail(CLAST_E_USAGE,
                        "%s: no export by that name; write .vtu, .stl, .obj, .ply, .3mf, .csv, "
                        ".json or .dump",
                        common->output);
    }
    const clast_status status = find_state(common->argument[0], state, sizeof state);
    if (status != CLAST_OK) {
        return status;
    }
    return config->table[0] != '\0' ? export_table(common, state, config->table)
                                    : export_assembly(common, state, config);
}

const cli_command cli_export = {
    .name = "export",
    .arguments = "RUN",
    .summary = "write a run's grains (-o) as VTU, STL, OBJ, PLY, 3MF, CSV, JSON or LAMMPS dump",
    .details = "RUN is a run's folder or its state.h5. The output's name tells the format:\n"
               "  .vtu   ParaView: surfaces with grain, order, shape and size, or --points\n"
               "  .stl   binary, all grains; .obj a group a grain; .ply grain and colour a face\n"
               "  .3mf   for printers, in millimetres\n"
               "  .csv   a row a grain: pose, scale, length, volume, density, mass, contacts\n"
               "  .json  the same table\n"
               "  .dump  LAMMPS: ellipsoids of equal volume and moments (OVITO shows them)\n"
               "Coordinates are in the run's unit; --table NAME writes a table of the run.",
    .fields = fields,
    .config_size = sizeof(export_config),
    .n_min = 1,
    .n_max = 1,
    .run = run,
};
