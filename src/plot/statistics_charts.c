// Charts of a set of grains: Zingg diagram, histograms, correlation, principal components.
#include <clast/chart.h>

#include "base/alloc.h"
#include "base/number.h"
#include "base/status.h"
#include "math/sort.h"
#include "math/whole.h"
#include "plot/series.h"
#include "shape/whole.h"
#include <clast/form.h>
#include <clast/statistics.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { N_CURVE = 201, LABEL_SIZE = 96 };

static void bounds(const double *x, int64_t n, double *low, double *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    for (int64_t i = 0; i < n; ++i) {
        if (isfinite(x[i])) {
            *low = fmin(*low, x[i]);
            *high = fmax(*high, x[i]);
        }
    }
}

/// The unit that an axis up to `most` says: of metres a smaller one, with what takes them to it.
static const char *axis_unit(const char *unit, double most, double *factor)
{
    static const struct {
        double metre;
        const char *name;
    } units[] = {{1.0, "m"}, {1e-3, "mm"}, {1e-6, "\302\265m"}, {1e-9, "nm"}};
    size_t k = 0;
    *factor = 1.0;
    if (strcmp(unit, "m") != 0) {
        return unit[0] != '\0' ? unit : "model units";
    }
    while (k + 1 < sizeof units / sizeof *units && most < units[k].metre) {
        ++k;
    }
    *factor = 1.0 / units[k].metre;
    return units[k].name;
}

clast_status clast_chart_zingg(const clast_form_set *set, const char *path)
{
    CLX_ARGUMENTS(set, path);
    CLX_WHOLE(form_set, set);
    static const double border[4] = {2.0 / 3.0, 2.0 / 3.0, 0.0, 1.0};
    static const clast_note notes[4] = {{0.83, 0.03, "rods"},
                                        {0.34, 0.03, "blades"},
                                        {0.83, 0.97, "spheres"},
                                        {0.34, 0.97, "discs"}};
    clast_status status = CLAST_OK;
    char title[LABEL_SIZE];
    char label[LABEL_SIZE] = "";
    double *size = NULL;
    double low = 0.0;
    double high = 0.0;
    if (set->size != NULL) {
        bounds(set->size, set->n, &low, &high);
        CLX_TRY(clx_alloc(&size, set->n, sizeof *size));
        double factor = 1.0;
        const char *unit = axis_unit(set->size_unit, high, &factor);
        (void)snprintf(label, sizeof label, "%s (%s)", set->size_name, unit);
        for (int64_t i = 0; i < set->n; ++i) {
            size[i] = factor * set->size[i];
        }
    }
    const clast_series series[3] = {clx_dashed_line(NULL, border, border + 2, 2, -1),
                                    clx_dashed_line(NULL, border + 2, border, 2, -1),
                                    {.kind = CLAST_SERIES_POINTS,
                                     .x = set->flatness,
                                     .y = set->elongation,
                                     .value = size,
                                     .n = set->n}};
    (void)snprintf(title, sizeof title, "Zingg diagram of %lld grain%s", (long long)set->n,
                   set->n == 1 ? "" : "s");
    const bool has_size = set->size != NULL && low > 0.0 && high > low * (1.0 + 1e-9);
    const bool is_log = has_size && high > 5.0 * low;
    const clast_chart chart = {.title = title,
                               .x = {.label = "flatness S/I (-)", .low = 0.0, .high = 1.0},
                               .y = {.label = "elongation I/L (-)", .low = 0.0, .high = 1.0},
                               .value_axis = {.label = has_size ? label : NULL, .log = is_log},
                               .series = series,
                               .n_series = 3,
                               .note = notes,
                               .n_note = 4,
                               .equal = true,
                               .width = has_size ? 500.0 : 430.0,
                               .height = 440.0};
    CLX_TRY(clast_chart_write(&chart, path));
done:
    clx_free(size);
    return status;
}

/// Density of the fitted normal over the bars and three deviations to either side, as far as it
/// shows.
static void normal_curve(const clast_histogram *h, double x[N_CURVE], double y[N_CURVE])
{
    const double s = h->deviation_ml;
    const double from = h->edge[0] >= 0.0 ? 0.0 : -HUGE_VAL; // sizes are not negative
    const double low = fmax(from, fmin(h->edge[0], h->mean - 3.0 * s));
    const double high = fmax(h->edge[h->n_bin], h->mean + 3.0 * s);
    for (int i = 0; i < N_CURVE; ++i) {
        x[i] = low + (high - low) * i / (N_CURVE - 1);
        const double z = (x[i] - h->mean) / s;
        y[i] = exp(-0.5 * z * z) / (s * sqrt(2.0 * CLAST_PI));
    }
}

static clast_status draw_histogram(const clast_histogram *h, const char *label, const char *unit,
                                   const char *title, const char *path)
{
    char law[LABEL_SIZE];
    char x_axis[2 * LABEL_SIZE];
    char y_axis[LABEL_SIZE];
    double x[N_CURVE];
    double y[N_CURVE];
    (void)snprintf(x_axis, sizeof x_axis, "%s (%s)", label, unit);
    (void)snprintf(y_axis, sizeof y_axis, "probability density (%s%s)",
                   strcmp(unit, "-") == 0 ? "" : "1/", unit);
    const bool has_law = h->deviation_ml > 0.0 && h->n_bin > 1;
    (void)clx_number_print(law, sizeof law, "N(\316\274 = %.4g, \317\203 = %.4g)", h->mean,
                           h->deviation_ml);
    if (has_law) {
        normal_curve(h, x, y);
    }
    const clast_series series[2] = {
        clx_series(CLAST_SERIES_BARS, "grains", h->edge, h->density, h->n_bin, 5),
        clx_series(CLAST_SERIES_LINE, law, x, y, N_CURVE, 1)};
    const clast_chart chart = {.title = title,
                               .x = {.label = x_axis},
                               .y = {.label = y_axis},
                               .series = series,
                               .n_series = has_law ? 2 : 1};
    return clast_chart_write(&chart, path);
}

