// Collisions of one time step, cell by cell. [docs/theory/agglomeration.md section 2]
#include "cloud/collide.h"

#include "base/alloc.h"
#include "base/field.h"
#include "base/parallel.h"
#include "cloud/kernel_range.h"
#include <clast/agglomerate.h>
#include <math.h>

enum { KIND_LIMIT = 50000, CELLS_A_BLOCK = 1, EVENTS_A_PARCEL = 1000 };

uint32_t clx_collide_needs(const clast_collide_config *c)
{
    return clast_kernel_needs(c->kernel) |
           (c->sticking.law != CLAST_STICKING_CONSTANT ? CLAST_NEEDS_RADIUS | CLAST_NEEDS_MASS : 0);
}

typedef struct {
    clast_population *population;
    const clast_collide_cells *cells;
    const clast_collide_config *config;
    double dt;
    uint64_t step;
    uint32_t needs, ranges;
    clast_range_use *range; ///< [n_cell], or NULL where no kernel has ranges
    clx_collide_scratch scratch;
    int64_t *start; ///< [n_cell + 1] in scratch.order
    int64_t *n_event;
    double *n_real;
    bool *is_too_many;
} step_context;

/// A cell's particles as a block, without random numbers.
static clx_block block_of(const step_context *s, int32_t c)
{
    const int64_t begin = s->start[c];
    return (clx_block){.config = s->config,
                       .medium =
                           s->cells->medium != NULL ? &s->cells->medium[c] : &s->config->medium,
                       .population = s->population,
                       .member = s->scratch.order + begin,
                       .next = s->scratch.next,
                       .frozen = s->scratch.frozen + begin,
                       .n = s->start[c + 1] - begin,
                       .kind = s->scratch.kind + begin,
                       .rate_factor = 1.0,
                       .scale = s->config->alpha / s->cells->volume[c],
                       .needs = s->needs,
                       .ranges = s->ranges};
}

static void evolve_cell(const step_context *s, int32_t c)
{
    const int64_t begin = s->start[c];
    const int64_t n = s->start[c + 1] - begin;
    const int32_t limit = s->config->block;
    clx_rng rng =
        clx_rng_at(s->config->seed, CLX_STREAM_COLLISION, (s->step << 32) | (uint64_t)(uint32_t)c);
    clx_block block = block_of(s, c);
    block.rng = &rng;
    if (n < 1 || (n < 2 && !(s->config->self_collisions && s->population->weight != NULL))) {
        return;
    }
    clx_block_shuffle(block.member, n, &rng);
    if (clx_block_sort(&block, limit > 0 ? limit : KIND_LIMIT)) {
        (void)clx_block_rates(&block);
        clx_block_evolve(&block, s->dt);
    } else if (limit > 0) {
        clx_block_evolve_partitioned(&block, s->scratch.n_kind + begin, s->dt);
    } else {
        s->is_too_many[c] = true;
    }
    s->n_event[c] = block.n_event;
    s->n_real[c] = block.n_real;
    if (s->range != NULL) {
        s->range[c] = block.range;
    }
}

static void evolve_cells(int64_t begin, int64_t end, int32_t worker, void *context)
{
    (void)worker;
    for (int64_t c = begin; c < end; ++c) {
        evolve_cell(context, (int32_t)c);
    }
}

/// Live particles by cell, in order of number within a cell.
static void sort_by_cell(step_context *s)
{
    const clast_population *p = s->population;
    const int32_t *cell = s->cells->of_particle;
    for (int64_t i = 0; i < p->n; ++i) {
        if (p->monomers[i] > 0 && cell[i] >= 0) {
            ++s->start[cell[i] + 1];
        }
    }
    for (int32_t c = 0; c < s->cells->n; ++c) {
        s->start[c + 1] += s->start[c];
    }
    for (int64_t i = 0; i < p->n; ++i) {
        if (p->monomers[i] > 0 && cell[i] >= 0) {
            s->scratch.order[s->start[cell[i]]++] = i;
        }
    }
    for (int32_t c = s->cells->n; c > 0; --c) {
        s->start[c] = s->start[c - 1];
    }
    s->start[0] = 0;
}

/// Whether all kernels have an impact speed.
static bool has_speed(uint32_t kernel)
{
    bool is_any_model = false;
    for (int k = 0; k < CLAST_N_KERNEL; ++k) {
        is_any_model =
            is_any_model || ((kernel >> k & 1U) != 0 && clast_kernel_table()[k].is_model);
    }
    return !is_any_model;
}

