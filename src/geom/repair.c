// clast_mesh_repair: the steps in their order, and what each changed.
//
// Order: merging first, since it decides what is open; triangles without area and repetitions next,
// since they hide open edges; then T-junctions, which look like holes; then loose triangles; then
// windings, which give holes their direction; then holes; then outward, which needs closed parts.
#include "geom/repair.h"

#include "base/alloc.h"
#include "base/field.h"
#include "base/status.h"
#include "geom/check.h"
#include "geom/intersect.h"
#include "geom/topology.h"
#include "geom/weld.h"
#include "geom/whole.h"
#include "math/vec3.h"
#include <clast/field.h>
#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <string.h>

#define FIELD(type, name)                                                                          \
#name, .offset = offsetof(clast_mesh_repair_config, name), CLAST_FIELD_##type
const clast_field clast_mesh_repair_fields[] = {
    {FIELD(CHOICE, weld), CLAST_WELD_AUTO, 0, 0, "-",
     "merge near vertices: the smallest distance that closes the surface, not at all, or within "
     "weld_tolerance",
     "auto|off|within"},
    {FIELD(F64, weld_tolerance), 1e-6, 0.0, 0.1, "-", "for weld within: times the extent", NULL},
    {FIELD(BOOL, drop), 1.0, 0, 1, "-", "drop triangles without area or that repeat others", NULL},
    {FIELD(BOOL, split), 1.0, 0, 1, "-", "split edges at vertices that lie on them (T-junctions)",
     NULL},
    {FIELD(F64, split_tolerance), 1e-6, 0.0, 0.01, "-",
     "how far from the edge such a vertex may lie, times the extent", NULL},
    {FIELD(BOOL, loose), 1.0, 0, 1, "-", "drop triangles that share no edge with others", NULL},
    {FIELD(BOOL, orient), 1.0, 0, 1, "-", "orient neighbours consistently and closed parts outward",
     NULL},
    {FIELD(BOOL, fill), 1.0, 0, 1, "-", "fill holes with the triangles of least area", NULL},
    {FIELD(F64, fill_size), 1.0, 0.0, 1.0, "-", "largest hole to fill, times the extent", NULL},
    {FIELD(BOOL, separate), 1.0, 0, 1, "-",
     "give surfaces that touch in an edge or vertex their own vertices", NULL},
    {FIELD(BOOL, unite), 1.0, 0, 1, "-",
     "drop nested parts that bound nothing: outward ones in a solid, inward ones outside of it",
     NULL},
    {FIELD(CHOICE, keep), CLAST_KEEP_ALL, 0, 0, "-",
     "parts to keep: all, or the one of the largest volume with its cavities", "all|largest"},
    {0}};
#undef FIELD

const clast_idle *clast_mesh_repair_idle(const clast_mesh_repair_config *c,
                                         clast_idle rules[CLAST_N_IDLE])
{
    if (c == NULL || rules == NULL) {
        return NULL;
    }
    const clast_idle made[CLAST_N_IDLE] = {
        {c->weld != CLAST_WELD_WITHIN, "weld_tolerance", "without --weld within"},
        {!c->split, "split_tolerance", "with --no-split"},
        {!c->fill, "fill_size", "with --no-fill"}};
    return clx_idle_copy(made, rules);
}

/// Drops marked triangles; returns how many.
static int32_t drop_marked(clast_mesh *mesh, const bool *mark)
{
    int32_t n = 0;
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        if (!mark[t]) {
            memmove(mesh->tri[n++], mesh->tri[t], sizeof *mesh->tri);
        }
    }
    const int32_t n_dropped = mesh->n_tri - n;
    mesh->n_tri = n;
    return n_dropped;
}

/// Replaces the mesh by its vertices merged by map.
static clast_status merge(clast_mesh *mesh, const int32_t *map, int32_t *n_collapsed)
{
    clast_mesh merged = {0};
    const clast_status status = clx_weld_apply(mesh, map, &merged, n_collapsed);
    if (status == CLAST_OK) {
        clast_mesh_free(mesh);
        *mesh = merged;
    }
    return status;
}

