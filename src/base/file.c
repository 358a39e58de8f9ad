// Outputs that appear at once or not at all: temporary file in the same folder, sync, rename, sync
// of the folder [POSIX rename(2) is atomic within one file system]. And whole inputs with a limit.
#include "base/file.h"

#include <clast/status.h>

#include "base/alloc.h"
#include "base/number.h"
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#ifdef CLAST_ALLOC_INJECT
static _Atomic int64_t countdown;
static _Atomic int refusal;

int64_t clx_file_refuse(int64_t k, int error)
{
    atomic_store(&refusal, error);
    return atomic_exchange(&countdown, k);
}

static bool refused(void)
{
    if (atomic_load(&countdown) > 0 && atomic_fetch_sub(&countdown, 1) == 1) {
        errno = atomic_load(&refusal);
        return true;
    }
    return false;
}
#else
static bool refused(void)
{
    return false;
}
#endif

/// To the disk itself. Test builds write thousands of files and cannot see durability, so they only
/// count the call; release builds sync.
static int sync_descriptor(int descriptor)
{
#ifdef CLAST_ALLOC_INJECT
    return fcntl(descriptor, F_GETFD) < 0 ? -1 : 0;
#else
    return fsync(descriptor);
#endif
}

/// Names of the temporary files there are, for a signal handler: no pointer that another thread may
/// free while it looks. More than these at once are left to be swept by hand.
enum { N_NOTED = 16 };
static struct {
    _Atomic int use; ///< 0: free, 1: being written or cleared, 2: a name
    char name[PATH_MAX];
} noted[N_NOTED];

static void note_temporary(const char *name)
{
    const size_t n = strlen(name) + 1;
    for (int k = 0; k < N_NOTED && n <= PATH_MAX; ++k) {
        int unused = 0;
        if (atomic_compare_exchange_strong(&noted[k].use, &unused, 1)) {
            memcpy(noted[k].name, name, n);
            atomic_store(&noted[k].use, 2);
            return;
        }
    }
}

static void forget_temporary(const char *name)
{
    for (int k = 0; k < N_NOTED; ++k) {
        if (atomic_load(&noted[k].use) == 2 && strcmp(noted[k].name, name) == 0) {
            atomic_store(&noted[k].use, 0);
            return;
        }
    }
}

void clast_outputs_abandon(void)
{
    for (int k = 0; k < N_NOTED; ++k) {
        if (atomic_load(&noted[k].use) == 2) {
            (void)unlink(noted[k].name);
        }
    }
}

/// Keeps the first failure and words it for the person at the terminal.
static clast_status fail_file(clx_file *file, const char *doing)
{
    if (file->error == 0) {
        file->error = errno != 0 ? errno : EIO;
        file->doing = doing;
    }
    return clx_fail(file->error == ENOMEM ? CLAST_E_MEMORY : CLAST_E_DISK,
                    "cannot write %s: %s: %s", file->path, file->doing,
                    clx_error_text(file->error));
}

static void forget(clx_file *file)
{
    if (file->temporary != NULL) {
        forget_temporary(file->temporary);
    }
    CLX_FREE(file->path, file->target, file->temporary, file->buffer);
    *file = (clx_file){0};
}

void clx_file_abandon(clx_file *file)
{
    if (file->buffer != NULL) {
        (void)close(file->descriptor);
        if (file->temporary != NULL) {
            (void)unlink(file->temporary);
        }
    }
    forget(file);
}

/// Folder part of a path with its slash, "" when there is none; length in bytes.
static size_t folder_length(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? (size_t)(slash - path) + 1 : 0;
}

