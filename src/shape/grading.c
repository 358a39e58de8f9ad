// Distributions of grain size by number, with inverses in closed form so that a draw is one number.
//
// A sieve curve or a list becomes pieces: intervals of size in which the density over t, the place
// between the ends on a log scale, is a straight line from p to q. A uniform or log-normal law
// keeps its own formulas. Volumes weigh with D^3, whose integrals over a piece are elementary too.
//                                         [docs/theory/grading.md; Rettinger et al. 2022, eqs 8, 9]
#include <clast/grading.h>

#include "base/alloc.h"
#include "base/field.h"
#include "base/status.h"
#include "math/rng.h"
#include "math/special.h"
#include "shape/curve.h"
#include "shape/whole.h"
#include <clast/field.h>
#include <math.h>
#include <stdlib.h>

#define SIZE_MIN_M 1e-10 // as for sieves
#define SIZE_MAX_M 1e6
// Least part of a log-normal law that its limits must leave: below it the inverse loses digits.
#define LEAST_PART 1e-6

typedef enum { LAW_PIECES, LAW_UNIFORM, LAW_LOGNORMAL } law;

/// Grains between two sizes: density over t = ln(D/low)/width, p + (q - p) t, p + q = 2.
typedef struct {
    double low, high;          ///< m; equal for a single size
    double width;              ///< ln(high / low)
    double p, q;               ///< densities at the ends, mean 1
    double number;             ///< share of the grains
    double number_to, mass_to; ///< running shares up to and with this piece
    double cube;               ///< mean of (D / low)^3
    double density;            ///< of its grains [kg/m^3], or 0: not given
} piece;

struct clast_grading {
    law kind;
    int64_t n_piece;
    piece *item;      ///< [n_piece] ascending, each with grains
    double low, high; ///< m
    double mu, sigma; ///< log-normal: mean and deviation of ln D
    double cut_part;  ///< log-normal: probability between the limits
    double mean_cube; ///< m^3
    int64_t n_row;    ///< of the list that it was loaded from, or 0
    double total;
    char *column, *ignored, *size_column; ///< of that list, or NULL
};

void clast_grading_destroy(clast_grading *grading)
{
    if (grading != NULL) {
        CLX_FREE(grading->item, grading->column, grading->ignored, grading->size_column, grading);
    }
}

/// Integral of s e^(a s) over 0 .. t: closed form, or its series where that would cancel.
static double first_moment(double a, double t)
{
    const double y = a * t;
    if (y > 0.5) {
        return (t * exp(y) - expm1(y) / a) / a;
    }
    double sum = 0.0;
    double term = 1.0; // y^k / k!
    for (int k = 0; k < 16; ++k) {
        sum += term / (k + 2);
        term *= y / (k + 1);
    }
    return t * t * sum;
}

/// Integral of (p + (q - p) s) e^(a s) over 0 .. t: the volume of a piece's grains up to t.
static double piece_volume(const piece *x, double t)
{
    CLAST_ASSERT(t >= 0.0 && t <= 1.0);
    const double a = 3.0 * x->width;
    const double zeroth = a > 0.0 ? expm1(a * t) / a : t;
    return x->p * zeroth + (x->q - x->p) * first_moment(a, t);
}

static double piece_size(const piece *x, double t)
{
    return t >= 1.0 ? x->high : x->low * exp(x->width * t);
}

/// Share of the piece's grains up to t, and back: the root of p t + (q - p) t^2 / 2 = share without
/// cancellation.
static double piece_share(const piece *x, double t)
{
    CLAST_ASSERT(t >= 0.0 && t <= 1.0);
    return t * (x->p + 0.5 * (x->q - x->p) * t);
}

static double piece_place(const piece *x, double share)
{
    const double root = sqrt(fmax(0.0, x->p * x->p + 2.0 * (x->q - x->p) * share));
    return share > 0.0 ? fmin(1.0, 2.0 * share / (x->p + root)) : 0.0;
}