clast_status clx_collide_config_check(const clast_collide_config *config)
{
    clast_status status = CLAST_OK;
    const clast_field *fields = clast_agglomerate_fields;
    clast_collide_config used = *config;
    if (config->collisions == CLAST_COLLISIONS_NEXT) {
        used.leap = clast_fields_find(fields, "leap")->value;
    }
    if (config->radius_law == CLAST_RADIUS_VOLUME) {
        used.fractal_dimension = clast_fields_find(fields, "fractal_dimension")->value;
        used.fractal_prefactor = clast_fields_find(fields, "fractal_prefactor")->value;
    }
    CLX_CHECK(config->kernel != 0 && config->kernel >> CLAST_N_KERNEL == 0, CLAST_E_CONFIG,
              "kernel: the mask %#x holds %s; begin with clast_kernel_parse",
              (unsigned)config->kernel, config->kernel == 0 ? "none" : "bits beyond the table");
    CLX_TRY(clx_fields_check_part(fields, offsetof(clast_agglomerate_config, collide),
                                  offsetof(clast_agglomerate_config, collide) + sizeof used,
                                  &used));
    CLX_CHECK(config->radius_law == CLAST_RADIUS_VOLUME || config->monomer_radius > 0.0,
              CLAST_E_CONFIG, "monomer_radius: fractal radii need one > 0");
    CLX_CHECK(config->count_unit >= 0.0 && isfinite(config->count_unit), CLAST_E_CONFIG,
              "count_unit: %g is no number of monomers", config->count_unit);
    CLX_TRY(clast_sticking_check(&config->sticking));
    CLX_CHECK(config->sticking.law == CLAST_STICKING_CONSTANT || has_speed(config->kernel),
              CLAST_E_CONFIG,
              "sticking by impact needs a kernel of a mechanism: constant, additive and product "
              "have no speeds");
done:
    return status;
}

static clast_status check_medium(const clast_medium *medium, uint32_t kernel)
{
    const size_t begin = offsetof(clast_agglomerate_config, collide.medium);
    const clast_status status =
        clx_fields_check_part(clast_agglomerate_fields, begin, begin + sizeof *medium, medium);
    return status == CLAST_OK ? clast_kernel_check(kernel, medium) : status;
}

static clast_status check_motion(const clast_population *p, int64_t i)
{
    clast_status status = CLAST_OK;
    for (int64_t k = i * p->dimension; k < (i + 1) * p->dimension; ++k) {
        CLX_CHECK(isfinite(p->x[k]) && (p->velocity == NULL || isfinite(p->velocity[k])),
                  CLAST_E_ARGUMENT, "particle %lld has the coordinate %g and the velocity %g",
                  (long long)i + 1, p->x[k], p->velocity != NULL ? p->velocity[k] : 0.0);
    }
    CLX_CHECK(p->speed_rms == NULL || (isfinite(p->speed_rms[i]) && p->speed_rms[i] >= 0.0),
              CLAST_E_ARGUMENT, "particle %lld has the speed_rms %g", (long long)i + 1,
              p->speed_rms[i]);
done:
    return status;
}

static clast_status check_population(const clast_population *p, const clast_collide_cells *cells)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(p->n >= 0 && p->dimension >= 1 && p->dimension <= 3, CLAST_E_ARGUMENT,
              "%lld particles in %d dimensions", (long long)p->n, p->dimension);
    CLX_CHECK(p->n == 0 || (p->x != NULL && p->monomers != NULL && p->radius != NULL &&
                            p->mass != NULL && p->owner != NULL),
              CLAST_E_ARGUMENT, "x, monomers, radius, mass or owner of %lld particles is NULL",
              (long long)p->n);
    CLX_CHECK(cells->n >= 0 && (cells->n == 0 || cells->volume != NULL) &&
                  (p->n == 0 || cells->of_particle != NULL),
              CLAST_E_ARGUMENT, "%d cells, and volume or of_particle is NULL", cells->n);
    for (int64_t i = 0; i < p->n; ++i) {
        CLX_CHECK(cells->of_particle[i] < cells->n, CLAST_E_ARGUMENT,
                  "particle %lld lies in cell %d, and there are cells 0 to %d", (long long)i + 1,
                  cells->of_particle[i], cells->n - 1);
        CLX_CHECK(p->monomers[i] < INT64_MAX, CLAST_E_LIMIT,
                  "particle %lld has %lld monomers; less can be counted", (long long)i + 1,
                  (long long)p->monomers[i]);
        CLX_CHECK(p->monomers[i] >= 0 && isfinite(p->radius[i]) && p->radius[i] >= 0.0 &&
                      isfinite(p->mass[i]) && p->mass[i] >= 0.0,
                  CLAST_E_ARGUMENT,
                  "particle %lld has %lld monomers, the radius %g and the mass %g",
                  (long long)i + 1, (long long)p->monomers[i], p->radius[i], p->mass[i]);
        CLX_TRY(p->monomers[i] > 0 ? check_motion(p, i) : CLAST_OK);
    }
