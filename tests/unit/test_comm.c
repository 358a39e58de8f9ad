// Unit: what ranks agree on, gather and hand out.
#include "ranks.h"
#include "support.h"

#include "base/alloc.h"
#include "base/comm.h"
#include "base/queue.h"
#include <string.h>

static const int32_t counts[] = {1, 2, 4};

static int agree_on_the_first_failure(const clast_comm *comm, void *context)
{
    (void)context;
    RANK_CHECK(clast_comm_agree(comm, CLAST_OK, NULL) == CLAST_OK);
    // Ranks 1 and 3 fail, rank 0 was stopped: rank 1 is heard everywhere.
    const clast_status own = comm->rank == 1   ? CLAST_E_DISK
                             : comm->rank == 3 ? CLAST_E_MEMORY
                             : comm->rank == 0 ? CLAST_E_STOPPED
                                               : CLAST_OK;
    const char *text = comm->rank == 1 ? "no room" : "something else";
    const clast_status all = clast_comm_agree(comm, own, text);
    RANK_CHECK(all == (comm->n_rank == 1 ? CLAST_E_STOPPED : CLAST_E_DISK));
    RANK_CHECK(comm->n_rank == 1 || strcmp(clast_error_detail(), "rank 1: no room") == 0);
    const clast_status stopped = clast_comm_agree(
        comm, comm->rank == comm->n_rank - 1 ? CLAST_E_STOPPED : CLAST_OK, "stopped");
    RANK_CHECK(stopped == CLAST_E_STOPPED);
    return 0;
}

static void ranks_agree_on_the_first_failure(void **state)
{
    (void)state;
    for (size_t i = 0; i < 3; ++i) {
        support_run_ranks(counts[i], agree_on_the_first_failure, NULL);
    }
}

/// Rank k sends k + 1 times 50,000 bytes to each rank up to it.
static int exchange_pieces(const clast_comm *comm, void *context)
{
    (void)context;
    enum { PIECE = 50000 };
    int64_t n_out[8] = {0};
    int64_t n = 0;
    clx_gathered in = {0};
    char *out = NULL;
    for (int32_t to = 0; to <= comm->rank; ++to) {
        n_out[to] = (int64_t)PIECE * (comm->rank + 1);
        n += n_out[to];
    }
    RANK_CHECK(clx_alloc(&out, n, 1) == CLAST_OK);
    memset(out, comm->rank, (size_t)n);
    RANK_CHECK(clx_comm_exchange(comm, out, n_out, &in) == CLAST_OK);
    int64_t at = 0;
    for (int32_t from = comm->rank; from < comm->n_rank; ++from) {
        for (int64_t i = 0; i < (int64_t)PIECE * (from + 1); ++i, ++at) {
            RANK_CHECK(in.bytes[at] == (char)from);
        }
    }
    RANK_CHECK(in.n == at);
    clx_gathered_free(&in);
    clx_free(out);
    return 0;
}

/// Sums, what came before, the least number, and bytes that all give to all.
static int reduce_numbers(const clast_comm *comm, void *context)
{
    (void)context;
    const int32_t n = comm->n_rank;
    const int32_t k = comm->rank;
    int64_t value[3] = {1, k, INT64_C(-5000000000) * k};
    int64_t before = 0;
    int64_t total = 0;
    clx_gathered all = {0};
    clx_comm_sum(comm, value, 3);
    RANK_CHECK(value[0] == n && value[1] == n * (n - 1) / 2);
    RANK_CHECK(value[2] == INT64_C(-5000000000) * (n * (n - 1) / 2));
    RANK_CHECK(clx_comm_before(comm, 10 + k, &before, &total) == CLAST_OK);
    RANK_CHECK(before == 10 * k + k * (k - 1) / 2 && total == 10 * n + n * (n - 1) / 2);
    RANK_CHECK(clx_comm_least(comm, 0.5 - k) == 1.5 - n); // negative numbers too
    RANK_CHECK(clx_comm_least(comm, -0.0) == 0.0);
    RANK_CHECK(clx_comm_share(comm, &k, (int64_t)sizeof k, &all) == CLAST_OK);
    RANK_CHECK(all.n == n * (int64_t)sizeof k);
    for (int32_t i = 0; i < n; ++i) {
        RANK_CHECK(memcmp(all.bytes + (size_t)i * sizeof i, &i, sizeof i) == 0);
    }
    clx_gathered_free(&all);
    return 0;
}

