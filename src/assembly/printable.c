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

static double thickness_of(const clast_assembly *a, int32_t grain)
{
    return 2.0 * a->scale[grain] * a->shape[a->shape_id[grain]].semi_axes[2];
}

static double thinnest_grain(const clast_assembly *a)
{
    double thinnest = INFINITY;
    for (int32_t i = 0; i < a->n_grain; ++i) {
        thinnest = fmin(thinnest, thickness_of(a, i));
    }
    return thinnest;
}

/// Refuses necks that would be the body, not join it.
static clast_status check_neck(const clast_assembly *a, double neck)
{
    double thickest = 0.0;
    for (int32_t i = 0; i < a->n_grain; ++i) {
        thickest = fmax(thickest, thickness_of(a, i));
    }
    return neck <= thickest
               ? CLAST_OK
               : clx_fail(CLAST_E_USAGE, "a neck of %s is thicker than every grain: %s at most",
                          length_text(a, neck), length_text(a, thickest));
}

/// Mean square radius of a shape's surface, its area by 4 pi: of a surface its own; of others that
/// of the ellipsoid of their semi-axes (Thomsen's formula, 1 %).
static double square_radius(const clast_shape *shape)
{
    const double p = 1.6075;
    const double *axis = shape->semi_axes;
    if (shape->kind == CLAST_SHAPE_MESH) {
        return clast_mesh_area(&shape->mesh) / (4.0 * CLAST_PI);
    }
    const double x = pow(axis[0] * axis[1], p);
    const double y = pow(axis[0] * axis[2], p);
    const double z = pow(axis[1] * axis[2], p);
    return pow((x + y + z) / 3.0, 1.0 / p);
}

/// Surface of all grains.
static clast_status total_surface(const clast_assembly *a, double *surface)
{
    clast_status status = CLAST_OK;
    double *square = NULL; // by shape
    double sum = 0.0;
    CLX_TRY(clx_alloc(&square, a->n_shape, sizeof *square));
    for (int32_t s = 0; s < a->n_shape; ++s) {
        square[s] = square_radius(&a->shape[s]);
    }
    for (int32_t i = 0; i < a->n_grain; ++i) {
        sum += 4.0 * CLAST_PI * a->scale[i] * a->scale[i] * square[a->shape_id[i]];
    }
    *surface = sum;
done:
    clx_free(square);
    return status;
}

/// Whether all grains' thinnest parts are known: a surface or a clump may have walls that its
/// ellipsoid of equal moments has not.
static bool knows_walls(const clast_assembly *a)
{
    for (int32_t i = 0; i < a->n_grain; ++i) {
        const clast_shape_kind kind = a->shape[a->shape_id[i]].kind;
        if (kind != CLAST_SHAPE_SPHERE && kind != CLAST_SHAPE_ELLIPSOID) {
            return false;
        }
    }
    return true;
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
    double surface = 0.0;
    CLX_GUARD(check_neck(a, config->neck));
    CLX_GUARD(total_surface(a, &surface));
    const double extent = fmax(high[0] - low[0], fmax(high[1] - low[1], high[2] - low[2]));
    const double thinnest = thinnest_grain(a);
    const double budget = sqrt(TRIANGLES_A_SQUARE * surface / TRIANGLE_BUDGET);
    report->neck = config->neck > 0.0 ? config->neck : 0.5 * thinnest;
    report->spacing = config->spacing;
    if (!(report->spacing > 0.0)) {
        report->spacing = fmax(0.25 * report->neck, fmax(extent / 300.0, budget));
    }
    if (!(config->neck > 0.0)) { // a neck that the grid can show
        report->neck = fmax(report->neck, 3.0 * report->spacing);
    }
    report->n_triangle_expected =
        TRIANGLES_A_SQUARE * surface / (report->spacing * report->spacing);
    report->smallest_feature = fmin(report->neck, thinnest);
    report->knows_walls = knows_walls(a);
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
    const clast_monitor *monitor;
    uint8_t *seen;
    int64_t *stack; ///< nodes to visit
    int64_t n_stack, capacity;
} flood;

