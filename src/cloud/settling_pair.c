// Settling speeds and the share of a swept cylinder that meets. [docs/theory/agglomeration.md
// section 1]
#include "cloud/settling_pair.h"

#include <clast/settling.h>
#include <math.h>

double clx_response_time(const clast_medium *m, const clast_collider *a)
{
    return a->mass * clast_slip_correction(m->mean_free_path / a->radius) /
           (6.0 * CLAST_PI * m->viscosity * a->radius);
}

double clx_velocity_variance(const clast_medium *m, const clast_collider *a)
{
    if (a->speed_rms > 0.0) {
        return a->speed_rms * a->speed_rms;
    }
    const double u2 = m->speed_rms * m->speed_rms;
    const double tau = clx_response_time(m, a);
    return u2 > 0.0 ? u2 / (1.0 + 1.5 * tau * m->dissipation / u2) : 0.0;
}

double clast_kernel_settling_speed(const clast_medium *m, const clast_collider *a)
{
    if (m == NULL || a == NULL) {
        return (double)NAN;
    }
    const double sphere = 4.0 / 3.0 * CLAST_PI * a->radius * a->radius * a->radius;
    const double lift = m->particle_density > 0.0 ? m->density / m->particle_density
                                                  : sphere * m->density / a->mass;
    const double creeping = a->mass * (1.0 - lift) * m->gravity /
                            (6.0 * CLAST_PI * m->viscosity * a->radius) *
                            clast_slip_correction(m->mean_free_path / a->radius);
    const double reynolds = 2.0 * a->radius * fabs(creeping) * m->density / m->viscosity;
    if (m->settling_law == CLAST_SETTLING_STOKES || !(reynolds > 0.0)) {
        return creeping;
    }
    return creeping * (clast_drag_sphere_reynolds(24.0 * reynolds) / reynolds);
}

double clx_settling_speed_of(const clast_medium *m, const clast_collider *a)
{
    return a->settling_speed != 0.0 ? a->settling_speed : clast_kernel_settling_speed(m, a);
}

/// Whether a is the smaller of two (of equal radii the lighter).
static bool is_smaller(const clast_collider *a, const clast_collider *b)
{
    return a->radius < b->radius || (a->radius == b->radius && a->mass < b->mass);
}

double clx_stokes_of_pair(const clast_medium *m, const clast_collider *a, const clast_collider *b,
                          double speed)
{
    const bool a_small = is_smaller(a, b);
    return clx_response_time(m, a_small ? a : b) * speed / (a_small ? b : a)->radius;
}

/// Between creeping and potential flow.                                         [Langmuir1948]
static double between(double creeping, double potential, double reynolds)
{
    const double share = reynolds / 60.0;
    return (creeping + potential * share) / (1.0 + share);
}

double clast_kernel_collision_efficiency(const clast_medium *m, const clast_collider *a,
                                         const clast_collider *b)
{
    if (m == NULL || a == NULL || b == NULL) {
        return (double)NAN;
    }
    if (m->efficiency > 0.0) {
        return m->efficiency;
    }
    const double speed = fabs(clx_settling_speed_of(m, a) - clx_settling_speed_of(m, b));
    const double large = fmax(a->radius, b->radius);
    const double reynolds = 2.0 * large * speed * m->density / m->viscosity;
    const double st = clx_stokes_of_pair(m, a, b, speed);
    const double creeping =
        st > 1.214 ? 1.0 + 0.75 * log(2.0 * st) / (st - 1.214) : (double)INFINITY;
    const double potential = st > 1.0 / 12.0 ? st / (st + 0.5) : 0.0;
    const double inertia = between(1.0 / (creeping * creeping), potential * potential, reynolds);
    const double q = large / (a->radius + b->radius); // 1 / (1 + p)
    const double interception = between(1.0 - 1.5 * q + 0.5 * q * q * q, 1.0 - q * q * q, reynolds);
    return 1.0 - (1.0 - inertia) * (1.0 - interception);
}