/// Place t below which this share of the piece's volume lies.
static double piece_volume_place(const piece *x, double share)
{
    const double wanted = share * x->cube;
    double low = 0.0;
    double high = 1.0;
    if (x->p == x->q) {
        const double a = 3.0 * x->width;
        return a > 0.0 ? fmin(1.0, log1p(a * wanted) / a) : share;
    }
    for (int i = 0; i < 64; ++i) {
        const double middle = 0.5 * (low + high);
        *(piece_volume(x, middle) < wanted ? &low : &high) = middle;
    }
    return 0.5 * (low + high);
}

static void set_piece(piece *x, double low, double high, double p, double q, double number)
{
    CLAST_ASSERT(low > 0.0 && low <= high && p >= 0.0 && q >= 0.0);
    const double mean = 0.5 * (p + q);
    *x = (piece){.low = low, .high = high, .width = log(high / low), .number = number};
    x->p = p / mean;
    x->q = q / mean;
    x->cube = piece_volume(x, 1.0);
}

/// Shares and running sums of pieces whose `number` is in any unit.
static clast_status sum_pieces(clast_grading *g)
{
    CLAST_ASSERT(g->n_piece > 0);
    clast_status status = CLAST_OK;
    const double top = g->item[g->n_piece - 1].high;
    double number = 0.0;
    double mass = 0.0;
    for (int64_t i = 0; i < g->n_piece; ++i) {
        number += g->item[i].number;
        g->item[i].number_to = number;
    }
    CLX_CHECK(number > 0.0 && isfinite(number), CLAST_E_CONFIG, "the numbers of grains sum to %g",
              number);
    for (int64_t i = 0; i < g->n_piece; ++i) {
        piece *x = &g->item[i];
        const double relative = x->low / top;
        x->number /= number;
        x->number_to /= number;
        mass += x->number * relative * relative * relative * x->cube;
        x->mass_to = mass;
    }
    for (int64_t i = 0; i < g->n_piece; ++i) {
        g->item[i].mass_to /= mass;
    }
    g->low = g->item[0].low;
    g->high = top;
    g->mean_cube = mass * top * top * top;
done:
    return status;
}

static clast_status begin_pieces(int64_t n, clast_grading **grading)
{
    clast_status status = CLAST_OK;
    clast_grading *made = NULL;
    CLX_TRY(clx_alloc(&made, 1, sizeof *made));
    CLX_TRY(clx_alloc(&made->item, n, sizeof *made->item));
    *grading = made;
    made = NULL;
done:
    clast_grading_destroy(made);
    return status;
}

/// Number of grains of a class in relative units: the mass by the cube that stands for the class.
static double class_number(const clast_curve *curve, int32_t i, clast_grading_spread spread,
                           clast_grading_count count)
{
    CLAST_ASSERT(i >= 0 && i < curve->n_class);
    const double top = curve->sieve[curve->n_class];
    const double low = curve->sieve[i] / top;
    const double high = curve->sieve[i + 1] / top;
    double cube = pow(low * high, 1.5);
    if (count == CLAST_COUNT_EXACT && spread == CLAST_SPREAD_STEP) {
        cube = low * low * low * expm1(3.0 * log(high / low)) / (3.0 * log(high / low));
    }
    return curve->mass[i] / cube;
}

typedef struct {
    const clast_curve *curve;
    clast_grading_spread spread;
    clast_grading_count count;
    int32_t first, last; ///< classes with mass
} spreading;

static void step_pieces(const spreading *s, clast_grading *g)
{
    const double *sieve = s->curve->sieve;
    for (int32_t i = s->first; i <= s->last; ++i) {
        const double n = class_number(s->curve, i, s->spread, s->count);
        const double d = clast_curve_class_size(s->curve, i);
        const bool means = s->spread == CLAST_SPREAD_MEANS;
        if (n > 0.0) {
            set_piece(&g->item[g->n_piece++], means ? d : sieve[i], means ? d : sieve[i + 1], 1.0,
                      1.0, n);
        }
    }
}

/// Knots: the outer sieves with density 0, the class means with the class's number by its width.
static void linear_pieces(const spreading *s, clast_grading *g)
{
    const double *sieve = s->curve->sieve;
    double at = sieve[s->first];
    double density = 0.0;
    for (int32_t i = s->first; i <= s->last + 1; ++i) {
        const bool end = i > s->last;
        const double next = end ? sieve[i] : clast_curve_class_size(s->curve, i);
        const double next_density =
            end ? 0.0
                : class_number(s->curve, i, s->spread, s->count) / log(sieve[i + 1] / sieve[i]);
        if (density + next_density > 0.0) {
            set_piece(&g->item[g->n_piece++], at, next, density, next_density,
                      0.5 * (density + next_density) * log(next / at));
        }
        at = next;
        density = next_density;
    }
}

