#pragma once
// Remembered facets of four pairs asked again side by side: the bits of clx_facet_again.
#include "contact/convex.h"
#include "math/lanes.h"

/// Four pairs with memories; all four are filled (repeat one where there are fewer).
typedef struct clx_pair_batch {
    const double *turn_a[CLX_LANES], *turn_b[CLX_LANES]; ///< [9] each
    const clx_contact_memory *memory[CLX_LANES];
    double offset[3][CLX_LANES]; ///< position of b minus that of a
    double gap[CLX_LANES];       ///< from here on: the contacts, without rounding
    double normal[3][CLX_LANES]; ///< from b to a
    double point[3][CLX_LANES];
} clx_pair_batch;

/// Memories of kinds FACE_VERTEX and VERTEX_FACE. Returns which lanes are answered, as bits; what
/// the others get is undefined.
int clx_facet_faces_again(clx_pair_batch *batch);

/// Memories of kind EDGE_EDGE.
int clx_facet_edges_again(clx_pair_batch *batch);
