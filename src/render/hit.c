// What a ray through the scene meets: the kept side of the cut, points and normals of a hit.
#include "render/travel.h"

#include "math/vec3.h"
#include <clast/shape.h>

static void to_local(const clx_scene_grain *grain, const double v[3], double local[3])
{
    for (int k = 0; k < 3; ++k) {
        local[k] = v3_dot(grain->inverse[k], v);
    }
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

/// Sends the rays through the scene, each in its interval on the kept side of the cut.
static uint32_t send(clx_journey *j, const clx_scene *scene, int n, double t_low)
{
    CLAST_ASSERT(n <= CLX_BUNDLE);
    j->scene = scene;
    j->active = 0;
    j->found = 0;
    for (int r = 0; r < n; ++r) {
        bool is_entered = false;
        j->t_low[r] = t_low;
        j->t_high[r] = INFINITY;
        if (clx_scene_clip(scene, j->origin[r], j->direction[r], &j->t_low[r], &j->t_high[r],
                           &is_entered)) {
            j->active |= 1U << r;
        }
    }
    clx_travel(j);
    return j->found;
}

uint32_t clx_scene_blocked(const clx_scene *scene, int n, double (*origin)[3],
                           double (*direction)[3], double t_low)
{
    clx_journey j;
    j.origin = origin;
    j.direction = direction;
    j.best = NULL;
    return send(&j, scene, n, t_low);
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
static void describe(const clx_scene *scene, const double origin[3], const double direction[3],
                     clx_scene_hit *hit)
{
    const clx_scene_grain *grain = &scene->grain[hit->grain];
    double at[3];
    double world[3];
    v3_axpy(world, origin, hit->t, direction);
    v3_sub(world, world, grain->position);
    to_local(grain, world, at);
    local_surface(&scene->shape[grain->shape], hit, at, hit->face, hit->normal);
    turn_to_world(grain, at);
    turn_to_world(grain, hit->face);
    turn_to_world(grain, hit->normal);
    v3_axpy(hit->point, grain->position, grain->scale, at);
    hit->is_lifted = scene->shape[grain->shape].normal != NULL;
    if (v3_dot(hit->face, direction) > 0.0) {
        v3_scale(hit->face, -1.0, hit->face);
        v3_scale(hit->normal, -1.0, hit->normal);
        v3_axpy(hit->point, origin, hit->t, direction); // the lift is for fronts only
        hit->is_lifted = false;
    }
}

uint32_t clx_scene_hit_first(const clx_scene *scene, int n, double (*origin)[3],
                             double (*direction)[3], double t_low, clx_scene_hit *hit)
{
    clx_journey j;
    j.origin = origin;
    j.direction = direction;
    j.best = hit;
    const uint32_t found = send(&j, scene, n, t_low);
    for (uint32_t rays = found; rays != 0; rays &= rays - 1) {
        const int r = __builtin_ctz(rays);
        describe(scene, origin[r], direction[r], &hit[r]);
    }
    return found;
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
