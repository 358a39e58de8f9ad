#pragma once
// Contacts of one kind, up to eight side by side.
#include "contact/facet_lanes.h"
#include "dem/pair_force.h"

typedef enum {
    CLX_BATCH_FACES,   ///< hulls whose memory is a face with a vertex
    CLX_BATCH_EDGES,   ///< hulls whose memory is a pair of edges
    CLX_BATCH_SPHERES, ///< whole grains
    CLX_BATCH_ELLIPSOIDS,
    CLX_BATCH_ANY, ///< all others, one by one
    CLX_N_BATCH
} clx_batch_kind;

typedef struct clx_batch {
    int n; ///< contacts in it, 1 to CLX_BATCH; the places beyond repeat the last
    clx_pair_force *to[CLX_BATCH]; ///< where what they do is written
    clx_dem_pair *pair[CLX_BATCH]; ///< awake
    double travel[CLX_BATCH];      ///< of both grains
    const clx_grain *a[CLX_BATCH], *b[CLX_BATCH];
    clx_pair_batch meet;        ///< where they meet; the offset is of whole grains
    double arm_b[3][CLX_BATCH]; ///< from b's centre to the contact point
} clx_batch;

/// Where pairs of spheres meet, and arms.
void clx_batch_spheres(const clast_dem *dem, clx_batch *batch);

/// Remembered facets of hulls, with rounding, and arms. Returns which lanes are answered, as bits.
int clx_batch_faces(const clast_dem *dem, clx_batch *batch);
int clx_batch_edges(const clast_dem *dem, clx_batch *batch);

/// Offsets of whole grains; then, where contact points are known too, arms on b.
void clx_batch_offsets(const clast_dem *dem, clx_batch *batch);
void clx_batch_arms(clx_batch *batch);

/// Whether clx_batch_force can do this law.
static inline bool clx_batch_has_law(const clx_law *law)
{
    return law->kind == CLAST_DEM_LINEAR && law->cohesion == CLAST_DEM_DRY && law->rolling == 0.0 &&
           !law->is_wet;
}

/// What contacts do by the linear law: the twin of clx_law_force, with its bits. Writes their
/// forces, displacements and whether they touch; where one is apart, when it may wake. Walls are
/// looked for if there may be any.
void clx_batch_force(const clast_dem *dem, const clx_batch *batch, bool has_walls);
