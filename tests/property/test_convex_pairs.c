/* Property: gaps and overlaps of random convex pairs equal those of the plain twins. */
#include "support.h"

#include "convex/hull_round.h"
#include "gravel.h"
#include "math/vec3.h"
#include "ref_convex.h"
#include <string.h>

enum { N_CORE = 8 };

static clx_hull_core *cores[N_CORE];

static int make_cores(void **state)
{
    (void)state;
    for (int i = 0; i < N_CORE - 3; ++i) {
        const double axes[3] = {0.5, 0.4 - 0.02 * i, 0.3 - 0.04 * i};
        cores[i] = support_core(1, (uint64_t)i, 10 + 4 * i, axes);
    }
    cores[N_CORE - 3] = support_box_core(1.0, 0.8, 0.6);
    cores[N_CORE - 2] = support_core(2, 0, 20, (const double[3]){0.5, 0.03, 0.02});  // needle
    cores[N_CORE - 1] = support_core(2, 1, 20, (const double[3]){0.5, 0.45, 0.015}); // plate
    return 0;
}

static int free_cores(void **state)
{
    (void)state;
    for (int i = 0; i < N_CORE; ++i) {
        clx_hull_core_destroy(cores[i]);
    }
    return 0;
}

/* Two placed bodies with room for their rotations. */
typedef struct {
    clx_convex a, b;
    double rotation[2][9];
    clx_pair pair;
} scene;

static void random_rotation(clx_rng *rng, double rotation[9])
{
    double q[4], m[3][3];
    clx_rng_orientation(rng, q);
    q_matrix(m, q);
    for (int i = 0; i < 9; ++i) {
        rotation[i] = m[i / 3][i % 3];
    }
}

static void join(scene *s)
{
    s->pair.a = &s->a;
    s->pair.b = &s->b;
    s->pair.rotation_a = s->rotation[0];
    s->pair.rotation_b = s->rotation[1];
}

static double reference(const scene *s)
{
    const double origin[3] = {0.0, 0.0, 0.0};
    ref_polytope a = ref_polytope_of(&s->a, s->rotation[0], origin);
    ref_polytope b = ref_polytope_of(&s->b, s->rotation[1], s->pair.offset);
    const double gap = ref_polytope_gap(&a, &b);
    ref_polytope_free(&a);
    ref_polytope_free(&b);
    return gap;
}

/* The contact is what it says: its normal shows the gap. Where vertices are a tiny gap apart, the
   normal cannot be better than rounding over the gap. */
static void check_contact(const scene *s, const clx_contact *c, double tol)
{
    const double origin[3] = {0.0, 0.0, 0.0};
    if (c->gap > 0.0) {
        tol += 1e-15 / c->gap;
    }
    CHECK_ABS(v3_norm(c->normal), 1.0, 1e-12);
    if (s->a.kind == CLX_CONVEX_HULL && s->b.kind == CLX_CONVEX_HULL) {
        ref_polytope a = ref_polytope_of(&s->a, s->rotation[0], origin);
        ref_polytope b = ref_polytope_of(&s->b, s->rotation[1], s->pair.offset);
        CHECK_ABS(ref_gap_along(&a, &b, c->normal), c->gap, tol);
        ref_polytope_free(&a);
        ref_polytope_free(&b);
    }
}

/* Moves b along `line` until the gap is `wanted`, by the reference. */
static void push_to_gap(scene *s, const double line[3], double wanted)
{
    double low = -2.0;
    double high = 2.0;
    for (int i = 0; i < 60; ++i) {
        const double t = 0.5 * (low + high);
        clx_contact c;
        v3_scale(s->pair.offset, t, line);
        (void)clx_pair_contact(&s->pair, INFINITY, NULL, &c);
        if (t < 0.0 || c.gap < wanted) {
            low = t;
        } else {
            high = t;
        }
    }
}

/* a and b in random turns, at this gap along a random line. */
static void draw_poses(clx_rng *rng, double wanted, scene *s)
{
    double line[3];
    random_rotation(rng, s->rotation[0]);
    random_rotation(rng, s->rotation[1]);
    clx_rng_direction(rng, line);
    join(s);
    push_to_gap(s, line, wanted);
}

