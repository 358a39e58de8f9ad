/* Unit: unions of spheres against closed forms, and against columns of intervals. */
#include "support.h"

#include "base/alloc.h"
#include "math/rng.h"
#include "math/vec3.h"
#include <stdlib.h>
#include <string.h>

static void put(clast_spheres *s, int32_t i, double x, double y, double z, double r)
{
    v3_set(s->centre[i], x, y, z);
    s->radius[i] = r;
}

static void clump_of(const clast_spheres *spheres, clast_shape *shape)
{
    CHECK_OK(clast_shape_clump("clump", spheres, shape));
}

/* What two spheres share. [Weisstein, sphere-sphere intersection, eq. 16] */
static double lens(double d, double r, double q)
{
    return CLAST_PI * pow(r + q - d, 2) *
           (d * d + 2 * d * q - 3 * q * q + 2 * d * r + 6 * q * r - 3 * r * r) / (12 * d);
}

static double ball(double r)
{
    return 4.0 / 3.0 * CLAST_PI * r * r * r;
}

static void apart_and_touching_spheres_add_up(void **state)
{
    (void)state;
    clast_spheres s = {0};
    clast_shape shape = {0};
    CHECK_OK(clast_spheres_alloc(3, &s));
    put(&s, 0, 0, 0, 0, 1.0);
    put(&s, 1, 3, 0, 0, 2.0);
    put(&s, 2, 0, 9, 0, 0.5);
    clump_of(&s, &shape);
    const double v = ball(1.0) + ball(2.0) + ball(0.5);
    CHECK_REL(shape.volume, v, 1e-15);
    CHECK_REL(shape.source_origin[0], 3.0 * ball(2.0) / v, 1e-14);
    CHECK_REL(shape.source_origin[1], 9.0 * ball(0.5) / v, 1e-14);
    /* Steiner about the centroid. */
    double expected = 0.0;
    for (int32_t i = 0; i < 3; ++i) {
        const double r = s.radius[i];
        expected += ball(r) * (0.4 * r * r + pow(s.centre[i][0] - shape.source_origin[0], 2) +
                               pow(s.centre[i][1] - shape.source_origin[1], 2));
    }
    CHECK_REL(shape.inertia[2][2], expected, 1e-14);
    CHECK_REL(shape.length, sqrt(90.0) + 2.5, 1e-15);
    clast_shape_free(&shape);
    clast_spheres_free(&s);
}

/* Two spheres: volume by the lens; the moment of a cap about its sphere's centre is pi/4 (r2-h2)2;
   the moments of inertia come from slices, sum of pi/4 rho^4. */
static void two_overlapping_spheres_have_closed_forms(void **state)
{
    (void)state;
    static const double cases[][3] = {{1.0, 1.0, 1.0},  {1.5, 1.0, 0.8},   {0.5, 1.0, 0.9},
                                      {1.99, 1.0, 1.0}, {0.11, 1.0, 0.9},  {2.0 - 1e-6, 1.0, 1.0},
                                      {1e-3, 1.0, 1.0}, {0.999, 1.0, 1e-2}};
    for (size_t c = 0; c < sizeof cases / sizeof cases[0]; ++c) {
        const double d = cases[c][0];
        const double r = cases[c][1];
        const double q = cases[c][2];
        clast_spheres s = {0};
        clast_shape shape = {0};
        CHECK_OK(clast_spheres_alloc(2, &s));
        put(&s, 0, 5.0, 7.0, -3.0, r);
        put(&s, 1, 5.0, 7.0, -3.0 + d, q);
        clump_of(&s, &shape);
        const double v = ball(r) + ball(q) - lens(d, r, q);
        CHECK_REL(shape.volume, v, 1e-11);
        const double h = (d * d + r * r - q * q) / (2.0 * d); /* plane of the circle */
        const double g = d - h;
        /* sphere 0 below the plane, sphere 1 above it */
        const double low = -CLAST_PI / 4.0 * pow(r * r - h * h, 2);
        const double high = CLAST_PI / 4.0 * pow(q * q - g * g, 2);
        const double v_high = CLAST_PI * (q + g) * (q + g) * (2.0 * q - g) / 3.0;
        CHECK_ABS(shape.source_origin[2] + 3.0, (low + high + d * v_high) / v, 1e-11);
        CHECK_ABS(shape.source_origin[0], 5.0, 1e-11);
        /* I_zz = pi/2 int rho^4 dz, rho2 = r2 - z2 on [-r, h] and q2 - z2 on [-g, q] */
        const double i_low = (h + r) * pow(r, 4) - 2.0 / 3.0 * r * r * (pow(h, 3) + pow(r, 3)) +
                             (pow(h, 5) + pow(r, 5)) / 5.0;
        const double i_high = (q + g) * pow(q, 4) - 2.0 / 3.0 * q * q * (pow(g, 3) + pow(q, 3)) +
                              (pow(g, 5) + pow(q, 5)) / 5.0;
        CHECK_REL(shape.inertia[2][2], CLAST_PI / 2.0 * (i_low + i_high), 3e-11);
        CHECK_ABS(shape.inertia[0][2], 0.0, 1e-11);
        clast_shape_free(&shape);
        clast_spheres_free(&s);
    }
}

