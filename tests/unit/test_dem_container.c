/* Unit: grains against walls of triangles: every kind bounces with e_n, slides over edges as over a
 * plane, rests in corners, and is held by an open container. */
#include "support.h"

#include "dem_scenes.h"
#include "math/vec3.h"
#include <stdio.h>
#include <string.h>

static const double DENSITY = 2650.0;

/// A square floor at z = 0 of n x n cells of two triangles each, up to +- half.
static void make_floor(int n, double half, clast_mesh *mesh)
{
    CHECK_OK(clast_mesh_alloc((n + 1) * (n + 1), 2 * n * n, mesh));
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
            mesh->vert[i * (n + 1) + j][0] = half * (2.0 * i / n - 1.0);
            mesh->vert[i * (n + 1) + j][1] = half * (2.0 * j / n - 1.0);
        }
    }
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const int32_t v = i * (n + 1) + j;
            const int32_t cell[2][3] = {{v, v + n + 1, v + n + 2}, {v, v + n + 2, v + 1}};
            for (int k = 0; k < 3; ++k) {
                mesh->tri[2 * (i * n + j)][k] = cell[0][k];
                mesh->tri[2 * (i * n + j) + 1][k] = cell[1][k];
            }
        }
    }
}

static clast_dem *in_container(const clast_dem_config *config, const clast_mesh *mesh,
                               const clast_shape *shape, const clast_dem_grain *grain)
{
    clast_dem *dem = NULL;
    int32_t id = 0;
    CHECK_OK(clast_dem_create(config, &dem));
    CHECK_OK(clast_dem_add_container(dem, mesh));
    CHECK_OK(clast_dem_add_shape(dem, shape, &id));
    CHECK_OK(clast_dem_add_grains(dem, 1, grain));
    return dem;
}

/* Along x into an upright square of two triangles, in the middle of one, on the common edge, and on
 * a corner of the fine one: e_n and T_c as between grains, from both sides of the wall. */
static void every_kind_bounces_off_triangles(void **state)
{
    (void)state;
    for (int kind = 0; kind < N_SCENE_BODY; ++kind) {
        for (int side = -1; side <= 1; side += 2) {
            for (int place = 0; place < 3; ++place) {
                const double at[3][2] = {{0.0, 0.0}, {1e-3, -2e-3}, {5e-3, 5e-3}};
                clast_mesh wall = {0};
                clast_shape shape = {0};
                if (scene_is_flat((scene_body_kind)kind)) {
                    continue; /* a face has no point of its own */
                }
                clast_dem_config c = scene_space();
                c.restitution = 0.3;
                c.time_step = c.collision_time / 1000.0;
                make_floor(8, 0.02, &wall);
                const double h = sqrt(0.5);
                clast_mesh_transform(&wall, 1.0, (const double[4]){h, 0.0, h, 0.0},
                                     (const double[3]){0.0, 0.0, 0.0});
                CHECK_OK(scene_body((scene_body_kind)kind, &shape));
                clast_dem_grain g = {.scale = 1.0, .density = DENSITY, .orientation = {1.0}};
                g.position[0] = side * 4.0001e-3;
                g.position[1] = at[place][0];
                g.position[2] = at[place][1];
                g.velocity[0] = -side * 0.05;
                clast_dem *dem = in_container(&c, &wall, &shape, &g);
                CHECK_REL(scene_collide(dem, c.time_step), c.collision_time, 4e-3);
                clast_dem_read_grain(dem, 0, &g);
                /* first order: |ln e| dt / T_c, up to twice */
                CHECK_REL(side * g.velocity[0] / 0.05, 0.3, 2.0 * 1.2 / 1000.0 + 1e-3);
                clast_dem_destroy(dem);
                clast_shape_free(&shape);
                clast_mesh_free(&wall);
            }
        }
    }
}

