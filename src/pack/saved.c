// Packings to plain arrays and back.
#include "pack/saved.h"

#include "base/alloc.h"
#include "math/vec3.h"
#include "pack/load.h"
#include "pack/walls.h"
#include <clast/shape.h>
#include <math.h>
#include <string.h>

void clx_pack_saved_free(clx_pack_saved *saved)
{
    clx_dem_saved_free(&saved->dem);
    CLX_FREE(saved->waiting, saved->wall);
    *saved = (clx_pack_saved){0};
}

static clast_status save_walls(const clast_pack *p, clx_pack_saved *s)
{
    clast_status status = CLAST_OK;
    if (s->walls == NULL) {
        return CLAST_OK;
    }
    s->n_wall = p->n_wall + p->n_outlet + 1;
    CLX_TRY(clx_alloc(&s->wall, s->n_wall * CLX_PACK_WALL, sizeof *s->wall));
    double *x = s->wall;
    for (int32_t i = 0; i < p->n_wall; ++i, x += CLX_PACK_WALL) {
        x[0] = p->wall[i].steady;
        v3_copy(x + 1, p->wall[i].impulse);
        v3_copy(x + 4, p->wall[i].begun);
        v3_copy(x + 7, p->wall[i].row);
        v3_copy(x + 10, p->wall[i].row + 3);
    }
    for (int32_t i = 0; i < p->n_outlet; ++i, x += CLX_PACK_WALL) {
        x[0] = (double)p->outlet[i].n;
        x[1] = p->outlet[i].mass;
    }
    x[0] = (double)p->walls_looked;
    x[1] = (double)p->walls_row;
    x[2] = p->mass_left;
done:
    return status;
}

clast_status clx_pack_save(clast_pack *p, clx_pack_saved *saved)
{
    clast_status status = CLAST_OK;
    clx_pack_saved s = {.count = {p->phase, p->n_made, p->n_fill, p->fill_step, p->phase_step,
                                  p->converged ? 1 : 0, p->n_drawn, p->n_waited, 0},
                        .number = {p->mass, p->last_height, p->grain_steps, p->drawn_mass},
                        .stage = {(double)p->load.stage, (double)p->load.begun, p->load.strain[0],
                                  p->load.strain[1], p->load.strain[2], p->load.sheared,
                                  p->load.steady[0], p->load.steady[1], p->load.steady[2],
                                  (double)p->n_overlap, p->deepest, p->load.steady[3]},
                        .has_stage = p->config.stages.n > 0 || p->input.start != NULL,
                        .walls = clast_pack_wall_table(p),
                        .load = clast_pack_load_table(p),
                        .n_waiting = p->n_waiting,
                        .series = &p->series};
    CLX_TRY(clx_alloc(&s.waiting, 2 * s.n_waiting, sizeof *s.waiting));
    for (int64_t i = 0; i < s.n_waiting; ++i) {
        s.waiting[2 * i] = p->waiting[i].index;
        s.waiting[2 * i + 1] = p->waiting[i].form;
    }
    CLX_TRY(save_walls(p, &s));
    CLX_TRY(clx_dem_save(p->dem, &s.dem));
    *saved = s;
    s = (clx_pack_saved){0};
done:
    clx_pack_saved_free(&s);
    return status;
}

static clast_status restore_rows(clast_table *to, const clast_table *from)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(from->n_column == to->n_column, CLAST_E_FORMAT,
              "the checkpoint's time series has %d columns, not %d", from->n_column, to->n_column);
    CLX_TRY(clast_table_resize(to, from->n_row));
    for (int32_t c = 0; c < from->n_column; ++c) {
        CLX_CHECK(from->column[c].number != NULL &&
                      strcmp(from->column[c].name, to->column[c].name) == 0,
                  CLAST_E_FORMAT, "column %d of the checkpoint's time series is not %s", c,
                  to->column[c].name);
        for (int64_t i = 0; i < from->n_row; ++i) {
            to->column[c].number[i] = from->column[c].number[i];
            CLX_CHECK(isfinite(from->column[c].number[i]), CLAST_E_FORMAT,
                      "row %lld of the checkpoint's time series: %s is not finite", (long long)i,
                      from->column[c].name);
        }
    }
done:
    return status;
}

static bool are_same(int64_t n, const double *a, const double *b)
{
    for (int64_t i = 0; i < n; ++i) {
        if (!(a[i] == b[i])) {
            return false;
        }
    }
    return true;
}

