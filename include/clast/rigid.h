#pragma once
#include <clast/assembly.h>

CLAST_BEGIN

typedef struct clast_rigid_options {
    bool hull;     ///< take the convex hull of every surface; else surfaces are convex
    int32_t faces; ///< above 0: take hulls of at most so many triangles
} clast_rigid_options;

/// One rigid grain of an assembly's grains: spheres, ellipsoids, clumps (sphere by sphere) and
/// convex surfaces, which are its parts.
///
/// Volume, centroid and inertia are those of the union: the sum over parts, less what lies in
/// several, which is integrated over 262,144 lines along x (exact along each, an even lattice
/// across; error below 2e-4 of what is in common). Parts that only touch are summed exactly.
/// `shape->own` has the mean density and, where densities differ, centre of mass and inertia; what
/// several parts have in common is of the first of them (a core keeps its place in its coating).
///                                                              [docs/theory/dem.md "Rigid grains"]
///
/// @param shape  empty; a mesh of the parts' surfaces (curved ones by 320 triangles of their
///               volume) with its `parts`
/// @param added  volume of hulls over that of the surfaces, less 1, summed over the surfaces; NAN
///               without surfaces; may be NULL
/// @return CLAST_E_GEOMETRY for no grain, or a surface without volume
CLAST_API clast_status clast_assembly_rigid(const clast_assembly *assembly, const char *name,
                                            const clast_rigid_options *options, clast_shape *shape,
                                            double *added);

CLAST_END
