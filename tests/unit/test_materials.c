/* Unit: contacts that differ by the materials of their two sides, against closed forms. */
#include "support.h"

#include "dem_scenes.h"
#include <clast/machine.h>
#include <clast/mesh.h>
#include <string.h>

static const double RADIUS = 0.0035;
static const double DENSITY = 2650.0;
static const double SLOPE = 0.5; /* rad */
static const double WEIGHT = 9.81;

/* Shapes 0 .. n - 1, of materials of the same number. */
static void add_shapes(clast_dem *dem, int32_t n)
{
    clast_shape sphere = {0};
    CHECK_OK(clast_shape_sphere("sphere", 1.0, &sphere));
    for (int32_t i = 0; i < n; ++i) {
        int32_t id = 0;
        CHECK_OK(clast_dem_add_shape(dem, &sphere, &id));
        CHECK_OK(clast_dem_set_material(dem, id, id));
    }
    clast_shape_free(&sphere);
}

static clast_dem_grain ball(int32_t shape, double x, double y, double z)
{
    return (clast_dem_grain){.shape = shape,
                             .scale = RADIUS,
                             .density = DENSITY,
                             .position = {x, y, z},
                             .orientation = {1.0, 0.0, 0.0, 0.0}};
}

/* A plate through the origin that falls along x by SLOPE. */
static void incline(clast_mesh *mesh)
{
    static const double corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    static const int32_t tri[2][3] = {{0, 1, 2}, {0, 2, 3}};
    CHECK_OK(clast_mesh_alloc(4, 2, mesh));
    for (int i = 0; i < 4; ++i) {
        mesh->vert[i][0] = 0.5 * corner[i][0] * cos(SLOPE) + 0.003;
        mesh->vert[i][1] = 0.5 * corner[i][1] + 0.002;
        mesh->vert[i][2] = -0.5 * corner[i][0] * sin(SLOPE) - 0.003 * tan(SLOPE);
    }
    memcpy(mesh->tri, tri, sizeof tri);
}

/* Overlap at which a spring holds a grain's weight across the slope. */
static double sunk(const clast_dem_contact *c)
{
    const double ln = log(c->restitution);
    return WEIGHT * cos(SLOPE) * c->collision_time * c->collision_time /
           (CLAST_PI * CLAST_PI + ln * ln);
}

static clast_dem_config open_air(void)
{
    clast_dem_config c = scene_physics();
    c.domain = CLAST_DEM_OPEN;
    c.floor = false;
    c.fluid_density = 0.0;
    c.restitution = 0.5;
    c.time_step = c.collision_time / 200.0;
    return c;
}

/* On one incline, by its friction with either material: a ball rolls at 5/7 g sin(a) while tan(a) <
 * 7/2 mu; else it slides, at g (sin(a) - mu cos(a)), and turns up at 5/2 mu g cos(a) / R. */
static void balls_roll_or_slide_by_their_own_friction(void **state)
{
    (void)state;
    static const double mu[2] = {0.4, 0.05};
    clast_dem_config c = open_air();
    const clast_dem_contact usual = clast_dem_contact_of(&c, true);
    clast_dem_contact table[9];
    clast_mesh plate = {0};
    clast_dem *dem = NULL;
    int32_t wall = 0;
    clast_dem_grain grain[2];
    incline(&plate);
    CHECK_OK(clast_dem_create(&c, &dem));
    CHECK_OK(clast_dem_add_wall(dem, &plate, &wall));
    for (int k = 0; k < 9; ++k) {
        table[k] = usual;
    }
    for (int k = 0; k < 2; ++k) {
        table[3 * k + 2].friction = mu[k];
        const double high = RADIUS - sunk(&usual);
        grain[k] = ball(k, high * sin(SLOPE), 0.05 * k, high * cos(SLOPE));
    }
    CHECK_OK(clast_dem_set_contacts(dem, 3, table));
    add_shapes(dem, 2);
    CHECK_OK(clast_dem_set_wall_material(dem, wall, 2));
    CHECK_OK(clast_dem_add_grains(dem, 2, grain));
    CHECK_OK(clast_dem_step(dem, 100000)); /* 0.1 s */
    const double time = clast_dem_time(dem);
    const double down = WEIGHT * time * sin(SLOPE);
    const double press = WEIGHT * time * cos(SLOPE);
    for (int k = 0; k < 2; ++k) {
        clast_dem_grain g;
        clast_dem_read_grain(dem, k, &g);
        const double speed = g.velocity[0] * cos(SLOPE) - g.velocity[2] * sin(SLOPE);
        CHECK_REL(speed, k == 0 ? 5.0 / 7.0 * down : down - mu[k] * press, 1e-3);
        CHECK_REL(g.angular_velocity[1], (k == 0 ? speed : 2.5 * mu[k] * press) / RADIUS, 1e-3);
    }
    clast_dem_destroy(dem);
    clast_mesh_free(&plate);
}

