// One pixel: camera samples from a low-discrepancy sequence, each with one ray to the sun's disc
// and a few to the sky.
//
// Light: Lambert, plus a faint highlight; the sky is a vertical gradient sampled by the cosine law;
// a blocked sky ray returns a share of the surface's own colour (light passed between grains).
#include "render/shade.h"

#include "math/vec3.h"

/// Which sample of which pixel.
typedef struct {
    int32_t x, y, number;
} sample_place;

clast_status clx_shader_set(clx_shader *shader, const clx_scene *scene,
                            const clast_render_config *config, const clx_camera *camera)
{
    clx_samples *samples = &shader->samples;
    const double strength = 1.4; // of all light: a grain that faces the sun shows its own colour
    *shader = (clx_shader){.scene = scene,
                           .camera = *camera,
                           .sun_light = strength * (1.0 - config->ambient),
                           .sky_light = strength * config->ambient,
                           .lift = 1e-6 * scene->radius,
                           .has_ground = config->ground,
                           .up = config->up,
                           .ground = scene->low[config->up],
                           .samples = {.n = config->samples,
                                       .n_sky = config->ambient_rays,
                                       .sun_tangent = tan(config->sun_radius)}};
    clx_dither_fill(config->seed, &samples->dither);
    // Sun and sky turn with the viewer, so that every side of an object is seen in the same light.
    v3_scale(samples->sun, cos(config->sun_elevation) * cos(config->sun_azimuth), camera->back);
    v3_axpy(samples->sun, samples->sun, cos(config->sun_elevation) * sin(config->sun_azimuth),
            camera->right);
    v3_axpy(samples->sun, samples->sun, sin(config->sun_elevation), camera->up);
    (void)v3_unit(samples->sun, samples->sun);
    v3_frame(samples->sun, samples->sun_a, samples->sun_b);
    v3_axpy(shader->zenith, camera->up, 0.35, camera->back);
    (void)v3_unit(shader->zenith, shader->zenith);
    return clx_samples_keep(samples, (int64_t)config->width * config->height);
}

void clx_shader_free(clx_shader *shader)
{
    clx_samples_free(&shader->samples);
}

/// Sky colour at height t of its gradient: 0 at the nadir, 1 at the zenith.
static void sky_colour(double t, double rgb[3])
{
    static const double below[3] = {0.36, 0.36, 0.37};
    static const double above[3] = {1.02, 1.10, 1.20};
    for (int k = 0; k < 3; ++k) {
        rgb[k] = below[k] + t * (above[k] - below[k]);
    }
}

/// Sky in a direction: height s^2 (3 - 2 s), s = (1 + cosine) / 2, which is (2 + 3 c - c^3) / 4.
static void sky_at(const clx_shader *shader, const double direction[3], double rgb[3])
{
    const double c = v3_dot(direction, shader->zenith);
    sky_colour(0.25 * (2.0 + 3.0 * c - c * c * c), rgb);
}

/// Mean of the whole sky over a surface by the cosine law: the means of c and c^3 are 2/3 and 2/5
/// of the normal's own cosine.
static void sky_mean(const clx_shader *shader, const double normal[3], double rgb[3])
{
    sky_colour(0.5 + 0.4 * v3_dot(normal, shader->zenith), rgb);
}

/// Direction of a sky ray about a unit normal.
static void sky_direction(const double normal[3], const clx_sky_ray *ray, double direction[3])
{
    CLAST_ASSERT(v3_is_unit(normal, 1e-6));
    double a[3];
    double b[3];
    v3_frame(normal, a, b);
    v3_scale(direction, ray->up, normal);
    v3_axpy(direction, direction, ray->across[0], a);
    v3_axpy(direction, direction, ray->across[1], b);
}

/// Mean sky over the free directions, and the share of blocked ones. Only what is blocked is
/// sampled: an open surface gets its exact mean.
static double sky_seen(const clx_shader *shader, sample_place at, const clx_scene_hit *hit,
                       double rgb[3])
{
    const int32_t n_ray = shader->samples.n_sky;
    int32_t n_blocked = 0;
    sky_mean(shader, hit->normal, rgb);
    for (int32_t i = 0; i < n_ray; ++i) {
        const clx_sky_ray ray = clx_sky_ray_at(&shader->samples, at.x, at.y, at.number, i);
        double direction[3];
        double light[3];
        sky_direction(hit->normal, &ray, direction);
        if ((!hit->is_lifted && v3_dot(direction, hit->face) <= 0.0) ||
            clx_scene_blocked(shader->scene, hit->point, direction, shader->lift, INFINITY)) {
            ++n_blocked;
            sky_at(shader, direction, light);
            v3_axpy(rgb, rgb, -1.0 / n_ray, light);
        }
    }
    return (double)n_blocked / n_ray;
}

/// Cosine and highlight of the sun at a surface, 0 when hidden.
static void sun_seen(const clx_shader *shader, const double direction[3], const clx_scene_hit *hit,
                     const double view[3], double *diffuse, double *glint)
{
    double middle[3];
    const double cosine = v3_dot(direction, hit->normal);
    *diffuse = 0.0;
    *glint = 0.0;
    if (cosine <= 0.0 || (!hit->is_lifted && v3_dot(direction, hit->face) <= 0.0) ||
        clx_scene_blocked(shader->scene, hit->point, direction, shader->lift, INFINITY)) {
        return;
    }
    v3_sub(middle, direction, view);
    (void)v3_unit(middle, middle);
    *diffuse = cosine;
    *glint = 0.10 * pow(fmax(0.0, v3_dot(middle, hit->normal)), 24.0);
}

