// What follows from a body's grains: moments, envelope, collision radius, fall, diffusivity.
//
// Moments are kept and combined, so that an event costs no sum over all grains. The envelope of an
// aggregate is the solid ellipsoid of equal second moments: it is the particle itself for an
// ellipsoid, and for a porous body holds the pores. [docs/theory/evolve.md eq. 3-6]
#include "evolve/state.h"

#include "aggregate/form.h"
#include "base/alloc.h"
#include "math/sym3.h"
#include "math/vec3.h"
#include <clast/settling.h>
#include <clast/shape.h>
#include <clast/status.h>
#include <math.h>

static const double BOLTZMANN = 1.380649e-23; ///< J/K, exact [SI2019]

/// Adds mass times (R J R^T + r r^T) of one part.
static void add_part(const clx_templates *templates, const clx_template_part *part, double sum[6])
{
    static const int row[6] = {0, 1, 2, 1, 0, 0};
    static const int column[6] = {0, 1, 2, 2, 2, 1};
    const clast_shape *shape = templates->shape[part->shape].shape;
    const double s2 = part->scale * part->scale;
    const double s3 = s2 * part->scale;
    double r[3][3];
    double j[3][3];
    double trace = 0.0;
    for (int k = 0; k < 3; ++k) {
        trace += 0.5 * shape->inertia[k][k];
    }
    q_matrix(r, part->orientation);
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            j[a][b] = (a == b ? trace : 0.0) - shape->inertia[a][b];
        }
    }
    for (int k = 0; k < 6; ++k) {
        double turned = 0.0;
        for (int a = 0; a < 3; ++a) {
            for (int b = 0; b < 3; ++b) {
                turned += r[row[k]][a] * j[a][b] * r[column[k]][b];
            }
        }
        sum[k] +=
            part->density * s3 *
            (s2 * turned + shape->volume * part->position[row[k]] * part->position[column[k]]);
    }
}

clast_status clx_evolve_kinds(clast_evolve *e)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&e->kind, e->templates.n_group - 1, sizeof *e->kind));
    e->n_kind = e->templates.n_group - 1;
    for (int32_t k = 0; k < e->n_kind; ++k) {
        const clx_template *group = &e->templates.group[1 + k];
        clx_evolve_kind *kind = &e->kind[k];
        kind->volume = group->volume;
        kind->mass = group->mass;
        kind->bounding_radius = group->radius;
        CLX_CHECK(group->volume > 0.0 && group->mass > 0.0, CLAST_E_GEOMETRY,
                  "shape %d has no volume or no mass", k + 1);
        for (int32_t i = 0; i < group->n_part; ++i) {
            add_part(&e->templates, &group->part[i], kind->second);
        }
        for (int i = 0; i < 6; ++i) {
            kind->second[i] /= group->mass;
        }
        if (group->n_part == 1) {
            CLX_TRY(clx_form_dimensions(&e->templates, group, kind->form));
        }
    }
done:
    return status;
}

/// Semi-axes a >= b >= c of the solid ellipsoid of these second moments.
static void semi_axes(const double s[6], double axes[3])
{
    double m[3][3] = {{s[0], s[5], s[4]}, {s[5], s[1], s[3]}, {s[4], s[3], s[2]}};
    double value[3];
    double vector[3][3];
    clx_sym3_eigen(m, value, vector);
    for (int k = 0; k < 3; ++k) {
        axes[k] = sqrt(5.0 * fmax(value[k], 0.0));
    }
}

/// What drag sees: length, width and thickness, diameter and mean density of the envelope, whose
/// pores hold the fluid.
typedef struct {
    double form[3], diameter, density;
} outside;

static outside outside_of(const clast_evolve *e, clx_evolve_body *body)
{
    outside o = {.density = body->mass / body->volume};
    double axes[3];
    semi_axes(body->second, axes);
    for (int k = 0; k < 3; ++k) {
        o.form[k] = 2.0 * axes[k];
    }
    body->envelope = fmax(body->volume, 4.0 / 3.0 * CLAST_PI * axes[0] * axes[1] * axes[2]);
    const clx_evolve_grain *grain = &e->grain[body->first];
    const clx_evolve_kind *kind = &e->kind[grain->kind];
    if (body->n == 1 && kind->form[2] > 0.0) {
        body->envelope = body->volume;
        for (int k = 0; k < 3; ++k) {
            o.form[k] = grain->scale * kind->form[k];
        }
    }
    o.diameter = cbrt(6.0 * body->envelope / CLAST_PI);
    o.density =
        (body->mass + e->collide.medium.density * (body->envelope - body->volume)) / body->envelope;
    return o;
}

