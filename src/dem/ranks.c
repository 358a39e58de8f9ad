// A simulation over ranks, stepped.
//
// A step is that of one rank (dem.c) on the rank's own simulation, then: where the grains are that
// other ranks have pairs with, and whether some item anywhere has used up its margin, so that lists
// are refreshed in the same step as on one rank. What fails on one rank fails on all.
#include "dem/ranks.h"

#include "base/alloc.h"
#include "dem/fluid.h"
#include <clast/machine.h>
#include <clast/status.h>
#include <math.h>
#include <string.h>

/// Refreshes between looks at the balance, and the greatest over mean cost above which grains are
/// distributed anew.
enum { LOOK_EVERY = 16 };
static const double MOST_IMBALANCE = 1.15;

/// The same over what the last partition left, where it could do no better.
static const double WORSE = 1.1;

/// Strain of a cell since the last partition after which grains are distributed anew.
static const double MOST_STRAIN = 0.1;

clast_status clx_dem_share(clast_dem *dem, const clast_comm *comm)
{
    clast_status status = CLAST_OK;
    clx_ranks *made = NULL;
    if (comm == NULL || comm->n_rank == 1) {
        return CLAST_OK;
    }
    CLAST_ASSERT(dem->ranks == NULL);
    CLX_CHECK(clx_comm_has_sums(comm), CLAST_E_ARGUMENT, "%s: these ranks cannot exchange bytes",
              __func__);
    CLX_TRY(clx_alloc(&made, 1, sizeof *made));
    made->comm = comm;
    CLX_TRY(clast_dem_create(&dem->config, &made->local));
    if (dem->energy != NULL) {
        CLX_TRY(clast_dem_begin_energy(made->local));
    }
    CLX_TRY(clx_alloc(&made->n_out, comm->n_rank, sizeof *made->n_out));
    CLX_TRY(clx_alloc(&made->n_in, comm->n_rank, sizeof *made->n_in));
    CLX_TRY(clx_alloc(&made->n_wire, comm->n_rank, sizeof *made->n_wire));
    CLX_TRY(clx_alloc(&made->n_asked, comm->n_rank, sizeof *made->n_asked));
    dem->ranks = made;
    made = NULL;
done:
    clx_ranks_destroy(made);
    return status;
}

void clx_ranks_destroy(clx_ranks *r)
{
    if (r == NULL) {
        return;
    }
    if (r->local != NULL) { // shapes, container, slabs and laws are the whole's
        r->local->body = NULL;
        r->local->n_body = 0;
        r->local->container = NULL;
        r->local->walls = (clx_walls){0};
        r->local->slabs = (clx_slabs){0};
        r->local->laws = (clx_laws){0};
        clast_dem_destroy(r->local);
    }
    CLX_FREE(r->owner, r->next, r->local_of, r->cost, r->number, r->is_ghost, r->send, r->receive,
             r->out, r->in, r->n_out, r->n_in, r->n_wire, r->n_asked, r->wire.bytes, r->height, r);
}

/// What the rank's own simulation shares with the whole.
static void share_setting(clast_dem *whole)
{
    clast_dem *local = whole->ranks->local;
    local->drive = whole->drive;
    local->stride = whole->stride;
    local->step = whole->step;
    local->container = whole->container;
    local->walls = whole->walls;
    local->walls.least = clx_walls_margin(whole);
    memcpy(local->wall, whole->wall, sizeof local->wall);
    local->law = whole->law;
    local->laws = whole->laws;
    local->body = whole->body;
    local->n_body = whole->n_body;
    if (whole->cell != NULL) {
        *local->cell = *whole->cell;
    }
    local->has_items = whole->has_items;
    local->has_parts = whole->has_parts;
    local->all_round = whole->all_round;
    local->may_touch_old = whole->may_touch_old;
}

static clast_status reserve(clast_dem *whole)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    const int64_t n = whole->n_grain;
    CLX_TRY(clx_grow(&r->owner, &r->owner_capacity, n, sizeof *r->owner));
    CLX_TRY(clx_grow(&r->next, &r->next_capacity, n, sizeof *r->next));
    CLX_TRY(clx_grow(&r->local_of, &r->local_of_capacity, n, sizeof *r->local_of));
    CLX_TRY(clx_grow(&r->cost, &r->cost_capacity, n, sizeof *r->cost));
    for (int64_t i = r->n_synced; i < n; ++i) {
        r->owner[i] = 0;
        r->local_of[i] = -1;
        r->cost[i] = 0.0;
    }
done:
    return status;
}

