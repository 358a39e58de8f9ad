// Growth: step by step in one of the modes, until something stops it.
//
// The state is the placed grains and their rows; everything else (trees, sums, envelopes) follows
// from them in the order of placement. That is why a restored run ends in the same bytes.
#include "aggregate/state.h"

#include "aggregate/config.h"
#include "aggregate/sizes.h"
#include "base/alloc.h"
#include "base/clock.h"
#include "base/monitor.h"
#include "math/rng.h"
#include <clast/shape.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const clx_aggregate_mode *const MODE[] = {[CLAST_AGGREGATE_CORE] = &clx_aggregate_on_core,
                                                 [CLAST_AGGREGATE_CLUSTER] =
                                                     &clx_aggregate_by_cluster};

void clast_aggregate_destroy(clast_aggregate *a)
{
    if (a == NULL) {
        return;
    }
    clx_clusters_free(&a->clusters);
    clx_aggregate_free(a);
    clx_free(a);
}

static uint64_t seed_of(const clast_aggregate_params *params, int32_t repeat)
{
    CLAST_ASSERT(repeat >= 0);
    if (repeat == 0) {
        return params->seed;
    }
    clx_rng rng = clx_rng_at(params->seed, CLX_STREAM_AGGREGATE_REPEAT, (uint64_t)repeat);
    const uint64_t high = clx_rng_u32(&rng);
    return (high << 32) | clx_rng_u32(&rng);
}

/// Shapes of the templates under names of their own: a name that is taken gets a number.
static clast_status add_shapes(clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    clast_shape copy = {0};
    CLX_TRY(clx_alloc(&a->shape_id, a->templates.n_shape, sizeof *a->shape_id));
    CLX_TRY(clx_alloc(&a->template_shape, a->templates.n_shape, sizeof *a->template_shape));
    for (int32_t i = 0; i < a->templates.n_shape; ++i) {
        const clast_shape *shape = a->templates.shape[i].shape;
        char name[256];
        (void)snprintf(name, sizeof name, "%s", shape->name);
        int32_t same = 1;
        for (int32_t k = 0; k < a->assembly.n_shape; ++k) {
            if (strcmp(a->assembly.shape[k].name, name) == 0) {
                (void)snprintf(name, sizeof name, "%.200s-%d", shape->name, ++same);
                k = -1;
            }
        }
        CLX_TRY(clast_shape_copy(shape, &copy));
        clx_free(copy.name);
        copy.name = NULL;
        CLX_TRY(clx_alloc_text(&copy.name, name));
        CLX_TRY(clast_assembly_add_shape(&a->assembly, &copy, &a->shape_id[i]));
        a->template_shape[a->shape_id[i]] = i;
        clast_shape_free(&copy);
    }
done:
    clast_shape_free(&copy);
    return status;
}

static clast_status prepare_contact(clast_aggregate *a)
{
    if (a->params->contact == CLAST_CONTACT_MARCH) {
        return clx_march_make(a->params, &a->templates, a->seed, &a->march);
    }
    if (!a->mode->is_one_body) {
        return CLAST_OK;
    }
    const clast_status status = clx_touch_scene_create(&a->scene);
    if (status == CLAST_OK) {
        clx_touch_scene_expect(a->scene, a->params->rays);
    }
    return status;
}

/// Templates, sizes and an empty scene: all that is known before the first grain.
static clast_status prepare(clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    const clast_aggregate_params *c = a->params;
    CLX_TRY(clx_templates_make(c, a->input, &a->templates));
    CLX_TRY(clx_sizes_plan(c, a->input->sizes, a->seed, &a->size, &a->n_particle));
    CLX_TRY(prepare_contact(a));
    CLX_TRY(clx_history_init(&a->history));
    CLX_TRY(clx_aggregate_measure_begin(a));
    CLX_TRY(add_shapes(a));
done:
    return status;
}

clast_status clx_aggregate_begin(const clast_aggregate_params *params,
                                 const clast_aggregate_input *input, int32_t repeat,
                                 clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    const clx_aggregate_given given = {
        .core = input->core != NULL, .n_coat = input->n_coat, .sizes = input->sizes != NULL};
    CLX_CHECK(input->n_coat <= 0 || input->coat != NULL, CLAST_E_ARGUMENT,
              "%d coating shapes, and input->coat is NULL", input->n_coat);
    CLX_CHECK(repeat >= 0, CLAST_E_ARGUMENT, "repeat %d of an aggregate; the first is 0", repeat);
    CLX_TRY(clx_aggregate_params_check(params, &given));
    a->mode = MODE[params->mode];
    a->params = params;
    a->input = input;
    a->repeat = repeat;
    a->seed = seed_of(params, repeat);
    a->alone_s = HUGE_VAL;
    (void)snprintf(a->assembly.unit, sizeof a->assembly.unit, "m");
    CLX_TRY(clx_aggregate_axis(params, &a->random_axis, a->axis));
    CLX_TRY(prepare(a));
    CLX_TRY(a->mode->plan(a));
done:
    return status;
}

clast_status clast_aggregate_create(const clast_aggregate_params *params,
                                    const clast_aggregate_input *input, int32_t repeat,
                                    clast_aggregate **aggregate)
{
    CLX_ARGUMENTS(params, input, aggregate);
    clast_status status = CLAST_OK;
    clast_aggregate *a = NULL;
    const double begun = clx_clock();
    CLX_TRY(clx_alloc(&a, 1, sizeof *a));
    CLX_TRY(clx_aggregate_begin(params, input, repeat, a));
    CLX_TRY(a->mode->begin(a));
    a->wall_s = clx_clock() - begun;
    *aggregate = a;
    a = NULL;
done:
    clast_aggregate_destroy(a);
    return status;
}

