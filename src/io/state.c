// State files as a whole, and single parts of them.
#include "io/state.h"

#include "base/alloc.h"
#include "io/state_path.h"
#include <clast/assembly.h>
#include <clast/table.h>
#include <inttypes.h>
#include <string.h>

void clast_state_free(clast_state *state)
{
    if (state == NULL) {
        return;
    }
    if (state->assembly != NULL) {
        clast_assembly_free(state->assembly);
    }
    clx_free(state->assembly);
    for (int32_t i = 0; i < state->n_spheres; ++i) {
        clx_free(state->spheres[i].name);
        clast_spheres_free(&state->spheres[i].spheres);
    }
    clx_free(state->spheres);
    for (int32_t i = 0; i < state->n_table; ++i) {
        clast_table_free(&state->table[i]);
    }
    CLX_FREE(state->table, state->config);
    *state = (clast_state){0};
}

const clast_table *clast_state_table(const clast_state *state, const char *name)
{
    if (state == NULL || name == NULL || state->table == NULL) {
        return NULL;
    }
    for (int32_t i = 0; i < state->n_table; ++i) {
        if (state->table[i].name != NULL && strcmp(state->table[i].name, name) == 0) {
            return &state->table[i];
        }
    }
    return NULL;
}

/// Puts the file's name before an error that does not begin with it.
static void name_file(const char *path)
{
    if (strncmp(clast_error_detail(), path, strlen(path)) != 0) {
        clx_fail_prefix("%s", path);
    }
}

/// Number of members of a folder, 0 if there is none.
static clast_status count_of(clx_h5 *h5, const char *folder, int32_t *n)
{
    clast_status status = CLAST_OK;
    int64_t count = 0;
    *n = 0;
    if (!clx_h5_has(h5, folder)) {
        return CLAST_OK;
    }
    CLX_TRY(clx_h5_count(h5, folder, &count));
    CLX_CHECK(count <= 1000000, CLAST_E_LIMIT, "%s has %" PRId64 " members", folder, count);
    *n = (int32_t)count;
done:
    return status;
}

static clast_status read_all_spheres(clx_h5 *h5, clast_state *state)
{
    clast_status status = CLAST_OK;
    char name[CLX_H5_NAME_LIMIT];
    char path[CLX_H5_NAME_LIMIT];
    int32_t n = 0;
    CLX_TRY(count_of(h5, "/spheres", &n));
    CLX_TRY(clx_alloc(&state->spheres, n, sizeof *state->spheres));
    for (; state->n_spheres < n; ++state->n_spheres) {
        clast_named_spheres *s = &state->spheres[state->n_spheres];
        clast_spheres taken = {0};
        CLX_TRY(clx_h5_member(h5, "/spheres", state->n_spheres, name));
        CLX_CHECK(clx_join(path, "/spheres", name), CLAST_E_FORMAT, "name %s is too long", name);
        CLX_TRY(clx_state_read_spheres(h5, path, &taken));
        status = clx_alloc_text(&s->name, name);
        if (status != CLAST_OK) {
            clast_spheres_free(&taken);
            goto done;
        }
        s->spheres = taken;
    }
done:
    return status;
}

static clast_status read_all_tables(clx_h5 *h5, clast_state *state)
{
    clast_status status = CLAST_OK;
    char name[CLX_H5_NAME_LIMIT];
    char path[CLX_H5_NAME_LIMIT];
    int32_t n = 0;
    CLX_TRY(count_of(h5, "/table", &n));
    CLX_TRY(clx_alloc(&state->table, n, sizeof *state->table));
    for (; state->n_table < n; ++state->n_table) {
        CLX_TRY(clx_h5_member(h5, "/table", state->n_table, name));
        CLX_CHECK(clx_join(path, "/table", name), CLAST_E_FORMAT, "name %s is too long", name);
        CLX_TRY(clx_state_read_table(h5, path, &state->table[state->n_table]));
    }
done:
    return status;
}

static clast_status read_all(clx_h5 *h5, clast_state *state)
{
    clast_status status = CLAST_OK;
    clast_assembly taken = {0};
    CLX_TRY(clx_state_read_head(h5, state->version, state->unit));
    if (clx_h5_has_attribute(h5, "/", "config")) {
        CLX_TRY(clx_h5_read_text(h5, "/", "config", &state->config));
    }
    if (clx_h5_has(h5, "/assembly")) {
        CLX_TRY(clx_state_read_assembly(h5, "/assembly", &taken));
        CLX_TRY(clx_alloc(&state->assembly, 1, sizeof *state->assembly));
        *state->assembly = taken;
        taken = (clast_assembly){0};
    }
    CLX_TRY(read_all_spheres(h5, state));
    CLX_TRY(read_all_tables(h5, state));
done:
    clast_assembly_free(&taken);
    return status;
}

