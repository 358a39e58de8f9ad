#pragma once
#include <clast/status.h>

CLAST_BEGIN

/// What a body falls through, and how it is pulled.
typedef struct clast_fluid {
    double density;   ///< kg/m^3
    double viscosity; ///< dynamic, Pa s
    double gravity;   ///< m/s^2
} clast_fluid;

/// Air at sea level in the International Standard Atmosphere (15 C): 1.225 kg/m^3, 1.7894e-5 Pa s;
/// standard gravity 9.80665 m/s^2.
CLAST_API clast_fluid clast_fluid_air(void);

/// Drag corrections of a body's form; 1 and 1 for a sphere.
typedef struct clast_drag {
    double stokes; ///< k_S
    double newton; ///< k_N
} clast_drag;

/// Corrections from the form dimensions L >= I >= S and the volume-equivalent diameter d (all in
/// one unit), and from the density of the body over that of the fluid, r.
///
///     F_S = f e^1.3 d^3 / (L I S)     k_S = (F_S^(1/3) + F_S^(-1/3)) / 2
///     F_N = f^2 e d^3 / (L I S)       k_N = 10^(a (-log10 F_N)^b)
///     a = 0.45 + 10 / (exp(2.5 log10 r) + 30)     b = 1 - 37 / (exp(3 log10 r) + 100)
///
/// with elongation e = I / L and flatness f = S / I.  [Bagheri2016; coefficients as in four public
/// codes; docs/theory/settling.md]  F_N above 1 (bodies fuller than their ellipsoid) counts as 1,
/// since the law knows no body with less drag than the sphere.
/// @return CLAST_E_GEOMETRY unless L >= I >= S > 0, d > 0 and r > 0
CLAST_API clast_status clast_drag_of_form(double length, double intermediate, double shortest,
                                          double diameter, double density_ratio, clast_drag *drag);

/// Drag coefficient at a Reynolds number > 0 by volume-equivalent diameter and area pi d^2 / 4:
///
///     C_D = 24 k_S / Re (1 + 0.125 (Re k_N / k_S)^(2/3)) + 0.46 k_N / (1 + 5330 / (Re k_N / k_S))
///
/// fitted for Re < 3e5. Orientation is averaged over.                            [Bagheri2016]
CLAST_API double clast_drag_coefficient(const clast_drag *drag, double reynolds);

/// Drag coefficient of a sphere: the standard curve of Clift and Gauvin, for Re < 3e5.
///
///     C_D = 24 / Re (1 + 0.15 Re^0.687) + 0.42 / (1 + 42500 Re^-1.16)             [Clift1971]
CLAST_API double clast_drag_sphere(double reynolds);

/// Reynolds number at which clast_drag_sphere gives this Best number, C_D Re^2, to rounding.
///
/// @param best  4/3 rho_f |rho - rho_f| g d^3 / mu^2 for a falling sphere; 24 Re of Stokes' law
/// @return 0 for 0, NaN for less
CLAST_API double clast_drag_sphere_reynolds(double best);

/// Cunningham's slip correction C with Davies' constants, by which drag in a gas is less.
///
///     C = 1 + Kn (1.257 + 0.4 exp(-1.1 / Kn))                                      [Davies1945]
///
/// @param knudsen  mean free path of the gas over the radius; 0: no slip
/// @return NaN for less than 0
CLAST_API double clast_slip_correction(double knudsen);

/// Factor on the drag of a body among others that settle at this local porosity, with no net flow:
///
///     e^-(n + 1),  n = 3.7 - 0.65 exp(-(1.5 - log10 Re)^2 / 2)                   [DiFelice1994]
///
/// Re by the speed relative to the vessel, which is the superficial slip there. Settling is then
/// slower by e^4.65 in Stokes' range and e^2.4 in Newton's, as Richardson and Zaki measured.
/// @param porosity  counts as 0.36 below that, where beds of spheres end; 1: alone
CLAST_API double clast_drag_hindrance(double reynolds, double porosity);

/// How a body settles.
typedef struct clast_settling {
    double velocity;         ///< m/s, downwards
    double reynolds;         ///< by the volume-equivalent diameter
    double drag_coefficient; ///< -
    bool in_range;           ///< Re < 3e5, where the law was fitted
} clast_settling;

/// Terminal velocity of a body of this volume-equivalent diameter and mean density.
///
/// Solves C_D(Re) Re^2 = 4/3 rho_f (rho - rho_f) g d^3 / mu^2, whose left side rises with Re, to
/// rounding. A body lighter than the fluid rises: its velocity is negative.
/// @return CLAST_E_USAGE for a diameter, density, fluid or correction that is not positive and
///         finite
CLAST_API clast_status clast_terminal_velocity(double diameter, double density,
                                               const clast_drag *drag, const clast_fluid *fluid,
                                               clast_settling *settling);

/// Permeability of grains by their porosity and size.
typedef enum {
    CLAST_PERMEABILITY_HAPPEL,       ///< cell model, porosity 0.3 to 1
    CLAST_PERMEABILITY_KOZENY_CARMAN ///< packed beds, porosity 0.26 to 0.7
} clast_permeability_law;

/// Permeability k [m^2] of grains of this size (6 times volume over surface, Sauter's mean) at this
/// porosity e; with s = (1 - e)^(1/3)
///
///     Happel           k = d^2 / 18 (3 - 4.5 s + 4.5 s^5 - 3 s^6) / (s^3 (3 + 2 s^5)) [Happel1958]
///     Kozeny, Carman   k = d^2 e^3 / (180 (1 - e)^2) [Carman1937]
///
/// @return CLAST_E_USAGE outside of the law's range of porosities, or for a size that is not > 0
CLAST_API clast_status clast_permeability(clast_permeability_law law, double diameter,
                                          double porosity, double *permeability);

/// Stokes drag of a permeable sphere over that of a solid one: creeping flow outside, Brinkman's
/// equation inside, beta the radius over the root of the permeability.
///
///     Omega = 2 beta^2 (1 - tanh(beta) / beta) / (2 beta^2 + 3 (1 - tanh(beta) / beta))
///     [Neale1973]
///
/// 0 at beta 0, 1 at infinity. `core` is the radius of a solid core over that of the sphere, whose
/// shell alone is permeable then (its own solution: core at beta 0).               [Masliyah1987]
/// @return NAN unless beta >= 0 and 0 <= core <= 1
CLAST_API double clast_drag_permeable(double beta, double core);

/// What air flows through.
typedef struct clast_porous {
    double permeability; ///< > 0 [m^2]
    double core;         ///< radius of the solid core over that of the body, in [0, 1)
} clast_porous;

/// Terminal velocity with the whole drag law scaled by clast_drag_permeable.
///
/// That is exact in creeping flow, and was measured on permeable spheres of beta > 15 up to Re 120
/// [Masliyah1980]: in_range is Re <= 1, or beta >= 15 and Re <= 120.
/// @return as clast_terminal_velocity; CLAST_E_USAGE too for a permeability that is not > 0 or a
/// core
///         outside of [0, 1), and where a factor of 0 leaves no drag
CLAST_API clast_status clast_terminal_velocity_permeable(double diameter, double density,
                                                         const clast_drag *drag,
                                                         const clast_fluid *fluid,
                                                         const clast_porous *porous,
                                                         clast_settling *settling);

CLAST_END
