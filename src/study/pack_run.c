// A whole run of a packing: inputs, folder, checkpoints, going on, results.
//
// Ranks share one bed. Every rank reads the inputs and decides the same; rank 0 writes the files,
// and says when there is to be a checkpoint.
#include <clast/pack.h>

#include "base/alloc.h"
#include "base/clock.h"
#include "base/comm.h"
#include "base/monitor.h"
#include "base/path.h"
#include "io/config_files.h"
#include "io/h5.h"
#include "io/start_file.h"
#include "pack/pack.h"
#include "run/checkpoint.h"
#include "run/pack_state.h"
#include "run/run.h"
#include "study/pack_folder.h"
#include <clast/field.h>
#include <clast/grading.h>
#include <clast/machine.h>
#include <clast/status.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

typedef struct {
    const clast_pack_config *config;
    const clast_comm *comm;
    bool has_folder;       ///< results are kept
    clast_run_folder *own; ///< rank 0's, NULL without a folder
    const char *folder;    ///< where its files go, or NULL
    const clast_monitor *monitor;
    clast_pack_source source;
    char *text; ///< configuration as JSON
    clast_pack *pack;
    double saved_at; ///< clock of the last checkpoint
    double begun;
} run;

static bool is_first(const run *r)
{
    return r->comm->rank == 0;
}

static void free_run(run *r)
{
    clast_pack_destroy(r->pack);
    clast_pack_unload(&r->source);
    clast_run_folder_destroy(r->own);
    clast_text_free(r->text);
}

/// What the user reads while it runs: phase, simulated microseconds, rate, time left.
static bool talk(const run *r)
{
    const clast_monitor *m = r->monitor;
    const double dt = r->config->dem.time_step;
    if (m != NULL && m->report != NULL && is_first(r)) {
        char phase[32];
        (void)snprintf(phase, sizeof phase, "%s, simulated us",
                       clast_pack_phase_name(clast_pack_phase_of(r->pack)));
        m->report(m->context, phase,
                  (int64_t)(1e6 * dt * (double)clast_dem_n_step(clast_pack_dem(r->pack))),
                  (int64_t)(1e6 * dt * (double)clast_pack_expected_steps(r->pack)));
    }
    return clx_monitor_stops(m);
}

static double share_done(const run *r)
{
    return (double)clast_dem_n_step(clast_pack_dem(r->pack)) /
           (double)clast_pack_expected_steps(r->pack);
}

static clast_status save(run *r)
{
    clast_status status = CLAST_OK;
    r->saved_at = clx_clock();
    if (!r->has_folder) {
        return CLAST_OK;
    }
    CLX_TRY(clx_pack_gather(r->pack));
    if (is_first(r)) {
        status = clx_pack_checkpoint_write(r->folder, r->text, r->pack);
    }
    if (is_first(r) && status == CLAST_OK) {
        status = clx_run_folder_progress(r->own, share_done(r));
    }
    CLX_TRY(clast_comm_agree(r->comm, status, NULL));
done:
    return status;
}

/// Steps of one round: to the next frame, at most about a fifth of a second.
static int64_t round_steps(const run *r, int64_t aim, int64_t per_frame)
{
    CLAST_ASSERT(per_frame >= 0);
    const int64_t step = clast_dem_n_step(clast_pack_dem(r->pack));
    const int64_t left = per_frame > 0 ? per_frame - step % per_frame : aim;
    return left < aim ? left : aim;
}

/// Steps from one frame to the next; 0: none are written.
static int64_t frame_steps(const run *r)
{
    const double t = r->has_folder ? r->config->frame_time : 0.0;
    return t > 0.0 ? (int64_t)fmax(1.0, floor(t / r->config->dem.time_step + 0.5)) : 0;
}

static clast_status frame(run *r, int64_t per_frame)
{
    clast_status status = CLAST_OK;
    const int64_t step = clast_dem_n_step(clast_pack_dem(r->pack));
    if (per_frame == 0 || step % per_frame != 0 ||
        clast_dem_n_grain(clast_pack_dem(r->pack)) == 0) {
        return CLAST_OK;
    }
    CLX_TRY(clx_pack_gather(r->pack));
    if (is_first(r)) {
        status = clx_pack_write_frame(r->folder, step / per_frame, r->pack);
    }
    CLX_TRY(clast_comm_agree(r->comm, status, NULL));
done:
    return status;
}

