// Pair forces of all contacts, once a step.
//
// Active pairs are sorted by kind of contact search, without a branch that could be mispredicted,
// and go on four or eight at a time in SIMD lanes (batch.h); what lanes cannot answer goes through
// scalar code. A pair writes its own slots only, so blocks run in any order. Pair forces are summed
// afterwards, in motion.c or sweep.c.
#include "dem/batch.h"

#include "base/parallel.h"
#include "convex/ellipsoid_lanes.h"
#include "convex/facet.h"
#include "dem/container.h"
#include <string.h>

enum { BLOCK = 256 };

/// Kind of contact search of a pair of whole grains.
static inline clx_batch_kind kind_of(const clx_grain *grain, const clx_dem_pair *pair)
{
    static const uint8_t remembered[] = {CLX_BATCH_ANY, CLX_BATCH_FACES, CLX_BATCH_FACES,
                                         CLX_BATCH_EDGES};
    if (pair->slot == 0) {
        return CLX_BATCH_SPHERES; // else clx_inner_find had assigned it a warm start
    }
    if (pair->kind == CLX_FACET_NONE && grain[pair->a].kind == CLAST_SHAPE_ELLIPSOID &&
        grain[pair->b].kind == CLAST_SHAPE_ELLIPSOID) {
        return CLX_BATCH_ELLIPSOIDS;
    }
    return (clx_batch_kind)remembered[pair->kind];
}

/// Contact of lane k by scalar code.
static void find_one(clast_dem *dem, clx_batch *p, clx_batch_kind kind, int k)
{
    clx_dem_touch t = {0};
    clx_dem_pair *pair = p->pair[k];
    clx_warm_start *warm_start = clx_inner_warm_start(dem, pair);
    if (kind == CLX_BATCH_FACES || kind == CLX_BATCH_EDGES) {
        clx_touch_hulls_anew(dem, pair, warm_start, &t); // lanes have tried the warm start's facet
    } else {
        clx_dem_touch_find(dem, pair, warm_start, &t);
    }
    if (warm_start != NULL) {
        pair->kind = warm_start->kind & 3U;
    }
    p->meet.gap[k] = t.distance;
    for (int c = 0; c < 3; ++c) {
        p->meet.normal[c][k] = -t.normal[c];
        p->meet.point[c][k] = t.arm_a[c];
        p->arm_b[c][k] = t.arm_b[c];
    }
}

/// Contacts of ellipsoids from the common normals of the last step; returns which lanes are
/// answered.
static int reuse_normals(const clast_dem *dem, clx_batch *p)
{
    int answered = 0;
    const clx_convex *a[CLX_BATCH];
    const clx_convex *b[CLX_BATCH];
    for (int k = 0; k < CLX_BATCH; ++k) {
        a[k] = &dem->convex[p->pair[k]->a];
        b[k] = &dem->convex[p->pair[k]->b];
    }
    for (int from = 0; from < p->n; from += CLX_LANES) {
        answered |= clx_ellipsoids_again(&p->meet, from, a + from, b + from) << from;
    }
    for (int k = 0; k < p->n; ++k) {
        clx_warm_start *warm_start = clx_inner_warm_start(dem, p->pair[k]);
        for (int c = 0; c < 3 && (answered >> k & 1) != 0; ++c) {
            warm_start->seen[0][c] = (float)p->meet.normal[c][k];
        }
    }
    return answered;
}

/// Contacts of the lanes that were not answered, by scalar code.
static void find_rest(clast_dem *dem, clx_batch *p, clx_batch_kind kind, int answered)
{
    const int last = p->n - 1;
    for (int k = 0; k < p->n; ++k) {
        if ((answered >> k & 1) == 0) {
            find_one(dem, p, kind, k);
        }
    }
    for (int k = p->n; k < CLX_BATCH; ++k) {
        p->meet.gap[k] = p->meet.gap[last];
        for (int c = 0; c < 3; ++c) {
            p->meet.normal[c][k] = p->meet.normal[c][last];
            p->meet.point[c][k] = p->meet.point[c][last];
            p->arm_b[c][k] = p->arm_b[c][last];
        }
    }
}

