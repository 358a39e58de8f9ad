#pragma once
#include <clast/shape.h>

CLAST_BEGIN

/// Placed shapes: what aggregates and packings end as. Grain i is shape[shape_id[i]] scaled,
/// turned, moved: x_world = position + scale * R(orientation) * x_shape.
typedef struct clast_assembly {
    int32_t n_shape;
    clast_shape *shape; ///< [n_shape] owned
    int32_t n_grain;
    int32_t *shape_id;        ///< [n_grain]
    double (*position)[3];    ///< [n_grain][3] m, centroid
    double (*orientation)[4]; ///< [n_grain][4] unit quaternion w, x, y, z
    double *scale;            ///< [n_grain] > 0
    double *density;          ///< [n_grain] kg/m3
    int64_t *id;              ///< [n_grain] the grain's name, unique
    int32_t n_contact;
    int32_t (*contact)[2];      ///< [n_contact][2] grain indices, or NULL when not known
    double (*contact_point)[3]; ///< [n_contact][3] m, with contact
    char unit[16]; ///< length unit of the coordinates: "m", or "model" when the input had none
    int32_t grain_capacity;   ///< grains the arrays have room for; 0 if made by hand
    int32_t contact_capacity; ///< the same for contacts
} clast_assembly;

/// Frees all arrays and shapes; may be called twice.
CLAST_API void clast_assembly_free(clast_assembly *assembly);

/// Deep copy into an empty assembly.
CLAST_API clast_status clast_assembly_copy(const clast_assembly *assembly, clast_assembly *copy);

/// Adds a copy of a shape; its number goes to *shape_id (may be NULL). CLAST_E_USAGE if the name is
/// taken.
CLAST_API clast_status clast_assembly_add_shape(clast_assembly *assembly, const clast_shape *shape,
                                                int32_t *shape_id);

/// Adds a grain with id = its index; amortised O(1).
///
/// @return CLAST_E_USAGE if the shape is unknown, position or scale are not finite, scale or
/// density are not positive or the quaternion's length is off 1 by more than 1e-9
CLAST_API clast_status clast_assembly_add_grain(clast_assembly *assembly, int32_t shape_id,
                                                const double position[3],
                                                const double orientation[4], double scale,
                                                double density);

/// Adds a contact between two grains at a world point; CLAST_E_USAGE unless both exist and differ.
CLAST_API clast_status clast_assembly_add_contact(clast_assembly *assembly, int32_t i, int32_t j,
                                                  const double point[3]);

/// Sum of the grains' own volumes (overlaps counted twice).
CLAST_API double clast_assembly_volume(const clast_assembly *assembly);

/// Sum of volume times density [kg].
CLAST_API double clast_assembly_mass(const clast_assembly *assembly);

/// Centre of mass by the grains' own volumes and densities; (0, 0, 0) without grains.
CLAST_API void clast_assembly_centre(const clast_assembly *assembly, double centre[3]);

/// Box of all grains' true surfaces (exact for spheres, ellipsoids, clumps and meshes); low > high
/// without grains.
CLAST_API void clast_assembly_bounds(const clast_assembly *assembly, double low[3], double high[3]);

/// Surface of grain i in world coordinates, appended to `mesh` (spheres and ellipsoids by an
/// icosphere of `level`).
CLAST_API clast_status clast_assembly_grain_surface(const clast_assembly *assembly, int32_t i,
                                                    int level, clast_mesh *mesh);

CLAST_END
