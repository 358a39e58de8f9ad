// Tables of other programs to grains: spheres, ellipsoids, clumps.
#include "io/packing.h"

#include "base/alloc.h"
#include "base/status.h"
#include "io/spheres_table.h"
#include "math/vec3.h"
#include <clast/assembly.h>
#include <clast/shape.h>
#include <clast/state.h>
#include <clast/table.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double UPRIGHT[4] = {1.0, 0.0, 0.0, 0.0};

/// A quaternion whose printed digits are off by more than this is made one anew.
static const double UNIT_OFF = 1e-12;

/// Number of an atom's type, from 1; 1 where the table has none.
static clast_status type_of(const double *type, int64_t row, int32_t *number)
{
    clast_status status = CLAST_OK;
    const double value = type != NULL ? type[row] : 1.0;
    CLX_CHECK(value >= 1.0 && value <= 1e6 && value == floor(value), CLAST_E_FORMAT,
              "row %lld: type %g is none of 1, 2, ...", (long long)row + 1, value);
    *number = (int32_t)value;
done:
    return status;
}

/// What a row's shape is: type, and semi-axes, longest first.
typedef struct {
    double axis[3];
    int32_t type, row;
    int32_t head, n; ///< first of its type among the sorted ones; there, shapes of it so far
    int32_t number;  ///< of the shape in the assembly; -1: not yet made
} row_shape;

static int by_axes(const row_shape *x, const row_shape *y)
{
    for (int k = 0; k < 3; ++k) {
        if (x->axis[k] != y->axis[k]) {
            return x->axis[k] < y->axis[k] ? -1 : 1;
        }
    }
    return 0;
}

static int by_shape(const void *a, const void *b)
{
    const row_shape *x = a;
    const row_shape *y = b;
    if (x->type != y->type) {
        return x->type < y->type ? -1 : 1;
    }
    const int axes = by_axes(x, y);
    if (axes != 0) {
        return axes;
    }
    return x->row < y->row ? -1 : x->row > y->row ? 1 : 0;
}

/// A shape of a type: type-1, type-1-2, ...; sphere where the file has no types.
static clast_status make_shape(row_shape *rows, int32_t k, bool has_type, clast_assembly *a)
{
    clast_status status = CLAST_OK;
    clast_shape made = {0};
    char name[48] = "sphere";
    row_shape *r = &rows[k];
    const int32_t n = ++rows[r->head].n;
    if (has_type) {
        (void)snprintf(name, sizeof name, n > 1 ? "type-%d-%d" : "type-%d", r->type, n);
    }
    CLX_TRY(r->axis[0] == r->axis[2] ? clast_shape_sphere(name, r->axis[0], &made)
                                     : clast_shape_ellipsoid(name, r->axis, &made));
    CLX_TRY(clast_assembly_add_shape(a, &made, &r->number));
done:
    clast_shape_free(&made);
    return status;
}

/// One shape for all rows of equal type and axes, in the order in which they are met; each row's
/// goes to `shape`. The rows are sorted.
static clast_status make_shapes(int32_t n, row_shape *rows, bool has_type, clast_assembly *a,
                                int32_t *shape)
{
    clast_status status = CLAST_OK;
    int32_t first = 0;
    if (n > 0) {
        qsort(rows, (size_t)n, sizeof *rows, by_shape);
    }
    for (int32_t k = 0; k < n; ++k) {
        const bool begins = k == 0 || rows[k].type != rows[k - 1].type;
        rows[k].number = -1;
        rows[k].n = 0;
        rows[k].head = begins ? k : rows[k - 1].head;
        first = begins || by_axes(&rows[k], &rows[k - 1]) != 0 ? k : first;
        shape[rows[k].row] = first;
    }
    for (int32_t i = 0; i < n; ++i) {
        row_shape *r = &rows[shape[i]];
        if (r->number < 0) {
            CLX_TRY(make_shape(rows, shape[i], has_type, a));
        }
        shape[i] = r->number;
    }
done:
    return status;
}

static clast_status add_spheres(const clast_spheres *spheres, const double *type, clast_assembly *a)
{
    clast_status status = CLAST_OK;
    row_shape *rows = NULL;
    int32_t *shape = NULL;
    CLX_TRY(clx_alloc(&rows, spheres->n, sizeof *rows));
    CLX_TRY(clx_alloc(&shape, spheres->n, sizeof *shape));
    for (int32_t i = 0; i < spheres->n; ++i) {
        rows[i] = (row_shape){.axis = {1.0, 1.0, 1.0}, .row = i};
        CLX_TRY(type_of(type, i, &rows[i].type));
    }
    CLX_TRY(make_shapes(spheres->n, rows, type != NULL, a, shape));
    for (int32_t i = 0; i < spheres->n; ++i) {
        CLX_TRY(clast_assembly_add_grain(a, shape[i], spheres->centre[i], UPRIGHT,
                                         spheres->radius[i], 1.0));
    }
done:
    CLX_FREE(rows, shape);
    return status;
}

