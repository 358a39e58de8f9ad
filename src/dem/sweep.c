// A step of whole grains in one sweep over memory.
//
// A grain's force and torque are known when the pairs of lower grains and its own are done, and no
// later pair reads its position. So a block of grains is taken through contacts and motion at once:
// pair forces stay in the first-level cache, grains in the second.
//
// Threads go through chunks of grains (chunk.c). A grain that has a pair with one of an earlier
// chunk is deferred: it stays where it is and moves when all chunks are done. The first chunk that
// has a pair with it adds to its sum, as to that of any other grain; what later chunks contribute
// is stored, in order, and added then. No other chunk reads a grain that is not deferred. So the
// sums have the order of motion.c, and chunks and threads change no bit.
#include "base/clock.h"
#include "base/parallel.h"
#include "dem/chunk.h"
#include "dem/move.h"
#include <string.h>

/// Grains of a block, whose pair forces stay in the first-level cache.
enum { BLOCK = CLX_SWEEP_BLOCK };

CLX_INLINE void add_force_torque(clx_force_torque *to, const double force[4],
                                 const double torque[4])
{
    lanes_store(to->force, lanes_load(to->force) + lanes_load(force));
    lanes_store(to->torque, lanes_load(to->torque) + lanes_load(torque));
}

/// A block of grains, its active pairs and their forces.
typedef struct {
    clx_chunk *chunk;
    int64_t begin, end;
    int32_t n;
    const clx_active_pair *active;
    const clx_pair_force *force;
} block;

/// Stores a contribution to a deferred grain.
CLX_INLINE void defer(clast_dem *dem, clx_chunk *chunk, int32_t grain, const double force[4],
                      const double torque[4])
{
    CLAST_ASSERT(grain >= 0 && grain < dem->n_grain);
    const int64_t at = clx_chunk_offset(dem, chunk) + chunk->n_contribution++;
    clx_force_torque *total = &dem->sweeping.contribution[at];
    lanes_store(total->force, lanes_load(force));
    lanes_store(total->torque, lanes_load(torque));
    dem->sweeping.contribution_to[at] = grain;
    chunk->highest = grain > chunk->highest ? grain : chunk->highest;
}

/// Adds the pair forces of the active pairs to the sums of the block's grains and the others, or
/// stores them where the grain is deferred.
CLX_INLINE void add_forces_of(clast_dem *dem, block in, bool has_deferred)
{
    const clx_sweeping *s = &dem->sweeping;
    clx_force_torque *total = dem->inner.total;
    const int32_t first = in.chunk->begin;
    clx_force_torque own[BLOCK] = {0};
    for (int32_t k = 0; k < in.n; ++k) {
        const clx_active_pair active = in.active[k];
        const clx_pair_force *force = &in.force[active.at];
        const int32_t b = active.pair->b;
        clx_force_torque *on_a = &own[active.pair->a - in.begin];
        lanes_store(on_a->force, lanes_load(on_a->force) - lanes_load(force->force));
        lanes_store(on_a->torque, lanes_load(on_a->torque) - lanes_load(force->torque_a));
        if (b < 0) {
            continue;
        }
        if (has_deferred && clx_is_deferred(s, b, first)) {
            defer(dem, in.chunk, b, force->force, force->torque_b);
        } else {
            add_force_torque(&total[b], force->force, force->torque_b);
        }
    }
    for (int64_t g = in.begin; g < in.end; ++g) {
        const clx_force_torque *to_add = &own[g - in.begin];
        if (has_deferred && clx_is_deferred(s, g, first)) {
            defer(dem, in.chunk, (int32_t)g, to_add->force, to_add->torque);
        } else {
            add_force_torque(&total[g], to_add->force, to_add->torque);
        }
    }
}

CLX_FOR_EACH_MACHINE
static void add_forces(clast_dem *dem, block in)
{
    if (in.chunk->begin > 0) {
        add_forces_of(dem, in, true);
    } else {
        add_forces_of(dem, in, false);
    }
}

static int move_and_clear(const clx_moving *c, int64_t g, int n)
{
    CLAST_ASSERT(n >= 1 && g + n <= c->dem->n_grain);
    clx_force_torque *total = &c->dem->inner.total[g];
    const int flag = clx_move_group(c, g, n, total);
    memset(total, 0, (size_t)n * sizeof *total);
    return flag;
}

/// Moves the grains that are not deferred, up to eight side by side.
static int move_block(const clx_moving *c, clx_chunk *chunk, int64_t begin, int64_t end)
{
    clx_sweeping *s = &c->dem->sweeping;
    const bool has_deferred = chunk->begin > 0;
    int flag = 0;
    int n = 0;
    for (int64_t g = begin; g < end; g += n) {
        n = clx_lanes_from(g, end);
        if (has_deferred && clx_is_deferred(s, g, chunk->begin)) {
            s->deferred[chunk->begin / CLX_LANES + chunk->n_deferred++] = (int32_t)g;
            n = CLX_LANES;
            continue;
        }
        n = has_deferred && n > CLX_LANES && clx_is_deferred(s, g + CLX_LANES, chunk->begin)
                ? CLX_LANES
                : n;
        flag |= move_and_clear(c, g, n);
    }
    return flag;
}

static int sweep_block(const clx_moving *c, clx_chunk *chunk, int64_t begin, int64_t end,
                       int32_t worker)
{
    CLAST_ASSERT(begin < end && end - begin <= BLOCK && end <= c->dem->n_grain);
    clast_dem *dem = c->dem;
    const int64_t offset = (int64_t)worker * dem->sweeping.most;
    clx_pair_force *force = dem->sweeping.force + offset;
    clx_active_pair *active = dem->sweeping.active + offset;
    const int32_t n =
        clx_contacts_among(dem, dem->inner.begin[begin], dem->inner.begin[end], force, active);
    add_forces(dem, (block){chunk, begin, end, n, active, force});
    return move_block(c, chunk, begin, end);
}

