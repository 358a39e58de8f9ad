/* Unit: unions and overlaps with textbook volumes. */
#include "support.h"

#include "math/rng.h"
#include "math/vec3.h"
#include <string.h>

static const double no_turn[4] = {1.0, 0.0, 0.0, 0.0};

static void add(clast_assembly *a, int32_t shape, double x, double y, double z, double scale)
{
    CHECK_OK(clast_assembly_add_grain(a, shape, (double[3]){x, y, z}, no_turn, scale, 1000.0));
}

static void with_shape(clast_assembly *a, clast_shape *shape)
{
    CHECK_OK(clast_assembly_add_shape(a, shape, NULL));
    clast_shape_free(shape);
}

/// A unit cube of 12 triangles.
static void with_cube(clast_assembly *a)
{
    clast_mesh mesh = {0};
    clast_shape shape = {0};
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &mesh));
    CHECK_OK(clast_shape_mesh("cube", &mesh, &shape));
    with_shape(a, &shape);
    clast_mesh_free(&mesh);
}

static clast_union union_of(const clast_assembly *a)
{
    clast_union_options options = clast_union_options_default();
    clast_union u = {0};
    options.tolerance = 4e-4;
    CHECK_OK(clast_assembly_union(a, &options, &u));
    return u;
}

/* Two unit balls a distance d apart share a lens of pi (2 - d)^2 (d^2 + 4 d) / (12 d). */
static double lens(double d)
{
    return CLAST_PI * (2.0 - d) * (2.0 - d) * (d * d + 4.0 * d) / (12.0 * d);
}

static void overlapping_balls_are_exact(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_shape ball = {0};
    CHECK_OK(clast_shape_sphere("ball", 1.0, &ball));
    with_shape(&a, &ball);
    add(&a, 0, 0.0, 0.0, 0.0, 1.0);
    add(&a, 0, 1.5, 0.0, 0.0, 1.0);
    add(&a, 0, 0.0, 5.0, 0.0, 2.0); /* apart */
    const clast_union u = union_of(&a);
    assert_true(u.is_exact && u.error == 0.0);
    assert_int_equal(u.n_overlap, 1);
    CHECK_REL(u.volume, 10.0 * 4.0 / 3.0 * CLAST_PI - lens(1.5), 1e-11);
    CHECK_REL(u.sum, 10.0 * 4.0 / 3.0 * CLAST_PI, 1e-14);
    CHECK_REL(u.max_overlap, 0.5, 1e-12);
    CHECK_REL(u.max_overlap_share, 0.5, 1e-12);
    clast_assembly_free(&a);
}

/* The same lens under a linear map: ellipsoids 4 : 2 : 1. Sampled, within its own error. */
static void overlapping_ellipsoids_agree_with_the_mapped_lens(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_shape egg = {0};
    CHECK_OK(clast_shape_ellipsoid("egg", (double[3]){4.0, 2.0, 1.0}, &egg));
    with_shape(&a, &egg);
    add(&a, 0, 0.0, 0.0, 0.0, 1.0);
    add(&a, 0, 1.2 * 4.0 * 0.6, 1.2 * 2.0 * 0.8, 0.0, 1.0);
    const clast_union u = union_of(&a);
    const double wanted = 8.0 * (8.0 / 3.0 * CLAST_PI - lens(1.2));
    assert_true(!u.is_exact && u.error > 0.0 && u.error <= 4e-4 * u.volume);
    CHECK_ABS(u.volume, wanted, 4.0 * u.error);
    clast_assembly_free(&a);
}

/* Three cubes in a row, two of them sharing a slab of 0.3; the third is off the side of a ball. */
static void overlapping_boxes_and_a_ball(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_shape shape = {0};
    with_cube(&a);
    CHECK_OK(clast_shape_sphere("ball", 0.5, &shape));
    with_shape(&a, &shape);
    add(&a, 0, 0.0, 0.0, 0.0, 1.0);
    add(&a, 0, 0.7, 0.0, 0.0, 1.0);
    add(&a, 0, 5.0, 0.0, 0.0, 1.0);
    add(&a, 1, 5.5, 0.0, 0.0, 1.0); /* half of it in the cube */
    const clast_union u = union_of(&a);
    assert_int_equal(u.n_overlap, 2);
    CHECK_ABS(u.volume, 1.7 + 1.0 + CLAST_PI / 12.0, 4.0 * u.error + 1e-12);
    assert_true(u.error > 0.0 && u.error < 4e-4 * u.volume);
    CHECK_REL(u.max_overlap, 0.5, 2e-3);
    clast_assembly_free(&a);
}