/// Contacts of a batch.
static void find_all(clast_dem *dem, clx_batch *p, clx_batch_kind kind)
{
    CLAST_ASSERT(p->n >= 1 && p->n <= CLX_BATCH);
    int answered = 0;
    switch (kind) {
    case CLX_BATCH_FACES:
        answered = clx_batch_faces(dem, p);
        break;
    case CLX_BATCH_EDGES:
        answered = clx_batch_edges(dem, p);
        break;
    case CLX_BATCH_SPHERES:
        clx_batch_spheres(dem, p);
        return;
    case CLX_BATCH_ELLIPSOIDS:
        clx_batch_offsets(dem, p);
        answered = reuse_normals(dem, p);
        clx_batch_arms(p);
        break;
    default:
        break;
    }
    const int all = (1 << p->n) - 1;
    if ((answered & all) != all) {
        find_rest(dem, p, kind, answered);
    }
}

static void end_contact(const clast_dem *dem, const clx_batch *p, int k)
{
    CLAST_ASSERT(k >= 0 && k < p->n);
    clx_dem_pair *pair = p->pair[k];
    clx_contact_history *history = clx_pair_history(dem, pair);
    if (history != NULL) {
        *history = (clx_contact_history){0};
    }
    pair->active_from = p->travel[k] + p->meet.gap[k];
    pair->touches = 0;
    v3_set(pair->slide, 0.0, 0.0, 0.0);
    *p->to[k] = (clx_pair_force){0};
}

/// Force of a pair that touches, by scalar code.
static void force_of_pair(const clast_dem *dem, clx_dem_pair *pair, const clx_dem_touch *t,
                          clx_pair_force *out)
{
    CLAST_ASSERT(pair->a >= 0 && (pair->b < 0 || pair->b > pair->a));
    clx_force_torque on_a = {0};
    clx_force_torque on_b = {0};
    clx_add_pair_force(dem, pair, clx_pair_history(dem, pair), t, &on_a, &on_b);
    *out = (clx_pair_force){0};
    v3_copy(out->force, on_b.force);
    v3_copy(out->torque_b, on_b.torque);
    v3_scale(out->torque_a, -1.0, on_a.torque);
    out->torque_b[3] = on_b.torque[3];
    out->torque_a[3] = -on_a.torque[3];
}

/// Lane k's contact as scalar code has it.
static clx_dem_touch touch_of_lane(const clx_batch *p, int k)
{
    CLAST_ASSERT(k >= 0 && k < p->n);
    clx_dem_touch t = {.distance = p->meet.gap[k]};
    for (int c = 0; c < 3; ++c) {
        t.normal[c] = -p->meet.normal[c][k];
        t.arm_a[c] = p->meet.point[c][k];
        t.arm_b[c] = p->arm_b[c][k];
    }
    return t;
}

/// Forces by the laws that have no code for lanes.
static void force_of_each(clast_dem *dem, const clx_batch *p)
{
    for (int k = 0; k < p->n; ++k) {
        if (p->meet.gap[k] >= 0.0 && !(p->meet.gap[k] < clx_pair_neck(dem, p->pair[k]))) {
            end_contact(dem, p, k);
        } else {
            p->pair[k]->touches = 1;
            const clx_dem_touch t = touch_of_lane(p, k);
            force_of_pair(dem, p->pair[k], &t, p->to[k]);
        }
    }
}

/// Pairs of a piece of the inner list; how far ahead pairs, and their warm starts and grains, are
/// prefetched: a bed of 4000 hulls does not stay in a second-level cache.
enum {
    PAIR_AHEAD = 16,
    REST_AHEAD = CLX_BATCH,
    ROW = 512,
    PIECE = ROW - CLX_BATCH - REST_AHEAD,
    PACKED_AHEAD = CLX_PREFETCH_PAIRS,
    GRAIN_AHEAD = 8,
    LINE = 64
};