static clast_status weld(clast_mesh *mesh, const clast_mesh_repair_config *config,
                         clast_mesh_repair_report *report)
{
    clast_status status = CLAST_OK;
    clx_weld_choice choice = {0};
    int32_t *map = NULL;
    if (config->weld == CLAST_WELD_OFF) {
        return CLAST_OK;
    }
    CLX_TRY(clx_alloc(&map, mesh->n_vert, sizeof *map));
    if (config->weld == CLAST_WELD_AUTO) {
        CLX_TRY(clx_weld_search(mesh, &choice, map));
    } else {
        const clx_weld_rule rule = {.tolerance = config->weld_tolerance * clx_mesh_extent(mesh)};
        CLX_TRY(clx_weld_map(mesh, &rule, map));
    }
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        report->n_merged += map[v] != v;
        report->weld_distance =
            fmax(report->weld_distance, v3_distance(mesh->vert[v], mesh->vert[map[v]]));
    }
    if (report->n_merged > 0) {
        CLX_TRY(merge(mesh, map, &report->n_collapsed));
    }
done:
    clx_free(map);
    return status;
}

static clast_status drop_bad(clast_mesh *mesh, clast_mesh_repair_report *report)
{
    clast_status status = CLAST_OK;
    clx_topology topology = {0};
    bool *mark = NULL;
    int32_t n = 0;
    CLX_TRY(clx_alloc(&mark, mesh->n_tri, sizeof *mark));
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        mark[t] = clx_is_flat(mesh, t);
    }
    report->n_degenerate += drop_marked(mesh, mark);
    CLX_TRY(clx_topology_build(mesh, &topology));
    CLX_TRY(clx_find_duplicates(mesh, &topology, mark, &n));
    report->n_duplicate += drop_marked(mesh, mark);
done:
    clx_topology_free(&topology);
    clx_free(mark);
    return status;
}

static clast_status drop_loose(clast_mesh *mesh, clast_mesh_repair_report *report)
{
    clast_status status = CLAST_OK;
    clx_topology topology = {0};
    bool *mark = NULL;
    CLX_TRY(clx_topology_build(mesh, &topology));
    CLX_TRY(clx_alloc(&mark, mesh->n_tri, sizeof *mark));
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        mark[t] = true;
        for (int32_t h = 3 * t; h < 3 * t + 3; ++h) {
            const int32_t e = topology.edge_of[h];
            mark[t] = mark[t] && (e < 0 || clx_edge_use(&topology, e) == 1);
        }
    }
    report->n_loose += drop_marked(mesh, mark);
done:
    clx_topology_free(&topology);
    clx_free(mark);
    return status;
}

/// Solid on both sides of the part, or on neither.
static bool bounds_nothing(const clast_mesh_check_result *found, int32_t part)
{
    const int facing = clx_part_facing(found, part);
    const int32_t inside = found->part[part].winding;
    return facing != 0 && (inside > 0) == (inside - facing > 0);
}

/// Parts of a surface, and which part each triangle is of.
typedef struct {
    clx_topology topology;
    clast_mesh_check_result found;
    int32_t *of_triangle; ///< [n_tri] -1: none
    int32_t *parent;      ///< [n_part] the part directly around each, -1: none
    bool *is_dropped;     ///< [n_part]
    int32_t n;
} parts;

static clast_status find_parts(const clast_mesh *mesh, parts *p)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_topology_build(mesh, &p->topology));
    CLX_TRY(clx_alloc(&p->parent, mesh->n_tri, sizeof *p->parent));
    CLX_TRY(clx_check_parts(mesh, &p->topology, &p->found, p->parent));
    CLX_TRY(clx_alloc(&p->of_triangle, mesh->n_tri, sizeof *p->of_triangle));
    CLX_TRY(clx_topology_parts(&p->topology, mesh->n_tri, p->of_triangle, &p->n));
    CLX_TRY(clx_alloc(&p->is_dropped, p->n, sizeof *p->is_dropped));
done:
    return status;
}

static void free_parts(parts *p)
{
    clx_topology_free(&p->topology);
    clast_mesh_check_free(&p->found);
    CLX_FREE(p->of_triangle, p->parent, p->is_dropped);
}

