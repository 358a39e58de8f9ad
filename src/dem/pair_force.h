#pragma once
// Force and torques of a pair that touches on its two grains.
#include "dem/touch.h"

/// Velocity of b's surface relative to a's at the contact point, and angular velocities.
static inline void clx_approach(const clx_grain *a, const clx_grain *b, const clx_dem_touch *t,
                                clx_meeting *m)
{
    double u[3];
    double w[3];
    v3_cross(u, a->omega, t->arm_a);
    v3_add(u, u, a->velocity);
    v3_cross(w, b->omega, t->arm_b);
    v3_add(w, w, b->velocity);
    v3_sub(m->velocity, w, u);
    v3_sub(m->roll, b->omega, a->omega);
    m->twirl = 0.5 * (v3_dot(a->omega, t->normal) + v3_dot(b->omega, t->normal));
}

static inline void clx_add_contact_force(const clx_dem_touch *t, const clx_contact_force *force,
                                         bool normal_torque, clx_force_torque *on_a,
                                         clx_force_torque *on_b)
{
    double total[3];
    double turning[3];
    double torque[3];
    v3_axpy(total, force->tangential, force->normal, t->normal);
    v3_add(on_b->force, on_b->force, total);
    v3_sub(on_a->force, on_a->force, total);
    v3_copy(turning, normal_torque ? total : force->tangential);
    v3_cross(torque, t->arm_b, turning);
    v3_add(torque, torque,
           force->rolling); // one sum a contact: the order of motion.c's sums
    v3_add(on_b->torque, on_b->torque, torque);
    v3_cross(torque, t->arm_a, turning);
    v3_add(torque, torque, force->rolling);
    v3_sub(on_a->torque, on_a->torque, torque);
}

/// Inverse masses of one grain at the contact, turning included: along the normal, and across it in
/// the stiffest direction. A point r from the centre turns with r^2 over a moment of inertia that
/// is taken as m (r^2 + 2.2 R^2) / 8: exact for a sphere; at the tips of ellipsoids it is 1.2 times
/// too little (needles), at the rims of flat ones up to 1.1 times too much.
static inline void clx_mobility(const clx_grain *g, const double arm[3], const double normal[3],
                                double out[2])
{
    double lever[3];
    const double inverse = 1.0 / g->mass;
    const double square = v3_norm2(arm);
    const double turning = 8.0 * inverse / (square + 2.2 * (g->round_radius * g->round_radius));
    v3_cross(lever, arm, normal);
    out[0] = inverse + turning * v3_norm2(lever);
    out[1] = inverse + fmax(2.5 * inverse, turning * square);
}

/// The contact's stability loads on its grains, and the greater load of the two, which limits its
/// spring and dashpot.
static inline void clx_hold_pair(const clx_law *law, const clx_grain *a, const clx_grain *b,
                                 const clx_dem_touch *t, clx_meeting *m, double load[2])
{
    double of_a[2];
    double of_b[2] = {0.0, 0.0};
    clx_mobility(a, t->arm_a, t->normal, of_a);
    if (b->mass > 0.0) {
        clx_mobility(b, t->arm_b, t->normal, of_b);
    }
    const double both = of_a[1] + of_b[1];
    const double along = law->load[0] * (of_a[0] + of_b[0]);
    const double across = law->load[1] * both;
    const double all = m->mass * fmax(along, across);
    const double shared = sqrt(of_a[1] * of_b[1]);
    load[0] = all * ((of_a[1] + shared) / both);
    load[1] = all * ((of_b[1] + shared) / both);
    m->head_on = fmin(1.0, along / across);
    m->held = fmax(all, fmax(a->held, b->held));
}

static const clx_grain clx_immovable = {.kind = CLAST_SHAPE_SPHERE};

/// Reduced moment of inertia, of spheres of equal volume: only a bound of the rolling torque.
static inline double clx_reduced_inertia(const clx_grain *a, const clx_grain *b)
{
    const double ia = 0.4 * a->mass * a->round_radius * a->round_radius;
    const double ib = 0.4 * b->mass * b->round_radius * b->round_radius;
    return b->mass > 0.0 ? ia * ib / (ia + ib) : ia;
}

/// Reduced moment of inertia about the contact, of such spheres: that of rolling. [Ai2011]
static inline double clx_rolling_inertia(const clx_grain *a, const clx_grain *b)
{
    const double ia = 1.4 * a->mass * a->round_radius * a->round_radius;
    const double ib = 1.4 * b->mass * b->round_radius * b->round_radius;
    return b->mass > 0.0 ? ia * ib / (ia + ib) : ia;
}

