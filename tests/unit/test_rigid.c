/* Unit: rigid grains of convex parts: mass of the union in closed form, and their mechanics beside
 * a clump of the same spheres. */
#include "support.h"

#include "dem/dem.h"
#include "dem_scenes.h"
#include "math/vec3.h"
#include <clast/assembly.h>
#include <clast/machine.h>
#include <clast/mesh_repair.h>
#include <clast/settling.h>

static const clast_rigid_options AS_THEY_ARE = {.hull = false};
static const double UNTURNED[4] = {1.0, 0.0, 0.0, 0.0};

/* Two grains of one shape at +-x, the second turned. */
static void place_two(const clast_shape *shape, double x, const double turn[4], clast_assembly *a)
{
    int32_t id = 0;
    CHECK_OK(clast_assembly_add_shape(a, shape, &id));
    CHECK_OK(clast_assembly_add_grain(a, id, (const double[3]){x, 0.0, 0.0}, UNTURNED, 1.0, 1.0));
    CHECK_OK(clast_assembly_add_grain(a, id, (const double[3]){-x, 0.0, 0.0}, turn, 1.0, 1.0));
}

/* Two ellipsoids that touch: volumes and moments add up. */
static void parts_that_touch_are_summed_exactly(void **state)
{
    (void)state;
    const double s[3] = {3.0, 2.0, 1.0};
    clast_shape egg = {0};
    clast_shape pair = {0};
    clast_assembly a = {0};
    double added = -1.0;
    CHECK_OK(clast_shape_ellipsoid("egg", s, &egg));
    place_two(&egg, 3.0, UNTURNED, &a);
    CHECK_OK(clast_assembly_rigid(&a, "pair", &AS_THEY_ARE, &pair, &added));
    const double v = 4.0 / 3.0 * CLAST_PI * s[0] * s[1] * s[2];
    CHECK_REL(pair.volume, 2.0 * v, 1e-14);
    CHECK_REL(pair.inertia[0][0], 2.0 * v * (4.0 + 1.0) / 5.0, 1e-14);
    CHECK_REL(pair.inertia[1][1], 2.0 * v * ((9.0 + 1.0) / 5.0 + 9.0), 1e-14);
    CHECK_REL(pair.inertia[2][2], 2.0 * v * ((9.0 + 4.0) / 5.0 + 9.0), 1e-14);
    CHECK_ABS(pair.inertia[0][1], 0.0, 1e-12);
    CHECK_REL(pair.bounding_radius, 6.0, 1e-11);
    CHECK_REL(clast_mesh_volume(&pair.mesh), pair.volume, 1e-12); /* its surfaces hold as much */
    assert_int_equal(pair.parts.n, 2);
    assert_true(isnan(added)); /* no surface, no hull */
    clast_shape_free(&pair);
    clast_shape_free(&egg);
    clast_assembly_free(&a);
}

/* Spheres that overlap, against the clump of them, whose union is summed in closed form: what
 * differs is the midpoint rule over the part in common, 1e-4 of that. */
