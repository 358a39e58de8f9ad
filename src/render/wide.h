#pragma once
// Eight children a node in single precision: what pictures walk. Boxes are rounded outwards, so
// nothing is missed; what a leaf holds is tested in double by the caller.
#include "geom/tree.h"

#include <math.h>
#include <stdbool.h>

enum { CLX_WIDE_LANES = 8 };

/// 256 bytes. An empty lane has low > high.
typedef struct clx_wide_node {
    float bound[2][3][CLX_WIDE_LANES]; ///< low and high ends along the axes
    int32_t child[CLX_WIDE_LANES];     ///< node, or leaf where its bit is set
    uint32_t leaves;
    uint32_t unused[7];
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
    double reach; ///< largest absolute coordinate of the root's box
} clx_wide;

/// Merges levels of a binary tree; subtrees of at most leaf_size items become leaves, and so do
/// larger leaves of the tree. Coordinates must be below 1e30 in size.
clast_status clx_wide_build(const clx_tree *tree, int32_t leaf_size, clx_wide *wide);
void clx_wide_free(clx_wide *wide);

typedef struct clx_wide_ray {
    float near[3]; ///< origin, shifted so that boxes seem wider than they are
    float far[3];
    float inverse[3];
    bool is_negative[3];
} clx_wide_ray;

static inline clx_wide_ray clx_wide_ray_of(const clx_wide *wide, const double origin[3],
                                           const double direction[3])
{
    clx_wide_ray ray;
    double reach = wide->reach;
    for (int k = 0; k < 3; ++k) {
        const double size = fabs(origin[k]);
        reach = size > reach ? size : reach;
    }
    const double widen = 0x1p-21 * reach; // 4 ulp of a float
    for (int k = 0; k < 3; ++k) {
        const bool is_negative = signbit(direction[k]);
        ray.is_negative[k] = is_negative;
        ray.near[k] = (float)(is_negative ? origin[k] - widen : origin[k] + widen);
        ray.far[k] = (float)(is_negative ? origin[k] + widen : origin[k] - widen);
        ray.inverse[k] = (float)(1.0 / direction[k]);
    }
    return ray;
}
