// Labels are drawn on a transparent cairo surface of the picture's size and laid over it.
#include "render/label.h"

#include "base/number.h"

#include <cairo.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *const font = "DejaVu Sans";

/// A tall bar or list of a picture is this many font sizes high at most.
static const double legend_height = 16.0;

/// Height of a name's row in a list, font sizes.
static const double list_row = 1.6;

static void choose_font(cairo_t *cr, double size, bool bold)
{
    cairo_select_font_face(cr, font, CAIRO_FONT_SLANT_NORMAL,
                           bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cr, size);
}

static double text_width(cairo_t *cr, const char *text)
{
    cairo_text_extents_t extents;
    cairo_text_extents(cr, text, &extents);
    return extents.x_advance;
}

/// Width of the column at the right: title, bar and numbers, or swatches and names.
static double legend_width(cairo_t *cr, const clx_legend *legend, double text)
{
    double widest = 0.0;
    if (legend->kind == CLX_LEGEND_NONE) {
        return 0.0;
    }
    for (int i = 0; i < legend->n; ++i) {
        widest = fmax(widest, text_width(cr, legend->text[i]));
    }
    // Bar: 1.1 wide, a gap of 0.7, numbers, a gap of 0.5 and the title upright (1.2).
    return widest + (legend->kind == CLX_LEGEND_BAR ? 3.6 : 1.6) * text;
}

clast_status clx_label_layout(const clast_render_config *config, const clx_legend *legend,
                              clx_layout *layout)
{
    clast_status status = CLAST_OK;
    const double smaller = fmin(config->width, config->height);
    const double margin = 0.04 * smaller;
    const double text = fmax(8.0, 0.0235 * smaller);
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, 8, 8);
    cairo_t *cr = cairo_create(surface);
    choose_font(cr, text, false);
    const double width = legend_width(cr, legend, text);
    CLX_CHECK(cairo_status(cr) == CAIRO_STATUS_SUCCESS, CLAST_E_MEMORY, "cairo: %s",
              cairo_status_to_string(cairo_status(cr)));
    *layout = (clx_layout){.text = text,
                           .legend_left = config->width - margin - width,
                           .scale_bottom = config->height - margin};
    layout->frame = (clx_frame){.left = margin,
                                .top = margin,
                                .right = layout->legend_left - (width > 0.0 ? margin : 0.0),
                                .bottom = config->height - margin -
                                          (config->scale_bar ? 2.2 * text + 0.6 * margin : 0.0)};
    if (width <= 0.0) {
        layout->frame.right = config->width - margin;
    }
    CLX_CHECK(layout->frame.right - layout->frame.left > 0.3 * config->width &&
                  layout->frame.bottom - layout->frame.top > 0.3 * config->height,
              CLAST_E_CONFIG,
              "a picture of %d x %d leaves no space beside its labels; enlarge it or leave out "
              "colour_bar and scale_bar",
              config->width, config->height);
    const double height = fmin(legend_height * text, config->height - 2.0 * margin);
    layout->legend_top = 0.5 * (config->height - height);
    layout->legend_bottom = layout->legend_top + height;
    layout->scale_middle = 0.5 * (layout->frame.left + layout->frame.right);
done:
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    return status;
}

static void draw_text(cairo_t *cr, double x, double y, const char *text)
{
    cairo_move_to(cr, x, y);
    cairo_show_text(cr, text);
}

static void draw_title_upright(cairo_t *cr, double x, double middle, const char *text)
{
    cairo_save(cr);
    cairo_translate(cr, x, middle + 0.5 * text_width(cr, text));
    cairo_rotate(cr, -0.5 * CLAST_PI);
    draw_text(cr, 0.0, 0.0, text);
    cairo_restore(cr);
}

/// Behind labels that grains may reach: what is seen through it is no darker than the ink's ground.
static void draw_plate(cairo_t *cr, const clx_layout *layout, double ink, const double box[4])
{
    const double paper = ink > 0.5 ? 0.0 : 1.0;
    const double border = 0.6 * layout->text;
    cairo_set_source_rgba(cr, paper, paper, paper, 0.7);
    cairo_rectangle(cr, box[0] - border, box[1] - border, box[2] - box[0] + 2.0 * border,
                    box[3] - box[1] + 2.0 * border);
    cairo_fill(cr);
    cairo_set_source_rgb(cr, ink, ink, ink);
}

