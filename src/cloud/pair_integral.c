// Integral of the squared density as the value at r = 0 of the density's autocorrelation
//
//     A(r) = average over directions u of the integral of f(x) f(x + r u) dx,
//
// which the pairs in shells of distance show for r > 0. A is fitted as a mixture of Gaussians in r,
// A(r) = sum c_j exp(-r^2 / (4 s_j^2)), c_j >= 0: every function that is completely monotone in r^2
// [Schoenberg1938]. Blobs, sheets, lines, plumes, their sums on any background and, by exp(-r / L),
// densities with jumps are of this kind; by exp(-sqrt(r / L)) such with poles. The narrowest s is
// the widest one that fits as well as narrower ones; the interval is that of the profile likelihood
// of Poisson numbers with shapes of half that width allowed, widened by the projection term. A
// density with a pole shows narrower structure the more points there are: a width counts as seen
// where a part of the points would show it too. [docs/theory/pairs.md section 4]
#include "cloud/pair_integral.h"

#include "base/alloc.h"
#include "cloud/resolution.h"
#include "math/special.h"
#include <math.h>
#include <string.h>

enum {
    MOST_SHAPE = 81,
    MOST_USED = 24,
    N_EM = 20,
    N_NEWTON = 40,
    N_HALVING = 10,
    N_BISECT = 12,
    N_STRETCH = 7,    ///< widths tried between two levels
    LEAST_PAIRS = 10, ///< within twice the narrowest width that is looked at
    FINER = 2,        ///< levels narrower than the chosen one that the interval allows
    STAYS = 1,        ///< levels that lie between a width and that of fewer points by chance
    MOST_MOVED = 3    ///< the same in the family where more lie between
};

/// Where the choices of the fit stand; all measured in docs/theory/pairs.md.
static const double widest = 8.0;               ///< greatest s over the greatest distance
static const double step = 0.70710678118654752; ///< from one s to the next
static const double gain_needed = 4.0;  ///< twice the gain in log-likelihood that a narrower s asks
static const double stretch_loss = 0.5; ///< the same that a wider s between two levels may lose
static const double kink = 2.0;         ///< length of exp(-r / L) over the s beside it
static const double pole = 3.0;         ///< the same of exp(-sqrt(r / L))
static const double most_doubt = 0.3;   ///< half width of the profile's interval, as a logarithm,
                                        ///< with which a cloud is resolved
static const double fewer = 0.2;        ///< share of the points that must show the same width
static const double most_hidden = 0.05; ///< most that a pole may add to the value, as a logarithm,
                                        ///< where they do not
static const double most_size = 0.125;  ///< of the domain's: pairs closer than that and than the
                                        ///< narrowest s must be so many
static const double least_pairs = 500.0;
static const double least_even = 1000.0;  ///< the same where nothing narrower than that size shows
static const double most_repeated = 0.05; ///< share of repeated points' pairs in the window
static const double chi2_95 = 3.841458820694124;
static const double normal_975 = 1.959963984540054;

/// What stands beside each Gaussian: nothing, exp(-r / L), exp(-sqrt(r / L)).
typedef enum { FAMILY_SMOOTH, FAMILY_KINKED, FAMILY_POLED } shape_family;

typedef struct {
    const clx_pair_shells *in;
    shape_family family;
    int32_t n_shape;                          ///< 1 + n_level, or 1 + 2 n_level with a companion
    int32_t n_level;                          ///< widths below the uniform shape
    double s[MOST_SHAPE];                     ///< of each level, descending, the first INFINITY
    double mass[MOST_SHAPE][CLAST_MAX_SHELL]; ///< pairs in each shell for c = 1
    double total[MOST_SHAPE];                 ///< pairs in all shells
    double scale;                             ///< of edge-corrected pairs in Poisson numbers
    double pairs[CLAST_MAX_SHELL];            ///< divided by it
} fit;

