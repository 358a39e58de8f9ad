#pragma once
#include <clast/assembly.h>
#include <clast/monitor.h>

CLAST_BEGIN

/// How an assembly becomes one body that can be printed.
typedef struct clast_printable_config {
    double neck; ///< diameter of the ball that joins two grains at their contact [m]; 0: half the
                 ///< thinnest grain, and no less than 3 spacings
    double spacing; ///< of the sampling grid [m]; 0: a quarter of the neck, 1/300 of the extent, or
                    ///< what gives a million triangles (50 MB of STL), whichever is coarsest
    bool keep_voids; ///< leave closed voids open inside (they cannot be emptied after printing)
} clast_printable_config;

/// What was made.
typedef struct clast_printable_report {
    double neck, spacing;    ///< as used [m]
    double smallest_feature; ///< thinner of neck and thinnest grain [m]; below 2 spacing it may be
                             ///< lost
    bool resolved;           ///< smallest_feature is 2 spacings or more
    int32_t n_part;          ///< connected pieces; 1 on success
    int32_t n_void;          ///< closed voids found
    double void_volume;      ///< their volume, filled unless keep_voids [m3]
    double solid_volume;     ///< sum of the grains' volumes [m3]
    double volume;           ///< enclosed by the surface [m3]
    double n_triangle_expected; ///< by the grains' surface and the spacing, before any work
} clast_printable_report;

/// What clast_assembly_printable will make: neck, spacing, smallest_feature, resolved and
/// n_triangle_expected (50 bytes each in an STL) of the report, at no cost.
///
/// @return CLAST_E_USAGE for an assembly that cannot be printed or a spacing beyond its extent
CLAST_API clast_status clast_assembly_printable_plan(const clast_assembly *assembly,
                                                     const clast_printable_config *config,
                                                     clast_printable_report *report);

/// One closed, oriented surface in one piece around all grains and the necks at their contacts.
///
/// Samples min over grains and necks of the signed distance on a grid, fills closed voids, and
/// takes the zero level by marching tetrahedra. [docs/theory/printable.md]
///
/// @param assembly  its contacts must be known (n_contact > 0 unless it has one grain)
/// @return CLAST_E_GEOMETRY when the union falls into several pieces at this spacing (neck too
/// thin, contacts
///         missing): the message counts them; CLAST_E_LIMIT when the grid would pass 2^31 nodes
/// @note O(extent^3 / spacing^3) memory (4 bytes a node) and time; the same bytes for any thread
/// count
CLAST_API clast_status clast_assembly_printable(const clast_assembly *assembly,
                                                const clast_printable_config *config,
                                                const clast_monitor *monitor, clast_mesh *mesh,
                                                clast_printable_report *report);

CLAST_END
