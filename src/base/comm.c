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

static void broadcast_alone(void *context, int32_t root, void *bytes, int64_t n)
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

static void keep_sum(void *context, int64_t *value, int64_t n)
{
    (void)context;
    (void)value;
    (void)n;
}

static void keep_bytes(void *context, const void *out, const int64_t *n_out, void *in,
                       const int64_t *n_in)
{
    (void)context;
    (void)n_in;
    CLAST_ASSERT(n_out[0] == n_in[0]);
    if (n_out[0] > 0) {
        memcpy(in, out, (size_t)n_out[0]);
    }
}

const clast_comm *clast_comm_one(void)
{
    static const clast_comm one = {.rank = 0,
                                   .n_rank = 1,
                                   .send = send_nowhere,
                                   .take = take_nothing,
                                   .least = own,
                                   .broadcast = broadcast_alone,
                                   .gather = copy,
                                   .sum = keep_sum,
                                   .exchange = keep_bytes};
    return &one;
}

const clast_comm *clx_comm_or_one(const clast_comm *comm)
{
    return comm != NULL ? comm : clast_comm_one();
}

/// Whether a text names its rank already: what failed is agreed on again further out.
static bool names_rank(const char *text)
{
    static const char word[] = "rank ";
    const size_t n = sizeof word - 1;
    const size_t n_digit = strncmp(text, word, n) == 0 ? strspn(text + n, "0123456789") : 0;
    return n_digit > 0 && text[n + n_digit] == ':';
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
    // what fails on the first rank fails on all alike, but for files: each has its own disk
    const bool is_file = word.status == CLAST_E_IO || word.status == CLAST_E_DISK;
    if ((who == 0 && !is_file) || word.text[0] == '\0' || word.status == CLAST_E_STOPPED ||
        names_rank(word.text)) {
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

bool clx_comm_has_sums(const clast_comm *comm)
{
    return comm->n_rank == 1 || (comm->sum != NULL && comm->exchange != NULL);
}

void clx_comm_sum(const clast_comm *comm, int64_t *value, int64_t n)
{
    CLAST_ASSERT(n >= 0);
    if (comm->n_rank > 1 && n > 0) {
        comm->sum(comm->context, value, n);
    }
}

int64_t clx_comm_total(const clast_comm *comm, int64_t value)
{
    clx_comm_sum(comm, &value, 1);
    return value;
}

clast_status clx_comm_before(const clast_comm *comm, int64_t value, int64_t *before, int64_t *total)
{
    clast_status status = CLAST_OK;
    int64_t *each = NULL;
    CLX_TRY(clast_comm_agree(comm, clx_alloc(&each, comm->n_rank, sizeof *each), NULL));
    each[comm->rank] = value;
    clx_comm_sum(comm, each, comm->n_rank);
    *before = 0;
    *total = 0;
    for (int32_t k = 0; k < comm->n_rank; ++k) {
        *before += k < comm->rank ? each[k] : 0;
        *total += each[k];
    }
done:
    clx_free(each);
    return status;
}

double clx_comm_least(const clast_comm *comm, double value)
{
    int64_t bits = 0;
    CLAST_ASSERT(value == value);
    memcpy(&bits, &value, sizeof bits);
    bits = bits < 0 ? INT64_MIN - bits : bits; // the order of doubles; -0 is 0
    bits = comm->least(comm->context, bits);
    bits = bits < 0 ? INT64_MIN - bits : bits;
    memcpy(&value, &bits, sizeof bits);
    return value;
}

bool clx_comm_is_same(const clast_comm *comm, int64_t value)
{
    const int64_t least = comm->least(comm->context, value);
    return least == -comm->least(comm->context, -value);
}

clast_status clx_comm_exchange(const clast_comm *comm, const void *out, const int64_t *n_out,
                               clx_gathered *in)
{
    CLAST_ASSERT(in->bytes == NULL);
    clast_status status = CLAST_OK;
    const int32_t n_rank = comm->n_rank;
    int64_t *n_in = NULL; // [2 n_rank]: bytes from each, then those of such a number
    clx_gathered made = {0};
    CLX_TRY(clast_comm_agree(comm, clx_alloc(&n_in, INT64_C(2) * n_rank, sizeof *n_in), NULL));
    int64_t *word = n_in + n_rank;
    for (int32_t k = 0; k < n_rank; ++k) {
        word[k] = (int64_t)sizeof *n_in;
    }
    comm->exchange(comm->context, n_out, word, n_in, word);
    for (int32_t k = 0; k < n_rank; ++k) {
        made.n += n_in[k];
    }
    CLX_TRY(clast_comm_agree(comm, clx_alloc(&made.bytes, made.n, 1), NULL));
    comm->exchange(comm->context, out, n_out, made.bytes, n_in);
    *in = made;
    made = (clx_gathered){0};
done:
    clx_gathered_free(&made);
    clx_free(n_in);
    return status;
}

clast_status clx_comm_first(const clast_comm *comm, const void *bytes, int64_t n,
                            clx_gathered *first)
{
    CLAST_ASSERT(n >= 0 && first->bytes == NULL);
    clast_status status = CLAST_OK;
    clx_gathered made = {.n = n};
    comm->broadcast(comm->context, 0, &made.n, (int64_t)sizeof made.n);
    CLX_TRY(clast_comm_agree(comm, clx_alloc(&made.bytes, made.n, 1), NULL));
    if (comm->rank == 0 && n > 0) {
        memcpy(made.bytes, bytes, (size_t)n);
    }
    comm->broadcast(comm->context, 0, made.bytes, made.n);
    *first = made;
    made = (clx_gathered){0};
done:
    clx_gathered_free(&made);
    return status;
}

clast_status clx_comm_share(const clast_comm *comm, const void *bytes, int64_t n, clx_gathered *all)
{
    clast_status status = CLAST_OK;
    clx_gathered made = {0};
    CLX_TRY(clx_comm_gather(comm, bytes, n, &made));
    if (comm->n_rank > 1) {
        comm->broadcast(comm->context, 0, &made.n, (int64_t)sizeof made.n);
        if (comm->rank > 0) {
            status = clx_alloc(&made.bytes, made.n, 1);
        }
        CLX_TRY(clast_comm_agree(comm, status, NULL));
        comm->broadcast(comm->context, 0, made.bytes, made.n);
    }
    *all = made;
    made = (clx_gathered){0};
done:
    clx_gathered_free(&made);
    return status;
}
