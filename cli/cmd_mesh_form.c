// clast mesh form: a grain in its principal frame, stretched to a wanted form and size.
#include "command.h"
#include "mesh_words.h"

#include <clast/form.h>
#include <clast/mesh.h>
#include <clast/mesh_repair.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    double flatness, elongation;
    char *size; ///< as typed: the file's unit says how to read it
    bool unit_form;
    int32_t hull;
} form_config;

#define FIELD(name) #name, .offset = offsetof(form_config, name)
static const clast_field form_fields[] = {
    {FIELD(flatness), CLAST_FIELD_F64, 0.0, 0.0, 1.0, "-", "wanted S/I; 0: the grain's own", NULL},
    {FIELD(elongation), CLAST_FIELD_F64, 0.0, 0.0, 1.0, "-", "wanted I/L; 0: the grain's own",
     NULL},
    {FIELD(size), CLAST_FIELD_TEXT, 0, 0, 0, "-",
     "wanted sieve size D = sqrt((S^2+I^2)/2) in the unit of the file, or with its own where the "
     "file has one; 0: the grain's own",
     "0"},
    {FIELD(unit_form), CLAST_FIELD_BOOL, 0, 0, 0, "-", "take all form off: L = I = S = 1", NULL},
    {FIELD(hull), CLAST_FIELD_I32, 0, 0, 1e6, "-",
     "take the convex hull first, with at most so many triangles; 0: the surface itself", NULL},
    {0}};
#undef FIELD

/// Axes and volumes of the surface, of what is stretched (its hull, or itself) and after; NaN of a
/// surface under a hull that bounds no solid.
typedef struct {
    double before[3], own[3], after[3];
    double volume_before, volume_own, volume_after;
    int32_t n_before, n_after;
    bool is_hull;
    const char *why; ///< before is NaN
} form_report;

static clast_status check_config(const form_config *c)
{
    if (c->unit_form && (c->flatness > 0.0 || c->elongation > 0.0 || strcmp(c->size, "0") != 0)) {
        return cli_fail(CLAST_E_USAGE,
                        "unit_form makes L = I = S = 1; leave flatness, elongation and size out");
    }
    if (c->hull > 0 && c->hull < 4) {
        return cli_fail(CLAST_E_USAGE, "hull: a solid has 4 faces or more, not %d", c->hull);
    }
    return CLAST_OK;
}

static void wanted_lengths(const form_config *c, double size, const double own[3], double lis[3])
{
    if (c->unit_form) {
        lis[0] = lis[1] = lis[2] = 1.0;
        return;
    }
    const double flatness = c->flatness > 0.0 ? c->flatness : own[2] / own[1];
    const double elongation = c->elongation > 0.0 ? c->elongation : own[1] / own[0];
    const double own_size = clast_form_sieve_size(own[1], own[2]);
    clast_form_lengths(flatness, elongation, size > 0.0 ? size : own_size, lis);
}

/// What the surface itself is: its hull stands for it where there is one.
static clast_status measure_surface(const clast_mesh *mesh, form_report *r)
{
    clast_mesh turned = {0};
    for (int k = 0; k < 3; ++k) {
        r->before[k] = r->is_hull ? (double)NAN : r->own[k];
    }
    r->volume_before = r->volume_own;
    if (r->is_hull) {
        CLI_GUARD(cli_solid_volume(mesh, &r->volume_before, &r->why));
    }
    if (r->is_hull && r->volume_before > 0.0) {
        CLI_GUARD(clast_reform_principal(mesh, &turned, r->before));
    }
    clast_mesh_free(&turned);
    return CLAST_OK;
}

static clast_status reform(const form_config *c, double size, const clast_mesh *mesh,
                           clast_mesh *out, form_report *r)
{
    clast_mesh hull = {0};
    clast_mesh turned = {0};
    double lis[3];
    clast_status status = CLAST_OK;
    r->n_before = mesh->n_tri;
    r->is_hull = c->hull > 0;
    if (r->is_hull) {
        CLI_TRY(clast_reform_hull(mesh, c->hull, &hull));
    } else {
        CLI_TRY(clast_mesh_copy(mesh, &hull));
    }
    r->volume_own = clast_mesh_volume(&hull);
    CLI_TRY(clast_reform_principal(&hull, &turned, r->own));
    CLI_TRY(measure_surface(mesh, r));
    wanted_lengths(c, size, r->own, lis);
    CLI_TRY(clast_reform_mesh(&turned, lis, out));
done:
    clast_mesh_free(&turned);
    clast_mesh_free(&hull);
    return status;
}

/// What the written mesh measures, not what was asked for.
static clast_status measure_written(const clast_mesh *out, form_report *r)
{
    clast_mesh turned = {0};
    const clast_status status = clast_reform_principal(out, &turned, r->after);
    r->n_after = out->n_tri;
    r->volume_after = clast_mesh_volume(out);
    clast_mesh_free(&turned);
    return status;
}

static void axes_json(json_t *o, const char *when, const double lis[3])
{
    json_t *set = json_object();
    cli_json_number(set, "L", lis[0]);
    cli_json_number(set, "I", lis[1]);
    cli_json_number(set, "S", lis[2]);
    cli_json_number(set, "D", clast_form_sieve_size(lis[1], lis[2]));
    cli_json_number(set, "flatness", lis[2] / lis[1]);
    cli_json_number(set, "elongation", lis[1] / lis[0]);
    (void)json_object_set_new(o, when, set);
}

