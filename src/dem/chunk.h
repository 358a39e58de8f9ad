#pragma once
// How the grains of a sweep are divided among threads.
#include "dem/dem.h"
#include "math/lanes.h"
#include <stdatomic.h>

/// Grains from `begin` on that one thread sweeps over, some blocks at a time, while another may
/// steal the end of what is left. Aligned so that two chunks share no cache line.
typedef struct clx_chunk {
    _Alignas(64) _Atomic uint64_t left; ///< the next grain; in the upper half: the end
    _Atomic bool is_claimed;
    int32_t begin;
    int32_t n_deferred;     ///< groups of four that move when all chunks are done
    int64_t n_contribution; ///< contributions to deferred grains
    int32_t highest;        ///< highest of those grains
    int flag;               ///< clx_move_flag of its grains
} clx_chunk;

/// Work of a thread in a step, and its speed.
typedef struct clx_pace {
    _Alignas(64) double seconds;
    int64_t work;
    double speed; ///< work per second, mean of the last steps; 0: not known
} clx_pace;

/// Counts the work of all blocks with a new inner list, and reserves arrays for `n_worker` threads.
clast_status clx_chunks_weigh(clast_dem *dem, int32_t n_worker);

/// A chunk for each thread, in proportion to its speed in the last steps.
void clx_chunks_begin(clast_dem *dem);

/// The next chunk for a thread: its own, one that no thread has claimed, or half of what is left of
/// another. NULL: all is done.
clx_chunk *clx_chunk_claim(clx_sweeping *s, int32_t worker);

/// The chunk's next blocks of grains [*begin, *end); false when there is none left.
bool clx_chunk_next(clx_chunk *chunk, int64_t *begin, int64_t *end);

/// Notes that a thread did these blocks' work in so many seconds.
void clx_chunk_pace(clx_sweeping *s, int32_t worker, int64_t work, double seconds);

/// Sorts the chunks by their grains and joins their deferred grains; updates the threads' speeds.
void clx_chunks_end(clast_dem *dem);

/// Index of a chunk's first contribution: there is capacity for all its pairs and grains.
static inline int64_t clx_chunk_offset(const clast_dem *dem, const clx_chunk *chunk)
{
    return dem->inner.begin[chunk->begin] + chunk->begin;
}

/// Work of the block of grains that begins with g.
static inline int64_t clx_block_work(const clx_sweeping *s, int64_t g)
{
    const int64_t block = g / CLX_SWEEP_BLOCK;
    return s->n_worker > 1 ? s->before[block + 1] - s->before[block] : 0;
}

/// Whether a grain before `begin` has a pair with grain g or another of its group of four: then g
/// is deferred by a chunk that begins there.
static inline bool clx_is_deferred(const clx_sweeping *s, int64_t g, int64_t begin)
{
    return atomic_load_explicit(&s->lowest[g / CLX_LANES], memory_order_relaxed) < begin;
}
