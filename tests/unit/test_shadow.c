/* Unit: outlines and least rectangles of a hull's shadows against brute force. */
#include "support.h"

#include "base/alloc.h"
#include "geom/chords.h"
#include "geom/hull_body.h"
#include "math/rng.h"
#include "math/vec3.h"

/* Points on an ellipsoid with axes 3 : 2 : 1 (hull: all of them), or the corners of a box. */
static void make_points(uint64_t seed, int32_t n, clast_mesh *points)
{
    const double axes[3] = {3.0, 2.0, 1.0};
    CHECK_OK(clast_mesh_alloc(n, 0, points));
    for (int32_t i = 0; i < n; ++i) {
        clx_rng rng = clx_rng_at(seed, CLX_STREAM_TEST, (uint64_t)i);
        clx_rng_direction(&rng, points->vert[i]);
        for (int k = 0; k < 3; ++k) {
            points->vert[i][k] *= axes[k];
        }
    }
}

/* Area of the shadow's outline by the shoelace formula: positive when it turns left. */
static double outline_area(const clx_shadow *s)
{
    double twice = 0.0;
    for (int32_t i = 0; i < s->n; ++i) {
        const double *p = s->point[i];
        const double *q = s->point[(i + 1) % s->n];
        twice += p[0] * q[1] - p[1] * q[0];
    }
    return 0.5 * twice;
}

static double width(const clx_shadow *s, const double d[2])
{
    double low = (double)INFINITY;
    double high = -(double)INFINITY;
    for (int32_t i = 0; i < s->n; ++i) {
        const double r = s->point[i][0] * d[0] + s->point[i][1] * d[1];
        low = fmin(low, r);
        high = fmax(high, r);
    }
    return high - low;
}

/* Every edge of the outline as a side. */
static double brute_rectangle(const clx_shadow *s)
{
    double best = (double)INFINITY;
    for (int32_t i = 0; i < s->n; ++i) {
        const double *p = s->point[i];
        const double *q = s->point[(i + 1) % s->n];
        const double length = hypot(q[0] - p[0], q[1] - p[1]);
        if (length > 1e-12) {
            const double d[2] = {(q[0] - p[0]) / length, (q[1] - p[1]) / length};
            const double across[2] = {-d[1], d[0]};
            best = fmin(best, width(s, d) * width(s, across));
        }
    }
    return best;
}

static void check_shadow(const clx_hull_body *body, const double direction[3], clx_shadow *s)
{
    double side[2];
    double edge[2];
    clx_shadow_cast(body, direction, s);
    CHECK_REL(outline_area(s), clx_shadow_area(body, direction), 1e-12);
    assert_true(clx_shadow_rectangle(s, 1e-12, (double)INFINITY, CLX_ALL_ARCS, side, edge));
    CHECK_REL(edge[0] * edge[1], brute_rectangle(s), 1e-12);
    CHECK_REL(edge[0], width(s, side), 1e-14);
    CHECK_ABS(hypot(side[0], side[1]), 1.0, 1e-14);
    /* A limit below the area: no rectangle; just above: the same one. */
    const double area = edge[0] * edge[1];
    assert_false(clx_shadow_rectangle(s, 1e-12, 0.999 * area, CLX_ALL_ARCS, side, edge));
    assert_true(clx_shadow_rectangle(s, 1e-12, 1.001 * area, CLX_ALL_ARCS, side, edge));
}

static void check_body(const clast_mesh *points)
{
    clx_hull_body body = {0};
    clx_shadow shadow = {0};
    CHECK_OK(clx_hull_body_make(points, &body));
    CHECK_OK(clx_shadow_alloc(&body, &shadow));
    for (int32_t i = 0; i < 200; ++i) {
        double direction[3];
        clx_rng rng = clx_rng_at(77, CLX_STREAM_TEST, (uint64_t)i);
        clx_rng_direction(&rng, direction);
        check_shadow(&body, direction, &shadow);
    }
    for (int32_t f = 0; f < body.n_face; ++f) {
        check_shadow(&body, body.normal[f], &shadow);
    }
    clx_shadow_free(&shadow);
    clx_hull_body_free(&body);
}

static void shadows_equal_brute_force(void **state)
{
    (void)state;
    for (uint64_t seed = 1; seed <= 8; ++seed) {
        clast_mesh points = {0};
        make_points(seed, 4 + (int32_t)(seed * seed * 3), &points);
        check_body(&points);
        clast_mesh_free(&points);
    }
    clast_mesh many = {0}; /* outlines of some 100 corners: calipers, not every edge */
    make_points(9, 1500, &many);
    check_body(&many);
    clast_mesh_free(&many);
}

