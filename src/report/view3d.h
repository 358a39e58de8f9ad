#pragma once
// The assembly of a run as data for web/view.js.
#include "base/file.h"
#include <clast/assembly.h>
#include <clast/table.h>

typedef struct clx_frames clx_frames;

/// Writes the 3-D view's place and data: each shape's surface once, a pose for each grain, both as
/// base64 of little-endian 32-bit numbers; lengths are divided by half the assembly's extent.
///
/// @param forces of clast_dem_contact_table, or NULL: contacts have no forces then
/// @param frames moments of the same grains, or NULL
/// @param limit  triangles drawn at once: balls get a coarser icosphere, other surfaces are
///               simplified until all grains together fit (at least 20 triangles a grain stay)
/// @return CLAST_E_GEOMETRY for no grains, CLAST_E_MEMORY
clast_status clx_view3d_write(clx_file *file, const clast_assembly *assembly,
                              const clast_table *forces, const clx_frames *frames, int32_t limit);

/// A surface with about `limit` triangles or fewer: vertices in one cell of a grid become their
/// mean, triangles that collapse or repeat go. For pictures only: volume and topology may change.
clast_status clx_view3d_simplify(const clast_mesh *mesh, int32_t limit, clast_mesh *simple);
