// Pair sums of a Gaussian: plain, and by splines on a grid.
#include "cloud/gauss_sum.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "math/sort.h"
#include <clast/machine.h>
#include <clast/status.h>
#include <math.h>
#include <string.h>

enum {
    ROWS_A_BLOCK = 64,
    POINTS_A_BLOCK = 16384,
    HALF_WIDTH = 26, ///< kernel coefficients kept on each side
    SYSTEM = 40,     ///< half-size of the system that finds them
    CHUNK = 1 << 20, ///< points that are put in order at once
    TILE = 64,       ///< lines that are convolved side by side
    GROUP = 8, ///< slabs of axis 0 a task spreads; at least 4, so that only neighbours overlap
    MARGIN = 2 ///< nodes beyond the outermost points
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
    double unit;      ///< nodes are counted in 1 / unit
    double low[3];    ///< of node 0
    int64_t nodes[3]; ///< along each axis, 1 beyond d
    int64_t size;
    int64_t *count;       ///< [size] of this rank's points, then of all
    double *node, *other; ///< [size], on rank 0
    int64_t *start;       ///< [nodes[0] + 1] points by slab of axis 0
    clx_keyed *order;     ///< [CHUNK] points by column
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

static void take_columns(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const grid *g = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        g->order[i] = (clx_keyed){(uint64_t)column_of(g, i), (uint64_t)i};
    }
}

/// Points by column, so that neighbours on the grid follow each other; in index order within one.
static clast_status sort_by_column(grid *g)
{
    const uint64_t width = g->d > 1 ? (uint64_t)g->nodes[1] : 1;
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
    const grid *g;
    double low[N_SPAN][3], high[N_SPAN][3];
} spans;

static void take_spans(int64_t begin, int64_t end, int32_t worker, void *context)
{
    spans *s = context;
    const int32_t d = s->g->d;
    (void)worker;
    for (int64_t span = begin; span < end; ++span) {
        for (int32_t j = 0; j < d; ++j) {
            s->low[span][j] = s->g->y[j];
            s->high[span][j] = s->g->y[j];
        }
        for (int64_t i = s->g->n * span / N_SPAN; i < s->g->n * (span + 1) / N_SPAN; ++i) {
            for (int32_t j = 0; j < d; ++j) {
                const double y = s->g->y[i * d + j];
                s->low[span][j] = y < s->low[span][j] ? y : s->low[span][j];
                s->high[span][j] = y > s->high[span][j] ? y : s->high[span][j];
            }
        }
    }
}

/// Least and greatest coordinates of all ranks' points.
static void find_ends(const clx_part *part, grid *g, double low[3], double high[3])
{
    spans s = {.g = g};
    if (part->n > 0) {
        clx_parallel_for(N_SPAN, 1, take_spans, &s);
    }
    for (int32_t j = 0; j < g->d; ++j) {
        low[j] = part->n > 0 ? s.low[0][j] : (double)INFINITY;
        high[j] = part->n > 0 ? s.high[0][j] : -(double)INFINITY;
        for (int span = 1; span < N_SPAN && part->n > 0; ++span) {
            low[j] = fmin(low[j], s.low[span][j]);
            high[j] = fmax(high[j], s.high[span][j]);
        }
        low[j] = clx_comm_least(part->comm, low[j]);
        high[j] = -clx_comm_least(part->comm, -high[j]);
    }
}

