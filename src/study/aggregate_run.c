// A whole run: all repeats, the folder, checkpoints, going on.
//
// Ranks take repeats from a queue and write their states; rank 0 gathers the numbers in the order
// of repeats and writes all else, so that the files do not tell how many ranks there were.
#include <clast/aggregate_run.h>

#include "aggregate/config.h"
#include "base/alloc.h"
#include "base/monitor.h"
#include "base/queue.h"
#include "io/config_files.h"
#include "io/h5.h"
#include "io/sizes.h"
#include "run/checkpoint.h"
#include "run/run.h"
#include "study/aggregate_folder.h"
#include "study/aggregate_repeats.h"
#include <clast/field.h>
#include <clast/grading.h>
#include <clast/machine.h>
#include <clast/report.h>
#include <clast/state.h>
#include <clast/table.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    const clast_aggregate_config *config;
    bool is_resumed;             ///< what the folder holds is gone on with
    bool has_folder;             ///< results are kept
    char folder[CLAST_RUN_PATH]; ///< where the files of all ranks go
    const clast_monitor *monitor;
    const clast_comm *comm;
    clx_queue queue; ///< of repeats
    clast_aggregate_source source;
    clast_run_folder *own; ///< rank 0's, NULL without a folder
    clast_aggregate *aggregate;
    int32_t repeat;         ///< under way
    double grown;           ///< share of it
    clast_assembly first;   ///< the first repeat's grains, on rank 0
    clast_assembly largest; ///< its largest cluster, where there are several
    clx_repeats repeats;    ///< that this rank finished
    clast_table history;    ///< of all repeats
    clast_aggregate_report report;
    bool is_whole; ///< all is measured and, with a folder, written
} run;

static bool is_first(const run *r)
{
    return r->comm->rank == 0;
}

static void free_run(run *r)
{
    clast_aggregate_destroy(r->aggregate);
    clast_aggregate_unload(&r->source);
    clast_run_folder_destroy(r->own);
    clast_assembly_free(&r->first);
    clast_assembly_free(&r->largest);
    clx_repeats_free(&r->repeats);
    clast_table_free(&r->history);
    clast_aggregate_report_free(&r->report);
}

static void drop_aggregate(run *r)
{
    clast_aggregate_destroy(r->aggregate);
    r->aggregate = NULL;
}

/// The first repeat's grains, and those of its largest cluster.
static clast_status collect_first(run *r)
{
    clast_status status = CLAST_OK;
    clast_table members = {0};
    int32_t n_cluster = 1;
    CLX_TRY(clast_assembly_copy(clast_aggregate_assembly(r->aggregate), &r->first));
    if (r->config->params.mode == CLAST_AGGREGATE_CLUSTER) {
        CLX_TRY(clast_aggregate_members(r->aggregate, &members));
        CLX_TRY(clx_folder_largest(&r->first, &members, &r->largest, &n_cluster));
    }
done:
    clast_table_free(&members);
    return status;
}

/// The finished aggregate's numbers and rows join those before it.
static clast_status collect(run *r)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_repeats_add(&r->repeats, r->repeat, r->aggregate));
    if (r->repeat == 0) {
        CLX_TRY(collect_first(r));
    }
done:
    drop_aggregate(r);
    return status;
}

static bool asked_to_stop(void *context)
{
    const run *r = context;
    return clx_monitor_stops(r->monitor);
}

/// Asked while a repeat grows; other ranks are answered meanwhile.
static bool stops(void *context)
{
    run *r = context;
    if (asked_to_stop(r)) {
        clx_queue_stop(&r->queue);
    }
    clx_queue_serve(&r->queue);
    return r->queue.is_stopping;
}

static void tell(void *context, const char *phase, int64_t done, int64_t total)
{
    run *r = context;
    if (strcmp(phase, "grow") == 0 && total > 0) {
        r->grown = (double)done / (double)total;
    }
    clx_monitor_report(r->monitor, phase, done, total);
}

