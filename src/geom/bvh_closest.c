// Closest point of a surface: depth-first walk, nearer child first, pruned by the best distance.
#include "geom/bvh.h"

#include "math/vec3.h"
#include <math.h>

/// Closest point of segment a b; squared distance.
static double segment_closest(const double a[3], const double b[3], const double point[3],
                              double closest[3])
{
    double along[3];
    double to[3];
    v3_sub(along, b, a);
    v3_sub(to, point, a);
    const double length2 = v3_norm2(along);
    const double s = length2 > 0.0 ? v3_dot(to, along) / length2 : 0.0;
    if (s >= 1.0) {
        v3_copy(closest, b);
    } else {
        v3_axpy(closest, a, s > 0.0 ? s : 0.0, along);
    }
    return v3_distance2(closest, point);
}

/// Foot of the perpendicular if it falls into the triangle; squared distance, else INFINITY.
static double foot_closest(double corner[3][3], const double point[3], double closest[3])
{
    double u[3];
    double v[3];
    double to[3];
    double n[3];
    double cross[3];
    v3_sub(u, corner[1], corner[0]);
    v3_sub(v, corner[2], corner[0]);
    v3_sub(to, point, corner[0]);
    v3_cross(n, u, v);
    const double n2 = v3_norm2(n);
    v3_cross(cross, u, to);
    const double w2 = v3_dot(cross, n);
    v3_cross(cross, to, v);
    const double w1 = v3_dot(cross, n);
    if (!(n2 > 0.0 && w1 >= 0.0 && w2 >= 0.0 && w1 + w2 <= n2)) {
        return INFINITY;
    }
    v3_axpy(closest, corner[0], w1 / n2, u);
    v3_axpy(closest, closest, w2 / n2, v);
    return v3_distance2(closest, point);
}

// The foot and the three segments are all points of the triangle, whatever rounding did to the
// decision which applies, so their minimum is never too small, and too large by at most the
// rounding of a position: no region test can send a sliver astray.
double clx_triangle_closest(double corner[3][3], const double point[3], double closest[3])
{
    double best = foot_closest(corner, point, closest);
    for (int i = 0; i < 3; ++i) {
        double candidate[3];
        const double d2 = segment_closest(corner[i], corner[(i + 1) % 3], point, candidate);
        if (d2 < best) {
            best = d2;
            v3_copy(closest, candidate);
        }
    }
    return best;
}

static double box_distance2(const clx_tree_node *node, const double point[3])
{
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double below = node->low[k] - point[k];
        const double above = point[k] - node->high[k];
        const double out = below > above ? below : above;
        sum += out > 0.0 ? out * out : 0.0;
    }
    return sum;
}

typedef struct {
    double d2;
    double closest[3];
    int32_t tri; ///< -1: none yet
} nearest;

static void visit_leaf(const clast_bvh *bvh, const clx_tree_node *node, const double point[3],
                       nearest *best)
{
    CLAST_ASSERT(node->right == 0 && node->count > 0);
    for (int32_t i = node->first; i < node->first + node->count; ++i) {
        double candidate[3];
        const double d2 = clx_triangle_closest(bvh->corner[i], point, candidate);
        const int32_t tri = bvh->tree.item[i];
        // Equal distances (a shared edge): the lower number wins, whatever the order of the visits.
        if (d2 < best->d2 || (d2 == best->d2 && (best->tri < 0 || tri < best->tri))) {
            best->d2 = d2;
            best->tri = tri;
            v3_copy(best->closest, candidate);
        }
    }
}

static void walk(const clast_bvh *bvh, const double point[3], nearest *best)
{
    CLAST_ASSERT(bvh->tree.n_node > 0);
    struct {
        int32_t node;
        double d2;
    } stack[CLX_TREE_DEPTH + 1];
    int n_stack = 1;
    stack[0].node = 0;
    stack[0].d2 = box_distance2(&bvh->tree.node[0], point);
    while (n_stack > 0) {
        --n_stack;
        if (stack[n_stack].d2 > best->d2) {
            continue;
        }
        const int32_t at = stack[n_stack].node;
        const clx_tree_node *node = &bvh->tree.node[at];
        if (node->right == 0) {
            visit_leaf(bvh, node, point, best);
            continue;
        }
        const double left = box_distance2(node + 1, point);
        const double right = box_distance2(&bvh->tree.node[node->right], point);
        const bool left_first = left <= right;
        stack[n_stack].node = left_first ? node->right : at + 1;
        stack[n_stack++].d2 = left_first ? right : left;
        stack[n_stack].node = left_first ? at + 1 : node->right;
        stack[n_stack++].d2 = left_first ? left : right;
    }
}

double clast_bvh_closest(const clast_bvh *bvh, const double point[3], double max_distance,
                         double closest[3], int32_t *tri)
{
    if (bvh == NULL || point == NULL) {
        return (double)INFINITY;
    }
    // Searched a few ulp further, so that a distance equal to the bound survives its rounding.
    const double bound = max_distance * (1.0 + 0x1p-50);
    nearest best = {.d2 = bound * bound, .tri = -1};
    walk(bvh, point, &best);
    if (best.tri < 0 || !(sqrt(best.d2) <= max_distance)) {
        return INFINITY;
    }
    if (closest != NULL) {
        v3_copy(closest, best.closest);
    }
    if (tri != NULL) {
        *tri = best.tri;
    }
    return sqrt(best.d2);
}

double clast_bvh_signed_distance(const clast_bvh *bvh, const double point[3])
{
    if (bvh == NULL || point == NULL || isnan(point[0]) || isnan(point[1]) || isnan(point[2])) {
        return (double)NAN;
    }
    const double d = clast_bvh_closest(bvh, point, INFINITY, NULL, NULL);
    return clast_bvh_inside(bvh, point) ? -d : d;
}
