// Items for ranks. Every rank but the first speaks with rank 0 alone:
//
//   k -> 0  ASK, ENDED item code, STOP, LEAVE      0 -> k  GIVE item (-1: none), STOP, FAREWELL
//
// LEAVE is the last message of k, FAREWELL the last to k, so nothing is on its way afterwards.
#include "base/queue.h"

#include <clast/machine.h>
#include <time.h>

enum { ASK = 1, GIVE, ENDED, STOP, LEAVE, FAREWELL };

static void send(const clx_queue *q, int32_t to, int64_t kind, int64_t item, int64_t code)
{
    const int64_t word[CLAST_COMM_WORDS] = {kind, item, code};
    q->comm->send(q->comm->context, to, word);
}

clx_queue clx_queue_begin(const clast_comm *comm, int64_t n, clx_queue_owner owner)
{
    CLAST_ASSERT(comm->rank >= 0 && comm->rank < comm->n_rank);
    return (clx_queue){.comm = comm, .owner = owner, .n = n, .given = -1, .is_empty = n <= 0};
}

/// Rank 0: the next open item, or -1.
static int64_t next_open(clx_queue *q)
{
    CLAST_ASSERT(q->comm->rank == 0 && q->next >= 0);
    while (q->next < q->n && q->owner.is_open != NULL &&
           !q->owner.is_open(q->owner.context, q->next)) {
        ++q->next;
    }
    if (q->next >= q->n) {
        q->is_empty = true;
        return -1;
    }
    return q->next++;
}

static void note_end(clx_queue *q, int64_t item, int64_t code)
{
    if (q->owner.ended != NULL) {
        q->owner.ended(q->owner.context, item, code);
    }
}

/// Rank 0 passes a stop on; a rank that has left meanwhile gets it before its farewell.
static void stop_all(clx_queue *q)
{
    for (int32_t k = 1; !q->is_stopping && k < q->comm->n_rank; ++k) {
        send(q, k, STOP, 0, 0);
    }
    q->is_stopping = true;
}

static void serve_first(clx_queue *q, int32_t from, const int64_t word[CLAST_COMM_WORDS])
{
    CLAST_ASSERT(from > 0 && from < q->comm->n_rank);
    switch (word[0]) {
    case ASK:
        send(q, from, GIVE, q->is_stopping ? -1 : next_open(q), 0);
        break;
    case ENDED:
        note_end(q, word[1], word[2]);
        break;
    case STOP:
        stop_all(q);
        break;
    default:
        ++q->n_left; // LEAVE: the farewell comes when all have, so that a stop never comes after it
        break;
    }
}

static void serve_other(clx_queue *q, const int64_t word[CLAST_COMM_WORDS])
{
    switch (word[0]) {
    case GIVE:
        q->is_waiting = false;
        q->given = word[1];
        q->is_empty = word[1] < 0;
        break;
    case STOP:
        q->is_stopping = true;
        break;
    default:
        q->may_leave = true;
        break;
    }
}

void clx_queue_serve(clx_queue *q)
{
    int32_t from = 0;
    int64_t word[CLAST_COMM_WORDS];
    while (q->comm->n_rank > 1 && !q->may_leave && q->comm->take(q->comm->context, &from, word)) {
        if (q->comm->rank == 0) {
            serve_first(q, from, word);
        } else {
            serve_other(q, word);
        }
    }
}

bool clx_queue_next(clx_queue *q, int64_t *item)
{
    if (q->comm->rank == 0 && !q->is_stopping && !q->is_empty) {
        *item = next_open(q); // before any other rank's, so that the first item is rank 0's
        clx_queue_serve(q);
        return *item >= 0;
    }
    clx_queue_serve(q);
    if (q->comm->rank == 0 || q->is_stopping || (q->is_empty && q->given < 0)) {
        return false;
    }
    if (q->given < 0 && !q->is_waiting) {
        send(q, 0, ASK, 0, 0);
        q->is_waiting = true;
    }
    *item = q->given;
    q->given = -1;
    return *item >= 0;
}

void clx_queue_end(clx_queue *q, int64_t item, int64_t code)
{
    CLAST_ASSERT(item >= 0 && item < q->n);
    if (q->comm->rank == 0) {
        note_end(q, item, code);
    } else {
        send(q, 0, ENDED, item, code);
    }
}

void clx_queue_stop(clx_queue *q)
{
    if (q->comm->rank == 0) {
        stop_all(q);
    } else if (!q->is_stopping) {
        send(q, 0, STOP, 0, 0);
        q->is_stopping = true;
    }
}

void clx_queue_rest(void)
{
    const struct timespec pause = {0, 1000000};
    (void)nanosleep(&pause, NULL);
}

void clx_queue_leave(clx_queue *q, bool (*asks_stop)(void *context), void *context)
{
    const int32_t n_other = q->comm->n_rank - 1;
    if (q->comm->rank > 0) {
        send(q, 0, LEAVE, 0, 0);
    }
    clx_queue_serve(q);
    while (q->comm->rank == 0 ? q->n_left < n_other : !q->may_leave) {
        if (q->comm->rank == 0 && !q->is_stopping && asks_stop != NULL && asks_stop(context)) {
            stop_all(q);
        }
        clx_queue_rest();
        clx_queue_serve(q);
    }
    for (int32_t k = 1; q->comm->rank == 0 && k <= n_other; ++k) {
        send(q, k, FAREWELL, 0, 0);
    }
}
