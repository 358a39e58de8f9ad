/* Unit: queries of the hierarchy where the answer is known, and against every triangle. */
#include "brute_mesh.h"
#include "geom/bvh.h"
#include "math/rng.h"
#include "math/vec3.h"
#include "support.h"
#include <string.h>

static void draw_point(clx_rng *rng, double reach, double point[3])
{
    for (int k = 0; k < 3; ++k) {
        point[k] = reach * (2.0 * clx_rng_uniform(rng) - 1.0);
    }
}

/* Soup of random triangles, some of them slivers. */
static void random_soup(uint64_t seed, int32_t n_tri, clast_mesh *mesh)
{
    clx_rng rng = clx_rng_at(seed, CLX_STREAM_TEST, 1);
    CHECK_OK(clast_mesh_alloc(3 * n_tri, n_tri, mesh));
    for (int32_t t = 0; t < n_tri; ++t) {
        double centre[3];
        draw_point(&rng, 1.0, centre);
        const double size = pow(10.0, -3.0 * clx_rng_uniform(&rng));
        const double squeeze = t % 4 == 0 ? 1e-9 : 1.0;
        for (int k = 0; k < 3; ++k) {
            double offset[3];
            draw_point(&rng, size, offset);
            offset[2] = offset[0] + squeeze * offset[2];
            offset[1] = offset[0] + squeeze * offset[1];
            v3_add(mesh->vert[3 * t + k], centre, offset);
            mesh->tri[t][k] = 3 * t + k;
        }
    }
}

static void closest_agrees_with_brute_force(void **state)
{
    (void)state;
    clast_mesh soup = {0};
    clast_bvh *bvh = NULL;
    random_soup(7, 400, &soup);
    CHECK_OK(clast_bvh_create(&soup, &bvh));
    clx_rng rng = clx_rng_at(8, CLX_STREAM_TEST, 0);
    for (int trial = 0; trial < 300; ++trial) {
        double point[3];
        double closest[3];
        int32_t tri = -1;
        draw_point(&rng, trial % 2 == 0 ? 1.2 : 20.0, point);
        const double expected = brute_closest(&soup, point);
        CHECK_REL(clast_bvh_closest(bvh, point, INFINITY, closest, &tri), expected, 1e-13);
        CHECK_REL(v3_distance(closest, point), expected, 1e-13);
        const clast_mesh one = {soup.n_vert, 1, soup.vert, soup.tri + tri};
        CHECK_ABS(brute_closest(&one, closest), 0.0, 1e-14);
        assert_true(clast_bvh_closest(bvh, point, 0.999 * expected, closest, &tri) ==
                    (double)INFINITY);
        CHECK_REL(clast_bvh_closest(bvh, point, 1.001 * expected, NULL, NULL), expected, 1e-13);
    }
    clast_bvh_destroy(bvh);
    clast_mesh_free(&soup);
}

static void rays_agree_with_brute_force(void **state)
{
    (void)state;
    clast_mesh soup = {0};
    clast_bvh *bvh = NULL;
    random_soup(9, 400, &soup);
    CHECK_OK(clast_bvh_create(&soup, &bvh));
    clx_rng rng = clx_rng_at(10, CLX_STREAM_TEST, 0);
    int n_hit = 0;
    for (int trial = 0; trial < 400; ++trial) {
        double origin[3];
        double direction[3];
        double margin = 0.0;
        clast_hit hit = {0};
        draw_point(&rng, trial % 2 == 0 ? 1.0 : 30.0, origin);
        draw_point(&rng, 1.0, direction);
        if (trial % 2 != 0) {
            v3_axpy(direction, direction, -1.0, origin);
        }
        const double expected = brute_ray(&soup, origin, direction, &margin);
        if (margin < 1e-9) {
            continue;
        }
        const bool found = clast_bvh_ray(bvh, origin, direction, 0.0, INFINITY, &hit);
        assert_int_equal(found, expected < (double)INFINITY);
        if (found) {
            ++n_hit;
            CHECK_ABS(hit.t, expected, 1e-12 * (1.0 + expected));
            double at[3] = {0.0, 0.0, 0.0};
            for (int k = 0; k < 3; ++k) {
                v3_axpy(at, at, hit.bary[k], soup.vert[soup.tri[hit.tri][k]]);
            }
            double expected_at[3];
            v3_axpy(expected_at, origin, hit.t, direction);
            CHECK_ABS(v3_distance(at, expected_at), 0.0, 1e-12);
            assert_false(clast_bvh_ray(bvh, origin, direction, 0.0, 0.999 * hit.t, &hit));
        }
    }
    assert_true(n_hit > 60);
    clast_bvh_destroy(bvh);
    clast_mesh_free(&soup);
}

