// Forms of a set of grains from a table's columns; rows that have none are listed, not guessed.
#include "shape/form_set.h"

#include "base/alloc.h"
#include "base/column_unit.h"
#include "base/number.h"
#include "base/status.h"
#include "shape/size_column.h"
#include "shape/whole.h"
#include <clast/form.h>
#include <clast/table.h>
#include <ctype.h>
#include <stdio.h>
#include <string.h>

/// Two-digit tables (flatness 0.65) stay within this of the ratio of their rounded lengths.
static const double DISAGREE = 0.006;
static const double ABOVE_ONE = 1e-9;

enum { N_NAME = 8, NAME_SIZE = 64 };
enum { LONG, MIDDLE, SHORT, FLATNESS, ELONGATION, SIZE, N_ROLE };

static const char *const names[N_ROLE][N_NAME] = {
    [LONG] = {"l", "long", "longest", "major_axis_length", "length"},
    [MIDDLE] = {"i", "intermediate", "middle", "middle_axis_length", "width"},
    [SHORT] = {"s", "short", "shortest", "minor_axis_length", "thickness"},
    [FLATNESS] = {"flatness", "fl", "s/i"},
    [ELONGATION] = {"elongation", "el", "i/l"},
    [SIZE] = {"sieve_size", "d", "size", "diameter", "equivalent_diameter"},
};

/// Columns found; -1 for none.
typedef struct {
    int32_t at[N_ROLE];
    bool by_length;
    bool mixes_units;             ///< L, I and S are in different ones
    double factor[3];             ///< of these: into metres then, else 1
    clx_length_unit unit[N_ROLE]; ///< of these, else of the size
} roles;

const char *clast_row_fault_text(clast_row_fault fault)
{
    static const char *const text[CLAST_N_ROW_FAULT] = {
        "missing", "not a number", "infinite", "not positive", "above 1", "not L >= I >= S"};
    return (unsigned)fault < CLAST_N_ROW_FAULT ? text[fault] : "unknown";
}

/// How much of a column's name stands before its unit: "Minor Axis Length (um)", "L_mm".
static int plain_length(const clast_column *column)
{
    char told[CLX_COLUMN_UNIT];
    size_t n = strcspn(column->name, "([");
    while (n > 0 && (column->name[n - 1] == ' ' || column->name[n - 1] == '_')) {
        --n;
    }
    const size_t unit = clx_column_says_length(column->name, told) ? strlen(told) : 0;
    if (unit > 0 && n > unit + 1 && column->name[n - unit - 1] == '_' &&
        strncmp(column->name + n - unit, told, unit) == 0) {
        n -= unit + 1;
    }
    return (int)(n < NAME_SIZE - 1 ? n : NAME_SIZE - 1);
}

/// "Minor Axis Length (um)" -> "minor_axis_length", "L_mm" -> "l".
static void plain_name(const clast_column *column, char plain[NAME_SIZE])
{
    const int n = plain_length(column);
    for (int i = 0; i < n; ++i) {
        const char c = column->name[i];
        plain[i] = c == ' ' || c == '-' ? '_' : (char)tolower((unsigned char)c);
    }
    plain[n] = '\0';
}

/// The first column of a role; of lengths D_mm rather than a D_ft before it.
static int32_t find_role(const clast_table *table, int role)
{
    CLAST_ASSERT(role >= 0 && role < N_ROLE);
    int32_t other = -1; // in a unit that is not read
    for (int k = 0; k < N_NAME && names[role][k] != NULL; ++k) {
        for (int32_t c = 0; c < table->n_column; ++c) {
            char plain[NAME_SIZE];
            clx_length_unit length;
            plain_name(&table->column[c], plain);
            if (strcmp(plain, names[role][k]) != 0) {
                continue;
            }
            if (role == FLATNESS || role == ELONGATION ||
                clx_column_length(&table->column[c], true, &length) == CLAST_OK) {
                return c;
            }
            other = other < 0 ? c : other;
        }
    }
    return other;
}

