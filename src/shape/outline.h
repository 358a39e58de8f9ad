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

/// The outer outline of the shadow along a unit direction, as seen from a centre: of each ray the
/// farthest edge between a facet turned to the light and one turned away.
clast_status clx_outline_cast(const clast_mesh *mesh, const double direction[3],
                              const double centre[3], clx_outline *outline);

/// Smooths by local quadratics of tricube weight over a window of this length [Cleveland1979].
void clx_outline_smooth(clx_outline *outline, double window);

/// The greatest circle inside, by ascent from several starts.
void clx_outline_inscribed(const clx_outline *outline, double centre[2], double *radius);
