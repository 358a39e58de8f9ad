#pragma once
// What a simulation holds, in records that a contact reads in as few cache lines as it can.
//
// A grain is one body. Contacts are between items: the grain itself, or each sphere of a clump.
// Items of a grain stand together and in its order; without clumps item i is grain i and `item` is
// NULL.
//
// A pair of items lies in the neighbour list of its lower item `a` (half list), sorted by `b`;
// walls are items -1, -2, ... The record stays as long as the pair is listed, and with it the
// contact's history and warm start.
#include "base/parallel.h"
#include "base/status.h"
#include "convex/convex.h"
#include "convex/wall_mesh.h"
#include "dem/law.h"
#include "math/vec3.h"
#include <assert.h>
#include <clast/dem.h>

/// What contacts read of a grain: 192 bytes, in groups of four doubles, one vector load each.
typedef struct clx_grain {
    double position[3];
    double radius; ///< of the bounding sphere
    double velocity[3];
    double mass;
    double omega[3]; ///< angular velocity, world axes [rad/s]
    double scale;
    double turn[3][3];   ///< rotation matrix, world = turn body
    double round_radius; ///< of the sphere of equal volume: R of Hertz's law
    int32_t shape;
    int32_t kind; ///< clast_shape_kind
    double held;  ///< exact steps: sum of its contacts' stability loads in the last step
} clx_grain;

/// What only the integration reads.
typedef struct clx_motion {
    double orientation[4];
    double angular[3];     ///< angular momentum, world axes; not kept up for spheres
    double inverse_factor; ///< 1 / inertia_factor
    double inertia_factor; ///< moments of this grain over those of its shape at unit density
    double volume;
    double density;
    double drag[2]; ///< Stokes' and Newton's corrections of Ganser's law
} clx_motion;

/// Where an item was when its neighbours were last searched.
typedef struct clx_anchor {
    double position[3];
    double orientation[4];
    double margin; ///< half its skin: how far it may move before its neighbours are searched again
} clx_anchor;

/// A sphere of a clump, a part of a rigid grain, or a whole grain.
typedef struct clx_item {
    double position[3];
    double radius;
    double local[3]; ///< centre in the grain's frame, scaled
    int32_t grain;
    int32_t part; ///< sphere of the clump or rigid grain; -1: the grain's own shape; -2 - k: its
                  ///< k-th part, which is no sphere
} clx_item;

/// Two items near each other: 48 bytes.
typedef struct clx_dem_pair {
    int32_t a, b;         ///< b > a, or -1 - wall
    int16_t period[2];    ///< b's image: position + n * width; the low 16 bits of n
    uint32_t touches : 1; ///< in the last step
    uint32_t kind : 2;    ///< clx_facet_kind of its warm start
    uint32_t slot : 29;   ///< index of its warm start in the list; 0: it has none
    double active_from;   ///< it cannot touch while travel a + travel b is less
    double slide[3];      ///< tangential displacement of b over a
} clx_dem_pair;

/// Contact history of some laws, beside the tangential displacement.
typedef struct clx_contact_history {
    double roll[3];     ///< torque of the rolling spring on b
    double restitution; ///< of its impact in a fluid; 0: it has not begun
} clx_contact_history;

/// A pair's warm start, from which the contact search begins: three cache lines, of which two hold
/// a face with a vertex.
typedef struct clx_warm_start_slot {
    clx_warm_start record;
    double spare[6];
} clx_warm_start_slot;

/// Two numbers of periods with the same low 16 bits differ by a multiple of this; the offset, known
/// to within a period, decides (clx_pair_offset).
#define CLX_PERIOD_TURN 65536.0
#define CLX_TO_WHOLE    0x1.8p52 ///< added and taken off again: rounds to a whole number

enum { CLX_MOST_SLOTS = (1 << 29) - 1 };

