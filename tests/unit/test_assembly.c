/* Unit: placed shapes add up, and their box touches the true surfaces. */
#include "support.h"

#include "assembly/pieces.h"
#include "math/rng.h"
#include "math/vec3.h"
#include <string.h>

static const double upright[4] = {1.0, 0.0, 0.0, 0.0};

static clast_status add(clast_assembly *a, int32_t shape, double x, double y, double z, double s)
{
    return clast_assembly_add_grain(a, shape, (double[3]){x, y, z}, upright, s, 1000.0 * s);
}

static clast_status two_balls(clast_assembly *a)
{
    clast_shape ball = {0};
    clast_status status = clast_shape_sphere("ball", 1.0, &ball);
    if (status == CLAST_OK) {
        status = clast_assembly_add_shape(a, &ball, NULL);
    }
    if (status == CLAST_OK) {
        status = add(a, 0, 0.0, 0.0, 0.0, 1.0);
    }
    if (status == CLAST_OK) {
        status = add(a, 0, 3.0, 0.0, 0.0, 2.0);
    }
    if (status == CLAST_OK) {
        status = clast_assembly_add_contact(a, 0, 1, (double[3]){1.0, 0.0, 0.0});
    }
    clast_shape_free(&ball);
    return status;
}

static void totals_follow_volumes_and_densities(void **state)
{
    (void)state;
    clast_assembly a = {0};
    double centre[3];
    double low[3];
    double high[3];
    CHECK_OK(two_balls(&a));
    const double ball = 4.0 / 3.0 * CLAST_PI;
    CHECK_REL(clast_assembly_volume(&a), 9.0 * ball, 1e-15);
    CHECK_REL(clast_assembly_mass(&a), (1000.0 + 8.0 * 2000.0) * ball, 1e-15);
    clast_assembly_centre(&a, centre);
    CHECK_REL(centre[0], 3.0 * 16.0 / 17.0, 1e-15);
    clast_assembly_bounds(&a, low, high);
    CHECK_REL(low[0], -1.0, 0.0);
    CHECK_REL(high[0], 5.0, 0.0);
    CHECK_REL(high[1], 2.0, 0.0);
    assert_int_equal(a.id[1], 1);
    assert_int_equal(a.n_contact, 1);
    clast_assembly_free(&a);
}

static void nothing_has_no_volume_and_an_empty_box(void **state)
{
    (void)state;
    clast_assembly a = {0};
    double low[3];
    double high[3];
    clast_assembly_bounds(&a, low, high);
    assert_true(low[0] > high[0]);
    assert_true(clast_assembly_volume(&a) == 0.0);
    clast_assembly_centre(&a, low);
    assert_true(low[0] == 0.0);
    clast_assembly_free(&a);
}

/* The box of a turned ellipsoid is exact: the support point along each axis lies on it. */
static void ellipsoid_box_touches_its_surface(void **state)
{
    (void)state;
    const double axes[3] = {5.0, 2.0, 0.5};
    clast_shape e = {0};
    CHECK_OK(clast_shape_ellipsoid("e", axes, &e));
    for (uint64_t trial = 0; trial < 100; ++trial) {
        clast_assembly a = {0};
        clx_rng rng = clx_rng_at(1, CLX_STREAM_TEST, trial);
        double q[4];
        double m[3][3];
        double low[3];
        double high[3];
        clx_rng_orientation(&rng, q);
        q_matrix(m, q);
        CHECK_OK(clast_assembly_add_shape(&a, &e, NULL));
        CHECK_OK(clast_assembly_add_grain(&a, 0, (double[3]){1.0, 2.0, 3.0}, q, 2.0, 1.0));
        clast_assembly_bounds(&a, low, high);
        for (int k = 0; k < 3; ++k) {
            /* Support point in the body frame along n = R^T e_k: A2 n / |A n|. */
            double image[3];
            double body[3];
            for (int j = 0; j < 3; ++j) {
                image[j] = axes[j] * m[k][j];
            }
            const double norm = v3_norm(image);
            for (int j = 0; j < 3; ++j) {
                body[j] = 2.0 * axes[j] * image[j] / norm;
            }
            CHECK_REL(high[k], a.position[0][k] + v3_dot(m[k], body), 1e-13);
            CHECK_REL(high[k] + low[k], 2.0 * a.position[0][k], 1e-12);
        }
        clast_assembly_free(&a);
    }
    clast_shape_free(&e);
}

