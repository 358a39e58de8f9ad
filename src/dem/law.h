#pragma once
// Force of one contact: normal, tangential with contact history, attraction, rolling resistance.
//
// Called per contact and step, so it is inline and allocates nothing. [docs/theory/dem.md]
#include "math/vec3.h"
#include <clast/dem.h>

/// Restitution that fluids leave at least: softer rebounds have less than 0.4 % of their energy,
/// and stiffer dashpots would ask for shorter steps than the published ones.
#define CLX_LAW_SOFT 0.06

/// Share of what would stop a roll within a step that resistance may take: several contacts act on
/// a grain.
#define CLX_LAW_STOPS 0.1

/// Stability load of a grain up to which exact steps do not reduce springs and dashpots.
#define CLX_LAW_STABLE 3.5

/// Constants of the laws, worked out once.
typedef struct clx_law {
    int32_t kind, cohesion;
    bool clip;
    bool is_exact;       ///< contact_scheme: constants below are those of exact steps
    double time;         ///< T_c of the linear law [s]
    double load[2];      ///< stability loads: k dt^2 + 2 d dt over m_eff, normal and tangential
    double spring_share; ///< of k dt^2 in that, at most
    double stiffness;    ///< k_n / m_eff, eq. 11 [1/s2]
    double damping;      ///< d_n / m_eff [1/s]
    double kappa, root_kappa; ///< eq. 13, and its root (eq. 12)
    double young, shear;      ///< E* and G* of two equal materials [Pa]
    double alpha;             ///< damping of Hertz's law [Antypov2011]
    double friction[2];       ///< between grains, at walls
    double rolling;
    bool has_history; ///< contacts remember more than their displacement (clx_contact_history)
    bool is_wet;      ///< restitution by the impact's Stokes number
    double restitution, viscosity; ///< dry; of the fluid [Pa s]
    bool has_roll_spring;          ///< model C
    double damping_ratio;          ///< -ln e / sqrt(pi^2 + ln^2 e)
    double cohesion_energy;        ///< [J/m^3]
    double pull;                   ///< DMT, JKR: force over R* [N/m]
    bool has_neck;                 ///< JKR's whole curve: with Hertz's law
    double adhesion;               ///< C = sqrt(2 pi w / E*) of JKR [m^1/2]
} clx_law;

enum { CLX_MOST_MATERIALS = 256 };

/// Springs, dashpots and friction alone.
static inline bool clx_law_is_plain(const clx_law *law)
{
    return law->cohesion == CLAST_DEM_DRY && law->rolling == 0.0 && !law->is_wet;
}

/// Laws by the materials that touch: law[a n + b]; n 0: all contacts have the configuration's.
typedef struct clx_laws {
    int32_t n;
    clx_law *law;    ///< [n][n]
    bool are_plain;  ///< each of them
    double adhesion; ///< the greatest of them, or of the configuration's
} clx_laws;

/// One contact as the law sees it.
typedef struct clx_meeting {
    double overlap;     ///< > 0 [m]
    double normal[3];   ///< from a to b
    double velocity[3]; ///< of b's surface relative to a's at the contact point [m/s]
    double roll[3];     ///< angular velocity of b less that of a [1/s]
    double twirl;       ///< mean angular velocity about the normal, rotates `slide` [1/s]
    double mass;        ///< m_eff
    double radius;      ///< R*, harmonic [m]
    double friction;
    double restitution; ///< in a fluid, of its impact; else 0
    double head_on;     ///< exact steps: share of the contact's load that its normal has, at most 1
    double held;        ///< exact steps: the greater of the two grains' stability loads
} clx_meeting;

/// What acts on b; a gets the opposite.
typedef struct clx_contact_force {
    double normal;        ///< force along the normal; > 0 pushes apart [N]
    double pressed;       ///< normal force that limits friction and rolling, >= 0 [N]
    double tangential[3]; ///< [N]
    double rolling[3];    ///< torque against rolling [N m]
} clx_contact_force;

/// Constants from a configuration, which has been checked.
clx_law clx_law_make(const clast_dem_config *config);

