#pragma once
// The inside of an evolution, from the bottom up: rows (rows.c), a user's field (flow.c), bodies
// and what follows from their grains (body.c), contacts of which each is as likely (react.c), two
// that become one (join.c), who meets (meet.c), cells (cells.c), walls that are no box's (walls.c),
// motion (move.c), how long a step may be (pace.c), steps (evolve.c), what is told (tables.c,
// measure.c), what is kept (saved.c). Calls go down only.
#include "aggregate/template.h"
#include "evolve/flow.h"
#include "evolve/rows.h"
#include "math/rng.h"
#include <clast/evolve.h>
#include <clast/shape.h>
#include <clast/workspace.h>
#include <math.h>

/// A kind of particle as it is at scale 1, from a template.
typedef struct clx_evolve_kind {
    double second[6]; ///< integral of x x^T over the mass, by the mass: xx, yy, zz, yz, xz, xy
    double form[3];   ///< L, I, S of a single shape; 0 of a group
    double volume, mass, bounding_radius;
} clx_evolve_kind;

/// A particle of the start, for ever: what it is, and where it sits in the body it is part of.
typedef struct clx_evolve_grain {
    int32_t kind; ///< template 1 + kind
    int32_t next; ///< grain of the same body, -1 ends it
    double scale;
    double position[3];    ///< relative to the body's centre of mass
    double orientation[4]; ///< unit quaternion
} clx_evolve_grain;

/// A sum with the rounding that it lost.                                            [Neumaier1974]
typedef struct clx_sum {
    double sum, lost;
} clx_sum;

static inline void clx_sum_add(clx_sum *s, double value)
{
    const double t = s->sum + value;
    s->lost += fabs(s->sum) >= fabs(value) ? (s->sum - t) + value : (value - t) + s->sum;
    s->sum = t;
}

static inline double clx_sum_of(const clx_sum *s)
{
    return s->sum + s->lost;
}

typedef enum {
    CLX_BODY_IN_FLUID,
    CLX_BODY_ON_FLOOR,
    CLX_BODY_OUT,   ///< left by the top
    CLX_BODY_MERGED ///< part of another
} clx_body_state;

/// A particle or aggregate.
typedef struct clx_evolve_body {
    int32_t first, last, n; ///< its grains
    int32_t state;          ///< clx_body_state
    int64_t node;           ///< of the tree of events
    double x[3];            ///< centre of mass; where it came to the floor or left
    double time;            ///< when it came to be in this state
    double mass, volume;    ///< of one real particle, solid
    double second[6];       ///< as of a kind, in the frame of its grains
    double bounding_radius; ///< greatest distance of its surface from the centre of mass
    double envelope;    ///< volume of the solid ellipsoid of equal moments, not below the solid's
    double gyration;    ///< radius of
    double radius;      ///< that kernels see
    double speed;       ///< of falling
    double diffusivity; ///< Brownian and turbulent
} clx_evolve_body;

/// Two bodies that became one: a node of the tree.
typedef struct clx_evolve_event {
    double time;
    int64_t node[2];    ///< of the larger and of the smaller
    int32_t body;       ///< that lives on
    int32_t n;          ///< grains then
    int32_t contact[2]; ///< grains that touch, of the larger and of the smaller; -1 of drops
    double point[3];    ///< where, in the frame of the first of them
    double x[3];        ///< centre of mass then
    double mass, gyration, envelope, speed;
} clx_evolve_event;

enum {
    CLX_LEG_STEPS = 16,   ///< and from a count of pairs to the next
    CLX_N_CUTS_COLUMN = 4 ///< call, x, y, z
};
extern const char *const clx_cuts_column[CLX_N_CUTS_COLUMN][2];

/// Where bodies count as even, for the step now: those of cell c are order[start[c]..].
typedef struct clx_evolve_cells {
    int32_t n;
    const double *volume; ///< [n] the workspace's; NULL: one, the whole domain
    double share;         ///< of it in which pairs meet
} clx_evolve_cells;

struct clast_evolve {
    const clast_evolve_config *config; ///< borrowed
    const clast_evolve_input *input;   ///< borrowed
    clast_collide_config collide;      ///< kernel's mask and medium in full
    uint32_t ranges;                   ///< rows of the table of ranges that collisions are held to
    double wind[3];                    ///< at z = 0
    clx_flow flow;                     ///< of the user, on a grid
    int32_t meeting;                   ///< AUTO already resolved
    clx_templates templates;
    clx_evolve_kind *kind; ///< [n_kind]
    int32_t n_kind;

    int32_t n_start;
    clx_evolve_grain *grain; ///< [n_start]
    clx_evolve_body *body;   ///< [n_start] the larger of a pair lives on in its place
    int64_t n_event, event_capacity;
    clx_evolve_event *event; ///< [n_event]

    clast_workspace *workspace;
    clast_decompose_config decompose; ///< of the cells
    bool has_decompose;
    int32_t n_live;
    int32_t *live;   ///< [n_live] bodies in the fluid, rising
    double (*at)[3]; ///< [n_live] where
    int32_t *order;  ///< [n_start] scratch: bodies by cell
    int64_t *start;  ///< [cells + 1] scratch
    int64_t start_capacity;
    int32_t n_cell; ///< last
    clx_evolve_cells cells;
    int32_t leg_step; ///< steps of this leg
    bool is_in_leg;   ///< the workspace has the leg's cells
    clx_rows cuts;    ///< positions at the calls of this leg from which its cells follow
    const clast_monitor *monitor; ///< looked at on the way; borrowed for a leg, or NULL

