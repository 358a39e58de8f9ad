// Builds touch trees: two-way topology by surface-area heuristic (geom/tree.h), a ball and a slab
// per node, then every other level folded into its parent, so that a node has up to four children.
//
// The slab's normal is the direction in which a node's corners spread least; the ball's centre lies
// in the slab's middle plane and comes from Badoiu and Clarkson's iteration: towards the farthest
// corner by a shrinking step.                                                      [Badoiu2003]
#include "touch/tree.h"

#include "base/alloc.h"
#include "geom/union_find.h"
#include "math/sym3.h"
#include "math/vec3.h"
#include <string.h>

enum { BALL_STEPS = 24 };

/// A ball and a slab: one lane of a node to be.
typedef struct {
    double centre[3];
    double axis[3];
    double radius;
    double half;
} bound;

/// What is bounded: n points (with radii, or NULL).
typedef struct {
    const double *point; ///< [n] at `stride` doubles
    const double *radius;
    int32_t n;
    int stride;
} point_set;

static const double *at(const point_set *set, int32_t i)
{
    CLAST_ASSERT(i >= 0 && i < set->n);
    return set->point + (ptrdiff_t)i * set->stride;
}

static double radius_at(const point_set *set, int32_t i)
{
    return set->radius != NULL ? set->radius[(ptrdiff_t)i * set->stride] : 0.0;
}

/// Farthest item from `centre`, its far side's distance in *distance.
static int32_t farthest(const point_set *set, const double centre[3], double *distance)
{
    int32_t best = 0;
    double most = -1.0;
    if (set->radius == NULL) {
        for (int32_t i = 0; i < set->n; ++i) {
            const double d2 = v3_distance2(centre, at(set, i));
            best = d2 > most ? i : best;
            most = d2 > most ? d2 : most;
        }
        *distance = sqrt(most);
        return best;
    }
    for (int32_t i = 0; i < set->n; ++i) {
        const double d = v3_distance(centre, at(set, i)) + radius_at(set, i);
        best = d > most ? i : best;
        most = d > most ? d : most;
    }
    *distance = most;
    return best;
}

/// Improves a ball's centre, moving it only across `axis` (0 for any direction).
static void shrink_ball(const point_set *set, const double axis[3], bound *node)
{
    double centre[3];
    v3_copy(centre, node->centre);
    int32_t far = farthest(set, centre, &node->radius);
    double distance = node->radius;
    for (int step = 1; step <= BALL_STEPS; ++step) {
        double towards[3];
        v3_sub(towards, at(set, far), centre);
        v3_axpy(towards, towards, -v3_dot(towards, axis), axis);
        const double length = v3_norm(towards);
        if (!(length > 0.0)) {
            break;
        }
        v3_axpy(centre, centre, distance / (length * (1.0 + step)), towards);
        far = farthest(set, centre, &distance);
        if (distance < node->radius) {
            node->radius = distance;
            v3_copy(node->centre, centre);
        }
    }
}

/// Direction in which the points spread least, from their covariance.
static void thin_direction(const point_set *set, double axis[3])
{
    double mean[3] = {0.0, 0.0, 0.0};
    double spread[3][3] = {{0.0}};
    double value[3];
    double vector[3][3];
    for (int32_t i = 0; i < set->n; ++i) {
        v3_add(mean, mean, at(set, i));
    }
    v3_scale(mean, 1.0 / set->n, mean);
    for (int32_t i = 0; i < set->n; ++i) {
        double d[3];
        v3_sub(d, at(set, i), mean);
        for (int j = 0; j < 3; ++j) {
            v3_axpy(spread[j], spread[j], d[j], d);
        }
    }
    clx_sym3_eigen(spread, value, vector);
    v3_copy(axis, vector[2]);
}