/// Drops the triangles of parts that are marked, and those of no part if so asked.
static clast_status drop_parts(clast_mesh *mesh, const parts *p, bool drops_others,
                               clast_mesh_repair_report *report)
{
    clast_status status = CLAST_OK;
    bool *mark = NULL;
    CLX_TRY(clx_alloc(&mark, mesh->n_tri, sizeof *mark));
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        const int32_t part = p->of_triangle[t];
        mark[t] = part >= 0 ? p->is_dropped[part] : drops_others;
    }
    for (int32_t i = 0; i < p->n; ++i) {
        report->n_part_dropped += p->is_dropped[i];
    }
    (void)drop_marked(mesh, mark);
done:
    clx_free(mark);
    return status;
}

/// Drops what has the solid on both sides, or on none: the surface of the union is left. Parts that
/// cut each other stay, since they are in and out.
static clast_status unite(clast_mesh *mesh, clast_mesh_repair_report *report)
{
    clast_status status = CLAST_OK;
    parts p = {.n = 0};
    clx_cuts cuts = {0};
    CLX_TRY(find_parts(mesh, &p));
    if (p.found.n_doubled == 0) {
        goto done;
    }
    CLX_TRY(clx_mesh_cuts(mesh, &cuts));
    if (cuts.n_pair > 0 || !cuts.complete) {
        goto done;
    }
    for (int32_t i = 0; i < p.n; ++i) {
        p.is_dropped[i] = bounds_nothing(&p.found, i);
    }
    CLX_TRY(drop_parts(mesh, &p, false, report));
done:
    free_parts(&p);
    return status;
}

/// Whether the part is the surface of the one around it inside out: a cavity that takes all of a
/// body, or an island that fills its cavity.
static bool fills_parent(const parts *p, int32_t i)
{
    const clast_mesh_part *list = p->found.part;
    const int32_t around = p->parent[i];
    return around >= 0 && list[i].closed && list[i].oriented &&
           clx_is_no_volume(list[i].volume + list[around].volume, list[around].area,
                            v3_distance(list[around].low, list[around].high));
}

/// Drops closed parts without volume, which bound nothing, and shells without thickness.
static clast_status drop_flat(clast_mesh *mesh, clast_mesh_repair_report *report)
{
    clast_status status = CLAST_OK;
    parts p = {.n = 0};
    int32_t n = 0;
    CLX_TRY(find_parts(mesh, &p));
    for (int32_t i = 0; i < p.n; ++i) {
        if (clx_part_is_flat(&p.found.part[i])) {
            p.is_dropped[i] = true;
            ++n;
        } else if (fills_parent(&p, i) && !p.is_dropped[p.parent[i]]) {
            p.is_dropped[i] = p.is_dropped[p.parent[i]] = true;
            ++n;
        }
    }
    if (n > 0) {
        CLX_TRY(drop_parts(mesh, &p, false, report));
    }
done:
    free_parts(&p);
    return status;
}

/// Whether the part is a cavity of a body: the body is directly around it.
static bool is_cavity_of(const parts *p, int32_t i, int32_t body)
{
    return p->parent[i] == body && p->found.part[i].volume < 0.0;
}

/// Volumes [n_part] of the parts, those outward less their cavities.
static void measure_bodies(const parts *p, double *volume)
{
    const clast_mesh_part *list = p->found.part;
    for (int32_t i = 0; i < p->n; ++i) {
        volume[i] += list[i].volume;
        const int32_t around = p->parent[i];
        if (around >= 0 && list[around].volume > 0.0 && is_cavity_of(p, i, around)) {
            volume[around] += list[i].volume;
        }
    }
}

