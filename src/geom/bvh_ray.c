// Rays against the hierarchy: watertight triangle test in double, slabs widened by the rounding of
// that test.
//
// Source: Woop, Benthin and Wald 2013, Watertight ray/triangle intersection, JCGT 2(1). The ray is
// sheared and its axes permuted so that it runs along z; edge functions of two triangles that share
// an edge are then exact negatives of each other, so a ray on the edge meets at least one of them.
#include "geom/bvh.h"

#include "math/vec3.h"

/// Everything about a ray that does not depend on the triangle or box.
typedef struct {
    double origin[3];
    int axis[3];       ///< permutation: axis[2] is the dominant one
    double shear[3];   ///< [2] is 1 / direction[axis[2]]
    double inverse[3]; ///< 1 / direction, infinite for 0
    double near[3];    ///< origin shifted so that boxes seem wider than they are
    double far[3];
    bool is_negative[3];
    double t_low;
    double t_high;
} ray_frame;

static bool frame_of(const clast_bvh *bvh, const double origin[3], const double direction[3],
                     double t_low, double t_high, ray_frame *ray)
{
    int z = fabs(direction[0]) > fabs(direction[1]) ? 0 : 1;
    z = fabs(direction[2]) > fabs(direction[z]) ? 2 : z;
    if (direction[z] == 0.0) {
        return false;
    }
    const int next = (z + 1) % 3;
    const int last = (z + 2) % 3;
    // Swapping x and y keeps the handedness when the ray runs backwards.
    ray->axis[0] = direction[z] < 0.0 ? last : next;
    ray->axis[1] = direction[z] < 0.0 ? next : last;
    ray->axis[2] = z;
    ray->shear[0] = direction[ray->axis[0]] / direction[z];
    ray->shear[1] = direction[ray->axis[1]] / direction[z];
    ray->shear[2] = 1.0 / direction[z];
    // The triangle test moves a corner by less than 8 ulp of the largest number in play.
    const double reach =
        fmax(fmax(fabs(origin[0]), fabs(origin[1])), fmax(fabs(origin[2]), bvh->reach));
    const double widen = 0x1p-49 * reach;
    for (int k = 0; k < 3; ++k) {
        ray->origin[k] = origin[k];
        ray->inverse[k] = 1.0 / direction[k];
        ray->is_negative[k] = signbit(direction[k]);
        ray->near[k] = ray->is_negative[k] ? origin[k] - widen : origin[k] + widen;
        ray->far[k] = ray->is_negative[k] ? origin[k] + widen : origin[k] - widen;
    }
    ray->t_low = t_low;
    ray->t_high = t_high;
    return true;
}

/// Where the ray enters the box, or INFINITY when it misses it between t_low and t_high. NaN from
/// 0 * infinity leaves the interval as it is, which is the safe side.
static double enter(const clx_tree_node *node, const ray_frame *ray)
{
    double t_in = ray->t_low;
    double t_out = ray->t_high;
    for (int k = 0; k < 3; ++k) {
        const double a = ray->is_negative[k] ? node->high[k] : node->low[k];
        const double b = ray->is_negative[k] ? node->low[k] : node->high[k];
        const double t_a = (a - ray->near[k]) * ray->inverse[k];
        const double t_b = (b - ray->far[k]) * ray->inverse[k];
        t_in = t_a > t_in ? t_a : t_in;
        t_out = t_b < t_out ? t_b : t_out;
    }
    // Slack for the rounding of the slab distances themselves [Ize2013].
    return t_in - 0x1p-50 * fabs(t_in) <= t_out + 0x1p-50 * fabs(t_out) ? t_in : (double)INFINITY;
}

