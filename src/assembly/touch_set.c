// Bodies, scene and pair lists of an assembly.
#include "assembly/touch_set.h"

#include "base/alloc.h"
#include "base/status.h"
#include "math/vec3.h"
#include "touch/gap.h"
#include "touch/tree.h"
#include <clast/shape.h>
#include <stdlib.h>

void clx_touch_set_free(clx_touch_set *set)
{
    for (int32_t s = 0; set->tree != NULL && s < set->n_shape; ++s) {
        clx_touch_tree_destroy(set->tree[s]);
    }
    clx_free(set->tree);
    clx_touch_scene_destroy(set->scene);
    *set = (clx_touch_set){0};
}

static clast_status make_tree(const clast_shape *shape, clx_touch_tree **tree)
{
    if (shape->kind == CLAST_SHAPE_MESH) {
        return clx_touch_tree_mesh(&shape->mesh, tree);
    }
    if (shape->kind == CLAST_SHAPE_CLUMP) {
        return clx_touch_tree_spheres(shape->spheres.n, shape->spheres.centre,
                                      shape->spheres.radius, tree);
    }
    return CLAST_OK;
}

clast_status clx_touch_set_init(const clast_assembly *assembly, clx_touch_set *set)
{
    clast_status status = CLAST_OK;
    clx_touch_set made = {.n_shape = assembly->n_shape};
    CLX_TRY(clx_alloc(&made.tree, assembly->n_shape, sizeof(clx_touch_tree *)));
    CLX_TRY(clx_touch_scene_create(&made.scene));
    for (int32_t s = 0; s < assembly->n_shape; ++s) {
        CLX_TRY(make_tree(&assembly->shape[s], &made.tree[s]));
    }
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        const clast_shape *shape = &assembly->shape[assembly->shape_id[i]];
        const clx_touch_tree *tree = made.tree[assembly->shape_id[i]];
        clx_touch_body body = tree != NULL ? clx_touch_body_tree(tree)
                              : shape->kind == CLAST_SHAPE_SPHERE
                                  ? clx_touch_body_sphere(shape->semi_axes[0])
                                  : clx_touch_body_ellipsoid(shape->semi_axes);
        clx_touch_body_place(&body, assembly->position[i], assembly->orientation[i],
                             assembly->scale[i]);
        CLX_TRY(clx_touch_scene_insert(made.scene, &body));
    }
    *set = made;
    made = (clx_touch_set){0};
done:
    clx_touch_set_free(&made);
    return status;
}

void clx_pairs_free(clx_pairs *pairs)
{
    CLX_FREE(pairs->pair, pairs->point);
    *pairs = (clx_pairs){0};
}

/// Where a visit puts its finds.
typedef struct collector {
    clx_pairs *pairs;
    int32_t grain;
} collector;

static bool append_touch(collector *c, int32_t other, const double point[3])
{
    clx_pairs *p = c->pairs;
    if (other <= c->grain) {
        return true;
    }
    p->status = clx_grow(&p->pair, &p->pair_capacity, (int64_t)p->n + 1, sizeof *p->pair);
    if (p->status == CLAST_OK) {
        p->status = clx_grow(&p->point, &p->point_capacity, (int64_t)p->n + 1, sizeof *p->point);
    }
    if (p->status == CLAST_OK) {
        p->pair[p->n][0] = c->grain;
        p->pair[p->n][1] = other;
        v3_copy(p->point[p->n++], point);
    }
    return p->status == CLAST_OK;
}

static bool keep_near(int32_t body, void *context)
{
    static const double nowhere[3] = {0.0, 0.0, 0.0};
    return append_touch(context, body, nowhere);
}

static bool keep_within(int32_t body, const clx_gap *gap, void *context)
{
    double middle[3];
    v3_add(middle, gap->point[0], gap->point[1]);
    v3_scale(middle, 0.5, middle);
    return append_touch(context, body, middle);
}

/// Insertion sort of one grain's few finds by the other grain.
static void sort_from(clx_pairs *p, int32_t first)
{
    CLAST_ASSERT(first >= 0 && first <= p->n);
    for (int32_t i = first + 1; i < p->n; ++i) {
        for (int32_t j = i; j > first && p->pair[j][1] < p->pair[j - 1][1]; --j) {
            double point[3];
            const int32_t other = p->pair[j][1];
            p->pair[j][1] = p->pair[j - 1][1];
            p->pair[j - 1][1] = other;
            v3_copy(point, p->point[j]);
            v3_copy(p->point[j], p->point[j - 1]);
            v3_copy(p->point[j - 1], point);
        }
    }
}

static clast_status collect(const clx_touch_set *set, bool by_gap, double gap, clx_pairs *pairs)
{
    clast_status status = CLAST_OK;
    clx_pairs made = {0};
    for (int32_t i = 0; i < clx_touch_scene_count(set->scene); ++i) {
        collector c = {&made, i};
        const int32_t first = made.n;
        const clx_touch_body *body = clx_touch_scene_body(set->scene, i);
        if (by_gap) {
            (void)clx_touch_scene_contacts(set->scene, body, gap, keep_within, &c);
        } else {
            (void)clx_touch_scene_near(set->scene, body, 0.0, keep_near, &c);
        }
        CLX_TRY(made.status);
        sort_from(&made, first);
    }
    *pairs = made;
    made = (clx_pairs){0};
done:
    clx_pairs_free(&made);
    return status;
}

clast_status clx_touch_set_near(const clx_touch_set *set, clx_pairs *pairs)
{
    return collect(set, false, 0.0, pairs);
}

clast_status clx_touch_set_within(const clx_touch_set *set, double gap, clx_pairs *pairs)
{
    CLAST_ASSERT(gap >= 0.0);
    return collect(set, true, gap, pairs);
}
