// Top-down builder of the box tree: surface-area heuristic over at most 16 bins an axis.
//
// Sources: MacDonald and Booth 1990 (surface-area heuristic); Wald 2007 (binning). Depth is bounded
// by falling back to median splits as soon as the levels left are only just enough for them.
#include "geom/tree.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "math/vec3.h"
#ifdef __SSE2__
#include <emmintrin.h>
#endif

enum { N_BIN = 16, N_BIN_SMALL = 6, SMALL = 24 };
enum { N_TASK = 64, TASK_LEAST = 2048, N_TOP = 4 * N_TASK }; // subtrees for threads, their items

typedef struct {
    double low[3];
    double high[3];
    int32_t count;
} bin;

typedef struct {
    clx_tree_box *box;
    clx_tree_node *node;
    int32_t n_node;
    int32_t leaf_size;
} build_state;

/// The bins of one range along three axes.
typedef struct {
    int32_t n; ///< bins in use, N_BIN or N_BIN_SMALL
    double origin[3];
    double per_length[3];
    bin bin[3][N_BIN];
} bin_grid;

/// Boxes of one node: their number, depth, hull, and the hull of their (doubled) middles.
typedef struct {
    clx_tree_box *box;
    int32_t n;
    int depth;
    bin bounds;
    bin middles;
} node_range;

/// Where to part a range: axis < 0 means not at all.
typedef struct {
    int axis;
    int32_t bin; ///< items of bins up to this one go left
    double cost; ///< sum of area times count of the two sides
} split_choice;

static void bin_empty(bin *b)
{
    v3_set(b->low, INFINITY, INFINITY, INFINITY);
    v3_set(b->high, -INFINITY, -INFINITY, -INFINITY);
    b->count = 0;
}

// Plain comparisons here and below: fmin and fmax would be library calls.
static void bin_add(bin *b, const double low[3], const double high[3], int32_t count)
{
#ifdef __SSE2__
    // The first two coordinates in one instruction, with the bits of the plain comparison: half of
    // the time to build a tree went into this function.
    _mm_storeu_pd(b->low, _mm_min_pd(_mm_loadu_pd(low), _mm_loadu_pd(b->low)));
    _mm_storeu_pd(b->high, _mm_max_pd(_mm_loadu_pd(high), _mm_loadu_pd(b->high)));
    const int k0 = 2;
#else
    const int k0 = 0;
#endif
    for (int k = k0; k < 3; ++k) {
        b->low[k] = low[k] < b->low[k] ? low[k] : b->low[k];
        b->high[k] = high[k] > b->high[k] ? high[k] : b->high[k];
    }
    b->count += count;
}

/// Half the surface of a box.
static double bin_area(const bin *b)
{
    const double x = b->high[0] - b->low[0];
    const double y = b->high[1] - b->low[1];
    const double z = b->high[2] - b->low[2];
    return b->count > 0 ? x * y + y * z + z * x : 0.0;
}

/// Twice the middle of a box: what bins and medians sort by.
static double middle(const clx_tree_box *box, int axis)
{
    return box->low[axis] + box->high[axis];
}

static int32_t bin_of(const bin_grid *grid, const clx_tree_box *box, int axis)
{
    CLAST_ASSERT(grid->n == N_BIN || grid->n == N_BIN_SMALL);
    const double x = (middle(box, axis) - grid->origin[axis]) * grid->per_length[axis];
    const int32_t b = (int32_t)x;
    return b < grid->n ? b : grid->n - 1;
}

/// Cheapest plane between bins along one axis.
static void best_plane(const bin_grid *grid, int axis, split_choice *best)
{
    const bin *bins = grid->bin[axis];
    double right_cost[N_BIN];
    bin side;
    bin_empty(&side);
    for (int32_t i = grid->n - 1; i > 0; --i) {
        bin_add(&side, bins[i].low, bins[i].high, bins[i].count);
        right_cost[i] = bin_area(&side) * side.count;
    }
    const int32_t n_item = side.count + bins[0].count;
    bin_empty(&side);
    for (int32_t i = 0; i < grid->n - 1; ++i) {
        bin_add(&side, bins[i].low, bins[i].high, bins[i].count);
        const double cost = bin_area(&side) * side.count + right_cost[i + 1];
        if (side.count > 0 && side.count < n_item && cost < best->cost) {
            *best = (split_choice){axis, i, cost};
        }
    }
}

