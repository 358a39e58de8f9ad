// Charts of a decomposition: points and cells, densities of bins, scores of thresholds, events.
#include <clast/chart.h>

#include "base/alloc.h"
#include "base/status.h"
#include "cloud/contract.h"
#include "cloud/whole.h"
#include "math/sort.h"
#include "plot/series.h"
#include <clast/cloud.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LABEL_SIZE = 64 };
enum { MOST_POINTS = 20000, N_GROUP = 4, MAX_PASS_DRAWN = 6, CORNERS = 6 };

const char *clast_decompose_chart_name(clast_decompose_chart chart,
                                       const clast_decomposition *result)
{
    static const char *const name[CLAST_N_DECOMPOSE_CHART] = {"points", "density", "score",
                                                              "events"};
    if (chart == CLAST_DECOMPOSE_CHART_EVENTS && result != NULL && result->beta_dt == 0.0) {
        return "pair_integral";
    }
    return (unsigned)chart < CLAST_N_DECOMPOSE_CHART ? name[chart] : "unknown";
}

bool clast_decompose_chart_fits(clast_decompose_chart chart, const clast_decomposition *result)
{
    if (clx_decomposition_fault(result) != NULL) {
        return false;
    }
    if (chart == CLAST_DECOMPOSE_CHART_POINTS) {
        return result->n > 0 && result->dimension > 1;
    }
    if (chart == CLAST_DECOMPOSE_CHART_CDF) {
        return result->cells.bin_count != NULL;
    }
    return chart == CLAST_DECOMPOSE_CHART_SCORE ? result->search.n_row > 0 : result->cells.n > 1;
}

/// Ambient, cluster, under, void.
static int group_of(uint8_t label)
{
    return label == 0 ? 0 : label <= 5 ? 1 : label == 6 ? 2 : 3;
}

/// Points of one group of labels as a series; x and y hold n_most numbers each.
static clast_series points_of(const clast_cloud *cloud, const clast_cells *cells, int group,
                              double *x, double *y)
{
    CLAST_ASSERT(group >= 0);
    static const char *const legend[N_GROUP] = {"ambient", "cluster", "under", "void"};
    static const int32_t colour[N_GROUP] = {0, 1, 4, 2};
    const int64_t stride = cloud->n / MOST_POINTS + 1;
    int64_t n = 0;
    for (int64_t i = 0; i < cloud->n; i += stride) {
        const int32_t c = cells->of_point[i];
        if (c >= 0 && group_of(cells->label[c]) == group) {
            x[n] = cloud->x[i * cloud->dimension];
            y[n++] = cloud->x[i * cloud->dimension + 1];
        }
    }
    return clx_series(CLAST_SERIES_POINTS, legend[group], x, y, n, colour[group]);
}

/// Points coloured by the density of their cell, where cells have no labels; x, y and value hold
/// n_most numbers each.
static clast_series points_by_density(const clast_cloud *cloud, const clast_cells *cells, double *x,
                                      double *y, double *value)
{
    const int64_t stride = cloud->n / MOST_POINTS + 1;
    int64_t n = 0;
    for (int64_t i = 0; i < cloud->n; i += stride) {
        const int32_t c = cells->of_point[i];
        if (c >= 0) {
            x[n] = cloud->x[i * cloud->dimension];
            y[n] = cloud->x[i * cloud->dimension + 1];
            value[n++] = cells->weight[c] / cells->volume[c];
        }
    }
    return (clast_series){
        .kind = CLAST_SERIES_POINTS, .x = x, .y = y, .value = cells->n > 1 ? value : NULL, .n = n};
}

/// Edges of all cells as one broken line of 2-D boxes.
static int64_t outline(const clast_cells *cells, double *x, double *y)
{
    int64_t n = 0;
    for (int32_t c = 0; c < cells->n; ++c) {
        const double *low = cells->low[c];
        const double *high = cells->high[c];
        const double cx[CORNERS] = {low[0], high[0], high[0], low[0], low[0], (double)NAN};
        const double cy[CORNERS] = {low[1], low[1], high[1], high[1], low[1], (double)NAN};
        memcpy(x + n, cx, sizeof cx);
        memcpy(y + n, cy, sizeof cy);
        n += CORNERS;
    }
    return n;
}

