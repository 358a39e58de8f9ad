#pragma once
// Walls of cylinders, half pipes, spheres and closed surfaces, as straight paths meet them.
#include "base/status.h"
#include <clast/cloud.h>

/// Where a path leaves a domain.
typedef struct clx_exit {
    double share;     ///< of the path
    double at[3];     ///< there, 1e-9 of the domain's size inside
    double inward[3]; ///< unit normal; 0 where it is not known (a domain of the caller's map)
} clx_exit;

/// First point at which the path from a point inside leaves; false: it does not.
bool clx_walls_exit(const clast_domain *domain, const double from[3], const double to[3],
                    clx_exit *exit);

/// Whether a place on a wall, of a box too, is floor: straight down leads out of the domain there.
CLX_SHARED bool clx_walls_is_floor(const clast_domain *domain, const double at[3]);

/// Walls that clx_walls_distance tells apart; 0 of a box and of a caller's map.
int32_t clx_walls_count(const clast_domain *domain);

/// Distance of a point inside from wall w, >= 0, and the nearest point of that wall, a little
/// inside. Of a closed surface all is one wall.
double clx_walls_distance(const clast_domain *domain, const double x[3], int32_t w, double at[3]);
