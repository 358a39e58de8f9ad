#pragma once
#include <clast/field.h>

CLAST_BEGIN

/// Points in one, two or three dimensions, with optional properties; arrays may be borrowed by the
/// functions that read them.
struct clast_cloud {
    int64_t n;
    int32_t dimension; ///< 1, 2 or 3
    double *x;         ///< [n][dimension] m
    double *radius;    ///< [n] m, or NULL
    double *mass;      ///< [n] kg, or NULL
    double *weight;    ///< [n] real particles a parcel stands for, or NULL (1)
    double *velocity;  ///< [n][dimension] m/s, or NULL
    double *variable;  ///< [n] temperature or the like: cells shall be uniform in it too; or NULL
    /// Of a file's points: the first column that holds weights by its name ("weight",
    /// "stat_weight", "statistical_weight", "parcel_weight", "n_real", "multiplicity"), some of
    /// which are not 1, where none is named: each row is one particle then. Else "".
    char unread_weight[64];
};

/// Allocates n points, zeroed; `cloud` must be empty. CLAST_E_MEMORY.
CLAST_API clast_status clast_cloud_alloc(int64_t n, int32_t dimension, clast_cloud *cloud);
/// Frees the arrays; may be called twice.
CLAST_API void clast_cloud_free(clast_cloud *cloud);

/// Which columns of a table hold what; an empty list, an empty text or NULL: nothing does.
typedef struct clast_cloud_columns {
    clast_text_list columns;          ///< coordinates; an item may be a list itself, "x,y,z"
    clast_text_list velocity_columns; ///< as many as coordinates
    char *radius_column, *diameter_column, *mass_column, *weight_column, *variable_column;
    char *unit; ///< of coordinates whose columns name none ("mm"); NULL or "": metres
} clast_cloud_columns;

/// Numbers of the named column; *column is NULL for a name that is empty or NULL.
///
/// @return CLAST_E_FORMAT when the table has no such column of numbers: the columns it has, or the
/// first row without a number, with a guess
CLAST_API clast_status clast_cloud_column(const clast_table *table, const char *name,
                                          double **column);

/// Takes numbers of the named column to SI by the unit that its name gives: in brackets anywhere
/// ("G (1/min) mean"), or behind "_" ("U_cm/s_x"); they stay what they are where it is empty or
/// gives none. A word behind "_" that may be an index is none of another dimension ("x_t").
/// Temperatures may be in degrees Celsius ("T_C", "T (degC)").
///
/// @param value  [n_row] of them, changed in place
/// @return CLAST_E_CONFIG for a unit that is none of this dimension, known or not (u_ft/s, "x
/// (ft)", "d (g)", and phi, which has no factor); else as clast_cloud_column
CLAST_API clast_status clast_cloud_column_si(const clast_table *table, const char *name,
                                             const char *si_unit, double *value);

/// A table's rows as a cloud, in SI: a column whose name gives a unit (x_mm, "r (um)", "u_cm/s",
/// radii and diameters also "d (phi)") is converted; see clast_cloud_column_si. The default
/// coordinates "x,y,z" are also found as x_m, x_mm and so on, where a table has one such column;
/// missing trailing ones end the list.
///
/// @return CLAST_E_FORMAT names the missing column, coordinates or velocities of which some give a
/// unit and some none (without `unit`), and a column of times ("time", "t (s)", "timestep", "step",
/// "iteration", "frame", any case; "T" alone is none) that `columns` does
/// not name and that holds more than one: such rows are several clouds; CLAST_E_CONFIG for radii
/// and diameters at once, and for a unit beside columns that name another
CLAST_API clast_status clast_cloud_from_table(const clast_table *table,
                                              const clast_cloud_columns *columns,
                                              clast_cloud *cloud);

/// What to say of unread_weight: "points.csv: column 'weight' is not looked at: each row is one
/// particle (--weight-column weight)"; "" where nothing is.
///
/// @param name  of the file    @param text  [size], 256 and the name suffice
/// @return text
CLAST_API const char *clast_cloud_weight_words(const clast_cloud *cloud, const char *name,
                                               size_t size, char *text);

/// Points that have the very coordinates of an earlier one; O(n).
CLAST_API clast_status clast_cloud_repeated(const clast_cloud *cloud, int64_t *n_repeated);

/// The same of the points that all ranks have together; called by all of them.
///
/// @param comm  NULL: the only rank
CLAST_API clast_status clast_cloud_repeated_ranks(const clast_cloud *cloud, const clast_comm *comm,
                                                  int64_t *n_repeated);

// Particle positions from files, as tables of named columns.