/// frames.pvd of a run that has ended in any way, and how many frames there are.
static clast_status list_frames(run *r, clast_pack_result *result)
{
    const int64_t per_frame = frame_steps(r);
    if (per_frame == 0) {
        return CLAST_OK;
    }
    result->frame_interval = (double)per_frame * r->config->dem.time_step;
    return clx_pack_write_collection(r->folder,
                                     clast_dem_n_step(clast_pack_dem(r->pack)) / per_frame,
                                     result->frame_interval, &result->n_frame);
}

/// Rounds that frames cut short are quick whatever the aim, which would double for ever.
#define MOST_STEPS (INT64_C(1) << 30)

/// What follows a round: rank 0's clock says how long the next is and whether a checkpoint is due;
/// any rank may have been asked to stop.
typedef struct {
    int64_t aim;
    bool is_stopped, is_save_due;
} round_end;

static round_end end_round(const run *r, int64_t aim, double took)
{
    round_end end = {.aim = took < 0.1 && aim < MOST_STEPS ? aim * 2
                            : took > 0.4 && aim > 1        ? aim / 2
                                                           : aim,
                     .is_save_due =
                         r->has_folder && clx_clock() - r->saved_at > r->config->checkpoint_time};
    r->comm->broadcast(r->comm->context, 0, &end, (int64_t)sizeof end);
    end.is_stopped = r->comm->least(r->comm->context, talk(r) ? 0 : 1) == 0;
    return end;
}

static clast_status go(run *r)
{
    clast_status status = CLAST_OK;
    const int64_t per_frame = frame_steps(r);
    round_end end = {.aim = 100};
    r->saved_at = clx_clock();
    while (!clast_pack_is_over(r->pack)) {
        const double before = clx_clock();
        CLX_TRY(clast_pack_advance(r->pack, round_steps(r, end.aim, per_frame)));
        CLX_TRY(frame(r, per_frame));
        end = end_round(r, end.aim, clx_clock() - before);
        if (end.is_stopped) {
            CLX_TRY(save(r));
            status = CLAST_E_STOPPED;
            goto done;
        }
        if (end.is_save_due) {
            CLX_TRY(save(r));
        }
    }
done:
    return status;
}

/// Keeps the bed of a run that did not come to its end, and says why it did not.
static clast_status write_end(run *r)
{
    char why[CLX_DETAIL_SIZE];
    (void)snprintf(why, sizeof why, "%s", clast_error_detail());
    (void)clx_pack_rows(r->pack); // what ended the run may keep its last row from being measured
    clast_status status = clx_pack_gather(r->pack);
    if (r->folder != NULL && status == CLAST_OK) {
        status = clx_pack_write_end(r->folder, r->text, r->pack);
    }
    if (r->folder != NULL && status == CLAST_OK) {
        status = clx_run_folder_progress(r->own, share_done(r));
    }
    status = clast_comm_agree(r->comm, status, NULL);
    return status == CLAST_OK ? clx_fail(CLAST_E_CONVERGE, "%s", why) : status;
}

/// Measures and writes what a run leaves: rank 0's part.
static clast_status conclude(run *r, clast_status status, clast_pack_result *made)
{
    if (status == CLAST_OK) {
        status = clast_pack_measure(r->pack, made);
        made->wall_s = clx_clock() - r->begun;
    }
    const clast_status listed = list_frames(r, made);
    status = status == CLAST_OK ? listed : status;
    if (status == CLAST_OK && r->source.n_hull > 0) { // the result takes them over
        made->n_hull = r->source.n_hull;
        made->hull = r->source.hull;
        r->source.hull = NULL;
        r->source.n_hull = 0;
    }
    if (r->folder != NULL && status == CLAST_OK) {
        status = clx_pack_write_results(r->folder, r->text, r->pack, r->config, made);
    }
    if (status == CLAST_E_STOPPED && r->folder == NULL) {
        status = clx_fail(status, "stopped; without -o there is nothing to go on from");
    }
    return clast_run_folder_end(r->own, status);
}

