/* Unit: grains from files of all kinds, joined in order whatever the threads. */
#include "support.h"

#include <stdio.h>
#include <string.h>

static const char *put(const char *name, const char *text)
{
    static char path[4][4200];
    static int next;
    char *own = path[next++ % 4];
    (void)snprintf(own, sizeof path[0], "%s/%s", support_scratch(), name);
    FILE *file = fopen(own, "w");
    assert_non_null(file);
    (void)fputs(text, file);
    (void)fclose(file);
    return own;
}

static clast_grains_options plain(void)
{
    return (clast_grains_options){.degree = -1, .level = 1};
}

static const char *const TABLE = "L (mm),I (mm),S (mm)\n3,2,1\n4,,1\n";
static const char *const SERIES = "0 0 9 0\n1 0 0.1 0\n1 1 0 0\n";
static const char *const POINTS = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";

static void files_keep_their_order_and_bad_ones_are_faults(void **state)
{
    (void)state;
    const char *path[4] = {put("a.dat", SERIES), "no/such/file.stl", put("t.csv", TABLE),
                           put("p.xyz", POINTS)};
    const clast_grains_options options = plain();
    clast_grains grains = {0};
    CHECK_OK(clast_grains_read(4, path, &options, NULL, &grains));
    assert_int_equal(grains.n, 3);
    assert_int_equal(grains.record[0].kind, CLAST_GRAINS_SERIES);
    assert_int_equal(grains.record[1].kind, CLAST_GRAINS_TABLE);
    assert_int_equal(grains.record[2].kind, CLAST_GRAINS_POINTS);
    CHECK_REL(grains.record[2].grain.volume, 1.0 / 6.0, 1e-14);
    assert_int_equal(grains.n_fault, 1);
    assert_non_null(strstr(grains.fault[0].text, "no/such/file.stl"));
    assert_int_equal(grains.n_note, 1);
    assert_non_null(strstr(grains.note[0].text, "left out"));
    clast_grains_free(&grains);
}

/* Rows x, y, z, r were taken for points: the hull of the centres, without the radii. */
static void spheres_are_a_clump_and_not_the_hull_of_their_centres(void **state)
{
    (void)state;
    const char *path[3] = {put("c.csv", "x,y,z,r\n0,0,0,1\n3,0,0,1\n0,3,0,1\n0,0,3,1\n"),
                           put("d.csv", "x_mm,y_mm,z_mm,diameter_mm\n0,0,0,2\n3,0,0,2\n"),
                           put("e.csv", "x,y,z\n0,0,0\n3,0,0\n0,3,0\n0,0,3\n")};
    clast_grains_options options = plain();
    clast_grains grains = {0};
    clast_table table = {0};
    CHECK_OK(clast_grains_read(3, path, &options, NULL, &grains));
    assert_int_equal(grains.n, 3);
    assert_int_equal(grains.record[0].kind, CLAST_GRAINS_CLUMP);
    assert_int_equal(grains.record[2].kind, CLAST_GRAINS_POINTS);
    CHECK_REL(grains.record[0].grain.volume, 4.0 * 4.0 / 3.0 * CLAST_PI, 1e-13);
    CHECK_REL(grains.record[1].grain.volume, 2.0 * 4.0 / 3.0 * CLAST_PI * 1e-9, 1e-13);
    CHECK_REL(grains.record[1].unit_m, 1e-3, 1e-15); // of its columns; it is in metres
    CHECK_OK(clast_grains_table(&grains, CLAST_AXES_BOX, false, &table));
    assert_true(isnan(clast_table_numbers(&table, "flatness")[0]));
    assert_string_equal(table.column[clast_table_find(&table, "zingg")].text[0], "-");
    clast_table_free(&table);
    clast_grains_free(&grains);
    options.hull = true;
    CHECK_OK(clast_grains_read(1, path, &options, NULL, &grains));
    assert_int_equal(grains.n_fault, 1);
    clast_grains_free(&grains);
}

/* P_2 about a ball: all of the form is in degree 2; below it, all of it is cut off. */
static void series_say_what_their_last_degrees_hold(void **state)
{
    (void)state;
    const char *path[1] = {put("s.dat", "0 0 9 0\n1 0 0 0\n1 1 0 0\n2 0 0.1 0\n2 1 0 0\n"
                                        "2 2 0 0\n3 0 0 0\n3 1 0 0\n3 2 0 0\n3 3 0 0\n4 0 0 0\n"
                                        "4 1 0 0\n4 2 0 0\n4 3 0 0\n4 4 0 0\n")};
    clast_grains_options options = plain();
    for (int degree = 1; degree <= 4; ++degree) {
        clast_grains grains = {0};
        options.degree = degree;
        CHECK_OK(clast_grains_read(1, path, &options, NULL, &grains));
        assert_int_equal(grains.record[0].degree, degree);
        CHECK_ABS(grains.record[0].power_last, degree == 2 || degree == 3 ? 1.0 : 0.0, 1e-15);
        CHECK_ABS(grains.record[0].power_cut, degree == 1 ? 1.0 : 0.0, 1e-15);
        clast_grains_free(&grains);
    }
}