static void mesh_box_is_that_of_its_surface(void **state)
{
    (void)state;
    const double half = sqrt(0.5);
    const double quarter[4] = {cos(CLAST_PI / 8.0), 0.0, 0.0, sin(CLAST_PI / 8.0)};
    clast_mesh cube = {0};
    clast_mesh surface = {0};
    clast_shape s = {0};
    clast_assembly a = {0};
    double low[3];
    double high[3];
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &cube));
    CHECK_OK(clast_shape_mesh("cube", &cube, &s));
    CHECK_OK(clast_assembly_add_shape(&a, &s, NULL));
    CHECK_OK(clast_assembly_add_grain(&a, 0, (double[3]){0, 0, 0}, quarter, 1.0, 1.0));
    clast_assembly_bounds(&a, low, high);
    CHECK_REL(high[0], half, 1e-15); /* turned by 45 degrees about z */
    CHECK_REL(high[2], 0.5, 1e-15);
    CHECK_OK(clast_assembly_grain_surface(&a, 0, 0, &surface));
    CHECK_OK(clast_assembly_grain_surface(&a, 0, 0, &surface));
    assert_int_equal(surface.n_tri, 24);
    clast_mesh_bounds(&surface, low, high);
    CHECK_REL(high[0], half, 1e-15);
    clast_mesh_free(&surface);
    clast_mesh_free(&cube);
    clast_shape_free(&s);
    clast_assembly_free(&a);
}

static void wrong_grains_are_refused(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_shape ball = {0};
    const double origin[3] = {0, 0, 0};
    CHECK_OK(two_balls(&a));
    CHECK_STATUS(clast_assembly_add_grain(&a, 1, origin, upright, 1, 1), CLAST_E_USAGE);
    CHECK_STATUS(clast_assembly_add_grain(&a, -1, origin, upright, 1, 1), CLAST_E_USAGE);
    CHECK_STATUS(clast_assembly_add_grain(&a, 0, origin, upright, 0, 1), CLAST_E_USAGE);
    CHECK_STATUS(clast_assembly_add_grain(&a, 0, origin, upright, 1, 0), CLAST_E_USAGE);
    CHECK_STATUS(clast_assembly_add_grain(&a, 0, origin, upright, NAN, 1), CLAST_E_USAGE);
    CHECK_STATUS(clast_assembly_add_grain(&a, 0, (double[3]){NAN, 0, 0}, upright, 1, 1),
                 CLAST_E_USAGE);
    CHECK_STATUS(clast_assembly_add_grain(&a, 0, origin, (double[4]){1, 1, 0, 0}, 1, 1),
                 CLAST_E_USAGE);
    CHECK_STATUS(clast_assembly_add_contact(&a, 0, 0, origin), CLAST_E_USAGE);
    CHECK_STATUS(clast_assembly_add_contact(&a, 0, 2, origin), CLAST_E_USAGE);
    CHECK_OK(clast_shape_sphere("ball", 2.0, &ball));
    CHECK_STATUS(clast_assembly_add_shape(&a, &ball, NULL), CLAST_E_USAGE);
    assert_int_equal(a.n_grain, 2);
    assert_int_equal(a.n_shape, 1);
    clast_shape_free(&ball);
    clast_assembly_free(&a);
}

static void clump_with_a_sphere_of_no_size_is_refused(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_shape clump = {0};
    double centre[1][3] = {{0.0, 0.0, 0.0}};
    double radius[1] = {1.0};
    const clast_spheres spheres = {1, centre, radius};
    CHECK_OK(clast_shape_clump("clump", &spheres, &clump));
    clump.spheres.radius[0] = -1.0;
    CHECK_STATUS(clast_assembly_add_shape(&a, &clump, NULL), CLAST_E_ARGUMENT);
    clump.spheres.radius[0] = 1.0;
    clump.spheres.centre[0][1] = NAN;
    CHECK_STATUS(clast_assembly_add_shape(&a, &clump, NULL), CLAST_E_ARGUMENT);
    assert_int_equal(a.n_shape, 0);
    clast_shape_free(&clump);
    clast_assembly_free(&a);
}

static clast_status make_many(void *context)
{
    (void)context;
    clast_assembly a = {0};
    clast_assembly copy = {0};
    clast_status status = two_balls(&a);
    for (int i = 0; i < 40 && status == CLAST_OK; ++i) {
        status = add(&a, 0, i, 0.0, 0.0, 1.0);
        if (status == CLAST_OK) {
            status = clast_assembly_add_contact(&a, i, i + 1, a.position[i]);
        }
    }
    if (status == CLAST_OK) {
        status = clast_assembly_copy(&a, &copy);
    }
    if (status == CLAST_OK) {
        assert_int_equal(copy.n_grain, 42);
        assert_memory_equal(copy.position, a.position, 42 * sizeof *a.position);
        assert_memory_equal(copy.contact, a.contact, 41 * sizeof *a.contact);
    }
    clast_assembly_free(&a);
    clast_assembly_free(&copy);
    return status;
}

static void assembly_survives_refused_memory(void **state)
{
    (void)state;
    support_refuse_each_allocation(make_many, NULL);
}

static const int32_t joined[4][2] = {{4, 2}, {2, 0}, {5, 1}, {0, 4}};

/* Six balls in a row; contacts make {0, 2, 4}, {1, 5} and {3}. */
static clast_status six_balls(clast_assembly *a)
{
    clast_shape ball = {0};
    clast_status status = clast_shape_sphere("ball", 1.0, &ball);
    status = status == CLAST_OK ? clast_assembly_add_shape(a, &ball, NULL) : status;
    for (int32_t i = 0; i < 6 && status == CLAST_OK; ++i) {
        status = add(a, 0, 3.0 * i, 0.0, 0.0, 1.0 + i);
    }
    for (int32_t c = 0; c < 4 && status == CLAST_OK; ++c) {
        status = clast_assembly_add_contact(a, joined[c][0], joined[c][1],
                                            (double[3]){(double)c, 0.0, 0.0});
    }
    clast_shape_free(&ball);
    return status;
}

