// Sieve curves from delimited text, and sizes from one text of the command line.
#include <clast/grading.h>

#include "base/alloc.h"
#include "base/column_unit.h"
#include "base/file.h"
#include "base/number.h"
#include "io/curve_columns.h"
#include "io/sizes.h"
#include "shape/curve.h"
#include <clast/field.h>
#include <clast/table.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIEVE_LIMIT = 10000 };
static const int64_t BYTE_LIMIT = (int64_t)1 << 24;
/// A sheet in % or shares may miss the whole by this much of it: rounded entries, and the grains
/// lost in sieving, of which EN 933-1 allows as much.
static const double MISSED = 0.01;

/// One sieve of the file: what stays on it, or what passes it.
typedef struct {
    double size;  ///< m, 0 for a pan
    double value; ///< as in the file
    int64_t row;  ///< in the file, from 1
} sieve_row;

typedef struct {
    const char *name; ///< of the file, for messages
    clx_length_unit unit;
    sieve_row *row; ///< [n] ascending
    int32_t n;
    clx_curve_kind kind;
    const clast_column *value;
    double whole; ///< by the column's name, 0: not told
    double *sieve, *mass;
} curve_reader;

static clast_status size_in_metres(const curve_reader *r, const clast_column *column, int64_t i,
                                   double *size)
{
    clast_status status = CLAST_OK;
    const double number = column->number[i];
    CLX_CHECK(isfinite(number), CLAST_E_FORMAT,
              "%s: row %lld: the sieve size is missing or not "
              "finite",
              r->name, (long long)i + 1);
    CLX_CHECK(number >= 0.0 || r->unit.is_phi, CLAST_E_FORMAT,
              "%s: row %lld: a sieve size of %g %s", r->name, (long long)i + 1, number,
              r->unit.unit);
    *size = clx_length_value(&r->unit, number) * r->unit.metre;
done:
    return status;
}

static int by_size(const void *a, const void *b)
{
    const double x = ((const sieve_row *)a)->size;
    const double y = ((const sieve_row *)b)->size;
    return (x > y) - (x < y);
}

static clast_status read_rows(curve_reader *r, const clast_table *table)
{
    clast_status status = CLAST_OK;
    clx_curve_columns columns = {0};
    CLX_TRY(clx_curve_columns_find(r->name, table, &columns));
    const clast_column *size = &table->column[columns.size];
    const clast_column *value = &table->column[columns.value];
    r->kind = columns.kind;
    r->value = value;
    r->whole = columns.whole;
    status = clx_column_length(size, true, &r->unit);
    if (status != CLAST_OK) {
        clx_fail_prefix("%s", r->name);
        goto done;
    }
    CLX_CHECK(r->unit.metre > 0.0, CLAST_E_FORMAT,
              "%s: column %s has no unit; call it %s_mm, %s_um or phi", r->name, size->name,
              size->name, size->name);
    CLX_CHECK(table->n_row >= 2 && table->n_row <= SIEVE_LIMIT, CLAST_E_FORMAT,
              "%s: %lld sieves; a curve has 2 to %d", r->name, (long long)table->n_row,
              SIEVE_LIMIT);
    CLX_TRY(clx_alloc(&r->row, table->n_row, sizeof *r->row));
    for (int64_t i = 0; i < table->n_row; ++i) {
        sieve_row *row = &r->row[r->n++];
        row->row = i + 1;
        row->value = value->number[i];
        CLX_TRY(size_in_metres(r, size, i, &row->size));
        CLX_CHECK(isfinite(row->value) && row->value >= 0.0, CLAST_E_FORMAT,
                  "%s: row %lld: %s is missing, negative or not finite", r->name, (long long)i + 1,
                  value->name);
    }
    qsort(r->row, (size_t)r->n, sizeof *r->row, by_size);
    for (int32_t i = 1; i < r->n; ++i) {
        CLX_CHECK(r->row[i].size > r->row[i - 1].size, CLAST_E_FORMAT,
                  "%s: rows %lld and %lld are the same sieve of %g mm", r->name,
                  (long long)r->row[i - 1].row, (long long)r->row[i].row, 1e3 * r->row[i].size);
    }
done:
    return status;
}

