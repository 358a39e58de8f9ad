/* Unit: which pairs of triangles meet where they should not. */
#include "brute_mesh.h"
#include "geom/bvh.h"
#include "math/rng.h"
#include "math/vec3.h"
#include "support.h"
#include <clast/machine.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const char *what;
    double a[3][3];
    double b[3][3];
    bool meet;
} pair_case;

static const pair_case cases[] = {
    {"apart", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, false},
    {"crossing", {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{1, 1, -1}, {1, 1, 1}, {3, 3, 1}}, true},
    {"planes cross, triangles do not",
     {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
     {{5, 5, -1}, {5, 5, 1}, {6, 6, 1}},
     false},
    {"corner on a face",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
     {{1, 1, 0}, {1, 1, 1}, {2, 1, 1}},
     true},
    {"corner a hair above a face",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
     {{1, 1, 1e-100}, {1, 1, 1}, {2, 1, 1}},
     false},
    {"corner on an edge",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
     {{2, 0, 0}, {2, -1, 1}, {2, -1, -1}},
     true},
    {"sharing a corner only",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
     {{0, 0, 0}, {-1, 0, 1}, {0, -1, 1}},
     false},
    {"sharing a corner, crossing beyond it",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
     {{0, 0, 0}, {1, 1, 1}, {1, 1, -1}},
     true},
    {"sharing a corner, in each other's plane and apart",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
     {{0, 0, 0}, {-4, 0, 0}, {0, -4, 0}},
     false},
    {"sharing a corner, overlapping in one plane",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
     {{0, 0, 0}, {4, 1, 0}, {1, 4, 0}},
     true},
    {"sharing a corner, an edge along a face",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
     {{0, 0, 0}, {1, 1, 0}, {1, 1, 1}},
     true},
    {"sharing a corner, edges on one line the same way",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
     {{0, 0, 0}, {2, 0, 0}, {0, -1, 1}},
     true},
    {"sharing an edge, folded open",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
     {{4, 0, 0}, {0, 0, 0}, {0, 4, 1e-100}},
     false},
    {"sharing an edge, side by side",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
     {{4, 0, 0}, {0, 0, 0}, {0, -4, 0}},
     false},
    {"sharing an edge, folded shut",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
     {{4, 0, 0}, {0, 0, 0}, {1, 7, 0}},
     true},
    {"the same corners",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
     {{4, 0, 0}, {0, 0, 0}, {0, 4, 0}},
     false},
    {"one inside the other, one plane",
     {{0, 0, 0}, {9, 0, 0}, {0, 9, 0}},
     {{1, 1, 0}, {2, 1, 0}, {1, 2, 0}},
     true},
    {"one plane, apart",
     {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
     {{1, 1, 0}, {2, 1, 0}, {1, 2, 0}},
     false},
    {"a segment through a face counts elsewhere",
     {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}},
     {{1, 1, -1}, {1, 1, 1}, {1, 1, 3}},
     false},
};

/* Every corner order, both orders of the pair, and two mirrorings of the axes. */
static void meeting_is_as_drawn(void **state)
{
    (void)state;
    static const int order[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1},
                                    {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; ++c) {
        for (int o = 0; o < 36 * 3; ++o) {
            double a[3][3];
            double b[3][3];
            for (int i = 0; i < 3; ++i) {
                for (int k = 0; k < 3; ++k) {
                    a[i][(k + o / 36) % 3] = cases[c].a[order[o % 6][i]][k];
                    b[i][(k + o / 36) % 3] = cases[c].b[order[o / 6 % 6][i]][k];
                }
            }
            if (clx_triangles_meet(a, b) != cases[c].meet ||
                clx_triangles_meet(b, a) != cases[c].meet) {
                fail_msg("%s, order %d: expected %d", cases[c].what, o, cases[c].meet);
            }
        }
    }
}

static void random_triangles(int32_t n, clast_mesh *mesh)
{
    clx_rng rng = clx_rng_at(5, CLX_STREAM_TEST, 3);
    CHECK_OK(clast_mesh_alloc(3 * n, n, mesh));
    for (int32_t v = 0; v < 3 * n; ++v) {
        for (int k = 0; k < 3; ++k) {
            const double centre = v % 3 == 0 ? 0.0 : mesh->vert[v - v % 3][k];
            mesh->vert[v][k] = centre + (v % 3 == 0 ? 1.0 : 0.2) * clx_rng_uniform(&rng);
        }
        mesh->tri[v / 3][v % 3] = v;
    }
}

static void count_agrees_with_brute_force(void **state)
{
    (void)state;
    clast_mesh soup = {0};
    clast_bvh *bvh = NULL;
    int64_t n = 0;
    int32_t few[10][2];
    random_triangles(700, &soup);
    CHECK_OK(clast_bvh_create(&soup, &bvh));
    const int64_t expected = brute_crossing_pairs(&soup);
    assert_true(expected > 300);
    CHECK_OK(clx_bvh_self_intersections(bvh, INT64_MAX, 0, NULL, &n));
    assert_int_equal(n, expected);
    CHECK_OK(clx_bvh_self_intersections(bvh, 1000, 0, NULL, &n));
    assert_int_equal(n, -1); /* its work used up */
    CHECK_OK(clx_bvh_self_intersections(bvh, INT64_MAX, 10, few, &n));
    assert_int_equal(n, expected);
    int32_t(*all)[2] = calloc((size_t)n + 1, sizeof *all);
    assert_non_null(all);
    CHECK_OK(clx_bvh_self_intersections(bvh, INT64_MAX, n + 1, all, &n));
    for (int64_t i = 0; i < n; ++i) {
        assert_true(all[i][0] < all[i][1]);
        assert_true(i == 0 || all[i - 1][0] < all[i][0] ||
                    (all[i - 1][0] == all[i][0] && all[i - 1][1] < all[i][1]));
    }
    assert_int_equal(all[n][0], 0);
    assert_int_equal(all[n][1], 0);
    for (int32_t threads = 2; threads <= 4; threads += 2) {
        int32_t again[10][2];
        clast_parallel_set_threads(threads);
        CHECK_OK(clx_bvh_self_intersections(bvh, INT64_MAX, 10, again, &n));
        assert_memory_equal(again, few, sizeof few);
    }
    clast_parallel_set_threads(0);
    free(all);
    clast_bvh_destroy(bvh);
    clast_mesh_free(&soup);
}

/* More pairs in one block of triangles than it has slots for: none is lost. */
static void crowded_blocks_lose_nothing(void **state)
{
    (void)state;
    enum { N = 40 };
    clast_mesh fan = {0};
    clast_bvh *bvh = NULL;
    int64_t n = 0;
    int32_t pair[N * (N - 1) / 2][2];
    CHECK_OK(clast_mesh_alloc(3 * N, N, &fan));
    for (int32_t t = 0; t < N; ++t) { /* all cross the z axis */
        const double x = cos(0.07 * t);
        const double y = sin(0.07 * t);
        v3_set(fan.vert[3 * t], x, y, 1.0);
        v3_set(fan.vert[3 * t + 1], -x, -y, 2.0);
        v3_set(fan.vert[3 * t + 2], x, y, 3.0);
        for (int k = 0; k < 3; ++k) {
            fan.tri[t][k] = 3 * t + k;
        }
    }
    CHECK_OK(clast_bvh_create(&fan, &bvh));
    CHECK_OK(clx_bvh_self_intersections(bvh, INT64_MAX, N * (N - 1) / 2, pair, &n));
    assert_int_equal(n, N * (N - 1) / 2);
    for (int32_t i = 0, at = 0; i < N; ++i) {
        for (int32_t j = i + 1; j < N; ++j, ++at) {
            assert_int_equal(pair[at][0], i);
            assert_int_equal(pair[at][1], j);
        }
    }
    clast_bvh_destroy(bvh);
    clast_mesh_free(&fan);
}

static void sound_surfaces_have_none(void **state)
{
    (void)state;
    const double axes[3] = {3.0, 2.0, 1.0};
    const double turn[4] = {0.5, 0.1, 0.7, 0.5};
    const double shift[3] = {10.1, -0.3, 2.0};
    clast_mesh mesh = {0};
    clast_bvh *bvh = NULL;
    int64_t n = -1;
    CHECK_OK(clast_mesh_ellipsoid(axes, 3, &mesh));
    clast_mesh_transform(&mesh, 1.0, turn, shift);
    CHECK_OK(clast_bvh_create(&mesh, &bvh));
    CHECK_OK(clx_bvh_self_intersections(bvh, INT64_MAX, 0, NULL, &n));
    assert_int_equal(n, 0);
    clast_bvh_destroy(bvh);
    clast_mesh_free(&mesh);
}

static clast_status find_pairs(void *context)
{
    int64_t n = 0;
    return clx_bvh_self_intersections(context, INT64_MAX, 0, NULL, &n);
}

static void search_survives_refused_memory(void **state)
{
    (void)state;
    clast_mesh box = {0};
    clast_bvh *bvh = NULL;
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &box));
    CHECK_OK(clast_bvh_create(&box, &bvh));
    support_refuse_each_allocation(find_pairs, bvh);
    clast_bvh_destroy(bvh);
    clast_mesh_free(&box);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(meeting_is_as_drawn),
        cmocka_unit_test(count_agrees_with_brute_force),
        cmocka_unit_test(crowded_blocks_lose_nothing),
        cmocka_unit_test(sound_surfaces_have_none),
        cmocka_unit_test(search_survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