/// The file that a chain of links names, though there is none yet.
static clast_status follow_dangling(const char *path, char **target)
{
    enum { MOST = 40 }; // as the system follows
    clast_status status = CLAST_OK;
    char name[PATH_MAX];
    char word[PATH_MAX];
    CLX_CHECK((size_t)snprintf(name, sizeof name, "%s", path) < sizeof name, CLAST_E_DISK,
              "cannot write %s: the path is too long", path);
    for (int k = 0; k < MOST; ++k) {
        const ssize_t n = readlink(name, word, sizeof word - 1);
        if (n < 0) { // no link
            return clx_alloc_text(target, name);
        }
        word[n] = '\0';
        const size_t folder = word[0] == '/' ? 0 : folder_length(name);
        CLX_CHECK(folder + (size_t)n < sizeof name, CLAST_E_DISK,
                  "cannot write %s: the path is too long", path);
        memcpy(name + folder, word, (size_t)n + 1);
    }
    status = clx_fail(CLAST_E_DISK, "cannot write %s: its links lead in a circle", path);
done:
    return status;
}

/// Follows a link, so that the file it names is replaced and not the link.
static clast_status find_target(const char *path, char **target, bool *is_plain)
{
    clast_status status = CLAST_OK;
    struct stat info;
    char followed[PATH_MAX];
    *is_plain = true;
    if (path[0] == '\0') {
        return clx_fail(CLAST_E_DISK, "cannot write a file without a name");
    }
    if (stat(path, &info) != 0) {
        return follow_dangling(path, target);
    }
    CLX_CHECK(!S_ISDIR(info.st_mode), CLAST_E_DISK, "cannot write %s: it is a folder", path);
    *is_plain = S_ISREG(info.st_mode);
    CLX_CHECK(!*is_plain || realpath(path, followed) != NULL, CLAST_E_DISK, "cannot write %s: %s",
              path, clx_errno_text());
    CLX_TRY(clx_alloc_text(target, *is_plain ? followed : path));
done:
    return status;
}

