// Arrays and attributes in memory as the bytes of an HDF5 file: what they hold, then each one's
// header, folders last, so that every address is known when it is written.
// [HDF5 File Format Specification 3.0, sections II.C, IV.A]
#include "io/h5_plain.h"

#include "base/alloc.h"
#include "io/h5_trailer.h"
#include <string.h>

#define UNDEFINED UINT64_MAX
enum { SUPERBLOCK = 48 };
enum {
    DATASPACE = 1,
    LINK_INFO = 2,
    DATATYPE = 3,
    FILL = 5,
    LINK = 6,
    LAYOUT = 8,
    GROUP_INFO = 10,
    ATTRIBUTE = 12,
    ATTRIBUTE_INFO = 21
};

typedef struct {
    char *bytes;
    int64_t n, capacity;
} buffer;

static clast_status append_raw(buffer *b, const void *bytes, int64_t n)
{
    const clast_status status = clx_grow(&b->bytes, &b->capacity, b->n + n, 1);
    if (status == CLAST_OK && n > 0) {
        memcpy(b->bytes + b->n, bytes, (size_t)n);
        b->n += n;
    }
    return status;
}

/// A whole number of `width` bytes, the least first.
static clast_status write_word(buffer *b, int width, uint64_t word)
{
    char bytes[8];
    for (int k = 0; k < width; ++k) {
        bytes[k] = (char)(word >> 8 * k & 0xff);
    }
    return append_raw(b, bytes, width);
}

/// Type of a number: class and version, bits, bytes, then where its parts lie.
static clast_status write_type(buffer *b, clx_h5_type type)
{
    static const char f64[] = "\x11\x20\x3f\0\x08\0\0\0\0\0\x40\0\x34\x0b\0\x34\xff\x03\0";
    clast_status status = CLAST_OK;
    const uint64_t width = (uint64_t)clx_h5_plain_width(type);
    if (type == CLX_H5_F64) {
        return append_raw(b, f64, 20); // with the 0 at the text's end
    }
    CLX_TRY(write_word(b, 1, 0x10));
    CLX_TRY(write_word(b, 3, type == CLX_H5_I32 || type == CLX_H5_I64 ? 8 : 0));
    CLX_TRY(write_word(b, 4, width));
    CLX_TRY(write_word(b, 2, 0));
    CLX_TRY(write_word(b, 2, 8 * width));
done:
    return status;
}

static clast_status write_text_type(buffer *b, int64_t size)
{
    const clast_status status = append_raw(b, "\x13\x10\0\0", 4); // ends in a 0, UTF-8
    return status != CLAST_OK ? status : write_word(b, 4, (uint64_t)size);
}

static clast_status write_space(buffer *b, int32_t rank, const int64_t *shape)
{
    clast_status status = CLAST_OK;
    const char head[4] = {2, (char)rank, 0, rank > 0 ? 1 : 0};
    CLX_TRY(append_raw(b, head, 4));
    for (int32_t d = 0; d < rank; ++d) {
        CLX_TRY(write_word(b, 8, (uint64_t)shape[d]));
    }
done:
    return status;
}

/// Head of a message whose length is set by end_message.
static clast_status begin_message(buffer *b, int type, int64_t *begun)
{
    clast_status status = CLAST_OK;
    CLX_TRY(write_word(b, 1, (uint64_t)type));
    CLX_TRY(write_word(b, 3, 0));
    *begun = b->n;
done:
    return status;
}

static void end_message(buffer *b, int64_t begun)
{
    const int64_t n = b->n - begun;
    CLAST_ASSERT(n < 65536);
    b->bytes[begun - 3] = (char)(n & 0xff);
    b->bytes[begun - 2] = (char)(n >> 8);
}

static clast_status write_attribute(buffer *b, const clx_h5_attribute *a)
{
    clast_status status = CLAST_OK;
    const int64_t name = (int64_t)strlen(a->name) + 1;
    const int64_t type = a->is_text ? 8 : a->type == CLX_H5_F64 ? 20 : 12;
    int64_t begun = 0;
    CLX_TRY(begin_message(b, ATTRIBUTE, &begun));
    CLX_TRY(write_word(b, 2, 3));
    CLX_TRY(write_word(b, 2, (uint64_t)name));
    CLX_TRY(write_word(b, 2, (uint64_t)type));
    CLX_TRY(write_word(b, 2, 4));
    CLX_TRY(write_word(b, 1, 1));
    CLX_TRY(append_raw(b, a->name, name));
    CLX_TRY(a->is_text ? write_text_type(b, a->size) : write_type(b, a->type));
    CLX_TRY(write_space(b, 0, NULL));
    CLX_TRY(append_raw(b, a->value, a->size));
    end_message(b, begun);
done:
    return status;
}

