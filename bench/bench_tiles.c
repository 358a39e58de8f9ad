// Two questions about one settled, shaken bed of gravel hulls (152 vertices, the forms of case P1):
// what does a touching contact cost when sizes range over 11:1 (U7, B50) instead of 1.4:1 (U1), and
// what do a grain-step and memory cost at 2e5 grains?
//
//     build/release/bench/bench_tiles [U1|U7|B50|tiles]...          (all four; some minutes each)
//
// A bed is poured by clast_pack, shaken until 0.45 s, then 6 x 300 steps are timed. `tiles` sets
// copies of the U1 bed side by side, 2 x 2, 4 x 4 and 12 x 12: the same contacts, more of them. CPU
// time of one thread.
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

static const int sides[3] = {2, 4, 12};

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

static double peak_mb(void)
{
    char line[256];
    double kb = 0.0;
    FILE *file = fopen("/proc/self/status", "r");
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        if (strncmp(line, "VmHWM:", 6) == 0) {
            kb = strtod(line + 6, NULL);
        }
    }
    if (file != NULL) {
        (void)fclose(file);
    }
    return kb / 1024.0;
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
    CHECK_OK(clast_pack_advance(pack, (int64_t)(0.45 / config->dem.time_step)));
    return pack;
}

static void report(const char *name, double ns, const clast_dem_measures *m, double limit)
{
    const double touching = (double)(m->n_contact + m->n_wall_contact);
    printf("# %s: %d grains, %.3g touching a grain, %.4g ns a grain-step, peak %.4g MB\n", name,
           m->n_grain, touching / m->n_grain, ns, peak_mb());
    printf("%s,%.4g,ns/touching contact,%.4g,%.3g\n", name, ns * m->n_grain / touching, limit,
           limit > 0.0 ? limit * touching / (ns * m->n_grain) : 0.0);
    (void)fflush(stdout);
}

/// Cost of a grain-step in the poured bed; *per_contact is what U1 gave, 0 for U1 itself.
static void time_scene(const scene *s, const clast_pack *pack, double *per_contact)
{
    clast_dem_measures m;
    double best = INFINITY;
    clast_pack *moving = (clast_pack *)pack;
    for (int k = 0; k < 6; ++k) {
        const double begun = cpu();
        CHECK_OK(clast_pack_advance(moving, 300));
        best = fmin(best, 1e9 * (cpu() - begun) / 300.0 / clast_dem_n_grain(clast_pack_dem(pack)));
    }
    clast_dem_measure(clast_pack_dem(pack), &m);
    report(s->curve, best, &m, 1.5 * *per_contact);
    if (*per_contact == 0.0) {
        *per_contact = best * m.n_grain / (double)(m.n_contact + m.n_wall_contact);
    }
}

/// side x side copies of a periodic bed.
static void time_tiles(const clast_dem *bed, const clast_pack_config *config,
                       const clast_shape form[N_FORM], int side)
{
    const int32_t n = clast_dem_n_grain(bed);
    const double width = config->dem.width;
    clast_dem *dem = NULL;
    clast_dem_config wide = config->dem;
    clast_dem_grain *grain = calloc((size_t)n * (size_t)(side * side), sizeof *grain);
    clast_dem_measures m;
    double best = INFINITY;
    char name[32];
    int64_t k = 0;
    wide.width = side * width;
    CHECK_OK(clast_dem_create(&wide, &dem));
    for (int f = 0; f < N_FORM; ++f) {
        int32_t id = 0;
        CHECK_OK(clast_dem_add_shape(dem, &form[f], &id));
    }
    for (int t = 0; t < side * side; ++t) {
        for (int32_t i = 0; i < n; ++i, ++k) {
            clast_dem_read_grain(bed, i, &grain[k]);
            grain[k].position[0] += (t % side) * width;
            grain[k].position[1] += (double)(t / side) * width;
        }
    }
    CHECK_OK(clast_dem_add_grains(dem, (int32_t)k, grain));
    free(grain);
    clast_dem_set_drive(dem, &(clast_dem_drive){3e-4, 0.025, 1.0});
    const int64_t steps = side > 4 ? 60 : 600;
    CHECK_OK(clast_dem_step(dem, 2 * steps)); // tangential memories begin empty
    for (int r = 0; r < 5; ++r) {
        const double begun = cpu();
        CHECK_OK(clast_dem_step(dem, steps));
        best = fmin(best, 1e9 * (cpu() - begun) / (double)steps / (double)k);
    }
    clast_dem_measure(dem, &m);
    (void)snprintf(name, sizeof name, "TILES_%lld", (long long)k);
    report(name, best, &m, 0.0);
    printf("%s,%.4g,ns/grain-step,,\n%s,%.4g,MB,2048,%.3g\n", name, best, name, peak_mb(),
           2048.0 / peak_mb());
    clast_dem_destroy(dem);
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
    double per_contact = 0.0;
    clast_parallel_set_threads(1);
    make_forms(form);
    printf("scene,value,unit,reference,ratio\n");
    for (size_t k = 0; k < sizeof scenes / sizeof scenes[0]; ++k) {
        clast_pack_config config = {0};
        clast_curve curve = {0};
        clast_grading *grading = NULL;
        const bool tiles = k == 0 && is_wanted(argc, argv, "tiles");
        if (k > 0 && !is_wanted(argc, argv, scenes[k].curve)) {
            continue;
        }
        clast_pack *pack = pour(&scenes[k], form, &config, &curve, &grading);
        time_scene(&scenes[k], pack, &per_contact);
        for (int t = 0; tiles && t < 3; ++t) {
            time_tiles(clast_pack_dem(pack), &config, form, sides[t]);
        }
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
