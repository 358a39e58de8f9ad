// Largest-first filling: the greatest sphere that fits between the surface and the placed spheres,
// again and again.
//
// The radius of the sphere centred at x is f(x) = min(signed distance to the surface, distances to
// the placed spheres). f changes by at most |x - y| between two points, and each surface point p
// and placed sphere (c, r) bounds it from above by |x - p| and |x - c| - r. Branch and bound over
// an octree of cubes uses both: cubes wait in a heap by the upper bound of f inside. The top one is
// bounded by the linear programme of fill_lp.c over the witnesses met so far in its neighbourhood
// (error of second order in its size, so ridges and summits of f need few cubes); then f is sampled
// where that bound was reached, which finds the witness that was missing; after a few samples the
// cube is divided. Placing a sphere only lowers f: old bounds stay valid, and cubes are brought up
// to date when they come to the top.                                     [docs/theory/fill.md]
#include "shape/fill_witness.h"

#include "base/alloc.h"
#include <string.h>

enum {
    SAMPLES = 2,
    LEVELS = 60,
    CUBE_LIMIT = 1 << 24,
    SHRINKS = 2,
    CLIMBS = 8,
    WAYS = 4,
    CUBES_AT_FIRST = 1 << 15
};

/// Greatest outer ball, and how far from the wall it may end, in half edges of the cube. Measured:
/// 3 and 12 half edges cost more on scans and on smooth grains.
static const double OUTER_REACH = 6.0;
static const double OUTER_GAP = 0.25;

/// A climb ends when its bound is above by this share of the tolerance.
static const double CLIMB_SHARE = 0.03;

typedef struct {
    double centre[3];
    double next[3];          ///< where f is to be sampled next
    double upper;            ///< no sphere centred in the cube is larger
    int32_t sample[SAMPLES]; ///< own samples, numbers; -1: not taken yet
    int32_t best;            ///< sample in the cube with the greatest f known, or -1
    int32_t parent;          ///< -1 for roots
    int32_t seen;            ///< spheres that `upper` and the samples know
    uint8_t n_sample;
    uint8_t level;
    bool is_bounded; ///< `upper` and `next` account for all samples
} cube;

/// All samples of eight siblings.
typedef struct {
    int32_t n;
    int32_t sample[8 * SAMPLES];
} block;

typedef struct {
    double upper;
    int32_t cube;
} entry;

typedef struct {
    clx_fill *fill;
    double half[LEVELS]; ///< half an edge by level
    cube *cubes;         ///< blocks of eight siblings; the roots stand first, padded to eight
    int64_t n_cube, cube_capacity;
    block *blocks; ///< [n_cube / 8]
    int64_t block_capacity;
    clx_fill_sample *samples;
    int64_t n_sample, sample_capacity;
    entry *heap;
    int64_t n_heap, heap_capacity;
    int32_t best_cube; ///< holds the best sample
    double floor;      ///< smaller spheres are of no interest
} search;

// The heap has four ways: half as many waits for memory as one of two.
static bool before(const entry *a, const entry *b)
{
    // bitwise: a branch here would be mispredicted half of the time
    return (a->upper > b->upper) | ((a->upper == b->upper) & (a->cube < b->cube));
}

static clast_status heap_push(search *s, int32_t number)
{
    CLAST_ASSERT(number >= 0 && number < s->n_cube);
    clast_status status = CLAST_OK;
    const entry e = {s->cubes[number].upper, number};
    CLX_TRY(clx_grow(&s->heap, &s->heap_capacity, s->n_heap + 1, sizeof *s->heap));
    int64_t i = s->n_heap++;
    while (i > 0 && before(&e, &s->heap[(i - 1) / WAYS])) {
        s->heap[i] = s->heap[(i - 1) / WAYS];
        i = (i - 1) / WAYS;
    }
    s->heap[i] = e;
done:
    return status;
}

/// Writes e at the top and lets it sink.
static void heap_sink(search *s, entry e)
{
    int64_t i = 0;
    for (;;) {
        const int64_t first = WAYS * i + 1;
        const int64_t end = first + WAYS < s->n_heap ? first + WAYS : s->n_heap;
        int64_t child = first;
        for (int64_t k = first + 1; k < end; ++k) {
            child = before(&s->heap[k], &s->heap[child]) ? k : child;
        }
        if (child >= end || !before(&s->heap[child], &e)) {
            break;
        }
        s->heap[i] = s->heap[child];
        i = child;
    }
    s->heap[i] = e;
}

