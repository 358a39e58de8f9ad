// A whole run of an evolution: inputs, folder, checkpoints, going on, results.
#include <clast/evolve.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "base/field.h"
#include "base/monitor.h"
#include "evolve/config.h"
#include "io/config_files.h"
#include "io/h5.h"
#include "run/checkpoint.h"
#include "run/run.h"
#include "study/evolve_folder.h"
#include <clast/grading.h>
#include <clast/report.h>
#include <clast/state.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    const clast_evolve_config *config;
    clast_run_folder *own; ///< NULL without a folder
    const char *folder;    ///< where its files go, or NULL
    const clast_monitor *monitor;
    clast_evolve_source source;
    char *text; ///< configuration as JSON
    clast_evolve *evolve;
    int64_t leg;     ///< legs done or broken off, for the names of checkpoints
    double saved_at; ///< clock of the last checkpoint
    double begun;
} run;

static void free_run(run *r)
{
    clast_evolve_destroy(r->evolve);
    clast_evolve_unload(&r->source);
    clast_run_folder_destroy(r->own);
    clast_text_free(r->text);
}

/// Loads all that can be wrong before anything is written.
static clast_status prepare(run *r, bool goes_on)
{
    clast_status status = CLAST_OK;
    r->begun = clx_clock();
    CLX_TRY(clast_evolve_load(r->config, &r->source));
    CLX_TRY(clast_fields_json(clast_evolve_fields, r->config, &r->text));
    CLX_TRY((goes_on ? clx_evolve_create_again : clast_evolve_create)(r->config, &r->source.input,
                                                                      &r->evolve));
    if (r->folder != NULL) {
        const clx_run_inputs inputs = clx_evolve_inputs(r->config);
        CLX_TRY(clx_run_note_inputs(r->own, &inputs));
    }
    CLX_TRY(clx_run_tell_curve(r->own, r->monitor, r->config->curve, r->source.grading));
done:
    return status;
}

static clast_status save(run *r)
{
    clast_status status = CLAST_OK;
    r->saved_at = clx_clock();
    if (r->folder != NULL) {
        CLX_TRY(clx_evolve_write_checkpoint(r->folder, r->text, r->leg, r->evolve));
        CLX_TRY(clx_run_folder_progress(
            r->own, fmin(1.0, clast_evolve_time(r->evolve) / r->config->duration)));
    }
done:
    return status;
}

/// A frame of the row that was just written, where one is due.
static clast_status frame(const run *r, int32_t row)
{
    const int32_t every = r->config->frames;
    return r->folder != NULL && every > 0 && row % every == 0
               ? clx_evolve_write_frame(r->folder, row, r->evolve)
               : CLAST_OK;
}

/// Tells what time it is in the cloud; whether to stop.
static bool talk(const run *r)
{
    const double share = clast_evolve_time(r->evolve) / r->config->duration;
    clx_monitor_report(r->monitor, "evolve, in 1/1000 of the duration", (int64_t)(1e3 * share),
                       1000);
    return clx_monitor_stops(r->monitor);
}

static clast_status go(run *r)
{
    clast_status status = CLAST_OK;
    r->saved_at = clx_clock();
    (void)talk(r); // who asks before the first step has ended is heard
    while (!clast_evolve_is_over(r->evolve)) {
        const int32_t row = clast_evolve_n_row(r->evolve);
        const double until =
            r->folder != NULL ? r->saved_at + r->config->checkpoint_time : (double)INFINITY;
        CLX_TRY(clx_evolve_advance_until(r->evolve, r->monitor, until));
        ++r->leg;
        if (clast_evolve_n_row(r->evolve) > row) {
            CLX_TRY(frame(r, row + 1));
        }
        if (talk(r) && !clast_evolve_is_over(r->evolve)) {
            CLX_TRY(save(r));
            status = r->folder != NULL
                         ? CLAST_E_STOPPED
                         : clx_fail(CLAST_E_STOPPED,
                                    "stopped; without -o there is nothing to go on from");
            goto done;
        }
        if (r->folder != NULL && clx_clock() - r->saved_at > r->config->checkpoint_time) {
            CLX_TRY(save(r));
        }
    }
done:
    return status;
}

/// All files. `lacks` tells why there is no page, which a run is whole without.
static clast_status write_all(run *r, clast_evolve_result *made, clast_status *page,
                              char lacks[CLX_DETAIL_SIZE])
{
    clast_status status = CLAST_OK;
    CLX_TRY(clast_evolve_measure(r->evolve, made));
    made->wall_s = clx_clock() - r->begun;
    memcpy(made->points_words, r->source.points_words, sizeof made->points_words);
    if (r->folder != NULL) {
        CLX_TRY(clx_evolve_write_collection(r->folder, r->evolve, &made->n_frame));
        CLX_TRY(clx_evolve_write_results(r->folder, r->text, r->config, &r->source.domain,
                                         r->evolve, made));
        CLX_TRY(clx_run_folder_seal(r->own));
        *page = clast_report_write_run(r->folder, clx_run_folder_place(r->own));
        (void)snprintf(lacks, CLX_DETAIL_SIZE, "%s", clast_error_detail());
    }
done:
    return status;
}

