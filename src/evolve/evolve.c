// An evolution step by step: cells on the positions now, who meets in them, motion.
#include "evolve/state.h"

#include "base/alloc.h"
#include "base/clock.h"
#include "base/monitor.h"
#include "cloud/collide.h"
#include "cloud/kernel_range.h"
#include "evolve/config.h"
#include "math/vec3.h"
#include <math.h>

enum { MOST_COUNTED = 20000 }; ///< particles that a count of pairs takes

void clast_evolve_destroy(clast_evolve *e)
{
    if (e == NULL) {
        return;
    }
    clx_templates_free(&e->templates);
    clx_flow_free(&e->flow);
    CLX_FREE(e->kind, e->grain, e->body, e->event);
    clast_workspace_destroy(e->workspace);
    if (e->has_decompose) {
        clast_fields_free(clast_decompose_fields, &e->decompose);
    }
    CLX_FREE(e->live, e->at, e->order, e->start);
    clx_rows_free(&e->balance);
    clx_rows_free(&e->spectrum);
    clx_rows_free(&e->cuts);
    clx_free(e);
}

/// Kernel's mask, medium and meeting in full.
static clast_status prepare_encounters(clast_evolve *e)
{
    clast_status status = CLAST_OK;
    const clast_evolve_config *c = e->config;
    CLX_TRY(clx_evolve_collide(c, &e->collide));
    CLX_TRY(clx_evolve_wind_read(c, e->wind));
    e->ranges = clx_ranges_of(&e->collide);
    e->meeting = clx_evolve_meeting(c, e->collide.kernel);
done:
    return status;
}

static clast_status prepare_templates(clast_evolve *e)
{
    clast_status status = CLAST_OK;
    clast_aggregate_params params = {0};
    const clast_aggregate_input input = {.n_coat = e->input->n_shape, .coat = e->input->shape};
    CLX_TRY(clast_aggregate_params_default(&params));
    params.mode = CLAST_AGGREGATE_CLUSTER;
    params.contact = CLAST_CONTACT_EXACT;
    params.size_meaning = CLAST_SIZE_VOLUME;
    CLX_TRY(clx_templates_make(&params, &input, &e->templates));
    CLX_TRY(clx_evolve_kinds(e));
done:
    clast_aggregate_params_free(&params);
    return status;
}

static clast_status prepare_cells(clast_evolve *e)
{
    clast_status status = CLAST_OK;
    clast_workspace_policy policy;
    CLX_TRY(clast_workspace_create(&e->workspace));
    CLX_TRY(clast_fields_default(clast_workspace_fields, &policy));
    policy.tests = CLAST_TESTS_MOVED;
    policy.cells = CLAST_CUT_CHANGED;
    policy.cells_level = e->config->change_level;
    policy.pairs_every = CLX_LEG_STEPS;
    policy.pairs_most = MOST_COUNTED;
    CLX_TRY(clast_workspace_set_policy(e->workspace, &policy));
    CLX_TRY(clast_fields_default(clast_decompose_fields, &e->decompose));
    e->has_decompose = true;
    e->decompose.mesh = e->config->even == CLAST_EVEN_BOXES ? CLAST_CELLS_BOXES : CLAST_CELLS_TREE;
    e->decompose.seed = e->config->seed;
done:
    return status;
}

/// A shape by weight.
static int32_t draw_shape(const clast_evolve *e, int32_t i)
{
    const clast_f64_list *weight = &e->config->shape_weight;
    clx_rng rng = clx_rng_at(e->config->seed, CLX_STREAM_EVOLVE_SHAPE, (uint64_t)i);
    if (weight->n == 0) {
        return (int32_t)clx_rng_below(&rng, e->n_kind);
    }
    double sum = 0.0;
    for (int32_t k = 0; k < weight->n; ++k) {
        sum += weight->item[k];
    }
    double at = clx_rng_uniform(&rng) * sum;
    int32_t last = 0;
    for (int32_t k = 0; k < weight->n; ++k) {
        at -= weight->item[k];
        last = weight->item[k] > 0.0 ? k : last;
        if (at < 0.0) {
            return k;
        }
    }
    return last;
}

