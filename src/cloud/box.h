#pragma once
// A well-mixed box of Monte Carlo: particles that collide, and that also break, come in and settle.
// [docs/theory/agglomeration.md section 6]
#include "cloud/collide.h"

enum { CLX_MOST_FRAGMENTS = 16 };

/// Masses are whole numbers of `unit`, so that every sum of them is exact.
typedef struct clx_box {
    const clast_spectrum_config *config;
    clast_collide_config collide;
    clast_population population; ///< n: slots in use, the dead ones too
    double unit;                 ///< monomers of a whole number of the population
    double volume;               ///< [m^3]
    uint32_t ranges;
    bool changes;       ///< particles break, come in or settle
    int32_t n_fragment; ///< of a particle that breaks
    int64_t capacity, n_free;
    int64_t *free_slot, *member, *next, *frozen, *n_kind; ///< [capacity]
    clx_kind *kind;
    double *born;                  ///< [capacity] when a member came into being in a flow
    int64_t start, added, settled; ///< mass
    int64_t above;                 ///< mass of particles above gel_size
    double gel_size;               ///< whole number of units above which mass is told as gel
    double time, now;              ///< of the last partition or step; of the event [s]
    double gel_time;               ///< NaN before
    int64_t n_event;               ///< collisions drawn
    clast_status status;           ///< of growing
} clx_box;

/// Number of fragments of the configuration's law; 0 where no whole number has it.
int32_t clx_fragments_count(const clast_spectrum_config *config);

/// Fragments of a particle of mass m: whole numbers >= 0 of sum m; their means over draws are the
/// law's shares between whole numbers.
void clx_fragments_draw(const clast_spectrum_config *config, int32_t n_fragment, int64_t m,
                        clx_rng *rng, int64_t *part);

/// Room for n particles; unit, volume, configurations and gel_size are set.
clast_status clx_box_begin(clx_box *box, int64_t n);
void clx_box_end(clx_box *box);

/// Particle i gets mass m, and the radius and mass of that size.
void clx_box_set(clx_box *box, int64_t i, int64_t m);

/// Takes the particles [0, population.n) as a new start.
void clx_box_restart(clx_box *box);

/// Evolves up to the time `end`; the number of the step fixes the draws.
clast_status clx_box_step(clx_box *box, double end, uint64_t step, clast_range_use *use);

// For blocks:

/// Rate at which a particle of mass m settles or breaks [1/s]; at which others come in.
double clx_box_rate(const clx_box *box, int64_t m);
double clx_box_source(const clx_box *box);

/// The block's arrays are the box's.
void clx_box_fit(clx_block *block);

/// Slots for one event, here or by growing; the block's arrays follow. False: box->status says why.
bool clx_box_reserve(clx_block *block);

/// Particle i settles or breaks; or one comes in. Those that live then: returns how many.
int clx_box_change(clx_box *box, int64_t i, clx_rng *rng, int64_t live[CLX_MOST_FRAGMENTS]);
int clx_box_enter(clx_box *box, clx_rng *rng, int64_t live[1]);

/// Counts a particle of mass m in (1) or out (-1) of what is above gel_size.
void clx_box_watch(clx_box *box, int64_t m, int sign);

/// Time in which at most `share` of the members' number and mass settle, break or come in.
double clx_box_bound(const clx_block *block, double share);

/// Lets the members settle, break and others come in for a time, without collisions: exact.
void clx_box_flow(clx_block *block, double dt);