static void heap_pop(search *s)
{
    CLAST_ASSERT(s->n_heap > 0);
    const entry last = s->heap[--s->n_heap];
    if (s->n_heap > 0) {
        heap_sink(s, last);
    }
}

static double lesser(double a, double b)
{
    return a < b ? a : b;
}

/// The lesser of a bound and offset + distance of x to the farthest corner of a cube; the root is
/// drawn only when it wins.
static double lesser_of_farthest(double bound, double offset, const double centre[3], double h,
                                 const double x[3])
{
    const double dx = fabs(centre[0] - x[0]) + h;
    const double dy = fabs(centre[1] - x[1]) + h;
    const double dz = fabs(centre[2] - x[2]) + h;
    const double d2 = dx * dx + dy * dy + dz * dz;
    const double room = bound - offset;
    return room > 0.0 && d2 < room * room ? lesser(bound, offset + sqrt(d2)) : bound;
}

/// Upper bound over a cube from one sample, if less than `bound`: f changes no faster than one
/// moves, and no point is farther from the witness than the farthest corner.
static double bound_by(const search *s, const clx_fill_sample *p, const double centre[3], double h,
                       double bound)
{
    bound = lesser_of_farthest(bound, p->value, centre, h, p->at);
    if (!isnan(p->surface)) {
        bound = lesser_of_farthest(bound, 0.0, centre, h, p->nearest);
    }
    if (p->ball >= 0) {
        const double *b = s->fill->balls.ball[p->ball];
        bound = lesser_of_farthest(bound, -b[3], centre, h, b);
    }
    return bound;
}

/// Radius of a ball about a sample that the surface does not enter: signed by its side.
static double clear_radius(const clx_fill_sample *p)
{
    return isnan(p->surface) ? fmax(p->value, 0.0) : p->surface;
}

/// Least distance of the surface from a point, as far as the samples of a cube bound it from above.
static double clearance_by(const search *s, const cube *c, const double point[3])
{
    double reach2 = INFINITY;
    for (int i = 0; i < c->n_sample; ++i) {
        const clx_fill_sample *p = &s->samples[c->sample[i]];
        if (!isnan(p->surface)) {
            reach2 = lesser(reach2, v3_distance2(p->nearest, point));
        }
    }
    return sqrt(reach2) * (1.0 + 1e-12) + 1e-300;
}

/// Side of a point at distance d from the surface by the samples of a family: +1 inside, -1
/// outside, 0 not known. Two balls that the surface does not enter are on one side when they
/// overlap.
static int side_by(const search *s, const block *family, const double point[3], double d)
{
    for (int i = 0; i < family->n; ++i) {
        const clx_fill_sample *p = &s->samples[family->sample[i]];
        const double clear = clear_radius(p);
        const double clearance = fabs(clear) + d - 2.0 * s->fill->field.error;
        if (clear != 0.0 && clearance > 0.0 && v3_distance2(p->at, point) < clearance * clearance) {
            return clear > 0.0 ? 1 : -1;
        }
    }
    return 0;
}

static bool is_inside(const search *s, const cube *c, const double point[3], double d)
{
    int side = side_by(s, &s->blocks[(c - s->cubes) / 8], point, d);
    for (int32_t up = c->parent; side == 0 && up >= 0; up = s->cubes[up].parent) {
        side = side_by(s, &s->blocks[up / 8], point, d);
    }
    return side != 0 ? side > 0 : clx_fill_field_inside(&s->fill->field, point);
}

/// True when the wall's plane at a sample's nearest point parts the cube.
static bool is_parted(const cube *c, double h, const clx_fill_sample *p)
{
    double away[3];
    double from[3];
    v3_sub(away, p->at, p->nearest);
    v3_sub(from, c->centre, p->nearest);
    const double width = h * (fabs(away[0]) + fabs(away[1]) + fabs(away[2]));
    return v3_dot(away, from) <= width;
}

