#pragma once
// One run of an agglomerating cloud on one kind of mesh.
#include <clast/agglomerate.h>
#include <clast/cloud.h>

/// A population that owns its arrays.
typedef struct clx_evolution {
    const clast_agglomerate_input *input;
    const clast_agglomerate_config *config;
    clast_collide_config collide;
    clast_domain domain;
    bool is_fixed; ///< on the user's mesh
    clast_population population;
    clast_decomposition *first;      ///< the mesh at the start, of all runs of one input
    clast_decomposition later;       ///< the run's own
    const clast_decomposition *mesh; ///< the one in use
    double *x_at_mesh;               ///< [n][d] positions when the mesh was made
    double n_at_mesh;                ///< real particles then
    int32_t *cell;                   ///< [n]
    double *volume;                  ///< [n_cell]
    clast_medium *medium;            ///< [n_cell], or NULL without field columns
    int32_t n_cell;
    int64_t at;             ///< the last snapshot
    bool is_rebuilt;        ///< there, or before the last step
    int32_t n_unresolved;   ///< snapshots whose new cells' points did not show their own structure
    double volume_fraction; ///< at the start
    double n_event;         ///< collisions of real particles since the start
    double time;            ///< since the start [s]
    clast_range_report *range; ///< grows; NULL beside, on the user's mesh
} clx_evolution;

/// Checks input against configuration and makes the population of the first snapshot.
clast_status clx_evolution_begin(clx_evolution *run);

/// Moves live particles to a snapshot and brings the mesh up to date.
clast_status clx_evolution_snapshot(clx_evolution *run, int64_t snapshot);

/// One step of collisions; `number` fixes its draws.
clast_status clx_evolution_step(clx_evolution *run, double dt, uint64_t number);
void clx_evolution_free(clx_evolution *run);
