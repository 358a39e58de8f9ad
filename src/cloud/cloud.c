// Point clouds as plain arrays: life cycle, and out of tables.
#include <clast/cloud.h>

#include "base/alloc.h"
#include "base/column_unit.h"
#include "base/status.h"
#include "cloud/columns.h"
#include "cloud/contract.h"
#include "math/sort.h"
#include <clast/machine.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

void clast_cloud_free(clast_cloud *cloud)
{
    if (cloud == NULL) {
        return;
    }
    CLX_FREE(cloud->x, cloud->radius, cloud->mass, cloud->weight, cloud->velocity, cloud->variable);
    *cloud = (clast_cloud){0};
}

clast_status clast_cloud_alloc(int64_t n, int32_t dimension, clast_cloud *cloud)
{
    CLX_ARGUMENTS(cloud);
    if (dimension < 1 || dimension > 3) {
        return clx_fail(CLAST_E_ARGUMENT, "a cloud has 1, 2 or 3 dimensions, not %d", dimension);
    }
    if (cloud == NULL || n < 0) {
        return clx_fail(CLAST_E_ARGUMENT, "clast_cloud_alloc: %lld points, cloud %s", (long long)n,
                        cloud == NULL ? "NULL" : "given");
    }
    clast_cloud made = {.n = n, .dimension = dimension};
    const clast_status status = clx_alloc(&made.x, n, (size_t)dimension * sizeof *made.x);
    if (status == CLAST_OK) {
        *cloud = made;
    }
    return status;
}

enum { NAMES_SIZE = 512 };

/// A list's items joined by commas.
static void join(const clast_text_list *list, char text[NAMES_SIZE])
{
    text[0] = '\0';
    for (int32_t k = 0; k < list->n; ++k) {
        const size_t used = strlen(text);
        (void)snprintf(text + used, NAMES_SIZE - used, "%s%s", used > 0 ? "," : "", list->item[k]);
    }
}

clast_status clast_cloud_column(const clast_table *table, const char *name, double **column)
{
    CLX_ARGUMENTS(table, column);
    CLX_WHOLE(table, table);
    clast_status status = CLAST_OK;
    double *found = NULL;
    if (name != NULL && name[0] != '\0') {
        found = clast_table_numbers(table, name);
        if (found == NULL) {
            return clx_cloud_no_column(table, name);
        }
    }
    *column = found;
    return status;
}

/// Whether a column says a unit of this dimension, which is copied then.
static bool has_unit(const clast_column *c, const char *si_unit, char unit[CLX_COLUMN_UNIT])
{
    double factor = 0.0;
    return clx_column_factor(c, si_unit, unit, &factor) == CLAST_OK && factor > 0.0;
}

/// Whether a column holds lengths of this axis by its name and unit: "x_mm", "x (mm)", "x [mm]".
static bool is_length_of(const clast_column *c, const char *axis)
{
    char unit[CLX_COLUMN_UNIT];
    const size_t n = strlen(axis);
    const char *rest = c->name + n;
    if (strncmp(c->name, axis, n) != 0 || strchr("_ ([", *rest) == NULL ||
        !has_unit(c, "m", unit)) {
        return false;
    }
    rest += strspn(rest, "_ ([");
    return strncmp(rest, unit, strlen(unit)) == 0 &&
           rest[strlen(unit) + strspn(rest + strlen(unit), " )]")] == '\0';
}

/// The column that a default coordinate is in: of its very name, else the only one that is its with
/// a unit of length, as the tables have that clast writes. The name itself where there is none.
static const char *default_column(const clast_table *table, const char *axis)
{
    const char *found = NULL;
    if (clast_table_find(table, axis) >= 0) {
        return axis;
    }
    for (int32_t k = 0; k < table->n_column; ++k) {
        if (is_length_of(&table->column[k], axis)) {
            if (found != NULL) {
                return axis; // x_mm and x_um: which is not guessed
            }
            found = table->column[k].name;
        }
    }
    return found != NULL ? found : axis;
}

/// Up to three columns by name; *d becomes their number.
static clast_status find_columns(const clast_table *table, const clast_text_list *list,
                                 double *column[3], int32_t *d)
{
    char names[NAMES_SIZE];
    clast_status status = CLAST_OK;
    join(list, names);
    const bool is_default = strcmp(names, "x,y,z") == 0;
    char *rest = names;
    *d = 0;
    for (char *name = strtok_r(rest, ",", &rest); name != NULL; name = strtok_r(rest, ",", &rest)) {
        const char *const own = is_default ? default_column(table, name) : name;
        if (is_default && *d > 0 && clast_table_find(table, own) < 0) {
            break;
        }
        CLX_CHECK(*d < 3, CLAST_E_FORMAT, "%s: more than three columns, from '%s' on", table->name,
                  name);
        CLX_TRY(clast_cloud_column(table, own, &column[*d]));
        CLAST_ASSERT(column[*d] != NULL); // a word of strtok_r is never empty
        ++*d;
    }
done:
    return status;
}

