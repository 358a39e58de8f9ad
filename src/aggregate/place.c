// Growth on a core: each particle is thrown by the method of contact, is placed by its best trial,
// and stays.
#include "aggregate/state.h"

#include "aggregate/trial.h"
#include "aggregate/walk.h"
#include "base/clock.h"
#include "base/parallel.h"
#include "math/vec3.h"
#include <stdio.h>

// A search shorter than this is not worth waking other threads for, which takes tens of
// microseconds on an idle machine and milliseconds on a busy one. What a shared search would take
// on one thread is known from above only, so that every PROBE-th is made on one thread to see.
static const double SHARED_FROM = 5e-4;
enum { PROBE = 256 };

static void prepare_search(const clast_aggregate *a, int32_t shape, clx_search *search)
{
    CLAST_ASSERT(shape >= 0 && shape + 1 < a->templates.n_group);
    const clast_aggregate_params *c = a->params;
    *search =
        (clx_search){.templates = &a->templates,
                     .group = &a->templates.group[1 + shape],
                     .scale = clx_aggregate_scale(a, a->n_placed, shape),
                     .size = a->size[a->n_placed],
                     .scene = a->scene,
                     .n_body = a->assembly.n_grain,
                     .sphere_end = a->sphere_end,
                     .origin = a->origin,
                     .aim = clx_aggregate_aim(a),
                     .n_orientation = c->orientations,
                     .start = c->start,
                     .approach = c->approach,
                     .bounding_radius = a->bounding_radius,
                     .walk_step = c->walk_step,
                     .on_one_thread = a->n_placed % PROBE == PROBE - 1 || a->alone_s < SHARED_FROM};
    if (a->origin == CLAST_ORIGIN_MASS) {
        v3_scale(search->centre, 1.0 / a->mass, a->moment);
    }
    if (c->target == CLAST_TARGET_MASS) {
        v3_scale(search->target, 1.0 / a->mass, a->moment);
    }
}

enum { HULL, PROOF, N_PIECE };

/// The pieces of an arrival. The scene may hold the new grains already: the proof looks at those
/// before them.
static void arrive(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_aggregate *a = context;
    clx_arrival *last = &a->arrival;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        if (i == PROOF) {
            last->overlap = clx_search_overlap(&last->search, &last->placement);
            continue;
        }
        last->is_done = true;
        last->status = clx_aggregate_track(a, last->first);
        if (last->status != CLAST_OK) {
            (void)snprintf(last->detail, sizeof last->detail, "%s", clast_error_detail());
        }
    }
}

static clast_status settle(clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    clx_arrival *last = &a->arrival;
    if (!last->is_due) {
        return CLAST_OK;
    }
    if (!last->is_done) {
        clx_parallel_for(N_PIECE, last->search.on_one_thread ? N_PIECE : 1, arrive, a);
    }
    last->is_due = false;
    a->is_torn = true;
    CLX_CHECK(last->status == CLAST_OK, last->status, "%s", last->detail);
    double *row = &a->history.value[last->row * a->history.n_column];
    row[CLX_HISTORY_OVERLAP] = last->overlap;
    CLX_TRY(clx_aggregate_measure_row(a, row));
    a->is_torn = false;
done:
    return status;
}

/// The last particle's arrival goes beside this search, unless one thread would do both.
static void bring_beside(clast_aggregate *a, clx_search *search)
{
    if (!a->arrival.is_due) {
        return;
    }
    if (search->on_one_thread || search->approach == CLAST_APPROACH_DIFFUSIVE ||
        clx_parallel_workers() == 1) {
        arrive(0, N_PIECE, 0, a);
    } else {
        search->beside = (clx_beside){N_PIECE, arrive, a};
    }
}

