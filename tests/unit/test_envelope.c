/* Unit: envelopes of assemblies against closed forms and published values. */
#include "support.h"

#include "aggregate/envelope.h"
#include "math/rng.h"
#include "math/vec3.h"
#include <string.h>

static const double no_turn[4] = {1.0, 0.0, 0.0, 0.0};

static double volume_of(const clast_assembly *a, clast_envelope_kind kind)
{
    const clast_envelope_options options = clast_envelope_options_default();
    clast_envelope e = {0};
    CHECK_OK(clast_assembly_envelope(a, kind, &options, &e));
    assert_int_equal(e.kind, kind);
    assert_true(e.low <= e.volume && e.volume <= e.high && e.error >= 0.0);
    return e.volume;
}

static void two_spheres(double q, clast_assembly *a)
{
    clast_shape sphere = {0};
    const double at[3] = {0.48 * (1.0 + q), -0.6 * (1.0 + q), 0.64 * (1.0 + q)};
    CHECK_OK(clast_shape_sphere("ball", 1.0, &sphere));
    CHECK_OK(clast_assembly_add_shape(a, &sphere, NULL));
    CHECK_OK(clast_assembly_add_grain(a, 0, (double[3]){0, 0, 0}, no_turn, q, 1.0));
    CHECK_OK(clast_assembly_add_grain(a, 0, at, no_turn, 1.0, 1.0));
    clast_shape_free(&sphere);
}

static void tangent_spheres_have_every_envelope(void **state)
{
    (void)state;
    const double qs[] = {1.0, 2.0, 5.0, 10.0};
    const double wanted[] = {0.2, 0.129032, 0.0320102, 0.00900009}; /* as printed */
    for (int i = 0; i < 4; ++i) {
        const double q = qs[i];
        clast_assembly a = {0};
        two_spheres(q, &a);
        const double solid = clast_assembly_volume(&a);
        const double phi = 1.0 - solid / volume_of(&a, CLAST_ENVELOPE_SURFACE_HULL);
        CHECK_ABS(phi, q * q / (1.0 + q + q * q + q * q * q + q * q * q * q), 1e-12);
        CHECK_ABS(phi, wanted[i], 1e-6);
        CHECK_REL(volume_of(&a, CLAST_ENVELOPE_SPHERE_HULL), solid / (1.0 - phi), 1e-12);
        CHECK_REL(volume_of(&a, CLAST_ENVELOPE_ENCLOSING_SPHERE),
                  4.0 / 3.0 * CLAST_PI * pow(1.0 + q, 3.0), 1e-11);
        /* 10000 rays lie inside, by less than 2 % here */
        const double rays = volume_of(&a, CLAST_ENVELOPE_SPHERE_RAYS);
        assert_true(rays < solid / (1.0 - phi) && rays > 0.98 * solid / (1.0 - phi));
        clast_assembly_free(&a);
    }
}

/* Two equal balls a distance d apart: Rg^2 = 3/5 r^2 + d^2 / 4. */
static void gyration_counts_the_grains_own_extent(void **state)
{
    (void)state;
    clast_assembly a = {0};
    two_spheres(1.0, &a);
    CHECK_REL(clast_assembly_radius_of_gyration(&a), sqrt(0.6 + 1.0), 1e-15);
    CHECK_REL(volume_of(&a, CLAST_ENVELOPE_GYRATION_SPHERE),
              4.0 / 3.0 * CLAST_PI * pow(1.6 * 5.0 / 3.0, 1.5), 1e-14);
    clast_assembly_free(&a);
    clast_mesh box = {0};
    clast_shape shape = {0};
    CHECK_OK(clast_mesh_box(1.0, 2.0, 3.0, &box));
    CHECK_OK(clast_shape_mesh("box", &box, &shape));
    CHECK_OK(clast_assembly_add_shape(&a, &shape, NULL));
    CHECK_OK(clast_assembly_add_grain(&a, 0, (double[3]){5, 6, 7}, (double[4]){0.5, 0.5, 0.5, 0.5},
                                      2.0, 2600.0));
    CHECK_REL(clast_assembly_radius_of_gyration(&a), 2.0 * sqrt(14.0 / 12.0), 1e-14);
    CHECK_REL(volume_of(&a, CLAST_ENVELOPE_SURFACE_HULL), 48.0, 1e-13);
    CHECK_REL(volume_of(&a, CLAST_ENVELOPE_ENCLOSING_SPHERE), 4.0 / 3.0 * CLAST_PI * pow(14.0, 1.5),
              1e-11);
    clast_shape_free(&shape);
    clast_mesh_free(&box);
    clast_assembly_free(&a);
}

