#pragma once
// Cells of the bounding box become cells of a mesh domain.
#include "cloud/sample.h"

/// Volumes of the parts inside [m^3]; cells without one are left out and the others numbered anew.
/// Points on a face of the surface whose cell is left out go to the nearest cell.
///
/// @param cells  in the unit cube, with of_point
clast_status clx_cells_cut(const clx_sample *sample, clast_cells *cells);
