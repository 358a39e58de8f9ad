#include "dem_scenes.h"

#include <clast/assembly.h>

#include "math/rng.h"
#include <clast/mesh.h>
#include <clast/shape.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

clast_dem_config scene_physics(void)
{
    clast_dem_config c = {0};
    (void)clast_fields_default(clast_dem_fields, &c);
    return c;
}

static clast_dem *with_spheres(const clast_dem_config *config)
{
    clast_dem *dem = NULL;
    clast_shape sphere = {0};
    int32_t id = 0;
    if (clast_dem_create(config, &dem) == CLAST_OK &&
        clast_shape_sphere("sphere", 0.5, &sphere) == CLAST_OK &&
        clast_dem_add_shape(dem, &sphere, &id) != CLAST_OK) {
        clast_dem_destroy(dem);
        dem = NULL;
    }
    clast_shape_free(&sphere);
    return dem;
}

static clast_dem_grain ball(double diameter, double x, double y, double z)
{
    return (clast_dem_grain){.scale = diameter,
                             .density = 2650.0,
                             .position = {x, y, z},
                             .orientation = {1.0, 0.0, 0.0, 0.0}};
}

clast_dem *scene_pour(int32_t n, double low, double high, double width)
{
    clast_dem_config c = scene_physics();
    c.width = width;
    return scene_pour_with(&c, n, low, high);
}

clast_dem *scene_pour_with(const clast_dem_config *config, int32_t n, double low, double high)
{
    const double width = config->width;
    clast_dem *dem = with_spheres(config);
    clast_dem_grain *grain = calloc((size_t)n + 1, sizeof *grain);
    const double room = 0.5 * width - 0.55 * high;
    int32_t made = 0;
    for (int64_t at = 0; dem != NULL && grain != NULL && made < n; ++at) {
        const int side = (int)(width / (1.05 * high)) + 1;
        const double x = ((double)(at % side) - 0.5 * (side - 1)) * 1.05 * high;
        const double y = ((double)(at / side % side) - 0.5 * (side - 1)) * 1.05 * high;
        const double z = ((double)(at / side / side) + 1.0) * 1.05 * high;
        if (x * x + y * y > room * room) {
            continue;
        }
        clx_rng rng = clx_rng_at(2, CLX_STREAM_TEST, (uint64_t)made);
        grain[made] = ball(low * pow(high / low, clx_rng_uniform(&rng)), x, y, z);
        for (int k = 0; k < 3; ++k) {
            grain[made].velocity[k] = 0.5 * (2.0 * clx_rng_uniform(&rng) - 1.0);
            grain[made].angular_velocity[k] = 10.0 * (2.0 * clx_rng_uniform(&rng) - 1.0);
        }
        grain[made].velocity[2] -= 1.0; // soon a bed
        ++made;
    }
    if (dem != NULL && clast_dem_add_grains(dem, made, grain) != CLAST_OK) {
        clast_dem_destroy(dem);
        dem = NULL;
    }
    free(grain);
    return dem;
}

clast_dem_config scene_space(void)
{
    clast_dem_config c = scene_physics();
    c.domain = CLAST_DEM_OPEN;
    c.floor = false;
    c.gravity = 0.0;
    return c;
}

