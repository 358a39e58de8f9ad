#pragma once
// One well-mixed block of particles: kinds, rates and events.
#include "math/rng.h"

#include <clast/agglomerate.h>

/// Particles that are equal in all that the rates see.
typedef struct clx_kind {
    clast_collider as;
    double weight;
    int64_t n;
    int64_t head;  ///< one of its particles; the others follow in `next`, in random order
    double row;    ///< sum over the other particles of the kernel with them
    double change; ///< rate at which one settles or breaks, in a block that flows [1/s]
} clx_kind;

/// Scratch that has room for every particle; blocks use their own parts of it.
typedef struct clx_collide_scratch {
    int64_t *order;  ///< [n] particles by cell
    int64_t *next;   ///< [n] list of a kind, -1 ends it
    int64_t *frozen; ///< [n] particles by kind at the start of a sub-step
    clx_kind *kind;  ///< [n]
    int64_t *n_kind; ///< [n] kinds of the blocks of a partition
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
    uint32_t ranges; ///< rows of the table of ranges that its events are held against
    clast_range_use range;
    double rate_factor; ///< what a partition into blocks leaves out; 1 without
    double scale;       ///< alpha / V, times rate_factor
    uint32_t needs;
    clx_rng *rng;
    struct clx_box *box; ///< whose particles these are; NULL: they only collide
    bool flows;          ///< they also settle, break and come in here, between collisions
    int64_t n_event;     ///< drawn
    double n_real;       ///< collisions of real particles
} clx_block;

/// Sorts the members into kinds; stops and returns false beyond `limit` kinds.
bool clx_block_sort(clx_block *block, int64_t limit);

/// Rows of all kinds anew; returns the sum over particles of their rows.
double clx_block_rates(clx_block *block);

/// A particle as a kind without members; the rate over scale of a pair of kinds; twice the rate
/// over scale at which the particles of one parcel collide.
clx_kind clx_block_as_seen(const clx_block *block, int64_t particle);
double clx_block_kernel(const clx_block *block, const clx_kind *x, const clx_kind *y);
double clx_block_self_rate(const clx_block *block, const clx_kind *kind);

/// clx_population_stick, and pair_up where i == j, of an event of the block: also held against the
/// ranges.
int clx_block_stick(clx_block *block, int64_t i, int64_t j, int64_t live[2]);

/// Takes dead particles out of the members.
void clx_block_drop_dead(clx_block *block);

/// Evolves a sorted block with rates for a time dt in the configured mode.
void clx_block_evolve(clx_block *block, double dt);

/// Evolves a cell of more kinds than config->block for a time dt; n_kind [block->n] is scratch.
void clx_block_evolve_partitioned(clx_block *cell, int64_t *n_kind, double dt);
void clx_block_shuffle(int64_t *item, int64_t n, clx_rng *rng);

/// Lets two live particles stick; weighted parcels as clast_collide says. `live` lists those that
/// change and live on, in rising order; returns how many. *n_real grows by the collisions.
int clx_population_stick(clast_population *population, const clast_collide_config *config,
                         int64_t i, int64_t j, int64_t live[2], double *n_real);

/// Lets the particles of one parcel stick to each other, two by two.
void clx_population_pair_up(clast_population *population, const clast_collide_config *config,
                            int64_t i, double *n_real);

/// Radius of an aggregate of so many monomers by the configuration's law, from monomers of a0.
double clx_aggregate_radius(const clast_collide_config *config, double monomers);

/// The live particle that this one has become part of, or is.
int64_t clx_population_owner(const clast_population *population, int64_t i);

/// A particle as ranges see it.
clast_collider clx_population_collider(const clast_population *population, int64_t i);

/// What the kernels and the sticking need of particles.
uint32_t clx_collide_needs(const clast_collide_config *config);

/// Ranges of the members that this configuration uses; a caller may leave the others at 0.
clast_status clx_collide_config_check(const clast_collide_config *config);
