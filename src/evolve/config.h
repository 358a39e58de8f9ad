#pragma once
// Checks of an evolution's configuration that no single range can see.
#include "base/status.h"
#include <clast/agglomerate.h>
#include <clast/evolve.h>

/// @return CLAST_E_CONFIG with the option, its value and what to do
clast_status clx_evolve_config_check(const clast_evolve_config *config,
                                     const clast_evolve_input *input);

/// Refuses options that a run by the others would not look at.
clast_status clx_evolve_idle_check(const clast_evolve_config *config,
                                   const clast_evolve_input *input);

/// Refuses a box in which particles start that is not all in a box of a domain.
clast_status clx_evolve_release_check(const clast_evolve_input *input);

/// As clast_evolve_create, of a run that goes on: options that it began with are taken as they are.
CLX_SHARED clast_status clx_evolve_create_again(const clast_evolve_config *config,
                                                const clast_evolve_input *input,
                                                clast_evolve **evolve);

/// As clast_evolve_advance, but the leg also ends, to go on with it later, after the step in which
/// the monitor asks to stop or the clock (clx_clock) passes `until`. The monitor is asked within
/// steps too: who asked is heard, though the step comes to its end.
CLX_SHARED clast_status clx_evolve_advance_until(clast_evolve *evolve, const clast_monitor *monitor,
                                                 double until);

/// Kernel's mask and medium in full, from the configuration's words.
clast_status clx_evolve_collide(const clast_evolve_config *config, clast_collide_config *collide);

/// How the smaller of a pair comes, AUTO resolved by the kernel.
int32_t clx_evolve_meeting(const clast_evolve_config *config, uint32_t kernel);

/// The fluid's velocity at z = 0 [m/s].
clast_status clx_evolve_wind_read(const clast_evolve_config *config, double wind[3]);
