#pragma once
// What a pair that touches does to its two grains.
#include "dem/touch.h"

/// Velocity of b's surface relative to a's at the contact point, and spins.
static inline void clx_approach(const clx_grain *a, const clx_grain *b, const clx_dem_touch *t,
                                clx_meeting *m)
{
    double u[3];
    double w[3];
    v3_cross(u, a->spin, t->arm_a);
    v3_add(u, u, a->velocity);
    v3_cross(w, b->spin, t->arm_b);
    v3_add(w, w, b->velocity);
    v3_sub(m->velocity, w, u);
    v3_sub(m->roll, b->spin, a->spin);
    m->twirl = 0.5 * (v3_dot(a->spin, t->normal) + v3_dot(b->spin, t->normal));
}

static inline void clx_add_push(const clx_dem_touch *t, const clx_push *push, bool normal_torque,
                                clx_load *on_a, clx_load *on_b)
{
    double force[3];
    double turning[3];
    double torque[3];
    v3_axpy(force, push->tangential, push->normal, t->normal);
    v3_add(on_b->force, on_b->force, force);
    v3_sub(on_a->force, on_a->force, force);
    v3_copy(turning, normal_torque ? force : push->tangential);
    v3_cross(torque, t->arm_b, turning);
    v3_add(torque, torque, push->rolling); // one sum a contact: the gathered one has the same bytes
    v3_add(on_b->torque, on_b->torque, torque);
    v3_cross(torque, t->arm_a, turning);
    v3_add(torque, torque, push->rolling);
    v3_sub(on_a->torque, on_a->torque, torque);
}

static const clx_grain clx_immovable = {.kind = CLAST_SHAPE_SPHERE};

/// Reduced moment of inertia, of spheres of equal volume: only a bound of the rolling torque.
static inline double clx_reduced_inertia(const clx_grain *a, const clx_grain *b)
{
    const double ia = 0.4 * a->mass * a->round_radius * a->round_radius;
    const double ib = 0.4 * b->mass * b->round_radius * b->round_radius;
    return b->mass > 0.0 ? ia * ib / (ia + ib) : ia;
}

static inline double clx_item_curve(const clast_dem *dem, int32_t item)
{
    const clx_grain *g = &dem->grain[clx_item_grain(dem, item)];
    if (dem->item == NULL || dem->item[item].part == -1) {
        return g->round_radius;
    }
    return dem->item[item].part >= 0 ? dem->item[item].radius
                                     : g->scale * clx_item_part(dem, item)->round_radius;
}

/// Length of the neck that still holds a pair apart; 0 for laws that have none, and pairs that did
/// not touch.
static inline double clx_link_neck(const clast_dem *dem, const clx_link *link)
{
    if (!dem->law.has_neck || link->touches == 0) {
        return 0.0;
    }
    const double ra = clx_item_curve(dem, link->a);
    const double rb = link->b >= 0 ? clx_item_curve(dem, link->b) : 0.0;
    return -clx_jkr_tear(&dem->law, link->b >= 0 ? ra * rb / (ra + rb) : ra);
}

/// A pair that touches.
static inline void clx_push_pair(const clast_dem *dem, const clx_law *law, clx_link *p,
                                 const clx_dem_touch *t, clx_load *on_a, clx_load *on_b)
{
    const clx_grain *a = &dem->grain[clx_item_grain(dem, p->a)];
    const clx_grain *b = p->b >= 0 ? &dem->grain[clx_item_grain(dem, p->b)] : &clx_immovable;
    const bool needs_radius =
        law->kind != CLAST_DEM_LINEAR || law->cohesion != CLAST_DEM_DRY || law->rolling > 0.0;
    const double ra = needs_radius ? clx_item_curve(dem, p->a) : 0.0;
    clx_meeting m;
    clx_push push;
    m.overlap = -t->distance;
    v3_copy(m.normal, t->normal);
    clx_approach(a, b, t, &m);
    if (p->b >= 0) {
        m.mass = a->mass * b->mass / (a->mass + b->mass);
        m.radius = 0.0;
        if (needs_radius) {
            const double rb = clx_item_curve(dem, p->b);
            m.radius = ra * rb / (ra + rb);
        }
        m.friction = law->friction[0];
    } else {
        m.mass = a->mass;
        m.radius = ra;
        m.friction = law->friction[1];
    }
    clx_law_force(law, &m, dem->config.time_step, p->slide, &push);
    v3_set(push.rolling, 0.0, 0.0, 0.0);
    if (law->rolling > 0.0) {
        clx_law_roll(law, &m, clx_reduced_inertia(a, b), dem->config.time_step, &push);
    }
    clx_add_push(t, &push, dem->config.normal_torque, on_a, on_b);
}
