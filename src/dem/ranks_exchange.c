// What ranks tell each other in every step: where their grains are that others have pairs with.
#include "dem/ranks.h"

#include "base/alloc.h"
#include "base/lines.h"
#include "dem/energy.h"
#include <clast/machine.h>
#include <clast/status.h>
#include <string.h>

/// Numbers of a grain in a step: position, velocity, omega, travel, stability load; orientation
/// where some grain is no sphere.
enum { ROUND = 11, TURNED = 15 };

static int32_t width_of(const clast_dem *dem)
{
    return dem->all_round && dem->item == NULL ? ROUND : TURNED;
}

static void write_grain(const clast_dem *dem, int32_t i, int32_t width, double *out)
{
    CLAST_ASSERT(i >= 0 && i < dem->n_grain);
    const clx_grain *g = &dem->grain[i];
    v3_copy(out, g->position);
    v3_copy(out + 3, g->velocity);
    v3_copy(out + 6, g->omega);
    out[9] = dem->travel[i];
    out[10] = g->held;
    if (width == TURNED) {
        memcpy(out + 11, dem->motion[i].orientation, 4 * sizeof *out);
    }
}

static void read_grain(clast_dem *dem, int32_t i, int32_t width, const double *in)
{
    CLAST_ASSERT(i >= 0 && i < dem->n_grain && dem->is_ghost[i] != 0);
    clx_grain *g = &dem->grain[i];
    v3_copy(g->position, in);
    v3_copy(g->velocity, in + 3);
    v3_copy(g->omega, in + 6);
    dem->travel[i] = in[9];
    g->held = in[10];
    if (width == TURNED) {
        memcpy(dem->motion[i].orientation, in + 11, 4 * sizeof *in);
        if (g->kind != CLAST_SHAPE_SPHERE) {
            q_matrix(g->rotation, dem->motion[i].orientation);
        }
    }
    if (dem->item != NULL) {
        clx_items_place(dem, i);
    }
    dem->inner.is_due = dem->inner.is_due || dem->travel[i] > dem->inner.until[i];
}

/// The numbers of all own grains that others read go to them, those of ghosts come.
static void swap(clx_ranks *r, int32_t width)
{
    r->comm->exchange(r->comm->context, r->out, r->n_out, r->in, r->n_in);
    for (int32_t k = 0; k < r->comm->n_rank; ++k) {
        r->counts.n_message += r->n_out[k] > 0 ? 1 : 0;
    }
    r->counts.step_bytes += r->n_send * width * (int64_t)sizeof(double);
}

/// Bytes for each rank, from so many numbers a grain to others.
static void scale_counts(clx_ranks *r, int32_t from, int32_t to)
{
    for (int32_t k = 0; k < r->comm->n_rank; ++k) {
        r->n_out[k] = r->n_out[k] / from * to;
        r->n_in[k] = r->n_in[k] / from * to;
    }
}

void clx_ranks_exchange(clast_dem *whole)
{
    clx_ranks *r = whole->ranks;
    const int32_t width = width_of(r->local);
    for (int64_t k = 0; k < r->n_send; ++k) {
        write_grain(r->local, r->send[k], width, r->out + k * width);
    }
    swap(r, width);
    for (int64_t k = 0; k < r->n_receive; ++k) {
        read_grain(r->local, r->receive[k], width, r->in + k * width);
    }
    r->counts.n_ghost += r->n_receive;
    ++r->counts.n_step;
}

void clx_ranks_exchange_means(clast_dem *whole, bool is_ready)
{
    enum { MEANS = 6 };
    clx_ranks *r = whole->ranks;
    clx_energy_grain *grain = r->local->energy->grain;
    for (int64_t k = 0; k < r->n_send && is_ready; ++k) {
        v3_copy(r->out + k * MEANS, grain[r->send[k]].velocity);
        v3_copy(r->out + k * MEANS + 3, grain[r->send[k]].omega);
    }
    scale_counts(r, width_of(r->local), MEANS);
    swap(r, MEANS);
    scale_counts(r, MEANS, width_of(r->local));
    for (int64_t k = 0; k < r->n_receive && is_ready; ++k) {
        v3_copy(grain[r->receive[k]].velocity, r->in + k * MEANS);
        v3_copy(grain[r->receive[k]].omega, r->in + k * MEANS + 3);
    }
}

