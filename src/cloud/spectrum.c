// The size spectrum of a box in time: configuration, both solvers, tables. [docs/theory/
// agglomeration.md section 6]
#include "cloud/spectrum.h"

#include "base/alloc.h"
#include "cloud/box.h"
#include "cloud/kernel_range.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

#define FIELD(type, name) #name, .offset = offsetof(clast_spectrum_config, name), type
const clast_field clast_spectrum_fields[] = {
    {FIELD(CLAST_FIELD_CHOICE, solver), 0, 0, 0, "-",
     "of a box: draws, or a sectional population balance (needs SUNDIALS)", "monte-carlo|sectional",
     .group = "box without positions"},
    {FIELD(CLAST_FIELD_CHOICE, initial), 0, 0, 0, "-", "sizes at the start of a box",
     "mono|exponential|lognormal|table"},
    {FIELD(CLAST_FIELD_F64, concentration), 0.0, 0.0, 1e300, "1/m^3",
     "particles a volume at the start of a box; of a table, whose numbers are then shares, or 0: "
     "their sum"},
    {FIELD(CLAST_FIELD_F64, initial_mean), 1.0, 1e-100, 1e100, "-",
     "mean size at the start [monomers]"},
    {FIELD(CLAST_FIELD_F64, initial_sd), 1.5, 1.001, 100.0, "-",
     "geometric standard deviation of a lognormal start"},
    {FIELD(CLAST_FIELD_I32, particles), 10000, 2, 10000000, "-", "particles of a Monte Carlo box"},
    {FIELD(CLAST_FIELD_F64, size_min), 0.0, 0.0, 1e100, "-",
     "smallest size, which does not break [monomers]; 0: that of the start (which must then have "
     "others, or be single monomers, where particles break)"},
    {FIELD(CLAST_FIELD_F64, size_max), 0.0, 0.0, 1e100, "-",
     "largest size of the grid [monomers]; 0: 1e5 mean sizes of the start"},
    {FIELD(CLAST_FIELD_I32, per_octave), 16, 1, 1000, "-",
     "sections of the grid that double the size"},
    {FIELD(CLAST_FIELD_F64, breakage_rate), 0.0, 0.0, 1e300, "1/s",
     "S1: a particle of x monomers breaks at S1 x^p"},
    {FIELD(CLAST_FIELD_F64, breakage_exponent), 1.0, -10.0, 10.0, "-", "p"},
    {FIELD(CLAST_FIELD_CHOICE, fragments), 0, 0, 0, "-",
     "sizes v of the fragments of x: (c + 2)/x (v/x)^c, or two halves", "power|halves"},
    {FIELD(CLAST_FIELD_F64, fragment_exponent), 0.0, -0.99, 100.0, "-",
     "c; 0: two fragments, uniform; monte-carlo: m fragments, 1/(m-1) - 1"},
    {FIELD(CLAST_FIELD_F64, source), 0.0, 0.0, 1e300, "1/(m^3 s)",
     "particles that come in, a volume and time"},
    {FIELD(CLAST_FIELD_F64, source_size), 1.0, 1e-100, 1e100, "-", "their size [monomers]"},
    {FIELD(CLAST_FIELD_F64, settling_depth), 0.0, 0.0, 1e300, "m",
     "particles leave at settling speed / this depth; 0: they stay"},
    {FIELD(CLAST_FIELD_F64, tolerance), 1e-7, 1e-12, 1e-2, "-",
     "relative error of a step of the sectional solver"},
    {0}};
#undef FIELD

void clast_spectrum_free(clast_spectrum *result)
{
    if (result == NULL) {
        return;
    }
    clast_table_free(&result->history);
    clast_table_free(&result->spectrum);
    *result = (clast_spectrum){0};
}

