/* Property: aggregates grown by first touch have every body touching and none overlapping, told by
 * points sampled on each surface and tested against the others' insides. */
#include "support.h"

#include "math/vec3.h"
#include "touch/gap.h"
#include "touch_bodies.h"
#include <clast/mesh.h>

enum { N_PLACED = 200, N_SHAPE = 4 };

/// The shapes as the test sees them: a surface with its inside test, or nothing for round bodies.
typedef struct {
    clx_touch_body body;
    clast_mesh mesh;
    clast_bvh *bvh;
    clx_touch_tree *tree;
} shape;

static void make_shape(int kind, shape *s)
{
    const double axes[3] = {0.5, 0.35, 0.15};
    if (kind == 0) {
        s->body = clx_touch_body_ellipsoid(axes);
        return;
    }
    if (kind == 1) {
        CHECK_OK(clast_mesh_box(1.0, 0.3, 0.05, &s->mesh));
    } else {
        CHECK_OK(clast_mesh_ellipsoid(axes, kind, &s->mesh));
        for (int32_t i = 0; i < s->mesh.n_vert && kind == 3; ++i) { // hills
            double *v = s->mesh.vert[i];
            v3_scale(v, 1.0 + 0.25 * sin(9.0 * v[0]) * cos(11.0 * v[1]), v);
        }
    }
    CHECK_OK(clx_touch_tree_mesh(&s->mesh, &s->tree));
    CHECK_OK(clast_bvh_create(&s->mesh, &s->bvh));
    s->body = clx_touch_body_tree(s->tree);
}

/// Depth of a world point inside a placed body; 0 outside.
static double depth_in(const clx_touch_body *body, const shape *s, const double world[3])
{
    double d[3];
    double own[3];
    v3_sub(d, world, body->position);
    if (v3_norm(d) > body->radius) {
        return 0.0;
    }
    for (int k = 0; k < 3; ++k) {
        own[k] = (body->rotation[k] * d[0] + body->rotation[3 + k] * d[1] +
                  body->rotation[6 + k] * d[2]) /
                 body->scale;
    }
    if (s->bvh == NULL) {
        double form = 0.0;
        for (int k = 0; k < 3; ++k) {
            form += own[k] * own[k] / (body->semi_axes[k] * body->semi_axes[k]);
        }
        return form < 1.0 ? body->scale * (1.0 - sqrt(form)) * body->semi_axes[2] : 0.0;
    }
    double closest[3];
    int32_t tri = 0;
    return clast_bvh_inside(s->bvh, own)
               ? body->scale * clast_bvh_closest(s->bvh, own, INFINITY, closest, &tri)
               : 0.0;
}

/// A random point of the body's surface; corners and edges of a mesh are drawn often.
static void sample(const clx_touch_body *body, const shape *s, clx_rng *rng, double world[3])
{
    double own[3];
    if (s->bvh == NULL) {
        clx_rng_direction(rng, own);
        for (int k = 0; k < 3; ++k) {
            own[k] *= body->semi_axes[k];
        }
    } else {
        const int32_t *t = s->mesh.tri[clx_rng_below(rng, s->mesh.n_tri)];
        double a = clx_rng_uniform(rng);
        double b = clx_rng_uniform(rng) * (1.0 - a);
        const int64_t where = clx_rng_below(rng, 3);
        a = where == 0 ? 0.0 : a; // 0: corner, 1: edge, 2: face
        b = where < 2 ? 0.0 : b;
        v3_scale(own, 1.0 - a - b, s->mesh.vert[t[0]]);
        v3_axpy(own, own, a, s->mesh.vert[t[1]]);
        v3_axpy(own, own, b, s->mesh.vert[t[2]]);
    }
    for (int i = 0; i < 3; ++i) {
        world[i] = body->position[i] + body->scale * v3_dot(body->rotation + 3 * i, own);
    }
}

static void throw_body(clx_touch_scene *scene, clx_touch_body *body, clx_rng *rng)
{
    double u[3];
    double turn[4];
    clx_touch touch;
    clx_rng_direction(rng, u);
    clx_rng_orientation(rng, turn);
    const clx_touch_path path = clx_touch_path_along(u);
    const double start[3] = {0.0, 0.0, 0.0};
    clx_touch_body_place(body, start, turn, 0.5 + clx_rng_uniform(rng));
    assert_true(clx_touch_scene_first(scene, body, &path, &touch));
    assert_false(touch.overlap);
    v3_axpy(body->position, start, touch.t, u);
    clx_gap gap;
    const clx_touch_body *other = clx_touch_scene_body(scene, touch.body);
    assert_true(clx_touch_gap(body, other, 1e-12, &gap));
    assert_false(clx_touch_overlap(body, other, 1e-12, u));
}

static void grown_aggregates_have_no_overlap(void **state)
{
    (void)state;
    shape shapes[N_SHAPE] = {0};
    int kinds[N_PLACED + 1] = {0};
    clx_touch_scene *scene = NULL;
    clx_rng rng = clx_rng_at(16, CLX_STREAM_TEST, 0);
    for (int k = 0; k < N_SHAPE; ++k) {
        make_shape(k, &shapes[k]);
    }
    CHECK_OK(clx_touch_scene_create(&scene));
    CHECK_OK(clx_touch_scene_insert(scene, &shapes[0].body));
    for (int i = 1; i <= N_PLACED; ++i) {
        kinds[i] = i % N_SHAPE;
        clx_touch_body body = shapes[kinds[i]].body;
        throw_body(scene, &body, &rng);
        CHECK_OK(clx_touch_scene_insert(scene, &body));
    }
    double deepest = 0.0;
    for (int i = 0; i <= N_PLACED; ++i) {
        const clx_touch_body *body = clx_touch_scene_body(scene, i);
        for (int k = 0; k < 30; ++k) {
            double point[3];
            sample(body, &shapes[kinds[i]], &rng, point);
            for (int j = 0; j <= N_PLACED; ++j) {
                if (j != i) {
                    deepest = fmax(deepest, depth_in(clx_touch_scene_body(scene, j),
                                                     &shapes[kinds[j]], point));
                }
            }
        }
    }
    CHECK_ABS(deepest, 0.0, 1e-12);
    for (int k = 0; k < N_SHAPE; ++k) {
        clast_bvh_destroy(shapes[k].bvh);
        clx_touch_tree_destroy(shapes[k].tree);
        clast_mesh_free(&shapes[k].mesh);
    }
    clx_touch_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(grown_aggregates_have_no_overlap)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
