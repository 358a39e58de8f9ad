// Fractal dimensions of an assembly: from its growth, and from the distances of its grains.
#include <clast/assembly.h>

#include "assembly/ball_cut.h"
#include "assembly/whole.h"
#include "base/status.h"
#include "math/special.h"
#include "math/vec3.h"
#include <clast/shape.h>

enum { MAX_POINTS = 40, N_RADIUS = 16, MAX_GRAINS = 4000, MIN_CENTRES = 200, N_SHELL = 64 };

/// What a slope counts as in the edge's correction where it is less.
static const double LEAST_DIMENSION = 0.1;

/// Points (log R, log N) and the straight line through them.
typedef struct line_fit {
    int32_t n;
    double x[MAX_POINTS], y[MAX_POINTS];
} line_fit;

/// y = c + D (x - mean x) by least squares; k = exp(y at R = a).
static clast_status fit_line(const line_fit *fit, double a, clast_fractal *fractal)
{
    clast_status status = CLAST_OK;
    double mx = 0.0;
    double my = 0.0;
    double sxx = 0.0;
    double sxy = 0.0;
    double rest = 0.0;
    CLX_CHECK(fit->n >= 3, CLAST_E_USAGE, "fractal dimension: %d points to fit, 3 at least",
              fit->n);
    for (int32_t i = 0; i < fit->n; ++i) {
        mx += fit->x[i] / fit->n;
        my += fit->y[i] / fit->n;
    }
    for (int32_t i = 0; i < fit->n; ++i) {
        sxx += (fit->x[i] - mx) * (fit->x[i] - mx);
        sxy += (fit->x[i] - mx) * (fit->y[i] - my);
    }
    CLX_CHECK(sxx > 1e-12, CLAST_E_GEOMETRY, "fractal dimension: the radius does not grow");
    const double slope = sxy / sxx;
    for (int32_t i = 0; i < fit->n; ++i) {
        const double d = fit->y[i] - my - slope * (fit->x[i] - mx);
        rest += d * d;
    }
    const double variance = rest / (fit->n - 2);
    const double offset = log(a) - mx;
    *fractal = (clast_fractal){
        .dimension = slope,
        .dimension_error = sqrt(variance / sxx),
        .prefactor = exp(my + slope * offset),
        .low = exp(fit->x[0]),
        .high = exp(fit->x[fit->n - 1]),
        .n = fit->n,
    };
    fractal->prefactor_error =
        fractal->prefactor * sqrt(variance * (1.0 / fit->n + offset * offset / sxx));
done:
    return status;
}

/// Volume-equivalent radius of the mean grain.
static double mean_radius(const clast_assembly *a)
{
    return cbrt(0.75 / CLAST_PI * clast_assembly_volume(a) / a->n_grain);
}

/// Sums over grains that give the radius of gyration of the solid, grain after grain.
typedef struct gyration {
    double volume, first[3], second;
} gyration;

static void add_grain(gyration *g, const clast_assembly *a, int32_t i)
{
    const clast_shape *shape = &a->shape[a->shape_id[i]];
    const double s = a->scale[i];
    const double v = clx_grain_volume(a, i);
    double d[3];
    v3_sub(d, a->position[i], a->position[0]);
    g->volume += v;
    v3_axpy(g->first, g->first, v, d);
    g->second +=
        v * v3_norm2(d) + 0.5 * s * s * s * s * s *
                              (shape->inertia[0][0] + shape->inertia[1][1] + shape->inertia[2][2]);
}

static double gyration_radius(const gyration *g)
{
    CLAST_ASSERT(g->volume >= 0.0);
    return sqrt(fmax(0.0, g->second / g->volume - v3_norm2(g->first) / (g->volume * g->volume)));
}

clast_status clast_fractal_growth(const clast_assembly *assembly, int32_t n_first,
                                  clast_fractal *fractal)
{
    CLX_ARGUMENTS(assembly, fractal);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    line_fit fit = {0};
    gyration g = {0};
    const int32_t n = assembly->n_grain;
    CLX_CHECK(n_first >= 1 && n_first < n, CLAST_E_USAGE,
              "fractal dimension: growth from grain %d of %d", n_first, n);
    const double a = mean_radius(assembly);
    const double unit = clast_assembly_volume(assembly) / n;
    const double ratio = pow((double)n / n_first, 1.0 / (MAX_POINTS - 1));
    double wanted = n_first;
    for (int32_t i = 0; i < n; ++i) {
        add_grain(&g, assembly, i);
        if (i + 1 >= wanted * (1.0 - 1e-12) && fit.n < MAX_POINTS) {
            fit.x[fit.n] = log(gyration_radius(&g));
            fit.y[fit.n++] = log(g.volume / unit);
            while (wanted <= i + 1) {
                wanted *= ratio;
            }
        }
    }
    CLX_TRY(fit_line(&fit, a, fractal));
done:
    return status;
}

