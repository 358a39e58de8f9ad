// Measures of one grain from its surface; docs/theory/form.md has every definition and its source.
#include "shape/grain.h"

#include "base/alloc.h"
#include "base/status.h"
#include "geom/chords.h"
#include "geom/hull.h"
#include "geom/hull_body.h"
#include "geom/topology.h"
#include "geom/whole.h"
#include "math/vec3.h"
#include "shape/roundness.h"
#include "shape/shape.h"
#include <clast/grain.h>
#include <clast/mesh.h>

#define AXES(id, name, what, source) {name, what, source},
static const char *const AXES_TEXT[CLAST_N_AXES][3] = {CLAST_AXES_LIST(AXES)};
#undef AXES

static const char *axes_text(int32_t axes, int column)
{
    return axes >= 0 && axes < CLAST_N_AXES ? AXES_TEXT[axes][column] : NULL;
}

const char *clast_axes_name(int32_t axes)
{
    return axes_text(axes, 0);
}

const char *clast_axes_definition(int32_t axes)
{
    return axes_text(axes, 1);
}

const char *clast_axes_source(int32_t axes)
{
    return axes_text(axes, 2);
}

void clast_grain_scale(clast_grain *grain, double factor)
{
    if (grain == NULL) {
        return;
    }
    const double square = factor * factor;
    const double cube = square * factor;
    grain->volume *= cube;
    grain->pore_volume *= cube;
    grain->pore_area *= square;
    grain->hull_volume *= cube;
    grain->area *= square;
    grain->hull_area *= square;
    grain->projected_mean *= square;
    grain->projected_least *= square;
    grain->projected_greatest *= square;
    grain->longest *= factor;
    grain->shortest *= factor;
    for (int k = 0; k < 3; ++k) {
        grain->centroid[k] *= factor;
        grain->moments[k] *= cube * square;
        v3_scale(grain->inertia[k], cube * square, grain->inertia[k]);
    }
    for (int a = 0; a < CLAST_N_AXES; ++a) {
        v3_scale(grain->axes[a].lis, factor, grain->axes[a].lis);
    }
}

clast_status clx_grain_inertia(clast_grain *grain)
{
    clast_axes *ellipsoid = &grain->axes[CLAST_AXES_ELLIPSOID];
    double semi_axes[3];
    const clast_status status =
        clx_frame_from_inertia(grain->volume, grain->inertia, semi_axes, ellipsoid->direction);
    for (int k = 0; k < 3 && status == CLAST_OK; ++k) {
        const double b = semi_axes[(k + 1) % 3];
        const double c = semi_axes[(k + 2) % 3];
        ellipsoid->lis[k] = 2.0 * semi_axes[k];
        grain->moments[k] = grain->volume * (b * b + c * c) / 5.0; // L's is the least
    }
    return status;
}

static void take_box(const clx_box *box, clast_axes *axes)
{
    v3_copy(axes->lis, box->edge);
    for (int k = 0; k < 3; ++k) {
        v3_copy(axes->direction[k], box->axis[k]);
    }
}