/// Finds a large ball behind the wall that touches it near the sample's nearest point: a ball
/// through that point, shrunk until the surface leaves it alone [Ma2012].
static void find_outer(search *s, const cube *c, clx_fill_sample *p)
{
    const double h = s->half[c->level];
    const double depth = fmax(0.0, -p->surface); // of the sample, behind the wall
    double out[3];
    double radius = OUTER_REACH * h;
    v3_sub(out, p->nearest, p->at);
    v3_scale(out, 1.0 / p->surface, out);
    for (int i = 0; i < SHRINKS && radius > fmax(h, 2.0 * depth); ++i) {
        double centre[3];
        double touch[3];
        int32_t tri;
        v3_axpy(centre, p->nearest, radius, out);
        ++s->fill->n_tested;
        const double d = clx_fill_field_distance(&s->fill->field, centre, radius, touch, &tri);
        const double clear = lesser(d, radius) - s->fill->field.error;
        if (clear > radius - OUTER_GAP * h) {
            if (!is_inside(s, c, centre, clear)) {
                v3_copy(p->outer, centre);
                p->outer_radius = clear;
            }
            return;
        }
        double to[3];
        v3_sub(to, touch, p->nearest);
        radius = lesser(0.9 * radius, 0.5 * v3_norm2(to) / v3_dot(to, out));
    }
}

/// f at a point of a cube.
static void sample_cube(search *s, const cube *c, clx_fill_sample *p)
{
    clx_fill *fill = s->fill;
    double clearance = clearance_by(s, c, p->at);
    if (c->parent >= 0) {
        clearance = lesser(clearance, clearance_by(s, &s->cubes[c->parent], p->at));
    }
    p->seen = fill->balls.n;
    p->ball = -1;
    p->surface = NAN;
    p->outer_radius = 0.0;
    p->value = clx_ball_set_distance(&fill->balls, 0, p->at, clearance, &p->ball);
    if (p->ball >= 0 && p->value <= 0.0) {
        return;
    }
    ++fill->n_tested;
    v3_copy(p->nearest, p->at); // stays where the surface is no nearer than the sphere
    const double d = clx_fill_field_distance(&fill->field, p->at, p->value, p->nearest, &p->tri);
    if (d > p->value) {
        return; // nearer to a sphere than to the surface: inside, for spheres are
    }
    p->size = (float)fill->field.size[p->tri];
    p->surface = is_inside(s, c, p->at, d) ? d : -d;
    p->value = p->surface;
    if (p->surface < 0.0) {
        v3_copy(p->outer, p->at);
        p->outer_radius = d - fill->field.error;
    }
    if (p->surface != 0.0 && (p->surface < 0.0 || c->n_sample > 0) &&
        is_parted(c, s->half[c->level], p)) {
        find_outer(s, c, p);
    }
}

static void note_best(search *s, cube *c, int32_t number)
{
    CLAST_ASSERT(number >= 0 && number < s->n_sample);
    if (c->best < 0 || s->samples[number].value > s->samples[c->best].value) {
        c->best = number;
    }
}

/// Samples f at c->next.
static clast_status take_sample(search *s, cube *c)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_grow(&s->samples, &s->sample_capacity, s->n_sample + 1, sizeof *s->samples));
    const int32_t number = (int32_t)s->n_sample++;
    clx_fill_sample *p = &s->samples[number];
    v3_copy(p->at, c->next);
    sample_cube(s, c, p);
    c->sample[c->n_sample++] = number;
    c->upper = bound_by(s, p, c->centre, s->half[c->level], c->upper);
    c->is_bounded = false;
    block *family = &s->blocks[(c - s->cubes) / 8];
    family->sample[family->n++] = number;
    note_best(s, c, number);
done:
    return status;
}

/// Lets a sample know the spheres placed since it was last looked at; true when one is nearer.
static bool renew(search *s, clx_fill_sample *p)
{
    const double before_it = p->value;
    p->value = clx_ball_set_distance(&s->fill->balls, p->seen, p->at, p->value, &p->ball);
    p->seen = s->fill->balls.n;
    return p->value < before_it;
}

static void refresh(search *s, cube *c)
{
    bool changed = c->best >= 0 && renew(s, &s->samples[c->best]);
    for (int i = 0; i < c->n_sample; ++i) {
        clx_fill_sample *p = &s->samples[c->sample[i]];
        if (renew(s, p)) {
            changed = true;
            c->upper = bound_by(s, p, c->centre, s->half[c->level], c->upper);
        }
    }
    for (int i = 0; i < c->n_sample; ++i) {
        note_best(s, c, c->sample[i]);
    }
    c->is_bounded = c->is_bounded && !changed;
    c->seen = s->fill->balls.n;
}

