// A cell of many kinds, partitioned at random into blocks again and again, with the few particles
// that collide most (collectors) meeting the whole cell. [docs/theory/agglomeration.md section 2]
#include "cloud/collide.h"

#include "base/status.h"
#include "cloud/box.h"
#include "cloud/kernel_range.h"
#include <math.h>

static const double MIXING = 0.1; ///< collisions a particle makes on average between two partitions
/// Collisions of any one particle between two partitions, over the particles of its block: a
/// particle that used up its block would find no partners while the other blocks are full.
static const double BLOCK_SHARE = 1.0 / 256.0;
static const double LEAST_SHARE = 0.5; ///< collisions that even in a small block are no reason

enum { IS_COLLECTOR = -2, LEAST_REFRESH = 64 };

/// State of a cell between two partitions: members [0, n) are in blocks, [n, n + n_collector) are
/// not.
typedef struct {
    clx_block *cell;
    int64_t *n_kind; ///< [n_block] kinds of the blocks
    int64_t n, n_collector, n_block;
    int64_t parity; ///< of the blocks that evolve before the collectors do
    double left;
} partition;

void clx_block_shuffle(int64_t *item, int64_t n, clx_rng *rng)
{
    CLAST_ASSERT(n >= 0);
    for (int64_t i = n - 1; i > 0; --i) {
        const int64_t j = clx_rng_below(rng, i + 1);
        const int64_t held = item[i];
        item[i] = item[j];
        item[j] = held;
    }
}

/// Block k of the partition: of its m particles each meets m - 1 others at (n - 1) / (m - 1) times
/// the rate, so that its expected number of collisions stays.
static clx_block block_of(const partition *d, int64_t k)
{
    CLAST_ASSERT(k >= 0 && k < d->n_block);
    const int64_t begin = d->n * k / d->n_block;
    clx_block b = *d->cell;
    b.flows = false; // between two partitions
    b.member += begin;
    b.frozen += begin;
    b.kind += begin;
    b.n = d->n * (k + 1) / d->n_block - begin;
    b.n_kind = d->n_kind[k];
    b.rate_factor = b.n > 1 ? (double)(d->n - 1) / (double)(b.n - 1) : 1.0;
    b.scale *= b.rate_factor;
    b.n_event = 0;
    b.n_real = 0.0;
    b.range = (clast_range_use){0};
    return b;
}

/// Partitions anew and sums all rates; returns the mean rate of a particle and the busiest one's.
static void partition_anew(partition *d, double *mean, double *busiest)
{
    double total = 0.0;
    *busiest = 0.0;
    d->n_block = (d->n + d->cell->config->block - 1) / d->cell->config->block;
    clx_block_shuffle(d->cell->member, d->n, d->cell->rng);
    for (int64_t k = 0; k < d->n_block; ++k) {
        clx_block b = block_of(d, k);
        (void)clx_block_sort(&b, b.n);
        d->n_kind[k] = b.n_kind;
        total += b.scale * clx_block_rates(&b);
        for (int64_t s = 0; s < b.n_kind; ++s) {
            *busiest = fmax(*busiest, b.scale * b.kind[s].row);
        }
    }
    *mean = d->n > 0 ? total / (double)d->n : 0.0;
}

static double most_collisions(const partition *d)
{
    return fmax(LEAST_SHARE, BLOCK_SHARE * (double)d->n / (double)d->n_block);
}

/// Marks the particles of rates above `limit`; returns how many.
static int64_t mark_collectors(const partition *d, double limit)
{
    int64_t n = 0;
    for (int64_t k = 0; k < d->n_block; ++k) {
        const clx_block b = block_of(d, k);
        for (int64_t s = 0; s < b.n_kind; ++s) {
            int64_t i = b.kind[s].head;
            for (int64_t m = 0; m < b.kind[s].n && b.scale * b.kind[s].row > limit; ++m) {
                const int64_t next = b.next[i];
                b.next[i] = IS_COLLECTOR;
                i = next;
                ++n;
            }
        }
    }
    return n;
}

/// Takes marked particles out of the blocks.
static void move_marked(partition *d)
{
    int64_t *member = d->cell->member;
    for (int64_t m = d->n - 1; m >= 0; --m) {
        if (d->cell->next[member[m]] == IS_COLLECTOR) {
            const int64_t held = member[m];
            member[m] = member[--d->n];
            member[d->n] = held;
            ++d->n_collector;
        }
    }
}

/// Partitions until no particle is too busy for its block; returns the time until the next
/// partition.
static double partition_until_even(partition *d)
{
    for (;;) {
        double mean = 0.0;
        double busiest = 0.0;
        partition_anew(d, &mean, &busiest);
        const double delta = mean * d->left > MIXING ? MIXING / mean : d->left;
        const double most = most_collisions(d);
        if (d->n_block < 2 || busiest * delta <= most) {
            return delta;
        }
        if (d->n_collector < d->cell->config->block) {
            if (mark_collectors(d, most / delta) > 0) {
                move_marked(d);
            }
        } else { // the cell has too many: partition more often
            return most / busiest;
        }
    }
}

