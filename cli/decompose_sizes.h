#pragma once
// Events against the number of points: random parts of one cloud, decomposed each by itself.
#include <clast/clast.h>

typedef struct cli_sizes {
    int32_t n_size;  ///< parts of n, n/2, n/4, ... points
    int32_t regular; ///< a regular mesh of so many cells an axis beside; 0: none
} cli_sizes;

/// A row a part, smallest first: n, events, events_low, events_high, n_cell, and the events scaled
/// by (N / n)^2 to all points, scaled_...; with a regular mesh regular_events and scaled_regular.
/// Without beta dt they are pair_integral, ... [1/m^d].
clast_status cli_decompose_sizes(const clast_domain *domain, const clast_cloud *cloud,
                                 const clast_decompose_config *config, const cli_sizes *sizes,
                                 clast_table *table);

/// Chart of scaled events over n.
clast_status cli_decompose_sizes_chart(const clast_table *table, int32_t dimension,
                                       const char *path);
