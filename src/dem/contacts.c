// What all contacts do, once a step.
//
// Awake pairs are sorted by how they are answered and go on four at a time (batch.h); what lanes
// cannot answer goes one by one. A contact writes its own slots only, so blocks run in any order.
// Loads are summed afterwards, in motion.c.
#include "dem/batch.h"

#include "base/parallel.h"
#include "contact/ellipsoid_lanes.h"
#include "contact/facet.h"
#include "dem/container.h"
#include <string.h>

enum { BLOCK = 256 };

static clx_batch_kind kind_of(const clast_dem *dem, const clx_link *link)
{
    if (dem->item != NULL || link->b < 0) {
        return CLX_BATCH_ANY;
    }
    if (link->slot == 0) {
        return CLX_BATCH_SPHERES; // else clx_near_find had given it a memory
    }
    switch (dem->list.memory[link->slot].kind) {
    case CLX_FACET_EDGE_EDGE:
        return CLX_BATCH_EDGES;
    case CLX_FACET_NONE:
        return dem->grain[link->a].kind == CLAST_SHAPE_ELLIPSOID &&
                       dem->grain[link->b].kind == CLAST_SHAPE_ELLIPSOID
                   ? CLX_BATCH_ELLIPSOIDS
                   : CLX_BATCH_ANY;
    default:
        return CLX_BATCH_FACES;
    }
}

/// Lane k alone, by the plain way.
static void find_one(clast_dem *dem, clx_batch *p, int k)
{
    clx_dem_touch t = {0};
    clx_link *link = p->link[k];
    clx_dem_touch_find(dem, link, clx_link_memory(dem, link), &t);
    p->distance[k] = t.distance;
    for (int c = 0; c < 3; ++c) {
        p->normal[c][k] = t.normal[c];
        p->arm_a[c][k] = t.arm_a[c];
        p->arm_b[c][k] = t.arm_b[c];
    }
}

/// As clx_pair_contact does for one.
static void add_rounding(const clast_dem *dem, const clx_batch *p, clx_facet_batch *f)
{
    for (int k = 0; k < CLX_LANES; ++k) {
        const double round_a = dem->convex[p->link[k]->a].round;
        const double round_b = dem->convex[p->link[k]->b].round;
        f->gap[k] -= round_a + round_b;
        for (int c = 0; c < 3; ++c) {
            f->point[c][k] += 0.5 * (round_b - round_a) * f->normal[c][k];
        }
    }
}

/// Remembered facets; returns which lanes are answered.
static int ask_facets(const clast_dem *dem, clx_batch *p, clx_batch_kind kind)
{
    clx_facet_batch f;
    clx_batch_offsets(dem, p);
    for (int k = 0; k < CLX_LANES; ++k) {
        f.turn_a[k] = p->a[k]->turn[0];
        f.turn_b[k] = p->b[k]->turn[0];
        f.memory[k] = &dem->list.memory[p->link[k]->slot];
    }
    memcpy(f.offset, p->offset, sizeof f.offset);
    const int answered =
        kind == CLX_BATCH_FACES ? clx_facet_faces_again(&f) : clx_facet_edges_again(&f);
    if (dem->config.rounding > 0.0) {
        add_rounding(dem, p, &f);
    }
    memcpy(p->distance, f.gap, sizeof f.gap);
    memcpy(p->arm_a, f.point, sizeof f.point);
    for (int c = 0; c < 3; ++c) {
        for (int k = 0; k < CLX_LANES; ++k) {
            p->normal[c][k] = -1.0 * f.normal[c][k];
            p->arm_b[c][k] = f.point[c][k] - p->offset[c][k];
        }
    }
    return answered;
}

/// Remembered common normals; returns which lanes are answered.
static int ask_normals(const clast_dem *dem, clx_batch *p)
{
    clx_ellipsoid_batch e;
    clx_batch_offsets(dem, p);
    for (int k = 0; k < CLX_LANES; ++k) {
        e.turn_a[k] = p->a[k]->turn[0];
        e.turn_b[k] = p->b[k]->turn[0];
        e.a[k] = &dem->convex[p->link[k]->a];
        e.b[k] = &dem->convex[p->link[k]->b];
        e.memory[k] = &dem->list.memory[p->link[k]->slot];
    }
    memcpy(e.offset, p->offset, sizeof e.offset);
    const int answered = clx_ellipsoids_again(&e);
    memcpy(p->distance, e.gap, sizeof e.gap);
    memcpy(p->arm_a, e.point, sizeof e.point);
    for (int k = 0; k < p->n; ++k) {
        clx_contact_memory *memory = &dem->list.memory[p->link[k]->slot];
        for (int c = 0; c < 3 && (answered >> k & 1) != 0; ++c) {
            memory->seen[0][c] = (float)e.normal[c][k];
        }
    }
    for (int c = 0; c < 3; ++c) {
        for (int k = 0; k < CLX_LANES; ++k) {
            p->normal[c][k] = -1.0 * e.normal[c][k];
            p->arm_b[c][k] = e.point[c][k] - p->offset[c][k];
        }
    }
    return answered;
}

