// State files, writing: assemblies, spheres and tables as named arrays (docs/theory/state-file.md).
#include "io/state.h"

#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/status.h"
#include "io/state_path.h"
#include "shape/whole.h"
#include <clast/assembly.h>
#include <clast/table.h>
#include <string.h>

/// One array under a folder.
static clast_status write_array(clx_place at, const char *name, clx_h5_type type, int64_t n,
                                int64_t width, const void *data)
{
    CLAST_ASSERT(n >= 0 && width >= 0);
    char path[CLX_H5_NAME_LIMIT];
    const int64_t shape[2] = {n, width};
    if (!clx_join(path, at.folder, name)) {
        return clx_fail(CLAST_E_USAGE, "name %s/%s is too long", at.folder, name);
    }
    return clx_h5_write(at.h5, path, type, width == 1 ? 1 : 2, shape, data);
}

static clast_status write_f64(clx_h5 *h5, const char *folder, const char *name, double value)
{
    return clx_h5_write_number(h5, folder, name, CLX_H5_F64, &value);
}

clast_status clx_state_write_head(clx_h5 *h5, const char *unit)
{
    clast_status status = CLAST_OK;
    const int32_t schema = CLX_STATE_SCHEMA;
    CLX_TRY(clx_h5_write_text(h5, "/", "format", "clast state"));
    CLX_TRY(clx_h5_write_number(h5, "/", "schema", CLX_H5_I32, &schema));
    CLX_TRY(clx_h5_write_text(h5, "/", "clast_version", clast_version()));
    CLX_TRY(clx_h5_write_text(h5, "/", "unit", unit));
done:
    return status;
}

static clast_status write_spheres(clx_h5 *h5, const char *folder, const clast_spheres *spheres)
{
    clast_status status = CLAST_OK;
    CLX_TRY(
        write_array((clx_place){h5, folder}, "centre", CLX_H5_F64, spheres->n, 3, spheres->centre));
    CLX_TRY(
        write_array((clx_place){h5, folder}, "radius", CLX_H5_F64, spheres->n, 1, spheres->radius));
done:
    return status;
}

/// Convex parts of a rigid grain: kind; vertices and triangles; semi-axes, position, orientation.
static clast_status write_rigid(clx_h5 *h5, const char *folder, const clast_parts *parts)
{
    clast_status status = CLAST_OK;
    int32_t *id = NULL;
    double *number = NULL;
    CLX_TRY(clx_alloc(&id, parts->n, 5 * sizeof *id));
    CLX_TRY(clx_alloc(&number, parts->n, 10 * sizeof *number));
    for (int32_t i = 0; i < parts->n; ++i) {
        const clast_part *p = &parts->part[i];
        const int32_t own[5] = {(int32_t)p->kind, p->vert[0], p->vert[1], p->tri[0], p->tri[1]};
        memcpy(&id[5 * i], own, sizeof own);
        memcpy(&number[10 * i], p->semi_axes, sizeof p->semi_axes);
        memcpy(&number[10 * i + 3], p->position, sizeof p->position);
        memcpy(&number[10 * i + 6], p->orientation, sizeof p->orientation);
    }
    CLX_TRY(write_array((clx_place){h5, folder}, "part_id", CLX_H5_I32, parts->n, 5, id));
    CLX_TRY(write_array((clx_place){h5, folder}, "part", CLX_H5_F64, parts->n, 10, number));
done:
    CLX_FREE(id, number);
    return status;
}

static clast_status write_parts(clx_h5 *h5, const char *folder, const clast_shape *shape)
{
    clast_status status = CLAST_OK;
    if (shape->mesh.n_vert > 0) {
        CLX_TRY(write_array((clx_place){h5, folder}, "vert", CLX_H5_F64, shape->mesh.n_vert, 3,
                            shape->mesh.vert));
        CLX_TRY(write_array((clx_place){h5, folder}, "tri", CLX_H5_I32, shape->mesh.n_tri, 3,
                            shape->mesh.tri));
    }
    if (shape->spheres.n > 0) {
        CLX_TRY(write_spheres(h5, folder, &shape->spheres));
    }
    if (shape->parts.n > 0) {
        CLX_TRY(write_rigid(h5, folder, &shape->parts));
    }
done:
    return status;
}