static json_t *report_json(const cli_common *common, const char *unit, const form_report *r)
{
    json_t *o = json_object();
    cli_json_text(o, "file", common->argument[0]);
    cli_json_text(o, "output", common->output);
    cli_json_text(o, "unit", unit[0] != '\0' ? unit : "model");
    axes_json(o, "before", r->before);
    if (r->is_hull) {
        axes_json(o, "hull", r->own);
        cli_json_number(o, "added_volume", r->volume_own - r->volume_before);
    }
    axes_json(o, "after", r->after);
    cli_json_number(o, "volume_before", r->volume_before);
    cli_json_number(o, "volume_hull", r->volume_own);
    cli_json_number(o, "volume", r->volume_after);
    cli_json_count(o, "n_triangle_before", r->n_before);
    cli_json_count(o, "n_triangle", r->n_after);
    return o;
}

static void axes_words(const char *when, const double lis[3])
{
    (void)printf("  %-7s L %.8g  I %.8g  S %.8g   D %.8g   flatness %.6f  elongation %.6f\n", when,
                 lis[0], lis[1], lis[2], clast_form_sieve_size(lis[1], lis[2]), lis[2] / lis[1],
                 lis[1] / lis[0]);
}

static void report_words(const cli_common *common, const clast_mesh *mesh, const char *unit,
                         const form_report *r)
{
    char words[32];
    cli_mesh_unit(unit, words);
    (void)printf("%s: %d triangles -> %s: %d triangles; %s\n", cli_name(common->argument[0]),
                 r->n_before, cli_name(common->output), r->n_after, words);
    if (!isnan(r->before[0])) {
        axes_words("before", r->before);
    }
    if (r->is_hull) {
        axes_words("hull", r->own);
    }
    axes_words("after", r->after);
    if (r->is_hull) {
        (void)printf("  volume  %.8g of the hull -> %.8g\n", r->volume_own, r->volume_after);
        cli_hull_words(mesh, r->volume_own, r->volume_before, r->why);
    } else {
        (void)printf("  volume  %.8g -> %.8g\n", r->volume_before, r->volume_after);
    }
}

/// Without a hull the surface itself is measured: it must bound a solid, and once.
static clast_status check_surface(const cli_common *common, const clast_mesh *mesh)
{
    clast_mesh_check_result found = {0};
    CLI_GUARD(clast_mesh_require_solid(mesh, common->argument[0], "take its hull with --hull N"));
    CLI_GUARD(clast_mesh_check(mesh, &found));
    cli_note_doubles(common, &found, ", so L, I and S are off");
    if (found.n_body > 1 && !cli_counts_twice(&found) && !common->quiet) {
        (void)fprintf(
            stderr,
            "clast mesh form: note: %s: %d bodies that do not hang together, taken as one "
            "grain; clast mesh repair --keep largest keeps one\n",
            cli_name(common->argument[0]), found.n_body);
    }
    clast_mesh_check_free(&found);
    return CLAST_OK;
}

static clast_status run(const cli_common *common, void *config_bytes)
{
    const form_config *config = config_bytes;
    clast_mesh mesh = {0};
    clast_mesh out = {0};
    form_report report = {.why = ""};
    double size = 0.0;
    clast_mesh_read_report read = {0};
    clast_status status = CLAST_OK;
    CLI_TRY(cli_mesh_output(common));
    CLI_TRY(check_config(config));
    CLI_TRY(cli_mesh_welded(common, &mesh, &read));
    CLI_TRY(cli_mesh_length("size", config->size, read.unit, &size));
    if (config->hull == 0) {
        CLI_TRY(check_surface(common, &mesh));
    }
    CLI_TRY(reform(config, size, &mesh, &out, &report));
    CLI_TRY(measure_written(&out, &report));
    CLI_TRY(config->unit_form ? clast_mesh_write(&out, common->output, NULL) // no size, no unit
                              : cli_mesh_save(common, &out, &read));
    if (common->json) {
        CLI_TRY(cli_print_json(report_json(common, read.unit, &report)));
    } else {
        report_words(common, &mesh, read.unit, &report);
    }
done:
    clast_mesh_free(&out);
    clast_mesh_free(&mesh);
    return status;
}

const cli_command cli_mesh_form = {
    .name = "mesh form",
    .arguments = "FILE -o OUT",
    .summary = "a grain in its principal frame, stretched to a wanted form and size",
    .example =
        {"clast mesh form data/standin63/grain00.ply --flatness 0.6 --elongation 0.7 -o flat.stl",
         "clast mesh form data/standin63/grain00.ply --unit-form -o compact.ply",
         "clast mesh form scan.stl --hull 100 --size 12 -o grain.stl"},
    .details =
        "L, I and S are the full axes of the ellipsoid with the grain's mass and moments of "
        "inertia; the\ngrain is rotated so that they lie along x, y, z (never mirrored) and "
        "stretched, which changes them\nexactly and keeps what else the shape has (Rettinger et "
        "al. 2022, fig. 5, equations 20 to 22).\n--hull 300 makes the convex grains of at most 300 "
        "faces that packings take.\nDefinitions: docs/theory/grading.md.",
    .fields = form_fields,
    .config_size = sizeof(form_config),
    .n_min = 1,
    .n_max = 1,
    .needs_file = true,
    .run = run,
};