clast_status clast_state_read(const char *path, clast_state *state)
{
    CLX_ARGUMENTS(path, state);
    clast_status status = CLAST_OK;
    clx_h5 *h5 = NULL;
    clast_state made = {0};
    CLX_TRY(clx_h5_open(path, &h5));
    status = read_all(h5, &made);
    if (status != CLAST_OK) {
        name_file(path);
        goto done;
    }
    *state = made;
    made = (clast_state){0};
done:
    clast_state_free(&made);
    clx_h5_close(h5);
    return status;
}

clast_status clast_state_read_assembly(const char *path, clast_assembly *assembly)
{
    CLX_ARGUMENTS(path, assembly);
    clast_status status = CLAST_OK;
    clx_h5 *h5 = NULL;
    CLX_TRY(clx_h5_open(path, &h5));
    status = clx_state_read_head(h5, NULL, NULL);
    if (status == CLAST_OK && !clx_h5_has(h5, "/assembly")) {
        status = clx_fail(CLAST_E_FORMAT, "it holds no assembly");
    }
    if (status == CLAST_OK) {
        status = clx_state_read_assembly(h5, "/assembly", assembly);
    }
    if (status != CLAST_OK) {
        name_file(path);
    }
done:
    clx_h5_close(h5);
    return status;
}

/// "it has no spheres called a; it has b, c"
static clast_status not_there(clx_h5 *h5, const char *folder, const char *name)
{
    char names[256] = "";
    int32_t n = 0;
    (void)count_of(h5, folder, &n);
    for (int32_t i = 0; i < n; ++i) {
        char member[CLX_H5_NAME_LIMIT];
        const size_t used = strlen(names);
        if (clx_h5_member(h5, folder, i, member) == CLAST_OK) {
            (void)snprintf(names + used, sizeof names - used, "%s%s", i > 0 ? ", " : "", member);
        }
    }
    if (name == NULL) {
        return clx_fail(CLAST_E_FORMAT, "name one of its %d %s: %s", n, folder + 1, names);
    }
    return clx_fail(CLAST_E_FORMAT, "it has no %s called %s; it has %s", folder + 1, name,
                    n > 0 ? names : "none");
}

/// Path of the named member, or of the only one when name is NULL.
static clast_status find_part(clx_h5 *h5, const char *folder, const char *name,
                              char path[CLX_H5_NAME_LIMIT])
{
    clast_status status = CLAST_OK;
    char only[CLX_H5_NAME_LIMIT];
    int32_t n = 0;
    CLX_TRY(clx_state_read_head(h5, NULL, NULL));
    if (name == NULL) {
        CLX_TRY(count_of(h5, folder, &n));
        if (n != 1) {
            return not_there(h5, folder, NULL);
        }
        CLX_TRY(clx_h5_member(h5, folder, 0, only));
    }
    if (!clx_join(path, folder, name != NULL ? name : only) || !clx_h5_has(h5, path)) {
        status = not_there(h5, folder, name);
    }
done:
    return status;
}

/// Takes one part of a kind out of an open state file.
typedef clast_status (*part_taker)(clx_h5 *h5, const char *folder, void *out);

static clast_status read_spheres(clx_h5 *h5, const char *folder, void *out)
{
    return clx_state_read_spheres(h5, folder, out);
}

static clast_status read_table(clx_h5 *h5, const char *folder, void *out)
{
    return clx_state_read_table(h5, folder, out);
}

/// Reads the named part of a kind, or the only one.
static clast_status read_part(const char *path, const char *kind, const char *name, part_taker take,
                              void *out)
{
    clast_status status = CLAST_OK;
    clx_h5 *h5 = NULL;
    char folder[CLX_H5_NAME_LIMIT];
    CLX_TRY(clx_h5_open(path, &h5));
    status = find_part(h5, kind, name, folder);
    if (status == CLAST_OK) {
        status = take(h5, folder, out);
    }
    if (status != CLAST_OK) {
        name_file(path);
    }
done:
    clx_h5_close(h5);
    return status;
}

clast_status clast_state_read_spheres(const char *path, const char *name, clast_spheres *spheres)
{
    CLX_ARGUMENTS(path, spheres);
    return read_part(path, "/spheres", name, read_spheres, spheres);
}

clast_status clast_state_read_table(const char *path, const char *name, clast_table *table)
{
    CLX_ARGUMENTS(path, name, table);
    return read_part(path, "/table", name, read_table, table);
}