static void hidden_and_equal_spheres_change_nothing(void **state)
{
    (void)state;
    clast_spheres s = {0};
    clast_shape shape = {0};
    CHECK_OK(clast_spheres_alloc(5, &s));
    put(&s, 0, 0, 0, 0, 1.0);
    put(&s, 1, 0.1, 0, 0, 0.3);
    put(&s, 2, 0, 0, 0, 1.0);
    put(&s, 3, 0, 0, 0.5, 0.5);
    put(&s, 4, 0, 0, 0, 1.0);
    clump_of(&s, &shape);
    CHECK_REL(shape.volume, ball(1.0), 1e-11);
    CHECK_REL(shape.semi_axes[2], 1.0, 1e-11);
    clast_shape_free(&shape);
    clast_spheres_free(&s);
}

/* Spheres of radius 0.5 < r < 1/sqrt 2 on a cubic lattice overlap in pairs only: inclusion and
   exclusion is exact, and four circles meet in symmetric places. */
static void lattice_follows_inclusion_and_exclusion(void **state)
{
    (void)state;
    const double r = 0.6;
    clast_spheres s = {0};
    clast_shape shape = {0};
    CHECK_OK(clast_spheres_alloc(27, &s));
    for (int32_t i = 0; i < 27; ++i) {
        put(&s, i, i % 3, i / 3 % 3, i / 9, r);
    }
    clump_of(&s, &shape);
    CHECK_REL(shape.volume, 27 * ball(r) - 54 * lens(1.0, r, r), 1e-11);
    for (int k = 0; k < 3; ++k) {
        CHECK_REL(shape.source_origin[k], 1.0, 1e-11);
        CHECK_REL(shape.inertia[k][k], shape.inertia[0][0], 1e-11);
    }
    clast_shape_free(&shape);
    clast_spheres_free(&s);
}

/* Integrals of 1, x_k and x_j x_k. */
typedef struct {
    double volume, first[3], second[3][3];
} sums;

static int by_low(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return x < y ? -1 : x > y ? 1 : 0;
}

/* Adds one column of the union at (x, y): merged intervals, integrated exactly along z. */
static void add_column(const clast_spheres *s, double x, double y, double area, sums *sum)
{
    double span[64][2];
    int n = 0;
    for (int32_t i = 0; i < s->n; ++i) {
        const double h2 =
            s->radius[i] * s->radius[i] - pow(x - s->centre[i][0], 2) - pow(y - s->centre[i][1], 2);
        if (h2 > 0.0) {
            span[n][0] = s->centre[i][2] - sqrt(h2);
            span[n++][1] = s->centre[i][2] + sqrt(h2);
        }
    }
    qsort(span, (size_t)n, sizeof span[0], by_low);
    double reach = -INFINITY;
    for (int i = 0; i < n; ++i) {
        const double a = fmax(span[i][0], reach);
        const double b = span[i][1];
        if (b > a) {
            const double m0 = area * (b - a);
            const double m1 = area * (b * b - a * a) / 2.0;
            const double m2 = area * (b * b * b - a * a * a) / 3.0;
            sum->volume += m0;
            v3_axpy(sum->first, sum->first, 1.0, (double[3]){x * m0, y * m0, m1});
            sum->second[0][0] += x * x * m0;
            sum->second[1][1] += y * y * m0;
            sum->second[2][2] += m2;
            sum->second[0][1] += x * y * m0;
            sum->second[0][2] += x * m1;
            sum->second[1][2] += y * m1;
            reach = b;
        }
    }
}