/// Height, speed and spin after sliding for n steps, over triangles or over the plane.
static void slide(int kind, bool triangles, double out[3])
{
    clast_dem_config c = scene_physics();
    clast_mesh wall = {0};
    clast_shape shape = {0};
    clast_dem *dem = NULL;
    clast_dem_grain g = {.scale = 1.0, .density = DENSITY, .orientation = {1.0}};
    c.domain = CLAST_DEM_OPEN;
    c.floor = !triangles;
    c.friction = 0.3;
    make_floor(20, 0.05, &wall);
    CHECK_OK(scene_body((scene_body_kind)kind, &shape));
    g.position[0] = -0.02;
    g.position[1] = 0.3e-3;
    g.position[2] = kind == SCENE_EGG ? 2e-3 : kind == SCENE_CLUMP ? 2e-3 : 4e-3;
    g.position[2] -= 1.6e-8;
    g.velocity[0] = 0.3;
    if (triangles) {
        dem = in_container(&c, &wall, &shape, &g);
    } else {
        dem = scene_bodies(&c, &shape, 1, &g);
    }
    assert_non_null(dem);
    CHECK_OK(clast_dem_step(dem, 20000));
    clast_dem_read_grain(dem, 0, &g);
    out[0] = g.position[2];
    out[1] = g.position[0];
    out[2] = g.velocity[0];
    clast_dem_destroy(dem);
    clast_shape_free(&shape);
    clast_mesh_free(&wall);
}

/* Twelve cells of 5 mm, some thirty edges: the path is that over the plane; what differs is the
 * arithmetic of the gap (1e-14 of the size), which friction and spin carry on. A cube slides on its
 * face, whose contact point is not unique, so only its weight and friction can be compared. */
static void edges_of_a_flat_floor_are_not_felt(void **state)
{
    (void)state;
    const int kinds[] = {SCENE_BALL, SCENE_EGG, SCENE_CLUMP};
    for (int k = 0; k < 3; ++k) {
        double on_plane[3];
        double on_mesh[3];
        slide(kinds[k], false, on_plane);
        slide(kinds[k], true, on_mesh);
        CHECK_ABS(on_mesh[0], on_plane[0], 1e-9);
        CHECK_ABS(on_mesh[1], on_plane[1], 1e-6);
        CHECK_REL(on_mesh[2], on_plane[2], 1e-4);
        assert_true(on_mesh[1] > 0.0);
    }
}

/* An octahedron 1 um deep on its vertex, at an edge of the floor or beside it, moves along x and
 * leaves the floor. Where the least move out of each triangle is over the edge, the history of
 * friction passes from face to face. */
static void lift_off(bool triangles, double x, double out[2])
{
    clast_dem_config c = scene_physics();
    clast_mesh wall = {0};
    clast_shape shape = {0};
    clast_dem_grain g = {.scale = 1.0, .density = DENSITY, .orientation = {1.0}};
    c.domain = CLAST_DEM_OPEN;
    c.floor = !triangles;
    c.friction = 0.8;
    make_floor(20, 0.05, &wall);
    CHECK_OK(scene_body(SCENE_OCTAHEDRON, &shape));
    v3_set(g.position, x, 0.3e-3, shape.bounding_radius - 1e-6);
    g.velocity[0] = 2e-3;
    clast_dem *dem =
        triangles ? in_container(&c, &wall, &shape, &g) : scene_bodies(&c, &shape, 1, &g);
    assert_non_null(dem);
    CHECK_OK(clast_dem_step(dem, 60));
    clast_dem_read_grain(dem, 0, &g);
    out[0] = g.position[0];
    out[1] = g.velocity[0];
    clast_dem_destroy(dem);
    clast_shape_free(&shape);
    clast_mesh_free(&wall);
}

static void vertex_keeps_its_friction_over_an_edge(void **state)
{
    (void)state;
    for (int k = -8; k <= 8; ++k) {
        double on_plane[2];
        double on_mesh[2];
        lift_off(false, 1e-7 * k, on_plane);
        lift_off(true, 1e-7 * k, on_mesh);
        CHECK_ABS(on_mesh[0], on_plane[0], 1e-12);
        CHECK_REL(on_mesh[1], on_plane[1], 1e-6);
    }
}

