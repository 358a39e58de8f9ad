// One pixel: camera samples from a low-discrepancy sequence, each with one ray to the sun's disc
// and a few to the sky.
//
// Samples: additive recurrences of the plastic-number family (Roberts 2018), shifted for each pixel
// by a dither square made from the seed, so a pixel's value depends on nothing but its place.
// Light: Lambert, plus a faint highlight; the sky is a vertical gradient sampled by the cosine law;
// a blocked sky ray returns a share of the surface's own colour (light passed between grains).
#include "render/shade.h"

#include "math/vec3.h"

/// Powers of 1 / (real root of x^5 = x + 1): the four-dimensional recurrence.
static const double step4[4] = {0.8566748838545029, 0.7338918566271260, 0.6287067210378087,
                                0.5385972572236101};
/// Powers of 1 / plastic number (x^3 = x + 1): the two-dimensional one.
static const double step2[2] = {0.7548776662466927, 0.5698402909980532};

/// One camera ray's numbers.
typedef struct {
    int32_t number;
    double u[4];         ///< 0 and 1: place in the pixel; 2 and 3: on the sun's disc
    double sky_shift[2]; ///< of the pixel's sky rays
} sample_numbers;

static double fraction(double x)
{
    return x - floor(x);
}

void clx_shader_set(clx_shader *shader, const clx_scene *scene, const clast_render_config *config,
                    const clx_camera *camera)
{
    const double strength = 1.4; // of all light: a grain that faces the sun shows its own colour
    *shader = (clx_shader){.scene = scene,
                           .camera = *camera,
                           .sun_tangent = tan(config->sun_radius),
                           .sun_light = strength * (1.0 - config->ambient),
                           .sky_light = strength * config->ambient,
                           .lift = 1e-6 * scene->radius,
                           .has_ground = config->ground,
                           .up = config->up,
                           .ground = scene->low[config->up],
                           .samples = config->samples,
                           .ambient_rays = config->ambient_rays};
    clx_dither_fill(config->seed, &shader->dither);
    // Sun and sky turn with the viewer, so that every side of an object is seen in the same light.
    v3_scale(shader->sun, cos(config->sun_elevation) * cos(config->sun_azimuth), camera->back);
    v3_axpy(shader->sun, shader->sun, cos(config->sun_elevation) * sin(config->sun_azimuth),
            camera->right);
    v3_axpy(shader->sun, shader->sun, sin(config->sun_elevation), camera->up);
    (void)v3_unit(shader->sun, shader->sun);
    v3_frame(shader->sun, shader->sun_a, shader->sun_b);
    v3_axpy(shader->zenith, camera->up, 0.35, camera->back);
    (void)v3_unit(shader->zenith, shader->zenith);
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

/// Direction to a point of the sun's disc; u, v in [0, 1).
static void sun_direction(const clx_shader *shader, double u, double v, double direction[3])
{
    const double r = shader->sun_tangent * sqrt(u);
    const double angle = 2.0 * CLAST_PI * v;
    v3_axpy(direction, shader->sun, r * cos(angle), shader->sun_a);
    v3_axpy(direction, direction, r * sin(angle), shader->sun_b);
    (void)v3_unit(direction, direction);
}

/// Direction about a unit normal with density cosine / pi.
static void cosine_direction(const double normal[3], double u, double v, double direction[3])
{
    CLAST_ASSERT(v3_is_unit(normal, 1e-6) && u >= 0.0 && u <= 1.0);
    double a[3];
    double b[3];
    const double r = sqrt(u);
    const double angle = 2.0 * CLAST_PI * v;
    v3_frame(normal, a, b);
    v3_scale(direction, sqrt(1.0 - u), normal);
    v3_axpy(direction, direction, r * cos(angle), a);
    v3_axpy(direction, direction, r * sin(angle), b);
}

/// Mean sky over the free directions, and the share of blocked ones. Only what is blocked is
/// sampled: an open surface gets its exact mean.
static double sky_seen(const clx_shader *shader, const sample_numbers *sample,
                       const clx_scene_hit *hit, double rgb[3])
{
    int32_t n_blocked = 0;
    sky_mean(shader, hit->normal, rgb);
    for (int32_t i = 0; i < shader->ambient_rays; ++i) {
        const double index = 1.0 + (double)sample->number * shader->ambient_rays + i;
        double direction[3];
        double light[3];
        cosine_direction(hit->normal, fraction(sample->sky_shift[0] + index * step2[0]),
                         fraction(sample->sky_shift[1] + index * step2[1]), direction);
        if ((!hit->is_lifted && v3_dot(direction, hit->face) <= 0.0) ||
            clx_scene_blocked(shader->scene, hit->point, direction, shader->lift, INFINITY)) {
            ++n_blocked;
            sky_at(shader, direction, light);
            v3_axpy(rgb, rgb, -1.0 / shader->ambient_rays, light);
        }
    }
    return (double)n_blocked / shader->ambient_rays;
}

/// Cosine and highlight of the sun at a surface, 0 when hidden.
static void sun_seen(const clx_shader *shader, const double u[2], const clx_scene_hit *hit,
                     const double view[3], double *diffuse, double *glint)
{
    double direction[3];
    double middle[3];
    sun_direction(shader, u[0], u[1], direction);
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
static sighting shade_surface(const clx_shader *shader, const sample_numbers *sample,
                              const clx_scene_hit *hit, const double view[3], double rgba[4])
{
    static const double sun_colour[3] = {1.06, 1.0, 0.91};
    const double *albedo = shader->scene->grain[hit->grain].albedo;
    double diffuse = 0.0;
    double glint = 0.0;
    double sky_rgb[3];
    sun_seen(shader, sample->u + 2, hit, view, &diffuse, &glint);
    const double blocked = sky_seen(shader, sample, hit, sky_rgb);
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
static sighting shade_ground(const clx_shader *shader, const sample_numbers *sample,
                             const double point[3], double rgba[4])
{
    const double depth = 0.75;
    clx_scene_hit hit = {.grain = -1};
    double direction[3];
    double light[3];
    hit.face[shader->up] = 1.0;
    hit.normal[shader->up] = 1.0;
    v3_copy(hit.point, point);
    const double blocked = sky_seen(shader, sample, &hit, light);
    sun_direction(shader, sample->u[2], sample->u[3], direction);
    const double cosine = fmax(0.0, direction[shader->up]);
    const bool dark =
        cosine > 0.0 && clx_scene_blocked(shader->scene, point, direction, shader->lift, INFINITY);
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

static sighting shade_sample(const clx_shader *shader, const sample_numbers *sample,
                             const double at[2], double rgba[4])
{
    double origin[3];
    double direction[3];
    double t_low = 0.0;
    double t_high = INFINITY;
    bool is_entered = false;
    clx_scene_hit hit;
    rgba[0] = rgba[1] = rgba[2] = rgba[3] = 0.0;
    clx_camera_ray(&shader->camera, at[0], at[1], origin, direction);
    if (clx_scene_clip(shader->scene, origin, direction, &t_low, &t_high, &is_entered) &&
        ((is_entered && hit_section(shader, origin, direction, t_low, &hit)) ||
         clx_scene_hit_first(shader->scene, origin, direction, 0.0, INFINITY, &hit))) {
        return shade_surface(shader, sample, &hit, direction, rgba);
    }
    if (shader->has_ground && direction[shader->up] < 0.0) {
        double point[3];
        const double height = origin[shader->up] - shader->ground;
        v3_axpy(point, origin, -height / direction[shader->up], direction);
        if (height > 0.0 || !shader->camera.is_perspective) {
            return shade_ground(shader, sample, point, rgba);
        }
    }
    return (sighting){-1, false, true};
}

/// Offset in [-1, 1] with the density of a tent: soft edges without a blur.
static double tent(double u)
{
    CLAST_ASSERT(u >= 0.0 && u <= 1.0);
    return u < 0.5 ? sqrt(2.0 * u) - 1.0 : 1.0 - sqrt(2.0 - 2.0 * u);
}

static bool is_same(const sighting *a, const sighting *b)
{
    return a->grain == b->grain && a->in_sun == b->in_sun;
}

void clx_shade_pixel(const clx_shader *shader, int32_t x, int32_t y, double rgba[4])
{
    const int32_t enough = shader->samples > 6 ? (shader->samples + 2) / 3 : shader->samples;
    double shift[6];
    double sum[4] = {0.0, 0.0, 0.0, 0.0};
    sighting first = {0};
    bool is_plain = true;
    int32_t n = 0;
    for (int k = 0; k < 6; ++k) {
        shift[k] = clx_dither_at(&shader->dither, x, y, k);
    }
    // A third of the samples will do where all of them see the same thing in the same light.
    for (; n < shader->samples && !(is_plain && n >= enough); ++n) {
        sample_numbers sample = {.number = n, .sky_shift = {shift[4], shift[5]}};
        double one[4];
        for (int k = 0; k < 4; ++k) {
            sample.u[k] = fraction(shift[k] + (n + 1) * step4[k]);
        }
        const double at[2] = {x + 0.5 + 0.75 * tent(sample.u[0]),
                              y + 0.5 + 0.75 * tent(sample.u[1])};
        const sighting seen = shade_sample(shader, &sample, at, one);
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
