// A run folder before its run: free, or freed of an earlier run when that was asked for.
#include "study/run_folder.h"

#include "base/alloc.h"
#include "io/checkpoint.h"
#include "io/folder.h"
#include "study/aggregate_folder.h"
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/// What runs and fits leave, but their numbered states and frames.
static const char *const left[] = {
    "achieved.csv",  "achieved.svg",    "aggregate.stl", "density.svg", "diameter.svg",
    "energy.svg",    "fit.csv",         "fit.svg",       "frames.pvd",  "grains.csv",
    "history.csv",   "history.svg",     "manifest.json", "picture.png", "printable.json",
    "printable.stl", "profile.csv",     "profile.svg",   "radial.csv",  "report.html",
    "series.csv",    "sizes.csv",       "sizes.svg",     "state.h5",    "structure.csv",
    "summary.json",  "history_band.csv"};

/// state-0002.h5 and so on.
static bool is_state(const char *name)
{
    return strncmp(name, "state-", 6) == 0 && strspn(name + 6, "0123456789") >= 4 &&
           strcmp(name + 6 + strspn(name + 6, "0123456789"), ".h5") == 0;
}

static bool is_left(const char *name)
{
    for (size_t k = 0; k < sizeof left / sizeof left[0]; ++k) {
        if (strcmp(name, left[k]) == 0) {
            return true;
        }
    }
    return is_state(name);
}

/// frames/frame-000012.vtu and so on.
static bool is_frame(const char *name)
{
    return strncmp(name, "frame-", 6) == 0 && strspn(name + 6, "0123456789") >= 6 &&
           strcmp(name + 6 + strspn(name + 6, "0123456789"), ".vtu") == 0;
}

static clast_status remove_entries(const char *folder, bool (*is_ours)(const char *name))
{
    clast_status status = CLAST_OK;
    clx_folder entries = {0};
    char path[CLX_PATH_LIMIT];
    CLX_TRY(clx_folder_list(folder, &entries));
    for (int32_t i = 0; i < entries.n; ++i) {
        if (is_ours(entries.name[i])) {
            CLX_TRY(clx_folder_join(path, folder, entries.name[i]));
            CLX_CHECK(unlink(path) == 0, CLAST_E_DISK, "cannot remove %s: %s", path,
                      clx_errno_text());
        }
    }
done:
    clx_folder_free(&entries);
    return status;
}

static clast_status remove_frames(const char *folder)
{
    clast_status status = CLAST_OK;
    char frames[CLX_PATH_LIMIT];
    struct stat found;
    CLX_TRY(clx_folder_join(frames, folder, "frames"));
    if (lstat(frames, &found) != 0 || !S_ISDIR(found.st_mode)) {
        return CLAST_OK;
    }
    CLX_TRY(remove_entries(frames, is_frame));
    // Somebody's own files in it stay.
    CLX_CHECK(rmdir(frames) == 0 || errno == ENOTEMPTY || errno == EEXIST, CLAST_E_DISK,
              "cannot remove %s: %s", frames, clx_errno_text());
done:
    return status;
}

static clast_status remove_left(const char *folder)
{
    clast_status status = CLAST_OK;
    CLX_TRY(remove_entries(folder, is_left));
    CLX_TRY(remove_frames(folder));
    CLX_TRY(clx_folder_clear_checkpoints(folder));
done:
    return status;
}

/// A manifest or a summary says that somebody's results lie here.
static bool holds_run(const char *folder)
{
    static const char *const sign[] = {"manifest.json", "summary.json", "state.h5"};
    char path[CLX_PATH_LIMIT];
    struct stat found;
    for (size_t k = 0; k < sizeof sign / sizeof sign[0]; ++k) {
        if (clx_folder_join(path, folder, sign[k]) == CLAST_OK && stat(path, &found) == 0) {
            return true;
        }
    }
    return false;
}

clast_status clx_folder_take(const char *folder, bool force)
{
    clast_status status = CLAST_OK;
    char *path = NULL;
    int64_t step = 0;
    struct stat found;
    if (stat(folder, &found) != 0) {
        return CLAST_OK; // to be made
    }
    if (force) {
        return remove_left(folder);
    }
    CLX_CHECK(clx_checkpoint_newest(folder, &path, &step, NULL) != CLAST_OK, CLAST_E_USAGE,
              "%s holds a run that has not ended; go on with --resume %s, take another folder, or "
              "replace it with --force",
              folder, folder);
    CLX_CHECK(!holds_run(folder), CLAST_E_USAGE,
              "%s holds a finished run; take another folder, or replace it with --force", folder);
done:
    clx_free(path);
    return status;
}

clast_status clx_folder_start(const char *command, const clast_monitor *monitor,
                              clast_manifest **manifest)
{
    return monitor != NULL && monitor->n_word > 0
               ? clast_manifest_create(command, monitor->n_word, monitor->word, manifest)
               : clast_manifest_create(command, 0, NULL, manifest);
}
