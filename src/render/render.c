// From an assembly to an image: scene, colours, layout, camera, tiles, labels.
#include <clast/render.h>

#include "assembly/whole.h"
#include "base/field.h"
#include "base/monitor.h"
#include "base/parallel.h"
#include "math/vec3.h"
#include "render/label.h"
#include "render/shade.h"
#include <clast/assembly.h>
#include <string.h>

enum { TILE = CLX_SHADE_SIDE, BAND = 64 / TILE };

#define FIELD(type, name) #name, .offset = offsetof(clast_render_config, name), type
const clast_field clast_render_fields[] = {
    {FIELD(CLAST_FIELD_I32, width), 1600, 64, 16384, "-", "pixels", NULL, .common = true,
     .group = "picture"},
    {FIELD(CLAST_FIELD_I32, height), 1200, 64, 16384, "-", "pixels", NULL, .common = true},
    {FIELD(CLAST_FIELD_I32, samples), 16, 1, 4096, "-", "camera rays a pixel", NULL,
     .common = true},
    {FIELD(CLAST_FIELD_I32, ambient_rays), 1, 1, 256, "-", "sky rays a camera ray", NULL},
    {FIELD(CLAST_FIELD_CHOICE, projection), 0, 0, 0, "-", "how depth is shown",
     "orthographic|perspective", .group = "view"},
    {FIELD(CLAST_FIELD_CHOICE, up), CLAST_RENDER_UP_Z, 0, 0, "-", "axis that points up", "x|y|z"},
    {FIELD(CLAST_FIELD_F64, azimuth), -0.9599310885968813, -20.0, 20.0, "rad",
     "of the viewer about the up axis", NULL, .common = true},
    {FIELD(CLAST_FIELD_F64, elevation), 0.4363323129985824, -0.5 * CLAST_PI, 0.5 * CLAST_PI, "rad",
     "of the viewer above the horizontal", NULL, .common = true},
    {FIELD(CLAST_FIELD_F64, field_of_view), 0.4363323129985824, 0.01, 2.5, "rad",
     "perspective: angle of the picture's height", NULL},
    {FIELD(CLAST_FIELD_F64, zoom), 1.0, 1e-3, 1e3, "-", "1: everything just fits", NULL,
     .common = true},
    {FIELD(CLAST_FIELD_CHOICE, colour), 0, 0, 0, "-",
     "what colours mean; auto: size where sizes differ", "auto|single|size|order|shape",
     .common = true, .group = "colours"},
    {FIELD(CLAST_FIELD_TEXT, tint), 0, 0, 0, "-", "single colour, #rrggbb", "#c9b79c"},
    {FIELD(CLAST_FIELD_CHOICE, scale), 0, 0, 0, "-",
     "of the colour bar; auto: log for sizes over a factor 4", "auto|linear|log"},
    {FIELD(CLAST_FIELD_CHOICE, shading), 0, 0, 0, "-",
     "smooth rounds facets that meet below 50 degrees", "smooth|flat"},
    {FIELD(CLAST_FIELD_CHOICE, background), 0, 0, 0, "-", "behind the grains",
     "white|transparent|black", .common = true, .group = "ground, cut and bars"},
    {FIELD(CLAST_FIELD_BOOL, ground), 0, 0, 1, "-", "shadow on a plane under the grains", NULL},
    {FIELD(CLAST_FIELD_CHOICE, cut), 0, 0, 0, "-",
     "cut away the half nearer to the viewer: by a plane across this axis", "none|x|y|z|view",
     .common = true},
    {FIELD(CLAST_FIELD_F64, cut_position), 0.5, 0.0, 1.0, "-",
     "position of the cut in the extent along its axis", NULL},
    {FIELD(CLAST_FIELD_BOOL, colour_bar), 1, 0, 1, "-", "legend of the colours", NULL},
    {FIELD(CLAST_FIELD_BOOL, scale_bar), 1, 0, 1, "-",
     "bar of a round length, in perspective at the centre", NULL},
    {FIELD(CLAST_FIELD_TEXT, unit), 0, 0, 0, "-",
     "unit of the coordinates where the input has none (um, mm, m)", "", .common = true},
    {FIELD(CLAST_FIELD_F64, sun_azimuth), -0.6981317007977318, -CLAST_PI, CLAST_PI, "rad",
     "of the sun, to the right of the viewer", NULL, .group = "light"},
    {FIELD(CLAST_FIELD_F64, sun_elevation), 0.7853981633974483, -0.5 * CLAST_PI, 0.5 * CLAST_PI,
     "rad", "of the sun above the line of sight", NULL},
    {FIELD(CLAST_FIELD_F64, sun_radius), 0.05235987755982989, 0.0, 1.0, "rad",
     "half-angle of the sun's disc: softness of shadows", NULL},
    {FIELD(CLAST_FIELD_F64, ambient), 0.45, 0.0, 1.0, "-", "share of the light from the sky", NULL},
    {FIELD(CLAST_FIELD_U64, seed), 1, 0, 1e18, "-", "of the samples' shifts", NULL},
    {0}};

