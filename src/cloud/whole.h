#pragma once
// Whether a decomposition, as a caller hands it back, holds together.
#include "base/status.h"

typedef struct clast_decomposition clast_decomposition;

/// What is wrong, for people, or NULL.
CLX_SHARED const char *clx_decomposition_fault(const clast_decomposition *result);
