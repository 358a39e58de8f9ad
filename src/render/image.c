// Images in memory and as PNG files (RFC 2083): every row filtered by the predictor that leaves the
// smallest sum of differences, packed by zlib.
#include <clast/render.h>

#include "base/alloc.h"
#include "base/file.h"
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum { LIMIT = 1 << 15, LEVEL = 6 };

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

static void put32(uint8_t *at, uint32_t value)
{
    for (int i = 0; i < 4; ++i) {
        at[i] = (uint8_t)(value >> (24 - 8 * i));
    }
}

static clast_status write_chunk(clx_file *file, const char *type, const uint8_t *data, uint32_t n)
{
    clast_status status = CLAST_OK;
    uint8_t head[8];
    uint8_t tail[4];
    put32(head, n);
    memcpy(head + 4, type, 4);
    uLong crc = crc32(0, head + 4, 4);
    if (n > 0) {
        crc = crc32(crc, data, n);
    }
    put32(tail, (uint32_t)crc);
    CLX_TRY(clx_file_write(file, head, sizeof head));
    CLX_TRY(clx_file_write(file, data, n));
    CLX_TRY(clx_file_write(file, tail, sizeof tail));
done:
    return status;
}

static int paeth(int left, int up, int corner)
{
    const int p = left + up - corner;
    const int pl = abs(p - left);
    const int pu = abs(p - up);
    const int pc = abs(p - corner);
    return pl <= pu && pl <= pc ? left : pu <= pc ? up : corner;
}

/// One row through one of the five filters; the sum of absolute differences.
static int64_t filter_row(int kind, const uint8_t *row, const uint8_t *above, int32_t n, int step,
                          uint8_t *out)
{
    int64_t sum = 0;
    out[0] = (uint8_t)kind;
    for (int32_t i = 0; i < n; ++i) {
        const int left = i >= step ? row[i - step] : 0;
        const int up = above != NULL ? above[i] : 0;
        const int corner = above != NULL && i >= step ? above[i - step] : 0;
        const int guess[5] = {0, left, up, (left + up) / 2, paeth(left, up, corner)};
        out[i + 1] = (uint8_t)(row[i] - guess[kind]);
        sum += out[i + 1] < 128 ? out[i + 1] : 256 - out[i + 1];
    }
    return sum;
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

/// Row y with 3 or 4 bytes a pixel.
static void plain_row(const clast_image *image, int32_t y, int step, uint8_t *row)
{
    const uint8_t *from = image->rgba + 4 * (ptrdiff_t)y * image->width;
    for (int32_t x = 0; x < image->width; ++x) {
        memcpy(row + step * (ptrdiff_t)x, from + 4 * (ptrdiff_t)x, (size_t)step);
    }
}

/// All rows filtered, as zlib takes them.
static clast_status filter_image(const clast_image *image, int step, uint8_t **bytes)
{
    clast_status status = CLAST_OK;
    const int32_t n = step * image->width;
    uint8_t *out = NULL;
    uint8_t *work = NULL; // this row, the one above, one candidate
    CLX_TRY(clx_alloc(&out, ((int64_t)n + 1) * image->height, 1));
    CLX_TRY(clx_alloc(&work, 3 * (int64_t)n + 1, 1));
    for (int32_t y = 0; y < image->height; ++y) {
        uint8_t *row = work + (y % 2) * (ptrdiff_t)n;
        const uint8_t *above = y > 0 ? work + ((y + 1) % 2) * (ptrdiff_t)n : NULL;
        uint8_t *target = out + ((ptrdiff_t)n + 1) * y;
        int64_t best = INT64_MAX;
        plain_row(image, y, step, row);
        for (int kind = 0; kind < 5; ++kind) {
            uint8_t *candidate = work + 2 * (ptrdiff_t)n;
            const int64_t sum = filter_row(kind, row, above, n, step, candidate);
            if (sum < best) {
                best = sum;
                memcpy(target, candidate, (size_t)n + 1);
            }
        }
    }
    *bytes = out;
    out = NULL;
done:
    clx_free(out);
    clx_free(work);
    return status;
}

static clast_status pack(const uint8_t *bytes, int64_t n, uint8_t **packed, uint32_t *n_packed)
{
    clast_status status = CLAST_OK;
    uint8_t *out = NULL;
    uLongf size = compressBound((uLong)n);
    CLX_TRY(clx_alloc(&out, (int64_t)size, 1));
    CLX_CHECK(compress2(out, &size, bytes, (uLong)n, LEVEL) == Z_OK && size <= INT32_MAX,
              CLAST_E_MEMORY, "zlib cannot pack %lld bytes", (long long)n);
    *packed = out;
    *n_packed = (uint32_t)size;
    out = NULL;
done:
    clx_free(out);
    return status;
}

static clast_status write_chunks(clx_file *file, const uint8_t header[13], const uint8_t *packed,
                                 uint32_t n_packed)
{
    static const uint8_t signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    clast_status status = CLAST_OK;
    CLX_TRY(clx_file_write(file, signature, sizeof signature));
    CLX_TRY(write_chunk(file, "IHDR", header, 13));
    CLX_TRY(write_chunk(file, "IDAT", packed, n_packed));
    CLX_TRY(write_chunk(file, "IEND", NULL, 0));
done:
    return status;
}

clast_status clast_image_write_png(const clast_image *image, const char *path)
{
    CLX_ARGUMENTS(image, path);
    CLX_ARGUMENTS(image->rgba);
    if (image->width < 1 || image->height < 1) {
        return clx_fail(CLAST_E_ARGUMENT, "%s: a picture of %d x %d pixels", __func__, image->width,
                        image->height);
    }
    clast_status status = CLAST_OK;
    const int step = is_opaque(image) ? 3 : 4;
    uint8_t header[13] = {[8] = 8, [9] = step == 3 ? 2 : 6};
    uint8_t *bytes = NULL;
    uint8_t *packed = NULL;
    uint32_t n_packed = 0;
    clx_file file = {0};
    put32(header, (uint32_t)image->width);
    put32(header + 4, (uint32_t)image->height);
    CLX_TRY(filter_image(image, step, &bytes));
    CLX_TRY(pack(bytes, ((int64_t)step * image->width + 1) * image->height, &packed, &n_packed));
    CLX_TRY(clx_file_begin(path, &file));
    CLX_TRY(write_chunks(&file, header, packed, n_packed));
    CLX_TRY(clx_file_commit(&file));
done:
    clx_file_abandon(&file);
    clx_free(bytes);
    clx_free(packed);
    return status;
}
