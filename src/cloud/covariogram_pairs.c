// Share of uniform pairs within a distance by pairs of points: where chords say little, as far
// apart as a slender body is long.
//
// Two sets of quasi-random points of the body, the second with its numbers in reverse order, so
// that differences are as many as pairs; each point of one with each of the other. Half pipes have
// uniform points by their map. Of a closed surface a point uniform on the chord of a
// uniform line has the density 1 / chord: its weight is the chord. Errors are those of a ratio, by
// the spread over independent shifts.
#include "cloud/covariogram.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "cloud/covariogram_lines.h"
#include <math.h>
#include <string.h>

enum {
    N_SHIFT = 16,
    N_POINT = 2048,     ///< of a set
    FIRST_NUMBER = 16,  ///< of sequences: those before are the chords'
    LEAST_PAIRS = 1000, ///< fewer pairs within a distance tell no spread
    N_MAP = 3,          ///< numbers of a point by a map, and by a chord
    N_CHORD = 5,
    BUCKET_SHIFT = 47 ///< a double's exponent and 5 bits of its digits: buckets of 1/32 octave
};

typedef struct {
    const clast_domain *domain;
    int32_t n;
    double *radius2; ///< [n] squared distances
    int64_t first, n_bucket;
    int32_t *below; ///< [n_bucket + 1] of them, distances in lower buckets
    clx_lines lines;
    double *within; ///< [N_SHIFT][n + 1] weights of pairs; the last of all pairs
} sampler;

typedef struct {
    double x[N_POINT][3], weight[N_POINT];
} point_set;

/// A point of the body and its weight.
static void make_point(const sampler *s, const double *u, double x[3], double *weight)
{
    if (s->domain->kind != CLAST_DOMAIN_MESH) {
        x[0] = x[1] = x[2] = 0.0;
        clast_domain_unmap(s->domain, u, x);
        *weight = 1.0;
        return;
    }
    clx_line line;
    clx_line_at(&s->lines, u, 0.0, &line);
    *weight = line.n > 0 ? line.t[0] : 0.0;
    for (int j = 0; j < 3; ++j) {
        x[j] = line.x[j] + u[N_CHORD - 1] * *weight * line.direction[j];
    }
}

static void make_points(const sampler *s, int64_t number, bool is_reverse, point_set *set)
{
    const int n = s->domain->kind == CLAST_DOMAIN_MESH ? N_CHORD : N_MAP;
    const clx_sequence q = clx_sequence_at(number, n);
    for (int k = 0; k < N_POINT; ++k) {
        double v[CLX_MOST_SEQUENCE];
        double u[CLX_MOST_SEQUENCE];
        clx_sequence_point(&q, k, v);
        for (int j = 0; j < n; ++j) {
            u[j] = v[is_reverse ? n - 1 - j : j];
        }
        make_point(s, u, set->x[k], &set->weight[k]);
    }
}

/// Bucket of a number that is not negative: rises with it.
static int64_t bucket_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return (int64_t)(bits >> BUCKET_SHIFT);
}

static clast_status make_buckets(sampler *s)
{
    clast_status status = CLAST_OK;
    int32_t i = 0;
    s->first = bucket_of(s->radius2[0]);
    s->n_bucket = bucket_of(s->radius2[s->n - 1]) - s->first + 1;
    CLX_TRY(clx_alloc(&s->below, s->n_bucket + 1, sizeof *s->below));
    for (int64_t b = 0; b <= s->n_bucket; ++b) {
        while (i < s->n && bucket_of(s->radius2[i]) < s->first + b) {
            ++i;
        }
        s->below[b] = i;
    }
done:
    return status;
}

/// First of the distances that is above this one, n for none.
static int32_t find_shell(const sampler *s, double distance2)
{
    const int64_t b = bucket_of(distance2) - s->first;
    if (b < 0 || b >= s->n_bucket) {
        return b < 0 ? 0 : s->n;
    }
    int32_t low = s->below[b];
    int32_t high = s->below[b + 1];
    while (low < high) {
        const int32_t middle = low + (high - low) / 2;
        if (s->radius2[middle] > distance2) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

static void add_pairs(const sampler *s, const point_set *a, const point_set *b, double *within)
{
    for (int i = 0; i < N_POINT; ++i) {
        const double *x = a->x[i];
        for (int k = 0; k < N_POINT; ++k) {
            const double *y = b->x[k];
            const double d[3] = {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
            within[find_shell(s, d[0] * d[0] + d[1] * d[1] + d[2] * d[2])] +=
                a->weight[i] * b->weight[k];
        }
    }
    for (int32_t i = 0; i < s->n; ++i) {
        within[i + 1] += within[i];
    }
}

static clast_status sample_shift(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_status status = CLAST_OK;
    const sampler *s = context;
    point_set *set = NULL;
    (void)worker;
    CLX_TRY(clx_alloc(&set, 2, sizeof *set));
    for (int64_t shift = begin; shift < end; ++shift) {
        make_points(s, FIRST_NUMBER + 2 * shift, false, &set[0]);
        make_points(s, FIRST_NUMBER + 2 * shift + 1, true, &set[1]);
        add_pairs(s, &set[0], &set[1], s->within + shift * (s->n + 1));
    }
done:
    clx_free(set);
    return status;
}

/// Ratio of the sums over shifts and its standard error; fewer pairs than tell a spread: INFINITY.
static void gather(const sampler *s, double *share, double *error)
{
    const double n_pair = (double)N_SHIFT * N_POINT * N_POINT;
    double all = 0.0;
    for (int k = 0; k < N_SHIFT; ++k) {
        all += s->within[(int64_t)k * (s->n + 1) + s->n];
    }
    for (int32_t i = 0; i < s->n; ++i) {
        double sum = 0.0;
        double squares = 0.0;
        for (int k = 0; k < N_SHIFT; ++k) {
            sum += s->within[(int64_t)k * (s->n + 1) + i];
        }
        share[i] = sum / all;
        for (int k = 0; k < N_SHIFT; ++k) {
            const double *row = s->within + (int64_t)k * (s->n + 1);
            const double off = row[i] - share[i] * row[s->n];
            squares += off * off;
        }
        error[i] = share[i] * n_pair < LEAST_PAIRS
                       ? (double)INFINITY
                       : sqrt(squares * N_SHIFT / (N_SHIFT - 1.0)) / all;
    }
}

clast_status clx_covariogram_pairs(const clast_domain *domain, int32_t n, const double *radius,
                                   double *share, double *error)
{
    clast_status status = CLAST_OK;
    sampler s = {.domain = domain, .n = n};
    CLX_TRY(clx_lines_init(domain, &s.lines));
    CLX_TRY(clx_alloc(&s.radius2, n, sizeof *s.radius2));
    CLX_TRY(clx_alloc(&s.within, (int64_t)N_SHIFT * (n + 1), sizeof *s.within));
    for (int32_t i = 0; i < n; ++i) {
        s.radius2[i] = radius[i] * radius[i];
    }
    CLX_TRY(make_buckets(&s));
    CLX_TRY(clx_parallel_try(N_SHIFT, 1, sample_shift, &s));
    gather(&s, share, error);
done:
    CLX_FREE(s.within, s.below, s.radius2);
    clx_lines_free(&s.lines);
    return status;
}
