// Neighbours by sorted cells of half the greatest distance: 25 rows of cells around each, each row
// one range of points (axis 0 runs fastest). Only occupied cells are kept, so that a narrow cloud
// in a wide domain costs no more than another. Integer sums, and sums of numbers in fixed blocks of
// cells: the same bytes for any number of threads.
#include "cloud/pair_cells.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "cloud/pair_edge.h"
#include "math/sort.h"
#include <clast/pairs.h>
#include <math.h>
#include <string.h>

enum {
    RANGE = 2,         ///< cells to either side
    MOST_ROW = 25,     ///< rows of cells around one
    MOST_DIM = 524288, ///< cells an axis: keys stay below 2^63
    MOST_BLOCK = 256,  ///< blocks of cells that are summed by themselves
    CHUNK = 256,       ///< distances computed together
    OCTAVE = 64,       ///< entries of the shell table for a factor of two in r^2
    MOST_TABLE = 4096
};

void clx_pair_cells_free(clx_pair_cells *c)
{
    for (int j = 0; j < 3; ++j) {
        clx_free(c->x[j]);
    }
    clx_free(c->safe);
    clx_free(c->key);
    clx_free(c->begin);
    *c = (clx_pair_cells){0};
}

static void measure(const double *x, double radius, clx_pair_cells *c)
{
    double extent = 0.0;
    for (int32_t j = 0; j < c->d; ++j) {
        double high = -INFINITY;
        c->low[j] = INFINITY;
        for (int64_t i = 0; i < c->n; ++i) {
            c->low[j] = fmin(c->low[j], x[i * c->d + j]);
            high = fmax(high, x[i * c->d + j]);
        }
        extent = fmax(extent, c->n > 0 ? high - c->low[j] : 0.0);
    }
    c->side = fmax(0.5 * radius, extent / MOST_DIM);
    for (int32_t j = 0; j < 3; ++j) {
        c->dim[j] = j < c->d ? (int64_t)(extent / c->side) + 2 + 2 * (int64_t)RANGE : 1;
    }
}

static int64_t key_of(const clx_pair_cells *c, const double *x)
{
    int64_t key = 0;
    for (int32_t j = c->d - 1; j >= 0; --j) {
        key = key * c->dim[j] + (int64_t)((x[j] - c->low[j]) / c->side) + RANGE;
    }
    return key;
}

static void fill_cells(const double *x, const clx_keyed *entry, clx_pair_cells *c)
{
    for (int64_t i = 0; i < c->n; ++i) {
        for (int32_t j = 0; j < c->d; ++j) {
            c->x[j][i] = x[(int64_t)entry[i].item * c->d + j];
        }
        if (i == 0 || entry[i].key != entry[i - 1].key) {
            c->key[c->n_cell] = (int64_t)entry[i].key;
            c->begin[c->n_cell++] = i;
        }
    }
    c->begin[c->n_cell] = c->n;
}

clast_status clx_pair_cells_make(const double *x, int64_t n, int32_t d, double radius,
                                 clx_pair_cells *cells)
{
    clast_status status = CLAST_OK;
    clx_pair_cells made = {.d = d, .n = n};
    clx_keyed *entry = NULL;
    measure(x, radius, &made);
    CLX_TRY(clx_alloc(&entry, n, sizeof *entry));
    for (int64_t i = 0; i < n; ++i) {
        entry[i] = (clx_keyed){(uint64_t)key_of(&made, x + i * d), (uint64_t)i};
    }
    CLX_TRY(clx_sort_keyed(entry, n));
    for (int32_t j = 0; j < d; ++j) {
        CLX_TRY(clx_alloc(&made.x[j], n, sizeof *made.x[j]));
    }
    CLX_TRY(clx_alloc(&made.key, n, sizeof *made.key));
    CLX_TRY(clx_alloc(&made.begin, n + 1, sizeof *made.begin));
    fill_cells(x, entry, &made);
    *cells = made;
    made = (clx_pair_cells){0};
done:
    clx_free(entry);
    clx_pair_cells_free(&made);
    return status;
}

double clx_pair_cells_work(const clx_pair_cells *c)
{
    double sum = 0.0;
    for (int64_t k = 0; k < c->n_cell; ++k) {
        const double count = (double)(c->begin[k + 1] - c->begin[k]);
        sum += count * count;
    }
    return sum;
}

typedef struct {
    clx_pair_cells *cells;
    const clast_domain *domain;
    int32_t n_shell;
    double square[CLAST_MAX_SHELL]; ///< of the radii
    uint64_t first;                 ///< leading bits of the first entry of the table
    int32_t n_table;
    uint8_t shell[MOST_TABLE]; ///< of the least r^2 with these leading bits
    int64_t block;             ///< cells in a block, by their number alone
    clx_pair_sum *sum;         ///< [n_block][n_shell]
    int64_t *repeated;         ///< [n_block]
} job;

