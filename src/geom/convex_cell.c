// Cutting convex cells. Each face is a polygon with corners of its own; a cut clips every polygon
// [Sutherland1974] and closes the cell by the polygon of all new corners, sorted by angle, which is
// right because a section of a convex body is convex.
#include "geom/convex_cell.h"

#include "base/alloc.h"
#include "math/sort.h"
#include "math/vec3.h"
#include <stdlib.h>

typedef struct clx_cell_spoke {
    double angle;
    int32_t corner;
} spoke;

static clast_status append_corner(clx_cell_face *f, const double x[3])
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_grow(&f->corner, &f->capacity, (int64_t)f->n + 1, sizeof *f->corner));
    v3_copy(f->corner[f->n++], x);
done:
    return status;
}

/// An empty face after the last one, which counts once it is whole.
static clast_status begin_face(clx_cell *cell, int32_t mark, clx_cell_face **face)
{
    clast_status status = CLAST_OK;
    CLX_TRY(
        clx_grow(&cell->face, &cell->face_capacity, (int64_t)cell->n_face + 1, sizeof *cell->face));
    if (cell->n_face == cell->n_made) {
        cell->face[cell->n_made++] = (clx_cell_face){0};
    }
    *face = &cell->face[cell->n_face];
    (*face)->n = 0;
    (*face)->mark = mark;
done:
    return status;
}

void clx_cell_free(clx_cell *cell)
{
    for (int64_t i = 0; i < cell->n_made; ++i) {
        clx_free(cell->face[i].corner);
    }
    CLX_FREE(cell->face, cell->clipped.corner, cell->rim.corner, cell->height, cell->spoke);
    *cell = (clx_cell){0};
}

clast_status clx_cell_box(const double low[3], const double high[3], clx_cell *cell)
{
    CLAST_ASSERT(low[0] <= high[0] && low[1] <= high[1] && low[2] <= high[2]);
    clast_status status = CLAST_OK;
    cell->n_face = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        for (int side = 0; side < 2; ++side) {
            clx_cell_face *f = NULL;
            CLX_TRY(begin_face(cell, -(2 * axis + side) - 1, &f));
            for (int k = 0; k < 4; ++k) {
                const int corner = side == 1 ? k : 3 - k; // outward
                double x[3];
                x[axis] = side == 1 ? high[axis] : low[axis];
                x[u] = corner == 1 || corner == 2 ? high[u] : low[u];
                x[v] = corner >= 2 ? high[v] : low[v];
                CLX_TRY(append_corner(f, x));
            }
            ++cell->n_face;
        }
    }
done:
    return status;
}

static void swap_corners(clx_cell_face *a, clx_cell_face *b)
{
    const clx_cell_face kept = *a;
    *a = *b;
    *b = kept;
}

/// Clips one face; corners on the plane that the cut makes go to the rim.
static clast_status clip_face(clx_cell *cell, clx_cell_face *f, const double normal[3],
                              double offset)
{
    CLAST_ASSERT(f->n >= 3);
    clast_status status = CLAST_OK;
    clx_cell_face *made = &cell->clipped;
    CLX_TRY(clx_grow(&cell->height, &cell->height_capacity, f->n, sizeof *cell->height));
    const double *height = cell->height;
    for (int32_t k = 0; k < f->n; ++k) {
        cell->height[k] = v3_dot(normal, f->corner[k]) - offset;
    }
    made->n = 0;
    made->mark = f->mark;
    for (int32_t k = 0; k < f->n; ++k) {
        const int32_t next = k + 1 < f->n ? k + 1 : 0;
        if (height[k] <= 0.0) {
            CLX_TRY(append_corner(made, f->corner[k]));
        }
        if ((height[k] <= 0.0) != (height[next] <= 0.0)) {
            const double t = height[k] / (height[k] - height[next]);
            double x[3];
            v3_sub(x, f->corner[next], f->corner[k]);
            v3_axpy(x, f->corner[k], t, x);
            CLX_TRY(append_corner(made, x));
            CLX_TRY(append_corner(&cell->rim, x));
        }
    }
    made->n = made->n < 3 ? 0 : made->n;
    swap_corners(f, made);
done:
    return status;
}

CLX_RISING(by_angle, spoke, angle)

/// The face that closes the cut.
static clast_status close_cut(clx_cell *cell, const double normal[3], int32_t mark)
{
    clast_status status = CLAST_OK;
    const clx_cell_face *cut = &cell->rim;
    double centre[3] = {0.0, 0.0, 0.0};
    double a[3];
    double b[3];
    clx_cell_face *f = NULL;
    if (cut->n < 3) {
        return CLAST_OK;
    }
    CLX_TRY(begin_face(cell, mark, &f));
    CLX_TRY(clx_grow(&cell->spoke, &cell->spoke_capacity, cut->n, sizeof *cell->spoke));
    for (int32_t k = 0; k < cut->n; ++k) {
        v3_axpy(centre, centre, 1.0 / cut->n, cut->corner[k]);
    }
    v3_frame(normal, a, b);
    for (int32_t k = 0; k < cut->n; ++k) {
        double d[3];
        v3_sub(d, cut->corner[k], centre);
        cell->spoke[k] = (spoke){atan2(v3_dot(d, b), v3_dot(d, a)), k};
    }
    qsort(cell->spoke, (size_t)cut->n, sizeof *cell->spoke, by_angle);
    for (int32_t k = 0; k < cut->n; ++k) {
        const double *x = cut->corner[cell->spoke[k].corner];
        if (f->n > 0 && v3_distance2(x, f->corner[f->n - 1]) == 0.0) {
            continue; // the same corner from the other side
        }
        CLX_TRY(append_corner(f, x));
    }
    cell->n_face += f->n >= 3;
done:
    return status;
}

clast_status clx_cell_cut(clx_cell *cell, const double normal[3], double offset, int32_t mark)
{
    clast_status status = CLAST_OK;
    double unit[3];
    int32_t n = 0;
    const double length = v3_norm(normal);
    if (length == 0.0) {
        return CLAST_OK;
    }
    v3_scale(unit, 1.0 / length, normal);
    cell->rim.n = 0;
    for (int32_t i = 0; i < cell->n_face; ++i) {
        CLX_TRY(clip_face(cell, &cell->face[i], unit, offset / length));
    }
    for (int32_t i = 0; i < cell->n_face; ++i) {
        if (cell->face[i].n > 0) {
            if (n != i) {
                swap_corners(&cell->face[n], &cell->face[i]);
            }
            ++n;
        }
    }
    cell->n_face = n;
    CLX_TRY(close_cut(cell, unit, mark));
done:
    return status;
}

double clx_cell_volume(const clx_cell *cell)
{
    double sum = 0.0;
    for (int32_t i = 0; i < cell->n_face; ++i) {
        const clx_cell_face *f = &cell->face[i];
        for (int32_t k = 1; k + 1 < f->n; ++k) {
            double cross[3];
            v3_cross(cross, f->corner[k], f->corner[k + 1]);
            sum += v3_dot(f->corner[0], cross);
        }
    }
    return sum / 6.0;
}

double clx_cell_reach2(const clx_cell *cell)
{
    double radius2 = 0.0;
    for (int32_t i = 0; i < cell->n_face; ++i) {
        for (int32_t k = 0; k < cell->face[i].n; ++k) {
            radius2 = fmax(radius2, v3_norm2(cell->face[i].corner[k]));
        }
    }
    return radius2;
}