/// A pair and its warm start in three cache lines, for a sweep.
typedef struct clx_packed_pair {
    clx_dem_pair pair; ///< first, so that a pointer to it is one to the pair
    clx_warm_start warm_start;
} clx_packed_pair;
static_assert(sizeof(clx_packed_pair) == 192, "a pair takes three lines");

/// Accumulator of force and torque on a grain: two vectors of four doubles.
typedef struct clx_force_torque {
    double force[4];  ///< the fourth is 0
    double torque[4]; ///< the fourth is 0; with exact steps the grain's stability load
} clx_force_torque;

/// Contact force and torques of a pair.
typedef struct clx_pair_force {
    double force[4];    ///< the fourth is 0
    double torque_b[4]; ///< the fourth is 0; with exact steps the contact's stability load on b
    double torque_a[4]; ///< to be subtracted from the sum of a
} clx_pair_force;

/// A pair that may touch in this step, and its index among those that were given.
typedef struct clx_active_pair {
    const clx_dem_pair *pair;
    int64_t at;
} clx_active_pair;

/// What a block of items has in the inner list.
typedef struct clx_inner_block {
    int32_t n;
    bool needs_warm_start; ///< some pair has no warm start yet and needs one
} clx_inner_block;

/// How many packed pairs ahead are prefetched.
enum { CLX_PREFETCH_PAIRS = 12 };

/// Copies of pairs in the order of their numbers in the neighbour list.
typedef struct clx_packed_row {
    int32_t n;
    int32_t *index;          ///< [n] rising
    int32_t *begin;          ///< [n_item + 1]
    clx_packed_pair *packed; ///< [n]
    int64_t capacity, item_capacity, packed_capacity;
} clx_packed_row;

/// The inner list: the pairs of the neighbour list that may touch before some grain's path exceeds
/// its `until`. A step reads these alone.
typedef struct clx_inner_list {
    int32_t n;
    int32_t *index;          ///< [n] rising
    clx_pair_force *force;   ///< [n] of the last step, unless that was a sweep
    int32_t *begin;          ///< [n_item + 1] first of each item's own
    int32_t *in_begin;       ///< [n_grain + 2] first of the pairs whose b a grain is
    int32_t *in;             ///< [n] their numbers, rising
    double *until;           ///< [n_grain]
    clx_force_torque *total; ///< [n_grain] sums of a sweep so far; 0 between steps
    int64_t capacity, force_capacity, in_capacity, item_capacity, grain_capacity, until_capacity;
    clx_inner_block *block;
    clx_packed_pair *packed; ///< [n + CLX_PREFETCH_PAIRS], the last all 0, while is_packed: the
                             ///< pairs and warm starts of the list are out of date
    clx_packed_row old;      ///< the copies before, while the list is found anew
    int64_t total_capacity, block_capacity, packed_capacity;
    bool is_due;
    bool is_packed;
    bool is_gathered; ///< `in` is there
} clx_inner_list;

struct clx_chunk;
struct clx_pace;

/// How a sweep is divided among threads (chunk.c), and contributions to deferred grains (sweep.c).
typedef struct clx_sweeping {
    int32_t n_worker; ///< 0: its work is to be counted anew
    _Atomic int32_t n_chunk;
    struct clx_chunk *chunk; ///< [n_chunk], first the threads' own, then what others stole
    struct clx_pace *pace;   ///< [n_worker]
    int64_t *before;         ///< [blocks + 1] work of all blocks of grains before
    _Atomic int32_t *lowest; ///< [groups of four grains] least grain in a pair with one of them
    int32_t most;            ///< pairs of a block of grains
    clx_pair_force *force;   ///< [n_worker][most] of the block that a worker is at
    clx_active_pair *active; ///< [n_worker][most] its active pairs
    int32_t *deferred;       ///< [n_deferred] first grains of the groups of four that move last
    int32_t n_deferred;
    clx_force_torque *contribution; ///< [n of inner + n_grain] forces and torques on them
    int32_t *contribution_to;       ///< grain of each
    int64_t chunk_capacity, pace_capacity, before_capacity, lowest_capacity, deferred_capacity;
    int64_t force_capacity, active_capacity, contribution_capacity[2];
} clx_sweeping;

