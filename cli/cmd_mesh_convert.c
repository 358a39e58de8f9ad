// clast mesh convert: a surface from one format to another, in another unit if wanted.
#include "command.h"
#include "idle.h"
#include "json.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

typedef struct {
    char *unit, *out_unit, *name;
    double scale;
} convert_config;

#define FIELD(type, member) #member, .offset = offsetof(convert_config, member), type
static const clast_field fields[] = {
    {FIELD(CLAST_FIELD_TEXT, unit), 0, 0, 0, "-",
     "length unit of the input's coordinates; that of its header when clast wrote one", ""},
    {FIELD(CLAST_FIELD_TEXT, out_unit), 0, 0, 0, "-",
     "unit of the output's coordinates; that of the input when not given", ""},
    {FIELD(CLAST_FIELD_F64, scale), 1.0, 1e-100, 1e100, "-", "factor on all lengths", NULL},
    {FIELD(CLAST_FIELD_TEXT, name), 0, 0, 0, "-", "name of the part, written in an STL, OBJ or 3MF",
     ""},
    {0},
};
#undef FIELD

typedef struct {
    const char *input, *output;
    const char *unit, *out_unit; ///< NULL: not known
    clast_mesh mesh;
    clast_mesh_read_report report;
    clast_mesh_format out_format;
    double factor;
} job;

/// Output coordinates per input coordinate.
static clast_status find_factor(const convert_config *config, job *j)
{
    double in = 1.0;
    double out = 1.0;
    const char *own = j->report.unit[0] != '\0' ? j->report.unit : NULL;
    const char *unit = config->unit[0] != '\0' ? config->unit : own;
    j->unit = unit;
    j->out_unit = config->out_unit[0] != '\0' ? config->out_unit : unit;
    j->factor = config->scale;
    if (unit == NULL && j->out_unit != NULL) {
        return cli_fail(CLAST_E_USAGE, "--out-unit %s needs --unit, the unit of %s", j->out_unit,
                        j->input);
    }
    if (unit == NULL && j->out_format == CLAST_MESH_3MF) {
        return cli_fail(CLAST_E_USAGE, "3MF is in millimetres: give --unit, the unit of %s",
                        j->input);
    }
    if (j->out_format == CLAST_MESH_3MF) {
        if (config->out_unit[0] != '\0' && strcmp(config->out_unit, "mm") != 0) {
            return cli_fail(CLAST_E_USAGE, "--out-unit %s: 3MF is in millimetres",
                            config->out_unit);
        }
        j->out_unit = "mm";
    }
    if (unit != NULL) {
        CLI_GUARD(clast_mesh_require_unit(j->input, &j->report, unit));
        CLI_GUARD(clast_unit_factor(unit, "m", &in));
        CLI_GUARD(clast_unit_factor(j->out_unit, "m", &out));
        j->factor *= strcmp(unit, j->out_unit) == 0 ? 1.0 : in / out;
    }
    return CLAST_OK;
}

static clast_status check_job(const cli_common *common, const convert_config *config, job *j)
{
    if (common->output == NULL) {
        return cli_fail(CLAST_E_USAGE, "where to? give -o NAME.stl (or .obj, .ply, .off, .3mf)");
    }
    j->input = common->argument[0];
    j->output = common->output;
    j->out_format = clast_mesh_format_of_path(j->output);
    if (j->out_format == CLAST_MESH_ANY) {
        return cli_fail(CLAST_E_USAGE,
                        "%s: no surface format by that name; write .stl, .obj, .ply, .off or .3mf",
                        j->output);
    }
    clast_idle rules[CLAST_N_IDLE];
    return cli_idle_check(fields, config, clast_mesh_write_idle(j->out_format, rules));
}

static clast_status check_surface(const job *j)
{
    const bool keeps_points =
        j->out_format != CLAST_MESH_STL && j->out_format != CLAST_MESH_3MF && j->mesh.n_vert > 0;
    if (j->mesh.n_tri > 0 || keeps_points) {
        return CLAST_OK;
    }
    return cli_fail(CLAST_E_GEOMETRY, "%s has %d points and no triangles: nothing to write as %s",
                    j->input, j->mesh.n_vert, clast_mesh_format_name(j->out_format));
}

/// Greatest change of a coordinate by the 24 bits that STL keeps, as a part of the extent.
static double rounding(const clast_mesh *mesh)
{
    double worst = 0.0;
    double extent = 0.0;
    double low[3];
    double high[3];
    clast_mesh_bounds(mesh, low, high);
    for (int k = 0; k < 3; ++k) {
        extent = fmax(extent, high[k] - low[k]);
    }
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        for (int k = 0; k < 3; ++k) {
            const double x = mesh->vert[i][k];
            worst = fmax(worst, fabs(x - (double)(float)x));
        }
    }
    return extent > 0.0 ? worst / extent : 0.0;
}

/// What the output loses, as one more warning.
static void warn_of_loss(job *j)
{
    clast_mesh_read_report *r = &j->report;
    const double part = j->out_format == CLAST_MESH_STL ? rounding(&j->mesh) : 0.0;
    if (part > 1e-6 && r->n_warning < CLAST_MESH_N_WARNING) {
        (void)snprintf(r->warning[r->n_warning++], CLAST_MESH_WARNING_SIZE,
                       "STL keeps 24 bits: coordinates move by up to %.2g of the extent; move the "
                       "surface near the origin or write PLY",
                       part);
    }
}

