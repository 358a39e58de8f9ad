// Where the energy of a simulation goes.
//
// A step's forces F take a velocity from v to v' = v + dt F / m; they have done dt F (v + v') / 2,
// which is the change of kinetic energy to the last digit, and so has each of them. So the book
// takes the discrete work of the forces that act, contact by contact, and its rest is rounding.
// Since velocities stand in the middle between two positions, springs are taken there, too: of a
// linear spring at overlaps d before and d' after, k d d' / 2 is what the steps have put in,
// exactly.                                                                     [docs/theory/load.md
// "Energy"]
//
// A grain's share of a step is added up in the order of its contacts, and the shares of all grains
// and steps without rounding: the same bytes whatever the threads and ranks.
#include "dem/energy.h"

#include "base/alloc.h"
#include "dem/cell.h"
#include "dem/move.h"
#include "dem/pair_force.h"
#include <math.h>
#include <string.h>

enum { BLOCK = 256 };

void clx_energy_destroy(clx_energy *energy)
{
    if (energy != NULL) {
        CLX_FREE(energy->grain, energy->slide, energy->part, energy);
    }
}

void clx_energy_merge(const clx_energy *energy, clx_exact_sum sum[CLX_N_WORK])
{
    memset(sum, 0, CLX_N_WORK * sizeof *sum);
    for (int32_t w = 0; w < energy->n_part; ++w) {
        for (int k = 0; k < CLX_N_WORK; ++k) {
            clx_exact_merge(&sum[k], &energy->part[w][k]);
        }
    }
}

static void sum_works(const clx_energy *energy, double sum[CLX_N_WORK])
{
    clx_exact_sum all[CLX_N_WORK];
    clx_energy_merge(energy, all);
    for (int k = 0; k < CLX_N_WORK; ++k) {
        sum[k] = clx_exact_value(&all[k]);
    }
}

void clx_energy_set(clx_energy *energy, const clx_exact_sum sum[CLX_N_WORK])
{
    memset(energy->part, 0, (size_t)energy->n_part * sizeof *energy->part);
    memcpy(energy->part[0], sum, sizeof energy->part[0]);
}

void clx_energy_add(clx_energy *energy, int32_t worker, const double share[CLX_N_WORK])
{
    for (int k = 0; k < CLX_N_WORK; ++k) {
        if (share[k] != 0.0 && isfinite(share[k])) {
            clx_exact_add(&energy->part[worker][k], share[k]);
        }
    }
}

/// A part for each worker.
static clast_status reserve_parts(clx_energy *energy)
{
    clast_status status = CLAST_OK;
    const int32_t n = clx_parallel_workers();
    if (n > energy->n_part) {
        CLX_TRY(clx_realloc(&energy->part, n, sizeof *energy->part));
        memset(&energy->part[energy->n_part], 0,
               (size_t)(n - energy->n_part) * sizeof *energy->part);
        energy->n_part = n;
    }
done:
    return status;
}

/// Angular momentum of a grain that turns like this, in its present orientation.
static void momentum_of(const clast_dem *dem, const clx_grain *g, const clx_motion *m,
                        const double omega[3], double momentum[3])
{
    double in_body[3];
    double l[3];
    double rotation[3][3];
    memcpy(rotation, g->rotation, sizeof rotation);
    if (g->kind == CLAST_SHAPE_SPHERE) {
        v3_scale(momentum, 0.4 * g->mass * g->radius * g->radius, omega);
        return;
    }
    m3_to_local(in_body, rotation, omega);
    m3_mul(l, dem->body[g->shape].inertia, in_body);
    v3_scale(l, m->inertia_factor, l);
    m3_to_world(momentum, rotation, l);
}

/// Its angular velocity with this momentum, in the orientation `from`.
static void omega_of(const clast_dem *dem, const clx_grain *g, const clx_motion *m,
                     const double from[3][3], const double momentum[3], double omega[3])
{
    double in_body[3];
    double w[3];
    double rotation[3][3];
    memcpy(rotation, from, sizeof rotation);
    if (g->kind == CLAST_SHAPE_SPHERE) {
        v3_scale(omega, 2.5 / (g->mass * g->radius * g->radius), momentum);
        return;
    }
    m3_to_local(in_body, rotation, momentum);
    m3_mul(w, dem->body[g->shape].inverse_inertia, in_body);
    m3_to_world(omega, rotation, w);
    v3_scale(omega, m->inverse_factor, omega);
}

