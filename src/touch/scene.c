// The growing tree of boxes, and the walk along a line through it.
//
// A walk through many bodies waits for memory, not for arithmetic: the two children of a node lie
// side by side in one cache line of 64 bytes, their boxes in single precision, rounded outwards.
// With a node of 64 bytes per child, somewhere in memory, a particle among 1e5 cost 1.7 times as
// much by log n as one among 1e3.
#include "touch/scene.h"

#include "base/alloc.h"
#include "geom/tree.h"
#include "math/vec3.h"
#include "touch/body.h"
#include <string.h>

// Bodies that join one by one spoil the tree: a walk among 1e5 spheres opened 31 nodes where the
// tree was built at each doubling, 23 at each quarter more, 21 (the growth of log n since 1e4) at
// each sixteenth. A build costs about a walk a body, so it pays where many walks go by to each
// body that joins.
enum { MAX_DEPTH = 2 * CLX_TREE_DEPTH, LINE = 64, WALKS_A_SHARE = 6, MOST_SHARE = 16 };

/// 32 bytes. Children of node i are `child` and child + 1; a leaf has child 0 and a body.
typedef struct {
    float low[3];
    float high[3];
    int32_t child;
    int32_t body;
} scene_node;

struct clx_touch_scene {
    int32_t n;
    int32_t n_node;
    int32_t next_rebuild; ///< count at which the tree is built afresh
    int32_t share;        ///< bodies in the tree for each that may join before that
    double origin[3];     ///< of the boxes: the first body, so that single precision is enough
    int64_t body_capacity;
    int64_t node_capacity;
    clx_touch_body *body; ///< [n]
    void *block;          ///< what `node` lies in, at the first whole line
    scene_node *node;     ///< [n_node] the root is 0, 1 is unused, pairs from 2 on
};

clast_status clx_touch_scene_create(clx_touch_scene **scene)
{
    const clast_status status = clx_alloc(scene, 1, sizeof **scene);
    if (status == CLAST_OK) {
        (*scene)->next_rebuild = 64;
        (*scene)->share = 1;
    }
    return status;
}

void clx_touch_scene_expect(clx_touch_scene *scene, int64_t n_walk)
{
    const int64_t share = n_walk / WALKS_A_SHARE;
    scene->share = share < 1 ? 1 : share > MOST_SHARE ? MOST_SHARE : (int32_t)share;
}

void clx_touch_scene_destroy(clx_touch_scene *scene)
{
    if (scene != NULL) {
        CLX_FREE(scene->body, scene->block, scene);
    }
}

int32_t clx_touch_scene_count(const clx_touch_scene *scene)
{
    return scene->n;
}

const clx_touch_body *clx_touch_scene_body(const clx_touch_scene *scene, int32_t i)
{
    CLAST_ASSERT(i >= 0 && i < scene->n);
    return &scene->body[i];
}

/// The body's box from the scene's origin, padded so that rounding never hides a touch.
static void box_of(const clx_touch_scene *scene, const clx_touch_body *body, double low[3],
                   double high[3])
{
    CLAST_ASSERT(body->radius >= 0.0);
    for (int k = 0; k < 3; ++k) {
        const double x = body->position[k] - scene->origin[k];
        const double pad =
            1e-12 * body->radius + 1e-15 * (fabs(body->position[k]) + fabs(scene->origin[k]));
        low[k] = x + body->low[k] - pad;
        high[k] = x + body->high[k] + pad;
    }
}

/// The next float below and above, so that a rounded box holds the true one.
static float float_below(double x)
{
    const float f = (float)x;
    return (double)f <= x ? f : nextafterf(f, -INFINITY);
}

static float float_above(double x)
{
    const float f = (float)x;
    return (double)f >= x ? f : nextafterf(f, INFINITY);
}

static scene_node leaf_of(const clx_touch_scene *scene, const clx_touch_body *body, int32_t number)
{
    double low[3];
    double high[3];
    scene_node leaf = {.body = number};
    box_of(scene, body, low, high);
    for (int k = 0; k < 3; ++k) {
        leaf.low[k] = float_below(low[k]);
        leaf.high[k] = float_above(high[k]);
    }
    return leaf;
}

static void extend(scene_node *node, const scene_node *by)
{
    for (int k = 0; k < 3; ++k) {
        node->low[k] = by->low[k] < node->low[k] ? by->low[k] : node->low[k];
        node->high[k] = by->high[k] > node->high[k] ? by->high[k] : node->high[k];
    }
}

