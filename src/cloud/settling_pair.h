#pragma once
// Settling particles as kernels, ranges and sticking laws see them. [docs/theory/agglomeration.md
// section 1]
#include <clast/kernel.h>

/// The settling speed that the collider holds, or clast_kernel_settling_speed [m/s].
double clx_settling_speed_of(const clast_medium *medium, const clast_collider *a);

/// clast_kernel_value of arguments that have been looked at.
double clx_kernel_sum(uint32_t mask, const clast_medium *medium, const clast_collider *a,
                      const clast_collider *b);

/// Stokes' response time m C / (6 pi mu a) [s].
double clx_response_time(const clast_medium *medium, const clast_collider *a);

/// Variance of a component of a particle's turbulent velocity [m^2/s^2]: its own, or the fluid's
/// damped by its Stokes response time, U^2 / (1 + 1.5 tau eps / U^2).              [Abrahamson1975]
double clx_velocity_variance(const clast_medium *medium, const clast_collider *a);

/// tau of the smaller particle times a speed over the radius of the larger one: Langmuir's K.
double clx_stokes_of_pair(const clast_medium *medium, const clast_collider *a,
                          const clast_collider *b, double speed);