static void ellipsoid_is_its_own_hull_and_fits_its_long_axis(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_shape shape = {0};
    CHECK_OK(clast_shape_ellipsoid("e", (double[3]){3.0, 2.0, 0.5}, &shape));
    CHECK_OK(clast_assembly_add_shape(&a, &shape, NULL));
    CHECK_OK(clast_assembly_add_grain(&a, 0, (double[3]){5, 6, 7}, (double[4]){0.8, 0.0, 0.6, 0.0},
                                      2.0, 2600.0));
    CHECK_REL(volume_of(&a, CLAST_ENVELOPE_SURFACE_HULL), 4.0 / 3.0 * CLAST_PI * 24.0, 1e-12);
    CHECK_REL(volume_of(&a, CLAST_ENVELOPE_ENCLOSING_SPHERE), 4.0 / 3.0 * CLAST_PI * 216.0, 1e-11);
    clast_shape_free(&shape);
    clast_assembly_free(&a);
}

static void spheres_are_asked_for_by_name(void **state)
{
    (void)state;
    const clast_envelope_options options = clast_envelope_options_default();
    clast_assembly a = {0};
    clast_shape shape = {0};
    clast_envelope e = {0};
    clast_envelope_kind kind = CLAST_ENVELOPE_SURFACE_HULL;
    CHECK_STATUS(clast_assembly_envelope(&a, CLAST_ENVELOPE_SURFACE_HULL, &options, &e),
                 CLAST_E_USAGE);
    CHECK_OK(clast_shape_ellipsoid("egg", (double[3]){3.0, 2.0, 1.0}, &shape));
    CHECK_OK(clast_assembly_add_shape(&a, &shape, NULL));
    CHECK_OK(clast_assembly_add_grain(&a, 0, (double[3]){0, 0, 0}, no_turn, 1.0, 1.0));
    CHECK_STATUS(clast_assembly_envelope(&a, CLAST_ENVELOPE_SPHERE_RAYS, &options, &e),
                 CLAST_E_USAGE);
    assert_non_null(strstr(clast_error_detail(), "egg"));
    CHECK_STATUS(clast_assembly_envelope(&a, CLAST_ENVELOPE_SPHERE_HULL, &options, &e),
                 CLAST_E_USAGE);
    for (int k = 0; k < CLAST_N_ENVELOPE; ++k) {
        assert_true(strlen(clast_envelope_text((clast_envelope_kind)k)) > 10);
        CHECK_OK(clast_envelope_parse(clast_envelope_name((clast_envelope_kind)k), &kind));
        assert_int_equal(kind, k);
    }
    CHECK_STATUS(clast_envelope_parse("hull", &kind), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "surface_hull"));
    clast_shape_free(&shape);
    clast_assembly_free(&a);
}

static clast_envelope wrap_of(const clast_assembly *a, double length, int32_t n_cell)
{
    clast_envelope_options options = clast_envelope_options_default();
    clast_envelope e = {0};
    options.length = length;
    options.n_cell = n_cell;
    CHECK_OK(clast_assembly_envelope(a, CLAST_ENVELOPE_WRAP, &options, &e));
    return e;
}

/* A ball of radius R rolled about two touching unit balls leaves a neck: outside the heights
 * -+ R / (1 + R) the balls' caps, between them the torus pi (rho - sqrt(R^2 - z^2))^2 with
 * rho^2 = (1 + R)^2 - 1. */
static double rolled_pair(double ball)
{
    const double rho = sqrt((1.0 + ball) * (1.0 + ball) - 1.0);
    const double top = ball / (1.0 + ball);
    const double cap = CLAST_PI * (top * top * (1.0 - top / 3.0)); /* ball below height `top` */
    double neck = 0.0;
    const int n = 20000;
    for (int i = 0; i < n; ++i) {
        const double z = top * (i + 0.5) / n;
        const double r = rho - sqrt(ball * ball - z * z);
        neck += CLAST_PI * r * r * top / n;
    }
    return 2.0 * (4.0 / 3.0 * CLAST_PI - cap + neck);
}

