// The inner list: the pairs of the neighbour list that a step reads (a dual pair list).
//
// A pair of the neighbour list is skipped until the paths of its grains add up to `active_from`:
// before that it cannot touch. Each grain gets some path in advance (`until`); pairs whose
// `active_from` lies beyond the advances of both are left out until a grain has used up its own. A
// skipped pair of the inner list costs a comparison, one that is left out costs nothing; which of
// the two it is changes no result.
//
// A sweep works on copies in one array, pairs with their warm starts: reading in order is several
// times faster than reading cache lines here and there. A new inner list is packed from the old
// array where it can be; the neighbour list gets all copies back before it is refreshed, and
// whenever clast_dem_step returns.
#include "dem/dem.h"

#include "base/alloc.h"
#include "base/lines.h"
#include <string.h>

/// Steps at the present speed that the advance lasts, and its least share of the grain's radius.
static const double LOOK_AHEAD = 32.0;
static const double LEAST = 0.002;

void clx_inner_free(clx_inner_list *inner)
{
    CLX_FREE(inner->index, inner->force, inner->begin, inner->in_begin, inner->in, inner->until,
             inner->total, inner->block, inner->packed, inner->old.index, inner->old.begin,
             inner->old.packed);
    *inner = (clx_inner_list){0};
}

/// Items of a block, so few that most blocks have no pair without a warm start; pairs of a block
/// of copies.
enum { BLOCK = 64, PACK = 1024 };

static void set_until(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_dem *dem = context;
    const double dt = dem->config.time_step;
    (void)worker;
    for (int64_t g = begin; g < end; ++g) {
        const clx_grain *grain = &dem->grain[g];
        const double speed =
            v3_norm(grain->velocity) +
            (grain->kind == CLAST_SHAPE_SPHERE ? 0.0 : v3_norm(grain->omega) * grain->radius);
        const double ahead = LOOK_AHEAD * dt * speed;
        const double least = LEAST * grain->radius;
        dem->inner.until[g] = dem->travel[g] + (ahead > least ? ahead : least);
    }
}

/// The range of an item's pairs in the old array.
typedef struct {
    int32_t at, end;
} old_range;

static old_range old_of(const clx_inner_list *inner, int64_t i)
{
    return inner->is_packed ? (old_range){inner->old.begin[i], inner->old.begin[i + 1]}
                            : (old_range){0};
}

/// Pair k of the list: its copy where the old range begins with it.
static inline const clx_dem_pair *pair_now(const clast_dem *dem, int64_t k, old_range *old)
{
    CLAST_ASSERT(k >= 0 && k < dem->list.n_pair);
    const clx_packed_row *row = &dem->inner.old;
    if (old->at < old->end && row->index[old->at] == k) {
        return &row->packed[old->at++].pair;
    }
    return &dem->list.pair[k];
}

/// Writes the numbers of a block's pairs that may become active to where its pairs begin in the
/// neighbour list; how many come before each item's, and whether one still needs a warm start.
static void pick_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_dem *dem = context;
    clx_inner_list *inner = &dem->inner;
    const clx_neighbour_list *l = &dem->list;
    int32_t *to = inner->index + l->begin[begin];
    clx_inner_block *block = &inner->block[begin / BLOCK];
    int32_t n = 0;
    bool wants = false;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        const double own = inner->until[clx_item_grain(dem, (int32_t)i)];
        old_range old = old_of(inner, i);
        inner->begin[i] = n;
        for (int64_t k = l->begin[i]; k < l->begin[i + 1]; ++k) {
            const clx_dem_pair *pair = pair_now(dem, k, &old);
            const double other =
                pair->b >= 0 ? inner->until[clx_item_grain(dem, pair->b)] : dem->walls.until;
            const bool may_be_active = pair->active_from <= own + other;
            to[n] = (int32_t)k;
            n += may_be_active ? 1 : 0;
            wants = wants || (may_be_active && pair->slot == 0 && !clx_pair_is_round(dem, pair));
        }
    }
    *block = (clx_inner_block){.n = n, .needs_warm_start = wants};
}

