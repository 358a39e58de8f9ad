// An assembly as one printable body: union of grains and necks, voids filled, checked to be one
// piece.
#include <clast/assembly.h>

#include "assembly/distance_field.h"
#include "assembly/pieces.h"
#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/monitor.h"
#include "base/status.h"
#include "geom/isosurface.h"
#include "math/vec3.h"
#include <clast/shape.h>
#include <string.h>

/// A length of this assembly, for messages.
static const char *length_text(const clast_assembly *a, double length)
{
    return clx_unit_text(length, strcmp(a->unit, "model") == 0 ? "-" : "m");
}

static double thinnest_grain(const clast_assembly *a)
{
    double thinnest = INFINITY;
    for (int32_t i = 0; i < a->n_grain; ++i) {
        thinnest = fmin(thinnest, 2.0 * a->scale[i] * a->shape[a->shape_id[i]].semi_axes[2]);
    }
    return thinnest;
}

/// Surface of all grains, each taken as the ellipsoid of its semi-axes (Thomsen's formula, 1 %).
static double total_surface(const clast_assembly *a)
{
    const double p = 1.6075;
    double sum = 0.0;
    for (int32_t i = 0; i < a->n_grain; ++i) {
        const double *axis = a->shape[a->shape_id[i]].semi_axes;
        const double x = pow(axis[0] * axis[1], p);
        const double y = pow(axis[0] * axis[2], p);
        const double z = pow(axis[1] * axis[2], p);
        sum += 4.0 * CLAST_PI * a->scale[i] * a->scale[i] * pow((x + y + z) / 3.0, 1.0 / p);
    }
    return sum;
}

/// Triangles of marching tetrahedra on a surface of one square spacing: 8.9 on spheres.
static const double TRIANGLES_A_SQUARE = 8.9;
/// Share of a grid edge that vertices keep away from nodes. Slivers of 1e-3, which ADMesh's single
/// precision gives other normals, are no more (432 of 961,628 facets), and the volume moves by
/// 6e-6.
static const double APART = 0.05;
/// Spacings of the grid beyond the body and its necks, and one node more.
static const double MARGIN = 7.0;
/// 50 MB of binary STL.
static const double TRIANGLE_BUDGET = 1e6;

static clast_status choose(const clast_assembly *a, const clast_printable_config *config,
                           const double low[3], const double high[3],
                           clast_printable_report *report)
{
    const double extent = fmax(high[0] - low[0], fmax(high[1] - low[1], high[2] - low[2]));
    const double thinnest = thinnest_grain(a);
    const double budget = sqrt(TRIANGLES_A_SQUARE * total_surface(a) / TRIANGLE_BUDGET);
    report->neck = config->neck > 0.0 ? config->neck : 0.5 * thinnest;
    report->spacing = config->spacing;
    if (!(report->spacing > 0.0)) {
        report->spacing = fmax(0.25 * report->neck, fmax(extent / 300.0, budget));
    }
    if (!(config->neck > 0.0)) { // a neck that the grid can show
        report->neck = fmax(report->neck, 3.0 * report->spacing);
    }
    report->n_triangle_expected =
        TRIANGLES_A_SQUARE * total_surface(a) / (report->spacing * report->spacing);
    report->smallest_feature = fmin(report->neck, thinnest);
    report->resolved = report->smallest_feature >= 2.0 * report->spacing;
    if (report->spacing > 0.5 * extent) {
        return clx_fail(CLAST_E_USAGE, "a spacing of %s cannot show a body of extent %s",
                        length_text(a, report->spacing), length_text(a, extent));
    }
    double nodes = 1.0;
    for (int k = 0; k < 3; ++k) {
        nodes *= (high[k] - low[k] + report->neck) / report->spacing + MARGIN;
    }
    if (nodes > 2147483647.0) {
        return clx_fail(CLAST_E_LIMIT,
                        "a spacing of %s on a body of extent %s needs more than 2^31 nodes; use a "
                        "coarser one",
                        length_text(a, report->spacing), length_text(a, extent));
    }
    return CLAST_OK;
}

typedef struct {
    const clx_grid *grid;
    uint8_t *seen;
    int64_t *stack; ///< nodes to visit
    int64_t n_stack, capacity;
} flood;