/* A ball in a bin of five sides, thrown at a corner, comes to rest on the floor within it, and its
 * overlap is its weight's: m g' / k_n. */
static void open_bin_holds_a_ball(void **state)
{
    (void)state;
    clast_dem_config c = scene_physics();
    clast_mesh bin = {0};
    clast_shape shape = {0};
    clast_dem_measures m;
    c.domain = CLAST_DEM_OPEN;
    c.floor = false;
    CHECK_OK(clast_mesh_box(0.03, 0.03, 0.03, &bin));
    int32_t n = 0;
    for (int32_t t = 0; t < bin.n_tri; ++t) { /* leave out the lid */
        double z = 0.0;
        for (int k = 0; k < 3; ++k) {
            z += bin.vert[bin.tri[t][k]][2];
        }
        if (z < 0.0899) {
            for (int k = 0; k < 3; ++k) {
                bin.tri[n][k] = bin.tri[t][k];
            }
            ++n;
        }
    }
    assert_int_equal(n, 10);
    bin.n_tri = n;
    CHECK_OK(scene_body(SCENE_BALL, &shape));
    clast_dem_grain g = {.scale = 1.0, .density = DENSITY, .orientation = {1.0}};
    g.position[0] = g.position[1] = g.position[2] = 0.015;
    g.velocity[0] = 1.0;
    g.velocity[1] = 0.7;
    g.velocity[2] = -1.0;
    clast_dem *dem = in_container(&c, &bin, &shape, &g);
    CHECK_OK(clast_dem_step(dem, 20000));
    clast_dem_set_drive(dem, &(clast_dem_drive){0.0, 1.0, 1e-20});
    CHECK_OK(clast_dem_step(dem, 80000));
    clast_dem_read_grain(dem, 0, &g);
    clast_dem_measure(dem, &m);
    const double ln = log(0.1);
    const double rest = 9.81 * (1.0 - 1000.0 / DENSITY) * 4e-8 / (CLAST_PI * CLAST_PI + ln * ln);
    CHECK_REL(4e-3 - g.position[2], rest, 1e-3);
    assert_true(fabs(g.position[0] - 0.015) < 0.0111 && fabs(g.position[1] - 0.015) < 0.0111);
    assert_true(m.n_wall_contact >= 1 && m.max_speed < 1e-6);
    clast_dem_destroy(dem);
    clast_shape_free(&shape);
    clast_mesh_free(&bin);
}

/* Before, triangles with such a corner were left out as if they had no area, and grains fell
 * through the hole. A vertex that no triangle has is none of the wall. */
static void walls_whose_vertices_are_no_places_are_refused(void **state)
{
    (void)state;
    const double bad[] = {(double)NAN, (double)INFINITY, -(double)INFINITY, 1e200};
    clast_dem_config c = scene_space();
    clast_mesh box = {0};
    clast_dem *dem = NULL;
    int32_t wall = -7;
    CHECK_OK(clast_mesh_box(0.03, 0.03, 0.03, &box));
    CHECK_OK(clast_dem_create(&c, &dem));
    for (int k = 0; k < 4; ++k) {
        const double was = box.vert[k][k % 3];
        char vertex[16];
        box.vert[k][k % 3] = bad[k];
        (void)snprintf(vertex, sizeof vertex, "vertex %d ", k + 1);
        CHECK_STATUS(clast_dem_add_container(dem, &box), CLAST_E_GEOMETRY);
        assert_non_null(strstr(clast_error_detail(), vertex));
        CHECK_STATUS(clast_dem_add_wall(dem, &box, &wall), CLAST_E_GEOMETRY);
        box.vert[k][k % 3] = was;
    }
    assert_int_equal(wall, -7);
    box.n_tri = 2; /* of vertices 1 to 4 or so */
    for (int32_t v = 0; v < box.n_vert; ++v) {
        bool is_used = false;
        for (int i = 0; i < 6; ++i) {
            is_used = is_used || box.tri[i / 3][i % 3] == v;
        }
        box.vert[v][0] = is_used ? box.vert[v][0] : (double)NAN;
    }
    CHECK_OK(clast_dem_add_container(dem, &box));
    clast_dem_destroy(dem);
    clast_mesh_free(&box);
}

