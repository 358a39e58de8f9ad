#pragma once
// Whether statistics that a caller has filled himself hold together. Both say what is wrong, for
// people, or give NULL.
#include "base/status.h"

typedef struct clast_histogram clast_histogram;
typedef struct clast_statistics clast_statistics;

CLX_SHARED const char *clx_statistics_fault(const clast_statistics *statistics);
const char *clx_histogram_fault(const clast_histogram *histogram);
