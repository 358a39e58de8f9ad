// Builds a scene: shapes with their trees, grains with their frames and boxes.
#include "render/scene.h"

#include "base/alloc.h"
#include "base/lines.h"
#include "base/parallel.h"
#include "math/vec3.h"
#include <clast/assembly.h>
#include <clast/shape.h>

enum { BLOCK = 1024 };

static clast_status build_clump(const clast_spheres *spheres, clx_scene_shape *shape)
{
    clast_status status = CLAST_OK;
    clx_tree_box *box = NULL;
    CLX_CHECK(spheres->n > 0, CLAST_E_GEOMETRY, "a clump without spheres cannot be drawn");
    CLX_TRY(clx_alloc(&box, spheres->n, sizeof *box));
    for (int32_t i = 0; i < spheres->n; ++i) {
        for (int k = 0; k < 3; ++k) {
            box[i].low[k] = spheres->centre[i][k] - spheres->radius[i];
            box[i].high[k] = spheres->centre[i][k] + spheres->radius[i];
        }
        box[i].item = i;
    }
    CLX_TRY(clx_tree_build(box, spheres->n, 2, &shape->tree));
    CLX_TRY(clx_wide_build(&shape->tree, 2, &shape->wide));
    shape->spheres = spheres;
done:
    clx_free(box);
    return status;
}

static void fill_blocks(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const clx_scene_shape *shape = context;
    (void)worker;
    for (int64_t b = begin; b < end; ++b) {
        const clx_wide_leaf leaf = shape->wide.leaf[b];
        CLAST_ASSERT(leaf.count <= CLX_WIDE_LANES);
        shape->block[b] = (clx_scene_block){0};
        for (int32_t i = 0; i < leaf.count; ++i) {
            for (int c = 0; c < 3; ++c) {
                for (int k = 0; k < 3; ++k) {
                    shape->block[b].corner[c][k][i] =
                        (float)(shape->block_unit * shape->bvh->corner[leaf.first + i][c][k]);
                }
            }
        }
    }
}

static clast_status build_mesh(const clast_mesh *mesh, clast_render_shading shading,
                               clx_scene_shape *shape)
{
    clast_status status = CLAST_OK;
    int64_t capacity = 0;
    CLX_TRY(clast_bvh_create(mesh, &shape->bvh));
    CLX_TRY(clx_wide_build(&shape->bvh->tree, CLX_WIDE_LANES, &shape->wide));
    CLX_TRY(clx_grow_lines(&shape->block, &capacity, shape->wide.n_leaf, sizeof *shape->block));
    shape->block_unit = shape->wide.max_abs > 0.0 ? ldexp(1.0, -ilogb(shape->wide.max_abs)) : 1.0;
    clx_parallel_for(shape->wide.n_leaf, BLOCK, fill_blocks, shape);
    if (shading == CLAST_RENDER_SMOOTH) {
        CLX_TRY(clx_corner_normals(shape->bvh, &shape->normal));
    }
done:
    return status;
}

static clast_status build_shape(const clast_shape *from, clast_render_shading shading,
                                clx_scene_shape *shape)
{
    clast_status status = CLAST_OK;
    shape->kind = from->kind;
    v3_copy(shape->semi_axes, from->semi_axes);
    if (from->kind == CLAST_SHAPE_SPHERE) {
        v3_set(shape->semi_axes, from->semi_axes[0], from->semi_axes[0], from->semi_axes[0]);
    }
    if (from->kind == CLAST_SHAPE_MESH) {
        CLX_TRY(build_mesh(&from->mesh, shading, shape));
    } else if (from->kind == CLAST_SHAPE_CLUMP) {
        CLX_TRY(build_clump(&from->spheres, shape));
    } else {
        CLX_CHECK(shape->semi_axes[0] > 0.0 && shape->semi_axes[1] > 0.0 &&
                      shape->semi_axes[2] > 0.0,
                  CLAST_E_GEOMETRY, "it has a semi-axis that is not positive");
        for (int k = 0; k < 3; ++k) {
            shape->per_axis[k] = 1.0 / shape->semi_axes[k];
        }
    }
done:
    if (status != CLAST_OK) {
        clx_fail_prefix("shape %s", from->name != NULL ? from->name : "without name");
    }
    return status;
}