/// Costs that each rank has counted, on every rank.
static clast_status share_costs(clast_dem *whole)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    int64_t *sum = NULL;
    CLX_TRY(clast_comm_agree(r->comm, clx_alloc(&sum, r->n_synced + 1, sizeof *sum), NULL));
    clx_ranks_weigh(whole);
    for (int32_t g = 0; g < r->local->n_grain; ++g) {
        if (r->is_ghost[g] == 0) {
            sum[r->number[g]] = (int64_t)r->cost[r->number[g]];
        }
    }
    clx_comm_sum(r->comm, sum, r->n_synced);
    for (int32_t i = 0; i < r->n_synced; ++i) {
        r->cost[i] = (double)sum[i];
    }
done:
    clx_free(sum);
    return status;
}

/// Distributes the grains anew; new ones go to their ranks with the next refresh.
static clast_status balance(clast_dem *whole)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    CLX_TRY(clx_dem_gather_grains(whole));
    CLX_TRY(share_costs(whole));
    CLX_TRY(clx_ranks_partition(whole));
    CLX_TRY(clx_ranks_migrate(whole, r->local));
done:
    return status;
}

/// Whether the cell has strained by so much since the last partition that the ranks' parts, which
/// strain with it, are no boxes along its sides any more: each would have ghosts of all.
static bool has_strained(clx_ranks *r)
{
    const clx_periodic_cell *cell = r->local->cell;
    if (cell == NULL) {
        return false;
    }
    double now[4] = {0.0, 0.0, 0.0, cell->sheared};
    bool has = false;
    for (int k = 0; k < 4; ++k) {
        now[k] = k < 3 ? log(cell->first[k] * cell->inverse[k]) : now[k];
        has = has || fabs(now[k] - r->strain[k]) > MOST_STRAIN;
    }
    if (has) {
        memcpy(r->strain, now, sizeof now);
    }
    return has;
}

/// The first distribution: rank 0 has all, grains and pairs.
static clast_status begin(clast_dem *whole)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    clast_dem *local = r->local;
    clx_inner_unpack(whole);
    CLX_TRY(clx_ranks_partition(whole));
    CLX_TRY(clx_ranks_migrate(whole, r->comm->rank == 0 ? whole : NULL));
    local->list.n_refresh = whole->list.n_refresh;
    local->list.is_due = whole->list.is_due;
    local->verified = r->comm->rank == 0 ? whole->verified : (clast_dem_verification){0};
    whole->list.n_pair = 0; // they come back to rank 0 when they are gathered
    r->n_synced = whole->n_grain;
    r->has_begun = true;
    r->is_current = true;
    (void)has_strained(r);
    CLX_TRY(clx_ranks_connect(whole));
done:
    return status;
}

/// Grains that were added since go to their ranks; where none were, a shape was that is the first
/// that is no sphere, and the grains are made anew.
static clast_status bring_new(clast_dem *whole)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    CLX_TRY(balance(whole));
    CLX_TRY(clast_comm_agree(r->comm, clx_ranks_append(whole, r->n_synced), NULL));
    if (whole->n_grain == r->n_synced) {
        CLX_TRY(clx_ranks_connect(whole));
        return CLAST_OK;
    }
    r->n_synced = whole->n_grain;
    r->local->list.is_due = true;
done:
    return status;
}

static clast_status synchronise(clast_dem *whole)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    const bool is_other_kind = r->local->all_round != whole->all_round;
    share_setting(whole);
    if (r->has_begun && whole->n_grain == r->n_synced && !is_other_kind) {
        return CLAST_OK;
    }
    CLX_TRY(clast_comm_agree(r->comm, reserve(whole), NULL));
    CLX_TRY(r->has_begun ? bring_new(whole) : begin(whole));
done:
    return status;
}

/// Whether the ranks' costs have drifted apart.
static clast_status look_at_balance(clast_dem *whole)
{
    clx_ranks *r = whole->ranks;
    double cost = 0.0;
    if (has_strained(r)) {
        return balance(whole);
    }
    if (r->local->list.n_refresh % LOOK_EVERY != 0) {
        return CLAST_OK;
    }
    clx_ranks_weigh(whole);
    for (int32_t g = 0; g < r->local->n_grain; ++g) {
        cost += r->is_ghost[g] == 0 ? r->cost[r->number[g]] : 0.0;
    }
    const double all = (double)clx_comm_total(r->comm, (int64_t)cost);
    const double most = -clx_comm_least(r->comm, -cost);
    const double limit = fmax(MOST_IMBALANCE, WORSE * r->counts.imbalance);
    return most * r->comm->n_rank > limit * all ? balance(whole) : CLAST_OK;
}

static clast_status refresh(clast_dem *whole)
{
    clast_status status = CLAST_OK;
    clx_inner_unpack(whole->ranks->local);
    CLX_TRY(look_at_balance(whole));
    CLX_TRY(clx_ranks_refresh(whole));
    CLX_TRY(clx_ranks_connect(whole));
done:
    return status;
}

