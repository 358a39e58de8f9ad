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

/// Pixels of a block each way, and samples that are on their way at a time (some 140 kB).
enum { CLX_SHADE_SIDE = 8, CLX_SHADE_LOOKS = 384 };

/// Means of the samples of the pixels from low to before high, row by row, at most CLX_SHADE_SIDE
/// each way: linear light times alpha, and alpha.
void clx_shade_block(const clx_shader *shader, const int32_t low[2], const int32_t high[2],
                     double (*rgba)[4]);