static clast_status draw_points(const clast_cloud *cloud, const clast_decomposition *r,
                                const char *path)
{
    clast_status status = CLAST_OK;
    const bool has_edges = r->dimension == 2 && r->cells.n > 1 && r->cells.is_box;
    const int64_t n_edge = has_edges ? (int64_t)CORNERS * r->cells.n : 0;
    const int64_t n_most = cloud->n < MOST_POINTS + 1 ? cloud->n : MOST_POINTS + 1;
    clast_series series[N_GROUP + 1];
    int32_t n_series = 0;
    double *buffer = NULL;
    CLX_TRY(clx_alloc(&buffer, 2 * (N_GROUP * n_most + n_edge), sizeof *buffer));
    if (has_edges) {
        double *x = buffer + (int64_t)2 * N_GROUP * n_most;
        series[n_series++] = clx_series(CLAST_SERIES_LINE, "cells", x, x + n_edge,
                                        outline(&r->cells, x, x + n_edge), -1);
    }
    const bool has_labels = clast_cells_are_labelled(&r->cells);
    if (!has_labels) {
        series[n_series++] =
            points_by_density(cloud, &r->cells, buffer, buffer + n_most, buffer + 2 * n_most);
    }
    for (int group = 0; group < N_GROUP && has_labels; ++group) {
        double *x = buffer + 2 * group * n_most;
        series[n_series] = points_of(cloud, &r->cells, group, x, x + n_most);
        n_series += series[n_series].n > 0 ? 1 : 0;
    }
    char label[LABEL_SIZE];
    (void)snprintf(label, sizeof label, "density of the cell (1/m^%d)", r->dimension);
    // one density has no scale of colours
    const bool is_coloured = !has_labels && r->cells.n > 1;
    const clast_chart chart = {.x = {.label = "x (m)"},
                               .y = {.label = "y (m)"},
                               .value_axis = {.label = is_coloured ? label : NULL, .log = true},
                               .series = series,
                               .n_series = n_series,
                               .equal = true};
    CLX_TRY(clast_chart_write(&chart, path));
done:
    clx_free(buffer);
    return status;
}

/// Distribution of densities of all bins, and the thresholds that the passes chose.
static clast_status draw_density(const clast_decomposition *r, const char *path)
{
    clast_status status = CLAST_OK;
    const clast_cells *cells = &r->cells;
    const int64_t n_bin = (int64_t)cells->nb[0] * cells->nb[1] * cells->nb[2];
    double *buffer = NULL;
    double *sorted = NULL;
    double line[2 * MAX_PASS_DRAWN][4];
    clast_series series[2 * MAX_PASS_DRAWN + 1];
    int32_t n_series = 0;
    int64_t n = 0;
    CLX_TRY(clx_alloc(&sorted, n_bin, sizeof *sorted));
    CLX_TRY(clx_alloc(&buffer, 2 * (n_bin + 1), sizeof *buffer));
    double *x = buffer;
    double *y = buffer + n_bin + 1;
    for (int64_t b = 0; b < n_bin; ++b) {
        sorted[b] = (double)cells->bin_count[b] * (double)n_bin / (double)r->n_test;
    }
    CLX_TRY(clx_sort_doubles(sorted, n_bin));
    for (int64_t b = 0; b < n_bin; ++b) { // one step for each distinct density
        if (b + 1 == n_bin || sorted[b + 1] > sorted[b]) {
            x[n] = sorted[b];
            y[n++] = (double)(b + 1) / (double)n_bin;
        }
    }
    series[n_series++] = clx_series(CLAST_SERIES_STEP, "share of bins", x, y, n, 0);
    for (int32_t k = 0; k < 2 * r->n_pass && k < 2 * MAX_PASS_DRAWN; ++k) {
        const bool is_lower = k % 2 == 1;
        static const char *const legend[2] = {"threshold", "lower threshold"};
        line[k][0] = line[k][1] = is_lower ? r->pass[k / 2].lower : r->pass[k / 2].lambda;
        line[k][2] = 0.0;
        line[k][3] = 1.0;
        series[n_series++] = (clast_series){.kind = CLAST_SERIES_LINE,
                                            .label = k < 2 ? legend[k] : NULL,
                                            .x = &line[k][0],
                                            .y = &line[k][2],
                                            .n = 2,
                                            .colour = is_lower ? 4 : 1,
                                            .dashed = k > 1};
    }
    const clast_chart chart = {.x = {.label = "density over the mean (-)"},
                               .y = {.label = "reduced cdf (-)"},
                               .series = series,
                               .n_series = n_series};
    CLX_TRY(clast_chart_write(&chart, path));
done:
    CLX_FREE(sorted, buffer);
    return status;
}

/// Ratios of one search as a line with points; returns the row behind it.
static int64_t search_series(const clast_table *search, const double *ratio, int64_t begin,
                             clast_series series[2])
{
    static const char *const legend[2][MAX_PASS_DRAWN] = {
        {"pass 1", "pass 2", "pass 3", "pass 4", "pass 5", "pass 6"},
        {"pass 1, lower", "pass 2, lower", "pass 3, lower", "pass 4, lower", "pass 5, lower",
         "pass 6, lower"}};
    const double *pass = clast_table_numbers(search, "pass");
    const double *is_lower = clast_table_numbers(search, "is_lower_search");
    const double *lambda = clast_table_numbers(search, "lambda");
    const double *x = is_lower[begin] > 0.0 ? clast_table_numbers(search, "lower") : lambda;
    const int k = (int)pass[begin] - 1;
    int64_t end = begin;
    while (end < search->n_row && pass[end] == pass[begin] && is_lower[end] == is_lower[begin] &&
           (is_lower[end] == 0.0 || lambda[end] == lambda[begin])) {
        ++end;
    }
    series[0] = (clast_series){.kind = CLAST_SERIES_LINE,
                               .label = legend[is_lower[begin] > 0.0 ? 1 : 0][k],
                               .x = x + begin,
                               .y = ratio + begin,
                               .n = end - begin,
                               .colour = k,
                               .dashed = is_lower[begin] > 0.0};
    series[1] = series[0];
    series[1].label = NULL;
    series[1].kind = CLAST_SERIES_POINTS;
    return end;
}