/// Columns that the caller names: two ratios or three lengths.
static clast_status named_roles(const clast_table *table, const char *columns, roles *r)
{
    clast_status status = CLAST_OK;
    int32_t found[4] = {-1, -1, -1, -1};
    int n = 0;
    for (const char *at = columns; *at != '\0';) {
        char name[256];
        at += strspn(at, " ");
        const size_t length = strcspn(at, ",");
        CLX_CHECK(n < 3 && length < sizeof name, CLAST_E_USAGE,
                  "columns '%s': two names (flatness, elongation) or three (L, I, S) are taken",
                  columns);
        (void)snprintf(name, sizeof name, "%.*s", (int)length, at);
        found[n] = clast_table_find(table, name);
        CLX_CHECK(found[n] >= 0, CLAST_E_FORMAT, "table %s has no column '%s'", table->name, name);
        ++n;
        at += length + (at[length] == ',' ? 1 : 0);
    }
    CLX_CHECK(n == 2 || n == 3, CLAST_E_USAGE,
              "columns '%s': two names (flatness, elongation) or three (L, I, S) are taken",
              columns);
    for (int k = 0; k < n; ++k) {
        r->at[n == 2 ? FLATNESS + k : LONG + k] = found[k];
    }
    r->by_length = n == 3;
    r->at[SIZE] = find_role(table, SIZE);
done:
    return status;
}

/// Columns by their names; false where they give no form.
static bool known_roles(const clast_table *table, roles *r)
{
    for (int k = 0; k < N_ROLE; ++k) {
        r->at[k] = find_role(table, k);
    }
    r->by_length = r->at[LONG] >= 0 && r->at[MIDDLE] >= 0 && r->at[SHORT] >= 0;
    return r->by_length || (r->at[FLATNESS] >= 0 && r->at[ELONGATION] >= 0);
}

bool clast_form_set_named(const clast_table *table)
{
    roles r;
    return table != NULL && clx_table_fault(table) == NULL && known_roles(table, &r);
}

/// Lengths of one row may be in different units; all three columns say theirs, or none does.
static clast_status find_factors(const clast_table *table, roles *r)
{
    clast_status status = CLAST_OK;
    const clx_length_unit *unit = &r->unit[LONG];
    int n_unit = 0;
    for (int k = 0; k < 3; ++k) {
        CLX_TRY(clx_column_length(&table->column[r->at[LONG + k]], true, &r->unit[LONG + k]));
        n_unit += unit[k].metre > 0.0;
    }
    CLX_CHECK(n_unit == 0 || n_unit == 3, CLAST_E_FORMAT,
              "table %s: %d of the 3 columns of L, I and S say their unit of length; give all of "
              "them one, or none",
              table->name, n_unit);
    r->mixes_units = unit[0].metre != unit[2].metre || unit[1].metre != unit[2].metre;
    for (int k = 0; k < 3; ++k) {
        r->factor[k] = r->mixes_units ? unit[k].metre : 1.0;
    }
done:
    return status;
}

static clast_status find_roles(const clast_table *table, const char *columns, roles *r)
{
    clast_status status = CLAST_OK;
    *r = (roles){.at = {-1, -1, -1, -1, -1, -1}};
    if (columns != NULL && columns[0] != '\0') {
        CLX_TRY(named_roles(table, columns, r));
    } else {
        CLX_CHECK(known_roles(table, r), CLAST_E_FORMAT,
                  "table %s has neither the columns flatness and elongation nor L, I and S; name "
                  "them with --columns a,b or a,b,c",
                  table->name);
    }
    if (r->by_length) {
        CLX_TRY(find_factors(table, r));
    } else if (r->at[SIZE] >= 0) {
        CLX_TRY(clx_column_length(&table->column[r->at[SIZE]], true, &r->unit[SIZE]));
    }
done:
    return status;
}

clast_status clx_form_set_mixes_units(const clast_table *table, const char *columns, bool *mixes)
{
    roles r;
    const clast_status status = find_roles(table, columns, &r);
    *mixes = status == CLAST_OK && r.mixes_units;
    return status;
}

static bool is_word(const char *text, const char *lower)
{
    for (; *lower != '\0' && tolower((unsigned char)*text) == *lower; ++text) {
        ++lower;
    }
    return *lower == '\0' && *text == '\0';
}

/// A text cell as a number; NAN with *fault set if it is none.
static double text_cell(const char *text, clast_row_fault *fault)
{
    double value = 0.0;
    const char *end = text + strlen(text);
    if (*text == '\0' || is_word(text, "na") || is_word(text, "nan")) {
        *fault = CLAST_ROW_MISSING;
        return NAN;
    }
    if (is_word(text, "inf") || is_word(text, "-inf")) {
        return *text == '-' ? -HUGE_VAL : HUGE_VAL;
    }
    if (clx_number_parse(text, end, &value) != end) {
        *fault = CLAST_ROW_NOT_NUMBER;
        return NAN;
    }
    return value;
}

