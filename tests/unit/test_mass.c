/* Unit: volumes and moments of textbook bodies. */
#include "support.h"

#include <string.h>

static void box_has_textbook_mass(void **state)
{
    (void)state;
    clast_mesh box = {0};
    clast_mass m;
    CHECK_OK(clast_mesh_box(1.0, 2.0, 3.0, &box));
    CHECK_OK(clast_mesh_mass(&box, &m));
    CHECK_REL(m.volume, 6.0, 1e-15);
    CHECK_REL(clast_mesh_area(&box), 22.0, 1e-15);
    CHECK_REL(m.centroid[2], 1.5, 1e-15);
    CHECK_REL(m.inertia[0][0], 6.0 * (2.0 * 2.0 + 3.0 * 3.0) / 12.0, 1e-14);
    CHECK_ABS(m.inertia[0][1], 0.0, 1e-14);
    clast_mesh_free(&box);
}

/* Before, a vertex that is NaN made a surface "inside out or open", to be repaired. */
static void vertices_that_are_no_places_are_named(void **state)
{
    (void)state;
    clast_mesh box = {0};
    clast_mass m = {.volume = -7.0};
    CHECK_OK(clast_mesh_box(1.0, 2.0, 3.0, &box));
    for (int k = 0; k < 2; ++k) {
        box.vert[5][k] = k == 0 ? (double)NAN : (double)INFINITY;
        CHECK_STATUS(clast_mesh_mass(&box, &m), CLAST_E_GEOMETRY);
        assert_non_null(strstr(clast_error_detail(), "vertex 6 is"));
        assert_true(m.volume == -7.0);
        box.vert[5][k] = 0.0;
    }
    clast_mesh_free(&box);
}

static void ellipsoid_converges_to_its_closed_form(void **state)
{
    (void)state;
    const double axes[3] = {1.0, 2.0, 3.0};
    double previous = 1.0;
    for (int level = 2; level <= 5; ++level) {
        clast_mesh mesh = {0};
        CHECK_OK(clast_mesh_ellipsoid(axes, level, &mesh));
        assert_int_equal(mesh.n_tri, 20 << (2 * level));
        assert_int_equal(mesh.n_vert, (10 << (2 * level)) + 2);
        const double error = fabs(clast_mesh_volume(&mesh) / (8.0 * CLAST_PI) - 1.0);
        assert_true(error < 0.3 * previous);
        previous = error;
        clast_mesh_free(&mesh);
    }
    assert_true(previous < 1e-3);
}

static clast_status make_ellipsoid(void *context)
{
    clast_mesh mesh = {0};
    const clast_status status = clast_mesh_ellipsoid(context, 2, &mesh);
    clast_mesh_free(&mesh);
    return status;
}

static void ellipsoid_survives_refused_memory(void **state)
{
    (void)state;
    double axes[3] = {1.0, 2.0, 3.0};
    support_refuse_each_allocation(make_ellipsoid, axes);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(box_has_textbook_mass),
        cmocka_unit_test(vertices_that_are_no_places_are_named),
        cmocka_unit_test(ellipsoid_converges_to_its_closed_form),
        cmocka_unit_test(ellipsoid_survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
