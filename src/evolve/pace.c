// How long a step may be: where bodies are and whom they meet are those of its beginning.
#include "evolve/state.h"

#include "evolve/walls.h"
#include "math/vec3.h"
#include <math.h>
#include <stdio.h>

/// How far the domain reaches along an axis; along z that is its height.
static double extent_of(const clast_domain *d, int axis)
{
    switch (d->kind) {
    case CLAST_DOMAIN_BOX:
    case CLAST_DOMAIN_MESH:
        return d->high[axis] - d->low[axis];
    case CLAST_DOMAIN_CYLINDER:
    case CLAST_DOMAIN_HALF_PIPE: {
        double own[3]; // along the domain's own axes
        for (int k = 0; k < 3; ++k) {
            own[k] = d->is_placed ? d->axes[k][axis] : (k == axis ? 1.0 : 0.0);
        }
        const double disc = d->radius * sqrt(own[0] * own[0] + own[1] * own[1]);
        const double flat = d->kind == CLAST_DOMAIN_HALF_PIPE ? d->radius * fabs(own[0]) : disc;
        return fabs(own[2]) * d->length + disc + flat;
    }
    case CLAST_DOMAIN_SPHERE:
        return 2.0 * d->radius;
    default:
        return cbrt(clast_domain_volume(d));
    }
}

/// Sums over the bodies in the fluid, by mass.
typedef struct {
    double mass, spread;
    double path[3];  ///< |velocity| along each axis that carries bodies towards or away from a wall
    double gathered; ///< |divergence| of a user's field: what neighbours come nearer by, or part
} motion;

/// A body's velocity as walls see it. Between periodic borders a wind moves all of a height alike.
static void velocity_of(const clast_evolve *e, const clx_evolve_body *b, double u[3])
{
    const clast_evolve_config *c = e->config;
    clx_evolve_wind(e, b->x[2], u);
    u[2] = c->floor == CLAST_BORDER_PERIODIC ? 0.0 : u[2];
    if (e->flow.u != NULL) {
        clx_flow_add(&e->flow, b->x, u);
    }
    u[2] -= b->speed;
    if (c->sides == CLAST_BORDER_PERIODIC) {
        u[0] = u[1] = 0.0;
    }
}

static motion motion_of(const clast_evolve *e)
{
    motion m = {0};
    for (int32_t k = 0; k < e->n_live; ++k) {
        const clx_evolve_body *b = &e->body[e->live[k]];
        double u[3];
        velocity_of(e, b, u);
        m.mass += b->mass;
        m.spread += b->mass * b->diffusivity;
        for (int j = 0; j < 3; ++j) {
            m.path[j] += b->mass * fabs(u[j]);
        }
        if (e->flow.u != NULL) {
            m.gathered += b->mass * fabs(clx_flow_divergence(&e->flow, b->x));
        }
    }
    return m;
}

/// Whether what moves along an axis may stay at a wall, or leave by it.
static bool keeps_along(const clast_evolve_config *c, int axis)
{
    return axis < 2 ? c->sides == CLAST_BORDER_DEPOSIT
                    : c->floor == CLAST_BORDER_DEPOSIT || c->open_top;
}

clast_status clx_evolve_check_time_step(const clast_evolve *e)
{
    clast_status status = CLAST_OK;
    const clast_evolve_config *c = e->config;
    const motion m = motion_of(e);
    for (int k = 0; k < 3; ++k) {
        const double extent = extent_of(e->input->domain, k);
        const double path = m.path[k];
        CLX_CHECK(!keeps_along(c, k) || c->time_step * path <= extent * m.mass, CLAST_E_CONFIG,
                  "time_step: in %s the mean mass moves %s %s, through the whole %s of %s; take "
                  "less than %s, or 0: step_error then chooses it",
                  clx_unit_text(c->time_step, "s"),
                  clx_unit_text(c->time_step * path / m.mass, "m"),
                  k < 2 ? "to the side" : "up or down", k < 2 ? "width" : "height",
                  clx_unit_text(extent, "m"), clx_unit_text(extent * m.mass / path, "s"));
    }
done:
    return status;
}

