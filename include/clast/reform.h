#pragma once
#include <clast/mesh.h>

CLAST_BEGIN

// Form taken off a grain and put on again: stretching along the principal axes changes L, I and S
// of the mass-equivalent ellipsoid exactly, and nothing else of the shape's character.
//                    [docs/theory/grading.md; Rettinger2022 section 3.2, fig. 5 and appendix A]
//
// A grain keeps its hand: axes are right-handed and never mirrored. Their signs follow the shape's
// skewness (third moments along L and I are positive), so that the same grain in another position
// gives the same mesh.

/// The grain with its centroid at the origin, L along x, I along y and S along z, unstretched.
///
/// @param mesh  closed and outward      @param out  empty; filled on success
/// @param lis   full axes L >= I >= S of the mass-equivalent ellipsoid, in the mesh's unit
/// @return CLAST_E_GEOMETRY if the volume is not positive or the solid has no such ellipsoid
CLAST_API clast_status clast_reform_principal(const clast_mesh *mesh, clast_mesh *out,
                                              double lis[3]);

/// The same stretched to these lengths L >= I >= S > 0; measured ones agree within 1e-13 for grains
/// of S/L > 0.03. L = I = S = 1 takes all form and size off: such a mesh, its vertices multiplied
/// by (L, I, S), has any form.
///
/// @return CLAST_E_CONFIG for lengths that are not finite, not positive or not in order
CLAST_API clast_status clast_reform_mesh(const clast_mesh *mesh, const double lis[3],
                                         clast_mesh *out);

/// Convex hull of at most this many triangles: the hull, simplified at constant volume where it has
/// more, and the hull of that, for simplifying leaves faces that bend inwards by little.
///
/// @param mesh    any vertices; triangles are not looked at
/// @param n_face  >= 4
/// @return as clast_mesh_hull and clast_mesh_simplify
CLAST_API clast_status clast_reform_hull(const clast_mesh *mesh, int32_t n_face, clast_mesh *out);

CLAST_END
