#pragma once
#include <clast/field.h>

// Grains that fall, collide, slide and come to rest: the discrete element method.
//
// Contact law, parameters and integration follow Rettinger, Ruede, Vollmer and Frings, "Effect of
// Sediment Form and Form Distribution on Porosity" (equations by their printed numbers); see
// docs/theory/dem.md.

// Beds that timings and tests share, ready to be stepped; P1, S1 and E1 are defined in
// docs/theory/bench.md.

CLAST_BEGIN

/// Normal and tangential force of a contact.
typedef enum {
    CLAST_DEM_LINEAR, ///< spring and dashpot from restitution and collision time, eq. 6, 7, 11-13
    CLAST_DEM_HERTZ   ///< Hertz and Mindlin, restitution independent of speed
} clast_dem_law;

/// How a step takes springs and dashpots of the linear law.
typedef enum {
    CLAST_DEM_EXPLICIT, ///< forces of eq. 6 and 7 at the step's begin, as published
    CLAST_DEM_EXACT     ///< a lone contact goes its exact way at any step, T_c rounded to a whole
                        ///< number of them; dashpots of grains with many contacts are held stable
} clast_dem_scheme;

/// Attraction of grains that touch.
typedef enum {
    CLAST_DEM_DRY,
    CLAST_DEM_AREA, ///< cohesion times Hertz's contact area, pi R* overlap
    CLAST_DEM_DMT,  ///< constant pull 2 pi w R*
    CLAST_DEM_JKR   ///< Hertz's law: JKR's curve with its neck; linear law: its pull-off force
                    ///< 3/2 pi w R* as a constant
} clast_dem_cohesion;

/// Drag law of grains that are spheres.
typedef enum {
    CLAST_DEM_DRAG_FORM,    ///< that of all forms [Bagheri2016]
    CLAST_DEM_DRAG_STANDARD ///< the standard curve of spheres (clast_drag_sphere)
} clast_dem_sphere_drag;

/// Resistance against rolling. [Ai2011]
typedef enum {
    CLAST_DEM_ROLL_TORQUE, ///< model A: a constant torque against the roll; nothing rests by it
    CLAST_DEM_ROLL_SPRING  ///< model C: a spring that gives way at the limit, with a dashpot
} clast_dem_rolling;

/// Where grains are. All stand about x = y = 0, upwards from z = 0: `floor` is the plane z = 0,
/// `lid` z = height.
typedef enum {
    CLAST_DEM_CYLINDER, ///< upright, inside diameter `width`, axis x = y = 0
    CLAST_DEM_PERIODIC, ///< width x depth, periodic in x and y: images about x = y = 0
    CLAST_DEM_BOX,      ///< between four upright walls at x = +-width / 2, y = +-depth / 2
    CLAST_DEM_OPEN,     ///< no side walls
    CLAST_DEM_CELL ///< width x depth x height, periodic in x, y and z; its sides may move. Images
                   ///< about x = y = 0, z from 0 to height
} clast_dem_domain;

/// Stiffness of two bodies that meet in several spheres of clumps at once.
typedef enum {
    CLAST_DEM_SHARED, ///< that of one contact, divided among them [Kodam2009]
    CLAST_DEM_EACH    ///< every sphere has its own: a pair is as stiff as it has contacts
} clast_dem_clump_contacts;

/// Physics of a run. Defaults are the paper's.
typedef struct clast_dem_config {
    int32_t law;             ///< clast_dem_law
    int32_t contact_scheme;  ///< clast_dem_scheme
    double restitution;      ///< e_n
    double collision_time;   ///< T_c of the linear law [s]
    double poisson;          ///< nu
    double young;            ///< E of Hertz's law [Pa]
    double friction;         ///< mu between grains
    double wall_friction;    ///< mu at walls; below 0: as between grains
    double rolling_friction; ///< torque at most this times R* |F_n|, F_n as friction takes it
    int32_t rolling_model;   ///< clast_dem_rolling
    int32_t cohesion;        ///< clast_dem_cohesion
    double cohesion_energy;  ///< energy density of AREA [J/m^3]
    double surface_energy;   ///< w of DMT and JKR [J/m^2]
    bool clip;               ///< a dashpot never pulls
    bool normal_torque;      ///< normal forces exert torques on grains; not in eq. 5 as printed
    bool gyroscopic;         ///< angular momentum is kept (eq. 3); the reference leaves it out
    int32_t clump_contacts;  ///< clast_dem_clump_contacts
    double time_step;        ///< [s]
    double gravity;          ///< [m/s^2], along -z
    double fluid_density;    ///< buoyancy, eq. 10 [kg/m^3]
    double fluid_viscosity;  ///< drag, torque of fluid at rest; 0: none [Pa s]
    int32_t sphere_drag;     ///< clast_dem_sphere_drag
    bool hindrance;          ///< drag grows with the grains around (clast_drag_hindrance)
    double added_mass;       ///< fluid moved along over the grain's volume; 1/2 of a sphere
    bool wet_restitution;    ///< restitution falls with the impact's Stokes number
    int32_t domain;          ///< clast_dem_domain
    double width, depth;     ///< along x and y, about 0; depth 0: as width [m]
    double height;           ///< of the lid, and of generation [m]
    bool floor, lid;         ///< planes z = 0 and z = height
    double rounding;         ///< radius that edges of hulls get, their volume kept [m]
    double skin;             ///< half the skin of neighbour lists over a grain's radius
    int32_t verify;          ///< steps between comparisons of contacts with cold ones; 0: never
} clast_dem_config;

