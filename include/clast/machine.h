#pragma once
#include <clast/status.h>

// Processes that share one piece of work ("ranks"), behind a table of functions.
//
// The library itself knows one rank. libclast_mpi (clast/mpi.h) fills the table for the ranks of an
// MPI job; a program may fill it for any other kind. What runs on several ranks ends in the same
// bytes as on one.

CLAST_BEGIN

// How much memory the library's blocks may take together, over all threads of the process. What
// would go beyond ends with CLAST_E_MEMORY before it is taken, so that a file that declares more
// than the machine has costs a message and nothing else. There is no limit until one is set; the
// command sets one (`clast COMMAND --max-memory`).

/// Sets the limit in bytes; 0: none. Blocks that are taken already stay.
///
/// @return CLAST_E_ARGUMENT for a negative number
CLAST_API clast_status clast_memory_set_limit(int64_t bytes);

/// The limit in bytes; 0: none.
CLAST_API int64_t clast_memory_limit(void);

/// Bytes that the library's blocks take now. What a caller has allocated and the library frees
/// counts as gone all the same; 0 is the least.
CLAST_API int64_t clast_memory_taken(void);

/// Threads for all later work of the calling thread; 0 means OMP_NUM_THREADS where it is set, else
/// one per core that the process may use. Results never depend on it.
CLAST_API void clast_parallel_set_threads(int32_t n);

/// Threads in use.
CLAST_API int32_t clast_parallel_threads(void);

enum { CLAST_COMM_WORDS = 3 };

/// A piece of work that lies somewhere, for a partition.
typedef struct clast_site {
    double position[3];
    double cost;
    int32_t number; ///< of all ranks' sites
} clast_site;

/// One rank's view of all. Functions are called from one thread of each rank. A failure between
/// ranks is not reported here: as in MPI it ends all of them.
struct clast_comm {
    int32_t rank; ///< of this process, 0 .. n_rank - 1
    int32_t n_rank;
    /// Sends a message to another rank and returns at once; messages between two ranks keep their
    /// order.
    void (*send)(void *context, int32_t to, const int64_t word[CLAST_COMM_WORDS]);
    /// Takes the next message that has come, and its sender; false when there is none.
    bool (*take)(void *context, int32_t *from, int64_t word[CLAST_COMM_WORDS]);
    /// Least of all ranks' values, on every rank. Called by all ranks, as the next two.
    int64_t (*least)(void *context, int64_t value);
    /// Copies n bytes from rank `root` to all others.
    void (*broadcast)(void *context, int32_t root, void *bytes, int64_t n);
    /// Puts the ranks' bytes one after another into `all` on rank 0; `count` [n_rank], the bytes of
    /// each, and `all` matter there only.
    void (*gather)(void *context, const void *bytes, int64_t n, const int64_t *count, void *all);
    void *context;
    /// Adds the ranks' arrays [n] element by element, in place, on every rank. Called by all ranks,
    /// as the next. NULL, as `exchange`, in a table that only whole runs are shared by.
    void (*sum)(void *context, int64_t *value, int64_t n);
    /// Sends to each rank its part of `out`: the first n_out[0] bytes to rank 0, then n_out[1] to
    /// rank 1 .. ; what comes lies in `in` in the order of ranks, n_in [n_rank] bytes of each.
    void (*exchange)(void *context, const void *out, const int64_t *n_out, void *in,
                     const int64_t *n_in);
    /// Divides all ranks' sites among them, near ones together, costs alike; each rank gives some
    /// [n] and gets the rank of each. False on all ranks where it failed. NULL: there is none, and
    /// the library bisects by itself.
    bool (*partition)(void *context, int64_t n, const clast_site *site, int32_t *rank);
};

/// The only rank of one.
CLAST_API const clast_comm *clast_comm_one(void);

/// Makes all ranks agree on how a step ended: OK when it was so for every one, else the status and
/// text of the first rank that failed (one that was merely stopped only if none failed). Every rank
/// must call it; afterwards clast_error_detail() is the same on all.
///
/// @param text  this rank's error text; NULL: clast_error_detail()
CLAST_API clast_status clast_comm_agree(const clast_comm *comm, clast_status status,
                                        const char *text);

CLAST_END
