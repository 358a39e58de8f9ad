/* Unit: form laws and stretched grains: closed forms, means, the hand of a grain. */
#include "mesh_maker.h"

#include "math/special.h"
#include "math/vec3.h"
#include <clast/form.h>
#include <clast/mesh.h>
#include <clast/shape.h>
#include <stdlib.h>
#include <string.h>

static void axes_of(const clast_mesh *mesh, double lis[3])
{
    clast_shape shape = {0};
    CHECK_OK(clast_shape_mesh("grain", mesh, &shape));
    v3_scale(lis, 2.0, shape.semi_axes);
    clast_shape_free(&shape);
}

static void a_box_has_textbook_axes(void **state)
{
    (void)state;
    clast_mesh box = {0};
    clast_mesh out = {0};
    double lis[3];
    double low[3];
    double high[3];
    CHECK_OK(clast_mesh_box(1.0, 3.0, 2.0, &box)); // equivalent axis: edge * sqrt(5/3)
    mesh_tilt(&box);
    CHECK_OK(clast_reform_principal(&box, &out, lis));
    clast_mesh_bounds(&out, low, high);
    for (int k = 0; k < 3; ++k) {
        // tilted: 1.7 times as large and 20 edges away, which costs 20 roundings
        CHECK_REL(lis[k], 1.7 * (3 - k) * sqrt(5.0 / 3.0), 1e-13);
        CHECK_REL(high[k], 0.85 * (3 - k), 1e-13);
        CHECK_REL(low[k], -0.85 * (3 - k), 1e-13);
    }
    clast_mesh_free(&out);
    clast_mesh_free(&box);
}

/// A grain without any symmetry: hull of points on a spiral.
static void lopsided(clast_mesh *mesh)
{
    clast_mesh points = {0};
    CHECK_OK(clast_mesh_alloc(40, 0, &points));
    for (int i = 0; i < 40; ++i) {
        const double z = (2.0 * i - 39.0) / 40.0;
        const double r = sqrt(1.0 - z * z) * (1.0 + 0.3 * sin(0.7 * i));
        v3_set(points.vert[i], 2.0 * r * cos(2.4 * i) + 5.0, r * sin(2.4 * i) + 0.2 * z, 3.0 * z);
    }
    CHECK_OK(clast_mesh_hull(&points, mesh));
    clast_mesh_free(&points);
}

static void any_form_is_put_on_exactly(void **state)
{
    (void)state;
    const double wanted[4][3] = {
        {1.0, 1.0, 1.0}, {2.0, 1.0, 0.5}, {10e-3, 9.999e-3, 0.1e-3}, {10.0, 0.1, 0.1}};
    clast_mesh grain = {0};
    lopsided(&grain);
    mesh_tilt(&grain);
    for (int i = 0; i < 4; ++i) {
        clast_mesh out = {0};
        clast_mass mass;
        double lis[3];
        CHECK_OK(clast_reform_mesh(&grain, wanted[i], &out));
        axes_of(&out, lis);
        // inertia of order L^2 leaves S^2: rounding grows by (L/S)^2
        const double tol = 1e-14 * fmax(1.0, pow(wanted[i][0] / wanted[i][2], 2.0));
        for (int k = 0; k < 3; ++k) {
            CHECK_REL(lis[k], wanted[i][k], fmax(tol, 1e-13));
        }
        CHECK_OK(clast_mesh_mass(&out, &mass));
        CHECK_ABS(v3_norm(mass.centroid), 0.0, 1e-14 * wanted[i][0]);
        clast_mesh_free(&out);
    }
    clast_mesh_free(&grain);
}

/* The unit mesh carries any form: multiplied by (L, I, S) it has it, without another measurement.
 */
static void a_unit_mesh_is_stretched_by_its_axes(void **state)
{
    (void)state;
    const double one[3] = {1.0, 1.0, 1.0};
    clast_mesh grain = {0};
    clast_mesh unit = {0};
    double lis[3];
    double want[3];
    lopsided(&grain);
    CHECK_OK(clast_reform_mesh(&grain, one, &unit));
    clast_form_lengths(0.4, 0.7, 11e-3, want); // eqs 20 to 22
    CHECK_REL(want[2] / want[1], 0.4, 1e-15);
    CHECK_REL(clast_form_sieve_size(want[1], want[2]), 11e-3, 1e-15);
    for (int32_t v = 0; v < unit.n_vert; ++v) {
        for (int k = 0; k < 3; ++k) {
            unit.vert[v][k] *= want[k];
        }
    }
    axes_of(&unit, lis);
    for (int k = 0; k < 3; ++k) {
        CHECK_REL(lis[k], want[k], 1e-12);
    }
    clast_mesh_free(&unit);
    clast_mesh_free(&grain);
}

static void mirror(clast_mesh *mesh)
{
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        mesh->vert[v][0] *= -1.0;
    }
    mesh_flip_all(mesh);
}

