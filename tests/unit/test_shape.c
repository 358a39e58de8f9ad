/* Unit: shapes have the volumes, moments, lengths and axes of the textbook. */
#include "support.h"

#include "math/vec3.h"
#include <string.h>

static void sphere_is_the_textbook_sphere(void **state)
{
    (void)state;
    clast_shape s = {0};
    CHECK_OK(clast_shape_sphere("ball", 2.0, &s));
    assert_int_equal(s.kind, CLAST_SHAPE_SPHERE);
    assert_string_equal(s.name, "ball");
    CHECK_REL(s.volume, 32.0 * CLAST_PI / 3.0, 1e-15);
    CHECK_REL(s.inertia[1][1], 0.4 * s.volume * 4.0, 1e-15);
    CHECK_REL(s.length, 4.0, 0.0);
    CHECK_REL(s.bounding_radius, 2.0, 0.0);
    clast_shape_free(&s);
    clast_shape_free(&s);
}

static void ellipsoid_axes_are_sorted(void **state)
{
    (void)state;
    const double axes[3] = {2.0, 1.0, 3.0};
    clast_shape s = {0};
    CHECK_OK(clast_shape_ellipsoid("e", axes, &s));
    CHECK_REL(s.semi_axes[0], 3.0, 0.0);
    CHECK_REL(s.semi_axes[1], 2.0, 0.0);
    CHECK_REL(s.semi_axes[2], 1.0, 0.0);
    CHECK_REL(s.volume, 8.0 * CLAST_PI, 1e-15);
    CHECK_REL(s.inertia[0][0], s.volume * (4.0 + 1.0) / 5.0, 1e-15);
    CHECK_REL(s.inertia[2][2], s.volume * (9.0 + 4.0) / 5.0, 1e-15);
    CHECK_REL(s.length, 6.0, 0.0);
    clast_shape_free(&s);
}

/* A box x, y, z has I_x = V (y2 + z2) / 12, so its ellipsoid has a = x sqrt(5 / 12). */
static void box_has_closed_form_axes(void **state)
{
    (void)state;
    clast_mesh box = {0};
    clast_shape s = {0};
    CHECK_OK(clast_mesh_box(1.0, 3.0, 2.0, &box));
    CHECK_OK(clast_shape_mesh("box", &box, &s));
    CHECK_REL(s.volume, 6.0, 1e-15);
    for (int k = 0; k < 3; ++k) {
        CHECK_REL(s.semi_axes[k], (3.0 - k) * sqrt(5.0 / 12.0), 1e-14);
    }
    CHECK_REL(s.length, sqrt(14.0), 1e-15);
    CHECK_REL(s.bounding_radius, 0.5 * sqrt(14.0), 1e-15);
    CHECK_REL(s.source_origin[1], 1.5, 1e-15);
    clast_mass m;
    CHECK_OK(clast_mesh_mass(&s.mesh, &m));
    CHECK_ABS(v3_norm(m.centroid), 0.0, 1e-15);
    clast_mesh_free(&box);
    clast_shape_free(&s);
}

static void turned_box_keeps_its_axes_far_from_zero(void **state)
{
    (void)state;
    const double turn[4] = {0.5, -0.1, 0.7, sqrt(0.25)};
    const double at[3] = {1e3, -2e3, 5e2};
    double q[4];
    clast_mesh box = {0};
    clast_shape s = {0};
    for (int k = 0; k < 4; ++k) {
        q[k] = turn[k];
    }
    q_unit(q);
    CHECK_OK(clast_mesh_box(1.0, 3.0, 2.0, &box));
    clast_mesh_transform(&box, 1.0, q, at);
    CHECK_OK(clast_shape_mesh("box", &box, &s));
    for (int k = 0; k < 3; ++k) {
        CHECK_REL(s.semi_axes[k], (3.0 - k) * sqrt(5.0 / 12.0), 1e-12); /* rounded coordinates */
    }
    CHECK_REL(s.length, sqrt(14.0), 1e-12);
    clast_mesh_free(&box);
    clast_shape_free(&s);
}

static void equal_axes_cost_no_digits(void **state)
{
    (void)state;
    clast_mesh cube = {0};
    clast_shape s = {0};
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &cube));
    CHECK_OK(clast_shape_mesh("cube", &cube, &s));
    for (int k = 0; k < 3; ++k) {
        CHECK_REL(s.semi_axes[k], sqrt(5.0 / 12.0), 1e-14);
    }
    clast_mesh_free(&cube);
    clast_shape_free(&s);
}

