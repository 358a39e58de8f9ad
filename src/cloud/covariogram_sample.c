// Set covariance by quasi-Monte Carlo, where no formula is at hand.
//
// Closed surfaces and half pipes: lines through the body, by their entries. A point uniform on the
// surface S and a direction by the cosine law are a uniform line; with l its chord from there and
// [a, b] the chords further on,
//
//     c(r) = S/4 E[(l - r)+ + sum overlap of [r, r + l] with [a, b]]
//          = V - S r / 4 + S/4 E[(r - l)+ + sum (r - a + l)+ - (r - a)+ - (r - b + l)+ + (r - b)+]
//
// for E l = 4 V / S [Cauchy]. Only chords shorter than r weigh: at small r next to nothing is left
// to sampling. A caller's map: pairs of a uniform point with a point of each shell around it.
#include "cloud/covariogram.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "cloud/surface.h"
#include "math/rng.h"
#include <math.h>

enum {
    N_SHIFT = 16,
    N_SAMPLE = 8192,
    BLOCK = 1024,
    N_BLOCK = N_SAMPLE / BLOCK,
    MOST_CROSSING = 64
};

typedef struct {
    const clast_domain *domain;
    int32_t n;
    const double *radius;
    double area;
    double *area_to; ///< [n_tri] of a mesh: summed areas
    double *sum;     ///< [N_SHIFT * N_BLOCK][n + 1], the last of the chords
} sampler;

/// Numbers of the generalised golden ratio: the sequence frac(shift + k g^-j). [Roberts2018]
typedef struct {
    int n;
    double shift[7], step[7];
} sequence;

static sequence sequence_at(int64_t shift, int n)
{
    // roots of x^(n+1) = x + 1, n = 4 and 7
    const double base = n == 4 ? 1.1673039782614187 : 1.0969815577985598;
    clx_rng rng = clx_rng_at(0, CLX_STREAM_COVARIOGRAM, (uint64_t)shift);
    sequence q = {.n = n};
    double step = 1.0;
    for (int j = 0; j < n; ++j) {
        q.shift[j] = clx_rng_uniform(&rng);
        q.step[j] = step /= base;
    }
    return q;
}

static void quasi(const sequence *q, int64_t k, double *u)
{
    for (int j = 0; j < q->n; ++j) {
        const double at = q->shift[j] + (double)k * q->step[j];
        u[j] = at - floor(at);
    }
}

/// Direction by the cosine law about a unit normal.
static void cosine_law(const double normal[3], double u, double v, double direction[3])
{
    const int least = fabs(normal[0]) < 0.6 ? 0 : 1;
    double e[2][3];
    double axis[3] = {least == 0, least == 1, 0.0};
    const double along = axis[0] * normal[0] + axis[1] * normal[1];
    double length = 0.0;
    for (int j = 0; j < 3; ++j) {
        e[0][j] = axis[j] - along * normal[j];
        length += e[0][j] * e[0][j];
    }
    for (int j = 0; j < 3; ++j) {
        e[0][j] /= sqrt(length);
    }
    for (int j = 0; j < 3; ++j) {
        e[1][j] = normal[(j + 1) % 3] * e[0][(j + 2) % 3] - normal[(j + 2) % 3] * e[0][(j + 1) % 3];
    }
    const double sine = sqrt(u);
    for (int j = 0; j < 3; ++j) {
        direction[j] =
            sine * (cos(2.0 * CLAST_PI * v) * e[0][j] + sin(2.0 * CLAST_PI * v) * e[1][j]) +
            sqrt(1.0 - u) * normal[j];
    }
}

static double triangle_area(const clast_mesh *m, int32_t t, double inward[3])
{
    const double *p = m->vert[m->tri[t][0]];
    const double *q = m->vert[m->tri[t][1]];
    const double *r = m->vert[m->tri[t][2]];
    double length = 0.0;
    for (int j = 0; j < 3; ++j) {
        const int k = (j + 1) % 3;
        const int l = (j + 2) % 3;
        inward[j] = -((q[k] - p[k]) * (r[l] - p[l]) - (q[l] - p[l]) * (r[k] - p[k]));
        length += inward[j] * inward[j];
    }
    length = sqrt(length);
    for (int j = 0; j < 3; ++j) {
        inward[j] /= length > 0.0 ? length : 1.0;
    }
    return 0.5 * length;
}

