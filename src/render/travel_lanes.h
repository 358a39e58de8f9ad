#pragma once
// Rays against a scene: the tree of grains, then each grain's own surface in its own frame.
// Compiled once for any machine and once for AVX2 (render/floats.h).
//
// Boxes and triangles are looked at eight at a time in single precision, with bounds on what
// rounding does; what may be met is then tested in double. So the answer is that of the double test
// of every triangle.
#include "render/travel.h"

#include "geom/ray.h"
#include "render/floats.h"

enum { STACK = (CLX_WIDE_LANES - 1) * CLX_TREE_DEPTH + 2 * CLX_WIDE_LANES };

/// Slack for the rounding of float distances.
#define SLACK 0x1p-20

/// The same ray in a grain's frame, where its parameter t keeps its meaning.
typedef struct {
    clx_journey *journey;
    const clx_scene_shape *shape;
    int32_t grain;
    bool any;
    double origin[3];
    double direction[3];
    clx_ray ray;
    // of the test in single precision, in units of the shape's blocks
    float from[3]; ///< by the ray's axes
    float shear[2];
    float error; ///< of a corner's place across the ray; infinite: it says nothing
} leg;

/// Asks a leaf's items: returns the new end of the ray (t_high when nothing was hit; -INFINITY to
/// end the walk).
typedef double (*visitor)(void *context, int32_t leaf, double t_high);

/// Where the ray enters the eight boxes, and bits of those it meets at all. NaN (0 * infinity)
/// never wins a comparison and so leaves the interval as it is, which is the safe side.
CLX_INLINE uint32_t enter(const clx_wide_node *node, const clx_wide_ray *ray, float t_low,
                          float t_high, clx_floats *t)
{
    clx_floats in = floats_all(t_low);
    clx_floats out = floats_all(t_high);
    for (int k = 0; k < 3; ++k) {
        const int side = ray->is_negative[k];
        const clx_floats inverse = floats_all(ray->inverse[k]);
        const clx_floats near = floats_load(node->bound[side][k]);
        const clx_floats far = floats_load(node->bound[1 - side][k]);
        in = floats_greater(floats_mul(floats_sub(near, floats_all(ray->near[k])), inverse), in);
        out = floats_lesser(floats_mul(floats_sub(far, floats_all(ray->far[k])), inverse), out);
    }
    *t = in;
    return floats_at_most(in, floats_mul(out, floats_all(1.0F + (float)SLACK)));
}

/// Sorts few numbers.
CLX_INLINE void sort_ranks(int n, int32_t rank[CLX_WIDE_LANES])
{
    for (int i = 1; i < n; ++i) {
        const int32_t moved = rank[i];
        int j = i;
        for (; j > 0 && rank[j - 1] > moved; --j) {
            rank[j] = rank[j - 1];
        }
        rank[j] = moved;
    }
}

/// Visits the leaves that the ray meets between t_low >= 0 and t_high until a visit ends the walk;
/// the ray's new end.
CLX_INLINE double walk_any(const clx_wide *wide, const clx_wide_ray *ray, const uint64_t order[256],
                           double t_low, double t_high, visitor visit, void *context)
{
    int32_t stack[STACK];
    int n_stack = 1;
    stack[0] = 0;
    while (n_stack > 0) {
        const clx_wide_node *node = &wide->node[stack[--n_stack]];
        clx_floats entry;
        const uint32_t meets = enter(node, ray, (float)t_low, (float)t_high, &entry);
        for (uint32_t leaves = meets & node->leaves; leaves != 0; leaves &= leaves - 1) {
            t_high = visit(context, node->child[__builtin_ctz(leaves)], t_high);
            if (t_high < t_low) {
                return t_high;
            }
        }
        n_stack += floats_pack(stack + n_stack, node->child, meets & ~node->leaves, order);
    }
    return t_high;
}

/// Visits the leaves that the ray meets between t_low >= 0 and t_high, nearer boxes first; the
/// ray's new end.
CLX_INLINE double walk_first(const clx_wide *wide, const clx_wide_ray *ray,
                             const uint64_t order[256], double t_low, double t_high, visitor visit,
                             void *context)
{
    struct {
        int32_t node;
        float t;
    } stack[STACK];
    int n_stack = 1;
    stack[0].node = 0;
    stack[0].t = 0.0F;
    while (n_stack > 0) {
        --n_stack;
        if ((double)stack[n_stack].t * (1.0 - SLACK) > t_high) {
            continue;
        }
        const clx_wide_node *node = &wide->node[stack[n_stack].node];
        clx_floats entry;
        int32_t rank[CLX_WIDE_LANES];
        int32_t met[CLX_WIDE_LANES];
        float t[CLX_WIDE_LANES];
        const uint32_t meets = enter(node, ray, (float)t_low, (float)t_high, &entry);
        floats_store(t, entry);
        floats_rank(rank, entry);
        const int n = floats_pack(met, rank, meets, order);
        sort_ranks(n, met);
        // Leaves at once, nearest first; inner children onto the stack, nearest on top.
        for (int j = 0; j < n && (meets & node->leaves) != 0; ++j) {
            const int i = met[j] & 7;
            if ((node->leaves >> i & 1) != 0 && (double)t[i] * (1.0 - SLACK) <= t_high) {
                t_high = visit(context, node->child[i], t_high);
            }
        }
        for (int j = n - 1; j >= 0; --j) {
            const int i = met[j] & 7;
            stack[n_stack].node = node->child[i];
            stack[n_stack].t = t[i];
            n_stack += (node->leaves >> i & 1) == 0;
        }
    }
    return t_high;
}

