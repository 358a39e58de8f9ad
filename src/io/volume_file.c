// Volumes of scanners: which format, and bare values without any.
#include "io/volume_io.h"

#include "base/status.h"
#include <clast/volume.h>
#include <math.h>
#include <string.h>
#define ZLIB_CONST // next_in is const
#include <zlib.h>

clast_status clx_inflate(const uint8_t *bytes, size_t n, uint8_t *out, size_t n_out)
{
    enum { ANY_HEADER = 32 + MAX_WBITS }; // zlib's or gzip's
    z_stream stream = {0};
    size_t taken = 0;
    size_t given = 0;
    uint8_t beyond = 0; // where a byte after the last would go
    bool is_more = false;
    int code = inflateInit2(&stream, ANY_HEADER);
    if (code != Z_OK) {
        return clx_fail(CLAST_E_MEMORY, "no memory to unpack %zu bytes", n);
    }
    while (code == Z_OK) { // counts of zlib have 32 bits
        const size_t in = n - taken < (1u << 30) ? n - taken : (1u << 30);
        const size_t left = n_out - given < (1u << 30) ? n_out - given : (1u << 30);
        stream.next_in = bytes + taken;
        stream.avail_in = (uInt)in;
        stream.next_out = left > 0 ? out + given : &beyond;
        stream.avail_out = left > 0 ? (uInt)left : 1;
        code = inflate(&stream, Z_NO_FLUSH); // Z_BUF_ERROR where the file ends before its checksum
        taken += in - stream.avail_in;
        is_more = is_more || (left == 0 && stream.avail_out == 0);
        given += left > 0 ? left - stream.avail_out : 0;
        code = is_more ? Z_DATA_ERROR : code;
    }
    (void)inflateEnd(&stream);
    return is_more
               ? clx_fail(CLAST_E_FORMAT,
                          "packed values are more than the %zu bytes of its sizes and type", n_out)
           : code == Z_STREAM_END && given == n_out
               ? CLAST_OK
               : clx_fail(CLAST_E_FORMAT, "packed values are damaged: %zu of %zu bytes came out",
                          given, n_out);
}

bool clast_volume_is_known(const void *bytes, size_t n)
{
    if (bytes == NULL) {
        return false;
    }
    return clx_nrrd_is(bytes, n) || clx_tiff_is(bytes, n);
}

/// Values alone: sizes and type are the caller's.
static clast_status parse_bare(const uint8_t *bytes, size_t n, const clast_volume_options *o,
                               clast_volume *volume)
{
    clast_status status = CLAST_OK;
    const double n_voxel = (double)o->n[0] * o->n[1] * o->n[2];
    const double wanted = n_voxel * clast_volume_type_size(o->type) + (double)o->skip;
    CLX_CHECK(o->n[0] > 0 && o->n[1] > 0 && o->n[2] > 0, CLAST_E_FORMAT,
              "no NRRD, no TIFF, and no sizes are given (--voxels NX,NY,NZ) for bare values");
    CLX_CHECK(o->skip >= 0 && wanted == (double)n, CLAST_E_FORMAT,
              "%d x %d x %d voxels of %d bytes after %lld others are %.0f bytes; the file has %zu",
              o->n[0], o->n[1], o->n[2], clast_volume_type_size(o->type), (long long)o->skip,
              wanted, n);
    CLX_TRY(clast_volume_alloc(o->n, volume));
    clast_volume_fill(volume, 0, (int64_t)n_voxel, o->type, o->is_big_endian, bytes + o->skip);
done:
    return status;
}

clast_status clast_volume_parse(const void *bytes, size_t n, const clast_volume_options *options,
                                clast_volume *volume)
{
    CLX_ARGUMENTS(options, volume);
    CLX_ARRAY(bytes, n);
    clast_status status = CLAST_OK;
    clast_volume made = {0};
    if (clx_nrrd_is(bytes, n)) {
        CLX_TRY(clx_nrrd_parse(bytes, n, &made));
    } else if (clx_tiff_is(bytes, n)) {
        CLX_TRY(clx_tiff_parse(bytes, n, &made));
    } else {
        CLX_TRY(parse_bare(bytes, n, options, &made));
    }
    for (int k = 0; k < 3; ++k) {
        made.edge[k] = options->edge[k] > 0.0 ? options->edge[k] : made.edge[k];
        CLX_CHECK(made.edge[k] > 0.0 && isfinite(made.edge[k]), CLAST_E_FORMAT,
                  "a voxel's edge of %g; it must be positive and finite (--voxel-edge)",
                  made.edge[k]);
    }
    *volume = made;
    made = (clast_volume){0};
done:
    clast_volume_free(&made);
    return status;
}
