// Grains of labelled voxel volumes: which labels there are, their surfaces and points.
#include <clast/volume.h>

#include "base/alloc.h"
#include "base/status.h"
#include "geom/isosurface.h"
#include "geom/whole.h"
#include "math/sort.h"
#include "math/vec3.h"
#include "shape/whole.h"
#include <clast/mesh.h>
#include <stdlib.h>

void clast_voxels_free(clast_voxels *voxels)
{
    if (voxels == NULL) {
        return;
    }
    CLX_FREE(voxels->label, voxels->grey);
    *voxels = (clast_voxels){0};
}

clast_status clast_voxels_alloc(const int32_t n[3], double edge, clast_voxels *voxels)
{
    CLX_ARGUMENTS(n, voxels);
    clast_status status = CLAST_OK;
    CLX_CHECK(n[0] > 0 && n[1] > 0 && n[2] > 0, CLAST_E_FORMAT,
              "a volume of %d x %d x %d voxels; each must be positive", n[0], n[1], n[2]);
    CLX_CHECK((double)n[0] * n[1] * n[2] < 0x1p31, CLAST_E_LIMIT,
              "%d x %d x %d voxels are beyond 2^31; cut the volume in pieces", n[0], n[1], n[2]);
    CLX_CHECK(edge > 0.0 && isfinite(edge), CLAST_E_FORMAT,
              "a voxel's edge of %g; it must be positive and finite", edge);
    CLX_TRY(clx_alloc(&voxels->label, (int64_t)n[0] * n[1] * n[2], sizeof *voxels->label));
    for (int k = 0; k < 3; ++k) {
        voxels->n[k] = n[k];
        voxels->edge[k] = edge;
    }
done:
    return status;
}

CLX_RISING(compare_labels, clast_voxel_label, label)

/// Open addressing: slot of a label in a table of `room` (a power of two) slots, 0 = free.
static int64_t slot_of(const clast_voxel_label *slot, int64_t capacity, int32_t label)
{
    CLAST_ASSERT(capacity > 0 && (capacity & (capacity - 1)) == 0);
    uint64_t i = (uint32_t)label * UINT64_C(0x9E3779B97F4A7C15) >> 20;
    for (;; ++i) {
        i &= (uint64_t)capacity - 1;
        if (slot[i].n_voxel == 0 || slot[i].label == label) {
            return (int64_t)i;
        }
    }
}

static clast_status rehash(clast_voxel_label **slot, int64_t *capacity)
{
    clast_status status = CLAST_OK;
    clast_voxel_label *wide = NULL;
    CLX_TRY(clx_alloc(&wide, 2 * *capacity, sizeof *wide));
    for (int64_t i = 0; i < *capacity; ++i) {
        if ((*slot)[i].n_voxel > 0) {
            wide[slot_of(wide, 2 * *capacity, (*slot)[i].label)] = (*slot)[i];
        }
    }
    clx_free(*slot);
    *slot = wide;
    *capacity *= 2;
done:
    return status;
}

static void add_voxel(clast_voxel_label *slot, int32_t label, const int32_t at[3])
{
    if (slot->n_voxel++ == 0) {
        slot->label = label;
        for (int k = 0; k < 3; ++k) {
            slot->low[k] = at[k];
            slot->high[k] = at[k];
        }
        return;
    }
    for (int k = 0; k < 3; ++k) {
        slot->low[k] = at[k] < slot->low[k] ? at[k] : slot->low[k];
        slot->high[k] = at[k] > slot->high[k] ? at[k] : slot->high[k];
    }
}

