/* Unit: bodies before walls of triangles. */
#include "support.h"

#include "convex/wall_mesh.h"
#include "gravel.h"
#include "math/vec3.h"
#include <clast/mesh.h>
#include <string.h>

enum { MOST_NEAR = 256, MOST_OWNERS = 16 };

/* Pushes whose normals are closer than this cosine are one. */
static const double same_push = 0.9;

/* Where a body meets a wall. */
typedef struct {
    clx_contact contact; /* point relative to the body's position */
    int32_t tri;
} wall_contact;

/* Inserts a contact in order of depth; none stays whose normal is that of a deeper one. */
static int32_t insert(wall_contact *list, int32_t n, int32_t cap, const wall_contact *one)
{
    int32_t at = 0;
    while (at < n && list[at].contact.gap <= one->contact.gap) {
        if (v3_dot(list[at].contact.normal, one->contact.normal) > same_push) {
            return n;
        }
        ++at;
    }
    int32_t kept = at;
    for (int32_t i = at; i < n; ++i) { /* those that it stands for go */
        if (v3_dot(list[i].contact.normal, one->contact.normal) <= same_push) {
            list[kept++] = list[i];
        }
    }
    n = kept < cap ? kept + 1 : cap;
    for (int32_t i = n - 1; i > at; --i) {
        list[i] = list[i - 1];
    }
    if (at < cap) {
        list[at] = *one;
    }
    return n;
}

/* All contacts of a body with the wall whose gap is at most max_gap, deepest first: one for each
   direction of push (25 degrees), at most `cap`. Returns how many. */
static int32_t wall_contacts(const clx_wall_mesh *wall, const clx_placed *body, double max_gap,
                             int32_t cap, wall_contact *contact)
{
    int32_t tri[MOST_NEAR];
    int32_t n = 0;
    clx_contact owner[MOST_OWNERS];
    int32_t n_owner = 0;
    bool has_orphans = false;
    const int32_t n_near = clx_wall_mesh_near(
        wall, body->position, body->shape->bounding_radius + max_gap, MOST_NEAR, tri);
    /* more than fit: every triangle is tested */
    const int32_t n_ask = n_near <= MOST_NEAR ? n_near : wall->n_tri;
    for (int pass = 0; pass < (has_orphans ? 2 : 1); ++pass) {
        for (int32_t i = 0; i < n_ask; ++i) {
            wall_contact one = {.tri = n_near <= MOST_NEAR ? tri[i] : i};
            clx_contact least;
            const clx_wall_triangle *t = &wall->tri[one.tri];
            if (!clx_triangle_contact(t, body, max_gap, NULL, &least)) {
                continue;
            }
            const bool owns = clx_triangle_owns(t, body, &least);
            one.contact = least;
            has_orphans = has_orphans || (!owns && least.gap < 0.0);
            if (pass == 0
                    ? owns
                    : !owns && least.gap < 0.0 &&
                          clx_triangle_face_acts(t, body, &least, n_owner, owner, &one.contact)) {
                n = insert(contact, n, cap, &one);
            }
        }
        for (; pass == 0 && n_owner < n && n_owner < MOST_OWNERS &&
               contact[n_owner].contact.gap < 0.0;
             ++n_owner) {
            owner[n_owner] = contact[n_owner].contact;
        }
    }
    return n;
}

/* A floor z = 0 of 2 n^2 triangles on the square |x|, |y| <= 2. */
static void make_floor(int n, clast_mesh *mesh)
{
    CHECK_OK(clast_mesh_alloc((n + 1) * (n + 1), 2 * n * n, mesh));
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
            v3_set(mesh->vert[i * (n + 1) + j], -2.0 + 4.0 * i / n, -2.0 + 4.0 * j / n, 0.0);
        }
    }
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const int32_t v = i * (n + 1) + j;
            const int32_t t[2][3] = {{v, v + n + 1, v + n + 2}, {v, v + n + 2, v + 1}};
            for (int k = 0; k < 6; ++k) {
                mesh->tri[2 * (i * n + j) + k / 3][k % 3] = t[k / 3][k % 3];
            }
        }
    }
}

static void random_rotation(clx_rng *rng, double rotation[9])
{
    double q[4], m[3][3];
    clx_rng_orientation(rng, q);
    q_matrix(m, q);
    for (int i = 0; i < 9; ++i) {
        rotation[i] = m[i / 3][i % 3];
    }
}

