// Overlapping fillings: clumps that cover a solid with few spheres.
//
// Candidates are spheres of the medial axis, the largest that touch the surface at given points:
// the shrinking ball starts huge at a surface point, tangent to its triangle, and shrinks until
// nothing of the surface is inside [Ma2012]. They are taken greedily by the volume they newly
// cover, counted on a cubic lattice of points inside the solid. The count of a candidate only falls
// as others are taken, so stale counts are upper bounds and few are renewed for each sphere taken
// (lazy greedy choice [Minoux1978]); greedy covers at least 63 % of what the best choice of as many
// candidates would [Nemhauser1978].
#include "shape/fill.h"

#include "base/alloc.h"
#include "base/parallel.h"

enum { CANDIDATES = 6000, LATTICE_POINTS = 60000, SHRINK_STEPS = 40, BLOCK = 64 };

typedef struct {
    double ball[4];
    double gain;  ///< lattice points newly covered, or a bound from above
    int32_t seen; ///< spheres that gain knows; -1: only the volume was asked
} candidate;

typedef struct {
    clx_fill *fill;
    clx_fill_spread spread;
    candidate *heap; ///< [n_heap] greatest gain first
    int32_t n_heap;
    int64_t n[3];    ///< lattice
    double first[3]; ///< its lowest point
    double step;
    uint8_t *open; ///< [n0 n1 n2] inside the solid and not yet covered
} work;

static void destroy(void *state)
{
    work *w = state;
    if (w != NULL) {
        clx_fill_spread_free(&w->spread);
        CLX_FREE(w->heap, w->open, w);
    }
}

static void lattice_kernel(int64_t begin, int64_t end, int32_t worker, void *context)
{
    work *w = context;
    (void)worker;
    for (int64_t row = begin; row < end; ++row) {
        for (int64_t i = 0; i < w->n[0]; ++i) {
            const int64_t j = row % w->n[1];
            const int64_t k = row / w->n[1];
            const double p[3] = {w->first[0] + w->step * (double)i,
                                 w->first[1] + w->step * (double)j,
                                 w->first[2] + w->step * (double)k};
            w->open[row * w->n[0] + i] = clx_fill_field_inside(&w->fill->field, p);
        }
    }
}

static clast_status make_lattice(work *w)
{
    clast_status status = CLAST_OK;
    const clx_fill *fill = w->fill;
    w->step = cbrt(fill->mass.volume / LATTICE_POINTS);
    double total = 1.0;
    for (int k = 0; k < 3; ++k) {
        const double size = fill->high[k] - fill->low[k];
        w->n[k] = (int64_t)ceil(size / w->step);
        total *= (double)w->n[k];
        w->first[k] = 0.5 * (fill->low[k] + fill->high[k]) - 0.5 * w->step * (double)(w->n[k] - 1);
    }
    CLX_CHECK(total < 1e9, CLAST_E_LIMIT,
              "the solid fills only %g of its box: too little for the lattice of overlap",
              LATTICE_POINTS / total);
    CLX_TRY(clx_alloc(&w->open, w->n[0] * w->n[1] * w->n[2], sizeof *w->open));
    clx_parallel_for(w->n[1] * w->n[2], 16, lattice_kernel, w);
done:
    return status;
}

/// Largest sphere inside that touches a surface point from within; radius 0 when there is none.
static void shrink_ball(const clx_fill *fill, const double point[3], const double inward[3],
                        double ball[4])
{
    double closest[3];
    int32_t tri;
    double r = 0.5 * fill->extent;
    for (int i = 0; i < SHRINK_STEPS; ++i) {
        double to[3];
        v3_axpy(ball, point, r, inward);
        const double d =
            clx_fill_field_distance(&fill->field, ball, r * (1.0 - 1e-9), closest, &tri);
        if (!(d < r * (1.0 - 1e-9))) {
            break;
        }
        v3_sub(to, closest, point);
        const double along = v3_dot(to, inward);
        const double next = v3_norm2(to) / (2.0 * along);
        if (!(along > 0.0 && next < r * (1.0 - 1e-9))) {
            break; // the surface is nearer on the other side of the point, or rounding ends it
        }
        r = next;
    }
    // Only a place for a sphere came from above; its radius is asked of the exact tree.
    const bool inside = clx_fill_field_inside(&fill->field, ball);
    const double d = clx_fill_field_closest(&fill->field, ball, INFINITY, NULL);
    ball[3] = inside ? d / (1.0 - fill->config->protrusion) : 0.0;
}

static void candidate_kernel(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const work *w = context;
    const clast_mesh *mesh = w->spread.mesh;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        candidate *c = &w->heap[i];
        double point[3];
        double u[3];
        double v[3];
        double inward[3];
        const int32_t t = clx_fill_spread_point(&w->spread, i, CANDIDATES, point);
        v3_sub(u, mesh->vert[mesh->tri[t][1]], mesh->vert[mesh->tri[t][0]]);
        v3_sub(v, mesh->vert[mesh->tri[t][2]], mesh->vert[mesh->tri[t][0]]);
        v3_cross(inward, v, u);
        if (v3_unit(inward, inward)) {
            shrink_ball(w->fill, point, inward, c->ball);
        }
        // every lattice point in the sphere has its cell in the sphere grown by half a diagonal
        const double r = c->ball[3] / w->step + 0.8661;
        c->gain = 4.0 / 3.0 * CLAST_PI * r * r * r;
        c->seen = -1;
    }
}

