#pragma once
// A convex body made by cutting a box with half-spaces: cells of Voronoi and power diagrams.
#include "base/status.h"

typedef struct clx_cell_face {
    int32_t n;
    int32_t mark;        ///< of the half-space that made it
    double (*corner)[3]; ///< [n] counter-clockwise from outside
    int64_t capacity;
} clx_cell_face;

/// Faces hold their own corners; coordinates are relative to a point of the caller's. A cell keeps
/// its memory from one box to the next.
typedef struct clx_cell {
    int32_t n_face;
    clx_cell_face *face; ///< [n_face]
    int64_t n_made;      ///< faces that own corners
    int64_t face_capacity;
    clx_cell_face clipped; ///< a face while it is cut
    clx_cell_face rim;     ///< where faces were cut, each corner twice (once from each side)
    double *height;        ///< of a face's corners over the plane
    int64_t height_capacity;
    struct clx_cell_spoke *spoke;
    int64_t spoke_capacity;
} clx_cell;

/// The box low .. high; its faces are marked -1 (low x), -2 (high x), -3, ... -6.
clast_status clx_cell_box(const double low[3], const double high[3], clx_cell *cell);
void clx_cell_free(clx_cell *cell);

/// Keeps what has normal . x <= offset; the new face gets the mark. The cell may become empty.
clast_status clx_cell_cut(clx_cell *cell, const double normal[3], double offset, int32_t mark);

double clx_cell_volume(const clx_cell *cell);

/// Greatest squared distance of a corner from the origin.
double clx_cell_reach2(const clx_cell *cell);
