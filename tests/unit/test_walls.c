/* Unit: walls that move against closed forms, and grains that leave. */
#include "support.h"

#include "dem_scenes.h"
#include <clast/machine.h>
#include <clast/mesh.h>
#include <string.h>

static const double RADIUS = 0.0035;
static const double DENSITY = 2650.0;
static const double MASS = 2650.0 * 4.0 / 3.0 * CLAST_PI * 0.0035 * 0.0035 * 0.0035;

static clast_dem_grain at(double x, double y, double z)
{
    return (clast_dem_grain){.scale = RADIUS,
                             .density = DENSITY,
                             .position = {x, y, z},
                             .orientation = {1.0, 0.0, 0.0, 0.0}};
}

/* A square of this half side about a point, across axis k. */
static void square(int k, const double middle[3], double half, clast_mesh *mesh)
{
    static const double side[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    CHECK_OK(clast_mesh_alloc(4, 2, mesh));
    for (int i = 0; i < 4; ++i) {
        for (int c = 0; c < 3; ++c) {
            mesh->vert[i][c] = middle[c];
        }
        mesh->vert[i][(k + 1) % 3] += half * side[i][0];
        mesh->vert[i][(k + 2) % 3] += half * side[i][1];
    }
    const int32_t tri[2][3] = {{0, 1, 2}, {0, 2, 3}};
    memcpy(mesh->tri, tri, sizeof tri);
}

/* Balls of the sphere of radius 1, and the energy book from now on. */
static void add_balls(clast_dem *dem, int32_t n, const clast_dem_grain *grain)
{
    clast_shape sphere = {0};
    int32_t id = 0;
    CHECK_OK(clast_shape_sphere("sphere", 1.0, &sphere));
    CHECK_OK(clast_dem_add_shape(dem, &sphere, &id));
    CHECK_OK(clast_dem_begin_energy(dem));
    CHECK_OK(clast_dem_add_grains(dem, n, grain));
    clast_shape_free(&sphere);
}

/* A simulation with one square wall that moves, and grains. */
static clast_dem *with_wall(const clast_dem_config *config, const clast_mesh *mesh,
                            const clast_dem_wall_motion *motion, int32_t n,
                            const clast_dem_grain *grain)
{
    const double none[3] = {0.0, 0.0, 0.0};
    clast_dem *dem = NULL;
    int32_t wall = 0;
    CHECK_OK(clast_dem_create(config, &dem));
    CHECK_OK(clast_dem_add_wall(dem, mesh, &wall));
    CHECK_OK(clast_dem_set_wall_motion(dem, wall, motion));
    CHECK_OK(clast_dem_drive_wall(dem, wall, true, none));
    add_balls(dem, n, grain);
    return dem;
}

/* A ball at rest that a piston meets at speed U leaves at (1 + e) U; the piston's impulse is its
 * momentum, its work e_kin and what the dashpot took. */
static void piston_throws_a_ball(void **state)
{
    (void)state;
    const double speed = 0.2;
    clast_dem_config c = scene_space();
    c.restitution = 0.5;
    c.time_step = c.collision_time / 1000.0;
    clast_mesh plate = {0};
    square(2, (double[3]){0.001, 0.002, -1.2 * RADIUS}, 0.02, &plate);
    const clast_dem_grain ball = at(0.0, 0.0, 0.0);
    const clast_dem_wall_motion up = {.velocity = {0.0, 0.0, speed}};
    clast_dem *dem = with_wall(&c, &plate, &up, 1, &ball);
    CHECK_OK(clast_dem_step(dem, (int64_t)(0.005 / c.time_step)));
    clast_dem_grain g;
    clast_dem_wall w;
    clast_dem_energy e;
    clast_dem_read_grain(dem, 0, &g);
    clast_dem_read_wall(dem, 0, &w);
    clast_dem_energy_measure(dem, &e);
    CHECK_REL(g.velocity[2], 1.5 * speed, 5e-3);
    CHECK_REL(w.impulse[2], -MASS * g.velocity[2], 1e-12);
    CHECK_REL(w.work, MASS * g.velocity[2] * speed, 1e-12);
    CHECK_REL(e.walls, w.work, 1e-12);
    CHECK_REL(w.offset[2], speed * 0.005, 1e-3);
    assert_true(fabs(e.rest) < 1e-12 * e.put_in);
    clast_dem_destroy(dem);
    clast_mesh_free(&plate);
}

/* A ball on a belt slips until it rolls: 2/7 of the belt's speed; the belt's work is its impulse
 * times its speed. */
static void belt_takes_a_ball_along(void **state)
{
    (void)state;
    const double speed = 0.1;
    clast_dem_config c = scene_physics();
    c.domain = CLAST_DEM_OPEN;
    c.fluid_density = 0.0;
    c.time_step = c.collision_time / 200.0;
    const double ln = log(c.restitution);
    const double rest =
        9.81 * c.collision_time * c.collision_time / (CLAST_PI * CLAST_PI + ln * ln);
    for (int of_domain = 0; of_domain < 2; ++of_domain) {
        const double none[3] = {0.0, 0.0, 0.0};
        const clast_dem_wall_motion along = {.velocity = {speed, 0.0, 0.0}};
        const clast_dem_grain ball = at(0.0, 0.0, RADIUS - rest);
        clast_mesh plate = {0};
        clast_dem *dem = NULL;
        c.floor = of_domain == 1;
        square(2, (double[3]){0.001, 0.002, of_domain == 1 ? -0.1 : 0.0}, 0.05, &plate);
        dem = with_wall(&c, &plate, &along, 1, &ball);
        if (of_domain == 1) {
            CHECK_OK(clast_dem_set_wall_motion(dem, 0, &along));
            CHECK_OK(clast_dem_drive_wall(dem, 0, true, none));
        }
        CHECK_OK(clast_dem_step(dem, 30000));
        clast_dem_grain g;
        clast_dem_wall w;
        clast_dem_energy e;
        clast_dem_read_grain(dem, 0, &g);
        clast_dem_read_wall(dem, 0, &w);
        clast_dem_energy_measure(dem, &e);
        CHECK_REL(g.velocity[0], 2.0 / 7.0 * speed, 1e-3);
        CHECK_REL(g.angular_velocity[1], -5.0 / 7.0 * speed / RADIUS, 1e-3);
        CHECK_REL(e.walls, 2.0 / 7.0 * MASS * speed * speed, 1e-3);
        CHECK_REL(w.force[2], -MASS * 9.81, 1e-3);
        assert_true(fabs(e.rest) < 1e-10 * (e.walls + fabs(e.gravity)));
        clast_dem_destroy(dem);
        clast_mesh_free(&plate);
    }
}

/* A paddle that turns about z meets a ball at r: as a piston of speed w r; its torque is r times
 * its force. */
static void paddle_strikes_with_its_speed_there(void **state)
{
    (void)state;
    const double rate = 5.0;
    const double r = 0.03;
    clast_dem_config c = scene_space();
    c.restitution = 0.5;
    c.friction = 0.0;
    c.time_step = c.collision_time / 1000.0;
    clast_mesh plate = {0};
    square(1, (double[3]){0.02, 0.0, 0.0}, 0.02, &plate);
    const clast_dem_grain ball = at(r, 1.01 * RADIUS, 0.0);
    const clast_dem_wall_motion turning = {.axis = {0.0, 0.0, 1.0}, .rate = rate};
    clast_dem *dem = with_wall(&c, &plate, &turning, 1, &ball);
    CHECK_OK(clast_dem_step(dem, (int64_t)(1e-3 / c.time_step)));
    clast_dem_grain g;
    clast_dem_wall w;
    clast_dem_energy e;
    clast_dem_read_grain(dem, 0, &g);
    clast_dem_read_wall(dem, 0, &w);
    clast_dem_energy_measure(dem, &e);
    CHECK_REL(hypot(g.velocity[0], g.velocity[1]), 1.5 * rate * r, 1e-2);
    CHECK_REL(w.moment[2], -MASS * (g.position[0] * g.velocity[1] - g.position[1] * g.velocity[0]),
              1e-9);
    CHECK_REL(e.walls, w.work, 1e-12);
    CHECK_REL(w.angle, rate * 1e-3, 1e-9);
    assert_true(fabs(e.rest) < 1e-12 * e.put_in);
    clast_dem_destroy(dem);
    clast_mesh_free(&plate);
}

enum { SIDE = 6, N_BED = SIDE * SIDE * SIDE };

/* Balls in a box over a plate that vibrates and turns, while another sweeps through. */
static clast_dem *shaken(double skin)
{
    clast_dem_config c = scene_physics();
    clast_dem_grain grain[N_BED];
    clast_mesh plate = {0};
    int32_t wall = 0;
    clast_dem *dem = NULL;
    const double none[3] = {0.0, 0.0, 0.0};
    double time[3] = {0.0, 0.01, 0.03};
    double place[3][4] = {{0.0}, {0.01, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.005, 0.3}};
    c.domain = CLAST_DEM_BOX;
    c.width = 0.05;
    c.fluid_density = 0.0;
    c.skin = skin;
    for (int i = 0; i < N_BED; ++i) {
        grain[i] = at(8e-3 * (i % SIDE - 2.5), 8e-3 * (i / SIDE % SIDE - 2.5),
                      0.012 + 8e-3 * (i / SIDE / SIDE));
        grain[i].velocity[0] = 0.01 * (i % 7);
    }
    CHECK_OK(clast_dem_create(&c, &dem));
    for (int k = 0; k < 2; ++k) {
        const clast_dem_wall_motion motion[2] = {
            {.amplitude = {0.0, 0.0, 1e-3}, .period = 7e-3, .axis = {0.0, 0.0, 1.0}, .rate = 8.0},
            {.axis = {0.0, 1.0, 0.0}, .n = 3, .time = time, .place = place}};
        square(k == 0 ? 2 : 0, (double[3]){k == 0 ? 0.0 : -0.0245, 0.0, k == 0 ? 5e-3 : 0.03},
               k == 0 ? 0.05 : 0.015, &plate);
        CHECK_OK(clast_dem_add_wall(dem, &plate, &wall));
        CHECK_OK(clast_dem_set_wall_motion(dem, wall, &motion[k]));
        CHECK_OK(clast_dem_drive_wall(dem, wall, true, none));
        clast_mesh_free(&plate);
    }
    add_balls(dem, N_BED, grain);
    return dem;
}

/* Whatever the lists' margins: no contact with a wall that moves is missed. */
static void moving_walls_miss_no_contact(void **state)
{
    (void)state;
    static const double skin[] = {0.02, 0.1, 0.7};
    uint64_t hash[3];
    for (int k = 0; k < 3; ++k) {
        clast_dem *dem = shaken(skin[k]);
        CHECK_OK(clast_dem_step(dem, 8000));
        clast_dem_energy e;
        clast_dem_energy_measure(dem, &e);
        assert_true(fabs(e.walls) > 0.05 * fabs(e.gravity));
        assert_true(fabs(e.rest) < 1e-10 * (fabs(e.walls) + fabs(e.gravity)));
        hash[k] = clast_dem_hash(dem);
        clast_dem_destroy(dem);
    }
    assert_true(hash[0] == hash[1] && hash[1] == hash[2]);
}

/* Grains that leave take nothing with them but themselves: the book closes, and those that never
 * met them go on in the same bits. */
static void those_who_stay_go_on_as_they_were(void **state)
{
    (void)state;
    enum { N = 30, N_LATE = 60 }; // those that no list knows yet
    uint64_t hash[2];
    for (int k = 0; k < 2; ++k) {
        clast_dem_config c = scene_physics();
        clast_dem_grain grain[N];
        clast_dem_grain late[N_LATE];
        uint8_t goes[N + N_LATE] = {0};
        clast_shape sphere = {0};
        clast_dem *dem = NULL;
        int32_t id = 0;
        int32_t n = 0;
        c.domain = CLAST_DEM_OPEN;
        c.fluid_density = 0.0;
        for (int i = 0; i < N; ++i) { // two heaps, far apart; in the second run one alone
            const bool is_far = i % 3 == 0;
            const int m = i / 3;
            grain[n] = at((is_far ? 1.0 : 0.0) + 6e-3 * (m % 2) + 1e-4 * i, 6e-3 * (i % 3),
                          4e-3 + 7e-3 * (m / 2));
            goes[n] = is_far ? 1 : 0;
            n += k == 0 || !is_far ? 1 : 0;
        }
        CHECK_OK(clast_dem_create(&c, &dem));
        CHECK_OK(clast_shape_sphere("sphere", 1.0, &sphere));
        CHECK_OK(clast_dem_add_shape(dem, &sphere, &id));
        CHECK_OK(clast_dem_begin_energy(dem));
        CHECK_OK(clast_dem_add_grains(dem, n, grain));
        CHECK_OK(clast_dem_step(dem, 4000));
        for (int i = 0; i < N_LATE; ++i) {
            late[i] = at(2.0 + 0.02 * i, 0.0, 4e-3);
        }
        CHECK_OK(clast_dem_add_grains(dem, N_LATE, late));
        if (k == 0) {
            CHECK_OK(clast_dem_remove_grains(dem, goes));
            assert_int_equal(clast_dem_n_grain(dem), 20 + N_LATE);
        }
        CHECK_OK(clast_dem_step(dem, 4000));
        clast_dem_energy e;
        clast_dem_energy_measure(dem, &e);
        assert_true(fabs(e.rest) < 1e-10 * (e.made + e.gravity));
        assert_true((e.left != 0.0) == (k == 0));
        hash[k] = clast_dem_hash(dem);
        clast_dem_destroy(dem);
        clast_shape_free(&sphere);
    }
    assert_true(hash[0] == hash[1]);
}

/* What holds two grains together leaves with either: of three balls in a row, pressed into each
 * other, one goes, then another. */
static void attraction_leaves_with_its_grains(void **state)
{
    (void)state;
    for (int cohesion = CLAST_DEM_AREA; cohesion <= CLAST_DEM_JKR; ++cohesion) {
        clast_dem_config c = scene_space();
        clast_dem_energy e[3];
        double held[3];
        uint8_t goes[3] = {0, 0, 1};
        clast_dem *dem = NULL;
        c.cohesion = cohesion;
        c.time_step = 1e-3 * c.collision_time;
        c.cohesion_energy = cohesion == CLAST_DEM_AREA ? 1e6 : 0.0;
        c.surface_energy = cohesion == CLAST_DEM_AREA ? 0.0 : 30.0;
        const clast_dem_grain ball[3] = {at(-1.999 * RADIUS, 0.0, 0.0), at(0.0, 0.0, 0.0),
                                         at(1.999 * RADIUS, 0.0, 0.0)};
        CHECK_OK(clast_dem_create(&c, &dem));
        add_balls(dem, 3, ball);
        CHECK_OK(clast_dem_step(dem, 100));
        for (int k = 0; k < 3; ++k) {
            CHECK_OK(k > 0 ? clast_dem_remove_grains(dem, goes) : CLAST_OK);
            goes[2 - k] = 1;
            clast_dem_energy_measure(dem, &e[k]);
            held[k] = e[k].translation + e[k].normal_springs + e[k].attraction;
            assert_true(fabs(e[k].rest) < 1e-12 * (e[0].normal_springs - e[0].attraction));
        }
        assert_true(e[0].attraction < 0.0);
        CHECK_REL(e[1].attraction, 0.5 * e[0].attraction, 1e-9);
        assert_true(e[2].attraction == 0.0);
        CHECK_REL(e[2].left, held[0] - held[2], 1e-9);
        clast_dem_destroy(dem);
    }
}

/* A wall that is opened holds nothing; one that would not stay a plane is refused. */
static void walls_open_and_stay_what_they_are(void **state)
{
    (void)state;
    clast_dem_config c = scene_physics();
    clast_mesh plate = {0};
    const clast_dem_wall_motion still = {.period = 0.0};
    const clast_dem_wall_motion tilts = {.axis = {1.0, 0.0, 0.0}, .rate = 1.0};
    const clast_dem_grain ball = at(0.0, 0.0, 1.01 * RADIUS);
    clast_dem_grain g;
    c.domain = CLAST_DEM_CYLINDER;
    c.width = 0.05;
    c.floor = true;
    square(2, (double[3]){0.0, 0.0, -0.2}, 0.1, &plate);
    clast_dem *dem = with_wall(&c, &plate, &still, 1, &ball);
    CHECK_OK(clast_dem_watch_walls(dem));
    assert_int_equal(clast_dem_n_wall(dem), 3); // floor, cylinder, plate
    CHECK_STATUS(clast_dem_set_wall_motion(dem, 0, &tilts), CLAST_E_CONFIG);
    CHECK_STATUS(clast_dem_set_wall_motion(dem, 1, &tilts), CLAST_E_CONFIG);
    const clast_dem_wall_motion lost = {.velocity = {NAN, 0.0, 0.0}};
    CHECK_STATUS(clast_dem_set_wall_motion(dem, 2, &lost), CLAST_E_USAGE);
    CHECK_OK(clast_dem_step(dem, 2000));
    clast_dem_read_grain(dem, 0, &g);
    assert_true(g.position[2] > 0.99 * RADIUS);
    CHECK_OK(clast_dem_open_wall(dem, 0));
    CHECK_OK(clast_dem_step(dem, 2000));
    clast_dem_read_grain(dem, 0, &g);
    CHECK_REL(g.velocity[2], -9.81 * (1.0 - c.fluid_density / DENSITY) * 0.01, 0.1);
    clast_dem_destroy(dem);
    clast_mesh_free(&plate);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(piston_throws_a_ball),
        cmocka_unit_test(belt_takes_a_ball_along),
        cmocka_unit_test(paddle_strikes_with_its_speed_there),
        cmocka_unit_test(moving_walls_miss_no_contact),
        cmocka_unit_test(those_who_stay_go_on_as_they_were),
        cmocka_unit_test(attraction_leaves_with_its_grains),
        cmocka_unit_test(walls_open_and_stay_what_they_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
