// Cells and points of a decomposition as VTU and VTP. [VTK file formats, "XML file formats"]
#include <clast/decompose.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/status.h"
#include "cloud/contract.h"
#include "cloud/surface.h"
#include "cloud/whole.h"
#include "io/vtk_array.h"
#include <inttypes.h>
#include <math.h>
#include <string.h>

/// Boxes of the unit cube, each with its cell.
typedef struct {
    int64_t n, capacity;
    double (*low)[3], (*high)[3];
    int32_t *cell;
} boxes;

static void free_boxes(boxes *b)
{
    CLX_FREE(b->low, b->high, b->cell);
}

static clast_status add_box(boxes *b, const double low[3], const double high[3], int32_t cell)
{
    clast_status status = CLAST_OK;
    if (b->n == b->capacity) {
        const int64_t capacity = 2 * b->capacity + 64;
        CLX_TRY(clx_realloc(&b->low, capacity, sizeof *b->low));
        CLX_TRY(clx_realloc(&b->high, capacity, sizeof *b->high));
        CLX_TRY(clx_realloc(&b->cell, capacity, sizeof *b->cell));
        b->capacity = capacity;
    }
    memcpy(b->low[b->n], low, sizeof b->low[0]);
    memcpy(b->high[b->n], high, sizeof b->high[0]);
    b->cell[b->n++] = cell;
done:
    return status;
}

/// Cuts a box so that curved faces are followed: angles at most every 10 degrees.
static clast_status add_cut(boxes *b, const clast_domain *domain, const double low[3],
                            const double high[3], int32_t cell)
{
    static const double most[6][3] = {{2.0, 2.0, 2.0},       {2.0, 1.0 / 36, 2.0},
                                      {2.0, 1.0 / 18, 2.0},  {0.25, 0.125, 1.0 / 36},
                                      {0.125, 0.125, 0.125}, {2.0, 2.0, 2.0}};
    clast_status status = CLAST_OK;
    int64_t n[3] = {1, 1, 1};
    for (int j = 0; j < domain->dimension && j < 3; ++j) {
        n[j] = (int64_t)ceil((high[j] - low[j]) / most[domain->kind][j] - 1e-9);
        n[j] = n[j] < 1 ? 1 : n[j];
    }
    for (int64_t k = 0; k < n[0] * n[1] * n[2]; ++k) {
        const int64_t at[3] = {k / (n[1] * n[2]), k / n[2] % n[1], k % n[2]};
        double from[3];
        double to[3];
        for (int j = 0; j < 3; ++j) {
            from[j] = low[j] + (high[j] - low[j]) * (double)at[j] / (double)n[j];
            to[j] = low[j] + (high[j] - low[j]) * (double)(at[j] + 1) / (double)n[j];
        }
        CLX_TRY(add_box(b, from, to, cell));
    }
done:
    return status;
}

/// The cell's box as shares of the unit cube.
static void unit_box(const clast_domain *domain, const double box[3], double u[3])
{
    for (int j = 0; j < 3; ++j) {
        const double side = domain->high[j] - domain->low[j];
        u[j] = clx_domain_is_boxed(domain) && j < domain->dimension
                   ? (box[j] - domain->low[j]) / side
                   : box[j];
    }
}

static clast_status gather_boxes(const clast_cells *cells, const clast_domain *domain, boxes *b)
{
    clast_status status = CLAST_OK;
    double low[3];
    double high[3];
    for (int32_t c = 0; c < cells->n && (cells->of_bin == NULL || cells->is_box); ++c) {
        unit_box(domain, cells->low[c], low);
        unit_box(domain, cells->high[c], high);
        CLX_TRY(add_cut(b, domain, low, high, c));
    }
    if (cells->of_bin == NULL || cells->is_box) {
        goto done;
    }
    const int32_t *nb = cells->nb;
    for (int64_t bin = 0; bin < (int64_t)nb[0] * nb[1] * nb[2]; ++bin) {
        int64_t rest = bin;
        if (cells->of_bin[bin] < 0) {
            continue;
        }
        memset(low, 0, sizeof low);
        memset(high, 0, sizeof high);
        for (int32_t j = domain->dimension - 1; j >= 0; --j) {
            low[j] = (double)(rest % nb[j]) / nb[j];
            high[j] = (double)(rest % nb[j] + 1) / nb[j];
            rest /= nb[j];
        }
        CLX_TRY(add_cut(b, domain, low, high, cells->of_bin[bin]));
    }
done:
    return status;
}

/// VTK's order of corners: bits of (x, y, z).
static const int corner_bits[8] = {0, 1, 3, 2, 4, 5, 7, 6};

