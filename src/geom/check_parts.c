// Connected parts of a surface: counts, genus, volume, which lies in which, and how often each
// counts.
#include "geom/check.h"

#include "base/alloc.h"
#include "geom/topology.h"
#include "geom/tree.h"
#include "math/rng.h"
#include "math/sort.h"
#include "math/vec3.h"
#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <stdlib.h>
#include <string.h>

/// Volume of a part by its area and extent below which it is rounding.
static const double FLAT = 1e-12;

enum { MOST_ASKED = 64 }; // triangles of a part that are asked where they lie

static void add_triangles(const clast_mesh *mesh, const int32_t *part, clast_mesh_part *list)
{
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        double u[3];
        double v[3];
        double n[3];
        if (part[t] < 0) {
            continue;
        }
        clast_mesh_part *p = &list[part[t]];
        const double *a = mesh->vert[mesh->tri[t][0]];
        if (p->n_triangle++ == 0) {
            v3_copy(p->low, a);
            v3_copy(p->high, a);
        }
        for (int k = 0; k < 9; ++k) {
            const double x = mesh->vert[mesh->tri[t][k / 3]][k % 3];
            p->low[k % 3] = fmin(p->low[k % 3], x);
            p->high[k % 3] = fmax(p->high[k % 3], x);
        }
        v3_sub(u, mesh->vert[mesh->tri[t][1]], a);
        v3_sub(v, mesh->vert[mesh->tri[t][2]], a);
        v3_cross(n, u, v);
        p->area += 0.5 * v3_norm(n);
    }
}

/// Signed tetrahedra about the middle of each part's box.
static void add_volumes(const clast_mesh *mesh, const int32_t *part, clast_mesh_part *list)
{
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        double corner[3][3];
        double middle[3];
        double n[3];
        if (part[t] < 0) {
            continue;
        }
        clast_mesh_part *p = &list[part[t]];
        v3_add(middle, p->low, p->high);
        v3_scale(middle, 0.5, middle);
        for (int k = 0; k < 3; ++k) {
            v3_sub(corner[k], mesh->vert[mesh->tri[t][k]], middle);
        }
        v3_cross(n, corner[1], corner[2]);
        p->volume += v3_dot(corner[0], n) / 6.0;
    }
}

static void add_edges(const clast_mesh *mesh, const clx_topology *topology, const int32_t *part,
                      clast_mesh_part *list)
{
    for (int32_t e = 0; e < topology->n_edge; ++e) {
        clast_mesh_part *p = &list[part[topology->half[topology->begin[e]] / 3]];
        const int32_t use = clx_edge_use(topology, e);
        p->n_open_edge += use == 1;
        p->closed = p->closed && use % 2 == 0;
        p->manifold = p->manifold && use <= 2;
        p->oriented = p->oriented && abs(clx_edge_balance(mesh, topology, e)) <= use % 2;
        --p->genus; // Euler's number gathers here first
    }
}

/// Genus from Euler's number, a fan counted as a vertex (so that parts that touch in a vertex do
/// not count it twice).
static clast_status add_genus(const clast_mesh *mesh, const clx_topology *topology,
                              const int32_t *part, int32_t n_part, clast_mesh_part *list)
{
    clast_status status = CLAST_OK;
    int32_t *corner_fan = NULL;
    int32_t *n_fan = NULL;
    CLX_TRY(clx_alloc(&corner_fan, 3 * (int64_t)mesh->n_tri, sizeof *corner_fan));
    CLX_TRY(clx_alloc(&n_fan, mesh->n_vert, sizeof *n_fan));
    clx_topology_fans(mesh, topology, corner_fan, n_fan);
    for (int32_t c = 0; c < 3 * mesh->n_tri; ++c) {
        if (corner_fan[c] == c) {
            ++list[part[c / 3]].genus;
        }
    }
    for (int32_t i = 0; i < n_part; ++i) {
        const int32_t euler = list[i].genus + list[i].n_triangle;
        const bool known = list[i].closed && list[i].oriented && list[i].manifold;
        list[i].genus = known ? (2 - euler) / 2 : -1;
    }
done:
    CLX_FREE(corner_fan, n_fan);
    return status;
}

static bool box_in_box(const clast_mesh_part *inner, const clast_mesh_part *outer)
{
    for (int k = 0; k < 3; ++k) {
        if (inner->low[k] < outer->low[k] || inner->high[k] > outer->high[k]) {
            return false;
        }
    }
    return true;
}

