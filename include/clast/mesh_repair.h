#pragma once
#include <clast/field.h>
#include <clast/mesh_check.h>

CLAST_BEGIN

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
    bool orient;            ///< neighbours alike, then outward
    bool fill;              ///< holes
    double fill_size;       ///< largest hole's box diagonal, times the extent
    bool separate;          ///< surfaces that touch in an edge or vertex get their own vertices
    int32_t keep;           ///< clast_keep_mode
} clast_mesh_repair_config;

/// Defaults, ranges and help; start from clast_fields_default.
extern CLAST_API const clast_field clast_mesh_repair_fields[];

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
    int32_t n_turned;     ///< triangles turned over
    int32_t n_conflict;   ///< edges where no choice of sides fits (one-sided surface)
    int32_t n_hole_filled;
    int32_t n_fill_triangle;
    int32_t n_hole_left; ///< loops larger than fill_size
    int32_t n_separated; ///< vertices doubled to part touching surfaces
    int32_t n_part_dropped;
    int32_t n_triangle_before, n_triangle_after;
    double volume_before, volume_after;
    double area_before, area_after;
} clast_mesh_repair_report;

/// Makes a surface closed, oriented and manifold where it can, step by step, and tells every
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

CLAST_END