/// Which of a file's snapshots was read.
typedef struct clast_points_snapshot {
    int64_t number, n; ///< from 1, of so many: 1, 1 of other files than LAMMPS dumps and XYZ
    int64_t step;      ///< TIMESTEP of a dump; -1: not known
} clast_points_snapshot;

/// {0} is valid: the first snapshot.
typedef struct clast_points_options {
    const char *dataset; ///< HDF5: "/name" of an array [n] or [n][k], or of a folder of arrays [n]
    int64_t frame; ///< LAMMPS dump or XYZ: snapshot, from 0; negative: from the end, -1 the last
    clast_points_snapshot *snapshot; ///< receives which one was read; may be NULL
} clast_points_options;

/// Reads delimited text, legacy VTK (ASCII, binary), VTP and VTU (ASCII, base64, appended, zlib),
/// PLY (ASCII, both byte orders), XYZ (count, comment, rows "NAME x y z"), a LAMMPS or LIGGGHTS
/// dump, or an HDF5 array: whatever the file's first bytes show.
///
/// Delimited text without a header has the columns column_1, column_2, ... Columns of a PLY are the
/// numbers of its vertices; those of an XYZ file name, x, y, z, column_5, ...,
/// or the keys of its Properties=species:S:1:pos:R:3 (pos: x, y, z; of others KEY_x, ... or KEY_1).
/// Coordinates of VTK files become columns x, y, z; a point array of two or three numbers becomes
/// name_x, name_y, name_z, one of k numbers name_0 .. name_(k-1). A dump's columns keep their
/// names; scaled coordinates xs, ys, zs become x, y, z too; its ITEM: UNITS counts for positions,
/// sizes, velocities and masses. Columns of an HDF5 array [n][k] are x,
/// y, z, c3, ...; arrays of a folder keep their names; an attribute "units" or "unit" counts.
///
/// @param options  NULL: {0}    @param table  empty; written only on success
/// @return CLAST_E_FORMAT with the place, and for VTK and PLY files whose points faces join, which
/// are vertices of surfaces; CLAST_E_IO; CLAST_E_LIMIT beyond 16 GiB; CLAST_E_USAGE
/// for a frame of what is no dump or XYZ, a dataset of what is no HDF5 file
/// @note memory is bounded by a small multiple of the file's size, whatever the file declares
CLAST_API clast_status clast_cloud_read(const char *path, const clast_points_options *options,
                                        clast_table *table);

/// The points of one file, a part on each rank in the order of the rows: delimited text by
/// stretches of its bytes, HDF5 arrays by rows, some at a time, so that no rank holds the file.
/// Called by all ranks; a rank may get no point. A file that is not rank 0's (by its size and 64
/// blocks of 64 KiB) is refused.
///
/// @param comm  NULL: the only rank    @param columns  as of clast_cloud_from_table
/// @param cloud  empty; written only on success
/// @return as clast_cloud_read and clast_cloud_from_table, the same on every rank; CLAST_E_FORMAT
/// for other formats and for quoted cells
CLAST_API clast_status clast_cloud_read_ranks(const clast_comm *comm, const char *path,
                                              const clast_cloud_columns *columns,
                                              const clast_points_options *options,
                                              clast_cloud *cloud);

/// clast_cloud_read from memory, HDF5 excepted; `name` stands for the path.
CLAST_API clast_status clast_cloud_parse(const char *name, const void *bytes, size_t n,
                                         const clast_points_options *options, clast_table *table);

// Domains whose volume a map with constant Jacobian carries to the unit cube, so that uniform
// points stay uniform; and domains inside a closed surface, by extension to its bounding box.
// [Martinez2021 sec. 3.3; docs/theory/decompose.md]

typedef enum {
    CLAST_DOMAIN_BOX,
    CLAST_DOMAIN_CYLINDER,  ///< its own axis z: (rho^2/R^2, (theta + pi)/(2 pi), z/L)
    CLAST_DOMAIN_HALF_PIPE, ///< y >= 0: (rho^2/R^2, theta/pi, z/L)
    CLAST_DOMAIN_SPHERE,    ///< (r^3/R^3, (1 + cos polar)/2, (azimuth + pi)/(2 pi))
    CLAST_DOMAIN_MAP,       ///< the caller's map: clast_domain_of_map
    CLAST_DOMAIN_MESH       ///< inside a closed surface: clast_domain_of_mesh
} clast_domain_kind;

