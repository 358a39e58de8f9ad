#pragma once
// The union's volume where the grains lie in a scene of contact already.
#include "touch/scene.h"

typedef struct clast_union clast_union;
typedef struct clast_union_options clast_union_options;
typedef struct clx_pairs clx_pairs;
typedef struct clx_touch_set clx_touch_set;

/// clast_assembly_union of grains whose true solids are the scene's bodies: body i is grain i. It
/// spares the trees of the shapes, which for a small aggregate cost as much as the rest.
clast_status clx_union_of_scene(const clast_assembly *assembly, clx_touch_scene *scene,
                                const clast_union_options *options, clast_union *out);

/// Puts the contacts that `made` carries in place of the assembly's; `made` has none then.
void clx_contacts_replace(clast_assembly *assembly, clast_assembly *made);

/// Keeps the pairs that overlap: n_overlap, max_overlap and max_overlap_share of `out`.
///
/// @param find_depth  false: the depths are NaN
clast_status clx_keep_overlaps(const clast_assembly *assembly, const clx_touch_set *set,
                               bool find_depth, clx_pairs *pairs, clast_union *out);
