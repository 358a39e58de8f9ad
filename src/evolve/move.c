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
#include "cloud/surface.h"
#include "math/vec3.h"
#include <math.h>

enum { BODIES_A_BLOCK = 1024, BISECTIONS = 48 };

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

static int32_t border_at(const clast_evolve *e, const double at[3])
{
    return is_floor(e->input->domain, at) ? e->config->floor : e->config->sides;
}

/// Distance of a point of a cylinder or sphere (its own frame) from wall w, and the wall's point.
static double wall_of(const clast_domain *d, const double x[3], int w, double at[3])
{
    static const double INSIDE = 1.0 - 1e-9;
    v3_copy(at, x);
    if (w > 0) { // an end
        at[2] = d->length * (w == 1 ? 1.0 - INSIDE : INSIDE);
        return w == 1 ? x[2] : d->length - x[2];
    }
    const bool is_sphere = d->kind == CLAST_DOMAIN_SPHERE;
    const double r = hypot(hypot(x[0], x[1]), is_sphere ? x[2] : 0.0);
    for (int k = 0; r > 0.0 && k < (is_sphere ? 3 : 2); ++k) {
        at[k] = x[k] * (INSIDE * d->radius / r);
    }
    return d->radius - r;
}

/// Whether a path that stays inside of a cylinder or sphere at both ends has met a wall that keeps
/// it, by the bridge beside the wall's plane; `at`: where.
static bool touches(const leg *l, const clx_evolve_body *b, const double to[3], double at[3])
{
    const clast_domain *d = l->e->input->domain;
    const bool is_cylinder = d->kind == CLAST_DOMAIN_CYLINDER;
    double from[3];
    double end[3];
    double near[3];
    if (b->diffusivity <= 0.0 || !(is_cylinder || d->kind == CLAST_DOMAIN_SPHERE)) {
        return false;
    }
    v3_copy(from, b->x);
    v3_copy(end, to);
    if (d->is_placed) {
        clx_domain_to_local(d, b->x, from);
        clx_domain_to_local(d, to, end);
    }
    for (int w = 0; w < (is_cylinder ? 3 : 1); ++w) {
        const double h0 = fmax(wall_of(d, from, w, near), 0.0);
        const double h1 = fmax(wall_of(d, end, w, near), 0.0);
        if (clx_rng_uniform(l->rng) >= exp(-h0 * h1 / (b->diffusivity * l->dt))) {
            continue;
        }
        v3_copy(at, near);
        if (d->is_placed) {
            v3_copy(at, d->centre);
            for (int k = 0; k < 3; ++k) {
                v3_axpy(at, at, near[k], d->axes[k]);
            }
        }
        if (border_at(l->e, at) == CLAST_BORDER_DEPOSIT) {
            return true;
        }
    }
    return false;
}

/// In a domain that is no box: what leaves stops at the surface, or (reflect) stays where it is.
static void in_surface(const leg *l, clx_evolve_body *b, double to[3])
{
    const clast_evolve *e = l->e;
    const clast_domain *d = e->input->domain;
    double u[3];
    double at[3];
    if (clast_domain_map(d, to, u)) {
        if (isfinite(clx_evolve_width(e)) && touches(l, b, to, at)) {
            v3_copy(to, at);
            end_at(b, CLX_BODY_ON_FLOOR, l->time + 0.5 * l->dt);
        }
        return;
    }
    const double share = leave(d, b->x, to, at);
    v3_copy(to, at);
    if (border_at(e, at) == CLAST_BORDER_DEPOSIT) {
        end_at(b, CLX_BODY_ON_FLOOR, l->time + share * l->dt);
    }
}

double clx_evolve_width(const clast_evolve *e)
{
    const clast_domain *d = e->input->domain;
    const clast_evolve_config *c = e->config;
    const bool keeps = c->sides == CLAST_BORDER_DEPOSIT;
    const double size[3] = {d->high[0] - d->low[0], d->high[1] - d->low[1], d->high[2] - d->low[2]};
    if (d->kind == CLAST_DOMAIN_BOX) {
        const double across = keeps ? fmin(size[0], size[1]) : (double)INFINITY;
        return c->open_top ? fmin(across, size[2]) : across;
    }
    if (!keeps && c->floor != CLAST_BORDER_DEPOSIT) {
        return (double)INFINITY;
    }
    switch (d->kind) {
    case CLAST_DOMAIN_CYLINDER:
        return fmin(2.0 * d->radius, d->length);
    case CLAST_DOMAIN_HALF_PIPE:
        return fmin(d->radius, d->length);
    case CLAST_DOMAIN_SPHERE:
        return 2.0 * d->radius;
    case CLAST_DOMAIN_MESH:
        return fmin(size[0], fmin(size[1], size[2]));
    default:
        return cbrt(clast_domain_volume(d));
    }
}

/// Share of the width that a part may spread: planes are exact one by one, curved walls nearly so,
/// others are seen at the ends of parts alone.
static double spread_of(const clast_domain *d)
{
    switch (d->kind) {
    case CLAST_DOMAIN_BOX:
        return 1.0 / 20.0;
    case CLAST_DOMAIN_CYLINDER:
    case CLAST_DOMAIN_SPHERE:
        return 1.0 / 50.0;
    default:
        return 1.0 / 100.0;
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
                  "body %d takes %.3g parts of a step of %.3g s for the grid of field or the walls "
                  "that keep it, over %g; take a shorter time_step or more rows",
                  i + 1, parts, dt, MOST_PARTS);
    }
    clx_parallel_for(e->n_start, BODIES_A_BLOCK, move_some, &m);
done:
    return status;
}
