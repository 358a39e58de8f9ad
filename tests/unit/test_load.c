/* Unit: the energy book and the periodic cell, against closed forms; what they leave as it was. */
#include "support.h"

#include "dem_scenes.h"
#include "math/rng.h"

static const double RADIUS = 0.0035;
static const double DENSITY = 2650.0;

static clast_dem_grain at(double x, double y, double z)
{
    return (clast_dem_grain){.scale = RADIUS,
                             .density = DENSITY,
                             .position = {x, y, z},
                             .orientation = {1.0, 0.0, 0.0, 0.0}};
}

static clast_dem *balls(const clast_dem_config *config, int32_t n, const clast_dem_grain *grain)
{
    clast_shape sphere = {0};
    CHECK_OK(clast_shape_sphere("sphere", 1.0, &sphere));
    clast_dem *dem = scene_bodies(config, &sphere, n, grain);
    assert_non_null(dem);
    clast_shape_free(&sphere);
    return dem;
}

static double gross(const clast_dem_energy *e)
{
    return fabs(e->made) + fabs(e->gravity) + fabs(e->shaking) + fabs(e->cell);
}

/* m_eff v^2 (1 - e_n^2) / 2 goes into the dashpot of a central collision; what finite steps make of
 * its begin and end is a millionth, and falls with them. */
static void collision_loses_what_restitution_says(void **state)
{
    (void)state;
    double steps[2];
    for (int k = 0; k < 2; ++k) {
        clast_dem_config c = scene_space();
        c.restitution = 0.5;
        c.time_step = c.collision_time / (k == 0 ? 500.0 : 2000.0);
        clast_dem_grain pair[2] = {at(-1.0001 * RADIUS, 0.0, 0.0), at(1.0001 * RADIUS, 0.0, 0.0)};
        pair[0].velocity[0] = 0.3;
        clast_dem *dem = balls(&c, 2, pair);
        CHECK_OK(clast_dem_begin_energy(dem));
        (void)scene_collide(dem, c.time_step);
        clast_dem_energy e = {0};
        clast_dem_energy_measure(dem, &e);
        const double mass = 0.5 * DENSITY * 4.0 / 3.0 * CLAST_PI * RADIUS * RADIUS * RADIUS;
        CHECK_REL(e.put_in, mass * 0.09, 1e-14);
        CHECK_REL(e.damping[0], 0.5 * mass * 0.09 * 0.75, k == 0 ? 5e-3 : 2e-3);
        assert_true(e.friction[0] == 0.0 && e.damping[1] == 0.0 && e.normal_springs == 0.0);
        assert_true(fabs(e.rest) < 1e-12 * e.put_in);
        steps[k] = fabs(e.scheme) / e.put_in;
        clast_dem_destroy(dem);
    }
    assert_true(steps[0] < 1e-5 && steps[1] < steps[0] / 4.0);
}

/* A ball that may not turn by itself slides to rest on a floor: friction takes m v^2 / 2 less what
 * rolling keeps, 2/7 of it. */
static void sliding_ball_loses_two_sevenths(void **state)
{
    (void)state;
    clast_dem_config c = scene_physics();
    c.domain = CLAST_DEM_OPEN;
    c.fluid_density = 0.0;
    c.time_step = c.collision_time / 200.0;
    const double ln = log(c.restitution);
    const double rest =
        9.81 * c.collision_time * c.collision_time / (CLAST_PI * CLAST_PI + ln * ln);
    clast_dem_grain ball = at(0.0, 0.0, RADIUS - rest);
    ball.velocity[0] = 0.2;
    clast_dem *dem = balls(&c, 1, &ball);
    CHECK_OK(clast_dem_begin_energy(dem));
    CHECK_OK(clast_dem_step(dem, 20000));
    clast_dem_energy e = {0};
    clast_dem_energy_measure(dem, &e);
    const double whole = 0.5 * DENSITY * 4.0 / 3.0 * CLAST_PI * RADIUS * RADIUS * RADIUS * 0.04;
    CHECK_REL(e.friction[1] + e.damping[1], 2.0 / 7.0 * whole, 1e-3);
    CHECK_REL(e.friction[1], 2.0 / 7.0 * whole, 2e-3);
    CHECK_REL(e.translation, 25.0 / 49.0 * whole, 1e-3);
    CHECK_REL(e.rotation, 10.0 / 49.0 * whole, 1e-3);
    assert_true(fabs(e.rest) < 1e-10 * gross(&e));
    clast_dem_destroy(dem);
}

/* What a bed is made of, and the laws that hold it. */
typedef struct {
    const char *name;
    scene_body_kind kind;
    clast_dem_law law;
    clast_dem_scheme scheme;
    clast_dem_cohesion cohesion;
    double rolling, viscosity, added_mass, damping;
    bool plain; ///< off: gyroscopic and normal_torque as the reference program has them
} bed;