/// A cell as a number in the unit; NAN with *fault set if it is none.
static double cell(const clast_column *c, const clx_length_unit *unit, int64_t row,
                   clast_row_fault *fault)
{
    double value = NAN;
    if (c->number != NULL) {
        value = c->number[row];
        *fault = isnan(value) ? CLAST_ROW_MISSING : *fault;
    } else {
        value = text_cell(c->text[row], fault);
    }
    if (!isnan(value)) {
        value = isinf(value) ? value : clx_length_value(unit, value);
        *fault = isinf(value) ? CLAST_ROW_INFINITE : value <= 0.0 ? CLAST_ROW_NOT_POSITIVE : *fault;
    }
    return value;
}

/// Flatness and elongation of a row, or why it has none (CLAST_N_ROW_FAULT: nothing wrong).
static clast_row_fault form_of(const clast_table *table, const roles *r, int64_t row, double *fl,
                               double *el, double *sieve)
{
    clast_row_fault fault = CLAST_N_ROW_FAULT;
    double v[3] = {0.0};
    const int first = r->by_length ? LONG : FLATNESS;
    const int n = r->by_length ? 3 : 2;
    for (int k = 0; k < n && fault == CLAST_N_ROW_FAULT; ++k) {
        v[k] = cell(&table->column[r->at[first + k]], &r->unit[first + k], row, &fault);
        v[k] *= r->by_length ? r->factor[k] : 1.0;
    }
    if (fault != CLAST_N_ROW_FAULT) {
        return fault;
    }
    *fl = r->by_length ? v[2] / v[1] : v[0];
    *el = r->by_length ? v[1] / v[0] : v[1];
    *sieve = r->by_length ? clast_form_sieve_size(v[1], v[2]) : (double)NAN;
    if (!(*fl <= 1.0 + ABOVE_ONE && *el <= 1.0 + ABOVE_ONE)) {
        return r->by_length ? CLAST_ROW_NOT_ORDERED : CLAST_ROW_ABOVE_ONE;
    }
    *fl = fmin(*fl, 1.0);
    *el = fmin(*el, 1.0);
    return *fl > 0.0 && *el > 0.0 ? CLAST_N_ROW_FAULT : CLAST_ROW_NOT_POSITIVE; // underflow
}

/// Ratios beside lengths must be the ratios of those lengths.
static clast_status check_agreement(const clast_table *table, const roles *r, int64_t row,
                                    double fl, double el)
{
    clast_status status = CLAST_OK;
    const double own[2] = {fl, el};
    for (int k = 0; k < 2; ++k) {
        clast_row_fault fault = CLAST_N_ROW_FAULT;
        const int32_t c = r->at[FLATNESS + k];
        const double printed =
            c >= 0 ? cell(&table->column[c], &r->unit[FLATNESS + k], row, &fault) : (double)NAN;
        CLX_CHECK(isnan(printed) || fabs(printed - own[k]) <= DISAGREE, CLAST_E_FORMAT,
                  "table %s, row %lld: column '%s' is %g but %s is %g; say with --columns which "
                  "counts",
                  table->name, (long long)row + 1, table->column[c].name, printed,
                  k == 0 ? "S/I" : "I/L", own[k]);
    }
done:
    return status;
}

static clast_status alloc_set(int64_t n, bool has_size, clast_form_set *s)
{
    CLAST_ASSERT(n >= 0);
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&s->row, n, sizeof *s->row));
    CLX_TRY(clx_alloc(&s->flatness, n, sizeof *s->flatness));
    CLX_TRY(clx_alloc(&s->elongation, n, sizeof *s->elongation));
    CLX_TRY(clx_alloc(&s->left_out, n, sizeof *s->left_out));
    if (has_size) {
        CLX_TRY(clx_alloc(&s->size, n, sizeof *s->size));
    }
done:
    return status;
}

void clast_form_set_free(clast_form_set *set)
{
    if (set == NULL) {
        return;
    }
    CLX_FREE(set->row, set->flatness, set->elongation, set->size, set->left_out);
    *set = (clast_form_set){0};
}

