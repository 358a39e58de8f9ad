// The order of work of a study: which runs are open, who is busy, what became of each.
//
// A run works in runs/NNNNNN.part; the rename to runs/NNNNNN is what makes it whole, so a study may
// be killed at any moment and go on.
#include "study/study.h"

#include "base/alloc.h"
#include "base/file.h"
#include "io/folder.h"
#include <clast/parallel.h>
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/// A study under way.
typedef struct {
    const clast_study_config *config;
    const char *folder;
    const clast_study_worker *worker;
    const clast_monitor *monitor;
    clast_study_report *report;
    const clast_table *plan;
    int64_t shard, n_shard; ///< this call does rows shard, shard + n_shard, ...
    int32_t n_busy;
} scheduler;

static clast_status parse_shard(const char *text, int64_t *shard, int64_t *n_shard)
{
    clast_status status = CLAST_OK;
    long long k = 1;
    long long n = 1;
    if (text[0] != '\0') {
        char *slash = NULL;
        char *end = NULL;
        k = strtoll(text, &slash, 10);
        n = *slash == '/' ? strtoll(slash + 1, &end, 10) : 0;
        CLX_CHECK(end != NULL && end > slash + 1 && *end == '\0' && k >= 1 && k <= n,
                  CLAST_E_CONFIG, "shard takes K/N with K from 1 to N, not '%s'", text);
    }
    *shard = k - 1;
    *n_shard = n;
done:
    return status;
}

static int remove_entry(const char *path, const struct stat *found, int kind, struct FTW *place)
{
    (void)found;
    (void)kind;
    (void)place;
    return remove(path);
}

/// Removes what a run that was cut off left: runs/NNNNNN.part, without following links.
static clast_status remove_part(const char *path)
{
    clast_status status = CLAST_OK;
    struct stat found;
    if (lstat(path, &found) != 0) {
        return CLAST_OK;
    }
    // NOLINTNEXTLINE(concurrency-mt-unsafe): one thread schedules a study
    CLX_CHECK(nftw(path, remove_entry, 16, FTW_DEPTH | FTW_PHYS) == 0, CLAST_E_DISK,
              "cannot remove %s: %s", path, clx_errno_text());
done:
    return status;
}

/// True when the cut-off run left a checkpoint to go on from.
static bool has_checkpoint(const char *run_folder)
{
    char out[CLX_STUDY_PATH];
    clx_folder inside = {0};
    bool found = false;
    if (snprintf(out, sizeof out, "%s/out", run_folder) < (int)sizeof out &&
        clx_folder_list(out, &inside) == CLAST_OK) {
        for (int32_t i = 0; i < inside.n; ++i) {
            found = found || strncmp(inside.name[i], "checkpoint-", 11) == 0;
        }
    }
    clx_folder_free(&inside);
    return found;
}

static clast_status start(scheduler *s, int64_t row)
{
    clast_status status = CLAST_OK;
    char folder[CLX_STUDY_PATH];
    clast_text_list words = {0};
    CLX_TRY(clx_study_run_folder(s->folder, row, ".part", folder));
    const bool resume = s->worker->has_folder && s->worker->has_resume && has_checkpoint(folder);
    if (!resume) {
        CLX_TRY(remove_part(folder));
    }
    CLX_TRY(clx_folder_make(folder));
    const clx_study_words_of shared = {s->config, s->worker, s->plan};
    CLX_TRY(clx_study_words(&shared, row, folder, resume, &words));
    const clast_study_item item = {row, folder, words.n, words.item};
    CLX_TRY(s->worker->start(s->worker->context, &item));
    ++s->n_busy;
done:
    clx_study_words_free(&words);
    return status;
}

/// Takes note of a run that ended; `stopping`: it was asked to.
static clast_status finish(scheduler *s, int64_t row, int exit_code, bool stopping)
{
    clast_status status = CLAST_OK;
    char part[CLX_STUDY_PATH];
    char whole[CLX_STUDY_PATH];
    --s->n_busy;
    if (stopping && !clx_study_is_answer(exit_code)) {
        return CLAST_OK;
    }
    CLX_TRY(clx_study_run_folder(s->folder, row, ".part", part));
    CLX_TRY(clx_study_run_folder(s->folder, row, "", whole));
    CLX_TRY(clx_study_write_exit(part, exit_code));
    if (!clx_study_is_answer(exit_code)) {
        const bool first = s->report->n_failed++ == 0 || row + 1 < s->report->first_failed;
        s->report->first_failed = first ? row + 1 : s->report->first_failed;
        return CLAST_OK;
    }
    CLX_CHECK(rename(part, whole) == 0, CLAST_E_DISK, "cannot rename %s: %s", part,
              clx_errno_text());
    ++s->report->n_done;
done:
    return status;
}

