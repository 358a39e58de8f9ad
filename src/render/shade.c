// A block of pixels: camera samples from a low-discrepancy sequence, each with one ray to the sun's
// disc and a few to the sky. Cameras' and suns' rays of neighbouring pixels go in bundles; those to
// the sky spread too far: in bundles by direction (25 degrees) a picture took 1.6 times as long.
//
// Light: Lambert, plus a faint highlight; the sky is a vertical gradient sampled by the cosine law;
// a blocked sky ray returns a share of the surface's own colour (light passed between grains).
#include "render/shade.h"

#include "math/vec3.h"
#include "render/travel.h"

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
    return clx_samples_allocate(samples, (int64_t)config->width * config->height);
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

/// What a sample saw instead of a grain.
enum { NOTHING = -1, GROUND = -2 };

/// A sample of a pixel on its way: what it met, how that is lit.
typedef struct {
    int32_t x, y, number; ///< pixel, and which of its samples
    int32_t pixel;        ///< of the block
    clx_scene_hit hit;    ///< its grain may be NOTHING or GROUND
    double view[3];       ///< direction from the camera
    double ray[3];        ///< direction of the next ray
    double diffuse;       ///< cosine of the sun, 0 when hidden
    double glint;
    double sky[3]; ///< mean light of the free directions
    int32_t n_blocked;
    bool is_blocked; ///< the next ray
} look;

/// Sends rays of the samples listed to what may block them, in bundles of at most n_bundle.
static void send_shadow_rays(const clx_shader *shader, int n, const int32_t *list, int n_bundle,
                             look *all)
{
    double origin[CLX_BUNDLE][3];
    double direction[CLX_BUNDLE][3];
    for (int first = 0; first < n; first += n_bundle) {
        const int n_ray = n - first < n_bundle ? n - first : n_bundle;
        for (int r = 0; r < n_ray; ++r) {
            v3_copy(origin[r], all[list[first + r]].hit.point);
            v3_copy(direction[r], all[list[first + r]].ray);
        }
        const uint32_t blocked =
            clx_scene_blocked(shader->scene, n_ray, origin, direction, shader->lift);
        for (int r = 0; r < n_ray; ++r) {
            all[list[first + r]].is_blocked = (blocked >> r & 1) != 0;
        }
    }
}

/// True when the surface itself hides what is in a direction.
static bool is_behind(const clx_scene_hit *hit, const double direction[3])
{
    return !hit->is_lifted && v3_dot(direction, hit->face) <= 0.0;
}

/// Mean sky over the free directions, and how many are blocked. Only what is blocked is sampled: an
/// open surface gets its exact mean.
static void look_at_sky(const clx_shader *shader, int n, look *all)
{
    const int32_t n_ray = shader->samples.n_sky;
    int32_t list[CLX_SHADE_LOOKS] = {0};
    for (int32_t i = 0; i < n_ray; ++i) {
        int n_list = 0; // of free directions, as far as the surface itself goes
        for (int k = 0; k < n; ++k) {
            look *l = &all[k];
            if (l->hit.grain == NOTHING) {
                continue;
            }
            const clx_sky_ray ray = clx_sky_ray_at(&shader->samples, l->x, l->y, l->number, i);
            if (i == 0) {
                sky_mean(shader, l->hit.normal, l->sky);
            }
            sky_direction(l->hit.normal, &ray, l->ray);
            l->is_blocked = is_behind(&l->hit, l->ray);
            list[n_list] = k;
            n_list += !l->is_blocked;
        }
        send_shadow_rays(shader, n_list, list, 1, all);
        for (int k = 0; k < n; ++k) {
            if (all[k].hit.grain != NOTHING && all[k].is_blocked) {
                double light[3];
                ++all[k].n_blocked;
                sky_at(shader, all[k].ray, light);
                v3_axpy(all[k].sky, all[k].sky, -1.0 / n_ray, light);
            }
        }
    }
}