/// Sorts a range's boxes into bins spread over the box of their middles.
static void fill_bins(const clx_tree_box *box, int32_t n, const bin *middles, bin_grid *grid)
{
    grid->n = n < SMALL ? N_BIN_SMALL : N_BIN;
    for (int k = 0; k < 3; ++k) {
        const double length = middles->high[k] - middles->low[k];
        const double per_length = grid->n * (1.0 - 1e-12) / length;
        grid->origin[k] = middles->low[k];
        grid->per_length[k] = per_length < 1e300 ? per_length : 0.0;
        for (int32_t i = 0; i < grid->n; ++i) {
            bin_empty(&grid->bin[k][i]);
        }
    }
    for (int32_t i = 0; i < n; ++i) {
        for (int k = 0; k < 3; ++k) {
            bin_add(&grid->bin[k][bin_of(grid, &box[i], k)], box[i].low, box[i].high, 1);
        }
    }
}

/// Parts the range in place by bin number; how many went left.
static int32_t part(clx_tree_box *box, int32_t n, const bin_grid *grid, const split_choice *split)
{
    CLAST_ASSERT(split->axis >= 0 && split->bin < grid->n - 1);
    int32_t i = 0;
    int32_t j = n;
    while (i < j) {
        if (bin_of(grid, &box[i], split->axis) <= split->bin) {
            ++i;
        } else {
            const clx_tree_box swap = box[--j];
            box[j] = box[i];
            box[i] = swap;
        }
    }
    return i;
}

/// Order for medians: middle along the axis, then item number, so that no two items are equal.
static bool comes_before(const clx_tree_box *a, const clx_tree_box *b, int axis)
{
    const double x = middle(a, axis);
    const double y = middle(b, axis);
    return x < y || (x == y && a->item < b->item);
}

/// Puts the `half` lowest items first (quickselect; the pivot is the middle item of the range).
static void part_median(clx_tree_box *box, int32_t n, int32_t half, int axis)
{
    CLAST_ASSERT(half > 0 && half < n);
    int32_t low = 0;
    int32_t high = n - 1;
    while (low < high) {
        const clx_tree_box pivot = box[low + (high - low) / 2];
        int32_t i = low;
        int32_t j = high;
        while (i <= j) {
            while (comes_before(&box[i], &pivot, axis)) {
                ++i;
            }
            while (comes_before(&pivot, &box[j], axis)) {
                --j;
            }
            if (i <= j) {
                const clx_tree_box swap = box[i];
                box[i++] = box[j];
                box[j--] = swap;
            }
        }
        if (half <= j) {
            high = j;
        } else if (half >= i) {
            low = i;
        } else {
            return;
        }
    }
}

/// Levels that a median split needs to bring n items into single leaves.
static int levels(int32_t n)
{
    int level = 0;
    while (((int64_t)1 << level) < n) {
        ++level;
    }
    return level;
}

static int longest_axis(const bin *b)
{
    int axis = 0;
    for (int k = 1; k < 3; ++k) {
        axis = b->high[k] - b->low[k] > b->high[axis] - b->low[axis] ? k : axis;
    }
    return axis;
}

/// Parts a range; items that go left (0: keep it as a leaf), and the axis.
static int32_t split(const node_range *range, int32_t leaf_size, int *axis)
{
    bin_grid grid;
    split_choice best = {-1, 0, INFINITY};
    const double area = bin_area(&range->bounds);
    *axis = longest_axis(&range->middles);
    if (range->depth + 1 + levels(range->n - 1) <= CLX_TREE_DEPTH) {
        fill_bins(range->box, range->n, &range->middles, &grid);
        for (int k = 0; k < 3; ++k) {
            best_plane(&grid, k, &best);
        }
    }
    // Cost of a visit and of an item are alike: a leaf costs n, a split 1 + cost / area.
    if (range->n <= leaf_size && !(area + best.cost < range->n * area)) {
        return 0;
    }
    if (best.axis >= 0) {
        *axis = best.axis;
        return part(range->box, range->n, &grid, &best);
    }
    part_median(range->box, range->n, range->n / 2, *axis);
    return range->n / 2;
}

