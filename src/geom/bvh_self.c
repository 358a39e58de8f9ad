// Pairs of triangles of one surface that meet where they should not, with exact signs.
//
// Two closed triangles meet just when an edge of one meets the other; an edge meets a triangle when
// its ends are not strictly on one side of the plane and the line passes on no two sides of the
// three edges. All of that are signs of clx_orient3d, and of clx_orient2d in the coplanar case, so
// the answer is the one for the coordinates as they are, without tolerance.
#include "geom/bvh.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "math/predicates.h"
#include "math/sort.h"
#include "math/vec3.h"
#include <float.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK = 256, SLOTS = 64, EXACT_STEPS = 4 }; // steps of exact arithmetic to a pair's work

static int sign(double x)
{
    return (x > 0.0) - (x < 0.0);
}

/// Projection along `axis`.
static void flat(const double a[3], int axis, double out[2])
{
    out[0] = a[(axis + 1) % 3];
    out[1] = a[(axis + 2) % 3];
}

static int orientation(const double a[3], const double b[3], const double c[3], int axis)
{
    double p[3][2];
    flat(a, axis, p[0]);
    flat(b, axis, p[1]);
    flat(c, axis, p[2]);
    return sign(clx_orient2d(p[0], p[1], p[2]));
}

/// Axis along which the triangle's shadow has an area, or -1 for a segment or a point.
static int shadow_axis(double t[3][3])
{
    double u[3];
    double v[3];
    double n[3];
    v3_sub(u, t[1], t[0]);
    v3_sub(v, t[2], t[0]);
    v3_cross(n, u, v);
    int axis = fabs(n[0]) > fabs(n[1]) ? 0 : 1;
    axis = fabs(n[2]) > fabs(n[axis]) ? 2 : axis;
    for (int i = 0; i < 3; ++i) {
        if (orientation(t[0], t[1], t[2], (axis + i) % 3) != 0) {
            return (axis + i) % 3;
        }
    }
    return -1;
}

/// p between a and b (both included), all three on one line.
static bool is_between(const double a[3], const double b[3], const double p[3])
{
    for (int k = 0; k < 3; ++k) {
        if ((p[k] < a[k] && p[k] < b[k]) || (p[k] > a[k] && p[k] > b[k])) {
            return false;
        }
    }
    return true;
}

/// Closed segments of one plane, seen along `axis`.
static bool segments_meet(const double a[3], const double b[3], const double p[3],
                          const double q[3], int axis)
{
    const int o[4] = {orientation(a, b, p, axis), orientation(a, b, q, axis),
                      orientation(p, q, a, axis), orientation(p, q, b, axis)};
    if (o[0] * o[1] < 0 && o[2] * o[3] < 0) {
        return true;
    }
    return (o[0] == 0 && is_between(a, b, p)) || (o[1] == 0 && is_between(a, b, q)) ||
           (o[2] == 0 && is_between(p, q, a)) || (o[3] == 0 && is_between(p, q, b));
}

/// Closed segment against closed triangle of the same plane.
static bool flat_meet(const double p[3], const double q[3], double t[3][3])
{
    const int axis = shadow_axis(t);
    const int s[3] = {orientation(t[0], t[1], p, axis), orientation(t[1], t[2], p, axis),
                      orientation(t[2], t[0], p, axis)};
    if (s[0] == s[1] && s[1] == s[2]) {
        return true; // p strictly inside; on the border the edges below tell
    }
    for (int i = 0; i < 3; ++i) {
        if (segments_meet(t[i], t[(i + 1) % 3], p, q, axis)) {
            return true;
        }
    }
    return false;
}

/// Closed segment p q against a closed triangle; side_p and side_q are their ends' signs.
static bool segment_meets(const double p[3], int side_p, const double q[3], int side_q,
                          double t[3][3])
{
    if (side_p * side_q > 0) {
        return false;
    }
    if (side_p == 0 && side_q == 0) {
        return flat_meet(p, q, t);
    }
    const int s0 = sign(clx_orient3d(p, q, t[0], t[1]));
    const int s1 = sign(clx_orient3d(p, q, t[1], t[2]));
    const int s2 = sign(clx_orient3d(p, q, t[2], t[0]));
    return s0 * s1 >= 0 && s1 * s2 >= 0 && s2 * s0 >= 0;
}

static bool is_same(const double a[3], const double b[3])
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

/// Corners that sit at the same place: how many, and match[i] = corner of b at corner i of a, or
/// -1.
static int shared_corners(double a[3][3], double b[3][3], int match[3])
{
    int n = 0;
    for (int i = 0; i < 3; ++i) {
        match[i] = -1;
        for (int j = 0; j < 3; ++j) {
            if (is_same(a[i], b[j])) {
                match[i] = j;
            }
        }
        n += match[i] >= 0;
    }
    return n;
}

/// Signs of the corners of b against the plane of a, in which its corner `shared` (-1: none) lies;
/// false when all are strictly on one side.
static bool sides_of(double a[3][3], double b[3][3], int shared, int side[3])
{
    for (int i = 0; i < 3; ++i) {
        side[i] = i == shared ? 0 : sign(clx_orient3d(a[0], a[1], a[2], b[i]));
    }
    return !(side[0] == side[1] && side[1] == side[2] && side[0] != 0);
}

