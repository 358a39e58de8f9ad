// Assemblies as tables: a row a grain, and LAMMPS dumps of the equivalent ellipsoids.
#include "io/export.h"

#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/number.h"
#include "base/status.h"
#include "math/sym3.h"
#include "math/vec3.h"
#include <clast/field.h>
#include <clast/shape.h>
#include <clast/state.h>
#include <clast/table.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

const char *clx_export_unit(const clast_assembly *assembly)
{
    return assembly->unit[0] != '\0' ? assembly->unit : "model";
}

/// Unit quaternion of a rotation matrix, by its greatest component. [Shepperd1978]
static void matrix_quaternion(double m[3][3], double q[4])
{
    const double four[4] = {1.0 + m[0][0] + m[1][1] + m[2][2], 1.0 + m[0][0] - m[1][1] - m[2][2],
                            1.0 - m[0][0] + m[1][1] - m[2][2], 1.0 - m[0][0] - m[1][1] + m[2][2]};
    int best = 0;
    for (int k = 1; k < 4; ++k) {
        best = four[k] > four[best] ? k : best;
    }
    const double sums[4][4] = {{four[0], m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]},
                               {m[2][1] - m[1][2], four[1], m[0][1] + m[1][0], m[0][2] + m[2][0]},
                               {m[0][2] - m[2][0], m[0][1] + m[1][0], four[2], m[1][2] + m[2][1]},
                               {m[1][0] - m[0][1], m[0][2] + m[2][0], m[1][2] + m[2][1], four[3]}};
    memcpy(q, sums[best], sizeof sums[best]);
    q_unit(q);
}

/// Semi-axes and orientation of the ellipsoid with a shape's volume and moments: `turn` takes the
/// ellipsoid's frame, a >= b >= c along x, y, z, to the shape's.
static void shape_ellipsoid(const clast_shape *shape, double semi_axes[3], double rotation[4])
{
    double c[3][3];
    double value[3];
    double axis[3][3];
    double m[3][3];
    const double half = 0.5 * (shape->inertia[0][0] + shape->inertia[1][1] + shape->inertia[2][2]);
    v3_copy(semi_axes, shape->semi_axes);
    if (shape->kind == CLAST_SHAPE_SPHERE || shape->kind == CLAST_SHAPE_ELLIPSOID) {
        rotation[0] = 1.0; // along x, y, z already
        rotation[1] = rotation[2] = rotation[3] = 0.0;
        return;
    }
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            c[i][j] = (i == j ? half : 0.0) - shape->inertia[i][j];
        }
    }
    clx_sym3_eigen(c, value, axis);
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            m[i][k] = axis[k][i];
        }
    }
    matrix_quaternion(m, rotation);
}

/// Adds a number column called `name`, or name_unit for lengths to the given power.
static clast_status add_quantity(clast_table *table, const char *name, const char *unit, int power,
                                 double **into)
{
    char title[64];
    char text[32] = "-";
    if (power > 0) {
        (void)snprintf(title, sizeof title, power == 1 ? "%s_%s" : "%s_%s%d", name, unit, power);
        (void)snprintf(text, sizeof text, power == 1 ? "%s" : "%s^%d", unit, power);
    } else {
        (void)snprintf(title, sizeof title, "%s", name);
    }
    return clast_table_add_number(table, title, text, into);
}

static clast_status add_poses(const clast_assembly *a, const char *unit, clast_table *table)
{
    static const char *const axes[3] = {"x", "y", "z"};
    static const char *const quaternion[4] = {"qw", "qx", "qy", "qz"};
    clast_status status = CLAST_OK;
    double *into = NULL;
    for (int k = 0; k < 3; ++k) {
        CLX_TRY(add_quantity(table, axes[k], unit, 1, &into));
        for (int32_t i = 0; i < a->n_grain; ++i) {
            into[i] = a->position[i][k];
        }
    }
    for (int k = 0; k < 4; ++k) {
        CLX_TRY(add_quantity(table, quaternion[k], unit, 0, &into));
        for (int32_t i = 0; i < a->n_grain; ++i) {
            into[i] = a->orientation[i][k];
        }
    }
done:
    return status;
}

typedef enum { SCALE, LENGTH, VOLUME, DENSITY, MASS } measure;

static double measure_of(const clast_assembly *a, int32_t i, measure what)
{
    const clast_shape *shape = &a->shape[a->shape_id[i]];
    const double s = a->scale[i];
    switch (what) {
    case SCALE:
        return s;
    case LENGTH:
        return s * shape->length;
    case VOLUME:
        return s * s * s * shape->volume;
    case DENSITY:
        return a->density[i];
    case MASS:
        return s * s * s * shape->volume * a->density[i];
    }
    return 0.0;
}

