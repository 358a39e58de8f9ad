// Greatest vertex-to-vertex distance of a mesh, exactly.
//
// Branch and bound: the vertices go into a k-d tree of boxes; for each vertex the tree is searched
// for a farther partner than the best pair so far, and a box whose farthest corner is nearer is
// left out. No hull is needed, so flat and tiny point sets work too. Measured on a sphere of 10,242
// vertices (the worst kind: every vertex has a partner at nearly the greatest distance): see
// docs/theory/mesh-repair.md.
#include <clast/mesh.h>

#include "base/alloc.h"
#include "base/status.h"
#include "geom/whole.h"
#include "math/vec3.h"
#include <string.h>

enum { LEAF = 8 };

typedef struct {
    double low[3], high[3];
    int32_t begin, end;
    int32_t right; ///< second child, or 0 in a leaf; the first child is the next node
} length_node;

typedef struct {
    double (*point)[3];
    length_node *node;
    int32_t n_node;
    double best2;
} length_tree;

static void swap_points(double (*point)[3], int32_t i, int32_t j)
{
    double keep[3];
    v3_copy(keep, point[i]);
    v3_copy(point[i], point[j]);
    v3_copy(point[j], keep);
}

/// Hoare's selection: afterwards points [begin, middle) are <= those of [middle, end) along axis k.
static void select_middle(double (*point)[3], int32_t begin, int32_t end, int32_t middle, int k)
{
    CLAST_ASSERT(begin <= middle && middle < end);
    int32_t low = begin;
    int32_t high = end - 1;
    while (low < high) {
        const double pivot = point[low + (high - low) / 2][k];
        int32_t i = low;
        int32_t j = high;
        while (i <= j) {
            while (point[i][k] < pivot) {
                ++i;
            }
            while (point[j][k] > pivot) {
                --j;
            }
            if (i <= j) {
                swap_points(point, i++, j--);
            }
        }
        if (middle <= j) {
            high = j;
        } else if (middle >= i) {
            low = i;
        } else {
            break;
        }
    }
}

static int widest_axis(const length_node *node)
{
    int k = 0;
    for (int i = 1; i < 3; ++i) {
        k = node->high[i] - node->low[i] > node->high[k] - node->low[k] ? i : k;
    }
    return k;
}

static int32_t build(length_tree *tree, int32_t begin, int32_t end)
{
    CLAST_ASSERT(begin < end);
    const int32_t number = tree->n_node++;
    length_node *node = &tree->node[number];
    *node = (length_node){.begin = begin, .end = end};
    v3_copy(node->low, tree->point[begin]);
    v3_copy(node->high, tree->point[begin]);
    for (int32_t i = begin + 1; i < end; ++i) {
        for (int k = 0; k < 3; ++k) {
            node->low[k] = fmin(node->low[k], tree->point[i][k]);
            node->high[k] = fmax(node->high[k], tree->point[i][k]);
        }
    }
    if (end - begin > LEAF) {
        const int32_t middle = begin + (end - begin) / 2;
        select_middle(tree->point, begin, end, middle, widest_axis(node));
        (void)build(tree, begin, middle);
        node->right = build(tree, middle, end);
    }
    return number;
}

/// Square of the distance from p to the farthest corner of the node's box, rounded up.
static double reach2(const length_node *node, const double p[3])
{
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double d = fmax(p[k] - node->low[k], node->high[k] - p[k]);
        sum += d * d;
    }
    return sum * (1.0 + 1e-15);
}

/// Raises best2 by the points of this node; the farther child first.
static void search(length_tree *tree, int32_t number, const double p[3])
{
    const length_node *node = &tree->node[number];
    if (node->right == 0) {
        for (int32_t i = node->begin; i < node->end; ++i) {
            tree->best2 = fmax(tree->best2, v3_distance2(tree->point[i], p));
        }
        return;
    }
    const double first = reach2(&tree->node[number + 1], p);
    const double second = reach2(&tree->node[node->right], p);
    const int32_t child[2] = {first >= second ? number + 1 : node->right,
                              first >= second ? node->right : number + 1};
    if (fmax(first, second) > tree->best2) {
        search(tree, child[0], p);
    }
    if (fmin(first, second) > tree->best2) {
        search(tree, child[1], p);
    }
}

clast_status clast_mesh_length(const clast_mesh *mesh, double *length)
{
    CLX_ARGUMENTS(mesh, length);
    CLX_WHOLE(mesh, mesh);
    clast_status status = CLAST_OK;
    length_tree tree = {0};
    CLX_CHECK(mesh->n_vert > 0, CLAST_E_GEOMETRY, "length of a surface without vertices");
    CLX_TRY(clx_alloc(&tree.point, mesh->n_vert, sizeof *tree.point));
    CLX_TRY(clx_alloc(&tree.node, 2 * (int64_t)(mesh->n_vert / 4 + 1), sizeof *tree.node));
    memcpy(tree.point, mesh->vert, (size_t)mesh->n_vert * sizeof *tree.point);
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        CLX_CHECK(isfinite(v3_norm2(mesh->vert[i])), CLAST_E_GEOMETRY,
                  "vertex %d of %d is not finite (or beyond 1e154)", i, mesh->n_vert);
    }
    (void)build(&tree, 0, mesh->n_vert);
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        if (reach2(&tree.node[0], tree.point[i]) > tree.best2) {
            search(&tree, 0, tree.point[i]);
        }
    }
    *length = sqrt(tree.best2);
done:
    CLX_FREE(tree.point, tree.node);
    return status;
}
