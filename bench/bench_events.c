// Error of the event count on clouds whose density f is known, over seeds: mean error (bias), its
// standard error, root mean square, share of intervals that cover, share of clouds in more than one
// cell, and the error that is left when the sample's own luck, 2 (mean of f at the points /
// integral of f^2 - 1), is taken off.
//
//     bench_events [n = 10000] [repeats = 20] [first seed = 1000] [scene, or all] [ways = 1..6]
//
// Clouds have a Poisson number of points, as the interval supposes: it shall cover beta dt / 2
// times the squared mean number times the integral. Errors are against n (n - 1) in place of that
// square, for n is known.
#include "math/rng.h"

#include <clast/cloud.h>
#include <clast/decompose.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef void (*draw_point)(clx_rng *rng, double x[3]);
typedef double (*density_at)(const double x[3]);

static void uniform(clx_rng *rng, double x[3])
{
    for (int j = 0; j < 3; ++j) {
        x[j] = clx_rng_uniform(rng);
    }
}

/// A normal number within [0, 1].
static double cut_normal(clx_rng *rng, double centre, double sd)
{
    for (;;) {
        const double x = centre + sd * clx_rng_normal(rng);
        if (x >= 0.0 && x <= 1.0) {
            return x;
        }
    }
}

static void in_blob(clx_rng *rng, double share, double sd, double x[3])
{
    uniform(rng, x);
    if (clx_rng_uniform(rng) < share) {
        for (int j = 0; j < 3; ++j) {
            x[j] = cut_normal(rng, 0.5, sd);
        }
    }
}

static void narrow_blob(clx_rng *rng, double x[3])
{
    in_blob(rng, 0.3, 0.06, x);
}

static void wide_blob(clx_rng *rng, double x[3])
{
    in_blob(rng, 1.0 / 3.0, 0.12, x);
}

/// Integral over [0, 1] of the squared density of a normal law cut to it.
static double squared_normal(double sd)
{
    const double mass = erf(0.5 / sd / sqrt(2.0));
    return erf(0.5 / sd) / (2.0 * sd * sqrt(CLAST_PI)) / (mass * mass);
}

static double blob_integral(double share, double sd)
{
    return (1.0 - share) * (1.0 - share) + 2.0 * share * (1.0 - share) +
           share * share * pow(squared_normal(sd), 3.0);
}

static double one(void)
{
    return 1.0;
}

static double uniform_density(const double x[3])
{
    (void)x;
    return 1.0;
}

static double normal_density(double x, double centre, double sd)
{
    const double t = (x - centre) / sd;
    return exp(-0.5 * t * t) / (sd * sqrt(2.0 * CLAST_PI) * erf(0.5 / sd / sqrt(2.0)));
}

static double blob_density(double share, double sd, const double x[3])
{
    double product = share;
    for (int j = 0; j < 3; ++j) {
        product *= normal_density(x[j], 0.5, sd);
    }
    return 1.0 - share + product;
}

static double narrow_blob_density(const double x[3])
{
    return blob_density(0.3, 0.06, x);
}

static double wide_blob_density(const double x[3])
{
    return blob_density(1.0 / 3.0, 0.12, x);
}

static double narrow_blob_integral(void)
{
    return blob_integral(0.3, 0.06);
}

static double wide_blob_integral(void)
{
    return blob_integral(1.0 / 3.0, 0.12);
}

/// A plume along z in a box: sd^2 = 0.02^2 + 0.01 z about the axis.
static double plume_sd(double z)
{
    return sqrt(0.0004 + 0.01 * z);
}

static void box_plume(clx_rng *rng, double x[3])
{
    x[2] = clx_rng_uniform(rng);
    x[0] = cut_normal(rng, 0.5, plume_sd(x[2]));
    x[1] = cut_normal(rng, 0.5, plume_sd(x[2]));
}

static double box_plume_density(const double x[3])
{
    return normal_density(x[0], 0.5, plume_sd(x[2])) * normal_density(x[1], 0.5, plume_sd(x[2]));
}

static double box_plume_integral(void)
{
    enum { N = 20000 };
    double sum = 0.0;
    for (int i = 0; i < N; ++i) {
        const double one_axis = squared_normal(plume_sd((i + 0.5) / N));
        sum += one_axis * one_axis / N;
    }
    return sum;
}

/// The specification's plume in a half pipe (R 0.1 m, L 1 m): from a point at half the height, sd^2
/// = 0.01^2 + 0.001 z.
static double pipe_sd(double z)
{
    return sqrt(1e-4 + 1e-3 * z);
}

static bool is_in_pipe(const double x[3])
{
    return x[1] >= 0.0 && x[0] * x[0] + x[1] * x[1] <= 0.01;
}

