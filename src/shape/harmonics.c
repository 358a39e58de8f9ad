// Grains as spherical-harmonic series: surfaces, and exact integrals by quadrature.
//
// With cos theta on Gauss nodes and equal steps in phi, products of series are integrated exactly
// up to the rule's degree: r^3 (volume), r^4 (centroid), r^5 (second moments) of a series of degree
// n need 3n, 4n + 1 and 5n + 2. The area's integrand, r sqrt(r^2 + r_theta^2 + (r_phi/sin)^2), is
// smooth and converges fast.                           [Garboczi2002; docs/theory/form.md]
#include <clast/harmonics.h>

#include "base/alloc.h"
#include "math/legendre.h"
#include "math/vec3.h"
#include "shape/grain.h"
#include "shape/roundness.h"
#include "shape/whole.h"
#include <clast/grain.h>
#include <clast/mesh.h>
#include <math.h>

enum { LEAST_NODES = 120, MAX_LEVEL = 8 };

clast_status clast_harmonics_alloc(int32_t degree, clast_harmonics *series)
{
    CLX_ARGUMENTS(series);
    clast_status status = CLAST_OK;
    CLX_CHECK(degree >= 0 && degree <= CLAST_HARMONICS_MAX_DEGREE, CLAST_E_LIMIT,
              "a series of degree %d; 0 to %d is possible", degree, CLAST_HARMONICS_MAX_DEGREE);
    CLX_TRY(clx_alloc(&series->coefficient, clx_nm(degree + 1, 0), sizeof *series->coefficient));
    series->degree = degree;
done:
    return status;
}

void clast_harmonics_free(clast_harmonics *series)
{
    if (series == NULL) {
        return;
    }
    clx_free(series->coefficient);
    *series = (clast_harmonics){0};
}

static clast_status check_series(const char *function, const clast_harmonics *series)
{
    const char *fault = clx_harmonics_fault(series);
    return fault == NULL ? CLAST_OK : clx_fail(CLAST_E_GEOMETRY, "%s: series: %s", function, fault);
}

double clast_harmonics_power(const clast_harmonics *series, int32_t low, int32_t high)
{
    if (clx_harmonics_fault(series) != NULL) {
        return (double)NAN;
    }
    double power = 0.0;
    for (int32_t n = low < 0 ? 0 : low; n <= high && n <= series->degree; ++n) {
        for (int32_t m = 0; m <= n; ++m) {
            const double *c = series->coefficient[clx_nm(n, m)];
            power += m == 0 ? c[0] * c[0] : 0.5 * (c[0] * c[0] + c[1] * c[1]); // cos^2: 1/2
        }
    }
    return power;
}

/// What evaluation at one theta needs.
typedef struct {
    const clast_harmonics *series;
    int32_t degree; ///< terms used
    clx_legendre legendre;
    double *p, *slope;     ///< [terms] functions and their slopes at this theta
    double (*radius)[2];   ///< [degree + 1] sum over n of P a, P b
    double (*tilt)[2];     ///< the same of dP/dtheta
    double *node, *weight; ///< [n_node] Gauss rule
    int32_t n_node;
} evaluator;

static void evaluator_free(evaluator *e)
{
    clx_legendre_free(&e->legendre);
    CLX_FREE(e->p, e->slope, e->radius, e->tilt, e->node, e->weight);
    *e = (evaluator){0};
}

static clast_status evaluator_create(const clast_harmonics *series, int32_t degree, evaluator *e)
{
    clast_status status = CLAST_OK;
    const int32_t used = degree < 0 || degree > series->degree ? series->degree : degree;
    const int64_t n_term = clx_nm(used + 1, 0);
    CLX_CHECK(series->coefficient != NULL, CLAST_E_GEOMETRY, "an empty series has no surface");
    e->series = series;
    e->degree = used;
    e->n_node = 3 * used > LEAST_NODES ? 3 * used : LEAST_NODES;
    CLX_TRY(clx_legendre_create(used, &e->legendre));
    CLX_TRY(clx_alloc(&e->p, n_term, sizeof *e->p));
    CLX_TRY(clx_alloc(&e->slope, n_term, sizeof *e->slope));
    CLX_TRY(clx_alloc(&e->radius, (int64_t)used + 1, sizeof *e->radius));
    CLX_TRY(clx_alloc(&e->tilt, (int64_t)used + 1, sizeof *e->tilt));
    CLX_TRY(clx_alloc(&e->node, e->n_node, sizeof *e->node));
    CLX_TRY(clx_alloc(&e->weight, e->n_node, sizeof *e->weight));
done:
    return status;
}

