// Histograms with round bins.
#include <clast/statistics.h>

#include "base/alloc.h"
#include "base/status.h"
#include "math/sample.h"
#include "math/sort.h"
#include "math/special.h"
#include "math/whole.h"
#include <clast/table.h>
#include <math.h>

enum { MAX_BIN = 200 };

/// 1, 2 or 5 times a power of ten, the nearest to `rough` by ratio.
static double round_width(double rough)
{
    const double power = pow(10.0, floor(log10(rough)));
    const double lead = rough / power;
    return power * (lead < sqrt(2.0)    ? 1.0
                    : lead < sqrt(10.0) ? 2.0
                    : lead < sqrt(50.0) ? 5.0
                                        : 10.0);
}

static double width_of(const double *sorted, int64_t n, const clx_moments *m)
{
    CLAST_ASSERT(n > 1);
    const double iqr = clx_sample_quantile(sorted, n, 0.75) - clx_sample_quantile(sorted, n, 0.25);
    const double spread = iqr > 0.0 ? iqr : m->deviation_ml;
    const double range = sorted[n - 1] - sorted[0];
    const double rough = fmax(2.0 * spread / cbrt((double)n), range / (0.5 * MAX_BIN));
    return round_width(rough);
}

/// Whether doubles as large as the sample's are closer to each other than edges would be.
static bool has_edges(const double *sorted, int64_t n, const clx_moments *m)
{
    const double most = fmax(fabs(sorted[0]), fabs(sorted[n - 1]));
    const double width = width_of(sorted, n, m);
    return most + 0.25 * width > most && isfinite(1.0 / width);
}

/// Lower edge and width for a sorted sample that is not constant.
static void choose_bins(const double *sorted, int64_t n, const clx_moments *m, clast_histogram *h,
                        double *low, double *width)
{
    *width = width_of(sorted, n, m);
    *low = *width * floor(sorted[0] / *width + 1e-9);
    h->n_bin = (int32_t)fmax(1.0, ceil((sorted[n - 1] - *low) / *width - 1e-9));
    CLAST_ASSERT(h->n_bin >= 1);
}

static void count_all(const double *sorted, int64_t n, double low, double width, clast_histogram *h)
{
    CLAST_ASSERT(n > 0 && h->n_bin >= 1);
    for (int32_t k = 0; k <= h->n_bin; ++k) {
        h->edge[k] = low + k * width;
    }
    for (int64_t i = 0; i < n; ++i) {
        const double place = floor((sorted[i] - low) / width + 1e-9);
        const int32_t k = (int32_t)fmin(fmax(place, 0.0), (double)(h->n_bin - 1));
        ++h->count[k];
    }
    for (int32_t k = 0; k < h->n_bin; ++k) {
        h->density[k] = (double)h->count[k] / ((double)n * width);
    }
}

clast_status clast_histogram_of(const double *x, int64_t n, clast_histogram *histogram)
{
    CLX_ARGUMENTS(histogram);
    CLX_ARRAY(x, n);
    clast_status status = CLAST_OK;
    clast_histogram h = {.n_bin = 1};
    double *sorted = NULL;
    int64_t n_finite = 0;
    CLX_TRY(clx_alloc(&sorted, n, sizeof *sorted));
    for (int64_t i = 0; i < n; ++i) {
        if (isfinite(x[i])) {
            sorted[n_finite++] = x[i];
        }
    }
    CLX_CHECK(n_finite > 0, CLAST_E_FORMAT, "histogram of %lld values, none of them finite",
              (long long)n);
    CLX_TRY(clx_sort_doubles(sorted, n_finite));
    const clx_moments m = clx_sample_moments(sorted, n_finite);
    CLX_CHECK(
        isfinite(sorted[n_finite - 1] - sorted[0]) && isfinite(m.mean) && isfinite(m.deviation_ml),
        CLAST_E_FORMAT, "histogram of values from %g to %g, which are beyond a double's range",
        sorted[0], sorted[n_finite - 1]);
    h.mean = m.mean;
    h.deviation_ml = m.deviation_ml;
    double width = 0.2 * fabs(m.mean);
    width = isfinite(1.0 / width) ? width : 1.0;
    double low = sorted[0] - 0.5 * width;
    if (!m.is_constant && has_edges(sorted, n_finite, &m)) {
        choose_bins(sorted, n_finite, &m, &h, &low, &width);
    }
    CLX_TRY(clx_alloc(&h.edge, h.n_bin + 1, sizeof *h.edge));
    CLX_TRY(clx_alloc(&h.count, h.n_bin, sizeof *h.count));
    CLX_TRY(clx_alloc(&h.density, h.n_bin, sizeof *h.density));
    count_all(sorted, n_finite, low, width, &h);
    *histogram = h;
    h = (clast_histogram){0};
done:
    clast_histogram_free(&h);
    clx_free(sorted);
    return status;
}

void clast_histogram_free(clast_histogram *histogram)
{
    if (histogram == NULL) {
        return;
    }
    CLX_FREE(histogram->edge, histogram->count, histogram->density);
    *histogram = (clast_histogram){0};
}

clast_status clast_histogram_table(const clast_histogram *histogram, const char *name,
                                   clast_table *table)
{
    CLX_ARGUMENTS(histogram, name, table);
    CLX_WHOLE(histogram, histogram);
    static const char *const column[5] = {"low", "high", "count", "density", "normal"};
    clast_status status = CLAST_OK;
    const clast_histogram *h = histogram;
    clast_table t = {0};
    double *cell[5] = {NULL};
    CLX_TRY(clast_table_init(&t, name, h->n_bin));
    for (int k = 0; k < 5; ++k) {
        CLX_TRY(clast_table_add_number(&t, column[k], "-", &cell[k]));
    }
    for (int32_t i = 0; i < h->n_bin; ++i) {
        const double width = h->edge[i + 1] - h->edge[i];
        cell[0][i] = h->edge[i];
        cell[1][i] = h->edge[i + 1];
        cell[2][i] = (double)h->count[i];
        cell[3][i] = h->density[i];
        cell[4][i] = h->deviation_ml > 0.0
                         ? (clx_normal_cdf((h->edge[i + 1] - h->mean) / h->deviation_ml) -
                            clx_normal_cdf((h->edge[i] - h->mean) / h->deviation_ml)) /
                               width
                         : 0.0;
    }
    *table = t;
    t = (clast_table){0};
done:
    clast_table_free(&t);
    return status;
}
