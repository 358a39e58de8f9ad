// Packings to state files and back. Beside what every state holds (docs/theory/state-file.md), the
// folder /pack has the process and the simulation, array by array.
#include "run/pack_state.h"

#include "base/alloc.h"
#include "io/bed_tables.h"
#include "io/state.h"
#include "pack/saved.h"
#include "run/checkpoint.h"
#include <clast/assembly.h>
#include <string.h>

enum { N_ARRAY = 17, MOST_TABLES = 8 };

typedef struct {
    const char *name;
    clx_h5_type type;
    int64_t n, width;
    void *data;
} array;

/// The arrays of a saved packing: pointers into it.
static int list_arrays(clx_pack_saved *s, array a[N_ARRAY])
{
    clx_dem_saved *d = &s->dem;
    int n = 0;
    a[n++] = (array){"/pack/count", CLX_H5_I64, CLX_PACK_COUNTS, 1, s->count};
    a[n++] = (array){"/pack/number", CLX_H5_F64, CLX_PACK_NUMBERS, 1, s->number};
    a[n++] = (array){"/pack/waiting", CLX_H5_I64, s->n_waiting, 2, s->waiting};
    a[n++] = (array){"/pack/shape", CLX_H5_I32, d->n_grain, 1, d->shape};
    a[n++] = (array){"/pack/grain", CLX_H5_F64, d->n_grain, CLX_SAVED_GRAIN, d->grain};
    a[n++] = (array){"/pack/anchor", CLX_H5_F64, d->n_known, CLX_SAVED_ANCHOR, d->anchor};
    a[n++] = (array){"/pack/link_id", CLX_H5_I32, d->n_pair, CLX_SAVED_ID, d->id};
    a[n++] = (array){"/pack/link", CLX_H5_F64, d->n_pair, CLX_SAVED_PAIR, d->pair};
    if (d->cell != NULL) {
        a[n++] = (array){"/pack/cell", CLX_H5_F64, CLX_SAVED_CELL, 1, d->cell};
    }
    if (s->has_stage) {
        a[n++] = (array){"/pack/stage", CLX_H5_F64, CLX_PACK_STAGE, 1, s->stage};
    }
    if (d->energy != NULL) {
        a[n++] = (array){"/pack/energy", CLX_H5_F64, d->n_energy, 1, d->energy};
    }
    if (d->wall != NULL) {
        a[n++] = (array){"/pack/wall", CLX_H5_F64, d->n_wall, CLX_SAVED_WALL, d->wall};
        a[n++] = (array){"/pack/wall_drive", CLX_H5_F64, s->n_wall, CLX_PACK_WALL, s->wall};
    }
    if (d->limit != NULL) {
        a[n++] = (array){"/pack/limit", CLX_H5_F64, d->n_known, 1, d->limit};
    }
    if (d->held != NULL) {
        a[n++] = (array){"/pack/held", CLX_H5_F64, d->n_grain, 1, d->held};
    }
    if (d->history != NULL) {
        a[n++] = (array){"/pack/extra", CLX_H5_F64, d->n_pair, CLX_SAVED_HISTORY, d->history};
    }
    if (d->warm_start != NULL) {
        a[n++] = (array){"/pack/memory", CLX_H5_U8, d->n_pair, d->warm_start_width, d->warm_start};
    }
    return n;
}

static clast_status write_pack(clx_h5 *h5, clx_pack_saved *s)
{
    clast_status status = CLAST_OK;
    array a[N_ARRAY];
    const int n = list_arrays(s, a);
    const int32_t is_due = s->dem.is_due ? 1 : 0;
    CLX_TRY(clx_h5_write_folder(h5, "/pack"));
    CLX_TRY(clx_h5_write_number(h5, "/pack", "step", CLX_H5_I64, &s->dem.step));
    CLX_TRY(clx_h5_write_number(h5, "/pack", "n_refresh", CLX_H5_I64, &s->dem.n_refresh));
    CLX_TRY(clx_h5_write_number(h5, "/pack", "is_due", CLX_H5_I32, &is_due));
    if (s->dem.verified[0] > 0.0) {
        const int64_t four[1] = {4};
        CLX_TRY(clx_h5_write(h5, "/pack/verified", CLX_H5_F64, 1, four, s->dem.verified));
    }
    for (int k = 0; k < n; ++k) {
        const int64_t shape[2] = {a[k].n, a[k].width};
        CLX_TRY(clx_h5_write(h5, a[k].name, a[k].type, a[k].width == 1 ? 1 : 2, shape, a[k].data));
    }
done:
    return status;
}

