#pragma once
// Where an edge may collapse to, and what that costs.
#include <clast/mesh.h>

/// A mesh under simplification: triangles die, vertices move; corner c = 3 t + k.
typedef struct clx_thinning {
    clast_mesh mesh; ///< owned copy
    int32_t n_alive; ///< triangles
    bool *dead;      ///< [n_tri]
    int32_t *head;   ///< [n_vert] first corner at the vertex, -1 for none
    int32_t *next;   ///< [3 n_tri] next corner at the same vertex
    int32_t *mark;   ///< [n_vert] scratch for neighbourhoods
    int32_t n_mark;  ///< the last mark given out
} clx_thinning;

clast_status clx_thinning_init(const clast_mesh *mesh, clx_thinning *thin);
void clx_thinning_free(clx_thinning *thin);

/// Point for the collapse of edge (u, v), and its cost. Both depend on the triangles at u and v
/// alone. INFINITY where the volume cannot be kept.
double clx_collapse_place(clx_thinning *thin, int32_t u, int32_t v, double place[3]);

/// Would the collapse keep the topology, and turn no triangle over?
bool clx_collapse_is_sound(clx_thinning *thin, int32_t u, int32_t v, const double place[3]);

/// Does it: v goes into u, which moves to place.
void clx_collapse_do(clx_thinning *thin, int32_t u, int32_t v, const double place[3]);

/// Next living corner at a vertex, from a corner (or -1 for the first); -1 at the end.
int32_t clx_thinning_corner(const clx_thinning *thin, int32_t vertex, int32_t corner);
