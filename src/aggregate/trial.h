#pragma once
// One particle's search: rays in a cone, orientations on each ray, the placement nearest the
// target.
#include "aggregate/aim.h"
#include "aggregate/template.h"
#include "base/parallel.h"
#include "touch/scene.h"

/// Work that has nothing to do with a search and is done beside it, a piece at a time: the longest
/// first.
typedef struct clx_beside {
    int64_t n_piece;
    clx_kernel work; ///< called for one piece, by any thread
    void *context;
} clx_beside;

/// What is thrown at what, and from where.
typedef struct clx_search {
    const clx_templates *templates;
    const clx_template *group;
    double scale;
    double size; ///< as the sizes mean it; the unit of `start` [m]

    const clx_touch_scene *scene;
    int32_t n_body;            ///< of the scene, that the particle may meet: the first so many
    const int64_t *sphere_end; ///< [bodies] running count of composite spheres, for SPHERE
    int32_t origin;            ///< clast_ray_origin, but never AUTO
    double centre[3];          ///< rays' origin for CORE and MASS
    double target[3];
    int32_t approach;       ///< clast_approach
    double bounding_radius; ///< everything lies within this distance of `centre`, unless CENTRAL
    double walk_step;       ///< least step of a walk, by the radius of the smallest part

    clx_aim aim;
    int32_t n_orientation; ///< on each of aim.n_ray rays
    double start;          ///< sizes beyond the ray's last hit, 0: from outside of all
    bool on_one_thread;    ///< the search is too short to share
    clx_beside beside;     ///< done when the search is
} clx_search;

/// Where a particle came to rest.
typedef struct clx_placement {
    bool found;
    int64_t trial;
    double distance; ///< centre of mass to target
    double along;    ///< centre = origin + along * direction
    double origin[3], direction[3];
    double centre[3];
    double orientation[4];
    int32_t part; ///< of the group, that touches
    clx_touch touch;
} clx_placement;

/// First touch of all parts of the group that moves along the path; false if none touches or the
/// trial is beaten. Fills touch and part of the placement.
bool clx_search_fly(const clx_search *search, const double origin[3], const double orientation[4],
                    const clx_touch_path *path, clx_placement *placement);

/// Attempts, a new axis or walk each, before a search is given up.
int32_t clx_search_tries(const clast_aggregate_params *params);

/// What those are, for messages: axes, lines or walks.
const char *clx_search_paths(const clx_search *search);

/// The best of all trials; ties go to the lower trial number, so threads do not matter.
///
/// @return CLAST_E_MEMORY
clast_status clx_search_run(const clx_search *search, clx_placement *best);

/// Distance that the placed particle must step back along its ray until nothing overlaps; 0 when
/// it touches within rounding. Checks the answer by another way than the one that found it.
double clx_search_overlap(const clx_search *search, const clx_placement *placement);