/// The column that holds these numbers.
static const clast_column *column_of(const clast_table *table, const double *number)
{
    int32_t k = 0;
    while (k + 1 < table->n_column && table->column[k].number != number) {
        ++k;
    }
    return &table->column[k];
}

/// Whether a column holds sizes in phi, minus the binary logarithm of millimetres.
static bool is_phi(const clast_column *c, const char *si_unit)
{
    clx_length_unit length;
    return strcmp(si_unit, "m") == 0 && clx_column_length(c, true, &length) == CLAST_OK &&
           length.is_phi;
}

/// Factor to SI by the unit that a column says; 1 where it says none of this dimension.
static clast_status own_factor(const clast_table *table, const clast_column *c, const char *si_unit,
                               char unit[CLX_COLUMN_UNIT], double *factor)
{
    clast_status status = CLAST_OK;
    double found = 0.0;
    if (strcmp(si_unit, "-") != 0) {
        status = clx_column_factor(c, si_unit, unit, &found);
    }
    if (status == CLAST_OK) {
        *factor = found > 0.0 ? found : 1.0;
    } else {
        clx_fail_prefix("%s%s", table->name,
                        strcmp(si_unit, "m") == 0 ? " (unit says that of coordinates)" : "");
    }
    return status;
}

clast_status clast_cloud_column_si(const clast_table *table, const char *name, const char *si_unit,
                                   double *value)
{
    CLX_ARGUMENTS(table, name, si_unit, value);
    CLX_WHOLE(table, table);
    clast_status status = CLAST_OK;
    double *number = NULL;
    double factor = 1.0;
    char unit[CLX_COLUMN_UNIT] = "-";
    CLX_TRY(clast_cloud_column(table, name, &number));
    if (number != NULL) {
        CLX_TRY(own_factor(table, column_of(table, number), si_unit, unit, &factor));
    }
    const double zero = strcmp(si_unit, "K") == 0 && clx_unit_is_celsius(unit) ? 273.15 : 0.0;
    for (int64_t i = 0; i < table->n_row && number != NULL; ++i) {
        value[i] = value[i] * factor + zero;
    }
done:
    return status;
}

/// Factor to SI of a column of this dimension: by its own unit, else by the one asked for.
static clast_status factor_of(const clast_table *table, const double *column, const char *si_unit,
                              const char *asked, double *factor)
{
    clast_status status = CLAST_OK;
    const clast_column *c = column_of(table, column);
    char unit[CLX_COLUMN_UNIT];
    double own = 1.0;
    if (asked == NULL || asked[0] == '\0') {
        return own_factor(table, c, si_unit, unit, factor);
    }
    CLX_TRY(clast_unit_factor(asked, si_unit, factor));
    if (has_unit(c, si_unit, unit)) {
        CLX_TRY(clast_unit_factor(unit, si_unit, &own));
        CLX_CHECK(own == *factor, CLAST_E_CONFIG,
                  "%s: column '%s' is in %s by its name or its file, the unit asked for is %s",
                  table->name, c->name, unit, asked);
    }
done:
    return status;
}

/// Refuses columns of which some say their unit and some none.
static clast_status check_mixed(const clast_table *table, double *const column[3], int32_t d,
                                const char *si_unit)
{
    clast_status status = CLAST_OK;
    const clast_column *with = NULL;
    const clast_column *without = NULL;
    char unit[CLX_COLUMN_UNIT] = "";
    for (int32_t j = 0; j < d; ++j) {
        const clast_column *c = column_of(table, column[j]);
        char of_this[CLX_COLUMN_UNIT];
        if (has_unit(c, si_unit, of_this)) {
            with = c;
            memcpy(unit, of_this, sizeof unit);
        } else {
            without = c;
        }
    }
    CLX_CHECK(with == NULL || without == NULL, CLAST_E_FORMAT,
              "%s: column '%s' is in %s by its name, column '%s' says no unit; give all of them "
              "one, or none",
              table->name, with->name, unit, without->name);
done:
    return status;
}

