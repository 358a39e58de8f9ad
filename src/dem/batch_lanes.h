#pragma once
// Contacts of one kind side by side, in as many lanes as the file that includes this has: batch.c
// four, batch_wide.c eight. Each line is that of touch.h, law.h or contacts.c, in their order, so
// that the bits are theirs whatever the lanes. `from` is the first contact of the batch.
#include "dem/batch.h"
#include "math/lanes.h"
#include <stddef.h>

CLX_INLINE void load3(const double *x, clx_lanes out[3])
{
    for (int c = 0; c < 3; ++c) {
        out[c] = lanes_load(x + c * CLX_BATCH);
    }
}

CLX_INLINE void store3(double *out, const clx_lanes x[3])
{
    for (int c = 0; c < 3; ++c) {
        lanes_store(out + c * CLX_BATCH, x[c]);
    }
}

typedef int32_t ints __attribute__((vector_size(4 * CLX_LANES)));
typedef uint32_t words __attribute__((vector_size(4 * CLX_LANES)));

/// The four doubles that begin `at` bytes into each grain.
CLX_INLINE void collect(const clx_grain *const grain[CLX_LANES], size_t at, clx_lanes out[4])
{
    const double *row[CLX_LANES];
    for (int k = 0; k < CLX_LANES; ++k) {
        row[k] = (const double *)(const void *)((const char *)grain[k] + at);
    }
    lanes_collect(out, row);
}

/// Images of b, along x and y, as numbers of periods.
CLX_INLINE void read_periods(clx_link *const link[CLX_LANES], clx_lanes period[2])
{
    words both;
    for (int k = 0; k < CLX_LANES; ++k) {
        const int16_t *n = link[k]->period;
        both[k] = (uint32_t)(uint16_t)n[0] | (uint32_t)(uint16_t)n[1] << 16;
    }
    period[0] = __builtin_convertvector((ints)(both << 16) >> 16, clx_lanes);
    period[1] = __builtin_convertvector((ints)both >> 16, clx_lanes);
}

/// Offsets of b from a, with the radii as fourths of a and b.
CLX_INLINE void offsets(const clast_dem *dem, const clx_batch *p, int from, clx_lanes a[4],
                        clx_lanes b[4], clx_lanes r[3])
{
    clx_lanes period[2];
    collect(p->a + from, offsetof(clx_grain, position), a);
    collect(p->b + from, offsetof(clx_grain, position), b);
    read_periods(p->link + from, period);
    for (int c = 0; c < 3; ++c) {
        r[c] = b[c] - a[c];
    }
    r[0] = r[0] + dem->period[0] * period[0];
    r[1] = r[1] + dem->period[1] * period[1];
}

CLX_INLINE void meet_spheres(const clast_dem *dem, clx_batch *p, int from)
{
    clx_lanes a[4], b[4], r[3], n[3], arm[3];
    const clx_lanes zero = lanes_all(0.0);
    offsets(dem, p, from, a, b, r);
    const clx_lanes d = lanes_root(lanes_dot(r, r));
    const clx_lanes distance = d - (a[3] + b[3]);
    const clx_lanes inverse = lanes_pick(d > 0.0, 1.0 / d, zero);
    const clx_lanes lever_a = a[3] + 0.5 * distance;
    const clx_lanes lever_b = -(b[3] + 0.5 * distance);
    lanes_store(p->meet.gap + from, distance);
    for (int c = 0; c < 3; ++c) {
        n[c] = inverse * r[c];
        arm[c] = lever_a * n[c];
        lanes_store(p->meet.normal[c] + from, -n[c]);
    }
    store3(p->meet.point[0] + from, arm);
    for (int c = 0; c < 3; ++c) {
        arm[c] = lever_b * n[c];
    }
    store3(p->arm_b[0] + from, arm);
}

/// As clx_pair_contact does for one.
CLX_INLINE void add_rounding(const clast_dem *dem, clx_link *const link[CLX_LANES],
                             clx_meet_lanes *m)
{
    clx_lanes a, b;
    for (int k = 0; k < CLX_LANES; ++k) {
        a[k] = dem->convex[link[k]->a].round;
        b[k] = dem->convex[link[k]->b].round;
    }
    m->gap = m->gap - (a + b);
    lanes_axpy(m->point, m->point, 0.5 * (b - a), m->normal);
}