static double rotation_of(const clast_dem *dem, int32_t i, const double omega[3])
{
    double momentum[3];
    momentum_of(dem, &dem->grain[i], &dem->motion[i], omega, momentum);
    return 0.5 * v3_dot(momentum, omega);
}

static double translation_of(const clast_dem *dem, int32_t i, const double velocity[3])
{
    return 0.5 * dem->grain[i].mass * clx_heavier(dem, &dem->motion[i]) * v3_norm2(velocity);
}

/// Velocity of b's surface beside that of its grain: of its image, by the cell that moves; of a
/// wall.
static void image_velocity(const clast_dem *dem, const clx_dem_pair *pair, const clx_dem_touch *t,
                           double out[3])
{
    v3_set(out, 0.0, 0.0, 0.0);
    if (pair->b < 0 && clx_walls_move(dem)) {
        double x[3];
        v3_add(x, dem->grain[clx_item_grain(dem, pair->a)].position, t->arm_a);
        clx_wall_velocity(clx_wall_of(dem, pair->b), x, out);
    }
    if (dem->cell != NULL && pair->b >= 0) {
        clx_cell_velocity(dem->cell, &dem->grain[clx_item_grain(dem, pair->a)],
                          &dem->grain[clx_item_grain(dem, pair->b)], t->arm_a, t->arm_b, out);
    }
}

/// Share of its springs that a contact has: clumps divide them.
static double share_of(const clast_dem *dem, const clx_dem_pair *pair)
{
    return dem->config.clump_contacts == CLAST_DEM_SHARED ? 1.0 / clx_sub_contacts(dem, pair) : 1.0;
}

/// A contact as its law sees it now; histories stay.
static void meet(const clast_dem *dem, const clx_dem_pair *pair, const clx_dem_touch *t,
                 clx_meeting *m)
{
    const clx_contact_history *own = clx_pair_history(dem, pair);
    clx_contact_history history = own != NULL ? *own : (clx_contact_history){0};
    clx_meet_pair(dem, pair, &history, t, m);
    if (dem->law.is_exact) {
        double load[2];
        const clx_grain *a = &dem->grain[clx_item_grain(dem, pair->a)];
        const clx_grain *b =
            pair->b >= 0 ? &dem->grain[clx_item_grain(dem, pair->b)] : &clx_immovable;
        clx_hold_pair(clx_pair_law(dem, pair), a, b, t, m, load);
    }
}

/// Stiffness of the tangential spring as the book has it: without friction the law stretches it so
/// that spring and dashpot cancel, and it holds nothing.
static double tangential_of(const clx_meeting *m, const clx_springs *s)
{
    return m->friction > 0.0 ? s->tangential : 0.0;
}

/// What the springs of a contact hold at the middle of the step.
static void add_held(const clast_dem *dem, const clx_dem_pair *pair, clx_energy_held *held)
{
    const clx_law *law = clx_pair_law(dem, pair);
    clx_dem_touch t;
    clx_meeting m;
    double ahead[3];
    const double dt = dem->config.time_step;
    if (!clx_pair_holds(dem, pair, &t)) {
        return;
    }
    meet(dem, pair, &t, &m);
    const double share = share_of(dem, pair);
    const double apart = v3_dot(m.velocity, m.normal);
    const double before = m.overlap + dt * apart;
    const double mean_overlap = 0.5 * (before + m.overlap);
    m.overlap = dem->law.has_neck ? mean_overlap : sqrt(fmax(before, 0.0) * fmax(m.overlap, 0.0));
    const clx_springs s = clx_law_springs(law, &m);
    v3_copy(ahead, pair->slide);
    clx_law_rotate(&m, dt, ahead);
    v3_axpy(ahead, ahead, dt, m.velocity);
    v3_axpy(ahead, ahead, -v3_dot(ahead, m.normal), m.normal);
    held->normal +=
        share * (dem->law.has_neck
                     ? clx_law_energy(law, m.overlap, 0.0, m.mass, m.radius)
                     : (dem->law.kind == CLAST_DEM_LINEAR ? 0.5 : 0.4) * s.elastic * m.overlap);
    held->tangential += share * 0.5 * tangential_of(&m, &s) * v3_dot(pair->slide, ahead);
    // a pull that grows with the overlap is a spring, too; a constant one has its way
    held->attraction -= law->cohesion == CLAST_DEM_AREA
                            ? share * 0.5 * clx_law_pull(law, &m) * m.overlap
                            : share * clx_law_pull(law, &m) * mean_overlap;
}