/// "sieve size" of lengths and of columns that say so, else the column's own name; in its unit.
static void name_size(const clast_table *table, const roles *r, clast_form_set *s)
{
    char plain[NAME_SIZE] = "";
    const int role = r->by_length ? SHORT : SIZE;
    const int32_t c = r->at[role];
    if (c < 0) {
        return;
    }
    const clast_column *column = &table->column[c];
    plain_name(column, plain);
    s->is_sieve_size = r->by_length || strcmp(plain, "d") == 0 || strcmp(plain, "sieve_size") == 0;
    (void)snprintf(s->size_name, sizeof s->size_name, "%.*s",
                   s->is_sieve_size ? NAME_SIZE : plain_length(column),
                   s->is_sieve_size ? "sieve size" : column->name);
    if (r->unit[role].metre > 0.0) {
        (void)snprintf(s->size_unit, sizeof s->size_unit, "%.15s",
                       r->mixes_units ? "m" : r->unit[role].unit);
    }
}

/// Numbers of grains or masses, some of which are not 1: they are not looked at.
static void find_count(const clast_table *table, const roles *r, clast_form_set *s)
{
    for (int32_t c = 0; c < table->n_column && s->unread_count[0] == '\0'; ++c) {
        const clast_column *column = &table->column[c];
        int64_t row = 0;
        for (int k = 0; k < N_ROLE; ++k) {
            row = r->at[k] == c ? table->n_row : row;
        }
        if (column->number == NULL || clx_size_column_of(column->name) == CLX_SIZE_COLUMN_OTHER) {
            continue;
        }
        while (row < table->n_row && column->number[row] == 1.0) {
            ++row;
        }
        if (row < table->n_row) {
            (void)snprintf(s->unread_count, sizeof s->unread_count, "%s", column->name);
        }
    }
}

/// Whether the first row has no form for a decimal comma.
static bool has_comma(const clast_table *table, const roles *r)
{
    const int32_t *const at = &r->at[r->by_length ? LONG : FLATNESS];
    bool has = false;
    for (int k = 0; k < (r->by_length ? 3 : 2) && table->n_row > 0; ++k) {
        const clast_column *column = &table->column[at[k]];
        has = has || (column->text != NULL && clx_number_has_comma(column->text[0]));
    }
    return has;
}

/// The size of a row; NAN where it is missing, infinite or not positive: its form is known all the
/// same.
static double size_of(const clast_table *table, const roles *r, int64_t row, double sieve)
{
    clast_row_fault fault = CLAST_N_ROW_FAULT;
    const double size =
        r->by_length ? sieve : cell(&table->column[r->at[SIZE]], &r->unit[SIZE], row, &fault);
    return fault == CLAST_N_ROW_FAULT ? size : (double)NAN;
}

clast_status clast_form_set_of(const clast_table *table, const char *columns, clast_form_set *set)
{
    CLX_ARGUMENTS(table, set);
    CLX_WHOLE(table, table);
    clast_status status = CLAST_OK;
    clast_form_set s = {0};
    roles r;
    CLX_TRY(find_roles(table, columns, &r));
    CLX_TRY(alloc_set(table->n_row, r.by_length || r.at[SIZE] >= 0, &s));
    name_size(table, &r, &s);
    find_count(table, &r, &s);
    for (int64_t row = 0; row < table->n_row; ++row) {
        double sieve = NAN;
        const clast_row_fault fault =
            form_of(table, &r, row, &s.flatness[s.n], &s.elongation[s.n], &sieve);
        if (fault != CLAST_N_ROW_FAULT) {
            s.left_out[s.n_left_out++] = (clast_left_out){row, fault};
            continue;
        }
        CLX_TRY(check_agreement(table, &r, row, s.flatness[s.n], s.elongation[s.n]));
        if (s.size != NULL) {
            s.size[s.n] = size_of(table, &r, row, sieve);
        }
        s.row[s.n++] = row;
    }
    CLX_CHECK(s.n > 0, CLAST_E_FORMAT, "table %s: none of its %lld rows has a form%s%s%s",
              table->name, (long long)table->n_row, table->n_row > 0 ? "; row 1 is " : "",
              table->n_row > 0 ? clast_row_fault_text(s.left_out[0].fault) : "",
              has_comma(table, &r) ? "; a decimal comma? write 0.5, not 0,5" : "");
    *set = s;
    s = (clast_form_set){0};
done:
    clast_form_set_free(&s);
    return status;
}