/// Keeps the body of the largest volume (area, where none is closed) with its own cavities: not
/// those of islands in them.
static clast_status keep_largest(clast_mesh *mesh, clast_mesh_repair_report *report)
{
    clast_status status = CLAST_OK;
    parts p = {.n = 0};
    double *volume = NULL;
    int32_t best = 0;
    CLX_TRY(find_parts(mesh, &p));
    CLX_TRY(clx_alloc(&volume, p.n, sizeof *volume));
    measure_bodies(&p, volume);
    const clast_mesh_part *list = p.found.part;
    for (int32_t i = 1; i < p.n; ++i) {
        const bool larger =
            list[i].closed == list[best].closed
                ? (list[i].closed ? volume[i] > volume[best] : list[i].area > list[best].area)
                : list[i].closed;
        best = larger ? i : best;
    }
    for (int32_t i = 0; i < p.n; ++i) {
        p.is_dropped[i] = i != best && !is_cavity_of(&p, i, best);
    }
    CLX_TRY(drop_parts(mesh, &p, true, report));
done:
    clx_free(volume);
    free_parts(&p);
    return status;
}

static clast_status check_input(const clast_mesh *mesh)
{
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        for (int k = 0; k < 3; ++k) {
            if (!(fabs(mesh->vert[v][k]) < 1e100)) { // as the readers have it
                return clx_fail(CLAST_E_GEOMETRY, "vertex %d of %d is not finite, or beyond 1e100",
                                v, mesh->n_vert);
            }
        }
    }
    for (int32_t c = 0; c < 3 * mesh->n_tri; ++c) {
        const int32_t v = mesh->tri[c / 3][c % 3];
        if (v < 0 || v >= mesh->n_vert) {
            return clx_fail(CLAST_E_GEOMETRY, "triangle %d has vertex number %d of %d", c / 3, v,
                            mesh->n_vert);
        }
    }
    return CLAST_OK;
}

/// Steps up to the point from which triangles keep their numbers.
static clast_status take_first_steps(clast_mesh *mesh, const clast_mesh_repair_config *config,
                                     double extent, clast_mesh_repair_report *report)
{
    clast_status status = CLAST_OK;
    CLX_TRY(weld(mesh, config, report));
    if (config->drop) {
        CLX_TRY(drop_bad(mesh, report));
    }
    if (config->split) {
        CLX_TRY(clx_split_tjunctions(mesh, config->split_tolerance * extent, &report->n_split));
    }
    if (config->loose) {
        CLX_TRY(drop_loose(mesh, report));
    }
done:
    return status;
}

/// A triangle that stood on the surface by one edge is closed by filling to a fin without
/// thickness: it goes, front and back.
static clast_status drop_fins(clast_mesh *mesh, bool *turned, int32_t *n_known,
                              const clast_mesh_repair_config *config,
                              clast_mesh_repair_report *report)
{
    clast_status status = CLAST_OK;
    bool *mark = NULL;
    int32_t n = 0;
    int32_t n_duplicate = 0;
    if (!config->drop || report->n_fill_triangle == 0) {
        return CLAST_OK;
    }
    CLX_TRY(clx_alloc(&mark, mesh->n_tri, sizeof *mark));
    CLX_TRY(clx_find_duplicates(mesh, NULL, mark, &n_duplicate));
    for (int32_t t = 0; t < *n_known; ++t) {
        turned[n] = turned[t];
        n += !mark[t];
    }
    *n_known = n;
    report->n_duplicate += drop_marked(mesh, mark);
done:
    clx_free(mark);
    return status;
}

/// Fills holes. The fins that it leaves go as if they had no side: what they hid, the other side of
/// a facet written twice, may run either way, so that windings are looked at again.
static clast_status fill(clast_mesh *mesh, double most, bool *turned, int32_t *n_known,
                         const clast_mesh_repair_config *config, clast_mesh_repair_report *report)
{
    clast_status status = CLAST_OK;
    const int32_t n_duplicate = report->n_duplicate;
    CLX_TRY(clx_fill_holes(mesh, most, report));
    CLX_TRY(drop_fins(mesh, turned, n_known, config, report));
    if (config->orient && report->n_duplicate > n_duplicate) {
        CLX_TRY(clx_orient_alike(mesh, turned, *n_known, &report->n_conflict));
    }
done:
    return status;
}