/// Where particle i begins: a point of the file, or even over the release that is inside.
static clast_status draw_place(const clast_evolve *e, int32_t i, double x[3])
{
    enum { MOST_TRIES = 100000 };
    clast_status status = CLAST_OK;
    const clast_domain *domain = e->input->domain;
    const clast_domain *release = e->input->release != NULL ? e->input->release : domain;
    const clast_cloud *points = e->input->points;
    double u[3];
    bool is_inside = false;
    clx_rng rng = clx_rng_at(e->config->seed, CLX_STREAM_EVOLVE_PLACE, (uint64_t)i);
    if (points != NULL) {
        v3_copy(x, &points->x[3 * (size_t)i]);
        CLX_CHECK(v3_is_finite(x), CLAST_E_FORMAT,
                  "points: row %d has a coordinate that is not finite", i + 1);
        CLX_CHECK(clast_domain_map(domain, x, u), CLAST_E_FORMAT,
                  "points: row %d lies outside the domain", i + 1);
        return CLAST_OK;
    }
    for (int tries = 0; tries < MOST_TRIES && !is_inside; ++tries) {
        for (int k = 0; k < 3; ++k) {
            u[k] = clx_rng_uniform(&rng);
        }
        clast_domain_unmap(release, u, x);
        is_inside = clast_domain_map(domain, x, u) && clast_domain_map(release, x, u);
    }
    CLX_CHECK(is_inside, CLAST_E_CONFIG,
              "release: none of %d points drawn in it lies inside the domain", MOST_TRIES);
done:
    return status;
}

static clast_status place_all(clast_evolve *e)
{
    clast_status status = CLAST_OK;
    const clast_evolve_config *c = e->config;
    const clast_cloud *points = e->input->points;
    e->n_start = points != NULL ? (int32_t)points->n : c->particles;
    CLX_TRY(clx_alloc(&e->grain, e->n_start, sizeof *e->grain));
    CLX_TRY(clx_alloc(&e->body, e->n_start, sizeof *e->body));
    CLX_TRY(clx_alloc(&e->live, e->n_start, sizeof *e->live));
    CLX_TRY(clx_alloc(&e->at, e->n_start, sizeof *e->at));
    CLX_TRY(clx_alloc(&e->order, e->n_start, sizeof *e->order));
    for (int32_t i = 0; i < e->n_start; ++i) {
        clx_evolve_grain *grain = &e->grain[i];
        const double size = points != NULL && points->radius != NULL
                                ? 2.0 * points->radius[i]
                                : clast_grading_draw(e->input->grading, c->seed, (uint64_t)i);
        CLX_CHECK(size > 0.0 && isfinite(size), CLAST_E_FORMAT, "particle %d has the diameter %s",
                  i + 1, clx_unit_text(size, "m"));
        grain->kind = draw_shape(e, i);
        grain->next = -1;
        grain->orientation[0] = 1.0;
        grain->scale = size / cbrt(6.0 * e->kind[grain->kind].volume / CLAST_PI);
        CLX_TRY(draw_place(e, i, e->body[i].x));
    }
done:
    return status;
}

/// What the shapes weigh, and bodies of one grain each.
static void weigh_all(clast_evolve *e)
{
    double volume = 0.0;
    clx_sum total = {0};
    for (int32_t i = 0; i < e->n_start; ++i) {
        const clx_evolve_kind *kind = &e->kind[e->grain[i].kind];
        const double s = e->grain[i].scale;
        volume += kind->volume * s * s * s;
        clx_sum_add(&total, kind->mass * s * s * s);
    }
    const double mass = clx_sum_of(&total);
    e->mass_start = mass * e->config->weight;
    e->collide.medium.particle_density = mass / volume;
    for (int32_t i = 0; i < e->n_start; ++i) {
        clx_evolve_single(e, i, &e->body[i]);
    }
}

/// Refuses particles that are wider than the domain. Pairs meet in the frame of the larger, images
/// of a periodic box are not looked at: half of the width is no limit.
static clast_status check_widths(const clast_evolve *e)
{
    clast_status status = CLAST_OK;
    const double width = clx_evolve_least_width(e->input->domain);
    int32_t n = 0;
    int32_t widest = 0;
    for (int32_t i = 0; i < e->n_start; ++i) {
        n += 2.0 * e->body[i].bounding_radius > width ? 1 : 0;
        widest = e->body[i].bounding_radius > e->body[widest].bounding_radius ? i : widest;
    }
    CLX_CHECK(n == 0, CLAST_E_CONFIG,
              "%d of %d particles are wider than the domain, whose least width is %s (particle %d: "
              "%s, the diameter of the sphere about it); take a larger domain or smaller particles",
              n, e->n_start, clx_unit_text(width, "m"), widest + 1,
              clx_unit_text(2.0 * e->body[widest].bounding_radius, "m"));
done:
    return status;
}