/// What a sample saw: nothing, the ground or a grain; in the sun or not; under the whole sky or
/// not. A pixel of equal open samples has converged but for the gradient of its shading.
typedef struct {
    int32_t grain; ///< -1: nothing, -2: ground
    bool in_sun;
    bool is_open;
} sighting;

/// Light that a surface sends to the viewer.
static sighting shade_surface(const clx_shader *shader, sample_place at, const double sun[3],
                              const clx_scene_hit *hit, const double view[3], double rgba[4])
{
    static const double sun_colour[3] = {1.06, 1.0, 0.91};
    const double *albedo = shader->scene->grain[hit->grain].albedo;
    double diffuse = 0.0;
    double glint = 0.0;
    double sky_rgb[3];
    sun_seen(shader, sun, hit, view, &diffuse, &glint);
    const double blocked = sky_seen(shader, at, hit, sky_rgb);
    for (int k = 0; k < 3; ++k) {
        const double passed_on = 0.45 * albedo[k] * blocked;
        rgba[k] = albedo[k] * (shader->sun_light * diffuse * sun_colour[k] +
                               shader->sky_light * (sky_rgb[k] + passed_on)) +
                  shader->sun_light * glint * sun_colour[k];
    }
    rgba[3] = 1.0;
    return (sighting){hit->grain, diffuse > 0.0, blocked == 0.0};
}

/// Shadow on the ground: black, as opaque as light is missing.
static sighting shade_ground(const clx_shader *shader, sample_place at, const double sun[3],
                             const double point[3], double rgba[4])
{
    const double depth = 0.75;
    clx_scene_hit hit = {.grain = -1};
    double light[3];
    hit.face[shader->up] = 1.0;
    hit.normal[shader->up] = 1.0;
    v3_copy(hit.point, point);
    const double blocked = sky_seen(shader, at, &hit, light);
    const double cosine = fmax(0.0, sun[shader->up]);
    const bool dark =
        cosine > 0.0 && clx_scene_blocked(shader->scene, point, sun, shader->lift, INFINITY);
    const double all = shader->sun_light * cosine + shader->sky_light;
    const double missing = shader->sky_light * blocked + (dark ? shader->sun_light * cosine : 0.0);
    rgba[3] = depth * missing / all;
    return (sighting){-2, !dark, blocked == 0.0};
}

/// The section of a grain that the cut opens, if the ray enters the kept side inside one.
static bool hit_section(const clx_shader *shader, const double origin[3], const double direction[3],
                        double t, clx_scene_hit *hit)
{
    double point[3];
    v3_axpy(point, origin, t, direction);
    const int32_t grain = clx_scene_holder(shader->scene, point);
    if (grain < 0) {
        return false;
    }
    *hit = (clx_scene_hit){.t = t, .grain = grain};
    v3_copy(hit->point, point);
    v3_copy(hit->face, shader->scene->cut.normal);
    v3_copy(hit->normal, shader->scene->cut.normal);
    return true;
}

static sighting shade_sample(const clx_shader *shader, sample_place at, double rgba[4])
{
    const clx_sample sample = clx_sample_at(&shader->samples, at.x, at.y, at.number);
    double origin[3];
    double direction[3];
    double t_low = 0.0;
    double t_high = INFINITY;
    bool is_entered = false;
    clx_scene_hit hit;
    rgba[0] = rgba[1] = rgba[2] = rgba[3] = 0.0;
    clx_camera_ray(&shader->camera, at.x + 0.5 + sample.offset[0], at.y + 0.5 + sample.offset[1],
                   origin, direction);
    if (clx_scene_clip(shader->scene, origin, direction, &t_low, &t_high, &is_entered) &&
        ((is_entered && hit_section(shader, origin, direction, t_low, &hit)) ||
         clx_scene_hit_first(shader->scene, origin, direction, 0.0, INFINITY, &hit))) {
        return shade_surface(shader, at, sample.sun, &hit, direction, rgba);
    }
    if (shader->has_ground && direction[shader->up] < 0.0) {
        double point[3];
        const double height = origin[shader->up] - shader->ground;
        v3_axpy(point, origin, -height / direction[shader->up], direction);
        if (height > 0.0 || !shader->camera.is_perspective) {
            return shade_ground(shader, at, sample.sun, point, rgba);
        }
    }
    return (sighting){-1, false, true};
}

static bool is_same(const sighting *a, const sighting *b)
{
    return a->grain == b->grain && a->in_sun == b->in_sun;
}

void clx_shade_pixel(const clx_shader *shader, int32_t x, int32_t y, double rgba[4])
{
    const int32_t most = shader->samples.n;
    const int32_t enough = most > 6 ? (most + 2) / 3 : most;
    double sum[4] = {0.0, 0.0, 0.0, 0.0};
    sighting first = {0};
    bool is_plain = true;
    int32_t n = 0;
    // A third of the samples will do where all of them see the same thing in the same light.
    for (; n < most && !(is_plain && n >= enough); ++n) {
        double one[4];
        const sighting seen = shade_sample(shader, (sample_place){x, y, n}, one);
        first = n == 0 ? seen : first;
        is_plain = is_plain && seen.is_open && is_same(&seen, &first);
        for (int k = 0; k < 4; ++k) {
            sum[k] += one[k];
        }
    }
    for (int k = 0; k < 4; ++k) {
        rgba[k] = sum[k] / n;
    }
}
