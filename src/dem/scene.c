// Beds for timings and tests, built through the public functions alone.
#include <clast/dem.h>

#include "base/alloc.h"
#include "math/rng.h"
#include "math/vec3.h"
#include "shape/gravel.h"
#include <clast/mesh.h>
#include <clast/shape.h>
#include <math.h>
#include <stdio.h>

enum { N_FORM = 63, FORM_SEED = 30, GRAIN_SEED = 35 };

static const double DENSITY = 2650.0; ///< [kg/m^3]

/// What shrinks an ellipsoid of equal volume and moments to one of equal mass (case E1).
static const double ELLIPSOID = 0.985;

static clast_status add_form(clast_dem *dem, int32_t k, int32_t n_vert, bool is_ellipsoid,
                             double *size)
{
    clast_status status = CLAST_OK;
    clast_mesh hull = {0};
    clast_shape shape = {0};
    char name[16];
    int32_t id = 0;
    CLX_TRY(clx_gravel(FORM_SEED, (uint64_t)k, n_vert, &hull));
    (void)snprintf(name, sizeof name, "form%d", k);
    CLX_TRY(clast_shape_mesh(name, &hull, &shape));
    const double *s = shape.semi_axes;
    *size = sqrt(2.0 * (s[1] * s[1] + s[2] * s[2])); // eq. 1 of the paper
    if (is_ellipsoid) {
        const double axes[3] = {ELLIPSOID * s[0], ELLIPSOID * s[1], ELLIPSOID * s[2]};
        clast_shape_free(&shape);
        CLX_TRY(clast_shape_ellipsoid(name, axes, &shape));
    }
    CLX_TRY(clast_dem_add_shape(dem, &shape, &id));
done:
    clast_mesh_free(&hull);
    clast_shape_free(&shape);
    return status;
}

static clast_status begin(const clast_scene_bed *bed, bool is_ellipsoid, double size[N_FORM],
                          clast_dem **dem)
{
    clast_status status = CLAST_OK;
    clast_dem *made = NULL;
    clast_dem_config config = {0};
    CLX_TRY(clast_fields_default(clast_dem_fields, &config));
    config.domain = CLAST_DEM_PERIODIC;
    config.width = bed->width;
    config.height = 2.0;
    config.lid = false;
    CLX_TRY(clast_dem_create(&config, &made));
    for (int32_t k = 0; k < N_FORM; ++k) {
        CLX_TRY(add_form(made, k, bed->n_vert, is_ellipsoid, &size[k]));
    }
    *dem = made;
    made = NULL;
done:
    clast_dem_destroy(made);
    return status;
}

static void place(const clast_scene_bed *bed, int32_t i, const double size[N_FORM],
                  clast_dem_grain *g)
{
    static const double spacing = 0.0125; // [m]
    const int side = (int)(bed->width / spacing);
    clx_rng rng = clx_rng_at(GRAIN_SEED, CLX_STREAM_TEST, (uint64_t)i);
    g->shape = (int32_t)clx_rng_below(&rng, N_FORM);
    g->scale = 5.6e-3 * pow(8.0 / 5.6, clx_rng_uniform(&rng)) / size[g->shape];
    g->density = DENSITY;
    clx_rng_orientation(&rng, g->orientation);
    const int row = i / side % side;
    const int layer = i / (side * side);
    v3_set(g->position, (i % side + 0.5) * bed->width / side, (row + 0.5) * bed->width / side,
           0.008 + layer * spacing);
    for (int k = 0; k < 3; ++k) {
        g->velocity[k] = 0.1 * clx_rng_normal(&rng);
    }
    g->velocity[2] -= bed->fall;
}

clast_status clast_dem_scene_p1(const clast_scene_bed *bed, clast_dem **dem)
{
    CLX_ARGUMENTS(bed, dem);
    clast_status status = CLAST_OK;
    clast_dem *made = NULL;
    clast_dem_grain *grain = NULL;
    double size[N_FORM];
    CLX_TRY(begin(bed, false, size, &made));
    CLX_TRY(clx_alloc(&grain, bed->n, sizeof *grain));
    for (int32_t i = 0; i < bed->n; ++i) {
        place(bed, i, size, &grain[i]);
    }
    CLX_TRY(clast_dem_add_grains(made, bed->n, grain));
    CLX_TRY(clast_dem_set_drive(made, &(clast_dem_drive){3e-4, 0.025, 1.0}));
    *dem = made;
    made = NULL;
done:
    clx_free(grain);
    clast_dem_destroy(made);
    return status;
}

clast_status clast_dem_scene_e1(const clast_scene_bed *bed, const clast_dem *p1, clast_dem **dem)
{
    CLX_ARGUMENTS(bed, p1, dem);
    clast_status status = CLAST_OK;
    clast_dem *made = NULL;
    clast_dem_grain *grain = NULL;
    double size[N_FORM];
    const int32_t n = clast_dem_n_grain(p1);
    CLX_TRY(begin(bed, true, size, &made));
    CLX_TRY(clx_alloc(&grain, n, sizeof *grain));
    for (int32_t i = 0; i < n; ++i) {
        clast_dem_read_grain(p1, i, &grain[i]);
    }
    CLX_TRY(clast_dem_add_grains(made, n, grain));
    *dem = made;
    made = NULL;
done:
    clx_free(grain);
    clast_dem_destroy(made);
    return status;
}

static clast_dem_grain ball(int32_t i, int32_t side)
{
    static const double pitch = 6.9e-3; // [m]
    clx_rng rng = clx_rng_at(1, CLX_STREAM_TEST, (uint64_t)i);
    clast_dem_grain g = {.scale = 6.7e-3, .density = DENSITY, .orientation = {1.0, 0.0, 0.0, 0.0}};
    const int row = i / side % side;
    const int layer = i / (side * side);
    v3_set(g.position, (i % side - 9) * pitch, (row - 9) * pitch, 4e-3 + layer * pitch);
    for (int k = 0; k < 3; ++k) {
        g.velocity[k] = 0.1 * (2.0 * clx_rng_uniform(&rng) - 1.0);
    }
    return g;
}

clast_status clast_dem_scene_s1(clast_dem **dem)
{
    CLX_ARGUMENTS(dem);
    enum { SIDE = 19, TALL = 30, N = SIDE * SIDE * TALL };
    clast_status status = CLAST_OK;
    clast_dem_config config = {0};
    clast_dem *made = NULL;
    clast_shape sphere = {0};
    clast_dem_grain *grain = NULL;
    int32_t id = 0;
    CLX_TRY(clast_fields_default(clast_dem_fields, &config));
    config.domain = CLAST_DEM_PERIODIC;
    config.width = 0.134;
    CLX_TRY(clast_dem_create(&config, &made));
    CLX_TRY(clast_shape_sphere("sphere", 0.5, &sphere));
    CLX_TRY(clast_dem_add_shape(made, &sphere, &id));
    CLX_TRY(clx_alloc(&grain, N, sizeof *grain));
    for (int32_t i = 0; i < N; ++i) {
        grain[i] = ball(i, SIDE);
    }
    CLX_TRY(clast_dem_add_grains(made, N, grain));
    *dem = made;
    made = NULL;
done:
    clx_free(grain);
    clast_shape_free(&sphere);
    clast_dem_destroy(made);
    return status;
}
