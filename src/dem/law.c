// Constants of the contact laws, and the times and energies that follow from them.
#include "dem/law.h"

#include "base/status.h"

/// Spring k and dashpot d over mass whose semi-implicit Euler steps, v' = v - dt (k x + d v), x' =
/// x
/// + dt v', have the multipliers exp(-D dt / 2 +- i W dt) of x'' + D x' + w2 x = 0, W^2 = w2 -
/// D^2/4: positions are then those of the exact solution.
static void fit(double w2, double rate, double dt, double *k, double *d)
{
    CLAST_ASSERT(dt > 0.0);
    const double swing = w2 - 0.25 * rate * rate;
    const double cosine = swing >= 0.0 ? cos(sqrt(swing) * dt) : cosh(sqrt(-swing) * dt);
    *d = -expm1(-rate * dt) / dt;
    *k = (1.0 + exp(-rate * dt) - 2.0 * exp(-0.5 * rate * dt) * cosine) / (dt * dt);
}

/// What a sphere's turning makes of its inverse mass at a sliding contact: 1 + 5/2.
static const double TURNING = 3.5;

double clx_law_steps(const clx_law *law, int n)
{
    CLAST_ASSERT(n > 0);
    const double swing = n * TURNING * law->kappa * law->stiffness * law->time * law->time;
    const double rate = n * TURNING * law->root_kappa * law->damping * law->time;
    return (rate + sqrt(rate * rate + 4.0 * swing)) / 4.0;
}

/// Scales spring and dashpot so that a collision takes the nearest whole number of steps: what
/// passes between the first touch and the step that sees it then passes again before the step that
/// sees the end, and the two take each other off. Restitution is that of the exact solution; where
/// a collision ended within a step it was off by up to 0.018 at 20.5 steps. Whole numbers stay as
/// they are, to the bit.
static void round_steps(clx_law *law, double dt)
{
    static const double rounding = 1e-9; // of T_c over dt
    const double steps = law->time / dt;
    const double whole = round(steps);
    if (whole >= 1.0 && fabs(steps - whole) > rounding * steps) {
        const double faster = steps / whole;
        law->stiffness *= faster * faster;
        law->damping *= faster;
    }
}

/// Constants of exact steps: normal of a central contact; tangential of two spheres, whose turning
/// makes the inverse mass 1 + 5/2 times as great.
static void make_exact(clx_law *law, double dt)
{
    double k[2];
    double d[2];
    round_steps(law, dt);
    fit(law->stiffness, law->damping, dt, &k[0], &d[0]);
    fit(TURNING * law->kappa * law->stiffness, TURNING * law->root_kappa * law->damping, dt, &k[1],
        &d[1]);
    law->spring_share = 0.0;
    for (int i = 0; i < 2; ++i) {
        const double load = k[i] * dt * dt + 2.0 * d[i] * dt;
        law->load[i] = i == 0 ? load : load / TURNING;
        law->spring_share = fmax(law->spring_share, k[i] * dt * dt / load);
    }
    law->stiffness = k[0];
    law->damping = d[0];
    law->kappa = k[1] / (TURNING * k[0]);
    law->root_kappa = d[0] > 0.0 ? d[1] / (TURNING * d[0]) : 0.0;
}

/// 1/E* and 1/G* are sums of both sides'; k_t / k_n of the linear law is Mindlin's 4 G* / E*.
static void mix(const clast_dem_contact *p, clx_law *law)
{
    double soft = 0.0;
    double lax = 0.0;
    for (int k = 0; k < 2; ++k) {
        const double nu = p->poisson[k];
        soft += (1.0 - nu * nu) / p->young[k];
        lax += 2.0 * (2.0 - nu) * (1.0 + nu) / p->young[k];
    }
    law->young = 1.0 / soft;
    law->shear = 1.0 / lax;
    law->kappa = 4.0 * law->shear / law->young;
}

