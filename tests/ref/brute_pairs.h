#pragma once
// Plain twin of clast_pairs_count: every pair looked at.
#include <clast/cloud.h>

/// Pairs in shells radius[k - 1] <= r < radius[k].
void brute_pairs(const clast_cloud *cloud, int32_t n_shell, const double *radius, int64_t *count);
