// What a folder holds: a whole run, one that has not ended, a study, or none.
//
// A run holds a lock on its folder while it goes (flock: the system drops it with the process,
// however that ends), so that a run under way can be told from one that was killed.
#include "run/run.h"

#include "base/alloc.h"
#include "base/file.h"
#include "base/path.h"
#include "run/checkpoint.h"
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

static bool has_file(const char *folder, const char *name)
{
    char path[CLX_PATH_LIMIT];
    struct stat found;
    return clx_path_join(path, folder, name) == CLAST_OK && stat(path, &found) == 0;
}

/// Another process, or another run of this one, holds the lock.
static bool is_locked(const char *folder)
{
    const int descriptor = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool locked =
        descriptor >= 0 && flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (descriptor >= 0) {
        (void)close(descriptor); // and with it the lock
    }
    return locked;
}

static clast_status read_manifest(const char *folder, json_t **manifest)
{
    enum { LIMIT = 64 << 20 };
    char path[CLX_PATH_LIMIT];
    char *text = NULL;
    int64_t n = 0;
    clast_status status = clx_path_join(path, folder, "manifest.json");
    status = status == CLAST_OK ? clx_file_read_all(path, LIMIT, &text, &n) : status;
    if (status == CLAST_OK) { // seeds pass 2^63
        *manifest = json_loadb(text, (size_t)n, JSON_DECODE_INT_AS_REAL, NULL);
    }
    clx_free(text);
    return status == CLAST_E_MEMORY ? status : CLAST_OK;
}

static const char *text_of(const json_t *manifest, const char *key)
{
    const char *text = json_string_value(json_object_get(manifest, key));
    return text != NULL ? text : "";
}

clast_status clx_run_state_read(const char *folder, clx_run_state *state)
{
    clast_status status = CLAST_OK;
    json_t *manifest = NULL;
    *state = (clx_run_state){
        .share = NAN, .command = "", .outcome = "", .process = "", .started = "", .replaces = ""};
    CLX_TRY(read_manifest(folder, &manifest));
    const bool has_summary = has_file(folder, "summary.json");
    const bool has_state = has_file(folder, "state.h5");
    const json_t *share = json_object_get(manifest, "progress");
    *state =
        (clx_run_state){.is_study = has_file(folder, "study.json"),
                        .is_running = is_locked(folder),
                        .can_resume = clx_checkpoint_exists(folder),
                        .has_state = has_state,
                        .share = json_is_number(share) ? json_number_value(share) : (double)NAN,
                        .command = text_of(manifest, "command"),
                        .outcome = text_of(manifest, "outcome"),
                        .process = text_of(manifest, "process"),
                        .started = text_of(manifest, "started"),
                        .replaces = text_of(manifest, "replaces"),
                        .manifest = manifest};
    state->is_run =
        has_summary || has_state || state->can_resume || has_file(folder, "manifest.json");
    // The summary is written last: a run that was killed after it lacks nothing.
    const bool is_over = state->outcome[0] == '\0' || strcmp(state->outcome, "running") == 0
                             ? has_summary || (manifest == NULL && has_state)
                             : strcmp(state->outcome, "done") == 0;
    state->is_whole = is_over && !state->is_running && !state->can_resume;
done:
    return status;
}

void clx_run_state_free(clx_run_state *state)
{
    json_decref(state->manifest);
    *state = (clx_run_state){0};
}

