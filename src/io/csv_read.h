#pragma once
// Delimited text in parts, row by row, and as lists of sizes have it.
#include "base/status.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct clast_csv_options clast_csv_options;
typedef struct clast_csv_report clast_csv_report;
typedef struct clast_table clast_table;

/// Part of a file of delimited text, whose first line has this number.
clast_status clx_csv_parse_part(const char *name, const void *bytes, size_t n,
                                const clast_csv_options *options, int64_t first_line,
                                clast_table *table);

/// A row of delimited text, which is a line; {0} stands before the first.
typedef struct clx_csv_row {
    int64_t begin, next;  ///< its first byte, and the first one behind its line end
    int64_t line, n_line; ///< lines before `begin` and before `next`
} clx_csv_row;

/// Goes to the next row that clast_table_parse_csv finds in bytes without quotes; false at the end.
bool clx_csv_next_row(const char *bytes, int64_t n, char separator, clx_csv_row *row);

/// Whether a line surely begins at byte `at` of n: behind LF, or behind CR that no LF follows, as
/// of the last byte is not known.
bool clx_csv_begins_line(const char *bytes, int64_t at, int64_t n);

/// Line ends (LF, CR LF or CR) of some bytes; `before`: the byte that stands before them, 0: none.
int64_t clx_csv_count_lines(const char *bytes, int64_t n, char before);

/// clast_table_read_csv, and the same rows with the cells of all columns as they are written.
CLX_SHARED clast_status clx_csv_read_texts(const char *path, clast_table *table,
                                           clast_table *texts);

/// clast_table_parse_csv of a list of sizes, made by hand as a rule: a comment may stand behind the
/// cells of a row, too, and a separator behind the last of them.
clast_status clx_csv_parse_list(const char *name, const char *bytes, int64_t n, clast_table *table,
                                clast_csv_report *report);

/// A cell as it is written in the file, for messages. Whoever has it frees the text.
typedef struct clx_csv_cell {
    int64_t line; ///< on which its row begins, from 1
    char *text;
} clx_csv_cell;

/// Finds a cell of a list that clx_csv_parse_list has read.
///
/// @param row  from 0, the header's where there is one
clast_status clx_csv_list_cell(const char *bytes, int64_t n, const clast_csv_report *report,
                               int64_t row, int32_t column, clx_csv_cell *found);
