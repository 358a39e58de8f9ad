// From a cloud to the points that are tested: mapping, extension, thinning.
#include "cloud/sample.h"

#include "base/alloc.h"
#include "base/comm.h"
#include "base/parallel.h"
#include "cloud/part.h"
#include "cloud/place_hash.h"
#include "cloud/surface.h"
#include "math/fixed_sum.h"
#include "math/rng.h"
#include <clast/machine.h>
#include <math.h>
#include <string.h>

enum { BLOCK = 4096 };

void clx_sample_free(clx_sample *sample)
{
    CLX_FREE(sample->u, sample->number);
    *sample = (clx_sample){0};
}

const double *clx_sample_point(const clx_sample *sample, int64_t i, double held[3])
{
    const int32_t d = sample->domain->dimension;
    if (sample->u != NULL) {
        return sample->u + i * d;
    }
    (void)clast_domain_map(sample->domain, sample->x + clx_sample_number(sample, i) * d, held);
    return held;
}

static void make_place(const void *context, int64_t i, double *place)
{
    const clx_sample *s = context;
    (void)clast_domain_map(s->domain, s->x + clx_sample_number(s, i) * s->domain->dimension, place);
}

clx_part clx_sample_part(const clx_sample *sample, int64_t n)
{
    clx_part part = clx_part_of(sample->comm, sample->u, n, sample->domain->dimension);
    part.make = make_place;
    part.context = sample;
    return part;
}

clx_fixed_scale clx_sample_scale(const clx_sample *sample, const double *weight)
{
    double most = 0.0;
    int64_t n = 0;
    for (int64_t i = 0; i < sample->n; ++i) {
        const int64_t number = clx_sample_number(sample, i);
        if (number >= 0) {
            most = fmax(most, weight != NULL ? weight[number] : 1.0);
            ++n;
        }
    }
    n = clx_comm_total(sample->comm, n);
    return clx_fixed_scale_of(-clx_comm_least(sample->comm, -most), n);
}

clast_status clx_points_check(const clast_cloud *cloud, int64_t before)
{
    clast_status status = CLAST_OK;
    for (int64_t i = 0; i < cloud->n * cloud->dimension; ++i) {
        CLX_CHECK(isfinite(cloud->x[i]), CLAST_E_FORMAT,
                  "point %lld has a coordinate that is not finite",
                  (long long)(before + i / cloud->dimension + 1));
    }
    for (int64_t i = 0; i < cloud->n && cloud->radius != NULL; ++i) {
        CLX_CHECK(cloud->radius[i] > 0.0 && isfinite(cloud->radius[i]), CLAST_E_FORMAT,
                  "the radius of point %lld is %g; it must be a number > 0",
                  (long long)(before + i + 1), cloud->radius[i]);
    }
    for (int64_t i = 0; i < cloud->n && cloud->variable != NULL; ++i) { // NAN: not known
        CLX_CHECK(isnan(cloud->variable[i]) || fabs(cloud->variable[i]) <= 1e150, CLAST_E_FORMAT,
                  "the variable of point %lld is %g; it must lie within 1e150 of 0", // squares
                  (long long)(before + i + 1), cloud->variable[i]);
    }
    for (int64_t i = 0; i < cloud->n && cloud->weight != NULL; ++i) {
        const double w = cloud->weight[i];
        CLX_CHECK(w > 0.0 && w <= 1e60, CLAST_E_FORMAT, // sums of fourth powers are doubles
                  "the weight of point %lld is %g; it must be a number > 0, 1e60 at most",
                  (long long)(before + i + 1), w);
    }
done:
    return status;
}

typedef struct {
    const clast_cloud *cloud;
    clx_sample *sample;
    uint64_t seed;
    int64_t first_ghost;
} map_context;

/// Images in place, where they are kept; number becomes -1 outside.
static void map_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const map_context *c = context;
    const int32_t d = c->cloud->dimension;
    double held[3];
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        double *place = c->sample->u != NULL ? c->sample->u + i * d : held;
        const bool inside = clast_domain_map(c->sample->domain, c->cloud->x + i * d, place);
        c->sample->number[i] = inside ? i : -1;
    }
}