/// A uniform point of the mesh and the inward normal there.
static void on_mesh(const sampler *s, double u, double v, double x[3], double inward[3])
{
    const clast_mesh *m = &s->domain->surface->mesh;
    int32_t low = 0;
    int32_t high = m->n_tri - 1;
    const double wanted = u * s->area;
    while (low < high) {
        const int32_t middle = (low + high) / 2;
        if (s->area_to[middle] > wanted) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    const double before = low > 0 ? s->area_to[low - 1] : 0.0;
    const double share = fmin(1.0, fmax(0.0, (wanted - before) / (s->area_to[low] - before)));
    const double root = sqrt(share);
    for (int j = 0; j < 3; ++j) {
        x[j] = (1.0 - root) * m->vert[m->tri[low][0]][j] +
               root * (1.0 - v) * m->vert[m->tri[low][1]][j] +
               root * v * m->vert[m->tri[low][2]][j];
    }
    (void)triangle_area(m, low, inward);
}

/// The same of a half pipe: round wall, flat wall, two ends.
static void on_half_pipe(const sampler *s, double u, double v, double x[3], double inward[3])
{
    const clast_domain *d = s->domain;
    const double round_wall = CLAST_PI * d->radius * d->length;
    const double flat = 2.0 * d->radius * d->length;
    double at = u * s->area;
    for (int j = 0; j < 3; ++j) {
        inward[j] = 0.0;
    }
    if (at < round_wall) {
        const double angle = CLAST_PI * at / round_wall;
        x[0] = d->radius * cos(angle);
        x[1] = d->radius * sin(angle);
        x[2] = v * d->length;
        inward[0] = -cos(angle);
        inward[1] = -sin(angle);
        return;
    }
    at -= round_wall;
    if (at < flat) {
        x[0] = d->radius * (2.0 * at / flat - 1.0);
        x[1] = 0.0;
        x[2] = v * d->length;
        inward[1] = 1.0;
        return;
    }
    const double share = fmin(1.0, (at - flat) / (CLAST_PI * d->radius * d->radius));
    const bool is_top = share >= 0.5;
    const double rho = d->radius * sqrt(is_top ? 2.0 * share - 1.0 : 2.0 * share);
    x[0] = rho * cos(CLAST_PI * v);
    x[1] = rho * sin(CLAST_PI * v);
    x[2] = is_top ? d->length : 0.0;
    inward[2] = is_top ? -1.0 : 1.0;
}

/// Where a line that enters a half pipe leaves it.
static double half_pipe_chord(const clast_domain *d, const double x[3], const double u[3])
{
    const double a = u[0] * u[0] + u[1] * u[1];
    const double b = x[0] * u[0] + x[1] * u[1];
    const double c = fmax(0.0, d->radius * d->radius - x[0] * x[0] - x[1] * x[1]);
    double chord = a > 0.0 ? (sqrt(b * b + a * c) - b) / a : (double)INFINITY;
    if (u[1] < 0.0) {
        chord = fmin(chord, x[1] / -u[1]);
    }
    if (u[2] != 0.0) {
        chord = fmin(chord, (u[2] > 0.0 ? d->length - x[2] : x[2]) / fabs(u[2]));
    }
    return fmax(chord, 0.0);
}

/// Crossings of a line behind its entry, out, in, out ..: as far as pairs within `distance` need.
static int crossings(const sampler *s, const double x[3], const double u[3], double distance,
                     double *t)
{
    const clast_domain *d = s->domain;
    if (d->kind == CLAST_DOMAIN_HALF_PIPE) {
        t[0] = half_pipe_chord(d, x, u);
        return 1;
    }
    const clast_mesh *m = &d->surface->mesh;
    const double size =
        fmax(d->high[0] - d->low[0], fmax(d->high[1] - d->low[1], d->high[2] - d->low[2]));
    double from = 1e-9 * size;
    int n = 0;
    clast_hit hit;
    while (n < MOST_CROSSING && clast_bvh_ray(d->surface->bvh, x, u, from,
                                              n == 0 ? 4.0 * size : t[0] + distance, &hit)) {
        double inward[3];
        (void)triangle_area(m, hit.tri, inward);
        const bool enters = u[0] * inward[0] + u[1] * inward[1] + u[2] * inward[2] > 0.0;
        if (enters == (n % 2 == 1)) { // a graze of the wrong side is none
            t[n++] = hit.t;
        }
        from = hit.t + 1e-9 * size;
    }
    return n;
}

/// Integral from 0 to R of 4 pi r^2 (r - c)+.
static double ramp(double radius, double c)
{
    if (c >= radius) {
        return 0.0;
    }
    const double r3 = radius * radius * radius;
    return CLAST_PI * (r3 * radius - c * c * c * c) - 4.0 / 3.0 * CLAST_PI * c * (r3 - c * c * c);
}

static void add_line(const sampler *s, const double u[4], double *sum)
{
    double x[3];
    double inward[3];
    double direction[3];
    double t[MOST_CROSSING];
    if (s->domain->kind == CLAST_DOMAIN_MESH) {
        on_mesh(s, u[0], u[1], x, inward);
    } else {
        on_half_pipe(s, u[0], u[1], x, inward);
    }
    cosine_law(inward, u[2], u[3], direction);
    const int n = crossings(s, x, direction, s->radius[s->n - 1], t);
    const double chord = n > 0 ? t[0] : 0.0;
    sum[s->n] += chord;
    for (int32_t i = 0; i < s->n; ++i) {
        const double r = s->radius[i];
        sum[i] += ramp(r, chord);
        for (int k = 1; k < n; k += 2) {
            sum[i] += ramp(r, t[k] - chord) - ramp(r, t[k]);
            sum[i] -= k + 1 < n ? ramp(r, t[k + 1] - chord) - ramp(r, t[k + 1]) : 0.0;
        }
    }
}

/// A uniform point of a map's domain, and whether one point of each shell about it is inside too.
static void add_point(const sampler *s, const double u[7], double *sum)
{
    const clast_domain *domain = s->domain;
    const int32_t d = domain->dimension;
    const double unit[3] = {2.0, CLAST_PI, 4.0 / 3.0 * CLAST_PI};
    double x[3];
    double y[3];
    double image[3];
    double total = 0.0;
    clast_domain_unmap(domain, u, x);
    const double z = d == 3 ? 2.0 * u[3] - 1.0 : 0.0;
    const double across = d == 1 ? 1.0 : sqrt(1.0 - z * z);
    const double angle = d == 1 ? (u[4] < 0.5 ? 0.0 : CLAST_PI) : 2.0 * CLAST_PI * u[4];
    for (int32_t i = 0; i < s->n; ++i) {
        const double low = i > 0 ? pow(s->radius[i - 1], d) : 0.0;
        const double high = pow(s->radius[i], d);
        const double r =
            pow(low + fmod(u[5] + 0.6180339887498949 * i, 1.0) * (high - low), 1.0 / d);
        y[0] = x[0] + r * across * cos(angle);
        if (d > 1) {
            y[1] = x[1] + r * across * sin(angle);
        }
        if (d > 2) {
            y[2] = x[2] + r * z;
        }
        total += clast_domain_map(domain, y, image) ? unit[d - 1] * (high - low) : 0.0;
        sum[i] += total;
    }
}

static void sample_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const sampler *s = context;
    (void)worker;
    for (int64_t block = begin; block < end; ++block) {
        const bool is_map = s->domain->kind == CLAST_DOMAIN_MAP;
        const sequence q = sequence_at(block / N_BLOCK, is_map ? 7 : 4);
        for (int64_t k = 0; k < BLOCK; ++k) {
            double u[7] = {0.0};
            quasi(&q, block % N_BLOCK * BLOCK + k, u);
            if (is_map) {
                add_point(s, u, s->sum + block * (s->n + 1));
            } else {
                add_line(s, u, s->sum + block * (s->n + 1));
            }
        }
    }
}

