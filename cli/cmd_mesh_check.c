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

static clast_status run(const cli_common *common, void *config_bytes)
{
    const config *c = config_bytes;
    const char *file = common->argument[0];
    clast_mesh mesh = {0};
    clast_mesh welded = {0};
    clast_mesh_check_result result = {0};
    int32_t n_merged = 0;
    clast_status status = cli_mesh_input(common, &mesh);
    if (status == CLAST_OK) {
        status = c->weld > 0.0 ? clast_mesh_weld(&mesh, c->weld, &welded, &n_merged) : CLAST_OK;
    }
    if (status == CLAST_OK) {
        status = clast_mesh_check(c->weld > 0.0 ? &welded : &mesh, &result);
    }
    if (status == CLAST_OK && common->json) {
        json_t *object = cli_check_json(file, &result);
        if (object != NULL) {
            cli_json_number(object, "weld", c->weld);
            cli_json_count(object, "n_merged", n_merged);
        }
        status = cli_print_json(object);
    } else if (status == CLAST_OK) {
        if (c->weld > 0.0) {
            (void)printf("merged %d vertices within %g of the extent\n", n_merged, c->weld);
        }
        cli_check_words(file, &result);
    }
    if (status == CLAST_OK && !clast_mesh_check_passed(&result)) {
        status = CLAST_E_NO;
    }
    clast_mesh_check_free(&result);
    clast_mesh_free(&welded);
    clast_mesh_free(&mesh);
    return status;
}

const cli_command cli_mesh_check = {
    .name = "mesh check",
    .arguments = "FILE",
    .summary = "what is this surface, and can it be trusted?",
    .details = "Reads STL, OBJ, PLY or OFF and says in words and numbers what is wrong and what to "
               "run.\nLengths, areas and volumes are in the file's own unit.\nExit code: 0 when "
               "the surface is closed, oriented and manifold, 1 when not, 3 when unreadable.",
    .fields = fields,
    .config_size = sizeof(config),
    .n_min = 1,
    .n_max = 1,
    .run = run,
};