clast_status clx_grain_hull(const clast_mesh *points, clast_grain *grain, double lying[3])
{
    clast_status status = CLAST_OK;
    clx_hull_body body = {0};
    clx_chords *chords = NULL;
    clx_face_shadows faces = {0};
    clx_feret feret;
    clx_box box;
    double(*frame)[3] = grain->axes[CLAST_AXES_ELLIPSOID].direction;
    clast_axes *feret_axes = &grain->axes[CLAST_AXES_FERET];
    clast_axes *principal = &grain->axes[CLAST_AXES_PRINCIPAL];
    CLX_TRY(clx_hull_body_make(points, &body));
    CLX_TRY(clx_chords_make(&body, &chords));
    CLX_TRY(clx_hull_body_feret(&body, chords, &feret));
    CLX_TRY(clx_hull_body_fitted_box(&body, &feret, &box));
    take_box(&box, &grain->axes[CLAST_AXES_FITTED]);
    *feret_axes = grain->axes[CLAST_AXES_FITTED];
    feret_axes->lis[2] = feret.shortest;
    v3_copy(feret_axes->direction[2], feret.shortest_axis);
    CLX_TRY(clx_face_shadows_make(&body, &faces));
    CLX_TRY(clx_hull_body_least_box(&body, chords, &faces, frame, &box));
    take_box(&box, &grain->axes[CLAST_AXES_BOX]);
    for (int k = 0; k < 3; ++k) {
        v3_copy(principal->direction[k], frame[k]);
        principal->lis[k] = clx_hull_body_width(&body, frame[k]);
    }
    v3_sort_axes(principal->lis, principal->direction);
    CLX_TRY(clx_shadow_extremes(&body, &faces, frame, &grain->projected_least,
                                &grain->projected_greatest, lying));
    grain->longest = feret.longest;
    grain->shortest = feret.shortest;
    grain->hull_volume = body.volume;
    grain->hull_area = body.surface;
    grain->projected_mean = 0.25 * body.surface;
done:
    clx_free(chords);
    clx_face_shadows_free(&faces);
    clx_hull_body_free(&body);
    return status;
}

void clx_grain_ratios(clast_grain *grain)
{
    const double v = grain->volume;
    grain->sphericity = cbrt(36.0 * CLAST_PI * v * v) / grain->area;
    grain->convexity = v / grain->hull_volume;
    grain->hull_volume_added = grain->hull_volume / v - 1.0;
}

static clast_status check_finite(const clast_mesh *mesh)
{
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        if (!isfinite(v3_norm2(mesh->vert[v]))) {
            return clx_fail(CLAST_E_GEOMETRY,
                            "vertex %d of %d is not finite (or beyond 1e154); take it out", v,
                            mesh->n_vert);
        }
    }
    return CLAST_OK;
}

static clast_status check_rank(const clast_mesh *mesh)
{
    static const char *const flats[] = {"are one point", "lie on one line", "lie in one plane"};
    const int rank = clx_points_rank((const double(*)[3])mesh->vert, mesh->n_vert, 1e-13);
    if (rank >= 0 && rank < 3) {
        return clx_fail(CLAST_E_GEOMETRY,
                        "all %d vertices %s: a grain without thickness has no form", mesh->n_vert,
                        flats[rank]);
    }
    return CLAST_OK;
}

/// Ends of the half-edges by the vertex that they leave: to[begin[v] .. begin[v + 1]).
static void sort_half_edges(const clast_mesh *mesh, int32_t *begin, int32_t *to)
{
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            ++begin[mesh->tri[t][k]];
        }
    }
    for (int32_t v = 0, sum = 0; v <= mesh->n_vert; ++v) { // to the end of each vertex's list
        sum += begin[v];
        begin[v] = sum;
    }
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        const int32_t *corner = mesh->tri[t];
        to[--begin[corner[0]]] = corner[1];
        to[--begin[corner[1]]] = corner[2];
        to[--begin[corner[2]]] = corner[0];
    }
}

/// Whether each half-edge has exactly one that runs back, as in most surfaces: a quarter of what
/// sorting the edges takes.
static clast_status find_paired(const clast_mesh *mesh, bool *is_paired)
{
    enum { MOST_EDGES = 64 }; ///< of a vertex
    clast_status status = CLAST_OK;
    int32_t *begin = NULL;
    int32_t *to = NULL;
    CLX_TRY(clx_alloc(&begin, (int64_t)mesh->n_vert + 1, sizeof *begin));
    CLX_TRY(clx_alloc(&to, 3 * (int64_t)mesh->n_tri, sizeof *to));
    sort_half_edges(mesh, begin, to);
    *is_paired = true;
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        *is_paired = *is_paired && begin[v + 1] - begin[v] <= MOST_EDGES; // longer lists: sorted
    }
    for (int32_t v = 0; v < mesh->n_vert && *is_paired; ++v) {
        for (int32_t i = begin[v]; i < begin[v + 1]; ++i) {
            int32_t n_back = 0;
            for (int32_t j = begin[to[i]]; j < begin[to[i] + 1]; ++j) {
                n_back += to[j] == v;
            }
            *is_paired = *is_paired && n_back == 1 && to[i] != v;
        }
    }
