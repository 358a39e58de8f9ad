/* Unit: delimited text of every dialect becomes the table it means, and comes back bit for bit. */
#include "support.h"

#include "base/alloc.h"
#include "base/file.h"
#include "math/rng.h"
#include <clast/table.h>
#include <errno.h>
#include <jansson.h>
#include <stdio.h>
#include <string.h>

static clast_status parse(const char *text, clast_table *table, clast_csv_report *report)
{
    return clast_table_parse_csv("t.csv", text, strlen(text), NULL, table, report);
}

/* One text, its shape, and one cell as it must read. */
typedef struct {
    const char *text;
    int32_t n_column;
    int64_t n_row;
    const char *column; /* of the checked cell */
    int64_t row;
    double number;
    const char *word; /* NULL: the number counts */
} example;

static const example examples[] = {
    {"a,b\n1,2\n3,4\n", 2, 2, "b", 1, 4.0, NULL},
    {"a,b\n1,2\n3,4", 2, 2, "b", 1, 4.0, NULL},         /* no last line end */
    {"a,b\r\n1,2\r\n3,4\r\n", 2, 2, "b", 0, 2.0, NULL}, /* DOS */
    {"a,b\r1,2\r3,4\r", 2, 2, "a", 1, 3.0, NULL},       /* old Mac */
    {"\xef\xbb\xbf"
     "a,b\n1,2\n",
     2, 1, "a", 0, 1.0, NULL},                        /* byte-order mark */
    {"a\tb\n1\t2\n", 2, 1, "b", 0, 2.0, NULL},        /* tabs */
    {"a\tb\tc\n1\t\t3\n", 3, 1, "c", 0, 3.0, NULL},   /* empty cell between tabs */
    {"a;b\n1.5;2,5\n", 2, 1, "b", 0, 0.0, "2,5"},     /* ';' wins over ',' */
    {"  x   y\n  1  2\n", 2, 1, "y", 0, 2.0, NULL},   /* aligned by blanks */
    {"x y \n1 2 \n 3\t4\n", 2, 2, "y", 1, 4.0, NULL}, /* blanks and tabs at ends */
    {"1,2\n3,4\n", 2, 2, "column_2", 1, 4.0, NULL},   /* no header */
    {"# made by hand\na,b\n\n1,2\n  # later\n3,4\n\n", 2, 2, "a", 1, 3.0, NULL},
    {"a , b\n 1 , 2 \n", 2, 1, "b", 0, 2.0, NULL},           /* blanks around */
    {"\"a\",\"b\"\n\"1\",\"2\"\n", 2, 1, "b", 0, 2.0, NULL}, /* all quoted */
    {"n,t\n1,\"x, \"\"y\"\"\nz\"\n", 2, 1, "t", 0, 0.0, "x, \"y\"\nz"},
    {"n,t\n1,\" x \"\n", 2, 1, "t", 0, 0.0, " x "},     /* quotes keep blanks */
    {"t\nlong word\n", 1, 1, "t", 0, 0.0, "long word"}, /* one column with blanks */
    {"maximum length\n5\n", 1, 1, "maximum length", 0, 5.0, NULL},
    {"Size (mm) u [m s-1] n\n5 6 7\n", 3, 1, "u [m s-1]", 0, 6.0, NULL}, /* units of names */
    {"x, y (mm); z\n5 6 7\n", 3, 1, "y (mm)", 0, 6.0, NULL},
    {"n t\n5 (a\n", 2, 1, "t", 0, 0.0, "(a"},       /* of names alone */
    {"grain #,n\n5,#6\n", 2, 1, "n", 0, 0.0, "#6"}, /* no comment behind cells */
    {"a,b\n1e3,-2.5E-3\n", 2, 1, "b", 0, -2.5e-3, NULL},
    {"a,b\ninf,2\n", 2, 1, "a", 0, INFINITY, NULL},
    {"a,a,\n1,2,3\n", 3, 1, "a_column_1", 0, 1.0, NULL}, /* repeated and empty names */
    {"a,a,\n1,2,3\n", 3, 1, "a_column_2", 0, 2.0, NULL},
    {"a,a,a\n1,2,3\n", 3, 1, "a_column_3", 0, 3.0, NULL},
    {"a,a,\n1,2,3\n", 3, 1, "column_3", 0, 3.0, NULL},
    {"a,b\n1,x\n2,3\n", 2, 2, "b", 1, 0.0, "3"}, /* one word makes a text column */
    {"a,b\n", 2, 0, NULL, 0, 0.0, NULL},
};