/* A block of four balls stays while tan(a) < mu, else slides at g (sin(a) - mu cos(a)). */
static void blocks_stay_or_slide_by_their_own_friction(void **state)
{
    (void)state;
    static const double mu[2] = {0.6, 0.4};
    static double centre[4][3] = {{1, 1, 0}, {1, -1, 0}, {-1, -1, 0}, {-1, 1, 0}};
    static double radius[4] = {0.5, 0.5, 0.5, 0.5};
    const clast_spheres four = {.n = 4, .centre = centre, .radius = radius};
    clast_dem_config c = open_air();
    c.friction = 0.1;
    const clast_dem_contact usual = clast_dem_contact_of(&c, true);
    clast_dem_contact table[9];
    clast_shape block = {0};
    clast_mesh plate = {0};
    clast_dem *dem = NULL;
    int32_t wall = 0;
    clast_dem_grain grain[2];
    incline(&plate);
    CHECK_OK(clast_shape_clump("block", &four, &block));
    CHECK_OK(clast_dem_create(&c, &dem));
    CHECK_OK(clast_dem_add_wall(dem, &plate, &wall));
    for (int k = 0; k < 9; ++k) {
        table[k] = usual;
        table[k].friction = k == 2 ? mu[0] : k == 5 ? mu[1] : usual.friction;
    }
    CHECK_OK(clast_dem_set_contacts(dem, 3, table));
    CHECK_OK(clast_dem_set_wall_material(dem, wall, 2));
    for (int k = 0; k < 2; ++k) {
        int32_t id = 0;
        CHECK_OK(clast_dem_add_shape(dem, &block, &id));
        CHECK_OK(clast_dem_set_material(dem, id, k));
        const double high = 0.5 * RADIUS - sunk(&usual);
        grain[k] = ball(id, high * sin(SLOPE), 0.05 * k, high * cos(SLOPE));
        grain[k].orientation[0] = cos(0.5 * SLOPE);
        grain[k].orientation[2] = sin(0.5 * SLOPE);
    }
    CHECK_OK(clast_dem_add_grains(dem, 2, grain));
    CHECK_STATUS(clast_dem_set_material(dem, 1, 0), CLAST_E_USAGE); /* it has a grain */
    CHECK_OK(clast_dem_step(dem, 100000));
    const double time = clast_dem_time(dem);
    for (int k = 0; k < 2; ++k) {
        clast_dem_grain g;
        clast_dem_read_grain(dem, k, &g);
        const double speed = g.velocity[0] * cos(SLOPE) - g.velocity[2] * sin(SLOPE);
        const double slides = WEIGHT * time * (sin(SLOPE) - mu[k] * cos(SLOPE));
        if (k == 0) {
            assert_true(fabs(speed) < 1e-3 * WEIGHT * time);
        } else {
            CHECK_REL(speed, slides, 1e-2);
        }
    }
    clast_dem_destroy(dem);
    clast_shape_free(&block);
    clast_mesh_free(&plate);
}