/// A piece of the inner list, and its active pairs by kind of contact search.
typedef struct {
    const int32_t *index;
    clx_packed_pair *packed;       ///< the same pairs, packed, or NULL
    int64_t n_left;                ///< pairs from there to the end of the inner list
    clx_pair_force *force;         ///< of each pair
    clx_dem_touch *touch;          ///< where each active pair touches, or NULL: not asked for
    double travel[PIECE];          ///< path of each pair's two grains
    int n[CLX_N_BATCH];            ///< active pairs
    uint16_t at[CLX_N_BATCH][ROW]; ///< their indices, the last of a kind repeated
} piece;

// Always inlined: a function that does nothing but prefetch looks free of effects to GCC, which
// then drops its calls.
CLX_INLINE void fetch_two(const void *record)
{
    __builtin_prefetch(record);
    __builtin_prefetch((const char *)record + LINE);
}

CLX_INLINE void fetch_three(const void *record)
{
    fetch_two(record);
    __builtin_prefetch((const char *)record + 2 * LINE);
}

/// Prefetches what a batch of whole grains reads: two lines of a sphere; three of another grain and
/// of the pair's warm start.
CLX_INLINE void fetch_batch(const clast_dem *dem, const piece *s, const uint16_t *at,
                            bool are_spheres)
{
    const clx_dem_pair *pairs = dem->list.pair;
    for (int k = 0; k < CLX_BATCH; ++k) {
        const clx_dem_pair *pair = &pairs[s->index[at[k]]];
        fetch_two(&dem->grain[pair->b]);
        if (!are_spheres) {
            __builtin_prefetch((const char *)&dem->grain[pair->b] + 2 * LINE);
            fetch_three(&dem->list.warm_start[pair->slot]);
        }
    }
}

/// Grain of an item; where pairs are packed, items are grains.
CLX_INLINE int32_t grain_of(const clast_dem *dem, bool is_packed, int32_t item)
{
    return is_packed ? item : clx_item_grain(dem, item);
}

CLX_INLINE clx_dem_pair *pair_of(const clast_dem *dem, const piece *s, bool is_packed, int i)
{
    return is_packed ? &s->packed[i].pair : &dem->list.pair[s->index[i]];
}

/// Prefetches a packed pair some way ahead, and the other grain of one less far ahead.
CLX_INLINE void fetch_packed(const clx_grain *grain, const clx_packed_pair *packed)
{
    const int32_t b = packed[GRAIN_AHEAD].pair.b;
    fetch_three(&packed[PACKED_AHEAD]);
    fetch_three(&grain[b < 0 ? 0 : b]);
}

/// Lists the active ones of n pairs, without a branch that depends on it; returns how many.
CLX_INLINE int sort_pairs(const clast_dem *dem, int n, bool is_packed, piece *s,
                          clx_active_pair *active)
{
    const clx_grain *grain = dem->grain;
    const double *travel = dem->travel;
    const bool has_container = dem->container != NULL;
    const double of_walls = dem->walls.path;
    clx_active_pair *to = active;
    uint16_t *end[CLX_N_BATCH];
    for (int kind = 0; kind < CLX_N_BATCH; ++kind) {
        end[kind] = s->at[kind];
    }
    for (int i = 0; i < n; ++i) {
        const clx_dem_pair *pair = pair_of(dem, s, is_packed, i);
        if (is_packed) {
            fetch_packed(grain, &s->packed[i]);
        } else if (i + PAIR_AHEAD < s->n_left) {
            __builtin_prefetch(&dem->list.pair[s->index[i + PAIR_AHEAD]]);
        }
        const bool is_plain = (is_packed || dem->item == NULL) && pair->b >= 0;
        const clx_batch_kind kind = is_plain ? kind_of(grain, pair) : CLX_BATCH_ANY;
        const double other = pair->b >= 0 ? travel[grain_of(dem, is_packed, pair->b)] : of_walls;
        const double path = travel[grain_of(dem, is_packed, pair->a)] + other;
        const int is_contained = !is_packed && has_container && clx_pair_is_container(dem, pair);
        const int is_active = !(path < pair->active_from) & !is_contained;
        s->travel[i] = path;
        *end[kind] = (uint16_t)i;
        *to = (clx_active_pair){.pair = pair, .at = i};
        end[kind] += is_active;
        to += is_active;
    }
    for (int kind = 0; kind < CLX_N_BATCH; ++kind) {
        s->n[kind] = (int)(end[kind] - s->at[kind]);
        for (int k = 0; k < CLX_BATCH + REST_AHEAD && s->n[kind] > 0; ++k) {
            end[kind][k] = end[kind][-1];
        }
    }
    return (int)(to - active);
}