static void sort_down(double x[3])
{
    for (int i = 1; i < 3; ++i) {
        for (int j = i; j > 0 && x[j] > x[j - 1]; --j) {
            const double swap = x[j];
            x[j] = x[j - 1];
            x[j - 1] = swap;
        }
    }
}

/// Rotation that takes the axes as clast sorts them, longest along x, to those of the file.
static void sorting_rotation(const double axes[3], double rotation[4])
{
    int order[3] = {0, 1, 2};
    double m[3][3] = {{0.0}};
    for (int i = 1; i < 3; ++i) {
        for (int j = i; j > 0 && axes[order[j]] > axes[order[j - 1]]; --j) {
            const int swap = order[j];
            order[j] = order[j - 1];
            order[j - 1] = swap;
        }
    }
    for (int k = 0; k < 3; ++k) {
        m[order[k]][k] = 1.0;
    }
    const bool is_even = (order[1] - order[0] + 3) % 3 == 1;
    m[order[2]][2] = is_even ? 1.0 : -1.0;
    if (order[0] == 0 && order[1] == 1) {
        memcpy(rotation, UPRIGHT, sizeof UPRIGHT);
    } else {
        q_from_matrix(rotation, m);
    }
}

typedef struct {
    const double *x[3], *axis[3], *q[4], *type;
} ellipsoid_columns;

static clast_status find_columns(const clast_table *table, ellipsoid_columns *c)
{
    const struct {
        const char *name;
        const double **column;
    } wanted[] = {{"x", &c->x[0]},         {"y", &c->x[1]},         {"z", &c->x[2]},
                  {"shapex", &c->axis[0]}, {"shapey", &c->axis[1]}, {"shapez", &c->axis[2]},
                  {"quatw", &c->q[0]},     {"quati", &c->q[1]},     {"quatj", &c->q[2]},
                  {"quatk", &c->q[3]}};
    clast_status status = CLAST_OK;
    for (size_t k = 0; k < sizeof wanted / sizeof wanted[0]; ++k) {
        *wanted[k].column = clast_table_numbers(table, wanted[k].name);
        CLX_CHECK(*wanted[k].column != NULL, CLAST_E_FORMAT, "ellipsoids have no column %s",
                  wanted[k].name);
    }
    c->type = clast_table_numbers(table, "type");
done:
    return status;
}

/// Where the row's grain is and how it is turned; finite, of unit length.
static clast_status read_pose(const ellipsoid_columns *c, int64_t i, double x[3], double axes[3],
                              double q[4])
{
    clast_status status = CLAST_OK;
    double length = 0.0;
    for (int k = 0; k < 3; ++k) { // no column is NULL but for the analyser
        x[k] = c->x[k] != NULL ? c->x[k][i] : 0.0;
        axes[k] = c->axis[k] != NULL ? 0.5 * c->axis[k][i] : 0.0;
    }
    for (int k = 0; k < 4; ++k) {
        q[k] = c->q[k] != NULL ? c->q[k][i] : 0.0;
        length += q[k] * q[k];
    }
    CLX_CHECK(v3_is_finite(x) && v3_is_finite(axes) && axes[0] > 0.0 && axes[1] > 0.0 &&
                  axes[2] > 0.0,
              CLAST_E_FORMAT, "row %lld: an ellipsoid at (%g, %g, %g) of diameters %g, %g, %g",
              (long long)i + 1, x[0], x[1], x[2], 2.0 * axes[0], 2.0 * axes[1], 2.0 * axes[2]);
    CLX_CHECK(length > 0.5 && length < 2.0, CLAST_E_FORMAT,
              "row %lld: (%g, %g, %g, %g) is no quaternion of length 1", (long long)i + 1, q[0],
              q[1], q[2], q[3]);
    if (fabs(length - 1.0) > UNIT_OFF) {
        q_unit(q);
    }
done:
    return status;
}