static void drop_dead(partition *d)
{
    const int64_t *monomers = d->cell->population->monomers;
    int64_t *member = d->cell->member;
    int64_t part[2] = {0, 0};
    int64_t n_member_left = 0;
    for (int64_t m = 0; m < d->n + d->n_collector; ++m) {
        if (monomers[member[m]] > 0) {
            ++part[m < d->n ? 0 : 1];
            member[n_member_left++] = member[m];
        }
    }
    d->n = part[0];
    d->n_collector = part[1];
}

static void evolve_blocks(partition *d, int64_t parity, bool is_stale, double delta)
{
    for (int64_t k = 0; k < d->n_block; ++k) {
        clx_block b = block_of(d, k);
        if (k % 2 != parity || b.n < 2) {
            continue;
        }
        if (is_stale) { // collectors have met some of its particles
            clx_block_drop_dead(&b);
            (void)clx_block_sort(&b, b.n);
            (void)clx_block_rates(&b);
        }
        clx_block_evolve(&b, delta);
        d->cell->n_event += b.n_event;
        d->cell->n_real += b.n_real;
        clx_range_merge(&d->cell->range, &b.range);
    }
}

/// Rate of a collector with all others, over scale: pairs of two collectors count half in each row.
static double collector_row(const partition *d, int64_t c)
{
    CLAST_ASSERT(c >= d->n && c < d->n + d->n_collector);
    const clx_block *b = d->cell;
    const int64_t n_all = d->n + d->n_collector;
    double row = 0.5 * clx_block_self_rate(b, &b->kind[c]);
    for (int64_t m = 0; m < n_all; ++m) {
        if (m != c && b->kind[m].n > 0) {
            row += (m < d->n ? 1.0 : 0.5) * clx_block_kernel(b, &b->kind[c], &b->kind[m]);
        }
    }
    return row;
}

/// Every particle as a kind of its own, and the rows of the collectors.
static void list_all(partition *d)
{
    clx_block *b = d->cell;
    for (int64_t m = 0; m < d->n + d->n_collector; ++m) {
        b->kind[m] = clx_block_as_seen(b, b->member[m]);
        b->kind[m].n = b->population->monomers[b->member[m]] > 0 ? 1 : 0;
    }
    for (int64_t c = d->n; c < d->n + d->n_collector; ++c) {
        b->kind[c].row = b->kind[c].n > 0 ? collector_row(d, c) : 0.0;
    }
}

static double collectors_total(const partition *d)
{
    double total = 0.0;
    for (int64_t c = d->n; c < d->n + d->n_collector; ++c) {
        total += d->cell->kind[c].row;
    }
    return total;
}

/// The member that a collector meets; its own number for a collision within its parcel, -1 when
/// rounding left none.
static int64_t pick_partner(const partition *d, int64_t c)
{
    const clx_block *b = d->cell;
    const double within = 0.5 * clx_block_self_rate(b, &b->kind[c]);
    double at = clx_rng_uniform(b->rng) * b->kind[c].row - within;
    int64_t last = within > 0.0 ? c : -1;
    for (int64_t m = 0; m < d->n + d->n_collector && at >= 0.0; ++m) {
        const double share = m < d->n ? 1.0 : 0.5;
        const double chance = m != c && b->kind[m].n > 0
                                  ? share * clx_block_kernel(b, &b->kind[c], &b->kind[m])
                                  : 0.0;
        if (chance > 0.0) {
            last = m;
            at -= chance;
        }
    }
    return last;
}

static int64_t pick_collector(const partition *d, double total)
{
    double at = clx_rng_uniform(d->cell->rng) * total;
    int64_t last = -1;
    for (int64_t c = d->n; c < d->n + d->n_collector; ++c) {
        if (d->cell->kind[c].row > 0.0) {
            last = c;
            at -= d->cell->kind[c].row;
            if (at < 0.0) {
                break;
            }
        }
    }
    return last;
}

/// Adds `sign` times a member to the rows of the collectors, but of `skip` [2].
static void shift_rows(partition *d, int64_t m, double sign, const int64_t skip[2])
{
    clx_block *b = d->cell;
    const double share = m < d->n ? sign : 0.5 * sign;
    for (int64_t c = d->n; c < d->n + d->n_collector; ++c) {
        if (c != skip[0] && c != skip[1] && b->kind[c].n > 0 && b->kind[m].n > 0) {
            const double row =
                b->kind[c].row + share * clx_block_kernel(b, &b->kind[c], &b->kind[m]);
            b->kind[c].row = fmax(0.0, row);
        }
    }
}

