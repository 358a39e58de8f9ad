// Motion of four or eight grains in SIMD lanes. Each line is that of motion.c, in the same order,
// so that the bits are the same.
#include "dem/move.h"

CLX_INLINE void multiply(const clx_lanes a[4], const clx_lanes b[4], clx_lanes out[4])
{
    out[0] = a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3];
    out[1] = a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2];
    out[2] = a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1];
    out[3] = a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0];
}

CLX_INLINE void matrix(const clx_lanes q[4], clx_lanes m[9])
{
    const clx_lanes w = q[0], x = q[1], y = q[2], z = q[3];
    m[0] = 1.0 - 2.0 * (y * y + z * z);
    m[1] = 2.0 * (x * y - w * z);
    m[2] = 2.0 * (x * z + w * y);
    m[3] = 2.0 * (x * y + w * z);
    m[4] = 1.0 - 2.0 * (x * x + z * z);
    m[5] = 2.0 * (y * z - w * x);
    m[6] = 2.0 * (x * z - w * y);
    m[7] = 2.0 * (y * z + w * x);
    m[8] = 1.0 - 2.0 * (x * x + y * y);
}

/// turn_by, by its series: marks angles that are too large for that.
CLX_INLINE clx_marks turn_by(const clx_lanes w[3], double dt, const clx_lanes q[4],
                             clx_lanes out[4])
{
    clx_lanes v[3], turned[4];
    for (int c = 0; c < 3; ++c) {
        v[c] = 0.5 * dt * w[c];
    }
    const clx_lanes s = lanes_dot(v, v);
    const clx_lanes sine = 1.0 + s * (-1.0 / 6.0 + s * (1.0 / 120.0 - s * (1.0 / 5040.0)));
    const clx_lanes cosine = 1.0 + s * (-0.5 + s * (1.0 / 24.0 - s * (1.0 / 720.0)));
    const clx_lanes step[4] = {cosine, sine * v[0], sine * v[1], sine * v[2]};
    multiply(step, q, turned);
    const clx_lanes n = 0.5 * (3.0 - (turned[0] * turned[0] + turned[1] * turned[1] +
                                      turned[2] * turned[2] + turned[3] * turned[3]));
    for (int k = 0; k < 4; ++k) {
        out[k] = n * turned[k];
    }
    return ~(s < 0.01);
}

/// Four grains in motion.
typedef struct {
    clx_lanes position[4], velocity[4], omega[4], rotation[9]; ///< fourth: radius, mass, scale
    clx_lanes orientation[4], angular[4];                      ///< fourth: the inverse factor
    clx_lanes inverse[9];                                      ///< of the shapes' inertia
    clx_marks is_fast;                                         ///< turns too fast for the series
} grains;

CLX_INLINE void angular_velocity_of(const grains *g, const clx_lanes rotation[9],
                                    clx_lanes omega[3])
{
    clx_lanes in_body[3], w[3];
    lanes_mul_t(in_body, rotation, g->angular);
    lanes_mul(w, g->inverse, in_body);
    lanes_mul(omega, rotation, w);
    for (int c = 0; c < 3; ++c) {
        omega[c] = g->angular[3] * omega[c];
    }
}

CLX_INLINE void read_body(clast_dem *dem, int64_t i, grains *g)
{
    const clx_motion *m = &dem->motion[i];
    const double *inverse[CLX_LANES];
    lanes_gather(g->angular, m[0].angular, m[1].angular, m[2].angular, m[3].angular);
    for (int k = 0; k < CLX_LANES; ++k) {
        inverse[k] = (const double *)dem->body[dem->grain[i + k].shape].inverse_inertia;
    }
    lanes_gather(g->inverse, inverse[0], inverse[1], inverse[2], inverse[3]);
    lanes_gather(g->inverse + 4, inverse[0] + 4, inverse[1] + 4, inverse[2] + 4, inverse[3] + 4);
    g->inverse[8] = (clx_lanes){inverse[0][8], inverse[1][8], inverse[2][8], inverse[3][8]};
}