static bool asked_to_stop(const scheduler *s)
{
    return s->monitor != NULL && s->monitor->stop != NULL && s->monitor->stop(s->monitor->context);
}

static void tell(const scheduler *s, int64_t n_mine)
{
    if (s->monitor != NULL && s->monitor->report != NULL) {
        s->monitor->report(s->monitor->context, "runs", s->report->n_done + s->report->n_failed,
                           n_mine);
    }
}

/// Next row of this shard from `row` that is not whole, or n_row.
static int64_t next_open(const scheduler *s, int64_t row)
{
    while (row < s->plan->n_row && clx_study_is_done(s->folder, row)) {
        row += s->n_shard;
    }
    return row;
}

/// Keeps `n_worker` runs busy until none is open; on a stop or an error waits for those under way.
static clast_status work(scheduler *s, int32_t n_worker, int64_t n_mine)
{
    clast_status status = CLAST_OK;
    bool stopping = false;
    int64_t row = next_open(s, s->shard);
    tell(s, n_mine);
    while (s->n_busy > 0 || (row < s->plan->n_row && !stopping)) {
        int64_t ended = -1;
        int code = 0;
        while (!stopping && s->n_busy < n_worker && row < s->plan->n_row) {
            status = start(s, row);
            stopping = status != CLAST_OK;
            row = next_open(s, row + s->n_shard);
        }
        if (s->n_busy > 0) {
            const clast_status waited = s->worker->wait(s->worker->context, &ended, &code);
            status = status == CLAST_OK ? waited : status;
        }
        if (ended >= 0) {
            const clast_status ending = finish(s, ended, code, stopping);
            status = status == CLAST_OK ? ending : status;
            tell(s, n_mine);
        }
        if (!stopping && (status != CLAST_OK || asked_to_stop(s))) {
            stopping = true;
            status = status == CLAST_OK
                         ? clx_fail(CLAST_E_STOPPED, "stopped; the same call goes on")
                         : status;
            s->worker->stop(s->worker->context);
        }
    }
    return status;
}

/// Runs of this shard that are open; the report's counts of the others.
static int64_t count(scheduler *s)
{
    int64_t n_mine = 0;
    s->report->n_run = s->plan->n_row;
    for (int64_t row = 0; row < s->plan->n_row; ++row) {
        const bool done = clx_study_is_done(s->folder, row);
        const bool mine = row % s->n_shard == s->shard;
        s->report->n_before += done;
        s->report->n_other += !done && !mine;
        n_mine += !done && mine;
    }
    return n_mine;
}

clast_status clast_study_run(const clast_study_config *config, const char *folder,
                             const clast_study_worker *worker, const clast_monitor *monitor,
                             clast_study_report *report)
{
    clast_status status = CLAST_OK;
    clast_table plan = {0};
    clast_study_report made = {0};
    scheduler s = {config, folder, worker, monitor, &made, &plan, 0, 1, 0};
    const int32_t n_worker = clast_parallel_threads();
    CLX_TRY(parse_shard(config->shard, &s.shard, &s.n_shard));
    CLX_TRY(clast_study_plan(config, &plan));
    CLX_TRY(clx_study_keep(config, folder, &plan));
    const int64_t n_mine = count(&s);
    status = work(&s, n_worker, n_mine);
    const clast_status gathered = clx_study_collect(config, folder, &plan);
    CLX_TRY(status);
    CLX_TRY(gathered);
    *report = made;
    CLX_CHECK(made.n_failed == 0, CLAST_E_NO, "%lld of %lld runs failed, the first is run %lld",
              (long long)made.n_failed, (long long)made.n_run, (long long)made.first_failed);
done:
    clast_table_free(&plan);
    return status;
}