static void wrap_rolls_a_ball_about_the_grains(void **state)
{
    (void)state;
    clast_assembly a = {0};
    two_spheres(1.0, &a);
    for (int k = 0; k < 3; ++k) {
        const double ball = 0.25 * (k + 1) * (k + 1);
        const clast_envelope e = wrap_of(&a, ball, 48);
        assert_true(e.error < 0.1 * e.volume); /* 3/4 h^2 / L A is 5 % for the smallest ball */
        CHECK_ABS(e.volume, rolled_pair(ball), e.error);
    }
    clast_envelope_options wide = clast_envelope_options_default();
    clast_envelope e = {0};
    wide.length = 1e3;
    CHECK_STATUS(clast_assembly_envelope(&a, CLAST_ENVELOPE_WRAP, &wide, &e), CLAST_E_LIMIT);
    clast_assembly_free(&a);
}

/* The wrap of a convex body is the body. Distances that are carried past a surface of curvature
 * 1 / R exceed by t^2 / 2R, whatever the rolling ball: its radius alone is no bound. */
static void wrap_of_a_curved_body_is_within_its_error(void **state)
{
    (void)state;
    static const double axes[][3] = {{1.0, 1.0, 1.0}, {3.0, 1.0, 1.0}, {3.0, 3.0, 1.0}};
    for (size_t k = 0; k < sizeof axes / sizeof *axes; ++k) {
        for (int32_t n_cell = 20; n_cell <= 36; n_cell += 8) {
            clast_assembly a = {0};
            clast_shape egg = {0};
            CHECK_OK(clast_shape_ellipsoid("egg", axes[k], &egg));
            CHECK_OK(clast_assembly_add_shape(&a, &egg, NULL));
            CHECK_OK(clast_assembly_add_grain(&a, 0, (double[3]){0}, no_turn, 1.0, 1.0));
            const clast_envelope e = wrap_of(&a, 4.0, n_cell);
            CHECK_ABS(e.volume, egg.volume, e.error);
            const double h = 2.0 * axes[k][0] / n_cell;
            const double curvature = axes[k][0] / (axes[k][2] * axes[k][2]); // a / c^2
            const double sphere = pow(36.0 * CLAST_PI * egg.volume * egg.volume, 1.0 / 3.0);
            assert_true(e.error > 0.9 * sphere * 0.375 * h * h * (2.0 / 4.0 + curvature));
            clast_shape_free(&egg);
            clast_assembly_free(&a);
        }
    }
}

/* Three balls grown by the rolling ball's radius: its centre may be where none of them is. Three
 * balls close no hollow, so all of that is joined to infinity. */
typedef struct inflated {
    double at[3][3], radius[3];
} inflated;

static bool is_free(const inflated *g, const double p[3])
{
    for (int i = 0; i < 3; ++i) {
        if (v3_distance(p, g->at[i]) < g->radius[i] * (1.0 - 1e-9)) {
            return false;
        }
    }
    return true;
}

static double nearer(const inflated *g, const double p[3], const double q[3], double best)
{
    return is_free(g, q) ? fmin(best, v3_distance(p, q)) : best;
}

/* Point of the circle in which balls i and j meet that is nearest to p. */
static double try_circle(const inflated *g, int i, int j, const double p[3], double best)
{
    double n[3], c[3], q[3];
    v3_sub(n, g->at[j], g->at[i]);
    const double d = v3_norm(n);
    const double s = 0.5 * (d + (g->radius[i] * g->radius[i] - g->radius[j] * g->radius[j]) / d);
    const double r2 = g->radius[i] * g->radius[i] - s * s;
    if (r2 <= 0.0) {
        return best;
    }
    v3_axpy(c, g->at[i], s / d, n);
    v3_sub(q, p, c);
    v3_axpy(q, q, -v3_dot(q, n) / (d * d), n);
    v3_axpy(q, c, sqrt(r2) / v3_norm(q), q);
    return nearer(g, p, q, best);
}

/* The two points in which all three meet, in closed form: on circle (0, 1) the third
 * ball's border is crossed where its distance equals its radius. */
