// Error of the integral of the squared density by pairs on clouds whose density is known, over
// seeds; with `time` in place of a scene what counting costs.
//
//     bench_pairs [n = 1000] [repeats = 100] [first seed = 1000] [scene, or all]
//     bench_pairs 1e6 3 1 time
//
// Columns: mean of the estimate over the truth less 1, its standard error, root mean square, share
// resolved; of the resolved ones bias and share covered; of the others the share whose lower bound
// holds.
#include "math/rng.h"

#include <clast/cloud.h>
#include <clast/machine.h>
#include <clast/pairs.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/// A share of the points uniform, the others normal along some axes about the middle.
typedef struct {
    const char *name;
    int32_t d;
    int32_t off;  ///< so many axes, the last ones, along which the block is off the border
    double share; ///< in the structure
    double sd[3]; ///< 0: uniform along this axis
    double side;  ///< > 0: uniform in a block of this side instead, in the corner
    double layer; ///< > 0: uniform in a layer so thick across the last axis, off the border
} scene;

static const double layer_low = 0.37; ///< where what is off the border begins

static const scene scenes[] = {{"uniform_3d", 3, 0, 0.0, {0, 0, 0}, 0, 0},
                               {"sheet_0.02", 3, 0, 1.0, {0, 0, 0.02}, 0, 0},
                               {"line_0.02", 3, 0, 1.0, {0.02, 0.02, 0}, 0, 0},
                               {"blob_0.1_of_0.03", 3, 0, 0.1, {0.03, 0.03, 0.03}, 0, 0},
                               {"blob_0.3_of_0.06", 3, 0, 0.3, {0.06, 0.06, 0.06}, 0, 0},
                               {"blob_0.5_of_0.05_3d", 3, 0, 0.5, {0.05, 0.05, 0.05}, 0, 0},
                               {"blob_0.33_of_0.12", 3, 0, 1.0 / 3.0, {0.12, 0.12, 0.12}, 0, 0},
                               {"octant_0.85", 3, 0, 0.85, {0, 0, 0}, 0.5, 0},
                               {"uniform_2d", 2, 0, 0.0, {0, 0, 0}, 0, 0},
                               {"blob_0.5_of_0.05", 2, 0, 0.5, {0.05, 0.05, 0}, 0, 0},
                               {"stripe_0.02", 2, 0, 1.0, {0, 0.02, 0}, 0, 0},
                               {"blob_1_of_0.2", 2, 0, 1.0, {0.2, 0.2, 0}, 0, 0},
                               {"quadrant_0.85", 2, 0, 0.85, {0, 0, 0}, 0.5, 0},
                               {"uniform_1d", 1, 0, 0.0, {0, 0, 0}, 0, 0},
                               {"blob_0.5_of_0.02_1d", 1, 0, 0.5, {0.02, 0, 0}, 0, 0},
                               {"layer_0.1", 3, 0, 1.0, {0, 0, 0}, 0, 0.1},
                               {"layer_0.2", 3, 0, 1.0, {0, 0, 0}, 0, 0.2},
                               {"corner_0.1", 3, 0, 1.0, {0, 0, 0}, 0.1, 0},
                               {"corner_0.03", 3, 0, 1.0, {0, 0, 0}, 0.03, 0},
                               {"corner_0.01", 3, 0, 1.0, {0, 0, 0}, 0.01, 0},
                               {"corner_0.001", 3, 0, 1.0, {0, 0, 0}, 0.001, 0},
                               {"corner_0.94_of_0.1", 3, 0, 0.94, {0, 0, 0}, 0.1, 0},
                               {"corner_0.8_of_0.1", 3, 0, 0.8, {0, 0, 0}, 0.1, 0},
                               {"edge_0.1", 3, 1, 1.0, {0, 0, 0}, 0.1, 0},
                               {"edge_0.01", 3, 1, 1.0, {0, 0, 0}, 0.01, 0},
                               {"face_0.1", 3, 2, 1.0, {0, 0, 0}, 0.1, 0},
                               {"cube_0.1", 3, 3, 1.0, {0, 0, 0}, 0.1, 0},
                               {"corner_0.1_2d", 2, 0, 1.0, {0, 0, 0}, 0.1, 0},
                               {"corner_0.01_2d", 2, 0, 1.0, {0, 0, 0}, 0.01, 0}};

