// The one-rank table, and agreement between ranks.
#include "base/comm.h"

#include "base/alloc.h"
#include <clast/machine.h>
#include <stdio.h>
#include <string.h>

static void send_nowhere(void *context, int32_t to, const int64_t word[CLAST_COMM_WORDS])
{
    (void)context;
    (void)to;
    (void)word;
    CLAST_ASSERT(false); // there is nobody to send to
}

static bool take_nothing(void *context, int32_t *from, int64_t word[CLAST_COMM_WORDS])
{
    (void)context;
    (void)from;
    (void)word;
    return false;
}

static int64_t own(void *context, int64_t value)
{
    (void)context;
    return value;
}

static void keep(void *context, int32_t root, void *bytes, int64_t n)
{
    (void)context;
    (void)root;
    (void)bytes;
    (void)n;
}

static void copy(void *context, const void *bytes, int64_t n, const int64_t *count, void *all)
{
    (void)context;
    (void)count;
    if (n > 0) {
        memcpy(all, bytes, (size_t)n);
    }
}

const clast_comm *clast_comm_one(void)
{
    static const clast_comm one = {.rank = 0,
                                   .n_rank = 1,
                                   .send = send_nowhere,
                                   .take = take_nothing,
                                   .least = own,
                                   .broadcast = keep,
                                   .gather = copy};
    return &one;
}

const clast_comm *clx_comm_or_one(const clast_comm *comm)
{
    return comm != NULL ? comm : clast_comm_one();
}

clast_status clast_comm_agree(const clast_comm *comm, clast_status status, const char *text)
{
    struct {
        int64_t status;
        char text[1000];
    } word = {.status = status};
    if (comm == NULL || comm->n_rank == 1) {
        return status;
    }
    if (comm->n_rank < 1 || comm->least == NULL || comm->broadcast == NULL) {
        return clx_fail(CLAST_E_ARGUMENT, "%s: comm has %d ranks, or a function is NULL", __func__,
                        comm->n_rank);
    }
    // Lowest first: ranks that failed, ranks that were stopped, all is well.
    const int64_t group = status == CLAST_OK ? 2 : status == CLAST_E_STOPPED ? 1 : 0;
    const int64_t least = comm->least(comm->context, group * comm->n_rank + comm->rank);
    if (least >= INT64_C(2) * comm->n_rank) {
        return CLAST_OK;
    }
    const int32_t who = (int32_t)(least % comm->n_rank);
    if (who == comm->rank) {
        (void)snprintf(word.text, sizeof word.text, "%s",
                       text != NULL ? text : clast_error_detail());
    }
    comm->broadcast(comm->context, who, &word, (int64_t)sizeof word);
    if (who == 0 || word.text[0] == '\0' || word.status == CLAST_E_STOPPED) {
        return clx_fail((clast_status)word.status, "%s", word.text);
    }
    return clx_fail((clast_status)word.status, "rank %d: %s", (int)who, word.text);
}

void clx_gathered_free(clx_gathered *all)
{
    clx_free(all->bytes);
    *all = (clx_gathered){0};
}

clast_status clx_comm_gather(const clast_comm *comm, const void *bytes, int64_t n,
                             clx_gathered *all)
{
    CLAST_ASSERT(comm->rank >= 0 && comm->rank < comm->n_rank);
    CLAST_ASSERT(n >= 0 && all->bytes == NULL);
    clast_status status = CLAST_OK;
    const bool is_first = comm->rank == 0;
    int64_t *each = NULL; // [2 n_rank]: 8 bytes of each, then their number of bytes
    clx_gathered made = {0};
    if (is_first) {
        status = clx_alloc(&each, INT64_C(2) * comm->n_rank, sizeof *each);
    }
    CLX_TRY(clast_comm_agree(comm, status, NULL));
    for (int32_t i = 0; is_first && i < comm->n_rank; ++i) {
        each[i] = (int64_t)sizeof n;
    }
    comm->gather(comm->context, &n, (int64_t)sizeof n, each, is_first ? each + comm->n_rank : NULL);
    for (int32_t i = 0; is_first && i < comm->n_rank; ++i) {
        made.n += each[comm->n_rank + i];
    }
    if (is_first) {
        status = clx_alloc(&made.bytes, made.n, 1);
    }
    CLX_TRY(clast_comm_agree(comm, status, NULL));
    comm->gather(comm->context, bytes, n, is_first ? each + comm->n_rank : NULL, made.bytes);
    *all = made;
    made = (clx_gathered){0};
done:
    clx_gathered_free(&made);
    clx_free(each);
    return status;
}