/// Radii from low to high, and the solid within each of a mean grain's centre.
typedef struct around {
    double radius[N_RADIUS];
    double solid[N_RADIUS]; ///< in units of the mean grain, volume-weighted over the centres
} around;

/// Adds the part of a ball (a grain of equal volume v, its centre at distance d) within each
/// radius.
static void add_within(around *c, double v, double ball, double d, double weight)
{
    for (int k = N_RADIUS - 1; k >= 0 && c->radius[k] > d - ball; --k) {
        c->solid[k] +=
            weight * (c->radius[k] >= d + ball ? v : clx_ball_within(ball, d, c->radius[k]));
    }
}

/// About all grains, or of more than 4000 about as many of them, even over the order of growth, as
/// that takes pairs.
static void count_solid(const clast_assembly *assembly, around *c)
{
    const int32_t n = assembly->n_grain;
    const double unit = clast_assembly_volume(assembly) / n;
    const int32_t share = (int32_t)((double)MAX_GRAINS * MAX_GRAINS / n);
    const int32_t n_centre = n <= MAX_GRAINS ? n : share > MIN_CENTRES ? share : MIN_CENTRES;
    double weight = 0.0;
    for (int32_t m = 0; m < n_centre; ++m) {
        const double at = 0.61803398874989485 * (m + 1.0);
        const int32_t i = n_centre == n ? m : (int32_t)((at - floor(at)) * n);
        const double v = clx_grain_volume(assembly, i);
        weight += v;
        for (int32_t j = 0; j < n; ++j) {
            const double vj = clx_grain_volume(assembly, j);
            add_within(c, vj, cbrt(0.75 / CLAST_PI * vj),
                       v3_distance(assembly->position[i], assembly->position[j]), v);
        }
    }
    for (int k = 0; k < N_RADIUS; ++k) {
        c->solid[k] /= weight * unit;
    }
}

/// Share of what lies within r of a point, mean over the points of a D-dimensional ball of radius
/// R, that lies in the ball too: the mean over s = r t^(1/D) of I_x((D + 1) / 2, 1/2), the share of
/// the ball that it has in common with itself moved by s, x = 1 - (s / 2R)^2.
static double share_inside(double dimension, double r, double ball)
{
    CLAST_ASSERT(dimension >= 0.0 && ball >= 0.0);
    double sum = 0.0;
    for (int k = 0; k < N_SHELL; ++k) {
        const double u = 0.5 * r / ball * pow((k + 0.5) / N_SHELL, 1.0 / dimension);
        sum += clx_beta_i(1.0 - fmin(1.0, u * u), 0.5 * (dimension + 1.0), 0.5) / N_SHELL;
    }
    return sum;
}

/// The line through the counts, each by the share of its sphere that lies inside of the body: a
/// ball of the dimension sought and the solid's radius of gyration, Rg^2 = R^2 D / (D + 2).
static clast_status fit_inside(const around *c, double radius, double a, clast_fractal *fractal)
{
    clast_status status = CLAST_OK;
    clast_fractal f = {0};
    double dimension = 0.0;
    for (int pass = 0; pass < 100; ++pass) {
        line_fit fit = {0};
        const double ball = dimension > 0.0 ? radius * sqrt(1.0 + 2.0 / dimension) : HUGE_VAL;
        for (int k = 0; k < N_RADIUS; ++k) {
            const double inside =
                dimension > 0.0 ? share_inside(dimension, c->radius[k], ball) : 1.0;
            fit.x[fit.n] = log(c->radius[k]);
            fit.y[fit.n++] = log(c->solid[k] / inside);
        }
        CLX_TRY(fit_line(&fit, a, &f));
        const double step = f.dimension - dimension;
        dimension = fmax(f.dimension, LEAST_DIMENSION);
        if (fabs(step) < 1e-9) {
            break;
        }
    }
    *fractal = f;
done:
    return status;
}

clast_status clast_fractal_correlation(const clast_assembly *assembly, clast_fractal *fractal)
{
    CLX_ARGUMENTS(assembly, fractal);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    around c = {{0}, {0}};
    gyration g = {0};
    CLX_CHECK(assembly->n_grain >= 3, CLAST_E_USAGE, "fractal dimension of %d grains",
              assembly->n_grain);
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        add_grain(&g, assembly, i);
    }
    const double a = mean_radius(assembly);
    const double low = 4.0 * a;
    const double high = gyration_radius(&g);
    CLX_CHECK(high > 1.5 * low, CLAST_E_GEOMETRY,
              "fractal dimension: radius of gyration %.3g is less than 1.5 times two mean "
              "diameters %.3g",
              high, low);
    for (int k = 0; k < N_RADIUS; ++k) {
        c.radius[k] = low * pow(high / low, k / (N_RADIUS - 1.0));
    }
    count_solid(assembly, &c);
    CLX_TRY(fit_inside(&c, high, a, fractal));
done:
    return status;
}
