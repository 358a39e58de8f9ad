#pragma once
#include <clast/mesh.h>

CLAST_BEGIN

/// A connected piece of a surface: triangles joined by shared edges.
typedef struct clast_mesh_part {
    int32_t n_triangle;
    int32_t n_open_edge;
    bool closed;       ///< every edge has an even number of triangles
    bool oriented;     ///< neighbours run the same way round
    bool manifold;     ///< no edge has more than two triangles
    bool inside_out;   ///< closed, oriented, in no other part, and of negative volume
    int32_t genus;     ///< handles of a closed, oriented manifold; -1 otherwise
    int32_t depth;     ///< closed parts that this part lies in
    int32_t outermost; ///< the part that contains it and lies in no other itself, or -1
    double volume;     ///< signed, about a vertex of the part
    double area;
    double low[3], high[3];
} clast_mesh_part;

/// What is wrong, for the person at the terminal.
typedef struct clast_mesh_fault {
    bool blocking;  ///< the surface is not a solid because of it
    char code[24];  ///< stable name: open_edges, inside_out, ...
    char text[360]; ///< what, how many, where, what to run
} clast_mesh_fault;

enum { CLAST_MESH_MAX_FAULT = 16 };

/// Findings of clast_mesh_check. Lengths in the mesh's unit.
typedef struct clast_mesh_check_result {
    int32_t n_vertex, n_triangle;
    bool closed;   ///< has triangles, and every edge an even number of them
    bool oriented; ///< edges are used equally often in both directions, and no part is inside out
    bool manifold; ///< no edge has more than two triangles, and each vertex has one fan
    int32_t n_edge;
    int32_t n_part;
    clast_mesh_part *part;      ///< [n_part] by first triangle
    int64_t euler;              ///< used vertices - edges + triangles, collapsed triangles left out
    int32_t genus;              ///< sum over the parts where it is known
    int32_t n_open_edge;        ///< edges with one triangle
    int32_t n_open_loop;        ///< loops that they form
    double largest_hole;        ///< diagonal of the box of the largest loop
    int32_t n_nonmanifold_edge; ///< edges with more than two triangles
    int32_t n_nonmanifold_vertex; ///< vertices where several fans meet
    int32_t n_misoriented_edge;   ///< edges whose triangles run the same way
    int32_t n_inside_out;         ///< parts
    int32_t n_nested;             ///< closed parts that lie in another closed part
    int32_t n_degenerate;         ///< triangles without area: a repeated or three collinear corners
    int32_t n_duplicate;          ///< superfluous triangles with the same corners as others
    int32_t n_unused_vertex;
    int64_t n_intersection;     ///< pairs of triangles that cut each other
    int64_t n_touch;            ///< pairs that only touch, away from what they share
    bool intersection_complete; ///< false: search cut short, the two numbers are lower bounds
    int32_t intersection[2];    ///< the first such pair, or -1
    double extent;              ///< diagonal of the bounding box
    double volume;              ///< signed tetrahedra about the mean of the vertices
    double volume_divergence;   ///< mean of the integrals of x, y and z over the surface
    double volume_spread;       ///< greatest difference of those four [model unit^3]
    double area;                ///< by cross products
    double area_heron;          ///< by the lengths of the sides
    double hull_volume;         ///< of the convex hull; 0 for a flat point set
    double weld_tolerance;      ///< merging open vertices up to this far apart helps, if fewer
    int32_t n_open_after_weld;  ///< open edges are left after it than n_open_edge
    int32_t n_fault;
    clast_mesh_fault fault[CLAST_MESH_MAX_FAULT];
} clast_mesh_check_result;

/// What is this surface, and can it be trusted?
///
/// The counts are exact for the mesh as it is: vertices are the same only when their numbers are.
/// Volumes of an open surface depend on the origin; volume_spread shows by how much.
///                                                          [docs/theory/mesh-repair.md]
///
/// @param result  its old content is ignored; free it with clast_mesh_check_free
/// @return CLAST_E_GEOMETRY only when nothing can be said: a vertex is not finite or a corner is
///         not a vertex; an open or empty surface is a finding, not an error
/// @note O(n log n)
CLAST_API clast_status clast_mesh_check(const clast_mesh *mesh, clast_mesh_check_result *result);

CLAST_API void clast_mesh_check_free(clast_mesh_check_result *result);

/// Closed, oriented and manifold, and not flat: no blocking fault.
CLAST_API bool clast_mesh_check_passed(const clast_mesh_check_result *result);

CLAST_END