clast_status clast_voxels_labels(const clast_voxels *voxels, clast_voxel_label **labels,
                                 int32_t *n_label)
{
    CLX_ARGUMENTS(voxels, labels, n_label);
    CLX_WHOLE(voxels, voxels);
    enum { FIRST_CAPACITY = 64 };
    clast_status status = CLAST_OK;
    clast_voxel_label *slot = NULL;
    int64_t capacity = FIRST_CAPACITY;
    int32_t n = 0;
    CLX_TRY(clx_alloc(&slot, capacity, sizeof *slot));
    const int64_t n_voxel = (int64_t)voxels->n[0] * voxels->n[1] * voxels->n[2];
    for (int64_t i = 0; i < n_voxel; ++i) {
        const int32_t label = voxels->label[i];
        if (label == 0) {
            continue;
        }
        const int64_t row = i / voxels->n[0];
        const int32_t at[3] = {(int32_t)(i % voxels->n[0]), (int32_t)(row % voxels->n[1]),
                               (int32_t)(row / voxels->n[1])};
        clast_voxel_label *own = &slot[slot_of(slot, capacity, label)];
        n += own->n_voxel == 0;
        add_voxel(own, label, at);
        if (2 * (int64_t)n > capacity) {
            CLX_TRY(rehash(&slot, &capacity));
        }
    }
    n = 0;
    for (int64_t i = 0; i < capacity; ++i) {
        if (slot[i].n_voxel > 0) {
            slot[n++] = slot[i];
        }
    }
    qsort(slot, (size_t)n, sizeof *slot, compare_labels);
    *labels = slot;
    *n_label = n;
    slot = NULL;
done:
    clx_free(slot);
    return status;
}

void clast_voxels_labels_free(clast_voxel_label *labels)
{
    clx_free(labels);
}

static bool is_label(const clast_voxels *v, int64_t x, int64_t y, int64_t z, int32_t label)
{
    return x >= 0 && y >= 0 && z >= 0 && x < v->n[0] && y < v->n[1] && z < v->n[2] &&
           v->label[(z * v->n[1] + y) * v->n[0] + x] == label;
}

/// Smooths the grid along one axis with weights 1, 2, 1; the border stays outside (1).
static void smooth_axis(clx_grid *grid, int axis)
{
    CLAST_ASSERT(axis >= 0 && axis < 3);
    const int64_t stride =
        axis == 0 ? 1 : (axis == 1 ? grid->n[0] : (int64_t)grid->n[0] * grid->n[1]);
    const int64_t n_node = (int64_t)grid->n[0] * grid->n[1] * grid->n[2];
    for (int64_t i = 0; i < n_node; ++i) {
        if (i / stride % grid->n[axis] != 0) {
            continue; // not the first of its line
        }
        float before = 1.0F;
        for (int32_t k = 0; k < grid->n[axis]; ++k) {
            float *at = &grid->value[i + k * stride];
            const float after = k + 1 < grid->n[axis] ? at[stride] : 1.0F;
            const float own = *at;
            *at = 0.25F * (before + 2.0F * own + after);
            before = own;
        }
    }
}

enum { MARGIN = 2 }; ///< cubes around a grain: one for the smoothing, one for the border

/// How far the grey value of a brick lies below the threshold, at most 1 and at least -1 in units
/// of `scale`: negative inside the label.
static float below_threshold(const clast_voxels *v, int64_t x, int64_t y, int64_t z, int32_t label,
                             float scale)
{
    if (x < 0 || y < 0 || z < 0 || x >= v->n[0] || y >= v->n[1] || z >= v->n[2]) {
        return 1.0F;
    }
    const int64_t at = (z * v->n[1] + y) * v->n[0] + x;
    const float depth = ((float)v->threshold - v->grey[at]) / scale;
    return v->label[at] == label ? depth : fabsf(depth); // another grain is outside as far
}

/// Greatest distance of a label's grey values from the threshold.
static float grey_scale(const clast_voxels *v, const clast_voxel_label *label)
{
    float scale = 0.0F;
    for (int64_t z = label->low[2]; z <= label->high[2]; ++z) {
        for (int64_t y = label->low[1]; y <= label->high[1]; ++y) {
            for (int64_t x = label->low[0]; x <= label->high[0]; ++x) {
                const int64_t at = (z * v->n[1] + y) * v->n[0] + x;
                scale = fmaxf(
                    scale, v->label[at] == label->label ? v->grey[at] - (float)v->threshold : 0.0F);
            }
        }
    }
    return scale;
}