static void columns(const clast_spheres *s, double half, int n, sums *sum)
{
    const double step = 2.0 * half / n;
    *sum = (sums){0};
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            add_column(s, -half + (i + 0.5) * step, -half + (j + 0.5) * step, step * step, sum);
        }
    }
}

/* Random heaps of up to 40 spheres, many hidden, against 400 x 400 columns (error about 2e-5). */
static void heaps_agree_with_columns(void **state)
{
    (void)state;
    for (uint64_t trial = 0; trial < 6; ++trial) {
        clast_spheres s = {0};
        clast_shape shape = {0};
        sums sum;
        const int32_t n = trial < 3 ? 5 : 40;
        clx_rng rng = clx_rng_at(3, CLX_STREAM_TEST, trial);
        CHECK_OK(clast_spheres_alloc(n, &s));
        for (int32_t i = 0; i < n; ++i) {
            double u[4];
            for (int k = 0; k < 4; ++k) {
                u[k] = clx_rng_uniform(&rng);
            }
            put(&s, i, 2 * u[0] - 1, 2 * u[1] - 1, 2 * u[2] - 1, 0.2 + 0.6 * u[3]);
        }
        clump_of(&s, &shape);
        columns(&s, 1.8, 400, &sum);
        CHECK_REL(shape.volume, sum.volume, 1e-4);
        for (int k = 0; k < 3; ++k) {
            CHECK_ABS(shape.source_origin[k], sum.first[k] / sum.volume, 1e-4);
        }
        for (int j = 0; j < 3; ++j) {
            for (int k = j + 1; k < 3; ++k) {
                CHECK_ABS(-shape.inertia[j][k],
                          sum.second[j][k] - sum.first[j] * sum.first[k] / sum.volume, 3e-4);
            }
        }
        const double trace = sum.second[0][0] + sum.second[1][1] + sum.second[2][2];
        const double mean2 = v3_norm2(sum.first) / sum.volume;
        CHECK_REL(0.5 * (shape.inertia[0][0] + shape.inertia[1][1] + shape.inertia[2][2]),
                  trace - mean2, 2e-4);
        clast_shape_free(&shape);
        clast_spheres_free(&s);
    }
}

/* A sphere whose surface is all but hidden by six others, and one with a pin hole left. */
static void nearly_hidden_sphere_is_settled(void **state)
{
    (void)state;
    clast_spheres s = {0};
    clast_shape with = {0};
    clast_shape without = {0};
    CHECK_OK(clast_spheres_alloc(7, &s));
    for (int32_t i = 0; i < 6; ++i) {
        put(&s, i, 0, 0, 0, 1.2);
        s.centre[i][i / 2] = i % 2 == 0 ? 1.0 : -1.0;
    }
    put(&s, 6, 0, 0, 0, 1.0); /* the corner (1,1,1)/sqrt 3 is 0.92 from each centre */
    clump_of(&s, &with);
    s.n = 6;
    clump_of(&s, &without);
    CHECK_REL(with.volume, without.volume, 1e-11);
    clast_shape_free(&with);
    s.n = 7;
    /* Its radius at the eight corners where three neighbours meet; what it shows beyond them by h
       is eight small pyramids, growing as h cubed. */
    const double corner = (1.0 + sqrt(1.0 + 3.0 * 0.44)) / sqrt(3.0);
    double excess[3];
    for (int i = 0; i < 3; ++i) {
        const double h[3] = {1e-6, 1e-3, 2e-3};
        s.radius[6] = corner + h[i];
        clump_of(&s, &with);
        excess[i] = with.volume - without.volume;
        clast_shape_free(&with);
    }
    CHECK_ABS(excess[0], 0.0, 1e-10);
    assert_true(excess[1] > 1e-9);
    CHECK_REL(excess[2] / excess[1], 8.0, 0.05);
    clast_shape_free(&without);
    clast_spheres_free(&s);
}

