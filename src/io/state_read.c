// State files, reading: nothing is believed. Lengths, indices, quaternions and signs are checked,
// so that an assembly that was read can be used like one that was made.
#include "io/state.h"

#include "base/alloc.h"
#include "io/state_path.h"
#include <clast/assembly.h>
#include <clast/table.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

/// Array of *n items of `width` numbers into a fresh block; *n < 0 takes any number and tells it.
static clast_status read_array(clx_place at, const char *name, clx_h5_type type, int32_t width,
                               int64_t *n, void *data)
{
    clast_status status = CLAST_OK;
    char path[CLX_H5_NAME_LIMIT];
    int64_t count = 0;
    void *block = NULL;
    CLX_CHECK(clx_join(path, at.folder, name), CLAST_E_FORMAT, "name %s/%s is too long", at.folder,
              name);
    CLX_TRY(clx_h5_read_new(at.h5, path, type, width, &count, &block));
    CLX_CHECK(*n < 0 || count == *n, CLAST_E_FORMAT, "%s has %" PRId64 " items, expected %" PRId64,
              path, count, *n);
    memcpy(data, &block, sizeof block);
    block = NULL;
    *n = count;
done:
    clx_free(block);
    return status;
}

static bool has(clx_h5 *h5, const char *folder, const char *name)
{
    char path[CLX_H5_NAME_LIMIT];
    return clx_join(path, folder, name) && clx_h5_has(h5, path);
}

/// A short text attribute into a fixed array.
static clast_status read_word(clx_h5 *h5, const char *object, const char *name, char *word,
                              size_t size)
{
    clast_status status = CLAST_OK;
    char *text = NULL;
    CLX_TRY(clx_h5_read_text(h5, object, name, &text));
    CLX_CHECK(strlen(text) < size, CLAST_E_FORMAT, "attribute %s of %s is too long", name, object);
    memcpy(word, text, strlen(text) + 1);
done:
    clx_free(text);
    return status;
}

clast_status clx_state_read_head(clx_h5 *h5, char version[32], char unit[16])
{
    clast_status status = CLAST_OK;
    char format[32];
    int32_t schema = 0;
    CLX_TRY(read_word(h5, "/", "format", format, sizeof format));
    CLX_CHECK(strcmp(format, "clast state") == 0, CLAST_E_FORMAT, "format '%s' is not a state",
              format);
    CLX_TRY(clx_h5_read_number(h5, "/", "schema", CLX_H5_I32, &schema));
    CLX_CHECK(schema == CLX_STATE_SCHEMA, CLAST_E_FORMAT,
              "schema %d; this is clast %s, which reads %d", schema, clast_version(),
              CLX_STATE_SCHEMA);
    if (version != NULL) {
        CLX_TRY(read_word(h5, "/", "clast_version", version, 32));
    }
    if (unit != NULL) {
        CLX_TRY(read_word(h5, "/", "unit", unit, 16));
    }
done:
    return status;
}

static bool all_finite(const double *x, int64_t n)
{
    for (int64_t i = 0; i < n; ++i) {
        if (!isfinite(x[i])) {
            return false;
        }
    }
    return true;
}

static bool all_positive(const double *x, int64_t n)
{
    for (int64_t i = 0; i < n; ++i) {
        if (!(x[i] > 0.0 && isfinite(x[i]))) {
            return false;
        }
    }
    return true;
}

static bool all_within(const int32_t *x, int64_t n, int32_t limit)
{
    for (int64_t i = 0; i < n; ++i) {
        if (x[i] < 0 || x[i] >= limit) {
            return false;
        }
    }
    return true;
}

clast_status clx_state_read_spheres(clx_h5 *h5, const char *folder, clast_spheres *spheres)
{
    clast_status status = CLAST_OK;
    clast_spheres made = {0};
    int64_t n = -1;
    CLX_TRY(read_array((clx_place){h5, folder}, "centre", CLX_H5_F64, 3, &n, &made.centre));
    CLX_TRY(read_array((clx_place){h5, folder}, "radius", CLX_H5_F64, 1, &n, &made.radius));
    CLX_CHECK(n <= INT32_MAX &&
                  (n == 0 || (all_finite(made.centre[0], 3 * n) && all_positive(made.radius, n))),
              CLAST_E_FORMAT, "%s: not every sphere is finite with a radius above 0", folder);
    made.n = (int32_t)n;
    *spheres = made;
    made = (clast_spheres){0};
done:
    clast_spheres_free(&made);
    return status;
}

