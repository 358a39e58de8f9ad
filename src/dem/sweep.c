// A step of whole grains in one sweep over memory.
//
// A grain's load is known when the pairs of lower grains and its own are done, and no later pair
// asks where it is. So a block of grains meets its neighbours and moves at once: what contacts do
// stays in the first-level cache, grains in the second.
//
// Each thread takes one large chunk of grains, since what lies on a border of chunks costs more,
// and then small ones while there are any: threads are never equally fast. A grain that one of an
// earlier chunk pushes is late: it stays where it is, what is done to it is kept in near.push, and
// it moves when all chunks are done. No other chunk reads a grain that is not late. The sums have
// the order of motion.c, so chunks and threads change no bit.
#include "base/lines.h"
#include "base/parallel.h"
#include "dem/move.h"
#include <string.h>

/// Grains of a block, whose pushes stay in the first-level cache.
enum { BLOCK = CLX_SWEEP_BLOCK };

/// Share of the work that is left for whoever is done first, in SMALL chunks a worker.
static const double REST = 0.08;
enum { SMALL = 3 };

void clx_sweeping_free(clx_sweeping *s)
{
    clx_free(s->bound);
    clx_free(s->is_late);
    clx_free(s->late);
    clx_free(s->push);
    clx_free(s->awake);
    *s = (clx_sweeping){0};
}

/// Marks the fours that some earlier chunk pushes, and lists them; nothing is kept for them yet. (A
/// link that falls asleep has parted: what it left is 0.)
static void find_late(clast_dem *dem)
{
    clx_sweeping *s = &dem->sweeping;
    const clx_near *near = &dem->near;
    const int32_t n_four = (dem->n_grain + CLX_LANES - 1) / CLX_LANES;
    memset(s->is_late, 0, (size_t)n_four);
    s->n_late = 0;
    for (int32_t c = 0; c + 1 < s->n_chunk; ++c) {
        for (int32_t k = near->begin[s->bound[c]]; k < near->begin[s->bound[c + 1]]; ++k) {
            const int32_t b = clx_near_link(dem, k)->b;
            if (b >= s->bound[c + 1]) {
                s->is_late[b / CLX_LANES] = 1;
            }
        }
    }
    for (int32_t f = 0; f < n_four; ++f) {
        if (s->is_late[f] != 0) {
            s->late[s->n_late++] = f * CLX_LANES;
        }
    }
    for (int32_t k = 0; k < near->n && s->n_late > 0; ++k) {
        const int32_t b = clx_near_link(dem, k)->b;
        if (b >= 0 && s->is_late[b / CLX_LANES] != 0) {
            near->push[k] = (clx_pushed){0};
        }
    }
}

/// Work of grains [begin, end): moving one costs about as much as five links that sleep, and one
/// that touches as twelve (profile of P1).
static int64_t work_of(const clast_dem *dem, int32_t begin, int32_t end)
{
    enum { MOVE = 5, TOUCH = 12 };
    const clx_near *near = &dem->near;
    int64_t work = (int64_t)MOVE * (end - begin) + near->begin[end] - near->begin[begin];
    for (int32_t k = near->begin[begin]; k < near->begin[end]; ++k) {
        work += TOUCH * (int64_t)clx_near_link(dem, k)->touches;
    }
    return work;
}

/// Share of the work that is in the chunks before chunk c: one for each worker, then small ones for
/// whoever is done first.
static double share_before(int32_t c, int32_t n_worker)
{
    return c <= n_worker ? (1.0 - REST) * c / n_worker
                         : 1.0 - REST * (1.0 - (double)(c - n_worker) / (SMALL * n_worker));
}

