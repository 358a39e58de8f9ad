// A ball of radius L that may not overlap a grain is moved in from far away; the wrap is the space
// that no such ball covers: cavities that are closed to it count as inside. For L -> 0 it is the
// solid with its closed voids, for L -> infinity the convex hull.
//
// On a grid of spacing h: D, the distance to the solid; the reachable centres E, the part of D > L
// joined to the border; e, the distance to E; the wrap is e >= L. Both distances are carried from
// nodes near the surface in question, whose own signed distance w is known to second order:
// min over q of |p - q| + w(q) is an upper bound for every q, since distances grow by no more than
// one per unit of way. The grid is run at two spacings; their difference is the stated error,
// beside what both have in common: a node aside of the way by t sees a surface of curvature 1/R
// farther off by t^2/2R, and is itself t^2/2L farther (docs/theory/envelope.md).
#include "assembly/wrap.h"

#include "assembly/distance_field.h"
#include "base/alloc.h"
#include "base/parallel.h"
#include "base/status.h"
#include "geom/isosurface.h"
#include "geom/nearest_node.h"
#include "math/vec3.h"
#include <clast/assembly.h>
#include <clast/shape.h>

enum { LAYERS_A_BLOCK = 2, MAX_CELLS = 320, MAX_NODES = 100000000 };

typedef struct wrap {
    clx_grid grid; ///< value: distance to the solid
    int64_t n_node;
    uint8_t *mark;      ///< [n_node] sites of a transform
    uint8_t *reachable; ///< [n_node] in E
    int32_t *nearest;   ///< [n_node]
    float *next;        ///< [n_node] distances being made
    double length;
    double *part;    ///< [n[2]] cells of each layer in the wrap
    double *border;  ///< [n[2]] of these, cells that are cut
    bool of_centres; ///< distances to E are made, not to the solid
    int32_t *stack;
    int64_t stack_capacity;
} wrap;

static void wrap_free(wrap *w)
{
    clx_grid_free(&w->grid);
    CLX_FREE(w->mark, w->reachable, w->nearest, w->next, w->part, w->border, w->stack);
    *w = (wrap){0};
}

static clast_status wrap_alloc(const clast_assembly *assembly, double length, int32_t n_cell,
                               wrap *w)
{
    CLAST_ASSERT(length >= 0.0 && n_cell > 0);
    clast_status status = CLAST_OK;
    double low[3];
    double high[3];
    double longest = 0.0;
    clast_assembly_bounds(assembly, low, high);
    for (int k = 0; k < 3; ++k) {
        longest = fmax(longest, high[k] - low[k]);
    }
    const double h = longest / n_cell;
    // room for every centre that matters, and two nodes of E beyond
    for (int k = 0; k < 3; ++k) {
        low[k] -= length + 3.0 * h;
        high[k] += length + 3.0 * h;
    }
    const double n_node =
        (high[0] - low[0]) / h * ((high[1] - low[1]) / h) * ((high[2] - low[2]) / h);
    CLX_CHECK(
        n_node <= MAX_NODES, CLAST_E_LIMIT,
        "wrap: a ball of radius %s about grains that extend over %s needs a grid of %.3g nodes, %d "
        "at most; choose a smaller envelope_length, or the convex hull",
        clx_unit_text(length, "m"), clx_unit_text(longest, "m"), n_node, MAX_NODES);
    CLX_TRY(clx_grid_alloc(low, high, h, (float)(4.0 * (longest + length)), &w->grid));
    w->n_node = (int64_t)w->grid.n[0] * w->grid.n[1] * w->grid.n[2];
    w->length = length;
    CLX_TRY(clx_alloc(&w->mark, w->n_node, sizeof *w->mark));
    CLX_TRY(clx_alloc(&w->reachable, w->n_node, sizeof *w->reachable));
    CLX_TRY(clx_alloc(&w->nearest, w->n_node, sizeof *w->nearest));
    CLX_TRY(clx_alloc(&w->next, w->n_node, sizeof *w->next));
    CLX_TRY(clx_alloc(&w->part, w->grid.n[2], sizeof *w->part));
    CLX_TRY(clx_alloc(&w->border, w->grid.n[2], sizeof *w->border));
done:
    return status;
}

static void node_of(const clx_grid *g, int64_t p, int32_t at[3])
{
    CLAST_ASSERT(p >= 0 && p < (int64_t)g->n[0] * g->n[1] * g->n[2]);
    at[0] = (int32_t)(p % g->n[0]);
    at[1] = (int32_t)(p / g->n[0] % g->n[1]);
    at[2] = (int32_t)(p / ((int64_t)g->n[0] * g->n[1]));
}

