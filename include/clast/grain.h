#pragma once
#include <clast/form.h>
#include <clast/mesh.h>
#include <clast/shape.h>

CLAST_BEGIN

// What can be measured on one grain. Lengths in the surface's own unit; density 1.

/// Definitions of the dimensions L >= I >= S: X(identifier, name, what is measured, source).
/// Tools disagree about elongation mostly because they use different ones.
#define CLAST_AXES_LIST(X)                                                                         \
    X(ELLIPSOID, "ellipsoid",                                                                      \
      "full axes of the ellipsoid with the grain's volume and moments of inertia",                 \
      "Rettinger2022 eqs 25-27; Stueckrath2006")                                                   \
    X(BOX, "box",                                                                                  \
      "edges of the least box found around the grain: no turn about one of its axes makes it "     \
      "smaller, an upper bound of the least volume",                                               \
      "Zingg1935; Blott2008")                                                                      \
    X(FITTED, "fitted",                                                                            \
      "longest caliper; longest caliper at right angles to it; width at right angles to both",     \
      "Bagheri2015, standard protocol")                                                            \
    X(FERET, "feret",                                                                              \
      "longest caliper; longest caliper at right angles to it; shortest caliper, wherever it is",  \
      "Feret1930; Blott2008")                                                                      \
    X(PRINCIPAL, "principal", "widths along the principal axes of inertia, longest first",         \
      "Blott2008")

#define CLAST_AXES_ENUM(id, name, what, source) CLAST_AXES_##id,
typedef enum { CLAST_AXES_LIST(CLAST_AXES_ENUM) CLAST_N_AXES } clast_axes_kind;
#undef CLAST_AXES_ENUM

enum {
    CLAST_ROUNDNESS_FACES = 1000, ///< surfaces of fewer triangles have too coarse an outline
    CLAST_ROUNDNESS_EDGES = 60    ///< so have outlines of fewer edges     [docs/theory/form.md]
};

/// L, I, S by one definition and their unit directions ([0] belongs to L).
typedef struct clast_axes {
    double lis[3];
    double direction[3][3];
} clast_axes;

/// Measures of a grain; plain numbers, nothing to free.
typedef struct clast_grain {
    double volume, area;
    double centroid[3];
    double inertia[3][3]; ///< about the centroid
    double moments[3];    ///< principal, rising: about the long, the middle and the short axis
    clast_axes axes[CLAST_N_AXES];
    double hull_volume, hull_area;
    double longest, shortest; ///< greatest and least caliper (Feret diameter)
    double sphericity;        ///< Wadell's: (36 pi V^2)^(1/3) / A           [Wadell1932]
    double convexity;         ///< V / V of the convex hull
    double roundness;  ///< Wadell's: mean radius of the corners of the outline of the greatest
                       ///< shadow by that of the greatest circle inside; NaN where the outline
                       ///< is too coarse                  [Wadell1932; ZhengHryciw2015]
    int32_t n_outline; ///< edges of that outline; 0: not looked at (below 1000 triangles)
    double normal_roundness; ///< mean over the surface of cos(normal, ray from the centroid), 1 for
                             ///< a sphere                               [BullardGarboczi2013]
    double angularity;      ///< mean over all rays from the centroid of |r - r_e| / r_e, r_e of the
                            ///< mass-equivalent ellipsoid: the radius method in 3-D  [Masad2001]
    double projected_mean;  ///< shadow of the hull, mean of all directions: hull_area / 4 (Cauchy)
    double projected_least; ///< local optimum, at least as good as all face normals
    double projected_greatest;
    double hull_volume_added; ///< V of the hull / V - 1
} clast_grain;

/// Measures the solid bounded by a closed outward surface.      [docs/theory/form.md]
///
/// Volume, area, inertia, sphericity, roundness, angularity and the ellipsoid are those of the
/// surface; calipers, boxes and shadows are those of its convex hull, which are the same. Feret
/// diameters are exact; the box is one that no turn about one of its axes makes smaller.
///
/// @param mesh   closed and outward, any number of parts; several parts count as one grain
/// @param grain  written only on success
/// @return CLAST_E_GEOMETRY for open, inconsistently oriented, inside-out and flat surfaces, with
///         counts and what to do
/// @note O(n log n) expected
CLAST_API clast_status clast_grain_measure(const clast_mesh *mesh, clast_grain *grain);

/// The same for the convex hull of the surface's vertices, which may be open or have no triangles;
/// hull_volume_added is that of the surface given where it is closed, else NaN.
CLAST_API clast_status clast_grain_measure_hull(const clast_mesh *mesh, clast_grain *grain);

/// Measures of a union of spheres (a clump), overlaps counted once.
///
/// Closed forms: volume, area, centroid, inertia, ellipsoid, principal widths, the longest caliper
/// (L of `fitted` and `feret`, too), sphericity, volume of the hull and convexity. NaN: what only a
/// polyhedron has here, the other calipers, boxes, shadows, hull_area, roundness and angularity.
///
/// @return CLAST_E_GEOMETRY if there is no sphere or one is not positive and finite
/// @note O(n^2)
CLAST_API clast_status clast_grain_measure_clump(const clast_spheres *spheres, clast_grain *grain);

/// Name ("ellipsoid"), definition and source of a definition of L, I, S; NULL beyond the last.
CLAST_API const char *clast_axes_name(int32_t axes);
CLAST_API const char *clast_axes_definition(int32_t axes);
CLAST_API const char *clast_axes_source(int32_t axes);

/// Multiplies all lengths by a factor > 0: a grain measured in mm becomes one in metres with 1e-3.
CLAST_API void clast_grain_scale(clast_grain *grain, double factor);

CLAST_END
