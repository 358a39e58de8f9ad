// Signed distances of placed grains on a grid: spheres and clumps exactly, ellipsoids to first
// order, meshes by their hierarchy in a band around the surface with the sign carried along each
// row.
#include "assembly/distance_field.h"

#include "base/alloc.h"
#include "base/monitor.h"
#include "base/parallel.h"
#include "geom/isosurface.h"
#include "math/vec3.h"
#include <clast/assembly.h>
#include <clast/shape.h>

enum { LAYERS_A_BLOCK = 4, BLOCKS_A_LOOK = 4 }; // of each worker

clast_status clx_distance_field_init(const clast_assembly *assembly, clx_distance_field *field)
{
    clast_status status = CLAST_OK;
    clx_distance_field made = {.assembly = assembly};
    CLX_TRY(clx_alloc(&made.bvh, assembly->n_shape, sizeof *made.bvh));
    for (int32_t s = 0; s < assembly->n_shape; ++s) {
        if (assembly->shape[s].kind == CLAST_SHAPE_MESH) {
            CLX_TRY(clast_bvh_create(&assembly->shape[s].mesh, &made.bvh[s]));
        }
    }
    *field = made;
    made.bvh = NULL;
done:
    if (made.bvh != NULL) {
        clx_distance_field_free(&made);
    }
    return status;
}

void clx_distance_field_free(clx_distance_field *field)
{
    for (int32_t s = 0; field->bvh != NULL && s < field->assembly->n_shape; ++s) {
        clast_bvh_destroy(field->bvh[s]);
    }
    clx_free(field->bvh);
    *field = (clx_distance_field){0};
}

/// First-order distance to an ellipsoid: (|A^-1 x| - 1) |A^-1 x| / |A^-2 x|.
static double ellipsoid_distance(const double semi_axes[3], const double x[3])
{
    double p = 0.0;
    double q = 0.0;
    double least = semi_axes[0];
    for (int k = 0; k < 3; ++k) {
        const double a = x[k] / semi_axes[k];
        p += a * a;
        q += (a / semi_axes[k]) * (a / semi_axes[k]);
        least = fmin(least, semi_axes[k]);
    }
    p = sqrt(p);
    return q > 0.0 ? (p - 1.0) * p / sqrt(q) : -least;
}

static double spheres_distance(const clast_spheres *spheres, const double x[3])
{
    double nearest = INFINITY;
    for (int32_t i = 0; i < spheres->n; ++i) {
        nearest = fmin(nearest, v3_distance(x, spheres->centre[i]) - spheres->radius[i]);
    }
    return nearest;
}

/// A mesh along one row: nodes more than `band` (over one spacing) from the surface keep the sign
/// of the node before; the longest edge of the grid is sqrt(3) spacings, so 1.75 keeps every
/// distance that the surface is placed by.
typedef struct {
    double band;
    bool inside; ///< sign at the last node
} row_state;

static double mesh_distance(const clast_bvh *bvh, const double x[3], row_state *row)
{
    const double distance = clast_bvh_closest(bvh, x, row->band, NULL, NULL);
    if (distance < row->band) {
        row->inside = clast_bvh_inside(bvh, x);
        return row->inside ? -distance : distance;
    }
    return row->inside ? -row->band : row->band;
}

static double shape_distance(const clx_distance_field *field, int32_t shape_id, const double x[3],
                             row_state *row)
{
    CLAST_ASSERT(shape_id >= 0 && shape_id < field->assembly->n_shape);
    const clast_shape *shape = &field->assembly->shape[shape_id];
    switch (shape->kind) {
    case CLAST_SHAPE_SPHERE:
        return v3_norm(x) - shape->semi_axes[0];
    case CLAST_SHAPE_ELLIPSOID:
        return ellipsoid_distance(shape->semi_axes, x);
    case CLAST_SHAPE_CLUMP:
        return spheres_distance(&shape->spheres, x);
    case CLAST_SHAPE_MESH:
        break;
    }
    return mesh_distance(field->bvh[shape_id], x, row);
}

/// Nodes of one axis within [low, high]: false when there are none.
static bool node_range(const clx_grid *g, int axis, const double low_high[2], int32_t range[2])
{
    CLAST_ASSERT(axis >= 0 && axis < 3 && g->h > 0.0);
    const double first = ceil((low_high[0] - g->low[axis]) / g->h);
    const double last = floor((low_high[1] - g->low[axis]) / g->h);
    range[0] = first > 0.0 ? (int32_t)first : 0;
    range[1] = last < g->n[axis] - 1 ? (int32_t)last : g->n[axis] - 1;
    return range[0] <= range[1];
}

