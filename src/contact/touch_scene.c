// The growing tree of boxes, and the walk along a line through it.
#include "contact/touch_scene.h"

#include "base/alloc.h"
#include "geom/tree.h"
#include "math/vec3.h"

enum { MAX_DEPTH = 2 * CLX_TREE_DEPTH };

/// 64 bytes. A leaf has left < 0 and keeps its body's number in `right`.
typedef struct {
    double low[3];
    double high[3];
    int32_t left, right;
    int32_t parent;
    int32_t height; ///< edges of the longest path down
} scene_node;

struct clx_touch_scene {
    int32_t n;
    int32_t root;
    int32_t n_node;
    int32_t next_rebuild; ///< count at which the tree is built afresh
    int64_t body_room;
    int64_t node_room;
    clx_touch_body *body; ///< [n]
    scene_node *node;     ///< [n_node]
};

clast_status clx_touch_scene_create(clx_touch_scene **scene)
{
    const clast_status status = clx_alloc(scene, 1, sizeof **scene);
    if (status == CLAST_OK) {
        (*scene)->root = -1;
        (*scene)->next_rebuild = 64;
    }
    return status;
}

void clx_touch_scene_destroy(clx_touch_scene *scene)
{
    if (scene != NULL) {
        clx_free(scene->body);
        clx_free(scene->node);
        clx_free(scene);
    }
}

int32_t clx_touch_scene_count(const clx_touch_scene *scene)
{
    return scene->n;
}

const clx_touch_body *clx_touch_scene_body(const clx_touch_scene *scene, int32_t i)
{
    return &scene->body[i];
}

/// The body's box in the world, padded so that rounding never hides a touch.
static void box_of(const clx_touch_body *body, double low[3], double high[3])
{
    for (int k = 0; k < 3; ++k) {
        const double pad = 1e-12 * body->radius + 1e-15 * fabs(body->position[k]);
        low[k] = body->position[k] + body->low[k] - pad;
        high[k] = body->position[k] + body->high[k] + pad;
    }
}

static void unite(double low[3], double high[3], const scene_node *a, const scene_node *b)
{
    for (int k = 0; k < 3; ++k) {
        low[k] = a->low[k] < b->low[k] ? a->low[k] : b->low[k];
        high[k] = a->high[k] > b->high[k] ? a->high[k] : b->high[k];
    }
}

static double half_area(const double low[3], const double high[3])
{
    const double x = high[0] - low[0];
    const double y = high[1] - low[1];
    const double z = high[2] - low[2];
    return x * y + y * z + z * x;
}

static double area_with(const scene_node *node, const scene_node *leaf)
{
    double low[3];
    double high[3];
    unite(low, high, node, leaf);
    return half_area(low, high);
}

/// Cost of sending the leaf down to this child: the growth of its box, or a new pair's whole box.
static double descent_cost(const scene_node *child, const scene_node *leaf)
{
    const double grown = area_with(child, leaf);
    return child->left < 0 ? grown : grown - half_area(child->low, child->high);
}

/// The node beside which the leaf costs the least area, and how deep that is. [Catto2019]
static int32_t best_sibling(const clx_touch_scene *scene, const scene_node *leaf)
{
    int32_t at = scene->root;
    while (scene->node[at].left >= 0) {
        const scene_node *node = &scene->node[at];
        const double here = area_with(node, leaf);
        const double inherited = here - half_area(node->low, node->high);
        const double left = descent_cost(&scene->node[node->left], leaf) + inherited;
        const double right = descent_cost(&scene->node[node->right], leaf) + inherited;
        if (here < left && here < right) {
            break;
        }
        at = left <= right ? node->left : node->right;
    }
    return at;
}

/// Box and height of a node from its children.
static void refit(scene_node *nodes, int32_t i)
{
    const scene_node *left = &nodes[nodes[i].left];
    const scene_node *right = &nodes[nodes[i].right];
    unite(nodes[i].low, nodes[i].high, left, right);
    nodes[i].height = 1 + (left->height > right->height ? left->height : right->height);
}