static double half_area(const scene_node *node)
{
    const double x = (double)node->high[0] - (double)node->low[0];
    const double y = (double)node->high[1] - (double)node->low[1];
    const double z = (double)node->high[2] - (double)node->low[2];
    return x * y + y * z + z * x;
}

static double area_with(const scene_node *node, const scene_node *leaf)
{
    scene_node both = *node;
    extend(&both, leaf);
    return half_area(&both);
}

/// Cost of sending the leaf down to this child: the growth of its box, or a new pair's whole box.
static double descent_cost(const scene_node *child, const scene_node *leaf)
{
    const double grown = area_with(child, leaf);
    return child->child == 0 ? grown : grown - half_area(child);
}

/// Room for n nodes at the start of a cache line.
static clast_status reserve_nodes(clx_touch_scene *scene, int64_t n)
{
    clast_status status = CLAST_OK;
    char *block = NULL;
    if (n <= scene->node_capacity) {
        return CLAST_OK;
    }
    const int64_t capacity = n + n / 2 + 16;
    CLX_TRY(clx_alloc(&block, capacity * (int64_t)sizeof(scene_node) + LINE, 1));
    scene_node *node = (scene_node *)(block + (LINE - (uintptr_t)block % LINE) % LINE);
    if (scene->n_node > 0) {
        memcpy(node, scene->node, (size_t)scene->n_node * sizeof *node);
    }
    clx_free(scene->block);
    scene->block = block;
    scene->node = node;
    scene->node_capacity = capacity;
done:
    return status;
}

/// Sends a leaf down to where it costs the least area [Catto2019], every box on its way grown, and
/// makes a pair of it and the node it comes to. False, and nothing done, where that lies too deep.
static bool attach(clx_touch_scene *scene, const scene_node *leaf)
{
    CLAST_ASSERT(leaf->body >= 0 && leaf->body <= scene->n);
    scene_node *nodes = scene->node;
    int32_t way[MAX_DEPTH];
    int depth = 0;
    int32_t at = 0;
    while (nodes[at].child != 0) {
        const scene_node *node = &nodes[at];
        const double here = area_with(node, leaf);
        const double inherited = here - half_area(node);
        const double left = descent_cost(&nodes[node->child], leaf) + inherited;
        const double right = descent_cost(&nodes[node->child + 1], leaf) + inherited;
        if (here < left && here < right) {
            break;
        }
        if (depth + 2 >= MAX_DEPTH) {
            return false;
        }
        way[depth++] = at;
        at = left <= right ? node->child : node->child + 1;
    }
    const int32_t pair = scene->n_node;
    scene->n_node += 2;
    nodes[pair] = nodes[at];
    nodes[pair + 1] = *leaf;
    nodes[at].child = pair;
    nodes[at].body = -1;
    extend(&nodes[at], leaf);
    for (int i = 0; i < depth; ++i) {
        extend(&nodes[way[i]], leaf);
    }
    return true;
}

/// Node `to` and all below it as the built tree has them from `from` on.
static void copy_node(clx_touch_scene *scene, const clx_tree *tree, int32_t from, int32_t to)
{
    CLAST_ASSERT(to >= 0 && to < scene->node_capacity);
    const clx_tree_node *source = &tree->node[from];
    scene_node *node = &scene->node[to];
    if (source->right == 0) {
        const int32_t body = tree->item[source->first];
        *node = leaf_of(scene, &scene->body[body], body);
        return;
    }
    const int32_t pair = scene->n_node;
    scene->n_node += 2;
    copy_node(scene, tree, from + 1, pair);
    copy_node(scene, tree, source->right, pair + 1);
    *node = scene->node[pair];
    extend(node, &scene->node[pair + 1]);
    node->child = pair;
    node->body = -1;
}

/// Replaces the tree by one built at once over all bodies.
static clast_status rebuild(clx_touch_scene *scene)
{
    clast_status status = CLAST_OK;
    clx_tree tree = {0};
    clx_tree_box *box = NULL;
    CLX_TRY(clx_alloc(&box, scene->n, sizeof *box));
    for (int32_t i = 0; i < scene->n; ++i) {
        box_of(scene, &scene->body[i], box[i].low, box[i].high);
        box[i].item = i;
    }
    CLX_TRY(clx_tree_build(box, scene->n, 1, &tree));
    scene->n_node = 2;
    copy_node(scene, &tree, 0, 0);
    scene->next_rebuild = scene->n + scene->n / scene->share;
done:
    clx_free(box);
    clx_tree_free(&tree);
    return status;
}