static bool is_same_surface(const clast_mesh *a, const clast_mesh *b)
{
    if (a->n_vert != b->n_vert || a->n_tri != b->n_tri) {
        return false;
    }
    return a->n_tri == 0 || (are_same(3LL * a->n_vert, a->vert[0], b->vert[0]) &&
                             memcmp(a->tri, b->tri, (size_t)a->n_tri * sizeof *a->tri) == 0);
}

static bool is_same_clump(const clast_spheres *a, const clast_spheres *b)
{
    return a->n == b->n && (a->n == 0 || (are_same(3LL * a->n, a->centre[0], b->centre[0]) &&
                                          are_same(a->n, a->radius, b->radius)));
}

static bool are_same_parts(const clast_parts *a, const clast_parts *b)
{
    bool same = a->n == b->n;
    for (int32_t i = 0; i < a->n && same; ++i) {
        const clast_part *p = &a->part[i];
        const clast_part *q = &b->part[i];
        same = p->kind == q->kind && are_same(3, p->semi_axes, q->semi_axes) &&
               are_same(3, p->position, q->position) &&
               are_same(4, p->orientation, q->orientation) && p->vert[1] == q->vert[1] &&
               p->tri[1] == q->tri[1];
    }
    return same;
}

static bool is_same_material(const clast_material *a, const clast_material *b)
{
    return a->is_mixed == b->is_mixed &&
           (!a->is_mixed || (a->density == b->density && are_same(3, a->centre, b->centre) &&
                             are_same(9, a->inertia[0], b->inertia[0])));
}

static bool is_same_shape(const clast_shape *a, const clast_shape *b)
{
    return a->kind == b->kind && strcmp(a->name, b->name) == 0 && a->volume == b->volume &&
           a->bounding_radius == b->bounding_radius && are_same(9, a->inertia[0], b->inertia[0]) &&
           are_same(3, a->semi_axes, b->semi_axes) && is_same_surface(&a->mesh, &b->mesh) &&
           is_same_clump(&a->spheres, &b->spheres) && are_same_parts(&a->parts, &b->parts) &&
           is_same_material(&a->own, &b->own);
}

/// The files of shapes may have changed since.
static clast_status check_shapes(const clast_pack *p, const clast_shape *shape)
{
    clast_status status = CLAST_OK;
    for (int32_t i = 0; shape != NULL && i < p->input.n_shape; ++i) {
        CLX_CHECK(is_same_shape(&p->input.shape[i], &shape[i]), CLAST_E_FORMAT,
                  "shape %d (%s) is not the one that the checkpoint was made with (%s): its file "
                  "or its options have changed; put the old one back, or begin anew",
                  i + 1, p->input.shape[i].name, shape[i].name);
    }
done:
    return status;
}

/// Grains that wait: numbers that rise, forms that are there.
static clast_status restore_waiting(clast_pack *p, const clx_pack_saved *s)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_grow(&p->waiting, &p->waiting_capacity, s->n_waiting + 1, sizeof *p->waiting));
    for (int64_t i = 0; i < s->n_waiting; ++i) {
        const int64_t *w = &s->waiting[2 * i];
        CLX_CHECK(
            w[0] > (i > 0 ? w[-2] : -1) && w[0] < s->count[6] &&
                (p->config.form_law ? w[1] >= p->input.n_shape && w[1] < s->count[8] : w[1] == -1),
            CLAST_E_FORMAT, "grain %lld of the checkpoint cannot wait", (long long)w[0]);
        p->waiting[i] = (clx_pack_number){w[0], (int32_t)w[1]};
    }
    p->n_waiting = (int32_t)s->n_waiting;
done:
    return status;
}

/// Where the stages of a load are.
static clast_status restore_load(clast_pack *p, const clx_pack_saved *s)
{
    clast_status status = CLAST_OK;
    const bool has_stage = p->config.stages.n > 0;
    CLX_CHECK(clx_pack_has_load(&p->config) == (s->load != NULL), CLAST_E_FORMAT,
              "the checkpoint lacks the rows of load.csv");
    if (s->load != NULL) {
        CLX_TRY(restore_rows(&p->load.table, s->load));
    }
    CLX_CHECK(!has_stage ||
                  (s->stage[0] >= 0.0 && s->stage[0] < p->config.stages.n && s->stage[1] >= 0.0 &&
                   s->stage[1] < 9e15 && v3_is_finite(s->stage + 2) && isfinite(s->stage[5]) &&
                   v3_is_finite(s->stage + 6) && isfinite(s->stage[11])),
              CLAST_E_FORMAT, "the checkpoint's stage is none");
    p->load.stage = has_stage ? (int32_t)s->stage[0] : 0;
    p->load.begun = has_stage ? (int64_t)s->stage[1] : 0;
    v3_copy(p->load.strain, s->stage + 2);
    p->load.sheared = s->stage[5];
    v3_copy(p->load.steady, s->stage + 6);
    p->load.steady[3] = s->stage[11];
    CLX_CHECK(s->stage[9] >= 0.0 && s->stage[9] < 9e15 && s->stage[10] >= 0.0, CLAST_E_FORMAT,
              "the checkpoint's start is none");
    p->n_overlap = (int64_t)s->stage[9];
    p->deepest = s->stage[10];
done:
    return status;
}