/// Cosine and highlight of the sun, 0 where it is hidden.
static void look_at_sun(const clx_shader *shader, int n, look *all)
{
    int32_t list[CLX_SHADE_LOOKS] = {0};
    int n_list = 0;
    for (int k = 0; k < n; ++k) {
        look *l = &all[k];
        list[n_list] = k;
        n_list += l->hit.grain != NOTHING && v3_dot(l->ray, l->hit.normal) > 0.0 &&
                  !is_behind(&l->hit, l->ray);
    }
    send_shadow_rays(shader, n_list, list, CLX_BUNDLE, all);
    for (int i = 0; i < n_list; ++i) {
        look *l = &all[list[i]];
        double middle[3];
        if (!l->is_blocked) {
            v3_sub(middle, l->ray, l->view);
            (void)v3_unit(middle, middle);
            l->diffuse = v3_dot(l->ray, l->hit.normal);
            l->glint = 0.10 * pow(fmax(0.0, v3_dot(middle, l->hit.normal)), 24.0);
        }
    }
}

/// Light that a surface sends to the viewer.
static void shade_surface(const clx_shader *shader, const look *l, double rgba[4])
{
    static const double sun_colour[3] = {1.06, 1.0, 0.91};
    const double *albedo = shader->scene->grain[l->hit.grain].albedo;
    const double blocked = (double)l->n_blocked / shader->samples.n_sky;
    for (int k = 0; k < 3; ++k) {
        const double passed_on = 0.45 * albedo[k] * blocked;
        rgba[k] = albedo[k] * (shader->sun_light * l->diffuse * sun_colour[k] +
                               shader->sky_light * (l->sky[k] + passed_on)) +
                  shader->sun_light * l->glint * sun_colour[k];
    }
    rgba[3] = 1.0;
}

