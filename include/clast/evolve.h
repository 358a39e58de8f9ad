#pragma once
// A cloud of particles of true shapes in a fluid, followed until it lies on the floor: they fall by
// their own form and spread, meet in cells where the cloud is uniform, join by the exact first
// touch of their surfaces, and settle.                                    [docs/theory/evolve.md]

// A whole run with its folder, checkpoints and going on (clast_evolve_run and clast_evolve_resume)
// is of libclast_view.
#include <clast/cloud.h>
#include <clast/field.h>
#include <clast/grading.h>
#include <clast/kernel.h>
#include <clast/status.h>
#include <clast/table.h>

CLAST_BEGIN

/// What a border does to a particle's centre.
typedef enum { CLAST_BORDER_DEPOSIT, CLAST_BORDER_REFLECT, CLAST_BORDER_PERIODIC } clast_border;

/// What drag a falling particle has.
typedef enum {
    CLAST_FALL_FORM,   ///< of its own form: clast_drag_of_form, clast_terminal_velocity
    CLAST_FALL_SPHERE, ///< of the sphere of its envelope's volume: clast_drag_sphere
    CLAST_FALL_STOKES  ///< creeping flow about that sphere
} clast_fall;

/// The radius that kernels see.
typedef enum {
    CLAST_COLLISION_GYRATION,  ///< sqrt(5/3) R_g: the uniform ball of equal radius of gyration
    CLAST_COLLISION_ENCLOSING, ///< greatest distance of the surface from the centre of mass
    CLAST_COLLISION_VOLUME     ///< of the sphere of the solid's volume
} clast_collision_radius;

/// How the smaller of a pair comes to the larger.
typedef enum {
    CLAST_MEETING_AUTO, ///< by Brownian motion where the kernel is Brownian alone, else on lines
    CLAST_MEETING_BALLISTIC, ///< on lines whose impact parameter is uniform over the cross-section
    CLAST_MEETING_DIFFUSIVE, ///< by Brownian motion from far away
    CLAST_MEETING_CENTRAL,   ///< on a line through the larger one's centre of mass
    CLAST_MEETING_REACTION ///< of all contacts without overlap each is as likely: few touches stick
} clast_meeting;

/// Where particles count as uniformly distributed.
typedef enum {
    CLAST_EVEN_TREE,  ///< cells of a chi-square tree (clast_decompose)
    CLAST_EVEN_BOXES, ///< boxes of bins, as published
    CLAST_EVEN_WHOLE  ///< the whole domain is one cell
} clast_even;

/// All of a run. Texts and lists are owned; start from clast_fields_default.
// NOLINTNEXTLINE(clang-analyzer-optin.performance.Padding): in the order of the options
typedef struct clast_evolve_config {
    clast_medium medium; ///< but its particle_density, shear_constant and settling_law: not read
    char *kernel;        ///< "brownian+settling"
    double alpha;        ///< share of collisions that stick; a factor on what `sticking` says
    clast_sticking sticking;
    int32_t out_of_range; ///< clast_out_of_range

    clast_text_list shapes; ///< files, "sphere", "ellipsoid:a,b,c" or state.h5
    clast_f64_list shape_weight;
    clast_f64_list density; ///< of the solid: one for all shapes, or one each [kg/m^3]
    char *unit;             ///< of the coordinates in surface files
    bool accept_faults;     ///< take surfaces that are open, cross themselves or lie apart
    char *curve;       ///< sizes, as clast_grading_load reads them: volume-equivalent diameters
    int32_t particles; ///< at the start; 0: the rows of `points`
    double weight;     ///< real particles that each stands for, a whole number
    char *release;     ///< domain where they start uniformly; "": all of `domain`
    char *points;      ///< file of positions in place of that; "": none
    clast_text_list columns; ///< of that file: x, y, z, which units in their names convert
    char *diameter_column;   ///< of that file, in place of curve; "": none
    int64_t frame;           ///< its snapshot (clast_points_options)
    char *dataset;           ///< its array or folder, of HDF5; ""

    char *domain;
    int32_t floor, sides; ///< clast_border
    bool open_top;        ///< what passes the top is gone; else it reflects

    char *wind;  ///< velocity of the fluid at z = 0: "x,y,z" [m/s]
    char *field; ///< file of velocities on a regular grid, added to it; "": none
    char *field_columns;
    double wind_shear; ///< d(velocity x)/dz [1/s]
    double eddy_diffusivity;
    bool brownian; ///< particles diffuse by Brownian motion
    int32_t fall;  ///< clast_fall

    bool structure;           ///< aggregates by first touch; else drops that merge
    int32_t collision_radius; ///< clast_collision_radius
    int32_t meeting;          ///< clast_meeting
    double walk_step;         ///< diffusive: least step, by the least released radius
    int32_t max_tries;

    int32_t even;        ///< clast_even
    double change_level; ///< of the test that finds the cloud changed

    double duration;
    int32_t rows; ///< of the tables, beside the one at the start
    double step_error;
    double time_step; ///< [s]; 0: by step_error
    uint64_t seed;

    int32_t keep;     ///< largest aggregates of deposit and cloud, written as state files each
    double bed_width; ///< of deposit.h5, the bed that clast pack --start settles [m]; 0: none
    int32_t frames;   ///< for ParaView
    double checkpoint_time;
    char *resume;
    bool force;
} clast_evolve_config;

