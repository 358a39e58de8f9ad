/* Unit: pictures whose pixels can be counted. */
#include "base/alloc.h"
#include "math/vec3.h"
#include "render/legend.h"
#include "support.h"
#include <clast/machine.h>
#include <clast/render.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double upright[4] = {1.0, 0.0, 0.0, 0.0};

static void small_config(clast_render_config *config)
{
    CHECK_OK(clast_fields_default(clast_render_fields, config));
    config->width = 160;
    config->height = 120;
    config->samples = 4;
    config->ambient_rays = 1;
    config->background = CLAST_RENDER_TRANSPARENT;
    config->colour_bar = false;
    config->scale_bar = false;
}

static void add(clast_assembly *a, const clast_shape *shape, double x, double y, double z,
                double scale)
{
    int32_t id = 0;
    const double at[3] = {x, y, z};
    for (id = 0; id < a->n_shape; ++id) {
        if (strcmp(a->shape[id].name, shape->name) == 0) {
            break;
        }
    }
    if (id == a->n_shape) {
        CHECK_OK(clast_assembly_add_shape(a, shape, &id));
    }
    CHECK_OK(clast_assembly_add_grain(a, id, at, upright, scale, 2500.0));
}

static void one_sphere(clast_assembly *a)
{
    clast_shape ball = {0};
    CHECK_OK(clast_shape_sphere("ball", 2.0, &ball));
    add(a, &ball, 5.0, -3.0, 7.0, 0.5);
    clast_shape_free(&ball);
}

/// Sum of alpha over the picture, in pixels.
static double coverage(const clast_image *image)
{
    double sum = 0.0;
    for (int64_t i = 0; i < (int64_t)image->width * image->height; ++i) {
        sum += image->rgba[4 * i + 3] / 255.0;
    }
    return sum;
}

/* A sphere fills the free height: its silhouette is a disc of known radius, at any view. */
static void sphere_covers_its_disc(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_render_config config = {0};
    one_sphere(&a);
    small_config(&config);
    for (int view = 0; view < 3; ++view) {
        clast_image image = {0};
        config.elevation = view == 0 ? 0.4 : view == 1 ? 1.5707 : -1.0;
        config.up = view;
        CHECK_OK(clast_render_assembly(&a, &config, NULL, &image));
        const double radius = 0.5 * (120.0 - 2.0 * 0.04 * 120.0);
        CHECK_REL(image.pixel_size, 1.0 / radius, 1e-9);
        CHECK_REL(coverage(&image), CLAST_PI * radius * radius, 2e-3);
        assert_int_equal(image.rgba[3], 0);                         /* a corner */
        assert_int_equal(image.rgba[4 * (60 * 160 + 80) + 3], 255); /* the middle */
        clast_image_free(&image);
    }
    clast_fields_free(clast_render_fields, &config);
    clast_assembly_free(&a);
}

/// An ellipsoid, a mesh box, a clump and a sphere, apart from each other.
static void four_kinds(clast_assembly *a)
{
    const double axes[3] = {1.0, 0.7, 0.4};
    double centre[3][3] = {{-0.5, 0.0, 0.0}, {0.5, 0.0, 0.0}, {0.0, 0.6, 0.0}};
    double radius[3] = {0.5, 0.5, 0.4};
    clast_spheres spheres = {3, centre, radius};
    clast_shape shape[4] = {0};
    clast_mesh box = {0};
    CHECK_OK(clast_shape_ellipsoid("ellipsoid", axes, &shape[0]));
    CHECK_OK(clast_mesh_box(1.0, 1.2, 1.4, &box));
    CHECK_OK(clast_shape_mesh("box", &box, &shape[1]));
    CHECK_OK(clast_shape_clump("clump", &spheres, &shape[2]));
    CHECK_OK(clast_shape_sphere("ball", 0.5, &shape[3]));
    for (int i = 0; i < 8; ++i) {
        add(a, &shape[i % 4], 2.5 * (i % 2), 2.5 * (i / 2 % 2), 2.5 * (i / 4), 0.5 + 0.2 * i);
    }
    for (int i = 0; i < 4; ++i) {
        clast_shape_free(&shape[i]);
    }
    clast_mesh_free(&box);
}

