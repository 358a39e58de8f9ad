// Semi-implicit Euler: velocities first, then positions and orientations with the new velocities.
//
// Angular momentum is the state, so that it is conserved exactly where no torque acts. A step's
// rotation takes the angular velocity of its middle (predicted by half a step), which conserves the
// energy of a free body too. With `gyroscopic` off the angular velocity is the state, as in the
// reference program.
//
// Four grains move in SIMD lanes (move_lanes.c), others one by one with the same bits.
//
// The force and torque on a grain are first the sum over contacts whose b it is, in the order of
// the list, then the sums over its items' own contacts: the same bytes whatever the threads.
#include "dem/move.h"

#include "base/parallel.h"
#include "dem/fluid.h"
#include "dem/pair_force.h"
#include <clast/settling.h>
#include <math.h>
#include <string.h>

enum { BLOCK = CLX_MOVE_BLOCK };

/// q = exp(w dt / 2) q, by the series to the sixth power of the angle (below rounding for 0.1 rad).
static void turn_by(const double w[3], double dt, double q[4])
{
    double v[3];
    double turned[4];
    v3_scale(v, 0.5 * dt, w);
    const double s = v3_norm2(v);
    const bool is_small = s < 0.01;
    const double sine = is_small ? 1.0 + s * (-1.0 / 6.0 + s * (1.0 / 120.0 - s * (1.0 / 5040.0)))
                                 : sin(sqrt(s)) / sqrt(s);
    const double cosine =
        is_small ? 1.0 + s * (-0.5 + s * (1.0 / 24.0 - s * (1.0 / 720.0))) : cos(sqrt(s));
    const double step[4] = {cosine, sine * v[0], sine * v[1], sine * v[2]};
    q_mul(turned, step, q);
    const double n = 0.5 * (3.0 - (turned[0] * turned[0] + turned[1] * turned[1] +
                                   turned[2] * turned[2] + turned[3] * turned[3]));
    for (int k = 0; k < 4; ++k) {
        q[k] = n * turned[k];
    }
}

/// Angular velocity of a body in this orientation: w = R I^-1 R^T L.
static void angular_velocity_of(clx_dem_body *body, const clx_motion *m, double rotation[3][3],
                                double omega[3])
{
    double in_body[3];
    double w[3];
    m3_to_local(in_body, rotation, m->angular);
    m3_mul(w, body->inverse_inertia, in_body);
    m3_to_world(omega, rotation, w);
    v3_scale(omega, m->inverse_factor, omega);
}

static void turn_round(clx_grain *g, clx_motion *m, const double torque[3], double factor,
                       double dt)
{
    CLAST_ASSERT(g->mass >= 0.0 && g->radius >= 0.0);
    v3_axpy(g->omega, g->omega, 2.5 * dt / (g->mass * g->radius * g->radius), torque);
    v3_scale(g->omega, factor, g->omega);
    turn_by(g->omega, dt, m->orientation);
}

/// Reference program: w += R I^-1 R^T T dt; momentum follows the angular velocity.
static void turn_plainly(clx_dem_body *body, clx_grain *g, clx_motion *m, const double torque[3],
                         double rotation[3][3])
{
    clx_motion torque_only = *m;
    double change[3];
    v3_copy(torque_only.angular, torque);
    angular_velocity_of(body, &torque_only, rotation, change);
    v3_add(g->omega, g->omega, change);
}