static clast_status check_whole(const clast_aggregate *a)
{
    return a->is_torn ? clx_fail(CLAST_E_USAGE,
                                 "the aggregate was left in the middle of a step by a call that "
                                 "failed: destroy it, and create or restore it anew")
                      : CLAST_OK;
}

/// Last row's value in an envelope column, NAN when that row was not measured.
static double last_value(const clast_aggregate *a, int32_t column)
{
    CLAST_ASSERT(column >= 0 && column < a->history.n_column);
    const clx_history *h = &a->history;
    return h->n_row > 0 ? h->value[(h->n_row - 1) * h->n_column + column] : (double)NAN;
}

clast_aggregate_stop clx_aggregate_stop_now(const clast_aggregate *a)
{
    const clast_aggregate_params *c = a->params;
    if (c->stop_mass > 0.0 && last_value(a, CLX_HISTORY_MASS) >= c->stop_mass) {
        return CLAST_STOP_MASS;
    }
    if (c->stop_size > 0.0 && last_value(a, CLX_HISTORY_FIXED) >= c->stop_size) {
        return CLAST_STOP_SIZE;
    }
    if (c->stop_porosity > 0.0 && last_value(a, CLX_HISTORY_FIXED + 2) >= c->stop_porosity) {
        return CLAST_STOP_POROSITY;
    }
    return a->n_placed == a->n_step ? CLAST_STOP_LIST : CLAST_STOP_NOT;
}

static clast_status settle(clast_aggregate *a)
{
    return a->mode->settle != NULL ? a->mode->settle(a) : CLAST_OK;
}

static clast_status step(clast_aggregate *a)
{
    clast_status status = a->mode->step(a);
    if (status == CLAST_OK && (a->params->stop_size > 0.0 || a->params->stop_porosity > 0.0)) {
        status = settle(a);
    }
    a->stop = status == CLAST_OK ? clx_aggregate_stop_now(a) : CLAST_STOP_NOT;
    if (a->mode->end != NULL && a->stop != CLAST_STOP_NOT) {
        a->mode->end(a);
    }
    return status;
}

clast_status clast_aggregate_grow(clast_aggregate *a, int32_t n, const clast_monitor *monitor)
{
    CLX_ARGUMENTS(a);
    clast_status status = CLAST_OK;
    clast_status settled = CLAST_OK;
    if (n < 0) {
        return clx_fail(CLAST_E_ARGUMENT, "%s: %d more particles", __func__, n);
    }
    CLX_GUARD(check_whole(a));
    const double begun = clx_clock();
    for (int32_t i = 0; i < n && a->stop == CLAST_STOP_NOT; ++i) {
        CLX_CHECK(!clx_monitor_stops(monitor), CLAST_E_STOPPED, "stopped after %d of %d steps",
                  a->n_placed, a->n_step);
        CLX_TRY(step(a));
        clx_monitor_report(monitor, "grow", a->n_placed, a->n_step);
    }
done:
    settled = a->is_torn ? CLAST_OK : settle(a);
    a->wall_s += clx_clock() - begun;
    return status != CLAST_OK ? status : settled;
}

bool clast_aggregate_is_done(const clast_aggregate *a)
{
    if (a == NULL) {
        return true;
    }
    return a->stop != CLAST_STOP_NOT;
}

int32_t clast_aggregate_n_particle(const clast_aggregate *a)
{
    if (a == NULL) {
        return 0;
    }
    return a->n_particle;
}

const clast_assembly *clast_aggregate_assembly(const clast_aggregate *a)
{
    if (a == NULL || a->is_torn) {
        return NULL;
    }
    return &a->assembly;
}

clast_status clast_aggregate_history(const clast_aggregate *a, clast_table *history)
{
    CLX_ARGUMENTS(a, history);
    CLX_GUARD(check_whole(a));
    return clx_history_table(&a->history, history);
}

/// The worst overlap and the lost ones, from the rows; the march puts no particle back.
static void faults(const clast_aggregate *a, clast_aggregate_result *r)
{
    if (a->params->contact == CLAST_CONTACT_MARCH) {
        r->max_overlap = (double)NAN;
        r->max_overlap_relative = (double)NAN;
    }
    for (int64_t i = 0; i < a->history.n_row; ++i) {
        const double *row = &a->history.value[i * a->history.n_column];
        const double overlap = row[CLX_HISTORY_OVERLAP];
        if (!isnan(r->max_overlap)) {
            r->max_overlap = fmax(r->max_overlap, overlap);
            r->max_overlap_relative =
                fmax(r->max_overlap_relative, overlap / row[CLX_HISTORY_SIZE]);
        }
        r->n_lost += row[CLX_HISTORY_LOST] > 0.0 ? 1 : 0;
    }
}

clast_status clast_aggregate_measure(const clast_aggregate *a, clast_aggregate_result *result)
{
    CLX_ARGUMENTS(a, result);
    clast_status status = CLAST_OK;
    clast_aggregate_result r = {.n_particle = a->n_placed,
                                .stop = a->stop,
                                .contact_s = a->contact_s,
                                .envelope_s = a->envelope_s,
                                .wall_s = a->wall_s};
    CLX_TRY(check_whole(a));
    faults(a, &r);
    CLX_TRY(clx_aggregate_measure_end(a, &r));
    *result = r;
done:
    return status;
}

clast_status clast_aggregate_members(const clast_aggregate *a, clast_table *members)
{
    CLX_ARGUMENTS(a, members);
    CLX_GUARD(check_whole(a));
    return clx_clusters_members(a, members);
}