static void every_dialect_reads_as_meant(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof examples / sizeof examples[0]; ++i) {
        const example *e = &examples[i];
        clast_table t = {0};
        CHECK_OK(parse(e->text, &t, NULL));
        if (t.n_column != e->n_column || t.n_row != e->n_row) {
            fail_msg("'%s': %d columns, %lld rows", e->text, t.n_column, (long long)t.n_row);
        }
        const int32_t c = e->column != NULL ? clast_table_find(&t, e->column) : 0;
        if (c < 0) {
            fail_msg("'%s': no column %s", e->text, e->column);
        }
        if (e->word != NULL) {
            assert_non_null(t.column[c].text);
            assert_string_equal(t.column[c].text[e->row], e->word);
        } else if (e->column != NULL) {
            assert_non_null(t.column[c].number);
            assert_true(t.column[c].number[e->row] == e->number);
        }
        clast_table_free(&t);
    }
}

static void wrong_texts_are_refused_with_their_line(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"a,b\n1,2\n3\n4,5,6\n", "t.csv:3: 1 cells where the first row has 2; 2 such rows"},
        {"a,b\n1,2,\n", "t.csv:2: 3 cells"},
        {"a,b\n1,\"x\n\n", "t.csv:2: a quote is opened and never closed"},
        {"a,b\n1,\"x\"y\n", "t.csv:2: 'y' after a closing quote"},
        {"n,t\n1,\"two\nlines\"\n1,2,3\n", "t.csv:4: 3 cells"},
        {"", "no row"},
        {"\n\n# only this\n", "no row"},
        {"\xff\xfe"
         "a",
         "UTF-16"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        clast_table t = {0};
        CHECK_STATUS(parse(cases[i][0], &t, NULL), CLAST_E_FORMAT);
        if (strstr(clast_error_detail(), cases[i][1]) == NULL) {
            fail_msg("'%s' does not say '%s'", clast_error_detail(), cases[i][1]);
        }
        assert_null(t.column);
    }
    clast_table t = {0};
    CHECK_STATUS(clast_table_parse_csv("t", "a\0b", 3, NULL, &t, NULL), CLAST_E_FORMAT);
    CHECK_STATUS(clast_table_read_csv(support_scratch_file("absent.csv"), NULL, &t, NULL),
                 CLAST_E_IO);
}

static void report_counts_what_was_left_out(void **state)
{
    (void)state;
    clast_table t = {0};
    clast_csv_report r;
    CHECK_OK(parse("# c\nd_um;x\n\n1;NA\n;2\n# d\n3;nan\n", &t, &r));
    assert_int_equal(r.separator, ';');
    assert_true(r.has_header);
    assert_int_equal(r.n_line, 7);
    assert_int_equal(r.n_comment, 2);
    assert_int_equal(r.n_blank, 1);
    assert_int_equal(r.n_missing, 2);
    assert_int_equal(r.n_renamed, 0);
    assert_true(isnan(clast_table_numbers(&t, "d_um")[1]));
    clast_table_free(&t);
}

static void options_overrule_guesses(void **state)
{
    (void)state;
    clast_table t = {0};
    const clast_csv_options header = {.header = 1};
    const clast_csv_options none = {.header = -1, .no_comment = true, .separator = ','};
    CHECK_OK(clast_table_parse_csv("t", "1,2\n3,4\n", 8, &header, &t, NULL));
    assert_int_equal(t.n_row, 1);
    assert_string_equal(t.column[0].name, "1");
    clast_table_free(&t);
    CHECK_OK(clast_table_parse_csv("t", "#a,b\nc,d\n", 9, &none, &t, NULL));
    assert_int_equal(t.n_row, 2);
    assert_string_equal(t.column[0].text[0], "#a");
    clast_table_free(&t);
}

