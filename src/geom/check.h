#pragma once
// The steps of clast_mesh_check, one file each.
#include "base/status.h"

typedef struct clast_mesh_check_result clast_mesh_check_result;
typedef struct clast_mesh_part clast_mesh_part;
typedef struct clx_topology clx_topology;

/// clast_mesh_check but for the triangles that cut each other (half of its time) and the words.
CLX_SHARED clast_status clx_check_without_cuts(const clast_mesh *mesh,
                                               clast_mesh_check_result *result);

/// Refuses a vertex that is not finite, by its number.
clast_status clx_check_finite(const clast_mesh *mesh);

/// True when the three corners are on one line, exactly.
bool clx_is_flat(const clast_mesh *mesh, int32_t t);
bool clx_is_flat_at(const clast_mesh *mesh, const int32_t tri[3]);

/// Marks [n_tri] superfluous triangles among those with the same three corners: all but one that
/// runs as most of them do (overlapping scans, a body written twice), or all of them where the
/// surface is closed without (two bodies' common wall). Collapsed ones are left out. Without a
/// topology the surface is closed, and stays so: all of an even number go, as a filled fin's.
clast_status clx_find_duplicates(const clast_mesh *mesh, const clx_topology *topology,
                                 bool *duplicate, int32_t *n_duplicate);

/// Triangles that repeat another with the same winding: a closed surface's volume counts them
/// twice.
clast_status clx_count_repeated(const clast_mesh *mesh, int32_t *n_repeated);

/// Parts with their counts, measures, genus and nesting.
clast_status clx_check_parts(const clast_mesh *mesh, const clx_topology *topology,
                             clast_mesh_check_result *result);

/// +1 where the part runs as its outermost does (which is taken to be outward), -1 where it runs
/// against it, 0 for a part that is open or without volume.
int clx_part_facing(const clast_mesh_check_result *result, int32_t part);

/// Whether the part is closed and bounds nothing: a sheet written on both sides.
bool clx_part_is_flat(const clast_mesh_part *part);
int32_t clx_count_flat(const clast_mesh_check_result *result);

/// Whether all triangles are seen from the mean of the vertices, from behind and once in each
/// direction: then no two cut each other. False is no answer.
bool clx_is_star_shaped(const clast_mesh *mesh);

/// What makes a surface's volume count a region twice, or its form that of several bodies.
typedef struct clx_doubles {
    int32_t n_part, n_doubled, n_repeated, n_body; ///< as in clast_mesh_check_result
    int32_t n_apart;                               ///< bodies that lie in no other
    int32_t n_flat;                                ///< clx_count_flat
    int32_t n_wall;                                ///< triangles at the places of others
    int32_t n_nonmanifold_edge;
    int64_t n_intersection;
    bool intersection_complete;
} clx_doubles;

/// The counts of clast_mesh_check alone, in less than its time, of a closed surface. n_part and
/// the bodies are 0 where the surface is star-shaped and nothing had to be counted.
clast_status clx_find_doubles(const clast_mesh *mesh, clx_doubles *doubles);

/// "1 of its 2 parts counts twice in its volume ...", or of cuts (not looked for, too) or repeated
/// triangles; "" where each region counts once.
void clx_doubles_words(const clx_doubles *doubles, size_t size, char *text);

/// Volumes and areas, each in two ways.
void clx_check_measures(const clast_mesh *mesh, clast_mesh_check_result *result);

/// The findings in words.
void clx_check_words(clast_mesh_check_result *result);
