#pragma once
// Light: a sun with a soft edge, a sky that brightens upwards, and what grains hide of both.
#include "render/camera.h"
#include "render/samples.h"

typedef struct clx_shader {
    const clx_scene *scene;
    clx_camera camera;
    double zenith[3];
    double sun_light, sky_light;
    double lift; ///< how far rays start off a surface
    bool has_ground;
    int up;        ///< axis
    double ground; ///< height of the ground along it
    clx_samples samples;
} clx_shader;

clast_status clx_shader_set(clx_shader *shader, const clx_scene *scene,
                            const clast_render_config *config, const clx_camera *camera);
void clx_shader_free(clx_shader *shader);

/// Mean of a pixel's samples: linear light times alpha, and alpha.
void clx_shade_pixel(const clx_shader *shader, int32_t x, int32_t y, double rgba[4]);
