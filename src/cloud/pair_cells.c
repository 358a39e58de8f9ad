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
    MOST_TABLE = 2048  ///< 64 for each factor of two in r^2: 32 of them
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
    uint8_t shell[MOST_TABLE];      ///< of the least r^2 with these leading bits
    int64_t block;                  ///< cells in a block, by their number alone
    clx_pair_sum *sum;              ///< [n_block][n_shell]
    int64_t *repeated;              ///< [n_block]
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
    const int32_t n_table = (int32_t)(leading(w->square[w->n_shell - 1]) - w->first) + 1;
    CLAST_ASSERT(n_table <= MOST_TABLE);
    for (int32_t t = 0, k = 0; t < n_table; ++t) {
        const uint64_t bits = (w->first + (uint64_t)t) << 46;
        double least = 0.0;
        memcpy(&least, &bits, sizeof least);
        while (k + 1 < w->n_shell && least >= w->square[k]) {
            ++k;
        }
        w->shell[t] = (uint8_t)k;
    }
}

/// An entry of the table meets one border of shells at most: shells are a sixth of an octave or
/// wider.
static inline int32_t shell_of(const job *w, double r2)
{
    const int32_t k = r2 < w->square[0] ? 0 : w->shell[leading(r2) - w->first];
    return k + (r2 >= w->square[k] ? 1 : 0);
}

/// Sums of one point.
typedef struct {
    int64_t i;
    bool is_far; ///< from the border: all edge weights are 1
    double x[3];
    int32_t count[CLAST_MAX_SHELL];
    double extra[CLAST_MAX_SHELL];  ///< h - 1
    double extra2[CLAST_MAX_SHELL]; ///< h^2 - 1
    int64_t repeated;
} point;

static void weigh_pair(const job *w, int64_t k, double r2, int32_t shell, point *p)
{
    const clx_pair_cells *c = w->cells;
    const double safe = c->safe[p->i] < c->safe[k] ? c->safe[p->i] : c->safe[k];
    if (safe > 0.0 && r2 < safe * safe) {
        return;
    }
    double y[3] = {0};
    for (int32_t j = 0; j < c->d; ++j) {
        y[j] = c->x[j][k];
    }
    const double h =
        0.5 * (clx_pair_edge_weight(w->domain, p->x, y) + clx_pair_edge_weight(w->domain, y, p->x));
    p->extra[shell] += h - 1.0;
    p->extra2[shell] += h * h - 1.0;
}

/// Squared distances of n points from one, axis by axis.
static inline void distances(const clx_pair_cells *c, int64_t k, int32_t n, const double *at,
                             double *r2)
{
    const double *x = c->x[0] + k;
    const double *y = c->d > 1 ? c->x[1] + k : NULL;
    const double *z = c->d > 2 ? c->x[2] + k : NULL;
    if (c->d == 3) {
        for (int32_t i = 0; i < n; ++i) {
            const double t[3] = {x[i] - at[0], y[i] - at[1], z[i] - at[2]};
            r2[i] = t[0] * t[0] + t[1] * t[1] + t[2] * t[2];
        }
    } else if (c->d == 2) {
        for (int32_t i = 0; i < n; ++i) {
            const double t[2] = {x[i] - at[0], y[i] - at[1]};
            r2[i] = t[0] * t[0] + t[1] * t[1];
        }
    } else {
        for (int32_t i = 0; i < n; ++i) {
            r2[i] = (x[i] - at[0]) * (x[i] - at[0]);
        }
    }
}

static void add_range(const job *w, int64_t begin, int64_t end, point *p)
{
    const double most = w->square[w->n_shell - 1];
    double r2[CHUNK];
    int32_t near[CHUNK];
    for (int64_t k = begin; k < end; k += CHUNK) {
        const int32_t n = (int32_t)(end - k < CHUNK ? end - k : CHUNK);
        int32_t n_near = 0;
        distances(w->cells, k, n, p->x, r2);
        for (int32_t i = 0; i < n; ++i) {
            near[n_near] = i;
            n_near += r2[i] < most ? 1 : 0;
        }
        for (int32_t i = 0; i < n_near; ++i) {
            const int32_t shell = shell_of(w, r2[near[i]]);
            ++p->count[shell];
            if (r2[near[i]] == 0.0) {
                const bool is_self = k + near[i] == p->i;
                p->count[shell] -= is_self ? 1 : 0;
                p->repeated += is_self ? 0 : 1;
            }
            if (!p->is_far) {
                weigh_pair(w, k + near[i], r2[near[i]], shell, p);
            }
        }
    }
}

