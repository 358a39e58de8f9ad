#pragma once
// Grains against a container's triangles. A triangle is a wall with a number of its own, after the
// planes and the cylinder, so that every pair has its own contact history; which triangles touch is
// decided for all of an item's triangles at once.
#include "dem/touch.h"

enum { CLX_CONTAINER_TOUCHES = 16 };

/// The triangles of all surfaces, where they are now.
typedef struct clx_container {
    int32_t n_tri;
    clx_wall_triangle *tri; ///< [n_tri]
    int32_t *owner;         ///< [n_tri] surface of each: dem->walls.body[n_wall + owner]
} clx_container;

void clx_container_destroy(clx_container *container); ///< NULL is allowed

typedef struct clx_container_touch {
    clx_dem_touch touch;
    int64_t pair;
} clx_container_touch;

static inline bool clx_pair_is_container(const clast_dem *dem, const clx_dem_pair *pair)
{
    return pair->b < -dem->n_wall;
}

static inline const clx_wall_triangle *clx_pair_triangle(const clast_dem *dem,
                                                         const clx_dem_pair *pair)
{
    return &dem->container->tri[-1 - pair->b - dem->n_wall];
}

/// Which triangles an item touches now: of contacts within 25 degrees the deepest stands for all,
/// none leans over an edge farther than the neighbour's plane (convex/wall_mesh.h). The history
/// goes with the contact from triangle to triangle. Marks the pairs; at most CLX_CONTAINER_TOUCHES.
int32_t clx_container_meet(clast_dem *dem, int32_t i,
                           clx_container_touch touch[CLX_CONTAINER_TOUCHES]);

/// Finds pairs of a stale item with the triangles about it.
clast_status clx_container_find(clast_dem *dem, int32_t i);
