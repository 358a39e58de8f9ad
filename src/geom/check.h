#pragma once
// The steps of clast_mesh_check, one file each.
#include "base/status.h"

typedef struct clast_mesh_check_result clast_mesh_check_result;
typedef struct clx_topology clx_topology;

/// clast_mesh_check but for the triangles that cut each other (half of its time) and the words.
CLX_SHARED clast_status clx_check_without_cuts(const clast_mesh *mesh,
                                               clast_mesh_check_result *result);

/// True when the three corners are on one line, exactly.
bool clx_is_flat(const clast_mesh *mesh, int32_t t);
bool clx_is_flat_at(const clast_mesh *mesh, const int32_t tri[3]);

/// Marks [n_tri] superfluous triangles among those with the same three corners: all but the first,
/// or all of them where the surface is closed without (two bodies' common wall). Collapsed ones are
/// left out.
clast_status clx_find_duplicates(const clast_mesh *mesh, const clx_topology *topology,
                                 bool *duplicate, int32_t *n_duplicate);

/// Parts with their counts, measures, genus and nesting.
clast_status clx_check_parts(const clast_mesh *mesh, const clx_topology *topology,
                             clast_mesh_check_result *result);

/// Volumes and areas, each in two ways.
void clx_check_measures(const clast_mesh *mesh, clast_mesh_check_result *result);

/// The findings in words.
void clx_check_words(clast_mesh_check_result *result);
