// The folder of a study: what it is, and where its runs lie.
#include "study/study.h"

#include "base/alloc.h"
#include "base/file.h"
#include "base/lock.h"
#include "base/path.h"
#include "run/run.h"
#include <clast/table.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { STUDY_LIMIT = 1 << 28 };

/// A study is kept in some milliseconds, and the time that the digests of its inputs take [s].
static const double keep_patience = 300.0;

clast_status clx_study_run_folder(const char *folder, int64_t row, const char *suffix,
                                  char path[CLX_PATH_LIMIT])
{
    CLAST_ASSERT(row >= 0);
    char name[64];
    (void)snprintf(name, sizeof name, "runs/%06lld%s", (long long)row + 1, suffix);
    return clx_path_join(path, folder, name);
}

bool clx_study_is_done(const char *folder, int64_t row)
{
    char path[CLX_PATH_LIMIT];
    struct stat found;
    return clx_study_run_folder(folder, row, "", path) == CLAST_OK && stat(path, &found) == 0;
}

clast_status clx_study_write_exit(const char *run_folder, int exit_code)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    char text[32];
    CLX_TRY(clx_path_join(path, run_folder, "exit_code"));
    (void)snprintf(text, sizeof text, "%d\n", exit_code);
    CLX_TRY(clx_file_write_all(path, text, strlen(text)));
done:
    return status;
}

clast_status clx_study_note_signal(const char *run_folder, int exit_code)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    const int number = exit_code - 128;
    if (number <= 0) {
        return CLAST_OK;
    }
    CLX_TRY(clx_path_join(path, run_folder, "messages.txt"));
    FILE *file = fopen(path, "ae");
    CLX_CHECK(file != NULL, CLAST_E_DISK, "cannot write %s: %s", path, clx_errno_text());
    (void)fprintf(file, "clast study: the run was ended by signal %d%s\n", number,
                  number == SIGKILL ? " (the system's or a job's memory limit? see --max-memory)"
                                    : "");
    CLX_CHECK(fclose(file) == 0, CLAST_E_DISK, "cannot write %s: %s", path, clx_errno_text());
done:
    return status;
}

/// Names the folder `whole` where a run's messages name `part`, in which it worked.
static clast_status rename_in_messages(const char *part, const char *whole)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    char *text = NULL;
    int64_t n = 0;
    clx_file file = {0};
    CLX_TRY(clx_path_join(path, part, "messages.txt"));
    if (access(path, F_OK) != 0) {
        goto done;
    }
    CLX_TRY(clx_file_read_all(path, STUDY_LIMIT, &text, &n));
    const char *at = text;
    const char *found = strstr(at, part);
    if (found == NULL) {
        goto done;
    }
    CLX_TRY(clx_file_begin(path, &file));
    for (; found != NULL; found = strstr(at, part)) {
        CLX_TRY(clx_file_write(&file, at, (size_t)(found - at)));
        CLX_TRY(clx_file_write(&file, whole, strlen(whole)));
        at = found + strlen(part);
    }
    CLX_TRY(clx_file_write(&file, at, (size_t)(text + n - at)));
    CLX_TRY(clx_file_commit(&file));
done:
    clx_file_abandon(&file);
    clx_free(text);
    return status;
}

clast_status clx_study_make_whole(const char *part, const char *whole)
{
    clast_status status = CLAST_OK;
    CLX_TRY(rename_in_messages(part, whole));
    CLX_CHECK(rename(part, whole) == 0, CLAST_E_DISK, "cannot rename %s: %s", part,
              clx_errno_text());
done:
    return status;
}

/// Writes `text` as the file, or checks that the file holds it.
static clast_status write_text(const char *folder, const char *name, const char *text, size_t n)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    char *old = NULL;
    int64_t n_old = 0;
    CLX_TRY(clx_path_join(path, folder, name));
    if (access(path, F_OK) != 0) {
        return clx_file_write_all(path, text, n);
    }
    CLX_TRY(clx_file_read_all(path, STUDY_LIMIT, &old, &n_old));
    CLX_CHECK((size_t)n_old == n && memcmp(old, text, n) == 0, CLAST_E_USAGE,
              "%s holds another study (%s differs); give another folder by -o", folder, name);
done:
    clx_free(old);
    return status;
}

/// The results of a single run lie in a folder of their own.
static clast_status check_free(const char *folder)
{
    clast_status status = CLAST_OK;
    clx_run_state state = {0};
    CLX_TRY(clx_run_state_read(folder, &state));
    CLX_CHECK(state.is_study || !state.is_run, CLAST_E_USAGE,
              "%s holds a run; give another folder by -o", folder);
done:
    clx_run_state_free(&state);
    return status;
}

/// Writes the plan, or checks that the folder holds the same: but for the table nothing of a study
/// that is the same can make another.
static clast_status write_plan(const clast_study_config *config, const char *folder,
                               const clast_table *plan)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    char name[64];
    char *text = NULL;
    int64_t n = 0;
    (void)snprintf(name, sizeof name, "plan-%ld.csv", (long)getpid());
    CLX_GUARD(clx_path_join(path, folder, name));
    CLX_TRY(clast_table_write_csv(plan, path));
    CLX_TRY(clx_file_read_all(path, STUDY_LIMIT, &text, &n));
    status = write_text(folder, "plan.csv", text, (size_t)n);
    if (status == CLAST_E_USAGE && config->table[0] != '\0') {
        clx_fail_prefix("%s is not the table that this study was begun with", config->table);
    }
done:
    (void)unlink(path);
    clx_free(text);
    return status;
}

clast_status clx_study_store(const clast_study_config *config, const char *folder,
                             const clast_table *plan)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    clx_study_record record = {0};
    clx_lock lock = {0};
    bool is_busy = false;
    CLX_TRY(check_free(folder));
    CLX_TRY(clx_path_join(path, folder, "runs"));
    CLX_TRY(clx_folder_make(path));
    CLX_TRY(clx_path_join(path, folder, "study")); // another study may begin in this moment
    CLX_TRY(clx_lock_acquire(path, keep_patience, &lock, &is_busy));
    CLX_TRY(clx_study_record_read(config, folder, &record));
    const bool is_new = record.before == NULL;
    if (is_new) { // study.json first: the folder is a study's from then on
        CLX_TRY(clx_study_record_update(config, folder, plan, &record));
    }
    CLX_TRY(write_plan(config, folder, plan));
    if (!is_new) {
        CLX_TRY(clx_study_record_update(config, folder, plan, &record));
    }
done:
    clx_lock_release(&lock);
    clx_study_record_free(&record);
    return status;
}
