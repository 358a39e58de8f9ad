// Walls over ranks: every rank moves all of them alike, from the same sums.
//
// What grains do to a wall is a sum of floating-point numbers, so its order is that of one rank: by
// grain, each with its contacts in the order of its list. A rank has all contacts of the grains
// that it moves; so all get the contacts of all, sort them by grain, and add them up.
#include "dem/ranks.h"

#include "base/alloc.h"
#include <clast/machine.h>
#include <clast/status.h>
#include <stdlib.h>

static int by_grain(const void *left, const void *right)
{
    const clx_wall_force *a = left;
    const clx_wall_force *b = right;
    return a->number != b->number ? (a->number > b->number) - (a->number < b->number)
                                  : (a->order > b->order) - (a->order < b->order);
}

/// The contacts of all ranks in the order of one; what failed on one before fails on all.
static clast_status share(const clx_ranks *r, clast_status status, int64_t n,
                          const clx_wall_force *wall_force, clx_gathered *all)
{
    CLX_TRY(clast_comm_agree(r->comm, status, NULL));
    CLX_TRY(clx_comm_share(r->comm, wall_force, n * (int64_t)sizeof *wall_force, all));
    if (all->n > 0) {
        qsort(all->bytes, (size_t)all->n / sizeof *wall_force, sizeof *wall_force, by_grain);
    }
done:
    return status;
}

clast_status clx_ranks_add_walls(clast_dem *whole)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    clx_walls *walls = &r->local->walls;
    clx_gathered all = {0};
    if (!walls->is_watched) {
        return CLAST_OK;
    }
    CLX_TRY(share(r, CLAST_OK, walls->n_wall_force, walls->wall_force, &all));
    clx_walls_add_gathered(r->local, all.n / (int64_t)sizeof(clx_wall_force),
                           (const clx_wall_force *)(const void *)all.bytes);
    r->counts.step_bytes += walls->n_wall_force * (int64_t)sizeof(clx_wall_force);
    walls->n_wall_force = 0;
done:
    clx_gathered_free(&all);
    return status;
}

clast_status clx_wall_stiffness(const clast_dem *dem, int32_t wall, const double along[3],
                                double *sum)
{
    clast_status status = CLAST_OK;
    const bool is_spread = dem->ranks != NULL && dem->ranks->has_begun;
    const clast_dem *from = is_spread ? dem->ranks->local : dem;
    clx_gathered all = {0};
    clx_wall_force *wall_force = NULL;
    int64_t n = 0;
    double total = 0.0;
    status = is_spread ? clx_alloc(&wall_force, from->list.n_pair, sizeof *wall_force) : CLAST_OK;
    for (int64_t k = 0; k < from->list.n_pair && status == CLAST_OK; ++k) {
        const clx_dem_pair *pair = &from->list.pair[k];
        const double spring = clx_wall_spring(from, pair, wall, along);
        if (!is_spread) {
            total += spring;
        } else if (spring != 0.0 && !clx_are_ghosts(from, pair->a, pair->a)) {
            wall_force[n] = (clx_wall_force){
                .number = clx_grain_number(from, clx_item_grain(from, pair->a)), .order = n};
            wall_force[n++].force[0] = spring;
        }
    }
    if (is_spread) {
        CLX_TRY(share(dem->ranks, status, n, wall_force, &all));
    }
    for (int64_t k = 0; k < all.n / (int64_t)sizeof *wall_force; ++k) {
        total += ((const clx_wall_force *)(const void *)all.bytes)[k].force[0];
    }
    *sum = total;
done:
    clx_free(wall_force);
    clx_gathered_free(&all);
    return status;
}

bool clx_dem_any_beyond(const clast_dem *dem, int axis, double sign, double at)
{
    const clx_ranks *r = dem->ranks;
    const bool is_spread = r != NULL && r->has_begun && !r->is_current;
    const clast_dem *from = is_spread ? r->local : dem;
    bool is_any = false;
    for (int32_t i = 0; i < from->n_grain; ++i) {
        is_any = is_any || ((!is_spread || r->is_ghost[i] == 0) &&
                            sign * (from->grain[i].position[axis] - at) < 0.0);
    }
    return is_spread ? r->comm->least(r->comm->context, is_any ? 0 : 1) == 0 : is_any;
}

clast_status clx_dem_gather_load(clast_dem *dem, clast_dem_load *load, clast_dem_energy *energy)
{
    clast_status status = CLAST_OK;
    const clx_ranks *r = dem->ranks;
    CLX_TRY(clx_dem_gather_all(dem));
    if (r == NULL || r->comm->rank == 0) {
        status = clast_dem_load_measure(dem, load);
        clast_dem_energy_measure(dem, energy);
    }
    if (r != NULL) {
        CLX_TRY(clast_comm_agree(r->comm, status, NULL));
        r->comm->broadcast(r->comm->context, 0, load, (int64_t)sizeof *load);
        r->comm->broadcast(r->comm->context, 0, energy, (int64_t)sizeof *energy);
    }
done:
    return status;
}
