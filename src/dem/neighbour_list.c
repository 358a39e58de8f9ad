// Neighbour lists, brought up to date item by item.
//
// Each item has a margin, half its skin. While two items stay within their margins of the anchors
// where their neighbours were last searched, no pair that is not listed can touch. When some item
// has used up its margin, all that have used half of it search again, and only they: a falling
// grain costs its own search, the bed below none. Then old and new pairs are merged in order, which
// costs a pass over memory.
#include "dem/dem.h"

#include "base/alloc.h"
#include "base/lines.h"
#include "convex/facet.h"
#include "dem/container.h"
#include "dem/pair_force.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

void clx_neighbour_list_free(clx_neighbour_list *list)
{
    CLX_FREE(list->pair, list->other, list->history, list->other_history, list->warm_start,
             list->free_slot, list->begin, list->anchor, list->limit, list->is_stale,
             list->triangle);
    clx_dem_grid_free(&list->grid);
    CLX_FREE(list->found, list->sorted, list->found_begin);
    *list = (clx_neighbour_list){0};
}

clast_status clx_neighbour_list_reserve(clx_neighbour_list *list, int64_t n_item)
{
    CLAST_ASSERT(n_item >= 0);
    clast_status status = CLAST_OK;
    if (n_item <= list->item_capacity) {
        return CLAST_OK;
    }
    const int64_t capacity = n_item + n_item / 2 + 16;
    CLX_TRY(clx_realloc(&list->begin, capacity + 1, sizeof *list->begin));
    CLX_TRY(clx_realloc(&list->anchor, capacity, sizeof *list->anchor));
    CLX_TRY(clx_realloc(&list->limit, capacity, sizeof *list->limit));
    CLX_TRY(clx_realloc(&list->is_stale, capacity, sizeof *list->is_stale));
    CLX_TRY(clx_realloc(&list->found_begin, capacity + 1, sizeof *list->found_begin));
    list->item_capacity = capacity;
done:
    return status;
}

/// Steps of free flight that a fast grain's margin covers beyond its share of the radius.
static const double LOOK_AHEAD = 50.0;

static void set_anchor(clast_dem *dem, int32_t i)
{
    CLAST_ASSERT(v3_is_finite(clx_item_position(dem, i)) && clx_item_radius(dem, i) >= 0.0);
    clx_anchor *at = &dem->list.anchor[i];
    const int32_t g = clx_item_grain(dem, i);
    const double radius = clx_item_radius(dem, i);
    const double flight = LOOK_AHEAD * dem->config.time_step * v3_norm(dem->grain[g].velocity);
    v3_copy(at->position, clx_item_position(dem, i));
    memcpy(at->orientation, dem->motion[g].orientation, sizeof at->orientation);
    at->margin = fmax(dem->config.skin * radius + fmin(flight, radius), clx_item_neck(dem, i));
    for (int c = 0; c < 2; ++c) { // most pairs only touch in one image, none with its own
        if (dem->period[c] > 0.0) {
            const double most = (1.0 + dem->config.skin) * radius;
            const double limit = (4.0 * most <= dem->period[c] ? 0.25 : 0.5) * dem->period[c];
            at->margin = fmin(at->margin, limit - radius);
        }
    }
    for (int c = 0; c < 3 && dem->cell != NULL; ++c) {
        at->margin = fmin(at->margin, 0.25 * dem->cell->side[c] - radius);
    }
    dem->list.limit[i] = dem->travel[g] + CLX_SURE * at->margin;
}

void clx_neighbour_list_mark(clast_dem *dem)
{
    clx_neighbour_list *l = &dem->list;
    clx_walls *walls = &dem->walls;
    const double margin = clx_walls_margin(dem);
    const bool have_moved =
        walls->path - walls->searched > fmin(walls->margin, margin) || margin > walls->margin;
    if (have_moved) { // all search them anew
        walls->margin = margin;
        walls->searched = walls->path;
    }
    for (int32_t i = 0; i < dem->n_item; ++i) {
        if (clx_are_ghosts(dem, i, i)) {
            continue; // its rank marks it
        }
        const bool is_within = i < l->n_known && dem->cell == NULL && !have_moved &&
                               clx_item_moved(dem, i) <= 0.5 * l->anchor[i].margin;
        l->is_stale[i] = is_within ? 0 : 1;
        if (l->is_stale[i] != 0) {
            set_anchor(dem, i);
        }
    }
    l->n_known = dem->n_item;
    if (dem->cell != NULL) { // whose images move: all search anew
        dem->cell->path = 0.0;
    }
}

