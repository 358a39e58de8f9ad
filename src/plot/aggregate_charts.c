// Charts of an aggregation: porosity, diameter and density while it grows, grain sizes wanted and
// placed, solid fraction over the radius.
//
// A chart of 600 points is as sharp as a page shows; all 10,000 rows of five repeats would make a
// page of several megabytes.
#include "plot/aggregate_charts.h"

#include "aggregate/history.h"
#include "base/alloc.h"
#include "base/path.h"
#include "base/status.h"
#include "math/sort.h"
#include "plot/series.h"
#include <clast/table.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_SERIES = 16, MAX_POINT = 600, LABEL_SIZE = 96 };

static const struct {
    const char *name, *title, *column, *x, *y;
} kinds[CLAST_N_AGGREGATE_CHART] = {
    {"history", "Porosity while the aggregate grows", "porosity_", "particles (-)", "porosity (-)"},
    {"diameter", "Diameter while the aggregate grows", "d_agg_m", "particles (-)", "D_agg"},
    {"density", "Density while the aggregate grows", "density_kg/m^3", "particles (-)",
     "density (kg/m\302\263)"},
    {"sizes", "Grain sizes, cumulative", "size_m", "grain size", "share finer, by number (-)"},
    {"radial", "Solid fraction over the radius", "solid_fraction", "radius", "solid fraction (-)"},
};

/// Points of one line, with a band; all arrays [n].
typedef struct {
    int64_t n;
    bool has_band, is_step;
    double *x, *y, *low, *high;
    char label[LABEL_SIZE];
} line;

typedef struct {
    int32_t n_line;
    line lines[MAX_SERIES];
    int32_t n_series;
    clast_series series[2 * MAX_SERIES];
    char x_label[LABEL_SIZE], y_label[LABEL_SIZE];
    clast_chart chart;
} drawing;

const char *clast_aggregate_chart_name(clast_aggregate_chart chart)
{
    return (unsigned)chart < CLAST_N_AGGREGATE_CHART ? kinds[chart].name : "unknown";
}

const char *clx_aggregate_chart_title(clast_aggregate_chart chart)
{
    return (unsigned)chart < CLAST_N_AGGREGATE_CHART ? kinds[chart].title : "unknown";
}

static const char *x_column(clast_aggregate_chart chart)
{
    return chart == CLAST_AGGREGATE_CHART_RADIAL  ? "radius_low_m"
           : chart == CLAST_AGGREGATE_CHART_SIZES ? "size_m"
                                                  : "n";
}

/// Column c is one of the chart's y.
static bool is_wanted(clast_aggregate_chart chart, const clast_column *c)
{
    const char *name = kinds[chart].column;
    const bool is_prefix = name[strlen(name) - 1] == '_';
    return c->number != NULL &&
           (is_prefix ? strncmp(c->name, name, strlen(name)) == 0 : strcmp(c->name, name) == 0);
}

static int64_t count_finite(const double *x, const double *y, int64_t n)
{
    int64_t count = 0;
    for (int64_t i = 0; i < n; ++i) {
        count += isfinite(x[i]) && isfinite(y[i]) ? 1 : 0;
    }
    return count;
}

bool clast_aggregate_chart_fits(clast_aggregate_chart chart, const clast_table *table)
{
    if ((unsigned)chart >= CLAST_N_AGGREGATE_CHART || clx_table_fault(table) != NULL) {
        return false;
    }
    const double *x = clast_table_numbers(table, x_column(chart));
    if (x == NULL) {
        return false;
    }
    for (int32_t c = 0; c < table->n_column; ++c) {
        if (is_wanted(chart, &table->column[c]) &&
            count_finite(x, table->column[c].number, table->n_row) > 1) {
            return true;
        }
    }
    return false;
}

static void free_line(line *l)
{
    CLX_FREE(l->x, l->y, l->low, l->high);
    *l = (line){0};
}

static void free_drawing(drawing *d)
{
    for (int32_t i = 0; i < d->n_line; ++i) {
        free_line(&d->lines[i]);
    }
    *d = (drawing){0};
}

static clast_status allocate(line *l, int64_t n)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&l->x, n, sizeof *l->x));
    CLX_TRY(clx_alloc(&l->y, n, sizeof *l->y));
    CLX_TRY(clx_alloc(&l->low, n, sizeof *l->low));
    CLX_TRY(clx_alloc(&l->high, n, sizeof *l->high));
done:
    return status;
}

