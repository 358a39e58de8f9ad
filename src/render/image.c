// Images in memory and as PNG files.
#include <clast/render.h>

#include "base/alloc.h"
#include "base/file.h"
#include <png.h>

enum { LIMIT = 1 << 15 };

clast_status clast_image_alloc(int32_t width, int32_t height, clast_image *image)
{
    CLX_ARGUMENTS(image);
    clast_status status = CLAST_OK;
    clast_image made = {.width = width, .height = height};
    CLX_CHECK(width >= 1 && height >= 1 && width <= LIMIT && height <= LIMIT, CLAST_E_LIMIT,
              "a picture of %d x %d pixels; each side must be 1 to %d", width, height, LIMIT);
    CLX_TRY(clx_alloc(&made.rgba, (int64_t)width * height * 4, 1));
    *image = made;
done:
    return status;
}

void clast_image_free(clast_image *image)
{
    if (image == NULL) {
        return;
    }
    clx_free(image->rgba);
    *image = (clast_image){0};
}

static bool is_opaque(const clast_image *image)
{
    const int64_t n = (int64_t)image->width * image->height;
    for (int64_t i = 0; i < n; ++i) {
        if (image->rgba[4 * i + 3] != 255) {
            return false;
        }
    }
    return true;
}

/// The pixels without their alpha.
static clast_status drop_alpha(const clast_image *image, uint8_t **rgb)
{
    clast_status status = CLAST_OK;
    const int64_t n = (int64_t)image->width * image->height;
    CLX_TRY(clx_alloc(rgb, 3 * n, 1));
    for (int64_t i = 0; i < n; ++i) {
        for (int k = 0; k < 3; ++k) {
            (*rgb)[3 * i + k] = image->rgba[4 * i + k];
        }
    }
done:
    return status;
}

clast_status clast_image_write_png(const clast_image *image, const char *path)
{
    CLX_ARGUMENTS(image, path);
    CLX_ARGUMENTS(image->rgba);
    if (image->width < 1 || image->height < 1 || image->width > LIMIT || image->height > LIMIT) {
        return clx_fail(CLAST_E_ARGUMENT, "%s: a picture of %d x %d pixels", __func__, image->width,
                        image->height);
    }
    clast_status status = CLAST_OK;
    const bool has_alpha = !is_opaque(image);
    uint8_t *rgb = NULL;
    uint8_t *bytes = NULL;
    clx_file file = {0};
    png_image png = {.version = PNG_IMAGE_VERSION,
                     .width = (png_uint_32)image->width,
                     .height = (png_uint_32)image->height,
                     .format = has_alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB};
    png_alloc_size_t n = PNG_IMAGE_PNG_SIZE_MAX(png);
    if (!has_alpha) {
        CLX_TRY(drop_alpha(image, &rgb));
    }
    CLX_TRY(clx_alloc(&bytes, (int64_t)n, 1));
    CLX_CHECK(png_image_write_to_memory(&png, bytes, &n, 0, has_alpha ? image->rgba : rgb, 0, NULL),
              CLAST_E_MEMORY, "libpng cannot write %d x %d pixels: %s", image->width, image->height,
              png.message);
    CLX_TRY(clx_file_begin(path, &file));
    CLX_TRY(clx_file_write(&file, bytes, n));
    CLX_TRY(clx_file_commit(&file));
done:
    png_image_free(&png);
    clx_file_abandon(&file);
    CLX_FREE(rgb, bytes);
    return status;
}
