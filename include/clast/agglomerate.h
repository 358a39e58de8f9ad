#pragma once
#include <clast/collide.h>
#include <clast/decompose.h>
#include <clast/table.h>

CLAST_BEGIN

// Agglomeration in time: cells by decomposition, collisions in them, again at each snapshot.
// [docs/theory/agglomeration.md]

typedef enum {
    CLAST_REBUILD_CHANGED, ///< when the cloud is found to have changed
    CLAST_REBUILD_ALWAYS,  ///< at every snapshot
    CLAST_REBUILD_NEVER
} clast_rebuild;

typedef struct clast_agglomerate_config {
    clast_decompose_config decompose; ///< first: field tables are joined
    clast_collide_config collide;     ///< its kernel and seed are set from these two structs
    char *kernel;                     ///< "brownian+settling"
    double duration;                  ///< of each snapshot [s]
    int32_t n_step;                   ///< steps of a snapshot
    int32_t repeats;
    int32_t rebuild;
    double change_level; ///< of the test that finds the cloud changed
    int32_t fixed;       ///< regular mesh of this many cells an axis, evolved beside; 0: none
    double depth;        ///< extent of the missing dimensions [m^(3-d)]; 0: not given
} clast_agglomerate_config;

/// Own fields; those of the decomposition follow from clast_decompose_fields.
extern CLAST_API const clast_field clast_agglomerate_fields[];

/// What the particles bring. Arrays are borrowed; NULL where the column is missing.
typedef struct clast_agglomerate_input {
    const clast_cloud *snapshot; ///< [n_snapshot] positions of the same particles
    int64_t n_snapshot;
    const double *monomers;                          ///< [n] whole numbers > 0; NULL: 1 each
    const double *speed_rms;                         ///< [n] m/s
    const double *temperature, *shear, *dissipation; ///< [n] of the fluid at each particle
    const double *fixed_cell;   ///< [n] whole numbers >= 0: cell of the user's mesh, or < 0
    const double *fixed_volume; ///< [n] volume of that cell [m^d]
    const clast_domain *domain; ///< NULL: the one that the configuration names
} clast_agglomerate_input;

typedef struct clast_agglomeration {
    /// One row a time: time_s, n_particle, n_particle_sd, M1, M2, M3 (means over repeats of the
    /// sums of i^k, weighted), M2_sd and M3_sd, n_1 .. n_8 (aggregates of k monomers; with several
    /// repeats n_k_sd), events (since the start), n_cell, is_rebuilt; n_parcel with weights;
    /// fixed_n_particle and
    /// fixed_events beside a fixed mesh; exact_n_particle and exact_M2 where known.
    clast_table history;
    /// One row a particle, last state of the first repeat: coordinates, monomers, radius_m,
    /// mass_kg, aggregate (the particle it is part of), cell.
    clast_table particles;
    /// One row a time and class of sizes: time_s, size (its middle), size_low and size_high
    /// (monomers, both included), n, density (n a monomer), n_sd with several repeats.
    clast_table spectrum;
    int32_t n_rebuilt; ///< decompositions after the first, first repeat
    int32_t n_cell;    ///< last, first repeat
    bool has_exact, has_fixed;
    clast_range_report range; ///< of the cells' runs, not of the fixed mesh
} clast_agglomeration;

/// Evolves the cloud; see docs/theory/agglomeration.md.
///
/// @return as clast_decompose and clast_collide; CLAST_E_CONFIG for missing columns or
/// parameters, CLAST_E_FORMAT for values that cannot be (with the particle's number)
CLAST_API clast_status clast_agglomerate(const clast_agglomerate_input *input,
                                         const clast_agglomerate_config *config,
                                         clast_agglomeration *result);
CLAST_API void clast_agglomeration_free(clast_agglomeration *result);

/// Whether two samples of n points of the unit cube have the same density: chi-square of their
/// counts on a regular grid that is chosen without looking at them (10 points a block or more).
///
/// Independent samples of one density give p below a level with that frequency; points that only
/// moved a little, more rarely.
CLAST_API clast_status clast_change_test(const double *u_old, const double *u_new, int64_t n,
                                         int32_t d, double *p);

CLAST_END