/* Two balls that meet head on, of materials a and b; what is left of their speed. */
static double rebound(const clast_dem_config *c, const clast_dem_contact table[4], int a, int b,
                      double speed, double *time)
{
    clast_dem *dem = NULL;
    clast_dem_grain grain[2] = {ball(a, -1.001 * RADIUS, 0.0, 0.0),
                                ball(b, 1.001 * RADIUS, 0.0, 0.0)};
    clast_dem_grain g;
    grain[0].velocity[0] = 0.5 * speed;
    grain[1].velocity[0] = -0.5 * speed;
    CHECK_OK(clast_dem_create(c, &dem));
    CHECK_OK(clast_dem_set_contacts(dem, 2, table));
    add_shapes(dem, 2);
    CHECK_OK(clast_dem_add_grains(dem, 2, grain));
    *time = scene_collide(dem, c->time_step);
    clast_dem_read_grain(dem, 1, &g);
    clast_dem_destroy(dem);
    return 2.0 * g.velocity[0] / speed;
}

/* Each pair of materials has its own restitution and, by the linear law, its own time. */
static void pairs_rebound_by_their_own_restitution(void **state)
{
    (void)state;
    static const double e[4] = {0.9, 0.3, 0.3, 0.5};
    static const double collision[4] = {2e-4, 4e-4, 4e-4, 1e-4};
    for (int law = 0; law < 2; ++law) {
        clast_dem_config c = scene_space();
        clast_dem_contact table[4];
        double time = 0.0;
        c.law = law;
        c.time_step = 1e-7;
        for (int k = 0; k < 4; ++k) {
            table[k] = clast_dem_contact_of(&c, false);
            table[k].restitution = e[k];
            table[k].collision_time = collision[k];
        }
        for (int k = 0; k < 4; ++k) {
            CHECK_REL(rebound(&c, table, k / 2, k % 2, 0.1, &time), e[k], 5e-3);
            if (law == CLAST_DEM_LINEAR) {
                CHECK_REL(time, collision[k], 5e-3);
            }
        }
    }
}

/* Hertz's collision without loss takes 2.8683 (m*^2 / (R* E*^2 v))^(1/5) s [Johnson1985 eq. 11.24],
 * 1/E* the sum of both sides' (1 - nu^2) / E. */
static void unlike_moduli_add_their_compliances(void **state)
{
    (void)state;
    const double young[2] = {1e7, 4e7};
    const double poisson[2] = {0.2, 0.35};
    const double speed = 0.1;
    clast_dem_config c = scene_space();
    clast_dem_contact table[4];
    double time = 0.0;
    c.law = CLAST_DEM_HERTZ;
    c.time_step = 1e-7;
    c.restitution = 1.0;
    for (int k = 0; k < 4; ++k) {
        const int side[2] = {k / 2, k % 2};
        table[k] = clast_dem_contact_of(&c, false);
        for (int i = 0; i < 2; ++i) {
            table[k].young[i] = young[side[i]];
            table[k].poisson[i] = poisson[side[i]];
        }
    }
    for (int k = 0; k < 4; ++k) {
        double soft = 0.0;
        const double mass = 0.5 * DENSITY * 4.0 / 3.0 * CLAST_PI * RADIUS * RADIUS * RADIUS;
        for (int i = 0; i < 2; ++i) {
            const double nu = table[k].poisson[i];
            soft += (1.0 - nu * nu) / table[k].young[i];
        }
        CHECK_REL(rebound(&c, table, k / 2, k % 2, speed, &time), 1.0, 1e-3);
        CHECK_REL(time, 2.8683 * pow(mass * mass * soft * soft / (0.5 * RADIUS * speed), 0.2),
                  2e-3);
    }
}

