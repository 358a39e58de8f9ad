// TIFF by libtiff: a page is a slice of the volume, in strips or tiles.  [docs/adr/0004-tiff.md]
#include "io/volume_io.h"

#include "base/status.h"
#include <clast/volume.h>
#include <string.h>

bool clx_tiff_is(const uint8_t *bytes, size_t n)
{
    return n >= 8 && (memcmp(bytes, "II*\0", 4) == 0 || memcmp(bytes, "MM\0*", 4) == 0 ||
                      memcmp(bytes, "II+\0", 4) == 0 || memcmp(bytes, "MM\0+", 4) == 0);
}

#if CLAST_HAVE_TIFF
#include "base/alloc.h"
#include "base/number.h"
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <tiffio.h>

/// A file in memory, as libtiff reads it, and the first thing that it found wrong.
typedef struct {
    const uint8_t *bytes;
    uint64_t n, at;
    char fault[256];
} source;

/// Size and kind of a page's values.
typedef struct {
    uint32_t width, height, rows; ///< of a strip or tile
    uint32_t tile_width;          ///< or 0: strips
    int size;                     ///< bytes of a value
    clast_volume_type type;
} page;

/// What a file's description says.
typedef struct {
    double n_slice, n_volume; ///< slices that it promises; channels times times, 1 is a volume
    double edge[3], unit_m;   ///< of a voxel
} described;

static tmsize_t read_bytes(thandle_t handle, void *to, tmsize_t n)
{
    source *s = (source *)handle;
    const uint64_t left = s->at < s->n ? s->n - s->at : 0;
    const uint64_t given = (uint64_t)n < left ? (uint64_t)n : left;
    memcpy(to, s->bytes + (given > 0 ? s->at : 0), (size_t)given);
    s->at += given;
    return (tmsize_t)given;
}

static tmsize_t write_bytes(thandle_t handle, void *from, tmsize_t n)
{
    (void)handle;
    (void)from;
    (void)n;
    return 0;
}

static toff_t seek_byte(thandle_t handle, toff_t to, int whence)
{
    source *s = (source *)handle;
    s->at = to + (whence == SEEK_CUR ? s->at : whence == SEEK_END ? s->n : 0);
    return s->at;
}

static int close_source(thandle_t handle)
{
    (void)handle;
    return 0;
}

static toff_t size_of_source(thandle_t handle)
{
    return ((source *)handle)->n;
}

static int keep_fault(TIFF *file, void *context, const char *module, const char *format,
                      va_list words)
{
    source *s = context;
    (void)file;
    (void)module;
    if (s->fault[0] == '\0') {
        (void)clx_number_print_list(s->fault, sizeof s->fault, format, words);
    }
    return 1; // said
}

static int drop_warning(TIFF *file, void *context, const char *module, const char *format,
                        va_list words)
{
    (void)file;
    (void)context;
    (void)module;
    (void)format;
    (void)words;
    return 1;
}

/// Opens the bytes; libtiff may ask for no more memory at once than the file can be packed from.
static clast_status open_source(source *s, TIFF **file)
{
    clast_status status = CLAST_OK;
    const double most = (double)s->n * CLX_MOST_RATIO;
    TIFFOpenOptions *options = TIFFOpenOptionsAlloc();
    CLX_CHECK(options != NULL, CLAST_E_MEMORY, "TIFF: not enough memory");
    TIFFOpenOptionsSetMaxSingleMemAlloc(options, most < 1e15 ? (tmsize_t)most : (tmsize_t)1e15);
    TIFFOpenOptionsSetErrorHandlerExtR(options, keep_fault, s);
    TIFFOpenOptionsSetWarningHandlerExtR(options, drop_warning, s);
    *file = TIFFClientOpenExt("TIFF", "rm", (thandle_t)s, read_bytes, write_bytes, seek_byte,
                              close_source, size_of_source, NULL, NULL, options);
    CLX_CHECK(*file != NULL, CLAST_E_FORMAT, "TIFF: %s", s->fault);
done:
    TIFFOpenOptionsFree(options);
    return status;
}

static bool find_type(int bits, int format, clast_volume_type *type)
{
    static const struct {
        int bits, format;
        clast_volume_type type;
    } known[] = {
        {8, SAMPLEFORMAT_UINT, CLAST_VOLUME_U8},     {8, SAMPLEFORMAT_INT, CLAST_VOLUME_I8},
        {16, SAMPLEFORMAT_UINT, CLAST_VOLUME_U16},   {16, SAMPLEFORMAT_INT, CLAST_VOLUME_I16},
        {32, SAMPLEFORMAT_UINT, CLAST_VOLUME_U32},   {32, SAMPLEFORMAT_INT, CLAST_VOLUME_I32},
        {32, SAMPLEFORMAT_IEEEFP, CLAST_VOLUME_F32}, {64, SAMPLEFORMAT_IEEEFP, CLAST_VOLUME_F64}};
    for (size_t k = 0; k < sizeof known / sizeof *known; ++k) {
        if (known[k].bits == bits && known[k].format == format) {
            *type = known[k].type;
            return true;
        }
    }
    return false;
}