done:
    return status;
}

static clast_status check_cells(const clast_collide_cells *cells,
                                const clast_collide_config *config)
{
    clast_status status = CLAST_OK;
    if (cells->medium == NULL) {
        CLX_TRY(clast_kernel_check(config->kernel, &config->medium));
    }
    for (int32_t c = 0; c < cells->n; ++c) {
        CLX_CHECK(cells->volume[c] > 0.0 && isfinite(cells->volume[c]), CLAST_E_ARGUMENT,
                  "cell %d has the volume %g", c, cells->volume[c]);
        if (cells->medium != NULL) {
            CLX_TRY(check_medium(&cells->medium[c], config->kernel));
        }
    }
done:
    return status;
}

static clast_status check_weights(const clast_population *p)
{
    clast_status status = CLAST_OK;
    for (int64_t i = 0; i < p->n && p->weight != NULL; ++i) {
        CLX_CHECK(p->weight[i] > 0.0 && isfinite(p->weight[i]), CLAST_E_FORMAT,
                  "the weight of particle %lld is %g; it must be a number > 0", (long long)i + 1,
                  p->weight[i]);
    }
done:
    return status;
}

static clast_status check_step(const clast_population *population, const clast_collide_cells *cells,
                               double dt, uint64_t step, const clast_collide_config *config)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(step < UINT64_C(1) << 32, CLAST_E_ARGUMENT, "step %llu is beyond 2^32",
              (unsigned long long)step);
    CLX_CHECK(dt >= 0.0 && isfinite(dt), CLAST_E_ARGUMENT, "the time step is %g", dt);
    CLX_TRY(clx_collide_config_check(config));
    CLX_TRY(check_population(population, cells));
    CLX_TRY(check_cells(cells, config));
    CLX_TRY(check_weights(population));
    CLX_CHECK((clast_kernel_needs(config->kernel) & CLAST_NEEDS_VELOCITY) == 0 ||
                  population->velocity != NULL,
              CLAST_E_CONFIG, "kernel ballistic needs the particles' velocities");
done:
    return status;
}

/// Whether all particles of any cell are few enough monomers to be one; parcels, which take up
/// others' without end, are looked at after the step.
static clast_status check_monomers(const step_context *s)
{
    clast_status status = CLAST_OK;
    const clast_population *p = s->population;
    for (int32_t c = 0; c < s->cells->n && p->weight == NULL; ++c) {
        int64_t left = INT64_MAX - 1;
        for (int64_t k = s->start[c]; k < s->start[c + 1]; ++k) {
            const int64_t n = p->monomers[s->scratch.order[k]];
            CLX_CHECK(n <= left, CLAST_E_LIMIT,
                      "the particles of cell %d have 2^63 monomers or more, too many for one "
                      "aggregate; count in a larger unit (count_unit)",
                      c);
            left -= n;
        }
    }
done:
    return status;
}

/// Whether the heaviest parcel of a cell, where it cannot be used up in the step, meets the others
/// so often that the step would not end.
static clast_status check_heaviest(const step_context *s, int32_t c)
{
    clast_status status = CLAST_OK;
    const clast_population *p = s->population;
    const int64_t *member = s->scratch.order + s->start[c];
    const double most = EVENTS_A_PARCEL * (double)(s->start[c + 1] - s->start[c]);
    const clx_block block = block_of(s, c);
    int64_t heaviest = 0;
    double least = (double)INFINITY;
    double events = 0.0;
    for (int64_t k = 0; k < block.n; ++k) {
        heaviest = p->weight[member[k]] > p->weight[member[heaviest]] ? k : heaviest;
        least = fmin(least, p->weight[member[k]]);
    }
    if (block.n < 2 || p->weight[member[heaviest]] <= most * least) {
        return CLAST_OK;
    }
    const clx_kind own = clx_block_as_seen(&block, member[heaviest]);
    for (int64_t k = 0; k < block.n; ++k) {
        const clx_kind other = clx_block_as_seen(&block, member[k]);
        events +=
            k != heaviest ? s->dt * block.scale * clx_block_kernel(&block, &own, &other) : 0.0;
    }
    CLX_CHECK(events <= most, CLAST_E_LIMIT,
              "particle %lld of the weight %g meets the others of cell %d %.3g times in one step, "
              "%.3g is the most; take shorter time steps, or divide it",
              (long long)member[heaviest] + 1, p->weight[member[heaviest]], c, events, most);
done:
    return status;
}