static double try_corners(const inflated *g, const double p[3], double best)
{
    double n[3], c[3], u[3], v[3], q[3];
    v3_sub(n, g->at[1], g->at[0]);
    const double d = v3_norm(n);
    const double s = 0.5 * (d + (g->radius[0] * g->radius[0] - g->radius[1] * g->radius[1]) / d);
    const double r2 = g->radius[0] * g->radius[0] - s * s;
    if (r2 <= 0.0) {
        return best;
    }
    v3_scale(n, 1.0 / d, n);
    v3_axpy(c, g->at[0], s, n);
    v3_sub(u, g->at[2], c);
    v3_axpy(u, u, -v3_dot(u, n), n);
    const double across = v3_norm(u);
    v3_scale(u, 1.0 / across, u);
    v3_cross(v, n, u);
    v3_sub(q, g->at[2], c);
    /* |c + r (u cos + v sin) - at2|^2 = radius2^2 */
    const double cosine =
        (r2 + v3_norm2(q) - g->radius[2] * g->radius[2]) / (2.0 * sqrt(r2) * across);
    if (fabs(cosine) > 1.0) {
        return best;
    }
    for (int side = -1; side <= 1; side += 2) {
        v3_axpy(q, c, sqrt(r2) * cosine, u);
        v3_axpy(q, q, side * sqrt(r2 * (1.0 - cosine * cosine)), v);
        best = nearer(g, p, q, best);
    }
    return best;
}

/* Whether no rolling ball covers p: the nearest place for its centre is farther than its radius. */
static bool is_wrapped(const inflated *g, double ball, const double p[3])
{
    double best = HUGE_VAL;
    double q[3];
    if (is_free(g, p)) {
        return false;
    }
    for (int i = 0; i < 3; ++i) {
        v3_sub(q, p, g->at[i]);
        v3_axpy(q, g->at[i], g->radius[i] / v3_norm(q), q);
        best = nearer(g, p, q, best);
        best = try_circle(g, i, (i + 1) % 3, p, best);
    }
    return try_corners(g, p, best) >= ball;
}

static void wrap_of_three_balls_is_what_samples_say(void **state)
{
    (void)state;
    enum { SAMPLES = 40000 };
    for (int trial = 0; trial < 6; ++trial) {
        clx_rng rng = clx_rng_at(31, CLX_STREAM_TEST, (uint64_t)trial);
        clast_assembly a = {0};
        clast_shape shape = {0};
        inflated g;
        const double ball = 0.2 + 0.3 * trial;
        int64_t inside = 0;
        CHECK_OK(clast_shape_sphere("ball", 1.0, &shape));
        CHECK_OK(clast_assembly_add_shape(&a, &shape, NULL));
        clast_shape_free(&shape);
        for (int i = 0; i < 3; ++i) {
            const double r = 0.5 + 0.5 * clx_rng_uniform(&rng);
            clx_rng_direction(&rng, g.at[i]);
            v3_scale(g.at[i], 1.2, g.at[i]);
            CHECK_OK(clast_assembly_add_grain(&a, 0, g.at[i], (double[4]){1, 0, 0, 0}, r, 1.0));
            g.radius[i] = r + ball;
        }
        const clast_envelope e = wrap_of(&a, ball, 48);
        for (int i = 0; i < SAMPLES; ++i) {
            double p[3];
            for (int k = 0; k < 3; ++k) {
                p[k] = 4.4 * (clx_rng_uniform(&rng) - 0.5);
            }
            inside += is_wrapped(&g, ball, p);
        }
        const double share = (double)inside / SAMPLES;
        const double box = 4.4 * 4.4 * 4.4;
        const double scatter = box * sqrt(share * (1.0 - share) / SAMPLES);
        CHECK_ABS(e.volume, box * share, e.error + 4.0 * scatter);
        clast_assembly_free(&a);
    }
}

/* Six slabs round a hollow of edge 2: the ball cannot get in, whatever its size. */
static void wrap_counts_closed_hollows(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_mesh box = {0};
    clast_shape shape = {0};
    const double h = 0.5 * 0.70710678118654752440;
    const double turns[3][4] = {{1, 0, 0, 0}, {2 * h, 2 * h, 0, 0}, {2 * h, 0, 2 * h, 0}};
    CHECK_OK(clast_mesh_box(3.0, 3.0, 0.5, &box));
    CHECK_OK(clast_shape_mesh("slab", &box, &shape));
    CHECK_OK(clast_assembly_add_shape(&a, &shape, NULL));
    for (int i = 0; i < 6; ++i) {
        const int axis = i / 2 == 0 ? 2 : i / 2 == 1 ? 1 : 0;
        double at[3] = {0.0, 0.0, 0.0};
        at[axis] = i % 2 == 0 ? 1.25 : -1.25;
        CHECK_OK(clast_assembly_add_grain(&a, 0, at, turns[i / 2], 1.0, 1.0));
    }
    const clast_envelope e = wrap_of(&a, 0.2, 36);
    CHECK_ABS(e.volume, 27.0, e.error);
    assert_true(e.error < 0.05 * e.volume);
    const clast_envelope_options none = clast_envelope_options_default();
    clast_envelope out = {0};
    CHECK_STATUS(clast_assembly_envelope(&a, CLAST_ENVELOPE_WRAP, &none, &out), CLAST_E_USAGE);
    clast_shape_free(&shape);
    clast_mesh_free(&box);
    clast_assembly_free(&a);
}

