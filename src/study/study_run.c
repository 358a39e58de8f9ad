// The order of work of a study: which runs are open, who is busy, what became of each.
//
// A run works in runs/NNNNNN.part; the rename to runs/NNNNNN is what makes it whole, so a study may
// be killed at any moment and go on. Ranks share rows by a queue; rank 0 keeps plan and tables.
#include "study/study.h"

#include "base/alloc.h"
#include "base/clock.h"
#include "base/comm.h"
#include "base/file.h"
#include "base/lock.h"
#include "base/monitor.h"
#include "base/path.h"
#include "base/queue.h"
#include "run/checkpoint.h"
#include "run/run.h"
#include <clast/machine.h>
#include <clast/table.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/// A run that this process does, and no other study beside it.
typedef struct {
    int64_t row;
    clx_lock lock;
} taken_row;

/// A study under way on one rank.
typedef struct {
    const clast_study_config *config;
    const char *folder;
    const clast_study_worker *worker;
    const clast_monitor *monitor;
    clast_study_report *report; ///< rank 0 counts for all
    const clast_table *plan;
    int64_t shard, n_shard; ///< this call does rows shard, shard + n_shard, ...
    int64_t n_mine;         ///< of these that are open
    bool has_checked_kept;  ///< a run has shown whether the names of `keep` are misspelt
    int32_t n_busy;         ///< of this rank
    clx_queue queue;        ///< item i is row shard + i n_shard
    taken_row *taken;       ///< [n_busy] that this rank has begun
    int64_t capacity;
} scheduler;

/// For how long a run whose study was killed may take to end itself, with its checkpoint [s].
static const double orphan_patience = 30.0;

/// Codes of a run that was asked to stop and has no answer, and of one that another study does.
enum { CUT_OFF = -1, ELSEWHERE = -2 };

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

/// True when the cut-off run left a checkpoint to go on from.
static bool has_checkpoint(const char *run_folder)
{
    char out[CLX_PATH_LIMIT];
    return clx_path_join(out, run_folder, "out") == CLAST_OK && clx_checkpoint_exists(out);
}

static int64_t item_of(const scheduler *s, int64_t row)
{
    return (row - s->shard) / s->n_shard;
}

/// Takes a row's lock; false when another study does it now, or has done it meanwhile.
static clast_status claim_row(scheduler *s, int64_t row, bool *is_mine)
{
    clast_status status = CLAST_OK;
    char folder[CLX_PATH_LIMIT];
    char runs[CLX_PATH_LIMIT];
    taken_row taken = {.row = row};
    bool is_busy = false;
    CLX_TRY(clx_path_join(runs, s->folder, "runs"));
    CLX_TRY(clx_folder_make(runs));
    CLX_TRY(clx_study_run_folder(s->folder, row, "", folder));
    CLX_TRY(clx_grow(&s->taken, &s->capacity, s->n_busy + 1LL, sizeof *s->taken));
    status = clx_lock_acquire(folder, 0.0, &taken.lock, &is_busy);
    *is_mine = status == CLAST_OK && !clx_study_is_done(s->folder, row);
    if (*is_mine) {
        s->taken[s->n_busy++] = taken;
    } else {
        clx_lock_release(&taken.lock);
    }
    status = is_busy ? CLAST_OK : status;
done:
    return status;
}

static void release_row(scheduler *s, int64_t row)
{
    for (int32_t i = 0; i < s->n_busy; ++i) {
        if (s->taken[i].row == row) {
            clx_lock_release(&s->taken[i].lock);
            s->taken[i] = s->taken[--s->n_busy];
            return;
        }
    }
}

static bool asked_to_stop(void *context)
{
    const scheduler *s = context;
    return clx_monitor_stops(s->monitor);
}

/// Whether a process is at the run.
static bool is_under_way(const char *run_folder)
{
    char out[CLX_PATH_LIMIT];
    clx_run_state state = {0};
    const bool is_known = clx_path_join(out, run_folder, "out") == CLAST_OK &&
                          clx_run_state_read(out, &state) == CLAST_OK;
    const bool is = is_known && state.is_running;
    clx_run_state_free(&state);
    return is;
}

/// Waits for the process that a killed study has left at the run; false when it stays, or this
/// study is asked to stop.
static bool wait_for_orphan(scheduler *s, const char *run_folder)
{
    const struct timespec pause = {0, 50000000};
    const double begun = clx_clock();
    bool is_free = !is_under_way(run_folder);
    while (!is_free && clx_clock() - begun < orphan_patience && !asked_to_stop(s)) {
        clx_queue_serve(&s->queue);
        (void)nanosleep(&pause, NULL);
        is_free = !is_under_way(run_folder);
    }
    return is_free;
}

