// Volumes of cut cells, without a tolerance and without asking what is inside.
//
// A closed outward surface is the sum of the prisms between its triangles and the plane x = -inf,
// each with the sign of its normal's x: of the points of a line along x, those below a facet that
// looks up count +1 and those below one that looks down -1. So a piece of a triangle in a bin adds
// the prism below it in this bin, and its shadow times the thickness to every bin below. All sums
// over bins telescope to the volume of the whole.
#include "geom/cut_volume.h"

#include "base/alloc.h"
#include "geom/bvh.h"
#include <math.h>
#include <string.h>

enum { MOST_CORNER = 10 }; ///< 3 and one more for each of six planes
static const double SNAP = 1e-12;

typedef struct {
    int n;
    double p[MOST_CORNER][3];
} piece;

/// What of `in` has side * (coordinate - plane) >= 0.
static void cut(const piece *in, int axis, double plane, double side, piece *out)
{
    CLAST_ASSERT(in->n >= 0 && in->n < MOST_CORNER && axis >= 0 && axis < 3);
    out->n = 0;
    for (int i = 0; i < in->n; ++i) {
        const double *a = in->p[i];
        const double *b = in->p[(i + 1) % in->n];
        const double da = side * (a[axis] - plane);
        const double db = side * (b[axis] - plane);
        if (da >= 0.0) {
            memcpy(out->p[out->n++], a, sizeof in->p[0]);
        }
        if ((da > 0.0 && db < 0.0) || (da < 0.0 && db > 0.0)) {
            const double t = da / (da - db);
            for (int k = 0; k < 3; ++k) {
                out->p[out->n][k] = a[k] + t * (b[k] - a[k]);
            }
            out->p[out->n++][axis] = plane;
        }
    }
}

/// The part between two planes; false when nothing with an area is left.
static bool slab(const piece *in, int axis, double low, double high, piece *out)
{
    piece half;
    cut(in, axis, low, 1.0, &half);
    if (half.n >= 3) {
        cut(&half, axis, high, -1.0, out);
    }
    return half.n >= 3 && out->n >= 3;
}

/// Signed area of the shadow along x, and the integral of x over it.
static double shadow(const piece *s, double *moment)
{
    CLAST_ASSERT(s->n >= 3);
    const double *a = s->p[0];
    double area = 0.0;
    *moment = 0.0;
    for (int i = 1; i + 1 < s->n; ++i) {
        const double *b = s->p[i];
        const double *c = s->p[i + 1];
        const double part = 0.5 * ((b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]));
        area += part;
        *moment += part * (a[0] + b[0] + c[0]) / 3.0;
    }
    return area;
}

/// First and last bin along an axis that the piece reaches; flat pieces have one.
static void span(const piece *s, int axis, int32_t nb, int32_t range[2])
{
    CLAST_ASSERT(s->n > 0 && nb > 0);
    double low = s->p[0][axis];
    double high = low;
    for (int i = 1; i < s->n; ++i) {
        low = fmin(low, s->p[i][axis]);
        high = fmax(high, s->p[i][axis]);
    }
    range[0] = (int32_t)fmin(fmax(floor(low), 0.0), nb - 1.0);
    range[1] = (int32_t)fmin(fmax(ceil(high) - 1.0, range[0]), nb - 1.0);
}

typedef struct {
    const clx_cut_grid *grid;
    double *inside; ///< prisms in their own bin [volume of a bin]
    double *below;  ///< shadows that cover all bins below
} sums;

/// A piece within one column of bins.
static void add_column(const sums *s, const piece *column, int64_t at, int64_t stride)
{
    CLAST_ASSERT(at >= 0 && at < stride);
    int32_t range[2];
    span(column, 0, s->grid->nb[0], range);
    for (int32_t i = range[0]; i <= range[1]; ++i) {
        piece part;
        double moment = 0.0;
        if (slab(column, 0, i, i + 1.0, &part)) {
            const double area = shadow(&part, &moment);
            s->inside[i * stride + at] += moment - i * area;
            s->below[i * stride + at] += area;
        }
    }
}

static void add_triangle(const sums *s, const piece *triangle)
{
    const int32_t *nb = s->grid->nb;
    int32_t y[2];
    int32_t z[2];
    double moment = 0.0;
    if (shadow(triangle, &moment) == 0.0) {
        return;
    }
    span(triangle, 1, nb[1], y);
    for (int32_t j = y[0]; j <= y[1]; ++j) {
        piece row;
        if (!slab(triangle, 1, j, j + 1.0, &row)) {
            continue;
        }
        span(&row, 2, nb[2], z);
        for (int32_t k = z[0]; k <= z[1]; ++k) {
            piece column;
            if (slab(&row, 2, k, k + 1.0, &column)) {
                add_column(s, &column, (int64_t)j * nb[2] + k, (int64_t)nb[1] * nb[2]);
            }
        }
    }
}