/// Bound of the cube that follows the top one in the heap.
static double second(const search *s)
{
    double upper = -INFINITY;
    for (int64_t i = 1; i <= WAYS && i < s->n_heap; ++i) {
        upper = fmax(upper, s->heap[i].upper);
    }
    return upper;
}

/// Lowers a cube's bound by the reach of its relatives' samples.
static void bound_by_samples(const search *s, cube *c, const block *family)
{
    const double h = s->half[c->level];
    for (int i = 0; i < family->n; ++i) {
        const clx_fill_sample *p = &s->samples[family->sample[i]];
        c->upper = lesser_of_farthest(c->upper, p->value, c->centre, h, p->at);
    }
}

/// Collects the witnesses of the cube, its siblings, and its parent's generation.
static void witnesses_of(const search *s, const cube *c, const clx_fill_region *region,
                         clx_fill_witnesses *w)
{
    const ptrdiff_t own = (c - s->cubes) / 8;
    const block *families[2] = {&s->blocks[own], c->parent >= 0 ? &s->blocks[c->parent / 8] : NULL};
    for (int k = 0; k < 2 && families[k] != NULL; ++k) {
        for (int i = 0; i < families[k]->n; ++i) { // all at once: the waits for memory overlap
            const char *p = (const char *)&s->samples[families[k]->sample[i]];
            __builtin_prefetch(p);
            __builtin_prefetch(p + 64);
        }
    }
    for (int i = 0; i < c->n_sample; ++i) {
        clx_fill_witnesses_add(s->fill, region, &s->samples[c->sample[i]], w);
    }
    for (int k = 0; k < 2 && families[k] != NULL; ++k) {
        for (int i = 0; i < families[k]->n; ++i) {
            const int32_t number = families[k]->sample[i];
            if (number != c->sample[0] && number != c->sample[1]) {
                clx_fill_witnesses_add(s->fill, region, &s->samples[number], w);
            }
        }
    }
}

/// Bounds f by the witnesses of the cube and its relatives.
static void bound_cube(search *s, int32_t number)
{
    CLAST_ASSERT(number >= 0 && number < s->n_cube);
    clx_fill_witnesses w;
    cube *c = &s->cubes[number];
    clx_fill_region region = {.half = s->half[c->level]};
    bound_by_samples(s, c, &s->blocks[number / 8]);
    if (c->upper < second(s)) {
        return; // the samples' reach was enough to sink it
    }
    v3_copy(region.centre, c->centre);
    region.upper = c->upper;
    clx_fill_witnesses_clear(&w);
    witnesses_of(s, c, &region, &w);
    v3_copy(c->next, c->centre);
    if (w.planes.n > 0) {
        double step[3];
        const double bound = clx_fill_bound(&w.planes, region.half, step);
        c->upper = lesser(c->upper, bound * (1.0 + 1e-12));
        v3_add(c->next, c->centre, step);
    }
    c->is_bounded = true;
}

static void make_child(search *s, int32_t parent, int i, cube *child)
{
    CLAST_ASSERT(i >= 0 && i < 8);
    const cube *c = &s->cubes[parent];
    const double h = s->half[c->level + 1];
    *child = (cube){.upper = c->upper,
                    .sample = {-1, -1},
                    .best = -1,
                    .parent = parent,
                    .seen = c->seen,
                    .level = (uint8_t)(c->level + 1)};
    bool holds_best = c->best >= 0 && s->samples[c->best].value > 0.0;
    for (int k = 0; k < 3; ++k) {
        child->centre[k] = c->centre[k] + ((i >> k & 1) ? h : -h);
        holds_best = holds_best && fabs(s->samples[c->best].at[k] - child->centre[k]) <= h;
    }
    child->best = holds_best ? c->best : -1;
    const block *family = &s->blocks[parent / 8];
    for (int j = 0; j < family->n; ++j) {
        child->upper = bound_by(s, &s->samples[family->sample[j]], child->centre, h, child->upper);
    }
}

