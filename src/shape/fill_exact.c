// Exact questions to the tree of clx_fill_field: its floats only choose the triangles that
// clx_triangle_closest and clx_triangle_crossing judge in double.
#include "geom/bvh.h"
#include "shape/fill_field.h"

#include "base/machine.h"
#include <float.h>
#include <string.h>

// Vectors pass between inlined functions only, so the calling convention does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"

enum { LANES = CLX_FILL_LANES, STACK = (LANES - 1) * CLX_FILL_DEPTH + LANES };

CLX_INLINE clx_float8 magnitude(clx_float8 x)
{
    return (clx_float8)((clx_int8)x & 0x7fffffff);
}

CLX_INLINE clx_float8 pick(clx_int8 mask, clx_float8 yes, clx_float8 no)
{
    return (clx_float8)((mask & (clx_int8)yes) | (~mask & (clx_int8)no));
}

// Farther out, in sizes of the surface, squares would be beyond floats. All boxes are then near.
static const double FAR_AWAY = 1e15;

/// Boxes side by side; an empty slot has middle[0] = INFINITY, or stands far away.
typedef struct {
    clx_float8 middle[3], half[3];
} boxes;

CLX_INLINE boxes boxes_of_leaf(const clx_fill_leaf *leaf)
{
    const clx_float8 zero = {0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F};
    boxes b;
    for (int k = 0; k < 3; ++k) {
        clx_float8 low = pick(leaf->ab[k] < leaf->ac[k], leaf->ab[k], leaf->ac[k]);
        clx_float8 high = pick(leaf->ab[k] < leaf->ac[k], leaf->ac[k], leaf->ab[k]);
        low = pick(low < zero, low, zero);
        high = pick(high > zero, high, zero);
        b.middle[k] = leaf->a[k] + 0.5F * (low + high);
        b.half[k] = 0.5F * (high - low);
    }
    return b;
}

/// Of a node's children, or of a leaf's triangles.
CLX_INLINE boxes boxes_of(const clx_fill_node *node, const clx_fill_leaf *leaf)
{
    boxes b;
    if (leaf != NULL) {
        return boxes_of_leaf(leaf);
    }
    memcpy(&b, node, sizeof b);
    return b;
}

/// Marks the boxes that may be within d of a point, all in the frame.
CLX_FOR_EACH_MACHINE
static void mark_near(const clx_fill_node *node, const clx_fill_leaf *leaf, const float f[3],
                      float d, int32_t mark[LANES])
{
    const boxes b = boxes_of(node, leaf);
    const float error = (float)CLX_FILL_FRAME_ERROR;
    const float padded = d * (1.0F + error) + error;
    const float limit = 4.0F * padded * padded;
    clx_float8 sum = {0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F};
    for (int k = 0; k < 3; ++k) {
        const clx_float8 out = magnitude(b.middle[k] - f[k]) - b.half[k];
        const clx_float8 twice = out + magnitude(out); // 2 max(out, 0)
        sum += twice * twice;
    }
    const clx_int8 near = sum <= (limit < FLT_MAX ? limit : FLT_MAX);
    memcpy(mark, &near, sizeof near);
}

/// Marks the boxes that a vertical ray upwards may meet.
CLX_FOR_EACH_MACHINE
static void mark_above(const clx_fill_node *node, const clx_fill_leaf *leaf, const float f[3],
                       int32_t mark[LANES])
{
    const boxes b = boxes_of(node, leaf);
    const float error = (float)CLX_FILL_FRAME_ERROR;
    const clx_int8 meets = (magnitude(b.middle[0] - f[0]) - b.half[0] <= error) &
                           (magnitude(b.middle[1] - f[1]) - b.half[1] <= error) &
                           (f[2] - b.middle[2] - b.half[2] <= error);
    memcpy(mark, &meets, sizeof meets);
}

static void corners_of(const clx_fill_field *field, int32_t i, double corner[3][3])
{
    CLAST_ASSERT(i >= 0);
    const int32_t *tri = field->mesh->tri[field->item[i]];
    for (int k = 0; k < 3; ++k) {
        v3_copy(corner[k], field->mesh->vert[tri[k]]);
    }
}

