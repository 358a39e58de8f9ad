#pragma once
#include <clast/sizes.h>

CLAST_BEGIN

/// Sizes, sizes with counts, or bins with counts, from delimited text (comma, semicolon, tab or
/// blanks; '#' starts a comment; a first line that is no number names the columns).
///
/// A column `count`, `n`, `number`, `weight` or `mass` counts the row's particles; columns that
/// begin with `low` and `high` are the ends of a bin; `density` (kg/m3 unless its name ends in
/// another unit, density_g/cm3) is that of the row's particles. In phi units a size is 2^-phi mm.
///
/// @param column  name of the size column; "": the first
/// @param unit    um, mm, m, phi, ...; "": what the column's name ends in (d_eq_um)
/// @return CLAST_E_FORMAT with the line for sizes that are not numbers, not finite or not above 0;
///         CLAST_E_CONFIG when the unit is not known
CLAST_API clast_status clast_sizes_read(const char *path, const char *column, const char *unit,
                                        clast_sizes *sizes);

/// The same from memory; `name` stands for the path in messages.
CLAST_API clast_status clast_sizes_parse(const char *name, const char *text, const char *column,
                                         const char *unit, clast_sizes *sizes);

CLAST_END
