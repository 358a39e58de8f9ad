#pragma once
// What the library's own code may know of a clast_bvh: its nodes and its triangles in leaf order.
#include "geom/tree.h"
#include <clast/mesh.h>

/// How clast_bvh_inside decides.
typedef enum {
    CLX_BVH_WINDING,    ///< closed, oriented: crossings with sign
    CLX_BVH_PARITY,     ///< closed but for orientation: crossings without sign
    CLX_BVH_SOLID_ANGLE ///< open: generalised winding number
} clx_bvh_rule;

/// Expansion of the solid angle of one node's triangles about `centre` [Barill2018 eq. 10].
typedef struct clx_bvh_moment {
    double centre[3];    ///< area-weighted
    double radius;       ///< greatest distance of a corner from the centre
    double dipole[3];    ///< sum of area times normal
    double second[3][3]; ///< sum of area times (centroid - centre) times normal^T
} clx_bvh_moment;

struct clast_bvh {
    const clast_mesh *mesh; ///< borrowed
    clx_tree tree;          ///< item i of the tree is triangle tree.item[i] of the mesh; boxes are
                            ///< padded by 2^-50 of the largest coordinate
    double (*corner)[3][3]; ///< [n_tri] corners of triangle tree.item[i], in leaf order
    double max_abs;         ///< largest absolute coordinate
    clx_bvh_rule rule;
    clx_bvh_moment *moment; ///< [n_node], for CLX_BVH_SOLID_ANGLE only
};

/// True if every edge of the surface is used equally often in both directions.
bool clx_bvh_is_closed(const clast_mesh *mesh);

/// Closest point of a triangle to a point: squared distance; *closest is on the triangle to
/// rounding, also for slivers and triangles that are segments or points.
double clx_triangle_closest(double corner[3][3], const double point[3], double closest[3]);

/// What a triangle adds to the number of times that a vertical ray upwards from a point leaves the
/// solid: +1, -1 or 0, exact (simulation of simplicity). *is_on when the triangle holds the point.
int clx_triangle_crossing(double corner[3][3], const double point[3], bool *is_on);

/// Generalised winding number of the surface about a point (an open surface's fraction); needs
/// bvh->moment.
double clx_bvh_solid_angle(const clast_bvh *bvh, const double point[3]);

/// Fills bvh->moment [n_node] from the tree and the corners.
void clx_bvh_fill_moments(clast_bvh *bvh);

/// True if two triangles have a common point besides the corners and the edge they share: they
/// cross, overlap in one plane, or touch (a corner on the other's face or edge). Exact.
///
/// Corners are shared when they are at the same place, whatever their numbers. Triangles with all
/// three corners shared (duplicates) and triangles without area are faults of another kind: false.
bool clx_triangles_meet(double a[3][3], double b[3][3]);

/// Pairs of triangles that meet in the sense of clx_triangles_meet, what `mesh check` reports.
///
/// All are counted in *n_pair; min(*n_pair, cap) of them are written to pair, each with its lower
/// number first, in rising order (when there are more than cap: some of them, always the same).
/// O(n log n) and the same for any thread count.
///
/// @param budget  pairs to test (of some 50 ns; exact arithmetic counts as more) before the search
///                is given up: *n_pair is then -1
/// @param pair    [cap][2], or NULL with cap = 0
clast_status clx_bvh_self_intersections(const clast_bvh *bvh, int64_t budget, int64_t cap,
                                        int32_t (*pair)[2], int64_t *n_pair);
