// Motion of the bodies in the fluid for one step.
//
// In a linear flow u = (U + G z, V, W) with fall w and diffusion D the displacement over dt is a
// Gaussian whose moments are known, so that a step of any length is exact away from the borders:
//
//     dz = (W - w) dt + sqrt(2 D dt) a,   dx = (U + G z) dt + G I + sqrt(2 D dt) b
//     I  = (W - w) dt^2 / 2 + sqrt(2 D dt) dt (a / 2 + c / sqrt(12))
//
// with independent standard normals a, b, c. In a user's field the drift is integrated by Runge and
// Kutta's fourth-order step, a quarter of a grid cell at most each. A floor is also met by paths
// that come back above it, with the chance exp(-h0 h1 / (D dt)) of a Brownian bridge.
// [docs/theory/evolve.md section 2]
#include "evolve/state.h"

#include "base/parallel.h"
#include "math/vec3.h"
#include <math.h>

enum { BODIES_A_BLOCK = 1024, BISECTIONS = 48 };

static const double CELLS_A_STEP = 0.25; ///< of a user's field

typedef struct {
    clast_evolve *e;
    double dt;
} motion;

/// A part of a step of one body.
typedef struct {
    const clast_evolve *e;
    double time, dt; ///< when it begins, how long it takes
    clx_rng *rng;
} leg;

/// Velocity of a body of this fall speed in wind, shear and field.
static void velocity_at(const clast_evolve *e, const double x[3], double speed, double u[3])
{
    clx_evolve_wind(e, x[2], u);
    clx_flow_add(&e->flow, x, u);
    u[2] -= speed;
}

