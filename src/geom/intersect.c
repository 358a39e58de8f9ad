// Self-intersections of a mesh: the pairs that meet (bvh_self.c), told apart into those that cut
// each other and those that only touch.
//
// Only signs of determinants are used [Shewchuk1997], in the scheme of Guigue and Devillers 2003
// ("Fast and robust triangle-triangle overlap test using orientation predicates", sec. 2) with
// strict inequalities. A surface whose boxes overlap so densely that testing them all would take
// minutes (a soup of large triangles) is left alone, as is one on which exact arithmetic would
// (slivers on one line), and the result says so.
#include "geom/intersect.h"

#include "base/alloc.h"
#include "geom/bvh.h"
#include "math/predicates.h"
#include "math/vec3.h"

enum { PAIR_CAP = 65536, SAMPLES = 1024 };
static const int64_t PAIR_BUDGET = 200000000; // about 10 s on one core
static const int64_t TRIANGLE_BUDGET = 250;   // more for each triangle: exact zeros of a grid

static int sign(double x)
{
    return (x > 0.0) - (x < 0.0);
}

/// Corner that stands alone on its side of a plane, given the corners' sides; -1 when the triangle
/// does not reach to both sides.
static int lone_corner(const int side[3])
{
    for (int k = 0; k < 3; ++k) {
        const int i = side[(k + 1) % 3];
        const int j = side[(k + 2) % 3];
        if (side[k] != 0 && i * side[k] <= 0 && j * side[k] <= 0 && (i != 0 || j != 0)) {
            return k;
        }
    }
    return -1;
}

/// The triangles' corners with the lone one first, turned so that each lone corner lies above the
/// other triangle; then the line of both planes meets a between a0 a1 and a0 a2, b between b0 b1
/// and b0 b2, in this direction. The stretches overlap when each begins before the other ends.
static bool stretches_overlap(double a[3][3], int lone_a, bool a_above, double b[3][3], int lone_b,
                              bool b_above)
{
    const double *a0 = a[lone_a];
    const double *b0 = b[lone_b];
    const double *a1 = a[(lone_a + (b_above ? 1 : 2)) % 3];
    const double *a2 = a[(lone_a + (b_above ? 2 : 1)) % 3];
    const double *b1 = b[(lone_b + (a_above ? 1 : 2)) % 3];
    const double *b2 = b[(lone_b + (a_above ? 2 : 1)) % 3];
    return clx_orient3d(a0, a1, b0, b1) > 0.0 && clx_orient3d(a0, a2, b2, b0) > 0.0;
}

/// Does an edge of plane triangle a have all of b on its outer side or on itself?
static bool parted_by_edge(double a[3][2], double b[3][2])
{
    const int orientation = sign(clx_orient2d(a[0], a[1], a[2]));
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        bool outside = true;
        for (int i = 0; i < 3 && outside; ++i) {
            outside = orientation * sign(clx_orient2d(a[k], a[next], b[i])) <= 0;
        }
        if (outside) {
            return true;
        }
    }
    return false;
}

/// Interiors of two triangles in one plane overlap unless an edge parts them.
static bool overlap_in_plane(double a[3][3], double b[3][3])
{
    for (int k = 0; k < 3; ++k) { // a projection that keeps the area of both
        double p[3][2];
        double q[3][2];
        for (int i = 0; i < 3; ++i) {
            p[i][0] = a[i][k];
            p[i][1] = a[i][(k + 1) % 3];
            q[i][0] = b[i][k];
            q[i][1] = b[i][(k + 1) % 3];
        }
        if (clx_orient2d(p[0], p[1], p[2]) != 0.0 && clx_orient2d(q[0], q[1], q[2]) != 0.0) {
            return !parted_by_edge(p, q) && !parted_by_edge(q, p);
        }
    }
    return false; // no area
}

