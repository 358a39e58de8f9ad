// Packings for other programs: LAMMPS data files, YADE's text, voro++, .xyzd. What is written here
// is read back by io/packing_file.c, spheres and ellipsoids to the last digit.
#include "io/export.h"

#include "base/alloc.h"
#include "base/number.h"
#include "io/bytes.h"
#include "math/vec3.h"
#include <clast/assembly.h>
#include <clast/shape.h>
#include <clast/state.h>
#include <inttypes.h>
#include <stdio.h>

static bool is_kind(const clast_assembly *a, int32_t i, clast_shape_kind kind)
{
    CLAST_ASSERT(i >= 0 && i < a->n_grain);
    return a->shape[a->shape_id[i]].kind == kind;
}

static bool are_spheres(const clast_assembly *a)
{
    int32_t i = 0;
    while (i < a->n_grain && is_kind(a, i, CLAST_SHAPE_SPHERE)) {
        ++i;
    }
    return i == a->n_grain;
}

static clast_status need_spheres(const clx_export *e, const char *format)
{
    const clast_assembly *a = e->assembly;
    for (int32_t i = 0; i < a->n_grain; ++i) {
        if (!is_kind(a, i, CLAST_SHAPE_SPHERE)) {
            return clx_fail(CLAST_E_USAGE,
                            "%s: %s holds spheres, and grain %d is a %s; write .csv, .dump or "
                            ".data",
                            e->file.path, format, i, a->shape[a->shape_id[i]].name);
        }
    }
    return CLAST_OK;
}

static double radius_of(const clast_assembly *a, int32_t i)
{
    return a->scale[i] * a->shape[a->shape_id[i]].semi_axes[0];
}

/// "low high xlo xhi" of each axis, and "xy xz yz" of a box that is tilted.
static void write_box(clx_file *file, const clast_packing_frame *frame)
{
    static const char axis[3] = {'x', 'y', 'z'};
    const double *tilt = frame->tilt;
    for (int k = 0; k < 3; ++k) {
        char text[2][CLX_NUMBER_SIZE];
        (void)clx_number_format(frame->low[k], text[0]);
        (void)clx_number_format(frame->high[k], text[1]);
        (void)clx_file_print(file, "%s %s %clo %chi\n", text[0], text[1], axis[k], axis[k]);
    }
    if (tilt[0] != 0.0 || tilt[1] != 0.0 || tilt[2] != 0.0) {
        char text[3][CLX_NUMBER_SIZE];
        for (int k = 0; k < 3; ++k) {
            (void)clx_number_format(tilt[k], text[k]);
        }
        (void)clx_file_print(file, "%s %s %s xy xz yz\n", text[0], text[1], text[2]);
    }
}

/// First line, counts and box. LAMMPS has the boundary from its input, so the first line tells it.
static void write_data_head(clx_export *e, int32_t n_type, bool is_sphere)
{
    const clast_assembly *a = e->assembly;
    clx_file *file = &e->file;
    clast_packing_frame frame;
    clx_export_box(e, &frame);
    const bool *p = frame.is_periodic;
    (void)clx_file_print(
        file, "# LAMMPS data file written by clast: lengths in %s, densities in kg/m^3", e->unit);
    if (p[0] || p[1] || p[2]) {
        (void)clx_file_print(file, ", boundary %s %s %s", p[0] ? "p" : "f", p[1] ? "p" : "f",
                             p[2] ? "p" : "f");
    }
    (void)clx_file_print(file, "\n\n%d atoms\n%d atom types\n", a->n_grain, n_type);
    if (!is_sphere) {
        (void)clx_file_print(file, "%d ellipsoids\n", a->n_grain);
    }
    (void)clx_file_print(file, "\n");
    write_box(file, &frame);
}

