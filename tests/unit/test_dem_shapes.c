/* Unit: closed forms of bodies that are no spheres: collisions of every pair kind, free rotation,
 * weight on a floor, refusals. */
#include "support.h"

#include "dem_scenes.h"
#include "math/vec3.h"
#include <string.h>

static const double DENSITY = 2650.0;

/* Head on along x, through both centres: e_n and T_c, whatever the kinds. */
static void every_pair_kind_has_its_restitution_and_duration(void **state)
{
    (void)state;
    for (int a = 0; a < N_SCENE_BODY; ++a) {
        for (int b = a; b < N_SCENE_BODY; ++b) {
            const scene_body_kind kind[2] = {(scene_body_kind)a, (scene_body_kind)b};
            if ((scene_is_flat(kind[0]) && scene_is_flat(kind[1])) ||
                (scene_is_pointed(kind[0]) && scene_is_pointed(kind[1]))) {
                continue;
            }
            clast_dem_config c = scene_space();
            c.restitution = 0.3;
            c.time_step = c.collision_time / 1000.0;
            clast_dem *dem = NULL;
            clast_shape shape[2] = {{0}, {0}};
            int32_t id[2];
            CHECK_OK(clast_dem_create(&c, &dem));
            CHECK_OK(scene_body(kind[0], &shape[0]));
            CHECK_OK(clast_dem_add_shape(dem, &shape[0], &id[0]));
            id[1] = id[0];
            if (a != b) {
                CHECK_OK(scene_body(kind[1], &shape[1]));
                CHECK_OK(clast_dem_add_shape(dem, &shape[1], &id[1]));
            }
            clast_dem_grain g[2] = {
                {.shape = id[0], .scale = 1.0, .density = DENSITY, .orientation = {1.0}},
                {.shape = id[1], .scale = 1.0, .density = DENSITY, .orientation = {1.0}}};
            g[0].position[0] = -4.0001e-3;
            g[1].position[0] = 4.0001e-3;
            g[0].velocity[0] = 0.05;
            CHECK_OK(clast_dem_add_grains(dem, 2, g));
            CHECK_REL(scene_collide(dem, c.time_step), c.collision_time, 4e-3);
            clast_dem_read_grain(dem, 0, &g[0]);
            clast_dem_read_grain(dem, 1, &g[1]);
            CHECK_REL((g[1].velocity[0] - g[0].velocity[0]) / 0.05, 0.3, 2.0 * 1.2 / 1000.0 + 1e-3);
            clast_dem_destroy(dem);
            clast_shape_free(&shape[0]);
            clast_shape_free(&shape[1]);
        }
    }
}

static void every_kind_bounces_off_walls(void **state)
{
    (void)state;
    for (int k = 0; k < N_SCENE_BODY; ++k) {
        for (int wall = 0; wall < 2; ++wall) {
            if (scene_is_flat((scene_body_kind)k)) {
                continue;
            }
            clast_dem_config c = scene_space();
            c.domain = wall == 0 ? CLAST_DEM_BOX : CLAST_DEM_CYLINDER;
            c.width = 0.04;
            c.restitution = 0.3;
            c.time_step = c.collision_time / 1000.0;
            clast_dem *dem = NULL;
            clast_shape shape = {0};
            int32_t id = 0;
            CHECK_OK(clast_dem_create(&c, &dem));
            CHECK_OK(scene_body((scene_body_kind)k, &shape));
            CHECK_OK(clast_dem_add_shape(dem, &shape, &id));
            clast_dem_grain g = {.scale = 1.0, .density = DENSITY, .orientation = {1.0}};
            g.position[0] = 0.02 - 4.0001e-3;
            g.velocity[0] = 0.05;
            CHECK_OK(clast_dem_add_grains(dem, 1, &g));
            CHECK_REL(scene_collide(dem, c.time_step), c.collision_time, 4e-3);
            clast_dem_read_grain(dem, 0, &g);
            CHECK_REL(-g.velocity[0] / 0.05, 0.3, 2.0 * 1.2 / 1000.0 + 1e-3);
            clast_dem_destroy(dem);
            clast_shape_free(&shape);
        }
    }
}

