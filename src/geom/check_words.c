// The findings of clast_mesh_check in words, with numbers and what to run.
#include "base/number.h"
#include "geom/check.h"
#include "math/vec3.h"

#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>

/// Times the extent: what welding a file's rounding moves (24 bits), and no word is said of.
static const double SMALL_MOVE = 1e-6;

__attribute__((format(printf, 4, 5))) static void
add(clast_mesh_check_result *result, bool blocking, const char *code, const char *format, ...)
{
    va_list args;
    if (result->n_fault >= CLAST_MESH_MAX_FAULT) {
        return;
    }
    clast_mesh_fault *fault = &result->fault[result->n_fault++];
    fault->blocking = blocking;
    (void)snprintf(fault->code, sizeof fault->code, "%s", code);
    va_start(args, format);
    (void)clx_number_print_list(fault->text, sizeof fault->text, format, args);
    va_end(args);
}

static const char *s(int64_t n)
{
    return n == 1 ? "" : "s";
}

static void open_words(clast_mesh_check_result *r)
{
    char advice[160] = "merging near vertices does not help; `clast mesh repair` fills holes";
    if (r->n_open_after_weld < r->n_open_edge) {
        char left[48] = "close";
        if (r->n_open_after_weld > 0) {
            (void)snprintf(left, sizeof left, "fall to %d", r->n_open_after_weld);
        }
        (void)clx_number_print(advice, sizeof advice,
                               "they %s when vertices within %.3g (%.2g of the extent) are merged: "
                               "run `clast mesh repair`",
                               left, r->weld_tolerance, r->weld_tolerance / r->extent);
    }
    if (r->n_open_edge > 0) {
        add(r, true, "open_edges",
            "%d open edge%s in %d loop%s, the largest %.4g across (extent %.4g); %s",
            r->n_open_edge, s(r->n_open_edge), r->n_open_loop, s(r->n_open_loop), r->largest_hole,
            r->extent, advice);
    } else { // no hole, yet a border: of facets written twice, or that stand on the surface
        add(r, true, "odd_edges",
            "edges of three triangles, or another odd number, form %d loop%s, the largest %.4g "
            "across (extent %.4g); run `clast mesh repair`",
            r->n_open_loop, s(r->n_open_loop), r->largest_hole, r->extent);
    }
    if (r->volume_spread > 1e-9 * fabs(r->volume)) {
        add(r, false, "volume_uncertain",
            "the volume of an open surface depends on the origin: four ways to sum it differ by "
            "%.3g (%.2g of %.6g)",
            r->volume_spread, r->volume_spread / fabs(r->volume), r->volume);
    }
}

static void edge_words(clast_mesh_check_result *r)
{
    if (r->n_nonmanifold_edge > 0) {
        add(r, true, "nonmanifold_edges",
            "%d edge%s with more than two triangles: bodies touch along an edge or facets are "
            "doubled; `clast mesh repair` drops doubled facets",
            r->n_nonmanifold_edge, s(r->n_nonmanifold_edge));
    }
    if (r->n_nonmanifold_vertex > 0) {
        add(r, true, "nonmanifold_vertices",
            "%d vertex number%s where several surfaces touch in a point; `clast mesh repair` gives "
            "each surface its own vertex",
            r->n_nonmanifold_vertex, s(r->n_nonmanifold_vertex));
    }
    if (r->n_misoriented_edge > 0) {
        add(r, true, "misoriented_edges",
            "%d edge%s whose triangles run the same way round: windings are mixed; run `clast mesh "
            "repair`",
            r->n_misoriented_edge, s(r->n_misoriented_edge));
    }
}

static void nested_words(clast_mesh_check_result *r)
{
    int32_t n_cavity = 0;
    for (int32_t i = 0; i < r->n_part; ++i) {
        n_cavity += r->part[i].depth > 0 && clx_part_facing(r, i) < 0 && r->part[i].winding >= 0;
    }
    const int32_t n_once = r->n_nested - r->n_doubled;
    if (n_once > 0) {
        add(r, false, "nested_parts",
            "%d of %d parts lie%s inside another: %d wound inward (cavities), %d outward in a "
            "cavity (islands)",
            n_once, r->n_part, n_once == 1 ? "s" : "", n_cavity, n_once - n_cavity);
    }
    if (r->n_doubled > 0) {
        add(r, false, "doubled_parts",
            "%d of %d parts count%s twice in the volume: wound outward in a solid, or inward "
            "outside of one%s",
            r->n_doubled, r->n_part, r->n_doubled == 1 ? "s" : "",
            r->n_intersection == 0 ? "; `clast mesh repair` drops what bounds nothing" : "");
    }
}

static void part_words(clast_mesh_check_result *r)
{
    if (r->n_inside_out > 0) {
        add(r, true, "inside_out",
            "%d of %d parts %s inside out (negative volume); run `clast mesh repair`",
            r->n_inside_out, r->n_part, r->n_inside_out == 1 ? "is" : "are");
    }
    nested_words(r);
}

