// Terminal velocity by the drag law of Bagheri and Bonadonna (2016), "On the drag of freely falling
// non-spherical particles", Powder Technology 301, 526-544. The paper was not at hand; the
// coefficients are those on which the public codes that use the law agree
// (docs/theory/settling.md).
#include <clast/settling.h>

#include "base/status.h"
#include <math.h>

clast_fluid clast_fluid_air(void)
{
    return (clast_fluid){.density = 1.225, .viscosity = 1.7894e-5, .gravity = 9.80665};
}

clast_status clast_drag_of_form(double length, double intermediate, double shortest,
                                double diameter, double density_ratio, clast_drag *drag)
{
    CLX_ARGUMENTS(drag);
    clast_status status = CLAST_OK;
    CLX_CHECK(density_ratio > 0.0 && isfinite(density_ratio), CLAST_E_GEOMETRY,
              "drag: density ratio %g must be finite and above 0", density_ratio);
    CLX_CHECK(shortest > 0.0 && intermediate >= shortest && length >= intermediate &&
                  isfinite(length) && diameter > 0.0 && isfinite(diameter),
              CLAST_E_GEOMETRY, "drag: L %g >= I %g >= S %g > 0 and diameter %g > 0 are needed",
              length, intermediate, shortest, diameter);
    const double elongation = intermediate / length;
    const double flatness = shortest / intermediate;
    const double fullness = diameter / length * (diameter / intermediate) * (diameter / shortest);
    const double stokes = flatness * pow(elongation, 1.3) * fullness;
    const double newton = flatness * flatness * elongation * fullness;
    drag->stokes = 0.5 * (cbrt(stokes) + 1.0 / cbrt(stokes));
    const double heavy = log10(density_ratio);
    const double factor = 0.45 + 10.0 / (exp(2.5 * heavy) + 30.0);
    const double power = 1.0 - 37.0 / (exp(3.0 * heavy) + 100.0);
    drag->newton = newton < 1.0 ? pow(10.0, factor * pow(-log10(newton), power)) : 1.0;
done:
    return status;
}

double clast_drag_coefficient(const clast_drag *drag, double reynolds)
{
    if (drag == NULL) {
        return (double)NAN;
    }
    const double scaled = reynolds * drag->newton / drag->stokes;
    const double root = cbrt(scaled);
    return 24.0 * drag->stokes / reynolds * (1.0 + 0.125 * root * root) +
           0.46 * drag->newton / (1.0 + 5330.0 / scaled);
}

double clast_drag_sphere(double reynolds)
{
    return 24.0 / reynolds * (1.0 + 0.15 * pow(reynolds, 0.687)) +
           0.42 / (1.0 + 42500.0 * pow(reynolds, -1.16));
}

double clast_drag_sphere_reynolds(double best)
{
    if (!(best > 0.0) || isinf(best)) {
        return best == 0.0 ? 0.0 : (double)NAN;
    }
    const double wanted = log(best);
    double x = fmin(wanted - log(24.0), 0.5 * (wanted - log(0.42))); // both laws alone: Re is less
    for (int pass = 0; pass < 60; ++pass) { // Newton on ln(C_D Re^2) in x = ln Re
        const double wake = 42500.0 * exp(-1.16 * x);
        const double creep = 24.0 * exp(-x);
        const double middle = 3.6 * exp(-0.313 * x);
        const double end = 0.42 / (1.0 + wake);
        const double drag = creep + middle + end;
        const double slope = -creep - 0.313 * middle + 1.16 * end * wake / (1.0 + wake);
        const double step = (log(drag) + 2.0 * x - wanted) / (2.0 + slope / drag);
        x -= step;
        if (fabs(step) < 1e-8) { // its square is left
            break;
        }
    }
    return exp(x);
}

double clast_slip_correction(double knudsen)
{
    if (!(knudsen >= 0.0)) {
        return (double)NAN;
    }
    return knudsen > 0.0 ? 1.0 + knudsen * (1.257 + 0.4 * exp(-1.1 / knudsen)) : 1.0;
}

double clast_drag_hindrance(double reynolds, double porosity)
{
    const double off = 1.5 - log10(reynolds);
    const double n = 3.7 - 0.65 * exp(-0.5 * off * off);
    return pow(porosity < 0.36 ? 0.36 : porosity > 1.0 ? 1.0 : porosity, -(n + 1.0));
}

/// Root of C_D Re^2 = wanted by halving in log Re between bounds that hold it.
static double solve_reynolds(double wanted, const clast_drag *drag)
{
    CLAST_ASSERT(wanted >= 0.0);
    double low = -300.0;
    double high = log(wanted / (24.0 * drag->stokes)); // Stokes drag alone is less: Re is less
    low = fmin(low, high - 1.0);
    for (int pass = 0; pass < 200; ++pass) {
        const double middle = 0.5 * (low + high);
        const double reynolds = exp(middle);
        if (middle <= low || middle >= high) {
            break;
        }
        *(clast_drag_coefficient(drag, reynolds) * reynolds * reynolds < wanted ? &low : &high) =
            middle;
    }
    return exp(0.5 * (low + high));
}

clast_status clast_terminal_velocity(double diameter, double density, const clast_drag *drag,
                                     const clast_fluid *fluid, clast_settling *settling)
{
    CLX_ARGUMENTS(drag, fluid, settling);
    clast_status status = CLAST_OK;
    CLX_CHECK(diameter > 0.0 && isfinite(diameter), CLAST_E_USAGE,
              "settling: diameter %g must be finite and above 0", diameter);
    CLX_CHECK(density > 0.0 && isfinite(density), CLAST_E_USAGE,
              "settling: density %g must be finite and above 0", density);
    CLX_CHECK(fluid->density > 0.0 && fluid->viscosity > 0.0 && fluid->gravity > 0.0 &&
                  isfinite(fluid->density + fluid->viscosity + fluid->gravity),
              CLAST_E_USAGE,
              "settling: fluid density %g, viscosity %g, gravity %g must be finite and above 0",
              fluid->density, fluid->viscosity, fluid->gravity);
    CLX_CHECK(drag->stokes > 0.0 && drag->newton > 0.0 && isfinite(drag->stokes + drag->newton),
              CLAST_E_USAGE, "settling: drag corrections %g and %g must be finite and above 0",
              drag->stokes, drag->newton);
    const double excess = density - fluid->density;
    const double cube = diameter * diameter * diameter;
    const double wanted = 4.0 / 3.0 * fluid->density * fabs(excess) * fluid->gravity * cube /
                          (fluid->viscosity * fluid->viscosity);
    *settling = (clast_settling){.in_range = true, .drag_coefficient = INFINITY};
    if (wanted > 0.0) {
        settling->reynolds = solve_reynolds(wanted, drag);
        settling->velocity =
            copysign(settling->reynolds * fluid->viscosity / (fluid->density * diameter), excess);
        settling->drag_coefficient = clast_drag_coefficient(drag, settling->reynolds);
        settling->in_range = settling->reynolds < 3e5;
    }
done:
    return status;
}
