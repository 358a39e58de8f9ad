/* Paper: clusters that meet at random have the fractal dimensions of the literature, and a cloud of
 * drops that meet by Brownian motion has the numbers of the sectional balance. */
#include "evolving.h"
#include "support.h"

#include <clast/evolve.h>
#include <clast/form.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* The result of a cloud of these options, and its balance. */
static clast_evolve_result follow(const char *const *option, clast_table *balance)
{
    evolving cloud;
    evolving_begin(&cloud, option);
    const clast_evolve_result result = evolving_follow(&cloud);
    if (balance != NULL) {
        CHECK_OK(clast_evolve_table(cloud.evolve, CLAST_EVOLVE_BALANCE, balance));
    }
    evolving_end(&cloud);
    return result;
}

/* Mean over clouds of 10000 spheres that meet by this kernel. */
static double dimension_of(const char *meeting, const char *kernel, const char *rate)
{
    enum { SEEDS = 4 };
    double sum = 0.0;
    for (int seed = 1; seed <= SEEDS; ++seed) {
        char word[32];
        (void)snprintf(word, sizeof word, "seed=%d", seed);
        const char *const option[] = {"domain=box:0,0,0,1,1,1",
                                      "particles=10000",
                                      "curve=1um",
                                      kernel,
                                      rate,
                                      "brownian=no",
                                      "gravity=0",
                                      "floor=reflect",
                                      "even=whole",
                                      "duration=1s",
                                      "rows=1",
                                      meeting,
                                      word,
                                      NULL};
        sum += follow(option, NULL).fractal_dimension;
    }
    printf("%s: D_f %.3f\n", meeting, sum / SEEDS);
    return sum / SEEDS;
}

/* Diffusion-limited cluster aggregation: 1.78 +- 0.05 [Jullien1984, Meakin1984]. */
static void diffusive_clusters_are_dlca(void **state)
{
    (void)state;
    CHECK_ABS(dimension_of("meeting=diffusive", "kernel=constant", "constant=0.04"), 1.78, 0.07);
}

/* Ballistic cluster-cluster aggregation: 1.91 +- 0.03 [Ball1984, Jullien1984b]. */
static void ballistic_clusters_are_bcca(void **state)
{
    (void)state;
    CHECK_ABS(dimension_of("meeting=ballistic", "kernel=constant", "constant=0.04"), 1.91, 0.08);
}

/* Reaction-limited: 2.11 +- 0.03 [Brown1985], 2.10 +- 0.05 measured [Lin1989]; the rate of clusters
 * that stick at few of their touches is about additive [Ball1987]. Until e^-3 of the spheres are
 * left. */
static void reactive_clusters_are_rlca(void **state)
{
    (void)state;
    CHECK_ABS(dimension_of("meeting=reaction", "kernel=additive", "additive=3e-4"), 2.1, 0.1);
}

/* Drops of 1 um in water, Brownian kernel: numbers as the sectional balance has them. */
static void brownian_cloud_is_the_sectional_balance(void **state)
{
    (void)state;
    const double n0 = 20000.0 / 1e-9; /* 1/m^3 */
    const char *const option[] = {"domain=box:0,0,0,1mm,1mm,1mm",
                                  "particles=20000",
                                  "curve=1um",
                                  "kernel=brownian",
                                  "structure=no",
                                  "brownian=no",
                                  "gravity=0",
                                  "floor=reflect",
                                  "temperature=293.15K",
                                  "viscosity=1.002e-3",
                                  "fluid_density=998.2",
                                  "duration=30000s",
                                  "rows=3",
                                  NULL};
    if (!clast_spectrum_has_sectional()) {
        printf("SKIPPED LOUDLY: no sectional solver in this build\n");
        skip();
    }
    clast_table balance = {0};
    clast_spectrum spectrum = {0};
    clast_spectrum_config config;
    clast_collide_config collide = {
        .alpha = 1.0, .leap = 0.01, .seed = 1, .monomer_radius = 0.5e-6};
    collide.medium.temperature = 293.15;
    collide.medium.viscosity = 1.002e-3;
    collide.medium.density = 998.2;
    collide.medium.particle_density = 2500.0;
    CHECK_OK(clast_kernel_parse("brownian", &collide.kernel));
    CHECK_OK(clast_fields_default(clast_spectrum_fields, &config));
    config.solver = CLAST_SOLVER_SECTIONAL;
    config.concentration = n0;
    config.duration = 30000.0;
    config.n_step = 3;
    config.repeats = 1;
    config.size_max = 1e4;
    CHECK_OK(clast_spectrum_evolve(NULL, &config, &collide, NULL, &spectrum));
    (void)follow(option, &balance);
    for (int row = 1; row <= 3; ++row) {
        const double exact = clast_table_numbers(&spectrum.history, "M0")[row] * 1e-9;
        const double found = clast_table_numbers(&balance, "n_particle")[row];
        printf("t = %d s: %.0f of %.0f\n", 10000 * row, found, exact);
        CHECK_ABS(found, exact, 5.0 * sqrt(exact / 3.0) + 0.005 * exact);
    }
    clast_table_free(&balance);
    clast_spectrum_free(&spectrum);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(diffusive_clusters_are_dlca),
                                       cmocka_unit_test(ballistic_clusters_are_bcca),
                                       cmocka_unit_test(reactive_clusters_are_rlca),
                                       cmocka_unit_test(brownian_cloud_is_the_sectional_balance)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