static void flat_words(clast_mesh_check_result *r)
{
    const int32_t n_flat = r->n_flat;
    if (r->n_edge > 0 && r->extent < CLX_SMALLEST_EXTENT) {
        add(r, true, "flat", "an extent of %.3g is too small for a volume; is the unit right?",
            r->extent);
    } else if (r->n_edge > 0 && r->hull_volume == 0.0) {
        add(r, true, "flat", "all %d vertices lie in one plane: there is no volume", r->n_vertex);
    } else if (n_flat > 0) {
        add(r, true, "flat_parts",
            "%d of %d parts ha%s no volume: the two sides of a sheet; `clast mesh repair` drops %s",
            n_flat, r->n_part, n_flat == 1 ? "s" : "ve", n_flat == 1 ? "it" : "them");
    } else if (r->closed && r->oriented && clx_is_no_volume(r->volume, r->area, r->extent)) {
        add(r, true, "flat", "a volume of %.3g by an area of %.3g: cavities take all of its parts",
            r->volume, r->area);
    }
}

static void facet_words(clast_mesh_check_result *r)
{
    if (r->n_degenerate > 0) {
        add(r, false, "degenerate",
            "%d of %d triangles have no area (repeated or collinear corners); `clast mesh repair` "
            "drops them",
            r->n_degenerate, r->n_triangle);
    }
    if (r->n_duplicate > 0) {
        add(r, false, "duplicate",
            "%d superfluous triangle%s with the same corners as another; `clast mesh repair` drops "
            "them",
            r->n_duplicate, s(r->n_duplicate));
    }
    if (r->n_unused_vertex > 0) {
        add(r, false, "unused_vertices", "%d of %d vertices belong to no triangle",
            r->n_unused_vertex, r->n_vertex);
    }
    if (r->n_touch > 0) {
        add(r, false, "touching",
            "%lld pair%s of triangles touch away from common corners and edges: T-junctions, or "
            "bodies in contact",
            (long long)r->n_touch, s(r->n_touch));
    }
    if (!r->intersection_complete && r->n_intersection == 0) {
        add(r, false, "self_intersection",
            "not looked for: the triangles overlap so densely that it would take minutes");
    }
    if (r->n_intersection > 0) {
        add(r, false, "self_intersection",
            "%s%lld pair%s of triangles cut each other (first: %d and %d); measures count overlaps "
            "twice",
            r->intersection_complete ? "" : "at least ", (long long)r->n_intersection,
            s(r->n_intersection), r->intersection[0], r->intersection[1]);
    }
}

void clx_doubles_words(const clx_doubles *doubles, size_t size, char *text)
{
    text[0] = '\0';
    if (doubles->n_flat > 0) { // its two sides, where they are cut otherwise, cut each other
        (void)snprintf(text, size,
                       "%d of its %d parts ha%s no volume (the two sides of a sheet); its area and "
                       "hull count %s",
                       doubles->n_flat, doubles->n_part, doubles->n_flat == 1 ? "s" : "ve",
                       doubles->n_flat == 1 ? "it" : "them");
    } else if (doubles->n_intersection > 0) {
        (void)snprintf(
            text, size,
            "it cuts itself at %s%lld pair%s of triangles; its volume counts overlaps twice",
            doubles->intersection_complete ? "" : "at least ", (long long)doubles->n_intersection,
            s(doubles->n_intersection));
    } else if (!doubles->intersection_complete) {
        (void)snprintf(text, size,
                       "whether it cuts itself was not looked for, so densely do its triangles "
                       "overlap; its volume may count overlaps twice");
    } else if (doubles->n_doubled > 0) {
        (void)snprintf(text, size,
                       "%d of its %d parts count%s twice in its volume (wound outward in a solid, "
                       "or inward outside of one)",
                       doubles->n_doubled, doubles->n_part, doubles->n_doubled == 1 ? "s" : "");
    } else if (doubles->n_repeated > 0) {
        (void)snprintf(text, size,
                       "%d of its triangles repeat%s another with the same winding; its volume "
                       "counts twice what they bound",
                       doubles->n_repeated, doubles->n_repeated == 1 ? "s" : "");
    }
}

void clx_weld_words(const clast_mesh *mesh, const clast_mesh_repair_report *weld, size_t size,
                    char *text)
{
    double low[3];
    double high[3];
    clast_mesh_bounds(mesh, low, high);
    const double extent = v3_distance(low, high);
    text[0] = '\0';
    if (weld->n_merged > 0 && weld->weld_distance > SMALL_MOVE * extent) {
        (void)clx_number_print(
            text, size,
            "%d vert%s of open edges merged with others within %.3g (%.2g of the extent)",
            weld->n_merged, weld->n_merged == 1 ? "ex" : "ices", weld->weld_distance,
            weld->weld_distance / extent);
    }
}

void clast_mesh_check_doubles(const clast_mesh_check_result *result, size_t size, char *text)
{
    if (result == NULL || text == NULL || size == 0) {
        return;
    }
    clx_doubles_words(&(clx_doubles){.n_part = result->n_part,
                                     .n_doubled = result->n_doubled,
                                     .n_repeated = result->n_repeated,
                                     .n_flat = result->n_flat,
                                     .n_intersection = result->n_intersection,
                                     .intersection_complete = result->intersection_complete},
                      size, text);
}

void clx_check_words(clast_mesh_check_result *result)
{
    if (result->n_edge == 0) {
        add(result, true, "no_surface", "%d vertices and %d triangles: there is no surface",
            result->n_vertex, result->n_triangle);
    } else if (!result->closed) {
        open_words(result);
    }
    edge_words(result);
    part_words(result);
    facet_words(result);
    flat_words(result);
}
