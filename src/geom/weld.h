#pragma once
// Merging vertices that are near each other.
#include <clast/status.h>

typedef struct clx_weld_rule {
    double tolerance;     ///< model units; 0 merges bit-equal vertices (-0 equals 0)
    const int32_t *order; ///< [n_order] vertices that take part, in this order; NULL: all
    int32_t n_order;
    const double *max_shift; ///< [n_vert] how far a vertex may go or be gone to; NULL: tolerance
} clx_weld_rule;

/// map [n_vert]: the vertex that stands for each vertex. In order, a vertex goes to the nearest
/// kept one within the tolerance or is kept itself; so kept vertices never move.
///
/// @note O(n): a cell of the grid holds a bounded number of kept vertices, and where reach keeps
///       more of them apart, no more are looked at
clast_status clx_weld_map(const clast_mesh *mesh, const clx_weld_rule *rule, int32_t *map);

/// Renumbers by map, drops triangles that collapse and vertices that are no longer used.
/// n_dropped counts the triangles.
clast_status clx_weld_apply(const clast_mesh *mesh, const int32_t *map, clast_mesh *out,
                            int32_t *n_dropped);

typedef struct clx_weld_choice {
    double tolerance; ///< model units; 0 when no tolerance helps
    int32_t n_open;   ///< edges with one user that are left
    int32_t n_over;   ///< edges with more than two users that are left
} clx_weld_choice;

/// Merges vertices of open edges, and no others, at the smallest tolerance that closes the surface.
///
/// Tries 10^-9, 2 10^-9, ... 0.034 of the extent; no vertex goes farther than a quarter of its
/// shortest edge. If none closes, takes the one up to 10^-5 that leaves fewest open and over-used
/// edges. Of two vertices the one with more triangles stays.
///
/// @param map  [n_vert], as clx_weld_map; or NULL when only the choice is wanted
clast_status clx_weld_search(const clast_mesh *mesh, clx_weld_choice *choice, int32_t *map);

/// Diagonal of the bounding box; 0 for an empty mesh.
double clx_mesh_extent(const clast_mesh *mesh);
