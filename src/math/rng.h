#pragma once
// Random draws as pure functions of (seed, stream, index), never of call order, threads or ranks.
// Philox4x32-10 from Random123 [Salmon2011]; counter = (index, part of stream), key = seed.
#include "base/status.h"
#include <stdint.h>

/// A cursor over one stream: the k-th draw from (seed, stream, index) is always the same number.
typedef struct clx_rng {
    uint64_t seed;
    uint32_t stream;  ///< what is drawn: one number per purpose, see enum clx_stream
    uint64_t index;   ///< which item (grain, trial, point)
    uint32_t counter; ///< next block of this item
    uint32_t block[4];
    uint32_t used; ///< words of block used up
} clx_rng;

/// Purposes; a purpose keeps its number for ever, so that a new one never moves an old result.
enum clx_stream {
    CLX_STREAM_TEST = 0,
    CLX_STREAM_FILL = 1,
    CLX_STREAM_AGGREGATE_SIZE = 2,
    CLX_STREAM_AGGREGATE_SHAPE = 3,
    CLX_STREAM_AGGREGATE_AXIS = 4,
    CLX_STREAM_AGGREGATE_RAY = 5,
    CLX_STREAM_AGGREGATE_ORIENTATION = 6,
    CLX_STREAM_AGGREGATE_ORIGIN = 7,
    CLX_STREAM_AGGREGATE_ORDER = 8,
    CLX_STREAM_ENVELOPE = 9,
    CLX_STREAM_UNION = 10,
    CLX_STREAM_RENDER = 11,
    CLX_STREAM_CLUSTER = 12,
    CLX_STREAM_FIT = 13,
    CLX_STREAM_AGGREGATE_REPEAT = 14,
    CLX_STREAM_AGGREGATE_MARCH = 15,
    CLX_STREAM_AGGREGATE_OFFSET = 16,
    CLX_STREAM_AGGREGATE_WALK = 17,
    CLX_STREAM_GHOST = 20,
    CLX_STREAM_BOOTSTRAP = 21,
    CLX_STREAM_COLLISION = 22,
    CLX_STREAM_EXTERIOR = 23,
    CLX_STREAM_THINNING = 24,
    CLX_STREAM_COVARIOGRAM = 25,
    CLX_STREAM_COLLISION_PLACE = 26,
    CLX_STREAM_SPECTRUM = 27,
    CLX_STREAM_SHAPE = 30,
    CLX_STREAM_GRADING = 31,
    CLX_STREAM_FORM = 32,
    CLX_STREAM_SYNTHESIS = 33,
    CLX_STREAM_RESAMPLE = 40,
    CLX_STREAM_FOLD = 41,
    CLX_STREAM_PERMUTATION = 42,
    CLX_STREAM_PACK_SHAPE = 50,
    CLX_STREAM_PACK_VELOCITY = 51,
    CLX_STREAM_PACK_TURN = 52,
    CLX_STREAM_EVOLVE_PLACE = 60,
    CLX_STREAM_EVOLVE_SHAPE = 61,
    CLX_STREAM_EVOLVE_MOVE = 62,
    CLX_STREAM_EVOLVE_MEET = 63,
    CLX_STREAM_EVOLVE_REACT = 64,
    CLX_STREAM_EVOLVE_VELOCITY = 65
};

/// Cursor at the first draw of (seed, stream, index).
CLX_SHARED clx_rng clx_rng_at(uint64_t seed, uint32_t stream, uint64_t index);

uint32_t clx_rng_u32(clx_rng *rng);

/// Uniform on (0, 1): 52 bits plus half a step, never 0 or 1.
double clx_rng_uniform(clx_rng *rng);

/// Standard normal (Box-Muller, two uniforms a draw).
double clx_rng_normal(clx_rng *rng);

/// Uniform on 0 .. n-1 without bias.
CLX_SHARED int64_t clx_rng_below(clx_rng *rng, int64_t n);

/// Poisson number of this mean (>= 0), exact; O(mean) uniforms.
int64_t clx_rng_poisson(clx_rng *rng, double mean);

/// Uniform direction on the unit sphere.
void clx_rng_direction(clx_rng *rng, double direction[3]);

/// Uniform direction within `half_angle` of the unit axis (cosine uniform on the cap).
void clx_rng_cone(clx_rng *rng, const double axis[3], double half_angle, double direction[3]);

/// Orientation uniform on SO(3), unit quaternion w, x, y, z. [Shoemake1992]
void clx_rng_orientation(clx_rng *rng, double orientation[4]);

/// Mixes the bits of a number thoroughly: a hash, one to one. [Steele2014, splitmix64]
static inline uint64_t clx_mix(uint64_t x)
{
    x += UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ (x >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ (x >> 27)) * UINT64_C(0x94d049bb133111eb);
    return x ^ (x >> 31);
}