/// Speed of falling by creeping flow about the envelope's sphere.
static double creeping(const clast_medium *m, const outside *o)
{
    return (o->density - m->density) * m->gravity * o->diameter * o->diameter /
           (18.0 * m->viscosity);
}

static double speed_of(const clast_evolve *e, const outside *o, const clast_drag *drag)
{
    const clast_medium *m = &e->collide.medium;
    if (!(m->gravity > 0.0)) {
        return 0.0;
    }
    const double slip = clast_slip_correction(2.0 * m->mean_free_path / o->diameter);
    const double slow = creeping(m, o);
    const double reynolds = fabs(slow) * o->diameter * m->density / m->viscosity;
    if (e->config->fall == CLAST_FALL_STOKES || !(reynolds > 0.0)) {
        return slip * slow;
    }
    if (e->config->fall == CLAST_FALL_SPHERE) {
        return slip * slow * (clast_drag_sphere_reynolds(24.0 * reynolds) / reynolds);
    }
    clast_settling settling = {0};
    const clast_fluid fluid = {
        .density = m->density, .viscosity = m->viscosity, .gravity = m->gravity};
    (void)clast_terminal_velocity(o->diameter, o->density, drag, &fluid, &settling);
    return slip * settling.velocity;
}

void clx_evolve_update(const clast_evolve *e, clx_evolve_body *body)
{
    CLAST_ASSERT(body->mass > 0.0 && body->volume > 0.0 && body->n > 0);
    const clast_medium *m = &e->collide.medium;
    const outside o = outside_of(e, body);
    clast_drag drag = {.stokes = 1.0, .newton = 1.0};
    if (e->config->fall == CLAST_FALL_FORM) {
        (void)clast_drag_of_form(o.form[0], o.form[1], o.form[2], o.diameter,
                                 o.density / m->density, &drag);
    }
    body->gyration = sqrt(body->second[0] + body->second[1] + body->second[2]);
    body->radius = e->config->collision_radius == CLAST_COLLISION_GYRATION
                       ? sqrt(5.0 / 3.0) * body->gyration
                   : e->config->collision_radius == CLAST_COLLISION_ENCLOSING
                       ? body->bounding_radius
                       : cbrt(0.75 * body->volume / CLAST_PI);
    body->speed = speed_of(e, &o, &drag);
    body->diffusivity = e->config->eddy_diffusivity;
    if (e->config->brownian) {
        body->diffusivity += BOLTZMANN * m->temperature *
                             clast_slip_correction(2.0 * m->mean_free_path / o.diameter) /
                             (3.0 * CLAST_PI * m->viscosity * drag.stokes * o.diameter);
    }
}

void clx_evolve_single(const clast_evolve *e, int32_t i, clx_evolve_body *body)
{
    CLAST_ASSERT(i >= 0 && i < e->n_start);
    const clx_evolve_grain *grain = &e->grain[i];
    const clx_evolve_kind *kind = &e->kind[grain->kind];
    const double s = grain->scale;
    body->first = body->last = i;
    body->n = 1;
    body->state = CLX_BODY_IN_FLUID;
    body->node = i;
    body->mass = kind->mass * s * s * s;
    body->volume = kind->volume * s * s * s;
    body->bounding_radius = kind->bounding_radius * s;
    for (int k = 0; k < 6; ++k) {
        body->second[k] = kind->second[k] * s * s;
    }
    clx_evolve_update(e, body);
}

void clx_evolve_wind(const clast_evolve *e, double z, double velocity[3])
{
    v3_copy(velocity, e->wind);
    velocity[0] += e->config->wind_shear * z;
}

void clx_evolve_list(clast_evolve *e)
{
    e->n_live = 0;
    for (int32_t i = 0; i < e->n_start; ++i) {
        if (e->body[i].state == CLX_BODY_IN_FLUID) {
            v3_copy(e->at[e->n_live], e->body[i].x);
            e->live[e->n_live++] = i;
        }
    }
}
