// Pieces of JSON: texts and numbers. Jansson is for reading and for the commands' summaries; tables
// and manifests are written without a tree in memory.                                   [RFC 8259]
#include "io/json.h"

#include "base/alloc.h"
#include "base/file.h"
#include "base/number.h"
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Bytes of the UTF-8 character at `c`, or 0 if there is none (overlong, surrogate, cut short).
static size_t utf8_length(const unsigned char *c)
{
    size_t n = 0;
    uint32_t point = 0;
    static const uint32_t least[5] = {0, 0, 0x80, 0x800, 0x10000};
    if (c[0] < 0x80) {
        return 1;
    }
    n = c[0] >= 0xf0 && c[0] < 0xf5 ? 4 : c[0] >= 0xe0 ? 3 : c[0] >= 0xc2 ? 2 : 0;
    if (n == 0 || c[0] >= 0xf5) {
        return 0;
    }
    point = c[0] & (0xffu >> (n + 1));
    for (size_t i = 1; i < n; ++i) {
        if ((c[i] & 0xc0) != 0x80) {
            return 0;
        }
        point = point << 6 | (c[i] & 0x3fu);
    }
    return point < least[n] || point > 0x10ffff || (point >= 0xd800 && point < 0xe000) ? 0 : n;
}

const char *clx_json_next(const char *text, char out[CLX_JSON_STEP], size_t *n)
{
    const size_t length = utf8_length((const unsigned char *)text);
    if (length == 0) {
        out[0] = '\xef';
        out[1] = '\xbf';
        out[2] = '\xbd';
        *n = 3;
        return text + 1;
    }
    if (*text == '"' || *text == '\\') {
        out[0] = '\\';
        out[1] = *text;
        *n = 2;
    } else if ((unsigned char)*text < 0x20 || *text == 0x7f) {
        *n = (size_t)snprintf(out, CLX_JSON_STEP, "\\u%04x", (unsigned)(unsigned char)*text);
    } else {
        memcpy(out, text, length);
        *n = length;
    }
    return text + length;
}

void clx_json_text(clx_file *file, const char *text)
{
    (void)clx_file_write(file, "\"", 1);
    while (*text != '\0') {
        char out[CLX_JSON_STEP];
        size_t n = 0;
        text = clx_json_next(text, out, &n);
        (void)clx_file_write(file, out, n);
    }
    (void)clx_file_write(file, "\"", 1);
}

void clx_json_number(clx_file *file, double value)
{
    char text[CLX_NUMBER_SIZE];
    if (isfinite(value)) {
        const int n = clx_number_format(value, text);
        (void)clx_file_write(file, text, (size_t)n);
    } else {
        (void)clx_file_write(file, "null", 4);
    }
}

void clx_json_set_number(json_t *object, const char *key, double value)
{
    (void)json_object_set_new(object, key, isfinite(value) ? json_real(value) : json_null());
}

void clx_json_set_count(json_t *object, const char *key, int64_t value)
{
    (void)json_object_set_new(object, key, json_integer((json_int_t)value));
}

clast_status clx_json_dump(const json_t *object, char **text)
{
    clast_status status = CLAST_OK;
    char *dumped = json_dumps(object, JSON_INDENT(2) | JSON_REAL_PRECISION(17));
    CLX_CHECK(dumped != NULL, CLAST_E_MEMORY, "no memory for the result");
    CLX_TRY(clx_alloc_text(text, dumped));
done:
    free(dumped); // Jansson's own block
    return status;
}