/// d columns as rows, in SI; `asked` is the unit of those that name none.
static clast_status copy_columns(const clast_table *table, double *column[3], int32_t d,
                                 const char *si_unit, const char *asked, double **taken)
{
    clast_status status = CLAST_OK;
    double factor[3] = {1.0, 1.0, 1.0};
    for (int32_t j = 0; j < d; ++j) {
        CLX_TRY(factor_of(table, column[j], si_unit, asked, &factor[j]));
    }
    if (asked == NULL || asked[0] == '\0') {
        CLX_TRY(check_mixed(table, column, d, si_unit));
    }
    CLX_TRY(clx_alloc(taken, table->n_row * d, sizeof **taken));
    for (int32_t j = 0; j < d && column[j] != NULL; ++j) {
        for (int64_t i = 0; i < table->n_row; ++i) {
            (*taken)[i * d + j] = column[j][i] * factor[j];
        }
    }
done:
    return status;
}

/// Sizes in phi as lengths [m], as clast_unit_parse reads one.
static clast_status convert_phi(const double *phi, int64_t n, double **taken)
{
    const clast_status status = clx_alloc(taken, n, sizeof **taken);
    for (int64_t i = 0; i < n && status == CLAST_OK; ++i) {
        (*taken)[i] = 1e-3 * exp2(-phi[i]);
    }
    return status;
}

static clast_status read_property(const clast_table *table, const char *name, const char *si_unit,
                                  double share, double **taken)
{
    clast_status status = CLAST_OK;
    double *column[3] = {NULL};
    CLX_TRY(clast_cloud_column(table, name, &column[0]));
    if (column[0] != NULL) {
        CLX_TRY(is_phi(column_of(table, column[0]), si_unit)
                    ? convert_phi(column[0], table->n_row, taken)
                    : copy_columns(table, column, 1, si_unit, NULL, taken));
        for (int64_t i = 0; i < table->n_row; ++i) {
            (*taken)[i] *= share;
        }
    }
done:
    return status;
}

static bool is_named(const char *name)
{
    return name != NULL && name[0] != '\0';
}

clast_status clast_cloud_from_table(const clast_table *table, const clast_cloud_columns *columns,
                                    clast_cloud *cloud)
{
    CLX_ARGUMENTS(table, columns, cloud);
    CLX_WHOLE(table, table);
    CLX_GUARD(clx_texts_given(__func__, "columns", &columns->columns));
    CLX_GUARD(clx_texts_given(__func__, "velocity_columns", &columns->velocity_columns));
    clx_times times = {.n = 0};
    clx_times_add(table, columns, &times);
    CLX_GUARD(clx_times_check(clast_comm_one(), table->name, &times));
    return clx_cloud_from_part(table, columns, cloud);
}

clast_status clx_cloud_from_part(const clast_table *table, const clast_cloud_columns *columns,
                                 clast_cloud *cloud)
{
    clast_status status = CLAST_OK;
    clast_cloud made = {.n = table->n_row};
    double *column[3] = {NULL};
    int32_t n_velocity = 0;
    CLX_TRY(find_columns(table, &columns->columns, column, &made.dimension));
    CLX_CHECK(made.dimension >= 1, CLAST_E_FORMAT, "%s: no coordinate column is named",
              table->name);
    CLX_TRY(copy_columns(table, column, made.dimension, "m", columns->unit, &made.x));
    CLX_TRY(find_columns(table, &columns->velocity_columns, column, &n_velocity));
    CLX_CHECK(n_velocity == 0 || n_velocity == made.dimension, CLAST_E_FORMAT,
              "%s: %d velocity columns for %d coordinates", table->name, n_velocity,
              made.dimension);
    if (n_velocity > 0) {
        CLX_TRY(copy_columns(table, column, n_velocity, "m/s", NULL, &made.velocity));
    }
    CLX_CHECK(!is_named(columns->radius_column) || !is_named(columns->diameter_column),
              CLAST_E_CONFIG, "give a radius column or a diameter column, not both");
    CLX_TRY(read_property(table, columns->radius_column, "m", 1.0, &made.radius));
    if (made.radius == NULL) {
        CLX_TRY(read_property(table, columns->diameter_column, "m", 0.5, &made.radius));
    }
    CLX_TRY(read_property(table, columns->mass_column, "kg", 1.0, &made.mass));
    CLX_TRY(read_property(table, columns->weight_column, "-", 1.0, &made.weight));
    CLX_TRY(read_property(table, columns->variable_column, "-", 1.0, &made.variable));
    clx_cloud_find_weight(table, columns, &made);
    *cloud = made;
    made = (clast_cloud){0};
done:
    clast_cloud_free(&made);
    return status;
}
