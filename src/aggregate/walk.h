#pragma once
// Brownian approach: a particle or cluster walks from far away until it touches.
#include "aggregate/trial.h"

/// The placement by the search's approach: a walk, or the best trial of the first axis of which
/// some ray does not miss.
///
/// @return CLAST_E_MEMORY
clast_status clx_walk_or_search(clx_search *search, int32_t tries, clx_placement *placement);
