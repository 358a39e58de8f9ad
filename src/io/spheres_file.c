// Sphere sets from files and to files: CSV and state files.
#include <clast/spheres_file.h>

#include "base/alloc.h"
#include "base/path.h"
#include "base/status.h"
#include "math/vec3.h"
#include <clast/state.h>
#include <clast/table_file.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

static bool is_state(const char *path)
{
    return clx_path_is(path, "h5") || clx_path_is(path, "hdf5");
}

/// True for "x", "x_um", "x (um)", "x [um]" when the wanted name is "x".
static bool is_named(const char *column, const char *wanted)
{
    const size_t n = strlen(wanted);
    return strncasecmp(column, wanted, n) == 0 && strchr("_ ([", column[n]) != NULL;
}

/// Columns of x, y, z and radius: by name, or the first four when no name fits at all.
static clast_status find_columns(const clast_table *table, const double *number[4])
{
    static const char *const names[4][2] = {{"x", "x"}, {"y", "y"}, {"z", "z"}, {"radius", "r"}};
    clast_status status = CLAST_OK;
    int n_found = 0;
    for (int k = 0; k < 4; ++k) {
        number[k] = NULL;
        for (int32_t c = 0; c < table->n_column && number[k] == NULL; ++c) {
            const clast_column *column = &table->column[c];
            if (is_named(column->name, names[k][0]) || is_named(column->name, names[k][1])) {
                CLX_CHECK(column->number != NULL, CLAST_E_FORMAT,
                          "column %s of the spheres holds texts", column->name);
                number[k] = column->number;
                ++n_found;
            }
        }
    }
    for (int k = 0; k < 4 && n_found == 0 && table->n_column >= 4; ++k) {
        number[k] = table->column[k].number;
    }
    for (int k = 0; k < 4; ++k) {
        CLX_CHECK(number[k] != NULL, CLAST_E_FORMAT,
                  "no column of numbers named %s%s; spheres need x, y, z and radius", names[k][0],
                  k == 3 ? " or r" : "");
    }
done:
    return status;
}

static clast_status read_csv(const char *path, clast_spheres *spheres)
{
    clast_status status = CLAST_OK;
    clast_table table = {0};
    clast_spheres made = {0};
    const double *number[4] = {NULL};
    CLX_TRY(clast_table_read_csv(path, NULL, &table, NULL));
    CLX_TRY(find_columns(&table, number));
    CLX_CHECK(table.n_row > 0 && table.n_row <= INT32_MAX, CLAST_E_FORMAT, "%lld spheres",
              (long long)table.n_row);
    CLX_TRY(clast_spheres_alloc((int32_t)table.n_row, &made));
    for (int32_t i = 0; i < made.n && number[3] != NULL; ++i) { // NULL only for the analyser
        v3_set(made.centre[i], number[0][i], number[1][i], number[2][i]);
        made.radius[i] = number[3][i];
        CLX_CHECK(isfinite(made.centre[i][0]) && isfinite(made.centre[i][1]) &&
                      isfinite(made.centre[i][2]) && isfinite(made.radius[i]) &&
                      made.radius[i] > 0.0,
                  CLAST_E_FORMAT, "sphere %d of %d is (%g, %g, %g) with radius %g", i + 1, made.n,
                  made.centre[i][0], made.centre[i][1], made.centre[i][2], made.radius[i]);
    }
    *spheres = made;
    made = (clast_spheres){0};
done:
    if (status != CLAST_OK && table.n_column > 0) { // the reader names the file itself
        clx_fail_prefix("%s", path);
    }
    clast_spheres_free(&made);
    clast_table_free(&table);
    return status;
}

clast_status clast_spheres_read(const char *path, const char *name, clast_spheres *spheres)
{
    if (is_state(path)) {
        return clast_state_read_spheres(path, name, spheres);
    }
    if (name != NULL) {
        return clx_fail(CLAST_E_USAGE,
                        "%s: only state files (.h5) hold named sets, so '%s' cannot "
                        "be there",
                        path, name);
    }
    return read_csv(path, spheres);
}

static clast_status write_csv(const char *path, const clast_spheres *spheres)
{
    static const char *const names[4] = {"x", "y", "z", "radius"};
    clast_status status = CLAST_OK;
    clast_table table = {0};
    CLX_TRY(clast_table_init(&table, "spheres", spheres->n));
    for (int k = 0; k < 4; ++k) {
        double *column = NULL;
        CLX_TRY(clast_table_add_number(&table, names[k], "model", &column));
        for (int32_t i = 0; i < spheres->n; ++i) {
            column[i] = k < 3 ? spheres->centre[i][k] : spheres->radius[i];
        }
    }
    CLX_TRY(clast_table_write_csv(&table, path));
done:
    clast_table_free(&table);
    return status;
}

/// Puts a set into a state that was read: in place of the one of that name, or as one more.
static clast_status put_set(clast_state *state, const char *name, const clast_spheres *spheres)
{
    clast_status status = CLAST_OK;
    clast_spheres copy = {0};
    char *text = NULL;
    int32_t at = 0;
    CLX_TRY(clast_spheres_copy(spheres, &copy));
    while (at < state->n_spheres && strcmp(state->spheres[at].name, name) != 0) {
        ++at;
    }
    if (at == state->n_spheres) {
        CLX_TRY(clx_alloc_text(&text, name));
        CLX_TRY(clx_realloc(&state->spheres, at + 1, sizeof *state->spheres));
        state->spheres[at] = (clast_named_spheres){.name = text};
        text = NULL;
        ++state->n_spheres;
    }
    clast_spheres_free(&state->spheres[at].spheres);
    state->spheres[at].spheres = copy;
    copy = (clast_spheres){0};
done:
    clx_free(text);
    clast_spheres_free(&copy);
    return status;
}

static clast_status write_state(const char *path, const char *name, const clast_spheres *spheres,
                                const char *unit)
{
    clast_status status = CLAST_OK;
    clast_state state = {0};
    if (access(path, F_OK) != 0) {
        return clast_state_write_spheres(path, name, spheres, unit);
    }
    CLX_TRY(clast_state_read(path, &state));
    CLX_CHECK(strcmp(state.unit, unit) == 0, CLAST_E_USAGE,
              "%s holds lengths in %s, so spheres in %s cannot join it; choose another file", path,
              state.unit, unit);
    CLX_TRY(put_set(&state, name, spheres));
    CLX_TRY(clast_state_write(&state, path));
done:
    clast_state_free(&state);
    return status;
}

clast_status clast_spheres_write(const char *path, const char *name, const clast_spheres *spheres,
                                 const char *unit)
{
    if (is_state(path)) {
        return write_state(path, name, spheres, unit != NULL ? unit : "model");
    }
    if (!clx_path_is(path, "csv")) {
        return clx_fail(CLAST_E_USAGE, "%s: spheres are written to .csv or .h5", path);
    }
    return write_csv(path, spheres);
}