/// Opens the first free name ".clast-PID-K.tmp" in the target's folder.
static clast_status open_temporary(clx_file *file)
{
    enum { TRIES = 1000 };
    clast_status status = CLAST_OK;
    const size_t folder = folder_length(file->target);
    const size_t size = folder + 64;
    CLX_TRY(clx_alloc(&file->temporary, (int64_t)size, 1));
    file->descriptor = -1;
    for (int k = 0; k < TRIES && file->descriptor < 0; ++k) {
        (void)snprintf(file->temporary, size, "%.*s.clast-%ld-%d.tmp", (int)folder, file->target,
                       (long)getpid(), k);
        if (!refused()) {
            file->descriptor = open(file->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        }
        if (file->descriptor < 0 && errno != EEXIST) {
            break;
        }
    }
    if (file->descriptor < 0) {
        status = errno == ENOENT
                     ? clx_fail(CLAST_E_DISK, "cannot write %s: there is no folder %.*s",
                                file->path, (int)folder, file->target)
                     : fail_file(file, "open");
        clx_free(file->temporary); // there is no such file
        file->temporary = NULL;
    } else {
        note_temporary(file->temporary);
    }
done:
    return status;
}

static clast_status open_device(clx_file *file)
{
    if (!refused()) {
        file->descriptor = open(file->target, O_WRONLY | O_CLOEXEC);
    } else {
        file->descriptor = -1;
    }
    return file->descriptor < 0 ? fail_file(file, "open") : CLAST_OK;
}

clast_status clx_file_begin(const char *path, clx_file *file)
{
    CLAST_ASSERT(file->buffer == NULL);
    clast_status status = CLAST_OK;
    clx_file made = {0};
    char *buffer = NULL;
    bool is_plain = true;
    CLX_TRY(clx_alloc_text(&made.path, path));
    CLX_TRY(find_target(path, &made.target, &is_plain));
    CLX_TRY(clx_alloc(&buffer, CLX_FILE_BUFFER, 1));
    CLX_TRY(is_plain ? open_temporary(&made) : open_device(&made));
    made.buffer = buffer;
    *file = made;
    made = (clx_file){0};
    buffer = NULL;
done:
    clx_free(buffer);
    forget(&made);
    return status;
}

static clast_status flush(clx_file *file)
{
    CLAST_ASSERT(file->used >= 0 && file->used <= CLX_FILE_BUFFER);
    int64_t done = 0;
    while (done < file->used) {
        const ssize_t n =
            refused() ? -1
                      : write(file->descriptor, file->buffer + done, (size_t)(file->used - done));
        if (n < 0 && errno != EINTR) {
            return fail_file(file, "write");
        }
        done += n > 0 ? n : 0;
    }
    file->used = 0;
    return CLAST_OK;
}

clast_status clx_file_write(clx_file *file, const void *bytes, size_t n)
{
    const char *from = bytes;
    CLAST_ASSERT(file->buffer != NULL);
    if (file->error != 0) {
        return fail_file(file, NULL);
    }
    file->written += (int64_t)n;
    while (n > 0) {
        const size_t n_free = (size_t)(CLX_FILE_BUFFER - file->used);
        const size_t part = n < n_free ? n : n_free;
        memcpy(file->buffer + file->used, from, part);
        file->used += (int64_t)part;
        from += part;
        n -= part;
        if (file->used == CLX_FILE_BUFFER) {
            const clast_status status = flush(file);
            if (status != CLAST_OK) {
                return status;
            }
        }
    }
    return CLAST_OK;
}

clast_status clx_file_print(clx_file *file, const char *format, ...)
{
    clast_status status = CLAST_OK;
    char text[512];
    char *longer = NULL;
    va_list args;
    va_start(args, format);
    const int n = clx_number_print_list(text, sizeof text, format, args);
    va_end(args);
    CLX_CHECK(n >= 0, CLAST_E_DISK, "cannot write %s: text cannot be formatted", file->path);
    if ((size_t)n < sizeof text) {
        return clx_file_write(file, text, (size_t)n);
    }
    if (clx_alloc(&longer, (int64_t)n + 1, 1) != CLAST_OK) {
        errno = ENOMEM; // sticky, like the disk's errors
        return fail_file(file, "long text");
    }
    va_start(args, format);
    (void)clx_number_print_list(longer, (size_t)n + 1, format, args);
    va_end(args);
    CLX_TRY(clx_file_write(file, longer, (size_t)n));
done:
    clx_free(longer);
    return status;
}

/// File systems that cannot sync folders say EINVAL; that is fine.
static bool sync_path(const char *path)
{
    const int folder = refused() ? -1 : open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool is_synced = folder >= 0 && ((!refused() && sync_descriptor(folder) == 0) ||
                                           errno == EINVAL || errno == ENOTSUP);
    if (folder >= 0) {
        (void)close(folder);
    }
    return is_synced;
}

/// Makes the new name durable.
static clast_status sync_folder(clx_file *file)
{
    const size_t n = folder_length(file->target);
    file->target[n > 1 ? n - 1 : n] = '\0';
    return sync_path(n > 0 ? file->target : ".") ? CLAST_OK : fail_file(file, "sync of its folder");
}

clast_status clx_folder_sync(const char *path)
{
    return sync_path(path)
               ? CLAST_OK
               : clx_fail(CLAST_E_DISK, "cannot sync the folder %s: %s", path, clx_errno_text());
}

clast_status clx_file_commit(clx_file *file)
{
    clast_status status = CLAST_OK;
    CLAST_ASSERT(file->buffer != NULL);
    if (file->error != 0) {
        status = fail_file(file, NULL);
        goto done;
    }
    CLX_TRY(flush(file));
    if (file->temporary != NULL && (refused() || sync_descriptor(file->descriptor) != 0)) {
        status = fail_file(file, "sync");
        goto done;
    }
    const int closed = close(file->descriptor);
    clx_free(file->buffer); // from here on abandon does nothing
    file->buffer = NULL;
    if (closed != 0) {
        status = fail_file(file, "close");
    } else if (file->temporary != NULL &&
               (refused() || rename(file->temporary, file->target) != 0)) {
        status = fail_file(file, "rename");
    }
    if (status != CLAST_OK && file->temporary != NULL) {
        (void)unlink(file->temporary);
    }
    if (status == CLAST_OK && file->temporary != NULL) {
        status = sync_folder(file);
    }
done:
    clx_file_abandon(file);
    return status;
}

static clast_status open_input(const char *path, int *descriptor)
{
    clast_status status = CLAST_OK;
    struct stat info;
    *descriptor = open(path, O_RDONLY | O_CLOEXEC);
    CLX_CHECK(*descriptor >= 0, CLAST_E_IO, "cannot read %s: %s", path, clx_errno_text());
    CLX_CHECK(fstat(*descriptor, &info) == 0, CLAST_E_IO, "cannot read %s: %s", path,
              clx_errno_text());
    CLX_CHECK(!S_ISDIR(info.st_mode), CLAST_E_IO, "cannot read %s: it is a folder", path);
done:
    return status;
}

clast_status clx_file_read_all(const char *path, int64_t limit, char **bytes, int64_t *n)
{
    CLAST_ASSERT(limit >= 0);
    clast_status status = CLAST_OK;
    char *block = NULL;
    int64_t capacity = 0;
    int64_t used = 0;
    int descriptor = -1;
    struct stat info;
    CLX_TRY(open_input(path, &descriptor));
    if (fstat(descriptor, &info) == 0 && S_ISREG(info.st_mode)) {
        CLX_CHECK(info.st_size <= limit, CLAST_E_LIMIT, "%s has %lld bytes; the limit is %lld",
                  path, (long long)info.st_size, (long long)limit);
        CLX_TRY(clx_grow(&block, &capacity, (int64_t)info.st_size + 2, 1));
    }
    for (;;) {
        CLX_TRY(clx_grow(&block, &capacity, used + 2, 1));
        const ssize_t got = read(descriptor, block + used, (size_t)(capacity - used - 1));
        CLX_CHECK(got >= 0 || errno == EINTR, CLAST_E_IO, "cannot read %s: %s", path,
                  clx_errno_text());
        if (got == 0) {
            break;
        }
        used += got > 0 ? got : 0;
        CLX_CHECK(used <= limit, CLAST_E_LIMIT, "%s has more than %lld bytes", path,
                  (long long)limit);
    }
    block[used] = '\0';
    *bytes = block;
    *n = used;
    block = NULL;
done:
    if (descriptor >= 0) {
        (void)close(descriptor);
    }
    clx_free(block);
    return status;
}

static clast_status make_one(const char *path)
{
    struct stat info;
    if (!refused() && mkdir(path, 0777) == 0) {
        return CLAST_OK;
    }
    const int error = errno;
    if (stat(path, &info) == 0 && error == EEXIST) {
        return S_ISDIR(info.st_mode)
                   ? CLAST_OK
                   : clx_fail(CLAST_E_DISK, "cannot make folder %s: a file has that name", path);
    }
    if (error == EEXIST) {
        return clx_fail(CLAST_E_DISK, "cannot make folder %s: it is a link to what is not there",
                        path);
    }
    return clx_fail(CLAST_E_DISK, "cannot make folder %s: %s", path, clx_error_text(error));
}

clast_status clx_folder_make(const char *path)
{
    clast_status status = CLAST_OK;
    char *part = NULL;
    CLX_CHECK(path[0] != '\0', CLAST_E_DISK, "cannot make a folder without a name");
    CLX_TRY(clx_alloc_text(&part, path));
    for (char *c = part + 1; *c != '\0'; ++c) {
        if (*c == '/') {
            *c = '\0';
            CLX_TRY(make_one(part));
            *c = '/';
        }
    }
    CLX_TRY(make_one(part));
done:
    clx_free(part);
    return status;
}

clast_status clx_file_write_all(const char *path, const void *bytes, size_t n)
{
    clast_status status = CLAST_OK;
    clx_file file = {0};
    CLX_TRY(clx_file_begin(path, &file));
    CLX_TRY(clx_file_write(&file, bytes, n));
    CLX_TRY(clx_file_commit(&file));
done:
    clx_file_abandon(&file);
    return status;
}

clast_status clx_file_write_line(const char *path, const char *text)
{
    clast_status status = CLAST_OK;
    clx_file file = {0};
    CLX_TRY(clx_file_begin(path, &file));
    CLX_TRY(clx_file_print(&file, "%s\n", text));
    CLX_TRY(clx_file_commit(&file));
done:
    clx_file_abandon(&file);
    return status;
}