clast_status clx_touch_scene_insert(clx_touch_scene *scene, const clx_touch_body *body)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(scene->n < INT32_MAX / 2 - 1, CLAST_E_LIMIT, "more than %d bodies", INT32_MAX / 2);
    CLX_TRY(clx_grow(&scene->body, &scene->body_capacity, scene->n + 1, sizeof *scene->body));
    CLX_TRY(reserve_nodes(scene, 2 * (int64_t)scene->n + 2));
    scene->body[scene->n] = *body;
    if (scene->n == 0) {
        v3_copy(scene->origin, body->position);
    }
    const scene_node leaf = leaf_of(scene, body, scene->n);
    ++scene->n;
    if (scene->n == 1) {
        scene->node[0] = leaf;
        scene->n_node = 2;
        goto done;
    }
    if (scene->n < scene->next_rebuild && attach(scene, &leaf)) {
        goto done;
    }
    status = rebuild(scene);
    scene->n -= status != CLAST_OK;
done:
    return status;
}

/// The walk's constants: the body is a box that moves as p + t u.
typedef struct {
    double low[3]; ///< of the moving body's box at t = 0
    double high[3];
    double inverse[3]; ///< 1 / u
} swept_box;

static swept_box sweep(const clx_touch_scene *scene, const clx_touch_body *moving,
                       const clx_touch_path *path)
{
    swept_box box;
    box_of(scene, moving, box.low, box.high);
    for (int k = 0; k < 3; ++k) {
        // A travel across an axis passes both planes at plus or minus a huge t, by their side.
        const double u = path->direction[k];
        box.inverse[k] = fabs(u) > 1e-200 ? 1.0 / u : 1e200;
    }
    return box;
}

/// When the swept box intersects the node's box: [*enter, *leave].
static bool intersects(const swept_box *box, const scene_node *node, double t_low, double t_high,
                       double *enter)
{
    double first = t_low;
    double last = t_high;
    for (int k = 0; k < 3; ++k) {
        const double a = ((double)node->low[k] - box->high[k]) * box->inverse[k];
        const double b = ((double)node->high[k] - box->low[k]) * box->inverse[k];
        const double near = a < b ? a : b;
        const double far = a < b ? b : a;
        first = near > first ? near : first;
        last = far < last ? far : last;
    }
    *enter = first;
    return first <= last;
}

/// Earliest t at which the bounding spheres could touch, to skip bodies that come too late.
static bool may_touch(const clx_touch_body *moving, const clx_touch_body *lying,
                      const clx_touch_path *path)
{
    double d[3];
    const double radius_sum = (moving->radius + lying->radius) * (1.0 + 1e-12);
    v3_sub(d, moving->position, lying->position);
    const double along = v3_dot(d, path->direction);
    const double under = radius_sum * radius_sum - (v3_norm2(d) - along * along);
    return under >= -1e-12 * v3_norm2(d) &&
           -along - sqrt(under > 0.0 ? under : 0.0) <= path->t_high + 1e-12 * fabs(along);
}

static void try_body(const clx_touch_scene *scene, int32_t i, const clx_touch_body *moving,
                     clx_touch_path *rest, clx_touch *best)
{
    CLAST_ASSERT(i >= 0 && i < scene->n);
    clx_touch touch;
    if (may_touch(moving, &scene->body[i], rest) &&
        clx_first_touch(moving, &scene->body[i], rest, &touch) &&
        (touch.t < best->t || (touch.t == best->t && i < best->body))) {
        *best = touch;
        best->body = i;
        rest->t_high = touch.t;
    }
}

/// A node that waits for its visit.
typedef struct {
    double enter;
    int32_t node;
} waiting;

/// Pushes the children whose boxes the swept box intersects, the nearer one last; the new top.
static int push_children(const clx_touch_scene *scene, const scene_node *node, const swept_box *box,
                         const clx_touch_path *rest, waiting *stack, int top)
{
    waiting left = {0.0, node->child};
    waiting right = {0.0, node->child + 1};
    const double t_low = rest->t_low;
    const double t_high = rest->t_high;
    const bool in_left = intersects(box, &scene->node[left.node], t_low, t_high, &left.enter);
    const bool in_right = intersects(box, &scene->node[right.node], t_low, t_high, &right.enter);
    const bool left_first = left.enter <= right.enter;
    if (in_left && !left_first) {
        stack[top++] = left;
    }
    if (in_right) {
        stack[top++] = right;
    }
    if (in_left && left_first) {
        stack[top++] = left;
    }
    return top;
}

