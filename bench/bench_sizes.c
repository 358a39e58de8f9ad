// What does a touching contact cost when sizes range over 11:1 (U7, B50) instead of 1.4:1 (U1)?
//
//     build/release/bench/bench_sizes [U7|B50]...          (both; some minutes each)
//
// Gravel hulls of 152 vertices (the forms of case P1), poured by clast_pack into a periodic box and
// shaken for 0.6 s after the last was made; then whole periods of shaking are timed, for touching
// pairs come and go within one. Contacts are counted every 250 steps. CPU time of one thread.
#include "gravel.h"
#include "support.h"

#include <clast/grading_file.h>
#include <clast/pack.h>
#include <clast/parallel.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { N_FORM = 63 };

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

static void make_forms(clast_shape form[N_FORM])
{
    for (int k = 0; k < N_FORM; ++k) {
        clast_mesh hull = {0};
        char name[16];
        support_gravel(30, (uint64_t)k, 152, &hull);
        (void)snprintf(name, sizeof name, "form%d", k);
        CHECK_OK(clast_shape_mesh(name, &hull, &form[k]));
        clast_mesh_free(&hull);
    }
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

/// CPU time of a touching contact and step over the best of three periods; *grain_step too.
static double per_contact(clast_pack *pack, double period, double *touching, double *grain_step)
{
    enum { BLOCK = 250 };
    const int64_t blocks = (int64_t)(period / 5e-6) / BLOCK;
    double best = INFINITY;
    for (int k = 0; k < 3; ++k) {
        double spent = 0.0;
        double contacts = 0.0;
        clast_dem_measures m;
        for (int64_t b = 0; b < blocks; ++b) {
            const double begun = cpu();
            CHECK_OK(clast_pack_advance(pack, BLOCK));
            spent += cpu() - begun;
            clast_dem_measure(clast_pack_dem(pack), &m);
            contacts += (double)(m.n_contact + m.n_wall_contact) * BLOCK;
        }
        if (1e9 * spent / contacts < best) {
            best = 1e9 * spent / contacts;
            *touching = contacts / (double)(blocks * BLOCK) / m.n_grain;
            *grain_step = best * *touching;
        }
    }
    return best;
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
    clast_shape form[N_FORM] = {0};
    double unimodal = 0.0;
    clast_parallel_set_threads(1);
    make_forms(form);
    printf("scene,value,unit,reference,ratio\n");
    for (size_t k = 0; k < sizeof scenes / sizeof scenes[0]; ++k) {
        clast_pack_config config = {0};
        clast_curve curve = {0};
        clast_grading *grading = NULL;
        double touching = 0.0;
        double grain_step = 0.0;
        if (k > 0 && !is_wanted(argc, argv, scenes[k].curve)) {
            continue;
        }
        clast_pack *pack = pour(&scenes[k], form, &config, &curve, &grading);
        const double ns = per_contact(pack, config.shake_period, &touching, &grain_step);
        unimodal = k == 0 ? ns : unimodal;
        printf("# %s: %d grains, %.3g touching a grain, %.4g ns a grain-step\n", scenes[k].curve,
               clast_dem_n_grain(clast_pack_dem(pack)), touching, grain_step);
        printf("SIZES_%s,%.4g,ns/touching contact,%.4g,%.3g\n", scenes[k].curve, ns, 1.5 * unimodal,
               1.5 * unimodal / ns);
        (void)fflush(stdout);
        clast_pack_destroy(pack);
        clast_grading_destroy(grading);
        clast_curve_free(&curve);
        clast_fields_free(clast_pack_fields, &config);
    }
    for (int k = 0; k < N_FORM; ++k) {
        clast_shape_free(&form[k]);
    }
    return 0;
}