CLX_INLINE double walk(const clx_wide *wide, const clx_wide_ray *ray, const clx_journey *j,
                       double t_high, bool any, visitor visit, void *context)
{
    const uint64_t *order = j->scene->lane_order;
    return any ? walk_any(wide, ray, order, j->t_low, t_high, visit, context)
               : walk_first(wide, ray, order, j->t_low, t_high, visit, context);
}

CLX_INLINE double accept(leg *l, double t, int32_t item, const double bary[3])
{
    clx_journey *j = l->journey;
    j->found = true;
    j->best.t = t;
    j->best.grain = l->grain;
    j->best.item = item;
    v3_copy(j->best.bary, bary);
    return l->any ? -(double)INFINITY : t;
}

/// First of the two crossings with the unit sphere at t_low <= t <= t_high, or INFINITY. The foot
/// of the perpendicular, not b^2 - 4 a c, keeps the digits for a far origin.
static double sphere_crossing(const double origin[3], const double direction[3], double radius,
                              double t_low, double t_high)
{
    const double d2 = v3_norm2(direction);
    const double middle = -v3_dot(origin, direction) / d2;
    double foot[3];
    v3_axpy(foot, origin, middle, direction);
    const double rest = radius * radius - v3_norm2(foot);
    if (rest < 0.0) {
        return INFINITY;
    }
    const double half = sqrt(rest / d2);
    if (middle - half >= t_low) {
        return middle - half <= t_high ? middle - half : (double)INFINITY;
    }
    return middle + half >= t_low && middle + half <= t_high ? middle + half : (double)INFINITY;
}

/// What the test in single precision needs of the ray. A corner's place across the ray is off by
/// less than 16 roundings (2^-24) of the largest number in play: twice that is allowed for.
CLX_INLINE void set_floats(leg *l)
{
    const double unit = l->shape->block_unit;
    double reach = l->shape->wide.reach * unit;
    for (int k = 0; k < 3; ++k) {
        const double at = l->ray.origin[l->ray.axis[k]] * unit;
        reach = fabs(at) > reach ? fabs(at) : reach;
        l->from[k] = (float)at;
    }
    l->shear[0] = (float)l->ray.shear[0];
    l->shear[1] = (float)l->ray.shear[1];
    l->error = reach < 0x1p40 ? (float)(0x1p-19 * reach) : INFINITY;
}

/// Bits of a block's triangles that the ray's line may meet: those not surely passed on one side of
/// an edge and on the other side of another.
CLX_INLINE uint32_t may_meet(const leg *l, const clx_scene_block *block)
{
    if (!(l->error < INFINITY)) {
        return (1U << CLX_WIDE_LANES) - 1;
    }
    const clx_floats error = floats_all(l->error);
    const clx_floats nil = floats_all(0.0F);
    clx_floats x[3];
    clx_floats y[3];
    clx_floats size[3];
    for (int i = 0; i < 3; ++i) {
        const clx_floats z =
            floats_sub(floats_load(block->corner[i][l->ray.axis[2]]), floats_all(l->from[2]));
        x[i] = floats_sub(
            floats_sub(floats_load(block->corner[i][l->ray.axis[0]]), floats_all(l->from[0])),
            floats_mul(floats_all(l->shear[0]), z));
        y[i] = floats_sub(
            floats_sub(floats_load(block->corner[i][l->ray.axis[1]]), floats_all(l->from[1])),
            floats_mul(floats_all(l->shear[1]), z));
        size[i] =
            floats_mul(floats_add(floats_add(floats_size(x[i]), floats_size(y[i])), error), error);
    }
    clx_floats least = floats_all(INFINITY);
    clx_floats most = floats_all(-INFINITY);
    for (int i = 0; i < 3; ++i) {
        const int a = (i + 1) % 3;
        const int b = (i + 2) % 3;
        const clx_floats edge =
            floats_sub(floats_mul(x[b], y[a]), floats_mul(y[b], x[a])); // clx_ray_meets
        const clx_floats off = floats_add(size[a], size[b]);
        least = floats_lesser(floats_add(edge, off), least);
        most = floats_greater(floats_sub(edge, off), most);
    }
    return floats_at_most(nil, least) | floats_at_most(most, nil);
}

