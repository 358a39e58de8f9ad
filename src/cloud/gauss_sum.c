// Pair sums of a Gaussian: plain, and by splines on a grid.
#include "cloud/gauss_sum.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "cloud/gauss_beyond.h"
#include "math/fixed_sum.h"
#include "math/sort.h"
#include <clast/machine.h>
#include <clast/status.h>
#include <math.h>
#include <string.h>

enum {
    ROWS_A_BLOCK = 64,
    POINTS_A_BLOCK = 16384,
    NODES_A_BLOCK = 65536,
    HALF_WIDTH = 26, ///< kernel coefficients kept on each side
    SYSTEM = 40,     ///< half-size of the system that finds them
    CHUNK = 1 << 20, ///< points that are put in order at once
    TILE = 64,       ///< lines that are convolved side by side
    PLANES = 16,     ///< slabs of axis 0 that are convolved at once
    GROUP = 8,  ///< slabs of axis 0 a task spreads; at least 4, so that only neighbours overlap
    MARGIN = 2, ///< nodes beyond the outermost points
    LEAST_NODES = 1 << 21, ///< that a grid may have, whatever the points
    NODES_A_POINT = 8      ///< and beside them
};
static const double SPACING = 1.0 / 3.0; ///< times 1 / beta

typedef struct {
    const double *y;
    int64_t n;
    int32_t d;
    double half_beta2;
    double *block;
} pair_context;

static void sum_rows(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const pair_context *c = context;
    double sum = 0.0;
    (void)worker;
    for (int64_t k = begin; k < end; ++k) {
        for (int64_t l = 0; l < k; ++l) {
            double r2 = 0.0;
            for (int32_t j = 0; j < c->d; ++j) {
                const double r = c->y[k * c->d + j] - c->y[l * c->d + j];
                r2 += r * r;
            }
            sum += exp(-c->half_beta2 * r2);
        }
    }
    c->block[begin / ROWS_A_BLOCK] = sum;
}

clast_status clx_gauss_sum_exact(const double *y, int64_t n, int32_t d, double beta, double *sum)
{
    clast_status status = CLAST_OK;
    const int64_t n_block = (n + ROWS_A_BLOCK - 1) / ROWS_A_BLOCK;
    pair_context context = {y, n, d, 0.5 * beta * beta, NULL};
    CLX_TRY(clx_alloc(&context.block, n_block, sizeof *context.block));
    clx_parallel_for(n, ROWS_A_BLOCK, sum_rows, &context);
    *sum = 0.0;
    for (int64_t b = 0; b < n_block; ++b) {
        *sum += context.block[b];
    }
    *sum = 2.0 * *sum + (double)n;
done:
    clx_free(context.block);
    return status;
}

/// Coefficients c with sum_m c_m B7(i - m) = exp(-(spacing i)^2 / 2) at the nodes: Gaussian
/// elimination on the banded system with the values of the septic B-spline, 2416, 1191, 120 and 1
/// over 5040.
static void kernel_coefficients(double kernel[HALF_WIDTH + 1])
{
    enum { N = 2 * SYSTEM + 1 };
    static const double spline[4] = {2416.0 / 5040, 1191.0 / 5040, 120.0 / 5040, 1.0 / 5040};
    double a[N][7];
    double b[N];
    for (int i = 0; i < N; ++i) {
        for (int k = 0; k < 7; ++k) {
            const int column = i + k - 3;
            a[i][k] = column >= 0 && column < N ? spline[k < 3 ? 3 - k : k - 3] : 0.0;
        }
        b[i] = exp(-0.5 * SPACING * SPACING * (i - SYSTEM) * (i - SYSTEM));
    }
    for (int i = 0; i < N; ++i) {
        for (int row = i + 1; row < N && row <= i + 3; ++row) {
            const double factor = a[row][3 - (row - i)] / a[i][3];
            for (int k = 3; k < 7; ++k) {
                a[row][k - (row - i)] -= factor * a[i][k];
            }
            b[row] -= factor * b[i];
        }
    }
    for (int i = N - 1; i >= 0; --i) {
        for (int k = 1; k <= 3 && i + k < N; ++k) {
            b[i] -= a[i][3 + k] * b[i + k];
        }
        b[i] /= a[i][3];
    }
    memcpy(kernel, b + SYSTEM, (HALF_WIDTH + 1) * sizeof *kernel);
}