static clast_status lay_grid(const clx_part *part, grid *g)
{
    clast_status status = CLAST_OK;
    double low[3] = {0};
    double high[3] = {0};
    g->size = 1;
    find_ends(part, g, low, high);
    for (int32_t j = 0; j < 3; ++j) {
        g->low[j] = 0.0;
        g->nodes[j] = 1;
        if (j < g->d) {
            g->low[j] = low[j] - MARGIN * g->h;
            g->nodes[j] = (int64_t)ceil((high[j] - g->low[j]) / g->h) + MARGIN + 1;
        }
        g->size *= g->nodes[j];
        CLX_CHECK(g->size <= INT64_C(1) << 31, CLAST_E_LIMIT,
                  "the grid of the Henze-Zirkler test needs more than 2^31 nodes");
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

typedef struct {
    const grid *g;
    const double *from;
    double *to;
    int64_t length, stride; ///< of a line along the axis
    const double *zero;     ///< [TILE] zeros
    double *padded;         ///< a row between zeros for each worker
} convolution;

/// One output node of `width` neighbouring lines, whose nodes lie side by side.
static void convolve_node(const convolution *c, int64_t start, int64_t i, int64_t width)
{
    const double *kernel = c->g->kernel;
    const double *from = c->from + start;
    double sum[TILE];
    for (int64_t l = 0; l < width; ++l) {
        sum[l] = kernel[0] * from[i * c->stride + l];
    }
    for (int64_t m = 1; m <= HALF_WIDTH; ++m) {
        const double *left = i >= m ? from + (i - m) * c->stride : c->zero;
        const double *right = i + m < c->length ? from + (i + m) * c->stride : c->zero;
        for (int64_t l = 0; l < width; ++l) {
            sum[l] += kernel[m] * (left[l] + right[l]);
        }
    }
    memcpy(c->to + start + i * c->stride, sum, (size_t)width * sizeof *sum);
}

/// Lines across which the memory runs, TILE of them at a time.
static void convolve_tiles(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const convolution *c = context;
    const int64_t n_tile = (c->stride + TILE - 1) / TILE;
    (void)worker;
    for (int64_t tile = begin; tile < end; ++tile) {
        const int64_t first = tile % n_tile * TILE;
        const int64_t width = c->stride - first < TILE ? c->stride - first : TILE;
        for (int64_t i = 0; i < c->length; ++i) {
            convolve_node(c, tile / n_tile * c->stride * c->length + first, i, width);
        }
    }
}

/// Lines along the memory: copied between zeros, so that every node has all its neighbours.
static void convolve_rows(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const convolution *c = context;
    double *padded = c->padded + worker * (c->length + 2 * HALF_WIDTH);
    for (int64_t row = begin; row < end; ++row) {
        double *to = c->to + row * c->length;
        memcpy(padded + HALF_WIDTH, c->from + row * c->length, (size_t)c->length * sizeof *padded);
        for (int64_t i = 0; i < c->length; ++i) {
            to[i] = c->g->kernel[0] * padded[HALF_WIDTH + i];
        }
        for (int64_t m = 1; m <= HALF_WIDTH; ++m) {
            const double weight = c->g->kernel[m];
            const double *left = padded + HALF_WIDTH - m;
            const double *right = padded + HALF_WIDTH + m;
            for (int64_t i = 0; i < c->length; ++i) {
                to[i] += weight * (left[i] + right[i]);
            }
        }
    }
}

static clast_status convolve(convolution *c)
{
    clast_status status = CLAST_OK;
    if (c->stride == 1) {
        CLX_TRY(clx_alloc(&c->padded, clx_parallel_workers() * (c->length + 2 * HALF_WIDTH),
                          sizeof *c->padded));
        clx_parallel_for(c->g->size / c->length, 16, convolve_rows, c);
    } else {
        const int64_t n_tile = (c->stride + TILE - 1) / TILE;
        clx_parallel_for(c->g->size / (c->length * c->stride) * n_tile, 1, convolve_tiles, c);
    }
done:
    clx_free(c->padded);
    return status;
}

/// (g, K g): one axis at a time; the last axis is needed only as a sum.
static clast_status quadratic_form(grid *g, double *sum)
{
    clast_status status = CLAST_OK;
    double *spare = NULL;
    double *from = g->node;
    double *to = g->other;
    int64_t stride = g->size;
    const double zero[TILE] = {0};
    CLX_TRY(clx_alloc(&spare, g->d > 1 ? g->size : 1, sizeof *spare));
    for (int32_t j = 0; j < g->d; ++j) {
        stride /= g->nodes[j];
        convolution c = {g, from, to, g->nodes[j], stride, zero, NULL};
        CLX_TRY(convolve(&c));
        from = to;
        to = to == g->other ? spare : g->other;
    }
    *sum = 0.0;
    for (int64_t i = 0; i < g->size; ++i) {
        *sum += g->node[i] * from[i];
    }
done:
    clx_free(spare);
    return status;
}

/// Spreads this rank's points, chunk by chunk.
static clast_status spread(const clx_part *part, grid *g)
{
    clast_status status = CLAST_OK;
    for (int64_t at = 0; at < part->n; at += CHUNK) {
        g->y = part->u + at * g->d;
        g->n = part->n - at < CHUNK ? part->n - at : CHUNK;
        CLX_TRY(sort_by_column(g));
        for (int parity = 0; parity < 2; ++parity) {
            colour c = {g, parity};
            clx_parallel_for((g->nodes[0] + 2 * GROUP - 1) / (2 * GROUP), 1, spread_groups, &c);
        }
    }
done:
    return status;
}

/// The quadratic form of all ranks' nodes, on rank 0.
static clast_status evaluate(grid *g, double *sum)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&g->node, g->size, sizeof *g->node));
    for (int64_t i = 0; i < g->size; ++i) {
        g->node[i] = (double)g->count[i] / g->unit;
    }
    clx_free(g->count);
    g->count = NULL;
    CLX_TRY(clx_alloc(&g->other, g->size, sizeof *g->other));
    CLX_TRY(quadratic_form(g, sum));
done:
    return status;
}

/// A power of two that lets n weights of at most 1 be added in 62 bits.
static double unit_of(int64_t n)
{
    int bits = 0;
    while (n >> bits > 0) {
        ++bits;
    }
    return ldexp(1.0, 62 - bits);
}

clast_status clx_gauss_sum_gridded(const clx_part *part, double beta, double *sum)
{
    CLAST_ASSERT(part->n_all > 0 && part->d >= 1 && part->d <= 3 && beta > 0.0);
    clast_status status = CLAST_OK;
    grid g = {.y = part->u,
              .n = part->n,
              .d = part->d,
              .h = SPACING / beta,
              .unit = unit_of(part->n_all)};
    kernel_coefficients(g.kernel);
    CLX_TRY(lay_grid(part, &g));
    CLX_TRY(clast_comm_agree(part->comm, spread(part, &g), NULL));
    clx_free(g.order);
    g.order = NULL;
    clx_comm_sum(part->comm, g.count, g.size);
    if (part->comm->rank > 0) {
        clx_free(g.count);
        g.count = NULL;
    }
    status = part->comm->rank == 0 ? evaluate(&g, sum) : CLAST_OK;
    CLX_TRY(clast_comm_agree(part->comm, status, NULL));
    part->comm->broadcast(part->comm->context, 0, sum, (int64_t)sizeof *sum);
done:
    clx_free(g.count);
    clx_free(g.node);
    clx_free(g.other);
    clx_free(g.start);
    clx_free(g.order);
    return status;
}
