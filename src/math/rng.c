// Counter-based random numbers: Philox4x32-10 of Random123, and the distributions that geometry
// needs.
#include "math/rng.h"

#include "base/status.h"
#include "math/vec3.h"
#include <Random123/philox.h>
#include <clast/status.h>

clx_rng clx_rng_at(uint64_t seed, uint32_t stream, uint64_t index)
{
    return (clx_rng){.seed = seed, .stream = stream, .index = index, .used = 4};
}

uint32_t clx_rng_u32(clx_rng *rng)
{
    CLAST_ASSERT(rng->used <= 4);
    if (rng->used == 4) {
        const philox4x32_ctr_t counter = {
            {(uint32_t)rng->index, (uint32_t)(rng->index >> 32), rng->stream, rng->counter++}};
        const philox4x32_key_t key = {{(uint32_t)rng->seed, (uint32_t)(rng->seed >> 32)}};
        const philox4x32_ctr_t out = philox4x32(counter, key);
        for (int i = 0; i < 4; ++i) {
            rng->block[i] = out.v[i];
        }
        rng->used = 0;
    }
    return rng->block[rng->used++];
}

double clx_rng_uniform(clx_rng *rng)
{
    const uint64_t high = clx_rng_u32(rng);
    const uint64_t low = clx_rng_u32(rng);
    const uint64_t bits = ((high << 32) | low) >> 12;
    return ((double)bits + 0.5) * 0x1p-52;
}

double clx_rng_normal(clx_rng *rng)
{
    const double radius = sqrt(-2.0 * log(clx_rng_uniform(rng)));
    return radius * cos(2.0 * CLAST_PI * clx_rng_uniform(rng));
}

int64_t clx_rng_below(clx_rng *rng, int64_t n)
{
    CLAST_ASSERT(n > 0);
    const uint64_t range = (uint64_t)n;
    const uint64_t limit = UINT64_MAX - UINT64_MAX % range;
    uint64_t draw = 0;
    do {
        draw = (uint64_t)clx_rng_u32(rng) << 32;
        draw |= clx_rng_u32(rng);
    } while (draw >= limit);
    return (int64_t)(draw % range);
}

int64_t clx_rng_poisson(clx_rng *rng, double mean)
{
    CLAST_ASSERT(!(mean < 0.0));
    static const double PART = 30.0; // exp(-PART) is far from underflow
    int64_t n = 0;
    while (mean > 0.0) { // a sum of Poisson numbers is one
        const double part = mean < PART ? mean : PART;
        const double limit = exp(-part);
        double product = clx_rng_uniform(rng);
        while (product > limit) { // counts arrivals of a unit process before `part`
            ++n;
            product *= clx_rng_uniform(rng);
        }
        mean -= part;
    }
    return n;
}

void clx_rng_direction(clx_rng *rng, double direction[3])
{
    const double z = 2.0 * clx_rng_uniform(rng) - 1.0;
    const double angle = 2.0 * CLAST_PI * clx_rng_uniform(rng);
    const double r = sqrt(fmax(0.0, 1.0 - z * z));
    v3_set(direction, r * cos(angle), r * sin(angle), z);
}

void clx_rng_cone(clx_rng *rng, const double axis[3], double half_angle, double direction[3])
{
    CLAST_ASSERT(v3_is_unit(axis, 1e-9) && half_angle >= 0.0);
    double a[3];
    double b[3];
    const double c = 1.0 - clx_rng_uniform(rng) * (1.0 - cos(half_angle));
    const double angle = 2.0 * CLAST_PI * clx_rng_uniform(rng);
    const double s = sqrt(fmax(0.0, 1.0 - c * c));
    v3_frame(axis, a, b);
    for (int k = 0; k < 3; ++k) {
        direction[k] = c * axis[k] + s * (cos(angle) * a[k] + sin(angle) * b[k]);
    }
}

void clx_rng_orientation(clx_rng *rng, double orientation[4])
{
    const double u = clx_rng_uniform(rng);
    const double a = 2.0 * CLAST_PI * clx_rng_uniform(rng);
    const double b = 2.0 * CLAST_PI * clx_rng_uniform(rng);
    const double r = sqrt(1.0 - u);
    const double s = sqrt(u);
    orientation[0] = s * cos(b);
    orientation[1] = r * sin(a);
    orientation[2] = r * cos(a);
    orientation[3] = s * sin(b);
}