static void turn_body(clast_dem *dem, int64_t i, const double torque[3], double factor, double dt)
{
    clx_grain *g = &dem->grain[i];
    clx_motion *m = &dem->motion[i];
    clx_dem_body *body = &dem->body[g->shape];
    double impulse[3];
    v3_scale(impulse, dt, torque);
    if (!dem->config.gyroscopic) {
        turn_plainly(body, g, m, impulse, g->rotation);
        v3_scale(g->omega, factor, g->omega);
        if (dem->config.fluid_viscosity > 0.0) {
            clx_fluid_damp_rotation(dem, i, dt, g->omega);
        }
        turn_by(g->omega, dt, m->orientation);
    } else {
        double half[4];
        double middle[3][3];
        v3_add(m->angular, m->angular, impulse);
        v3_scale(m->angular, factor, m->angular);
        if (dem->config.fluid_viscosity > 0.0) {
            clx_fluid_damp_rotation(dem, i, dt, m->angular);
        }
        for (int k = 0; k < 4; ++k) {
            half[k] = m->orientation[k];
        }
        turn_by(g->omega, 0.5 * dt, half);
        q_matrix(middle, half);
        angular_velocity_of(body, m, middle, g->omega);
        turn_by(g->omega, dt, m->orientation);
    }
    q_matrix(g->rotation, m->orientation);
    if (dem->config.gyroscopic) {
        angular_velocity_of(body, m, g->rotation, g->omega);
    }
}

/// Drag of a fluid at rest: implicit in the speed, so that it never reverses a velocity.
static double drag_factor(const clast_dem *dem, const clx_grain *g, const clx_motion *m, double dt)
{
    const double mu = dem->config.fluid_viscosity;
    const double d = 2.0 * g->round_radius;
    const double speed = v3_norm(g->velocity);
    const double stokes = 3.0 * CLAST_PI * mu * d * m->drag[0];
    const clast_drag form = {m->drag[0], m->drag[1]};
    const double re = dem->config.fluid_density * speed * d / mu;
    const double rate = re > 1e-6 ? 0.125 * CLAST_PI * dem->config.fluid_density * d * d * speed *
                                        clx_fluid_drag(dem, g, re, &form)
                                  : stokes;
    return 1.0 /
           (1.0 + dt * rate * clx_fluid_hindrance(dem, g, re) / (g->mass * clx_heavier(dem, m)));
}

void clx_dem_arm(const clast_dem *dem, const clx_grain *g, double arm[3])
{
    double rotation[3][3];
    memcpy(rotation, g->rotation, sizeof rotation);
    m3_to_world(arm, rotation, dem->body[g->shape].shape.own.centre);
    v3_scale(arm, -g->scale, arm);
}

/// Buoyancy and drag act at the centre of volume, other forces at the centre of mass: the torque of
/// that.
static void add_fluid_torque(const clast_dem *dem, int64_t i, double torque[3])
{
    const clx_grain *g = &dem->grain[i];
    const clx_motion *m = &dem->motion[i];
    const double dt = dem->config.time_step;
    double arm[3];
    double force[3] = {0.0, 0.0, dem->config.gravity * dem->config.fluid_density * m->volume};
    double turning[3];
    if (dem->config.fluid_viscosity > 0.0) {
        v3_axpy(force, force,
                -g->mass * clx_heavier(dem, m) * (1.0 / drag_factor(dem, g, m, dt) - 1.0) / dt,
                g->velocity);
    }
    clx_dem_arm(dem, g, arm);
    v3_cross(turning, arm, force);
    v3_add(torque, torque, turning);
}

/// Moves one grain's centre; the speed that its surface had at most.
static double shift(const clx_moving *c, int64_t i, const double f[3])
{
    CLAST_ASSERT(c->dem->grain[i].mass >= 0.0);
    clast_dem *dem = c->dem;
    clx_grain *g = &dem->grain[i];
    const clx_motion *m = &dem->motion[i];
    const double dt = dem->config.time_step;
    const double weight = dem->config.gravity * (g->mass - dem->config.fluid_density * m->volume);
    const double inertia = clx_heavier(dem, m);
    const double scale = dt / (g->mass * inertia);
    g->velocity[0] += scale * f[0] + dt * c->shake / inertia;
    g->velocity[1] += scale * f[1];
    g->velocity[2] += scale * (f[2] - weight);
    double factor = c->damping;
    if (dem->config.fluid_viscosity > 0.0) {
        factor *= drag_factor(dem, g, m, dt);
    }
    v3_scale(g->velocity, factor, g->velocity);
    v3_axpy(g->position, g->position, dt, g->velocity);
    return v3_norm(g->velocity);
}