static double cut_normal(clx_rng *rng, double sd)
{
    for (;;) {
        const double x = 0.5 + sd * clx_rng_normal(rng);
        if (x >= 0.0 && x <= 1.0) {
            return x;
        }
    }
}

/// Where the block begins along axis j.
static double block_low(const scene *s, int j)
{
    return j >= s->d - s->off ? layer_low : 0.0;
}

static void draw(const scene *s, clx_rng *rng, double *x)
{
    const bool inside = clx_rng_uniform(rng) < s->share;
    for (int j = 0; j < s->d; ++j) {
        x[j] = !inside           ? clx_rng_uniform(rng)
               : s->side > 0.0   ? block_low(s, j) + s->side * clx_rng_uniform(rng)
               : s->sd[j] == 0.0 ? clx_rng_uniform(rng)
                                 : cut_normal(rng, s->sd[j]);
    }
    if (inside && s->layer > 0.0) {
        x[s->d - 1] = layer_low + s->layer * clx_rng_uniform(rng);
    }
}

static double integral_of(const scene *s)
{
    double squared = s->layer > 0.0 ? 1.0 / s->layer : 1.0;
    for (int j = 0; j < s->d; ++j) {
        if (s->side > 0.0) {
            squared /= s->side;
        } else if (s->sd[j] > 0.0) {
            const double mass = erf(0.5 / s->sd[j] / sqrt(2.0));
            squared *= erf(0.5 / s->sd[j]) / (2.0 * s->sd[j] * sqrt(CLAST_PI)) / (mass * mass);
        }
    }
    return (1.0 - s->share) * (1.0 + s->share) + s->share * s->share * squared;
}

static double density(const scene *s, const double *x)
{
    double product = s->share;
    if (s->layer > 0.0) {
        const double z = x[s->d - 1] - layer_low;
        product *= z >= 0.0 && z < s->layer ? 1.0 / s->layer : 0.0;
    }
    for (int j = 0; j < s->d; ++j) {
        if (s->side > 0.0) {
            const double z = x[j] - block_low(s, j);
            product *= z >= 0.0 && z < s->side ? 1.0 / s->side : 0.0;
        } else if (s->sd[j] > 0.0) {
            const double t = (x[j] - 0.5) / s->sd[j];
            product *= exp(-0.5 * t * t) /
                       (s->sd[j] * sqrt(2.0 * CLAST_PI) * erf(0.5 / s->sd[j] / sqrt(2.0)));
        }
    }
    return 1.0 - s->share + product;
}

static double now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static clast_status cloud_of(const scene *s, int64_t n, uint64_t seed, clast_cloud *cloud)
{
    const clast_status status = clast_cloud_alloc(n, s->d, cloud);
    for (int64_t i = 0; i < n && status == CLAST_OK; ++i) {
        clx_rng rng = clx_rng_at(seed, CLX_STREAM_TEST, (uint64_t)i);
        draw(s, &rng, cloud->x + i * s->d);
    }
    return status;
}