/// A pan (size 0) may be there if nothing is in it: its grains would have no smallest size.
static clast_status drop_pan(curve_reader *r)
{
    CLAST_ASSERT(r->row != NULL && r->n > 0);
    clast_status status = CLAST_OK;
    if (r->row[0].size <= 0.0) {
        const double above = r->kind == CLX_CURVE_CUMULATIVE && r->n > 1 ? r->row[1].value : 0.0;
        const double held = r->row[0].value - above;
        CLX_CHECK(held <= 1e-9 * above, CLAST_E_FORMAT,
                  "%s: row %lld: %g is finer than every sieve; give a smallest size instead of the "
                  "pan",
                  r->name, (long long)r->row[0].row, held);
        --r->n;
        memmove(r->row, r->row + 1, (size_t)r->n * sizeof *r->row);
    }
    CLX_CHECK(r->n >= 2, CLAST_E_FORMAT, "%s: one sieve is no curve", r->name);
done:
    return status;
}

/// The largest sieve holds back nothing: its grains would have no largest size.
static clast_status check_largest(const curve_reader *r)
{
    const sieve_row *last = &r->row[r->n - 1];
    if (last->value > 0.0) {
        return clx_fail(CLAST_E_FORMAT,
                        "%s: row %lld: %g stays on the largest sieve of %g mm; add a larger one "
                        "that all passes",
                        r->name, (long long)last->row, last->value, 1e3 * last->size);
    }
    return CLAST_OK;
}

static bool is_whole(double total, double whole)
{
    return fabs(total - whole) <= MISSED * whole * (1.0 + 1e-9);
}

/// Masses in any unit; in % or shares, of which all have to be there.
static clast_status retained_masses(curve_reader *r)
{
    clast_status status = CLAST_OK;
    double sum = 0.0;
    CLX_TRY(check_largest(r));
    for (int32_t i = 0; i + 1 < r->n; ++i) {
        r->mass[i] = r->row[i].value;
        sum += r->mass[i];
    }
    CLX_CHECK(
        r->whole == 0.0 || is_whole(sum, r->whole) || (r->whole == 1.0 && is_whole(sum, 100.0)),
        CLAST_E_FORMAT,
        "%s: column '%s' sums to %g, not %g; is the pan missing (give it a smallest size), or are "
        "these masses (retained_g)?",
        r->name, r->value->name, sum, r->whole);
done:
    return status;
}

/// What all grains together are in the unit of a cumulative column, whose greatest value is `most`.
static double all_of(const curve_reader *r, double most)
{
    if (strcmp(r->value->unit, "%") == 0) {
        return 100.0;
    }
    if (strcmp(r->value->unit, "-") == 0) {
        return most <= 1.0 + MISSED ? 1.0 : 100.0;
    }
    return most;
}

static clast_status cumulative_masses(curve_reader *r)
{
    clast_status status = CLAST_OK;
    const sieve_row *first = &r->row[0];
    const double all = all_of(r, first->value);
    CLX_TRY(check_largest(r));
    CLX_CHECK(is_whole(first->value, all), CLAST_E_FORMAT,
              "%s: row %lld: %g of %g stay on %g mm and coarser; add the size that nothing passes "
              "(masses: with their unit, cumulative retained_g)",
              r->name, (long long)first->row, first->value, all, 1e3 * first->size);
    for (int32_t i = 0; i + 1 < r->n; ++i) {
        r->mass[i] = r->row[i].value - r->row[i + 1].value;
        CLX_CHECK(r->mass[i] >= 0.0, CLAST_E_FORMAT,
                  "%s: row %lld: %g on %g mm and coarser, less than the %g on %g mm", r->name,
                  (long long)r->row[i].row, r->row[i].value, 1e3 * r->row[i].size,
                  r->row[i + 1].value, 1e3 * r->row[i + 1].size);
    }
done:
    return status;
}

static clast_status passing_masses(curve_reader *r)
{
    clast_status status = CLAST_OK;
    const sieve_row *last = &r->row[r->n - 1];
    const double all = all_of(r, last->value);
    CLX_CHECK(r->row[0].value <= 0.0, CLAST_E_FORMAT,
              "%s: row %lld: %g pass the smallest sieve of %g mm; add the size that nothing passes",
              r->name, (long long)r->row[0].row, r->row[0].value, 1e3 * r->row[0].size);
    CLX_CHECK(
        is_whole(last->value, all), CLAST_E_FORMAT,
        "%s: row %lld: %g of %g pass the largest sieve of %g mm; add the size that all passes",
        r->name, (long long)last->row, last->value, all, 1e3 * last->size);
    for (int32_t i = 0; i + 1 < r->n; ++i) {
        r->mass[i] = r->row[i + 1].value - r->row[i].value;
        CLX_CHECK(r->mass[i] >= 0.0, CLAST_E_FORMAT,
                  "%s: row %lld: %g pass %g mm, less than the %g that pass %g mm", r->name,
                  (long long)r->row[i + 1].row, r->row[i + 1].value, 1e3 * r->row[i + 1].size,
                  r->row[i].value, 1e3 * r->row[i].size);
    }
done:
    return status;
}

