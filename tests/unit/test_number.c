/* Unit: decimal texts against strtod and against known hard cases. */
#include "support.h"

#include "base/number.h"
#include "math/rng.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static double parse(const char *text)
{
    double v = NAN;
    const char *end = text + strlen(text);
    assert_ptr_equal(clx_number_parse(text, end, &v), end);
    return v;
}

static void same_as_strtod(const char *text)
{
    const double ours = parse(text);
    const double theirs = strtod(text, NULL);
    if (memcmp(&ours, &theirs, sizeof ours) != 0) {
        fail_msg("%s: ours %.17g, strtod %.17g", text, ours, theirs);
    }
}

static void hard_cases_round_as_strtod(void **state)
{
    static const char *const texts[] = {"0",
                                        "-0",
                                        "1",
                                        "-1.5",
                                        ".8e-1",
                                        "-.7e+2",
                                        "5.",
                                        "1e22",
                                        "1e23",
                                        "9007199254740993",
                                        "9007199254740992.5",
                                        "8.5e-1",
                                        "1e-320",
                                        "4.9406564584124654e-324",
                                        "2.4703282292062327e-324",
                                        "2.4703282292062328e-324",
                                        "2.2250738585072011e-308",
                                        "2.2250738585072014e-308",
                                        "1.7976931348623157e308",
                                        "1.7976931348623159e308",
                                        "1e309",
                                        "-1e400",
                                        "1e-400",
                                        "0e999999999999",
                                        "123456789012345678901234567890",
                                        "0.000000000000000000000000000000000000000000000000000001",
                                        "7.2057594037927933e16",
                                        "1.00000000000000011102230246251565404236316680908203125",
                                        "1.00000000000000011102230246251565404236316680908203124",
                                        "1.00000000000000011102230246251565404236316680908203126",
                                        "6.02214076e+023",
                                        "3.14159265358979323846264338327950288e-1",
                                        "1e99999999999999999999",
                                        "18446744073709551615e-27",
                                        "1234567890123456789e27"};
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        same_as_strtod(texts[i]);
    }
}

static void half_way_between_doubles_is_decided_by_the_last_of_many_digits(void **state)
{
    (void)state;
    char text[1200] = "1.00000000000000011102230246251565404236316680908203125";
    const size_t n = strlen(text);
    memset(text + n, '0', 1000);
    text[n + 1000] = '\0';
    assert_true(parse(text) == 1.0);
    text[n + 999] = '1';
    assert_true(parse(text) == nextafter(1.0, 2.0));
}

static void random_numbers_round_as_strtod(void **state)
{
    (void)state;
    clx_rng rng = clx_rng_at(1, CLX_STREAM_TEST, 0);
    for (int i = 0; i < 60000; ++i) {
        char text[64];
        uint64_t bits = (uint64_t)clx_rng_u32(&rng) << 32 | clx_rng_u32(&rng);
        double v = 0.0;
        memcpy(&v, &bits, sizeof v);
        if (i % 2 == 0) {
            v = clx_rng_normal(&rng) * pow(10.0, (double)(i % 40 - 20));
        }
        if (isfinite(v)) {
            (void)snprintf(text, sizeof text, "%.*g", 1 + i % 24, v);
            same_as_strtod(text);
            const int n = clx_number_format(v, text);
            assert_int_equal(n, strlen(text));
            assert_true(parse(text) == v);
        }
    }
}

/* Nineteen digits times a small power of ten: the remainder of the division decides one in 4000. */
static void long_integers_with_exponents_round_as_strtod(void **state)
{
    (void)state;
    clx_rng rng = clx_rng_at(2, CLX_STREAM_TEST, 0);
    for (int i = 0; i < 40000; ++i) {
        char text[64];
        const uint64_t digits =
            1000000000000000000u + (((uint64_t)clx_rng_u32(&rng) << 32 | clx_rng_u32(&rng)) >> 2);
        (void)snprintf(text, sizeof text, "%llue%d", (unsigned long long)digits,
                       i % 2 == 0 ? -27 : i % 57 - 28);
        same_as_strtod(text);
    }
}

/* What clx_number_format is, said with printf. */
static void plain_format(double value, char text[CLX_NUMBER_SIZE])
{
    for (int digits = 15; digits <= 17; ++digits) {
        (void)snprintf(text, CLX_NUMBER_SIZE, "%.*g", digits, value);
        if (strtod(text, NULL) == value) {
            return;
        }
    }
}

static void same_as_printf(double value)
{
    char text[CLX_NUMBER_SIZE];
    char plain[CLX_NUMBER_SIZE];
    for (int sign = 0; sign < 2; ++sign) {
        const double v = sign == 0 ? value : -value;
        plain_format(v, plain);
        assert_int_equal(clx_number_format(v, text), strlen(plain));
        assert_string_equal(text, plain);
    }
}

/* Powers of ten and their neighbours, where the number of digits changes; ties; all sizes. */
static void numbers_are_written_as_printf_would(void **state)
{
    (void)state;
    static const double hard[] = {0.0,
                                  5e-324,
                                  1.7976931348623157e308,
                                  0x1p53,
                                  0x1p-40,
                                  0.3,
                                  1e-11,
                                  1e15 - 1,
                                  9.9999999999999995e-5,
                                  123456789012345680.0};
    for (size_t i = 0; i < sizeof hard / sizeof hard[0]; ++i) {
        same_as_printf(hard[i]);
    }
    for (int place = -14; place <= 18; ++place) {
        double below = pow(10.0, place);
        double above = below;
        for (int step = 0; step < 200; ++step) {
            same_as_printf(below);
            same_as_printf(above);
            below = nextafter(below, 0.0);
            above = nextafter(above, INFINITY);
        }
    }
    for (int32_t i = 0; i < 40000; ++i) {
        clx_rng rng = clx_rng_at(8, CLX_STREAM_TEST, (uint64_t)i);
        const double u = clx_rng_uniform(&rng);
        const int place = (int)clx_rng_below(&rng, 34) - 16;
        same_as_printf(ldexp(u, place * 3));                         /* full mantissas */
        same_as_printf(floor(1e6 * u) * pow(10.0, place));           /* few digits */
        same_as_printf(floor(ldexp(u, 20)) * ldexp(1.0, place - 8)); /* ties of the last digit */
    }
}

static void words_and_scraps_are_no_numbers(void **state)
{
    static const char *const texts[] = {"", "-", "+", ".", "-.", "e5", "nan", "inf", "x1"};
    (void)state;
    double v = 0.0;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; ++i) {
        assert_null(clx_number_parse(texts[i], texts[i] + strlen(texts[i]), &v));
    }
    const char *tail = "1e+x";
    assert_ptr_equal(clx_number_parse(tail, tail + 4, &v), tail + 1);
    assert_true(isinf(parse("1e999")));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hard_cases_round_as_strtod),
        cmocka_unit_test(half_way_between_doubles_is_decided_by_the_last_of_many_digits),
        cmocka_unit_test(random_numbers_round_as_strtod),
        cmocka_unit_test(long_integers_with_exponents_round_as_strtod),
        cmocka_unit_test(numbers_are_written_as_printf_would),
        cmocka_unit_test(words_and_scraps_are_no_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