static clast_status read_mesh(clx_h5 *h5, const char *folder, clast_mesh *mesh)
{
    clast_status status = CLAST_OK;
    clast_mesh made = {0};
    int64_t n_vert = -1;
    int64_t n_tri = -1;
    CLX_TRY(read_array((clx_place){h5, folder}, "vert", CLX_H5_F64, 3, &n_vert, &made.vert));
    CLX_TRY(read_array((clx_place){h5, folder}, "tri", CLX_H5_I32, 3, &n_tri, &made.tri));
    CLX_CHECK(n_vert <= INT32_MAX && n_tri <= INT32_MAX && n_vert > 0 &&
                  all_finite(made.vert[0], 3 * n_vert) &&
                  (n_tri == 0 || all_within(made.tri[0], 3 * n_tri, (int32_t)n_vert)),
              CLAST_E_FORMAT, "%s: the surface has vertices or triangles that cannot be", folder);
    made.n_vert = (int32_t)n_vert;
    made.n_tri = (int32_t)n_tri;
    *mesh = made;
    made = (clast_mesh){0};
done:
    clast_mesh_free(&made);
    return status;
}

static clast_status read_kind(clx_h5 *h5, const char *folder, clast_shape_kind *kind)
{
    static const struct {
        const char *word;
        clast_shape_kind kind;
    } kinds[] = {{"sphere", CLAST_SHAPE_SPHERE},
                 {"ellipsoid", CLAST_SHAPE_ELLIPSOID},
                 {"mesh", CLAST_SHAPE_MESH},
                 {"clump", CLAST_SHAPE_CLUMP}};
    char word[32];
    const clast_status status = read_word(h5, folder, "kind", word, sizeof word);
    for (size_t i = 0; status == CLAST_OK && i < sizeof kinds / sizeof kinds[0]; ++i) {
        if (strcmp(word, kinds[i].word) == 0) {
            *kind = kinds[i].kind;
            return CLAST_OK;
        }
    }
    return status != CLAST_OK ? status
                              : clx_fail(CLAST_E_FORMAT, "%s: unknown kind '%s'", folder, word);
}

/// Array of fixed size into the struct.
static clast_status read_fixed(clx_h5 *h5, const char *folder, const char *name, int32_t rank,
                               double *into)
{
    char path[CLX_H5_NAME_LIMIT];
    const int64_t shape[2] = {3, 3};
    (void)clx_join(path, folder, name);
    return clx_h5_read(h5, path, CLX_H5_F64, rank, shape, into);
}

static clast_status read_numbers(clx_h5 *h5, const char *folder, clast_shape *s)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_h5_read_number(h5, folder, "volume", CLX_H5_F64, &s->volume));
    CLX_TRY(clx_h5_read_number(h5, folder, "length", CLX_H5_F64, &s->length));
    CLX_TRY(clx_h5_read_number(h5, folder, "bounding_radius", CLX_H5_F64, &s->bounding_radius));
    CLX_TRY(read_fixed(h5, folder, "semi_axes", 1, s->semi_axes));
    CLX_TRY(read_fixed(h5, folder, "inertia", 2, s->inertia[0]));
    CLX_TRY(read_fixed(h5, folder, "source_origin", 1, s->source_origin));
    const double size[3] = {s->volume, s->length, s->bounding_radius};
    CLX_CHECK(all_positive(size, 3) && all_positive(s->semi_axes, 3) &&
                  s->semi_axes[0] >= s->semi_axes[1] && s->semi_axes[1] >= s->semi_axes[2] &&
                  all_finite(s->inertia[0], 9) && all_finite(s->source_origin, 3),
              CLAST_E_FORMAT, "%s: sizes or moments that no shape has", folder);
done:
    return status;
}

/// Where the mass of a shape of several densities is.
static clast_status read_material(clx_h5 *h5, const char *folder, clast_material *own)
{
    clast_status status = CLAST_OK;
    if (!has(h5, folder, "mass_centre")) {
        return CLAST_OK;
    }
    own->is_mixed = true;
    CLX_TRY(clx_h5_read_number(h5, folder, "mass_density", CLX_H5_F64, &own->density));
    CLX_TRY(read_fixed(h5, folder, "mass_centre", 1, own->centre));
    CLX_TRY(read_fixed(h5, folder, "mass_inertia", 2, own->inertia[0]));
    CLX_CHECK(all_positive(&own->density, 1) && all_finite(own->centre, 3) &&
                  all_finite(own->inertia[0], 9),
              CLAST_E_FORMAT, "%s: a mass that no shape has", folder);
done:
    return status;
}