/// Fields of the configuration: keys, defaults, ranges and units; ends with a row of zeros.
CLAST_API extern const clast_field clast_dem_fields[];

/// A grain to add: shape scaled, rotated, translated.
typedef struct clast_dem_grain {
    int32_t shape;
    double scale;
    double density;             ///< [kg/m^3]
    double position[3];         ///< of the centre of mass [m]
    double orientation[4];      ///< unit quaternion w, x, y, z
    double velocity[3];         ///< [m/s]
    double angular_velocity[3]; ///< world axes [1/s]
} clast_dem_grain;

/// What acts on all grains for a while.
typedef struct clast_dem_drive {
    double shake_amplitude; ///< A_s of eq. 14 [m]; 0: no shaking
    double shake_period;    ///< T_s [s]
    double damping;         ///< c_d of eq. 15, factor a second on all velocities; 1: none
} clast_dem_drive;

/// Remembered contacts beside cold ones (`verify`): pairs of bodies of which one at least is no
/// sphere, touching or listed.
typedef struct clast_dem_verification {
    int64_t n;     ///< compared
    int64_t n_off; ///< gaps that differ by more than 1e-11 m
    int64_t n_bad; ///< by more than 1e-8 m
    double worst;  ///< greatest difference [m]
} clast_dem_verification;

/// Sums over all grains.
typedef struct clast_dem_measures {
    int64_t step;
    double time; ///< [s]
    int32_t n_grain;
    double mass;             ///< [kg]
    double mean_height;      ///< mass-mean of z [m]
    double top;              ///< highest centre [m]
    double max_speed;        ///< [m/s]
    double kinetic_energy;   ///< translation, of the fluid that moves along too; rotation [J]
    double potential_energy; ///< weight less buoyancy, from z = 0 [J]
    double elastic_energy;   ///< in contacts, normal and tangential [J]
    double momentum[3];      ///< [kg m/s]
    int64_t n_listed;        ///< pairs in the neighbour lists
    int64_t n_contact;       ///< pairs of grains that touch; clumps once, in however many spheres
    int64_t n_wall_contact;  ///< the same of a grain with a wall, or a triangle of the container
    double max_overlap;      ///< deepest contact [m]
    double coordination;     ///< 2 n_contact / n_grain
    int64_t n_refresh;       ///< times that neighbour lists were brought up to date
    clast_dem_verification verified;
} clast_dem_measures;

/// Where the energy has gone since clast_dem_begin_energy [J]: put_in = what is held + what is lost
/// + steps + rest.
typedef struct clast_dem_energy {
    double translation;        ///< held: kinetic, with the fluid that moves along
    double rotation;           ///< held: kinetic
    double normal_springs;     ///< held; at the middle of the step, as velocities are
    double tangential_springs; ///< held
    double attraction;         ///< held by pulls of contacts, so 0 or below
    double made;        ///< put in: of grains as they were when the book began, or were added
    double gravity;     ///< put in by weight less buoyancy
    double shaking;     ///< put in
    double cell;        ///< put in by sides of a cell that move
    double walls;       ///< put in by walls that move
    double damping[2];  ///< lost in dashpots: between grains, at walls
    double friction[2]; ///< lost by sliding: the same
    double rolling[2];  ///< lost against rolling (what its spring holds with it): the same
    double fluid;       ///< lost to the fluid
    double calming;     ///< lost to the damping of all velocities
    double left;        ///< gone with grains that were taken out
    double scheme; ///< lost to the scheme, below 0: made by it (contacts that begin and end within
                   ///< a step, tangential springs that sliding stretches anew, bodies that rotate;
                   ///< necks that tear)
    double put_in; ///< made + gravity + shaking + cell + walls
    double rest;   ///< put_in less all others: of rounding, unless a force is missed
} clast_dem_energy;