/* The gap of the pair is that of the plain twin, and its contact shows it. */
static void check_against_all_axes(const scene *s, int pair)
{
    clx_contact c;
    assert_true(clx_pair_contact(&s->pair, INFINITY, NULL, &c));
    const double expected = reference(s);
    if (!(fabs(c.gap - expected) <= 1e-13)) {
        print_message("pair %d: gap %.17g, reference %.17g\n", pair, c.gap, expected);
    }
    CHECK_ABS(c.gap, expected, 1e-11);
    check_contact(s, &c, 1e-11);
}

static void hull_pairs_equal_all_axes(void **state)
{
    (void)state;
    static const double gaps[] = {1e-9,  1e-6,  1e-3,  0.1,  0.3, -1e-9,
                                  -1e-6, -1e-4, -1e-2, -0.1, 0.0};
    for (uint64_t i = 0; i < 660; ++i) {
        clx_rng rng = clx_rng_at(7, CLX_STREAM_TEST, i);
        scene s;
        s.a = clx_convex_hull(cores[clx_rng_below(&rng, N_CORE)], 1.0);
        s.b = clx_convex_hull(cores[clx_rng_below(&rng, N_CORE)], i % 5 == 0 ? 1.0 / 11.0 : 1.0);
        draw_poses(&rng, gaps[i % 11], &s);
        check_against_all_axes(&s, (int)i);
    }
}

/* Naming the bodies the other way round, or turning the world, changes nothing but the rounding. */
static void contacts_ignore_order_and_frame(void **state)
{
    (void)state;
    static const double gaps[] = {1e-3, -1e-4, -1e-2, -0.1};
    for (uint64_t i = 0; i < 200; ++i) {
        clx_rng rng = clx_rng_at(12, CLX_STREAM_TEST, i);
        scene s;
        clx_contact c, d;
        double world[9], turned[2][9];
        s.a = clx_convex_hull(cores[clx_rng_below(&rng, N_CORE)], 1.0);
        s.b = i % 3 == 0 ? clx_convex_ellipsoid((const double[3]){0.5, 0.3, 0.2})
                         : clx_convex_hull(cores[clx_rng_below(&rng, N_CORE)], 0.7);
        draw_poses(&rng, gaps[i % 4], &s);
        assert_true(clx_pair_contact(&s.pair, INFINITY, NULL, &c));
        const double tol = i % 3 == 0 ? 1e-11 : 1e-14; // smooth: what both orders promise
        const double *r = s.pair.offset;
        const clx_pair swapped = {&s.b, &s.a, s.rotation[1], s.rotation[0], {-r[0], -r[1], -r[2]}};
        assert_true(clx_pair_contact(&swapped, INFINITY, NULL, &d));
        CHECK_ABS(d.gap, c.gap, tol);
        CHECK_ABS(v3_dot(d.normal, c.normal), -1.0, 1e-6);
        random_rotation(&rng, world);
        clx_pair moved = {&s.a, &s.b, turned[0], turned[1], {0.0, 0.0, 0.0}};
        for (int k = 0; k < 3; ++k) {
            moved.offset[k] = v3_dot(world + 3 * k, r);
            for (int j = 0; j < 3; ++j) {
                for (int b = 0; b < 2; ++b) {
                    turned[b][3 * k + j] = world[3 * k] * s.rotation[b][j] +
                                           world[3 * k + 1] * s.rotation[b][3 + j] +
                                           world[3 * k + 2] * s.rotation[b][6 + j];
                }
            }
        }
        assert_true(clx_pair_contact(&moved, INFINITY, NULL, &d));
        CHECK_ABS(d.gap, c.gap, tol);
    }
}

static const double UNTURNED[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};

/* Unturned boxes: face on face, edge on edge, vertex on vertex, one in the other, same place. */
static void aligned_boxes_have_their_closed_form(void **state)
{
    (void)state;
    const double half[3] = {0.5, 0.4, 0.3};
    static const double at[] = {-1.0, -0.5, 0.0, 0.25, 0.999999999, 1.0, 1.000000001, 1.5};
    for (int i = 0; i < 512; ++i) {
        scene s = {.a = clx_convex_hull(cores[N_CORE - 3], 1.0),
                   .b = clx_convex_hull(cores[N_CORE - 3], i % 2 == 0 ? 1.0 : 0.5)};
        clx_contact c;
        double out2 = 0.0;
        double inside = -INFINITY;
        for (int k = 0; k < 3; ++k) {
            const double reach = half[k] * (1.0 + s.b.scale);
            s.pair.offset[k] = reach * at[(i >> (3 * k)) & 7];
            const double d = fabs(s.pair.offset[k]) - reach;
            inside = fmax(inside, d);
            out2 += d > 0.0 ? d * d : 0.0;
        }
        for (int k = 0; k < 9; ++k) {
            s.rotation[0][k] = s.rotation[1][k] = UNTURNED[k];
        }
        join(&s);
        assert_true(clx_pair_contact(&s.pair, INFINITY, NULL, &c));
        CHECK_ABS(c.gap, inside > 0.0 ? sqrt(out2) : inside, 1e-14);
        check_contact(&s, &c, 1e-13);
    }
}

