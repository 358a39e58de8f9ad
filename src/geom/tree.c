// Top-down builder of the box tree: surface-area heuristic over at most 16 bins an axis.
//
// Sources: MacDonald and Booth 1990 (surface-area heuristic); Wald 2007 (binning). Depth is bounded
// by falling back to median splits as soon as the levels left are only just enough for them.
#include "geom/tree.h"

#include "base/alloc.h"
#include "math/vec3.h"

enum { N_BIN = 16 };

typedef struct {
    double low[3];
    double high[3];
    int32_t count;
} bin;

typedef struct {
    clx_tree_box *box;
    clx_tree *tree;
    int32_t leaf_size;
} build_state;

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
    for (int k = 0; k < 3; ++k) {
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

static double middle(const clx_tree_box *box, int axis)
{
    return 0.5 * (box->low[axis] + box->high[axis]);
}

static int32_t bin_of(const clx_tree_box *box, int axis, double origin, double per_length)
{
    const int32_t b = (int32_t)((middle(box, axis) - origin) * per_length);
    return b < 0 ? 0 : b >= N_BIN ? N_BIN - 1 : b;
}

/// Cheapest plane between bins along one axis.
static void best_plane(const bin *bins, int axis, split_choice *best)
{
    double right_cost[N_BIN];
    bin side;
    bin_empty(&side);
    for (int i = N_BIN - 1; i > 0; --i) {
        bin_add(&side, bins[i].low, bins[i].high, bins[i].count);
        right_cost[i] = bin_area(&side) * side.count;
    }
    const int32_t n_right_most = side.count + bins[0].count;
    bin_empty(&side);
    for (int32_t i = 0; i < N_BIN - 1; ++i) {
        bin_add(&side, bins[i].low, bins[i].high, bins[i].count);
        const double cost = bin_area(&side) * side.count + right_cost[i + 1];
        if (side.count > 0 && side.count < n_right_most && cost < best->cost) {
            *best = (split_choice){axis, i, cost};
        }
    }
}

/// Bins of the range's box middles along the three axes, spread over the box of the middles.
static void fill_bins(const clx_tree_box *box, int32_t n, const bin *middles,
                      const double per_length[3], bin bins[3][N_BIN])
{
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < N_BIN; ++i) {
            bin_empty(&bins[k][i]);
        }
    }
    for (int32_t i = 0; i < n; ++i) {
        for (int k = 0; k < 3; ++k) {
            const int32_t b = bin_of(&box[i], k, middles->low[k], per_length[k]);
            bin_add(&bins[k][b], box[i].low, box[i].high, 1);
        }
    }
}

/// Parts the range in place by bin number; how many went left.
static int32_t part(clx_tree_box *box, int32_t n, const split_choice *split, double origin,
                    double per_length)
{
    int32_t i = 0;
    int32_t j = n;
    while (i < j) {
        if (bin_of(&box[i], split->axis, origin, per_length) <= split->bin) {
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

static bin box_of_middles(const clx_tree_box *box, int32_t n)
{
    bin b;
    bin_empty(&b);
    for (int32_t i = 0; i < n; ++i) {
        const double m[3] = {middle(&box[i], 0), middle(&box[i], 1), middle(&box[i], 2)};
        bin_add(&b, m, m, 1);
    }
    return b;
}

/// Parts a range; items that go left (0: keep it as a leaf), and the axis.
static int32_t split(const build_state *s, clx_tree_box *box, int32_t n, int depth, double area,
                     int *axis)
{
    const bin middles = box_of_middles(box, n);
    bin bins[3][N_BIN];
    double per_length[3];
    split_choice best = {-1, 0, INFINITY};
    *axis = longest_axis(&middles);
    if (depth + 1 + levels(n - 1) <= CLX_TREE_DEPTH) {
        for (int k = 0; k < 3; ++k) {
            const double length = middles.high[k] - middles.low[k];
            per_length[k] = length > 0.0 ? N_BIN * (1.0 - 1e-12) / length : 0.0;
            per_length[k] = per_length[k] < 1e300 ? per_length[k] : 0.0;
        }
        fill_bins(box, n, &middles, per_length, bins);
        for (int k = 0; k < 3; ++k) {
            best_plane(bins[k], k, &best);
        }
    }
    // Cost of a visit and of an item are alike: a leaf costs n, a split 1 + cost / area.
    if (n <= s->leaf_size && !(area + best.cost < n * area)) {
        return 0;
    }
    if (best.axis >= 0) {
        *axis = best.axis;
        return part(box, n, &best, middles.low[best.axis], per_length[best.axis]);
    }
    part_median(box, n, n / 2, *axis);
    return n / 2;
}

static void build_node(build_state *s, int32_t first, int32_t n, int depth)
{
    clx_tree_box *box = s->box + first;
    const int32_t self = s->tree->n_node++;
    int axis = 0;
    bin bounds;
    bin_empty(&bounds);
    for (int32_t i = 0; i < n; ++i) {
        bin_add(&bounds, box[i].low, box[i].high, 1);
    }
    const int32_t n_left = n > 1 ? split(s, box, n, depth, bin_area(&bounds), &axis) : 0;
    clx_tree_node *node = &s->tree->node[self];
    v3_copy(node->low, bounds.low);
    v3_copy(node->high, bounds.high);
    node->first = first;
    node->count = n;
    node->axis = axis;
    node->right = 0;
    if (n_left > 0) {
        build_node(s, first, n_left, depth + 1);
        s->tree->node[self].right = s->tree->n_node;
        build_node(s, first + n_left, n - n_left, depth + 1);
    }
}

clast_status clx_tree_build(clx_tree_box *box, int32_t n, int32_t leaf_size, clx_tree *tree)
{
    clast_status status = CLAST_OK;
    clx_tree made = {.n_item = n};
    CLX_CHECK(n >= 1, CLAST_E_GEOMETRY, "a box tree over %d items; it needs at least one", n);
    CLX_CHECK(n <= INT32_MAX / 2, CLAST_E_LIMIT, "a box tree over %d items is beyond 2^30", n);
    CLX_TRY(clx_alloc(&made.node, 2 * (int64_t)n - 1, sizeof *made.node));
    CLX_TRY(clx_alloc(&made.item, n, sizeof *made.item));
    build_state state = {box, &made, leaf_size};
    build_node(&state, 0, n, 0);
    for (int32_t i = 0; i < n; ++i) {
        made.item[i] = box[i].item;
    }
    CLX_TRY(clx_realloc(&made.node, made.n_node, sizeof *made.node));
    *tree = made;
    made = (clx_tree){0};
done:
    clx_tree_free(&made);
    return status;
}

void clx_tree_free(clx_tree *tree)
{
    clx_free(tree->node);
    clx_free(tree->item);
    *tree = (clx_tree){0};
}
