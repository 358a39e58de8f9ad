#pragma once
// Decimal texts to doubles and back, correctly rounded, whatever the locale.
#include <stdint.h>

/// Reads [sign] digits [. digits] [e [sign] digits] from [text, end), rounded to nearest even.
///
/// Returns the place after the number, or NULL when there is none. A value beyond double's range
/// gives an infinity; words such as nan and inf are no numbers here.
const char *clx_number_parse(const char *text, const char *end, double *value);

enum { CLX_NUMBER_POWER = 27 }; // 5^27 < 2^63

/// word * 10^exponent rounded to nearest even; word > 0, |exponent| <= CLX_NUMBER_POWER.
double clx_number_scaled(uint64_t word, int exponent);

enum { CLX_NUMBER_SIZE = 32 };

/// Shortest of 15, 16 or 17 digits that reads back as the same double; returns its length.
int clx_number_format(double value, char text[CLX_NUMBER_SIZE]);