static clast_status restore_walls(clast_pack *p, const clx_pack_saved *s)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(clx_pack_has_walls(&p->config) == (s->wall != NULL && s->walls != NULL) &&
                  (s->wall == NULL || s->n_wall == p->n_wall + p->n_outlet + 1),
              CLAST_E_FORMAT, "the checkpoint's walls are of another configuration");
    for (int64_t k = 0; k < s->n_wall * CLX_PACK_WALL; ++k) {
        CLX_CHECK(isfinite(s->wall[k]) && fabs(s->wall[k]) < 9e15, CLAST_E_FORMAT,
                  "wall %lld of the checkpoint is none", (long long)(k / CLX_PACK_WALL));
    }
    if (s->wall == NULL) {
        return CLAST_OK;
    }
    const double *x = s->wall;
    CLX_TRY(restore_rows(&p->walls, s->walls));
    for (int32_t i = 0; i < p->n_wall; ++i, x += CLX_PACK_WALL) {
        p->wall[i].steady = x[0];
        v3_copy(p->wall[i].impulse, x + 1);
        v3_copy(p->wall[i].begun, x + 4);
        v3_copy(p->wall[i].row, x + 7);
        v3_copy(p->wall[i].row + 3, x + 10);
    }
    for (int32_t i = 0; i < p->n_outlet; ++i, x += CLX_PACK_WALL) {
        CLX_CHECK(x[0] >= 0.0 && x[1] >= 0.0, CLAST_E_FORMAT, "outlet %d of the checkpoint is none",
                  i + 1);
        p->outlet[i].n = (int64_t)x[0];
        p->outlet[i].mass = x[1];
        p->n_left += p->outlet[i].n;
    }
    p->walls_looked = (int64_t)x[0];
    p->walls_row = (int64_t)x[1];
    p->mass_left = x[2];
done:
    return status;
}

clast_status clx_pack_restore(clast_pack *p, const clx_pack_saved *s)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(s->count[0] >= CLAST_PACK_GENERATE && s->count[0] <= CLAST_PACK_LOAD &&
                  s->count[1] >= s->dem.n_grain && s->count[2] >= 0 && s->count[2] <= INT32_MAX &&
                  s->count[8] >= p->input.n_shape && s->count[8] <= INT32_MAX &&
                  s->n_waiting <= INT32_MAX && s->count[6] == s->count[1] + s->n_waiting &&
                  s->count[7] >= 0 && isfinite(s->number[0]) && isfinite(s->number[1]) &&
                  isfinite(s->number[2]) && isfinite(s->number[3]),
              CLAST_E_FORMAT, "the checkpoint's process is not one");
    CLX_TRY(check_shapes(p, s->shape));
    for (int64_t i = p->input.n_shape; i < s->count[8]; ++i) {
        int32_t id = 0;
        CLX_TRY(clast_dem_add_shape(p->dem, &s->shape[i], &id));
    }
    CLX_TRY(clx_dem_restore(p->dem, &s->dem));
    CLX_TRY(restore_rows(&p->series, s->series));
    CLX_TRY(restore_load(p, s));
    CLX_TRY(restore_walls(p, s));
    CLX_CHECK(s->count[1] == s->dem.n_grain + p->n_left, CLAST_E_FORMAT,
              "the checkpoint has %lld grains, %lld that left, of %lld", (long long)s->dem.n_grain,
              (long long)p->n_left, (long long)s->count[1]);
    CLX_TRY(restore_waiting(p, s));
    p->phase = (clast_pack_phase)s->count[0];
    p->n_made = s->count[1];
    p->n_fill = (int32_t)s->count[2];
    p->fill_step = s->count[3];
    p->phase_step = s->count[4];
    p->converged = s->count[5] != 0;
    p->n_drawn = s->count[6];
    p->n_waited = s->count[7];
    p->mass = s->number[0];
    p->last_height = s->number[1];
    p->grain_steps = s->number[2];
    p->drawn_mass = s->number[3];
    clx_pack_drive(p);
done:
    return status;
}
