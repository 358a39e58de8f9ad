#pragma once
// The tree that first-touch search walks: triangles of a surface or spheres of a composite, built
// once per shape and used for every placed copy at any scale and orientation.
#include "geom/tree.h"
#include "touch/body.h"
#include <clast/mesh.h>

enum { CLX_TOUCH_LANES = 4 };

/// A node of up to four children with a bound each, lane by lane, so that four bounds are computed
/// at once. A bound is the part of a ball between two planes: turning it costs two products with a
/// matrix, and on a smooth surface it is thin as the square of its radius, so that facing patches
/// are told apart early. 320 bytes.
typedef struct clx_touch_node {
    double centre[3][CLX_TOUCH_LANES];
    double axis[3][CLX_TOUCH_LANES]; ///< unit normal of the planes
    double radius[CLX_TOUCH_LANES];
    double half[CLX_TOUCH_LANES];   ///< distance of the planes from the centre; radius: no planes
    double rim[CLX_TOUCH_LANES];    ///< sqrt(radius^2 - half^2)
    int32_t child[CLX_TOUCH_LANES]; ///< > 0: number of a node; <= 0: leaf, minus the item's number
    int32_t n;                      ///< lanes in use, from the first; the others' centres are NAN
    int32_t unused[3];
} clx_touch_node;

struct clx_touch_tree {
    clx_touch_kind kind; ///< CLX_TOUCH_MESH or CLX_TOUCH_SPHERES
    int32_t n_item;
    int32_t n_node;
    clx_touch_node *node; ///< [n_node]; node 0 has one lane: the bound of everything
    double (*corner)[9];  ///< mesh: [n_item] the three corners of each triangle, in leaf order
    double (*ball)[4];    ///< spheres: [n_item] centre and radius, in leaf order
    int32_t n_probe;
    double (*probe)[3]; ///< [n_probe] a point of every connected part of the surface, or every
                        ///< sphere's centre
    double radius;      ///< everything lies within this distance of the origin
    double low[3];      ///< box
    double high[3];
};

/// A lane of a node, as one number.
static inline int32_t clx_touch_slot(int32_t node, int32_t lane)
{
    return CLX_TOUCH_LANES * node + lane;
}

/// What stands below a slot: > 0 a node, <= 0 minus an item.
static inline int32_t clx_touch_child(const clx_touch_tree *tree, int32_t slot)
{
    return tree->node[slot / CLX_TOUCH_LANES].child[slot % CLX_TOUCH_LANES];
}

/// A depth-first walk that opens one slot at a time into at most four never has more than this many
/// waiting (with room to write four at once); a walk over pairs never more than twice as many.
enum { CLX_TOUCH_STACK = (CLX_TOUCH_LANES - 1) * (CLX_TREE_DEPTH + 1) + CLX_TOUCH_LANES };

/// Copies what it needs. Slivers and triangles of no area are kept: they are touched as segments or
/// points.
///
/// @return CLAST_E_GEOMETRY without triangles, for vertex numbers out of range or vertices that are
/// not finite
clast_status clx_touch_tree_mesh(const clast_mesh *mesh, clx_touch_tree **tree);

/// The same for n spheres.
///
/// @return CLAST_E_GEOMETRY for n < 1, or spheres that are not finite or have no radius
clast_status clx_touch_tree_spheres(int32_t n, double (*centre)[3], const double *radius,
                                    clx_touch_tree **tree);

void clx_touch_tree_destroy(clx_touch_tree *tree); ///< NULL is allowed
