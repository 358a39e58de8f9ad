// Laws of sizes at the start of a box. [docs/theory/agglomeration.md section 6]
#include "cloud/spectrum.h"

#include "base/status.h"
#include "math/quadrature.h"
#include "math/special.h"
#include <math.h>

static const double SMALLEST = 1e-3; ///< of the mean: exponential; 5e-7 of the mass lies below
static const double TAIL_DEVIATIONS = 6.5; ///< of a lognormal start on the grid

static double log_sd(const clx_start *s)
{
    return log(s->config->initial_sd);
}

static double log_median(const clx_start *s)
{
    return log(s->config->initial_mean) - 0.5 * log_sd(s) * log_sd(s);
}

static clast_status begin_table(clx_start *s)
{
    clast_status status = CLAST_OK;
    const clast_spectrum_start *t = s->table;
    double sum = 0.0;
    CLX_CHECK(t != NULL && t->n > 0 && t->size != NULL && t->number != NULL, CLAST_E_CONFIG,
              "initial: a start by table needs one: --initial-file");
    s->low = INFINITY;
    for (int64_t i = 0; i < t->n; ++i) {
        CLX_CHECK(t->size[i] > 0.0 && isfinite(t->size[i]) && t->number[i] >= 0.0 &&
                      isfinite(t->number[i]),
                  CLAST_E_FORMAT, "row %lld of the sizes at the start: size %g, number %g",
                  (long long)i + 1, t->size[i], t->number[i]);
        s->low = fmin(s->low, t->size[i]);
        s->high = fmax(s->high, t->size[i]);
        sum += t->number[i];
    }
    CLX_CHECK(sum > 0.0, CLAST_E_FORMAT, "the sizes at the start hold no particles");
    s->unit = s->low;
    for (int64_t i = 0; i < t->n; ++i) {
        const double whole = round(t->size[i] / s->low);
        s->unit = fabs(t->size[i] - whole * s->low) > 1e-9 * t->size[i] ? 0.0 : s->unit;
    }
    s->concentration = s->config->concentration > 0.0 ? s->config->concentration : sum;
done:
    return status;
}

/// Lets the smallest size be one that the start does not hold: that of the grid or of a source.
static void refine(clx_start *s)
{
    const clast_spectrum_config *c = s->config;
    const double size = c->size_min > 0.0 ? c->size_min : c->source > 0.0 ? c->source_size : s->low;
    const double whole = round(s->unit / size);
    if (size < s->low) {
        s->low = size;
        s->unit = fabs(s->unit - whole * size) > 1e-9 * s->unit ? 0.0 : whole > 0.0 ? size : 0.0;
    }
}

clast_status clx_start_begin(const clast_spectrum_config *config, const clast_spectrum_start *table,
                             clx_start *start)
{
    clast_status status = CLAST_OK;
    clx_start s = {.config = config, .table = table, .concentration = config->concentration};
    const double mean = config->initial_mean;
    if (config->initial == CLAST_INITIAL_TABLE) {
        CLX_TRY(begin_table(&s));
    } else if (config->initial == CLAST_INITIAL_MONO) {
        s.low = s.high = s.unit = mean;
    } else if (config->initial == CLAST_INITIAL_EXPONENTIAL) {
        s.low = SMALLEST * mean;
        s.high = 40.0 * mean;
    } else {
        s.low = exp(log_median(&s) - TAIL_DEVIATIONS * log_sd(&s));
        s.high = exp(log_median(&s) + TAIL_DEVIATIONS * log_sd(&s) + log_sd(&s) * log_sd(&s));
    }
    CLX_CHECK(s.concentration > 0.0, CLAST_E_CONFIG,
              "concentration: a box needs the number of particles a volume, --concentration");
    CLX_CHECK(config->size_min == 0.0 || config->size_min <= s.low, CLAST_E_CONFIG,
              "size_min: %g monomers is above the smallest size at the start, %g", config->size_min,
              s.low);
    CLX_CHECK(config->size_max == 0.0 || config->size_max >= s.high, CLAST_E_CONFIG,
              "size_max: %g monomers is below the largest size at the start, %g", config->size_max,
              s.high);
    refine(&s);
    // a monomer's aggregates break; what is counted in monomers and is of one size was meant to
    CLX_CHECK(
        config->breakage_rate == 0.0 || config->size_min > 0.0 || s.low < s.high || s.high == 1.0,
        CLAST_E_CONFIG,
        "breakage_rate: every particle at the start has %g monomers, which is then the smallest "
        "size and does not break; name a smaller one with --size-min (of single monomers: 1)",
        s.high);
    *start = s;
done:
    return status;
}

static double table_quantile(const clast_spectrum_start *t, double u)
{
    double sum = 0.0;
    int64_t last = 0;
    for (int64_t i = 0; i < t->n; ++i) {
        sum += t->number[i];
    }
    double at = u * sum;
    for (int64_t i = 0; i < t->n; ++i) {
        last = t->number[i] > 0.0 ? i : last;
        at -= t->number[i];
        if (at < 0.0) {
            break;
        }
    }
    return t->size[last];
}

double clx_start_quantile(const clx_start *s, double u)
{
    CLAST_ASSERT(u > 0.0 && u <= 1.0);
    if (s->config->initial == CLAST_INITIAL_TABLE) {
        return table_quantile(s->table, u);
    }
    if (s->config->initial == CLAST_INITIAL_MONO) {
        return s->config->initial_mean;
    }
    if (s->config->initial == CLAST_INITIAL_EXPONENTIAL) {
        return -s->config->initial_mean * log1p(-u);
    }
    return exp(log_median(s) + log_sd(s) * clx_normal_quantile(u));
}