static bool ranges_around(const clx_grid *g, const double centre[3], double max_distance,
                          int32_t range[3][2])
{
    for (int k = 0; k < 3; ++k) {
        const double around[2] = {centre[k] - max_distance, centre[k] + max_distance};
        if (!node_range(g, k, around, range[k])) {
            return false;
        }
    }
    return true;
}

static void node_at(const clx_grid *g, int32_t i, int32_t j, int32_t k, double x[3])
{
    v3_set(x, g->low[0] + g->h * i, g->low[1] + g->h * j, g->low[2] + g->h * k);
}

static void lower(clx_grid *g, int32_t i, int32_t j, int32_t k, double value)
{
    CLAST_ASSERT(i >= 0 && i < g->n[0] && j >= 0 && j < g->n[1] && k >= 0 && k < g->n[2]);
    float *slot = &g->value[((int64_t)k * g->n[1] + j) * g->n[0] + i];
    if ((float)value < *slot) {
        *slot = (float)value;
    }
}

static void sample_grain(const clx_distance_field *field, clx_grid *g, int32_t grain,
                         const int64_t layers[2])
{
    const clast_assembly *a = field->assembly;
    const int32_t s = a->shape_id[grain];
    const double scale = a->scale[grain];
    double rotation[3][3];
    int32_t range[3][2];
    // Two spacings of margin: every row starts outside, with the band crossed before the surface.
    if (!ranges_around(g, a->position[grain], scale * a->shape[s].bounding_radius + 2.0 * g->h,
                       range)) {
        return;
    }
    q_matrix(rotation, a->orientation[grain]);
    for (int64_t k = layers[0]; k < layers[1]; ++k) {
        if (k < range[2][0] || k > range[2][1]) {
            continue;
        }
        for (int32_t j = range[1][0]; j <= range[1][1]; ++j) {
            row_state row = {.band = 1.75 * g->h / scale};
            for (int32_t i = range[0][0]; i <= range[0][1]; ++i) {
                double x[3];
                double local[3];
                node_at(g, i, j, (int32_t)k, x);
                v3_sub(x, x, a->position[grain]);
                m3_to_local(local, rotation, x);
                v3_scale(local, 1.0 / scale, local);
                lower(g, i, j, (int32_t)k, scale * shape_distance(field, s, local, &row));
            }
        }
    }
}

typedef struct {
    const clx_distance_field *field;
    clx_grid *grid;
    int64_t first; ///< layer
} sample_context;

static void sample_layers(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const sample_context *c = context;
    const int64_t layers[2] = {c->first + begin, c->first + end};
    (void)worker;
    for (int32_t grain = 0; grain < c->field->assembly->n_grain; ++grain) {
        sample_grain(c->field, c->grid, grain, layers);
    }
}

void clx_distance_field_sample(const clx_distance_field *field, clx_grid *grid)
{
    (void)clx_distance_field_sample_watched(field, NULL, grid);
}

clast_status clx_distance_field_sample_watched(const clx_distance_field *field,
                                               const clast_monitor *monitor, clx_grid *grid)
{
    const int64_t n = grid->n[2];
    const int64_t look = (int64_t)LAYERS_A_BLOCK * BLOCKS_A_LOOK * clx_parallel_workers();
    const int64_t part = monitor != NULL && look < n ? look : n;
    for (int64_t first = 0; first < n; first += part) {
        sample_context context = {field, grid, first};
        if (clx_monitor_stops(monitor)) {
            return clx_fail(CLAST_E_STOPPED, "stopped");
        }
        clx_parallel_for(part < n - first ? part : n - first, LAYERS_A_BLOCK, sample_layers,
                         &context);
    }
    return CLAST_OK;
}

void clx_distance_field_balls(const double (*centre)[3], int32_t n, double radius, clx_grid *grid)
{
    for (int32_t b = 0; b < n; ++b) {
        int32_t range[3][2];
        if (!ranges_around(grid, centre[b], radius + 2.0 * grid->h, range)) {
            continue;
        }
        for (int32_t k = range[2][0]; k <= range[2][1]; ++k) {
            for (int32_t j = range[1][0]; j <= range[1][1]; ++j) {
                for (int32_t i = range[0][0]; i <= range[0][1]; ++i) {
                    double x[3];
                    node_at(grid, i, j, k, x);
                    lower(grid, i, j, k, v3_distance(x, centre[b]) - radius);
                }
            }
        }
    }
}