/// How a wall moves by itself, as a function of its own time t, which runs while it is driven
/// (clast_dem_drive_wall): a point x0 goes to p + d(t) + R (x0 - p), R the rotation about `axis` by
///
///     d = velocity t + amplitude sin(2 pi t / period) + table,
///     angle = rate t + swing sin(2 pi t / period) + table
typedef struct clast_dem_wall_motion {
    double velocity[3];  ///< [m/s]
    double amplitude[3]; ///< of vibration [m]
    double period;       ///< of vibration and swing [s]; above 0 where there is either
    double axis[3];      ///< unit, fixed; zeros: the wall does not rotate
    double pivot[3];     ///< p, on the axis [m]
    double rate;         ///< [rad/s]
    double swing;        ///< [rad]
    int32_t n;           ///< rows of the table: linear between them, at rest before and after
    double *time;        ///< [n] rising [s]; copied
    double (*place)[4];  ///< [n] offset [m], angle [rad]; copied
} clast_dem_wall_motion;

/// A wall as it is now, and what grains do to it; in the order in which walls are numbered: floor,
/// lid, left (low x), right, front (low y), back, or the cylinder, those that the domain has; then
/// surfaces in the order in which they were added.
typedef struct clast_dem_wall {
    bool is_open;
    double offset[3], angle;      ///< from where it was added [m], [rad]
    double velocity[3], omega[3]; ///< in the last step, of the pivot [m/s], [rad/s]
    double force[3], torque[3];   ///< of grains in the last step; about the pivot [N], [N m]
    double impulse[3], moment[3]; ///< sums of these over time [N s], [N m s]
    double work;                  ///< of the wall on grains [J]
    int64_t n_step;               ///< in which its own motion ran
} clast_dem_wall;

/// How two materials touch: what of the configuration may differ from pair to pair. Begin with
/// clast_dem_contact_of.
typedef struct clast_dem_contact {
    double friction;
    double rolling_friction;
    double restitution;
    double collision_time; ///< of the linear law [s]
    double young[2];       ///< of Hertz's law, of the first material and the second [Pa]
    double poisson[2];     ///< the same
} clast_dem_contact;

/// The periodic cell as it is now; zeros in other domains.
typedef struct clast_dem_cell {
    double side[3];      ///< [m]
    double rate[3];      ///< of the sides [m/s]
    double shift;        ///< of the upper images along x [m]
    double shear_rate;   ///< of the shift [m/s]
    double strain[3];    ///< -ln(side / first side), > 0 in compression
    double shear_strain; ///< of the shift over the height
} clast_dem_cell;

/// What a bed carries. Tensors are xx, yy, zz, xy, xz, yz, pressure above 0. Stress, modulus and
/// volume of domain cell alone; 0 in others (clast_stress).
typedef struct clast_dem_load {
    double volume, solid;     ///< of the cell, of its grains [m^3]
    double stress[6];         ///< of contacts: sum f l / V [Pa]
    double kinetic_stress[6]; ///< sum m v v / V, v relative to the homogeneous motion [Pa]
    double modulus[3];        ///< of the normal springs at uniform strain, sum k (l n)^2 / V
                              ///< [Pa]; an upper bound
    double shear_modulus;     ///< the same of shear xz: sum k l_z^2 / V, k_t at most k [Pa]
    double fabric[6];         ///< mean n n of contacts between grains
    int64_t n_contact;        ///< pairs of grains
    int64_t n_force;          ///< places where grains touch: more, where clumps do
    double coordination;      ///< 2 n_contact / n_grain
    int32_t n_rattler; ///< grains with fewer than 2 contacts (4 without friction), left out one
                       ///< after another
    double coordination_held; ///< of the others among themselves
    double unbalanced;        ///< mean force on a grain over the mean force of a contact
    double force_mean;        ///< of a contact [N]
    double force_below[3];    ///< below which 50, 90, 99 % of the forces between grains lie [N]
} clast_dem_load;

/// A running simulation. Opaque; one thread at a time (it uses threads itself).
typedef struct clast_dem clast_dem;

/// @return CLAST_E_CONFIG for a field out of its range (clast_dem_fields), or when the time step
/// does not resolve the stiffest contact
CLAST_API clast_status clast_dem_create(const clast_dem_config *config, clast_dem **dem);
CLAST_API void clast_dem_destroy(clast_dem *dem); ///< NULL is allowed

