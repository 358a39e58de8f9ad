// An evolution step by step: cells on the positions now, who meets in them, motion.
//
// The state is bodies, grains and events; cells are found anew at the beginning of each leg, so
// that a run that goes on from the end of a leg has the same bits. Within a leg they stand while
// the tests of clast_workspace accept them.
#include "evolve/state.h"

#include "base/alloc.h"
#include "cloud/collide.h"
#include "cloud/kernel_range.h"
#include "evolve/config.h"
#include "math/vec3.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum {
    LEG_STEPS = 16,      ///< and from a count of pairs to the next
    MOST_COUNTED = 20000 ///< particles that a count of pairs takes
};

void clast_evolve_destroy(clast_evolve *e)
{
    if (e == NULL) {
        return;
    }
    clx_kit_free(&e->kit);
    clx_flow_free(&e->flow);
    clx_free(e->kind);
    clx_free(e->grain);
    clx_free(e->body);
    clx_free(e->event);
    clast_workspace_destroy(e->workspace);
    if (e->has_decompose) {
        clast_fields_free(clast_decompose_fields, &e->decompose);
    }
    clx_free(e->live);
    clx_free(e->at);
    clx_free(e->order);
    clx_free(e->start);
    clx_rows_free(&e->balance);
    clx_rows_free(&e->spectrum);
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

static clast_status prepare_kit(clast_evolve *e)
{
    clast_status status = CLAST_OK;
    clast_aggregate_params params = {0};
    const clast_aggregate_input input = {.n_coat = e->input->n_shape, .coat = e->input->shape};
    CLX_TRY(clast_aggregate_params_default(&params));
    params.mode = CLAST_AGGREGATE_CLUSTER;
    params.contact = CLAST_CONTACT_EXACT;
    params.size_meaning = CLAST_SIZE_VOLUME;
    CLX_TRY(clx_kit_make(&params, &input, &e->kit));
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
    policy.pairs_every = LEG_STEPS;
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
        n += 2.0 * e->body[i].reach > width ? 1 : 0;
        widest = e->body[i].reach > e->body[widest].reach ? i : widest;
    }
    CLX_CHECK(n == 0, CLAST_E_CONFIG,
              "%d of %d particles are wider than the domain, whose least width is %s (particle %d: "
              "%s, the diameter of the sphere about it); take a larger domain or smaller particles",
              n, e->n_start, clx_unit_text(width, "m"), widest + 1,
              clx_unit_text(2.0 * e->body[widest].reach, "m"));
done:
    return status;
}

/// Height of the domain.
static double height_of(const clast_domain *d)
{
    return d->kind == CLAST_DOMAIN_BOX ? d->high[2] - d->low[2] : cbrt(clast_domain_volume(d));
}

/// Refuses a step in which the mean mass falls onto the floor from wherever it is, and meets
/// nobody.
static clast_status check_time_step(const clast_evolve *e)
{
    clast_status status = CLAST_OK;
    const clast_evolve_config *c = e->config;
    const double height = height_of(e->input->domain);
    double mass = 0.0, fall = 0.0;
    for (int32_t i = 0; i < e->n_start; ++i) {
        mass += e->body[i].mass;
        fall += e->body[i].mass * fabs(e->body[i].speed);
    }
    CLX_CHECK(c->floor != CLAST_BORDER_DEPOSIT || c->time_step * fall <= height * mass,
              CLAST_E_CONFIG,
              "time_step: in %s the mean mass falls %s, through the whole height of %s; take less "
              "than %s, or 0: step_error then chooses it",
              clx_unit_text(c->time_step, "s"), clx_unit_text(c->time_step * fall / mass, "m"),
              clx_unit_text(height, "m"), clx_unit_text(height * mass / fall, "s"));
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
    CLX_TRY(prepare_kit(e));
    CLX_TRY(prepare_cells(e));
    CLX_TRY(place_all(e));
    weigh_all(e);
    CLX_TRY(check_widths(e));
    CLX_TRY(check_time_step(e));
    clx_evolve_list(e);
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
    return clx_evolve_create_again(config, input, evolve);
}

/// Cell of the i-th body in the fluid; < 0: left out. Without cells all are in one.
static int32_t cell_of(const int32_t *cell, int32_t i)
{
    return cell != NULL ? cell[i] : 0;
}

/// Bodies of the fluid by cell: those of cell c are order[start[c] .. start[c + 1]).
static clast_status sort_by_cell(clast_evolve *e, int32_t n, const int32_t *cell)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_grow(&e->start, &e->start_room, (int64_t)n + 1, sizeof *e->start));
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

/// All meetings of a step, cell by cell; pairs meet in `share` times the volume of each.
static clast_status meet_all(clast_evolve *e, int32_t n, const double *volume, double share,
                             double dt)
{
    clast_status status = CLAST_OK;
    const int64_t before = e->n_event;
    const int32_t were = e->n_live;
    for (int32_t c = 0; c < n; ++c) {
        clx_rng rng = clx_rng_at(e->config->seed, CLX_STREAM_EVOLVE_MEET,
                                 (e->step << 32) | (uint64_t)(uint32_t)c);
        const int64_t begin = e->start[c];
        CLX_TRY(clx_evolve_meet(e, e->order + begin, e->start[c + 1] - begin, share * volume[c], dt,
                                &rng));
    }
    e->rate = were > 0 ? 2.0 * (double)(e->n_event - before) / were / dt : 0.0;
    e->n_cell = n;
done:
    return status;
}

