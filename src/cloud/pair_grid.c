// Binned pair sums: per cell of a regular grid the multilinear moments prod_j {1, y_j}, and along
// each axis the pair factors as a matrix on those moments that prefix sums apply in one pass.
//
// Exact for pairs in different slabs of every axis (with an even grid |y - 1/2| is linear in a
// slab); inside a slab |x - y| is replaced by its mean h/3. [docs/theory/uniformity.md]
#include "cloud/pair_sums.h"

#include "base/alloc.h"
#include "base/comm.h"
#include "base/parallel.h"
#include "cloud/part.h"
#include "math/exact_sum.h"
#include "math/fixed_sum.h"
#include <clast/machine.h>
#include <math.h>
#include <string.h>

enum { MOST_CHUNK = 8, DENSE = 1000000 };

/// Tensors filled side by side: more for many points, one a thread.
static int n_chunk_of(int64_t n)
{
    const int32_t n_worker = clx_parallel_workers();
    return n < DENSE || n_worker < 2 ? 1 : n_worker < MOST_CHUNK ? n_worker : MOST_CHUNK;
}

static int32_t cells_an_axis(int32_t d)
{
    CLAST_ASSERT(d >= 1 && d <= 3);
    return d == 1 ? 65536 : d == 2 ? 512 : 64;
}

typedef struct {
    const clx_part *points;
    int64_t n, size; ///< points; moments in the tensor, (2 G)^d
    int32_t d, g;
    int n_chunk;
    double unit;                ///< moments are counted in 1 / unit
    int64_t *count[MOST_CHUNK]; ///< [size] each; index axis-major, (cell, power) along each axis
    double *moment;             ///< [size]
    clx_exact_sum own[MOST_CHUNK][CLAST_N_DISCREPANCY]; ///< over points the product of in-slab
                                                        ///< factors with themselves
} tensor;

/// Pair factor of x with a y of its own slab: coefficients of (1, y).
static void slab_coefficients(double x, int32_t g, double c[CLAST_N_DISCREPANCY][2])
{
    const double third = 1.0 / (3.0 * g);
    const double side = x < 0.5 ? -1.0 : 1.0; // |y - 1/2| = side (y - 1/2) in this slab
    c[CLAST_DISCREPANCY_SYMMETRIC][0] = 2.0 - 2.0 * third;
    c[CLAST_DISCREPANCY_SYMMETRIC][1] = 0.0;
    c[CLAST_DISCREPANCY_CENTRED][0] = 1.0 + 0.5 * fabs(x - 0.5) - 0.25 * side - 0.5 * third;
    c[CLAST_DISCREPANCY_CENTRED][1] = 0.5 * side;
    c[CLAST_DISCREPANCY_STAR][0] = 2.0 - 0.5 * (x + third); // max = (x + y + |x - y|) / 2
    c[CLAST_DISCREPANCY_STAR][1] = -0.5;
}

static int32_t cell_of(double x, int32_t g)
{
    CLAST_ASSERT(x >= 0.0 && g > 0);
    const int32_t cell = (int32_t)(x * g);
    return cell < g ? cell : g - 1;
}

static void add_point(tensor *t, int32_t chunk, const double *x)
{
    double weight[8] = {1.0};
    int64_t place[8] = {0};
    double own[CLAST_N_DISCREPANCY] = {1.0, 1.0, 1.0};
    int filled = 1;
    for (int32_t j = 0; j < t->d; ++j) {
        double c[CLAST_N_DISCREPANCY][2];
        const int32_t cell = cell_of(x[j], t->g);
        for (int m = 0; m < filled; ++m) {
            place[filled + m] = place[m] * 2 * t->g + 2 * cell + 1;
            place[m] = place[m] * 2 * t->g + 2 * cell;
            weight[filled + m] = weight[m] * x[j];
        }
        filled *= 2;
        slab_coefficients(x[j], t->g, c);
        for (int k = 0; k < CLAST_N_DISCREPANCY; ++k) {
            own[k] *= c[k][0] + c[k][1] * x[j];
        }
    }
    for (int m = 0; m < filled; ++m) {
        t->count[chunk][place[m]] += (int64_t)(weight[m] * t->unit + 0.5);
    }
    for (int k = 0; k < CLAST_N_DISCREPANCY; ++k) {
        clx_exact_add(&t->own[chunk][k], own[k]);
    }
}