static void to_frame(const clx_fill_field *field, const double point[3], float f[3])
{
    for (int k = 0; k < 3; ++k) {
        const double x = (point[k] - field->middle[k]) * field->scale;
        f[k] = (float)(x > FAR_AWAY ? FAR_AWAY : x < -FAR_AWAY ? -FAR_AWAY : x);
    }
}

typedef struct {
    double d2;
    double closest[3];
    int32_t tri; ///< of the mesh; -1: none yet
} nearest;

static void try_triangle(const clx_fill_field *field, int32_t i, const double point[3],
                         nearest *best)
{
    double corner[3][3];
    double candidate[3];
    corners_of(field, i, corner);
    const double d2 = clx_triangle_closest(corner, point, candidate);
    const int32_t tri = field->item[i];
    // Equal distances (a shared edge): the lower number wins, whatever the order of the visits.
    if (d2 < best->d2 || (d2 == best->d2 && (best->tri < 0 || tri < best->tri))) {
        best->d2 = d2;
        best->tri = tri;
        v3_copy(best->closest, candidate);
    }
}

double clx_fill_field_closest(const clx_fill_field *field, const double point[3],
                              double max_distance, double closest[3])
{
    CLAST_ASSERT(field->n_node > 0);
    int32_t stack[STACK];
    int32_t mark[LANES];
    double touch[3];
    float f[3];
    int n = 1;
    // Searched a few ulp further, so that a distance equal to the bound survives its rounding.
    const double bound = max_distance * (1.0 + 0x1p-50);
    nearest best = {.d2 = bound * bound, .tri = -1};
    // The fast walk bounds the distance from above: what remains is to look at all within it.
    const double fast = clx_fill_field_distance(field, point, max_distance, touch, &best.tri);
    const double within = fast < max_distance ? fast : max_distance;
    const float limit = (float)(within * field->scale);
    best.tri = -1;
    to_frame(field, point, f);
    stack[0] = 0;
    while (n > 0) {
        const int32_t child = stack[--n];
        if (child >= 0) {
            const clx_fill_node *node = &field->node[child];
            mark_near(node, NULL, f, limit, mark);
            for (int i = 0; i < LANES; ++i) {
                stack[n] = node->child[i];
                n += mark[i] != 0;
            }
            continue;
        }
        const clx_fill_leaf *leaf = &field->leaf[-1 - child];
        mark_near(NULL, leaf, f, limit, mark);
        for (int32_t i = 0; i < leaf->count; ++i) {
            if (mark[i] != 0) {
                try_triangle(field, leaf->first + i, point, &best);
            }
        }
    }
    if (best.tri < 0 || !(sqrt(best.d2) <= max_distance)) {
        return INFINITY;
    }
    if (closest != NULL) {
        v3_copy(closest, best.closest);
    }
    return sqrt(best.d2);
}

bool clx_fill_field_inside(const clx_fill_field *field, const double point[3])
{
    int32_t stack[STACK];
    int32_t mark[LANES];
    float f[3];
    int n = 1;
    int64_t sum = 0;
    to_frame(field, point, f);
    stack[0] = 0;
    while (n > 0) {
        const int32_t child = stack[--n];
        if (child >= 0) {
            const clx_fill_node *node = &field->node[child];
            mark_above(node, NULL, f, mark);
            for (int i = 0; i < LANES; ++i) {
                stack[n] = node->child[i];
                n += mark[i] != 0;
            }
            continue;
        }
        const clx_fill_leaf *leaf = &field->leaf[-1 - child];
        mark_above(NULL, leaf, f, mark);
        for (int32_t i = 0; i < leaf->count; ++i) {
            if (mark[i] != 0) {
                double corner[3][3];
                bool is_on = false;
                corners_of(field, leaf->first + i, corner);
                sum += clx_triangle_crossing(corner, point, &is_on);
                if (is_on) {
                    return true;
                }
            }
        }
    }
    return sum != 0;
}