/// Volume of grains by height, for the porosity around one.
typedef struct clx_slabs {
    double *solid; ///< [n] [m3]
    int64_t capacity;
    int32_t n;
    double low, thick, volume; ///< of the first slab's bottom; of a slab
} clx_slabs;

typedef enum { CLX_WALL_PLANE, CLX_WALL_CYLINDER } clx_wall_kind;

typedef struct clx_wall {
    clx_wall_kind kind;
    double normal[3]; ///< into the domain
    double offset;    ///< plane: n.x of its points
    double radius;    ///< cylinder about the z axis
} clx_wall;

/// Grains of a block, the unit of work of a thread: of the motion, of a sweep.
enum { CLX_MAX_WALL = 8, CLX_MOVE_BLOCK = 256, CLX_SWEEP_BLOCK = 48 };

/// A convex part of a rigid grain, at scale 1.
typedef struct clx_dem_part {
    clx_hull_core *core; ///< about its centroid; NULL: a sphere or ellipsoid
    double semi_axes[3];
    double turn[3][3]; ///< of the ellipsoid's axes in the grain's frame
    double centre[3];
    double radius; ///< bounding radius about its centre
    double round_radius;
    bool is_sphere;
} clx_dem_part;

/// A shape and what mechanics needs of it.
typedef struct clx_dem_body {
    clast_shape shape;
    double bounding_radius;       ///< radius of a ball about the centre of mass that holds it
    double inertia[3][3];         ///< about the centre of mass, at mean density 1 and scale 1
    double inverse_inertia[3][3]; ///< of that
    clx_hull_core *core;          ///< of a mesh, else NULL
    double steiner[2]; ///< of a mesh: area, and its mean curvature integrated over the surface
    bool is_round;     ///< sphere: its turn does not matter
    int32_t n_part;
    clx_dem_part *part; ///< [n_part] of a rigid grain
} clx_dem_body;

/// Share of what is left of a margin that an item's path may use before its margin is checked
/// again. What it has moved grows by at most 1.05 times its path (2.1 |dq| for the angle), so that
/// the step in which a margin is used up is found whenever it was checked before: a resumed run
/// refreshes in the same steps.
#define CLX_SURE 0.94

enum { CLX_MAX_LEVEL = 24 };

typedef struct clx_cell {
    int32_t at[3];
    int32_t level;
    uint32_t bucket;
} clx_cell;

/// Cells over the anchors, one set a size level, in one hash table.
typedef struct clx_dem_grid {
    int32_t n_level;
    double cutoff[CLX_MAX_LEVEL];     ///< largest radius and margin of a level's items; 0: empty
    double inverse[CLX_MAX_LEVEL][3]; ///< cells a metre
    int32_t n_cell[CLX_MAX_LEVEL][3]; ///< around a period, else 0
    int32_t capacity;
    uint32_t n_bucket; ///< a power of two
    clx_cell *cell;    ///< [n_item]
    int32_t *bucket;   ///< [n_bucket + 2] first entry of each
    int32_t *entry;    ///< [n_item] items by bucket
    int32_t *by_level; ///< [n_item] items by level
    int32_t level_begin[CLX_MAX_LEVEL + 1];
} clx_dem_grid;

/// A pair that a refresh found.
typedef struct clx_found {
    int32_t a, b;
    int16_t period[2]; ///< low bits
} clx_found;

