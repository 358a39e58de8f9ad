#pragma once
// Points without doubles: equal bit by bit (-0 equals +0) means the same vertex.
#include "base/status.h"

typedef struct clx_vertex_set {
    double (*vert)[3]; ///< [n][3] owned; take it and set it NULL to keep it
    int64_t n, capacity;
    int32_t *slot; ///< [n_slot] vertex number + 1, 0 when free
    int64_t n_slot;
} clx_vertex_set;

/// Number of the point (no NaN in it), added when new; O(1).
clast_status clx_vertex_set_add(clx_vertex_set *set, const double point[3], int32_t *index);

void clx_vertex_set_free(clx_vertex_set *set);
