#pragma once
// How far two placed bodies are apart: for lists of contacts and for proofs that nothing overlaps.
#include "touch/scene.h"

typedef struct clx_gap {
    double distance;    ///< between the bodies; 0 if they intersect or one is inside the other. Two
                        ///< round bodies that overlap give minus the depth
    double point[2][3]; ///< closest points, on the first and on the second body (of bodies that
                        ///< intersect: one such place; of one inside the other: not set)
} clx_gap;

/// Distance of two bodies; false, and *gap untouched, if it is greater than `limit`.
///
/// Spheres and composites of them: closed form. Ellipsoids: Newton on the common normal to 1e-14 of
/// the size. Surfaces: closed forms over pairs of triangles. Ellipsoid and surface: closed form for
/// faces, a convex search along edges.
/// @note no allocation, thread-safe
bool clx_touch_gap(const clx_touch_body *a, const clx_touch_body *b, double limit, clx_gap *gap);

/// The bodies overlap by more than `depth`: they intersect, and no shift by `depth` along the tried
/// directions (the line of centres, the axes, and `approach` unless NULL) parts them.
bool clx_touch_overlap(const clx_touch_body *a, const clx_touch_body *b, double depth,
                       const double approach[3]);

/// Called for each body within the distance; false ends the visit.
typedef bool (*clx_gap_visit)(int32_t body, const clx_gap *gap, void *context);

/// Visits all bodies of the scene within `distance` of a body (gap->point[0] is on that body; where
/// one body is inside the other the points are the centres); in
/// no stated but repeatable order. False if the visitor ended it.
bool clx_touch_scene_contacts(const clx_touch_scene *scene, const clx_touch_body *body,
                              double distance, clx_gap_visit visit, void *context);
