/* Unit: bodies of a cloud meet at the rate of each kernel of the library. */
#include "evolving.h"
#include "support.h"

#include <clast/kernel.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What a kernel is given beside the cloud. */
typedef struct {
    const char *kernel;
    const char *option[2];
} given;

static const given GIVEN[] = {
    {"kernel=constant", {"constant=1e-3", NULL}},
    {"kernel=additive", {"additive=1e-3", NULL}},
    {"kernel=product", {"product=1e-3", NULL}},
    {"kernel=brownian", {NULL, NULL}},
    {"kernel=brownian_free", {NULL, NULL}},
    {"kernel=brownian_transition", {NULL, NULL}},
    {"kernel=shear_laminar", {"shear=10", NULL}},
    {"kernel=shear_turbulent", {"dissipation=0.01", NULL}},
    {"kernel=settling", {NULL, NULL}},
    {"kernel=inertial", {"dissipation=1", "speed_rms=0.5"}},
    {"kernel=ballistic", {"dissipation=1", "speed_rms=0.05"}},
    {"kernel=cloud_turbulence", {"dissipation=0.01", "speed_rms=0.3"}},
};
enum { N_GIVEN = sizeof GIVEN / sizeof *GIVEN, PARTICLES = 500, SEEDS = 20, EVENTS = 15 };

static void begin(const given *g, int seed, double duration, evolving *c)
{
    char word[2][64];
    (void)snprintf(word[0], sizeof word[0], "seed=%d", seed);
    (void)snprintf(word[1], sizeof word[1], "duration=%.17gs", duration);
    const char *option[24] = {"domain=box:0,0,0,1,1,1",
                              "particles=500",
                              "curve=lognormal:30um,10um,10um,80um",
                              "structure=no",
                              "brownian=no",
                              "floor=periodic",
                              "even=whole",
                              "rows=1",
                              "time_step=1e300",
                              "out_of_range=extrapolate",
                              g->kernel,
                              word[0],
                              word[1]};
    for (int k = 0, n = 13; k < 2 && g->option[k] != NULL; ++k) {
        option[n++] = g->option[k];
    }
    evolving_begin(c, option);
}

/* Mean of |N(fall z, sd^2)|. */
static double mean_speed(double fall, double sd)
{
    return sd * sqrt(2.0 / CLAST_PI) * exp(-0.5 * fall * fall / (sd * sd)) +
           (fall + sd * sd / fall) * erf(fall / (sd * sqrt(2.0)));
}

/* Variance of the velocity that turbulence gives a particle [Abrahamson1975]. */
static double variance(const clast_medium *m, const clast_collider *a)
{
    const double u2 = m->speed_rms * m->speed_rms;
    const double tau = a->mass / (6.0 * CLAST_PI * m->viscosity * a->radius);
    return u2 / (1.0 + 1.5 * tau * m->dissipation / u2);
}

static double rate_of(uint32_t kernel, const clast_medium *m, const clast_collider *a,
                      const clast_collider *b)
{
    if (kernel != 1U << CLAST_KERNEL_BALLISTIC) {
        return clast_kernel_value(kernel, m, a, b);
    }
    const double r = a->radius + b->radius;
    return CLAST_PI * r * r *
           mean_speed(fabs(a->settling_speed - b->settling_speed),
                      sqrt(variance(m, a) + variance(m, b)));
}

/* Sum of the kernel over all pairs as they begin. */
static double sum_of_rates(const evolving *c)
{
    uint32_t kernel = 0;
    clast_table table = {0};
    clast_medium medium = c->config.medium;
    double sum = 0.0;
    medium.particle_density = 2500.0;
    CHECK_OK(clast_kernel_parse(c->config.kernel, &kernel));
    CHECK_OK(clast_evolve_table(c->evolve, CLAST_EVOLVE_PARTICLES, &table));
    clast_collider *list = calloc((size_t)table.n_row, sizeof *list);
    assert_non_null(list);
    for (int64_t i = 0; i < table.n_row; ++i) {
        list[i] = (clast_collider){.monomers = 1.0,
                                   .radius = clast_table_numbers(&table, "collision_radius_m")[i],
                                   .mass = clast_table_numbers(&table, "mass_kg")[i],
                                   .settling_speed = clast_table_numbers(&table, "speed_m/s")[i]};
        for (int64_t j = 0; j < i; ++j) {
            sum += rate_of(kernel, &medium, &list[i], &list[j]);
        }
    }
    free(list);
    clast_table_free(&table);
    return sum;
}

/* Events until a few of a hundred particles have met, over clouds of 500: their number is that of
 * the kernel over all pairs, less by the pairs that are gone. */
static void each_kernel_has_its_rate(void **state)
{
    (void)state;
    assert_int_equal(N_GIVEN, CLAST_N_KERNEL);
    for (int k = 0; k < N_GIVEN; ++k) {
        int64_t found = 0;
        for (int seed = 1; seed <= SEEDS; ++seed) {
            evolving c;
            begin(&GIVEN[k], seed, 1.0, &c);
            const double duration = EVENTS / sum_of_rates(&c);
            evolving_end(&c);
            begin(&GIVEN[k], seed, duration, &c);
            found += evolving_follow(&c).n_event;
            evolving_end(&c);
        }
        printf("%s: %d events of %d\n", GIVEN[k].kernel, (int)found, SEEDS * EVENTS);
        CHECK_ABS((double)found, SEEDS * EVENTS,
                  4.0 * sqrt(SEEDS * EVENTS) + 0.03 * SEEDS * EVENTS);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(each_kernel_has_its_rate)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