/// The configuration with what a pair of materials has of its own; its law.
clast_dem_config clx_law_config(const clast_dem_config *config, const clast_dem_contact *contact);
clx_law clx_law_of_contact(const clast_dem_config *config, const clast_dem_contact *contact);

/// Shortest time a contact may take: T_c, or Hertz's quarter swing at an overlap of 1 % of R*.
///
/// @param mass, radius  of the lightest grain; not used by the linear law
double clx_law_time(const clx_law *law, double mass, double radius);

/// Factors of exact steps on springs and dashpots where a grain has many contacts.
typedef struct clx_law_limit {
    double spring, damping; ///< shares
} clx_law_limit;

/// A step is stable while k dt^2 + 2 d dt, each times the inverse mass that it meets, is below 4.
/// Summed over a grain's contacts that is its `held`, of which normals have their share. Dashpots
/// give way first, down to half of what is left for both.
static inline clx_law_limit clx_law_hold(const clx_law *law, double held)
{
    const double share = CLX_LAW_STABLE / held;
    const double rest = 1.0 - law->spring_share;
    clx_law_limit out = {1.0, 1.0};
    if (held > CLX_LAW_STABLE) {
        out.damping = fmax(0.5 * share, (share - law->spring_share) / rest);
        out.spring = fmin(1.0, (share - out.damping * rest) / law->spring_share);
    }
    return out;
}

/// Explicit steps that a collision needs, by the linear law, so that a sphere which n fixed
/// neighbours hold, with sliding contacts, comes to rest: n (w2 dt^2 + 2 D dt) <= 4 with w2 = 7/2
/// k_t / m and D = 7/2 d_t / m. With e_n = 0.1 8.9, 16.5, 31.7 for one, two, four.
double clx_law_steps(const clx_law *law, int n);

/// Speed at which a wall's spring, without its dashpot, stops a grain within half its radius: m v^2
/// / 2 is the work k d^2 / 2 of the linear law, 8/15 E* sqrt(R) d^(5/2) of Hertz's, d = bounding
/// / 2.
///                                                       [docs/theory/dem.md "When a run explodes"]
///
/// @param radius  R of Hertz's law    @param bounding  radius of the bounding sphere
double clx_law_speed(const clx_law *law, double mass, double radius, double bounding);

/// Normal spring's and tangential spring's energy at this overlap and displacement [J].
double clx_law_energy(const clx_law *law, double overlap, double slide, double mass, double radius);

typedef struct clx_springs {
    double elastic;        ///< normal force of the spring [N]
    double normal_damping; ///< [N s/m]
    double tangential;     ///< k_t [N/m]
    double tangential_damping;
} clx_springs;

/// Contact radius of JKR's stable branch at this overlap, which is above the tearing one.
///
///     d = a^2/R - C a^1/2,  C = sqrt(2 pi w / E*)                                 [Johnson1971]
///
/// Convex in a, so Newton's steps come down to the root from any start above it.
static inline double clx_jkr_radius(const clx_law *law, double overlap, double radius)
{
    const double c = law->adhesion;
    double a = sqrt(radius * fmax(overlap, 0.0)) + cbrt(c * c * radius * radius);
    for (int i = 0; i < 60; ++i) {
        const double root = sqrt(a);
        const double step =
            (a * a / radius - c * root - overlap) / (2.0 * a / radius - 0.5 * c / root);
        if (!(step > 1e-15 * a)) {
            break;
        }
        a -= step;
    }
    return a;
}

/// Overlap at which a neck tears, below 0: -3/4 (pi^2 w^2 R / E*^2)^1/3 = -3 (C^4 R / 256)^1/3.
static inline double clx_jkr_tear(const clx_law *law, double radius)
{
    const double c2 = law->adhesion * law->adhesion;
    return -3.0 * cbrt(c2 * c2 * radius / 256.0);
}

/// F = 4 E* a^3 / 3R - sqrt(8 pi w E*) a^3/2; dashpot and tangential spring of the contact radius.
static inline clx_springs clx_jkr_springs(const clx_law *law, const clx_meeting *c)
{
    clx_springs s;
    const double a = clx_jkr_radius(law, c->overlap, c->radius);
    s.elastic = 4.0 / 3.0 * law->young * a * a * a / c->radius -
                2.0 * law->young * law->adhesion * a * sqrt(a);
    s.normal_damping = law->alpha * sqrt(4.0 / 3.0 * c->mass * law->young * a);
    s.tangential = 8.0 * law->shear * a;
    s.tangential_damping = s.normal_damping * sqrt(s.tangential / (2.0 * law->young * a));
    return s;
}