void clx_run_state_line(const char *folder, const clx_run_state *state, char line[CLX_RUN_LINE])
{
    char at[32] = "";
    char then[300] = "";
    if (isfinite(state->share)) {
        (void)snprintf(at, sizeof at, " at %d %%", (int)(100.0 * state->share));
    }
    if (state->replaces[0] != '\0') {
        (void)snprintf(then, sizeof then, "; at its end it takes the place of %s", state->replaces);
    }
    const char *verb = state->is_running                       ? "still running"
                       : strcmp(state->outcome, "failed") == 0 ? "failed"
                                                               : "stopped";
    if (state->is_running) {
        const bool is_known = state->process[0] != '\0';
        (void)snprintf(line, CLX_RUN_LINE, "%s: %s%s%s%s%s%s%s", folder, verb, at,
                       is_known ? " (" : "", state->process, is_known ? " since " : "",
                       is_known ? state->started : "", is_known ? ")" : "");
    } else if (state->can_resume) {
        const bool is_known = state->command[0] != '\0';
        (void)snprintf(line, CLX_RUN_LINE, "%s: %s%s, go on with %s%s%s--resume %s%s", folder, verb,
                       at, is_known ? "clast " : "", state->command, is_known ? " " : "", folder,
                       then);
    } else if (state->has_state) {
        (void)snprintf(
            line, CLX_RUN_LINE,
            "%s: %s%s, and state.h5 there is how it was then; begin it anew with --force", folder,
            verb, at);
    } else {
        (void)snprintf(line, CLX_RUN_LINE,
                       "%s: %s%s without a checkpoint; begin it anew with --force", folder, verb,
                       at);
    }
}

clast_status clast_run_folder_check(const char *folder)
{
    CLX_ARGUMENTS(folder);
    clast_status status = CLAST_OK;
    clx_run_state state = {0};
    struct stat found;
    char line[CLX_RUN_LINE];
    CLX_CHECK(stat(folder, &found) == 0, CLAST_E_IO, "cannot read the folder %s: %s", folder,
              clx_errno_text());
    CLX_CHECK(S_ISDIR(found.st_mode), CLAST_E_IO, "%s is a file, no run folder", folder);
    CLX_TRY(clx_run_state_read(folder, &state));
    CLX_CHECK(state.is_run || state.is_study, CLAST_E_IO,
              "%s is no run folder: it has no summary.json and no state.h5; name a folder that a "
              "clast command wrote",
              folder);
    clx_run_state_line(folder, &state, line);
    CLX_CHECK(state.is_whole || state.is_study, CLAST_E_IO, "%s", line);
    CLX_CHECK(!state.is_study || has_file(folder, "results.csv"), CLAST_E_IO,
              "%s: a study that has not ended; the same clast study command goes on with it",
              folder);
done:
    clx_run_state_free(&state);
    return status;
}

/// RUN/state.h5 of a run that has not ended is not there yet: says so, as RUN alone does.
static clast_status check_absent_state(const char *argument)
{
    clast_status status = CLAST_OK;
    char folder[CLAST_RUN_PATH];
    const char *slash = strrchr(argument, '/');
    const int n = slash != NULL ? (int)(slash - argument) : 0;
    if (slash == NULL || strcmp(slash + 1, "state.h5") != 0 || n == 0 || n >= CLAST_RUN_PATH) {
        return CLAST_OK;
    }
    (void)snprintf(folder, sizeof folder, "%.*s", n, argument);
    if (has_file(folder, "manifest.json")) {
        CLX_TRY(clast_run_folder_check(folder));
    }
done:
    return status;
}

clast_status clast_run_folder_state(const char *argument, char path[CLAST_RUN_PATH])
{
    CLX_ARGUMENTS(argument, path);
    clast_status status = CLAST_OK;
    clx_run_state state = {0};
    struct stat found;
    const bool is_there = stat(argument, &found) == 0;
    if (!is_there) {
        CLX_TRY(check_absent_state(argument));
    }
    if (!is_there || !S_ISDIR(found.st_mode)) {
        const int n = snprintf(path, CLAST_RUN_PATH, "%s", argument);
        CLX_CHECK(n > 0 && n < CLAST_RUN_PATH, CLAST_E_IO, "%.60s...: the path is too long",
                  argument);
        return CLAST_OK;
    }
    CLX_TRY(clast_run_folder_check(argument));
    CLX_TRY(clx_path_join(path, argument, "state.h5"));
    CLX_TRY(clx_run_state_read(argument, &state));
    CLX_CHECK(!state.is_study, CLAST_E_IO,
              "%s is the folder of a study; name one of its runs, such as %s/runs/000001/out",
              argument, argument);
    CLX_CHECK(has_file(argument, "state.h5"), CLAST_E_IO,
              "%s is a run of clast %s, which leaves no grains (no state.h5)", argument,
              state.command[0] != '\0' ? state.command : "(unknown)");
done:
    clx_run_state_free(&state);
    return status;
}