static clast_status write_corners(clx_file *file, clx_vtk_array *array, const boxes *b,
                                  const clast_domain *domain)
{
    clast_status status = CLAST_OK;
    const int n_corner = 1 << domain->dimension;
    for (int64_t i = 0; i < b->n; ++i) {
        for (int k = 0; k < n_corner; ++k) {
            double u[3] = {0};
            double x[3] = {0};
            for (int j = 0; j < domain->dimension; ++j) {
                u[j] = (corner_bits[k] >> j & 1) != 0 ? b->high[i][j] : b->low[i][j];
            }
            clast_domain_unmap(domain, u, x);
            CLX_TRY(clx_vtk_add(array, x, sizeof x));
        }
    }
    (void)clx_file_print(file, "<Points>\n");
    CLX_TRY(clx_vtk_end(array, file, "Float64", "Points", 3));
    (void)clx_file_print(file, "</Points>\n");
done:
    return status;
}

static clast_status write_cells(clx_file *file, clx_vtk_array *array, int64_t n, int64_t n_corner,
                                uint8_t type)
{
    clast_status status = CLAST_OK;
    (void)clx_file_print(file, "<Cells>\n");
    for (int64_t i = 0; i < n * n_corner; ++i) {
        CLX_TRY(clx_vtk_add(array, &i, sizeof i));
    }
    CLX_TRY(clx_vtk_end(array, file, "Int64", "connectivity", 1));
    for (int64_t i = 1; i <= n; ++i) {
        const int64_t end = i * n_corner;
        CLX_TRY(clx_vtk_add(array, &end, sizeof end));
    }
    CLX_TRY(clx_vtk_end(array, file, "Int64", "offsets", 1));
    for (int64_t i = 0; i < n; ++i) {
        CLX_TRY(clx_vtk_add(array, &type, 1));
    }
    CLX_TRY(clx_vtk_end(array, file, "UInt8", "types", 1));
    (void)clx_file_print(file, "</Cells>\n");
done:
    return status;
}

/// What the numbers depend on.
static void write_fields(clx_file *file, const clast_decomposition *r, const clast_domain *domain)
{
    char text[CLAST_DOMAIN_TEXT];
    clast_domain_format(domain, text);
    (void)clx_file_print(file, "<FieldData>\n");
    clx_vtk_field_text(file, "unit", "m");
    clx_vtk_field_text(file, "domain", text);
    clx_vtk_field_number(file, "volume", r->volume);
    if (r->beta_dt > 0.0) {
        clx_vtk_field_number(file, "beta_dt", r->beta_dt);
    }
    if (r->has_drawn) {
        clx_vtk_field_number(file, "seed", (double)r->seed);
    }
    (void)clx_file_print(file, "\n</FieldData>\n");
}

static clast_status write_cell_data(clx_file *file, clx_vtk_array *array, const boxes *b,
                                    const clast_decomposition *r)
{
    const clast_cells *cells = &r->cells;
    const char *const name[7] = {
        "cell",  "count", "volume", "density", r->beta_dt > 0.0 ? "events" : "pair_integral",
        "label", "pass"};
    const int n = clast_cells_are_labelled(cells) ? 7 : 5;
    clast_status status = CLAST_OK;
    (void)clx_file_print(file, "<CellData>\n");
    for (int k = 0; k < n; ++k) {
        for (int64_t i = 0; i < b->n; ++i) {
            const int32_t c = b->cell[i];
            const double value[7] = {(double)c,
                                     (double)cells->count[c],
                                     cells->volume[c],
                                     (double)cells->count[c] / cells->volume[c],
                                     cells->events[c],
                                     (double)cells->label[c],
                                     (double)cells->pass[c]};
            CLX_TRY(clx_vtk_add(array, &value[k], sizeof value[k]));
        }
        CLX_TRY(clx_vtk_end(array, file, "Float64", name[k], 1));
    }
    (void)clx_file_print(file, "</CellData>\n");
done:
    return status;
}

