// clast_comm over MPI 3.1.
//
// Ranks of clast wait long for each other (a run takes minutes), so no call spins in MPI:
// everything is begun without blocking and asked after with naps in between. MPI's own errors end
// the job, as is MPI's default.
#include <clast/mpi.h>

#include <clast/machine.h>
#include <mpi.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { TAG = 1, SLOT = 64, NAP_FROM = 64 };

/// Messages on their way out, and the communicator.
typedef struct {
    MPI_Comm comm;
    int32_t next; ///< slot to use, in turn
    MPI_Request request[SLOT];
    int64_t word[SLOT][CLAST_COMM_WORDS];
} ranks;

/// Waits for a request: some tests at once, then one a millisecond.
static void await(MPI_Request *request)
{
    const struct timespec nap = {0, 1000000};
    int done = 0;
    for (int tries = 0;; ++tries) {
        (void)MPI_Test(request, &done, MPI_STATUS_IGNORE);
        if (done) {
            return;
        }
        if (tries >= NAP_FROM) {
            (void)nanosleep(&nap, NULL);
        }
    }
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

static bool take(void *context, int32_t *from, int64_t word[CLAST_COMM_WORDS])
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

// NOLINTEND(clang-analyzer-optin.mpi.MPI-Checker)

clast_status clast_mpi_create(int32_t communicator, clast_comm *comm)
{
    int runs = 0;
    int rank = 0;
    int n_rank = 1;
    (void)MPI_Initialized(&runs);
    if (!runs) {
        return CLAST_E_USAGE;
    }
    ranks *made = calloc(1, sizeof *made); // the other library's heap wrapper is hidden from here
    if (made == NULL) {
        return CLAST_E_MEMORY;
    }
    (void)MPI_Comm_dup(MPI_Comm_f2c(communicator), &made->comm);
    (void)MPI_Comm_rank(made->comm, &rank);
    (void)MPI_Comm_size(made->comm, &n_rank);
    for (int k = 0; k < SLOT; ++k) {
        made->request[k] = MPI_REQUEST_NULL;
    }
    *comm = (clast_comm){.rank = rank,
                         .n_rank = n_rank,
                         .send = send,
                         .take = take,
                         .least = least,
                         .broadcast = broadcast,
                         .gather = gather,
                         .context = made};
    return CLAST_OK;
}

void clast_mpi_destroy(clast_comm *comm)
{
    ranks *r = comm->context;
    if (r != NULL) {
        for (int k = 0; k < SLOT; ++k) {
            await(&r->request[k]);
        }
        (void)MPI_Comm_free(&r->comm);
        free(r);
    }
    *comm = (clast_comm){0};
}

clast_status clast_mpi_begin(clast_comm *comm)
{
    int runs = 0;
    int level = 0;
    (void)MPI_Initialized(&runs);
    if (runs) {
        return CLAST_E_USAGE;
    }
    // All MPI calls come from the one thread that calls the library.
    if (MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &level) != MPI_SUCCESS) {
        return CLAST_E_IO;
    }
    return clast_mpi_create(MPI_Comm_c2f(MPI_COMM_WORLD), comm);
}

void clast_mpi_end(clast_comm *comm)
{
    clast_mpi_destroy(comm);
    (void)MPI_Finalize();
}
