#pragma once
// The steps of clast_mesh_check, one file each.
#include "base/status.h"

/// Below it a product of three lengths is not to be told from 0.
#define CLX_SMALLEST_EXTENT 1e-95

typedef struct clast_mesh_check_result clast_mesh_check_result;
typedef struct clast_mesh_part clast_mesh_part;
typedef struct clast_mesh_repair_report clast_mesh_repair_report;
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
///
/// @param parent  [n_part], at most n_tri: the part directly around each, -1 for none; or NULL
clast_status clx_check_parts(const clast_mesh *mesh, const clx_topology *topology,
                             clast_mesh_check_result *result, int32_t *parent);

/// +1 where the part runs as its outermost does (which is taken to be outward), -1 where it runs
/// against it, 0 for a part that is open or without volume.
int clx_part_facing(const clast_mesh_check_result *result, int32_t part);

/// Whether a closed surface's volume is 0 but for rounding: below 1e-12 of area times extent.
bool clx_is_no_volume(double volume, double area, double extent);

/// Whether the part is closed and bounds nothing: a sheet written on both sides.
bool clx_part_is_flat(const clast_mesh_part *part);

/// Bodies that lie in no other.
int32_t clx_count_apart(const clast_mesh_check_result *result);

/// Groups of parts that planes at right angles to one of the axes part, whatever their parts cut:
/// so many bodies are there at least.
clast_status clx_count_parted(const clast_mesh_check_result *result, int32_t *n_parted);

/// Solid angle of triangle (a, b, c) seen from p, with sign. [VanOosterom1983 eq. 8]
double clx_solid_angle(const double p[3], const double a[3], const double b[3], const double c[3]);

/// Whether all triangles are seen from the mean of the vertices, from behind and once in each
/// direction: then no two cut each other. False is no answer.
bool clx_is_star_shaped(const clast_mesh *mesh);

/// What makes a surface's volume count a region twice, or its form that of several bodies.
typedef struct clx_doubles {
    int32_t n_part, n_doubled, n_repeated, n_body; ///< as in clast_mesh_check_result
    int32_t n_apart;                               ///< bodies that lie in no other
    int32_t n_parted;                              ///< clx_count_parted
    int32_t n_flat;                                ///< as in clast_mesh_check_result
    int32_t n_wall;                                ///< triangles at the places of others
    int32_t n_nonmanifold_edge;
    int64_t n_intersection;
    bool intersection_complete;
} clx_doubles;

/// clx_find_doubles but for bodies that hang together by an edge alone, which count as one.
clast_status clx_count_doubles(const clast_mesh *mesh, clx_doubles *doubles);

/// The counts of clast_mesh_check alone, in less than its time, of a closed surface. n_part and
/// the bodies are 0 where the surface is star-shaped and nothing had to be counted.
clast_status clx_find_doubles(const clast_mesh *mesh, clx_doubles *doubles);

/// "1 of its 2 parts counts twice in its volume ...", or of cuts (not looked for, too) or repeated
/// triangles; "" where each region counts once.
void clx_doubles_words(const clx_doubles *doubles, size_t size, char *text);

/// "1 vertex of open edges merged with others within 0.174 ..."; "" where no vertex moved by more
/// than a file's rounding. `mesh` is the welded one.
void clx_weld_words(const clast_mesh *mesh, const clast_mesh_repair_report *weld, size_t size,
                    char *text);

/// Volumes and areas, each in two ways.
void clx_check_measures(const clast_mesh *mesh, clast_mesh_check_result *result);

/// The findings in words.
void clx_check_words(clast_mesh_check_result *result);
