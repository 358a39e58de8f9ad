#pragma once
// Contacts of one kind, four side by side.
#include "contact/facet_lanes.h"
#include "dem/push.h"

typedef enum {
    CLX_BATCH_FACES,   ///< hulls whose memory is a face with a vertex
    CLX_BATCH_EDGES,   ///< hulls whose memory is a pair of edges
    CLX_BATCH_SPHERES, ///< whole grains
    CLX_BATCH_ELLIPSOIDS,
    CLX_BATCH_ANY, ///< all others, one by one
    CLX_N_BATCH
} clx_batch_kind;

typedef struct clx_batch {
    int n;                     ///< contacts in it; the lanes beyond repeat the first
    clx_pushed *to[CLX_LANES]; ///< where what they do is written
    clx_link *link[CLX_LANES]; ///< may wake now
    double travel[CLX_LANES];  ///< of both grains
    const clx_grain *a[CLX_LANES], *b[CLX_LANES];
    clx_pair_batch meet;        ///< where they meet; the offset is of whole grains
    double arm_b[3][CLX_LANES]; ///< from b's centre to the contact point
} clx_batch;

/// Offsets of whole grains.
void clx_batch_offsets(const clast_dem *dem, clx_batch *batch);

/// Pairs of spheres; offsets are known.
void clx_batch_spheres(clx_batch *batch);

/// Arms on b of pairs whose contact points and offsets are known.
void clx_batch_arms(clx_batch *batch);

/// Whether clx_batch_push can do this law.
static inline bool clx_batch_has_law(const clx_law *law)
{
    return law->kind == CLAST_DEM_LINEAR && law->cohesion == CLAST_DEM_DRY && law->rolling == 0.0;
}

/// Forces of four contacts by the linear law: the twin of clx_law_force, with its bits. Writes what
/// the marked lanes (bits) push, and their displacements. Walls are looked for if there may be any.
void clx_batch_push(const clast_dem *dem, const clx_batch *batch, int lanes, bool has_walls);
