// Charts: measures, draws and writes one figure.
#include <clast/chart.h>

#include "base/alloc.h"
#include "base/file.h"
#include "base/status.h"
#include "plot/figure.h"

static void draw_marks(clx_figure *f)
{
    static const double right[2] = {1.0, 0.0};
    const double dash[2] = {2.0, 2.0};
    cairo_t *cr = f->canvas->cr;
    for (int32_t i = 0; i < f->chart->n_mark; ++i) {
        const double y = clx_figure_y(f, f->chart->mark_y[i]);
        cairo_set_source_rgb(cr, 0.35, 0.35, 0.35);
        cairo_set_dash(cr, dash, 2, 0.0);
        cairo_set_line_width(cr, 0.9);
        clx_canvas_line(f->canvas, f->left, y, f->right, y);
        cairo_set_dash(cr, NULL, 0, 0.0);
        if (f->chart->mark_label != NULL && f->chart->mark_label[i] != NULL) {
            clx_canvas_text(f->canvas, f->right - 4.0, y - 3.0, right, CLX_FONT_TICK - 1.0,
                            f->chart->mark_label[i]);
        }
    }
}

static void draw_notes(clx_figure *f)
{
    static const double middle[2] = {0.5, 0.5};
    for (int32_t i = 0; i < f->chart->n_note; ++i) {
        const clast_note *note = &f->chart->note[i];
        const double x = clx_figure_x(f, note->x);
        const double y = clx_figure_y(f, note->y);
        const double width = clx_canvas_text_width(f->canvas, CLX_FONT_TICK, note->text) + 4.0;
        cairo_set_source_rgba(f->canvas->cr, 1.0, 1.0, 1.0, 0.8); // points may lie below
        cairo_rectangle(f->canvas->cr, x - 0.5 * width, y - 7.0, width, 14.0);
        cairo_fill(f->canvas->cr);
        cairo_set_source_rgb(f->canvas->cr, 0.3, 0.3, 0.3);
        clx_canvas_text(f->canvas, x, y, middle, CLX_FONT_TICK, note->text);
    }
}

/// Nothing is drawn further than `beyond` points from the plotting area.
static void clip(const clx_figure *f, double beyond)
{
    cairo_reset_clip(f->canvas->cr);
    cairo_rectangle(f->canvas->cr, f->left - beyond, f->top - beyond,
                    f->right - f->left + 2.0 * beyond, f->bottom - f->top + 2.0 * beyond);
    cairo_clip(f->canvas->cr);
}

static void draw(clx_figure *f)
{
    cairo_t *cr = f->canvas->cr;
    clx_figure_lay_out(f);
    clx_figure_grid(f);
    cairo_save(cr);
    clip(f, 0.0);
    if (f->chart->heat != NULL && f->has_value) {
        clx_figure_heat(f);
    }
    for (int32_t i = 0; i < f->chart->n_series; ++i) { // a point on the frame is shown whole
        clip(f, f->chart->series[i].kind == CLAST_SERIES_POINTS ? CLX_POINT_REACH : 0.0);
        clx_figure_series(f, &f->chart->series[i]);
    }
    clip(f, 0.0);
    draw_marks(f);
    draw_notes(f);
    cairo_restore(cr);
    clx_figure_frame(f);
    if (f->has_value) {
        clx_figure_value_bar(f);
    }
    (void)clx_figure_legend(f, true);
}

static const char *series_fault(const clast_series *s)
{
    if ((unsigned)s->kind > CLAST_SERIES_BARS || s->n < 0) {
        return "a series' kind or number of points cannot be";
    }
    const bool is_band = s->kind == CLAST_SERIES_BAND;
    return s->n > 0 && (s->x == NULL || (s->y == NULL && !is_band) ||
                        (is_band && (s->low == NULL || s->high == NULL)))
               ? "a series has no x, y, low or high"
               : NULL;
}

/// What is wrong with a chart that a caller has filled himself, for people, or NULL.
static const char *chart_fault(const clast_chart *chart)
{
    const clast_heat *heat = chart->heat;
    const char *fault = NULL;
    if (!clx_has_array(chart->series, chart->n_series) ||
        !clx_has_array(chart->note, chart->n_note) ||
        !clx_has_array(chart->mark_y, chart->n_mark)) {
        return "a count is negative, or series, notes or marks are NULL";
    }
    if (heat != NULL && (heat->n_x < 0 || heat->n_y < 0 ||
                         !clx_has_array(heat->value, (int64_t)heat->n_x * heat->n_y))) {
        return "its heat map has no values";
    }
    for (int32_t i = 0; fault == NULL && i < chart->n_series; ++i) {
        fault = series_fault(&chart->series[i]);
    }
    for (int32_t i = 0; fault == NULL && i < chart->n_note; ++i) {
        fault = chart->note[i].text == NULL ? "a note has no text" : NULL;
    }
    for (int32_t i = 0; fault == NULL && heat != NULL && heat->x_name != NULL && i < heat->n_x;
         ++i) {
        fault = heat->x_name[i] == NULL ? "a column of its heat map has no name" : NULL;
    }
    for (int32_t i = 0; fault == NULL && heat != NULL && heat->y_name != NULL && i < heat->n_y;
         ++i) {
        fault = heat->y_name[i] == NULL ? "a row of its heat map has no name" : NULL;
    }
    return fault != NULL || (chart->width <= 14400.0 && chart->height <= 14400.0)
               ? fault
               : "it is wider or higher than 14400 points (5 m)";
}

static clast_status draw_to(const clast_chart *chart, clx_canvas_format format, clx_canvas *canvas)
{
    clast_status status = CLAST_OK;
    clx_figure f = {.canvas = canvas, .chart = chart};
    CLX_TRY(clx_fault_given("clast_chart", "chart", chart_fault(chart)));
    CLX_TRY(clx_figure_measure(&f));
    CLX_TRY(clx_canvas_begin(canvas, format, chart->width > 0.0 ? chart->width : 480.0,
                             chart->height > 0.0 ? chart->height : 340.0));
    draw(&f);
    CLX_TRY(clx_canvas_finish(canvas));
done:
    return status;
}

clast_status clast_chart_write(const clast_chart *chart, const char *path)
{
    CLX_ARGUMENTS(chart, path);
    clast_status status = CLAST_OK;
    clx_canvas canvas = {0};
    clx_canvas_format format = CLX_CANVAS_SVG;
    CLX_TRY(clx_canvas_format_of(path, &format));
    CLX_TRY(draw_to(chart, format, &canvas));
    CLX_TRY(clx_file_write_all(path, canvas.bytes, (size_t)canvas.n));
done:
    clx_canvas_free(&canvas);
    return status;
}

clast_status clast_chart_svg(const clast_chart *chart, unsigned char **bytes, size_t *n)
{
    CLX_ARGUMENTS(chart, bytes, n);
    clx_canvas canvas = {0};
    const clast_status status = draw_to(chart, CLX_CANVAS_SVG, &canvas);
    if (status == CLAST_OK) {
        *bytes = canvas.bytes;
        *n = (size_t)canvas.n;
        canvas.bytes = NULL;
    }
    clx_canvas_free(&canvas);
    return status;
}

void clast_chart_bytes_free(unsigned char *bytes)
{
    clx_free(bytes);
}
