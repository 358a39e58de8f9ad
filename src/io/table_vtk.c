// Tables as VTK's XML files: rows that are cells of an even grid (VTI), rows that are lines (VTP).
// [VTK file formats, "XML file formats"]
#include <clast/table.h>

#include "base/file.h"
#include "base/number.h"
#include "base/status.h"
#include "io/vtk_array.h"
#include <inttypes.h>
#include <math.h>
#include <string.h>

/// The column of numbers named `name`, or that with a unit behind it; CLAST_E_USAGE without one.
static clast_status find(const clast_table *table, const char *name, const clast_column **column)
{
    const size_t n = strlen(name);
    for (int32_t c = 0; c < table->n_column; ++c) {
        const char *at = table->column[c].name;
        if (table->column[c].number != NULL && strncmp(at, name, n) == 0 &&
            (at[n] == '\0' || at[n] == '_')) {
            *column = &table->column[c];
            return CLAST_OK;
        }
    }
    return clx_fail(CLAST_E_USAGE, "table '%s' has no column %s of numbers", table->name, name);
}

static clast_status find_all(const clast_table *table, int n, const char *const *name,
                             const clast_column **column)
{
    clast_status status = CLAST_OK;
    for (int k = 0; k < n; ++k) {
        CLX_TRY(find(table, name[k], &column[k]));
    }
done:
    return status;
}

/// A name that XML takes as it is.
static void plain_name(const char *name, char out[64])
{
    size_t n = 0;
    for (; name[n] != '\0' && n < 63; ++n) {
        out[n] = strchr("<>&\"'", name[n]) != NULL ? '_' : name[n];
    }
    out[n] = '\0';
}

/// Every column of numbers but those that say where.
static clast_status write_data(clx_file *file, clx_vtk_array *array, const clast_table *table,
                               int n_place, const clast_column *const *place)
{
    clast_status status = CLAST_OK;
    (void)clx_file_print(file, "<CellData>\n");
    for (int32_t c = 0; c < table->n_column; ++c) {
        const clast_column *column = &table->column[c];
        bool is_place = column->number == NULL;
        for (int k = 0; k < n_place; ++k) {
            is_place = is_place || place[k] == column;
        }
        if (!is_place) {
            char plain[64];
            plain_name(column->name, plain);
            CLX_TRY(
                clx_vtk_add(array, column->number, table->n_row * (int64_t)sizeof *column->number));
            CLX_TRY(clx_vtk_end(array, file, "Float64", plain, 1));
        }
    }
    (void)clx_file_print(file, "</CellData>\n");
done:
    return status;
}

/// An even grid: the middle of its first cell, steps, counts.
typedef struct {
    double first[3], step[3];
    int64_t n[3];
} grid;

/// Rows until a coordinate comes back, in units of `stride` rows.
static int64_t count_along(const double *x, int64_t n_row, int64_t stride)
{
    int64_t n = 1;
    while (n * stride < n_row && x[n * stride] > x[(n - 1) * stride]) {
        ++n;
    }
    return n;
}

static clast_status find_grid(const clast_table *table, const clast_column *const place[6], grid *g)
{
    clast_status status = CLAST_OK;
    int64_t stride = 1;
    CLX_CHECK(table->n_row > 0, CLAST_E_USAGE, "table '%s' has no rows", table->name);
    for (int k = 0; k < 3; ++k) {
        g->first[k] = place[k]->number[0];
        g->step[k] = place[3 + k]->number[0];
        g->n[k] = count_along(place[k]->number, table->n_row, stride);
        stride *= g->n[k];
    }
    bool is_even = stride == table->n_row;
    for (int64_t i = 0; i < table->n_row && is_even; ++i) {
        const int64_t at[3] = {i % g->n[0], i / g->n[0] % g->n[1], i / (g->n[0] * g->n[1])};
        for (int k = 0; k < 3; ++k) {
            const double x = g->first[k] + (double)at[k] * g->step[k];
            is_even = is_even && fabs(place[k]->number[i] - x) <= 1e-6 * g->step[k];
        }
    }
    CLX_CHECK(is_even, CLAST_E_USAGE,
              "table '%s' is not a uniform grid, x fastest, of %" PRId64 " rows", table->name,
              table->n_row);
done:
    return status;
}