/// Puts the new leaf beside `sibling` under a new parent and grows the boxes above.
static void attach(clx_touch_scene *scene, int32_t leaf, int32_t sibling)
{
    scene_node *nodes = scene->node;
    const int32_t parent = scene->n_node++;
    const int32_t above = nodes[sibling].parent;
    nodes[parent] = (scene_node){.left = sibling, .right = leaf, .parent = above};
    nodes[sibling].parent = parent;
    nodes[leaf].parent = parent;
    if (above < 0) {
        scene->root = parent;
    } else if (nodes[above].left == sibling) {
        nodes[above].left = parent;
    } else {
        nodes[above].right = parent;
    }
    for (int32_t i = parent; i >= 0; i = nodes[i].parent) {
        refit(nodes, i);
    }
}

/// Replaces the tree by one built at once over all bodies.
static clast_status rebuild(clx_touch_scene *scene)
{
    clast_status status = CLAST_OK;
    clx_tree tree = {0};
    clx_tree_box *box = NULL;
    CLX_TRY(clx_alloc(&box, scene->n, sizeof *box));
    for (int32_t i = 0; i < scene->n; ++i) {
        box_of(&scene->body[i], box[i].low, box[i].high);
        box[i].item = i;
    }
    CLX_TRY(clx_tree_build(box, scene->n, 1, &tree));
    scene->root = 0;
    scene->n_node = tree.n_node;
    for (int32_t i = tree.n_node - 1; i >= 0; --i) { // children come after their parents
        const clx_tree_node *from = &tree.node[i];
        scene_node *to = &scene->node[i];
        *to = (scene_node){.left = -1, .right = tree.item[from->first], .parent = -1};
        v3_copy(to->low, from->low);
        v3_copy(to->high, from->high);
        if (from->right != 0) {
            to->left = i + 1;
            to->right = from->right;
            scene->node[to->left].parent = i;
            scene->node[to->right].parent = i;
            refit(scene->node, i);
        }
    }
    scene->next_rebuild = 2 * scene->n;
done:
    clx_free(box);
    clx_tree_free(&tree);
    return status;
}

clast_status clx_touch_scene_insert(clx_touch_scene *scene, const clx_touch_body *body)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(scene->n < INT32_MAX / 2, CLAST_E_LIMIT, "more than %d bodies", INT32_MAX / 2);
    CLX_TRY(clx_grow(&scene->body, &scene->body_room, scene->n + 1, sizeof *scene->body));
    CLX_TRY(
        clx_grow(&scene->node, &scene->node_room, 2 * (int64_t)scene->n + 1, sizeof *scene->node));
    scene->body[scene->n] = *body;
    const int32_t leaf = scene->n_node;
    scene_node *node = &scene->node[leaf];
    *node = (scene_node){.left = -1, .right = scene->n, .parent = -1};
    box_of(body, node->low, node->high);
    ++scene->n_node;
    ++scene->n;
    if (scene->n == 1) {
        scene->root = leaf;
        goto done;
    }
    if (scene->node[scene->root].height + 1 < MAX_DEPTH && scene->n < scene->next_rebuild) {
        attach(scene, leaf, best_sibling(scene, node));
        goto done;
    }
    status = rebuild(scene);
    if (status != CLAST_OK) {
        --scene->n;
        --scene->n_node;
    }
done:
    return status;
}

/// The walk's constants: the body is a box that moves as p + t u.
typedef struct {
    double low[3]; ///< of the moving body's box at t = 0
    double high[3];
    double inverse[3]; ///< 1 / u
} swept_box;

static swept_box sweep(const clx_touch_body *moving, const clx_touch_path *path)
{
    swept_box box;
    box_of(moving, box.low, box.high);
    for (int k = 0; k < 3; ++k) {
        // A travel across an axis meets both planes at plus or minus a huge t, by their side.
        const double u = path->direction[k];
        box.inverse[k] = fabs(u) > 1e-200 ? 1.0 / u : 1e200;
    }
    return box;
}

