// Monte Carlo of a box: runs counted on the grid's pivots.
#include "cloud/spectrum.h"

#include "base/alloc.h"
#include "base/monitor.h"
#include "cloud/box.h"
#include "cloud/kernel_range.h"
#include "math/rng.h"
#include <math.h>

static const double MOST_UNITS = 9007199254740992.0; ///< 2^53: sums are exact as double too
static const double PLACES = 1e3; ///< units of a mean size where sizes are no whole numbers

typedef struct {
    const clx_start *start;
    const clx_sectional *grid;
    clx_box box;
    double *at; ///< [n_section] of one run
    double gel_sum;
} sampling;

/// What a whole number of the population stands for [monomers].
static double unit_of(const clx_start *start)
{
    const clast_spectrum_config *c = start->config;
    const double size =
        c->initial == CLAST_INITIAL_TABLE ? start->low : c->initial_mean; // of a table the smallest
    double unit = size / PLACES;
    if (start->unit > 0.0) {
        return start->unit;
    }
    if (c->size_min > 0.0) {
        unit = fmin(unit, c->size_min);
    }
    return c->source > 0.0 ? fmin(unit, c->source_size) : unit;
}

static clast_status begin(const clast_collide_config *collide, sampling *s)
{
    clast_status status = CLAST_OK;
    const int64_t n = s->start->config->particles;
    clx_box *box = &s->box;
    box->config = s->start->config;
    box->unit = unit_of(s->start);
    box->volume = (double)n / s->start->concentration;
    CLX_CHECK(
        box->config->source * box->volume * box->config->duration <
            MOST_UNITS / fmax(1.0, box->config->source_size / box->unit),
        CLAST_E_CONFIG,
        "source, source_size: what comes in by %s is more than 2^53 units of %g monomers; take "
        "fewer --particles, a shorter --duration or a larger --source-size or --size-min",
        clx_unit_text(box->config->duration, "s"), box->unit);
    box->collide = *collide;
    box->collide.keep_positions = true;
    box->collide.out_of_range = CLAST_OUT_OF_RANGE_EXTRAPOLATE; // the run holds it against them
    box->collide.count_unit = box->unit;
    // the kernels of whole numbers as functions of the size
    box->collide.medium.additive *= box->unit;
    box->collide.medium.product *= box->unit * box->unit;
    CLX_TRY(clx_box_begin(box, n));
    CLX_TRY(clx_alloc(&s->at, s->grid->n, sizeof *s->at));
done:
    return status;
}

/// Sizes of one run: quantiles of the law at equal steps from a random place, so that the start
/// hardly differs from run to run. A particle of N^(2/3) mean sizes is the gel of a sample of N: as
/// large as the largest one is when an infinite system gels [Aldous1999].
static clast_status draw_sizes(sampling *s, int32_t run)
{
    clast_status status = CLAST_OK;
    clx_box *box = &s->box;
    clast_population *p = &box->population;
    double sum = 0.0;
    clx_rng rng = clx_rng_at(box->collide.seed, CLX_STREAM_SPECTRUM, (uint64_t)run);
    const double first = clx_rng_uniform(&rng);
    p->n = box->config->particles;
    for (int64_t i = 0; i < p->n; ++i) {
        const double x = clx_start_quantile(s->start, ((double)i + first) / (double)p->n);
        const double units = fmax(1.0, round(x / box->unit));
        CLX_CHECK(sum + units < MOST_UNITS, CLAST_E_CONFIG,
                  "size_min, source_size: the particles of the start are more than 2^53 units of "
                  "%g monomers; take fewer --particles or a larger --size-min or --source-size",
                  box->unit);
        clx_box_set(box, i, (int64_t)units);
        sum += units;
    }
    box->gel_size = fmin(s->grid->x[s->grid->n - 1] / box->unit,
                         sum / (double)p->n * pow((double)p->n, 2.0 / 3.0));
    clx_box_restart(box);
done:
    return status;
}

static void add_square(double value, double *sum, double *sum2)
{
    *sum += value;
    *sum2 += value * value;
}

/// The balance of one run, in whole numbers: exact. Sums are in 1/m^3 until the end.
static void count_balance(const sampling *s, int64_t live, int32_t row, clx_spectrum_sums *sums,
                          clast_spectrum *made)
{
    const clx_box *b = &s->box;
    const double unit = b->unit / b->volume;
    const double value[CLX_N_TOLD] = {
        [CLX_GEL] = (double)b->above * unit,
        [CLX_SETTLED] = (double)b->settled * unit,
        [CLX_ADDED] = (double)b->added * unit,
        [CLX_GELLED] = b->time >= b->gel_time ? 1.0 : 0.0,
    };
    const int64_t missing = b->start + b->added - b->settled - live;
    made->mass_error =
        fmax(made->mass_error, fabs((double)missing) / (double)(b->start + b->added));
    for (int k = 0; k < CLX_N_TOLD; ++k) {
        add_square(value[k], &sums->told[CLX_N_TOLD * row + k], &sums->told2[CLX_N_TOLD * row + k]);
    }
}