static void headers_tell_units(void **state)
{
    (void)state;
    static const char *const units[] = {"m",  "um",   "kg/m^3", "-",   "\xc2\xb5m", "-",
                                        "ug", "um^2", "ns",     "m^5", "-",         "in"};
    clast_table t = {0};
    CHECK_OK(
        parse("d_m,diameter (um),rho [kg/m^3],n,s_\xc2\xb5m,odd_name,mass (ug),area [um^2],t_ns,"
              "inertia_m^5,flow_in,d (in)\n1,2,3,4,5,6,7,8,9,10,11,12\n",
              &t, NULL));
    for (int32_t i = 0; i < t.n_column; ++i) {
        assert_string_equal(t.column[i].unit, units[i]);
    }
    clast_table_free(&t);
}

static clast_status make_table(clast_table *t)
{
    clast_status status = CLAST_OK;
    double *x = NULL;
    CLX_TRY(clast_table_init(t, "all", 4));
    CLX_TRY(clast_table_add_number(t, "x_m", "m", &x));
    const double values[4] = {0.1, -0.0, 1.0 / 3.0, 5e-324};
    memcpy(x, values, sizeof values);
    CLX_TRY(clast_table_add_text(t, "t"));
    CLX_TRY(clast_table_set_text(t, 1, 0, "comma, \"quote\"\r\nline"));
    CLX_TRY(clast_table_set_text(t, 1, 1, " blanks "));
    CLX_TRY(clast_table_set_text(t, 1, 2, "#not a comment"));
    CLX_TRY(clast_table_add_number(t, "odd name, with comma", "-", &x));
    const double odd[4] = {NAN, INFINITY, -INFINITY, 1.7976931348623157e308};
    memcpy(x, odd, sizeof odd);
done:
    return status;
}

static bool same_number(double a, double b)
{
    return isnan(a) ? isnan(b) != 0 : memcmp(&a, &b, sizeof a) == 0;
}

static void check_same(const clast_table *a, const clast_table *b)
{
    assert_int_equal(a->n_row, b->n_row);
    assert_int_equal(a->n_column, b->n_column);
    for (int32_t c = 0; c < a->n_column; ++c) {
        assert_string_equal(a->column[c].name, b->column[c].name);
        assert_int_equal(a->column[c].number != NULL, b->column[c].number != NULL);
        for (int64_t i = 0; i < a->n_row; ++i) {
            if (a->column[c].number != NULL) {
                assert_true(same_number(a->column[c].number[i], b->column[c].number[i]));
            } else {
                assert_string_equal(a->column[c].text[i], b->column[c].text[i]);
            }
        }
    }
}

static void written_tables_come_back_bit_for_bit(void **state)
{
    (void)state;
    clast_table t = {0};
    clast_table back = {0};
    CHECK_OK(make_table(&t));
    CHECK_OK(clast_table_write_csv(&t, support_scratch_file("all.csv")));
    CHECK_OK(clast_table_read_csv(support_scratch_file("all.csv"), NULL, &back, NULL));
    check_same(&t, &back);
    assert_string_equal(back.column[0].unit, "m");
    clast_table_free(&t);
    clast_table_free(&back);
}