/// The wall before a body that goes straight on.
typedef struct {
    double time;    ///< until it comes there; INFINITY: never
    int32_t border; ///< what the wall does; DEPOSIT where it lets bodies out too
} wall;

static int32_t border_of_box(const clast_evolve_config *c, int axis, bool is_up)
{
    if (axis < 2) {
        return c->sides;
    }
    if (!is_up || c->floor == CLAST_BORDER_PERIODIC) {
        return c->floor;
    }
    return c->open_top ? CLAST_BORDER_DEPOSIT : CLAST_BORDER_REFLECT;
}

/// Along an axis; in a domain that is no box along x and y at once.
static wall wall_before(const clast_evolve *e, const double x[3], int axis, const double u[3])
{
    static const double far = 1e6; // of the domain's size: beyond all of its walls
    const clast_evolve_config *c = e->config;
    const clast_domain *d = e->input->domain;
    const double v[3] = {axis < 2 ? u[0] : 0.0, axis < 2 ? u[1] : 0.0, axis < 2 ? 0.0 : u[2]};
    double to[3];
    clx_exit at;
    if (u[axis] == 0.0) {
        return (wall){(double)INFINITY, CLAST_BORDER_PERIODIC};
    }
    if (d->kind == CLAST_DOMAIN_BOX) {
        const bool is_up = u[axis] > 0.0;
        return (wall){((is_up ? d->high[axis] : d->low[axis]) - x[axis]) / u[axis],
                      border_of_box(c, axis, is_up)};
    }
    const double most = fmin(c->duration, far * cbrt(clast_domain_volume(d)) / v3_norm(v));
    v3_axpy(to, x, most, v);
    if (!clx_walls_exit(d, x, to, &at)) {
        return (wall){(double)INFINITY, CLAST_BORDER_PERIODIC};
    }
    return (wall){at.share * most, clx_walls_is_floor(d, at.at) ? c->floor : c->sides};
}

/// A body's velocity, of the wind the greatest between its height and that where it ends.
static void greatest_velocity(const clast_evolve *e, const clx_evolve_body *b, double u[3])
{
    clx_evolve_body end = *b;
    double there[3];
    velocity_of(e, b, u);
    end.x[2] += u[2] * fmin(e->config->duration, wall_before(e, b->x, 2, u).time);
    velocity_of(e, &end, there);
    u[0] = fabs(there[0]) > fabs(u[0]) ? there[0] : u[0];
}

/// What comes to walls that reflect, by mass, and stays nearer to them than a step moves it.
typedef struct {
    double mass;                 ///< of all bodies
    double aside;                ///< blown to the sides
    double blown[2], settled[2]; ///< to the floor and the top, by a wind and without
    double limit; ///< time_step, or without it step_error, below which no layer is that thin
} layers;

static void add_body(const clast_evolve *e, const clx_evolve_body *b, layers *all)
{
    const clast_evolve_config *c = e->config;
    const bool is_blown =
        e->wind[2] > fmax(0.0, b->speed) || (b->speed <= 0.0 && e->wind[2] < b->speed);
    double stay = c->duration;
    double u[3];
    wall before[3];
    bool gathers[3];
    greatest_velocity(e, b, u);
    for (int k = 0; k < 3; ++k) {
        before[k] = wall_before(e, b->x, k, u);
        stay = before[k].border == CLAST_BORDER_DEPOSIT ? fmin(stay, before[k].time) : stay;
    }
    for (int k = 0; k < 3; ++k) {
        const double step = c->time_step > 0.0 ? fabs(u[k]) : extent_of(e->input->domain, k);
        const double limit = b->diffusivity / (fabs(u[k]) * step);
        gathers[k] = before[k].border == CLAST_BORDER_REFLECT && before[k].time < stay &&
                     limit < (c->time_step > 0.0 ? c->time_step : c->step_error);
        all->limit = gathers[k] && (k < 2 || is_blown) ? fmin(all->limit, limit) : all->limit;
    }
    all->mass += b->mass;
    all->aside += gathers[0] || gathers[1] ? b->mass : 0.0;
    (is_blown ? all->blown : all->settled)[u[2] > 0.0] += gathers[2] ? b->mass : 0.0;
}