/* Rays aimed at vertices and edge middles of a closed surface from outside: not one slips through,
   also when it runs along an axis or lies in the plane of facets. */
static void rays_at_edges_and_vertices_do_not_slip_through(void **state)
{
    (void)state;
    const double axes[3] = {1.0, 0.7, 0.4};
    clast_mesh mesh = {0};
    clast_bvh *bvh = NULL;
    clx_rng rng = clx_rng_at(11, CLX_STREAM_TEST, 0);
    CHECK_OK(clast_mesh_ellipsoid(axes, 3, &mesh));
    CHECK_OK(clast_bvh_create(&mesh, &bvh));
    for (int32_t t = 0; t < mesh.n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            const double *a = mesh.vert[mesh.tri[t][k]];
            const double *b = mesh.vert[mesh.tri[t][(k + 1) % 3]];
            const double s = k == 0 ? 0.0 : clx_rng_uniform(&rng);
            double target[3];
            double direction[3];
            clast_hit hit;
            v3_scale(target, 1.0 - s, a);
            v3_axpy(target, target, s, b);
            const double origin[3] = {0.05, 0.02, -0.03};
            v3_sub(direction, target, origin);
            assert_true(clast_bvh_ray(bvh, origin, direction, 0.0, INFINITY, &hit));
            CHECK_REL(hit.t, 1.0, 1e-12);
        }
    }
    clast_bvh_destroy(bvh);
    clast_mesh_free(&mesh);
}

/* A flat grid whose edges lie along the axes, so that the boxes of neighbours end on the very edge
   that they share; rays at its edges from far away, where rounding is largest. */
static void rays_at_box_borders_do_not_slip_through(void **state)
{
    (void)state;
    enum { SIDE = 9 };
    clast_mesh grid = {0};
    clast_bvh *bvh = NULL;
    clx_rng rng = clx_rng_at(14, CLX_STREAM_TEST, 0);
    CHECK_OK(clast_mesh_alloc(SIDE * SIDE, 2 * (SIDE - 1) * (SIDE - 1), &grid));
    for (int i = 0; i < SIDE * SIDE; ++i) {
        v3_set(grid.vert[i], i % SIDE / 3.0, i / SIDE / 3.0, 0.1);
    }
    for (int i = 0; i < (SIDE - 1) * (SIDE - 1); ++i) {
        const int32_t v = i % (SIDE - 1) + SIDE * (i / (SIDE - 1));
        const int32_t tri[2][3] = {{v, v + 1, v + SIDE}, {v + 1, v + SIDE + 1, v + SIDE}};
        memcpy(grid.tri[2 * i], tri, sizeof tri);
    }
    CHECK_OK(clast_bvh_create(&grid, &bvh));
    for (int trial = 0; trial < 20000; ++trial) {
        const double distance = pow(10.0, 8.0 * clx_rng_uniform(&rng));
        double target[3] = {(double)(1 + clx_rng_below(&rng, SIDE - 2)) / 3.0,
                            0.1 + 2.4 * clx_rng_uniform(&rng), 0.1};
        double origin[3];
        double direction[3];
        clast_hit hit;
        draw_point(&rng, 1.0, direction);
        v3_axpy(origin, target, -distance, direction);
        v3_sub(direction, target, origin);
        assert_true(clast_bvh_ray(bvh, origin, direction, 0.0, INFINITY, &hit));
        CHECK_REL(hit.t, 1.0, 1e-6);
    }
    clast_bvh_destroy(bvh);
    clast_mesh_free(&grid);
}