/// Whether an item has used up its margin. Its path tells that it has not, most of the time.
static inline bool is_beyond(clast_dem *dem, int32_t i, double travel)
{
    if (travel < dem->list.limit[i]) {
        return false;
    }
    const double left = dem->list.anchor[i].margin - clx_item_moved(dem, i);
    dem->list.limit[i] = travel + CLX_SURE * left;
    return !(left >= 0.0);
}

/// One grain; true unless it is lost.
static bool move_one(const clx_moving *c, int64_t i, const clx_force_torque *total)
{
    clast_dem *dem = c->dem;
    clx_grain *g = &dem->grain[i];
    const double dt = dem->config.time_step;
    double speed = shift(c, i, total->force);
    const bool is_fine = speed * dt <= c->stride * g->radius;
    if (g->kind == CLAST_SHAPE_SPHERE) {
        const double factor =
            dem->config.fluid_viscosity > 0.0 ? clx_fluid_rotation_factor(dem, g, dt) : 1.0;
        turn_round(g, &dem->motion[i], total->torque, c->damping * factor, dt);
    } else {
        turn_body(dem, i, total->torque, c->damping, dt);
        speed += v3_norm(g->omega) * g->radius * (1.0 + 1e-6);
    }
    dem->travel[i] += dt * speed;
    return is_fine;
}

CLX_FOR_EACH_MACHINE
void clx_move_incoming(const clx_inner_list *inner, int64_t g, clx_force_torque *total)
{
    CLAST_ASSERT(inner->in_begin[g] <= inner->in_begin[g + 1] &&
                 inner->in_begin[g + 1] <= inner->n);
    clx_lanes force = lanes_all(0.0);
    clx_lanes torque = lanes_all(0.0);
    for (int32_t k = inner->in_begin[g]; k < inner->in_begin[g + 1]; ++k) {
        const clx_pair_force *pair = &inner->force[inner->in[k]];
        force += lanes_load(pair->force);
        torque += lanes_load(pair->torque_b);
    }
    lanes_store(total->force, force);
    lanes_store(total->torque, torque);
}

/// Sum of the pair forces on grain g.
static inline clx_force_torque total_of(const clast_dem *dem, int64_t g)
{
    const clx_inner_list *inner = &dem->inner;
    clx_force_torque total;
    clx_move_incoming(inner, g, &total);
    const int64_t first = dem->item_begin != NULL ? dem->item_begin[g] : g;
    const int64_t last = dem->item_begin != NULL ? dem->item_begin[g + 1] : g + 1;
    for (int64_t i = first; i < last; ++i) {
        clx_lanes own = lanes_all(0.0);
        clx_lanes turning = lanes_all(0.0);
        for (int32_t k = inner->begin[i]; k < inner->begin[i + 1]; ++k) {
            own -= lanes_load(inner->force[k].force);
            turning -= lanes_load(inner->force[k].torque_a);
        }
        lanes_store(total.force, lanes_load(total.force) + own);
        lanes_store(total.torque, lanes_load(total.torque) + turning);
    }
    if (dem->item_begin != NULL && dem->body[dem->grain[g].shape].shape.own.is_mixed) {
        add_fluid_torque(dem, g, total.torque);
    }
    return total;
}

/// Whether an item of the grain has used up its margin.
static bool is_grain_due(clast_dem *dem, int64_t i)
{
    if (dem->item == NULL) {
        return is_beyond(dem, (int32_t)i, dem->travel[i]);
    }
    bool is_due = false;
    clx_items_place(dem, (int32_t)i);
    for (int32_t k = dem->item_begin[i]; k < dem->item_begin[i + 1]; ++k) {
        is_due = is_beyond(dem, k, dem->travel[i]) || is_due;
    }
    return is_due;
}

/// clx_move_flag of n grains that have just moved.
static int flag_of(clast_dem *dem, int64_t first, int n)
{
    int flag = 0;
    for (int64_t i = first; i < first + n; ++i) {
        flag |= dem->travel[i] > dem->inner.until[i] ? CLX_MOVE_INNER_DUE : 0;
        flag |= is_grain_due(dem, i) ? CLX_MOVE_DUE : 0;
    }
    return flag;
}