static clast_status run(const scene *s, int64_t n, int repeats, uint64_t first)
{
    const clast_domain domain = {.kind = CLAST_DOMAIN_BOX, .dimension = s->d, .high = {1, 1, 1}};
    const double truth = integral_of(s);
    double left = 0.0, left2 = 0.0, sum = 0.0, squares = 0.0, sum_r = 0.0, wall = 0.0, scale = 0.0,
           width = 0.0;
    int resolved = 0, covered = 0, below = 0, low_fails = 0, high_fails = 0;
    clast_pairs_config config;
    clast_status status = clast_fields_default(clast_pairs_fields, &config);
    for (int k = 0; k < repeats && status == CLAST_OK; ++k) {
        clast_cloud cloud = {0};
        clast_pairs pairs = {0};
        status = cloud_of(s, n, first + (uint64_t)k, &cloud);
        const double begun = now();
        if (status == CLAST_OK) {
            status = clast_pairs_count(&domain, &cloud, &config, &pairs);
        }
        wall += now() - begun;
        const clast_estimate e = pairs.integral.estimate;
        const double error = e.value / truth - 1.0;
        double sampling_error = 0.0;
        for (int64_t i = 0; i < cloud.n; ++i) {
            sampling_error += 2.0 * (density(s, cloud.x + i * s->d) / truth - 1.0) / (double)n;
        }
        left += (error - sampling_error) / repeats;
        left2 += (error - sampling_error) * (error - sampling_error) / repeats;
        sum += error / repeats;
        squares += error * error / repeats;
        resolved += e.resolved;
        sum_r += e.resolved ? error : 0.0;
        width += e.resolved ? 0.5 * log(e.high / e.low) : 0.0;
        covered += e.resolved && e.low <= truth && truth <= e.high;
        low_fails += e.resolved && e.low > truth;
        high_fails += e.resolved && e.high < truth;
        below += !e.resolved && e.low <= truth;
        scale += isinf(pairs.integral.scale) ? 0.0 : pairs.integral.scale / repeats;
        clast_pairs_free(&pairs);
        clast_cloud_free(&cloud);
    }
    (void)printf(
        "%s,%lld,%.5g,%+.4f,%.4f,%.4f,%.3f,%+.4f,%.3f,%.3f,%.3f,%.3f,%.3f,%.4g,%+.4f,%.4f,%.4g\n",
        s->name, (long long)n, truth, sum, sqrt(fmax(0.0, squares - sum * sum) / repeats),
        sqrt(squares), (double)resolved / repeats, resolved > 0 ? sum_r / resolved : (double)NAN,
        resolved > 0 ? (double)covered / resolved : (double)NAN,
        resolved > 0 ? (double)low_fails / resolved : (double)NAN,
        resolved > 0 ? (double)high_fails / resolved : (double)NAN,
        resolved > 0 ? width / resolved : (double)NAN,
        resolved < repeats ? (double)below / (repeats - resolved) : (double)NAN, scale, left,
        sqrt(left2), wall / repeats);
    (void)fflush(stdout);
    return status;
}

static clast_status measure_time(int64_t n, int repeats)
{
    clast_status status = CLAST_OK;
    clast_pairs_config config;
    status = clast_fields_default(clast_pairs_fields, &config);
    for (int s = 0; s < 9; s += 4) {
        const clast_domain domain = {
            .kind = CLAST_DOMAIN_BOX, .dimension = scenes[s].d, .high = {1, 1, 1}};
        clast_cloud cloud = {0};
        status = status == CLAST_OK ? cloud_of(&scenes[s], n, 1, &cloud) : status;
        for (int threads = 1; threads <= 2; ++threads) {
            double least = INFINITY;
            clast_pairs pairs = {0};
            clast_parallel_set_threads(threads);
            for (int k = 0; k < repeats && status == CLAST_OK; ++k) {
                clast_pairs_free(&pairs);
                const double begun = now();
                status = clast_pairs_count(&domain, &cloud, &config, &pairs);
                least = fmin(least, now() - begun);
            }
            (void)printf("pairs_%s_%.0e,%.3f s,%d threads,%lld pairs within %g\n", scenes[s].name,
                         (double)n, least, threads, (long long)pairs.n_pair, pairs.radius);
            clast_pairs_free(&pairs);
        }
        clast_cloud_free(&cloud);
    }
    return status;
}

int main(int argc, char **argv)
{
    const int64_t n = argc > 1 ? (int64_t)strtod(argv[1], NULL) : 1000;
    const int repeats = argc > 2 ? (int)strtol(argv[2], NULL, 10) : 100;
    const uint64_t first = argc > 3 ? strtoull(argv[3], NULL, 10) : 1000;
    const char *name = argc > 4 ? argv[4] : "all";
    clast_status status = CLAST_OK;
    if (strcmp(name, "time") == 0) {
        status = measure_time(n, repeats);
    } else {
        (void)printf("scene,n,integral,bias,standard_error,rms,resolved,bias_resolved,covered,"
                     "low_above,high_below,half_width,lower_holds,scale,bias_without_luck,rms_"
                     "without_luck,cpu_s\n");
    }
    for (size_t s = 0; s < sizeof scenes / sizeof scenes[0] && strcmp(name, "time") != 0; ++s) {
        if (status == CLAST_OK && (strcmp(name, "all") == 0 || strcmp(name, scenes[s].name) == 0)) {
            status = run(&scenes[s], n, repeats, first);
        }
    }
    if (status != CLAST_OK) {
        (void)fprintf(stderr, "bench_pairs: %s\n", clast_error_detail());
    }
    return clast_status_exit_code(status);
}
