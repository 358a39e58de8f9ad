// A simulation over ranks brought together again: grains to every rank, pairs to rank 0.
#include "dem/ranks.h"

#include "base/alloc.h"
#include "base/lines.h"
#include "dem/energy.h"
#include <clast/machine.h>
#include <clast/status.h>
#include <string.h>

/// Writes the rank's own grains, or the pairs whose a they are, as one message.
static clast_status write_own(clast_dem *whole, bool are_pairs)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    const clast_dem *local = r->local;
    int64_t at = 0;
    int64_t n_grain = 0;
    int64_t n_pair = 0;
    r->wire.n = 0;
    CLX_TRY(clx_wire_begin(&r->wire, &at));
    for (int32_t g = 0; !are_pairs && g < local->n_grain; ++g) {
        if (r->is_ghost[g] == 0) {
            CLX_TRY(clx_wire_add_grain(&r->wire, local, g, true));
            ++n_grain;
        }
    }
    for (int64_t k = 0; are_pairs && k < local->list.n_pair; ++k) {
        if (r->is_ghost[clx_item_grain(local, local->list.pair[k].a)] == 0) {
            CLX_TRY(clx_wire_add_pair(&r->wire, whole, local, k));
            ++n_pair;
        }
    }
    clx_wire_end(&r->wire, at, n_grain, n_pair);
done:
    return status;
}

static void receive_grains(clast_dem *whole, const clx_arrivals *a)
{
    clx_neighbour_list *l = &whole->list;
    l->n_known = 0;
    for (int64_t k = 0; k < a->n_grain; ++k) {
        const clx_wire_grain *from = a->grain[k];
        const clx_wire_item *item = (const clx_wire_item *)(const void *)(from + 1);
        const int32_t first = clx_first_item(whole, from->number);
        clx_wire_set_state(whole, from->number, from);
        for (int32_t i = 0; i < clx_n_item(whole, from->number); ++i) {
            l->anchor[first + i] = item[i].anchor;
            l->limit[first + i] = item[i].limit;
            l->n_known += item[i].is_known;
        }
    }
}

/// The counts that ranks add up.
static void add_counts(clast_dem *whole)
{
    clx_ranks *r = whole->ranks;
    const clast_dem_verification *own = &r->local->verified;
    int64_t n[3] = {own->n, own->n_off, own->n_bad};
    clx_comm_sum(r->comm, n, 3);
    whole->verified =
        (clast_dem_verification){n[0], n[1], n[2], 0.0 - clx_comm_least(r->comm, -own->worst)};
    whole->list.n_refresh = r->local->list.n_refresh;
    whole->list.is_due = r->local->list.is_due || whole->n_grain > r->n_synced;
}

/// What ranks have booked since the last time goes to the whole's book.
static void add_energies(clast_dem *whole)
{
    static const clx_exact_sum none[CLX_N_WORK];
    clx_exact_sum all[CLX_N_WORK];
    clx_exact_sum own[CLX_N_WORK];
    clx_energy_merge(whole->ranks->local->energy, own);
    clx_energy_set(whole->ranks->local->energy, none);
    clx_exact_over(whole->ranks->comm, own, CLX_N_WORK);
    clx_energy_merge(whole->energy, all);
    for (int k = 0; k < CLX_N_WORK; ++k) {
        clx_exact_merge(&all[k], &own[k]);
    }
    clx_energy_set(whole->energy, all);
}

static bool has_gathered(const clast_dem *dem)
{
    return dem->ranks == NULL || !dem->ranks->has_begun;
}

clast_status clx_dem_gather_grains(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = dem->ranks;
    clx_gathered all = {0};
    clx_arrivals a = {0};
    if (has_gathered(dem) || r->is_current) {
        return CLAST_OK;
    }
    clx_inner_unpack(r->local);
    clx_ranks_weigh(dem);
    CLX_TRY(clast_comm_agree(r->comm, write_own(dem, false), NULL));
    CLX_TRY(clx_comm_share(r->comm, r->wire.bytes, r->wire.n, &all));
    CLX_TRY(clast_comm_agree(r->comm, clx_wire_read(dem, all.bytes, all.n, &a), NULL));
    receive_grains(dem, &a);
    r->is_current = true;
done:
    clx_arrivals_free(&a);
    clx_gathered_free(&all);
    return status;
}

clast_status clx_dem_gather_all(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = dem->ranks;
    clx_gathered all = {0};
    clx_arrivals a = {0};
    if (has_gathered(dem)) {
        return CLAST_OK;
    }
    CLX_TRY(clx_dem_gather_grains(dem));
    clx_inner_unpack(r->local);
    CLX_TRY(clast_comm_agree(r->comm, write_own(dem, true), NULL));
    CLX_TRY(clx_comm_gather(r->comm, r->wire.bytes, r->wire.n, &all));
    status = clx_wire_read(dem, all.bytes, all.n, &a);
    if (status == CLAST_OK) {
        status = clx_ranks_receive_pairs(dem, &a);
    }
    CLX_TRY(clast_comm_agree(r->comm, status, NULL));
    add_counts(dem);
    if (dem->energy != NULL) {
        add_energies(dem);
    }
done:
    clx_arrivals_free(&a);
    clx_gathered_free(&all);
    return status;
}

double clx_dem_highest(const clast_dem *dem)
{
    const clx_ranks *r = dem->ranks;
    const bool is_spread = r != NULL && r->has_begun && !r->is_current;
    const clast_dem *from = is_spread ? r->local : dem;
    double highest = -INFINITY;
    for (int32_t i = 0; i < from->n_grain; ++i) {
        if (!is_spread || r->is_ghost[i] == 0) {
            highest = fmax(highest, from->grain[i].position[2]);
        }
    }
    return is_spread ? -clx_comm_least(r->comm, -highest) : highest;
}

clast_status clx_dem_gather_measures(clast_dem *dem, clast_dem_measures *measures)
{
    clast_status status = CLAST_OK;
    const clx_ranks *r = dem->ranks;
    CLX_TRY(clx_dem_gather_all(dem));
    if (r == NULL || r->comm->rank == 0) {
        clast_dem_measure(dem, measures);
    }
    if (r != NULL) {
        r->comm->broadcast(r->comm->context, 0, measures, (int64_t)sizeof *measures);
    }
done:
    return status;
}

clast_status clx_dem_agree(const clast_dem *dem, clast_status status)
{
    return dem->ranks != NULL ? clast_comm_agree(dem->ranks->comm, status, NULL) : status;
}

bool clx_dem_rank_counts(const clast_dem *dem, clx_rank_counts *counts)
{
    if (dem->ranks == NULL) {
        return false;
    }
    const clx_ranks *r = dem->ranks;
    clx_rank_counts c = r->counts;
    int64_t own = 0;
    for (int32_t g = 0; g < r->local->n_grain; ++g) {
        own += r->is_ghost[g] == 0 ? 1 : 0;
    }
    int64_t sum[6] = {c.n_migrated, c.step_bytes,     c.list_bytes,
                      c.n_ghost,    own == 0 ? 1 : 0, c.n_message};
    clx_comm_sum(r->comm, sum, 6);
    c.n_migrated = sum[0];
    c.step_bytes = sum[1];
    c.list_bytes = sum[2];
    c.n_ghost = sum[3];
    c.n_idle = (int32_t)sum[4];
    c.n_message = sum[5];
    *counts = c;
    return true;
}
