/* Unit: tables by call, with numbers of rows that cannot be. Before, clast_table_resize(&t, -1)
 * read in front of the arrays, and a table could be made with -1 rows. */
#include "support.h"

#include <string.h>

static void rows_below_none_are_refused(void **state)
{
    (void)state;
    clast_table t = {0};
    double *x = NULL;
    CHECK_STATUS(clast_table_init(&t, "z", -1), CLAST_E_ARGUMENT);
    CHECK_STATUS(clast_table_init(&t, "z", INT64_MIN), CLAST_E_ARGUMENT);
    assert_true(t.name == NULL && t.n_row == 0);
    CHECK_OK(clast_table_init(&t, "t", 2));
    CHECK_OK(clast_table_add_number(&t, "x", "m", &x));
    CHECK_OK(clast_table_add_text(&t, "word"));
    x[1] = 3.0;
    CHECK_OK(clast_table_set_text(&t, 1, 1, "last"));
    CHECK_STATUS(clast_table_resize(&t, -1), CLAST_E_ARGUMENT);
    CHECK_STATUS(clast_table_resize(&t, INT64_MIN), CLAST_E_ARGUMENT);
    assert_int_equal(t.n_row, 2);
    assert_true(clast_table_numbers(&t, "x")[1] == 3.0);
    assert_string_equal(t.column[1].text[1], "last");
    clast_table_free(&t);
}

static void rows_come_and_go(void **state)
{
    (void)state;
    clast_table t = {0};
    double *x = NULL;
    CHECK_OK(clast_table_init(&t, "t", 0));
    CHECK_OK(clast_table_add_number(&t, "x", "m", &x));
    CHECK_OK(clast_table_add_text(&t, "word"));
    CHECK_OK(clast_table_resize(&t, 3));
    assert_true(clast_table_numbers(&t, "x")[2] == 0.0);
    assert_string_equal(t.column[1].text[2], "");
    CHECK_OK(clast_table_set_text(&t, 1, 2, "gone"));
    CHECK_OK(clast_table_resize(&t, 2));
    CHECK_OK(clast_table_resize(&t, 3));
    assert_string_equal(t.column[1].text[2], "");
    CHECK_OK(clast_table_resize(&t, 0));
    clast_table_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_below_none_are_refused),
        cmocka_unit_test(rows_come_and_go),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
