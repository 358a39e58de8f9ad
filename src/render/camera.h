#pragma once
// Where the viewer stands and which ray belongs to which place of the picture.
#include "render/scene.h"

/// Rectangle of the picture, in pixels from the top left, that the object must fit into.
typedef struct clx_frame {
    double left, top, right, bottom;
} clx_frame;

typedef struct clx_camera {
    bool is_perspective;
    double right[3], up[3], back[3]; ///< unit vectors; back points at the viewer
    double eye[3];                   ///< perspective: the viewer; orthographic: a point before all
    double centre_x, centre_y;       ///< pixel of the optical axis
    double focus;                    ///< perspective: distance of the picture in pixels
    double pixel;                    ///< edge of a pixel in the plane through the scene's centre
} clx_camera;

/// Stands so that the scene just fills the frame (times zoom).
clx_camera clx_camera_fit(const clx_scene *scene, const clast_render_config *config,
                          const clx_frame *frame);

/// Directions of the view alone, which the cut needs before the frame is known.
void clx_camera_axes(const clast_render_config *config, double right[3], double up[3],
                     double back[3]);

/// Ray through a place of the picture; direction is a unit vector.
void clx_camera_ray(const clx_camera *camera, double x, double y, double origin[3],
                    double direction[3]);
