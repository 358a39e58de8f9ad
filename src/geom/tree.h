#pragma once
// A binary tree over boxes, flat and in preorder; what clast_bvh, pair traversals and pictures
// stand on.
#include "base/status.h"

/// No path from the root is longer than this many edges, whatever the boxes: a depth-first walk
/// that pushes one child per inner node never needs more than CLX_TREE_DEPTH slots, one that pushes
/// both never more than CLX_TREE_DEPTH + 1.
enum { CLX_TREE_DEPTH = 64 };

/// 64 bytes. The left child of inner node i is i + 1.
typedef struct clx_tree_node {
    double low[3];
    double high[3];
    int32_t right; ///< right child; 0 marks a leaf
    int32_t first; ///< items of the whole subtree: item[first .. first + count - 1]
    int32_t count;
    int32_t axis; ///< inner node: axis along which its children were parted, left is lower
} clx_tree_node;

typedef struct clx_tree {
    int32_t n_node;
    int32_t n_item;
    clx_tree_node *node; ///< [n_node] root first
    int32_t *item;       ///< [n_item] permutation of the boxes, leaf by leaf
} clx_tree;

/// Box of one item, the builder's input; `item` is its number.
typedef struct clx_tree_box {
    double low[3];
    double high[3];
    int32_t item;
} clx_tree_box;

/// Builds by binned surface-area heuristic, leaves of at most leaf_size items (median splits where
/// the depth would run out). Reorders `box` [n].
///
/// Deterministic: depends on the boxes and their order alone. O(n log n).
/// @return CLAST_E_GEOMETRY for n < 1
CLX_SHARED clast_status clx_tree_build(clx_tree_box *box, int32_t n, int32_t leaf_size,
                                       clx_tree *tree);
CLX_SHARED void clx_tree_free(clx_tree *tree);