/// Contact history of a pair beside its tangential displacement, or NULL where the law has none.
static inline clx_contact_history *clx_pair_history(const clast_dem *dem, const clx_dem_pair *pair)
{
    if (!dem->law.has_history) {
        return NULL;
    }
    const clx_inner_list *inner = &dem->inner;
    const int64_t k =
        inner->is_packed ? inner->index[(const clx_packed_pair *)(const void *)pair - inner->packed]
                         : pair - dem->list.pair;
    return &dem->list.history[k];
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
static inline double clx_pair_neck(const clast_dem *dem, const clx_dem_pair *pair)
{
    if (!dem->law.has_neck || pair->touches == 0) {
        return 0.0;
    }
    const double ra = clx_item_curve(dem, pair->a);
    const double rb = pair->b >= 0 ? clx_item_curve(dem, pair->b) : 0.0;
    return -clx_jkr_tear(clx_pair_law(dem, pair), pair->b >= 0 ? ra * rb / (ra + rb) : ra);
}

/// Length of the longest neck that an item may have, at a plane, by the stickiest law; 0 for laws
/// that have none.
static inline double clx_item_neck(const clast_dem *dem, int32_t item)
{
    if (!dem->law.has_neck) {
        return 0.0;
    }
    clx_law law = dem->law;
    law.adhesion = fmax(law.adhesion, dem->laws.adhesion);
    return -clx_jkr_tear(&law, clx_item_curve(dem, item));
}

/// Factor on a grain's inertia by the fluid that moves along (added mass): 1 + C_m rho_f / rho.
static inline double clx_heavier(const clast_dem *dem, const clx_motion *m)
{
    return 1.0 + dem->config.added_mass * dem->config.fluid_density / m->density;
}

/// Reduced mass of a pair with the fluid that its grains move along.
static inline double clx_heavier_mass(const clast_dem *dem, const clx_dem_pair *pair)
{
    const int32_t a = clx_item_grain(dem, pair->a);
    const double of_a = dem->grain[a].mass * clx_heavier(dem, &dem->motion[a]);
    if (pair->b < 0) {
        return of_a;
    }
    const int32_t b = clx_item_grain(dem, pair->b);
    const double of_b = dem->grain[b].mass * clx_heavier(dem, &dem->motion[b]);
    return of_a * of_b / (of_a + of_b);
}

/// What the motion of a wall adds to a meeting.
static inline void clx_meet_wall(const clx_wall_body *wall, const clx_grain *a,
                                 const clx_dem_touch *t, clx_meeting *m)
{
    double x[3];
    double u[3];
    v3_add(x, a->position, t->arm_a);
    clx_wall_velocity(wall, x, u);
    v3_add(m->velocity, m->velocity, u);
    v3_add(m->roll, m->roll, wall->omega);
    m->twirl += 0.5 * v3_dot(wall->omega, t->normal);
}

/// A pair that touches as the law sees it, but for what exact steps limit (clx_hold_pair).
static inline void clx_meet_pair(const clast_dem *dem, const clx_dem_pair *p,
                                 clx_contact_history *history, const clx_dem_touch *t,
                                 clx_meeting *m)
{
    const clx_law *law = clx_pair_law(dem, p);
    const clx_grain *a = &dem->grain[clx_item_grain(dem, p->a)];
    const clx_grain *b = p->b >= 0 ? &dem->grain[clx_item_grain(dem, p->b)] : &clx_immovable;
    const bool needs_radius = law->kind != CLAST_DEM_LINEAR || law->cohesion != CLAST_DEM_DRY ||
                              law->rolling > 0.0 || law->is_wet;
    const double ra = needs_radius ? clx_item_curve(dem, p->a) : 0.0;
    m->overlap = -t->distance;
    v3_copy(m->normal, t->normal);
    clx_approach(a, b, t, m);
    if (dem->cell != NULL && p->b >= 0) {
        double image[3];
        clx_cell_velocity(dem->cell, a, b, t->arm_a, t->arm_b, image);
        v3_add(m->velocity, m->velocity, image);
    }
    if (p->b < 0 && clx_walls_move(dem)) {
        clx_meet_wall(clx_wall_of(dem, p->b), a, t, m);
    }
    if (p->b >= 0) {
        m->mass = a->mass * b->mass / (a->mass + b->mass);
        m->radius = 0.0;
        if (needs_radius) {
            const double rb = clx_item_curve(dem, p->b);
            m->radius = ra * rb / (ra + rb);
        }
        m->friction = law->friction[0];
    } else {
        m->mass = a->mass;
        m->radius = ra;
        m->friction = law->friction[1];
    }
    m->restitution = 0.0;
    if (law->is_wet) {
        if (history->restitution == 0.0) {
            history->restitution = clx_law_impact(law, m);
        }
        m->restitution = history->restitution;
    }
    if (dem->config.added_mass > 0.0) {
        m->mass = clx_heavier_mass(dem, p);
    }
}

/// Adds the force of a pair that touches to its grains' sums; `history` as clx_pair_history.
static inline void clx_add_pair_force(const clast_dem *dem, clx_dem_pair *p,
                                      clx_contact_history *history, const clx_dem_touch *t,
                                      clx_force_torque *on_a, clx_force_torque *on_b)
{
    const clx_law *law = clx_pair_law(dem, p);
    const clx_grain *a = &dem->grain[clx_item_grain(dem, p->a)];
    const clx_grain *b = p->b >= 0 ? &dem->grain[clx_item_grain(dem, p->b)] : &clx_immovable;
    clx_meeting m;
    clx_contact_force force;
    clx_meet_pair(dem, p, history, t, &m);
    if (law->is_exact) {
        double load[2];
        clx_hold_pair(law, a, b, t, &m, load);
        on_a->torque[3] += load[0];
        on_b->torque[3] += load[1];
    }
    clx_law_force(law, &m, dem->config.time_step, p->slide, &force);
    v3_set(force.rolling, 0.0, 0.0, 0.0);
    if (law->has_roll_spring) {
        const double inertia[2] = {clx_reduced_inertia(a, b), clx_rolling_inertia(a, b)};
        clx_law_roll_spring(law, &m, inertia, dem->config.time_step, history->roll, &force);
    } else if (law->rolling > 0.0) {
        clx_law_roll(law, &m, clx_reduced_inertia(a, b), dem->config.time_step, &force);
    }
    clx_add_contact_force(t, &force, dem->config.normal_torque, on_a, on_b);
}