/// out [degree + 1] = sum over n of f_nm times (a_nm, b_nm).
static void gather(const evaluator *e, const double *f, double (*out)[2])
{
    for (int32_t m = 0; m <= e->degree; ++m) {
        out[m][0] = 0.0;
        out[m][1] = 0.0;
        for (int32_t n = m; n <= e->degree; ++n) {
            const int32_t i = clx_nm(n, m);
            out[m][0] += f[i] * e->series->coefficient[i][0];
            out[m][1] += f[i] * e->series->coefficient[i][1];
        }
    }
}

/// r and, if asked for, dr/dtheta and dr/dphi at the azimuth with this cosine and sine.
static double radius_at(const evaluator *e, double cosine, double sine, double slope[2])
{
    double r = 0.0;
    double c = 1.0;
    double s = 0.0;
    double tilt = 0.0;
    double angle = 0.0;
    for (int32_t m = 0; m <= e->degree; ++m) {
        r += e->radius[m][0] * c + e->radius[m][1] * s;
        if (slope != NULL) {
            tilt += e->tilt[m][0] * c + e->tilt[m][1] * s;
            angle += m * (e->radius[m][1] * c - e->radius[m][0] * s);
        }
        const double next = c * cosine - s * sine;
        s = s * cosine + c * sine;
        c = next;
    }
    if (slope != NULL) {
        slope[0] = tilt;
        slope[1] = angle;
    }
    return r;
}

static clast_status not_positive(double r, const double direction[3])
{
    return clx_fail(CLAST_E_GEOMETRY,
                    "the radius is %g along (%.3g, %.3g, %.3g): the series is no star-shaped grain "
                    "at this degree",
                    r, direction[0], direction[1], direction[2]);
}

clast_status clast_harmonics_mesh(const clast_harmonics *series, int32_t degree, int level,
                                  clast_mesh *mesh)
{
    CLX_ARGUMENTS(series, mesh);
    CLX_GUARD(check_series(__func__, series));
    clast_status status = CLAST_OK;
    clast_mesh made = {0};
    evaluator e = {0};
    CLX_CHECK(level >= 0 && level <= MAX_LEVEL, CLAST_E_LIMIT, "level %d; 0 to %d is possible",
              level, MAX_LEVEL);
    CLX_TRY(evaluator_create(series, degree, &e));
    CLX_TRY(clast_mesh_ellipsoid((double[3]){1.0, 1.0, 1.0}, level, &made));
    for (int32_t v = 0; v < made.n_vert; ++v) {
        double *p = made.vert[v];
        const double sine = hypot(p[0], p[1]);
        clx_legendre_values(&e.legendre, p[2], sine, e.p);
        gather(&e, e.p, e.radius);
        const double r = sine > 0.0 ? radius_at(&e, p[0] / sine, p[1] / sine, NULL)
                                    : radius_at(&e, 1.0, 0.0, NULL);
        if (!(r > 0.0 && isfinite(r))) {
            status = not_positive(r, p);
            goto done;
        }
        v3_scale(p, r, p);
    }
    *mesh = made;
    made = (clast_mesh){0};
done:
    evaluator_free(&e);
    clast_mesh_free(&made);
    return status;
}

/// Integrals over directions.
typedef struct {
    double volume, first[3], second[3][3], area;
} star_sums;

static void add_direction(star_sums *sums, const double n[3], double r, double area, double weight)
{
    CLAST_ASSERT(r > 0.0 && v3_is_unit(n, 1e-9));
    const double r3 = weight * r * r * r;
    sums->volume += r3 / 3.0;
    sums->area += weight * area;
    for (int i = 0; i < 3; ++i) {
        sums->first[i] += r3 * r / 4.0 * n[i];
        for (int j = i; j < 3; ++j) {
            sums->second[i][j] += r3 * r * r / 5.0 * n[i] * n[j];
        }
    }
}