static clast_status finish(run *r, clast_status status, clast_evolve_result *result)
{
    clast_evolve_result made = {0};
    clast_status page = CLAST_OK;
    char lacks[CLX_DETAIL_SIZE];
    if (status == CLAST_OK) {
        status = write_all(r, &made, &page, lacks);
    }
    status = clast_run_folder_end(r->own, status);
    if (status == CLAST_OK && r->folder != NULL) { // a resumed run may have taken another's place
        status = clx_alloc_text(&made.folder, clast_run_folder_path(r->own));
    }
    if (status == CLAST_OK && page != CLAST_OK) {
        status = clx_fail(page,
                          "%s holds the whole run but no report.html: %s; clast report %s makes it",
                          made.folder, lacks, made.folder);
    }
    if (status != CLAST_OK) {
        clast_evolve_result_free(&made);
        return status;
    }
    *result = made;
    return status;
}

clast_status clast_evolve_run(const clast_evolve_config *config, const char *folder,
                              const clast_monitor *monitor, clast_evolve_result *result)
{
    CLX_ARGUMENTS(config, result);
    const clast_idle rules[] = {{folder == NULL, "keep|checkpoint_time", "without -o"}, {0}};
    CLX_GUARD(clast_fields_check(clast_evolve_fields, config));
    CLX_GUARD(clx_fields_idle(clast_evolve_fields, config, rules));
    clast_status status = CLAST_OK;
    clast_evolve_config own = *config; // borrowed texts; force is no property of the result
    run r = {.config = &own, .monitor = monitor};
    own.force = false;
    CLX_CHECK(folder != NULL || config->frames == 0, CLAST_E_USAGE,
              "frames: they are written into a run's folder; give one (-o)");
    CLX_CHECK(config->frames == 0 || config->structure, CLAST_E_CONFIG,
              "frames: drops that merge (structure: no) have no grains to show");
    CLX_CHECK(config->bed_width == 0.0 || (folder != NULL && config->structure), CLAST_E_CONFIG,
              "bed_width: a bed of aggregates needs a folder (-o) and their grains (structure)");
    CLX_CHECK(folder != NULL || !config->force, CLAST_E_USAGE,
              "force: there is no output folder (-o) whose run it could replace");
    if (folder != NULL) {
        CLX_TRY(clx_h5_available());
        CLX_TRY(clast_run_folder_begin(folder, config->force, "evolve", monitor, &r.own));
        clx_manifest_progress(clast_run_folder_manifest(r.own), 0.0);
        r.folder = clast_run_folder_path(r.own);
    }
    CLX_TRY(prepare(&r, false));
    if (folder != NULL) {
        CLX_TRY(clast_run_folder_open(r.own));
        status = frame(&r, 0);
        status = status == CLAST_OK ? save(&r) : status;
    }
    status = finish(&r, status == CLAST_OK ? go(&r) : status, result);
done:
    free_run(&r);
    return status;
}

/// The tables of a checkpoint in the order of clast_evolve_save.
static clast_status tables_of(const clast_state *state, const clast_evolve *evolve,
                              clast_table table[CLAST_N_EVOLVE_SAVED])
{
    clast_status status = CLAST_OK;
    clast_table now[CLAST_N_EVOLVE_SAVED] = {{0}};
    CLX_TRY(clast_evolve_save(evolve, now)); // its names
    for (int k = 0; k < CLAST_N_EVOLVE_SAVED; ++k) {
        const clast_table *found = clast_state_table(state, now[k].name);
        CLX_CHECK(found != NULL, CLAST_E_FORMAT, "the checkpoint has no table %s", now[k].name);
        table[k] = *found;
    }
done:
    for (int k = 0; k < CLAST_N_EVOLVE_SAVED; ++k) {
        clast_table_free(&now[k]);
    }
    return status;
}

clast_status clast_evolve_resume(const char *folder, const clast_monitor *monitor,
                                 clast_evolve_result *result)
{
    CLX_ARGUMENTS(folder, result);
    clast_status status = CLAST_OK;
    clast_evolve_config config = {0};
    clast_state state = {0};
    clast_table table[CLAST_N_EVOLVE_SAVED];
    char *path = NULL;
    bool has_config = false;
    run r = {.config = &config, .folder = folder, .monitor = monitor};
    CLX_TRY(clx_checkpoint_newest(folder, &path, &r.leg, NULL));
    CLX_TRY(clast_state_read(path, &state));
    CLX_CHECK(state.config != NULL, CLAST_E_FORMAT, "%s has no configuration", path);
    CLX_TRY(clast_fields_default(clast_evolve_fields, &config));
    has_config = true;
    CLX_TRY(clast_fields_parse(path, state.config, clast_evolve_fields, &config));
    CLX_TRY(clx_run_folder_resume(folder, "evolve", monitor, &r.own));
    CLX_TRY(prepare(&r, true));
    CLX_TRY(tables_of(&state, r.evolve, table));
    CLX_TRY(clast_evolve_restore(table, r.evolve));
    CLX_TRY(clast_run_folder_open(r.own));
    status = finish(&r, go(&r), result);
done:
    free_run(&r);
    clast_state_free(&state);
    clx_free(path);
    if (has_config) {
        clast_fields_free(clast_evolve_fields, &config);
    }
    return status;
}
