// Local edge correction by mirror images; in a sphere by the share of directions.
//
// Around x the offset of y is mirrored along the axes of a frame, 2^d images with y; m of them are
// in the domain, and each of these m, if a point were there, would weigh 2^d / m: together the
// whole orbit. So for an even density the weighted count near x has the mean of a full ball, for
// any shape of domain, but for orbits that lie outside altogether: none in a box up to half its
// least side, a share of the order (r/R)^3 at walls of radius R in the frame of the wall, (r/L)^2
// at edges that the frame does not know. Where the density is not even, what lies beyond the
// border is taken to be as dense as what mirrors it: an error of the order r^2, as the ball's own.
#include "cloud/pair_edge.h"

#include "cloud/surface.h"
#include <math.h>

double clx_pair_edge_safe(const clast_domain *d, const double *x, double most)
{
    if (d->kind == CLAST_DOMAIN_MAP) {
        return 0.0;
    }
    if (d->kind == CLAST_DOMAIN_MESH) {
        return fmin(most, clast_bvh_closest(d->surface->bvh, x, most, NULL, NULL));
    }
    double safe = most;
    if (d->kind == CLAST_DOMAIN_BOX) {
        for (int32_t j = 0; j < d->dimension; ++j) {
            safe = fmin(safe, fmin(x[j] - d->low[j], d->high[j] - x[j]));
        }
        return safe;
    }
    const double rho = hypot(x[0], x[1]);
    if (d->kind == CLAST_DOMAIN_SPHERE) {
        return fmin(safe, d->radius - hypot(rho, x[2]));
    }
    safe = fmin(safe, fmin(d->radius - rho, fmin(x[2], d->length - x[2])));
    return d->kind == CLAST_DOMAIN_HALF_PIPE ? fmin(safe, x[1]) : safe;
}

static double in_box(const clast_domain *d, const double *x, const double *y)
{
    CLAST_ASSERT(d->kind == CLAST_DOMAIN_BOX);
    double weight = 1.0;
    for (int32_t j = 0; j < d->dimension; ++j) {
        const double image = x[j] + x[j] - y[j];
        weight *= image < d->low[j] || image > d->high[j] ? 2.0 : 1.0;
    }
    return weight;
}

/// One over the share of the sphere about x through y that is inside. [Ripley1977]
static double in_sphere(const clast_domain *d, const double *x, const double *y)
{
    double x2 = 0.0;
    double r2 = 0.0;
    for (int j = 0; j < 3; ++j) {
        x2 += x[j] * x[j];
        r2 += (y[j] - x[j]) * (y[j] - x[j]);
    }
    const double most = 2.0 * sqrt(x2 * r2); // cosine of the widest angle inside, times this
    const double cosine = d->radius * d->radius - x2 - r2;
    return cosine >= most ? 1.0 : 2.0 / (1.0 + fmax(cosine / most, -0.98));
}

/// Radial, tangential and axial mirrors.
static double in_pipe(const clast_domain *d, const double *x, const double *y)
{
    const double rho = hypot(x[0], x[1]);
    const double e[2] = {rho > 0.0 ? x[0] / rho : 1.0, rho > 0.0 ? x[1] / rho : 0.0};
    const double radial = e[0] * (y[0] - x[0]) + e[1] * (y[1] - x[1]);
    const double across = e[0] * (y[1] - x[1]) - e[1] * (y[0] - x[0]);
    const double z = x[2] + x[2] - y[2];
    int n_inside = 0;
    for (int k = 0; k < 4; ++k) {
        const double a = (k & 1) != 0 ? -radial : radial;
        const double t = (k & 2) != 0 ? -across : across;
        const bool inside =
            k == 0 || ((rho + a) * (rho + a) + t * t <= d->radius * d->radius &&
                       (d->kind == CLAST_DOMAIN_CYLINDER || x[1] + a * e[1] + t * e[0] >= 0.0));
        n_inside += inside ? 1 : 0;
    }
    return 4.0 / n_inside * (z < 0.0 || z > d->length ? 2.0 : 1.0);
}

double clx_pair_edge_weight(const clast_domain *d, const double *x, const double *y)
{
    if (d->kind == CLAST_DOMAIN_BOX) {
        return in_box(d, x, y);
    }
    if (d->kind == CLAST_DOMAIN_SPHERE) {
        return in_sphere(d, x, y);
    }
    if (d->kind == CLAST_DOMAIN_CYLINDER || d->kind == CLAST_DOMAIN_HALF_PIPE) {
        return in_pipe(d, x, y);
    }
    int n_inside = 1;
    const int n_image = 1 << d->dimension;
    for (int k = 1; k < n_image; ++k) {
        double image[3] = {0};
        double u[3];
        for (int32_t j = 0; j < d->dimension; ++j) {
            image[j] = (k >> j & 1) != 0 ? x[j] + x[j] - y[j] : y[j];
        }
        n_inside += clast_domain_map(d, image, u) ? 1 : 0;
    }
    return (double)n_image / n_inside;
}