/// The end of a run, whatever it is; the result goes to rank 0's caller.
static clast_status finish(run *r, clast_status status, clast_pack_result *result)
{
    clast_pack_result made = {0};
    clast_pack_ranks ranks = {0};
    if (status == CLAST_OK) {
        status = clx_pack_gather(r->pack);
        clx_pack_count_ranks(r->pack, &ranks);
    } else if (status == CLAST_E_CONVERGE && r->has_folder) {
        status = write_end(r);
    }
    if (is_first(r)) {
        status = conclude(r, status, &made);
    }
    status = clast_comm_agree(r->comm, status, NULL);
    if (status != CLAST_OK || !is_first(r)) {
        clast_pack_result_free(&made);
        return status;
    }
    made.ranks = ranks;
    *result = made;
    return status;
}

static clast_status check_ranks(const run *r)
{
    const clx_run_inputs inputs = clx_pack_inputs(r->config);
    return clx_run_check_ranks(r->comm, &inputs);
}

static void tell_meaning(const run *r)
{
    const clast_grading_list list = clast_grading_list_of(r->source.grading);
    bool has_other = r->config->form_law;
    for (int32_t i = 0; i < r->source.input.n_shape; ++i) {
        has_other = has_other || r->source.input.shape[i].kind != CLAST_SHAPE_SPHERE;
    }
    if (has_other && r->config->size_meaning == 0) {
        clx_run_tell_meaning(r->monitor, "curve", &list, "sieve sizes");
    }
}

/// Loads all that can be wrong before anything is written.
static clast_status prepare(run *r, bool goes_on)
{
    clast_status status = CLAST_OK;
    r->begun = clx_clock();
    CLX_TRY(clast_pack_load(r->config, &r->source));
    CLX_TRY(clast_fields_json(clast_pack_fields, r->config, &r->text));
    CLX_TRY((goes_on ? clx_pack_create_again : clast_pack_create)(r->config, &r->source.input,
                                                                  &r->pack));
    CLX_TRY(clx_pack_share(r->pack, r->comm));
    if (r->folder != NULL) {
        const clx_run_inputs inputs = clx_pack_inputs(r->config);
        CLX_TRY(clx_run_note_inputs(r->own, &inputs));
    }
    if (is_first(r)) {
        CLX_TRY(clx_run_tell_curve(r->own, r->monitor, r->config->curve, r->source.grading));
        tell_meaning(r);
    }
done:
    return status;
}

/// All until the first step, but for the first checkpoint.
static clast_status begin(run *r, const char *folder, bool force)
{
    clast_status status = CLAST_OK;
    if (folder == NULL) {
        CLX_TRY(clx_pack_check_lone(r->config));
    }
    CLX_CHECK(folder != NULL || !force, CLAST_E_USAGE,
              "force: there is no output folder (-o) whose run it could replace");
    if (folder != NULL && is_first(r)) {
        CLX_TRY(clx_h5_available());
        CLX_TRY(clast_run_folder_begin(folder, force, "pack", r->monitor, &r->own));
        clx_manifest_progress(clast_run_folder_manifest(r->own), 0.0);
        r->folder = clast_run_folder_path(r->own);
    }
    CLX_TRY(prepare(r, false));
done:
    return status;
}

/// Fills a cell, which may be too small, before there is a folder.
static clast_status fill(run *r)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_pack_fill_cell(r->pack));
    if (r->folder != NULL) {
        CLX_TRY(clast_run_folder_open(r->own));
    }
done:
    return status;
}

clast_status clast_pack_run(const clast_pack_config *config, const char *folder,
                            const clast_comm *comm, const clast_monitor *monitor,
                            clast_pack_result *result)
{
    CLX_ARGUMENTS(config, result);
    CLX_GUARD(clast_fields_check(clast_pack_fields, config));
    clast_status status = CLAST_OK;
    clast_pack_config own = *config; // borrowed texts; force is no property of the result
    run r = {.config = &own,
             .comm = clx_comm_or_one(comm),
             .has_folder = folder != NULL,
             .monitor = monitor};
    own.force = false;
    if (own.start == NULL || own.start[0] == '\0') {
        clx_pack_set_density(&own);
    }
    CLX_TRY(check_ranks(&r));
    CLX_TRY(clast_comm_agree(r.comm, begin(&r, folder, config->force), NULL));
    CLX_TRY(clast_comm_agree(r.comm, fill(&r), NULL));
    status = save(&r);
    status = finish(&r, status == CLAST_OK ? go(&r) : status, result);
done:
    free_run(&r);
    return status;
}

