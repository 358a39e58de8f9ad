/* Unit: sphere sets survive files; odd headers are understood; bad rows are named. */
#include "support.h"

#include <clast/shape.h>
#include <stdio.h>
#include <string.h>

static void put(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    (void)fputs(text, file);
    (void)fclose(file);
}

static void csv_gives_back_the_same_doubles(void **state)
{
    (void)state;
    double centre[2][3] = {{1.0 / 3.0, -2.0e-17, 3.0}, {1e300, 0.1, -0.0}};
    double radius[2] = {0.7, 1e-12};
    const clast_spheres s = {2, centre, radius};
    clast_spheres back = {0};
    const char *path = support_scratch_file("round.csv");
    CHECK_OK(clast_spheres_write(&s, path, "any", NULL));
    CHECK_OK(clast_spheres_read(path, NULL, &back));
    assert_int_equal(back.n, 2);
    assert_memory_equal(back.centre, centre, sizeof centre);
    assert_memory_equal(back.radius, radius, sizeof radius);
    clast_spheres_free(&back);
}

static void columns_are_found_by_name_or_place(void **state)
{
    (void)state;
    static const char *const texts[] = {"x_um,y_um,z_um,r_um\n1,2,3,4\n", "radius,z,y,x\n4,3,2,1\n",
                                        "1 2 3 4\n", "a,b,c,d\n1,2,3,4\n",
                                        "x_mm,y_cm,z_mm,r_um\n1,0.2,3,4000\n"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        clast_spheres s = {0};
        const double most = i < 4 ? 0.0 : 1e-12; // of several units in that of x
        const char *path = support_scratch_file("columns.csv");
        put(path, texts[i]);
        CHECK_OK(clast_spheres_read(path, NULL, &s));
        for (int k = 0; k < 3; ++k) {
            CHECK_ABS(s.centre[0][k], k + 1.0, most);
        }
        CHECK_ABS(s.radius[0], 4.0, most);
        clast_spheres_free(&s);
    }
}

static void bad_rows_and_columns_are_refused(void **state)
{
    (void)state;
    static const char *const texts[] = {"x,y,z\n1,2,3\n",
                                        "x,y,z,radius\n1,2,3,0\n",
                                        "x,y,z,radius\n1,nan,3,1\n",
                                        "x,y,z,radius\n1,2,3,big\n",
                                        "x,y,z,radius\n",
                                        "x,y,z,d (phi)\n1,2,3,1\n",
                                        "x (ft),y (ft),z (ft),r (ft)\n1,2,3,1\n",
                                        "x_mm,y_mm,z_mm,radius\n1,2,3,1\n"};
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        clast_spheres s = {0};
        const char *path = support_scratch_file("bad.csv");
        put(path, texts[i]);
        CHECK_STATUS(clast_spheres_read(path, NULL, &s), CLAST_E_FORMAT);
        assert_non_null(strstr(clast_error_detail(), "bad.csv"));
        assert_null(s.centre);
    }
}

static void state_file_gains_and_replaces_sets(void **state)
{
    (void)state;
    double centre[2][3] = {{1, 2, 3}, {4, 5, 6}};
    double radius[2] = {7, 8};
    const clast_spheres two = {2, centre, radius};
    const clast_spheres one = {1, centre, radius};
    clast_spheres back = {0};
    char path[600];
    (void)snprintf(path, sizeof path, "%s", support_scratch_file("sets.h5"));
    CHECK_OK(clast_spheres_write(&two, path, "a", NULL));
    CHECK_OK(clast_spheres_write(&one, path, "b", NULL));
    CHECK_OK(clast_spheres_read(path, "a", &back));
    assert_int_equal(back.n, 2);
    clast_spheres_free(&back);
    CHECK_OK(clast_spheres_write(&one, path, "a", NULL));
    CHECK_OK(clast_spheres_read(path, "a", &back));
    assert_int_equal(back.n, 1);
    clast_spheres_free(&back);
    CHECK_STATUS(clast_spheres_write(&one, path, "c", "um"), CLAST_E_USAGE);
    put(path, "no state file");
    CHECK_STATUS(clast_spheres_write(&one, path, "a", NULL), CLAST_E_FORMAT);
    CHECK_STATUS(clast_spheres_write(&one, support_scratch_file("a.xyz"), "a", NULL),
                 CLAST_E_USAGE);
    CHECK_STATUS(clast_spheres_read(support_scratch_file("a.csv"), "a", &back), CLAST_E_USAGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(csv_gives_back_the_same_doubles),
        cmocka_unit_test(columns_are_found_by_name_or_place),
        cmocka_unit_test(bad_rows_and_columns_are_refused),
        cmocka_unit_test(state_file_gains_and_replaces_sets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