/// Volume in which the pairs of a cell meet, over its own: cells taken as uniform hide pairs
/// (smoothing_bias). Where they do not resolve the cloud its pairs of all distances are counted, at
/// most once in LEG_STEPS steps; between, the share of the last count stays.
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
    return !(e->pair_share > 0.0) || e->step - e->pair_step >= LEG_STEPS ||
           5 * (int64_t)e->n_live < 4 * (int64_t)e->pair_n;
}

/// Forgets the cells and says how the next ones show their pairs: by the saved state alone, so that
/// a run that goes on from here has the same bits.
static clast_status begin_leg(clast_evolve *e)
{
    const bool is_due = is_pair_count_due(e);
    e->pair_share = is_due ? 0.0 : e->pair_share;
    e->decompose.estimator = is_due ? CLAST_ESTIMATOR_AUTO : CLAST_ESTIMATOR_CELLS;
    return clast_workspace_forget(e->workspace);
}

/// Cells on the positions now, and who meets in them.
static clast_status meet(clast_evolve *e, double dt)
{
    clast_status status = CLAST_OK;
    const clast_decomposition *made = NULL;
    clast_workspace_calls before;
    clast_workspace_calls after;
    bool is_resolved = false;
    if (e->config->even == CLAST_EVEN_WHOLE) {
        const double volume = clast_domain_volume(e->input->domain);
        CLX_TRY(sort_by_cell(e, 1, NULL));
        CLX_TRY(meet_all(e, 1, &volume, 1.0, dt));
        return CLAST_OK;
    }
    const clast_points points = {
        .n = e->n_live, .dimension = 3, .x = e->at[0], .stride = 3, .axis_stride = 1};
    CLX_TRY(clast_workspace_count(e->workspace, &before));
    CLX_TRY(clast_workspace_decompose_in(e->workspace, e->input->domain, &points, &e->decompose,
                                         &made));
    CLX_TRY(clast_workspace_count(e->workspace, &after));
    const double share = share_of_volume(e, made, after.n_pairs > before.n_pairs, &is_resolved);
    e->n_cut += after.n_cut - before.n_cut;
    e->n_test += after.n_test - before.n_test;
    e->n_unresolved += is_resolved ? 0 : after.n_cut - before.n_cut;
    CLX_TRY(sort_by_cell(e, made->cells.n, made->cells.of_point));
    CLX_TRY(meet_all(e, made->cells.n, made->cells.volume, share, dt));
done:
    return status;
}

/// How long the next step may be: the mean particle meets, and the mean mass falls and spreads,
/// by a share step_error of one and of the height, or of the width between walls that keep what
/// meets them. Ends at the next row.
static double step_of(const clast_evolve *e)
{
    const clast_evolve_config *c = e->config;
    const double height = height_of(e->input->domain);
    const double width = fmin(height, clx_evolve_width(e));
    const double left = c->duration * ((double)(e->row + 1) / c->rows) - e->time;
    double mass = 0.0, fall = 0.0, spread = 0.0;
    for (int32_t k = 0; k < e->n_live; ++k) {
        const clx_evolve_body *b = &e->body[e->live[k]];
        mass += b->mass;
        fall += b->mass * fabs(b->speed);
        spread += b->mass * b->diffusivity;
    }
    double dt = left;
    if (c->time_step > 0.0) {
        dt = c->time_step;
    } else {
        dt = fall > 0.0 ? fmin(dt, c->step_error * height * mass / fall) : dt;
        dt = spread > 0.0 ? fmin(dt, c->step_error * width * width * mass / spread) : dt;
        dt = e->rate > 0.0 ? fmin(dt, c->step_error / e->rate) : dt;
    }
    const double parts = ceil(left / dt);
    return parts > 1.0 ? left / parts : left;
}

static clast_status step(clast_evolve *e, bool *is_row)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(e->step < UINT32_MAX, CLAST_E_LIMIT, "more than %u steps; take a longer time_step",
              UINT32_MAX);
    const double next = e->config->duration * ((double)(e->row + 1) / e->config->rows);
    const double dt = step_of(e);
    *is_row = e->time + dt >= next * (1.0 - 1e-12);
    if (e->n_live > 1) {
        CLX_TRY(meet(e, dt));
    }
    CLX_TRY(clx_evolve_move(e, dt));
    e->time = *is_row ? next : e->time + dt;
    ++e->step;
    clx_evolve_list(e);
done:
    return status;
}

clast_status clast_evolve_advance(clast_evolve *e)
{
    CLX_ARGUMENTS(e);
    clast_status status = CLAST_OK;
    bool is_row = false;
    CLX_TRY(begin_leg(e));
    for (int k = 0; k < LEG_STEPS && !is_row && !clast_evolve_is_over(e); ++k) {
        CLX_TRY(step(e, &is_row));
        is_row = is_row || e->n_live == 0;
    }
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
