#pragma once
// Contacts of one kind, up to eight in SIMD lanes.
#include "convex/facet_lanes.h"
#include "dem/pair_force.h"

typedef enum {
    CLX_BATCH_FACES,   ///< hulls whose warm start is a face with a vertex
    CLX_BATCH_EDGES,   ///< hulls whose warm start is a pair of edges
    CLX_BATCH_SPHERES, ///< whole grains
    CLX_BATCH_ELLIPSOIDS,
    CLX_BATCH_ANY, ///< all others, one by one
    CLX_N_BATCH
} clx_batch_kind;

typedef struct clx_batch {
    int n;                         ///< contacts in it, 1 to CLX_BATCH; lanes beyond repeat the last
    clx_pair_force *to[CLX_BATCH]; ///< where their forces are written
    clx_dem_pair *pair[CLX_BATCH]; ///< active
    double travel[CLX_BATCH];      ///< of both grains
    const clx_grain *a[CLX_BATCH], *b[CLX_BATCH];
    clx_pair_batch meet;        ///< contacts; the offset is of whole grains
    double arm_b[3][CLX_BATCH]; ///< from b's centre to the contact point
} clx_batch;

/// Contacts of spheres, and arms.
void clx_batch_spheres(const clast_dem *dem, clx_batch *batch);

/// Contacts of hulls from the facets of their warm starts, with rounding, and arms. Returns which
/// lanes are answered, as bits.
int clx_batch_faces(const clast_dem *dem, clx_batch *batch);
int clx_batch_edges(const clast_dem *dem, clx_batch *batch);

/// Offsets of whole grains; then, where contact points are known too, arms on b.
void clx_batch_offsets(const clast_dem *dem, clx_batch *batch);
void clx_batch_arms(clx_batch *batch);

/// Whether clx_batch_force has code for such contacts. Those with walls, and of parts of grains, go
/// through lanes by springs, dashpots and friction of the linear law alone, where no material and
/// no wall's motion matters.
static inline bool clx_batch_has_law(const clast_dem *dem, clx_batch_kind kind)
{
    const clx_law *law = &dem->law;
    if (dem->config.added_mass > 0.0) {
        return false;
    }
    if (dem->laws.n > 0) {
        return kind != CLX_BATCH_ANY && dem->laws.are_plain && !law->is_exact;
    }
    return !law->has_history && !law->has_neck &&
           (kind != CLX_BATCH_ANY ||
            (law->kind == CLAST_DEM_LINEAR && clx_law_is_plain(law) && !clx_walls_move(dem)));
}

/// Pair forces: clx_law_force and clx_law_roll in lanes, with the same bits. Writes forces,
/// displacements and whether pairs touch; where one is apart, its active_from.
void clx_batch_force(const clast_dem *dem, const clx_batch *batch, clx_batch_kind kind);