static clast_status divide(search *s, int32_t number)
{
    CLAST_ASSERT(number >= 0 && number < s->n_cube);
    clast_status status = CLAST_OK;
    CLX_CHECK(s->n_cube + 8 < CUBE_LIMIT, CLAST_E_LIMIT,
              "the search after %d spheres needs more than %d million cubes; raise --min-share or "
              "--min-radius",
              s->fill->balls.n, CUBE_LIMIT >> 20);
    CLX_CHECK(s->cubes[number].level + 1 < LEVELS, CLAST_E_CONVERGE,
              "search for the largest sphere went %d levels deep", LEVELS);
    CLX_TRY(clx_grow(&s->cubes, &s->cube_capacity, s->n_cube + 8, sizeof *s->cubes));
    CLX_TRY(clx_grow(&s->blocks, &s->block_capacity, s->n_cube / 8 + 1, sizeof *s->blocks));
    const int32_t first = (int32_t)s->n_cube;
    s->blocks[first / 8].n = 0;
    s->n_cube += 8;
    for (int i = 0; i < 8; ++i) {
        make_child(s, number, i, &s->cubes[first + i]);
        if (s->cubes[first + i].upper > s->floor) {
            CLX_TRY(heap_push(s, first + i));
        }
    }
done:
    return status;
}

/// Roots: cubes over the box, as large as its shortest edge, but at most 32 along the longest.
static clast_status plant(search *s)
{
    clast_status status = CLAST_OK;
    const clx_fill *fill = s->fill;
    double size[3];
    v3_sub(size, fill->high, fill->low);
    const double longest = fmax(size[0], fmax(size[1], size[2]));
    const double edge = fmax(longest / 32.0, fmin(size[0], fmin(size[1], size[2])));
    int n[3];
    for (int k = 0; k < 3; ++k) {
        n[k] = (int)ceil(size[k] / edge * (1.0 - 1e-12));
        n[k] = n[k] > 1 ? n[k] : 1;
    }
    for (int level = 0; level < LEVELS; ++level) {
        s->half[level] = 0.5 * edge * ldexp(1.0, -level);
    }
    const int64_t total = (int64_t)n[0] * n[1] * n[2];
    CLX_TRY(clx_grow(&s->cubes, &s->cube_capacity, (total + 7) / 8 * 8, sizeof *s->cubes));
    s->n_cube = (total + 7) / 8 * 8;
    CLX_TRY(clx_grow(&s->blocks, &s->block_capacity, s->n_cube / 8, sizeof *s->blocks));
    memset(s->blocks, 0, (size_t)(s->n_cube / 8) * sizeof *s->blocks);
    memset(s->cubes, 0, (size_t)s->n_cube * sizeof *s->cubes);
    for (int64_t i = 0; i < total; ++i) {
        cube *c = &s->cubes[i];
        *c = (cube){.upper = INFINITY, .sample = {-1, -1}, .best = -1, .parent = -1};
        const int64_t at[3] = {i % n[0], i / n[0] % n[1], i / n[0] / n[1]};
        for (int k = 0; k < 3; ++k) {
            c->centre[k] = 0.5 * (fill->low[k] + fill->high[k]) +
                           edge * ((double)at[k] - 0.5 * (double)(n[k] - 1));
        }
        CLX_TRY(heap_push(s, (int32_t)i));
    }
done:
    return status;
}

static void destroy(void *state)
{
    search *s = state;
    if (s != NULL) {
        CLX_FREE(s->cubes, s->blocks, s->samples, s->heap, s);
    }
}

static clast_status create(clx_fill *fill, void **state)
{
    clast_status status = CLAST_OK;
    search *s = NULL;
    CLX_TRY(clx_alloc(&s, 1, sizeof *s));
    s->fill = fill;
    s->floor = fill->floor;
    CLX_TRY(clx_grow(&s->cubes, &s->cube_capacity, CUBES_AT_FIRST, sizeof *s->cubes));
    CLX_TRY(clx_grow(&s->samples, &s->sample_capacity, CUBES_AT_FIRST / 2, sizeof *s->samples));
    CLX_TRY(plant(s));
    *state = s;
    s = NULL;
done:
    destroy(s);
    return status;
}

