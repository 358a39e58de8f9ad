#pragma once
// Decimal texts to doubles and back, correctly rounded, whatever the locale.

/// Reads [sign] digits [. digits] [e [sign] digits] from [text, end), rounded to nearest even.
///
/// Returns the place after the number, or NULL when there is none. A value beyond double's range
/// gives an infinity; words such as nan and inf are no numbers here.
const char *clx_number_parse(const char *text, const char *end, double *value);

enum { CLX_NUMBER_SIZE = 32 };

/// Shortest of 15, 16 or 17 digits that reads back as the same double; returns its length.
int clx_number_format(double value, char text[CLX_NUMBER_SIZE]);