static void draw_legend_plate(cairo_t *cr, const clx_layout *layout, const clx_legend *legend,
                              double ink)
{
    const double middle = 0.5 * (layout->legend_top + layout->legend_bottom);
    const double row = list_row * layout->text;
    const bool is_list = legend->kind == CLX_LEGEND_LIST;
    const double box[4] = {layout->legend_left,
                           is_list ? middle - 0.5 * legend->n * row - 0.5 * layout->text
                                   : layout->legend_top,
                           layout->legend_left + legend_width(cr, legend, layout->text),
                           is_list ? middle + (0.5 * legend->n - 1.0) * row + 0.5 * layout->text
                                   : layout->legend_bottom};
    draw_plate(cr, layout, ink, box);
}

static void draw_bar(cairo_t *cr, const clx_layout *layout, const clx_legend *legend, double ink)
{
    const double x = layout->legend_left;
    const double w = 1.1 * layout->text;
    const double top = layout->legend_top;
    const double height = layout->legend_bottom - top;
    cairo_pattern_t *gradient = cairo_pattern_create_linear(0.0, top + height, 0.0, top);
    double widest = 0.0;
    for (int i = 0; i <= 64; ++i) {
        double rgb[3];
        const bool is_one = !(legend->high > legend->low);
        clx_legend_colour(is_one ? 0.5 : i / 64.0, rgb);
        cairo_pattern_add_color_stop_rgb(gradient, i / 64.0, rgb[0], rgb[1], rgb[2]);
    }
    cairo_rectangle(cr, x, top, w, height);
    cairo_set_source(cr, gradient);
    cairo_fill(cr);
    cairo_pattern_destroy(gradient);
    cairo_set_source_rgb(cr, ink, ink, ink);
    cairo_set_line_width(cr, fmax(1.0, 0.07 * layout->text));
    for (int i = 0; i < legend->n; ++i) {
        const double y = top + (1.0 - legend->place[i]) * height;
        cairo_move_to(cr, x + w, y);
        cairo_line_to(cr, x + w + 0.35 * layout->text, y);
        cairo_stroke(cr);
        draw_text(cr, x + w + 0.7 * layout->text, y + 0.36 * layout->text, legend->text[i]);
        widest = fmax(widest, text_width(cr, legend->text[i]));
    }
    draw_title_upright(cr, x + w + 1.9 * layout->text + widest, top + 0.5 * height, legend->title);
}

static void draw_list(cairo_t *cr, const clx_layout *layout, const clx_legend *legend, double ink)
{
    const double row = list_row * layout->text;
    const double middle = 0.5 * (layout->legend_top + layout->legend_bottom);
    for (int i = 0; i < legend->n; ++i) {
        const double y = middle + (i - 0.5 * legend->n) * row;
        cairo_set_source_rgb(cr, legend->rgb[i][0], legend->rgb[i][1], legend->rgb[i][2]);
        cairo_arc(cr, layout->legend_left + 0.5 * layout->text, y, 0.45 * layout->text, 0.0,
                  2.0 * CLAST_PI);
        cairo_fill(cr);
        cairo_set_source_rgb(cr, ink, ink, ink);
        draw_text(cr, layout->legend_left + 1.6 * layout->text, y + 0.36 * layout->text,
                  legend->text[i]);
    }
}

/// Largest 1, 2 or 5 times a power of ten that is at most `length`.
static double round_below(double length)
{
    const double power = pow(10.0, floor(log10(length) + 1e-12));
    const double digit = length / power;
    return power * (digit >= 5.0 ? 5.0 : digit >= 2.0 ? 2.0 : 1.0);
}

/// In perspective what is nearer to the viewer is larger: the bar holds at the centre.
static void write_length(double shown, const clx_length_unit *unit, bool is_perspective,
                         char label[64])
{
    const char *where = is_perspective ? " at the centre" : "";
    if (unit->name[0] != '\0') {
        (void)clx_number_print(label, 64, "%.10g %s%s", shown, unit->name, where);
    } else {
        (void)clx_number_print(label, 64, "%.10g model unit%s%s", shown, shown == 1.0 ? "" : "s",
                               where);
    }
}