static bool neighbour_of(const clx_grid *g, int64_t node, int which, int64_t *neighbour)
{
    CLAST_ASSERT(which >= 0 && which < CLX_GRID_NEIGHBOURS);
    const int32_t at[3] = {(int32_t)(node % g->n[0]), (int32_t)(node / g->n[0] % g->n[1]),
                           (int32_t)(node / ((int64_t)g->n[0] * g->n[1]))};
    int64_t index = 0;
    for (int k = 2; k >= 0; --k) {
        const int32_t to = at[k] + clx_grid_neighbour[which][k];
        if (to < 0 || to >= g->n[k]) {
            return false;
        }
        index = index * g->n[k] + to;
    }
    *neighbour = index;
    return true;
}

/// Marks everything on `from`'s side of the surface that is joined to it; *count nodes.
static clast_status spread(flood *f, int64_t from, int64_t *count)
{
    clast_status status = CLAST_OK;
    const bool inside = f->grid->value[from] < 0.0f;
    *count = 0;
    CLX_TRY(clx_grow(&f->stack, &f->capacity, 1, sizeof *f->stack));
    f->stack[0] = from;
    f->n_stack = 1;
    f->seen[from] = 1;
    while (f->n_stack > 0) {
        const int64_t node = f->stack[--f->n_stack];
        ++*count;
        CLX_TRY(
            clx_grow(&f->stack, &f->capacity, f->n_stack + CLX_GRID_NEIGHBOURS, sizeof *f->stack));
        for (int e = 0; e < CLX_GRID_NEIGHBOURS; ++e) {
            int64_t next = 0;
            if (neighbour_of(f->grid, node, e, &next) && f->seen[next] == 0 &&
                (f->grid->value[next] < 0.0f) == inside) {
                f->seen[next] = 1;
                f->stack[f->n_stack++] = next;
            }
        }
    }
done:
    return status;
}

/// Counts pieces and voids; `seen` then marks the outer world (1) and everything else that was
/// visited.
static clast_status survey(flood *f, clast_printable_report *report, uint8_t *is_void)
{
    clast_status status = CLAST_OK;
    const clx_grid *g = f->grid;
    const int64_t total = (int64_t)g->n[0] * g->n[1] * g->n[2];
    int64_t count = 0;
    CLX_TRY(spread(f, 0, &count)); // the corner of the grid is outside
    for (int64_t node = 0; node < total; ++node) {
        if (f->seen[node] != 0) {
            continue;
        }
        CLX_TRY(spread(f, node, &count));
        if (g->value[node] < 0.0f) {
            ++report->n_part;
        } else {
            ++report->n_void;
            report->void_volume += (double)count * g->h * g->h * g->h;
            is_void[node] = 1;
        }
    }
done:
    return status;
}

static clast_status fill_voids(flood *f, clx_grid *grid, const uint8_t *is_void)
{
    const int64_t total = (int64_t)grid->n[0] * grid->n[1] * grid->n[2];
    clast_status status = CLAST_OK;
    for (int64_t node = 0; node < total && status == CLAST_OK; ++node) {
        f->seen[node] = 0;
    }
    for (int64_t node = 0; node < total && status == CLAST_OK; ++node) {
        int64_t count = 0;
        if (is_void[node] != 0) {
            status = spread(f, node, &count);
        }
    }
    for (int64_t node = 0; node < total && status == CLAST_OK; ++node) {
        if (f->seen[node] != 0) {
            grid->value[node] = (float)-grid->h;
        }
    }
    return status;
}

/// Says why the union is in pieces: grains without a contact between them, or necks that the grid
/// does not show.
static clast_status fail_in_pieces(const clast_assembly *a, const clast_printable_report *report)
{
    clast_status status = CLAST_OK;
    int32_t *piece = NULL;
    int32_t n_piece = 0;
    CLX_TRY(clx_alloc(&piece, a->n_grain, sizeof *piece));
    CLX_TRY(clx_assembly_pieces(a, piece, &n_piece));
    CLX_CHECK(
        n_piece == 1, CLAST_E_GEOMETRY,
        "the %d grains are %d groups without a contact between them, which no neck joins; the "
        "union falls into %d pieces",
        a->n_grain, n_piece, report->n_part);
    status = clx_fail(
        CLAST_E_GEOMETRY,
        "the union falls into %d pieces with necks of %s sampled at %s; use a thicker neck "
        "or a finer spacing",
        report->n_part, length_text(a, report->neck), length_text(a, report->spacing));
done:
    clx_free(piece);
    return status;
}