/* Bodies of every kind on a floor of triangles, from above and from below: the plane's answer. */
static void floor_of_triangles_is_a_plane(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clx_wall_mesh *wall = NULL;
    clx_hull_core *gravel = support_gravel_core(4, 0, 60);
    const clx_convex shapes[3] = {clx_convex_hull(gravel, 1.0), clx_convex_sphere(0.4),
                                  clx_convex_ellipsoid((const double[3]){0.6, 0.4, 0.3})};
    make_floor(7, &mesh);
    CHECK_OK(clx_wall_mesh_create(&mesh, &wall));
    for (uint64_t i = 0; i < 240; ++i) {
        clx_rng rng = clx_rng_at(41, CLX_STREAM_TEST, i);
        double rotation[9];
        clx_placed body = {&shapes[i % 3], rotation, {0.0, 0.0, 0.0}};
        clx_contact flat;
        wall_contact met[4];
        random_rotation(&rng, rotation);
        const double side = i % 2 == 0 ? 1.0 : -1.0;
        const double plane[4] = {0.0, 0.0, side, 0.0};
        clx_plane_contact(&body, plane, NULL, &flat);
        const double gap = i % 5 == 0 ? 1e-3 : -1e-4 * (double)(1 + i % 7);
        v3_set(body.position, clx_rng_uniform(&rng) - 0.5, clx_rng_uniform(&rng) - 0.5,
               side * (gap - flat.gap));
        clx_plane_contact(&body, plane, NULL, &flat);
        CHECK_ABS(flat.gap, gap, 1e-14);
        assert_int_equal(wall_contacts(wall, &body, 0.01, 4, met), 1);
        CHECK_ABS(met[0].contact.gap, gap, 1e-11);
        CHECK_ABS(met[0].contact.normal[2], side, 1e-10);
        for (int k = 0; k < 3; ++k) {
            CHECK_ABS(met[0].contact.point[k], flat.point[k], 1e-5);
        }
        v3_set(body.position, 0.0, 0.0, side * 1.5);
        assert_int_equal(wall_contacts(wall, &body, 0.01, 4, met), 0);
    }
    clx_wall_mesh_destroy(wall);
    clx_hull_core_destroy(gravel);
    clast_mesh_free(&mesh);
}

