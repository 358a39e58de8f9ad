// NRRD: a text header, an empty line, the values.        [teem, "Definition of NRRD File Format"]
#include "io/volume_io.h"

#include "base/alloc.h"
#include "base/number.h"
#include <clast/volume.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    int32_t n[3];
    double edge[3];
    double unit_m;
    clast_volume_type type;
    bool has_type, has_encoding, is_gzip, is_big_endian, has_endian;
    int32_t dimension;
} header;

bool clx_nrrd_is(const uint8_t *bytes, size_t n)
{
    return n >= 8 && memcmp(bytes, "NRRD000", 7) == 0;
}

static clast_status read_type(const char *text, header *h)
{
    static const struct {
        const char *name;
        clast_volume_type type;
    } names[] = {
        {"uchar", CLAST_VOLUME_U8},       {"unsigned char", CLAST_VOLUME_U8},
        {"uint8", CLAST_VOLUME_U8},       {"uint8_t", CLAST_VOLUME_U8},
        {"signed char", CLAST_VOLUME_I8}, {"int8", CLAST_VOLUME_I8},
        {"int8_t", CLAST_VOLUME_I8},      {"short", CLAST_VOLUME_I16},
        {"short int", CLAST_VOLUME_I16},  {"signed short", CLAST_VOLUME_I16},
        {"int16", CLAST_VOLUME_I16},      {"int16_t", CLAST_VOLUME_I16},
        {"ushort", CLAST_VOLUME_U16},     {"unsigned short", CLAST_VOLUME_U16},
        {"uint16", CLAST_VOLUME_U16},     {"uint16_t", CLAST_VOLUME_U16},
        {"int", CLAST_VOLUME_I32},        {"signed int", CLAST_VOLUME_I32},
        {"int32", CLAST_VOLUME_I32},      {"int32_t", CLAST_VOLUME_I32},
        {"uint", CLAST_VOLUME_U32},       {"unsigned int", CLAST_VOLUME_U32},
        {"uint32", CLAST_VOLUME_U32},     {"uint32_t", CLAST_VOLUME_U32},
        {"float", CLAST_VOLUME_F32},      {"double", CLAST_VOLUME_F64},
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i) {
        if (strcmp(text, names[i].name) == 0) {
            h->type = names[i].type;
            h->has_type = true;
            return CLAST_OK;
        }
    }
    return clx_fail(CLAST_E_FORMAT, "NRRD: type '%.40s' is not read", text);
}

/// Three numbers parted by blanks.
static bool three(const char *text, double value[3])
{
    for (int k = 0; k < 3; ++k) {
        char *end = NULL;
        value[k] = clx_number_read(text, &end);
        if (end == text) {
            return false;
        }
        text = end;
    }
    return true;
}

static clast_status read_sizes(const char *text, header *h)
{
    double size[3];
    if (!three(text, size)) {
        return clx_fail(CLAST_E_FORMAT, "NRRD: sizes '%.40s' are not three numbers", text);
    }
    for (int k = 0; k < 3; ++k) {
        if (!(size[k] >= 1.0 && size[k] < 0x1p31 && size[k] == floor(size[k]))) {
            return clx_fail(CLAST_E_FORMAT, "NRRD: a size of %g voxels", size[k]);
        }
        h->n[k] = (int32_t)size[k];
    }
    return CLAST_OK;
}

static clast_status read_spacings(const char *text, header *h)
{
    return three(text, h->edge)
               ? CLAST_OK
               : clx_fail(CLAST_E_FORMAT, "NRRD: spacings '%.40s' are not three numbers", text);
}

/// " ( a , b , c )" with blanks anywhere; the place after it, NULL for another text.
static const char *vector_of(const char *text, double value[3])
{
    for (int k = 0; k < 3; ++k) {
        char *end = NULL;
        text += strspn(text, " \t");
        if (*text != (k == 0 ? '(' : ',')) {
            return NULL;
        }
        value[k] = clx_number_read(++text, &end);
        if (end == text) {
            return NULL;
        }
        text = end;
    }
    text += strspn(text, " \t");
    return *text == ')' ? text + 1 : NULL;
}

/// "(a,0,0) (0,b,0) (0,0,c)": the lengths of the three steps; they must be at right angles.
static clast_status read_directions(const char *text, header *h)
{
    double step[3][3];
    for (int i = 0; i < 3; ++i) {
        text = vector_of(text, step[i]);
        if (text == NULL) {
            return clx_fail(CLAST_E_FORMAT, "NRRD: space directions are not three vectors");
        }
        h->edge[i] = hypot(hypot(step[i][0], step[i][1]), step[i][2]);
    }
    for (int i = 0; i < 3; ++i) {
        const double *a = step[i];
        const double *b = step[(i + 1) % 3];
        const double along = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        if (!(fabs(along) <= 1e-6 * h->edge[i] * h->edge[(i + 1) % 3])) {
            return clx_fail(CLAST_E_FORMAT, "NRRD: the axes are oblique; resample the volume");
        }
    }
    return CLAST_OK;
}

/// "mm" "mm" "mm": all axes in one unit.
static clast_status read_units(const char *all, header *h)
{
    const char *text = all;
    for (int k = 0; k < 3; ++k) {
        char unit[32] = "";
        const char *open = strchr(text, '"');
        if (open == NULL) {
            break;
        }
        const size_t n = strcspn(open + 1, "\"");
        (void)snprintf(unit, sizeof unit, "%.*s", n < sizeof unit ? (int)n : 0, open + 1);
        const double metre = clx_volume_unit(unit);
        if (k > 0 && metre != h->unit_m) {
            return clx_fail(CLAST_E_FORMAT, "NRRD: the axes have different units: %.60s", all);
        }
        h->unit_m = metre;
        text = open + 1 + n + (open[1 + n] != '\0');
    }
    return CLAST_OK;
}