/// Velocities of the grains, in the order of the assembly.
static clast_status make_velocities(const clx_dem_saved *saved, clast_table *table)
{
    static const char *const name[3] = {"velocity_x_m/s", "velocity_y_m/s", "velocity_z_m/s"};
    clast_status status = CLAST_OK;
    CLX_TRY(clast_table_init(table, "velocities", saved->n_grain));
    for (int k = 0; k < 3; ++k) {
        double *column = NULL;
        CLX_TRY(clast_table_add_number(table, name[k], "m/s", &column));
        for (int64_t i = 0; i < saved->n_grain; ++i) {
            column[i] = saved->grain[i * CLX_SAVED_GRAIN + 3 + k];
        }
    }
done:
    return status;
}

static clast_status build(const char *config, clast_pack *pack, clx_h5 **h5)
{
    clast_status status = CLAST_OK;
    clx_pack_saved saved = {0};
    clast_assembly grains = {0};
    clast_table table[MOST_TABLES] = {{0}, {0}, {0}, {0}, {0}, {0}, {0}, {0}};
    clast_state state = {.assembly = &grains, .n_table = 4, .table = table};
    clx_h5 *made = NULL;
    const clast_bed bed = clast_pack_bed(pack);
    CLX_TRY(clx_pack_save(pack, &saved));
    CLX_TRY(clast_dem_assembly(pack->dem, &grains));
    saved.count[CLX_PACK_COUNTS - 1] = grains.n_shape;
    CLX_TRY(clx_alloc_text(&state.config, config));
    CLX_TRY(clast_bed_table(&bed, &table[0]));
    table[1] = *saved.series; // borrowed
    CLX_TRY(clast_dem_contact_table(pack->dem, &table[2]));
    CLX_TRY(make_velocities(&saved.dem, &table[3]));
    if (bed.kind == CLAST_BED_MESH) {
        CLX_TRY(clx_bed_surface_tables(bed.surface, &table[4]));
        state.n_table = 6;
    }
    if (saved.load != NULL) {
        table[state.n_table++] = *saved.load; // borrowed
    }
    if (saved.walls != NULL) {
        table[state.n_table++] = *saved.walls; // borrowed
    }
    CLX_TRY(clx_h5_create(&made));
    CLX_TRY(clx_state_write_to(made, &state));
    CLX_TRY(write_pack(made, &saved));
    *h5 = made;
    made = NULL;
done:
    clx_h5_close(made);
    clx_free(state.config);
    clast_table_free(&table[0]);
    const int n_own = bed.kind == CLAST_BED_MESH ? 6 : 4;
    for (int k = 2; k < n_own; ++k) {
        clast_table_free(&table[k]);
    }
    clast_assembly_free(&grains);
    clx_pack_saved_free(&saved);
    return status;
}

clast_status clx_pack_state_write(const char *path, const char *config, clast_pack *pack)
{
    clast_status status = CLAST_OK;
    clx_h5 *h5 = NULL;
    CLX_TRY(build(config, pack, &h5));
    CLX_TRY(clx_h5_commit(h5, path));
done:
    clx_h5_close(h5);
    return status;
}

clast_status clx_pack_checkpoint_write(const char *folder, const char *config, clast_pack *pack)
{
    clast_status status = CLAST_OK;
    clx_h5 *h5 = NULL;
    CLX_TRY(build(config, pack, &h5));
    CLX_TRY(clx_checkpoint_write(h5, folder, clast_dem_n_step(pack->dem)));
done:
    clx_h5_close(h5);
    return status;
}

void clx_pack_checkpoint_free(clx_pack_checkpoint *found)
{
    CLX_FREE(found->path, found->config);
    *found = (clx_pack_checkpoint){0};
}

/// The configuration of the packing in found->path.
static clast_status read_config(clx_pack_checkpoint *found)
{
    clast_status status = CLAST_OK;
    clx_h5 *h5 = NULL;
    CLX_TRY(clx_h5_open(found->path, &h5));
    CLX_TRY(clx_state_read_head(h5, NULL, NULL));
    CLX_CHECK(clx_h5_has(h5, "/pack"), CLAST_E_FORMAT, "%s is no checkpoint of a packing",
              found->path);
    CLX_TRY(clx_h5_read_text(h5, "/", "config", &found->config));
done:
    clx_h5_close(h5);
    return status;
}