/// Corners on the axes.
static clast_status octahedron(double r, clast_mesh *mesh)
{
    static const int32_t tri[8][3] = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                      {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    const clast_status status = clast_mesh_alloc(6, 8, mesh);
    for (int i = 0; status == CLAST_OK && i < 6; ++i) {
        mesh->vert[i][i / 2] = i % 2 == 0 ? r : -r;
    }
    if (status == CLAST_OK) {
        memcpy(mesh->tri, tri, sizeof tri);
    }
    return status;
}

static clast_status dumb_bell(clast_shape *shape)
{
    clast_spheres balls = {0};
    clast_status status = clast_spheres_alloc(2, &balls);
    if (status == CLAST_OK) {
        balls.centre[0][0] = 2e-3;
        balls.centre[1][0] = -2e-3;
        balls.radius[0] = balls.radius[1] = 2e-3;
        status = clast_shape_clump("clump", &balls, shape);
    }
    clast_spheres_free(&balls);
    return status;
}

/// Two bodies of half the reach, end to end, as one rigid grain.
static clast_status rigid_pair(const clast_shape *part, clast_shape *shape)
{
    clast_assembly a = {0};
    int32_t id = 0;
    const clast_rigid_options options = {.hull = false};
    const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    clast_status status = clast_assembly_add_shape(&a, part, &id);
    for (int k = 0; k < 2 && status == CLAST_OK; ++k) {
        const double x[3] = {k == 0 ? 2e-3 : -2e-3, 0.0, 0.0};
        status = clast_assembly_add_grain(&a, id, x, unturned, 0.5, 2650.0);
    }
    status = status == CLAST_OK ? clast_assembly_rigid(&a, "pair", &options, shape, NULL) : status;
    clast_assembly_free(&a);
    return status;
}

bool scene_is_flat(scene_body_kind kind)
{
    return kind == SCENE_CUBE || kind == SCENE_BRICKS;
}

bool scene_is_pointed(scene_body_kind kind)
{
    return kind == SCENE_OCTAHEDRON || kind == SCENE_GEMS;
}

clast_status scene_body(scene_body_kind kind, clast_shape *shape)
{
    const double axes[3] = {4e-3, 3e-3, 2e-3};
    clast_mesh mesh = {0};
    clast_status status = CLAST_OK;
    switch (kind) {
    case SCENE_BALL:
        return clast_shape_sphere("ball", 4e-3, shape);
    case SCENE_EGG:
        return clast_shape_ellipsoid("egg", axes, shape);
    case SCENE_OCTAHEDRON:
        status = octahedron(4e-3, &mesh);
        status = status == CLAST_OK ? clast_shape_mesh("octahedron", &mesh, shape) : status;
        break;
    case SCENE_CUBE:
        status = clast_mesh_box(8e-3, 8e-3, 8e-3, &mesh);
        status = status == CLAST_OK ? clast_shape_mesh("cube", &mesh, shape) : status;
        break;
    case SCENE_CLUMP:
        return dumb_bell(shape);
    default: {
        const scene_body_kind half = kind == SCENE_EGGS   ? SCENE_EGG
                                     : kind == SCENE_GEMS ? SCENE_OCTAHEDRON
                                                          : SCENE_CUBE;
        clast_shape part = {0};
        status = scene_body(half, &part);
        status = status == CLAST_OK ? rigid_pair(&part, shape) : status;
        clast_shape_free(&part);
    }
    }
    clast_mesh_free(&mesh);
    return status;
}

clast_dem *scene_bodies(const clast_dem_config *config, const clast_shape *shape, int32_t n,
                        const clast_dem_grain *grain)
{
    clast_dem *dem = NULL;
    int32_t id = 0;
    clast_status status = clast_dem_create(config, &dem);
    status = status == CLAST_OK ? clast_dem_add_shape(dem, shape, &id) : status;
    status = status == CLAST_OK ? clast_dem_add_grains(dem, n, grain) : status;
    if (status != CLAST_OK) {
        clast_dem_destroy(dem);
        return NULL;
    }
    return dem;
}

double scene_collide(clast_dem *dem, double dt)
{
    int64_t touching = 0;
    for (int64_t k = 0; k < 1000000; ++k) {
        clast_dem_measures m;
        if (clast_dem_step(dem, 1) != CLAST_OK) {
            return (double)NAN;
        }
        clast_dem_measure(dem, &m);
        if (m.n_contact + m.n_wall_contact > 0) {
            ++touching;
        } else if (touching > 0) {
            break;
        }
    }
    return (double)touching * dt;
}