/// Corner with a partner (want) or without, the first one.
static int first_corner(const int match[3], bool want)
{
    for (int i = 0; i < 3; ++i) {
        if ((match[i] >= 0) == want) {
            return i;
        }
    }
    return -1;
}

/// Triangles that share an edge overlap when they lie in one plane on the same side of it.
static bool edge_pair_overlaps(double a[3][3], double b[3][3], const int match[3])
{
    const int i = first_corner(match, false);
    const int j = 3 - match[(i + 1) % 3] - match[(i + 2) % 3];
    if (clx_orient3d(a[0], a[1], a[2], b[j]) != 0.0) {
        return false;
    }
    const int axis = shadow_axis(a);
    return orientation(a[(i + 1) % 3], a[(i + 2) % 3], a[i], axis) ==
           orientation(a[(i + 1) % 3], a[(i + 2) % 3], b[j], axis);
}

/// Does the plane between the bisectors of the one corner that they share have the rest of a
/// strictly on one side and that of b on the other? Then they meet nowhere else. A difference of
/// corners is off by 2^-53 of itself, and so a sum of three products by less than the bound; in a
/// fan of one plane, all signs of which are exact zeros, this tells what exact arithmetic would.
static bool is_parted_at_corner(double a[3][3], double b[3][3], const int match[3])
{
    const int i = first_corner(match, true);
    double edge[4][3];
    double normal[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < 4; ++k) {
        v3_sub(edge[k], k < 2 ? a[(i + 1 + k) % 3] : b[(match[i] + k - 1) % 3], a[i]);
        const double length = v3_norm(edge[k]);
        if (!(length > 0.0)) {
            return false;
        }
        v3_axpy(normal, normal, (k < 2 ? 1.0 : -1.0) / length, edge[k]);
    }
    for (int k = 0; k < 4; ++k) {
        const double term[3] = {normal[0] * edge[k][0], normal[1] * edge[k][1],
                                normal[2] * edge[k][2]};
        const double height = term[0] + term[1] + term[2];
        const double bound =
            4.0 * DBL_EPSILON * (fabs(term[0]) + fabs(term[1]) + fabs(term[2])) + DBL_MIN;
        if (!((k < 2 ? height : -height) > bound)) {
            return false;
        }
    }
    return true;
}

bool clx_triangles_meet(double a[3][3], double b[3][3])
{
    int match[3];
    int side_a[3];
    int side_b[3];
    const int n_shared = shared_corners(a, b, match);
    if (n_shared == 3 || (n_shared == 1 && is_parted_at_corner(a, b, match))) {
        return false;
    }
    if (shadow_axis(a) < 0 || shadow_axis(b) < 0) {
        return false;
    }
    if (n_shared == 2) {
        return edge_pair_overlaps(a, b, match);
    }
    const int shared_a = first_corner(match, true);
    const int shared_b = shared_a < 0 ? -1 : match[shared_a];
    if (!sides_of(a, b, shared_b, side_b) || !sides_of(b, a, shared_a, side_a)) {
        return false;
    }
    // With one shared corner, whatever else the triangles share reaches the edge opposite of it in
    // one of them.
    const int only_a = shared_a < 0 ? -1 : (shared_a + 1) % 3;
    const int only_b = shared_b < 0 ? -1 : (shared_b + 1) % 3;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        if (((only_b < 0 || only_b == i) && segment_meets(b[i], side_b[i], b[j], side_b[j], a)) ||
            ((only_a < 0 || only_a == i) && segment_meets(a[i], side_a[i], a[j], side_a[j], b))) {
            return true;
        }
    }
    return false;
}

/// What one block of triangles found: all counted, the first SLOTS kept.
typedef struct {
    int64_t n;
    int64_t work; ///< pairs tested, and exact arithmetic by its time
    int32_t pair[SLOTS][2];
} block_result;

typedef struct {
    const clast_bvh *bvh;
    block_result *block;
    int64_t first; ///< triangle of the round at hand
    int64_t left;  ///< work that a block may do
    // For a block whose slots ran over: where its pairs go instead.
    int32_t (*all)[2];
    int64_t n_all, cap;
} self_search;

static void append_pair(self_search *search, block_result *result, int32_t i, int32_t j)
{
    CLAST_ASSERT(i != j);
    const int32_t *item = search->bvh->tree.item;
    int32_t pair[2] = {item[i], item[j]};
    if (pair[0] > pair[1]) {
        pair[0] = item[j];
        pair[1] = item[i];
    }
    if (search->all != NULL && search->n_all < search->cap) {
        memcpy(search->all[search->n_all++], pair, sizeof pair);
    } else if (search->all == NULL && result->n < SLOTS) {
        memcpy(result->pair[result->n], pair, sizeof pair);
    }
    ++result->n;
}