static clast_status check_kernel(const clast_spectrum_config *config, const clast_collide_config *c)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clast_kernel_check(c->kernel, &c->medium));
    CLX_TRY(clx_medium_check_dimension(&c->medium, 3));
    const uint32_t needs =
        clx_collide_needs(c) |
        (config->settling_depth > 0.0 ? CLAST_NEEDS_MASS | CLAST_NEEDS_RADIUS : 0);
    CLX_CHECK((needs & CLAST_NEEDS_VELOCITY) == 0, CLAST_E_CONFIG,
              "kernel: ballistic is a kernel of velocities, which a box does not have");
    CLX_CHECK((needs & (CLAST_NEEDS_RADIUS | CLAST_NEEDS_MASS)) == 0 || c->monomer_radius > 0.0,
              CLAST_E_CONFIG, "a box with this kernel or sink needs --monomer-radius");
    CLX_CHECK(c->radius_law == CLAST_RADIUS_VOLUME || c->monomer_radius > 0.0, CLAST_E_CONFIG,
              "fractal radii need --monomer-radius");
    CLX_CHECK((needs & CLAST_NEEDS_MASS) == 0 || c->medium.particle_density > 0.0, CLAST_E_CONFIG,
              "a box with this kernel or sink needs masses: --particle-density");
    CLX_CHECK(!(config->settling_depth > 0.0) || c->medium.particle_density > c->medium.density,
              CLAST_E_CONFIG,
              "settling_depth: particles of %g kg/m^3 do not settle in a fluid of %g kg/m^3; leave "
              "it out",
              c->medium.particle_density, c->medium.density);
    CLX_CHECK((needs & CLAST_NEEDS_SPEED_RMS) == 0 || c->medium.speed_rms > 0.0, CLAST_E_CONFIG,
              "a box with this kernel needs --speed-rms");
done:
    return status;
}

static clast_status check(const clast_spectrum_config *config, const clast_collide_config *collide)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clast_fields_check(clast_spectrum_fields, config));
    CLX_CHECK(config->duration > 0.0 && isfinite(config->duration) && config->n_step > 0 &&
                  config->repeats > 0,
              CLAST_E_CONFIG, "duration: a box needs a time > 0, not %s in %d steps, %d runs",
              clx_unit_text(config->duration, "s"), config->n_step, config->repeats);
    CLX_TRY(clx_collide_config_check(collide));
    CLX_TRY(check_kernel(config, collide));
    CLX_CHECK(
        config->solver == CLAST_SOLVER_SECTIONAL || config->breakage_rate == 0.0 ||
            clx_fragments_count(config) > 0,
        CLAST_E_CONFIG,
        "fragment_exponent: monte-carlo breaks particles into 2, 3, 4 .. %d fragments, exponent 0, "
        "-0.5, -0.667 .. %.3f (1/(m-1) - 1); %g has no whole number: take sectional",
        CLX_MOST_FRAGMENTS, 1.0 / (CLX_MOST_FRAGMENTS - 1) - 1.0, config->fragment_exponent);
    CLX_CHECK(config->solver == CLAST_SOLVER_MONTE_CARLO || config->repeats == 1, CLAST_E_CONFIG,
              "repeats: the sectional solver draws nothing, so it runs once, not %d times",
              config->repeats);
done:
    return status;
}

static clast_status make_grid(const clx_start *start, clx_sectional *grid)
{
    clast_status status = CLAST_OK;
    const clast_spectrum_config *c = start->config;
    const double low = start->low;
    const double mean = c->initial == CLAST_INITIAL_TABLE ? start->high : c->initial_mean;
    const double high = c->size_max > 0.0 ? c->size_max : fmax(1e5 * mean, 100.0 * start->high);
    CLX_CHECK(
        c->source == 0.0 || (c->source_size >= low && c->source_size <= high), CLAST_E_CONFIG,
        "source_size: %g monomers lies outside the grid from %g to %g (--size-min, --size-max)",
        c->source_size, low, high);
    CLX_TRY(clx_sectional_grid(low, high, start->unit, c->per_octave, grid));
done:
    return status;
}