/// Greatest distance of a vertex of one mesh from the nearest vertex of the other.
static double apart(const clast_mesh *a, const clast_mesh *b)
{
    double most = 0.0;
    for (int32_t i = 0; i < a->n_vert; ++i) {
        double least = HUGE_VAL;
        for (int32_t j = 0; j < b->n_vert; ++j) {
            least = fmin(least, v3_distance2(a->vert[i], b->vert[j]));
        }
        most = fmax(most, least);
    }
    return sqrt(most);
}

/* The same grain in another place and position gives the same mesh; its mirror image does not. */
static void a_grain_keeps_its_hand(void **state)
{
    (void)state;
    const double lis[3] = {1.0, 0.8, 0.5};
    clast_mesh grain = {0};
    clast_mesh tilted = {0};
    clast_mesh out[3] = {{0}};
    lopsided(&grain);
    CHECK_OK(clast_mesh_copy(&grain, &tilted));
    mesh_tilt(&tilted);
    CHECK_OK(clast_reform_mesh(&grain, lis, &out[0]));
    CHECK_OK(clast_reform_mesh(&tilted, lis, &out[1]));
    mirror(&grain);
    CHECK_OK(clast_reform_mesh(&grain, lis, &out[2]));
    CHECK_ABS(apart(&out[0], &out[1]), 0.0, 1e-13);
    assert_true(apart(&out[0], &out[2]) > 0.01);
    // turned into place, never mirrored: the mirror image's mesh is the mirror image
    mirror(&out[2]);
    double least = HUGE_VAL; // up to half turns, which its own skewness settles
    for (int half = 0; half < 4; ++half) {
        const double x = (half & 1) != 0 ? -1.0 : 1.0;
        const double y = (half & 2) != 0 ? -1.0 : 1.0;
        clast_mesh turned = {0};
        CHECK_OK(clast_mesh_copy(&out[2], &turned));
        for (int32_t v = 0; v < turned.n_vert; ++v) {
            v3_set(turned.vert[v], x * turned.vert[v][0], y * turned.vert[v][1],
                   x * y * turned.vert[v][2]);
        }
        least = fmin(least, apart(&out[0], &turned));
        clast_mesh_free(&turned);
    }
    CHECK_ABS(least, 0.0, 1e-13);
    for (int k = 0; k < 3; ++k) {
        assert_true(clast_mesh_volume(&out[k]) > 0.0);
        clast_mesh_free(&out[k]);
    }
    clast_mesh_free(&tilted);
    clast_mesh_free(&grain);
}

/* A hull of few faces: convex, within the number, and as large as the hull but for what simplifying
   moves (the paper's meshes lose 0.2 % on average at 300 faces). */