typedef struct {
    double c[MOST_SHAPE];
    double likelihood, integral;
} mixture;

static double ball(int32_t d)
{
    CLAST_ASSERT(d >= 1 && d <= 3);
    return d == 1 ? 2.0 : d == 2 ? CLAST_PI : 4.0 / 3.0 * CLAST_PI;
}

/// Integral of exp(-r^2 / (4 s^2)) over the ball of radius r.
static double gauss_in_ball(int32_t d, double s, double r)
{
    if (isinf(s)) {
        return ball(d) * pow(r, d);
    }
    return pow(4.0 * CLAST_PI * s * s, 0.5 * d) * clx_gamma_p(0.5 * d, r * r / (4.0 * s * s));
}

/// Integral of exp(-r / length) over it.
static double exp_in_ball(int32_t d, double length, double r)
{
    CLAST_ASSERT(d >= 1 && d <= 3 && length > 0.0);
    const double unit[3] = {2.0, 2.0 * CLAST_PI, 8.0 * CLAST_PI};
    return unit[d - 1] * pow(length, d) * clx_gamma_p(d, r / length);
}

/// Integral of exp(-sqrt(r / length)) over it.
static double pole_in_ball(int32_t d, double length, double r)
{
    CLAST_ASSERT(d >= 1 && d <= 3 && length > 0.0);
    const double unit[3] = {4.0, 24.0 * CLAST_PI, 960.0 * CLAST_PI};
    return unit[d - 1] * pow(length, d) * clx_gamma_p(2 * d, sqrt(r / length));
}

static double shape_in_ball(shape_family family, int32_t d, double s, double r)
{
    return family == FAMILY_KINKED  ? exp_in_ball(d, kink * s, r)
           : family == FAMILY_POLED ? pole_in_ball(d, pole * s, r)
                                    : gauss_in_ball(d, s, r);
}

static void add_shape(fit *f, double s, shape_family family)
{
    CLAST_ASSERT(f->n_shape >= 0 && f->n_shape < MOST_SHAPE);
    const clx_pair_shells *in = f->in;
    const double n_pair = 0.5 * in->n * (in->n - 1.0) / f->scale;
    const int32_t j = f->n_shape++;
    double before = 0.0;
    f->total[j] = 0.0;
    for (int32_t k = 0; k < in->n_shell; ++k) {
        const double within = shape_in_ball(family, in->d, s, in->radius[k]);
        f->mass[j][k] = n_pair * (within - before);
        f->total[j] += f->mass[j][k];
        before = within;
    }
}

/// Distance with so many pairs within it, and half of it as the least s.
static double least_scale(const clx_pair_shells *in)
{
    double sum = 0.0;
    for (int32_t k = 0; k < in->n_shell; ++k) {
        sum += in->pairs[k];
        if (sum >= LEAST_PAIRS) {
            return 0.5 * in->radius[k];
        }
    }
    return INFINITY;
}

/// Shapes of a level and all wider ones.
static int32_t shapes(const fit *f, int32_t level)
{
    const int32_t most = level < f->n_level ? level : f->n_level;
    return 1 + (f->family == FAMILY_SMOOTH ? 1 : 2) * most;
}

/// The shapes, all widths times `stretch`.
static void prepare(const clx_pair_shells *in, shape_family family, double stretch, fit *f)
{
    double sum = 0.0;
    double spread = 0.0;
    for (int32_t k = 0; k < in->n_shell; ++k) {
        sum += in->pairs[k];
        spread += in->spread[k];
    }
    *f = (fit){.in = in, .family = family, .s = {(double)INFINITY}};
    f->scale = sum > 0.0 ? fmax(1.0, spread / sum) : 1.0;
    for (int32_t k = 0; k < in->n_shell; ++k) {
        f->pairs[k] = in->pairs[k] / f->scale;
    }
    add_shape(f, INFINITY, FAMILY_SMOOTH);
    const double least = least_scale(in);
    double s = widest * in->radius[in->n_shell - 1];
    while (s >= least && f->n_shape + 2 <= MOST_SHAPE) {
        if (family != FAMILY_SMOOTH) {
            add_shape(f, stretch * s, family);
        }
        add_shape(f, stretch * s, FAMILY_SMOOTH);
        f->s[++f->n_level] = stretch * s;
        s *= step;
    }
}