static void bytes_are_the_same_for_any_threads(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_render_config config = {0};
    clast_image image[3] = {0};
    four_kinds(&a);
    small_config(&config);
    config.colour_bar = true;
    config.scale_bar = true;
    config.ground = true;
    config.cut = CLAST_RENDER_CUT_X;
    for (int i = 0; i < 3; ++i) {
        clast_parallel_set_threads(1 << i);
        CHECK_OK(clast_render_assembly(&a, &config, NULL, &image[i]));
        assert_memory_equal(image[i].rgba, image[0].rgba, 160 * 120 * 4);
    }
    clast_parallel_set_threads(0);
    for (int i = 0; i < 3; ++i) {
        clast_image_free(&image[i]);
    }
    clast_fields_free(clast_render_fields, &config);
    clast_assembly_free(&a);
}

/* Nothing touches the picture's edge and something comes near it, in both projections. */
static void everything_fits_into_the_frame(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_render_config config = {0};
    four_kinds(&a);
    small_config(&config);
    config.samples = 2;
    for (int view = 0; view < 12; ++view) {
        clast_image image = {0};
        config.projection = view % 2;
        config.azimuth = 1.1 * view;
        config.elevation = -1.5 + 0.27 * view;
        config.field_of_view = view % 4 == 1 ? 1.5 : 0.4;
        CHECK_OK(clast_render_assembly(&a, &config, NULL, &image));
        int32_t box[4] = {160, 120, 0, 0};
        for (int32_t y = 0; y < 120; ++y) {
            for (int32_t x = 0; x < 160; ++x) {
                if (image.rgba[4 * (y * 160 + x) + 3] != 0) {
                    box[0] = x < box[0] ? x : box[0];
                    box[1] = y < box[1] ? y : box[1];
                    box[2] = x + 1 > box[2] ? x + 1 : box[2];
                    box[3] = y + 1 > box[3] ? y + 1 : box[3];
                }
            }
        }
        /* margin 4.8 pixels, softened by up to one */
        assert_in_range(box[0], 3, 79);
        assert_in_range(box[1], 3, 59);
        assert_in_range(box[2], 81, 157);
        assert_in_range(box[3], 61, 117);
        assert_true((box[0] <= 7 && box[2] >= 153) || (box[1] <= 7 && box[3] >= 113));
        clast_image_free(&image);
    }
    clast_fields_free(clast_render_fields, &config);
    clast_assembly_free(&a);
}

/// Analytic and meshed bodies of one shape, seen alike: mean difference of the channels.
static double difference_of(const clast_assembly *a, const clast_assembly *b,
                            const clast_render_config *config)
{
    clast_image one = {0};
    clast_image two = {0};
    double sum = 0.0;
    CHECK_OK(clast_render_assembly(a, config, NULL, &one));
    CHECK_OK(clast_render_assembly(b, config, NULL, &two));
    for (int64_t i = 0; i < 4 * (int64_t)one.width * one.height; ++i) {
        sum += abs(one.rgba[i] - two.rgba[i]);
    }
    sum /= 4.0 * one.width * one.height;
    clast_image_free(&one);
    clast_image_free(&two);
    return sum;
}

static void mesh_and_analytic_ellipsoid_look_alike(void **state)
{
    (void)state;
    const double axes[3] = {1.0, 0.7, 0.4};
    const double turn[4] = {0.5, -0.5, 0.5, 0.5};
    const double at[3] = {3.0, 2.0, 1.0};
    clast_assembly a = {0};
    clast_assembly b = {0};
    clast_shape exact = {0};
    clast_shape meshed = {0};
    clast_mesh mesh = {0};
    clast_render_config config = {0};
    int32_t id = 0;
    CHECK_OK(clast_shape_ellipsoid("e", axes, &exact));
    CHECK_OK(clast_mesh_ellipsoid(axes, 5, &mesh));
    CHECK_OK(clast_shape_mesh("e", &mesh, &meshed));
    CHECK_OK(clast_assembly_add_shape(&a, &exact, &id));
    CHECK_OK(clast_assembly_add_grain(&a, id, at, turn, 0.1, 1.0));
    CHECK_OK(clast_assembly_add_shape(&b, &meshed, &id));
    CHECK_OK(clast_assembly_add_grain(&b, id, at, turn, 0.1, 1.0));
    small_config(&config);
    assert_true(difference_of(&a, &b, &config) < 0.2);
    config.cut = CLAST_RENDER_CUT_VIEW;
    assert_true(difference_of(&a, &b, &config) < 0.2);
    clast_fields_free(clast_render_fields, &config);
    clast_shape_free(&exact);
    clast_shape_free(&meshed);
    clast_mesh_free(&mesh);
    clast_assembly_free(&a);
    clast_assembly_free(&b);
}

