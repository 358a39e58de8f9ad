// Means over realisations of a bed.
#include <clast/porosity.h>

#include "base/alloc.h"
#include "base/status.h"
#include "math/special.h"
#include <math.h>

clast_mean clast_mean_of(int32_t n, const double *value)
{
    const double nan = (double)NAN;
    if (n < 1 || value == NULL) {
        return (clast_mean){.mean = nan, .deviation = nan, .low = nan, .high = nan};
    }
    clast_mean m = {.n = n, .deviation = nan, .low = nan, .high = nan};
    double square = 0.0;
    for (int32_t i = 0; i < n; ++i) {
        m.mean += value[i] / n;
    }
    for (int32_t i = 0; i < n; ++i) {
        square += (value[i] - m.mean) * (value[i] - m.mean);
    }
    if (n > 1) {
        m.deviation = sqrt(square / (n - 1));
        const double half = clx_student_quantile_two_sided(0.05, n - 1) * m.deviation / sqrt(n);
        m.low = m.mean - half;
        m.high = m.mean + half;
    }
    return m;
}

/// Whether the slices or rings of all profiles are those of the longest.
static clast_status check(int32_t n, const clast_table *profile, const clast_table *longest,
                          const char *const bound[2])
{
    clast_status status = CLAST_OK;
    const double *edge = clast_table_numbers(longest, bound[0]);
    const double *top = clast_table_numbers(longest, bound[1]);
    for (int32_t i = 0; i < n; ++i) {
        const double *low = clast_table_numbers(&profile[i], bound[0]);
        CLX_CHECK(low != NULL && edge != NULL && top != NULL &&
                      clast_table_numbers(&profile[i], "porosity") != NULL,
                  CLAST_E_USAGE, "table %d is no porosity profile", i);
        for (int64_t k = 0; k < profile[i].n_row; ++k) {
            CLX_CHECK(fabs(low[k] - edge[k]) <= 1e-6 * (top[k] - edge[k]), CLAST_E_USAGE,
                      "slice %lld of bed %d begins at %s, that of another at %s; give the same "
                      "--layer, --floor and container",
                      (long long)k, i + 1, clx_unit_text(low[k], "m"), clx_unit_text(edge[k], "m"));
        }
    }
done:
    return status;
}

clast_status clast_porosity_mean_profile(int32_t n, const clast_table *profile, clast_table *band)
{
    CLX_ARGUMENTS(band);
    CLX_ARRAY(profile, n);
    for (int32_t i = 0; i < n; ++i) {
        CLX_WHOLE(table, &profile[i]);
    }
    clast_status status = CLAST_OK;
    clast_table made = {0};
    double *value = NULL;
    const clast_table *longest = &profile[0];
    CLX_CHECK(n > 0, CLAST_E_USAGE, "a mean of no profile");
    const bool is_radial = clast_table_numbers(&profile[0], "r_low_m") != NULL;
    const char *const name[] = {is_radial ? "r_low_m" : "z_low_m",
                                is_radial ? "r_high_m" : "z_high_m",
                                "porosity",
                                "deviation",
                                "low",
                                "high",
                                "n"};
    for (int32_t i = 1; i < n; ++i) {
        longest = profile[i].n_row > longest->n_row ? &profile[i] : longest;
    }
    CLX_TRY(check(n, profile, longest, name));
    CLX_TRY(clx_alloc(&value, n, sizeof *value));
    CLX_TRY(clast_table_init(&made, is_radial ? "mean_radial" : "mean_profile", longest->n_row));
    for (int c = 0; c < 7; ++c) {
        CLX_TRY(clast_table_add_number(&made, name[c], c < 2 ? "m" : "-", NULL));
    }
    for (int64_t k = 0; k < longest->n_row; ++k) {
        for (int32_t i = 0; i < n; ++i) {
            value[i] = k < profile[i].n_row ? clast_table_numbers(&profile[i], "porosity")[k] : 1.0;
        }
        const clast_mean m = clast_mean_of(n, value);
        const double row[7] = {clast_table_numbers(longest, name[0])[k],
                               clast_table_numbers(longest, name[1])[k],
                               m.mean,
                               n > 1 ? m.deviation : 0.0,
                               n > 1 ? m.low : m.mean,
                               n > 1 ? m.high : m.mean,
                               n};
        for (int c = 0; c < 7; ++c) {
            made.column[c].number[k] = row[c];
        }
    }
    *band = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    clx_free(value);
    return status;
}