static void overlapping_spheres_have_the_mass_of_their_clump(void **state)
{
    (void)state;
    const double radius[3] = {1.0, 0.8, 0.6};
    const double centre[3][3] = {{0.0, 0.0, 0.0}, {0.9, 0.4, 0.1}, {0.5, -0.2, 0.7}};
    clast_spheres balls = {0};
    clast_shape clump = {0};
    clast_shape rigid = {0};
    clast_shape ball = {0};
    clast_assembly a = {0};
    int32_t id = 0;
    CHECK_OK(clast_spheres_alloc(3, &balls));
    CHECK_OK(clast_shape_sphere("ball", 1.0, &ball));
    CHECK_OK(clast_assembly_add_shape(&a, &ball, &id));
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
        v3_copy(balls.centre[i], centre[i]);
        balls.radius[i] = radius[i];
        sum += 4.0 / 3.0 * CLAST_PI * radius[i] * radius[i] * radius[i];
        CHECK_OK(clast_assembly_add_grain(&a, id, centre[i], UNTURNED, radius[i], 1.0));
    }
    CHECK_OK(clast_shape_clump("clump", &balls, &clump));
    CHECK_OK(clast_assembly_rigid(&a, "rigid", &AS_THEY_ARE, &rigid, NULL));
    const double common = sum - clump.volume;
    assert_true(common > 0.3);
    CHECK_ABS(rigid.volume, clump.volume, 1e-4 * common);
    for (int i = 0; i < 3; ++i) {
        CHECK_ABS(rigid.source_origin[i], clump.source_origin[i], 1e-4 * common);
        for (int k = 0; k < 3; ++k) {
            CHECK_ABS(rigid.inertia[i][k], clump.inertia[i][k], 2e-4 * common);
        }
    }
    CHECK_REL(rigid.bounding_radius, clump.bounding_radius, 1e-4);
    clast_spheres_free(&balls);
    clast_shape_free(&clump);
    clast_shape_free(&rigid);
    clast_shape_free(&ball);
    clast_assembly_free(&a);
}

/* Two cubes of side 2, one turned by 45 degrees about x and both 1.5 apart: they share a prism of
 * length 0.5 over a regular octagon of area 8 (sqrt(2) - 1). */
static void overlapping_cubes_share_an_octagon(void **state)
{
    (void)state;
    clast_mesh box = {0};
    clast_shape cube = {0};
    clast_shape pair = {0};
    clast_assembly a = {0};
    const double half = CLAST_PI / 8.0;
    CHECK_OK(clast_mesh_box(2.0, 2.0, 2.0, &box));
    CHECK_OK(clast_shape_mesh("cube", &box, &cube));
    place_two(&cube, 0.75, (const double[4]){cos(half), sin(half), 0.0, 0.0}, &a);
    CHECK_OK(clast_assembly_rigid(&a, "pair", &AS_THEY_ARE, &pair, NULL));
    const double common = 0.5 * 8.0 * (sqrt(2.0) - 1.0);
    CHECK_ABS(pair.volume, 16.0 - common, 1e-4 * common);
    /* about x: each cube 8 (1 + 1) / 3; the octagon's polar moment is A (1 + tan^2(pi / 8) / 3) / 2
     * for an inner radius of 1 */
    const double polar = common * 0.5 * (1.0 + tan(half) * tan(half) / 3.0);
    CHECK_ABS(pair.inertia[0][0], 2.0 * 16.0 / 3.0 - polar, 1e-4 * common);
    clast_mesh_free(&box);
    clast_shape_free(&cube);
    clast_shape_free(&pair);
    clast_assembly_free(&a);
}