/// Ball and slab about points.
static void bound_points(const point_set *set, bound *node)
{
    CLAST_ASSERT(set->n > 0);
    double low = INFINITY;
    double high = -INFINITY;
    double box_low[3] = {INFINITY, INFINITY, INFINITY};
    double box_high[3] = {-INFINITY, -INFINITY, -INFINITY};
    thin_direction(set, node->axis);
    for (int32_t i = 0; i < set->n; ++i) {
        const double *p = at(set, i);
        const double s = v3_dot(node->axis, p);
        low = s < low ? s : low;
        high = s > high ? s : high;
        for (int k = 0; k < 3; ++k) {
            box_low[k] = p[k] < box_low[k] ? p[k] : box_low[k];
            box_high[k] = p[k] > box_high[k] ? p[k] : box_high[k];
        }
    }
    v3_add(node->centre, box_low, box_high);
    v3_scale(node->centre, 0.5, node->centre);
    v3_axpy(node->centre, node->centre, 0.5 * (low + high) - v3_dot(node->axis, node->centre),
            node->axis);
    shrink_ball(set, node->axis, node);
    node->half = 0.0;
    for (int32_t i = 0; i < set->n; ++i) {
        double d[3];
        v3_sub(d, at(set, i), node->centre);
        node->half = fmax(node->half, fabs(v3_dot(node->axis, d)));
    }
    node->half = fmin(node->half, node->radius);
}

/// Ball about balls; no slab.
static void bound_balls(const point_set *set, bound *node)
{
    CLAST_ASSERT(set->n > 0 && set->radius != NULL);
    const double free[3] = {0.0, 0.0, 0.0};
    v3_set(node->axis, 0.0, 0.0, 1.0);
    v3_set(node->centre, 0.0, 0.0, 0.0);
    for (int32_t i = 0; i < set->n; ++i) {
        v3_axpy(node->centre, node->centre, 1.0 / set->n, at(set, i));
    }
    if (set->n == 1) {
        v3_copy(node->centre, at(set, 0));
        node->radius = radius_at(set, 0);
    } else {
        shrink_ball(set, free, node);
    }
    node->half = node->radius;
}

static void bound_node(const clx_touch_tree *tree, const clx_tree_node *from, bound *node)
{
    if (tree->kind == CLX_TOUCH_MESH) {
        const point_set set = {tree->corner[from->first], NULL, 3 * from->count, 3};
        bound_points(&set, node);
    } else {
        const double *first = tree->ball[from->first];
        const point_set set = {first, first + 3, from->count, 4};
        bound_balls(&set, node);
    }
}

/// A node with no lane in use: their centres are no numbers, so that they overlap nothing.
static int32_t new_node(clx_touch_tree *tree)
{
    clx_touch_node *node = &tree->node[tree->n_node];
    for (int32_t i = 0; i < 3 * CLX_TOUCH_LANES; ++i) {
        node->centre[i / CLX_TOUCH_LANES][i % CLX_TOUCH_LANES] = NAN;
    }
    return tree->n_node++;
}

/// Puts a bound into the next lane of a node.
static void add_lane(clx_touch_node *node, const bound *b)
{
    CLAST_ASSERT(node->n >= 0 && node->n < CLX_TOUCH_LANES);
    const int32_t lane = node->n++;
    for (int k = 0; k < 3; ++k) {
        node->centre[k][lane] = b->centre[k];
        node->axis[k][lane] = b->axis[k];
    }
    node->radius[lane] = b->radius;
    node->half[lane] = b->half;
    node->rim[lane] = sqrt(fmax(0.0, b->radius * b->radius - b->half * b->half));
}

/// The two-way nodes that become the lanes of the node over `parent`: its children, of which the
/// greatest are replaced by theirs while there is room.
static int32_t choose_lanes(const clx_tree *from, const bound *bounds, int32_t parent,
                            int32_t lane[CLX_TOUCH_LANES])
{
    int32_t n = 2;
    lane[0] = parent + 1;
    lane[1] = from->node[parent].right;
    while (n < CLX_TOUCH_LANES) {
        int32_t best = -1;
        for (int32_t i = 0; i < n; ++i) {
            if (from->node[lane[i]].right != 0 &&
                (best < 0 || bounds[lane[i]].radius > bounds[lane[best]].radius)) {
                best = i;
            }
        }
        if (best < 0) {
            break;
        }
        const int32_t opened = lane[best];
        lane[best] = opened + 1;
        lane[n++] = from->node[opened].right;
    }
    return n;
}