static void ranks_add_and_exchange(void **state)
{
    (void)state;
    for (size_t i = 0; i < 3; ++i) {
        support_run_ranks(counts[i], exchange_pieces, NULL);
        support_run_ranks(counts[i], reduce_numbers, NULL);
    }
}

/// Rank k gives k pieces of 100,000 bytes, all of them k.
static int gather_pieces(const clast_comm *comm, void *context)
{
    (void)context;
    enum { PIECE = 100000 };
    clx_gathered all = {0};
    char *own = NULL;
    const int64_t n = (int64_t)comm->rank * PIECE;
    RANK_CHECK(clx_alloc(&own, n, 1) == CLAST_OK);
    memset(own, comm->rank, (size_t)n);
    RANK_CHECK(clx_comm_gather(comm, own, n, &all) == CLAST_OK);
    int64_t at = 0;
    for (int32_t k = 0; comm->rank == 0 && k < comm->n_rank; ++k) {
        for (int64_t i = 0; i < (int64_t)k * PIECE; ++i, ++at) {
            RANK_CHECK(all.bytes[at] == (char)k);
        }
    }
    RANK_CHECK(all.n == at);
    clx_gathered_free(&all);
    clx_free(own);
    return 0;
}

static void pieces_come_in_the_order_of_ranks(void **state)
{
    (void)state;
    for (size_t i = 0; i < 3; ++i) {
        support_run_ranks(counts[i], gather_pieces, NULL);
    }
}

enum { ITEMS = 60 };

typedef struct {
    int32_t done_by[ITEMS]; ///< rank + 1
    int32_t times[ITEMS];
    int64_t code[ITEMS]; ///< as rank 0 heard
    int64_t stop_at;     ///< the rank that gets this item asks for a stop; -1: none
} ledger;

static bool is_open(void *context, int64_t item)
{
    (void)context;
    return item % 7 != 3;
}

static void note(void *context, int64_t item, int64_t code)
{
    ledger *l = context;
    l->code[item] = code;
}

static int do_items(const clast_comm *comm, void *context)
{
    ledger *l = context;
    clx_queue queue = clx_queue_begin(comm, ITEMS, (clx_queue_owner){is_open, note, l});
    while (!queue.is_empty && !queue.is_stopping) {
        int64_t item = -1;
        if (!clx_queue_next(&queue, &item)) {
            clx_queue_rest();
            continue;
        }
        l->done_by[item] = comm->rank + 1;
        ++l->times[item];
        clx_queue_rest();
        clx_queue_end(&queue, item, 1000 + item);
        if (item == l->stop_at) {
            clx_queue_stop(&queue);
        }
        clx_queue_serve(&queue);
    }
    clx_queue_leave(&queue, NULL, NULL);
    RANK_CHECK(queue.is_stopping == (l->stop_at >= 0));
    // Nothing is left on its way to disturb the next queue.
    int32_t from = 0;
    int64_t word[CLAST_COMM_WORDS];
    RANK_CHECK(clast_comm_agree(comm, CLAST_OK, NULL) == CLAST_OK);
    RANK_CHECK(!comm->take(comm->context, &from, word));
    return 0;
}

static void every_open_item_is_done_once(void **state)
{
    (void)state;
    for (size_t i = 0; i < 3; ++i) {
        ledger *l = support_shared_memory(sizeof *l);
        l->stop_at = -1;
        support_run_ranks(counts[i], do_items, l);
        int32_t by_others = 0;
        for (int32_t k = 0; k < ITEMS; ++k) {
            assert_int_equal(l->times[k], k % 7 != 3);
            assert_int_equal(l->code[k], k % 7 != 3 ? 1000 + k : 0);
            by_others += l->done_by[k] > 1;
        }
        assert_int_equal(l->done_by[0], 1);
        assert_true(counts[i] == 1 || by_others > 0);
    }
}

static void a_stop_reaches_every_rank(void **state)
{
    (void)state;
    for (size_t i = 0; i < 3; ++i) {
        for (int64_t at = 0; at < 6; at += 5) { // rank 0's own item, and one of anybody
            ledger *l = support_shared_memory(sizeof *l);
            l->stop_at = at;
            support_run_ranks(counts[i], do_items, l);
            assert_int_equal(l->times[ITEMS - 1], 0);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ranks_agree_on_the_first_failure),
        cmocka_unit_test(ranks_add_and_exchange),
        cmocka_unit_test(pieces_come_in_the_order_of_ranks),
        cmocka_unit_test(every_open_item_is_done_once),
        cmocka_unit_test(a_stop_reaches_every_rank),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
