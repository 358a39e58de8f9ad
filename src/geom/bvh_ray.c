// Rays against the hierarchy: slabs widened by the rounding of the triangle test (geom/ray.h).
#include "geom/bvh.h"

#include "geom/ray.h"

typedef struct {
    clx_ray ray;
    double inverse[3]; ///< 1 / direction, infinite for 0
    double near[3];    ///< origin shifted so that boxes seem wider than they are
    double far[3];
    bool is_negative[3];
    double t_low;
    double t_high;
} ray_frame;

static bool frame_of(const clast_bvh *bvh, const double origin[3], const double direction[3],
                     double t_low, double t_high, ray_frame *frame)
{
    // The triangle test moves a corner by less than 8 ulp of the largest number in play.
    const double max_abs =
        fmax(fmax(fabs(origin[0]), fabs(origin[1])), fmax(fabs(origin[2]), bvh->max_abs));
    const double widen = 0x1p-49 * max_abs;
    for (int k = 0; k < 3; ++k) {
        const bool is_negative = signbit(direction[k]);
        frame->inverse[k] = 1.0 / direction[k];
        frame->is_negative[k] = is_negative;
        frame->near[k] = is_negative ? origin[k] - widen : origin[k] + widen;
        frame->far[k] = is_negative ? origin[k] + widen : origin[k] - widen;
    }
    frame->t_low = t_low;
    frame->t_high = t_high;
    return clx_ray_set(&frame->ray, origin, direction);
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

/// Tests a leaf's triangles and shortens the ray to the nearest hit; true if any is hit.
static bool visit_leaf(const clast_bvh *bvh, const clx_tree_node *node, ray_frame *ray,
                       clast_hit *hit)
{
    CLAST_ASSERT(node->right == 0 && node->count > 0);
    bool found = false;
    for (int32_t i = node->first; i < node->first + node->count; ++i) {
        double t = 0.0;
        double bary[3];
        if (!clx_ray_meets(&ray->ray, bvh->corner[i], ray->t_low, ray->t_high, &t, bary)) {
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

/// Nearest hit.
static bool walk(const clast_bvh *bvh, ray_frame *ray, clast_hit *hit)
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
    if (bvh == NULL || origin == NULL || direction == NULL || hit == NULL) {
        return false;
    }
    ray_frame ray;
    clast_hit best = {.t = INFINITY, .tri = INT32_MAX};
    if (!frame_of(bvh, origin, direction, t_low, t_high, &ray) || !walk(bvh, &ray, &best)) {
        return false;
    }
    *hit = best;
    return true;
}