/// Writes the nodes over two-way node `parent` and below; what a lane that holds it has as child.
static int32_t fold(clx_touch_tree *tree, const clx_tree *from, const bound *bounds, int32_t parent)
{
    CLAST_ASSERT(parent >= 0 && parent < from->n_node);
    int32_t lane[CLX_TOUCH_LANES];
    if (from->node[parent].right == 0) {
        return -from->node[parent].first;
    }
    const int32_t self = new_node(tree);
    const int32_t n = choose_lanes(from, bounds, parent, lane);
    for (int32_t i = 0; i < n; ++i) {
        add_lane(&tree->node[self], &bounds[lane[i]]);
        tree->node[self].child[i] = fold(tree, from, bounds, lane[i]);
    }
    return self;
}

/// Nodes, box and radius of a tree whose items are known in input order as boxes; `box` is used up.
static clast_status finish(clx_touch_tree *tree, clx_tree_box *box, const double *item, int n_value)
{
    clast_status status = CLAST_OK;
    clx_tree nodes = {0};
    bound *bounds = NULL;
    double *sorted = tree->kind == CLX_TOUCH_MESH ? tree->corner[0] : tree->ball[0];
    CLX_TRY(clx_tree_build(box, tree->n_item, 1, &nodes));
    CLX_TRY(clx_alloc(&bounds, nodes.n_node, sizeof *bounds));
    CLX_TRY(clx_alloc(&tree->node, (int64_t)tree->n_item + 1, sizeof *tree->node));
    for (int32_t i = 0; i < tree->n_item; ++i) {
        memcpy(sorted + (ptrdiff_t)i * n_value, item + (ptrdiff_t)nodes.item[i] * n_value,
               (size_t)n_value * sizeof *item);
    }
    for (int32_t i = 0; i < nodes.n_node; ++i) {
        bound_node(tree, &nodes.node[i], &bounds[i]);
    }
    (void)new_node(tree);
    add_lane(&tree->node[0], &bounds[0]);
    tree->node[0].child[0] = fold(tree, &nodes, bounds, 0);
    CLX_TRY(clx_realloc(&tree->node, tree->n_node, sizeof *tree->node));
    v3_copy(tree->low, nodes.node[0].low);
    v3_copy(tree->high, nodes.node[0].high);
done:
    clx_free(bounds);
    clx_tree_free(&nodes);
    return status;
}

static clast_status check_mesh(const clast_mesh *mesh)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(mesh->n_tri >= 1, CLAST_E_GEOMETRY, "a surface without triangles cannot be touched");
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        CLX_CHECK(isfinite(v3_norm2(mesh->vert[i])), CLAST_E_GEOMETRY,
                  "vertex %d of %d is not finite", i, mesh->n_vert);
    }
    for (int32_t i = 0; i < mesh->n_tri; ++i) {
        for (int k = 0; k < 3; ++k) {
            CLX_CHECK(mesh->tri[i][k] >= 0 && mesh->tri[i][k] < mesh->n_vert, CLAST_E_GEOMETRY,
                      "triangle %d names vertex %d of %d", i, mesh->tri[i][k], mesh->n_vert);
        }
    }
done:
    return status;
}

static void grow_box(clx_tree_box *box, const double point[3], double radius)
{
    for (int k = 0; k < 3; ++k) {
        box->low[k] = fmin(box->low[k], point[k] - radius);
        box->high[k] = fmax(box->high[k], point[k] + radius);
    }
}

static clx_tree_box empty_box(int32_t item)
{
    return (clx_tree_box){.low = {INFINITY, INFINITY, INFINITY},
                          .high = {-INFINITY, -INFINITY, -INFINITY},
                          .item = item};
}

/// One vertex of every part of the surface that hangs together by shared vertices.
static clast_status find_parts(const clast_mesh *mesh, clx_touch_tree *tree)
{
    clast_status status = CLAST_OK;
    int32_t *above = NULL; // towards the part's first vertex; -1: in no triangle
    CLX_TRY(clx_alloc(&above, mesh->n_vert, sizeof *above));
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        above[i] = -1;
    }
    for (int32_t i = 0; i < 3 * mesh->n_tri; ++i) {
        const int32_t v = mesh->tri[i / 3][i % 3];
        above[v] = v;
    }
    for (int32_t i = 0; i < 3 * mesh->n_tri; ++i) {
        clx_sets_join(above, mesh->tri[i / 3][0], mesh->tri[i / 3][i % 3]);
    }
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        tree->n_probe += above[i] == i;
    }
    CLX_TRY(clx_alloc(&tree->probe, tree->n_probe, sizeof *tree->probe));
    int32_t n = 0;
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        if (above[i] == i) {
            v3_copy(tree->probe[n++], mesh->vert[i]);
        }
    }