/// Closes the gaps that points outside leave.
static void close_gaps(const clast_cloud *cloud, clx_sample *s)
{
    const int32_t d = cloud->dimension;
    for (int64_t i = 0; i < cloud->n; ++i) {
        if (s->number[i] >= 0) {
            if (s->n < i && s->u != NULL) {
                memmove(s->u + s->n * d, s->u + i * d, (size_t)d * sizeof *s->u);
            }
            s->number[s->n++] = i;
        }
    }
    s->n_real = s->n_test = s->n;
    if (s->u == NULL && s->n == cloud->n) {
        clx_free(s->number);
        s->number = NULL;
    }
}

static clast_status map_points(const clast_cloud *cloud, const clast_decompose_config *config,
                               clx_sample *s)
{
    clast_status status = CLAST_OK;
    map_context context = {.cloud = cloud, .sample = s};
    const bool is_named = config->domain != NULL && config->domain[0] != '\0';
    int64_t before = 0;
    int64_t total = 0;
    CLX_TRY(clx_comm_before(s->comm, cloud->n, &before, &total));
    status = clx_points_check(cloud, before);
    if (status == CLAST_OK && (s->comm->n_rank == 1 || s->domain->kind == CLAST_DOMAIN_MESH)) {
        status = clx_alloc(&s->u, cloud->n * cloud->dimension, sizeof *s->u);
    }
    s->x = cloud->x;
    if (status == CLAST_OK) {
        status = clx_alloc(&s->number, cloud->n, sizeof *s->number);
    }
    CLX_TRY(clast_comm_agree(s->comm, status, NULL));
    clx_parallel_for(cloud->n, BLOCK, map_block, &context);
    close_gaps(cloud, s);
    s->n_real_all = clx_comm_total(s->comm, s->n);
    s->n_outside_all = total - s->n_real_all;
    CLX_CHECK(s->n_outside_all == 0 || config->outside == CLAST_OUTSIDE_DROP, CLAST_E_FORMAT,
              "%lld of %lld points lie outside the domain%s%s; give the true domain, or leave them "
              "out with --outside drop",
              (long long)s->n_outside_all, (long long)total, is_named ? " " : "",
              is_named ? config->domain : "");
done:
    return status;
}

static void swap_points(clx_sample *s, int32_t d, int64_t a, int64_t b)
{
    CLAST_ASSERT(a >= 0 && a < s->n && b >= 0 && b < s->n);
    for (int32_t j = 0; j < d && s->u != NULL; ++j) {
        const double held = s->u[a * d + j];
        s->u[a * d + j] = s->u[b * d + j];
        s->u[b * d + j] = held;
    }
    const int64_t held = s->number[a];
    s->number[a] = s->number[b];
    s->number[b] = held;
}

/// What a point's chance is drawn for: its place and weight.
static uint64_t draw_of(const clast_cloud *cloud, int64_t i)
{
    uint64_t bits = 0;
    memcpy(&bits, &cloud->weight[i], sizeof bits);
    return clx_mix(clx_place_hash(cloud->x + i * cloud->dimension, cloud->dimension) ^ bits);
}

/// Numbers that were spared, as all points are in the domain.
static clast_status number_points(clx_sample *s)
{
    clast_status status = CLAST_OK;
    if (s->number == NULL) {
        CLX_TRY(clx_alloc(&s->number, s->n, sizeof *s->number));
        for (int64_t i = 0; i < s->n; ++i) {
            s->number[i] = i;
        }
    }
done:
    return status;
}

/// Tests a point with chance w / w_max; the others go behind.
static clast_status thin(const clast_cloud *cloud, uint64_t seed, clx_sample *s)
{
    clast_status status = CLAST_OK;
    double most = 0.0;
    int64_t kept = 0;
    CLX_TRY(clast_comm_agree(s->comm, number_points(s), NULL));
    for (int64_t i = 0; i < s->n; ++i) {
        most = fmax(most, cloud->weight[s->number[i]]);
    }
    most = -clx_comm_least(s->comm, -most);
    for (int64_t i = 0; i < s->n; ++i) {
        clx_rng rng = clx_rng_at(seed, CLX_STREAM_THINNING, draw_of(cloud, s->number[i]));
        if (clx_rng_uniform(&rng) * most <= cloud->weight[s->number[i]]) {
            swap_points(s, cloud->dimension, i, kept++);
        }
    }
    s->n_test = kept;
done:
    return status;
}

