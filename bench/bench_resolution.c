// Events by default over densities, places and numbers of points: of what is called resolved the
// bias and how often the 95 % interval covers, of the rest how often the lower bound holds.
//
//     bench_resolution [n = 1000] [repeats = 100] [first seed = 1] [density, or all] [place]
//     bench_resolution list         densities and places alone
//
// Place: 2box, 3box, 3cylinder, 3surface; all without it. The estimator is that of CLAST_ESTIMATOR
// (cells, pairs), auto without it.
// Clouds have a Poisson number of points, as the interval supposes; the truth is the squared mean
// number times the integral of the squared density; the bias is that for the number drawn. `tests`
// votes do not move the numbers, so Pearson's alone runs.
#include "densities.h"

#include <clast/decompose.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const place_name[N_PLACE] = {"box", "cylinder", "surface"};

typedef struct {
    int n, n_resolved, n_covered, n_excluded, n_low;
    double sum, squares, half, low, per_needed;
} tally;

static void add(const clast_decomposition *r, double mean_n, double truth, tally *t)
{
    const double n = (double)r->n;
    const double ratio = r->events / (truth * n * (n - 1.0) / (mean_n * mean_n)); // n given
    const bool covers = r->events_low <= truth && truth <= r->events_high;
    ++t->n;
    if (r->resolved) {
        ++t->n_resolved;
        t->n_covered += covers ? 1 : 0;
        t->n_excluded += covers ? 0 : 1;
        t->sum += ratio;
        t->squares += ratio * ratio;
        t->half += 0.5 * log(r->events_high / r->events_low);
    } else {
        t->n_low += covers ? 1 : 0;
        t->low += r->events_low / truth;
        t->per_needed += 1.0 / r->points_needed;
    }
}

static void print_row(const density_scene *s, double mean_n, const tally *t)
{
    const double n = t->n_resolved > 0 ? t->n_resolved : (double)NAN;
    const double rest = t->n > t->n_resolved ? t->n - t->n_resolved : (double)NAN;
    const double mean = t->sum / n;
    const double sd = sqrt(fmax(0.0, t->squares / n - mean * mean));
    (void)printf("%s,%d,%s,%.0f,%d,%.6g,%.4f,%.5f,%.5f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.3g\n",
                 s->density->name, s->dimension, place_name[s->place], mean_n, t->n, s->integral,
                 (double)t->n_resolved / t->n, mean - 1.0, sd / sqrt(n), sd, t->half / n,
                 t->n_covered / n, (double)t->n_excluded / t->n, t->n_low / rest, t->low / rest,
                 rest / t->per_needed);
    (void)fflush(stdout);
}

static clast_status run(const density_scene *s, double mean_n, int n_repeat, uint64_t first)
{
    clast_decompose_config c;
    tally t = {0};
    const double truth = 0.5e-18 * mean_n * mean_n * s->integral; // beta dt is far from any cap
    clast_status status = clast_fields_default(clast_decompose_fields, &c);
    if (status == CLAST_OK) {
        status = clast_field_set(clast_fields_find(clast_decompose_fields, "tests"), &c, "pearson",
                                 false);
    }
    if (status == CLAST_OK && getenv("CLAST_ESTIMATOR") != NULL) {
        status = clast_field_set(clast_fields_find(clast_decompose_fields, "estimator"), &c,
                                 getenv("CLAST_ESTIMATOR"), false);
    }
    c.beta_dt = 1e-18;
    for (int k = 0; k < n_repeat && status == CLAST_OK; ++k) {
        clast_cloud cloud = {0};
        clast_decomposition r = {0};
        status = density_scene_draw(s, mean_n, first + (uint64_t)k, &cloud);
        if (status == CLAST_OK) {
            status = clast_decompose_in(&s->domain, &cloud, &c, &r);
        }
        if (status == CLAST_OK) {
            add(&r, mean_n, truth, &t);
        }
        clast_decomposition_free(&r);
        clast_cloud_free(&cloud);
    }
    if (status == CLAST_OK) {
        print_row(s, mean_n, &t);
    }
    clast_fields_free(clast_decompose_fields, &c);
    return status;
}

/// Whether the row is asked for; name: as 3box, or NULL.
static bool is_place(const char *name, int32_t d, density_place place)
{
    return name == NULL || (name[0] == (char)('0' + d) && strcmp(name + 1, place_name[place]) == 0);
}

static void list_scenes(void)
{
    (void)printf("density,d,place\n");
    for (int k = 0; k < N_DENSITY * N_PLACE * 2; ++k) {
        const density *law = &densities[k / (2 * N_PLACE)];
        const density_place place = (density_place)(k / 2 % N_PLACE);
        if (density_fits(law, place, 2 + k % 2)) {
            (void)printf("%s,%d,%s\n", law->name, 2 + k % 2, place_name[place]);
        }
    }
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "list") == 0) {
        list_scenes();
        return 0;
    }
    const double mean_n = argc > 1 ? strtod(argv[1], NULL) : 1e3;
    const int n_repeat = argc > 2 ? (int)strtol(argv[2], NULL, 10) : 100;
    const uint64_t first = argc > 3 ? strtoull(argv[3], NULL, 10) : 1;
    clast_status status = CLAST_OK;
    (void)printf("density,d,place,n,clouds,integral,resolved,bias,bias_error,sd,half_width,covered,"
                 "excluded,low_holds,low,points_needed\n");
    for (int k = 0; k < N_DENSITY * N_PLACE * 2 && status == CLAST_OK; ++k) {
        const density *law = &densities[k / (2 * N_PLACE)];
        const density_place place = (density_place)(k / 2 % N_PLACE);
        const int32_t d = 2 + k % 2;
        density_scene s = {0};
        if ((argc > 4 && strcmp(argv[4], "all") != 0 && strcmp(argv[4], law->name) != 0) ||
            !is_place(argc > 5 ? argv[5] : NULL, d, place) || !density_fits(law, place, d)) {
            continue;
        }
        status = density_scene_make(law, place, d, &s);
        if (status == CLAST_OK) { // seeds of its own for each row
            status = run(&s, mean_n, n_repeat, first + 1000000 * (uint64_t)k);
        }
        density_scene_free(&s);
    }
    if (status != CLAST_OK) {
        (void)fprintf(stderr, "bench_resolution: %s\n", clast_error_detail());
    }
    return clast_status_exit_code(status);
}
