/* Unit: series of spherical harmonics against closed forms and published values. */
#include "support.h"

#include "math/legendre.h"
#include <clast/mesh_repair.h>
#include <stdio.h>
#include <string.h>

static clast_status parse(const char *text, clast_harmonics *series)
{
    return clast_harmonics_parse(text, strlen(text), series);
}

static void gauss_rule_integrates_its_degree(void **state)
{
    (void)state;
    double node[12];
    double weight[12];
    clx_gauss_legendre(12, node, weight);
    for (int power = 0; power <= 23; ++power) {
        double sum = 0.0;
        for (int i = 0; i < 12; ++i) {
            sum += weight[i] * pow(node[i], power);
        }
        CHECK_ABS(sum, power % 2 == 0 ? 2.0 / (power + 1) : 0.0, 1e-14);
    }
}

/* sum over m of |Y_nm|^2 = (2n + 1) / (4 pi) at every point (addition theorem). */
static void functions_obey_the_addition_theorem(void **state)
{
    (void)state;
    enum { DEGREE = 60 };
    clx_legendre l = {0};
    static double p[(DEGREE + 1) * (DEGREE + 2) / 2];
    CHECK_OK(clx_legendre_create(DEGREE, &l));
    for (int k = 0; k <= 10; ++k) {
        const double x = cos(CLAST_PI * k / 10.0);
        clx_legendre_values(&l, x, sqrt(fmax(0.0, 1.0 - x * x)), p);
        for (int n = 0; n <= DEGREE; ++n) {
            double sum = p[clx_nm(n, 0)] * p[clx_nm(n, 0)];
            for (int m = 1; m <= n; ++m) {
                sum += 2.0 * p[clx_nm(n, m)] * p[clx_nm(n, m)];
            }
            CHECK_REL(sum, (2.0 * n + 1.0) / (4.0 * CLAST_PI), 1e-12);
        }
    }
    /* Condon-Shortley: P_11 is negative for x in (-1, 1) */
    clx_legendre_values(&l, 0.0, 1.0, p);
    CHECK_REL(p[clx_nm(1, 1)], -sqrt(3.0 / (8.0 * CLAST_PI)), 1e-15);
    clx_legendre_free(&l);
}

static void slopes_are_derivatives(void **state)
{
    (void)state;
    enum { DEGREE = 12, N = (DEGREE + 1) * (DEGREE + 2) / 2 };
    clx_legendre l = {0};
    double p[3][N];
    double slope[N];
    const double theta = 0.7;
    const double h = 1e-5;
    CHECK_OK(clx_legendre_create(DEGREE, &l));
    for (int k = 0; k < 3; ++k) {
        const double t = theta + (k - 1) * h;
        clx_legendre_values(&l, cos(t), sin(t), p[k]);
    }
    clx_legendre_slopes(&l, cos(theta), sin(theta), p[1], slope);
    for (int i = 0; i < N; ++i) { /* central differences: n^3 h^2 / 6 of values of order 1 */
        CHECK_ABS(slope[i], (p[2][i] - p[0][i]) / (2.0 * h), 1e-7);
    }
    clx_legendre_free(&l);
}

/* r = R + d cos theta: a limacon turned about its axis. With Y_00 = 1/sqrt(4 pi) and Y_10 =
 * sqrt(3/(4 pi)) cos theta. V = 4 pi/3 (R^3 + R d^2); first moment 4 pi/3 (R^3 d + ...). */