/* The same clump turned is the same clump. */
static void union_does_not_depend_on_the_frame(void **state)
{
    (void)state;
    clast_spheres s = {0};
    clast_shape first = {0};
    CHECK_OK(clast_spheres_alloc(12, &s));
    clx_rng rng = clx_rng_at(4, CLX_STREAM_TEST, 0);
    for (int32_t i = 0; i < 12; ++i) {
        put(&s, i, clx_rng_uniform(&rng), clx_rng_uniform(&rng), clx_rng_uniform(&rng), 0.35);
    }
    clump_of(&s, &first);
    for (uint64_t trial = 0; trial < 20; ++trial) {
        clast_spheres turned = {0};
        clast_shape shape = {0};
        double q[4];
        clx_rng turn = clx_rng_at(4, CLX_STREAM_TEST, 1 + trial);
        clx_rng_orientation(&turn, q);
        CHECK_OK(clast_spheres_copy(&s, &turned));
        for (int32_t i = 0; i < 12; ++i) {
            q_rotate(turned.centre[i], q, turned.centre[i]);
            turned.centre[i][0] += 10.0;
        }
        clump_of(&turned, &shape);
        CHECK_REL(shape.volume, first.volume, 1e-11);
        for (int k = 0; k < 3; ++k) {
            CHECK_REL(shape.semi_axes[k], first.semi_axes[k], 1e-11);
        }
        clast_shape_free(&shape);
        clast_spheres_free(&turned);
    }
    clast_shape_free(&first);
    clast_spheres_free(&s);
}

/* Spheres of radius 1, centres 1.5 apart: their union's measures, where the hull of the centres is
 * a line without any. */
static void a_clump_is_measured_as_the_union_of_its_spheres(void **state)
{
    (void)state;
    const double r = 1.0;
    const double d = 1.5;
    double centre[2][3] = {{0.25, -1.0, 2.0}, {0.25, -1.0, 3.5}};
    double radius[2] = {r, r};
    const clast_spheres two = {2, centre, radius};
    const clast_spheres one = {1, centre, radius};
    const double lens = CLAST_PI / 12.0 * (4.0 * r + d) * (2.0 * r - d) * (2.0 * r - d);
    const double hull = 4.0 / 3.0 * CLAST_PI * r * r * r + CLAST_PI * r * r * d;
    clast_grain g;
    CHECK_OK(clast_grain_measure_clump(&two, &g));
    CHECK_REL(g.volume, 8.0 / 3.0 * CLAST_PI - lens, 1e-11);
    CHECK_REL(g.area, 4.0 * CLAST_PI * r * (r + 0.5 * d), 1e-11);
    CHECK_REL(g.centroid[2], 2.75, 1e-11);
    CHECK_REL(g.longest, 2.0 * r + d, 1e-14);
    CHECK_REL(g.axes[CLAST_AXES_PRINCIPAL].lis[0], 2.0 * r + d, 1e-12);
    CHECK_REL(g.axes[CLAST_AXES_PRINCIPAL].lis[2], 2.0 * r, 1e-12);
    CHECK_REL(g.axes[CLAST_AXES_FERET].lis[0], 2.0 * r + d, 1e-14);
    CHECK_REL(g.hull_volume, hull, 1e-9);
    CHECK_REL(g.convexity, (8.0 / 3.0 * CLAST_PI - lens) / hull, 1e-9);
    assert_true(g.axes[CLAST_AXES_ELLIPSOID].lis[0] > 2.0 * r);
    assert_true(isnan(g.shortest) && isnan(g.hull_area) && isnan(g.projected_mean));
    assert_true(isnan(g.axes[CLAST_AXES_BOX].lis[0]) && isnan(g.axes[CLAST_AXES_FERET].lis[2]));
    assert_true(isnan(g.roundness) && isnan(g.angularity) && isnan(g.normal_roundness));
    CHECK_OK(clast_grain_measure_clump(&one, &g));
    CHECK_REL(g.sphericity, 1.0, 1e-13);
    CHECK_REL(g.convexity, 1.0, 1e-13);
    CHECK_REL(g.axes[CLAST_AXES_ELLIPSOID].lis[1], 2.0, 1e-13);
}

