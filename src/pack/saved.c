// Packings to plain arrays and back.
#include "pack/saved.h"

#include "base/alloc.h"
#include <math.h>
#include <string.h>

clast_status clx_pack_save(clast_pack *p, clx_pack_saved *saved)
{
    clast_status status = CLAST_OK;
    clx_pack_saved s = {.count = {p->phase, p->n_made, p->n_fill, p->fill_step, p->phase_step,
                                  p->converged ? 1 : 0, p->pending_form, p->pending_shape, 0},
                        .number = {p->mass, p->last_height, p->grain_steps},
                        .series = &p->series};
    CLX_TRY(clx_dem_save(p->dem, &s.dem));
    *saved = s;
done:
    return status;
}

static clast_status take_series(clast_pack *p, const clast_table *from)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(from->n_column == p->series.n_column, CLAST_E_FORMAT,
              "the checkpoint's time series has %d columns, not %d", from->n_column,
              p->series.n_column);
    CLX_TRY(clast_table_resize(&p->series, from->n_row));
    for (int32_t c = 0; c < from->n_column; ++c) {
        CLX_CHECK(from->column[c].number != NULL &&
                      strcmp(from->column[c].name, p->series.column[c].name) == 0,
                  CLAST_E_FORMAT, "column %d of the checkpoint's time series is not %s", c,
                  p->series.column[c].name);
        memcpy(p->series.column[c].number, from->column[c].number,
               (size_t)from->n_row * sizeof(double));
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

static bool is_same_shape(const clast_shape *a, const clast_shape *b)
{
    return a->kind == b->kind && strcmp(a->name, b->name) == 0 && a->volume == b->volume &&
           a->bounding_radius == b->bounding_radius && are_same(9, a->inertia[0], b->inertia[0]) &&
           are_same(3, a->semi_axes, b->semi_axes) && is_same_surface(&a->mesh, &b->mesh) &&
           is_same_clump(&a->spheres, &b->spheres);
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

clast_status clx_pack_restore(clast_pack *p, const clx_pack_saved *s)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(s->count[0] >= CLAST_PACK_GENERATE && s->count[0] <= CLAST_PACK_DONE &&
                  s->count[1] == s->dem.n_grain && s->count[2] >= 0 && s->count[2] <= INT32_MAX &&
                  s->count[8] >= p->input.n_shape && s->count[8] <= INT32_MAX &&
                  isfinite(s->number[0]) && isfinite(s->number[1]),
              CLAST_E_FORMAT, "the checkpoint's process is not one");
    CLX_TRY(check_shapes(p, s->shape));
    for (int64_t i = p->input.n_shape; i < s->count[8]; ++i) {
        int32_t id = 0;
        CLX_TRY(clast_dem_add_shape(p->dem, &s->shape[i], &id));
    }
    CLX_TRY(clx_dem_restore(p->dem, &s->dem));
    CLX_TRY(take_series(p, s->series));
    p->phase = (clast_pack_phase)s->count[0];
    p->n_made = s->count[1];
    p->n_fill = (int32_t)s->count[2];
    p->fill_step = s->count[3];
    p->phase_step = s->count[4];
    p->converged = s->count[5] != 0;
    p->pending_form = s->count[6];
    p->pending_shape = (int32_t)s->count[7];
    p->mass = s->number[0];
    p->last_height = s->number[1];
    p->grain_steps = s->number[2];
    clx_pack_drive(p);
done:
    return status;
}
