// Collapses the binary tree into nodes of four: the largest inner child is opened until four are
// there.
#include "render/wide.h"

#include "base/alloc.h"

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

/// Up to four descendants of a binary node that cover it; their number.
static int gather(const clx_tree *tree, int32_t at, int32_t child[CLX_WIDE])
{
    CLAST_ASSERT(at >= 0 && at < tree->n_node);
    int n = 1;
    child[0] = at;
    while (n < CLX_WIDE) {
        int open = -1;
        for (int i = 0; i < n; ++i) {
            const clx_tree_node *node = &tree->node[child[i]];
            if (node->right != 0 &&
                (open < 0 || half_area(node) > half_area(&tree->node[child[open]]))) {
                open = i;
            }
        }
        if (open < 0) {
            break;
        }
        const int32_t opened = child[open];
        child[open] = opened + 1;
        child[n++] = tree->node[opened].right;
    }
    return n;
}

static int32_t collapse(const clx_tree *tree, int32_t at, clx_wide *wide)
{
    CLAST_ASSERT(at >= 0 && at < tree->n_node);
    const int32_t self = wide->n_node++;
    int32_t child[CLX_WIDE];
    const int n = gather(tree, at, child);
    for (int i = 0; i < CLX_WIDE; ++i) {
        const clx_tree_node *from = i < n ? &tree->node[child[i]] : NULL;
        for (int k = 0; k < 3; ++k) {
            wide->node[self].bound[0][k][i] = from != NULL ? round_down(from->low[k]) : INFINITY;
            wide->node[self].bound[1][k][i] = from != NULL ? round_up(from->high[k]) : -INFINITY;
        }
    }
    for (int i = 0; i < n; ++i) {
        const clx_tree_node *from = &tree->node[child[i]];
        if (from->right == 0) {
            wide->node[self].child[i] = from->first;
            wide->node[self].count[i] = from->count;
        } else {
            const int32_t below = collapse(tree, child[i], wide);
            wide->node[self].child[i] = below;
        }
    }
    return self;
}

clast_status clx_wide_build(const clx_tree *tree, clx_wide *wide)
{
    clast_status status = CLAST_OK;
    clx_wide made = {0};
    for (int k = 0; k < 3; ++k) {
        made.reach = fmax(made.reach, fabs(tree->node[0].low[k]));
        made.reach = fmax(made.reach, fabs(tree->node[0].high[k]));
    }
    CLX_CHECK(made.reach < 1e30, CLAST_E_GEOMETRY,
              "a coordinate of %g is too large to draw; it must be below 1e30", made.reach);
    CLX_TRY(clx_alloc(&made.node, tree->n_node, sizeof *made.node));
    (void)collapse(tree, 0, &made);
    CLX_TRY(clx_realloc(&made.node, made.n_node, sizeof *made.node));
    *wide = made;
    made = (clx_wide){0};
done:
    clx_wide_free(&made);
    return status;
}

void clx_wide_free(clx_wide *wide)
{
    clx_free(wide->node);
    *wide = (clx_wide){0};
}
