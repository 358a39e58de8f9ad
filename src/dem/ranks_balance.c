// Which rank moves which grain: recursive coordinate bisection by counted cost, or the partition of
// the ranks' table (Zoltan). No result depends on it.
#include "dem/ranks.h"

#include "base/alloc.h"
#include <clast/machine.h>
#include <clast/status.h>
#include <stdlib.h>
#include <string.h>

/// Grains [begin, end) of the sites that ranks [first, last) share.
typedef struct {
    int64_t begin, end;
    int32_t first, last;
} part;

/// Work of a step, as in chunk.c: moving a grain, a listed pair, a touching pair.
enum { MOVE = 5, LISTED = 1, TOUCH = 12 };

void clx_ranks_weigh(clast_dem *whole)
{
    clx_ranks *r = whole->ranks;
    clast_dem *local = r->local;
    for (int32_t g = 0; g < local->n_grain; ++g) {
        r->cost[r->number[g]] = MOVE;
    }
    for (int64_t k = 0; k < local->list.n_pair; ++k) {
        const clx_dem_pair *pair = &local->list.pair[k];
        const int32_t a = clx_item_grain(local, pair->a);
        const double cost = LISTED + TOUCH * (double)pair->touches;
        const bool is_others = r->is_ghost[a] != 0;
        r->cost[r->number[is_others ? clx_item_grain(local, pair->b) : a]] += cost;
    }
}

#define COMPARE(axis)                                                                              \
    static int by_##axis(const void *left, const void *right)                                      \
    {                                                                                              \
        const clast_site *a = left;                                                                \
        const clast_site *b = right;                                                               \
        return a->position[axis] != b->position[axis]                                              \
                   ? (a->position[axis] > b->position[axis]) -                                     \
                         (a->position[axis] < b->position[axis])                                   \
                   : (a->number > b->number) - (a->number < b->number);                            \
    }
COMPARE(0)
COMPARE(1)
COMPARE(2)

static int longest_axis(const clast_site *s, int64_t n)
{
    CLAST_ASSERT(n >= 1);
    int best = 0;
    double most = -1.0;
    for (int c = 0; c < 3; ++c) {
        double low = s[0].position[c];
        double high = low;
        for (int64_t i = 1; i < n; ++i) {
            low = s[i].position[c] < low ? s[i].position[c] : low;
            high = s[i].position[c] > high ? s[i].position[c] : high;
        }
        if (high - low > most) {
            most = high - low;
            best = c;
        }
    }
    return best;
}

/// Cuts a part in two across its longest axis; every rank gets a grain while there are enough.
static int64_t cut(clast_site *s, const part *p)
{
    static int (*const order[3])(const void *, const void *) = {by_0, by_1, by_2};
    const int64_t n = p->end - p->begin;
    const int32_t ranks = p->last - p->first;
    const int32_t low_ranks = ranks / 2;
    double all = 0.0;
    double sum = 0.0;
    int64_t k = 0;
    qsort(s + p->begin, (size_t)n, sizeof *s, order[longest_axis(s + p->begin, n)]);
    for (int64_t i = p->begin; i < p->end; ++i) {
        all += s[i].cost;
    }
    while (k < n && sum + 0.5 * s[p->begin + k].cost < all * low_ranks / ranks) {
        sum += s[p->begin + k++].cost;
    }
    const int64_t most = n - (ranks - low_ranks);
    k = k > most ? most : k;
    k = k < low_ranks ? low_ranks : k;
    return p->begin + (k < n ? k : n);
}

/// Recursive coordinate bisection of all sites. [Berger1987]
static void bisect(clast_site *s, int64_t n, int32_t n_rank, int32_t *to)
{
    enum { DEPTH = 64 };
    part stack[DEPTH] = {{0, n, 0, n_rank}};
    int depth = 1;
    while (depth > 0) {
        const part p = stack[--depth];
        if (p.last - p.first == 1) {
            for (int64_t i = p.begin; i < p.end; ++i) {
                to[s[i].number] = p.first;
            }
        } else if (p.begin < p.end) {
            const int64_t middle = cut(s, &p);
            const int32_t rank = p.first + (p.last - p.first) / 2;
            stack[depth++] = (part){middle, p.end, rank, p.last};
            stack[depth++] = (part){p.begin, middle, p.first, rank};
        }
        CLAST_ASSERT(depth < DEPTH);
    }
}

