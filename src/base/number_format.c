// Doubles to the shortest of 15, 16 and 17 digits that reads back the same.
//
// printf is exact but slow, and a number needs it up to three times. Between 1e-11 and 1e15 the
// digits are the rounded quotient of two integers below 2^128, and whether they read back is one
// more division; the text is printf's %g to the byte. Elsewhere, and where the compiler has no
// integers of 128 bits, printf does it.
#include "base/number.h"

#include "base/status.h"

#include <locale.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>

enum {
    LEAST_DIGITS = 15,
    MOST_DIGITS = 17,
    LEAST_PLACE = MOST_DIGITS - 1 - CLX_NUMBER_POWER, // of the first digit
    MOST_PLACE = LEAST_DIGITS - 1
};

int clx_number_print_list(char *text, size_t size, const char *format, va_list args)
{
    const locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0); // takes no memory for "C"
    if (plain == (locale_t)0) {
        return -1;
    }
    const locale_t host = uselocale(plain);
    const int n = vsnprintf(text, size, format, args);
    (void)uselocale(host);
    freelocale(plain);
    return n;
}

int clx_number_print(char *text, size_t size, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    const int n = clx_number_print_list(text, size, format, args);
    va_end(args);
    return n;
}

static int format_any(double value, char text[CLX_NUMBER_SIZE])
{
    int n = 0;
    for (int digits = LEAST_DIGITS; digits <= MOST_DIGITS; ++digits) {
        n = clx_number_print(text, CLX_NUMBER_SIZE, "%.*g", digits, value);
        double back = 0.0;
        if (clx_number_parse(text, text + n, &back) != NULL && back == value) {
            break;
        }
    }
    return n;
}

#ifdef __SIZEOF_INT128__
__extension__ typedef unsigned __int128 u128;

/// mantissa * 2^exponent * 10^power below 10^17: its whole part, and whether to round up from there
/// to the nearest whole number, ties to even.
static uint64_t whole_part(uint64_t mantissa, int exponent, int power, bool *up)
{
    CLAST_ASSERT(power >= 0 && power <= CLX_NUMBER_POWER);
    u128 product = mantissa;
    for (int i = 0; i < power; ++i) {
        product *= 5;
    }
    const int shift = -(exponent + power);
    *up = false;
    if (shift <= 0) {
        return (uint64_t)(product << -shift);
    }
    const u128 whole = product >> shift;
    const u128 rest = product - (whole << shift);
    const u128 half = (u128)1 << (shift - 1);
    *up = rest > half || (rest == half && ((uint64_t)whole & 1) != 0);
    return (uint64_t)whole;
}

static uint64_t power_of_ten(int power)
{
    CLAST_ASSERT(power >= 0 && power <= 19);
    uint64_t ten = 1;
    for (int i = 0; i < power; ++i) {
        ten *= 10;
    }
    return ten;
}

/// Place of the first digit of a value: 0 for 1 to 9.99.
static int place_of(uint64_t mantissa, int exponent)
{
    bool up = false;
    const int place = (int)floor(0.30102999566398120 * (exponent + 52)); // log10(2): low by 0 or 1
    const int power = MOST_DIGITS - 2 - place; // with one place more the value is 10^16 or above
    return place < LEAST_PLACE || place > MOST_PLACE ||
                   whole_part(mantissa, exponent, power, &up) < power_of_ten(MOST_DIGITS - 1)
               ? place
               : place + 1;
}

/// Digits as printf's %g writes them: plain from 1e-4 up to the precision, no zeros at the end.
static int write_digits(uint64_t word, int n_digit, int place, char *text)
{
    CLAST_ASSERT(n_digit >= LEAST_DIGITS && n_digit <= MOST_DIGITS && word < power_of_ten(n_digit));
    char digit[MOST_DIGITS] = {0};
    const int precision = n_digit;
    int n = 0;
    for (int i = n_digit - 1; i >= 0; --i, word /= 10) {
        digit[i] = (char)('0' + word % 10);
    }
    while (n_digit > 1 && digit[n_digit - 1] == '0') {
        --n_digit;
    }
    if (place < -4 || place >= precision) {
        text[n++] = digit[0];
        for (int i = 1; i < n_digit; ++i) {
            n += i == 1 ? (text[n] = '.', 1) : 0;
            text[n++] = digit[i];
        }
        const int size = place < 0 ? -place : place;
        text[n++] = 'e';
        text[n++] = place < 0 ? '-' : '+';
        text[n++] = (char)('0' + size / 10);
        text[n++] = (char)('0' + size % 10);
        return n;
    }
    for (int at = place < 0 ? place : 0; at < n_digit || at <= place; ++at) {
        if (at == place + 1) {
            text[n++] = '.';
        }
        text[n++] = at >= 0 && at < n_digit ? digit[at] : '0';
    }
    return n;
}

int clx_number_format(double value, char text[CLX_NUMBER_SIZE])
{
    int exponent = 0;
    int n = 0;
    const double size = fabs(value);
    if (!(size >= 1e-11 && size < 1e15)) {
        return format_any(value, text);
    }
    const uint64_t mantissa = (uint64_t)ldexp(frexp(size, &exponent), 53);
    exponent -= 53;
    const int first = place_of(mantissa, exponent);
    if (first < LEAST_PLACE || first > MOST_PLACE) {
        return format_any(value, text);
    }
    if (value < 0.0) {
        text[n++] = '-';
    }
    for (int n_digit = LEAST_DIGITS; n_digit <= MOST_DIGITS; ++n_digit) {
        int place = first;
        bool up = false;
        uint64_t word = whole_part(mantissa, exponent, n_digit - 1 - place, &up);
        word += up;
        if (n_digit < MOST_DIGITS && clx_number_scaled(word, place + 1 - n_digit) != size) {
            continue;
        }
        if (word == power_of_ten(n_digit)) { // 9.99 rounded up
            word /= 10;
            ++place;
        }
        n += write_digits(word, n_digit, place, text + n);
        break;
    }
    text[n] = '\0';
    return n;
}
#else
int clx_number_format(double value, char text[CLX_NUMBER_SIZE])
{
    return format_any(value, text);
}
#endif
