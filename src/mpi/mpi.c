// clast_comm over MPI 3.1.
//
// Ranks of clast wait for microseconds in the steps of a bed, and for minutes between whole runs,
// so no call waits inside of MPI: everything is begun without blocking and asked after, first at
// once, then with the processor yielded, at last with naps. So ranks may be more than cores, and a
// rank that waits long costs no core. MPI's own errors end the job, as is MPI's default.
#include <clast/mpi.h>

#include "base/status.h"
#include "mpi/zoltan.h"
#include <clast/machine.h>

#include <mpi.h>
#include <sched.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { TAG = 1, SLOT = 64 };

/// Questions at once; then for how long the processor is yielded between two [s].
enum { SPIN = 200 };
static const double YIELD_FOR = 0.02;

/// Messages on their way out, and the communicator.
typedef struct {
    MPI_Comm comm;
    int32_t next; ///< slot to use, in turn
    MPI_Request request[SLOT];
    int64_t word[SLOT][CLAST_COMM_WORDS];
    int32_t rank, n_rank;
    MPI_Request *each;  ///< [2 n_rank] of an exchange
    const char *method; ///< of partitions, Zoltan's name
    bool has_begun;     ///< MPI, which ends with it
} ranks;

/// Seconds of a clock that only goes on.
static double now(void)
{
    struct timespec t = {0};
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/// Waits for requests: asks at once, then yields, then naps a millisecond between two questions.
static void await_all(int n, MPI_Request *request)
{
    const struct timespec nap = {0, 1000000};
    int done = 0;
    double begun = 0.0;
    for (int tries = 0;; ++tries) {
        (void)MPI_Testall(n, request, &done, MPI_STATUSES_IGNORE);
        if (done) {
            return;
        }
        if (tries < SPIN) {
            continue;
        }
        begun = tries == SPIN ? now() : begun;
        if (now() - begun < YIELD_FOR) {
            (void)sched_yield();
        } else {
            (void)nanosleep(&nap, NULL);
        }
    }
}

static void await(MPI_Request *request)
{
    await_all(1, request);
}

// NOLINTBEGIN(clang-analyzer-optin.mpi.MPI-Checker): it knows MPI_Wait, not the tests in await()

static void send(void *context, int32_t to, const int64_t word[CLAST_COMM_WORDS])
{
    ranks *r = context;
    const int32_t k = r->next;
    r->next = (k + 1) % SLOT;
    await(&r->request[k]); // its message of a round ago; MPI_REQUEST_NULL is done
    memcpy(r->word[k], word, sizeof r->word[k]);
    MPI_Request request; // of its own: clang-tidy 14 crashes on an element of an array here
    (void)MPI_Isend(r->word[k], CLAST_COMM_WORDS, MPI_INT64_T, to, TAG, r->comm, &request);
    r->request[k] = request;
}

static bool receive_words(void *context, int32_t *from, int64_t word[CLAST_COMM_WORDS])
{
    const ranks *r = context;
    MPI_Status status;
    int found = 0;
    (void)MPI_Iprobe(MPI_ANY_SOURCE, TAG, r->comm, &found, &status);
    if (!found) {
        return false;
    }
    *from = status.MPI_SOURCE;
    (void)MPI_Recv(word, CLAST_COMM_WORDS, MPI_INT64_T, *from, TAG, r->comm, MPI_STATUS_IGNORE);
    return true;
}

static int64_t least(void *context, int64_t value)
{
    const ranks *r = context;
    int64_t found = value;
    MPI_Request request;
    (void)MPI_Iallreduce(&value, &found, 1, MPI_INT64_T, MPI_MIN, r->comm, &request);
    await(&request);
    return found;
}

/// MPI counts with int: longer texts go in pieces.
enum { PIECE = 1 << 30 };

static int piece_at(int64_t n, int64_t at)
{
    return (int)(n - at < PIECE ? n - at : PIECE);
}

static void broadcast(void *context, int32_t root, void *bytes, int64_t n)
{
    const ranks *r = context;
    for (int64_t at = 0; at < n; at += PIECE) {
        MPI_Request request;
        (void)MPI_Ibcast((char *)bytes + at, piece_at(n, at), MPI_BYTE, root, r->comm, &request);
        await(&request);
    }
}

static void gather(void *context, const void *bytes, int64_t n, const int64_t *count, void *all)
{
    const ranks *r = context;
    int rank = 0;
    int n_rank = 1;
    MPI_Request request;
    (void)MPI_Comm_rank(r->comm, &rank);
    (void)MPI_Comm_size(r->comm, &n_rank);
    for (int64_t at = 0; rank > 0 && at < n; at += PIECE) {
        (void)MPI_Isend((const char *)bytes + at, piece_at(n, at), MPI_BYTE, 0, TAG + 1, r->comm,
                        &request);
        await(&request);
    }
    char *to = all;
    for (int k = 0; rank == 0 && k < n_rank; to += count[k], ++k) {
        for (int64_t at = 0; k > 0 && at < count[k]; at += PIECE) {
            (void)MPI_Irecv(to + at, piece_at(count[k], at), MPI_BYTE, k, TAG + 1, r->comm,
                            &request);
            await(&request);
        }
        if (k == 0 && n > 0) {
            memcpy(to, bytes, (size_t)n);
        }
    }
}

/// Integers that are added at once.
enum { SUM_PIECE = 1 << 20 };

static void sum(void *context, int64_t *value, int64_t n)
{
    const ranks *r = context;
    for (int64_t at = 0; at < n; at += SUM_PIECE) {
        const int here = (int)(n - at < SUM_PIECE ? n - at : SUM_PIECE);
        MPI_Request request;
        (void)MPI_Iallreduce(MPI_IN_PLACE, value + at, here, MPI_INT64_T, MPI_SUM, r->comm,
                             &request);
        await(&request);
    }
}

/// Sends n bytes to one rank while m come from another, piece by piece.
static void swap_bytes(const ranks *r, const int peer[2], const char *out, int64_t n, char *in,
                       int64_t m)
{
    int64_t sent = 0;
    int64_t come = 0;
    while (sent < n || come < m) {
        MPI_Request request[2] = {MPI_REQUEST_NULL, MPI_REQUEST_NULL};
        const int out_piece = piece_at(n, sent);
        const int in_piece = piece_at(m, come);
        if (in_piece > 0) {
            (void)MPI_Irecv(in + come, in_piece, MPI_BYTE, peer[1], TAG + 2, r->comm, &request[1]);
        }
        if (out_piece > 0) {
            (void)MPI_Isend(out + sent, out_piece, MPI_BYTE, peer[0], TAG + 2, r->comm,
                            &request[0]);
        }
        await(&request[0]);
        await(&request[1]);
        sent += out_piece;
        come += in_piece;
    }
}

/// What small messages of an exchange need: a request each.
static void exchange_at_once(ranks *r, const void *out, const int64_t *n_out, void *in,
                             const int64_t *n_in)
{
    const char *from = out;
    char *to = in;
    int n = 0;
    for (int k = 0; k < r->n_rank; to += n_in[k], ++k) {
        if (k != r->rank && n_in[k] > 0) {
            (void)MPI_Irecv(to, (int)n_in[k], MPI_BYTE, k, TAG + 2, r->comm, &r->each[n++]);
        }
    }
    to = in;
    for (int k = 0; k < r->n_rank; from += n_out[k], to += n_in[k], ++k) {
        if (k == r->rank && n_out[k] > 0) {
            memcpy(to, from, (size_t)n_out[k]);
        } else if (n_out[k] > 0) {
            (void)MPI_Isend(from, (int)n_out[k], MPI_BYTE, k, TAG + 2, r->comm, &r->each[n++]);
        }
    }
    await_all(n, r->each);
}

/// Larger ones: each rank meets one other a round.
static void exchange_in_rounds(const ranks *r, const void *out, const int64_t *n_out, void *in,
                               const int64_t *n_in)
{
    for (int k = 0; k < r->n_rank; ++k) {
        const int peer[2] = {(r->rank + k) % r->n_rank, (r->rank + r->n_rank - k) % r->n_rank};
        const char *from = out;
        char *to = in;
        for (int i = 0; i < peer[0]; ++i) {
            from += n_out[i];
        }
        for (int i = 0; i < peer[1]; ++i) {
            to += n_in[i];
        }
        if (k == 0 && n_out[r->rank] > 0) {
            memcpy(to, from, (size_t)n_out[r->rank]);
        } else if (k > 0) {
            swap_bytes(r, peer, from, n_out[peer[0]], to, n_in[peer[1]]);
        }
    }
}

static void exchange(void *context, const void *out, const int64_t *n_out, void *in,
                     const int64_t *n_in)
{
    ranks *r = context;
    int64_t mine = 0;
    for (int k = 0; k < r->n_rank; ++k) {
        mine = n_out[k] > mine ? n_out[k] : mine;
        mine = n_in[k] > mine ? n_in[k] : mine;
    }
    if (mine < PIECE) {
        exchange_at_once(r, out, n_out, in, n_in);
    } else {
        exchange_in_rounds(r, out, n_out, in, n_in);
    }
}

static bool partition(void *context, int64_t n, const clast_site *site, int32_t *rank)
{
    const ranks *r = context;
    const bool is_fine = clx_zoltan_partition(r->comm, r->method, n, site, rank);
    return least(context, is_fine ? 1 : 0) == 1;
}

/// Zoltan's name of the method that CLAST_PARTITION asks for: rcb (as when it is not set), hsfc, or
/// own: clast's bisection. "": that, NULL: it is none of them.
static const char *find_method(void)
{
    const char *word = getenv("CLAST_PARTITION"); // NOLINT(concurrency-mt-unsafe)
    if (word == NULL || strcmp(word, "rcb") == 0) {
        return clx_zoltan_is_there() ? "RCB" : "";
    }
    return strcmp(word, "own") == 0                             ? ""
           : strcmp(word, "hsfc") == 0 && clx_zoltan_is_there() ? "HSFC"
                                                                : NULL;
}

// NOLINTEND(clang-analyzer-optin.mpi.MPI-Checker)

/// Between MPI_Init and MPI_Finalize, outside of which most calls end the program.
static bool is_running(void)
{
    int has_begun = 0;
    int has_ended = 0;
    (void)MPI_Initialized(&has_begun);
    (void)MPI_Finalized(&has_ended);
    return has_begun && !has_ended;
}

clast_status clast_mpi_create(int32_t communicator, clast_comm *comm)
{
    CLX_ARGUMENTS(comm);
    int rank = 0;
    int n_rank = 1;
    const char *method = find_method();
    if (!is_running()) {
        return clx_fail(CLAST_E_USAGE, "MPI does not run: it begins with MPI_Init or "
                                       "clast_mpi_begin and ends with MPI_Finalize");
    }
    if (MPI_Comm_f2c(communicator) == MPI_COMM_NULL) {
        return clx_fail(CLAST_E_ARGUMENT, "the communicator is MPI_COMM_NULL: a rank that "
                                          "MPI_Comm_split has left out does not take part");
    }
    if (method == NULL) {
        return clx_fail(CLAST_E_CONFIG, "CLAST_PARTITION '%s': rcb, hsfc (with Zoltan) or own",
                        getenv("CLAST_PARTITION")); // NOLINT(concurrency-mt-unsafe)
    }
    ranks *made = calloc(1, sizeof *made); // the other library's heap wrapper is hidden from here
    if (made == NULL) {
        return clx_fail(CLAST_E_MEMORY, "out of memory");
    }
    (void)MPI_Comm_dup(MPI_Comm_f2c(communicator), &made->comm);
    (void)MPI_Comm_rank(made->comm, &rank);
    (void)MPI_Comm_size(made->comm, &n_rank);
    made->rank = rank;
    made->method = method;
    made->n_rank = n_rank;
    made->each = calloc(2 * (size_t)n_rank, sizeof *made->each);
    if (made->each == NULL) {
        (void)MPI_Comm_free(&made->comm);
        free(made);
        return clx_fail(CLAST_E_MEMORY, "out of memory");
    }
    for (int k = 0; k < SLOT; ++k) {
        made->request[k] = MPI_REQUEST_NULL;
    }
    *comm = (clast_comm){.rank = rank,
                         .n_rank = n_rank,
                         .send = send,
                         .take = receive_words,
                         .least = least,
                         .broadcast = broadcast,
                         .gather = gather,
                         .sum = sum,
                         .exchange = exchange,
                         .partition = method[0] != '\0' ? partition : NULL,
                         .context = made};
    return CLAST_OK;
}

void clast_mpi_destroy(clast_comm *comm)
{
    if (comm == NULL) {
        return;
    }
    ranks *r = comm->context;
    if (r != NULL && is_running()) {
        for (int k = 0; k < SLOT; ++k) {
            await(&r->request[k]);
        }
        (void)MPI_Comm_free(&r->comm);
    }
    if (r != NULL) {
        free(r->each);
        free(r);
    }
    *comm = (clast_comm){0};
}

clast_status clast_mpi_begin(clast_comm *comm)
{
    CLX_ARGUMENTS(comm);
    int has_begun = 0;
    int level = 0;
    (void)MPI_Initialized(&has_begun);
    if (has_begun) {
        return clx_fail(CLAST_E_USAGE,
                        is_running() ? "MPI runs already: clast_mpi_create takes its communicator"
                                     : "MPI has ended, and a program begins it once");
    }
    // All MPI calls come from the one thread that calls the library.
    if (MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &level) != MPI_SUCCESS) {
        return clx_fail(CLAST_E_IO, "MPI does not start");
    }
    const clast_status status = clast_mpi_create(MPI_Comm_c2f(MPI_COMM_WORLD), comm);
    if (status != CLAST_OK) {
        int rank = 0;
        (void)MPI_Comm_rank(MPI_COMM_WORLD, &rank);
        (void)MPI_Finalize();
        *comm = (clast_comm){.rank = rank};
        return status;
    }
    ranks *made = comm->context;
    made->has_begun = true;
    return CLAST_OK;
}

void clast_mpi_end(clast_comm *comm)
{
    const ranks *r = comm != NULL ? comm->context : NULL;
    const bool has_begun = r != NULL && r->has_begun;
    clast_mpi_destroy(comm);
    if (has_begun && is_running()) {
        (void)MPI_Finalize();
    }
}