clx_energy_held clx_energy_held_now(const clast_dem *dem)
{
    clx_energy_held held = {0};
    for (int32_t i = 0; i < dem->n_grain; ++i) {
        held.translation += translation_of(dem, i, dem->grain[i].velocity);
        held.rotation += rotation_of(dem, i, dem->grain[i].omega);
    }
    for (int64_t k = 0; k < dem->list.n_pair; ++k) {
        add_held(dem, &dem->list.pair[k], &held);
    }
    return held;
}

clast_status clast_dem_begin_energy(clast_dem *dem)
{
    CLX_ARGUMENTS(dem);
    clast_status status = CLAST_OK;
    clx_energy *made = NULL;
    for (int32_t i = 0; i < dem->n_body; ++i) {
        CLX_CHECK(!dem->body[i].shape.own.is_mixed || dem->config.fluid_density <= 0.0,
                  CLAST_E_CONFIG,
                  "shape %s has parts of several densities, and a fluid exerts a torque on it, "
                  "whose work is not recorded; take fluid_density 0",
                  dem->body[i].shape.name);
    }
    if (dem->energy == NULL) {
        CLX_TRY(clx_alloc(&made, 1, sizeof *made));
        CLX_TRY(reserve_parts(made));
        dem->energy = made;
        made = NULL;
    }
    const clx_energy_held now = clx_energy_held_now(dem);
    const double share[CLX_N_WORK] = {[CLX_WORK_MADE] = now.translation + now.rotation +
                                                        now.normal + now.tangential +
                                                        now.attraction,
                                      [CLX_WORK_NORMAL] = -now.normal,
                                      [CLX_WORK_TANGENTIAL] = -now.tangential,
                                      [CLX_WORK_PULL] = -now.attraction};
    memset(dem->energy->part, 0, (size_t)dem->energy->n_part * sizeof *dem->energy->part);
    clx_energy_add(dem->energy, 0, share);
done:
    clx_energy_destroy(made);
    return status;
}

void clx_energy_added(clast_dem *dem, int32_t first)
{
    for (int32_t i = first; dem->energy != NULL && i < dem->n_grain; ++i) {
        const double share[CLX_N_WORK] = {[CLX_WORK_MADE] =
                                              translation_of(dem, i, dem->grain[i].velocity) +
                                              rotation_of(dem, i, dem->grain[i].omega)};
        clx_energy_add(dem->energy, 0, share);
    }
}

/// Whether another rank moves the grain, and books it.
static bool is_ghost(const clast_dem *dem, int64_t i)
{
    return dem->is_ghost != NULL && dem->is_ghost[i] != 0;
}

void clx_energy_pushed(clast_dem *dem, int32_t i, double square)
{
    if (dem->energy != NULL && !is_ghost(dem, i)) {
        const double share[CLX_N_WORK] = {[CLX_WORK_CELL] = 0.5 * dem->grain[i].mass *
                                                            clx_heavier(dem, &dem->motion[i]) *
                                                            square};
        clx_energy_add(dem->energy, 0, share);
    }
}

clast_status clx_energy_before(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    clx_energy *e = dem->energy;
    CLX_TRY(clx_grow(&e->grain, &e->grain_capacity, dem->n_grain + 1, sizeof *e->grain));
    CLX_TRY(clx_grow(&e->slide, &e->slide_capacity, dem->inner.n + 1, sizeof *e->slide));
    CLX_TRY(reserve_parts(e));
    for (int32_t k = 0; k < dem->inner.n; ++k) {
        v3_copy(e->slide[k], clx_inner_pair(dem, k)->slide);
    }
done:
    return status;
}

/// First of the pairs of the inner list whose a is of grain g, or of a later one.
static int32_t first_pair(const clast_dem *dem, int64_t g)
{
    return dem->inner.begin[dem->item_begin != NULL ? dem->item_begin[g] : g];
}