/// A row of cells beside one: how far along the axes 1 and 2, and where its range is.
typedef struct {
    int32_t step[3];
    int64_t offset;
    int64_t key;       ///< of its middle cell
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
static double to_row(const clx_pair_cells *c, const row *r, const double *part)
{
    double sum = 0.0;
    for (int32_t j = 1; j < c->d; ++j) {
        const double step = r->step[j];
        const double gap = step > 0.0 ? step - part[j] : step < 0.0 ? part[j] - step - 1.0 : 0.0;
        const double length = c->side * (gap - 1e-6);
        sum += length > 0.0 ? length * length : 0.0;
    }
    return sum;
}

/// The points of a row that may be near: its cells within the distance left along axis 0.
static void add_row(const job *w, const row *r, double left, const double *part, point *p)
{
    const clx_pair_cells *c = w->cells;
    const double extent = sqrt(left) / c->side + 1e-6;
    const int64_t middle = r->key;
    const int64_t from = middle + (int64_t)floor(part[0] - extent);
    const int64_t to = middle + (int64_t)floor(part[0] + extent);
    int64_t low = r->low;
    int64_t high = r->high;
    while (low < high && c->key[low] < from) {
        ++low;
    }
    while (low < high && c->key[high - 1] > to) {
        --high;
    }
    if (low < high) {
        add_range(w, c->begin[low], c->begin[high], p);
    }
}

static void gather_point(const job *w, const point *p, clx_pair_sum *sum)
{
    int32_t met[CLAST_MAX_SHELL];
    double weight[CLAST_MAX_SHELL];
    int32_t n_met = 0;
    for (int32_t k = 0; k < w->n_shell; ++k) {
        if (p->count[k] == 0) {
            continue;
        }
        weight[n_met] = p->count[k] + p->extra[k];
        met[n_met++] = k;
        for (int32_t l = 0; l < n_met; ++l) {
            sum[k].joint[met[l]] += weight[n_met - 1] * weight[l];
        }
        sum[k].pairs += p->count[k];
        sum[k].squares += (int64_t)p->count[k] * p->count[k];
        sum[k].weight += weight[n_met - 1];
        sum[k].weight2 += p->count[k] + p->extra2[k];
    }
}

static void add_point(const job *w, const row *rows, int32_t n_row, point *p, clx_pair_sum *sum)
{
    const clx_pair_cells *c = w->cells;
    double part[3] = {0};
    memset(p->count, 0, sizeof p->count);
    memset(p->extra, 0, sizeof p->extra);
    memset(p->extra2, 0, sizeof p->extra2);
    p->is_far = c->safe[p->i] >= 4.0 * c->side;
    for (int32_t j = 0; j < c->d; ++j) {
        p->x[j] = c->x[j][p->i];
        part[j] = (p->x[j] - c->low[j]) / c->side;
        part[j] -= floor(part[j]);
    }
    for (int32_t r = 0; r < n_row; ++r) {
        const double left = w->square[w->n_shell - 1] - to_row(c, &rows[r], part);
        if (rows[r].low < rows[r].high && left > 0.0) {
            add_row(w, &rows[r], left, part, p);
        }
    }
    gather_point(w, p, sum);
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
            rows[r].key = c->key[cell] + rows[r].offset;
            rows[r].low = find_cell(c, rows[r].low, rows[r].key - RANGE);
            rows[r].high = find_cell(c, rows[r].low, rows[r].key + RANGE + 1);
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
        w->cells->safe[i] = clx_pair_edge_safe(w->domain, x, 4.0 * w->cells->side);
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
