#pragma once
// The parts of a PLY file as its header lists them; private to ply*.c.
#include "io/mesh_build.h"
#include "io/text.h"

enum { CLX_PLY_N_ELEMENT = 32, CLX_PLY_N_PROPERTY = 256 };

typedef enum {
    CLX_PLY_I8,
    CLX_PLY_U8,
    CLX_PLY_I16,
    CLX_PLY_U16,
    CLX_PLY_I32,
    CLX_PLY_U32,
    CLX_PLY_F32,
    CLX_PLY_F64
} clx_ply_type;

typedef struct clx_ply_property {
    clx_word name;
    clx_ply_type type;       ///< of a scalar or of a list's items
    clx_ply_type count_type; ///< of a list's length
    bool is_list;
} clx_ply_property;

typedef struct clx_ply_element {
    clx_word name;
    int64_t n_row;
    int32_t first, n_property; ///< in properties
} clx_ply_element;

typedef struct clx_ply {
    bool is_ascii, is_big_endian;
    int32_t n_element, n_property;
    clx_ply_element element[CLX_PLY_N_ELEMENT];
    clx_ply_property property[CLX_PLY_N_PROPERTY];
    const char *body; ///< first byte after the header's last line
    int64_t body_line;
} clx_ply;

/// Bytes of one number.
int32_t clx_ply_size(clx_ply_type type);

/// One number of a binary file.
double clx_ply_decode(const uint8_t *bytes, clx_ply_type type, bool is_big_endian);

bool clx_ply_is_integer(clx_ply_type type);

/// Reads the header; row counts are held against the bytes that follow.
clast_status clx_ply_header(const void *bytes, size_t n, clx_ply *ply);
