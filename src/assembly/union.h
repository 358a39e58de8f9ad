#pragma once
// The union's volume where the grains lie in a scene of contact already.
#include "contact/touch_scene.h"
#include <clast/overlap.h>

/// clast_assembly_union of grains whose true solids are the scene's bodies: body i is grain i. It
/// spares the trees of the shapes, which for a small aggregate cost as much as the rest.
clast_status clx_union_of_scene(const clast_assembly *assembly, clx_touch_scene *scene,
                                const clast_union_options *options, clast_union *out);