/// Packings that keep every value, and no more of them than CLX_MOST_RATIO times their bytes.
static bool is_packing_read(int packing)
{
    return packing == COMPRESSION_NONE || packing == COMPRESSION_LZW ||
           packing == COMPRESSION_PACKBITS || packing == COMPRESSION_ADOBE_DEFLATE ||
           packing == COMPRESSION_DEFLATE;
}

/// The page at which the file stands, number k from 1.
static clast_status read_page(TIFF *file, int32_t k, page *p)
{
    clast_status status = CLAST_OK;
    uint16_t bits = 1;
    uint16_t samples = 1;
    uint16_t format = SAMPLEFORMAT_UINT;
    uint16_t packing = COMPRESSION_NONE;
    *p = (page){0};
    (void)TIFFGetField(file, TIFFTAG_IMAGEWIDTH, &p->width);
    (void)TIFFGetField(file, TIFFTAG_IMAGELENGTH, &p->height);
    (void)TIFFGetFieldDefaulted(file, TIFFTAG_BITSPERSAMPLE, &bits);
    (void)TIFFGetFieldDefaulted(file, TIFFTAG_SAMPLESPERPIXEL, &samples);
    (void)TIFFGetFieldDefaulted(file, TIFFTAG_SAMPLEFORMAT, &format);
    (void)TIFFGetFieldDefaulted(file, TIFFTAG_COMPRESSION, &packing);
    CLX_CHECK(p->width > 0 && p->height > 0 && p->width < INT32_MAX && p->height < INT32_MAX,
              CLAST_E_FORMAT, "TIFF: page %d is %u x %u", k, p->width, p->height);
    CLX_CHECK(samples == 1, CLAST_E_FORMAT,
              "TIFF: page %d has %u samples a pixel; grey values or labels have one", k, samples);
    CLX_CHECK(
        find_type(bits, format == SAMPLEFORMAT_VOID ? SAMPLEFORMAT_UINT : format, &p->type),
        CLAST_E_FORMAT,
        "TIFF: page %d has %u bits a pixel of kind %u; whole numbers of 8, 16 and 32 bits and "
        "floats of 32 and 64 are read",
        k, bits, format);
    CLX_CHECK(is_packing_read(packing), CLAST_E_FORMAT,
              "TIFF: page %d is packed by method %u; none, LZW, deflate and PackBits are read: "
              "`tiffcp -c lzw IN OUT` writes one",
              k, packing);
    p->size = bits / 8;
    if (TIFFIsTiled(file)) {
        (void)TIFFGetField(file, TIFFTAG_TILEWIDTH, &p->tile_width);
        (void)TIFFGetField(file, TIFFTAG_TILELENGTH, &p->rows);
        CLX_CHECK(p->tile_width > 0 && p->rows > 0, CLAST_E_FORMAT,
                  "TIFF: page %d has tiles of %u x %u", k, p->tile_width, p->rows);
    } else {
        (void)TIFFGetFieldDefaulted(file, TIFFTAG_ROWSPERSTRIP, &p->rows);
        p->rows = p->rows == 0 || p->rows > p->height ? p->height : p->rows;
    }
done:
    return status;
}

/// Counts pages; all must be of one size and together fit the file.
static clast_status count_pages(TIFF *file, const source *s, page *first, int32_t *n_page)
{
    clast_status status = CLAST_OK;
    const double held = (double)s->n * CLX_MOST_RATIO;
    page next;
    for (*n_page = 0; *n_page == 0 || !TIFFLastDirectory(file); ++*n_page) {
        CLX_CHECK(*n_page == 0 || TIFFReadDirectory(file), CLAST_E_FORMAT, "TIFF: page %d: %s",
                  *n_page + 1,
                  s->fault[0] != '\0' ? s->fault : "pages follow each other in a circle");
        CLX_TRY(read_page(file, *n_page + 1, &next));
        if (*n_page == 0) {
            *first = next;
        }
        CLX_CHECK(next.width == first->width && next.height == first->height, CLAST_E_FORMAT,
                  "TIFF: page %d is %u x %u, the first %u x %u: slices of a volume have one size",
                  *n_page + 1, next.width, next.height, first->width, first->height);
        CLX_CHECK((double)first->width * first->height * (*n_page + 1) <= held, CLAST_E_FORMAT,
                  "TIFF: pages promise more values than %" PRIu64 " bytes can hold", s->n);
    }
done:
    return status;
}

