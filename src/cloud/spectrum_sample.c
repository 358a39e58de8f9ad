// Monte Carlo of a box: particles of one cell by clast_collide, counted on the grid's pivots.
#include "cloud/spectrum.h"

#include "base/alloc.h"
#include "cloud/collide.h"
#include "cloud/kernel_range.h"
#include "math/rng.h"
#include <math.h>

static const double PLACES = 1e3; ///< units of a mean size where sizes are no whole numbers

typedef struct {
    const clx_start *start;
    const clx_sectional *grid;
    clast_collide_config collide;
    clast_population population;
    int32_t *cell;
    double *at;    ///< [n_section] of one run
    double unit;   ///< monomers of a whole number of the population
    double volume; ///< [m^3]
} sampling;

static clast_status begin(const clast_collide_config *collide, sampling *s)
{
    clast_status status = CLAST_OK;
    const int64_t n = s->start->config->particles;
    clast_population *p = &s->population;
    s->unit = s->start->unit > 0.0 ? s->start->unit : s->start->config->initial_mean / PLACES;
    s->volume = (double)n / s->start->concentration;
    s->collide = *collide;
    s->collide.keep_positions = true;
    s->collide.out_of_range = CLAST_OUT_OF_RANGE_EXTRAPOLATE; // the run holds it against them
    s->collide.count_unit = s->unit;
    // the kernels of whole numbers as functions of the size
    s->collide.medium.additive *= s->unit;
    s->collide.medium.product *= s->unit * s->unit;
    *p = (clast_population){.n = n, .dimension = 3};
    CLX_TRY(clx_alloc(&p->x, 3 * n, sizeof *p->x));
    CLX_TRY(clx_alloc(&p->monomers, n, sizeof *p->monomers));
    CLX_TRY(clx_alloc(&p->radius, n, sizeof *p->radius));
    CLX_TRY(clx_alloc(&p->mass, n, sizeof *p->mass));
    CLX_TRY(clx_alloc(&p->owner, n, sizeof *p->owner));
    CLX_TRY(clx_alloc(&s->cell, n, sizeof *s->cell));
    CLX_TRY(clx_alloc(&s->at, s->grid->n, sizeof *s->at));
done:
    return status;
}

static void end(sampling *s)
{
    clx_free(s->population.x);
    clx_free(s->population.monomers);
    clx_free(s->population.radius);
    clx_free(s->population.mass);
    clx_free(s->population.owner);
    clx_free(s->cell);
    clx_free(s->at);
}

/// Sizes of one run: quantiles of the law at equal steps from a random place, so that the start
/// hardly differs from run to run.
static void draw_sizes(sampling *s, const clast_collide_config *collide, int32_t run)
{
    clast_population *p = &s->population;
    clx_rng rng = clx_rng_at(collide->seed, CLX_STREAM_SPECTRUM, (uint64_t)run);
    const double first = clx_rng_uniform(&rng);
    for (int64_t i = 0; i < p->n; ++i) {
        const double x = clx_start_quantile(s->start, ((double)i + first) / (double)p->n);
        p->monomers[i] = (int64_t)fmax(1.0, round(x / s->unit));
        const clast_collider seen = clx_collider_of_size(collide, (double)p->monomers[i] * s->unit);
        p->radius[i] = seen.radius;
        p->mass[i] = seen.mass;
        p->owner[i] = i;
    }
}

static void count(sampling *s, int32_t row, clx_spectrum_sums *sums)
{
    const clast_population *p = &s->population;
    const int32_t n = s->grid->n;
    double moment[4] = {0};
    for (int32_t i = 0; i < n; ++i) {
        s->at[i] = 0.0;
    }
    for (int64_t i = 0; i < p->n; ++i) {
        if (p->monomers[i] > 0) {
            const double x = (double)p->monomers[i] * s->unit;
            clx_sectional_add(s->grid, x, 1.0 / s->volume, s->at);
            moment[0] += 1.0;
            moment[1] += x;
            moment[2] += x * x;
            moment[3] += x * x * x;
        }
    }
    for (int k = 0; k < 4; ++k) {
        const double value = moment[k] / s->volume;
        sums->moment[4 * row + k] += value;
        sums->moment2[4 * row + k] += value * value;
    }
    for (int32_t i = 0; i < n; ++i) {
        sums->number[(int64_t)row * n + i] += s->at[i];
        sums->number2[(int64_t)row * n + i] += s->at[i] * s->at[i];
    }
}

/// The particles at the start against the ranges.
static clast_status look_at_start(const sampling *s, const clast_collide_config *collide,
                                  clast_range_report *range)
{
    const uint32_t rows = clx_ranges_of_one(clx_ranges_of(collide));
    for (int64_t i = 0; i < s->population.n && rows != 0; ++i) {
        const clast_collider one = clx_population_collider(&s->population, i);
        const clast_collider pair[2] = {one, one};
        clx_range_add(rows, collide, &collide->medium, pair, 1.0, &range->start);
    }
    return clx_range_start(collide, range);
}

clast_status clx_spectrum_sample(const clx_start *start, const clast_collide_config *collide,
                                 const clx_sectional *grid, clx_spectrum_sums *sums,
                                 clast_spectrum *made)
{
    clast_status status = CLAST_OK;
    sampling s = {.start = start, .grid = grid};
    const clast_spectrum_config *config = start->config;
    CLX_TRY(begin(collide, &s));
    const clast_collide_cells cells = {
        .n = 1, .of_particle = s.cell, .volume = &s.volume, .range = &made->range.collisions};
    for (int32_t run = 0; run < config->repeats; ++run) {
        draw_sizes(&s, collide, run);
        CLX_TRY(look_at_start(&s, collide, &made->range));
        count(&s, 0, sums);
        for (int32_t row = 1; row < sums->n_row; ++row) {
            int64_t n = 0;
            const uint64_t step = (uint64_t)run * (uint64_t)config->n_step + (uint64_t)row;
            CLX_TRY(clast_collide(&s.population, &cells, config->duration / config->n_step, step,
                                  &s.collide, &n));
            made->n_evaluation += n;
            CLX_TRY(
                clx_range_up_to(collide, config->duration / config->n_step * row, &made->range));
            count(&s, row, sums);
        }
    }
    sums->n_run = config->repeats;
done:
    end(&s);
    return status;
}
