// A filling under way: the surface closed, checked and measured, before the first sphere.
#include "shape/fill.h"

#include "base/alloc.h"
#include "base/monitor.h"
#include "base/status.h"
#include "math/sort.h"
#include <math.h>

/// Least mean thickness, as a share of the extent, of a solid that is filled: distances are floats
/// of the extent (1e-7), and beyond it a search no longer tells the walls apart.
static const double THICKNESS_LIMIT = 1e-5;

/// Holes that matter less than this (see clx_fill_solid) are capped without being asked: t_rex has
/// 3e-4, a seam of rounding 1e-9, a scan that lost a thousandth of its skin 1e-3.
static const double OPEN_LIMIT = 0.002;

clast_status clx_fill_poll(const clx_fill *fill)
{
    if (clx_monitor_stops(fill->monitor)) {
        return clx_fail(CLAST_E_STOPPED, "stopped after %d spheres; nothing is kept",
                        fill->balls.n);
    }
    return CLAST_OK;
}

static clast_status check_solid(clx_fill *fill, bool allow_open)
{
    clast_status status = CLAST_OK;
    const clx_fill_solid *s = &fill->solid;
    const double volume = clast_mesh_volume(s->mesh);
    CLX_CHECK(isfinite(volume), CLAST_E_GEOMETRY,
              "the surface has coordinates that are not finite");
    CLX_CHECK(allow_open || s->open_volume <= OPEN_LIMIT * fabs(volume), CLAST_E_GEOMETRY,
              "the surface is not closed and oriented: %d edges in %d loops are open%s; run `clast "
              "mesh repair`, or cap them with --allow-open",
              s->n_open_edge, s->n_hole,
              s->n_turned_edge > 0 ? " or join facets that face opposite ways" : "");
    CLX_CHECK(volume > 0.0, CLAST_E_GEOMETRY,
              "the surface is %s (volume %g); run `clast mesh repair`",
              volume < 0.0 ? "inside out" : "flat", volume);
    CLX_TRY(clast_mesh_mass(s->mesh, &fill->mass));
done:
    return status;
}

static int32_t farthest_vertex(const clast_mesh *mesh, const double from[3])
{
    int32_t farthest = 0;
    for (int32_t i = 1; i < mesh->n_vert; ++i) {
        if (v3_distance2(mesh->vert[i], from) > v3_distance2(mesh->vert[farthest], from)) {
            farthest = i;
        }
    }
    return farthest;
}

/// The vertex farthest from the median of all; their mean and the centroid go along with it.
static clast_status find_stray(const clast_mesh *mesh, int32_t *stray)
{
    clast_status status = CLAST_OK;
    double median[3] = {0};
    double *x = NULL;
    CLX_TRY(clx_alloc(&x, mesh->n_vert, sizeof *x));
    for (int k = 0; k < 3; ++k) {
        for (int32_t i = 0; i < mesh->n_vert; ++i) {
            x[i] = mesh->vert[i][k];
        }
        CLX_TRY(clx_sort_doubles(x, mesh->n_vert));
        median[k] = x[mesh->n_vert / 2];
    }
    *stray = farthest_vertex(mesh, median);
done:
    clx_free(x);
    return status;
}

/// 3 V / A is the radius of a sphere, and no more than three times the half thickness of a plate.
static clast_status check_thickness(const clx_fill *fill)
{
    clast_status status = CLAST_OK;
    const clast_mesh *mesh = fill->solid.mesh;
    const double thickness = 3.0 * fill->mass.volume / clast_mesh_area(mesh);
    int32_t at = 0;
    if (thickness >= THICKNESS_LIMIT * fill->extent) {
        return CLAST_OK;
    }
    CLX_TRY(find_stray(mesh, &at));
    status = clx_fail(CLAST_E_GEOMETRY,
                      "the solid is %.3g long and %.3g thick on average (3 V / A); its walls are "
                      "told apart down to %g of its length; is vertex %d at (%g, %g, %g) an error?",
                      fill->extent, thickness, THICKNESS_LIMIT, at, mesh->vert[at][0],
                      mesh->vert[at][1], mesh->vert[at][2]);
done:
    return status;
}

clast_status clx_fill_open(const clast_mesh *mesh, bool allow_open, clx_fill *fill)
{
    clast_status status = CLAST_OK;
    fill->surface = mesh;
    CLX_CHECK(mesh->n_tri >= 4, CLAST_E_GEOMETRY,
              "a surface of %d triangles bounds no solid; at least 4 are needed", mesh->n_tri);
    CLX_TRY(clx_fill_solid_make(mesh, &fill->solid));
    CLX_TRY(check_solid(fill, allow_open));
    clast_mesh_bounds(fill->solid.mesh, fill->low, fill->high);
    fill->extent = v3_distance(fill->low, fill->high);
    CLX_TRY(check_thickness(fill));
    CLX_TRY(clx_fill_field_create(fill->solid.mesh, &fill->field));
    v3_copy(fill->balls.middle, fill->field.middle);
    fill->balls.scale = fill->field.scale;
done:
    return status;
}

void clx_fill_free(clx_fill *fill)
{
    clx_ball_set_free(&fill->balls);
    clx_fill_field_free(&fill->field);
    clx_fill_solid_free(&fill->solid);
    *fill = (clx_fill){0};
}
