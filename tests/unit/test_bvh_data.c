/* Unit: the hierarchy on scanned and broken surfaces. */
#include "brute_mesh.h"
#include "geom/bvh.h"
#include "math/rng.h"
#include "support.h"
#include <clast/mesh.h>

/// Points in the box of a mesh, the first at its vertices' height.
static void random_point(clx_rng *rng, const double low[3], const double high[3], double point[3])
{
    for (int k = 0; k < 3; ++k) {
        const double u = 1.1 * clx_rng_uniform(rng) - 0.05;
        point[k] = low[k] + u * (high[k] - low[k]);
    }
}

static void queries_agree(const char *name, int n_point, clx_bvh_rule rule, double slack)
{
    clast_mesh mesh = {0};
    clast_bvh *bvh = NULL;
    double low[3];
    double high[3];
    clx_rng rng = clx_rng_at(1, CLX_STREAM_TEST, 9);
    CHECK_OK(clast_mesh_read(support_data(name), &mesh, NULL));
    CHECK_OK(clast_bvh_create(&mesh, &bvh));
    assert_int_equal(bvh->rule, rule);
    clast_mesh_bounds(&mesh, low, high);
    int n_told = 0;
    for (int i = 0; i < n_point; ++i) {
        double point[3];
        random_point(&rng, low, high, point);
        if (i % 4 == 0) { /* straight below a vertex */
            const int64_t v = clx_rng_below(&rng, mesh.n_vert);
            point[0] = mesh.vert[v][0];
            point[1] = mesh.vert[v][1];
        }
        const double expected = brute_closest(&mesh, point);
        CHECK_ABS(clast_bvh_closest(bvh, point, INFINITY, NULL, NULL), expected,
                  1e-13 * (high[0] - low[0]));
        const double w = fabs(brute_winding(&mesh, point));
        if (fabs(w - 0.5) > slack && expected > 1e-9) {
            assert_int_equal(clast_bvh_inside(bvh, point), w > 0.5);
            ++n_told;
        }
    }
    assert_true(n_told > 8 * n_point / 10);
    clast_bvh_destroy(bvh);
    clast_mesh_free(&mesh);
}

/* One edge of the scan is open by a rounding of its file (4 open edges). */
static void scan_answers_as_brute_force(void **state)
{
    (void)state;
    queries_agree("scarlet/stl/particle.stl", 8, CLX_BVH_SOLID_ANGLE, 0.02);
}

static void sponge_answers_as_brute_force(void **state)
{
    (void)state;
    queries_agree("scarlet/stl/Menger2.stl", 60, CLX_BVH_SOLID_ANGLE, 0.02);
}

static void touching_balls_answer_as_brute_force(void **state)
{
    (void)state;
    queries_agree("scarlet/stl/L_shaped.stl", 20, CLX_BVH_WINDING, 1e-6);
}

static void coarse_ellipsoid_answers_as_brute_force(void **state)
{
    (void)state;
    queries_agree("scarlet/stl/27sk21_shape_fine.stl", 100, CLX_BVH_WINDING, 1e-6);
}

/* Volume by the share of random points that are inside, within four standard errors. */
static void inside_measures_the_volume(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_bvh *bvh = NULL;
    double low[3];
    double high[3];
    clx_rng rng = clx_rng_at(2, CLX_STREAM_TEST, 9);
    const int n = 20000;
    int n_inside = 0;
    CHECK_OK(clast_mesh_read(support_data("scarlet/stl/Menger2.stl"), &mesh, NULL));
    CHECK_OK(clast_bvh_create(&mesh, &bvh));
    clast_mesh_bounds(&mesh, low, high);
    for (int i = 0; i < n; ++i) {
        double point[3];
        for (int k = 0; k < 3; ++k) {
            point[k] = low[k] + clx_rng_uniform(&rng) * (high[k] - low[k]);
        }
        n_inside += clast_bvh_inside(bvh, point);
    }
    const double box = (high[0] - low[0]) * (high[1] - low[1]) * (high[2] - low[2]);
    const double share = 0.5487 / box; /* volume of the README */
    CHECK_ABS((double)n_inside / n, share, 4.0 * sqrt(share * (1.0 - share) / n));
    clast_bvh_destroy(bvh);
    clast_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scan_answers_as_brute_force),
        cmocka_unit_test(sponge_answers_as_brute_force),
        cmocka_unit_test(touching_balls_answer_as_brute_force),
        cmocka_unit_test(coarse_ellipsoid_answers_as_brute_force),
        cmocka_unit_test(inside_measures_the_volume),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