static void hulls_keep_to_their_number_of_faces(void **state)
{
    (void)state;
    const double axes[3] = {3.0, 2.0, 1.5};
    clast_mesh ellipsoid = {0};
    CHECK_OK(clast_mesh_ellipsoid(axes, 4, &ellipsoid));
    const double volume = clast_mesh_volume(&ellipsoid);
    for (int32_t n = 8; n <= 10000; n *= 6) {
        clast_mesh out = {0};
        clast_mesh again = {0};
        CHECK_OK(clast_reform_hull(&ellipsoid, n, &out));
        assert_true(out.n_tri <= n);
        CHECK_OK(clast_mesh_hull(&out, &again));
        CHECK_REL(clast_mesh_volume(&out), clast_mesh_volume(&again), 1e-12);
        CHECK_REL(clast_mesh_volume(&out), volume, n < 200 ? 0.05 : 0.002);
        clast_mesh_free(&out);
        clast_mesh_free(&again);
    }
    CHECK_STATUS(clast_reform_hull(&ellipsoid, 3, &(clast_mesh){0}), CLAST_E_CONFIG);
    clast_mesh_free(&ellipsoid);
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

enum { N = 20000 };

/// Kolmogorov-Smirnov at level 1e-6 against a cut normal law.
static void check_cut_normal(double *value, double mean, double deviation, double low, double high)
{
    const double a = clx_normal_cdf((low - mean) / deviation);
    const double part = clx_normal_cdf((high - mean) / deviation) - a;
    double distance = 0.0;
    qsort(value, N, sizeof *value, ascending);
    assert_true(value[0] >= low && value[N - 1] <= high);
    for (int i = 0; i < N; ++i) {
        const double share = (clx_normal_cdf((value[i] - mean) / deviation) - a) / part;
        distance = fmax(distance, fmax(share - i / (double)N, (i + 1) / (double)N - share));
    }
    CHECK_ABS(distance, 0.0, sqrt(0.5 * log(2e6) / N));
}

static void forms_follow_the_cut_law(void **state)
{
    (void)state;
    static double f[N];
    static double e[N];
    clast_form_law law[2] = {clast_form_law_rhine(), {0.4, 0.2, 0.95, 0.1, 0.1, 1.0}};
    for (int k = 0; k < 2; ++k) {
        double sum_f = 0.0;
        double sum_fe = 0.0;
        double square_f = 0.0;
        CHECK_OK(clast_form_law_check(&law[k]));
        const clast_form_law_moments m = clast_form_law_cut(&law[k]);
        for (uint64_t i = 0; i < N; ++i) {
            clast_form_law_draw(&law[k], 7, i, &f[i], &e[i]);
            sum_f += f[i];
            square_f += pow(f[i] - m.flatness_mean, 2.0);
            sum_fe += (f[i] - m.flatness_mean) * (e[i] - m.elongation_mean);
        }
        CHECK_ABS(sum_f / N, m.flatness_mean, 5.0 * m.flatness_deviation / sqrt(N));
        CHECK_REL(sqrt(square_f / N), m.flatness_deviation, 5.0 / sqrt(2.0 * N));
        // independent: correlation 0
        CHECK_ABS(sum_fe / N / (m.flatness_deviation * m.elongation_deviation), 0.0, 5.0 / sqrt(N));
        check_cut_normal(f, law[k].flatness_mean, law[k].flatness_deviation, 0.1, 1.0);
        check_cut_normal(e, law[k].elongation_mean, law[k].elongation_deviation, 0.1, 1.0);
    }
}

/* The cut makes mean and deviation slightly smaller, as the paper notes for its packings. */
static void the_cut_moves_the_moments(void **state)
{
    (void)state;
    const clast_form_law rhine = clast_form_law_rhine();
    const clast_form_law_moments m = clast_form_law_cut(&rhine);
    assert_true(m.flatness_mean < 0.647 && m.flatness_deviation < 0.175);
    assert_true(m.elongation_mean < 0.682 && m.elongation_deviation < 0.139);
    // half a normal law: mean deviation * sqrt(2/pi), variance 1 - 2/pi
    const clast_form_law half = {0.1, 0.05, 0.5, 0.0, 0.1, 1.0};
    const clast_form_law_moments h = clast_form_law_cut(&half);
    CHECK_REL(h.flatness_mean, 0.1 + 0.05 * sqrt(2.0 / CLAST_PI), 1e-12);
    CHECK_REL(h.flatness_deviation, 0.05 * sqrt(1.0 - 2.0 / CLAST_PI), 1e-12);
    assert_true(h.elongation_mean == 0.5 && h.elongation_deviation == 0.0);
    double f = 0.0;
    double e = 0.0;
    clast_form_law_draw(&half, 1, 1, &f, &e);
    assert_true(e == 0.5);
}

static void bad_forms_are_refused(void **state)
{
    (void)state;
    static const struct {
        clast_form_law law;
        const char *says;
    } bad[] = {
        {{0.5, 0.1, 0.5, 0.1, 0.0, 1.0}, "0 < low"},
        {{0.5, 0.1, 0.5, 0.1, 0.1, 1.1}, "high <= 1"},
        {{0.5, -0.1, 0.5, 0.1, 0.1, 1.0}, "flatness: mean"},
        {{0.5, 0.1, (double)NAN, 0.1, 0.1, 1.0}, "elongation: mean"},
        {{0.05, 0.0, 0.5, 0.1, 0.1, 1.0}, "lies outside"},
        {{0.5, 0.1, 2.0, 0.1, 0.1, 1.0}, "only"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        CHECK_STATUS(clast_form_law_check(&bad[i].law), CLAST_E_CONFIG);
        assert_non_null(strstr(clast_error_detail(), bad[i].says));
    }
    clast_mesh box = {0};
    clast_mesh out = {0};
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &box));
    CHECK_STATUS(clast_reform_mesh(&box, (double[3]){1.0, 2.0, 1.0}, &out), CLAST_E_CONFIG);
    CHECK_STATUS(clast_reform_mesh(&box, (double[3]){1.0, 1.0, 0.0}, &out), CLAST_E_CONFIG);
    CHECK_STATUS(clast_reform_mesh(&box, (double[3]){(double)NAN, 1.0, 1.0}, &out), CLAST_E_CONFIG);
    mesh_flip_all(&box);
    CHECK_STATUS(clast_reform_mesh(&box, (double[3]){1.0, 1.0, 1.0}, &out), CLAST_E_GEOMETRY);
    assert_int_equal(out.n_vert, 0);
    clast_mesh_free(&box);
}

static clast_status make_reformed(void *context)
{
    clast_mesh out = {0};
    clast_status status = clast_reform_mesh(context, (double[3]){2.0, 1.0, 1.0}, &out);
    clast_mesh_free(&out);
    if (status == CLAST_OK) {
        status = clast_reform_hull(context, 8, &out);
    }
    clast_mesh_free(&out);
    return status;
}

static void refused_memory_leaves_nothing(void **state)
{
    (void)state;
    clast_mesh box = {0};
    CHECK_OK(clast_mesh_box(1.0, 2.0, 3.0, &box));
    support_refuse_each_allocation(make_reformed, &box);
    clast_mesh_free(&box);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_box_has_textbook_axes),
        cmocka_unit_test(any_form_is_put_on_exactly),
        cmocka_unit_test(a_unit_mesh_is_stretched_by_its_axes),
        cmocka_unit_test(a_grain_keeps_its_hand),
        cmocka_unit_test(hulls_keep_to_their_number_of_faces),
        cmocka_unit_test(forms_follow_the_cut_law),
        cmocka_unit_test(the_cut_moves_the_moments),
        cmocka_unit_test(bad_forms_are_refused),
        cmocka_unit_test(refused_memory_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
