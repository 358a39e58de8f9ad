// Which surface format a file's bytes show.
#include "io/mesh_io.h"
#include "io/text.h"
#include <string.h>

static const uint8_t *as_bytes(const void *bytes)
{
    return bytes;
}

/// A byte-order mark of UTF-16 or UTF-32, or letters with zero bytes between them.
bool clx_text_is_utf16(const void *bytes, size_t n)
{
    const uint8_t *b = as_bytes(bytes);
    if (n >= 2 && ((b[0] == 0xFE && b[1] == 0xFF) || (b[0] == 0xFF && b[1] == 0xFE))) {
        return true;
    }
    int zeros[2] = {0};
    const size_t seen = n < 64 ? n & ~(size_t)1 : 64;
    for (size_t i = 0; i < seen; ++i) {
        zeros[i % 2] += b[i] == 0;
    }
    const int half = (int)(seen / 2);
    return half >= 2 &&
           ((zeros[0] == half && zeros[1] == 0) || (zeros[1] == half && zeros[0] == 0));
}

/// First word of the first lines is one that OBJ files begin with.
static bool looks_like_obj(const void *bytes, size_t n)
{
    static const char *const words[] = {"v", "vt", "vn",     "vp",     "f", "o",
                                        "g", "s",  "mtllib", "usemtl", "l", "p"};
    clx_text text = clx_text_begin(bytes, n, '#', true);
    clx_word word;
    if (!clx_text_any_word(&text, &word)) {
        return false;
    }
    for (size_t i = 0; i < sizeof words / sizeof words[0]; ++i) {
        if (clx_word_is(word, words[i])) {
            return true;
        }
    }
    return false;
}

static bool has_zero(const void *bytes, size_t n)
{
    return n > 0 && memchr(bytes, 0, n < 1024 ? n : 1024) != NULL;
}

clast_mesh_format clx_mesh_detect(const void *bytes, size_t n)
{
    const char *text = bytes;
    clx_text first = clx_text_begin(bytes, n, '\0', false);
    clx_word word;
    if (n >= 4 && memcmp(text, "PK\3\4", 4) == 0) {
        return CLAST_MESH_3MF;
    }
    if (n >= 4 && memcmp(text, "ply", 3) == 0 && clx_text_word(&first, &word) && word.n == 3) {
        return CLAST_MESH_PLY;
    }
    if (clx_stl_is_exact(bytes, n)) {
        return CLAST_MESH_STL;
    }
    if (clx_text_any_word(&first, &word) && clx_word_is(word, "solid")) {
        return CLAST_MESH_STL;
    }
    if (has_zero(bytes, n)) {
        return CLAST_MESH_ANY;
    }
    if (clx_off_is_magic(text, n)) {
        return CLAST_MESH_OFF;
    }
    return looks_like_obj(bytes, n) ? CLAST_MESH_OBJ : CLAST_MESH_ANY;
}