done:
    clx_free(above);
    return status;
}

/// Corners and boxes of the triangles in input order; the greatest distance from the origin.
static double gather_triangles(const clast_mesh *mesh, double (*corner)[9], clx_tree_box *box)
{
    double radius = 0.0;
    for (int32_t i = 0; i < mesh->n_tri; ++i) {
        box[i] = empty_box(i);
        for (int k = 0; k < 3; ++k) {
            const double *v = mesh->vert[mesh->tri[i][k]];
            v3_copy(corner[i] + (ptrdiff_t)3 * k, v);
            grow_box(&box[i], v, 0.0);
            radius = fmax(radius, v3_norm(v));
        }
    }
    return radius;
}

clast_status clx_touch_tree_mesh(const clast_mesh *mesh, clx_touch_tree **tree)
{
    clast_status status = CLAST_OK;
    clx_touch_tree *made = NULL;
    clx_tree_box *box = NULL;
    double(*corner)[9] = NULL;
    CLX_TRY(check_mesh(mesh));
    CLX_TRY(clx_alloc(&made, 1, sizeof *made));
    made->kind = CLX_TOUCH_MESH;
    made->n_item = mesh->n_tri;
    CLX_TRY(clx_alloc(&made->corner, mesh->n_tri, sizeof *made->corner));
    CLX_TRY(clx_alloc(&corner, mesh->n_tri, sizeof *corner));
    CLX_TRY(clx_alloc(&box, mesh->n_tri, sizeof *box));
    made->radius = gather_triangles(mesh, corner, box);
    CLX_TRY(find_parts(mesh, made));
    CLX_TRY(finish(made, box, corner[0], 9));
    *tree = made;
    made = NULL;
done:
    CLX_FREE(box, corner);
    clx_touch_tree_destroy(made);
    return status;
}

static clast_status check_spheres(int32_t n, double (*centre)[3], const double *radius)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(n >= 1, CLAST_E_GEOMETRY, "a composite of %d spheres; it needs at least one", n);
    for (int32_t i = 0; i < n; ++i) {
        CLX_CHECK(isfinite(v3_norm(centre[i]) + radius[i]) && radius[i] > 0.0, CLAST_E_GEOMETRY,
                  "sphere %d of %d is not finite or has radius %g", i, n, radius[i]);
    }
done:
    return status;
}

clast_status clx_touch_tree_spheres(int32_t n, double (*centre)[3], const double *radius,
                                    clx_touch_tree **tree)
{
    clast_status status = CLAST_OK;
    clx_touch_tree *made = NULL;
    clx_tree_box *box = NULL;
    double(*ball)[4] = NULL;
    CLX_TRY(check_spheres(n, centre, radius));
    CLX_TRY(clx_alloc(&made, 1, sizeof *made));
    made->kind = CLX_TOUCH_SPHERES;
    made->n_item = n;
    made->n_probe = n;
    CLX_TRY(clx_alloc(&made->probe, n, sizeof *made->probe));
    CLX_TRY(clx_alloc(&made->ball, n, sizeof *made->ball));
    CLX_TRY(clx_alloc(&ball, n, sizeof *ball));
    CLX_TRY(clx_alloc(&box, n, sizeof *box));
    for (int32_t i = 0; i < n; ++i) {
        box[i] = empty_box(i);
        grow_box(&box[i], centre[i], radius[i]);
        v3_copy(made->probe[i], centre[i]);
        v3_copy(ball[i], centre[i]);
        ball[i][3] = radius[i];
        made->radius = fmax(made->radius, v3_norm(centre[i]) + radius[i]);
    }
    CLX_TRY(finish(made, box, ball[0], 4));
    *tree = made;
    made = NULL;
done:
    CLX_FREE(box, ball);
    clx_touch_tree_destroy(made);
    return status;
}

void clx_touch_tree_destroy(clx_touch_tree *tree)
{
    if (tree != NULL) {
        CLX_FREE(tree->node, tree->corner, tree->ball, tree->probe, tree);
    }
}
