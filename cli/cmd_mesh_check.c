// clast mesh check: what is this surface, and can it be trusted?
#include "command.h"
#include "idle.h"
#include "mesh_words.h"

#include <clast/mesh.h>
#include <clast/mesh_repair.h>

#include <stdio.h>

typedef struct {
    int32_t weld;
    double weld_tolerance;
} config;

static const clast_field fields[] = {
    {"weld", .offset = offsetof(config, weld), CLAST_FIELD_CHOICE, CLAST_WELD_AUTO, 0, 0, "-",
     "merge near vertices first: those of open edges, as every command does that reads a surface; "
     "not at all; or all within weld_tolerance",
     "auto|off|within"},
    {"weld_tolerance", .offset = offsetof(config, weld_tolerance), CLAST_FIELD_F64, 1e-6, 0.0, 0.1,
     "-", "for weld within: times the extent", NULL},
    {0}};

/// Adds a note on what was merged before the check.
static void note_weld(clast_mesh_check_result *result, const clast_mesh_repair_report *weld,
                      int32_t n_open)
{
    if (weld->n_merged == 0 || result->n_fault == CLAST_MESH_MAX_FAULT) {
        return;
    }
    clast_mesh_fault *fault = &result->fault[result->n_fault++];
    fault->blocking = false;
    if (weld->weld_distance == 0.0) {
        (void)snprintf(fault->code, sizeof fault->code, "equal_vertices");
        (void)snprintf(fault->text, sizeof fault->text,
                       "%d vertices repeat others bit by bit (seams of normals or textures) and "
                       "were taken as one; `clast mesh repair` merges them",
                       weld->n_merged);
    } else {
        (void)snprintf(fault->code, sizeof fault->code, "merged_vertices");
        (void)snprintf(fault->text, sizeof fault->text,
                       "%d vert%s merged with others within %.3g (%.2g of the extent), as every "
                       "command does; %d open edges as the file has it (--weld off)",
                       weld->n_merged, weld->n_merged == 1 ? "ex" : "ices", weld->weld_distance,
                       weld->weld_distance / result->extent, n_open);
    }
}

static clast_status weld_within(clast_mesh *mesh, double tolerance,
                                clast_mesh_repair_report *report)
{
    clast_mesh welded = {0};
    const int32_t n_tri = mesh->n_tri;
    CLI_GUARD(clast_mesh_weld(mesh, tolerance, &welded, &report->n_merged));
    report->n_collapsed = n_tri - welded.n_tri;
    clast_mesh_free(mesh);
    *mesh = welded;
    return CLAST_OK;
}

/// Checks the surface as the file has it, and again where the weld changed it.
static clast_status check(const config *c, clast_mesh *mesh, clast_mesh_check_result *result,
                          clast_mesh_repair_report *weld)
{
    const int32_t n_vertex = mesh->n_vert;
    CLI_GUARD(clast_mesh_check(mesh, result));
    const int32_t n_open = result->n_open_edge;
    if (c->weld == CLAST_WELD_WITHIN) {
        CLI_GUARD(weld_within(mesh, c->weld_tolerance, weld));
    } else if (c->weld == CLAST_WELD_AUTO && !result->closed) {
        CLI_GUARD(clast_mesh_weld_auto(mesh, weld));
    }
    if (weld->n_merged == 0) {
        return CLAST_OK;
    }
    clast_mesh_check_free(result);
    CLI_GUARD(clast_mesh_check(mesh, result));
    if (c->weld == CLAST_WELD_AUTO) {
        result->n_degenerate += weld->n_collapsed;
        result->n_vertex = weld->weld_distance == 0.0 ? n_vertex : result->n_vertex;
        note_weld(result, weld, n_open);
    }
    return CLAST_OK;
}

static clast_status tell(const cli_common *common, const config *c, const clast_mesh *mesh,
                         const char *unit, const clast_mesh_check_result *result,
                         const clast_mesh_repair_report *weld)
{
    char cure[400] = "";
    const bool solid = result->closed && result->oriented;
    if (!solid) {
        CLI_GUARD(clast_mesh_cure(mesh, common->argument[0], sizeof cure, cure));
    }
    if (common->json) {
        json_t *object = cli_check_json(common->argument[0], unit, result);
        cli_json_number(object, "weld", weld->weld_distance);
        cli_json_count(object, "n_merged", weld->n_merged);
        cli_json_text(object, "repair", solid ? NULL : cure);
        return cli_print_json(object);
    }
    if (c->weld == CLAST_WELD_WITHIN) {
        (void)printf("merged %d vertices within %g of the extent\n", weld->n_merged,
                     c->weld_tolerance);
    }
    cli_check_words(common->argument[0], unit, result);
    if (cure[0] != '\0') {
        (void)printf("  to %s: %s\n", result->closed ? "orient it outward" : "close it", cure);
    }
    return CLAST_OK;
}

static clast_status run(const cli_common *common, void *config_bytes)
{
    const config *c = config_bytes;
    const clast_mesh_repair_config welding = {.weld = c->weld};
    clast_idle rules[CLAST_N_IDLE];
    clast_mesh mesh = {0};
    clast_mesh_read_report read = {0};
    clast_mesh_check_result result = {0};
    clast_mesh_repair_report weld = {0};
    clast_status status = CLAST_OK;
    CLI_TRY(cli_idle_check(fields, c, clast_mesh_repair_idle(&welding, rules)));
    CLI_TRY(cli_mesh_input(common, &mesh, &read));
    CLI_TRY(check(c, &mesh, &result, &weld));
    CLI_TRY(tell(common, c, &mesh, read.unit, &result, &weld));
    status = clast_mesh_check_passed(&result) ? CLAST_OK : CLAST_E_NO;
done:
    clast_mesh_check_free(&result);
    clast_mesh_free(&mesh);
    return status;
}

const cli_command cli_mesh_check = {
    .name = "mesh check",
    .arguments = "FILE",
    .summary = "what is this surface, and can it be trusted?",
    .example = {"clast mesh check data/standin63/grain00.ply",
                "clast mesh check data/standin63/grain01.ply --json",
                "clast mesh check scan.stl --weld off"},
    .details =
        "Reads STL, OBJ, PLY or OFF and says in words and numbers what is wrong and what to "
        "run.\nVertices of open edges that rounding has parted are merged first, as in "
        "every command that\nreads a surface; the distance is reported. --weld off counts the "
        "file as it is.\nLengths, areas and volumes are in the file's own "
        "unit.\nExit code: 0 when "
        "the surface is closed, oriented and manifold, 1 when not, 3 when unreadable.",
    .fields = fields,
    .config_size = sizeof(config),
    .n_min = 1,
    .n_max = 1,
    .writes_no_file = true,
    .run = run,
};
