// SPDX-License-Identifier: BSD-3-Clause
// A solver linked with it is under the GPL as a whole: README.md.
#pragma once
// What a run is told: DATA/settings.txt, lines "name value..", which drive.py writes and the solver
// finds in its working folder.

enum { MAX_SETS = 4 };

typedef enum {
    TASK_COUNT,    ///< clast counts events of the solver's parcels, which it leaves as they are
    TASK_OWN,      ///< beside the solver's own agglomeration, cell by cell, in the last step
    TASK_RANKS,    ///< as count, and again from each rank's own parcels without gathering them
    TASK_GROW,     ///< clast's events make parcels grow
    TASK_SNAPSHOT, ///< the parcels of the last step go to a file
} run_task;

typedef enum {
    SPARE_NOTHING,   ///< clast tests and cuts at each call
    SPARE_UNCHANGED, ///< where the cloud has changed
    SPARE_MOST       ///< tests and counts pairs at each 50th call, cuts at each 10th
} run_spare;

typedef struct run_settings {
    run_task task;
    int n_step;
    double dt;                         ///< [s]
    double velocity[3];                ///< at the inlet and at the start [m/s]
    double hydraulic_diameter;         ///< of the inlet [m]
    double density, viscosity;         ///< of the fluid [kg/m3], [Pa s]
    int n_set;                         ///< sets of parcels that are injected beside each other
    double parcels[MAX_SETS];          ///< of each set at a time
    double period[MAX_SETS];           ///< steps between these
    double weight[MAX_SETS];           ///< real particles of a parcel
    double diameter, particle_density; ///< of a particle [m], [kg/m3]
    double kernel;                     ///< beta, the same for all pairs [m3/s]
    int every;                         ///< steps between two calls of clast; in events.csv events
                                       ///< are of one step, with TASK_GROW of as many as stuck is
    int spare;                         ///< run_spare
    char domain[128];                  ///< as clast_domain_parse reads it
} run_settings;

/// Read at the first call; ends the run where a line is wrong.
const run_settings *settings(void);
