// A new run takes the place of an old one: exchanged in one step [renameat2(2), RENAME_EXCHANGE],
// or by three renames where the file system cannot.
//
// A mark in the old run (.replaced) says that it may go. Whatever is cut off leaves one of these:
// both whole and the mark set (begin again), exchanged (carry the user's files, remove the old
// run), or the old run under FOLDER.old (put it back).
#ifdef __linux__
// NOLINTNEXTLINE(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp): glibc's, for syscall
#define _GNU_SOURCE 1
#endif
#include "run/run.h"

#include "base/file.h"
#include "base/path.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/syscall.h>
#endif

#define MARK     ".replaced"
#define MANIFEST "manifest.json"

/// What pack, aggregate and aggregate --fit leave; for runs whose manifest does not list it yet.
static const char *const left[] = {
    "achieved.csv",  "achieved.svg",   "aggregate.stl", "density.svg",      "diameter.svg",
    "energy.svg",    "fit.csv",        "fit.svg",       "frames",           "frames.pvd",
    "grains.csv",    "history.csv",    "history.svg",   "history_band.csv", "picture.png",
    "printable.3mf", "printable.json", "printable.stl", "profile.csv",      "profile.svg",
    "radial.csv",    "series.csv",     "sizes.csv",     "sizes.svg",        "state.h5",
    "structure.csv"};

/// What is a run's own in any case.
static const char *const always[] = {MANIFEST, "summary.json", "report.html", MARK};

static bool is_among(const char *name, const char *const *list, size_t n)
{
    for (size_t k = 0; k < n; ++k) {
        if (strcmp(name, list[k]) == 0) {
            return true;
        }
    }
    return false;
}

/// PREFIX, at least `least` digits, SUFFIX: state-0002.h5, repeat-0002, frame-000012.vtu.
static bool is_numbered(const char *name, const char *prefix, size_t least, const char *suffix)
{
    const size_t n = strlen(prefix);
    const size_t digits = strncmp(name, prefix, n) == 0 ? strspn(name + n, "0123456789") : 0;
    return digits >= least && strcmp(name + n + digits, suffix) == 0;
}

static bool is_passing(const char *name)
{
    return is_numbered(name, "checkpoint-", 12, ".h5") || strncmp(name, ".clast-", 7) == 0;
}

bool clx_run_owns(const clx_run_state *state, const char *name)
{
    const json_t *outputs = json_object_get(state->manifest, "outputs");
    if (is_among(name, always, sizeof always / sizeof *always) || is_passing(name) ||
        is_numbered(name, "repeat-", 4, "")) {
        return true;
    }
    for (size_t i = 0; i < json_array_size(outputs); ++i) {
        const char *output = json_string_value(json_array_get(outputs, i));
        if (output != NULL && strcmp(output, name) == 0) {
            return true;
        }
    }
    return outputs == NULL && (is_among(name, left, sizeof left / sizeof *left) ||
                               is_numbered(name, "state-", 4, ".h5"));
}

static int remove_entry(const char *path, const struct stat *found, int kind, struct FTW *place)
{
    (void)found;
    (void)kind;
    (void)place;
    return remove(path);
}

/// All but the folder's own mark and manifest.
static int remove_unmarked(const char *path, const struct stat *found, int kind, struct FTW *place)
{
    (void)found;
    (void)kind;
    const char *name = path + place->base;
    const bool stays =
        place->level == 0 ||
        (place->level == 1 && (strcmp(name, MARK) == 0 || strcmp(name, MANIFEST) == 0));
    return stays ? 0 : remove(path);
}

static int remove_temporary(const char *path, const struct stat *found, int kind, struct FTW *place)
{
    (void)found;
    const bool is_one = kind == FTW_F && strncmp(path + place->base, ".clast-", 7) == 0;
    return is_one ? remove(path) : 0;
}

void clx_run_remove_temporaries(const char *folder)
{
    // NOLINTNEXTLINE(concurrency-mt-unsafe): one thread is at a run's folder
    (void)nftw(folder, remove_temporary, 16, FTW_PHYS);
}

clast_status clx_run_remove_tree(const char *folder)
{
    clast_status status = CLAST_OK;
    struct stat found;
    if (lstat(folder, &found) != 0) {
        return CLAST_OK;
    }
    // NOLINTNEXTLINE(concurrency-mt-unsafe): one thread is at a run's folder
    CLX_CHECK(nftw(folder, remove_entry, 16, FTW_DEPTH | FTW_PHYS) == 0, CLAST_E_DISK,
              "cannot remove %s: %s", folder, clx_errno_text());
done:
    return status;
}