clast_status clx_pack_checkpoint_find(const char *folder, clx_pack_checkpoint *found)
{
    clast_status status = CLAST_OK;
    int64_t step = 0;
    CLX_TRY(clx_checkpoint_newest(folder, &found->path, &step, &found->n_damaged));
    CLX_TRY(read_config(found));
done:
    return status;
}

clast_status clx_pack_end_find(const char *path, clx_pack_checkpoint *found)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_h5_verify(path));
    CLX_TRY(clx_alloc_text(&found->path, path));
    CLX_TRY(read_config(found));
done:
    return status;
}

/// Room for the arrays, as the file declares them.
static clast_status alloc_arrays(clx_h5 *h5, clx_pack_saved *s)
{
    clast_status status = CLAST_OK;
    clx_dem_saved *d = &s->dem;
    int64_t shape[2];
    CLX_TRY(clx_h5_shape(h5, "/pack/grain", CLX_H5_F64, 2, shape));
    d->n_grain = shape[0];
    CLX_TRY(clx_h5_shape(h5, "/pack/waiting", CLX_H5_I64, 2, shape));
    s->n_waiting = shape[0];
    CLX_TRY(clx_h5_shape(h5, "/pack/anchor", CLX_H5_F64, 2, shape));
    d->n_known = shape[0];
    CLX_TRY(clx_h5_shape(h5, "/pack/link", CLX_H5_F64, 2, shape));
    d->n_pair = shape[0];
    CLX_TRY(clx_alloc(&s->waiting, 2 * s->n_waiting, sizeof *s->waiting));
    CLX_TRY(clx_alloc(&d->shape, d->n_grain, sizeof *d->shape));
    CLX_TRY(clx_alloc(&d->grain, d->n_grain * CLX_SAVED_GRAIN, sizeof *d->grain));
    CLX_TRY(clx_alloc(&d->anchor, d->n_known * CLX_SAVED_ANCHOR, sizeof *d->anchor));
    CLX_TRY(clx_alloc(&d->id, d->n_pair * CLX_SAVED_ID, sizeof *d->id));
    CLX_TRY(clx_alloc(&d->pair, d->n_pair * CLX_SAVED_PAIR, sizeof *d->pair));
    s->has_stage = clx_h5_has(h5, "/pack/stage");
    if (clx_h5_has(h5, "/pack/cell")) {
        CLX_TRY(clx_alloc(&d->cell, CLX_SAVED_CELL, sizeof *d->cell));
    }
    if (clx_h5_has(h5, "/pack/energy")) {
        CLX_TRY(clx_h5_shape(h5, "/pack/energy", CLX_H5_F64, 1, shape));
        CLX_CHECK(shape[0] > 0 && shape[0] < 4096, CLAST_E_FORMAT,
                  "the checkpoint's energy is none");
        d->n_energy = shape[0];
        CLX_TRY(clx_alloc(&d->energy, d->n_energy, sizeof *d->energy));
    }
    if (clx_h5_has(h5, "/pack/wall")) {
        CLX_TRY(clx_h5_shape(h5, "/pack/wall", CLX_H5_F64, 2, shape));
        d->n_wall = shape[0];
        CLX_TRY(clx_h5_shape(h5, "/pack/wall_drive", CLX_H5_F64, 2, shape));
        s->n_wall = shape[0];
        CLX_CHECK(d->n_wall < INT32_MAX && s->n_wall < INT32_MAX, CLAST_E_FORMAT,
                  "the checkpoint's walls are none");
        CLX_TRY(clx_alloc(&d->wall, d->n_wall * CLX_SAVED_WALL, sizeof *d->wall));
        CLX_TRY(clx_alloc(&s->wall, s->n_wall * CLX_PACK_WALL, sizeof *s->wall));
    }
    if (clx_h5_has(h5, "/pack/limit")) {
        CLX_TRY(clx_alloc(&d->limit, d->n_known, sizeof *d->limit));
    }
    if (clx_h5_has(h5, "/pack/held")) {
        CLX_TRY(clx_alloc(&d->held, d->n_grain, sizeof *d->held));
    }
    if (clx_h5_has(h5, "/pack/extra")) {
        CLX_TRY(clx_alloc(&d->history, CLX_SAVED_HISTORY * d->n_pair, sizeof *d->history));
    }
    if (clx_h5_has(h5, "/pack/memory")) {
        CLX_TRY(clx_h5_shape(h5, "/pack/memory", CLX_H5_U8, 2, shape));
        CLX_CHECK(shape[0] == d->n_pair && shape[1] > 0 && shape[1] < 4096, CLAST_E_FORMAT,
                  "the checkpoint's warm starts do not match its links");
        d->warm_start_width = (int32_t)shape[1];
        CLX_TRY(clx_alloc(&d->warm_start, shape[0] * shape[1], 1));
    }
done:
    return status;
}

