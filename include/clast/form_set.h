#pragma once
#include <clast/form.h>
#include <clast/table.h>

CLAST_BEGIN

// The forms of a set of grains, from a table of flatness and elongation or of L, I and S.

/// Why a row was left out.
typedef enum {
    CLAST_ROW_MISSING,    ///< an empty cell, NA or nan
    CLAST_ROW_NOT_NUMBER, ///< a word where a number belongs
    CLAST_ROW_INFINITE,
    CLAST_ROW_NOT_POSITIVE, ///< zero or negative
    CLAST_ROW_ABOVE_ONE,    ///< a ratio above 1
    CLAST_ROW_NOT_ORDERED,  ///< not L >= I >= S
    CLAST_N_ROW_FAULT
} clast_row_fault;

/// "missing", "not a number", ...
CLAST_API const char *clast_row_fault_text(clast_row_fault fault);

typedef struct clast_left_out {
    int64_t row; ///< of the table, from 0
    clast_row_fault fault;
} clast_left_out;

typedef struct clast_form_set {
    int64_t n;                     ///< grains kept
    int64_t *row;                  ///< [n] their rows in the table, from 0
    double *flatness, *elongation; ///< [n] S/I and I/L in (0, 1]
    double *size;                  ///< [n] in the table's unit, or NULL if the table has no size
    char size_label[64];           ///< "sieve size (mm)", "diameter_m"
    int64_t n_left_out;
    clast_left_out *left_out; ///< [n_left_out] by row
} clast_form_set;

/// Takes the forms out of a table.
///
/// Columns are known by name, whatever their case and unit: flatness or FL with elongation or EL;
/// L, I and S (also long, intermediate, short; major, middle, minor axis length; length, width,
/// thickness); where a table has both, L, I and S count and must agree with the ratios to 0.006. A
/// size column (sieve_size, D, size, diameter, equivalent_diameter) is kept; lengths give the sieve
/// size of eq. 1. Rows with cells that are no numbers, not finite, not positive, ratios above 1 (by
/// more than 1e-9) or lengths out of order are left out and listed.
///
/// @param columns  NULL or "": as above; "a,b": flatness and elongation by name; "a,b,c": L, I, S
/// @return CLAST_E_FORMAT if columns are missing or disagree, or no row is left
CLAST_API clast_status clast_form_set_of(const clast_table *table, const char *columns,
                                         clast_form_set *set);
CLAST_API void clast_form_set_free(clast_form_set *set);

/// One line about the rows left out, "3 rows left out: 2 missing, 1 above 1 (first: row 7)"; empty
/// if none was. Rows count from 1 after the header.
CLAST_API void clast_form_set_complaint(const clast_form_set *set, char *text, size_t size);

/// The 13 form factors of every grain, in Table 1's order, and its size if known: what
/// clast_statistics_of takes.
CLAST_API clast_status clast_form_set_factors(const clast_form_set *set, clast_table *table);

/// Rows left out, as columns row (from 1) and reason.
CLAST_API clast_status clast_form_set_left_out(const clast_form_set *set, clast_table *table);

CLAST_END