static inline clx_springs clx_law_springs(const clx_law *law, const clx_meeting *c)
{
    clx_springs s;
    if (law->kind == CLAST_DEM_LINEAR) {
        double k = c->mass * law->stiffness;
        s.normal_damping = c->mass * law->damping;
        if (c->restitution > 0.0) {
            const double ln = log(c->restitution);
            k = c->mass * (CLAST_PI * CLAST_PI + ln * ln) / (law->time * law->time);
            s.normal_damping = -2.0 * c->mass * ln / law->time;
        }
        s.elastic = k * c->overlap;
        s.tangential = law->kappa * k;
        s.tangential_damping = law->root_kappa * s.normal_damping;
        return s;
    }
    if (law->has_neck) {
        return clx_jkr_springs(law, c);
    }
    // F = k d^(3/2) + alpha sqrt(m k) d^(1/4) d', k = 4/3 E* sqrt(R*) [Antypov2011]; k_t = 8 G* a
    const double root = sqrt(c->radius * c->overlap);
    const double k = 4.0 / 3.0 * law->young * sqrt(c->radius);
    s.elastic = 4.0 / 3.0 * law->young * root * c->overlap;
    s.normal_damping = law->alpha * sqrt(c->mass * k * sqrt(c->overlap));
    s.tangential = 8.0 * law->shear * root;
    s.tangential_damping =
        s.normal_damping * sqrt(s.tangential / (2.0 * law->young * root)); // same share of critical
    return s;
}

/// The same as exact steps reduce them.
static inline clx_springs clx_law_held_springs(const clx_law *law, const clx_meeting *c)
{
    clx_springs s = clx_law_springs(law, c);
    if (law->is_exact) {
        const clx_law_limit normal = clx_law_hold(law, c->held * c->head_on);
        const clx_law_limit across = clx_law_hold(law, c->held);
        s.elastic *= normal.spring;
        s.normal_damping *= normal.damping;
        s.tangential *= across.spring;
        s.tangential_damping *= across.damping;
    }
    return s;
}

/// Restitution of an impact in a fluid: e_dry exp(-35 / St), St = m u / (6 pi mu R*^2), that is
/// rho d u / (9 mu) of a sphere at a wall. [Gondret2002; Legendre2005] Not below CLX_LAW_SOFT.
static inline double clx_law_impact(const clx_law *law, const clx_meeting *c)
{
    const double speed = -v3_dot(c->velocity, c->normal);
    const double stokes =
        c->mass * speed / (6.0 * CLAST_PI * law->viscosity * c->radius * c->radius);
    const double share = stokes > 0.0 ? exp(-35.0 / stokes) : 0.0;
    return fmax(fmin(CLX_LAW_SOFT, law->restitution), law->restitution * share);
}

static inline double clx_law_pull(const clx_law *law, const clx_meeting *c)
{
    return law->cohesion == CLAST_DEM_DRY || law->has_neck ? 0.0
           : law->cohesion == CLAST_DEM_AREA
               ? law->cohesion_energy * CLAST_PI * c->radius * c->overlap
               : law->pull * c->radius;
}

/// The tangential displacement follows the contact: rotated about the normal, then projected into
/// its plane at its old length.
static inline void clx_law_rotate(const clx_meeting *c, double dt, double slide[3])
{
    const double old = v3_norm2(slide);
    if (old == 0.0) {
        return;
    }
    double across[3];
    v3_cross(across, c->normal, slide);
    v3_axpy(slide, slide, c->twirl * dt, across);
    v3_axpy(slide, slide, -v3_dot(slide, c->normal), c->normal);
    const double now = v3_norm2(slide);
    v3_scale(slide, now > 0.0 ? sqrt(old / now) : 0.0, slide);
}