bool clx_touch_scene_first_among(const clx_touch_scene *scene, int32_t n,
                                 const clx_touch_body *moving, const clx_touch_path *path,
                                 clx_touch *touch)
{
    CLAST_ASSERT(n >= 0 && n <= scene->n);
    waiting stack[MAX_DEPTH + 1];
    int top = 0;
    const swept_box box = sweep(scene, moving, path);
    clx_touch_path rest = *path; // t_high falls to the best touch so far
    clx_touch best = {.t = INFINITY, .body = -1};
    double enter = 0.0;
    if (scene->n > 0 && intersects(&box, &scene->node[0], rest.t_low, rest.t_high, &enter)) {
        stack[top++] = (waiting){enter, 0};
    }
    while (top > 0 && !best.beaten) {
        --top;
        if (stack[top].enter > rest.t_high) {
            continue;
        }
        const scene_node *node = &scene->node[stack[top].node];
        if (node->child == 0) {
            if (node->body < n) {
                try_body(scene, node->body, moving, &rest, &best);
            }
            continue;
        }
        top = push_children(scene, node, &box, &rest, stack, top);
    }
    if (best.body >= 0) {
        *touch = best;
    }
    return best.body >= 0;
}

bool clx_touch_scene_first(const clx_touch_scene *scene, const clx_touch_body *moving,
                           const clx_touch_path *path, clx_touch *touch)
{
    return clx_touch_scene_first_among(scene, scene->n, moving, path, touch);
}

static bool boxes_near(const double low[3], const double high[3], const scene_node *node)
{
    bool near = true;
    for (int k = 0; k < 3; ++k) {
        near = near && (double)node->low[k] <= high[k] && low[k] <= (double)node->high[k];
    }
    return near;
}

bool clx_touch_scene_near(const clx_touch_scene *scene, const clx_touch_body *body, double distance,
                          clx_touch_visit visit, void *context)
{
    CLAST_ASSERT(distance >= 0.0);
    int32_t stack[MAX_DEPTH + 1];
    int top = 0;
    double low[3];
    double high[3];
    box_of(scene, body, low, high);
    for (int k = 0; k < 3; ++k) {
        low[k] -= distance;
        high[k] += distance;
    }
    if (scene->n > 0) {
        stack[top++] = 0;
    }
    while (top > 0) {
        const scene_node *node = &scene->node[stack[--top]];
        if (!boxes_near(low, high, node)) {
            continue;
        }
        if (node->child != 0) {
            stack[top++] = node->child + 1;
            stack[top++] = node->child;
        } else if (!visit(node->body, context)) {
            return false;
        }
    }
    return true;
}

/// Distance of a point from a box, 0 inside.
static double box_distance(const scene_node *node, const double x[3])
{
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double below = (double)node->low[k] - x[k];
        const double above = x[k] - (double)node->high[k];
        const double d = below > above ? below : above;
        sum += d > 0.0 ? d * d : 0.0;
    }
    return sqrt(sum);
}

/// A body lies within its box and within its bounding sphere: the greater distance still holds.
static double leaf_distance(const clx_touch_scene *scene, const scene_node *leaf, const double x[3],
                            const double world[3])
{
    const clx_touch_body *body = &scene->body[leaf->body];
    const double d = v3_distance(world, body->position) - body->radius;
    const double b = box_distance(leaf, x);
    return d > b ? d : b;
}

double clx_touch_scene_clearance(const clx_touch_scene *scene, const double x[3], double limit)
{
    CLAST_ASSERT(v3_is_finite(x));
    waiting stack[MAX_DEPTH + 1];
    int top = 0;
    double local[3];
    double least = limit;
    v3_sub(local, x, scene->origin);
    if (scene->n > 0) {
        stack[top++] = (waiting){box_distance(&scene->node[0], local), 0};
    }
    while (top > 0) {
        --top;
        const scene_node *node = &scene->node[stack[top].node];
        if (stack[top].enter >= least) {
            continue;
        }
        if (node->child == 0) {
            const double d = leaf_distance(scene, node, local, x);
            least = d < least ? d : least;
            continue;
        }
        waiting near = {box_distance(&scene->node[node->child], local), node->child};
        waiting far = {box_distance(&scene->node[node->child + 1], local), node->child + 1};
        const waiting swap = near;
        if (far.enter < near.enter) {
            near = far;
            far = swap;
        }
        stack[top++] = far;
        stack[top++] = near;
    }
    return least;
}