/// Rank 0 keeps how much of all repeats is done; returns `status` when that went well.
static clast_status note_progress(run *r, clast_status status)
{
    double done = r->grown;
    for (int32_t i = 0; i < r->config->repeats; ++i) {
        done += clx_folder_has_state(r->folder, i) ? 1.0 : 0.0;
    }
    const clast_status noted =
        is_first(r) ? clx_run_folder_progress(r->own, done / r->config->repeats) : CLAST_OK;
    return noted == CLAST_OK ? status : noted;
}

/// Grows the repeat under way to its end, a checkpoint every so often and when it must stop.
static clast_status grow(run *r)
{
    clast_status status = CLAST_OK;
    const clast_monitor monitor = {.report = tell, .stop = stops, .context = r};
    while (status == CLAST_OK && !clast_aggregate_is_done(r->aggregate)) {
        status = clast_aggregate_grow(r->aggregate, r->config->checkpoint_every, &monitor);
        if (r->has_folder && (status == CLAST_OK || status == CLAST_E_STOPPED)) {
            const clast_status written =
                clx_folder_write_checkpoint(r->folder, r->config, r->repeat, r->aggregate);
            status = written != CLAST_OK ? written : status;
            status =
                status == CLAST_OK || status == CLAST_E_STOPPED ? note_progress(r, status) : status;
        }
    }
    return status;
}

/// One repeat as its state file or a checkpoint has it.
static clast_status restore(run *r, const clast_state *state)
{
    clast_status status = CLAST_OK;
    clast_aggregate_saved saved;
    CLX_TRY(clx_folder_saved(state, &saved));
    CLX_CHECK(saved.repeat == r->repeat, CLAST_E_FORMAT, "%s: the state of repeat %d is one of %d",
              r->folder, r->repeat + 1, saved.repeat + 1);
    CLX_TRY(clast_aggregate_restore(&r->config->params, &r->source.input, &saved, &r->aggregate));
done:
    return status;
}

/// Makes the repeat under way: from its state, from its checkpoint, else from its core.
static clast_status open_repeat(run *r, bool *is_whole)
{
    clast_status status = CLAST_OK;
    clast_state state = {0};
    *is_whole = r->is_resumed && clx_folder_has_state(r->folder, r->repeat);
    if (r->aggregate != NULL) {
        return CLAST_OK; // made already, to try the input
    }
    if (*is_whole) {
        CLX_TRY(clx_folder_read_state(r->folder, r->repeat, &state));
        CLX_TRY(restore(r, &state));
    } else if (r->is_resumed && clx_folder_has_checkpoint(r->folder, r->repeat)) {
        CLX_TRY(clx_folder_read_checkpoint(r->folder, r->repeat, &state));
        CLX_TRY(restore(r, &state));
    } else {
        CLX_TRY(
            clast_aggregate_create(&r->config->params, &r->source.input, r->repeat, &r->aggregate));
    }
done:
    clast_state_free(&state);
    return status;
}

static clast_status do_repeat(run *r)
{
    clast_status status = CLAST_OK;
    bool is_whole = false;
    CLX_TRY(open_repeat(r, &is_whole));
    if (!is_whole) {
        CLX_TRY(grow(r));
        if (r->has_folder) {
            CLX_TRY(clx_folder_write_state(r->folder, r->config, r->repeat, r->aggregate));
        }
    }
    CLX_TRY(collect(r));
done:
    return status;
}

/// Repeats of this rank, the first one on rank 0; ends when all ranks have ended theirs.
static clast_status grow_all(run *r)
{
    clast_status status = CLAST_OK;
    int64_t item = 0;
    while (status == CLAST_OK && !r->queue.is_empty && !r->queue.is_stopping) {
        if (clx_queue_next(&r->queue, &item)) {
            r->repeat = (int32_t)item;
            status = do_repeat(r);
        } else if (!is_first(r)) {
            clx_queue_rest();
        }
    }
    if (status != CLAST_OK) {
        clx_queue_stop(&r->queue);
    }
    clx_queue_leave(&r->queue, asked_to_stop, r);
    return status == CLAST_OK && r->queue.is_stopping ? clx_fail(CLAST_E_STOPPED, "stopped")
                                                      : status;
}

