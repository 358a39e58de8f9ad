#pragma once
// Decimal texts to doubles and back, correctly rounded, whatever the locale of the host program: no
// other file of the library calls strtod, or prints a double by the C library.
#include "base/status.h"
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

/// Reads [sign] digits [. digits] [e [sign] digits] from [text, end), rounded to nearest even.
///
/// Returns the place after the number, or NULL when there is none. A value beyond double's range
/// gives an infinity; words such as nan and inf are no numbers here.
const char *clx_number_parse(const char *text, const char *end, double *value);

/// strtod in its place: blanks, then a number as above; *end (may be NULL) is after it, or the text
/// itself, with 0, where there is none.
CLX_SHARED double clx_number_read(const char *text, char **end);

/// Whether the text is a number but for a decimal comma: "1,5" or "-1,5e-3".
bool clx_number_has_comma(const char *text);

enum { CLX_NUMBER_POWER = 27 }; // 5^27 < 2^63

/// word * 10^exponent rounded to nearest even; word > 0, |exponent| <= CLX_NUMBER_POWER.
double clx_number_scaled(uint64_t word, int exponent);

enum { CLX_NUMBER_SIZE = 32 };

/// Shortest of 15, 16 or 17 digits that reads back as the same double; returns its length.
CLX_SHARED int clx_number_format(double value, char text[CLX_NUMBER_SIZE]);

/// snprintf with a decimal point, whatever the host's locale; of this thread alone, and only
/// within.
CLX_SHARED int clx_number_print(char *text, size_t size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
int clx_number_print_list(char *text, size_t size, const char *format, va_list args)
    __attribute__((format(printf, 3, 0)));
