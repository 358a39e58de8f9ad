// Layout of a chart: plotting area, grid, frame, ticks, colour bar, legend.
#include "plot/figure.h"

#include "math/colour.h"
#include <math.h>

static const double LEFT[2] = {0.0, 0.0};
static const double RIGHT_MIDDLE[2] = {1.0, 0.5};
static const double LEFT_MIDDLE[2] = {0.0, 0.5};
static const double HANGING[2] = {0.5, 1.0};
static const double STANDING[2] = {0.5, 0.0};

double clx_figure_x(const clx_figure *f, double value)
{
    return f->left + clx_ticks_place(&f->x, value) * (f->right - f->left);
}

double clx_figure_y(const clx_figure *f, double value)
{
    return f->bottom - clx_ticks_place(&f->y, value) * (f->bottom - f->top);
}

static double widest_label(clx_figure *f, const clx_ticks *ticks)
{
    double widest = 0.0;
    for (int i = 0; i < ticks->n; ++i) {
        widest = fmax(widest, clx_canvas_text_width(f->canvas, CLX_FONT_TICK, ticks->label[i]));
    }
    return widest;
}

/// Names of a heat map's columns or rows, and the room that they take.
static double widest_name(clx_figure *f, const char *const *name, int32_t n)
{
    double widest = 0.0;
    for (int32_t i = 0; i < n; ++i) {
        widest = fmax(widest, clx_canvas_text_width(f->canvas, CLX_FONT_TICK, name[i]));
    }
    return widest;
}

static const char *const *x_names(const clx_figure *f)
{
    return f->chart->heat != NULL ? f->chart->heat->x_name : NULL;
}

static const char *const *y_names(const clx_figure *f)
{
    return f->chart->heat != NULL ? f->chart->heat->y_name : NULL;
}

void clx_figure_lay_out(clx_figure *f)
{
    const clast_chart *c = f->chart;
    const double beside =
        y_names(f) != NULL ? widest_name(f, y_names(f), c->heat->n_y) : widest_label(f, &f->y);
    const double below =
        x_names(f) != NULL ? widest_name(f, x_names(f), c->heat->n_x) - CLX_FONT_TICK : 0.0;
    f->left = 10.0 + beside + 8.0 + (c->y.label != NULL ? 18.0 : 0.0);
    f->right = f->canvas->width - 16.0;
    if (f->has_value) {
        f->right -= 12.0 + 14.0 + 6.0 + widest_label(f, &f->value) + 22.0;
    }
    f->bottom = f->canvas->height - 26.0 - below - (c->x.label != NULL ? 16.0 : 0.0);
    f->legend_top = 12.0 + (c->title != NULL ? 20.0 : 0.0);
    f->top = f->legend_top + clx_figure_legend(f, false);
    if (c->equal) {
        const double per_x = (f->right - f->left) / (f->x.high - f->x.low);
        const double per_y = (f->bottom - f->top) / (f->y.high - f->y.low);
        const double per = fmin(per_x, per_y);
        f->right = f->left + per * (f->x.high - f->x.low);
        f->top = f->bottom - per * (f->y.high - f->y.low);
    }
}

static void key_symbol(clx_figure *f, const clast_series *e, double x, double y)
{
    double rgb[3];
    cairo_t *cr = f->canvas->cr;
    clx_colour_category(e->colour, rgb);
    clx_canvas_colour(f->canvas, rgb, e->kind == CLAST_SERIES_BAND ? 0.25 : 1.0);
    if (e->kind == CLAST_SERIES_POINTS) {
        cairo_arc(cr, x + 11.0, y - 3.0, 3.0, 0.0, 2.0 * CLAST_PI);
        cairo_fill(cr);
    } else if (e->kind == CLAST_SERIES_BAND || e->kind == CLAST_SERIES_BARS) {
        cairo_rectangle(cr, x, y - 7.0, 22.0, 8.0);
        cairo_fill(cr);
    } else {
        const double dash[2] = {5.0, 3.0};
        cairo_set_line_width(cr, 1.6);
        cairo_set_dash(cr, dash, e->dashed ? 2 : 0, 0.0);
        clx_canvas_line(f->canvas, x, y - 3.0, x + 22.0, y - 3.0);
        cairo_set_dash(cr, NULL, 0, 0.0);
    }
}

double clx_figure_legend(clx_figure *f, bool draw)
{
    const clast_chart *c = f->chart;
    double x = f->left;
    double y = f->legend_top + 8.0;
    bool any = false;
    for (int32_t i = 0; i < c->n_series; ++i) {
        const clast_series *e = &c->series[i];
        if (e->label == NULL) {
            continue;
        }
        const double wide = 38.0 + clx_canvas_text_width(f->canvas, CLX_FONT_TICK, e->label);
        if (any && x + wide > f->canvas->width - 4.0) {
            x = f->left;
            y += 14.0;
        }
        if (draw) {
            key_symbol(f, e, x, y);
            cairo_set_source_rgb(f->canvas->cr, 0.1, 0.1, 0.1);
            clx_canvas_text(f->canvas, x + 26.0, y, LEFT, CLX_FONT_TICK, e->label);
        }
        any = true;
        x += wide;
    }
    return any ? y - f->legend_top + 8.0 : 0.0;
}

void clx_figure_grid(clx_figure *f)
{
    cairo_t *cr = f->canvas->cr;
    if (x_names(f) != NULL || y_names(f) != NULL) {
        return;
    }
    cairo_set_line_width(cr, 0.6);
    cairo_set_source_rgb(cr, 0.90, 0.90, 0.90);
    for (int i = 0; i < f->x.n; ++i) {
        const double x = clx_figure_x(f, f->x.at[i]);
        clx_canvas_line(f->canvas, x, f->top, x, f->bottom);
    }
    for (int i = 0; i < f->y.n; ++i) {
        const double y = clx_figure_y(f, f->y.at[i]);
        clx_canvas_line(f->canvas, f->left, y, f->right, y);
    }
}