static clast_status note_inputs(run *r)
{
    clast_status status = CLAST_OK;
    const clx_run_inputs inputs = clx_aggregate_inputs(r->config);
    char ranks[32];
    CLX_TRY(clx_run_note_inputs(r->own, &inputs));
    (void)snprintf(ranks, sizeof ranks, "%d", r->comm->n_rank);
    CLX_TRY(clast_manifest_note(clast_run_folder_manifest(r->own), "ranks", ranks));
done:
    return status;
}

/// A criterion that was asked for and not met is an answer that the user must not overlook.
static clast_status check_stop(const run *r)
{
    const clast_aggregate_config *c = r->config;
    const bool asked =
        c->params.stop_mass > 0.0 || c->params.stop_size > 0.0 || c->params.stop_porosity > 0.0;
    for (int32_t i = 0; i < r->report.n && asked; ++i) {
        const clast_aggregate_result *result = &r->report.result[i];
        if (result->stop == CLAST_STOP_LIST) {
            return clx_fail(CLAST_E_CONVERGE,
                            "all %d particles are placed and no stop criterion is met: mass %s, "
                            "d_agg %s, porosity %g; raise replicate",
                            result->n_particle, clx_unit_text(result->mass, "kg"),
                            clx_unit_text(result->d_agg, "m"), result->porosity[0]);
        }
    }
    return CLAST_OK;
}

/// What the numbers of the first repeat are of.
static const clast_assembly *body_of(const run *r)
{
    return r->largest.n_grain > 0 ? &r->largest : &r->first;
}

/// The printable body, which a run is whole without.
static clast_status add_printable(run *r)
{
    clast_status status = CLAST_OK;
    const clast_aggregate_config *c = r->config;
    const char *folder = clast_run_folder_path(r->own);
    const clast_printable_config config = {.neck = c->neck, .spacing = c->spacing};
    clx_folder_note_largest(r->monitor, body_of(r), r->first.n_grain,
                            r->report.result[0].n_cluster);
    CLX_TRY(
        clx_folder_write_printable(folder, body_of(r), &config, r->monitor, &r->report.printable));
    r->report.is_printable = true;
    CLX_TRY(clx_folder_list_printable(folder));
done:
    return status;
}

/// The page, which a run is whole without: `lacks` tells why there is none.
static clast_status write_page(const char *folder, const char *place, const char *name,
                               char lacks[CLX_DETAIL_SIZE])
{
    const clast_status status = clast_report_write_run(folder, place);
    if (status != CLAST_OK) {
        (void)snprintf(lacks, CLX_DETAIL_SIZE, "no report.html: %s; clast report %s makes it",
                       clast_error_detail(), name);
    }
    return status;
}

/// The printable body, which a run is whole without too, and its numbers on the page.
static clast_status add_body(run *r, char lacks[CLX_DETAIL_SIZE])
{
    const clast_status status = add_printable(r);
    if (status != CLAST_OK) {
        (void)snprintf(lacks, CLX_DETAIL_SIZE, "no printable body: %s", clast_error_detail());
        return status;
    }
    return write_page(r->report.folder, NULL, r->report.folder, lacks);
}

/// The outcome of a whole run: a body that cannot be printed and a criterion that is not met are
/// told as one kind of end, which a study keeps; a full disk, too little memory and a stop stay
/// what they are.
static clast_status tell_outcome(const run *r, clast_status last, const char *lacks)
{
    char stop[CLX_DETAIL_SIZE] = "";
    const clast_status status = check_stop(r);
    if (last == CLAST_OK) {
        return status;
    }
    if (status != CLAST_OK) {
        (void)snprintf(stop, sizeof stop, "%s; ", clast_error_detail());
    }
    const bool is_itself =
        last == CLAST_E_MEMORY || last == CLAST_E_DISK || last == CLAST_E_STOPPED;
    return clx_fail(is_itself ? last : CLAST_E_CONVERGE, "%s%s holds the whole run but %s", stop,
                    clast_run_folder_path(r->own), lacks);
}

