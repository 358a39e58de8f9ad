/* Unit: how far apart two points of a domain are, by formulas, chords and pairs of points. */
#include "domains.h"
#include "support.h"

#include "cloud/covariogram.h"

#include <clast/cloud.h>
#include <clast/pairs.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Set covariance of boxes: P(|X - Y| < r) reaches 1 at the diagonal; known moments of the distance
 * (mean 1/3 on a line, 0.521405... in a square, 0.661707... in a cube [Robbins 1978]). */
static void boxes_have_their_distances(void **state)
{
    (void)state;
    static const char *const boxes[] = {"box:0,1", "box:0,0,1,1", "box:0,0,0,1,1,1"};
    static const double mean[] = {1.0 / 3.0, 0.52140543316472067, 0.66170718226717623};
    enum { M = 4000 };
    double *radius = malloc(M * sizeof *radius);
    double *share = malloc(M * sizeof *share);
    for (int d = 1; d <= 3; ++d) {
        const clast_domain domain = domain_of(boxes[d - 1]);
        double sum = 0.0;
        for (int i = 0; i < M; ++i) {
            radius[i] = sqrt(d) * (i + 1) / M;
        }
        CHECK_OK(clast_pairs_uniform(&domain, M, radius, share, NULL));
        for (int i = 0; i < M; ++i) { // mean distance: integral of 1 - share, trapezoids
            sum += (1.0 - (i > 0 ? share[i - 1] : 0.0) + 1.0 - share[i]) * 0.5 * sqrt(d) / M;
        }
        CHECK_ABS(share[M - 1], 1.0, 1e-11);
        CHECK_ABS(sum, mean[d - 1], 2e-7); // the trapezoids
    }
    free(radius);
    free(share);
}

/* A cylinder and a sphere: P = 1 at the greatest distance; mean distances 36/35 R of a ball; the
 * slope of the set covariance is - S / 4. */
static void round_domains_have_theirs(void **state)
{
    (void)state;
    const clast_domain sphere = domain_of("sphere:2");
    const clast_domain cylinder = domain_of("cylinder:0.5,3");
    double share[3];
    double error[3];
    const double far[2][3] = {{1.0, 2.0, 4.0}, {0.5, 2.0, hypot(1.0, 3.0)}};
    CHECK_OK(clast_pairs_uniform(&sphere, 3, far[0], share, error));
    CHECK_ABS(share[2], 1.0, 1e-12);
    CHECK_ABS(share[0], 1.0 / 8 - 9.0 / 16 / 16 + 1.0 / 32 / 64, 1e-12); // s^3 - 9/16 s^4 + s^6/32
    assert_true(error[2] == 0.0);
    CHECK_OK(clast_pairs_uniform(&cylinder, 3, far[1], share, NULL));
    CHECK_ABS(share[2], 1.0, 1e-10);
    const double v = clast_domain_volume(&cylinder);
    const double surface = 2.0 * CLAST_PI * 0.5 * 3.0 + 2.0 * CLAST_PI * 0.25;
    CHECK_REL((v - clx_covariogram(&cylinder, 1e-4)) / 1e-4, 0.25 * surface, 1e-3);
}

/* Chords of a meshed ball, and of a meshed box far from a cube, against the formulas of the solids;
 * and a hollow ball, where lines cross four times, against pairs of points. */
static void chords_of_a_mesh_agree_with_formulas(void **state)
{
    (void)state;
    const double radius[4] = {0.1, 0.5, 1.0, 2.0};
    double share[2][4];
    double error[4];
    clast_mesh box = {0};
    clast_domain mesh = {0};
    CHECK_OK(clast_mesh_box(1.0, 2.0, 0.5, &box));
    CHECK_OK(clast_domain_of_mesh(&box, 1.0, &mesh));
    const clast_domain solid = domain_of("box:0,0,0,1,2,0.5");
    CHECK_OK(clast_pairs_uniform(&mesh, 4, radius, share[0], error));
    CHECK_OK(clast_pairs_uniform(&solid, 4, radius, share[1], NULL));
    for (int k = 0; k < 4; ++k) {
        assert_true(error[k] < (radius[k] < 0.2 ? 1e-4 : 5e-3) * share[1][k]);
        CHECK_ABS(share[0][k], share[1][k], 4.0 * error[k] + 1e-9);
    }
    clast_mesh_free(&box);
    clast_domain_free(&mesh);
    mesh = ball_mesh(1.0, 5);
    const clast_domain ball = domain_of("sphere:1");
    CHECK_OK(clast_pairs_uniform(&mesh, 4, radius, share[0], error));
    CHECK_OK(clast_pairs_uniform(&ball, 4, radius, share[1], NULL));
    for (int k = 0; k < 4; ++k) { // 20,480 triangles: V is 0.1 % less
        CHECK_REL(share[0][k], share[1][k], 2e-3);
    }
    clast_domain_free(&mesh);
}

