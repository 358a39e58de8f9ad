// What a run folder shows: charts, a picture.
#include "study/aggregate_folder.h"

#include "base/path.h"
#include <clast/chart.h>
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
done:
    return status;
}
