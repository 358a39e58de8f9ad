// Points over ranks: sums, small samples, keys in order.
#include "cloud/part.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "math/sort.h"
#include <clast/machine.h>
#include <clast/status.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS_A_BLOCK = 16384 };

clx_part clx_part_whole(const double *u, int64_t n, int32_t d)
{
    return (clx_part){.comm = clast_comm_one(), .u = u, .n = n, .n_all = n, .d = d};
}

clx_part clx_part_of(const clast_comm *comm, const double *u, int64_t n, int32_t d)
{
    return (clx_part){.comm = comm, .u = u, .n = n, .n_all = clx_comm_total(comm, n), .d = d};
}

typedef struct {
    const clx_part *part;
    int64_t begin;
    double *u;
} copy_context;

static void copy_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const copy_context *c = context;
    const int32_t d = c->part->d;
    double held[3];
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        const double *place = clx_part_point(c->part, c->begin + i, held);
        memcpy(c->u + i * d, place, (size_t)d * sizeof *place);
    }
}

void clx_part_copy(const clx_part *part, int64_t begin, int64_t n, double *u)
{
    copy_context c = {part, begin, u};
    CLAST_ASSERT(begin >= 0 && begin + n <= part->n);
    clx_parallel_for(n, POINTS_A_BLOCK, copy_block, &c);
}

static int by_place1(const void *a, const void *b)
{
    return clx_compare_doubles(a, b, 1);
}

static int by_place2(const void *a, const void *b)
{
    return clx_compare_doubles(a, b, 2);
}

static int by_place3(const void *a, const void *b)
{
    return clx_compare_doubles(a, b, 3);
}

/// Key in the order of the numbers; -0 is 0.
static uint64_t ordered_key(double value)
{
    const double own = value + 0.0;
    uint64_t bits = 0;
    memcpy(&bits, &own, sizeof bits);
    return (bits >> 63) != 0 ? ~bits : bits | (UINT64_C(1) << 63);
}

clast_status clx_sort_places(const double *u, int64_t n, int32_t d, double *sorted)
{
    static int (*const order[3])(const void *, const void *) = {by_place1, by_place2, by_place3};
    clast_status status = CLAST_OK;
    const size_t size = (size_t)d * sizeof *u;
    clx_keyed *entry = NULL;
    CLX_TRY(clx_alloc(&entry, n, sizeof *entry));
    for (int64_t i = 0; i < n; ++i) {
        entry[i] = (clx_keyed){ordered_key(u[i * d]), (uint64_t)i};
    }
    CLX_TRY(clx_sort_keyed(entry, n));
    for (int64_t i = 0; i < n; ++i) {
        memcpy(sorted + i * d, u + (int64_t)entry[i].item * d, size);
    }
    for (int64_t i = 0, next = 0; i < n; i = next) {
        for (next = i + 1; next < n && entry[next].key == entry[i].key; ++next) {
        }
        if (next > i + 1) {
            qsort(sorted + i * d, (size_t)(next - i), size, order[d - 1]);
        }
    }
done:
    clx_free(entry);
    return status;
}

clast_status clx_part_share(const clx_part *part, double **u)
{
    clast_status status = CLAST_OK;
    clx_gathered all = {0};
    double *made = NULL;
    double *own = NULL;
    const int64_t size = part->d * (int64_t)sizeof *made;
    if (part->u == NULL) {
        status = clx_alloc(&own, part->n * part->d, sizeof *own);
    }
    CLX_TRY(clast_comm_agree(part->comm, status, NULL));
    if (own != NULL) {
        clx_part_copy(part, 0, part->n, own);
    }
    CLX_TRY(clx_comm_share(part->comm, own != NULL ? own : part->u, part->n * size, &all));
    CLAST_ASSERT(all.n == part->n_all * size);
    status = clx_alloc(&made, part->n_all * part->d, sizeof *made);
    if (status == CLAST_OK) {
        status = clx_sort_places((const void *)all.bytes, part->n_all, part->d, made);
    }
    CLX_TRY(clast_comm_agree(part->comm, status, NULL));
    *u = made;
    made = NULL;
done:
    clx_gathered_free(&all);
    CLX_FREE(own, made);
    return status;
}

typedef struct {
    const clx_part *part;
    int32_t n_sum;
    clx_part_terms terms;
    const void *context;
    clx_exact_sum *sum; ///< [workers][n_sum]
} sum_context;

static void sum_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const sum_context *c = context;
    clx_exact_sum *own = c->sum + (int64_t)worker * c->n_sum;
    double held[3];
    for (int64_t i = begin; i < end; ++i) {
        c->terms(clx_part_point(c->part, i, held), own, c->context);
    }
}