static void a_tables_own_unit_counts_before_the_given_one(void **state)
{
    (void)state;
    const char *path[2] = {put("t.csv", TABLE), put("a.dat", SERIES)};
    const clast_grains_options options = plain();
    clast_grains grains = {0};
    CHECK_OK(clast_grains_read(2, path, &options, NULL, &grains));
    const double volume = grains.record[1].grain.volume;
    bool in_metres = true;
    CHECK_OK(clast_grains_to_metres(&grains, 0.0, &in_metres));
    assert_false(in_metres);
    CHECK_REL(grains.record[1].grain.volume, volume, 0.0);
    CHECK_OK(clast_grains_to_metres(&grains, 1e-6, &in_metres));
    assert_true(in_metres);
    CHECK_REL(grains.record[0].grain.axes[CLAST_AXES_ELLIPSOID].lis[0], 3e-3, 1e-12);
    CHECK_REL(grains.record[1].grain.volume, 1e-18 * volume, 1e-12);
    clast_grains_free(&grains);
}

static void the_table_has_nan_for_what_is_not_known(void **state)
{
    (void)state;
    const char *path[2] = {put("t.csv", TABLE), put("a.dat", SERIES)};
    const clast_grains_options options = plain();
    clast_grains grains = {0};
    clast_table table = {0};
    CHECK_OK(clast_grains_read(2, path, &options, NULL, &grains));
    CHECK_OK(clast_grains_table(&grains, CLAST_AXES_FITTED, false, &table));
    assert_int_equal(table.n_row, 2);
    assert_true(isnan(clast_table_numbers(&table, "volume")[0]));
    assert_true(clast_table_numbers(&table, "volume")[1] > 0.0);
    CHECK_REL(clast_table_numbers(&table, "flatness")[0], 0.5, 1e-12);
    CHECK_REL(clast_table_numbers(&table, "inverse_equancy")[0], 3.0, 1e-12);
    assert_true(clast_table_numbers(&table, "L")[1] == clast_table_numbers(&table, "fitted_L")[1]);
    clast_table_free(&table);
    CHECK_STATUS(clast_grains_table(&grains, CLAST_N_AXES, false, &table), CLAST_E_ARGUMENT);
    clast_grains_free(&grains);
}

/* Two tetrahedra, the inner one outward as the outer: it counts twice. */
static const char *const DOUBLED =
    "OFF\n8 8 0\n0 0 0\n8 0 0\n0 8 0\n0 0 8\n1 1 1\n2 1 1\n1 2 1\n1 1 2\n3 0 2 1\n3 0 1 3\n3 0 3 "
    "2\n3 1 2 3\n3 4 6 5\n3 4 5 7\n3 4 7 6\n3 5 6 7\n";

static void a_surface_that_counts_twice_is_noted(void **state)
{
    (void)state;
    const char *path[2] = {put("doubled.off", DOUBLED), put("t.csv", TABLE)};
    const clast_grains_options options = plain();
    clast_grains grains = {0};
    CHECK_OK(clast_grains_read(2, path, &options, NULL, &grains));
    assert_int_equal(grains.n_note, 2);
    assert_int_equal(grains.note[0].status, CLAST_E_GEOMETRY);
    assert_non_null(strstr(grains.note[0].text, "doubled.off: 1 of its 2 parts counts twice"));
    assert_int_equal(grains.note[1].status, CLAST_OK); /* rows left out */
    clast_grains_free(&grains);
}

static void two_files_of_one_surface_are_refused(void **state)
{
    (void)state;
    const char *path[2] = {put("q.dat", SERIES), put("q.xyz", POINTS)};
    clast_grains_options options = plain();
    clast_grains grains = {0};
    options.folder = support_scratch();
    CHECK_STATUS(clast_grains_read(2, path, &options, NULL, &grains), CLAST_E_USAGE);
    assert_non_null(strstr(clast_error_detail(), "q.dat and "));
    assert_non_null(strstr(clast_error_detail(), "q.xyz would both write"));
    assert_int_equal(grains.n, 0);
    options.folder = NULL;
    CHECK_OK(clast_grains_read(2, path, &options, NULL, &grains));
    assert_int_equal(grains.n, 2);
    clast_grains_free(&grains);
}

static clast_status read_two(void *context)
{
    clast_grains_options options = plain();
    clast_grains grains = {0};
    options.folder = support_scratch();
    const clast_status status = clast_grains_read(2, context, &options, NULL, &grains);
    clast_grains_free(&grains);
    return status;
}

static clast_status read_all(void *context)
{
    const clast_grains_options options = plain();
    clast_grains grains = {0};
    clast_table table = {0};
    clast_status status = clast_grains_read(1, context, &options, NULL, &grains);
    if (status == CLAST_OK) {
        status = clast_grains_table(&grains, CLAST_AXES_BOX, true, &table);
    }
    clast_table_free(&table);
    clast_grains_free(&grains);
    return status;
}

static void reading_survives_refused_memory(void **state)
{
    (void)state;
    const char *table[1] = {put("t.csv", TABLE)};
    const char *points[1] = {put("p.xyz", POINTS)};
    support_refuse_each_allocation(read_all, table);
    support_refuse_each_allocation(read_all, points);
    const char *doubled[1] = {put("doubled.off", DOUBLED)};
    support_refuse_each_allocation(read_all, doubled);
    const char *two[2] = {put("two.csv", TABLE), put("two.xyz", POINTS)};
    support_refuse_each_allocation(read_two, two);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_keep_their_order_and_bad_ones_are_faults),
        cmocka_unit_test(spheres_are_a_clump_and_not_the_hull_of_their_centres),
        cmocka_unit_test(series_say_what_their_last_degrees_hold),
        cmocka_unit_test(a_tables_own_unit_counts_before_the_given_one),
        cmocka_unit_test(the_table_has_nan_for_what_is_not_known),
        cmocka_unit_test(a_surface_that_counts_twice_is_noted),
        cmocka_unit_test(two_files_of_one_surface_are_refused),
        cmocka_unit_test(reading_survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
