#pragma once
// Open edges chained into loops.
#include <clast/status.h>

typedef struct clx_topology clx_topology;

/// Simple loops: loop i visits vertex[begin[i] .. begin[i + 1] - 1] once each.
typedef struct clx_loops {
    int32_t n_loop;
    int32_t *begin;  ///< [n_loop + 1]
    int32_t *vertex; ///< [begin[n_loop]]
} clx_loops;

/// Loops of the edges with an odd number of users, in no particular direction. They always close
/// (the border of a set of triangles has even degree everywhere).
clast_status clx_loops_find(const clast_mesh *mesh, const clx_topology *topology, clx_loops *loops);

/// Loops of the edges whose users do not balance, each edge as often as the excess, in the
/// direction in which missing triangles would run. They always close too.
clast_status clx_loops_find_directed(const clast_mesh *mesh, const clx_topology *topology,
                                     clx_loops *loops);
void clx_loops_free(clx_loops *loops);

/// Diagonal of the box of a loop.
double clx_loop_extent(const clast_mesh *mesh, const clx_loops *loops, int32_t loop);
