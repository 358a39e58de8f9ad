// Unit: directions of contacts and grains in arrangements whose tensors are known.
#include "support.h"

#include "math/vec3.h"
#include <string.h>

static const double upright[4] = {1.0, 0.0, 0.0, 0.0};

static double value_of(const clast_table *t, const char *name)
{
    for (int64_t r = 0; r < t->n_row; ++r) {
        if (strcmp(t->column[0].text[r], name) == 0) {
            return t->column[1].number[r];
        }
    }
    fail_msg("no row %s", name);
    return 0.0;
}

static bool has(const clast_table *t, const char *name)
{
    for (int64_t r = 0; r < t->n_row; ++r) {
        if (strcmp(t->column[0].text[r], name) == 0) {
            return true;
        }
    }
    return false;
}

static void column_of_spheres_points_up(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_shape ball = {0};
    clast_table fabric = {0};
    CHECK_OK(clast_shape_sphere("ball", 0.5, &ball));
    CHECK_OK(clast_assembly_add_shape(&a, &ball, NULL));
    for (int k = 0; k < 5; ++k) {
        const double p[3] = {0.0, 0.0, k};
        CHECK_OK(clast_assembly_add_grain(&a, 0, p, upright, 1.0, 1.0));
    }
    CHECK_OK(clast_fabric(&a, NULL, NULL, &fabric));
    assert_false(has(&fabric, "coordination")); // contacts are not known, spheres have no axes
    assert_int_equal(fabric.n_row, 0);
    clast_table_free(&fabric);
    CHECK_OK(clast_assembly_find_contacts(&a, 1e-9));
    CHECK_OK(clast_fabric(&a, NULL, NULL, &fabric));
    CHECK_REL(value_of(&fabric, "coordination"), 8.0 / 5.0, 1e-15);
    CHECK_REL(value_of(&fabric, "branch_1"), 1.0, 1e-15);
    CHECK_ABS(value_of(&fabric, "branch_3"), 0.0, 1e-15);
    CHECK_REL(value_of(&fabric, "branch_vertical"), 1.0, 1e-15);
    CHECK_REL(value_of(&fabric, "normal_vertical"), 1.0, 1e-15); // of spheres they are the branches
    CHECK_REL(value_of(&fabric, "share_rattler"), 1.0, 1e-15);
    clast_table_free(&fabric);
    clast_assembly_free(&a);
    clast_shape_free(&ball);
}

static void branches_take_the_short_way_round(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_shape ball = {0};
    clast_table fabric = {0};
    const double period[3] = {4.0, 0.0, 0.0};
    const double p[2][3] = {{0.25, 0.0, 0.0}, {3.75, 0.5, 0.0}};
    const double middle[3] = {0.0, 0.25, 0.0};
    CHECK_OK(clast_shape_sphere("ball", 0.5, &ball));
    CHECK_OK(clast_assembly_add_shape(&a, &ball, NULL));
    CHECK_OK(clast_assembly_add_grain(&a, 0, p[0], upright, 1.0, 1.0));
    CHECK_OK(clast_assembly_add_grain(&a, 0, p[1], upright, 1.0, 1.0));
    CHECK_OK(clast_assembly_add_contact(&a, 0, 1, middle));
    CHECK_OK(clast_fabric(&a, NULL, period, &fabric));
    // branch (-0.5, 0.5, 0)
    CHECK_REL(value_of(&fabric, "branch_anisotropy"), 1.0, 1e-14);
    CHECK_ABS(value_of(&fabric, "branch_vertical"), 0.0, 1e-15);
    clast_table_free(&fabric);
    clast_assembly_free(&a);
    clast_shape_free(&ball);
}