static void box_of(double t[3][3], double low[3], double high[3])
{
    for (int k = 0; k < 3; ++k) {
        low[k] = fmin(t[0][k], fmin(t[1][k], t[2][k]));
        high[k] = fmax(t[0][k], fmax(t[1][k], t[2][k]));
    }
}

static bool boxes_meet(const double low[3], const double high[3], const double other_low[3],
                       const double other_high[3])
{
    return low[0] <= other_high[0] && high[0] >= other_low[0] && low[1] <= other_high[1] &&
           high[1] >= other_low[1] && low[2] <= other_high[2] && high[2] >= other_low[2];
}

/// Pairs of triangle i (in leaf order) with every later one.
static void search_one(self_search *search, block_result *result, int32_t i)
{
    CLAST_ASSERT(i >= 0 && i < search->bvh->tree.n_item);
    const clast_bvh *bvh = search->bvh;
    int32_t stack[CLX_TREE_DEPTH + 1];
    int n_stack = 1;
    double low[3];
    double high[3];
    box_of(bvh->corner[i], low, high);
    stack[0] = 0;
    while (n_stack > 0) {
        const int32_t at = stack[--n_stack];
        const clx_tree_node *node = &bvh->tree.node[at];
        if (node->first + node->count <= i + 1 || !boxes_meet(low, high, node->low, node->high)) {
            continue;
        }
        if (node->right != 0) {
            stack[n_stack++] = node->right;
            stack[n_stack++] = at + 1;
            continue;
        }
        for (int32_t j = node->first; j < node->first + node->count; ++j) {
            double other_low[3];
            double other_high[3];
            box_of(bvh->corner[j], other_low, other_high);
            if (j <= i || !boxes_meet(low, high, other_low, other_high)) {
                continue;
            }
            ++result->work;
            if (clx_triangles_meet(bvh->corner[i], bvh->corner[j])) {
                append_pair(search, result, i, j);
            }
        }
    }
}

static void search_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    self_search *search = context;
    block_result *result = &search->block[(search->first + begin) / BLOCK];
    (void)worker;
    for (int64_t i = search->first + begin; i < search->first + end && result->work <= search->left;
         ++i) {
        const int64_t before = clx_exact_work();
        search_one(search, result, (int32_t)i);
        result->work += (clx_exact_work() - before) / EXACT_STEPS;
    }
}

/// Searches in rounds of 1, 2, 4, ... blocks, so that it ends soon after the work is used up, and
/// after the same round for any number of threads. False: it ended there.
static bool search_rounds(self_search *search, int64_t n_block, int64_t budget)
{
    const int64_t n_item = search->bvh->tree.n_item;
    int64_t n_done = 0;
    search->left = budget;
    for (int64_t size = 1; n_done < n_block && search->left >= 0; size *= 2) {
        const int64_t end = n_done + size < n_block ? n_done + size : n_block;
        search->first = n_done * BLOCK;
        clx_parallel_for((end * BLOCK < n_item ? end * BLOCK : n_item) - search->first, BLOCK,
                         search_block, search);
        for (; n_done < end; ++n_done) {
            search->left -= search->block[n_done].work;
        }
    }
    return search->left >= 0;
}

/// Gathers the blocks' pairs, asking crowded blocks again; their sum goes to *n_pair.
static void gather(self_search *search, int64_t n_block, int64_t cap, int32_t (*pair)[2],
                   int64_t *n_pair)
{
    int64_t total = 0;
    search->all = pair;
    search->cap = cap;
    search->first = 0;
    search->left = INT64_MAX;
    for (int64_t b = 0; b < n_block; ++b) {
        const block_result *result = &search->block[b];
        total += result->n;
        if (result->n <= SLOTS) {
            for (int64_t i = 0; i < result->n && search->n_all < cap; ++i) {
                memcpy(pair[search->n_all++], result->pair[i], sizeof result->pair[i]);
            }
        } else if (search->n_all < cap) {
            const int64_t end = (b + 1) * BLOCK;
            search_block(b * BLOCK, end < search->bvh->tree.n_item ? end : search->bvh->tree.n_item,
                         0, search);
        }
    }
    *n_pair = total;
}

static int compare_pairs(const void *a, const void *b)
{
    return clx_compare_ints(a, b, 2);
}

clast_status clx_bvh_self_intersections(const clast_bvh *bvh, int64_t budget, int64_t cap,
                                        int32_t (*pair)[2], int64_t *n_pair)
{
    CLAST_ASSERT(cap >= 0);
    clast_status status = CLAST_OK;
    const int64_t n_block = (bvh->tree.n_item + BLOCK - 1) / BLOCK;
    self_search search = {.bvh = bvh};
    CLX_TRY(clx_alloc(&search.block, n_block, sizeof *search.block));
    if (!search_rounds(&search, n_block, budget)) {
        *n_pair = -1;
        goto done;
    }
    gather(&search, n_block, cap, pair, n_pair);
    if (search.n_all > 1) {
        qsort(pair, (size_t)search.n_all, sizeof *pair, compare_pairs);
    }
done:
    clx_free(search.block);
    return status;
}
