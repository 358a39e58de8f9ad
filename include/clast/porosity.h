#pragma once
#include <clast/table.h>

// Porosity of a bed: its profile with height, its bulk value, and where the bed lies.

// Beds that a file defines: a run's own, or the inside of a surface.

// The same bed made several times: means and what they are good for.

// Stress of a bed from the forces of its contacts.                     [docs/theory/porosity.md]

CLAST_BEGIN

typedef enum {
    CLAST_BED_CYLINDER, ///< vertical, about (centre[0], centre[1])
    CLAST_BED_BOX,      ///< between vertical walls
    CLAST_BED_PERIODIC, ///< box that repeats in x and y: grains count whole, wherever they poke out
    CLAST_BED_MESH,     ///< inside of a closed surface
    CLAST_BED_PERIODIC_3D ///< box that repeats in x, y and z: it has neither bottom nor top
} clast_bed_kind;

/// The container that a porosity refers to; z points up.
typedef struct clast_bed {
    clast_bed_kind kind;
    bool is_part; ///< cylinder, box or surface in a greater packing: its sides are no walls, and
                  ///< grains count by the share of 512 quasi-random points between them; else whole
    double centre[2];       ///< cylinder [m]
    double radius;          ///< cylinder [m]
    double low[2], high[2]; ///< box and periodic; bounds of a surface [m]
    double floor;           ///< height of the bottom [m]
    double ceiling;         ///< periodic in all three directions: height of the box's top [m]
    double shift; ///< of the images above along x, periodic in all three directions: a sheared cell
                  ///< [m]
    const clast_mesh *surface; ///< mesh: closed and outward; borrowed
} clast_bed;

/// The closed, outward surface of a container that may have holes: each is covered.
///
/// @param closed  empty; filled on success
/// @return CLAST_E_GEOMETRY if it cannot be closed, or encloses nothing
CLAST_API clast_status clast_bed_close(const clast_mesh *container, clast_mesh *closed);

/// The inside of such a surface as a bed; its floor is the lowest point.
CLAST_API clast_bed clast_bed_of_surface(const clast_mesh *closed);

/// Volume between the heights edge[k] and edge[k + 1] [m^3].
CLAST_API void clast_bed_volumes(const clast_bed *bed, int32_t n, const double *edge,
                                 double *volume);

/// Reads "cylinder:RADIUS", "cylinder:RADIUS,X,Y", "box:X0,Y0,X1,Y1", "periodic:X0,Y0,X1,Y1" or, in
/// all three directions, "periodic:X0,Y0,Z0,X1,Y1,Z1[,SHIFT]", each number with an optional unit;
/// the floor is at 0, or at Z0; a sheared cell's upper images lie farther along x by SHIFT.
///
/// @return CLAST_E_CONFIG with the text and what was expected
CLAST_API clast_status clast_bed_parse(const char *text, clast_bed *bed);

/// The text that clast_bed_parse reads, 17 digits; returns its length or -1 when it does not fit.
CLAST_API int clast_bed_format(const clast_bed *bed, size_t size, char *text);

/// Periods in x, y and z [m], 0 for none; false for a bed that has none. The first image begins at
/// (low[0], low[1], floor); one period up is a step of `shift` along x, too.
CLAST_API bool clast_bed_period(const clast_bed *bed, double period[3]);

/// Moves every grain's centroid into the bed's first image.
CLAST_API void clast_bed_wrap(const clast_bed *bed, clast_assembly *assembly);

/// The bed as a one-row table "bed" (text column bed, floor_m), which a run keeps in its state.
CLAST_API clast_status clast_bed_table(const clast_bed *bed, clast_table *table);

/// The bed of such a table; CLAST_E_FORMAT when it is none.
CLAST_API clast_status clast_bed_from_table(const clast_table *table, clast_bed *bed);

/// Horizontal area; of a surface its volume over its height [m^2].
CLAST_API double clast_bed_area(const clast_bed *bed);

typedef enum {
    CLAST_POROSITY_EXACT,  ///< the true shapes
    CLAST_POROSITY_SPHERES ///< each grain as the sphere of its volume at its centroid, as published
} clast_porosity_method;