/* Two unit balls and a ball of radius R that touches both, at the heights -+ R / (1 + R) and at rho
 * / (1
 * + R) from the axis: between the two circles the alpha shape is a cylinder. */
static void alpha_closes_the_neck_by_a_cylinder(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_envelope_options options = clast_envelope_options_default();
    clast_envelope e = {0};
    two_spheres(1.0, &a);
    CHECK_STATUS(clast_assembly_envelope(&a, CLAST_ENVELOPE_ALPHA, &options, &e), CLAST_E_USAGE);
    for (int k = 0; k < 3; ++k) {
        const double ball = 0.35 * (k + 1);
        const double top = ball / (1.0 + ball);
        const double radius = sqrt((1.0 + ball) * (1.0 + ball) - 1.0) / (1.0 + ball);
        const double cap = CLAST_PI * top * top * (1.0 - top / 3.0);
        const double wanted =
            2.0 * (4.0 / 3.0 * CLAST_PI - cap) + 2.0 * top * CLAST_PI * radius * radius;
        options.length = ball;
        CHECK_OK(clast_assembly_envelope(&a, CLAST_ENVELOPE_ALPHA, &options, &e));
        CHECK_ABS(e.volume, wanted, e.error);
        assert_true(e.error < 0.25 * e.volume);
    }
    clast_assembly_free(&a);
}

/* Boxes have their corners among the points: a heap of two far boxes is itself, for a great ball
 * its hull; a hollow is filled. */
static void alpha_of_boxes_is_exact(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_mesh box = {0};
    clast_shape shape = {0};
    clast_envelope_options options = clast_envelope_options_default();
    clast_envelope e = {0};
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &box));
    CHECK_OK(clast_shape_mesh("box", &box, &shape));
    CHECK_OK(clast_assembly_add_shape(&a, &shape, NULL));
    CHECK_OK(clast_assembly_add_grain(&a, 0, (double[3]){0, 0, 0}, no_turn, 1.0, 1.0));
    CHECK_OK(clast_assembly_add_grain(&a, 0, (double[3]){3, 0, 0}, no_turn, 1.0, 1.0));
    options.length = 0.4; /* smaller than the boxes: their inside is not reached */
    CHECK_OK(clast_assembly_envelope(&a, CLAST_ENVELOPE_ALPHA, &options, &e));
    CHECK_ABS(e.volume, 2.0, e.error + 1e-9);
    assert_true(e.error < 0.2);
    options.length = 50.0;
    CHECK_OK(clast_assembly_envelope(&a, CLAST_ENVELOPE_ALPHA, &options, &e));
    CHECK_ABS(e.volume, 4.0, e.error + 1e-9);
    clast_shape_free(&shape);
    clast_mesh_free(&box);
    clast_assembly_free(&a);
}

/* A loose heap of n ellipsoids: directions and turns at random, distances that grow. */
static void heap_of(int n, clast_shape_kind kind, clast_assembly *a)
{
    clast_shape shape = {0};
    clast_mesh mesh = {0};
    clx_rng rng = clx_rng_at(4, CLX_STREAM_TEST, 4);
    if (kind == CLAST_SHAPE_MESH) {
        CHECK_OK(clast_mesh_ellipsoid((double[3]){1.0, 0.7, 0.5}, 2, &mesh));
        CHECK_OK(clast_shape_mesh("grain", &mesh, &shape));
    } else {
        CHECK_OK(clast_shape_ellipsoid("grain", (double[3]){1.0, 0.7, 0.5}, &shape));
    }
    CHECK_OK(clast_assembly_add_shape(a, &shape, NULL));
    for (int i = 0; i < n; ++i) {
        double u[3], q[4];
        clx_rng_direction(&rng, u);
        clx_rng_orientation(&rng, q);
        v3_scale(u, 2.0 * cbrt(i) * (0.5 + 0.5 * clx_rng_uniform(&rng)), u);
        CHECK_OK(clast_assembly_add_grain(a, 0, u, q, 0.5 + clx_rng_uniform(&rng), 1.0));
    }
    clast_shape_free(&shape);
    clast_mesh_free(&mesh);
}

