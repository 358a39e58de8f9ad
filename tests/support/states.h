#pragma once
#include <clast/state.h>

/// The state that data/state/schema1.h5 holds: 6 grains of 3 shapes in mm with 2 contacts, spheres
/// called fill, a table called history, a configuration. Free it with clast_state_free.
clast_status support_state(clast_state *state);