/// Sign, exponent and six bits of the fraction.
static uint64_t leading(double value)
{
    uint64_t bits = 0;
    memcpy(&bits, &value, sizeof bits);
    return bits >> 46;
}

static void fill_table(job *w)
{
    w->first = leading(w->square[0]);
    const uint64_t last = leading(w->square[w->n_shell - 1]);
    w->n_table = last - w->first < MOST_TABLE ? (int32_t)(last - w->first) + 1 : 0;
    for (int32_t t = 0, k = 0; t < w->n_table; ++t) {
        const uint64_t bits = (w->first + (uint64_t)t) << 46;
        double least = 0.0;
        memcpy(&least, &bits, sizeof least);
        while (k + 1 < w->n_shell && least >= w->square[k]) {
            ++k;
        }
        w->shell[t] = (uint8_t)k;
    }
}

static int32_t shell_of(const job *w, double r2)
{
    int32_t k = 0;
    if (r2 >= w->square[0] && w->n_table > 0) {
        k = w->shell[leading(r2) - w->first];
    }
    while (r2 >= w->square[k]) {
        ++k;
    }
    return k;
}

/// Sums of one point.
typedef struct {
    int64_t i;
    double x[3];
    int32_t count[CLAST_MAX_SHELL];
    double weight[CLAST_MAX_SHELL];
    double weight2[CLAST_MAX_SHELL];
    int64_t repeated;
} point;

static void add_pair(const job *w, int64_t k, double r2, point *p)
{
    const clx_pair_cells *c = w->cells;
    const int32_t shell = shell_of(w, r2);
    const double safe = fmin(c->safe[p->i], c->safe[k]);
    double h = 1.0;
    if (!(safe > 0.0 && r2 < safe * safe)) {
        double y[3] = {0};
        for (int32_t j = 0; j < c->d; ++j) {
            y[j] = c->x[j][k];
        }
        h = 0.5 *
            (clx_pair_edge_weight(w->domain, p->x, y) + clx_pair_edge_weight(w->domain, y, p->x));
    }
    ++p->count[shell];
    p->weight[shell] += h;
    p->weight2[shell] += h * h;
    p->repeated += r2 == 0.0 ? 1 : 0;
}

static void add_range(const job *w, int64_t begin, int64_t end, point *p)
{
    const clx_pair_cells *c = w->cells;
    const double most = w->square[w->n_shell - 1];
    double r2[CHUNK];
    int32_t near[CHUNK];
    for (int64_t k = begin; k < end; k += CHUNK) {
        const int32_t n = (int32_t)(end - k < CHUNK ? end - k : CHUNK);
        int32_t n_near = 0;
        for (int32_t i = 0; i < n; ++i) {
            const double t = c->x[0][k + i] - p->x[0];
            r2[i] = t * t;
        }
        for (int32_t j = 1; j < c->d; ++j) {
            const double *x = c->x[j] + k;
            const double at = p->x[j];
            for (int32_t i = 0; i < n; ++i) {
                const double t = x[i] - at;
                r2[i] += t * t;
            }
        }
        for (int32_t i = 0; i < n; ++i) {
            near[n_near] = i;
            n_near += r2[i] < most ? 1 : 0;
        }
        for (int32_t i = 0; i < n_near; ++i) {
            if (k + near[i] != p->i) {
                add_pair(w, k + near[i], r2[near[i]], p);
            }
        }
    }
}

/// A row of cells beside one: how far along the axes 1 and 2, and where its range is.
typedef struct {
    int32_t step[3];
    int64_t offset;
    int64_t low, high; ///< cells
} row;

static int32_t make_rows(const clx_pair_cells *c, row *rows)
{
    int32_t n = 0;
    const int32_t k_most = c->d > 2 ? RANGE : 0;
    const int32_t j_most = c->d > 1 ? RANGE : 0;
    for (int32_t k = -k_most; k <= k_most; ++k) {
        for (int32_t j = -j_most; j <= j_most; ++j) {
            rows[n++] = (row){.step = {0, j, k}, .offset = (k * c->dim[1] + j) * c->dim[0]};
        }
    }
    return n;
}