/// A plane through the origin that falls towards +x at this angle.
static void make_slope(double angle, clast_mesh *mesh)
{
    make_floor(1, 0.5, mesh);
    clast_mesh_transform(mesh, 1.0, (const double[4]){cos(0.5 * angle), 0.0, sin(0.5 * angle), 0.0},
                         (const double[3]){0.0, 0.0, 0.0});
}

/// Speed down the slope after 0.05 s from rest, and the spin about y.
static void go_down(const clast_shape *shape, double height, double angle, double friction,
                    double out[2])
{
    clast_dem_config c = scene_physics();
    clast_mesh slope = {0};
    const double n[3] = {sin(angle), 0.0, cos(angle)};
    c.domain = CLAST_DEM_OPEN;
    c.floor = false;
    c.friction = friction;
    make_slope(angle, &slope);
    clast_dem_grain g = {.scale = 1.0, .density = DENSITY};
    g.orientation[0] = cos(0.5 * angle);
    g.orientation[2] = sin(0.5 * angle);
    for (int k = 0; k < 3; ++k) {
        g.position[k] = (height - 1.6e-8 * cos(angle)) * n[k];
    }
    clast_dem *dem = in_container(&c, &slope, shape, &g);
    CHECK_OK(clast_dem_step(dem, 10000));
    clast_dem_read_grain(dem, 0, &g);
    out[0] = g.velocity[0] * cos(angle) - g.velocity[2] * sin(angle);
    out[1] = g.angular_velocity[1];
    clast_dem_destroy(dem);
    clast_mesh_free(&slope);
}

/* A ball rolls down at 5/7 g' sin(a) while tan(a) < 7/2 mu; on a steeper slope it slides at
 * g' (sin(a) - mu cos(a)) and is spun up at 5/2 mu g' cos(a) / R. Spring and dashpot of the contact
 * take some T_c of 0.05 s to load: 2e-4 / 0.05 = 0.4 %. */
static void ball_rolls_and_slides_on_a_slope(void **state)
{
    (void)state;
    const double g = 9.81 * (1.0 - 1000.0 / DENSITY);
    const double mu = 0.2;
    const double critical = atan(3.5 * mu);
    clast_shape ball = {0};
    CHECK_OK(scene_body(SCENE_BALL, &ball));
    for (int steep = 0; steep < 2; ++steep) {
        double out[2];
        const double a = steep ? critical + 0.1 : critical - 0.1;
        go_down(&ball, 4e-3, a, mu, out);
        const double rate = steep ? g * (sin(a) - mu * cos(a)) : 5.0 / 7.0 * g * sin(a);
        const double spin = steep ? 2.5 * mu * g * cos(a) / 4e-3 : rate / 4e-3;
        CHECK_REL(out[0], rate * 0.05, 4e-3);
        CHECK_REL(out[1], spin * 0.05, 4e-3);
    }
    clast_shape_free(&ball);
}

/* A tripod of three balls cannot roll: it stays where tan(a) < mu, and else slides at
 * g' (sin(a) - mu cos(a)), with the friction of its three feet together. */
static void tripod_slides_beyond_the_angle_of_friction(void **state)
{
    (void)state;
    const double g = 9.81 * (1.0 - 1000.0 / DENSITY);
    const double mu = 0.4;
    clast_spheres feet = {0};
    clast_shape tripod = {0};
    CHECK_OK(clast_spheres_alloc(3, &feet));
    for (int k = 0; k < 3; ++k) {
        feet.centre[k][0] = 6e-3 * cos(2.0 * CLAST_PI * k / 3.0);
        feet.centre[k][1] = 6e-3 * sin(2.0 * CLAST_PI * k / 3.0);
        feet.radius[k] = 2e-3;
    }
    CHECK_OK(clast_shape_clump("tripod", &feet, &tripod));
    for (int steep = 0; steep < 2; ++steep) {
        double out[2];
        const double a = atan(mu) + (steep ? 0.05 : -0.05);
        go_down(&tripod, 2e-3, a, mu, out);
        if (steep) {
            CHECK_REL(out[0], g * (sin(a) - mu * cos(a)) * 0.05, 4e-3);
        } else {
            /* its springs give by mu g' / k_t and swing: speeds of that over T_c */
            CHECK_ABS(out[0], 0.0, 1.6e-8 / 2e-4);
        }
        CHECK_ABS(out[1], 0.0, 1e-2);
    }
    clast_spheres_free(&feet);
    clast_shape_free(&tripod);
}