typedef struct clast_porosity_options {
    clast_porosity_method method;
    double layer;  ///< height of a slice h_p [m]
    double cut;    ///< n_cut: the bed ends where the porosity rises through it; 1: with its solid
    double trim;   ///< h_pd: left out at both ends [m]
    bool at_slice; ///< the bed ends with the slice (reference program); else between slice centres
} clast_porosity_options;

/// Exact shapes, 1 mm slices, cut at 0.5, nothing trimmed.      [Rettinger et al. sec. 4.4]
CLAST_API clast_porosity_options clast_porosity_options_default(void);

/// Solid volume of grain i of an assembly below the heights edge[0] < edge[1] < ...: adds the part
/// between edge[k] and edge[k + 1] to solid[k].
///
/// Spheres and ellipsoids in closed form, surfaces by exact integration over their clipped
/// triangles, clumps whose spheres overlap by exact sections (union of discs) under 12-point Gauss
/// rules between the heights where a sphere begins or ends, and up to 64 spheres also where two
/// begin or cease to cross (error below 1e-4 of the clump; what remains are kinks of the section at
/// such heights).
///
/// @param edge   [n + 1] rising; the first may be -INFINITY, the last INFINITY [m]
/// @param solid  [n] m^3
/// @return CLAST_E_ARGUMENT for edges that do not rise or another method; CLAST_E_MEMORY for clumps
/// only: all others allocate nothing
CLAST_API clast_status clast_porosity_grain_slabs(const clast_assembly *assembly, int32_t i,
                                                  clast_porosity_method method, int32_t n,
                                                  const double *edge, double *solid);

/// Porosity by height: columns z_low_m, z_high_m, solid_m3, porosity, from the floor to above the
/// last grain. What dips below the floor counts in the first slice while no grain reaches a slice
/// or more below it (else what is below is of none). A bed that is periodic in all directions ends
/// at its ceiling; what sticks out above comes in below.
///
///     n(z) = 1 - V_solid / (A h_p)                               [Rettinger et al. sec. 4.4]
///
/// @param table  must be empty; written only on success
/// @return CLAST_E_USAGE without grains, for a layer or an area not above 0, CLAST_E_ARGUMENT for
///         another method, or a cut or trim that cannot be, CLAST_E_LIMIT beyond 1e7 slices
/// @note the same bytes for any thread count; overlaps of grains count twice
CLAST_API clast_status clast_porosity_profile(const clast_assembly *assembly, const clast_bed *bed,
                                              const clast_porosity_options *options,
                                              clast_table *table);

typedef struct clast_porosity_bulk {
    double porosity;      ///< over [z_low, z_high]
    double z_low, z_high; ///< m
    double solid;         ///< m^3 between them
    double top;           ///< height where the porosity rises through the cut, before trimming [m]
} clast_porosity_bulk;

/// Bulk porosity (16): solid volume between floor + trim and top - trim, not a mean of slices. A
/// bed that is periodic in all directions has no ends: its whole box counts, the cut does not, and
/// a trim is CLAST_E_USAGE.
///
/// @param profile  of clast_porosity_profile with the same options
/// @return CLAST_E_GEOMETRY when no slice is denser than the cut, or trimming leaves nothing;
/// options are refused as by clast_porosity_profile
CLAST_API clast_status clast_porosity_measure(const clast_assembly *assembly, const clast_bed *bed,
                                              const clast_table *profile,
                                              const clast_porosity_options *options,
                                              clast_porosity_bulk *bulk);

/// Side walls beside the size of the grains: grains cannot lie as close at a wall, so a narrow bed
/// is looser (docs/theory/porosity.md).
typedef struct clast_bed_walls {
    double size;   ///< diameter of equal volume, mean by volume: sum V d / sum V [m]
    double radius; ///< 2 area / circumference: radius of a cylinder, half the width of a square
                   ///< box; INFINITY: periodic or a part of a packing, no side walls; NAN: a
                   ///< surface [m]
    double ratio;  ///< radius / size
} clast_bed_walls;

/// NAN throughout for beds or assemblies that do not hold together.
CLAST_API clast_bed_walls clast_bed_side_walls(const clast_bed *bed,
                                               const clast_assembly *assembly);

