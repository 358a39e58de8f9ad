// YADE's text of spheres: "#format x_y_z_r" or the like in its first line, then a row a sphere;
// those of one clumpId are rigid together. [YADE's documentation, yade.export.text, textClumps]
#include "io/packing.h"

#include "base/alloc.h"
#include "base/status.h"
#include "math/vec3.h"
#include <clast/assembly.h>
#include <clast/shape.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double UPRIGHT[4] = {1.0, 0.0, 0.0, 0.0};

bool clx_yade_columns(const void *bytes, size_t n, char columns[CLX_YADE_COLUMNS])
{
    static const char mark[] = "#format ";
    const char *text = bytes;
    size_t at = sizeof mark - 1;
    size_t length = 0;
    if (n < at || memcmp(text, mark, at) != 0) {
        return false;
    }
    for (; at < n && (unsigned char)text[at] > ' ' && length + 1 < CLX_YADE_COLUMNS; ++at) {
        columns[length++] = text[at];
        if (text[at] == '_') {
            columns[length - 1] = ',';
        }
    }
    columns[length] = '\0';
    return length > 0;
}

int32_t clx_yade_clump_column(const char *columns)
{
    static const char name[] = "clumpId";
    int32_t place = 0;
    for (const char *at = columns; at != NULL && *at != '\0'; ++place) {
        const size_t length = strcspn(at, ",");
        if (length == sizeof name - 1 && memcmp(at, name, length) == 0) {
            return place;
        }
        at += length + (at[length] == ',');
    }
    return -1;
}

/// A row of a clump.
typedef struct {
    double clump;
    int32_t row;
} clump_row;

static int by_clump(const void *a, const void *b)
{
    const clump_row *x = a;
    const clump_row *y = b;
    return x->clump != y->clump ? (x->clump < y->clump ? -1 : 1) : x->row < y->row ? -1 : 1;
}

/// The spheres of one clump, n rows, as a grain of a shape of its own.
static clast_status add_clump(const clast_spheres *spheres, int32_t n, const clump_row *rows,
                              clast_assembly *a)
{
    clast_status status = CLAST_OK;
    clast_spheres own = {0};
    clast_shape shape = {0};
    char name[48];
    int32_t number = 0;
    CLX_TRY(clast_spheres_alloc(n, &own));
    for (int32_t k = 0; k < n; ++k) {
        v3_copy(own.centre[k], spheres->centre[rows[k].row]);
        own.radius[k] = spheres->radius[rows[k].row];
    }
    (void)snprintf(name, sizeof name, "clump-%lld", (long long)rows[0].clump);
    CLX_TRY(clast_shape_clump(name, &own, &shape));
    const double at[3] = {shape.source_origin[0], shape.source_origin[1], shape.source_origin[2]};
    CLX_TRY(clast_assembly_add_shape(a, &shape, &number));
    CLX_TRY(clast_assembly_add_grain(a, number, at, UPRIGHT, 1.0, 1.0));
done:
    clast_shape_free(&shape);
    clast_spheres_free(&own);
    return status;
}

/// A sphere of no clump; the shape of all such is made with the first.
static clast_status add_sphere(const clast_spheres *spheres, int32_t i, int32_t *ball,
                               clast_assembly *a)
{
    clast_status status = CLAST_OK;
    clast_shape made = {0};
    if (*ball < 0) {
        CLX_TRY(clast_shape_sphere("sphere", 1.0, &made));
        CLX_TRY(clast_assembly_add_shape(a, &made, ball));
    }
    CLX_TRY(
        clast_assembly_add_grain(a, *ball, spheres->centre[i], UPRIGHT, spheres->radius[i], 1.0));
done:
    clast_shape_free(&made);
    return status;
}

clast_status clx_yade_clumps(const clast_spheres *spheres, const double *clump, clast_assembly *a)
{
    clast_status status = CLAST_OK;
    clump_row *rows = NULL; // sorted: a clump's stand together
    int32_t *first = NULL;  // of the clump that begins with a row, among those; -1: none begins
    int32_t ball = -1;
    CLX_TRY(clx_alloc(&rows, spheres->n, sizeof *rows));
    CLX_TRY(clx_alloc(&first, spheres->n, sizeof *first));
    for (int32_t i = 0; i < spheres->n; ++i) {
        CLX_CHECK(isfinite(clump[i]) && fabs(clump[i]) < 1e15, CLAST_E_FORMAT, "row %d: clumpId %g",
                  i + 1, clump[i]);
        rows[i] = (clump_row){clump[i], i};
    }
    if (spheres->n > 0) {
        qsort(rows, (size_t)spheres->n, sizeof *rows, by_clump);
    }
    for (int32_t k = 0; k < spheres->n; ++k) {
        first[rows[k].row] = k > 0 && rows[k].clump == rows[k - 1].clump ? -1 : k;
    }
    for (int32_t i = 0; i < spheres->n; ++i) {
        if (clump[i] < 0.0) {
            CLX_TRY(add_sphere(spheres, i, &ball, a));
        } else if (first[i] >= 0) {
            int32_t last = first[i] + 1;
            while (last < spheres->n && rows[last].clump == clump[i]) {
                ++last;
            }
            CLX_TRY(add_clump(spheres, last - first[i], rows + first[i], a));
        }
    }
done:
    CLX_FREE(rows, first);
    return status;
}
