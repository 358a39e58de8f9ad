#pragma once
// Squared distances of one point from many, in SIMD lanes: how many are closer than each of some
// radii, and which of them are closer than the last or need an edge weight.
#include <stdbool.h>
#include <stdint.h>

enum {
    CLX_PAIR_OUTER = 8,   ///< radii
    CLX_PAIR_PIECE = 512, ///< points looked at in one call
    CLX_PAIR_PAD = 4      ///< numbers that can be read behind the last point, whatever they are
};

typedef struct clx_pair_found {
    int32_t n;
    int32_t item[CLX_PAIR_PIECE];
    double r2[CLX_PAIR_PIECE];
} clx_pair_found;

typedef struct clx_pair_lanes {
    int32_t d;
    const double *x[3];             ///< [d][n + CLX_PAIR_PAD] of the points
    const double *safe2;            ///< [n + CLX_PAIR_PAD] squared distance to the border
    double outer[CLX_PAIR_OUTER];   ///< squared radii, descending
    double at[3], own_safe2;        ///< of the one point
    int64_t within[CLX_PAIR_OUTER]; ///< adds the points closer than each radius
    clx_pair_found close;           ///< r2 < outer[last]
    clx_pair_found unsafe;          ///< r2 < outer[0], and beyond the border as seen from an end
} clx_pair_lanes;

/// What is looked for among the points [begin, end), at most CLX_PAIR_PIECE of them.
typedef struct clx_pair_piece {
    int32_t begin, end;
    bool any_close, any_unsafe; ///< else these lists stay empty
} clx_pair_piece;

void clx_pair_lanes_count(clx_pair_lanes *p, clx_pair_piece piece);
