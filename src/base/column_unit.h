#pragma once
// What the name of a column says of its unit, for every reader of tables and whoever uses them.
#include "base/status.h"
#include <clast/table.h>
#include <stdbool.h>

typedef enum {
    CLX_UNIT_NONE, ///< "x", "u (mean)", "Points:0", "flow_in"
    CLX_UNIT_WORD, ///< a unit that may be a word or an index too: "d_mm", "x_t", "d (min)"
    CLX_UNIT_TOLD, ///< "u_cm/s", "G (1/min) mean", "Velocity [ cm s^-1 ]"; "u_ft/s", "x (ft)"
} clx_unit_said;

enum { CLX_COLUMN_UNIT = 32 };

/// The unit in a name: in brackets anywhere, else behind "_", a component's name or number
/// after it or not ("U_cm/s_x", "U_cm/s:0"), else a last word that is told ("density g/cm3"). One
/// that is TOLD may be none that clast knows.
clx_unit_said clx_column_unit(const char *name, char unit[CLX_COLUMN_UNIT]);

/// True where a name says a unit of length, phi, or one that may be of length and is not read here:
/// "d_mm", "x (ft)", "d_ft", "L_in"; false of "r_g" and "x_m/s".
bool clx_column_says_length(const char *name, char unit[CLX_COLUMN_UNIT]);

/// What takes a column of this dimension to SI by the unit that it, or else its name, says; 0 where
/// it says none, as "x_t" does of any but times. To Celsius ("T_C") 273.15 is added.
///
/// @param unit  what it says, "-" for none
/// @return CLAST_E_CONFIG, with the column, for one that is told and is none of this dimension
clast_status clx_column_factor(const clast_column *column, const char *si_unit,
                               char unit[CLX_COLUMN_UNIT], double *factor);

bool clx_unit_is_celsius(const char *unit);

/// The unit of a column of lengths. {0} where it says none.
typedef struct {
    char unit[CLX_COLUMN_UNIT]; ///< "" for none; "mm" of phi
    double metre;               ///< in the unit; 0 for none
    bool is_phi;                ///< numbers v stand for 2^-v mm
} clx_length_unit;

/// What a column, or else its name, says of the unit of its lengths.
///
/// @param takes_phi  of sizes: phi is a unit, and a column's name
/// @return CLAST_E_FORMAT for one that is told and is none of length that is read here
clast_status clx_column_length(const clast_column *column, bool takes_phi, clx_length_unit *length);

/// A number of such a column in `unit`.
double clx_length_value(const clx_length_unit *length, double number);

/// Adds n columns of numbers: the name and the unit of each. Pointers to them are asked for after.
CLX_SHARED clast_status clx_table_add_numbers(clast_table *table, size_t n,
                                              const char *const column[][2]);
#define CLX_ADD_COLUMNS(table, column)                                                             \
    clx_table_add_numbers(table, sizeof(column) / sizeof *(column), column)

/// clast_table_add_number with the unit that the text `said` says, "-" where clast knows none.
clast_status clx_table_add_said(clast_table *table, const char *name, const char *said,
                                double **number);