/// Angular velocities, orientations and torques.
CLX_INLINE void read_rotation(clast_dem *dem, int64_t i, const clx_force_torque total[CLX_LANES],
                              grains *g, clx_lanes torque[4])
{
    const clx_grain *from = &dem->grain[i];
    const clx_motion *m = &dem->motion[i];
    lanes_gather(torque, total[0].torque, total[1].torque, total[2].torque, total[3].torque);
    lanes_gather(g->omega, from[0].omega, from[1].omega, from[2].omega, from[3].omega);
    lanes_gather(g->orientation, m[0].orientation, m[1].orientation, m[2].orientation,
                 m[3].orientation);
}

/// turn_body as far as the angular velocity of the middle of the step.
CLX_INLINE void turn_half(const clx_moving *c, int64_t i, const clx_force_torque total[CLX_LANES],
                          grains *g)
{
    clx_lanes half[4], middle[9], torque[4];
    const double dt = c->dem->config.time_step;
    read_rotation(c->dem, i, total, g, torque);
    read_body(c->dem, i, g);
    for (int k = 0; k < 3; ++k) {
        g->angular[k] = c->damping * (g->angular[k] + dt * torque[k]);
    }
    g->is_fast = turn_by(g->omega, 0.5 * dt, g->orientation, half);
    matrix(half, middle);
    angular_velocity_of(g, middle, g->omega);
}

/// The rest of turn_body.
CLX_INLINE void turn_whole(double dt, grains *g)
{
    clx_lanes q[4];
    g->is_fast |= turn_by(g->omega, dt, g->orientation, q);
    for (int k = 0; k < 4; ++k) {
        g->orientation[k] = q[k];
    }
    matrix(q, g->rotation);
    angular_velocity_of(g, g->rotation, g->omega);
}

CLX_INLINE void turn_spheres(const clx_moving *c, int64_t i,
                             const clx_force_torque total[CLX_LANES], grains *g)
{
    clx_lanes q[4], torque[4];
    const double dt = c->dem->config.time_step;
    read_rotation(c->dem, i, total, g, torque);
    const clx_lanes scale = 2.5 * dt / (g->velocity[3] * g->position[3] * g->position[3]);
    for (int k = 0; k < 3; ++k) {
        g->omega[k] = c->damping * (g->omega[k] + scale * torque[k]);
    }
    g->is_fast = turn_by(g->omega, dt, g->orientation, q);
    for (int k = 0; k < 4; ++k) {
        g->orientation[k] = q[k];
    }
}

/// shift
CLX_INLINE void shift_all(const clx_moving *c, int64_t i, const clx_force_torque total[CLX_LANES],
                          grains *g)
{
    const clast_dem *dem = c->dem;
    const clx_grain *from = &dem->grain[i];
    const clx_motion *m = &dem->motion[i];
    const double dt = dem->config.time_step;
    const clx_lanes volume = {m[0].volume, m[1].volume, m[2].volume, m[3].volume};
    clx_lanes force[4];
    lanes_gather(force, total[0].force, total[1].force, total[2].force, total[3].force);
    lanes_gather(g->position, from[0].position, from[1].position, from[2].position,
                 from[3].position);
    lanes_gather(g->velocity, from[0].velocity, from[1].velocity, from[2].velocity,
                 from[3].velocity);
    const clx_lanes weight =
        dem->config.gravity * (g->velocity[3] - dem->config.fluid_density * volume);
    const clx_lanes scale = dt / g->velocity[3];
    g->velocity[0] += scale * force[0] + dt * c->shake;
    g->velocity[1] += scale * force[1];
    g->velocity[2] += scale * (force[2] - weight);
    for (int k = 0; k < 3; ++k) {
        g->velocity[k] = c->damping * g->velocity[k];
        g->position[k] = g->position[k] + dt * g->velocity[k];
    }
}

CLX_INLINE void write_back(clast_dem *dem, int64_t i, bool is_round, const grains *g)
{
    clx_grain *to = &dem->grain[i];
    clx_motion *m = &dem->motion[i];
    lanes_scatter(g->position, to[0].position, to[1].position, to[2].position, to[3].position);
    lanes_scatter(g->velocity, to[0].velocity, to[1].velocity, to[2].velocity, to[3].velocity);
    lanes_scatter(g->omega, to[0].omega, to[1].omega, to[2].omega, to[3].omega);
    lanes_scatter(g->orientation, m[0].orientation, m[1].orientation, m[2].orientation,
                  m[3].orientation);
    if (is_round) {
        return;
    }
    lanes_scatter(g->angular, m[0].angular, m[1].angular, m[2].angular, m[3].angular);
    double *rotation[CLX_LANES]; // nine in a row
    for (int k = 0; k < CLX_LANES; ++k) {
        rotation[k] = (double *)to[k].rotation;
    }
    lanes_scatter(g->rotation, rotation[0], rotation[1], rotation[2], rotation[3]);
    lanes_scatter(g->rotation + 4, rotation[0] + 4, rotation[1] + 4, rotation[2] + 4,
                  rotation[3] + 4);
    for (int k = 0; k < CLX_LANES; ++k) {
        rotation[k][8] = g->rotation[8][k];
    }
}