static clast_status make_curve(curve_reader *r, clast_curve *curve)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&r->sieve, r->n, sizeof *r->sieve));
    CLX_TRY(clx_alloc(&r->mass, r->n, sizeof *r->mass));
    CLX_TRY(r->kind == CLX_CURVE_PASSING      ? passing_masses(r)
            : r->kind == CLX_CURVE_CUMULATIVE ? cumulative_masses(r)
                                              : retained_masses(r));
    for (int32_t i = 0; i < r->n; ++i) {
        r->sieve[i] = r->row[i].size;
    }
    status = clast_curve_make(r->n - 1, r->sieve, r->mass, curve);
    if (status == CLAST_E_CONFIG) {
        clx_fail_prefix("%s", r->name);
        status = CLAST_E_FORMAT;
    }
done:
    return status;
}

clast_status clast_curve_parse(const char *name, const void *bytes, size_t n, clast_curve *curve)
{
    CLX_ARGUMENTS(name, curve);
    CLX_ARRAY(bytes, n);
    clast_status status = CLAST_OK;
    clast_table table = {0};
    curve_reader r = {.name = name};
    CLX_TRY(clast_table_parse_csv(name, bytes, n, NULL, &table, NULL));
    CLX_TRY(read_rows(&r, &table));
    CLX_TRY(drop_pan(&r));
    CLX_TRY(make_curve(&r, curve));
done:
    clast_table_free(&table);
    CLX_FREE(r.row, r.sieve, r.mass);
    return status;
}

clast_status clast_curve_read(const char *path, clast_curve *curve)
{
    CLX_ARGUMENTS(path, curve);
    clast_status status = CLAST_OK;
    char *bytes = NULL;
    int64_t n = 0;
    CLX_TRY(clx_file_read_all(path, BYTE_LIMIT, &bytes, &n));
    CLX_TRY(clast_curve_parse(path, bytes, (size_t)n, curve));
done:
    clx_free(bytes);
    return status;
}

enum { N_LAW_NUMBER = 4 };

/// Lengths "5mm, 8mm" after the name of a law.
static clast_status law_numbers(const char *text, const char *at, int32_t *n,
                                double number[N_LAW_NUMBER])
{
    clast_status status = CLAST_OK;
    *n = 0;
    while (at != NULL) {
        char word[64];
        const char *comma = strchr(at, ',');
        const int length = comma != NULL ? (int)(comma - at) : (int)strlen(at);
        CLX_CHECK(*n < N_LAW_NUMBER && length < (int)sizeof word, CLAST_E_CONFIG,
                  "'%s': more than %d numbers, or a long one", text, N_LAW_NUMBER);
        (void)snprintf(word, sizeof word, "%.*s", length, at);
        status = clast_unit_parse_asked(word, "m", &number[(*n)++]);
        if (status != CLAST_OK) {
            clx_fail_prefix("'%s'", text);
            goto done;
        }
        at = comma != NULL ? comma + 1 : NULL;
    }
done:
    return status;
}

static clast_status load_law(const char *text, bool is_lognormal, clast_grading **grading)
{
    clast_status status = CLAST_OK;
    double v[N_LAW_NUMBER] = {0.0};
    int32_t n = 0;
    CLX_TRY(law_numbers(text, strchr(text, ':') + 1, &n, v));
    if (is_lognormal) {
        CLX_CHECK(n == 2 || n == 4, CLAST_E_CONFIG,
                  "'%s': expected lognormal:MEAN,DEVIATION or lognormal:MEAN,DEVIATION,LOW,HIGH",
                  text);
        CLX_TRY(clast_grading_lognormal(v[0], v[1], v[2], n == 4 ? v[3] : HUGE_VAL, grading));
    } else {
        CLX_CHECK(n == 2, CLAST_E_CONFIG, "'%s': expected uniform:LOW,HIGH", text);
        CLX_TRY(clast_grading_uniform(v[0], v[1], grading));
    }
done:
    return status;
}

