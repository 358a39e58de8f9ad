#pragma once
// Sets that only merge; a set is named by its smallest member, so that names do not depend on the
// order of merging.
#include <stdint.h>

static inline void clx_sets_init(int32_t *parent, int32_t n)
{
    for (int32_t i = 0; i < n; ++i) {
        parent[i] = i;
    }
}

static inline int32_t clx_sets_find(int32_t *parent, int32_t i)
{
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static inline void clx_sets_join(int32_t *parent, int32_t i, int32_t j)
{
    const int32_t a = clx_sets_find(parent, i);
    const int32_t b = clx_sets_find(parent, j);
    if (a < b) {
        parent[b] = a;
    } else {
        parent[a] = b;
    }
}