static void draw_x_names(clx_figure *f)
{
    const clast_heat *h = f->chart->heat;
    for (int32_t i = 0; i < h->n_x; ++i) {
        const double x = clx_figure_x(f, h->x_low + (i + 0.5) * (h->x_high - h->x_low) / h->n_x);
        const double width = clx_canvas_text_width(f->canvas, CLX_FONT_TICK, h->x_name[i]);
        clx_canvas_text_up(f->canvas, x + 3.0, f->bottom + 6.0 + 0.5 * width, CLX_FONT_TICK,
                           h->x_name[i]);
    }
}

static void draw_y_names(clx_figure *f)
{
    const clast_heat *h = f->chart->heat;
    for (int32_t i = 0; i < h->n_y; ++i) {
        const double y = clx_figure_y(f, h->y_low + (i + 0.5) * (h->y_high - h->y_low) / h->n_y);
        clx_canvas_text(f->canvas, f->left - 6.0, y, RIGHT_MIDDLE, CLX_FONT_TICK, h->y_name[i]);
    }
}

static void draw_x_axis(clx_figure *f)
{
    double free_from = 0.0;
    for (int i = 0; i < f->x.n_minor; ++i) {
        const double x = clx_figure_x(f, f->x.minor[i]);
        clx_canvas_line(f->canvas, x, f->bottom, x, f->bottom + 2.0);
    }
    for (int i = 0; i < f->x.n; ++i) {
        const double x = clx_figure_x(f, f->x.at[i]);
        const double half = 0.5 * clx_canvas_text_width(f->canvas, CLX_FONT_TICK, f->x.label[i]);
        clx_canvas_line(f->canvas, x, f->bottom, x, f->bottom + 4.0);
        if (x - half >= free_from && x + half <= f->canvas->width) {
            clx_canvas_text(f->canvas, x, f->bottom + 6.0, HANGING, CLX_FONT_TICK, f->x.label[i]);
            free_from = x + half + 4.0;
        }
    }
    if (f->chart->x.label != NULL) {
        clx_canvas_text(f->canvas, 0.5 * (f->left + f->right), f->bottom + 34.0, STANDING, CLX_FONT,
                        f->x.title);
    }
}

static void draw_y_axis(clx_figure *f)
{
    for (int i = 0; i < f->y.n_minor; ++i) {
        const double y = clx_figure_y(f, f->y.minor[i]);
        clx_canvas_line(f->canvas, f->left - 2.0, y, f->left, y);
    }
    for (int i = 0; i < f->y.n; ++i) {
        const double y = clx_figure_y(f, f->y.at[i]);
        clx_canvas_line(f->canvas, f->left - 4.0, y, f->left, y);
        clx_canvas_text(f->canvas, f->left - 7.0, y, RIGHT_MIDDLE, CLX_FONT_TICK, f->y.label[i]);
    }
    if (f->chart->y.label != NULL) {
        clx_canvas_text_up(f->canvas, 12.0, 0.5 * (f->top + f->bottom), CLX_FONT, f->y.title);
    }
}

void clx_figure_frame(clx_figure *f)
{
    cairo_t *cr = f->canvas->cr;
    cairo_set_source_rgb(cr, 0.1, 0.1, 0.1);
    cairo_set_line_width(cr, 0.8);
    (x_names(f) != NULL ? draw_x_names : draw_x_axis)(f);
    (y_names(f) != NULL ? draw_y_names : draw_y_axis)(f);
    cairo_rectangle(cr, f->left, f->top, f->right - f->left, f->bottom - f->top);
    cairo_stroke(cr);
    if (f->chart->title != NULL) {
        clx_canvas_text(f->canvas, f->left, 20.0, LEFT, CLX_FONT_TITLE, f->chart->title);
    }
}

void clx_figure_value_bar(clx_figure *f)
{
    enum { N_STRIP = 64 };
    cairo_t *cr = f->canvas->cr;
    const double x = f->right + 12.0;
    const double height = f->bottom - f->top;
    cairo_set_antialias(cr, CAIRO_ANTIALIAS_NONE);
    for (int i = 0; i < N_STRIP; ++i) {
        double rgb[3];
        const bool is_signed = f->chart->heat != NULL && f->chart->heat->is_signed;
        (is_signed ? clx_colour_diverging : clx_colour_sequence)((i + 0.5) / N_STRIP, rgb);
        clx_canvas_colour(f->canvas, rgb, 1.0);
        cairo_rectangle(cr, x, f->bottom - height * (i + 1) / N_STRIP, 14.0, height / N_STRIP);
        cairo_fill(cr);
    }
    cairo_set_antialias(cr, CAIRO_ANTIALIAS_DEFAULT);
    cairo_set_source_rgb(cr, 0.1, 0.1, 0.1);
    for (int i = 0; i < f->value.n; ++i) {
        const double y = f->bottom - clx_ticks_place(&f->value, f->value.at[i]) * height;
        clx_canvas_line(f->canvas, x + 14.0, y, x + 17.0, y);
        clx_canvas_text(f->canvas, x + 20.0, y, LEFT_MIDDLE, CLX_FONT_TICK, f->value.label[i]);
    }
    clx_canvas_text_up(f->canvas, x + 20.0 + widest_label(f, &f->value) + 14.0,
                       0.5 * (f->top + f->bottom), CLX_FONT, f->value.title);
}