static void count(sampling *s, int32_t row, clx_spectrum_sums *sums, clast_spectrum *made)
{
    const clx_box *box = &s->box;
    const clast_population *p = &box->population;
    const int32_t n = s->grid->n;
    double moment[4] = {0};
    int64_t live = 0;
    for (int32_t i = 0; i < n; ++i) {
        s->at[i] = 0.0;
    }
    for (int64_t i = 0; i < p->n; ++i) {
        if (p->monomers[i] > 0) {
            const double x = (double)p->monomers[i] * box->unit;
            clx_sectional_add(s->grid, x, 1.0 / box->volume, s->at);
            moment[0] += 1.0;
            moment[1] += x;
            moment[2] += x * x;
            moment[3] += x * x * x;
            live += p->monomers[i];
        }
    }
    for (int k = 0; k < 4; ++k) {
        add_square(moment[k] / box->volume, &sums->moment[4 * row + k],
                   &sums->moment2[4 * row + k]);
    }
    for (int32_t i = 0; i < n; ++i) {
        const int64_t at = (int64_t)row * n + i;
        add_square(s->at[i], &sums->number[at], &sums->number2[at]);
    }
    count_balance(s, live, row, sums, made);
}

/// The particles at the start against the ranges.
static clast_status look_at_start(const sampling *s, const clast_collide_config *collide,
                                  clast_range_report *range)
{
    const uint32_t rows = clx_ranges_of_one(s->box.ranges);
    for (int64_t i = 0; i < s->box.population.n && rows != 0; ++i) {
        const clast_collider one = clx_population_collider(&s->box.population, i);
        const clast_collider pair[2] = {one, one};
        clx_range_add(rows, collide, &collide->medium, pair, 1.0, &range->start);
    }
    return clx_range_start(collide, range);
}

static clast_status one_run(sampling *s, const clast_collide_config *collide, int32_t run,
                            clx_spectrum_sums *sums, clast_spectrum *made)
{
    clast_status status = CLAST_OK;
    const clast_spectrum_config *config = s->start->config;
    CLX_TRY(draw_sizes(s, run));
    CLX_TRY(look_at_start(s, collide, &made->range));
    count(s, 0, sums, made);
    for (int32_t row = 1; row < sums->n_row; ++row) {
        const double end = config->duration / config->n_step * row;
        const uint64_t step = (uint64_t)run * (uint64_t)config->n_step + (uint64_t)row;
        const int64_t n_step = (int64_t)config->n_step * config->repeats;
        CLX_CHECK(!clx_monitor_stops(s->start->monitor), CLAST_E_STOPPED,
                  "stopped after %lld of %lld steps; nothing is kept", (long long)step - 1,
                  (long long)n_step);
        CLX_TRY(clx_box_step(&s->box, end, step, &made->range.collisions));
        CLX_TRY(clx_range_up_to(collide, end, &made->range));
        count(s, row, sums, made);
        clx_monitor_report(s->start->monitor, "steps", (int64_t)step, n_step);
    }
    if (isfinite(s->box.gel_time)) {
        s->gel_sum += s->box.gel_time;
        ++made->n_gelled;
    }
    made->gel_size = s->box.gel_size * s->box.unit;
done:
    return status;
}

/// Shares of what the runs held at the start on average: the balance holds for their means too.
static void make_shares(clx_spectrum_sums *sums)
{
    const double start = sums->moment[1] / sums->n_run;
    for (int64_t at = 0; at < (int64_t)sums->n_row * CLX_N_TOLD; ++at) {
        if (at % CLX_N_TOLD != CLX_GELLED) {
            sums->told[at] /= start;
            sums->told2[at] /= start * start;
        }
    }
}

clast_status clx_spectrum_sample(const clx_start *start, const clast_collide_config *collide,
                                 const clx_sectional *grid, clx_spectrum_sums *sums,
                                 clast_spectrum *made)
{
    clast_status status = CLAST_OK;
    sampling s = {.start = start, .grid = grid};
    CLX_TRY(begin(collide, &s));
    for (int32_t run = 0; run < start->config->repeats; ++run) {
        CLX_TRY(one_run(&s, collide, run, sums, made));
    }
    sums->n_run = start->config->repeats;
    make_shares(sums);
    made->n_evaluation = s.box.n_event;
    made->gel_time = made->n_gelled > 0 ? s.gel_sum / made->n_gelled : (double)NAN;
done:
    clx_box_end(&s.box);
    clx_free(s.at);
    return status;
}
