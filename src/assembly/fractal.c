// Fractal dimensions of an assembly: from its growth, and from the distances of its grains.
#include <clast/structure.h>

#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/status.h"
#include "math/vec3.h"

enum { MAX_POINTS = 40, N_RADIUS = 16, MAX_GRAINS = 4000 };

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

static double grain_volume(const clast_assembly *a, int32_t i)
{
    const double s = a->scale[i];
    return s * s * s * a->shape[a->shape_id[i]].volume;
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
    const double v = grain_volume(a, i);
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

/// Volume-weighted counts of pairs within each radius (rising), as grains about a mean grain.
static void count_pairs(const clast_assembly *assembly, int32_t stride, const double *radius,
                        double *count)
{
    double weight = 0.0;
    for (int32_t i = 0; i < assembly->n_grain; i += stride) {
        const double v = grain_volume(assembly, i);
        weight += v;
        for (int32_t j = 0; j < i; j += stride) {
            const double d2 = v3_distance2(assembly->position[i], assembly->position[j]);
            const double w = 2.0 * v * grain_volume(assembly, j);
            for (int k = N_RADIUS - 1; k >= 0 && d2 <= radius[k] * radius[k]; --k) {
                count[k] += w;
            }
        }
    }
    for (int k = 0; k < N_RADIUS; ++k) {
        count[k] *= assembly->n_grain / (weight * weight);
    }
}

clast_status clast_fractal_correlation(const clast_assembly *assembly, clast_fractal *fractal)
{
    CLX_ARGUMENTS(assembly, fractal);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    line_fit fit = {0};
    double radius[N_RADIUS];
    double count[N_RADIUS] = {0};
    CLX_CHECK(assembly->n_grain >= 3, CLAST_E_USAGE, "fractal dimension of %d grains",
              assembly->n_grain);
    const double a = mean_radius(assembly);
    const double low = 4.0 * a;
    const double high = clast_assembly_radius_of_gyration(assembly);
    CLX_CHECK(high > 1.5 * low, CLAST_E_GEOMETRY,
              "fractal dimension: radius of gyration %.3g is less than 1.5 times two mean "
              "diameters %.3g",
              high, low);
    for (int k = 0; k < N_RADIUS; ++k) {
        radius[k] = low * pow(high / low, k / (N_RADIUS - 1.0));
    }
    count_pairs(assembly, 1 + (assembly->n_grain - 1) / MAX_GRAINS, radius, count);
    for (int k = 0; k < N_RADIUS; ++k) {
        if (count[k] > 0.0) {
            fit.x[fit.n] = log(radius[k]);
            fit.y[fit.n++] = log(count[k]);
        }
    }
    CLX_TRY(fit_line(&fit, a, fractal));
done:
    return status;
}