/// Returns which lanes are answered, as bits.
CLX_INLINE int meet_facets(const clast_dem *dem, clx_batch *p, int from, bool edges)
{
    clx_lanes a[4], b[4], r[3], arm[3];
    clx_meet_lanes m;
    offsets(dem, p, from, a, b, r);
    const clx_marks good =
        edges ? clx_edges_again(&p->meet, from, r, &m) : clx_faces_again(&p->meet, from, r, &m);
    if (dem->config.rounding > 0.0) {
        add_rounding(dem, p->link + from, &m);
    }
    for (int c = 0; c < 3; ++c) {
        arm[c] = m.point[c] - r[c];
    }
    lanes_store(p->meet.gap + from, m.gap);
    store3(p->meet.normal[0] + from, m.normal);
    store3(p->meet.point[0] + from, m.point);
    store3(p->arm_b[0] + from, arm);
    return lanes_bits(good);
}

/// Contacts side by side and what the law works out for them.
typedef struct {
    clx_lanes normal[3], arm_a[3], arm_b[3], velocity[3], slide[3], tangential[3];
    clx_lanes mass, friction, twirl, push;
} meetings;

/// Velocity of b's surface relative to a's at the contact point; reduced mass and friction.
CLX_INLINE void approach(const clast_dem *dem, const clx_batch *p, int from, bool has_walls,
                         meetings *m)
{
    clx_lanes va[4], vb[4], wa[4], wb[4], u[3], w[3]; // va, vb with masses
    collect(p->a + from, offsetof(clx_grain, velocity), va);
    collect(p->b + from, offsetof(clx_grain, velocity), vb);
    collect(p->a + from, offsetof(clx_grain, spin), wa);
    collect(p->b + from, offsetof(clx_grain, spin), wb);
    lanes_cross(u, wa, m->arm_a);
    lanes_cross(w, wb, m->arm_b);
    for (int c = 0; c < 3; ++c) {
        m->velocity[c] = (w[c] + vb[c]) - (u[c] + va[c]);
    }
    m->twirl = 0.5 * (lanes_dot(wa, m->normal) + lanes_dot(wb, m->normal));
    m->mass = va[3] * vb[3] / (va[3] + vb[3]);
    m->friction = lanes_all(dem->law.friction[0]);
    if (has_walls) {
        clx_lanes is_wall;
        for (int k = 0; k < CLX_LANES; ++k) {
            is_wall[k] = p->link[from + k]->b < 0 ? 1.0 : 0.0;
        }
        m->mass = lanes_pick(is_wall > 0.0, va[3], m->mass);
        m->friction = lanes_pick(is_wall > 0.0, lanes_all(dem->law.friction[1]), m->friction);
    }
}

/// clx_law_turn
CLX_INLINE void turn_slide(double dt, meetings *m)
{
    clx_lanes across[3], turned[3];
    const clx_lanes old = lanes_dot(m->slide, m->slide);
    lanes_cross(across, m->normal, m->slide);
    lanes_axpy(turned, m->slide, m->twirl * dt, across);
    lanes_axpy(turned, turned, -lanes_dot(turned, m->normal), m->normal);
    const clx_lanes now = lanes_dot(turned, turned);
    const clx_lanes scale = lanes_pick(now > 0.0, lanes_root(old / now), lanes_all(0.0));
    for (int c = 0; c < 3; ++c) {
        m->slide[c] = lanes_pick(old == 0.0, m->slide[c], scale * turned[c]);
    }
}