/// Contacts and motion of the rank's own simulation, where energy is booked contacts alone; a rank
/// without grains moves the cell alone.
static clast_status work(clast_dem *local, bool *is_fine)
{
    clast_status status = CLAST_OK;
    if (local->cell != NULL) {
        clx_cell_begin_step(local);
    }
    if (local->n_grain > 0 && local->inner.is_due) {
        CLX_TRY(clx_inner_find(local));
    }
    if (local->n_started < local->n_grain) {
        CLX_TRY(clx_check_starts(local));
    }
    if (local->n_grain > 0) {
        CLX_TRY(local->energy != NULL ? clx_pass_contacts(local)
                                      : clx_contacts_and_motion(local, is_fine));
    }
done:
    return status;
}

/// Solids by height, where they hinder each other's settling: a sum over all grains in order, so
/// every rank needs all heights. They are added up as bits, to which others add 0.
static clast_status share_slabs(clast_dem *whole)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    const clast_dem *local = r->local;
    if (!whole->config.hindrance) {
        return CLAST_OK;
    }
    status = clx_grow(&r->height, &r->height_capacity, whole->n_grain, sizeof *r->height);
    CLX_TRY(clast_comm_agree(r->comm, status, NULL));
    memset(r->height, 0, (size_t)whole->n_grain * sizeof *r->height);
    for (int32_t g = 0; g < local->n_grain; ++g) {
        if (r->is_ghost[g] == 0) {
            memcpy(&r->height[r->number[g]], &local->grain[g].position[2], sizeof *r->height);
        }
    }
    clx_comm_sum(r->comm, r->height, whole->n_grain);
    for (int32_t i = 0; i < whole->n_grain; ++i) {
        memcpy(&whole->grain[i].position[2], &r->height[i], sizeof *r->height);
    }
    CLX_TRY(clast_comm_agree(r->comm, clx_fluid_update_slabs(whole), NULL));
    r->local->slabs = whole->slabs;
done:
    return status;
}

/// What exploded, as on one rank.
static clast_status explain(clast_dem *whole)
{
    clast_status status = CLAST_OK;
    const clx_ranks *r = whole->ranks;
    CLX_TRY(clx_dem_gather_all(whole));
    status = r->comm->rank == 0 ? clx_explain_explosion(whole) : CLAST_OK;
    CLX_TRY(clast_comm_agree(r->comm, status, NULL));
done:
    return status;
}

static clast_status step(clast_dem *whole)
{
    enum { FAILED, LOST, DUE, FINE };
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    clast_dem *local = r->local;
    bool is_fine = true;
    if (local->list.is_due) {
        CLX_TRY(refresh(whole));
    }
    CLX_TRY(share_slabs(whole));
    clx_walls_begin_step(local);
    status = work(local, &is_fine);
    if (local->energy != NULL) {
        clx_ranks_exchange_means(whole, status == CLAST_OK);
        is_fine = status != CLAST_OK || local->n_grain == 0 || clx_pass_motion(local);
    }
    clx_walls_end_step(local);
    if (local->cell != NULL) {
        clx_cell_end_step(local);
        *whole->cell = *local->cell;
    }
    whole->step = ++local->step;
    r->is_current = false;
    clx_ranks_exchange(whole);
    const int own = status != CLAST_OK ? FAILED : !is_fine ? LOST : local->list.is_due ? DUE : FINE;
    const int64_t least = r->comm->least(r->comm->context, own);
    local->list.is_due = least == DUE;
    if (least == FAILED) {
        return clast_comm_agree(r->comm, status, NULL);
    }
    whole->n_started = whole->n_grain;
    if (least == LOST) {
        CLX_TRY(explain(whole));
    }
    CLX_TRY(clx_ranks_add_walls(whole));
done:
    return status;
}

/// What the rank's own simulation did with the walls, which are the whole's.
static void return_walls(clast_dem *whole)
{
    whole->walls = whole->ranks->local->walls;
    memcpy(whole->wall, whole->ranks->local->wall, sizeof whole->wall);
}

void clx_ranks_restart(clx_ranks *r)
{
    r->has_begun = false;
    r->n_synced = 0;
}

clast_status clx_ranks_step(clast_dem *whole, int64_t n_step)
{
    clast_status status = CLAST_OK;
    CLX_TRY(synchronise(whole));
    for (int64_t k = 0; k < n_step; ++k) {
        status = step(whole);
        return_walls(whole);
        CLX_TRY(status);
    }
done:
    clx_inner_unpack(whole->ranks->local);
    return status;
}