/// The first entry that is not the run's own; `state` NULL: of a subfolder that the run made.
static bool find_foreign(const char *folder, const clx_run_state *state, char name[256])
{
    bool found = false;
    DIR *open = opendir(folder);
    // NOLINTNEXTLINE(concurrency-mt-unsafe): one stream, used by this thread alone
    for (struct dirent *entry = open != NULL ? readdir(open) : NULL; entry != NULL && !found;
         entry = readdir(open)) { // NOLINT(concurrency-mt-unsafe)
        const bool is_dots = strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0;
        const bool is_own = state != NULL ? clx_run_owns(state, entry->d_name)
                                          : is_passing(entry->d_name) ||
                                                is_numbered(entry->d_name, "frame-", 6, ".vtu");
        found = !is_dots && !is_own;
        if (found) {
            (void)snprintf(name, 256, "%s", entry->d_name);
        }
    }
    if (open != NULL) {
        (void)closedir(open);
    }
    return found;
}

/// Moves what is not the old run's own from one folder into the other; a name that is taken there
/// gets ".old" behind it.
static clast_status carry(const char *from, const clx_run_state *state, const char *to)
{
    enum { TRIES = 100 };
    clast_status status = CLAST_OK;
    char name[256];
    char here[CLX_PATH_LIMIT];
    char there[CLX_PATH_LIMIT];
    char other[300];
    struct stat found;
    while (find_foreign(from, state, name)) {
        CLX_TRY(clx_folder_make(to));
        CLX_TRY(clx_path_join(here, from, name));
        CLX_TRY(clx_path_join(there, to, name));
        for (int k = 1; k < TRIES && lstat(there, &found) == 0; ++k) {
            (void)snprintf(other, sizeof other, k > 1 ? "%s.old%d" : "%s.old", name, k);
            CLX_TRY(clx_path_join(there, to, other));
        }
        CLX_CHECK(rename(here, there) == 0, CLAST_E_DISK, "cannot move %s to %s: %s", here, there,
                  clx_errno_text());
    }
done:
    return status;
}

/// Removes a run that is replaced. Its manifest goes last but one and its mark last, so that what a
/// kill leaves of it can be told from a run of someone else, and its files from the user's.
static clast_status remove_old(const char *old)
{
    clast_status status = CLAST_OK;
    char manifest[CLX_PATH_LIMIT];
    CLX_TRY(clx_path_join(manifest, old, MANIFEST));
    // NOLINTNEXTLINE(concurrency-mt-unsafe): one thread is at a run's folder
    CLX_CHECK(nftw(old, remove_unmarked, 16, FTW_DEPTH | FTW_PHYS) == 0, CLAST_E_DISK,
              "cannot remove %s: %s", old, clx_errno_text());
    CLX_CHECK(unlink(manifest) == 0 || errno == ENOENT, CLAST_E_DISK, "cannot remove %s: %s",
              manifest, clx_errno_text());
    CLX_TRY(clx_run_remove_tree(old));
done:
    return status;
}

/// After the exchange: the user's files go to the new run, then the old one is removed.
static clast_status clear_old(const char *old, const char *fresh)
{
    clast_status status = CLAST_OK;
    clx_run_state state = {0};
    char from[CLX_PATH_LIMIT];
    char to[CLX_PATH_LIMIT];
    CLX_TRY(clx_run_state_read(old, &state));
    CLX_TRY(carry(old, &state, fresh));
    CLX_TRY(clx_path_join(from, old, "frames"));
    CLX_TRY(clx_path_join(to, fresh, "frames"));
    CLX_TRY(carry(from, NULL, to));
    CLX_TRY(clx_folder_sync(fresh));
    CLX_TRY(remove_old(old));
done:
    clx_run_state_free(&state);
    return status;
}

enum { FEW_TRIES = 10, MOST_TRIES = 500 }; ///< of a fiftieth of a second

