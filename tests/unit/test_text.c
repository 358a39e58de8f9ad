/* Unit: texts from outside as a terminal may show them. */
#include "support.h"

#include <clast/status.h>
#include <string.h>

static void what_is_no_text_is_shown_by_its_bytes(void **state)
{
    static const char *const pair[][2] = {
        {"plain", "plain"},
        {"\xc2\xb5m, \xe2\x82\xac, \xf0\x9f\x8c\x8b", "\xc2\xb5m, \xe2\x82\xac, \xf0\x9f\x8c\x8b"},
        {"\x1b[31m", "\\x1b[31m"},
        {"a\nb\tc\rd\x7f", "a\\x0ab\\x09c\\x0dd\\x7f"},
        {"\xff\xfe", "\\xff\\xfe"},
        {"\xc2", "\\xc2"},
        {"\xc2\x9b", "\\xc2\\x9b"},                  /* a control of eight bits */
        {"\xc0\xaf", "\\xc0\\xaf"},                  /* longer than need be */
        {"\xed\xa0\x80", "\\xed\\xa0\\x80"},         /* a surrogate */
        {"\xf4\x90\x80\x80", "\\xf4\\x90\\x80\\x80"} /* beyond the last character */
    };
    char shown[64];
    (void)state;
    for (size_t k = 0; k < sizeof pair / sizeof *pair; ++k) {
        assert_string_equal(clast_text_printable(pair[k][0], sizeof shown, shown), pair[k][1]);
    }
}

static void a_cut_never_splits_a_character(void **state)
{
    char shown[8];
    (void)state;
    assert_string_equal(clast_text_printable("abcdefghij", sizeof shown, shown), "abcdefg");
    assert_string_equal(clast_text_printable("abcdef\xc2\xb5", sizeof shown, shown), "abcdef");
    assert_string_equal(clast_text_printable("abcde\xff", sizeof shown, shown), "abcde");
    shown[0] = 'x';
    (void)clast_text_printable("abc", 0, shown);
    assert_int_equal(shown[0], 'x');
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_no_text_is_shown_by_its_bytes),
        cmocka_unit_test(a_cut_never_splits_a_character),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