const clast_idle *clast_render_idle(const clast_render_config *c, clast_idle rules[CLAST_N_IDLE])
{
    if (c == NULL || rules == NULL) {
        return NULL;
    }
    const bool is_single = c->colour == CLAST_RENDER_COLOUR_SINGLE;
    const bool is_shape = c->colour == CLAST_RENDER_COLOUR_SHAPE;
    const bool is_tinted = is_single || c->colour == CLAST_RENDER_COLOUR_AUTO;
    const clast_idle made[CLAST_N_IDLE] = {
        {!is_tinted, "tint", "without --colour single"},
        {is_single || is_shape, "scale", "without --colour size or order"},
        {is_single, "colour_bar", "with --colour single"},
        {c->projection == CLAST_RENDER_ORTHOGRAPHIC, "field_of_view",
         "without --projection perspective"},
        {c->cut == CLAST_RENDER_CUT_NONE, "cut_position", "without --cut"},
        {c->ambient == 0.0, "ambient_rays", "with --ambient 0"},
        {c->ambient == 1.0, "sun_azimuth|sun_elevation|sun_radius", "with --ambient 1"}};
    return clx_idle_copy(made, rules);
}

typedef struct {
    const clx_shader *shader;
    const clast_render_config *config;
    clast_image *image;
    int32_t tiles_across;
    int32_t first_tile;
} picture;

/// sRGB byte of linear light; highlights are bent below white from 0.8 on.
static uint8_t encode(double light)
{
    const double bent = light <= 0.8 ? light : 0.8 + 0.2 * (1.0 - exp(-(light - 0.8) / 0.2));
    const double s = bent <= 0.0031308 ? 12.92 * bent : 1.055 * pow(bent, 1.0 / 2.4) - 0.055;
    return (uint8_t)lround(255.0 * fmin(fmax(s, 0.0), 1.0));
}

/// Straight sRGB pixel of premultiplied linear light. Over a background the mixing is done on
/// encoded values, as every viewer does with a transparent PNG.
static void store(const double light[4], int32_t background, uint8_t rgba[4])
{
    const double alpha = light[3];
    const double below = background == CLAST_RENDER_WHITE ? 255.0 : 0.0;
    for (int k = 0; k < 3; ++k) {
        const double own = alpha > 0.0 ? encode(light[k] / alpha) : 0.0;
        rgba[k] = background == CLAST_RENDER_TRANSPARENT
                      ? (uint8_t)own
                      : (uint8_t)lround(alpha * own + (1.0 - alpha) * below);
    }
    rgba[3] = background == CLAST_RENDER_TRANSPARENT ? (uint8_t)lround(255.0 * alpha) : 255;
}

static void draw_tiles(int64_t begin, int64_t end, int32_t worker, void *context)
{
    picture *p = context;
    const int32_t size[2] = {p->image->width, p->image->height};
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        const int32_t tile[2] = {(p->first_tile + (int32_t)i) % p->tiles_across,
                                 (p->first_tile + (int32_t)i) / p->tiles_across};
        double light[TILE * TILE][4];
        int32_t low[2];
        int32_t high[2];
        for (int k = 0; k < 2; ++k) {
            low[k] = tile[k] * TILE;
            high[k] = low[k] + TILE < size[k] ? low[k] + TILE : size[k];
        }
        clx_shade_block(p->shader, low, high, light);
        for (int32_t n = 0, y = low[1]; y < high[1]; ++y) {
            for (int32_t x = low[0]; x < high[0]; ++x) {
                store(light[n++], p->config->background,
                      p->image->rgba + 4 * ((ptrdiff_t)y * p->image->width + x));
            }
        }
    }
}