/* Poses that a random draw never meets: quarter turns, offsets along features, mirror pairs. */
static void tied_features_equal_all_axes(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 420; ++i) {
        clx_rng rng = clx_rng_at(8, CLX_STREAM_TEST, i);
        scene s;
        const clx_hull_core *core = cores[clx_rng_below(&rng, N_CORE)];
        s.a = clx_convex_hull(core, 1.0);
        s.b = clx_convex_hull(core, 1.0);
        random_rotation(&rng, s.rotation[0]);
        const double mirror = i % 3 == 0 ? 1.0 : -1.0; // same pose, or turned half about one axis
        for (int k = 0; k < 9; ++k) {
            s.rotation[1][k] = s.rotation[0][k] * (k % 3 == 2 ? 1.0 : mirror);
        }
        double x[3], y[3]; // offset so that two vertices meet, or along a face normal
        const double *v = core->vert[clx_rng_below(&rng, core->n_vert)];
        const double *w = core->vert[clx_rng_below(&rng, core->n_vert)];
        const double *n = core->face[clx_rng_below(&rng, core->n_face)].normal;
        for (int k = 0; k < 3; ++k) {
            x[k] = v3_dot(s.rotation[0] + 3 * k, i % 2 == 0 ? v : n);
            y[k] = v3_dot(s.rotation[1] + 3 * k, w);
        }
        v3_sub(s.pair.offset, x, i % 2 == 0 ? y : (const double[3]){0.0, 0.0, 0.0});
        v3_scale(s.pair.offset, i % 7 == 0 ? 0.0 : i % 4 == 0 ? 1.0 + 1e-9 : 1.0, s.pair.offset);
        join(&s);
        check_against_all_axes(&s, (int)i);
    }
}

/* Hull of 5 to 12 points of a lattice, not all in one plane. */
static clx_hull_core *lattice_core(clx_rng *rng)
{
    for (;;) {
        clx_hull_core *core = NULL;
        clast_mesh cloud = {0};
        CHECK_OK(clast_mesh_alloc((int32_t)(5 + clx_rng_below(rng, 8)), 0, &cloud));
        for (int32_t i = 0; i < 3 * cloud.n_vert; ++i) {
            cloud.vert[i / 3][i % 3] = (double)clx_rng_below(rng, 5) - 2.0;
        }
        const clast_status status = clx_hull_core_create(&cloud, &core);
        clast_mesh_free(&cloud);
        if (status == CLAST_OK) {
            return core;
        }
    }
}

/* One of the turns of a cube. */
static void quarter_turns(clx_rng *rng, double rotation[9])
{
    double m[3][3] = {{0.0}};
    const int first = (int)clx_rng_below(rng, 3);
    const int second = (first + 1 + (int)clx_rng_below(rng, 2)) % 3;
    m[0][first] = clx_rng_below(rng, 2) == 0 ? 1.0 : -1.0;
    m[1][second] = clx_rng_below(rng, 2) == 0 ? 1.0 : -1.0;
    v3_cross(m[2], m[0], m[1]);
    for (int i = 0; i < 9; ++i) {
        rotation[i] = m[i / 3][i % 3];
    }
}

/* Hulls of lattice points in lattice poses: parallel faces and edges, vertices that meet, origins
   on facets of the difference. Cold and remembered answers against all axes. */