static clast_status check_part(const clast_part *p, const clast_mesh *mesh, const char *folder)
{
    clast_status status = CLAST_OK;
    const bool is_mesh = p->kind == CLAST_SHAPE_MESH;
    double length2 = 0.0;
    for (int k = 0; k < 4; ++k) {
        length2 += p->orientation[k] * p->orientation[k];
    }
    CLX_CHECK((is_mesh || ((p->kind == CLAST_SHAPE_SPHERE || p->kind == CLAST_SHAPE_ELLIPSOID) &&
                           all_positive(p->semi_axes, 3))) &&
                  all_finite(p->position, 3) && fabs(length2 - 1.0) <= 2e-9 && p->vert[0] >= 0 &&
                  p->vert[0] <= p->vert[1] && p->vert[1] <= mesh->n_vert && p->tri[0] >= 0 &&
                  p->tri[0] <= p->tri[1] && p->tri[1] <= mesh->n_tri,
              CLAST_E_FORMAT, "%s: a part that cannot be", folder);
    for (int32_t t = p->tri[0]; t < p->tri[1]; ++t) {
        for (int k = 0; k < 3; ++k) {
            CLX_CHECK(mesh->tri[t][k] >= p->vert[0] && mesh->tri[t][k] < p->vert[1], CLAST_E_FORMAT,
                      "%s: a part's triangle has vertices of another", folder);
        }
    }
done:
    return status;
}

/// Convex parts of a rigid grain, whose surfaces are read.
static clast_status read_rigid(clx_h5 *h5, const char *folder, clast_shape *shape)
{
    clast_status status = CLAST_OK;
    int32_t(*id)[5] = NULL;
    double(*number)[10] = NULL;
    int64_t n = -1;
    CLX_TRY(read_array((clx_place){h5, folder}, "part_id", CLX_H5_I32, 5, &n, &id));
    CLX_TRY(read_array((clx_place){h5, folder}, "part", CLX_H5_F64, 10, &n, &number));
    CLX_CHECK(n > 0 && n <= INT32_MAX, CLAST_E_FORMAT, "%s: %" PRId64 " parts", folder, n);
    CLX_TRY(clx_alloc(&shape->parts.part, n, sizeof *shape->parts.part));
    for (; shape->parts.n < n; ++shape->parts.n) {
        const int32_t i = shape->parts.n;
        clast_part *p = &shape->parts.part[i];
        CLX_CHECK(id[i][0] >= CLAST_SHAPE_SPHERE && id[i][0] <= CLAST_SHAPE_MESH, CLAST_E_FORMAT,
                  "%s: a part of kind %d", folder, id[i][0]);
        *p = (clast_part){.kind = (clast_shape_kind)id[i][0],
                          .vert = {id[i][1], id[i][2]},
                          .tri = {id[i][3], id[i][4]}};
        memcpy(p->semi_axes, number[i], sizeof p->semi_axes);
        memcpy(p->position, number[i] + 3, sizeof p->position);
        memcpy(p->orientation, number[i] + 6, sizeof p->orientation);
        CLX_TRY(check_part(p, &shape->mesh, folder));
    }
done:
    CLX_FREE(id, number);
    return status;
}

static clast_status read_shape(clx_h5 *h5, const char *folder, clast_shape *shape)
{
    clast_status status = CLAST_OK;
    clast_shape made = {0};
    CLX_TRY(read_kind(h5, folder, &made.kind));
    CLX_TRY(clx_h5_read_text(h5, folder, "name", &made.name));
    CLX_TRY(read_numbers(h5, folder, &made));
    CLX_TRY(read_material(h5, folder, &made.own));
    if (has(h5, folder, "vert")) {
        CLX_TRY(read_mesh(h5, folder, &made.mesh));
    }
    if (has(h5, folder, "centre")) {
        CLX_TRY(clx_state_read_spheres(h5, folder, &made.spheres));
    }
    if (has(h5, folder, "part")) {
        CLX_TRY(read_rigid(h5, folder, &made));
    }
    CLX_CHECK((made.kind != CLAST_SHAPE_MESH || made.mesh.n_tri >= 4) &&
                  (made.kind != CLAST_SHAPE_CLUMP || made.spheres.n > 0) && made.name[0] != '\0',
              CLAST_E_FORMAT, "%s lacks its surface, its spheres or its name", folder);
    *shape = made;
    made = (clast_shape){0};
done:
    clast_shape_free(&made);
    return status;
}