/// Space, type, fill value (made early, never filled) and place of an array.
static clast_status write_array(buffer *b, const clx_h5_node *node, int64_t data)
{
    clast_status status = CLAST_OK;
    int64_t begun = 0;
    CLX_TRY(begin_message(b, DATASPACE, &begun));
    CLX_TRY(write_space(b, node->rank, node->shape));
    end_message(b, begun);
    CLX_TRY(begin_message(b, DATATYPE, &begun));
    CLX_TRY(write_type(b, node->type));
    end_message(b, begun);
    CLX_TRY(begin_message(b, FILL, &begun));
    CLX_TRY(append_raw(b, "\x03\x05", 2));
    end_message(b, begun);
    CLX_TRY(begin_message(b, LAYOUT, &begun));
    CLX_TRY(append_raw(b, "\x03\x01", 2));
    CLX_TRY(write_word(b, 8, node->size > 0 ? (uint64_t)data : UNDEFINED));
    CLX_TRY(write_word(b, 8, (uint64_t)node->size));
    end_message(b, begun);
done:
    return status;
}

/// A hard link to a member of a folder.
static clast_status write_link(buffer *b, const clx_h5_node *member)
{
    clast_status status = CLAST_OK;
    const char *name = strrchr(member->name, '/') + 1;
    int64_t begun = 0;
    CLX_TRY(begin_message(b, LINK, &begun));
    CLX_TRY(append_raw(b, "\x01\x11\x01", 3)); // UTF-8, a length of two bytes
    CLX_TRY(write_word(b, 2, strlen(name)));
    CLX_TRY(append_raw(b, name, (int64_t)strlen(name)));
    CLX_TRY(write_word(b, 8, (uint64_t)member->address));
    end_message(b, begun);
done:
    return status;
}

/// Where links or attributes lie: in the header itself, in no heap.
static clast_status write_info(buffer *b, int kind)
{
    clast_status status = CLAST_OK;
    int64_t begun = 0;
    CLX_TRY(begin_message(b, kind, &begun));
    CLX_TRY(write_word(b, 2, 0));
    CLX_TRY(write_word(b, 8, UNDEFINED));
    CLX_TRY(write_word(b, 8, UNDEFINED));
    end_message(b, begun);
done:
    return status;
}

static clast_status write_folder(buffer *b, const clx_h5 *h5, int64_t number)
{
    clast_status status = CLAST_OK;
    int64_t begun = 0;
    CLX_TRY(write_info(b, LINK_INFO));
    CLX_TRY(begin_message(b, GROUP_INFO, &begun));
    CLX_TRY(write_word(b, 2, 0));
    end_message(b, begun);
    for (int64_t i = h5->node[number].first; i > 0; i = h5->node[i].next) {
        CLX_TRY(write_link(b, &h5->node[i]));
    }
done:
    return status;
}

/// Header of an array or folder, after what the array holds.
static clast_status write_node(buffer *b, clx_h5 *h5, int64_t number)
{
    clast_status status = CLAST_OK;
    clx_h5_node *node = &h5->node[number];
    const int64_t data = b->n;
    CLX_TRY(append_raw(b, node->data, node->size));
    node->address = b->n;
    CLX_TRY(append_raw(b, "OHDR\x02\x02\0\0\0\0", 10));
    const int64_t begun = b->n;
    CLX_TRY(node->is_folder ? write_folder(b, h5, number) : write_array(b, node, data));
    if (node->n_attribute > 0) {
        CLX_TRY(write_info(b, ATTRIBUTE_INFO));
    }
    for (int64_t k = 0; k < node->n_attribute; ++k) {
        CLX_TRY(write_attribute(b, &node->attribute[k]));
    }
    for (int k = 0; k < 4; ++k) {
        b->bytes[begun - 4 + k] = (char)((b->n - begun) >> 8 * k & 0xff);
    }
    CLX_TRY(write_word(b, 4, clx_h5_sum(b->bytes + node->address, b->n - node->address)));
done:
    return status;
}

/// The first bytes of the file, which say where "/" is.
static clast_status write_superblock(buffer *b, const clx_h5 *h5)
{
    clast_status status = CLAST_OK;
    const int64_t end = b->n;
    b->n = 0;
    CLX_TRY(append_raw(b, "\x89HDF\r\n\x1a\n\x03\x08\x08\0", 12));
    CLX_TRY(write_word(b, 8, 0));
    CLX_TRY(write_word(b, 8, UNDEFINED));
    CLX_TRY(write_word(b, 8, (uint64_t)end));
    CLX_TRY(write_word(b, 8, (uint64_t)h5->node[0].address));
    CLX_TRY(write_word(b, 4, clx_h5_sum(b->bytes, SUPERBLOCK - 4)));
done:
    b->n = end;
    return status;
}

clast_status clx_h5_plain_image(clx_h5 *h5, char **image, int64_t *n)
{
    clast_status status = CLAST_OK;
    static const char room[SUPERBLOCK];
    buffer b = {0};
    CLX_TRY(append_raw(&b, room, SUPERBLOCK));
    for (int64_t i = h5->n - 1; i >= 0; --i) {
        CLX_TRY(write_node(&b, h5, i));
    }
    CLX_TRY(write_superblock(&b, h5));
    *image = b.bytes;
    *n = b.n;
    b.bytes = NULL;
done:
    clx_free(b.bytes);
    return status;
}