/// Keeps about MAX_POINT of the points, evenly, the first and the last among them.
static void thin(line *l)
{
    const int64_t n = l->n;
    if (n <= MAX_POINT) {
        return;
    }
    for (int64_t k = 0; k < MAX_POINT; ++k) {
        const int64_t i = k * (n - 1) / (MAX_POINT - 1);
        l->x[k] = l->x[i];
        l->y[k] = l->y[i];
        l->low[k] = l->low[i];
        l->high[k] = l->high[i];
    }
    l->n = MAX_POINT;
}

typedef struct {
    double x, y;
} pair;

CLX_RISING_BY_TWO(by_x, pair, x, y)

/// Mean and one standard deviation to either side of pairs of equal x; of what has no negative
/// values the band begins at 0.
static void add_group(const pair *p, int64_t n, line *l)
{
    double mean = 0.0;
    double square = 0.0;
    for (int64_t i = 0; i < n; ++i) {
        mean += p[i].y / (double)n;
    }
    for (int64_t i = 0; i < n; ++i) {
        square += (p[i].y - mean) * (p[i].y - mean);
    }
    const double deviation = n > 1 ? sqrt(square / (double)(n - 1)) : 0.0;
    l->x[l->n] = p[0].x;
    l->y[l->n] = mean;
    l->low[l->n] = mean >= 0.0 ? fmax(mean - deviation, 0.0) : mean - deviation;
    l->high[l->n++] = mean + deviation;
    l->has_band = l->has_band || n > 1;
}

/// The line through the means of y at each x up to `last`.
static clast_status mean_line(const double *x, const double *y, int64_t n_row, double last,
                              line *out)
{
    clast_status status = CLAST_OK;
    line l = {0};
    pair *p = NULL;
    int64_t n = 0;
    CLX_TRY(clx_alloc(&p, n_row, sizeof *p));
    CLX_TRY(allocate(&l, n_row));
    for (int64_t i = 0; i < n_row; ++i) {
        if (isfinite(x[i]) && isfinite(y[i]) && x[i] <= last) {
            p[n++] = (pair){x[i], y[i]};
        }
    }
    qsort(p, (size_t)n, sizeof *p, by_x);
    for (int64_t i = 0; i < n;) {
        int64_t end = i + 1;
        while (end < n && p[end].x == p[i].x) {
            ++end;
        }
        add_group(p + i, end - i, &l);
        i = end;
    }
    thin(&l);
    *out = l;
    l = (line){0};
done:
    free_line(&l);
    clx_free(p);
    return status;
}

/// "porosity_sphere_rays" -> "sphere rays"; "" for a chart of one column.
static void label_of(clast_aggregate_chart chart, const char *column, char label[LABEL_SIZE])
{
    const size_t skip = strlen(kinds[chart].column);
    label[0] = '\0';
    if (strlen(column) > skip) {
        (void)snprintf(label, LABEL_SIZE, "%s", column + skip);
    }
    for (char *c = label; *c != '\0'; ++c) {
        *c = *c == '_' ? ' ' : *c;
    }
}

static clast_status lines_of_table(clast_aggregate_chart chart, const clast_table *table,
                                   drawing *d)
{
    clast_status status = CLAST_OK;
    const double *x = clast_table_numbers(table, x_column(chart));
    int32_t n_repeat = 0;
    for (int32_t c = 0; c < table->n_column && d->n_line < MAX_SERIES; ++c) {
        const clast_column *column = &table->column[c];
        if (!is_wanted(chart, column) || count_finite(x, column->number, table->n_row) < 2) {
            continue;
        }
        const double last =
            chart == CLAST_AGGREGATE_CHART_RADIAL
                ? HUGE_VAL
                : (double)clx_history_common(x, column->number, table->n_row, &n_repeat);
        line *l = &d->lines[d->n_line];
        CLX_TRY(mean_line(x, column->number, table->n_row, last, l));
        ++d->n_line;
        l->is_step = chart == CLAST_AGGREGATE_CHART_RADIAL;
        label_of(chart, column->name, l->label);
    }
done:
    return status;
}

/// Share of the placed grains that are finer; the core (n = 0) is no grain of the list.
static clast_status placed_line(const clast_table *history, line *out)
{
    clast_status status = CLAST_OK;
    const double *size = clast_table_numbers(history, "size_m");
    const double *place = clast_table_numbers(history, "n");
    line l = {.label = "placed", .is_step = true};
    CLX_TRY(allocate(&l, history->n_row));
    for (int64_t i = 0; i < history->n_row; ++i) {
        if (isfinite(size[i]) && (place == NULL || place[i] > 0.0)) {
            l.x[l.n++] = size[i];
        }
    }
    CLX_TRY(clx_sort_doubles(l.x, l.n));
    for (int64_t i = 0; i < l.n; ++i) {
        l.y[i] = (double)(i + 1) / (double)l.n;
    }
    thin(&l);
    *out = l;
    l = (line){0};
done:
    free_line(&l);
    return status;
}

