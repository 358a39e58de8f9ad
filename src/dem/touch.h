#pragma once
// Contact of a pair's two items: closed forms for spheres and walls, src/convex for the rest.
#include "convex/convex.h"
#include "dem/dem.h"

/// A contact as seen from a: arms are from the grains' centres to the contact point.
typedef struct {
    double distance;  ///< signed; < 0: overlap. When > 0 it may be a lower bound
    double normal[3]; ///< from a to b; only for an overlap
    double arm_a[3], arm_b[3];
} clx_dem_touch;

/// Offset of b's item from a's, in the image that the pair means.
static inline void clx_pair_offset(const clast_dem *dem, const clx_dem_pair *pair, double r[3])
{
    v3_sub(r, clx_item_position(dem, pair->b), clx_item_position(dem, pair->a));
    if (dem->cell != NULL) {
        clx_cell_offset(dem->cell, r);
        return;
    }
    for (int c = 0; c < 2; ++c) {
        const double turns = (-r[c] * dem->inverse_period[c] - pair->period[c]) / CLX_PERIOD_TURN;
        const double n = pair->period[c] + CLX_PERIOD_TURN * (turns + CLX_TO_WHOLE - CLX_TO_WHOLE);
        r[c] += dem->period[c] * n;
    }
}

/// From item centres to grain centres, for spheres of clumps.
static inline void clx_touch_lever(const clast_dem *dem, const clx_dem_pair *pair, clx_dem_touch *t)
{
    double off[3];
    const clx_item *a = &dem->item[pair->a];
    v3_sub(off, a->position, dem->grain[a->grain].position);
    v3_add(t->arm_a, t->arm_a, off);
    if (pair->b >= 0) {
        const clx_item *b = &dem->item[pair->b];
        v3_sub(off, b->position, dem->grain[b->grain].position);
        v3_add(t->arm_b, t->arm_b, off);
    }
}

static inline void clx_touch_spheres(const clast_dem *dem, const clx_dem_pair *pair,
                                     clx_dem_touch *t)
{
    double r[3];
    const double ra = clx_item_radius(dem, pair->a);
    const double rb = clx_item_radius(dem, pair->b);
    clx_pair_offset(dem, pair, r);
    const double d = sqrt(v3_norm2(r));
    t->distance = d - (ra + rb);
    if (t->distance >= 0.0 && !dem->law.has_neck) {
        return;
    }
    v3_scale(t->normal, d > 0.0 ? 1.0 / d : 0.0, r);
    v3_scale(t->arm_a, ra + 0.5 * t->distance, t->normal);
    v3_scale(t->arm_b, -(rb + 0.5 * t->distance), t->normal);
}

/// A sphere at a wall; the contact point lies on the wall's side of the overlap, as for hulls.
static inline void clx_touch_wall(const clast_dem *dem, const clx_dem_pair *pair, clx_dem_touch *t)
{
    double inward[3];
    const double radius = clx_item_radius(dem, pair->a);
    const clx_wall *wall = &dem->wall[-1 - pair->b];
    const double d = clx_wall_distance(wall, clx_item_position(dem, pair->a), inward);
    t->distance = d - radius;
    v3_scale(t->normal, -1.0, inward);
    v3_scale(t->arm_a, radius + 0.5 * t->distance, t->normal);
    v3_set(t->arm_b, 0.0, 0.0, 0.0);
}

static inline void clx_touch_from_contact(const clx_contact *c, const double offset[3],
                                          clx_dem_touch *t)
{
    t->distance = c->gap;
    v3_scale(t->normal, -1.0, c->normal);
    v3_copy(t->arm_a, c->point);
    v3_sub(t->arm_b, c->point, offset);
}

/// Two items of which one at least is no sphere.
void clx_touch_convex(const clast_dem *dem, const clx_dem_pair *pair, clx_warm_start *warm_start,
                      clx_dem_touch *t);

/// Two whole grains, hulls, whose warm start's facet is known not to do.
void clx_touch_hulls_anew(const clast_dem *dem, const clx_dem_pair *pair,
                          clx_warm_start *warm_start, clx_dem_touch *t);

/// An item that is no sphere at a wall.
void clx_touch_convex_wall(const clast_dem *dem, const clx_dem_pair *pair,
                           clx_warm_start *warm_start, clx_dem_touch *t);

/// An item at a triangle of the container, as if that stood alone.
void clx_container_touch_again(const clast_dem *dem, const clx_dem_pair *pair,
                               clx_warm_start *warm_start, clx_dem_touch *t);

/// @param warm_start  of the pair; not read where both are spheres
static inline void clx_dem_touch_find(const clast_dem *dem, const clx_dem_pair *pair,
                                      clx_warm_start *warm_start, clx_dem_touch *t)
{
    const bool is_round = clx_pair_is_round(dem, pair);
    if (pair->b >= 0) {
        if (is_round) {
            clx_touch_spheres(dem, pair, t);
        } else {
            clx_touch_convex(dem, pair, warm_start, t);
        }
    } else if (pair->b < -dem->n_wall) {
        clx_container_touch_again(dem, pair, warm_start, t);
    } else if (is_round) {
        clx_touch_wall(dem, pair, t);
    } else {
        clx_touch_convex_wall(dem, pair, warm_start, t);
    }
    if (dem->item != NULL && (t->distance < 0.0 || dem->law.has_neck)) {
        clx_touch_lever(dem, pair, t);
    }
}

/// The same for measuring: the pair's warm start is not renewed.
static inline void clx_find_again(const clast_dem *dem, const clx_dem_pair *pair, clx_dem_touch *t)
{
    clx_warm_start warm_start = {0};
    if (pair->slot != 0) {
        warm_start = dem->list.warm_start[pair->slot].record;
    }
    clx_dem_touch_find(dem, pair, &warm_start, t);
}

/// Whether a pair is a contact: it touched in the last step and has not parted since; a JKR neck
/// holds beyond the overlap. `touch` is where.
bool clx_pair_holds(const clast_dem *dem, const clx_dem_pair *pair, clx_dem_touch *touch);

/// Whether a contact is the first of its two bodies: clumps may touch in several spheres, and count
/// as one.
bool clx_is_first_contact(const clast_dem *dem, const clx_dem_pair *pair);

/// Contacts of n copies of pairs of whole grains that touched in the last step, where the grains
/// are now: forces, and where each touches; `touches` of the copy tells whether it still does. The
/// simulation, whose law has no history, stays as it is. `packed` [n + CLX_PREFETCH_PAIRS].
enum { CLX_MOST_AGAIN = 256 };
void clx_contacts_again(const clast_dem *dem, int32_t n, clx_packed_pair *packed,
                        clx_pair_force *force, clx_dem_touch *touch);