/// Fields of clast_evolve_config: keys, defaults, ranges and units; ends with a row of zeros.
CLAST_API extern const clast_field clast_evolve_fields[];

/// What an evolution starts from; everything is borrowed for its life.
typedef struct clast_evolve_input {
    int32_t n_shape;
    const clast_assembly *shape;  ///< [n_shape] one grain or a rigid group each
    const clast_grading *grading; ///< of volume-equivalent diameters; NULL where points have radii
    const clast_domain *domain;
    const clast_domain *release; ///< NULL: the domain
    const clast_cloud *points;   ///< NULL: drawn
    const clast_cloud *field;    ///< nodes of a regular grid with velocities; NULL: none
} clast_evolve_input;

/// An evolution under way. Opaque; one thread at a time (it uses several inside).
typedef struct clast_evolve clast_evolve;

/// All particles at their positions at time 0.
///
/// @return CLAST_E_CONFIG for options that cannot be met (a kernel whose medium lacks something, a
/// floor that nothing reaches), CLAST_E_FORMAT for points outside the domain
CLAST_API clast_status clast_evolve_create(const clast_evolve_config *config,
                                           const clast_evolve_input *input, clast_evolve **evolve);
CLAST_API void clast_evolve_destroy(clast_evolve *evolve); ///< NULL is allowed

/// A leg of at most 16 steps, to the next row of the tables at the farthest. After each leg the
/// state is one to go on from. After clast_evolve_restore the rest of the leg that was saved.
///
/// @return CLAST_E_CONFIG where more than 0.1 % of the collisions lie out of a kernel's range,
/// CLAST_E_CONVERGE where a pair finds no touch or a cell needs over a million sub-steps
CLAST_API clast_status clast_evolve_advance(clast_evolve *evolve);

/// The duration has passed, or nothing is left in the fluid.
CLAST_API bool clast_evolve_is_over(const clast_evolve *evolve);

/// Seconds that have passed in the cloud; NAN for NULL.
CLAST_API double clast_evolve_time(const clast_evolve *evolve);

/// Rows of the tables written, the one at the start not counted; 0 for NULL.
CLAST_API int32_t clast_evolve_n_row(const clast_evolve *evolve);

enum { CLAST_POINTS_WORDS = 256 };

/// An evolution in numbers, SI.
typedef struct clast_evolve_result {
    int64_t n_start, n_particle, n_event, n_deposit, n_out, n_step;
    double time;
    double mass_start, mass, mass_deposit, mass_out; ///< of all real particles [kg]
    int64_t n_wall;   ///< of the deposit: on sides or a ceiling, not on the floor
    double mass_wall; ///< of them [kg]
    double gathered;  ///< share of the mass at the start that a floor or top which reflects gathers
                      ///< in a layer thinner than a step, where it is above step_error; else 0
    double gathered_top;    ///< of it at the top
    char weight_words[160]; ///< of a column of weights in points, which nothing reads; else ""
    char points_words[CLAST_POINTS_WORDS]; ///< of clast_evolve_run: what else of the file of points
                                           ///< is not looked at (clast_evolve_source); else ""
    bool is_field_apart; ///< no body starts within the field's grid, or that is 1000 times as wide
    double mass_balance; ///< greatest |sum - start| / start of all rows
    int64_t number_balance; ///< greatest |particles + events + deposit + out - start| of all rows
    int64_t n_cut, n_test;  ///< times that cells were cut, that the tests were made
    int64_t n_unresolved;   ///< of those cuts: neither cells nor pairs resolve the cloud, meetings
                            ///< are then a best guess, rather too few; 0 for one cell (even: whole)
    int64_t grains_most;    ///< of one aggregate, wherever it is
    double deposit_diameter, deposit_porosity, deposit_speed, deposit_grains; ///< means by mass
    double volume_fraction; ///< of the particles' own volumes at the start in the domain; kernels
                            ///< are of dilute suspensions
    double fall_reynolds; ///< greatest of all bodies; the drag law holds up to 3e5, Stokes' to 0.1
    double fall_reynolds_limit;              ///< that of the run's own law
    double fractal_dimension, fractal_error; ///< of aggregates that events made; NAN
    clast_range_use range;                   ///< collisions against the kernels' ranges
    uint64_t hash;                           ///< of the whole state
    double wall_s;
    int32_t n_frame, n_written;   ///< files written
    double bed_width, bed_height; ///< of the column in deposit.h5 [m]; 0: not written
    bool is_bed_empty;            ///< a bed was asked for, and nothing lies on the floor
    double bed_mass;              ///< of its bodies, each once, whatever it stands for [kg]
    double bed_least;             ///< radius of the sphere as large as the smallest of them [m]
    char *folder;                 ///< where the run lies; NULL: nowhere
} clast_evolve_result;

