#pragma once
// A convex hull that grows: points come in batches, its volume is known after every batch, and
// points that end up inside are forgotten.
#include "geom/lanes.h"
#include <clast/mesh.h>

/// One triangle of the hull. Free slots have vert[0] < 0.
typedef struct clx_hull_facet {
    int32_t vert[3];  ///< slots of hull->vert, counter-clockwise from outside
    int32_t adj[3];   ///< facet across the edge vert[k] -> vert[k + 1]
    double normal[3]; ///< outward unit normal, or 0 when rounding cannot tell it
    double tolerance; ///< error of a distance to this facet, as a share of the hull's reach
    int32_t outside;  ///< batch: first point known to see this facet, or -1
    int64_t stamp;    ///< search: twice its number, plus one when seen not to be visible
    int64_t serial;   ///< differs from facet to facet, also in one slot
    int32_t owner;    ///< the caller's; -1 at birth
    double excess;    ///< the caller's; 0 at birth
    double gap;       ///< the caller's; 0 at birth
} clx_hull_facet;

typedef struct clx_hull_vertex {
    double point[3];
    int32_t tag;    ///< the caller's number (a grain)
    int32_t degree; ///< facets that use it; 0 for a free slot
    int32_t link;   ///< scratch: the new facet that starts here
} clx_hull_vertex;

/// A horizon edge: facet `beyond` stays, its edge `side` runs from `to` to `from`.
typedef struct clx_hull_edge {
    int32_t from, to, beyond, side;
} clx_hull_edge;

/// {0} is an empty hull; free it with clx_hull_inc_free. One thread at a time.
///
/// Every decision (does a point see a facet?) is the exact sign of a determinant, so the hull of
/// any points, coplanar and repeated ones included, is a closed manifold that no point sees. A
/// coplanar face is cut into triangles in the order of insertion.
typedef struct clx_hull_inc {
    bool is_solid;           ///< four points that are not coplanar have come
    int32_t n_facet, n_vert; ///< live ones
    clx_hull_facet *facet;   ///< [facet_end] with free slots
    clx_hull_vertex *vert;   ///< [vert_end] with free slots
    int32_t facet_end, vert_end;
    int64_t n_inserted; ///< points that were a vertex at their insertion
    // The rest is scratch.
    double volume, volume_low; ///< running sum and its rounding
    double low[3], high[3];    ///< box of all points seen
    double diagonal;           ///< its diagonal
    int64_t facet_capacity, vert_capacity;
    int32_t *free_facet, *free_vert;
    int32_t n_free_facet, n_free_vert;
    int64_t free_facet_capacity, free_vert_capacity;
    double (*pending)[3]; ///< points kept while all are coplanar
    int32_t *pending_tag;
    int32_t n_pending;
    int64_t pending_capacity, pending_tag_capacity;
    int32_t *next; ///< [batch] links of the outside lists
    int64_t next_capacity;
    int32_t *candidate;
    int64_t candidate_capacity;
    clx_lanes *plane; ///< [n_candidate / 4] the candidates' normals and minus offsets from `low`
    int64_t plane_capacity;
    int32_t *work;
    int32_t n_work;
    int64_t work_capacity;
    int32_t *visible;
    int32_t n_visible;
    int64_t visible_capacity;
    clx_hull_edge *horizon;
    int32_t n_horizon;
    int64_t horizon_capacity;
    int32_t *fresh; ///< [n_horizon] new facets
    int64_t fresh_capacity;
    int64_t stamp;
    int64_t n_made; ///< facets ever
} clx_hull_inc;

void clx_hull_inc_free(clx_hull_inc *hull);

/// Adds n points, each with the caller's tag; which of them are inside is found by itself.
///
/// A batch costs one box test per facet of the hull and then, per point, only the facets that the
/// batch's box can see: a grain buried in an aggregate is rejected in O(facets) flops for all its
/// points together.
/// @return CLAST_E_GEOMETRY for a coordinate that is not finite (nothing is added), CLAST_E_MEMORY
///         (the hull is then still the hull of some of the points)
clast_status clx_hull_inc_add(clx_hull_inc *hull, int32_t n, const double (*point)[3],
                              const int32_t *tag);

/// Inserts one point that is thought to see a live facet of a solid hull; *done tells whether it
/// did.
///
/// Until the next call, hull->visible [n_visible] are the slots of the facets it replaced (their
/// fields `owner`, `excess` and `gap` still readable) and hull->fresh [n_horizon] the new ones.
clast_status clx_hull_inc_insert(clx_hull_inc *hull, const double point[3], int32_t tag,
                                 int32_t facet, bool *done);

/// Closes the gaps that dropped facets and vertices left in the arrays; slots change.
///
/// A hull has the fewest facets when it is large: what a lone sphere needed is long gone, and every
/// look at all facets would pass over the empty slots.
clast_status clx_hull_inc_compact(clx_hull_inc *hull);

/// Volume of the hull; 0 while all points are coplanar. O(1): the sum of what each insertion added,
/// all terms positive, with compensation.
double clx_hull_inc_volume(const clx_hull_inc *hull);
