// Population balance by the fixed pivot technique [Kumar1996]: a new particle of size v between two
// pivots becomes a share of each, such that number and mass are kept; below 1/(2^(1/p) - 1)
// monomers the pivots of single particles are the whole numbers, where nothing is shared. The
// second moment then grows by what lies between, unless the pivot below lends a little of its
// number; it does as far as it holds mass enough.
#include "cloud/sectional.h"

#include "base/alloc.h"
#include "cloud/collide.h"
#include "cloud/kernel_range.h"
#include <math.h>

enum { MOST_SECTIONS = 4000 };

void clx_sectional_free(clx_sectional *s)
{
    CLX_FREE(s->x, s->rate, s->share, s->lent, s->loan, s->lower, s->breaks, s->fragment, s->sink,
             s->source, s->as, s->is_outside);
    *s = (clx_sectional){0};
}

clast_status clx_sectional_grid(double low, double high, double step, int32_t per_octave,
                                clx_sectional *s)
{
    clast_status status = CLAST_OK;
    const double ratio = exp2(1.0 / per_octave);
    CLX_CHECK(low > 0.0 && high >= 4.0 * low && isfinite(high), CLAST_E_CONFIG,
              "size_max: a grid from %g to %g monomers leaves too few size classes above its "
              "smallest; give a larger one",
              low, high);
    CLX_TRY(clx_alloc(&s->x, MOST_SECTIONS, sizeof *s->x));
    double x = low;
    while (x < high * (1.0 + 1e-12)) {
        CLX_CHECK(s->n < MOST_SECTIONS, CLAST_E_LIMIT,
                  "the grid from %g to %g monomers has more than %d sections; take fewer an octave",
                  low, high, MOST_SECTIONS);
        s->x[s->n++] = x;
        x = fmax(x + step, x * ratio);
    }
done:
    return status;
}

