// Distance to the surface, made for a filling's tens of thousands of questions.
//
// Boxes of eight children stand side by side in floats (in a frame scaled to the surface), and so
// do eight triangles of a leaf, so that one pass of vector instructions without branches measures
// eight of either. The walk is all in floats; the triangle that wins is measured in double at the
// end. Two triangles whose distances agree to float rounding may be confused (`error` says how far
// that, and slivers, can be wrong), so clast_fill checks each accepted sphere by
// clx_fill_field_closest.
//
// Measured on a scan of 33,000 triangles: 16 branches mispredicted a query (callgrind's model), 115
// when children were sorted and triangles chosen one at a time.
//                                                            [Ericson2005 sec. 5.1.5, Wald2008]
#include "shape/fill_field.h"

#include "base/machine.h"
#include <float.h>
#include <string.h>

// Vectors pass between inlined functions only, so the calling convention does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"

enum { LANES = CLX_FILL_LANES };

CLX_INLINE clx_float8 magnitude(clx_float8 x)
{
    return (clx_float8)((clx_int8)x & 0x7fffffff);
}

CLX_INLINE clx_float8 dot(const clx_float8 a[3], const clx_float8 b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Marks where x is below 0. The sign bit and not a comparison: without AVX2 GCC takes comparisons
/// of eight lane by lane.
CLX_INLINE clx_int8 below_zero(clx_float8 x)
{
    return (clx_int8)x >> 31;
}

CLX_INLINE clx_float8 pick(clx_int8 mask, clx_float8 yes, clx_float8 no)
{
    return (clx_float8)((mask & (clx_int8)yes) | (~mask & (clx_int8)no));
}

/// |p - t e|^2 with t = along / length2 clamped to [0, 1]: distance to an edge from the origin.
CLX_INLINE clx_float8 edge_distance2(const clx_float8 p[3], const clx_float8 e[3], clx_float8 along,
                                     clx_float8 length2)
{
    const clx_float8 t = along / (length2 + 1e-30F);
    const clx_float8 inside = 0.5F * (magnitude(t) - magnitude(t - 1.0F) + 1.0F);
    clx_float8 r[3];
    for (int k = 0; k < 3; ++k) {
        r[k] = p[k] - inside * e[k];
    }
    return dot(r, r);
}

/// Squared distances of a point to eight triangles: the least over the three edges and the foot in
/// the plane, all of them distances to points of the triangle, so none is too small.
CLX_INLINE clx_float8 leaf_distances2(const clx_fill_leaf *leaf, const float f[3])
{
    clx_float8 p[3];
    clx_float8 bc[3];
    clx_float8 from_b[3];
    clx_float8 r[3];
    for (int k = 0; k < 3; ++k) {
        p[k] = f[k] - leaf->a[k];
        bc[k] = leaf->ac[k] - leaf->ab[k];
        from_b[k] = p[k] - leaf->ab[k];
    }
    const clx_float8 d1 = dot(leaf->ab, p);
    const clx_float8 d2 = dot(leaf->ac, p);
    const clx_float8 bb = dot(leaf->ab, leaf->ab);
    const clx_float8 cc = dot(leaf->ac, leaf->ac);
    const clx_float8 mixed = dot(leaf->ab, leaf->ac);
    const clx_float8 whole = bb * cc - mixed * mixed;
    const clx_float8 v = cc * d1 - mixed * d2;
    const clx_float8 w = bb * d2 - mixed * d1;
    const clx_float8 per_whole = 1.0F / whole;
    for (int k = 0; k < 3; ++k) {
        r[k] = p[k] - v * per_whole * leaf->ab[k] - w * per_whole * leaf->ac[k];
    }
    const clx_int8 beside = below_zero(v) | below_zero(w) | below_zero(whole - v - w);
    const clx_int8 has_foot = ~beside & below_zero(0.0F - whole);
    const clx_float8 e1 = edge_distance2(p, leaf->ab, d1, bb);
    const clx_float8 e2 = edge_distance2(p, leaf->ac, d2, cc);
    const clx_float8 e3 = edge_distance2(from_b, bc, dot(from_b, bc), dot(bc, bc));
    clx_float8 least = pick(below_zero(e1 - e2), e1, e2);
    least = pick(below_zero(e3 - least), e3, least);
    return pick(has_foot, dot(r, r), least);
}

/// Four times the squared distances of a point to the boxes of eight children.
CLX_INLINE clx_float8 box_distances(const clx_fill_node *node, const float f[3])
{
    clx_float8 sum = {0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0.0F};
    for (int k = 0; k < 3; ++k) {
        const clx_float8 out = magnitude(node->middle[k] - f[k]) - node->half[k];
        const clx_float8 twice = out + magnitude(out); // 2 max(out, 0)
        sum += twice * twice;
    }
    return sum;
}

/// A walk: what is to be visited, and the best triangle so far.
typedef struct {
    struct {
        int32_t key; ///< bits of four times the squared distance: floats >= 0 sort as integers
        int32_t child;
    } stack[(LANES - 1) * CLX_FILL_DEPTH + LANES];
    int n;
    int32_t limit; ///< least key of no interest, less one
    float d2;      ///< least squared distance
    int32_t tri;   ///< -1: none yet
} walk;

CLX_INLINE int32_t bits(float x)
{
    int32_t i;
    memcpy(&i, &x, sizeof i);
    return i;
}

/// Only what is nearer than d is of interest.
CLX_INLINE void set_limit(walk *w, float d)
{
    const float error = (float)CLX_FILL_FRAME_ERROR;
    const float padded = d * (1.0F + error) + error;
    const float limit = 4.0F * padded * padded;
    w->limit = bits(limit < FLT_MAX ? limit : FLT_MAX);
}

CLX_INLINE void order(int32_t *farther, int32_t *nearer)
{
    const int32_t a = *farther;
    const int32_t b = *nearer;
    *farther = a > b ? a : b;
    *nearer = a > b ? b : a;
}

/// Puts the children of a node on the stack, the nearest on top. Their keys carry their number in
/// the last three bits; none of the steps is a branch (Batcher's network of 19 exchanges).
CLX_INLINE void open_node(walk *w, const clx_fill_node *node, const float f[3])
{
    static const uint8_t exchange[19][2] = {{0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6},
                                            {3, 7}, {0, 1}, {2, 3}, {4, 5}, {6, 7}, {2, 4}, {3, 5},
                                            {1, 4}, {3, 6}, {1, 2}, {3, 4}, {5, 6}};
    const clx_int8 lane = {0, 1, 2, 3, 4, 5, 6, 7};
    const clx_int8 near = ((clx_int8)box_distances(node, f) & ~7) | lane;
    int32_t key[LANES];
    memcpy(key, &near, sizeof key);
#pragma GCC unroll 19
    for (int i = 0; i < 19; ++i) {
        order(&key[exchange[i][0]], &key[exchange[i][1]]);
    }
    for (int i = 0; i < LANES; ++i) {
        w->stack[w->n].key = key[i];
        w->stack[w->n].child = node->child[key[i] & 7];
        w->n += key[i] <= w->limit;
    }
}

CLX_INLINE void visit_leaf(walk *w, const clx_fill_leaf *leaf, const float f[3])
{
    const clx_float8 d2 = leaf_distances2(leaf, f);
    const clx_int8 nearer = below_zero(d2 - w->d2);
    int64_t any[4];
    memcpy(any, &nearer, sizeof any);
    if ((any[0] | any[1] | any[2] | any[3]) == 0) {
        return;
    }
    for (int i = 0; i < LANES; ++i) {
        if (d2[i] < w->d2) {
            w->d2 = d2[i];
            w->tri = leaf->first + i;
        }
    }
    set_limit(w, sqrtf(w->d2));
}

/// Number of the nearest triangle by floats within `most`, or -1.
CLX_FOR_EACH_MACHINE
static int32_t nearest_by_floats(const clx_fill_field *field, const float f[3], float most)
{
    walk w;
    w.n = 1;
    w.stack[0].key = 0;
    w.stack[0].child = 0;
    w.tri = -1;
    w.d2 = most * most;
    set_limit(&w, most);
    while (w.n > 0) {
        --w.n;
        const int32_t child = w.stack[w.n].child;
        if (w.stack[w.n].key > w.limit) {
            continue;
        }
        if (child < 0) {
            visit_leaf(&w, &field->leaf[-1 - child], f);
        } else {
            open_node(&w, &field->node[child], f);
        }
    }
    return w.tri;
}

double clx_fill_field_distance(const clx_fill_field *field, const double point[3],
                               double max_distance, double closest[3], int32_t *tri)
{
    CLAST_ASSERT(field->n_node > 0);
    float f[3];
    double p[3];
    double away[3];
    for (int k = 0; k < 3; ++k) {
        f[k] = (float)((point[k] - field->middle[k]) * field->scale);
    }
    const float most =
        (float)(max_distance * field->scale * (1.0 + CLX_FILL_FRAME_ERROR) + CLX_FILL_FRAME_ERROR);
    const int32_t nearest = nearest_by_floats(field, f, most);
    if (nearest < 0) {
        return INFINITY;
    }
    v3_sub(p, point, field->tri[nearest][0]);
    clx_fill_triangle_away(field->tri[nearest], p, away);
    const double d = v3_norm(away);
    if (!(d <= max_distance)) {
        return INFINITY;
    }
    v3_sub(closest, point, away);
    *tri = nearest;
    return d;
}
