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
#include "convex/wall_mesh.h"
#include "dem/body.h"
#include "dem/cell.h"
#include "dem/inner_list.h"
#include "dem/law.h"
#include "dem/neighbour_list.h"
#include "dem/sweep.h"
#include "dem/wall.h"
#include "math/vec3.h"
#include <clast/dem.h>

/// Volume of grains by height, for the porosity around one.
typedef struct clx_slabs {
    double *solid; ///< [n] [m^3]
    int64_t capacity;
    int32_t n;
    double low, thick, volume; ///< of the first slab's bottom; of a slab
} clx_slabs;

/// Grains of a block, the unit of work of a thread: of the motion, of a sweep.
enum { CLX_MAX_WALL = 8, CLX_MOVE_BLOCK = 256, CLX_SWEEP_BLOCK = 48 };

struct clast_dem {
    clast_dem_config config;
    clast_dem_drive drive;
    clx_law law;
    clx_laws laws; ///< where materials touch by their own
    int64_t step;
    double stride; ///< share of its radius that a grain may move in a step: clx_law_speed, greatest
    int32_t n_wall;
    clx_wall wall[CLX_MAX_WALL];
    double period[2];                ///< widths of a periodic domain, else 0
    double inverse_period[2];        ///< 1 over them, else 0
    clx_periodic_cell *cell;         ///< of a domain that is periodic in three directions, or NULL
    struct clx_container *container; ///< or NULL; its triangle t is item -1 - n_wall - t
    clx_walls walls;                 ///< as bodies, where they move or are watched
    int32_t n_body;
    clx_dem_body *body; ///< [n_body]
    bool has_items;     ///< some shape is a clump or rigid grain: items are not grains
    bool has_parts;     ///< some shape is a rigid grain: items have turns of their own
    bool all_round;     ///< every item is a sphere
    int32_t n_grain;
    int32_t n_started;  ///< grains that were checked for overlaps as they were added
    bool may_touch_old; ///< those that are added may begin in those that are there
    int64_t grain_capacity;
    clx_grain *grain;   ///< [n_grain]
    clx_motion *motion; ///< [n_grain]
    double *travel;     ///< [n_grain] path of the surface's fastest point, at most
    int32_t n_item;
    clx_item *item;                ///< [n_item] or NULL without clumps
    int32_t *item_begin;           ///< [n_grain + 1] or NULL without clumps
    clx_convex *convex;            ///< [n_item], or NULL while all items are spheres
    double (*item_rotation)[3][3]; ///< [n_item] rotation matrices, or NULL without rigid grains
    uint8_t *block_flag; ///< [blocks of CLX_SWEEP_BLOCK grains, at most] clx_move_flag of each
    clx_neighbour_list list;
    clx_inner_list inner;
    clx_sweeping sweeping;
    clx_slabs slabs;                 ///< solids by height, with hindrance
    clast_dem_verification verified; ///< in all steps so far
    struct clx_ranks *ranks;         ///< steps its grains over several ranks, or NULL
    const uint8_t *is_ghost; ///< [n_grain] of a rank's own simulation: moved by another; else NULL
    const int32_t *number;   ///< [n_grain] of such a simulation: grains' numbers; else NULL
    struct clx_energy *energy; ///< the energy book, or NULL
};

/// The number that a grain has for the user.
static inline int32_t clx_grain_number(const clast_dem *dem, int32_t g)
{
    return g >= 0 && dem->number != NULL ? dem->number[g] : g;
}

/// Whether the grains of both items are moved by other ranks.
static inline bool clx_are_ghosts(const clast_dem *dem, int32_t a, int32_t b)
{
    return dem->is_ghost != NULL && dem->is_ghost[dem->item != NULL ? dem->item[a].grain : a] &&
           dem->is_ghost[dem->item != NULL ? dem->item[b].grain : b];
}

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
static inline const double *clx_item_rotation(const clast_dem *dem, int32_t i)
{
    return dem->item_rotation != NULL ? dem->item_rotation[i][0]
                                      : dem->grain[clx_item_grain(dem, i)].rotation[0];
}

/// The law of a pair's materials.
static inline const clx_law *clx_pair_law(const clast_dem *dem, const clx_dem_pair *pair)
{
    if (dem->laws.n == 0) {
        return &dem->law;
    }
    const int32_t a = dem->body[dem->grain[clx_item_grain(dem, pair->a)].shape].material;
    const int32_t b = pair->b >= 0
                          ? dem->body[dem->grain[clx_item_grain(dem, pair->b)].shape].material
                          : clx_wall_of(dem, pair->b)->material;
    return &dem->laws.law[a * dem->laws.n + b];
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

/// Refuses numbers of a contact that its law cannot have.
clast_status clx_dem_check_contact(const clast_dem_config *config,
                                   const clast_dem_contact *contact);

/// Number of the laws that grains of a shape touch others by; the k-th of them.
static inline int32_t clx_n_law(const clast_dem *dem)
{
    return dem->laws.n > 0 ? dem->laws.n : 1;
}

static inline const clx_law *clx_law_at(const clast_dem *dem, int32_t shape, int32_t k)
{
    return dem->laws.n > 0 ? &dem->laws.law[dem->body[shape].material * dem->laws.n + k]
                           : &dem->law;
}

/// Whether any two grains have friction.
bool clx_grains_rub(const clast_dem *dem);

/// Contacts, then motion, of all grains: a step's work. *is_fine as clx_move.
clast_status clx_contacts_and_motion(clast_dem *dem, bool *is_fine);

/// The same in two passes; between them ranks tell each other what the energy book needs.
clast_status clx_pass_contacts(clast_dem *dem);
bool clx_pass_motion(clast_dem *dem); ///< *is_fine

/// Capacity for n grains; for n items, where those are not grains or have convex shapes too.
clast_status clx_grains_reserve(clast_dem *dem, int64_t n);
clast_status clx_items_reserve_all(clast_dem *dem, int64_t n);

/// Capacity for the items of n more grains; then items of the grain g, which is set.
clast_status clx_items_reserve(clast_dem *dem, int32_t n, const clast_dem_grain *grain);
void clx_items_add(clast_dem *dem, int32_t g);

/// Items of grain g where it is now.
void clx_items_place(clast_dem *dem, int32_t g);

/// From a grain's centre of mass, which mechanics moves, to the centre of its volume.
void clx_dem_arm(const clast_dem *dem, const clx_grain *g, double arm[3]);

/// Walls and periods of the domain.
void clx_dem_build_walls(clast_dem *dem);

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

/// clast_dem_step, but that the pairs of the list may be left behind their copies
/// (inner.is_packed).
clast_status clx_dem_step_packed(clast_dem *dem, int64_t n_step);

/// Compares the contacts that clx_contacts has just found with ones found without warm start.
void clx_verify(clast_dem *dem);

/// How far an item's surface may have moved since its neighbours were searched.
static inline double clx_item_moved(const clast_dem *dem, int32_t i)
{
    const clx_anchor *at = &dem->list.anchor[i];
    const double images = dem->cell != NULL ? 0.5 * dem->cell->path : 0.0;
    const double shifted = sqrt(v3_distance2(clx_item_position(dem, i), at->position)) + images;
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