/// Neighbour lists and what their upkeep needs.
typedef struct clx_neighbour_list {
    clx_dem_pair *pair;  ///< [n_pair] sorted by a, b
    clx_dem_pair *other; ///< the buffer that the next refresh fills
    int64_t n_pair, capacity, other_capacity;
    clx_contact_history *history;       ///< [n_pair] where the law has them (has_history)
    clx_contact_history *other_history; ///< of the buffer
    int64_t history_capacity, other_history_capacity;
    clx_warm_start_slot *warm_start; ///< [n_slot] the first is not in use
    int64_t n_slot, slot_capacity;
    int32_t *free_slot; ///< [n_free]
    int64_t n_free, free_capacity;
    int64_t *begin;     ///< [n_item + 1] first pair of each item
    clx_anchor *anchor; ///< [n_item]
    double *limit;      ///< [n_item] below this travel an item is surely within its margin
    uint8_t *is_stale;  ///< [n_item] its neighbours are searched in this refresh
    int64_t item_capacity;
    int32_t *triangle; ///< triangles of the container about one item
    int64_t triangle_capacity;
    clx_dem_grid grid;
    clx_found *found, *sorted; ///< [n_found] as found; by a and b
    int64_t n_found, found_capacity, sorted_capacity;
    int64_t *found_begin; ///< [n_item + 1]
    int32_t n_known;      ///< items that have anchors
    int64_t n_refresh;
    bool is_due; ///< some item has used up its margin
} clx_neighbour_list;

struct clast_dem {
    clast_dem_config config;
    clast_dem_drive drive;
    clx_law law;
    int64_t step;
    double stride; ///< share of its radius that a grain may move in a step: clx_law_speed, greatest
    int32_t n_wall;
    clx_wall wall[CLX_MAX_WALL];
    double period[2];         ///< widths of a periodic domain, else 0
    double inverse_period[2]; ///< 1 over them, else 0
    clx_wall_mesh *container; ///< or NULL; its triangle t is item -1 - n_wall - t
    int32_t n_body;
    clx_dem_body *body; ///< [n_body]
    bool has_items;     ///< some shape is a clump or rigid grain: items are not grains
    bool has_parts;     ///< some shape is a rigid grain: items have turns of their own
    bool all_round;     ///< every item is a sphere
    int32_t n_grain;
    int32_t n_started; ///< grains that were checked for overlaps with those added beside them
    int64_t grain_capacity;
    clx_grain *grain;   ///< [n_grain]
    clx_motion *motion; ///< [n_grain]
    double *travel;     ///< [n_grain] path of the surface's fastest point, at most
    int32_t n_item;
    clx_item *item;            ///< [n_item] or NULL without clumps
    int32_t *item_begin;       ///< [n_grain + 1] or NULL without clumps
    clx_convex *convex;        ///< [n_item], or NULL while all items are spheres
    double (*item_turn)[3][3]; ///< [n_item] rotation matrices, or NULL without rigid grains
    uint8_t *block_flag; ///< [blocks of CLX_SWEEP_BLOCK grains, at most] clx_move_flag of each
    clx_neighbour_list list;
    clx_inner_list inner;
    clx_sweeping sweeping;
    clx_slabs slabs;                 ///< solids by height, with hindrance
    clast_dem_verification verified; ///< in all steps so far
};

static inline int32_t clx_item_grain(const clast_dem *dem, int32_t i)
{
    return dem->item != NULL ? dem->item[i].grain : i;
}

static inline const double *clx_item_position(const clast_dem *dem, int32_t i)
{
    return dem->item != NULL ? dem->item[i].position : dem->grain[i].position;
}

static inline double clx_item_radius(const clast_dem *dem, int32_t i)
{
    return dem->item != NULL ? dem->item[i].radius : dem->grain[i].radius;
}

/// Whether an item's contacts depend on its turn.
static inline bool clx_item_is_round(const clast_dem *dem, int32_t i)
{
    return dem->item != NULL && dem->item[i].part != -1
               ? dem->item[i].part >= 0
               : dem->grain[clx_item_grain(dem, i)].kind == CLAST_SHAPE_SPHERE;
}