/// Ghosts that some pair of the rank reads, marked.
static clast_status mark_ghosts(const clast_dem *dem, uint8_t **is_read)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(is_read, dem->n_grain, 1));
    for (int64_t k = 0; k < dem->list.n_pair; ++k) {
        const clx_dem_pair *pair = &dem->list.pair[k];
        (*is_read)[clx_item_grain(dem, pair->a)] = 1;
        if (pair->b >= 0) {
            (*is_read)[clx_item_grain(dem, pair->b)] = 1;
        }
    }
done:
    return status;
}

/// Lists them by owner and number, and asks for them: their numbers as text for each rank.
static clast_status write_requests(clx_ranks *r)
{
    clast_status status = CLAST_OK;
    const clast_dem *dem = r->local;
    uint8_t *is_read = NULL;
    r->n_receive = 0;
    CLX_TRY(mark_ghosts(dem, &is_read));
    CLX_TRY(clx_grow(&r->receive, &r->receive_capacity, dem->n_grain, sizeof *r->receive));
    CLX_TRY(clx_grow(&r->wire.bytes, &r->wire.capacity,
                     (int64_t)sizeof(int32_t) * (dem->n_grain + 1), 1));
    int32_t *number = (int32_t *)(void *)r->wire.bytes;
    memset(r->n_wire, 0, (size_t)r->comm->n_rank * sizeof *r->n_wire);
    for (int32_t g = 0; g < dem->n_grain; ++g) {
        is_read[g] = is_read[g] != 0 && r->is_ghost[g] != 0 ? 1 : 0;
        r->n_wire[r->owner[r->number[g]]] += is_read[g];
    }
    for (int32_t k = 0; k < r->comm->n_rank; ++k) { // where each owner's begin, for now in n_out
        r->n_out[k] = r->n_receive;
        r->n_receive += r->n_wire[k];
        r->n_wire[k] *= (int64_t)sizeof(int32_t);
    }
    for (int32_t g = 0; g < dem->n_grain; ++g) {
        if (is_read[g] != 0) {
            const int64_t at = r->n_out[r->owner[r->number[g]]]++;
            number[at] = r->number[g];
            r->receive[at] = g;
        }
    }
done:
    clx_free(is_read);
    return status;
}

/// Capacity for what others ask for, and what comes in a step.
static clast_status reserve_step(clx_ranks *r)
{
    clast_status status = CLAST_OK;
    const int32_t width = width_of(r->local);
    r->n_send = 0;
    for (int32_t k = 0; k < r->comm->n_rank; ++k) {
        r->n_send += r->n_asked[k] / (int64_t)sizeof(int32_t);
    }
    CLX_TRY(clx_grow(&r->send, &r->send_capacity, r->n_send + 1, sizeof *r->send));
    CLX_TRY(clx_grow_lines(&r->out, &r->out_capacity, r->n_send * width + 1, sizeof *r->out));
    CLX_TRY(clx_grow_lines(&r->in, &r->in_capacity, r->n_receive * width + 1, sizeof *r->in));
done:
    return status;
}

clast_status clx_ranks_connect(clast_dem *whole)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    const clast_comm *c = r->comm;
    const int64_t grain_bytes = (int64_t)width_of(r->local) * (int64_t)sizeof(double);
    CLX_TRY(clast_comm_agree(c, write_requests(r), NULL));
    for (int32_t k = 0; k < c->n_rank; ++k) {
        r->n_out[k] = (int64_t)sizeof(int64_t);
    }
    c->exchange(c->context, r->n_wire, r->n_out, r->n_asked, r->n_out);
    CLX_TRY(clast_comm_agree(c, reserve_step(r), NULL));
    c->exchange(c->context, r->wire.bytes, r->n_wire, r->send, r->n_asked);
    for (int64_t k = 0; k < r->n_send; ++k) {
        r->send[k] = r->local_of[r->send[k]]; // from the whole's numbers
        CLAST_ASSERT(r->send[k] >= 0 && r->is_ghost[r->send[k]] == 0);
    }
    for (int32_t k = 0; k < c->n_rank; ++k) {
        r->n_out[k] = r->n_asked[k] / (int64_t)sizeof(int32_t) * grain_bytes;
        r->n_in[k] = r->n_wire[k] / (int64_t)sizeof(int32_t) * grain_bytes;
    }
done:
    return status;
}
