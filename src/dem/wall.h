#pragma once
// Walls of the domain: planes and the cylinder.

typedef enum { CLX_WALL_PLANE, CLX_WALL_CYLINDER } clx_wall_kind;

typedef struct clx_wall {
    clx_wall_kind kind;
    double normal[3]; ///< into the domain
    double offset;    ///< plane: n.x of its points
    double radius;    ///< cylinder about the z axis
} clx_wall;

/// Signed distance of a point from a wall, > 0 inside; the wall's normal there, into the domain.
double clx_wall_distance(const clx_wall *wall, const double x[3], double normal[3]);
