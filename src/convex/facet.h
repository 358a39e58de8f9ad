#pragma once
// Facets of the difference A - B of two hulls, by the features they come from: followed from one
// query to the next, and proved to be the closest.
#include "convex/convex.h"

typedef enum {
    CLX_FACET_NONE,
    CLX_FACET_FACE_VERTEX, ///< face i of a, vertex j of b
    CLX_FACET_VERTEX_FACE, ///< vertex i of a, face j of b
    CLX_FACET_EDGE_EDGE    ///< edge i of a, edge j of b
} clx_facet_kind;

typedef struct clx_facet {
    clx_facet_kind kind;
    int32_t i, j;
} clx_facet;

/// From a facet near the closest one to the closest: true if that is found and proved, false if
/// the closest feature is no facet, or cannot be proved from near by (deep overlap). The contact is
/// of the shapes without rounding.
///
/// The walk goes from facet to facet, over the side beyond which the foot of the perpendicular
/// falls; the gap then grows in every step. A foot inside the facet is the answer for bodies that
/// are apart; for overlap see docs/theory/contact-convex.md eq. 8-10.
///
/// @param margin  least distance of the foot from the facet's sides [m]
bool clx_facet_follow(const clx_pair *pair, clx_facet *facet, clx_contact *contact, double *margin);

/// Writes the facet, which holds now, into the warm start: what is needed to evaluate it again and
/// how far the bodies may turn and slip until it must be proved anew.
void clx_facet_remember(const clx_pair *pair, const clx_facet *facet, clx_warm_start *warm_start);

/// The contact of the warm start's facet (without rounding); false unless it surely still is the
/// closest.
bool clx_facet_again(const clx_pair *pair, const clx_warm_start *warm_start, clx_contact *contact);

/// The facet that three points of A - B name: vertices of a and of b, and its normal from b to a
/// (world). NONE if they name no facet.
clx_facet clx_facet_of(const clx_pair *pair, int32_t vert[2][3], const double normal[3]);