static clast_status measure_area(sampler *s)
{
    clast_status status = CLAST_OK;
    const clast_domain *d = s->domain;
    if (d->kind == CLAST_DOMAIN_HALF_PIPE) {
        s->area = (CLAST_PI + 2.0) * d->radius * d->length + CLAST_PI * d->radius * d->radius;
    }
    if (d->kind == CLAST_DOMAIN_MESH) {
        const clast_mesh *m = &d->surface->mesh;
        double inward[3];
        CLX_TRY(clx_alloc(&s->area_to, m->n_tri, sizeof *s->area_to));
        for (int32_t t = 0; t < m->n_tri; ++t) {
            s->area += triangle_area(m, t, inward);
            s->area_to[t] = s->area;
        }
    }
done:
    return status;
}

/// Mean of one shift.
static double mean_of(const sampler *s, int shift, int32_t i)
{
    CLAST_ASSERT(shift >= 0 && i >= 0 && i <= s->n);
    double sum = 0.0;
    for (int b = 0; b < N_BLOCK; ++b) {
        sum += s->sum[(int64_t)(shift * N_BLOCK + b) * (s->n + 1) + i];
    }
    return sum / N_SAMPLE;
}

/// Mean over the random shifts, and its standard error by their spread. The mean chord is known,
/// 4 V / S: its error is taken off by regression over the shifts.
static void gather(const sampler *s, double *integral, double *error)
{
    const double volume = clast_domain_volume(s->domain);
    const bool is_map = s->domain->kind == CLAST_DOMAIN_MAP;
    const double factor = is_map ? volume : 0.25 * s->area;
    const double chord = is_map ? 0.0 : volume / factor;
    for (int32_t i = 0; i < s->n; ++i) {
        const double r = s->radius[i];
        double mean = 0.0, off = 0.0, yy = 0.0, yc = 0.0, cc = 0.0;
        for (int shift = 0; shift < N_SHIFT; ++shift) {
            mean += mean_of(s, shift, i) / N_SHIFT;
            off += (mean_of(s, shift, s->n) - chord) / N_SHIFT;
        }
        for (int shift = 0; shift < N_SHIFT; ++shift) {
            const double y = mean_of(s, shift, i) - mean;
            const double c = mean_of(s, shift, s->n) - chord - off;
            yy += y * y;
            yc += y * c;
            cc += c * c;
        }
        const double slope = cc > 0.0 ? yc / cc : 0.0;
        const double known =
            is_map ? 0.0
                   : 4.0 / 3.0 * CLAST_PI * r * r * r * volume - factor * CLAST_PI * r * r * r * r;
        integral[i] = known + factor * (mean - slope * off);
        if (error != NULL) {
            const double left = fmax(0.0, yy - slope * yc);
            error[i] = factor * sqrt(left / (N_SHIFT * (N_SHIFT - 2.0)));
        }
    }
}

clast_status clx_covariogram_sample(const clast_domain *domain, int32_t n, const double *radius,
                                    double *integral, double *error)
{
    clast_status status = CLAST_OK;
    sampler s = {.domain = domain, .n = n, .radius = radius};
    CLX_TRY(measure_area(&s));
    CLX_TRY(clx_alloc(&s.sum, (int64_t)N_SHIFT * N_BLOCK * (n + 1), sizeof *s.sum));
    clx_parallel_for((int64_t)N_SHIFT * N_BLOCK, 1, sample_block, &s);
    gather(&s, integral, error);
done:
    clx_free(s.area_to);
    clx_free(s.sum);
    return status;
}