/// Sum of the pair forces on a grain.
static clx_force_torque total_of(const clast_dem *dem, int64_t g)
{
    clx_force_torque total;
    const clx_inner_list *inner = &dem->inner;
    clx_move_incoming(inner, g, &total);
    for (int32_t k = first_pair(dem, g); k < first_pair(dem, g + 1); ++k) {
        v3_sub(total.force, total.force, inner->force[k].force);
        v3_sub(total.torque, total.torque, inner->force[k].torque_a);
    }
    return total;
}

/// Velocities and kinetic energy after the forces; work of weight and shaking.
static void book_grain(const clast_dem *dem, int32_t i, double shake, double sum[CLX_N_WORK])
{
    clx_energy_grain *out = &dem->energy->grain[i];
    const clx_grain *g = &dem->grain[i];
    const clx_motion *m = &dem->motion[i];
    const double dt = dem->config.time_step;
    const clx_force_torque total = total_of(dem, i);
    const double weight = dem->config.gravity * (g->mass - dem->config.fluid_density * m->volume);
    const double force[3] = {total.force[0] + g->mass * shake, total.force[1],
                             total.force[2] - weight};
    double velocity[3];
    double impulse[3];
    double omega[3];
    v3_axpy(velocity, g->velocity, dt / (g->mass * clx_heavier(dem, m)), force);
    v3_scale(impulse, dt, total.torque);
    omega_of(dem, g, m, g->rotation, impulse, omega);
    v3_add(omega, g->omega, omega);
    for (int c = 0; c < 3; ++c) {
        out->velocity[c] = 0.5 * (g->velocity[c] + velocity[c]);
        out->omega[c] = 0.5 * (g->omega[c] + omega[c]);
    }
    out->kinetic[0] = translation_of(dem, i, velocity);
    out->kinetic[1] = rotation_of(dem, i, omega);
    memcpy(out->rotation, g->rotation, sizeof out->rotation);
    sum[CLX_WORK_GRAVITY] -= dt * weight * out->velocity[2];
    sum[CLX_WORK_SHAKING] += dt * g->mass * shake * out->velocity[0];
}

/// A contact's surfaces: mean relative velocity over the step's forces, and the work of its whole
/// force on its grains.
typedef struct {
    double velocity[3];
    double apart; ///< along the normal
    double work, rolling;
    double cell; ///< of the image's motion, or of the wall's
} moved;

static moved move_of(const clast_dem *dem, const clx_dem_pair *pair, const clx_dem_touch *t,
                     const clx_pair_force *f)
{
    static const clx_energy_grain at_rest = {0};
    const double dt = dem->config.time_step;
    const clx_energy_grain *a = &dem->energy->grain[clx_item_grain(dem, pair->a)];
    const clx_energy_grain *b =
        pair->b >= 0 ? &dem->energy->grain[clx_item_grain(dem, pair->b)] : &at_rest;
    moved out;
    double u[3];
    double w[3];
    double shift[3];
    double image[3];
    image_velocity(dem, pair, t, image);
    v3_sub(shift, b->velocity, a->velocity);
    out.work = dt * (v3_dot(f->force, shift) + v3_dot(f->torque_b, b->omega) -
                     v3_dot(f->torque_a, a->omega));
    out.cell = dt * v3_dot(f->force, image);
    v3_add(shift, shift, image);
    v3_cross(u, a->omega, t->arm_a);
    v3_cross(w, b->omega, t->arm_b);
    v3_sub(out.velocity, w, u);
    v3_add(out.velocity, out.velocity, shift);
    out.apart = v3_dot(dem->config.normal_torque ? out.velocity : shift, t->normal);
    out.rolling = 0.0;
    if (clx_pair_law(dem, pair)->rolling > 0.0) {
        double turning[3];
        double torque[3];
        v3_copy(turning, f->force);
        if (!dem->config.normal_torque) {
            v3_axpy(turning, turning, -v3_dot(turning, t->normal), t->normal);
        }
        v3_cross(torque, t->arm_b, turning);
        v3_sub(torque, f->torque_b, torque);
        v3_sub(w, b->omega, a->omega);
        if (pair->b < 0 && clx_walls_move(dem)) {
            const clx_wall_body *wall = clx_wall_of(dem, pair->b);
            v3_add(w, w, wall->omega);
            out.cell += dt * v3_dot(torque, wall->omega);
        }
        out.rolling = dt * v3_dot(torque, w);
    }
    return out;
}

/// A slip of the tangential spring is beyond rounding.
static const double SLIDES = 1e-9;

