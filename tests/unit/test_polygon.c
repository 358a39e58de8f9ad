/* Unit and property: polygons are cut to their true area, with every corner kept. */
#include "support.h"

#include "geom/polygon.h"
#include "math/rng.h"
#include "math/vec3.h"
#include <string.h>

enum { N_MAX = 2048 };

typedef struct {
    double vert[N_MAX][3];
    int32_t corner[N_MAX];
    int32_t tri[N_MAX][3];
    int32_t n;
    clx_polygon_kind kind;
    double area, true_area; ///< sum of the triangles' areas; of Newell's vector
} polygon;

static void put(polygon *p, double x, double y)
{
    v3_set(p->vert[p->n], x, y, 0.0);
    p->corner[p->n] = p->n;
    ++p->n;
}

/// Each polygon edge is in one triangle, turned the same way; inner edges cancel.
static void check_border(const polygon *p)
{
    int32_t n_border = 0;
    for (int32_t t = 0; t < p->n - 2; ++t) {
        for (int k = 0; k < 3; ++k) {
            n_border += p->tri[t][(k + 1) % 3] == (p->tri[t][k] + 1) % p->n;
        }
    }
    assert_int_equal(n_border, p->n);
}

static void cut(polygon *p)
{
    clx_polygon_cutter cutter = {0};
    double newell[3] = {0};
    double sum[3] = {0};
    CHECK_OK(
        clx_polygon_cut(&cutter, (const double(*)[3])p->vert, p->n, p->corner, p->tri, &p->kind));
    clx_polygon_cutter_free(&cutter);
    p->area = 0.0;
    for (int32_t t = 0; t < p->n - 2; ++t) {
        double u[3];
        double v[3];
        double n[3];
        v3_sub(u, p->vert[p->tri[t][1]], p->vert[p->tri[t][0]]);
        v3_sub(v, p->vert[p->tri[t][2]], p->vert[p->tri[t][0]]);
        v3_cross(n, u, v);
        p->area += 0.5 * v3_norm(n);
        v3_axpy(sum, sum, 0.5, n);
    }
    for (int32_t i = 1; i + 1 < p->n; ++i) {
        double u[3];
        double v[3];
        double n[3];
        v3_sub(u, p->vert[i], p->vert[0]);
        v3_sub(v, p->vert[i + 1], p->vert[0]);
        v3_cross(n, u, v);
        v3_axpy(newell, newell, 0.5, n);
    }
    p->true_area = v3_norm(newell);
    CHECK_ABS(v3_distance(sum, newell), 0.0, 1e-9 * (p->true_area + 1e-300));
    check_border(p);
}

/// Turns the plane polygon into space and starts it at another corner.
static void place(polygon *p, clx_rng *rng)
{
    double q[4];
    clx_rng_orientation(rng, q);
    for (int32_t i = 0; i < p->n; ++i) {
        q_rotate(p->vert[i], q, p->vert[i]);
    }
}

static void concave_quad_is_cut_inside(void **state)
{
    (void)state;
    static const double xy[4][2] = {{0, 0}, {2, 1}, {0, 4}, {0.5, 1}};
    for (int start = 0; start < 4; ++start) {
        polygon p = {0};
        for (int i = 0; i < 4; ++i) {
            put(&p, xy[(start + i) % 4][0], xy[(start + i) % 4][1]);
        }
        cut(&p);
        CHECK_REL(p.area, 3.0, 1e-14);
        assert_int_equal(p.kind == CLX_POLYGON_CROSSING, 0);
    }
}

static void corners_on_straight_edges_are_kept_without_slivers(void **state)
{
    (void)state;
    for (int start = 0; start < 8; ++start) {
        static const double xy[8][2] = {{0, 0}, {.3, 0}, {.7, 0}, {1, 0},
                                        {1, 1}, {.7, 1}, {.3, 1}, {0, 1}};
        polygon p = {0};
        for (int i = 0; i < 8; ++i) {
            put(&p, xy[(start + i) % 8][0], xy[(start + i) % 8][1]);
        }
        cut(&p);
        CHECK_REL(p.area, 1.0, 1e-14);
        for (int t = 0; t < 6; ++t) {
            double u[3];
            double v[3];
            double n[3];
            v3_sub(u, p.vert[p.tri[t][1]], p.vert[p.tri[t][0]]);
            v3_sub(v, p.vert[p.tri[t][2]], p.vert[p.tri[t][0]]);
            v3_cross(n, u, v);
            assert_true(n[2] > 1e-3);
        }
    }
}

static void ring_joined_by_a_bridge_has_its_own_area(void **state)
{
    (void)state;
    for (int n = 3; n < 40; ++n) {
        polygon p = {0};
        for (int i = 0; i <= n; ++i) {
            put(&p, cos(2.0 * CLAST_PI * (i % n) / n), sin(2.0 * CLAST_PI * (i % n) / n));
        }
        for (int i = n; i >= 0; --i) {
            put(&p, 0.4 * cos(2.0 * CLAST_PI * (i % n) / n),
                0.4 * sin(2.0 * CLAST_PI * (i % n) / n));
        }
        cut(&p);
        CHECK_REL(p.area, 0.84 * 0.5 * n * sin(2.0 * CLAST_PI / n), 1e-12);
        assert_int_equal(p.kind, CLX_POLYGON_EARS);
    }
}