typedef struct {
    const double *y; ///< of the chunk
    int64_t n;
    int32_t d;
    double h;
    double unit;       ///< nodes are counted in 1 / unit
    double low[3];     ///< of node 0
    double end[3][2];  ///< of the points that are on the grid
    bool is_cut[3][2]; ///< whether there are points beyond that end
    bool is_whole;     ///< there are none, at no end
    int64_t nodes[3];  ///< along each axis, 1 beyond d
    int64_t size;
    int64_t *count;   ///< [size] of this rank's points, then of all
    double *node;     ///< [size] what was counted, in its memory, on rank 0
    int64_t *start;   ///< [nodes[0] + 1] points by slab of axis 0
    clx_keyed *order; ///< [CHUNK] points by column
    double kernel[HALF_WIDTH + 1];
} grid;

/// Cell of a coordinate and the four cubic B-spline weights of the nodes cell - 1 .. cell + 2.
static int64_t spline_weights(const grid *g, double x, int32_t axis, double weight[4])
{
    CLAST_ASSERT(axis >= 0 && axis < g->d);
    const double at = (x - g->low[axis]) / g->h;
    const double cell = floor(at);
    const double t = at - cell;
    const double s = 1.0 - t;
    weight[0] = s * s * s / 6.0;
    weight[1] = (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0;
    weight[2] = (4.0 - 6.0 * s * s + 3.0 * s * s * s) / 6.0;
    weight[3] = t * t * t / 6.0;
    return (int64_t)cell;
}

static void spread_point(grid *g, const double *x)
{
    double w[3][4] = {{1.0}, {1.0}, {1.0}};
    int64_t first[3] = {0, 0, 0};
    int width[3] = {1, 1, 1};
    for (int32_t j = 0; j < g->d; ++j) {
        first[j] = spline_weights(g, x[j], j, w[j]) - 1;
        width[j] = 4;
    }
    for (int a = 0; a < width[0]; ++a) {
        for (int b = 0; b < width[1]; ++b) {
            int64_t *row =
                g->count + ((first[0] + a) * g->nodes[1] + first[1] + b) * g->nodes[2] + first[2];
            const double both = w[0][a] * w[1][b] * g->unit;
            for (int c = 0; c < width[2]; ++c) {
                row[c] += (int64_t)(both * w[2][c] + 0.5);
            }
        }
    }
}

typedef struct {
    grid *g;
    int parity; ///< groups 2 i + parity
} colour;

static void spread_groups(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const colour *c = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        const int64_t slab = (2 * i + c->parity) * GROUP;
        const int64_t last = slab + GROUP < c->g->nodes[0] ? slab + GROUP : c->g->nodes[0];
        for (int64_t p = slab < last ? c->g->start[slab] : 0; slab < last && p < c->g->start[last];
             ++p) {
            spread_point(c->g, c->g->y + (int64_t)c->g->order[p].item * c->g->d);
        }
    }
}

/// Column of a point: its slabs of axis 0 and, in more dimensions, axis 1.
static int64_t column_of(const grid *g, int64_t i)
{
    double unused[4];
    const double *y = g->y + i * g->d;
    const int64_t slab = spline_weights(g, y[0], 0, unused);
    return g->d > 1 ? slab * g->nodes[1] + spline_weights(g, y[1], 1, unused) : slab;
}

static bool is_on_grid(const grid *g, const double *y)
{
    bool is_on = true;
    for (int32_t j = 0; j < g->d; ++j) {
        is_on = is_on && y[j] >= g->end[j][0] && y[j] <= g->end[j][1];
    }
    return is_on;
}

static uint64_t column_width(const grid *g)
{
    return g->d > 1 ? (uint64_t)g->nodes[1] : 1;
}

