#pragma once
// What the mesh readers and writers share inside src/io.
#include <clast/mesh_file.h>

#include "base/file.h"

/// Adds a line to the report's warnings; after the eighth the rest is dropped.
void clx_report_warn(clast_mesh_read_report *report, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/// True when the bytes are laid out as a binary STL, whatever the header's text says.
bool clx_stl_is_binary(const void *bytes, size_t n);

/// Readers: `mesh` is empty before; `report` is never NULL.
clast_status clx_stl_parse(const void *bytes, size_t n, clast_mesh *mesh,
                           clast_mesh_read_report *report);

/// Writers: append the whole file.
clast_status clx_stl_write(const clast_mesh *mesh, const clast_mesh_write_options *options,
                           clx_file *file);