/* What does not exist is an empty cell, and a row of one such cell still is a row. */
static void missing_numbers_are_empty_cells(void **state)
{
    (void)state;
    clast_table t = {0};
    clast_table back = {0};
    clast_csv_report report;
    double *x = NULL;
    char text[64] = "";
    CHECK_OK(clast_table_init(&t, "one", 3));
    CHECK_OK(clast_table_add_number(&t, "x", "-", &x));
    x[0] = NAN;
    x[1] = 0.5;
    x[2] = -NAN;
    CHECK_OK(clast_table_write_csv(&t, support_scratch_file("one.csv")));
    FILE *file = fopen(support_scratch_file("one.csv"), "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    (void)fclose(file);
    assert_string_equal(text, "x\n\"\"\n0.5\n\"\"\n");
    CHECK_OK(clast_table_read_csv(support_scratch_file("one.csv"), NULL, &back, &report));
    check_same(&t, &back);
    assert_int_equal(report.n_missing, 2);
    clast_table_free(&t);
    clast_table_free(&back);
}

/* Property: any double survives, of 20,000 random bit patterns. */
static void random_numbers_come_back_bit_for_bit(void **state)
{
    (void)state;
    enum { N = 20000 };
    clast_table t = {0};
    clast_table back = {0};
    double *x = NULL;
    clx_rng rng = clx_rng_at(9, CLX_STREAM_TEST, 0);
    CHECK_OK(clast_table_init(&t, "random", N));
    CHECK_OK(clast_table_add_number(&t, "x", "-", &x));
    for (int i = 0; i < N; ++i) {
        const uint64_t bits = (uint64_t)clx_rng_u32(&rng) << 32 | clx_rng_u32(&rng);
        memcpy(&x[i], &bits, sizeof bits);
    }
    CHECK_OK(clast_table_write_csv(&t, support_scratch_file("random.csv")));
    CHECK_OK(clast_table_read_csv(support_scratch_file("random.csv"), NULL, &back, NULL));
    check_same(&t, &back);
    clast_table_free(&t);
    clast_table_free(&back);
}

static void json_is_what_jansson_reads(void **state)
{
    (void)state;
    clast_table t = {0};
    json_error_t error;
    CHECK_OK(make_table(&t));
    CHECK_OK(clast_table_set_text(&t, 1, 3, "\x01 \xff \xed\xa0\x80 \xc3\xa9"));
    CHECK_OK(clast_table_write_json(&t, support_scratch_file("all.json")));
    json_t *root = json_load_file(support_scratch_file("all.json"), 0, &error);
    assert_non_null(root);
    const json_t *columns = json_object_get(root, "columns");
    assert_int_equal(json_integer_value(json_object_get(root, "n_row")), 4);
    const json_t *x = json_object_get(json_array_get(columns, 0), "values");
    assert_true(json_real_value(json_array_get(x, 2)) == 1.0 / 3.0);
    const json_t *words = json_object_get(json_array_get(columns, 1), "values");
    assert_string_equal(json_string_value(json_array_get(words, 0)), t.column[1].text[0]);
    assert_string_equal(json_string_value(json_array_get(words, 3)),
                        "\x01 \xef\xbf\xbd \xef\xbf\xbd\xef\xbf\xbd\xef\xbf\xbd \xc3\xa9");
    const json_t *odd = json_object_get(json_array_get(columns, 2), "values");
    assert_true(json_is_null(json_array_get(odd, 0)) && json_is_null(json_array_get(odd, 1)));
    json_decref(root);
    clast_table_free(&t);
}

static clast_status write_and_read(void *context)
{
    (void)context;
    clast_status status = CLAST_OK;
    clast_table t = {0};
    clast_table back = {0};
    CLX_TRY(make_table(&t));
    CLX_TRY(clast_table_write_csv(&t, support_scratch_file("memory.csv")));
    CLX_TRY(clast_table_write_json(&t, support_scratch_file("memory.json")));
    CLX_TRY(clast_table_read_csv(support_scratch_file("memory.csv"), NULL, &back, NULL));
done:
    clast_table_free(&t);
    clast_table_free(&back);
    return status;
}

static void tables_survive_refused_memory(void **state)
{
    (void)state;
    support_refuse_each_allocation(write_and_read, NULL);
}

static void full_disk_is_reported(void **state)
{
    (void)state;
    clast_table t = {0};
    CHECK_OK(make_table(&t));
    CHECK_STATUS(clast_table_write_csv(&t, "/dev/full"), CLAST_E_DISK);
    CHECK_STATUS(clast_table_write_json(&t, "/dev/full"), CLAST_E_DISK);
    CHECK_STATUS(clast_table_write_csv(&t, support_scratch_file("absent/t.csv")), CLAST_E_DISK);
    clast_table_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_dialect_reads_as_meant),
        cmocka_unit_test(wrong_texts_are_refused_with_their_line),
        cmocka_unit_test(report_counts_what_was_left_out),
        cmocka_unit_test(options_overrule_guesses),
        cmocka_unit_test(headers_tell_units),
        cmocka_unit_test(written_tables_come_back_bit_for_bit),
        cmocka_unit_test(missing_numbers_are_empty_cells),
        cmocka_unit_test(random_numbers_come_back_bit_for_bit),
        cmocka_unit_test(json_is_what_jansson_reads),
        cmocka_unit_test(tables_survive_refused_memory),
        cmocka_unit_test(full_disk_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