/// Rank 0: all files of a run that went well, and the end of the manifest; the body after it, so
/// that the run is whole whatever ends the process then.
static clast_status finish(run *r, clast_status status)
{
    char lacks[CLX_DETAIL_SIZE] = "";
    clast_status last = CLAST_OK;
    if (status == CLAST_OK && r->has_folder) {
        const clx_folder_results results = {.config = r->config,
                                            .report = &r->report,
                                            .sizes = r->source.input.sizes,
                                            .history = &r->history,
                                            .first = &r->first,
                                            .body = body_of(r),
                                            .monitor = r->monitor};
        status = clx_folder_write_results(r->folder, &results);
        status = status == CLAST_OK ? clx_run_folder_seal(r->own) : status;
        last = status == CLAST_OK ? write_page(r->folder, clx_run_folder_place(r->own),
                                               clx_run_folder_place(r->own), lacks)
                                  : CLAST_OK;
    }
    status = clast_run_folder_end(r->own, status);
    if (status == CLAST_OK && r->has_folder) { // a resumed run may have taken another's place
        status = clx_alloc_text(&r->report.folder, clast_run_folder_path(r->own));
    }
    r->is_whole = status == CLAST_OK;
    if (r->is_whole) {
        last = r->config->printable ? add_body(r, lacks) : last;
        status = tell_outcome(r, last, lacks);
    }
    return status;
}

static clast_status check_ranks(const run *r)
{
    const clx_run_inputs inputs = clx_aggregate_inputs(r->config);
    return clx_run_check_ranks(r->comm, &inputs);
}

/// What the rows of a file of sizes count.
static clast_status tell_list(const run *r)
{
    clast_status status = CLAST_OK;
    clx_sizes_columns columns;
    clast_grading_list list;
    bool has_other = false;
    CLX_TRY(clx_aggregate_list(r->config, &columns, &list));
    CLX_TRY(clx_run_tell_list(r->own, r->monitor, r->config->sizes, r->config->params.size_by_mass,
                              &list));
    for (int32_t i = 0; i < r->config->coat.n; ++i) {
        has_other = has_other || strcmp(r->config->coat.item[i], "sphere") != 0;
    }
    if (has_other && r->config->params.size_meaning == 0) {
        clx_run_tell_meaning(r->monitor, "sizes", &list, "maximum lengths");
    }
done:
    return status;
}

/// Loads; rank 0 makes the first repeat, so that bad input is refused before anything is written.
static clast_status begin(run *r, const char *folder, bool force)
{
    clast_status status = CLAST_OK;
    if (is_first(r) && r->has_folder) {
        CLX_TRY(clx_h5_available());
        CLX_TRY(clast_run_folder_begin(folder, force, "aggregate", r->monitor, &r->own));
        clx_manifest_progress(clast_run_folder_manifest(r->own), 0.0);
        (void)snprintf(r->folder, sizeof r->folder, "%s", clast_run_folder_path(r->own));
    }
    CLX_TRY(clast_aggregate_load(r->config, &r->source));
    if (!is_first(r)) {
        return CLAST_OK;
    }
    CLX_TRY(clast_aggregate_create(&r->config->params, &r->source.input, 0, &r->aggregate));
    if (r->has_folder) {
        CLX_TRY(note_inputs(r));
    }
    CLX_TRY(tell_list(r));
    if (r->has_folder) {
        CLX_TRY(clast_run_folder_open(r->own));
    }
done:
    return status;
}

static clast_status begin_again(run *r)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clast_aggregate_load(r->config, &r->source));
    if (is_first(r)) {
        CLX_TRY(clx_run_folder_resume(r->folder, "aggregate", r->monitor, &r->own));
        CLX_TRY(note_inputs(r));
        CLX_TRY(tell_list(r));
        CLX_TRY(clast_run_folder_open(r->own));
    }
