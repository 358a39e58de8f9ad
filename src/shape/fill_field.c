// Distance to the surface, made for a filling's tens of thousands of questions.
//
// The binary tree of the mesh's clast_bvh is folded into nodes of four children whose boxes stand
// side by side in floats (rounded outwards, in a frame scaled to the surface), so that one pass of
// vector instructions measures all four; triangles are dropped in fours by their bounding spheres
// in the same way. What survives gets the point-triangle distance of Ericson in double. A quarter
// of the time of clast_bvh_closest on scans. On slivers the region tests may pick a point that is
// not quite the closest, so clast_fill checks each accepted sphere by clast_bvh_closest.
//                                                            [Ericson2005 sec. 5.1.5, Wald2008]
#include "shape/fill_field.h"

#include "base/alloc.h"
#include "math/vec3.h"

// A float coordinate of the frame is off by at most 2^-24 of a number below 1; three of them, and
// the rounding of the distance itself, stay below this share of the frame's unit for points as far
// as the surface's size from it.
static const double FRAME_ERROR = 1e-6;

void clx_fill_field_free(clx_fill_field *field)
{
    clx_free(field->node);
    clx_free(field->leaf);
    clx_free(field->tri);
    clx_free(field->size);
    *field = (clx_fill_field){0};
}

/// Sphere about the centroid, or about the middle of an edge when that is smaller: within 16 % of
/// the least one.
static void bounding_sphere(double corner[3][3], double centre[3], double *radius)
{
    double far2 = 0.0;
    for (int k = 0; k < 3; ++k) {
        centre[k] = (corner[0][k] + corner[1][k] + corner[2][k]) / 3.0;
    }
    for (int i = 0; i < 3; ++i) {
        far2 = fmax(far2, v3_distance2(centre, corner[i]));
    }
    for (int i = 0; i < 3; ++i) {
        double middle[3];
        v3_add(middle, corner[i], corner[(i + 1) % 3]);
        v3_scale(middle, 0.5, middle);
        const double r2 =
            fmax(v3_distance2(middle, corner[i]), v3_distance2(middle, corner[(i + 2) % 3]));
        if (r2 < far2) {
            far2 = r2;
            v3_copy(centre, middle);
        }
    }
    *radius = sqrt(far2);
}

static clast_status add_leaf(const clast_bvh *bvh, int32_t first, int32_t count,
                             clx_fill_field *field, int32_t *child)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_grow(&field->leaf, &field->leaf_capacity, field->n_leaf + 1, sizeof *field->leaf));
    clx_fill_leaf *leaf = &field->leaf[field->n_leaf];
    leaf->first = first;
    for (int32_t i = 0; i < 4; ++i) {
        double centre[3] = {INFINITY, INFINITY, INFINITY};
        double radius = 0.0;
        if (i < count) {
            bounding_sphere(bvh->corner[first + i], centre, &radius);
            field->size[first + i] = radius;
            v3_sub(centre, centre, field->middle);
        }
        for (int k = 0; k < 3; ++k) {
            leaf->centre[k][i] = (float)(centre[k] * field->scale);
        }
        leaf->radius[i] = (float)(radius * field->scale);
    }
    *child = (int32_t)(-1 - field->n_leaf++);
done:
    return status;
}

/// Part of the tree that becomes one child: a node, or some triangles of a leaf.
typedef struct {
    const clx_tree_node *node;
    int32_t first, count; ///< triangles
    bool whole;           ///< all of node
} part;

static void halve(const clx_tree_node *root, const part *p, part *a, part *b)
{
    if (p->whole && p->node->right != 0) {
        const clx_tree_node *left = p->node + 1;
        const clx_tree_node *right = root + p->node->right;
        *a = (part){left, left->first, left->count, true};
        *b = (part){right, right->first, right->count, true};
    } else {
        const int32_t half = (p->count / 2 + 3) / 4 * 4;
        *a = (part){p->node, p->first, half, false};
        *b = (part){p->node, p->first + half, p->count - half, false};
    }
}

static void set_box(const clx_fill_field *field, const clx_tree_node *box, clx_fill_node *node,
                    int slot)
{
    for (int k = 0; k < 3; ++k) {
        const double low = (box->low[k] - field->middle[k]) * field->scale;
        const double high = (box->high[k] - field->middle[k]) * field->scale;
        node->middle[k][slot] = (float)(0.5 * (low + high));
        node->half[k][slot] = (float)(0.5 * (high - low));
    }
}

/// Folds a part into a node (or a leaf when it is small enough); depth is at most that of the tree.
static clast_status fold(const clast_bvh *bvh, const part *whole, clx_fill_field *field,
                         int32_t *number)
{
    clast_status status = CLAST_OK;
    part p[4] = {*whole, *whole, *whole, *whole};
    int n = 1;
    while (n < 4) {
        int largest = 0;
        for (int i = 1; i < n; ++i) {
            largest = p[i].count > p[largest].count ? i : largest;
        }
        if (p[largest].count <= 4) {
            break;
        }
        halve(bvh->tree.node, &p[largest], &p[largest], &p[n]);
        ++n;
    }
    CLX_TRY(clx_grow(&field->node, &field->node_capacity, field->n_node + 1, sizeof *field->node));
    const int64_t self = field->n_node++;
    for (int i = 0; i < 4; ++i) {
        int32_t child = 0;
        if (i < n && p[i].count <= 4) {
            CLX_TRY(add_leaf(bvh, p[i].first, p[i].count, field, &child));
        } else if (i < n) {
            CLX_TRY(fold(bvh, &p[i], field, &child));
        }
        clx_fill_node *node = &field->node[self];
        node->child[i] = child;
        for (int k = 0; k < 3; ++k) {
            node->middle[k][i] = INFINITY;
            node->half[k][i] = 0.0F;
        }
        if (i < n) {
            set_box(field, p[i].node, node, i);
        }
    }
    *number = (int32_t)self;
done:
    return status;
}

