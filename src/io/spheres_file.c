// Sphere sets from files and to files: CSV and state files.
#include <clast/shape.h>

#include "base/alloc.h"
#include "base/lock.h"
#include "base/path.h"
#include "base/status.h"
#include "io/spheres_table.h"
#include "shape/whole.h"
#include <clast/state.h>
#include <clast/table.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/// Seconds that a writer waits for another one of the same file.
static const double PATIENCE = 10.0;

static bool is_state(const char *path)
{
    return clx_path_is(path, "h5") || clx_path_is(path, "hdf5");
}

static clast_status read_csv(const char *path, clast_spheres *spheres)
{
    clast_status status = CLAST_OK;
    clast_table table = {0};
    CLX_TRY(clast_table_read_csv(path, NULL, &table, NULL));
    CLX_TRY(clx_spheres_of_table(&table, NULL, spheres, NULL, NULL));
done:
    if (status != CLAST_OK && table.n_column > 0) { // the reader names the file itself
        clx_fail_prefix("%s", path);
    }
    clast_table_free(&table);
    return status;
}

clast_status clast_spheres_read(const char *path, const char *name, clast_spheres *spheres)
{
    CLX_ARGUMENTS(path, spheres);
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

static clast_status write_csv(const char *path, const clast_spheres *spheres, const char *unit)
{
    static const char *const names[4] = {"x", "y", "z", "radius"};
    clast_status status = CLAST_OK;
    clast_table table = {0};
    const bool is_known = strcmp(unit, "model") != 0;
    CLX_TRY(clast_table_init(&table, "spheres", spheres->n));
    for (int k = 0; k < 4; ++k) {
        double *column = NULL;
        char name[32];
        (void)snprintf(name, sizeof name, "%s%s%s", names[k], is_known ? "_" : "",
                       is_known ? unit : "");
        CLX_TRY(clast_table_add_number(&table, name, unit, &column));
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
static clast_status write_set(clast_state *state, const char *name, const clast_spheres *spheres)
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
    clx_lock lock = {0};
    bool is_busy = false;
    CLX_TRY(clx_lock_acquire(path, PATIENCE, &lock, &is_busy)); // from reading to writing
    if (access(path, F_OK) != 0) {
        status = clast_state_write_spheres(spheres, path, name, unit);
        goto done;
    }
    CLX_TRY(clast_state_read(path, &state));
    CLX_CHECK(strcmp(state.unit, unit) == 0, CLAST_E_USAGE,
              "%s holds lengths in %s, so spheres in %s cannot join it; choose another file", path,
              state.unit, unit);
    CLX_TRY(write_set(&state, name, spheres));
    CLX_TRY(clast_state_write(&state, path));
done:
    clx_lock_release(&lock);
    clast_state_free(&state);
    return status;
}

clast_status clast_spheres_write(const clast_spheres *spheres, const char *path, const char *name,
                                 const char *unit)
{
    CLX_ARGUMENTS(path, name, spheres);
    CLX_WHOLE(spheres, spheres);
    const char *own = unit != NULL && unit[0] != '\0' ? unit : "model";
    if (is_state(path)) {
        return write_state(path, name, spheres, own);
    }
    if (!clx_path_is(path, "csv")) {
        return clx_fail(CLAST_E_USAGE, "%s: spheres are written to .csv or .h5", path);
    }
    return write_csv(path, spheres, own);
}
