/* Unit: the depth of an overlap is a shift that parts the pair; a grain's overlap with its own
 * image is none; what cannot be a period is refused. */
#include "support.h"

#include <string.h>

static const double no_turn[4] = {1.0, 0.0, 0.0, 0.0};

/* Shape 0 a cube of edge 2, shape 1 a ball of radius 1. */
static void two_shapes(clast_assembly *a)
{
    clast_mesh mesh = {0};
    clast_shape shape = {0};
    *a = (clast_assembly){0};
    CHECK_OK(clast_mesh_box(2.0, 2.0, 2.0, &mesh));
    CHECK_OK(clast_shape_mesh("cube", &mesh, &shape));
    CHECK_OK(clast_assembly_add_shape(a, &shape, NULL));
    clast_shape_free(&shape);
    CHECK_OK(clast_shape_sphere("ball", 1.0, &shape));
    CHECK_OK(clast_assembly_add_shape(a, &shape, NULL));
    clast_shape_free(&shape);
    clast_mesh_free(&mesh);
}

static void add(clast_assembly *a, int32_t shape, double x, double y, double z)
{
    CHECK_OK(clast_assembly_add_grain(a, shape, (double[3]){x, y, z}, no_turn, 1.0, 1000.0));
}

/* Before, the middle of the last bracket was given: two cubes 1.5 apart had a depth of 0.49989 and
 * still overlapped after a shift by it. */
static void a_shift_by_the_depth_parts_the_pair(void **state)
{
    (void)state;
    for (int k = 1; k < 40; ++k) {
        clast_assembly a;
        clast_overlaps found;
        two_shapes(&a);
        add(&a, 0, 0.0, 0.0, 0.0);
        add(&a, k % 2, 0.05 * k, 0.0, 0.0);
        const double wanted = 2.0 - 0.05 * k;
        CHECK_OK(clast_assembly_overlaps(&a, NULL, &found));
        assert_int_equal(found.n, 1);
        assert_true(found.depth >= wanted * (1.0 - 1e-12));
        assert_true(found.depth <= 1.001 * wanted);
        a.position[1][0] += found.depth;
        CHECK_OK(clast_assembly_overlaps(&a, NULL, &found));
        assert_int_equal(found.n, 0);
        clast_assembly_free(&a);
    }
}

/* Before: no pair, and a depth of 0.5. */
static void a_grain_and_its_own_image_are_no_pair(void **state)
{
    (void)state;
    clast_assembly a;
    clast_overlaps found;
    const clast_period period = {{0.0, 0.0, 0.0}, {1.5, 0.0, 0.0}};
    two_shapes(&a);
    add(&a, 1, 0.5, 0.5, 0.5);
    CHECK_OK(clast_assembly_overlaps(&a, &period, &found));
    assert_true(found.n == 0 && found.depth == 0.0 && found.share == 0.0);
    CHECK_OK(clast_assembly_find_contacts_periodic(&a, 0.0, &period));
    assert_int_equal(a.n_contact, 0);
    clast_assembly_free(&a);
}

/* Pairs across the border count once, with their depth. */
static void pairs_across_the_border_count_once(void **state)
{
    (void)state;
    clast_assembly a;
    clast_overlaps found;
    const clast_period period = {{0.0, 0.0, 0.0}, {5.0, 0.0, 0.0}};
    two_shapes(&a);
    add(&a, 1, 0.5, 0.5, 0.5);
    add(&a, 1, 4.0, 0.5, 0.5); /* 1.5 beyond the border */
    CHECK_OK(clast_assembly_overlaps(&a, &period, &found));
    assert_int_equal(found.n, 1);
    CHECK_REL(found.depth, 0.5, 1e-12);
    clast_assembly_free(&a);
}

/* The same bed for grains that lie in other images of the box, and for a box that lies elsewhere:
 * before, grains outside of it had other contacts, without a word. A contact across the border has
 * its point beside the grain of lower number, wherever that is. */