/// Mean green of the opaque pixels in a rectangle about the middle.
static double middle_green(const clast_image *image)
{
    double sum = 0.0;
    for (int32_t y = 55; y < 65; ++y) {
        for (int32_t x = 75; x < 85; ++x) {
            assert_int_equal(image->rgba[4 * (y * image->width + x) + 3], 255);
            sum += image->rgba[4 * (y * image->width + x) + 1];
        }
    }
    return sum / 100.0;
}

/* A cut through the sphere's middle shows a flat, evenly lit section. */
static void cut_shows_a_section(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_render_config config = {0};
    clast_image image = {0};
    one_sphere(&a);
    small_config(&config);
    config.cut = CLAST_RENDER_CUT_VIEW;
    CHECK_OK(clast_render_assembly(&a, &config, NULL, &image));
    const double radius = 0.5 * (120.0 - 2.0 * 0.04 * 120.0);
    CHECK_REL(coverage(&image), CLAST_PI * radius * radius, 2e-3);
    const double mean = middle_green(&image);
    for (int32_t x = 40; x < 120; ++x) {
        CHECK_ABS(image.rgba[4 * (60 * 160 + x) + 1], mean, 12.0);
    }
    clast_image_free(&image);
    config.cut_position = 0.25;
    CHECK_OK(clast_render_assembly(&a, &config, NULL, &image));
    /* kept: a cap of height r / 2, whose rim has radius r sqrt(3) / 2 */
    CHECK_REL(coverage(&image), CLAST_PI * 0.75 * radius * radius, 3e-3);
    clast_image_free(&image);
    clast_fields_free(clast_render_fields, &config);
    clast_assembly_free(&a);
}

/* A ball between the sun and a plate darkens the plate. */
static void balls_throw_shadows(void **state)
{
    (void)state;
    clast_render_config config = {0};
    clast_shape plate = {0};
    clast_shape ball = {0};
    clast_mesh box = {0};
    double green[2];
    CHECK_OK(clast_mesh_box(8.0, 8.0, 0.5, &box));
    CHECK_OK(clast_shape_mesh("plate", &box, &plate));
    CHECK_OK(clast_shape_sphere("ball", 1.0, &ball));
    small_config(&config);
    config.elevation = 0.5 * CLAST_PI;
    config.sun_azimuth = 0.0;
    config.sun_elevation = 0.7;
    for (int with = 0; with < 2; ++with) {
        clast_assembly a = {0};
        clast_image image = {0};
        add(&a, &plate, 0.0, 0.0, 0.0, 1.0);
        if (with == 1) {
            /* towards the sun: seen from above, up in the picture is -x when azimuth is 0 */
            config.azimuth = 0.0;
            add(&a, &ball, -3.0 * sin(0.7), 0.0, 3.0 * cos(0.7), 1.0);
        }
        config.colour = CLAST_RENDER_COLOUR_SINGLE;
        CHECK_OK(clast_render_assembly(&a, &config, NULL, &image));
        green[with] = middle_green(&image);
        clast_image_free(&image);
        clast_assembly_free(&a);
    }
    assert_true(green[1] < 0.75 * green[0]);
    clast_fields_free(clast_render_fields, &config);
    clast_shape_free(&plate);
    clast_shape_free(&ball);
    clast_mesh_free(&box);
}

/// Pixels that are not white, in columns x0 to x1 and rows y0 to y1.
static int64_t marks(const clast_image *image, int32_t x0, int32_t y0, int32_t x1, int32_t y1)
{
    int64_t n = 0;
    for (int32_t y = y0; y < y1; ++y) {
        for (int32_t x = x0; x < x1; ++x) {
            const uint8_t *p = image->rgba + 4 * (y * image->width + x);
            n += p[0] < 250 || p[1] < 250 || p[2] < 250;
        }
    }
    return n;
}

/// Pixels of the labels' ink in the last rows above the margin.
static int64_t inked(const clast_image *image)
{
    int64_t n = 0;
    for (int32_t y = image->height - 14; y < image->height; ++y) {
        for (int32_t x = 0; x < image->width; ++x) {
            const uint8_t *p = image->rgba + 4 * (y * image->width + x);
            n += p[0] == p[1] && p[1] == p[2] && p[0] < 40;
        }
    }
    return n;
}

