// Laws of sticking. [docs/theory/agglomeration.md section 8]
#include <clast/kernel.h>

#include "base/status.h"
#include <math.h>

/// Integral of force over displacement of a JKR contact from the displacement 0, where the surfaces
/// jump into contact, to where they part, over (Gamma^5 R^4 / E*^2)^(1/3).     [Johnson1971]
static const double JKR_WORK = 7.092195971863947;

static double reduced(const double pair[2])
{
    return pair[0] * pair[1] / (pair[0] + pair[1]);
}

clast_status clast_sticking_check(const clast_sticking *s)
{
    CLX_ARGUMENTS(s);
    clast_status status = CLAST_OK;
    const bool is_film = s->law == CLAST_STICKING_VISCOUS || s->law == CLAST_STICKING_LIQUID;
    CLX_CHECK(s->law >= CLAST_STICKING_CONSTANT && s->law <= CLAST_STICKING_CONTACT, CLAST_E_CONFIG,
              "sticking: there is no law %d", s->law);
    CLX_CHECK(!is_film || (s->film_viscosity > 0.0 && isfinite(s->film_viscosity)), CLAST_E_CONFIG,
              "sticking %s needs --film-viscosity > 0",
              s->law == CLAST_STICKING_VISCOUS ? "viscous" : "liquid");
    CLX_CHECK(s->law != CLAST_STICKING_VISCOUS ||
                  (s->asperity > 0.0 && s->film_thickness > s->asperity &&
                   isfinite(s->film_thickness) && s->restitution > 0.0 && s->restitution <= 1.0),
              CLAST_E_CONFIG,
              "sticking viscous needs --film-thickness > --asperity > 0 and --restitution in (0, "
              "1], not %s, %s and %g",
              clx_unit_text(s->film_thickness, "m"), clx_unit_text(s->asperity, "m"),
              s->restitution);
    CLX_CHECK(s->law != CLAST_STICKING_LIQUID ||
                  (s->critical_stokes > 0.0 && isfinite(s->critical_stokes) &&
                   s->stokes_exponent > 0.0 && isfinite(s->stokes_exponent)),
              CLAST_E_CONFIG,
              "sticking liquid needs --critical-stokes and --stokes-exponent > 0, not %g and %g",
              s->critical_stokes, s->stokes_exponent);
    CLX_CHECK(s->law != CLAST_STICKING_CONTACT ||
                  (s->adhesion > 0.0 && isfinite(s->adhesion) && s->young > 0.0 &&
                   isfinite(s->young) && fabs(s->poisson) < 1.0),
              CLAST_E_CONFIG,
              "sticking contact needs --adhesion > 0 and --young > 0, not %g J/m^2 and %s",
              s->adhesion, clx_unit_text(s->young, "Pa"));
done:
    return status;
}

double clast_sticking_stokes(const clast_sticking *s, const clast_impact *hit)
{
    if (s == NULL || hit == NULL) {
        return (double)NAN;
    }
    if (s->law == CLAST_STICKING_VISCOUS) {
        const double a = reduced(hit->curvature);
        return reduced(hit->mass) * hit->speed / (6.0 * CLAST_PI * s->film_viscosity * a * a);
    }
    if (s->law == CLAST_STICKING_LIQUID) {
        const double *a = hit->radius;
        const double volume = 4.0 / 3.0 * CLAST_PI * (a[0] * a[0] * a[0] + a[1] * a[1] * a[1]);
        const double density = (hit->mass[0] + hit->mass[1]) / volume;
        return 8.0 * density * hit->speed / (9.0 * s->film_viscosity) * 2.0 * reduced(a);
    }
    return (double)NAN;
}

double clast_sticking_speed(const clast_sticking *s, const clast_impact *hit)
{
    if (s == NULL || hit == NULL) {
        return (double)NAN;
    }
    const double a = reduced(hit->curvature);
    const double stiff = s->young / (2.0 * (1.0 - s->poisson * s->poisson));
    const double adhesive = s->adhesion * a;
    // Gamma^5 a^4 / E^2 = (Gamma a)^4 Gamma / E^2
    const double work =
        JKR_WORK * cbrt(adhesive * adhesive * adhesive * adhesive * s->adhesion / (stiff * stiff));
    return sqrt(2.0 * work / reduced(hit->mass));
}

double clast_sticking_share(const clast_sticking *s, const clast_impact *hit)
{
    if (s == NULL || hit == NULL) {
        return (double)NAN;
    }
    switch (s->law) {
    case CLAST_STICKING_VISCOUS:
        return clast_sticking_stokes(s, hit) <
                       (1.0 + 1.0 / s->restitution) * log(s->film_thickness / s->asperity)
                   ? 1.0
                   : 0.0;
    case CLAST_STICKING_LIQUID:
        return 1.0 /
               (1.0 + pow(clast_sticking_stokes(s, hit) / s->critical_stokes, s->stokes_exponent));
    case CLAST_STICKING_CONTACT:
        return hit->speed < clast_sticking_speed(s, hit) ? 1.0 : 0.0;
    default:
        return 1.0;
    }
}
