// What to say where a table has no such column of numbers.
#include "cloud/columns.h"

#include "base/number.h"
#include "base/status.h"
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LIST_SIZE = 200, MOST_NAMES = 12 };

/// "1,5" or "-1,5e-3".
static bool has_decimal_comma(const char *text)
{
    char point[64];
    double value = 0.0;
    char *const comma = strchr(strncpy(point, text, sizeof point - 1), ',');
    point[sizeof point - 1] = '\0';
    if (comma == NULL || strlen(text) >= sizeof point || !isdigit((unsigned char)comma[1])) {
        return false;
    }
    *comma = '.';
    return clx_number_parse(point, point + strlen(point), &value) == point + strlen(point);
}

static bool is_number(const char *text)
{
    double value = 0.0;
    return text[0] == '\0' ||
           clx_number_parse(text, text + strlen(text), &value) == text + strlen(text);
}

/// A column of texts: the first row that made it one.
static clast_status text_column(const clast_table *table, const clast_column *column)
{
    int64_t row = 0;
    while (row + 1 < table->n_row && is_number(column->text[row])) {
        ++row;
    }
    const char *text = table->n_row > 0 ? column->text[row] : "";
    return clx_fail(CLAST_E_FORMAT,
                    "%s: column '%s' is no column of numbers: row %lld holds '%.40s'%s",
                    table->name, column->name, (long long)row + 1, text,
                    has_decimal_comma(text) ? "; a decimal comma? write 0.5, not 0,5" : "");
}

static bool is_equal_but_for_case(const char *a, const char *b)
{
    while (*a != '\0' && tolower((unsigned char)*a) == tolower((unsigned char)*b)) {
        ++a;
        ++b;
    }
    return *a == *b;
}

static void list_columns(const clast_table *table, char list[LIST_SIZE])
{
    list[0] = '\0';
    for (int32_t k = 0; k < table->n_column && k < MOST_NAMES; ++k) {
        const size_t used = strlen(list);
        (void)snprintf(list + used, LIST_SIZE - used, "%s%.40s%s", k > 0 ? ", " : "",
                       table->column[k].name, table->column[k].number == NULL ? " (texts)" : "");
    }
    if (table->n_column > MOST_NAMES) {
        const size_t used = strlen(list);
        (void)snprintf(list + used, LIST_SIZE - used, ", ...");
    }
}

/// "0,1 0,2 0,3" read with commas between columns: names as "1 0" of digits and a blank.
static bool is_cut_at_commas(const clast_table *table)
{
    bool is_cut = false;
    for (int32_t c = 0; c < table->n_column; ++c) {
        const char *name = table->column[c].name;
        is_cut = is_cut || (strchr(name, ' ') != NULL && name[strspn(name, "0123456789 +-")] == 0);
    }
    return is_cut;
}

/// "0,1,0,2,0,3": without a header, twice as many columns of whole numbers as dimensions.
static bool is_whole_pairs(const clast_table *table)
{
    bool is_whole = table->n_column == 4 || table->n_column == 6;
    for (int32_t c = 0; c < table->n_column && is_whole; ++c) {
        const double *number = table->column[c].number;
        for (int64_t i = 0; number != NULL && i < table->n_row && is_whole; ++i) {
            is_whole = number[i] == floor(number[i]);
        }
        is_whole = is_whole && number != NULL;
    }
    return is_whole;
}

clast_status clx_cloud_no_column(const clast_table *table, const char *name)
{
    char list[LIST_SIZE];
    char guess[LIST_SIZE] = "";
    const int32_t k = clast_table_find(table, name);
    if (k >= 0) {
        return text_column(table, &table->column[k]);
    }
    list_columns(table, list);
    for (int32_t c = 0; c < table->n_column && guess[0] == '\0'; ++c) {
        const char *known = table->column[c].name;
        if (is_equal_but_for_case(known, name)) {
            (void)snprintf(guess, sizeof guess, "; did you mean '%.40s'?", known);
        }
    }
    const bool is_bare = table->n_column > 0 && strcmp(table->column[0].name, "column_1") == 0;
    if (guess[0] == '\0' && (is_cut_at_commas(table) || (is_bare && is_whole_pairs(table)))) {
        (void)snprintf(guess, sizeof guess, "; decimal commas? write 0.5, not 0,5");
    } else if (is_bare && guess[0] == '\0') {
        (void)snprintf(guess, sizeof guess, "; the file has no header: --columns %s",
                       table->n_column > 2    ? "column_1,column_2,column_3"
                       : table->n_column == 2 ? "column_1,column_2"
                                              : "column_1");
    } else if (guess[0] == '\0' && table->n_column == 1 &&
               strpbrk(table->column[0].name, ";|:/") != NULL) {
        (void)snprintf(guess, sizeof guess,
                       "; another delimiter? columns are parted by tabs, ';', ',' or blanks");
    }
    return clx_fail(CLAST_E_FORMAT, "%s has no column of numbers named '%s'; it has %s%s",
                    table->name, name, list, guess);
}
