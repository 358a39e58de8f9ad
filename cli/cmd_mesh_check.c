// clast mesh check: what is this surface, and can it be trusted?
#include "command.h"
#include "mesh_words.h"

#include <clast/mesh_repair.h>

#include <stdio.h>

typedef struct {
    double weld;
} config;

static const clast_field fields[] = {
    {"weld", offsetof(config, weld), CLAST_FIELD_F64, 0.0, 0.0, 0.1, "-",
     "merge vertices nearer than this times the extent before checking", NULL},
    {0}};

/// Adds a note on what was joined before the check.
static void note_equal_vertices(clast_mesh_check_result *result, int32_t n_merged)
{
    if (result->n_fault < CLAST_MESH_MAX_FAULT) {
        clast_mesh_fault *fault = &result->fault[result->n_fault++];
        fault->blocking = false;
        (void)snprintf(fault->code, sizeof fault->code, "equal_vertices");
        (void)snprintf(fault->text, sizeof fault->text,
                       "%d vertices repeat others bit by bit (seams of normals or textures) and "
                       "were taken as one; `clast mesh repair` merges them",
                       n_merged);
    }
}

/// Checks the mesh welded within tolerance; keeps the result if it has fewer open edges than
/// `result`, which it then replaces.
static clast_status check_welded(const clast_mesh *mesh, double tolerance,
                                 clast_mesh_check_result *result, int32_t *n_merged)
{
    clast_mesh welded = {0};
    clast_mesh_check_result again = {0};
    int32_t n = 0;
    clast_status status = clast_mesh_weld(mesh, tolerance, &welded, &n);
    if (status == CLAST_OK) {
        status = clast_mesh_check(&welded, &again);
    }
    if (status == CLAST_OK && (tolerance > 0.0 || again.n_open_edge < result->n_open_edge)) {
        const clast_mesh_check_result swap = *result;
        *result = again;
        again = swap;
        *n_merged = n;
        if (tolerance == 0.0) { // the file's count, since nothing but seams was joined
            result->n_vertex = mesh->n_vert;
            note_equal_vertices(result, n);
        }
    }
    clast_mesh_check_free(&again);
    clast_mesh_free(&welded);
    return status;
}

static clast_status tell(const cli_common *common, const config *c,
                         const clast_mesh_check_result *result, int32_t n_merged)
{
    if (common->json) {
        json_t *object = cli_check_json(common->argument[0], result);
        if (object != NULL) {
            cli_json_number(object, "weld", c->weld);
            cli_json_count(object, "n_merged", n_merged);
        }
        return cli_print_json(object);
    }
    if (c->weld > 0.0) {
        (void)printf("merged %d vertices within %g of the extent\n", n_merged, c->weld);
    }
    cli_check_words(common->argument[0], result);
    return CLAST_OK;
}

static clast_status run(const cli_common *common, void *config_bytes)
{
    const config *c = config_bytes;
    clast_mesh mesh = {0};
    clast_mesh_check_result result = {0};
    int32_t n_merged = 0;
    clast_status status = cli_mesh_input(common, &mesh);
    if (status == CLAST_OK) {
        status = clast_mesh_check(&mesh, &result);
    }
    if (status == CLAST_OK && (c->weld > 0.0 || (!result.closed && result.n_edge > 0))) {
        status = check_welded(&mesh, c->weld, &result, &n_merged);
    }
    if (status == CLAST_OK) {
        status = tell(common, c, &result, n_merged);
    }
    if (status == CLAST_OK && !clast_mesh_check_passed(&result)) {
        status = CLAST_E_NO;
    }
    clast_mesh_check_free(&result);
    clast_mesh_free(&mesh);
    return status;
}

const cli_command cli_mesh_check = {
    .name = "mesh check",
    .arguments = "FILE",
    .summary = "what is this surface, and can it be trusted?",
    .details = "Reads STL, OBJ, PLY or OFF and says in words and numbers what is wrong and what to "
               "run.\nVertices that repeat others bit by bit count as one where "
               "the surface is open otherwise.\nLengths, areas and volumes are in the file's own "
               "unit.\nExit code: 0 when "
               "the surface is closed, oriented and manifold, 1 when not, 3 when unreadable.",
    .fields = fields,
    .config_size = sizeof(config),
    .n_min = 1,
    .n_max = 1,
    .run = run,
};