bool clx_move_has_lanes(const clast_dem *dem, int64_t i, int n)
{
    CLAST_ASSERT(n >= 1 && n <= CLX_MOVE_MOST && i + n <= dem->n_grain);
    const clx_grain *g = &dem->grain[i];
    int n_round = 0;
    for (int k = 0; k < n; ++k) {
        n_round += g[k].kind == CLAST_SHAPE_SPHERE ? 1 : 0;
    }
    return n % CLX_LANES == 0 && dem->config.fluid_viscosity <= 0.0 &&
           dem->config.added_mass <= 0.0 &&
           (n_round == n || (n_round == 0 && dem->config.gyroscopic));
}

/// Adds to the paths; returns clx_move_flag.
CLX_INLINE int add_paths(const clx_moving *c, int64_t i, bool is_round, const grains *g)
{
    clast_dem *dem = c->dem;
    const double dt = dem->config.time_step;
    clx_lanes speed = lanes_root(lanes_dot(g->velocity, g->velocity));
    const clx_marks is_lost = ~(speed * dt <= c->stride * g->position[3]);
    if (!is_round) {
        speed += lanes_root(lanes_dot(g->omega, g->omega)) * g->position[3] * (1.0 + 1e-6);
    }
    const clx_lanes travel = lanes_load(&dem->travel[i]) + dt * speed;
    const clx_marks is_inner_due = travel > lanes_load(&dem->inner.until[i]);
    const clx_marks may_be_due = ~(travel < lanes_load(&dem->list.limit[i]));
    lanes_store(&dem->travel[i], travel);
    if (lanes_bits(is_lost | is_inner_due | may_be_due) == 0) {
        return 0; // most of the time
    }
    return (lanes_bits(is_lost) != 0 ? CLX_MOVE_LOST : 0) |
           (lanes_bits(is_inner_due) != 0 ? CLX_MOVE_INNER_DUE : 0) |
           (lanes_bits(may_be_due) != 0 ? CLX_MOVE_DUE : 0);
}

/// Two groups of four go through each stage before the next: while one waits for its sums, the
/// other goes on.
CLX_INLINE bool move(const clx_moving *c, int64_t i, int n, const clx_force_torque *total,
                     bool is_round, int *flag)
{
    grains g[CLX_MOVE_MOST / CLX_LANES];
    clx_marks is_fast = {0};
    for (int k = 0; k < n; k += CLX_LANES) {
        shift_all(c, i + k, total + k, &g[k / CLX_LANES]);
    }
    for (int k = 0; k < n; k += CLX_LANES) {
        if (is_round) {
            turn_spheres(c, i + k, total + k, &g[k / CLX_LANES]);
        } else {
            turn_half(c, i + k, total + k, &g[k / CLX_LANES]);
        }
    }
    for (int k = 0; k < n; k += CLX_LANES) {
        if (!is_round) {
            turn_whole(c->dem->config.time_step, &g[k / CLX_LANES]);
        }
        is_fast |= g[k / CLX_LANES].is_fast;
    }
    if (lanes_bits(is_fast) != 0) {
        return false;
    }
    for (int k = 0; k < n; k += CLX_LANES) {
        *flag |= add_paths(c, i + k, is_round, &g[k / CLX_LANES]);
        write_back(c->dem, i + k, is_round, &g[k / CLX_LANES]);
    }
    return true;
}

CLX_FOR_EACH_MACHINE
bool clx_move_lanes(const clx_moving *c, int64_t i, int n, const clx_force_torque *total, int *flag)
{
    *flag = 0;
    return c->dem->grain[i].kind == CLAST_SHAPE_SPHERE ? move(c, i, n, total, true, flag)
                                                       : move(c, i, n, total, false, flag);
}
