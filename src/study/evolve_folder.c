// What an evolution leaves in its run folder.
#include "study/evolve_folder.h"

#include "base/alloc.h"
#include "base/file.h"
#include "io/state.h"
#include "run/checkpoint.h"
#include "run/run.h"
#include "study/frames.h"
#include <clast/assembly.h>
#include <clast/run_folder.h>
#include <clast/state.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static clast_status write_tables(const char *folder, const clast_evolve *evolve)
{
    static const char *const name[CLAST_N_EVOLVE_TABLE] = {[CLAST_EVOLVE_BALANCE] = "balance.csv",
                                                           [CLAST_EVOLVE_SPECTRUM] = "spectrum.csv",
                                                           [CLAST_EVOLVE_EVENTS] = "events.csv",
                                                           [CLAST_EVOLVE_DEPOSIT] = "deposit.csv",
                                                           [CLAST_EVOLVE_PARTICLES] =
                                                               "particles.csv"};
    clast_status status = CLAST_OK;
    clast_table table = {0};
    for (int k = 0; k < CLAST_N_EVOLVE_TABLE; ++k) {
        CLX_TRY(clast_evolve_table(evolve, (clast_evolve_table_kind)k, &table));
        CLX_TRY(clx_run_write_table(folder, name[k], &table));
        clast_table_free(&table);
    }
done:
    clast_table_free(&table);
    return status;
}

/// Volume-equivalent diameters of the bodies on the floor, as clast pack --curve list:FILE
/// --size-meaning volume takes them.
static clast_status write_sizes(const char *folder, const clast_evolve *evolve)
{
    clast_status status = CLAST_OK;
    clast_table deposit = {0};
    clast_table sizes = {0};
    double *diameter = NULL;
    double *count = NULL;
    CLX_TRY(clast_evolve_table(evolve, CLAST_EVOLVE_DEPOSIT, &deposit));
    CLX_TRY(clast_table_init(&sizes, "deposit_sizes", deposit.n_row));
    CLX_TRY(clast_table_add_number(&sizes, "volume_diameter_m", "m", NULL));
    CLX_TRY(clast_table_add_number(&sizes, "count", "-", NULL));
    diameter = clast_table_numbers(&sizes, "volume_diameter_m");
    count = clast_table_numbers(&sizes, "count");
    for (int64_t i = 0; i < deposit.n_row; ++i) {
        diameter[i] = cbrt(6.0 * clast_table_numbers(&deposit, "solid_m3")[i] / CLAST_PI);
        count[i] = 1.0;
    }
    CLX_TRY(clx_run_write_table(folder, "deposit_sizes.csv", &sizes));
done:
    clast_table_free(&deposit);
    clast_table_free(&sizes);
    return status;
}

/// One aggregate as clast pack, porosity and render take it.
static clast_status write_aggregate(const char *folder, const char *name, const char *config,
                                    const clast_evolve *evolve, int64_t node)
{
    clast_status status = CLAST_OK;
    clast_assembly assembly = {0};
    char path[CLX_PATH_LIMIT];
    CLX_TRY(clast_evolve_aggregate(evolve, node, &assembly));
    CLX_TRY(clx_path_join(path, folder, name));
    CLX_TRY(clast_state_write_assembly(&assembly, path, config));
done:
    clast_assembly_free(&assembly);
    return status;
}

/// state.h5, the body of most grains, and aggregates/node-NNNNNNNN.h5 of the first `keep`.
static clast_status write_aggregates(const char *folder, const char *config, int32_t keep,
                                     const clast_evolve *evolve, int32_t *n_written)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    int64_t *node = NULL;
    int32_t n = keep > 0 ? keep : 1;
    CLX_TRY(clx_alloc(&node, n, sizeof *node));
    CLX_TRY(clast_evolve_largest(evolve, &n, node));
    if (n > 0) {
        CLX_TRY(write_aggregate(folder, "state.h5", config, evolve, node[0]));
    }
    n = keep > 0 ? n : 0;
    if (n > 0) {
        CLX_TRY(clx_path_join(path, folder, "aggregates"));
        CLX_TRY(clx_folder_make(path));
    }
    for (int32_t k = 0; k < n; ++k) {
        char name[64];
        (void)snprintf(name, sizeof name, "aggregates/node-%08lld.h5", (long long)node[k]);
        CLX_TRY(write_aggregate(folder, name, NULL, evolve, node[k]));
    }
    *n_written = n;
