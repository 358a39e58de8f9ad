// States and checkpoints of the repeats in an aggregation's run folder.
#include "study/aggregate_folder.h"

#include "base/alloc.h"
#include "base/file.h"
#include "base/path.h"
#include "io/folder.h"
#include "io/state.h"
#include "run/checkpoint.h"
#include <clast/table.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static clast_status state_path(const char *folder, int32_t repeat, char path[CLX_PATH_LIMIT])
{
    CLAST_ASSERT(repeat >= 0);
    char name[32] = "state.h5";
    if (repeat > 0) {
        (void)snprintf(name, sizeof name, "state-%04d.h5", repeat + 1);
    }
    return clx_path_join(path, folder, name);
}

/// The parts of a state, which borrows the assembly and owns tables and configuration.
static clast_status gather(const clast_aggregate_config *config, const clast_aggregate *aggregate,
                           clast_table table[2], clast_state *state)
{
    clast_status status = CLAST_OK;
    clast_state made = {.table = table};
    CLX_TRY(clast_fields_json(clast_aggregate_fields, config, &made.config));
    CLX_TRY(clast_aggregate_history(aggregate, &table[0]));
    made.n_table = 1;
    if (config->params.mode == CLAST_AGGREGATE_CLUSTER) {
        CLX_TRY(clast_aggregate_members(aggregate, &table[1]));
        made.n_table = 2;
    }
    // clast_state borrows what it writes; it has no const for what it owns when read
    memcpy(&made.assembly, &(const clast_assembly *){clast_aggregate_assembly(aggregate)},
           sizeof made.assembly);
    *state = made;
    made = (clast_state){0};
done:
    clast_text_free(made.config);
    return status;
}

static void free_gathered(clast_table table[2], clast_state *state)
{
    clast_table_free(&table[0]);
    clast_table_free(&table[1]);
    clast_text_free(state->config);
}

clast_status clx_folder_write_state(const char *folder, const clast_aggregate_config *config,
                                    int32_t repeat, const clast_aggregate *aggregate)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    clast_table table[2] = {{0}, {0}};
    clast_state state = {0};
    CLX_TRY(gather(config, aggregate, table, &state));
    CLX_TRY(state_path(folder, repeat, path));
    CLX_TRY(clast_state_write(&state, path));
done:
    free_gathered(table, &state);
    return status;
}

clast_status clx_folder_read_state(const char *folder, int32_t repeat, clast_state *state)
{
    char path[CLX_PATH_LIMIT];
    const clast_status status = state_path(folder, repeat, path);
    return status == CLAST_OK ? clast_state_read(path, state) : status;
}

bool clx_folder_has_state(const char *folder, int32_t repeat)
{
    char path[CLX_PATH_LIMIT];
    struct stat found;
    return state_path(folder, repeat, path) == CLAST_OK && stat(path, &found) == 0;
}

/// Where the repeat's checkpoints lie.
static clast_status checkpoint_folder(const char *folder, int32_t repeat, char path[CLX_PATH_LIMIT])
{
    CLAST_ASSERT(repeat >= 0);
    char name[32] = ".";
    (void)snprintf(name, sizeof name, "repeat-%04d", repeat + 1);
    if (repeat > 0) {
        return clx_path_join(path, folder, name);
    }
    (void)snprintf(path, CLX_PATH_LIMIT, "%s", folder);
    return CLAST_OK;
}

clast_status clx_folder_write_checkpoint(const char *folder, const clast_aggregate_config *config,
                                         int32_t repeat, const clast_aggregate *aggregate)
{
    clast_status status = CLAST_OK;
    clast_table table[2] = {{0}, {0}};
    clast_state state = {0};
    clx_h5 *h5 = NULL;
    char path[CLX_PATH_LIMIT];
    CLX_TRY(checkpoint_folder(folder, repeat, path));
    CLX_TRY(gather(config, aggregate, table, &state));
    CLX_TRY(clx_h5_create(&h5));
    CLX_TRY(clx_state_write_to(h5, &state));
    CLX_TRY(clx_checkpoint_write(h5, path, table[0].n_row));
done:
    clx_h5_close(h5);
    free_gathered(table, &state);
    return status;
}

bool clx_folder_has_checkpoint(const char *folder, int32_t repeat)
{
    char path[CLX_PATH_LIMIT];
    return checkpoint_folder(folder, repeat, path) == CLAST_OK && clx_checkpoint_exists(path);
}

clast_status clx_folder_read_checkpoint(const char *folder, int32_t repeat, clast_state *state)
{
    clast_status status = CLAST_OK;
    char in[CLX_PATH_LIMIT];
    char *path = NULL;
    int64_t step = 0;
    CLX_TRY(checkpoint_folder(folder, repeat, in));
    CLX_TRY(clx_checkpoint_newest(in, &path, &step, NULL));
    CLX_TRY(clast_state_read(path, state));
done:
    clx_free(path);
    return status;
}

/// repeat-0002 and so on.
static bool is_repeat(const char *name)
{
    return strncmp(name, "repeat-", 7) == 0 && strlen(name) >= 11 &&
           name[7 + strspn(name + 7, "0123456789")] == '\0';
}

clast_status clx_folder_clear_checkpoints(const char *folder)
{
    clast_status status = CLAST_OK;
    clx_folder inside = {0};
    char path[CLX_PATH_LIMIT];
    CLX_TRY(clx_folder_list(folder, &inside));
    for (int32_t i = 0; i < inside.n; ++i) {
        if (is_repeat(inside.name[i])) {
            CLX_TRY(clx_path_join(path, folder, inside.name[i]));
            CLX_TRY(clx_checkpoint_clear(path));
            // Somebody's own files in it stay.
            CLX_CHECK(rmdir(path) == 0 || errno == ENOTEMPTY || errno == EEXIST, CLAST_E_DISK,
                      "cannot remove %s: %s", path, clx_errno_text());
        }
    }
    CLX_TRY(clx_checkpoint_clear(folder));
done:
    clx_folder_free(&inside);
    return status;
}

clast_status clx_folder_saved(const clast_state *state, clast_aggregate_saved *saved)
{
    clast_status status = CLAST_OK;
    const clast_table *history = clast_state_table(state, "history");
    const double *repeat = history != NULL ? clast_table_numbers(history, "repeat") : NULL;
    CLX_CHECK(state->assembly != NULL && state->config != NULL && history != NULL, CLAST_E_FORMAT,
              "the state is not one of clast aggregate");
    *saved = (clast_aggregate_saved){
        .repeat = repeat != NULL && history->n_row > 0 ? (int32_t)repeat[0] : 0,
        .placed = state->assembly,
        .history = history,
        .members = clast_state_table(state, "members")};
done:
    return status;
}
