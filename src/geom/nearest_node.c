// Exact nearest-node transform in three passes.
#include "geom/nearest_node.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "base/status.h"

enum { ROWS_A_BLOCK = 64 };

typedef struct transform {
    int32_t n[3];
    const uint8_t *marked;
    int32_t *nearest;
    int axis;
    // [worker][longest] scratch of the envelope
    int32_t longest;
    int32_t *apex, *was;
    double *from, *height;
} transform;

/// First pass: nearest marked node within each row.
static void scan_rows(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const transform *t = context;
    const int32_t n = t->n[0];
    (void)worker;
    for (int64_t row = begin; row < end; ++row) {
        int32_t last = -1;
        for (int32_t i = 0; i < n; ++i) {
            last = t->marked[row * n + i] != 0 ? i : last;
            t->nearest[row * n + i] = last < 0 ? -1 : (int32_t)(row * n + last);
        }
        last = -1;
        for (int32_t i = n - 1; i >= 0; --i) {
            last = t->marked[row * n + i] != 0 ? i : last;
            const int32_t left = t->nearest[row * n + i];
            if (last >= 0 && (left < 0 || last - i < i - (int32_t)(left - row * n))) {
                t->nearest[row * n + i] = (int32_t)(row * n + last);
            }
        }
    }
}

/// Squared distance of a node (along the axes before `axis`) to its nearest so far.
static double height_of(const transform *t, int64_t node, int32_t nearest)
{
    CLAST_ASSERT(t->axis == 1 || t->axis == 2);
    CLAST_ASSERT(nearest >= 0);
    const int64_t row = node / t->n[0] - nearest / t->n[0]; // same layer: rows apart
    const double dx = (double)(node % t->n[0] - nearest % t->n[0]);
    const double dy = (double)row;
    return t->axis == 1 ? dx * dx : dx * dx + dy * dy;
}

/// Lower envelope of (x - q)^2 + height(q) along one line of nodes.
static void envelop(const transform *t, int64_t base, int64_t stride, int32_t worker)
{
    const int32_t n = t->n[t->axis];
    int32_t *apex = t->apex + (int64_t)worker * t->longest;
    int32_t *was = t->was + (int64_t)worker * t->longest;
    double *from = t->from + (int64_t)worker * (t->longest + 1);
    double *height = t->height + (int64_t)worker * t->longest;
    int32_t k = -1;
    for (int32_t q = 0; q < n; ++q) {
        was[q] = t->nearest[base + q * stride];
        if (was[q] < 0) {
            continue;
        }
        height[q] = height_of(t, base + q * stride, was[q]);
        double cross = -1.0;
        while (k >= 0) {
            const int32_t p = apex[k];
            cross = ((height[q] + (double)q * q) - (height[p] + (double)p * p)) / (2.0 * (q - p));
            if (cross > from[k]) {
                break;
            }
            --k;
        }
        ++k;
        apex[k] = q;
        from[k] = k == 0 ? -1.0 : cross;
    }
    for (int32_t q = 0, at = 0; q < n && k >= 0; ++q) {
        while (at < k && from[at + 1] < q) {
            ++at;
        }
        t->nearest[base + q * stride] = was[apex[at]];
    }
}

static void envelop_lines(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const transform *t = context;
    const int64_t layer = (int64_t)t->n[0] * t->n[1];
    for (int64_t line = begin; line < end; ++line) {
        if (t->axis == 1) {
            envelop(t, line / t->n[0] * layer + line % t->n[0], t->n[0], worker);
        } else {
            envelop(t, line, layer, worker);
        }
    }
}

clast_status clx_nearest_node(const int32_t n[3], const uint8_t *marked, int32_t *nearest)
{
    CLAST_ASSERT(n[0] > 0 && n[1] > 0 && n[2] > 0);
    clast_status status = CLAST_OK;
    transform t = {.n = {n[0], n[1], n[2]}, .marked = marked, .nearest = nearest};
    const int64_t workers = clx_parallel_workers();
    t.longest = n[1] > n[2] ? n[1] : n[2];
    CLX_TRY(clx_alloc(&t.apex, workers * t.longest, sizeof *t.apex));
    CLX_TRY(clx_alloc(&t.was, workers * t.longest, sizeof *t.was));
    CLX_TRY(clx_alloc(&t.from, workers * (t.longest + 1), sizeof *t.from));
    CLX_TRY(clx_alloc(&t.height, workers * t.longest, sizeof *t.height));
    clx_parallel_for((int64_t)n[1] * n[2], ROWS_A_BLOCK, scan_rows, &t);
    t.axis = 1;
    clx_parallel_for((int64_t)n[0] * n[2], ROWS_A_BLOCK, envelop_lines, &t);
    t.axis = 2;
    clx_parallel_for((int64_t)n[0] * n[1], ROWS_A_BLOCK, envelop_lines, &t);
done:
    CLX_FREE(t.apex, t.was, t.from, t.height);
    return status;
}