double clx_start_moment(const clx_start *s, int k)
{
    CLAST_ASSERT(k >= 0 && k <= 2);
    const double mean = s->config->initial_mean;
    double sum = 0.0;
    double number = 0.0;
    switch (s->config->initial) {
    case CLAST_INITIAL_TABLE:
        for (int64_t i = 0; i < s->table->n; ++i) {
            number += s->table->number[i];
            sum += s->table->number[i] * pow(s->table->size[i], k);
        }
        return s->concentration * sum / number;
    case CLAST_INITIAL_EXPONENTIAL:
        return s->concentration * (k == 2 ? 2.0 : 1.0) * pow(mean, k);
    case CLAST_INITIAL_LOGNORMAL:
        return s->concentration * pow(mean, k) * (k == 2 ? exp(log_sd(s) * log_sd(s)) : 1.0);
    default:
        return s->concentration * pow(mean, k);
    }
}

/// Number a size, over the concentration.
static double density(const clx_start *s, double x)
{
    if (s->config->initial == CLAST_INITIAL_EXPONENTIAL) {
        return exp(-x / s->config->initial_mean) / s->config->initial_mean;
    }
    const double z = (log(x) - log_median(s)) / log_sd(s);
    return exp(-0.5 * z * z) / (sqrt(2.0 * CLAST_PI) * log_sd(s) * x);
}

static void add_density(const clx_start *s, const clx_sectional *grid, double *number)
{
    for (int32_t i = 0; i + 1 < grid->n; ++i) {
        const double *x = grid->x + i;
        const double width = x[1] - x[0];
        double lent = 0.0;
        for (int q = 0; q < CLX_GAUSS_N; ++q) {
            const double u = clx_gauss_point(q);
            const double part =
                s->concentration * width * clx_gauss_weight(q) * density(s, x[0] + u * width);
            number[i] += (1.0 - u) * part;
            number[i + 1] += u * part;
            lent += part * clx_sectional_lent(grid, x[0] + u * width, i);
        }
        if (i > 0) {
            double gain[3];
            clx_sectional_lend(grid, i, number[i - 1] * x[-1], number[i] * x[0], gain);
            for (int m = 0; m < 3; ++m) {
                number[i - 1 + m] += lent * gain[m] / x[m - 1];
            }
        }
    }
    number[0] +=
        s->concentration * (s->config->initial == CLAST_INITIAL_EXPONENTIAL
                                ? -expm1(-grid->x[0] / s->config->initial_mean)
                                : clx_normal_cdf((log(grid->x[0]) - log_median(s)) / log_sd(s)));
}

void clx_start_add(const clx_start *s, const clx_sectional *grid, double *number)
{
    if (s->config->initial == CLAST_INITIAL_MONO) {
        clx_sectional_add(grid, s->config->initial_mean, s->concentration, number);
    } else if (s->config->initial == CLAST_INITIAL_TABLE) {
        double sum = 0.0;
        for (int64_t i = 0; i < s->table->n; ++i) {
            sum += s->table->number[i];
        }
        for (int64_t i = 0; i < s->table->n; ++i) {
            clx_sectional_add(grid, s->table->size[i], s->concentration * s->table->number[i] / sum,
                              number);
        }
    } else {
        add_density(s, grid, number);
    }
}

/// The greatest of the times; -INFINITY of none.
static clast_status last_time(const clast_table *table, const double *time, double *last)
{
    clast_status status = CLAST_OK;
    *last = -(double)INFINITY;
    for (int64_t i = 0; time != NULL && i < table->n_row; ++i) {
        CLX_CHECK(isfinite(time[i]), CLAST_E_FORMAT, "%s: row %lld: time_s is %g", table->name,
                  (long long)i + 1, time[i]);
        *last = fmax(*last, time[i]);
    }
done:
    return status;
}

clast_status clast_spectrum_start_from_table(clast_table *table, clast_spectrum_start *start)
{
    CLX_ARGUMENTS(table, start);
    CLX_WHOLE(table, table);
    clast_status status = CLAST_OK;
    const bool is_spectrum = clast_table_find(table, "number") < 0;
    double *size = clast_table_numbers(table, "size");
    double *number = clast_table_numbers(table, is_spectrum ? "n" : "number");
    const double *time = is_spectrum ? clast_table_numbers(table, "time_s") : NULL;
    double last = 0.0;
    int64_t n = 0;
    CLX_CHECK(size != NULL && number != NULL, CLAST_E_FORMAT,
              "%s: needs the columns size and number, or size and n", table->name);
    CLX_CHECK(!is_spectrum || clast_table_find(table, "size_low") < 0, CLAST_E_FORMAT,
              "%s: the spectrum of a cloud, whose n counts particles; give columns size and "
              "number, n over the cloud's volume (1/m^3)",
              table->name);
    CLX_CHECK(table->n_row > 0, CLAST_E_FORMAT, "%s: no row of sizes", table->name);
    CLX_TRY(last_time(table, time, &last));
    for (int64_t i = 0; i < table->n_row; ++i) {
        if (time == NULL || time[i] == last) {
            size[n] = size[i];
            number[n++] = number[i];
        }
    }
    *start = (clast_spectrum_start){n, size, number};
done:
    return status;
}