static clast_status add_measures(const clast_assembly *a, const char *unit, clast_table *table)
{
    static const struct {
        const char *name;
        int power;
        measure what;
    } measures[] = {{"scale", 0, SCALE}, {"length", 1, LENGTH}, {"volume", 3, VOLUME}};
    clast_status status = CLAST_OK;
    double *into = NULL;
    for (size_t k = 0; k < sizeof measures / sizeof measures[0]; ++k) {
        CLX_TRY(add_quantity(table, measures[k].name, unit, measures[k].power, &into));
        for (int32_t i = 0; i < a->n_grain; ++i) {
            into[i] = measure_of(a, i, measures[k].what);
        }
    }
    if (!clx_has_density(a)) {
        return CLAST_OK;
    }
    CLX_TRY(clast_table_add_number(table, "density_kg/m^3", "kg/m^3", &into));
    for (int32_t i = 0; i < a->n_grain; ++i) {
        into[i] = measure_of(a, i, DENSITY);
    }
    if (strcmp(unit, "model") != 0) {
        double metre = 0.0;
        CLX_TRY(clast_unit_factor(unit, "m", &metre));
        CLX_TRY(clast_table_add_number(table, "mass_kg", "kg", &into));
        for (int32_t i = 0; i < a->n_grain; ++i) {
            into[i] = metre * metre * metre * measure_of(a, i, MASS);
        }
    }
done:
    return status;
}

static clast_status add_contacts(const clast_assembly *a, clast_table *table)
{
    double *into = NULL;
    if (a->contact == NULL) {
        return CLAST_OK;
    }
    const clast_status status = clast_table_add_number(table, "n_contact", "-", &into);
    for (int32_t c = 0; status == CLAST_OK && c < a->n_contact; ++c) {
        into[a->contact[c][0]] += 1.0;
        into[a->contact[c][1]] += 1.0;
    }
    return status;
}

clast_status clast_assembly_table(const clast_assembly *assembly, clast_table *table)
{
    CLX_ARGUMENTS(assembly, table);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    clast_table made = {0};
    double *id = NULL;
    const char *unit = clx_export_unit(assembly);
    CLX_TRY(clast_table_init(&made, "grains", assembly->n_grain));
    CLX_TRY(clast_table_add_number(&made, "id", "-", &id));
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        id[i] = (double)assembly->id[i];
    }
    CLX_TRY(clast_table_add_text(&made, "shape"));
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        CLX_TRY(clast_table_set_text(&made, 1, i, assembly->shape[assembly->shape_id[i]].name));
    }
    CLX_TRY(add_poses(assembly, unit, &made));
    CLX_TRY(add_measures(assembly, unit, &made));
    CLX_TRY(add_contacts(assembly, &made));
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}

void clx_export_numbers(clx_file *file, const double *x, int n)
{
    for (int k = 0; k < n; ++k) {
        char text[1 + CLX_NUMBER_SIZE] = " ";
        const int length = clx_number_format(x[k], text + 1);
        (void)clx_file_write(file, text, (size_t)length + 1);
    }
}

int32_t clx_export_id_offset(const clast_assembly *a)
{
    int32_t i = 0;
    while (a->has_ids && i < a->n_grain && a->id[i] > 0) {
        ++i;
    }
    return a->has_ids && i == a->n_grain ? 0 : 1;
}

/// Greatest type of LAMMPS that a name "type-K" or "type-K-N" may have.
enum { MOST_TYPES = 1000000 };

/// K of a name "type-K" or "type-K-N", as the readers of LAMMPS's files give it; 0 for others.
static int32_t type_in(const char *name)
{
    int32_t number = 0;
    const char *at = name + 5;
    if (strncmp(name, "type-", 5) != 0) {
        return 0;
    }
    for (; *at >= '0' && *at <= '9' && number < MOST_TYPES; ++at) {
        number = 10 * number + (*at - '0');
    }
    return number <= MOST_TYPES && (*at == '\0' || *at == '-') ? number : 0;
}

clast_status clx_export_types(const clast_assembly *a, int32_t **type)
{
    clast_status status = CLAST_OK;
    bool has_types = true;
    CLX_TRY(clx_alloc(type, a->n_shape, sizeof **type));
    for (int32_t i = 0; i < a->n_shape; ++i) {
        (*type)[i] = type_in(a->shape[i].name);
        has_types = has_types && (*type)[i] > 0;
    }
    for (int32_t i = 0; i < a->n_shape && !has_types; ++i) {
        (*type)[i] = i + 1;
    }
done:
    return status;
}

