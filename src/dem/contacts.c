// Forces of all contacts, once a step.
//
// Loads are summed in one fixed order, whatever the threads: on each grain first the pairs whose b
// it is, in the order of the list, then the sums over its items' own lists. One thread adds
// straight into the grains; several keep the loads on b with the pair and gather them per grain,
// which gives the same bytes.
#include "dem/dem.h"

#include "base/parallel.h"
#include "dem/touch.h"

enum { BLOCK = 128 };

/// Velocity of b's surface relative to a's at the contact point, and spins.
static inline void approach(const clx_grain *a, const clx_grain *b, const clx_dem_touch *t,
                            clx_meeting *m)
{
    double u[3];
    double w[3];
    v3_cross(u, a->spin, t->arm_a);
    v3_add(u, u, a->velocity);
    v3_cross(w, b->spin, t->arm_b);
    v3_add(w, w, b->velocity);
    v3_sub(m->velocity, w, u);
    v3_sub(m->roll, b->spin, a->spin);
    m->twirl = 0.5 * (v3_dot(a->spin, t->normal) + v3_dot(b->spin, t->normal));
}

static inline void add_push(const clx_dem_touch *t, const clx_push *push, bool normal_torque,
                            clx_load *on_a, clx_load *on_b)
{
    double force[3];
    double turning[3];
    double torque[3];
    v3_axpy(force, push->tangential, push->normal, t->normal);
    v3_add(on_b->force, on_b->force, force);
    v3_sub(on_a->force, on_a->force, force);
    v3_copy(turning, normal_torque ? force : push->tangential);
    v3_cross(torque, t->arm_b, turning);
    v3_add(torque, torque, push->rolling); // one sum a contact: the gathered one has the same bytes
    v3_add(on_b->torque, on_b->torque, torque);
    v3_cross(torque, t->arm_a, turning);
    v3_add(torque, torque, push->rolling);
    v3_sub(on_a->torque, on_a->torque, torque);
}

static const clx_grain immovable = {.kind = CLAST_SHAPE_SPHERE};

/// Reduced moment of inertia, of spheres of equal volume: only a bound of the rolling torque.
static double reduced_inertia(const clx_grain *a, const clx_grain *b)
{
    const double ia = 0.4 * a->mass * a->round_radius * a->round_radius;
    const double ib = 0.4 * b->mass * b->round_radius * b->round_radius;
    return b->mass > 0.0 ? ia * ib / (ia + ib) : ia;
}

static inline double radius_of(const clast_dem *dem, int32_t item)
{
    return dem->item != NULL && dem->item[item].part >= 0
               ? dem->item[item].radius
               : dem->grain[clx_item_grain(dem, item)].round_radius;
}

/// A pair that touches.
static inline void push_pair(const clast_dem *dem, clx_link *p, const clx_dem_touch *t,
                             clx_load *on_a, clx_load *on_b)
{
    const clx_grain *a = &dem->grain[clx_item_grain(dem, p->a)];
    const clx_grain *b = p->b >= 0 ? &dem->grain[clx_item_grain(dem, p->b)] : &immovable;
    const bool needs_radius = dem->law.kind != CLAST_DEM_LINEAR ||
                              dem->law.cohesion != CLAST_DEM_DRY || dem->law.rolling > 0.0;
    const double ra = needs_radius ? radius_of(dem, p->a) : 0.0;
    clx_meeting m;
    clx_push push;
    m.overlap = -t->distance;
    v3_copy(m.normal, t->normal);
    approach(a, b, t, &m);
    if (p->b >= 0) {
        m.mass = a->mass * b->mass / (a->mass + b->mass);
        m.radius = 0.0;
        if (needs_radius) {
            const double rb = radius_of(dem, p->b);
            m.radius = ra * rb / (ra + rb);
        }
        m.friction = dem->law.friction[0];
    } else {
        m.mass = a->mass;
        m.radius = ra;
        m.friction = dem->law.friction[1];
    }
    clx_law_force(&dem->law, &m, dem->config.time_step, p->slide, &push);
    v3_set(push.rolling, 0.0, 0.0, 0.0);
    if (dem->law.rolling > 0.0) {
        clx_law_roll(&dem->law, &m, reduced_inertia(a, b), dem->config.time_step, &push);
    }
    add_push(t, &push, dem->config.normal_torque, on_a, on_b);
}

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
    push_pair(dem, p, &t, on_a, on_b);
    return true;
}

static void meet_serial(clast_dem *dem)
{
    for (int32_t i = 0; i < dem->n_item; ++i) {
        clx_load own = {0};
        for (int64_t k = dem->list.begin[i]; k < dem->list.begin[i + 1]; ++k) {
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
        for (int64_t k = dem->list.begin[i]; k < dem->list.begin[i + 1]; ++k) {
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