    double time;
    uint64_t step;
    int32_t row; ///< rows written after the first
    double rate; ///< collisions a particle and time: in the last step, or expected; 0: not known
    int64_t n_cut, n_test, n_unresolved;
    double pair_share; ///< volume in which pairs met at the last count of pairs of all distances,
                       ///< over that of their cell; 1: of one even cell, 0: none stands
    int32_t pair_resolved, pair_n; ///< whether it resolved the cloud; particles then
    uint64_t pair_step;            ///< when
    double mass_start;             ///< of all real particles
    double gathered, gathered_top; ///< shares of it, as in the result
    bool is_field_apart;           ///< as in the result
    double mass_error;             ///< greatest, relative
    int64_t number_error;
    clast_range_use range;
    clx_rows balance, spectrum;
};

/// body.c: kinds of the templates; what follows from a body's mass, volume, moments and reach.
clast_status clx_evolve_kinds(clast_evolve *e);
void clx_evolve_update(const clast_evolve *e, clx_evolve_body *body);

/// A particle of the start as a body of its own.
void clx_evolve_single(const clast_evolve *e, int32_t i, clx_evolve_body *body);

/// Lists the bodies in the fluid, and where they are.
void clx_evolve_list(clast_evolve *e);

/// Velocity of the fluid at a height.
void clx_evolve_wind(const clast_evolve *e, double z, double velocity[3]);

typedef struct clx_touch_scene clx_touch_scene;
typedef struct clx_placement clx_placement;

/// react.c: one of all the ways in which a group can touch a scene without overlap, each as likely.
///
/// @return CLAST_E_CONVERGE where other parts overlap at all of `tries` contacts
clast_status clx_evolve_react(const clast_evolve *e, const clx_touch_scene *scene,
                              const clx_template *group, int32_t tries, clx_placement *placement);

/// join.c: lets two bodies in the fluid become one; `i` or `j`, the larger, lives on.
clast_status clx_evolve_join(clast_evolve *e, int32_t i, int32_t j, double time, clx_rng *rng);

/// meet.c: lets the bodies of a cell meet for a time dt.
clast_status clx_evolve_meet(clast_evolve *e, int32_t *member, int64_t n, double volume, double dt,
                             clx_rng *rng);

/// meet.c: how many of the bodies of a cell are expected to join a time, by as many of its pairs
/// drawn at random.
double clx_evolve_joints(const clast_evolve *e, const int32_t *member, int64_t n, double volume,
                         clx_rng *rng);

/// cells.c: forgets the cells of the leg before and says how the next ones show their pairs, by the
/// saved state alone; in the middle of a leg, cells as they were.
clast_status clx_evolve_begin_leg(clast_evolve *e);
void clx_evolve_end_leg(clast_evolve *e);

/// Cells on the positions now; with fewer than two bodies there are none.
clast_status clx_evolve_find_cells(clast_evolve *e);

/// Where no meeting in the step before tells a rate: that which the pairs in the cells let expect.
clast_status clx_evolve_find_rate(clast_evolve *e);

/// All meetings of a step, cell by cell, in the order of time.
clast_status clx_evolve_meet_all(clast_evolve *e, double dt);

/// pace.c: how long the next step may be. The mean particle meets, and the mean mass moves up or
/// down and spreads, by a share step_error of one and of the height; where sides are not periodic
/// it moves along x and y by that share of the domain's extent, where they keep what meets them it
/// spreads by that of the width. By as much a field changes the density about it. Ends at the next
/// row.
double clx_evolve_step_of(const clast_evolve *e);

/// Refuses a time_step in which the mean mass comes onto the floor or the sides, or out of the top,
/// from wherever it is, and meets nobody.
clast_status clx_evolve_check_time_step(const clast_evolve *e);

/// Refuses a wind that carries more than a share step_error of the mass into sides, a floor or a
/// top that reflect, where it gathers in a layer (diffusivity over speed) thinner than a step moves
/// it: what meets there would be what steps are. What falls onto such a floor, or rises to such a
/// top without a wind, is told (`gathered`). A field is taken as it is: it may turn the mass aside
/// before.
clast_status clx_evolve_check_mirrors(clast_evolve *e);

/// Whether no body starts within the grid of a field, or it is 1000 times as wide as the domain:
/// one of the two is in another unit.
bool clx_evolve_is_field_apart(const clast_evolve *e);

/// move.c: every body in the fluid for a time dt, onto the floor too.
///
/// @return CLAST_E_LIMIT where a body needs more than a million parts of it
clast_status clx_evolve_move(clast_evolve *e, double dt);

/// Least width of a domain: the sphere of this diameter fits between its walls, and in a periodic
/// box no part of it meets its own image; of a surface that of its box, which is no less [m];
/// INFINITY: of a caller's map it is not known.
double clx_evolve_least_width(const clast_domain *domain);

/// Least distance between walls that keep or lose what meets them, but for the floor of a box alone
/// [m]; INFINITY: none such.
double clx_evolve_width(const clast_evolve *e);

/// series.c: one row of the balance, and of the spectrum's classes, as things are.
clast_status clx_evolve_write_row(clast_evolve *e);
clast_status clx_evolve_series_begin(clast_evolve *e);

/// D of ln R_g = ln(N) / D + c over the aggregates of 10 grains or more that events have made, N by
/// mass; its error from their scatter. NAN with fewer than 30.
void clx_evolve_fractal(const clast_evolve *e, double *dimension, double *error);