static clast_status add_found(clx_neighbour_list *l, clx_found found)
{
    CLAST_ASSERT(found.a >= 0 && (found.b < 0 || found.b > found.a));
    clast_status status = CLAST_OK;
    CLX_TRY(clx_grow(&l->found, &l->found_capacity, l->n_found + 1, sizeof *l->found));
    l->found[l->n_found++] = found;
done:
    return status;
}

static clast_status find_walls(clast_dem *dem, int32_t i)
{
    clast_status status = CLAST_OK;
    const clx_anchor *at = &dem->list.anchor[i];
    if (clx_are_ghosts(dem, i, i)) {
        return CLAST_OK;
    }
    for (int32_t w = dem->n_wall - 1; w >= 0; --w) {
        double normal[3];
        const double d = clx_wall_distance(&dem->wall[w], at->position, normal);
        const bool is_open = dem->walls.n > 0 && dem->walls.body[w].is_open;
        if (!is_open && d < clx_item_radius(dem, i) + at->margin + dem->walls.margin) {
            CLX_TRY(add_found(&dem->list, (clx_found){.a = i, .b = -1 - w}));
        }
    }
    if (dem->container != NULL) {
        CLX_TRY(clx_container_find(dem, i));
    }
done:
    return status;
}

/// Item k in the image at r from item i, `n` periods from where it is.
static clast_status add_image(clast_dem *dem, int32_t i, int32_t k, const double r[3],
                              const double n[2])
{
    clx_neighbour_list *l = &dem->list;
    const double cutoff = clx_item_radius(dem, i) + clx_item_radius(dem, k) + l->anchor[i].margin +
                          l->anchor[k].margin;
    if (v3_norm2(r) >= cutoff * cutoff) {
        return CLAST_OK;
    }
    const double sign = i < k ? 1.0 : -1.0;
    clx_found found = {.a = i < k ? i : k, .b = i < k ? k : i};
    for (int c = 0; c < 2; ++c) {
        found.period[c] = (int16_t)(uint16_t)(int64_t)(sign * n[c]);
    }
    return add_found(l, found);
}

/// One candidate of a stale item's query: in its nearest image, and in others that are near.
static clast_status consider(clast_dem *dem, int32_t i, int32_t k)
{
    CLAST_ASSERT(i >= 0 && i < dem->n_item && k >= 0 && k < dem->n_item);
    clast_status status = CLAST_OK;
    const clx_neighbour_list *l = &dem->list;
    const clx_anchor *a = &l->anchor[i];
    const clx_anchor *b = &l->anchor[k];
    if (k == i || (l->is_stale[k] != 0 && k < i) || clx_are_ghosts(dem, i, k) ||
        (dem->item != NULL && dem->item[i].grain == dem->item[k].grain)) {
        return CLAST_OK;
    }
    const double cutoff = clx_item_radius(dem, i) + clx_item_radius(dem, k) + a->margin + b->margin;
    double r[3];
    double n[2] = {0.0, 0.0};
    int beyond[2] = {0, 0};
    v3_sub(r, b->position, a->position);
    for (int c = 0; c < 2; ++c) {
        if (dem->period[c] > 0.0) {
            n[c] = floor(0.5 - r[c] / dem->period[c]);
            r[c] += n[c] * dem->period[c];
            beyond[c] = 2.0 * cutoff > dem->period[c] ? 1 : 0;
        }
    }
    if (dem->cell != NULL) {
        clx_cell_offset(dem->cell, r);
    }
    for (int x = -beyond[0]; x <= beyond[0]; ++x) {
        for (int y = -beyond[1]; y <= beyond[1]; ++y) {
            const double image[3] = {r[0] + x * dem->period[0], r[1] + y * dem->period[1], r[2]};
            CLX_TRY(add_image(dem, i, k, image, (const double[2]){n[0] + x, n[1] + y}));
        }
    }
done:
    return status;
}

/// All entries of the cell that the walk is in.
static clast_status find_in_cell(clast_dem *dem, int32_t i, const clx_dem_grid_walk *walk)
{
    clast_status status = CLAST_OK;
    const clx_dem_grid *grid = &dem->list.grid;
    for (int32_t k = walk->begin; k < walk->end; ++k) {
        const int32_t other = walk->item[k];
        if (clx_dem_grid_is_here(grid, walk, other)) {
            CLX_TRY(consider(dem, i, other));
        }
    }
done:
    return status;
}