static const bed beds[] = {
    {"balls", SCENE_BALL, CLAST_DEM_LINEAR, CLAST_DEM_EXPLICIT, CLAST_DEM_DRY, 0, 0, 0, 1, false},
    {"exact", SCENE_OCTAHEDRON, CLAST_DEM_LINEAR, CLAST_DEM_EXACT, CLAST_DEM_DRY, 0, 0, 0, 1,
     false},
    {"cubes", SCENE_CUBE, CLAST_DEM_LINEAR, CLAST_DEM_EXPLICIT, CLAST_DEM_DRY, 0, 0, 0, 0.1, false},
    {"eggs", SCENE_EGG, CLAST_DEM_HERTZ, CLAST_DEM_EXPLICIT, CLAST_DEM_DRY, 0, 0, 0, 1, false},
    {"clumps", SCENE_CLUMP, CLAST_DEM_LINEAR, CLAST_DEM_EXPLICIT, CLAST_DEM_DRY, 0, 0, 0, 1, false},
    {"gems", SCENE_GEMS, CLAST_DEM_LINEAR, CLAST_DEM_EXPLICIT, CLAST_DEM_DRY, 0, 0, 0, 1, false},
    {"sticky", SCENE_BALL, CLAST_DEM_HERTZ, CLAST_DEM_EXPLICIT, CLAST_DEM_JKR, 0, 0, 0, 1, false},
    {"rolling", SCENE_EGG, CLAST_DEM_LINEAR, CLAST_DEM_EXPLICIT, CLAST_DEM_DMT, 0.2, 0, 0, 1,
     false},
    {"wet", SCENE_CUBE, CLAST_DEM_LINEAR, CLAST_DEM_EXPLICIT, CLAST_DEM_DRY, 0, 1e-2, 0.5, 0.1,
     false},
    {"printed", SCENE_CUBE, CLAST_DEM_LINEAR, CLAST_DEM_EXPLICIT, CLAST_DEM_DRY, 0.1, 0, 0, 1,
     true},
};

static clast_dem *pour(const bed *b)
{
    enum { N = 60 };
    clast_dem_grain grain[N];
    clast_shape shape = {0};
    clast_dem_config c = scene_physics();
    c.width = 0.03;
    c.law = b->law;
    c.contact_scheme = b->scheme;
    c.cohesion = b->cohesion;
    c.surface_energy = b->cohesion == CLAST_DEM_DRY ? 0.0 : 0.05;
    c.rolling_friction = b->rolling;
    c.rolling_model = b->rolling > 0.15 ? CLAST_DEM_ROLL_SPRING : CLAST_DEM_ROLL_TORQUE;
    c.fluid_viscosity = b->viscosity;
    c.added_mass = b->added_mass;
    c.normal_torque = !b->plain;
    c.gyroscopic = !b->plain;
    for (int i = 0; i < N; ++i) {
        clx_rng rng = clx_rng_at(5, CLX_STREAM_TEST, (uint64_t)i);
        grain[i] =
            at(0.009 * (i % 2) - 0.0045, 0.009 * (i / 2 % 2) - 0.0045, 0.006 + 0.009 * (i / 4));
        grain[i].scale = 1.0;
        for (int k = 0; k < 3; ++k) {
            grain[i].velocity[k] = 0.3 * (2.0 * clx_rng_uniform(&rng) - 1.0);
            grain[i].spin[k] = 30.0 * (2.0 * clx_rng_uniform(&rng) - 1.0);
        }
        grain[i].velocity[2] -= 1.0;
    }
    CHECK_OK(scene_body(b->kind, &shape));
    clast_dem *dem = scene_bodies(&c, &shape, N, grain);
    assert_non_null(dem);
    clast_shape_free(&shape);
    const clast_dem_drive drive = {3e-4, 0.025, b->damping};
    clast_dem_set_drive(dem, &drive);
    return dem;
}

/* Every kind of body and law: no force is missed, and the run goes its old way bit by bit. */
static void book_closes_on_every_scene(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof beds / sizeof *beds; ++k) {
        clast_dem *plain = pour(&beds[k]);
        clast_dem *booked = pour(&beds[k]);
        CHECK_OK(clast_dem_begin_energy(booked));
        CHECK_OK(clast_dem_step(plain, 6000));
        CHECK_OK(clast_dem_step(booked, 6000));
        assert_true(clast_dem_hash(plain) == clast_dem_hash(booked));
        clast_dem_energy e = {0};
        clast_dem_energy_measure(booked, &e);
        assert_true(fabs(e.rest) < 1e-10 * gross(&e));
        assert_true(e.damping[0] > 0.0 && e.friction[0] > 0.0 && e.friction[1] > 0.0);
        clast_dem_destroy(plain);
        clast_dem_destroy(booked);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(collision_loses_what_restitution_says),
        cmocka_unit_test(sliding_ball_loses_two_sevenths),
        cmocka_unit_test(book_closes_on_every_scene),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
