// The pairs that a step looks at.
//
// Most listed pairs sleep: they cannot touch before the paths of both grains have grown to `wake`.
// Each grain gets some path in advance (`until`); pairs whose wake lies beyond what both may go are
// left out until a grain has used up its advance. A pair that is here and still sleeps costs a
// comparison, one that is not costs nothing, and whether it is here changes no result.
//
// A sweep works on copies that stand in a row, pairs with their memories: memory hands out what it
// is asked for in order several times faster than lines here and there. A new near list is packed
// out of the old one where it can; the list has all back before it is brought up to date, and
// whenever somebody outside may look.
#include "dem/dem.h"

#include "base/lines.h"
#include <string.h>

/// Steps at the present speed that the advance lasts, and its least share of the grain's radius.
static const double LOOK_AHEAD = 32.0;
static const double LEAST = 0.002;

void clx_near_free(clx_near *near)
{
    clx_free(near->index);
    clx_free(near->push);
    clx_free(near->begin);
    clx_free(near->in_begin);
    clx_free(near->in);
    clx_free(near->until);
    clx_free(near->load);
    clx_free(near->block);
    clx_free(near->packed);
    clx_free(near->old.index);
    clx_free(near->old.begin);
    clx_free(near->old.packed);
    *near = (clx_near){0};
}

/// Items that are gone through at once, 64, so that few blocks have a pair that wants a memory;
/// pairs that are copied at once.
enum { BLOCK = 64, PACK = 1024 };

static void advance(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_dem *dem = context;
    const double dt = dem->config.time_step;
    (void)worker;
    for (int64_t g = begin; g < end; ++g) {
        const clx_grain *grain = &dem->grain[g];
        const double speed =
            v3_norm(grain->velocity) +
            (grain->kind == CLAST_SHAPE_SPHERE ? 0.0 : v3_norm(grain->spin) * grain->radius);
        const double ahead = LOOK_AHEAD * dt * speed;
        const double least = LEAST * grain->radius;
        dem->near.until[g] = dem->travel[g] + (ahead > least ? ahead : least);
    }
}

/// Where an item's pairs stood in what was packed before.
typedef struct {
    int32_t at, end;
} old_range;

static old_range old_of(const clx_near *near, int64_t i)
{
    return near->is_packed ? (old_range){near->old.begin[i], near->old.begin[i + 1]}
                           : (old_range){0};
}

/// Pair k of the list, out of the old row where it stands at the range's begin.
static inline const clx_dem_pair *pair_now(const clast_dem *dem, int64_t k, old_range *old)
{
    const clx_packed_row *row = &dem->near.old;
    if (old->at < old->end && row->index[old->at] == k) {
        return &row->packed[old->at++].pair;
    }
    return &dem->list.pair[k];
}

/// Pairs of a block of items that may wake, to where the block's listed pairs begin; how many come
/// before each item's, and whether one of them has no memory yet and needs it.
static void pick_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_dem *dem = context;
    clx_near *near = &dem->near;
    const clx_list *l = &dem->list;
    int32_t *to = near->index + l->begin[begin];
    clx_near_block *block = &near->block[begin / BLOCK];
    int32_t n = 0;
    bool wants = false;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        const double own = near->until[clx_item_grain(dem, (int32_t)i)];
        old_range old = old_of(near, i);
        near->begin[i] = n;
        for (int64_t k = l->begin[i]; k < l->begin[i + 1]; ++k) {
            const clx_dem_pair *pair = pair_now(dem, k, &old);
            const double other = pair->b >= 0 ? near->until[clx_item_grain(dem, pair->b)] : 0.0;
            const bool may_wake = pair->wake <= own + other;
            to[n] = (int32_t)k;
            n += may_wake ? 1 : 0;
            wants = wants || (may_wake && pair->slot == 0 && !clx_pair_is_round(dem, pair));
        }
    }
    *block = (clx_near_block){.n = n, .wants_memory = wants};
}