/// Books a touching contact. `old` is its tangential displacement before.
static void book_pair(const clast_dem *dem, const clx_dem_pair *pair, const clx_pair_force *f,
                      const double old[3], double sum[CLX_N_WORK])
{
    const double dt = dem->config.time_step;
    const int wall = pair->b < 0 ? 1 : 0;
    const double share = share_of(dem, pair);
    const clx_law *law = clx_pair_law(dem, pair);
    clx_dem_touch t = {0};
    clx_meeting m = {0};
    double turned[3];
    double before[3];
    double trial[3];
    double slip[3];
    double along[3];
    clx_find_again(dem, pair, &t);
    meet(dem, pair, &t, &m);
    const clx_springs s = clx_law_held_springs(law, &m);
    const moved by = move_of(dem, pair, &t, f);
    v3_copy(turned, old);
    clx_law_rotate(&m, dt, turned);
    v3_axpy(along, m.velocity, -v3_dot(m.velocity, m.normal), m.normal);
    v3_axpy(trial, turned, dt, along);
    v3_sub(slip, trial, pair->slide);
    v3_copy(before, turned);
    v3_add(turned, turned, pair->slide);
    const double spring = dt * share * s.elastic * by.apart;
    const double pull = -dt * share * clx_law_pull(law, &m) * by.apart;
    const double normal = dt * v3_dot(f->force, t.normal) * by.apart;
    const double stiffness = tangential_of(&m, &s);
    const double across = -dt * share * stiffness * v3_dot(pair->slide, by.velocity);
    const double sheared = by.work + by.cell - normal - by.rolling - across;
    sum[CLX_WORK_NORMAL] += spring;
    sum[CLX_WORK_PULL] += pull;
    sum[CLX_WORK_TANGENTIAL] += across;
    sum[pair->b < 0 ? CLX_WORK_WALLS : CLX_WORK_CELL] -= by.cell;
    sum[CLX_LOST_DAMPING + wall] -= normal - spring - pull;
    sum[CLX_LOST_ROLLING + wall] -= by.rolling;
    if (v3_norm2(slip) > SLIDES * SLIDES * v3_norm2(trial)) {
        // A dashpot that alone exceeds the limit stretches the spring against the force (xi . F >
        // 0): energy that the law makes and takes back, which is no friction.
        const bool is_stretched =
            v3_dot(pair->slide, f->force) >
                v3_dot(pair->slide, t.normal) * v3_dot(f->force, t.normal) ||
            v3_dot(before, f->force) > v3_dot(before, t.normal) * v3_dot(f->force, t.normal);
        const double slipped = 0.5 * share * stiffness * v3_dot(turned, slip);
        sum[CLX_LOST_SLIDING] -= sheared;
        if (m.friction > 0.0) {
            sum[CLX_LOST_FRICTION + wall] +=
                fmax((is_stretched ? -across : slipped) - sheared, 0.0);
        }
    } else {
        sum[CLX_LOST_DAMPING + wall] -= sheared;
    }
}

typedef struct {
    clast_dem *dem;
    clx_moving moving;
} booking;

static void book_grains(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const booking *b = context;
    for (int64_t i = begin; i < end; ++i) {
        double share[CLX_N_WORK] = {0.0};
        if (!is_ghost(b->dem, i)) {
            book_grain(b->dem, (int32_t)i, b->moving.shake, share);
            clx_energy_add(b->dem->energy, worker, share);
        }
    }
}

/// Contacts of the grains whose number is their lower one.
static void book_pairs(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const booking *b = context;
    clast_dem *dem = b->dem;
    const clx_inner_list *inner = &dem->inner;
    for (int64_t i = begin; i < end; ++i) {
        double share[CLX_N_WORK] = {0.0};
        for (int32_t k = first_pair(dem, i); k < first_pair(dem, i + 1) && !is_ghost(dem, i); ++k) {
            const clx_dem_pair *pair = clx_inner_pair(dem, k);
            if (pair->touches != 0) {
                book_pair(dem, pair, &inner->force[k], dem->energy->slide[k], share);
            }
        }
        clx_energy_add(dem->energy, worker, share);
    }
}

void clx_energy_grains(clast_dem *dem)
{
    booking b = {.dem = dem, .moving = clx_move_begin(dem)};
    clx_dem_for(dem, dem->n_grain, BLOCK, book_grains, &b);
}

