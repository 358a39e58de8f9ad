// Events against the number of points, as the published figures of convergence: random parts of one
// cloud, decomposed each by itself.
#include <clast/decompose.h>

#include "base/alloc.h"
#include "base/comm.h"
#include "cloud/decompose_steps.h"
#include "cloud/shuffle.h"
#include <clast/machine.h>
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

/// Pairs of all ranks' points in the cells of a regular mesh of the unit cube, m an axis, capped as
/// the events of cells are.
static clast_status regular_events(const clast_comm *comm, const clast_domain *domain,
                                   const clast_cloud *cloud, int32_t m, double beta_dt,
                                   double *events)
{
    clast_status status = CLAST_OK;
    int64_t *count = NULL;
    int64_t n_cell = 1;
    double sum = 0.0;
    for (int32_t j = 0; j < cloud->dimension; ++j) {
        n_cell *= m;
    }
    CLX_TRY(clast_comm_agree(comm, clx_alloc(&count, n_cell, sizeof *count), NULL));
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
    clx_comm_sum(comm, count, n_cell);
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

static clast_status one_size(const clast_domain *domain, const clx_shuffled *all, int64_t n,
                             const clast_decompose_config *config, int32_t regular,
                             double row[N_COLUMN])
{
    CLAST_ASSERT(n >= LEAST && n <= all->n_all);
    clast_decomposition r = {0};
    clast_cloud part = all->cloud;
    part.n = clx_shuffled_first(all, n);
    clast_status status = CLAST_OK;
    CLX_TRY(clast_decompose_ranks(all->comm, domain, &part, config, &r));
    if (regular > 0) {
        CLX_TRY(regular_events(all->comm, domain, &part, regular, config->beta_dt, &row[8]));
    }
    const double m = (double)all->n_all;
    const double pairs = m * (m - 1.0) / ((double)n * (double)(n - 1));
    const bool is_printed = config->paper || config->events == CLAST_EVENTS_PAPER;
    const double scale = is_printed ? m * m / ((double)n * (double)n) : pairs;
    const double high = r.resolved ? r.events_high : (double)NAN;
    const double made[8] = {
        (double)n,         r.events,         r.events_low,         high,
        (double)r.cells.n, r.events * scale, r.events_low * scale, high * scale};
    memcpy(row, made, sizeof made);
    row[9] = row[8] * pairs; // regular_events are of n (n - 1)
done:
    clast_decomposition_free(&r);
    return status;
}

/// @param n  points on all ranks
static clast_status check_sizes(const clast_domain *domain, const clast_cloud *cloud, int64_t n,
                                const clast_decompose_parts *sizes)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(sizes->n_size >= 1 && sizes->n_size <= MOST_SIZES, CLAST_E_CONFIG,
              "sizes: %d is not in 1 .. %d", sizes->n_size, MOST_SIZES);
    CLX_CHECK(sizes->regular >= 0 && sizes->regular <= MOST_CELLS, CLAST_E_CONFIG,
              "regular: %d is not in 0 .. %d", sizes->regular, MOST_CELLS);
    CLX_CHECK(cloud->weight == NULL && cloud->variable == NULL, CLAST_E_CONFIG,
              "sizes: takes parts of equal points: leave out the weight and variable columns");
    CLX_CHECK(sizes->regular == 0 || domain->kind != CLAST_DOMAIN_MESH, CLAST_E_CONFIG,
              "regular: has no volumes for the cells of mesh:FILE; see --fixed of clast "
              "agglomerate");
    CLX_CHECK(n >> (sizes->n_size - 1) >= LEAST, CLAST_E_CONFIG,
              "sizes: %d of %lld points end below %d points; ask for fewer", sizes->n_size,
              (long long)n, LEAST);
done:
    return status;
}

static clast_status make_table(bool is_regular, int32_t n_size, bool is_timed, clast_table *table)
{
    clast_status status = CLAST_OK;
    const int n_column = is_regular ? N_COLUMN : N_COLUMN - 2;
    CLX_TRY(clast_table_init(table, "sizes", n_size));
    for (int k = 0; k < n_column; ++k) {
        CLX_TRY(clast_table_add_number(table, column_name[is_timed ? 0 : 1][k], "-", NULL));
    }
done:
    return status;
}

clast_status clast_decompose_sizes(const clast_comm *comm, const clast_domain *domain,
                                   const clast_cloud *cloud, const clast_decompose_parts *sizes,
                                   const clast_decompose_config *config, clast_table *table)
{
    CLX_FLOAT_ENVIRONMENT;
    clast_status status = CLAST_OK;
    const clast_comm *ranks = clx_comm_or_one(comm);
    clx_shuffled all = {0};
    clast_table made = {0};
    int64_t before = 0;
    int64_t n = 0;
    CLX_ARGUMENTS(domain, cloud, sizes, config, table);
    CLX_CHECK(clx_comm_has_sums(ranks), CLAST_E_ARGUMENT, "comm has no sum or no exchange");
    CLX_TRY(clast_comm_agree(ranks, clx_decompose_check(domain, cloud, config), NULL));
    CLX_TRY(clx_comm_before(ranks, cloud->n, &before, &n));
    CLX_TRY(clast_comm_agree(ranks, check_sizes(domain, cloud, n, sizes), NULL));
    CLX_TRY(clast_comm_agree(ranks, clx_points_check(cloud, before), NULL));
    CLX_TRY(clx_shuffle(ranks, cloud, config->seed, &all));
    status = make_table(sizes->regular > 0, sizes->n_size, config->beta_dt > 0.0, &made);
    CLX_TRY(clast_comm_agree(ranks, status, NULL));
    for (int32_t i = 0; i < sizes->n_size; ++i) {
        double row[N_COLUMN] = {0};
        CLX_TRY(one_size(domain, &all, n >> (sizes->n_size - 1 - i), config, sizes->regular, row));
        for (int k = 0; k < made.n_column; ++k) {
            made.column[k].number[i] = row[k];
        }
    }
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    clx_shuffled_free(&all);
    return status;
}
