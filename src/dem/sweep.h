#pragma once
// Contacts and motion in one sweep over the grains, divided among threads.
#include "base/status.h"
#include "dem/pair.h"
#include <clast/dem.h>

struct clx_chunk;
struct clx_pace;

/// How a sweep is divided among threads (chunk.c), and contributions to deferred grains (sweep.c).
typedef struct clx_sweeping {
    int32_t n_worker; ///< 0: its work is to be counted anew
    _Atomic int32_t n_chunk;
    struct clx_chunk *chunk; ///< [n_chunk], first the threads' own, then what others stole
    struct clx_pace *pace;   ///< [n_worker]
    int64_t *before;         ///< [blocks + 1] work of all blocks of grains before
    _Atomic int32_t *lowest; ///< [groups of four grains] least grain in a pair with one of them
    int32_t most;            ///< pairs of a block of grains
    clx_pair_force *force;   ///< [n_worker][most] of the block that a worker is at
    clx_active_pair *active; ///< [n_worker][most] its active pairs
    int32_t *deferred;       ///< [n_deferred] first grains of the groups of four that move last
    int32_t n_deferred;
    clx_force_torque *contribution; ///< [n of inner + n_grain] forces and torques on them
    int32_t *contribution_to;       ///< grain of each
    int64_t chunk_capacity, pace_capacity, before_capacity, lowest_capacity, deferred_capacity;
    int64_t force_capacity, active_capacity, contribution_capacity[2];
} clx_sweeping;

void clx_sweeping_free(clx_sweeping *sweeping);

/// Contacts and motion of whole grains in one sweep: the bits of clx_contacts and clx_move.
/// *is_fine as clx_move.
clast_status clx_sweep(clast_dem *dem, bool *is_fine);