clast_status clast_grading_of_curve(const clast_curve *curve, clast_grading_spread spread,
                                    clast_grading_count count, clast_grading **grading)
{
    CLX_ARGUMENTS(curve, grading);
    CLX_ARRAY(curve->sieve, curve->n_class);
    CLX_ARRAY(curve->mass, curve->n_class);
    clast_status status = CLAST_OK;
    clast_grading *made = NULL;
    spreading s = {
        .curve = curve, .spread = spread, .count = count, .first = 0, .last = curve->n_class - 1};
    CLX_CHECK((unsigned)spread <= CLAST_SPREAD_MEANS && (unsigned)count <= CLAST_COUNT_EXACT,
              CLAST_E_ARGUMENT, "grading: there is no spread %d, or no count %d", (int)spread,
              (int)count);
    CLX_CHECK(spread != CLAST_SPREAD_LINEAR || count == CLAST_COUNT_MEAN, CLAST_E_CONFIG,
              "exact counts are not defined for a linear spread, whose grains cross the sieves; "
              "take the step spread or mean counts");
    CLX_TRY(clx_curve_check(curve));
    while (s.first < s.last && curve->mass[s.first] <= 0.0) {
        ++s.first;
    }
    while (s.last > s.first && curve->mass[s.last] <= 0.0) {
        --s.last;
    }
    CLX_TRY(begin_pieces(curve->n_class + 1, &made));
    (spread == CLAST_SPREAD_LINEAR ? linear_pieces : step_pieces)(&s, made);
    CLX_TRY(sum_pieces(made));
    *grading = made;
    made = NULL;
done:
    clast_grading_destroy(made);
    return status;
}

static clast_status check_size(double size, const char *what)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(size >= SIZE_MIN_M && size <= SIZE_MAX_M, CLAST_E_CONFIG,
              "%s: a size of %s is not between %s and %s", what, clx_unit_text(size, "m"),
              clx_unit_text(SIZE_MIN_M, "m"), clx_unit_text(SIZE_MAX_M, "m"));
done:
    return status;
}

/// The rows that hold grains, as pieces.
static clast_status fill_rows(const clast_sizes *sizes, bool by_mass, clast_grading *g)
{
    clast_status status = CLAST_OK;
    for (int64_t i = 0; i < sizes->n; ++i) {
        const double low = sizes->low[i];
        const double high = sizes->high[i];
        CLX_TRY(check_size(low, "list"));
        CLX_TRY(check_size(high, "list"));
        CLX_CHECK(low <= high, CLAST_E_CONFIG, "list: a bin from %s to %s", clx_unit_text(low, "m"),
                  clx_unit_text(high, "m"));
        CLX_CHECK(isfinite(sizes->count[i]) && sizes->count[i] >= 0.0, CLAST_E_CONFIG,
                  "list: a count of %g is not a number from 0 up", sizes->count[i]);
        if (sizes->count[i] > 0.0) {
            piece *x = &g->item[g->n_piece++];
            set_piece(x, low, high, 1.0, 1.0, sizes->count[i]);
            x->number /= by_mass ? low * low * low * x->cube : 1.0;
            if (sizes->density != NULL) {
                x->density = sizes->density[i];
                x->number /= by_mass ? x->density : 1.0;
            }
        }
    }
    CLX_CHECK(g->n_piece > 0, CLAST_E_CONFIG, "list: no row holds a grain");
done:
    return status;
}

static int by_size(const void *a, const void *b)
{
    const piece *x = a;
    const piece *y = b;
    return x->low != y->low     ? (x->low > y->low) - (x->low < y->low)
           : x->high != y->high ? (x->high > y->high) - (x->high < y->high)
                                : (x->density > y->density) - (x->density < y->density);
}