/* What is tracked grain by grain is what is measured from scratch, within the stated error. */
static void tracker_agrees_with_the_assembly(void **state)
{
    (void)state;
    const clast_envelope_kind kinds[2] = {CLAST_ENVELOPE_SURFACE_HULL,
                                          CLAST_ENVELOPE_GYRATION_SPHERE};
    for (int k = 0; k < 2; ++k) {
        clast_assembly all = {0};
        clast_assembly grown = {0};
        clast_envelope now[2];
        clx_envelope_tracker *tracker = NULL;
        clast_envelope_options options = clast_envelope_options_default();
        options.tolerance = 5e-3;
        heap_of(40, k == 0 ? CLAST_SHAPE_ELLIPSOID : CLAST_SHAPE_MESH, &all);
        CHECK_OK(clast_assembly_add_shape(&grown, &all.shape[0], NULL));
        CHECK_OK(clx_envelope_tracker_create(2, kinds, &options, &tracker));
        double before = 0.0;
        for (int32_t i = 0; i < all.n_grain; ++i) {
            CHECK_OK(clast_assembly_add_grain(&grown, 0, all.position[i], all.orientation[i],
                                              all.scale[i], 1.0));
            CHECK_OK(clx_envelope_tracker_add(tracker, &grown, i));
            CHECK_OK(clx_envelope_tracker_now(tracker, &grown, now));
            assert_true(now[0].low >= before); /* a hull never shrinks */
            before = now[0].low;
            if (i % 13 == 0 || i == 39) {
                const double exact = volume_of(&grown, CLAST_ENVELOPE_SURFACE_HULL);
                assert_true(now[0].low <= exact * (1.0 + 1e-12));
                assert_true(exact <= now[0].high * (1.0 + 1e-12));
                assert_true(fabs(now[0].volume - exact) <= now[0].error + 1e-12 * exact);
                CHECK_REL(now[1].volume, volume_of(&grown, CLAST_ENVELOPE_GYRATION_SPHERE), 1e-15);
            }
        }
        clx_envelope_tracker_destroy(tracker);
        clast_assembly_free(&grown);
        clast_assembly_free(&all);
    }
}

static clast_status make_envelopes(void *context)
{
    const clast_assembly *a = context;
    clast_envelope_options options = clast_envelope_options_default();
    clast_status status = CLAST_OK;
    clx_envelope_tracker *tracker = NULL;
    const clast_envelope_kind kinds[3] = {CLAST_ENVELOPE_SURFACE_HULL, CLAST_ENVELOPE_SPHERE_RAYS,
                                          CLAST_ENVELOPE_ENCLOSING_SPHERE};
    clast_envelope e[3];
    options.n_ray = 50;
    options.tolerance = 0.05;
    status = clx_envelope_tracker_create(3, kinds, &options, &tracker);
    for (int32_t i = 0; i < a->n_grain && status == CLAST_OK; ++i) {
        status = clx_envelope_tracker_add(tracker, a, i);
    }
    if (status == CLAST_OK) {
        status = clx_envelope_tracker_now(tracker, a, e);
    }
    clx_envelope_tracker_destroy(tracker);
    return status;
}

static void envelopes_survive_refused_memory(void **state)
{
    (void)state;
    clast_assembly a = {0};
    two_spheres(2.0, &a);
    support_refuse_each_allocation(make_envelopes, &a);
    clast_assembly_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tangent_spheres_have_every_envelope),
        cmocka_unit_test(gyration_counts_the_grains_own_extent),
        cmocka_unit_test(ellipsoid_is_its_own_hull_and_fits_its_long_axis),
        cmocka_unit_test(spheres_are_asked_for_by_name),
        cmocka_unit_test(wrap_rolls_a_ball_about_the_grains),
        cmocka_unit_test(wrap_of_a_curved_body_is_within_its_error),
        cmocka_unit_test(wrap_of_three_balls_is_what_samples_say),
        cmocka_unit_test(wrap_counts_closed_hollows),
        cmocka_unit_test(alpha_closes_the_neck_by_a_cylinder),
        cmocka_unit_test(alpha_of_boxes_is_exact),
        cmocka_unit_test(tracker_agrees_with_the_assembly),
        cmocka_unit_test(envelopes_survive_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
