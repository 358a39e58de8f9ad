// Constants of the contact laws, and the times and energies that follow from them.
#include "dem/law.h"

clx_law clx_law_make(const clast_dem_config *c)
{
    const double ln = log(c->restitution);
    const double root = sqrt(ln * ln + CLAST_PI * CLAST_PI);
    clx_law law = {.kind = c->law,
                   .cohesion = c->cohesion,
                   .clip = c->clip,
                   .stiffness =
                       (CLAST_PI * CLAST_PI + ln * ln) / (c->collision_time * c->collision_time),
                   .damping = -2.0 * ln / c->collision_time,
                   .kappa = 2.0 * (1.0 - c->poisson) / (2.0 - c->poisson),
                   .young = c->young / (2.0 * (1.0 - c->poisson * c->poisson)),
                   .shear = c->young / (4.0 * (2.0 - c->poisson) * (1.0 + c->poisson)),
                   .alpha = -sqrt(5.0) * ln / root,
                   .rolling = c->rolling_friction,
                   .cohesion_energy = c->cohesion_energy};
    law.root_kappa = sqrt(law.kappa);
    law.friction[0] = c->friction;
    law.friction[1] = c->wall_friction >= 0.0 ? c->wall_friction : c->friction;
    law.pull = (c->cohesion == CLAST_DEM_DMT ? 2.0 : 1.5) * CLAST_PI * c->surface_energy;
    law.has_neck = c->law == CLAST_DEM_HERTZ && c->cohesion == CLAST_DEM_JKR;
    law.adhesion = sqrt(2.0 * CLAST_PI * c->surface_energy / law.young);
    return law;
}

/// Integral of JKR's force over the overlap along its curve, from a = 0.
static double jkr_energy(const clx_law *law, double overlap, double radius)
{
    const double a = clx_jkr_radius(law, overlap, radius);
    const double stiff = 4.0 / 3.0 * law->young / radius;
    const double sticky = 2.0 * law->young * law->adhesion;
    const double root = a * a * a * sqrt(a);
    return 0.4 * stiff / radius * a * a * a * a * a -
           2.0 / 7.0 * (0.5 * stiff * law->adhesion + 2.0 * sticky / radius) * root +
           0.25 * sticky * law->adhesion * a * a;
}

/// Half swing of a mass on Hertz's spring, linearised at an overlap of 1 % of R*.
static double hertz_time(const clx_law *law, double mass, double radius)
{
    const double slope = 2.0 * law->young * sqrt(radius * 0.01 * radius);
    return CLAST_PI * sqrt(mass / slope);
}

double clx_law_time(const clx_law *law, double mass, double radius)
{
    const double linear = CLAST_PI / sqrt(law->stiffness - 0.25 * law->damping * law->damping);
    return law->kind == CLAST_DEM_LINEAR ? linear : hertz_time(law, mass, radius);
}

double clx_law_speed(const clx_law *law, double mass, double radius, double reach)
{
    const double d = 0.5 * reach;
    return law->kind == CLAST_DEM_LINEAR
               ? d * sqrt(law->stiffness)
               : sqrt(16.0 / 15.0 * law->young * sqrt(radius * d) * d * d / mass);
}

double clx_law_energy(const clx_law *law, double overlap, double slide, double mass, double radius)
{
    const clx_meeting c = {.overlap = overlap, .mass = mass, .radius = radius};
    const clx_springs s = clx_law_springs(law, &c);
    const double share = law->kind == CLAST_DEM_LINEAR ? 0.5 : 0.4; // integrals of d, d^(3/2)
    if (law->has_neck) {
        return jkr_energy(law, overlap, radius) + 0.5 * s.tangential * slide * slide;
    }
    return share * s.elastic * overlap + 0.5 * s.tangential * slide * slide;
}