static void draw_scale(cairo_t *cr, const clx_layout *layout, const clast_render_config *config,
                       double pixel, double metre_per_unit, double ink)
{
    char label[64];
    const double space = layout->frame.right - layout->frame.left;
    const double raw = 0.28 * space * pixel;
    clx_length_unit unit = clx_length_unit_for(raw, metre_per_unit);
    double shown = round_below(raw * unit.factor);
    unit = clx_length_unit_for(shown / unit.factor, metre_per_unit);
    shown = round_below(raw * unit.factor);
    const double length = shown / unit.factor / pixel;
    const double thick = 0.22 * layout->text;
    const double left = layout->scale_middle - 0.5 * length;
    write_length(shown, &unit, config->projection == CLAST_RENDER_PERSPECTIVE, label);
    const double half = 0.5 * text_width(cr, label);
    if (config->zoom > 1.0) {
        const double widest = fmax(half, 0.5 * length);
        const double box[4] = {layout->scale_middle - widest,
                               layout->scale_bottom - thick - 1.3 * layout->text,
                               layout->scale_middle + widest, layout->scale_bottom};
        draw_plate(cr, layout, ink, box);
    }
    cairo_rectangle(cr, left, layout->scale_bottom - thick, length, thick);
    cairo_fill(cr);
    draw_text(cr, layout->scale_middle - half, layout->scale_bottom - thick - 0.5 * layout->text,
              label);
}

/// One premultiplied cairo pixel over one straight pixel of the picture.
static void lay_over(uint32_t over, uint8_t rgba[4])
{
    const double a = (over >> 24) / 255.0;
    const double below = rgba[3] / 255.0 * (1.0 - a);
    const double alpha = a + below;
    for (int k = 0; k < 3; ++k) {
        const double premultiplied = (double)((over >> (16 - 8 * k)) & 255U);
        const double value = premultiplied + below * rgba[k];
        rgba[k] = (uint8_t)lround(fmin(255.0, value / alpha));
    }
    rgba[3] = (uint8_t)lround(255.0 * alpha);
}

static void lay_surface_over(cairo_surface_t *surface, clast_image *image)
{
    const unsigned char *bytes = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    for (int32_t y = 0; y < image->height; ++y) {
        for (int32_t x = 0; x < image->width; ++x) {
            uint32_t over = 0;
            memcpy(&over, bytes + (ptrdiff_t)y * stride + 4 * (ptrdiff_t)x, sizeof over);
            if (over >> 24 != 0) {
                lay_over(over, image->rgba + 4 * ((ptrdiff_t)y * image->width + x));
            }
        }
    }
}

clast_status clx_label_draw(const clast_render_config *config, const clx_layout *layout,
                            const clx_legend *legend, double metre_per_unit, clast_image *image)
{
    clast_status status = CLAST_OK;
    const double ink = config->background == CLAST_RENDER_BLACK ? 0.95 : 0.12;
    cairo_surface_t *surface =
        cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image->width, image->height);
    cairo_t *cr = cairo_create(surface);
    choose_font(cr, layout->text, false);
    cairo_set_source_rgb(cr, ink, ink, ink);
    if (config->scale_bar) {
        draw_scale(cr, layout, config, image->pixel_size, metre_per_unit, ink);
    }
    if (config->zoom > 1.0 && legend->kind != CLX_LEGEND_NONE) { // else all fits beside them
        draw_legend_plate(cr, layout, legend, ink);
    }
    if (legend->kind == CLX_LEGEND_BAR) {
        draw_bar(cr, layout, legend, ink);
    } else if (legend->kind == CLX_LEGEND_LIST) {
        draw_list(cr, layout, legend, ink);
    }
    cairo_surface_flush(surface);
    CLX_CHECK(cairo_status(cr) == CAIRO_STATUS_SUCCESS, CLAST_E_MEMORY, "cairo: %s",
              cairo_status_to_string(cairo_status(cr)));
    lay_surface_over(surface, image);
done:
    cairo_destroy(cr);
    cairo_surface_destroy(surface);
    return status;
}
