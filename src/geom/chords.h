#pragma once
// Chords of a convex hull: for cells of directions, the same of opposite ones, two vertices far
// apart. No width along a direction is less than a chord's part along it, so chords bound widths,
// and rectangles around shadows, from below: within a per cent.
#include "base/machine.h"
#include "geom/hull_body.h"
#include <math.h>

enum {
    CLX_CHORD_GRID = 12,
    CLX_N_CHORD = 3 * CLX_CHORD_GRID * CLX_CHORD_GRID,
    CLX_N_ARC = 8, ///< of a quarter turn
    CLX_ALL_ARCS = (1 << (CLX_N_ARC + 1)) - 1
};

typedef struct clx_chord {
    double d[3];       ///< from low to high
    int32_t high, low; ///< the vertices farthest along the cell's middle and against it
} clx_chord;

typedef struct clx_chords {
    double longest;  ///< chord: no more than the longest caliper
    double shortest; ///< width along a cell's middle: no less than the shortest caliper
    double radius;   ///< of the vertex farthest from the origin
    double arc[3][2][2 * CLX_N_ARC]; ///< begin, middle and end of arcs of a half turn: x, y
    clx_chord cell[CLX_N_CHORD];
} clx_chords;

/// For hulls of more than 128 faces; of others none is made, *chords is NULL.
clast_status clx_chords_make(const clx_hull_body *body, clx_chords **chords);

/// The cell of a direction on the cube about it.
CLX_INLINE int32_t clx_chord_cell(const double d[3])
{
    static const int after[3][2] = {{1, 2}, {2, 0}, {0, 1}};
    int k = fabs(d[1]) > fabs(d[0]);
    k = fabs(d[2]) > fabs(d[k]) ? 2 : k;
    const double scale = 0.5 * CLX_CHORD_GRID / d[k];
    const int32_t i = (int32_t)(0.5 * CLX_CHORD_GRID + scale * d[after[k][0]]);
    const int32_t j = (int32_t)(0.5 * CLX_CHORD_GRID + scale * d[after[k][1]]);
    const int32_t last = CLX_CHORD_GRID - 1;
    return (k * CLX_CHORD_GRID + (i < last ? i : last)) * CLX_CHORD_GRID + (j < last ? j : last);
}

/// Arc of a quarter turn in which a side along (x, y) of a rectangle lies; CLX_N_ARC is the end of
/// the last one, where the first begins.
CLX_INLINE int32_t clx_arc_of(double x, double y)
{
    const double a = fabs(x);
    const double b = fabs(y);
    return (int32_t)(CLX_N_ARC * ((x < 0.0) == (y < 0.0) ? b : a) / (a + b));
}

/// Arcs, as bits by clx_arc_of, whose rectangles around the shadow in the plane of the unit vectors
/// u and v may have an area of no more than `limit`: all others have clearly more.
uint32_t clx_chords_arcs(const clx_chords *chords, const double u[3], const double v[3],
                         double limit);
