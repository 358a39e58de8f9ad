// Set covariance of boxes, cylinders and spheres, and the share of uniform pairs within a radius.
//
// Box: the product of (side - r |u_j|) averaged over directions, in closed form over the angle in
// the plane of two sides [Ghosh1951 for the square] and by quadrature over the polar angle where r
// exceeds a side. Cylinder: lens of two discs times (L - r |cos|). Each piece between two kinks is
// integrated in cosine-spaced points, which makes its square roots at the ends smooth: 1e-12. Other
// domains are sampled.
#include "cloud/covariogram.h"

#include "base/alloc.h"
#include "cloud/contract.h"
#include "cloud/surface.h"
#include "math/quadrature.h"
#include <clast/cloud.h>
#include <clast/pairs.h>
#include <clast/status.h>
#include <math.h>

enum { MOST_KINK = 12 };

/// Average of (a - r |cos|)(b - r |sin|), where both are positive.
static double rectangle(double a, double b, double r)
{
    const double from = r > a ? acos(a / r) : 0.0;
    const double to = r > b ? asin(b / r) : 0.5 * CLAST_PI;
    if (to <= from) {
        return 0.0;
    }
    const double sf = sin(from);
    const double st = sin(to);
    const double integral = a * b * (to - from) + a * r * (cos(to) - cos(from)) -
                            b * r * (st - sf) + 0.5 * r * r * (st * st - sf * sf);
    return integral / (0.5 * CLAST_PI);
}

/// Area of two discs of radius R at a distance.
static double lens(double radius, double distance)
{
    if (distance >= 2.0 * radius) {
        return 0.0;
    }
    const double half = 0.5 * distance;
    return 2.0 * (radius * radius * acos(half / radius) -
                  half * sqrt(fmax(0.0, radius * radius - half * half)));
}

/// What is inside both the domain and its shift by r at the polar angle, averaged over azimuths.
static double slice(const clast_domain *d, double r, double angle)
{
    const double across = r * sin(angle);
    const double along = r * cos(angle);
    if (d->kind == CLAST_DOMAIN_CYLINDER) {
        return fmax(0.0, d->length - along) * lens(d->radius, across);
    }
    return fmax(0.0, d->high[2] - d->low[2] - along) *
           rectangle(d->high[0] - d->low[0], d->high[1] - d->low[1], across);
}

static void add_kink(double at, double low, double high, double *kink, int *n)
{
    int k = *n;
    if (!(at > low && at < high)) {
        return;
    }
    for (; k > 0 && kink[k - 1] > at; --k) {
        kink[k] = kink[k - 1];
    }
    kink[k] = at;
    ++*n;
}

/// Lengths at which the set covariance is not smooth.
static int lengths(const clast_domain *d, double length[6])
{
    if (d->kind == CLAST_DOMAIN_SPHERE) {
        length[0] = 2.0 * d->radius;
        return 1;
    }
    if (d->kind == CLAST_DOMAIN_CYLINDER) {
        length[0] = 2.0 * d->radius;
        length[1] = d->length;
        length[2] = hypot(length[0], length[1]);
        return 3;
    }
    int n = 0;
    for (int32_t j = 0; j < d->dimension; ++j) {
        length[n++] = d->high[j] - d->low[j];
    }
    for (int32_t j = 0; j < d->dimension && d->dimension > 1; ++j) {
        length[n++] = hypot(length[j], length[(j + 1) % d->dimension]);
    }
    return n;
}