/// A collision of the collector in slot c with the member in slot m (c itself: within its parcel).
/// Where the partner is the heavier one, it takes the collector's slot.
static void meet(partition *d, int64_t c, int64_t m)
{
    clx_block *b = d->cell;
    clast_population *p = b->population;
    const int64_t slot[2] = {c, m};
    const int n_slot = c == m ? 1 : 2;
    for (int k = 0; k < n_slot; ++k) {
        shift_rows(d, slot[k], -1.0, slot);
    }
    int64_t live[2];
    (void)clx_block_stick(b, b->member[c], b->member[m], live);
    if (p->monomers[b->member[c]] == 0) {
        const int64_t held = b->member[c];
        b->member[c] = b->member[m];
        b->member[m] = held;
    }
    for (int k = 0; k < n_slot; ++k) {
        b->kind[slot[k]] = clx_block_as_seen(b, b->member[slot[k]]);
        b->kind[slot[k]].n = p->monomers[b->member[slot[k]]] > 0 ? 1 : 0;
    }
    for (int k = 0; k < n_slot; ++k) {
        shift_rows(d, slot[k], 1.0, slot);
        if (slot[k] >= d->n) {
            b->kind[slot[k]].row = b->kind[slot[k]].n > 0 ? collector_row(d, slot[k]) : 0.0;
        }
    }
    ++b->n_event;
}

/// Collectors meet the whole cell, next event by next event.
static void evolve_collectors(partition *d, double delta)
{
    double time = 0.0;
    int64_t since = 0;
    list_all(d);
    for (;;) {
        const double total = collectors_total(d);
        if (!(total > 0.0)) {
            break;
        }
        time -= log(clx_rng_uniform(d->cell->rng)) / (d->cell->scale * total);
        const int64_t c = time <= delta ? pick_collector(d, total) : -1;
        const int64_t m = c >= 0 ? pick_partner(d, c) : -1;
        if (m < 0) {
            break;
        }
        if (d->cell->box != NULL) {
            d->cell->box->now = d->cell->box->time + time;
        }
        meet(d, c, m);
        if (++since >= d->n_collector + LEAST_REFRESH) { // rows drift by rounding
            list_all(d);
            since = 0;
        }
    }
}

/// Shortens the time to the next partition so that collectors take a tenth of the cell at most.
static double bound_by_collectors(partition *d, double delta)
{
    list_all(d);
    const double rate = d->cell->scale * collectors_total(d);
    const double most = MIXING * (double)(d->n + d->n_collector);
    return rate * delta > most ? most / rate : delta;
}

/// Collisions for a time after a partition: half of the blocks evolve before the collectors and
/// half after, so that the error of the splitting is of second order in delta.
static void evolve_partition(partition *d, bool is_stale, double delta)
{
    evolve_blocks(d, d->parity, is_stale, delta);
    if (d->n_collector > 0) {
        evolve_collectors(d, delta);
    }
    evolve_blocks(d, 1 - d->parity, is_stale, delta);
    drop_dead(d);
    d->parity = 1 - d->parity;
}

/// Partitions; returns the time until the next partition.
static double next_partition(partition *d, bool *is_stale)
{
    const double delta = partition_until_even(d);
    *is_stale = d->n_collector > 0; // they overwrite the kinds of the blocks
    return *is_stale ? bound_by_collectors(d, delta) : delta;
}

static void collide_only(partition *d)
{
    while (d->left > 0.0 && d->n + d->n_collector > 1) {
        bool is_stale = false;
        const double delta = next_partition(d, &is_stale);
        evolve_partition(d, is_stale, delta);
        d->left -= delta;
        if (d->cell->box != NULL) {
            d->cell->box->time += delta;
        }
    }
}

/// Particles settle, break and come in between two partitions.
static void flow(partition *d, double delta)
{
    clx_block *cell = d->cell;
    cell->n = d->n + d->n_collector;
    clx_box_flow(cell, delta);
    d->n = cell->n;
    d->n_collector = 0;
    d->n_kind = cell->box->n_kind;
    cell->box->time += delta;
}

/// Half of the collisions of a time delta, all else, the other half of the collisions with the
/// first half of the next delta: the error is of second order.
static void collide_and_flow(partition *d)
{
    clx_box *box = d->cell->box;
    double owed = 0.0; // collisions still to come
    while (d->left > 0.0 && box->status == CLAST_OK) {
        bool is_stale = false;
        double delta = next_partition(d, &is_stale);
        d->cell->n = d->n + d->n_collector;
        delta = fmin(delta, clx_box_bound(d->cell, MIXING));
        evolve_partition(d, is_stale, owed + 0.5 * delta);
        flow(d, delta);
        owed = 0.5 * delta;
        d->left -= delta;
    }
    d->left = box->status == CLAST_OK ? owed : 0.0;
    box->time -= owed;
    collide_only(d);
}

void clx_block_evolve_partitioned(clx_block *cell, int64_t *n_kind, double dt)
{
    partition d = {.cell = cell, .n_kind = n_kind, .n = cell->n, .left = dt};
    cell->rate_factor = 1.0;
    if (cell->flows) {
        collide_and_flow(&d);
    } else {
        collide_only(&d);
    }
}
