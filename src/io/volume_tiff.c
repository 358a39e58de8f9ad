// TIFF: a chain of directories, each a page of strips of rows; a page is a slice of the volume.
//                                                                      [Adobe, TIFF 6.0, 1992]
#include "io/volume_io.h"

#include "base/alloc.h"
#include <string.h>

enum {
    TAG_WIDTH = 256,
    TAG_HEIGHT = 257,
    TAG_BITS = 258,
    TAG_COMPRESSION = 259,
    TAG_DESCRIPTION = 270,
    TAG_OFFSETS = 273,
    TAG_SAMPLES = 277,
    TAG_ROWS = 278,
    TAG_COUNTS = 279,
    TAG_PREDICTOR = 317,
    TAG_TILES = 322,
    TAG_FORMAT = 339,
    ENTRY_SIZE = 12,
    CLASSIC = 42 // 43: BigTIFF
};

/// What to do about a kind that is not read, with libtiff's tool.
#define CONVERT "`tiffcp -s -c none IN OUT` writes what is read"

typedef struct {
    const uint8_t *bytes;
    size_t n;
    bool is_big;
} tiff;

/// A directory's values; lists stay in the file.
typedef struct {
    uint32_t width, height, bits, compression, samples, rows, predictor, format;
    uint32_t n_strip, offset_type, count_type, n_count;
    size_t offsets, counts; ///< where the lists begin
    size_t text, n_text;    ///< description
    bool has_tiles;
} page;

bool clx_tiff_is(const uint8_t *bytes, size_t n)
{
    return n >= 8 && (memcmp(bytes, "II*\0", 4) == 0 || memcmp(bytes, "MM\0*", 4) == 0 ||
                      memcmp(bytes, "II+\0", 4) == 0 || memcmp(bytes, "MM\0+", 4) == 0);
}

static uint32_t number(const tiff *t, size_t at, int size)
{
    uint32_t value = 0;
    for (int k = 0; k < size && at + (size_t)size <= t->n; ++k) {
        value |= (uint32_t)t->bytes[at + (size_t)(t->is_big ? size - 1 - k : k)] << (8 * k);
    }
    return value;
}

static int size_of(uint32_t type)
{
    return type == 1 ? 1 : type == 3 ? 2 : type == 4 ? 4 : 0; // byte, short, long
}

/// Takes one entry of a directory.
static clast_status take_entry(const tiff *t, size_t at, page *p)
{
    clast_status status = CLAST_OK;
    const uint32_t tag = number(t, at, 2);
    const uint32_t type = number(t, at + 2, 2);
    const uint32_t count = number(t, at + 4, 4);
    const int size = size_of(type);
    const bool is_inline = (uint64_t)count * (uint64_t)size <= 4;
    const size_t place = is_inline ? at + 8 : number(t, at + 8, 4);
    const uint32_t value = size > 0 && count > 0 ? number(t, place, size) : 0;
    if (tag == TAG_DESCRIPTION && count > 4 && number(t, at + 8, 4) + (uint64_t)count <= t->n) {
        p->text = number(t, at + 8, 4);
        p->n_text = count;
    }
    CLX_CHECK(size == 0 || place + (uint64_t)count * (uint64_t)size <= t->n, CLAST_E_FORMAT,
              "TIFF: entry %u lies beyond the end of the file", tag);
    switch (tag) {
    case TAG_WIDTH:
        p->width = value;
        break;
    case TAG_HEIGHT:
        p->height = value;
        break;
    case TAG_BITS:
        p->bits = value;
        break;
    case TAG_COMPRESSION:
        p->compression = value;
        break;
    case TAG_SAMPLES:
        p->samples = value;
        break;
    case TAG_ROWS:
        p->rows = value;
        break;
    case TAG_PREDICTOR:
        p->predictor = value;
        break;
    case TAG_FORMAT:
        p->format = value;
        break;
    case TAG_TILES:
        p->has_tiles = true;
        break;
    case TAG_OFFSETS:
        p->offsets = place;
        p->offset_type = type;
        p->n_strip = size > 0 ? count : 0;
        break;
    case TAG_COUNTS:
        p->counts = place;
        p->count_type = type;
        p->n_count = size > 0 ? count : 0;
        break;
    default:
        break;
    }
done:
    return status;
}