static clast_status integrate(evaluator *e, star_sums *sums)
{
    const int32_t n_phi = 2 * e->n_node;
    clx_gauss_legendre(e->n_node, e->node, e->weight);
    for (int32_t i = 0; i < e->n_node; ++i) {
        const double x = e->node[i];
        const double sine = sqrt((1.0 - x) * (1.0 + x));
        const double weight = e->weight[i] * 2.0 * CLAST_PI / n_phi;
        clx_legendre_values(&e->legendre, x, sine, e->p);
        clx_legendre_slopes(&e->legendre, x, sine, e->p, e->slope);
        gather(e, e->p, e->radius);
        gather(e, e->slope, e->tilt);
        for (int32_t k = 0; k < n_phi; ++k) {
            double slope[2];
            const double phi = 2.0 * CLAST_PI * k / n_phi;
            const double n[3] = {sine * cos(phi), sine * sin(phi), x};
            const double r = radius_at(e, cos(phi), sin(phi), slope);
            if (!(r > 0.0 && isfinite(r))) {
                return not_positive(r, n);
            }
            const double across = slope[1] / sine;
            add_direction(sums, n, r, r * sqrt(r * r + slope[0] * slope[0] + across * across),
                          weight);
        }
    }
    return CLAST_OK;
}

clast_status clast_harmonics_mass(const clast_harmonics *series, int32_t degree, clast_mass *mass,
                                  double *area)
{
    CLX_ARGUMENTS(series, mass);
    CLX_GUARD(check_series(__func__, series));
    clast_status status = CLAST_OK;
    evaluator e = {0};
    star_sums sums = {0};
    clast_mass made = {0};
    CLX_TRY(evaluator_create(series, degree, &e));
    CLX_TRY(integrate(&e, &sums));
    made.volume = sums.volume;
    v3_scale(made.centroid, 1.0 / sums.volume, sums.first);
    for (int i = 0; i < 3; ++i) {
        for (int j = i; j < 3; ++j) {
            sums.second[i][j] -= sums.volume * made.centroid[i] * made.centroid[j];
            sums.second[j][i] = sums.second[i][j];
        }
    }
    const double trace = sums.second[0][0] + sums.second[1][1] + sums.second[2][2];
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            made.inertia[i][j] = (i == j ? trace : 0.0) - sums.second[i][j];
        }
    }
    *mass = made;
    if (area != NULL) {
        *area = sums.area;
    }
done:
    evaluator_free(&e);
    return status;
}

clast_status clast_harmonics_measure(const clast_harmonics *series, int32_t degree, int level,
                                     clast_grain *grain)
{
    CLX_ARGUMENTS(series, grain);
    CLX_GUARD(check_series(__func__, series));
    clast_status status = CLAST_OK;
    clast_mesh mesh = {0};
    clast_grain made = {0};
    clast_mass mass = {0};
    double lying[3];
    double area = 0.0;
    CLX_TRY(clast_harmonics_mass(series, degree, &mass, &area));
    CLX_TRY(clast_harmonics_mesh(series, degree, level, &mesh));
    made.volume = mass.volume;
    made.area = clast_mesh_area(&mesh); // of the facets, for the means over them
    v3_copy(made.centroid, mass.centroid);
    for (int k = 0; k < 3; ++k) {
        v3_copy(made.inertia[k], mass.inertia[k]);
    }
    CLX_TRY(clx_grain_inertia(&made));
    CLX_TRY(clx_grain_hull(&mesh, &made, lying));
    clx_grain_surface_means(&mesh, &made);
    CLX_TRY(clx_grain_roundness(&mesh, lying, &made));
    made.area = area;
    clx_grain_ratios(&made);
    made.convexity = clast_mesh_volume(&mesh) / made.hull_volume; // both of the same facets
    made.hull_volume_added = 1.0 / made.convexity - 1.0;
    *grain = made;
done:
    clast_mesh_free(&mesh);
    return status;
}