/// Corners in units of bins.
static piece in_bins(double corner[3][3], const clx_cut_grid *grid)
{
    piece s = {.n = 3};
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            s.p[i][k] =
                (corner[i][k] - grid->low[k]) / (grid->high[k] - grid->low[k]) * grid->nb[k];
        }
    }
    return s;
}

static double snapped(double share)
{
    return share < SNAP ? 0.0 : share > 1.0 - SNAP ? 1.0 : share;
}

clast_status clx_cut_grid_shares(const clast_mesh *mesh, const clx_cut_grid *grid, double *share)
{
    CLAST_ASSERT(grid->nb[0] > 0 && grid->nb[1] > 0 && grid->nb[2] > 0);
    clast_status status = CLAST_OK;
    const int64_t stride = (int64_t)grid->nb[1] * grid->nb[2];
    const int64_t n_bin = stride * grid->nb[0];
    sums s = {.grid = grid, .inside = share};
    CLX_TRY(clx_alloc(&s.below, n_bin, sizeof *s.below));
    memset(share, 0, (size_t)n_bin * sizeof *share);
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        double corner[3][3];
        for (int i = 0; i < 3; ++i) {
            memcpy(corner[i], mesh->vert[mesh->tri[t][i]], sizeof corner[i]);
        }
        const piece triangle = in_bins(corner, grid);
        add_triangle(&s, &triangle);
    }
    for (int64_t b = n_bin - stride - 1; b >= 0; --b) { // what the bins above cast down
        s.inside[b] += s.below[b + stride];
        s.below[b] += s.below[b + stride];
    }
    for (int64_t b = 0; b < n_bin; ++b) {
        CLX_CHECK(share[b] > -1e-6 && share[b] < 1.0 + 1e-6, CLAST_E_GEOMETRY,
                  "the surface encloses a point %.3g times: parts overlap or are turned inside "
                  "out; see clast mesh check",
                  share[b]);
        share[b] = snapped(share[b]);
    }
done:
    clx_free(s.below);
    return status;
}

static bool reaches_above(const piece *s)
{
    bool above = false;
    for (int i = 0; i < s->n; ++i) {
        above = above || s->p[i][0] > 1.0;
    }
    return above;
}

/// What a triangle adds to the box that is the unit cube here.
static double below_triangle(const piece *triangle)
{
    piece row;
    piece column;
    piece part;
    double moment = 0.0;
    double sum = 0.0;
    if (shadow(triangle, &moment) == 0.0 || !slab(triangle, 1, 0.0, 1.0, &row) ||
        !slab(&row, 2, 0.0, 1.0, &column)) {
        return 0.0;
    }
    if (slab(&column, 0, 0.0, 1.0, &part)) {
        (void)shadow(&part, &moment);
        sum += moment;
    }
    cut(&column, 0, 1.0, 1.0, &part); // a facet in the plane x = 1 has been counted
    return part.n >= 3 && reaches_above(&part) ? sum + shadow(&part, &moment) : sum;
}

double clx_cut_box_share(const clast_bvh *bvh, const double low[3], const double high[3])
{
    const clx_cut_grid box = {
        .low = {low[0], low[1], low[2]}, .high = {high[0], high[1], high[2]}, .nb = {1, 1, 1}};
    int32_t stack[CLX_TREE_DEPTH + 1];
    int n_stack = 1;
    double sum = 0.0;
    stack[0] = 0;
    while (n_stack > 0) {
        const int32_t at = stack[--n_stack];
        const clx_tree_node *node = &bvh->tree.node[at];
        if (node->high[0] < low[0] || node->high[1] < low[1] || node->low[1] > high[1] ||
            node->high[2] < low[2] || node->low[2] > high[2]) {
            continue;
        }
        if (node->right != 0) {
            stack[n_stack++] = node->right;
            stack[n_stack++] = at + 1;
            continue;
        }
        for (int32_t i = node->first; i < node->first + node->count; ++i) {
            const piece triangle = in_bins(bvh->corner[i], &box);
            sum += below_triangle(&triangle);
        }
    }
    return snapped(sum);
}
