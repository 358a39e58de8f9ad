// Cells on the positions now, and all who meet in them, leg by leg.
//
// Cells are found anew at the beginning of each leg and stand while the tests of clast_workspace
// accept them. What they are follows from the calls of the leg that tested, cut or counted pairs
// alone: the positions of these are kept, so that a run that goes on in the middle of a leg makes
// the same calls first and has the same bits.                  [docs/theory/evolve.md section 3]
#include "evolve/state.h"

#include "base/alloc.h"
#include "base/monitor.h"
#include "cloud/repeated.h"
#include "math/sort.h"
#include "math/vec3.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// With so many bodies in pairs one looks whether the run is to stop: it takes milliseconds.
enum { CELL_TO_LOOK_AT = 4096 };

const char *const clx_cuts_column[CLX_N_CUTS_COLUMN][2] = {
    {"call", "-"}, {"x_m", "m"}, {"y_m", "m"}, {"z_m", "m"}};

/// Cell of the i-th body in the fluid; < 0: left out. Without cells all are in one.
static int32_t cell_of(const int32_t *cell, int32_t i)
{
    return cell != NULL ? cell[i] : 0;
}

/// Bodies of the fluid by cell: those of cell c are order[start[c] .. start[c + 1]).
static clast_status sort_by_cell(clast_evolve *e, int32_t n, const int32_t *cell)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_grow(&e->start, &e->start_capacity, (int64_t)n + 1, sizeof *e->start));
    memset(e->start, 0, ((size_t)n + 1) * sizeof *e->start);
    for (int32_t i = 0; i < e->n_live; ++i) {
        if (cell_of(cell, i) >= 0) {
            ++e->start[cell_of(cell, i) + 1];
        }
    }
    for (int32_t c = 0; c < n; ++c) {
        e->start[c + 1] += e->start[c];
    }
    for (int32_t i = 0; i < e->n_live; ++i) {
        if (cell_of(cell, i) >= 0) {
            e->order[e->start[cell_of(cell, i)]++] = e->live[i];
        }
    }
    for (int32_t c = n; c > 0; --c) {
        e->start[c] = e->start[c - 1];
    }
    e->start[0] = 0;
done:
    return status;
}

/// Volume in which the pairs of a cell meet, over its own: cells taken as uniform hide pairs
/// (smoothing_bias). Where they do not resolve the cloud its pairs of all distances are counted, at
/// most once in CLX_LEG_STEPS steps; between, the share of the last count stays.
static double share_of_volume(clast_evolve *e, const clast_decomposition *made, bool is_counted,
                              bool *is_resolved)
{
    const double share = 1.0 + made->smoothing_bias;
    const bool is_one = made->cells.n == 1;
    const bool is_even = is_one && fabs(share - 1.0) < 1e-9; // by pairs too, as far as they tell
    const bool is_carried = e->decompose.estimator == CLAST_ESTIMATOR_CELLS && !made->resolved &&
                            !is_one && e->pair_share != 1.0;
    if (is_counted) { // one cell with structure: no share of it holds for several
        e->pair_share = is_even ? 1.0 : is_one ? 0.0 : share;
        e->pair_resolved = made->resolved;
        e->pair_step = e->step;
        e->pair_n = e->n_live;
    }
    *is_resolved = is_carried ? e->pair_resolved != 0 : made->resolved;
    CLAST_ASSERT(share > 0.0 && isfinite(share));
    return is_carried ? e->pair_share : share;
}

/// Whether this leg counts the pairs of a cloud that cells do not resolve.
static bool is_pair_count_due(const clast_evolve *e)
{
    return !(e->pair_share > 0.0) || e->step - e->pair_step >= CLX_LEG_STEPS ||
           5 * (int64_t)e->n_live < 4 * (int64_t)e->pair_n;
}

/// Cells on n places, and what the call did beside.
static clast_status decompose(clast_evolve *e, int64_t n, const double *x, int64_t stride,
                              const clast_decomposition **made, clast_workspace_calls *did)
{
    clast_status status = CLAST_OK;
    const clast_points points = {
        .n = n, .dimension = 3, .x = x, .stride = stride, .axis_stride = 1};
    clast_workspace_calls before;
    CLX_TRY(clast_workspace_count(e->workspace, &before));
    CLX_TRY(
        clast_workspace_decompose_in(e->workspace, e->input->domain, &points, &e->decompose, made));
    CLX_TRY(clast_workspace_count(e->workspace, did));
    did->n_cut -= before.n_cut;
    did->n_test -= before.n_test;
    did->n_pairs -= before.n_pairs;
done:
    return status;
}