/* A dumb-bell upright in a slot, 0.02 of a radius in the floor and 0.01 in the ceiling of one
 * surface: each contact has the whole stiffness, as two walls do (it was shared between them). And
 * a rod as a chord of a cylinder: both ends have a contact force, along their own radii. */
static void walls_that_face_each_other_share_nothing(void **state)
{
    (void)state;
    const double r = 1e-3;
    for (int chord = 0; chord < 2; ++chord) {
        clast_dem_config c = scene_space();
        clast_spheres pair = {0};
        clast_shape clump = {0};
        clast_mesh slot = {0};
        clast_dem *dem = NULL;
        clast_dem_grain g = {.scale = 1.0, .density = 2650.0, .orientation = {1.0}};
        int32_t id = 0;
        c.restitution = 1.0;
        c.time_step = 1e-7;
        if (chord) {
            c.domain = CLAST_DEM_CYLINDER;
            c.floor = c.lid = false;
            c.width = 4.4e-3; // walls at 2.2 r
        }
        CHECK_OK(clast_spheres_alloc(2, &pair));
        for (int k = 0; k < 2; ++k) {
            v3_set(pair.centre[k], chord ? (2 * k - 1) * r : 0.0, 0.0,
                   chord ? 0.0 : (2 * k - 1) * r);
            pair.radius[k] = chord ? 0.5 * r : r;
        }
        CHECK_OK(clast_shape_clump("bell", &pair, &clump));
        CHECK_OK(clast_dem_create(&c, &dem));
        CHECK_OK(clast_dem_add_shape(dem, &clump, &id));
        double wanted = 0.0;
        if (chord) { // centres 0.01 r beyond a distance of 1.7 r from the axis
            g.position[1] = sqrt(1.71 * 1.71 - 1.0) * r;
            g.position[2] = 0.5 * c.height;
            wanted = -2.0 * 0.01 * r * g.position[1] / (1.71 * r);
        } else {
            CHECK_OK(clast_mesh_box(12.0 * r, 12.0 * r, 3.97 * r, &slot));
            CHECK_OK(clast_dem_add_container(dem, &slot));
            v3_set(g.position, 6.0 * r, 6.0 * r, 1.98 * r);
            wanted = 0.01 * r;
        }
        CHECK_OK(clast_dem_add_grains(dem, 1, &g));
        CHECK_OK(clast_dem_step(dem, 1));
        clast_dem_read_grain(dem, 0, &g);
        const double spring = CLAST_PI * CLAST_PI / (c.collision_time * c.collision_time);
        CHECK_REL(g.velocity[chord ? 1 : 2], wanted * spring * c.time_step, 1e-3);
        clast_dem_destroy(dem);
        clast_mesh_free(&slot);
        clast_shape_free(&clump);
        clast_spheres_free(&pair);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_bounces_off_triangles),
        cmocka_unit_test(vertex_keeps_its_friction_over_an_edge),
        cmocka_unit_test(edges_of_a_flat_floor_are_not_felt),
        cmocka_unit_test(open_bin_holds_a_ball),
        cmocka_unit_test(walls_whose_vertices_are_no_places_are_refused),
        cmocka_unit_test(ball_rolls_and_slides_on_a_slope),
        cmocka_unit_test(tripod_slides_beyond_the_angle_of_friction),
        cmocka_unit_test(walls_that_face_each_other_share_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