/* A surface with a dent becomes its hull, and says what that adds; as it is it is no grain. */
static void surfaces_become_hulls(void **state)
{
    (void)state;
    const clast_rigid_options hull = {.hull = true};
    const clast_dem_config c = scene_space();
    clast_mesh box = {0};
    clast_mesh dented = {0};
    clast_shape shape = {0};
    clast_shape pair = {0};
    clast_shape egg = {0};
    clast_assembly a = {0};
    clast_dem *dem = NULL;
    int32_t id = 0;
    double added = 0.0;
    /* a pyramid of volume 2/3 whose base is pushed in by half its height */
    const double vert[6][3] = {{1, 0, 0},  {0, 1, 0},    {-1, 0, 0},
                               {0, -1, 0}, {0, 0, -0.5}, {0, 0, -1}};
    const int32_t tri[8][3] = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4},
                               {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
    CHECK_OK(clast_mesh_alloc(6, 8, &dented));
    for (int i = 0; i < 8; ++i) {
        for (int k = 0; k < 3; ++k) {
            dented.tri[i][k] = tri[i][k];
            if (i < 6) {
                dented.vert[i][k] = vert[i][k];
            }
        }
    }
    CHECK_OK(clast_shape_mesh("dented", &dented, &shape));
    CHECK_OK(clast_shape_ellipsoid("egg", (const double[3]){1.0, 0.5, 0.5}, &egg));
    CHECK_OK(clast_assembly_add_shape(&a, &shape, &id));
    CHECK_OK(
        clast_assembly_add_grain(&a, id, (const double[3]){5.0, 1.0, 2.0}, UNTURNED, 2.0, 1.0));
    CHECK_OK(clast_assembly_add_shape(&a, &egg, &id));
    CHECK_OK(
        clast_assembly_add_grain(&a, id, (const double[3]){0.0, 0.0, 0.0}, UNTURNED, 1.0, 1.0));
    CHECK_OK(clast_assembly_rigid(&a, "both", &hull, &pair, &added));
    CHECK_REL(added, 1.0, 1e-12); /* 1/3 becomes 2/3 */
    CHECK_REL(pair.volume, 8.0 * 2.0 / 3.0 + CLAST_PI / 3.0, 1e-12);
    CHECK_OK(clast_dem_create(&c, &dem));
    CHECK_OK(clast_dem_add_shape(dem, &pair, &id));
    clast_shape_free(&pair);
    CHECK_OK(clast_assembly_rigid(&a, "as they are", &AS_THEY_ARE, &pair, &added));
    CHECK_REL(added, 0.0, 0.0);
    CHECK_STATUS(clast_dem_add_shape(dem, &pair, &id), CLAST_E_GEOMETRY);
    clast_dem_destroy(dem);
    clast_mesh_free(&box);
    clast_mesh_free(&dented);
    clast_shape_free(&shape);
    clast_shape_free(&pair);
    clast_shape_free(&egg);
    clast_assembly_free(&a);
}

/// Where a dumb-bell is after a skew meeting with another and a fall on the floor.
static void meet(const clast_shape *shape, clast_dem_grain out[2])
{
    clast_dem_config c = scene_physics();
    c.domain = CLAST_DEM_OPEN;
    clast_dem_grain g[2] = {{.scale = 1.0, .density = 2650.0, .orientation = {1.0}},
                            {.scale = 1.0, .density = 2650.0, .orientation = {0.8, 0.0, 0.0, 0.6}}};
    g[0].position[2] = 4e-3;
    g[1].position[0] = 1e-3;
    g[1].position[1] = 0.5e-3;
    g[1].position[2] = 9e-3;
    g[0].velocity[2] = 0.3;
    clast_dem *dem = scene_bodies(&c, shape, 2, g);
    assert_non_null(dem);
    CHECK_OK(clast_dem_step(dem, 3000));
    clast_dem_measures m;
    clast_dem_measure(dem, &m);
    assert_true(m.n_wall_contact > 0 || m.n_contact > 0);
    for (int k = 0; k < 2; ++k) {
        clast_dem_read_grain(dem, k, &out[k]);
    }
    clast_dem_destroy(dem);
}

/* The same spheres as a clump and as parts go the same way: other code finds their mass and their
 * contacts, so rounding differs, which two meetings make 1e3 times larger. */
static void rigid_spheres_go_the_way_of_a_clump(void **state)
{
    (void)state;
    clast_shape clump = {0};
    clast_shape rigid = {0};
    clast_shape ball = {0};
    clast_assembly a = {0};
    clast_dem_grain by_clump[2], by_parts[2];
    CHECK_OK(scene_body(SCENE_CLUMP, &clump));
    CHECK_OK(clast_shape_sphere("ball", 2e-3, &ball));
    place_two(&ball, 2e-3, UNTURNED, &a);
    CHECK_OK(clast_assembly_rigid(&a, "rigid", &AS_THEY_ARE, &rigid, NULL));
    meet(&clump, by_clump);
    meet(&rigid, by_parts);
    for (int i = 0; i < 2; ++i) {
        for (int k = 0; k < 3; ++k) {
            CHECK_ABS(by_parts[i].position[k], by_clump[i].position[k], 1e-12);
            CHECK_ABS(by_parts[i].velocity[k], by_clump[i].velocity[k], 1e-9);
            CHECK_ABS(by_parts[i].angular_velocity[k], by_clump[i].angular_velocity[k], 1e-6);
        }
    }
    clast_shape_free(&clump);
    clast_shape_free(&rigid);
    clast_shape_free(&ball);
    clast_assembly_free(&a);
}

