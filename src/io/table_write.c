// Tables to delimited text (RFC 4180) and JSON.
#include <clast/table.h>

#include "base/file.h"
#include "base/number.h"
#include "base/status.h"
#include "io/json.h"
#include <inttypes.h>
#include <math.h>
#include <string.h>

/// Control characters, but for the ends of lines and tabs that quotes keep, and bytes that are not
/// UTF-8 are written as \xNN: a table is looked at in terminals.
static void write_byte(clx_file *file, const char **c)
{
    char shown[8];
    char one[5] = "";
    const size_t most = strnlen(*c, 4);
    memcpy(one, *c, most);
    for (size_t n = 1; n <= most; ++n) { // the shortest piece that is a character
        const char after = one[n];
        one[n] = '\0';
        (void)clast_text_printable(one, sizeof shown, shown);
        one[n] = after;
        if (shown[0] != '\\' || one[0] == '\\') {
            (void)clx_file_write(file, *c, n);
            *c += n;
            return;
        }
    }
    one[1] = '\0';
    (void)clast_text_printable(one, sizeof shown, shown);
    const bool is_kept = strchr("\r\n\t", one[0]) != NULL;
    (void)clx_file_write(file, is_kept ? one : shown, is_kept ? 1 : strlen(shown));
    ++*c;
}

static void write_cell(clx_file *file, const char *text)
{
    const size_t n = strlen(text);
    const bool quote = n == 0 || text[0] == '#' || text[0] == ' ' || text[n - 1] == ' ' ||
                       text[0] == '\t' || text[n - 1] == '\t' || strpbrk(text, ",\"\r\n") != NULL;
    (void)clx_file_write(file, "\"", quote ? 1 : 0);
    for (const char *c = text; *c != '\0';) {
        (void)clx_file_write(file, "\"", *c == '"' ? 1 : 0); // a quote is doubled
        write_byte(file, &c);
    }
    (void)clx_file_write(file, "\"", quote ? 1 : 0);
}

/// A number; what does not exist (NaN) is an empty cell, quoted where it is the whole line, which
/// would be no row else.
static void write_number(clx_file *file, double value, bool is_alone)
{
    char text[CLX_NUMBER_SIZE];
    if (!isnan(value)) {
        const int n = clx_number_format(value, text);
        (void)clx_file_write(file, text, (size_t)n);
    } else if (is_alone) {
        write_cell(file, "");
    }
}

static void write_separator(clx_file *file, int32_t k)
{
    if (k > 0) {
        (void)clx_file_write(file, ",", 1);
    }
}

static void write_note(clx_file *file, const char *note)
{
    (void)clx_file_write(file, "# ", 2);
    for (const char *c = note; *c != '\0';) {
        if (*c == '\n' || *c == '\r') {
            (void)clx_file_write(file, " ", 1);
            ++c;
        } else {
            write_byte(file, &c);
        }
    }
    (void)clx_file_write(file, "\n", 1);
}

clast_status clast_table_write_csv(const clast_table *table, const char *path)
{
    return clast_table_write_csv_note(table, NULL, path);
}

clast_status clast_table_write_csv_note(const clast_table *table, const char *note,
                                        const char *path)
{
    CLX_ARGUMENTS(table, path);
    CLX_WHOLE(table, table);
    clast_status status = CLAST_OK;
    clx_file file = {0};
    CLX_TRY(clx_file_begin(path, &file));
    if (note != NULL) {
        write_note(&file, note);
    }
    for (int32_t k = 0; k < table->n_column; ++k) {
        write_separator(&file, k);
        write_cell(&file, table->column[k].name);
    }
    (void)clx_file_write(&file, "\n", 1);
    for (int64_t row = 0; row < table->n_row; ++row) {
        for (int32_t k = 0; k < table->n_column; ++k) {
            const clast_column *column = &table->column[k];
            write_separator(&file, k);
            if (column->number != NULL) {
                write_number(&file, column->number[row], table->n_column == 1);
            } else {
                write_cell(&file, column->text[row]);
            }
        }
        CLX_TRY(clx_file_write(&file, "\n", 1));
    }
    CLX_TRY(clx_file_commit(&file));
done:
    clx_file_abandon(&file);
    return status;
}

static void write_values(clx_file *file, const clast_table *table, const clast_column *column)
{
    for (int64_t row = 0; row < table->n_row; ++row) {
        if (row > 0) {
            (void)clx_file_write(file, ",", 1);
        }
        if (column->number == NULL) {
            clx_json_text(file, column->text[row]);
        } else {
            clx_json_number(file, column->number[row]);
        }
    }
}

clast_status clast_table_write_json(const clast_table *table, const char *path)
{
    CLX_ARGUMENTS(table, path);
    CLX_WHOLE(table, table);
    clast_status status = CLAST_OK;
    clx_file file = {0};
    CLX_TRY(clx_file_begin(path, &file));
    (void)clx_file_print(&file, "{\"name\":");
    clx_json_text(&file, table->name);
    (void)clx_file_print(&file, ",\"n_row\":%" PRId64 ",\"columns\":[", table->n_row);
    for (int32_t k = 0; k < table->n_column; ++k) {
        (void)clx_file_print(&file, "%s\n{\"name\":", k > 0 ? "," : "");
        clx_json_text(&file, table->column[k].name);
        (void)clx_file_print(&file, ",\"unit\":");
        clx_json_text(&file, table->column[k].unit);
        (void)clx_file_print(&file, ",\"values\":[");
        write_values(&file, table, &table->column[k]);
        (void)clx_file_print(&file, "]}");
    }
    (void)clx_file_print(&file, "\n]}\n");
    CLX_TRY(clx_file_commit(&file));
done:
    clx_file_abandon(&file);
    return status;
}
