// A whole run: all repeats, the folder, checkpoints, going on.
#include <clast/aggregate_run.h>

#include "base/alloc.h"
#include "base/file.h"
#include "study/aggregate_folder.h"
#include <clast/aggregate_file.h>
#include <clast/config.h>
#include <clast/manifest.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    const clast_aggregate_config *config;
    const char *folder; ///< or NULL
    bool force;         ///< an earlier run in it may be replaced
    const clast_monitor *monitor;
    clast_aggregate_source source;
    clast_manifest *manifest; ///< NULL without a folder
    clast_aggregate *aggregate;
    int32_t repeat;       ///< under way
    clast_assembly first; ///< the first repeat's grains
    clast_table history;  ///< of all finished repeats
    clast_aggregate_report report;
} run;

static void free_run(run *r)
{
    clast_aggregate_destroy(r->aggregate);
    clast_aggregate_unload(&r->source);
    clast_manifest_destroy(r->manifest);
    clast_assembly_free(&r->first);
    clast_table_free(&r->history);
    clast_aggregate_report_free(&r->report);
}

static clast_status append_rows(clast_table *all, clast_table *rows)
{
    clast_status status = CLAST_OK;
    if (all->n_column == 0) {
        *all = *rows;
        *rows = (clast_table){0};
        return CLAST_OK;
    }
    const int64_t before = all->n_row;
    CLX_TRY(clast_table_resize(all, before + rows->n_row));
    for (int32_t c = 0; c < all->n_column; ++c) {
        memcpy(&all->column[c].number[before], rows->column[c].number,
               (size_t)rows->n_row * sizeof(double));
    }
done:
    return status;
}

/// The finished aggregate's numbers and rows join those before it.
static clast_status collect(run *r)
{
    clast_status status = CLAST_OK;
    clast_table rows = {0};
    clast_aggregate_report *report = &r->report;
    CLX_TRY(clx_realloc(&report->result, report->n + 1, sizeof *report->result));
    CLX_TRY(clast_aggregate_measure(r->aggregate, &report->result[report->n]));
    ++report->n;
    CLX_TRY(clast_aggregate_history(r->aggregate, &rows));
    CLX_TRY(append_rows(&r->history, &rows));
    if (r->repeat == 0) {
        CLX_TRY(clast_assembly_copy(clast_aggregate_assembly(r->aggregate), &r->first));
    }
done:
    clast_table_free(&rows);
    clast_aggregate_destroy(r->aggregate);
    r->aggregate = NULL;
    return status;
}

/// Grows the repeat under way to its end, a checkpoint every so often and when it must stop.
static clast_status grow(run *r)
{
    clast_status status = CLAST_OK;
    while (status == CLAST_OK && !clast_aggregate_is_done(r->aggregate)) {
        status = clast_aggregate_grow(r->aggregate, r->config->checkpoint_every, r->monitor);
        if (r->folder != NULL && (status == CLAST_OK || status == CLAST_E_STOPPED)) {
            const clast_status written =
                clx_folder_write_checkpoint(r->folder, r->config, r->repeat, r->aggregate);
            status = written != CLAST_OK ? written : status;
        }
    }
    return status;
}

static clast_status finish_repeat(run *r)
{
    clast_status status = CLAST_OK;
    CLX_TRY(grow(r));
    if (r->folder != NULL) {
        CLX_TRY(clx_folder_write_state(r->folder, r->config, r->repeat, r->aggregate));
    }
    CLX_TRY(collect(r));
done:
    return status;
}

/// All repeats from the one under way on; the handle of that one may be made already.
static clast_status grow_all(run *r)
{
    clast_status status = CLAST_OK;
    for (; r->repeat < r->config->repeats; ++r->repeat) {
        if (r->aggregate == NULL) {
            CLX_TRY(clast_aggregate_create(r->config, &r->source.input, r->repeat, &r->aggregate));
        }
        CLX_TRY(finish_repeat(r));
    }
done:
    return status;
}

static clast_status note_inputs(run *r)
{
    clast_status status = CLAST_OK;
    const clast_aggregate_config *c = r->config;
    CLX_TRY(clast_manifest_config(r->manifest, clast_aggregate_fields, c));
    clast_manifest_seed(r->manifest, c->seed);
    for (int32_t i = 0; i < clast_aggregate_n_file(c); ++i) {
        const char *role = NULL;
        const char *path = clast_aggregate_file(c, i, &role);
        CLX_TRY(clast_manifest_input(r->manifest, role, path));
    }
done:
    return status;
}

static clast_status write_manifest(run *r, const char *outcome)
{
    char path[4096];
    if (r->manifest == NULL) {
        return CLAST_OK;
    }
    (void)snprintf(path, sizeof path, "%s/manifest.json", r->folder);
    return clast_manifest_write(r->manifest, outcome, path);
}

/// A criterion that was asked for and not met is an answer that the user must not overlook.
static clast_status check_stop(const run *r)
{
    const clast_aggregate_config *c = r->config;
    const bool asked = c->stop_mass > 0.0 || c->stop_size > 0.0 || c->stop_porosity > 0.0;
    for (int32_t i = 0; i < r->report.n && asked; ++i) {
        const clast_aggregate_result *result = &r->report.result[i];
        if (result->stop == CLAST_STOP_LIST) {
            return clx_fail(CLAST_E_CONVERGE,
                            "all %d particles are placed and no stop criterion is met: mass %g kg, "
                            "d_agg %g m, porosity %g; raise replicate",
                            result->n_particle, result->mass, result->d_agg, result->porosity[0]);
        }
    }
    return CLAST_OK;
}