static void any_image_of_a_grain_has_its_contacts(void **state)
{
    (void)state;
    const double at[5][3] = {
        {0.5, 0.5, 0.5}, {4.0, 0.5, 0.5}, {2.2, 0.5, 3.9}, {2.2, 0.5, 0.4}, {4.9, 4.6, 4.7}};
    const clast_period period = {{0.0, 0.0, 0.0}, {5.0, 5.0, 5.0}};
    clast_assembly a;
    clast_overlaps found;
    two_shapes(&a);
    for (int i = 0; i < 5; ++i) {
        add(&a, 1, at[i][0], at[i][1], at[i][2]);
    }
    CHECK_OK(clast_assembly_find_contacts_periodic(&a, 0.0, &period));
    CHECK_OK(clast_assembly_overlaps(&a, &period, &found));
    const int32_t n = a.n_contact;
    assert_true(n >= 3);
    for (int k = 0; k < 40; ++k) {
        clast_assembly b;
        clast_overlaps moved;
        clast_period box = period;
        bool is_pair[2][5][5] = {{{false}}};
        double shift[5][3];
        two_shapes(&b);
        for (int i = 0; i < 5; ++i) {
            for (int c = 0; c < 3; ++c) {
                shift[i][c] = 5.0 * ((i * 7 + c * 3 + k * 5) % 11 - 5) * (k % 2);
                box.low[c] = k < 2 ? 0.0 : 0.73 * k - 9.0 + c;
            }
            add(&b, 1, at[i][0] + shift[i][0], at[i][1] + shift[i][1], at[i][2] + shift[i][2]);
        }
        CHECK_OK(clast_assembly_find_contacts_periodic(&b, 0.0, &box));
        CHECK_OK(clast_assembly_overlaps(&b, &box, &moved));
        assert_int_equal(b.n_contact, n);
        assert_int_equal(moved.n, found.n);
        CHECK_REL(moved.depth, found.depth, 1e-12);
        for (int32_t c = 0; c < n; ++c) {
            is_pair[1][b.contact[c][0]][b.contact[c][1]] = true;
            is_pair[0][a.contact[c][0]][a.contact[c][1]] = true;
            const double *own = b.position[b.contact[c][0]];
            const double *point = b.contact_point[c];
            assert_true(hypot(hypot(point[0] - own[0], point[1] - own[1]), point[2] - own[2]) <
                        1.0);
        }
        assert_memory_equal(is_pair[0], is_pair[1], sizeof is_pair[0]);
        clast_assembly_free(&b);
    }
    clast_assembly_free(&a);
}

/* Before, a period of NaN, -2.6 or INFINITY was none, without a word. */
static void periods_that_cannot_be_are_refused(void **state)
{
    (void)state;
    const double bad[] = {(double)NAN, -2.6, (double)INFINITY, -(double)INFINITY};
    clast_assembly a;
    clast_overlaps found;
    two_shapes(&a);
    add(&a, 1, 0.5, 0.5, 0.5);
    CHECK_OK(clast_assembly_find_contacts(&a, 0.0));
    for (int k = 0; k < 8; ++k) {
        for (int axis = 0; axis < 3; ++axis) {
            clast_period period = {{0.0, 0.0, 0.0}, {4.0, 0.0, 4.0}};
            if (k % 2 == 1 && bad[k / 2] == -2.6) {
                continue; /* the corner may lie there */
            }
            (k % 2 == 0 ? period.length : period.low)[axis] = bad[k / 2];
            memset(&found, 0x5a, sizeof found);
            const clast_overlaps before = found;
            CHECK_STATUS(clast_assembly_find_contacts_periodic(&a, 0.0, &period), CLAST_E_ARGUMENT);
            CHECK_STATUS(clast_assembly_overlaps(&a, &period, &found), CLAST_E_ARGUMENT);
            assert_memory_equal(&found, &before, sizeof found);
        }
    }
    clast_assembly_free(&a);
}

static void gaps_and_tolerances_that_cannot_be_are_refused(void **state)
{
    (void)state;
    const double bad[] = {(double)NAN, -1.0, (double)INFINITY};
    clast_assembly a;
    clast_union found;
    const clast_period period = {0};
    two_shapes(&a);
    add(&a, 1, 0.5, 0.5, 0.5);
    for (int k = 0; k < 3; ++k) {
        CHECK_STATUS(clast_assembly_find_contacts(&a, bad[k]), CLAST_E_USAGE);
        assert_non_null(strstr(clast_error_detail(), "must be finite and not negative"));
        CHECK_STATUS(clast_assembly_find_contacts_periodic(&a, bad[k], &period), CLAST_E_USAGE);
        assert_non_null(strstr(clast_error_detail(), "must be finite and not negative"));
    }
    for (int k = 0; k < 2; ++k) {
        clast_union_options options = clast_union_options_default();
        options.tolerance = bad[k];
        CHECK_STATUS(clast_assembly_union(&a, &options, &found), CLAST_E_ARGUMENT);
    }
    clast_assembly_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_shift_by_the_depth_parts_the_pair),
        cmocka_unit_test(a_grain_and_its_own_image_are_no_pair),
        cmocka_unit_test(pairs_across_the_border_count_once),
        cmocka_unit_test(any_image_of_a_grain_has_its_contacts),
        cmocka_unit_test(periods_that_cannot_be_are_refused),
        cmocka_unit_test(gaps_and_tolerances_that_cannot_be_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