/* An ellipsoid as the one part of a rigid grain, its axes turned in the grain's frame, collides
 * like the ellipsoid itself in that pose. */
static void turned_part_is_where_it_looks(void **state)
{
    (void)state;
    const double turn[4] = {0.8, 0.0, 0.6, 0.0};
    clast_shape egg = {0};
    clast_shape rigid = {0};
    clast_assembly a = {0};
    int32_t id = 0;
    double z[2];
    CHECK_OK(scene_body(SCENE_EGG, &egg));
    CHECK_OK(clast_assembly_add_shape(&a, &egg, &id));
    CHECK_OK(clast_assembly_add_grain(&a, id, (const double[3]){1.0, 2.0, 3.0}, turn, 1.0, 1.0));
    CHECK_OK(clast_assembly_rigid(&a, "rigid", &AS_THEY_ARE, &rigid, NULL));
    for (int k = 0; k < 2; ++k) {
        clast_dem_config c = scene_physics();
        c.domain = CLAST_DEM_OPEN;
        clast_dem_grain g = {.scale = 1.0, .density = 2650.0, .orientation = {1.0}};
        g.position[2] = 5e-3;
        for (int i = 0; i < 4 && k == 0; ++i) {
            g.orientation[i] = turn[i];
        }
        clast_dem *dem = scene_bodies(&c, k == 0 ? &egg : &rigid, 1, &g);
        assert_non_null(dem);
        CHECK_OK(clast_dem_step(dem, 8000));
        clast_dem_read_grain(dem, 0, &g);
        z[k] = g.position[2];
        clast_dem_destroy(dem);
    }
    CHECK_ABS(z[1], z[0], 1e-11);
    assert_true(z[0] < 4e-3);
    clast_shape_free(&egg);
    clast_shape_free(&rigid);
    clast_assembly_free(&a);
}

static const double DUMB_BELL[2] = {3000.0, 1000.0}; /* [kg/m3] */

/* Two balls of radius 2 mm end to end along x, the one at +x three times as heavy. */
static void two_densities(clast_shape *shape)
{
    clast_shape ball = {0};
    clast_assembly a = {0};
    int32_t id = 0;
    CHECK_OK(clast_shape_sphere("ball", 2e-3, &ball));
    CHECK_OK(clast_assembly_add_shape(&a, &ball, &id));
    for (int k = 0; k < 2; ++k) {
        const double x[3] = {k == 0 ? 2e-3 : -2e-3, 0.0, 0.0};
        CHECK_OK(clast_assembly_add_grain(&a, id, x, UNTURNED, 1.0, DUMB_BELL[k]));
    }
    CHECK_OK(clast_assembly_rigid(&a, "bell", &AS_THEY_ARE, shape, NULL));
    clast_shape_free(&ball);
    clast_assembly_free(&a);
}

/* Its mass is in closed form: centre at (3 - 1) / 4 of 2 mm; about it 2/5 m r^2 along x, and the
 * reduced mass at 4 mm more across. What is geometry does not see it. */
static void dumb_bell_of_two_densities_has_its_centre_and_moments(void **state)
{
    (void)state;
    clast_shape bell = {0};
    two_densities(&bell);
    const double v = 4.0 / 3.0 * CLAST_PI * 8e-9;
    const double mean = 2000.0;
    const double along = 0.4 * v * 4e-6 * (3000.0 + 1000.0);
    const double across = along + v * 750.0 * 16e-6;
    assert_true(bell.own.is_mixed);
    CHECK_REL(bell.own.density, mean, 1e-14);
    CHECK_REL(bell.own.centre[0], 1e-3, 1e-13);
    CHECK_ABS(bell.own.centre[1], 0.0, 1e-16);
    CHECK_REL(bell.own.inertia[0][0], along / mean, 1e-13);
    CHECK_REL(bell.own.inertia[1][1], across / mean, 1e-13);
    CHECK_REL(bell.own.inertia[2][2], across / mean, 1e-13);
    CHECK_REL(bell.inertia[1][1], 2.0 * (0.4 * v * 4e-6 + v * 4e-6), 1e-13); /* at unit density */
    CHECK_ABS(bell.source_origin[0], 0.0, 1e-16);
    clast_shape_free(&bell);
}