clast_status clast_grading_of_sizes(const clast_sizes *sizes, bool by_mass, clast_grading **grading)
{
    CLX_ARGUMENTS(sizes, grading);
    CLX_WHOLE(sizes, sizes);
    clast_status status = CLAST_OK;
    clast_grading *made = NULL;
    CLX_CHECK(sizes->n > 0, CLAST_E_CONFIG, "list: no sizes in it");
    CLX_TRY(begin_pieces(sizes->n, &made));
    CLX_TRY(fill_rows(sizes, by_mass, made));
    qsort(made->item, (size_t)made->n_piece, sizeof *made->item, by_size);
    for (int64_t i = 1; i < made->n_piece; ++i) {
        const piece *x = &made->item[i - 1];
        const piece *y = &made->item[i];
        CLX_CHECK(y->low >= x->high, CLAST_E_CONFIG, "list: the bins %s to %s and %s to %s overlap",
                  clx_unit_text(x->low, "m"), clx_unit_text(x->high, "m"),
                  clx_unit_text(y->low, "m"), clx_unit_text(y->high, "m"));
    }
    CLX_TRY(sum_pieces(made));
    *grading = made;
    made = NULL;
done:
    clast_grading_destroy(made);
    return status;
}

clast_status clast_grading_uniform(double low, double high, clast_grading **grading)
{
    CLX_ARGUMENTS(grading);
    clast_status status = CLAST_OK;
    clast_grading *made = NULL;
    CLX_TRY(check_size(low, "uniform sizes"));
    CLX_TRY(check_size(high, "uniform sizes"));
    CLX_CHECK(low <= high, CLAST_E_CONFIG, "uniform sizes: from %s to %s; the first is larger",
              clx_unit_text(low, "m"), clx_unit_text(high, "m"));
    CLX_TRY(clx_alloc(&made, 1, sizeof *made));
    *made = (clast_grading){.kind = LAW_UNIFORM, .low = low, .high = high};
    made->mean_cube = 0.25 * (low + high) * (low * low + high * high);
    *grading = made;
done:
    return status;
}

/// Standard normal place of a size under a log-normal law.
static double normal_place(const clast_grading *g, double size)
{
    CLAST_ASSERT(size >= 0.0 && g->sigma > 0.0);
    return (log(size) - g->mu) / g->sigma;
}

/// P(low < Z <= high) without cancellation in the upper tail.
static double normal_between(double low, double high)
{
    return low > 0.0 ? clx_normal_sf(low) - clx_normal_sf(high)
                     : clx_normal_cdf(high) - clx_normal_cdf(low);
}

static clast_status check_lognormal(double mean, double deviation, double low, double high)
{
    clast_status status = CLAST_OK;
    CLX_TRY(check_size(mean, "log-normal sizes: mean"));
    CLX_CHECK(deviation > 0.0 && deviation <= 1e3 * mean, CLAST_E_CONFIG,
              "log-normal sizes: a deviation of %s is not above 0 and below 1000 means",
              clx_unit_text(deviation, "m"));
    CLX_CHECK(low >= 0.0 && high > low, CLAST_E_CONFIG,
              "log-normal sizes: the limits %s and %s are not 0 <= low < high",
              clx_unit_text(low, "m"), clx_unit_text(high, "m"));
done:
    return status;
}

clast_status clast_grading_lognormal(double mean, double deviation, double low, double high,
                                     clast_grading **grading)
{
    CLX_ARGUMENTS(grading);
    clast_status status = CLAST_OK;
    clast_grading *made = NULL;
    CLX_TRY(check_lognormal(mean, deviation, low, high));
    CLX_TRY(clx_alloc(&made, 1, sizeof *made));
    const double variance = log1p(deviation / mean * (deviation / mean));
    CLX_CHECK(variance > 0.0, CLAST_E_CONFIG,
              "log-normal sizes: a deviation of %s is none beside a mean of %s; give one size",
              clx_unit_text(deviation, "m"), clx_unit_text(mean, "m"));
    *made = (clast_grading){.kind = LAW_LOGNORMAL, .low = low, .high = high};
    made->sigma = sqrt(variance);
    made->mu = log(mean) - 0.5 * variance;
    const double a = normal_place(made, low);
    const double b = normal_place(made, high);
    made->cut_part = normal_between(a, b);
    CLX_CHECK(made->cut_part >= LEAST_PART, CLAST_E_CONFIG,
              "log-normal sizes: only %.2g of the grains lie between %s and %s", made->cut_part,
              clx_unit_text(low, "m"), clx_unit_text(high, "m"));
    made->mean_cube = exp(3.0 * made->mu + 4.5 * variance) *
                      normal_between(a - 3.0 * made->sigma, b - 3.0 * made->sigma) / made->cut_part;
    *grading = made;
    made = NULL;
done:
    clast_grading_destroy(made);
    return status;
}

