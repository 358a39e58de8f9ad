// Domains and their measure-preserving maps to the unit cube.
#include <clast/cloud.h>

#include "cloud/boundary_score.h"
#include "cloud/surface.h"
#include <math.h>

bool clx_domain_is_boxed(const clast_domain *d)
{
    return d->kind == CLAST_DOMAIN_BOX || d->kind == CLAST_DOMAIN_MESH;
}

/// A domain that can be mapped at all: clx_domain_check without its messages.
static bool is_usable(const clast_domain *d)
{
    return d != NULL && (unsigned)d->kind <= CLAST_DOMAIN_MESH && d->dimension >= 1 &&
           d->dimension <= 3 &&
           (d->kind != CLAST_DOMAIN_MAP || (d->user.map != NULL && d->user.unmap != NULL)) &&
           (d->kind != CLAST_DOMAIN_MESH || d->surface != NULL);
}

double clast_domain_volume(const clast_domain *d)
{
    if (!is_usable(d)) {
        return (double)NAN;
    }
    double volume = 1.0;
    switch (d->kind) {
    case CLAST_DOMAIN_MAP:
        return d->user.volume;
    case CLAST_DOMAIN_MESH:
        return d->surface->volume;
    case CLAST_DOMAIN_BOX:
        for (int32_t j = 0; j < d->dimension; ++j) {
            volume *= d->high[j] - d->low[j];
        }
        return volume;
    case CLAST_DOMAIN_CYLINDER:
        return CLAST_PI * d->radius * d->radius * d->length;
    case CLAST_DOMAIN_HALF_PIPE:
        return 0.5 * CLAST_PI * d->radius * d->radius * d->length;
    case CLAST_DOMAIN_SPHERE:
        break;
    }
    return 4.0 / 3.0 * CLAST_PI * d->radius * d->radius * d->radius;
}

void clx_domain_sides(const clast_domain *d, double side[3])
{
    if (!is_usable(d) || side == NULL) {
        return;
    }
    for (int32_t j = 0; j < 3; ++j) {
        side[j] = clx_domain_is_boxed(d) && j < d->dimension ? d->high[j] - d->low[j] : 1.0;
    }
}

static bool map_pipe(const clast_domain *d, const double *x, double *u)
{
    const double rho2 = x[0] * x[0] + x[1] * x[1];
    const double angle = atan2(x[1], x[0]);
    u[0] = rho2 / (d->radius * d->radius);
    u[1] = d->kind == CLAST_DOMAIN_HALF_PIPE ? angle / CLAST_PI : 0.5 + 0.5 * angle / CLAST_PI;
    u[2] = x[2] / d->length;
    return u[0] <= 1.0 && u[1] >= 0.0 && u[1] <= 1.0 && u[2] >= 0.0 && u[2] <= 1.0;
}

static bool map_sphere(const clast_domain *d, const double *x, double *u)
{
    const double r = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) / d->radius;
    u[0] = r * r * r;
    u[1] = r > 0.0 ? fmin(fmax(0.5 + 0.5 * x[2] / (r * d->radius), 0.0), 1.0) : 0.5;
    u[2] = 0.5 + 0.5 * atan2(x[1], x[0]) / CLAST_PI;
    return r <= 1.0;
}

void clx_domain_to_local(const clast_domain *d, const double *x, double local[3])
{
    const double from[3] = {x[0] - d->centre[0], x[1] - d->centre[1], x[2] - d->centre[2]};
    for (int k = 0; k < 3; ++k) {
        const double *a = d->axes[k];
        local[k] = a[0] * from[0] + a[1] * from[1] + a[2] * from[2];
    }
}

static void to_world(const clast_domain *d, double *x)
{
    const double local[3] = {x[0], x[1], x[2]};
    for (int k = 0; k < 3; ++k) {
        x[k] = d->centre[k] + d->axes[0][k] * local[0] + d->axes[1][k] * local[1] +
               d->axes[2][k] * local[2];
    }
}

bool clast_domain_map(const clast_domain *d, const double *x, double *u)
{
    if (!is_usable(d) || x == NULL || u == NULL) {
        return false;
    }
    double local[3] = {0};
    if (d->is_placed) {
        clx_domain_to_local(d, x, local);
        x = local;
    }
    if (d->kind == CLAST_DOMAIN_SPHERE) {
        return map_sphere(d, x, u);
    }
    if (d->kind == CLAST_DOMAIN_MAP) {
        return d->user.map(d->user.context, x, u);
    }
    if (!clx_domain_is_boxed(d)) {
        return map_pipe(d, x, u);
    }
    bool inside = true;
    for (int32_t j = 0; j < d->dimension && j < 3; ++j) {
        u[j] = (x[j] - d->low[j]) / (d->high[j] - d->low[j]);
        inside = inside && u[j] >= 0.0 && u[j] <= 1.0;
    }
    if (inside && d->kind == CLAST_DOMAIN_MESH) {
        return clast_bvh_inside(d->surface->bvh, x);
    }
    return inside;
}

void clast_domain_unmap(const clast_domain *d, const double *u, double *x)
{
    if (!is_usable(d) || u == NULL || x == NULL) {
        return;
    }
    if (d->kind == CLAST_DOMAIN_MAP) {
        d->user.unmap(d->user.context, u, x);
    } else if (clx_domain_is_boxed(d)) {
        for (int32_t j = 0; j < d->dimension; ++j) {
            x[j] = d->low[j] + u[j] * (d->high[j] - d->low[j]);
        }
    } else if (d->kind == CLAST_DOMAIN_SPHERE) {
        const double r = d->radius * cbrt(u[0]);
        const double z = 2.0 * u[1] - 1.0;
        const double rho = r * sqrt(fmax(0.0, 1.0 - z * z));
        const double angle = (2.0 * u[2] - 1.0) * CLAST_PI;
        x[0] = rho * cos(angle);
        x[1] = rho * sin(angle);
        x[2] = r * z;
    } else {
        const double rho = d->radius * sqrt(u[0]);
        const double angle =
            d->kind == CLAST_DOMAIN_HALF_PIPE ? u[1] * CLAST_PI : (2.0 * u[1] - 1.0) * CLAST_PI;
        x[0] = rho * cos(angle);
        x[1] = rho * sin(angle);
        x[2] = u[2] * d->length;
    }
    if (d->is_placed) {
        to_world(d, x);
    }
}