/// The numbers now.
CLAST_API clast_status clast_evolve_measure(const clast_evolve *evolve,
                                            clast_evolve_result *result);
CLAST_API void clast_evolve_result_free(clast_evolve_result *result); ///< may be called twice

/// As one JSON object under the names of DESIGN section 7; free the text with clast_text_free.
///
/// @param times  with the clock (wall_s), which differs from run to run
CLAST_API clast_status clast_evolve_result_json(const clast_evolve_result *result, bool times,
                                                char **text);

/// Tables of an evolution.
typedef enum {
    CLAST_EVOLVE_BALANCE,   ///< a row a time: numbers and masses of cloud, deposit and gone, means
    CLAST_EVOLVE_SPECTRUM,  ///< a row a time and class of grain numbers, doubling
    CLAST_EVOLVE_EVENTS,    ///< a row an event: the pair, what it became, where and how they touch
    CLAST_EVOLVE_DEPOSIT,   ///< a row a body on the floor, by time
    CLAST_EVOLVE_PARTICLES, ///< a row a body in the fluid now
    CLAST_N_EVOLVE_TABLE
} clast_evolve_table_kind;

/// One of the tables. `table` must be empty.
CLAST_API clast_status clast_evolve_table(const clast_evolve *evolve, clast_evolve_table_kind kind,
                                          clast_table *table);

/// The grains of the body that is this node of the tree of events, about its centre of mass, with
/// their contacts: particles at the start are nodes 0 .. n - 1, event k made node n + k.
///
/// @return CLAST_E_USAGE for a node that is none, or has become part of another; CLAST_E_CONFIG
/// without structure
CLAST_API clast_status clast_evolve_aggregate(const clast_evolve *evolve, int64_t node,
                                              clast_assembly *assembly);

/// Nodes of the bodies of most grains first, of equal ones the older first: [*n] of at most *n.
///
/// @param n  in: capacity of `node`; out: how many
CLAST_API clast_status clast_evolve_largest(const clast_evolve *evolve, int32_t *n, int64_t *node);

/// All grains where they are, in the fluid and on the floor.
///
/// @param values  NULL, or empty: of each of them the node of its body, whether it lies on the
/// floor (1), and the body's grains, envelope, porosity, speed of falling and mass
CLAST_API clast_status clast_evolve_assembly(const clast_evolve *evolve, clast_assembly *assembly,
                                             clast_table *values);

enum { CLAST_N_EVOLVE_SAVED = 7 };

/// All that is needed to go on, as tables: clast_state keeps them. `table` must be empty.
CLAST_API clast_status clast_evolve_save(const clast_evolve *evolve,
                                         clast_table table[CLAST_N_EVOLVE_SAVED]);

/// Goes on from there to the same bits; `evolve` was just created from the same configuration.
///
/// @return CLAST_E_FORMAT when the tables do not belong to it; it can then only be destroyed
CLAST_API clast_status clast_evolve_restore(const clast_table table[CLAST_N_EVOLVE_SAVED],
                                            clast_evolve *evolve);

/// What a configuration names, loaded. Owns what `input` points to.
typedef struct clast_evolve_source {
    clast_assembly *shape; ///< [n_shape]
    int32_t n_shape;
    clast_grading *grading;
    clast_domain domain, release;
    clast_cloud points, field;
    clast_evolve_input input;
    char points_words[CLAST_POINTS_WORDS]; ///< of the file of points: a column of sizes that
                                           ///< nothing reads, which of its snapshots; else ""
} clast_evolve_source;

/// @return the reader's status and line, with the option before it
CLAST_API clast_status clast_evolve_load(const clast_evolve_config *config,
                                         clast_evolve_source *source);
CLAST_API void clast_evolve_unload(clast_evolve_source *source); ///< may be called twice

/// Follows the cloud to its end; with a folder writes tables, states, charts, manifest and summary
/// into it, and checkpoints on the way.
///
/// @param folder  NULL for no files    @param monitor  may be NULL
/// @return CLAST_E_STOPPED when the monitor asked: a checkpoint is written
CLAST_API clast_status clast_evolve_run(const clast_evolve_config *config, const char *folder,
                                        const clast_monitor *monitor, clast_evolve_result *result);

/// Goes on from the newest checkpoint of a folder; ends in the same bytes.
CLAST_API clast_status clast_evolve_resume(const char *folder, const clast_monitor *monitor,
                                           clast_evolve_result *result);

CLAST_END
