// Directions of rays, as pure functions of (seed, particle, attempt, ray).
#include "aggregate/aim.h"

#include "math/rng.h"
#include "math/vec3.h"

uint64_t clx_aim_index(const clx_aim *aim, int64_t number, int64_t per_attempt)
{
    CLAST_ASSERT(aim->particle >= 0 && aim->attempt >= 0 && number >= 0);
    const uint64_t high = (uint64_t)(number + aim->attempt * per_attempt);
    return (uint64_t)aim->particle | (high << 32);
}

void clx_aim_direction(const clx_aim *aim, int64_t number, double direction[3])
{
    CLAST_ASSERT(aim->cone >= 0.0 && number < aim->n_ray);
    double axis[3];
    clx_rng rng =
        clx_rng_at(aim->seed, CLX_STREAM_AGGREGATE_RAY, clx_aim_index(aim, number, aim->n_ray));
    v3_copy(axis, aim->axis);
    if (aim->random_axis) {
        clx_rng own = clx_rng_at(aim->seed, CLX_STREAM_AGGREGATE_AXIS, clx_aim_index(aim, 0, 1));
        clx_rng_direction(&own, axis);
    }
    clx_rng_cone(&rng, axis, aim->cone, direction);
    (void)v3_unit(direction, direction);
}