static void add_chunk(int64_t begin, int64_t end, int32_t worker, void *context)
{
    tensor *t = context;
    double held[3];
    (void)worker;
    for (int64_t chunk = begin; chunk < end; ++chunk) {
        for (int64_t i = t->n * chunk / t->n_chunk; i < t->n * (chunk + 1) / t->n_chunk; ++i) {
            add_point(t, (int32_t)chunk, clx_part_point(t->points, i, held));
        }
    }
}

/// Applies the pair factor of discrepancy k to one line of 2 G moments: out(cell, power) such that
/// the sum over both moments of x in its cell times out is the sum over y. Linear functions of x:
/// out[0] + out[1] x.
static void apply_line(int k, int32_t g, const double *in, double *out, int64_t stride)
{
    // Above and below x, the factor is (a0 + a1 x) + (b0 + b1 y) with |x - 1/2| linear in the slab
    // of x.
    double below0 = 0.0;
    double below1 = 0.0;
    double total0 = 0.0;
    double total1 = 0.0;
    double far_total = 0.0;
    for (int32_t i = 0; i < g; ++i) {
        const double s = 2 * i < g ? -1.0 : 1.0;
        total0 += in[2 * i * stride];
        total1 += in[(2 * i + 1) * stride];
        far_total += s * (in[(2 * i + 1) * stride] - 0.5 * in[2 * i * stride]);
    }
    const double third = 1.0 / (3.0 * g);
    for (int32_t i = 0; i < g; ++i) {
        const double m0 = in[2 * i * stride];
        const double m1 = in[(2 * i + 1) * stride];
        const double s = 2 * i < g ? -1.0 : 1.0;
        const double above0 = total0 - below0 - m0;
        const double above1 = total1 - below1 - m1;
        double c0 = 0.0;
        double c1 = 0.0;
        if (k == CLAST_DISCREPANCY_SYMMETRIC) {
            c0 = 2.0 * (total0 + below1 - above1) - 2.0 * third * m0;
            c1 = 2.0 * (above0 - below0);
        } else if (k == CLAST_DISCREPANCY_CENTRED) {
            c0 = total0 - 0.25 * s * total0 + 0.5 * (below1 - above1) + 0.5 * far_total -
                 0.5 * third * m0;
            c1 = 0.5 * s * total0 + 0.5 * (above0 - below0);
        } else {
            c0 = 2.0 * total0 - above1 - 0.5 * m1 - 0.5 * third * m0;
            c1 = -below0 - 0.5 * m0;
        }
        out[2 * i * stride] = c0;
        out[(2 * i + 1) * stride] = c1;
        below0 += m0;
        below1 += m1;
    }
}

typedef struct {
    int k;
    int32_t g;
    int64_t stride; ///< between neighbours along the axis
    const double *in;
    double *out;
} axis_context;

/// Lines along one axis, numbered by the other indices.
static void apply_lines(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const axis_context *c = context;
    (void)worker;
    for (int64_t line = begin; line < end; ++line) {
        const int64_t start = line / c->stride * c->stride * 2 * c->g + line % c->stride;
        apply_line(c->k, c->g, c->in + start, c->out + start, c->stride);
    }
}

enum { N_DOT = 64 };

/// Product of two tensors, a part for each of N_DOT pieces.
typedef struct {
    const double *a, *b;
    int64_t size;
    double part[N_DOT];
} dot_context;

static void multiply_pieces(int64_t begin, int64_t end, int32_t worker, void *context)
{
    dot_context *c = context;
    (void)worker;
    for (int64_t piece = begin; piece < end; ++piece) {
        double sum = 0.0;
        for (int64_t i = c->size * piece / N_DOT; i < c->size * (piece + 1) / N_DOT; ++i) {
            sum += c->a[i] * c->b[i];
        }
        c->part[piece] = sum;
    }
}