static void expect(const fit *f, int32_t n_shape, const double *c, double *mean)
{
    CLAST_ASSERT(n_shape >= 1 && n_shape <= f->n_shape);
    memset(mean, 0, CLAST_MAX_SHELL * sizeof *mean);
    for (int32_t j = 0; j < n_shape; ++j) {
        for (int32_t k = 0; k < f->in->n_shell && c[j] > 0.0; ++k) {
            mean[k] += c[j] * f->mass[j][k];
        }
    }
}

/// Solves a x = b, a symmetric and positive definite [n][n], by Cholesky; a is lost.
static void solve(double *a, int n, double *b)
{
    CLAST_ASSERT(n >= 0 && n <= MOST_SHAPE);
    for (int j = 0; j < n; ++j) {
        for (int k = 0; k < j; ++k) {
            for (int i = j; i < n; ++i) {
                a[i * n + j] -= a[i * n + k] * a[j * n + k];
            }
        }
        const double root = sqrt(fmax(a[j * n + j], 1e-300));
        for (int i = j; i < n; ++i) {
            a[i * n + j] /= root;
        }
    }
    for (int j = 0; j < n; ++j) {
        for (int k = 0; k < j; ++k) {
            b[j] -= a[j * n + k] * b[k];
        }
        b[j] /= a[j * n + j];
    }
    for (int j = n - 1; j >= 0; --j) {
        for (int k = j + 1; k < n; ++k) {
            b[j] -= a[k * n + j] * b[k];
        }
        b[j] /= a[j * n + j];
    }
}

/// A least of x' H x / 2 - b' x over x >= 0, H [n][n] with a unit diagonal.
typedef struct {
    const double *h, *b;
    int32_t n;
    double scale; ///< greatest |b|
    double *x;
    int32_t used[MOST_SHAPE], n_used; ///< x > 0
} quadratic;

/// The unused coordinate along which the form falls most, -1 where it falls along none.
static int32_t find_descent(const quadratic *q)
{
    double most = 1e-10 * q->scale;
    int32_t found = -1;
    for (int32_t j = 0; j < q->n; ++j) {
        double w = q->b[j];
        for (int32_t i = 0; i < q->n_used; ++i) {
            w -= q->h[j * q->n + q->used[i]] * q->x[q->used[i]];
        }
        if (q->x[j] == 0.0 && w > most) {
            most = w;
            found = j;
        }
    }
    return found;
}

/// The least over the used coordinates, without bounds.
static void solve_used(const quadratic *q, double *z)
{
    double a[MOST_SHAPE * MOST_SHAPE];
    for (int32_t i = 0; i < q->n_used; ++i) {
        z[i] = q->b[q->used[i]];
        for (int32_t j = 0; j < q->n_used; ++j) {
            a[i * q->n_used + j] = q->h[q->used[i] * q->n + q->used[j]] + (i == j ? 1e-10 : 0.0);
        }
    }
    solve(a, q->n_used, z);
}

/// Goes towards the least over the used coordinates as far as the bounds allow, and drops those
/// that reach 0; true when it got there.
static bool approach(quadratic *q)
{
    double z[MOST_SHAPE];
    double part = 1.0;
    int32_t stops = -1; // the first to reach 0: dropped in any case, so that there is an end
    int32_t n_active = 0;
    solve_used(q, z);
    for (int32_t i = 0; i < q->n_used; ++i) {
        const double x = q->x[q->used[i]];
        if (z[i] <= 0.0 && x <= part * (x - z[i])) {
            part = x > 0.0 ? x / (x - z[i]) : 0.0;
            stops = i;
        }
    }
    for (int32_t i = 0; i < q->n_used; ++i) {
        const int32_t j = q->used[i];
        const double next = q->x[j] + part * (z[i] - q->x[j]);
        q->x[j] = next > 1e-14 * q->scale && i != stops ? next : 0.0;
        if (q->x[j] > 0.0) {
            q->used[n_active++] = j;
        }
    }
    q->n_used = n_active;
    return stops < 0;
}

