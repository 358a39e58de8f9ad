#pragma once
// Whether a decomposition, as a caller hands it back, holds together.
#include "base/status.h"

typedef struct clast_cells clast_cells;
typedef struct clast_decomposition clast_decomposition;

/// What is wrong, for people, or NULL.
CLX_SHARED const char *clx_decomposition_fault(const clast_decomposition *result);

/// The same of the cells alone, in which `n_point` points lie.
const char *clx_cells_fault(const clast_cells *cells, int64_t n_point);