/// Signed distance of a node to what the present transform is about.
static double own_distance(const wrap *w, int64_t q)
{
    CLAST_ASSERT(q >= 0 && q < w->n_node);
    const double d = (double)w->grid.value[q];
    return w->of_centres ? w->length - d : d;
}

/// min over the nodes q about the nearest site of |p - q| + w(q).
static double carried(const wrap *w, int64_t p)
{
    const clx_grid *g = &w->grid;
    int32_t at[3];
    int32_t site[3];
    double best = INFINITY;
    node_of(g, p, at);
    node_of(g, w->nearest[p], site);
    for (int32_t k = site[2] - 1; k <= site[2] + 1; ++k) {
        for (int32_t j = site[1] - 1; j <= site[1] + 1; ++j) {
            for (int32_t i = site[0] - 1; i <= site[0] + 1; ++i) {
                if (i < 0 || j < 0 || k < 0 || i >= g->n[0] || j >= g->n[1] || k >= g->n[2]) {
                    continue;
                }
                const int64_t q = ((int64_t)k * g->n[1] + j) * g->n[0] + i;
                if (w->mark[q] != 0) {
                    const double dx = i - at[0], dy = j - at[1], dz = k - at[2];
                    best =
                        fmin(best, g->h * sqrt(dx * dx + dy * dy + dz * dz) + own_distance(w, q));
                }
            }
        }
    }
    return best;
}

static void carry_layers(int64_t begin, int64_t end, int32_t worker, void *context)
{
    wrap *w = context;
    const int64_t layer = (int64_t)w->grid.n[0] * w->grid.n[1];
    (void)worker;
    for (int64_t p = begin * layer; p < end * layer; ++p) {
        const double own = own_distance(w, p);
        const bool far = w->of_centres ? w->reachable[p] == 0 : own > w->grid.h;
        w->next[p] = (float)(far ? carried(w, p) : own);
    }
}

/// D from the sampled distances near the solid.
static clast_status spread_from_solid(const clast_assembly *assembly, wrap *w)
{
    clast_status status = CLAST_OK;
    clx_distance_field field = {0};
    bool any = false;
    CLX_TRY(clx_distance_field_init(assembly, &field));
    clx_distance_field_sample(&field, &w->grid);
    for (int64_t p = 0; p < w->n_node; ++p) {
        w->mark[p] = fabs((double)w->grid.value[p]) <= w->grid.h;
        any = any || w->mark[p] != 0;
    }
    CLX_CHECK(any, CLAST_E_GEOMETRY, "wrap: no grain is near a node of the grid");
    CLX_TRY(clx_nearest_node(w->grid.n, w->mark, w->nearest));
    clx_parallel_for(w->grid.n[2], LAYERS_A_BLOCK, carry_layers, w);
    float *swap = w->grid.value;
    w->grid.value = w->next;
    w->next = swap;
done:
    clx_distance_field_free(&field);
    return status;
}

/// E: nodes with D > L joined to the border, over faces of cells.
static clast_status flood_centres(wrap *w)
{
    clast_status status = CLAST_OK;
    const clx_grid *g = &w->grid;
    const int64_t step[3] = {1, g->n[0], (int64_t)g->n[0] * g->n[1]};
    int64_t n = 1;
    CLX_TRY(clx_grow(&w->stack, &w->stack_capacity, 1, sizeof *w->stack));
    w->stack[0] = 0; // a corner of the grid is far from all grains
    w->reachable[0] = 1;
    while (n > 0) {
        const int32_t p = w->stack[--n];
        int32_t at[3];
        node_of(g, p, at);
        CLX_TRY(clx_grow(&w->stack, &w->stack_capacity, n + 6, sizeof *w->stack));
        for (int k = 0; k < 6; ++k) {
            const int axis = k / 2;
            const int32_t to = at[axis] + (k % 2 == 0 ? 1 : -1);
            if (to < 0 || to >= g->n[axis]) {
                continue;
            }
            const int64_t q = p + (k % 2 == 0 ? step[axis] : -step[axis]);
            if (w->reachable[q] == 0 && (double)g->value[q] > w->length) {
                w->reachable[q] = 1;
                w->stack[n++] = (int32_t)q;
            }
        }
    }
done:
    return status;
}