/// Test of one triangle; true (and t, bary) when hit within [t_low, t_high].
static bool meet(double corner[3][3], const ray_frame *ray, double *t, double bary[3])
{
    double x[3];
    double y[3];
    double z[3];
    for (int i = 0; i < 3; ++i) {
        z[i] = corner[i][ray->axis[2]] - ray->origin[ray->axis[2]];
        x[i] = corner[i][ray->axis[0]] - ray->origin[ray->axis[0]] - ray->shear[0] * z[i];
        y[i] = corner[i][ray->axis[1]] - ray->origin[ray->axis[1]] - ray->shear[1] * z[i];
    }
    const double u = x[2] * y[1] - y[2] * x[1];
    const double v = x[0] * y[2] - y[0] * x[2];
    const double w = x[1] * y[0] - y[1] * x[0];
    if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) {
        return false;
    }
    const double det = u + v + w;
    if (det == 0.0) {
        return false; // seen edge-on
    }
    const double at = (u * z[0] + v * z[1] + w * z[2]) * ray->shear[2] / det;
    if (!(at >= ray->t_low && at <= ray->t_high)) {
        return false;
    }
    *t = at;
    v3_set(bary, u / det, v / det, w / det);
    return true;
}

/// Tests a leaf's triangles and shortens the ray to the nearest hit; true if any is hit.
static bool visit_leaf(const clast_bvh *bvh, const clx_tree_node *node, ray_frame *ray,
                       clast_hit *hit)
{
    bool found = false;
    for (int32_t i = node->first; i < node->first + node->count; ++i) {
        double t = 0.0;
        double bary[3];
        if (!meet(bvh->corner[i], ray, &t, bary)) {
            continue;
        }
        // Two triangles at the same t: the lower number wins, whatever the order of the visits.
        const int32_t tri = bvh->tree.item[i];
        if (!(t == hit->t && tri > hit->tri)) {
            hit->t = t;
            hit->tri = tri;
            v3_copy(hit->bary, bary);
            ray->t_high = t;
            found = true;
        }
    }
    return found;
}

/// Nearest hit, or any when `any` is set.
static bool walk(const clast_bvh *bvh, ray_frame *ray, bool any, clast_hit *hit)
{
    struct {
        int32_t node;
        double t;
    } stack[CLX_TREE_DEPTH];
    int n_stack = 0;
    bool found = false;
    const clx_tree_node *nodes = bvh->tree.node;
    int32_t at = 0;
    if (enter(&nodes[0], ray) == (double)INFINITY) {
        return false;
    }
    for (;;) {
        const clx_tree_node *node = &nodes[at];
        if (node->right != 0) {
            int32_t near = at + 1;
            int32_t far = node->right;
            double t_near = enter(&nodes[near], ray);
            double t_far = enter(&nodes[far], ray);
            if (t_far < t_near) {
                const double swap = t_near;
                t_near = t_far;
                t_far = swap;
                near = node->right;
                far = at + 1;
            }
            if (t_far < (double)INFINITY) {
                stack[n_stack].node = far;
                stack[n_stack++].t = t_far;
            }
            if (t_near < (double)INFINITY) {
                at = near;
                continue;
            }
        } else if (visit_leaf(bvh, node, ray, hit)) {
            found = true;
            if (any) {
                return true;
            }
        }
        do {
            if (n_stack == 0) {
                return found;
            }
            --n_stack;
        } while (stack[n_stack].t - 0x1p-50 * fabs(stack[n_stack].t) > ray->t_high);
        at = stack[n_stack].node;
    }
}

bool clast_bvh_ray(const clast_bvh *bvh, const double origin[3], const double direction[3],
                   double t_low, double t_high, clast_hit *hit)
{
    ray_frame ray;
    clast_hit best = {.t = INFINITY, .tri = INT32_MAX};
    if (!frame_of(bvh, origin, direction, t_low, t_high, &ray) || !walk(bvh, &ray, false, &best)) {
        return false;
    }
    *hit = best;
    return true;
}

bool clx_bvh_blocked(const clast_bvh *bvh, const double origin[3], const double direction[3],
                     double t_low, double t_high)
{
    ray_frame ray;
    clast_hit best = {.t = INFINITY, .tri = INT32_MAX};
    return frame_of(bvh, origin, direction, t_low, t_high, &ray) && walk(bvh, &ray, true, &best);
}