/// " (rows 2, 3 and 5 more)"
static void write_rows(const clast_form_set *set, char *text, size_t size, size_t used)
{
    enum { MOST_SHOWN = 10 };
    const int64_t n = set->n_left_out;
    const int64_t n_shown = n <= MOST_SHOWN ? n : MOST_SHOWN;
    for (int64_t k = 0; k < n_shown && used < size; ++k) {
        used += (size_t)snprintf(text + used, size - used, "%s%lld",
                                 k > 0    ? ", "
                                 : n == 1 ? " (row "
                                          : " (rows ",
                                 (long long)set->left_out[k].row + 1);
    }
    if (used < size && n_shown < n) {
        used +=
            (size_t)snprintf(text + used, size - used, " and %lld more", (long long)(n - n_shown));
    }
    if (used < size) {
        (void)snprintf(text + used, size - used, ")");
    }
}

void clast_form_set_complaint(const clast_form_set *set, size_t size, char *text)
{
    if (clx_form_set_fault(set) != NULL || text == NULL || size == 0) {
        return;
    }
    int64_t count[CLAST_N_ROW_FAULT] = {0};
    size_t used = 0;
    text[0] = '\0';
    if (set->n_left_out == 0) {
        return;
    }
    for (int64_t k = 0; k < set->n_left_out; ++k) {
        ++count[set->left_out[k].fault];
    }
    used = (size_t)snprintf(text, size, "%lld of %lld rows left out:", (long long)set->n_left_out,
                            (long long)set->n_left_out + (long long)set->n);
    const char *comma = "";
    for (int f = 0; f < CLAST_N_ROW_FAULT && used < size; ++f) {
        if (count[f] > 0) {
            used += (size_t)snprintf(text + used, size - used, "%s %lld %s", comma,
                                     (long long)count[f], clast_row_fault_text((clast_row_fault)f));
            comma = ",";
        }
    }
    write_rows(set, text, size, used);
}

const char *clast_form_set_count_words(const clast_form_set *set, size_t size, char *text)
{
    if (set == NULL || text == NULL || size == 0) {
        return "";
    }
    text[0] = '\0';
    if (set->unread_count[0] != '\0') {
        (void)snprintf(text, size, "column '%s' is not looked at: each row is one grain",
                       set->unread_count);
    }
    return text;
}

clast_status clast_form_set_factors(const clast_form_set *set, clast_table *table)
{
    CLX_ARGUMENTS(set, table);
    CLX_WHOLE(form_set, set);
    clast_status status = CLAST_OK;
    clast_table t = {0};
    double *column = NULL;
    CLX_TRY(clast_table_init(&t, "form_factors", set->n));
    for (int32_t f = 0; f < CLAST_N_FORM_FACTOR; ++f) {
        CLX_TRY(clast_table_add_number(&t, clast_form_factor_about(f)->name, "-", &column));
        for (int64_t i = 0; i < set->n; ++i) {
            double lis[3];
            clast_form_lengths(set->flatness[i], set->elongation[i], 1.0, lis);
            column[i] = clast_form_factor_value((clast_form_factor)f, lis[0], lis[1], lis[2]);
        }
    }
    if (set->size != NULL) {
        char name[NAME_SIZE];
        const bool has_unit = set->size_unit[0] != '\0';
        (void)snprintf(name, sizeof name, "size%s%s", has_unit ? "_" : "", set->size_unit);
        CLX_TRY(clast_table_add_number(&t, name, has_unit ? set->size_unit : "-", &column));
        memcpy(column, set->size, (size_t)set->n * sizeof *column);
    }
    *table = t;
    t = (clast_table){0};
done:
    clast_table_free(&t);
    return status;
}

clast_status clast_form_set_left_out(const clast_form_set *set, clast_table *table)
{
    CLX_ARGUMENTS(set, table);
    CLX_WHOLE(form_set, set);
    clast_status status = CLAST_OK;
    clast_table t = {0};
    double *row = NULL;
    CLX_TRY(clast_table_init(&t, "left_out", set->n_left_out));
    CLX_TRY(clast_table_add_number(&t, "row", "-", &row));
    CLX_TRY(clast_table_add_text(&t, "reason"));
    for (int64_t k = 0; k < set->n_left_out; ++k) {
        row[k] = (double)set->left_out[k].row + 1.0;
        CLX_TRY(clast_table_set_text(&t, 1, k, clast_row_fault_text(set->left_out[k].fault)));
    }
    *table = t;
    t = (clast_table){0};
done:
    clast_table_free(&t);
    return status;
}
