#pragma once
#include "base/status.h"
#include <clast/grading.h>

/// The plain struct of a caller: what clast_curve_make would refuse, here too.
clast_status clx_curve_check(const clast_curve *curve);