/* The labels are there when asked for, and only then. The bar's top is the brightest colour. */
static void labels_are_drawn(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_render_config config = {0};
    four_kinds(&a);
    small_config(&config);
    config.width = 320;
    config.height = 240;
    config.background = CLAST_RENDER_WHITE;
    for (int colour = CLAST_RENDER_COLOUR_SINGLE; colour <= CLAST_RENDER_COLOUR_SHAPE; ++colour) {
        for (int with = 0; with < 2; ++with) {
            clast_image image = {0};
            config.colour = colour;
            config.colour_bar = with == 1;
            config.scale_bar = with == 1;
            CHECK_OK(clast_render_assembly(&a, &config, NULL, &image));
            const int64_t right = marks(&image, 255, 0, 312, 240);
            assert_int_equal(inked(&image) > 20, with == 1);
            if (with == 1) {
                assert_true(right > 100 || colour == CLAST_RENDER_COLOUR_SINGLE);
                assert_int_equal(marks(&image, 313, 0, 320, 240), 0); /* nothing is cut off */
            }
            clast_image_free(&image);
        }
    }
    clast_fields_free(clast_render_fields, &config);
    clast_assembly_free(&a);
}

/// Pixels of a grey as bright as paper shows through a plate.
static int64_t pale(const clast_image *image)
{
    int64_t n = 0;
    for (int64_t i = 0; i < (int64_t)image->width * image->height; ++i) {
        n += image->rgba[4 * i] > 170 ? 1 : 0;
    }
    return n;
}

/* Dark words stood on dark grains. */
static void zoomed_labels_have_a_ground(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_render_config config = {0};
    one_sphere(&a);
    small_config(&config);
    CHECK_OK(
        clast_field_set(clast_fields_find(clast_render_fields, "tint"), &config, "#000000", false));
    config.colour = CLAST_RENDER_COLOUR_SINGLE;
    config.background = CLAST_RENDER_WHITE;
    config.zoom = 30.0;
    for (int with = 0; with < 2; ++with) {
        clast_image image = {0};
        config.scale_bar = with == 1;
        CHECK_OK(clast_render_assembly(&a, &config, NULL, &image));
        assert_int_equal(pale(&image) > 200, with == 1);
        clast_image_free(&image);
    }
    clast_fields_free(clast_render_fields, &config);
    clast_assembly_free(&a);
}

/* "20 um" stood under a picture where no length is the same twice. */
static void perspective_tells_where_its_bar_holds(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_render_config config = {0};
    int64_t ink[2];
    one_sphere(&a);
    small_config(&config);
    config.width = 320;
    config.height = 240;
    config.background = CLAST_RENDER_WHITE;
    config.scale_bar = true;
    config.field_of_view = 0.01;
    for (int k = 0; k < 2; ++k) {
        clast_image image = {0};
        config.projection = k == 0 ? CLAST_RENDER_ORTHOGRAPHIC : CLAST_RENDER_PERSPECTIVE;
        CHECK_OK(clast_render_assembly(&a, &config, NULL, &image));
        ink[k] = marks(&image, 0, 215, 320, 240);
        clast_image_free(&image);
    }
    assert_true(ink[1] > ink[0] + 100); /* "at the centre" */
    clast_fields_free(clast_render_fields, &config);
    clast_assembly_free(&a);
}

/* Bytes that are no UTF-8 ended in "cairo: input string not valid", names were cut within a letter.
 */
static void names_are_cut_between_letters(void **state)
{
    (void)state;
    static const char *const name[3] = {
        "K\xf6rner",
        "\u041f\u043f\u043f\u043f\u043f\u043f\u043f\u043f\u043f\u043f\u043f\u043f"
        "\u043f\u043f\u043f\u043f\u043f\u043f\u043f\u043f",
        "a2345678901234567890123456789012345678901"};
    static const char *const shown[3] = {"K\\xf6rner", NULL,
                                         "a234567890123456789012345678901234567\u2026"};
    clast_assembly a = {0};
    clast_render_config config = {0};
    clx_legend legend = {0};
    small_config(&config);
    config.colour = CLAST_RENDER_COLOUR_SHAPE;
    config.colour_bar = true;
    for (int i = 0; i < 3; ++i) {
        clast_shape ball = {0};
        CHECK_OK(clast_shape_sphere(name[i], 2.0, &ball));
        add(&a, &ball, 3.0 * i, 0.0, 0.0, 1.0);
        clast_shape_free(&ball);
    }
    CHECK_OK(clx_legend_make(&a, &config, 1.0, NULL, &legend));
    for (int i = 0; i < 3; ++i) {
        assert_string_equal(legend.text[i], shown[i] != NULL ? shown[i] : name[i]);
    }
    clast_fields_free(clast_render_fields, &config);
    clast_assembly_free(&a);
}

