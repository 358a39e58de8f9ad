// What does a grain-step of a bed under a servo cost beside one of case P1?
//
//     build/release/bench/bench_pressed [N [KPA]]    (10,000 grains each, 10 kPa; some minutes)
//
// Gravel hulls of 152 vertices (the forms of case P1), U1: one bed poured into a periodic box and
// shaken for 0.6 s after the last was made, as P1; another in a cell that is periodic in x, y and
// z, pressed to so many kPa and held there. Then windows of one period of shaking are timed, bed by
// bed in turn, for a machine's speed comes and goes too: the least of five. CPU time of one thread.
#include "gravel.h"
#include "support.h"

#include <clast/grading.h>
#include <clast/machine.h>
#include <clast/pack.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { N_FORM = 63, TURNS = 5, WINDOW = 5000 };

/// Mean mass of a grain of U1 [kg], and of its grains in a cubic metre of the loose lattice.
static const double GRAIN = 4.2e-4;
static const double LOOSE = 80.0;

static double cpu(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

typedef struct {
    const char *name;
    clast_pack_config config;
    clast_curve curve;
    clast_grading *grading;
    clast_pack *pack;
    double best; ///< ns a grain-step in the least window
} bed;

static void create(bed *b, const clast_shape form[N_FORM])
{
    clast_pack_input input = {.n_shape = N_FORM, .shape = form, .grading = b->grading};
    CHECK_OK(clast_pack_create(&b->config, &input, &b->pack));
}

static void begin(bed *b, const char *name, double mass)
{
    clast_pack_config *c = &b->config;
    *b = (bed){.name = name, .best = INFINITY};
    CHECK_OK(clast_fields_default(clast_pack_fields, c));
    CHECK_OK(clast_grading_load("U1", (clast_grading_spread)c->spread,
                                (clast_grading_count)c->count, &b->curve, &b->grading));
    c->mass = mass;
    c->generator = CLAST_PACK_SHELF;
}

/// As P1: 4000 grains in a box of 0.1 m, others as deep.
static void pour(bed *b, const clast_shape form[N_FORM], double n)
{
    begin(b, "poured and shaken", n * GRAIN);
    b->config.dem.domain = CLAST_DEM_PERIODIC;
    b->config.dem.width = fmax(0.06, 0.1 * sqrt(n / 4000.0));
    b->config.dem.height = 0.6;
    b->config.first_low = 0.01;
    create(b, form);
    while (clast_pack_phase_of(b->pack) == CLAST_PACK_GENERATE) {
        CHECK_OK(clast_pack_advance(b->pack, 200));
    }
    CHECK_OK(clast_pack_advance(b->pack, (int64_t)(0.6 / b->config.dem.time_step)));
}

static void press(bed *b, const clast_shape form[N_FORM], double n, double kilopascals)
{
    static char stage[80];
    static char *stages[] = {stage};
    clast_dem_load load = {0};
    begin(b, "pressed by a servo", n * GRAIN);
    clast_pack_config *c = &b->config;
    c->dem.domain = CLAST_DEM_CELL;
    c->dem.width = c->dem.height = cbrt(n * GRAIN / LOOSE);
    c->dem.floor = false;
    c->dem.gravity = 0.0;
    c->dem.fluid_density = 0.0;
    c->load_rate = 10.0;
    (void)snprintf(stage, sizeof stage, "isotropic %gkPa until time 1000s", kilopascals);
    clast_text_list own = c->stages;
    c->stages = (clast_text_list){.n = 1, .item = stages};
    create(b, form);
    c->stages = own;
    do {
        CHECK_OK(clast_pack_advance(b->pack, 500));
        CHECK_OK(clast_dem_load_measure(clast_pack_dem(b->pack), &load));
    } while (load.stress[2] < 990.0 * kilopascals || load.unbalanced > 0.05);
}

static void time_window(bed *b)
{
    const double begun = cpu();
    CHECK_OK(clast_pack_advance(b->pack, WINDOW));
    const double value =
        1e9 * (cpu() - begun) / WINDOW / clast_dem_n_grain(clast_pack_dem(b->pack));
    b->best = fmin(b->best, value);
}

int main(int argc, char **argv)
{
    const double n = argc > 1 ? atof(argv[1]) : 10000.0;
    const double kilopascals = argc > 2 ? atof(argv[2]) : 10.0;
    clast_shape form[N_FORM] = {0};
    bed beds[2];
    clast_parallel_set_threads(1);
    support_gravel_forms(N_FORM, form);
    pour(&beds[0], form, n);
    press(&beds[1], form, n, kilopascals);
    for (int turn = 0; turn < TURNS; ++turn) {
        time_window(&beds[0]);
        time_window(&beds[1]);
    }
    printf("scene,value,unit,reference,ratio\n");
    for (int k = 0; k < 2; ++k) {
        clast_dem_load load = {0};
        const clast_dem *dem = clast_pack_dem(beds[k].pack);
        CHECK_OK(clast_dem_load_measure(dem, &load));
        printf("# %s: %d grains, %.3g contacts a grain\n", beds[k].name, clast_dem_n_grain(dem),
               load.coordination);
    }
    printf("PRESSED,%.4g,ns/grain-step,%.4g,%.3g\n", beds[1].best, 1.1 * beds[0].best,
           1.1 * beds[0].best / beds[1].best);
    for (int k = 0; k < 2; ++k) {
        clast_pack_destroy(beds[k].pack);
        clast_grading_destroy(beds[k].grading);
        clast_curve_free(&beds[k].curve);
        clast_fields_free(clast_pack_fields, &beds[k].config);
    }
    for (int k = 0; k < N_FORM; ++k) {
        clast_shape_free(&form[k]);
    }
    return 0;
}
