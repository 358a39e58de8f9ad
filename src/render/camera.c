// Framing by support functions: exact for every kind of grain, so nothing is ever cut off.
#include "render/camera.h"

#include "math/vec3.h"

void clx_camera_axes(const clast_render_config *config, double right[3], double up[3],
                     double back[3])
{
    const double ca = cos(config->azimuth);
    const double sa = sin(config->azimuth);
    const double ce = cos(config->elevation);
    const double se = sin(config->elevation);
    const int z = config->up;
    const int x = (z + 1) % 3;
    const int y = (z + 2) % 3;
    back[x] = ce * ca;
    back[y] = ce * sa;
    back[z] = se;
    right[x] = -sa;
    right[y] = ca;
    right[z] = 0.0;
    up[x] = -se * ca;
    up[y] = -se * sa;
    up[z] = ce;
}

/// Extent of the scene along a unit vector.
static void extent(const clx_scene *scene, const double axis[3], double *low, double *high)
{
    CLAST_ASSERT(v3_is_unit(axis, 1e-9));
    const double opposite[3] = {-axis[0], -axis[1], -axis[2]};
    *low = -clx_scene_support(scene, opposite);
    *high = clx_scene_support(scene, axis);
}

static void fit_orthographic(const clx_scene *scene, double zoom, const clx_frame *frame,
                             clx_camera *camera)
{
    double x[2];
    double y[2];
    double z[2];
    extent(scene, camera->right, &x[0], &x[1]);
    extent(scene, camera->up, &y[0], &y[1]);
    extent(scene, camera->back, &z[0], &z[1]);
    const double by_width = (x[1] - x[0]) / (frame->right - frame->left);
    const double by_height = (y[1] - y[0]) / (frame->bottom - frame->top);
    camera->pixel = fmax(by_width, by_height) / zoom;
    v3_scale(camera->eye, 0.5 * (x[0] + x[1]), camera->right);
    v3_axpy(camera->eye, camera->eye, 0.5 * (y[0] + y[1]), camera->up);
    v3_axpy(camera->eye, camera->eye, z[1] + 0.01 * scene->radius, camera->back);
}

/// Largest s . p over the scene for s = along focus + half back, one side of the view's pyramid.
static double side(const clx_scene *scene, const clx_camera *camera, const double along[3],
                   double sign, double half)
{
    double normal[3];
    v3_scale(normal, sign * camera->focus, along);
    v3_axpy(normal, normal, half, camera->back);
    return clx_scene_support(scene, normal);
}

/// The nearest place on the view's axis from which all four sides of the pyramid clear the scene.
static void fit_perspective(const clx_scene *scene, double zoom, const clx_frame *frame,
                            clx_camera *camera)
{
    const double half_x = 0.5 * (frame->right - frame->left);
    const double half_y = 0.5 * (frame->bottom - frame->top);
    const double right = side(scene, camera, camera->right, 1.0, half_x);
    const double left = side(scene, camera, camera->right, -1.0, half_x);
    const double top = side(scene, camera, camera->up, 1.0, half_y);
    const double bottom = side(scene, camera, camera->up, -1.0, half_y);
    const double away = fmax((right + left) / (2.0 * half_x), (top + bottom) / (2.0 * half_y));
    v3_scale(camera->eye, (right - left) / (2.0 * camera->focus), camera->right);
    v3_axpy(camera->eye, camera->eye, (top - bottom) / (2.0 * camera->focus), camera->up);
    v3_axpy(camera->eye, camera->eye, away, camera->back);
    camera->focus *= zoom;
    camera->pixel = (away - v3_dot(scene->centre, camera->back)) / camera->focus;
}

clx_camera clx_camera_fit(const clx_scene *scene, const clast_render_config *config,
                          const clx_frame *frame)
{
    clx_camera camera = {.is_perspective = config->projection == CLAST_RENDER_PERSPECTIVE,
                         .centre_x = 0.5 * (frame->left + frame->right),
                         .centre_y = 0.5 * (frame->top + frame->bottom),
                         .focus = 0.5 * config->height / tan(0.5 * config->field_of_view)};
    clx_camera_axes(config, camera.right, camera.up, camera.back);
    if (camera.is_perspective) {
        fit_perspective(scene, config->zoom, frame, &camera);
    } else {
        fit_orthographic(scene, config->zoom, frame, &camera);
    }
    return camera;
}

void clx_camera_ray(const clx_camera *camera, double x, double y, double origin[3],
                    double direction[3])
{
    const double dx = x - camera->centre_x;
    const double dy = camera->centre_y - y;
    v3_copy(origin, camera->eye);
    if (!camera->is_perspective) {
        v3_axpy(origin, origin, dx * camera->pixel, camera->right);
        v3_axpy(origin, origin, dy * camera->pixel, camera->up);
        v3_scale(direction, -1.0, camera->back);
        return;
    }
    v3_scale(direction, -camera->focus, camera->back);
    v3_axpy(direction, direction, dx, camera->right);
    v3_axpy(direction, direction, dy, camera->up);
    (void)v3_unit(direction, direction);
}