double clast_grading_draw(const clast_grading *grading, uint64_t seed, uint64_t index)
{
    if (grading == NULL) {
        return (double)NAN;
    }
    clx_rng rng = clx_rng_at(seed, CLX_STREAM_GRADING, index);
    return clast_grading_size(grading, clx_rng_uniform(&rng));
}

void clast_grading_range(const clast_grading *grading, double *low, double *high)
{
    if (grading == NULL || low == NULL || high == NULL) {
        return;
    }
    *low = grading->low;
    *high = grading->high;
}

clast_status clx_grading_note_list(const clast_grading_list *list, clast_grading *grading)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc_text(&grading->column, list->column));
    CLX_TRY(clx_alloc_text(&grading->ignored, list->ignored));
    CLX_TRY(clx_alloc_text(&grading->size_column, list->size));
    grading->n_row = list->n_row;
    grading->total = list->total;
done:
    return status;
}

clast_grading_list clast_grading_list_of(const clast_grading *grading)
{
    const bool is_list = grading != NULL && grading->n_row > 0;
    return is_list ? (clast_grading_list){grading->n_row, grading->total, grading->column,
                                          grading->ignored, grading->size_column}
                   : (clast_grading_list){.column = "", .ignored = "", .size = ""};
}

double clast_grading_mean_cube(const clast_grading *grading)
{
    if (grading == NULL) {
        return (double)NAN;
    }
    return grading->mean_cube;
}

