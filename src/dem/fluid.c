// Drag and torque of a fluid at rest, and hindrance by the grains around.
//
// Stokes' torque on a sphere that turns in a fluid at rest, 8 pi mu R^3 w    [Lamb1932 sec. 334],
// with R that of the sphere of equal volume. Implicit in the angular velocity, so that it never
// reverses a rotation, however small the grain or long the step.
#include "dem/fluid.h"

#include "base/alloc.h"
#include <string.h>

enum { MOST_SLABS = 100000 };

double clx_fluid_drag(const clast_dem *dem, const clx_grain *g, double reynolds,
                      const clast_drag *form)
{
    return g->kind == CLAST_SHAPE_SPHERE && dem->config.sphere_drag == CLAST_DEM_DRAG_STANDARD
               ? clast_drag_sphere(reynolds)
               : clast_drag_coefficient(form, reynolds);
}

clast_drag clx_fluid_form(const clast_dem *dem, const clast_shape *shape, double density)
{
    clast_drag drag = {1.0, 1.0};
    const double *s = shape->semi_axes;
    if (shape->kind != CLAST_SHAPE_SPHERE && dem->config.fluid_density > 0.0) {
        (void)clast_drag_of_form(s[0], s[1], s[2], cbrt(0.75 * shape->volume / CLAST_PI),
                                 density / dem->config.fluid_density, &drag);
    }
    return drag;
}

clast_status clx_fluid_check(const clast_dem *dem, const clast_dem_grain *g, int64_t number)
{
    clast_status status = CLAST_OK;
    const clast_dem_config *c = &dem->config;
    const clast_shape *shape = &dem->body[g->shape].shape;
    clast_settling fall = {.in_range = true};
    const clast_fluid fluid = {c->fluid_density, c->fluid_viscosity, fabs(c->gravity)};
    if (c->fluid_viscosity <= 0.0 || c->fluid_density <= 0.0 || c->gravity == 0.0) {
        return CLAST_OK;
    }
    const clast_drag drag = clx_fluid_form(dem, shape, g->density);
    const double d = g->scale * cbrt(6.0 * shape->volume / CLAST_PI);
    CLX_TRY(clast_terminal_velocity(d, g->density, &drag, &fluid, &fall));
    CLX_CHECK(fall.in_range, CLAST_E_CONFIG,
              "grain %lld: the Reynolds number of its fall is %.3g, beyond 3e5, to where the drag "
              "law holds (Bagheri and Bonadonna 2016)",
              (long long)number, fall.reynolds);
done:
    return status;
}

/// Slab whose middle lies below a height, and the weight of the next in linear interpolation.
static int32_t slab_of(const clx_slabs *s, double z, double *share)
{
    CLAST_ASSERT(s->n >= 1 && s->thick > 0.0);
    const double at = fmin(fmax((z - s->low) / s->thick - 0.5, 0.0), (double)(s->n - 1));
    const int32_t k = (int32_t)at;
    *share = at - (double)k;
    return k;
}

/// Slabs of two of the largest grain's diameters over all grains' heights.
static void set_slabs(const clast_dem *dem, clx_slabs *s)
{
    const clast_dem_config *c = &dem->config;
    const double depth = c->depth > 0.0 ? c->depth : c->width;
    const double area =
        c->domain == CLAST_DEM_CYLINDER ? 0.25 * CLAST_PI * c->width * c->width : c->width * depth;
    double most = 0.0;
    double high = -INFINITY;
    s->low = c->floor ? 0.0 : (double)INFINITY;
    for (int32_t i = 0; i < dem->n_grain; ++i) {
        most = fmax(most, dem->grain[i].radius);
        high = fmax(high, dem->grain[i].position[2]);
        s->low = fmin(s->low, dem->grain[i].position[2]);
    }
    s->thick = fmax(4.0 * most, (high - s->low) / (MOST_SLABS - 1));
    s->n = (int32_t)((high - s->low) / s->thick) + 1;
    s->volume = area * s->thick;
}

clast_status clx_fluid_update_slabs(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    clx_slabs *s = &dem->slabs;
    if (!dem->config.hindrance || dem->n_grain == 0) {
        return CLAST_OK;
    }
    set_slabs(dem, s);
    CLX_TRY(clx_grow(&s->solid, &s->capacity, s->n + 1, sizeof *s->solid));
    memset(s->solid, 0, (size_t)(s->n + 1) * sizeof *s->solid);
    for (int32_t i = 0; i < dem->n_grain; ++i) {
        double share = 0.0;
        const int32_t k = slab_of(s, dem->grain[i].position[2], &share);
        s->solid[k] += (1.0 - share) * dem->motion[i].volume;
        s->solid[k + 1] += share * dem->motion[i].volume;
    }
done:
    return status;
}

double clx_fluid_hindrance(const clast_dem *dem, const clx_grain *g, double reynolds)
{
    const clx_slabs *s = &dem->slabs;
    double share = 0.0;
    if (!dem->config.hindrance || reynolds <= 0.0) {
        return 1.0;
    }
    const int32_t k = slab_of(s, g->position[2], &share);
    const double solid = (1.0 - share) * s->solid[k] + share * s->solid[k + 1];
    return clast_drag_hindrance(reynolds, 1.0 - solid / s->volume);
}

/// Torque over angular velocity [N m s].
static double resistance(const clast_dem *dem, const clx_grain *g)
{
    const double r = g->round_radius;
    return 8.0 * CLAST_PI * dem->config.fluid_viscosity * r * r * r;
}

double clx_fluid_rotation_factor(const clast_dem *dem, const clx_grain *g, double dt)
{
    CLAST_ASSERT(dt >= 0.0 && g->mass >= 0.0 && g->radius >= 0.0);
    return 1.0 / (1.0 + dt * resistance(dem, g) * 2.5 / (g->mass * g->radius * g->radius));
}

void clx_fluid_damp_rotation(const clast_dem *dem, int64_t i, double dt, double x[3])
{
    const clx_grain *g = &dem->grain[i];
    const double share = dt * resistance(dem, g) * dem->motion[i].inverse_factor;
    double a[3][3]; // columns of 1 + dt resistance I^-1, which is symmetric, in the body's axes
    double rotation[3][3];
    double in_body[3];
    double across[3][3];
    double solved[3];
    memcpy(rotation, g->rotation, sizeof rotation);
    for (int k = 0; k < 3; ++k) {
        v3_scale(a[k], share, dem->body[g->shape].inverse_inertia[k]);
        a[k][k] += 1.0;
    }
    m3_to_local(in_body, rotation, x);
    for (int k = 0; k < 3; ++k) {
        v3_cross(across[k], a[(k + 1) % 3], a[(k + 2) % 3]);
    }
    const double det = v3_dot(a[0], across[0]);
    for (int k = 0; k < 3; ++k) {
        solved[k] = v3_dot(in_body, across[k]) / det;
    }
    m3_to_world(x, rotation, solved);
}
