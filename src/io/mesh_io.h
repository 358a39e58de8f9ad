#pragma once
// What the mesh readers and writers share inside src/io.
#include <clast/mesh.h>

typedef struct clx_file clx_file;

/// Adds a line to the report's warnings; after the eighth the rest is dropped.
void clx_report_warn(clast_mesh_read_report *report, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/// True when the size is that of a binary STL with the count at byte 80, to the byte.
bool clx_stl_is_exact(const void *bytes, size_t n);

/// True for text of two or four bytes a letter, which no reader here takes.
bool clx_text_is_utf16(const void *bytes, size_t n);

/// True when the first word of the text is OFF, COFF, NOFF, STOFF, ...
bool clx_off_is_magic(const char *text, size_t n);

/// Readers: `mesh` is empty before; `report` is never NULL.
clast_status clx_stl_parse(const void *bytes, size_t n, clast_mesh *mesh,
                           clast_mesh_read_report *report);
clast_status clx_obj_parse(const void *bytes, size_t n, clast_mesh *mesh,
                           clast_mesh_read_report *report);
clast_status clx_ply_parse(const void *bytes, size_t n, clast_mesh *mesh,
                           clast_mesh_read_report *report);
clast_status clx_off_parse(const void *bytes, size_t n, clast_mesh *mesh,
                           clast_mesh_read_report *report);

/// Which format the bytes themselves show, or CLAST_MESH_ANY.
clast_mesh_format clx_mesh_detect(const void *bytes, size_t n);

/// Writers: append the whole file.
clast_status clx_stl_write(const clast_mesh *mesh, const clast_mesh_write_options *options,
                           clx_file *file);
clast_status clx_obj_write(const clast_mesh *mesh, const clast_mesh_write_options *options,
                           clx_file *file);
clast_status clx_ply_write(const clast_mesh *mesh, const clast_mesh_write_options *options,
                           clx_file *file);
clast_status clx_off_write(const clast_mesh *mesh, const clast_mesh_write_options *options,
                           clx_file *file);
clast_status clx_threemf_write(const clast_mesh *mesh, const clast_mesh_write_options *options,
                               clx_file *file);

/// Pieces of the writers, for files of several parts: an STL's header for n facets and facets after
/// it; "PREFIX x y z\n" with digits enough to read the same doubles back.
clast_status clx_stl_begin(const clast_mesh_write_options *options, uint32_t n, clx_file *file);
int64_t clx_stl_count(const clast_mesh *mesh); ///< facets that append writes: those that rounding
                                               ///< to single precision leaves
clast_status clx_stl_append(const clast_mesh *mesh, clx_file *file);
clast_status clx_mesh_write_point(clx_file *file, const char *prefix, const double p[3]);