/* A free body about its middle axis tumbles; momentum stays to rounding, energy to (w dt)^2. */
static void free_body_keeps_momentum_and_energy(void **state)
{
    (void)state;
    const double axes[3] = {4e-3, 3e-3, 2e-3};
    for (int plain = 0; plain < 2; ++plain) {
        clast_dem_config c = scene_space();
        c.gyroscopic = plain == 0;
        clast_dem *dem = NULL;
        clast_shape shape = {0};
        int32_t id = 0;
        CHECK_OK(clast_dem_create(&c, &dem));
        CHECK_OK(clast_shape_ellipsoid("egg", axes, &shape));
        CHECK_OK(clast_dem_add_shape(dem, &shape, &id));
        clast_dem_grain g = {.scale = 1.0,
                             .density = DENSITY,
                             .orientation = {1.0},
                             .angular_velocity = {2.0, 100.0, 1.0}};
        CHECK_OK(clast_dem_add_grains(dem, 1, &g));
        double before[3], after[3];
        clast_dem_measures m0, m1;
        double most = 0.0;
        double least_y = 1.0;
        clast_dem_measure(dem, &m0);
        for (int k = 0; k < 3; ++k) {
            before[k] = DENSITY * shape.inertia[k][k] * g.angular_velocity[k];
        }
        for (int k = 0; k < 160; ++k) {
            CHECK_OK(clast_dem_step(dem, 400));
            clast_dem_measure(dem, &m1);
            most = fmax(most, fabs(m1.kinetic_energy / m0.kinetic_energy - 1.0));
            clast_dem_read_grain(dem, 0, &g);
            double w[3], r[3][3];
            q_matrix(r, g.orientation);
            m3_to_local(w, r, g.angular_velocity);
            least_y = fmin(least_y, w[1] / 100.0);
            for (int i = 0; i < 3; ++i) {
                w[i] *= DENSITY * shape.inertia[i][i];
            }
            m3_to_world(after, r, w);
        }
        if (plain == 0) {
            for (int i = 0; i < 3; ++i) {
                CHECK_ABS(after[i], before[i], 1e-9 * before[1]);
            }
            /* (w dt)^2 = 2.5e-7 */
            CHECK_ABS(most, 0.0, 2.5e-7);
            assert_true(least_y < -0.9); /* it did tumble over: Dzhanibekov */
        } else {
            assert_true(fabs(after[0] - before[0]) > 1e-3 * before[1]); /* spin stays instead */
        }
        clast_dem_destroy(dem);
        clast_shape_free(&shape);
    }
}

/* An octahedron on its face, a cube, an ellipsoid on its side rest at g' / (k / m) below the floor.
 */
static void bodies_rest_on_the_floor(void **state)
{
    (void)state;
    const scene_body_kind kinds[] = {SCENE_EGG, SCENE_CUBE, SCENE_CLUMP};
    const double half[] = {2e-3, 4e-3, 2e-3};
    const double ln = log(0.1);
    const double rest = 9.81 * (1.0 - 1000.0 / DENSITY) * 4e-8 / (CLAST_PI * CLAST_PI + ln * ln);
    for (int k = 0; k < 3; ++k) {
        clast_dem_config c = scene_physics();
        c.domain = CLAST_DEM_OPEN;
        clast_dem *dem = NULL;
        clast_shape shape = {0};
        int32_t id = 0;
        CHECK_OK(clast_dem_create(&c, &dem));
        CHECK_OK(scene_body(kinds[k], &shape));
        CHECK_OK(clast_dem_add_shape(dem, &shape, &id));
        clast_dem_grain g = {.scale = 1.0, .density = DENSITY, .orientation = {1.0}};
        g.position[2] = half[k] * 1.001;
        CHECK_OK(clast_dem_add_grains(dem, 1, &g));
        clast_dem_set_drive(dem, &(clast_dem_drive){0.0, 1.0, 1e-20});
        CHECK_OK(clast_dem_step(dem, 60000));
        clast_dem_read_grain(dem, 0, &g);
        assert_true(half[k] - g.position[2] > 0.0 && half[k] - g.position[2] < 3.0 * rest);
        CHECK_ABS(clast_dem_max_speed(dem), 0.0, 1e-5);
        clast_dem_destroy(dem);
        clast_shape_free(&shape);
    }
}

