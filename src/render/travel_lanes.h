#pragma once
// Bundles of rays against a scene: the tree of grains, then each grain's own surface in its frame.
// Nodes are asked once for the whole bundle, triangles for each ray.
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

/// One of the rays in a grain's frame, where its parameter t keeps its meaning.
typedef struct {
    double origin[3];
    double direction[3];
    clx_ray ray;
    // of the test in single precision, in units of the shape's blocks
    float from[3]; ///< by the ray's axes
    float shear[2];
    float error; ///< of a corner's place across the ray; infinite: it says nothing
} leg;

/// The bundle in a grain's frame.
typedef struct {
    clx_journey *journey;
    const clx_scene_shape *shape;
    int32_t grain;
    uint32_t rays; ///< bits of those that are in `leg`
    leg leg[CLX_BUNDLE];
    // The same side by side, as clx_wide_beam has them.
    float from[2][3][CLX_BUNDLE];
    float inverse[3][CLX_BUNDLE];
    float t_low[CLX_BUNDLE], t_high[CLX_BUNDLE];
} legs;

/// A bundle on its way through a tree.
typedef struct {
    const clx_wide *wide;
    clx_wide_beam beam;
    const uint64_t *order; ///< of floats_pack
    double t_low;
} course;

/// Asks the items of the leaf in a lane, entered at t: the bundle's new end (-INFINITY to end the
/// walk).
typedef double (*visitor)(void *context, const clx_wide_node *node, int lane, double t);

