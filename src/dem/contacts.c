// Forces of all contacts, once a step.
//
// Loads are summed in one fixed order, whatever the threads: on each grain first the pairs whose b
// it is, in the order of the list, then the sums over its items' own lists. One thread adds
// straight into the grains; several keep the loads on b with the pair and gather them per grain,
// which gives the same bytes.
#include "dem/dem.h"

#include "base/parallel.h"
#include "dem/container.h"
#include "dem/push.h"

enum { BLOCK = 128 };

/// A pair of the list: asleep, apart, or in touch. True when it loaded its grains.
static inline bool meet(const clast_dem *dem, clx_link *p, clx_load *on_a, clx_load *on_b)
{
    const double travel = dem->travel[clx_item_grain(dem, p->a)] +
                          (p->b >= 0 ? dem->travel[clx_item_grain(dem, p->b)] : 0.0);
    if (travel < p->wake) {
        return false;
    }
    clx_dem_touch t = {0};
    clx_dem_touch_find(dem, p, clx_link_memory(dem, p), &t);
    if (t.distance >= 0.0) {
        p->wake = travel + t.distance;
        p->flags = 0;
        v3_set(p->slide, 0.0, 0.0, 0.0);
        return false;
    }
    p->flags = CLX_LINK_TOUCHES;
    clx_push_pair(dem, &dem->law, p, &t, on_a, on_b);
    return true;
}

/// Contacts of an item with the container, which stand first in its list; the first link after.
static inline int64_t meet_container(clast_dem *dem, int32_t i, clx_load *own)
{
    if (dem->container == NULL) {
        return dem->list.begin[i];
    }
    clx_load wall = {0};
    clx_container_touch touch[CLX_CONTAINER_TOUCHES];
    const int32_t n = clx_container_meet(dem, i, touch);
    for (int32_t k = 0; k < n; ++k) {
        clx_push_pair(dem, &dem->law, &dem->list.link[touch[k].link], &touch[k].touch, own, &wall);
    }
    return clx_container_end(dem, i);
}

static void meet_serial(clast_dem *dem)
{
    for (int32_t i = 0; i < dem->n_item; ++i) {
        clx_load own = {0};
        for (int64_t k = meet_container(dem, i, &own); k < dem->list.begin[i + 1]; ++k) {
            clx_link *p = &dem->list.link[k];
            clx_load wall = {0};
            clx_load *on_b = p->b >= 0 ? &dem->load[clx_item_grain(dem, p->b)] : &wall;
            (void)meet(dem, p, &own, on_b);
        }
        clx_load *load = &dem->load[clx_item_grain(dem, i)];
        v3_add(load->force, load->force, own.force);
        v3_add(load->torque, load->torque, own.torque);
    }
}

static void meet_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_dem *dem = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        clx_load own = {0};
        for (int64_t k = meet_container(dem, (int32_t)i, &own); k < dem->list.begin[i + 1]; ++k) {
            clx_load on_b = {0};
            if (meet(dem, &dem->list.link[k], &own, &on_b)) {
                dem->hit[k] = on_b;
            }
        }
        dem->own[i] = own;
    }
}

static void gather_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_dem *dem = context;
    (void)worker;
    for (int64_t g = begin; g < end; ++g) {
        clx_load sum = {0};
        for (int64_t k = dem->list.in_begin[g]; k < dem->list.in_begin[g + 1]; ++k) {
            const int64_t p = dem->list.in_link[k];
            if ((dem->list.link[p].flags & CLX_LINK_TOUCHES) != 0) {
                v3_add(sum.force, sum.force, dem->hit[p].force);
                v3_add(sum.torque, sum.torque, dem->hit[p].torque);
            }
        }
        const int32_t first = dem->item_begin != NULL ? dem->item_begin[g] : (int32_t)g;
        const int32_t last = dem->item_begin != NULL ? dem->item_begin[g + 1] : (int32_t)g + 1;
        for (int32_t i = first; i < last; ++i) {
            v3_add(sum.force, sum.force, dem->own[i].force);
            v3_add(sum.torque, sum.torque, dem->own[i].torque);
        }
        dem->load[g] = sum;
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
    if (dem->list.in_begin != NULL) {
        clx_dem_for(dem, dem->n_item, BLOCK, meet_block, dem);
        clx_dem_for(dem, dem->n_grain, BLOCK, gather_block, dem);
        return;
    }
    for (int32_t g = 0; g < dem->n_grain; ++g) {
        dem->load[g] = (clx_load){0};
    }
    meet_serial(dem);
}