/// Greatest over mean cost of the ranks.
static double imbalance(const clast_dem *whole, const int32_t *owner, int32_t n, double *sum)
{
    const clx_ranks *r = whole->ranks;
    CLAST_ASSERT(sum != NULL);
    double all = 0.0;
    double most = 0.0;
    memset(sum, 0, (size_t)r->comm->n_rank * sizeof *sum);
    for (int32_t i = 0; i < n; ++i) {
        sum[owner[i]] += r->cost[i];
        all += r->cost[i];
    }
    for (int32_t k = 0; k < r->comm->n_rank; ++k) {
        most = sum[k] > most ? sum[k] : most;
    }
    return all > 0.0 ? most * r->comm->n_rank / all : 1.0;
}

/// The partition of the ranks' table: each gives the sites of its own grains, the first rank those
/// that nobody has yet.
static clast_status partition_together(clast_dem *whole, const clast_site *all, bool *is_fine)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    const clast_comm *comm = r->comm;
    clast_site *own = NULL;
    int32_t *to = NULL;
    int64_t *sum = NULL;
    int64_t n = 0;
    status = clx_alloc(&own, whole->n_grain, sizeof *own);
    status = status == CLAST_OK ? clx_alloc(&to, whole->n_grain, sizeof *to) : status;
    status = status == CLAST_OK ? clx_alloc(&sum, whole->n_grain, sizeof *sum) : status;
    CLX_TRY(clast_comm_agree(comm, status, NULL));
    CLAST_ASSERT(own != NULL && to != NULL && sum != NULL); // on this rank too
    for (int32_t i = 0; i < whole->n_grain; ++i) {
        if (r->owner[i] == comm->rank) {
            own[n++] = all[i];
        }
    }
    *is_fine = comm->partition(comm->context, n, own, to);
    for (int64_t i = 0; i < n; ++i) {
        sum[own[i].number] = to[i];
    }
    clx_comm_sum(comm, sum, whole->n_grain);
    for (int32_t i = 0; i < whole->n_grain; ++i) {
        CLAST_ASSERT(!*is_fine || (sum[i] >= 0 && sum[i] < comm->n_rank));
        r->next[i] = (int32_t)sum[i];
    }
done:
    CLX_FREE(own, to, sum);
    return status;
}

clast_status clx_ranks_partition(clast_dem *whole)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    clast_site *s = NULL;
    double *sum = NULL;
    bool is_done = false;
    status = clx_alloc(&s, whole->n_grain, sizeof *s);
    status = status == CLAST_OK ? clx_alloc(&sum, r->comm->n_rank, sizeof *sum) : status;
    CLX_TRY(clast_comm_agree(r->comm, status, NULL));
    CLAST_ASSERT(s != NULL && sum != NULL); // on this rank too
    for (int32_t i = 0; i < whole->n_grain; ++i) {
        const double *x = whole->grain[i].position;
        s[i] = (clast_site){.number = i};
        r->cost[i] = r->cost[i] > 0.0 ? r->cost[i] : MOVE;
        s[i].cost = r->cost[i];
        for (int c = 0; c < 3; ++c) {
            const double period = c < 2 ? whole->period[c] : 0.0;
            s[i].position[c] = period > 0.0 ? x[c] - period * floor(x[c] / period + 0.5) : x[c];
        }
    }
    r->counts.before = imbalance(whole, r->owner, r->n_synced, sum);
    if (r->comm->partition != NULL) {
        CLX_TRY(partition_together(whole, s, &is_done));
    }
    if (!is_done) {
        bisect(s, whole->n_grain, r->comm->n_rank, r->next);
    }
    r->counts.is_zoltan = is_done;
    r->counts.imbalance = imbalance(whole, r->next, whole->n_grain, sum);
    ++r->counts.n_balance;
done:
    CLX_FREE(s, sum);
    return status;
}
