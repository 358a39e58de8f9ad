// How long a step may be: where bodies are and whom they meet are those of its beginning.
#include "evolve/state.h"

#include <math.h>

/// Height of the domain.
static double height_of(const clast_domain *d)
{
    return d->kind == CLAST_DOMAIN_BOX ? d->high[2] - d->low[2] : cbrt(clast_domain_volume(d));
}

/// How far the domain reaches along x or y.
static double extent_of(const clast_domain *d, int axis)
{
    switch (d->kind) {
    case CLAST_DOMAIN_BOX:
    case CLAST_DOMAIN_MESH:
        return d->high[axis] - d->low[axis];
    case CLAST_DOMAIN_CYLINDER:
    case CLAST_DOMAIN_HALF_PIPE: {
        const double along = d->is_placed ? fabs(d->axes[2][axis]) : 0.0;
        return along * d->length + 2.0 * d->radius * sqrt(fmax(0.0, 1.0 - along * along));
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
    double path[3]; ///< |velocity| along each axis that carries bodies towards or away from a wall
} motion;

/// A body's velocity as walls see it. Between periodic borders a wind moves all alike; sides that
/// mirror keep the bodies in.
static void velocity_of(const clast_evolve *e, const clx_evolve_body *b, double u[3])
{
    const clast_evolve_config *c = e->config;
    clx_evolve_wind(e, b->x[2], u);
    u[2] = c->floor == CLAST_BORDER_PERIODIC ? 0.0 : u[2];
    if (e->flow.u != NULL) {
        clx_flow_add(&e->flow, b->x, u);
    }
    u[2] -= b->speed;
    if (c->sides != CLAST_BORDER_DEPOSIT) {
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
    }
    return m;
}

clast_status clx_evolve_check_time_step(const clast_evolve *e)
{
    clast_status status = CLAST_OK;
    const clast_evolve_config *c = e->config;
    const bool keeps = c->floor == CLAST_BORDER_DEPOSIT || c->open_top;
    const double height = height_of(e->input->domain);
    const motion m = motion_of(e);
    const double path = m.path[2];
    CLX_CHECK(!keeps || c->time_step * path <= height * m.mass, CLAST_E_CONFIG,
              "time_step: in %s the mean mass moves %s up or down, through the whole height of %s; "
              "take less than %s, or 0: step_error then chooses it",
              clx_unit_text(c->time_step, "s"), clx_unit_text(c->time_step * path / m.mass, "m"),
              clx_unit_text(height, "m"), clx_unit_text(height * m.mass / path, "s"));
done:
    return status;
}

double clx_evolve_step_of(const clast_evolve *e)
{
    const clast_evolve_config *c = e->config;
    const clast_domain *d = e->input->domain;
    const double height = height_of(d);
    const double width = fmin(height, clx_evolve_width(e));
    const double left = c->duration * ((double)(e->row + 1) / c->rows) - e->time;
    double dt = left;
    if (c->time_step > 0.0) {
        dt = c->time_step;
    } else {
        const motion m = motion_of(e);
        for (int k = 0; k < 3; ++k) {
            const double extent = k == 2 ? height : extent_of(d, k);
            dt = m.path[k] > 0.0 ? fmin(dt, c->step_error * extent * m.mass / m.path[k]) : dt;
        }
        dt = m.spread > 0.0 ? fmin(dt, c->step_error * width * width * m.mass / m.spread) : dt;
        dt = e->rate > 0.0 ? fmin(dt, c->step_error / e->rate) : dt;
    }
    const double parts = ceil(left / dt);
    return parts > 1.0 ? left / parts : left;
}
