// Drag of permeable spheres: Brinkman's equation in the sphere, or in its shell about a solid core.
//
// Radii by that of the sphere. The flow is u_r = f(r) cos t, u_t = -(f + r f' / 2) sin t with the
// pressure P(r) cos t. Outside f = 1 + a/r + b/r^3 and P = a/r^2; inside
//     f = -c + 2 d / r^3 + (e i(beta r) + h k(beta r)) / r     P = beta^2 (c r + d / r^2)
// with the modified spherical Bessel functions of order 1. f, f', f'' and P are continuous at the
// surface (velocity and stress), f = f' = 0 on the core. The drag over that of a solid sphere is
// -2 a / 3. [Neale1973 without a core, in closed form; Masliyah1987 with one]
#include <clast/settling.h>

#include "base/status.h"
#include <math.h>

/// Below, the shell's solution loses its digits, and the flow hardly feels the shell.
static const double BETA_LEAST = 1e-2;

/// Above, exponentials leave double precision; the shell is as good as solid.
static const double BETA_MOST = 1e5;

clast_status clast_permeability(clast_permeability_law law, double diameter, double porosity,
                                double *permeability)
{
    CLX_ARGUMENTS(permeability);
    clast_status status = CLAST_OK;
    const bool happel = law == CLAST_PERMEABILITY_HAPPEL;
    const double low = happel ? 0.3 : 0.26;
    const double high = happel ? 1.0 : 0.7;
    CLX_CHECK(happel || law == CLAST_PERMEABILITY_KOZENY_CARMAN, CLAST_E_ARGUMENT,
              "permeability: law %d does not exist", (int)law);
    CLX_CHECK(diameter > 0.0 && isfinite(diameter), CLAST_E_USAGE,
              "permeability: grain size %g must be finite and above 0", diameter);
    CLX_CHECK(porosity >= low && porosity <= high && porosity < 1.0, CLAST_E_USAGE,
              "permeability: porosity %g is outside of %s, %g to %g", porosity,
              happel ? "Happel's cell model" : "Kozeny and Carman's beds", low, high);
    const double solid = 1.0 - porosity;
    const double s = cbrt(solid);
    const double s5 = solid * s * s;
    *permeability =
        happel ? diameter * diameter / 18.0 * (3.0 - 4.5 * s + 4.5 * s5 - 3.0 * solid * solid) /
                     (solid * (3.0 + 2.0 * s5))
               : diameter * diameter * porosity * porosity * porosity / (180.0 * solid * solid);
done:
    return status;
}

/// Values of one inner solution: f, f', f'' and P at a radius.
typedef struct {
    double f, slope, curve, pressure;
} mode;

/// y(beta r) / r from y, y' of the modified spherical Bessel equation of order 1,
/// y'' = (1 + 2 / x^2) y - (2 / x) y'.
static mode bessel(double beta, double r, double y, double slope)
{
    const double x = beta * r;
    const double curve = (1.0 + 2.0 / (x * x)) * y - 2.0 / x * slope;
    return (mode){.f = y / r,
                  .slope = beta * slope / r - y / (r * r),
                  .curve = beta * beta * curve / r - 2.0 * beta * slope / (r * r) +
                           2.0 * y / (r * r * r)};
}

/// The four inner solutions at radius r, the growing one by exp(-beta), the falling one by
/// exp(beta core), so that none is beyond a double.
static void inner_modes(double beta, double core, double r, mode m[4])
{
    CLAST_ASSERT(core >= 0.0 && core <= r);
    const double x = beta * r;
    const double rise = exp(x - beta);
    const double sink = exp(-x - beta);
    const double fall = exp(beta * core - x);
    const double i0 = 0.5 * (rise - sink) / x;
    const double i1 = 0.5 * (rise + sink) / x - i0 / x;
    const double k0 = fall / x;
    const double k1 = fall * (1.0 / x + 1.0 / (x * x));
    m[0] = (mode){-1.0, 0.0, 0.0, beta * beta * r};
    m[1] = (mode){2.0 / (r * r * r), -6.0 / (r * r * r * r), 24.0 / (r * r * r * r * r),
                  beta * beta / (r * r)};
    m[2] = bessel(beta, r, i1, i0 - 2.0 * i1 / x);
    m[3] = bessel(beta, r, k1, -k0 - 2.0 * k1 / x);
}