bool clx_triangles_cut(double a[3][3], double b[3][3])
{
    int side_a[3];
    int side_b[3];
    for (int k = 0; k < 3; ++k) {
        side_b[k] = -sign(clx_orient3d(a[0], a[1], a[2], b[k])); // 1 is above
    }
    if (side_b[0] == 0 && side_b[1] == 0 && side_b[2] == 0) {
        return overlap_in_plane(a, b);
    }
    for (int k = 0; k < 3; ++k) {
        side_a[k] = -sign(clx_orient3d(b[0], b[1], b[2], a[k]));
    }
    const int lone_a = lone_corner(side_a);
    const int lone_b = lone_corner(side_b);
    return lone_a >= 0 && lone_b >= 0 &&
           stretches_overlap(a, lone_a, side_a[lone_a] > 0, b, lone_b, side_b[lone_b] > 0);
}

/// Boxes of leaves that the box of item i meets, counted up to `most`.
static int64_t count_partners(const clast_bvh *bvh, int32_t i, int64_t most)
{
    double(*c)[3] = bvh->corner[i];
    int32_t stack[CLX_TREE_DEPTH + 1] = {0};
    int32_t n_stack = 1;
    int64_t n = 0;
    while (n_stack > 0 && n < most) {
        const int32_t number = stack[--n_stack];
        const clx_tree_node *node = &bvh->tree.node[number];
        bool meet = true;
        for (int k = 0; k < 3 && meet; ++k) {
            meet = node->low[k] <= fmax(c[0][k], fmax(c[1][k], c[2][k])) &&
                   node->high[k] >= fmin(c[0][k], fmin(c[1][k], c[2][k]));
        }
        if (meet && node->right != 0) {
            stack[n_stack++] = node->right;
            stack[n_stack++] = number + 1;
        }
        n += meet && node->right == 0 ? node->count : 0;
    }
    return n;
}

/// Would testing every pair of boxes that meet take too long? Judged by a thousand triangles.
static bool is_too_dense(const clast_bvh *bvh)
{
    const int64_t n_item = bvh->tree.n_item;
    const int64_t n_sample = n_item < SAMPLES ? n_item : SAMPLES;
    const int64_t most = PAIR_BUDGET * n_sample / n_item; // of the sample, for the whole to fit
    int64_t n = 0;
    for (int64_t i = 0; i < n_sample && n <= most; ++i) {
        n += count_partners(bvh, (int32_t)(i * n_item / n_sample), most + 1);
    }
    return n > most;
}

clast_status clx_mesh_cuts(const clast_mesh *mesh, clx_cuts *cuts)
{
    clast_status status = CLAST_OK;
    clast_bvh *bvh = NULL;
    int32_t(*pair)[2] = NULL;
    int64_t n_pair = 0;
    clx_cuts all = {.first = {-1, -1}, .complete = true};
    if (mesh->n_tri == 0) {
        *cuts = all;
        return CLAST_OK;
    }
    CLX_TRY(clx_alloc(&pair, PAIR_CAP, sizeof *pair));
    CLX_TRY(clast_bvh_create(mesh, &bvh));
    all.complete = !is_too_dense(bvh);
    if (all.complete) {
        const int64_t budget = PAIR_BUDGET + TRIANGLE_BUDGET * mesh->n_tri;
        CLX_TRY(clx_bvh_self_intersections(bvh, budget, PAIR_CAP, pair, &n_pair));
        all.complete = n_pair >= 0 && n_pair <= PAIR_CAP;
    }
    for (int64_t i = 0; i < n_pair && i < PAIR_CAP; ++i) {
        double a[3][3];
        double b[3][3];
        for (int k = 0; k < 3; ++k) {
            v3_copy(a[k], mesh->vert[mesh->tri[pair[i][0]][k]]);
            v3_copy(b[k], mesh->vert[mesh->tri[pair[i][1]][k]]);
        }
        if (!clx_triangles_cut(a, b)) {
            ++all.n_touch;
        } else if (all.n_pair++ == 0) {
            all.first[0] = pair[i][0];
            all.first[1] = pair[i][1];
        }
    }
    *cuts = all;
done:
    clast_bvh_destroy(bvh);
    clx_free(pair);
    return status;
}