/// Sites of the second transform: reachable centres just off the forbidden ones.
static clast_status spread_from_centres(wrap *w)
{
    clast_status status = CLAST_OK;
    for (int64_t p = 0; p < w->n_node; ++p) {
        w->mark[p] =
            w->reachable[p] != 0 && (double)w->grid.value[p] - w->length <= 1.75 * w->grid.h;
    }
    w->of_centres = true;
    CLX_TRY(clx_nearest_node(w->grid.n, w->mark, w->nearest));
    clx_parallel_for(w->grid.n[2], LAYERS_A_BLOCK, carry_layers, w);
done:
    return status;
}

static void count_layers(int64_t begin, int64_t end, int32_t worker, void *context)
{
    wrap *w = context;
    const int64_t layer = (int64_t)w->grid.n[0] * w->grid.n[1];
    (void)worker;
    for (int64_t k = begin; k < end; ++k) {
        double sum = 0.0;
        int64_t cut = 0;
        for (int64_t p = k * layer; p < (k + 1) * layer; ++p) {
            const double share = 0.5 + ((double)w->next[p] - w->length) / w->grid.h;
            sum += share <= 0.0 ? 0.0 : share >= 1.0 ? 1.0 : share;
            cut += share > 0.0 && share < 1.0;
        }
        w->part[k] = sum;
        w->border[k] = (double)cut;
    }
}

/// Greatest curvature of spheres and ellipsoids [1/m]: a / c^2. The edges of a surface have none
/// that is finite; there the difference of two grids stands alone.
static double greatest_curvature(const clast_assembly *a)
{
    double most = 0.0;
    for (int32_t i = 0; i < a->n_grain; ++i) {
        const clast_shape *shape = &a->shape[a->shape_id[i]];
        double least = INFINITY; // radius of curvature
        if (shape->kind == CLAST_SHAPE_SPHERE) {
            least = shape->semi_axes[0];
        } else if (shape->kind == CLAST_SHAPE_ELLIPSOID) {
            least = shape->semi_axes[2] * shape->semi_axes[2] / shape->semi_axes[0];
        }
        for (int32_t k = 0; k < shape->spheres.n && shape->kind == CLAST_SHAPE_CLUMP; ++k) {
            least = fmin(least, shape->spheres.radius[k]);
        }
        most = fmax(most, 1.0 / (a->scale[i] * least));
    }
    return most;
}

/// Volume, and by how much the border's carried distances may move it.
static clast_status wrap_volume(const clast_assembly *assembly, double length, int32_t n_cell,
                                double *volume, double *common)
{
    clast_status status = CLAST_OK;
    wrap w = {0};
    double sum = 0.0;
    double cut = 0.0;
    CLX_TRY(wrap_alloc(assembly, length, n_cell, &w));
    CLX_TRY(spread_from_solid(assembly, &w));
    CLX_TRY(flood_centres(&w));
    CLX_TRY(spread_from_centres(&w));
    clx_parallel_for(w.grid.n[2], LAYERS_A_BLOCK, count_layers, &w);
    for (int32_t k = 0; k < w.grid.n[2]; ++k) {
        sum += w.part[k];
        cut += w.border[k];
    }
    const double h = w.grid.h;
    const double surface = cut * h * h; // cut cells fill a layer of thickness h
    *volume = sum * h * h * h;
    // t^2 / 2 = 3/8 h^2: over L on both ways, over the grains' own radius on the way from them
    *common = 0.375 * h * h * (2.0 / length + greatest_curvature(assembly)) * surface;
done:
    wrap_free(&w);
    return status;
}

clast_status clx_envelope_wrap(const clast_assembly *assembly,
                               const clast_envelope_options *options, clast_envelope *envelope)
{
    clast_status status = CLAST_OK;
    double fine = 0.0;
    double coarse = 0.0;
    double common = 0.0;
    double other = 0.0;
    CLX_CHECK(options->length > 0.0 && isfinite(options->length), CLAST_E_USAGE,
              "wrap needs a length: the radius of the ball that may not enter");
    CLX_CHECK(options->n_cell >= 12 && options->n_cell <= MAX_CELLS, CLAST_E_USAGE,
              "wrap: %d cells along the longest side, 12 to %d", options->n_cell, MAX_CELLS);
    CLX_TRY(wrap_volume(assembly, options->length, options->n_cell, &fine, &common));
    CLX_TRY(wrap_volume(assembly, options->length, options->n_cell * 2 / 3, &coarse, &other));
    // first order in h: the finer grid is off by twice the difference
    const double error = hypot(2.0 * (fine - coarse), common);
    *envelope = (clast_envelope){CLAST_ENVELOPE_WRAP, fine, error, fine - error, fine + error};
done:
    return status;
}
