#pragma once
// Two items near each other: what lasts of their contact, and the forces of one step.
#include "convex/convex.h"
#include <assert.h>
#include <stdbool.h>
#include <stdint.h>

/// Two items near each other: 48 bytes.
typedef struct clx_dem_pair {
    int32_t a, b;         ///< b > a, or -1 - wall
    int16_t period[2];    ///< b's image: position + n * width; the low 16 bits of n
    uint32_t touches : 1; ///< in the last step
    uint32_t kind : 2;    ///< clx_facet_kind of its warm start
    uint32_t slot : 29;   ///< index of its warm start in the list; 0: it has none
    double active_from;   ///< it cannot touch while travel a + travel b is less
    double slide[3];      ///< tangential displacement of b over a
} clx_dem_pair;

/// Pairs of one item come by b, then by image: below 0 where the first does.
static inline int clx_pair_order(int32_t b, const int16_t period[2], int32_t other,
                                 const int16_t others[2])
{
    return b != other               ? (b > other) - (b < other)
           : period[0] != others[0] ? period[0] - others[0]
                                    : period[1] - others[1];
}

/// Contact history of some laws, beside the tangential displacement.
typedef struct clx_contact_history {
    double roll[3];     ///< torque of the rolling spring on b
    double restitution; ///< of its impact in a fluid; 0: it has not begun
} clx_contact_history;

/// A pair's warm start, from which the contact search begins: three cache lines, of which two hold
/// a face with a vertex.
typedef struct clx_warm_start_slot {
    clx_warm_start record;
    double spare[6];
} clx_warm_start_slot;

/// Two numbers of periods with the same low 16 bits differ by a multiple of this; the offset, known
/// to within a period, decides (clx_pair_offset).
#define CLX_PERIOD_TURN 65536.0
#define CLX_TO_WHOLE    0x1.8p52 ///< added and taken off again: rounds to a whole number

enum { CLX_MOST_SLOTS = (1 << 29) - 1 };

/// A pair and its warm start in three cache lines, for a sweep.
typedef struct clx_packed_pair {
    clx_dem_pair pair; ///< first, so that a pointer to it is one to the pair
    clx_warm_start warm_start;
} clx_packed_pair;
static_assert(sizeof(clx_packed_pair) == 192, "a pair takes three lines");

/// Accumulator of force and torque on a grain: two vectors of four doubles.
typedef struct clx_force_torque {
    double force[4];  ///< the fourth is 0
    double torque[4]; ///< the fourth is 0; with exact steps the grain's stability load
} clx_force_torque;

/// Contact force and torques of a pair.
typedef struct clx_pair_force {
    double force[4];    ///< the fourth is 0
    double torque_b[4]; ///< the fourth is 0; with exact steps the contact's stability load on b
    double torque_a[4]; ///< to be subtracted from the sum of a
} clx_pair_force;

/// A pair that may touch in this step, and its index among those that were given.
typedef struct clx_active_pair {
    const clx_dem_pair *pair;
    int64_t at;
} clx_active_pair;