/// First cell from `from` on whose key is at least `key`.
static int64_t find_cell(const clx_pair_cells *c, int64_t from, int64_t key)
{
    int64_t step = 1;
    int64_t low = from;
    while (low + step < c->n_cell && c->key[low + step] < key) {
        low += step;
        step *= 2;
    }
    int64_t high = low + step < c->n_cell ? low + step : c->n_cell;
    while (low < high) {
        const int64_t middle = (low + high) / 2;
        if (c->key[middle] < key) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

/// Least distance of the point to a row, squared, a little less for rounding.
static double to_row(const clx_pair_cells *c, const row *r, const double *x)
{
    double sum = 0.0;
    for (int32_t j = 1; j < c->d; ++j) {
        const double at = (x[j] - c->low[j]) / c->side;
        const double cell = floor(at) + r->step[j];
        const double gap = c->side * (fmax(0.0, fmax(cell - at, at - cell - 1.0)) - 1e-6);
        sum += gap > 0.0 ? gap * gap : 0.0;
    }
    return sum;
}

static void add_point(const job *w, const row *rows, int32_t n_row, point *p, clx_pair_sum *sum)
{
    const clx_pair_cells *c = w->cells;
    int32_t met[CLAST_MAX_SHELL];
    int32_t n_met = 0;
    memset(p->count, 0, sizeof p->count);
    memset(p->weight, 0, sizeof p->weight);
    memset(p->weight2, 0, sizeof p->weight2);
    for (int32_t j = 0; j < c->d; ++j) {
        p->x[j] = c->x[j][p->i];
    }
    for (int32_t r = 0; r < n_row; ++r) {
        if (rows[r].low < rows[r].high && to_row(c, &rows[r], p->x) < w->square[w->n_shell - 1]) {
            add_range(w, c->begin[rows[r].low], c->begin[rows[r].high], p);
        }
    }
    for (int32_t k = 0; k < w->n_shell; ++k) {
        if (p->count[k] == 0) {
            continue;
        }
        met[n_met++] = k;
        for (int32_t l = 0; l < n_met; ++l) {
            sum[k].joint[met[l]] += p->weight[k] * p->weight[met[l]];
        }
        sum[k].pairs += p->count[k];
        sum[k].squares += (int64_t)p->count[k] * p->count[k];
        sum[k].weight += p->weight[k];
        sum[k].weight2 += p->weight2[k];
    }
}

static void sum_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const job *w = context;
    const clx_pair_cells *c = w->cells;
    row rows[MOST_ROW];
    const int32_t n_row = make_rows(c, rows);
    point p = {0};
    (void)worker;
    for (int64_t cell = begin; cell < end; ++cell) {
        for (int32_t r = 0; r < n_row; ++r) {
            const int64_t at = c->key[cell] + rows[r].offset;
            rows[r].low = find_cell(c, rows[r].low, at - RANGE);
            rows[r].high = find_cell(c, rows[r].low, at + RANGE + 1);
        }
        for (p.i = c->begin[cell]; p.i < c->begin[cell + 1]; ++p.i) {
            add_point(w, rows, n_row, &p, w->sum + begin / w->block * w->n_shell);
        }
    }
    w->repeated[begin / w->block] = p.repeated;
}

static void measure_safe(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const job *w = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        double x[3] = {0};
        for (int32_t j = 0; j < w->cells->d; ++j) {
            x[j] = w->cells->x[j][i];
        }
        w->cells->safe[i] = clx_pair_edge_safe(w->domain, x, 2.0 * w->cells->side);
    }
}

clast_status clx_pair_cells_sum(clx_pair_cells *cells, const clast_domain *domain, int32_t n_shell,
                                const double *radius, clx_pair_sum *sum, int64_t *n_repeated)
{
    clast_status status = CLAST_OK;
    job w = {.cells = cells, .domain = domain, .n_shell = n_shell};
    w.block = (cells->n_cell + MOST_BLOCK - 1) / MOST_BLOCK;
    const int64_t n_block = w.block > 0 ? (cells->n_cell + w.block - 1) / w.block : 0;
    for (int32_t k = 0; k < n_shell; ++k) {
        w.square[k] = radius[k] * radius[k];
    }
    fill_table(&w);
    CLX_TRY(clx_alloc(&w.sum, n_block * n_shell, sizeof *w.sum));
    CLX_TRY(clx_alloc(&w.repeated, n_block, sizeof *w.repeated));
    CLX_TRY(clx_alloc(&cells->safe, cells->n, sizeof *cells->safe));
    clx_parallel_for(cells->n, CHUNK, measure_safe, &w);
    clx_parallel_for(cells->n_cell, w.block, sum_block, &w);
    for (int64_t b = 0; b < n_block; ++b) {
        *n_repeated += w.repeated[b];
        for (int32_t k = 0; k < n_shell; ++k) {
            const clx_pair_sum *part = &w.sum[b * n_shell + k];
            sum[k].pairs += part->pairs;
            sum[k].squares += part->squares;
            sum[k].weight += part->weight;
            sum[k].weight2 += part->weight2;
            for (int32_t l = 0; l <= k; ++l) {
                sum[k].joint[l] += part->joint[l];
            }
        }
    }
done:
    clx_free(w.sum);
    clx_free(w.repeated);
    return status;
}
