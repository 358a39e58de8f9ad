// Bodies before walls of triangles: a triangle is a flat hull, made when it is needed.
#include "convex/wall_mesh.h"

#include "base/alloc.h"
#include "base/status.h"
#include "geom/topology.h"
#include "math/vec3.h"

enum { LEAF = 4 };

/// Share of the triangle within which a point counts as on a side, and the lean that rounding
/// makes.
static const double ON_SIDE = 1e-6;

/// Times its least move that a body may reach beyond the plane of a triangle that pushes it along
/// its normal: sharper needles than one in forty are not held.
static const double DEEPEST = 40.0;

/// Pushes whose normals are closer than this cosine are one.
static const double SAME_PUSH = 0.9;

/// A triangle as a hull of two faces.
typedef struct {
    clx_hull_core core;
    double vert[3][3];
    clx_core_face face[2];
    clx_core_side side[6];
    clx_core_edge edge[3];
    int32_t near_first[4];
    clx_core_near near[6];
} flat_hull;

static void make_sides(const clx_wall_triangle *t, flat_hull *h)
{
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        const double offset = v3_dot(t->out[k], h->vert[k]);
        clx_core_edge *edge = &h->edge[k];
        *edge = (clx_core_edge){.vert = {k, next}, .face = {0, 1}};
        v3_copy(edge->from, h->vert[k]);
        v3_sub(edge->along, h->vert[next], h->vert[k]);
        h->side[k] = (clx_core_side){.offset = offset, .vert = k, .edge = k};
        h->side[3 + (2 - k)] = (clx_core_side){.offset = offset, .vert = next, .edge = k};
        v3_copy(h->side[k].out, t->out[k]);
        v3_copy(h->side[3 + (2 - k)].out, t->out[k]);
        v3_copy(edge->out[0], t->out[k]);
        v3_copy(edge->out[1], t->out[k]);
    }
}

static void make_hull(const clx_wall_triangle *t, flat_hull *h)
{
    *h = (flat_hull){.near_first = {0, 2, 4, 6}};
    h->core = (clx_hull_core){.n_vert = 3,
                              .n_face = 2,
                              .n_side = 6,
                              .n_edge = 3,
                              .vert = h->vert,
                              .face = h->face,
                              .side = h->side,
                              .edge = h->edge,
                              .near_first = h->near_first,
                              .near = h->near,
                              .radius = t->bounding_radius};
    for (int k = 0; k < 3; ++k) {
        v3_sub(h->vert[k], t->corner[k], t->centroid);
    }
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < 2; ++i) { // next corner over side k, last over the side before it
            clx_core_near *near = &h->near[2 * k + i];
            near->vert = (k + 1 + i) % 3;
            near->edge = i == 0 ? k : (k + 2) % 3;
            v3_sub(near->along, h->vert[near->vert], h->vert[k]);
            near->inverse = 1.0 / v3_norm(near->along);
        }
    }
    h->face[0] = (clx_core_face){.first = 0, .n = 3};
    h->face[1] = (clx_core_face){.first = 3, .n = 3};
    v3_copy(h->face[0].normal, t->normal);
    v3_scale(h->face[1].normal, -1.0, t->normal);
    make_sides(t, h);
    for (int k = 0; k < 3; ++k) {
        const double d = v3_dot(t->normal, h->vert[k]);
        h->face[0].offset = k == 0 ? d : fmax(h->face[0].offset, d);
        h->face[1].offset = k == 0 ? -d : fmax(h->face[1].offset, -d);
    }
}

/// Nearest point of a triangle: its foot within the sides, else on a side that has x beyond it.
static void nearest_on(const clx_wall_triangle *t, const double x[3], double nearest[3])
{
    double from[3][3]; // x from each corner
    double least = INFINITY;
    for (int k = 0; k < 3; ++k) {
        v3_sub(from[k], x, t->corner[k]);
    }
    v3_axpy(nearest, x, -v3_dot(from[0], t->normal), t->normal);
    for (int k = 0; k < 3; ++k) {
        double side[3];
        double on[3];
        if (!(v3_dot(from[k], t->out[k]) > 0.0)) {
            continue;
        }
        v3_sub(side, t->corner[(k + 1) % 3], t->corner[k]);
        const double share = v3_dot(from[k], side) / v3_norm2(side);
        v3_axpy(on, t->corner[k], fmin(fmax(share, 0.0), 1.0), side);
        const double d = v3_distance2(on, x);
        if (d < least) {
            least = d;
            v3_copy(nearest, on);
        }
    }
}

