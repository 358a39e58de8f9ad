#pragma once
// A chart being drawn: its axes and where they lie on the page.
#include "plot/canvas.h"
#include "plot/ticks.h"

#include <clast/chart.h>

static const double CLX_FONT = 10.0;     // points: axis labels
static const double CLX_FONT_TICK = 9.0; // points: numbers at ticks, legend
static const double CLX_FONT_TITLE = 12.0;
static const double CLX_POINT_REACH = 4.0; // more than a point's radius

typedef struct clx_figure {
    clx_canvas *canvas;
    const clast_chart *chart;
    clx_ticks x, y, value;
    double left, right, top, bottom; ///< plotting area, points
    double legend_top;
    bool has_value;
} clx_figure;

double clx_figure_x(const clx_figure *figure, double value);
double clx_figure_y(const clx_figure *figure, double value);

/// Fixes the ranges and ticks of all axes from the data. No canvas needed.
clast_status clx_figure_measure(clx_figure *figure);

/// Places the plotting area on the page.
void clx_figure_lay_out(clx_figure *figure);

/// Grid below, frame with ticks and labels above the data, colour bar and legend beside them.
void clx_figure_grid(clx_figure *figure);
void clx_figure_frame(clx_figure *figure);
void clx_figure_value_bar(clx_figure *figure);

/// Legend rows above the plot (they can hide nothing); returns their height.
double clx_figure_legend(clx_figure *figure, bool draw);

/// One series, clipped by the caller to the plotting area, points to CLX_POINT_REACH around it.
/// Points whose middle lies outside are left out, and their bars end at the frame.
void clx_figure_series(clx_figure *figure, const clast_series *series);
void clx_figure_heat(clx_figure *figure);