/// First piece whose running share, by mass or by number, reaches `share`.
static int64_t find_piece(const clast_grading *g, bool by_mass, double share)
{
    CLAST_ASSERT(g->n_piece > 0);
    int64_t low = 0;
    int64_t high = g->n_piece - 1;
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        const piece *x = &g->item[middle];
        if ((by_mass ? x->mass_to : x->number_to) >= share) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

static double pieces_size(const clast_grading *g, bool by_mass, double share)
{
    const int64_t i = find_piece(g, by_mass, share);
    const piece *x = &g->item[i];
    const double to = by_mass ? x->mass_to : x->number_to;
    const double from = i == 0 ? 0.0 : (by_mass ? x[-1].mass_to : x[-1].number_to);
    const double part = to > from ? fmin(1.0, fmax(0.0, (share - from) / (to - from))) : 1.0;
    return piece_size(x, by_mass ? piece_volume_place(x, part) : piece_place(x, part));
}

double clx_grading_draw_density(const clast_grading *grading, uint64_t seed, uint64_t index)
{
    if (grading == NULL) {
        return (double)NAN;
    }
    clx_rng rng = clx_rng_at(seed, CLX_STREAM_GRADING, index);
    return grading->kind == LAW_PIECES
               ? grading->item[find_piece(grading, false, clx_rng_uniform(&rng))].density
               : 0.0;
}

void clx_grading_densities(const clast_grading *grading, double *low, double *high)
{
    if (grading == NULL || low == NULL || high == NULL) {
        return;
    }
    *low = *high = grading->n_piece > 0 ? grading->item[0].density : 0.0;
    for (int64_t i = 1; i < grading->n_piece; ++i) {
        *low = fmin(*low, grading->item[i].density);
        *high = fmax(*high, grading->item[i].density);
    }
}

/// Last piece that begins at or below this size, -1 for none.
static int64_t find_below(const clast_grading *g, double size)
{
    int64_t low = -1;
    int64_t high = g->n_piece - 1;
    while (low < high) {
        const int64_t middle = low + (high - low + 1) / 2;
        if (g->item[middle].low <= size) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    return low;
}

static double pieces_share(const clast_grading *g, bool by_mass, double size)
{
    const int64_t i = find_below(g, size);
    if (i < 0) {
        return 0.0;
    }
    const piece *x = &g->item[i];
    const double to = by_mass ? x->mass_to : x->number_to;
    const double from = i == 0 ? 0.0 : (by_mass ? x[-1].mass_to : x[-1].number_to);
    if (size >= x->high) {
        return to;
    }
    const double t = log(size / x->low) / x->width;
    return from + (to - from) * (by_mass ? piece_volume(x, t) / x->cube : piece_share(x, t));
}

static double uniform_share(const clast_grading *g, int power, double size)
{
    return g->high > g->low ? (pow(size, power) - pow(g->low, power)) /
                                  (pow(g->high, power) - pow(g->low, power))
                            : 1.0;
}

static double law_share(const clast_grading *g, bool by_mass, double size)
{
    if (size < g->low || !(size > 0.0)) {
        return 0.0;
    }
    if (size >= g->high) {
        return 1.0;
    }
    if (g->kind == LAW_UNIFORM) {
        return uniform_share(g, by_mass ? 4 : 1, size);
    }
    const double shift = by_mass ? 3.0 * g->sigma : 0.0;
    const double a = normal_place(g, g->low) - shift;
    return normal_between(a, normal_place(g, size) - shift) /
           normal_between(a, normal_place(g, g->high) - shift);
}

static double lognormal_size(const clast_grading *g, bool by_mass, double share)
{
    const double shift = by_mass ? 3.0 * g->sigma : 0.0;
    const double a = normal_place(g, g->low) - shift;
    const double b = normal_place(g, g->high) - shift;
    double z = 0.0;
    if (a > 0.0) { // both ends in the upper tail, where 1 - p keeps the digits
        const double sf = clx_normal_sf(a) - share * (clx_normal_sf(a) - clx_normal_sf(b));
        z = -clx_normal_quantile(sf);
    } else {
        const double p = clx_normal_cdf(a) + share * normal_between(a, b);
        z = clx_normal_quantile(fmin(p, 1.0));
    }
    return fmin(g->high, fmax(g->low, exp(g->mu + g->sigma * (z + shift))));
}

static double law_size(const clast_grading *g, bool by_mass, double share)
{
    if (g->kind == LAW_LOGNORMAL) {
        return lognormal_size(g, by_mass, share);
    }
    if (!by_mass) {
        return g->low + share * (g->high - g->low);
    }
    const double low = g->low / g->high;
    const double fourth = low * low * low * low;
    return g->high * sqrt(sqrt(fourth + share * (1.0 - fourth)));
}

double clast_grading_share(const clast_grading *grading, double size)
{
    if (grading == NULL || isnan(size)) {
        return (double)NAN;
    }
    return grading->kind == LAW_PIECES ? pieces_share(grading, false, size)
                                       : law_share(grading, false, size);
}

double clast_grading_mass_share(const clast_grading *grading, double size)
{
    if (grading == NULL || isnan(size)) {
        return (double)NAN;
    }
    return grading->kind == LAW_PIECES ? pieces_share(grading, true, size)
                                       : law_share(grading, true, size);
}

double clast_grading_size(const clast_grading *grading, double share)
{
    if (grading == NULL || !(share >= 0.0 && share <= 1.0)) {
        return (double)NAN;
    }
    return grading->kind == LAW_PIECES ? pieces_size(grading, false, share)
                                       : law_size(grading, false, share);
}

double clast_grading_mass_size(const clast_grading *grading, double share)
{
    if (grading == NULL || !(share >= 0.0 && share <= 1.0)) {
        return (double)NAN;
    }
    return grading->kind == LAW_PIECES ? pieces_size(grading, true, share)
                                       : law_size(grading, true, share);
}

/// Laws and lists have no classes to spread sizes in.
const clast_idle *clast_grading_idle(const clast_curve *curve, clast_grading_spread spread,
                                     clast_idle *rules)
{
    if (rules == NULL) {
        return NULL;
    }
    const clast_idle made[CLAST_N_IDLE] = {
        {spread == CLAST_SPREAD_MEANS, "count", "with --spread means"},
        {curve != NULL && curve->n_class == 0, "spread|count",
         "with sizes that are no sieve curve"}};
    return clx_idle_copy(made, rules);
}