static void lattice_hulls_equal_all_axes(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 60; ++i) {
        clx_rng rng = clx_rng_at(13, CLX_STREAM_TEST, i);
        clx_hull_core *core[2];
        scene s;
        clx_warm_start warm_start = {0};
        for (int k = 0; k < 2; ++k) {
            core[k] = lattice_core(&rng);
            quarter_turns(&rng, s.rotation[k]);
        }
        s.a = clx_convex_hull(core[0], 1.0);
        s.b = clx_convex_hull(core[1], 1.0);
        join(&s);
        for (int k = 0; k < 3; ++k) {
            s.pair.offset[k] = (double)clx_rng_below(&rng, 9) - 4.0;
        }
        for (int step = 0; step < 12; ++step) {
            clx_contact cold, warm;
            assert_true(clx_pair_contact(&s.pair, INFINITY, NULL, &cold));
            assert_true(clx_pair_contact(&s.pair, INFINITY, &warm_start, &warm));
            const double expected = reference(&s);
            CHECK_ABS(cold.gap, expected, 1e-13);
            CHECK_ABS(warm.gap, expected, 1e-13);
            check_contact(&s, &cold, 1e-12);
            check_contact(&s, &warm, 1e-12);
            s.pair.offset[clx_rng_below(&rng, 3)] += clx_rng_below(&rng, 2) == 0 ? 0.25 : -0.25;
            if (step % 4 == 3) {
                quarter_turns(&rng, s.rotation[1]);
            }
        }
        clx_hull_core_destroy(core[0]);
        clx_hull_core_destroy(core[1]);
    }
}

static clx_convex random_round(clx_rng *rng)
{
    double axes[3];
    for (int k = 0; k < 3; ++k) {
        axes[k] = 0.15 + 0.35 * clx_rng_uniform(rng);
    }
    return clx_rng_below(rng, 3) == 0 ? clx_convex_sphere(axes[0]) : clx_convex_ellipsoid(axes);
}

static void round_pairs_equal_all_directions(void **state)
{
    (void)state;
    static const double gaps[] = {1e-9, 1e-4, 0.1, 0.3, -1e-9, -1e-4, -1e-2, -0.1, -0.3, -2.0};
    for (uint64_t i = 0; i < 60; ++i) {
        clx_rng rng = clx_rng_at(9, CLX_STREAM_TEST, i);
        scene s;
        clx_contact c;
        s.a = random_round(&rng);
        s.b = random_round(&rng);
        draw_poses(&rng, gaps[i % 10], &s);
        assert_true(clx_pair_contact(&s.pair, INFINITY, NULL, &c));
        CHECK_ABS(c.gap, ref_ellipsoid_gap(&s.pair), 1e-11);
        check_contact(&s, &c, 1e-11);
    }
}

/* How far a point (relative to a's position) is outside a shape grown by its rounding. */
static double outside(const clx_convex *shape, const double rotation[9], const double x[3])
{
    const double own[3] = {rotation[0] * x[0] + rotation[3] * x[1] + rotation[6] * x[2],
                           rotation[1] * x[0] + rotation[4] * x[1] + rotation[7] * x[2],
                           rotation[2] * x[0] + rotation[5] * x[1] + rotation[8] * x[2]};
    double worst = -INFINITY;
    if (shape->kind == CLX_CONVEX_SPHERE) {
        return v3_norm(own) - shape->round;
    }
    if (shape->kind == CLX_CONVEX_ELLIPSOID) {
        const double *s = shape->semi_axes;
        const double unit[3] = {own[0] / s[0], own[1] / s[1], own[2] / s[2]};
        return (v3_norm(unit) - 1.0) * shape->inner;
    }
    for (int32_t f = 0; f < shape->core->n_face; ++f) {
        worst = fmax(worst, v3_dot(shape->core->face[f].normal, own) -
                                shape->scale * shape->core->face[f].offset);
    }
    return worst;
}

/* A hull with a sphere or an ellipsoid, at any gap and depth, in either order. The normal shows
   that the gap is no less; apart, the two witness points show that it is no more; in overlap no
   other direction of a search shows less of it. */