static void a_limacon_has_its_closed_forms(void **state)
{
    (void)state;
    const double r = 3.0;
    const double d = 1.0;
    char text[200];
    clast_harmonics series = {0};
    clast_mass mass;
    double area;
    (void)snprintf(text, sizeof text, "0 0 %.17g 0\n1 0 %.17g 0\n1 1 0 0\n",
                   r * sqrt(4.0 * CLAST_PI), d * sqrt(4.0 * CLAST_PI / 3.0));
    CHECK_OK(parse(text, &series));
    CHECK_OK(clast_harmonics_mass(&series, -1, &mass, &area));
    CHECK_REL(mass.volume, 4.0 * CLAST_PI / 3.0 * (r * r * r + r * d * d), 1e-13);
    /* int r^4/4 cos: 2 pi / 4 int (R + d x)^4 x dx = pi/2 (8/3 R^3 d + 8/5 R d^3) */
    const double first = 0.5 * CLAST_PI * (8.0 / 3.0 * r * r * r * d + 8.0 / 5.0 * r * d * d * d);
    CHECK_REL(mass.centroid[2], first / mass.volume, 1e-13);
    CHECK_ABS(mass.centroid[0], 0.0, 1e-14);
    /* terms up to degree 0: a sphere */
    CHECK_OK(clast_harmonics_mass(&series, 0, &mass, &area));
    CHECK_REL(mass.volume, 4.0 / 3.0 * CLAST_PI * 27.0, 1e-13);
    CHECK_REL(area, 4.0 * CLAST_PI * 9.0, 1e-13);
    CHECK_REL(mass.inertia[0][0], 0.4 * mass.volume * 9.0, 1e-13);
    clast_harmonics_free(&series);
}

/* The published volume and area of the stone, n <= 26 [data README]: V = 3083.215147, A =
 * 1193.622617 mm2 (to 3e-5 by the README's own check), trace ratio 1.093. */
static void a_scanned_stone_has_its_published_values(void **state)
{
    (void)state;
    clast_harmonics series = {0};
    clast_grain g;
    CHECK_OK(
        clast_harmonics_read(support_data("shapes/sh-grains/fdot57-A-anm-00001.dat"), &series));
    assert_int_equal(series.degree, 26);
    CHECK_OK(clast_harmonics_measure(&series, 26, 4, &g));
    CHECK_REL(g.volume, 3083.215147, 1e-9);
    CHECK_REL(g.area, 1193.622617, 3e-5);
    const double radius = cbrt(3.0 * g.volume / (4.0 * CLAST_PI));
    CHECK_ABS((g.moments[0] + g.moments[1] + g.moments[2]) / (1.2 * g.volume * radius * radius),
              1.093, 5e-4);
    CHECK_REL(g.longest, 22.795276, 0.01);
    clast_harmonics_free(&series);
}

/* The cement file ends in CR LF, has degree 30 and published values for n <= 24. */
static void degree_limits_the_terms(void **state)
{
    (void)state;
    clast_harmonics series = {0};
    clast_mass mass;
    double area;
    CHECK_OK(
        clast_harmonics_read(support_data("shapes/sh-grains/cement152-anm-00004.dat"), &series));
    assert_int_equal(series.degree, 30);
    CHECK_OK(clast_harmonics_mass(&series, 24, &mass, &area));
    CHECK_REL(mass.volume, 4383.7569, 1e-7);
    CHECK_REL(area, 1776.8078, 3e-5);
    CHECK_OK(clast_harmonics_mass(&series, -1, &mass, &area));
    assert_true(fabs(area / 1776.8078 - 1.0) > 0.01); /* the higher orders are there */
    clast_harmonics_free(&series);
}

static void surfaces_refine_to_the_series(void **state)
{
    (void)state;
    clast_harmonics series = {0};
    clast_mass mass;
    double area;
    double last = 1.0;
    CHECK_OK(
        clast_harmonics_read(support_data("shapes/sh-grains/fdot57-A-anm-00001.dat"), &series));
    CHECK_OK(clast_harmonics_mass(&series, -1, &mass, &area));
    for (int level = 3; level <= 5; ++level) {
        clast_mesh mesh = {0};
        CHECK_OK(clast_harmonics_mesh(&series, -1, level, &mesh));
        assert_int_equal(mesh.n_tri, 20 << (2 * level));
        const double error = 1.0 - clast_mesh_volume(&mesh) / mass.volume;
        assert_true(error > 0.0 && error < 0.35 * last);
        last = error;
        clast_mesh_free(&mesh);
    }
    assert_true(last < 2e-3);
    clast_harmonics_free(&series);
}