static void unusable_input_is_refused(void **state)
{
    (void)state;
    clast_shape s = {0};
    clast_mesh box = {0};
    clast_spheres none = {0};
    CHECK_STATUS(clast_mesh_alloc(-1, 2, &box), CLAST_E_ARGUMENT); /* no memory, before */
    CHECK_STATUS(clast_mesh_alloc(1, -2, &box), CLAST_E_ARGUMENT);
    CHECK_STATUS(clast_spheres_alloc(-1, &none), CLAST_E_ARGUMENT);
    CHECK_STATUS(clast_shape_sphere("s", 0.0, &s), CLAST_E_GEOMETRY);
    CHECK_STATUS(clast_shape_sphere("s", -1.0, &s), CLAST_E_GEOMETRY);
    CHECK_STATUS(clast_shape_sphere("s", NAN, &s), CLAST_E_GEOMETRY);
    CHECK_STATUS(clast_shape_sphere("s", INFINITY, &s), CLAST_E_GEOMETRY);
    CHECK_STATUS(clast_shape_sphere("", 1.0, &s), CLAST_E_USAGE);
    CHECK_STATUS(clast_shape_sphere("s", 1e200, &s), CLAST_E_GEOMETRY);  /* volume INFINITY */
    CHECK_STATUS(clast_shape_sphere("s", 1e-200, &s), CLAST_E_GEOMETRY); /* volume 0 */
    CHECK_STATUS(clast_shape_sphere("s", 1e-70, &s), CLAST_E_GEOMETRY);  /* inertia 0 */
    assert_non_null(strstr(clast_error_detail(), "moment"));
    CHECK_STATUS(clast_shape_ellipsoid("e", (double[3]){1.0, 0.0, 1.0}, &s), CLAST_E_GEOMETRY);
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &box));
    for (int i = 0; i < box.n_vert; ++i) {
        box.vert[i][2] *= -1.0;
    }
    CHECK_STATUS(clast_shape_mesh("inside_out", &box, &s), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "inside_out"));
    box.vert[3][1] = INFINITY;
    CHECK_STATUS(clast_shape_mesh("infinite", &box, &s), CLAST_E_GEOMETRY);
    assert_null(s.name);
    clast_mesh_free(&box);
}

static void surface_is_own_mesh_or_icosphere(void **state)
{
    (void)state;
    clast_mesh box = {0};
    clast_mesh surface = {0};
    clast_shape s = {0};
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &box));
    CHECK_OK(clast_shape_mesh("box", &box, &s));
    CHECK_OK(clast_shape_surface(&s, 2, &surface));
    assert_int_equal(surface.n_tri, 12);
    clast_mesh_free(&surface);
    clast_shape_free(&s);
    CHECK_OK(clast_shape_sphere("ball", 1.0, &s));
    CHECK_OK(clast_shape_surface(&s, 2, &surface));
    assert_int_equal(surface.n_tri, 320);
    clast_mesh_free(&surface);
    clast_mesh_free(&box);
    clast_shape_free(&s);
}

static clast_status make_and_copy(void *context)
{
    clast_shape s = {0};
    clast_shape copy = {0};
    clast_status status = clast_shape_mesh("box", context, &s);
    if (status == CLAST_OK) {
        status = clast_shape_copy(&s, &copy);
    }
    if (status == CLAST_OK) {
        assert_memory_equal(copy.mesh.vert, s.mesh.vert, 8 * sizeof *s.mesh.vert);
        assert_string_equal(copy.name, "box");
    }
    clast_shape_free(&s);
    clast_shape_free(&copy);
    return status;
}

static void mesh_shape_survives_refused_memory(void **state)
{
    (void)state;
    clast_mesh box = {0};
    CHECK_OK(clast_mesh_box(1.0, 2.0, 3.0, &box));
    support_refuse_each_allocation(make_and_copy, &box);
    clast_mesh_free(&box);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sphere_is_the_textbook_sphere),
        cmocka_unit_test(ellipsoid_axes_are_sorted),
        cmocka_unit_test(box_has_closed_form_axes),
        cmocka_unit_test(turned_box_keeps_its_axes_far_from_zero),
        cmocka_unit_test(equal_axes_cost_no_digits),
        cmocka_unit_test(unusable_input_is_refused),
        cmocka_unit_test(surface_is_own_mesh_or_icosphere),
        cmocka_unit_test(mesh_shape_survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
