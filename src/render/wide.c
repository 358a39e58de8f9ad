// Collapses the binary tree into nodes of eight: the largest inner child is opened until eight are
// there.
#include "render/wide.h"

#include "base/alloc.h"
#include "base/lines.h"

static double half_area(const clx_tree_node *node)
{
    const double x = node->high[0] - node->low[0];
    const double y = node->high[1] - node->low[1];
    const double z = node->high[2] - node->low[2];
    return x * y + y * z + z * x;
}

static float round_down(double x)
{
    const float f = (float)x;
    return (double)f > x ? nextafterf(f, -INFINITY) : f;
}

static float round_up(double x)
{
    const float f = (float)x;
    return (double)f < x ? nextafterf(f, INFINITY) : f;
}

typedef struct {
    const clx_tree *tree;
    int32_t leaf_size;
    clx_wide *wide;
} collapse_state;

static bool is_leaf(const collapse_state *s, const clx_tree_node *node)
{
    return node->right == 0 || node->count <= s->leaf_size;
}

/// Up to eight descendants of a binary node that cover it; their number.
static int gather(const collapse_state *s, int32_t at, int32_t child[CLX_WIDE_LANES])
{
    CLAST_ASSERT(at >= 0 && at < s->tree->n_node);
    const clx_tree_node *nodes = s->tree->node;
    double area[CLX_WIDE_LANES]; // of those that can be opened, else -1
    int n = 1;
    child[0] = at;
    area[0] = is_leaf(s, &nodes[at]) ? -1.0 : half_area(&nodes[at]);
    while (n < CLX_WIDE_LANES) {
        int open = 0;
        for (int i = 1; i < n; ++i) {
            open = area[i] > area[open] ? i : open;
        }
        if (area[open] < 0.0) {
            break;
        }
        const int32_t pair[2] = {child[open] + 1, nodes[child[open]].right};
        const int lane[2] = {open, n++};
        for (int k = 0; k < 2; ++k) {
            child[lane[k]] = pair[k];
            area[lane[k]] = is_leaf(s, &nodes[pair[k]]) ? -1.0 : half_area(&nodes[pair[k]]);
        }
    }
    return n;
}

static int32_t collapse(const collapse_state *s, int32_t at)
{
    CLAST_ASSERT(at >= 0 && at < s->tree->n_node);
    clx_wide *wide = s->wide;
    const int32_t self = wide->n_node++;
    wide->node[self] = (clx_wide_node){0};
    int32_t child[CLX_WIDE_LANES];
    const int n = gather(s, at, child);
    wide->node[self].used = (1U << n) - 1;
    for (int i = 0; i < CLX_WIDE_LANES; ++i) {
        const clx_tree_node *from = i < n ? &s->tree->node[child[i]] : NULL;
        for (int k = 0; k < 3; ++k) {
            wide->node[self].bound[0][k][i] = from != NULL ? round_down(from->low[k]) : INFINITY;
            wide->node[self].bound[1][k][i] = from != NULL ? round_up(from->high[k]) : -INFINITY;
        }
    }
    for (int i = 0; i < n; ++i) {
        const clx_tree_node *from = &s->tree->node[child[i]];
        if (is_leaf(s, from)) {
            wide->leaf[wide->n_leaf] = (clx_wide_leaf){from->first, from->count};
            wide->node[self].child[i] = wide->n_leaf++;
            wide->node[self].leaves |= 1U << i;
        } else {
            const int32_t below = collapse(s, child[i]);
            wide->node[self].child[i] = below;
        }
    }
    return self;
}

/// Leaves below a binary node, and inner nodes: at most one less than those make nodes of eight.
static int32_t count_leaves(const collapse_state *s)
{
    int32_t n = 0;
    for (int32_t at = 0; at < s->tree->n_node;) {
        const clx_tree_node *node = &s->tree->node[at];
        const bool is_last = is_leaf(s, node);
        n += is_last;
        // In preorder: a leaf's own subtree, at most 2 count - 1 nodes, is behind it.
        int32_t next = at + 1;
        for (int32_t end = is_last ? node->first + node->count : 0;
             next < s->tree->n_node && s->tree->node[next].first < end; ++next) {
        }
        at = next;
    }
    return n;
}

clast_status clx_wide_build(const clx_tree *tree, int32_t leaf_size, clx_wide *wide)
{
    clast_status status = CLAST_OK;
    clx_wide made = {0};
    int64_t capacity = 0;
    const collapse_state s = {tree, leaf_size, &made};
    for (int k = 0; k < 3; ++k) {
        made.max_abs = fmax(made.max_abs, fabs(tree->node[0].low[k]));
        made.max_abs = fmax(made.max_abs, fabs(tree->node[0].high[k]));
    }
    CLX_CHECK(made.max_abs < 1e30, CLAST_E_GEOMETRY,
              "a coordinate of %g is too large to draw; it must be below 1e30", made.max_abs);
    const int32_t n_leaf = count_leaves(&s);
    CLX_TRY(clx_alloc(&made.leaf, n_leaf, sizeof *made.leaf));
    CLX_TRY(clx_grow_lines(&made.node, &capacity, n_leaf, sizeof *made.node)); // each opens one
    (void)collapse(&s, 0);
    CLAST_ASSERT(made.n_leaf == n_leaf);
    *wide = made;
    made = (clx_wide){0};
done:
    clx_wide_free(&made);
    return status;
}

void clx_wide_free(clx_wide *wide)
{
    CLX_FREE(wide->node, wide->leaf);
    *wide = (clx_wide){0};
}
