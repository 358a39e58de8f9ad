#pragma once
// Clouds of known density and the exact integral of its square: what events of a decomposition are
// measured against.
#include "math/rng.h"

#include <clast/cloud.h>

typedef enum { PLACE_BOX, PLACE_CYLINDER, PLACE_SURFACE, N_PLACE } density_place;

typedef enum {
    LAW_UNIFORM,
    LAW_BLOB,    ///< normal about a point
    LAW_SHEET,   ///< normal about a plane (2-D: a line) across the last axis
    LAW_LINE,    ///< normal about a line along the last axis
    LAW_FRAME,   ///< uniform within `size` of the walls
    LAW_PLUME,   ///< normal about the last axis z, variance size^2 + 0.01 z
    LAW_POWER,   ///< x^-size along each axis
    LAW_CASCADE, ///< multiplicative: `size` halvings, shares of the parts of a box in random order
    LAW_INERTIA  ///< advected with inertia in a synthetic turbulent flow, smoothed by size
} density_law;

/// A share of the points obeys the law, the others are uniform.
typedef struct density {
    const char *name;
    density_law law;
    double share, size;
} density;

enum { N_DENSITY = 22 };
extern const density densities[N_DENSITY];

/// A density in a place, made ready. The box is the unit square or cube; the cylinder has diameter
/// and length 1; the closed surface is the unit cube turned about all axes.
typedef struct density_scene {
    const density *density;
    density_place place;
    int32_t dimension;
    clast_domain domain;
    double integral; ///< of the squared density over the domain
    double *pool;    ///< [n_pool][dimension] of LAW_INERTIA
    int64_t n_pool;
} density_scene;

/// Whether the law is defined there: cylinders and surfaces are 3-D, a sheet is a line in 2-D.
bool density_fits(const density *law, density_place place, int32_t dimension);
clast_status density_scene_make(const density *law, density_place place, int32_t dimension,
                                density_scene *scene);
void density_scene_free(density_scene *scene);

/// A Poisson number of points of this mean, the same for the same seed.
clast_status density_scene_draw(const density_scene *scene, double mean_n, uint64_t seed,
                                clast_cloud *cloud);