/// Between two steps of the work, or after so many nodes of one.
static clast_status check_stop(const clast_monitor *monitor)
{
    return clx_monitor_stops(monitor) ? clx_fail(CLAST_E_STOPPED, "stopped") : CLAST_OK;
}

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
    enum { LOOK_EVERY = 1 << 20 };
    clast_status status = CLAST_OK;
    const bool inside = f->grid->value[from] < 0.0f;
    *count = 0;
    CLX_TRY(clx_grow(&f->stack, &f->capacity, 1, sizeof *f->stack));
    f->stack[0] = from;
    f->n_stack = 1;
    f->seen[from] = 1;
    while (f->n_stack > 0) {
        const int64_t node = f->stack[--f->n_stack];
        if (++*count % LOOK_EVERY == 0) {
            CLX_TRY(check_stop(f->monitor));
        }
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

static clast_status make_solid(const clast_assembly *a, bool keep_voids,
                               const clast_monitor *monitor, clx_grid *grid,
                               clast_printable_report *report)
{
    clast_status status = CLAST_OK;
    const int64_t total = (int64_t)grid->n[0] * grid->n[1] * grid->n[2];
    flood f = {.grid = grid, .monitor = monitor};
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
    CLX_FREE(f.seen, f.stack, is_void);
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

/// Volume that marching tetrahedra may take from grains whose walls they show: 0.8 % of a ball at
/// ten spacings a radius, with the square of the spacing, of each grain as of the ball of its least
/// semi-axis; and the shift of a face that lies on nodes, from which vertices stay apart.
static clast_status marching_error(const clast_assembly *a, double spacing, double *volume)
{
    double sum = 0.0;
    CLX_GUARD(total_surface(a, &sum));
    sum *= APART * spacing;
    for (int32_t i = 0; i < a->n_grain; ++i) {
        const clast_shape *shape = &a->shape[a->shape_id[i]];
        const double s = a->scale[i];
        const double step = spacing / (s * shape->semi_axes[2]);
        sum += fmin(0.8 * step * step, 1.0) * shape->volume * s * s * s;
    }
    *volume = sum;
    return CLAST_OK;
}

/// Share of the grains' volume that the surface lacks, where that is more than marching takes: thin
/// walls of a grain that its ellipsoid does not tell of. Grains that overlap have the volume of
/// their union, which is looked for where it matters.
static clast_status find_lost(const clast_assembly *a, clast_printable_report *report)
{
    clast_status status = CLAST_OK;
    clast_union_options options = clast_union_options_default();
    double error = 0.0;
    clast_union solid;
    options.tolerance = 1e-3;
    options.find_depth = false;
    CLX_TRY(marching_error(a, report->spacing, &error));
    if (report->volume + error >= report->solid_volume) {
        return CLAST_OK;
    }
    CLX_TRY(clast_assembly_union(a, &options, &solid));
    if (report->volume + error < solid.volume - 3.0 * solid.error) {
        report->lost = 1.0 - report->volume / solid.volume;
        report->resolved = false;
    }
done:
    return status;
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
    clast_mesh surface = {0};
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
    CLX_TRY(clx_distance_field_sample_watched(&field, monitor, &grid));
    clx_distance_field_balls((const double(*)[3])assembly->contact_point, assembly->n_contact,
                             0.5 * made.neck, &grid);
    clx_monitor_report(monitor, "printable surface", 1, 3);
    CLX_TRY(make_solid(assembly, config->keep_voids, monitor, &grid, &made));
    clx_monitor_report(monitor, "printable surface", 2, 3);
    CLX_TRY(check_stop(monitor));
    CLX_TRY(clx_isosurface(&grid, 0.0, APART, &surface));
    made.volume = clast_mesh_volume(&surface);
    CLX_TRY(find_lost(assembly, &made));
    CLX_TRY(check_stop(monitor));
    *report = made;
    *mesh = surface;
    surface = (clast_mesh){0};
    clx_monitor_report(monitor, "printable surface", 3, 3);
done:
    clast_mesh_free(&surface);
    clx_grid_free(&grid);
    clx_distance_field_free(&field);
    return status;
}
