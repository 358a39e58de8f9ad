// Rows of an evolution: the balance of numbers and masses, and classes of aggregates.
#include "evolve/state.h"

#include <math.h>

static const char *const balance_column[][2] = {{"time_s", "s"},
                                                {"n_particle", "-"},
                                                {"n_event", "-"},
                                                {"n_deposit", "-"},
                                                {"n_out", "-"},
                                                {"number_balance", "-"},
                                                {"mass_kg", "kg"},
                                                {"deposit_kg", "kg"},
                                                {"out_kg", "kg"},
                                                {"mass_balance", "-"},
                                                {"grains_mean", "-"},
                                                {"grains_by_mass", "-"},
                                                {"grains_most", "-"},
                                                {"envelope_by_mass_m", "m"},
                                                {"porosity_by_mass", "-"},
                                                {"speed_by_mass_m/s", "m/s"},
                                                {"speed_most_m/s", "m/s"},
                                                {"fractal_dimension", "-"},
                                                {"fractal_error", "-"},
                                                {"n_step", "-"},
                                                {"n_cell", "-"}};

static const char *const spectrum_column[][2] = {
    {"time_s", "s"},     {"grains_low", "-"}, {"grains_high", "-"}, {"n_particle", "-"},
    {"n_deposit", "-"},  {"mass_kg", "kg"},   {"deposit_kg", "kg"}, {"radius_of_gyration_m", "m"},
    {"envelope_m", "m"}, {"porosity", "-"},   {"speed_m/s", "m/s"}};

/// Sums of one state of bodies, for one real particle each.
typedef struct {
    int64_t n, grains, most;
    clx_sum total;
    double mass, by_mass_grains, by_mass_envelope, by_mass_porosity, by_mass_speed, speed;
} sums;

static double envelope_size(const clx_evolve_body *b)
{
    return cbrt(6.0 * b->envelope / CLAST_PI);
}

static sums sum_of(const clast_evolve *e, int32_t state)
{
    sums s = {0};
    for (int32_t i = 0; i < e->n_start; ++i) {
        const clx_evolve_body *b = &e->body[i];
        if (b->state != state) {
            continue;
        }
        ++s.n;
        s.grains += b->n;
        s.most = b->n > s.most ? b->n : s.most;
        clx_sum_add(&s.total, b->mass);
        s.by_mass_grains += b->mass * b->n;
        s.by_mass_envelope += b->mass * envelope_size(b);
        s.by_mass_porosity += b->mass * (1.0 - b->volume / b->envelope);
        s.by_mass_speed += b->mass * b->speed;
        s.speed = fmax(s.speed, b->speed);
    }
    s.mass = clx_sum_of(&s.total);
    return s;
}

/// A mean by mass, NAN of nothing.
static double mean(double sum, double by)
{
    return by > 0.0 ? sum / by : (double)NAN;
}

void clx_evolve_fractal(const clast_evolve *e, double *dimension, double *error)
{
    enum { LEAST_GRAINS = 10, LEAST_EVENTS = 30 };
    const double mean_mass = e->mass_start / e->config->weight / e->n_start;
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
    for (int64_t k = 0; k < e->n_event; ++k) {
        const clx_evolve_event *event = &e->event[k];
        if (event->n < LEAST_GRAINS) {
            continue;
        }
        const double count = log(event->mass / mean_mass);
        const double radius = log(event->gyration);
        n += 1.0;
        x += count;
        y += radius;
        xx += count * count;
        xy += count * radius;
        yy += radius * radius;
    }
    const double sxx = xx - x * x / n;
    const double sxy = xy - x * y / n;
    const double syy = yy - y * y / n;
    *dimension = *error = (double)NAN;
    if (e->config->structure && n >= LEAST_EVENTS && sxx > 0.0 && sxy > 0.0) {
        const double slope_error = sqrt(fmax(0.0, syy - sxy * sxy / sxx) / (n - 2.0) / sxx);
        *dimension = sxx / sxy;
        *error = slope_error * *dimension * *dimension;
    }
}

