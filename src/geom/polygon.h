#pragma once
// Polygons in space cut into triangles that keep every corner and the true area.
#include "base/status.h"

/// Scratch of many cuts; {0} is ready for use.
typedef struct clx_polygon_cutter {
    double (*flat)[2]; ///< corners in the plane of the two largest extents of the area
    int32_t *next, *prev;
    int32_t *reflex;    ///< corners that are not convex, and some that were
    uint8_t *is_tried;  ///< known to be no ear
    uint8_t *is_reflex; ///< and in the list
    int32_t n_reflex;
    int64_t capacity;
    int64_t n_test; ///< tests of a corner so far, over all polygons
} clx_polygon_cutter;

/// Tests allowed over all polygons of one cutter (about 1 s): a bound on hostile files. A polygon
/// of n corners, r of them not convex, needs at most about 3 n r.
enum { CLX_POLYGON_N_TEST = 200000000 };

typedef enum {
    CLX_POLYGON_FAN,     ///< convex, or star-shaped from its first corner
    CLX_POLYGON_EARS,    ///< cut ear by ear
    CLX_POLYGON_CROSSING ///< crosses itself: some triangles lie the wrong way round
} clx_polygon_kind;

/// Cuts the polygon vert[corner[0..n)] into n - 2 triangles of vertex numbers.
///
/// Triangles turn as the polygon does, no corner is dropped (also those on a straight edge, so
/// that neighbours still match), and no two overlap unless the kind is CROSSING.
///
/// @param tri  [n - 2][3]
/// @return CLAST_E_LIMIT when the tests are used up; CLAST_E_MEMORY
/// @note O(n) for a fan, O(n r) otherwise
clast_status clx_polygon_cut(clx_polygon_cutter *cutter, const double (*vert)[3], int32_t n,
                             const int32_t *corner, int32_t (*tri)[3], clx_polygon_kind *kind);

void clx_polygon_cutter_free(clx_polygon_cutter *cutter);
