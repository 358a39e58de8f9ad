/* Unit: rounded edges keep the volume and move the faces by what Steiner's formula says. */
#include "support.h"

#include "dem/dem.h"
#include "dem_scenes.h"
#include <string.h>

static const double A = 8e-3, B = 6e-3, C = 4e-3;

static clast_dem *with_box(double rounding)
{
    clast_dem *dem = NULL;
    clast_mesh mesh = {0};
    clast_shape shape = {0};
    int32_t id = 0;
    clast_dem_config c = scene_physics();
    c.domain = CLAST_DEM_OPEN;
    c.gravity = 0.0;
    c.rounding = rounding;
    c.time_step = 1e-9; /* contacts move nothing yet */
    CHECK_OK(clast_dem_create(&c, &dem));
    CHECK_OK(clast_mesh_box(A, B, C, &mesh));
    CHECK_OK(clast_shape_mesh("brick", &mesh, &shape));
    CHECK_OK(clast_dem_add_shape(dem, &shape, &id));
    clast_mesh_free(&mesh);
    clast_shape_free(&shape);
    return dem;
}

static clast_dem_grain at(double scale, double z)
{
    return (clast_dem_grain){.scale = scale,
                             .density = 2650.0,
                             .position = {0.0, 0.0, z},
                             .orientation = {1.0, 0, 0, 0}};
}

/* A brick grown by m: V + 2 (ab + bc + ca) m + pi (a + b + c) m^2 + 4/3 pi m^3. */
static void steiner_of_a_brick(void **state)
{
    (void)state;
    clast_dem *dem = with_box(0.0);
    const clx_dem_body *body = &dem->body[0];
    CHECK_REL(body->steiner[0], 2.0 * (A * B + B * C + C * A), 1e-13);
    CHECK_REL(body->steiner[1], CLAST_PI * (A + B + C), 1e-13);
    CHECK_REL(clx_rounding_factor(body, 0.0), 1.0, 1e-15);
    const double margin[3] = {1e-6, 1e-4, 1.9e-3};
    for (int k = 0; k < 3; ++k) {
        const double m = margin[k];
        const double f = clx_rounding_factor(body, m);
        const double grown = f * f * f * A * B * C + f * f * 2.0 * (A * B + B * C + C * A) * m +
                             f * CLAST_PI * (A + B + C) * m * m + 4.0 / 3.0 * CLAST_PI * m * m * m;
        assert_true(f > 0.0 && f < 1.0 - m / (0.5 * A));
        CHECK_REL(grown, A * B * C, 1e-14);
    }
    clast_dem_destroy(dem);
}

/* The lower face lies f c/2 + m under the centre, at every scale. */
static void faces_move_and_mass_stays(void **state)
{
    (void)state;
    const double m = 2e-4;
    const double deep = 1e-6;
    for (int k = 0; k < 2; ++k) {
        const double s = k == 0 ? 1.0 : 0.5;
        clast_dem *dem = with_box(m);
        const double f = clx_rounding_factor(&dem->body[0], m / s);
        const clast_dem_grain g = at(s, f * s * 0.5 * C + m - deep);
        clast_dem_measures found;
        CHECK_OK(clast_dem_add_grains(dem, 1, &g));
        CHECK_OK(clast_dem_step(dem, 1));
        clast_dem_measure(dem, &found);
        assert_int_equal(found.n_wall_contact, 1);
        CHECK_REL(found.mass, 2650.0 * A * B * C * s * s * s, 1e-13);
        CHECK_ABS(found.max_overlap, deep, 1e-5 * deep);
        clast_dem_destroy(dem);
    }
}

/* A corner on a face: both grow by m, both shrink by f. */
static void pairs_meet_where_they_should(void **state)
{
    (void)state;
    const double m = 2e-4;
    const double deep = 1e-6;
    clast_dem *dem = with_box(m);
    const double f = clx_rounding_factor(&dem->body[0], m);
    clast_dem_grain g[2] = {at(1.0, 0.1), at(1.0, 0.1)};
    double q[4] = {1.0, 0.5, 0.3, 0.1};
    double turn[3][3];
    double n = 0.0;
    for (int k = 0; k < 4; ++k) {
        n += q[k] * q[k];
    }
    for (int k = 0; k < 4; ++k) {
        g[1].orientation[k] = q[k] / sqrt(n);
    }
    q_matrix(turn, g[1].orientation);
    const double reach =
        0.5 * f * (fabs(turn[2][0]) * A + fabs(turn[2][1]) * B + fabs(turn[2][2]) * C);
    g[1].position[2] += 0.5 * f * C + m + reach + m - deep;
    for (int c = 0; c < 2; ++c) { /* the lowest corner over the middle of the face */
        const double size[3] = {A, B, C};
        for (int k = 0; k < 3; ++k) {
            g[1].position[c] += 0.5 * f * copysign(size[k], turn[2][k]) * turn[c][k];
        }
    }
    clast_dem_measures found;
    CHECK_OK(clast_dem_add_grains(dem, 2, g));
    for (int step = 0; step < 3; ++step) { /* found by a search, then remembered */
        CHECK_OK(clast_dem_step(dem, 1));
        clast_dem_measure(dem, &found);
        assert_int_equal(found.n_contact, 1);
        CHECK_ABS(found.max_overlap, deep, 1e-5 * deep);
    }
    clast_dem_destroy(dem);
}

static void too_round_is_refused(void **state)
{
    (void)state;
    clast_dem *dem = with_box(1.01e-3);
    const clast_dem_grain g = at(1.0, 0.1);
    CHECK_STATUS(clast_dem_add_grains(dem, 1, &g), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "rounding"));
    clast_dem_destroy(dem);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steiner_of_a_brick),
        cmocka_unit_test(faces_move_and_mass_stays),
        cmocka_unit_test(pairs_meet_where_they_should),
        cmocka_unit_test(too_round_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
