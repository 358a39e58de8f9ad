// Point clouds as plain arrays: life cycle, and out of tables.
#include <clast/cloud.h>

#include "base/alloc.h"
#include "base/status.h"
#include "cloud/columns.h"
#include "cloud/contract.h"
#include "math/rng.h"
#include "math/sort.h"
#include <stdio.h>
#include <string.h>

void clast_cloud_free(clast_cloud *cloud)
{
    if (cloud == NULL) {
        return;
    }
    clx_free(cloud->x);
    clx_free(cloud->radius);
    clx_free(cloud->mass);
    clx_free(cloud->weight);
    clx_free(cloud->velocity);
    clx_free(cloud->variable);
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

/// Whether a column holds lengths of this axis by its name and unit: "x_mm", "x (mm)", "x [mm]".
static bool is_length_of(const clast_column *c, const char *axis)
{
    const size_t n = strlen(axis);
    double factor = 1.0;
    return strncmp(c->name, axis, n) == 0 && c->name[n] != '\0' &&
           strchr("_ ([", c->name[n]) != NULL && strcmp(c->unit, "-") != 0 &&
           strlen(c->name) <= n + strlen(c->unit) + strlen(" []") &&
           clast_unit_factor(c->unit, "m", &factor) == CLAST_OK;
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

/// Factor to SI of a column of this dimension: by its own unit, else by the one asked for.
static clast_status factor_of(const clast_table *table, const double *column, const char *si_unit,
                              const char *asked, double *factor)
{
    clast_status status = CLAST_OK;
    const bool is_asked = asked != NULL && asked[0] != '\0';
    *factor = 1.0;
    if (is_asked) {
        CLX_TRY(clast_unit_factor(asked, si_unit, factor));
    }
    for (int32_t k = 0; k < table->n_column; ++k) {
        double own = 1.0;
        const clast_column *c = &table->column[k];
        if (c->number != column || strcmp(c->unit, "-") == 0 ||
            clast_unit_factor(c->unit, si_unit, &own) != CLAST_OK) {
            continue; // "x_t" is no time
        }
        CLX_CHECK(!is_asked || own == *factor, CLAST_E_CONFIG,
                  "%s: column '%s' is in %s by its name, the unit asked for is %s", table->name,
                  c->name, c->unit, asked);
        *factor = own;
    }
done:
    return status;
}

static clast_status take_columns(const clast_table *table, double *column[3], int32_t d,
                                 double **taken)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(taken, table->n_row * d, sizeof **taken));
    for (int64_t i = 0; i < table->n_row; ++i) {
        for (int32_t j = 0; j < d && column[j] != NULL; ++j) {
            (*taken)[i * d + j] = column[j][i];
        }
    }
done:
    return status;
}

/// Columns in SI; `asked` is the unit of those that name none.
static clast_status take_lengths(const clast_table *table, double *column[3], int32_t d,
                                 const char *asked, double **taken)
{
    clast_status status = CLAST_OK;
    double factor[3] = {1.0, 1.0, 1.0};
    for (int32_t j = 0; j < d; ++j) {
        CLX_TRY(factor_of(table, column[j], "m", asked, &factor[j]));
    }
    CLX_TRY(take_columns(table, column, d, taken));
    for (int64_t i = 0; i < table->n_row * d; ++i) {
        (*taken)[i] *= factor[i % d];
    }
done:
    return status;
}

static clast_status take_property(const clast_table *table, const char *name, const char *si_unit,
                                  double share, double **taken)
{
    clast_status status = CLAST_OK;
    double *column[3] = {NULL};
    double factor = 1.0;
    CLX_TRY(clast_cloud_column(table, name, &column[0]));
    if (column[0] != NULL) {
        CLX_TRY(factor_of(table, column[0], si_unit, NULL, &factor));
        CLX_TRY(take_columns(table, column, 1, taken));
        for (int64_t i = 0; i < table->n_row; ++i) {
            (*taken)[i] *= share * factor;
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
    clast_status status = CLAST_OK;
    clast_cloud made = {.n = table->n_row};
    double *column[3] = {NULL};
    int32_t n_velocity = 0;
    CLX_TRY(find_columns(table, &columns->columns, column, &made.dimension));
    CLX_CHECK(made.dimension >= 1, CLAST_E_FORMAT, "%s: no coordinate column is named",
              table->name);
    CLX_TRY(take_lengths(table, column, made.dimension, columns->unit, &made.x));
    CLX_TRY(find_columns(table, &columns->velocity_columns, column, &n_velocity));
    CLX_CHECK(n_velocity == 0 || n_velocity == made.dimension, CLAST_E_FORMAT,
              "%s: %d velocity columns for %d coordinates", table->name, n_velocity,
              made.dimension);
    if (n_velocity > 0) {
        CLX_TRY(take_columns(table, column, n_velocity, &made.velocity));
    }
    CLX_CHECK(!is_named(columns->radius_column) || !is_named(columns->diameter_column),
              CLAST_E_CONFIG, "give a radius column or a diameter column, not both");
    CLX_TRY(take_property(table, columns->radius_column, "m", 1.0, &made.radius));
    if (made.radius == NULL) {
        CLX_TRY(take_property(table, columns->diameter_column, "m", 0.5, &made.radius));
    }
    CLX_TRY(take_property(table, columns->mass_column, "kg", 1.0, &made.mass));
    CLX_TRY(take_property(table, columns->weight_column, "-", 1.0, &made.weight));
    CLX_TRY(take_property(table, columns->variable_column, "-", 1.0, &made.variable));
    *cloud = made;
    made = (clast_cloud){0};
done:
    clast_cloud_free(&made);
    return status;
}
