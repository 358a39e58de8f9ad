// What a run folder shows: charts, a picture, a printable body.
#include "study/aggregate_folder.h"

#include "base/alloc.h"
#include "base/file.h"
#include "base/number.h"
#include "base/path.h"
#include "geom/check.h"
#include "math/vec3.h"
#include <clast/assembly.h>
#include <clast/chart.h>
#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <clast/render.h>
#include <clast/table.h>

enum { PICTURE_WIDTH = 960, PICTURE_HEIGHT = 720 };

static clast_status write_picture(const char *folder, const clx_folder_results *r)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    clast_render_config config;
    clast_image image = {0};
    bool has_config = false;
    CLX_TRY(clast_fields_default(clast_render_fields, &config));
    has_config = true;
    config.width = PICTURE_WIDTH;
    config.height = PICTURE_HEIGHT;
    CLX_TRY(clast_render_assembly(r->first, &config, r->monitor, &image));
    CLX_TRY(clx_path_join(path, folder, "picture.png"));
    CLX_TRY(clast_image_write_png(&image, path));
done:
    if (has_config) {
        clast_fields_free(clast_render_fields, &config);
    }
    clast_image_free(&image);
    return status;
}

/// Reads back what was written: a printer takes nothing but one closed, outward surface.
static clast_status verify(const char *path)
{
    clast_status status = CLAST_OK;
    clast_mesh mesh = {0};
    clast_mesh_check_result found = {0};
    CLX_TRY(clast_mesh_read(path, &mesh, NULL));
    CLX_TRY(clx_check_without_cuts(&mesh, &found));
    CLX_CHECK(found.closed && found.oriented && found.manifold && found.n_part == 1,
              CLAST_E_GEOMETRY,
              "%s is not one closed, oriented surface (%d parts, %d open edges): choose a smaller "
              "spacing",
              path, found.n_part, found.n_open_edge);
done:
    clast_mesh_check_free(&found);
    clast_mesh_free(&mesh);
    return status;
}

/// printable.json: what the body can and cannot show.
static clast_status write_printable_report(const char *folder, const clast_printable_report *r,
                                           int64_t n_triangle)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    clx_file file = {0};
    CLX_TRY(clx_path_join(path, folder, "printable.json"));
    CLX_TRY(clx_file_begin(path, &file));
    CLX_TRY(clx_file_print(&file,
                           "{\n  \"smallest_feature\": %.17g,\n  \"resolved\": %s,\n"
                           "  \"neck\": %.17g,\n  \"spacing\": %.17g,\n",
                           r->smallest_feature, r->resolved ? "true" : "false", r->neck,
                           r->spacing));
    CLX_TRY(clx_file_print(&file,
                           "  \"n_part\": %d,\n  \"n_void_filled\": %d,\n"
                           "  \"void_volume\": %.17g,\n  \"solid_volume\": %.17g,\n"
                           "  \"volume\": %.17g,\n  \"n_triangle\": %lld\n}\n",
                           r->n_part, r->n_void, r->void_volume, r->solid_volume, r->volume,
                           (long long)n_triangle));
    CLX_TRY(clx_file_commit(&file));
done:
    clx_file_abandon(&file);
    return status;
}

/// Tells the size of the file before the work for it begins.
static clast_status announce(const clx_folder_results *r, const clast_printable_config *config)
{
    clast_status status = CLAST_OK;
    clast_printable_report plan = {0};
    char text[200];
    CLX_TRY(clast_assembly_printable_plan(r->first, config, &plan));
    if (r->monitor != NULL && r->monitor->note != NULL) {
        (void)clx_number_print(
            text, sizeof text,
            "printable.stl: about %.0f triangles, %.3g MB, at a spacing of %.3g um "
            "(--spacing)",
            plan.n_triangle_expected, 50e-6 * plan.n_triangle_expected, 1e6 * plan.spacing);
        r->monitor->note(r->monitor->context, text);
    }
done:
    return status;
}

static clast_status write_printable(const char *folder, const clx_folder_results *r)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    clast_mesh mesh = {0};
    clast_printable_report report;
    const clast_printable_config config = {.neck = r->config->neck, .spacing = r->config->spacing};
    const clast_mesh_write_options options = {.unit = "mm", .name = "printable"};
    const double none[3] = {0.0, 0.0, 0.0};
    const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    CLX_TRY(announce(r, &config));
    CLX_TRY(clast_assembly_printable(r->first, &config, r->monitor, &mesh, &report));
    clast_mesh_transform(&mesh, 1e3, unturned, none);
    CLX_TRY(clx_path_join(path, folder, "printable.stl"));
    CLX_TRY(clast_mesh_write(&mesh, path, &options));
    CLX_TRY(verify(path));
    CLX_TRY(clx_path_join(path, folder, "printable.3mf"));
    CLX_TRY(clast_mesh_write(&mesh, path, &options));
    CLX_TRY(write_printable_report(folder, &report, mesh.n_tri));
done:
    clast_mesh_free(&mesh);
    return status;
}

/// Sizes as they were wanted, for the chart that compares them with those placed.
static clast_status wanted_sizes(const clast_sizes *sizes, double replicate, clast_table *wanted)
{
    clast_status status = CLAST_OK;
    clast_table made = {0};
    double *column[3];
    static const char *const name[3] = {"low_m", "high_m", "count"};
    CLX_TRY(clast_table_init(&made, "wanted", sizes->n));
    for (int k = 0; k < 3; ++k) {
        CLX_TRY(clast_table_add_number(&made, name[k], k < 2 ? "m" : "-", NULL));
    }
    for (int k = 0; k < 3; ++k) {
        column[k] = made.column[k].number;
    }
    for (int64_t i = 0; i < sizes->n; ++i) {
        column[0][i] = sizes->low[i];
        column[1][i] = sizes->high[i];
        column[2][i] = replicate * sizes->count[i];
    }
    *wanted = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}

static clast_status write_charts(const char *folder, const clx_folder_results *r)
{
    clast_status status = CLAST_OK;
    clast_table wanted = {0};
    if (r->sizes != NULL) {
        CLX_TRY(wanted_sizes(r->sizes, r->config->params.replicate, &wanted));
    }
    CLX_TRY(clast_aggregate_charts_write(r->history, r->sizes != NULL ? &wanted : NULL, folder));
done:
    clast_table_free(&wanted);
    return status;
}

clast_status clx_folder_write_pictures(const char *folder, const clx_folder_results *r)
{
    clast_status status = CLAST_OK;
    CLX_TRY(write_charts(folder, r));
    if (r->config->picture) {
        CLX_TRY(write_picture(folder, r));
    }
    if (r->config->printable) {
        CLX_TRY(write_printable(folder, r));
    }
done:
    return status;
}
