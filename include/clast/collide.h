#pragma once
#include <clast/field.h>
#include <clast/kernel.h>
#include <clast/kernel_range.h>
#include <clast/sticking.h>

CLAST_BEGIN

// Monte Carlo collisions of particles in cells where they are well mixed: one call per time step on
// the caller's arrays. [docs/theory/agglomeration.md section 2]

/// Particles that stick. Arrays are the caller's; what is dead stays in place with 0 monomers.
typedef struct clast_population {
    int64_t n;
    int32_t dimension;
    double *x;         ///< [n][dimension] m
    int64_t *monomers; ///< [n] >= 0; 0: part of another
    double *radius;    ///< [n] collision radius [m]
    double *mass;      ///< [n] kg
    double *velocity;  ///< [n][dimension] m/s, or NULL
    double *speed_rms; ///< [n] m/s, or NULL
    int64_t *owner;    ///< [n] the particle it has become part of; itself while alive
    double *weight;    ///< [n] > 0: real particles that a parcel stands for; NULL: 1 each
} clast_population;

typedef enum {
    CLAST_RADIUS_VOLUME,            ///< a^3 = a1^3 + a2^3: drops, or measured radii that merge
    CLAST_RADIUS_FRACTAL_COLLISION, ///< a = a0 (i / k_f)^(1 / D_f), k_f of collision radii
    CLAST_RADIUS_FRACTAL_GYRATION   ///< the same law gives the radius of gyration; of i > 1 a is
                                    ///< sqrt((D_f + 2) / D_f) times it    [Rogak1992]
} clast_radius_law;

typedef enum {
    CLAST_COLLISIONS_NEXT,   ///< next event by next event: exact in cells of few kinds, and in
                             ///< blocks of the others
    CLAST_COLLISIONS_POISSON ///< Poisson number of events a sub-step, rates frozen in it
} clast_collisions;

typedef enum {
    CLAST_OUT_OF_RANGE_ERROR,      ///< ends when over 0.1 % of the collisions lie out of a range
    CLAST_OUT_OF_RANGE_EXTRAPOLATE ///< tells it alone
} clast_out_of_range;

typedef struct clast_collide_config {
    uint32_t kernel; ///< mask, clast_kernel_parse
    clast_medium medium;
    double alpha;            ///< share of collisions that stick; a factor on what `sticking` says
    clast_sticking sticking; ///< zeros: alpha alone
    int32_t out_of_range;    ///< clast_out_of_range
    int32_t radius_law, collisions;
    double monomer_radius, fractal_dimension, fractal_prefactor; ///< a0 [m], D_f, k_f
    double leap;   ///< Poisson: collisions that no particle exceeds on average in a sub-step
    int32_t block; ///< kinds of particles above which a cell is dealt into random blocks of this
                   ///< many; 0: never
    bool self_collisions; ///< the particles of one parcel collide with each other too
    bool keep_positions;  ///< an aggregate stays where its heavier part was, else at the centre of
                          ///< mass
    uint64_t seed;
    double count_unit; ///< monomers that 1 in clast_population.monomers stands for in the radius
                       ///< laws; 0: 1
} clast_collide_config;

/// Cells of one step; borrowed.
typedef struct clast_collide_cells {
    int32_t n;
    const int32_t *of_particle; ///< [n_particle] < 0: in none
    const double *volume;       ///< [n] m^d, > 0
    const clast_medium *medium; ///< [n], or NULL: the configuration's
    double *events;             ///< [n] out: collisions of real particles that stuck, or NULL
    clast_range_use *range;     ///< grows by this step's collisions, or NULL
} clast_collide_cells;

/// Lets the particles of each cell collide for a time dt.
///
/// A pair of one cell collides at the rate alpha beta / V. Both modes keep every event: a particle
/// that has just merged hands its next event to the aggregate it went into. Monomers are integers
/// and their sum never changes; momentum is kept.
///
/// Parcels [Shima2009]: a pair of weights w1 >= w2 meets at alpha beta w1 / V; then each particle
/// of the second sticks to one of the first, which keeps w1 - w2 (equal weights: it is gone), so
/// that w1 w2 pairs collide at alpha beta / V on average and the sums of weight times monomers,
/// mass and momentum never change. With self_collisions a parcel also halves its weight and doubles
/// its monomers at alpha beta (w - 1) / V.
///
/// @param step     number of the step, below 2^32: with the seed it fixes every draw
/// @param n_event  out, events drawn, sum over cells (without weights: collisions); may be NULL
/// @return CLAST_E_CONFIG for a configuration out of the ranges of clast_agglomerate_fields (of
/// what it uses) or a medium that lacks what the kernel needs, CLAST_E_ARGUMENT for arrays that are
/// NULL, volumes not > 0, cells that there are not; nothing is then changed. CLAST_E_CONFIG too
/// after the step where over 0.1 % of its collisions (of those of cells->range, if given) lie out
/// of a range of kernel_range.h, but for CLAST_OUT_OF_RANGE_EXTRAPOLATE. CLAST_E_LIMIT beyond
/// 50000 kinds in a cell with block = 0
/// @note a cell of n particles of s kinds: O(s) per event; the same bytes for any thread count
CLAST_API clast_status clast_collide(clast_population *population, const clast_collide_cells *cells,
                                     double dt, uint64_t step, const clast_collide_config *config,
                                     int64_t *n_event);

CLAST_END
