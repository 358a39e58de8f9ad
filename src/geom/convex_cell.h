#pragma once
// A convex body made by cutting a box with half-spaces: cells of Voronoi and power diagrams.
#include "base/status.h"

enum { CLX_CELL_FACES = 200, CLX_CELL_CORNERS = 128 };

typedef struct clx_cell_face {
    int32_t n;
    int32_t mark;                       ///< of the half-space that made it
    double corner[CLX_CELL_CORNERS][3]; ///< counter-clockwise from outside
} clx_cell_face;

/// Faces hold their own corners; coordinates are relative to a point of the caller's.
typedef struct clx_cell {
    int32_t n_face;
    clx_cell_face face[CLX_CELL_FACES];
} clx_cell;

/// The box low .. high; its faces are marked -1 (low x), -2 (high x), -3, ... -6.
void clx_cell_box(const double low[3], const double high[3], clx_cell *cell);

/// Keeps what has normal . x <= offset; the new face gets the mark. The cell may become empty.
///
/// @return CLAST_E_LIMIT beyond 200 faces or 128 corners a face
clast_status clx_cell_cut(clx_cell *cell, const double normal[3], double offset, int32_t mark);

double clx_cell_volume(const clx_cell *cell);

/// Greatest squared distance of a corner from the origin.
double clx_cell_reach2(const clx_cell *cell);