/* Faces upright to rounding, coplanar triangles, corners on one line. */
static void shadows_of_regular_bodies_equal_brute_force(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    double q[4];
    for (uint64_t turn = 0; turn < 4; ++turn) {
        CHECK_OK(clast_mesh_box(1.0, 2.0, 3.0, &mesh));
        clx_rng rng = clx_rng_at(turn, CLX_STREAM_TEST, 0);
        clx_rng_orientation(&rng, q);
        if (turn > 0) {
            clast_mesh_transform(&mesh, 1.0, q, (double[3]){0});
        }
        check_body(&mesh);
        clast_mesh_free(&mesh);
        const double axes[3] = {1.0, 1.0, 1.0};
        CHECK_OK(clast_mesh_ellipsoid(axes, 3, &mesh));
        check_body(&mesh);
        clast_mesh_free(&mesh);
    }
}

/* Eight directions at once give the bits of each alone. */
static void directions_at_once_equal_one_by_one(void **state)
{
    (void)state;
    clast_mesh points = {0};
    clx_hull_body body = {0};
    double direction[CLX_DIRECTIONS][3];
    double widths[CLX_DIRECTIONS];
    double areas[CLX_DIRECTIONS];
    make_points(5, 150, &points);
    CHECK_OK(clx_hull_body_make(&points, &body));
    for (int i = 0; i < CLX_DIRECTIONS; ++i) {
        clx_rng rng = clx_rng_at(9, CLX_STREAM_TEST, (uint64_t)i);
        clx_rng_direction(&rng, direction[i]);
    }
    clx_hull_body_widths(&body, (const double(*)[3])direction, widths);
    clx_shadow_areas(&body, (const double(*)[3])direction, areas);
    for (int i = 0; i < CLX_DIRECTIONS; ++i) {
        assert_true(widths[i] == clx_hull_body_width(&body, direction[i]));
        assert_true(areas[i] == clx_shadow_area(&body, direction[i]));
    }
    clx_hull_body_free(&body);
    clast_mesh_free(&points);
}

/* Between two directions at right angles to normals a shadow is a cosine, so a least one is at
   right angles to two of them. A pattern search alone stopped 1e-9 beside it. */