/* Two dumb-bells side by side meet in two spheres at once. The pair's stiffness is shared, so e_n
 * and T_c are those of one contact; each its own: twice the spring and twice the dashpot, which is
 * a collision of T_c / sqrt(2) with another damping. */
static void clumps_share_the_stiffness_of_their_pair(void **state)
{
    (void)state;
    for (int each = 0; each < 2; ++each) {
        clast_dem_config c = scene_space();
        clast_shape clump = {0};
        clast_dem_measures m;
        c.restitution = 0.3;
        c.clump_contacts = each;
        c.time_step = c.collision_time / 1000.0;
        CHECK_OK(scene_body(SCENE_CLUMP, &clump));
        clast_dem_grain g[2] = {{.scale = 1.0, .density = DENSITY, .orientation = {1.0}},
                                {.scale = 1.0, .density = DENSITY, .orientation = {1.0}}};
        g[0].position[1] = -2.0001e-3;
        g[1].position[1] = 2.0001e-3;
        g[0].velocity[1] = 0.05;
        clast_dem *dem = scene_bodies(&c, &clump, 2, g);
        assert_non_null(dem);
        while (clast_dem_measure(dem, &m), m.n_contact == 0) {
            CHECK_OK(clast_dem_step(dem, 1));
        }
        clast_table places = {0};
        CHECK_OK(clast_dem_contact_table(dem, &places));
        assert_int_equal(m.n_contact, 1); /* of a pair */
        assert_int_equal(places.n_row, 2);
        clast_table_free(&places);
        CHECK_REL(m.coordination, 1.0, 1e-15); /* one neighbour each */
        const double lasted = scene_collide(dem, c.time_step);
        clast_dem_read_grain(dem, 0, &g[0]);
        clast_dem_read_grain(dem, 1, &g[1]);
        const double e = (g[1].velocity[1] - g[0].velocity[1]) / 0.05;
        /* of x'' + 2 z w x' + w^2 x: w^2 and 2 z w doubled */
        const double ln = log(0.3);
        const double damping = (each ? 2.0 : 1.0) * -ln / c.collision_time;
        const double stiffness = (each ? 2.0 : 1.0) * (CLAST_PI * CLAST_PI + ln * ln) /
                                 (c.collision_time * c.collision_time);
        const double duration = CLAST_PI / sqrt(stiffness - damping * damping);
        CHECK_REL(lasted, duration, 1e-2); /* a step or two of 700 to 1000 */
        CHECK_REL(e, exp(-damping * duration), 2.0 * damping * c.time_step + 1e-3);
        clast_dem_destroy(dem);
        clast_shape_free(&clump);
    }
}

static void unusable_shapes_are_refused(void **state)
{
    (void)state;
    const clast_dem_config c = scene_space();
    clast_dem *dem = NULL;
    clast_mesh box = {0};
    clast_mesh open = {0};
    clast_shape shape = {0};
    int32_t id = 0;
    CHECK_OK(clast_dem_create(&c, &dem));
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &box));
    CHECK_OK(clast_mesh_copy(&box, &open));
    open.n_tri -= 1;
    CHECK_OK(clast_shape_mesh("open", &open, &shape));
    CHECK_STATUS(clast_dem_add_shape(dem, &shape, &id), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "not closed"));
    clast_shape_free(&shape);
    clast_mesh_transform(&box, 0.5, (const double[4]){1.0, 0.0, 0.0, 0.0},
                         (const double[3]){2.0, 0.0, 0.0});
    clast_mesh_free(&open);
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &open));
    CHECK_OK(clast_mesh_append(&box, &open));
    CHECK_OK(clast_shape_mesh("two", &box, &shape));
    CHECK_STATUS(clast_dem_add_shape(dem, &shape, &id), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "2 parts"));
    clast_shape_free(&shape);
    clast_mesh_free(&open);
    clast_mesh_free(&box);
    clast_dem_destroy(dem);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_pair_kind_has_its_restitution_and_duration),
        cmocka_unit_test(every_kind_bounces_off_walls),
        cmocka_unit_test(free_body_keeps_momentum_and_energy),
        cmocka_unit_test(bodies_rest_on_the_floor),
        cmocka_unit_test(clumps_share_the_stiffness_of_their_pair),
        cmocka_unit_test(unusable_shapes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
