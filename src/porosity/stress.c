// Love's and Weber's stress from contact forces, in bulk and by height.
#include <clast/porosity.h>

#include "base/alloc.h"
#include "base/status.h"
#include "porosity/contact_columns.h"
#include "porosity/whole.h"
#include <math.h>

/// Share of a branch from z to z + length that lies between two heights.
static double share_between(double z, double length, double low, double high)
{
    if (fabs(length) < 1e-300) {
        return z >= low && z < high ? 1.0 : 0.0;
    }
    const double from = fmin(z, z + length);
    const double to = fmax(z, z + length);
    return fmax(0.0, fmin(to, high) - fmax(from, low)) / (to - from);
}

/// Adds f_i l_j of the parts of branches between the heights; symmetric part xx yy zz xy xz yz.
static void add_between(const clx_contacts *c, int64_t k, double low, double high, double sum[6])
{
    CLAST_ASSERT(k >= 0 && k < c->n);
    static const int at[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    const double share = share_between(c->z_a[k], c->branch[2][k], low, high);
    for (int e = 0; e < 6 && share > 0.0; ++e) {
        const int i = at[e][0];
        const int j = at[e][1];
        sum[e] +=
            0.5 * share * (c->force[i][k] * c->branch[j][k] + c->force[j][k] * c->branch[i][k]);
    }
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
    double sum[6] = {0.0};
    double volume = 0.0;
    CLX_TRY(clx_contacts_read(table, &c));
    clast_bed_volumes(bed, 1, z, &volume);
    CLX_CHECK(z[1] > z[0] && volume > 0.0, CLAST_E_GEOMETRY, "no volume between %s and %s",
              clx_unit_text(z[0], "m"), clx_unit_text(z[1], "m"));
    for (int64_t k = 0; k < c.n; ++k) {
        add_between(&c, k, z[0], z[1], sum);
    }
    for (int e = 0; e < 6; ++e) {
        sum[e] /= volume;
    }
    CLX_TRY(clast_table_init(&made, "stress", 9));
    CLX_TRY(clast_table_add_text(&made, "name"));
    CLX_TRY(clast_table_add_number(&made, "value", "-", NULL));
    CLX_TRY(clast_table_add_text(&made, "unit"));
    CLX_TRY(clast_table_add_text(&made, "meaning"));
    CLX_TRY(make_rows(sum, &made));
    *out = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}

static int64_t slice_at(const double *edge, int64_t n, double z)
{
    CLAST_ASSERT(n > 0);
    const double step = (edge[n] - edge[0]) / (double)n;
    const double k = floor((z - edge[0]) / step);
    return (int64_t)fmax(0.0, fmin((double)(n - 1), k));
}

/// Adds all branches to the slices that they pass.
static void gather(const clx_contacts *c, const double *edge, int64_t n, double (*sum)[6])
{
    for (int64_t k = 0; k < c->n; ++k) {
        const double z = c->z_a[k];
        const double end = z + c->branch[2][k];
        const int64_t first = slice_at(edge, n, fmin(z, end));
        const int64_t last = slice_at(edge, n, fmax(z, end));
        for (int64_t s = first; s <= last; ++s) { // what is below or above counts at the ends
            add_between(c, k, s == 0 ? -HUGE_VAL : edge[s], s + 1 == n ? HUGE_VAL : edge[s + 1],
                        sum[s]);
        }
    }
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
    const int64_t n = profile->n_row;
    const double *low = clast_table_numbers(profile, "z_low_m");
    const double *high = clast_table_numbers(profile, "z_high_m");
    CLX_CHECK(n > 0 && low != NULL && high != NULL, CLAST_E_USAGE,
              "the table is no porosity profile");
    CLX_TRY(clx_contacts_read(table, &c));
    CLX_TRY(clx_alloc(&sum, n, sizeof *sum));
    CLX_TRY(clx_alloc(&edge, n + 1, sizeof *edge));
    CLX_TRY(clx_alloc(&volume, n, sizeof *volume));
    for (int64_t k = 0; k <= n; ++k) {
        edge[k] = k < n ? low[k] : high[n - 1];
    }
    clast_bed_volumes(bed, (int32_t)n, edge, volume);
    gather(&c, edge, n, sum);
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
    clx_free(sum);
    clx_free(edge);
    clx_free(volume);
    return status;
}
