#pragma once
#include <clast/status.h>

CLAST_BEGIN

// Whether two particles that meet stick. [docs/theory/agglomeration.md section 8]

typedef enum {
    CLAST_STICKING_CONSTANT, ///< the share alpha of all
    CLAST_STICKING_VISCOUS,  ///< a viscous film stops the pair [Ennis1991]
    CLAST_STICKING_LIQUID,   ///< wet ash, a fit to measured shares [Costa2010]
    CLAST_STICKING_CONTACT   ///< the adhesion of elastic spheres holds it [Thornton1998]
} clast_sticking_law;

/// A law and what it needs; the other members may be 0. SI.
typedef struct clast_sticking {
    int32_t law;           ///< clast_sticking_law
    double film_viscosity; ///< of the liquid on the particles: viscous, liquid [Pa s]
    double film_thickness; ///< h: viscous [m]
    double asperity;       ///< h_a, where the solids touch through the film: viscous [m]
    double restitution;    ///< e of the solids: viscous
    double critical_stokes, stokes_exponent; ///< St_cr, q: liquid
    double adhesion;                         ///< work of adhesion of the surfaces: contact [J/m^2]
    double young, poisson;                   ///< modulus [Pa] and ratio of both particles: contact
} clast_sticking;

/// Two particles that meet. SI.
typedef struct clast_impact {
    double speed;     ///< relative, clast_impact_speed
    double radius[2]; ///< of the particles
    double mass[2];
    double curvature[2]; ///< radii of what touches: of the particles, or of monomers of a fractal
} clast_impact;

/// Whether a law has what it needs.
///
/// @return CLAST_E_CONFIG names the law and what is missing
CLAST_API clast_status clast_sticking_check(const clast_sticking *sticking);

/// Impact Stokes number of the law: m~ u / (6 pi mu a~^2) of reduced mass and radius of curvature
/// for a viscous film [Ennis1991 for two equal spheres, u = 2 u_0: 8 rho u_0 a / (9 mu)],
/// 8 rho u / (9 mu) d1 d2 / (d1 + d2) with the mean density of both for wet ash [Costa2010]; NaN
/// for the other laws.
CLAST_API double clast_sticking_stokes(const clast_sticking *sticking, const clast_impact *impact);

/// Speed [m/s] up to which elastic spheres stick: the work that a JKR contact takes to part,
/// 7.09 (Gamma^5 a~^4 / E*^2)^(1/3), against m~ v^2 / 2.                          [Thornton1998]
CLAST_API double clast_sticking_speed(const clast_sticking *sticking, const clast_impact *impact);

/// Share of such impacts that stick.
///
///     viscous  1 where St < (1 + 1/e) ln(h / h_a), else 0                           [Ennis1991]
///     liquid   1 / (1 + (St / St_cr)^q)                                             [Costa2010]
///     contact  1 below clast_sticking_speed, else 0                              [Thornton1998]
///
/// @return 1 for a constant law; the medium has passed clast_sticking_check
CLAST_API double clast_sticking_share(const clast_sticking *sticking, const clast_impact *impact);

CLAST_END
