// Rockable's configuration and library of shapes, as io/rockable.c reads them back to the last
// digit.
//
// Rockable wants shapes in the frame of their principal axes; one that is there already is written
// as it is. Their radius (of rounded edges) is 0: vertices are those of the sharp body.
#include "io/export.h"

#include "base/alloc.h"
#include "base/number.h"
#include "math/sym3.h"
#include "math/vec3.h"
#include <clast/assembly.h>
#include <clast/mesh.h>
#include <clast/shape.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Moments off the diagonal, by the trace, below which a shape lies along its principal axes.
static const double ALIGNED = 1e-9;

/// Rotation of the shape's principal axes to its frame: identity where they are the same.
static void principal_rotation(const clast_shape *shape, double rotation[4])
{
    double axis[3][3];
    double value[3];
    double m[3][3];
    double inertia[3][3];
    memcpy(inertia, shape->inertia, sizeof inertia);
    const double trace = inertia[0][0] + inertia[1][1] + inertia[2][2];
    const double off = fmax(fabs(inertia[0][1]), fmax(fabs(inertia[0][2]), fabs(inertia[1][2])));
    rotation[0] = 1.0;
    rotation[1] = rotation[2] = rotation[3] = 0.0;
    if (shape->kind == CLAST_SHAPE_SPHERE || off <= ALIGNED * trace) {
        return;
    }
    clx_sym3_eigen(inertia, value, axis);
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            m[i][k] = axis[k][i];
        }
    }
    q_from_matrix(rotation, m);
    q_unit(rotation);
}

static bool is_rotated(const double rotation[4])
{
    return rotation[1] != 0.0 || rotation[2] != 0.0 || rotation[3] != 0.0;
}

/// Whether a text is one word of Rockable's files, where # begins a comment.
static bool is_word(const char *text)
{
    bool is_one = text[0] != '\0';
    for (const char *c = text; *c != '\0'; ++c) {
        is_one = is_one && (unsigned char)*c > ' ' && *c != 0x7f && *c != '#';
    }
    return is_one;
}

static int by_name(const void *a, const void *b)
{
    const char *const *x = a;
    const char *const *y = b;
    return strcmp(*x, *y);
}

/// Grains name their shapes.
static clast_status check_names(const clast_assembly *a, const char *path)
{
    clast_status status = CLAST_OK;
    const char **name = NULL;
    CLX_TRY(clx_alloc(&name, a->n_shape, sizeof *name));
    for (int32_t i = 0; i < a->n_shape; ++i) {
        name[i] = a->shape[i].name;
    }
    if (a->n_shape > 0) {
        qsort(name, (size_t)a->n_shape, sizeof *name, by_name);
    }
    for (int32_t i = 1; i < a->n_shape; ++i) {
        CLX_CHECK(strcmp(name[i], name[i - 1]) != 0, CLAST_E_USAGE,
                  "%s: two shapes have the name %s, by which Rockable's grains refer to theirs",
                  path, name[i]);
    }
done:
    clx_free(name);
    return status;
}

static clast_status check_shapes(const clast_assembly *a, const char *path)
{
    const char *slash = strrchr(path, '/');
    if (!is_word(slash != NULL ? slash + 1 : path)) {
        return clx_fail(
            CLAST_E_USAGE,
            "%s: the file of shapes beside it is named in it, and Rockable's names have "
            "no blanks and no #: give it another name",
            path);
    }
    for (int32_t i = 0; i < a->n_shape; ++i) {
        const clast_shape *s = &a->shape[i];
        if (s->kind != CLAST_SHAPE_SPHERE && (s->kind != CLAST_SHAPE_MESH || s->parts.n > 0)) {
            return clx_fail(CLAST_E_USAGE,
                            "%s: Rockable's shapes are spheres and polyhedra, and %s is neither; "
                            "write .csv, .dump or .data",
                            path, s->name);
        }
        if (!is_word(s->name)) {
            return clx_fail(CLAST_E_USAGE,
                            "%s: Rockable's names have no blanks and no #, as '%s' has", path,
                            s->name);
        }
    }
    return check_names(a, path);
}

static void write_row(clx_file *file, const char *key, const double *x, int n)
{
    (void)clx_file_print(file, "%s", key);
    clx_export_numbers(file, x, n);
    (void)clx_file_print(file, "\n");
}

static int by_corner(const void *a, const void *b)
{
    const int32_t *x = a;
    const int32_t *y = b;
    return x[0] != y[0] ? (x[0] < y[0] ? -1 : 1) : x[1] < y[1] ? -1 : x[1] > y[1] ? 1 : 0;
}

