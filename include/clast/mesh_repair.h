#pragma once
#include <clast/field.h>

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
    int32_t winding;   ///< how often the space just inside counts in the volume: 1 for each closed
                       ///< part around it and for itself, -1 for those that run against the
                       ///< outermost. 1: solid, 0: cavity, else wrong; 0 of an open part
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
    int32_t n_doubled;          ///< nested parts that count twice in the volume: outward in a solid
                                ///< (winding above 1), or inward outside of one (below 0)
    clast_mesh_part *part;      ///< [n_part] by first triangle
    int64_t euler;              ///< used vertices - edges + triangles, collapsed triangles left out
    int32_t genus;              ///< sum over the parts where it is known
    int32_t n_open_edge;        ///< edges with one triangle
    int32_t n_open_loop;        ///< loops that they form
    int32_t n_repeated;         ///< triangles that repeat another with the same winding: counted
                                ///< twice in the volume
    double largest_hole;        ///< diagonal of the box of the largest loop
    int32_t n_nonmanifold_edge; ///< edges with more than two triangles
    int32_t n_nonmanifold_vertex; ///< vertices where several fans meet
    int32_t n_misoriented_edge;   ///< edges whose triangles run the same way
    int32_t n_inside_out;         ///< parts
    int32_t n_nested;             ///< closed parts that lie in another closed part
    int32_t n_flat;               ///< closed parts without volume: the two sides of a sheet
    int32_t n_degenerate;         ///< triangles without area: a repeated or three collinear corners
    int32_t n_duplicate;          ///< superfluous triangles with the same corners as others
    int32_t n_unused_vertex;
    int64_t n_intersection;     ///< pairs of triangles that cut each other
    int64_t n_touch;            ///< pairs that only touch, away from what they share
    bool intersection_complete; ///< false: search cut short, the two numbers are lower bounds
    int32_t intersection[2];    ///< the first such pair, or -1
    int32_t n_body;             ///< solid parts, each with its cavities; parted where they hang
                                ///< together by an edge alone
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

/// Frees what clast_mesh_check found; may be called twice.
CLAST_API void clast_mesh_check_free(clast_mesh_check_result *result);

/// What counts twice, or may, in the volume of a closed surface, or is no volume but counts in its
/// area: "it cuts itself at 6 pairs of triangles; its volume counts overlaps twice", "" where
/// nothing does. The first of sheets, cuts, cuts not looked for, parts and repeated triangles.
///
/// @param text  [size], 200 suffice
CLAST_API void clast_mesh_check_doubles(const clast_mesh_check_result *result, size_t size,
                                        char *text);

/// Closed, oriented and manifold, and not flat: no blocking fault.
CLAST_API bool clast_mesh_check_passed(const clast_mesh_check_result *result);

/// Merges vertices nearer than `tolerance` times the extent (the diagonal of the box), drops
/// triangles that collapse and vertices that nothing uses. Kept vertices do not move: each vertex
/// goes to the nearest kept one, in the order of their numbers. 0 merges equal vertices.
///
/// @param out       empty; filled on success
/// @param n_merged  vertices that went to another, or NULL
/// @note O(n)
CLAST_API clast_status clast_mesh_weld(const clast_mesh *mesh, double tolerance, clast_mesh *out,
                                       int32_t *n_merged);

typedef enum {
    CLAST_WELD_AUTO,  ///< the smallest tolerance that closes the surface, open vertices only
    CLAST_WELD_OFF,   ///< none
    CLAST_WELD_WITHIN ///< weld_tolerance, all vertices
} clast_weld_mode;

typedef enum { CLAST_KEEP_ALL, CLAST_KEEP_LARGEST } clast_keep_mode;

/// Which steps clast_mesh_repair takes, in this order.
typedef struct clast_mesh_repair_config {
    int32_t weld;           ///< clast_weld_mode
    double weld_tolerance;  ///< times the extent
    bool drop;              ///< triangles without area or that repeat others
    bool split;             ///< edges at vertices that lie on them (T-junctions)
    double split_tolerance; ///< times the extent
    bool loose;             ///< drop triangles that share no edge
    bool orient;            ///< neighbours consistently, then outward
    bool fill;              ///< holes
    double fill_size;       ///< largest hole's box diagonal, times the extent
    bool separate;          ///< surfaces that touch in an edge or vertex get their own vertices
    bool unite;             ///< drop nested parts that bound nothing: solid, or none, on both sides
    int32_t keep;           ///< clast_keep_mode
} clast_mesh_repair_config;

/// Defaults, ranges and help; start from clast_fields_default.
extern CLAST_API const clast_field clast_mesh_repair_fields[];

/// The fields that a repair by the others does not look at (clast_fields_idle). NULL of a NULL.
CLAST_API const clast_idle *clast_mesh_repair_idle(const clast_mesh_repair_config *config,
                                                   clast_idle rules[CLAST_N_IDLE]);

/// What clast_mesh_repair changed. Volumes are about the mean of the vertices (meaningless for an
/// open surface).
typedef struct clast_mesh_repair_report {
    int32_t n_merged;     ///< vertices merged into another
    double weld_distance; ///< the farthest that one of them went [model units]
    int32_t n_collapsed;  ///< triangles with a repeated corner, then or from the beginning
    int32_t n_degenerate; ///< triangles without area dropped
    int32_t n_duplicate;  ///< repeated triangles dropped
    int32_t n_split;      ///< triangles cut in pieces at T-junctions
    int32_t n_loose;      ///< triangles dropped because they shared no edge
    int32_t n_turned;     ///< triangles flipped
    int32_t n_conflict;   ///< edges where no choice of sides fits (one-sided surface)
    int32_t n_hole_filled;
    int32_t n_fill_triangle;
    int32_t n_hole_left;    ///< loops larger than fill_size
    int32_t n_separated;    ///< vertices doubled to part touching surfaces
    int32_t n_part_dropped; ///< by unite and by keep
    int32_t n_triangle_before, n_triangle_after;
    double volume_before, volume_after;
    double area_before, area_after;
} clast_mesh_repair_report;