/* With both signs of m, as the origin writes it, and with m >= 0 only: the same grain. */
static void rows_of_negative_order_may_be_missing(void **state)
{
    (void)state;
    clast_harmonics whole = {0};
    clast_harmonics half = {0};
    CHECK_OK(parse("0 0 9 0\n1 1 -0.5 0.25\n1 0 0.125 0\n1 -1 0.5 0.25\n", &whole));
    CHECK_OK(parse("# real\n0 0 9 0\n1 0 0.125 0\n\n1 1 -0.5 0.25", &half));
    assert_memory_equal(whole.coefficient, half.coefficient, 3 * sizeof *whole.coefficient);
    clast_harmonics_free(&whole);
    clast_harmonics_free(&half);
}

static void bad_files_are_refused_in_one_line(void **state)
{
    (void)state;
    static const char *const bad[][2] = {
        {"", "no coefficients"},
        {"0 0 1\n", "line 1"},
        {"0 0 1 0\n1 2 3 4\n", "line 2"},
        {"0 0 1 0\n0 0 1 0\n", "twice"},
        {"0 0 1 0\n1 0 1 0\n", "n = 1, m = 1 is missing"},
        {"0 0 1 0\n1 1 1 0\n1 0 1 0\n1 -1 0 0\n2 2 0 0\n2 1 0 0\n2 0 0 0\n2 -1 0 0\n",
         "n = 2, m = -2 is missing"},
        {"0 0 nan 0\n", "line 1"},
        {"0 0 1e999 0\n", "line 1"},
        {"900 0 1 0\n", "line 1"},
        {"0 0 1 0 7\n", "more than"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        clast_harmonics series = {0};
        CHECK_STATUS(parse(bad[i][0], &series), CLAST_E_FORMAT);
        assert_non_null(strstr(clast_error_detail(), bad[i][1]));
        assert_null(series.coefficient);
    }
}

static void a_radius_below_zero_is_no_grain(void **state)
{
    (void)state;
    clast_harmonics series = {0};
    clast_mesh mesh = {0};
    clast_mass mass = {.volume = -1.0};
    CHECK_OK(parse("0 0 1 0\n1 0 5 0\n1 1 0 0\n", &series));
    CHECK_STATUS(clast_harmonics_mesh(&series, -1, 2, &mesh), CLAST_E_GEOMETRY);
    CHECK_STATUS(clast_harmonics_mass(&series, -1, &mass, NULL), CLAST_E_GEOMETRY);
    assert_true(mesh.vert == NULL && mass.volume == -1.0);
    CHECK_STATUS(clast_harmonics_mesh(&series, 0, 9, &mesh), CLAST_E_LIMIT);
    CHECK_OK(clast_harmonics_mesh(&series, 0, 1, &mesh)); /* its sphere is one */
    clast_mesh_free(&mesh);
    clast_harmonics_free(&series);
    CHECK_STATUS(clast_harmonics_mesh(&series, 0, 1, &mesh), CLAST_E_GEOMETRY);
}

static clast_status parse_and_measure(void *context)
{
    clast_harmonics series = {0};
    clast_grain g;
    clast_status status = parse(context, &series);
    if (status == CLAST_OK) {
        status = clast_harmonics_measure(&series, -1, 0, &g);
    }
    clast_harmonics_free(&series);
    return status;
}

static void series_survive_refused_memory(void **state)
{
    (void)state;
    char text[] = "0 0 9 0\n1 0 0.125 0\n1 1 -0.5 0.25";
    support_refuse_each_allocation(parse_and_measure, text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gauss_rule_integrates_its_degree),
        cmocka_unit_test(functions_obey_the_addition_theorem),
        cmocka_unit_test(slopes_are_derivatives),
        cmocka_unit_test(a_limacon_has_its_closed_forms),
        cmocka_unit_test(a_scanned_stone_has_its_published_values),
        cmocka_unit_test(degree_limits_the_terms),
        cmocka_unit_test(surfaces_refine_to_the_series),
        cmocka_unit_test(rows_of_negative_order_may_be_missing),
        cmocka_unit_test(bad_files_are_refused_in_one_line),
        cmocka_unit_test(a_radius_below_zero_is_no_grain),
        cmocka_unit_test(series_survive_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
