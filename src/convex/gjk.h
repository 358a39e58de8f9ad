#pragma once
// Distance and penetration of two convex bodies by their support functions (GJK, EPA), in the
// frame of the first body and in units of the larger one.
#include "convex/convex.h"

/// A body as the algorithms see it: x = shift + turn (scale * core vertex), or an ellipsoid, or a
/// point.
typedef struct clx_seen {
    const clx_hull_core *core; ///< NULL: ellipsoid
    double scale;
    double semi_axes[3]; ///< all 0: a point
    double rotation[9];
    double shift[3];
    bool is_rotated; ///< false: turn is the unit matrix and shift is 0
    int32_t last;    ///< vertex of the last support query
} clx_seen;

/// A point of the Minkowski difference A - B with the points it comes from.
typedef struct clx_mink {
    double w[3]; ///< a - b
    double b[3];
    int32_t vert[2]; ///< of a, of b; -1 where smooth
} clx_mink;

/// Vertices that hold the closest point of the difference to the origin, with its weights.
typedef struct clx_simplex {
    int n;
    clx_mink p[4];
    double weight[4];
} clx_simplex;

/// What is wanted of both.
typedef struct clx_gjk_pair {
    clx_seen a, b;
    double size; ///< length of the difference's largest vector, for tolerances (about 1 to 3)
    bool is_smooth;
} clx_gjk_pair;

typedef enum {
    CLX_GJK_APART,  ///< v holds the vector of least distance, from b to a
    CLX_GJK_BEYOND, ///< farther than max_gap; v's length is a lower bound
    CLX_GJK_OVERLAP ///< they overlap, or touch within rounding
} clx_gjk_answer;

/// Point of A - B farthest along direction d.
void clx_mink_support(clx_gjk_pair *pair, const double d[3], clx_mink *out);

/// The point of A - B of two hull vertices.
void clx_mink_of(const clx_gjk_pair *pair, int32_t vert_a, int32_t vert_b, clx_mink *out);

/// Shortest vector from b to a. The simplex may hold points to start from (n = 0: none); it ends
/// with those that hold the answer. `gap` is the distance, or the bound for BEYOND.
///
/// [Gilbert1988; Montanari2017 for the subproblem]. Keeps the best iterate and cannot cycle.
clx_gjk_answer clx_gjk(clx_gjk_pair *pair, double max_gap, clx_simplex *simplex, double v[3],
                       double *gap);

/// Least move that parts two overlapping bodies: `depth` >= 0 (to rounding) and unit `normal`, the
/// direction in which a must move. The simplex is where to start and ends with the facet of A - B
/// that holds the answer. Returns what the depth may be too great by.
///
/// Expanding polytope [vandenBergen2001], grown from the lowest facet even where the origin is
/// still outside, so that touching bodies need no special case.
double clx_epa(clx_gjk_pair *pair, clx_simplex *simplex, double normal[3], double *depth);
