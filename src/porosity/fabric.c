// Directions of contacts and grains.
#include <clast/porosity.h>

#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/status.h"
#include "math/sym3.h"
#include "math/vec3.h"
#include <clast/assembly.h>
#include <clast/shape.h>
#include <stdio.h>
#include <string.h>

enum { ROW_LIMIT = 32 };

/// Rows under construction.
typedef struct {
    int32_t n;
    struct {
        char name[48];
        double value;
        const char *unit, *meaning;
    } row[ROW_LIMIT];
} rows;

static void add_row(rows *r, const char *prefix, const char *name, double value, const char *unit,
                    const char *meaning)
{
    (void)snprintf(r->row[r->n].name, sizeof r->row[r->n].name, "%s%s", prefix, name);
    r->row[r->n].value = value;
    r->row[r->n].unit = unit;
    r->row[r->n].meaning = meaning;
    ++r->n;
}

/// Eigenvalues, falling, and the vertical entry of a direction tensor of trace 1.
static void add_tensor(rows *r, const char *prefix, double tensor[3][3], const char *of)
{
    double value[3];
    double axes[3][3];
    clx_sym3_eigen(tensor, value, axes);
    add_row(r, prefix, "_1", value[0], "-", of);
    add_row(r, prefix, "_2", value[1], "-", "middle eigenvalue");
    add_row(r, prefix, "_3", value[2], "-", "least eigenvalue");
    add_row(r, prefix, "_anisotropy", value[0] - value[2], "-",
            "0 for random directions, 1 for one");
    add_row(r, prefix, "_vertical", tensor[2][2], "-", "vertical entry, 1/3 for random directions");
}

static void add_outer(double tensor[3][3], double weight, const double a[3])
{
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            tensor[i][j] += weight * a[i] * a[j];
        }
    }
}

static void scale_tensor(double tensor[3][3], double s)
{
    for (int i = 0; i < 3; ++i) {
        v3_scale(tensor[i], s, tensor[i]);
    }
}

static void add_counts(rows *r, const clast_assembly *a, const int32_t *count)
{
    int64_t none = 0;
    int64_t few = 0;
    int64_t sum = 0;
    for (int32_t i = 0; i < a->n_grain; ++i) {
        none += count[i] == 0;
        few += count[i] < 4;
        sum += count[i] >= 4 ? count[i] : 0;
    }
    const double n = (double)a->n_grain;
    add_row(r, "", "coordination", 2.0 * a->n_contact / n, "-", "mean number of touching grains");
    add_row(r, "", "share_free", (double)none / n, "-", "grains that touch no other");
    add_row(r, "", "share_rattler", (double)few / n, "-", "grains with fewer than four contacts");
    if (few < a->n_grain) {
        add_row(r, "", "coordination_bearing", (double)sum / (n - (double)few), "-",
                "mean of the grains with four contacts or more");
    }
}

/// Tensor of directions of contacts between grains, from the table's columns: false without them.
static bool sum_known(const clast_table *contacts, const char *const name[3], double tensor[3][3])
{
    const double *b = contacts != NULL ? clast_table_numbers(contacts, "b") : NULL;
    const double *x = contacts != NULL ? clast_table_numbers(contacts, name[0]) : NULL;
    const double *y = contacts != NULL ? clast_table_numbers(contacts, name[1]) : NULL;
    const double *z = contacts != NULL ? clast_table_numbers(contacts, name[2]) : NULL;
    int64_t n = 0;
    if (b == NULL || x == NULL || y == NULL || z == NULL) {
        return false;
    }
    for (int64_t c = 0; c < contacts->n_row; ++c) {
        double direction[3] = {x[c], y[c], z[c]};
        if (b[c] >= 0.0 && v3_unit(direction, direction)) {
            add_outer(tensor, 1.0, direction);
            ++n;
        }
    }
    scale_tensor(tensor, n > 0 ? 1.0 / (double)n : 0.0);
    return n > 0;
}

/// Contact normals: true where they are known, from the table or because all grains are spheres.
static bool sum_normals(const clast_assembly *a, const clast_table *contacts, double branches[3][3],
                        double tensor[3][3])
{
    static const char *const names[3] = {"normal_x", "normal_y", "normal_z"};
    bool is_known = true;
    if (sum_known(contacts, names, tensor)) {
        return true;
    }
    for (int32_t i = 0; i < a->n_grain && is_known; ++i) {
        is_known = a->shape[a->shape_id[i]].kind == CLAST_SHAPE_SPHERE;
    }
    memcpy(tensor, branches, 9 * sizeof(double));
    return is_known;
}