/// Where the beam enters the eight boxes, and bits of those it meets at all. NaN (0 * infinity)
/// never wins a comparison and so leaves the interval as it is, which is the safe side.
CLX_INLINE uint32_t enter(const clx_wide_node *node, const clx_wide_beam *beam, float t_low,
                          float t_high, clx_floats *t)
{
    clx_floats in = floats_all(t_low);
    clx_floats out = floats_all(t_high);
    for (int k = 0; k < 3; ++k) {
        clx_floats pass[2];
        for (int i = 0; i < 2; ++i) {
            const int face = beam->first[k] ^ i;
            pass[i] = floats_mul(
                floats_sub(floats_load(node->bound[face][k]), floats_all(beam->from[face][k])),
                floats_all(beam->inverse[face][k]));
        }
        in = floats_greater(pass[0], in);
        if (beam->is_spread[k]) {
            in = floats_greater(pass[1], in);
        } else {
            out = floats_lesser(pass[1], out);
        }
    }
    *t = in;
    return floats_at_most(in, floats_mul(out, floats_all(1.0F + (float)SLACK))) & node->used;
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

/// Visits the leaves that the beam meets between t_low >= 0 and t_high until a visit ends the walk;
/// the bundle's new end.
CLX_INLINE double walk_any(const course *c, double t_high, visitor visit, void *context)
{
    int32_t stack[STACK];
    int n_stack = 1;
    stack[0] = 0;
    while (n_stack > 0) {
        const clx_wide_node *node = &c->wide->node[stack[--n_stack]];
        clx_floats entry;
        const uint32_t meets = enter(node, &c->beam, (float)c->t_low, (float)t_high, &entry);
        for (uint32_t leaves = meets & node->leaves; leaves != 0; leaves &= leaves - 1) {
            t_high = visit(context, node, __builtin_ctz(leaves), c->t_low);
            if (t_high < c->t_low) {
                return t_high;
            }
        }
        n_stack += floats_pack(stack + n_stack, node->child, meets & ~node->leaves, c->order);
    }
    return t_high;
}

/// Visits the leaves that the beam meets between t_low >= 0 and t_high, nearer boxes first; the
/// bundle's new end.
CLX_INLINE double walk_first(const course *c, double t_high, visitor visit, void *context)
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
        const clx_wide_node *node = &c->wide->node[stack[n_stack].node];
        clx_floats entry;
        int32_t rank[CLX_WIDE_LANES];
        int32_t met[CLX_WIDE_LANES];
        float t[CLX_WIDE_LANES];
        const uint32_t meets = enter(node, &c->beam, (float)c->t_low, (float)t_high, &entry);
        floats_store(t, entry);
        floats_rank(rank, entry);
        const int n = floats_pack(met, rank, meets, c->order);
        sort_ranks(n, met);
        // Leaves at once, nearest first; inner children onto the stack, nearest on top.
        for (int j = 0; j < n && (meets & node->leaves) != 0; ++j) {
            const int i = met[j] & 7;
            if ((node->leaves >> i & 1) != 0 && (double)t[i] * (1.0 - SLACK) <= t_high) {
                t_high = visit(context, node, i, (double)t[i] * (1.0 - SLACK));
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

/// Least and greatest of a bundle's origins and directions, and where the first of its rays begins.
typedef struct {
    double origin[2][3];
    double direction[2][3];
    double t_low;
} ends;

static const ends no_ends = {{{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}},
                             {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}},
                             INFINITY};

CLX_INLINE void add_ray(ends *e, const double origin[3], const double direction[3], double t_low)
{
    for (int k = 0; k < 3; ++k) {
        const double o = origin[k];
        const double d = direction[k];
        e->origin[0][k] = o < e->origin[0][k] ? o : e->origin[0][k];
        e->origin[1][k] = o > e->origin[1][k] ? o : e->origin[1][k];
        e->direction[0][k] = d < e->direction[0][k] ? d : e->direction[0][k];
        e->direction[1][k] = d > e->direction[1][k] ? d : e->direction[1][k];
    }
    e->t_low = t_low < e->t_low ? t_low : e->t_low;
}

/// Where the last of the rays that still look ends.
CLX_INLINE double end_of(const clx_journey *j)
{
    double t = -(double)INFINITY;
    for (uint32_t rays = j->active; rays != 0; rays &= rays - 1) {
        const double end = j->t_high[__builtin_ctz(rays)];
        t = end > t ? end : t;
    }
    return t;
}

/// Sends the bundle through a tree.
CLX_INLINE void walk(const clx_journey *j, const clx_wide *wide, ends *at, visitor visit,
                     void *context)
{
    const course c = {
        wide, clx_wide_beam_of(at->origin, at->direction, clx_wide_margin(wide, at->origin)),
        j->scene->lane_order, at->t_low};
    if (j->best != NULL) {
        (void)walk_first(&c, end_of(j), visit, context);
    } else {
        (void)walk_any(&c, end_of(j), visit, context);
    }
}

/// A ray's new surface if it is nearer than the last, or before it in order where they are equal.
CLX_INLINE void accept(legs *l, int r, double t, int32_t item, const double bary[3])
{
    clx_journey *j = l->journey;
    if (j->best == NULL) {
        j->active &= ~(1U << r);
    } else {
        clx_scene_hit *best = &j->best[r];
        if ((j->found >> r & 1) == 0 || t < best->t || l->grain < best->grain ||
            (l->grain == best->grain && item < best->item)) {
            best->t = t;
            best->grain = l->grain;
            best->item = item;
            v3_copy(best->bary, bary);
        }
        j->t_high[r] = t;
        l->t_high[r] = (float)t;
    }
    j->found |= 1U << r;
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

/// Bits of the rays that still look and enter the box of a leaf.
CLX_INLINE uint32_t rays_that_enter(const legs *l, const clx_wide_node *node, int lane)
{
    const uint32_t rays = l->journey->active & l->rays;
    if ((rays & (rays - 1)) == 0) { // as its beam does
        return rays;
    }
    uint32_t enters = 0;
    for (int first = 0; first < CLX_BUNDLE; first += CLX_WIDE_LANES) {
        clx_floats in = floats_load(l->t_low + first);
        clx_floats out = floats_load(l->t_high + first);
        for (int k = 0; k < 3; ++k) {
            const clx_floats inverse = floats_load(l->inverse[k] + first);
            clx_floats pass[2];
            for (int i = 0; i < 2; ++i) {
                pass[i] = floats_mul(floats_sub(floats_all(node->bound[i][k][lane]),
                                                floats_load(l->from[i][k] + first)),
                                     inverse);
            }
            in = floats_greater(floats_lesser(pass[0], pass[1]), in);
            out = floats_lesser(floats_greater(pass[0], pass[1]), out);
        }
        enters |= floats_at_most(in, floats_mul(out, floats_all(1.0F + (float)SLACK))) << first;
    }
    return rays & enters;
}

/// What the test in single precision needs of the ray. A corner's place across the ray is off by
/// less than 16 roundings (2^-24) of the largest number in play: twice that is allowed for.
CLX_INLINE void set_floats(const clx_scene_shape *shape, leg *l)
{
    const double unit = shape->block_unit;
    double max_abs = shape->wide.max_abs * unit;
    for (int k = 0; k < 3; ++k) {
        const double at = l->ray.origin[l->ray.axis[k]] * unit;
        max_abs = fabs(at) > max_abs ? fabs(at) : max_abs;
        l->from[k] = (float)at;
    }
    l->shear[0] = (float)l->ray.shear[0];
    l->shear[1] = (float)l->ray.shear[1];
    l->error = max_abs < 0x1p40 ? (float)(0x1p-19 * max_abs) : INFINITY;
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

CLX_INLINE double visit_triangles(void *context, const clx_wide_node *node, int lane, double t)
{
    legs *l = context;
    clx_journey *j = l->journey;
    const int32_t leaf = node->child[lane];
    const clx_scene_block *block = &l->shape->block[leaf];
    const int32_t first = l->shape->wide.leaf[leaf].first;
    const uint32_t all = (1U << l->shape->wide.leaf[leaf].count) - 1;
    for (uint32_t rays = rays_that_enter(l, node, lane); rays != 0; rays &= rays - 1) {
        const int r = __builtin_ctz(rays);
        uint32_t may = t <= j->t_high[r] ? may_meet(&l->leg[r], block) & all : 0;
        for (; may != 0 && (j->active >> r & 1) != 0; may &= may - 1) {
            const int32_t i = first + __builtin_ctz(may);
            double at = 0.0;
            double bary[3];
            if (clx_ray_meets(&l->leg[r].ray, l->shape->bvh->corner[i], j->t_low[r], j->t_high[r],
                              &at, bary)) {
                accept(l, r, at, i, bary);
            }
        }
    }
    return end_of(j);
}

static const double none[3] = {0.0, 0.0, 0.0};

static double visit_spheres(void *context, const clx_wide_node *node, int lane, double t)
{
    legs *l = context;
    clx_journey *j = l->journey;
    const clx_wide_leaf items = l->shape->wide.leaf[node->child[lane]];
    for (uint32_t rays = rays_that_enter(l, node, lane); rays != 0; rays &= rays - 1) {
        const int r = __builtin_ctz(rays);
        for (int32_t i = items.first; i < items.first + items.count && t <= j->t_high[r]; ++i) {
            const int32_t s = l->shape->tree.item[i];
            double from[3];
            v3_sub(from, l->leg[r].origin, l->shape->spheres->centre[s]);
            const double at = sphere_crossing(
                from, l->leg[r].direction, l->shape->spheres->radius[s], j->t_low[r], j->t_high[r]);
            if (at < (double)INFINITY) {
                accept(l, r, at, s, none);
            }
        }
    }
    return end_of(j);
}

static void visit_ellipsoid(legs *l)
{
    clx_journey *j = l->journey;
    for (uint32_t rays = l->rays; rays != 0; rays &= rays - 1) {
        const int r = __builtin_ctz(rays);
        double origin[3];
        double direction[3];
        for (int k = 0; k < 3; ++k) {
            origin[k] = l->leg[r].origin[k] * l->shape->per_axis[k];
            direction[k] = l->leg[r].direction[k] * l->shape->per_axis[k];
        }
        const double at = sphere_crossing(origin, direction, 1.0, j->t_low[r], j->t_high[r]);
        if (at < (double)INFINITY) {
            accept(l, r, at, 0, none);
        }
    }
}

/// The rays that may meet a grain which the bundle enters at t, in the grain's frame.
CLX_INLINE void set_legs(clx_journey *j, int32_t g, double t, legs *l)
{
    const clx_scene_grain *grain = &j->scene->grain[g];
    l->journey = j;
    l->shape = &j->scene->shape[grain->shape];
    l->grain = g;
    l->rays = j->active;
    for (uint32_t rays = j->active; rays != 0; rays &= rays - 1) {
        const int r = __builtin_ctz(rays);
        leg *to = &l->leg[r]; // all of it is set as far as the grain's kind needs it
        double from[3];
        v3_sub(from, j->origin[r], grain->position);
        for (int k = 0; k < 3; ++k) {
            to->origin[k] = v3_dot(grain->inverse[k], from);
            to->direction[k] = v3_dot(grain->inverse[k], j->direction[r]);
        }
        if (t > j->t_high[r] || (l->shape->kind == CLAST_SHAPE_MESH &&
                                 !clx_ray_set(&to->ray, to->origin, to->direction))) {
            l->rays &= ~(1U << r);
        } else if (l->shape->kind == CLAST_SHAPE_MESH) {
            set_floats(l->shape, to);
        }
    }
}

/// Fills what rays_that_enter needs of more than one ray.
CLX_INLINE void set_side_by_side(legs *l, double margin)
{
    const clx_journey *j = l->journey;
    if ((l->rays & (l->rays - 1)) == 0) {
        return;
    }
    for (uint32_t rays = l->rays; rays != 0; rays &= rays - 1) {
        const int r = __builtin_ctz(rays);
        for (int k = 0; k < 3; ++k) {
            l->from[0][k][r] = (float)(l->leg[r].origin[k] + margin);
            l->from[1][k][r] = (float)(l->leg[r].origin[k] - margin);
            l->inverse[k][r] = (float)(1.0 / l->leg[r].direction[k]);
        }
        l->t_low[r] = (float)j->t_low[r];
        l->t_high[r] = (float)j->t_high[r];
    }
}

CLX_INLINE void visit_grain(clx_journey *j, int32_t g, double t)
{
    CLAST_ASSERT(g >= 0);
    legs l;
    ends at = no_ends;
    set_legs(j, g, t, &l);
    if (l.shape->kind == CLAST_SHAPE_SPHERE || l.shape->kind == CLAST_SHAPE_ELLIPSOID) {
        visit_ellipsoid(&l);
        return;
    }
    for (uint32_t rays = l.rays; rays != 0; rays &= rays - 1) {
        const int r = __builtin_ctz(rays);
        add_ray(&at, l.leg[r].origin, l.leg[r].direction, j->t_low[r]);
    }
    if (l.rays != 0) {
        set_side_by_side(&l, clx_wide_margin(&l.shape->wide, at.origin));
        walk(j, &l.shape->wide, &at,
             l.shape->kind == CLAST_SHAPE_MESH ? visit_triangles : visit_spheres, &l);
    }
}

static double visit_grains(void *context, const clx_wide_node *node, int lane, double t)
{
    clx_journey *j = context;
    const clx_wide_leaf items = j->scene->wide.leaf[node->child[lane]];
    for (int32_t i = items.first; i < items.first + items.count && j->active != 0; ++i) {
        visit_grain(j, j->scene->tree.item[i], t);
    }
    return end_of(j);
}

CLX_INLINE void travel(clx_journey *j)
{
    if (j->active == 0) {
        return;
    }
    if (j->scene->n_grain == 1) {
        visit_grain(j, 0, 0.0);
        return;
    }
    ends at = no_ends;
    for (uint32_t rays = j->active; rays != 0; rays &= rays - 1) {
        const int r = __builtin_ctz(rays);
        add_ray(&at, j->origin[r], j->direction[r], j->t_low[r]);
    }
    walk(j, &j->scene->wide, &at, visit_grains, j);
}
