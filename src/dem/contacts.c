// What all contacts do, once a step.
//
// Awake pairs are sorted by how they are answered and go on four at a time (batch.h); what lanes
// cannot answer goes one by one. A contact writes its own slots only, so blocks run in any order.
// Loads are summed afterwards, in motion.c, block by block where one thread sweeps over all.
#include "dem/batch.h"

#include "base/parallel.h"
#include "contact/ellipsoid_lanes.h"
#include "contact/facet.h"
#include "dem/container.h"
#include <string.h>

enum { BLOCK = 256 };

static inline clx_batch_kind kind_of(const clx_link *link, const clx_grain *a, const clx_grain *b)
{
    if (link->kind != CLX_FACET_NONE) {
        return link->kind == CLX_FACET_EDGE_EDGE ? CLX_BATCH_EDGES : CLX_BATCH_FACES;
    }
    if (link->slot == 0) {
        return CLX_BATCH_SPHERES; // else clx_near_find had given it a memory
    }
    return a->kind == CLAST_SHAPE_ELLIPSOID && b->kind == CLAST_SHAPE_ELLIPSOID
               ? CLX_BATCH_ELLIPSOIDS
               : CLX_BATCH_ANY;
}

/// Lane k alone, by the plain way.
static void find_one(clast_dem *dem, clx_batch *p, int k)
{
    clx_dem_touch t = {0};
    clx_link *link = p->link[k];
    clx_contact_memory *memory = clx_link_memory(dem, link);
    clx_dem_touch_find(dem, link, memory, &t);
    if (memory != NULL) {
        link->kind = memory->kind & 3U;
    }
    p->meet.gap[k] = t.distance;
    for (int c = 0; c < 3; ++c) {
        p->meet.normal[c][k] = -t.normal[c];
        p->meet.point[c][k] = t.arm_a[c];
        p->arm_b[c][k] = t.arm_b[c];
    }
}

/// As clx_pair_contact does for one.
static void add_rounding(const clast_dem *dem, clx_batch *p)
{
    clx_pair_batch *f = &p->meet;
    for (int k = 0; k < CLX_LANES; ++k) {
        const double round_a = dem->convex[p->link[k]->a].round;
        const double round_b = dem->convex[p->link[k]->b].round;
        f->gap[k] -= round_a + round_b;
        for (int c = 0; c < 3; ++c) {
            f->point[c][k] += 0.5 * (round_b - round_a) * f->normal[c][k];
        }
    }
}

static void take_poses(const clast_dem *dem, clx_batch *p)
{
    for (int k = 0; k < CLX_LANES; ++k) {
        p->meet.turn_a[k] = p->a[k]->turn[0];
        p->meet.turn_b[k] = p->b[k]->turn[0];
        p->meet.memory[k] = &dem->list.memory[p->link[k]->slot];
    }
}

/// Remembered facets; returns which lanes are answered.
static int ask_facets(const clast_dem *dem, clx_batch *p, clx_batch_kind kind)
{
    take_poses(dem, p);
    const int answered =
        kind == CLX_BATCH_FACES ? clx_facet_faces_again(&p->meet) : clx_facet_edges_again(&p->meet);
    if (dem->config.rounding > 0.0) {
        add_rounding(dem, p);
    }
    return answered;
}

/// Remembered common normals; returns which lanes are answered.
static int ask_normals(const clast_dem *dem, clx_batch *p)
{
    const clx_convex *a[CLX_LANES];
    const clx_convex *b[CLX_LANES];
    take_poses(dem, p);
    for (int k = 0; k < CLX_LANES; ++k) {
        a[k] = &dem->convex[p->link[k]->a];
        b[k] = &dem->convex[p->link[k]->b];
    }
    const int answered = clx_ellipsoids_again(&p->meet, a, b);
    for (int k = 0; k < p->n; ++k) {
        clx_contact_memory *memory = &dem->list.memory[p->link[k]->slot];
        for (int c = 0; c < 3 && (answered >> k & 1) != 0; ++c) {
            memory->seen[0][c] = (float)p->meet.normal[c][k];
        }
    }
    return answered;
}

