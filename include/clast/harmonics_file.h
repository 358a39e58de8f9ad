#pragma once
#include <clast/harmonics.h>

CLAST_BEGIN

/// Reads a coefficient file: rows `n m Re(a) Im(a)` of a series sum a_nm Y_nm over -n <= m <= n, in
/// any order; text after '#' is skipped.
///
/// Rows of m < 0 may be missing altogether (the surface is real); where they are given, the real
/// part of the sum is the surface.                              [Garboczi2002 eqs 1-3]
///
/// @param series  must be empty; written only on success
/// @return CLAST_E_FORMAT with file and line for missing, repeated and malformed rows;
///         CLAST_E_LIMIT beyond degree 256; CLAST_E_IO; CLAST_E_MEMORY
CLAST_API clast_status clast_harmonics_read(const char *path, clast_harmonics *series);

/// The same from memory: a pure function of the bytes.
CLAST_API clast_status clast_harmonics_parse(const void *bytes, size_t n, clast_harmonics *series);

CLAST_END