static void round_and_hull_equal_all_directions(void **state)
{
    (void)state;
    static const double gaps[] = {1e-9, 1e-4, 0.1, 0.3, -1e-9, -1e-4, -1e-2, -0.1, -0.2, -2.0};
    for (uint64_t i = 0; i < 50; ++i) {
        clx_rng rng = clx_rng_at(10, CLX_STREAM_TEST, i);
        scene s;
        clx_contact c;
        s.a = clx_convex_hull(cores[clx_rng_below(&rng, N_CORE)], 1.0);
        s.b = random_round(&rng);
        if (i % 2 == 0) {
            const clx_convex swap = s.a;
            s.a = s.b;
            s.b = swap;
        }
        draw_poses(&rng, gaps[i % 10], &s);
        assert_true(clx_pair_contact(&s.pair, INFINITY, NULL, &c));
        const double m[3] = {-c.normal[0], -c.normal[1], -c.normal[2]};
        CHECK_ABS(ref_support_along(&s.pair, m), c.gap, 1e-11);
        assert_true(ref_support_gap(&s.pair) <= c.gap + 1e-11);
        if (c.gap > 0.0) {
            double x[3];
            v3_axpy(x, c.point, 0.5 * c.gap, c.normal);
            assert_true(outside(&s.a, s.rotation[0], x) <= 1e-11);
            v3_axpy(x, c.point, -0.5 * c.gap, c.normal);
            v3_sub(x, x, s.pair.offset);
            assert_true(outside(&s.b, s.rotation[1], x) <= 1e-11);
        }
    }
}

/* From below by the supports along the normal, and no other normal that is known shows more; two
 * points of the bodies are where it says. */
static void check_by_bounds(const scene *s, const clx_contact *bare, const clx_contact *cold)
{
    clx_contact c = *bare;
    const double away[3] = {-c.normal[0], -c.normal[1], -c.normal[2]};
    const double other[3] = {-cold->normal[0], -cold->normal[1], -cold->normal[2]};
    double x[3];
    c.gap -= s->a.round + s->b.round;
    v3_axpy(c.point, c.point, 0.5 * (s->b.round - s->a.round), c.normal);
    CHECK_ABS(v3_norm(c.normal), 1.0, 1e-13);
    CHECK_ABS(c.gap, cold->gap, 1e-10);
    CHECK_ABS(ref_support_along(&s->pair, away), c.gap, 1e-13);
    assert_true(ref_support_along(&s->pair, other) <= c.gap + 1e-12);
    v3_axpy(x, c.point, 0.5 * c.gap, c.normal);
    assert_true(outside(&s->a, s->rotation[0], x) <= 1e-9);
    v3_axpy(x, c.point, -0.5 * c.gap, c.normal);
    v3_sub(x, x, s->pair.offset);
    assert_true(outside(&s->b, s->rotation[1], x) <= 1e-9);
}

/* b slides aside and turns about z of the world. */
static void move_on(clx_rng *rng, const double normal[3], double jump, scene *s)
{
    double slide[3];
    double turned[9];
    clx_rng_direction(rng, slide);
    v3_axpy(slide, slide, -v3_dot(slide, normal), normal);
    v3_axpy(s->pair.offset, s->pair.offset, jump, slide);
    for (int c = 0; c < 3; ++c) {
        turned[c] = cos(jump) * s->rotation[1][c] - sin(jump) * s->rotation[1][c + 3];
        turned[c + 3] = sin(jump) * s->rotation[1][c] + cos(jump) * s->rotation[1][c + 3];
        turned[c + 6] = s->rotation[1][c + 6];
    }
    memcpy(s->rotation[1], turned, sizeof turned);
}

/* A hull and a round body on the way past each other: gaps by the hull's feature are proved without
 * it, with all three features, apart and in shallow overlap. GJK's and EPA's own are some 1e-11 off
 * for smooth bodies. */
static void hulls_with_round_bodies_are_proved_by_bounds(void **state)
{
    (void)state;
    static const double gaps[] = {1e-9, 1e-6, 1e-3, 0.1, -1e-9, -1e-6, -1e-4, -1e-3};
    int n_feature[4] = {0};
    int n_open = 0;
    for (uint64_t i = 0; i < 320; ++i) {
        clx_rng rng = clx_rng_at(21, CLX_STREAM_TEST, i);
        clx_warm_start warm_start = {0};
        scene s;
        s.a = clx_convex_hull(cores[clx_rng_below(&rng, N_CORE)], i % 5 == 0 ? 0.2 : 1.0);
        s.b = random_round(&rng);
        if (i % 2 == 0) {
            const clx_convex swap = s.a;
            s.a = s.b;
            s.b = swap;
        }
        draw_poses(&rng, gaps[i % 8], &s);
        for (int step = 0; step < 12; ++step) {
            clx_contact cold, warm;
            assert_true(clx_pair_contact(&s.pair, INFINITY, NULL, &cold));
            if (clx_hull_round_contact(&s.pair, &warm_start, &warm)) {
                ++n_feature[warm_start.n];
                check_by_bounds(&s, &warm, &cold);
            } else {
                n_open += cold.gap > -1e-3 ? 1 : 0;
            }
            assert_true(clx_pair_contact(&s.pair, INFINITY, &warm_start, &warm));
            CHECK_ABS(warm.gap, cold.gap, 1e-9);
            for (int k = 0; k < 3;
                 ++k) { /* of two normals of one gap the points differ by its root */
                CHECK_ABS(warm.normal[k], cold.normal[k], 1e-4);
            }
            move_on(&rng, warm.normal, step % 3 == 0 ? 0.02 : 1e-4, &s);
        }
    }
    assert_true(n_feature[1] > 100 && n_feature[2] > 100 && n_feature[3] > 100);
    assert_true(n_open < 40); /* of 3840: flat bodies that pierce each other's planes */
}