/// Where the pairs of a batch meet.
static void find_all(clast_dem *dem, clx_batch *p, clx_batch_kind kind)
{
    int answered = 0;
    if (kind != CLX_BATCH_ANY) {
        clx_batch_offsets(dem, p);
        if (kind == CLX_BATCH_SPHERES) {
            clx_batch_spheres(p);
            return;
        }
        answered = kind == CLX_BATCH_ELLIPSOIDS ? ask_normals(dem, p) : ask_facets(dem, p, kind);
        clx_batch_arms(p);
    }
    for (int k = 0; k < p->n; ++k) {
        if ((answered >> k & 1) == 0) {
            find_one(dem, p, k);
        }
    }
}

static void part(const clx_batch *p, int k)
{
    clx_link *link = p->link[k];
    link->wake = p->travel[k] + p->meet.gap[k];
    link->touches = 0;
    v3_set(link->slide, 0.0, 0.0, 0.0);
    *p->to[k] = (clx_pushed){0};
}

/// What a pair that touches does, by the plain way.
static void push_alone(const clast_dem *dem, clx_link *link, const clx_dem_touch *t,
                       clx_pushed *out)
{
    clx_load on_a = {0};
    clx_load on_b = {0};
    clx_push_pair(dem, &dem->law, link, t, &on_a, &on_b);
    *out = (clx_pushed){0};
    v3_copy(out->force, on_b.force);
    v3_copy(out->torque_b, on_b.torque);
    v3_scale(out->torque_a, -1.0, on_a.torque);
}

static void push_one(const clast_dem *dem, const clx_batch *p, int k)
{
    clx_dem_touch t = {.distance = p->meet.gap[k]};
    for (int c = 0; c < 3; ++c) {
        t.normal[c] = -p->meet.normal[c][k];
        t.arm_a[c] = p->meet.point[c][k];
        t.arm_b[c] = p->arm_b[c][k];
    }
    push_alone(dem, p->link[k], &t, p->to[k]);
}

/// Finds where the pairs meet and what those that touch do; empties the batch.
static void finish(clast_dem *dem, clx_batch *p, clx_batch_kind kind)
{
    int touching = 0;
    for (int k = p->n; k < CLX_LANES; ++k) {
        p->link[k] = p->link[0];
        p->a[k] = p->a[0];
        p->b[k] = p->b[0];
    }
    find_all(dem, p, kind);
    for (int k = 0; k < p->n; ++k) {
        if (p->meet.gap[k] >= 0.0 && !(p->meet.gap[k] < clx_link_neck(dem, p->link[k]))) {
            part(p, k);
        } else {
            p->link[k]->touches = 1;
            touching |= 1 << k;
        }
    }
    if (touching != 0 && clx_batch_has_law(&dem->law)) {
        clx_batch_push(dem, p, touching, kind == CLX_BATCH_ANY);
    } else {
        for (int k = 0; k < p->n; ++k) {
            if ((touching >> k & 1) != 0) {
                push_one(dem, p, k);
            }
        }
    }
    p->n = 0;
}

/// Contacts ahead whose link, and whose memory and grains, are asked for in advance: a bed of 4000
/// hulls does not stay in a second-level cache.
enum { LINK_AHEAD = 16, REST_AHEAD = 8, LINE = 64 };

// Always inlined: a function that does nothing but fetch looks free of effects to GCC, and a call
// of it is dropped. `objdump -d` shows eight prefetches in clx_contacts_among.
CLX_INLINE void fetch(const void *record, size_t bytes)
{
    for (size_t at = 0; at < bytes; at += LINE) {
        __builtin_prefetch((const char *)record + at);
    }
}

/// The arrays that the loop over contacts reads: what is written there moves none of them.
typedef struct {
    const int32_t *near;
    clx_link *link;
    const clx_contact_memory *memory;
    const clx_grain *grain;
    const clx_item *item;
    const double *travel;
    clx_load *load;
    int64_t n;
} arrays;

static inline int32_t grain_of(const arrays *s, int32_t item)
{
    return s->item != NULL ? s->item[item].grain : item;
}