/// W and p of the finite values into the title; nothing for samples that have none.
static clast_status judge(const double *x, int64_t n, char *title, size_t size)
{
    clast_status status = CLAST_OK;
    double *finite = NULL;
    double w = 0.0;
    double p = 0.0;
    int64_t m = 0;
    CLX_TRY(clx_alloc(&finite, n, sizeof *finite));
    for (int64_t i = 0; i < n; ++i) {
        if (isfinite(x[i])) {
            finite[m++] = x[i];
        }
    }
    status = clast_shapiro_wilk(finite, m, &w, &p);
    CLX_CHECK(status != CLAST_E_MEMORY, status, "no memory for a histogram's title");
    if (status == CLAST_OK) {
        (void)clx_number_print(title, size, "n = %lld, Shapiro-Wilk W = %.3f, p = %.3g%s",
                               (long long)m, w, p, m > 5000 ? " (n > 5000: extrapolated)" : "");
    } else {
        (void)snprintf(title, size, "n = %lld, no test of normality (too few or equal values)",
                       (long long)m);
        status = CLAST_OK;
    }
done:
    clx_free(finite);
    return status;
}

clast_status clast_chart_histogram(const double *x, int64_t n, const char *label, const char *unit,
                                   const char *path)
{
    CLX_ARGUMENTS(label, unit, path);
    CLX_ARRAY(x, n);
    clast_status status = CLAST_OK;
    clast_histogram h = {0};
    char title[LABEL_SIZE];
    double factor = 1.0;
    CLX_TRY(judge(x, n, title, sizeof title));
    CLX_TRY(clast_histogram_of(x, n, &h));
    const char *shown = axis_unit(unit, fabs(h.edge[h.n_bin]), &factor);
    for (int32_t k = 0; k <= h.n_bin; ++k) {
        h.edge[k] *= factor;
    }
    for (int32_t k = 0; k < h.n_bin; ++k) {
        h.density[k] /= factor;
    }
    h.mean *= factor;
    h.deviation_ml *= factor;
    CLX_TRY(draw_histogram(&h, label, shown, title, path));
done:
    clast_histogram_free(&h);
    return status;
}

static const char *short_name(const char *name)
{
    const int32_t factor = clast_form_factor_find(name);
    return factor >= 0 ? clast_form_factor_about(factor)->symbol : name;
}

clast_status clast_chart_correlation(const clast_statistics *statistics, const char *path)
{
    CLX_ARGUMENTS(statistics, path);
    CLX_WHOLE(statistics, statistics);
    clast_status status = CLAST_OK;
    const int32_t n = statistics->n;
    const char **name = NULL; // of the columns, then of the rows from below
    double *value = NULL;
    CLX_TRY(clx_alloc(&name, 2 * (int64_t)n, sizeof *name));
    CLX_TRY(clx_alloc(&value, (int64_t)n * n, sizeof *value));
    for (int32_t i = 0; i < n; ++i) {
        name[i] = short_name(statistics->name[i]);
        name[2 * n - 1 - i] = name[i];
        for (int32_t j = 0; j < n; ++j) {
            value[(n - 1 - i) * n + j] = statistics->r[i * n + j];
        }
    }
    const clast_heat heat = {.n_x = n,
                             .n_y = n,
                             .value = value,
                             .x_high = n,
                             .y_high = n,
                             .x_name = name,
                             .y_name = name + n,
                             .is_signed = true,
                             .has_text = n <= 20};
    const double side = fmin(fmax(26.0 * n, 260.0), 900.0);
    const clast_chart chart = {
        .title = "Correlation (Pearson)",
        .value_axis = {.label = "correlation coefficient r (-)", .low = -1.0, .high = 1.0},
        .heat = &heat,
        .equal = true,
        .width = side + 150.0,
        .height = side + 90.0};
    CLX_TRY(clast_chart_write(&chart, path));
done:
    CLX_FREE((void *)name, value);
    return status;
}

clast_status clast_chart_pca(const clast_statistics *statistics, const char *path)
{
    CLX_ARGUMENTS(statistics, path);
    CLX_WHOLE(statistics, statistics);
    clast_status status = CLAST_OK;
    const int32_t n = statistics->n_pca;
    double *v = NULL; // edges, shares, places, sums
    CLX_CHECK(n > 0, CLAST_E_FORMAT, "no principal components: fewer than two columns vary");
    CLX_TRY(clx_alloc(&v, 4 * (int64_t)n + 1, sizeof *v));
    for (int32_t k = 0; k <= n; ++k) {
        v[k] = k + 0.5;
    }
    double *share = v + n + 1;
    for (int32_t k = 0; k < n; ++k) {
        share[k] = statistics->variance[k] / n;
        share[n + k] = k + 1.0;
        share[2 * n + k] = statistics->explained[k];
    }
    const clast_series series[3] = {
        clx_series(CLAST_SERIES_BARS, "component", v, share, n, 5),
        clx_series(CLAST_SERIES_LINE, NULL, share + n, share + 2 * n, n, 1),
        clx_series(CLAST_SERIES_POINTS, "sum of the first", share + n, share + 2 * n, n, 1)};
    const clast_chart chart = {
        .title = "Principal components",
        .x = {.label = "component (-)", .low = 0.0, .high = n + 1.0},
        .y = {.label = "share of the variance (-)", .low = 0.0, .high = 1.05},
        .series = series,
        .n_series = 3};
    CLX_TRY(clast_chart_write(&chart, path));
done:
    clx_free(v);
    return status;
}