/// Points beyond the grid come last, behind its last slab.
static void take_columns(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const grid *g = context;
    const uint64_t beyond = (uint64_t)g->nodes[0] * column_width(g);
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        const bool is_on = is_on_grid(g, g->y + i * g->d);
        g->order[i] = (clx_keyed){is_on ? (uint64_t)column_of(g, i) : beyond, (uint64_t)i};
    }
}

/// Points by column, so that neighbours on the grid follow each other; in index order within one.
static clast_status sort_by_column(grid *g)
{
    const uint64_t width = column_width(g);
    clx_parallel_for(g->n, POINTS_A_BLOCK, take_columns, g);
    const clast_status status = clx_sort_keyed(g->order, g->n);
    int64_t at = 0;
    for (int64_t slab = 0; slab <= g->nodes[0]; ++slab) { // first point at or behind the slab
        int64_t end = g->n;
        while (at < end) {
            const int64_t middle = at + (end - at) / 2;
            if (g->order[middle].key < (uint64_t)slab * width) {
                at = middle + 1;
            } else {
                end = middle;
            }
        }
        g->start[slab] = at;
    }
    return status;
}

enum { N_SPAN = 64 };

/// Least and greatest coordinates of N_SPAN stretches of points.
typedef struct {
    const clx_part *part;
    double low[N_SPAN][3], high[N_SPAN][3];
} spans;

static void take_spans(int64_t begin, int64_t end, int32_t worker, void *context)
{
    spans *s = context;
    const clx_part *part = s->part;
    double held[3];
    (void)worker;
    for (int64_t span = begin; span < end; ++span) {
        for (int32_t j = 0; j < part->d; ++j) {
            s->low[span][j] = (double)INFINITY;
            s->high[span][j] = -(double)INFINITY;
        }
        for (int64_t i = part->n * span / N_SPAN; i < part->n * (span + 1) / N_SPAN; ++i) {
            const double *y = clx_part_point(part, i, held);
            for (int32_t j = 0; j < part->d; ++j) {
                s->low[span][j] = y[j] < s->low[span][j] ? y[j] : s->low[span][j];
                s->high[span][j] = y[j] > s->high[span][j] ? y[j] : s->high[span][j];
            }
        }
    }
}

/// Least and greatest coordinates of all ranks' points.
static void find_ends(const clx_part *part, double low[3], double high[3])
{
    spans s = {.part = part};
    clx_parallel_for(N_SPAN, 1, take_spans, &s);
    for (int32_t j = 0; j < part->d; ++j) {
        low[j] = s.low[0][j];
        high[j] = s.high[0][j];
        for (int span = 1; span < N_SPAN; ++span) {
            low[j] = fmin(low[j], s.low[span][j]);
            high[j] = fmax(high[j], s.high[span][j]);
        }
        low[j] = clx_comm_least(part->comm, low[j]);
        high[j] = -clx_comm_least(part->comm, -high[j]);
    }
}

/// A grid over the points whose coordinates are at most `half` from 0; whether it has at most so
/// many nodes.
static bool try_grid(grid *g, const double low[3], const double high[3], double half, int64_t most)
{
    double size = 1.0;
    for (int32_t j = 0; j < 3; ++j) {
        g->low[j] = 0.0;
        g->nodes[j] = 1;
        if (j < g->d) {
            g->is_cut[j][0] = low[j] < -half;
            g->is_cut[j][1] = high[j] > half;
            g->end[j][0] = fmax(low[j], -half);
            g->end[j][1] = fmin(high[j], half);
            g->low[j] = g->end[j][0] - MARGIN * g->h;
            g->nodes[j] = (int64_t)ceil((g->end[j][1] - g->low[j]) / g->h) + MARGIN + 1;
        }
        size *= (double)g->nodes[j];
    }
    g->size = size <= (double)most ? (int64_t)size : 0;
    return g->size > 0;
}