static void buried_grain_adds_nothing(void **state)
{
    (void)state;
    clast_assembly a = {0};
    with_cube(&a);
    add(&a, 0, 0.0, 0.0, 0.0, 1.0);
    add(&a, 0, 0.1, 0.05, 0.0, 0.3);
    const clast_union u = union_of(&a);
    assert_int_equal(u.n_overlap, 1);
    CHECK_ABS(u.volume, 1.0, 4.0 * u.error + 1e-12);
    clast_assembly_free(&a);
}

/* Grains that only touch: the union is the sum, exactly, and nothing is sampled. */
static void touching_grains_are_summed(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_shape shape = {0};
    CHECK_OK(clast_shape_ellipsoid("egg", (double[3]){3.0, 2.0, 1.0}, &shape));
    with_shape(&a, &shape);
    add(&a, 0, 0.0, 0.0, 0.0, 1.0);
    add(&a, 0, 6.0, 0.0, 0.0, 1.0);
    add(&a, 0, 0.0, 4.0, 0.0, 1.0);
    const clast_union u = union_of(&a);
    assert_true(u.is_exact && u.volume == u.sum && u.max_overlap == 0.0 && u.n_overlap == 0);
    CHECK_OK(clast_assembly_find_contacts(&a, 1e-9));
    assert_int_equal(a.n_contact, 2);
    assert_int_equal(a.contact[0][1], 1);
    assert_int_equal(a.contact[1][1], 2);
    CHECK_REL(a.contact_point[0][0], 3.0, 1e-9);
    CHECK_REL(a.contact_point[1][1], 2.0, 1e-9);
    CHECK_STATUS(clast_assembly_find_contacts(&a, -1.0), CLAST_E_USAGE);
    clast_assembly_free(&a);
    clast_union none = {0};
    const clast_union_options options = clast_union_options_default();
    CHECK_STATUS(clast_assembly_union(&a, &options, &none), CLAST_E_USAGE);
}

/* The answer and its bytes do not depend on the number of threads. */
static void union_is_the_same_for_any_threads(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_shape shape = {0};
    clx_rng rng = clx_rng_at(1, CLX_STREAM_TEST, 3);
    clast_union_options options = clast_union_options_default();
    clast_union u[3];
    CHECK_OK(clast_shape_ellipsoid("egg", (double[3]){1.0, 0.8, 0.6}, &shape));
    with_shape(&a, &shape);
    for (int i = 0; i < 20; ++i) {
        double u3[3];
        double q[4];
        clx_rng_direction(&rng, u3);
        clx_rng_orientation(&rng, q);
        v3_scale(u3, 2.0 * clx_rng_uniform(&rng), u3);
        CHECK_OK(clast_assembly_add_grain(&a, 0, u3, q, 1.0, 1.0));
    }
    options.n_sample = 50000;
    for (int32_t t = 0; t < 3; ++t) {
        clast_parallel_set_threads(t + 1);
        CHECK_OK(clast_assembly_union(&a, &options, &u[t]));
    }
    clast_parallel_set_threads(0);
    assert_memory_equal(&u[0].volume, &u[1].volume, sizeof u[0].volume);
    assert_memory_equal(&u[0].volume, &u[2].volume, sizeof u[0].volume);
    assert_true(u[0].volume < u[0].sum && u[0].error > 0.0);
    clast_assembly_free(&a);
}

static clast_status measure(void *context)
{
    clast_assembly a = {0};
    clast_union u = {0};
    const clast_union_options options = {1e-1, 4096, 1, true};
    clast_status status = clast_assembly_copy(context, &a);
    if (status == CLAST_OK) {
        status = clast_assembly_union(&a, &options, &u);
    }
    if (status == CLAST_OK) {
        status = clast_assembly_find_contacts(&a, 0.0);
    }
    clast_assembly_free(&a);
    return status;
}

static void union_survives_refused_memory(void **state)
{
    (void)state;
    clast_assembly a = {0};
    with_cube(&a);
    add(&a, 0, 0.0, 0.0, 0.0, 1.0);
    add(&a, 0, 0.5, 0.05, 0.0, 1.0);
    support_refuse_each_allocation(measure, &a);
    clast_assembly_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(overlapping_balls_are_exact),
        cmocka_unit_test(overlapping_ellipsoids_agree_with_the_mapped_lens),
        cmocka_unit_test(overlapping_boxes_and_a_ball),
        cmocka_unit_test(buried_grain_adds_nothing),
        cmocka_unit_test(touching_grains_are_summed),
        cmocka_unit_test(union_is_the_same_for_any_threads),
        cmocka_unit_test(union_survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