static clast_status write_shape(clx_h5 *h5, const char *folder, const clast_shape *shape)
{
    static const char *const kinds[] = {"sphere", "ellipsoid", "mesh", "clump"};
    clast_status status = CLAST_OK;
    CLX_TRY(clx_h5_write_folder(h5, folder));
    CLX_TRY(clx_h5_write_text(h5, folder, "name", shape->name));
    CLX_TRY(clx_h5_write_text(h5, folder, "kind", kinds[shape->kind]));
    CLX_TRY(write_f64(h5, folder, "volume", shape->volume));
    CLX_TRY(write_f64(h5, folder, "length", shape->length));
    CLX_TRY(write_f64(h5, folder, "bounding_radius", shape->bounding_radius));
    CLX_TRY(write_array((clx_place){h5, folder}, "semi_axes", CLX_H5_F64, 3, 1, shape->semi_axes));
    CLX_TRY(write_array((clx_place){h5, folder}, "inertia", CLX_H5_F64, 3, 3, shape->inertia));
    CLX_TRY(write_array((clx_place){h5, folder}, "source_origin", CLX_H5_F64, 3, 1,
                        shape->source_origin));
    if (shape->own.is_mixed) {
        const clast_material *own = &shape->own;
        CLX_TRY(write_f64(h5, folder, "mass_density", own->density));
        CLX_TRY(write_array((clx_place){h5, folder}, "mass_centre", CLX_H5_F64, 3, 1, own->centre));
        CLX_TRY(
            write_array((clx_place){h5, folder}, "mass_inertia", CLX_H5_F64, 3, 3, own->inertia));
    }
    CLX_TRY(write_parts(h5, folder, shape));
done:
    return status;
}

static clast_status write_grains(clx_h5 *h5, const char *folder, const clast_assembly *a)
{
    clast_status status = CLAST_OK;
    const int32_t n = a->n_grain;
    CLX_TRY(write_array((clx_place){h5, folder}, "shape_id", CLX_H5_I32, n, 1, a->shape_id));
    CLX_TRY(write_array((clx_place){h5, folder}, "position", CLX_H5_F64, n, 3, a->position));
    CLX_TRY(write_array((clx_place){h5, folder}, "orientation", CLX_H5_F64, n, 4, a->orientation));
    CLX_TRY(write_array((clx_place){h5, folder}, "scale", CLX_H5_F64, n, 1, a->scale));
    CLX_TRY(write_array((clx_place){h5, folder}, "density", CLX_H5_F64, n, 1, a->density));
    CLX_TRY(write_array((clx_place){h5, folder}, "id", CLX_H5_I64, n, 1, a->id));
    if (a->contact != NULL) {
        CLX_TRY(write_array((clx_place){h5, folder}, "contact", CLX_H5_I32, a->n_contact, 2,
                            a->contact));
        CLX_TRY(write_array((clx_place){h5, folder}, "contact_point", CLX_H5_F64, a->n_contact, 3,
                            a->contact_point));
    }
done:
    return status;
}

static clast_status write_assembly(clx_h5 *h5, const char *folder, const clast_assembly *assembly)
{
    clast_status status = CLAST_OK;
    char path[CLX_H5_NAME_LIMIT];
    char name[32];
    CLX_TRY(clx_h5_write_folder(h5, folder));
    CLX_TRY(clx_h5_write_text(h5, folder, "unit", assembly->unit));
    CLX_TRY(clx_h5_write_number(h5, folder, "n_shape", CLX_H5_I32, &assembly->n_shape));
    CLX_TRY(write_grains(h5, folder, assembly));
    for (int32_t s = 0; s < assembly->n_shape; ++s) {
        (void)snprintf(name, sizeof name, "shape/%06d", s);
        CLX_CHECK(clx_join(path, folder, name), CLAST_E_USAGE, "name %s is too long", folder);
        CLX_TRY(write_shape(h5, path, &assembly->shape[s]));
    }
done:
    return status;
}

