#pragma once
// Cells out of bins: boxes, face-connected components, single bins or whole labels.
// [docs/theory/decompose.md]
#include "cloud/bins.h"

typedef enum {
    CLX_CELLS_BOXES,
    CLX_CELLS_COMPONENTS,
    CLX_CELLS_BINS,
    CLX_CELLS_LABELS
} clx_cells_kind;

/// Numbers every bin's cell: bins of one cell share (pass, label) as coded in `tag`.
///
/// Boxes: scan row-major, start at the first free bin, grow along the last axis as far as the tag
/// and freedom allow, then along the axis before it, and so on. Numbers follow the first bin of
/// each cell.
///
/// @param tag  [n_bin] any code of (pass, label)    @param cell  [n_bin] out
clast_status clx_cells_make(const clx_bins *bins, clx_cells_kind kind, const uint16_t *tag,
                            int32_t *cell, int32_t *n_cell);
