// How the grains of a sweep are divided among threads.
//
// Each thread begins with one contiguous chunk, since grains at a border of two cost more; its
// length follows the thread's speed in the last steps. A thread that is done steals half of what is
// left of another's chunk: threads are never equally fast. No result depends on the borders.
#include "dem/chunk.h"

#include "base/alloc.h"
#include "base/lines.h"
#include <string.h>

enum { BLOCK = CLX_SWEEP_BLOCK };

/// Chunks a thread, stolen ones among them.
enum { MOST = 8 };

/// Grains that must be left of a chunk for half of them to be stolen: with fewer, the new border
/// costs more than the wait.
enum { LEAST = 6 * BLOCK };

/// One part in so many of what is left of a chunk is what its thread claims at once.
enum { SHARE = 16 };

/// Weight of the last step in a thread's pace.
static const double LAST = 0.25;

void clx_sweeping_free(clx_sweeping *s)
{
    CLX_FREE(s->chunk, s->pace, s->before, s->lowest, s->deferred, s->force, s->active,
             s->contribution, s->contribution_to);
    *s = (clx_sweeping){0};
}

static inline uint64_t packed(int64_t next, int64_t end)
{
    CLAST_ASSERT(next >= 0 && next <= end && end <= INT32_MAX);
    return (uint64_t)next | (uint64_t)end << 32;
}

static inline int64_t next_of(uint64_t left)
{
    return (int64_t)(left & UINT32_MAX);
}

static inline int64_t end_of(uint64_t left)
{
    return (int64_t)(left >> 32);
}

/// Notes that grains a and b have a pair.
static inline void note_low(clx_sweeping *s, int32_t a, int32_t b)
{
    CLAST_ASSERT(a >= 0 && b >= 0);
    _Atomic int32_t *lowest = &s->lowest[b / CLX_LANES];
    int32_t now = atomic_load_explicit(lowest, memory_order_relaxed);
    while (a < now && !atomic_compare_exchange_weak_explicit(lowest, &now, a, memory_order_relaxed,
                                                             memory_order_relaxed)) {
    }
}

/// Work of blocks of grains, and the lowest neighbour of each group of four. Moving a grain costs
/// about as much as five skipped pairs, a touching pair as twelve (profile of P1).
static void weigh(int64_t begin, int64_t end, int32_t worker, void *context)
{
    enum { MOVE = 5, TOUCH = 12 };
    clast_dem *dem = context;
    const clx_inner_list *inner = &dem->inner;
    clx_sweeping *s = &dem->sweeping;
    (void)worker;
    for (int64_t block = begin; block < end; ++block) {
        const int64_t first = block * BLOCK;
        const int64_t last = first + BLOCK < dem->n_grain ? first + BLOCK : dem->n_grain;
        int64_t work = MOVE * (last - first) + inner->begin[last] - inner->begin[first];
        for (int32_t k = inner->begin[first]; k < inner->begin[last]; ++k) {
            const clx_dem_pair *pair = clx_inner_pair(dem, k);
            work += TOUCH * (int64_t)pair->touches;
            if (pair->b >= 0) {
                note_low(s, pair->a, pair->b);
            }
        }
        s->before[block + 1] = work;
    }
}

/// Capacity for all contributions to deferred grains. Pages that are never written take no memory,
/// so nothing is copied when it grows.
static clast_status reserve_contributions(clx_sweeping *s, int64_t n)
{
    clast_status status = CLAST_OK;
    if (s->contribution_capacity[0] < n || s->contribution_capacity[1] < n) {
        CLX_FREE(s->contribution, s->contribution_to);
        s->contribution = NULL;
        s->contribution_to = NULL;
        s->contribution_capacity[0] = 0;
        s->contribution_capacity[1] = 0;
        CLX_TRY(clx_grow_lines(&s->contribution, &s->contribution_capacity[0], n + n / 4,
                               sizeof *s->contribution));
        CLX_TRY(clx_grow_lines(&s->contribution_to, &s->contribution_capacity[1], n + n / 4,
                               sizeof *s->contribution_to));
    }
done:
    return status;
}

static int64_t blocks_of(const clast_dem *dem)
{
    return (dem->n_grain + BLOCK - 1) / BLOCK;
}

