#pragma once
// One well-mixed block of particles: kinds, rates and events.
#include "math/rng.h"

#include <clast/collide.h>

/// Particles that are equal in all that the kernel sees.
typedef struct clx_kind {
    clast_collider as;
    int64_t n;
    int64_t head; ///< one of its particles; the others follow in `next`, in random order
    double row;   ///< sum over the other particles of the kernel with them
} clx_kind;

/// Scratch that has room for every particle; blocks use their own parts of it.
typedef struct clx_collide_scratch {
    int64_t *order;  ///< [n] particles by cell
    int64_t *next;   ///< [n] list of a kind, -1 ends it
    int64_t *frozen; ///< [n] particles by kind at the start of a sub-step
    clx_kind *kind;  ///< [n]
} clx_collide_scratch;

/// A block: particles member [n] that meet at the rate kernel x scale.
typedef struct clx_block {
    const clast_collide_config *config;
    const clast_medium *medium;
    clast_population *population;
    int64_t *member, *next, *frozen;
    int64_t n;
    clx_kind *kind;
    int64_t n_kind;
    double scale; ///< alpha / V, times what dealing into blocks leaves out
    uint32_t needs;
    clx_rng *rng;
    int64_t n_event;
} clx_block;

/// Sorts the members into kinds; stops and returns false beyond `limit` kinds.
bool clx_block_sort(clx_block *block, int64_t limit);

/// Rows of all kinds anew; returns the sum over particles of their rows.
double clx_block_rates(clx_block *block);

/// Evolves a sorted block for a time dt in the configured mode.
void clx_block_next_events(clx_block *block, double dt);
void clx_block_poisson(clx_block *block, double dt);

/// Merges two live particles; returns the one that lives on.
int64_t clx_population_merge(clast_population *population, const clast_collide_config *config,
                             int64_t i, int64_t j);
