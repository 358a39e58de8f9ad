#pragma once
// All grains of an assembly as bodies that can be asked for gaps and overlaps.
#include "touch/body.h"
#include "touch/scene.h"
#include <clast/assembly.h>

typedef struct clx_touch_set {
    int32_t n_shape;
    clx_touch_tree **tree;  ///< [n_shape], NULL for round shapes
    clx_touch_scene *scene; ///< body i is grain i
} clx_touch_set;

/// {0} is empty. @return CLAST_E_MEMORY, CLAST_E_GEOMETRY from the trees
clast_status clx_touch_set_init(const clast_assembly *assembly, clx_touch_set *set);
void clx_touch_set_free(clx_touch_set *set);

/// Pairs of grains, i < j, in rising order.
typedef struct clx_pairs {
    int32_t n;
    int32_t (*pair)[2];
    double (*point)[3]; ///< between the closest points, for clx_touch_set_within only
    int64_t pair_capacity, point_capacity;
    clast_status status; ///< of the collecting
} clx_pairs;

void clx_pairs_free(clx_pairs *pairs);

/// Pairs whose boxes meet.
clast_status clx_touch_set_near(const clx_touch_set *set, clx_pairs *pairs);

/// Pairs within `gap` of each other.
clast_status clx_touch_set_within(const clx_touch_set *set, double gap, clx_pairs *pairs);