static void weigh_all(clast_dem *dem)
{
    enum { AT_ONCE = 16 };
    clx_sweeping *s = &dem->sweeping;
    const int64_t n_block = blocks_of(dem);
    for (int32_t f = 0; f <= dem->n_grain / CLX_LANES; ++f) {
        atomic_store_explicit(&s->lowest[f], INT32_MAX, memory_order_relaxed);
    }
    s->before[0] = 0;
    clx_dem_for(dem, n_block, AT_ONCE, weigh, dem);
    for (int64_t b = 0; b < n_block; ++b) {
        s->before[b + 1] += s->before[b];
        CLAST_ASSERT(s->before[b + 1] >= s->before[b]);
    }
}

static int32_t most_pairs(const clast_dem *dem)
{
    int32_t most = 0;
    for (int32_t i = 0; i < dem->n_grain; i += BLOCK) {
        const int32_t end = i + BLOCK < dem->n_grain ? i + BLOCK : dem->n_grain;
        const int32_t pairs = dem->inner.begin[end] - dem->inner.begin[i];
        most = pairs > most ? pairs : most;
    }
    return most;
}

clast_status clx_chunks_weigh(clast_dem *dem, int32_t n_worker)
{
    CLAST_ASSERT(n_worker >= 1);
    clast_status status = CLAST_OK;
    clx_sweeping *s = &dem->sweeping;
    const int64_t n_four = dem->n_grain / CLX_LANES + 1;
    s->n_worker = 0;
    s->most = most_pairs(dem);
    CLX_TRY(
        clx_grow_lines(&s->chunk, &s->chunk_capacity, (int64_t)MOST * n_worker, sizeof *s->chunk));
    if (s->pace_capacity < n_worker) {
        CLX_TRY(clx_grow_lines(&s->pace, &s->pace_capacity, n_worker, sizeof *s->pace));
        memset(s->pace, 0, (size_t)s->pace_capacity * sizeof *s->pace);
    }
    CLX_TRY(clx_grow_lines(&s->force, &s->force_capacity, (int64_t)n_worker * s->most,
                           sizeof *s->force));
    CLX_TRY(clx_grow_lines(&s->active, &s->active_capacity, (int64_t)n_worker * s->most,
                           sizeof *s->active));
    if (n_worker > 1) {
        CLX_TRY(clx_grow(&s->before, &s->before_capacity, blocks_of(dem) + 1, sizeof *s->before));
        CLX_TRY(clx_grow(&s->lowest, &s->lowest_capacity, n_four, sizeof *s->lowest));
        CLX_TRY(clx_grow(&s->deferred, &s->deferred_capacity, n_four, sizeof *s->deferred));
        CLX_TRY(reserve_contributions(s, (int64_t)dem->inner.n + dem->n_grain));
        weigh_all(dem);
    }
    s->n_worker = n_worker;
done:
    return status;
}