/// A text column: all bytes in a row, and where each text begins, n_row + 1 numbers.
static clast_status write_text_column(clx_h5 *h5, const char *folder, const char *name,
                                      const clast_column *column, int64_t n_row)
{
    clast_status status = CLAST_OK;
    int64_t *begin = NULL;
    char *bytes = NULL;
    char begin_name[32];
    CLX_TRY(clx_alloc(&begin, n_row + 1, sizeof *begin));
    for (int64_t i = 0; i < n_row; ++i) {
        begin[i + 1] = begin[i] + (int64_t)strlen(column->text[i]);
    }
    CLX_TRY(clx_alloc(&bytes, begin[n_row], 1));
    for (int64_t i = 0; i < n_row; ++i) {
        memcpy(bytes + begin[i], column->text[i], (size_t)(begin[i + 1] - begin[i]));
    }
    CLX_TRY(write_array((clx_place){h5, folder}, name, CLX_H5_U8, begin[n_row], 1, bytes));
    (void)snprintf(begin_name, sizeof begin_name, "%s_begin", name);
    CLX_TRY(write_array((clx_place){h5, folder}, begin_name, CLX_H5_I64, n_row + 1, 1, begin));
done:
    CLX_FREE(begin, bytes);
    return status;
}

static clast_status write_column(clx_h5 *h5, const char *folder, int32_t c,
                                 const clast_table *table)
{
    clast_status status = CLAST_OK;
    const clast_column *column = &table->column[c];
    char name[16];
    char path[CLX_H5_NAME_LIMIT];
    (void)snprintf(name, sizeof name, "%06d", c);
    CLX_CHECK(clx_join(path, folder, name), CLAST_E_USAGE, "name %s is too long", folder);
    if (column->number != NULL) {
        CLX_TRY(write_array((clx_place){h5, folder}, name, CLX_H5_F64, table->n_row, 1,
                            column->number));
    } else {
        CLX_TRY(write_text_column(h5, folder, name, column, table->n_row));
    }
    CLX_TRY(clx_h5_write_text(h5, path, "name", column->name));
    CLX_TRY(clx_h5_write_text(h5, path, "unit", column->unit));
done:
    return status;
}

static clast_status write_table(clx_h5 *h5, const char *folder, const clast_table *table)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_h5_write_folder(h5, folder));
    CLX_TRY(clx_h5_write_text(h5, folder, "name", table->name));
    CLX_TRY(clx_h5_write_number(h5, folder, "n_column", CLX_H5_I32, &table->n_column));
    CLX_TRY(clx_h5_write_number(h5, folder, "n_row", CLX_H5_I64, &table->n_row));
    for (int32_t c = 0; c < table->n_column; ++c) {
        CLX_TRY(write_column(h5, folder, c, table));
    }
done:
    return status;
}

/// "/spheres/NAME" for a name that may stand there and is free.
static clast_status name_part(clx_h5 *h5, const char *kind, const char *name,
                              char path[CLX_H5_NAME_LIMIT])
{
    clast_status status = CLAST_OK;
    CLX_CHECK(name != NULL && name[0] != '\0' && strchr(name, '/') == NULL &&
                  strcmp(name, ".") != 0 && clx_join(path, kind, name),
              CLAST_E_USAGE, "'%s' cannot name %s in a state file: not empty, no '/', no '.' alone",
              name != NULL ? name : "", kind + 1);
    CLX_CHECK(!clx_h5_has(h5, path), CLAST_E_USAGE, "two %s are called %s", kind + 1, name);
    CLX_TRY(clx_h5_write_folder(h5, path));
done:
    return status;
}

