#pragma once
// Points of the unit cube, of which each rank has a part: they stay there. What is needed of all of
// them is counted, added without rounding, or sorted as keys, so that no result depends on which
// rank has which point, nor on their order. [docs/theory/cloud-ranks.md]
#include "base/comm.h"
#include "math/exact_sum.h"

/// Makes the place [d] of point i.
typedef void (*clx_part_make)(const void *context, int64_t i, double *place);

/// One rank's points. Functions that take a part are called by all ranks; what fails on one fails
/// on all.
typedef struct clx_part {
    const clast_comm *comm; ///< borrowed
    const double *u;        ///< [n][d], borrowed; NULL: places are made when they are asked for
    int64_t n, n_all;       ///< points here, and on all ranks
    int32_t d;
    clx_part_make make; ///< where u is NULL
    const void *context;
} clx_part;

/// Place [d] of point i: one of u, or made in `held`.
static inline const double *clx_part_point(const clx_part *part, int64_t i, double held[3])
{
    if (part->u != NULL) {
        return part->u + i * part->d;
    }
    part->make(part->context, i, held);
    return held;
}

/// Copies the places of n points from `begin` on, with threads.
void clx_part_copy(const clx_part *part, int64_t begin, int64_t n, double *u);

/// The only rank's points.
clx_part clx_part_whole(const double *u, int64_t n, int32_t d);

/// The points of this rank beside those of the others.
clx_part clx_part_of(const clast_comm *comm, const double *u, int64_t n, int32_t d);

/// Points [n][d] by their first coordinate, those with one in common by the others.
clast_status clx_sort_places(const double *u, int64_t n, int32_t d, double *sorted);

/// All ranks' points on every rank, sorted by coordinates: for so few that it costs nothing.
clast_status clx_part_share(const clx_part *part, double **u);

/// Adds the terms of point i [d] to sums of its own.
typedef void (*clx_part_terms)(const double *point, clx_exact_sum *sum, const void *context);

/// Sums [n_sum] over the points of all ranks: `value` of each, on every rank.
clast_status clx_part_sum(const clx_part *part, clx_part_terms terms, const void *context,
                          int32_t n_sum, double *value);

enum { CLX_PART_MOST_SUMS = 16 };

/// All ranks' keys in ascending order, a stretch of them on each rank.
typedef struct clx_ranked {
    uint64_t *key;   ///< [n] ascending
    uint64_t *item;  ///< [n] what came with each key, equal keys in any order; or NULL
    int64_t n;       ///< here
    int64_t before;  ///< on the ranks before
    int64_t n_all;   ///< on all of them
    uint64_t *first; ///< [n_rank + 1] rank k has the keys first[k] .. first[k + 1] - 1; first[0]
                     ///< is 0, the last the limit. A rank k > 0 whose stretch of keys is not
                     ///< empty begins with a key that is there
} clx_ranked;

/// Sorts keys below `limit` over the ranks; equal ones end on one rank.
///
/// @param key  [n] from clx_alloc; *key is taken over (NULL afterwards), also on failure
clast_status clx_ranked_sort(const clast_comm *comm, uint64_t **key, int64_t n, uint64_t limit,
                             clx_ranked *ranked);

/// The same of keys with an item each, which is taken over too.
clast_status clx_ranked_sort_items(const clast_comm *comm, uint64_t **key, uint64_t **item,
                                   int64_t n, uint64_t limit, clx_ranked *ranked);

/// The same of keys that go to the ranks that have these stretches already.
clast_status clx_ranked_follow(const clast_comm *comm, uint64_t **key, int64_t n,
                               const clx_ranked *leader, clx_ranked *ranked);

/// The same of keys that are in order already and all here.
clast_status clx_ranked_of_sorted(uint64_t **key, int64_t n, uint64_t limit, clx_ranked *ranked);

/// How many of this rank's sorted keys [n] are among the first m of all ranks', m below their
/// number; of keys equal to number m, from 0, none is.
int64_t clx_first_of_sorted(const clast_comm *comm, uint64_t *key, int64_t n, int64_t m);

/// First of this rank's keys that is at least `key`: its place.
int64_t clx_ranked_from(const clx_ranked *ranked, uint64_t key);

/// Where the run of keys ends that begins here and agrees in the bits above `shift`.
int64_t clx_ranked_run(const clx_ranked *ranked, int64_t begin, int64_t end, int shift);
void clx_ranked_free(clx_ranked *ranked);