done:
    CLX_FREE(begin, to);
    return status;
}

/// A solid's surface: every edge used equally often in both directions.
static clast_status check_closed(const clast_mesh *mesh)
{
    clast_status status = CLAST_OK;
    clx_topology topology = {0};
    int32_t n_open = 0;
    int32_t n_turned = 0;
    bool is_paired = false;
    CLX_CHECK(mesh->n_tri > 0, CLAST_E_GEOMETRY,
              "%d vertices and no triangles: measure their convex hull with --hull", mesh->n_vert);
    CLX_CHECK(mesh->n_tri >= 4, CLAST_E_GEOMETRY, "%d triangles bound no solid; at least 4 do",
              mesh->n_tri);
    if (mesh->n_tri <= INT32_MAX / 3) {
        CLX_TRY(find_paired(mesh, &is_paired));
    }
    if (is_paired) {
        goto done;
    }
    CLX_TRY(clx_topology_build(mesh, &topology));
    for (int32_t e = 0; e < topology.n_edge; ++e) {
        const bool is_even = clx_edge_use(&topology, e) % 2 == 0;
        n_open += !is_even;
        n_turned += is_even && clx_edge_balance(mesh, &topology, e) != 0;
    }
    CLX_CHECK(n_open == 0, CLAST_E_GEOMETRY,
              "%d of %d edges are open, so the volume is undefined; run `clast mesh repair`, or "
              "measure the convex hull with --hull",
              n_open, topology.n_edge);
    CLX_CHECK(n_turned == 0, CLAST_E_GEOMETRY,
              "%d of %d edges join facets that face opposite ways; run `clast mesh repair`, or "
              "measure the convex hull with --hull",
              n_turned, topology.n_edge);
done:
    clx_topology_free(&topology);
    return status;
}

static clast_status check_thick(double volume, double extent)
{
    const double rounding = 1e-14 * extent * extent * extent;
    if (volume < -rounding) {
        return clx_fail(CLAST_E_GEOMETRY,
                        "volume is %g: the surface is inside out; run `clast mesh repair`", volume);
    }
    if (!(volume > rounding)) {
        return clx_fail(CLAST_E_GEOMETRY,
                        "volume is %g at an extent of %g: a grain without thickness has no form",
                        volume, extent);
    }
    return CLAST_OK;
}

/// The vertices that triangles use, as a mesh without triangles; empty when all are used.
static clast_status used_vertices(const clast_mesh *mesh, clast_mesh *used)
{
    clast_status status = CLAST_OK;
    bool *is_used = NULL;
    int32_t n_used = 0;
    CLX_TRY(clx_alloc(&is_used, mesh->n_vert, sizeof *is_used));
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            n_used += !is_used[mesh->tri[t][k]];
            is_used[mesh->tri[t][k]] = true;
        }
    }
    if (n_used < mesh->n_vert) {
        CLX_TRY(clast_mesh_alloc(n_used, 0, used));
        n_used = 0;
        for (int32_t v = 0; v < mesh->n_vert; ++v) {
            if (is_used[v]) {
                v3_copy(used->vert[n_used++], mesh->vert[v]);
            }
        }
    }
done:
    clx_free(is_used);
    return status;
}