bool clx_is_stood_for(const clast_shape *shape)
{
    return shape->kind != CLAST_SHAPE_SPHERE && shape->kind != CLAST_SHAPE_ELLIPSOID;
}

double clx_ellipsoid_ratio(const clast_shape *shape)
{
    const double *s = shape->semi_axes;
    const double volume = 4.0 / 3.0 * CLAST_PI * s[0] * s[1] * s[2];
    return clx_is_stood_for(shape) ? volume / shape->volume : 1.0;
}

void clx_export_ellipsoid(const clast_assembly *a, int32_t i, double diameter[3], double q[4])
{
    double axes[3];
    double rotation[4];
    CLAST_ASSERT(i >= 0 && i < a->n_grain);
    shape_ellipsoid(&a->shape[a->shape_id[i]], axes, rotation);
    q_mul(q, a->orientation[i], rotation);
    v3_scale(diameter, 2.0 * a->scale[i], axes);
}

/// BOX BOUNDS hold what a tilt adds to them.                      [LAMMPS manual, Howto_triclinic]
static void write_bounds(clx_file *file, const clast_packing_frame *f)
{
    const double *t = f->tilt;
    const bool is_tilted = t[0] != 0.0 || t[1] != 0.0 || t[2] != 0.0;
    const double below[3] = {fmin(fmin(0.0, t[0] + t[1]), fmin(t[0], t[1])), fmin(0.0, t[2]), 0.0};
    const double above[3] = {fmax(fmax(0.0, t[0] + t[1]), fmax(t[0], t[1])), fmax(0.0, t[2]), 0.0};
    (void)clx_file_print(file, "ITEM: BOX BOUNDS%s", is_tilted ? " xy xz yz" : "");
    for (int k = 0; k < 3; ++k) {
        (void)clx_file_print(file, f->is_periodic[k] ? " pp" : " ff");
    }
    (void)clx_file_print(file, "\n");
    for (int k = 0; k < 3; ++k) {
        char text[3][CLX_NUMBER_SIZE];
        (void)clx_number_format(f->low[k] + below[k], text[0]);
        (void)clx_number_format(f->high[k] + above[k], text[1]);
        (void)clx_number_format(t[k], text[2]);
        (void)clx_file_print(file, "%s %s%s%s\n", text[0], text[1], is_tilted ? " " : "",
                             is_tilted ? text[2] : "");
    }
}

static void write_dump_head(clx_export *e)
{
    clx_file *file = &e->file;
    clast_packing_frame frame;
    clx_export_box(e, &frame);
    if (strcmp(e->unit, "m") == 0) { // LAMMPS's word for metre, kilogram, second
        (void)clx_file_print(file, "ITEM: UNITS\nsi\n");
    }
    (void)clx_file_print(file, "ITEM: TIMESTEP\n%" PRId64 "\nITEM: NUMBER OF ATOMS\n%d\n",
                         frame.step > 0 ? frame.step : 0, e->assembly->n_grain);
    write_bounds(file, &frame);
    (void)clx_file_print(file,
                         "ITEM: ATOMS id type x y z quatw quati quatj quatk shapex shapey "
                         "shapez radius%s\n",
                         e->has_density ? " density" : "");
}

/// LAMMPS: shapex, shapey, shapez are the diameters of an ellipsoid, radius is that of the sphere
/// of its volume; types count from 1, and so do ids but for those of a file. The density of an
/// ellipsoid that stands for another shape gives the grain's mass, and with it its moments.
clast_status clx_export_dump(clx_export *e)
{
    clast_status status = CLAST_OK;
    const clast_assembly *a = e->assembly;
    clx_file *file = &e->file;
    int32_t *type = NULL;
    const int32_t offset = clx_export_id_offset(a);
    write_dump_head(e);
    CLX_TRY(clx_export_types(a, &type));
    for (int32_t i = 0; i < a->n_grain; ++i) {
        const clast_shape *shape = &a->shape[a->shape_id[i]];
        double axes[3];
        double q[4];
        clx_export_ellipsoid(a, i, axes, q);
        const double radius =
            axes[0] == axes[2] ? 0.5 * axes[0] : 0.5 * cbrt(axes[0] * axes[1] * axes[2]);
        const double last[2] = {radius, a->density[i] / clx_ellipsoid_ratio(shape)};
        (void)clx_file_print(file, "%" PRId64 " %d", a->id[i] + offset, type[a->shape_id[i]]);
        clx_export_numbers(file, a->position[i], 3);
        clx_export_numbers(file, q, 4);
        clx_export_numbers(file, axes, 3);
        clx_export_numbers(file, last, e->has_density ? 2 : 1);
        CLX_TRY(clx_file_write(file, "\n", 1));
    }
done:
    clx_free(type);
    return status;
}
