#pragma once
// Clusters that join clusters, until few are left.
#include "touch/scene.h"
#include <clast/aggregate.h>

/// Grains that stick together; their poses are those of the assembly.
typedef struct clx_cluster {
    int32_t n;
    int64_t capacity;
    int32_t *grain; ///< [n] in the order of arrival
    int32_t n_contact;
    int64_t contact_capacity;
    int32_t *contact; ///< [n_contact] of the assembly
    double mass, volume;
    double centre[3];       ///< of mass
    double gyration;        ///< radius of
    clx_touch_scene *scene; ///< its grains in order; NULL until something was thrown at it
} clx_cluster;

typedef struct clx_clusters {
    int32_t n; ///< clusters left
    int64_t capacity;
    clx_cluster *cluster; ///< [n]
} clx_clusters;

void clx_clusters_free(clx_clusters *clusters);

/// Cluster and place in it of every grain.
clast_status clx_clusters_members(const clast_aggregate *a, clast_table *members);