/// Shadow on the ground: black, as opaque as light is missing.
static void shade_ground(const clx_shader *shader, const look *l, const double sun[3],
                         double rgba[4])
{
    const double depth = 0.75;
    const double blocked = (double)l->n_blocked / shader->samples.n_sky;
    const double cosine = fmax(0.0, sun[shader->up]);
    const bool dark = cosine > 0.0 && !(l->diffuse > 0.0);
    const double all = shader->sun_light * cosine + shader->sky_light;
    const double missing = shader->sky_light * blocked + (dark ? shader->sun_light * cosine : 0.0);
    rgba[0] = rgba[1] = rgba[2] = 0.0;
    rgba[3] = all > 0.0 ? depth * missing / all : 0.0; // no light, no shadow
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

/// The ground under a ray that meets no grain, if there is any.
static void hit_ground(const clx_shader *shader, const double origin[3], const double direction[3],
                       clx_scene_hit *hit)
{
    const double height = origin[shader->up] - shader->ground;
    if (shader->has_ground && direction[shader->up] < 0.0 &&
        (height > 0.0 || !shader->camera.is_perspective)) {
        *hit = (clx_scene_hit){.grain = GROUND};
        hit->face[shader->up] = 1.0;
        hit->normal[shader->up] = 1.0;
        v3_axpy(hit->point, origin, -height / direction[shader->up], direction);
    }
}

/// What the camera's rays meet, and directions to the sun.
static void look_ahead(const clx_shader *shader, int n, look *all)
{
    double origin[CLX_BUNDLE][3];
    double direction[CLX_BUNDLE][3];
    clx_scene_hit hit[CLX_BUNDLE];
    for (int first = 0; first < n; first += CLX_BUNDLE) {
        const int n_ray = n - first < CLX_BUNDLE ? n - first : CLX_BUNDLE;
        for (int r = 0; r < n_ray; ++r) {
            look *l = &all[first + r];
            const clx_sample sample = clx_sample_at(&shader->samples, l->x, l->y, l->number);
            clx_camera_ray(&shader->camera, l->x + 0.5 + sample.offset[0],
                           l->y + 0.5 + sample.offset[1], origin[r], direction[r]);
            v3_copy(l->view, direction[r]);
            v3_copy(l->ray, sample.sun);
        }
        const uint32_t found =
            clx_scene_hit_first(shader->scene, n_ray, origin, direction, 0.0, hit);
        for (int r = 0; r < n_ray; ++r) {
            look *l = &all[first + r];
            double t_low = 0.0;
            double t_high = INFINITY;
            bool is_entered = false;
            l->hit.grain = NOTHING;
            if (clx_scene_clip(shader->scene, origin[r], direction[r], &t_low, &t_high,
                               &is_entered) &&
                is_entered && hit_section(shader, origin[r], direction[r], t_low, &l->hit)) {
                continue;
            }
            if ((found >> r & 1) != 0) {
                l->hit = hit[r];
            } else {
                hit_ground(shader, origin[r], direction[r], &l->hit);
            }
        }
    }
}

/// A pixel while its samples are taken. One of equal open samples has converged but for the
/// gradient of its shading.
typedef struct {
    double sum[4];
    int32_t x, y;
    int32_t n;     ///< samples taken
    int32_t grain; ///< that the first one saw, or NOTHING or GROUND
    bool in_sun;   ///< the first one
    bool is_plain; ///< all saw the same in the same light under the whole sky
} block_pixel;

static void add_look(const clx_shader *shader, const look *l, block_pixel *p)
{
    double rgba[4] = {0.0, 0.0, 0.0, 0.0};
    bool in_sun = l->diffuse > 0.0;
    if (l->hit.grain >= 0) {
        shade_surface(shader, l, rgba);
    } else if (l->hit.grain == GROUND) {
        const clx_sample sample = clx_sample_at(&shader->samples, l->x, l->y, l->number);
        shade_ground(shader, l, sample.sun, rgba);
        in_sun = in_sun || !(sample.sun[shader->up] > 0.0);
    }
    if (p->n == 0) {
        p->grain = l->hit.grain;
        p->in_sun = in_sun;
    }
    p->is_plain =
        p->is_plain && l->n_blocked == 0 && l->hit.grain == p->grain && in_sun == p->in_sun;
    for (int k = 0; k < 4; ++k) {
        p->sum[k] += rgba[k];
    }
    ++p->n;
}

/// Lists samples of the pixels that need more, as many as there is room for; their number.
static int list_looks(const clx_shader *shader, int n_pixel, const block_pixel *pixel, look *all)
{
    const int32_t most = shader->samples.n;
    // A third of the samples will do where all of them see the same thing in the same light.
    const int32_t enough = most > 6 ? (most + 2) / 3 : most;
    int n = 0;
    for (int i = 0; i < n_pixel; ++i) {
        const block_pixel *p = &pixel[i];
        const int32_t end = p->is_plain ? enough : most;
        for (int32_t number = p->n; number < end && n < CLX_SHADE_LOOKS; ++number) {
            all[n++] = (look){.x = p->x, .y = p->y, .number = number, .pixel = i};
        }
    }
    return n;
}

void clx_shade_block(const clx_shader *shader, const int32_t low[2], const int32_t high[2],
                     double (*rgba)[4])
{
    look all[CLX_SHADE_LOOKS];
    block_pixel pixel[CLX_SHADE_SIDE * CLX_SHADE_SIDE];
    int n_pixel = 0;
    for (int32_t y = low[1]; y < high[1]; ++y) {
        for (int32_t x = low[0]; x < high[0]; ++x) {
            pixel[n_pixel++] = (block_pixel){.x = x, .y = y, .is_plain = true};
        }
    }
    for (int n; (n = list_looks(shader, n_pixel, pixel, all)) > 0;) {
        look_ahead(shader, n, all);
        look_at_sun(shader, n, all);
        look_at_sky(shader, n, all);
        for (int i = 0; i < n; ++i) {
            add_look(shader, &all[i], &pixel[all[i].pixel]);
        }
    }
    for (int i = 0; i < n_pixel; ++i) {
        for (int k = 0; k < 4; ++k) {
            rgba[i][k] = pixel[i].sum[k] / pixel[i].n;
        }
    }
}