bool clx_evolve_is_field_apart(const clast_evolve *e)
{
    static const double large = 1e3; // metres and millimetres
    bool is_apart = e->n_live > 0;
    bool is_wide = e->flow.u != NULL;
    for (int32_t k = 0; k < e->n_live && is_apart; ++k) {
        is_apart = !clx_flow_has(&e->flow, e->body[e->live[k]].x);
    }
    for (int k = 0; k < 3 && is_wide; ++k) {
        is_wide = e->flow.n[k] == 1 || e->flow.step[k] * (e->flow.n[k] - 1) >=
                                           (1.0 - 1e-9) * large * extent_of(e->input->domain, k);
    }
    return e->flow.u != NULL && (is_apart || is_wide);
}

/// The key that would follow such a layer, and its greatest value; none where nothing spreads.
static const char *shorter_steps(const clast_evolve_config *c, double limit, char words[64])
{
    const bool is_time = c->time_step > 0.0;
    words[0] = '\0';
    if (limit > (is_time ? 0.0 : 1e-6)) { // the least step_error that is taken
        (void)snprintf(words, 64, ", or %s below %s", is_time ? "time_step" : "step_error",
                       clx_unit_text(limit, is_time ? "s" : "-"));
    }
    return words;
}

clast_status clx_evolve_check_mirrors(clast_evolve *e)
{
    clast_status status = CLAST_OK;
    const clast_evolve_config *c = e->config;
    const bool is_box = e->input->domain->kind == CLAST_DOMAIN_BOX;
    layers all = {.limit = (double)INFINITY};
    char steps[64];
    for (int32_t k = 0; e->flow.u == NULL && k < e->n_live; ++k) {
        add_body(e, &e->body[e->live[k]], &all);
    }
    const double most = c->step_error * all.mass;
    const double *const share = all.aside > most ? &all.aside : &all.blown[all.blown[1] > most];
    const double settled = all.settled[0] + all.settled[1];
    CLX_CHECK(*share <= most, CLAST_E_CONFIG,
              "wind: it carries %.3g %% of the mass into %s, where it gathers in a layer "
              "(diffusivity over speed) thinner than a step moves it; take %s or a "
              "larger eddy_diffusivity%s",
              100.0 * *share / all.mass,
              share == &all.blown[0]           ? "a floor that reflects"
              : share == &all.aside || !is_box ? "sides that reflect"
                                               : "a top that reflects",
              share == &all.blown[0] ? "floor: deposit"
              : !is_box              ? "sides: deposit"
              : share == &all.aside  ? "sides: deposit or periodic"
                                     : "open_top",
              shorter_steps(c, all.limit, steps));
    e->gathered = settled > most ? settled / all.mass : 0.0;
    e->gathered_top = settled > most ? all.settled[1] / all.mass : 0.0;
done:
    return status;
}

double clx_evolve_step_of(const clast_evolve *e)
{
    const clast_evolve_config *c = e->config;
    const clast_domain *d = e->input->domain;
    const double width = fmin(extent_of(d, 2), clx_evolve_width(e));
    const double left = c->duration * ((double)(e->row + 1) / c->rows) - e->time;
    double dt = left;
    if (c->time_step > 0.0) {
        dt = c->time_step;
    } else {
        const motion m = motion_of(e);
        for (int k = 0; k < 3; ++k) {
            const double most = c->step_error * extent_of(d, k) * m.mass;
            dt = m.path[k] > 0.0 ? fmin(dt, most / m.path[k]) : dt;
        }
        dt = m.gathered > 0.0 ? fmin(dt, c->step_error * m.mass / m.gathered) : dt;
        dt = m.spread > 0.0 ? fmin(dt, c->step_error * width * width * m.mass / m.spread) : dt;
        dt = e->rate > 0.0 ? fmin(dt, c->step_error / e->rate) : dt;
    }
    const double parts = ceil(left / dt);
    return parts > 1.0 ? left / parts : left;
}