static bool before(const candidate *a, const candidate *b)
{
    if (a->gain != b->gain) {
        return a->gain > b->gain;
    }
    for (int k = 3; k >= 0; --k) {
        if (a->ball[k] != b->ball[k]) {
            return a->ball[k] > b->ball[k];
        }
    }
    return false;
}

static void sink(work *w, int32_t i)
{
    CLAST_ASSERT(i >= 0 && i < w->n_heap);
    const candidate c = w->heap[i];
    for (;;) {
        int32_t child = 2 * i + 1;
        if (child >= w->n_heap) {
            break;
        }
        child += child + 1 < w->n_heap && before(&w->heap[child + 1], &w->heap[child]);
        if (!before(&w->heap[child], &c)) {
            break;
        }
        w->heap[i] = w->heap[child];
        i = child;
    }
    w->heap[i] = c;
}

static void pop(work *w)
{
    CLAST_ASSERT(w->n_heap > 0);
    w->heap[0] = w->heap[--w->n_heap];
    if (w->n_heap > 0) {
        sink(w, 0);
    }
}

static clast_status make_candidates(work *w)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_fill_spread_create(w->fill->surface, &w->spread));
    CLX_TRY(clx_alloc(&w->heap, CANDIDATES, sizeof *w->heap));
    clx_parallel_for(CANDIDATES, BLOCK, candidate_kernel, w);
    w->fill->n_tested += CANDIDATES;
    double largest = 0.0;
    for (int32_t i = 0; i < CANDIDATES; ++i) {
        largest = fmax(largest, w->heap[i].ball[3]);
    }
    const double floor = fmax(w->fill->floor, w->fill->config->min_share * largest);
    for (int32_t i = 0; i < CANDIDATES; ++i) {
        if (w->heap[i].ball[3] >= floor) {
            w->heap[w->n_heap++] = w->heap[i];
        }
    }
    for (int32_t i = w->n_heap / 2 - 1; i >= 0; --i) {
        sink(w, i);
    }
done:
    return status;
}

static clast_status create(clx_fill *fill, void **state)
{
    clast_status status = CLAST_OK;
    work *w = NULL;
    CLX_TRY(clx_alloc(&w, 1, sizeof *w));
    w->fill = fill;
    CLX_TRY(make_lattice(w));
    CLX_TRY(make_candidates(w));
    *state = w;
    w = NULL;
done:
    destroy(w);
    return status;
}

/// Lattice points of one axis within `reach` of a coordinate.
static void lattice_range(const work *w, int k, double x, double max_distance, int64_t range[2])
{
    CLAST_ASSERT(k >= 0 && k < 3 && w->step > 0.0);
    const double low = ceil((x - max_distance - w->first[k]) / w->step);
    const double high = floor((x + max_distance - w->first[k]) / w->step);
    range[0] = low > 0.0 ? (int64_t)low : 0;
    range[1] = high < (double)w->n[k] - 1.0 ? (int64_t)high : w->n[k] - 1;
}

/// Open lattice points in a sphere; closes them if `cover`.
static int64_t count_open(work *w, const double ball[4], bool cover)
{
    int64_t sum = 0;
    int64_t z[2];
    int64_t y[2];
    int64_t x[2];
    const double r2 = ball[3] * ball[3];
    lattice_range(w, 2, ball[2], ball[3], z);
    for (int64_t k = z[0]; k <= z[1]; ++k) {
        const double dz = w->first[2] + w->step * (double)k - ball[2];
        lattice_range(w, 1, ball[1], sqrt(fmax(0.0, r2 - dz * dz)), y);
        for (int64_t j = y[0]; j <= y[1]; ++j) {
            const double dy = w->first[1] + w->step * (double)j - ball[1];
            lattice_range(w, 0, ball[0], sqrt(fmax(0.0, r2 - dz * dz - dy * dy)), x);
            uint8_t *row = w->open + (k * w->n[1] + j) * w->n[0];
            for (int64_t i = x[0]; i <= x[1]; ++i) {
                sum += row[i];
                row[i] = cover ? 0 : row[i];
            }
        }
    }
    return sum;
}

static clast_status next(clx_fill *fill, void *state, double ball[4], bool *found)
{
    work *w = state;
    *found = false;
    while (w->n_heap > 0 && !*found) {
        candidate *top = &w->heap[0];
        if (top->seen < fill->balls.n) {
            top->gain = (double)count_open(w, top->ball, false);
            top->seen = fill->balls.n;
            if (top->gain > 0.0) {
                sink(w, 0);
            } else {
                pop(w);
            }
            continue;
        }
        for (int k = 0; k < 4; ++k) {
            ball[k] = top->ball[k];
        }
        (void)count_open(w, ball, true);
        pop(w);
        *found = true;
    }
    return CLAST_OK;
}

const clx_fill_strategy clx_fill_overlap = {create, next, destroy};