double clx_solid_angle(const double p[3], const double a[3], const double b[3], const double c[3])
{
    double u[3];
    double v[3];
    double w[3];
    double n[3];
    v3_sub(u, a, p);
    v3_sub(v, b, p);
    v3_sub(w, c, p);
    v3_cross(n, v, w);
    const double lu = v3_norm(u);
    const double lv = v3_norm(v);
    const double lw = v3_norm(w);
    const double below = lu * lv * lw + v3_dot(u, v) * lw + v3_dot(u, w) * lv + v3_dot(v, w) * lu;
    return 2.0 * atan2(v3_dot(u, n), below);
}

bool clx_is_star_shaped(const clast_mesh *mesh)
{
    double low[3];
    double high[3];
    double middle[3] = {0};
    double sum = 0.0;
    clast_mesh_bounds(mesh, low, high);
    const double extent = v3_distance(low, high);
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        v3_axpy(middle, middle, 1.0 / mesh->n_vert, mesh->vert[v]);
    }
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        double corner[3][3];
        double n[3];
        for (int k = 0; k < 3; ++k) {
            v3_sub(corner[k], mesh->vert[mesh->tri[t][k]], middle);
        }
        v3_cross(n, corner[1], corner[2]);
        if (!(v3_dot(corner[0], n) > 1e-14 * extent * extent * extent)) {
            return false;
        }
        sum += clx_solid_angle((double[3]){0}, corner[0], corner[1], corner[2]);
    }
    return sum < 6.0 * CLAST_PI;
}

typedef struct {
    const clast_mesh *mesh;
    const int32_t *first; ///< [n_part + 1] triangles of each part
    const int32_t *tri;
} part_lists;

/// Does the part wind around the point? 1 inside, -1 outside, 0 on the surface itself, where one
/// triangle alone fills half of all directions and its sign is rounding.
static int winds_around(const part_lists *lists, int32_t part, const double point[3])
{
    CLAST_ASSERT(part >= 0 && lists->first[part] <= lists->first[part + 1]);
    const clast_mesh *mesh = lists->mesh;
    double sum = 0.0;
    for (int32_t i = lists->first[part]; i < lists->first[part + 1]; ++i) {
        const int32_t *c = mesh->tri[lists->tri[i]];
        const double angle =
            clx_solid_angle(point, mesh->vert[c[0]], mesh->vert[c[1]], mesh->vert[c[2]]);
        if (fabs(angle) > 2.0 * CLAST_PI - 1e-9) {
            return 0;
        }
        sum += angle;
    }
    return fabs(sum) > 2.0 * CLAST_PI ? 1 : -1;
}

/// Middles of three triangles vote, so that one contact point does not decide; those on the outer
/// part's surface (walls that touch) have no vote, and others are asked.
static bool lies_in(const part_lists *lists, int32_t inner, int32_t outer)
{
    CLAST_ASSERT(inner != outer);
    int votes = 0;
    int n_vote = 0;
    const int32_t n = lists->first[inner + 1] - lists->first[inner];
    for (int32_t i = 0; i < MOST_ASKED && i < n + 3 && n_vote < 3; ++i) {
        const int32_t at = i < 3 ? (int32_t)((int64_t)i * (n - 1) / 2) : i - 3;
        const int32_t t = lists->tri[lists->first[inner] + at];
        double middle[3] = {0};
        for (int k = 0; k < 3; ++k) {
            v3_axpy(middle, middle, 1.0 / 3.0, lists->mesh->vert[lists->mesh->tri[t][k]]);
        }
        const int vote = winds_around(lists, outer, middle);
        votes += vote;
        n_vote += vote != 0;
    }
    return votes > 0;
}

/// A number of a part's triangles in any order, alike for copies.
static uint64_t hash_part(const part_lists *lists, int32_t part)
{
    uint64_t sum = 0;
    for (int32_t i = lists->first[part]; i < lists->first[part + 1]; ++i) {
        uint64_t triangle = 0;
        for (int c = 0; c < 3; ++c) {
            uint64_t corner = 0;
            for (int k = 0; k < 3; ++k) {
                const double x = lists->mesh->vert[lists->mesh->tri[lists->tri[i]][c]][k] + 0.0;
                uint64_t bits = 0;
                memcpy(&bits, &x, sizeof bits);
                corner = clx_mix(corner ^ bits);
            }
            triangle += corner;
        }
        sum += clx_mix(triangle);
    }
    return sum;
}

