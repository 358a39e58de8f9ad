// Events against the number of points, as the published figures of convergence.
#include "decompose_sizes.h"

#include "command.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LEAST = 5, N_COLUMN = 10 };

/// With beta dt, and without it.
static const char *const name[2][N_COLUMN] = {
    {"n", "events", "events_low", "events_high", "n_cell", "scaled_events", "scaled_low",
     "scaled_high", "regular_events", "scaled_regular"},
    {"n", "pair_integral", "pair_integral_low", "pair_integral_high", "n_cell",
     "scaled_pair_integral", "scaled_low", "scaled_high", "regular_pair_integral",
     "scaled_regular"}};

/// Mixes a number thoroughly. [Steele2014, splitmix64]
static uint64_t mix(uint64_t x)
{
    x += UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ (x >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ (x >> 27)) * UINT64_C(0x94d049bb133111eb);
    return x ^ (x >> 31);
}

typedef struct {
    uint64_t key;
    int64_t point;
} rank;

static int by_key(const void *a, const void *b)
{
    const rank *left = a;
    const rank *right = b;
    return left->key != right->key ? (left->key > right->key) - (left->key < right->key)
                                   : (left->point > right->point) - (left->point < right->point);
}

/// The cloud's points in an order fixed by the seed, so that the first m are a random part.
static clast_status shuffled(const clast_cloud *cloud, uint64_t seed, clast_cloud *out)
{
    const int32_t d = cloud->dimension;
    rank *order = malloc(((size_t)cloud->n + 1) * sizeof *order);
    clast_status status = CLAST_OK;
    CLI_TRY(clast_cloud_alloc(cloud->n, d, out));
    CLI_CHECK(order != NULL, CLAST_E_MEMORY, "not enough memory for %lld points",
              (long long)cloud->n);
    for (int64_t i = 0; i < cloud->n; ++i) {
        order[i] = (rank){mix(mix(seed) ^ (uint64_t)i), i};
    }
    qsort(order, (size_t)cloud->n, sizeof *order, by_key);
    for (int64_t i = 0; i < cloud->n; ++i) {
        memcpy(out->x + i * d, cloud->x + order[i].point * d, (size_t)d * sizeof *out->x);
    }
done:
    free(order);
    return status;
}

/// Pairs in the cells of a regular mesh of the unit cube, capped as the events of cells are.
static clast_status regular_events(const clast_domain *domain, const clast_cloud *cloud, int32_t m,
                                   double beta_dt, double *events)
{
    int64_t n_cell = 1;
    for (int32_t j = 0; j < cloud->dimension; ++j) {
        n_cell *= m;
    }
    int64_t *count = calloc((size_t)n_cell, sizeof *count);
    double sum = 0.0;
    if (count == NULL) {
        return cli_fail(CLAST_E_MEMORY, "not enough memory for %lld cells", (long long)n_cell);
    }
    for (int64_t i = 0; i < cloud->n; ++i) {
        double u[3];
        int64_t cell = 0;
        if (clast_domain_map(domain, cloud->x + i * cloud->dimension, u)) {
            for (int32_t j = 0; j < cloud->dimension; ++j) {
                cell = cell * m + (int64_t)fmin(floor(u[j] * m), m - 1.0);
            }
            ++count[cell];
        }
    }
    const double density = (double)n_cell / clast_domain_volume(domain);
    for (int64_t c = 0; c < n_cell; ++c) {
        const double n = (double)count[c];
        const double pairs = 0.5 * density * n * fmax(0.0, n - 1.0);
        sum += beta_dt > 0.0 ? fmin(beta_dt * pairs, 0.5 * n) : pairs;
    }
    free(count);
    *events = sum;
    return CLAST_OK;
}

static clast_status one_size(const clast_domain *domain, const clast_cloud *all, int64_t n,
                             const clast_decompose_config *config, const cli_sizes *sizes,
                             double row[N_COLUMN])
{
    clast_decomposition r = {0};
    clast_cloud part = *all;
    part.n = n;
    clast_status status = CLAST_OK;
    CLI_TRY(clast_decompose_in(domain, &part, config, &r));
    if (sizes->regular > 0) {
        CLI_TRY(regular_events(domain, &part, sizes->regular, config->beta_dt, &row[8]));
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

static clast_status check(const clast_domain *domain, const clast_cloud *cloud,
                          const cli_sizes *sizes)
{
    if (cloud->weight != NULL || cloud->variable != NULL) {
        return cli_fail(CLAST_E_CONFIG, "--sizes takes parts of equal points: leave out the weight "
                                        "and variable columns");
    }
    if (sizes->regular > 0 && domain->kind == CLAST_DOMAIN_MESH) {
        return cli_fail(CLAST_E_CONFIG, "--regular has no volumes for the cells of mesh:FILE; see "
                                        "--fixed of clast agglomerate");
    }
    if (cloud->n >> (sizes->n_size - 1) < LEAST) {
        return cli_fail(CLAST_E_CONFIG,
                        "%d sizes of %lld points end below %d points; ask for fewer", sizes->n_size,
                        (long long)cloud->n, LEAST);
    }
    return CLAST_OK;
}

clast_status cli_decompose_sizes(const clast_domain *domain, const clast_cloud *cloud,
                                 const clast_decompose_config *config, const cli_sizes *sizes,
                                 clast_table *table)
{
    clast_cloud all = {0};
    clast_status status = CLAST_OK;
    CLI_TRY(check(domain, cloud, sizes));
    CLI_TRY(shuffled(cloud, config->seed, &all));
    CLI_TRY(clast_table_init(table, "sizes", sizes->n_size));
    const int n_column = sizes->regular > 0 ? N_COLUMN : N_COLUMN - 2;
    for (int k = 0; k < n_column; ++k) {
        CLI_TRY(clast_table_add_number(table, name[config->beta_dt > 0.0 ? 0 : 1][k], "-", NULL));
    }
    for (int32_t i = 0; i < sizes->n_size; ++i) {
        double row[N_COLUMN] = {0};
        CLI_TRY(one_size(domain, &all, all.n >> (sizes->n_size - 1 - i), config, sizes, row));
        for (int k = 0; k < n_column; ++k) {
            table->column[k].number[i] = row[k];
        }
    }
done:
    clast_cloud_free(&all);
    return status;
}

clast_status cli_decompose_sizes_chart(const clast_table *table, int32_t dimension,
                                       const char *path)
{
    const double *events = clast_table_numbers(table, "scaled_events");
    char label[64] = "events times (N / n)^2 (-)";
    if (events == NULL) {
        events = clast_table_numbers(table, "scaled_pair_integral");
        (void)snprintf(label, sizeof label, "pair integral times (N / n)^2 (1/m^%d)", dimension);
    }
    const double *n = clast_table_numbers(table, "n");
    const double *regular = clast_table_numbers(table, "scaled_regular");
    const clast_series series[2] = {{.kind = CLAST_SERIES_POINTS,
                                     .label = "cells of clast, 95 % interval",
                                     .x = n,
                                     .y = events,
                                     .low = clast_table_numbers(table, "scaled_low"),
                                     .high = clast_table_numbers(table, "scaled_high"),
                                     .n = table->n_row},
                                    {.kind = CLAST_SERIES_LINE,
                                     .label = "regular mesh",
                                     .x = n,
                                     .y = regular,
                                     .n = table->n_row,
                                     .colour = 1,
                                     .dashed = true}};
    const clast_chart chart = {.x = {.label = "points used, n (-)", .log = true},
                               .y = {.label = label},
                               .series = series,
                               .n_series = regular != NULL ? 2 : 1};
    return clast_chart_write(&chart, path);
}