/// The active-set method of Lawson and Hanson (1974).
static void minimise_quadratic(const double *h, const double *b, int32_t n, double *x)
{
    quadratic q = {.h = h, .b = b, .n = n, .x = x};
    for (int32_t j = 0; j < n; ++j) {
        x[j] = 0.0;
        q.scale = fmax(q.scale, fabs(b[j]));
    }
    for (int32_t round = 0; round < 3 * n; ++round) {
        const int32_t enters = find_descent(&q);
        if (enters < 0) {
            return;
        }
        q.used[q.n_used++] = enters;
        while (q.n_used > 0 && !approach(&q)) {
        }
    }
}

/// Poisson log-likelihood less tilt times the integral.
static double objective(const fit *f, int32_t n_shape, double tilt, const double *c, double *mean)
{
    double sum = 0.0;
    expect(f, n_shape, c, mean);
    for (int32_t k = 0; k < f->in->n_shell; ++k) {
        sum += (f->pairs[k] > 0.0 ? f->pairs[k] * log(mean[k]) : 0.0) - mean[k];
    }
    for (int32_t j = 0; j < n_shape; ++j) {
        sum -= tilt * c[j];
    }
    return sum;
}

/// One Newton step within c >= 0, as long as it gains; returns the gain.
static double newton(const fit *f, int32_t n_shape, double tilt, mixture *m)
{
    double mean[CLAST_MAX_SHELL];
    double h[MOST_SHAPE * MOST_SHAPE];
    double b[MOST_SHAPE];
    double x[MOST_SHAPE];
    double unit[MOST_SHAPE];
    const double before = objective(f, n_shape, tilt, m->c, mean);
    for (int32_t i = 0; i < n_shape; ++i) {
        b[i] = -tilt - f->total[i];
        for (int32_t k = 0; k < f->in->n_shell; ++k) {
            b[i] += mean[k] > 0.0 ? f->mass[i][k] * f->pairs[k] / mean[k] : 0.0;
        }
        for (int32_t j = 0; j <= i; ++j) {
            double sum = 0.0;
            for (int32_t k = 0; k < f->in->n_shell; ++k) {
                sum += mean[k] > 0.0
                           ? f->mass[i][k] * f->mass[j][k] * f->pairs[k] / (mean[k] * mean[k])
                           : 0.0;
            }
            h[i * n_shape + j] = h[j * n_shape + i] = sum;
        }
    }
    for (int32_t i = 0; i < n_shape; ++i) {
        unit[i] = h[i * n_shape + i] > 0.0 ? 1.0 / sqrt(h[i * n_shape + i]) : 0.0;
        for (int32_t j = 0; j < n_shape; ++j) {
            b[i] += h[i * n_shape + j] * m->c[j];
        }
    }
    for (int32_t i = 0; i < n_shape; ++i) {
        b[i] *= unit[i];
        for (int32_t j = 0; j < n_shape; ++j) {
            h[i * n_shape + j] *= unit[i] * unit[j];
        }
    }
    minimise_quadratic(h, b, n_shape, x);
    double part = 1.0;
    for (int32_t round = 0; round < N_HALVING; ++round) {
        mixture next = *m;
        for (int32_t j = 0; j < n_shape; ++j) {
            next.c[j] += part * (unit[j] * x[j] - m->c[j]);
        }
        const double gain = objective(f, n_shape, tilt, next.c, mean) - before;
        if (gain > 0.0) {
            *m = next;
            return gain;
        }
        part *= 0.5;
    }
    return 0.0;
}