/// Greatest x . direction over a tree of triangles or spheres: boxes that cannot beat the best are
/// left out.
static double tree_support(const clx_scene_shape *shape, const clx_tree *tree,
                           const double direction[3])
{
    int32_t stack[CLX_TREE_DEPTH + 1];
    int n_stack = 1;
    double best = -INFINITY;
    stack[0] = 0;
    while (n_stack > 0) {
        const int32_t at = stack[--n_stack];
        const clx_tree_node *node = &tree->node[at];
        double bound = 0.0;
        for (int k = 0; k < 3; ++k) {
            bound += direction[k] * (direction[k] > 0.0 ? node->high[k] : node->low[k]);
        }
        if (bound <= best) {
            continue;
        }
        if (node->right != 0) {
            stack[n_stack++] = node->right;
            stack[n_stack++] = at + 1;
            continue;
        }
        for (int32_t i = node->first; i < node->first + node->count; ++i) {
            if (shape->kind == CLAST_SHAPE_CLUMP) {
                const int32_t s = tree->item[i];
                best = fmax(best, v3_dot(shape->spheres->centre[s], direction) +
                                      shape->spheres->radius[s] * v3_norm(direction));
            } else {
                for (int c = 0; c < 3; ++c) {
                    best = fmax(best, v3_dot(shape->bvh->corner[i][c], direction));
                }
            }
        }
    }
    return best;
}

static double shape_support(const clx_scene_shape *shape, const double direction[3])
{
    if (shape->kind == CLAST_SHAPE_MESH) {
        return tree_support(shape, &shape->bvh->tree, direction);
    }
    if (shape->kind == CLAST_SHAPE_CLUMP) {
        return tree_support(shape, &shape->tree, direction);
    }
    const double scaled[3] = {shape->semi_axes[0] * direction[0],
                              shape->semi_axes[1] * direction[1],
                              shape->semi_axes[2] * direction[2]};
    return v3_norm(scaled);
}

static double grain_support(const clx_scene *scene, const clx_scene_grain *grain,
                            const double direction[3])
{
    double local[3];
    double m[3][3];
    for (int i = 0; i < 3; ++i) {
        v3_copy(m[i], grain->rotation[i]);
    }
    m3_to_local(local, m, direction);
    return v3_dot(grain->position, direction) +
           grain->scale * shape_support(&scene->shape[grain->shape], local);
}

double clx_scene_support(const clx_scene *scene, const double direction[3])
{
    CLAST_ASSERT(v3_is_finite(direction));
    double best = -INFINITY;
    for (int32_t g = 0; g < scene->n_grain; ++g) {
        best = fmax(best, grain_support(scene, &scene->grain[g], direction));
    }
    return best;
}

static clast_status place_grain(const clast_assembly *assembly, int32_t g, clx_scene *scene,
                                clx_tree_box *box)
{
    CLAST_ASSERT(g >= 0 && g < assembly->n_grain);
    clast_status status = CLAST_OK;
    clx_scene_grain *grain = &scene->grain[g];
    grain->shape = assembly->shape_id[g];
    grain->scale = assembly->scale[g];
    v3_copy(grain->position, assembly->position[g]);
    q_matrix(grain->rotation, assembly->orientation[g]);
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            grain->inverse[k][i] = grain->rotation[i][k] / grain->scale;
        }
    }
    for (int k = 0; k < 3; ++k) {
        double direction[3] = {0.0, 0.0, 0.0};
        direction[k] = 1.0;
        box->high[k] = grain_support(scene, grain, direction);
        direction[k] = -1.0;
        box->low[k] = -grain_support(scene, grain, direction);
        const double pad = 0x1p-48 * fmax(fabs(box->low[k]), fabs(box->high[k]));
        box->low[k] -= pad;
        box->high[k] += pad;
        CLX_CHECK(box->high[k] - box->low[k] < 1e30 && grain->scale > 0.0, CLAST_E_GEOMETRY,
                  "grain %d of %d has no finite size and position", g, assembly->n_grain);
    }
    box->item = g;
