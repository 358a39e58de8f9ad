// How each kind of series is drawn.
#include "base/number.h"
#include "plot/figure.h"

#include "math/colour.h"
#include <math.h>

static bool is_there(const clast_series *e, int64_t i)
{
    return i >= 0 && i < e->n && isfinite(e->x[i]) && isfinite(e->y[i]);
}

/// A line; a value without neighbours, which a line does not show, is a dot.
static void draw_path(clx_figure *f, const clast_series *e)
{
    const double dash[2] = {5.0, 3.0};
    cairo_t *cr = f->canvas->cr;
    bool pen_down = false;
    for (int64_t i = 0; i < e->n; ++i) {
        if (!is_there(e, i)) {
            pen_down = false;
            continue;
        }
        const double x = clx_figure_x(f, e->x[i]);
        if (!is_there(e, i - 1) && !is_there(e, i + 1)) {
            cairo_new_sub_path(cr);
            cairo_arc(cr, x, clx_figure_y(f, e->y[i]), 0.8, 0.0, 2.0 * CLAST_PI);
            continue;
        }
        if (pen_down && e->kind == CLAST_SERIES_STEP) {
            cairo_line_to(cr, x, clx_figure_y(f, e->y[i - 1]));
        }
        (pen_down ? cairo_line_to : cairo_move_to)(cr, x, clx_figure_y(f, e->y[i]));
        pen_down = true;
    }
    cairo_set_dash(cr, dash, e->dashed ? 2 : 0, 0.0);
    cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_width(cr, e->width > 0.0 ? e->width : 1.6);
    cairo_stroke(cr);
    cairo_set_dash(cr, NULL, 0, 0.0);
}

static bool is_wide(const clast_series *e, int64_t i)
{
    return isfinite(e->x[i]) && isfinite(e->low[i]) && isfinite(e->high[i]);
}

/// A value that is missing at either side parts the band.
static void draw_band(clx_figure *f, const clast_series *e)
{
    cairo_t *cr = f->canvas->cr;
    int64_t end = 0;
    for (int64_t begin = 0; begin < e->n; begin = end + 1) {
        for (end = begin; end < e->n && is_wide(e, end); ++end) {
            cairo_line_to(cr, clx_figure_x(f, e->x[end]), clx_figure_y(f, e->high[end]));
        }
        for (int64_t i = end - 1; i >= begin; --i) {
            cairo_line_to(cr, clx_figure_x(f, e->x[i]), clx_figure_y(f, e->low[i]));
        }
        cairo_new_sub_path(cr);
    }
    cairo_fill(cr);
}

/// Height on the page, at most at the frame.
static double framed(const clx_figure *f, double value)
{
    return fmax(f->top, fmin(f->bottom, clx_figure_y(f, value)));
}

/// Whether a point's middle is in the plotting area, whose frame counts, whatever was rounded.
static bool is_shown(const clx_figure *f, double x, double y)
{
    const double slack = 1e-3;
    return x >= f->left - slack && x <= f->right + slack && y >= f->top - slack &&
           y <= f->bottom + slack;
}

/// The head of an arrow that leaves the plotting area; out: -1 at its top, 1 at its bottom.
static void draw_open_end(clx_figure *f, double x, double y, double out)
{
    clx_canvas_line(f->canvas, x, y, x - 2.5, y - 4.0 * out);
    clx_canvas_line(f->canvas, x, y, x + 2.5, y - 4.0 * out);
}

/// An error bar. One end alone is a bound: the bar goes on to the frame, as an arrow.
static void draw_error(clx_figure *f, double x, double low, double high)
{
    if (!isfinite(low) && !isfinite(high)) {
        return;
    }
    const double y0 = isfinite(low) ? framed(f, low) : f->bottom;
    const double y1 = isfinite(high) ? framed(f, high) : f->top;
    clx_canvas_line(f->canvas, x, y0, x, y1);
    if (!isfinite(high)) {
        draw_open_end(f, x, y1, -1.0);
    } else if (!isfinite(low)) {
        draw_open_end(f, x, y0, 1.0);
    }
}

static void draw_points(clx_figure *f, const clast_series *e)
{
    cairo_t *cr = f->canvas->cr;
    const double radius = e->n > 2000 ? 1.2 : e->n > 200 ? 2.0 : 3.0;
    cairo_set_line_width(cr, 1.0);
    for (int64_t i = 0; i < e->n; ++i) {
        if (!isfinite(e->x[i]) || !isfinite(e->y[i])) {
            continue;
        }
        const double x = clx_figure_x(f, e->x[i]);
        const double y = clx_figure_y(f, e->y[i]);
        if (!is_shown(f, x, y)) {
            continue;
        }
        if (e->value != NULL && f->has_value) {
            double rgb[3];
            clx_colour_sequence(clx_ticks_place(&f->value, e->value[i]), rgb);
            clx_canvas_colour(f->canvas, rgb, 1.0);
        }
        if (e->low != NULL && e->high != NULL) {
            draw_error(f, x, e->low[i], e->high[i]);
        }
        cairo_arc(cr, x, y, radius, 0.0, 2.0 * CLAST_PI);
        cairo_fill(cr);
    }
}