/// Maximises the Poisson log-likelihood less tilt times the integral from m->c: a few rounds of EM,
/// which is slow where shapes are alike, then Newton's method.
static void maximise(const fit *f, int32_t n_shape, double tilt, mixture *m)
{
    double mean[CLAST_MAX_SHELL];
    for (int32_t round = 0; round < N_EM; ++round) {
        expect(f, n_shape, m->c, mean);
        for (int32_t j = 0; j < n_shape; ++j) {
            double sum = 0.0;
            for (int32_t k = 0; k < f->in->n_shell; ++k) {
                sum += mean[k] > 0.0 ? f->mass[j][k] * f->pairs[k] / mean[k] : 0.0;
            }
            m->c[j] *= sum / (f->total[j] + tilt);
        }
    }
    for (int32_t round = 0; round < N_NEWTON && newton(f, n_shape, tilt, m) > 1e-4; ++round) {
    }
    m->likelihood = objective(f, n_shape, 0.0, m->c, mean);
    m->integral = 0.0;
    for (int32_t j = 0; j < n_shape; ++j) {
        m->integral += m->c[j];
    }
}

static mixture start(const fit *f, int32_t n_shape)
{
    mixture m = {{0}, 0.0, 0.0};
    double sum = 0.0;
    double mass = 0.0;
    for (int32_t k = 0; k < f->in->n_shell; ++k) {
        sum += f->pairs[k];
    }
    for (int32_t j = 0; j < n_shape; ++j) {
        mass += f->total[j];
    }
    for (int32_t j = 0; j < n_shape; ++j) {
        m.c[j] = sum / mass;
    }
    return m;
}

static mixture best(const fit *f, int32_t n_shape, double tilt)
{
    mixture m = start(f, n_shape);
    maximise(f, n_shape, tilt, &m);
    return m;
}

/// Integral where twice the log-likelihood has fallen by the quantile: the most (up) or least one.
static double bound(const fit *f, int32_t n_shape, const mixture *top, double factor, bool up)
{
    double least_total = INFINITY;
    for (int32_t j = 0; j < n_shape; ++j) {
        least_total = fmin(least_total, f->total[j]);
    }
    // the tilt as a share of the least total: -1 .. 0 up, 0 .. infinity down
    double low = 0.0;
    double high = 1.0;
    mixture m = *top;
    const double wanted = top->likelihood - 0.5 * chi2_95 * factor;
    for (int b = 0; b < 60 && !up; ++b) {
        m = best(f, n_shape, high * least_total);
        if (m.likelihood < wanted) {
            break;
        }
        high *= 4.0;
    }
    for (int b = 0; b < N_BISECT; ++b) {
        const double middle = 0.5 * (low + high);
        m = best(f, n_shape, (up ? -middle : middle) * least_total);
        if (m.likelihood < wanted) {
            high = middle;
        } else {
            low = middle;
        }
    }
    return m.integral;
}

/// How the sum of the coefficients (more < 0), or the coefficient of a shape `more` that is added,
/// answers to the numbers of pairs: a row of (M W M')^-1 M W of weighted least squares with the
/// shapes in use.
static void response(const fit *f, const mixture *m, int32_t n_shape, int32_t more, double *row)
{
    double mean[CLAST_MAX_SHELL];
    double a[MOST_USED * MOST_USED];
    double b[MOST_USED];
    int32_t used[MOST_USED];
    int32_t n = 0;
    expect(f, n_shape, m->c, mean);
    for (int32_t j = f->n_shape - 1; j >= 0 && n < MOST_USED; --j) { // narrow ones first
        if (j == more || (j < n_shape && m->c[j] * f->total[j] > 1e-3)) {
            used[n++] = j;
        }
    }
    for (int32_t i = 0; i < n; ++i) {
        b[i] = more < 0 || used[i] == more ? 1.0 : 0.0;
        for (int32_t j = 0; j < n; ++j) {
            double sum = 0.0;
            for (int32_t k = 0; k < f->in->n_shell; ++k) {
                sum += mean[k] > 0.0 ? f->mass[used[i]][k] * f->mass[used[j]][k] / mean[k] : 0.0;
            }
            a[i * n + j] = sum * (i == j ? 1.0 + 1e-9 : 1.0);
        }
    }
    solve(a, n, b);
    for (int32_t k = 0; k < f->in->n_shell; ++k) {
        row[k] = 0.0;
        for (int32_t i = 0; i < n; ++i) {
            row[k] += mean[k] > 0.0 ? b[i] * f->mass[used[i]][k] / mean[k] : 0.0;
        }
    }
}

