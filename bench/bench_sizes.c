// What does a touching contact cost when sizes range over 11:1 (U7, B50) instead of 1.4:1 (U1)?
//
//     build/release/bench/bench_sizes [U7|B50]...          (both; some minutes each)
//
// Gravel hulls of 152 vertices (the forms of case P1), poured by clast_pack into a periodic box and
// shaken for 0.6 s after the last was made; then whole periods of shaking are timed, for touching
// pairs come and go within one, bed by bed in turn, for a machine's speed comes and goes too: the
// least of five counts. Contacts are counted every 250 steps. CPU time of one thread.
#include "gravel.h"
#include "support.h"

#include <clast/grading.h>
#include <clast/machine.h>
#include <clast/pack.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { N_FORM = 63, TURNS = 5 };

typedef struct {
    const char *curve;
    double mass, width;
    uint64_t seed;
} scene;

// widths that the longest grain of the seed leaves; 20 to 50 layers of the smallest grains
static const scene scenes[] = {{"U1", 1.0, 0.1, 1}, {"U7", 2.0, 0.16, 1}, {"B50", 1.5, 0.16, 1}};

static double cpu(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static clast_pack *pour(const scene *s, const clast_shape form[N_FORM], clast_pack_config *config,
                        clast_curve *curve, clast_grading **grading)
{
    clast_pack *pack = NULL;
    clast_pack_input input = {.n_shape = N_FORM, .shape = form};
    CHECK_OK(clast_fields_default(clast_pack_fields, config));
    CHECK_OK(clast_grading_load(s->curve, (clast_grading_spread)config->spread,
                                (clast_grading_count)config->count, curve, grading));
    config->dem.domain = CLAST_DEM_PERIODIC;
    config->dem.width = s->width;
    config->dem.height = 0.6;
    config->mass = s->mass;
    config->seed = s->seed;
    config->generator = CLAST_PACK_SHELF;
    config->first_low = 0.01;
    input.grading = *grading;
    CHECK_OK(clast_pack_create(config, &input, &pack));
    while (clast_pack_phase_of(pack) == CLAST_PACK_GENERATE) { // one fill, or several
        CHECK_OK(clast_pack_advance(pack, 200));
    }
    CHECK_OK(clast_pack_advance(pack, (int64_t)(0.6 / config->dem.time_step)));
    return pack;
}

/// A poured bed and what its windows gave so far.
typedef struct {
    const char *name;
    clast_pack_config config;
    clast_curve curve;
    clast_grading *grading;
    clast_pack *pack;
    double best, touching; // ns a touching contact in the least window, contacts a grain in it
} bed;

/// One period of shaking, after another was timed: what another bed left in the caches is no part.
static void time_period(bed *b)
{
    enum { BLOCK = 250 };
    const int64_t blocks = (int64_t)(b->config.shake_period / b->config.dem.time_step) / BLOCK;
    double spent = 0.0;
    double contacts = 0.0;
    clast_dem_measures m;
    for (int64_t k = 0; k < blocks; ++k) {
        const double begun = cpu();
        CHECK_OK(clast_pack_advance(b->pack, BLOCK));
        spent += cpu() - begun;
        clast_dem_measure(clast_pack_dem(b->pack), &m);
        contacts += (double)(m.n_contact + m.n_wall_contact) * BLOCK;
    }
    if (1e9 * spent / contacts < b->best) {
        b->best = 1e9 * spent / contacts;
        b->touching = contacts / (double)(blocks * BLOCK) / m.n_grain;
    }
}

static bool is_wanted(int argc, char **argv, const char *name)
{
    bool found = argc < 2;
    for (int k = 1; k < argc; ++k) {
        found = found || strcmp(argv[k], name) == 0;
    }
    return found;
}

int main(int argc, char **argv)
{
    enum { N_SCENE = sizeof scenes / sizeof scenes[0] };
    clast_shape form[N_FORM] = {0};
    bed beds[N_SCENE] = {0};
    int n = 0;
    clast_parallel_set_threads(1);
    support_gravel_forms(N_FORM, form);
    for (size_t k = 0; k < N_SCENE; ++k) {
        if (k == 0 || is_wanted(argc, argv, scenes[k].curve)) {
            bed *b = &beds[n++];
            *b = (bed){.name = scenes[k].curve, .best = INFINITY};
            b->pack = pour(&scenes[k], form, &b->config, &b->curve, &b->grading);
        }
    }
    for (int turn = 0; turn < TURNS; ++turn) {
        for (int k = 0; k < n; ++k) {
            time_period(&beds[k]);
        }
    }
    printf("scene,value,unit,reference,ratio\n");
    for (int k = 0; k < n; ++k) {
        bed *b = &beds[k];
        printf("# %s: %d grains, %.3g touching a grain, %.4g ns a grain-step\n", b->name,
               clast_dem_n_grain(clast_pack_dem(b->pack)), b->touching, b->best * b->touching);
        printf("SIZES_%s,%.4g,ns/touching contact,%.4g,%.3g\n", b->name, b->best,
               1.5 * beds[0].best, 1.5 * beds[0].best / b->best);
        clast_pack_destroy(b->pack);
        clast_grading_destroy(b->grading);
        clast_curve_free(&b->curve);
        clast_fields_free(clast_pack_fields, &b->config);
    }
    for (int k = 0; k < N_FORM; ++k) {
        clast_shape_free(&form[k]);
    }
    return 0;
}
