#pragma once
// The steps of clast_mesh_repair. Each changes `mesh` in place and adds to the report; on failure
// the mesh may be half changed but is valid and owned by the caller.
#include <clast/status.h>

typedef struct clast_mesh_repair_report clast_mesh_repair_report;

/// Splits triangles at open vertices that lie on their open edges within tolerance [model units],
/// but to no more than 8 times as many triangles and 1000.
clast_status clx_split_tjunctions(clast_mesh *mesh, double tolerance, int32_t *n_split);

/// Turns triangles so that neighbours agree, as few as possible of each part; turned [n_known]
/// flips for each of the first n_known triangles.
clast_status clx_orient_alike(clast_mesh *mesh, bool *turned, int32_t n_known, int32_t *n_conflict);

/// Turns closed parts outward. Parts inside a turned part turn with it. turned [n_known] flips for
/// each of the first n_known triangles.
clast_status clx_orient_outward(clast_mesh *mesh, bool *turned, int32_t n_known);

/// Fills loops of open edges whose extent is at most `most` [model units].
clast_status clx_fill_holes(clast_mesh *mesh, double most, clast_mesh_repair_report *report);

/// Doubles vertices (and edges with an even number of users) where surfaces touch.
clast_status clx_separate(clast_mesh *mesh, int32_t *n_separated);

/// Signed volume about the mean of the vertices.
double clx_cone_volume(const clast_mesh *mesh);
