#pragma once
// The neighbour list: pairs within a skin, and what its upkeep needs.
#include "dem/grid.h"
#include "dem/pair.h"

/// Where an item was when its neighbours were last searched.
typedef struct clx_anchor {
    double position[3];
    double orientation[4];
    double margin; ///< half its skin: how far it may move before its neighbours are searched again
} clx_anchor;

/// Share of what is left of a margin that an item's path may use before its margin is checked
/// again. What it has moved grows by at most 1.05 times its path (2.1 |dq| for the angle), so that
/// the step in which a margin is used up is found whenever it was checked before: a resumed run
/// refreshes in the same steps.
#define CLX_SURE 0.94

/// A pair that a refresh found.
typedef struct clx_found {
    int32_t a, b;
    int16_t period[2]; ///< low bits
} clx_found;

/// Neighbour lists and what their upkeep needs.
typedef struct clx_neighbour_list {
    clx_dem_pair *pair;  ///< [n_pair] sorted by a, b
    clx_dem_pair *other; ///< the buffer that the next refresh fills
    int64_t n_pair, capacity, other_capacity;
    clx_contact_history *history;       ///< [n_pair] where the law has them (has_history)
    clx_contact_history *other_history; ///< of the buffer
    int64_t history_capacity, other_history_capacity;
    clx_warm_start_slot *warm_start; ///< [n_slot] the first is not in use
    int64_t n_slot, slot_capacity;
    int32_t *free_slot; ///< [n_free]
    int64_t n_free, free_capacity;
    int64_t *begin;     ///< [n_item + 1] first pair of each item
    clx_anchor *anchor; ///< [n_item]
    double *limit;      ///< [n_item] below this travel an item is surely within its margin
    uint8_t *is_stale;  ///< [n_item] its neighbours are searched in this refresh
    int64_t item_capacity;
    int32_t *triangle; ///< triangles of the container about one item
    int64_t triangle_capacity;
    clx_dem_grid grid;
    clx_found *found, *sorted; ///< [n_found] as found; by a and b
    int64_t n_found, found_capacity, sorted_capacity;
    int64_t *found_begin; ///< [n_item + 1]
    int32_t n_known;      ///< items that have anchors
    int64_t n_refresh;
    bool is_due; ///< some item has used up its margin
} clx_neighbour_list;

/// Brings the lists up to date for the items that have used half of their margin.
clast_status clx_neighbour_list_refresh(clast_dem *dem);

/// Refuses a cell that has become too narrow for its grains; other domains have room.
clast_status clx_neighbour_list_check_width(const clast_dem *dem);

/// The refresh in two steps: marks these items and sets their anchors, but of ghosts; then
/// searches.
void clx_neighbour_list_mark(clast_dem *dem);
clast_status clx_neighbour_list_search(clast_dem *dem);

void clx_neighbour_list_free(clx_neighbour_list *list);

/// A slot for a pair's warm start, which begins empty.
clast_status clx_neighbour_list_assign_slot(clx_neighbour_list *list, clx_dem_pair *pair);

/// Capacity for n items; new ones are stale.
clast_status clx_neighbour_list_reserve(clx_neighbour_list *list, int64_t n_item);