clast_status clx_fill_field_create(const clast_bvh *bvh, clx_fill_field *field)
{
    clast_status status = CLAST_OK;
    const clx_tree_node *root = bvh->tree.node;
    const int32_t n = bvh->tree.n_item;
    clx_fill_field made = {0};
    int32_t first = 0;
    double size = 0.0;
    for (int k = 0; k < 3; ++k) {
        made.middle[k] = 0.5 * root->low[k] + 0.5 * root->high[k];
        size = fmax(size, root->high[k] - root->low[k]);
    }
    CLX_CHECK(size > 0.0 && isfinite(1.0 / size), CLAST_E_GEOMETRY, "the surface has no size");
    made.scale = 1.0 / size;
    CLX_TRY(clx_alloc(&made.tri, n, sizeof *made.tri));
    CLX_TRY(clx_alloc(&made.size, n, sizeof *made.size));
    for (int32_t i = 0; i < n; ++i) {
        v3_copy(made.tri[i][0], bvh->corner[i][0]);
        v3_sub(made.tri[i][1], bvh->corner[i][1], bvh->corner[i][0]);
        v3_sub(made.tri[i][2], bvh->corner[i][2], bvh->corner[i][0]);
    }
    CLX_TRY(fold(bvh, &(part){root, root->first, root->count, true}, &made, &first));
    *field = made;
    made = (clx_fill_field){0};
done:
    clx_fill_field_free(&made);
    return status;
}

typedef struct {
    double d2;   ///< least squared distance so far
    float d;     ///< its root in the frame, rounded up by the frame's error
    int32_t tri; ///< -1: none yet
    double away[3];
} nearest;

static float in_frame(const clx_fill_field *field, double d)
{
    return (float)((d * field->scale + FRAME_ERROR) * (1.0 + FRAME_ERROR));
}

static void look_at(const clx_fill_field *field, int32_t number, const double point[3],
                    nearest *best)
{
    double p[3];
    double away[3];
    v3_sub(p, point, field->tri[number][0]);
    clx_fill_triangle_away(field->tri[number], p, away);
    const double d2 = v3_norm2(away);
    if (d2 <= best->d2) {
        best->d2 = d2;
        best->d = in_frame(field, sqrt(d2));
        best->tri = number;
        v3_copy(best->away, away);
    }
}

static clx_float4 magnitude(clx_float4 x)
{
    return (clx_float4)((clx_int4)x & 0x7fffffff);
}

static void visit_leaf(const clx_fill_field *field, const clx_fill_leaf *leaf, const float f[3],
                       const double point[3], nearest *best)
{
    const clx_float4 x = leaf->centre[0] - f[0];
    const clx_float4 y = leaf->centre[1] - f[1];
    const clx_float4 z = leaf->centre[2] - f[2];
    const clx_float4 reach = leaf->radius + best->d;
    const clx_float4 room = reach * reach - (x * x + y * y + z * z);
    for (int i = 0; i < 4; ++i) {
        if (room[i] >= 0.0F) {
            look_at(field, leaf->first + i, point, best);
        }
    }
}

/// Four times the squared distances of a point to the boxes of four children.
static clx_float4 box_distances(const clx_fill_node *node, const float f[3])
{
    clx_float4 sum = {0.0F, 0.0F, 0.0F, 0.0F};
    for (int k = 0; k < 3; ++k) {
        const clx_float4 out = magnitude(node->middle[k] - f[k]) - node->half[k];
        const clx_float4 twice = out + magnitude(out); // 2 max(out, 0)
        sum += twice * twice;
    }
    return sum;
}

double clx_fill_field_distance(const clx_fill_field *field, const double point[3],
                               double max_distance, double closest[3], int32_t *tri)
{
    struct {
        float d2; ///< four times the squared distance
        int32_t child;
    } stack[3 * CLX_TREE_DEPTH + 1];
    float f[3];
    for (int k = 0; k < 3; ++k) {
        f[k] = (float)((point[k] - field->middle[k]) * field->scale);
    }
    nearest best = {
        .d2 = max_distance * max_distance, .d = in_frame(field, max_distance), .tri = -1};
    int n = 1;
    stack[0].d2 = 0.0F;
    stack[0].child = 0;
    while (n > 0) {
        --n;
        if (stack[n].d2 > 4.0F * best.d * best.d) {
            continue;
        }
        const int32_t child = stack[n].child;
        if (child < 0) {
            visit_leaf(field, &field->leaf[-1 - child], f, point, &best);
            continue;
        }
        const clx_fill_node *node = &field->node[child];
        const clx_float4 d2 = box_distances(node, f);
        const int bottom = n;
        const float limit = 4.0F * best.d * best.d;
        for (int i = 0; i < 4; ++i) {
            if (d2[i] <= limit && d2[i] < INFINITY) {
                int at = n++;
                for (; at > bottom && stack[at - 1].d2 < d2[i]; --at) {
                    stack[at] = stack[at - 1];
                }
                stack[at].d2 = d2[i];
                stack[at].child = node->child[i];
            }
        }
    }
    if (best.tri < 0) {
        return INFINITY;
    }
    v3_sub(closest, point, best.away);
    *tri = best.tri;
    return sqrt(best.d2);
}