static clast_status make_sums(int32_t n_row, int32_t n, clx_spectrum_sums *s)
{
    clast_status status = CLAST_OK;
    s->n_row = n_row;
    CLX_CHECK((double)n_row * n < 1e8, CLAST_E_LIMIT,
              "%d times of %d sections are too many; take fewer steps", n_row, n);
    CLX_TRY(clx_alloc(&s->number, (int64_t)n_row * n, sizeof *s->number));
    CLX_TRY(clx_alloc(&s->number2, (int64_t)n_row * n, sizeof *s->number2));
    CLX_TRY(clx_alloc(&s->moment, 4 * (int64_t)n_row, sizeof *s->moment));
    CLX_TRY(clx_alloc(&s->moment2, 4 * (int64_t)n_row, sizeof *s->moment2));
    CLX_TRY(clx_alloc(&s->told, CLX_N_TOLD * (int64_t)n_row, sizeof *s->told));
    CLX_TRY(clx_alloc(&s->told2, CLX_N_TOLD * (int64_t)n_row, sizeof *s->told2));
done:
    return status;
}

static void free_sums(clx_spectrum_sums *s)
{
    CLX_FREE(s->number, s->number2, s->moment, s->moment2, s->told, s->told2);
}

/// One row of the sectional solver into sums; the error of its mass.
static double sum_row(const clx_sectional *g, const double *y, int32_t row, clx_spectrum_sums *sums)
{
    const double added = 1.0 + y[g->n + CLX_ADDED];
    double mass = y[g->n + CLX_GEL] + y[g->n + CLX_SETTLED];
    for (int32_t i = 0; i < g->n; ++i) {
        const double number = y[i] * g->monomers / g->x[i];
        double power = number;
        sums->number[(int64_t)row * g->n + i] = number;
        mass += y[i];
        for (int k = 0; k < 4; ++k) {
            sums->moment[4 * row + k] += power;
            power *= g->x[i];
        }
    }
    memcpy(sums->told + (int64_t)CLX_N_TOLD * row, y + g->n, CLX_N_BESIDE * sizeof *y);
    return (mass - added) / added;
}

/// The run against the ranges: particles and collisions at the start, collisions by the trapezoid
/// rule up to each time.
static clast_status look_at_start(const clast_collide_config *collide, const clx_sectional *g,
                                  const double *rows, clast_range_report *range)
{
    clast_status status = CLAST_OK;
    clast_range_report first = clx_range_begin();
    const uint32_t of_one = clx_ranges_of_one(g->ranges);
    for (int32_t i = 0; i < g->n && of_one != 0; ++i) {
        const clast_collider pair[2] = {g->as[i], g->as[i]};
        const double number = rows[i] / g->x[i];
        if (number > 0.0) {
            clx_range_add(of_one, collide, &collide->medium, pair, number, &range->start);
        }
    }
    CLX_TRY(clx_range_start(collide, range));
    if (g->ranges != 0) {
        clx_sectional_ranges(g, collide, rows, 1.0, &first.collisions);
        CLX_TRY(clx_range_up_to(collide, 0.0, &first));
        range->time = fmin(range->time, first.time);
    }
done:
    return status;
}

static clast_status look_at_rows(const clx_start *start, const clast_collide_config *collide,
                                 const clx_sectional *g, const double *rows,
                                 clast_range_report *range)
{
    clast_status status = CLAST_OK;
    const double step = start->config->duration / start->config->n_step;
    const int64_t width = g->n + CLX_N_BESIDE;
    for (int32_t row = 1; row <= start->config->n_step && g->ranges != 0; ++row) {
        for (int32_t end = row - 1; end <= row; ++end) {
            clx_sectional_ranges(g, collide, rows + end * width, 0.5 * step, &range->collisions);
        }
        CLX_TRY(clx_range_up_to(collide, step * row, range));
    }
done:
    return status;
}

