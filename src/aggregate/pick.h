#pragma once
// Which two clusters meet next.
#include <clast/aggregate.h>

/// Two different clusters, a function of (seed, mergers so far) and the clusters' order.
void clx_pick_pair(const clast_aggregate *a, int32_t pair[2]);
