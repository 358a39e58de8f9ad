// VTU: assemblies for ParaView and its like, as surfaces with cell data or as points with poses.
#include "io/export.h"

#include "io/vtk_array.h"
#include <clast/mesh.h>
#include <clast/shape.h>
#include <clast/state.h>
#include <clast/table.h>
#include <inttypes.h>

static void write_tail(clx_file *file)
{
    (void)clx_file_print(file, "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
}

/// A value a grain.
typedef union {
    double f64[4];
    int64_t i64;
    int32_t i32;
} datum;

typedef struct {
    const char *type, *name;
    int components;
    int32_t size; ///< bytes of all components
    void (*value)(const clast_assembly *assembly, int32_t i, datum *out);
} property;

static void value_id(const clast_assembly *a, int32_t i, datum *out)
{
    out->i64 = a->id[i];
}

static void value_order(const clast_assembly *a, int32_t i, datum *out)
{
    (void)a;
    out->i32 = i;
}

static void value_shape(const clast_assembly *a, int32_t i, datum *out)
{
    CLAST_ASSERT(i >= 0 && i < a->n_grain);
    out->i32 = a->shape_id[i];
}

static void value_size(const clast_assembly *a, int32_t i, datum *out)
{
    out->f64[0] = a->scale[i] * a->shape[a->shape_id[i]].length;
}

static void value_scale(const clast_assembly *a, int32_t i, datum *out)
{
    out->f64[0] = a->scale[i];
}

static void value_density(const clast_assembly *a, int32_t i, datum *out)
{
    out->f64[0] = a->density[i];
}

static void value_position(const clast_assembly *a, int32_t i, datum *out)
{
    for (int k = 0; k < 3; ++k) {
        out->f64[k] = a->position[i][k];
    }
}

static void value_orientation(const clast_assembly *a, int32_t i, datum *out)
{
    for (int k = 0; k < 4; ++k) {
        out->f64[k] = a->orientation[i][k];
    }
}

static const property common[] = {
    {"Int64", "grain", 1, 8, value_id},
    {"Int32", "order", 1, 4, value_order},
    {"Int32", "shape", 1, 4, value_shape},
    {"Float64", "size", 1, 8, value_size},
};
static const property of_points[] = {
    {"Float64", "scale", 1, 8, value_scale},
    {"Float64", "density", 1, 8, value_density},
    {"Float64", "orientation_wxyz", 4, 32, value_orientation},
};

/// Grains of a file of surfaces as they are placed, which its triangles do not tell.
static const property of_field[] = {
    {"Int64", "grain", 1, 8, value_id},
    {"Int32", "shape", 1, 4, value_shape},
    {"Float64", "scale", 1, 8, value_scale},
    {"Float64", "density", 1, 8, value_density},
    {"Float64", "position", 3, 24, value_position},
    {"Float64", "orientation_wxyz", 4, 32, value_orientation},
};

typedef enum { ONCE, EACH_TRIANGLE, IN_FIELD } place;

/// One property of every grain.
static clast_status write_property(clx_export *e, clx_vtk_array *array, const property *p, place at)
{
    clast_status status = CLAST_OK;
    const clast_assembly *a = e->assembly;
    if (p->value == value_density && !e->has_density) {
        return CLAST_OK;
    }
    for (int32_t i = 0; i < a->n_grain; ++i) {
        datum bytes;
        const int32_t n = at == EACH_TRIANGLE ? e->parts.surface[a->shape_id[i]].n_tri : 1;
        p->value(a, i, &bytes);
        for (int32_t t = 0; t < n; ++t) {
            CLX_TRY(clx_vtk_add(array, &bytes, p->size));
        }
    }
    if (at == IN_FIELD) {
        return clx_vtk_end_field(array, &e->file, p->type, p->name, p->components, a->n_grain);
    }
    CLX_TRY(clx_vtk_end(array, &e->file, p->type, p->name, p->components));
done:
    return status;
}

/// The caller's numbers of the grains, likewise.
static clast_status write_values(clx_export *e, clx_vtk_array *array, bool per_triangle)
{
    clast_status status = CLAST_OK;
    const clast_table *values = e->options->values;
    for (int32_t c = 0; values != NULL && c < values->n_column; ++c) {
        const double *number = values->column[c].number;
        for (int32_t i = 0; number != NULL && i < e->assembly->n_grain; ++i) {
            const int32_t shape = e->assembly->shape_id[i];
            const int32_t n = per_triangle ? e->parts.surface[shape].n_tri : 1;
            for (int32_t t = 0; t < n; ++t) {
                CLX_TRY(clx_vtk_add(array, &number[i], sizeof number[i]));
            }
        }
        if (number != NULL) {
            CLX_TRY(clx_vtk_end(array, &e->file, "Float64", values->column[c].name, 1));
        }
    }
done:
    return status;
}

static const char *shape_name(const void *assembly, int32_t i)
{
    const clast_assembly *a = assembly;
    return a->shape[i].name;
}

/// Unit, names of the shapes, and how each grain is placed.
static clast_status write_head(clx_export *e, clx_vtk_array *array, int64_t n_point, int64_t n_cell,
                               bool has_poses)
{
    clast_status status = CLAST_OK;
    clx_vtk_head(&e->file, "UnstructuredGrid");
    (void)clx_file_print(&e->file, "<FieldData>");
    for (size_t k = 0; has_poses && k < sizeof of_field / sizeof of_field[0]; ++k) {
        CLX_TRY(write_property(e, array, &of_field[k], IN_FIELD));
    }
    clx_vtk_field_text(&e->file, "unit", e->unit);
    clx_vtk_field_texts(&e->file, "shape_names", e->assembly->n_shape, shape_name, e->assembly);
    (void)clx_file_print(&e->file, "</FieldData>\n");
    (void)clx_file_print(&e->file,
                         "<Piece NumberOfPoints=\"%" PRId64 "\" NumberOfCells=\"%" PRId64 "\">\n",
                         n_point, n_cell);
done:
    return status;
}

static clast_status write_surface_points(clx_export *e, clx_vtk_array *array)
{
    clast_status status = CLAST_OK;
    for (int32_t i = 0; i < e->assembly->n_grain; ++i) {
        const clast_mesh placed = clx_parts_place(&e->parts, i);
        CLX_TRY(clx_vtk_add(array, placed.vert, placed.n_vert * (int64_t)sizeof *placed.vert));
    }
    (void)clx_file_print(&e->file, "<Points>\n");
    CLX_TRY(clx_vtk_end(array, &e->file, "Float64", "Points", 3));
    (void)clx_file_print(&e->file, "</Points>\n");
done:
    return status;
}

static clast_status write_connectivity(clx_export *e, clx_vtk_array *array)
{
    clast_status status = CLAST_OK;
    int64_t first = 0;
    for (int32_t i = 0; i < e->assembly->n_grain; ++i) {
        const clast_mesh *surface = &e->parts.surface[e->assembly->shape_id[i]];
        for (int32_t t = 0; t < surface->n_tri; ++t) {
            const int32_t *tri = surface->tri[t];
            const int64_t corner[3] = {first + tri[0], first + tri[1], first + tri[2]};
            CLX_TRY(clx_vtk_add(array, corner, sizeof corner));
        }
        first += surface->n_vert;
    }
    CLX_TRY(clx_vtk_end(array, &e->file, "Int64", "connectivity", 1));
done:
    return status;
}

/// Ends of the cells and their VTK type: n cells of `corners` corners each.
static clast_status write_cells(clx_export *e, clx_vtk_array *array, int64_t n, int64_t corners,
                                uint8_t type)
{
    clast_status status = CLAST_OK;
    for (int64_t i = 1; i <= n; ++i) {
        const int64_t end = i * corners;
        CLX_TRY(clx_vtk_add(array, &end, sizeof end));
    }
    CLX_TRY(clx_vtk_end(array, &e->file, "Int64", "offsets", 1));
    for (int64_t i = 0; i < n; ++i) {
        CLX_TRY(clx_vtk_add(array, &type, 1));
    }
    CLX_TRY(clx_vtk_end(array, &e->file, "UInt8", "types", 1));
    (void)clx_file_print(&e->file, "</Cells>\n");
done:
    return status;
}

clast_status clx_export_vtu_surfaces(clx_export *e)
{
    enum { VTK_TRIANGLE = 5 };
    clast_status status = CLAST_OK;
    clx_vtk_array array = {0};
    CLX_TRY(clx_vtk_begin(&array));
    CLX_TRY(write_head(e, &array, e->parts.n_vert, e->parts.n_tri, true));
    CLX_TRY(write_surface_points(e, &array));
    (void)clx_file_print(&e->file, "<Cells>\n");
    CLX_TRY(write_connectivity(e, &array));
    CLX_TRY(write_cells(e, &array, e->parts.n_tri, 3, VTK_TRIANGLE));
    (void)clx_file_print(&e->file, "<CellData>\n");
    for (size_t k = 0; k < sizeof common / sizeof common[0]; ++k) {
        CLX_TRY(write_property(e, &array, &common[k], EACH_TRIANGLE));
    }
    CLX_TRY(write_values(e, &array, true));
    (void)clx_file_print(&e->file, "</CellData>\n");
    write_tail(&e->file);
done:
    clx_vtk_free(&array);
    return status;
}

static clast_status write_grain_points(clx_export *e, clx_vtk_array *array)
{
    clast_status status = CLAST_OK;
    const int32_t n = e->assembly->n_grain;
    (void)clx_file_print(&e->file, "<Points>\n");
    CLX_TRY(clx_vtk_add(array, e->assembly->position, n * (int64_t)sizeof *e->assembly->position));
    CLX_TRY(clx_vtk_end(array, &e->file, "Float64", "Points", 3));
    (void)clx_file_print(&e->file, "</Points>\n<Cells>\n");
    for (int64_t i = 0; i < n; ++i) {
        CLX_TRY(clx_vtk_add(array, &i, sizeof i));
    }
    CLX_TRY(clx_vtk_end(array, &e->file, "Int64", "connectivity", 1));
done:
    return status;
}

clast_status clx_export_vtu_points(clx_export *e)
{
    enum { VTK_VERTEX = 1 };
    clast_status status = CLAST_OK;
    clx_vtk_array array = {0};
    const int32_t n = e->assembly->n_grain;
    CLX_TRY(clx_vtk_begin(&array));
    CLX_TRY(write_head(e, &array, n, n, false));
    CLX_TRY(write_grain_points(e, &array));
    CLX_TRY(write_cells(e, &array, n, 1, VTK_VERTEX));
    (void)clx_file_print(&e->file, "<PointData>\n");
    for (size_t k = 0; k < sizeof common / sizeof common[0]; ++k) {
        CLX_TRY(write_property(e, &array, &common[k], ONCE));
    }
    for (size_t k = 0; k < sizeof of_points / sizeof of_points[0]; ++k) {
        CLX_TRY(write_property(e, &array, &of_points[k], ONCE));
    }
    CLX_TRY(write_values(e, &array, false));
    (void)clx_file_print(&e->file, "</PointData>\n");
    write_tail(&e->file);
done:
    clx_vtk_free(&array);
    return status;
}