static void contacts_join_grains_to_groups(void **state)
{
    (void)state;
    static const int32_t expected[6] = {0, 1, 0, 2, 0, 1};
    clast_assembly a = {0};
    clast_assembly part = {0};
    int32_t piece[6];
    int32_t n = 0;
    CHECK_OK(six_balls(&a));
    a.id[4] = 17;
    CHECK_OK(clx_assembly_pieces(&a, piece, &n));
    assert_int_equal(n, 3);
    assert_memory_equal(piece, expected, sizeof piece);
    CHECK_OK(clx_assembly_part(&a, piece, 0, &part));
    assert_int_equal(part.n_grain, 3);
    assert_int_equal(part.n_contact, 3);
    CHECK_REL(part.position[2][0], 12.0, 0.0);
    CHECK_REL(part.scale[1], 3.0, 0.0);
    assert_int_equal(part.id[2], 17);
    assert_int_equal(part.contact[0][0], 2);
    assert_int_equal(part.contact[0][1], 1);
    CHECK_REL(part.contact_point[2][0], 3.0, 0.0);
    clast_assembly_free(&part);
    CHECK_OK(clx_assembly_part(&a, piece, 2, &part));
    assert_int_equal(part.n_grain, 1);
    assert_int_equal(part.n_contact, 0);
    clast_assembly_free(&part);
    clast_assembly_free(&a);
}

static clast_status make_part(void *context)
{
    (void)context;
    clast_assembly a = {0};
    clast_assembly part = {0};
    int32_t piece[6];
    int32_t n = 0;
    clast_status status = six_balls(&a);
    status = status == CLAST_OK ? clx_assembly_pieces(&a, piece, &n) : status;
    status = status == CLAST_OK ? clx_assembly_part(&a, piece, 0, &part) : status;
    clast_assembly_free(&part);
    clast_assembly_free(&a);
    return status;
}

static void parts_survive_refused_memory(void **state)
{
    (void)state;
    support_refuse_each_allocation(make_part, NULL);
}

static double structure_value(const clast_table *t, const char *name)
{
    for (int64_t i = 0; i < t->n_row; ++i) {
        if (strcmp(t->column[0].text[i], name) == 0) {
            return t->column[1].number[i];
        }
    }
    return (double)NAN;
}

/* Porosity, packing and density are by the sum of the grains' volumes, as in summary.json and the
   paper; porosity was by the union, of which summary.json had none. */
static void porosity_is_by_the_sum_and_by_the_union(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_shape ball = {0};
    clast_table t = {0};
    const clast_structure_options options = clast_structure_options_default();
    CHECK_OK(clast_shape_sphere("ball", 1.0, &ball));
    CHECK_OK(clast_assembly_add_shape(&a, &ball, NULL));
    CHECK_OK(add(&a, 0, 0.0, 0.0, 0.0, 1.0));
    CHECK_OK(add(&a, 0, 1.0, 0.0, 0.0, 1.0));
    CHECK_OK(clast_structure(&a, &options, &t));
    const double hull = 4.0 / 3.0 * CLAST_PI + CLAST_PI; /* a capsule */
    const double sum = 8.0 / 3.0 * CLAST_PI;
    const double lens = 5.0 / 12.0 * CLAST_PI;
    CHECK_REL(structure_value(&t, "porosity_surface_hull"), 1.0 - sum / hull, 1e-10);
    CHECK_REL(structure_value(&t, "packing_surface_hull"), sum / hull, 1e-10);
    CHECK_REL(structure_value(&t, "density_surface_hull"), 1000.0 * sum / hull, 1e-10);
    CHECK_REL(structure_value(&t, "porosity_union_surface_hull"), 1.0 - (sum - lens) / hull, 1e-10);
    CHECK_REL(structure_value(&t, "max_overlap_surfaces"), 1.0, 1e-12);
    assert_true(isnan(structure_value(&t, "max_overlap")));
    clast_table_free(&t);
    clast_shape_free(&ball);
    clast_assembly_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(totals_follow_volumes_and_densities),
        cmocka_unit_test(nothing_has_no_volume_and_an_empty_box),
        cmocka_unit_test(ellipsoid_box_touches_its_surface),
        cmocka_unit_test(mesh_box_is_that_of_its_surface),
        cmocka_unit_test(wrong_grains_are_refused),
        cmocka_unit_test(clump_with_a_sphere_of_no_size_is_refused),
        cmocka_unit_test(assembly_survives_refused_memory),
        cmocka_unit_test(contacts_join_grains_to_groups),
        cmocka_unit_test(parts_survive_refused_memory),
        cmocka_unit_test(porosity_is_by_the_sum_and_by_the_union),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