/// A ball: the least move that parts them is along the line to the nearest point, however deep.
static bool ball_contact(const clx_wall_triangle *t, const clx_placed *body, double max_gap,
                         clx_contact *contact)
{
    double nearest[3];
    double n[3];
    nearest_on(t, body->position, nearest);
    v3_sub(n, body->position, nearest);
    const double distance = v3_norm(n);
    contact->gap = distance - body->shape->round;
    if (contact->gap > max_gap) {
        return false;
    }
    if (!v3_unit(contact->normal, n)) {
        v3_copy(contact->normal, t->normal);
    }
    v3_scale(contact->point, -0.5 * (distance + body->shape->round), contact->normal);
    return true;
}

bool clx_triangle_contact(const clx_wall_triangle *t, const clx_placed *body, double max_gap,
                          clx_warm_start *warm_start, clx_contact *contact)
{
    static const double unturned[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    if (body->shape->kind == CLX_CONVEX_SPHERE) {
        return ball_contact(t, body, max_gap, contact);
    }
    flat_hull h;
    make_hull(t, &h);
    const clx_convex wall = {.kind = CLX_CONVEX_HULL,
                             .core = &h.core,
                             .scale = 1.0,
                             .bounding_radius = t->bounding_radius};
    clx_pair pair = {body->shape, &wall, body->rotation, unturned, {0.0, 0.0, 0.0}};
    v3_sub(pair.offset, t->centroid, body->position);
    return clx_pair_contact(&pair, max_gap, warm_start, contact);
}

bool clx_triangle_owns(const clx_wall_triangle *t, const clx_placed *body,
                       const clx_contact *contact)
{
    double x[3]; // the witness on the triangle
    v3_axpy(x, contact->point, -0.5 * contact->gap, contact->normal);
    v3_add(x, x, body->position);
    const int behind = v3_dot(contact->normal, t->normal) < 0.0;
    for (int k = 0; k < 3; ++k) {
        double d[3];
        v3_sub(d, x, t->corner[k]);
        const bool is_on = v3_dot(d, t->out[k]) > -ON_SIDE * t->bounding_radius;
        if (is_on && v3_dot(contact->normal, t->out[k]) > t->tilt[k][behind] + ON_SIDE) {
            return false;
        }
    }
    return true;
}

void clx_triangle_face_contact(const clx_wall_triangle *t, const clx_placed *body,
                               clx_contact *contact)
{
    double d[3];
    double plane[4];
    v3_sub(d, body->position, t->centroid);
    v3_scale(plane, v3_dot(d, t->normal) < 0.0 ? -1.0 : 1.0, t->normal);
    plane[3] = v3_dot(plane, t->centroid);
    clx_plane_contact(body, plane, NULL, contact);
}

/// Whether the foot of a body's deepest point is on the triangle, or beyond sides over which the
/// surface goes on: flat by no more than the body is deep, hollow by ten times that, as there it
/// is beyond the neighbour, too.
static bool has_foot(const clx_wall_triangle *t, const clx_placed *body, const clx_contact *face)
{
    double foot[3];
    double nearest[3];
    double beyond = 1.0;
    const int behind = v3_dot(face->normal, t->normal) < 0.0;
    v3_add(foot, face->point, body->position);
    v3_sub(nearest, foot, t->corner[0]);
    v3_axpy(foot, foot, -v3_dot(nearest, t->normal), t->normal);
    for (int k = 0; k < 3; ++k) {
        double d[3];
        v3_sub(d, foot, t->corner[k]);
        if (v3_dot(d, t->out[k]) > ON_SIDE * t->bounding_radius) {
            if (t->tilt[k][behind] > ON_SIDE) {
                return false;
            }
            beyond = t->tilt[k][1 - behind] > ON_SIDE ? 10.0 : beyond;
        }
    }
    nearest_on(t, foot, nearest);
    return v3_distance(nearest, foot) <= ON_SIDE * t->bounding_radius - beyond * face->gap;
}

bool clx_triangle_face_acts(const clx_wall_triangle *t, const clx_placed *body,
                            const clx_contact *least, int32_t n, const clx_contact *owner,
                            clx_contact *face)
{
    if (body->shape->kind == CLX_CONVEX_SPHERE) { // its nearest points are those of the surface
        return false;
    }
    clx_triangle_face_contact(t, body, face);
    if (!(face->gap < 0.0) || face->gap < DEEPEST * least->gap) {
        return false;
    }
    clx_placed moved = *body;
    for (int32_t i = 0; i < n; ++i) {
        if (v3_dot(owner[i].normal, face->normal) > SAME_PUSH) {
            return false;
        }
        v3_axpy(moved.position, moved.position, -owner[i].gap, owner[i].normal);
    }
    if (n == 0) {
        return has_foot(t, body, face);
    }
    clx_contact left;
    if (!clx_triangle_contact(t, &moved, 0.0, NULL, &left) || !(left.gap < ON_SIDE * least->gap)) {
        return false;
    }
    clx_triangle_face_contact(t, &moved, &left);
    return left.gap < 0.0 && has_foot(t, &moved, &left);
}

/// Squared distance of a point from a node's box.
static double box_distance2(const clx_tree_node *node, const double x[3])
{
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double d = fmax(fmax(node->low[k] - x[k], x[k] - node->high[k]), 0.0);
        sum += d * d;
    }
    return sum;
}

