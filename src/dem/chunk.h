#pragma once
// How the grains of a sweep are divided among threads.
#include "dem/dem.h"
#include "math/lanes.h"
#include <stdatomic.h>

/// Grains from `begin` on that one thread goes through, some blocks at a time, while another may
/// take the end of what is left. Threads that work on neighbours share no line.
typedef struct clx_chunk {
    _Alignas(64) _Atomic uint64_t left; ///< the next grain; in the upper half: the end
    _Atomic bool is_taken;
    int32_t begin;
    int32_t n_late;  ///< fours of it that wait until all chunks are done
    int64_t n_kept;  ///< what it does to late grains
    int32_t highest; ///< of those grains
    int flag;        ///< clx_move_flag of its grains
} clx_chunk;

/// What a thread did in a step, and how fast.
typedef struct clx_pace {
    _Alignas(64) double seconds;
    int64_t work;
    double speed; ///< work a second in the last steps; 0: not known
} clx_pace;

/// Weighs the grains of a new inner list, for `n_worker` threads.
clast_status clx_chunks_weigh(clast_dem *dem, int32_t n_worker);

/// A chunk for each thread, as large as its pace in the last steps asks for.
void clx_chunks_begin(clast_dem *dem);

/// The next chunk for a thread: its own, one that no thread has taken, or half of what is left of
/// another. NULL: there is no more to do.
clx_chunk *clx_chunk_take(clx_sweeping *s, int32_t worker);

/// The chunk's next blocks of grains [*begin, *end); false when there is none left.
bool clx_chunk_next(clx_chunk *chunk, int64_t *begin, int64_t *end);

/// Notes that a thread did these blocks' work in so many seconds.
void clx_chunk_pace(clx_sweeping *s, int32_t worker, int64_t work, double seconds);

/// Brings the chunks into the order of their grains, and what is late into one row; learns the
/// threads' paces.
void clx_chunks_end(clast_dem *dem);

/// Where a chunk keeps what it does to late grains: there is room for all its pairs and grains.
static inline int64_t clx_chunk_room(const clast_dem *dem, const clx_chunk *chunk)
{
    return dem->inner.begin[chunk->begin] + chunk->begin;
}

/// Work of the block of grains that begins with g.
static inline int64_t clx_block_work(const clx_sweeping *s, int64_t g)
{
    const int64_t block = g / CLX_SWEEP_BLOCK;
    return s->n_worker > 1 ? s->before[block + 1] - s->before[block] : 0;
}

/// Whether some pair leads from a grain before `begin` to grain g or to one of its four.
static inline bool clx_is_late(const clx_sweeping *s, int64_t g, int64_t begin)
{
    return atomic_load_explicit(&s->lowest[g / CLX_LANES], memory_order_relaxed) < begin;
}
