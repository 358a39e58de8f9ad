#pragma once
// Walls of triangles: the surface of a container, or of anything fixed. Triangles push from both
// sides, away from the side on which the body is.
#include "convex/convex.h"
#include "geom/tree.h"

/// One triangle made ready.
typedef struct clx_wall_triangle {
    double corner[3][3];
    double normal[3];
    double out[3][3];  ///< unit, in the plane, out over side k (from corner k to k + 1)
    double tilt[3][2]; ///< most that a push may lean over side k (sine), from the normal's side and
                       ///< from behind: 0 where the surface is flat or hollow, 1 at a free edge
                       ///< and where the neighbour's plane is turned by more than a right angle
    double centroid[3];
    double bounding_radius; ///< of the corners from the centroid
} clx_wall_triangle;

typedef struct clx_wall_mesh {
    int32_t n_tri;
    clx_wall_triangle *tri; ///< [n_tri]; triangles without area are left out
    clx_tree tree;          ///< item i of the tree is triangle tree.item[i]
} clx_wall_mesh;

/// @return CLAST_E_GEOMETRY if no triangle has an area
clast_status clx_wall_mesh_create(const clast_mesh *mesh, clx_wall_mesh **wall);
void clx_wall_mesh_destroy(clx_wall_mesh *wall); ///< NULL is allowed

/// Triangles that come within `cutoff` of a point: how many there are; the first `cap` of them, in
/// the tree's order, are in tri.
int32_t clx_wall_mesh_near(const clx_wall_mesh *wall, const double point[3], double cutoff,
                           int32_t cap, int32_t *tri);

/// Contact of a body with one triangle as if it stood alone. False if the gap surely exceeds
/// max_gap; contact->gap is then a lower bound. `warm_start` as for pairs, or NULL.
bool clx_triangle_contact(const clx_wall_triangle *triangle, const clx_placed *body, double max_gap,
                          clx_warm_start *warm_start, clx_contact *contact);

/// Whether a contact with this triangle belongs to it on the surface: not where the push leans
/// farther over a shared edge than the neighbour's plane, which is then the one to push. Without
/// this rule a body that slides over a flat floor of triangles trips over their edges.
bool clx_triangle_owns(const clx_wall_triangle *triangle, const clx_placed *body,
                       const clx_contact *contact);

/// Push along the triangle's own normal, away from the side of the body's position, as deep as the
/// body reaches beyond its plane.
void clx_triangle_face_contact(const clx_wall_triangle *triangle, const clx_placed *body,
                               clx_contact *contact);

/// Whether a triangle that overlaps a body, and does not own its least move, pushes along its own
/// normal all the same: no owner pushes that way, the body moved by all owners' pushes overlaps it
/// yet, and the body's deepest point is over it or, where the surface goes on flat or hollow, no
/// farther beyond than it is deep.
///
/// @param body  its shape and turn    @param least  the triangle's own least move
/// @param owner  [n] contacts of the triangles that own theirs    @param face  out
bool clx_triangle_face_acts(const clx_wall_triangle *triangle, const clx_placed *body,
                            const clx_contact *least, int32_t n, const clx_contact *owner,
                            clx_contact *face);
