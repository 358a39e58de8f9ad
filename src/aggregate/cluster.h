#pragma once
// Clusters that meet clusters, until few are left.
#include "touch/scene.h"
#include <clast/aggregate.h>

/// Grains that stick together; their poses are those of the assembly.
typedef struct clx_cluster {
    int32_t n;
    int64_t room;
    int32_t *grain; ///< [n] in the order of arrival
    int32_t n_contact;
    int64_t contact_room;
    int32_t *contact; ///< [n_contact] of the assembly
    double mass, volume;
    double centre[3];       ///< of mass
    double gyration;        ///< radius of
    clx_touch_scene *scene; ///< its grains in order; NULL until something was thrown at it
} clx_cluster;

typedef struct clx_clusters {
    int32_t n; ///< clusters left
    int64_t room;
    clx_cluster *cluster; ///< [n]
} clx_clusters;

void clx_clusters_free(clx_clusters *clusters);

/// Every particle a cluster of its own.
clast_status clx_clusters_begin(clast_aggregate *a);

/// The same clusters as an earlier run had, from its members table; the grains are in place.
clast_status clx_clusters_restore(clast_aggregate *a, const clast_table *members);

/// Two clusters meet and become one.
clast_status clx_clusters_merge(clast_aggregate *a);

/// The one with most grains, the first of equals.
const clx_cluster *clx_clusters_largest(const clx_clusters *clusters);

/// Sets the clusters that are left side by side along x, so that they can be looked at.
void clx_clusters_spread(clast_aggregate *a);

/// Cluster and place in it of every grain.
clast_status clx_clusters_members(const clast_aggregate *a, clast_table *members);