static clast_status solve(const clx_start *start, const clast_collide_config *collide,
                          clx_sectional *g, clx_spectrum_sums *sums, clast_spectrum *made)
{
    clast_status status = CLAST_OK;
    const clast_spectrum_config *config = start->config;
    const int32_t width = g->n + CLX_N_BESIDE;
    double *rows = NULL;
    CLX_TRY(clx_alloc(&rows, (int64_t)width * sums->n_row, sizeof *rows));
    clx_start_add(start, g, rows);
    for (int32_t i = 0; i < g->n; ++i) {
        g->monomers += rows[i] * g->x[i];
    }
    for (int32_t i = 0; i < g->n; ++i) {
        rows[i] *= g->x[i] / g->monomers;
    }
    CLX_TRY(clx_sectional_rates(config, collide, g));
    CLX_TRY(look_at_start(collide, g, rows, &made->range));
    CLX_TRY(clx_sectional_solve(g, config, start->monitor, rows, &made->gel_time));
    CLX_TRY(look_at_rows(start, collide, g, rows, &made->range));
    for (int32_t row = 0; row < sums->n_row; ++row) {
        const double time = config->duration / config->n_step * row;
        const double error = sum_row(g, rows + (int64_t)row * width, row, sums);
        made->mass_error = fmax(made->mass_error, fabs(error));
        sums->told[CLX_N_TOLD * row + CLX_GELLED] = time >= made->gel_time ? 1.0 : 0.0;
    }
    sums->n_run = 1;
    made->n_evaluation = g->n_evaluation;
    made->n_gelled = isnan(made->gel_time) ? 0 : 1;
    made->gel_size = g->x[g->n - 1];
done:
    clx_free(rows);
    return status;
}

static double deviation(double sum, double sum2, int32_t n)
{
    const double mean = sum / n;
    return n > 1 ? sqrt(fmax(0.0, sum2 / n - mean * mean) * n / (n - 1.0)) : 0.0;
}

/// Sums over runs of one quantity: those of row r lie at [r stride].
typedef struct {
    const double *sum, *sum2; ///< sum2 NULL: never has a deviation
    int32_t stride, n_run;
} series;

/// Adds the runs' mean, and as NAME_sd their standard deviation where there are several.
static clast_status add_columns(clast_table *table, const char *name, const char *unit, series s)
{
    clast_status status = CLAST_OK;
    char name_sd[64];
    double *column = NULL;
    CLX_TRY(clast_table_add_number(table, name, unit, &column));
    for (int64_t row = 0; row < table->n_row; ++row) {
        column[row] = s.sum[row * s.stride] / s.n_run;
    }
    if (s.n_run < 2 || s.sum2 == NULL) {
        return CLAST_OK;
    }
    (void)snprintf(name_sd, sizeof name_sd, "%s_sd", name);
    CLX_TRY(clast_table_add_number(table, name_sd, unit, &column));
    for (int64_t row = 0; row < table->n_row; ++row) {
        column[row] = deviation(s.sum[row * s.stride], s.sum2[row * s.stride], s.n_run);
    }
done:
    return status;
}

/// n_1 .. n_8 where the first pivots are single particles, pairs, ...
static clast_status add_clusters(const clx_sectional *g, const clx_spectrum_sums *sums,
                                 clast_table *history)
{
    enum { N_CLUSTER = 8 };
    clast_status status = CLAST_OK;
    for (int32_t k = 0; k < N_CLUSTER && k < g->n; ++k) {
        char name[24];
        if (fabs(g->x[k] - (k + 1) * g->x[0]) > 1e-9 * g->x[k]) {
            break;
        }
        (void)snprintf(name, sizeof name, "n_%d", k + 1);
        CLX_TRY(add_columns(history, name, "1/m^3",
                            (series){sums->number + k, sums->number2 + k, g->n, sums->n_run}));
    }
done:
    return status;
}

