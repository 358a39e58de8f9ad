#pragma once
// The parts of a state file, for checkpoints and other files that hold them too.
#include "base/status.h"
#include "io/h5.h"
#include <clast/state.h>

enum { CLX_STATE_SCHEMA = 1 };

/// Marks a file as one of clast's: schema, versions, unit.
clast_status clx_state_put_head(clx_h5 *h5, const char *unit);

/// Checks the mark; version and unit may be NULL.
clast_status clx_state_take_head(clx_h5 *h5, char version[32], char unit[16]);

/// Takes an assembly, spheres or a table out of a folder such as "/assembly"; the outputs must be
/// empty and stay so on failure.
clast_status clx_state_take_assembly(clx_h5 *h5, const char *folder, clast_assembly *assembly);
clast_status clx_state_take_spheres(clx_h5 *h5, const char *folder, clast_spheres *spheres);
clast_status clx_state_take_table(clx_h5 *h5, const char *folder, clast_table *table);

/// Keeps all of a state, as clast_state_write does, in a file being built.
CLX_SHARED clast_status clx_state_put(clx_h5 *h5, const clast_state *state);
