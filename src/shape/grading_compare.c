// Grains against the sieve curve that they were to follow.
#include <clast/grading.h>

#include "base/alloc.h"
#include "math/sort.h"
#include "shape/curve.h"
#include <clast/table.h>
#include <math.h>
#include <stdlib.h>

typedef struct {
    double size, volume;
} grain;

CLX_RISING_BY_TWO(by_size, grain, size, volume)

static double volume_of(const clast_grading_sample *sample, int64_t i)
{
    CLAST_ASSERT(i >= 0 && i < sample->n);
    const double d = sample->size[i];
    return sample->volume != NULL ? sample->volume[i] : d * d * d;
}

static clast_status check_grains(const clast_grading_sample *sample)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(sample->n > 0, CLAST_E_CONFIG, "no grains to compare with the sieve curve");
    for (int64_t i = 0; i < sample->n; ++i) {
        const double d = sample->size[i];
        const double v = volume_of(sample, i);
        CLX_CHECK(d > 0.0 && isfinite(d) && v > 0.0 && isfinite(v), CLAST_E_CONFIG,
                  "grain %lld: size %s, volume %s; both must be finite and above 0", (long long)i,
                  clx_unit_text(d, "m"), clx_unit_text(v, "m^3"));
    }
done:
    return status;
}

static clast_status sorted_grains(const clast_grading_sample *sample, grain **out, double *total)
{
    grain *made = NULL;
    const clast_status status = clx_alloc(&made, sample->n, sizeof *made);
    *total = 0.0;
    if (status == CLAST_OK) {
        for (int64_t i = 0; i < sample->n; ++i) {
            made[i] = (grain){.size = sample->size[i], .volume = volume_of(sample, i)};
            *total += made[i].volume;
        }
        qsort(made, (size_t)sample->n, sizeof *made, by_size);
        *out = made;
    }
    return status;
}

/// Greatest difference of a law's running share from those of the grains, just before and at a
/// size; laws and grains jump there.
static double apart(double (*share)(const clast_grading *, double), const clast_grading *grading,
                    double size, double before, double up_to)
{
    return grading == NULL ? (double)NAN
                           : fmax(fabs(share(grading, nextafter(size, 0.0)) - before),
                                  fabs(share(grading, size) - up_to));
}

/// Greatest differences of the running shares, just before and at each size, and sizes at shares.
static void follow(const clast_curve *curve, const clast_grading *grading, int64_t n,
                   const grain *sorted, double total, clast_grading_match *match)
{
    double mass = 0.0;
    double *const quantile[3] = {&match->achieved_d10, &match->achieved_d50, &match->achieved_d90};
    static const double share[3] = {0.1, 0.5, 0.9};
    for (int64_t i = 0; i < n;) {
        const double size = sorted[i].size;
        const double before = mass / total;
        const double number = (double)i / (double)n;
        int64_t next = i;
        for (; next < n && sorted[next].size == size; ++next) {
            mass += sorted[next].volume;
        }
        const double up_to = mass / total;
        const double passing = clast_curve_passing(curve, size); // continuous
        match->distance_curve =
            fmax(match->distance_curve, fmax(fabs(passing - before), fabs(passing - up_to)));
        match->distance_mass = fmax(match->distance_mass,
                                    apart(clast_grading_mass_share, grading, size, before, up_to));
        match->distance_number =
            fmax(match->distance_number,
                 apart(clast_grading_share, grading, size, number, (double)next / (double)n));
        for (int k = 0; k < 3; ++k) {
            if (*quantile[k] == 0.0 && (mass >= share[k] * total || next == n)) {
                *quantile[k] = size;
            }
        }
        i = next;
    }
}

typedef struct {
    double *low, *high, *wanted_mass, *achieved_mass, *wanted_number, *achieved_number, *count;
} columns;

