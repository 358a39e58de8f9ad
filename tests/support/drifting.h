#pragma once
// Clouds that drift from step to step, as a flow solver's do.
#include <clast/status.h>
#include <stdint.h>

typedef enum {
    DRIFTING_MIXED,    ///< uniform, points walk at random: the density stays
    DRIFTING_MOVING,   ///< 30 % in a blob of sd 0.06 that moves by one sd in 50 steps
    DRIFTING_GATHERED, ///< 30 % in a blob that shrinks from sd 0.12 to 0.04 in 200 steps, and grows
    DRIFTING_VORTEX,   ///< uniform at first, inertial particles of a vortex gather at its rim
    N_DRIFTING
} drifting_kind;

extern const char *const drifting_name[N_DRIFTING];

typedef struct drifting {
    drifting_kind kind;
    int64_t n;
    uint64_t seed;
    uint64_t step;
    double *x;     ///< [n][3] in the unit cube
    double *other; ///< [n][3] velocity, or offset from the centre in standard deviations
} drifting;

clast_status drifting_start(drifting_kind kind, int64_t n, uint64_t seed, drifting *cloud);
void drifting_advance(drifting *cloud); ///< by one step

/// Integral of the squared density at the step, 0 where it is not known.
double drifting_integral(const drifting *cloud);
void drifting_free(drifting *cloud);
