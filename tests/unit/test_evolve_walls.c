/* Unit: bodies at curved walls, half pipes and closed surfaces: where straight paths meet them,
 * what mirrors keep, what walls that keep take. */
#include "evolving.h"
#include "support.h"

#include "evolve/walls.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#define STILL                                                                                      \
    "curve=1um", "kernel=constant", "alpha=0", "gravity=0", "brownian=no", "even=whole", "rows=1"

/* The cube [0, 1 cm]^3 as a closed surface. */
static const char *cube(void)
{
    static char option[4096];
    static const int face[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6},
                                    {0, 1, 5}, {0, 5, 4}, {2, 6, 7}, {2, 7, 3},
                                    {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    const char *path = support_scratch_file("cube.off");
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    (void)fprintf(file, "OFF\n8 12 0\n");
    for (int i = 0; i < 8; ++i) {
        (void)fprintf(file, "%g %g %g\n", 0.01 * (i & 1), 0.01 * (i >> 1 & 1), 0.01 * (i >> 2));
    }
    for (int i = 0; i < 12; ++i) {
        (void)fprintf(file, "3 %d %d %d\n", face[i][0], face[i][1], face[i][2]);
    }
    (void)fclose(file);
    (void)snprintf(option, sizeof option, "domain=mesh:%s", path);
    return option;
}

/* Points all at one place. */
static const char *points_at(int n, double x, double y, double z)
{
    static char option[4096];
    const char *path = support_scratch_file("points.csv");
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    (void)fprintf(file, "x,y,z\n");
    for (int i = 0; i < n; ++i) {
        (void)fprintf(file, "%.17g,%.17g,%.17g\n", x, y, z);
    }
    (void)fclose(file);
    (void)snprintf(option, sizeof option, "points=%s", path);
    return option;
}

static void check_exit(const char *text, const double from[3], const double to[3], double share,
                       const double inward[3])
{
    clast_domain domain = {0};
    clx_exit wall;
    double u[3];
    CHECK_OK(clast_domain_read(text, NULL, &domain));
    assert_true(clast_domain_map(&domain, from, u));
    assert_int_equal(clx_walls_exit(&domain, from, to, &wall), share < 1.0);
    if (share < 1.0) {
        CHECK_ABS(wall.share, share, 1e-12);
        assert_true(clast_domain_map(&domain, wall.at, u));
        for (int k = 0; k < 3; ++k) {
            CHECK_ABS(wall.inward[k], inward[k], 1e-12);
            CHECK_ABS(wall.at[k], from[k] + share * (to[k] - from[k]), 1e-7);
        }
    }
    clast_domain_free(&domain);
}

/* Closed forms; a path out and in again between its ends has left. */
static void a_path_leaves_where_it_crosses(void **state)
{
    (void)state;
    const double s = sqrt(0.5);
    check_exit("sphere:2", (double[]){0, 0, 0}, (double[]){0, 4, 0}, 0.5, (double[]){0, -1, 0});
    check_exit("sphere:2", (double[]){0, 0, 0}, (double[]){0, 1.9, 0}, 1.0, NULL);
    check_exit("cylinder:1,4", (double[]){0, s, 1}, (double[]){2 * s, s, 1}, 0.5,
               (double[]){-s, -s, 0});
    check_exit("cylinder:1,4", (double[]){0, 0, 1}, (double[]){0.4, 0, 9}, 0.375,
               (double[]){0, 0, -1});
    check_exit("cylinder:5,0,0,1,0,0,1,4", (double[]){6, 0, 0}, (double[]){6, 0, -2}, 0.5,
               (double[]){0, 0, 1});
    check_exit("half-pipe:1,4", (double[]){0.5, 0.5, 1}, (double[]){0.5, -0.5, 1}, 0.5,
               (double[]){0, 1, 0});
    check_exit("half-pipe:1,4", (double[]){0, 0.5, 1}, (double[]){0, 1.5, 1}, 0.5,
               (double[]){0, -1, 0});
    check_exit(cube() + strlen("domain="), (double[]){0.005, 0.002, 0.003},
               (double[]){0.015, 0.002, 0.003}, 0.5, (double[]){-1, 0, 0});
}

/* A fluid that moves along x at 1 m/s everywhere. */
static const char *along_x(void)
{
    static char option[4096];
    const char *path = support_scratch_file("along.csv");
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    (void)fprintf(file, "x,y,z,u,v,w\n0,0,0,1,0,0\n");
    (void)fclose(file);
    (void)snprintf(option, sizeof option, "field=%s", path);
    return option;
}

/* A mirror keeps the length of the path and its angle: in a circle of radius 1, from (-s, s) along
 * x to the wall at (s, s), then down. */
static void a_mirror_is_specular(void **state)
{
    (void)state;
    const double s = sqrt(0.5);
    const char *const option[] = {"domain=cylinder:1,4",
                                  points_at(1, -s + 1e-6, s, 1.0),
                                  STILL,
                                  along_x(), // a wind into mirrors is refused
                                  "sides=reflect",
                                  "floor=reflect",
                                  "time_step=2s",
                                  "duration=2s",
                                  NULL};
    evolving c;
    clast_table after = {0};
    evolving_begin(&c, option);
    (void)evolving_follow(&c);
    CHECK_OK(clast_evolve_table(c.evolve, CLAST_EVOLVE_PARTICLES, &after));
    CHECK_ABS(clast_table_numbers(&after, "x_m")[0], s, 1e-7);
    CHECK_ABS(clast_table_numbers(&after, "y_m")[0], s - (2.0 - (2.0 * s - 1e-6)), 1e-6);
    clast_table_free(&after);
    evolving_end(&c);
}

/* Share of an even cloud in the inner half by volume stays a half behind walls that mirror. */
static void check_stays_even(const char *domain, double half, int axes)
{
    enum { N = 20000 };
    const char *const option[] = {
        domain,          "particles=20000", STILL,         "eddy_diffusivity=1e-5",
        "sides=reflect", "floor=reflect",   "duration=2s", NULL};
    evolving c;
    clast_table after = {0};
    int inner = 0;
    evolving_begin(&c, option);
    (void)evolving_follow(&c);
    CHECK_OK(clast_evolve_table(c.evolve, CLAST_EVOLVE_PARTICLES, &after));
    assert_int_equal(after.n_row, N);
    const double *x[3] = {clast_table_numbers(&after, "x_m"), clast_table_numbers(&after, "y_m"),
                          clast_table_numbers(&after, "z_m")};
    for (int i = 0; i < N; ++i) {
        inner += hypot(hypot(x[0][i], x[1][i]), axes == 3 ? x[2][i] : 0.0) < half ? 1 : 0;
    }
    CHECK_ABS((double)inner / N, 0.5, 4.0 * 0.5 / sqrt(N));
    clast_table_free(&after);
    evolving_end(&c);
}

static void mirrors_keep_a_cloud_even(void **state)
{
    (void)state;
    check_stays_even("domain=cylinder:5mm,1cm", 0.005 * sqrt(0.5), 2);
    check_stays_even("domain=half-pipe:5mm,1cm", 0.005 * sqrt(0.5), 2);
    check_stays_even("domain=sphere:5mm", 0.005 * cbrt(0.5), 3);
    check_stays_even(cube(), 0.01 * sqrt(2.0 / CLAST_PI),
                     2); /* a quarter of a circle about an edge */
}

/* J_n(x), the trapezoid rule of its integral. */
static double bessel(int n, double x)
{
    enum { POINTS = 64 };
    double sum = 0.0;
    for (int k = 0; k < POINTS; ++k) {
        const double a = CLAST_PI * (k + 0.5) / POINTS;
        sum += cos(n * a - x * sin(a));
    }
    return sum / POINTS;
}

static double next_zero(int n, double x)
{
    double low = x + 0.1;
    while (bessel(n, low) * bessel(n, low + 0.1) > 0.0) {
        low += 0.1;
    }
    double high = low + 0.1;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        *(bessel(n, low) * bessel(n, middle) > 0.0 ? &low : &high) = middle;
    }
    return low;
}

