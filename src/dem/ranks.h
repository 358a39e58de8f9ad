#pragma once
// One bed over ranks (docs/theory/ranks.md).
//
// Every rank holds the whole simulation's grains by their numbers, as they were when they were last
// gathered, and steps a simulation of its own: its grains and the ghosts that they have pairs with,
// sorted by number. A pair is computed by each rank that moves one of its grains, from the same
// bytes, and its history stays with both. So every sum has the order that it has on one rank.
#include "base/comm.h"
#include "dem/dem.h"

/// Text that goes to other ranks, or has come.
typedef struct clx_wire {
    char *bytes;
    int64_t n, capacity;
} clx_wire;

/// What went between ranks so far, on this one.
typedef struct clx_rank_counts {
    int64_t n_balance;        ///< partitions
    int64_t n_migrated;       ///< grains that came from other ranks, but for the first partition
    int64_t n_message;        ///< sent in steps, to ranks that have ghosts of this one's grains
    int64_t step_bytes;       ///< sent in steps
    int64_t list_bytes;       ///< sent for lists and migration
    int64_t n_step, n_ghost;  ///< steps; ghosts, summed over steps
    double imbalance, before; ///< greatest over mean cost, after and before the last partition
    int32_t n_idle;           ///< ranks without a grain
    bool is_zoltan;           ///< the last partition is Zoltan's
} clx_rank_counts;

/// A grain's state: position, velocity, omega, orientation, angular momentum, travel, stability
/// load.
enum { CLX_WIRE_STATE = 18 };

typedef struct clx_wire_grain {
    int32_t number;
    int32_t is_own; ///< it comes from the rank that moves it
    double state[CLX_WIRE_STATE];
} clx_wire_grain;

typedef struct clx_wire_item {
    clx_anchor anchor;
    double limit;
    int32_t is_known, is_stale;
} clx_wire_item;

typedef struct clx_wire_pair {
    clx_dem_pair pair; ///< a, b: numbers of items of the whole; slot: 1 when it has a warm start
    clx_contact_history history;
    clx_warm_start warm_start;
} clx_wire_pair;

/// What has come: grains by number, the owner's first; pairs in the order of the list.
typedef struct clx_arrivals {
    int64_t n_grain, n_pair;
    const clx_wire_grain **grain; ///< [n_grain] each followed by its items
    const clx_wire_pair **pair;   ///< [n_pair]
    int64_t grain_capacity, pair_capacity;
} clx_arrivals;

typedef struct clx_ranks {
    const clast_comm *comm;
    clast_dem *local; ///< the rank's own simulation
    bool has_begun, is_current;
    int32_t n_synced; ///< the whole's grains that have been distributed
    double middle[3]; ///< of the rank's grains, in the period about the origin
    double strain[4]; ///< of a cell's sides, and shear, when its parts were last cut
    // [n_grain of the whole]
    int32_t *owner;    ///< rank that moves it
    int32_t *next;     ///< the same after the partition
    int32_t *local_of; ///< index in `local`, or -1
    double *cost;      ///< counted work of a step when it was last gathered
    int64_t owner_capacity, next_capacity, local_of_capacity, cost_capacity;
    // [n_grain of local]
    int32_t *number;
    uint8_t *is_ghost;
    int64_t number_capacity, is_ghost_capacity;
    // what goes between ranks in a step
    int32_t *send, *receive; ///< own grains that others read, and ghosts, by rank and number
    int64_t n_send, n_receive, send_capacity, receive_capacity;
    double *out, *in;
    int64_t out_capacity, in_capacity;
    int64_t *n_out, *n_in; ///< [n_rank] bytes
    clx_wire wire;         ///< what is being written for other ranks
    int64_t *n_wire;       ///< [n_rank] bytes of it for each
    int64_t *height;       ///< [n_grain of the whole] bits of heights, with hindrance
    int64_t height_capacity;
    int64_t *n_asked; ///< [n_rank] bytes of each rank's list of the grains that it reads
    clx_rank_counts counts;
} clx_ranks;

/// Spreads a simulation over ranks from its next step on; nothing where there is one. Called by all
/// ranks with the same simulation. Its energy book has begun before, or never does.
///
/// @return CLAST_E_ARGUMENT for ranks that cannot exchange bytes
clast_status clx_dem_share(clast_dem *dem, const clast_comm *comm);

/// clast_dem_step of a simulation over ranks. Called by all.
clast_status clx_ranks_step(clast_dem *whole, int64_t n_step);
void clx_ranks_destroy(clx_ranks *ranks);