done:
    clx_free(node);
    return status;
}

static clast_status write_summary(const char *folder, const clast_evolve_result *result)
{
    char *text = NULL;
    const clast_status made = clast_evolve_result_json(result, false, &text);
    return clx_run_write_summary(folder, made, text);
}

clast_status clx_evolve_write_results(const char *folder, const char *config,
                                      const clast_evolve_config *physics,
                                      const clast_domain *domain, const clast_evolve *evolve,
                                      clast_evolve_result *result)
{
    clast_status status = CLAST_OK;
    CLX_TRY(write_tables(folder, evolve));
    CLX_TRY(write_sizes(folder, evolve));
    if (physics->structure) {
        CLX_TRY(write_aggregates(folder, config, physics->keep, evolve, &result->n_written));
        CLX_TRY(physics->bed_width > 0.0
                    ? clx_evolve_write_bed(folder, physics->bed_width, domain, evolve, result)
                    : CLAST_OK);
    }
    CLX_TRY(clx_evolve_draw(folder, evolve));
    CLX_TRY(write_summary(folder, result));
    CLX_TRY(clx_checkpoint_clear(folder));
done:
    return status;
}

clast_status clx_evolve_write_checkpoint(const char *folder, const char *config, int64_t step,
                                         const clast_evolve *evolve)
{
    clast_status status = CLAST_OK;
    clast_table table[CLAST_N_EVOLVE_SAVED] = {{0}};
    clast_state state = {.n_table = CLAST_N_EVOLVE_SAVED, .table = table};
    clx_h5 *h5 = NULL;
    CLX_TRY(clast_evolve_save(evolve, table));
    CLX_TRY(clx_alloc_text(&state.config, config));
    CLX_TRY(clx_h5_create(&h5));
    CLX_TRY(clx_state_write_to(h5, &state));
    CLX_TRY(clx_checkpoint_write(h5, folder, step));
done:
    clx_h5_close(h5);
    clx_free(state.config);
    for (int k = 0; k < CLAST_N_EVOLVE_SAVED; ++k) {
        clast_table_free(&table[k]);
    }
    return status;
}

clast_status clx_evolve_write_frame(const char *folder, int32_t row, const clast_evolve *evolve)
{
    enum { MOST_SURFACES = 5000 };
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    clast_assembly assembly = {0};
    clast_table values = {0};
    clast_export_options options = {.format = CLAST_EXPORT_VTU, .level = 1, .values = &values};
    CLX_TRY(clx_frame_path(folder, row, path));
    CLX_TRY(clast_evolve_assembly(evolve, &assembly, &values));
    if (assembly.n_grain > 0) {
        options.points = assembly.n_grain > MOST_SURFACES;
        CLX_TRY(clast_assembly_write(&assembly, path, &options, NULL));
    }
done:
    clast_table_free(&values);
    clast_assembly_free(&assembly);
    return status;
}

clast_status clx_evolve_write_collection(const char *folder, const clast_evolve *evolve,
                                         int32_t *n_frame)
{
    clast_status status = CLAST_OK;
    clast_table balance = {0};
    int64_t n = 0;
    CLX_TRY(clast_evolve_table(evolve, CLAST_EVOLVE_BALANCE, &balance));
    CLX_TRY(
        clx_frames_collect(folder, 0, balance.n_row, clast_table_numbers(&balance, "time_s"), &n));
    *n_frame = (int32_t)n;
done:
    clast_table_free(&balance);
    return status;
}