static int sort_active(const clast_dem *dem, int n, piece *s, clx_active_pair *active)
{
    return s->packed != NULL ? sort_pairs(dem, n, true, s, active)
                             : sort_pairs(dem, n, false, s, active);
}

/// The batch of these pairs.
CLX_INLINE void fill_from(const clast_dem *dem, const piece *s, const uint16_t *at, bool is_packed,
                          bool has_walls, clx_batch *p)
{
    const clx_grain *grain = dem->grain;
    for (int k = 0; k < CLX_BATCH; ++k) {
        clx_dem_pair *pair = pair_of(dem, s, is_packed, at[k]);
        const int32_t b = pair->b;
        p->to[k] = &s->force[at[k]];
        p->pair[k] = pair;
        p->travel[k] = s->travel[at[k]];
        p->a[k] = &grain[grain_of(dem, is_packed, pair->a)];
        p->b[k] = !has_walls || b >= 0 ? &grain[grain_of(dem, is_packed, b)] : &clx_immovable;
        p->meet.rotation_a[k] = p->a[k]->rotation[0];
        p->meet.rotation_b[k] = p->b[k]->rotation[0];
        p->meet.warm_start[k] =
            is_packed ? &s->packed[at[k]].warm_start : clx_pair_warm_start(dem, pair);
    }
}

/// The batch that begins with the active pair `from` of a kind.
static inline void fill(const clast_dem *dem, const piece *s, clx_batch_kind kind, int from,
                        clx_batch *p)
{
    CLAST_ASSERT(from >= 0 && from < s->n[kind]);
    const uint16_t *at = s->at[kind] + from;
    p->n = s->n[kind] - from < CLX_BATCH ? s->n[kind] - from : CLX_BATCH;
    if (kind == CLX_BATCH_ANY) {
        fill_from(dem, s, at, s->packed != NULL, true, p);
    } else if (s->packed != NULL) {
        fill_from(dem, s, at, true, false, p);
    } else if (kind == CLX_BATCH_SPHERES) {
        fetch_batch(dem, s, at + REST_AHEAD, true);
        fill_from(dem, s, at, false, false, p);
    } else {
        fetch_batch(dem, s, at + REST_AHEAD, false);
        fill_from(dem, s, at, false, false, p);
    }
}

/// Forces of the active pairs of the piece; lists those, and returns how many they are.
static int find_piece(clast_dem *dem, int n, piece *s, clx_active_pair *active)
{
    CLAST_ASSERT(n >= 1 && n <= PIECE);
    const int n_active = sort_active(dem, n, s, active);
    clx_batch batch;
    for (int kind = 0; kind < CLX_N_BATCH; ++kind) {
        const bool has_law = clx_batch_has_law(dem, (clx_batch_kind)kind);
        for (int from = 0; from < s->n[kind]; from += CLX_BATCH) {
            fill(dem, s, (clx_batch_kind)kind, from, &batch);
            find_all(dem, &batch, (clx_batch_kind)kind);
            if (s->touch != NULL) {
                for (int k = 0; k < batch.n; ++k) {
                    s->touch[s->at[kind][from + k]] = touch_of_lane(&batch, k);
                }
            }
            if (has_law) {
                clx_batch_force(dem, &batch, (clx_batch_kind)kind);
            } else {
                force_of_each(dem, &batch);
            }
        }
    }
    return n_active;
}

static void begin_piece(const clast_dem *dem, int64_t at, clx_pair_force *force, piece *s)
{
    CLAST_ASSERT(at >= 0 && at < dem->inner.n);
    s->index = dem->inner.index + at;
    s->packed = dem->inner.is_packed ? dem->inner.packed + at : NULL;
    s->n_left = dem->inner.n - at;
    s->force = force;
    s->touch = NULL;
}

