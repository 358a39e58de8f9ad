// Love's and Weber's stress from contact forces, in bulk and by height.
#include <clast/porosity.h>

#include "base/alloc.h"
#include "base/status.h"
#include "porosity/contact_columns.h"
#include "porosity/slabs.h"
#include "porosity/whole.h"
#include <math.h>

enum { MOST_PERIODS = 4 }; ///< of a branch

/// Rising heights between which branches are shared out.
typedef struct {
    int32_t n;
    const double *edge; ///< [n + 1]
    double period;      ///< in height, 0: none
    bool is_open;       ///< what is below or above counts at the ends
} slices;

/// Share of a branch between two heights that lies between two others.
static double share_between(double from, double to, double low, double high)
{
    if (!(to > from)) {
        return from >= low && from < high ? 1.0 : 0.0;
    }
    return fmax(0.0, fmin(to, high) - fmax(from, low)) / (to - from);
}

/// Adds a share of f_i l_j; symmetric part xx yy zz xy xz yz.
static void add_share(const clx_contacts *c, int64_t k, double share, double sum[6])
{
    CLAST_ASSERT(k >= 0 && k < c->n);
    static const int at[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    for (int e = 0; e < 6 && share > 0.0; ++e) {
        const int i = at[e][0];
        const int j = at[e][1];
        sum[e] +=
            0.5 * share * (c->force[i][k] * c->branch[j][k] + c->force[j][k] * c->branch[i][k]);
    }
}

/// Adds contact k, whose branch lies between these heights, to the slices that it passes.
static void add_branch(const clx_contacts *c, int64_t k, double from, double to, const slices *s,
                       double (*sum)[6])
{
    const int32_t first = clx_slice_of(s->n, s->edge, from);
    for (int32_t i = first < s->n ? first : s->n - 1; i < s->n && (i == first || s->edge[i] <= to);
         ++i) {
        const double low = s->is_open && i == 0 ? -HUGE_VAL : s->edge[i];
        const double high = s->is_open && i + 1 == s->n ? HUGE_VAL : s->edge[i + 1];
        add_share(c, k, share_between(from, to, low, high), sum[i]);
    }
}

/// The same in a bed that repeats in height: images from the highest that begins below the top.
static void add_images(const clx_contacts *c, int64_t k, const slices *s, double (*sum)[6])
{
    const double top = s->edge[s->n];
    const double length = fabs(c->branch[2][k]);
    double from = fmin(c->z_a[k], c->z_a[k] + c->branch[2][k]);
    from -= s->period * (floor((from - top) / s->period) + 1.0);
    from = from < top ? from : top - s->period; // by rounding
    do {
        add_branch(c, k, from, from + length, s, sum);
        from -= s->period;
    } while (from + length > s->edge[0]);
}

/// Adds all branches to the slices that they pass.
static clast_status gather(const clx_contacts *c, const slices *s, double (*sum)[6])
{
    clast_status status = CLAST_OK;
    const bool repeats = s->period > 0.0;
    CLX_CHECK(!repeats || s->edge[s->n] - s->edge[0] <= (1.0 + 1e-12) * s->period, CLAST_E_USAGE,
              "heights of %s in a bed that repeats after %s",
              clx_unit_text(s->edge[s->n] - s->edge[0], "m"), clx_unit_text(s->period, "m"));
    for (int64_t k = 0; k < c->n; ++k) {
        if (!repeats) {
            const double end = c->z_a[k] + c->branch[2][k];
            add_branch(c, k, fmin(c->z_a[k], end), fmax(c->z_a[k], end), s, sum);
            continue;
        }
        CLX_CHECK(isfinite(c->z_a[k]) && fabs(c->branch[2][k]) <= MOST_PERIODS * s->period,
                  CLAST_E_FORMAT, "contact %lld has a branch of %s in a bed that repeats after %s",
                  (long long)k + 1, clx_unit_text(c->branch[2][k], "m"),
                  clx_unit_text(s->period, "m"));
        add_images(c, k, s, sum);
    }
done:
    return status;
}

/// Of a part of a packing no stress follows from all contacts.
static clast_status check_whole(const clast_bed *bed)
{
    return bed->is_part ? clx_fail(CLAST_E_USAGE, "stress of a part of a packing: contacts are "
                                                  "those of all grains")
                        : CLAST_OK;
}

static clast_status add_row(clast_table *table, int64_t row, const char *name, double value,
                            const char *unit, const char *meaning)
{
    clast_status status = CLAST_OK;
    table->column[1].number[row] = value;
    CLX_TRY(clast_table_set_text(table, 0, row, name));
    CLX_TRY(clast_table_set_text(table, 2, row, unit));
    CLX_TRY(clast_table_set_text(table, 3, row, meaning));
done:
    return status;
}

static clast_status make_rows(const double s[6], clast_table *table)
{
    static const char *const name[6] = {"stress_xx", "stress_yy", "stress_zz",
                                        "stress_xy", "stress_xz", "stress_yz"};
    clast_status status = CLAST_OK;
    const double p = (s[0] + s[1] + s[2]) / 3.0;
    double square = 0.0;
    for (int e = 0; e < 6; ++e) {
        const double d = e < 3 ? s[e] - p : s[e];
        square += (e < 3 ? 1.0 : 2.0) * d * d;
        CLX_TRY(add_row(table, e, name[e], s[e], "Pa", "contact stress, pressure above 0"));
    }
    CLX_TRY(add_row(table, 6, "pressure", p, "Pa", "mean of the three normal stresses"));
    CLX_TRY(add_row(table, 7, "deviator", sqrt(1.5 * square), "Pa", "q, von Mises' stress"));
    CLX_TRY(add_row(table, 8, "stress_ratio", 0.5 * (s[0] + s[1]) / s[2], "-",
                    "horizontal over vertical stress"));
done:
    return status;
}

clast_status clast_stress(const clast_table *table, const clast_bed *bed, const double z[2],
                          clast_table *out)
{
    CLX_ARGUMENTS(table, bed, z, out);
    CLX_WHOLE(table, table);
    CLX_WHOLE(bed, bed);
    clast_status status = CLAST_OK;
    clast_table made = {0};
    clx_contacts c = {0};
    double sum[1][6] = {{0.0}};
    double volume = 0.0;
    double period[3];
    (void)clast_bed_period(bed, period);
    CLX_TRY(check_whole(bed));
    CLX_TRY(clx_contacts_read(table, &c));
    clast_bed_volumes(bed, 1, z, &volume);
    CLX_CHECK(z[1] > z[0] && volume > 0.0, CLAST_E_GEOMETRY, "no volume between %s and %s",
              clx_unit_text(z[0], "m"), clx_unit_text(z[1], "m"));
    CLX_TRY(gather(&c, &(slices){.n = 1, .edge = z, .period = period[2]}, sum));
    for (int e = 0; e < 6; ++e) {
        sum[0][e] /= volume;
    }
    CLX_TRY(clast_table_init(&made, "stress", 9));
    CLX_TRY(clast_table_add_text(&made, "name"));
    CLX_TRY(clast_table_add_number(&made, "value", "-", NULL));
    CLX_TRY(clast_table_add_text(&made, "unit"));
    CLX_TRY(clast_table_add_text(&made, "meaning"));
    CLX_TRY(make_rows(sum[0], &made));
    *out = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}

clast_status clast_stress_profile(const clast_table *table, const clast_bed *bed,
                                  const clast_table *profile, clast_table *out)
{
    CLX_ARGUMENTS(table, bed, profile, out);
    CLX_WHOLE(table, table);
    CLX_WHOLE(bed, bed);
    CLX_WHOLE(table, profile);
    static const char *const name[6] = {"stress_xx_Pa", "stress_yy_Pa", "stress_zz_Pa",
                                        "stress_xy_Pa", "stress_xz_Pa", "stress_yz_Pa"};
    clast_status status = CLAST_OK;
    clast_table made = {0};
    clx_contacts c = {0};
    double(*sum)[6] = NULL;
    double *edge = NULL;
    double *volume = NULL;
    double *column = NULL;
    double period[3];
    const int64_t n = profile->n_row;
    const double *low = clast_table_numbers(profile, "z_low_m");
    const double *high = clast_table_numbers(profile, "z_high_m");
    (void)clast_bed_period(bed, period);
    CLX_TRY(check_whole(bed));
    CLX_CHECK(n > 0 && n < INT32_MAX && low != NULL && high != NULL, CLAST_E_USAGE,
              "the table is no porosity profile");
    CLX_TRY(clx_contacts_read(table, &c));
    CLX_TRY(clx_alloc(&sum, n, sizeof *sum));
    CLX_TRY(clx_alloc(&edge, n + 1, sizeof *edge));
    CLX_TRY(clx_alloc(&volume, n, sizeof *volume));
    for (int64_t k = 0; k <= n; ++k) {
        edge[k] = k < n ? low[k] : high[n - 1];
    }
    clast_bed_volumes(bed, (int32_t)n, edge, volume);
    const slices s = {(int32_t)n, edge, period[2], period[2] == 0.0};
    CLX_TRY(gather(&c, &s, sum));
    CLX_TRY(clast_table_init(&made, "stress_profile", n));
    CLX_TRY(clast_table_add_number(&made, "z_low_m", "m", &column));
    CLX_TRY(clast_table_add_number(&made, "z_high_m", "m", NULL));
    for (int e = 0; e < 6; ++e) {
        CLX_TRY(clast_table_add_number(&made, name[e], "Pa", NULL));
    }
    for (int64_t k = 0; k < n; ++k) {
        made.column[0].number[k] = low[k];
        made.column[1].number[k] = high[k];
        for (int e = 0; e < 6; ++e) {
            made.column[2 + e].number[k] = volume[k] > 0.0 ? sum[k][e] / volume[k] : 0.0;
        }
    }
    *out = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    CLX_FREE(sum, edge, volume);
    return status;
}
