// Events against the number of points, as the published figures of convergence: random parts of one
// cloud, decomposed each by itself.
#include <clast/decompose.h>

#include "base/alloc.h"
#include "base/status.h"
#include "math/rng.h"
#include "math/sort.h"
#include <math.h>
#include <string.h>

enum { LEAST = 5, MOST_SIZES = 40, MOST_CELLS = 200, N_COLUMN = 10 };

/// With beta dt, and without it.
static const char *const column_name[2][N_COLUMN] = {
    {"n", "events", "events_low", "events_high", "n_cell", "scaled_events", "scaled_low",
     "scaled_high", "regular_events", "scaled_regular"},
    {"n", "pair_integral", "pair_integral_low", "pair_integral_high", "n_cell",
     "scaled_pair_integral", "scaled_low", "scaled_high", "regular_pair_integral",
     "scaled_regular"}};

/// The cloud's points in an order fixed by the seed, so that the first m are a random part.
static clast_status shuffle_points(const clast_cloud *cloud, uint64_t seed, clast_cloud *out)
{
    const int32_t d = cloud->dimension;
    clx_keyed *order = NULL;
    clast_status status = CLAST_OK;
    CLX_TRY(clast_cloud_alloc(cloud->n, d, out));
    CLX_TRY(clx_alloc(&order, cloud->n, sizeof *order));
    for (int64_t i = 0; i < cloud->n; ++i) {
        order[i] = (clx_keyed){clx_mix(clx_mix(seed) ^ (uint64_t)i), (uint64_t)i};
    }
    CLX_TRY(clx_sort_keyed(order, cloud->n));
    for (int64_t i = 0; i < cloud->n; ++i) {
        memcpy(out->x + i * d, cloud->x + (int64_t)order[i].item * d, (size_t)d * sizeof *out->x);
    }
done:
    clx_free(order);
    return status;
}

/// Pairs in the cells of a regular mesh of the unit cube, capped as the events of cells are.
static clast_status regular_events(const clast_domain *domain, const clast_cloud *cloud, int32_t m,
                                   double beta_dt, double *events)
{
    clast_status status = CLAST_OK;
    int64_t *count = NULL;
    int64_t n_cell = 1;
    double sum = 0.0;
    for (int32_t j = 0; j < cloud->dimension; ++j) {
        n_cell *= m;
    }
    CLX_TRY(clx_alloc(&count, n_cell, sizeof *count));
    for (int64_t i = 0; i < cloud->n; ++i) {
        double u[3];
        int64_t cell = 0;
        if (clast_domain_map(domain, cloud->x + i * cloud->dimension, u)) {
            for (int32_t j = 0; j < cloud->dimension; ++j) {
                cell = cell * m + (int64_t)fmin(floor(u[j] * m), m - 1.0);
            }
            CLAST_ASSERT(cell >= 0 && cell < n_cell);
            ++count[cell];
        }
    }
    const double density = (double)n_cell / clast_domain_volume(domain);
    for (int64_t c = 0; c < n_cell; ++c) {
        const double n = (double)count[c];
        const double pairs = 0.5 * density * n * fmax(0.0, n - 1.0);
        sum += beta_dt > 0.0 ? fmin(beta_dt * pairs, 0.5 * n) : pairs;
    }
    *events = sum;
done:
    clx_free(count);
    return status;
}

static clast_status one_size(const clast_domain *domain, const clast_cloud *all, int64_t n,
                             const clast_decompose_config *config, int32_t regular,
                             double row[N_COLUMN])
{
    CLAST_ASSERT(n >= LEAST && n <= all->n);
    clast_decomposition r = {0};
    clast_cloud part = *all;
    part.n = n;
    clast_status status = CLAST_OK;
    CLX_TRY(clast_decompose_in(domain, &part, config, &r));
    if (regular > 0) {
        CLX_TRY(regular_events(domain, &part, regular, config->beta_dt, &row[8]));
    }
    const double scale = (double)all->n / (double)n * ((double)all->n / (double)n);
    const double high = r.resolved ? r.events_high : (double)NAN;
    const double made[8] = {
        (double)n,         r.events,         r.events_low,         high,
        (double)r.cells.n, r.events * scale, r.events_low * scale, high * scale};
    memcpy(row, made, sizeof made);
    row[9] = row[8] * scale;
done:
    clast_decomposition_free(&r);
    return status;
}

static clast_status check_sizes(const clast_domain *domain, const clast_cloud *cloud,
                                int32_t n_size, int32_t regular)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(n_size >= 1 && n_size <= MOST_SIZES, CLAST_E_CONFIG, "sizes: %d is not in 1 .. %d",
              n_size, MOST_SIZES);
    CLX_CHECK(regular >= 0 && regular <= MOST_CELLS, CLAST_E_CONFIG,
              "regular: %d is not in 0 .. %d", regular, MOST_CELLS);
    CLX_CHECK(cloud->weight == NULL && cloud->variable == NULL, CLAST_E_CONFIG,
              "sizes: takes parts of equal points: leave out the weight and variable columns");
    CLX_CHECK(regular == 0 || domain->kind != CLAST_DOMAIN_MESH, CLAST_E_CONFIG,
              "regular: has no volumes for the cells of mesh:FILE; see --fixed of clast "
              "agglomerate");
    CLX_CHECK(cloud->n >> (n_size - 1) >= LEAST, CLAST_E_CONFIG,
              "sizes: %d of %lld points end below %d points; ask for fewer", n_size,
              (long long)cloud->n, LEAST);
done:
    return status;
}

clast_status clast_decompose_sizes(const clast_domain *domain, const clast_cloud *cloud,
                                   int32_t n_size, int32_t regular,
                                   const clast_decompose_config *config, clast_table *table)
{
    clast_status status = CLAST_OK;
    clast_cloud all = {0};
    clast_table made = {0};
    CLX_ARGUMENTS(domain, cloud, config, table);
    CLX_GUARD(check_sizes(domain, cloud, n_size, regular));
    CLX_TRY(shuffle_points(cloud, config->seed, &all));
    CLX_TRY(clast_table_init(&made, "sizes", n_size));
    const int n_column = regular > 0 ? N_COLUMN : N_COLUMN - 2;
    for (int k = 0; k < n_column; ++k) {
        CLX_TRY(clast_table_add_number(&made, column_name[config->beta_dt > 0.0 ? 0 : 1][k], "-",
                                       NULL));
    }
    for (int32_t i = 0; i < n_size; ++i) {
        double row[N_COLUMN] = {0};
        CLX_TRY(one_size(domain, &all, all.n >> (n_size - 1 - i), config, regular, row));
        for (int k = 0; k < n_column; ++k) {
            made.column[k].number[i] = row[k];
        }
    }
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    clast_cloud_free(&all);
    return status;
}