/* A belt takes a ball along by its own friction: at mu g, until it rolls at 2/7 of its speed. */
static void belt_takes_a_ball_along_by_its_own_friction(void **state)
{
    (void)state;
    const double speed = 0.1;
    const double mu = 0.07;
    const double none[3] = {0.0, 0.0, 0.0};
    const clast_dem_wall_motion along = {.velocity = {speed, 0.0, 0.0}};
    clast_dem_config c = open_air();
    clast_dem_contact table[4];
    clast_dem *dem = NULL;
    clast_dem_grain g;
    clast_dem_energy e;
    c.floor = true;
    for (int k = 0; k < 4; ++k) {
        table[k] = clast_dem_contact_of(&c, k % 2 == 1);
        table[k].friction = k == 1 ? mu : c.friction;
    }
    const clast_dem_grain one = ball(0, 0.0, 0.0, RADIUS - sunk(&table[0]) / cos(SLOPE));
    CHECK_OK(clast_dem_create(&c, &dem));
    CHECK_OK(clast_dem_set_contacts(dem, 2, table));
    add_shapes(dem, 1);
    CHECK_OK(clast_dem_watch_walls(dem));
    CHECK_OK(clast_dem_set_wall_material(dem, 0, 1));
    CHECK_OK(clast_dem_set_wall_motion(dem, 0, &along));
    CHECK_OK(clast_dem_drive_wall(dem, 0, true, none));
    CHECK_OK(clast_dem_begin_energy(dem));
    CHECK_OK(clast_dem_add_grains(dem, 1, &one));
    const double rolls = 2.0 / 7.0 * speed / (mu * WEIGHT);
    CHECK_OK(clast_dem_step(dem, (int64_t)(0.5 * rolls / c.time_step)));
    clast_dem_read_grain(dem, 0, &g);
    CHECK_REL(g.velocity[0], mu * WEIGHT * clast_dem_time(dem), 1e-3);
    CHECK_OK(clast_dem_step(dem, (int64_t)(rolls / c.time_step)));
    clast_dem_read_grain(dem, 0, &g);
    clast_dem_energy_measure(dem, &e);
    CHECK_REL(g.velocity[0], 2.0 / 7.0 * speed, 1e-3);
    CHECK_REL(e.walls, 2.0 / 7.0 * speed * speed * DENSITY * 4.0 / 3.0 * CLAST_PI * pow(RADIUS, 3),
              2e-3);
    assert_true(fabs(e.rest) < 1e-10 * (e.walls + fabs(e.gravity)));
    clast_dem_destroy(dem);
}

enum { SIDE = 6, N_BED = SIDE * SIDE * SIDE };

/* Balls of two materials that fall into a box; 0 materials: none are set. */
static clast_dem *fallen(const clast_dem_config *c, int32_t n, const clast_dem_contact *table)
{
    clast_dem_grain grain[N_BED];
    clast_dem *dem = NULL;
    for (int i = 0; i < N_BED; ++i) {
        grain[i] = ball(i % 2, 8e-3 * (i % SIDE - 2.5), 8e-3 * (i / SIDE % SIDE - 2.5),
                        0.012 + 8e-3 * (i / SIDE / SIDE));
        grain[i].velocity[0] = 0.01 * (i % 7);
        grain[i].velocity[2] = -1.0 - 0.2 * (i % 3);
    }
    CHECK_OK(clast_dem_create(c, &dem));
    if (n > 0) {
        CHECK_OK(clast_dem_set_contacts(dem, n, table));
        add_shapes(dem, 2);
    } else {
        clast_shape sphere = {0};
        int32_t id = 0;
        CHECK_OK(clast_shape_sphere("sphere", 1.0, &sphere));
        CHECK_OK(clast_dem_add_shape(dem, &sphere, &id));
        CHECK_OK(clast_dem_add_shape(dem, &sphere, &id));
        clast_shape_free(&sphere);
    }
    CHECK_OK(clast_dem_begin_energy(dem));
    CHECK_OK(clast_dem_add_grains(dem, N_BED, grain));
    return dem;
}

/* Materials that touch as the configuration says change no bit; others do, and the energy book
 * closes. */
