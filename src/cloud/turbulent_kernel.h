#pragma once
// Geometric collisions of settling inertial particles in turbulence. [Ayala2008b]
#include <clast/kernel.h>

/// Whether the parametrisation has real time and length scales: needs Re_lambda > 60 or so.
bool clx_turbulent_kernel_fits(const clast_medium *medium);

/// Twice the mean radial relative speed, 2 <|w_r|> [m/s]: |w1 - w2| where settling alone acts.
double clx_turbulent_speed(const clast_medium *medium, const clast_collider *a,
                           const clast_collider *b);

/// Kolmogorov's length [m].
double clx_kolmogorov_length(const clast_medium *medium);

/// 2 pi R^2 <|w_r|> g12.
double clx_turbulent_kernel(const clast_medium *medium, const clast_collider *a,
                            const clast_collider *b);
