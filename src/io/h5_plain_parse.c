// The bytes of an HDF5 file that h5_plain_image.c made, as arrays and attributes in memory. Every
// place and length is checked against the file; what HDF5 itself writes otherwise (chunks, heaps,
// headers in pieces) is refused.
#include "io/h5_plain.h"

#include "base/alloc.h"
#include "io/h5_trailer.h"
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

enum {
    DEPTH_LIMIT = 16,
    MOST_ATTRIBUTES = 1024, // of one object; each new name is compared with all
    HEAD = 10,
    DATASPACE = 1,
    DATATYPE = 3,
    LINK = 6,
    LAYOUT = 8,
    ATTRIBUTE = 12,
    CONTINUED = 16
};

typedef struct {
    const char *bytes;
    int64_t n;
    int64_t *unread; ///< bytes that no header or array has told yet: each lies in its own place
    clx_h5 *h5;
} file;

/// A stretch of the file that is read from its beginning.
typedef struct {
    const char *at;
    int64_t left;
} stretch;

static const char *next_bytes(stretch *s, int64_t n)
{
    const char *at = s->at;
    if (n < 0 || n > s->left) {
        s->left = -1; // everything after it fails too
        return NULL;
    }
    s->at += n;
    s->left -= n;
    return at;
}

static uint64_t read_word(stretch *s, int width)
{
    const char *at = next_bytes(s, width);
    uint64_t word = 0;
    for (int k = 0; at != NULL && k < width; ++k) {
        word |= (uint64_t)(unsigned char)at[k] << 8 * k;
    }
    return word;
}

static clast_status damaged(const file *f)
{
    return clx_fail(CLAST_E_FORMAT, "%s is damaged", f->h5->label);
}

static clast_status foreign(const file *f)
{
    return clx_fail(CLAST_E_USAGE,
                    "%s was written by HDF5 and this clast is built without HDF5: it reads states "
                    "of its own writing (CLAST_HDF5=ON; tools/setup.sh build installs it)",
                    f->h5->label);
}

/// Takes bytes that nothing else has told; false for links that lead to the same place again and
/// again, which would take many times the file's size of memory.
static bool is_told_once(const file *f, int64_t n)
{
    *f->unread -= n <= *f->unread ? n : *f->unread + 1;
    return *f->unread >= 0;
}

/// Type of a number or text; *size are the bytes of one.
static bool read_type(stretch *s, bool *is_text, clx_h5_type *type, int64_t *size)
{
    const uint64_t head = read_word(s, 1);
    const uint64_t bits = read_word(s, 3);
    *size = (int64_t)read_word(s, 4);
    *is_text = head == 0x13;
    if (*is_text) {
        return s->left >= 0 && *size > 0;
    }
    (void)next_bytes(s, head == 0x11 ? 12 : 4);
    if (s->left < 0) {
        return false;
    }
    if (head == 0x11) {
        *type = CLX_H5_F64;
        return *size == 8 && bits == 0x3f20;
    }
    *type = *size == 1 ? CLX_H5_U8 : *size == 4 ? CLX_H5_I32 : bits == 8 ? CLX_H5_I64 : CLX_H5_U64;
    return head == 0x10 && *size == clx_h5_plain_width(*type) &&
           (bits == 8) == (*type == CLX_H5_I32 || *type == CLX_H5_I64);
}

static bool read_space(stretch *s, clx_h5_node *node)
{
    const uint64_t version = read_word(s, 1);
    const uint64_t rank = read_word(s, 1);
    const uint64_t flags = read_word(s, 1);
    const uint64_t kind = read_word(s, 1);
    if (s->left < 0 || version != 2 || rank > CLX_H5_RANK_LIMIT || flags != 0 ||
        kind != (rank > 0 ? 1 : 0)) {
        return false;
    }
    node->rank = (int32_t)rank;
    for (uint64_t d = 0; d < rank; ++d) {
        node->shape[d] = (int64_t)read_word(s, 8);
    }
    return s->left >= 0;
}

/// Whether the array's sizes ask for exactly the bytes that lie within the file.
static bool fits(const file *f, const clx_h5_node *node, uint64_t at, uint64_t size)
{
    const uint64_t n = (uint64_t)f->n;
    uint64_t bytes = (uint64_t)clx_h5_plain_width(node->type);
    for (int32_t d = 0; d < node->rank; ++d) {
        const uint64_t one = (uint64_t)node->shape[d];
        if (one > n || (one > 0 && bytes > n / one)) {
            return false;
        }
        bytes *= one;
    }
    return size == bytes && (size == 0 || (size <= n && at <= n - size));
}

static clast_status read_layout(const file *f, stretch s, clx_h5_node *node)
{
    clast_status status = CLAST_OK;
    const uint64_t version = read_word(&s, 1);
    const uint64_t kind = read_word(&s, 1);
    const uint64_t at = read_word(&s, 8);
    const uint64_t size = read_word(&s, 8);
    if (version != 3 || kind != 1) {
        return foreign(f);
    }
    if (s.left < 0 || !fits(f, node, at, size) || !is_told_once(f, (int64_t)size)) {
        return damaged(f);
    }
    CLX_TRY(clx_alloc(&node->data, (int64_t)size, 1));
    node->size = (int64_t)size;
    if (size > 0) {
        memcpy(node->data, f->bytes + at, (size_t)size);
    }
done:
    return status;
}