/// What reaches beyond the sides of a bed: slices count grains whole, so that a bed which is
/// smaller than what holds them has too low a porosity.
typedef struct clast_bed_beyond {
    int32_t n; ///< grains with a point of 512 beyond (quasi-random): a contact's overlap has none
    double depth; ///< of the farthest: exact for spheres, else of its points [m]
    double solid; ///< theirs beyond the sides, by points [m^3]
} clast_bed_beyond;

/// Between the heights of the bulk.
///
/// A periodic bed has no sides; there n counts the grains of which images of grains cover a part,
/// and solid is what these cover (so that it counts twice), less what grains cover of each other
/// without images [m^3]: 0 but for contacts where the grains repeat so, and large where the period
/// is not theirs. Depth is 0, and the grains are taken as they lie: clast_bed_wrap comes later.
/// Grains that take more than 1.01 times its volume, up to the highest, are CLAST_E_GEOMETRY.
///
/// @param bulk    not looked at for a periodic bed
/// @param method  of the bulk; images are of true shapes
/// @param beyond  written only on success
/// @return CLAST_E_MEMORY, or what a bed's surface or a grain's is refused with
/// @note the same bytes for any thread count
CLAST_API clast_status clast_bed_beyond_measure(const clast_bed *bed,
                                                const clast_assembly *assembly,
                                                const clast_porosity_bulk *bulk,
                                                clast_porosity_method method,
                                                clast_bed_beyond *beyond);

/// Share of a bed's volume between two heights that lies outside another bed, by 20,000
/// quasi-random points: what a run's own bed does not hold has no grains, and would count as pores.
///
/// @param own    of a periodic one its first image; above and below a surface nothing is compared
/// @param z      [2] lower and upper height [m]
/// @param share  0 to 1; written only on success
/// @return CLAST_E_USAGE for heights that do not rise, CLAST_E_MEMORY, or what a bed's surface is
///         refused with
CLAST_API clast_status clast_bed_outside(const clast_bed *bed, const clast_bed *own,
                                         const double z[2], double *share);

typedef struct clast_porosity_core {
    double depth;    ///< left out at the side walls: middle of the ramp [m]
    double porosity; ///< of what is farther from them
    double error;    ///< standard error as of random points, an upper bound for quasi-random ones
    double share;    ///< of the side walls: bulk porosity - that of the core
} clast_porosity_core;

/// Porosity of a cylinder or box away from its side walls, between the same heights as the bulk.
///
/// A point counts by w, which rises from 0 at n_size - 1/2 grain sizes (clast_bed_side_walls) from
/// the nearest side wall to 1 at n_size + 1/2: grains stand in layers there, and one layer's width
/// evens out what a sharp cut would find. Porosity is 1 - (integral of w over the solid) /
/// (integral of w). Grains that lie on the ramp are represented by 512 quasi-random points each,
/// others are exact.
///
/// @param options  of the bulk
/// @param n_size   1/2 at least
/// @param core     written only on success
/// @return CLAST_E_USAGE for a bed that is periodic or a part of a packing (no side walls) or a
///         surface, CLAST_E_GEOMETRY when nothing is as far from the walls
CLAST_API clast_status clast_porosity_core_measure(const clast_assembly *assembly,
                                                   const clast_bed *bed,
                                                   const clast_porosity_bulk *bulk, double n_size,
                                                   const clast_porosity_options *options,
                                                   clast_porosity_core *core);

/// The bed that a run's state file keeps. One within a surface gets that surface, which the caller
/// owns and frees.
///
/// @param surface  empty
/// @return CLAST_E_FORMAT when the file defines none
CLAST_API clast_status clast_bed_read(const char *path, clast_bed *bed, clast_mesh *surface);

/// "mesh:FILE,UNIT", the inside of a surface whose holes are covered (a file by clast_mesh_write
/// that says its unit needs none here), or what clast_bed_parse takes.
CLAST_API clast_status clast_bed_load(const char *text, clast_bed *bed, clast_mesh *surface);