/// The same triangles again, with vertices of their own: of two copies the later lies in the other.
static bool is_copy(const part_lists *lists, const clast_mesh_part *list, int32_t inner,
                    int32_t outer)
{
    return inner > outer && list[inner].n_triangle == list[outer].n_triangle &&
           v3_distance(list[inner].low, list[outer].low) == 0.0 &&
           v3_distance(list[inner].high, list[outer].high) == 0.0 &&
           hash_part(lists, inner) == hash_part(lists, outer);
}

static bool is_within(const part_lists *lists, const clast_mesh_part *list, int32_t inner,
                      int32_t outer)
{
    if (!box_in_box(&list[inner], &list[outer])) {
        return false;
    }
    if (is_copy(lists, list, inner, outer) || is_copy(lists, list, outer, inner)) {
        return inner > outer;
    }
    return lies_in(lists, inner, outer);
}

/// Of all parts around one, the outermost has the largest volume and the parent, directly around
/// it, the smallest; of copies the later one lies in the other.
static void keep_around(clast_mesh_part *list, int32_t *parent, int32_t inner, int32_t outer)
{
    CLAST_ASSERT(inner != outer);
    const double volume = fabs(list[outer].volume);
    const int32_t known = list[inner].outermost;
    if (known < 0 || volume > fabs(list[known].volume)) {
        list[inner].outermost = outer;
    }
    if (parent == NULL) {
        return;
    }
    const int32_t near = parent[inner];
    const double least = near >= 0 ? fabs(list[near].volume) : (double)INFINITY;
    if (volume < least || (volume == least && outer > near)) {
        parent[inner] = outer;
    }
}

static int sign(double x)
{
    return (x > 0.0) - (x < 0.0);
}

bool clx_is_no_volume(double volume, double area, double extent)
{
    return fabs(volume) <= FLAT * area * extent;
}

bool clx_part_is_flat(const clast_mesh_part *part)
{
    return part->closed && part->oriented &&
           clx_is_no_volume(part->volume, part->area, v3_distance(part->low, part->high));
}

int clx_part_facing(const clast_mesh_check_result *result, int32_t part)
{
    const clast_mesh_part *p = &result->part[part];
    const clast_mesh_part *outermost = p->outermost >= 0 ? &result->part[p->outermost] : p;
    return p->closed && p->oriented && !clx_part_is_flat(p)
               ? sign(p->volume) * sign(outermost->volume)
               : 0;
}

int32_t clx_count_apart(const clast_mesh_check_result *result)
{
    int32_t n = 0;
    for (int32_t i = 0; i < result->n_part; ++i) {
        n += clx_part_facing(result, i) > 0 && result->part[i].depth == 0;
    }
    return n;
}

clast_status clx_count_parted(const clast_mesh_check_result *result, int32_t *n_parted)
{
    clast_status status = CLAST_OK;
    double(*range)[2] = NULL;
    *n_parted = 0;
    CLX_TRY(clx_alloc(&range, result->n_part, sizeof *range));
    for (int k = 0; k < 3; ++k) {
        int32_t n = 0;
        int32_t n_group = 0;
        double high = -INFINITY;
        for (int32_t i = 0; i < result->n_part; ++i) {
            const clast_mesh_part *p = &result->part[i];
            if (clx_part_facing(result, i) != 0) {
                range[n][0] = p->low[k];
                range[n++][1] = p->high[k];
            }
        }
        qsort(range, (size_t)n, sizeof *range, clx_by_value);
        for (int32_t i = 0; i < n; ++i) {
            n_group += range[i][0] > high;
            high = fmax(high, range[i][1]);
        }
        *n_parted = n_group > *n_parted ? n_group : *n_parted;
    }
done:
    clx_free(range);
    return status;
}

/// Tree of the boxes of parts that can contain others.
static clast_status build_tree(const clast_mesh_part *list, int32_t n_part, clx_tree *tree)
{
    clast_status status = CLAST_OK;
    clx_tree_box *box = NULL;
    int32_t n = 0;
    CLX_TRY(clx_alloc(&box, n_part, sizeof *box));
    for (int32_t i = 0; i < n_part; ++i) {
        if (list[i].closed && list[i].oriented) {
            v3_copy(box[n].low, list[i].low);
            v3_copy(box[n].high, list[i].high);
            box[n++].item = i;
        }
    }
    if (n > 1) {
        CLX_TRY(clx_tree_build(box, n, 4, tree));
    }
done:
    clx_free(box);
    return status;
}