/// Variance of a linear form of the numbers of pairs, by their covariance and as if they were
/// Poisson numbers.
static void variances(const fit *f, const mixture *m, int32_t n_shape, const double *row,
                      double *full, double *poisson)
{
    double mean[CLAST_MAX_SHELL];
    const int32_t n = f->in->n_shell;
    expect(f, n_shape, m->c, mean);
    *full = *poisson = 0.0;
    for (int32_t k = 0; k < n; ++k) {
        *poisson += row[k] * row[k] * mean[k];
        for (int32_t l = 0; l < n; ++l) {
            *full += row[k] * row[l] * f->in->covariance[k * n + l] / (f->scale * f->scale);
        }
    }
}

/// p of Pearson's statistic of the fitted shape, shells joined to 10 expected pairs.
static double fit_p(const fit *f, int32_t n_shape, const mixture *m)
{
    double mean[CLAST_MAX_SHELL];
    double chi2 = 0.0;
    double seen = 0.0;
    double expected = 0.0;
    int n = 0;
    expect(f, n_shape, m->c, mean);
    for (int32_t k = 0; k < f->in->n_shell; ++k) {
        seen += f->pairs[k];
        expected += mean[k];
        if (expected >= 10.0) {
            chi2 += (seen - expected) * (seen - expected) / expected;
            seen = expected = 0.0;
            ++n;
        }
    }
    return n > 1 ? clx_chi2_sf(chi2, n - 1) : 1.0;
}

/// Variance of the share of a shape two levels below over that of Poisson numbers: pairs of one
/// point with many neighbours do not count as so many numbers. At least 1.
static double overdispersion(const fit *f, const mixture *m, int32_t level)
{
    double row[CLAST_MAX_SHELL] = {0};
    double full = 0.0;
    double poisson = 0.0;
    const int32_t more = shapes(f, level + FINER) - 1;
    if (level == f->n_level) {
        return 1.0;
    }
    response(f, m, shapes(f, level), more, row);
    variances(f, m, shapes(f, level), row, &full, &poisson);
    return poisson > 0.0 ? fmax(1.0, full / poisson) : 1.0;
}

/// What one family of shapes says.
typedef struct {
    int32_t level, moved;      ///< levels from that of fewer points to it
    double likelihood, factor; ///< and the overdispersion that it is to be divided by
    double value, low, high, s;
    double least, most; ///< of the profile alone
    double fit_p;
} answer;

/// Twice the gain in log-likelihood that a narrower level asks for where a share of the points
/// shall show it: their pairs are share^2 as many, and have share as many neighbours.
static double gain_of(double share, double factor)
{
    return gain_needed * (1.0 + share * (factor - 1.0)) / (share * share);
}