static void pipe_plume(clx_rng *rng, double x[3])
{
    x[2] = clx_rng_uniform(rng);
    do {
        x[0] = pipe_sd(x[2]) * clx_rng_normal(rng);
        x[1] = 0.05 + pipe_sd(x[2]) * clx_rng_normal(rng);
    } while (!is_in_pipe(x));
}

/// Integral over the half disc of a Gaussian exp(-r^2 / (2 s^2)) about the source.
static double half_disc(double s2)
{
    enum { N = 200 };
    double sum = 0.0;
    for (int i = 0; i < N; ++i) {
        const double rho = 0.1 * (i + 0.5) / N;
        for (int k = 0; k < N; ++k) {
            const double angle = CLAST_PI * (k + 0.5) / N;
            const double y = rho * sin(angle) - 0.05;
            const double x = rho * cos(angle);
            sum += rho * exp(-0.5 * (x * x + y * y) / s2);
        }
    }
    return sum * 0.1 / N * CLAST_PI / N;
}

enum { N_SLICE = 400 };
static double slice_mass[N_SLICE]; ///< half_disc at each slice's middle

static double pipe_plume_integral(void)
{
    double sum = 0.0;
    for (int i = 0; i < N_SLICE; ++i) {
        const double s2 = pipe_sd((i + 0.5) / N_SLICE) * pipe_sd((i + 0.5) / N_SLICE);
        slice_mass[i] = half_disc(s2);
        sum += half_disc(0.5 * s2) / (slice_mass[i] * slice_mass[i]) / N_SLICE;
    }
    return sum;
}

static double pipe_plume_density(const double x[3])
{
    const double s2 = pipe_sd(x[2]) * pipe_sd(x[2]);
    const double y = x[1] - 0.05;
    const int slice = (int)(x[2] * N_SLICE);
    return exp(-0.5 * (x[0] * x[0] + y * y) / s2) / slice_mass[slice < N_SLICE ? slice : 0];
}

/// 85 % in an octant.
static void octant(clx_rng *rng, double x[3])
{
    const double side = clx_rng_uniform(rng) < 0.85 ? 0.5 : 1.0;
    uniform(rng, x);
    for (int j = 0; j < 3; ++j) {
        x[j] *= side;
    }
}

static double octant_density(const double x[3])
{
    return x[0] < 0.5 && x[1] < 0.5 && x[2] < 0.5 ? 0.85 * 8.0 + 0.15 : 0.15;
}

static double octant_integral(void)
{
    const double inside = 0.85 * 8.0 + 0.15;
    return inside * inside / 8.0 + 0.15 * 0.15 * 7.0 / 8.0;
}

static const struct {
    const char *name, *domain;
    draw_point draw;
    double (*integral)(void); ///< of the squared density, in the domain's units
    density_at density;
} scenes[] = {
    {"uniform", "box:0,0,0,1,1,1", uniform, one, uniform_density},
    {"narrow_blob", "box:0,0,0,1,1,1", narrow_blob, narrow_blob_integral, narrow_blob_density},
    {"wide_blob", "box:0,0,0,1,1,1", wide_blob, wide_blob_integral, wide_blob_density},
    {"box_plume", "box:0,0,0,1,1,1", box_plume, box_plume_integral, box_plume_density},
    {"pipe_plume", "half-pipe:0.1,1", pipe_plume, pipe_plume_integral, pipe_plume_density},
    {"octant", "box:0,0,0,1,1,1", octant, octant_integral, octant_density}};
enum { N_SCENE = sizeof scenes / sizeof scenes[0] };

static const struct {
    const char *name, *key[2], *value[2];
} ways[] = {{"default", {"mesh", "crossfit"}, {"auto", "false"}},
            {"plain_tree", {"mesh", "extrapolate"}, {"tree", "false"}},
            {"tree_unrefined", {"mesh", "tree_refine"}, {"tree", "false"}},
            {"boxes", {"mesh", "tree_refine"}, {"boxes", "true"}},
            {"bins", {"mesh", "tree_refine"}, {"bins", "true"}},
            {"paper", {"mesh", "paper"}, {"boxes", "true"}}};
enum { N_WAY = sizeof ways / sizeof ways[0] };

typedef struct {
    double sum, squares, worst, cells, left, left2;
    int covered, split;
} tally;

static clast_status set(clast_decompose_config *c, const char *key, const char *value)
{
    return clast_field_set(clast_fields_find(clast_decompose_fields, key), c, value, false);
}