CLX_INLINE double visit_triangles(void *context, int32_t leaf, double t_high)
{
    leg *l = context;
    const clx_scene_shape *shape = l->shape;
    const int32_t first = shape->wide.leaf[leaf].first;
    uint32_t candidates = may_meet(l, &shape->block[leaf]);
    candidates &= (1U << shape->wide.leaf[leaf].count) - 1;
    for (; candidates != 0; candidates &= candidates - 1) {
        const int32_t i = first + __builtin_ctz(candidates);
        const clx_journey *j = l->journey;
        double t = 0.0;
        double bary[3];
        if (!clx_ray_meets(&l->ray, shape->bvh->corner[i], j->t_low, t_high, &t, bary)) {
            continue;
        }
        if (l->any || !j->found || t < j->best.t || j->best.grain != l->grain || i < j->best.item) {
            t_high = accept(l, t, i, bary);
            if (l->any) {
                break;
            }
        }
    }
    return t_high;
}

static double visit_spheres(void *context, int32_t leaf, double t_high)
{
    static const double none[3] = {0.0, 0.0, 0.0};
    leg *l = context;
    const clx_wide_leaf items = l->shape->wide.leaf[leaf];
    for (int32_t i = items.first; i < items.first + items.count; ++i) {
        const int32_t s = l->shape->tree.item[i];
        double from[3];
        v3_sub(from, l->origin, l->shape->spheres->centre[s]);
        const double t = sphere_crossing(from, l->direction, l->shape->spheres->radius[s],
                                         l->journey->t_low, t_high);
        if (t < (double)INFINITY) {
            t_high = accept(l, t, s, none);
            if (l->any) {
                break;
            }
        }
    }
    return t_high;
}

static double visit_ellipsoid(leg *l, double t_high)
{
    static const double none[3] = {0.0, 0.0, 0.0};
    double origin[3];
    double direction[3];
    for (int k = 0; k < 3; ++k) {
        origin[k] = l->origin[k] * l->shape->per_axis[k];
        direction[k] = l->direction[k] * l->shape->per_axis[k];
    }
    const double t = sphere_crossing(origin, direction, 1.0, l->journey->t_low, t_high);
    return t < (double)INFINITY ? accept(l, t, 0, none) : t_high;
}

CLX_INLINE double visit_grain(clx_journey *j, int32_t g, double t_high, bool any)
{
    CLAST_ASSERT(g >= 0);
    const clx_scene_grain *grain = &j->scene->grain[g];
    leg l; // all of it is set as far as the grain's kind needs it
    double from[3];
    l.journey = j;
    l.shape = &j->scene->shape[grain->shape];
    l.grain = g;
    l.any = any;
    v3_sub(from, j->origin, grain->position);
    for (int k = 0; k < 3; ++k) {
        l.origin[k] = v3_dot(grain->inverse[k], from);
        l.direction[k] = v3_dot(grain->inverse[k], j->direction);
    }
    if (l.shape->kind == CLAST_SHAPE_SPHERE || l.shape->kind == CLAST_SHAPE_ELLIPSOID) {
        return visit_ellipsoid(&l, t_high);
    }
    const clx_wide_ray wide = clx_wide_ray_of(&l.shape->wide, l.origin, l.direction);
    if (l.shape->kind != CLAST_SHAPE_MESH) {
        return walk(&l.shape->wide, &wide, j, t_high, any, visit_spheres, &l);
    }
    if (!clx_ray_set(&l.ray, l.origin, l.direction)) {
        return t_high;
    }
    set_floats(&l);
    return walk(&l.shape->wide, &wide, j, t_high, any, visit_triangles, &l);
}

CLX_INLINE double visit_grains(clx_journey *j, int32_t leaf, double t_high, bool any)
{
    const clx_wide_leaf items = j->scene->wide.leaf[leaf];
    for (int32_t i = items.first; i < items.first + items.count; ++i) {
        t_high = visit_grain(j, j->scene->tree.item[i], t_high, any);
    }
    return t_high;
}

static double visit_grains_first(void *context, int32_t leaf, double t_high)
{
    return visit_grains(context, leaf, t_high, false);
}

static double visit_grains_any(void *context, int32_t leaf, double t_high)
{
    return visit_grains(context, leaf, t_high, true);
}

CLX_INLINE void travel(clx_journey *j, bool any)
{
    if (j->scene->n_grain == 1) {
        (void)visit_grain(j, 0, j->t_high, any);
        return;
    }
    const clx_wide_ray wide = clx_wide_ray_of(&j->scene->wide, j->origin, j->direction);
    (void)walk(&j->scene->wide, &wide, j, j->t_high, any,
               any ? visit_grains_any : visit_grains_first, j);
}