/// The drift in a user's field.
static void fly_in_field(const leg *l, const clx_evolve_body *b, double to[3])
{
    static const double at[4] = {0.0, 0.5, 0.5, 1.0};
    static const double weight[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
    double slope[3] = {0.0, 0.0, 0.0};
    double sum[3] = {0.0, 0.0, 0.0};
    for (int k = 0; k < 4; ++k) {
        double x[3];
        v3_axpy(x, b->x, at[k] * l->dt, slope);
        velocity_at(l->e, x, b->speed, slope);
        v3_axpy(sum, sum, weight[k], slope);
    }
    v3_axpy(to, b->x, l->dt, sum);
    for (int k = 0; b->diffusivity > 0.0 && k < 3; ++k) {
        to[k] += sqrt(2.0 * b->diffusivity * l->dt) * clx_rng_normal(l->rng);
    }
}

/// Where a step that meets no border ends.
static void fly(const leg *l, const clx_evolve_body *b, double to[3])
{
    const clast_evolve *e = l->e;
    const double dt = l->dt;
    clx_rng *rng = l->rng;
    if (e->flow.u != NULL) {
        fly_in_field(l, b, to);
        return;
    }
    double u[3];
    clx_evolve_wind(e, b->x[2], u);
    const double shear = e->config->wind_shear;
    const double down = u[2] - b->speed;
    to[0] = b->x[0] + u[0] * dt + 0.5 * shear * down * dt * dt;
    to[1] = b->x[1] + u[1] * dt;
    to[2] = b->x[2] + down * dt;
    if (b->diffusivity > 0.0) {
        const double root = sqrt(2.0 * b->diffusivity * dt);
        const double z = clx_rng_normal(rng);
        to[2] += root * z;
        to[0] += root * clx_rng_normal(rng);
        to[1] += root * clx_rng_normal(rng);
        if (shear != 0.0) {
            to[0] += shear * root * dt * (0.5 * z + clx_rng_normal(rng) / sqrt(12.0));
        }
    }
}

/// A coordinate folded back between two walls.
static double fold(double x, double low, double high)
{
    const double length = high - low;
    double at = fmod(x - low, 2.0 * length);
    at = at < 0.0 ? at + 2.0 * length : at;
    return low + fmin(length, at > length ? 2.0 * length - at : at);
}

static double wrap(double x, double low, double high)
{
    const double at = x - (high - low) * floor((x - low) / (high - low));
    return at < high && at >= low ? at : low;
}

static void end_at(clx_evolve_body *b, int32_t state, double time)
{
    b->state = state;
    b->time = time;
}

/// Share of the step after which a path meets a wall at distance `from` that ends at `to` beyond
/// it (to < 0) or came back; above 1: it does not.
static double meets(const leg *l, const clx_evolve_body *b, double from, double to)
{
    if (to <= 0.0) {
        return from > to ? from / (from - to) : 0.0;
    }
    if (b->diffusivity > 0.0 &&
        clx_rng_uniform(l->rng) < exp(-from * to / (b->diffusivity * l->dt))) {
        return 0.5;
    }
    return 2.0;
}

/// Up and down in a box: the floor, the top.
static double rise(const leg *l, clx_evolve_body *b, double to[3])
{
    const clast_evolve *e = l->e;
    const clast_domain *d = e->input->domain;
    const clast_evolve_config *c = e->config;
    const double low = d->low[2];
    const double high = d->high[2];
    double share = 2.0;
    if (c->floor == CLAST_BORDER_PERIODIC) {
        to[2] = wrap(to[2], low, high);
        return share;
    }
    if (c->floor == CLAST_BORDER_DEPOSIT) {
        share = meets(l, b, b->x[2] - low, to[2] - low);
    }
    if (share <= 1.0) {
        end_at(b, CLX_BODY_ON_FLOOR, l->time + share * l->dt);
        to[2] = low;
    } else if (c->open_top && to[2] > high) {
        share = (high - b->x[2]) / (to[2] - b->x[2]);
        end_at(b, CLX_BODY_OUT, l->time + share * l->dt);
        to[2] = high;
    } else {
        to[2] = fold(to[2], low, high);
    }
    return share;
}

/// To a side of a box.
static void drift(const leg *l, clx_evolve_body *b, double to[3], double share)
{
    const clast_evolve *e = l->e;
    const clast_domain *d = e->input->domain;
    for (int k = 0; k < 2; ++k) {
        const double low = d->low[k];
        const double high = d->high[k];
        if (share <= 1.0) { // where it came down
            to[k] = b->x[k] + share * (to[k] - b->x[k]);
        }
        if (e->config->sides == CLAST_BORDER_PERIODIC) {
            to[k] = wrap(to[k], low, high);
        } else if (e->config->sides == CLAST_BORDER_REFLECT || share <= 1.0) {
            to[k] = fold(to[k], low, high);
        } else if (to[k] < low || to[k] > high) {
            const double wall = to[k] < low ? low : high;
            const double part = (wall - b->x[k]) / (to[k] - b->x[k]);
            end_at(b, CLX_BODY_ON_FLOOR, l->time + part * l->dt);
            to[k] = wall;
            share = part;
        }
    }
}

/// The last point of a path inside of the domain, and its share of the path.
static double leave(const clast_domain *d, const double from[3], const double to[3], double at[3])
{
    double u[3];
    double inside = 0.0;
    double outside = 1.0;
    for (int k = 0; k < BISECTIONS; ++k) {
        const double middle = 0.5 * (inside + outside);
        for (int j = 0; j < 3; ++j) {
            at[j] = from[j] + middle * (to[j] - from[j]);
        }
        *(clast_domain_map(d, at, u) ? &inside : &outside) = middle;
    }
    for (int j = 0; j < 3; ++j) {
        at[j] = from[j] + inside * (to[j] - from[j]);
    }
    return inside;
}

/// Whether straight down leads out of the domain there.
static bool is_floor(const clast_domain *d, const double at[3])
{
    const double size = cbrt(clast_domain_volume(d));
    const double below[3] = {at[0], at[1], at[2] - 1e-6 * size};
    double u[3];
    return !clast_domain_map(d, below, u);
}

/// In a domain that is no box: what leaves stops at the surface, or (reflect) stays where it is.
static void in_surface(const leg *l, clx_evolve_body *b, double to[3])
{
    const clast_evolve *e = l->e;
    const clast_domain *d = e->input->domain;
    double u[3];
    double at[3];
    if (clast_domain_map(d, to, u)) {
        return;
    }
    const double share = leave(d, b->x, to, at);
    const int32_t border = is_floor(d, at) ? e->config->floor : e->config->sides;
    v3_copy(to, at);
    if (border == CLAST_BORDER_DEPOSIT) {
        end_at(b, CLX_BODY_ON_FLOOR, l->time + share * l->dt);
    }
}

/// Parts of a step that are short enough for a user's field.
static int64_t parts_of(const clast_evolve *e, double dt)
{
    return e->flow.u != NULL ? (int64_t)fmax(1.0, ceil(dt * e->flow.fastest / CELLS_A_STEP)) : 1;
}

static void move_body(const leg *l, clx_evolve_body *b)
{
    double to[3];
    fly(l, b, to);
    if (l->e->input->domain->kind == CLAST_DOMAIN_BOX) {
        drift(l, b, to, rise(l, b, to));
    } else {
        in_surface(l, b, to);
    }
    v3_copy(b->x, to);
}

static void move_some(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const motion *m = context;
    clast_evolve *e = m->e;
    const int64_t n_part = parts_of(e, m->dt);
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        clx_evolve_body *b = &e->body[i];
        clx_rng rng = clx_rng_at(e->config->seed, CLX_STREAM_EVOLVE_MOVE,
                                 (e->step << 32) | (uint64_t)(uint32_t)i);
        leg l = {.e = e, .dt = m->dt / (double)n_part, .rng = &rng};
        for (int64_t k = 0; k < n_part && b->state == CLX_BODY_IN_FLUID; ++k) {
            l.time = e->time + l.dt * (double)k;
            move_body(&l, b);
        }
    }
}

void clx_evolve_move(clast_evolve *e, double dt)
{
    CLAST_ASSERT(dt > 0.0);
    motion m = {.e = e, .dt = dt};
    clx_parallel_for(e->n_start, BODIES_A_BLOCK, move_some, &m);
}