static clast_status read_shapes(clx_h5 *h5, const char *folder, clast_assembly *a)
{
    clast_status status = CLAST_OK;
    char path[CLX_H5_NAME_LIMIT];
    char name[32];
    int32_t n = 0;
    int64_t n_folder = 0;
    CLX_TRY(clx_h5_read_number(h5, folder, "n_shape", CLX_H5_I32, &n));
    CLX_CHECK(clx_join(path, folder, "shape"), CLAST_E_FORMAT, "name %s is too long", folder);
    if (n != 0) {
        CLX_TRY(clx_h5_count(h5, path, &n_folder));
    }
    CLX_CHECK(n >= 0 && n == n_folder, CLAST_E_FORMAT, "%s says %d shapes and holds %" PRId64,
              folder, n, n_folder);
    CLX_TRY(clx_alloc(&a->shape, n, sizeof *a->shape));
    for (; a->n_shape < n; ++a->n_shape) {
        (void)snprintf(name, sizeof name, "shape/%06d", a->n_shape);
        CLX_CHECK(clx_join(path, folder, name), CLAST_E_FORMAT, "name %s is too long", folder);
        CLX_TRY(read_shape(h5, path, &a->shape[a->n_shape]));
    }
done:
    return status;
}

static clast_status check_poses(const clast_assembly *a, const char *folder)
{
    clast_status status = CLAST_OK;
    const int64_t n = a->n_grain;
    CLX_CHECK(n == 0 || all_within(a->shape_id, n, a->n_shape), CLAST_E_FORMAT,
              "%s: a grain has a shape that is not there", folder);
    CLX_CHECK(n == 0 || all_finite(a->position[0], 3 * n), CLAST_E_FORMAT,
              "%s: a position is not finite", folder);
    CLX_CHECK(all_positive(a->scale, n) && all_positive(a->density, n), CLAST_E_FORMAT,
              "%s: a scale or density is not above 0", folder);
    for (int64_t i = 0; i < n; ++i) {
        const double *q = a->orientation[i];
        const double length2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
        CLX_CHECK(fabs(length2 - 1.0) <= 2e-9, CLAST_E_FORMAT,
                  "%s: orientation %" PRId64 " is not a unit quaternion", folder, i);
    }
done:
    return status;
}

static clast_status read_grains(clx_h5 *h5, const char *folder, clast_assembly *a)
{
    clast_status status = CLAST_OK;
    int64_t n = -1;
    CLX_TRY(read_array((clx_place){h5, folder}, "shape_id", CLX_H5_I32, 1, &n, &a->shape_id));
    CLX_CHECK(n <= INT32_MAX, CLAST_E_LIMIT, "%s has %" PRId64 " grains", folder, n);
    CLX_TRY(read_array((clx_place){h5, folder}, "position", CLX_H5_F64, 3, &n, &a->position));
    CLX_TRY(read_array((clx_place){h5, folder}, "orientation", CLX_H5_F64, 4, &n, &a->orientation));
    CLX_TRY(read_array((clx_place){h5, folder}, "scale", CLX_H5_F64, 1, &n, &a->scale));
    CLX_TRY(read_array((clx_place){h5, folder}, "density", CLX_H5_F64, 1, &n, &a->density));
    CLX_TRY(read_array((clx_place){h5, folder}, "id", CLX_H5_I64, 1, &n, &a->id));
    a->n_grain = a->grain_capacity = (int32_t)n;
    CLX_TRY(check_poses(a, folder));
done:
    return status;
}

static clast_status read_contacts(clx_h5 *h5, const char *folder, clast_assembly *a)
{
    clast_status status = CLAST_OK;
    int64_t n = -1;
    if (!has(h5, folder, "contact")) {
        return CLAST_OK;
    }
    CLX_TRY(read_array((clx_place){h5, folder}, "contact", CLX_H5_I32, 2, &n, &a->contact));
    CLX_TRY(
        read_array((clx_place){h5, folder}, "contact_point", CLX_H5_F64, 3, &n, &a->contact_point));
    CLX_CHECK(n <= INT32_MAX && (n == 0 || (all_within(a->contact[0], 2 * n, a->n_grain) &&
                                            all_finite(a->contact_point[0], 3 * n))),
              CLAST_E_FORMAT, "%s: a contact joins grains that are not there", folder);
    a->n_contact = a->contact_capacity = (int32_t)n;
done:
    return status;
}

clast_status clx_state_read_assembly(clx_h5 *h5, const char *folder, clast_assembly *assembly)
{
    clast_status status = CLAST_OK;
    clast_assembly made = {0};
    CLX_TRY(read_word(h5, folder, "unit", made.unit, sizeof made.unit));
    CLX_TRY(read_shapes(h5, folder, &made));
    CLX_TRY(read_grains(h5, folder, &made));
    CLX_TRY(read_contacts(h5, folder, &made));
    *assembly = made;
    made = (clast_assembly){0};
done:
    clast_assembly_free(&made);
    return status;
}

