// How long a step may be: where bodies are and whom they meet are those of its beginning.
#include "evolve/state.h"

#include <math.h>

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

/// Share of the mass that the wind carries out of the domain along x and y before it comes down.
static double share_blown_out(const clast_evolve *e)
{
    const clast_evolve_config *c = e->config;
    const clast_domain *d = e->input->domain;
    const double height = extent_of(d, 2);
    double mass = 0.0;
    double blown = 0.0;
    for (int32_t k = 0; k < e->n_live; ++k) {
        const clx_evolve_body *b = &e->body[e->live[k]];
        double u[3];
        double unit[3];
        velocity_of(e, b, u);
        const bool leaves = u[2] < 0.0 ? c->floor == CLAST_BORDER_DEPOSIT : c->open_top;
        const double stay =
            leaves && fabs(u[2]) * c->duration > height ? height / fabs(u[2]) : c->duration;
        const double to[3] = {b->x[0] + u[0] * stay, b->x[1] + u[1] * stay, b->x[2]};
        mass += b->mass;
        blown += clast_domain_map(d, to, unit) ? 0.0 : b->mass;
    }
    return blown / mass;
}

clast_status clx_evolve_check_mirrors(const clast_evolve *e)
{
    clast_status status = CLAST_OK;
    const clast_evolve_config *c = e->config;
    const motion m = motion_of(e);
    bool is_thin = false; // the layer of diffusivity over speed, beside what a step moves
    for (int k = 0; k < 2; ++k) {
        const double step = c->step_error * extent_of(e->input->domain, k);
        is_thin = is_thin || m.spread < step * m.path[k];
    }
    if (c->sides != CLAST_BORDER_REFLECT || e->flow.u != NULL || !is_thin) {
        return CLAST_OK;
    }
    const double share = share_blown_out(e);
    CLX_CHECK(share <= c->step_error, CLAST_E_CONFIG,
              "wind: it carries %.3g %% of the mass into sides that reflect, where it gathers in a "
              "layer (diffusivity over speed) thinner than a step moves it; take sides: deposit, "
              "in a box periodic, or a larger eddy_diffusivity",
              100.0 * share);
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