static clast_status draw_score(const clast_decomposition *r, const char *path)
{
    static const double one = 1.0;
    static const char *const mark = "ideal";
    clast_status status = CLAST_OK;
    const double *pass = clast_table_numbers(&r->search, "pass");
    const double *score = clast_table_numbers(&r->search, "score");
    const double *ideal = clast_table_numbers(&r->search, "ideal_score");
    const double *is_lower = clast_table_numbers(&r->search, "is_lower_search");
    const double *lambda = clast_table_numbers(&r->search, "lambda");
    clast_series series[4 * MAX_PASS_DRAWN + 2]; // and one that is not kept
    int32_t n_series = 0;
    double *ratio = NULL;
    double most = one;
    CLX_TRY(clx_alloc(&ratio, r->search.n_row, sizeof *ratio));
    for (int64_t i = 0; i < r->search.n_row; ++i) {
        ratio[i] = score[i] / ideal[i];
        most = fmax(most, ratio[i]);
    }
    for (int64_t begin = 0; begin < r->search.n_row && pass[begin] <= MAX_PASS_DRAWN;) {
        // of a joint search, the lower thresholds beside the upper one that was chosen
        const bool is_drawn =
            is_lower[begin] == 0.0 || lambda[begin] == r->pass[(int)pass[begin] - 1].lambda;
        begin = search_series(&r->search, ratio, begin, &series[n_series]);
        n_series += is_drawn ? 2 : 0;
    }
    const clast_chart chart = {.x = {.label = "threshold: density over the mean (-)"},
                               .y = {.label = "expected score over the ideal (-)",
                                     .high = 1.1 * most}, // room for the mark's word
                               .series = series,
                               .n_series = n_series,
                               .mark_y = &one,
                               .mark_label = &mark,
                               .n_mark = 1};
    CLX_TRY(clast_chart_write(&chart, path));
done:
    clx_free(ratio);
    return status;
}

/// Events of each cell over its count, beside the cap n/2.
static clast_status draw_events(const clast_decomposition *r, const char *path)
{
    clast_status status = CLAST_OK;
    double *x = NULL;
    double most = 1.0;
    const int64_t n = r->cells.n;
    CLX_TRY(clx_alloc(&x, n, sizeof *x));
    for (int64_t c = 0; c < n; ++c) {
        x[c] = r->cells.weight[c]; // real particles
        most = fmax(most, x[c]);
    }
    const double cap_x[2] = {0.0, most};
    const double cap_y[2] = {0.0, 0.5 * most};
    const clast_series series[2] = {
        clx_series(CLAST_SERIES_POINTS, "cells", x, r->cells.events, n, 0),
        clx_dashed_line("cap n/2", cap_x, cap_y, r->n_capped > 0 ? 2 : 0, 1)};
    char label[LABEL_SIZE] = "events of a cell (-)";
    if (r->beta_dt == 0.0) {
        (void)snprintf(label, sizeof label, "pair integral of a cell (1/m^%d)", r->dimension);
    }
    const clast_chart chart = {.title =
                                   r->beta_dt == 0.0 ? "Pair integral by cells" : "Events by cells",
                               .x = {.label = "particles of a cell (-)"},
                               .y = {.label = label},
                               .series = series,
                               .n_series = r->n_capped > 0 ? 2 : 1};
    CLX_TRY(clast_chart_write(&chart, path));
done:
    clx_free(x);
    return status;
}

clast_status clast_decompose_chart_write(clast_decompose_chart chart, const clast_cloud *cloud,
                                         const clast_decomposition *result, const char *path)
{
    CLX_ARGUMENTS(cloud, result, path);
    CLX_GUARD(clx_cloud_check(cloud));
    CLX_WHOLE(decomposition, result);
    const bool is_whole = result->n + result->n_outside == cloud->n;
    if ((chart == CLAST_DECOMPOSE_CHART_POINTS && !is_whole) ||
        result->dimension != cloud->dimension) {
        return clx_fail(CLAST_E_ARGUMENT, "%s: the decomposition is not of this cloud", __func__);
    }
    if (!clast_decompose_chart_fits(chart, result)) {
        return clx_fail(CLAST_E_USAGE, "there is nothing to draw in chart %s",
                        clast_decompose_chart_name(chart, result));
    }
    switch (chart) {
    case CLAST_DECOMPOSE_CHART_POINTS:
        return draw_points(cloud, result, path);
    case CLAST_DECOMPOSE_CHART_CDF:
        return draw_density(result, path);
    case CLAST_DECOMPOSE_CHART_SCORE:
        return draw_score(result, path);
    default:
        return draw_events(result, path);
    }
}
