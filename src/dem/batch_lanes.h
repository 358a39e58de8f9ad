#pragma once
// Contacts of one kind in SIMD lanes; the lane width is that of the file that includes this: four
// in batch.c, eight in batch_avx512.c. Each line is that of touch.h, law.h or contacts.c, in the
// same order, so that scalar code and all lane widths give the same bits. `from` is the first
// contact of the batch.
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

CLX_INLINE const double *doubles_at(const void *record, size_t at)
{
    return (const double *)(const void *)((const char *)record + at);
}

/// The four doubles that begin `at` bytes into each grain.
CLX_INLINE void collect(const clx_grain *const grain[CLX_LANES], size_t at, clx_lanes out[4])
{
    for (int k = 0; k < 4; ++k) {
        out[k] = lanes_row(doubles_at(grain[k], at), doubles_at(grain[k + CLX_BEYOND], at));
    }
    lanes_transpose(out);
}

/// Images of b, along x and y, as the low bits of numbers of periods.
CLX_INLINE void read_periods(clx_dem_pair *const pair[CLX_LANES], clx_lanes period[2])
{
    words both;
    for (int k = 0; k < CLX_LANES; ++k) {
        const int16_t *n = pair[k]->period;
        both[k] = (uint32_t)(uint16_t)n[0] | (uint32_t)(uint16_t)n[1] << 16;
    }
    period[0] = __builtin_convertvector((ints)(both << 16) >> 16, clx_lanes);
    period[1] = __builtin_convertvector((ints)both >> 16, clx_lanes);
}

/// clx_cell_offset
CLX_INLINE void nearest_image(const clx_periodic_cell *cell, clx_lanes r[3])
{
    const clx_lanes z = -r[2] * cell->inverse[2] + CLX_WHOLE_CELL - CLX_WHOLE_CELL;
    r[2] = r[2] + cell->side[2] * z;
    r[0] = r[0] + cell->shift * z;
    for (int c = 0; c < 2; ++c) {
        const clx_lanes n = -r[c] * cell->inverse[c] + CLX_WHOLE_CELL - CLX_WHOLE_CELL;
        r[c] = r[c] + cell->side[c] * n;
    }
}

/// Offsets of b from a, with the radii as fourth components of a and b.
CLX_INLINE void offsets(const clast_dem *dem, const clx_batch *p, int from, clx_lanes a[4],
                        clx_lanes b[4], clx_lanes r[3])
{
    collect(p->a + from, offsetof(clx_grain, position), a);
    collect(p->b + from, offsetof(clx_grain, position), b);
    for (int c = 0; c < 3; ++c) {
        r[c] = b[c] - a[c];
    }
    if (!(dem->period[0] > 0.0 || dem->period[1] > 0.0)) { // most beds: 3 of 4 operations less
        r[0] = r[0] + 0.0;                                 // -0 is 0, as below
        r[1] = r[1] + 0.0;
        if (__builtin_expect(dem->cell != NULL, 0)) {
            nearest_image(dem->cell, r);
        }
        return;
    }
    clx_lanes period[2];
    read_periods(p->pair + from, period);
    for (int c = 0; c < 2; ++c) {
        const clx_lanes turns = (-r[c] * dem->inverse_period[c] - period[c]) / CLX_PERIOD_TURN;
        const clx_lanes n = period[c] + CLX_PERIOD_TURN * (turns + CLX_TO_WHOLE - CLX_TO_WHOLE);
        r[c] = r[c] + dem->period[c] * n;
    }
}

CLX_INLINE void contact_of_spheres(const clast_dem *dem, clx_batch *p, int from)
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

/// Rounding, as in clx_pair_contact.
CLX_INLINE void add_rounding(const clast_dem *dem, clx_dem_pair *const pair[CLX_LANES],
                             clx_meet_lanes *m)
{
    clx_lanes a, b;
    for (int k = 0; k < CLX_LANES; ++k) {
        a[k] = dem->convex[pair[k]->a].round;
        b[k] = dem->convex[pair[k]->b].round;
    }
    m->gap = m->gap - (a + b);
    lanes_axpy(m->point, m->point, 0.5 * (b - a), m->normal);
}