static clast_status read_encoding(const char *text, header *h)
{
    h->is_gzip = strcmp(text, "gzip") == 0 || strcmp(text, "gz") == 0;
    h->has_encoding = h->is_gzip || strcmp(text, "raw") == 0;
    return h->has_encoding
               ? CLAST_OK
               : clx_fail(CLAST_E_FORMAT, "NRRD: encoding '%.40s' is not read; write raw or gzip",
                          text);
}

static clast_status read_field(const char *name, const char *text, header *h)
{
    if (strcmp(name, "type") == 0) {
        return read_type(text, h);
    }
    if (strcmp(name, "dimension") == 0) {
        h->dimension = (int32_t)strtol(text, NULL, 10);
        return h->dimension == 3
                   ? CLAST_OK
                   : clx_fail(CLAST_E_FORMAT, "NRRD: dimension '%.40s'; a volume has 3", text);
    }
    if (strcmp(name, "sizes") == 0) {
        return read_sizes(text, h);
    }
    if (strcmp(name, "spacings") == 0) {
        return read_spacings(text, h);
    }
    if (strcmp(name, "space directions") == 0) {
        return read_directions(text, h);
    }
    if (strcmp(name, "space units") == 0 || strcmp(name, "units") == 0) {
        return read_units(text, h);
    }
    if (strcmp(name, "encoding") == 0) {
        return read_encoding(text, h);
    }
    if (strcmp(name, "endian") == 0) {
        h->is_big_endian = strcmp(text, "big") == 0;
    }
    if (strcmp(name, "data file") == 0 || strcmp(name, "datafile") == 0 ||
        strcmp(name, "byte skip") == 0 || strcmp(name, "line skip") == 0) {
        return clx_fail(CLAST_E_FORMAT,
                        "NRRD: '%s' (values in another place) is not read; give the values' file "
                        "with --voxels NX,NY,NZ",
                        name);
    }
    return CLAST_OK; // another field says nothing about the values
}

/// One line of the header without its end; lines of comments and `key:=value` are passed over.
static clast_status read_line(const char *line, header *h)
{
    char name[64];
    const char *colon = strstr(line, ": ");
    if (line[0] == '#' || colon == NULL || (size_t)(colon - line) >= sizeof name) {
        return CLAST_OK;
    }
    (void)snprintf(name, sizeof name, "%.*s", (int)(colon - line), line);
    return read_field(name, colon + 2, h);
}

/// Reads lines up to the empty one; *at is then the first byte of the values.
static clast_status read_header(const uint8_t *bytes, size_t n, header *h, size_t *at)
{
    clast_status status = CLAST_OK;
    for (*at = 0; *at < n;) {
        char line[512];
        const uint8_t *start = bytes + *at;
        const uint8_t *end = memchr(start, '\n', n - *at);
        CLX_CHECK(end != NULL, CLAST_E_FORMAT, "NRRD: the header ends without an empty line");
        size_t length = (size_t)(end - start);
        *at += length + 1;
        length -= length > 0 && start[length - 1] == '\r';
        if (length == 0) {
            break;
        }
        CLX_CHECK(memchr(start, 0, length) == NULL, CLAST_E_FORMAT, "NRRD: a zero in the header");
        if (length < sizeof line) { // longer ones are keys of other programs
            memcpy(line, start, length);
            line[length] = '\0';
            CLX_TRY(read_line(line, h));
        }
    }
    CLX_CHECK(h->has_type && h->has_encoding && h->dimension == 3 && h->n[0] > 0, CLAST_E_FORMAT,
              "NRRD: the header lacks type, dimension, sizes or encoding");
done:
    return status;
}

clast_status clx_nrrd_parse(const uint8_t *bytes, size_t n, clast_volume *volume)
{
    clast_status status = CLAST_OK;
    header h = {.edge = {1.0, 1.0, 1.0}};
    uint8_t *unpacked = NULL;
    size_t at = 0;
    CLX_TRY(read_header(bytes, n, &h, &at));
    const double wanted = (double)h.n[0] * h.n[1] * h.n[2] * clast_volume_type_size(h.type);
    const double held = (double)(n - at) * (h.is_gzip ? CLX_MOST_RATIO : 1);
    CLX_CHECK(wanted <= held, CLAST_E_FORMAT,
              "NRRD: %d x %d x %d voxels are %.0f bytes; the file has %zu after its header", h.n[0],
              h.n[1], h.n[2], wanted, n - at);
    CLX_CHECK(
        h.is_gzip || wanted == held, CLAST_E_FORMAT,
        "NRRD: %d x %d x %d voxels are %.0f bytes; the file has %zu, so its sizes or type are "
        "wrong",
        h.n[0], h.n[1], h.n[2], wanted, n - at);
    CLX_TRY(clast_volume_alloc(h.n, volume));
    if (h.is_gzip) {
        CLX_TRY(clx_alloc(&unpacked, (int64_t)wanted, 1));
        CLX_TRY(clx_inflate(bytes + at, n - at, unpacked, (size_t)wanted));
    }
    clast_volume_fill(volume, 0, (int64_t)h.n[0] * h.n[1] * h.n[2], h.type, h.is_big_endian,
                      h.is_gzip ? unpacked : bytes + at);
    for (int k = 0; k < 3; ++k) {
        volume->edge[k] = h.edge[k];
    }
    volume->unit_m = h.unit_m;
done:
    clx_free(unpacked);
    return status;
}