/// Fixed triangles that grains cannot pass, from either side: a container, closed or open, or any
/// obstacle. Once, before the first grain. Planes and sides of the domain stay as configured.
///
/// @return CLAST_E_GEOMETRY for a vertex that is not finite, by its number, or if no triangle has
/// an area
CLAST_API clast_status clast_dem_add_container(clast_dem *dem, const clast_mesh *mesh);

/// A surface as one more wall, closed or open, which may be moved, watched and opened; before the
/// first grain. Its number goes to *wall.
///
/// @return CLAST_E_GEOMETRY as clast_dem_add_container
CLAST_API clast_status clast_dem_add_wall(clast_dem *dem, const clast_mesh *mesh, int32_t *wall);

/// Sums the forces on all walls from the next step on, those of the domain with them, and numbers
/// them.
CLAST_API clast_status clast_dem_watch_walls(clast_dem *dem);
CLAST_API int32_t clast_dem_n_wall(const clast_dem *dem); ///< 0 while none are numbered

/// How a wall moves, before it does.
///
/// @return CLAST_E_CONFIG where a plane or cylinder of the domain would not stay one; CLAST_E_USAGE
/// for a wall that is not there, numbers that are not finite, a period below 0, or of 0 beside an
/// amplitude or a swing
CLAST_API clast_status clast_dem_set_wall_motion(clast_dem *dem, int32_t wall,
                                                 const clast_dem_wall_motion *motion);

/// From the next step on the wall's own motion runs, or stands; a velocity is added to it [m/s].
CLAST_API clast_status clast_dem_drive_wall(clast_dem *dem, int32_t wall, bool runs,
                                            const double velocity[3]);

/// Takes a wall away: an orifice opens.
CLAST_API clast_status clast_dem_open_wall(clast_dem *dem, int32_t wall);

/// A wall as it is now; untouched where there is no such wall.
CLAST_API void clast_dem_read_wall(const clast_dem *dem, int32_t wall, clast_dem_wall *out);

/// Takes grains out; those after them move up in number. Contacts of the others stay.
///
/// @param goes  [clast_dem_n_grain] not 0: this one
CLAST_API clast_status clast_dem_remove_grains(clast_dem *dem, const uint8_t *goes);

/// Adds a copy of a shape; its number goes to *id.
///
/// @return CLAST_E_GEOMETRY for a shape without volume, or a mesh that is open or not convex
CLAST_API clast_status clast_dem_add_shape(clast_dem *dem, const clast_shape *shape, int32_t *id);

/// The contact of a configuration, between grains or at walls.
CLAST_API clast_dem_contact clast_dem_contact_of(const clast_dem_config *config, bool at_wall);

/// From now on contacts go by the materials of both sides, 0 .. n - 1, of which shapes and walls
/// are 0 unless set; once, before the first grain.
///
/// Hertz's law: 1/E* = (1 - nu_a^2)/E_a + (1 - nu_b^2)/E_b, 1/G* = sum of 2 (2 - nu)(1 + nu)/E.
/// [docs/theory/dem.md "Materials"]
///
/// @param contact  [n][n] of material a (row) with b; read where a <= b
/// @return CLAST_E_CONFIG, naming the two, where the law cannot have a number or the time step does
/// not resolve the contact
CLAST_API clast_status clast_dem_set_contacts(clast_dem *dem, int32_t n,
                                              const clast_dem_contact *contact);

/// Material of a shape, before its first grain; of a wall (numbered as clast_dem_wall says).
///
/// @return CLAST_E_USAGE for a shape, wall or material that is not there, or a shape with grains
CLAST_API clast_status clast_dem_set_material(clast_dem *dem, int32_t shape, int32_t material);
CLAST_API clast_status clast_dem_set_wall_material(clast_dem *dem, int32_t wall, int32_t material);

/// Adds grains; all or none.
///
/// @return CLAST_E_USAGE for an unknown shape or numbers that are not finite; CLAST_E_GEOMETRY for
/// a grain wider than the domain, its period or half a cell, or whose centre lies outside of a wall
/// (clast_dem_domain says where they stand); CLAST_E_CONFIG when Hertz's contact of the smallest
/// grain is too stiff for the time step
CLAST_API clast_status clast_dem_add_grains(clast_dem *dem, int32_t n,
                                            const clast_dem_grain *grain);

/// Sets what acts from the next step on. `drive` is copied.
///
/// @return CLAST_E_ARGUMENT for a number that is not finite or negative, a damping above 1, or a
/// period of 0 beside an amplitude above 0
CLAST_API clast_status clast_dem_set_drive(clast_dem *dem, const clast_dem_drive *drive);