/// The part of a rigid grain that an item is, or NULL.
static inline const clx_dem_part *clx_item_part(const clast_dem *dem, int32_t i)
{
    const clx_dem_body *body = &dem->body[dem->grain[clx_item_grain(dem, i)].shape];
    if (body->n_part == 0) {
        return NULL;
    }
    const int32_t k = dem->item[i].part;
    return &body->part[k >= 0 ? k : -2 - k];
}

/// Rotation matrix of an item's own axes [9].
static inline const double *clx_item_turn(const clast_dem *dem, int32_t i)
{
    return dem->item_turn != NULL ? dem->item_turn[i][0]
                                  : dem->grain[clx_item_grain(dem, i)].turn[0];
}

/// The warm start of a pair, or NULL.
static inline clx_warm_start *clx_pair_warm_start(const clast_dem *dem, const clx_dem_pair *pair)
{
    return pair->slot != 0 ? &dem->list.warm_start[pair->slot].record : NULL;
}

/// Pair k of the inner list, where it is up to date.
static inline clx_dem_pair *clx_inner_pair(const clast_dem *dem, int32_t k)
{
    return dem->inner.is_packed ? &dem->inner.packed[k].pair : &dem->list.pair[dem->inner.index[k]];
}

/// The warm start of a pair of the inner list, or NULL.
static inline clx_warm_start *clx_inner_warm_start(const clast_dem *dem, clx_dem_pair *pair)
{
    if (!dem->inner.is_packed) {
        return clx_pair_warm_start(dem, pair);
    }
    return pair->slot != 0 ? &((clx_packed_pair *)(void *)pair)->warm_start : NULL;
}

/// Whether a pair's contact has a closed form: both are spheres, or a sphere and a wall.
static inline bool clx_pair_is_round(const clast_dem *dem, const clx_dem_pair *pair)
{
    return dem->all_round ||
           (clx_item_is_round(dem, pair->a) && (pair->b < 0 || clx_item_is_round(dem, pair->b)));
}

/// Checks sizes and time step of a configuration.
clast_status clx_dem_check(const clast_dem_config *config);

/// Refuses a time step that does not resolve the contact of a grain like this.
clast_status clx_dem_check_step(const clx_law *law, double time_step, double mass, double radius);

void clx_body_free(clx_dem_body *body);

/// Area and integrated mean curvature of a body's core.
void clx_rounding_prepare(clx_dem_body *body);

/// Factor on the lengths of a body that keeps its volume when it then grows by `margin`, both at
/// scale 1. The margin is less than the ball inside.
double clx_rounding_factor(const clx_dem_body *body, double margin);

/// Grain i anew, as given; its slot exists.
void clx_dem_set_grain(clast_dem *dem, int32_t i, const clast_dem_grain *from);

/// Capacity for the items of n more grains; then items of the grain g, which is set.
clast_status clx_items_reserve(clast_dem *dem, int32_t n, const clast_dem_grain *grain);
void clx_items_add(clast_dem *dem, int32_t g);

/// Items of grain g where it is now.
void clx_items_place(clast_dem *dem, int32_t g);

/// From a grain's centre of mass, which mechanics moves, to the centre of its volume.
void clx_dem_arm(const clast_dem *dem, const clx_grain *g, double arm[3]);
clast_status clx_items_begin_convex(clast_dem *dem);

/// Walls and periods of the domain.
void clx_dem_build_walls(clast_dem *dem);

/// Signed distance of a point from a wall, > 0 inside; the wall's normal there, into the domain.
double clx_wall_distance(const clx_wall *wall, const double x[3], double normal[3]);

/// Brings the lists up to date for the items that have used half of their margin.
clast_status clx_neighbour_list_refresh(clast_dem *dem);
void clx_neighbour_list_free(clx_neighbour_list *list);