static clast_status fill_texts(clast_table *table, int32_t c, const uint8_t *bytes,
                               const int64_t *begin, int64_t n_byte)
{
    clast_status status = CLAST_OK;
    char *text = NULL;
    for (int64_t i = 0; i < table->n_row; ++i) {
        CLX_CHECK(begin[i] >= 0 && begin[i] <= begin[i + 1] && begin[i + 1] <= n_byte,
                  CLAST_E_FORMAT, "a text of column %s lies outside", table->column[c].name);
        const int64_t n = begin[i + 1] - begin[i];
        CLX_TRY(clx_alloc(&text, n + 1, 1));
        memcpy(text, bytes + begin[i], (size_t)n);
        clx_free(table->column[c].text[i]);
        table->column[c].text[i] = text;
        text = NULL;
    }
done:
    return status;
}

static clast_status read_texts(clx_h5 *h5, const char *folder, const char *name, clast_table *table)
{
    clast_status status = CLAST_OK;
    char begin_name[32];
    uint8_t *bytes = NULL;
    int64_t *begin = NULL;
    int64_t n_byte = -1;
    int64_t n_begin = table->n_row + 1;
    (void)snprintf(begin_name, sizeof begin_name, "%s_begin", name);
    CLX_TRY(read_array((clx_place){h5, folder}, begin_name, CLX_H5_I64, 1, &n_begin, &begin));
    CLX_TRY(read_array((clx_place){h5, folder}, name, CLX_H5_U8, 1, &n_byte, &bytes));
    CLX_CHECK(begin != NULL && bytes != NULL, CLAST_E_FORMAT, "column %s is not there", name);
    CLX_TRY(fill_texts(table, table->n_column - 1, bytes, begin, n_byte));
done:
    CLX_FREE(bytes, begin);
    return status;
}

static clast_status read_column(clx_h5 *h5, const char *folder, int32_t c, clast_table *table)
{
    CLAST_ASSERT(c >= 0);
    clast_status status = CLAST_OK;
    char name[16];
    char begin[32];
    char path[CLX_H5_NAME_LIMIT];
    char *title = NULL;
    char *unit = NULL;
    double *from = NULL;
    int64_t n_row = table->n_row;
    double *into = NULL;
    (void)snprintf(name, sizeof name, "%06d", c);
    (void)snprintf(begin, sizeof begin, "%s_begin", name);
    CLX_CHECK(clx_join(path, folder, name), CLAST_E_FORMAT, "name %s is too long", folder);
    CLX_TRY(clx_h5_read_text(h5, path, "name", &title));
    CLX_TRY(clx_h5_read_text(h5, path, "unit", &unit));
    if (has(h5, folder, begin)) {
        CLX_TRY(clast_table_add_text(table, title));
        CLX_TRY(read_texts(h5, folder, name, table));
    } else {
        CLX_TRY(read_array((clx_place){h5, folder}, name, CLX_H5_F64, 1, &n_row, &from));
        CLX_TRY(clast_table_add_number(table, title, unit, &into));
        if (from != NULL && n_row > 0) {
            memcpy(into, from, (size_t)n_row * sizeof *into);
        }
    }
done:
    status = status == CLAST_E_USAGE ? CLAST_E_FORMAT : status; // two columns of one name
    CLX_FREE(title, unit, from);
    return status;
}

clast_status clx_state_read_table(clx_h5 *h5, const char *folder, clast_table *table)
{
    clast_status status = CLAST_OK;
    clast_table made = {0};
    char *name = NULL;
    int32_t n_column = 0;
    int64_t n_row = 0;
    int64_t n_member = 0;
    CLX_TRY(clx_h5_read_text(h5, folder, "name", &name));
    CLX_TRY(clx_h5_read_number(h5, folder, "n_column", CLX_H5_I32, &n_column));
    CLX_TRY(clx_h5_read_number(h5, folder, "n_row", CLX_H5_I64, &n_row));
    CLX_TRY(clx_h5_count(h5, folder, &n_member));
    CLX_CHECK(n_column >= 0 && n_row >= 0 && n_column <= n_member && n_row < INT64_MAX / 16,
              CLAST_E_FORMAT, "%s says %d columns of %" PRId64 " rows", folder, n_column, n_row);
    CLX_TRY(clast_table_init(&made, name, n_row));
    for (int32_t c = 0; c < n_column; ++c) {
        CLX_TRY(read_column(h5, folder, c, &made));
    }
    *table = made;
    made = (clast_table){0};
done:
    clx_free(name);
    clast_table_free(&made);
    return status;
}
