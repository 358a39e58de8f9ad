// Sums over the neighbours of each point in shells of distance. Around a cell lie 25 rows of five
// cells, each one range of the sorted points (axis 0 runs fastest). Their points are put side by
// side for the points of the cell; where they are too many, a point looks at those parts of the
// rows that its sphere may reach. The outer shells, which hold nine tenths of the pairs in 3-D, are
// counted in SIMD lanes by comparing with their radii; what is closer is looked up one by one.
// Integer sums, and sums of numbers in the order of the points and in fixed blocks of cells: the
// same bytes for any number of threads.
#include "base/alloc.h"
#include "base/machine.h"
#include "base/parallel.h"
#include "cloud/pair_cells.h"
#include "cloud/pair_edge.h"
#include <clast/cloud.h>
#include <clast/pairs.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    RANGE = CLX_PAIR_RANGE,
    WIDTH = 2 * CLX_PAIR_RANGE + 1, ///< cells of a row
    MOST_ROW = WIDTH * WIDTH,       ///< rows of cells around one
    CHUNK = 256,                    ///< points whose distance to the border is measured together
    BESIDE = 512,                   ///< points around a cell that are put side by side
    MOST_TABLE = 2048               ///< 64 for each factor of two in r^2: 32 of them
};

typedef struct {
    clx_pair_cells *cells;
    const clast_domain *domain;
    int32_t n_shell;
    double square[CLAST_MAX_SHELL]; ///< of the radii
    double outer[CLX_PAIR_OUTER];   ///< the last of them, descending
    uint64_t first;                 ///< leading bits of the first entry of the table
    uint8_t shell[MOST_TABLE];      ///< of the least r^2 with these leading bits
    const uint64_t *key;            ///< [n_block + 1] where the blocks begin
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

/// Radii of the outer shells; where there are fewer, only repeated points are closer than the last.
static void fill_outer(job *w)
{
    for (int32_t j = 0; j < CLX_PAIR_OUTER; ++j) {
        w->outer[j] = j < w->n_shell ? w->square[w->n_shell - 1 - j] : DBL_TRUE_MIN;
    }
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

/// A row of cells beside one, and its points.
typedef struct {
    int32_t step[3];       ///< how far along the axes 1 and 2
    int64_t offset;        ///< of its middle cell's key
    int64_t low;           ///< first cell of it, or where it would be
    int64_t at[WIDTH + 1]; ///< where the points of its five cells begin, and their end
} row;

/// One cell with its rows, and the sums of one of its points.
typedef struct {
    const job *job;
    row rows[MOST_ROW];
    int32_t n_row;
    bool is_beside;                          ///< the points of the rows lie side by side
    double beside[4][BESIDE + CLX_PAIR_PAD]; ///< their coordinates and safe2
    int32_t n_beside, own, close_from,
        close_to; ///< points; the cell's first one; the rows next to it
    int64_t i;    ///< the point
    bool is_far;  ///< from the border: all edge weights are 1
    clx_pair_lanes lanes;
    int32_t count[CLAST_MAX_SHELL];
    double extra[CLAST_MAX_SHELL];  ///< h - 1
    double extra2[CLAST_MAX_SHELL]; ///< h^2 - 1
    int64_t repeated;
} walk;

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

/// First of all cells whose key is at least `key`.
static int64_t first_cell(const clx_pair_cells *c, uint64_t key)
{
    return find_cell(c, 0, (int64_t)key);
}

/// Where the row beside the cell of this key has its points.
static void find_row(const clx_pair_cells *c, int64_t key, row *r)
{
    const int64_t first = key + r->offset - RANGE;
    r->low = find_cell(c, r->low, first);
    int64_t cell = r->low;
    for (int32_t i = 0; i < WIDTH; ++i) {
        r->at[i] = c->begin[cell];
        cell += cell < c->n_cell && c->key[cell] == first + i ? 1 : 0;
    }
    r->at[WIDTH] = c->begin[cell];
}

/// Squared distances of a point to the cells along one axis, a little less for rounding; part: its
/// place in its own cell.
static void measure_steps(double side, double part, double square[WIDTH])
{
    for (int32_t i = 0; i < WIDTH; ++i) {
        const double step = i - RANGE;
        const double gap = step > 0.0 ? step - part : step < 0.0 ? part - step - 1.0 : 0.0;
        const double length = side * (gap - 1e-6);
        square[i] = length > 0.0 ? length * length : 0.0;
    }
}

/// clx_pair_edge_weight, in a box without a call.
static inline double edge_weight(const clast_domain *d, const double *x, const double *y)
{
    double weight = 1.0;
    if (d->kind != CLAST_DOMAIN_BOX) {
        return clx_pair_edge_weight(d, x, y);
    }
    for (int32_t j = 0; j < d->dimension; ++j) {
        const double image = x[j] + x[j] - y[j];
        weight *= image < d->low[j] || image > d->high[j] ? 2.0 : 1.0;
    }
    return weight;
}

static void weigh_pair(walk *p, int32_t k, double r2)
{
    const job *w = p->job;
    const int32_t shell = shell_of(w, r2);
    double y[3] = {0};
    for (int32_t j = 0; j < w->cells->d; ++j) {
        y[j] = p->lanes.x[j][k];
    }
    const double *x = p->lanes.at;
    const double h = 0.5 * (edge_weight(w->domain, x, y) + edge_weight(w->domain, y, x));
    p->extra[shell] += h - 1.0;
    p->extra2[shell] += h * h - 1.0;
}

/// Compares the point with those from `from` to `to` of the lanes' arrays; self: its own index
/// there.
static void add_points(walk *p, int64_t from, int64_t to, int64_t self, bool any_close)
{
    for (int64_t k = from; k < to; k += CLX_PAIR_PIECE) {
        const int64_t end = to - k < CLX_PAIR_PIECE ? to : k + CLX_PAIR_PIECE;
        clx_pair_lanes_count(&p->lanes,
                             (clx_pair_piece){(int32_t)k, (int32_t)end, any_close, !p->is_far});
        for (int32_t i = 0; i < p->lanes.close.n; ++i) {
            const double r2 = p->lanes.close.r2[i];
            const int32_t other = p->lanes.close.item[i] != self ? 1 : 0;
            p->count[shell_of(p->job, r2)] += other;
            p->repeated += r2 == 0.0 ? other : 0;
        }
        for (int32_t i = 0; i < p->lanes.unsafe.n; ++i) {
            weigh_pair(p, p->lanes.unsafe.item[i], p->lanes.unsafe.r2[i]);
        }
    }
}

/// The points of each row that may be near.
static void add_rows(walk *p)
{
    const clx_pair_cells *c = p->job->cells;
    double gap[3][WIDTH] = {{0}};
    for (int32_t j = 0; j < c->d; ++j) {
        const double part = (p->lanes.at[j] - c->low[j]) / c->side;
        measure_steps(c->side, part - floor(part), gap[j]);
    }
    for (int32_t r = 0; r < p->n_row; ++r) {
        const row *at = &p->rows[r];
        const double across = gap[1][at->step[1] + RANGE] + gap[2][at->step[2] + RANGE];
        const double left = p->job->outer[0] - across;
        const int32_t from = (left <= gap[0][0] ? 1 : 0) + (left <= gap[0][1] ? 1 : 0);
        const int32_t to =
            WIDTH - (left <= gap[0][WIDTH - 1] ? 1 : 0) - (left <= gap[0][WIDTH - 2] ? 1 : 0);
        if (left > 0.0) {
            const int64_t begin = at->at[from];
            for (int32_t j = 0; j < c->d; ++j) {
                p->lanes.x[j] = c->x[j] + begin;
            }
            p->lanes.safe2 = c->safe2 + begin;
            add_points(p, 0, at->at[to] - begin, p->i - begin,
                       across < p->job->outer[CLX_PAIR_OUTER - 1]);
        }
    }
}

/// Products of a point's sums in any two shells; [n_shell] each.
CLX_FOR_EACH_MACHINE
static void add_joint(int32_t n_shell, const double *weight, clx_pair_sum *sum)
{
    for (int32_t k = 0; k < n_shell; ++k) {
        const double own = weight[k];
        for (int32_t l = 0; own > 0.0 && l <= k; ++l) {
            sum[k].joint[l] += own * weight[l];
        }
    }
}

static void gather_point(const walk *p, clx_pair_sum *sum)
{
    double weight[CLAST_MAX_SHELL];
    for (int32_t k = 0; k < p->job->n_shell; ++k) {
        weight[k] = p->count[k] > 0 ? p->count[k] + p->extra[k] : 0.0;
        if (p->count[k] > 0) {
            sum[k].pairs += p->count[k];
            sum[k].squares += (int64_t)p->count[k] * p->count[k];
            sum[k].weight += weight[k];
            sum[k].weight2 += p->count[k] + p->extra2[k];
        }
    }
    add_joint(p->job->n_shell, weight, sum);
}

/// A row's points behind those that are there, and some beyond its end, over which the next row
/// goes.
static void copy_row(walk *p, int64_t begin, int32_t length)
{
    const clx_pair_cells *c = p->job->cells;
    for (int32_t j = 0; j < 4; ++j) {
        const double *from = j == 3 ? c->safe2 : c->x[j];
        for (int32_t i = 0; i < length && from != NULL; i += CLX_PAIR_PAD) {
            memcpy(p->beside[j] + p->n_beside + i, from + begin + i, CLX_PAIR_PAD * sizeof *from);
        }
    }
}

/// The rows of a cell, and their points side by side where there is space for them.
static void enter_cell(walk *p, int64_t cell)
{
    const clx_pair_cells *c = p->job->cells;
    int64_t n = 0;
    for (int32_t r = 0; r < p->n_row; ++r) {
        find_row(c, c->key[cell], &p->rows[r]);
        n += p->rows[r].at[WIDTH] - p->rows[r].at[0];
    }
    p->is_beside = n <= BESIDE;
    if (!p->is_beside) {
        return;
    }
    p->n_beside = p->close_from = p->close_to = 0;
    for (int32_t r = 0; r < p->n_row; ++r) {
        const row *at = &p->rows[r];
        const int64_t begin = at->at[0];
        const int32_t length = (int32_t)(at->at[WIDTH] - begin);
        const bool is_close = abs(at->step[1]) < RANGE && abs(at->step[2]) < RANGE;
        if (at->offset == 0) {
            p->own = p->n_beside + (int32_t)(c->begin[cell] - begin);
        }
        if (is_close && p->close_to == 0) {
            p->close_from = p->n_beside;
        }
        copy_row(p, begin, length);
        p->n_beside += length;
        p->close_to = is_close ? p->n_beside : p->close_to;
    }
}

static void add_point(walk *p, int64_t cell, clx_pair_sum *sum)
{
    const job *w = p->job;
    const clx_pair_cells *c = w->cells;
    const size_t n = (size_t)w->n_shell;
    memset(p->count, 0, n * sizeof *p->count);
    memset(p->extra, 0, n * sizeof *p->extra);
    memset(p->extra2, 0, n * sizeof *p->extra2);
    memset(p->lanes.within, 0, sizeof p->lanes.within);
    p->is_far = c->safe2[p->i] >= 16.0 * c->side * c->side;
    p->lanes.own_safe2 = c->safe2[p->i];
    for (int32_t j = 0; j < c->d; ++j) {
        p->lanes.at[j] = c->x[j][p->i];
        p->lanes.x[j] = p->beside[j];
    }
    p->lanes.safe2 = p->beside[3];
    if (p->is_beside) {
        const int64_t self = p->own + p->i - c->begin[cell];
        add_points(p, 0, p->close_from, self, false);
        add_points(p, p->close_from, p->close_to, self, true);
        add_points(p, p->close_to, p->n_beside, self, false);
    } else {
        add_rows(p);
    }
    for (int32_t j = 0; j + 1 < CLX_PAIR_OUTER && j < w->n_shell; ++j) {
        p->count[w->n_shell - 1 - j] += (int32_t)(p->lanes.within[j] - p->lanes.within[j + 1]);
    }
    gather_point(p, sum);
}

static void sum_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const job *w = context;
    const clx_pair_cells *c = w->cells;
    walk p;
    (void)worker;
    for (int64_t b = begin; b < end; ++b) {
        memset(&p, 0, sizeof p);
        p.job = w;
        p.n_row = make_rows(c, p.rows);
        p.lanes.d = c->d;
        memcpy(p.lanes.outer, w->outer, sizeof p.lanes.outer);
        const int64_t last = first_cell(c, w->key[b + 1]);
        for (int64_t cell = first_cell(c, w->key[b]); cell < last; ++cell) {
            enter_cell(&p, cell);
            for (p.i = c->begin[cell]; p.i < c->begin[cell + 1]; ++p.i) {
                add_point(&p, cell, w->sum + b * w->n_shell);
            }
        }
        w->repeated[b] = p.repeated;
    }
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
        const double safe = clx_pair_edge_safe(w->domain, x, 4.0 * w->cells->side);
        w->cells->safe2[i] = safe > 0.0 ? safe * safe : 0.0;
    }
}

clast_status clx_pair_cells_sum(clx_pair_cells *cells, const clast_domain *domain, int32_t n_shell,
                                const double *radius, clx_pair_blocks block)
{
    clast_status status = CLAST_OK;
    job w = {.cells = cells,
             .domain = domain,
             .n_shell = n_shell,
             .key = block.first,
             .sum = block.sum,
             .repeated = block.n_repeated};
    for (int32_t k = 0; k < n_shell; ++k) {
        w.square[k] = radius[k] * radius[k];
    }
    fill_outer(&w);
    fill_table(&w);
    CLX_TRY(clx_alloc(&cells->safe2, cells->n + CLX_PAIR_PAD, sizeof *cells->safe2));
    clx_parallel_for(cells->n, CHUNK, measure_safe, &w);
    clx_parallel_for(block.n, 1, sum_block, &w);
done:
    return status;
}