/// A caller's map of a domain onto the unit cube. Uniform points must stay uniform: |det dx/du|
/// has one value everywhere, the domain's volume. Called from several threads at once.
typedef struct clast_domain_map_functions {
    int32_t dimension; ///< 1..3
    double volume;     ///< > 0 [m^d]
    /// True when x [dimension] is in the closed domain; u [dimension] is then in [0, 1]^d.
    bool (*map)(const void *context, const double *x, double *u);
    void (*unmap)(const void *context, const double *u, double *x); ///< the inverse
    const void *context;                                            ///< borrowed
} clast_domain_map_functions;

/// A closed surface made ready for inside tests and cut cells. Opaque.
typedef struct clast_domain_surface clast_domain_surface;

/// A known domain; never taken from the sample's own least and greatest coordinates.
struct clast_domain {
    clast_domain_kind kind;
    int32_t dimension;      ///< 1..3 for a box, else 3
    double low[3], high[3]; ///< box, and bounding box of a mesh
    double radius, length;  ///< R and L [m]; centre of the base (sphere: centre) at the origin
    bool is_placed;         ///< or at `centre`, with the unit vectors `axes` as its own x, y, z
    double centre[3], axes[3][3];
    clast_domain_map_functions user;
    clast_domain_surface *surface; ///< of a mesh, owned; copies of the struct borrow it
};

/// Parses "box:x0,y0,z0,x1,y1,z1" (2, 4 or 6 numbers), "cylinder:R,L" (base centre at the origin,
/// along z), "cylinder:X,Y,Z,NX,NY,NZ,R,L" (base centre, direction of the axis, of any length),
/// "half-pipe:R,L", "sphere:R" or "sphere:X,Y,Z,R". Lengths are in m, or carry a unit ("1mm").
///
/// @return CLAST_E_CONFIG with what was found; every size must be > 0 and finite. "mesh:FILE" is
/// read by clast_domain_read
CLAST_API clast_status clast_domain_parse(const char *text, clast_domain *domain);

/// The same where a bare length is in units of `factor` m.
CLAST_API clast_status clast_domain_parse_in(const char *text, double factor, clast_domain *domain);

enum { CLAST_DOMAIN_TEXT = 256 };

/// The domain as clast_domain_parse reads it, in m; "no domain" of another, "map" for a map,
/// "mesh:" and the bounding box of a surface.
CLAST_API void clast_domain_format(const clast_domain *domain, char text[CLAST_DOMAIN_TEXT]);

/// A domain of the caller's: checks at 64 points that the maps undo each other (1e-8) and that the
/// volume of the map's small cells is constant (1e-3).
///
/// @return CLAST_E_CONFIG says where a map fails
CLAST_API clast_status clast_domain_of_map(const clast_domain_map_functions *functions,
                                           clast_domain *domain);

/// The inside of a closed surface, which is copied, its coordinates times `scale`. The sample is
/// extended by ghosts to the bounding box, cells hold real points alone and the volume of their
/// part inside.
///
/// @return CLAST_E_GEOMETRY for a surface that is open, not oriented, cuts itself, or whose parts
/// overlap
CLAST_API clast_status clast_domain_of_mesh(const clast_mesh *mesh, double scale,
                                            clast_domain *domain);
CLAST_API void clast_domain_free(clast_domain *domain); ///< only a mesh holds memory

/// Volume [m^d].
CLAST_API double clast_domain_volume(const clast_domain *domain);

/// What to say of points that all lie within a thousandth of the domain's width (V^(1/d)), as where
/// one of the two is in another unit; "" of others. Called by all ranks, each with its points; the
/// same on all.
///
/// @param comm  NULL: the only rank    @param text  [size], 128 suffice
/// @return text
CLAST_API const char *clast_cloud_corner_words(const clast_cloud *cloud, const clast_comm *comm,
                                               const clast_domain *domain, size_t size, char *text);

/// True when the point [dimension] is in the closed domain; u [dimension] is then its image in the
/// unit cube.
CLAST_API bool clast_domain_map(const clast_domain *domain, const double *x, double *u);

/// The inverse map: the point x [dimension] whose image in the unit cube is u [dimension]. A mesh:
/// in its bounding box, inside or not.
CLAST_API void clast_domain_unmap(const clast_domain *domain, const double *u, double *x);

/// As clast_domain_parse, and "mesh:FILE": the inside of a closed surface (STL, OBJ, PLY, OFF).
///
/// @param unit  of bare lengths and of the file's coordinates ("mm"); NULL or "": that of a header
///              by clast_mesh_write, else metres
/// @return as clast_mesh_read, clast_mesh_require_unit and clast_domain_of_mesh, with the file's
/// name; CLAST_E_CONFIG for an unknown unit
CLAST_API clast_status clast_domain_read(const char *text, const char *unit, clast_domain *domain);

CLAST_END