/// Makes a surface closed, oriented and manifold where it can, step by step, and reports every
/// change. Vertices never move; a sound surface comes back as it was (unused vertices dropped).
///                                                          [docs/theory/mesh-repair.md]
///
/// @param config  NULL for the defaults
/// @param out     empty; filled on success. Whether it is now sound is clast_mesh_check's business
/// @param report  may be NULL
/// @return CLAST_E_GEOMETRY if a vertex is not finite, a corner is not a vertex, or nothing is left
/// @note O(n log n) on ordinary surfaces
CLAST_API clast_status clast_mesh_repair(const clast_mesh *mesh,
                                         const clast_mesh_repair_config *config, clast_mesh *out,
                                         clast_mesh_repair_report *report);

/// The one weld that every command applies to a surface that it reads: vertices of open edges that
/// rounding has parted become one (CLAST_WELD_AUTO). Nothing else changes; a surface without open
/// edges, or one that no weld helps, keeps its bits.
///
/// @param mesh    replaced on success
/// @param report  n_merged, weld_distance and n_collapsed; may be NULL
CLAST_API clast_status clast_mesh_weld_auto(clast_mesh *mesh, clast_mesh_repair_report *report);

/// How far two surfaces are apart. Each is sampled at its vertices and at points spread over its
/// triangles; from each sample the distance to the other surface is exact.
typedef struct clast_mesh_deviation {
    double forward;   ///< greatest distance from the first surface to the second
    double backward;  ///< and from the second to the first
    double hausdorff; ///< the larger of the two: a lower bound of the Hausdorff distance
    double mean;      ///< area-weighted mean distance of both ways
    int64_t n_sample;
} clast_mesh_deviation;

/// @return CLAST_E_GEOMETRY if one has no triangles    @note O((n + m) log), any thread count alike
CLAST_API clast_status clast_mesh_distance(const clast_mesh *a, const clast_mesh *b,
                                           clast_mesh_deviation *deviation);

/// What clast_mesh_simplify did.
typedef struct clast_mesh_simplify_report {
    int32_t n_triangle_before, n_triangle_after;
    bool reached; ///< false: no more edge could go without changing the topology or folding over
    double volume_before, volume_after;
    double volume_drift; ///< relative, before the last correction
    double correction;   ///< factor on all lengths about the centroid that made up for the drift
    double area_before, area_after;
    clast_mesh_deviation deviation; ///< from the original to the simplified surface
} clast_mesh_simplify_report;

/// Fewer triangles, same volume: edges collapse, cheapest first, each to the point that keeps the
/// volume exactly and moves the surface least.    [LindstromTurk1998 sec. 4;
/// docs/theory/simplify.md]
///
/// Topology stays (parts, handles, closed, manifold), no triangle flips. The volume is kept to
/// 1e-12 (relative); rounding of many steps is taken back by a uniform scaling.
///
/// @param mesh   closed, oriented, manifold
/// @param n_face wanted number of triangles, >= 4; a closed surface has an even number, so an odd
///               wish gives one less
/// @param out    empty; filled on success    @param report  may be NULL
/// @return CLAST_E_GEOMETRY for a surface that is not a solid (run clast mesh repair)
/// @note O(n log n); 33,000 triangles in under a second
CLAST_API clast_status clast_mesh_simplify(const clast_mesh *mesh, int32_t n_face, clast_mesh *out,
                                           clast_mesh_simplify_report *report);

/// Rounds coordinates to the 24 bits that an STL keeps, the last bits chosen so that the volume
/// stays: each coordinate is at most two float steps off, the volume by about 1e-11 (plain rounding
/// of a few hundred vertices costs 1e-8).
///
/// @return CLAST_E_GEOMETRY if a coordinate does not fit a float; the mesh is then unchanged
CLAST_API clast_status clast_mesh_round_float(clast_mesh *mesh);

// Of surfaces in files.

/// Reads a surface as every command does that needs a solid: clast_mesh_read, then
/// clast_mesh_weld_auto.
///
/// @param weld  what was merged; may be NULL
CLAST_API clast_status clast_mesh_read_welded(const char *path, clast_mesh *mesh,
                                              clast_mesh_repair_report *weld);

/// Whether a surface that was read from a file bounds a solid: closed and outward.
///
/// @param path       the file's name, for the message
/// @param otherwise  what else the caller's user can do, for the message; NULL: nothing
/// @return CLAST_E_GEOMETRY with the counts that `clast mesh check` gives and the command that
///         closes this file (clast_mesh_cure)
CLAST_API clast_status clast_mesh_require_solid(const clast_mesh *mesh, const char *path,
                                                const char *otherwise);

/// The shell command that makes a file's surface closed and outward, tried here in memory:
/// "clast mesh repair grain.stl -o grain-closed.stl"; .ply where an STL could not keep it closed.
///
/// @param command  [size]; "" when repair does not help
CLAST_API clast_status clast_mesh_cure(const clast_mesh *mesh, const char *path, size_t size,
                                       char *command);

CLAST_END