clast_status clx_evolve_create_again(const clast_evolve_config *config,
                                     const clast_evolve_input *input, clast_evolve **evolve)
{
    clast_status status = CLAST_OK;
    clast_evolve *e = NULL;
    CLX_TRY(clx_evolve_config_check(config, input));
    CLX_TRY(clx_alloc(&e, 1, sizeof *e));
    e->config = config;
    e->input = input;
    CLX_TRY(prepare_encounters(e));
    if (input->field != NULL) {
        CLX_TRY(clx_flow_make(input->field, &e->flow));
    }
    CLX_TRY(prepare_templates(e));
    CLX_TRY(prepare_cells(e));
    CLX_TRY(place_all(e));
    weigh_all(e);
    CLX_TRY(check_widths(e));
    clx_evolve_list(e);
    CLX_TRY(clx_evolve_check_time_step(e));
    CLX_TRY(clx_evolve_check_mirrors(e));
    e->is_field_apart = clx_evolve_is_field_apart(e);
    CLX_TRY(clast_kernel_check(e->collide.kernel, &e->collide.medium));
    CLX_TRY(clx_collide_config_check(&e->collide));
    CLX_TRY(clx_evolve_series_begin(e));
    *evolve = e;
    e = NULL;
done:
    clast_evolve_destroy(e);
    return status;
}

clast_status clast_evolve_create(const clast_evolve_config *config, const clast_evolve_input *input,
                                 clast_evolve **evolve)
{
    CLX_ARGUMENTS(config, input, evolve);
    CLX_GUARD(clx_evolve_config_check(config, input));
    CLX_GUARD(clx_evolve_idle_check(config, input));
    CLX_GUARD(clx_evolve_release_check(input));
    return clx_evolve_create_again(config, input, evolve);
}

static clast_status step(clast_evolve *e, bool *is_row)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(e->step < UINT32_MAX, CLAST_E_LIMIT, "more than %u steps; take a longer time_step",
              UINT32_MAX);
    const double next = e->config->duration * ((double)(e->row + 1) / e->config->rows);
    double dt = 0.0;
    CLX_TRY(clx_evolve_find_cells(e));
    CLX_TRY(clx_evolve_find_rate(e));
    dt = clx_evolve_step_of(e);
    *is_row = e->time + dt >= next * (1.0 - 1e-12);
    CLX_TRY(clx_evolve_meet_all(e, dt));
    CLX_TRY(clx_evolve_move(e, dt));
    e->time = *is_row ? next : e->time + dt;
    ++e->step;
    ++e->leg_step;
    clx_evolve_list(e);
done:
    return status;
}

/// The row that is due, and whether collisions were in their ranges.
static clast_status end_leg(clast_evolve *e, bool is_row)
{
    clast_status status = CLAST_OK;
    clx_evolve_end_leg(e);
    if (is_row) {
        ++e->row;
        CLX_TRY(clx_evolve_write_row(e));
    }
    if (e->collide.out_of_range == CLAST_OUT_OF_RANGE_ERROR) {
        CLX_TRY(clx_range_check(&e->range, "of the collisions"));
    }
done:
    return status;
}

clast_status clx_evolve_advance_until(clast_evolve *e, const clast_monitor *monitor, double until)
{
    clast_status status = CLAST_OK;
    bool is_row = false;
    bool is_asked = false;
    e->monitor = monitor;
    CLX_TRY(clx_evolve_begin_leg(e));
    while (e->leg_step < CLX_LEG_STEPS && !is_row && !is_asked && !clast_evolve_is_over(e)) {
        CLX_TRY(step(e, &is_row));
        is_row = is_row || e->n_live == 0;
        is_asked = clx_monitor_stops(monitor) || clx_clock() > until;
    }
    if (e->leg_step >= CLX_LEG_STEPS || is_row || clast_evolve_is_over(e)) {
        CLX_TRY(end_leg(e, is_row));
    }
done:
    return status;
}

clast_status clast_evolve_advance(clast_evolve *e)
{
    CLX_ARGUMENTS(e);
    return clx_evolve_advance_until(e, NULL, (double)INFINITY);
}

bool clast_evolve_is_over(const clast_evolve *e)
{
    if (e == NULL) {
        return true;
    }
    return e->row >= e->config->rows || e->n_live == 0;
}

double clast_evolve_time(const clast_evolve *e)
{
    return e != NULL ? e->time : (double)NAN;
}

int32_t clast_evolve_n_row(const clast_evolve *e)
{
    return e != NULL ? e->row : 0;
}