/// When the swept box meets the node's box: [*enter, *leave].
static bool meets(const swept_box *box, const scene_node *node, double t_low, double t_high,
                  double *enter)
{
    double first = t_low;
    double last = t_high;
    for (int k = 0; k < 3; ++k) {
        const double a = (node->low[k] - box->high[k]) * box->inverse[k];
        const double b = (node->high[k] - box->low[k]) * box->inverse[k];
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
    const double reach = (moving->radius + lying->radius) * (1.0 + 1e-12);
    v3_sub(d, moving->position, lying->position);
    const double along = v3_dot(d, path->direction);
    const double under = reach * reach - (v3_norm2(d) - along * along);
    return under >= -1e-12 * v3_norm2(d) &&
           -along - sqrt(under > 0.0 ? under : 0.0) <= path->t_high + 1e-12 * fabs(along);
}

static void try_body(const clx_touch_scene *scene, int32_t i, const clx_touch_body *moving,
                     clx_touch_path *rest, clx_touch *best)
{
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

/// Pushes the children that the body meets, the nearer one last; the new top.
static int push_children(const clx_touch_scene *scene, const scene_node *node, const swept_box *box,
                         const clx_touch_path *rest, waiting *stack, int top)
{
    waiting left = {0.0, node->left};
    waiting right = {0.0, node->right};
    const double t_low = rest->t_low;
    const double t_high = rest->t_high;
    const bool in_left = meets(box, &scene->node[node->left], t_low, t_high, &left.enter);
    const bool in_right = meets(box, &scene->node[node->right], t_low, t_high, &right.enter);
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

bool clx_touch_scene_first(const clx_touch_scene *scene, const clx_touch_body *moving,
                           const clx_touch_path *path, clx_touch *touch)
{
    waiting stack[MAX_DEPTH + 1];
    int top = 0;
    const swept_box box = sweep(moving, path);
    clx_touch_path rest = *path; // t_high falls to the best touch so far
    clx_touch best = {.t = INFINITY, .body = -1};
    double enter = 0.0;
    if (scene->n > 0 && meets(&box, &scene->node[scene->root], rest.t_low, rest.t_high, &enter)) {
        stack[top++] = (waiting){enter, scene->root};
    }
    while (top > 0 && !best.beaten) {
        --top;
        if (stack[top].enter > rest.t_high) {
            continue;
        }
        const scene_node *node = &scene->node[stack[top].node];
        if (node->left < 0) {
            try_body(scene, node->right, moving, &rest, &best);
            continue;
        }
        top = push_children(scene, node, &box, &rest, stack, top);
    }
    if (best.body >= 0) {
        *touch = best;
    }
    return best.body >= 0;
}

static bool boxes_near(const double low[3], const double high[3], const scene_node *node)
{
    bool near = true;
    for (int k = 0; k < 3; ++k) {
        near = near && node->low[k] <= high[k] && low[k] <= node->high[k];
    }
    return near;
}

bool clx_touch_scene_near(const clx_touch_scene *scene, const clx_touch_body *body, double distance,
                          clx_touch_visit visit, void *context)
{
    int32_t stack[MAX_DEPTH + 1];
    int top = 0;
    double low[3];
    double high[3];
    box_of(body, low, high);
    for (int k = 0; k < 3; ++k) {
        low[k] -= distance;
        high[k] += distance;
    }
    if (scene->n > 0) {
        stack[top++] = scene->root;
    }
    while (top > 0) {
        const scene_node *node = &scene->node[stack[--top]];
        if (!boxes_near(low, high, node)) {
            continue;
        }
        if (node->left >= 0) {
            stack[top++] = node->right;
            stack[top++] = node->left;
        } else if (!visit(node->right, context)) {
            return false;
        }
    }
    return true;
}
