// A run's folder from its taking to its end.
#include "run/run.h"

#include "base/alloc.h"
#include "base/file.h"
#include "base/path.h"
#include "io/folder.h"
#include <clast/table.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

struct clast_run_folder {
    char *folder;   ///< that was asked for, without '/' at its end
    char *path;     ///< where the run is made: folder, or FOLDER.new
    bool is_beside; ///< path takes the place of folder at the end
    bool is_resumed, is_open;
    bool is_again;  ///< the folder holds a run of the same command that left nothing
    bool is_sealed; ///< its files are whole and listed
    int lock;       ///< descriptor of the folder, or -1
    char *command;
    clast_manifest *manifest;
    json_t *earlier;   ///< "inputs" of the manifest that a resumed run left, or NULL
    clx_folder others; ///< what lay in the folder before
};

static void unlock(clast_run_folder *run)
{
    if (run->lock >= 0) {
        (void)close(run->lock);
    }
    run->lock = -1;
}

void clast_run_folder_destroy(clast_run_folder *run)
{
    if (run == NULL) {
        return;
    }
    unlock(run);
    clast_manifest_destroy(run->manifest);
    json_decref(run->earlier);
    clx_folder_free(&run->others);
    CLX_FREE(run->folder, run->path, run->command, run);
}

clast_manifest *clast_run_folder_manifest(clast_run_folder *run)
{
    if (run == NULL) {
        return NULL;
    }
    return run->manifest;
}

const char *clast_run_folder_path(const clast_run_folder *run)
{
    if (run == NULL) {
        return NULL;
    }
    return run->path;
}

clast_status clast_run_folder_file(const clast_run_folder *run, const char *name,
                                   char path[CLAST_RUN_PATH])
{
    CLX_ARGUMENTS(run, name, path);
    return clx_path_join(path, run->path, name);
}

static clast_status write_summary(const char *folder, const char *text)
{
    char path[CLX_PATH_LIMIT];
    const clast_status status = clx_path_join(path, folder, "summary.json");
    return status == CLAST_OK ? clx_file_write_line(path, text) : status;
}

clast_status clast_run_folder_summary(const clast_run_folder *run, const char *text)
{
    CLX_ARGUMENTS(run, text);
    return write_summary(run->path, text);
}

clast_status clx_run_write_summary(const char *folder, clast_status made, char *text)
{
    const clast_status status = made == CLAST_OK ? write_summary(folder, text) : made;
    clast_text_free(text);
    return status;
}

clast_status clx_run_write_table(const char *folder, const char *name, const clast_table *table)
{
    char path[CLX_PATH_LIMIT];
    const clast_status status = clx_path_join(path, folder, name);
    return status == CLAST_OK ? clast_table_write_csv(table, path) : status;
}

static clast_status copy_path(const char *path, char **copy)
{
    const clast_status status = clx_alloc_text(copy, path);
    for (size_t n = strlen(path); status == CLAST_OK && n > 1 && (*copy)[n - 1] == '/'; --n) {
        (*copy)[n - 1] = '\0';
    }
    return status;
}

static clast_status create(const char *folder, const char *command, const clast_monitor *monitor,
                           clast_run_folder **run)
{
    clast_status status = CLAST_OK;
    clast_run_folder *made = NULL;
    const bool has_words = monitor != NULL && monitor->n_word > 0;
    CLX_TRY(clx_alloc(&made, 1, sizeof *made));
    made->lock = -1;
    CLX_TRY(copy_path(folder, &made->folder));
    CLX_TRY(copy_path(folder, &made->path));
    CLX_TRY(clx_alloc_text(&made->command, command));
    CLX_TRY(clast_manifest_create(command, has_words ? monitor->n_word : 0,
                                  has_words ? monitor->word : NULL, &made->manifest));
    *run = made;
    made = NULL;
done:
    clast_run_folder_destroy(made);
    return status;
}

/// The folder above a path: its text, or the working folder.
static clast_status find_parent(const char *path, char parent[CLX_PATH_LIMIT])
{
    const int n = (int)(clx_path_name(path) - path);
    return n > 0 ? clx_path_join(parent, path, "..") : clx_path_join(parent, ".", "");
}