static clast_status find_items(clast_dem *dem, int32_t i)
{
    CLAST_ASSERT(dem->list.is_stale[i] != 0);
    clast_status status = CLAST_OK;
    const clx_neighbour_list *l = &dem->list;
    clx_dem_grid_walk walk;
    const double cutoff = clx_item_radius(dem, i) + l->anchor[i].margin;
    for (int32_t level = 0; level < l->grid.n_level; ++level) {
        bool is_in = clx_dem_grid_begin(&l->grid, level, l->anchor[i].position, cutoff, &walk);
        for (; is_in; is_in = clx_dem_grid_next(&l->grid, &walk)) {
            CLX_TRY(find_in_cell(dem, i, &walk));
        }
    }
done:
    return status;
}

static clast_status find(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    dem->list.n_found = 0;
    CLX_TRY(clx_dem_grid_build(dem, &dem->list.grid));
    for (int32_t i = 0; i < dem->n_item; ++i) {
        if (dem->list.is_stale[i] != 0) {
            CLX_TRY(find_walls(dem, i));
            CLX_TRY(find_items(dem, i));
        }
    }
done:
    return status;
}

static int compare(int32_t b, const int16_t period[2], const clx_found *f)
{
    return clx_pair_order(b, period, f->b, f->period);
}

/// Found pairs by a, then b and image: counting sort and short insertions.
static clast_status sort_found(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    clx_neighbour_list *l = &dem->list;
    CLX_TRY(clx_grow(&l->sorted, &l->sorted_capacity, l->n_found, sizeof *l->sorted));
    int64_t *begin = l->found_begin;
    memset(begin, 0, ((size_t)dem->n_item + 1) * sizeof *begin);
    for (int64_t k = 0; k < l->n_found; ++k) {
        ++begin[l->found[k].a + 1];
    }
    for (int32_t i = 0; i < dem->n_item; ++i) {
        begin[i + 1] += begin[i];
    }
    for (int64_t k = 0; k < l->n_found; ++k) {
        l->sorted[begin[l->found[k].a]++] = l->found[k];
    }
    for (int32_t i = dem->n_item; i > 0; --i) {
        begin[i] = begin[i - 1];
    }
    begin[0] = 0;
    for (int32_t i = 0; i < dem->n_item; ++i) {
        for (int64_t k = begin[i] + 1; k < begin[i + 1]; ++k) {
            const clx_found f = l->sorted[k];
            int64_t at = k;
            for (; at > begin[i] && compare(l->sorted[at - 1].b, l->sorted[at - 1].period, &f) > 0;
                 --at) {
                l->sorted[at] = l->sorted[at - 1];
            }
            l->sorted[at] = f;
        }
    }
done:
    return status;
}

/// Whether an old pair stays without being found again: neither of its items has searched.
static bool stays(const clx_neighbour_list *l, const clx_dem_pair *old)
{
    return l->is_stale[old->a] == 0 && (old->b < 0 || l->is_stale[old->b] == 0);
}

static clx_dem_pair new_pair(const clx_found *f)
{
    return (clx_dem_pair){
        .a = f->a, .b = f->b, .period = {f->period[0], f->period[1]}, .active_from = -INFINITY};
}

clast_status clx_neighbour_list_assign_slot(clx_neighbour_list *l, clx_dem_pair *pair)
{
    CLAST_ASSERT(pair->slot == 0);
    clast_status status = CLAST_OK;
    if (l->n_free > 0) {
        pair->slot = (uint32_t)l->free_slot[--l->n_free] & CLX_MOST_SLOTS;
    } else {
        const int64_t n = l->n_slot > 0 ? l->n_slot : 1;
        CLX_CHECK(n < CLX_MOST_SLOTS, CLAST_E_LIMIT, "%lld warm starts", (long long)n);
        CLX_TRY(clx_grow_lines(&l->warm_start, &l->slot_capacity, n + 1, sizeof *l->warm_start));
        CLX_TRY(clx_grow(&l->free_slot, &l->free_capacity, n + 1, sizeof *l->free_slot));
        l->n_slot = n + 1;
        pair->slot = (uint32_t)n & CLX_MOST_SLOTS;
    }
    pair->kind = CLX_FACET_NONE;
    l->warm_start[pair->slot] = (clx_warm_start_slot){0};
done:
    return status;
}

/// Copies an old pair with its contact history to the new list.
static void keep_pair(clx_neighbour_list *l, int64_t old, int64_t n)
{
    CLAST_ASSERT(n < l->other_capacity);
    l->other[n] = l->pair[old];
    if (l->other_history != NULL) {
        l->other_history[n] = l->history[old];
    }
}

