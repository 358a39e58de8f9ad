#pragma once
// Delaunay tetrahedra of points (qhull), sorted by the radius of their circumscribed sphere.
#include "base/status.h"

typedef struct clx_delaunay_tet {
    int32_t corner[4]; ///< rising
    double radius;     ///< of the circumscribed sphere
} clx_delaunay_tet;

typedef struct clx_delaunay_face {
    int32_t corner[3]; ///< rising
    int32_t tet;       ///< four times the tetrahedron, plus which corner is opposite
} clx_delaunay_face;

typedef struct clx_delaunay {
    int32_t n_tet;
    clx_delaunay_tet *tet;    ///< [n_tet] by rising radius
    clx_delaunay_face *faces; ///< [4 n_tet] scratch
    int32_t (*neighbour)[4]; ///< [n_tet] tetrahedron behind the face opposite to each corner, or -1
} clx_delaunay;

/// @return CLAST_E_GEOMETRY when the points lie in a plane
clast_status clx_delaunay_make(int32_t n, const double (*point)[3], clx_delaunay *delaunay);
void clx_delaunay_free(clx_delaunay *delaunay);

/// Marks what is outside of the alpha shape of the first n tetrahedra (those up to a radius): the
/// others that are reached from infinity through faces between them. Closed voids are not.
///
/// @param outside  [n_tet]
clast_status clx_delaunay_outside(const clx_delaunay *delaunay, int32_t n, bool *outside);
