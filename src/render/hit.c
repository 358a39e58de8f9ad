// Rays against a scene: the tree of grains, then each grain's own surface in its own frame.
#include "render/scene.h"

#include "geom/ray.h"
#include <clast/shape.h>

/// A ray on its way through the scene.
typedef struct {
    const clx_scene *scene;
    const double *origin;
    const double *direction;
    double t_low;
    bool any;
    bool found;
    clx_scene_hit best; ///< t, grain, item, bary
} journey;

/// The same ray in a grain's frame, where its parameter t keeps its meaning.
typedef struct {
    journey *journey;
    const clx_scene_shape *shape;
    int32_t grain;
    double origin[3];
    double direction[3];
    clx_ray ray;
} leg;

static double accept(leg *l, double t, int32_t item, const double bary[3])
{
    journey *j = l->journey;
    j->found = true;
    j->best.t = t;
    j->best.grain = l->grain;
    j->best.item = item;
    v3_copy(j->best.bary, bary);
    return j->any ? -(double)INFINITY : t;
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

static double visit_triangles(void *context, int32_t first, int32_t count, double t_high)
{
    leg *l = context;
    for (int32_t i = first; i < first + count; ++i) {
        double t = 0.0;
        double bary[3];
        if (clx_ray_meets(&l->ray, l->shape->bvh->corner[i], l->journey->t_low, t_high, &t, bary)) {
            t_high = accept(l, t, i, bary);
            if (l->journey->any) {
                break;
            }
        }
    }
    return t_high;
}

static double visit_spheres(void *context, int32_t first, int32_t count, double t_high)
{
    static const double none[3] = {0.0, 0.0, 0.0};
    leg *l = context;
    for (int32_t i = first; i < first + count; ++i) {
        const int32_t s = l->shape->tree.item[i];
        double from[3];
        v3_sub(from, l->origin, l->shape->spheres->centre[s]);
        const double t = sphere_crossing(from, l->direction, l->shape->spheres->radius[s],
                                         l->journey->t_low, t_high);
        if (t < (double)INFINITY) {
            t_high = accept(l, t, s, none);
            if (l->journey->any) {
                break;
            }
        }
    }
    return t_high;
}

static void to_local(const clx_scene_grain *grain, const double v[3], double local[3])
{
    for (int k = 0; k < 3; ++k) {
        local[k] = v3_dot(grain->inverse[k], v);
    }
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

static double visit_grain(journey *j, int32_t g, double t_high)
{
    CLAST_ASSERT(g >= 0);
    const clx_scene_grain *grain = &j->scene->grain[g];
    leg l = {.journey = j, .shape = &j->scene->shape[grain->shape], .grain = g};
    double from[3];
    v3_sub(from, j->origin, grain->position);
    to_local(grain, from, l.origin);
    to_local(grain, j->direction, l.direction);
    if (l.shape->kind == CLAST_SHAPE_SPHERE || l.shape->kind == CLAST_SHAPE_ELLIPSOID) {
        return visit_ellipsoid(&l, t_high);
    }
    (void)clx_ray_set(&l.ray, l.origin, l.direction);
    const clx_wide_ray wide = clx_wide_ray_of(&l.shape->wide, l.origin, l.direction);
    const clx_wide_visit visit =
        l.shape->kind == CLAST_SHAPE_MESH ? visit_triangles : visit_spheres;
    return clx_wide_walk(&l.shape->wide, &wide, j->t_low, t_high, visit, &l);
}

static double visit_grains(void *context, int32_t first, int32_t count, double t_high)
{
    journey *j = context;
    for (int32_t i = first; i < first + count; ++i) {
        t_high = visit_grain(j, j->scene->tree.item[i], t_high);
    }
    return t_high;
}

bool clx_scene_clip(const clx_scene *scene, const double origin[3], const double direction[3],
                    double *t_low, double *t_high, bool *is_entered)
{
    *is_entered = false;
    if (scene->cut.is_on) {
        const double along = v3_dot(scene->cut.normal, direction);
        const double gap = scene->cut.offset - v3_dot(scene->cut.normal, origin);
        if (along > 0.0) {
            *t_high = fmin(*t_high, gap / along);
        } else if (along < 0.0) {
            *is_entered = gap / along > *t_low;
            *t_low = fmax(*t_low, gap / along);
        } else if (gap < 0.0) {
            return false;
        }
    }
    return *t_low <= *t_high;
}

static bool travel(journey *j, double t_low, double t_high)
{
    bool is_entered = false;
    if (!clx_scene_clip(j->scene, j->origin, j->direction, &t_low, &t_high, &is_entered)) {
        return false;
    }
    j->t_low = t_low;
    if (j->scene->n_grain == 1) {
        (void)visit_grain(j, 0, t_high);
        return j->found;
    }
    const clx_wide_ray wide = clx_wide_ray_of(&j->scene->wide, j->origin, j->direction);
    (void)clx_wide_walk(&j->scene->wide, &wide, t_low, t_high, visit_grains, j);
    return j->found;
}

bool clx_scene_blocked(const clx_scene *scene, const double origin[3], const double direction[3],
                       double t_low, double t_high)
{
    journey j = {.scene = scene, .origin = origin, .direction = direction, .any = true};
    return travel(&j, t_low, t_high);
}

/// Normals of a triangle hit in the shape's frame; `at` is lifted to the smooth surface that the
/// corner normals suggest, so that shadows do not follow coarse facets [Hanika2021].
static void triangle_normals(const clx_scene_shape *shape, const clx_scene_hit *hit, double at[3],
                             double face[3], double normal[3])
{
    CLAST_ASSERT(hit->item >= 0);
    double(*corner)[3] = shape->bvh->corner[hit->item];
    double u[3];
    double v[3];
    v3_sub(u, corner[1], corner[0]);
    v3_sub(v, corner[2], corner[0]);
    v3_cross(face, u, v);
    (void)v3_unit(face, face);
    v3_copy(normal, face);
    if (shape->normal == NULL) {
        return;
    }
    double lift[3] = {0.0, 0.0, 0.0};
    v3_set(normal, 0.0, 0.0, 0.0);
    for (int k = 0; k < 3; ++k) {
        const double n[3] = {(double)shape->normal[hit->item][k][0],
                             (double)shape->normal[hit->item][k][1],
                             (double)shape->normal[hit->item][k][2]};
        double from[3];
        v3_axpy(normal, normal, hit->bary[k], n);
        v3_sub(from, at, corner[k]);
        v3_axpy(lift, lift, -hit->bary[k] * fmin(0.0, v3_dot(from, n)), n);
    }
    v3_add(at, at, lift);
    if (!v3_unit(normal, normal)) {
        v3_copy(normal, face);
    }
}

/// Point, face and shading normal of a hit, in the shape's frame.
static void local_surface(const clx_scene_shape *shape, const clx_scene_hit *hit, double at[3],
                          double face[3], double normal[3])
{
    if (shape->kind == CLAST_SHAPE_MESH) {
        v3_set(at, 0.0, 0.0, 0.0);
        for (int k = 0; k < 3; ++k) {
            v3_axpy(at, at, hit->bary[k], shape->bvh->corner[hit->item][k]);
        }
        triangle_normals(shape, hit, at, face, normal);
        return;
    }
    if (shape->kind == CLAST_SHAPE_CLUMP) {
        v3_sub(face, at, shape->spheres->centre[hit->item]);
    } else {
        for (int k = 0; k < 3; ++k) {
            face[k] = at[k] * shape->per_axis[k] * shape->per_axis[k];
        }
    }
    (void)v3_unit(face, face);
    v3_copy(normal, face);
}

static void turn_to_world(const clx_scene_grain *grain, double v[3])
{
    const double local[3] = {v[0], v[1], v[2]};
    for (int k = 0; k < 3; ++k) {
        v[k] = v3_dot(grain->rotation[k], local);
    }
}

/// Fills point and normals of a hit and turns them towards the viewer.
static void describe(const journey *j, clx_scene_hit *hit)
{
    const clx_scene_grain *grain = &j->scene->grain[hit->grain];
    double at[3];
    double world[3];
    v3_axpy(world, j->origin, hit->t, j->direction);
    v3_sub(world, world, grain->position);
    to_local(grain, world, at);
    local_surface(&j->scene->shape[grain->shape], hit, at, hit->face, hit->normal);
    turn_to_world(grain, at);
    turn_to_world(grain, hit->face);
    turn_to_world(grain, hit->normal);
    v3_axpy(hit->point, grain->position, grain->scale, at);
    hit->is_lifted = j->scene->shape[grain->shape].normal != NULL;
    if (v3_dot(hit->face, j->direction) > 0.0) {
        v3_scale(hit->face, -1.0, hit->face);
        v3_scale(hit->normal, -1.0, hit->normal);
        v3_axpy(hit->point, j->origin, hit->t, j->direction); // the lift is for fronts only
        hit->is_lifted = false;
    }
}

bool clx_scene_hit_first(const clx_scene *scene, const double origin[3], const double direction[3],
                         double t_low, double t_high, clx_scene_hit *hit)
{
    journey j = {.scene = scene, .origin = origin, .direction = direction, .any = false};
    if (!travel(&j, t_low, t_high)) {
        return false;
    }
    *hit = j.best;
    describe(&j, hit);
    return true;
}

static bool holds(const clx_scene *scene, int32_t g, const double point[3])
{
    const clx_scene_grain *grain = &scene->grain[g];
    const clx_scene_shape *shape = &scene->shape[grain->shape];
    double from[3];
    double at[3];
    v3_sub(from, point, grain->position);
    to_local(grain, from, at);
    if (shape->kind == CLAST_SHAPE_MESH) {
        return clast_bvh_inside(shape->bvh, at);
    }
    if (shape->kind == CLAST_SHAPE_CLUMP) {
        for (int32_t s = 0; s < shape->spheres->n; ++s) {
            if (v3_distance(at, shape->spheres->centre[s]) <= shape->spheres->radius[s]) {
                return true;
            }
        }
        return false;
    }
    for (int k = 0; k < 3; ++k) {
        at[k] *= shape->per_axis[k];
    }
    return v3_norm2(at) <= 1.0;
}

int32_t clx_scene_holder(const clx_scene *scene, const double point[3])
{
    int32_t stack[CLX_TREE_DEPTH + 1];
    int n_stack = 1;
    int32_t best = INT32_MAX;
    stack[0] = 0;
    while (n_stack > 0) {
        const int32_t at = stack[--n_stack];
        const clx_tree_node *node = &scene->tree.node[at];
        bool is_in = true;
        for (int k = 0; k < 3; ++k) {
            is_in = is_in && point[k] >= node->low[k] && point[k] <= node->high[k];
        }
        if (!is_in) {
            continue;
        }
        if (node->right != 0) {
            stack[n_stack++] = node->right;
            stack[n_stack++] = at + 1;
            continue;
        }
        for (int32_t i = node->first; i < node->first + node->count; ++i) {
            const int32_t g = scene->tree.item[i];
            best = g < best && holds(scene, g, point) ? g : best;
        }
    }
    return best == INT32_MAX ? -1 : best;
}
