#pragma once
// Containers in state files and from surfaces.
#include <clast/table.h>

/// Vertices [m] and triangles as the tables that a state keeps.
clast_status clx_bed_surface_tables(const clast_mesh *mesh, clast_table table[2]);

/// A surface in metres.
/// @return CLAST_E_USAGE without a unit
clast_status clx_container_read(const char *path, const char *unit, clast_mesh *mesh);