void clx_energy_contacts(clast_dem *dem)
{
    booking b = {.dem = dem};
    clx_dem_for(dem, dem->n_grain, BLOCK, book_pairs, &b);
}

/// What damping and the fluid took of a grain, and what its turning in a finite step made.
static void book_motion(const clast_dem *dem, int32_t i, double damping, double sum[CLX_N_WORK])
{
    const clx_energy_grain *before = &dem->energy->grain[i];
    const clx_grain *g = &dem->grain[i];
    const clx_motion *m = &dem->motion[i];
    const double left = damping * damping;
    const double turning = rotation_of(dem, i, g->omega);
    const double kept = left * before->kinetic[1];
    double in_place = turning; // rotation as long as it had not turned
    sum[CLX_LOST_CALM] += (1.0 - left) * (before->kinetic[0] + before->kinetic[1]);
    if (g->kind != CLAST_SHAPE_SPHERE && dem->config.gyroscopic) {
        double omega[3];
        omega_of(dem, g, m, before->rotation, m->angular, omega);
        in_place = 0.5 * v3_dot(m->angular, omega);
    } else if (g->kind != CLAST_SHAPE_SPHERE) {
        clx_grain still = *g;
        double momentum[3];
        memcpy(still.rotation, before->rotation, sizeof still.rotation);
        momentum_of(dem, &still, m, g->omega, momentum);
        in_place = 0.5 * v3_dot(momentum, g->omega);
    }
    sum[CLX_MADE_BY_TURNING] += turning - in_place;
    if (dem->config.fluid_viscosity > 0.0) {
        sum[CLX_LOST_FLUID] +=
            left * before->kinetic[0] - translation_of(dem, i, g->velocity) + kept - in_place;
    }
}

static void book_motions(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const booking *b = context;
    for (int64_t i = begin; i < end; ++i) {
        double share[CLX_N_WORK] = {0.0};
        if (!is_ghost(b->dem, i)) {
            book_motion(b->dem, (int32_t)i, b->moving.damping, share);
            clx_energy_add(b->dem->energy, worker, share);
        }
    }
}

void clx_energy_after(clast_dem *dem)
{
    booking b = {.dem = dem, .moving = clx_move_begin(dem)};
    clx_dem_for(dem, dem->n_grain, BLOCK, book_motions, &b);
}

void clast_dem_energy_measure(const clast_dem *dem, clast_dem_energy *energy)
{
    if (dem == NULL || energy == NULL || dem->energy == NULL) {
        return;
    }
    double sum[CLX_N_WORK];
    sum_works(dem->energy, sum);
    const clx_energy_held now = clx_energy_held_now(dem);
    clast_dem_energy e = {.translation = now.translation,
                          .rotation = now.rotation,
                          .normal_springs = now.normal,
                          .tangential_springs = now.tangential,
                          .attraction = now.attraction,
                          .made = sum[CLX_WORK_MADE],
                          .gravity = sum[CLX_WORK_GRAVITY],
                          .shaking = sum[CLX_WORK_SHAKING],
                          .cell = sum[CLX_WORK_CELL],
                          .walls = sum[CLX_WORK_WALLS],
                          .left = sum[CLX_LEFT],
                          .fluid = sum[CLX_LOST_FLUID],
                          .calming = sum[CLX_LOST_CALM]};
    double lost = 0.0;
    for (int k = 0; k < 2; ++k) {
        e.damping[k] = sum[CLX_LOST_DAMPING + k];
        e.friction[k] = sum[CLX_LOST_FRICTION + k];
        e.rolling[k] = sum[CLX_LOST_ROLLING + k];
        lost += e.damping[k] + e.friction[k] + e.rolling[k];
    }
    e.scheme = sum[CLX_LOST_SLIDING] - e.friction[0] - e.friction[1] - sum[CLX_WORK_NORMAL] -
               sum[CLX_WORK_TANGENTIAL] - sum[CLX_WORK_PULL] - now.normal - now.tangential -
               now.attraction - sum[CLX_MADE_BY_TURNING];
    e.put_in = e.made + e.gravity + e.shaking + e.cell + e.walls;
    e.rest = e.put_in - (e.translation + e.rotation + e.normal_springs + e.tangential_springs +
                         e.attraction + lost + e.fluid + e.calming + e.left + e.scheme);
    *energy = e;
}