clast_status clx_part_sum(const clx_part *part, clx_part_terms terms, const void *context,
                          int32_t n_sum, double *value)
{
    CLAST_ASSERT(n_sum >= 1 && n_sum <= CLX_PART_MOST_SUMS);
    clast_status status = CLAST_OK;
    const int32_t n_worker = clx_parallel_workers();
    sum_context c = {part, n_sum, terms, context, NULL};
    CLX_TRY(clast_comm_agree(part->comm,
                             clx_alloc(&c.sum, (int64_t)n_worker * n_sum, sizeof *c.sum), NULL));
    clx_parallel_for(part->n, POINTS_A_BLOCK, sum_block, &c);
    for (int32_t k = 0; k < n_sum; ++k) {
        for (int32_t w = 1; w < n_worker; ++w) {
            clx_exact_merge(&c.sum[k], &c.sum[w * n_sum + k]);
        }
    }
    clx_exact_over(part->comm, c.sum, n_sum);
    for (int32_t k = 0; k < n_sum; ++k) {
        value[k] = clx_exact_value(&c.sum[k]);
    }
done:
    clx_free(c.sum);
    return status;
}

/// First of the sorted keys that is at least `key`.
static int64_t first_from(const uint64_t *sorted, int64_t n, uint64_t key)
{
    int64_t begin = 0;
    int64_t end = n;
    while (begin < end) {
        const int64_t middle = begin + (end - begin) / 2;
        if (sorted[middle] < key) {
            begin = middle + 1;
        } else {
            end = middle;
        }
    }
    return begin;
}

enum { DIGIT = 4, VALUES = 1 << DIGIT };

/// Keys of all ranks' sorted ones by their numbers [m], from 0: radix selection, all at once, four
/// bits a round. `count` [m][VALUES] is room for it.
static void select_keys(const clast_comm *comm, const clx_ranked *r, const int64_t *number,
                        int32_t m, int64_t *count, uint64_t *found)
{
    CLAST_ASSERT(count != NULL && found != NULL);
    memset(found, 0, (size_t)m * sizeof *found);
    for (int shift = 64 - DIGIT; shift >= 0; shift -= DIGIT) {
        for (int32_t k = 0; k < m; ++k) { // keys below each candidate
            for (uint64_t v = 0; v < VALUES; ++v) {
                count[k * VALUES + (int64_t)v] = first_from(r->key, r->n, found[k] | v << shift);
            }
        }
        clx_comm_sum(comm, count, (int64_t)m * VALUES);
        for (int32_t k = 0; k < m; ++k) {
            uint64_t v = VALUES - 1;
            while (v > 0 && count[k * VALUES + (int64_t)v] > number[k]) {
                --v;
            }
            found[k] |= v << shift;
        }
    }
}

int64_t clx_first_of_sorted(const clast_comm *comm, uint64_t *key, int64_t n, int64_t m)
{
    const clx_ranked here = {.key = key, .n = n};
    int64_t count[VALUES];
    uint64_t limit = 0;
    select_keys(comm, &here, &m, 1, count, &limit);
    return first_from(key, n, limit);
}

/// Splits the order of all keys evenly: first[k] is the key number n_all k / n_rank. `count`
/// [n_rank][VALUES + 1] is room for it.
static void select_splitters(const clast_comm *comm, const clx_ranked *r, int64_t *count)
{
    CLAST_ASSERT(count != NULL);
    const int32_t n = comm->n_rank - 1;
    int64_t *number = count + (int64_t)n * VALUES;
    for (int32_t k = 0; k < n; ++k) {
        number[k] = r->n_all * (k + 1) / comm->n_rank;
    }
    select_keys(comm, r, number, n, count, r->first + 1);
}

/// Sorts this rank's keys, with their items where there are any.
static clast_status sort_here(clx_ranked *r)
{
    clast_status status = CLAST_OK;
    clx_keyed *entry = NULL;
    if (r->item == NULL) {
        return clx_sort_keys(r->key, r->n);
    }
    CLX_TRY(clx_alloc(&entry, r->n, sizeof *entry));
    for (int64_t i = 0; i < r->n; ++i) {
        entry[i] = (clx_keyed){r->key[i], r->item[i]};
    }
    CLX_TRY(clx_sort_keyed(entry, r->n));
    for (int64_t i = 0; i < r->n; ++i) {
        r->key[i] = entry[i].key;
        r->item[i] = entry[i].item;
    }
done:
    clx_free(entry);
    return status;
}

/// Replaces an array by what comes from all ranks, n_out bytes of it to each.
static clast_status swap_array(const clast_comm *comm, const int64_t *n_out, uint64_t **array,
                               int64_t *n)
{
    clast_status status = CLAST_OK;
    clx_gathered in = {0};
    CLX_TRY(clx_comm_exchange(comm, *array, n_out, &in));
    clx_free(*array);
    *array = (void *)in.bytes; // from clx_alloc: aligned for any type
    *n = in.n / (int64_t)sizeof **array;
done:
    return status;
}

