#pragma once
// Words and bars on a picture, drawn by cairo: the legend at the right, the scale bar below.
#include "render/camera.h"
#include "render/legend.h"

/// Where everything goes, in pixels.
typedef struct clx_layout {
    clx_frame frame;    ///< for the object
    double text;        ///< font size
    double legend_left; ///< left edge of the legend's column
    double legend_top, legend_bottom;
    double scale_middle; ///< horizontal middle of the scale bar
    double scale_bottom; ///< its lower edge
} clx_layout;

clast_status clx_label_layout(const clast_render_config *config, const clx_legend *legend,
                              clx_layout *layout);

/// Draws legend and scale bar over the finished picture.
clast_status clx_label_draw(const clast_render_config *config, const clx_layout *layout,
                            const clx_legend *legend, double metre_per_unit, clast_image *image);