/// Chunks of whole blocks.
static void set_bounds(clast_dem *dem, int32_t n_worker)
{
    clx_sweeping *s = &dem->sweeping;
    const clx_near *near = &dem->near;
    const int32_t n = dem->n_grain;
    const double all = s->n_chunk > 1 ? (double)work_of(dem, 0, n) : 0.0;
    int64_t before = 0;
    s->most = 0;
    s->bound[0] = 0;
    int32_t c = 0;
    for (int32_t i = 0; i < n; i += BLOCK) {
        const int32_t end = i + BLOCK < n ? i + BLOCK : n;
        const int32_t links = near->begin[end] - near->begin[i];
        s->most = links > s->most ? links : s->most;
        while (c + 1 < s->n_chunk && (double)before >= all * share_before(c + 1, n_worker)) {
            s->bound[++c] = i;
        }
        before += c + 1 < s->n_chunk ? work_of(dem, i, end) : 0;
    }
    while (c < s->n_chunk) {
        s->bound[++c] = n;
    }
}

static clast_status divide(clast_dem *dem, int32_t n_worker)
{
    clast_status status = CLAST_OK;
    clx_sweeping *s = &dem->sweeping;
    const clx_near *near = &dem->near;
    const int32_t n_four = dem->n_grain / CLX_LANES + 1;
    const int32_t n_block = dem->n_grain / BLOCK + 1;
    s->n_chunk = n_worker == 1 ? 1 : (1 + SMALL) * n_worker;
    s->n_chunk = s->n_chunk < n_block ? s->n_chunk : n_block;
    CLX_TRY(clx_grow(&s->bound, &s->bound_capacity, s->n_chunk + 1, sizeof *s->bound));
    set_bounds(dem, n_worker);
    CLX_TRY(clx_grow(&s->is_late, &s->late_capacity[0], n_four, sizeof *s->is_late));
    CLX_TRY(clx_grow(&s->late, &s->late_capacity[1], n_four, sizeof *s->late));
    CLX_TRY(
        clx_grow_lines(&s->push, &s->push_capacity, (int64_t)n_worker * s->most, sizeof *s->push));
    CLX_TRY(clx_grow_lines(&s->awake, &s->awake_capacity, (int64_t)n_worker * s->most,
                           sizeof *s->awake));
    s->n_worker = n_worker;
    find_late(dem);
    if (s->n_late > 0 && !near->is_gathered) {
        CLX_TRY(clx_near_gather(dem));
    }
done:
    if (status != CLAST_OK) {
        s->n_worker = 0;
    }
    return status;
}

CLX_INLINE void add(clx_load *to, const double force[4], const double torque[4])
{
    lanes_store(to->force, lanes_load(to->force) + lanes_load(force));
    lanes_store(to->torque, lanes_load(to->torque) + lanes_load(torque));
}

/// A block of grains, its awake links and what all its links do.
typedef struct {
    int64_t begin, end;
    int32_t n;
    const clx_awake *awake;
    const clx_pushed *push;
} block;

/// What the awake links do to the block's grains and to the others: onto their loads, or kept where
/// the other is late.
CLX_INLINE void spread(clast_dem *dem, block in, bool has_late)
{
    clx_near *near = &dem->near;
    clx_load *load = near->load;
    const uint8_t *is_late = dem->sweeping.is_late;
    clx_load own[BLOCK] = {0};
    for (int32_t k = 0; k < in.n; ++k) {
        const clx_awake awake = in.awake[k];
        const clx_pushed *push = &in.push[awake.at];
        const int32_t b = awake.link->b;
        clx_load *on_a = &own[awake.link->a - in.begin];
        lanes_store(on_a->force, lanes_load(on_a->force) - lanes_load(push->force));
        lanes_store(on_a->torque, lanes_load(on_a->torque) - lanes_load(push->torque_a));
        if (b < 0) {
            continue;
        }
        if (has_late && is_late[b / CLX_LANES] != 0) {
            near->push[near->begin[in.begin] + awake.at] = *push;
        } else {
            add(&load[b], push->force, push->torque_b);
        }
    }
    for (int64_t g = in.begin; g < in.end; ++g) {
        add(&load[g], own[g - in.begin].force, own[g - in.begin].torque);
    }
}

CLX_FOR_EACH_MACHINE
static void spread_all(clast_dem *dem, block in)
{
    if (dem->sweeping.n_late > 0) {
        spread(dem, in, true);
    } else {
        spread(dem, in, false);
    }
}

