// SPDX-License-Identifier: BSD-3-Clause
// A solver linked with it is under the GPL as a whole: README.md.
#pragma once
#include "cs_headers.h"

/// Real particles, their mass and parcels of this rank.
typedef struct balance {
    double weight, mass; ///< [-], [kg]
    double parcels;
} balance;

/// Injected since the start.
extern balance balance_in;

static inline void balance_add(balance *sum, const cs_lagr_particle_set_t *particles, cs_lnum_t k)
{
    const double w =
        *(const double *)cs_lagr_particles_attr_const(particles, k, CS_LAGR_STAT_WEIGHT);
    sum->weight += w;
    sum->mass += w * *(const double *)cs_lagr_particles_attr_const(particles, k, CS_LAGR_MASS);
    sum->parcels += 1.0;
}