clast_status clx_state_write_to(clx_h5 *h5, const clast_state *state)
{
    clast_status status = CLAST_OK;
    char path[CLX_H5_NAME_LIMIT];
    const char *unit = state->unit[0] != '\0' ? state->unit
                       : state->assembly != NULL && state->assembly->unit[0] != '\0'
                           ? state->assembly->unit
                           : "m";
    CLX_TRY(clx_state_write_head(h5, unit));
    if (state->config != NULL) {
        CLX_TRY(clx_h5_write_text(h5, "/", "config", state->config));
    }
    if (state->assembly != NULL) {
        CLX_TRY(write_assembly(h5, "/assembly", state->assembly));
    }
    for (int32_t i = 0; i < state->n_spheres; ++i) {
        CLX_TRY(name_part(h5, "/spheres", state->spheres[i].name, path));
        CLX_TRY(write_spheres(h5, path, &state->spheres[i].spheres));
    }
    for (int32_t i = 0; i < state->n_table; ++i) {
        CLX_TRY(name_part(h5, "/table", state->table[i].name, path));
        CLX_TRY(write_table(h5, path, &state->table[i]));
    }
done:
    return status;
}

/// What is wrong with a state that a caller has filled himself, for people, or NULL.
static const char *state_fault(const clast_state *state)
{
    const char *fault = NULL;
    if (!clx_has_array(state->spheres, state->n_spheres) ||
        !clx_has_array(state->table, state->n_table)) {
        return "a count is negative, or spheres or tables are NULL";
    }
    if (state->assembly != NULL) {
        fault = clx_assembly_fault(state->assembly);
    }
    for (int32_t i = 0; fault == NULL && i < state->n_spheres; ++i) {
        fault = state->spheres[i].name == NULL ? "spheres have no name"
                                               : clx_spheres_fault(&state->spheres[i].spheres);
    }
    for (int32_t i = 0; fault == NULL && i < state->n_table; ++i) {
        fault = state->table[i].name == NULL ? "a table has no name"
                                             : clx_table_fault(&state->table[i]);
    }
    return fault;
}

clast_status clast_state_write(const clast_state *state, const char *path)
{
    CLX_ARGUMENTS(state, path);
    CLX_GUARD(clx_fault_given(__func__, "state", state_fault(state)));
    clast_status status = CLAST_OK;
    clx_h5 *h5 = NULL;
    CLX_TRY(clx_h5_create(&h5));
    CLX_TRY(clx_state_write_to(h5, state));
    CLX_TRY(clx_h5_commit(h5, path));
done:
    clx_h5_close(h5);
    return status;
}

clast_status clast_state_write_assembly(const clast_assembly *assembly, const char *path,
                                        const char *config)
{
    CLX_ARGUMENTS(path, assembly);
    CLX_WHOLE(arrays, assembly);
    for (int32_t s = 0; s < assembly->n_shape; ++s) { // what is written; its reader judges the rest
        const clast_shape *shape = &assembly->shape[s];
        CLX_ARGUMENTS(shape->name);
        CLX_WHOLE(spheres, &shape->spheres);
        CLX_ARRAY(shape->mesh.vert, shape->mesh.n_vert);
        CLX_ARRAY(shape->mesh.tri, shape->mesh.n_tri);
        CLX_ARRAY(shape->parts.part, shape->parts.n);
    }
    clast_status status = CLAST_OK;
    clx_h5 *h5 = NULL;
    CLX_TRY(clx_h5_create(&h5));
    CLX_TRY(clx_state_write_head(h5, assembly->unit[0] != '\0' ? assembly->unit : "m"));
    if (config != NULL) {
        CLX_TRY(clx_h5_write_text(h5, "/", "config", config));
    }
    CLX_TRY(write_assembly(h5, "/assembly", assembly));
    CLX_TRY(clx_h5_commit(h5, path));
done:
    clx_h5_close(h5);
    return status;
}

clast_status clast_state_write_spheres(const clast_spheres *spheres, const char *path,
                                       const char *name, const char *unit)
{
    CLX_ARGUMENTS(path, name, spheres, unit);
    CLX_WHOLE(spheres, spheres);
    clast_status status = CLAST_OK;
    clx_h5 *h5 = NULL;
    char folder[CLX_H5_NAME_LIMIT];
    CLX_TRY(clx_h5_create(&h5));
    CLX_TRY(clx_state_write_head(h5, unit));
    CLX_TRY(name_part(h5, "/spheres", name, folder));
    CLX_TRY(write_spheres(h5, folder, spheres));
    CLX_TRY(clx_h5_commit(h5, path));
done:
    clx_h5_close(h5);
    return status;
}