/// Where the pairs of a batch meet.
static void find_all(clast_dem *dem, clx_batch *p, clx_batch_kind kind)
{
    int answered = 0;
    if (kind == CLX_BATCH_SPHERES) {
        clx_batch_offsets(dem, p);
        clx_batch_spheres(p);
        return;
    }
    if (kind == CLX_BATCH_ELLIPSOIDS) {
        answered = ask_normals(dem, p);
    } else if (kind != CLX_BATCH_ANY) {
        answered = ask_facets(dem, p, kind);
    }
    for (int k = 0; k < p->n; ++k) {
        if ((answered >> k & 1) == 0) {
            find_one(dem, p, k);
        }
    }
}

static void part(clast_dem *dem, const clx_batch *p, int k)
{
    clx_link *link = p->link[k];
    link->wake = p->travel[k] + p->distance[k];
    link->touches = 0;
    v3_set(link->slide, 0.0, 0.0, 0.0);
    dem->near.push[p->at[k]] = (clx_pushed){0};
}

/// What a pair that touches does, by the plain way.
static void push_alone(clast_dem *dem, clx_link *link, const clx_dem_touch *t, int32_t at)
{
    clx_load on_a = {0};
    clx_load on_b = {0};
    clx_pushed *out = &dem->near.push[at];
    clx_push_pair(dem, &dem->law, link, t, &on_a, &on_b);
    *out = (clx_pushed){0};
    v3_copy(out->force, on_b.force);
    v3_copy(out->torque_b, on_b.torque);
    v3_scale(out->torque_a, -1.0, on_a.torque);
}

static void push_one(clast_dem *dem, const clx_batch *p, int k)
{
    clx_dem_touch t = {.distance = p->distance[k]};
    for (int c = 0; c < 3; ++c) {
        t.normal[c] = p->normal[c][k];
        t.arm_a[c] = p->arm_a[c][k];
        t.arm_b[c] = p->arm_b[c][k];
    }
    push_alone(dem, p->link[k], &t, p->at[k]);
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
        if (p->distance[k] >= 0.0 && !(p->distance[k] < clx_link_neck(dem, p->link[k]))) {
            part(dem, p, k);
        } else {
            p->link[k]->touches = 1;
            touching |= 1 << k;
        }
    }
    if (touching != 0 && clx_batch_has_law(&dem->law)) {
        clx_batch_push(dem, p, touching);
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
enum { LINK_AHEAD = 16, REST_AHEAD = 8 };

static inline void fetch_ahead(const clast_dem *dem, int64_t at)
{
    const int64_t n = dem->near.n;
    if (at + LINK_AHEAD < n) {
        __builtin_prefetch(&dem->list.link[dem->near.link[at + LINK_AHEAD]], 1);
    }
    if (at + REST_AHEAD < n) {
        const clx_link *link = &dem->list.link[dem->near.link[at + REST_AHEAD]];
        const char *push = (const char *)&dem->near.push[at + REST_AHEAD];
        __builtin_prefetch(push, 1);
        __builtin_prefetch(push + 64, 1);
        if (link->slot != 0) {
            const char *memory = (const char *)&dem->list.memory[link->slot];
            __builtin_prefetch(memory);
            __builtin_prefetch(memory + 64);
            __builtin_prefetch(memory + 128);
        }
        if (link->b >= 0) {
            const char *b = (const char *)&dem->grain[clx_item_grain(dem, link->b)];
            __builtin_prefetch(b);
            __builtin_prefetch(b + 64);
            __builtin_prefetch(b + 128);
        }
    }
}

void clx_contacts_among(clast_dem *dem, int64_t begin, int64_t end, int64_t base)
{
    clx_batch batch[CLX_N_BATCH];
    for (int kind = 0; kind < CLX_N_BATCH; ++kind) {
        batch[kind].n = 0;
    }
    for (int64_t at = begin; at < end; ++at) {
        clx_link *link = &dem->list.link[dem->near.link[at]];
        fetch_ahead(dem, at);
        const int32_t a = clx_item_grain(dem, link->a);
        const int32_t b = link->b >= 0 ? clx_item_grain(dem, link->b) : -1;
        const double travel = dem->travel[a] + (b >= 0 ? dem->travel[b] : 0.0);
        if (travel < link->wake || clx_link_is_container(dem, link)) {
            continue;
        }
        const clx_batch_kind kind = kind_of(dem, link);
        clx_batch *p = &batch[kind];
        p->at[p->n] = (int32_t)(at - base);
        p->link[p->n] = link;
        p->travel[p->n] = travel;
        p->a[p->n] = &dem->grain[a];
        p->b[p->n] = b >= 0 ? &dem->grain[b] : &clx_immovable;
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
    (void)worker;
    clx_contacts_among(context, begin, end, 0);
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
                    push_alone(dem, link, &touch[k].touch, at);
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
