// Cairo surfaces in memory: one drawing code for SVG, PDF and PNG.
#include "plot/canvas.h"

#include "base/alloc.h"
#include "base/path.h"
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <ctype.h>
#include <string.h>

static const double PNG_SCALE = 2.0;

static cairo_status_t append(void *context, const unsigned char *data, unsigned int length)
{
    clx_canvas *canvas = context;
    if (canvas->status == CLAST_OK) {
        canvas->status = clx_grow(&canvas->bytes, &canvas->capacity, canvas->n + length, 1);
    }
    if (canvas->status != CLAST_OK) {
        return CAIRO_STATUS_WRITE_ERROR;
    }
    memcpy(canvas->bytes + canvas->n, data, length);
    canvas->n += length;
    return CAIRO_STATUS_SUCCESS;
}

clast_status clx_canvas_format_of(const char *path, clx_canvas_format *format)
{
    if (clx_path_is(path, "svg")) {
        *format = CLX_CANVAS_SVG;
    } else if (clx_path_is(path, "pdf")) {
        *format = CLX_CANVAS_PDF;
    } else if (clx_path_is(path, "png")) {
        *format = CLX_CANVAS_PNG;
    } else {
        return clx_fail(CLAST_E_USAGE, "%s: charts are written as .svg, .pdf or .png", path);
    }
    return CLAST_OK;
}

static void make_surface(clx_canvas *canvas)
{
    const double width = canvas->width;
    const double height = canvas->height;
    switch (canvas->format) {
    case CLX_CANVAS_SVG:
        canvas->surface = cairo_svg_surface_create_for_stream(append, canvas, width, height);
        break;
    case CLX_CANVAS_PDF:
        canvas->surface = cairo_pdf_surface_create_for_stream(append, canvas, width, height);
        // A fixed date: equal charts are equal bytes.
        cairo_pdf_surface_set_metadata(canvas->surface, CAIRO_PDF_METADATA_CREATE_DATE,
                                       "2000-01-01T00:00:00Z");
        break;
    case CLX_CANVAS_PNG:
        canvas->surface = cairo_image_surface_create(
            CAIRO_FORMAT_RGB24, (int)(width * PNG_SCALE + 0.5), (int)(height * PNG_SCALE + 0.5));
        break;
    }
}

