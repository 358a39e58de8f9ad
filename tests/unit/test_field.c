/* Unit: values of configuration fields as text. Before, an item that a list does not have was read
 * from behind the list. */
#include "support.h"

#include <string.h>

typedef struct {
    clast_f64_list number;
    clast_text_list text;
    int32_t choice;
    char *word;
    uint64_t bits;
    int32_t few;
} configuration;

#define FIELD(type, name) #name, offsetof(configuration, name), type
static const clast_field fields[] = {
    {FIELD(CLAST_FIELD_F64_LIST, number), 0.0, 0.0, 10.0, "-", "numbers", .text = ""},
    {FIELD(CLAST_FIELD_TEXT_LIST, text), 0.0, 0.0, 0.0, "-", "words", .text = ""},
    {FIELD(CLAST_FIELD_CHOICE, choice), 0.0, 0.0, 1.0, "-", "one", .text = "this|that"},
    {FIELD(CLAST_FIELD_TEXT, word), 0.0, 0.0, 0.0, "-", "a word", .text = "w"},
    {FIELD(CLAST_FIELD_U64, bits), 1.0, 0.0, 9007199254740991.0, "-", "a seed", .text = NULL},
    {FIELD(CLAST_FIELD_I32, few), 1.0, 0.0, 100.0, "-", "a number", .text = NULL},
    {0}};

/* "-1" for none. */
static void check_format(int field, const configuration *c, int32_t index, const char *wanted)
{
    char text[32] = "as it was";
    const int n = clast_field_format(&fields[field], c, index, sizeof text, text);
    if (wanted == NULL) {
        assert_int_equal(n, -1);
        assert_string_equal(text, "as it was");
    } else {
        assert_int_equal(n, strlen(wanted));
        assert_string_equal(text, wanted);
    }
}

static void items_that_there_are_not_have_no_text(void **state)
{
    (void)state;
    configuration c;
    CHECK_OK(clast_fields_default(fields, &c));
    for (int list = 0; list < 2; ++list) {
        check_format(list, &c, 0, NULL); /* empty */
        CHECK_OK(clast_field_set(&fields[list], &c, "2", false));
        CHECK_OK(clast_field_set(&fields[list], &c, "3", true));
        check_format(list, &c, 1, "3");
        check_format(list, &c, 2, NULL);
        check_format(list, &c, -1, NULL);
        check_format(list, &c, INT32_MAX, NULL);
    }
    check_format(2, &c, 0, "this");
    c.choice = -1;
    check_format(2, &c, 0, NULL);
    c.choice = 2;
    check_format(2, &c, 0, NULL);
    check_format(3, &c, 0, "w");
    clast_fields_free(fields, &c); /* the word is NULL now */
    check_format(3, &c, 0, NULL);
}

/* As field.h says: what stands before a fault is set. */
static void keys_before_a_fault_are_set(void **state)
{
    (void)state;
    configuration c;
    CHECK_OK(clast_fields_default(fields, &c));
    CHECK_STATUS(clast_fields_parse("here",
                                    "choice: that\n"
                                    "number: [1, 77]\n"
                                    "word: other\n",
                                    fields, &c),
                 CLAST_E_CONFIG);
    assert_int_equal(c.choice, 1);
    assert_string_equal(c.word, "w");
    clast_fields_free(fields, &c);
}

/* 010 was 8 and 1e6 refused where 64 bits are kept; 0x10 was refused where 32 are. */
static void whole_numbers_are_read_alike(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int value;
    } row[] = {{"010", 10}, {"0x10", 16}, {"0X1f", 31}, {"1e1", 10}, {"0", 0}, {"+7", 7}};
    configuration c;
    CHECK_OK(clast_fields_default(fields, &c));
    for (size_t k = 0; k < sizeof row / sizeof *row; ++k) {
        CHECK_OK(clast_field_set(&fields[4], &c, row[k].text, false));
        CHECK_OK(clast_field_set(&fields[5], &c, row[k].text, false));
        assert_int_equal(c.bits, row[k].value);
        assert_int_equal(c.few, row[k].value);
    }
    static const char *const bad[] = {"1.5", "-1", "0x", "few", "", "1e30", "99999999999999999999"};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k) {
        CHECK_STATUS(clast_field_set(&fields[4], &c, bad[k], false), CLAST_E_CONFIG);
        CHECK_STATUS(clast_field_set(&fields[5], &c, bad[k], false), CLAST_E_CONFIG);
    }
    clast_fields_free(fields, &c);
}

/* The range of 64 bits was looked at by nobody. */
static void seeds_have_a_range(void **state)
{
    (void)state;
    configuration c;
    CHECK_OK(clast_fields_default(fields, &c));
    CHECK_OK(clast_field_set(&fields[4], &c, "9007199254740991", false));
    CHECK_OK(clast_fields_check(fields, &c));
    CHECK_STATUS(clast_field_set(&fields[4], &c, "9007199254740992", false), CLAST_E_CONFIG);
    c.bits = UINT64_MAX;
    CHECK_STATUS(clast_fields_check(fields, &c), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "bits"));
    clast_fields_free(fields, &c);
}

/* A number of m^d says by its unit which d it is of. */
static void a_number_keeps_the_dimension_of_its_unit(void **state)
{
    (void)state;
    static const clast_field field[] = {{"rate", 0, CLAST_FIELD_F64, 0.0, 0.0, 1e300, "m^d", "r",
                                         CLAST_KEEPS_DIMENSION, NULL, false},
                                        {0}};
    static const struct {
        const char *text;
        double value;
        int32_t d;
    } given[] = {{"2", 2.0, 0},     {"2 m^d", 2.0, 0},     {"1e3 mm", 1.0, 1},
                 {"4cm2", 4e-4, 2}, {"1e-9 m^3", 1e-9, 3}, {"3", 3.0, 0}};
    struct {
        double value;
        int32_t d, beyond;
    } c = {1.0, 7, 7};
    CHECK_OK(clast_fields_default(field, &c));
    assert_true(c.value == 0.0 && c.d == 0 && c.beyond == 7);
    for (size_t k = 0; k < sizeof given / sizeof given[0]; ++k) {
        CHECK_OK(clast_field_set(field, &c, given[k].text, false));
        CHECK_REL(c.value, given[k].value, 1e-15);
        assert_true(c.d == given[k].d && c.beyond == 7);
    }
    CHECK_STATUS(clast_field_set(field, &c, "1 kg", false), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "known here: m, cm"));
    assert_true(c.value == 3.0 && c.d == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(items_that_there_are_not_have_no_text),
        cmocka_unit_test(keys_before_a_fault_are_set),
        cmocka_unit_test(whole_numbers_are_read_alike),
        cmocka_unit_test(seeds_have_a_range),
        cmocka_unit_test(a_number_keeps_the_dimension_of_its_unit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