/// Values on the nodes about a label: negative (or below 1/2 by occupancy) inside.
static void fill_grid(const clast_voxels *voxels, const clast_voxel_label *label, clx_grid *grid)
{
    const int64_t n_node = (int64_t)grid->n[0] * grid->n[1] * grid->n[2];
    const float scale = voxels->grey != NULL ? grey_scale(voxels, label) : 1.0F;
    for (int64_t i = 0; i < n_node; ++i) {
        const int64_t row = i / grid->n[0];
        const int64_t x = i % grid->n[0] + label->low[0] - MARGIN;
        const int64_t y = row % grid->n[1] + label->low[1] - MARGIN;
        const int64_t z = row / grid->n[1] + label->low[2] - MARGIN;
        if (voxels->grey != NULL) {
            grid->value[i] = below_threshold(voxels, x, y, z, label->label, scale);
        } else {
            grid->value[i] = is_label(voxels, x, y, z, label->label) ? 0.0F : 1.0F;
        }
    }
}

/// A label's bounds lie in the volume.
static clast_status check_label(const clast_voxels *voxels, const clast_voxel_label *label)
{
    clast_status status = CLAST_OK;
    for (int j = 0; j < 3; ++j) {
        CLX_CHECK(label->low[j] >= 0 && label->low[j] <= label->high[j] &&
                      label->high[j] < voxels->n[j],
                  CLAST_E_ARGUMENT, "label %d from voxel %d to %d of %d", label->label,
                  label->low[j], label->high[j], voxels->n[j]);
    }
done:
    return status;
}

clast_status clast_voxels_surface(const clast_voxels *voxels, const clast_voxel_label *label,
                                  clast_mesh *mesh)
{
    CLX_ARGUMENTS(voxels, label, mesh);
    CLX_WHOLE(voxels, voxels);
    CLX_GUARD(check_label(voxels, label));
    clast_status status = CLAST_OK;
    clx_grid grid = {.h = 1.0};
    int64_t n_node = 1;
    for (int k = 0; k < 3; ++k) {
        grid.n[k] = label->high[k] - label->low[k] + 1 + 2 * MARGIN;
        grid.low[k] = label->low[k] - MARGIN + 0.5; // centres of cubes
        n_node *= grid.n[k];
    }
    CLX_CHECK(n_node < INT32_MAX, CLAST_E_LIMIT, "label %d spans %lld voxels, beyond 2^31",
              label->label, (long long)n_node);
    CLX_TRY(clx_alloc(&grid.value, n_node, sizeof *grid.value));
    fill_grid(voxels, label, &grid);
    for (int axis = 0; axis < 3 && voxels->grey == NULL; ++axis) {
        smooth_axis(&grid, axis);
    }
    status = clx_isosurface(&grid, voxels->grey != NULL ? 0.0 : 0.5, 1e-3, mesh);
    for (int32_t i = 0; status == CLAST_OK && i < 3 * mesh->n_vert; ++i) {
        mesh->vert[i / 3][i % 3] *= voxels->edge[i % 3];
    }
    if (status == CLAST_E_GEOMETRY) {
        status = clx_fail(CLAST_E_GEOMETRY,
                          "label %d has %lld voxels, too few or too thin for a surface; measure "
                          "its convex hull with --hull, or scan finer",
                          label->label, (long long)label->n_voxel);
    }
done:
    clx_free(grid.value);
    return status;
}

static bool is_outermost(const clast_voxels *v, int64_t x, int64_t y, int64_t z, int32_t label)
{
    return !is_label(v, x - 1, y, z, label) || !is_label(v, x + 1, y, z, label) ||
           !is_label(v, x, y - 1, z, label) || !is_label(v, x, y + 1, z, label) ||
           !is_label(v, x, y, z - 1, label) || !is_label(v, x, y, z + 1, label);
}

/// Counts the outermost cubes of one row; with `point`, writes their centres there too.
static int32_t row_points(const clast_voxels *v, const clast_voxel_label *label, int32_t y,
                          int32_t z, double (*point)[3])
{
    CLAST_ASSERT(y >= 0 && y < v->n[1] && z >= 0 && z < v->n[2]);
    int32_t n = 0;
    for (int32_t x = label->low[0]; x <= label->high[0]; ++x) {
        if (is_label(v, x, y, z, label->label) && is_outermost(v, x, y, z, label->label)) {
            if (point != NULL) {
                v3_set(point[n], v->edge[0] * (x + 0.5), v->edge[1] * (y + 0.5),
                       v->edge[2] * (z + 0.5));
            }
            ++n;
        }
    }
    return n;
}