/// One step on the cube at the top of the heap.
static clast_status advance(search *s)
{
    CLAST_ASSERT(s->n_heap > 0);
    clast_status status = CLAST_OK;
    const int32_t number = s->heap[0].cube;
    cube *c = &s->cubes[number];
    if (c->seen < s->fill->balls.n) {
        refresh(s, c);
    } else if (!c->is_bounded) {
        bound_cube(s, number);
    } else if (c->n_sample < SAMPLES) {
        CLX_TRY(take_sample(s, c));
    } else {
        heap_pop(s);
        CLX_TRY(divide(s, number));
        goto done;
    }
    if (c->upper > s->floor) {
        heap_sink(s, (entry){c->upper, number});
    } else {
        heap_pop(s);
    }
done:
    return status;
}

/// Runs the search until no cube can hold a sphere larger than the best known by the tolerance.
static clast_status find_best(search *s, int32_t *best)
{
    clast_status status = CLAST_OK;
    const double slack = 1.0 + s->fill->config->tolerance;
    double value = 0.0;
    *best = -1;
    for (int64_t step = 1; s->n_heap > 0 && s->heap[0].upper > value * slack; ++step) {
        const int32_t number = s->heap[0].cube;
        if (step % 4096 == 0) {
            CLX_TRY(clx_fill_poll(s->fill));
        }
        CLX_TRY(advance(s));
        const cube *c = &s->cubes[number];
        if (c->seen == s->fill->balls.n && c->best >= 0 && s->samples[c->best].value > value) {
            *best = c->best;
            s->best_cube = number;
            value = s->samples[c->best].value;
        }
    }
done:
    return status;
}

/// Climbs from the best sample to the summit nearby: linear programmes in shrinking cubes about the
/// best point so far, each over what the samples before it saw. The spheres touch what they should.
static void climb(search *s, clx_fill_sample *best)
{
    const cube *home = &s->cubes[s->best_cube];
    const double enough = 1.0 + CLIMB_SHARE * s->fill->config->tolerance;
    clx_fill_sample seen[CLIMBS];
    clx_fill_region region = {.half = s->half[home->level]};
    for (int n = 0; n < CLIMBS; ++n) {
        clx_fill_witnesses w;
        clx_fill_sample *p = &seen[n];
        double step[3];
        v3_copy(region.centre, best->at);
        region.upper = best->value + 1.7320508075688773 * region.half;
        clx_fill_witnesses_clear(&w);
        clx_fill_witnesses_add(s->fill, &region, best, &w);
        for (int i = n - 1; i >= 0; --i) {
            clx_fill_witnesses_add(s->fill, &region, &seen[i], &w);
        }
        witnesses_of(s, home, &region, &w);
        if (clx_fill_bound(&w.planes, region.half, step) <= best->value * enough) {
            return;
        }
        p->tri = -1;
        v3_add(p->at, best->at, step);
        sample_cube(s, home, p);
        if (p->value > best->value) {
            *best = *p;
        } else {
            region.half *= 0.5;
        }
    }
}

/// True when the exact tree agrees with the sample's side and distance; corrects it otherwise.
static bool is_confirmed(const search *s, clx_fill_sample *p)
{
    double closest[3];
    const bool inside = clx_fill_field_inside(&s->fill->field, p->at);
    const double d = clx_fill_field_closest(&s->fill->field, p->at,
                                            inside ? p->value : (double)INFINITY, closest);
    if (inside && d >= p->value * (1.0 - 1e-12)) {
        p->value = lesser(d, p->value);
        return true;
    }
    p->surface = inside ? d : -d;
    p->value = p->surface;
    v3_copy(p->nearest, closest);
    p->tri = -1;
    return false;
}

static clast_status next(clx_fill *fill, void *state, double ball[4], bool *found)
{
    clast_status status = CLAST_OK;
    search *s = state;
    int32_t best = -1;
    do {
        CLX_TRY(find_best(s, &best));
        if (best >= 0) {
            climb(s, &s->samples[best]);
        }
    } while (best >= 0 && !is_confirmed(s, &s->samples[best]));
    fill->bound = s->n_heap > 0 ? s->heap[0].upper : 0.0;
    *found = best >= 0 && s->samples[best].value > s->floor;
    if (*found) {
        v3_copy(ball, s->samples[best].at);
        ball[3] = s->samples[best].value;
        s->floor = fmax(s->floor, fill->config->min_share * (fill->balls.n == 0 ? ball[3] : 0.0));
    }
done:
    return status;
}

const clx_fill_strategy clx_fill_largest = {create, next, destroy};