static void balance_row(clast_evolve *e, double *row)
{
    const sums fluid = sum_of(e, CLX_BODY_IN_FLUID);
    const sums floor = sum_of(e, CLX_BODY_ON_FLOOR);
    const sums out = sum_of(e, CLX_BODY_OUT);
    const double w = e->config->weight;
    const int64_t off = fluid.n + floor.n + out.n + e->n_event - e->n_start;
    const double error = w * (fluid.mass + floor.mass + out.mass) / e->mass_start - 1.0;
    const double value[] = {e->time,
                            (double)fluid.n,
                            (double)e->n_event,
                            (double)floor.n,
                            (double)out.n,
                            (double)off,
                            w * fluid.mass,
                            w * floor.mass,
                            w * out.mass,
                            error,
                            mean((double)fluid.grains, (double)fluid.n),
                            mean(fluid.by_mass_grains, fluid.mass),
                            (double)fluid.most,
                            mean(fluid.by_mass_envelope, fluid.mass),
                            mean(fluid.by_mass_porosity, fluid.mass),
                            mean(fluid.by_mass_speed, fluid.mass),
                            fluid.speed};
    const int n = (int)(sizeof value / sizeof value[0]);
    for (int k = 0; k < n; ++k) {
        row[k] = value[k];
    }
    clx_evolve_fractal(e, &row[n], &row[n + 1]);
    row[n + 2] = (double)e->step;
    row[n + 3] = e->n_cell;
    e->mass_error = fmax(e->mass_error, fabs(error));
    e->number_error =
        off > e->number_error || -off > e->number_error ? (off < 0 ? -off : off) : e->number_error;
}

enum { N_CLASS = 32 };

/// Grains 2^k .. 2^(k+1) - 1.
static int class_of(int32_t n)
{
    int k = 0;
    while (n > 1) {
        n >>= 1;
        ++k;
    }
    return k;
}

static clast_status spectrum_rows(clast_evolve *e)
{
    clast_status status = CLAST_OK;
    double sum[N_CLASS][8] = {{0.0}};
    for (int32_t i = 0; i < e->n_start; ++i) {
        const clx_evolve_body *b = &e->body[i];
        if (b->state != CLX_BODY_IN_FLUID && b->state != CLX_BODY_ON_FLOOR) {
            continue;
        }
        double *s = sum[class_of(b->n)];
        const int floor = b->state == CLX_BODY_ON_FLOOR ? 1 : 0;
        s[floor] += 1.0;
        s[2 + floor] += e->config->weight * b->mass;
        s[4] += b->gyration;
        s[5] += envelope_size(b);
        s[6] += 1.0 - b->volume / b->envelope;
        s[7] += b->speed;
    }
    for (int k = 0; k < N_CLASS; ++k) {
        const double n = sum[k][0] + sum[k][1];
        double *row = NULL;
        if (!(n > 0.0)) {
            continue;
        }
        CLX_TRY(clx_rows_add(&e->spectrum, &row));
        row[0] = e->time;
        row[1] = ldexp(1.0, k);
        row[2] = ldexp(1.0, k + 1) - 1.0;
        for (int j = 0; j < 8; ++j) {
            row[3 + j] = j < 4 ? sum[k][j] : sum[k][j] / n;
        }
    }
done:
    return status;
}

clast_status clx_evolve_series_begin(clast_evolve *e)
{
    e->balance = (clx_rows){.n_column = sizeof balance_column / sizeof *balance_column,
                            .column = balance_column};
    e->spectrum = (clx_rows){.n_column = sizeof spectrum_column / sizeof *spectrum_column,
                             .column = spectrum_column};
    e->cuts = (clx_rows){.n_column = CLX_N_CUTS_COLUMN, .column = clx_cuts_column};
    return clx_evolve_write_row(e);
}

clast_status clx_evolve_write_row(clast_evolve *e)
{
    clast_status status = CLAST_OK;
    double *row = NULL;
    CLX_TRY(clx_rows_add(&e->balance, &row));
    balance_row(e, row);
    CLX_TRY(spectrum_rows(e));
done:
    return status;
}
