#pragma once
#include <clast/grading.h>

CLAST_BEGIN

/// Sieve curve from delimited text with a header, one row a sieve in any order. The size column is
/// called sieve, size, diameter, opening, d or phi and carries its unit (sieve_mm, "size (um)",
/// phi). A second column holds either
///
/// - retained, mass, weight or fraction: what stays on this sieve and passes the next larger one,
///   in any unit; 0 on the largest sieve; or
/// - passing, finer or undersize: what passes this sieve, in %, as a share of 1 or (unit g, kg) as
///   a mass; 0 at the smallest sieve, all at the largest.
///
/// A pan may be a row of size 0 if nothing is in it.
///
/// @return CLAST_E_FORMAT with the row and what to do: no such columns, cells that are not finite,
///         sieves that repeat, negative masses, passing that falls as sieves grow, mass that is
///         finer or coarser than all sieves
CLAST_API clast_status clast_curve_read(const char *path, clast_curve *curve);

/// The same from memory; `name` stands for the path in messages.
CLAST_API clast_status clast_curve_parse(const char *name, const void *bytes, size_t n,
                                         clast_curve *curve);

/// Sizes by one text, as in the option `curve`: a published case (U1 ... B70), "uniform:LOW,HIGH",
/// "lognormal:MEAN,DEVIATION" or "lognormal:MEAN,DEVIATION,LOW,HIGH", one size ("11 mm"),
/// "list:FILE" or "masses:FILE" (clast_sizes_read; its counts are numbers or masses), or the file
/// of a sieve curve. Each size has its unit: a bare one is refused.
///
/// @param curve    {0}; stays empty unless the text names a curve
/// @param grading  made in any case
CLAST_API clast_status clast_grading_load(const char *text, clast_grading_spread spread,
                                          clast_grading_count count, clast_curve *curve,
                                          clast_grading **grading);

CLAST_END
