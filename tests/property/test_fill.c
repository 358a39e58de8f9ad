/* Property: for any body and any strategy, spheres stay apart and inside, the largest-first search
 * finds what a dense grid finds, and nothing depends on threads, place or size. */
#include "brute_mesh.h"
#include "mesh_maker.h"
#include "ref_fill.h"
#include "support.h"

#include "math/rng.h"
#include <clast/fill.h>
#include <clast/machine.h>
#include <string.h>

static void fill(const clast_mesh *mesh, int32_t n, int32_t strategy, uint64_t seed,
                 clast_spheres *spheres, clast_fill_report *report)
{
    clast_fill_config config;
    CHECK_OK(clast_fields_default(clast_fill_fields, &config));
    config.spheres = n;
    config.strategy = strategy;
    config.seed = seed;
    config.candidates = 3;
    config.tolerance = 1e-3;
    CHECK_OK(clast_fill(mesh, &config, NULL, spheres, report));
    clast_fields_free(clast_fill_fields, &config);
}

/* An ellipsoid with a box beside it or into it, turned and moved: several shells, sharp edges. */
static void make_body(uint64_t seed, clast_mesh *mesh)
{
    clx_rng rng = clx_rng_at(seed, CLX_STREAM_TEST, 77);
    const double axes[3] = {0.3 + clx_rng_uniform(&rng), 0.3 + clx_rng_uniform(&rng),
                            0.3 + clx_rng_uniform(&rng)};
    CHECK_OK(clast_mesh_ellipsoid(axes, 2, mesh));
    mesh_add_box(mesh, 0.5 + 0.5 * clx_rng_uniform(&rng), clx_rng_uniform(&rng),
                 clx_rng_uniform(&rng), clx_rng_uniform(&rng) - 0.5);
    mesh_tilt(mesh);
}

static void spheres_stay_apart_and_inside(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 4; ++seed) {
        clast_mesh mesh = {0};
        make_body(seed, &mesh);
        for (int32_t strategy = CLAST_FILL_LARGEST; strategy <= CLAST_FILL_RANDOM; ++strategy) {
            clast_spheres s = {0};
            clast_fill_report r;
            fill(&mesh, 40, strategy, seed, &s, &r);
            assert_true(r.max_protrusion <= 1e-12);
            assert_true(r.max_overlap <= 1e-12);
            for (int32_t i = 0; i < s.n; ++i) { /* with the plain twin, not the report's tree */
                assert_true(brute_closest(&mesh, s.centre[i]) >= s.radius[i] * (1.0 - 1e-12));
                assert_true(brute_winding(&mesh, s.centre[i]) > 0.5);
                for (int32_t j = 0; j < i; ++j) {
                    double d2 = 0.0;
                    for (int k = 0; k < 3; ++k) {
                        const double d = s.centre[i][k] - s.centre[j][k];
                        d2 += d * d;
                    }
                    assert_true(sqrt(d2) >= (s.radius[i] + s.radius[j]) * (1.0 - 1e-12));
                }
            }
            clast_spheres_free(&s);
        }
        clast_mesh_free(&mesh);
    }
}

/* The published method keeps the spheres apart too; walls are its vertices only. */
static void published_spheres_touch_a_vertex_or_a_sphere(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_spheres s = {0};
    clast_fill_report r;
    make_body(3, &mesh);
    fill(&mesh, 40, CLAST_FILL_PUBLISHED, 5, &s, &r);
    assert_true(r.max_overlap <= 1e-12);
    for (int32_t i = 0; i < s.n; ++i) {
        double room = INFINITY;
        for (int32_t v = 0; v < mesh.n_vert; ++v) {
            double d2 = 0.0;
            for (int k = 0; k < 3; ++k) {
                const double d = s.centre[i][k] - mesh.vert[v][k];
                d2 += d * d;
            }
            room = fmin(room, sqrt(d2));
        }
        for (int32_t j = 0; j < i; ++j) {
            double d2 = 0.0;
            for (int k = 0; k < 3; ++k) {
                const double d = s.centre[i][k] - s.centre[j][k];
                d2 += d * d;
            }
            room = fmin(room, sqrt(d2) - s.radius[j]);
        }
        CHECK_REL(s.radius[i], room, 1e-12);
    }
    clast_spheres_free(&s);
    clast_mesh_free(&mesh);
}