/* Left in a half disc of radius 1 after s, from its axis of symmetry at r: modes J_n(k r) sin(n t),
 * n odd [Carslaw1959 sec. 14.13]. */
static double half_disc_left(double r, double s)
{
    enum { PARTS = 200 };
    double sum = 0.0;
    for (int n = 1; n <= 9; n += 2) {
        double k = n;
        for (int m = 0; m < 4; ++m) {
            double integral = 0.0;
            k = next_zero(n, k);
            for (int i = 0; i < PARTS; ++i) {
                const double at = (i + 0.5) / PARTS;
                integral += bessel(n, k * at) * at / PARTS;
            }
            const double norm = 0.25 * CLAST_PI * pow(bessel(n + 1, k), 2);
            sum += 2.0 / n * integral / norm * bessel(n, k * r) * (n % 4 == 1 ? 1.0 : -1.0) *
                   exp(-k * k * s);
        }
    }
    return sum;
}

static void check_left(const char *domain, int n, const char *points, const char *floor,
                       double exact)
{
    const char *const option[] = {domain,          points, STILL,         "eddy_diffusivity=1e-5",
                                  "sides=deposit", floor,  "duration=1s", NULL};
    evolving c;
    evolving_begin(&c, option);
    const clast_evolve_result r = evolving_follow(&c);
    CHECK_ABS((double)(n - r.n_deposit) / n, exact, 4.0 * sqrt(exact * (1.0 - exact) / n));
    evolving_end(&c);
}

/* Walls that keep all of a half pipe and of a closed surface, at the default step. */
static void half_pipes_and_surfaces_take_what_diffuses(void **state)
{
    enum { N = 4000 };
    (void)state;
    check_left("domain=half-pipe:1cm,1", N, points_at(N, 0.0, 0.005, 0.5), "floor=reflect",
               half_disc_left(0.5, 0.1));
    double slab = 0.0;
    for (int k = 0; k < 20; ++k) {
        const double m = 2.0 * k + 1.0;
        slab += (k % 2 == 0 ? 4.0 : -4.0) / (m * CLAST_PI) * exp(-0.1 * pow(m * CLAST_PI, 2));
    }
    check_left(cube(), N, points_at(N, 0.005, 0.005, 0.005), "floor=deposit", pow(slab, 3));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_path_leaves_where_it_crosses), cmocka_unit_test(a_mirror_is_specular),
        cmocka_unit_test(mirrors_keep_a_cloud_even),
        cmocka_unit_test(half_pipes_and_surfaces_take_what_diffuses)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
