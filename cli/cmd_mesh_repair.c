// clast mesh repair: makes a surface closed, oriented and manifold, and tells every change.
#include "command.h"
#include "idle.h"
#include "mesh_words.h"

#include <clast/mesh.h>
#include <clast/mesh_repair.h>

#include <stdio.h>

static json_t *report_json(const clast_mesh_repair_report *r)
{
    json_t *o = json_object();
    cli_json_count(o, "n_merged", r->n_merged);
    cli_json_number(o, "weld_distance", r->weld_distance);
    cli_json_count(o, "n_collapsed", r->n_collapsed);
    cli_json_count(o, "n_degenerate", r->n_degenerate);
    cli_json_count(o, "n_duplicate", r->n_duplicate);
    cli_json_count(o, "n_split", r->n_split);
    cli_json_count(o, "n_loose", r->n_loose);
    cli_json_count(o, "n_turned", r->n_turned);
    cli_json_count(o, "n_conflict", r->n_conflict);
    cli_json_count(o, "n_hole_filled", r->n_hole_filled);
    cli_json_count(o, "n_fill_triangle", r->n_fill_triangle);
    cli_json_count(o, "n_hole_left", r->n_hole_left);
    cli_json_count(o, "n_separated", r->n_separated);
    cli_json_count(o, "n_part_dropped", r->n_part_dropped);
    cli_json_count(o, "n_triangle_before", r->n_triangle_before);
    cli_json_count(o, "n_triangle_after", r->n_triangle_after);
    cli_json_number(o, "volume_before", r->volume_before);
    cli_json_number(o, "volume_after", r->volume_after);
    cli_json_number(o, "area_before", r->area_before);
    cli_json_number(o, "area_after", r->area_after);
    return o;
}

/// One line for each step that changed something.
static void print_changes(const clast_mesh_repair_report *r, bool keeps_all)
{
    const struct {
        int32_t n;
        const char *what;
    } lines[] = {{r->n_merged, "vertices merged"},
                 {r->n_collapsed, "triangles with a repeated corner dropped"},
                 {r->n_degenerate, "triangles without area dropped"},
                 {r->n_duplicate, "superfluous triangles with equal corners dropped"},
                 {r->n_split, "triangles cut at T-junctions"},
                 {r->n_loose, "loose triangles dropped"},
                 {r->n_turned, "triangles flipped"},
                 {r->n_conflict, "edges of a one-sided surface left"},
                 {r->n_hole_filled, "holes filled"},
                 {r->n_fill_triangle, "triangles made for them"},
                 {r->n_hole_left, "larger holes left open"},
                 {r->n_separated, "vertices doubled where surfaces touch"},
                 {r->n_part_dropped, keeps_all
                                         ? "parts dropped that bound nothing (solid, or none, on "
                                           "both sides)"
                                         : "parts dropped"}};
    bool any = false;
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; ++i) {
        if (lines[i].n > 0) {
            (void)printf("  %6d %s\n", lines[i].n, lines[i].what);
            any = true;
        }
    }
    if (!any) {
        (void)printf("  nothing had to be changed\n");
    }
    if (r->n_merged > 0) {
        (void)printf("  farthest merged vertex moved %.4g\n", r->weld_distance);
    }
    (void)printf("  triangles %d -> %d, volume %.10g -> %.10g (%+.3g), area %.10g -> %.10g\n",
                 r->n_triangle_before, r->n_triangle_after, r->volume_before, r->volume_after,
                 r->volume_after - r->volume_before, r->area_before, r->area_after);
}

/// STL names vertices by their place: what was parted grows together again when it is read.
static void warn_format(const cli_common *common, const clast_mesh_repair_report *r)
{
    if (r->n_separated > 0 && clast_mesh_format_of_path(common->output) == CLAST_MESH_STL) {
        (void)fprintf(
            stderr,
            "clast mesh repair: an STL cannot keep %d doubled vertices apart; write .ply, "
            ".obj or .off to keep touching surfaces separate\n",
            r->n_separated);
    }
}