/// Ghosts uniform in what the box has outside the surface.
static void draw_ghosts(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const map_context *c = context;
    clx_sample *s = c->sample;
    (void)worker;
    for (int64_t g = begin; g < end; ++g) {
        clx_rng rng = clx_rng_at(c->seed, CLX_STREAM_EXTERIOR, (uint64_t)(c->first_ghost + g));
        double *u = s->u + 3 * (s->n_test + g);
        double x[3];
        do {
            for (int k = 0; k < 3; ++k) {
                u[k] = clx_rng_uniform(&rng);
            }
            clast_domain_unmap(s->domain, u, x);
        } while (clast_bvh_inside(s->domain->surface->bvh, x));
        s->number[s->n_test + g] = -1;
    }
}

/// Opens a gap for ghosts behind the points that are tested.
static clast_status allocate(int64_t n_ghost, clx_sample *s)
{
    clast_status status = CLAST_OK;
    const int64_t n_rest = s->n - s->n_test;
    CLX_TRY(clx_realloc(&s->u, 3 * (s->n + n_ghost), sizeof *s->u));
    CLX_TRY(clx_realloc(&s->number, s->n + n_ghost, sizeof *s->number));
    if (n_rest > 0) {
        memmove(s->u + 3 * (s->n_test + n_ghost), s->u + 3 * s->n_test,
                (size_t)(3 * n_rest) * sizeof *s->u);
        memmove(s->number + s->n_test + n_ghost, s->number + s->n_test,
                (size_t)n_rest * sizeof *s->number);
    }
done:
    return status;
}

static clast_status extend(uint64_t seed, clx_sample *s)
{
    clast_status status = CLAST_OK;
    double box = 1.0;
    for (int k = 0; k < 3; ++k) {
        box *= s->domain->high[k] - s->domain->low[k];
    }
    const int64_t n_test = clx_comm_total(s->comm, s->n_test);
    const double wanted = round((double)n_test * (box / s->domain->surface->volume - 1.0));
    CLX_CHECK(wanted < 0x1p31, CLAST_E_LIMIT,
              "the domain fills %.3g of its bounding box: %.3g ghosts would fill the rest (limit "
              "2^31)",
              s->domain->surface->volume / box, wanted);
    const int64_t n_all = wanted > 0.0 ? (int64_t)wanted : 0;
    const int64_t first = n_all * s->comm->rank / s->comm->n_rank;
    const int64_t n_ghost = n_all * (s->comm->rank + 1) / s->comm->n_rank - first;
    map_context context = {.sample = s, .seed = seed, .first_ghost = first};
    CLX_TRY(clast_comm_agree(s->comm, allocate(n_ghost, s), NULL));
    clx_parallel_for(n_ghost, BLOCK, draw_ghosts, &context);
    s->n_test += n_ghost;
    s->n += n_ghost;
done:
    return status;
}

clast_status clx_sample_map(const clast_comm *comm, const clast_cloud *cloud,
                            const clast_decompose_config *config, const clast_domain *domain,
                            clx_sample *sample)
{
    clast_status status = CLAST_OK;
    clx_sample made = {.domain = domain, .comm = comm};
    CLX_CHECK(domain->dimension == cloud->dimension, CLAST_E_CONFIG,
              "domain '%s' has %d dimensions, the points have %d",
              config->domain != NULL ? config->domain : "", domain->dimension, cloud->dimension);
    CLX_TRY(map_points(cloud, config, &made));
    *sample = made;
    made = (clx_sample){0};
done:
    clx_sample_free(&made);
    return status;
}

clast_status clx_sample_complete(const clast_cloud *cloud, const clast_decompose_config *config,
                                 clx_sample *sample)
{
    clast_status status = CLAST_OK;
    CLAST_ASSERT(sample->domain != NULL);
    if (cloud->weight != NULL) {
        CLX_TRY(thin(cloud, config->seed, sample));
    }
    if (sample->domain->kind == CLAST_DOMAIN_MESH) {
        CLX_TRY(extend(config->seed, sample));
    }
done:
    return status;
}

clast_status clx_sample_make(const clast_comm *comm, const clast_cloud *cloud,
                             const clast_decompose_config *config, const clast_domain *domain,
                             clx_sample *sample)
{
    clast_status status = CLAST_OK;
    clx_sample made = {0};
    CLX_TRY(clx_sample_map(comm, cloud, config, domain, &made));
    CLX_TRY(clx_sample_complete(cloud, config, &made));
    *sample = made;
    made = (clx_sample){0};
done:
    clx_sample_free(&made);
    return status;
}