/// Porosity around each grain: its cell of the radical Voronoi diagram (power diagram) of the
/// spheres of equal volume, inside the bed between two heights.           [Gellatly1982]
///
/// Cell of grain i: all points x with |x - c_i|^2 - r_i^2 <= |x - c_j|^2 - r_j^2 for all j; local
/// porosity 1 - V_i / V_cell. A periodic bed repeats in x and y; a cylinder is a prism of 96 sides
/// and equal area. Only grains with their centre inside take part; their cells add up to the
/// volume. A grain whose cell is smaller than itself (heavy overlap, or a cut-off grain at the
/// border) has a negative value; one without a cell (it lies inside another) has none, NaN, and so
/// has one whose cell the sides of a part of a packing cut.
///
/// Columns grain, cell_m3, volume_m3, porosity, n_face, border (1: the cell reaches floor, top or a
/// wall). Rows are the grains inside, in order.
///
/// @param z_low   the cells lie between this height
/// @param z_high  and this [m]
/// @param table  must be empty; written only on success
/// @return CLAST_E_USAGE when no grain lies inside
/// @note O(n) for uniform beds; the same bytes for any thread count
CLAST_API clast_status clast_porosity_local(const clast_assembly *assembly, const clast_bed *bed,
                                            double z_low, double z_high, clast_table *table);

typedef struct clast_radial_options {
    clast_porosity_method method;
    int32_t n_ring;  ///< rings of equal width up to the wall
    int32_t n_point; ///< points a grain; 0: 512
} clast_radial_options;

/// Porosity by distance from the axis of a cylindrical bed, between two heights.
///
/// Each grain is represented by `n_point` quasi-random points inside it (equal-volume spheres or
/// true shapes by `method`); the error is that of random points, an upper bound for these. What
/// pokes through the wall counts in the last ring; of a part of a packing it does not. Columns
/// r_low_m, r_high_m, solid_m3, solid_error_m3, porosity, porosity_error.
///
/// @param z      [2] lower and upper height [m]
/// @param table  must be empty; written only on success
/// @return CLAST_E_USAGE for a bed that is no cylinder, without grains, or rings outside 1 .. 1e6
CLAST_API clast_status clast_porosity_radial(const clast_assembly *assembly, const clast_bed *bed,
                                             const double z[2], const clast_radial_options *options,
                                             clast_table *table);

typedef struct clast_pore_options {
    int64_t n_point; ///< quasi-random points in the bed, of which those in pores count
    int32_t n_bin;
    double period[3]; ///< of the bed in x, y and z; 0: none
} clast_pore_options;

typedef struct clast_pores {
    double porosity; ///< share of the points in pores: an independent estimate
    double mean;     ///< mean delta [m]
    clast_table sizes;
} clast_pores;

/// Frees the table.
CLAST_API void clast_pores_free(clast_pores *pores);

/// Sizes of the pores: delta(x), the distance of a point x of the pore space to the nearest grain.
/// Its distribution is the pore-size density function.         [Torquato2002 sec. 2.6]
///
/// Columns of sizes: delta_low_m, delta_high_m, density_1/m, share_smaller (at delta_high),
/// share_error. The points fill the bed between two heights; distances are exact to the true
/// shapes.
///
/// @param z      [2] lower and upper height [m]
/// @param pores  must be empty; written only on success
/// @return CLAST_E_USAGE without grains or heights, CLAST_E_ARGUMENT for a period below 0 or not
///         finite, CLAST_E_GEOMETRY when no point is in a pore
CLAST_API clast_status clast_pores_measure(const clast_assembly *assembly, const clast_bed *bed,
                                           const double z[2], const clast_pore_options *options,
                                           clast_pores *pores);

/// Mean of a few values and how well it is known.
typedef struct clast_mean {
    int32_t n;
    double mean;
    double deviation; ///< of one value, n - 1 below the root; NAN for one
    double low, high; ///< 95 % interval of the mean by Student's t; NAN for one
} clast_mean;

/// Mean of n values with its interval, in the unit of the values. NaN throughout, and n 0, where
/// there is no value.
CLAST_API clast_mean clast_mean_of(int32_t n, const double *value);

/// Mean porosity profile of n beds: z_low_m, z_high_m, porosity, deviation, low, high (95 % of the
/// mean by Student's t; deviation 0 and no width for one bed), n. A lower bed is empty above its
/// top. Rings of clast_porosity_radial likewise, then with r_low_m, r_high_m.
///
/// @param profile  [n] of clast_porosity_profile, with the same floor and layer, or of
///                 clast_porosity_radial, with the same rings
/// @return CLAST_E_USAGE when slices differ
CLAST_API clast_status clast_porosity_mean_profile(int32_t n, const clast_table *profile,
                                                   clast_table *band);