/// Returns which lanes are answered, as bits.
CLX_INLINE int contact_of_facets(const clast_dem *dem, clx_batch *p, int from, bool edges)
{
    clx_lanes a[4], b[4], r[3], arm[3];
    clx_meet_lanes m;
    offsets(dem, p, from, a, b, r);
    const clx_marks good =
        edges ? clx_edges_again(&p->meet, from, r, &m) : clx_faces_again(&p->meet, from, r, &m);
    if (dem->config.rounding > 0.0) {
        add_rounding(dem, p->pair + from, &m);
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

/// Which law, and which contacts: known where it is compiled.
typedef struct {
    bool has_walls; ///< some b may be a wall
    bool is_exact;
    bool is_hertz;
    bool by_materials; ///< pairs have laws of their own
    bool is_rough;     ///< there may be rolling friction or attraction
} law_case;

// The law is computed in three stages, each for both halves of a batch before the next: while one
// half waits for its roots and divisions, the other goes on.

/// Contacts in lanes, and the law's intermediate results.
typedef struct {
    clx_lanes active_from, slide[3]; ///< of the pairs
    clx_lanes velocity[3];           ///< of b's surface relative to a's at the contact point
    clx_lanes mass, friction, twirl;
    clx_lanes normal_force, pressed, limit, tangential[3];
    clx_lanes drag[3];               ///< what damping takes off the tangential force
    clx_lanes inverse;               ///< of the tangential stiffness, negative
    clx_lanes load[2];               ///< exact steps: the contact's stability load on a and b
    clx_lanes spring[2], damping[2]; ///< exact steps: reductions, normal and tangential
} contact_lanes;

/// From a to b.
CLX_INLINE void load_normal(const clx_batch *p, int from, clx_lanes normal[3])
{
    load3(p->meet.normal[0] + from, normal);
    for (int c = 0; c < 3; ++c) {
        normal[c] = -normal[c];
    }
}

/// clx_cell_velocity, added to the velocities of contacts.
CLX_INLINE void add_image_velocity(const clx_periodic_cell *cell, const clx_batch *p, int from,
                                   clx_lanes velocity[3])
{
    clx_lanes a[4], b[4], arm_a[3], arm_b[3], n[3];
    collect(p->a + from, offsetof(clx_grain, position), a);
    collect(p->b + from, offsetof(clx_grain, position), b);
    load3(p->meet.point[0] + from, arm_a);
    load3(p->arm_b[0] + from, arm_b);
    for (int c = 0; c < 3; ++c) {
        n[c] = (arm_a[c] - arm_b[c]) - (b[c] - a[c]);
    }
    n[1] = n[1] * cell->inverse[1];
    n[2] = n[2] * cell->inverse[2];
    n[0] = (n[0] - cell->shift * n[2]) * cell->inverse[0];
    velocity[0] = velocity[0] + (cell->rate[0] * n[0] + cell->shear * n[2]);
    velocity[1] = velocity[1] + cell->rate[1] * n[1];
    velocity[2] = velocity[2] + cell->rate[2] * n[2];
}

static_assert(offsetof(clx_law, root_kappa) == offsetof(clx_law, stiffness) + 24 &&
                  offsetof(clx_law, friction) == offsetof(clx_law, young) + 24,
              "stiffness, damping, kappa, root_kappa; young, shear, alpha, friction");

/// Four constants that begin `at` bytes into the pairs' laws.
CLX_INLINE void read_laws(const clast_dem *dem, const clx_batch *p, int from, size_t at,
                          clx_lanes out[4])
{
    const double *row[CLX_LANES];
    for (int k = 0; k < CLX_LANES; ++k) {
        const int32_t a = dem->body[p->a[from + k]->shape].material;
        const int32_t b = dem->body[p->b[from + k]->shape].material;
        row[k] = doubles_at(&dem->laws.law[a * dem->laws.n + b], at);
    }
    lanes_collect(out, row, 0);
}

/// Velocities, reduced mass and friction; the pairs' displacements.
CLX_INLINE void approach(const clast_dem *dem, const clx_batch *p, int from, law_case which,
                         contact_lanes *m)
{
    clx_lanes va[4], vb[4], wa[4], wb[4], u[3], w[3]; // va, vb: fourth component is the mass
    clx_lanes normal[3], arm[3], slide[4];
    collect(p->a + from, offsetof(clx_grain, velocity), va);
    collect(p->b + from, offsetof(clx_grain, velocity), vb);
    collect(p->a + from, offsetof(clx_grain, omega), wa);
    collect(p->b + from, offsetof(clx_grain, omega), wb);
    load3(p->meet.point[0] + from, arm);
    lanes_cross(u, wa, arm);
    load3(p->arm_b[0] + from, arm);
    lanes_cross(w, wb, arm);
    for (int c = 0; c < 3; ++c) {
        m->velocity[c] = (w[c] + vb[c]) - (u[c] + va[c]);
    }
    if (__builtin_expect(dem->cell != NULL, 0)) { // which has no walls
        add_image_velocity(dem->cell, p, from, m->velocity);
    }
    load_normal(p, from, normal);
    m->twirl = 0.5 * (lanes_dot(wa, normal) + lanes_dot(wb, normal));
    m->mass = va[3] * vb[3] / (va[3] + vb[3]);
    m->friction = lanes_all(dem->law.friction[0]);
    if (which.by_materials) {
        clx_lanes law[4];
        read_laws(dem, p, from, offsetof(clx_law, young), law);
        m->friction = law[3];
    }
    if (which.has_walls) {
        clx_lanes is_wall;
        for (int k = 0; k < CLX_LANES; ++k) {
            is_wall[k] = p->pair[from + k]->b < 0 ? 1.0 : 0.0;
        }
        m->mass = lanes_pick(is_wall > 0.0, va[3], m->mass);
        m->friction = lanes_pick(is_wall > 0.0, lanes_all(dem->law.friction[1]), m->friction);
    }
    for (int k = 0; k < 4; ++k) {
        slide[k] = lanes_row(&p->pair[from + k]->active_from,
                             &p->pair[from + k + CLX_BEYOND]->active_from);
    }
    lanes_transpose(slide);
    m->active_from = slide[0];
    for (int c = 0; c < 3; ++c) {
        m->slide[c] = slide[c + 1];
    }
}

/// Radii of spheres of equal volume, second, and stability loads, last.
CLX_INLINE void read_radii(const clx_batch *p, int from, clx_lanes a[4], clx_lanes b[4])
{
    collect(p->a + from, offsetof(clx_grain, rotation) + 8 * sizeof(double), a);
    collect(p->b + from, offsetof(clx_grain, rotation) + 8 * sizeof(double), b);
}

/// clx_mobility
CLX_INLINE void mobility(clx_lanes mass, clx_lanes radius, const double *point,
                         const clx_lanes normal[3], clx_lanes out[2])
{
    clx_lanes arm[3], lever[3];
    load3(point, arm);
    const clx_lanes inverse = 1.0 / mass;
    const clx_lanes square = lanes_dot(arm, arm);
    const clx_lanes turning = 8.0 * inverse / (square + 2.2 * (radius * radius));
    lanes_cross(lever, arm, normal);
    const clx_lanes whole = turning * square;
    const clx_lanes least = 2.5 * inverse;
    out[0] = inverse + turning * lanes_dot(lever, lever);
    out[1] = inverse + lanes_pick(least > whole, least, whole);
}

/// clx_law_hold
CLX_INLINE void limit(const clx_law *law, clx_lanes held, clx_lanes *spring, clx_lanes *damping)
{
    const clx_lanes one = lanes_all(1.0);
    const clx_lanes share = CLX_LAW_STABLE / held;
    const double rest = 1.0 - law->spring_share;
    const clx_lanes least = 0.5 * share;
    const clx_lanes whole = (share - law->spring_share) / rest;
    const clx_lanes of_damping = lanes_pick(least > whole, least, whole);
    const clx_lanes of_spring = (share - of_damping * rest) / law->spring_share;
    const clx_marks is_free = ~(held > CLX_LAW_STABLE);
    *spring = lanes_pick(is_free, one, lanes_pick(one < of_spring, one, of_spring));
    *damping = lanes_pick(is_free, one, of_damping);
}

/// clx_hold_pair and clx_law_hold
CLX_INLINE void hold(const clast_dem *dem, const clx_batch *p, int from, bool has_walls,
                     contact_lanes *m)
{
    const clx_law *law = &dem->law;
    clx_lanes va[4], vb[4], ra[4], rb[4], of_a[2], of_b[2],
        normal[3]; // v: with masses; r: with radii
    collect(p->a + from, offsetof(clx_grain, velocity), va);
    collect(p->b + from, offsetof(clx_grain, velocity), vb);
    read_radii(p, from, ra, rb);
    load_normal(p, from, normal);
    mobility(va[3], ra[1], p->meet.point[0] + from, normal, of_a);
    mobility(vb[3], rb[1], p->arm_b[0] + from, normal, of_b);
    for (int k = 0; k < 2 && has_walls; ++k) {
        of_b[k] = lanes_pick(vb[3] > 0.0, of_b[k], lanes_all(0.0));
    }
    const clx_lanes both = of_a[1] + of_b[1];
    const clx_lanes along = law->load[0] * (of_a[0] + of_b[0]);
    const clx_lanes across = law->load[1] * both;
    const clx_lanes all = m->mass * lanes_pick(along > across, along, across);
    const clx_lanes shared = lanes_root(of_a[1] * of_b[1]);
    m->load[0] = all * ((of_a[1] + shared) / both);
    m->load[1] = all * ((of_b[1] + shared) / both);
    clx_lanes held = lanes_pick(ra[3] > rb[3], ra[3], rb[3]);
    held = lanes_pick(all > held, all, held);
    const clx_lanes one = lanes_all(1.0);
    const clx_lanes head_on = along / across;
    limit(law, held * lanes_pick(one < head_on, one, head_on), &m->spring[0], &m->damping[0]);
    limit(law, held, &m->spring[1], &m->damping[1]);
}

/// clx_law_rotate
CLX_INLINE void rotate_slide(const clx_lanes normal[3], clx_lanes angle, clx_lanes slide[3])
{
    clx_lanes across[3], turned[3];
    const clx_lanes old = lanes_dot(slide, slide);
    lanes_cross(across, normal, slide);
    lanes_axpy(turned, slide, angle, across);
    lanes_axpy(turned, turned, -lanes_dot(turned, normal), normal);
    const clx_lanes now = lanes_dot(turned, turned);
    const clx_lanes scale = lanes_pick(now > 0.0, lanes_root(old / now), lanes_all(0.0));
    for (int c = 0; c < 3; ++c) {
        slide[c] = lanes_pick(old == 0.0, slide[c], scale * turned[c]);
    }
}

/// clx_springs
typedef struct {
    clx_lanes elastic, normal_damping, tangential, tangential_damping;
} spring_lanes;

/// clx_law_springs of the linear law.
CLX_INLINE spring_lanes linear_springs(const clast_dem *dem, const clx_batch *p, int from,
                                       law_case which, const contact_lanes *m)
{
    spring_lanes s;
    clx_lanes law[4] = {lanes_all(dem->law.stiffness), lanes_all(dem->law.damping),
                        lanes_all(dem->law.kappa), lanes_all(dem->law.root_kappa)};
    if (which.by_materials) {
        read_laws(dem, p, from, offsetof(clx_law, stiffness), law);
    }
    const clx_lanes k = m->mass * law[0];
    s.normal_damping = m->mass * law[1];
    s.elastic = k * -lanes_load(p->meet.gap + from);
    s.tangential = law[2] * k;
    s.tangential_damping = law[3] * s.normal_damping;
    return s;
}

/// clx_law_springs of Hertz's law.
CLX_INLINE spring_lanes hertz_springs(const clast_dem *dem, const clx_batch *p, int from,
                                      law_case which, const contact_lanes *m)
{
    spring_lanes s;
    clx_lanes a[4], b[4]; // radii second
    clx_lanes law[4] = {lanes_all(dem->law.young), lanes_all(dem->law.shear),
                        lanes_all(dem->law.alpha)};
    const clx_lanes overlap = -lanes_load(p->meet.gap + from);
    if (which.by_materials) {
        read_laws(dem, p, from, offsetof(clx_law, young), law);
    }
    read_radii(p, from, a, b);
    const clx_lanes radius = a[1] * b[1] / (a[1] + b[1]);
    const clx_lanes root = lanes_root(radius * overlap);
    const clx_lanes k = 4.0 / 3.0 * law[0] * lanes_root(radius);
    s.elastic = 4.0 / 3.0 * law[0] * root * overlap;
    s.normal_damping = law[2] * lanes_root(m->mass * k * lanes_root(overlap));
    s.tangential = 8.0 * law[1] * root;
    s.tangential_damping = s.normal_damping * lanes_root(s.tangential / (2.0 * law[0] * root));
    return s;
}

/// clx_law_pull
CLX_INLINE clx_lanes pull_of(const clast_dem *dem, const clx_batch *p, int from)
{
    clx_lanes a[4], b[4];
    read_radii(p, from, a, b);
    const clx_lanes radius = a[1] * b[1] / (a[1] + b[1]);
    return dem->law.cohesion == CLAST_DEM_AREA
               ? dem->law.cohesion_energy * CLAST_PI * radius * -lanes_load(p->meet.gap + from)
               : dem->law.pull * radius;
}

/// clx_law_roll of grains, with clx_reduced_inertia.
CLX_INLINE void roll(const clast_dem *dem, const clx_batch *p, int from, const contact_lanes *m,
                     const clx_lanes normal[3], clx_lanes rolling[3])
{
    clx_lanes wa[4], wb[4], a[4], b[4], rotation[3];
    collect(p->a + from, offsetof(clx_grain, velocity), a);
    collect(p->b + from, offsetof(clx_grain, velocity), b);
    const clx_lanes mass_a = a[3];
    const clx_lanes mass_b = b[3];
    read_radii(p, from, a, b);
    collect(p->a + from, offsetof(clx_grain, omega), wa);
    collect(p->b + from, offsetof(clx_grain, omega), wb);
    const clx_lanes ia = 0.4 * mass_a * a[1] * a[1];
    const clx_lanes ib = 0.4 * mass_b * b[1] * b[1];
    const clx_lanes inertia = ia * ib / (ia + ib);
    for (int c = 0; c < 3; ++c) {
        rotation[c] = wb[c] - wa[c];
    }
    lanes_axpy(rotation, rotation, -lanes_dot(rotation, normal), normal);
    const clx_lanes size = lanes_root(lanes_dot(rotation, rotation));
    const clx_lanes most = dem->law.rolling * (a[1] * b[1] / (a[1] + b[1])) * m->pressed;
    const clx_lanes stops = CLX_LAW_STOPS * inertia * size / dem->config.time_step;
    const clx_lanes share =
        lanes_pick(size > 0.0, -lanes_lesser(most, stops) / size, lanes_all(0.0));
    for (int c = 0; c < 3; ++c) {
        rolling[c] = share * rotation[c];
    }
}

/// clx_law_force up to Coulomb's limit.
CLX_INLINE void law_forces(const clast_dem *dem, const clx_batch *p, int from, law_case which,
                           contact_lanes *m)
{
    clx_lanes along[3], normal[3], slide[3];
    const double dt = dem->config.time_step;
    spring_lanes s = which.is_hertz ? hertz_springs(dem, p, from, which, m)
                                    : linear_springs(dem, p, from, which, m);
    if (which.is_exact) {
        s.elastic *= m->spring[0];
        s.normal_damping *= m->damping[0];
        s.tangential *= m->spring[1];
        s.tangential_damping *= m->damping[1];
    }
    load_normal(p, from, normal);
    const clx_lanes apart = lanes_dot(m->velocity, normal);
    lanes_axpy(along, m->velocity, -apart, normal);
    clx_lanes force = s.elastic - s.normal_damping * apart;
    if (dem->law.clip) {
        force = lanes_pick(force < 0.0, lanes_all(0.0), force);
    }
    m->normal_force = force;
    m->pressed = lanes_size(force);
    m->limit = m->friction * m->pressed;
    if (which.is_rough && dem->law.cohesion != CLAST_DEM_DRY) {
        m->normal_force = force - pull_of(dem, p, from);
    }
    m->inverse = -1.0 / s.tangential;
    for (int c = 0; c < 3; ++c) {
        slide[c] = m->slide[c];
    }
    rotate_slide(normal, m->twirl * dt, slide);
    lanes_axpy(slide, slide, lanes_all(dt), along);
    for (int c = 0; c < 3; ++c) {
        m->slide[c] = slide[c];
        m->drag[c] = s.tangential_damping * along[c];
        m->tangential[c] = -s.tangential * slide[c] - m->drag[c];
    }
}

/// Coulomb's limit of clx_law_force.
CLX_INLINE void slip(const contact_lanes *m, clx_lanes tangential[3], clx_lanes slide[3])
{
    const clx_lanes size2 = lanes_dot(m->tangential, m->tangential);
    const clx_marks slips = size2 > m->limit * m->limit;
    const clx_lanes cut = m->limit / lanes_root(size2);
    for (int c = 0; c < 3; ++c) {
        const clx_lanes t = cut * m->tangential[c];
        slide[c] = lanes_pick(slips, m->inverse * (t + m->drag[c]), m->slide[c]);
        tangential[c] = lanes_pick(slips, t, m->tangential[c]);
    }
}

/// Forces, torques, and what is renewed of the pairs (active_from, slide). Lanes that repeat
/// another write the same bytes to the same place.
CLX_INLINE void write(clx_pair_force *const to[CLX_LANES], clx_dem_pair *const pair[CLX_LANES],
                      clx_marks touching, clx_lanes out[4][4])
{
    for (int i = 0; i < 4; ++i) {
        lanes_transpose(out[i]);
    }
    for (int k = 0; k < 4; ++k) {
        clx_pair_force *p = to[k];
        clx_pair_force *beyond = to[k + CLX_BEYOND];
        lanes_put_row(&pair[k]->active_from, &pair[k + CLX_BEYOND]->active_from, out[3][k]);
        lanes_put_row(p->force, beyond->force, out[0][k]);
        lanes_put_row(p->torque_b, beyond->torque_b, out[1][k]);
        lanes_put_row(p->torque_a, beyond->torque_a, out[2][k]);
    }
    for (int k = 0; k < CLX_LANES; ++k) {
        pair[k]->touches = (uint32_t)touching[k] & 1U;
    }
}

CLX_INLINE clx_lanes where(clx_marks m, clx_lanes x)
{
    return (clx_lanes)(m & (clx_marks)x);
}

/// Coulomb's limit, then the pair forces; 0 where contacts are apart.
CLX_INLINE void write_forces(const clast_dem *dem, const clx_batch *p, int from, law_case which,
                             const contact_lanes *m)
{
    clx_lanes out[4][4]; // force, torque on b and on a, the pair's active_from and slide
    clx_lanes normal[3], tangential[3], slide[3], turning[3], arm[3];
    clx_lanes *force = out[0];
    const clx_lanes gap = lanes_load(p->meet.gap + from);
    const clx_marks touching = ~(gap >= 0.0);
    slip(m, tangential, slide);
    load_normal(p, from, normal);
    out[3][0] = lanes_pick(touching, m->active_from, lanes_load(p->travel + from) + gap);
    for (int c = 0; c < 3; ++c) {
        force[c] = where(touching, tangential[c] + m->normal_force * normal[c]);
        out[3][c + 1] = where(touching, slide[c]);
        turning[c] = dem->config.normal_torque ? force[c] : where(touching, tangential[c]);
    }
    load3(p->arm_b[0] + from, arm);
    lanes_cross(out[1], arm, turning);
    load3(p->meet.point[0] + from, arm);
    lanes_cross(out[2], arm, turning);
    if (which.is_rough && dem->law.rolling > 0.0) {
        clx_lanes rolling[3];
        roll(dem, p, from, m, normal, rolling);
        for (int c = 0; c < 3; ++c) {
            out[1][c] = out[1][c] + where(touching, rolling[c]);
            out[2][c] = out[2][c] + where(touching, rolling[c]);
        }
    }
    force[3] = out[1][3] = out[2][3] = lanes_all(0.0);
    if (which.is_exact) {
        out[1][3] = where(touching, m->load[1]);
        out[2][3] = where(touching, -m->load[0]);
    }
    write(p->to + from, p->pair + from, touching, out);
}

CLX_INLINE void force_of_lanes(const clast_dem *dem, const clx_batch *p, law_case which)
{
    contact_lanes m[CLX_BATCH / CLX_LANES];
    for (int h = 0; h * CLX_LANES < p->n; ++h) {
        approach(dem, p, h * CLX_LANES, which, &m[h]);
        if (which.is_exact) {
            hold(dem, p, h * CLX_LANES, which.has_walls, &m[h]);
        }
    }
    for (int h = 0; h * CLX_LANES < p->n; ++h) {
        law_forces(dem, p, h * CLX_LANES, which, &m[h]);
    }
    for (int h = 0; h * CLX_LANES < p->n; ++h) {
        write_forces(dem, p, h * CLX_LANES, which, &m[h]);
    }
}

/// force_of_lanes, compiled apart for each case that clx_batch_has_law lets in.
CLX_INLINE void batch_force(const clast_dem *dem, const clx_batch *p, clx_batch_kind kind)
{
    const clx_law *law = &dem->law;
    if (dem->laws.n > 0) {
        if (law->kind == CLAST_DEM_HERTZ) {
            force_of_lanes(dem, p, (law_case){.is_hertz = true, .by_materials = true});
        } else {
            force_of_lanes(dem, p, (law_case){.by_materials = true});
        }
    } else if (law->kind == CLAST_DEM_HERTZ) {
        force_of_lanes(dem, p, (law_case){.is_hertz = true, .is_rough = true});
    } else if (law->is_exact) {
        force_of_lanes(dem, p, (law_case){.has_walls = true, .is_exact = true, .is_rough = true});
    } else if (!clx_law_is_plain(law)) {
        force_of_lanes(dem, p, (law_case){.is_rough = true});
    } else if (kind == CLX_BATCH_ANY) {
        force_of_lanes(dem, p, (law_case){.has_walls = true});
    } else {
        force_of_lanes(dem, p, (law_case){0});
    }
}