/// Each edge once: that of the triangle in which it rises.
static clast_status write_edges(clx_file *file, const clast_mesh *mesh)
{
    clast_status status = CLAST_OK;
    int32_t(*edge)[2] = NULL;
    int32_t n = 0;
    CLX_TRY(clx_alloc(&edge, 3 * (int64_t)mesh->n_tri, sizeof *edge));
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            const int32_t a = mesh->tri[t][k];
            const int32_t b = mesh->tri[t][(k + 1) % 3];
            if (a < b) {
                edge[n][0] = a;
                edge[n++][1] = b;
            }
        }
    }
    qsort(edge, (size_t)n, sizeof *edge, by_corner);
    (void)clx_file_print(file, "ne %d\n", n);
    for (int32_t i = 0; i < n; ++i) {
        CLX_TRY(clx_file_print(file, "%d %d\n", edge[i][0], edge[i][1]));
    }
done:
    clx_free(edge);
    return status;
}

/// Half sides and middle of the box along the axes; a sphere's about its centre.
static void write_box(clx_file *file, const clast_mesh *mesh, double radius)
{
    static const double axis[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    static const char *const key[3] = {"obb.e1", "obb.e2", "obb.e3"};
    double extent[3] = {radius, radius, radius};
    double middle[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < 3 && mesh->n_vert > 0; ++k) {
        double low = INFINITY;
        double high = -INFINITY;
        for (int32_t i = 0; i < mesh->n_vert; ++i) {
            low = fmin(low, mesh->vert[i][k]);
            high = fmax(high, mesh->vert[i][k]);
        }
        extent[k] = 0.5 * (high - low);
        middle[k] = 0.5 * (high + low);
    }
    write_row(file, "obb.extent", extent, 3);
    for (int k = 0; k < 3; ++k) {
        write_row(file, key[k], axis[k], 3);
    }
    write_row(file, "obb.center", middle, 3);
}

static void write_mass(clx_file *file, double volume, double inertia[3][3])
{
    const double moment[3] = {inertia[0][0] / volume, inertia[1][1] / volume,
                              inertia[2][2] / volume};
    write_row(file, "volume", &volume, 1);
    write_row(file, "I/m", moment, 3);
}

static clast_status write_sphere(clx_file *file, const clast_shape *shape)
{
    static const clast_mesh none = {0};
    double inertia[3][3];
    memcpy(inertia, shape->inertia, sizeof inertia);
    write_row(file, "radius", shape->semi_axes, 1);
    (void)clx_file_print(file, "preCompDone y\nnv 1\n0 0 0\nne 0\nnf 0\n");
    write_box(file, &none, shape->semi_axes[0]);
    write_mass(file, shape->volume, inertia);
    return clx_file_print(file, ">\n");
}

static clast_status write_polyhedron(clx_file *file, const clast_shape *shape,
                                     const double rotation[4])
{
    clast_status status = CLAST_OK;
    clast_mesh mesh = {0};
    clast_mass mass = {0};
    const double back[4] = {rotation[0], -rotation[1], -rotation[2], -rotation[3]};
    CLX_TRY(clast_mesh_copy(&shape->mesh, &mesh));
    for (int32_t i = 0; i < mesh.n_vert && is_rotated(rotation); ++i) {
        double x[3];
        v3_copy(x, mesh.vert[i]);
        q_rotate(mesh.vert[i], back, x);
    }
    CLX_TRY(clast_mesh_mass(&mesh, &mass));
    (void)clx_file_print(file, "radius 0\npreCompDone y\nnv %d\n", mesh.n_vert);
    for (int32_t i = 0; i < mesh.n_vert; ++i) {
        char text[3][CLX_NUMBER_SIZE];
        for (int k = 0; k < 3; ++k) {
            (void)clx_number_format(mesh.vert[i][k], text[k]);
        }
        CLX_TRY(clx_file_print(file, "%s %s %s\n", text[0], text[1], text[2]));
    }
    CLX_TRY(write_edges(file, &mesh));
    (void)clx_file_print(file, "nf %d\n", mesh.n_tri);
    for (int32_t t = 0; t < mesh.n_tri; ++t) {
        CLX_TRY(
            clx_file_print(file, "3 %d %d %d\n", mesh.tri[t][0], mesh.tri[t][1], mesh.tri[t][2]));
    }
    write_box(file, &mesh, 0.0);
    write_mass(file, mass.volume, mass.inertia);
    CLX_TRY(clx_file_print(file, ">\n"));
done:
    clast_mesh_free(&mesh);
    return status;
}

static clast_status write_library(clx_file *file, const clast_assembly *a, double (*rotation)[4])
{
    clast_status status = CLAST_OK;
    for (int32_t i = 0; i < a->n_shape; ++i) {
        const clast_shape *shape = &a->shape[i];
        (void)clx_file_print(file, "<\nname %s\n", shape->name);
        CLX_TRY(shape->kind == CLAST_SHAPE_SPHERE ? write_sphere(file, shape)
                                                  : write_polyhedron(file, shape, rotation[i]));
    }
done:
    return status;
}

/// Densities in the order in which they are met; each grain's group.
static clast_status find_groups(const clast_assembly *a, int32_t *group, double *density,
                                int32_t *n_group)
{
    clast_status status = CLAST_OK;
    enum { MOST_GROUPS = 1024 };
    *n_group = 0;
    for (int32_t i = 0; i < a->n_grain; ++i) {
        int32_t g = 0;
        while (g < *n_group && density[g] != a->density[i]) {
            ++g;
        }
        CLX_CHECK(g < MOST_GROUPS, CLAST_E_LIMIT,
                  "grains of more than %d densities, a group of Rockable's each", MOST_GROUPS);
        density[g] = a->density[i];
        *n_group = g == *n_group ? g + 1 : *n_group;
        group[i] = g;
    }
done:
    return status;
}

/// name group cluster homothety position velocity acceleration Q vrot arot, at rest.
static clast_status write_particles(clx_file *file, const clast_assembly *a, const int32_t *group,
                                    double (*rotation)[4])
{
    static const double rest[6] = {0.0};
    clast_status status = CLAST_OK;
    (void)clx_file_print(file, "Particles %d\n", a->n_grain);
    for (int32_t i = 0; i < a->n_grain; ++i) {
        double q[4];
        const double *own = rotation[a->shape_id[i]];
        memcpy(q, a->orientation[i], sizeof q);
        if (is_rotated(own)) {
            q_mul(q, a->orientation[i], own);
            q_unit(q);
        }
        (void)clx_file_print(file, "%s %d %d", a->shape[a->shape_id[i]].name, group[i], i);
        clx_export_numbers(file, &a->scale[i], 1);
        clx_export_numbers(file, a->position[i], 3);
        clx_export_numbers(file, rest, 6);
        clx_export_numbers(file, q, 4);
        clx_export_numbers(file, rest, 6);
        CLX_TRY(clx_file_print(file, "\n"));
    }
done:
    return status;
}

static clast_status write_configuration(clx_file *file, const clast_assembly *a,
                                        const char *library, double (*rotation)[4])
{
    clast_status status = CLAST_OK;
    int32_t *group = NULL;
    double *density = NULL;
    int32_t n_group = 0;
    const char *slash = strrchr(library, '/');
    CLX_TRY(clx_alloc(&group, a->n_grain, sizeof *group));
    CLX_TRY(clx_alloc(&density, a->n_grain + 1, sizeof *density));
    CLX_TRY(find_groups(a, group, density, &n_group));
    (void)clx_file_print(file, "Rockable 29-11-2018\nt 0\nprecision 17\nnDriven 0\nshapeFile %s\n",
                         slash != NULL ? slash + 1 : library);
    for (int32_t g = 0; g < n_group; ++g) {
        (void)clx_file_print(file, "density %d", g);
        clx_export_numbers(file, &density[g], 1);
        (void)clx_file_print(file, "\n");
    }
    CLX_TRY(write_particles(file, a, group, rotation));
done:
    CLX_FREE(group, density);
    return status;
}

clast_status clx_export_rockable(const clast_assembly *a, const char *path)
{
    clast_status status = CLAST_OK;
    char library[4096];
    double(*rotation)[4] = NULL;
    clx_file shapes = {0};
    clx_file grains = {0};
    const char *dot = strrchr(path, '.');
    const int stem = (int)(dot != NULL ? dot - path : (ptrdiff_t)strlen(path));
    const int n = snprintf(library, sizeof library, "%.*s.shp", stem, path);
    CLX_CHECK(n > 0 && n < (int)sizeof library, CLAST_E_USAGE, "%.60s...: the path is too long",
              path);
    CLX_TRY(check_shapes(a, path));
    CLX_TRY(clx_alloc(&rotation, a->n_shape, sizeof *rotation));
    for (int32_t i = 0; i < a->n_shape; ++i) {
        principal_rotation(&a->shape[i], rotation[i]);
    }
    CLX_TRY(clx_file_begin(library, &shapes));
    CLX_TRY(clx_file_begin(path, &grains));
    CLX_TRY(write_library(&shapes, a, rotation));
    CLX_TRY(write_configuration(&grains, a, library, rotation));
    CLX_TRY(clx_file_commit(&shapes)); // both are whole before either takes an old one's place
    CLX_TRY(clx_file_commit(&grains));
done:
    clx_file_abandon(&shapes);
    clx_file_abandon(&grains);
    clx_free(rotation);
    return status;
}