/* A ball in a box's corner meets its three walls; on a box's outer edge it meets the edge once. */
static void box_pushes_from_each_wall(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clx_wall_mesh *wall = NULL;
    const clx_convex ball = clx_convex_sphere(0.3);
    static const double unturned[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    CHECK_OK(clast_mesh_box(1.0, 2.0, 3.0, &mesh));
    CHECK_OK(clx_wall_mesh_create(&mesh, &wall));
    clx_placed body = {&ball, unturned, {0.29, 0.28, 0.27}};
    wall_contact met[8];
    assert_int_equal(wall_contacts(wall, &body, 0.0, 8, met), 3);
    for (int k = 0; k < 3; ++k) { // deepest first
        CHECK_ABS(met[k].contact.gap, -0.03 + 0.01 * k, 1e-14);
        CHECK_ABS(met[k].contact.normal[2 - k], 1.0, 1e-14);
    }
    v3_set(body.position, -0.2, -0.2, 1.3);
    assert_int_equal(wall_contacts(wall, &body, 0.0, 8, met), 1);
    CHECK_ABS(met[0].contact.gap, 0.2 * sqrt(2.0) - 0.3, 1e-14);
    CHECK_ABS(met[0].contact.normal[0], -sqrt(0.5), 1e-14);
    v3_set(body.position, -0.1, -0.1, -0.1);
    assert_int_equal(wall_contacts(wall, &body, 0.0, 8, met), 1);
    CHECK_ABS(met[0].contact.gap, 0.1 * sqrt(3.0) - 0.3, 1e-14);
    clx_wall_mesh_destroy(wall);
    clast_mesh_free(&mesh);
}

/* A hull with one triangle: remembered and cold answers while it rolls over the triangle. */
static void triangle_remembers(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clx_wall_mesh *wall = NULL;
    clx_hull_core *gravel = support_gravel_core(4, 1, 60);
    const clx_convex shape = clx_convex_hull(gravel, 1.0);
    make_floor(1, &mesh);
    CHECK_OK(clx_wall_mesh_create(&mesh, &wall));
    for (uint64_t i = 0; i < 20; ++i) {
        clx_rng rng = clx_rng_at(42, CLX_STREAM_TEST, i);
        double q[4], m[3][3], rotation[9], side[3];
        clx_placed body = {&shape, rotation, {0.0, 0.0, 0.3}};
        clx_warm_start warm_start = {0};
        clx_rng_orientation(&rng, q);
        for (int k = 0; k < 2; ++k) {
            body.position[k] = 4.0 * clx_rng_uniform(&rng) - 2.0;
        }
        for (int step = 0; step < 200; ++step) {
            clx_contact warm, cold;
            q_matrix(m, q);
            for (int k = 0; k < 9; ++k) {
                rotation[k] = m[k / 3][k % 3];
            }
            (void)clx_triangle_contact(&wall->tri[0], &body, INFINITY, &warm_start, &warm);
            (void)clx_triangle_contact(&wall->tri[0], &body, INFINITY, NULL, &cold);
            CHECK_ABS(warm.gap, cold.gap, 1e-13);
            v3_axpy(body.position, body.position, -1e-4 - cold.gap, cold.normal);
            clx_rng_direction(&rng, side);
            v3_axpy(body.position, body.position, 1e-3, side);
            for (int k = 0; k < 4; ++k) {
                q[k] += 2e-3 * clx_rng_normal(&rng);
            }
            q_unit(q);
        }
    }
    clx_wall_mesh_destroy(wall);
    clx_hull_core_destroy(gravel);
    clast_mesh_free(&mesh);
}

static clast_status make_wall(void *context)
{
    clx_wall_mesh *wall = NULL;
    const clast_status status = clx_wall_mesh_create(context, &wall);
    clx_wall_mesh_destroy(wall);
    return status;
}

static void walls_survive_refused_memory(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    make_floor(3, &mesh);
    support_refuse_each_allocation(make_wall, &mesh);
    clast_mesh_free(&mesh);
}

/* A ball at a triangle alone, over its face, sides and corners, shallow and deep: the search that
 * knows it only as an ellipsoid of equal axes. */
static void ball_is_a_round_ellipsoid(void **state)
{
    (void)state;
    const double rotation[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    const clx_convex ball = clx_convex_sphere(0.4);
    const clx_convex egg = clx_convex_ellipsoid((const double[3]){0.4, 0.4, 0.4});
    int n_apart = 0, n_beside = 0;
    for (uint64_t i = 0; i < 3000; ++i) {
        clx_rng rng = clx_rng_at(43, CLX_STREAM_TEST, i);
        clast_mesh mesh = {0};
        clx_wall_mesh *wall = NULL;
        clx_contact of_ball, of_egg;
        clx_placed body = {&ball, rotation, {0.0, 0.0, 0.0}};
        CHECK_OK(clast_mesh_alloc(3, 1, &mesh));
        for (int k = 0; k < 3; ++k) {
            mesh.tri[0][k] = k;
            for (int c = 0; c < 3; ++c) {
                mesh.vert[k][c] = clx_rng_uniform(&rng);
                body.position[c] += mesh.vert[k][c] / 3.0;
            }
        }
        CHECK_OK(clx_wall_mesh_create(&mesh, &wall));
        for (int c = 0; c < 3; ++c) {
            body.position[c] += 0.4 * clx_rng_normal(&rng);
        }
        const bool meets = clx_triangle_contact(wall->tri, &body, 0.1, NULL, &of_ball);
        body.shape = &egg;
        assert_int_equal(meets, clx_triangle_contact(wall->tri, &body, 0.1, NULL, &of_egg));
        for (int c = 0; c < 3 && meets; ++c) {
            CHECK_ABS(of_ball.gap, of_egg.gap, 1e-9);
            CHECK_ABS(of_ball.normal[c], of_egg.normal[c], 1e-4);
            CHECK_ABS(of_ball.point[c], of_egg.point[c], 1e-4);
        }
        n_apart += meets ? 0 : 1;
        n_beside += meets && fabs(v3_dot(of_ball.normal, wall->tri[0].normal)) < 0.999 ? 1 : 0;
        clx_wall_mesh_destroy(wall);
        clast_mesh_free(&mesh);
    }
    assert_true(n_apart > 300 && n_beside > 500);
}

enum { AROUND = 64 };

/* A funnel of 45 degrees down to a hole of radius 3. */
static void make_funnel(clast_mesh *mesh)
{
    CHECK_OK(clast_mesh_alloc(2 * AROUND, 2 * AROUND, mesh));
    for (int i = 0; i < AROUND; ++i) {
        const double angle = 2.0 * CLAST_PI * i / AROUND;
        const int32_t j = (i + 1) % AROUND;
        v3_set(mesh->vert[i], 10.0 * cos(angle), 10.0 * sin(angle), 7.0);
        v3_set(mesh->vert[AROUND + i], 3.0 * cos(angle), 3.0 * sin(angle), 0.0);
        const int32_t t[2][3] = {{i, j, AROUND + j}, {i, AROUND + j, AROUND + i}};
        for (int k = 0; k < 6; ++k) {
            mesh->tri[2 * i + k / 3][k % 3] = t[k / 3][k % 3];
        }
    }
}

/* Bodies at the lip of a funnel, whichever way they lean over it: one push, as deep as the nearest
 * point of the smooth funnel says, but for its facets (0.1 % of the hole). */
static void lip_pushes_once_and_no_deeper(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clx_wall_mesh *wall = NULL;
    const double rotation[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    const clx_convex shapes[2] = {clx_convex_sphere(0.8),
                                  clx_convex_ellipsoid((const double[3]){0.8, 0.8, 0.8})};
    make_funnel(&mesh);
    CHECK_OK(clx_wall_mesh_create(&mesh, &wall));
    for (uint64_t i = 0; i < 4000; ++i) {
        clx_rng rng = clx_rng_at(44, CLX_STREAM_TEST, i);
        wall_contact met[4];
        const double around = 2.0 * CLAST_PI * clx_rng_uniform(&rng);
        const double lean =
            CLAST_PI * (0.75 + 0.75 * clx_rng_uniform(&rng)); /* from the hole's lip */
        const double depth = 0.02 * clx_rng_uniform(&rng);
        const double out = 3.0 + (0.8 - depth) * cos(lean);
        clx_placed body = {&shapes[i % 2],
                           rotation,
                           {out * cos(around), out * sin(around), (0.8 - depth) * sin(lean)}};
        const int32_t n = wall_contacts(wall, &body, 0.0, 4, met);
        assert_true(n == 1 || (n == 0 && depth < 5e-3));
        if (n == 1) {
            CHECK_ABS(met[0].contact.gap, -depth, 5e-3);
            CHECK_ABS(met[0].contact.normal[2], sin(lean), 0.02);
        }
    }
    clx_wall_mesh_destroy(wall);
    clast_mesh_free(&mesh);
}

/* Sharp bodies outside of a box, an edge or a corner of either just past the other, and a needle in
 * the box's hollow edge. Where a move of 1e-3 parts them no contact is deeper; a vertex past two
 * walls has a contact with the deeper one at least, and mostly with both. Before, contacts at outer
 * edges were up to 4000 times too deep, and bodies left the box through its inner ones. */
static void contacts_of_sharp_bodies_are_as_deep_as_they_are(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clx_wall_mesh *wall = NULL;
    clx_hull_core *core[2] = {support_core(47, 0, 4, (const double[3]){1.0, 1.0, 1.0}),
                              support_core(47, 1, 40, (const double[3]){1.0, 0.25, 0.2})};
    const clx_convex shapes[2] = {clx_convex_hull(core[0], 1.0), clx_convex_hull(core[1], 1.0)};
    const double depth = 1e-3;
    int n_deep = 0;
    int n_one = 0;
    int n_edge = 0;
    CHECK_OK(clast_mesh_box(2.0, 2.0, 2.0, &mesh));
    CHECK_OK(clx_wall_mesh_create(&mesh, &wall));
    for (uint64_t i = 0; i < 10000; ++i) {
        clx_rng rng = clx_rng_at(45, CLX_STREAM_TEST, i);
        double rotation[9];
        double away[3];
        double high = 4.0;
        double low = 4.0;
        clx_placed body = {&shapes[i % 2], rotation, {0.0, 0.0, 0.0}};
        wall_contact met[4];
        random_rotation(&rng, rotation);
        clx_rng_direction(&rng, away);
        do { // from outside until it touches, then where it comes free
            const double at = low == high ? high - 0.05 : 0.5 * (low + high);
            clx_contact c;
            bool meets = false;
            v3_axpy(body.position, (const double[3]){1.0, 1.0, 1.0}, at, away);
            for (int32_t k = 0; k < wall->n_tri; ++k) {
                meets = meets ||
                        (clx_triangle_contact(&wall->tri[k], &body, 0.0, NULL, &c) && c.gap < 0.0);
            }
            high = meets ? high : at;
            low = meets || low > at ? at : low;
        } while (high == low || high - low > 1e-12);
        v3_axpy(body.position, (const double[3]){1.0, 1.0, 1.0}, high - depth, away);
        const int32_t n = wall_contacts(wall, &body, 0.0, 4, met);
        assert_true(n >= 1);
        assert_true(met[0].contact.gap > -2.0 * depth); // the deepest
        n_deep += met[0].contact.gap < -1.001 * depth ? 1 : 0;
    }
    for (uint64_t i = 0; i < 20000; ++i) { // a vertex, the farthest along (1, 1, 0), in the edge
        clx_rng rng = clx_rng_at(46, CLX_STREAM_TEST, i);
        double rotation[9];
        double tip[3];
        clx_placed body = {&shapes[1], rotation, {0.0, 0.0, 0.0}};
        wall_contact met[4];
        clx_contact at[2];
        random_rotation(&rng, rotation);
        for (int k = 0; k < 2; ++k) {
            const double plane[4] = {k == 0 ? -1.0 : 0.0, k == 1 ? -1.0 : 0.0, 0.0, -2.0};
            clx_plane_contact(&body, plane, NULL, &at[k]);
            body.position[k] = at[k].gap + depth * (0.2 + clx_rng_uniform(&rng));
        }
        body.position[2] = 1.0;
        for (int k = 0; k < 2; ++k) {
            const double plane[4] = {k == 0 ? -1.0 : 0.0, k == 1 ? -1.0 : 0.0, 0.0, -2.0};
            clx_plane_contact(&body, plane, NULL, &at[k]);
        }
        v3_sub(tip, at[0].point, at[1].point);
        const int32_t n = wall_contacts(wall, &body, 0.0, 4, met);
        if (v3_norm(tip) > 2.0 * depth) { // two vertices
            continue;
        }
        assert_true(n == 1 || n == 2);
        CHECK_ABS(met[0].contact.gap, fmin(at[0].gap, at[1].gap), 1e-9);
        if (n == 2) {
            CHECK_ABS(met[1].contact.gap, fmax(at[0].gap, at[1].gap), 1e-9);
        }
        n_one += n == 1 ? 1 : 0;
        ++n_edge;
    }
    assert_true(n_deep <= 2 && n_edge > 300 && n_one < 0.1 * n_edge);
    clx_wall_mesh_destroy(wall);
    clx_hull_core_destroy(core[0]);
    clx_hull_core_destroy(core[1]);
    clast_mesh_free(&mesh);
}

/* A ridge of two plates, blunt to sharp, under a ball: one contact, whose normal leads away from
 * the ridge. Sharper than 60 degrees there was none. */
static void ridges_have_contacts_however_sharp(void **state)
{
    (void)state;
    static const double unturned[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    static const int32_t tri[4][3] = {{0, 1, 3}, {0, 3, 2}, {1, 0, 4}, {1, 4, 5}};
    for (int angle = 10; angle < 180; angle += 10) {
        clast_mesh mesh = {0};
        clx_wall_mesh *wall = NULL;
        const double half = 0.5 * angle * CLAST_PI / 180.0;
        CHECK_OK(clast_mesh_alloc(6, 4, &mesh));
        memcpy(mesh.tri, tri, sizeof tri);
        for (int k = 0; k < 2; ++k) {
            v3_set(mesh.vert[k], 0.0, k == 0 ? -2.0 : 2.0, 0.0);
            v3_set(mesh.vert[2 + k], sin(half), k == 0 ? -2.0 : 2.0, -cos(half));
            v3_set(mesh.vert[4 + k], -sin(half), k == 0 ? -2.0 : 2.0, -cos(half));
        }
        CHECK_OK(clx_wall_mesh_create(&mesh, &wall));
        for (int lean = -2; lean <= 2; ++lean) { // within the fan of normals
            const double from = 0.2 * lean * (0.5 * CLAST_PI - half);
            const clx_convex shapes[2] = {clx_convex_sphere(0.5),
                                          clx_convex_ellipsoid((const double[3]){0.5, 0.5, 0.5})};
            for (int k = 0; k < 2; ++k) {
                const clx_placed body = {
                    &shapes[k], unturned, {0.49 * sin(from), 0.1, 0.49 * cos(from)}};
                wall_contact met[4];
                assert_int_equal(wall_contacts(wall, &body, 0.0, 4, met), 1);
                CHECK_ABS(met[0].contact.gap, -0.01, 1e-9);
                CHECK_ABS(met[0].contact.normal[0], sin(from), 1e-6);
            }
        }
        clx_wall_mesh_destroy(wall);
        clast_mesh_free(&mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(floor_of_triangles_is_a_plane),
        cmocka_unit_test(ball_is_a_round_ellipsoid),
        cmocka_unit_test(lip_pushes_once_and_no_deeper),
        cmocka_unit_test(contacts_of_sharp_bodies_are_as_deep_as_they_are),
        cmocka_unit_test(ridges_have_contacts_however_sharp),
        cmocka_unit_test(box_pushes_from_each_wall),
        cmocka_unit_test(triangle_remembers),
        cmocka_unit_test(walls_survive_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
