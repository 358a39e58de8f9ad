// How a fluid at rest slows what turns in it.
//
// Stokes' torque on a sphere that turns in a fluid at rest, 8 pi mu R^3 w    [Lamb1932 sec. 334],
// with R that of the sphere of equal volume. Implicit in the spin, so that it never turns a grain
// round, however small the grain or long the step.
#include "dem/fluid.h"

#include <string.h>

/// Torque over spin [N m s].
static double resistance(const clast_dem *dem, const clx_grain *g)
{
    const double r = g->round_radius;
    return 8.0 * CLAST_PI * dem->config.fluid_viscosity * r * r * r;
}

double clx_fluid_spin_factor(const clast_dem *dem, const clx_grain *g, double dt)
{
    return 1.0 / (1.0 + dt * resistance(dem, g) * 2.5 / (g->mass * g->radius * g->radius));
}

void clx_fluid_slow(const clast_dem *dem, int64_t i, double dt, double x[3])
{
    const clx_grain *g = &dem->grain[i];
    const double share = dt * resistance(dem, g) * dem->motion[i].inverse_factor;
    double a[3][3]; // columns of 1 + dt resistance I^-1, which is symmetric, in the body's axes
    double turn[3][3];
    double in_body[3];
    double across[3][3];
    double solved[3];
    memcpy(turn, g->turn, sizeof turn);
    for (int k = 0; k < 3; ++k) {
        v3_scale(a[k], share, dem->body[g->shape].inverse_inertia[k]);
        a[k][k] += 1.0;
    }
    m3_mul_t(in_body, turn, x);
    for (int k = 0; k < 3; ++k) {
        v3_cross(across[k], a[(k + 1) % 3], a[(k + 2) % 3]);
    }
    const double det = v3_dot(a[0], across[0]);
    for (int k = 0; k < 3; ++k) {
        solved[k] = v3_dot(in_body, across[k]) / det;
    }
    m3_mul(x, turn, solved);
}
