#pragma once
// One call of qhull_r: its memory, its messages and its exit, in one place.
#include "base/status.h"
#include <libqhull_r/qhull_ra.h>

/// Runs qhull on n points (packed, `point` may be scaled by it) and hands the result to `use`.
///
/// @param what names the job in messages, "convex hull" say
/// @return what `use` returns; CLAST_E_GEOMETRY with qhull's first line; CLAST_E_MEMORY
clast_status clx_qhull(const char *what, const char *options, int n, double *point,
                       clast_status (*use)(qhT *qh, void *context), void *context);