/// The widest level that fits as well as all, and how far from it `fewer` points would stop: all
/// the way where they would show no structure at all.
static mixture choose_level(const fit *f, answer *a)
{
    const mixture all = best(f, f->n_shape, 0.0);
    mixture m = best(f, 1, 0.0);
    int32_t of_fewer = -1;
    for (*a = (answer){.level = 0};; m = best(f, shapes(f, ++a->level), 0.0)) {
        const double gain = 2.0 * (all.likelihood - m.likelihood);
        a->factor = overdispersion(f, &m, a->level);
        of_fewer = of_fewer < 0 && gain <= gain_of(fewer, a->factor) ? a->level : of_fewer;
        if (a->level == f->n_level || gain <= gain_of(1.0, a->factor)) {
            break;
        }
    }
    of_fewer = of_fewer < 0 ? a->level : of_fewer;
    a->moved = of_fewer == 0 && a->level > 0 ? f->n_level : a->level - of_fewer;
    return m;
}

/// The k-th of the factors between two levels, 1 the first.
static double stretch_of(int k)
{
    CLAST_ASSERT(k >= 0 && k <= N_STRETCH);
    return pow(step, -(double)k / (N_STRETCH + 1));
}

/// The greatest of N_STRETCH widths from the level to the one above that fits as well as the best
/// of them. Each is tried, for the likelihood does not fall steadily: a width between two levels is
/// fitted best where one of them meets it.
static double widest_stretch(fit *f, const answer *a, double likelihood)
{
    double found[N_STRETCH + 1] = {likelihood};
    double most = likelihood;
    int k = a->level > 0 ? N_STRETCH : 0;
    for (int q = 1; q <= k; ++q) {
        prepare(f->in, f->family, stretch_of(q), f);
        found[q] = best(f, shapes(f, a->level), 0.0).likelihood;
        most = fmax(most, found[q]);
    }
    while (k > 0 && 2.0 * (most - found[k]) > stretch_loss * a->factor) {
        --k;
    }
    return stretch_of(k);
}

static answer ask(fit *f)
{
    answer a;
    mixture m = choose_level(f, &a);
    const double factor = a.factor;
    const double enough = widest_stretch(f, &a, m.likelihood);
    prepare(f->in, f->family, enough, f);
    m = best(f, shapes(f, a.level), 0.0);
    const int32_t finer = a.level == 0 ? 1 : shapes(f, a.level + FINER);
    const mixture top = best(f, finer, 0.0);
    const double low = bound(f, finer, &top, factor, false);
    const double high = bound(f, finer, &top, factor, true);
    double row[CLAST_MAX_SHELL] = {0};
    double full = 0.0;
    double poisson = 0.0;
    response(f, &m, shapes(f, a.level), -1, row);
    variances(f, &m, shapes(f, a.level), row, &full, &poisson);
    const double shared = normal_975 * sqrt(fmax(0.0, full - poisson)) / m.integral;
    a.value = m.integral;
    a.least = fmin(low, a.value);
    a.most = fmax(high, a.value);
    a.low = a.value * exp(-hypot(log(a.value / a.least), shared));
    a.high = a.value * exp(hypot(log(a.most / a.value), shared));
    a.s = f->s[a.level];
    a.likelihood = m.likelihood;
    a.fit_p = fit_p(f, shapes(f, a.level), &m);
    return a;
}

/// Pairs that decide the integral: within three widths of the narrowest shape, nine tenths of its
/// own in 3-D.
static void set_window(const clx_pair_shells *in, clast_pair_integral *result)
{
    int32_t k = 0;
    double n_pair = in->pairs[0];
    while (k + 1 < in->n_shell && in->radius[k] < 3.0 * result->scale) {
        n_pair += in->pairs[++k];
    }
    result->window = in->radius[k];
    result->n_pair = (int64_t)llround(n_pair);
}

/// Pairs closer than r; beyond the last shell as in an even cloud.
static double pairs_within(const clx_pair_shells *in, double r)
{
    double sum = 0.0;
    double before = 0.0;
    for (int32_t k = 0; k < in->n_shell; ++k) {
        const double inner = pow(before, in->d);
        const double part = (pow(r, in->d) - inner) / (pow(in->radius[k], in->d) - inner);
        sum += fmin(1.0, fmax(0.0, part)) * in->pairs[k];
        before = in->radius[k];
    }
    return r > before ? sum * pow(r / before, in->d) : sum;
}

