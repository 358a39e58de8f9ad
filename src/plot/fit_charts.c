// Charts of a fitted porosity model.
#include <clast/chart.h>

#include "base/alloc.h"
#include "base/number.h"
#include "base/status.h"
#include "math/least_squares.h"
#include "plot/series.h"
#include "porosity/whole.h"
#include <clast/porosity_model.h>
#include <clast/table.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LABEL_SIZE = 160 };

const char *clast_fit_chart_name(clast_fit_chart chart)
{
    static const char *const name[CLAST_N_FIT_CHART] = {"feature", "predicted", "residuals",
                                                        "leverage"};
    return (unsigned)chart < CLAST_N_FIT_CHART ? name[chart] : "unknown";
}

static void bounds(const double *x, int64_t n, double span[2])
{
    for (int64_t i = 0; i < n; ++i) {
        span[0] = fmin(span[0], x[i]);
        span[1] = fmax(span[1], x[i]);
    }
}

/// Porosity over the model's first feature with the line through these alone.
static clast_status draw_feature(const clast_fit_data *data, const clast_porosity_fit *fit,
                                 const char *path)
{
    clast_status status = CLAST_OK;
    clx_least_squares ls = {0};
    double *design = NULL;
    const int64_t n = data->beds.n_row;
    const bool is_whole = fit->model.n_term > 0 && data->beds.n_column > 1;
    const char *name = is_whole ? fit->model.term[0].feature : "";
    const double *x = clast_table_numbers(&data->beds, name);
    const double *y = is_whole ? data->beds.column[1].number : NULL;
    double span[2] = {INFINITY, -INFINITY};
    char label[LABEL_SIZE];
    char axis[LABEL_SIZE];
    CLX_CHECK(x != NULL && y != NULL, CLAST_E_FORMAT, "no feature '%s' among the beds", name);
    CLX_TRY(clx_alloc(&design, 2 * n, sizeof *design));
    for (int64_t i = 0; i < n; ++i) {
        design[2 * i] = 1.0;
        design[2 * i + 1] = x[i];
    }
    CLX_TRY(clx_least_squares_fit(&(clx_regression){design, y, n, 2}, &ls));
    bounds(x, n, span);
    const double line[2] = {ls.b[0] + ls.b[1] * span[0], ls.b[0] + ls.b[1] * span[1]};
    const double r = copysign(sqrt(fmax(ls.r2, 0.0)), ls.b[1]);
    (void)clx_number_print(label, sizeof label, "%.4g %s %.4g %s (r = %.3f)", ls.b[0],
                           ls.b[1] < 0.0 ? "\342\210\222" : "+", fabs(ls.b[1]), name, r);
    const char *unit = fit->model.term[0].unit; // of a table's column; "-": its name may have one
    (void)(unit != NULL && strcmp(unit, "-") == 0
               ? snprintf(axis, sizeof axis, "%s", name)
               : snprintf(axis, sizeof axis, "%s (%s)", name, unit != NULL ? unit : "-"));
    const clast_series series[2] = {clx_series(CLAST_SERIES_POINTS, "beds", x, y, n, 0),
                                    clx_series(CLAST_SERIES_LINE, label, span, line, 2, 1)};
    const clast_chart chart = {.title = "Porosity and the first feature",
                               .x = {.label = axis},
                               .y = {.label = "porosity (-)"},
                               .series = series,
                               .n_series = 2};
    CLX_TRY(clast_chart_write(&chart, path));
done:
    clx_least_squares_free(&ls);
    clx_free(design);
    return status;
}

static clast_status draw_predicted(const clast_porosity_fit *fit, const char *path)
{
    const clast_table *t = &fit->rows;
    const double *y = clast_table_numbers(t, "porosity");
    const double *fitted = clast_table_numbers(t, "fitted");
    const double *held_out = clast_table_numbers(t, "held_out");
    double span[2] = {INFINITY, -INFINITY};
    char title[LABEL_SIZE];
    bounds(y, t->n_row, span);
    bounds(fitted, t->n_row, span);
    bounds(held_out, t->n_row, span);
    const double pad = 0.05 * (span[1] - span[0]);
    span[0] -= pad;
    span[1] += pad;
    (void)clx_number_print(title, sizeof title, "R\302\262 = %.3f, held-out mean error %.2g",
                           fit->model.r2, fit->model.cv_mean_error);
    const clast_series series[3] = {
        clx_series(CLAST_SERIES_LINE, "equal", span, span, 2, 6),
        clx_series(CLAST_SERIES_POINTS, "fitted", y, fitted, t->n_row, 0),
        clx_series(CLAST_SERIES_POINTS, "held out", y, held_out, t->n_row, 4)};
    const clast_chart chart = {
        .title = title,
        .x = {.label = "measured porosity (-)", .low = span[0], .high = span[1]},
        .y = {.label = "predicted porosity (-)", .low = span[0], .high = span[1]},
        .series = series,
        .n_series = 3,
        .equal = true,
        .width = 400.0,
        .height = 430.0};
    return clast_chart_write(&chart, path);
}

static clast_status draw_residuals(const clast_porosity_fit *fit, bool is_leverage,
                                   const char *path)
{
    static const double marks[3] = {-2.0, 0.0, 2.0};
    const clast_table *t = &fit->rows;
    const double *studentised = clast_table_numbers(t, "studentised");
    const double *x = clast_table_numbers(t, is_leverage ? "leverage" : "fitted");
    const double twice = 2.0 * (fit->model.n_term + 1.0) / (double)fit->model.n_bed;
    double span[2] = {-2.5, 2.5};
    bounds(studentised, t->n_row, span);
    const double high_x[2] = {twice, twice};
    const double high_y[2] = {span[0], span[1]};
    const clast_series series[2] = {
        clx_series(CLAST_SERIES_POINTS, "beds", x, studentised, t->n_row, 0),
        clx_dashed_line("twice the mean leverage", high_x, high_y, 2, 1)};
    const clast_chart chart = {.title = is_leverage ? "Influence of single beds" : "Residuals",
                               .x = {.label = is_leverage ? "leverage (-)" : "fitted porosity (-)"},
                               .y = {.label = "studentised residual (-)"},
                               .series = series,
                               .n_series = is_leverage ? 2 : 1,
                               .mark_y = marks,
                               .n_mark = 3};
    return clast_chart_write(&chart, path);
}

clast_status clast_chart_fit(clast_fit_chart chart, const clast_fit_data *data,
                             const clast_porosity_fit *fit, const char *path)
{
    CLX_ARGUMENTS(data, fit, path);
    CLX_WHOLE(table, &data->beds);
    CLX_WHOLE(porosity_model, &fit->model);
    CLX_WHOLE(table, &fit->rows);
    switch (chart) {
    case CLAST_FIT_CHART_FEATURE:
        return draw_feature(data, fit, path);
    case CLAST_FIT_CHART_PREDICTED:
        return draw_predicted(fit, path);
    case CLAST_FIT_CHART_RESIDUALS:
        return draw_residuals(fit, false, path);
    case CLAST_FIT_CHART_LEVERAGE:
        return draw_residuals(fit, true, path);
    default:
        return clx_fail(CLAST_E_USAGE, "no fit chart number %d", (int)chart);
    }
}
