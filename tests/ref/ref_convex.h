#pragma once
// Plain, cold twins of the contact queries: every feature with every other, no search.
#include "convex/convex.h"

/// A placed polytope written out: vertices, triangles' planes, edges.
typedef struct ref_polytope {
    int32_t n_vert, n_edge, n_face;
    double (*vert)[3];
    int32_t (*edge)[2];
    int32_t (*face)[3];
} ref_polytope;

/// The core's vertices at position + turn (scale x); faces as fans. Free with ref_polytope_free.
ref_polytope ref_polytope_of(const clx_convex *shape, const double turn[9],
                             const double position[3]);
void ref_polytope_free(ref_polytope *p);

/// Signed gap of two polytopes: all separating axes if they overlap, else the least distance of all
/// vertex-triangle and edge-edge pairs.
double ref_polytope_gap(const ref_polytope *a, const ref_polytope *b);

/// Gap of polytope a and b in direction n (from b to a): a lower bound of the true gap.
double ref_gap_along(const ref_polytope *a, const ref_polytope *b, const double n[3]);

/// Signed gap of two ellipsoids (semi-axes 0: a point): a grid on the sphere, then ever smaller
/// pattern steps.
double ref_ellipsoid_gap(const clx_pair *pair);

/// A lower bound of the signed gap of any pair, close to it for round ones: a grid and pattern
/// search over directions, which may stop at the kinks of a hull.
double ref_support_gap(const clx_pair *pair);

/// Gap in the unit direction m from a to b, rounding included.
double ref_support_along(const clx_pair *pair, const double m[3]);