static int move_and_clear(const clx_moving *c, int64_t g, int n)
{
    clx_load *load = &c->dem->near.load[g];
    const int flag = clx_move_few(c, g, n, load);
    memset(load, 0, (size_t)n * sizeof *load);
    return flag;
}

/// Grains that are not late, as many at once as there are.
static int move_block(const clx_moving *c, int64_t begin, int64_t end)
{
    const uint8_t *is_late = c->dem->sweeping.is_late;
    int flag = 0;
    int n = 0;
    for (int64_t g = begin; g < end; g += n) {
        n = clx_lanes_from(g, end);
        if (is_late[g / CLX_LANES] != 0) {
            n = CLX_LANES;
            continue;
        }
        n = n > CLX_LANES && is_late[g / CLX_LANES + 1] != 0 ? CLX_LANES : n;
        flag |= move_and_clear(c, g, n);
    }
    return flag;
}

static int sweep_block(const clx_moving *c, int64_t begin, int64_t end, int32_t worker)
{
    clast_dem *dem = c->dem;
    const int64_t room = (int64_t)worker * dem->sweeping.most;
    clx_pushed *push = dem->sweeping.push + room;
    clx_awake *awake = dem->sweeping.awake + room;
    const int32_t n =
        clx_contacts_among(dem, dem->near.begin[begin], dem->near.begin[end], push, awake);
    spread_all(dem, (block){.begin = begin, .end = end, .n = n, .awake = awake, .push = push});
    return move_block(c, begin, end);
}

static void sweep_chunks(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const clx_moving *c = context;
    const clx_sweeping *s = &c->dem->sweeping;
    for (int64_t k = begin; k < end; ++k) {
        const int64_t last = s->bound[k + 1];
        int flag = 0;
        for (int64_t g = s->bound[k]; g < last; g += BLOCK) {
            flag |= sweep_block(c, g, g + BLOCK < last ? g + BLOCK : last, worker);
        }
        c->dem->block_flag[k] = (uint8_t)flag;
    }
}

/// Late grains: what was kept for them, then their own.
static void move_late(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const clx_moving *c = context;
    clx_near *near = &c->dem->near;
    int flag = 0;
    (void)worker;
    for (int64_t f = begin; f < end; ++f) {
        const int64_t first = c->dem->sweeping.late[f];
        const int64_t left = c->dem->n_grain - first;
        const int n = left < CLX_LANES ? (int)left : CLX_LANES;
        for (int64_t g = first; g < first + n; ++g) {
            clx_load in;
            clx_load *load = &near->load[g];
            clx_move_incoming(near, g, &in);
            for (int i = 0; i < 4; ++i) {
                load->force[i] = in.force[i] + load->force[i];
                load->torque[i] = in.torque[i] + load->torque[i];
            }
        }
        flag |= move_and_clear(c, first, n);
    }
    c->dem->block_flag[begin / BLOCK] = (uint8_t)flag;
}

static int all_flags(const clast_dem *dem, int64_t n_block)
{
    int flag = 0;
    for (int64_t b = 0; b < n_block; ++b) {
        flag |= dem->block_flag[b];
    }
    return flag;
}

clast_status clx_sweep(clast_dem *dem, bool *is_fine)
{
    clast_status status = CLAST_OK;
    clx_sweeping *s = &dem->sweeping;
    clx_moving c = clx_move_begin(dem);
    if (!dem->all_round && !dem->near.is_packed) {
        CLX_TRY(clx_near_pack(dem));
    }
    const int32_t n_worker = clx_dem_is_serial(dem) ? 1 : clx_parallel_workers();
    if (s->n_worker != n_worker) {
        CLX_TRY(divide(dem, n_worker));
    }
    clx_dem_for(dem, s->n_chunk, 1, sweep_chunks, &c);
    int flag = all_flags(dem, s->n_chunk);
    if (s->n_late > 0) {
        clx_dem_for(dem, s->n_late, BLOCK, move_late, &c);
        flag |= all_flags(dem, (s->n_late + BLOCK - 1) / BLOCK);
    }
    *is_fine = clx_move_end(dem, flag);
done:
    return status;
}
