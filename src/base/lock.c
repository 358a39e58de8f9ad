// Locks between processes: a file beside what is changed, held by flock, or by fcntl on disks that
// know no flock (Lustre without the mount option flock, some FUSE).
#ifdef __linux__
// NOLINTNEXTLINE(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp): glibc's, for both
#define _GNU_SOURCE 1
#endif
#include "base/lock.h"

#include "base/alloc.h"
#include "base/clock.h"
#include "base/path.h"
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/// Whether the descriptor is still that of the file by this name: its last holder removes it.
static bool is_named(int descriptor, const char *path)
{
    struct stat held;
    struct stat named;
    return fstat(descriptor, &held) == 0 && stat(path, &named) == 0 &&
           held.st_dev == named.st_dev && held.st_ino == named.st_ino;
}

/// Whether an error says that the disk has no such kind of lock.
static bool is_unknown(int error)
{
    return error == ENOSYS || error == ENOTSUP || error == EINVAL || error == ENOLCK;
}

/// Locks the file, for itself (F_WRLCK) or beside others that only ask (F_RDLCK): 0, or why not;
/// EWOULDBLOCK: another has it.
static int lock_file(int file, short type)
{
    struct flock whole = {.l_type = type, .l_whence = SEEK_SET};
    int error = flock(file, (type == F_RDLCK ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0 ? 0 : errno;
#ifdef F_OFD_SETLK // the open file's, as flock's; the plain one goes as any descriptor is closed
    if (is_unknown(error)) {
        error = fcntl(file, F_OFD_SETLK, &whole) == 0 ? 0 : errno;
    }
#endif
    if (is_unknown(error)) {
        error = fcntl(file, F_SETLK, &whole) == 0 ? 0 : errno;
    }
    return error == EACCES || error == EAGAIN ? EWOULDBLOCK : error;
}

/// One attempt: 1 taken, 0 another has it, -1 the disk refuses (errno).
static int try_take(const char *path, int *descriptor)
{
    const int file = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (file < 0) {
        return -1;
    }
    const int refused = lock_file(file, F_WRLCK);
    // held, but by a name that is gone: once more
    const int error = refused == 0 ? EWOULDBLOCK : refused;
    if (refused == 0 && is_named(file, path)) {
        *descriptor = file;
        return 1;
    }
    (void)close(file);
    errno = error;
    return error == EWOULDBLOCK || error == EINTR ? 0 : -1;
}

void clx_process_name(char name[CLX_PROCESS_NAME])
{
    char host[256] = "";
    (void)gethostname(host, sizeof host - 1);
    (void)snprintf(name, CLX_PROCESS_NAME, "process %ld on %s", (long)getpid(), host);
}

/// Writes who holds the lock into it; only for messages, so that failing is fine.
static void sign(int descriptor)
{
    char name[CLX_PROCESS_NAME];
    char since[32] = "";
    char text[400];
    struct tm parts;
    const time_t now = time(NULL);
    clx_process_name(name);
    if (gmtime_r(&now, &parts) != NULL) {
        (void)strftime(since, sizeof since, "%Y-%m-%dT%H:%M:%SZ", &parts);
    }
    const int n = snprintf(text, sizeof text, "%s since %s", name, since);
    const ssize_t written = ftruncate(descriptor, 0) == 0 ? write(descriptor, text, (size_t)n) : 0;
    (void)written;
}

static clast_status complain(const char *path, const char *lock)
{
    char who[400] = "another process";
    const int file = open(lock, O_RDONLY | O_CLOEXEC);
    const ssize_t n = file >= 0 ? read(file, who, sizeof who - 1) : 0;
    if (n > 0) {
        who[n] = '\0';
    }
    if (file >= 0) {
        (void)close(file);
    }
    return clx_fail(CLAST_E_DISK, "%s is being written by %s; try again when that has ended", path,
                    who);
}

clast_status clx_lock_acquire(const char *path, double patience, clx_lock *lock, bool *is_busy)
{
    CLAST_ASSERT(lock->path == NULL && patience >= 0.0);
    clast_status status = CLAST_OK;
    const struct timespec pause = {0, 20000000};
    const double begun = clx_clock();
    char *name = NULL;
    int descriptor = -1;
    const int64_t size = (int64_t)strlen(path) + 8;
    *is_busy = false;
    CLX_TRY(clx_alloc(&name, size, 1));
    (void)snprintf(name, (size_t)size, "%s.lock", path);
    int taken = try_take(name, &descriptor);
    while (taken == 0 && clx_clock() - begun < patience) {
        (void)nanosleep(&pause, NULL);
        taken = try_take(name, &descriptor);
    }
    *is_busy = taken == 0;
    CLX_CHECK(taken >= 0, CLAST_E_DISK, "cannot write %s: %s", name,
              is_unknown(errno) ? "this disk has no file locks (Lustre: mount it with -o flock)"
                                : clx_errno_text());
    if (taken == 0) {
        status = complain(path, name);
        goto done;
    }
    sign(descriptor);
    *lock = (clx_lock){name, descriptor};
    name = NULL;
done:
    clx_free(name);
    return status;
}

bool clx_lock_is_held(const char *path)
{
    char name[CLX_PATH_LIMIT];
    const int n = snprintf(name, sizeof name, "%s.lock", path);
    const int file = n > 0 && n < CLX_PATH_LIMIT ? open(name, O_RDONLY | O_CLOEXEC) : -1;
    const bool is_held = file >= 0 && lock_file(file, F_RDLCK) == EWOULDBLOCK;
    if (file >= 0) {
        (void)close(file); // and with it the lock
    }
    return is_held;
}

void clx_lock_release(clx_lock *lock)
{
    if (lock->path != NULL) {
        (void)unlink(lock->path); // while it is held: whoever waits sees that its name is gone
        (void)close(lock->descriptor);
        clx_free(lock->path);
    }
    *lock = (clx_lock){0};
}