/// Volume, area, centroid and moments.
static clast_status measure_mass(const clast_mesh *mesh, clast_grain *grain)
{
    clast_status status = CLAST_OK;
    clast_mass mass = {0};
    CLX_TRY(clast_mesh_mass(mesh, &mass));
    grain->volume = mass.volume;
    grain->area = clast_mesh_area(mesh);
    v3_copy(grain->centroid, mass.centroid);
    for (int k = 0; k < 3; ++k) {
        v3_copy(grain->inertia[k], mass.inertia[k]);
    }
    CLX_TRY(clx_grain_inertia(grain));
done:
    return status;
}

/// What is said of the outer surface: all of it is of the grain with its pores filled.
static clast_status measure_outer(const clast_mesh *mesh, const double lying[3], clast_grain *grain)
{
    clast_status status = CLAST_OK;
    clast_mesh outer = {0};
    clast_grain filled = *grain;
    CLX_TRY(clx_grain_outer(mesh, &outer));
    const clast_mesh *surface = outer.n_tri > 0 ? &outer : mesh;
    if (outer.n_tri > 0) {
        CLX_TRY(measure_mass(&outer, &filled));
        grain->pore_volume = filled.volume - grain->volume;
        grain->pore_area = grain->area - filled.area;
    }
    clx_grain_ratios(&filled);
    clx_grain_surface_means(surface, &filled);
    CLX_TRY(clx_grain_roundness(surface, lying, &filled));
    grain->area = filled.area;
    grain->sphericity = filled.sphericity;
    grain->convexity = filled.convexity;
    grain->hull_volume_added = grain->hull_volume / grain->volume - 1.0; // to the solid
    grain->normal_roundness = filled.normal_roundness;
    grain->angularity = filled.angularity;
    grain->roundness = filled.roundness;
    grain->roundness_deviation = filled.roundness_deviation;
    grain->n_outline = filled.n_outline;
done:
    clast_mesh_free(&outer);
    return status;
}

static clast_status measure_solid(const clast_mesh *mesh, clast_grain *grain)
{
    clast_status status = CLAST_OK;
    clast_mesh used = {0};
    double lying[3];
    double low[3];
    double high[3];
    clast_mesh_bounds(mesh, low, high);
    CLX_TRY(check_thick(clast_mesh_volume(mesh), v3_distance(low, high)));
    CLX_TRY(measure_mass(mesh, grain));
    CLX_TRY(used_vertices(mesh, &used));
    CLX_TRY(clx_grain_hull(used.n_vert > 0 ? &used : mesh, grain, lying));
    CLX_TRY(measure_outer(mesh, lying, grain));
done:
    clast_mesh_free(&used);
    return status;
}

clast_status clast_grain_measure(const clast_mesh *mesh, clast_grain *grain)
{
    CLX_ARGUMENTS(mesh, grain);
    CLX_WHOLE(mesh, mesh);
    clast_status status = CLAST_OK;
    clast_grain made = {0};
    CLX_TRY(check_finite(mesh));
    CLX_TRY(check_rank(mesh));
    CLX_TRY(check_closed(mesh));
    CLX_TRY(measure_solid(mesh, &made));
    *grain = made;
done:
    return status;
}

clast_status clast_grain_measure_hull(const clast_mesh *mesh, clast_grain *grain)
{
    CLX_ARGUMENTS(mesh, grain);
    CLX_WHOLE(mesh, mesh);
    clast_status status = CLAST_OK;
    clast_grain made = {0};
    clx_hull_body body = {0};
    CLX_TRY(clx_hull_body_make(mesh, &body));
    const clast_mesh hull = {body.n_vert, body.n_face, body.vert, body.face};
    CLX_TRY(measure_solid(&hull, &made));
    v3_add(made.centroid, made.centroid, body.middle);
    made.hull_volume_added = NAN;
    const double volume = fabs(clast_mesh_volume(mesh)); // of a surface turned inside out, too
    if (mesh->n_tri > 0 && volume > 0.0 && check_closed(mesh) == CLAST_OK) {
        made.hull_volume_added = made.volume / volume - 1.0;
    }
    *grain = made;
done:
    clx_hull_body_free(&body);
    return status;
}