/// Before hours of work: the folder can be written into, or made in the nearest one that is there.
static clast_status check_writable(const char *folder)
{
    clast_status status = CLAST_OK;
    char *at = NULL;
    struct stat found;
    CLX_TRY(clx_alloc_text(&at, folder));
    while (stat(at, &found) != 0) {
        CLX_CHECK(errno == ENOENT, CLAST_E_DISK, "cannot make folder %s: %s", folder,
                  clx_errno_text());
        char *slash = strrchr(at, '/');
        if (slash == NULL || slash == at) {
            at[0] = slash == NULL ? '.' : '/';
            at[1] = '\0';
        } else {
            *slash = '\0';
        }
    }
    CLX_CHECK(S_ISDIR(found.st_mode), CLAST_E_DISK, "cannot make folder %s: %s is a file", folder,
              at);
    CLX_CHECK(access(at, W_OK | X_OK) == 0, CLAST_E_DISK, "cannot write into the folder %s: %s", at,
              clx_errno_text());
done:
    clx_free(at);
    return status;
}

/// A name whose last part says which folder is meant: links, "." and ".." are followed.
static clast_status resolve(clast_run_folder *run)
{
    clast_status status = CLAST_OK;
    char *real = NULL;
    const char *name = clx_path_name(run->folder);
    struct stat found;
    const bool is_link = lstat(run->folder, &found) == 0 && S_ISLNK(found.st_mode);
    if (is_link || strcmp(name, ".") == 0 || strcmp(name, "..") == 0 || name[0] == '\0') {
        real = realpath(run->folder, NULL);
        CLX_CHECK(real != NULL, CLAST_E_DISK, "cannot find %s: %s", run->folder, clx_errno_text());
        clx_free(run->folder);
        run->folder = NULL;
        CLX_TRY(clx_alloc_text(&run->folder, real));
    }
done:
    free(real); // the system's
    return status;
}

static bool is_within(const char *path, const char *folder)
{
    const size_t n = strlen(folder);
    return strncmp(path, folder, n) == 0 && (path[n] == '/' || path[n] == '\0');
}

/// The new run will be made beside the old one; all that could stop it at its end is asked now.
static clast_status prepare_beside(clast_run_folder *run)
{
    clast_status status = CLAST_OK;
    char parent[CLX_PATH_LIMIT];
    char beside[CLX_PATH_LIMIT];
    char here[CLX_PATH_LIMIT] = "";
    char *real = NULL;
    struct stat inside;
    struct stat above;
    CLX_TRY(resolve(run));
    real = realpath(run->folder, NULL);
    CLX_TRY(find_parent(run->folder, parent));
    CLX_CHECK(real != NULL && stat(run->folder, &inside) == 0 && stat(parent, &above) == 0,
              CLAST_E_DISK, "cannot find %s: %s", run->folder, clx_errno_text());
    CLX_CHECK(getcwd(here, sizeof here) == NULL || !is_within(here, real), CLAST_E_USAGE,
              "the run in %s cannot be replaced from inside its folder: go to the one above", real);
    CLX_CHECK(inside.st_dev == above.st_dev, CLAST_E_USAGE,
              "%s is a disk of its own, which cannot change places with another folder: give a "
              "folder in it",
              run->folder);
    CLX_CHECK(access(parent, W_OK | X_OK) == 0, CLAST_E_DISK,
              "cannot replace the run in %s: a new one is made beside it, and the folder above "
              "cannot be written into: %s",
              run->folder, clx_errno_text());
    CLX_CHECK(snprintf(beside, sizeof beside, "%s.new", run->folder) < (int)sizeof beside,
              CLAST_E_DISK, "the path %.60s... is too long", run->folder);
    CLX_TRY(clx_run_replace_recover(beside, run->folder));
    clx_free(run->path);
    run->path = NULL;
    CLX_TRY(clx_alloc_text(&run->path, beside));
    run->is_beside = true;
done:
    free(real); // the system's
    return status;
}

/// Whether a process at the folder would be seen: some disks have no locks.
static bool knows_locks(const char *folder)
{
    const int descriptor = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool is_locked = descriptor >= 0 && flock(descriptor, LOCK_SH | LOCK_NB) == 0;
    if (descriptor >= 0) {
        (void)close(descriptor); // and with it the lock
    }
    return is_locked;
}

/// Whether a run of this command was cut off before it had written anything but its manifest: to
/// begin it anew, as a queue does with the same words, takes nothing away.
static bool has_left_nothing(const clast_run_folder *run, const clx_run_state *state)
{
    const bool is_cut_off =
        strcmp(state->outcome, "running") == 0 || strcmp(state->outcome, "stopped") == 0;
    clx_folder there = {0};
    const bool is_empty = is_cut_off && !state->is_running && knows_locks(run->folder) &&
                          strcmp(state->command, run->command) == 0 &&
                          clx_folder_list(run->folder, &there) == CLAST_OK && there.n == 1 &&
                          strcmp(there.name[0], "manifest.json") == 0;
    clx_folder_free(&there);
    return is_empty;
}

