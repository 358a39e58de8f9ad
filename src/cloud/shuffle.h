#pragma once
// A cloud's points in a random order that neither their ranks nor their rows decide: parts of it
// are random parts of the cloud.
#include <clast/cloud.h>

/// This rank's share of all points, in random order.
typedef struct clx_shuffled {
    const clast_comm *comm; ///< borrowed
    clast_cloud cloud;      ///< positions, weights and the variable
    uint64_t *key;          ///< [cloud.n] ascending: the place of each in the order of all
    int64_t n_all;
} clx_shuffled;

/// Points go to the rank that a hash of their position, weight and variable names: evenly, but for
/// points that have all of these in common. Called by all ranks.
clast_status clx_shuffle(const clast_comm *comm, const clast_cloud *cloud, uint64_t seed,
                         clx_shuffled *shuffled);

/// How many of this rank's points, its first, are among the first m of all; called by all ranks.
int64_t clx_shuffled_first(const clx_shuffled *shuffled, int64_t m);
void clx_shuffled_free(clx_shuffled *shuffled);