/* A ball of radius 1 within one of radius 2 about the same point: what both have is of the first,
 * so a core keeps its place in a coating, and a coating named first has all. */
static void core_keeps_its_place_in_its_coating(void **state)
{
    (void)state;
    const double v = 4.0 / 3.0 * CLAST_PI;
    clast_shape ball = {0};
    CHECK_OK(clast_shape_sphere("ball", 1.0, &ball));
    for (int first = 0; first < 2; ++first) {
        clast_assembly a = {0};
        clast_shape rigid = {0};
        const double at[3] = {0.3, 0.2, 0.1};
        const double *where[2] = {at, at};
        int32_t id = 0;
        CHECK_OK(clast_assembly_add_shape(&a, &ball, &id));
        for (int k = 0; k < 2; ++k) {
            const bool is_core = k == first;
            CHECK_OK(clast_assembly_add_grain(&a, id, where[k], UNTURNED, is_core ? 1.0 : 2.0,
                                              is_core ? 5.0 : 1.0));
        }
        CHECK_OK(clast_assembly_rigid(&a, "egg", &AS_THEY_ARE, &rigid, NULL));
        const double mass = first == 0 ? 5.0 * v + 7.0 * v : 8.0 * v;
        const double moment = 0.4 * (first == 0 ? 32.0 * v + 4.0 * v : 32.0 * v);
        CHECK_REL(rigid.volume, 8.0 * v, 1e-4);
        CHECK_REL(rigid.own.density * rigid.volume, mass, 1e-4);
        CHECK_ABS(v3_norm(rigid.own.centre), 0.0, 1e-4);
        CHECK_REL(rigid.own.inertia[0][0] * rigid.own.density, moment, 2e-4);
        clast_shape_free(&rigid);
        clast_assembly_free(&a);
    }
    clast_shape_free(&ball);
}

static clast_dem_grain bell_at(double x, double angle)
{
    clast_dem_grain g = {.scale = 1.0, .density = 2000.0};
    g.orientation[0] = cos(0.5 * angle);
    g.orientation[2] = sin(0.5 * angle); /* about y: x goes to -z */
    g.position[0] = x;
    return g;
}

/* Its surface is where it belongs about the centre of mass, 3 mm below it with the heavy end down
 * and 5 mm with the light one; an assembly has the centre of volume, 1 mm above or below. */
static void two_densities_are_where_they_look(void **state)
{
    (void)state;
    clast_shape bell = {0};
    clast_dem_config c = scene_space();
    two_densities(&bell);
    c.floor = true;
    for (int k = 0; k < 2; ++k) {
        clast_dem_grain g = bell_at(0.0, k == 0 ? 0.5 * CLAST_PI : -0.5 * CLAST_PI);
        clast_dem_measures m;
        clast_assembly a = {0};
        g.position[2] = (k == 0 ? 3e-3 : 5e-3) - 1e-6;
        clast_dem *dem = scene_bodies(&c, &bell, 1, &g);
        assert_non_null(dem);
        CHECK_OK(clast_dem_assembly(dem, &a));
        CHECK_ABS(a.position[0][2], 4e-3 - 1e-6, 1e-12);
        CHECK_OK(clast_dem_step(dem, 1));
        clast_dem_measure(dem, &m);
        CHECK_REL(m.max_overlap, 1e-6, 0.05);
        clast_assembly_free(&a);
        clast_dem_destroy(dem);
    }
    clast_shape_free(&bell);
}