/// Keeps the positions of a call of which the next ones know. One that tests, cuts and counts (or
/// never counts) knows nothing of those before it.
static clast_status keep_call(clast_evolve *e, const clast_workspace_calls *did)
{
    clast_status status = CLAST_OK;
    const bool is_first = did->n_cut > 0 && did->n_test > 0 &&
                          (did->n_pairs > 0 || e->decompose.estimator == CLAST_ESTIMATOR_CELLS);
    if (did->n_cut + did->n_test + did->n_pairs == 0) {
        return CLAST_OK;
    }
    e->cuts.n = is_first ? 0 : e->cuts.n;
    for (int32_t i = 0; i < e->n_live; ++i) {
        double *row = NULL;
        CLX_TRY(clx_rows_add(&e->cuts, &row));
        row[0] = e->leg_step;
        v3_copy(row + 1, e->at[i]);
    }
done:
    return status;
}

/// The calls that are kept, in their order, on a workspace that has forgotten all.
static clast_status repeat_calls(clast_evolve *e)
{
    clast_status status = CLAST_OK;
    const clx_rows *cuts = &e->cuts;
    const clast_decomposition *made = NULL;
    clast_workspace_calls did;
    int64_t end = 0;
    for (int64_t begin = 0; begin < cuts->n; begin = end) {
        const double *row = &cuts->value[begin * CLX_N_CUTS_COLUMN];
        for (end = begin; end < cuts->n && cuts->value[end * CLX_N_CUTS_COLUMN] == row[0];) {
            ++end;
        }
        CLX_TRY(decompose(e, end - begin, row + 1, CLX_N_CUTS_COLUMN, &made, &did));
    }
done:
    return status;
}

clast_status clx_evolve_begin_leg(clast_evolve *e)
{
    clast_status status = CLAST_OK;
    if (e->is_in_leg) {
        return CLAST_OK;
    }
    CLX_TRY(clast_workspace_forget(e->workspace));
    if (e->leg_step > 0) {
        CLX_TRY(repeat_calls(e));
    } else {
        const bool is_due = is_pair_count_due(e);
        e->pair_share = is_due ? 0.0 : e->pair_share;
        e->decompose.estimator = is_due ? CLAST_ESTIMATOR_AUTO : CLAST_ESTIMATOR_CELLS;
        e->cuts.n = 0;
    }
    e->is_in_leg = true;
done:
    return status;
}

void clx_evolve_end_leg(clast_evolve *e)
{
    e->is_in_leg = false;
    e->leg_step = 0;
    e->cuts.n = 0;
}

/// Refuses places that a file brings and no density has; later, bodies may well meet at one place.
static clast_status check_places(const clast_evolve *e, const clast_decomposition *made)
{
    const clast_cloud cloud = {.n = e->n_live, .dimension = 3, .x = e->at[0]};
    return e->step == 0 ? clx_repeated_check(made, &cloud, "points") : CLAST_OK;
}

clast_status clx_evolve_find_cells(clast_evolve *e)
{
    clast_status status = CLAST_OK;
    const clast_decomposition *made = NULL;
    clast_workspace_calls did;
    bool is_resolved = false;
    e->cells = (clx_evolve_cells){0};
    if (e->n_live < 2) {
        return CLAST_OK;
    }
    if (e->config->even == CLAST_EVEN_WHOLE) {
        e->cells = (clx_evolve_cells){.n = 1, .share = 1.0};
        return sort_by_cell(e, 1, NULL);
    }
    CLX_TRY(decompose(e, e->n_live, e->at[0], 3, &made, &did));
    CLX_TRY(check_places(e, made));
    CLX_TRY(keep_call(e, &did));
    const double share = share_of_volume(e, made, did.n_pairs > 0, &is_resolved);
    e->n_cut += did.n_cut;
    e->n_test += did.n_test;
    e->n_unresolved += is_resolved ? 0 : did.n_cut;
    e->cells = (clx_evolve_cells){.n = made->cells.n, .volume = made->cells.volume, .share = share};
    CLX_TRY(sort_by_cell(e, made->cells.n, made->cells.of_point));
done:
    return status;
}