static void wrong_settings_are_refused(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_assembly none = {0};
    clast_render_config config = {0};
    clast_image image = {0};
    one_sphere(&a);
    small_config(&config);
    CHECK_STATUS(clast_render_assembly(&none, &config, NULL, &image), CLAST_E_GEOMETRY);
    config.tint[1] = 'x';
    CHECK_STATUS(clast_render_assembly(&a, &config, NULL, &image), CLAST_E_CONFIG);
    config.tint[1] = '0';
    (void)snprintf(a.unit, sizeof a.unit, "m");
    clx_free(config.unit);
    CHECK_OK(clx_alloc_text(&config.unit, "mm"));
    CHECK_STATUS(clast_render_assembly(&a, &config, NULL, &image), CLAST_E_CONFIG);
    (void)snprintf(a.unit, sizeof a.unit, "model");
    config.width = 64;
    config.height = 300;
    config.colour_bar = true;
    config.colour = CLAST_RENDER_COLOUR_SHAPE;
    clx_free(a.shape[0].name);
    CHECK_OK(clx_alloc_text(&a.shape[0].name, "a name too long for it"));
    CHECK_STATUS(clast_render_assembly(&a, &config, NULL, &image), CLAST_E_CONFIG);
    a.position[0][1] = NAN;
    CHECK_STATUS(clast_render_assembly(&a, &config, NULL, &image), CLAST_E_GEOMETRY);
    assert_null(image.rgba);
    clast_fields_free(clast_render_fields, &config);
    clast_assembly_free(&a);
}

static bool stop_at_once(void *context)
{
    int *asked = context;
    return ++*asked > 2;
}

static void monitor_can_stop(void **state)
{
    (void)state;
    int asked = 0;
    const clast_monitor monitor = {.stop = stop_at_once, .context = &asked};
    clast_assembly a = {0};
    clast_render_config config = {0};
    clast_image image = {0};
    one_sphere(&a);
    small_config(&config);
    config.height = 300;
    CHECK_STATUS(clast_render_assembly(&a, &config, &monitor, &image), CLAST_E_STOPPED);
    assert_null(image.rgba);
    clast_fields_free(clast_render_fields, &config);
    clast_assembly_free(&a);
}

typedef struct {
    clast_assembly *assembly;
    clast_render_config *config;
    const char *path;
} job;

static clast_status render_and_write(void *context)
{
    const job *j = context;
    clast_image image = {0};
    clast_status status = clast_render_assembly(j->assembly, j->config, NULL, &image);
    if (status == CLAST_OK) {
        status = clast_image_write_png(&image, j->path);
    } else {
        assert_null(image.rgba);
    }
    clast_image_free(&image);
    return status;
}

static void rendering_survives_refused_memory(void **state)
{
    (void)state;
    char path[512];
    clast_assembly a = {0};
    clast_render_config config = {0};
    four_kinds(&a);
    small_config(&config);
    config.width = 64;
    config.height = 64;
    config.samples = 1;
    (void)snprintf(path, sizeof path, "%s/refused.png", support_scratch());
    job j = {&a, &config, path};
    support_refuse_each_allocation(render_and_write, &j);
    clast_fields_free(clast_render_fields, &config);
    clast_assembly_free(&a);
}

/* The tick of one grain was 1.057100275. */
static void one_size_has_few_digits(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_render_config config = {0};
    clx_legend legend = {0};
    clast_shape ball = {0};
    small_config(&config);
    config.colour = CLAST_RENDER_COLOUR_SIZE;
    CHECK_OK(clast_shape_sphere("ball", 1.0, &ball));
    add(&a, &ball, 0.0, 0.0, 0.0, 0.52855013757e-3);
    CHECK_OK(clx_legend_make(&a, &config, 1.0, NULL, &legend));
    assert_int_equal(legend.n, 1);
    assert_string_equal(legend.text[0], "1.057");
    clast_shape_free(&ball);
    clast_fields_free(clast_render_fields, &config);
    clast_assembly_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sphere_covers_its_disc),
        cmocka_unit_test(bytes_are_the_same_for_any_threads),
        cmocka_unit_test(everything_fits_into_the_frame),
        cmocka_unit_test(mesh_and_analytic_ellipsoid_look_alike),
        cmocka_unit_test(cut_shows_a_section),
        cmocka_unit_test(balls_throw_shadows),
        cmocka_unit_test(labels_are_drawn),
        cmocka_unit_test(one_size_has_few_digits),
        cmocka_unit_test(zoomed_labels_have_a_ground),
        cmocka_unit_test(names_are_cut_between_letters),
        cmocka_unit_test(perspective_tells_where_its_bar_holds),
        cmocka_unit_test(wrong_settings_are_refused),
        cmocka_unit_test(monitor_can_stop),
        cmocka_unit_test(rendering_survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