/// Numbers of the pairs that may become active: those of all blocks, in order.
static clast_status pick(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    clx_inner_list *inner = &dem->inner;
    const clx_neighbour_list *l = &dem->list;
    CLX_CHECK(l->n_pair <= INT32_MAX, CLAST_E_LIMIT, "%lld pairs of grains", (long long)l->n_pair);
    CLX_TRY(clx_grow_lines(&inner->index, &inner->capacity, l->n_pair + 1, sizeof *inner->index));
    CLX_TRY(clx_grow(&inner->block, &inner->block_capacity, dem->n_item / BLOCK + 1,
                     sizeof *inner->block));
    clx_dem_for(dem, dem->n_item, BLOCK, pick_block, dem);
    inner->n = 0;
    for (int32_t i = 0; i < dem->n_item; i += BLOCK) {
        const int32_t end = i + BLOCK < dem->n_item ? i + BLOCK : dem->n_item;
        const int32_t n = inner->block[i / BLOCK].n;
        memmove(inner->index + inner->n, inner->index + l->begin[i],
                (size_t)n * sizeof *inner->index);
        for (int32_t k = i; k < end; ++k) {
            inner->begin[k] += inner->n;
        }
        inner->n += n;
    }
    inner->begin[dem->n_item] = inner->n;
done:
    return status;
}

/// Which of them have each grain as b.
static void gather(clast_dem *dem)
{
    clx_inner_list *inner = &dem->inner;
    int32_t *begin = inner->in_begin;
    memset(begin, 0, ((size_t)dem->n_grain + 2) * sizeof *begin);
    for (int32_t k = 0; k < inner->n; ++k) {
        const int32_t b = clx_inner_pair(dem, k)->b;
        if (b >= 0) {
            ++begin[clx_item_grain(dem, b) + 2];
        }
    }
    for (int32_t g = 1; g <= dem->n_grain; ++g) {
        begin[g + 1] += begin[g];
    }
    for (int32_t k = 0; k < inner->n; ++k) {
        const int32_t b = clx_inner_pair(dem, k)->b;
        if (b >= 0) {
            inner->in[begin[clx_item_grain(dem, b) + 1]++] = k;
        }
    }
}

clast_status clx_inner_gather(clast_dem *dem)
{
    CLAST_ASSERT(!dem->inner.is_packed);
    clast_status status = CLAST_OK;
    clx_inner_list *inner = &dem->inner;
    CLX_TRY(clx_grow(&inner->in_begin, &inner->grain_capacity, (int64_t)dem->n_grain + 2,
                     sizeof *inner->in_begin));
    CLX_TRY(clx_grow(&inner->in, &inner->in_capacity, (int64_t)inner->n + 1, sizeof *inner->in));
    CLX_TRY(clx_grow_lines(&inner->force, &inner->force_capacity, (int64_t)inner->n + 1,
                           sizeof *inner->force));
    gather(dem);
    inner->is_gathered = true;
done:
    return status;
}

/// A slot for the warm start of every pair of the inner list that needs one.
static clast_status assign_slots(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    clx_neighbour_list *l = &dem->list;
    const clx_inner_list *inner = &dem->inner;
    for (int32_t i = 0; i < dem->n_item && !dem->all_round; i += BLOCK) {
        const int32_t end = inner->begin[i + BLOCK < dem->n_item ? i + BLOCK : dem->n_item];
        for (int32_t k = inner->begin[i]; k < end && inner->block[i / BLOCK].needs_warm_start;
             ++k) {
            clx_dem_pair *pair = &l->pair[inner->index[k]];
            if (pair->slot == 0 && !clx_pair_is_round(dem, pair)) {
                CLX_TRY(clx_neighbour_list_assign_slot(l, pair));
            }
        }
    }
done:
    return status;
}

/// Copies a pair and its warm start from the neighbour list.
static inline void copy_from_list(const clx_neighbour_list *l, int32_t k, clx_packed_pair *packed)
{
    CLAST_ASSERT(k >= 0 && k < l->n_pair && (int64_t)l->pair[k].slot < l->n_slot + 1);
    packed->pair = l->pair[k];
    if (packed->pair.slot != 0) {
        packed->warm_start = l->warm_start[packed->pair.slot].record;
    }
}

/// Copies them back.
static inline void copy_to_list(clx_neighbour_list *l, int32_t k, const clx_packed_pair *packed)
{
    CLAST_ASSERT(k >= 0 && k < l->n_pair);
    l->pair[k] = packed->pair;
    if (packed->pair.slot != 0) {
        l->warm_start[packed->pair.slot].record = packed->warm_start;
    }
}