static clast_status add_columns(clast_table *table, columns *c)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clast_table_add_number(table, "low_m", "m", &c->low));
    CLX_TRY(clast_table_add_number(table, "high_m", "m", &c->high));
    CLX_TRY(clast_table_add_number(table, "wanted_mass", "-", &c->wanted_mass));
    CLX_TRY(clast_table_add_number(table, "achieved_mass", "-", &c->achieved_mass));
    CLX_TRY(clast_table_add_number(table, "wanted_number", "-", &c->wanted_number));
    CLX_TRY(clast_table_add_number(table, "achieved_number", "-", &c->achieved_number));
    CLX_TRY(clast_table_add_number(table, "count", "-", &c->count));
done:
    return status;
}

/// Row 0 lies below all sieves, the last above; the largest sieve belongs to its class.
static int32_t row_of(const clast_curve *curve, double size)
{
    int32_t row = 0;
    while (row <= curve->n_class && size >= curve->sieve[row]) {
        ++row;
    }
    return size == curve->sieve[curve->n_class] ? row - 1 : row;
}

static void fill_rows(const clast_curve *curve, const clast_grading *grading, int64_t n,
                      const grain *sorted, double total, const columns *c)
{
    const int32_t n_row = curve->n_class + 2;
    for (int32_t row = 0; row < n_row; ++row) {
        const bool inside = row > 0 && row + 1 < n_row;
        c->low[row] = row > 0 ? curve->sieve[row - 1] : 0.0;
        c->high[row] = row + 1 < n_row ? curve->sieve[row] : HUGE_VAL;
        c->wanted_mass[row] = inside ? curve->mass[row - 1] : 0.0;
        c->wanted_number[row] = grading == NULL ? (double)NAN
                                                : clast_grading_share(grading, c->high[row]) -
                                                      clast_grading_share(grading, c->low[row]);
    }
    for (int64_t i = 0; i < n; ++i) {
        const int32_t row = row_of(curve, sorted[i].size);
        c->achieved_mass[row] += sorted[i].volume / total;
        c->count[row] += 1.0;
    }
    for (int32_t row = 0; row < n_row; ++row) {
        c->achieved_number[row] = c->count[row] / (double)n;
    }
}

static void wanted_sizes(const clast_curve *curve, clast_grading_match *match)
{
    match->wanted_d10 = clast_curve_size(curve, 0.1);
    match->wanted_d50 = clast_curve_size(curve, 0.5);
    match->wanted_d90 = clast_curve_size(curve, 0.9);
}

static clast_status class_table(const clast_curve *curve, const clast_grading *grading, int64_t n,
                                const grain *sorted, double total, clast_table *table)
{
    clast_status status = CLAST_OK;
    columns c = {0};
    CLX_TRY(clast_table_init(table, "grading", curve->n_class + 2));
    CLX_TRY(add_columns(table, &c));
    fill_rows(curve, grading, n, sorted, total, &c);
done:
    return status;
}

clast_status clast_grading_compare(const clast_grading *grading, const clast_curve *curve,
                                   const clast_grading_sample *sample, clast_table *table,
                                   clast_grading_match *match)
{
    CLX_ARGUMENTS(curve, sample, table, match);
    CLX_ARRAY(curve->sieve, curve->n_class);
    CLX_ARRAY(curve->mass, curve->n_class);
    CLX_ARRAY(sample->size, sample->n);
    const int64_t n = sample->n;
    clast_status status = CLAST_OK;
    grain *sorted = NULL;
    clast_table made = {0};
    double total = 0.0;
    CLX_TRY(clx_curve_check(curve));
    CLX_TRY(check_grains(sample));
    CLX_TRY(sorted_grains(sample, &sorted, &total));
    CLX_TRY(class_table(curve, grading, n, sorted, total, &made));
    *match = (clast_grading_match){.n = n, .distance_mass = (double)NAN};
    match->distance_number = match->distance_mass; // fmax() leaves them so without a grading
    follow(curve, grading, n, sorted, total, match);
    wanted_sizes(curve, match);
    *table = made;
done:
    if (status != CLAST_OK) {
        clast_table_free(&made);
    }
    clx_free(sorted);
    return status;
}
