#pragma once
// Whether statistics that a caller has filled himself hold together. Both say what is wrong, for
// people, or give NULL.
#include "base/shared.h"
#include "base/whole.h"
#include <clast/statistics.h>

CLX_SHARED const char *clx_statistics_fault(const clast_statistics *statistics);
const char *clx_histogram_fault(const clast_histogram *histogram);