/// M0 and M2 of the constant, additive and product kernel from those of the start, after a time t;
/// NaN after the gel. [Smoluchowski1916; Golovin1963; McLeod1962]
static void exact_at(uint32_t kernel, double rate, const double m[3], double t, double exact[2])
{
    if (kernel == 1U) {
        exact[0] = m[0] / (1.0 + 0.5 * rate * m[0] * t);
        exact[1] = m[2] + rate * m[1] * m[1] * t;
    } else if (kernel == 2U) {
        exact[0] = m[0] * exp(-rate * m[1] * t);
        exact[1] = m[2] * exp(2.0 * rate * m[1] * t);
    } else {
        const bool is_sol = rate * m[2] * t < 1.0;
        exact[0] = is_sol ? m[0] - 0.5 * rate * m[1] * m[1] * t : (double)NAN;
        exact[1] = is_sol ? m[2] / (1.0 - rate * m[2] * t) : (double)NAN;
    }
}

/// M0 to M2 of the start: of the law itself where the solver discretises it, else of what the box
/// holds.
static void exact_start(const clx_start *start, const clast_table *h, double m[3])
{
    static const char *const name[3] = {"M0", "M1", "M2"};
    for (int k = 0; k < 3; ++k) {
        m[k] = start->config->solver == CLAST_SOLVER_SECTIONAL ? clx_start_moment(start, k)
                                                               : clast_table_numbers(h, name[k])[0];
    }
}

static clast_status add_exact(const clx_start *of, const clast_collide_config *collide,
                              clast_spectrum *made)
{
    clast_status status = CLAST_OK;
    const clast_spectrum_config *config = of->config;
    clast_table *h = &made->history;
    const uint32_t kernel = collide->kernel;
    const clast_medium *m = &collide->medium;
    const double rate = collide->alpha * (kernel == 1U   ? m->constant
                                          : kernel == 2U ? m->additive
                                                         : m->product);
    double *column = NULL;
    if ((kernel != 1U && kernel != 2U && kernel != 4U) || config->breakage_rate > 0.0 ||
        config->source > 0.0 || config->settling_depth > 0.0) {
        return CLAST_OK;
    }
    CLX_TRY(clast_table_add_number(h, "exact_M0", "1/m^3", &column));
    CLX_TRY(clast_table_add_number(h, "exact_M2", "1/m^3", &column));
    double start[3];
    exact_start(of, h, start);
    for (int64_t row = 0; row < h->n_row; ++row) {
        double exact[2];
        exact_at(kernel, rate, start, clast_table_numbers(h, "time_s")[row], exact);
        clast_table_numbers(h, "exact_M0")[row] = exact[0];
        clast_table_numbers(h, "exact_M2")[row] = exact[1];
    }
    if (kernel == 4U) {
        made->exact_gel_time = 1.0 / (rate * start[2]);
    }
done:
    return status;
}

static clast_status make_history(const clx_start *start, const clx_sectional *g,
                                 const clx_spectrum_sums *sums, clast_table *history)
{
    static const char *const name[4] = {"M0", "M1", "M2", "M3"};
    static const char *const told[CLX_N_TOLD] = {"gel_fraction", "settled_fraction",
                                                 "added_fraction", "gelled"};
    clast_status status = CLAST_OK;
    const clast_spectrum_config *config = start->config;
    double *time = NULL;
    CLX_TRY(clast_table_init(history, "history", sums->n_row));
    CLX_TRY(clast_table_add_number(history, "time_s", "s", &time));
    for (int32_t row = 0; row < sums->n_row; ++row) {
        time[row] = config->duration / config->n_step * row;
    }
    for (int k = 0; k < 4; ++k) {
        CLX_TRY(add_columns(history, name[k], "1/m^3",
                            (series){sums->moment + k, sums->moment2 + k, 4, sums->n_run}));
    }
    for (int k = 0; k < CLX_N_TOLD; ++k) {
        CLX_TRY(add_columns(history, told[k], "-",
                            (series){sums->told + k, k != CLX_GELLED ? sums->told2 + k : NULL,
                                     CLX_N_TOLD, sums->n_run}));
    }
    if (start->unit > 0.0) {
        CLX_TRY(add_clusters(g, sums, history));
    }
done:
    return status;
}