static void measure_range(node_range *range)
{
    bin_empty(&range->bounds);
    bin_empty(&range->middles);
    for (int32_t i = 0; i < range->n; ++i) {
        const clx_tree_box *box = &range->box[i];
        const double m[3] = {middle(box, 0), middle(box, 1), middle(box, 2)};
        bin_add(&range->bounds, box->low, box->high, 1);
        bin_add(&range->middles, m, m, 1);
    }
}

/// Measures and parts a range; fills all of its node but the right child. Items that go left, 0 for
/// a leaf.
static int32_t part_node(clx_tree_box *box, int32_t first, int32_t n, int depth, int32_t leaf_size,
                         clx_tree_node *node)
{
    CLAST_ASSERT(n > 0 && depth <= CLX_TREE_DEPTH);
    node_range range = {.box = box + first, .n = n, .depth = depth};
    int axis = 0;
    measure_range(&range);
    const int32_t n_left = n > 1 ? split(&range, leaf_size, &axis) : 0;
    CLAST_ASSERT(n_left >= 0 && n_left < n);
    v3_copy(node->low, range.bounds.low);
    v3_copy(node->high, range.bounds.high);
    node->first = first;
    node->count = n;
    node->axis = axis;
    node->right = 0;
    return n_left;
}

static void build_node(build_state *s, int32_t first, int32_t n, int depth)
{
    const int32_t self = s->n_node++;
    const int32_t n_left = part_node(s->box, first, n, depth, s->leaf_size, &s->node[self]);
    if (n_left > 0) {
        build_node(s, first, n_left, depth + 1);
        s->node[self].right = s->n_node;
        build_node(s, first + n_left, n - n_left, depth + 1);
    }
}

/// A node near the root: parted, or the root of a subtree that one thread builds.
typedef struct {
    clx_tree_node node;
    int depth;
    int32_t n_left; ///< items; 0: a subtree's root
    int32_t left;   ///< of the top levels; the right child follows it
    int32_t n_node; ///< of the subtree
    int32_t place;  ///< in the tree
} top_node;

/// The nodes near the root, level by level, and where the subtrees below them are made: that of
/// the items from `first` on begins at node 2 first.
typedef struct {
    clx_tree_box *box;
    int32_t leaf_size;
    int32_t n;
    top_node at[N_TOP];
    int32_t level; ///< first of the last level
    clx_tree_node *made;
    clx_tree_node *node; ///< of the tree
} top_tree;

static void part_level(int64_t begin, int64_t end, int32_t worker, void *context)
{
    top_tree *c = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        top_node *at = &c->at[c->level + i];
        if (at->node.count >= TASK_LEAST) {
            at->n_left = part_node(c->box, at->node.first, at->node.count, at->depth, c->leaf_size,
                                   &at->node);
        }
    }
}

static void append_to_top(top_tree *c, int32_t first, int32_t n, int depth)
{
    CLAST_ASSERT(c->n < N_TOP && n > 0);
    c->at[c->n++] = (top_node){.node = {.first = first, .count = n}, .depth = depth};
}

/// Parts the ranges of a level by all threads, then those of the next, until there are enough.
static void grow_top(top_tree *c, int32_t n_item)
{
    append_to_top(c, 0, n_item, 0);
    for (int32_t n_level = 1; n_level > 0 && n_level < N_TASK && c->n + 2 * n_level <= N_TOP;) {
        const int32_t end = c->n;
        clx_parallel_for(n_level, 1, part_level, c);
        for (int32_t i = c->level; i < end; ++i) {
            top_node *at = &c->at[i];
            if (at->n_left > 0) {
                at->left = c->n;
                append_to_top(c, at->node.first, at->n_left, at->depth + 1);
                append_to_top(c, at->node.first + at->n_left, at->node.count - at->n_left,
                              at->depth + 1);
            }
        }
        c->level = end;
        n_level = c->n - end;
    }
}