clast_status clast_cells_write_vtu(const clast_decomposition *result, const clast_domain *domain,
                                   const char *path)
{
    CLX_ARGUMENTS(path, result, domain);
    CLX_WHOLE(decomposition, result);
    CLX_GUARD(clx_domain_check(domain));
    static const uint8_t type[4] = {1, 3, 9, 12}; // vertex, line, quadrilateral, hexahedron
    clast_status status = CLAST_OK;
    clx_file file = {0};
    clx_vtk_array array = {0};
    boxes b = {0};
    const int n_corner = 1 << domain->dimension;
    CLX_TRY(gather_boxes(&result->cells, domain, &b));
    CLX_CHECK(b.n < (INT64_C(1) << 31) / n_corner, CLAST_E_LIMIT,
              "%" PRId64 " cells are beyond a VTU file's 2^31 corners", b.n);
    CLX_TRY(clx_file_begin(path, &file));
    CLX_TRY(clx_vtk_begin(&array));
    clx_vtk_head(&file, "UnstructuredGrid");
    write_fields(&file, result, domain);
    (void)clx_file_print(&file,
                         "<Piece NumberOfPoints=\"%" PRId64 "\" NumberOfCells=\"%" PRId64 "\">\n",
                         b.n * n_corner, b.n);
    CLX_TRY(write_corners(&file, &array, &b, domain));
    CLX_TRY(write_cells(&file, &array, b.n, n_corner, type[domain->dimension]));
    CLX_TRY(write_cell_data(&file, &array, &b, result));
    (void)clx_file_print(&file, "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    CLX_TRY(clx_file_commit(&file));
done:
    clx_vtk_free(&array);
    clx_file_abandon(&file);
    free_boxes(&b);
    return status;
}

static clast_status write_positions(clx_file *file, clx_vtk_array *array, const clast_cloud *cloud)
{
    clast_status status = CLAST_OK;
    (void)clx_file_print(file, "<Points>\n");
    for (int64_t i = 0; i < cloud->n; ++i) {
        double x[3] = {0};
        memcpy(x, cloud->x + i * cloud->dimension, (size_t)cloud->dimension * sizeof *x);
        CLX_TRY(clx_vtk_add(array, x, sizeof x));
    }
    CLX_TRY(clx_vtk_end(array, file, "Float64", "Points", 3));
    (void)clx_file_print(file, "</Points>\n<Verts>\n");
    for (int64_t i = 0; i < cloud->n; ++i) {
        CLX_TRY(clx_vtk_add(array, &i, sizeof i));
    }
    CLX_TRY(clx_vtk_end(array, file, "Int64", "connectivity", 1));
    for (int64_t i = 1; i <= cloud->n; ++i) {
        CLX_TRY(clx_vtk_add(array, &i, sizeof i));
    }
    CLX_TRY(clx_vtk_end(array, file, "Int64", "offsets", 1));
    (void)clx_file_print(file, "</Verts>\n");
done:
    return status;
}

/// Number of the cell and, where cells have them, its label and its pass for each point.
static clast_status write_marks(clx_file *file, clx_vtk_array *array, int64_t n,
                                const clast_cells *cells)
{
    static const char *const name[3] = {"cell", "label", "pass"};
    clast_status status = CLAST_OK;
    for (int k = 0; k < (clast_cells_are_labelled(cells) ? 3 : 1); ++k) {
        for (int64_t i = 0; i < n; ++i) {
            const int32_t c = cells->of_point[i];
            const int32_t value = k == 0   ? c
                                  : c < 0  ? 0
                                  : k == 1 ? cells->label[c]
                                           : cells->pass[c];
            CLX_TRY(clx_vtk_add(array, &value, sizeof value));
        }
        CLX_TRY(clx_vtk_end(array, file, "Int32", name[k], 1));
    }
done:
    return status;
}

static clast_status write_properties(clx_file *file, clx_vtk_array *array, const clast_cloud *cloud)
{
    const struct {
        const char *name;
        const double *value;
        int width;
    } all[] = {{"radius", cloud->radius, 1},
               {"mass", cloud->mass, 1},
               {"weight", cloud->weight, 1},
               {"velocity", cloud->velocity, cloud->dimension}};
    clast_status status = CLAST_OK;
    for (size_t k = 0; k < sizeof all / sizeof all[0]; ++k) {
        if (all[k].value == NULL) {
            continue;
        }
        CLX_TRY(clx_vtk_add(array, all[k].value,
                            cloud->n * all[k].width * (int64_t)sizeof *all[k].value));
        CLX_TRY(clx_vtk_end(array, file, "Float64", all[k].name, all[k].width));
    }
done:
    return status;
}

clast_status clast_decomposition_write_points(const clast_decomposition *result,
                                              const clast_cloud *cloud, const clast_domain *domain,
                                              const char *path)
{
    CLX_ARGUMENTS(path, cloud, result);
    CLX_GUARD(clx_cloud_check(cloud));
    CLX_WHOLE(decomposition, result);
    if (result->n + result->n_outside != cloud->n) {
        return clx_fail(CLAST_E_ARGUMENT, "%s: the decomposition is not of this cloud", __func__);
    }
    clast_status status = CLAST_OK;
    clx_file file = {0};
    clx_vtk_array array = {0};
    CLX_TRY(clx_file_begin(path, &file));
    CLX_TRY(clx_vtk_begin(&array));
    clx_vtk_head(&file, "PolyData");
    write_fields(&file, result, domain);
    (void)clx_file_print(&file,
                         "<Piece NumberOfPoints=\"%" PRId64 "\" NumberOfVerts=\"%" PRId64
                         "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
                         cloud->n, cloud->n);
    CLX_TRY(write_positions(&file, &array, cloud));
    (void)clx_file_print(&file, "<PointData>\n");
    CLX_TRY(write_marks(&file, &array, cloud->n, &result->cells));
    CLX_TRY(write_properties(&file, &array, cloud));
    (void)clx_file_print(&file, "</PointData>\n</Piece>\n</PolyData>\n</VTKFile>\n");
    CLX_TRY(clx_file_commit(&file));
done:
    clx_vtk_free(&array);
    clx_file_abandon(&file);
    return status;
}