/// Finds all parts around one.
static void find_depth(const part_lists *lists, const clx_tree *tree, clast_mesh_part *list,
                       int32_t *parent, int32_t inner)
{
    int32_t stack[CLX_TREE_DEPTH + 1] = {0};
    int32_t n_stack = 1;
    while (n_stack > 0) {
        const int32_t number = stack[--n_stack];
        const clx_tree_node *node = &tree->node[number];
        const double *p = list[inner].low;
        bool holds = true;
        for (int k = 0; k < 3; ++k) {
            holds = holds && node->low[k] <= p[k] && p[k] <= node->high[k];
        }
        if (holds && node->right != 0) {
            stack[n_stack++] = node->right;
            stack[n_stack++] = number + 1;
        }
        for (int32_t i = 0; holds && node->right == 0 && i < node->count; ++i) {
            const int32_t outer = tree->item[node->first + i];
            if (outer != inner && is_within(lists, list, inner, outer)) {
                ++list[inner].depth;
                list[inner].winding += sign(list[outer].volume);
                keep_around(list, parent, inner, outer);
            }
        }
    }
}

static clast_status find_depths(const clast_mesh *mesh, const int32_t *part, int32_t n_part,
                                clast_mesh_part *list, int32_t *parent)
{
    clast_status status = CLAST_OK;
    clx_tree tree = {0};
    int32_t *first = NULL;
    int32_t *tri = NULL;
    CLX_TRY(clx_alloc(&first, (int64_t)n_part + 2, sizeof *first));
    CLX_TRY(clx_alloc(&tri, mesh->n_tri, sizeof *tri));
    for (int32_t i = 0; i < n_part; ++i) {
        first[i + 2] = first[i + 1] + list[i].n_triangle;
    }
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        if (part[t] >= 0) {
            tri[first[part[t] + 1]++] = t;
        }
    }
    const part_lists lists = {mesh, first, tri};
    CLX_TRY(build_tree(list, n_part, &tree));
    for (int32_t inner = 0; inner < n_part && tree.n_node > 0; ++inner) {
        if (list[inner].closed) {
            find_depth(&lists, &tree, list, parent, inner);
        }
    }
done:
    clx_tree_free(&tree);
    CLX_FREE(first, tri);
    return status;
}

/// Windings, from the signs of the parts around each to those against the outermost, and what they
/// say.
static void count_nested(clast_mesh_check_result *result)
{
    for (int32_t i = 0; i < result->n_part; ++i) {
        clast_mesh_part *p = &result->part[i];
        const int facing = clx_part_facing(result, i);
        const int around = p->outermost >= 0 ? sign(result->part[p->outermost].volume) : 1;
        p->winding = facing != 0 ? around * p->winding + facing : 0;
        p->inside_out =
            p->closed && p->oriented && p->depth == 0 && p->volume < 0.0 && !clx_part_is_flat(p);
        result->n_inside_out += p->inside_out;
        result->n_flat += clx_part_is_flat(p);
        result->n_nested += p->closed && p->depth > 0;
        result->n_doubled += (facing > 0 && p->winding > 1) || (facing < 0 && p->winding < 0);
        result->n_body += facing > 0 && p->winding == 1;
    }
}

clast_status clx_check_parts(const clast_mesh *mesh, const clx_topology *topology,
                             clast_mesh_check_result *result, int32_t *parent)
{
    clast_status status = CLAST_OK;
    int32_t *part = NULL;
    CLX_TRY(clx_alloc(&part, mesh->n_tri, sizeof *part));
    CLX_TRY(clx_topology_parts(topology, mesh->n_tri, part, &result->n_part));
    CLX_TRY(clx_alloc(&result->part, result->n_part, sizeof *result->part));
    for (int32_t i = 0; i < result->n_part; ++i) {
        result->part[i] =
            (clast_mesh_part){.closed = true, .oriented = true, .manifold = true, .outermost = -1};
        if (parent != NULL) {
            parent[i] = -1;
        }
    }
    add_triangles(mesh, part, result->part);
    add_volumes(mesh, part, result->part);
    add_edges(mesh, topology, part, result->part);
    CLX_TRY(add_genus(mesh, topology, part, result->n_part, result->part));
    CLX_TRY(find_depths(mesh, part, result->n_part, result->part, parent));
    count_nested(result);
    for (int32_t i = 0; i < result->n_part; ++i) {
        result->genus += result->part[i].genus > 0 ? result->part[i].genus : 0;
    }
done:
    clx_free(part);
    return status;
}
