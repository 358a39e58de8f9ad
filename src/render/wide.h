#pragma once
// Eight children a node in single precision: what pictures walk. Boxes are rounded outwards, so
// nothing is missed; what a leaf holds is tested in double by the caller.
#include "geom/tree.h"

#include <math.h>
#include <stdbool.h>

enum { CLX_WIDE_LANES = 8 };

/// 256 bytes.
typedef struct clx_wide_node {
    float bound[2][3][CLX_WIDE_LANES]; ///< low and high ends along the axes
    int32_t child[CLX_WIDE_LANES];     ///< node, or leaf where its bit is set
    uint32_t used;                     ///< bits of the lanes that have a child
    uint32_t leaves;                   ///< of those whose child is a leaf
    uint32_t unused[6];
} clx_wide_node;

/// Items first .. first + count - 1 of the binary tree.
typedef struct clx_wide_leaf {
    int32_t first, count;
} clx_wide_leaf;

typedef struct clx_wide {
    int32_t n_node;
    int32_t n_leaf;
    clx_wide_node *node;
    clx_wide_leaf *leaf;
    double max_abs; ///< largest absolute coordinate of the root's box
} clx_wide;

/// Merges levels of a binary tree; subtrees of at most leaf_size items become leaves, and so do
/// larger leaves of the tree. Coordinates must be below 1e30 in size.
clast_status clx_wide_build(const clx_tree *tree, int32_t leaf_size, clx_wide *wide);
void clx_wide_free(clx_wide *wide);

/// Rays of a bundle taken together: origins and directions between these ends. By a box's low face
/// (0) the ray farthest ahead tells when the first of them may be past it, by its high face (1) the
/// one farthest behind. The face in `first` bounds the entry; the other one bounds the exit, or the
/// entry too where directions of both signs spread from the origins.
typedef struct clx_wide_beam {
    float from[2][3]; ///< origins' high and low ends, moved apart so that boxes seem wider
    float inverse[2][3];
    int first[3];
    bool is_spread[3];
} clx_wide_beam;

/// How much wider boxes must seem to rays from between these ends: 4 ulp of a float.
static inline double clx_wide_margin(const clx_wide *wide, double origin[2][3])
{
    double max_abs = wide->max_abs;
    for (int k = 0; k < 3; ++k) {
        const double low = fabs(origin[0][k]);
        const double high = fabs(origin[1][k]);
        max_abs = low > max_abs ? low : max_abs;
        max_abs = high > max_abs ? high : max_abs;
    }
    return 0x1p-21 * max_abs;
}

/// Ends [low, high] of the rays' origins and directions.
static inline clx_wide_beam clx_wide_beam_of(double origin[2][3], double direction[2][3],
                                             double margin)
{
    clx_wide_beam beam;
    for (int k = 0; k < 3; ++k) {
        beam.from[0][k] = (float)(origin[1][k] + margin);
        beam.from[1][k] = (float)(origin[0][k] - margin);
        beam.inverse[0][k] = (float)(1.0 / direction[1][k]);
        beam.inverse[1][k] = (float)(1.0 / direction[0][k]);
        beam.first[k] = signbit(direction[1][k]) != 0;
        beam.is_spread[k] = signbit(direction[0][k]) != 0 && signbit(direction[1][k]) == 0;
    }
    return beam;
}
