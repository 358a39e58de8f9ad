// Walls of the domains.
#include "dem/dem.h"

static void add_plane(clast_dem *dem, int axis, double sign, double place)
{
    CLAST_ASSERT(dem->n_wall >= 0 && dem->n_wall < CLX_MAX_WALL);
    clx_wall wall = {.kind = CLX_WALL_PLANE};
    wall.normal[axis] = sign;
    wall.offset = sign * place;
    dem->wall[dem->n_wall++] = wall;
}

void clx_dem_build_walls(clast_dem *dem)
{
    const clast_dem_config *c = &dem->config;
    const double side[2] = {c->width, c->depth > 0.0 ? c->depth : c->width};
    dem->n_wall = 0;
    if (c->floor) {
        add_plane(dem, 2, 1.0, 0.0);
    }
    if (c->lid) {
        add_plane(dem, 2, -1.0, c->height);
    }
    for (int k = 0; k < 2; ++k) {
        dem->period[k] = c->domain == CLAST_DEM_PERIODIC ? side[k] : 0.0;
        dem->inverse_period[k] = c->domain == CLAST_DEM_PERIODIC ? 1.0 / side[k] : 0.0;
        if (c->domain == CLAST_DEM_BOX) {
            add_plane(dem, k, 1.0, -0.5 * side[k]);
            add_plane(dem, k, -1.0, 0.5 * side[k]);
        }
    }
    if (c->domain == CLAST_DEM_CYLINDER) {
        dem->wall[dem->n_wall++] = (clx_wall){.kind = CLX_WALL_CYLINDER, .radius = 0.5 * c->width};
    }
}

double clx_wall_distance(const clx_wall *wall, const double x[3], double normal[3])
{
    if (wall->kind == CLX_WALL_PLANE) {
        v3_copy(normal, wall->normal);
        return v3_dot(wall->normal, x) - wall->offset;
    }
    const double r = sqrt(x[0] * x[0] + x[1] * x[1]);
    v3_set(normal, r > 0.0 ? -x[0] / r : -1.0, r > 0.0 ? -x[1] / r : 0.0, 0.0);
    return wall->radius - r;
}
