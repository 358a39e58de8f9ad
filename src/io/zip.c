// A ZIP file of a few deflated entries [PKWARE APPNOTE 6.3, sections 4.3.7, 4.3.12, 4.3.16].
#include "io/zip.h"

#include "base/alloc.h"
#include "base/file.h"
#include "base/number.h"
#include "io/bytes.h"
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum {
    VERSION = 20,       // 2.0: deflate
    METHOD_DEFLATE = 8, //
    DATE_1980 = 0x21,   // 1 January 1980, the earliest that the format knows
    CHUNK = 1 << 16
};

static voidpf zip_alloc(voidpf unused, uInt n, uInt size)
{
    void *block = NULL;
    (void)unused;
    (void)clx_alloc(&block, (int64_t)n, size);
    return block;
}

static void zip_free(voidpf unused, voidpf block)
{
    (void)unused;
    clx_free(block);
}

clast_status clx_zip_begin_entry(clx_zip *zip, const char *name)
{
    clast_status status = CLAST_OK;
    CLAST_ASSERT(!zip->is_open && zip->n_entry < CLX_ZIP_N_ENTRY);
    clx_zip_entry *e = &zip->entry[zip->n_entry];
    *e = (clx_zip_entry){.offset = zip->offset, .crc = (uint32_t)crc32(0, NULL, 0)};
    (void)snprintf(e->name, sizeof e->name, "%s", name);
    zip->n_packed = 0;
    zip->stream = (z_stream){.zalloc = zip_alloc, .zfree = zip_free};
    // -15: no zlib header around the deflated bytes
    CLX_CHECK(deflateInit2(&zip->stream, 6, Z_DEFLATED, -15, 8, Z_DEFAULT_STRATEGY) == Z_OK,
              CLAST_E_MEMORY, "no memory to pack %s", name);
    zip->is_open = true;
done:
    return status;
}

/// Runs the packer until it wants no more room.
static clast_status pack(clx_zip *zip, int flush)
{
    CLAST_ASSERT(zip->is_open);
    clast_status status = CLAST_OK;
    do {
        CLX_TRY(clx_grow(&zip->packed, &zip->capacity, zip->n_packed + CHUNK, 1));
        zip->stream.next_out = zip->packed + zip->n_packed;
        zip->stream.avail_out = CHUNK;
        (void)deflate(&zip->stream, flush);
        zip->n_packed += CHUNK - (int64_t)zip->stream.avail_out;
    } while (zip->stream.avail_out == 0);
done:
    return status;
}

clast_status clx_zip_write(clx_zip *zip, const void *bytes, size_t n)
{
    clast_status status = CLAST_OK;
    clx_zip_entry *e = &zip->entry[zip->n_entry];
    CLAST_ASSERT(zip->is_open && n <= CHUNK);
    CLX_CHECK(e->raw + (int64_t)n < UINT32_MAX, CLAST_E_LIMIT,
              "%s is over 4 GiB, which this ZIP cannot hold", e->name);
    e->crc = (uint32_t)crc32(e->crc, bytes, (uInt)n);
    e->raw += (int64_t)n;
    zip->stream.next_in = bytes;
    zip->stream.avail_in = (uInt)n;
    CLX_TRY(pack(zip, Z_NO_FLUSH));
done:
    return status;
}

clast_status clx_zip_print(clx_zip *zip, const char *format, ...)
{
    char text[1024];
    va_list args;
    va_start(args, format);
    const int n = clx_number_print_list(text, sizeof text, format, args);
    va_end(args);
    CLAST_ASSERT(n >= 0 && (size_t)n < sizeof text);
    return clx_zip_write(zip, text, (size_t)n);
}

/// Version to flags, method, time, checksum and sizes: common to both headers of an entry.
static void store_common(uint8_t *p, const clx_zip_entry *e)
{
    clx_store_u16(p, VERSION);
    clx_store_u16(p + 2, 0);
    clx_store_u16(p + 4, METHOD_DEFLATE);
    clx_store_u16(p + 6, 0);
    clx_store_u16(p + 8, DATE_1980);
    clx_store_u32(p + 10, e->crc);
    clx_store_u32(p + 14, (uint32_t)e->packed);
    clx_store_u32(p + 18, (uint32_t)e->raw);
    clx_store_u16(p + 22, (uint32_t)strlen(e->name));
    clx_store_u16(p + 24, 0);
}

static clast_status append(clx_zip *zip, const void *bytes, int64_t n)
{
    zip->offset += n;
    return clx_file_write(zip->file, bytes, (size_t)n);
}

clast_status clx_zip_end_entry(clx_zip *zip)
{
    clast_status status = CLAST_OK;
    uint8_t header[30] = {'P', 'K', 3, 4};
    clx_zip_entry *e = &zip->entry[zip->n_entry];
    zip->stream.avail_in = 0;
    CLX_TRY(pack(zip, Z_FINISH));
    e->packed = zip->n_packed;
    CLX_CHECK(zip->offset + e->packed < UINT32_MAX - CHUNK, CLAST_E_LIMIT,
              "the ZIP is over 4 GiB, which it cannot hold");
    store_common(header + 4, e);
    CLX_TRY(append(zip, header, sizeof header));
    CLX_TRY(append(zip, e->name, (int64_t)strlen(e->name)));
    CLX_TRY(append(zip, zip->packed, e->packed));
    ++zip->n_entry;
done:
    (void)deflateEnd(&zip->stream);
    zip->is_open = false;
    return status;
}

clast_status clx_zip_finish(clx_zip *zip)
{
    clast_status status = CLAST_OK;
    uint8_t end[22] = {'P', 'K', 5, 6};
    const int64_t start = zip->offset;
    for (int32_t i = 0; i < zip->n_entry; ++i) {
        const clx_zip_entry *e = &zip->entry[i];
        uint8_t header[46] = {'P', 'K', 1, 2, VERSION};
        store_common(header + 6, e);
        clx_store_u32(header + 42, (uint32_t)e->offset);
        CLX_TRY(append(zip, header, sizeof header));
        CLX_TRY(append(zip, e->name, (int64_t)strlen(e->name)));
    }
    clx_store_u16(end + 8, (uint32_t)zip->n_entry);
    clx_store_u16(end + 10, (uint32_t)zip->n_entry);
    clx_store_u32(end + 12, (uint32_t)(zip->offset - start));
    clx_store_u32(end + 16, (uint32_t)start);
    CLX_TRY(append(zip, end, sizeof end));
done:
    return status;
}

void clx_zip_free(clx_zip *zip)
{
    if (zip->is_open) {
        (void)deflateEnd(&zip->stream);
    }
    clx_free(zip->packed);
    *zip = (clx_zip){0};
}
