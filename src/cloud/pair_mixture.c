// Shapes and their coefficients: a few rounds of EM, which is slow where shapes are alike, then
// Newton's method within c >= 0. Sums over shells keep their order and are made for all shapes at
// once, in SIMD lanes: the same bytes on every machine.
#include "cloud/pair_mixture.h"

#include "base/machine.h"
#include "math/special.h"

#include <clast/machine.h>
#include <math.h>
#include <string.h>

enum {
    N_EM = 20,
    N_NEWTON = 40,
    N_HALVING = 10,
    SHELLS_A_STEP = 3 ///< from one s to the next, of those of pairs.c
};

static const double widest = 8.0;               ///< greatest s over the greatest distance
static const double step = 0.70710678118654752; ///< from one s to the next
static const double kink = 2.0;                 ///< length of exp(-r / L) over the s beside it
static const double pole = 3.0;                 ///< the same of exp(-sqrt(r / L))

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

/// Integral over it of 1 - r / 2h, h / 2r beyond h.
static double layer_in_ball(int32_t d, double h, double r)
{
    CLAST_ASSERT(d >= 1 && d <= 3 && h > 0.0);
    const double t = fmin(r / h, 1.0);
    const double b = fmax(r / h, 1.0);
    return d == 1 ? 2.0 * h * (t - 0.25 * t * t + 0.5 * log(b))
           : d == 2
               ? CLAST_PI * h * h * (t * t - t * t * t / 3.0 + b - 1.0)
               : CLAST_PI * h * h * h * (4.0 * t * t * t / 3.0 - 0.5 * t * t * t * t + b * b - 1.0);
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

static double shape_in_ball(clx_shape_family family, int32_t d, double s, double r)
{
    return family == CLX_FAMILY_KINKED    ? exp_in_ball(d, kink * s, r)
           : family == CLX_FAMILY_POLED   ? pole_in_ball(d, pole * s, r)
           : family == CLX_FAMILY_LAYERED ? layer_in_ball(d, s, r)
                                          : gauss_in_ball(d, s, r);
}

static double shape_at(clx_shape_family family, double s, double r)
{
    return family == CLX_FAMILY_KINKED    ? exp(-r / (kink * s))
           : family == CLX_FAMILY_POLED   ? exp(-sqrt(r / (pole * s)))
           : family == CLX_FAMILY_LAYERED ? (r < s ? 1.0 - 0.5 * r / s : 0.5 * s / r)
                                          : exp(-r * r / (4.0 * s * s));
}

/// Pairs within a ball for each unit of its integral of A.
static double pairs_of(const clx_mixture_fit *f)
{
    return 0.5 * f->in->n * (f->in->n - 1.0) / f->scale;
}

/// Numbers of the shells from `first` on, by the shape's formula.
static void count_shape(clx_mixture_fit *f, double s, clx_shape_family family, int32_t first)
{
    const clx_pair_shells *in = f->in;
    const int32_t j = f->n_shape;
    double before = first > 0 ? shape_in_ball(family, in->d, s, in->radius[first - 1]) : 0.0;
    for (int32_t k = first; k < in->n_shell; ++k) {
        const double within = shape_in_ball(family, in->d, s, in->radius[k]);
        f->mass[j][k] = pairs_of(f) * (within - before);
        before = within;
    }
}

/// Adds a shape of width s; wider: the shape of the same kind one step wider, -1 for none. Where
/// shells are sixths of an octave a step is three of them, and the wider shape's numbers serve.
static void add_shape(clx_mixture_fit *f, double s, clx_shape_family family, int32_t wider)
{
    CLAST_ASSERT(f->n_shape >= 0 && f->n_shape < CLX_MOST_SHAPE && wider < f->n_shape);
    const clx_pair_shells *in = f->in;
    const int32_t j = f->n_shape;
    const int32_t n_old = wider >= 0 && f->has_sixths ? in->n_shell - SHELLS_A_STEP : 0;
    const double smaller = pow(step, in->d);
    for (int32_t k = 0; k < n_old; ++k) {
        const double *from = f->mass[wider];
        double sum = from[k + SHELLS_A_STEP];
        for (int32_t i = 0; k == 0 && i < SHELLS_A_STEP; ++i) { // down to r = 0
            sum += from[i];
        }
        f->mass[j][k] = smaller * sum;
    }
    count_shape(f, s, family, n_old);
    f->total[j] = 0.0;
    for (int32_t k = 0; k < in->n_shell; ++k) {
        f->shell[k][j] = f->mass[j][k];
        f->total[j] += f->mass[j][k];
    }
    ++f->n_shape;
}

static bool has_sixths(const clx_pair_shells *in)
{
    bool is_so = in->n_shell > SHELLS_A_STEP;
    for (int32_t k = SHELLS_A_STEP; k < in->n_shell; ++k) {
        const double wanted = step * in->radius[k];
        is_so = is_so && fabs(in->radius[k - SHELLS_A_STEP] - wanted) <= 1e-12 * wanted;
    }
    return is_so;
}

/// Distance with so many pairs within it, and half of it as the least s.
static double least_scale(const clx_pair_shells *in)
{
    double sum = 0.0;
    for (int32_t k = 0; k < in->n_shell; ++k) {
        sum += in->pairs[k];
        if (sum >= CLX_MIXTURE_PAIRS) {
            return 0.5 * in->radius[k];
        }
    }
    return INFINITY;
}

int32_t clx_mixture_shapes(const clx_mixture_fit *f, int32_t level)
{
    const int32_t most = level < f->n_level ? level : f->n_level;
    return 1 + (f->family == CLX_FAMILY_SMOOTH ? 1 : 2) * most;
}

void clx_mixture_prepare(const clx_pair_shells *in, clx_shape_family family, double stretch,
                         clx_mixture_fit *f)
{
    double sum = 0.0;
    double spread = 0.0;
    for (int32_t k = 0; k < in->n_shell; ++k) {
        sum += in->pairs[k];
        spread += in->spread[k];
    }
    *f = (clx_mixture_fit){.in = in, .family = family, .s = {(double)INFINITY}};
    f->scale = sum > 0.0 ? fmax(1.0, spread / sum) : 1.0;
    for (int32_t k = 0; k < in->n_shell; ++k) {
        f->pairs[k] = in->pairs[k] / f->scale;
    }
    f->has_sixths = has_sixths(in);
    add_shape(f, INFINITY, CLX_FAMILY_SMOOTH, -1);
    const double least = least_scale(in);
    const int32_t back = family == CLX_FAMILY_SMOOTH ? 1 : 2; // shapes of a level
    double s = widest * in->radius[in->n_shell - 1];
    while (s >= least && f->n_shape + 2 <= CLX_MOST_SHAPE) {
        const int32_t wider = f->n_level > 0 ? f->n_shape - back : -1;
        if (family != CLX_FAMILY_SMOOTH) {
            add_shape(f, stretch * s, family, wider);
        }
        add_shape(f, stretch * s, CLX_FAMILY_SMOOTH, wider < 0 ? -1 : f->n_shape - back);
        f->s[++f->n_level] = stretch * s;
        s *= step;
    }
}

void clx_mixture_expect(const clx_mixture_fit *f, int32_t n_shape, const double *c, double *mean)
{
    CLAST_ASSERT(n_shape >= 1 && n_shape <= f->n_shape);
    memset(mean, 0, CLAST_MAX_SHELL * sizeof *mean);
    for (int32_t j = 0; j < n_shape; ++j) {
        for (int32_t k = 0; k < f->in->n_shell && c[j] > 0.0; ++k) {
            mean[k] += c[j] * f->mass[j][k];
        }
    }
}

/// The integral W of a shape of width s over a ball has s dW/ds = d W - r dW/dr.
void clx_mixture_slope(const clx_mixture_fit *f, int32_t n_shape, const double *c, double *slope)
{
    const clx_pair_shells *in = f->in;
    const int32_t a_level = f->family == CLX_FAMILY_SMOOTH ? 1 : 2;
    memset(slope, 0, CLAST_MAX_SHELL * sizeof *slope);
    for (int32_t j = 1; j < n_shape; ++j) {
        const int32_t level = (j + a_level - 1) / a_level;
        const clx_shape_family family = a_level * level == j ? CLX_FAMILY_SMOOTH : f->family;
        double before = 0.0;
        for (int32_t k = 0; k < in->n_shell && c[j] > 0.0; ++k) {
            const double r = in->radius[k];
            const double outer = ball(in->d) * pow(r, in->d) * shape_at(family, f->s[level], r);
            const double within = in->d * (shape_in_ball(family, in->d, f->s[level], r) - outer);
            slope[k] += c[j] * pairs_of(f) * (within - before);
            before = within;
        }
    }
}

void clx_mixture_solve(double *a, int32_t n, double *b)
{
    CLAST_ASSERT(n >= 0 && n <= CLX_MOST_SHAPE);
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
    int32_t used[CLX_MOST_SHAPE], n_used; ///< x > 0
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
    double a[CLX_MOST_SHAPE * CLX_MOST_SHAPE];
    for (int32_t i = 0; i < q->n_used; ++i) {
        z[i] = q->b[q->used[i]];
        for (int32_t j = 0; j < q->n_used; ++j) {
            a[i * q->n_used + j] = q->h[q->used[i] * q->n + q->used[j]] + (i == j ? 1e-10 : 0.0);
        }
    }
    clx_mixture_solve(a, q->n_used, z);
}

/// Goes towards the least over the used coordinates as far as the bounds allow, and drops those
/// that reach 0; true when it got there.
static bool approach(quadratic *q)
{
    double z[CLX_MOST_SHAPE];
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
static double objective(const clx_mixture_fit *f, int32_t n_shape, double tilt, const double *c,
                        double *mean)
{
    double sum = 0.0;
    clx_mixture_expect(f, n_shape, c, mean);
    for (int32_t k = 0; k < f->in->n_shell; ++k) {
        sum += (f->pairs[k] > 0.0 ? f->pairs[k] * log(mean[k]) : 0.0) - mean[k];
    }
    for (int32_t j = 0; j < n_shape; ++j) {
        sum -= tilt * c[j];
    }
    return sum;
}

/// Adds the shells' numbers for c = 1, each times the shell's weight, to sum [n_shape].
CLX_FOR_EACH_MACHINE
static void add_weighted(const clx_mixture_fit *f, int32_t n_shape, const double *weight,
                         double *sum)
{
    for (int32_t k = 0; k < f->in->n_shell; ++k) {
        const double own = weight[k];
        for (int32_t j = 0; j < n_shape; ++j) {
            sum[j] += f->shell[k][j] * own;
        }
    }
}

/// Sums over shells of weight times the numbers of two shapes: h [n_shape][n_shape], its lower
/// half.
CLX_FOR_EACH_MACHINE
static void add_products(const clx_mixture_fit *f, int32_t n_shape, const double *weight, double *h)
{
    for (int32_t k = 0; k < f->in->n_shell; ++k) {
        for (int32_t i = 0; i < n_shape; ++i) {
            const double own = f->shell[k][i] * weight[k];
            for (int32_t j = 0; j <= i; ++j) {
                h[i * n_shape + j] += own * f->shell[k][j];
            }
        }
    }
}

/// A quadratic form in the coefficients over their units, which make the diagonal 1.
typedef struct {
    double h[CLX_MOST_SHAPE * CLX_MOST_SHAPE]; ///< [n_shape][n_shape]
    double b[CLX_MOST_SHAPE], unit[CLX_MOST_SHAPE];
} expansion;

/// The objective about the mixture, which expects `mean`.
static void expand(const clx_mixture_fit *f, int32_t n_shape, double tilt, const double *mean,
                   const clx_mixture *m, expansion *e)
{
    double *h = e->h;
    double *b = e->b;
    double *unit = e->unit;
    double ratio[CLAST_MAX_SHELL] = {0};
    double weight[CLAST_MAX_SHELL] = {0};
    for (int32_t k = 0; k < f->in->n_shell; ++k) {
        ratio[k] = mean[k] > 0.0 ? f->pairs[k] / mean[k] : 0.0;
        weight[k] = mean[k] > 0.0 ? ratio[k] / mean[k] : 0.0;
    }
    memset(h, 0, (size_t)n_shape * (size_t)n_shape * sizeof *h);
    add_products(f, n_shape, weight, h);
    for (int32_t i = 0; i < n_shape; ++i) {
        b[i] = -tilt - f->total[i];
        unit[i] = h[i * n_shape + i] > 0.0 ? 1.0 / sqrt(h[i * n_shape + i]) : 0.0;
        for (int32_t j = 0; j < i; ++j) {
            h[j * n_shape + i] = h[i * n_shape + j];
        }
    }
    add_weighted(f, n_shape, ratio, b);
    for (int32_t i = 0; i < n_shape; ++i) {
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
}

/// One Newton step within c >= 0, as long as it gains; returns the gain.
static double newton(const clx_mixture_fit *f, int32_t n_shape, double tilt, clx_mixture *m)
{
    double mean[CLAST_MAX_SHELL];
    double x[CLX_MOST_SHAPE];
    expansion e;
    const double before = objective(f, n_shape, tilt, m->c, mean);
    expand(f, n_shape, tilt, mean, m, &e);
    minimise_quadratic(e.h, e.b, n_shape, x);
    double part = 1.0;
    for (int32_t round = 0; round < N_HALVING; ++round) {
        clx_mixture next = *m;
        for (int32_t j = 0; j < n_shape; ++j) {
            next.c[j] += part * (e.unit[j] * x[j] - m->c[j]);
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

static void maximise(const clx_mixture_fit *f, int32_t n_shape, double tilt, clx_mixture *m)
{
    double mean[CLAST_MAX_SHELL];
    for (int32_t round = 0; round < N_EM; ++round) {
        double ratio[CLAST_MAX_SHELL] = {0};
        double sum[CLX_MOST_SHAPE] = {0};
        clx_mixture_expect(f, n_shape, m->c, mean);
        for (int32_t k = 0; k < f->in->n_shell; ++k) {
            ratio[k] = mean[k] > 0.0 ? f->pairs[k] / mean[k] : 0.0;
        }
        add_weighted(f, n_shape, ratio, sum);
        for (int32_t j = 0; j < n_shape; ++j) {
            m->c[j] *= sum[j] / (f->total[j] + tilt);
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

static clx_mixture start(const clx_mixture_fit *f, int32_t n_shape)
{
    clx_mixture m = {{0}, 0.0, 0.0};
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

clx_mixture clx_mixture_best(const clx_mixture_fit *f, int32_t n_shape, double tilt)
{
    clx_mixture m = start(f, n_shape);
    maximise(f, n_shape, tilt, &m);
    return m;
}
