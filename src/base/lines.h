#pragma once
// Arrays that hot loops go through.
#include "base/status.h"

/// clx_grow for them: they begin with a cache line, and large ones ask for large pages. From a
/// capacity of 0 it takes just what is needed, from 16 on.
CLX_SHARED clast_status clx_grow_lines(void *block, int64_t *capacity, int64_t need, size_t size);
