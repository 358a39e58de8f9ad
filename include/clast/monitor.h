#pragma once
#include <clast/status.h>

CLAST_BEGIN

/// How long work talks to its caller: NULL, or callbacks. Called from the calling thread only.
typedef struct clast_monitor {
    /// done of total units in the named phase; total <= 0 when unknown. May be NULL.
    void (*report)(void *context, const char *phase, int64_t done, int64_t total);
    /// True asks the work to write its checkpoint and return CLAST_E_STOPPED. May be NULL.
    bool (*stop)(void *context);
    /// One line on what comes next ("printable.stl: about 48 MB"). May be NULL.
    void (*note)(void *context, const char *text);
    void *context;
    int32_t n_word;    ///< the command line, for manifests; 0: none
    char *const *word; ///< [n_word] borrowed
} clast_monitor;

/// Removes the temporary files of all outputs under way, of every thread. For a signal handler that
/// then ends the process (it calls nothing but unlink); outputs that were whole stay.
CLAST_API void clast_outputs_abandon(void);

CLAST_END
