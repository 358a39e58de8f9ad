#pragma once
// Force of one contact: normal, tangential with memory, attraction, rolling resistance.
//
// Called per contact and step, so it is inline and allocates nothing. [docs/theory/dem.md]
#include "math/vec3.h"
#include <clast/dem.h>

/// Constants of the laws, worked out once.
typedef struct clx_law {
    int32_t kind, cohesion;
    bool clip;
    double stiffness;         ///< k_n / m_eff, eq. 11 [1/s2]
    double damping;           ///< d_n / m_eff [1/s]
    double kappa, root_kappa; ///< eq. 13, and its root (eq. 12)
    double young, shear;      ///< E* and G* of two equal materials [Pa]
    double alpha;             ///< damping of Hertz's law [Antypov2011]
    double friction[2];       ///< between grains, at walls
    double rolling;
    double cohesion_energy; ///< [J/m3]
    double pull;            ///< DMT, JKR: force over R* [N/m]
    bool has_neck;          ///< JKR's whole curve: with Hertz's law
    double adhesion;        ///< C = sqrt(2 pi w / E*) of JKR [m^1/2]
} clx_law;

/// One contact as the law sees it.
typedef struct clx_meeting {
    double overlap;     ///< > 0 [m]
    double normal[3];   ///< from a to b
    double velocity[3]; ///< of b's surface relative to a's at the contact point [m/s]
    double roll[3];     ///< spin of b less that of a [1/s]
    double twirl;       ///< mean spin about the normal, turns the memory [1/s]
    double mass;        ///< m_eff
    double radius;      ///< R*, harmonic [m]
    double friction;
} clx_meeting;

/// What acts on b; a gets the opposite.
typedef struct clx_push {
    double normal;        ///< force along the normal; > 0 pushes apart [N]
    double tangential[3]; ///< [N]
    double rolling[3];    ///< torque against rolling [N m]
} clx_push;

/// Constants from a configuration, which has been checked.
clx_law clx_law_make(const clast_dem_config *config);

/// Shortest time a contact may take: T_c, or Hertz's quarter swing at an overlap of 1 % of R*.
///
/// @param mass, radius  of the lightest grain; not used by the linear law
double clx_law_time(const clx_law *law, double mass, double radius);

/// Speed at which a wall's spring, without its dashpot, stops a grain within half its reach: m v^2
/// / 2 is the work k d^2 / 2 of the linear law, 8/15 E* sqrt(R) d^(5/2) of Hertz's, d = reach / 2.
///                                                       [docs/theory/dem.md "When a run explodes"]
///
/// @param radius  R of Hertz's law    @param reach  bounding radius
double clx_law_speed(const clx_law *law, double mass, double radius, double reach);

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
        const double k = c->mass * law->stiffness;
        s.elastic = k * c->overlap;
        s.normal_damping = c->mass * law->damping;
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

static inline double clx_law_pull(const clx_law *law, const clx_meeting *c)
{
    return law->cohesion == CLAST_DEM_DRY || law->has_neck ? 0.0
           : law->cohesion == CLAST_DEM_AREA
               ? law->cohesion_energy * CLAST_PI * c->radius * c->overlap
               : law->pull * c->radius;
}

/// The memory follows the contact: turned about the normal, laid into its plane at old length.
static inline void clx_law_turn(const clx_meeting *c, double dt, double slide[3])
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

/// Eq. 6 and 7: forces of a contact; its memory `slide` (displacement of b over a) goes on by dt.
static inline void clx_law_force(const clx_law *law, const clx_meeting *c, double dt,
                                 double slide[3], clx_push *push)
{
    const clx_springs s = clx_law_springs(law, c);
    const double apart = v3_dot(c->velocity, c->normal);
    double along[3];
    v3_axpy(along, c->velocity, -apart, c->normal);
    push->normal = s.elastic - s.normal_damping * apart;
    if (law->clip && push->normal < fmin(s.elastic, 0.0)) {
        push->normal = fmin(s.elastic, 0.0);
    }
    // Coulomb's limit takes the pressed force: attraction presses too, so it is left out of it; for
    // JKR that is F + 2 F_pull-off [Thornton1991]
    const double pressed = law->has_neck ? 2.0 * law->pull * c->radius : 0.0;
    const double limit = c->friction * fabs(push->normal + pressed);
    push->normal -= clx_law_pull(law, c);
    clx_law_turn(c, dt, slide);
    v3_axpy(slide, slide, dt, along);
    for (int k = 0; k < 3; ++k) {
        push->tangential[k] = -s.tangential * slide[k] - s.tangential_damping * along[k];
    }
    const double size2 = v3_norm2(push->tangential);
    if (size2 > limit * limit) {
        const double inverse = -1.0 / s.tangential;
        v3_scale(push->tangential, limit / sqrt(size2), push->tangential);
        for (int k = 0; k < 3; ++k) {
            slide[k] = inverse * (push->tangential[k] + s.tangential_damping * along[k]);
        }
    }
}

/// Constant torque against rolling, no more than would stop it within a step. [Ai2011 model A]
///
/// @param inertia  reduced moment of inertia of the two [kg m2]
static inline void clx_law_roll(const clx_law *law, const clx_meeting *c, double inertia, double dt,
                                clx_push *push)
{
    double roll[3];
    v3_axpy(roll, c->roll, -v3_dot(c->roll, c->normal), c->normal);
    const double size = v3_norm(roll);
    const double most = law->rolling * c->radius * fabs(push->normal);
    const double stops = 0.1 * inertia * size / dt; // a tenth: several contacts act on a grain
    v3_scale(push->rolling, size > 0.0 ? -fmin(most, stops) / size : 0.0, roll);
}