static int move_group(const clx_moving *c, int64_t first, int n, const clx_force_torque *total)
{
    CLAST_ASSERT(n >= 1 && n <= CLX_MOVE_MOST && first + n <= c->dem->n_grain);
    clast_dem *dem = c->dem;
    int flag = 0;
    for (int k = 0; k < n && dem->law.is_exact; ++k) {
        dem->grain[first + k].held = total[k].torque[3];
    }
    if (clx_move_has_lanes(dem, first, n) && clx_move_lanes(c, first, n, total, &flag)) {
        const bool is_sure = dem->item == NULL && (flag & CLX_MOVE_DUE) == 0;
        return is_sure ? flag : (flag & CLX_MOVE_LOST) | flag_of(dem, first, n);
    }
    for (int k = 0; k < n; ++k) {
        flag |= move_one(c, first + k, &total[k]) ? 0 : CLX_MOVE_LOST;
    }
    return flag | flag_of(dem, first, n);
}

/// The rank's own among them, in groups as large as they come. Never inlined: one rank must not pay
/// for it.
__attribute__((noinline)) static int move_own(const clx_moving *c, int64_t first, int n,
                                              const clx_force_torque *total)
{
    const uint8_t *is_ghost = c->dem->is_ghost;
    int flag = 0;
    for (int k = 0; k < n;) {
        int end = k;
        while (end < n && is_ghost[first + end] == 0) {
            ++end;
        }
        for (int m = 0; k < end; k += m) {
            m = clx_lanes_from(k, end);
            flag |= move_group(c, first + k, m, total + k);
        }
        k = end + 1;
    }
    return flag;
}

int clx_move_group(const clx_moving *c, int64_t first, int n, const clx_force_torque *total)
{
    return c->dem->is_ghost == NULL ? move_group(c, first, n, total) : move_own(c, first, n, total);
}

CLX_FOR_EACH_MACHINE
static void move_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const clx_moving *c = context;
    int flag = 0;
    (void)worker;
    int n = 0;
    for (int64_t i = begin; i < end; i += n) {
        clx_force_torque total[CLX_MOVE_MOST];
        n = clx_lanes_from(i, end);
        for (int k = 0; k < n; ++k) {
            total[k] = total_of(c->dem, i + k);
        }
        flag |= clx_move_group(c, i, n, total);
    }
    c->dem->block_flag[begin / BLOCK] = (uint8_t)flag;
}

/// Acceleration of eq. 14 at this time.
static double shaking(const clast_dem *dem)
{
    const clast_dem_drive *d = &dem->drive;
    if (d->shake_amplitude == 0.0) {
        return 0.0;
    }
    const double w = 2.0 * CLAST_PI / d->shake_period;
    return d->shake_amplitude * w * w * sin(w * clx_dem_time(dem));
}

clx_moving clx_move_begin(clast_dem *dem)
{
    return (clx_moving){.dem = dem,
                        .shake = shaking(dem),
                        .damping = pow(dem->drive.damping, dem->config.time_step),
                        .stride = dem->stride};
}

bool clx_move_end(clast_dem *dem, int flag)
{
    dem->list.is_due = dem->list.is_due || (flag & CLX_MOVE_DUE) != 0;
    dem->inner.is_due = dem->inner.is_due || (flag & CLX_MOVE_INNER_DUE) != 0;
    return (flag & CLX_MOVE_LOST) == 0;
}

bool clx_move(clast_dem *dem)
{
    const int64_t n_block = (dem->n_grain + BLOCK - 1) / BLOCK;
    clx_moving c = clx_move_begin(dem);
    int flag = 0;
    clx_dem_for(dem, dem->n_grain, BLOCK, move_block, &c);
    for (int64_t b = 0; b < n_block; ++b) {
        flag |= dem->block_flag[b];
    }
    return clx_move_end(dem, flag);
}
