#pragma once
// Files of states where clast is built without HDF5: plain HDF5 files (superblock 3, headers with
// checksums, arrays in one piece) of clast's own making, which HDF5 reads; read back are only files
// of this form. [HDF5 File Format Specification 3.0]
#include "io/h5.h"

typedef struct clx_h5_attribute {
    char *name;
    bool is_text;
    clx_h5_type type; ///< of a number
    int64_t size;     ///< bytes, of a text with its last 0
    char *value;
} clx_h5_attribute;

/// An array or folder.
typedef struct clx_h5_node {
    char *name;    ///< whole, from "/" on
    uint32_t hash; ///< of the name
    bool is_folder;
    int64_t first, last; ///< members of a folder by their numbers, 0: none
    int64_t next;        ///< member of the same folder
    clx_h5_type type;
    int32_t rank;
    int64_t shape[CLX_H5_RANK_LIMIT];
    int64_t size; ///< bytes
    char *data;
    clx_h5_attribute *attribute;
    int64_t n_attribute, attribute_capacity;
    int64_t address; ///< in the image that is being made
} clx_h5_node;

struct clx_h5 {
    bool is_writing;
    char label[256];   ///< file's name for messages
    clx_h5_node *node; ///< [n]; the first is "/"
    int64_t n, capacity;
    int64_t *slot; ///< [n_slot] a power of two, half of them empty (0): numbers + 1 by their hash
    int64_t n_slot;
    char **member; ///< [n_member] names of folder `listed`, sorted; NULL: none is listed
    int64_t listed, n_member;
};

static inline int64_t clx_h5_plain_width(clx_h5_type type)
{
    return type == CLX_H5_U8 ? 1 : type == CLX_H5_I32 ? 4 : 8;
}

/// A file with "/" alone.
clast_status clx_h5_plain_begin(const char *label, clx_h5 **h5);

/// Adds an array or folder whose folder is there; its number.
clast_status clx_h5_plain_add(clx_h5 *h5, const char *name, int64_t *number);

/// Adds a copy of an attribute.
clast_status clx_h5_plain_attribute(clx_h5 *h5, int64_t node, const clx_h5_attribute *given);

/// The file's bytes (clx_free them).
clast_status clx_h5_plain_image(clx_h5 *h5, char **image, int64_t *n);

/// A file's bytes into an empty h5. CLAST_E_FORMAT if they are damaged, CLAST_E_USAGE if they have
/// a form that takes HDF5.
clast_status clx_h5_plain_parse(const char *image, int64_t n, clx_h5 *h5);