static int64_t all_points(const clast_voxels *v, const clast_voxel_label *label, double (*point)[3])
{
    int64_t n = 0;
    for (int32_t z = label->low[2]; z <= label->high[2]; ++z) {
        for (int32_t y = label->low[1]; y <= label->high[1]; ++y) {
            n += row_points(v, label, y, z, point != NULL ? point + n : NULL);
        }
    }
    return n;
}

clast_status clast_voxels_points(const clast_voxels *voxels, const clast_voxel_label *label,
                                 clast_mesh *points)
{
    CLX_ARGUMENTS(voxels, label, points);
    CLX_WHOLE(voxels, voxels);
    CLX_GUARD(check_label(voxels, label));
    clast_status status = CLAST_OK;
    const int64_t n = all_points(voxels, label, NULL);
    CLX_CHECK(n < INT32_MAX, CLAST_E_LIMIT, "label %d has %lld outer voxels, beyond 2^31",
              label->label, (long long)n);
    CLX_TRY(clast_mesh_alloc((int32_t)n, 0, points));
    (void)all_points(voxels, label, points->vert);
done:
    return status;
}

/// Sets the cube around each point; false with its number in *twice when a cube has two.
static bool set_cubes(const clast_mesh *points, const double from[3], double spacing,
                      const int32_t n[3], int32_t *label, int32_t *twice)
{
    CLAST_ASSERT(label != NULL);
    for (int32_t v = 0; v < points->n_vert; ++v) {
        int64_t at[3];
        for (int k = 0; k < 3; ++k) {
            at[k] = (int64_t)((points->vert[v][k] - from[k]) / spacing + 0.5);
        }
        const int64_t own = (at[2] * n[1] + at[1]) * n[0] + at[0];
        if (label[own] != 0) {
            *twice = v;
            return false;
        }
        label[own] = 1;
    }
    return true;
}

clast_status clast_voxels_of_points(const clast_mesh *points, double spacing, clast_voxels *voxels,
                                    double low[3])
{
    CLX_ARGUMENTS(points, voxels, low);
    CLX_WHOLE(mesh, points);
    clast_status status = CLAST_OK;
    clast_voxels made = {0};
    double from[3];
    double to[3];
    int32_t n[3];
    int32_t twice = 0;
    CLX_CHECK(points->n_vert > 0, CLAST_E_GEOMETRY, "no points");
    CLX_CHECK(spacing > 0.0 && isfinite(spacing), CLAST_E_GEOMETRY,
              "a spacing of %g between points; it must be positive", spacing);
    for (int32_t v = 0; v < points->n_vert; ++v) {
        CLX_CHECK(isfinite(v3_norm2(points->vert[v])), CLAST_E_GEOMETRY,
                  "point %d of %d is not finite", v + 1, points->n_vert);
    }
    clast_mesh_bounds(points, from, to);
    for (int k = 0; k < 3; ++k) {
        const double cubes = (to[k] - from[k]) / spacing + 1.5;
        CLX_CHECK(cubes < 0x1p31, CLAST_E_LIMIT,
                  "the points span %g cubes of %g; the spacing is too fine", cubes, spacing);
        n[k] = (int32_t)cubes;
    }
    CLX_TRY(clast_voxels_alloc(n, spacing, &made));
    CLX_CHECK(set_cubes(points, from, spacing, n, made.label, &twice), CLAST_E_GEOMETRY,
              "two points (the second is number %d) lie within one spacing of %g: give the spacing "
              "of the grid they were sampled on",
              twice + 1, spacing);
    for (int k = 0; k < 3; ++k) {
        low[k] = from[k] - 0.5 * spacing;
    }
    *voxels = made;
    made = (clast_voxels){0};
done:
    clast_voxels_free(&made);
    return status;
}