done:
    return status;
}

static clast_status place_grains(const clast_assembly *assembly, clx_scene *scene,
                                 clx_tree_box *box)
{
    clast_status status = CLAST_OK;
    for (int32_t g = 0; g < assembly->n_grain; ++g) {
        CLX_CHECK(assembly->shape_id[g] >= 0 && assembly->shape_id[g] < assembly->n_shape,
                  CLAST_E_GEOMETRY, "grain %d has shape %d of %d", g, assembly->shape_id[g],
                  assembly->n_shape);
        CLX_TRY(place_grain(assembly, g, scene, &box[g]));
    }
done:
    return status;
}

static clast_status build_grains(const clast_assembly *assembly, clx_scene *scene)
{
    clast_status status = CLAST_OK;
    clx_tree_box *box = NULL;
    CLX_TRY(clx_alloc(&scene->grain, assembly->n_grain, sizeof *scene->grain));
    scene->n_grain = assembly->n_grain;
    CLX_TRY(clx_alloc(&box, assembly->n_grain, sizeof *box));
    CLX_TRY(place_grains(assembly, scene, box));
    CLX_TRY(clx_tree_build(box, assembly->n_grain, 1, &scene->tree));
    CLX_TRY(clx_wide_build(&scene->tree, 1, &scene->wide));
    v3_copy(scene->low, scene->tree.node[0].low);
    v3_copy(scene->high, scene->tree.node[0].high);
    scene->radius = 0.5 * v3_distance(scene->low, scene->high);
    CLX_CHECK(scene->radius > 0.0, CLAST_E_GEOMETRY, "everything is in one point");
    v3_add(scene->centre, scene->low, scene->high);
    v3_scale(scene->centre, 0.5, scene->centre);
done:
    clx_free(box);
    return status;
}

/// The lanes of each set of marks, one behind the other in the bytes from the lowest on.
static void order_lanes(uint64_t order[1 << CLX_WIDE_LANES])
{
    for (uint32_t marks = 0; marks < 1U << CLX_WIDE_LANES; ++marks) {
        int n = 0;
        order[marks] = 0;
        for (uint32_t lane = 0; lane < CLX_WIDE_LANES; ++lane) {
            if ((marks >> lane & 1) != 0) {
                order[marks] |= (uint64_t)lane << 8 * n++;
            }
        }
    }
}

clast_status clx_scene_build(const clast_assembly *assembly, clast_render_shading shading,
                             clx_scene *scene)
{
    clast_status status = CLAST_OK;
    clx_scene made = {0};
    CLX_CHECK(assembly->n_grain > 0, CLAST_E_GEOMETRY, "there are no grains to draw");
    CLX_TRY(clx_alloc(&made.shape, assembly->n_shape, sizeof *made.shape));
    made.n_shape = assembly->n_shape;
    for (int32_t s = 0; s < assembly->n_shape; ++s) {
        CLX_TRY(build_shape(&assembly->shape[s], shading, &made.shape[s]));
    }
    CLX_TRY(build_grains(assembly, &made));
    order_lanes(made.lane_order);
    *scene = made;
    made = (clx_scene){0};
done:
    clx_scene_free(&made);
    return status;
}

void clx_scene_free(clx_scene *scene)
{
    for (int32_t s = 0; s < scene->n_shape; ++s) {
        clast_bvh_destroy(scene->shape[s].bvh);
        clx_free(scene->shape[s].normal);
        clx_tree_free(&scene->shape[s].tree);
        clx_wide_free(&scene->shape[s].wide);
        clx_free(scene->shape[s].block);
    }
    CLX_FREE(scene->shape, scene->grain);
    clx_tree_free(&scene->tree);
    clx_wide_free(&scene->wide);
    *scene = (clx_scene){0};
}