/* Apart, GJK's own answer to a hull and a smooth body is the feature's: it ends among slivers,
 * whose rounding must not be taken for a nearer point, nor for overlap (once in 5000 pairs, up to
 * 0.2 of a size off). */
static void cold_and_feature_agree_apart(void **state)
{
    (void)state;
    int n = 0;
    for (uint64_t i = 0; i < 20000; ++i) {
        clx_rng rng = clx_rng_at(22, CLX_STREAM_TEST, i);
        clx_warm_start warm_start = {0};
        clx_contact cold, feature;
        scene s;
        s.a = clx_convex_hull(cores[clx_rng_below(&rng, N_CORE)], 1.0);
        s.b = clx_convex_ellipsoid((const double[3]){0.6, 0.4, 0.2});
        draw_poses(&rng, 0.1 + 0.1 * (double)(i % 10), &s);
        if (clx_hull_round_contact(&s.pair, &warm_start, &feature)) {
            assert_true(clx_pair_contact(&s.pair, INFINITY, NULL, &cold));
            CHECK_ABS(cold.gap, feature.gap, 1e-10);
            ++n;
        }
    }
    assert_true(n > 19000);
}

/* Over a box's faces, edges and corners the gap to a ball is in closed form, also where the foot is
 * just on the border of two features; warm starts of other places, or that never were, change
 * nothing.
 */
static void ball_at_a_box_has_its_closed_form(void **state)
{
    (void)state;
    const double half[3] = {0.5, 0.4, 0.3};
    static const double at[] = {-1.5, -1.0, -0.5, 0.0, 0.999999999, 1.0, 1.000000001, 1.2};
    clx_warm_start warm_start = {0};
    for (int i = 0; i < 512; ++i) {
        scene s = {.a = clx_convex_hull(cores[N_CORE - 3], 1.0), .b = clx_convex_sphere(0.25)};
        clx_contact c;
        double out2 = 0.0;
        double inside = -INFINITY;
        for (int k = 0; k < 3; ++k) {
            s.pair.offset[k] = half[k] * at[(i >> (3 * k)) & 7];
            const double d = fabs(s.pair.offset[k]) - half[k];
            inside = fmax(inside, d);
            out2 += d > 0.0 ? d * d : 0.0;
        }
        for (int k = 0; k < 9; ++k) {
            s.rotation[0][k] = s.rotation[1][k] = UNTURNED[k];
        }
        join(&s);
        if (i % 16 == 15) {
            memset(&warm_start, 0xff, sizeof warm_start);
            warm_start.kind = 0;
        }
        assert_true(clx_pair_contact(&s.pair, INFINITY, &warm_start, &c));
        CHECK_ABS(c.gap, (inside > 0.0 ? sqrt(out2) : inside) - 0.25, 1e-14);
        assert_true(!(sqrt(out2) > 0.1) || (warm_start.n >= 1 && warm_start.n <= 3));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hull_pairs_equal_all_axes),
        cmocka_unit_test(contacts_ignore_order_and_frame),
        cmocka_unit_test(aligned_boxes_have_their_closed_form),
        cmocka_unit_test(tied_features_equal_all_axes),
        cmocka_unit_test(lattice_hulls_equal_all_axes),
        cmocka_unit_test(round_pairs_equal_all_directions),
        cmocka_unit_test(round_and_hull_equal_all_directions),
        cmocka_unit_test(hulls_with_round_bodies_are_proved_by_bounds),
        cmocka_unit_test(cold_and_feature_agree_apart),
        cmocka_unit_test(ball_at_a_box_has_its_closed_form),
    };
    return cmocka_run_group_tests(tests, make_cores, free_cores);
}
