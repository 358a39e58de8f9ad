#pragma once
// One process at a time changes a file or folder that several may want to change.
//
// The lock is a file beside it, PATH.lock, held by flock(2), by fcntl(2) where the disk has no
// flock: the kernel (of an NFS server, too) lets it go with its process, so that none is ever
// stale. Who holds it is written inside.
#include "base/status.h"

/// {0} holds nothing.
typedef struct clx_lock {
    char *path;
    int descriptor; ///< valid while path is not NULL
} clx_lock;

/// Takes the lock of PATH, waiting for up to `patience` seconds while another process has it.
///
/// @return CLAST_E_DISK when it cannot be taken; who has it is in the message, and *is_busy is true
CLX_SHARED clast_status clx_lock_acquire(const char *path, double patience, clx_lock *lock,
                                         bool *is_busy);

enum { CLX_PROCESS_NAME = 300 };

/// This process for messages of others: "process 4711 on node3".
void clx_process_name(char name[CLX_PROCESS_NAME]);

/// Whether somebody has the lock of PATH now; takes, waits for and writes nothing.
CLX_SHARED bool clx_lock_is_held(const char *path);

/// Lets go; does nothing for {0}.
CLX_SHARED void clx_lock_release(clx_lock *lock);
