// Which columns of a table are spheres, and the spheres in them.
#include "io/spheres_table.h"

#include "base/status.h"
#include <clast/field.h>
#include <math.h>
#include <string.h>
#include <strings.h>

enum { RADIUS = 3, N_COLUMN = 4 };

/// x, y, z and radius: where they are, and what one is in metres where the table says so.
typedef struct {
    const clast_column *column[N_COLUMN];
    bool is_diameter;
} columns;

static const char *const names[] = {"x", "y", "z", "radius", "r", "diameter", "d"};
enum { N_NAME = sizeof names / sizeof names[0], FIRST_DIAMETER = 5 };

/// True for "x", "x_um", "x (um)", "x [um]" when the wanted name is "x"; "d_agg" is no "d".
static bool is_named(const char *column, const char *wanted)
{
    const size_t n = strlen(wanted);
    double factor = 0.0;
    return strncasecmp(column, wanted, n) == 0 &&
           (column[n] == '_' ? clast_unit_factor(column + n + 1, "m", &factor) == CLAST_OK
                             : strchr(" ([", column[n]) != NULL);
}

/// A column under the k-th name; the first of a kind counts, and a radius before a diameter.
static void take_column(columns *c, int name, const clast_column *column)
{
    const int at = name < RADIUS ? name : RADIUS;
    if (c->column[at] == NULL || (at == RADIUS && c->is_diameter && name < FIRST_DIAMETER)) {
        c->column[at] = column;
        c->is_diameter = name >= FIRST_DIAMETER;
    }
}

static void find_names(const clast_table *table, columns *c)
{
    for (int name = 0; name < N_NAME; ++name) {
        for (int32_t i = 0; i < table->n_column; ++i) {
            if (is_named(table->column[i].name, names[name])) {
                take_column(c, name, &table->column[i]);
            }
        }
    }
}

bool clx_spheres_are_named(const clast_table *table)
{
    columns c = {{NULL}, false};
    find_names(table, &c);
    return c.column[0] != NULL && c.column[1] != NULL && c.column[2] != NULL &&
           c.column[RADIUS] != NULL;
}

/// Columns in the order of a list such as "id,x,y,z,d".
static clast_status take_list(const clast_table *table, const char *list, columns *c)
{
    clast_status status = CLAST_OK;
    int32_t n = 0;
    for (const char *at = list; *at != '\0'; ++n) {
        const size_t length = strcspn(at, ",");
        CLX_CHECK(n < table->n_column, CLAST_E_CONFIG, "columns: '%s' names more than the %d there",
                  list, table->n_column);
        for (int name = 0; name < N_NAME; ++name) {
            if (strlen(names[name]) == length && strncasecmp(at, names[name], length) == 0) {
                take_column(c, name, &table->column[n]);
            }
        }
        at += length + (at[length] == ',');
    }
    CLX_CHECK(c->column[0] != NULL && c->column[1] != NULL && c->column[2] != NULL, CLAST_E_CONFIG,
              "columns: '%s' does not name x, y and z; write id,x,y,z,d or x,y,z,r", list);
done:
    return status;
}

/// The whole numbers from 0 or 1 on, in any order.
static bool are_ids(const double *value, int64_t n)
{
    double least = INFINITY;
    double greatest = -INFINITY;
    double sum = 0.0;
    for (int64_t i = 0; i < n; ++i) {
        if (value[i] != floor(value[i])) {
            return false;
        }
        least = fmin(least, value[i]);
        greatest = fmax(greatest, value[i]);
        sum += value[i];
    }
    return (least == 0.0 || least == 1.0) && greatest - least == (double)(n - 1) &&
           sum == 0.5 * (least + greatest) * (double)n;
}

/// Columns without names: x y z r, id x y z or id x y z r; texts (elements) are passed over.
static clast_status take_places(const clast_table *table, const clast_packing_options *options,
                                columns *c)
{
    clast_status status = CLAST_OK;
    const clast_column *number[5] = {NULL};
    int n = 0;
    for (int32_t i = 0; i < table->n_column; ++i) {
        if (table->column[i].number != NULL) {
            CLX_CHECK(n < 5 || options == NULL, CLAST_E_FORMAT,
                      "more than five columns without names of spheres; say which they are with "
                      "--columns, such as id,x,y,z,d");
            if (n < 5) {
                number[n] = &table->column[i];
            }
            ++n;
        }
    }
    const bool has_id = options != NULL && n >= 4 && are_ids(number[0]->number, table->n_row);
    CLX_CHECK(
        !(has_id && n == 4 && options->diameter <= 0.0), CLAST_E_FORMAT,
        "four columns of which the first counts the rows: for id x y z give --diameter, for x "
        "y z r write --columns x,y,z,r");
    CLX_CHECK(n != 5 || has_id || options == NULL, CLAST_E_FORMAT,
              "five columns without names, the first is no id; say which they are with --columns, "
              "such as x,y,z,r");
    for (int k = 0; k < N_COLUMN && n >= 3; ++k) {
        c->column[k] = has_id + k < 5 && has_id + k < n ? number[has_id + k] : NULL;
    }
done:
    return status;
}