/// What stands behind `key` at the begin of a line or word of the text, up to `end`; "" without.
static void find_value(const char *text, const char *key, char end, char value[32])
{
    const size_t n = strlen(key);
    value[0] = '\0';
    for (const char *at = strstr(text, key); at != NULL; at = strstr(at + n, key)) {
        if (at == text || at[-1] == '\n' || at[-1] == ' ') {
            const char *stop = strchr(at + n, end);
            const size_t length = stop != NULL ? (size_t)(stop - at) - n : strlen(at + n);
            (void)snprintf(value, 32, "%.*s", length < 32 ? (int)length : 31, at + n);
            return;
        }
    }
}

static double find_number(const char *text, const char *key, char end)
{
    char value[32];
    char *stop = NULL;
    find_value(text, key, end, value);
    return clx_number_read(value, &stop); // 0 of another text
}

/// An edge that the file states in a sensible way, else what it was.
static void read_edge(double stated, double *edge)
{
    if (stated > 0.0 && isfinite(stated)) {
        *edge = stated;
    }
}

/// ImageJ's lines `images=N`, `unit=micron`, `spacing=` of slices; pixels in a unit are the page's
/// resolution. A stack without spacing has 1.
static void read_imagej(TIFF *file, const char *text, described *d)
{
    float per_unit[2] = {0.0F, 0.0F};
    char unit[32];
    d->n_slice = find_number(text, "images=", '\n');
    d->n_volume = fmax(1.0, find_number(text, "channels=", '\n')) *
                  fmax(1.0, find_number(text, "frames=", '\n'));
    (void)TIFFGetField(file, TIFFTAG_XRESOLUTION, &per_unit[0]);
    (void)TIFFGetField(file, TIFFTAG_YRESOLUTION, &per_unit[1]);
    read_edge(1.0 / (double)per_unit[0], &d->edge[0]);
    read_edge(1.0 / (double)per_unit[1], &d->edge[1]);
    read_edge(fabs(find_number(text, "spacing=", '\n')), &d->edge[2]);
    find_value(text, "unit=", '\n', unit);
    d->unit_m = clx_volume_unit(unit);
}

/// The same of OME-TIFF's XML; sizes of a pixel without a unit are in micrometres.
static void read_ome(const char *text, described *d)
{
    static const char *const edge[3] = {"PhysicalSizeX=\"", "PhysicalSizeY=\"", "PhysicalSizeZ=\""};
    static const char *const unit[3] = {"PhysicalSizeXUnit=\"", "PhysicalSizeYUnit=\"",
                                        "PhysicalSizeZUnit=\""};
    double metre[3];
    d->n_slice = find_number(text, "SizeZ=\"", '"');
    d->n_volume = fmax(1.0, find_number(text, "SizeC=\"", '"')) *
                  fmax(1.0, find_number(text, "SizeT=\"", '"'));
    for (int k = 0; k < 3; ++k) {
        char word[32];
        find_value(text, unit[k], '"', word);
        metre[k] = clx_volume_unit(word[0] != '\0' ? word : "um");
        const double stated = find_number(text, edge[k], '"');
        d->unit_m = k == 0 && stated > 0.0 ? metre[0] : d->unit_m;
        read_edge(metre[k] == metre[0] ? stated : stated * metre[k] / metre[0], &d->edge[k]);
    }
}

/// What the first page's description says of the volume: edges 1 and no unit where it says nothing.
static described read_description(TIFF *file)
{
    described d = {.edge = {1.0, 1.0, 1.0}, .n_volume = 1.0};
    const char *text = NULL;
    if (!TIFFGetField(file, TIFFTAG_IMAGEDESCRIPTION, &text) || text == NULL) {
        return d;
    }
    if (strncmp(text, "ImageJ=", 7) == 0) {
        read_imagej(file, text, &d);
    } else if (strstr(text, "<OME") != NULL) {
        read_ome(text, &d);
    }
    return d;
}