/// The grid over all points where that is not much larger than they are many; else over those about
/// the centre. White coordinates have the mean 0 and the variance 1, so that by Chebyshev's
/// inequality a few per cent lie beyond at the most.
static clast_status lay_grid(const clx_part *part, grid *g)
{
    clast_status status = CLAST_OK;
    double low[3] = {0};
    double high[3] = {0};
    const int64_t most_nodes = LEAST_NODES + NODES_A_POINT * part->n_all;
    find_ends(part, low, high);
    g->is_whole = try_grid(g, low, high, (double)INFINITY, most_nodes);
    if (!g->is_whole) {
        int64_t fits = 0; // half a width in nodes
        int64_t too_wide = most_nodes;
        while (too_wide - fits > 1) {
            const int64_t middle = fits + (too_wide - fits) / 2;
            const bool is_small = try_grid(g, low, high, (double)middle * g->h, most_nodes);
            fits = is_small ? middle : fits;
            too_wide = is_small ? too_wide : middle;
        }
        (void)try_grid(g, low, high, (double)fits * g->h, most_nodes);
    }
    const int64_t most = part->n < CHUNK ? part->n : CHUNK;
    status = clx_alloc(&g->count, g->size, sizeof *g->count);
    if (status == CLAST_OK) {
        status = clx_alloc(&g->start, g->nodes[0] + 1, sizeof *g->start);
    }
    if (status == CLAST_OK) {
        status = clx_alloc(&g->order, most, sizeof *g->order);
    }
    CLX_TRY(clast_comm_agree(part->comm, status, NULL));
done:
    return status;
}

/// Nodes along an axis across which the memory runs.
typedef struct {
    const double *kernel;
    const double *from; ///< node 0 of the first of neighbouring lines
    int64_t length, stride;
} lines;

/// Node i of `width` neighbouring lines, at most TILE.
static void convolve_node(const lines *c, int64_t i, int64_t width, double *to)
{
    static const double zero[TILE] = {0};
    double sum[TILE];
    for (int64_t l = 0; l < width; ++l) {
        sum[l] = c->kernel[0] * c->from[i * c->stride + l];
    }
    for (int64_t m = 1; m <= HALF_WIDTH; ++m) {
        const double *left = i >= m ? c->from + (i - m) * c->stride : zero;
        const double *right = i + m < c->length ? c->from + (i + m) * c->stride : zero;
        for (int64_t l = 0; l < width; ++l) {
            sum[l] += c->kernel[m] * (left[l] + right[l]);
        }
    }
    memcpy(to, sum, (size_t)width * sizeof *sum);
}

/// Slabs first .. first + n - 1 of K g.
typedef struct {
    const grid *g;
    int64_t first, n;
    int64_t plane;      ///< nodes of a slab
    double *to, *other; ///< [PLANES][plane]; what is convolved lies in `to`
    double *padded;     ///< a row between zeros for each worker
} batch;

/// Along axis 0: TILE nodes of all slabs at a time.
static void convolve_slabs(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const batch *b = context;
    (void)worker;
    for (int64_t tile = begin; tile < end; ++tile) {
        const int64_t first = tile * TILE;
        const int64_t width = b->plane - first < TILE ? b->plane - first : TILE;
        const lines c = {b->g->kernel, b->g->node + first, b->g->nodes[0], b->plane};
        for (int64_t k = 0; k < b->n; ++k) {
            convolve_node(&c, b->first + k, width, b->to + k * b->plane + first);
        }
    }
}

/// Along axis 1 of a grid in space, from `from` to `to`.
static void convolve_columns(const grid *g, const double *from, double *to)
{
    const int64_t stride = g->nodes[2];
    for (int64_t first = 0; first < stride; first += TILE) {
        const int64_t width = stride - first < TILE ? stride - first : TILE;
        const lines c = {g->kernel, from + first, g->nodes[1], stride};
        for (int64_t i = 0; i < c.length; ++i) {
            convolve_node(&c, i, width, to + i * stride + first);
        }
    }
}

/// Lines along the memory: copied between zeros, so that every node has all its neighbours.
static void convolve_rows(const grid *g, int64_t n, int64_t length, double *padded, double *row)
{
    for (; n > 0; --n, row += length) {
        memcpy(padded + HALF_WIDTH, row, (size_t)length * sizeof *row);
        for (int64_t i = 0; i < length; ++i) {
            row[i] = g->kernel[0] * padded[HALF_WIDTH + i];
        }
        for (int64_t m = 1; m <= HALF_WIDTH; ++m) {
            const double weight = g->kernel[m];
            const double *left = padded + HALF_WIDTH - m;
            const double *right = padded + HALF_WIDTH + m;
            for (int64_t i = 0; i < length; ++i) {
                row[i] += weight * (left[i] + right[i]);
            }
        }
    }
}