static void equal_materials_change_no_bit(void **state)
{
    (void)state;
    for (int kind = 0; kind < 4; ++kind) {
        uint64_t hash[3];
        clast_dem_config c = scene_physics();
        clast_dem_contact table[4];
        c.domain = CLAST_DEM_BOX;
        c.width = 0.05;
        c.fluid_density = 0.0;
        c.law = kind == 1 ? CLAST_DEM_HERTZ : CLAST_DEM_LINEAR;
        c.time_step = kind == 1 ? 2e-6 : c.time_step;
        c.contact_scheme = kind == 2 ? CLAST_DEM_EXACT : CLAST_DEM_EXPLICIT;
        c.rolling_friction = kind == 3 ? 0.1 : 0.0;
        c.rolling_model = kind == 3 ? CLAST_DEM_ROLL_SPRING : CLAST_DEM_ROLL_TORQUE;
        for (int run = 0; run < 3; ++run) {
            for (int k = 0; k < 4; ++k) {
                table[k] = clast_dem_contact_of(&c, false);
                table[k].friction = run == 2 ? 0.1 + 0.2 * k : table[k].friction;
                table[k].restitution = run == 2 ? 0.2 + 0.1 * k : table[k].restitution;
                table[k].rolling_friction =
                    run == 2 && kind == 3 && k == 1 ? 0.0 : c.rolling_friction;
            }
            clast_dem *dem = fallen(&c, run == 0 ? 0 : 2, table);
            clast_dem_energy e;
            CHECK_OK(clast_dem_step(dem, 4000));
            clast_dem_energy_measure(dem, &e);
            assert_true(fabs(e.rest) < 1e-10 * fabs(e.put_in));
            hash[run] = clast_dem_hash(dem);
            clast_dem_destroy(dem);
        }
        assert_true(hash[0] == hash[1]);
        assert_true(hash[0] != hash[2]);
    }
}

static void what_no_contact_has_is_refused(void **state)
{
    (void)state;
    clast_dem_config c = open_air();
    const clast_dem_contact usual = clast_dem_contact_of(&c, false);
    clast_dem *dem = NULL;
    clast_dem_contact bad[7];
    for (int k = 0; k < 7; ++k) {
        bad[k] = usual;
    }
    bad[0].friction = -1.0;
    bad[1].restitution = 0.0;
    bad[2].collision_time = 1e-7; /* the step does not resolve it */
    bad[3].young[1] = 0.0;
    bad[4].poisson[1] = 0.7;
    bad[5].rolling_friction = NAN;
    bad[6].restitution = 1.5;
    CHECK_OK(clast_dem_create(&c, &dem));
    CHECK_STATUS(clast_dem_set_material(dem, 0, 0), CLAST_E_USAGE);
    for (int k = 0; k < 7; ++k) {
        CHECK_STATUS(clast_dem_set_contacts(dem, 1, &bad[k]), CLAST_E_CONFIG);
    }
    CHECK_STATUS(clast_dem_set_contacts(dem, 0, &usual), CLAST_E_USAGE);
    CHECK_OK(clast_dem_set_contacts(dem, 1, &usual));
    CHECK_STATUS(clast_dem_set_contacts(dem, 1, &usual), CLAST_E_USAGE);
    add_shapes(dem, 1);
    CHECK_STATUS(clast_dem_set_material(dem, 0, 1), CLAST_E_USAGE);
    CHECK_STATUS(clast_dem_set_material(dem, 1, 0), CLAST_E_USAGE);
    CHECK_STATUS(clast_dem_set_wall_material(dem, 0, 0), CLAST_E_USAGE);
    clast_dem_destroy(dem);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(balls_roll_or_slide_by_their_own_friction),
        cmocka_unit_test(blocks_stay_or_slide_by_their_own_friction),
        cmocka_unit_test(pairs_rebound_by_their_own_restitution),
        cmocka_unit_test(unlike_moduli_add_their_compliances),
        cmocka_unit_test(belt_takes_a_ball_along_by_its_own_friction),
        cmocka_unit_test(equal_materials_change_no_bit),
        cmocka_unit_test(what_no_contact_has_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