/// A size, or a bin of sizes, and how many grains of it are wanted.
typedef struct {
    double low, high, count;
} size_bin;

CLX_RISING_BY_TWO(by_bin, size_bin, low, high)

/// Share of the wanted grains that are finer, straight within each bin; a list comes in any order.
static clast_status wanted_line(const clast_table *wanted, line *out)
{
    clast_status status = CLAST_OK;
    const double *low = clast_table_numbers(wanted, "low_m");
    const double *high = clast_table_numbers(wanted, "high_m");
    const double *count =
        clast_table_numbers(wanted, clast_table_find(wanted, "wanted") >= 0 ? "wanted" : "count");
    double total = 0.0;
    double sum = 0.0;
    size_bin *bins = NULL;
    line l = {.label = "wanted"};
    CLX_CHECK(low != NULL && high != NULL && count != NULL, CLAST_E_FORMAT,
              "table %s: wanted sizes need the columns low_m, high_m and count (or wanted)",
              wanted->name);
    CLX_TRY(allocate(&l, 2 * wanted->n_row));
    CLX_TRY(clx_alloc(&bins, wanted->n_row, sizeof *bins));
    for (int64_t i = 0; i < wanted->n_row; ++i) {
        bins[i] = (size_bin){low[i], high[i], count[i]};
        total += count[i];
    }
    qsort(bins, (size_t)wanted->n_row, sizeof *bins, by_bin);
    for (int64_t i = 0; i < wanted->n_row && total > 0.0; ++i) {
        l.x[l.n] = bins[i].low;
        l.y[l.n++] = sum / total;
        sum += bins[i].count;
        l.x[l.n] = bins[i].high;
        l.y[l.n++] = sum / total;
    }
    thin(&l);
    *out = l;
    l = (line){0};
done:
    clx_free(bins);
    free_line(&l);
    return status;
}

static clast_status size_lines(const clast_table *history, const clast_table *wanted, drawing *d)
{
    clast_status status = CLAST_OK;
    CLX_TRY(placed_line(history, &d->lines[0]));
    d->n_line = 1;
    if (wanted != NULL) {
        CLX_TRY(wanted_line(wanted, &d->lines[1]));
        d->n_line = 2;
    }
done:
    return status;
}

/// Multiplies lengths into the unit that gives readable numbers; its name.
static const char *scale_lengths(drawing *d, bool of_x)
{
    static const struct {
        double factor;
        const char *name;
    } units[] = {{1e9, "nm"}, {1e6, "\302\265m"}, {1e3, "mm"}, {1.0, "m"}};
    double most = 0.0;
    for (int32_t i = 0; i < d->n_line; ++i) {
        for (int64_t k = 0; k < d->lines[i].n; ++k) {
            most = fmax(most, of_x ? d->lines[i].x[k] : d->lines[i].y[k]);
        }
    }
    const int unit = most < 1e-6 ? 0 : most < 1e-3 ? 1 : most < 1.0 ? 2 : 3;
    for (int32_t i = 0; i < d->n_line; ++i) {
        for (int64_t k = 0; k < d->lines[i].n; ++k) {
            line *l = &d->lines[i];
            l->x[k] *= of_x ? units[unit].factor : 1.0;
            l->y[k] *= of_x ? 1.0 : units[unit].factor;
            l->low[k] *= of_x ? 1.0 : units[unit].factor;
            l->high[k] *= of_x ? 1.0 : units[unit].factor;
        }
    }
    return units[unit].name;
}

static void label_axes(clast_aggregate_chart chart, drawing *d)
{
    const bool of_x = chart == CLAST_AGGREGATE_CHART_SIZES || chart == CLAST_AGGREGATE_CHART_RADIAL;
    (void)snprintf(d->x_label, sizeof d->x_label, "%s", kinds[chart].x);
    (void)snprintf(d->y_label, sizeof d->y_label, "%s", kinds[chart].y);
    if (of_x) {
        (void)snprintf(d->x_label, sizeof d->x_label, "%s (%s)", kinds[chart].x,
                       scale_lengths(d, true));
    } else if (chart == CLAST_AGGREGATE_CHART_DIAMETER) {
        (void)snprintf(d->y_label, sizeof d->y_label, "%s (%s)", kinds[chart].y,
                       scale_lengths(d, false));
    }
}