/// Along axes 1 and 2, slab by slab.
static void convolve_within(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const batch *b = context;
    const grid *g = b->g;
    const int64_t length = g->nodes[g->d - 1];
    double *padded = b->padded + worker * (length + 2 * HALF_WIDTH);
    for (int64_t k = begin; k < end; ++k) {
        double *slab = b->to + k * b->plane;
        if (g->d == 3) {
            double *held = b->other + k * b->plane;
            memcpy(held, slab, (size_t)b->plane * sizeof *slab);
            convolve_columns(g, held, slab);
        }
        convolve_rows(g, b->plane / length, length, padded, slab);
    }
}

/// (g, K g), added in the order of the nodes, with room for some slabs of K g alone.
static clast_status quadratic_form(const grid *g, double *sum)
{
    clast_status status = CLAST_OK;
    batch b = {.g = g, .plane = g->size / g->nodes[0]};
    const int64_t length = g->nodes[g->d - 1] + 2 * HALF_WIDTH;
    CLX_TRY(clx_alloc(&b.to, PLANES * b.plane, sizeof *b.to));
    CLX_TRY(clx_alloc(&b.other, g->d == 3 ? PLANES * b.plane : 0, sizeof *b.other));
    CLX_TRY(clx_alloc(&b.padded, clx_parallel_workers() * length, sizeof *b.padded));
    *sum = 0.0;
    for (; b.first < g->nodes[0]; b.first += PLANES) {
        b.n = g->nodes[0] - b.first < PLANES ? g->nodes[0] - b.first : PLANES;
        clx_parallel_for((b.plane + TILE - 1) / TILE, 4, convolve_slabs, &b);
        if (g->d > 1) {
            clx_parallel_for(b.n, 1, convolve_within, &b);
        }
        for (int64_t i = 0; i < b.n * b.plane; ++i) {
            *sum += g->node[b.first * b.plane + i] * b.to[i];
        }
    }
done:
    CLX_FREE(b.to, b.other, b.padded);
    return status;
}

/// Points [..][d] that are put aside, some here, then of all ranks.
typedef struct {
    double *y;
    int64_t n, capacity;
} aside;

static clast_status put_aside(const double *y, int32_t d, aside *to)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_grow(&to->y, &to->capacity, (to->n + 1) * d, sizeof *to->y));
    memcpy(to->y + to->n * d, y, (size_t)d * sizeof *y);
    ++to->n;
done:
    return status;
}

/// Further apart the kernel has no coefficients, and the Gaussian is below 1e-16.
static double cutoff_of(const grid *g)
{
    return HALF_WIDTH * g->h;
}

/// Whether a point on the grid may have neighbours beyond it.
static bool is_at_edge(const grid *g, const double *y)
{
    bool is_near = false;
    for (int32_t j = 0; j < g->d; ++j) {
        is_near = is_near || (g->is_cut[j][0] && y[j] < g->end[j][0] + cutoff_of(g)) ||
                  (g->is_cut[j][1] && y[j] > g->end[j][1] - cutoff_of(g));
    }
    return is_near;
}

/// Of the chunk, the points beyond the grid, [0], and those on it that may be their neighbours.
static clast_status sort_out(const grid *g, aside list[2])
{
    clast_status status = CLAST_OK;
    for (int64_t i = 0; i < g->n && !g->is_whole; ++i) {
        const double *y = g->y + i * g->d;
        const bool is_on = is_on_grid(g, y);
        if (!is_on || is_at_edge(g, y)) {
            CLX_TRY(put_aside(y, g->d, &list[is_on ? 1 : 0]));
        }
    }
done:
    return status;
}