static void pack_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_dem *dem = context;
    (void)worker;
    for (int64_t k = begin; k < end; ++k) {
        copy_from_list(&dem->list, dem->inner.index[k], &dem->inner.packed[k]);
    }
}

/// Copies of a block of items, merged from the old ones in order: pairs that have left go back to
/// the neighbour list, new ones come from there.
static void repack_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_dem *dem = context;
    const clx_inner_list *inner = &dem->inner;
    const clx_packed_row *row = &inner->old;
    int32_t at = row->begin[begin];
    (void)worker;
    for (int32_t k = inner->begin[begin]; k < inner->begin[end]; ++k) {
        for (; at < row->begin[end] && row->index[at] < inner->index[k]; ++at) {
            copy_to_list(&dem->list, row->index[at], &row->packed[at]);
        }
        if (at < row->begin[end] && row->index[at] == inner->index[k]) {
            inner->packed[k] = row->packed[at++];
        } else {
            copy_from_list(&dem->list, inner->index[k], &inner->packed[k]);
        }
    }
    for (; at < row->begin[end]; ++at) {
        copy_to_list(&dem->list, row->index[at], &row->packed[at]);
    }
}

static void unpack_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_dem *dem = context;
    (void)worker;
    for (int64_t k = begin; k < end; ++k) {
        copy_to_list(&dem->list, dem->inner.index[k], &dem->inner.packed[k]);
    }
}

static clast_status grow_row(clx_inner_list *inner)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_grow_lines(&inner->packed, &inner->packed_capacity,
                           (int64_t)inner->n + CLX_PREFETCH_PAIRS, sizeof *inner->packed));
    memset(inner->packed + inner->n, 0, CLX_PREFETCH_PAIRS * sizeof *inner->packed);
done:
    return status;
}

clast_status clx_inner_pack(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    clx_inner_list *inner = &dem->inner;
    CLX_TRY(grow_row(inner));
    clx_dem_for(dem, inner->n, PACK, pack_block, dem);
    inner->is_packed = true;
done:
    return status;
}

void clx_inner_unpack(clast_dem *dem)
{
    if (dem->inner.is_packed) {
        clx_dem_for(dem, dem->inner.n, PACK, unpack_block, dem);
        dem->inner.is_packed = false;
    }
}

/// Swaps the array of copies with the old one, whose capacity the next one uses.
static void swap_rows(clx_inner_list *inner)
{
    const clx_packed_row row = {.n = inner->n,
                                .index = inner->index,
                                .begin = inner->begin,
                                .packed = inner->packed,
                                .capacity = inner->capacity,
                                .item_capacity = inner->item_capacity,
                                .packed_capacity = inner->packed_capacity};
    inner->n = inner->old.n;
    inner->index = inner->old.index;
    inner->begin = inner->old.begin;
    inner->packed = inner->old.packed;
    inner->capacity = inner->old.capacity;
    inner->item_capacity = inner->old.item_capacity;
    inner->packed_capacity = inner->old.packed_capacity;
    inner->old = row;
}

clast_status clx_inner_find(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    clx_inner_list *inner = &dem->inner;
    const int64_t n_grain = dem->n_grain;
    if (inner->is_packed) {
        swap_rows(inner);
    }
    CLX_TRY(clx_grow(&inner->begin, &inner->item_capacity, (int64_t)dem->n_item + 1,
                     sizeof *inner->begin));
    CLX_TRY(clx_grow(&inner->until, &inner->until_capacity, n_grain + 1, sizeof *inner->until));
    CLX_TRY(
        clx_grow_lines(&inner->total, &inner->total_capacity, n_grain + 1, sizeof *inner->total));
    memset(inner->total, 0, (size_t)n_grain * sizeof *inner->total);
    clx_dem_for(dem, n_grain, BLOCK, set_until, dem);
    clx_walls_look_ahead(dem);
    CLX_TRY(pick(dem));
    CLX_TRY(assign_slots(dem));
    if (inner->is_packed) {
        CLX_TRY(grow_row(inner));
        clx_dem_for(dem, dem->n_item, BLOCK, repack_block, dem);
    }
    inner->is_due = false;
    inner->is_gathered = false;
    dem->sweeping.n_worker = 0;
done:
    if (status != CLAST_OK && inner->is_packed) {
        swap_rows(inner); // what is packed is still whole
    }
    return status;
}