/// Facets that 24 bits folded are not in the STL: by its size, which is what a reader will find.
static void warn_of_folded(job *j)
{
    struct stat file;
    clast_mesh_read_report *r = &j->report;
    if (j->out_format != CLAST_MESH_STL || stat(j->output, &file) != 0 ||
        r->n_warning == CLAST_MESH_N_WARNING) {
        return;
    }
    const long long n = j->mesh.n_tri - ((long long)file.st_size - 84) / 50;
    if (n > 0) {
        (void)snprintf(
            r->warning[r->n_warning++], CLAST_MESH_WARNING_SIZE,
            "%lld triangles have two corners that are one in the 24 bits of STL and were "
            "left out; write PLY to keep them",
            n);
    }
}

static clast_status print_json(const job *j)
{
    const clast_mesh_read_report *r = &j->report;
    json_t *o = json_object();
    json_t *warnings = json_array();
    for (int32_t i = 0; i < r->n_warning; ++i) {
        (void)json_array_append_new(warnings, json_string(r->warning[i]));
    }
    cli_json_text(o, "file", j->input);
    cli_json_text(o, "format", clast_mesh_format_name(r->format));
    cli_json_bool(o, "binary", r->is_binary);
    cli_json_count(o, "n_part", r->n_part);
    cli_json_count(o, "n_vertex", j->mesh.n_vert);
    cli_json_count(o, "n_triangle", j->mesh.n_tri);
    cli_json_count(o, "n_facet", r->n_facet);
    cli_json_count(o, "n_polygon", r->n_polygon);
    cli_json_count(o, "n_concave", r->n_concave);
    cli_json_count(o, "n_zero_normal", r->n_zero_normal);
    cli_json_count(o, "n_wrong_normal", r->n_wrong_normal);
    cli_json_text(o, "unit", j->unit != NULL ? j->unit : "model");
    cli_json_text(o, "out_unit", j->out_unit != NULL ? j->out_unit : "model");
    cli_json_number(o, "factor", j->factor);
    cli_json_text(o, "output", j->output);
    cli_json_text(o, "output_format", clast_mesh_format_name(j->out_format));
    (void)json_object_set_new(o, "warnings", warnings);
    return cli_print_json(o);
}

static clast_status print_text(const job *j)
{
    const clast_mesh_read_report *r = &j->report;
    (void)printf("%s: %s%s, %d vertices, %d triangles", cli_name(j->input),
                 r->is_binary ? "binary " : "", clast_mesh_format_name(r->format), j->mesh.n_vert,
                 j->mesh.n_tri);
    if (r->n_polygon > 0) {
        (void)printf(" (from %lld faces, %d of them concave)", (long long)r->n_facet, r->n_concave);
    }
    (void)printf("\n%s: %s", cli_name(j->output), clast_mesh_format_name(j->out_format));
    if (j->out_unit != NULL) {
        (void)printf(" in %s", j->out_unit);
    }
    if (j->out_unit == NULL) {
        (void)printf(" in model units (--unit names them in the file)");
    }
    if (j->factor != 1.0) {
        (void)printf(", lengths times %.9g", j->factor);
    }
    (void)putchar('\n');
    for (int32_t i = 0; i < r->n_warning; ++i) {
        (void)fprintf(stderr, "clast mesh convert: %s: %s\n", cli_name(j->input), r->warning[i]);
    }
    return CLAST_OK;
}

static clast_status run(const cli_common *common, void *context)
{
    static const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    static const double unmoved[3] = {0.0, 0.0, 0.0};
    const convert_config *config = context;
    job j = {0};
    clast_status status = CLAST_OK;
    CLI_TRY(check_job(common, config, &j));
    CLI_TRY(clast_mesh_read(j.input, &j.mesh, &j.report));
    CLI_TRY(find_factor(config, &j));
    CLI_TRY(check_surface(&j));
    if (j.factor != 1.0) {
        clast_mesh_transform(&j.mesh, j.factor, unturned, unmoved);
    }
    warn_of_loss(&j);
    CLI_TRY(clast_mesh_write(
        &j.mesh, j.output,
        &(clast_mesh_write_options){.unit = j.out_unit,
                                    .name = config->name[0] != '\0' ? config->name : NULL}));
    warn_of_folded(&j);
    CLI_TRY(common->json ? print_json(&j) : print_text(&j));
done:
    clast_mesh_free(&j.mesh);
    return status;
}

const cli_command cli_mesh_convert = {
    .name = "mesh convert",
    .arguments = "FILE",
    .summary = "read a surface (STL, OBJ, PLY, OFF), write it as one of these or 3MF",
    .example = {"clast mesh convert data/standin63/grain00.ply -o grain.stl",
                "clast mesh convert data/standin63/grain00.ply --scale 2 -o large.obj",
                "clast mesh convert scan.stl --unit um --out-unit mm -o scan.3mf"},
    .details =
        "The format of FILE is found by its content, that of the output by its name. STL is\n"
        "written in binary with 24-bit coordinates; OBJ, PLY and OFF keep every bit; 3MF is\n"
        "in millimetres and needs --unit. Vertices of an STL that are equal bit by bit are\n"
        "one; nothing else is repaired: see clast mesh check and clast mesh repair.",
    .fields = fields,
    .config_size = sizeof(convert_config),
    .n_min = 1,
    .n_max = 1,
    .needs_file = true,
    .run = run,
};
