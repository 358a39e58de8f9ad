// Bodies for tests and timings of first touch.
#include "touch_bodies.h"

#include "math/vec3.h"

static clast_status bumpy(int level, clx_rng *rng, clast_mesh *mesh)
{
    const double unit[3] = {0.5, 0.5, 0.5};
    double wave[6][3];
    const clast_status status = clast_mesh_ellipsoid(unit, level, mesh);
    for (int i = 0; i < 6; ++i) {
        clx_rng_direction(rng, wave[i]);
    }
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        double height = 1.0;
        for (int i = 0; i < 6; ++i) {
            height += 0.12 * sin(2.0 * (3 + i) * v3_dot(wave[i], mesh->vert[v]));
        }
        v3_scale(mesh->vert[v], height, mesh->vert[v]);
    }
    return status;
}

static clast_status stretched(int level, clx_rng *rng, clast_mesh *mesh)
{
    double axes[3];
    for (int k = 0; k < 3; ++k) {
        axes[k] = 0.2 + 0.6 * clx_rng_uniform(rng);
    }
    return clast_mesh_ellipsoid(axes, level, mesh);
}

static clast_status l_shape(clast_mesh *mesh)
{
    clast_mesh arm = {0};
    clast_status status = clast_mesh_box(1.0, 0.2, 0.2, mesh);
    if (status == CLAST_OK) {
        status = clast_mesh_box(0.2, 1.0, 0.2, &arm);
    }
    if (status == CLAST_OK) {
        status = clast_mesh_append(mesh, &arm);
    }
    clast_mesh_free(&arm);
    return status;
}

static clast_status shape_mesh(body_kind kind, int level, clx_rng *rng, clast_mesh *mesh)
{
    switch (kind) {
    case BODY_ELLIPSOID_MESH:
        return stretched(level, rng, mesh);
    case BODY_BUMPY_MESH:
        return bumpy(level, rng, mesh);
    case BODY_BOX:
        return clast_mesh_box(0.5 + clx_rng_uniform(rng), 0.5, 0.5 + clx_rng_uniform(rng), mesh);
    case BODY_PLATE:
        return clast_mesh_box(1.0, 1.0, 1e-3, mesh);
    default:
        return l_shape(mesh);
    }
}

static clx_touch_tree *make_spheres(clx_rng *rng)
{
    enum { N = 30 };
    double centre[N][3];
    double radius[N];
    clx_touch_tree *tree = NULL;
    for (int i = 0; i < N; ++i) {
        for (int k = 0; k < 3; ++k) {
            centre[i][k] = (1.0 - 0.2 * k) * (clx_rng_uniform(rng) - 0.5);
        }
        radius[i] = 0.05 + 0.15 * clx_rng_uniform(rng);
    }
    (void)clx_touch_tree_spheres(N, centre, radius, &tree);
    return tree;
}

clx_touch_tree *make_tree(body_kind kind, int level, clx_rng *rng)
{
    clx_touch_tree *tree = NULL;
    clast_mesh mesh = {0};
    if (kind == BODY_SPHERES) {
        return make_spheres(rng);
    }
    if (shape_mesh(kind, level, rng, &mesh) == CLAST_OK) {
        (void)clx_touch_tree_mesh(&mesh, &tree);
    }
    clast_mesh_free(&mesh);
    return tree;
}

void place_at_random(clx_touch_body *body, double spread, double scale, clx_rng *rng)
{
    double turn[4];
    double place[3];
    for (int k = 0; k < 3; ++k) {
        place[k] = spread * (2.0 * clx_rng_uniform(rng) - 1.0);
    }
    clx_rng_orientation(rng, turn);
    clx_touch_body_place(body, place, turn, scale);
}

int make_trees(clx_touch_tree *tree[N_BODY_KIND], uint64_t draw)
{
    clx_rng rng = clx_rng_at(7, CLX_STREAM_TEST, draw);
    for (int kind = 0; kind < N_BODY_KIND; ++kind) {
        tree[kind] = make_tree((body_kind)kind, 1, &rng);
        if (tree[kind] == NULL) {
            return -1;
        }
    }
    return 0;
}

void destroy_trees(clx_touch_tree *tree[N_BODY_KIND])
{
    for (int kind = 0; kind < N_BODY_KIND; ++kind) {
        clx_touch_tree_destroy(tree[kind]);
    }
}
