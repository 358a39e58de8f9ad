#pragma once
#include <clast/status.h>

CLAST_BEGIN

/// A column: numbers or texts, with a unit ("m", "-", "kg/m^3").
typedef struct clast_column {
    char *name; ///< unique in its table; ends in the unit where it has one (diameter_m)
    char *unit;
    double *number; ///< [n_row], or NULL for a text column
    char **text;    ///< [n_row] owned, or NULL for a number column
} clast_column;

/// Named columns of one length: what every analysis returns, and what io, plot and fit take.
struct clast_table {
    char *name;
    int32_t n_column;
    int64_t n_row;
    clast_column *column; ///< [n_column]
};

/// Empty table of n_row rows with a name. `table` must be {0} or freed. CLAST_E_ARGUMENT for n_row
/// below 0.
CLAST_API clast_status clast_table_init(clast_table *table, const char *name, int64_t n_row);
CLAST_API void clast_table_free(clast_table *table);

/// Adds a column of zeros; *number points into the table until the next add.
CLAST_API clast_status clast_table_add_number(clast_table *table, const char *name,
                                              const char *unit, double **number);

/// Adds a column of empty texts; fill it with clast_table_set_text.
CLAST_API clast_status clast_table_add_text(clast_table *table, const char *name);
CLAST_API clast_status clast_table_set_text(clast_table *table, int32_t column, int64_t row,
                                            const char *text);

/// Makes the table n_row long: new rows are zeros and empty texts. CLAST_E_ARGUMENT for n_row below
/// 0; the table is then as it was.
CLAST_API clast_status clast_table_resize(clast_table *table, int64_t n_row);

/// Index of the named column, or -1.
CLAST_API int32_t clast_table_find(const clast_table *table, const char *name);

/// Numbers of the named column, or NULL.
CLAST_API double *clast_table_numbers(const clast_table *table, const char *name);

// Tables from files and to files: delimited text (RFC 4180 and its common dialects) and JSON.

/// How to read delimited text; {0} guesses everything.
typedef struct clast_csv_options {
    char
        separator; ///< ',', ';', tab, or ' ' for runs of blanks; 0: guessed from the first two rows
    char comment;  ///< lines that begin with it are left out; 0: '#'
    bool no_comment; ///< no line is a comment
    int header; ///< 1: the first row names the columns; -1: it does not; 0: it does if a cell of
                ///< it is no number
} clast_csv_options;

/// What the reader found. Plain numbers: nothing to free.
typedef struct clast_csv_report {
    char separator;
    bool has_header;
    int64_t n_line;    ///< lines of the file
    int64_t n_comment; ///< lines left out as comments
    int64_t n_blank;   ///< lines left out as blank
    int64_t n_missing; ///< empty cells and NA of number columns, which read as NaN
    int32_t n_renamed; ///< columns without a name of their own: empty or repeated ones
} clast_csv_report;

/// Reads delimited text into an empty table named after the file.
///
/// A column whose cells are all numbers, empty, NA, nan or inf holds numbers, also if they are
/// quoted; every other holds texts. Numbers have '.' whatever the locale. Quoted cells may hold
/// separators, quotes ("") and line ends; blanks around unquoted cells are dropped; of a header in
/// blanks those before and in the brackets of a unit, "x (mm)", separate nothing. Lines end in LF,
/// CR LF or CR; a UTF-8 byte-order mark is skipped. A header's unit, as in diameter_m, "diameter
/// (um)" or "rho [kg/m^3]", becomes the column's unit; numbers stay as they are.
///
/// @param options  NULL: guess
/// @param table    must be empty; written only on success
/// @param report   may be NULL
/// @return CLAST_E_FORMAT for a file without rows, and with file and line for ragged rows, stray
/// quotes, binary bytes and UTF-16;
///         CLAST_E_IO; CLAST_E_LIMIT beyond 16 GiB or 65,536 columns; CLAST_E_MEMORY
CLAST_API clast_status clast_table_read_csv(const char *path, const clast_csv_options *options,
                                            clast_table *table, clast_csv_report *report);

/// The same from memory; `name` stands for the path in messages and names the table.
CLAST_API clast_status clast_table_parse_csv(const char *name, const void *bytes, size_t n,
                                             const clast_csv_options *options, clast_table *table,
                                             clast_csv_report *report);

/// Writes RFC 4180 text: a header of the columns' names (which end in their units), ',', lines that
/// end in LF, numbers in the fewest digits that read back as the same double, NaN (what does not
/// exist) as empty cells, infinities as inf.
/// The file appears whole or not at all.
///
/// @return CLAST_E_DISK
CLAST_API clast_status clast_table_write_csv(const clast_table *table, const char *path);

/// The same below a line "# NOTE", which clast_table_read_csv passes over; the note is one line.
CLAST_API clast_status clast_table_write_csv_note(const clast_table *table, const char *note,
                                                  const char *path);

/// Writes {"name", "n_row", "columns": [{"name", "unit", "values": []}]}; nan and inf, which JSON
/// does not have, become null. The file appears whole or not at all.
CLAST_API clast_status clast_table_write_json(const clast_table *table, const char *path);

/// Writes rows that are cells of a uniform grid, x fastest, as a VTK image (.vti) for ParaView:
/// columns x, y, z (middles) and dx, dy, dz (sides), each perhaps with a unit behind it (x_m); the
/// other columns of numbers are its cell data, by their names.
///
/// @return CLAST_E_USAGE for a table that is no such grid; CLAST_E_DISK
CLAST_API clast_status clast_table_write_vti(const clast_table *table, const char *path);

/// Writes rows that are lines as VTK polydata (.vtp): columns x0, y0, z0, x1, y1, z1, as above.
CLAST_API clast_status clast_table_write_vtp(const clast_table *table, const char *path);

CLAST_END
