// Which columns of a table are spheres, and the spheres in them.
#include "io/spheres_table.h"

#include "base/column_unit.h"
#include "base/status.h"
#include <clast/field.h>
#include <clast/form.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

enum { RADIUS = 3, N_COLUMN = 4 };

/// x, y, z and radius: where they are.
typedef struct {
    const clast_column *column[N_COLUMN];
    bool is_diameter;
    const clast_column *id;
} columns;

static const char *const names[] = {"x", "y", "z", "radius", "r", "diameter", "d"};
enum { N_NAME = sizeof names / sizeof names[0], FIRST_DIAMETER = 5 };

/// Whether the unit behind "_" is one: of lengths also one that is then converted or refused.
static bool is_unit(const char *column, const char *behind, const char *si_unit)
{
    char unit[CLX_COLUMN_UNIT];
    double factor = 0.0;
    return clast_unit_factor(behind, si_unit, &factor) == CLAST_OK ||
           (strcmp(si_unit, "m") == 0 && clx_column_says_length(column, unit) &&
            strcmp(behind, unit) == 0);
}

bool clx_column_is(const char *column, const char *wanted, const char *si_unit)
{
    const size_t n = strlen(wanted);
    return strncasecmp(column, wanted, n) == 0 &&
           (column[n] == '_' ? is_unit(column, column + n + 1, si_unit)
                             : strchr(" ([", column[n]) != NULL);
}

/// Whether its unit, or none, is one that lengths are read in.
static bool is_read(const clast_column *column, bool takes_phi)
{
    clx_length_unit length;
    return clx_column_length(column, takes_phi, &length) == CLAST_OK;
}

const clast_column *clx_column_find(const clast_table *table, const char *name)
{
    const int32_t bare = clast_table_find(table, name);
    const clast_column *found = bare >= 0 ? &table->column[bare] : NULL;
    for (int32_t c = 0; c < table->n_column && bare < 0; ++c) {
        const clast_column *column = &table->column[c];
        if (clx_column_is(column->name, name, "m") &&
            (found == NULL || (!is_read(found, false) && is_read(column, false)))) {
            found = column; // x_mm rather than an x_ft before it
        }
    }
    return found;
}

bool clx_points_are_named(const clast_table *table)
{
    return clx_column_find(table, "x") != NULL && clx_column_find(table, "y") != NULL &&
           clx_column_find(table, "z") != NULL && !clast_form_set_named(table);
}

/// A column under the k-th name; the first of a kind counts, and a radius before a diameter.
static void read_column(columns *c, int name, const clast_column *column)
{
    const int at = name < RADIUS ? name : RADIUS;
    if (c->column[at] == NULL || (at == RADIUS && c->is_diameter && name < FIRST_DIAMETER)) {
        c->column[at] = column;
        c->is_diameter = name >= FIRST_DIAMETER;
    }
}

/// Columns in units that are read, or in others.
static void read_named(const clast_table *table, bool are_read, columns *c)
{
    for (int name = 0; name < N_NAME; ++name) {
        for (int32_t i = 0; i < table->n_column; ++i) {
            const clast_column *column = &table->column[i];
            if (clx_column_is(column->name, names[name], "m") &&
                is_read(column, name >= RADIUS) == are_read) {
                read_column(c, name, column);
            }
        }
    }
}

/// d_mm rather than an r_ft beside it.
static void find_names(const clast_table *table, columns *c)
{
    columns other = {.is_diameter = false};
    read_named(table, true, c);
    read_named(table, false, &other);
    if (c->column[RADIUS] == NULL) {
        c->is_diameter = other.is_diameter;
    }
    for (int32_t i = 0; i < table->n_column && c->id == NULL; ++i) {
        c->id = strcasecmp(table->column[i].name, "id") == 0 ? &table->column[i] : NULL;
    }
    for (int k = 0; k < N_COLUMN; ++k) {
        c->column[k] = c->column[k] != NULL ? c->column[k] : other.column[k];
    }
}

bool clx_spheres_are_named(const clast_table *table)
{
    columns c = {.is_diameter = false};
    find_names(table, &c);
    return c.column[0] != NULL && c.column[1] != NULL && c.column[2] != NULL &&
           c.column[RADIUS] != NULL && !clast_form_set_named(table);
}