done:
    return status;
}

/// Everything after the beginning; the report goes to rank 0's caller.
static clast_status go(run *r, clast_status begun, clast_aggregate_report *report)
{
    r->report.confidence = r->config->confidence;
    r->queue = clx_queue_begin(r->comm, r->config->repeats, (clx_queue_owner){0});
    clast_status status = clast_comm_agree(r->comm, begun, NULL);
    if (status == CLAST_OK) {
        r->comm->broadcast(r->comm->context, 0, r->folder, sizeof r->folder);
        status = clast_comm_agree(r->comm, grow_all(r), NULL);
    }
    if (status == CLAST_OK) {
        status = clx_repeats_gather(r->comm, &r->repeats);
    }
    if (is_first(r)) {
        status =
            status == CLAST_OK ? clx_repeats_merge(&r->repeats, &r->report, &r->history) : status;
        status = finish(r, status);
    }
    status = clast_comm_agree(r->comm, status, NULL);
    if (r->is_whole) {
        *report = r->report;
        r->report = (clast_aggregate_report){0};
    }
    return status;
}

clast_status clast_aggregate_run(const clast_aggregate_config *config, const char *folder,
                                 const clast_comm *comm, const clast_monitor *monitor,
                                 clast_aggregate_report *report)
{
    CLX_ARGUMENTS(config, report);
    CLX_GUARD(clast_fields_check(clast_aggregate_fields, config));
    CLX_GUARD(clx_aggregate_idle(config, folder != NULL, monitor));
    CLX_GUARD(clx_aggregate_check_printable(config));
    clast_aggregate_config own = *config; // borrowed texts; force is no property of the result
    run r = {.config = &own,
             .has_folder = folder != NULL,
             .monitor = monitor,
             .comm = clx_comm_or_one(comm)};
    own.force = false;
    clast_status status = check_ranks(&r);
    if (status == CLAST_OK) {
        status = go(&r, begin(&r, folder, config->force), report);
    }
    free_run(&r);
    return status;
}

/// The configuration that the folder's first checkpoint holds, and the path of that; clx_free it.
static clast_status read_config(const char *folder, clast_aggregate_config *config, char **path)
{
    clast_status status = CLAST_OK;
    clast_state state = {0};
    int64_t step = 0;
    CLX_TRY(clx_checkpoint_newest(folder, path, &step, NULL));
    CLX_TRY(clast_state_read(*path, &state));
    CLX_CHECK(state.config != NULL, CLAST_E_FORMAT, "%s: the checkpoint has no configuration",
              folder);
    CLX_TRY(clast_fields_parse(folder, state.config, clast_aggregate_fields, config));
done:
    clast_state_free(&state);
    return status;
}

clast_status clast_aggregate_resume(const char *folder, const clast_comm *comm,
                                    const clast_monitor *monitor, clast_aggregate_report *report)
{
    CLX_ARGUMENTS(folder, report);
    clast_status status = CLAST_OK;
    clast_aggregate_config config = {0};
    char *path = NULL;
    run r = {.config = &config,
             .has_folder = true,
             .is_resumed = true,
             .monitor = monitor,
             .comm = clx_comm_or_one(comm)};
    (void)snprintf(r.folder, sizeof r.folder, "%s", folder);
    CLX_TRY(clast_comm_agree(r.comm, clast_fields_default(clast_aggregate_fields, &config), NULL));
    status = clast_comm_agree(r.comm, read_config(folder, &config, &path), NULL);
    status = status == CLAST_OK ? clx_checkpoint_agree(r.comm, path) : status;
    status = status == CLAST_OK ? check_ranks(&r) : status;
    clx_free(path);
    if (status == CLAST_OK) {
        status = go(&r, begin_again(&r), report);
    }
    free_run(&r);
    clast_fields_free(clast_aggregate_fields, &config);
done:
    return status;
}