static void cube_hits_are_exact_along_axes(void **state)
{
    (void)state;
    clast_mesh box = {0};
    clast_bvh *bvh = NULL;
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &box));
    CHECK_OK(clast_bvh_create(&box, &bvh));
    for (int i = 0; i <= 8; ++i) {
        for (int j = 0; j <= 8; ++j) {
            for (int axis = 0; axis < 6; ++axis) {
                double origin[3];
                double direction[3] = {0.0, 0.0, 0.0};
                clast_hit hit;
                const bool back = axis > 2;
                origin[axis % 3] = back ? 3.0 : -2.0;
                origin[(axis + 1) % 3] = i / 8.0;
                origin[(axis + 2) % 3] = j / 8.0;
                direction[axis % 3] = back ? -1.0 : 1.0;
                assert_true(clast_bvh_ray(bvh, origin, direction, 0.0, 10.0, &hit));
                assert_true(hit.t == 2.0);
                assert_true(clast_bvh_ray(bvh, origin, direction, 2.5, 10.0, &hit));
                assert_true(hit.t == 3.0);
                assert_false(clast_bvh_ray(bvh, origin, direction, 3.5, 10.0, &hit));
            }
        }
    }
    const double zero[3] = {0.0, 0.0, 0.0};
    const double centre[3] = {0.5, 0.5, 0.5};
    clast_hit hit;
    assert_false(clast_bvh_ray(bvh, centre, zero, 0.0, INFINITY, &hit));
    clast_bvh_destroy(bvh);
    clast_mesh_free(&box);
}

/* A grid through and around a cube: faces, edges, vertices, face diagonals, and a hair beside
   them. */
static void inside_a_cube_is_exact(void **state)
{
    (void)state;
    const double grid[] = {-1.0, -1e-120,       0.0, 1e-120,        0.25,
                           0.5,  1.0 - 0x1p-53, 1.0, 1.0 + 0x1p-52, 2.0};
    clast_mesh box = {0};
    clast_bvh *bvh = NULL;
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &box));
    CHECK_OK(clast_bvh_create(&box, &bvh));
    assert_int_equal(bvh->rule, CLX_BVH_WINDING);
    for (int i = 0; i < 1000; ++i) {
        const double p[3] = {grid[i % 10], grid[i / 10 % 10], grid[i / 100]};
        bool expected = true;
        for (int k = 0; k < 3; ++k) {
            expected = expected && p[k] >= 0.0 && p[k] <= 1.0;
        }
        assert_int_equal(clast_bvh_inside(bvh, p), expected);
    }
    const double in[3] = {0.5, 0.25, 0.5};
    const double out[3] = {0.5, -2.0, 0.5};
    CHECK_REL(clast_bvh_signed_distance(bvh, in), -0.25, 1e-15);
    CHECK_REL(clast_bvh_signed_distance(bvh, out), 2.0, 1e-15);
    clast_bvh_destroy(bvh);
    clast_mesh_free(&box);
}

/* Points straight below vertices and edges of a tilted body, where a ray along z grazes. */
static void inside_agrees_with_solid_angle(void **state)
{
    (void)state;
    const double axes[3] = {1.0, 0.7, 0.4};
    const double turn[4] = {0.5, 0.5, -0.5, 0.5};
    const double origin[3] = {0.0, 0.0, 0.0};
    clast_mesh mesh = {0};
    clast_bvh *bvh = NULL;
    clx_rng rng = clx_rng_at(12, CLX_STREAM_TEST, 0);
    CHECK_OK(clast_mesh_ellipsoid(axes, 2, &mesh));
    clast_mesh_transform(&mesh, 1.0, turn, origin);
    CHECK_OK(clast_bvh_create(&mesh, &bvh));
    int n_inside = 0;
    for (int32_t t = 0; t < mesh.n_tri; ++t) {
        double point[3];
        const double *a = mesh.vert[mesh.tri[t][0]];
        const double *b = mesh.vert[mesh.tri[t][1]];
        const double s = t % 2 == 0 ? 0.0 : clx_rng_uniform(&rng);
        v3_scale(point, 1.0 - s, a);
        v3_axpy(point, point, s, b);
        point[2] = 1.1 * (2.0 * clx_rng_uniform(&rng) - 1.0);
        const double w = brute_winding(&mesh, point);
        assert_int_equal(clast_bvh_inside(bvh, point), w > 0.5);
        n_inside += w > 0.5;
    }
    assert_true(n_inside > 40);
    for (int32_t v = 0; v < mesh.n_vert; ++v) {
        assert_true(clast_bvh_inside(bvh, mesh.vert[v])); /* on the surface counts as inside */
    }
    clast_bvh_destroy(bvh);
    clast_mesh_free(&mesh);
}