/// What a table of unnamed columns is asked for, in the words of who asks.
typedef struct {
    char columns[48], diameter[48], of_all[64];
} words;

static words words_of(const clx_spheres_wanted *wanted)
{
    words w = {"a first line of names:", "a first line of names", ""};
    if (wanted != NULL && wanted->prefix != NULL) {
        (void)snprintf(w.columns, sizeof w.columns, "%scolumns", wanted->prefix);
        (void)snprintf(w.diameter, sizeof w.diameter, "%sdiameter", wanted->prefix);
        (void)snprintf(w.of_all, sizeof w.of_all, ", or all one %s", w.diameter);
    }
    return w;
}

/// Which of x, y, z, radius and id a word of a list or the name of a column is; -1: another.
static int place_of(const char *word, size_t length)
{
    int place = length == 2 && strncasecmp(word, "id", length) == 0 ? N_COLUMN : -1;
    for (int k = 0; k < N_NAME && place < 0; ++k) {
        if (strlen(names[k]) == length && strncasecmp(word, names[k], length) == 0) {
            place = k < RADIUS ? k : RADIUS;
        }
    }
    return place;
}

static int place_of_column(const char *name)
{
    int place = place_of(name, strlen(name));
    for (int k = 0; k < N_NAME && place < 0; ++k) {
        if (clx_column_is(name, names[k], "m")) {
            place = k < RADIUS ? k : RADIUS;
        }
    }
    return place;
}

/// A list gives each column there its name, and none another than its own.
static clast_status check_list(const clast_table *table, const clx_spheres_wanted *wanted)
{
    clast_status status = CLAST_OK;
    const char *list = wanted->options.columns;
    const words w = words_of(wanted);
    char there[256] = "";
    int32_t n = 0;
    for (int32_t i = 0; i < table->n_column && strlen(there) + 1 < sizeof there; ++i) {
        const size_t used = strlen(there);
        (void)snprintf(there + used, sizeof there - used, "%s%s", i > 0 ? ", " : "",
                       table->column[i].name);
    }
    for (const char *at = list; *at != '\0'; ++n) {
        const int length = (int)strcspn(at, ",");
        const char *own = n < table->n_column ? table->column[n].name : "";
        const int place = place_of(at, (size_t)length);
        const int own_place = place_of_column(own);
        CLX_CHECK(place < 0 || own_place < 0 || place == own_place, CLAST_E_CONFIG,
                  "%s '%s' calls column %d %.*s, which is named %s; columns are named in their "
                  "order, with - for one that is passed over (here are %s)",
                  w.columns, list, n + 1, length, at, own, there);
        at += length + (at[length] == ',');
    }
    CLX_CHECK(n == table->n_column || (n < table->n_column && wanted->takes_few), CLAST_E_CONFIG,
              "%s '%s' names %d of %d columns (%s); name all in their order, with - for one that "
              "is passed over",
              w.columns, list, n, table->n_column, there);
done:
    return status;
}