clast_status clx_canvas_begin(clx_canvas *canvas, clx_canvas_format format, double width,
                              double height)
{
    CLAST_ASSERT(width > 0.0 && height > 0.0 && canvas->cr == NULL);
    *canvas = (clx_canvas){.format = format, .width = width, .height = height};
    make_surface(canvas);
    canvas->cr = cairo_create(canvas->surface);
    if (cairo_status(canvas->cr) != CAIRO_STATUS_SUCCESS) {
        const char *why = cairo_status_to_string(cairo_status(canvas->cr));
        clx_canvas_free(canvas);
        return clx_fail(CLAST_E_MEMORY, "cannot draw a page of %g x %g points: %s", width, height,
                        why);
    }
    if (format == CLX_CANVAS_PNG) {
        cairo_scale(canvas->cr, PNG_SCALE, PNG_SCALE);
    }
    cairo_select_font_face(canvas->cr, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                           CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_source_rgb(canvas->cr, 1.0, 1.0, 1.0);
    cairo_paint(canvas->cr);
    cairo_set_source_rgb(canvas->cr, 0.0, 0.0, 0.0);
    return CLAST_OK;
}

static bool is_digit(unsigned char c)
{
    return c >= '0' && c <= '9';
}

/// Cairo numbers SVG surfaces by a counter of the process: "surface17". Numbers are cut from the
/// text, so that equal charts are equal bytes; a chart has one surface, so nothing clashes.
static void drop_surface_numbers(clx_canvas *canvas)
{
    static const char word[] = "\"surface";
    const int64_t length = (int64_t)sizeof word - 1;
    int64_t to = 0;
    for (int64_t from = 0; from < canvas->n;) {
        const bool found =
            from + length <= canvas->n && memcmp(canvas->bytes + from, word, (size_t)length) == 0;
        const int64_t keep = found ? length : 1;
        memmove(canvas->bytes + to, canvas->bytes + from, (size_t)keep);
        to += keep;
        from += keep;
        while (found && from < canvas->n && is_digit(canvas->bytes[from])) {
            ++from;
        }
    }
    canvas->n = to;
}

clast_status clx_canvas_finish(clx_canvas *canvas)
{
    cairo_status_t result = cairo_status(canvas->cr);
    if (result == CAIRO_STATUS_SUCCESS && canvas->format == CLX_CANVAS_PNG) {
        cairo_surface_flush(canvas->surface);
        result = cairo_surface_write_to_png_stream(canvas->surface, append, canvas);
    } else if (result == CAIRO_STATUS_SUCCESS) {
        cairo_show_page(canvas->cr);
        cairo_surface_finish(canvas->surface);
        result = cairo_surface_status(canvas->surface);
    }
    if (canvas->status == CLAST_OK && result != CAIRO_STATUS_SUCCESS) {
        canvas->status =
            clx_fail(CLAST_E_MEMORY, "drawing failed: %s", cairo_status_to_string(result));
    }
    if (canvas->status == CLAST_OK && canvas->format == CLX_CANVAS_SVG) {
        drop_surface_numbers(canvas);
    }
    return canvas->status;
}

void clx_canvas_free(clx_canvas *canvas)
{
    if (canvas->cr != NULL) {
        cairo_destroy(canvas->cr);
    }
    if (canvas->surface != NULL) {
        cairo_surface_finish(canvas->surface);
        cairo_surface_destroy(canvas->surface);
    }
    clx_free(canvas->bytes);
    *canvas = (clx_canvas){0};
}

enum { TEXT_SIZE = 512 };

/// A text as it is drawn: printable (cairo draws nothing more after bytes that are not UTF-8),
/// powers of units raised.
static const char *typeset(const char *text, char shown[TEXT_SIZE])
{
    (void)clast_text_printable(text, TEXT_SIZE, shown);
    for (char *at = strchr(shown, '^'); at != NULL; at = strchr(at + 1, '^')) {
        const bool is_power = (at[1] == '2' || at[1] == '3') && !isdigit((unsigned char)at[2]);
        if (is_power) { // two bytes for two
            at[1] = at[1] == '2' ? '\262' : '\263';
            at[0] = '\302';
        }
    }
    return shown;
}

void clx_canvas_text(clx_canvas *canvas, double x, double y, const double anchor[2], double size,
                     const char *text)
{
    cairo_text_extents_t box;
    cairo_font_extents_t font;
    char shown[TEXT_SIZE];
    (void)typeset(text, shown);
    cairo_set_font_size(canvas->cr, size);
    cairo_text_extents(canvas->cr, shown, &box);
    cairo_font_extents(canvas->cr, &font);
    const double digit = 0.78 * font.ascent;
    cairo_move_to(canvas->cr, x - anchor[0] * box.x_advance, y + anchor[1] * digit);
    cairo_show_text(canvas->cr, shown);
    cairo_new_path(canvas->cr);
}

void clx_canvas_text_up(clx_canvas *canvas, double x, double y, double size, const char *text)
{
    static const double centre[2] = {0.5, 0.5};
    cairo_save(canvas->cr);
    cairo_translate(canvas->cr, x, y);
    cairo_rotate(canvas->cr, -0.5 * CLAST_PI);
    clx_canvas_text(canvas, 0.0, 0.0, centre, size, text);
    cairo_restore(canvas->cr);
}

double clx_canvas_text_width(clx_canvas *canvas, double size, const char *text)
{
    cairo_text_extents_t box;
    char shown[TEXT_SIZE];
    cairo_set_font_size(canvas->cr, size);
    cairo_text_extents(canvas->cr, typeset(text, shown), &box);
    return box.x_advance;
}

void clx_canvas_colour(clx_canvas *canvas, const double rgb[3], double alpha)
{
    cairo_set_source_rgba(canvas->cr, rgb[0], rgb[1], rgb[2], alpha);
}

void clx_canvas_line(clx_canvas *canvas, double x0, double y0, double x1, double y1)
{
    cairo_move_to(canvas->cr, x0, y0);
    cairo_line_to(canvas->cr, x1, y1);
    cairo_stroke(canvas->cr);
}