static clast_status make_solid(const clast_assembly *a, bool keep_voids, clx_grid *grid,
                               clast_printable_report *report)
{
    clast_status status = CLAST_OK;
    const int64_t total = (int64_t)grid->n[0] * grid->n[1] * grid->n[2];
    flood f = {.grid = grid};
    uint8_t *is_void = NULL;
    CLX_TRY(clx_alloc(&f.seen, total, 1));
    CLX_TRY(clx_alloc(&is_void, total, 1));
    CLX_TRY(survey(&f, report, is_void));
    if (report->n_part != 1) {
        CLX_TRY(fail_in_pieces(a, report));
    }
    if (!keep_voids && report->n_void > 0) {
        CLX_TRY(fill_voids(&f, grid, is_void));
    }
done:
    clx_free(f.seen);
    clx_free(f.stack);
    clx_free(is_void);
    return status;
}

static clast_status check_input(const clast_assembly *a, const clast_printable_config *config)
{
    if (!(config->neck >= 0.0 && config->spacing >= 0.0 &&
          isfinite(config->neck + config->spacing))) {
        return clx_fail(CLAST_E_ARGUMENT,
                        "a neck of %g and a spacing of %g; both must be finite and not negative",
                        config->neck, config->spacing);
    }
    if (a->n_grain < 1) {
        return clx_fail(CLAST_E_USAGE, "an assembly without grains cannot be printed");
    }
    if (a->n_grain > 1 && a->n_contact == 0) {
        return clx_fail(CLAST_E_USAGE,
                        "the contacts of these %d grains are not known, so no neck can be placed",
                        a->n_grain);
    }
    return CLAST_OK;
}

clast_status clast_assembly_printable_plan(const clast_assembly *assembly,
                                           const clast_printable_config *config,
                                           clast_printable_report *report)
{
    CLX_ARGUMENTS(assembly, config, report);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    clast_printable_report made = {.solid_volume = clast_assembly_volume(assembly)};
    double low[3];
    double high[3];
    CLX_TRY(check_input(assembly, config));
    clast_assembly_bounds(assembly, low, high);
    CLX_TRY(choose(assembly, config, low, high, &made));
    *report = made;
done:
    return status;
}

clast_status clast_assembly_printable(const clast_assembly *assembly,
                                      const clast_printable_config *config,
                                      const clast_monitor *monitor, clast_mesh *mesh,
                                      clast_printable_report *report)
{
    CLX_ARGUMENTS(assembly, config, mesh, report);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    clast_printable_report made = {0};
    clx_distance_field field = {0};
    clx_grid grid = {0};
    double low[3];
    double high[3];
    CLX_TRY(clast_assembly_printable_plan(assembly, config, &made));
    clast_assembly_bounds(assembly, low, high);
    for (int k = 0; k < 3; ++k) {
        low[k] -= 0.5 * made.neck + 2.0 * made.spacing;
        high[k] += 0.5 * made.neck + 3.0 * made.spacing;
    }
    CLX_TRY(clx_grid_alloc(low, high, made.spacing, (float)made.spacing, &grid));
    CLX_TRY(clx_distance_field_init(assembly, &field));
    clx_distance_field_sample(&field, &grid);
    clx_distance_field_balls((const double(*)[3])assembly->contact_point, assembly->n_contact,
                             0.5 * made.neck, &grid);
    clx_monitor_report(monitor, "printable surface", 1, 3);
    CLX_TRY(make_solid(assembly, config->keep_voids, &grid, &made));
    clx_monitor_report(monitor, "printable surface", 2, 3);
    CLX_TRY(clx_isosurface(&grid, 0.0, APART, mesh));
    made.volume = clast_mesh_volume(mesh);
    *report = made;
    clx_monitor_report(monitor, "printable surface", 3, 3);
done:
    clx_grid_free(&grid);
    clx_distance_field_free(&field);
    return status;
}