/// Number of the pivot at or below v; -1 below the grid.
static int32_t pivot_below(const clx_sectional *s, double v)
{
    int32_t low = -1;
    int32_t high = s->n;
    while (high - low > 1) {
        const int32_t middle = low + (high - low) / 2;
        if (s->x[middle] <= v) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

void clx_sectional_add(const clx_sectional *s, double v, double number, double *n_at)
{
    const int32_t i = pivot_below(s, v);
    if (i < 0 || i == s->n - 1) {
        const int32_t end = i < 0 ? 0 : i;
        n_at[end] += number * v / s->x[end];
        return;
    }
    const double share = (s->x[i + 1] - v) / (s->x[i + 1] - s->x[i]);
    n_at[i] += number * share;
    n_at[i + 1] += number * (1.0 - share);
}

double clx_sectional_lent(const clx_sectional *s, double v, int32_t i)
{
    CLAST_ASSERT(i >= 0 && i + 1 < s->n);
    const double *x = s->x + i;
    return i > 0 ? (v - x[0]) * (x[1] - v) / ((x[0] - x[-1]) * (x[1] - x[-1])) : 0.0;
}

void clx_sectional_lend(const clx_sectional *s, int32_t i, double mass_below, double mass,
                        double gain[3])
{
    static const double ENOUGH = 3.0; // so many times the mass below: all of it is lent
    CLAST_ASSERT(i > 0 && i + 1 < s->n);
    const double *x = s->x + i;
    const double has = fmax(0.0, mass_below);
    const double part = has > 0.0 ? fmin(1.0, (1.0 + ENOUGH) * has / (has + fmax(0.0, mass))) : 0.0;
    gain[0] = -part * x[-1];
    gain[2] = -part * x[1] * (x[0] - x[-1]) / (x[1] - x[0]);
    gain[1] = -gain[0] - gain[2];
}

clast_collider clx_collider_of_size(const clast_collide_config *c, double x)
{
    const double solid = c->monomer_radius;
    clast_collider seen = {.monomers = x, .mass = x, .radius = clx_aggregate_radius(c, x)};
    if (solid > 0.0 && c->medium.particle_density > 0.0) {
        seen.mass = 4.0 / 3.0 * CLAST_PI * solid * solid * solid * c->medium.particle_density * x;
    }
    return seen;
}

static double kernel_at(const clast_collide_config *collide, double x, double y)
{
    clast_collider pair[2] = {clx_collider_of_size(collide, x), clx_collider_of_size(collide, y)};
    for (int k = 0; k < 2 && (clast_kernel_needs(collide->kernel) & CLAST_NEEDS_SETTLING) != 0;
         ++k) {
        pair[k].settling_speed = clast_kernel_settling_speed(&collide->medium, &pair[k]);
    }
    const double value = clast_kernel_value(collide->kernel, &collide->medium, &pair[0], &pair[1]);
    return collide->sticking.law == CLAST_STICKING_CONSTANT
               ? value
               : value * clx_sticking_of(collide, &collide->medium, &pair[0], &pair[1]);
}

bool clx_kernel_gels(const clast_collide_config *collide, double x)
{
    static const double DEGREE_ABOVE_1 = 2.02;
    return kernel_at(collide, x, 0.5 * x) > DEGREE_ABOVE_1 * kernel_at(collide, 0.5 * x, 0.25 * x);
}

static void fill_pairs(const clast_collide_config *collide, clx_sectional *s)
{
    const int64_t n = s->n;
    const bool is_law = collide->sticking.law != CLAST_STICKING_CONSTANT;
    for (int32_t j = 0; j < s->n; ++j) {
        const clast_collider *a = &s->as[j];
        for (int32_t k = j; k < s->n; ++k) {
            const clast_collider *b = &s->as[k];
            const double v = s->x[j] + s->x[k];
            const int32_t i = v > s->x[n - 1] * (1.0 + 1e-12) ? s->n : pivot_below(s, v);
            const bool is_between = i < s->n - 1;
            s->rate[j * n + k] =
                collide->alpha * clast_kernel_value(collide->kernel, &collide->medium, a, b);
            if (is_law) {
                s->rate[j * n + k] *= clx_sticking_of(collide, &collide->medium, a, b);
            }
            s->lower[j * n + k] = i;
            s->share[j * n + k] = is_between ? (s->x[i + 1] - v) / (s->x[i + 1] - s->x[i]) : 1.0;
            s->lent[j * n + k] = is_between ? clx_sectional_lent(s, v, i) : 0.0;
        }
    }
}

/// Marks pairs out of a range.
static clast_status fill_ranges(const clast_collide_config *collide, clx_sectional *s)
{
    clast_status status = CLAST_OK;
    const int64_t n = s->n;
    if (s->ranges == 0) {
        return CLAST_OK;
    }
    CLX_TRY(clx_alloc(&s->is_outside, n * n, sizeof *s->is_outside));
    for (int32_t j = 0; j < s->n; ++j) {
        for (int32_t k = j; k < s->n; ++k) {
            const clast_collider pair[2] = {s->as[j], s->as[k]};
            clast_range_use use = {0};
            clx_range_add(s->ranges, collide, &collide->medium, pair, 1.0, &use);
            s->is_outside[j * n + k] = use.outside > 0.0;
        }
    }
done:
    return status;
}

static double rate_at(const clx_sectional *s, const double *y, int32_t j, int32_t k)
{
    CLAST_ASSERT(j >= 0 && j < s->n && k >= 0 && k < s->n);
    return (j == k ? 0.5 : 1.0) * s->rate[(int64_t)j * s->n + k] * y[j] * y[k] * s->monomers /
           s->x[j] * s->monomers / s->x[k];
}

void clx_sectional_ranges(const clx_sectional *s, const clast_collide_config *collide,
                          const double *y, double weight, clast_range_use *use)
{
    static const double TELLING = 1e-6; // share of all collisions that can be the farthest told
    clast_range_use outside = {0};
    double total = 0.0;
    for (int32_t j = 0; j < s->n; ++j) {
        for (int32_t k = j; k < s->n; ++k) {
            total += fmax(0.0, rate_at(s, y, j, k));
        }
    }
    for (int32_t j = 0; j < s->n && s->is_outside != NULL; ++j) {
        for (int32_t k = j; k < s->n; ++k) {
            const double rate = s->is_outside[(int64_t)j * s->n + k] ? rate_at(s, y, j, k) : 0.0;
            if (rate > TELLING * total) {
                const clast_collider pair[2] = {s->as[j], s->as[k]};
                clx_range_add(s->ranges, collide, &collide->medium, pair, weight * rate, &outside);
            }
        }
    }
    outside.n = weight * total;
    clx_range_merge(use, &outside);
}

/// Integral of v^e from a to b.
static double power_between(double e, double a, double b)
{
    CLAST_ASSERT(a > 0.0 && b > 0.0);
    return fabs(e + 1.0) < 1e-12 ? log(b / a) : (pow(b, e + 1.0) - pow(a, e + 1.0)) / (e + 1.0);
}

/// Fragments of a particle of size 1 by the power law, (c + 2) u^c, shared between the pivots u0 <
/// u1 (as shares of the parent) that they lie between.
static void share_power(double c, double u0, double u1, double *low, double *high)
{
    const double number = (c + 2.0) * power_between(c, u0, u1);
    const double mass = (c + 2.0) * power_between(c + 1.0, u0, u1);
    *high = (mass - u0 * number) / (u1 - u0);
    *low = number - *high;
}

/// Fragments of a particle at pivot k, so that their mass is x_k to rounding.
static void fill_fragments(const clast_spectrum_config *config, clx_sectional *s, int32_t k)
{
    double *made = s->fragment + (int64_t)k * s->n;
    const double x = s->x[k];
    const double c = config->fragment_exponent;
    double mass = 0.0;
    if (config->fragments == CLAST_FRAGMENTS_HALVES) {
        clx_sectional_add(s, 0.5 * x, 2.0, made);
    } else {
        made[0] = pow(s->x[0] / x, c + 2.0) * x / s->x[0]; // all below the grid, by mass
        for (int32_t i = 0; i < k; ++i) {
            double low = 0.0;
            double high = 0.0;
            share_power(c, s->x[i] / x, s->x[i + 1] / x, &low, &high);
            made[i] += low;
            made[i + 1] += high;
        }
    }
    for (int32_t i = 0; i <= k; ++i) {
        mass += made[i] * s->x[i];
    }
    for (int32_t i = 0; i <= k; ++i) {
        made[i] *= x / mass;
    }
}

clast_status clx_sectional_rates(const clast_spectrum_config *config,
                                 const clast_collide_config *collide, clx_sectional *s)
{
    clast_status status = CLAST_OK;
    const int64_t n = s->n;
    CLX_TRY(clx_alloc(&s->rate, n * n, sizeof *s->rate));
    CLX_TRY(clx_alloc(&s->share, n * n, sizeof *s->share));
    CLX_TRY(clx_alloc(&s->lent, n * n, sizeof *s->lent));
    CLX_TRY(clx_alloc(&s->loan, n, sizeof *s->loan));
    CLX_TRY(clx_alloc(&s->lower, n * n, sizeof *s->lower));
    CLX_TRY(clx_alloc(&s->breaks, n, sizeof *s->breaks));
    CLX_TRY(clx_alloc(&s->sink, n, sizeof *s->sink));
    CLX_TRY(clx_alloc(&s->source, n, sizeof *s->source));
    CLX_TRY(clx_alloc(&s->as, n, sizeof *s->as));
    const bool falls = config->settling_depth > 0.0;
    for (int32_t i = 0; i < s->n; ++i) {
        s->as[i] = clx_collider_of_size(collide, s->x[i]);
        if (falls || (clast_kernel_needs(collide->kernel) & CLAST_NEEDS_SETTLING) != 0) {
            s->as[i].settling_speed = clast_kernel_settling_speed(&collide->medium, &s->as[i]);
        }
    }
    s->ranges = clx_ranges_of(collide) | (falls ? clx_ranges_of_settling(collide) : 0);
    fill_pairs(collide, s);
    CLX_TRY(fill_ranges(collide, s));
    if (config->breakage_rate > 0.0) {
        CLX_TRY(clx_alloc(&s->fragment, n * n, sizeof *s->fragment));
        for (int32_t k = 1; k < s->n; ++k) { // the smallest do not break
            s->breaks[k] = config->breakage_rate * pow(s->x[k], config->breakage_exponent);
            fill_fragments(config, s, k);
        }
    }
    if (config->source > 0.0) {
        clx_sectional_add(s, config->source_size, config->source / s->monomers, s->source);
    }
    for (int32_t i = 0; i < s->n; ++i) {
        s->source[i] *= s->x[i];
        if (config->settling_depth > 0.0) {
            s->sink[i] = fabs(s->as[i].settling_speed) / config->settling_depth;
        }
    }
done:
    return status;
}

/// Where the monomers of an event of the pair (j, k) go: y lost at j and k, gained at i and above,
/// for one event a volume and time.
typedef struct {
    int32_t i;      ///< lower pivot; n + CLX_GEL beyond the grid
    double gain[2]; ///< at i and i + 1
    double lent[3]; ///< beside that at i - 1, i and i + 1
    double loss[2]; ///< at j and k
} transfer;

static transfer transfer_of(const clx_sectional *s, int32_t j, int32_t k)
{
    CLAST_ASSERT(j >= 0 && j < s->n && k >= 0 && k < s->n);
    const int64_t at = (int64_t)j * s->n + k;
    const double unit = 1.0 / s->monomers;
    transfer t = {.i = s->lower[at], .loss = {s->x[j] * unit, s->x[k] * unit}};
    const double v = t.loss[0] + t.loss[1];
    t.gain[0] = v;
    if (t.i < s->n - 1) {
        t.gain[0] = s->share[at] * s->x[t.i] * unit;
        t.gain[1] = v - t.gain[0];
        for (int m = 0; m < 3 && s->lent[at] > 0.0; ++m) {
            t.lent[m] = s->lent[at] * unit * s->loan[t.i][m];
        }
    } else if (t.i == s->n) {
        t.i = s->n + CLX_GEL;
    }
    return t;
}

/// Adds what so many events move.
static void add_transfer(const transfer *t, int32_t j, int32_t k, double event, double *to)
{
    to[j] -= event * t->loss[0];
    to[k] -= event * t->loss[1];
    to[t->i] += event * t->gain[0];
    if (t->gain[1] != 0.0) {
        to[t->i + 1] += event * t->gain[1];
    }
    for (int m = 0; m < 3 && t->lent[0] != 0.0; ++m) {
        to[t->i - 1 + m] += event * t->lent[m];
    }
}

static void fill_loans(const clx_sectional *s, const double *y)
{
    for (int32_t i = 1; i + 1 < s->n; ++i) {
        clx_sectional_lend(s, i, y[i - 1], y[i], s->loan[i]);
    }
}

void clx_sectional_slope(clx_sectional *s, const double *y, double *slope)
{
    const int64_t n = s->n;
    ++s->n_evaluation;
    fill_loans(s, y);
    for (int64_t i = 0; i < n; ++i) {
        slope[i] = s->source[i] - s->sink[i] * y[i];
    }
    slope[n + CLX_GEL] = 0.0;
    slope[n + CLX_SETTLED] = 0.0;
    slope[n + CLX_ADDED] = 0.0;
    for (int64_t i = 0; i < n; ++i) {
        slope[n + CLX_ADDED] += s->source[i];
    }
    for (int32_t j = 0; j < s->n; ++j) {
        const double at_j = y[j] * s->monomers / s->x[j];
        slope[n + CLX_SETTLED] += s->sink[j] * y[j];
        for (int32_t k = j; k < s->n && at_j != 0.0; ++k) {
            const double event =
                (j == k ? 0.5 : 1.0) * s->rate[j * n + k] * at_j * y[k] * s->monomers / s->x[k];
            const transfer t = transfer_of(s, j, k);
            add_transfer(&t, j, k, event, slope);
        }
    }
    for (int32_t k = 1; k < s->n && s->fragment != NULL; ++k) {
        const double broken = s->breaks[k] * y[k]; // monomers a time
        slope[k] -= broken;
        for (int32_t i = 0; i <= k; ++i) {
            slope[i] += broken * s->fragment[k * n + i] * s->x[i] / s->x[k];
        }
    }
}

void clx_sectional_jacobian(const clx_sectional *s, const double *y, double *const *column)
{
    const int64_t n = s->n;
    fill_loans(s, y);
    for (int64_t c = 0; c < n + CLX_N_BESIDE; ++c) {
        for (int64_t i = 0; i < n + CLX_N_BESIDE; ++i) {
            column[c][i] = 0.0;
        }
    }
    for (int32_t j = 0; j < s->n; ++j) {
        column[j][j] -= s->sink[j];
        column[j][n + CLX_SETTLED] += s->sink[j];
        for (int32_t k = j; k < s->n; ++k) {
            const double unit = s->rate[j * n + k] * s->monomers / s->x[j] * s->monomers / s->x[k];
            const double by[2] = {j == k ? 0.5 * unit * y[k] : unit * y[k],
                                  j == k ? 0.5 * unit * y[j] : unit * y[j]}; // d event / d y_j, y_k
            const transfer t = transfer_of(s, j, k);
            for (int e = 0; e < 2; ++e) {
                add_transfer(&t, j, k, by[e], column[e == 0 ? j : k]);
            }
        }
    }
    for (int32_t k = 1; k < s->n && s->fragment != NULL; ++k) {
        column[k][k] -= s->breaks[k];
        for (int32_t i = 0; i <= k; ++i) {
            column[k][i] += s->breaks[k] * s->fragment[k * n + i] * s->x[i] / s->x[k];
        }
    }
}