/// Whether a part of the points would show the same widths, or else a pole can add but little.
static bool is_steady(const clx_pair_shells *in, const answer *smooth, const answer *kinked,
                      double value, fit *f)
{
    const int32_t least = smooth->moved < kinked->moved ? smooth->moved : kinked->moved;
    const int32_t most = smooth->moved > kinked->moved ? smooth->moved : kinked->moved;
    if (least <= STAYS && most <= MOST_MOVED) {
        return true;
    }
    prepare(in, FAMILY_POLED, 1.0, f);
    const answer poled = ask(f);
    return log(poled.most / value) <= most_hidden;
}

/// The families' mean by their likelihoods, and the hull of their intervals.
static clast_estimate average(const answer *smooth, const answer *kinked)
{
    const double factor = fmax(smooth->factor, kinked->factor);
    const double share = 1.0 / (1.0 + exp((smooth->likelihood - kinked->likelihood) / factor));
    return (clast_estimate){exp((1.0 - share) * log(smooth->value) + share * log(kinked->value)),
                            fmin(smooth->low, kinked->low), fmax(smooth->high, kinked->high),
                            false};
}

clast_status clx_pair_integral(const clx_pair_shells *in, clast_pair_integral *result)
{
    clast_status status = CLAST_OK;
    clast_pair_integral made = {.scale = INFINITY};
    fit *f = NULL;
    CLX_TRY(clx_alloc(&f, 1, sizeof *f));
    prepare(in, FAMILY_SMOOTH, 1.0, f);
    if (f->n_level == 0) { // next to no pairs
        made.estimate = (clast_estimate){NAN, 0.0, INFINITY, false};
        made.fit_p = 1.0;
        set_window(in, &made);
        made.n_needed = in->n * sqrt(10.0 * LEAST_PAIRS / fmax(1.0, (double)made.n_pair));
        *result = made;
        goto done;
    }
    const answer smooth = ask(f);
    const int32_t n_level = f->n_level;
    prepare(in, FAMILY_KINKED, 1.0, f);
    const answer kinked = ask(f);
    clast_estimate *e = &made.estimate;
    *e = average(&smooth, &kinked);
    const bool is_seen = smooth.level + 1 < n_level && kinked.level + 1 < n_level;
    const double doubt =
        0.5 * log(fmax(smooth.most, kinked.most) / fmin(smooth.least, kinked.least));
    const double size = most_size * pow(in->volume, 1.0 / (double)in->d);
    const double least = smooth.s < size ? least_pairs : least_even;
    const double close = pairs_within(in, fmin(smooth.s, size));
    const bool is_allowed = clx_resolution_allows(in->ladder, in->n * (in->n - 1.0) * e->value);
    e->resolved = is_seen && is_allowed && doubt <= most_doubt && close >= least;
    const bool is_chance = e->resolved && !is_steady(in, &smooth, &kinked, e->value, f);
    e->resolved = e->resolved && !is_chance;
    made.scale = smooth.s;
    made.fit_p = fmax(smooth.fit_p, kinked.fit_p);
    made.n_needed = in->n;
    set_window(in, &made);
    if (!e->resolved) { // the doubt falls as the root of the pairs
        const double more = fmax(doubt / most_doubt, sqrt(least / fmax(1.0, close)));
        const double steady = is_chance ? 1.0 / fewer : 1.1; // these are then the fewer points
        made.n_needed = is_seen && is_allowed ? in->n * fmax(steady, more) : (double)INFINITY;
        e->high = INFINITY;
    }
    if (in->ladder->n_repeated > most_repeated * (double)made.n_pair) {
        e->low = (double)NAN; // there is no density at the places of repeated points
        e->high = INFINITY;
        e->resolved = false;
        made.n_needed = INFINITY;
    }
    *result = made;
done:
    clx_free(f);
    return status;
}