/// Bands first, so that every line lies above them.
static void make_series(drawing *d)
{
    for (int32_t i = 0; i < d->n_line; ++i) {
        const line *l = &d->lines[i];
        if (l->has_band) {
            d->series[d->n_series++] = clx_band(i == 0 ? "\302\261 1 s.d. of the repeats" : NULL,
                                                l->x, l->low, l->high, l->n, i % 8);
        }
    }
    for (int32_t i = 0; i < d->n_line; ++i) {
        const line *l = &d->lines[i];
        d->series[d->n_series++] =
            (clast_series){.kind = l->is_step ? CLAST_SERIES_STEP : CLAST_SERIES_LINE,
                           .label = l->label[0] != '\0' ? l->label : NULL,
                           .x = l->x,
                           .y = l->y,
                           .n = l->n,
                           .colour = i % 8,
                           .dashed = strcmp(l->label, "wanted") == 0};
    }
}

static clast_status draw(clast_aggregate_chart chart, const clast_table *table,
                         const clast_table *wanted, drawing *d)
{
    clast_status status = CLAST_OK;
    CLX_CHECK((unsigned)chart < CLAST_N_AGGREGATE_CHART, CLAST_E_ARGUMENT, "there is no chart %d",
              (int)chart);
    CLX_CHECK(clast_aggregate_chart_fits(chart, table), CLAST_E_FORMAT,
              "table %s: the chart '%s' needs two rows with numbers in the columns %s and %s%s",
              table->name, kinds[chart].name, x_column(chart), kinds[chart].column,
              chart == CLAST_AGGREGATE_CHART_POROSITY ? "..." : "");
    CLX_TRY(chart == CLAST_AGGREGATE_CHART_SIZES ? size_lines(table, wanted, d)
                                                 : lines_of_table(chart, table, d));
    label_axes(chart, d);
    make_series(d);
    d->chart = (clast_chart){.title = kinds[chart].title,
                             .x = {.label = d->x_label},
                             .y = {.label = d->y_label},
                             .series = d->series,
                             .n_series = d->n_series};
done:
    return status;
}

clast_status clast_aggregate_chart_write(clast_aggregate_chart chart, const clast_table *table,
                                         const clast_table *wanted, const char *path)
{
    CLX_ARGUMENTS(table, path);
    CLX_WHOLE(table, table);
    if (wanted != NULL) {
        CLX_WHOLE(table, wanted);
    }
    drawing d = {0};
    clast_status status = draw(chart, table, wanted, &d);
    if (status == CLAST_OK) {
        status = clast_chart_write(&d.chart, path);
    }
    free_drawing(&d);
    return status;
}

clast_status clast_aggregate_chart_svg(clast_aggregate_chart chart, const clast_table *table,
                                       const clast_table *wanted, unsigned char **bytes, size_t *n)
{
    CLX_ARGUMENTS(table, bytes, n);
    CLX_WHOLE(table, table);
    if (wanted != NULL) {
        CLX_WHOLE(table, wanted);
    }
    drawing d = {0};
    clast_status status = draw(chart, table, wanted, &d);
    if (status == CLAST_OK) {
        d.chart.title = NULL; // the page has it as text
        status = clast_chart_svg(&d.chart, bytes, n);
    }
    free_drawing(&d);
    return status;
}

clast_status clast_aggregate_charts_write(const clast_table *history, const clast_table *wanted,
                                          const char *folder)
{
    CLX_ARGUMENTS(history, folder);
    CLX_WHOLE(table, history);
    if (wanted != NULL) {
        CLX_WHOLE(table, wanted);
    }
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    for (int32_t k = 0; k < CLAST_AGGREGATE_CHART_RADIAL; ++k) {
        const clast_aggregate_chart chart = (clast_aggregate_chart)k;
        const int length =
            snprintf(path, sizeof path, "%s/%s.svg", folder, clast_aggregate_chart_name(chart));
        CLX_CHECK(length < (int)sizeof path, CLAST_E_DISK,
                  "the path of folder %.40s... is too long", folder);
        if (clast_aggregate_chart_fits(chart, history)) {
            CLX_TRY(clast_aggregate_chart_write(
                chart, history, chart == CLAST_AGGREGATE_CHART_SIZES ? wanted : NULL, path));
        }
    }
done:
    return status;
}
