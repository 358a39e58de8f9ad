#pragma once
// The outline of a surface's shadow as evenly spaced points.
#include <clast/status.h>

enum { CLX_OUTLINE_POINTS = 720 };

/// Counter-clockwise about the origin.
typedef struct clx_outline {
    double point[CLX_OUTLINE_POINTS][2];
    double length;  ///< of the closed polygon that was cut into equal pieces
    int32_t n_edge; ///< edges of the surface that the outline is made of; 0: no outline
} clx_outline;

/// A shadow as the edges between a facet turned to the light and one turned away.
typedef struct clx_rim {
    int32_t n;
    double (*end)[2][2]; ///< [n], of each edge, about the centre
} clx_rim;

/// The rim of the shadow along a unit direction, as seen from a centre; `rim` must be empty.
clast_status clx_rim_find(const clast_mesh *mesh, const double direction[3], const double centre[3],
                          clx_rim *rim);
void clx_rim_free(clx_rim *rim);

/// The outer outline of a rim: of each ray from the centre the farthest edge. Its first ray is
/// turned by `turn` from the first axis; a mirrored one runs the other way around the shadow.
clast_status clx_outline_cast(const clx_rim *rim, double angle, bool is_mirrored,
                              clx_outline *outline);

/// Smooths by local quadratics of tricube weight over a window of this length [Cleveland1979].
void clx_outline_smooth(clx_outline *outline, double window);

/// The greatest circle inside, by ascent from several starts.
void clx_outline_inscribed(const clx_outline *outline, double centre[2], double *radius);