/* Four spheres at a tetrahedron's corners: its hull is the Minkowski sum of the two bodies. */
static void the_hull_of_a_clump_has_its_steiner_volume(void **state)
{
    (void)state;
    double centre[4][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    double radius[4] = {0.5, 0.5, 0.5, 0.5};
    const clast_spheres four = {4, centre, radius};
    const double a = 2.0 * sqrt(2.0);
    const double r = 0.5;
    clast_grain g;
    CHECK_OK(clast_grain_measure_clump(&four, &g));
    // V + A r + M r2 + 4 pi / 3 r3, M half the edges' lengths by their outer angles
    const double mean = 0.5 * 6.0 * a * (CLAST_PI - acos(1.0 / 3.0));
    CHECK_REL(g.hull_volume,
              a * a * a / (6.0 * sqrt(2.0)) + sqrt(3.0) * a * a * r + mean * r * r +
                  4.0 / 3.0 * CLAST_PI * r * r * r,
              1e-9);
    CHECK_REL(g.volume, 4.0 * 4.0 / 3.0 * CLAST_PI * r * r * r, 1e-13);
    CHECK_REL(g.area, 4.0 * 4.0 * CLAST_PI * r * r, 1e-13);
}

static void wrong_spheres_are_refused(void **state)
{
    (void)state;
    clast_spheres s = {0};
    clast_shape shape = {0};
    CHECK_STATUS(clast_shape_clump("none", &s, &shape), CLAST_E_GEOMETRY);
    CHECK_OK(clast_spheres_alloc(2, &s));
    put(&s, 0, 0, 0, 0, 1.0);
    put(&s, 1, 0, 0, 0, -1.0);
    CHECK_STATUS(clast_shape_clump("bad", &s, &shape), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "bad: sphere 1"));
    put(&s, 1, NAN, 0, 0, 1.0);
    CHECK_STATUS(clast_shape_clump("bad", &s, &shape), CLAST_E_GEOMETRY);
    clast_spheres_free(&s);
}

static clast_status make_clump(void *context)
{
    clast_shape shape = {0};
    clast_mesh mesh = {0};
    clast_status status = clast_shape_clump("pair", context, &shape);
    if (status == CLAST_OK) {
        status = clast_shape_surface(&shape, 1, &mesh);
    }
    if (status == CLAST_OK) {
        assert_int_equal(mesh.n_tri, 160);
    }
    clast_mesh_free(&mesh);
    clast_shape_free(&shape);
    return status;
}

static void clump_survives_refused_memory(void **state)
{
    (void)state;
    clast_spheres s = {0};
    CHECK_OK(clast_spheres_alloc(2, &s));
    put(&s, 0, 0, 0, 0, 1.0);
    put(&s, 1, 1, 0, 0, 1.0);
    support_refuse_each_allocation(make_clump, &s);
    clast_spheres_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(apart_and_touching_spheres_add_up),
        cmocka_unit_test(two_overlapping_spheres_have_closed_forms),
        cmocka_unit_test(hidden_and_equal_spheres_change_nothing),
        cmocka_unit_test(lattice_follows_inclusion_and_exclusion),
        cmocka_unit_test(heaps_agree_with_columns),
        cmocka_unit_test(nearly_hidden_sphere_is_settled),
        cmocka_unit_test(union_does_not_depend_on_the_frame),
        cmocka_unit_test(a_clump_is_measured_as_the_union_of_its_spheres),
        cmocka_unit_test(the_hull_of_a_clump_has_its_steiner_volume),
        cmocka_unit_test(wrong_spheres_are_refused),
        cmocka_unit_test(clump_survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