int32_t clx_wall_mesh_near(const clx_wall_mesh *wall, const double point[3], double cutoff,
                           int32_t cap, int32_t *tri)
{
    CLAST_ASSERT(cap >= 0);
    int32_t stack[CLX_TREE_DEPTH + 1];
    int32_t n_stack = 0;
    int32_t n = 0;
    stack[n_stack++] = 0;
    while (n_stack > 0) {
        const int32_t i = stack[--n_stack];
        const clx_tree_node *node = &wall->tree.node[i];
        if (box_distance2(node, point) > cutoff * cutoff) {
            continue;
        }
        if (node->right != 0) {
            stack[n_stack++] = node->right;
            stack[n_stack++] = i + 1;
            continue;
        }
        for (int32_t k = node->first; k < node->first + node->count; ++k) {
            const clx_wall_triangle *t = &wall->tri[wall->tree.item[k]];
            if (v3_distance2(t->centroid, point) <=
                (cutoff + t->bounding_radius) * (cutoff + t->bounding_radius)) {
                if (n < cap) {
                    tri[n] = wall->tree.item[k];
                }
                ++n;
            }
        }
    }
    return n;
}

/// False for a triangle without area.
static bool measure_triangle(const clast_mesh *mesh, int32_t number, clx_wall_triangle *t)
{
    double e[3], f[3], n[3];
    const int32_t *v = mesh->tri[number];
    *t = (clx_wall_triangle){.bounding_radius = 0.0};
    for (int k = 0; k < 3; ++k) {
        v3_copy(t->corner[k], mesh->vert[v[k]]);
        v3_axpy(t->centroid, t->centroid, 1.0 / 3.0, t->corner[k]);
    }
    v3_sub(e, t->corner[1], t->corner[0]);
    v3_sub(f, t->corner[2], t->corner[0]);
    v3_cross(n, e, f);
    if (!(v3_norm2(n) > 1e-24 * v3_norm2(e) * v3_norm2(f)) || !v3_unit(t->normal, n)) {
        return false;
    }
    for (int k = 0; k < 3; ++k) {
        t->bounding_radius = fmax(t->bounding_radius, v3_distance(t->corner[k], t->centroid));
        v3_sub(e, t->corner[(k + 1) % 3], t->corner[k]);
        v3_cross(t->out[k], e, t->normal);
        (void)v3_unit(t->out[k], t->out[k]);
    }
    return true;
}