/* In a fluid it is a pendulum: buoyancy acts 1 mm from the centre of mass. Let go level it begins
 * to turn at rho_f V g e / I and to fall at (1 - rho_f / rho) g; let go 0.01 off hanging, it hangs
 * after a quarter of 2 pi sqrt(I / (rho_f V g e)). No energy is lost. */
static void heavy_end_swings_down_in_a_fluid(void **state)
{
    (void)state;
    clast_shape bell = {0};
    clast_dem_config c = scene_space();
    clast_dem_grain out;
    clast_dem_measures m[2];
    two_densities(&bell);
    c.gravity = 10.0;
    c.fluid_density = 1000.0;
    const double moment = c.fluid_density * bell.volume * c.gravity * 1e-3;
    const double inertia = 2000.0 * bell.own.inertia[1][1];
    const double dt = c.time_step;
    const int64_t quarter = (int64_t)(0.5 * CLAST_PI * sqrt(inertia / moment) / dt + 0.5);
    for (int k = 0; k < 2; ++k) {
        const clast_dem_grain g = bell_at(0.0, k == 0 ? 0.0 : 0.5 * CLAST_PI - 0.01);
        clast_dem *dem = scene_bodies(&c, &bell, 1, &g);
        assert_non_null(dem);
        clast_dem_measure(dem, &m[0]);
        CHECK_OK(clast_dem_step(dem, k == 0 ? 100 : quarter));
        clast_dem_measure(dem, &m[1]);
        clast_dem_read_grain(dem, 0, &out);
        const double time = clast_dem_time(dem);
        CHECK_REL(-out.velocity[2], 0.5 * c.gravity * time, 1e-12);
        const double before = m[0].kinetic_energy + m[0].potential_energy;
        const double after = m[1].kinetic_energy + m[1].potential_energy;
        /* semi-implicit: half a step behind */
        CHECK_ABS(after, before, 2.0 * dt / time * m[1].kinetic_energy);
        if (k == 0) { /* levers change by the square of 0.5 alpha t^2 = 1e-5 */
            CHECK_REL(out.angular_velocity[1], moment / inertia * time, 1e-6);
        } else {
            const double angle = 2.0 * atan2(out.orientation[2], out.orientation[0]);
            CHECK_ABS(angle, 0.5 * CLAST_PI, 0.01 * CLAST_PI / (double)quarter);
        }
        clast_dem_destroy(dem);
    }
    clast_shape_free(&bell);
}

/* About its axis and across it the spin dies out by its own moment, in the exact steps of Stokes'
 * torque on the sphere of its volume, with momentum or spin as the state. */
static void its_spin_dies_out(void **state)
{
    (void)state;
    clast_shape bell = {0};
    clast_dem_config c = scene_space();
    two_densities(&bell);
    c.fluid_viscosity = 0.02;
    const double torque = 8.0 * CLAST_PI * 0.02 * 0.75 / CLAST_PI * bell.volume;
    for (int k = 0; k < 6; ++k) {
        const int axis = k % 3;
        const double share = c.time_step * torque / (2000.0 * bell.own.inertia[axis][axis]);
        clast_dem_grain g = bell_at(0.0, 0.0);
        c.gyroscopic = k < 3;
        g.angular_velocity[axis] = 5.0;
        clast_dem *dem = scene_bodies(&c, &bell, 1, &g);
        assert_non_null(dem);
        CHECK_OK(clast_dem_step(dem, 2000));
        clast_dem_read_grain(dem, 0, &g);
        CHECK_REL(g.angular_velocity[axis], 5.0 * pow(1.0 + share, -2000.0), 1e-9);
        assert_true(g.angular_velocity[axis] < 4.9);
        clast_dem_destroy(dem);
    }
    clast_shape_free(&bell);
}

