// Files of an aggregation's run folder.
#include "study/aggregate_folder.h"

#include "base/path.h"
#include "run/run.h"
#include <clast/assembly.h>
#include <clast/mesh.h>
#include <clast/run_folder.h>
#include <clast/table.h>
#include <string.h>

enum { RADIAL_BINS = 20 };

/// Triangles of all parts together that a file should not exceed by much.
static const int64_t TRIANGLE_AIM = 2000000;

static int level_for(const clast_assembly *assembly)
{
    int level = 3;
    while (level > 1 && ((int64_t)assembly->n_grain * 20) << (2 * level) > TRIANGLE_AIM) {
        --level;
    }
    return level;
}

/// All parts as one STL in millimetres.
static clast_status write_stl(const char *folder, const clast_assembly *assembly)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    clast_mesh mesh = {0};
    const double none[3] = {0.0, 0.0, 0.0};
    const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    const clast_mesh_write_options options = {.unit = "mm", .name = "aggregate"};
    const int level = level_for(assembly);
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        CLX_TRY(clast_assembly_grain_surface(assembly, i, level, &mesh));
    }
    clast_mesh_transform(&mesh, 1e3, unturned, none);
    CLX_TRY(clx_path_join(path, folder, "aggregate.stl"));
    CLX_TRY(clast_mesh_write(&mesh, path, &options));
done:
    clast_mesh_free(&mesh);
    return status;
}

static clast_status write_summary(const char *folder, const clast_aggregate_report *report)
{
    char *text = NULL;
    const clast_status made = clast_aggregate_report_json(report, false, &text);
    return clx_run_write_summary(folder, made, text);
}

/// structure.csv and radial.csv of the first repeat, in cluster mode of its largest cluster.
static clast_status write_structure(const char *folder, const clx_folder_results *r)
{
    clast_status status = CLAST_OK;
    clast_table table = {0};
    clast_structure_options options = clast_structure_options_default();
    options.envelope.seed = r->config->params.seed;
    options.envelope.n_ray = r->config->params.envelope_rays;
    options.envelope.length = r->config->params.envelope_length;
    options.solid.seed = r->config->params.seed;
    options.n_first = r->config->params.mode == CLAST_AGGREGATE_CLUSTER ? -1 : 0;
    for (int32_t k = 0; k < r->config->params.envelope.n; ++k) {
        const char *alpha = clast_envelope_name(CLAST_ENVELOPE_ALPHA);
        options.alpha = options.alpha || strcmp(r->config->params.envelope.item[k], alpha) == 0;
    }
    CLX_TRY(clast_structure(r->body, &options, &table));
    CLX_TRY(clx_run_write_table(folder, "structure.csv", &table));
    clast_table_free(&table);
    CLX_TRY(clast_assembly_radial_profile(r->body, NULL, RADIAL_BINS, &table));
    CLX_TRY(clx_run_write_table(folder, "radial.csv", &table));
done:
    clast_table_free(&table);
    return status;
}

/// sizes.csv; mergers of clusters place no sizes.
static clast_status write_sizes(const char *folder, const clx_folder_results *r)
{
    clast_status status = CLAST_OK;
    clast_table table = {0};
    if (r->config->params.mode == CLAST_AGGREGATE_CORE) {
        CLX_TRY(clast_aggregate_achieved(&r->config->params, r->sizes, r->history, &table));
        CLX_TRY(clx_run_write_table(folder, "sizes.csv", &table));
    }
done:
    clast_table_free(&table);
    return status;
}

clast_status clx_folder_write_results(const char *folder, const clx_folder_results *r)
{
    clast_status status = CLAST_OK;
    clast_table band = {0};
    CLX_TRY(clx_run_write_table(folder, "history.csv", r->history));
    if (r->report->n > 1) {
        CLX_TRY(clast_aggregate_band(r->history, r->report->confidence, &band));
        CLX_TRY(clx_run_write_table(folder, "history_band.csv", &band));
    }
    CLX_TRY(write_sizes(folder, r));
    CLX_TRY(write_structure(folder, r));
    CLX_TRY(write_stl(folder, r->first));
    CLX_TRY(clx_folder_write_pictures(folder, r));
    CLX_TRY(write_summary(folder, r->report));
    CLX_TRY(clx_folder_clear_checkpoints(folder));
done:
    clast_table_free(&band);
    return status;
}
