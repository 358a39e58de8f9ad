// Files of an aggregation's run folder.
#include "study/aggregate_folder.h"

#include "base/alloc.h"
#include "base/file.h"
#include "io/checkpoint.h"
#include "io/state.h"
#include <clast/manifest.h>
#include <clast/mesh_file.h>
#include <clast/structure.h>
#include <clast/table_file.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { RADIAL_BINS = 20 };

/// Triangles of all parts together that a file should not exceed by much.
static const int64_t TRIANGLE_AIM = 2000000;

clast_status clx_folder_join(char *path, const char *folder, const char *name)
{
    const int n = snprintf(path, CLX_PATH_LIMIT, "%s/%s", folder, name);
    return n > 0 && n < CLX_PATH_LIMIT
               ? CLAST_OK
               : clx_fail(CLAST_E_USAGE, "the path %.60s... is longer than %d bytes", folder,
                          CLX_PATH_LIMIT);
}

static clast_status state_path(const char *folder, int32_t repeat, char path[CLX_PATH_LIMIT])
{
    char name[32] = "state.h5";
    if (repeat > 0) {
        (void)snprintf(name, sizeof name, "state-%04d.h5", repeat + 1);
    }
    return clx_folder_join(path, folder, name);
}

/// The parts of a state, which borrows the assembly and owns tables and configuration.
static clast_status gather(const clast_aggregate_config *config, const clast_aggregate *aggregate,
                           clast_table table[2], clast_state *state)
{
    clast_status status = CLAST_OK;
    clast_state made = {.table = table};
    CLX_TRY(clast_config_json(clast_aggregate_fields, config, &made.config));
    CLX_TRY(clast_aggregate_history(aggregate, &table[0]));
    made.n_table = 1;
    if (config->mode == CLAST_AGGREGATE_CLUSTER) {
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

clast_status clx_folder_write_checkpoint(const char *folder, const clast_aggregate_config *config,
                                         int32_t repeat, const clast_aggregate *aggregate)
{
    clast_status status = CLAST_OK;
    clast_table table[2] = {{0}, {0}};
    clast_state state = {0};
    clx_h5 *h5 = NULL;
    CLX_TRY(gather(config, aggregate, table, &state));
    const int64_t whole = (int64_t)clast_aggregate_n_particle(aggregate) + 1;
    CLX_TRY(clx_h5_create(&h5));
    CLX_TRY(clx_state_put(h5, &state));
    CLX_TRY(clx_checkpoint_write(h5, folder, repeat * whole + table[0].n_row));
done:
    clx_h5_close(h5);
    free_gathered(table, &state);
    return status;
}

clast_status clx_folder_read_checkpoint(const char *folder, clast_state *state)
{
    clast_status status = CLAST_OK;
    char *path = NULL;
    int64_t step = 0;
    CLX_TRY(clx_checkpoint_newest(folder, &path, &step, NULL));
    CLX_TRY(clast_state_read(path, state));
done:
    clx_free(path);
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

static int level_for(const clast_assembly *assembly)
{
    int level = 3;
    while (level > 1 && ((int64_t)assembly->n_grain * 20) << (2 * level) > TRIANGLE_AIM) {
        --level;
    }
    return level;
}

/// All parts as one STL in micrometres.
static clast_status write_stl(const char *folder, const clast_assembly *assembly)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    clast_mesh mesh = {0};
    const double none[3] = {0.0, 0.0, 0.0};
    const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    const clast_mesh_write_options options = {.unit = "um", .name = "aggregate"};
    const int level = level_for(assembly);
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        CLX_TRY(clast_assembly_grain_surface(assembly, i, level, &mesh));
    }
    clast_mesh_transform(&mesh, 1e6, unturned, none);
    CLX_TRY(clx_folder_join(path, folder, "aggregate.stl"));
    CLX_TRY(clast_mesh_write(path, &mesh, &options));
done:
    clast_mesh_free(&mesh);
    return status;
}

static clast_status write_summary(const char *folder, const clast_aggregate_report *report)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    char *text = NULL;
    CLX_TRY(clast_aggregate_report_json(report, false, &text));
    CLX_TRY(clx_folder_join(path, folder, "summary.json"));
    CLX_TRY(clx_file_write_all(path, text, strlen(text)));
done:
    clast_text_free(text);
    return status;
}

static clast_status write_table(const char *folder, const char *name, const clast_table *table)
{
    char path[CLX_PATH_LIMIT];
    const clast_status status = clx_folder_join(path, folder, name);
    return status == CLAST_OK ? clast_table_write_csv(table, path) : status;
}

/// structure.csv and radial.csv of the first repeat.
static clast_status write_structure(const char *folder, const clx_folder_results *r)
{
    clast_status status = CLAST_OK;
    clast_table table = {0};
    clast_structure_options options = clast_structure_options_default();
    options.envelope.seed = r->config->seed;
    options.envelope.n_ray = r->config->envelope_rays;
    options.envelope.length = r->config->envelope_length;
    options.solid.seed = r->config->seed;
    CLX_TRY(clast_structure(r->first, &options, &table));
    CLX_TRY(write_table(folder, "structure.csv", &table));
    clast_table_free(&table);
    CLX_TRY(clast_assembly_radial_profile(r->first, NULL, RADIAL_BINS, &table));
    CLX_TRY(write_table(folder, "radial.csv", &table));
done:
    clast_table_free(&table);
    return status;
}

/// sizes.csv; mergers of clusters place no sizes.
static clast_status write_sizes(const char *folder, const clx_folder_results *r)
{
    clast_status status = CLAST_OK;
    clast_table table = {0};
    if (r->config->mode == CLAST_AGGREGATE_CORE) {
        CLX_TRY(clast_aggregate_achieved(r->config, r->sizes, r->history, &table));
        CLX_TRY(write_table(folder, "sizes.csv", &table));
    }
done:
    clast_table_free(&table);
    return status;
}

clast_status clx_folder_write_results(const char *folder, const clx_folder_results *r)
{
    clast_status status = CLAST_OK;
    clast_table band = {0};
    CLX_TRY(write_table(folder, "history.csv", r->history));
    if (r->report->n > 1) {
        CLX_TRY(clast_aggregate_band(r->history, r->report->confidence, &band));
        CLX_TRY(write_table(folder, "history_band.csv", &band));
    }
    CLX_TRY(write_sizes(folder, r));
    CLX_TRY(write_structure(folder, r));
    CLX_TRY(write_stl(folder, r->first));
    CLX_TRY(clx_folder_write_pictures(folder, r));
    CLX_TRY(write_summary(folder, r->report));
    CLX_TRY(clx_checkpoint_clear(folder));
done:
    clast_table_free(&band);
    return status;
}
