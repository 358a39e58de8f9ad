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
#include "cloud/covariogram_lines.h"
#include <math.h>

enum { N_SHIFT = 16, N_SAMPLE = 8192, BLOCK = 1024, N_BLOCK = N_SAMPLE / BLOCK };

typedef struct {
    const clast_domain *domain;
    int32_t n;
    const double *radius;
    clx_lines lines;
    double *sum; ///< [N_SHIFT * N_BLOCK][n + 1], the last of the chords
} sampler;

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
    clx_line line;
    clx_line_at(&s->lines, u, s->radius[s->n - 1], &line);
    const double *t = line.t;
    const int n = line.n;
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
        const clx_sequence q = clx_sequence_at(block / N_BLOCK, is_map ? 7 : 4);
        for (int64_t k = 0; k < BLOCK; ++k) {
            double u[7] = {0.0};
            clx_sequence_point(&q, block % N_BLOCK * BLOCK + k, u);
            if (is_map) {
                add_point(s, u, s->sum + block * (s->n + 1));
            } else {
                add_line(s, u, s->sum + block * (s->n + 1));
            }
        }
    }
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
    const double factor = is_map ? volume : 0.25 * s->lines.area;
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
    CLX_TRY(clx_lines_init(domain, &s.lines));
    CLX_TRY(clx_alloc(&s.sum, (int64_t)N_SHIFT * N_BLOCK * (n + 1), sizeof *s.sum));
    clx_parallel_for((int64_t)N_SHIFT * N_BLOCK, 1, sample_block, &s);
    gather(&s, integral, error);
done:
    clx_lines_free(&s.lines);
    clx_free(s.sum);
    return status;
}
