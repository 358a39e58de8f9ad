// Motion of the bodies in the fluid for one step.
//
// In a linear flow u = (U + G z, V, W) with fall w and diffusion D the displacement over dt is a
// Gaussian whose moments are known, so that a step of any length is exact away from the borders:
//
//     dz = (W - w) dt + sqrt(2 D dt) a,   dx = (U + G z) dt + G I + sqrt(2 D dt) b
//     I  = (W - w) dt^2 / 2 + sqrt(2 D dt) dt (a / 2 + c / sqrt(12))
//
// with independent standard normals a, b, c. In a user's field the drift is integrated by Runge and
// Kutta's fourth-order step, a quarter of a grid cell at most each. A wall that keeps what it meets
// is also met by paths that come back from it, with the chance exp(-h0 h1 / (D dt)) of a Brownian
// bridge; where there are several, parts of a step are short beside their distance.
// [docs/theory/evolve.md section 2]
#include "evolve/state.h"

#include "base/parallel.h"
#include "evolve/walls.h"
#include "math/vec3.h"
#include <math.h>

enum { BODIES_A_BLOCK = 1024 };

static const double CELLS_A_STEP = 0.25; ///< of a user's field
static const double MOST_PARTS = 1e6;    ///< of a step of a body

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

/// Not before it was formed: events are told up to the end of the step that moves the body.
static void end_at(clx_evolve_body *b, int32_t state, double time)
{
    b->state = state;
    b->time = fmax(time, b->time);
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

/// The wall of a box that a path meets first.
typedef struct {
    double share; ///< of the step; above 1: none
    int32_t axis, state;
    double place; ///< of the wall
} hit;

/// Looks at the wall at `place`, which lies below (side -1) or above (1) the body.
static void look_at(const leg *l, const clx_evolve_body *b, const double to[3], hit wall,
                    double side, hit *first)
{
    const int32_t k = wall.axis;
    wall.share = meets(l, b, side * (wall.place - b->x[k]), side * (wall.place - to[k]));
    if (wall.share < first->share) {
        *first = wall;
    }
}

/// Of the walls of a box that keep what they meet, or let it out.
static hit first_hit(const leg *l, const clx_evolve_body *b, const double to[3])
{
    const clast_domain *d = l->e->input->domain;
    const clast_evolve_config *c = l->e->config;
    hit first = {.share = 2.0};
    if (c->floor == CLAST_BORDER_DEPOSIT) {
        look_at(l, b, to, (hit){.axis = 2, .state = CLX_BODY_ON_FLOOR, .place = d->low[2]}, -1.0,
                &first);
    }
    if (c->open_top) {
        look_at(l, b, to, (hit){.axis = 2, .state = CLX_BODY_OUT, .place = d->high[2]}, 1.0,
                &first);
    }
    for (int k = 0; c->sides == CLAST_BORDER_DEPOSIT && k < 2; ++k) {
        look_at(l, b, to, (hit){.axis = k, .state = CLX_BODY_ON_FLOOR, .place = d->low[k]}, -1.0,
                &first);
        look_at(l, b, to, (hit){.axis = k, .state = CLX_BODY_ON_FLOOR, .place = d->high[k]}, 1.0,
                &first);
    }
    return first;
}

/// In a box: to the wall that is met first, else folded back or wrapped.
static void in_box(const leg *l, clx_evolve_body *b, double to[3])
{
    const clast_domain *d = l->e->input->domain;
    const clast_evolve_config *c = l->e->config;
    const hit first = first_hit(l, b, to);
    for (int k = 0; k < 3; ++k) {
        const bool is_periodic = (k == 2 ? c->floor : c->sides) == CLAST_BORDER_PERIODIC;
        if (first.share <= 1.0) {
            to[k] = b->x[k] + first.share * (to[k] - b->x[k]);
        }
        to[k] =
            is_periodic ? wrap(to[k], d->low[k], d->high[k]) : fold(to[k], d->low[k], d->high[k]);
    }
    if (first.share <= 1.0) {
        to[first.axis] = first.place;
        end_at(b, first.state, l->time + first.share * l->dt);
    }
}

static int32_t border_at(const clast_evolve *e, const double at[3])
{
    return clx_walls_is_floor(e->input->domain, at) ? e->config->floor : e->config->sides;
}

/// Whether a path that stays inside of a domain has met a wall that keeps it, by the bridge beside
/// the wall's plane; `at`: where.
static bool touches(const leg *l, const clx_evolve_body *b, const double to[3], double at[3])
{
    const clast_domain *d = l->e->input->domain;
    double near[3];
    for (int32_t w = 0; b->diffusivity > 0.0 && w < clx_walls_count(d); ++w) {
        const double h0 = clx_walls_distance(d, b->x, w, near);
        const double h1 = clx_walls_distance(d, to, w, near);
        if (clx_rng_uniform(l->rng) < exp(-h0 * h1 / (b->diffusivity * l->dt)) &&
            border_at(l->e, near) == CLAST_BORDER_DEPOSIT) {
            v3_copy(at, near);
            return true;
        }
    }
    return false;
}

/// The end of a path as a mirror at the wall has it; at the wall where its normal is not known.
static void mirror(const clx_exit *wall, double to[3])
{
    double beyond[3];
    v3_sub(beyond, to, wall->at);
    const double depth = v3_dot(beyond, wall->inward);
    v3_axpy(to, to, -2.0 * fmin(depth, 0.0), wall->inward);
    if (v3_norm2(wall->inward) == 0.0) {
        v3_copy(to, wall->at);
    }
}

/// In a domain that is no box: to the wall that keeps it, or mirrored at walls that do not.
static void in_surface(const leg *l, clx_evolve_body *b, double to[3])
{
    enum { MOST_BOUNCES = 100 };
    const clast_evolve *e = l->e;
    const clast_domain *d = e->input->domain;
    double u[3];
    double from[3];
    double passed = 0.0;
    clx_exit wall;
    v3_copy(from, b->x);
    for (int k = 0; k < MOST_BOUNCES && clx_walls_exit(d, from, to, &wall); ++k) {
        passed += wall.share * (1.0 - passed);
        v3_copy(from, wall.at);
        if (border_at(e, wall.at) == CLAST_BORDER_DEPOSIT) {
            v3_copy(to, wall.at);
            end_at(b, CLX_BODY_ON_FLOOR, l->time + passed * l->dt);
            return;
        }
        mirror(&wall, to);
    }
    if (!clast_domain_map(d, to, u)) { // in a corner, by rounding
        v3_copy(to, from);
    } else if (isfinite(clx_evolve_width(e)) && touches(l, b, to, from)) {
        v3_copy(to, from);
        end_at(b, CLX_BODY_ON_FLOOR, l->time + 0.5 * l->dt);
    }
}

double clx_evolve_least_width(const clast_domain *d)
{
    switch (d->kind) {
    case CLAST_DOMAIN_BOX:
    case CLAST_DOMAIN_MESH:
        return fmin(d->high[0] - d->low[0], fmin(d->high[1] - d->low[1], d->high[2] - d->low[2]));
    case CLAST_DOMAIN_CYLINDER:
        return fmin(2.0 * d->radius, d->length);
    case CLAST_DOMAIN_HALF_PIPE:
        return fmin(d->radius, d->length);
    case CLAST_DOMAIN_SPHERE:
        return 2.0 * d->radius;
    default:
        return INFINITY;
    }
}

double clx_evolve_width(const clast_evolve *e)
{
    const clast_domain *d = e->input->domain;
    const clast_evolve_config *c = e->config;
    const bool keeps = c->sides == CLAST_BORDER_DEPOSIT;
    if (d->kind == CLAST_DOMAIN_BOX) {
        const double across =
            keeps ? fmin(d->high[0] - d->low[0], d->high[1] - d->low[1]) : (double)INFINITY;
        return c->open_top ? fmin(across, d->high[2] - d->low[2]) : across;
    }
    if (!keeps && c->floor != CLAST_BORDER_DEPOSIT) {
        return (double)INFINITY;
    }
    const double width = clx_evolve_least_width(d);
    return isfinite(width) ? width : cbrt(clast_domain_volume(d));
}

/// Share of the width that a part may spread: planes are exact one by one, curved walls nearly so;
/// a caller's map is seen at the ends of parts alone.
static double spread_of(const clast_domain *d)
{
    switch (d->kind) {
    case CLAST_DOMAIN_BOX:
        return 1.0 / 20.0;
    case CLAST_DOMAIN_MAP:
        return 1.0 / 100.0;
    default:
        return 1.0 / 50.0;
    }
}

/// Greatest |z| of the domain.
static double height_most(const clast_domain *d)
{
    if (d->kind == CLAST_DOMAIN_BOX || d->kind == CLAST_DOMAIN_MESH) {
        return fmax(fabs(d->low[2]), fabs(d->high[2]));
    }
    return (d->is_placed ? fabs(d->centre[2]) : 0.0) + hypot(d->radius, d->length);
}

/// Parts of a step of a body that are short enough for a user's field, and for walls that keep what
/// meets them.
static double parts_of(const clast_evolve *e, const clx_evolve_body *b, double dt)
{
    const clast_domain *d = e->input->domain;
    const double part = spread_of(d) * clx_evolve_width(e);
    const double other[3] = {fabs(e->wind[0]) + fabs(e->config->wind_shear) * height_most(d),
                             fabs(e->wind[1]), fabs(e->wind[2]) + fabs(b->speed)};
    double parts = fmax(1.0, ceil(2.0 * b->diffusivity * dt / (part * part)));
    for (int k = 0; e->flow.u != NULL && k < 3; ++k) {
        if (e->flow.n[k] > 1) {
            const double rate = (e->flow.fastest[k] + other[k]) / e->flow.step[k];
            parts = fmax(parts, ceil(dt * rate / CELLS_A_STEP));
        }
    }
    return parts;
}

static void move_body(const leg *l, clx_evolve_body *b)
{
    double to[3];
    fly(l, b, to);
    if (l->e->input->domain->kind == CLAST_DOMAIN_BOX) {
        in_box(l, b, to);
    } else {
        in_surface(l, b, to);
    }
    v3_copy(b->x, to);
}

static void move_some(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const motion *m = context;
    clast_evolve *e = m->e;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        clx_evolve_body *b = &e->body[i];
        if (b->state != CLX_BODY_IN_FLUID) {
            continue;
        }
        const int64_t n_part = (int64_t)parts_of(e, b, m->dt);
        clx_rng rng = clx_rng_at(e->config->seed, CLX_STREAM_EVOLVE_MOVE,
                                 (e->step << 32) | (uint64_t)(uint32_t)i);
        leg l = {.e = e, .dt = m->dt / (double)n_part, .rng = &rng};
        for (int64_t k = 0; k < n_part && b->state == CLX_BODY_IN_FLUID; ++k) {
            l.time = e->time + l.dt * (double)k;
            move_body(&l, b);
        }
    }
}

clast_status clx_evolve_move(clast_evolve *e, double dt)
{
    CLAST_ASSERT(dt > 0.0);
    clast_status status = CLAST_OK;
    motion m = {.e = e, .dt = dt};
    for (int32_t k = 0; k < e->n_live; ++k) {
        const int32_t i = e->live[k];
        const double parts =
            e->body[i].state == CLX_BODY_IN_FLUID ? parts_of(e, &e->body[i], dt) : 1.0;
        CLX_CHECK(parts <= MOST_PARTS, CLAST_E_LIMIT,
                  "body %d takes %.3g parts of a step of %s for the grid of field or the walls "
                  "that keep it, over %g; take a shorter time_step or more rows",
                  i + 1, parts, clx_unit_text(dt, "s"), MOST_PARTS);
    }
    clx_parallel_for(e->n_start, BODIES_A_BLOCK, move_some, &m);
done:
    return status;
}