/// The placement, with new axes as long as every ray misses.
static clast_status throw_particle(clast_aggregate *a, clx_search *search, clx_placement *placement)
{
    clast_status status = CLAST_OK;
    bring_beside(a, search);
    const double begun = clx_clock();
    const double worked = clx_clock_thread();
    const int32_t tries = clx_search_tries(a->params);
    CLX_TRY(clx_walk_or_search(search, tries, placement));
    CLX_CHECK(placement->found || search->approach == CLAST_APPROACH_CENTRAL, CLAST_E_CONVERGE,
              "particle %d of %d: all of %d %s miss the aggregate; raise max_tries",
              a->n_placed + 1, a->n_particle, tries, clx_search_paths(search));
    CLX_CHECK(placement->found, CLAST_E_CONVERGE,
              "particle %d of %d: all rays of %d axes miss the aggregate; widen the cone or let "
              "rays start at a grain (origin: grain)",
              a->n_placed + 1, a->n_particle, tries);
done:
    a->contact_s += clx_clock() - begun;
    a->alone_s =
        (clx_clock_thread() - worked) * (search->on_one_thread ? 1 : clx_parallel_workers());
    return status;
}

static clast_status place_by_touch(clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    clx_search search;
    clx_placement placement;
    double *row = NULL;
    const int32_t shape = clx_aggregate_shape(a, a->n_placed);
    const int32_t first = a->assembly.n_grain;
    prepare_search(a, shape, &search);
    CLX_TRY(throw_particle(a, &search, &placement));
    CLX_TRY(settle(a));
    a->is_torn = true;
    CLX_TRY(clx_aggregate_lay_group(a, 1 + shape, placement.centre, placement.orientation,
                                    search.scale));
    CLX_TRY(clx_aggregate_account_all(a, first));
    CLX_TRY(clast_assembly_add_contact(&a->assembly, placement.touch.body, first + placement.part,
                                       placement.touch.point));
    ++a->n_placed;
    CLX_TRY(clx_aggregate_open_row(a, &row));
    row[CLX_HISTORY_SHAPE] = shape;
    row[CLX_HISTORY_SIZE] = search.size;
    row[CLX_HISTORY_DISTANCE] = placement.distance;
    row[CLX_HISTORY_RAYS] = (double)search.aim.n_ray * (search.aim.attempt + 1);
    row[CLX_HISTORY_TOUCHED] = placement.touch.body;
    a->arrival = (clx_arrival){.is_due = true,
                               .search = search,
                               .placement = placement,
                               .first = first,
                               .row = a->history.n_row - 1};
    a->is_torn = false;
done:
    return status;
}

static clast_status place_by_march(clast_aggregate *a)
{
    clast_status status = CLAST_OK;
    const double size = a->size[a->n_placed];
    const int32_t first = a->assembly.n_grain;
    const clx_aim aim = clx_aggregate_aim(a);
    clx_march_placement placement;
    double centre[3], arm[3];
    double *row = NULL;
    const double begun = clx_clock();
    CLX_TRY(clx_march_run(&a->march, &aim, size, &placement));
    a->contact_s += clx_clock() - begun;
    const int32_t group = 1 + placement.shape;
    q_rotate(arm, placement.orientation, a->march.shape[group].centroid);
    v3_axpy(centre, placement.centroid, -placement.scale, arm);
    a->is_torn = true;
    CLX_TRY(clx_aggregate_add_group(a, group, centre, placement.orientation,
                                    placement.scale / a->templates.group[group].part[0].scale));
    CLX_TRY(clast_assembly_add_contact(&a->assembly, placement.touched, first, placement.point));
    ++a->n_placed;
    CLX_TRY(clx_aggregate_add_row(a, &row));
    row[CLX_HISTORY_SHAPE] = placement.shape;
    row[CLX_HISTORY_SIZE] = size;
    row[CLX_HISTORY_DISTANCE] = placement.distance;
    row[CLX_HISTORY_RAYS] = a->params->rays;
    row[CLX_HISTORY_TOUCHED] = placement.touched;
    row[CLX_HISTORY_LOST] = placement.lost ? 1.0 : 0.0;
    a->is_torn = false;
done:
    return status;
}

static clast_status place(clast_aggregate *a)
{
    CLAST_ASSERT(a->n_placed < a->n_step);
    return a->params->contact == CLAST_CONTACT_MARCH ? place_by_march(a) : place_by_touch(a);
}

static clast_status plan(clast_aggregate *a)
{
    a->n_step = a->n_particle;
    return CLAST_OK;
}

const clx_aggregate_mode clx_aggregate_on_core = {.is_one_body = true,
                                                  .plan = plan,
                                                  .begin = clx_aggregate_begin_core,
                                                  .step = place,
                                                  .settle = settle,
                                                  .measured = clx_aggregate_measured_core,
                                                  .restore = clx_aggregate_restore_core};