static clast_status read_pack(clx_h5 *h5, clx_pack_saved *s)
{
    clast_status status = CLAST_OK;
    array a[N_ARRAY];
    int32_t is_due = 0;
    CLX_TRY(alloc_arrays(h5, s));
    const int n = list_arrays(s, a);
    for (int k = 0; k < n; ++k) {
        const int64_t shape[2] = {a[k].n, a[k].width};
        CLX_TRY(clx_h5_read(h5, a[k].name, a[k].type, a[k].width == 1 ? 1 : 2, shape, a[k].data));
    }
    CLX_TRY(clx_h5_read_number(h5, "/pack", "step", CLX_H5_I64, &s->dem.step));
    CLX_TRY(clx_h5_read_number(h5, "/pack", "n_refresh", CLX_H5_I64, &s->dem.n_refresh));
    CLX_TRY(clx_h5_read_number(h5, "/pack", "is_due", CLX_H5_I32, &is_due));
    s->dem.is_due = is_due != 0;
    if (clx_h5_has(h5, "/pack/verified")) {
        const int64_t four[1] = {4};
        CLX_TRY(clx_h5_read(h5, "/pack/verified", CLX_H5_F64, 1, four, s->dem.verified));
    }
done:
    return status;
}

/// The container's file may have changed, too.
static clast_status check_container(const clast_state *state, const clast_pack *pack)
{
    clast_status status = CLAST_OK;
    clast_table now[2] = {{0}, {0}};
    const clast_bed bed = clast_pack_bed(pack);
    const clast_table *kept = clast_state_table(state, "container_vertices");
    const bool has_container = bed.kind == CLAST_BED_MESH;
    CLX_CHECK(has_container == (kept != NULL), CLAST_E_FORMAT,
              "the checkpoint was made with%s a container", kept != NULL ? "" : "out");
    if (has_container) {
        CLX_TRY(clx_bed_surface_tables(bed.surface, now));
        CLX_CHECK(kept->n_row == now[0].n_row, CLAST_E_FORMAT,
                  "the container is not the one that the checkpoint was made with");
        for (int c = 0; c < 3; ++c) {
            const double *x = clast_table_numbers(kept, now[0].column[c].name);
            CLX_CHECK(x != NULL &&
                          memcmp(x, now[0].column[c].number, (size_t)now[0].n_row * sizeof *x) == 0,
                      CLAST_E_FORMAT,
                      "the container is not the one that the checkpoint was made with");
        }
    }
done:
    clast_table_free(&now[0]);
    clast_table_free(&now[1]);
    return status;
}

clast_status clx_pack_checkpoint_read(const clx_pack_checkpoint *found, clast_pack *pack)
{
    clast_status status = CLAST_OK;
    clx_pack_saved saved = {0};
    clast_state state = {0};
    clx_h5 *h5 = NULL;
    CLX_TRY(clx_h5_open(found->path, &h5));
    CLX_TRY(read_pack(h5, &saved));
    clx_h5_close(h5);
    h5 = NULL;
    CLX_TRY(clast_state_read(found->path, &state));
    const clast_table *series = clast_state_table(&state, "series");
    CLX_CHECK(series != NULL && state.assembly != NULL &&
                  saved.count[CLX_PACK_COUNTS - 1] == state.assembly->n_shape,
              CLAST_E_FORMAT, "%s lacks its series or shapes", found->path);
    CLX_TRY(check_container(&state, pack));
    saved.series = series;
    saved.load = clast_state_table(&state, "load");
    saved.walls = clast_state_table(&state, "walls");
    saved.shape = state.assembly->shape;
    CLX_TRY(clx_pack_restore(pack, &saved));
done:
    if (status == CLAST_E_FORMAT) {
        clx_fail_prefix("%s", found->path);
    }
    clx_h5_close(h5);
    clx_pack_saved_free(&saved);
    clast_state_free(&state);
    return status;
}