/// Numbers of the pairs that may wake: what the blocks found, one after the other.
static clast_status pick(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    clx_near *near = &dem->near;
    const clx_list *l = &dem->list;
    CLX_CHECK(l->n_pair <= INT32_MAX, CLAST_E_LIMIT, "%lld pairs of grains", (long long)l->n_pair);
    CLX_TRY(clx_grow_lines(&near->index, &near->capacity, l->n_pair + 1, sizeof *near->index));
    CLX_TRY(clx_grow(&near->block, &near->block_capacity, dem->n_item / BLOCK + 1,
                     sizeof *near->block));
    clx_dem_for(dem, dem->n_item, BLOCK, pick_block, dem);
    near->n = 0;
    for (int32_t i = 0; i < dem->n_item; i += BLOCK) {
        const int32_t end = i + BLOCK < dem->n_item ? i + BLOCK : dem->n_item;
        const int32_t n = near->block[i / BLOCK].n;
        memmove(near->index + near->n, near->index + l->begin[i], (size_t)n * sizeof *near->index);
        for (int32_t k = i; k < end; ++k) {
            near->begin[k] += near->n;
        }
        near->n += n;
    }
    near->begin[dem->n_item] = near->n;
done:
    return status;
}

/// Which of them load each grain as b.
static void gather(clast_dem *dem)
{
    clx_near *near = &dem->near;
    int32_t *begin = near->in_begin;
    memset(begin, 0, ((size_t)dem->n_grain + 2) * sizeof *begin);
    for (int32_t k = 0; k < near->n; ++k) {
        const int32_t b = clx_near_pair(dem, k)->b;
        if (b >= 0) {
            ++begin[clx_item_grain(dem, b) + 2];
        }
    }
    for (int32_t g = 1; g <= dem->n_grain; ++g) {
        begin[g + 1] += begin[g];
    }
    for (int32_t k = 0; k < near->n; ++k) {
        const int32_t b = clx_near_pair(dem, k)->b;
        if (b >= 0) {
            near->in[begin[clx_item_grain(dem, b) + 1]++] = k;
        }
    }
}

clast_status clx_near_gather(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    clx_near *near = &dem->near;
    CLX_TRY(clx_grow(&near->in_begin, &near->grain_capacity, (int64_t)dem->n_grain + 2,
                     sizeof *near->in_begin));
    CLX_TRY(clx_grow(&near->in, &near->in_capacity, (int64_t)near->n + 1, sizeof *near->in));
    CLX_TRY(clx_grow_lines(&near->push, &near->push_capacity, (int64_t)near->n + 1,
                           sizeof *near->push));
    gather(dem);
    near->is_gathered = true;
done:
    return status;
}

/// A place for the memory of every pair that may be asked.
static clast_status give_slots(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    clx_list *l = &dem->list;
    const clx_near *near = &dem->near;
    for (int32_t i = 0; i < dem->n_item && !dem->all_round; i += BLOCK) {
        const int32_t end = near->begin[i + BLOCK < dem->n_item ? i + BLOCK : dem->n_item];
        for (int32_t k = near->begin[i]; k < end && near->block[i / BLOCK].wants_memory; ++k) {
            clx_dem_pair *pair = &l->pair[near->index[k]];
            if (pair->slot == 0 && !clx_pair_is_round(dem, pair)) {
                CLX_TRY(clx_list_give_slot(l, pair));
            }
        }
    }
done:
    return status;
}

/// Out of the list.
static inline void take(const clx_list *l, int32_t k, clx_packed_pair *packed)
{
    packed->pair = l->pair[k];
    if (packed->pair.slot != 0) {
        packed->memory = l->memory[packed->pair.slot].record;
    }
}

/// Back into the list.
static inline void give(clx_list *l, int32_t k, const clx_packed_pair *packed)
{
    l->pair[k] = packed->pair;
    if (packed->pair.slot != 0) {
        l->memory[packed->pair.slot].record = packed->memory;
    }
}