static clast_status measure(const clast_cloud *cloud, const char *domain, int way,
                            const double truth[3], tally *t)
{
    clast_decompose_config c;
    clast_decomposition r = {0};
    clast_status status = clast_fields_default(clast_decompose_fields, &c);
    if (status != CLAST_OK) {
        return status;
    }
    c.beta_dt = 1e-18; // far from the cap
    status = set(&c, "domain", domain);
    for (int k = 0; k < 2 && status == CLAST_OK; ++k) {
        status = set(&c, ways[way].key[k], ways[way].value[k]);
    }
    if (status == CLAST_OK) {
        status = clast_decompose(cloud, &c, &r);
    }
    // as printed, events are beta n^2 dt / V, twice those of eq. 1
    const double twice = c.paper ? 2.0 : 1.0;
    const double error = r.events / truth[0] / twice - 1.0;
    t->sum += error;
    t->squares += error * error;
    t->worst = fmax(t->worst, fabs(error));
    t->left += error - truth[2];
    t->left2 += (error - truth[2]) * (error - truth[2]);
    t->cells += r.cells.n;
    t->split += r.cells.n > 1 ? 1 : 0;
    t->covered += r.events_low <= twice * truth[1] && twice * truth[1] <= r.events_high ? 1 : 0;
    clast_decomposition_free(&r);
    clast_fields_free(clast_decompose_fields, &c);
    return status;
}

static clast_status run(int scene, double mean_n, int n_repeat, uint64_t first, int n_way)
{
    tally t[N_WAY] = {{0}};
    clast_status status = CLAST_OK;
    const double integral = scenes[scene].integral();
    for (int r = 0; r < n_repeat && status == CLAST_OK; ++r) {
        clast_cloud cloud = {0};
        clx_rng number = clx_rng_at(first + (uint64_t)r, CLX_STREAM_TEST, UINT64_MAX);
        status = clast_cloud_alloc(clx_rng_poisson(&number, mean_n), 3, &cloud);
        for (int64_t i = 0; i < cloud.n && status == CLAST_OK; ++i) {
            clx_rng rng = clx_rng_at(first + (uint64_t)r, CLX_STREAM_TEST, (uint64_t)i);
            scenes[scene].draw(&rng, cloud.x + 3 * i);
        }
        const double n = (double)cloud.n;
        double luck = 0.0;
        for (int64_t i = 0; i < cloud.n && status == CLAST_OK; ++i) {
            luck += 2.0 * (scenes[scene].density(cloud.x + 3 * i) / integral - 1.0) / n;
        }
        const double truth[3] = {0.5e-18 * n * (n - 1.0) * integral,
                                 0.5e-18 * mean_n * mean_n * integral, luck};
        for (int way = 0; way < n_way && status == CLAST_OK; ++way) {
            status = measure(&cloud, scenes[scene].domain, way, truth, &t[way]);
        }
        clast_cloud_free(&cloud);
    }
    for (int way = 0; way < n_way && status == CLAST_OK; ++way) {
        const double mean = t[way].sum / n_repeat;
        const double left = t[way].left / n_repeat;
        (void)printf("%s,%.0f,%s,%+.4f,%.4f,%.4f,%.4f,%+.5f,%.5f,%.4f,%.0f,%.4f\n",
                     scenes[scene].name, mean_n, ways[way].name, mean,
                     sqrt(fmax(0.0, t[way].squares / n_repeat - mean * mean) / n_repeat),
                     sqrt(t[way].squares / n_repeat), t[way].worst, left,
                     sqrt(fmax(0.0, t[way].left2 / n_repeat - left * left) / n_repeat),
                     (double)t[way].covered / n_repeat, t[way].cells / n_repeat,
                     (double)t[way].split / n_repeat);
    }
    (void)fflush(stdout);
    return status;
}

int main(int argc, char **argv)
{
    const double mean_n = argc > 1 ? strtod(argv[1], NULL) : 1e4;
    const int n_repeat = argc > 2 ? (int)strtol(argv[2], NULL, 10) : 20;
    const uint64_t first = argc > 3 ? strtoull(argv[3], NULL, 10) : 1000;
    const int n_way = argc > 5 ? (int)strtol(argv[5], NULL, 10) : N_WAY;
    clast_status status = CLAST_OK;
    (void)printf("scene,n,way,bias,standard_error,rms,worst,bias_without_luck,error_without_luck,"
                 "covered,cells,split\n");
    for (int s = 0; s < N_SCENE && status == CLAST_OK; ++s) {
        if (argc < 5 || strcmp(argv[4], "all") == 0 || strcmp(argv[4], scenes[s].name) == 0) {
            status = run(s, mean_n, n_repeat, first, n_way);
        }
    }
    if (status != CLAST_OK) {
        (void)fprintf(stderr, "bench_events: %s\n", clast_error_detail());
    }
    return clast_status_exit_code(status);
}