/// Checks the surface as the file holds it: STL keeps 24 bits of a coordinate.
static clast_status check_written(const cli_common *common, const clast_mesh *repaired,
                                  clast_mesh_check_result *check)
{
    clast_mesh rounded = {0};
    clast_mesh read = {0};
    clast_status status = CLAST_OK;
    if (clast_mesh_format_of_path(common->output) != CLAST_MESH_STL) {
        return clast_mesh_check(repaired, check);
    }
    CLI_TRY(clast_mesh_copy(repaired, &rounded));
    for (int32_t i = 0; i < 3 * rounded.n_vert; ++i) {
        rounded.vert[i / 3][i % 3] = (double)(float)rounded.vert[i / 3][i % 3];
    }
    CLI_TRY(clast_mesh_weld(&rounded, 0.0, &read, NULL));
    CLI_TRY(clast_mesh_check(&read, check));
done:
    clast_mesh_free(&rounded);
    clast_mesh_free(&read);
    return status;
}

static clast_status tell(const cli_common *common, const clast_mesh_repair_config *config,
                         const char *unit, const clast_mesh_repair_report *report,
                         const clast_mesh_check_result *check)
{
    char words[32];
    if (common->json) {
        json_t *object = cli_check_json(common->output, unit, check);
        if (object != NULL) {
            cli_json_text(object, "input", common->argument[0]);
            (void)json_object_set_new(object, "changes", report_json(report));
        }
        return cli_print_json(object);
    }
    cli_mesh_unit(unit, words);
    (void)printf("%s (%s):\n", cli_name(common->argument[0]), words);
    print_changes(report, config->keep == CLAST_KEEP_ALL);
    cli_check_words(common->output, unit, check);
    return CLAST_OK;
}

static clast_status run(const cli_common *common, void *config)
{
    const clast_mesh_repair_config *c = config;
    clast_idle rules[CLAST_N_IDLE];
    clast_mesh mesh = {0};
    clast_mesh repaired = {0};
    clast_mesh_repair_report report = {0};
    clast_mesh_read_report read = {0};
    clast_mesh_check_result check = {0};
    clast_status status = CLAST_OK;
    CLI_TRY(cli_idle_check(clast_mesh_repair_fields, c, clast_mesh_repair_idle(c, rules)));
    CLI_TRY(cli_mesh_output(common));
    CLI_TRY(cli_mesh_input(common, &mesh, &read));
    CLI_TRY(clast_mesh_repair(&mesh, config, &repaired, &report));
    CLI_TRY(cli_mesh_save(common, &repaired, &read));
    CLI_TRY(check_written(common, &repaired, &check));
    warn_format(common, &report);
    CLI_TRY(tell(common, c, read.unit, &report, &check));
    status = clast_mesh_check_passed(&check) ? CLAST_OK : CLAST_E_NO;
done:
    clast_mesh_check_free(&check);
    clast_mesh_free(&repaired);
    clast_mesh_free(&mesh);
    return status;
}

const cli_command cli_mesh_repair = {
    .name = "mesh repair",
    .arguments = "FILE -o OUT",
    .summary = "make a surface closed, oriented and manifold",
    .example = {"clast mesh repair data/scarlet/stl/t_rex.stl -o closed.stl",
                "clast mesh repair scan.stl --keep largest -o body.ply",
                "clast mesh repair scan.stl --weld within --weld-tolerance 1e-5 -o closed.stl"},
    .details =
        "Merges near vertices, drops triangles without area, repeated and loose ones, splits "
        "edges at\nT-junctions, orients windings consistently and outward, fills holes, parts "
        "surfaces that touch, drops parts in a\nsolid that are wound outward as it is (they would "
        "count twice); reports each change and the change of\nvolume, then checks the result. "
        "Vertices never move.\nExit code: 0 when the result, as its file "
        "keeps it, is a solid, 1 when not (it is\nwritten all the same), 3 when unreadable.",
    .fields = clast_mesh_repair_fields,
    .config_size = sizeof(clast_mesh_repair_config),
    .n_min = 1,
    .n_max = 1,
    .needs_file = true,
    .run = run,
};