/// Brings all grains to every rank; the same with all pairs, which go to rank 0. Nothing on one
/// rank. Called by all.
clast_status clx_dem_gather_grains(clast_dem *dem);
clast_status clx_dem_gather_all(clast_dem *dem);

/// clast_dem_measure of them, the same on every rank. Called by all.
clast_status clx_dem_gather_measures(clast_dem *dem, clast_dem_measures *measures);

/// clast_dem_load_measure and clast_dem_energy_measure, the same on every rank. Called by all.
clast_status clx_dem_gather_load(clast_dem *dem, clast_dem_load *load, clast_dem_energy *energy);

/// Whether a grain's centre is beyond a plane, sign (x - at) < 0, without gathering. Called by all.
bool clx_dem_any_beyond(const clast_dem *dem, int axis, double sign, double at);

/// Whether a step ended well on every rank (clast_comm_agree).
clast_status clx_dem_agree(const clast_dem *dem, clast_status status);

/// Sums over ranks of what went between them; false on one rank. Called by all.
bool clx_dem_rank_counts(const clast_dem *dem, clx_rank_counts *counts);

/// Highest centre of a grain [m], without gathering; -INFINITY without grains. Called by all.
double clx_dem_highest(const clast_dem *dem);

// Between the files of ranks.

/// Brings grains and the pairs of theirs to the ranks that `next` names: from `from`, which is the
/// rank's own simulation, or the whole on a rank that has all of it, or NULL.
clast_status clx_ranks_migrate(clast_dem *whole, const clast_dem *from);

/// Appends the grains from number `from` on that are this rank's.
clast_status clx_ranks_append(clast_dem *whole, int32_t from);

/// Pairs that came, as a simulation's list, by numbers of the whole.
clast_status clx_ranks_receive_pairs(clast_dem *dem, const clx_arrivals *arrivals);

/// Neighbour lists brought up to date, and ghosts with them.
clast_status clx_ranks_refresh(clast_dem *whole);

/// Which grains the ranks read of each other in a step; then what they are now.
clast_status clx_ranks_connect(clast_dem *whole);
void clx_ranks_exchange(clast_dem *whole);

/// The velocities of ghosts that the energy book needs, unless the rank's own contacts failed.
void clx_ranks_exchange_means(clast_dem *whole, bool is_ready);

/// What grains of all ranks did to the walls in a step.
clast_status clx_ranks_add_walls(clast_dem *whole);

/// The whole, gathered and changed, is distributed anew at the next step.
void clx_ranks_restart(clx_ranks *ranks);

/// A partition by cost into `next`, from positions of the whole that are up to date.
clast_status clx_ranks_partition(clast_dem *whole);

/// Adds up what a step costs for each of the rank's own grains.
void clx_ranks_weigh(clast_dem *whole);

// Records on their way: ranks_wire.c.

void clx_arrivals_free(clx_arrivals *arrivals);

/// Items of grain g: the first, and how many.
static inline int32_t clx_first_item(const clast_dem *dem, int32_t g)
{
    return dem->item_begin != NULL ? dem->item_begin[g] : g;
}

static inline int32_t clx_n_item(const clast_dem *dem, int32_t g)
{
    return dem->item_begin != NULL ? dem->item_begin[g + 1] - dem->item_begin[g] : 1;
}

/// An item's number in the whole, and back: -1 where the rank has no such grain.
int32_t clx_item_to_whole(const clast_dem *whole, const clast_dem *from, int32_t item);
int32_t clx_item_to_local(const clast_dem *whole, int32_t item);

/// Writes a part of a message: its counts are filled in at its end.
clast_status clx_wire_begin(clx_wire *wire, int64_t *at);
void clx_wire_end(clx_wire *wire, int64_t at, int64_t n_grain, int64_t n_pair);
clast_status clx_wire_add_grain(clx_wire *wire, const clast_dem *from, int32_t g, bool is_own);
clast_status clx_wire_add_pair(clx_wire *wire, const clast_dem *whole, const clast_dem *from,
                               int64_t k);

/// Reads messages that stand one after another.
clast_status clx_wire_read(const clast_dem *whole, const char *bytes, int64_t n,
                           clx_arrivals *arrivals);

/// A grain's state as it came, where its mass and shape are already.
void clx_wire_set_state(clast_dem *dem, int32_t g, const clx_wire_grain *from);
