#pragma once
// Colours of the grains and what explains them: a colour bar with ticks, or a list of shapes.
#include "render/scene.h"

enum { CLX_LEGEND_TICKS = 12, CLX_LEGEND_SHAPES = 8, CLX_LEGEND_TEXT = 168 };

typedef enum { CLX_LEGEND_NONE, CLX_LEGEND_BAR, CLX_LEGEND_LIST } clx_legend_kind;

typedef struct clx_legend {
    clx_legend_kind kind;
    char title[64];
    bool log;
    double low, high;               ///< of the bar, in the units of the ticks
    double factor;                  ///< of sizes, from coordinates to the units of the ticks
    int n;                          ///< ticks, or shapes listed
    double place[CLX_LEGEND_TICKS]; ///< of the ticks: 0 at low, 1 at high
    char text[CLX_LEGEND_TICKS][CLX_LEGEND_TEXT];
    double rgb[CLX_LEGEND_SHAPES][3]; ///< sRGB of the listed shapes
} clx_legend;

/// A length's display unit: factor from coordinates to it, and its name ("\u00b5m").
typedef struct clx_length_unit {
    double factor;
    const char *name; ///< "" when the coordinates have no unit
} clx_length_unit;

/// The metric unit in which `length` reads as 1 to 1000, for coordinates that are metre_per_unit
/// long; metre_per_unit = 0: no unit.
clx_length_unit clx_length_unit_for(double length, double metre_per_unit);

/// sRGB of the bar at 0 <= t <= 1.
void clx_legend_colour(double t, double rgb[3]);

/// Gives every grain its albedo and describes them. `scene` NULL: describes alone.
clast_status clx_legend_make(const clast_assembly *assembly, const clast_render_config *config,
                             double metre_per_unit, clx_scene *scene, clx_legend *legend);