/* In oil it comes to rest heavy end down, where without the torque it swings for ever. */
static void it_stops_swinging_in_oil(void **state)
{
    (void)state;
    clast_shape bell = {0};
    clast_dem_config c = scene_space();
    clast_dem_grain g = bell_at(0.0, 0.0);
    two_densities(&bell);
    c.gravity = 10.0;
    c.fluid_density = 1000.0;
    c.fluid_viscosity = 0.1;
    clast_dem *dem = scene_bodies(&c, &bell, 1, &g);
    assert_non_null(dem);
    CHECK_OK(clast_dem_step(dem, (int64_t)(1.0 / c.time_step)));
    clast_dem_read_grain(dem, 0, &g);
    CHECK_ABS(2.0 * atan2(g.orientation[2], g.orientation[0]), 0.5 * CLAST_PI, 1e-4);
    CHECK_ABS(v3_norm(g.angular_velocity), 0.0, 1e-3);
    clast_dem_destroy(dem);
    clast_shape_free(&bell);
}

/* Falling heavy end down it comes to the speed at which drag carries mass less buoyancy; a step
 * takes the coefficient of the speed before its drag, 2 % more, which inertia's share of drag
 * feels. */
static void it_sinks_at_its_own_weight(void **state)
{
    (void)state;
    clast_shape bell = {0};
    clast_dem_config c = scene_space();
    clast_dem_grain g = bell_at(0.0, 0.5 * CLAST_PI);
    two_densities(&bell);
    c.gravity = 10.0;
    c.fluid_density = 1000.0;
    c.fluid_viscosity = 10.0; /* Re = 1e-3 or so */
    clast_dem *dem = scene_bodies(&c, &bell, 1, &g);
    assert_non_null(dem);
    CHECK_OK(clast_dem_step(dem, 20000));
    clast_dem_read_grain(dem, 0, &g);
    clast_drag drag;
    const double d = cbrt(6.0 * bell.volume / CLAST_PI);
    const double *s = bell.semi_axes;
    CHECK_OK(clast_drag_of_form(s[0], s[1], s[2], 0.5 * d, 2.0, &drag));
    const double speed = -g.velocity[2];
    const double re = 1000.0 * speed * d / 10.0;
    const double carried =
        CLAST_PI / 8.0 * 1000.0 * d * d * speed * speed * clast_drag_coefficient(&drag, re);
    CHECK_REL(carried, 1000.0 * bell.volume * 10.0, 1e-4);
    CHECK_ABS(v3_norm(g.angular_velocity), 0.0, 1e-9);
    clast_dem_destroy(dem);
    clast_shape_free(&bell);
}

static void momenta(const clast_dem *dem, double moment[3], double angular[3])
{
    v3_set(moment, 0.0, 0.0, 0.0);
    v3_set(angular, 0.0, 0.0, 0.0);
    for (int i = 0; i < 2; ++i) {
        const clx_grain *g = &dem->grain[i];
        double arm[3];
        v3_axpy(moment, moment, g->mass, g->velocity);
        v3_cross(arm, g->position, g->velocity);
        v3_axpy(angular, angular, g->mass, arm);
        v3_add(angular, angular, dem->motion[i].angular);
    }
}

/* Off centre, of unequal size and heavy ends first: momentum and angular momentum are kept to
 * rounding, and each has changed. */
static void unequal_ones_keep_their_momenta(void **state)
{
    (void)state;
    clast_shape bell = {0};
    const clast_dem_config c = scene_space();
    clast_dem_grain g[2] = {bell_at(-6e-3, 0.3), bell_at(6e-3, 2.0)};
    double p[2][3], l[2][3];
    two_densities(&bell);
    g[1].scale = 1.4;
    g[1].position[1] = 1e-3;
    g[0].velocity[0] = 1.0;
    g[1].velocity[0] = -1.0;
    clast_dem *dem = scene_bodies(&c, &bell, 2, g);
    assert_non_null(dem);
    momenta(dem, p[0], l[0]);
    assert_true(scene_collide(dem, c.time_step) > 0.0);
    momenta(dem, p[1], l[1]);
    for (int k = 0; k < 3; ++k) {
        CHECK_ABS(p[1][k], p[0][k], 1e-13 * dem->grain[0].mass);
        CHECK_ABS(l[1][k], l[0][k], 1e-13 * dem->grain[0].mass * 1e-2);
    }
    assert_true(dem->grain[0].velocity[0] < 0.5);
    clast_dem_destroy(dem);
    clast_shape_free(&bell);
}