/// A thread's part of the step: chunks while there are any.
static void sweep_chunks(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const clx_moving *c = context;
    clx_sweeping *s = &c->dem->sweeping;
    const double begun = clx_clock();
    int64_t work = 0;
    (void)begin;
    (void)end;
    for (clx_chunk *chunk = clx_chunk_claim(s, worker); chunk != NULL;
         chunk = clx_chunk_claim(s, worker)) {
        int64_t g = 0;
        int64_t last = 0;
        while (clx_chunk_next(chunk, &g, &last)) {
            for (; g < last; g += BLOCK) {
                chunk->flag |=
                    sweep_block(c, chunk, g, g + BLOCK < last ? g + BLOCK : last, worker);
                work += clx_block_work(s, g);
            }
        }
    }
    clx_chunk_pace(s, worker, work, clx_clock() - begun);
}

/// Adds the stored contributions to grains [begin, end), in the order of the pairs.
CLX_FOR_EACH_MACHINE
static void add_contributions(clast_dem *dem, int32_t begin, int32_t end)
{
    const clx_sweeping *s = &dem->sweeping;
    for (const clx_chunk *c = s->chunk; c < s->chunk + s->n_chunk && c->begin < end; ++c) {
        const int64_t from = clx_chunk_offset(dem, c);
        const int64_t n = c->highest >= begin ? c->n_contribution : 0;
        for (int64_t k = from; k < from + n; ++k) {
            const int32_t g = s->contribution_to[k];
            if (g >= begin && g < end) {
                add_force_torque(&dem->inner.total[g], s->contribution[k].force,
                                 s->contribution[k].torque);
            }
        }
    }
}

/// Prefetches four grains, line by line: they have left the second-level cache.
CLX_INLINE void prefetch_grains(const clast_dem *dem, int64_t g)
{
    enum { LINE = 64 };
    const char *grain = (const char *)&dem->grain[g];
    const char *motion = (const char *)&dem->motion[g];
    for (size_t at = 0; at < CLX_LANES * sizeof(clx_grain); at += LINE) {
        __builtin_prefetch(grain + at);
    }
    for (size_t at = 0; at < CLX_LANES * sizeof(clx_motion); at += LINE) {
        __builtin_prefetch(motion + at);
    }
}

/// How many groups of deferred grains ahead are prefetched.
enum { AHEAD = 3 };

/// Deferred groups of four grains, divided into pieces.
typedef struct {
    const clx_moving *moving;
    int32_t n_piece;
} deferred_work;

static void move_deferred(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const deferred_work *w = context;
    clast_dem *dem = w->moving->dem;
    const clx_sweeping *s = &dem->sweeping;
    (void)worker;
    for (int64_t piece = begin; piece < end; ++piece) {
        const int64_t first = piece * s->n_deferred / w->n_piece;
        const int64_t last = (piece + 1) * s->n_deferred / w->n_piece;
        int flag = 0;
        add_contributions(dem, s->deferred[first], s->deferred[last - 1] + CLX_LANES);
        for (int64_t f = first; f < last; ++f) {
            const int64_t left = dem->n_grain - s->deferred[f];
            if (f + AHEAD < last) {
                prefetch_grains(dem, s->deferred[f + AHEAD]);
            }
            flag |=
                move_and_clear(w->moving, s->deferred[f], left < CLX_LANES ? (int)left : CLX_LANES);
        }
        dem->block_flag[piece] = (uint8_t)flag;
    }
}

/// Moves the deferred grains, in few pieces, since each searches all stored contributions.
static int move_all_deferred(const clx_moving *c, int32_t n_worker)
{
    enum { A_WORKER = 2, FOURS = 16 };
    clast_dem *dem = c->dem;
    const int32_t most = dem->sweeping.n_deferred / FOURS + 1;
    deferred_work w = {.moving = c, .n_piece = A_WORKER * n_worker};
    int flag = 0;
    if (dem->sweeping.n_deferred > 0) {
        w.n_piece = w.n_piece < most ? w.n_piece : most;
        clx_dem_for(dem, w.n_piece, 1, move_deferred, &w);
        for (int32_t piece = 0; piece < w.n_piece; ++piece) {
            flag |= dem->block_flag[piece];
        }
    }
    return flag;
}

clast_status clx_sweep(clast_dem *dem, bool *is_fine)
{
    clast_status status = CLAST_OK;
    clx_sweeping *s = &dem->sweeping;
    clx_moving c = clx_move_begin(dem);
    int flag = 0;
    if (!dem->all_round && !dem->inner.is_packed) {
        CLX_TRY(clx_inner_pack(dem));
    }
    const int32_t n_worker = clx_dem_is_serial(dem) ? 1 : clx_parallel_workers();
    if (s->n_worker != n_worker) {
        CLX_TRY(clx_chunks_weigh(dem, n_worker));
    }
    clx_chunks_begin(dem);
    clx_dem_for(dem, n_worker, 1, sweep_chunks, &c);
    clx_chunks_end(dem);
    for (int32_t k = 0; k < s->n_chunk; ++k) {
        flag |= s->chunk[k].flag;
    }
    flag |= move_all_deferred(&c, n_worker);
    *is_fine = clx_move_end(dem, flag);
done:
    return status;
}
