// Several contacts of one pair of bodies: each takes its share of the pair's stiffness.
//
// k_n of the laws is that of a pair of bodies. Where clumps touch in n spheres at once, n springs
// would stand side by side; each gets 1/n [Kodam2009]. Springs, dashpots, Coulomb's limit and
// attraction all scale alike and the tangential displacement does not, so it is the forces that are
// divided.
#include "dem/container.h"
#include "dem/pair_force.h"
#include "dem/touch.h"
#include "math/vec3.h"

/// Triangles whose contact forces are closer than this cosine are one wall.
static const double SAME_WALL = 0.9;

/// Normal of a pair's triangle, on the side on which its item is.
static void force_normal(const clast_dem *dem, const clx_dem_pair *pair, double normal[3])
{
    const clx_wall_triangle *t = clx_pair_triangle(dem, pair);
    double d[3];
    v3_sub(d, clx_item_position(dem, pair->a), t->centroid);
    v3_scale(normal, v3_dot(d, t->normal) < 0.0 ? -1.0 : 1.0, t->normal);
}

/// Whether a wall's forces on two items have one direction: a cylinder may have a long grain's both
/// ends.
static bool is_same_side(const clast_dem *dem, const clx_dem_pair *p, const clx_dem_pair *q)
{
    const clx_wall *wall = &dem->wall[-1 - p->b];
    double of_p[3];
    double of_q[3];
    (void)clx_wall_distance(wall, clx_item_position(dem, p->a), of_p);
    (void)clx_wall_distance(wall, clx_item_position(dem, q->a), of_q);
    return v3_dot(of_p, of_q) > SAME_WALL;
}

static bool is_same_pair(const clast_dem *dem, const clx_dem_pair *p, const clx_dem_pair *q)
{
    if (clx_pair_is_container(dem, p) && clx_pair_is_container(dem, q)) {
        const int32_t *owner = dem->container->owner;
        double of_p[3];
        double of_q[3];
        force_normal(dem, p, of_p);
        force_normal(dem, q, of_q);
        return owner[-1 - p->b - dem->n_wall] == owner[-1 - q->b - dem->n_wall] &&
               v3_dot(of_p, of_q) > SAME_WALL;
    }
    if (p->b < 0 || q->b < 0) {
        return p->b == q->b && is_same_side(dem, p, q);
    }
    return dem->item[p->b].grain == dem->item[q->b].grain && p->period[0] == q->period[0] &&
           p->period[1] == q->period[1];
}

int32_t clx_sub_contacts(const clast_dem *dem, const clx_dem_pair *pair)
{
    const clx_neighbour_list *l = &dem->list;
    int32_t n = 0;
    if (dem->item == NULL) {
        return 1;
    }
    const int32_t g = dem->item[pair->a].grain;
    const int64_t end = l->begin[dem->item_begin[g + 1]];
    for (int64_t k = l->begin[dem->item_begin[g]]; k < end; ++k) {
        const clx_dem_pair *other = &l->pair[k];
        n += other->touches != 0 && is_same_pair(dem, pair, other) ? 1 : 0;
    }
    return n > 0 ? n : 1;
}

bool clx_pair_holds(const clast_dem *dem, const clx_dem_pair *pair, clx_dem_touch *touch)
{
    *touch = (clx_dem_touch){0};
    if (pair->touches == 0) {
        return false;
    }
    clx_find_again(dem, pair, touch);
    return touch->distance < 0.0 || touch->distance < clx_pair_neck(dem, pair);
}

bool clx_is_first_contact(const clast_dem *dem, const clx_dem_pair *pair)
{
    const clx_neighbour_list *l = &dem->list;
    clx_dem_touch touch;
    if (dem->item == NULL) {
        return true;
    }
    const int32_t g = dem->item[pair->a].grain;
    for (const clx_dem_pair *k = l->pair + l->begin[dem->item_begin[g]]; k < pair; ++k) {
        if (is_same_pair(dem, pair, k) && clx_pair_holds(dem, k, &touch)) {
            return false;
        }
    }
    return true;
}

static void divide(clx_pair_force *force, int32_t n)
{
    CLAST_ASSERT(n >= 1);
    const double share = 1.0 / n;
    for (int k = 0; k < 4; ++k) {
        force->force[k] *= share;
        force->torque_a[k] *= share;
        force->torque_b[k] *= share;
    }
}

/// Divides the forces of one grain's own contacts.
static void share(clast_dem *dem, int32_t g)
{
    CLAST_ASSERT(g >= 0 && g < dem->n_grain && dem->item_begin != NULL);
    const clx_inner_list *inner = &dem->inner;
    const int32_t begin = inner->begin[dem->item_begin[g]];
    const int32_t end = inner->begin[dem->item_begin[g + 1]];
    for (int32_t i = begin; i < end; ++i) {
        const clx_dem_pair *pair = &dem->list.pair[inner->index[i]];
        int32_t n = 0;
        if (pair->touches == 0) {
            continue;
        }
        for (int32_t k = begin; k < end; ++k) {
            const clx_dem_pair *other = &dem->list.pair[inner->index[k]];
            n += other->touches != 0 && is_same_pair(dem, pair, other) ? 1 : 0;
        }
        if (n > 1) {
            divide(&inner->force[i], n);
        }
    }
}

void clx_share_forces(int64_t begin, int64_t end, int32_t worker, void *context)
{
    (void)worker;
    for (int64_t g = begin; g < end; ++g) {
        share(context, (int32_t)g);
    }
}