/// Keys to the ranks that own their stretch.
static clast_status hand_over(const clast_comm *comm, clx_ranked *r)
{
    clast_status status = CLAST_OK;
    int64_t *n_out = NULL;
    int64_t n = 0;
    const int64_t size = (int64_t)sizeof *r->key;
    CLX_TRY(clast_comm_agree(comm, clx_alloc(&n_out, comm->n_rank, sizeof *n_out), NULL));
    int64_t at = 0;
    for (int32_t k = 0; k < comm->n_rank; ++k) {
        const int64_t next =
            k + 1 < comm->n_rank ? first_from(r->key, r->n, r->first[k + 1]) : r->n;
        n_out[k] = (next - at) * size;
        at = next;
    }
    CLX_TRY(swap_array(comm, n_out, &r->key, &n));
    if (r->item != NULL) {
        CLX_TRY(swap_array(comm, n_out, &r->item, &n));
    }
    r->n = n;
    CLX_TRY(clast_comm_agree(comm, sort_here(r), NULL));
done:
    clx_free(n_out);
    return status;
}

/// Sorts what `made` has over the ranks, by stretches of their own or those that it has.
static clast_status sort_over(const clast_comm *comm, uint64_t limit, const clx_ranked *leader,
                              clx_ranked *made)
{
    clast_status status = CLAST_OK;
    const int32_t n_rank = comm->n_rank;
    int64_t *count = NULL;
    status = clx_alloc(&made->first, (int64_t)n_rank + 1, sizeof *made->first);
    if (status == CLAST_OK) {
        status = clx_alloc(&count, (int64_t)n_rank * (VALUES + 1), sizeof *count);
    }
    if (status == CLAST_OK) {
        status = sort_here(made);
    }
    CLX_TRY(clast_comm_agree(comm, status, NULL));
    made->n_all = clx_comm_total(comm, made->n);
    if (leader != NULL) {
        memcpy(made->first, leader->first, ((size_t)n_rank + 1) * sizeof *made->first);
    } else if (n_rank > 1 && made->n_all > 0) {
        select_splitters(comm, made, count);
    }
    if (n_rank > 1 && made->n_all > 0) {
        CLX_TRY(hand_over(comm, made));
    }
    made->first[n_rank] = limit;
    CLX_TRY(clx_comm_before(comm, made->n, &made->before, &made->n_all));
done:
    clx_free(count);
    return status;
}

clast_status clx_ranked_sort_items(const clast_comm *comm, uint64_t **key, uint64_t **item,
                                   int64_t n, uint64_t limit, clx_ranked *ranked)
{
    clx_ranked made = {.key = *key, .item = *item, .n = n};
    *key = NULL;
    *item = NULL;
    const clast_status status = sort_over(comm, limit, NULL, &made);
    if (status == CLAST_OK) {
        *ranked = made;
    } else {
        clx_ranked_free(&made);
    }
    return status;
}

clast_status clx_ranked_sort(const clast_comm *comm, uint64_t **key, int64_t n, uint64_t limit,
                             clx_ranked *ranked)
{
    uint64_t *none = NULL;
    return clx_ranked_sort_items(comm, key, &none, n, limit, ranked);
}

clast_status clx_ranked_follow(const clast_comm *comm, uint64_t **key, int64_t n,
                               const clx_ranked *leader, clx_ranked *ranked)
{
    clx_ranked made = {.key = *key, .n = n};
    *key = NULL;
    const clast_status status = sort_over(comm, leader->first[comm->n_rank], leader, &made);
    if (status == CLAST_OK) {
        *ranked = made;
    } else {
        clx_ranked_free(&made);
    }
    return status;
}

clast_status clx_ranked_of_sorted(uint64_t **key, int64_t n, uint64_t limit, clx_ranked *ranked)
{
    clx_ranked made = {.key = *key, .n = n, .n_all = n};
    const clast_status status = clx_alloc(&made.first, 2, sizeof *made.first);
    *key = NULL;
    if (status == CLAST_OK) {
        made.first[1] = limit;
        *ranked = made;
    } else {
        clx_ranked_free(&made);
    }
    return status;
}

int64_t clx_ranked_from(const clx_ranked *ranked, uint64_t key)
{
    return first_from(ranked->key, ranked->n, key);
}

int64_t clx_ranked_run(const clx_ranked *ranked, int64_t begin, int64_t end, int shift)
{
    CLAST_ASSERT(begin < end && end <= ranked->n && shift >= 0 && shift < 64);
    const uint64_t *key = ranked->key;
    const uint64_t run = key[begin] >> shift;
    int64_t last = begin; // in the run
    int64_t step = 1;
    while (last + step < end && key[last + step] >> shift == run) {
        last += step;
        step *= 2;
    }
    for (step /= 2; step > 0; step /= 2) {
        last += last + step < end && key[last + step] >> shift == run ? step : 0;
    }
    return last + 1;
}

void clx_ranked_free(clx_ranked *ranked)
{
    CLX_FREE(ranked->key, ranked->item, ranked->first);
    *ranked = (clx_ranked){0};
}