/// How an assembly's contacts and grains are directed: columns name, value, unit, meaning.
///
/// Contacts (absent where they are not known): mean coordination, shares of grains with none and
/// with fewer than four contacts, mean without the latter; eigenvalues and vertical entry of the
/// fabric tensor                 F = 1/N sum n n^T          [Satake1982]
/// of unit contact normals n between grains (rows normal_*; known from `contacts`, or where all
/// grains are spheres), and the same of unit branch vectors between the centroids of touching
/// grains (rows branch_*). In a periodic bed pass its period, so that branches take the short way.
///
/// Grains (absent for spheres): the same for Q = sum V a a^T / sum V over the longest and the
/// shortest principal axes a, by volume V, and the mean angle of the longest axis to the
/// horizontal. Random directions give eigenvalues of 1/3; a layered bed has a high vertical entry
/// of the shortest axis.
///
/// @param contacts  of clast_dem_contact_table, its columns b, normal_x, normal_y, normal_z and
///                  branch_x_m, branch_y_m, branch_z_m; NULL or without them: normals are not
///                  known, branches go to the nearest image
/// @param period  x, y and z period [m], 0 for none; NULL: none
/// @param table   must be empty; written only on success
CLAST_API clast_status clast_fabric(const clast_assembly *assembly, const clast_table *contacts,
                                    const double period[3], clast_table *table);

/// Mean stress between two heights, and what follows from it: columns name, value, unit, meaning.
///
///     sigma_ij = 1/V sum f_i l_j                            [Love1927, Weber1966; pressure > 0]
///
/// over contacts, f the force of a on b and l the branch from a to b; of a branch that is partly
/// outside the heights, that part is left out. In a bed that is periodic in z it comes in again on
/// the other side. Rows: the six entries of the symmetric part, mean pressure, deviator q, ratio of
/// horizontal to vertical stress.
///
/// @param contacts  of clast_dem_contact_table    @param z  heights [m]
/// @return CLAST_E_FORMAT when the table is no such, CLAST_E_GEOMETRY where there is no volume,
///         CLAST_E_USAGE for heights farther apart than the period in z, and for a part of a
///         packing: contacts are those of all grains (clast_bed_fields has stresses by position)
CLAST_API clast_status clast_stress(const clast_table *contacts, const clast_bed *bed,
                                    const double z[2], clast_table *table);

/// The same in the slices of a porosity profile: z_low_m, z_high_m, stress_xx_Pa, .. yy, zz, xy,
/// xz, yz. At rest stress_zz is the weight less buoyancy of the grains whose centres lie above,
/// over the area, averaged over the slice: branches are shared out by their length in each slice.
CLAST_API clast_status clast_stress_profile(const clast_table *contacts, const clast_bed *bed,
                                            const clast_table *profile, clast_table *table);

/// Continuum fields from grains and contacts on a grid [Goldhirsch2010], exact at walls
/// [Weinhart2012]: a row a cell, x fastest, with the mean of each field over the cell.
///
/// Columns x_m, y_m, z_m (its middle), dx_m, dy_m, dz_m (its sides), density_kg/m^3, solid (volume
/// of grains over that of the cell), velocity_x_m/s .. (NaN where nothing is), stress_xx_Pa .. yz
/// (contacts), kinetic_stress_.. (beside that velocity), wall_force_x_N/m^3 .. (of walls on
/// grains). The kernel is a Gaussian of standard deviation `width` in each direction, cut off at 5
/// of them. Cells are as wide, or what divides a period; the grid holds all of the kernels, so that
/// sums over cells are those over grains: mass, momentum, sum f l. [docs/theory/load.md]
///
/// @param contacts    of clast_dem_contact_table, in the assembly's order; NULL: stress and wall
///                    force are NaN
/// @param velocities  a row a grain, columns velocity_x_m/s, .. y, .. z; NULL: velocity and kinetic
///                    stress are NaN
/// @param width       of the kernel, at most a period [m]
/// @param table       must be empty; written only on success
/// @return CLAST_E_LIMIT beyond 5e7 cells; CLAST_E_FORMAT for tables that are none of these
CLAST_API clast_status clast_bed_fields(const clast_bed *bed, const clast_assembly *assembly,
                                        const clast_table *contacts, const clast_table *velocities,
                                        double width, clast_table *table);

