#pragma once
// The tree that first-touch search walks: triangles of a surface or spheres of a composite, built
// once per shape and used for every placed copy at any scale and orientation.
#include "contact/touch_body.h"
#include "geom/tree.h"
#include <clast/mesh.h>

/// Bound of a node: the part of a ball between two planes. Turning it costs two products with a
/// matrix, and on a smooth surface the slab is thin as the square of the ball's radius, so that
/// facing patches are told apart early. 80 bytes.
typedef struct clx_touch_node {
    double centre[3];
    double radius;
    double axis[3]; ///< unit normal of the slab
    double half;    ///< everything lies within this distance of the plane through the centre;
                    ///< radius where there is no slab
    int32_t right;  ///< right child; 0 marks a leaf. The left child of node i is i + 1
    int32_t item;   ///< of a leaf
} clx_touch_node;

struct clx_touch_tree {
    clx_touch_kind kind; ///< CLX_TOUCH_MESH or CLX_TOUCH_SPHERES
    int32_t n_item;
    int32_t n_node;       ///< 2 n_item - 1
    clx_touch_node *node; ///< [n_node] root first
    double (*corner)[9];  ///< mesh: [n_item] the three corners of each triangle, in leaf order
    double (*ball)[4];    ///< spheres: [n_item] centre and radius, in leaf order
    int32_t n_probe;
    double (*probe)[3]; ///< [n_probe] a point of every connected part of the surface, or every
                        ///< sphere's centre
    double radius;      ///< everything lies within this distance of the origin
    double low[3];      ///< box
    double high[3];
};

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