static double over_angles(const clast_domain *d, double r)
{
    double length[6];
    double kink[MOST_KINK];
    double sum = 0.0;
    int n = 0;
    const int n_length = lengths(d, length);
    for (int k = 0; k < n_length; ++k) {
        if (length[k] < r) {
            add_kink(acos(length[k] / r), 0.0, 0.5 * CLAST_PI, kink, &n);
            add_kink(asin(length[k] / r), 0.0, 0.5 * CLAST_PI, kink, &n);
        }
    }
    double from = 0.0;
    for (int k = 0; k <= n; ++k) {
        const double to = k < n ? kink[k] : 0.5 * CLAST_PI;
        for (int q = 0; q < 2 * CLX_GAUSS_N; ++q) {
            const int panel = q / CLX_GAUSS_N;
            const double t = CLAST_PI * 0.5 * (panel + clx_gauss_point(q % CLX_GAUSS_N));
            const double angle = from + (to - from) * 0.5 * (1.0 - cos(t));
            sum += 0.5 * CLAST_PI * clx_gauss_weight(q % CLX_GAUSS_N) * 0.5 * (to - from) * sin(t) *
                   sin(angle) * slice(d, r, angle);
        }
        from = to;
    }
    return sum;
}

/// Whether clx_covariogram knows the domain.
static bool is_exact(const clast_domain *d)
{
    return d->kind == CLAST_DOMAIN_BOX || d->kind == CLAST_DOMAIN_CYLINDER ||
           d->kind == CLAST_DOMAIN_SPHERE;
}

double clx_covariogram(const clast_domain *d, double r)
{
    double side[3] = {0};
    if (d->kind == CLAST_DOMAIN_SPHERE) {
        const double q = r / d->radius;
        return q < 2.0 ? clast_domain_volume(d) * (1.0 - 0.75 * q + q * q * q / 16.0) : 0.0;
    }
    for (int32_t j = 0; j < 3; ++j) {
        side[j] = d->high[j] - d->low[j];
    }
    if (d->kind == CLAST_DOMAIN_BOX && d->dimension == 1) {
        return fmax(0.0, side[0] - r);
    }
    if (d->kind == CLAST_DOMAIN_BOX && d->dimension == 2) {
        return rectangle(side[0], side[1], r);
    }
    if (d->kind == CLAST_DOMAIN_BOX && r <= fmin(side[0], fmin(side[1], side[2]))) {
        return side[0] * side[1] * side[2] -
               0.5 * r * (side[0] * side[1] + side[1] * side[2] + side[2] * side[0]) +
               r * r * (2.0 * (side[0] + side[1] + side[2]) / 3.0 - 0.25 * r) / CLAST_PI;
    }
    return over_angles(d, r);
}

/// Integral of S_d r^(d-1) c(r) over one smooth piece, in cosine-spaced points too.
static double piece(const clast_domain *d, double from, double to)
{
    const double surface[3] = {2.0, 2.0 * CLAST_PI, 4.0 * CLAST_PI};
    double sum = 0.0;
    for (int q = 0; q < 4 * CLX_GAUSS_N; ++q) {
        const int panel = q / CLX_GAUSS_N;
        const double t = CLAST_PI * 0.25 * (panel + clx_gauss_point(q % CLX_GAUSS_N));
        const double r = from + (to - from) * 0.5 * (1.0 - cos(t));
        sum += 0.25 * CLAST_PI * clx_gauss_weight(q % CLX_GAUSS_N) * 0.5 * (to - from) * sin(t) *
               surface[d->dimension - 1] * pow(r, d->dimension - 1) * clx_covariogram(d, r);
    }
    return sum;
}

static void integrate(const clast_domain *d, int32_t n, const double *radius, double *integral)
{
    double length[6];
    double sum = 0.0;
    double from = 0.0;
    const int n_length = lengths(d, length);
    for (int32_t i = 0; i < n; ++i) {
        double kink[MOST_KINK];
        int n_kink = 0;
        for (int k = 0; k < n_length; ++k) {
            add_kink(length[k], from, radius[i], kink, &n_kink);
        }
        for (int k = 0; k <= n_kink; ++k) {
            const double to = k < n_kink ? kink[k] : radius[i];
            sum += piece(d, from, to);
            from = to;
        }
        integral[i] = sum;
    }
}