/// Contacts as lines from a's centre to b's, or to a wall, and which are links of a force chain: of
/// three grains or more whose greatest principal pressure is above the mean of all, within 45
/// degrees of its direction.                                                       [Peters2005]
///
/// Columns a, b (-1: a wall), x0_m .. z0_m, x1_m .. z1_m, force_x_N .. (of a on b), force_N,
/// force_share (over the mean), chain (from 1; 0: none), pressure_a_Pa, pressure_b_Pa.
///
/// @param contacts  of clast_dem_contact_table, in the assembly's order
/// @param table     must be empty; written only on success
CLAST_API clast_status clast_bed_chains(const clast_bed *bed, const clast_assembly *assembly,
                                        const clast_table *contacts, clast_table *table);

/// A bed that is measured, and what is known of it; all is borrowed, and may be NULL but for bed.
typedef struct clast_bed_known {
    const clast_bed *bed;
    bool is_own;          ///< the bed is the run's: else it is given, and may not hold the grains
    const clast_bed *own; ///< the run's, to compare a given one with
    const clast_table *contacts;   ///< of clast_dem_contact_table, in the assembly's order; without
                                   ///< columns: not known, as the next
    const clast_table *velocities; ///< of clast_bed_fields
} clast_bed_known;

/// What is measured beside profile, bulk, side walls, overlaps and fabric; 0: not.
typedef struct clast_bed_options {
    clast_porosity_options porosity; ///< layer 0: 1 mm, or a tenth of the diameter of the grains'
                                     ///< mean volume, where that is below 1 mm or has no unit
    double floor;  ///< height of the bottom of a given bed that has none of its own [m]
    double gap;    ///< grains this close touch [m]
    double core;   ///< grain sizes from the side walls
    bool local;    ///< porosity around each grain
    int32_t rings; ///< of radial porosity
    int64_t pores; ///< points
    double fields; ///< width of their kernel [m]
    bool chains;   ///< of forces
} clast_bed_options;

/// Tables without columns, NAN and an n of -1: not asked for, or not known.
typedef struct clast_bed_findings {
    clast_bed bed; ///< as it was measured: with its floor; a part of the packing where pores are
                   ///< asked for and more than a hundredth of the solid lies beyond its sides
    clast_bed_options options; ///< as they were used: with the layer
    clast_porosity_bulk bulk;
    clast_bed_walls walls;
    clast_bed_beyond beyond; ///< of given beds with side walls
    double outside;          ///< clast_bed_outside, of the same
    clast_porosity_core core;
    int32_t n_overlap; ///< of clast_assembly_overlaps, where contacts are not known and nothing is
                       ///< sheared; depth [m] and share by the smaller grain's radius likewise
    double max_overlap, max_overlap_share;
    double mean_coordination;
    bool knows_contacts; ///< the run does, with their forces
    clast_table profile, coordination, fabric, local, radial;
    clast_table stress, stress_profile; ///< where forces are known; not of a part of a packing
    clast_table fields, chains;
    clast_pores pores;
} clast_bed_findings;

/// Frees the tables; may be called twice.
CLAST_API void clast_bed_findings_free(clast_bed_findings *findings);

/// Everything that clast porosity measures of one bed.
///
/// Moves the grains of a periodic bed into it and with a gap finds their contacts, also where it
/// fails later.
///
/// @param findings  must be empty; written only on success. Its bed borrows the surface
/// @return CLAST_E_GEOMETRY for a bed that holds more solid than its volume, and for a given one
///         that is not what holds the grains: more than a hundredth of the solid lies beyond its
///         sides (pores: then it is a part of the packing) or in its images, or its period is not
///         the run's; CLAST_E_USAGE for what the bed does not have or does not know, before the
///         work; CLAST_E_ARGUMENT for options that cannot be; or as each of the measures
CLAST_API clast_status clast_bed_measure(clast_assembly *assembly, const clast_bed_known *known,
                                         const clast_bed_options *options,
                                         clast_bed_findings *findings);

CLAST_END
