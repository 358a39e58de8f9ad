#pragma once
#include <clast/assembly.h>

CLAST_BEGIN

/// How the volume of overlapping grains is found.
typedef struct clast_union_options {
    double tolerance; ///< wanted relative standard error of the union's volume
    int64_t n_sample; ///< most sample points in all
    uint64_t seed;    ///< of the sample points
    bool find_depth;  ///< search for the depths of overlaps too; else max_overlap is NAN
} clast_union_options;

/// tolerance 1e-4, 2^24 points, seed 1, with depths.
CLAST_API clast_union_options clast_union_options_default(void);

/// The space that the grains fill, and by how much they overlap.
typedef struct clast_union {
    double volume;      ///< of the union; of its grains where a grain is itself a clump
    double error;       ///< one standard deviation; 0 when it is exact to rounding
    double sum;         ///< of the grains' volumes
    bool is_exact;      ///< nothing was sampled
    int32_t n_overlap;  ///< pairs that overlap by more than 1e-9 of the smaller grain's radius
    double max_overlap; ///< greatest depth of those: the least shift found that parts the pair
    double max_overlap_share; ///< greatest depth by the smaller grain's volume-equivalent radius
} clast_union;

/// Volume of the union of all grains' true solids.
///
/// Grains that overlap no other add their own volume. Groups in which all are spheres or clumps are
/// summed in closed form. Each other grain i adds V_i times the mean of 1 / (number of grains that
/// hold x) over points x in it [Karp1989], taken at shifted lattice points; a grain of which no
/// point lies in another has no error.                             [docs/theory/structure.md]
///
/// @return CLAST_E_USAGE without grains; a result whose error exceeds the tolerance is returned all
///         the same, since its error says so
/// @note the same bytes for any thread count
CLAST_API clast_status clast_assembly_union(const clast_assembly *assembly,
                                            const clast_union_options *options, clast_union *out);

/// Fills assembly->contact with all pairs of grains that come within `gap` of each other, in rising
/// order; the contact point lies halfway between the closest points. What was there is replaced.
CLAST_API clast_status clast_assembly_find_contacts(clast_assembly *assembly, double gap);

/// A box that repeats: its corner and its periods in x, y and z, 0 for none [m].
typedef struct clast_period {
    double low[3];
    double length[3];
} clast_period;

/// The same across the borders of a periodic box too, in which every grain's centroid lies; of each
/// contact across a border the point is on the side of the grain of lower number.
///
/// @param period  NULL: none
CLAST_API clast_status clast_assembly_find_contacts_periodic(clast_assembly *assembly, double gap,
                                                             const clast_period *period);

/// How many grains overlap, and by how much.
typedef struct clast_overlaps {
    int32_t n;    ///< pairs that overlap by more than 1e-9 of the smaller grain's radius
    double depth; ///< greatest of them: the least shift found that parts the pair [m]
    double share; ///< greatest depth by the smaller grain's volume-equivalent radius
} clast_overlaps;

/// @param period  NULL: none; else every grain's centroid lies in the box
/// @note the same bytes for any thread count
CLAST_API clast_status clast_assembly_overlaps(const clast_assembly *assembly,
                                               const clast_period *period,
                                               clast_overlaps *overlaps);

CLAST_END