/* 1600 of them give the same bytes for any number of threads. */
static void threads_change_no_bit_of_two_densities(void **state)
{
    (void)state;
    clast_shape bell = {0};
    uint64_t hash[3];
    clast_dem_grain *g = test_calloc(1600, sizeof *g);
    clast_dem_config c = scene_physics();
    c.domain = CLAST_DEM_PERIODIC;
    c.width = 0.11;
    c.fluid_viscosity = 1e-3;
    two_densities(&bell);
    for (int i = 0; i < 1600; ++i) {
        const int row = i / 10 % 10;
        const int layer = i / 100;
        g[i] = bell_at((i % 10) * 1.1e-2 - 0.05, 0.1 * i);
        g[i].position[1] = row * 1.1e-2 - 0.05;
        g[i].position[2] = 5.1e-3 + layer * 10.2e-3;
        g[i].velocity[2] = -1.0 - 5e-3 * (i % 97);
    }
    for (int k = 0; k < 3; ++k) {
        clast_dem_measures m;
        clast_parallel_set_threads(1 << k);
        clast_dem *dem = scene_bodies(&c, &bell, 1600, g);
        assert_non_null(dem);
        CHECK_OK(clast_dem_step(dem, 300));
        clast_dem_measure(dem, &m);
        assert_true(m.n_contact + m.n_wall_contact > 0);
        hash[k] = clast_dem_hash(dem);
        clast_dem_destroy(dem);
    }
    clast_parallel_set_threads(1);
    assert_true(hash[0] == hash[1] && hash[0] == hash[2]);
    test_free(g);
    clast_shape_free(&bell);
}

static clast_status make(void *context)
{
    clast_shape shape = {0};
    clast_dem *dem = NULL;
    int32_t id = 0;
    const clast_dem_config c = scene_space();
    (void)context;
    clast_status status = scene_body(SCENE_BRICKS, &shape);
    status = status == CLAST_OK ? clast_dem_create(&c, &dem) : status;
    status = status == CLAST_OK ? clast_dem_add_shape(dem, &shape, &id) : status;
    const clast_dem_grain g = {.shape = id, .scale = 1.0, .density = 1.0, .orientation = {1.0}};
    status = status == CLAST_OK ? clast_dem_add_grains(dem, 1, &g) : status;
    clast_shape_free(&shape);
    clast_dem_destroy(dem);
    return status;
}

static void refused_memory_leaves_nothing(void **state)
{
    (void)state;
    support_refuse_each_allocation(make, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_that_touch_are_summed_exactly),
        cmocka_unit_test(overlapping_spheres_have_the_mass_of_their_clump),
        cmocka_unit_test(overlapping_cubes_share_an_octagon),
        cmocka_unit_test(surfaces_become_hulls),
        cmocka_unit_test(rigid_spheres_go_the_way_of_a_clump),
        cmocka_unit_test(turned_part_is_where_it_looks),
        cmocka_unit_test(dumb_bell_of_two_densities_has_its_centre_and_moments),
        cmocka_unit_test(core_keeps_its_place_in_its_coating),
        cmocka_unit_test(two_densities_are_where_they_look),
        cmocka_unit_test(heavy_end_swings_down_in_a_fluid),
        cmocka_unit_test(its_spin_dies_out),
        cmocka_unit_test(it_stops_swinging_in_oil),
        cmocka_unit_test(it_sinks_at_its_own_weight),
        cmocka_unit_test(unequal_ones_keep_their_momenta),
        cmocka_unit_test(threads_change_no_bit_of_two_densities),
        cmocka_unit_test(refused_memory_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