static void append_box(clast_mesh *mesh, double edge, double shift, bool is_inward)
{
    const double identity[4] = {1.0, 0.0, 0.0, 0.0};
    const double by[3] = {shift, shift, shift};
    clast_mesh box = {0};
    CHECK_OK(clast_mesh_box(edge, edge, edge, &box));
    clast_mesh_transform(&box, 1.0, identity, by);
    for (int32_t t = 0; is_inward && t < box.n_tri; ++t) {
        const int32_t swap = box.tri[t][0];
        box.tri[t][0] = box.tri[t][1];
        box.tri[t][1] = swap;
    }
    CHECK_OK(clast_mesh_append(mesh, &box));
    clast_mesh_free(&box);
}

static bool inside_at(const clast_bvh *bvh, double x)
{
    const double p[3] = {x, x, x};
    return clast_bvh_inside(bvh, p);
}

/* Overlapping bodies are a union, a void is outside, and turned facets leave parity. */
static void inside_follows_its_three_rules(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_bvh *bvh = NULL;
    append_box(&mesh, 1.0, 0.0, false);
    append_box(&mesh, 1.0, 0.5, false);
    CHECK_OK(clast_bvh_create(&mesh, &bvh));
    assert_int_equal(bvh->rule, CLX_BVH_WINDING);
    assert_true(inside_at(bvh, 0.75));
    assert_true(inside_at(bvh, 1.25));
    assert_false(inside_at(bvh, 1.75));
    clast_bvh_destroy(bvh);
    clast_mesh_free(&mesh);

    append_box(&mesh, 4.0, 0.0, false);
    append_box(&mesh, 2.0, 1.0, true);
    CHECK_OK(clast_bvh_create(&mesh, &bvh));
    assert_true(inside_at(bvh, 0.5));
    assert_false(inside_at(bvh, 2.0));
    clast_bvh_destroy(bvh);

    const int32_t swap = mesh.tri[3][0];
    mesh.tri[3][0] = mesh.tri[3][1];
    mesh.tri[3][1] = swap;
    CHECK_OK(clast_bvh_create(&mesh, &bvh));
    assert_int_equal(bvh->rule, CLX_BVH_PARITY);
    assert_true(inside_at(bvh, 0.5));
    assert_false(inside_at(bvh, 2.0));
    clast_bvh_destroy(bvh);

    mesh.n_tri -= 1;
    CHECK_OK(clast_bvh_create(&mesh, &bvh));
    assert_int_equal(bvh->rule, CLX_BVH_SOLID_ANGLE);
    assert_true(inside_at(bvh, 0.5));
    assert_false(inside_at(bvh, -0.5));
    clast_bvh_destroy(bvh);
    clast_mesh_free(&mesh);
}