static clast_status read_attribute(const file *f, stretch s, int64_t number)
{
    clx_h5_node space = {0};
    bool is_text = false;
    clx_h5_type type = CLX_H5_F64;
    int64_t size = 0;
    const uint64_t version = read_word(&s, 2);
    const int64_t n_name = (int64_t)read_word(&s, 2);
    (void)read_word(&s, 5);
    const char *name = next_bytes(&s, n_name);
    if (version != 3) {
        return foreign(f);
    }
    if (f->h5->node[number].n_attribute >= MOST_ATTRIBUTES) {
        return damaged(f);
    }
    if (name == NULL || n_name < 2 || memchr(name, '\0', (size_t)n_name) != name + n_name - 1 ||
        !read_type(&s, &is_text, &type, &size) || !read_space(&s, &space) || space.rank != 0 ||
        clx_h5_has_attribute(f->h5, f->h5->node[number].name, name)) {
        return damaged(f);
    }
    const char *value = next_bytes(&s, size);
    if (value == NULL || (is_text && value[size - 1] != '\0')) {
        return damaged(f);
    }
    const clx_h5_attribute found = {.name = (char *)name,
                                    .is_text = is_text,
                                    .type = type,
                                    .size = size,
                                    .value = (char *)value};
    return clx_h5_plain_attribute(f->h5, number, &found);
}

static clast_status read_node(const file *f, int64_t number, uint64_t address, int depth);

static clast_status read_link(const file *f, stretch s, int64_t folder, int depth)
{
    clast_status status = CLAST_OK;
    char path[CLX_H5_NAME_LIMIT];
    const char *above = f->h5->node[folder].name;
    int64_t number = 0;
    const uint64_t head = read_word(&s, 3);
    const int64_t n = (int64_t)read_word(&s, 2);
    const char *name = next_bytes(&s, n);
    const uint64_t address = read_word(&s, 8);
    if (head != 0x011101) {
        return foreign(f);
    }
    if (s.left < 0 || n == 0 || memchr(name, '\0', (size_t)n) != NULL ||
        memchr(name, '/', (size_t)n) != NULL ||
        snprintf(path, sizeof path, "%s/%.*s", folder == 0 ? "" : above, (int)n, name) >=
            (int)sizeof path ||
        clx_h5_has(f->h5, path)) {
        return damaged(f);
    }
    CLX_TRY(clx_h5_plain_add(f->h5, path, &number));
    CLX_TRY(read_node(f, number, address, depth + 1));
done:
    return status;
}

/// What a header's message says; links only once the header is known to be a folder's.
static clast_status read_message(const file *f, uint64_t kind, stretch s, int64_t number)
{
    clx_h5_node *node = &f->h5->node[number];
    bool is_text = false;
    int64_t size = 0;
    if ((kind == DATASPACE || kind == DATATYPE || kind == LAYOUT) && !node->is_folder) {
        return damaged(f); // what an array holds is known already
    }
    switch (kind) {
    case DATASPACE:
        return read_space(&s, node) ? CLAST_OK : foreign(f);
    case DATATYPE:
        return read_type(&s, &is_text, &node->type, &size) && !is_text ? CLAST_OK : foreign(f);
    case LAYOUT:
        node->is_folder = false;
        return read_layout(f, s, node);
    case ATTRIBUTE:
        return read_attribute(f, s, number);
    case CONTINUED:
        return foreign(f);
    default:
        return CLAST_OK;
    }
}

/// One round over the messages of a header: links, or all else.
static clast_status read_messages(const file *f, stretch all, int64_t number, int depth, bool links)
{
    clast_status status = CLAST_OK;
    while (all.left > 0) {
        const uint64_t kind = read_word(&all, 1);
        const int64_t size = (int64_t)read_word(&all, 2);
        (void)read_word(&all, 1);
        const char *at = next_bytes(&all, size);
        if (at == NULL) {
            return damaged(f);
        }
        const stretch one = {at, size};
        if (links && kind == LINK) {
            CLX_TRY(read_link(f, one, number, depth));
        } else if (!links && kind != LINK) {
            CLX_TRY(read_message(f, kind, one, number));
        }
    }
done:
    return status;
}

static clast_status read_node(const file *f, int64_t number, uint64_t address, int depth)
{
    clast_status status = CLAST_OK;
    if (depth > DEPTH_LIMIT || address > (uint64_t)f->n) {
        return damaged(f);
    }
    stretch s = {f->bytes + address, f->n - (int64_t)address};
    const char *head = next_bytes(&s, HEAD - 4);
    const int64_t size = (int64_t)read_word(&s, 4);
    const char *messages = next_bytes(&s, size);
    const uint64_t sum = read_word(&s, 4);
    if (head == NULL || memcmp(head, "OHDR\x02", 5) != 0) {
        return damaged(f);
    }
    if (head[5] != 2) {
        return foreign(f);
    }
    if (messages == NULL || s.left < 0 || !is_told_once(f, HEAD + size) ||
        sum != clx_h5_sum(head, HEAD + size)) {
        return damaged(f);
    }
    f->h5->node[number].is_folder = true; // until it tells a layout
    CLX_TRY(read_messages(f, (stretch){messages, size}, number, depth, false));
    if (f->h5->node[number].is_folder) {
        CLX_TRY(read_messages(f, (stretch){messages, size}, number, depth, true));
    }
done:
    return status;
}

clast_status clx_h5_plain_parse(const char *image, int64_t n, clx_h5 *h5)
{
    int64_t unread = n;
    const file f = {image, n, &unread, h5};
    stretch s = {image, n};
    const char *head = next_bytes(&s, 12);
    const uint64_t base = read_word(&s, 8);
    (void)read_word(&s, 8);
    const uint64_t end = read_word(&s, 8);
    const uint64_t root = read_word(&s, 8);
    const uint64_t sum = read_word(&s, 4);
    if (s.left < 0 || memcmp(head, "\x89HDF\r\n\x1a\n\x03\x08\x08", 11) != 0 || base != 0 ||
        end != (uint64_t)n || sum != clx_h5_sum(image, 44)) {
        return damaged(&f);
    }
    return read_node(&f, 0, root, 0);
}