/// The words of a run whose folder is free: it goes on from its checkpoint, or begins anew.
static clast_status prepare_run(const scheduler *s, int64_t row, const char *folder,
                                clast_text_list *words)
{
    clast_status status = CLAST_OK;
    char exit_code[CLX_PATH_LIMIT];
    const bool resume = s->worker->has_folder && s->worker->has_resume && has_checkpoint(folder);
    if (!resume) {
        CLX_TRY(clx_run_remove_tree(folder));
    }
    CLX_TRY(clx_folder_make(folder));
    CLX_TRY(clx_path_join(exit_code, folder, "exit_code"));
    (void)unlink(exit_code); // of the attempt that is gone on with
    const clx_study_words_of shared = {s->config, s->worker, s->plan};
    CLX_TRY(clx_study_words(&shared, row, folder, resume, words));
done:
    return status;
}

static clast_status start(scheduler *s, int64_t row)
{
    CLAST_ASSERT(row >= 0 && row < s->plan->n_row);
    clast_status status = CLAST_OK;
    char folder[CLX_PATH_LIMIT];
    clast_text_list words = {0};
    bool is_mine = false;
    CLX_TRY(claim_row(s, row, &is_mine));
    if (is_mine) {
        CLX_TRY(clx_study_run_folder(s->folder, row, ".part", folder));
        is_mine = wait_for_orphan(s, folder);
    }
    if (!is_mine) {
        release_row(s, row);
        clx_queue_end(&s->queue, item_of(s, row), ELSEWHERE);
        return CLAST_OK;
    }
    CLX_TRY(prepare_run(s, row, folder, &words));
    const clast_study_item item = {row, folder, words.n, words.item};
    CLX_TRY(s->worker->start(s->worker->context, &item));
done:
    if (status != CLAST_OK) {
        release_row(s, row);
    }
    clx_study_words_free(&words);
    return status;
}

static int64_t row_of(const scheduler *s, int64_t item)
{
    CLAST_ASSERT(item >= 0);
    return s->shard + item * s->n_shard;
}

/// Takes note of a run of this rank that ended; `stopping`: it was asked to.
static clast_status finish(scheduler *s, int64_t row, int exit_code, bool stopping)
{
    clast_status status = CLAST_OK;
    char part[CLX_PATH_LIMIT];
    char whole[CLX_PATH_LIMIT];
    int64_t code = CUT_OFF;
    if (stopping && !clx_run_is_answer(exit_code)) {
        goto done;
    }
    CLX_TRY(clx_study_run_folder(s->folder, row, ".part", part));
    CLX_TRY(clx_study_run_folder(s->folder, row, "", whole));
    CLX_TRY(clx_study_write_exit(part, exit_code));
    if (clx_run_is_answer(exit_code)) {
        CLX_TRY(clx_study_make_whole(part, whole));
    } else {
        CLX_TRY(clx_study_note_signal(part, exit_code));
    }
    code = exit_code;
    if (exit_code == 0 && !s->has_checked_kept) {
        s->has_checked_kept = true;
        CLX_TRY(clx_study_check_kept(s->config, whole));
    }
done:
    release_row(s, row);
    clx_queue_end(&s->queue, item_of(s, row), code);
    return status;
}

static void tell(const scheduler *s)
{
    clx_monitor_report(s->monitor, "runs", s->report->n_done + s->report->n_failed, s->n_mine);
}

/// A run of any rank has ended; rank 0 counts.
static void count_end(void *context, int64_t item, int64_t code)
{
    const scheduler *s = context;
    clast_study_report *report = s->report;
    const int64_t number = row_of(s, item) + 1;
    if (code == CUT_OFF || code == ELSEWHERE) {
        report->n_other += code == ELSEWHERE;
        return;
    }
    if (clx_run_is_answer((int)code)) {
        ++report->n_done;
    } else {
        const bool first = report->n_failed++ == 0 || number < report->first_failed;
        report->first_failed = first ? number : report->first_failed;
    }
    tell(s);
}

static bool is_open(void *context, int64_t item)
{
    const scheduler *s = context;
    return !clx_study_is_done(s->folder, row_of(s, item));
}

/// Begins runs while there are free workers and open rows for this rank.
static clast_status start_some(scheduler *s, int32_t n_worker)
{
    CLAST_ASSERT(n_worker >= 1);
    clast_status status = CLAST_OK;
    int64_t item = 0;
    while (status == CLAST_OK && s->n_busy < n_worker && clx_queue_next(&s->queue, &item)) {
        status = start(s, row_of(s, item));
    }
    return status;
}

static bool has_more(const scheduler *s)
{
    return s->n_busy > 0 || !(s->queue.is_empty || s->queue.is_stopping);
}

/// Waits for a run to end, or for rank 0's answer.
static clast_status wait_some(scheduler *s, bool stopping)
{
    clast_status status = CLAST_OK;
    int64_t ended = -1;
    int code = 0;
    if (s->n_busy == 0) {
        clx_queue_rest();
        return CLAST_OK;
    }
    status = s->worker->wait(s->worker->context, &ended, &code);
    if (ended >= 0) {
        const clast_status ending = finish(s, ended, code, stopping);
        status = status == CLAST_OK ? ending : status;
    }
    return status;
}