static void build_subtrees(int64_t begin, int64_t end, int32_t worker, void *context)
{
    top_tree *c = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        top_node *at = &c->at[i];
        if (at->n_left == 0) {
            build_state s = {.box = c->box,
                             .node = c->made + 2 * (ptrdiff_t)at->node.first,
                             .leaf_size = c->leaf_size};
            build_node(&s, at->node.first, at->node.count, at->depth);
            at->n_node = s.n_node;
        }
    }
}

/// Numbers the nodes in preorder from `place` on; the number after the last.
static int32_t place_top(top_tree *c, int32_t i, int32_t place)
{
    top_node *at = &c->at[i];
    at->place = place;
    if (at->n_left == 0) {
        return place + at->n_node;
    }
    at->node.right = place_top(c, at->left, place + 1);
    return place_top(c, at->left + 1, at->node.right);
}

static void copy_subtrees(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const top_tree *c = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        const top_node *at = &c->at[i];
        const clx_tree_node *from =
            at->n_left > 0 ? &at->node : c->made + 2 * (ptrdiff_t)at->node.first;
        const int32_t shift = at->n_left > 0 ? 0 : at->place;
        for (int32_t k = 0; k < (at->n_left > 0 ? 1 : at->n_node); ++k) {
            clx_tree_node *to = &c->node[at->place + k];
            *to = from[k];
            to->right += to->right != 0 ? shift : 0;
        }
    }
}

/// The tree of build_node, its subtrees by all threads.
static clast_status build_along(clx_tree_box *box, int32_t leaf_size, clx_tree *tree)
{
    clast_status status = CLAST_OK;
    top_tree *c = NULL;
    clx_tree_node *made = NULL;
    CLX_TRY(clx_alloc(&c, 1, sizeof *c));
    CLX_TRY(clx_alloc(&made, 2 * (int64_t)tree->n_item, sizeof *made));
    c->box = box;
    c->leaf_size = leaf_size;
    c->made = made;
    grow_top(c, tree->n_item);
    clx_parallel_for(c->n, 1, build_subtrees, c);
    tree->n_node = place_top(c, 0, 0);
    CLX_TRY(clx_alloc(&tree->node, tree->n_node, sizeof *tree->node));
    c->node = tree->node;
    clx_parallel_for(c->n, 1, copy_subtrees, c);
done:
    CLX_FREE(made, c);
    return status;
}

static clast_status build_alone(clx_tree_box *box, int32_t leaf_size, clx_tree *tree)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&tree->node, 2 * (int64_t)tree->n_item - 1, sizeof *tree->node));
    build_state s = {.box = box, .node = tree->node, .leaf_size = leaf_size};
    build_node(&s, 0, tree->n_item, 0);
    tree->n_node = s.n_node;
    CLX_TRY(clx_realloc(&tree->node, tree->n_node, sizeof *tree->node));
done:
    return status;
}

clast_status clx_tree_build(clx_tree_box *box, int32_t n, int32_t leaf_size, clx_tree *tree)
{
    CLAST_ASSERT(leaf_size >= 1);
    clast_status status = CLAST_OK;
    clx_tree made = {.n_item = n};
    CLX_CHECK(n >= 1, CLAST_E_GEOMETRY, "a box tree over %d items; it needs at least one", n);
    CLX_CHECK(n <= INT32_MAX / 2, CLAST_E_LIMIT, "a box tree over %d items is beyond 2^30", n);
    CLX_TRY(clx_alloc(&made.item, n, sizeof *made.item));
    CLX_TRY(n < 4 * TASK_LEAST ? build_alone(box, leaf_size, &made)
                               : build_along(box, leaf_size, &made));
    for (int32_t i = 0; i < n; ++i) {
        made.item[i] = box[i].item;
    }
    *tree = made;
    made = (clx_tree){0};
done:
    clx_tree_free(&made);
    return status;
}

void clx_tree_free(clx_tree *tree)
{
    CLX_FREE(tree->node, tree->item);
    *tree = (clx_tree){0};
}