/// Ellipsoids that lie flat, long axes at even angles in the plane: long axis 1/2, 1/2, 0.
static void flat_ellipsoids_are_layered(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_shape shape = {0};
    clast_table fabric = {0};
    const double axes[3] = {3.0, 2.0, 1.0};
    CHECK_OK(clast_shape_ellipsoid("disc", axes, &shape));
    CHECK_OK(clast_assembly_add_shape(&a, &shape, NULL));
    for (int k = 0; k < 8; ++k) {
        const double half = 0.5 * CLAST_PI * k / 8.0;
        const double q[4] = {cos(half), 0.0, 0.0, sin(half)};
        const double p[3] = {10.0 * k, 0.0, 0.0};
        CHECK_OK(clast_assembly_add_grain(&a, 0, p, q, 1.0, 1.0));
    }
    CHECK_OK(clast_fabric(&a, NULL, NULL, &fabric));
    CHECK_ABS(value_of(&fabric, "long_axis_1"), 0.5, 1e-14);
    CHECK_ABS(value_of(&fabric, "long_axis_2"), 0.5, 1e-14);
    CHECK_ABS(value_of(&fabric, "long_axis_3"), 0.0, 1e-14);
    CHECK_ABS(value_of(&fabric, "short_axis_vertical"), 1.0, 1e-14);
    CHECK_ABS(value_of(&fabric, "long_axis_dip"), 0.0, 1e-7);
    clast_table_free(&fabric);
    clast_assembly_free(&a);
    clast_shape_free(&shape);
}

/* A brick half on another, beside it: the branch leans, the normal of the contact is upright.
 * Satake's tensor is of normals; before, only that of branches was there under his name. */
static void normals_are_not_branches(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_shape brick = {0};
    clast_mesh box = {0};
    clast_table fabric = {0};
    clast_table contacts = {0};
    const double p[2][3] = {{0.0, 0.0, 0.0}, {1.0, 0.0, 1.0}};
    const double point[3] = {0.5, 0.0, 0.5};
    const char *name[4] = {"b", "normal_x", "normal_y", "normal_z"};
    const double row[2][4] = {{1.0, 0.0, 0.0, 1.0}, {-1.0, 1.0, 0.0, 0.0}}; /* b; a wall */
    CHECK_OK(clast_mesh_box(2.0, 1.0, 1.0, &box));
    CHECK_OK(clast_shape_mesh("brick", &box, &brick));
    CHECK_OK(clast_assembly_add_shape(&a, &brick, NULL));
    for (int k = 0; k < 2; ++k) {
        CHECK_OK(clast_assembly_add_grain(&a, 0, p[k], upright, 1.0, 1.0));
    }
    CHECK_OK(clast_assembly_add_contact(&a, 0, 1, point));
    CHECK_OK(clast_fabric(&a, NULL, NULL, &fabric));
    assert_false(has(&fabric, "normal_1")); // not known
    clast_table_free(&fabric);
    CHECK_OK(clast_table_init(&contacts, "contacts", 2));
    for (int c = 0; c < 4; ++c) {
        double *value = NULL;
        CHECK_OK(clast_table_add_number(&contacts, name[c], "-", &value));
        value[0] = row[0][c];
        value[1] = row[1][c];
    }
    CHECK_OK(clast_fabric(&a, &contacts, NULL, &fabric));
    CHECK_REL(value_of(&fabric, "branch_vertical"), 0.5, 1e-14);
    CHECK_REL(value_of(&fabric, "normal_vertical"), 1.0, 1e-14);
    clast_table_free(&fabric);
    // through the border of a period of 1.5, though the nearest image is 0.5 away
    const char *branch[3] = {"branch_x_m", "branch_y_m", "branch_z_m"};
    for (int c = 0; c < 3; ++c) {
        double *value = NULL;
        CHECK_OK(clast_table_add_number(&contacts, branch[c], "m", &value));
        value[0] = p[1][c];
    }
    CHECK_OK(clast_fabric(&a, &contacts, (const double[3]){1.5, 1.5, 0.0}, &fabric));
    CHECK_REL(value_of(&fabric, "branch_vertical"), 0.5, 1e-14);
    clast_table_free(&fabric);
    clast_table_free(&contacts);
    clast_assembly_free(&a);
    clast_shape_free(&brick);
    clast_mesh_free(&box);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(column_of_spheres_points_up),
        cmocka_unit_test(branches_take_the_short_way_round),
        cmocka_unit_test(flat_ellipsoids_are_layered),
        cmocka_unit_test(normals_are_not_branches),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