/// Sum over the pairs of all ranks' points with those beyond the grid, on rank 0.
static clast_status sum_beyond(const clx_part *part, const grid *g, double beta,
                               const aside list[2], double *sum)
{
    clast_status status = CLAST_OK;
    const size_t bytes = (size_t)g->d * sizeof(double);
    clx_gathered all[2] = {{0}, {0}};
    double *y = NULL;
    for (int k = 0; k < 2; ++k) {
        CLX_TRY(clx_comm_gather(part->comm, list[k].y, list[k].n * (int64_t)bytes, &all[k]));
    }
    const int64_t n = (all[0].n + all[1].n) / (int64_t)bytes;
    CLX_TRY(clx_alloc(&y, n * g->d, sizeof *y));
    for (int k = 0; k < 2; ++k) {
        if (all[k].n > 0) {
            memcpy((char *)y + (k > 0 ? all[0].n : 0), all[k].bytes, (size_t)all[k].n);
        }
    }
    const clx_gauss_beyond points = {g->d, all[0].n / (int64_t)bytes, n, y, beta, cutoff_of(g)};
    CLX_TRY(clx_gauss_sum_beyond(&points, sum));
done:
    clx_gathered_free(&all[0]);
    clx_gathered_free(&all[1]);
    clx_free(y);
    return status;
}

/// Spreads this rank's points, chunk by chunk, and puts aside those that the grid does not serve.
static clast_status spread(const clx_part *part, grid *g, aside list[2])
{
    clast_status status = CLAST_OK;
    double *made = NULL;
    if (part->u == NULL) {
        CLX_TRY(clx_alloc(&made, (part->n < CHUNK ? part->n : CHUNK) * g->d, sizeof *made));
    }
    for (int64_t at = 0; at < part->n; at += CHUNK) {
        g->n = part->n - at < CHUNK ? part->n - at : CHUNK;
        g->y = part->u != NULL ? part->u + at * g->d : made;
        if (made != NULL) {
            clx_part_copy(part, at, g->n, made);
        }
        CLX_TRY(sort_by_column(g));
        CLX_TRY(sort_out(g, list));
        for (int parity = 0; parity < 2; ++parity) {
            colour c = {g, parity};
            clx_parallel_for((g->nodes[0] + 2 * GROUP - 1) / (2 * GROUP), 1, spread_groups, &c);
        }
    }
done:
    clx_free(made);
    return status;
}

/// What was counted as numbers, in the same memory.
static void take_nodes(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const grid *g = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        const double value = (double)g->count[i] / g->unit;
        memcpy(g->count + i, &value, sizeof value);
    }
}

/// The quadratic form of all ranks' nodes, on rank 0.
static clast_status evaluate(grid *g, double *sum)
{
    clx_parallel_for(g->size, NODES_A_BLOCK, take_nodes, g);
    g->node = (void *)g->count;
    g->count = NULL;
    return quadratic_form(g, sum);
}

clast_status clx_gauss_sum_gridded(const clx_part *part, double beta, double *sum)
{
    CLAST_ASSERT(part->n_all > 0 && part->d >= 1 && part->d <= 3 && beta > 0.0);
    clast_status status = CLAST_OK;
    grid g = {.d = part->d, .h = SPACING / beta, .unit = clx_fixed_unit(part->n_all)};
    aside list[2] = {{0}, {0}};
    double beyond = 0.0;
    kernel_coefficients(g.kernel);
    CLX_TRY(lay_grid(part, &g));
    CLX_TRY(clast_comm_agree(part->comm, spread(part, &g, list), NULL));
    clx_free(g.order);
    g.order = NULL;
    clx_comm_sum(part->comm, g.count, g.size);
    if (part->comm->rank > 0) {
        clx_free(g.count);
        g.count = NULL;
    }
    status = part->comm->rank == 0 ? evaluate(&g, sum) : CLAST_OK;
    CLX_TRY(clast_comm_agree(part->comm, status, NULL));
    CLX_TRY(clast_comm_agree(part->comm, sum_beyond(part, &g, beta, list, &beyond), NULL));
    *sum += beyond;
    part->comm->broadcast(part->comm->context, 0, sum, (int64_t)sizeof *sum);
done:
    CLX_FREE(g.count, g.node, g.start, g.order, list[0].y, list[1].y);
    return status;
}
