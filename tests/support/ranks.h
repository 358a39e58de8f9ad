#pragma once
// Ranks without MPI: processes of this machine that share a piece of memory.
#include <clast/machine.h>

/// Runs `work` on n ranks, forked from this process, and fails the test unless each returns 0
/// within five minutes. What ranks shall tell the test goes through files or `shared`.
///
/// @param work  returns 0, or the line of the check that failed
void support_run_ranks(int32_t n, int (*work)(const clast_comm *comm, void *context),
                       void *context);

/// Zeroed memory that ranks forked later see as one; freed by nobody.
void *support_shared_memory(size_t size);

/// In `work`: gives up with the line's number unless the condition holds.
#define RANK_CHECK(condition)                                                                      \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            return __LINE__;                                                                       \
        }                                                                                          \
    } while (0)
