#pragma once
// Convex hull of points, spheres and ellipsoids, with bounds: an inner polytope that is refined
// where a body still sticks out, and an exact volume from its combinatorics.
#include "geom/body.h"
#include "geom/hull_inc.h"
#include "geom/lanes.h"

/// A facet that waits for refinement; out of date when the facet's slot has changed hands.
typedef struct clx_hull_wait {
    double gap;
    int32_t facet;
    int64_t serial; ///< of the facet at its survey
} clx_hull_wait;

/// {0} is empty; free with clx_smooth_hull_free. One thread at a time.
typedef struct clx_smooth_hull {
    clx_hull_inc inner; ///< hull of touch points; a vertex's tag is its body, or -1 - k for point k
    clx_body *body;     ///< [n_body] smooth ones
    int32_t n_body;
    int64_t body_capacity;
    int32_t *exposed; ///< [n_exposed] bodies that may stick out of the inner hull
    int32_t n_exposed, n_pruned;
    int64_t exposed_capacity;
    clx_lanes *balls; ///< [ceil(n_exposed / 4)] centres and radii in the order of exposed
    int64_t balls_capacity;
    int32_t n_point;      ///< points added so far
    double centre[3];     ///< inside the inner hull: apex of the facets' cones
    double centre_volume; ///< inner volume when it was chosen
    double gap;           ///< outer minus inner volume
    bool is_surveyed;     ///< every facet's excess and gap are known
    clx_hull_wait *wait;  ///< [n_wait] heap, greatest gap first
    int64_t n_wait, wait_capacity;
    double (*touch)[3]; ///< scratch
    int32_t *touch_tag;
    int64_t touch_capacity, touch_tag_capacity;
} clx_smooth_hull;

/// Bounds and value of a hull's volume.
typedef struct clx_hull_volume {
    double low, high; ///< rigorous: inner polytope; outer polyhedron
    double value;     ///< best value within them
    double error;     ///< estimate of |value - true|
    bool is_exact;    ///< value is the closed form over the hull's faces
} clx_hull_volume;

void clx_smooth_hull_free(clx_smooth_hull *hull);

/// Adds points (vertices of polyhedra): exact, no refinement needed.
clast_status clx_smooth_hull_add_points(clx_smooth_hull *hull, int32_t n, const double (*point)[3]);

/// Adds a smooth body of radius > 0. What sticks out is brought in by the next refine. O(facets).
clast_status clx_smooth_hull_add_body(clx_smooth_hull *hull, const clx_body *body);

/// Refines the inner polytope until (outer - inner) <= tolerance * inner.
///
/// For a facet with unit normal n at distance d from a centre inside, no body reaches beyond the
/// plane n.x = d + e, so the hull's part in the facet's cone has at most (1 + e/d)^3 times the
/// cone's volume; the sum of the differences is the gap.                [docs/theory/envelope.md]
/// @return CLAST_E_CONVERGE when the points exceed 10^6 first (the gap is still right)
/// @note the widest gap is closed first, one point at a time; a sphere needs about 5 / tolerance
clast_status clx_smooth_hull_refine(clx_smooth_hull *hull, double tolerance);

/// Volume with its bounds after clx_smooth_hull_refine, O(facets): inner volume and, by kind of
/// facet, 3/4 (on one body), 2/3 (on two) and 1/2 of its gap.
void clx_smooth_hull_volume(const clx_smooth_hull *hull, clx_hull_volume *volume);

/// Volume over the true faces: planes on three bodies, ruled strips on two, patches of one, by line
/// integrals along the strips' edges. Errors are those of rounding once every body that shows is
/// known to the polytope; where another body is found beyond a face, its point is inserted and the
/// sum done again.
///
/// Falls back to clx_smooth_hull_volume (is_exact false) when a face cannot be solved for, for
/// example for two equal bodies in one place.                          [docs/theory/envelope.md]
clast_status clx_smooth_hull_exact(clx_smooth_hull *hull, clx_hull_volume *volume);

/// Greatest support of all exposed bodies in direction u, and the body, or -1.
double clx_smooth_hull_support(const clx_smooth_hull *hull, const double u[3], int32_t *body);

/// True when a ball lies within every facet's plane: nothing of it can show, now or later.
bool clx_smooth_hull_hides(const clx_smooth_hull *hull, const double centre[3], double radius);

/// Forgets the bodies of which no facet sees anything.
void clx_smooth_hull_prune(clx_smooth_hull *hull);

/// Finds anew what sticks out over every facet, after points came in by other ways.
clast_status clx_smooth_hull_survey(clx_smooth_hull *hull);

/// Room for n touch points in the scratch.
clast_status clx_smooth_hull_reserve(clx_smooth_hull *hull, int64_t n);