/// Makes sure that no earlier run is overwritten or mixed in.
static clast_status claim_folder(clast_run_folder *run, bool force)
{
    clast_status status = CLAST_OK;
    char line[CLX_RUN_LINE];
    clx_run_state state = {0};
    CLX_TRY(clx_run_restore(run->folder));
    CLX_TRY(check_writable(run->folder));
    CLX_TRY(clx_run_state_read(run->folder, &state));
    clx_run_state_line(run->folder, &state, line);
    CLX_CHECK(!state.is_study, CLAST_E_USAGE, "%s holds a study; take another folder", run->folder);
    CLX_CHECK(!state.is_running, CLAST_E_DISK, "%s; take another folder", line);
    run->is_again = state.is_run && has_left_nothing(run, &state);
    if (state.is_run && force) {
        run->is_again = false;
        CLX_TRY(prepare_beside(run));
    } else if (state.is_run && !run->is_again) {
        CLX_CHECK(!state.is_whole, CLAST_E_USAGE,
                  "%s holds a finished run; take another folder, or replace it with --force",
                  run->folder);
        CLX_CHECK(!state.can_resume, CLAST_E_USAGE,
                  "%s; or take another folder, or replace it with --force", line);
        status = clx_fail(CLAST_E_USAGE, "%s", line);
    }
done:
    clx_run_state_free(&state);
    return status;
}

clast_status clast_run_folder_begin(const char *folder, bool force, const char *command,
                                    const clast_monitor *monitor, clast_run_folder **run)
{
    CLX_ARGUMENTS(folder, command, run);
    clast_status status = CLAST_OK;
    clast_run_folder *made = NULL;
    CLX_CHECK(folder[0] != '\0', CLAST_E_USAGE, "the output folder has no name");
    CLX_TRY(create(folder, command, monitor, &made));
    CLX_TRY(claim_folder(made, force));
    *run = made;
    made = NULL;
done:
    clast_run_folder_destroy(made);
    return status;
}

clast_status clast_run_folder_input(clast_run_folder *run, const char *role, const char *path)
{
    CLX_ARGUMENTS(run, role, path);
    clast_status status = CLAST_OK;
    clx_run_state state = {0};
    char *file = realpath(path, NULL);
    char *folder = run->is_beside ? realpath(run->folder, NULL) : NULL;
    if (file != NULL && folder != NULL && is_within(file, folder)) {
        char *name = file + strlen(folder) + (file[strlen(folder)] == '/');
        name[strcspn(name, "/")] = '\0';
        CLX_TRY(clx_run_state_read(run->folder, &state));
        CLX_CHECK(!clx_run_owns(&state, name), CLAST_E_USAGE,
                  "%s belongs to the run that would be replaced: take another output folder", path);
    }
    CLX_TRY(clast_manifest_input(run->manifest, role, path));
    CLX_TRY(clx_manifest_check_input(run->manifest, run->earlier));
done:
    clx_run_state_free(&state);
    free(file); // the system's, both
    free(folder);
    return status;
}

static clast_status write_manifest(const clast_run_folder *run, const char *outcome)
{
    char path[CLX_PATH_LIMIT];
    const clast_status status = clx_path_join(path, run->path, "manifest.json");
    return status == CLAST_OK ? clast_manifest_write(run->manifest, outcome, path) : status;
}

/// Whether nobody has moved the locked folder or ended a run in it since begin looked.
static bool is_as_found(const clast_run_folder *run)
{
    char manifest[CLX_PATH_LIMIT];
    struct stat held;
    struct stat there;
    if (run->lock >= 0 && (fstat(run->lock, &held) != 0 || stat(run->path, &there) != 0 ||
                           held.st_dev != there.st_dev || held.st_ino != there.st_ino)) {
        return false;
    }
    return run->is_resumed || run->is_again ||
           (clx_path_join(manifest, run->path, "manifest.json") == CLAST_OK &&
            stat(manifest, &there) != 0);
}