static void a_least_shadow_is_along_two_faces(void **state)
{
    (void)state;
    double frame[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    for (uint64_t seed = 0; seed < 8; ++seed) {
        clast_mesh points = {0};
        clx_hull_body body = {0};
        clx_face_shadows faces = {0};
        double least = 0.0;
        double greatest = 0.0;
        double direction[3];
        double nearest = (double)INFINITY;
        make_points(seed, 8 + 8 * (int32_t)seed, &points);
        CHECK_OK(clx_hull_body_make(&points, &body));
        CHECK_OK(clx_face_shadows_make(&body, &faces));
        CHECK_OK(clx_shadow_extremes(&body, &faces, frame, &least, &greatest, direction));
        for (int32_t f = 0; f < body.n_face; ++f) {
            for (int32_t g = 0; g < f; ++g) {
                double along[3];
                v3_cross(along, body.normal[f], body.normal[g]);
                if (v3_unit(along, along)) {
                    nearest = fmin(nearest, fabs(clx_shadow_area(&body, along) - least));
                }
            }
        }
        assert_true(nearest < 1e-14 * greatest);
        clx_face_shadows_free(&faces);
        clx_hull_body_free(&body);
        clast_mesh_free(&points);
    }
}

/* The arcs left open by chords hold the least rectangle, to the last bit, and are not all. */
static void arcs_hold_the_least_rectangle(void **state)
{
    (void)state;
    clast_mesh points = {0};
    clx_hull_body body = {0};
    clx_chords *chords = NULL;
    clx_shadow shadow = {0};
    int32_t n_closed = 0;
    int32_t n_larger = 0;
    make_points(11, 162, &points);
    CHECK_OK(clx_hull_body_make(&points, &body));
    CHECK_OK(clx_chords_make(&body, &chords));
    CHECK_OK(clx_shadow_alloc(&body, &shadow));
    for (int32_t f = 0; f < body.n_face; ++f) {
        double all[4];
        double some[4];
        clx_shadow_cast(&body, body.normal[f], &shadow);
        assert_true(
            clx_shadow_rectangle(&shadow, 1e-12, (double)INFINITY, CLX_ALL_ARCS, all, all + 2));
        const double area = all[2] * all[3];
        const uint32_t arcs = clx_chords_arcs(chords, shadow.u, shadow.v, area);
        assert_true(clx_shadow_rectangle(&shadow, 1e-12, area, arcs, some, some + 2));
        assert_memory_equal(some, all, sizeof all);
        n_larger += clx_chords_arcs(chords, shadow.u, shadow.v, 0.97 * area) == 0;
        n_closed += (arcs & 0xffU) != 0xffU;
    }
    assert_int_equal(n_closed, body.n_face);
    assert_true(n_larger > body.n_face / 2); /* 3 % less is seen to be too little by most */
    clx_shadow_free(&shadow);
    clx_free(chords);
    clx_hull_body_free(&body);
    clast_mesh_free(&points);
}

/* Single precision only says where to look: no area is farther off than the doubt, of large grains
   and small ones. */
static void shadows_in_single_precision_are_within_their_doubt(void **state)
{
    (void)state;
    for (int32_t i = 0; i < 3; ++i) {
        clast_mesh points = {0};
        clx_hull_body body = {0};
        clx_face_shadows faces = {0};
        make_points(5, 200, &points);
        clast_mesh_transform(&points, pow(1e30, i - 1), (double[4]){1.0, 0.0, 0.0, 0.0},
                             (double[3]){0});
        CHECK_OK(clx_hull_body_make(&points, &body));
        CHECK_OK(clx_face_shadows_make(&body, &faces));
        assert_int_equal(faces.n, body.n_face);
        assert_true(faces.doubt < 1e-4 * body.surface);
        for (int32_t f = 0; f < faces.n; ++f) {
            const double area = clx_shadow_area(&body, body.normal[faces.face[f]]);
            CHECK_ABS(faces.area[f], area, faces.doubt);
        }
        clx_face_shadows_free(&faces);
        clx_hull_body_free(&body);
        clast_mesh_free(&points);
    }
}

static void check_chords_save_work_only(const clast_mesh *points)
{
    double frame[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    clx_hull_body body = {0};
    clx_chords *chords = NULL;
    clx_face_shadows faces = {0};
    clx_feret with = {0};
    clx_feret without = {0};
    clx_box box[2];
    CHECK_OK(clx_hull_body_make(points, &body));
    CHECK_OK(clx_chords_make(&body, &chords));
    assert_non_null(chords);
    CHECK_OK(clx_hull_body_feret(&body, chords, &with));
    CHECK_OK(clx_hull_body_feret(&body, NULL, &without));
    assert_int_equal(with.n_longest, without.n_longest);
    assert_true(with.longest == without.longest && with.shortest == without.shortest);
    assert_memory_equal(with.longest_axis, without.longest_axis,
                        (size_t)with.n_longest * sizeof with.longest_axis[0]);
    assert_memory_equal(with.shortest_axis, without.shortest_axis, sizeof with.shortest_axis);
    CHECK_OK(clx_face_shadows_make(&body, &faces));
    CHECK_OK(clx_hull_body_least_box(&body, chords, &faces, frame, &box[0]));
    CHECK_OK(clx_hull_body_least_box(&body, NULL, &faces, frame, &box[1]));
    assert_memory_equal(box[0].edge, box[1].edge, sizeof box[0].edge);
    clx_free(chords);
    clx_face_shadows_free(&faces);
    clx_hull_body_free(&body);
}

/* Calipers and least boxes without chords, which look at every edge and every face, have the same
   bits: of points at random, and of a symmetric body with many equal ones. */
static void chords_save_work_only(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 20; ++seed) {
        clast_mesh points = {0};
        make_points(seed, 70 + 20 * (int32_t)seed, &points);
        check_chords_save_work_only(&points);
        clast_mesh_free(&points);
    }
    for (int32_t i = 0; i < 4; ++i) {
        clast_mesh ball = {0};
        CHECK_OK(clast_mesh_ellipsoid((double[3]){1.0, 1.0 - 0.1 * i, 1.0 - 0.2 * i}, 2, &ball));
        check_chords_save_work_only(&ball);
        clast_mesh_free(&ball);
    }
}

/* Hundreds of faces, most of which need no shadow: none of those left out has a smaller box. */
static void the_least_box_is_no_larger_than_on_any_face(void **state)
{
    (void)state;
    double frame[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    for (uint64_t seed = 0; seed < 6; ++seed) {
        clast_mesh points = {0};
        clx_hull_body body = {0};
        clx_chords *chords = NULL;
        clx_face_shadows faces = {0};
        clx_shadow shadow = {0};
        clx_box box;
        double least = (double)INFINITY;
        make_points(seed, 70 + 60 * (int32_t)seed, &points);
        CHECK_OK(clx_hull_body_make(&points, &body));
        CHECK_OK(clx_chords_make(&body, &chords));
        assert_non_null(chords);
        CHECK_OK(clx_face_shadows_make(&body, &faces));
        CHECK_OK(clx_shadow_alloc(&body, &shadow));
        CHECK_OK(clx_hull_body_least_box(&body, chords, &faces, frame, &box));
        for (int32_t f = 0; f < body.n_face; ++f) {
            clx_shadow_cast(&body, body.normal[f], &shadow);
            least =
                fmin(least, clx_hull_body_width(&body, body.normal[f]) * brute_rectangle(&shadow));
        }
        assert_true(box.edge[0] * box.edge[1] * box.edge[2] <= (1.0 + 1e-12) * least);
        clx_shadow_free(&shadow);
        clx_free(chords);
        clx_face_shadows_free(&faces);
        clx_hull_body_free(&body);
        clast_mesh_free(&points);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shadows_equal_brute_force),
        cmocka_unit_test(shadows_of_regular_bodies_equal_brute_force),
        cmocka_unit_test(directions_at_once_equal_one_by_one),
        cmocka_unit_test(a_least_shadow_is_along_two_faces),
        cmocka_unit_test(arcs_hold_the_least_rectangle),
        cmocka_unit_test(shadows_in_single_precision_are_within_their_doubt),
        cmocka_unit_test(chords_save_work_only),
        cmocka_unit_test(the_least_box_is_no_larger_than_on_any_face),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