static void solid_angle_expansion_is_close(void **state)
{
    (void)state;
    const double axes[3] = {1.0, 0.7, 0.4};
    clast_mesh mesh = {0};
    clast_bvh *bvh = NULL;
    clx_rng rng = clx_rng_at(13, CLX_STREAM_TEST, 0);
    CHECK_OK(clast_mesh_ellipsoid(axes, 4, &mesh));
    mesh.n_tri -= 200; /* a hole */
    CHECK_OK(clast_bvh_create(&mesh, &bvh));
    assert_int_equal(bvh->rule, CLX_BVH_SOLID_ANGLE);
    double worst = 0.0;
    for (int trial = 0; trial < 200; ++trial) {
        double point[3];
        draw_point(&rng, 1.2, point);
        worst = fmax(worst, fabs(clx_bvh_solid_angle(bvh, point) - brute_winding(&mesh, point)));
    }

    assert_true(worst < 0.02 && worst > 0.0);
    clast_bvh_destroy(bvh);
    clast_mesh_free(&mesh);
}

/// Longest path from the root; every item is in one leaf.
static int depth_of(const clx_tree *tree)
{
    int depth[2 * 1000] = {0};
    int deepest = 0;
    int64_t n_item = 0;
    for (int32_t i = 0; i < tree->n_node; ++i) {
        const clx_tree_node *node = &tree->node[i];
        deepest = depth[i] > deepest ? depth[i] : deepest;
        if (node->right != 0) {
            depth[i + 1] = depth[i] + 1;
            depth[node->right] = depth[i] + 1;
        } else {
            assert_int_equal(node->first, n_item);
            n_item += node->count;
        }
    }
    assert_int_equal(n_item, tree->n_item);
    return deepest;
}

/* Boxes at 32^-k: every plane between bins parts off just one, so without the bound the tree would
   be a list 190 deep. */
static void depth_is_bounded_for_a_geometric_series(void **state)
{
    (void)state;
    enum { N = 190 };
    clx_tree_box box[N];
    clx_tree tree = {0};
    for (int32_t k = 0; k < N; ++k) {
        const double x = ldexp(1.0, -5 * k);
        box[k] = (clx_tree_box){{x, 0.0, 0.0}, {x, 1.0, 1.0}, k};
    }
    CHECK_OK(clx_tree_build(box, N, 4, &tree));
    assert_in_range(depth_of(&tree), 30, CLX_TREE_DEPTH);
    clx_tree_free(&tree);
}

/* Depth is bounded and queries work when all triangles are the same, or lie at 2^-k. */
static void degenerate_meshes_keep_the_depth(void **state)
{
    (void)state;
    for (int kind = 0; kind < 3; ++kind) {
        const int32_t n = 1000;
        clast_mesh mesh = {0};
        clast_bvh *bvh = NULL;
        CHECK_OK(clast_mesh_alloc(3 * n, n, &mesh));
        for (int32_t t = 0; t < n; ++t) {
            const double at = kind == 0 ? 0.0 : ldexp(1.0, -(t % 300));
            v3_set(mesh.vert[3 * t], at, kind == 2 ? at * at : 0.0, 0.0);
            v3_set(mesh.vert[3 * t + 1], at + (kind == 2 ? 0.0 : 1e-3 * at + 1e-3), 0.0, 0.0);
            v3_set(mesh.vert[3 * t + 2], at, 1e-3 * at, kind == 2 ? 0.0 : 1e-3);
            for (int k = 0; k < 3; ++k) {
                mesh.tri[t][k] = 3 * t + k;
            }
        }
        CHECK_OK(clast_bvh_create(&mesh, &bvh));
        assert_in_range(depth_of(&bvh->tree), 8, CLX_TREE_DEPTH);
        const double point[3] = {0.3, 0.4, 0.5};
        CHECK_REL(clast_bvh_closest(bvh, point, INFINITY, NULL, NULL), brute_closest(&mesh, point),
                  1e-13);
        clast_bvh_destroy(bvh);
        clast_mesh_free(&mesh);
    }
}

static void bad_meshes_are_refused(void **state)
{
    (void)state;
    clast_mesh box = {0};
    clast_mesh empty = {0};
    clast_bvh *bvh = NULL;
    CHECK_STATUS(clast_bvh_create(&empty, &bvh), CLAST_E_GEOMETRY);
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &box));
    box.tri[5][1] = 8;
    CHECK_STATUS(clast_bvh_create(&box, &bvh), CLAST_E_GEOMETRY);
    box.tri[5][1] = 5;
    box.vert[5][2] = NAN;
    CHECK_STATUS(clast_bvh_create(&box, &bvh), CLAST_E_GEOMETRY);
    assert_null(bvh);
    clast_bvh_destroy(NULL);
    clast_mesh_free(&box);
}