static void largest_is_the_largest_of_a_dense_grid(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 2; ++seed) {
        clast_mesh mesh = {0};
        clast_spheres s = {0};
        make_body(seed, &mesh);
        fill(&mesh, 8, CLAST_FILL_LARGEST, 1, &s, NULL);
        for (int32_t i = 0; i < s.n; i += i == 0 ? 3 : 4) {
            double spacing = 0.0;
            const double grid = ref_fill_largest(&mesh, &s, i, 10, &spacing);
            assert_true(grid <= s.radius[i] * (1.0 + 1e-3));
            assert_true(s.radius[i] <= grid + sqrt(0.75) * spacing);
        }
        clast_spheres_free(&s);
        clast_mesh_free(&mesh);
    }
}

static void radii_fall_and_the_bound_holds(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_spheres s = {0};
    clast_fill_report few;
    clast_fill_report many;
    make_body(9, &mesh);
    fill(&mesh, 60, CLAST_FILL_LARGEST, 1, &s, &many);
    for (int32_t i = 1; i < s.n; ++i) {
        assert_true(s.radius[i] <= s.radius[i - 1] * (1.0 + 1e-3));
    }
    const double next = s.radius[30];
    clast_spheres_free(&s);
    fill(&mesh, 30, CLAST_FILL_LARGEST, 1, &s, &few);
    assert_true(next <= few.bound * (1.0 + 1e-12));
    assert_true(many.filled_fraction > few.filled_fraction);
    clast_spheres_free(&s);
    clast_mesh_free(&mesh);
}

static void threads_do_not_matter(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    make_body(4, &mesh);
    for (int32_t strategy = 0; strategy < 4; ++strategy) {
        clast_spheres first = {0};
        for (int32_t threads = 1; threads <= 4; threads *= 2) {
            clast_spheres s = {0};
            clast_fill_config config;
            CHECK_OK(clast_fields_default(clast_fill_fields, &config));
            config.spheres = 25;
            config.strategy = strategy < 3 ? strategy : CLAST_FILL_LARGEST;
            config.overlap = strategy == 3;
            clast_parallel_set_threads(threads);
            CHECK_OK(clast_fill(&mesh, &config, NULL, &s, NULL));
            clast_parallel_set_threads(0);
            clast_fields_free(clast_fill_fields, &config);
            if (threads == 1) {
                first = s;
                continue;
            }
            assert_int_equal(s.n, first.n);
            assert_memory_equal(s.centre, first.centre, (size_t)s.n * sizeof *s.centre);
            assert_memory_equal(s.radius, first.radius, (size_t)s.n * sizeof *s.radius);
            clast_spheres_free(&s);
        }
        clast_spheres_free(&first);
    }
    clast_mesh_free(&mesh);
}

/* Powers of two change no digit; a far origin costs only the digits that its coordinates lost. */
static void size_and_place_do_not_matter(void **state)
{
    (void)state;
    const double still[4] = {1.0, 0.0, 0.0, 0.0};
    const double home[3] = {0.0, 0.0, 0.0};
    const double away[3] = {1000.0, -2000.0, 500.0};
    clast_mesh mesh = {0};
    clast_mesh copy = {0};
    clast_spheres s = {0};
    clast_spheres t = {0};
    clast_fill_report here;
    clast_fill_report there;
    make_body(5, &mesh);
    fill(&mesh, 30, CLAST_FILL_LARGEST, 1, &s, &here);
    CHECK_OK(clast_mesh_copy(&mesh, &copy));
    clast_mesh_transform(&copy, 0x1p-40, still, home);
    fill(&copy, 30, CLAST_FILL_LARGEST, 1, &t, NULL);
    for (int32_t i = 0; i < 30; ++i) {
        CHECK_REL(t.radius[i] * 0x1p40, s.radius[i], 1e-13);
    }
    clast_spheres_free(&t);
    clast_mesh_free(&copy);
    CHECK_OK(clast_mesh_copy(&mesh, &copy));
    clast_mesh_transform(&copy, 1.0, still, away);
    fill(&copy, 30, CLAST_FILL_LARGEST, 1, &t, &there);
    CHECK_REL(t.radius[0], s.radius[0], 1e-3);
    CHECK_REL(there.filled_fraction, here.filled_fraction, 0.01);
    assert_true(there.max_protrusion <= 1e-9);
    clast_spheres_free(&t);
    clast_spheres_free(&s);
    clast_mesh_free(&copy);
    clast_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spheres_stay_apart_and_inside),
        cmocka_unit_test(published_spheres_touch_a_vertex_or_a_sphere),
        cmocka_unit_test(largest_is_the_largest_of_a_dense_grid),
        cmocka_unit_test(radii_fall_and_the_bound_holds),
        cmocka_unit_test(threads_do_not_matter),
        cmocka_unit_test(size_and_place_do_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