/// Values of the page into its slice; `scratch` has room for a strip or tile.
static clast_status read_values(TIFF *file, const source *s, const page *p, int32_t slice,
                                uint8_t *scratch, clast_volume *volume)
{
    clast_status status = CLAST_OK;
    const bool is_big = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__; // libtiff gives the host's
    const int64_t first = (int64_t)slice * volume->n[0] * volume->n[1];
    const uint32_t width = p->tile_width > 0 ? p->tile_width : p->width;
    for (uint32_t row = 0; row < p->height; row += p->rows) {
        const uint32_t rows = p->height - row < p->rows ? p->height - row : p->rows;
        for (uint32_t column = 0; column < p->width; column += width) {
            const uint32_t columns = p->width - column < width ? p->width - column : width;
            const tmsize_t wanted =
                (tmsize_t)(p->tile_width > 0 ? p->rows : rows) * width * p->size;
            const tmsize_t got =
                p->tile_width > 0
                    ? TIFFReadEncodedTile(file, TIFFComputeTile(file, column, row, 0, 0), scratch,
                                          wanted)
                    : TIFFReadEncodedStrip(file, TIFFComputeStrip(file, row, 0), scratch, wanted);
            CLX_CHECK(got == wanted, CLAST_E_FORMAT, "TIFF: page %d, row %u, column %u: %s",
                      slice + 1, row, column,
                      s->fault[0] != '\0' ? s->fault : "values are missing");
            for (uint32_t r = 0; r < rows; ++r) {
                clast_volume_fill(volume, first + (int64_t)(row + r) * p->width + column, columns,
                                  p->type, is_big, scratch + (size_t)r * width * (size_t)p->size);
            }
        }
    }
done:
    return status;
}

/// Room for the greatest strip or tile; one that the file cannot hold is refused.
static clast_status make_scratch(const source *s, const page *p, uint8_t **scratch,
                                 int64_t *capacity)
{
    clast_status status = CLAST_OK;
    const double n =
        (double)(p->tile_width > 0 ? p->tile_width : p->width) * (double)p->rows * p->size;
    CLX_CHECK(n <= (double)s->n * CLX_MOST_RATIO, CLAST_E_FORMAT,
              "TIFF: a strip or tile of %.0f bytes in a file of %" PRIu64, n, s->n);
    if ((int64_t)n > *capacity) {
        clx_free(*scratch);
        *scratch = NULL;
        *capacity = (int64_t)n;
        CLX_TRY(clx_alloc(scratch, *capacity, 1));
    }
done:
    return status;
}

clast_status clx_tiff_parse(const uint8_t *bytes, size_t n, clast_volume *volume)
{
    clast_status status = CLAST_OK;
    source s = {.bytes = bytes, .n = n};
    TIFF *file = NULL;
    uint8_t *scratch = NULL;
    int64_t capacity = 0;
    page p = {0};
    int32_t n_page = 0;
    CLX_TRY(open_source(&s, &file));
    const described d = read_description(file);
    CLX_TRY(count_pages(file, &s, &p, &n_page));
    CLX_CHECK(d.n_slice <= n_page, CLAST_E_FORMAT,
              "TIFF: %.0f slices are promised and %d have a page; save the stack with a page a "
              "slice, or as NRRD or bare values",
              d.n_slice, n_page);
    CLX_CHECK(d.n_volume == 1.0, CLAST_E_FORMAT,
              "TIFF: %.0f channels or times in one stack; save one of them as a stack of its own "
              "(ImageJ: Image > Duplicate)",
              d.n_volume);
    const int32_t size[3] = {(int32_t)p.width, (int32_t)p.height, n_page};
    CLX_TRY(clast_volume_alloc(size, volume));
    for (int k = 0; k < 3; ++k) {
        volume->edge[k] = d.edge[k];
    }
    volume->unit_m = d.unit_m;
    CLX_CHECK(TIFFSetDirectory(file, 0), CLAST_E_FORMAT, "TIFF: %s", s.fault);
    for (int32_t k = 0; k < n_page; ++k) {
        CLX_CHECK(k == 0 || TIFFReadDirectory(file), CLAST_E_FORMAT, "TIFF: page %d: %s", k + 1,
                  s.fault);
        CLX_TRY(read_page(file, k + 1, &p));
        CLX_TRY(make_scratch(&s, &p, &scratch, &capacity));
        CLX_TRY(read_values(file, &s, &p, k, scratch, volume));
    }
done:
    if (file != NULL) {
        TIFFClose(file);
    }
    clx_free(scratch);
    return status;
}

#else
clast_status clx_tiff_parse(const uint8_t *bytes, size_t n, clast_volume *volume)
{
    (void)bytes;
    (void)n;
    (void)volume;
    return clx_fail(
        CLAST_E_USAGE,
        "TIFF: this clast was built without libtiff (tools/setup.sh build installs it); "
        "NRRD and bare values are read");
}
#endif
