// Grains that leave: their records, contacts and lists go, the others move up in order.
#include "base/alloc.h"
#include "dem/dem.h"
#include "dem/energy.h"
#include "dem/ranks.h"
#include <string.h>

/// Which grains and items go, and the new number of each of the others.
typedef struct {
    const uint8_t *goes; ///< [n_grain]
    int32_t *item;       ///< [n_item] new number, -1: goes
} removal;

static void number_items(const clast_dem *dem, const removal *r)
{
    int32_t n = 0;
    for (int32_t i = 0; i < dem->n_item; ++i) {
        r->item[i] = r->goes[clx_item_grain(dem, i)] != 0 ? -1 : n++;
    }
}

/// Pairs of the others, in their order: the list stays sorted.
static void remove_pairs(clast_dem *dem, const removal *r)
{
    clx_neighbour_list *l = &dem->list;
    int64_t n = 0;
    int64_t k = 0;
    int32_t n_item = 0;
    for (int32_t i = 0; i < l->n_known; ++i) { // those added since have no pairs
        if (r->item[i] >= 0) {
            l->begin[n_item++] = n;
        }
        for (; k < l->n_pair && l->pair[k].a == i; ++k) {
            clx_dem_pair pair = l->pair[k];
            const bool goes = r->item[i] < 0 || (pair.b >= 0 && r->item[pair.b] < 0);
            if (goes && pair.slot != 0) {
                l->free_slot[l->n_free++] = (int32_t)pair.slot;
            }
            if (goes) {
                continue;
            }
            pair.a = r->item[i];
            pair.b = pair.b >= 0 ? r->item[pair.b] : pair.b;
            l->pair[n] = pair;
            if (l->history != NULL) {
                l->history[n] = l->history[k];
            }
            ++n;
        }
    }
    if (l->n_known > 0) {
        l->begin[n_item] = n;
    }
    l->n_pair = n;
}

static void remove_items(clast_dem *dem, const removal *r)
{
    clx_neighbour_list *l = &dem->list;
    int32_t n_known = 0;
    int32_t n = 0;
    for (int32_t i = 0; i < dem->n_item; ++i) {
        const int32_t to = r->item[i];
        if (to < 0) {
            continue;
        }
        if (i < l->n_known) {
            l->anchor[to] = l->anchor[i];
            l->limit[to] = l->limit[i];
            n_known = to + 1;
        }
        if (dem->item != NULL) {
            dem->item[to] = dem->item[i];
        }
        if (dem->convex != NULL) {
            dem->convex[to] = dem->convex[i];
        }
        if (dem->item_rotation != NULL) {
            memcpy(dem->item_rotation[to], dem->item_rotation[i], sizeof dem->item_rotation[to]);
        }
        n = to + 1;
    }
    l->n_known = n_known;
    dem->n_item = n;
}

static void remove_grains(clast_dem *dem, const removal *r)
{
    int32_t n = 0;
    int32_t n_started = 0;
    int32_t first = 0;
    for (int32_t i = 0; i < dem->n_grain; ++i) {
        const int32_t n_own =
            dem->item_begin != NULL ? dem->item_begin[i + 1] - dem->item_begin[i] : 1;
        if (r->goes[i] != 0) {
            continue;
        }
        dem->grain[n] = dem->grain[i];
        dem->motion[n] = dem->motion[i];
        dem->travel[n] = dem->travel[i];
        for (int32_t k = 0; k < n_own && dem->item != NULL; ++k) {
            dem->item[first + k].grain = n;
        }
        if (dem->item_begin != NULL) {
            dem->item_begin[n] = first; // n <= i: read before
        }
        first += n_own;
        ++n;
        n_started += i < dem->n_started ? 1 : 0;
    }
    if (dem->item_begin != NULL) {
        dem->item_begin[n] = first;
    }
    dem->n_grain = n;
    dem->n_started = n_started;
}

clast_status clast_dem_remove_grains(clast_dem *dem, const uint8_t *goes)
{
    CLX_ARGUMENTS(dem);
    CLX_ARRAY(goes, dem->n_grain);
    clast_status status = CLAST_OK;
    removal r = {.goes = goes};
    clx_energy_held before = {0};
    CLX_TRY(clx_dem_gather_all(dem)); // rank 0 has all pairs then
    CLX_TRY(clx_dem_agree(dem, clx_alloc(&r.item, dem->n_item, sizeof *r.item)));
    if (dem->energy != NULL) {
        before = clx_energy_held_now(dem);
    }
    clx_inner_unpack(dem);
    number_items(dem, &r);
    remove_pairs(dem, &r);
    remove_items(dem, &r);
    remove_grains(dem, &r);
    dem->inner.is_due = true;
    if (dem->ranks != NULL) {
        clx_ranks_restart(dem->ranks);
    }
    if (dem->energy != NULL) { // springs that held something go with their grains
        const clx_energy_held now = clx_energy_held_now(dem);
        const double gone[CLX_N_WORK] = {
            [CLX_LEFT] = (before.translation - now.translation) + (before.rotation - now.rotation) +
                         (before.normal - now.normal) + (before.tangential - now.tangential) +
                         (before.attraction - now.attraction),
            [CLX_WORK_NORMAL] = before.normal - now.normal,
            [CLX_WORK_TANGENTIAL] = before.tangential - now.tangential,
            [CLX_WORK_PULL] = before.attraction - now.attraction};
        clx_energy_add(dem->energy, 0, gone);
    }
done:
    clx_free(r.item);
    return status;
}