static clast_status take_steps(clast_mesh *mesh, const clast_mesh_repair_config *config,
                               clast_mesh_repair_report *report)
{
    clast_status status = CLAST_OK;
    bool *turned = NULL;
    const double extent = clx_mesh_extent(mesh);
    CLX_TRY(take_first_steps(mesh, config, extent, report));
    int32_t n_known = mesh->n_tri;
    CLX_TRY(clx_alloc(&turned, n_known, sizeof *turned));
    if (config->orient) {
        CLX_TRY(clx_orient_alike(mesh, turned, n_known, &report->n_conflict));
    }
    if (config->fill) {
        CLX_TRY(fill(mesh, config->fill_size * extent, turned, &n_known, config, report));
    }
    if (config->separate) {
        CLX_TRY(clx_separate(mesh, &report->n_separated));
    }
    if (config->orient) {
        CLX_TRY(clx_orient_outward(mesh, turned, n_known));
    }
    for (int32_t t = 0; t < n_known; ++t) {
        report->n_turned += turned[t];
    }
    if (config->unite) {
        CLX_TRY(drop_flat(mesh, report));
        CLX_TRY(unite(mesh, report));
    }
    if (config->keep == CLAST_KEEP_LARGEST) {
        CLX_TRY(keep_largest(mesh, report));
    }
done:
    clx_free(turned);
    return status;
}

/// Drops vertices that nothing uses, and what triangles with a repeated corner are left.
static clast_status drop_unused(clast_mesh *mesh, clast_mesh_repair_report *report)
{
    clast_status status = CLAST_OK;
    int32_t *map = NULL;
    int32_t n_collapsed = 0;
    CLX_TRY(clx_alloc(&map, mesh->n_vert, sizeof *map));
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        map[v] = v;
    }
    CLX_TRY(merge(mesh, map, &n_collapsed));
    report->n_collapsed += n_collapsed;
done:
    clx_free(map);
    return status;
}

clast_status clast_mesh_repair(const clast_mesh *mesh, const clast_mesh_repair_config *config,
                               clast_mesh *out, clast_mesh_repair_report *report)
{
    CLX_WHOLE(mesh, mesh);
    clast_status status = CLAST_OK;
    clast_mesh made = {0};
    clast_mesh_repair_config defaults;
    clast_mesh_repair_report done_so_far = {0};
    CLX_NEED(mesh);
    CLX_NEED(out);
    if (config != NULL) {
        CLX_TRY(clast_fields_check(clast_mesh_repair_fields, config));
    }
    done_so_far.n_triangle_before = mesh->n_tri;
    CLX_TRY(clast_fields_default(clast_mesh_repair_fields, &defaults));
    CLX_TRY(check_input(mesh));
    CLX_TRY(clast_mesh_copy(mesh, &made));
    done_so_far.volume_before = clx_cone_volume(mesh);
    done_so_far.area_before = clast_mesh_area(mesh);
    CLX_TRY(take_steps(&made, config != NULL ? config : &defaults, &done_so_far));
    CLX_CHECK(made.n_tri > 0, CLAST_E_GEOMETRY,
              "nothing is left to repair: %d triangles had no area, %d repeated others (those made "
              "to fill holes too), %d shared no edge with another and %d parts had no volume",
              done_so_far.n_degenerate + done_so_far.n_collapsed, done_so_far.n_duplicate,
              done_so_far.n_loose, done_so_far.n_part_dropped);
    CLX_TRY(drop_unused(&made, &done_so_far));
    done_so_far.n_triangle_after = made.n_tri;
    done_so_far.volume_after = clx_cone_volume(&made);
    done_so_far.area_after = clast_mesh_area(&made);
    *out = made;
    made = (clast_mesh){0};
    if (report != NULL) {
        *report = done_so_far;
    }
done:
    clast_mesh_free(&made);
    return status;
}

clast_status clast_mesh_weld_auto(clast_mesh *mesh, clast_mesh_repair_report *report)
{
    CLX_ARGUMENTS(mesh);
    CLX_WHOLE(mesh, mesh);
    clast_status status = CLAST_OK;
    clast_mesh_repair_report made = {.n_triangle_before = mesh->n_tri};
    const clast_mesh_repair_config config = {.weld = CLAST_WELD_AUTO};
    CLX_TRY(check_input(mesh));
    CLX_TRY(weld(mesh, &config, &made));
    made.n_triangle_after = mesh->n_tri;
    if (report != NULL) {
        *report = made;
    }
done:
    return status;
}
