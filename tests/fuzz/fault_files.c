// Preloaded into a command (LD_PRELOAD): the k-th disk operation below a folder fails.
//
//     CLAST_FAULT_FOLDER  only what lies below it counts
//     CLAST_FAULT_AT      k, from 1; 0 or absent: none fails
//     CLAST_FAULT_ERRNO   the number that it fails with
//     CLAST_FAULT_MODE    once (default); on: all from the k-th; short: the k-th write takes half;
//                         kill: the process ends before the k-th, by SIGKILL
//     CLAST_FAULT_COUNT   file that gets the number of operations at the end
//
// Operations: files opened for writing, writes, syncs, renames, folders made, files cut or closed
// by stdio. Removing files never fails: a full disk lets one do that; with kill it counts too.
#define _GNU_SOURCE 1
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

static _Atomic long n_done;

static const char *word(const char *name)
{
    const char *value = getenv(name); // NOLINT(concurrency-mt-unsafe): nobody sets it here
    return value != NULL ? value : "";
}

static bool is_below(const char *path)
{
    char whole[2 * PATH_MAX];
    const char *folder = word("CLAST_FAULT_FOLDER");
    if (path[0] != '/' && syscall(SYS_getcwd, whole, PATH_MAX) > 0) {
        (void)snprintf(whole + strlen(whole), PATH_MAX, "/%s", path);
        path = whole;
    }
    return folder[0] != '\0' && strncmp(path, folder, strlen(folder)) == 0;
}

static bool is_ours(int descriptor)
{
    char link[64];
    char path[PATH_MAX];
    (void)snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
    const long n = syscall(SYS_readlink, link, path, sizeof path - 1);
    path[n > 0 ? n : 0] = '\0';
    return n > 0 && is_below(path);
}

static bool kills(void)
{
    return strcmp(word("CLAST_FAULT_MODE"), "kill") == 0;
}

/// Counts an operation; true when it is to fail, errno set.
static bool fails(void)
{
    const long k = atomic_fetch_add(&n_done, 1) + 1;
    const long at = strtol(word("CLAST_FAULT_AT"), NULL, 10);
    const bool is_hit =
        at > 0 && (k == at || (k > at && strcmp(word("CLAST_FAULT_MODE"), "on") == 0));
    if (is_hit && kills()) {
        (void)raise(SIGKILL);
    }
    if (is_hit) {
        errno = (int)strtol(word("CLAST_FAULT_ERRNO"), NULL, 10);
    }
    return is_hit;
}

static bool is_short(void)
{
    return strcmp(word("CLAST_FAULT_MODE"), "short") == 0;
}

__attribute__((destructor)) static void tell(void)
{
    const char *path = word("CLAST_FAULT_COUNT");
    char text[32];
    if (path[0] != '\0') {
        const int file =
            (int)syscall(SYS_openat, AT_FDCWD, path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
        const int n = snprintf(text, sizeof text, "%ld\n", atomic_load(&n_done));
        (void)syscall(SYS_write, file, text, (size_t)n);
        (void)syscall(SYS_close, file);
    }
}

#define REAL(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))
#define OPEN(name)                                                                                 \
    int name(const char *path, int flags, ...)                                                     \
    {                                                                                              \
        va_list list;                                                                              \
        va_start(list, flags);                                                                     \
        const mode_t mode = (flags & O_CREAT) != 0 ? (mode_t)va_arg(list, int) : 0;                \
        va_end(list);                                                                              \
        const bool counts = (flags & (O_WRONLY | O_RDWR)) != 0 && is_below(path);                  \
        return counts && fails() ? -1 : REAL(name)(path, flags, mode);                             \
    }
#define WRITE(name, offset_type)                                                                   \
    ssize_t name(int file, const void *bytes, size_t n, offset_type at)                            \
    {                                                                                              \
        const bool is_hit = is_ours(file) && fails();                                              \
        return is_hit && !is_short() ? -1 : REAL(name)(file, bytes, is_hit ? (n + 1) / 2 : n, at); \
    }
#define SYNC(name)                                                                                 \
    int name(int file)                                                                             \
    {                                                                                              \
        return is_ours(file) && fails() ? -1 : REAL(name)(file);                                   \
    }
#define STREAM(name)                                                                               \
    FILE *name(const char *path, const char *mode)                                                 \
    {                                                                                              \
        const bool counts = strpbrk(mode, "wa+") != NULL && is_below(path);                        \
        return counts && fails() ? NULL : REAL(name)(path, mode);                                  \
    }

OPEN(open)
OPEN(open64)
WRITE(pwrite, off_t)
WRITE(pwrite64, off64_t)
SYNC(fsync)
SYNC(fdatasync)
STREAM(fopen)
STREAM(fopen64)

ssize_t write(int file, const void *bytes, size_t n)
{
    const bool is_hit = is_ours(file) && fails();
    return is_hit && !is_short() ? -1 : REAL(write)(file, bytes, is_hit ? (n + 1) / 2 : n);
}

int rename(const char *from, const char *to)
{
    return is_below(to) && fails() ? -1 : REAL(rename)(from, to);
}

int mkdir(const char *path, mode_t mode)
{
    return is_below(path) && fails() ? -1 : REAL(mkdir)(path, mode);
}

int ftruncate(int file, off_t size)
{
    return is_ours(file) && fails() ? -1 : REAL(ftruncate)(file, size);
}

int fclose(FILE *stream)
{
    const bool counts =
        (fcntl(fileno(stream), F_GETFL) & O_ACCMODE) != O_RDONLY && is_ours(fileno(stream));
    const bool is_hit = counts && fails();
    const int error = errno;
    const int code = REAL(fclose)(stream);
    errno = is_hit ? error : errno;
    return is_hit ? EOF : code;
}

#define REMOVE(name)                                                                               \
    int name(const char *path)                                                                     \
    {                                                                                              \
        if (kills() && is_below(path)) {                                                           \
            (void)fails();                                                                         \
        }                                                                                          \
        return REAL(name)(path);                                                                   \
    }

REMOVE(remove)
REMOVE(unlink)
REMOVE(rmdir)