/// Distance that no two points of the domain are beyond: the diameter, of a surface the least ball
/// about the middle of its box.
static double measure_diameter(const clast_domain *d)
{
    double most = 0.0;
    if (d->kind == CLAST_DOMAIN_HALF_PIPE) {
        return hypot(2.0 * d->radius, d->length);
    }
    if (d->kind != CLAST_DOMAIN_MESH) {
        return (double)INFINITY;
    }
    const clast_mesh *m = &d->surface->mesh;
    for (int32_t v = 0; v < m->n_vert; ++v) {
        double square = 0.0;
        for (int j = 0; j < 3; ++j) {
            const double off = m->vert[v][j] - 0.5 * (d->low[j] + d->high[j]);
            square += off * off;
        }
        most = fmax(most, square);
    }
    return 2.0 * sqrt(most);
}

/// Relative error of an estimate by chords from which pairs of points are asked, too.
static const double LARGE_ERROR = 1e-3;

/// Shares by chords; where their error is large and that of pairs of points is less, by these. Of a
/// map by shells about points.
static clast_status sample(const clast_domain *domain, int32_t n, const double *radius,
                           double *share, double *error)
{
    clast_status status = CLAST_OK;
    double *other = NULL; // [2][n] shares by pairs, their errors
    const double square = clast_domain_volume(domain) * clast_domain_volume(domain);
    const bool has_chords = domain->kind != CLAST_DOMAIN_MAP;
    bool is_large = false;
    CLX_TRY(clx_covariogram_sample(domain, n, radius, share, error));
    for (int32_t i = 0; i < n; ++i) {
        share[i] /= square;
        error[i] /= square;
        is_large = is_large || (has_chords && error[i] > LARGE_ERROR * fabs(share[i]));
    }
    if (is_large) {
        CLX_TRY(clx_alloc(&other, 2 * (int64_t)n, sizeof *other));
        CLX_TRY(clx_covariogram_pairs(domain, n, radius, other, other + n));
    }
    const double diameter = measure_diameter(domain);
    for (int32_t i = 0; i < n; ++i) {
        if (radius[i] >= diameter) {
            share[i] = 1.0;
            error[i] = 0.0;
        } else if (is_large && error[i] > LARGE_ERROR * fabs(share[i]) && other[n + i] < error[i]) {
            share[i] = other[i];
            error[i] = other[n + i];
        }
    }
done:
    clx_free(other);
    return status;
}

clast_status clast_pairs_uniform(const clast_domain *domain, int32_t n, const double *radius,
                                 double *share, double *error)
{
    CLX_ARGUMENTS(domain, radius, share);
    CLX_FLOAT_ENVIRONMENT;
    clast_status status = CLAST_OK;
    double *made = NULL; // [2][n] shares, errors
    CLX_TRY(clx_domain_check(domain));
    CLX_CHECK(n >= 1, CLAST_E_ARGUMENT, "%d radii", n);
    for (int32_t i = 0; i < n; ++i) {
        CLX_CHECK(isfinite(radius[i]) && radius[i] > (i > 0 ? radius[i - 1] : 0.0),
                  CLAST_E_ARGUMENT, "radius %d is %g: radii are > 0 and ascend", i + 1, radius[i]);
    }
    CLX_TRY(clx_alloc(&made, 2 * (int64_t)n, sizeof *made));
    if (is_exact(domain)) {
        const double volume = clast_domain_volume(domain);
        integrate(domain, n, radius, made);
        for (int32_t i = 0; i < n; ++i) {
            made[i] /= volume * volume;
        }
    } else {
        CLX_TRY(sample(domain, n, radius, made, made + n));
    }
    for (int32_t i = 0; i < n; ++i) { // what sampling leaves of a probability's order
        share[i] = fmin(fmax(made[i], i > 0 ? share[i - 1] : 0.0), 1.0);
        if (error != NULL) {
            error[i] = made[n + i];
        }
    }
done:
    clx_free(made);
    return status;
}