const char *clast_grading_list_text(const clast_grading_list *list, bool by_mass, size_t size,
                                    char *text)
{
    char by[192] = "one grain a row";
    if (list == NULL || text == NULL || size == 0) {
        return "";
    }
    text[0] = '\0';
    if (list->n_row <= 0 || list->column == NULL || list->ignored == NULL) {
        return text;
    }
    if (list->column[0] != '\0') {
        (void)clx_number_print(by, sizeof by, "%s by column '%.127s': %.6g in all",
                               by_mass ? "weighed" : "counted", list->column, list->total);
    }
    (void)snprintf(text, size, "%lld row%s, %s%s%s", (long long)list->n_row,
                   list->n_row > 1 ? "s" : "", by,
                   list->ignored[0] != '\0' ? "; not looked at: " : "", list->ignored);
    return text;
}

static clast_status load_list(const char *path, bool by_mass, clast_grading **grading)
{
    clast_status status = CLAST_OK;
    clast_sizes sizes = {0};
    clast_grading *made = NULL;
    clx_sizes_columns columns;
    const clx_sizes_use use = {by_mass ? CLX_SIZE_COLUMN_MASS : CLX_SIZE_COLUMN_NUMBER,
                               by_mass ? "take list:FILE" : "take masses:FILE", "",
                               by_mass ? "give the file without masses:"
                                       : "give the file without list:"};
    CLX_TRY(clx_sizes_read_for(&use, path, "", "", &columns, &sizes));
    status = clast_grading_of_sizes(&sizes, by_mass, &made);
    if (status != CLAST_OK) {
        clx_fail_prefix("%s", path);
        goto done;
    }
    const clast_grading_list list = clx_sizes_list(&sizes, &columns);
    CLX_TRY(clx_grading_note_list(&list, made));
    *grading = made;
    made = NULL;
done:
    clast_grading_destroy(made);
    clast_sizes_free(&sizes);
    return status;
}

static bool is_case(const char *text)
{
    for (int32_t i = 0; clast_curve_case_at(i) != NULL; ++i) {
        if (strcmp(clast_curve_case_at(i)->name, text) == 0) {
            return true;
        }
    }
    return false;
}

/// A text that begins like a number and is no file's name.
static bool is_one_size(const char *text)
{
    char *end = NULL;
    (void)clx_number_read(text, &end);
    return end != text && strchr(end, '.') == NULL && strchr(end, '/') == NULL;
}

static clast_status load_curve(const char *text, clast_grading_spread spread,
                               clast_grading_count count, clast_curve *curve,
                               clast_grading **grading)
{
    clast_status status = CLAST_OK;
    clast_curve made = {0};
    CLX_TRY(is_case(text) ? clast_curve_named(text, &made) : clast_curve_read(text, &made));
    CLX_TRY(clast_grading_of_curve(&made, spread, count, grading));
    *curve = made;
    made = (clast_curve){0};
done:
    clast_curve_free(&made);
    return status;
}

clast_status clast_grading_load(const char *text, clast_grading_spread spread,
                                clast_grading_count count, clast_curve *curve,
                                clast_grading **grading)
{
    CLX_ARGUMENTS(text, curve, grading);
    clast_status status = CLAST_OK;
    double size = 0.0;
    CLX_CHECK((unsigned)spread <= CLAST_SPREAD_MEANS && (unsigned)count <= CLAST_COUNT_EXACT,
              CLAST_E_ARGUMENT, "%s: there is no spread %d, or no count %d", __func__, (int)spread,
              (int)count);
    if (strncmp(text, "uniform:", 8) == 0 || strncmp(text, "lognormal:", 10) == 0) {
        return load_law(text, text[0] == 'l', grading);
    }
    if (strncmp(text, "list:", 5) == 0) {
        return load_list(text + 5, false, grading);
    }
    if (strncmp(text, "masses:", 7) == 0) {
        return load_list(text + 7, true, grading);
    }
    if (!is_case(text) && is_one_size(text)) {
        CLX_TRY(clast_unit_parse_asked(text, "m", &size));
        return clast_grading_uniform(size, size, grading);
    }
    CLX_TRY(load_curve(text, spread, count, curve, grading));
done:
    if (status == CLAST_E_IO) {
        clx_fail_prefix("neither a published curve (U1, U3, U5, U7, B30, B50, B70), uniform:, "
                        "lognormal:, list:, masses: nor a size, so a file");
    }
    return status;
}