CLX_INLINE void fetch_ahead(const arrays *s, int64_t at)
{
    if (at + LINK_AHEAD < s->n) {
        const clx_link *link = &s->link[s->near[at + REST_AHEAD]];
        __builtin_prefetch(&s->link[s->near[at + LINK_AHEAD]]);
        if (link->slot != 0) {
            fetch(&s->memory[link->slot], sizeof *s->memory + LINE / 2);
        }
        if (link->b >= 0) {
            const int32_t b = grain_of(s, link->b);
            fetch(&s->grain[b], sizeof *s->grain);
            fetch(&s->load[b], sizeof *s->load);
        }
    }
}

void clx_contacts_among(clast_dem *dem, int64_t begin, int64_t end, clx_pushed *push)
{
    clx_batch batch[CLX_N_BATCH];
    const arrays s = {dem->near.link, dem->list.link, dem->list.memory, dem->grain,
                      dem->item,      dem->travel,    dem->near.load,   dem->near.n};
    for (int kind = 0; kind < CLX_N_BATCH; ++kind) {
        batch[kind].n = 0;
    }
    for (int64_t at = begin; at < end; ++at) {
        clx_link *link = &s.link[s.near[at]];
        fetch_ahead(&s, at);
        const int32_t a = grain_of(&s, link->a);
        const int32_t b = link->b >= 0 ? grain_of(&s, link->b) : -1;
        const double travel = s.travel[a] + (b >= 0 ? s.travel[b] : 0.0);
        if (travel < link->wake || clx_link_is_container(dem, link)) {
            continue;
        }
        const clx_grain *on_b = b >= 0 ? &s.grain[b] : &clx_immovable;
        const clx_batch_kind kind =
            s.item != NULL || b < 0 ? CLX_BATCH_ANY : kind_of(link, &s.grain[a], on_b);
        clx_batch *p = &batch[kind];
        p->to[p->n] = push + (at - begin);
        p->link[p->n] = link;
        p->travel[p->n] = travel;
        p->a[p->n] = &s.grain[a];
        p->b[p->n] = on_b;
        if (++p->n == CLX_LANES) {
            finish(dem, p, kind);
        }
    }
    for (int kind = 0; kind < CLX_N_BATCH; ++kind) {
        if (batch[kind].n > 0) {
            finish(dem, &batch[kind], (clx_batch_kind)kind);
        }
    }
}

static void meet_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_dem *dem = context;
    (void)worker;
    clx_contacts_among(dem, begin, end, dem->near.push + begin);
}

/// Contacts of items with the container, which are decided for all triangles of an item at once.
static void contain_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_dem *dem = context;
    const clx_near *near = &dem->near;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        clx_container_touch touch[CLX_CONTAINER_TOUCHES];
        int32_t at = near->begin[i];
        if (at == near->begin[i + 1] ||
            !clx_link_is_container(dem, &dem->list.link[near->link[at]])) {
            continue; // they stand first
        }
        const int32_t n = clx_container_meet(dem, (int32_t)i, touch);
        for (; at < near->begin[i + 1]; ++at) {
            clx_link *link = &dem->list.link[near->link[at]];
            if (!clx_link_is_container(dem, link)) {
                break;
            }
            near->push[at] = (clx_pushed){0};
            for (int32_t k = 0; k < n; ++k) {
                if (touch[k].link == near->link[at]) {
                    push_alone(dem, link, &touch[k].touch, &near->push[at]);
                }
            }
        }
    }
}

/// Grains below which one thread works alone. A guess, not measured: a step of 1500 grains takes
/// about as long as ten wake-ups of a thread.
enum { FEW = 1500 };

bool clx_dem_is_serial(const clast_dem *dem)
{
    return clx_parallel_workers() == 1 || dem->n_grain < FEW;
}

void clx_dem_for(const clast_dem *dem, int64_t n, int64_t block, clx_kernel kernel, void *context)
{
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
    clx_dem_for(dem, dem->near.n, BLOCK, meet_block, dem);
    if (dem->container != NULL) {
        clx_dem_for(dem, dem->n_item, BLOCK, contain_block, dem);
    }
    if (dem->item != NULL && dem->config.clump_contacts == CLAST_DEM_SHARED) {
        clx_dem_for(dem, dem->n_grain, BLOCK, clx_share_pushes, dem);
    }
}
