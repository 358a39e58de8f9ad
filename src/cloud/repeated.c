// Points that repeat the place of another: places meet on the rank that their hash names, some at a
// time, so that memory does not grow with the cloud.
#include "cloud/repeated.h"

#include "base/alloc.h"
#include "base/comm.h"
#include "cloud/contract.h"
#include "cloud/place_hash.h"
#include "math/sort.h"

#include <clast/cloud.h>
#include <clast/machine.h>
#include <clast/status.h>
#include <math.h>
#include <string.h>

enum { AT_ONCE = 1 << 22 }; ///< points of a rank that are compared in one round

typedef struct {
    const clast_comm *comm;
    const clast_cloud *cloud;
    int64_t n_round;
    int64_t *n_out; ///< [n_rank] bytes to each
    int64_t *at;    ///< [n_rank]
    double *out;    ///< points of a round, by the rank they go to
} search;

/// Which round a place belongs to, and the rank that compares it.
static int64_t round_of(const search *s, uint64_t hash)
{
    return (int64_t)((hash >> 32) % (uint64_t)s->n_round);
}

static int32_t rank_of(const search *s, uint64_t hash)
{
    return (int32_t)((hash & 0xffffffffu) % (uint64_t)s->comm->n_rank);
}

/// Puts the points of a round one behind the other, rank by rank.
static clast_status pack(search *s, int64_t round)
{
    clast_status status = CLAST_OK;
    const int32_t d = s->cloud->dimension;
    int64_t n = 0;
    CLAST_ASSERT(s->at != NULL && s->n_out != NULL);
    memset(s->at, 0, (size_t)s->comm->n_rank * sizeof *s->at);
    for (int64_t i = 0; i < s->cloud->n; ++i) {
        const uint64_t hash = clx_place_hash(s->cloud->x + i * d, d);
        s->at[rank_of(s, hash)] += round_of(s, hash) == round ? 1 : 0;
    }
    for (int32_t k = 0; k < s->comm->n_rank; ++k) {
        const int64_t here = s->at[k];
        s->n_out[k] = here * d * (int64_t)sizeof *s->out;
        s->at[k] = n;
        n += here;
    }
    clx_free(s->out);
    s->out = NULL;
    CLX_TRY(clx_alloc(&s->out, n * d, sizeof *s->out));
    for (int64_t i = 0; i < s->cloud->n; ++i) {
        const double *x = s->cloud->x + i * d;
        const uint64_t hash = clx_place_hash(x, d);
        if (round_of(s, hash) == round) {
            memcpy(s->out + s->at[rank_of(s, hash)]++ * d, x, (size_t)d * sizeof *x);
        }
    }
done:
    return status;
}

static bool are_equal(const double *a, const double *b, int32_t d)
{
    bool equal = true;
    for (int32_t j = 0; j < d; ++j) {
        equal = equal && a[j] == b[j];
    }
    return equal;
}

/// Points of x [n][d] that repeat the place of one before.
static clast_status count(const double *x, int64_t n, int32_t d, int64_t *n_repeated)
{
    clast_status status = CLAST_OK;
    clx_keyed *entry = NULL;
    int64_t first = 0;
    CLX_TRY(clx_alloc(&entry, n, sizeof *entry));
    for (int64_t i = 0; i < n; ++i) {
        entry[i] = (clx_keyed){clx_place_hash(x + i * d, d), (uint64_t)i};
    }
    CLX_TRY(clx_sort_keyed(entry, n));
    for (int64_t i = 1; i < n; ++i) {
        first = entry[i].key == entry[first].key ? first : i;
        *n_repeated += first < i && are_equal(x + (int64_t)entry[first].item * d,
                                              x + (int64_t)entry[i].item * d, d);
    }
done:
    clx_free(entry);
    return status;
}

static clast_status one_round(search *s, int64_t round, int64_t *n_repeated)
{
    clast_status status = CLAST_OK;
    const int32_t d = s->cloud->dimension;
    clx_gathered in = {0};
    CLX_TRY(clast_comm_agree(s->comm, pack(s, round), NULL));
    CLX_TRY(clx_comm_exchange(s->comm, s->out, s->n_out, &in));
    status = count((void *)in.bytes, in.n / (d * (int64_t)sizeof(double)), d, n_repeated);
    CLX_TRY(clast_comm_agree(s->comm, status, NULL));
done:
    clx_gathered_free(&in);
    return status;
}

clast_status clast_cloud_repeated_ranks(const clast_cloud *cloud, const clast_comm *comm,
                                        int64_t *n_repeated)
{
    CLX_ARGUMENTS(cloud, n_repeated);
    clast_status status = CLAST_OK;
    search s = {.comm = clx_comm_or_one(comm), .cloud = cloud};
    int64_t n = 0;
    CLX_NEED(n_repeated);
    CLX_CHECK(clx_comm_has_sums(s.comm), CLAST_E_ARGUMENT, "comm has no sum or no exchange");
    status = clx_cloud_check(cloud);
    if (status == CLAST_OK) {
        status = clx_alloc(&s.n_out, s.comm->n_rank, sizeof *s.n_out);
    }
    if (status == CLAST_OK) {
        status = clx_alloc(&s.at, s.comm->n_rank, sizeof *s.at);
    }
    CLX_TRY(clast_comm_agree(s.comm, status, NULL));
    const int64_t most = -s.comm->least(s.comm->context, -cloud->n);
    s.n_round = most / AT_ONCE + 1;
    for (int64_t round = 0; round < s.n_round; ++round) {
        CLX_TRY(one_round(&s, round, &n));
    }
    *n_repeated = clx_comm_total(s.comm, n);
done:
    CLX_FREE(s.n_out, s.at, s.out);
    return status;
}

clast_status clast_cloud_repeated(const clast_cloud *cloud, int64_t *n_repeated)
{
    return clast_cloud_repeated_ranks(cloud, NULL, n_repeated);
}

const char *clx_repeated_text(int64_t n_repeated)
{
    return n_repeated > 0 ? "so many points are duplicates (coincident points), where no density "
                            "is defined; leave copies out"
                          : "points lie closer together than cells of this domain can resolve";
}

clast_status clx_repeated_check(const clast_decomposition *found, const clast_cloud *cloud,
                                const char *of)
{
    clast_status status = CLAST_OK;
    int64_t n_repeated = 0;
    if (!isnan(found->events_low)) {
        return CLAST_OK;
    }
    CLX_TRY(clast_cloud_repeated(cloud, &n_repeated));
    status =
        clx_fail(CLAST_E_FORMAT, "%s: no number of events: %s", of, clx_repeated_text(n_repeated));
done:
    return status;
}
