#pragma once
// Items handed out to ranks one by one, so that ranks with short items do more of them.
//
// Rank 0 keeps the list and answers the others between its own work: whoever waits for something
// else calls clx_queue_serve now and then. A stop asked for on any rank reaches all. With one rank
// nothing is sent.
#include "base/status.h"

/// Whose items they are. Called on rank 0 only.
typedef struct clx_queue_owner {
    /// True when the item is still to be done. NULL: all are.
    bool (*is_open)(void *context, int64_t item);
    /// An item has ended on some rank, with a code of the caller's. NULL: nobody wants to know.
    void (*ended)(void *context, int64_t item, int64_t code);
    void *context;
} clx_queue_owner;

typedef struct clx_queue {
    const clast_comm *comm;
    clx_queue_owner owner;
    int64_t n;        ///< items 0 .. n - 1
    int64_t next;     ///< rank 0: the first that nobody has
    int64_t given;    ///< other ranks: the item that came and was not taken, or -1
    int32_t n_left;   ///< rank 0: ranks that have left
    bool is_waiting;  ///< other ranks: asked, no answer yet
    bool is_empty;    ///< nothing more will come
    bool is_stopping; ///< some rank asked all to stop
    bool may_leave;   ///< other ranks: rank 0 has no more for this one
} clx_queue;

CLX_SHARED clx_queue clx_queue_begin(const clast_comm *comm, int64_t n, clx_queue_owner owner);

/// The next item of this rank into *item: true; the first item is always rank 0's. False when none
/// has come yet, or, by is_empty or is_stopping, none will.
CLX_SHARED bool clx_queue_next(clx_queue *queue, int64_t *item);

/// Tells rank 0 that an item of this rank has ended.
CLX_SHARED void clx_queue_end(clx_queue *queue, int64_t item, int64_t code);

/// Deals with what has come from other ranks.
CLX_SHARED void clx_queue_serve(clx_queue *queue);

/// Asks all ranks to stop.
CLX_SHARED void clx_queue_stop(clx_queue *queue);

/// Waits until every rank has left; each must call it, whatever became of its items.
///
/// @param asks_stop  asked while waiting: true stops all; may be NULL
CLX_SHARED void clx_queue_leave(clx_queue *queue, bool (*asks_stop)(void *context), void *context);

/// A short sleep, for a rank that waits for others.
CLX_SHARED void clx_queue_rest(void);
