// Random order over ranks: a point's key is a hash of the point and the seed; copies of a point are
// numbered, whichever is which, so that each is drawn for itself. [docs/theory/cloud-ranks.md]
#include "cloud/shuffle.h"

#include "base/alloc.h"
#include "cloud/part.h"
#include "cloud/place_hash.h"
#include "math/sort.h"
#include <clast/machine.h>

enum { MOST_WIDTH = 5 }; ///< numbers of a point: position, weight, variable

typedef struct {
    const clast_comm *comm;
    const clast_cloud *cloud;
    int32_t width;
    int64_t *n_out; ///< [n_rank] bytes to each
    int64_t *at;    ///< [n_rank]
    double *out;    ///< points by the rank they go to
} shuffling;

void clx_shuffled_free(clx_shuffled *shuffled)
{
    clast_cloud_free(&shuffled->cloud);
    clx_free(shuffled->key);
    *shuffled = (clx_shuffled){0};
}

static int32_t width_of(const clast_cloud *cloud)
{
    return cloud->dimension + (cloud->weight != NULL ? 1 : 0) + (cloud->variable != NULL ? 1 : 0);
}

/// All that is known of point i; returns the hash.
static uint64_t read_point(const shuffling *s, int64_t i, double *point)
{
    const clast_cloud *cloud = s->cloud;
    int32_t k = 0;
    for (; k < cloud->dimension; ++k) {
        point[k] = cloud->x[i * cloud->dimension + k];
    }
    if (cloud->weight != NULL) {
        point[k++] = cloud->weight[i];
    }
    if (cloud->variable != NULL) {
        point[k++] = cloud->variable[i];
    }
    CLAST_ASSERT(k == s->width && k <= MOST_WIDTH);
    return clx_place_hash(point, k);
}

static int32_t rank_of(const shuffling *s, uint64_t hash)
{
    return (int32_t)(hash % (uint64_t)s->comm->n_rank);
}

/// Puts the points one behind the other, rank by rank.
static clast_status pack(shuffling *s)
{
    clast_status status = CLAST_OK;
    const int32_t n_rank = s->comm->n_rank;
    double point[MOST_WIDTH] = {0};
    int64_t n = 0;
    CLX_TRY(clx_alloc(&s->n_out, n_rank, sizeof *s->n_out));
    CLX_TRY(clx_alloc(&s->at, n_rank, sizeof *s->at));
    CLX_TRY(clx_alloc(&s->out, s->cloud->n * s->width, sizeof *s->out));
    for (int64_t i = 0; i < s->cloud->n; ++i) {
        ++s->at[rank_of(s, read_point(s, i, point))];
    }
    for (int32_t k = 0; k < n_rank; ++k) {
        const int64_t here = s->at[k];
        s->n_out[k] = here * s->width * (int64_t)sizeof *s->out;
        s->at[k] = n;
        n += here;
    }
    for (int64_t i = 0; i < s->cloud->n; ++i) {
        const int64_t at = s->at[rank_of(s, read_point(s, i, point))]++;
        memcpy(s->out + at * s->width, point, (size_t)s->width * sizeof *point);
    }
done:
    return status;
}

/// Keys of the points [n][width], in their order.
static clast_status find_order(const double *point, int64_t n, int32_t width, uint64_t seed,
                               clx_keyed **order)
{
    clast_status status = CLAST_OK;
    clx_keyed *made = NULL;
    CLX_TRY(clx_alloc(&made, n, sizeof *made));
    for (int64_t i = 0; i < n; ++i) {
        made[i] = (clx_keyed){clx_place_hash(point + i * width, width), (uint64_t)i};
    }
    CLX_TRY(clx_sort_keyed(made, n));
    uint64_t hash = 0;
    uint64_t copy = 0;
    for (int64_t i = 0; i < n; ++i) {
        copy = i > 0 && made[i].key == hash ? copy + 1 : 0;
        hash = made[i].key;
        made[i].key = clx_mix(clx_mix(clx_mix(seed) ^ copy) ^ hash);
    }
    CLX_TRY(clx_sort_keyed(made, n));
    *order = made;
    made = NULL;
done:
    clx_free(made);
    return status;
}

/// The points [n][width] that came, as a cloud in the order of their keys.
static clast_status unpack(const shuffling *s, const double *point, int64_t n, uint64_t seed,
                           clx_shuffled *made)
{
    clast_status status = CLAST_OK;
    const int32_t d = s->cloud->dimension;
    clast_cloud *cloud = &made->cloud;
    clx_keyed *order = NULL;
    CLX_TRY(find_order(point, n, s->width, seed, &order));
    CLX_TRY(clx_alloc(&made->key, n, sizeof *made->key));
    CLX_TRY(clast_cloud_alloc(n, d, cloud));
    if (s->cloud->weight != NULL) {
        CLX_TRY(clx_alloc(&cloud->weight, n, sizeof *cloud->weight));
    }
    if (s->cloud->variable != NULL) {
        CLX_TRY(clx_alloc(&cloud->variable, n, sizeof *cloud->variable));
    }
    for (int64_t i = 0; i < n; ++i) {
        const double *own = point + (int64_t)order[i].item * s->width;
        made->key[i] = order[i].key;
        memcpy(cloud->x + i * d, own, (size_t)d * sizeof *own);
        if (cloud->weight != NULL) {
            cloud->weight[i] = own[d];
        }
        if (cloud->variable != NULL) {
            cloud->variable[i] = own[s->width - 1];
        }
    }
done:
    clx_free(order);
    return status;
}

clast_status clx_shuffle(const clast_comm *comm, const clast_cloud *cloud, uint64_t seed,
                         clx_shuffled *shuffled)
{
    clast_status status = CLAST_OK;
    shuffling s = {.comm = comm, .cloud = cloud, .width = width_of(cloud)};
    clx_gathered in = {0};
    clx_shuffled made = {.comm = comm, .n_all = clx_comm_total(comm, cloud->n)};
    CLX_TRY(clast_comm_agree(comm, pack(&s), NULL));
    CLX_TRY(clx_comm_exchange(comm, s.out, s.n_out, &in));
    clx_free(s.out);
    s.out = NULL;
    const int64_t n = in.n / (s.width * (int64_t)sizeof *s.out);
    status = unpack(&s, (const void *)in.bytes, n, seed, &made); // from clx_alloc: aligned
    CLX_TRY(clast_comm_agree(comm, status, NULL));
    *shuffled = made;
    made = (clx_shuffled){0};
done:
    clx_gathered_free(&in);
    CLX_FREE(s.n_out, s.at, s.out);
    clx_shuffled_free(&made);
    return status;
}

int64_t clx_shuffled_first(const clx_shuffled *s, int64_t m)
{
    CLAST_ASSERT(m >= 0 && m <= s->n_all);
    return m < s->n_all ? clx_first_of_sorted(s->comm, s->key, s->cloud.n, m) : s->cloud.n;
}