/// Width of section i, half of the way to both neighbours.
static double width_of(const clx_sectional *g, int32_t i)
{
    CLAST_ASSERT(i >= 0 && i < g->n && g->n >= 2);
    const double above = i + 1 < g->n ? g->x[i + 1] - g->x[i] : g->x[i] - g->x[i - 1];
    return 0.5 * (above + (i > 0 ? g->x[i] - g->x[i - 1] : above));
}

static clast_status make_spectrum(const clast_spectrum_config *config, const clx_sectional *g,
                                  const clx_spectrum_sums *sums, clast_table *table)
{
    enum { N_COLUMN = 6 };
    static const char *const name[N_COLUMN] = {"time_s",  "size",          "n",
                                               "density", "mass_fraction", "n_sd"};
    static const char *const unit[N_COLUMN] = {"s", "-", "1/m^3", "1/m^3", "-", "1/m^3"};
    clast_status status = CLAST_OK;
    double *column = NULL;
    const int n_column = sums->n_run > 1 ? N_COLUMN : N_COLUMN - 1;
    CLX_TRY(clast_table_init(table, "spectrum", (int64_t)sums->n_row * g->n));
    for (int k = 0; k < n_column; ++k) {
        CLX_TRY(clast_table_add_number(table, name[k], unit[k], &column));
    }
    for (int64_t at = 0; at < table->n_row; ++at) {
        const int64_t row = at / g->n;
        const int32_t i = (int32_t)(at % g->n);
        const double n = sums->number[at] / sums->n_run;
        const double value[N_COLUMN] = {
            config->duration / config->n_step * (double)row,
            g->x[i],
            n,
            n / width_of(g, i),
            n * g->x[i] * sums->n_run / sums->moment[1],
            deviation(sums->number[at], sums->number2[at], sums->n_run)};
        for (int k = 0; k < n_column; ++k) {
            table->column[k].number[at] = value[k];
        }
    }
done:
    return status;
}

clast_status clast_spectrum_evolve(const clast_spectrum_start *start_table,
                                   const clast_spectrum_config *config,
                                   const clast_collide_config *collide,
                                   const clast_monitor *monitor, clast_spectrum *result)
{
    CLX_ARGUMENTS(config, collide, result);
    CLX_FLOAT_ENVIRONMENT;
    clast_status status = CLAST_OK;
    clx_start start = {0};
    clx_sectional grid = {0};
    clx_spectrum_sums sums = {0};
    clast_spectrum made = {
        .gel_time = (double)NAN, .exact_gel_time = (double)NAN, .range = clx_range_begin()};
    CLX_TRY(check(config, collide));
    CLX_TRY(clx_start_begin(config, start_table, &start));
    start.monitor = monitor;
    made.is_drawn = config->solver == CLAST_SOLVER_MONTE_CARLO;
    made.law_M1 = clx_start_moment(&start, 1);
    made.law_M2 = clx_start_moment(&start, 2);
    made.volume_fraction = collide->monomer_radius > 0.0 ? made.law_M1 * 4.0 / 3.0 * CLAST_PI *
                                                               pow(collide->monomer_radius, 3.0)
                                                         : (double)NAN;
    CLX_TRY(make_grid(&start, &grid));
    CLAST_ASSERT(grid.x != NULL && grid.n > 0);
    CLX_TRY(make_sums(config->n_step + 1, grid.n, &sums));
    if (config->solver == CLAST_SOLVER_SECTIONAL) {
        CLX_TRY(solve(&start, collide, &grid, &sums, &made));
    } else {
        CLX_TRY(clx_spectrum_sample(&start, collide, &grid, &sums, &made));
    }
    made.is_gelation = made.n_gelled > 0 && clx_kernel_gels(collide, grid.x[grid.n - 1]);
    CLX_TRY(make_history(&start, &grid, &sums, &made.history));
    CLX_TRY(add_exact(&start, collide, &made));
    CLX_TRY(make_spectrum(config, &grid, &sums, &made.spectrum));
    *result = made;
    made = (clast_spectrum){0};
done:
    clast_spectrum_free(&made);
    free_sums(&sums);
    clx_sectional_free(&grid);
    return status;
}