enum { N = 6 };

/// Gauss's elimination with the greatest pivot; the first unknown.
static double solve_first(double m[N][N + 1])
{
    for (int c = N - 1; c >= 0; --c) { // the first unknown is left for last
        int best = c;
        for (int r = 0; r < c; ++r) {
            best = fabs(m[r][c]) > fabs(m[best][c]) ? r : best;
        }
        for (int k = 0; k <= N; ++k) {
            const double kept = m[c][k];
            m[c][k] = m[best][k];
            m[best][k] = kept;
        }
        for (int r = 0; r < c; ++r) {
            const double factor = m[r][c] / m[c][c];
            for (int k = 0; k <= N; ++k) {
                m[r][k] -= factor * m[c][k];
            }
        }
    }
    return m[0][N] / m[0][0];
}

static double drag_of_shell(double beta, double core)
{
    mode at[4];
    mode on[4];
    inner_modes(beta, core, 1.0, at);
    inner_modes(beta, core, core, on);
    // unknowns a, b, then the four; outside minus inside
    double m[N][N + 1] = {{1.0, 1.0, 0, 0, 0, 0, -1.0},
                          {-1.0, -3.0, 0, 0, 0, 0, 0.0},
                          {2.0, 12.0, 0, 0, 0, 0, 0.0},
                          {1.0, 0.0, 0, 0, 0, 0, 0.0}};
    for (int k = 0; k < 4; ++k) {
        m[0][2 + k] = -at[k].f;
        m[1][2 + k] = -at[k].slope;
        m[2][2 + k] = -at[k].curve;
        m[3][2 + k] = -at[k].pressure;
        m[4][2 + k] = on[k].f;
        m[5][2 + k] = on[k].slope;
    }
    return -2.0 / 3.0 * solve_first(m);
}

double clast_drag_permeable(double beta, double core)
{
    if (!(beta >= 0.0) || !(core >= 0.0 && core <= 1.0)) {
        return (double)NAN;
    }
    if (core == 1.0 || (core > 0.0 && beta > BETA_MOST) || isinf(beta)) {
        return 1.0;
    }
    if (core > 0.0) {
        return beta < BETA_LEAST ? core : drag_of_shell(beta, core);
    }
    // 1 - tanh(beta) / beta, by its series where that would cancel
    const double b2 = beta * beta;
    const double part = beta < 1e-2 ? b2 * (1.0 / 3.0 - 2.0 / 15.0 * b2) : 1.0 - tanh(beta) / beta;
    return beta > 0.0 ? 2.0 * b2 * part / (2.0 * b2 + 3.0 * part) : 0.0;
}

clast_status clast_terminal_velocity_permeable(double diameter, double density,
                                               const clast_drag *drag, const clast_fluid *fluid,
                                               const clast_porous *porous, clast_settling *settling)
{
    CLX_ARGUMENTS(drag, fluid, porous, settling);
    clast_status status = CLAST_OK;
    clast_settling made;
    const double k = porous->permeability;
    CLX_CHECK(k > 0.0 && porous->core >= 0.0 && porous->core < 1.0, CLAST_E_USAGE,
              "settling: permeability %g must be above 0, the core %g of the radius below 1", k,
              porous->core);
    const double beta = 0.5 * diameter / sqrt(k);
    const double factor = clast_drag_permeable(beta, porous->core);
    CLX_CHECK(factor > 0.0, CLAST_E_USAGE,
              "settling: a permeability of %g m^2 leaves no drag on a diameter of %s", k,
              clx_unit_text(diameter, "m"));
    const clast_drag scaled = {.stokes = factor * drag->stokes, .newton = factor * drag->newton};
    CLX_TRY(clast_terminal_velocity(diameter, density, &scaled, fluid, &made));
    made.in_range = made.reynolds <= 1.0 || (beta >= 15.0 && made.reynolds <= 120.0);
    *settling = made;
done:
    return status;
}
