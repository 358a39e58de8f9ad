#pragma once
// Gap of two ellipsoids (points among them) by their common normal.
#include <stdbool.h>

/// Steps from a warm start's normal: how many at most, and how long. Ones shorter than SHORT need
/// no new value, s + g.step / 2 is exact to their third power; LONG is where Newton's next step is
/// still a thousandth of this one.
#define CLX_ELLIPSOID_STEPS 3
#define CLX_ELLIPSOID_SHORT 1e-5
#define CLX_ELLIPSOID_LONG  0.03

/// Two ellipsoids by their matrices xx, yy, zz, yz, xz, xy (support h(n) = sqrt(n^T M n); all 0 is
/// a point), and centre of b minus centre of a.
typedef struct clx_ellipsoids {
    double a[6], b[6];
    double offset[3];
    double roundness; ///< sum of both least radii of curvature: above minus this the gap is unique
} clx_ellipsoids;

/// The greatest over unit m of m . offset - h_a(m) - h_b(m): the distance if positive, minus the
/// least move that parts them if negative.
///
/// Newton on the unit sphere with a step that must gain [docs/theory/contact-convex.md eq. 4-7].
/// Where the answer is deeper than `roundness` there may be several maxima: then many starts.
///
/// @param m  in: where to start (0: unknown); out: the common normal, from a to b
double clx_ellipsoid_gap(const clx_ellipsoids *pair, double m[3]);

/// R diag(axes^2) R^T as xx, yy, zz, yz, xz, xy.
void clx_ellipsoid_matrix(const double rotation[9], const double semi_axes[3], double matrix[6]);

/// Point of the ellipsoid farthest along m, relative to its centre.
void clx_ellipsoid_tip(const double matrix[6], const double m[3], double tip[3]);
