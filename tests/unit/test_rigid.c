/* Unit: rigid grains of convex parts: mass of the union in closed form, and their mechanics beside
 * a clump of the same spheres. */
#include "support.h"

#include "dem_scenes.h"
#include "math/vec3.h"
#include <clast/mesh_check.h>
#include <clast/rigid.h>

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
            CHECK_ABS(by_parts[i].spin[k], by_clump[i].spin[k], 1e-6);
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
        cmocka_unit_test(refused_memory_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