/// Eq. 6 and 7: forces of a contact; the history `slide` (displacement of b over a) goes on by dt.
static inline void clx_law_force(const clx_law *law, const clx_meeting *c, double dt,
                                 double slide[3], clx_contact_force *force)
{
    const clx_springs s = clx_law_held_springs(law, c);
    const double apart = v3_dot(c->velocity, c->normal);
    double along[3];
    v3_axpy(along, c->velocity, -apart, c->normal);
    force->normal = s.elastic - s.normal_damping * apart;
    if (law->clip && force->normal < fmin(s.elastic, 0.0)) {
        force->normal = fmin(s.elastic, 0.0);
    }
    // Coulomb's limit takes the pressed force: attraction presses too, so it is left out of it; for
    // JKR that is F + 2 F_pull-off [Thornton1991]
    const double pressed = law->has_neck ? 2.0 * law->pull * c->radius : 0.0;
    force->pressed = fabs(force->normal + pressed);
    const double limit = c->friction * force->pressed;
    force->normal -= clx_law_pull(law, c);
    clx_law_rotate(c, dt, slide);
    v3_axpy(slide, slide, dt, along);
    for (int k = 0; k < 3; ++k) {
        force->tangential[k] = -s.tangential * slide[k] - s.tangential_damping * along[k];
    }
    const double size2 = v3_norm2(force->tangential);
    if (size2 > limit * limit) {
        const double inverse = -1.0 / s.tangential;
        v3_scale(force->tangential, limit / sqrt(size2), force->tangential);
        for (int k = 0; k < 3; ++k) {
            slide[k] = inverse * (force->tangential[k] + s.tangential_damping * along[k]);
        }
    }
}

/// Constant torque against rolling, no more than would stop it within a step. [Ai2011 model A]
///
/// @param inertia  reduced moment of inertia of the two [kg m^2]
static inline void clx_law_roll(const clx_law *law, const clx_meeting *c, double inertia, double dt,
                                clx_contact_force *force)
{
    double roll[3];
    v3_axpy(roll, c->roll, -v3_dot(c->roll, c->normal), c->normal);
    const double size = v3_norm(roll);
    const double most = law->rolling * c->radius * force->pressed;
    const double stops = CLX_LAW_STOPS * inertia * size / dt;
    v3_scale(force->rolling, size > 0.0 ? -fmin(most, stops) / size : 0.0, roll);
}

/// Slope of the normal force over the overlap [N/m].
static inline double clx_law_stiffness(const clx_law *law, const clx_meeting *c)
{
    return law->kind == CLAST_DEM_LINEAR ? c->mass * law->stiffness
           : law->has_neck ? 2.0 * law->young * clx_jkr_radius(law, c->overlap, c->radius)
                           : 2.0 * law->young * sqrt(c->radius * c->overlap);
}

/// Spring and dashpot against rolling; `torque` is the spring's on b and goes on by dt.
///
///     k_r = 9/4 k_n (mu_r R*)^2,  |M| <= mu_r R* F_n,  C_r = 2 zeta sqrt(I_r k_r)
///                                                                            [Ai2011 model C]
/// The dashpot rests where the spring gives way, and takes no more than model A may in a step.
///
/// @param inertia  as clx_law_roll; I_r, of the two about the contact [kg m^2]
static inline void clx_law_roll_spring(const clx_law *law, const clx_meeting *c,
                                       const double inertia[2], double dt, double torque[3],
                                       clx_contact_force *force)
{
    double roll[3];
    const double lever = law->rolling * c->radius;
    const double spring = 2.25 * clx_law_stiffness(law, c) * lever * lever;
    const double most = lever * force->pressed;
    v3_axpy(roll, c->roll, -v3_dot(c->roll, c->normal), c->normal);
    clx_law_rotate(c, dt, torque);
    v3_axpy(torque, torque, -spring * dt, roll);
    const double size2 = v3_norm2(torque);
    const bool gives_way = size2 > most * most;
    if (gives_way) {
        v3_scale(torque, most / sqrt(size2), torque);
    }
    const double dashpot =
        fmin(2.0 * law->damping_ratio * sqrt(inertia[1] * spring), CLX_LAW_STOPS * inertia[0] / dt);
    v3_axpy(force->rolling, torque, gives_way ? 0.0 : -dashpot, roll);
}
