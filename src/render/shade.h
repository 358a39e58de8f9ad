#pragma once
// Light: a sun with a soft edge, a sky that brightens upwards, and what grains hide of both.
#include "render/camera.h"
#include "render/dither.h"

typedef struct clx_shader {
    const clx_scene *scene;
    clx_camera camera;
    double sun[3];   ///< unit vector to the middle of the sun's disc
    double sun_a[3]; ///< with sun_b: the plane of the disc
    double sun_b[3];
    double sun_tangent; ///< radius of the disc at distance 1
    double zenith[3];
    double sun_light, sky_light;
    double lift; ///< how far rays start off a surface
    bool has_ground;
    int up;        ///< axis
    double ground; ///< height of the ground along it
    int32_t samples;
    int32_t ambient_rays;
    clx_dither dither; ///< shifts of the pixels' samples
} clx_shader;

void clx_shader_set(clx_shader *shader, const clx_scene *scene, const clast_render_config *config,
                    const clx_camera *camera);

/// Mean of a pixel's samples: linear light times alpha, and alpha.
void clx_shade_pixel(const clx_shader *shader, int32_t x, int32_t y, double rgba[4]);
