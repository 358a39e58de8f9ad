#pragma once
// The parts of a state file, for checkpoints and other files that hold them too.
#include "base/status.h"
#include "io/h5.h"
#include <clast/state.h>

enum { CLX_STATE_SCHEMA = 1 };

/// Marks a file as one of clast's: schema, versions, unit.
clast_status clx_state_write_head(clx_h5 *h5, const char *unit);

/// Checks the mark; version and unit may be NULL.
clast_status clx_state_read_head(clx_h5 *h5, char version[32], char unit[16]);

/// Reads an assembly, spheres or a table from a folder such as "/assembly"; the outputs must be
/// empty and stay so on failure.
clast_status clx_state_read_assembly(clx_h5 *h5, const char *folder, clast_assembly *assembly);
clast_status clx_state_read_spheres(clx_h5 *h5, const char *folder, clast_spheres *spheres);
clast_status clx_state_read_table(clx_h5 *h5, const char *folder, clast_table *table);

/// Writes all of a state, as clast_state_write does, into a file being built.
CLX_SHARED clast_status clx_state_write_to(clx_h5 *h5, const clast_state *state);