/// Keeps `n_worker` runs busy until none is open; on a stop or an error waits for those under way.
static clast_status work(scheduler *s, int32_t n_worker)
{
    clast_status status = CLAST_OK;
    bool stopping = false;
    while (has_more(s)) {
        if (!stopping) {
            status = start_some(s, n_worker);
        }
        const clast_status waited =
            status == CLAST_OK || stopping ? wait_some(s, stopping) : status;
        status = status == CLAST_OK ? waited : status;
        clx_queue_serve(&s->queue);
        if (!stopping && (status != CLAST_OK || s->queue.is_stopping || asked_to_stop(s))) {
            stopping = true;
            clx_queue_stop(&s->queue);
            s->worker->stop(s->worker->context);
        }
    }
    clx_queue_leave(&s->queue, asked_to_stop, s);
    return status == CLAST_OK && s->queue.is_stopping
               ? clx_fail(CLAST_E_STOPPED, "stopped; the same call goes on")
               : status;
}

/// Rank 0: runs of this shard that are open; the report's counts of the others.
static void count(scheduler *s)
{
    s->report->n_run = s->plan->n_row;
    for (int64_t row = 0; row < s->plan->n_row; ++row) {
        const bool done = clx_study_is_done(s->folder, row);
        const bool mine = row % s->n_shard == s->shard;
        s->report->n_before += done;
        s->report->n_other += !done && !mine;
        s->n_mine += !done && mine;
    }
}

/// The plan, on every rank; rank 0 keeps it in the folder.
static clast_status prepare(scheduler *s, const clast_comm *comm, clast_table *plan)
{
    clast_status status = CLAST_OK;
    CLX_TRY(parse_shard(s->config->shard, &s->shard, &s->n_shard));
    CLX_TRY(clast_study_plan(s->config, plan));
    if (comm->rank == 0) {
        CLX_TRY(clx_study_store(s->config, s->folder, plan));
        CLX_TRY(clx_study_check_inputs(s->folder, plan));
        count(s);
        tell(s);
    }
    const int64_t behind = plan->n_row - 1 - s->shard; // rows after this shard's first
    const int64_t n = behind < 0 ? 0 : behind / s->n_shard + 1;
    s->queue = clx_queue_begin(comm, n, (clx_queue_owner){is_open, count_end, s});
done:
    return status;
}

/// Rank 0 writes the tables of what is there, however the work ended; the first failure counts.
static clast_status collect(const scheduler *s, clast_status worked)
{
    char text[1024];
    (void)snprintf(text, sizeof text, "%s", clast_error_detail());
    const clast_status collected = clx_study_collect(s->config, s->folder, s->plan, s->report);
    return worked == CLAST_OK ? collected : clx_fail(worked, "%s", text);
}

/// Refuses ranks that read other options, or another configuration, table or argument's file, than
/// rank 0. Called by all ranks.
static clast_status check_ranks(const clast_study_config *config, const clast_comm *comm)
{
    clast_status status = CLAST_OK;
    const char **file = NULL;
    int32_t n = 0;
    CLX_TRY(clast_comm_agree(comm, clx_alloc(&file, config->argument.n + INT64_C(2), sizeof *file),
                             NULL));
    file[n++] = config->config;
    file[n++] = config->table;
    for (int32_t i = 0; i < config->argument.n; ++i) { // "": a word, or a file that is not there
        const char *path = clx_study_file_of(config->argument.item[i]);
        file[n++] = path != NULL ? path : "";
    }
    CLX_TRY(clast_run_inputs_agree(comm, clast_study_fields, config, n, file));
done:
    clx_free((void *)file);
    return status;
}

clast_status clast_study_run(const clast_study_config *config, const char *folder,
                             const clast_study_worker *worker, const clast_comm *comm,
                             const clast_monitor *monitor, clast_study_report *report)
{
    CLX_ARGUMENTS(config, folder, worker, report);
    CLX_GUARD(clast_fields_check(clast_study_fields, config));
    clast_status status = CLAST_OK;
    clast_table plan = {0};
    clast_study_report made = {0};
    clast_study_config seeded = *config; // study.json holds the seed
    scheduler s = {.config = &seeded,
                   .folder = folder,
                   .worker = worker,
                   .monitor = monitor,
                   .report = &made,
                   .plan = &plan,
                   .n_shard = 1};
    const clast_comm *all = clx_comm_or_one(comm);
    CLX_TRY(check_ranks(config, all));
    CLX_TRY(clast_comm_agree(all, clx_study_find_seed(&seeded), NULL));
    CLX_TRY(clast_comm_agree(all, prepare(&s, all, &plan), NULL));
    status = clast_comm_agree(all, work(&s, clast_parallel_threads()), NULL);
    if (all->rank == 0) {
        status = collect(&s, status);
    }
    CLX_TRY(clast_comm_agree(all, status, NULL));
    all->broadcast(all->context, 0, &made, (int64_t)sizeof made);
    *report = made;
    CLX_CHECK(made.n_failed == 0, CLAST_E_NO, "%lld of %lld runs failed, the first is run %lld",
              (long long)made.n_failed, (long long)made.n_run, (long long)made.first_failed);
done:
    clx_free(s.taken);
    clast_table_free(&plan);
    return status;
}