static clast_status check_columns(const columns *c, bool has_diameter)
{
    clast_status status = CLAST_OK;
    for (int k = 0; k < N_COLUMN; ++k) {
        const clast_column *column = c->column[k];
        CLX_CHECK(column == NULL || column->number != NULL, CLAST_E_FORMAT,
                  "column %s of the spheres holds texts", column->name);
        CLX_CHECK(column != NULL || (k == RADIUS && has_diameter), CLAST_E_FORMAT,
                  "no column of numbers named %s%s; spheres need x, y, z and radius or diameter",
                  names[k], k == RADIUS ? ", r, diameter or d" : "");
    }
done:
    return status;
}

/// Metres in the units of the columns: all or none of them say one.
static clast_status find_factors(const columns *c, double factor[N_COLUMN], bool *in_metres)
{
    clast_status status = CLAST_OK;
    int n_unit = 0;
    int n = 0;
    for (int k = 0; k < N_COLUMN; ++k) {
        factor[k] = 1.0;
        if (c->column[k] != NULL) {
            const char *unit = c->column[k]->unit;
            ++n;
            n_unit += strcmp(unit, "-") != 0 && unit[0] != '\0' &&
                      clast_unit_factor(unit, "m", &factor[k]) == CLAST_OK;
        }
    }
    CLX_CHECK(
        n_unit == 0 || n_unit == n, CLAST_E_FORMAT,
        "%d of the %d columns x, y, z, radius say their unit of length; give all of them one, "
        "or none",
        n_unit, n);
    *in_metres = n_unit > 0;
done:
    return status;
}

static clast_status fill(const columns *c, const double factor[N_COLUMN], double diameter,
                         clast_spheres *made)
{
    clast_status status = CLAST_OK;
    for (int32_t i = 0; i < made->n; ++i) {
        for (int k = 0; k < 3 && c->column[k] != NULL; ++k) { // NULL only for the analyser
            made->centre[i][k] = factor[k] * c->column[k]->number[i];
        }
        made->radius[i] = 0.5 * diameter;
        if (diameter <= 0.0 && c->column[RADIUS] != NULL) {
            made->radius[i] =
                (c->is_diameter ? 0.5 : 1.0) * factor[RADIUS] * c->column[RADIUS]->number[i];
        }
        CLX_CHECK(isfinite(made->centre[i][0]) && isfinite(made->centre[i][1]) &&
                      isfinite(made->centre[i][2]) && isfinite(made->radius[i]) &&
                      made->radius[i] > 0.0,
                  CLAST_E_FORMAT, "sphere %d of %d is (%g, %g, %g) with radius %g", i + 1, made->n,
                  made->centre[i][0], made->centre[i][1], made->centre[i][2], made->radius[i]);
    }
done:
    return status;
}

clast_status clx_spheres_of_table(const clast_table *table, const clast_packing_options *options,
                                  clast_spheres *spheres, double *unit_m)
{
    clast_status status = CLAST_OK;
    clast_spheres made = {0};
    columns c = {{NULL}, false};
    double factor[N_COLUMN] = {1.0, 1.0, 1.0, 1.0};
    bool in_metres = false;
    const double diameter = options != NULL ? options->diameter : 0.0;
    if (options != NULL && options->columns != NULL && options->columns[0] != '\0') {
        CLX_TRY(take_list(table, options->columns, &c));
    } else {
        find_names(table, &c);
        if (c.column[0] == NULL && c.column[1] == NULL && c.column[2] == NULL) {
            c = (columns){{NULL}, false};
            CLX_TRY(take_places(table, options, &c));
        }
    }
    CLX_TRY(check_columns(&c, diameter > 0.0));
    if (unit_m != NULL) {
        CLX_TRY(find_factors(&c, factor, &in_metres));
    }
    CLX_CHECK(table->n_row > 0 && table->n_row <= INT32_MAX, CLAST_E_FORMAT, "%lld spheres",
              (long long)table->n_row);
    CLX_TRY(clast_spheres_alloc((int32_t)table->n_row, &made));
    CLX_TRY(fill(&c, factor, diameter, &made));
    if (unit_m != NULL) {
        *unit_m = in_metres ? 1.0 : 0.0;
    }
    *spheres = made;
    made = (clast_spheres){0};
done:
    clast_spheres_free(&made);
    return status;
}