static clast_status check_parcels(const clast_population *p)
{
    clast_status status = CLAST_OK;
    for (int64_t i = 0; i < p->n && p->weight != NULL; ++i) {
        CLX_CHECK(p->monomers[i] < INT64_MAX, CLAST_E_LIMIT,
                  "particle %lld has come to have 2^63 monomers or more; take shorter time steps, "
                  "or count in a larger unit (count_unit)",
                  (long long)i + 1);
    }
done:
    return status;
}

/// Adds what the cells' collisions were against the ranges.
static clast_status tell_ranges(const step_context *s)
{
    clast_range_use step = {0};
    clast_range_use *use = s->cells->range != NULL ? s->cells->range : &step;
    for (int32_t c = 0; c < s->cells->n && s->range != NULL; ++c) {
        clx_range_merge(use, &s->range[c]);
    }
    return s->config->out_of_range == CLAST_OUT_OF_RANGE_EXTRAPOLATE
               ? CLAST_OK
               : clx_range_check(use, "of the collisions");
}

static clast_status run_step(step_context *s, int64_t *total)
{
    clast_status status = CLAST_OK;
    int64_t sum = 0;
    clx_parallel_for(s->cells->n, CELLS_A_BLOCK, evolve_cells, s);
    for (int32_t c = 0; c < s->cells->n; ++c) {
        CLX_CHECK(!s->is_too_many[c], CLAST_E_LIMIT,
                  "cell %d has more than %d kinds of particles; let it be partitioned into blocks "
                  "(block > 0)",
                  c, KIND_LIMIT);
        sum += s->n_event[c];
    }
    CLX_TRY(check_parcels(s->population));
    for (int32_t c = 0; c < s->cells->n && s->cells->events != NULL; ++c) {
        s->cells->events[c] = s->n_real[c];
    }
    if (total != NULL) {
        *total = sum;
    }
    CLX_TRY(tell_ranges(s));
done:
    return status;
}

clast_status clast_collide(clast_population *population, const clast_collide_cells *cells,
                           double dt, uint64_t step, const clast_collide_config *config,
                           int64_t *n_event)
{
    CLX_ARGUMENTS(population, cells, config);
    CLX_FLOAT_ENVIRONMENT;
    clast_status status = CLAST_OK;
    step_context s = {
        .population = population, .cells = cells, .config = config, .dt = dt, .step = step};
    CLX_TRY(check_step(population, cells, dt, step, config));
    const int64_t n = population->n;
    s.needs = clx_collide_needs(config);
    s.ranges = clx_ranges_of(config);
    if (s.ranges != 0) {
        CLX_TRY(clx_alloc(&s.range, cells->n, sizeof *s.range));
    }
    CLX_TRY(clx_alloc(&s.scratch.order, n, sizeof *s.scratch.order));
    CLX_TRY(clx_alloc(&s.scratch.next, n, sizeof *s.scratch.next));
    CLX_TRY(clx_alloc(&s.scratch.frozen, n, sizeof *s.scratch.frozen));
    CLX_TRY(clx_alloc(&s.scratch.kind, n, sizeof *s.scratch.kind));
    CLX_TRY(clx_alloc(&s.scratch.n_kind, n, sizeof *s.scratch.n_kind));
    CLX_TRY(clx_alloc(&s.start, (int64_t)cells->n + 1, sizeof *s.start));
    CLX_TRY(clx_alloc(&s.n_event, cells->n, sizeof *s.n_event));
    CLX_TRY(clx_alloc(&s.n_real, cells->n, sizeof *s.n_real));
    CLX_TRY(clx_alloc(&s.is_too_many, cells->n, sizeof *s.is_too_many));
    sort_by_cell(&s);
    CLX_TRY(check_monomers(&s));
    for (int32_t c = 0; c < cells->n && population->weight != NULL; ++c) {
        CLX_TRY(check_heaviest(&s, c));
    }
    CLX_TRY(run_step(&s, n_event));
done:
    CLX_FREE(s.scratch.order, s.scratch.next, s.scratch.frozen, s.scratch.kind, s.scratch.n_kind,
             s.start, s.n_event, s.n_real, s.range, s.is_too_many);
    return status;
}