int32_t clx_contacts_among(clast_dem *dem, int32_t begin, int32_t end, clx_pair_force *force,
                           clx_active_pair *active)
{
    CLAST_ASSERT(begin >= 0 && begin <= end && end <= dem->inner.n);
    piece s;
    int32_t n_active = 0;
    for (int32_t at = begin; at < end; at += PIECE) {
        begin_piece(dem, at, force + (at - begin), &s);
        const int n = find_piece(dem, end - at < PIECE ? end - at : PIECE, &s, active + n_active);
        for (int k = 0; k < n && at > begin; ++k) {
            active[n_active + k].at += at - begin;
        }
        n_active += n;
    }
    return n_active;
}

static void find_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_dem *dem = context;
    clx_active_pair active[PIECE];
    piece s;
    (void)worker;
    begin_piece(dem, begin, dem->inner.force + begin, &s);
    memset(s.force, 0, (size_t)(end - begin) * sizeof *s.force); // of skipped pairs
    (void)find_piece(dem, (int)(end - begin), &s, active);
}

void clx_contacts_again(const clast_dem *dem, int32_t n, clx_packed_pair *packed,
                        clx_pair_force *force, clx_dem_touch *touch)
{
    static_assert((int)CLX_MOST_AGAIN <= (int)PIECE, "one piece");
    CLAST_ASSERT(n >= 1 && n <= CLX_MOST_AGAIN && dem->item == NULL && !dem->law.has_history);
    clast_dem copy = *dem; // whose inner list is these pairs
    clx_active_pair active[PIECE];
    piece s;
    memset(packed + n, 0, CLX_PREFETCH_PAIRS * sizeof *packed);
    copy.inner.n = n;
    copy.inner.packed = packed;
    copy.inner.is_packed = true;
    begin_piece(&copy, 0, force, &s);
    s.touch = touch;
    (void)find_piece(&copy, n, &s, active);
}

/// Contacts of items with the container, which are decided for all triangles of an item at once.
static void contain_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_dem *dem = context;
    const clx_inner_list *inner = &dem->inner;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        clx_container_touch touch[CLX_CONTAINER_TOUCHES];
        int32_t at = inner->begin[i];
        if (at == inner->begin[i + 1] ||
            !clx_pair_is_container(dem, &dem->list.pair[inner->index[at]])) {
            continue; // pairs with the container come first
        }
        const int32_t n = clx_container_meet(dem, (int32_t)i, touch);
        for (; at < inner->begin[i + 1]; ++at) {
            clx_dem_pair *pair = &dem->list.pair[inner->index[at]];
            if (!clx_pair_is_container(dem, pair)) {
                break;
            }
            inner->force[at] = (clx_pair_force){0};
            for (int32_t k = 0; k < n; ++k) {
                if (touch[k].pair == inner->index[at]) {
                    force_of_pair(dem, pair, &touch[k].touch, &inner->force[at]);
                }
            }
        }
    }
}

/// Grains below which one thread works alone. A guess, not measured: a step of 1500 grains takes
/// about as long as waking a thread ten times.
enum { SERIAL_BELOW = 1500 };

bool clx_dem_is_serial(const clast_dem *dem)
{
    return clx_parallel_workers() == 1 || dem->n_grain < SERIAL_BELOW;
}

void clx_dem_for(const clast_dem *dem, int64_t n, int64_t block, clx_kernel kernel, void *context)
{
    CLAST_ASSERT(n >= 0 && block > 0);
    if (!clx_dem_is_serial(dem)) {
        clx_parallel_for(n, block, kernel, context);
        return;
    }
    for (int64_t begin = 0; begin < n; begin += block) {
        kernel(begin, begin + block < n ? begin + block : n, 0, context);
    }
}

void clx_contacts(clast_dem *dem)
{
    clx_dem_for(dem, dem->inner.n, PIECE, find_block, dem);
    if (dem->container != NULL) {
        clx_dem_for(dem, dem->n_item, BLOCK, contain_block, dem);
    }
    if (dem->item != NULL && dem->config.clump_contacts == CLAST_DEM_SHARED) {
        clx_dem_for(dem, dem->n_grain, BLOCK, clx_share_forces, dem);
    }
}