/// Goes on by n_step time steps.
///
/// @return CLAST_E_CONVERGE when a run explodes (a grain is so fast that its contact would overlap
/// by half its radius, docs/theory/dem.md): the message names step, grain and likely cause;
/// CLAST_E_GEOMETRY where grains that were just added lie inside of each other, of grains that were
/// there or of a wall, which is refused until they are taken out, or a cell has become narrower
/// than its grains allow; CLAST_E_ARGUMENT for a negative n_step
CLAST_API clast_status clast_dem_step(clast_dem *dem, int64_t n_step);

/// From now on the work of all forces is booked, which changes no bit of the run; begins anew if it
/// was.
///
/// @return CLAST_E_CONFIG where a fluid exerts torques on grains of several densities:
/// their work is not recorded
CLAST_API clast_status clast_dem_begin_energy(clast_dem *dem);

/// Where the energy has gone; untouched when none was booked.
CLAST_API void clast_dem_energy_measure(const clast_dem *dem, clast_dem_energy *energy);

/// What the bed carries now. Memories are not renewed.
CLAST_API clast_status clast_dem_load_measure(const clast_dem *dem, clast_dem_load *load);

/// Speeds of the cell's three sides, and of the upper images along x, from the next step on [m/s].
/// Grains get the change that belongs to their position, so that the strain is uniform.
///
/// @return CLAST_E_USAGE in other domains
CLAST_API clast_status clast_dem_set_cell_rate(clast_dem *dem, const double rate[3], double shear);
CLAST_API void clast_dem_read_cell(const clast_dem *dem, clast_dem_cell *cell); ///< as it is now

/// Grains so far.
CLAST_API int32_t clast_dem_n_grain(const clast_dem *dem);
CLAST_API int64_t clast_dem_n_step(const clast_dem *dem); ///< steps so far
CLAST_API double clast_dem_time(const clast_dem *dem);    ///< [s]

/// Grain i as it is now; position not wrapped into the period. Untouched where there is no grain i.
CLAST_API void clast_dem_read_grain(const clast_dem *dem, int32_t i, clast_dem_grain *grain);

/// Energies, contacts and overlaps of the moment, SI.
CLAST_API void clast_dem_measure(const clast_dem *dem, clast_dem_measures *measures);

/// Mass-mean of z and the highest centre [m]: what the process asks often.
CLAST_API double clast_dem_mean_height(const clast_dem *dem, double *top);

/// Largest speed of a grain's centre [m/s].
CLAST_API double clast_dem_max_speed(const clast_dem *dem);

/// All grains with their contacts, wrapped into the period. `out` must be empty.
CLAST_API clast_status clast_dem_assembly(const clast_dem *dem, clast_assembly *out);

/// 64-bit digest of all positions, orientations, velocities and contact histories, bit by bit.
CLAST_API uint64_t clast_dem_hash(const clast_dem *dem);

/// Forces of all contacts as they are now: columns a, b (grains; b -1: a wall), centre_z_m (of a),
/// x_m, y_m, z_m (the point), branch_x_m .. (from a's centre to b's, or to the point on a wall),
/// force_x_N .. (of a on b), normal_x .. (unit, from a to b). `table` must be empty. Memories are
/// not renewed.
CLAST_API clast_status clast_dem_contact_table(const clast_dem *dem, clast_table *table);

/// Case P1 and its kin: grains of 63 gravel forms (152 points on a dented ellipsoid), D log-uniform
/// in 5.6 to 8 mm, random form and orientation, on a loose lattice in a box of width x width,
/// periodic in x and y, over a floor, in water; the published law and shaking act. P1 itself:
/// {4000, 152, 0.1, 0}, 0.775 s.
typedef struct clast_scene_bed {
    int32_t n;
    int32_t n_vert; ///< of a form
    double width;   ///< [m]
    double fall;    ///< speed at the start, downwards, beside random ones of 0.1 [m/s]
} clast_scene_bed;

/// Case P1 into *dem, which the caller destroys.
CLAST_API clast_status clast_dem_scene_p1(const clast_scene_bed *bed, clast_dem **dem);

/// Case E1: the grains of a P1 as they are now, replaced by their mass-equivalent ellipsoids (axes
/// times 0.985). The new simulation is not shaken.
CLAST_API clast_status clast_dem_scene_e1(const clast_scene_bed *bed, const clast_dem *p1,
                                          clast_dem **dem);

/// Case S1: 10,830 spheres of 6.7 mm on a simple-cubic lattice of 6.9 mm with random velocities,
/// box of 0.134 m periodic in x and y; to be settled for 0.2 s.
CLAST_API clast_status clast_dem_scene_s1(clast_dem **dem);

CLAST_END
