// Walls of a packing from their option: surfaces and tables of motion.
#include "io/wall_file.h"

#include "base/alloc.h"
#include "io/bed_tables.h"
#include "pack/walls.h"
#include <clast/table.h>
#include <math.h>

void clx_walls_unload(int32_t n, clast_pack_wall *wall)
{
    for (int32_t i = 0; wall != NULL && i < n; ++i) {
        clast_mesh_free(&wall[i].mesh);
        CLX_FREE(wall[i].motion.time, wall[i].motion.place);
    }
    clx_free(wall);
}

/// Rows time_s, and of x_m, y_m, z_m, angle_rad those that there are.
static clast_status read_table(const char *path, clast_dem_wall_motion *m)
{
    static const char *const name[] = {"x_m", "y_m", "z_m", "angle_rad"};
    clast_status status = CLAST_OK;
    clast_table table = {0};
    const double *column[4];
    int n_found = 0;
    CLX_TRY(clast_table_read_csv(path, NULL, &table, NULL));
    const double *time = clast_table_numbers(&table, "time_s");
    for (int k = 0; k < 4; ++k) {
        column[k] = clast_table_numbers(&table, name[k]);
        n_found += column[k] != NULL ? 1 : 0;
    }
    CLX_CHECK(time != NULL && n_found > 0 && n_found + 1 == table.n_column, CLAST_E_FORMAT,
              "%s: a table of motion has time_s, and of x_m, y_m, z_m and angle_rad those that "
              "change, no others",
              path);
    CLX_CHECK(table.n_row >= 2 && table.n_row <= INT32_MAX, CLAST_E_FORMAT,
              "%s: a table of motion has two rows at least", path);
    CLX_CHECK(column[3] == NULL || m->axis[0] != 0.0 || m->axis[1] != 0.0 || m->axis[2] != 0.0,
              CLAST_E_CONFIG, "%s has angles, and the wall no axis (axis 0,1,0)", path);
    CLX_TRY(clx_alloc(&m->time, table.n_row, sizeof *m->time));
    CLX_TRY(clx_alloc(&m->place, table.n_row, sizeof *m->place));
    for (int64_t i = 0; i < table.n_row; ++i) {
        m->time[i] = time[i];
        CLX_CHECK(isfinite(time[i]) && (i == 0 || time[i] > time[i - 1]), CLAST_E_FORMAT,
                  "%s: row %lld: times have to rise", path, (long long)i + 1);
        for (int k = 0; k < 4; ++k) {
            m->place[i][k] = column[k] != NULL ? column[k][i] : 0.0;
            CLX_CHECK(isfinite(m->place[i][k]), CLAST_E_FORMAT, "%s: row %lld: %s is no number",
                      path, (long long)i + 1, name[k]);
        }
    }
    m->n = (int32_t)table.n_row;
done:
    clast_table_free(&table);
    return status;
}

static clast_status load(const clast_pack_config *config, int32_t i, clast_pack_wall *out)
{
    clast_status status = CLAST_OK;
    clx_wall_words words;
    CLX_TRY(clx_wall_read(config, i, &words));
    *out = words.wall;
    if (words.file[0] != '\0') {
        CLX_TRY(clx_container_read(words.file, words.unit, &out->mesh));
    }
    if (words.table[0] != '\0') {
        CLX_TRY(read_table(words.table, &out->motion));
    }
done:
    return status;
}

clast_status clx_walls_load(const clast_pack_config *config, int32_t *n, clast_pack_wall **wall)
{
    clast_status status = CLAST_OK;
    clast_pack_wall *made = NULL;
    *n = 0;
    *wall = NULL;
    CLX_TRY(clx_alloc(&made, config->wall.n, sizeof *made));
    for (int32_t i = 0; i < config->wall.n; ++i) {
        CLX_TRY(load(config, i, &made[i]));
    }
    *n = config->wall.n;
    *wall = made;
    made = NULL;
done:
    clx_walls_unload(config->wall.n, made);
    return status;
}

const char *clx_walls_file(const clast_pack_config *config, int32_t i)
{
    static _Thread_local clx_wall_words words;
    for (int32_t k = 0; k < config->wall.n; ++k) {
        if (clx_wall_read(config, k, &words) != CLAST_OK) {
            continue;
        }
        if (words.file[0] != '\0' && i-- == 0) {
            return words.file;
        }
        if (words.table[0] != '\0' && i-- == 0) {
            return words.table;
        }
    }
    return NULL;
}