/// clx_law_force
CLX_INLINE void force(const clx_law *law, clx_lanes overlap, double dt, meetings *m)
{
    clx_lanes along[3];
    const clx_lanes k = m->mass * law->stiffness;
    const clx_lanes normal_damping = m->mass * law->damping;
    const clx_lanes kt = law->kappa * k;
    const clx_lanes dt_along = law->root_kappa * normal_damping;
    const clx_lanes apart = lanes_dot(m->velocity, m->normal);
    lanes_axpy(along, m->velocity, -apart, m->normal);
    m->push = k * overlap - normal_damping * apart;
    if (law->clip) {
        m->push = lanes_pick(m->push < 0.0, lanes_all(0.0), m->push);
    }
    const clx_lanes limit = m->friction * lanes_size(m->push);
    turn_slide(dt, m);
    lanes_axpy(m->slide, m->slide, lanes_all(dt), along);
    for (int c = 0; c < 3; ++c) {
        m->tangential[c] = -kt * m->slide[c] - dt_along * along[c];
    }
    const clx_lanes size2 = lanes_dot(m->tangential, m->tangential);
    const clx_marks slips = size2 > limit * limit;
    const clx_lanes cut = limit / lanes_root(size2);
    const clx_lanes inverse = -1.0 / kt;
    for (int c = 0; c < 3; ++c) {
        const clx_lanes t = cut * m->tangential[c];
        m->slide[c] = lanes_pick(slips, inverse * (t + dt_along * along[c]), m->slide[c]);
        m->tangential[c] = lanes_pick(slips, t, m->tangential[c]);
    }
}

/// Forces, torques and the links' wakes and displacements. Lanes that repeat another write the same
/// bytes to the same place.
CLX_INLINE void write(clx_pushed *const to[CLX_LANES], clx_link *const link[CLX_LANES],
                      int touching, clx_lanes out[4][4])
{
    double *force[CLX_LANES], *torque_b[CLX_LANES], *torque_a[CLX_LANES], *wake_slide[CLX_LANES];
    for (int k = 0; k < CLX_LANES; ++k) {
        force[k] = to[k]->force;
        torque_b[k] = to[k]->torque_b;
        torque_a[k] = to[k]->torque_a;
        wake_slide[k] = &link[k]->wake;
        link[k]->touches = (uint32_t)touching >> k & 1U;
    }
    lanes_deal(out[0], force);
    lanes_deal(out[1], torque_b);
    lanes_deal(out[2], torque_a);
    lanes_deal(out[3], wake_slide);
}

CLX_INLINE clx_lanes where(clx_marks m, clx_lanes x)
{
    return (clx_lanes)(m & (clx_marks)x);
}

CLX_INLINE void push_lanes(const clast_dem *dem, const clx_batch *p, int from, bool has_walls)
{
    meetings m;
    clx_lanes out[4][4]; // force, torque on b and on a, the link's wake and slide
    clx_lanes *f = out[0];
    clx_lanes *slide = out[3];
    const double *wake[CLX_LANES];
    const clx_lanes gap = lanes_load(p->meet.gap + from);
    const clx_marks touching = ~(gap >= 0.0);
    for (int k = 0; k < CLX_LANES; ++k) {
        wake[k] = &p->link[from + k]->wake;
    }
    lanes_collect(slide, wake);
    load3(p->meet.normal[0] + from, m.normal);
    load3(p->meet.point[0] + from, m.arm_a);
    load3(p->arm_b[0] + from, m.arm_b);
    for (int c = 0; c < 3; ++c) {
        m.normal[c] = -m.normal[c]; // from a to b
        m.slide[c] = slide[c + 1];
    }
    approach(dem, p, from, has_walls, &m);
    force(&dem->law, -gap, dem->config.time_step, &m);
    slide[0] = lanes_pick(touching, slide[0], lanes_load(p->travel + from) + gap);
    for (int c = 0; c < 3; ++c) {
        f[c] = where(touching, m.tangential[c] + m.push * m.normal[c]);
        slide[c + 1] = where(touching, m.slide[c]);
        m.tangential[c] = where(touching, m.tangential[c]);
    }
    const clx_lanes *turning = dem->config.normal_torque ? f : m.tangential;
    lanes_cross(out[1], m.arm_b, turning);
    lanes_cross(out[2], m.arm_a, turning);
    f[3] = out[1][3] = out[2][3] = lanes_all(0.0);
    write(p->to + from, p->link + from, lanes_bits(touching), out);
}