/// LAMMPS: the third column of an atom is a sphere's diameter, or 1 for one that is an ellipsoid.
clast_status clx_export_data(clx_export *e)
{
    clast_status status = CLAST_OK;
    const clast_assembly *a = e->assembly;
    clx_file *file = &e->file;
    int32_t *type = NULL;
    int32_t n_type = 1;
    const bool is_sphere = are_spheres(a);
    const int32_t offset = clx_export_id_offset(a);
    CLX_TRY(clx_export_types(a, &type));
    for (int32_t i = 0; i < a->n_grain; ++i) {
        n_type = type[a->shape_id[i]] > n_type ? type[a->shape_id[i]] : n_type;
    }
    write_data_head(e, n_type, is_sphere);
    (void)clx_file_print(file, "\nAtoms # %s\n\n", is_sphere ? "sphere" : "ellipsoid");
    for (int32_t i = 0; i < a->n_grain; ++i) {
        const double ratio = clx_ellipsoid_ratio(&a->shape[a->shape_id[i]]);
        const double size[2] = {is_sphere ? 2.0 * radius_of(a, i) : 1.0, a->density[i] / ratio};
        (void)clx_file_print(file, "%" PRId64 " %d", a->id[i] + offset, type[a->shape_id[i]]);
        clx_export_numbers(file, size, 2);
        clx_export_numbers(file, a->position[i], 3);
        CLX_TRY(clx_file_write(file, "\n", 1));
    }
    (void)clx_file_print(file, is_sphere ? "" : "\nEllipsoids\n\n");
    for (int32_t i = 0; i < a->n_grain && !is_sphere; ++i) {
        double axes[3];
        double q[4];
        clx_export_ellipsoid(a, i, axes, q);
        (void)clx_file_print(file, "%" PRId64, a->id[i] + offset);
        clx_export_numbers(file, axes, 3);
        clx_export_numbers(file, q, 4);
        CLX_TRY(clx_file_write(file, "\n", 1));
    }
done:
    clx_free(type);
    return status;
}

static clast_status write_sphere(clx_file *file, const double x[3], double radius, const char *end)
{
    const double value[4] = {x[0], x[1], x[2], radius};
    for (int k = 0; k < 4; ++k) {
        char text[CLX_NUMBER_SIZE];
        const int length = clx_number_format(value[k], text);
        (void)clx_file_write(file, "\t", k > 0 ? 1 : 0);
        (void)clx_file_write(file, text, (size_t)length);
    }
    return clx_file_print(file, "%s\n", end);
}

/// A clump's spheres, each with the number of its grain.
static clast_status write_clump(clx_file *file, const clast_assembly *a, int32_t i)
{
    clast_status status = CLAST_OK;
    const clast_spheres *s = &a->shape[a->shape_id[i]].spheres;
    char end[32];
    (void)snprintf(end, sizeof end, "\t%d", i);
    for (int32_t k = 0; k < s->n; ++k) {
        double x[3];
        q_rotate(x, a->orientation[i], s->centre[k]);
        v3_axpy(x, a->position[i], a->scale[i], x);
        CLX_TRY(write_sphere(file, x, a->scale[i] * s->radius[k], end));
    }
done:
    return status;
}

clast_status clx_export_text(clx_export *e)
{
    clast_status status = CLAST_OK;
    const clast_assembly *a = e->assembly;
    const bool is_sphere = are_spheres(a);
    (void)clx_file_print(&e->file, "#format x_y_z_r%s\n", is_sphere ? "" : "_clumpId");
    for (int32_t i = 0; i < a->n_grain; ++i) {
        if (is_kind(a, i, CLAST_SHAPE_SPHERE)) {
            CLX_TRY(
                write_sphere(&e->file, a->position[i], radius_of(a, i), is_sphere ? "" : "\t-1"));
            continue;
        }
        CLX_CHECK(is_kind(a, i, CLAST_SHAPE_CLUMP), CLAST_E_USAGE,
                  "%s: YADE's text holds spheres and clumps, and grain %d is a %s; write .csv, "
                  ".dump, .data or .conf",
                  e->file.path, i, a->shape[a->shape_id[i]].name);
        CLX_TRY(write_clump(&e->file, a, i));
    }
done:
    return status;
}

clast_status clx_export_voro(clx_export *e)
{
    clast_status status = CLAST_OK;
    const clast_assembly *a = e->assembly;
    const int32_t offset = clx_export_id_offset(a);
    CLX_TRY(need_spheres(e, "voro++'s text"));
    for (int32_t i = 0; i < a->n_grain; ++i) {
        const double radius = radius_of(a, i);
        (void)clx_file_print(&e->file, "%" PRId64, a->id[i] + offset);
        clx_export_numbers(&e->file, a->position[i], 3);
        clx_export_numbers(&e->file, &radius, 1);
        CLX_TRY(clx_file_write(&e->file, "\n", 1));
    }
done:
    return status;
}

clast_status clx_export_xyzd(clx_export *e)
{
    clast_status status = CLAST_OK;
    const clast_assembly *a = e->assembly;
    CLX_TRY(need_spheres(e, ".xyzd"));
    for (int32_t i = 0; i < a->n_grain; ++i) {
        const double value[4] = {a->position[i][0], a->position[i][1], a->position[i][2],
                                 2.0 * radius_of(a, i)};
        uint8_t bytes[32];
        for (int k = 0; k < 4; ++k) {
            clx_store_f64(bytes + 8 * k, value[k]);
        }
        CLX_TRY(clx_file_write(&e->file, bytes, sizeof bytes));
    }
done:
    return status;
}