/// Says to others that a process is at the folder. Disks that know no locks go without.
static clast_status lock_folder(clast_run_folder *run)
{
    clast_status status = CLAST_OK;
    const struct timespec pause = {0, 20000000};
    run->lock = open(run->path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool is_gone = run->lock < 0 && errno == ENOENT;
    bool is_busy = true;
    for (int tries = 0; tries < 10 && is_busy && run->lock >= 0;
         ++tries) { // readers ask in passing
        is_busy = flock(run->lock, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
        if (is_busy) {
            (void)nanosleep(&pause, NULL);
        }
    }
    CLX_CHECK(!is_gone && (run->lock < 0 || !is_busy) && is_as_found(run), CLAST_E_DISK,
              "%s: another process has begun a run there; take another folder", run->path);
done:
    return status;
}

/// The entries that are not this run's: all that are there; for a resumed one those that no run of
/// its command writes.
static clast_status note_others(clast_run_folder *run)
{
    clast_status status = CLAST_OK;
    const clx_run_state none = {0};
    int32_t n = 0;
    CLX_TRY(clx_folder_list(run->path, &run->others));
    for (int32_t i = 0; i < run->others.n; ++i) {
        if (run->is_resumed && clx_run_owns(&none, run->others.name[i])) {
            clx_free(run->others.name[i]);
        } else {
            run->others.name[n++] = run->others.name[i];
        }
    }
    run->others.n = n;
done:
    return status;
}

clast_status clast_run_folder_open(clast_run_folder *run)
{
    CLX_ARGUMENTS(run);
    clast_status status = CLAST_OK;
    char old_manifest[CLX_PATH_LIMIT];
    struct stat old;
    bool is_taken = false;
    CLX_TRY(clx_folder_make(run->path));
    CLX_TRY(lock_folder(run));
    is_taken = true;
    if (run->is_beside) {
        if (!run->is_resumed && stat(run->folder, &old) == 0) {
            (void)chmod(run->path, old.st_mode & 07777); // as far as the disk allows
        }
        CLX_TRY(clast_manifest_note(run->manifest, "replaces", clx_path_name(run->folder)));
    }
    if ((run->is_resumed || run->is_again) && run->lock >= 0) {
        clx_run_remove_temporaries(run->path);
    }
    if (run->is_again) { // as if it had not been there: it is listed with the others else
        (void)clast_run_folder_file(run, "manifest.json", old_manifest);
        (void)unlink(old_manifest);
    }
    CLX_TRY(note_others(run));
    CLX_TRY(write_manifest(run, "running"));
    run->is_open = true;
done:
    if (status != CLAST_OK && is_taken && run->is_beside && !run->is_resumed) {
        (void)clx_run_remove_tree(run->path); // made here, and no other process's
    }
    return status;
}

clast_status clx_run_folder_resume(const char *folder, const char *command,
                                   const clast_monitor *monitor, clast_run_folder **run)
{
    clast_status status = CLAST_OK;
    clx_run_state state = {0};
    clast_run_folder *made = NULL;
    char line[CLX_RUN_LINE];
    char target[CLX_PATH_LIMIT];
    CLX_TRY(clx_run_state_read(folder, &state));
    clx_run_state_line(folder, &state, line);
    CLX_CHECK(!state.is_running, CLAST_E_DISK, "%s; go on with it when that has ended", line);
    CLX_CHECK(state.command[0] == '\0' || strcmp(state.command, command) == 0, CLAST_E_USAGE,
              "%s is a run of clast %s, not of %s", folder, state.command, command);
    CLX_TRY(create(folder, command, monitor, &made));
    made->is_resumed = true;
    made->earlier = json_incref(json_object_get(state.manifest, "inputs"));
    CLX_TRY(clast_manifest_note(made->manifest, "resumed", "yes"));
    clx_manifest_progress(made->manifest, isfinite(state.share) ? state.share : 0.0);
    if (state.replaces[0] != '\0' && !state.is_whole) {
        CLX_TRY(resolve(made));
        const int n = (int)(clx_path_name(made->folder) - made->folder);
        CLX_CHECK(snprintf(target, sizeof target, "%.*s%s", n, made->folder, state.replaces) <
                      (int)sizeof target,
                  CLAST_E_DISK, "the path %.60s... is too long", folder);
        clx_free(made->folder);
        made->folder = NULL;
        CLX_TRY(clx_alloc_text(&made->folder, target));
        made->is_beside = true;
    }
    *run = made;
    made = NULL;
done:
    clx_run_state_free(&state);
    clast_run_folder_destroy(made);
    return status;
}

clast_status clx_run_folder_progress(clast_run_folder *run, double share)
{
    clx_manifest_progress(run->manifest, fmin(fmax(share, 0.0), 0.99));
    return write_manifest(run, "running");
}

/// Keeps the names of what the run has written.
static clast_status note_outputs(clast_run_folder *run)
{
    clast_status status = CLAST_OK;
    clx_folder now = {0};
    int32_t k = 0; // both lists are sorted
    CLX_TRY(clx_folder_list(run->path, &now));
    for (int32_t i = 0; i < now.n; ++i) {
        while (k < run->others.n && strcmp(run->others.name[k], now.name[i]) < 0) {
            ++k;
        }
        if (k == run->others.n || strcmp(run->others.name[k], now.name[i]) != 0) {
            CLX_TRY(clx_manifest_output(run->manifest, now.name[i]));
        }
    }
done:
    clx_folder_free(&now);
    return status;
}

clast_status clx_run_folder_seal(clast_run_folder *run)
{
    clast_status status = CLAST_OK;
    if (run != NULL && run->is_open && !run->is_sealed) {
        run->is_sealed = true;
        CLX_TRY(note_outputs(run));
        CLX_TRY(write_manifest(run, "done"));
    }
done:
    return status;
}

const char *clx_run_folder_place(const clast_run_folder *run)
{
    return run != NULL ? run->folder : NULL;
}

/// After that: the run takes its place.
static clast_status settle(clast_run_folder *run)
{
    clast_status status = CLAST_OK;
    if (run->is_beside) { // locked until it is there: another could begin in it else
        CLX_TRY(clx_run_replace(run->path, run->folder));
        clx_free(run->path);
        run->path = NULL;
        CLX_TRY(copy_path(run->folder, &run->path));
    }
done:
    unlock(run);
    return status;
}

/// Stopped or failed: says how to go on, or where what did not come to its end is, or removes a new
/// run that would have replaced another.
static clast_status end_badly(clast_run_folder *run, clast_status status)
{
    char why[1024];
    char line[CLX_RUN_LINE];
    clx_run_state state = {0};
    (void)snprintf(why, sizeof why, "%s", clast_error_detail());
    const bool is_stopped = status == CLAST_E_STOPPED;
    if (run->is_sealed || note_outputs(run) == CLAST_OK) {
        (void)write_manifest(run, is_stopped ? "stopped" : "failed");
    }
    unlock(run);
    (void)clx_run_state_read(run->path, &state);
    clx_run_state_line(run->path, &state, line);
    const bool can_go_on =
        state.can_resume && (is_stopped || status == CLAST_E_DISK || status == CLAST_E_MEMORY);
    if (status == CLAST_E_CONVERGE && state.has_state && !state.can_resume) {
        (void)clx_fail(status, "%s; what there is until then is in %s", why, run->path);
    } else if (run->is_beside && !can_go_on) {
        (void)clx_run_remove_tree(run->path);
        (void)clx_fail(status, "%s", why);
    } else if (can_go_on) {
        (void)(is_stopped ? clx_fail(status, "%s", line) : clx_fail(status, "%s; %s", why, line));
    } else {
        (void)clx_fail(status, "%s", why);
    }
    clx_run_state_free(&state);
    return status;
}

clast_status clast_run_folder_end(clast_run_folder *run, clast_status status)
{
    if (run == NULL || !run->is_open) {
        return status;
    }
    status = status == CLAST_OK ? clx_run_folder_seal(run) : status;
    run->is_open = false;
    return status == CLAST_OK ? settle(run) : end_badly(run, status);
}

/// Whether a study's folder has its own of that name.
static bool study_owns(const char *name)
{
    static const char *const own[] = {"study.json", "plan.csv", "results.csv", "times.csv", "runs"};
    for (size_t k = 0; k < sizeof own / sizeof *own; ++k) {
        if (strcmp(name, own[k]) == 0) {
            return true;
        }
    }
    return false;
}

bool clx_run_folder_owns(const char *path)
{
    enum { ABOVE = 3 }; // repeat-0001/frames/frame-000001.vtu
    bool is_owned = false;
    char *file = path != NULL ? realpath(path, NULL) : NULL;
    char *slash = file != NULL ? strrchr(file, '/') : NULL;
    for (int k = 0; k < ABOVE && slash != NULL && slash > file && !is_owned; ++k) {
        clx_run_state state = {0};
        *slash = '\0'; // the folder; below it, a name
        char *name = slash + 1;
        name[strcspn(name, "/")] = '\0';
        if (strcmp(name, "report.html") != 0 && clx_run_state_read(file, &state) == CLAST_OK) {
            is_owned = (state.is_run && clx_run_owns(&state, name)) ||
                       (state.is_study && study_owns(name));
        }
        clx_run_state_free(&state);
        slash = strrchr(file, '/');
    }
    free(file); // the system's
    return is_owned;
}
