/* Unit: PNG files are read back by an independent reader (libpng, through cairo). */
#include "math/rng.h"
#include "support.h"
#include <cairo.h>
#include <clast/render.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* Noise, a flat area and a ramp: every row filter is used somewhere. */
static void fill(clast_image *image, bool opaque)
{
    clx_rng rng = clx_rng_at(2, CLX_STREAM_TEST, 0);
    for (int32_t y = 0; y < image->height; ++y) {
        for (int32_t x = 0; x < image->width; ++x) {
            uint8_t *p = image->rgba + 4 * (y * image->width + x);
            const int kind = y / 8 % 4;
            for (int k = 0; k < 3; ++k) {
                p[k] = (uint8_t)(kind == 0   ? clx_rng_below(&rng, 256)
                                 : kind == 1 ? 77
                                 : kind == 2 ? 3 * x + k
                                             : 5 * y + k * x);
            }
            p[3] = opaque || x % 3 == 0 ? 255 : 0;
        }
    }
}

static void png_comes_back(bool opaque)
{
    char path[512];
    clast_image image = {0};
    (void)snprintf(path, sizeof path, "%s/back.png", support_scratch());
    CHECK_OK(clast_image_alloc(53, 64, &image));
    fill(&image, opaque);
    CHECK_OK(clast_image_write_png(&image, path));
    cairo_surface_t *surface = cairo_image_surface_create_from_png(path);
    assert_int_equal(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
    assert_int_equal(cairo_image_surface_get_width(surface), 53);
    assert_int_equal(cairo_image_surface_get_height(surface), 64);
    assert_int_equal(cairo_image_surface_get_format(surface),
                     opaque ? CAIRO_FORMAT_RGB24 : CAIRO_FORMAT_ARGB32);
    const unsigned char *data = cairo_image_surface_get_data(surface);
    const int stride = cairo_image_surface_get_stride(surface);
    for (int32_t i = 0; i < 53 * 64; ++i) {
        uint32_t pixel = 0;
        const uint8_t *p = image.rgba + 4 * i;
        memcpy(&pixel, data + (ptrdiff_t)(i / 53) * stride + 4 * (ptrdiff_t)(i % 53), sizeof pixel);
        const uint32_t expected =
            p[3] == 0 ? 0 : (uint32_t)p[0] << 16 | (uint32_t)p[1] << 8 | (uint32_t)p[2];
        assert_int_equal(pixel & 0xffffffU, expected);
    }
    cairo_surface_destroy(surface);
    clast_image_free(&image);
}

static void opaque_png_comes_back(void **state)
{
    (void)state;
    png_comes_back(true);
}

static void transparent_png_comes_back(void **state)
{
    (void)state;
    png_comes_back(false);
}

static void bad_sizes_and_places_are_refused(void **state)
{
    (void)state;
    clast_image image = {0};
    CHECK_STATUS(clast_image_alloc(0, 5, &image), CLAST_E_LIMIT);
    CHECK_STATUS(clast_image_alloc(5, 1 << 20, &image), CLAST_E_LIMIT);
    assert_null(image.rgba);
    CHECK_OK(clast_image_alloc(2, 2, &image));
    CHECK_STATUS(clast_image_write_png(&image, "/no/such/folder/a.png"), CLAST_E_DISK);
    clast_image_free(&image);
    clast_image_free(&image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(opaque_png_comes_back),
        cmocka_unit_test(transparent_png_comes_back),
        cmocka_unit_test(bad_sizes_and_places_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
