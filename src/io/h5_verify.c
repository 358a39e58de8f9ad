// What clast's HDF5 files have in common, written by HDF5 or plainly: names, checksums, the last
// line.
#include "io/h5.h"

#include "base/alloc.h"
#include "base/file.h"
#include "io/h5_trailer.h"
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

clast_status clx_h5_check_name(const char *label, const char *name)
{
    clast_status status = CLAST_OK;
    const size_t n = strlen(name);
    CLX_CHECK(name[0] == '/' && n < CLX_H5_NAME_LIMIT && (n == 1 || name[n - 1] != '/') &&
                  strstr(name, "//") == NULL && strstr(name, "/./") == NULL,
              CLAST_E_USAGE, "%s: '%s' is not a name in a file", label, name);
done:
    return status;
}

static uint32_t rotate_left(uint32_t x, int k)
{
    return (x << k) | (x >> (32 - k));
}

/// The k-th word of up to 12 bytes, missing ones 0.
static uint32_t word_of(const char *bytes, int64_t n, int k)
{
    uint32_t word = 0;
    for (int i = 0; i < 4; ++i) {
        word |= 4 * k + i < n ? (uint32_t)(unsigned char)bytes[4 * k + i] << 8 * i : 0;
    }
    return word;
}

uint32_t clx_h5_sum(const char *bytes, int64_t n)
{
    uint32_t a = 0xdeadbeefu + (uint32_t)n;
    uint32_t b = a;
    uint32_t c = a;
    for (; n > 12; n -= 12, bytes += 12) {
        a += word_of(bytes, 12, 0), b += word_of(bytes, 12, 1), c += word_of(bytes, 12, 2);
        a = (a - c) ^ rotate_left(c, 4), c += b;
        b = (b - a) ^ rotate_left(a, 6), a += c;
        c = (c - b) ^ rotate_left(b, 8), b += a;
        a = (a - c) ^ rotate_left(c, 16), c += b;
        b = (b - a) ^ rotate_left(a, 19), a += c;
        c = (c - b) ^ rotate_left(b, 4), b += a;
    }
    if (n == 0) {
        return c;
    }
    a += word_of(bytes, n, 0), b += word_of(bytes, n, 1), c += word_of(bytes, n, 2);
    c = (c ^ b) - rotate_left(b, 14);
    a = (a ^ c) - rotate_left(c, 11);
    b = (b ^ a) - rotate_left(a, 25);
    c = (c ^ b) - rotate_left(b, 16);
    a = (a ^ c) - rotate_left(c, 4);
    b = (b ^ a) - rotate_left(a, 14);
    return (c ^ b) - rotate_left(b, 24);
}

/// CRC-32 of n more bytes after those whose CRC-32 is `crc` (0: none).
static uint32_t crc_after(uint32_t crc, const char *bytes, int64_t n)
{
    CLAST_ASSERT(n >= 0);
    const int64_t step = 1 << 30;
    uLong sum = crc;
    for (int64_t at = 0; at < n; at += step) {
        sum = crc32(sum, (const Bytef *)bytes + at, (uInt)(n - at < step ? n - at : step));
    }
    return (uint32_t)sum;
}

clast_status clx_h5_write_image(const char *path, const char *image, int64_t n)
{
    clast_status status = CLAST_OK;
    clx_file file = {0};
    CLX_TRY(clx_file_begin(path, &file));
    CLX_TRY(clx_file_write(&file, image, (size_t)n));
    CLX_TRY(clx_file_print(&file, CLX_H5_TRAILER, crc_after(0, image, n), n));
    CLX_TRY(clx_file_commit(&file));
done:
    clx_file_abandon(&file);
    return status;
}

/// CRC-32 of the first n bytes of a file.
static clast_status crc_of(FILE *file, const char *path, int64_t n, uint32_t *crc)
{
    enum { BLOCK = 1 << 16 };
    clast_status status = CLAST_OK;
    char *block = NULL;
    *crc = 0;
    CLX_TRY(clx_alloc(&block, BLOCK, 1));
    for (int64_t left = n; left > 0;) {
        const size_t want = left < BLOCK ? (size_t)left : BLOCK;
        CLX_CHECK(fread(block, 1, want, file) == want, CLAST_E_IO, "cannot read %s", path);
        *crc = crc_after(*crc, block, (int64_t)want);
        left -= (int64_t)want;
    }
done:
    clx_free(block);
    return status;
}

/// Reads the last line: *n bytes before it have this CRC-32.
static clast_status read_trailer(FILE *file, const char *path, int64_t *n, uint32_t *crc)
{
    clast_status status = CLAST_OK;
    char text[CLX_H5_TRAILER_SIZE + 1] = "";
    char again[CLX_H5_TRAILER_SIZE + 1];
    char magic[8] = "";
    CLX_CHECK(fread(magic, 1, 8, file) == 8 && memcmp(magic, "\x89HDF\r\n\x1a\n", 8) == 0,
              CLAST_E_FORMAT, "%s is not an HDF5 file", path);
    CLX_CHECK(fseek(file, 0, SEEK_END) == 0, CLAST_E_IO, "%s is not a plain file", path);
    const long size = ftell(file);
    CLX_CHECK(size >= CLX_H5_TRAILER_SIZE &&
                  fseek(file, size - CLX_H5_TRAILER_SIZE, SEEK_SET) == 0 &&
                  fread(text, 1, CLX_H5_TRAILER_SIZE, file) == CLX_H5_TRAILER_SIZE,
              CLAST_E_FORMAT, "%s is cut short", path);
    *crc = (uint32_t)strtoul(text + 13, NULL, 16);
    *n = strtoll(text + 25, NULL, 10);
    (void)snprintf(again, sizeof again, CLX_H5_TRAILER, *crc, *n);
    CLX_CHECK(strcmp(text, again) == 0 && *n == (int64_t)size - CLX_H5_TRAILER_SIZE, CLAST_E_FORMAT,
              "%s is cut short or was not written by clast: its last line, a checksum, is missing",
              path);
    rewind(file);
done:
    return status;
}

clast_status clx_h5_verify(const char *path)
{
    clast_status status = CLAST_OK;
    int64_t n = 0;
    uint32_t expected = 0;
    uint32_t crc = 0;
    FILE *file = fopen(path, "rb");
    CLX_CHECK(file != NULL, CLAST_E_IO, "cannot read %s: %s", path, clx_errno_text());
    CLX_TRY(read_trailer(file, path, &n, &expected));
    CLX_TRY(crc_of(file, path, n, &crc));
    CLX_CHECK(crc == expected, CLAST_E_FORMAT,
              "%s is damaged: its CRC-32 is %08" PRIx32 ", its last line says %08" PRIx32, path,
              crc, expected);
done:
    if (file != NULL) {
        (void)fclose(file);
    }
    return status;
}
