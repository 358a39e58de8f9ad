// Cutting convex cells. Each face is a polygon with corners of its own; a cut clips every polygon
// [Sutherland1974] and closes the cell by the polygon of all new corners, sorted by angle, which is
// right because a section of a convex body is convex.
#include "geom/convex_cell.h"

#include "math/vec3.h"
#include <stdlib.h>
#include <string.h>

void clx_cell_box(const double low[3], const double high[3], clx_cell *cell)
{
    cell->n_face = 6;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        for (int side = 0; side < 2; ++side) {
            clx_cell_face *f = &cell->face[2 * axis + side];
            f->n = 4;
            f->mark = -(2 * axis + side) - 1;
            for (int k = 0; k < 4; ++k) {
                const int turn = side == 1 ? k : 3 - k; // outward
                f->corner[k][axis] = side == 1 ? high[axis] : low[axis];
                f->corner[k][u] = turn == 1 || turn == 2 ? high[u] : low[u];
                f->corner[k][v] = turn >= 2 ? high[v] : low[v];
            }
        }
    }
}

/// Corners where faces were cut, each twice (once from each side).
typedef struct {
    int32_t n;
    double at[2 * CLX_CELL_FACES][3];
} rim;

/// Clips one face; corners on the plane that the cut makes go to the rim.
static clast_status clip_face(clx_cell_face *f, const double normal[3], double offset, rim *cut)
{
    clast_status status = CLAST_OK;
    clx_cell_face made;
    made.n = 0;
    double height[CLX_CELL_CORNERS];
    for (int32_t k = 0; k < f->n; ++k) {
        height[k] = v3_dot(normal, f->corner[k]) - offset;
    }
    for (int32_t k = 0; k < f->n; ++k) {
        const int32_t next = k + 1 < f->n ? k + 1 : 0;
        CLX_CHECK(made.n + 2 <= CLX_CELL_CORNERS, CLAST_E_LIMIT,
                  "a cell's face has more than %d corners", CLX_CELL_CORNERS);
        if (height[k] <= 0.0) {
            v3_copy(made.corner[made.n++], f->corner[k]);
        }
        if ((height[k] <= 0.0) != (height[next] <= 0.0)) {
            const double t = height[k] / (height[k] - height[next]);
            double x[3];
            v3_sub(x, f->corner[next], f->corner[k]);
            v3_axpy(x, f->corner[k], t, x);
            v3_copy(made.corner[made.n++], x);
            if (cut->n < 2 * CLX_CELL_FACES) {
                v3_copy(cut->at[cut->n++], x);
            }
        }
    }
    made.n = made.n < 3 ? 0 : made.n;
    f->n = made.n;
    memcpy(f->corner, made.corner, (size_t)made.n * sizeof made.corner[0]);
done:
    return status;
}

typedef struct {
    double angle;
    int32_t corner;
} spoke;

static int by_angle(const void *a, const void *b)
{
    const double x = ((const spoke *)a)->angle;
    const double y = ((const spoke *)b)->angle;
    return (x > y) - (x < y);
}

/// The face that closes the cut.
static clast_status close_cut(clx_cell *cell, const double normal[3], int32_t mark, const rim *cut)
{
    clast_status status = CLAST_OK;
    double centre[3] = {0.0, 0.0, 0.0};
    double a[3];
    double b[3];
    spoke order[2 * CLX_CELL_FACES];
    clx_cell_face *f = &cell->face[cell->n_face];
    if (cut->n < 3) {
        return CLAST_OK;
    }
    CLX_CHECK(cell->n_face < CLX_CELL_FACES, CLAST_E_LIMIT, "a cell has more than %d faces",
              CLX_CELL_FACES);
    for (int32_t k = 0; k < cut->n; ++k) {
        v3_axpy(centre, centre, 1.0 / cut->n, cut->at[k]);
    }
    v3_frame(normal, a, b);
    for (int32_t k = 0; k < cut->n; ++k) {
        double d[3];
        v3_sub(d, cut->at[k], centre);
        order[k] = (spoke){atan2(v3_dot(d, b), v3_dot(d, a)), k};
    }
    qsort(order, (size_t)cut->n, sizeof *order, by_angle);
    f->n = 0;
    f->mark = mark;
    for (int32_t k = 0; k < cut->n; ++k) {
        const double *x = cut->at[order[k].corner];
        if (f->n > 0 && v3_distance2(x, f->corner[f->n - 1]) == 0.0) {
            continue; // the same corner from the other side
        }
        CLX_CHECK(f->n < CLX_CELL_CORNERS, CLAST_E_LIMIT, "a cell's face has more than %d corners",
                  CLX_CELL_CORNERS);
        v3_copy(f->corner[f->n++], x);
    }
    cell->n_face += f->n >= 3;
done:
    return status;
}

clast_status clx_cell_cut(clx_cell *cell, const double normal[3], double offset, int32_t mark)
{
    clast_status status = CLAST_OK;
    rim cut = {0};
    double unit[3];
    int32_t n = 0;
    const double length = v3_norm(normal);
    if (length == 0.0) {
        return CLAST_OK;
    }
    v3_scale(unit, 1.0 / length, normal);
    for (int32_t i = 0; i < cell->n_face; ++i) {
        CLX_TRY(clip_face(&cell->face[i], unit, offset / length, &cut));
    }
    for (int32_t i = 0; i < cell->n_face; ++i) {
        if (cell->face[i].n > 0) {
            clx_cell_face *to = &cell->face[n];
            const clx_cell_face *from = &cell->face[i];
            if (n != i) {
                to->n = from->n;
                to->mark = from->mark;
                memcpy(to->corner, from->corner, (size_t)from->n * sizeof from->corner[0]);
            }
            ++n;
        }
    }
    cell->n_face = n;
    CLX_TRY(close_cut(cell, unit, mark, &cut));
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
    double reach = 0.0;
    for (int32_t i = 0; i < cell->n_face; ++i) {
        for (int32_t k = 0; k < cell->face[i].n; ++k) {
            reach = fmax(reach, v3_norm2(cell->face[i].corner[k]));
        }
    }
    return reach;
}