/// Volume in which the pairs of a cell meet.
static double volume_of(const clast_evolve *e, int32_t c)
{
    const double *volume = e->cells.volume;
    return e->cells.share * (volume != NULL ? volume[c] : clast_domain_volume(e->input->domain));
}

clast_status clx_evolve_find_rate(clast_evolve *e)
{
    double expected = 0.0;
    e->rate = e->n_live < 2 ? 0.0 : e->rate;
    if (e->n_live < 2 || e->rate > 0.0 || e->config->time_step > 0.0) {
        return CLAST_OK;
    }
    for (int32_t c = 0; c < e->cells.n; ++c) {
        // meetings never have this step's number: clast_evolve_advance refuses it
        clx_rng rng = clx_rng_at(e->config->seed, CLX_STREAM_EVOLVE_MEET,
                                 (uint64_t)UINT32_MAX << 32 | (uint64_t)(uint32_t)c);
        const int64_t begin = e->start[c];
        expected +=
            clx_evolve_joints(e, e->order + begin, e->start[c + 1] - begin, volume_of(e, c), &rng);
    }
    e->rate = 2.0 * expected / e->n_live;
    return isfinite(e->rate)
               ? CLAST_OK
               : clx_fail(CLAST_E_CONVERGE, "bodies meet at the rate of %g 1/s", e->rate);
}

/// An event of the step now.
typedef struct {
    double time;
    int64_t event;
} timed;

CLX_RISING_BY_TWO(by_time, timed, time, event)

/// The node of an event that has got another number; `place` [events from `first`].
static int64_t new_node(const clast_evolve *e, int64_t first, const int64_t *place, int64_t node)
{
    const int64_t k = node - e->n_start - first;
    return k < 0 ? node : e->n_start + first + place[k];
}

/// The events from `first` in the order of their times, which cell by cell they are not; nodes are
/// numbered so too. A part of another one is not later than it, and stays before it.
static clast_status order_events(clast_evolve *e, int64_t first)
{
    clast_status status = CLAST_OK;
    const int64_t n = e->n_event - first;
    timed *list = NULL;
    int64_t *place = NULL;
    clx_evolve_event *copy = NULL;
    CLX_TRY(clx_alloc(&list, n, sizeof *list));
    CLX_TRY(clx_alloc(&place, n, sizeof *place));
    CLX_TRY(clx_alloc(&copy, n, sizeof *copy));
    for (int64_t k = 0; k < n; ++k) {
        list[k] = (timed){.time = e->event[first + k].time, .event = k};
    }
    qsort(list, (size_t)n, sizeof *list, by_time);
    for (int64_t k = 0; k < n; ++k) {
        place[list[k].event] = k;
        copy[k] = e->event[first + list[k].event];
    }
    for (int64_t k = 0; k < n; ++k) {
        for (int side = 0; side < 2; ++side) {
            copy[k].node[side] = new_node(e, first, place, copy[k].node[side]);
        }
    }
    memcpy(&e->event[first], copy, (size_t)n * sizeof *copy);
    for (int32_t i = 0; i < e->n_start; ++i) {
        e->body[i].node = new_node(e, first, place, e->body[i].node);
    }
done:
    CLX_FREE(list, place, copy);
    return status;
}

clast_status clx_evolve_meet_all(clast_evolve *e, double dt)
{
    clast_status status = CLAST_OK;
    const int64_t before = e->n_event;
    if (e->n_live < 2) {
        return CLAST_OK;
    }
    for (int32_t c = 0; c < e->cells.n; ++c) {
        clx_rng rng = clx_rng_at(e->config->seed, CLX_STREAM_EVOLVE_MEET,
                                 (e->step << 32) | (uint64_t)(uint32_t)c);
        const int64_t begin = e->start[c];
        const int64_t n = e->start[c + 1] - begin;
        if (n >= CELL_TO_LOOK_AT) {
            (void)clx_monitor_stops(e->monitor); // the step comes to its end all the same
        }
        CLX_TRY(clx_evolve_meet(e, e->order + begin, n, volume_of(e, c), dt, &rng));
    }
    e->rate = 2.0 * (double)(e->n_event - before) / e->n_live / dt;
    e->n_cell = e->cells.n;
    if (e->n_event > before) {
        CLX_TRY(order_events(e, before));
    }
done:
    return status;
}