static void pack_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_dem *dem = context;
    (void)worker;
    for (int64_t k = begin; k < end; ++k) {
        take(&dem->list, dem->near.index[k], &dem->near.packed[k]);
    }
}

/// Rows of a block of items out of the old ones, which are in order: what has left goes back to the
/// list, what is new comes from there.
static void pack_again(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_dem *dem = context;
    const clx_near *near = &dem->near;
    const clx_packed_row *row = &near->old;
    int32_t at = row->begin[begin];
    (void)worker;
    for (int32_t k = near->begin[begin]; k < near->begin[end]; ++k) {
        for (; at < row->begin[end] && row->index[at] < near->index[k]; ++at) {
            give(&dem->list, row->index[at], &row->packed[at]);
        }
        if (at < row->begin[end] && row->index[at] == near->index[k]) {
            near->packed[k] = row->packed[at++];
        } else {
            take(&dem->list, near->index[k], &near->packed[k]);
        }
    }
    for (; at < row->begin[end]; ++at) {
        give(&dem->list, row->index[at], &row->packed[at]);
    }
}

static void unpack_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_dem *dem = context;
    (void)worker;
    for (int64_t k = begin; k < end; ++k) {
        give(&dem->list, dem->near.index[k], &dem->near.packed[k]);
    }
}

static clast_status grow_row(clx_near *near)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_grow_lines(&near->packed, &near->packed_capacity,
                           (int64_t)near->n + CLX_PREFETCH_PAIRS, sizeof *near->packed));
    memset(near->packed + near->n, 0, CLX_PREFETCH_PAIRS * sizeof *near->packed);
done:
    return status;
}

clast_status clx_near_pack(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    clx_near *near = &dem->near;
    CLX_TRY(grow_row(near));
    clx_dem_for(dem, near->n, PACK, pack_block, dem);
    near->is_packed = true;
done:
    return status;
}

void clx_near_unpack(clast_dem *dem)
{
    if (dem->near.is_packed) {
        clx_dem_for(dem, dem->near.n, PACK, unpack_block, dem);
        dem->near.is_packed = false;
    }
}

/// What is packed becomes the old row, whose room is used for the next, or the other way round.
static void turn_rows(clx_near *near)
{
    const clx_packed_row row = {.n = near->n,
                                .index = near->index,
                                .begin = near->begin,
                                .packed = near->packed,
                                .capacity = near->capacity,
                                .item_capacity = near->item_capacity,
                                .packed_capacity = near->packed_capacity};
    near->n = near->old.n;
    near->index = near->old.index;
    near->begin = near->old.begin;
    near->packed = near->old.packed;
    near->capacity = near->old.capacity;
    near->item_capacity = near->old.item_capacity;
    near->packed_capacity = near->old.packed_capacity;
    near->old = row;
}

clast_status clx_near_find(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    clx_near *near = &dem->near;
    const int64_t n_grain = dem->n_grain;
    if (near->is_packed) {
        turn_rows(near);
    }
    CLX_TRY(clx_grow(&near->begin, &near->item_capacity, (int64_t)dem->n_item + 1,
                     sizeof *near->begin));
    CLX_TRY(clx_grow(&near->until, &near->until_capacity, n_grain + 1, sizeof *near->until));
    CLX_TRY(clx_grow_lines(&near->load, &near->load_capacity, n_grain + 1, sizeof *near->load));
    memset(near->load, 0, (size_t)n_grain * sizeof *near->load);
    clx_dem_for(dem, n_grain, BLOCK, advance, dem);
    CLX_TRY(pick(dem));
    CLX_TRY(give_slots(dem));
    if (near->is_packed) {
        CLX_TRY(grow_row(near));
        clx_dem_for(dem, dem->n_item, BLOCK, pack_again, dem);
    }
    near->is_due = false;
    near->is_gathered = false;
    dem->sweeping.n_worker = 0;
done:
    if (status != CLAST_OK && near->is_packed) {
        turn_rows(near); // what is packed is still whole
    }
    return status;
}