/// Locks an old run that is to be removed, waiting for some tries where another process is at it;
/// -1 where it is not there or the disk knows no locks. *is_busy: the other still is.
static int lock_old(const char *old, int most_tries, bool *is_busy)
{
    const struct timespec pause = {0, 20000000};
    const int descriptor = open(old, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    *is_busy = descriptor >= 0;
    for (int k = 0; k < most_tries && *is_busy; ++k) {
        *is_busy = flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
        if (*is_busy) {
            (void)nanosleep(&pause, NULL);
        }
    }
    return descriptor;
}

static void unlock_old(int descriptor)
{
    if (descriptor >= 0) {
        (void)close(descriptor); // and with it the lock
    }
}

static int exchange(const char *made, const char *old)
{
    char aside[CLX_PATH_LIMIT + 4];
#if defined SYS_renameat2
    const unsigned exchange_flag = 2; // RENAME_EXCHANGE
    if (syscall(SYS_renameat2, AT_FDCWD, made, AT_FDCWD, old, exchange_flag) == 0) {
        return 0;
    }
    if (errno != ENOSYS && errno != EINVAL) {
        return -1;
    }
#endif
    (void)snprintf(aside, sizeof aside, "%s.old", old);
    if (rename(old, aside) != 0) {
        return -1;
    }
    if (rename(made, old) != 0) {
        const int error = errno;
        (void)rename(aside, old);
        errno = error;
        return -1;
    }
    return rename(aside, made);
}

static bool is_marked(const char *folder)
{
    char mark[CLX_PATH_LIMIT];
    struct stat found;
    return clx_path_join(mark, folder, MARK) == CLAST_OK && stat(mark, &found) == 0;
}

clast_status clx_run_replace(const char *made, const char *old)
{
    clast_status status = CLAST_OK;
    char mark[CLX_PATH_LIMIT];
    struct stat found;
    bool is_busy = false;
    int lock = -1;
    if (lstat(old, &found) != 0) { // gone meanwhile
        CLX_CHECK(rename(made, old) == 0, CLAST_E_DISK, "cannot rename %s to %s: %s", made, old,
                  clx_errno_text());
        return CLAST_OK;
    }
    CLX_TRY(clx_path_join(mark, old, MARK));
    lock = lock_old(old, MOST_TRIES, &is_busy); // where it stays busy, it is replaced all the same
    status = clx_file_write_all(mark, "", 0);
    if (status != CLAST_OK) { // perhaps only the sync of its folder
        (void)unlink(mark);
        goto done;
    }
    if (exchange(made, old) != 0) {
        const int error = errno;
        (void)unlink(mark);
        status = clx_fail(CLAST_E_DISK,
                          "the new run is whole in %s, but cannot take the place of %s: %s", made,
                          old, clx_error_text(error));
        goto done;
    }
    CLX_TRY(clear_old(made, old));
done:
    unlock_old(lock);
    return status;
}

clast_status clx_run_restore(const char *folder)
{
    clast_status status = CLAST_OK;
    char aside[CLX_PATH_LIMIT + 4];
    struct stat found;
    (void)snprintf(aside, sizeof aside, "%s.old", folder);
    if (lstat(folder, &found) != 0 && is_marked(aside)) {
        CLX_CHECK(rename(aside, folder) == 0, CLAST_E_DISK, "cannot rename %s to %s: %s", aside,
                  folder, clx_errno_text());
    }
done:
    return status;
}

clast_status clx_run_replace_recover(const char *made, const char *old)
{
    clast_status status = CLAST_OK;
    char line[CLX_RUN_LINE];
    clx_run_state state = {0};
    char name[256];
    struct stat found;
    bool is_busy = false;
    int lock = -1;
    status = clx_run_state_read(made, &state); // before the lock, which it would see
    lock = lock_old(made, is_marked(made) ? MOST_TRIES : FEW_TRIES, &is_busy);
    if (lstat(made, &found) != 0) { // gone meanwhile, perhaps while it was read
        status = CLAST_OK;
        goto done;
    }
    CLX_TRY(status);
    clx_run_state_line(made, &state, line);
    if (is_marked(made) && !is_busy) {
        CLX_TRY(clear_old(made, old));
        goto done;
    }
    CLX_CHECK(!state.is_running, CLAST_E_DISK, "%s; it will replace %s", line, old);
    CLX_CHECK(!is_busy, CLAST_E_DISK, "%s: another process is there; it will replace %s", made,
              old);
    const bool is_empty = !state.is_run && !find_foreign(made, NULL, name); // cut off at once
    CLX_CHECK(is_empty || strcmp(state.replaces, clx_path_name(old)) == 0, CLAST_E_USAGE,
              "%s is in the way: a run that replaces %s is made there; move it", made, old);
    CLX_CHECK(!state.can_resume, CLAST_E_USAGE, "%s; or remove %s", line, made);
    if (state.is_whole) {
        CLX_TRY(clx_run_replace(made, old));
    } else {
        CLX_TRY(clx_run_remove_tree(made));
    }
done:
    clx_run_state_free(&state);
    unlock_old(lock);
    return status;
}