static void drop_pair(clx_neighbour_list *l, int64_t old)
{
    CLAST_ASSERT(l->n_free < l->n_slot || l->pair[old].slot == 0);
    if (l->pair[old].slot != 0) { // free_slot has room for all slots
        l->free_slot[l->n_free++] = (int32_t)l->pair[old].slot;
    }
}

static void start_pair(clx_neighbour_list *l, const clx_found *f, int64_t n)
{
    CLAST_ASSERT(n < l->other_capacity);
    l->other[n] = new_pair(f);
    if (l->other_history != NULL) {
        l->other_history[n] = (clx_contact_history){0};
    }
}

/// Old and found pairs of one item, both in order, into the other buffer at n.
static int64_t merge_item(clx_neighbour_list *l, int64_t old, int64_t old_end, int32_t i, int64_t n)
{
    CLAST_ASSERT(old <= old_end && l->found_begin[i] <= l->found_begin[i + 1]);
    int64_t f = l->found_begin[i];
    const int64_t f_end = l->found_begin[i + 1];
    while (old < old_end || f < f_end) {
        const int first = f == f_end ? -1
                          : old == old_end
                              ? 1
                              : compare(l->pair[old].b, l->pair[old].period, &l->sorted[f]);
        if (first > 0) {
            start_pair(l, &l->sorted[f++], n++);
        } else if (first == 0 || stays(l, &l->pair[old])) {
            keep_pair(l, old++, n++);
            f += first == 0;
        } else {
            drop_pair(l, old++);
        }
    }
    return n;
}

static void swap_buffers(clx_neighbour_list *l)
{
    clx_dem_pair *const pair = l->pair;
    const int64_t capacity = l->capacity;
    l->pair = l->other;
    l->capacity = l->other_capacity;
    l->other = pair;
    l->other_capacity = capacity;
    clx_contact_history *const history = l->history;
    const int64_t history_capacity = l->history_capacity;
    l->history = l->other_history;
    l->history_capacity = l->other_history_capacity;
    l->other_history = history;
    l->other_history_capacity = history_capacity;
}

static clast_status merge(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    clx_neighbour_list *l = &dem->list;
    int64_t n = 0;
    CLX_TRY(clx_grow_lines(&l->other, &l->other_capacity, l->n_pair + l->n_found + 1,
                           sizeof *l->other));
    if (dem->law.has_history) {
        CLX_TRY(clx_grow(&l->other_history, &l->other_history_capacity, l->n_pair + l->n_found + 1,
                         sizeof *l->other_history));
    }
    int64_t old = 0;
    for (int32_t i = 0; i < dem->n_item; ++i) {
        int64_t old_end = old;
        while (old_end < l->n_pair && l->pair[old_end].a == i) {
            ++old_end;
        }
        l->begin[i] = n;
        n = merge_item(l, old, old_end, i, n);
        old = old_end;
    }
    l->begin[dem->n_item] = n;
    swap_buffers(l);
    l->n_pair = n;
done:
    return status;
}

clast_status clx_neighbour_list_check_width(const clast_dem *dem)
{
    clast_status status = CLAST_OK;
    const clx_periodic_cell *cell = dem->cell;
    double most = 0.0;
    if (cell == NULL) {
        return CLAST_OK;
    }
    const double narrow = fmin(cell->side[0], fmin(cell->side[1], cell->side[2]));
    for (int32_t i = 0; i < dem->n_item; ++i) {
        most = fmax(most, clx_item_radius(dem, i));
    }
    CLX_CHECK(4.0 * most * (1.0 + dem->config.skin) <= narrow, CLAST_E_GEOMETRY,
              "the cell's narrowest side has come down to %s, less than two of its largest grain "
              "(%s across, %s with its skin): take more grains in a larger cell",
              clx_unit_text(narrow, "m"), clx_unit_text(2.0 * most, "m"),
              clx_unit_text(2.0 * most * (1.0 + dem->config.skin), "m"));
done:
    return status;
}

clast_status clx_neighbour_list_search(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    if (dem->n_item > 0) { // a rank may have none
        CLX_TRY(find(dem));
        CLX_TRY(sort_found(dem));
        CLX_TRY(merge(dem));
    }
    dem->list.is_due = false;
    dem->inner.is_due = true;
    ++dem->list.n_refresh;
done:
    return status;
}

clast_status clx_neighbour_list_refresh(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_neighbour_list_reserve(&dem->list, dem->n_item));
    CLX_TRY(clx_neighbour_list_check_width(dem));
    clx_neighbour_list_mark(dem);
    CLX_TRY(clx_neighbour_list_search(dem));
done:
    return status;
}
