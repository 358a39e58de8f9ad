// What to say of a table's columns: one that is missing, one of times, weights that are not read.
#include "cloud/columns.h"

#include "base/column_unit.h"
#include "base/comm.h"
#include "base/number.h"
#include "base/status.h"
#include <clast/field.h>
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

enum { LIST_SIZE = 200, MOST_NAMES = 12 };

/// "1,5" or "-1,5e-3".
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
                    clx_number_has_comma(text) ? "; a decimal comma? write 0.5, not 0,5" : "");
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

static bool is_one_of(const char *word, const char *const list[])
{
    for (; *list != NULL && strcasecmp(word, *list) != 0; ++list) {
    }
    return *list != NULL;
}

/// Whether the list, whose items may be lists themselves, has this name.
static bool has_name(const clast_text_list *list, const char *name)
{
    const size_t n = strlen(name);
    for (int32_t k = 0; k < list->n; ++k) {
        const char *at = list->item[k];
        while (at != NULL && !(strncmp(at, name, n) == 0 && (at[n] == '\0' || at[n] == ','))) {
            at = strchr(at, ',');
            at = at != NULL ? at + 1 : NULL;
        }
        if (at != NULL) {
            return true;
        }
    }
    return false;
}

/// Whether an option names the column, and so says what it is.
static bool is_named(const clast_cloud_columns *columns, const char *name)
{
    const char *const one[] = {columns->radius_column, columns->diameter_column,
                               columns->mass_column, columns->weight_column,
                               columns->variable_column};
    bool is = has_name(&columns->columns, name) || has_name(&columns->velocity_columns, name);
    for (size_t k = 0; k < sizeof one / sizeof one[0]; ++k) {
        is = is || (one[k] != NULL && strcmp(one[k], name) == 0);
    }
    return is;
}

/// Whether a column holds times by its name and unit: "time_ms", "Time (s)", "timestep".
static bool is_time(const clast_column *c)
{
    static const char *const words[] = {"time", "t",         "timestep", "time_step",
                                        "step", "iteration", "frame",    NULL};
    char unit[CLX_COLUMN_UNIT];
    char word[CLX_COLUMN_UNIT];
    double second = 0.0;
    const clx_unit_said said = clx_column_unit(c->name, unit);
    const bool has_own = c->unit != NULL && strcmp(c->unit, "-") != 0;
    const bool has_unit = has_own || said != CLX_UNIT_NONE;
    const char *const bar = strrchr(c->name, '_');
    size_t n = strcspn(c->name, "([");
    if (c->name[n] == '\0' && said != CLX_UNIT_NONE && bar != NULL) {
        n = (size_t)(bar - c->name);
    }
    while (n > 0 && c->name[n - 1] == ' ') {
        --n;
    }
    (void)snprintf(word, sizeof word, "%.*s", n < sizeof word ? (int)n : 0, c->name);
    return is_one_of(word, words) && (has_unit || strcmp(word, "T") != 0) &&
           (!has_unit || clast_unit_factor(has_own ? c->unit : unit, "s", &second) == CLAST_OK);
}

static void add_time(clx_times *times, double value)
{
    int32_t at = 0;
    for (int32_t end = times->n; at < end;) {
        const int32_t middle = at + (end - at) / 2;
        if (times->value[middle] < value) {
            at = middle + 1;
        } else {
            end = middle;
        }
    }
    if (times->n < CLX_MOST_TIMES && isfinite(value) &&
        (at == times->n || times->value[at] != value)) {
        memmove(&times->value[at + 1], &times->value[at],
                (size_t)(times->n - at) * sizeof *times->value);
        times->value[at] = value;
        ++times->n;
    }
}

void clx_times_add(const clast_table *table, const clast_cloud_columns *columns, clx_times *times)
{
    const bool is_bodies =
        clast_table_find(table, "node") >= 0 && clast_table_find(table, "time_s") >= 0;
    for (int32_t k = 0; k < table->n_column && !is_bodies; ++k) {
        const clast_column *c = &table->column[k];
        if (c->number == NULL || !is_time(c) || is_named(columns, c->name)) {
            continue;
        }
        (void)snprintf(times->column, sizeof times->column, "%s", c->name);
        for (int64_t i = 0; i < table->n_row; ++i) {
            if (i == 0 || c->number[i] != c->number[i - 1]) {
                add_time(times, c->number[i]);
            }
        }
        return;
    }
}

clast_status clx_times_check(const clast_comm *comm, const char *name, const clx_times *times)
{
    clast_status status = CLAST_OK;
    int32_t n = 0;
    int32_t at = 0;
    double least = -(double)INFINITY;
    while (n < CLX_MOST_TIMES && least < (double)INFINITY) { // the least of all ranks that is new
        while (at < times->n && times->value[at] <= least) {
            ++at;
        }
        least = clx_comm_least(comm, at < times->n ? times->value[at] : (double)INFINITY);
        n += least < (double)INFINITY ? 1 : 0;
    }
    CLX_CHECK(n <= 1, CLAST_E_FORMAT,
              "%s: column '%s' holds %s%d times; the points of one are a cloud: give the rows of "
              "one time (or rename the column, where it is something else)",
              name, times->column, n < CLX_MOST_TIMES ? "" : "at least ", n);
done:
    return status;
}

void clx_cloud_find_weight(const clast_table *table, const clast_cloud_columns *columns,
                           clast_cloud *cloud)
{
    static const char *const words[] = {
        "weight",       "stat_weight", "statistical_weight", "parcel_weight", "n_real",
        "multiplicity", NULL};
    if (columns->weight_column != NULL && columns->weight_column[0] != '\0') {
        return;
    }
    for (int32_t k = 0; k < table->n_column && cloud->unread_weight[0] == '\0'; ++k) {
        const clast_column *c = &table->column[k];
        const bool is_weight =
            c->number != NULL && is_one_of(c->name, words) && !is_named(columns, c->name);
        int64_t i = 0;
        while (is_weight && i < table->n_row && c->number[i] == 1.0) {
            ++i;
        }
        if (is_weight && i < table->n_row) {
            (void)snprintf(cloud->unread_weight, sizeof cloud->unread_weight, "%s", c->name);
        }
    }
}
