// What becomes of the particles of a collision. [docs/theory/agglomeration.md section 2]
#include "cloud/collide.h"

#include "base/status.h"

#include <math.h>

double clx_aggregate_radius(const clast_collide_config *c, double monomers)
{
    if (c->radius_law == CLAST_RADIUS_VOLUME ||
        (c->radius_law == CLAST_RADIUS_FRACTAL_GYRATION && monomers <= 1.0)) {
        return c->monomer_radius * cbrt(monomers);
    }
    const double d = c->fractal_dimension;
    const double radius = c->monomer_radius * pow(monomers / c->fractal_prefactor, 1.0 / d);
    return c->radius_law == CLAST_RADIUS_FRACTAL_GYRATION ? sqrt((d + 2.0) / d) * radius : radius;
}

clast_collider clx_population_collider(const clast_population *p, int64_t i)
{
    CLAST_ASSERT(i >= 0 && i < p->n);
    clast_collider seen = {
        .monomers = (double)p->monomers[i], .radius = p->radius[i], .mass = p->mass[i]};
    for (int32_t k = 0; k < p->dimension && p->velocity != NULL; ++k) {
        seen.velocity[k] = p->velocity[i * p->dimension + k];
    }
    seen.speed_rms = p->speed_rms != NULL ? p->speed_rms[i] : 0.0;
    return seen;
}

/// Monomers of two particles together; INT64_MAX, which no particle begins with, stands for more.
static int64_t joined(const clast_population *p, int64_t i, int64_t j)
{
    CLAST_ASSERT(p->monomers[i] >= 0 && p->monomers[j] >= 0);
    return p->monomers[i] > INT64_MAX - p->monomers[j] ? INT64_MAX
                                                       : p->monomers[i] + p->monomers[j];
}

static double merged_radius(const clast_population *p, const clast_collide_config *c, int64_t i,
                            int64_t j)
{
    if (c->radius_law != CLAST_RADIUS_VOLUME) {
        const double n = (double)joined(p, i, j);
        return clx_aggregate_radius(c, c->count_unit > 0.0 ? c->count_unit * n : n);
    }
    const double a = p->radius[i];
    const double b = p->radius[j];
    return cbrt(a * a * a + b * b * b);
}

/// Odds that what two become lies where `other` was. They keep the expected mass at each place, so
/// that what is left lies as even as what was there: for equal weights the odds are the other's
/// share of the mass. What the other keeps goes to the place that is free; where even that leaves
/// too little at the other's place, the heavier lot of the two is there.
static double odds_of_place(const clast_population *p, int64_t live, int64_t other)
{
    const double w = p->weight != NULL ? p->weight[live] : 1.0;
    const double rest = p->weight != NULL ? (p->weight[other] - w) * p->mass[other] : 0.0;
    const double together = w * (p->mass[live] + p->mass[other]) - rest;
    if (rest == 0.0) {
        const double mass = p->mass[live] + p->mass[other];
        return mass > 0.0 ? p->mass[other] / mass : 0.5;
    }
    return together > 0.0 ? w * p->mass[other] / together : 0.0;
}

/// Draws whether the two change places, independent of the cell's own draws.
static void place(clast_population *p, const clast_collide_config *c, int64_t live, int64_t other)
{
    const uint64_t event = (uint64_t)live * UINT64_C(0x9E3779B97F4A7C15) +
                           (uint64_t)other * UINT64_C(0xBF58476D1CE4E5B9) +
                           (uint64_t)p->monomers[live];
    clx_rng rng = clx_rng_at(c->seed, CLX_STREAM_COLLISION_PLACE, event);
    if (clx_rng_uniform(&rng) >= odds_of_place(p, live, other)) {
        return;
    }
    for (int64_t k = 0; k < p->dimension; ++k) {
        const double x = p->x[live * p->dimension + k];
        p->x[live * p->dimension + k] = p->x[other * p->dimension + k];
        p->x[other * p->dimension + k] = x;
    }
}

/// `live` takes up as many of the other's particles as it has itself.
static void take_up(clast_population *p, const clast_collide_config *c, int64_t live, int64_t other)
{
    const double mass = p->mass[live] + p->mass[other];
    const double share = mass > 0.0 ? p->mass[other] / mass : 0.5;
    const int32_t d = p->dimension;
    p->radius[live] = merged_radius(p, c, live, other);
    if (!c->keep_positions && live != other) {
        place(p, c, live, other);
    }
    for (int32_t k = 0; k < d && p->velocity != NULL; ++k) {
        p->velocity[live * d + k] +=
            share * (p->velocity[other * d + k] - p->velocity[live * d + k]);
    }
    if (p->speed_rms != NULL) { // independent fluctuations of the two momenta
        p->speed_rms[live] = hypot((1.0 - share) * p->speed_rms[live], share * p->speed_rms[other]);
    }
    p->monomers[live] = joined(p, live, other);
    p->mass[live] = mass;
}

int clx_population_stick(clast_population *p, const clast_collide_config *c, int64_t i, int64_t j,
                         int64_t live[2], double *n_real)
{
    CLAST_ASSERT(i != j && p->monomers[i] > 0 && p->monomers[j] > 0);
    const double w[2] = {p->weight != NULL ? p->weight[i] : 1.0,
                         p->weight != NULL ? p->weight[j] : 1.0};
    const int64_t few = w[0] < w[1] ? i : j;
    const int64_t many = w[0] < w[1] ? j : i;
    *n_real += fmin(w[0], w[1]);
    if (w[0] != w[1]) {
        take_up(p, c, few, many);
        p->weight[many] -= p->weight[few];
        live[0] = few < many ? few : many;
        live[1] = few < many ? many : few;
        return 2;
    }
    const bool i_stays = p->mass[i] > p->mass[j] || (p->mass[i] == p->mass[j] && i < j);
    const int64_t dead = i_stays ? j : i;
    live[0] = i_stays ? i : j;
    take_up(p, c, live[0], dead);
    p->monomers[dead] = 0;
    p->owner[dead] = live[0];
    return 1;
}

void clx_population_pair_up(clast_population *p, const clast_collide_config *c, int64_t i,
                            double *n_real)
{
    take_up(p, c, i, i);
    p->weight[i] *= 0.5;
    *n_real += p->weight[i];
}