static clast_status check_page(const page *p, int32_t k)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(!p->has_tiles, CLAST_E_FORMAT, "TIFF: page %d has tiles; " CONVERT, k);
    CLX_CHECK(p->width > 0 && p->height > 0 && p->width < INT32_MAX && p->height < INT32_MAX,
              CLAST_E_FORMAT, "TIFF: page %d is %u x %u", k, p->width, p->height);
    CLX_CHECK(p->samples == 1, CLAST_E_FORMAT,
              "TIFF: page %d has %u samples a pixel; grey values or labels have one", k,
              p->samples);
    CLX_CHECK(p->bits == 8 || p->bits == 16 || p->bits == 32, CLAST_E_FORMAT,
              "TIFF: page %d has %u bits a pixel; 8, 16 and 32 are read", k, p->bits);
    CLX_CHECK(p->compression == 1 || p->compression == 8 || p->compression == 32946, CLAST_E_FORMAT,
              "TIFF: page %d is packed by method %u%s; " CONVERT, k, p->compression,
              p->compression == 5 ? " (LZW)" : "");
    CLX_CHECK(p->predictor == 1, CLAST_E_FORMAT,
              "TIFF: page %d is packed with a predictor; " CONVERT, k);
    CLX_CHECK(p->n_strip > 0 && (p->n_count == p->n_strip || (p->n_count == 0 && p->n_strip == 1)),
              CLAST_E_FORMAT, "TIFF: page %d has %u strips and %u lengths", k, p->n_strip,
              p->n_count);
done:
    return status;
}

/// Reads the directory at *at and moves on to the next (0: the last).
static clast_status read_page(const tiff *t, int32_t k, size_t *at, page *p)
{
    clast_status status = CLAST_OK;
    const size_t start = *at;
    *p = (page){.compression = 1, .samples = 1, .bits = 1, .predictor = 1, .format = 1};
    CLX_CHECK(start + 2 <= t->n, CLAST_E_FORMAT, "TIFF: page %d lies beyond the end", k);
    const size_t n_entry = number(t, start, 2);
    CLX_CHECK(start + 6 + n_entry * ENTRY_SIZE <= t->n, CLAST_E_FORMAT,
              "TIFF: page %d lies beyond the end", k);
    for (size_t i = 0; i < n_entry; ++i) {
        CLX_TRY(take_entry(t, start + 2 + i * ENTRY_SIZE, p));
    }
    CLX_TRY(check_page(p, k));
    p->rows = p->rows == 0 || p->rows > p->height ? p->height : p->rows;
    *at = number(t, start + 2 + n_entry * ENTRY_SIZE, 4);
done:
    return status;
}

static clast_volume_type type_of(const page *p)
{
    const bool is_signed = p->format == 2;
    if (p->bits == 8) {
        return is_signed ? CLAST_VOLUME_I8 : CLAST_VOLUME_U8;
    }
    if (p->bits == 16) {
        return is_signed ? CLAST_VOLUME_I16 : CLAST_VOLUME_U16;
    }
    return p->format == 3 ? CLAST_VOLUME_F32 : is_signed ? CLAST_VOLUME_I32 : CLAST_VOLUME_U32;
}

/// Values of one page into its slice; `scratch` has room for a strip.
static clast_status read_strips(const tiff *t, const page *p, int32_t slice, uint8_t *scratch,
                                clast_volume *volume)
{
    clast_status status = CLAST_OK;
    const int offset_size = size_of(p->offset_type);
    const int count_size = size_of(p->count_type);
    const int64_t first = (int64_t)slice * volume->n[0] * volume->n[1];
    for (uint32_t s = 0, row = 0; row < p->height; ++s, row += p->rows) {
        CLX_CHECK(s < p->n_strip, CLAST_E_FORMAT, "TIFF: page %d lacks strips", slice + 1);
        const uint32_t rows = p->height - row < p->rows ? p->height - row : p->rows;
        const size_t wanted = (size_t)rows * p->width * (p->bits / 8);
        const size_t from = number(t, p->offsets + (size_t)s * (size_t)offset_size, offset_size);
        const size_t held = p->n_count == 0
                                ? wanted
                                : number(t, p->counts + (size_t)s * (size_t)count_size, count_size);
        const uint8_t *data = t->bytes + from;
        CLX_CHECK(from + held <= t->n && (p->compression != 1 || held >= wanted), CLAST_E_FORMAT,
                  "TIFF: strip %u of page %d lies beyond the end or is short", s + 1, slice + 1);
        if (p->compression != 1) {
            CLX_TRY(clx_inflate(data, held, scratch, wanted));
            data = scratch;
        }
        clast_volume_fill(volume, first + (int64_t)row * p->width, (int64_t)rows * p->width,
                          type_of(p), t->is_big, data);
    }
done:
    return status;
}