/// How far pushes may lean over each side, from the neighbours' planes.
static void measure_tilts(const clast_mesh *mesh, const clx_topology *topology, int32_t number,
                          clx_wall_triangle *t)
{
    CLAST_ASSERT(number >= 0 && number < mesh->n_tri);
    for (int k = 0; k < 3; ++k) {
        clx_wall_triangle other;
        const int32_t half = 3 * number + k;
        const int32_t twin = clx_half_twin(topology, half);
        t->tilt[k][0] = t->tilt[k][1] = 1.0;
        if (twin < 0 || !measure_triangle(mesh, twin / 3, &other)) {
            continue;
        }
        const bool is_consistent = clx_half_from(mesh, half) == clx_half_to(mesh, twin);
        const double lean = (is_consistent ? 1.0 : -1.0) * v3_dot(other.normal, t->out[k]);
        const double alike = (is_consistent ? 1.0 : -1.0) * v3_dot(other.normal, t->normal);
        t->tilt[k][0] = lean > 0.0 && alike < 0.0 ? 1.0 : fmax(lean, 0.0);
        t->tilt[k][1] = lean < 0.0 && alike < 0.0 ? 1.0 : fmax(-lean, 0.0);
    }
}

static clast_status build_tree(clx_wall_mesh *wall)
{
    clast_status status = CLAST_OK;
    clx_tree_box *box = NULL;
    CLX_TRY(clx_alloc(&box, wall->n_tri, sizeof *box));
    for (int32_t i = 0; i < wall->n_tri; ++i) {
        const clx_wall_triangle *t = &wall->tri[i];
        box[i].item = i;
        for (int k = 0; k < 3; ++k) {
            box[i].low[k] = fmin(t->corner[0][k], fmin(t->corner[1][k], t->corner[2][k]));
            box[i].high[k] = fmax(t->corner[0][k], fmax(t->corner[1][k], t->corner[2][k]));
        }
    }
    CLX_TRY(clx_tree_build(box, wall->n_tri, LEAF, &wall->tree));
done:
    clx_free(box);
    return status;
}

/// Farthest that a corner may be: squares of areas are numbers up to there.
static const double FARTHEST = 1e70;

/// A triangle without a place for each corner would be left out as one without area, and be a hole.
static clast_status check_vertices(const clast_mesh *mesh)
{
    clast_status status = CLAST_OK;
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            const double *x = mesh->vert[mesh->tri[t][k]];
            CLX_CHECK(fabs(x[0]) <= FARTHEST && fabs(x[1]) <= FARTHEST && fabs(x[2]) <= FARTHEST,
                      CLAST_E_GEOMETRY, "vertex %d of a wall is no valid position: %g, %g, %g",
                      mesh->tri[t][k] + 1, x[0], x[1], x[2]);
        }
    }
done:
    return status;
}

clast_status clx_wall_mesh_create(const clast_mesh *mesh, clx_wall_mesh **wall)
{
    clast_status status = CLAST_OK;
    clx_wall_mesh *made = NULL;
    clx_topology topology = {0};
    CLX_TRY(check_vertices(mesh));
    CLX_TRY(clx_topology_build(mesh, &topology));
    CLX_TRY(clx_alloc(&made, 1, sizeof *made));
    CLX_TRY(clx_alloc(&made->tri, mesh->n_tri, sizeof *made->tri));
    for (int32_t i = 0; i < mesh->n_tri; ++i) {
        clx_wall_triangle *t = &made->tri[made->n_tri];
        if (measure_triangle(mesh, i, t)) {
            measure_tilts(mesh, &topology, i, t);
            made->n_tri += 1;
        }
    }
    CLX_CHECK(made->n_tri > 0, CLAST_E_GEOMETRY, "none of the wall's %d triangles has an area",
              mesh->n_tri);
    CLX_TRY(build_tree(made));
    *wall = made;
    made = NULL;
done:
    clx_wall_mesh_destroy(made);
    clx_topology_free(&topology);
    return status;
}

void clx_wall_mesh_destroy(clx_wall_mesh *wall)
{
    if (wall != NULL) {
        clx_free(wall->tri);
        clx_tree_free(&wall->tree);
        clx_free(wall);
    }
}