static const char *outcome_of(clast_status status)
{
    return status == CLAST_OK ? "done" : status == CLAST_E_STOPPED ? "stopped" : "failed";
}

static clast_status finish(run *r, clast_status status)
{
    if (status == CLAST_OK && r->folder != NULL) {
        const clx_folder_results results = {.config = r->config,
                                            .report = &r->report,
                                            .sizes = r->source.input.sizes,
                                            .history = &r->history,
                                            .first = &r->first,
                                            .monitor = r->monitor};
        status = clx_folder_write_results(r->folder, &results);
    }
    if (status == CLAST_OK) {
        status = check_stop(r);
    }
    if (status == CLAST_E_STOPPED && r->folder != NULL) {
        status =
            clx_fail(CLAST_E_STOPPED, "stopped; go on with clast aggregate --resume %s", r->folder);
    }
    const char *outcome = status == CLAST_E_CONVERGE ? "done" : outcome_of(status);
    if (r->folder != NULL && r->report.n + (r->aggregate != NULL) > 0) {
        const clast_status written = write_manifest(r, outcome);
        status = status == CLAST_OK ? written : status;
    }
    return status;
}

/// Loads and makes the first repeat, so that bad input is refused before anything is written.
static clast_status begin(run *r)
{
    clast_status status = CLAST_OK;
    r->report.confidence = r->config->confidence;
    CLX_TRY(clast_aggregate_load(r->config, &r->source));
    CLX_TRY(clast_aggregate_create(r->config, &r->source.input, 0, &r->aggregate));
    if (r->folder != NULL) {
        CLX_TRY(clx_folder_take(r->folder, r->force));
        CLX_TRY(clx_folder_start(r->monitor, &r->manifest));
        CLX_TRY(note_inputs(r));
        CLX_TRY(clx_folder_make(r->folder));
        CLX_TRY(write_manifest(r, "running"));
    }
done:
    return status;
}

clast_status clast_aggregate_run(const clast_aggregate_config *config, const char *folder,
                                 const clast_monitor *monitor, clast_aggregate_report *report)
{
    clast_aggregate_config own = *config; // borrowed texts; force is no property of the result
    run r = {.config = &own, .folder = folder, .force = config->force, .monitor = monitor};
    own.force = false;
    clast_status status = begin(&r);
    if (status == CLAST_OK) {
        status = finish(&r, grow_all(&r));
    }
    if (status == CLAST_OK || status == CLAST_E_CONVERGE) {
        *report = r.report;
        r.report = (clast_aggregate_report){0};
    }
    free_run(&r);
    return status;
}

/// One repeat as its state file or the checkpoint has it.
static clast_status restore(run *r, const clast_state *state)
{
    clast_status status = CLAST_OK;
    clast_aggregate_saved saved;
    CLX_TRY(clx_folder_saved(state, &saved));
    CLX_TRY(clast_aggregate_restore(r->config, &r->source.input, &saved, &r->aggregate));
    r->repeat = saved.repeat;
done:
    return status;
}

/// The repeats that had ended, from their state files.
static clast_status restore_finished(run *r, int32_t n)
{
    clast_status status = CLAST_OK;
    clast_state state = {0};
    for (int32_t i = 0; i < n; ++i) {
        CLX_TRY(clx_folder_read_state(r->folder, i, &state));
        CLX_TRY(restore(r, &state));
        CLX_TRY(collect(r));
        clast_state_free(&state);
    }
done:
    clast_state_free(&state);
    return status;
}

static clast_status begin_again(run *r, const clast_state *state)
{
    clast_status status = CLAST_OK;
    clast_aggregate_saved saved;
    r->report.confidence = r->config->confidence;
    CLX_TRY(clx_folder_saved(state, &saved));
    CLX_TRY(clast_aggregate_load(r->config, &r->source));
    CLX_TRY(clx_folder_start(r->monitor, &r->manifest));
    CLX_TRY(note_inputs(r));
    CLX_TRY(clast_manifest_note(r->manifest, "resumed", "yes"));
    CLX_TRY(restore_finished(r, saved.repeat));
    CLX_TRY(restore(r, state));
done:
    return status;
}

clast_status clast_aggregate_resume(const char *folder, const clast_monitor *monitor,
                                    clast_aggregate_report *report)
{
    clast_status status = CLAST_OK;
    clast_aggregate_config config = {0};
    clast_state state = {0};
    bool has_config = false;
    run r = {.config = &config, .folder = folder, .monitor = monitor};
    CLX_TRY(clx_folder_read_checkpoint(folder, &state));
    CLX_CHECK(state.config != NULL, CLAST_E_FORMAT, "%s: the checkpoint has no configuration",
              folder);
    CLX_TRY(clast_fields_default(clast_aggregate_fields, &config));
    has_config = true;
    CLX_TRY(clast_config_parse(folder, state.config, clast_aggregate_fields, &config));
    CLX_TRY(begin_again(&r, &state));
    status = finish(&r, grow_all(&r));
    if (status == CLAST_OK || status == CLAST_E_CONVERGE) {
        *report = r.report;
        r.report = (clast_aggregate_report){0};
    }
done:
    free_run(&r);
    clast_state_free(&state);
    if (has_config) {
        clast_fields_free(clast_aggregate_fields, &config);
    }
    return status;
}