/// Counts pages; all must be of one size and together fit the file.
static clast_status count_pages(const tiff *t, page *first, int32_t *n_page)
{
    clast_status status = CLAST_OK;
    size_t at = number(t, 4, 4);
    const double held = (double)t->n * CLX_MOST_RATIO;
    for (*n_page = 0; at != 0; ++*n_page) {
        page next;
        CLX_TRY(read_page(t, *n_page + 1, &at, &next));
        if (*n_page == 0) {
            *first = next;
        }
        CLX_CHECK(next.width == first->width && next.height == first->height, CLAST_E_FORMAT,
                  "TIFF: page %d is %u x %u, the first %u x %u: slices of a volume are alike",
                  *n_page + 1, next.width, next.height, first->width, first->height);
        // every page has its own directory of 18 bytes or more: a longer chain runs in a circle
        CLX_CHECK((double)*n_page * 18.0 < (double)t->n &&
                      (double)first->width * first->height * (*n_page + 1) <= held,
                  CLAST_E_FORMAT, "TIFF: pages promise more values than %zu bytes can hold", t->n);
    }
    CLX_CHECK(*n_page > 0, CLAST_E_FORMAT, "TIFF: no page");
done:
    return status;
}

/// Slices that the description promises (ImageJ: "images=N"); 0 when it says nothing.
static int64_t promised(const tiff *t, const page *p)
{
    static const char word[] = "images=";
    const size_t n_word = sizeof word - 1;
    for (size_t i = 0; i + n_word < p->n_text; ++i) {
        if (memcmp(t->bytes + p->text + i, word, n_word) == 0) {
            int64_t n = 0;
            for (size_t k = i + n_word; k < p->n_text && n < INT32_MAX; ++k) {
                const int digit = t->bytes[p->text + k] - '0';
                if (digit < 0 || digit > 9) {
                    break;
                }
                n = 10 * n + digit;
            }
            return n;
        }
    }
    return 0;
}

clast_status clx_tiff_parse(const uint8_t *bytes, size_t n, clast_volume *volume)
{
    clast_status status = CLAST_OK;
    const tiff t = {bytes, n, bytes[0] == 'M'};
    uint8_t *scratch = NULL;
    page p = {0};
    int32_t n_page = 0;
    CLX_CHECK(number(&t, 2, 2) == CLASSIC, CLAST_E_FORMAT,
              "TIFF: a BigTIFF; " CONVERT " (beyond 4 GiB: save it as NRRD or bare values)");
    CLX_TRY(count_pages(&t, &p, &n_page));
    CLX_CHECK(promised(&t, &p) <= n_page, CLAST_E_FORMAT,
              "TIFF: %lld slices are promised and %d have a page; save the stack with a page a "
              "slice, or as NRRD or bare values",
              (long long)promised(&t, &p), n_page);
    const int32_t size[3] = {(int32_t)p.width, (int32_t)p.height, n_page};
    CLX_TRY(clast_volume_alloc(size, volume));
    CLX_TRY(clx_alloc(&scratch, (int64_t)p.width * p.height * 4, 1));
    size_t at = number(&t, 4, 4);
    for (int32_t k = 0; k < n_page; ++k) {
        CLX_TRY(read_page(&t, k + 1, &at, &p));
        CLX_TRY(read_strips(&t, &p, k, scratch, volume));
    }
done:
    clx_free(scratch);
    return status;
}