/* Before, points with a NaN that lay in the plane of a box's face by another coordinate were
 * inside: no comparison threw them out. */
static void points_beside_numbers_are_outside(void **state)
{
    (void)state;
    const double nan = (double)NAN;
    const double point[][3] = {{nan, 0.0, 0.0}, {0.0, nan, 0.0}, {0.0, 0.0, nan},
                               {nan, 2.0, 1.0}, {nan, 0.0, 0.5}, {nan, nan, nan}};
    clast_mesh box = {0};
    clast_bvh *bvh = NULL;
    CHECK_OK(clast_mesh_box(3.0, 2.0, 1.0, &box));
    CHECK_OK(clast_bvh_create(&box, &bvh));
    for (int k = 0; k < 6; ++k) {
        assert_false(clast_bvh_inside(bvh, point[k]));
        assert_true(isnan(clast_bvh_signed_distance(bvh, point[k])));
    }
    clast_bvh_destroy(bvh);
    clast_mesh_free(&box);
}

static void points_that_are_nowhere_are_outside(void **state)
{
    (void)state;
    const double bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY};
    for (int removed = 0; removed < 2; ++removed) { // closed, and open by two triangles
        clast_mesh ball = {0};
        clast_bvh *bvh = NULL;
        CHECK_OK(clast_mesh_ellipsoid((double[3]){1.0, 1.0, 1.0}, 3, &ball));
        ball.n_tri -= 2 * removed;
        CHECK_OK(clast_bvh_create(&ball, &bvh));
        for (int k = 0; k < 3 * 7; ++k) {
            double point[3] = {0.1, 0.2, 0.3};
            for (int j = 0; j < 3; ++j) {
                point[j] = ((k % 7 + 1) >> j & 1) != 0 ? bad[k / 7] : point[j];
            }
            assert_false(clast_bvh_inside(bvh, point));
            const double d = clast_bvh_signed_distance(bvh, point);
            assert_true(k / 7 == 0 ? isnan(d) : d == (double)INFINITY);
        }
        assert_true(clast_bvh_inside(bvh, (double[3]){0.1, 0.2, 0.3}));
        clast_bvh_destroy(bvh);
        clast_mesh_free(&ball);
    }
}

static clast_status make_bvh(void *context)
{
    clast_bvh *bvh = NULL;
    const clast_status status = clast_bvh_create(context, &bvh);
    if (status != CLAST_OK) {
        assert_null(bvh);
    }
    clast_bvh_destroy(bvh);
    return status;
}

static void create_survives_refused_memory(void **state)
{
    (void)state;
    clast_mesh soup = {0};
    random_soup(3, 20, &soup);
    support_refuse_each_allocation(make_bvh, &soup);
    clast_mesh_free(&soup);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closest_agrees_with_brute_force),
        cmocka_unit_test(rays_agree_with_brute_force),
        cmocka_unit_test(rays_at_edges_and_vertices_do_not_slip_through),
        cmocka_unit_test(rays_at_box_borders_do_not_slip_through),
        cmocka_unit_test(cube_hits_are_exact_along_axes),
        cmocka_unit_test(inside_a_cube_is_exact),
        cmocka_unit_test(inside_agrees_with_solid_angle),
        cmocka_unit_test(inside_follows_its_three_rules),
        cmocka_unit_test(solid_angle_expansion_is_close),
        cmocka_unit_test(depth_is_bounded_for_a_geometric_series),
        cmocka_unit_test(degenerate_meshes_keep_the_depth),
        cmocka_unit_test(bad_meshes_are_refused),
        cmocka_unit_test(points_beside_numbers_are_outside),
        cmocka_unit_test(points_that_are_nowhere_are_outside),
        cmocka_unit_test(create_survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
