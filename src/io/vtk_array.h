#pragma once
// VTK's XML formats: the head of a file, and one DataArray: inline, binary, zlib-compressed in
// blocks, base64.
#include <clast/status.h>

typedef struct clx_file clx_file;

/// An array being gathered block by block. {0} is empty.
typedef struct clx_vtk_array {
    char *block; ///< [CLX_VTK_BLOCK] not yet compressed
    int64_t used;
    char *packed; ///< compressed blocks, one after the other
    int64_t n_packed, packed_capacity;
    uint64_t *size; ///< [n_block] compressed bytes of each
    int64_t n_block, size_capacity;
    int64_t last; ///< bytes of the last block before compression
} clx_vtk_array;

/// Writes the file's opening lines, above <TYPE>, with this machine's byte order.
void clx_vtk_open(clx_file *file, const char *type);

/// The same down to <TYPE>.
void clx_vtk_head(clx_file *file, const char *type);

/// Arrays of one text or one number, for <FieldData>; texts: those of `text`(context, i).
void clx_vtk_field_text(clx_file *file, const char *name, const char *text);
void clx_vtk_field_texts(clx_file *file, const char *name, int32_t n,
                         const char *(*text)(const void *context, int32_t i), const void *context);
void clx_vtk_field_number(clx_file *file, const char *name, double value);

enum { CLX_VTK_BLOCK = 1 << 18 };

clast_status clx_vtk_begin(clx_vtk_array *array);
clast_status clx_vtk_add(clx_vtk_array *array, const void *bytes, int64_t n);

/// Writes <DataArray type="TYPE" Name="NAME" ...> and empties the array for the next one.
clast_status clx_vtk_end(clx_vtk_array *array, clx_file *file, const char *type, const char *name,
                         int components);

/// The same for <FieldData>, whose arrays tell their own number of tuples.
clast_status clx_vtk_end_field(clx_vtk_array *array, clx_file *file, const char *type,
                               const char *name, int components, int64_t n_tuple);
void clx_vtk_free(clx_vtk_array *array);