static void draw_bars(clx_figure *f, const clast_series *e)
{
    cairo_t *cr = f->canvas->cr;
    const double base = clx_figure_y(f, f->y.log ? f->y.low : fmax(0.0, f->y.low));
    for (int64_t i = 0; i < e->n; ++i) {
        const double x0 = clx_figure_x(f, e->x[i]);
        const double x1 = clx_figure_x(f, e->x[i + 1]);
        if (isfinite(e->y[i]) && isfinite(x0) && isfinite(x1)) {
            const double y = clx_figure_y(f, e->y[i]);
            cairo_rectangle(cr, x0, y, x1 - x0, base - y);
        }
    }
    cairo_fill_preserve(cr);
    cairo_set_source_rgb(cr, 1.0, 1.0, 1.0);
    cairo_set_line_width(cr, 0.6);
    cairo_stroke(cr);
}

/// Values in the cells, dark on light colours and light on dark ones.
static void write_cells(clx_figure *f)
{
    const clast_heat *h = f->chart->heat;
    static const double middle[2] = {0.5, 0.5};
    const double size = fmin(8.0, (f->right - f->left) / h->n_x / 3.2);
    for (int64_t k = 0; k < (int64_t)h->n_x * h->n_y; ++k) {
        double rgb[3] = {1.0, 1.0, 1.0};
        char text[16] = "\342\200\223"; // of a value that does not exist
        const bool has_value = isfinite(h->value[k]);
        if (has_value) {
            (h->is_signed ? clx_colour_diverging
                          : clx_colour_sequence)(clx_ticks_place(&f->value, h->value[k]), rgb);
            (void)clx_number_print(text, sizeof text, "%.2f", h->value[k]);
        }
        const double light = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
        const double ink = light > 0.5 ? 0.0 : 1.0;
        const int64_t row = k / h->n_x;
        const double column = (double)(k % h->n_x) + 0.5;
        const double x = h->x_low + column * (h->x_high - h->x_low) / h->n_x;
        const double y = h->y_low + ((double)row + 0.5) * (h->y_high - h->y_low) / h->n_y;
        cairo_set_source_rgb(f->canvas->cr, ink, ink, ink);
        clx_canvas_text(f->canvas, clx_figure_x(f, x), clx_figure_y(f, y), middle, size, text);
    }
}

void clx_figure_heat(clx_figure *f)
{
    const clast_heat *h = f->chart->heat;
    cairo_t *cr = f->canvas->cr;
    const double dx = (h->x_high - h->x_low) / h->n_x;
    const double dy = (h->y_high - h->y_low) / h->n_y;
    cairo_set_antialias(cr, CAIRO_ANTIALIAS_NONE);
    for (int64_t k = 0; k < (int64_t)h->n_x * h->n_y; ++k) {
        double rgb[3];
        if (!isfinite(h->value[k])) {
            continue;
        }
        const int32_t column = (int32_t)(k % h->n_x);
        const int32_t row = (int32_t)(k / h->n_x);
        const double x0 = clx_figure_x(f, h->x_low + column * dx);
        const double x1 = clx_figure_x(f, h->x_low + (column + 1) * dx);
        const double y0 = clx_figure_y(f, h->y_low + row * dy);
        const double y1 = clx_figure_y(f, h->y_low + (row + 1) * dy);
        (h->is_signed ? clx_colour_diverging
                      : clx_colour_sequence)(clx_ticks_place(&f->value, h->value[k]), rgb);
        clx_canvas_colour(f->canvas, rgb, 1.0);
        cairo_rectangle(cr, x0, y1, x1 - x0, y0 - y1);
        cairo_fill(cr);
    }
    cairo_set_antialias(cr, CAIRO_ANTIALIAS_DEFAULT);
    if (h->has_text) {
        write_cells(f);
    }
}

void clx_figure_series(clx_figure *f, const clast_series *e)
{
    double rgb[3];
    clx_colour_category(e->colour, rgb);
    clx_canvas_colour(f->canvas, rgb, e->kind == CLAST_SERIES_BAND ? 0.25 : 1.0);
    switch (e->kind) {
    case CLAST_SERIES_LINE:
    case CLAST_SERIES_STEP:
        draw_path(f, e);
        break;
    case CLAST_SERIES_POINTS:
        draw_points(f, e);
        break;
    case CLAST_SERIES_BAND:
        draw_band(f, e);
        break;
    case CLAST_SERIES_BARS:
        draw_bars(f, e);
        break;
    }
}