static clast_status add_ellipsoids(const clast_table *table, clast_assembly *a)
{
    clast_status status = CLAST_OK;
    ellipsoid_columns c = {0};
    row_shape *rows = NULL;
    int32_t *shape = NULL;
    double x[3];
    double axes[3];
    double q[4];
    CLX_CHECK(table->n_row <= INT32_MAX, CLAST_E_LIMIT, "%lld rows", (long long)table->n_row);
    const int32_t n = (int32_t)table->n_row;
    CLX_TRY(find_columns(table, &c));
    CLX_TRY(clx_alloc(&rows, n, sizeof *rows));
    CLX_TRY(clx_alloc(&shape, n, sizeof *shape));
    for (int32_t i = 0; i < n; ++i) {
        rows[i].row = i;
        CLX_TRY(type_of(c.type, i, &rows[i].type));
        CLX_TRY(read_pose(&c, i, x, rows[i].axis, q));
        sort_down(rows[i].axis);
    }
    CLX_TRY(make_shapes(n, rows, true, a, shape));
    for (int32_t i = 0; i < n; ++i) {
        double rotation[4];
        double turned[4];
        CLX_TRY(read_pose(&c, i, x, axes, q));
        sorting_rotation(axes, rotation);
        q_mul(turned, q, rotation);
        CLX_TRY(clast_assembly_add_grain(a, shape[i], x, turned, 1.0, 1.0));
    }
done:
    CLX_FREE(rows, shape);
    return status;
}

clast_status clx_packing_of_table(const clast_table *table, const clx_spheres_wanted *wanted,
                                  bool is_lammps, clast_assembly *assembly, char unit[16])
{
    clast_status status = CLAST_OK;
    clast_spheres spheres = {0};
    const int32_t clump = clx_yade_clump_column(wanted->options.columns);
    (void)snprintf(assembly->unit, sizeof assembly->unit, "model");
    if (is_lammps && clast_table_numbers(table, "shapex") != NULL &&
        wanted->options.diameter <= 0.0) {
        CLX_TRY(clx_spheres_check_list(table, wanted)); // of ids: poses are found by name
        return add_ellipsoids(table, assembly);
    }
    CLX_CHECK(
        !is_lammps || clx_spheres_has_list(wanted) || clx_points_are_named(table), CLAST_E_FORMAT,
        "of a dump x, y, z or xs, ys, zs are read, which are not there; to take others (xu, yu, "
        "zu: without the period), name all columns in their order with %scolumns "
        "id,type,x,y,z,r",
        wanted->prefix != NULL ? wanted->prefix : "");
    CLX_TRY(clx_spheres_of_columns(table, wanted, &spheres, unit));
    if (unit[0] != '\0') {
        (void)snprintf(assembly->unit, sizeof assembly->unit, "m");
    }
    if (clump >= 0) {
        CLX_CHECK(clump < table->n_column && table->column[clump].number != NULL, CLAST_E_FORMAT,
                  "column %d, clumpId, holds no numbers", clump + 1);
        CLX_TRY(clx_yade_clumps(&spheres, table->column[clump].number, assembly));
    } else {
        CLX_TRY(
            add_spheres(&spheres, is_lammps ? clast_table_numbers(table, "type") : NULL, assembly));
    }
done:
    clast_spheres_free(&spheres);
    return status;
}

/// Ids of other programs lie below: all are doubles.
static const double MOST_ID = 9e15;

static int by_number(const void *a, const void *b)
{
    const int64_t x = *(const int64_t *)a;
    const int64_t y = *(const int64_t *)b;
    return (x > y) - (x < y);
}

clast_status clx_packing_ids(const clast_table *table, const clx_spheres_wanted *wanted,
                             bool is_lammps, clast_assembly *assembly)
{
    clast_status status = CLAST_OK;
    const int32_t n = assembly->n_grain;
    const double *id = is_lammps && !clx_spheres_has_list(wanted) ? clast_table_numbers(table, "id")
                                                                  : clx_spheres_ids(table, wanted);
    int64_t *sorted = NULL;
    bool are_ids = id != NULL && n > 0;
    CLX_TRY(clx_alloc(&sorted, n, sizeof *sorted));
    for (int32_t i = 0; i < n && are_ids; ++i) {
        are_ids = id[i] >= 0.0 && id[i] < MOST_ID && id[i] == floor(id[i]);
        CLX_CHECK(are_ids || !is_lammps, CLAST_E_FORMAT, "row %d has the id %g", i + 1, id[i]);
        sorted[i] = are_ids ? (int64_t)id[i] : 0;
    }
    if (!are_ids) {
        goto done;
    }
    memcpy(assembly->id, sorted, (size_t)n * sizeof *sorted);
    assembly->has_ids = true;
    qsort(sorted, (size_t)n, sizeof *sorted, by_number);
    for (int32_t i = 1; i < n; ++i) {
        CLX_CHECK(sorted[i] != sorted[i - 1], CLAST_E_FORMAT,
                  "two rows have the id %lld (to read them without ids: %scolumns with - for that "
                  "column)",
                  (long long)sorted[i], wanted->prefix != NULL ? wanted->prefix : "");
    }
done:
    clx_free(sorted);
    return status;
}
