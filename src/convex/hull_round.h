#pragma once
// A hull with an ellipsoid or a sphere, by the feature of the hull that is nearest.
#include "convex/convex.h"

/// Contact of a hull with an ellipsoid or a sphere, in either order, without rounding (a sphere is
/// a point). False if it is not found, or not proved: deep overlap; the contact is then untouched.
///
/// The walk goes from the warm start's feature (face, edge, vertex) to the neighbour towards which
/// the foot or the normal points, until neither leaves it. [docs/theory/contact-convex.md eq. 15]
///
/// @param warm_start  of this pair; the feature and the normal are stored in it
bool clx_hull_round_contact(const clx_pair *pair, clx_warm_start *warm_start, clx_contact *contact);
