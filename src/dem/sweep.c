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

CLX_INLINE void add(clx_load *to, const double force[4], const double torque[4])
{
    lanes_store(to->force, lanes_load(to->force) + lanes_load(force));
    lanes_store(to->torque, lanes_load(to->torque) + lanes_load(torque));
}

/// A block of grains, its awake pairs and what all its pairs do.
typedef struct {
    clx_chunk *chunk;
    int64_t begin, end;
    int32_t n;
    const clx_awake *awake;
    const clx_pair_force *force;
} block;

/// Keeps what is done to a late grain.
CLX_INLINE void keep(clast_dem *dem, clx_chunk *chunk, int32_t grain, const double force[4],
                     const double torque[4])
{
    const int64_t at = clx_chunk_room(dem, chunk) + chunk->n_kept++;
    clx_load *load = &dem->sweeping.kept[at];
    lanes_store(load->force, lanes_load(force));
    lanes_store(load->torque, lanes_load(torque));
    dem->sweeping.kept_on[at] = grain;
    chunk->highest = grain > chunk->highest ? grain : chunk->highest;
}

/// What the awake pairs do to the block's grains and to the others: onto their loads, or kept where
/// the grain is late.
CLX_INLINE void spread(clast_dem *dem, block in, bool has_late)
{
    const clx_sweeping *s = &dem->sweeping;
    clx_load *load = dem->inner.load;
    const int32_t first = in.chunk->begin;
    clx_load own[BLOCK] = {0};
    for (int32_t k = 0; k < in.n; ++k) {
        const clx_awake awake = in.awake[k];
        const clx_pair_force *force = &in.force[awake.at];
        const int32_t b = awake.pair->b;
        clx_load *on_a = &own[awake.pair->a - in.begin];
        lanes_store(on_a->force, lanes_load(on_a->force) - lanes_load(force->force));
        lanes_store(on_a->torque, lanes_load(on_a->torque) - lanes_load(force->torque_a));
        if (b < 0) {
            continue;
        }
        if (has_late && clx_is_late(s, b, first)) {
            keep(dem, in.chunk, b, force->force, force->torque_b);
        } else {
            add(&load[b], force->force, force->torque_b);
        }
    }
    for (int64_t g = in.begin; g < in.end; ++g) {
        const clx_load *to_add = &own[g - in.begin];
        if (has_late && clx_is_late(s, g, first)) {
            keep(dem, in.chunk, (int32_t)g, to_add->force, to_add->torque);
        } else {
            add(&load[g], to_add->force, to_add->torque);
        }
    }
}

CLX_FOR_EACH_MACHINE
static void spread_all(clast_dem *dem, block in)
{
    if (in.chunk->begin > 0) {
        spread(dem, in, true);
    } else {
        spread(dem, in, false);
    }
}

static int move_and_clear(const clx_moving *c, int64_t g, int n)
{
    clx_load *load = &c->dem->inner.load[g];
    const int flag = clx_move_few(c, g, n, load);
    memset(load, 0, (size_t)n * sizeof *load);
    return flag;
}

/// Grains that are not late, as many at once as there are.
static int move_block(const clx_moving *c, clx_chunk *chunk, int64_t begin, int64_t end)
{
    clx_sweeping *s = &c->dem->sweeping;
    const bool has_late = chunk->begin > 0;
    int flag = 0;
    int n = 0;
    for (int64_t g = begin; g < end; g += n) {
        n = clx_lanes_from(g, end);
        if (has_late && clx_is_late(s, g, chunk->begin)) {
            s->late[chunk->begin / CLX_LANES + chunk->n_late++] = (int32_t)g;
            n = CLX_LANES;
            continue;
        }
        n = has_late && n > CLX_LANES && clx_is_late(s, g + CLX_LANES, chunk->begin) ? CLX_LANES
                                                                                     : n;
        flag |= move_and_clear(c, g, n);
    }
    return flag;
}

static int sweep_block(const clx_moving *c, clx_chunk *chunk, int64_t begin, int64_t end,
                       int32_t worker)
{
    clast_dem *dem = c->dem;
    const int64_t room = (int64_t)worker * dem->sweeping.most;
    clx_pair_force *force = dem->sweeping.force + room;
    clx_awake *awake = dem->sweeping.awake + room;
    const int32_t n =
        clx_contacts_among(dem, dem->inner.begin[begin], dem->inner.begin[end], force, awake);
    spread_all(dem, (block){chunk, begin, end, n, awake, force});
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
    for (clx_chunk *chunk = clx_chunk_take(s, worker); chunk != NULL;
         chunk = clx_chunk_take(s, worker)) {
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

/// What was kept for grains [begin, end), in the order of the pairs.
CLX_FOR_EACH_MACHINE
static void add_kept(clast_dem *dem, int32_t begin, int32_t end)
{
    const clx_sweeping *s = &dem->sweeping;
    for (const clx_chunk *c = s->chunk; c < s->chunk + s->n_chunk && c->begin < end; ++c) {
        const int64_t from = clx_chunk_room(dem, c);
        const int64_t n = c->highest >= begin ? c->n_kept : 0;
        for (int64_t k = from; k < from + n; ++k) {
            const int32_t g = s->kept_on[k];
            if (g >= begin && g < end) {
                add(&dem->inner.load[g], s->kept[k].force, s->kept[k].torque);
            }
        }
    }
}

/// Four grains, by the line: they have left the second-level cache.
CLX_INLINE void ask_for(const clast_dem *dem, int64_t g)
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

/// Late fours that are asked for in advance.
enum { AHEAD = 3 };

/// The late fours of a piece.
typedef struct {
    const clx_moving *moving;
    int32_t n_piece;
} late_work;

static void move_late(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const late_work *w = context;
    clast_dem *dem = w->moving->dem;
    const clx_sweeping *s = &dem->sweeping;
    (void)worker;
    for (int64_t piece = begin; piece < end; ++piece) {
        const int64_t first = piece * s->n_late / w->n_piece;
        const int64_t last = (piece + 1) * s->n_late / w->n_piece;
        int flag = 0;
        add_kept(dem, s->late[first], s->late[last - 1] + CLX_LANES);
        for (int64_t f = first; f < last; ++f) {
            const int64_t left = dem->n_grain - s->late[f];
            if (f + AHEAD < last) {
                ask_for(dem, s->late[f + AHEAD]);
            }
            flag |= move_and_clear(w->moving, s->late[f], left < CLX_LANES ? (int)left : CLX_LANES);
        }
        dem->block_flag[piece] = (uint8_t)flag;
    }
}

/// Moves what is late, in few pieces, since each looks through all that was kept.
static int move_all_late(const clx_moving *c, int32_t n_worker)
{
    enum { A_WORKER = 2, FOURS = 16 };
    clast_dem *dem = c->dem;
    const int32_t most = dem->sweeping.n_late / FOURS + 1;
    late_work w = {.moving = c, .n_piece = A_WORKER * n_worker};
    int flag = 0;
    if (dem->sweeping.n_late > 0) {
        w.n_piece = w.n_piece < most ? w.n_piece : most;
        clx_dem_for(dem, w.n_piece, 1, move_late, &w);
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
    flag |= move_all_late(&c, n_worker);
    *is_fine = clx_move_end(dem, flag);
done:
    return status;
}