static double dot(const double *a, const double *b, int64_t size)
{
    dot_context c = {.a = a, .b = b, .size = size};
    double sum = 0.0;
    clx_parallel_for(N_DOT, 1, multiply_pieces, &c);
    for (int piece = 0; piece < N_DOT; ++piece) {
        sum += c.part[piece];
    }
    return sum;
}

static double contract(const tensor *t, int k, double *a, double *b)
{
    const double *from = t->moment;
    double *to = a;
    int64_t stride = 1;
    for (int32_t j = 0; j < t->d; ++j) {
        axis_context context = {k, t->g, stride, from, to};
        clx_parallel_for(t->size / (2 * t->g), 256, apply_lines, &context);
        from = to;
        to = to == a ? b : a;
        stride *= 2 * t->g;
    }
    return dot(t->moment, from, t->size);
}

/// Adds the chunks' tensors to the first.
static void add_tensors(int64_t begin, int64_t end, int32_t worker, void *context)
{
    tensor *t = context;
    (void)worker;
    for (int chunk = 1; chunk < t->n_chunk; ++chunk) {
        for (int64_t i = begin; i < end; ++i) {
            t->count[0][i] += t->count[chunk][i];
        }
    }
}

static clast_status alloc_tensor(tensor *t)
{
    clast_status status = CLAST_OK;
    for (int chunk = 0; chunk < t->n_chunk; ++chunk) {
        CLX_TRY(clx_alloc(&t->count[chunk], t->size, sizeof *t->count[chunk]));
    }
    CLX_TRY(clx_alloc(&t->moment, t->size, sizeof *t->moment));
done:
    return status;
}

/// Fills the tensor with all ranks' points; own[0] is the sum of all.
static void fill_tensor(const clx_part *part, tensor *t)
{
    clx_parallel_for(t->n_chunk, 1, add_chunk, t);
    clx_parallel_for(t->size, 65536, add_tensors, t);
    clx_comm_sum(part->comm, t->count[0], t->size);
    for (int64_t i = 0; i < t->size; ++i) {
        t->moment[i] = (double)t->count[0][i] / t->unit;
    }
    for (int k = 0; k < CLAST_N_DISCREPANCY; ++k) {
        for (int chunk = 1; chunk < t->n_chunk; ++chunk) {
            clx_exact_merge(&t->own[0][k], &t->own[chunk][k]);
        }
    }
    clx_exact_over(part->comm, t->own[0], CLAST_N_DISCREPANCY);
}

clast_status clx_pair_sums_binned(const clx_part *part, double sum[CLAST_N_DISCREPANCY])
{
    clast_status status = CLAST_OK;
    const int32_t d = part->d;
    tensor *t = NULL;
    double *a = NULL;
    double *b = NULL;
    status = clx_alloc(&t, 1, sizeof *t);
    if (status == CLAST_OK) {
        *t = (tensor){.points = part,
                      .n = part->n,
                      .d = d,
                      .g = cells_an_axis(d),
                      .n_chunk = n_chunk_of(part->n),
                      .unit = clx_fixed_unit(part->n_all),
                      .size = 1};
        for (int32_t j = 0; j < d; ++j) {
            t->size *= 2 * t->g;
        }
        status = alloc_tensor(t);
    }
    CLX_TRY(clast_comm_agree(part->comm, status, NULL));
    fill_tensor(part, t);
    for (int chunk = 0; chunk < t->n_chunk; ++chunk) {
        clx_free(t->count[chunk]);
        t->count[chunk] = NULL;
    }
    status = clx_alloc(&a, t->size, sizeof *a);
    if (status == CLAST_OK) {
        status = clx_alloc(&b, t->size, sizeof *b);
    }
    CLX_TRY(clast_comm_agree(part->comm, status, NULL));
    for (int k = 0; k < CLAST_N_DISCREPANCY; ++k) {
        sum[k] = contract(t, k, a, b) - clx_exact_value(&t->own[0][k]);
    }
done:
    for (int chunk = 0; chunk < MOST_CHUNK && t != NULL; ++chunk) {
        clx_free(t->count[chunk]);
    }
    CLX_FREE(t != NULL ? t->moment : NULL, t, a, b);
    return status;
}