/// Branch vectors: from the table, as grains wider than half a period touch in other images than
/// the nearest, too; else to the nearest image. False if there is no contact.
static bool sum_branches(const clast_assembly *a, const clast_table *known, const double period[3],
                         double tensor[3][3])
{
    static const char *const names[3] = {"branch_x_m", "branch_y_m", "branch_z_m"};
    int64_t n = 0;
    if (sum_known(known, names, tensor)) {
        return true;
    }
    for (int32_t c = 0; c < a->n_contact; ++c) {
        double b[3];
        v3_sub(b, a->position[a->contact[c][1]], a->position[a->contact[c][0]]);
        for (int k = 0; k < 3 && period != NULL; ++k) {
            b[k] -= period[k] > 0.0 ? period[k] * round(b[k] / period[k]) : 0.0;
        }
        if (v3_unit(b, b)) {
            add_outer(tensor, 1.0, b);
            ++n;
        }
    }
    scale_tensor(tensor, n > 0 ? 1.0 / (double)n : 0.0);
    return n > 0;
}

static clast_status contacts(rows *r, const clast_assembly *a, const clast_table *known,
                             const double period[3])
{
    clast_status status = CLAST_OK;
    double tensor[3][3] = {{0.0}};
    double normals[3][3] = {{0.0}};
    int32_t *count = NULL;
    CLX_TRY(clx_alloc(&count, a->n_grain, sizeof *count));
    for (int32_t c = 0; c < a->n_contact; ++c) {
        ++count[a->contact[c][0]];
        ++count[a->contact[c][1]];
    }
    add_counts(r, a, count);
    if (sum_branches(a, known, period, tensor)) {
        if (sum_normals(a, known, tensor, normals)) {
            add_tensor(r, "normal", normals,
                       "greatest eigenvalue of Satake's fabric tensor of contact normals");
        }
        add_tensor(r, "branch", tensor,
                   "greatest eigenvalue of the tensor of branch vectors (centre to centre)");
    }
done:
    clx_free(count);
    return status;
}

/// Longest and shortest principal axis of a shape in its own frame; false for a ball's equal
/// moments.
static bool long_and_short(const clast_shape *shape, double longest[3], double shortest[3])
{
    double inertia[3][3];
    double value[3];
    double axes[3][3];
    memcpy(inertia, shape->inertia, sizeof inertia);
    clx_sym3_eigen(inertia, value, axes); // moments fall: the first axis is the shortest
    v3_copy(shortest, axes[0]);
    v3_copy(longest, axes[2]);
    return value[0] - value[2] > 1e-9 * value[0];
}

static void grains(rows *r, const clast_assembly *a)
{
    double longest[3][3] = {{0.0}};
    double shortest[3][3] = {{0.0}};
    double sum = 0.0;
    double angle = 0.0;
    for (int32_t i = 0; i < a->n_grain; ++i) {
        const clast_shape *shape = &a->shape[a->shape_id[i]];
        double body[2][3];
        double world[2][3];
        if (!long_and_short(shape, body[0], body[1])) {
            continue;
        }
        const double volume = a->scale[i] * a->scale[i] * a->scale[i] * shape->volume;
        q_rotate(world[0], a->orientation[i], body[0]);
        q_rotate(world[1], a->orientation[i], body[1]);
        add_outer(longest, volume, world[0]);
        add_outer(shortest, volume, world[1]);
        angle += volume * asin(fmin(1.0, fabs(world[0][2])));
        sum += volume;
    }
    if (sum > 0.0) {
        scale_tensor(longest, 1.0 / sum);
        scale_tensor(shortest, 1.0 / sum);
        add_tensor(r, "long_axis", longest, "greatest eigenvalue of the direction tensor");
        add_tensor(r, "short_axis", shortest, "greatest eigenvalue of the direction tensor");
        add_row(r, "", "long_axis_dip", angle / sum, "rad",
                "mean angle of the longest axis to the horizontal; 0.571 for random directions");
    }
}

clast_status clast_fabric(const clast_assembly *assembly, const clast_table *known,
                          const double period[3], clast_table *table)
{
    CLX_ARGUMENTS(assembly, table);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    clast_table made = {0};
    rows r = {.n = 0};
    double *value = NULL;
    CLX_CHECK(assembly->n_grain > 0, CLAST_E_USAGE, "no grain to measure");
    if (assembly->contact != NULL) {
        CLX_TRY(contacts(&r, assembly, known, period));
    }
    grains(&r, assembly);
    CLX_TRY(clast_table_init(&made, "fabric", r.n));
    CLX_TRY(clast_table_add_text(&made, "name"));
    CLX_TRY(clast_table_add_number(&made, "value", "-", &value));
    CLX_TRY(clast_table_add_text(&made, "unit"));
    CLX_TRY(clast_table_add_text(&made, "meaning"));
    for (int32_t k = 0; k < r.n; ++k) {
        CLX_TRY(clast_table_set_text(&made, 0, k, r.row[k].name));
        value[k] = r.row[k].value;
        CLX_TRY(clast_table_set_text(&made, 2, k, r.row[k].unit));
        CLX_TRY(clast_table_set_text(&made, 3, k, r.row[k].meaning));
    }
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}
