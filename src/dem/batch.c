// Spheres and the linear law for four contacts at once. Each line is that of touch.h, law.h or
// contacts.c, in their order, so that the bits are theirs.
#include "dem/batch.h"

CLX_INLINE void load3(const double *x, clx_lanes out[3])
{
    for (int c = 0; c < 3; ++c) {
        out[c] = lanes_load(x + c * CLX_LANES);
    }
}

CLX_INLINE void store3(double *out, const clx_lanes x[3])
{
    for (int c = 0; c < 3; ++c) {
        lanes_store(out + c * CLX_LANES, x[c]);
    }
}

typedef int32_t ints __attribute__((vector_size(16)));
typedef uint32_t words __attribute__((vector_size(16)));

/// Images of b, along x and y, as numbers of periods.
CLX_INLINE void read_periods(const clx_batch *p, clx_lanes period[2])
{
    words both;
    for (int k = 0; k < CLX_LANES; ++k) {
        const int16_t *n = p->link[k]->period;
        both[k] = (uint32_t)(uint16_t)n[0] | (uint32_t)(uint16_t)n[1] << 16;
    }
    period[0] = __builtin_convertvector((ints)(both << 16) >> 16, clx_lanes);
    period[1] = __builtin_convertvector((ints)both >> 16, clx_lanes);
}

/// Offsets of b from a, with the radii as fourths of a and b.
CLX_INLINE void offsets(const clast_dem *dem, const clx_batch *p, clx_lanes a[4], clx_lanes b[4],
                        clx_lanes r[3])
{
    clx_lanes period[2];
    lanes_gather(a, p->a[0]->position, p->a[1]->position, p->a[2]->position, p->a[3]->position);
    lanes_gather(b, p->b[0]->position, p->b[1]->position, p->b[2]->position, p->b[3]->position);
    read_periods(p, period);
    for (int c = 0; c < 3; ++c) {
        r[c] = b[c] - a[c];
    }
    r[0] = r[0] + dem->period[0] * period[0];
    r[1] = r[1] + dem->period[1] * period[1];
}

CLX_FOR_EACH_MACHINE
void clx_batch_offsets(const clast_dem *dem, clx_batch *p)
{
    clx_lanes a[4], b[4], r[3];
    offsets(dem, p, a, b, r);
    store3(p->meet.offset[0], r);
}

CLX_FOR_EACH_MACHINE
void clx_batch_arms(clx_batch *p)
{
    clx_lanes offset[3], arm[3];
    load3(p->meet.offset[0], offset);
    load3(p->meet.point[0], arm);
    for (int c = 0; c < 3; ++c) {
        arm[c] = arm[c] - offset[c];
    }
    store3(p->arm_b[0], arm);
}

CLX_FOR_EACH_MACHINE
void clx_batch_spheres(const clast_dem *dem, clx_batch *p)
{
    clx_lanes a[4], b[4], r[3], n[3], arm[3];
    const clx_lanes zero = lanes_all(0.0);
    offsets(dem, p, a, b, r);
    const clx_lanes d = lanes_root(lanes_dot(r, r));
    const clx_lanes distance = d - (a[3] + b[3]);
    const clx_lanes inverse = lanes_pick(d > 0.0, 1.0 / d, zero);
    const clx_lanes lever_a = a[3] + 0.5 * distance;
    const clx_lanes lever_b = -(b[3] + 0.5 * distance);
    lanes_store(p->meet.gap, distance);
    for (int c = 0; c < 3; ++c) {
        n[c] = inverse * r[c];
        arm[c] = lever_a * n[c];
        lanes_store(p->meet.normal[c], -n[c]);
    }
    store3(p->meet.point[0], arm);
    for (int c = 0; c < 3; ++c) {
        arm[c] = lever_b * n[c];
    }
    store3(p->arm_b[0], arm);
}

/// As clx_pair_contact does for one.
CLX_INLINE void add_rounding(const clast_dem *dem, const clx_batch *p, clx_meet_lanes *m)
{
    clx_lanes a, b;
    for (int k = 0; k < CLX_LANES; ++k) {
        a[k] = dem->convex[p->link[k]->a].round;
        b[k] = dem->convex[p->link[k]->b].round;
    }
    m->gap = m->gap - (a + b);
    lanes_axpy(m->point, m->point, 0.5 * (b - a), m->normal);
}

CLX_INLINE int facets(const clast_dem *dem, clx_batch *p, bool edges)
{
    clx_lanes a[4], b[4], r[3], arm[3];
    clx_meet_lanes m;
    offsets(dem, p, a, b, r);
    const clx_marks good =
        edges ? clx_edges_again(&p->meet, r, &m) : clx_faces_again(&p->meet, r, &m);
    if (dem->config.rounding > 0.0) {
        add_rounding(dem, p, &m);
    }
    for (int c = 0; c < 3; ++c) {
        arm[c] = m.point[c] - r[c];
    }
    lanes_store(p->meet.gap, m.gap);
    store3(p->meet.normal[0], m.normal);
    store3(p->meet.point[0], m.point);
    store3(p->arm_b[0], arm);
    return lanes_bits(good);
}