/// A slot for a pair's warm start, which begins empty.
clast_status clx_neighbour_list_assign_slot(clx_neighbour_list *list, clx_dem_pair *pair);

/// Capacity for n items; new ones are stale.
clast_status clx_neighbour_list_reserve(clx_neighbour_list *list, int64_t n_item);

/// Finds the pairs that may touch soon, and assigns warm starts to those that need one.
clast_status clx_inner_find(clast_dem *dem);
void clx_inner_free(clx_inner_list *inner);

/// Copies the inner list's pairs and warm starts into one array in order, and back to the list.
clast_status clx_inner_pack(clast_dem *dem);
void clx_inner_unpack(clast_dem *dem);

/// Which pairs have each grain as b, and capacity for the forces of all pairs (inner.force).
clast_status clx_inner_gather(clast_dem *dem);

void clx_sweeping_free(clx_sweeping *sweeping);

/// Whether one thread does all the work: there is no other, or too few grains for the threads'
/// synchronisation to pay.
bool clx_dem_is_serial(const clast_dem *dem);

/// clx_parallel_for, or the same blocks in this thread where that is as fast.
void clx_dem_for(const clast_dem *dem, int64_t n, int64_t block, clx_kernel kernel, void *context);

/// All pair forces (inner.force); contact histories and warm starts are renewed.
void clx_contacts(clast_dem *dem);

/// The same for pairs [begin, end) of the inner list: lists the active ones, by rising index
/// counted from `begin`, and writes their forces at those indices. Both arrays have capacity for
/// all. Returns how many are active; nothing is written for skipped pairs.
int32_t clx_contacts_among(clast_dem *dem, int32_t begin, int32_t end, clx_pair_force *force,
                           clx_active_pair *active);

/// Compares the contacts that clx_contacts has just found with ones found without warm start.
void clx_verify(clast_dem *dem);

/// How far an item's surface may have moved since its neighbours were searched.
static inline double clx_item_moved(const clast_dem *dem, int32_t i)
{
    const clx_anchor *at = &dem->list.anchor[i];
    const double shifted = sqrt(v3_distance2(clx_item_position(dem, i), at->position));
    if (clx_item_is_round(dem, i)) {
        return shifted;
    }
    const double *q = dem->motion[clx_item_grain(dem, i)].orientation;
    double s = 0.0;
    for (int k = 0; k < 4; ++k) {
        s += (q[k] - at->orientation[k]) * (q[k] - at->orientation[k]);
    }
    // the angle is 4 asin(|dq| / 2) <= 2.1 |dq| up to 60 degrees
    return shifted + 2.1 * sqrt(s) * clx_item_radius(dem, i);
}

/// Simulated time [s].
static inline double clx_dem_time(const clast_dem *dem)
{
    return (double)dem->step * dem->config.time_step;
}

/// Sums pair forces; velocities, positions and orientations one step on. True when no grain moved
/// farther than its stride.
bool clx_move(clast_dem *dem);

/// Contacts and motion of whole grains in one sweep: the bits of clx_contacts and clx_move.
/// *is_fine as clx_move.
clast_status clx_sweep(clast_dem *dem, bool *is_fine);

/// Contacts that the pair of bodies of a touching pair had in the last step.
int32_t clx_sub_contacts(const clast_dem *dem, const clx_dem_pair *pair);

/// A kernel over grains: sub-contacts of clumps share their pair's stiffness.
void clx_share_forces(int64_t begin, int64_t end, int32_t worker, void *context);

/// Refuses grains that overlap others added since the last step by so much that
/// they would fly apart faster than a run may go.
clast_status clx_check_starts(clast_dem *dem);

/// Says what exploded. Returns CLAST_E_CONVERGE.
clast_status clx_explain_explosion(const clast_dem *dem);

/// Contacts of each grain, with grains and walls, as clast_dem_measure counts them.
void clx_count_contacts(const clast_dem *dem, int32_t *count);
