#pragma once
// A cairo surface that ends as bytes in memory (SVG, PDF or PNG), and text on it.
#include "base/status.h"

#include <cairo.h>

typedef enum { CLX_CANVAS_SVG, CLX_CANVAS_PDF, CLX_CANVAS_PNG } clx_canvas_format;

typedef struct clx_canvas {
    cairo_t *cr;
    cairo_surface_t *surface;
    clx_canvas_format format;
    double width, height; ///< points
    unsigned char *bytes; ///< the file, after clx_canvas_finish
    int64_t n, capacity;
    clast_status status;
} clx_canvas;

/// White page of this size in points; PNG pixels are twice as fine. The canvas must stay where it
/// is until freed.
clast_status clx_canvas_begin(clx_canvas *canvas, clx_canvas_format format, double width,
                              double height);

/// Ends the drawing: `bytes` and `n` hold the file.
clast_status clx_canvas_finish(clx_canvas *canvas);
void clx_canvas_free(clx_canvas *canvas);

/// Format of a path by its extension; CLAST_E_USAGE for others.
clast_status clx_canvas_format_of(const char *path, clx_canvas_format *format);

/// Text with its anchor: ax 0 left, 0.5 middle, 1 right; ay 0 baseline at y, 0.5 centred, 1 hanging
/// from y.
void clx_canvas_text(clx_canvas *canvas, double x, double y, const double anchor[2], double size,
                     const char *text);

/// Centred text turned a quarter anticlockwise about (x, y).
void clx_canvas_text_up(clx_canvas *canvas, double x, double y, double size, const char *text);

double clx_canvas_text_width(clx_canvas *canvas, double size, const char *text);

void clx_canvas_colour(clx_canvas *canvas, const double rgb[3], double alpha);

/// Strokes one straight line with the current pen.
void clx_canvas_line(clx_canvas *canvas, double x0, double y0, double x1, double y1);