clast_status clast_table_write_vti(const clast_table *table, const char *path)
{
    CLX_ARGUMENTS(table, path);
    CLX_WHOLE(table, table);
    static const char *const name[6] = {"x", "y", "z", "dx", "dy", "dz"};
    clast_status status = CLAST_OK;
    const clast_column *place[6] = {NULL};
    grid g = {0};
    clx_file file = {0};
    clx_vtk_array array = {0};
    char low[3][CLX_NUMBER_SIZE];
    char step[3][CLX_NUMBER_SIZE];
    CLX_TRY(find_all(table, 6, name, place));
    CLX_TRY(find_grid(table, place, &g));
    for (int k = 0; k < 3; ++k) {
        (void)clx_number_format(g.first[k] - 0.5 * g.step[k], low[k]);
        (void)clx_number_format(g.step[k], step[k]);
    }
    CLX_TRY(clx_file_begin(path, &file));
    CLX_TRY(clx_vtk_begin(&array));
    clx_vtk_open(&file, "ImageData");
    (void)clx_file_print(&file,
                         "<ImageData WholeExtent=\"0 %" PRId64 " 0 %" PRId64 " 0 %" PRId64
                         "\" Origin=\"%s %s %s\" Spacing=\"%s %s %s\">\n"
                         "<Piece Extent=\"0 %" PRId64 " 0 %" PRId64 " 0 %" PRId64 "\">\n",
                         g.n[0], g.n[1], g.n[2], low[0], low[1], low[2], step[0], step[1], step[2],
                         g.n[0], g.n[1], g.n[2]);
    CLX_TRY(write_data(&file, &array, table, 6, place));
    (void)clx_file_print(&file, "</Piece>\n</ImageData>\n</VTKFile>\n");
    CLX_TRY(clx_file_commit(&file));
done:
    clx_vtk_free(&array);
    clx_file_abandon(&file);
    return status;
}

static clast_status write_lines(clx_file *file, clx_vtk_array *array, int64_t n,
                                const clast_column *const place[6])
{
    clast_status status = CLAST_OK;
    (void)clx_file_print(file, "<Points>\n");
    for (int64_t i = 0; i < n; ++i) {
        for (int k = 0; k < 6; ++k) {
            CLX_TRY(clx_vtk_add(array, &place[k]->number[i], sizeof *place[k]->number));
        }
    }
    CLX_TRY(clx_vtk_end(array, file, "Float64", "Points", 3));
    (void)clx_file_print(file, "</Points>\n<Lines>\n");
    for (int64_t i = 0; i < 2 * n; ++i) {
        CLX_TRY(clx_vtk_add(array, &i, sizeof i));
    }
    CLX_TRY(clx_vtk_end(array, file, "Int64", "connectivity", 1));
    for (int64_t i = 1; i <= n; ++i) {
        const int64_t end = 2 * i;
        CLX_TRY(clx_vtk_add(array, &end, sizeof end));
    }
    CLX_TRY(clx_vtk_end(array, file, "Int64", "offsets", 1));
    (void)clx_file_print(file, "</Lines>\n");
done:
    return status;
}

clast_status clast_table_write_vtp(const clast_table *table, const char *path)
{
    CLX_ARGUMENTS(table, path);
    CLX_WHOLE(table, table);
    static const char *const name[6] = {"x0", "y0", "z0", "x1", "y1", "z1"};
    clast_status status = CLAST_OK;
    const clast_column *place[6] = {NULL};
    clx_file file = {0};
    clx_vtk_array array = {0};
    CLX_TRY(find_all(table, 6, name, place));
    CLX_TRY(clx_file_begin(path, &file));
    CLX_TRY(clx_vtk_begin(&array));
    clx_vtk_head(&file, "PolyData");
    (void)clx_file_print(&file,
                         "<Piece NumberOfPoints=\"%" PRId64
                         "\" NumberOfVerts=\"0\" NumberOfLines=\"%" PRId64
                         "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
                         2 * table->n_row, table->n_row);
    CLX_TRY(write_lines(&file, &array, table->n_row, place));
    CLX_TRY(write_data(&file, &array, table, 6, place));
    (void)clx_file_print(&file, "</Piece>\n</PolyData>\n</VTKFile>\n");
    CLX_TRY(clx_file_commit(&file));
done:
    clx_vtk_free(&array);
    clx_file_abandon(&file);
    return status;
}