static clx_law make_law(const clast_dem_config *c, const clast_dem_contact *pair)
{
    const double ln = log(c->restitution);
    const double root = sqrt(ln * ln + CLAST_PI * CLAST_PI);
    clx_law law = {
        .kind = c->law,
        .cohesion = c->cohesion,
        .clip = c->clip,
        .stiffness = (CLAST_PI * CLAST_PI + ln * ln) / (c->collision_time * c->collision_time),
        .damping = -2.0 * ln / c->collision_time,
        .kappa = 2.0 * (1.0 - c->poisson) / (2.0 - c->poisson),
        .young = c->young / (2.0 * (1.0 - c->poisson * c->poisson)),
        .shear = c->young / (4.0 * (2.0 - c->poisson) * (1.0 + c->poisson)),
        .alpha = -sqrt(5.0) * ln / root,
        .rolling = c->rolling_friction,
        .has_roll_spring = c->rolling_friction > 0.0 && c->rolling_model == CLAST_DEM_ROLL_SPRING,
        .damping_ratio = -ln / root,
        .is_wet = c->wet_restitution,
        .restitution = c->restitution,
        .viscosity = c->fluid_viscosity,
        .cohesion_energy = c->cohesion_energy};
    if (pair != NULL) {
        mix(pair, &law);
    }
    law.root_kappa = sqrt(law.kappa);
    law.time = CLAST_PI / sqrt(law.stiffness - 0.25 * law.damping * law.damping);
    law.friction[0] = c->friction;
    law.friction[1] = c->wall_friction >= 0.0 ? c->wall_friction : c->friction;
    law.pull = (c->cohesion == CLAST_DEM_DMT ? 2.0 : 1.5) * CLAST_PI * c->surface_energy;
    law.has_history = law.has_roll_spring || law.is_wet;
    law.has_neck = c->law == CLAST_DEM_HERTZ && c->cohesion == CLAST_DEM_JKR;
    law.adhesion = sqrt(2.0 * CLAST_PI * c->surface_energy / law.young);
    law.is_exact = c->contact_scheme == CLAST_DEM_EXACT;
    if (law.is_exact && c->time_step > 0.0 && isfinite(c->time_step)) {
        make_exact(&law, c->time_step);
    }
    return law;
}

clx_law clx_law_make(const clast_dem_config *config)
{
    return make_law(config, NULL);
}

clast_dem_config clx_law_config(const clast_dem_config *config, const clast_dem_contact *contact)
{
    clast_dem_config own = *config;
    own.friction = contact->friction;
    own.wall_friction = contact->friction;
    own.rolling_friction = contact->rolling_friction;
    own.rolling_model = contact->rolling_friction > 0.0 ? own.rolling_model : CLAST_DEM_ROLL_TORQUE;
    own.restitution = contact->restitution;
    own.collision_time = contact->collision_time;
    own.young = contact->young[0];
    own.poisson = contact->poisson[0];
    return own;
}

clx_law clx_law_of_contact(const clast_dem_config *config, const clast_dem_contact *contact)
{
    const clast_dem_config own = clx_law_config(config, contact);
    const bool are_like =
        contact->young[0] == contact->young[1] && contact->poisson[0] == contact->poisson[1];
    return make_law(&own, are_like ? NULL : contact);
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
    CLAST_ASSERT(mass >= 0.0 && radius >= 0.0);
    const double slope = 2.0 * law->young * sqrt(radius * 0.01 * radius);
    return CLAST_PI * sqrt(mass / slope);
}

double clx_law_time(const clx_law *law, double mass, double radius)
{
    return law->kind == CLAST_DEM_LINEAR ? law->time : hertz_time(law, mass, radius);
}

double clx_law_speed(const clx_law *law, double mass, double radius, double bounding)
{
    CLAST_ASSERT(mass >= 0.0 && bounding >= 0.0);
    const double d = 0.5 * bounding;
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