/// Where to go on: a checkpoint, else the state that max_steps ended with.
static clast_status find(const char *folder, clx_pack_checkpoint *found, bool *is_end)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    *is_end = false;
    CLX_TRY(clx_path_join(path, folder, "state.h5"));
    status = clx_pack_checkpoint_find(folder, found);
    if (status == CLAST_E_IO && found->n_damaged == 0 && access(path, F_OK) == 0) {
        *is_end = true;
        status = clx_pack_end_find(path, found);
    }
done:
    return status;
}

/// What a run is gone on from.
typedef struct {
    clx_pack_checkpoint found;
    bool is_end; ///< the state that max_steps ended with
} origin;

/// Its configuration; rank 0 takes the folder.
static clast_status find_origin(run *r, const char *folder, int64_t max_steps, origin *from,
                                clast_pack_config *config)
{
    clast_status status = CLAST_OK;
    clx_run_state state = {0};
    char line[CLX_RUN_LINE];
    CLX_TRY(find(folder, &from->found, &from->is_end));
    CLX_TRY(clx_run_state_read(folder, &state));
    clx_run_state_line(folder, &state, line);
    CLX_CHECK(!from->is_end || strcmp(state.outcome, "failed") != 0, CLAST_E_USAGE, "%s", line);
    CLX_TRY(clast_fields_parse(from->found.path, from->found.config, clast_pack_fields, config));
    if (config->start[0] != '\0' && config->density.n == 1 && config->density.item[0] == 2650.0) {
        config->density.n = 0; // what runs of a start had until 0.1.0, and nothing acted on
    }
    if (config->start[0] != '\0' && strstr(from->found.config, "\"start_frame\"") == NULL) {
        config->start_frame = CLX_START_OLD; // the grains are the checkpoint's, read as then
    }
    config->max_steps = max_steps > 0 || from->is_end ? max_steps : config->max_steps;
    if (is_first(r)) {
        CLX_TRY(clx_run_folder_resume(folder, "pack", r->monitor, &r->own));
    }
done:
    clx_run_state_free(&state);
    return status;
}

static clast_status begin_again(run *r, const char *folder, int64_t max_steps, const origin *from)
{
    clast_status status = CLAST_OK;
    CLX_TRY(prepare(r, true));
    CLX_TRY(clx_pack_checkpoint_read(&from->found, r->pack));
    CLX_CHECK(!from->is_end || clast_pack_phase_of(r->pack) != CLAST_PACK_DONE, CLAST_E_IO,
              "%s has ended: its bed is done, and there is no checkpoint to go on from", folder);
    const int64_t step = clast_dem_n_step(clast_pack_dem(r->pack));
    CLX_CHECK(
        max_steps == 0 || step < max_steps || (step == max_steps && !from->is_end), CLAST_E_USAGE,
        "%s has done %" PRId64 " steps; give a --max-steps above that, or none", folder, step);
    if (is_first(r)) {
        CLX_TRY(clast_run_folder_open(r->own));
    }
done:
    return status;
}

clast_status clast_pack_resume(const char *folder, int64_t max_steps, const clast_comm *comm,
                               const clast_monitor *monitor, clast_pack_result *result)
{
    CLX_ARGUMENTS(folder, result);
    clast_status status = CLAST_OK;
    clast_pack_config config = {0};
    origin from = {0};
    bool has_config = false;
    run r = {
        .config = &config, .comm = clx_comm_or_one(comm), .has_folder = true, .monitor = monitor};
    r.folder = is_first(&r) ? folder : NULL;
    CLX_TRY(clast_comm_agree(r.comm, clast_fields_default(clast_pack_fields, &config), NULL));
    has_config = true;
    CLX_TRY(clast_comm_agree(r.comm, find_origin(&r, folder, max_steps, &from, &config), NULL));
    CLX_TRY(clx_checkpoint_agree(r.comm, from.found.path));
    CLX_TRY(check_ranks(&r));
    CLX_TRY(clast_comm_agree(r.comm, begin_again(&r, folder, max_steps, &from), NULL));
    if (from.is_end) { // a new state.h5 may outlive a kill alone, without the other results
        status = save(&r);
    }
    status = finish(&r, status == CLAST_OK ? go(&r) : status, result);
done:
    free_run(&r);
    clx_pack_checkpoint_free(&from.found);
    if (has_config) {
        clast_fields_free(clast_pack_fields, &config);
    }
    return status;
}