/// All tiles, in bands between which the monitor is asked.
static clast_status draw(picture *p, const clast_monitor *monitor)
{
    p->tiles_across = (p->image->width + TILE - 1) / TILE;
    const int32_t tiles_down = (p->image->height + TILE - 1) / TILE;
    for (int32_t row = 0; row < tiles_down; row += BAND) {
        const int32_t n_row = tiles_down - row < BAND ? tiles_down - row : BAND;
        if (clx_monitor_stops(monitor)) {
            return clx_fail(CLAST_E_STOPPED, "stopped at %d %% of the picture",
                            100 * row / tiles_down);
        }
        p->first_tile = row * p->tiles_across;
        clx_parallel_for((int64_t)n_row * p->tiles_across, 1, draw_tiles, p);
        clx_monitor_report(monitor, "draw", row + n_row, tiles_down);
    }
    return CLAST_OK;
}

/// Plane of the cut: normal towards the viewer's side, which is removed.
static void set_cut(const clast_render_config *config, clx_scene *scene)
{
    double right[3];
    double up[3];
    double back[3];
    double axis[3] = {0.0, 0.0, 0.0};
    if (config->cut == CLAST_RENDER_CUT_NONE) {
        return;
    }
    clx_camera_axes(config, right, up, back);
    if (config->cut == CLAST_RENDER_CUT_VIEW) {
        v3_copy(axis, back);
    } else {
        axis[config->cut - CLAST_RENDER_CUT_X] = 1.0;
    }
    const double opposite[3] = {-axis[0], -axis[1], -axis[2]};
    const double low = -clx_scene_support(scene, opposite);
    const double high = clx_scene_support(scene, axis);
    const double sign = v3_dot(axis, back) < 0.0 ? -1.0 : 1.0;
    v3_scale(scene->cut.normal, sign, axis);
    scene->cut.offset = sign * (low + config->cut_position * (high - low));
    scene->cut.is_on = true;
}

/// Metres a coordinate unit is long, 0 when nobody knows.
static clast_status length_unit(const clast_assembly *assembly, const char *unit, double *metre)
{
    clast_status status = CLAST_OK;
    double factor = 0.0;
    if (strcmp(assembly->unit, "m") == 0) {
        CLX_CHECK(unit[0] == '\0' || strcmp(unit, "m") == 0, CLAST_E_CONFIG,
                  "unit %s: the input's coordinates are metres already; leave unit out", unit);
        factor = 1.0;
    } else if (unit[0] != '\0') {
        CLX_TRY(clast_unit_factor(unit, "m", &factor));
    }
    *metre = factor;
done:
    return status;
}

clast_status clast_render_assembly(const clast_assembly *assembly,
                                   const clast_render_config *config, const clast_monitor *monitor,
                                   clast_image *image)
{
    CLX_ARGUMENTS(assembly, config, image);
    CLX_GUARD(clast_fields_check(clast_render_fields, config));
    if (clx_assembly_fault(assembly) != NULL) {
        return clx_fail(CLAST_E_GEOMETRY, "%s: assembly: %s", __func__,
                        clx_assembly_fault(assembly));
    }
    clast_status status = CLAST_OK;
    clx_scene scene = {0};
    clx_legend legend = {0};
    clx_layout layout = {0};
    clx_shader shader = {0};
    clast_image made = {0};
    double metre = 0.0;
    CLX_TRY(length_unit(assembly, config->unit, &metre));
    CLX_TRY(clx_scene_build(assembly, (clast_render_shading)config->shading, &scene));
    CLX_TRY(clx_legend_make(assembly, config, metre, &scene, &legend));
    CLX_TRY(clx_label_layout(config, &legend, &layout));
    CLX_TRY(clast_image_alloc(config->width, config->height, &made));
    const clx_camera camera = clx_camera_fit(&scene, config, &layout.frame);
    set_cut(config, &scene);
    CLX_TRY(clx_shader_set(&shader, &scene, config, &camera));
    picture p = {.shader = &shader, .config = config, .image = &made};
    made.pixel_size = camera.pixel;
    CLX_TRY(draw(&p, monitor));
    CLX_TRY(clx_label_draw(config, &layout, &legend, metre, &made));
    *image = made;
    made = (clast_image){0};
done:
    clx_shader_free(&shader);
    clast_image_free(&made);
    clx_scene_free(&scene);
    return status;
}