/// First grain of the block before which there is as much work.
static int64_t grain_at(const clast_dem *dem, double work)
{
    const int64_t *before = dem->sweeping.before;
    int64_t low = 0;
    int64_t high = blocks_of(dem);
    while (low < high) {
        const int64_t middle = (low + high) / 2;
        if ((double)before[middle] < work) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low * BLOCK < dem->n_grain ? low * BLOCK : dem->n_grain;
}

static void set_chunk(clx_chunk *chunk, int64_t begin, int64_t end)
{
    CLAST_ASSERT(begin >= 0 && begin <= end);
    chunk->begin = (int32_t)begin;
    chunk->n_deferred = 0;
    chunk->n_contribution = 0;
    chunk->highest = -1;
    chunk->flag = 0;
    atomic_store_explicit(&chunk->left, packed(begin, end), memory_order_release);
}

void clx_chunks_begin(clast_dem *dem)
{
    clx_sweeping *s = &dem->sweeping;
    const int32_t n = s->n_worker;
    double all = 0.0;
    int64_t begin = 0;
    bool are_known = true;
    for (int32_t c = 0; c < n; ++c) {
        all += s->pace[c].speed;
        are_known = are_known && s->pace[c].speed > 0.0;
    }
    double share = 0.0;
    for (int32_t c = 0; c < MOST * n; ++c) {
        int64_t end = begin;
        if (c < n) {
            share += are_known ? s->pace[c].speed / all : 1.0 / n;
            end = c + 1 == n ? dem->n_grain
                             : grain_at(dem, share * (double)s->before[blocks_of(dem)]);
        }
        set_chunk(&s->chunk[c], begin, end);
        atomic_store_explicit(&s->chunk[c].is_claimed, c >= n, memory_order_relaxed);
        begin = end;
    }
    atomic_store(&s->n_chunk, n);
}

bool clx_chunk_next(clx_chunk *chunk, int64_t *begin, int64_t *end)
{
    uint64_t left = atomic_load_explicit(&chunk->left, memory_order_relaxed);
    int64_t next = 0;
    do {
        *begin = next_of(left);
        if (*begin >= end_of(left)) {
            return false;
        }
        next = *begin + (1 + (end_of(left) - *begin) / (SHARE * BLOCK)) * BLOCK;
        next = next < end_of(left) ? next : end_of(left);
    } while (!atomic_compare_exchange_weak(&chunk->left, &left, packed(next, end_of(left))));
    *end = next;
    return true;
}

/// Chunks in use; threads that found no free one have counted on.
static int32_t chunks_of(const clx_sweeping *s)
{
    const int32_t n = atomic_load(&s->n_chunk);
    return n < MOST * s->n_worker ? n : MOST * s->n_worker;
}

/// The chunk with most grains left, and its `left` then; NULL: none has enough.
static clx_chunk *richest(const clx_sweeping *s, int32_t n, uint64_t *how)
{
    clx_chunk *best = NULL;
    int64_t most = LEAST - 1;
    for (int32_t c = 0; c < n; ++c) {
        const uint64_t left = atomic_load(&s->chunk[c].left);
        if (end_of(left) - next_of(left) > most) {
            most = end_of(left) - next_of(left);
            best = &s->chunk[c];
            *how = left;
        }
    }
    return best;
}

/// Steals the second half of what is left of some chunk.
static clx_chunk *steal_half(clx_sweeping *s)
{
    uint64_t left = 0;
    if (richest(s, chunks_of(s), &left) == NULL) {
        return NULL;
    }
    const int32_t at = atomic_fetch_add(&s->n_chunk, 1);
    clx_chunk *from = at < MOST * s->n_worker ? richest(s, at, &left) : NULL;
    while (from != NULL) {
        const int64_t half = (end_of(left) - next_of(left)) / (2 * BLOCK) * BLOCK;
        const int64_t middle = next_of(left) + half;
        if (atomic_compare_exchange_strong(&from->left, &left, packed(next_of(left), middle))) {
            set_chunk(&s->chunk[at], middle, end_of(left));
            return &s->chunk[at];
        }
        from = richest(s, at, &left);
    }
    return NULL;
}

clx_chunk *clx_chunk_claim(clx_sweeping *s, int32_t worker)
{
    CLAST_ASSERT(worker >= 0 && s->n_worker >= 1);
    for (int32_t k = 0; k < s->n_worker; ++k) {
        clx_chunk *chunk = &s->chunk[(worker + k) % s->n_worker];
        if (!atomic_exchange(&chunk->is_claimed, true)) {
            return chunk;
        }
    }
    return steal_half(s);
}

void clx_chunk_pace(clx_sweeping *s, int32_t worker, int64_t work, double seconds)
{
    CLAST_ASSERT(work >= 0 && seconds >= 0.0);
    s->pace[worker].work += work;
    s->pace[worker].seconds += seconds;
}

static void update_speed(clx_pace *pace)
{
    if (pace->work > 0 && pace->seconds > 0.0) {
        const double speed = (double)pace->work / pace->seconds;
        pace->speed = pace->speed > 0.0 ? pace->speed + LAST * (speed - pace->speed) : speed;
    }
    pace->work = 0;
    pace->seconds = 0.0;
}

/// Insertion sort by first grain: there are few, nearly in order.
static void sort(clx_chunk *chunk, int32_t n)
{
    for (int32_t k = 1; k < n; ++k) {
        for (int32_t at = k; at > 0 && chunk[at].begin < chunk[at - 1].begin; --at) {
            const clx_chunk other = chunk[at];
            chunk[at] = chunk[at - 1];
            chunk[at - 1] = other;
        }
    }
}

void clx_chunks_end(clast_dem *dem)
{
    clx_sweeping *s = &dem->sweeping;
    const int32_t n = chunks_of(s);
    atomic_store(&s->n_chunk, n);
    sort(s->chunk, n);
    s->n_deferred = 0;
    for (int32_t c = 0; c < n; ++c) {
        const clx_chunk *chunk = &s->chunk[c];
        if (chunk->n_deferred > 0) {
            memmove(s->deferred + s->n_deferred, s->deferred + chunk->begin / CLX_LANES,
                    (size_t)chunk->n_deferred * sizeof *s->deferred);
            s->n_deferred += chunk->n_deferred;
        }
    }
    for (int32_t w = 0; w < s->n_worker; ++w) {
        update_speed(&s->pace[w]);
    }
}