/// Columns in the order of a list such as "id,x,y,z,d".
static clast_status read_list(const clast_table *table, const clx_spheres_wanted *wanted,
                              columns *c)
{
    clast_status status = CLAST_OK;
    const char *list = wanted->options.columns;
    const words w = words_of(wanted);
    int32_t n = 0;
    for (const char *at = list; *at != '\0' && n < table->n_column; ++n) {
        const size_t length = strcspn(at, ",");
        for (int name = 0; name < N_NAME; ++name) {
            if (strlen(names[name]) == length && strncasecmp(at, names[name], length) == 0) {
                read_column(c, name, &table->column[n]);
            }
        }
        if (place_of(at, length) == N_COLUMN) {
            c->id = &table->column[n];
        }
        at += length + (at[length] == ',');
    }
    CLX_CHECK(c->column[0] != NULL && c->column[1] != NULL && c->column[2] != NULL, CLAST_E_CONFIG,
              "%s '%s' does not name x, y and z; write id,x,y,z,d or x,y,z,r", w.columns, list);
    CLX_TRY(check_list(table, wanted));
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
static clast_status read_places(const clast_table *table, const clx_spheres_wanted *wanted,
                                columns *c)
{
    clast_status status = CLAST_OK;
    const words w = words_of(wanted);
    const clast_column *number[5] = {NULL};
    int n = 0;
    for (int32_t i = 0; i < table->n_column; ++i) {
        if (table->column[i].number != NULL) {
            CLX_CHECK(n < 5 || wanted == NULL, CLAST_E_FORMAT,
                      "more than five columns without names of spheres; say which they are with "
                      "%s id,x,y,z,d",
                      w.columns);
            if (n < 5) {
                number[n] = &table->column[i];
            }
            ++n;
        }
    }
    const bool has_id = wanted != NULL && n >= 4 && are_ids(number[0]->number, table->n_row);
    CLX_CHECK(
        !(has_id && n == 4 && wanted->options.diameter <= 0.0), CLAST_E_FORMAT,
        "four columns of which the first counts the rows: for id x y z give %s, for x y z r give "
        "%s x,y,z,r",
        w.diameter, w.columns);
    CLX_CHECK(n != 5 || has_id || wanted == NULL, CLAST_E_FORMAT,
              "five columns without names, the first is no id; say which they are with %s x,y,z,r",
              w.columns);
    for (int k = 0; k < N_COLUMN && n >= 3; ++k) {
        c->column[k] = has_id + k < 5 && has_id + k < n ? number[has_id + k] : NULL;
    }
    c->id = has_id ? number[0] : NULL;
done:
    return status;
}

static clast_status check_columns(const columns *c, const clx_spheres_wanted *wanted)
{
    clast_status status = CLAST_OK;
    const bool has_diameter = wanted != NULL && wanted->options.diameter > 0.0;
    const words w = words_of(wanted);
    for (int k = 0; k < N_COLUMN; ++k) {
        const clast_column *column = c->column[k];
        CLX_CHECK(column == NULL || column->number != NULL, CLAST_E_FORMAT,
                  "column %s of the spheres holds texts", column->name);
        CLX_CHECK(column != NULL || (k == RADIUS && has_diameter), CLAST_E_FORMAT,
                  "no column of numbers named %s%s; spheres need x, y, z and radius or diameter%s",
                  names[k], k == RADIUS ? ", r, diameter or d" : "", w.of_all);
    }
done:
    return status;
}

/// The units of the columns: all or none of them say one, and none says another quantity.
static clast_status find_units(const columns *c, clx_length_unit length[N_COLUMN], bool *says_unit)
{
    clast_status status = CLAST_OK;
    int n_unit = 0;
    int n = 0;
    for (int k = 0; k < N_COLUMN; ++k) {
        length[k] = (clx_length_unit){.metre = 0.0};
        if (c->column[k] != NULL) {
            CLX_TRY(clx_column_length(c->column[k], k == RADIUS, &length[k]));
            ++n;
            n_unit += length[k].metre > 0.0;
        }
    }
    CLX_CHECK(
        n_unit == 0 || n_unit == n, CLAST_E_FORMAT,
        "%d of the %d columns x, y, z, radius say their unit of length; give all of them one, "
        "or none",
        n_unit, n);
    *says_unit = n_unit > 0;
done:
    return status;
}

static clast_status fill(const columns *c, const clx_length_unit length[N_COLUMN], double diameter,
                         clast_spheres *made)
{
    clast_status status = CLAST_OK;
    for (int32_t i = 0; i < made->n; ++i) {
        for (int k = 0; k < 3 && c->column[k] != NULL; ++k) { // NULL only for the analyser
            made->centre[i][k] = length[k].metre * c->column[k]->number[i];
        }
        made->radius[i] = 0.5 * diameter;
        if (diameter <= 0.0 && c->column[RADIUS] != NULL) {
            made->radius[i] = (c->is_diameter ? 0.5 : 1.0) * length[RADIUS].metre *
                              clx_length_value(&length[RADIUS], c->column[RADIUS]->number[i]);
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

bool clx_spheres_has_list(const clx_spheres_wanted *wanted)
{
    return wanted != NULL && wanted->options.columns != NULL && wanted->options.columns[0] != '\0';
}

/// Which columns are the spheres'.
static clast_status find_columns(const clast_table *table, const clx_spheres_wanted *wanted,
                                 columns *c)
{
    clast_status status = CLAST_OK;
    if (clx_spheres_has_list(wanted)) {
        CLX_TRY(read_list(table, wanted, c));
    } else {
        find_names(table, c);
        if (c->column[0] == NULL && c->column[1] == NULL && c->column[2] == NULL) {
            *c = (columns){.is_diameter = false};
            CLX_TRY(read_places(table, wanted, c));
        }
    }
    CLX_TRY(check_columns(c, wanted));
done:
    return status;
}

/// The spheres, in metres where in_metres is not NULL and the columns say their unit; else in the
/// unit of x.
static clast_status make_spheres(const clast_table *table, const clx_spheres_wanted *wanted,
                                 const columns *c, bool *in_metres, clast_spheres *spheres)
{
    clast_status status = CLAST_OK;
    clast_spheres made = {0};
    clx_length_unit length[N_COLUMN];
    double diameter = wanted != NULL ? wanted->options.diameter : 0.0;
    bool says_unit = false;
    CLX_TRY(find_units(c, length, &says_unit));
    for (int k = 0; k < N_COLUMN; ++k) {
        length[k].metre = length[k].metre > 0.0 ? length[k].metre : 1.0;
    }
    if (in_metres != NULL) {
        *in_metres = says_unit;
        diameter /= wanted != NULL && wanted->metre > 0.0 && !says_unit ? wanted->metre : 1.0;
    } else { // numbers as they are; of several units in that of x
        for (int k = N_COLUMN - 1; k >= 0; --k) {
            length[k].metre /= length[0].metre;
        }
    }
    CLX_CHECK(table->n_row > 0 && table->n_row <= INT32_MAX, CLAST_E_FORMAT, "%lld spheres",
              (long long)table->n_row);
    CLX_TRY(clast_spheres_alloc((int32_t)table->n_row, &made));
    CLX_TRY(fill(c, length, diameter, &made));
    *spheres = made;
    made = (clast_spheres){0};
done:
    clast_spheres_free(&made);
    return status;
}

clast_status clx_spheres_of_columns(const clast_table *table, const clx_spheres_wanted *wanted,
                                    clast_spheres *spheres, char unit[16])
{
    clast_status status = CLAST_OK;
    columns c = {.is_diameter = false};
    bool in_metres = false;
    CLX_TRY(find_columns(table, wanted, &c));
    CLX_TRY(make_spheres(table, wanted, &c, &in_metres, spheres));
    unit[0] = '\0';
    if (in_metres && c.column[0] != NULL) {
        clx_length_unit length;
        CLX_TRY(clx_column_length(c.column[0], false, &length));
        (void)snprintf(unit, 16, "%s", length.unit);
    }
done:
    return status;
}

clast_status clx_spheres_check_list(const clast_table *table, const clx_spheres_wanted *wanted)
{
    columns c = {.is_diameter = false};
    return clx_spheres_has_list(wanted) ? read_list(table, wanted, &c) : CLAST_OK;
}

const double *clx_spheres_ids(const clast_table *table, const clx_spheres_wanted *wanted)
{
    columns c = {.is_diameter = false};
    const clast_status status = clx_spheres_has_list(wanted) ? read_list(table, wanted, &c)
                                                             : find_columns(table, wanted, &c);
    return status == CLAST_OK && c.id != NULL ? c.id->number : NULL;
}

clast_status clx_spheres_of_table(const clast_table *table, const clast_packing_options *options,
                                  clast_spheres *spheres, double *unit_m, bool *mixes)
{
    clast_status status = CLAST_OK;
    columns c = {.is_diameter = false};
    bool in_metres = false;
    const clx_spheres_wanted wanted = {.options =
                                           options != NULL ? *options : (clast_packing_options){0}};
    const clx_spheres_wanted *asked = options != NULL ? &wanted : NULL;
    CLX_TRY(find_columns(table, asked, &c));
    CLX_TRY(make_spheres(table, asked, &c, unit_m != NULL ? &in_metres : NULL, spheres));
    if (unit_m != NULL && mixes != NULL) {
        clx_length_unit length[N_COLUMN];
        CLX_TRY(find_units(&c, length, &in_metres));
        *mixes = false;
        for (int k = 1; k < N_COLUMN; ++k) {
            *mixes = *mixes || (c.column[k] != NULL && length[k].metre != length[0].metre);
        }
        *unit_m = !in_metres ? 0.0 : *mixes ? 1.0 : length[0].metre;
    }
done:
    return status;
}