CLX_FOR_EACH_MACHINE
int clx_batch_faces(const clast_dem *dem, clx_batch *p)
{
    return facets(dem, p, false);
}

CLX_FOR_EACH_MACHINE
int clx_batch_edges(const clast_dem *dem, clx_batch *p)
{
    return facets(dem, p, true);
}

/// Four contacts and what the law works out for them.
typedef struct {
    clx_lanes normal[3], arm_a[3], arm_b[3], velocity[3], slide[3], tangential[3];
    clx_lanes mass, friction, twirl, push;
} meetings;

/// Velocity of b's surface relative to a's at the contact point; reduced mass and friction.
CLX_INLINE void approach(const clast_dem *dem, const clx_batch *p, bool has_walls, meetings *m)
{
    clx_lanes va[4], vb[4], wa[4], wb[4], u[3], w[3]; // va, vb with masses
    lanes_gather(va, p->a[0]->velocity, p->a[1]->velocity, p->a[2]->velocity, p->a[3]->velocity);
    lanes_gather(vb, p->b[0]->velocity, p->b[1]->velocity, p->b[2]->velocity, p->b[3]->velocity);
    lanes_gather(wa, p->a[0]->spin, p->a[1]->spin, p->a[2]->spin, p->a[3]->spin);
    lanes_gather(wb, p->b[0]->spin, p->b[1]->spin, p->b[2]->spin, p->b[3]->spin);
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
            is_wall[k] = p->link[k]->b < 0 ? 1.0 : 0.0;
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
CLX_INLINE void write(const clx_batch *p, clx_marks touching, const clx_lanes f[4],
                      const clx_lanes torque_b[4], const clx_lanes torque_a[4],
                      const clx_lanes wake_slide[4])
{
    clx_pushed *const *to = p->to;
    const int bits = lanes_bits(touching);
    lanes_scatter(f, to[0]->force, to[1]->force, to[2]->force, to[3]->force);
    lanes_scatter(torque_b, to[0]->torque_b, to[1]->torque_b, to[2]->torque_b, to[3]->torque_b);
    lanes_scatter(torque_a, to[0]->torque_a, to[1]->torque_a, to[2]->torque_a, to[3]->torque_a);
    lanes_scatter(wake_slide, &p->link[0]->wake, &p->link[1]->wake, &p->link[2]->wake,
                  &p->link[3]->wake);
    for (int k = 0; k < CLX_LANES; ++k) {
        p->link[k]->touches = (uint32_t)bits >> k & 1U;
    }
}

CLX_INLINE clx_lanes where(clx_marks m, clx_lanes x)
{
    return (clx_lanes)(m & (clx_marks)x);
}

CLX_INLINE void push_all(const clast_dem *dem, const clx_batch *p, bool has_walls)
{
    meetings m;
    clx_lanes f[4], torque_a[4], torque_b[4], slide[4];
    const clx_lanes gap = lanes_load(p->meet.gap);
    const clx_marks touching = ~(gap >= 0.0);
    lanes_gather(slide, &p->link[0]->wake, &p->link[1]->wake, &p->link[2]->wake,
                 &p->link[3]->wake); // wake, then slide
    load3(p->meet.normal[0], m.normal);
    load3(p->meet.point[0], m.arm_a);
    load3(p->arm_b[0], m.arm_b);
    for (int c = 0; c < 3; ++c) {
        m.normal[c] = -m.normal[c]; // from a to b
        m.slide[c] = slide[c + 1];
    }
    approach(dem, p, has_walls, &m);
    force(&dem->law, -gap, dem->config.time_step, &m);
    slide[0] = lanes_pick(touching, slide[0], lanes_load(p->travel) + gap);
    for (int c = 0; c < 3; ++c) {
        f[c] = where(touching, m.tangential[c] + m.push * m.normal[c]);
        slide[c + 1] = where(touching, m.slide[c]);
        m.tangential[c] = where(touching, m.tangential[c]);
    }
    const clx_lanes *turning = dem->config.normal_torque ? f : m.tangential;
    lanes_cross(torque_b, m.arm_b, turning);
    lanes_cross(torque_a, m.arm_a, turning);
    f[3] = torque_a[3] = torque_b[3] = lanes_all(0.0);
    write(p, touching, f, torque_b, torque_a, slide);
}

CLX_FOR_EACH_MACHINE
void clx_batch_push(const clast_dem *dem, const clx_batch *p, bool has_walls)
{
    if (has_walls) {
        push_all(dem, p, true);
    } else {
        push_all(dem, p, false);
    }
}