static bool square_map(const void *context, const double *x, double *u)
{
    (void)context;
    for (int j = 0; j < 2; ++j) {
        u[j] = x[j] / 2.0;
    }
    return u[0] >= 0.0 && u[0] <= 1.0 && u[1] >= 0.0 && u[1] <= 1.0;
}

static void square_unmap(const void *context, const double *u, double *x)
{
    (void)context;
    x[0] = 2.0 * u[0];
    x[1] = 2.0 * u[1];
}

static clast_domain square_by_map(void)
{
    const clast_domain_map_functions functions = {
        .dimension = 2, .volume = 4.0, .map = square_map, .unmap = square_unmap};
    clast_domain domain = {0};
    CHECK_OK(clast_domain_of_map(&functions, &domain));
    return domain;
}

/* Half pipes by chords and a map by points: within their stated error of the truth. A half pipe's P
 * is 1 at its diagonal. */
static void sampled_domains_keep_their_stated_error(void **state)
{
    (void)state;
    const clast_domain pipe = domain_of("half-pipe:0.5,3");
    const double radius[4] = {0.05, 0.2, 1.0, 3.2};
    double share[4];
    double exact[4];
    double error[4];
    CHECK_OK(clast_pairs_uniform(&pipe, 4, radius, share, error));
    CHECK_ABS(share[3], 1.0, 4.0 * error[3] + 1e-9);
    assert_true(error[3] < 0.03 && error[0] < 2e-5 * share[0]);
    const clast_domain map = square_by_map();
    const clast_domain box = domain_of("box:0,0,2,2");
    CHECK_OK(clast_pairs_uniform(&map, 4, radius, share, error));
    CHECK_OK(clast_pairs_uniform(&box, 4, radius, exact, NULL));
    for (int k = 0; k < 4; ++k) {
        assert_true(error[k] < 1e-2 * exact[k]);
        CHECK_ABS(share[k], exact[k], 4.0 * error[k] + 1e-9);
    }
}

/* Far pairs of slender bodies: a probability, which rises to 1 at the diameter and is 1 beyond, and
 * is within its stated error of the truth. Before, chords alone were asked: 1.068 of a half pipe
 * 20 times as long as wide, -30920.8 of one 10^4 times as long, 0.435 for 0.990 of a rod. */
static void far_pairs_of_slender_bodies_are_probabilities(void **state)
{
    (void)state;
    static const char *const name[] = {
        "half-pipe:0.05,1", "half-pipe:0.001,10", "half-pipe:0.5,3", "rod", "hollow", "map"};
    enum { M = 40 };
    double radius[M], share[M], error[M], truth[M];
    clast_mesh box = {0};
    clast_domain domain = {0};
    for (int k = 0; k < 6; ++k) {
        double diameter = 0.0;
        const bool is_rod = k == 3;
        if (k < 3) {
            domain = domain_of(name[k]);
            diameter = hypot(2.0 * domain.radius, domain.length);
        } else if (is_rod) {
            CHECK_OK(clast_mesh_box(100.0, 1.0, 1.0, &box));
            CHECK_OK(clast_domain_of_mesh(&box, 1.0, &domain));
            clast_mesh_free(&box);
            diameter = sqrt(10002.0);
        } else if (k == 4) {
            domain = ball_mesh(1.0, 3);
            diameter = 2.0;
        } else {
            domain = square_by_map();
            diameter = sqrt(8.0);
        }
        for (int i = 0; i < M; ++i) {
            radius[i] = diameter * pow(10.0, 4.0 * (i + 4 - M) / M);
        }
        radius[M - 4] = diameter * (1.0 + 1e-9);
        CHECK_OK(clast_pairs_uniform(&domain, M, radius, share, error));
        for (int i = 0; i < M; ++i) {
            assert_true(share[i] >= (i > 0 ? share[i - 1] : 0.0) && share[i] <= 1.0);
            assert_true(error[i] >= 0.0 && error[i] < 0.02);
            assert_true(i < M - 4 || k == 5 || (share[i] == 1.0 && error[i] == 0.0));
        }
        if (is_rod) {
            const clast_domain solid = domain_of("box:0,0,0,100,1,1");
            CHECK_OK(clast_pairs_uniform(&solid, M, radius, truth, NULL));
            for (int i = 0; i < M; ++i) {
                CHECK_ABS(share[i], truth[i], 4.0 * error[i] + 1e-9);
                assert_true(error[i] < 5e-3 * truth[i]);
            }
        }
        if (k == 1) { /* all but a line: 2 s - s^2, s = r / L */
            CHECK_ABS(share[M - 8], 2.0 * radius[M - 8] / 10.0 - pow(radius[M - 8] / 10.0, 2.0),
                      4.0 * error[M - 8] + 1e-4);
        }
        clast_domain_free(&domain);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes_have_their_distances),
        cmocka_unit_test(round_domains_have_theirs),
        cmocka_unit_test(chords_of_a_mesh_agree_with_formulas),
        cmocka_unit_test(sampled_domains_keep_their_stated_error),
        cmocka_unit_test(far_pairs_of_slender_bodies_are_probabilities),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