static void comb_and_spiral_have_their_own_area(void **state)
{
    (void)state;
    static polygon comb;
    static polygon spiral;
    for (int i = 0; i < 200; ++i) {
        put(&comb, i, (i % 2) == 0 ? 0.0 : 50.0);
    }
    put(&comb, 199.0, -1.0);
    put(&comb, 0.0, -1.0);
    cut(&comb);
    CHECK_REL(comb.area, comb.true_area, 1e-12);
    for (int i = 0; i < 1000; ++i) {
        const double a = 0.05 * i;
        put(&spiral, (1.0 + a) * cos(a), (1.0 + a) * sin(a));
    }
    for (int i = 999; i >= 0; --i) {
        const double a = 0.05 * i;
        put(&spiral, (2.0 + a) * cos(a), (2.0 + a) * sin(a));
    }
    cut(&spiral);
    CHECK_REL(spiral.area, spiral.true_area, 1e-12);
    assert_int_equal(spiral.kind, CLX_POLYGON_EARS);
}

/* Property: any star-shaped polygon anywhere in space, rounded there. */
static void random_polygons_have_their_own_area(void **state)
{
    (void)state;
    for (uint64_t k = 0; k < 3000; ++k) {
        polygon p = {0};
        clx_rng rng = clx_rng_at(7, CLX_STREAM_TEST, k);
        const int n = 3 + (int)clx_rng_below(&rng, 30);
        for (int i = 0; i < n; ++i) {
            const double r = 0.05 + clx_rng_uniform(&rng);
            put(&p, r * cos(2.0 * CLAST_PI * i / n), r * sin(2.0 * CLAST_PI * i / n));
        }
        place(&p, &rng);
        cut(&p);
        CHECK_REL(p.area, p.true_area, 1e-12);
        assert_true(p.kind != CLX_POLYGON_CROSSING);
    }
}

static void crossing_polygon_is_named_so(void **state)
{
    (void)state;
    static const double xy[5][2] = {{0, 0}, {4, 4}, {4, 0}, {0, 4}, {-1, 2}};
    polygon p = {0};
    for (int i = 0; i < 5; ++i) {
        put(&p, xy[i][0], xy[i][1]);
    }
    cut(&p);
    assert_int_equal(p.kind, CLX_POLYGON_CROSSING);
}

static void polygon_wound_twice_is_named_crossing(void **state)
{
    (void)state;
    polygon star = {0};
    polygon twice = {0};
    polygon often = {0};
    for (int i = 0; i < 200; ++i) {
        put(&often, (i % 4 == 1 || i % 4 == 2) ? 1.0 : 0.0, i % 4 / 2);
    }
    cut(&often);
    assert_int_equal(often.kind, CLX_POLYGON_CROSSING);
    for (int i = 0; i < 10; ++i) {
        if (i < 5) {
            put(&star, cos(0.8 * CLAST_PI * i), sin(0.8 * CLAST_PI * i));
        }
        put(&twice, cos(0.4 * CLAST_PI * i), sin(0.4 * CLAST_PI * i));
    }
    cut(&star);
    cut(&twice);
    assert_int_equal(star.kind, CLX_POLYGON_CROSSING);
    assert_int_equal(twice.kind, CLX_POLYGON_CROSSING);
}

static void collinear_and_equal_corners_end(void **state)
{
    (void)state;
    for (int n = 3; n < 60; ++n) {
        polygon line = {0};
        polygon point = {0};
        for (int i = 0; i < n; ++i) {
            put(&line, i, 2.0 * i);
            put(&point, 1.0, 1.0);
        }
        cut(&line);
        cut(&point);
        assert_true(line.area < 1e-9 && point.area == 0.0);
    }
}

static void too_intricate_polygon_is_refused(void **state)
{
    (void)state;
    static double vert[60000][3];
    static int32_t corner[60000];
    static int32_t tri[60000][3];
    clx_polygon_cutter cutter = {.n_test = CLX_POLYGON_N_TEST - 1000000};
    clx_polygon_kind kind;
    for (int32_t i = 0; i < 60000; ++i) {
        corner[i] = i;
        v3_set(vert[i], i, 0.0, 0.0);
    }
    CHECK_STATUS(clx_polygon_cut(&cutter, (const double(*)[3])vert, 60000, corner, tri, &kind),
                 CLAST_E_LIMIT);
    clx_polygon_cutter_free(&cutter);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(concave_quad_is_cut_inside),
        cmocka_unit_test(corners_on_straight_edges_are_kept_without_slivers),
        cmocka_unit_test(ring_joined_by_a_bridge_has_its_own_area),
        cmocka_unit_test(comb_and_spiral_have_their_own_area),
        cmocka_unit_test(random_polygons_have_their_own_area),
        cmocka_unit_test(crossing_polygon_is_named_so),
        cmocka_unit_test(polygon_wound_twice_is_named_crossing),
        cmocka_unit_test(collinear_and_equal_corners_end),
        cmocka_unit_test(too_intricate_polygon_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
