// Neighbour lists over ranks: ghosts found anew, grains and pairs moved to other ranks.
//
// A pair is listed when the anchors of its items are nearer than their radii and margins together.
// So a rank needs, beside its own grains, those whose sphere of radius and margin meets the box
// about the spheres of its own, in any image of a period. Every owner marks its stale items before;
// then each rank searches as one rank does.
#include "dem/ranks.h"

#include "base/alloc.h"
#include "base/lines.h"
#include <clast/machine.h>
#include <clast/status.h>
#include <string.h>

/// Box about the spheres of a rank's items; low > high: it has none.
typedef struct {
    double low[3], high[3];
} box;

/// Slack of the boxes, far above rounding: it costs ghosts that have no pair.
static const double SLACK = 1e-9;

/// A coordinate in the period about a point.
static double wrap(const clast_dem *dem, int c, double x, double about)
{
    const double period = dem->cell != NULL ? dem->cell->side[c] : c < 2 ? dem->period[c] : 0.0;
    return period > 0.0 ? x - period * floor((x - about) / period + 0.5) : x;
}

/// The image of a place about a point: the upper ones of a cell are shifted along x.
static void wrap_place(const clast_dem *dem, const double x[3], const double about[3],
                       double out[3])
{
    out[2] = wrap(dem, 2, x[2], about[2]);
    const double shift =
        dem->cell != NULL ? dem->cell->shift * round((out[2] - x[2]) * dem->cell->inverse[2]) : 0.0;
    out[0] = wrap(dem, 0, x[0] + shift, about[0]);
    out[1] = wrap(dem, 1, x[1], about[1]);
}

/// Whether some image of a place `off` away is within `most` along x, y and z. A cell's nearest
/// image in z, above and below of it are all that are.
static bool is_within(const clast_dem *dem, const double off[3], const double most[3])
{
    static const double here[3] = {0.0, 0.0, 0.0};
    const int beyond = dem->cell != NULL ? 1 : 0;
    bool is = false;
    double at[3];
    wrap_place(dem, off, here, at);
    for (int n = -beyond; n <= beyond && !is; ++n) {
        const double up = beyond != 0 ? n * dem->cell->side[2] : 0.0;
        const double along = beyond != 0 ? n * dem->cell->shift : 0.0;
        is = fabs(at[2] + up) <= most[2] && fabs(wrap(dem, 0, at[0] + along, 0.0)) <= most[0] &&
             fabs(at[1]) <= most[1];
    }
    return is;
}

static box box_of_own(const clx_ranks *r)
{
    const clast_dem *dem = r->local;
    box b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (int32_t i = 0; i < dem->n_item; ++i) {
        if (r->is_ghost[clx_item_grain(dem, i)] != 0) {
            continue;
        }
        const clx_anchor *at = &dem->list.anchor[i];
        const double margin_radius = clx_item_radius(dem, i) + at->margin;
        double x[3];
        wrap_place(dem, at->position, r->middle, x);
        for (int c = 0; c < 3; ++c) {
            b.low[c] = fmin(b.low[c], x[c] - margin_radius);
            b.high[c] = fmax(b.high[c], x[c] + margin_radius);
        }
    }
    return b;
}

static bool meets(const clast_dem *dem, const clx_anchor *at, double margin_radius, const box *b)
{
    double off[3], most[3];
    for (int c = 0; c < 3; ++c) {
        const double half = 0.5 * (b->high[c] - b->low[c]);
        off[c] = at->position[c] - 0.5 * (b->low[c] + b->high[c]);
        most[c] = half + margin_radius + SLACK * (half + margin_radius + fabs(at->position[c]));
    }
    return is_within(dem, off, most);
}

/// Whether any sphere within the box a may meet the box b.
static bool boxes_meet(const clast_dem *dem, const box *a, const box *b)
{
    double off[3], most[3];
    for (int c = 0; c < 3; ++c) {
        const double middle = 0.5 * (a->low[c] + a->high[c]);
        const double half_span = 0.5 * (a->high[c] - a->low[c] + b->high[c] - b->low[c]);
        off[c] = middle - 0.5 * (b->low[c] + b->high[c]);
        most[c] = half_span + 4.0 * SLACK * (half_span + fabs(middle));
    }
    return is_within(dem, off, most);
}

static bool grain_meets(const clast_dem *dem, int32_t g, const box *b)
{
    const int32_t first = clx_first_item(dem, g);
    bool does = false;
    for (int32_t i = first; i < first + clx_n_item(dem, g) && !does; ++i) {
        const clx_anchor *at = &dem->list.anchor[i];
        does = meets(dem, at, clx_item_radius(dem, i) + at->margin, b);
    }
    return does;
}

static clast_status reserve_local(clast_dem *whole, int64_t n_grain, int64_t n_item)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    clast_dem *local = r->local;
    CLX_TRY(clx_grains_reserve(local, n_grain));
    CLX_TRY(clx_items_reserve_all(local, n_item));
    CLX_TRY(clx_grow(&r->number, &r->number_capacity, n_grain, sizeof *r->number));
    // never NULL, which tells a rank's own simulation
    CLX_TRY(clx_grow(&r->is_ghost, &r->is_ghost_capacity, n_grain + 1, sizeof *r->is_ghost));
    local->number = r->number;
    local->is_ghost = r->is_ghost;
done:
    return status;
}

/// Appends grain `number` of the whole, as it was there.
static void add_grain(const clast_dem *whole, int32_t number)
{
    clx_ranks *r = whole->ranks;
    clast_dem *local = r->local;
    const int32_t g = local->n_grain++;
    const int32_t from = clx_first_item(whole, number);
    const int32_t n = clx_n_item(whole, number);
    CLAST_ASSERT(g == 0 || r->number[g - 1] < number);
    local->grain[g] = whole->grain[number];
    local->motion[g] = whole->motion[number];
    local->travel[g] = whole->travel[number];
    r->number[g] = number;
    r->is_ghost[g] = r->owner[number] != r->comm->rank;
    r->local_of[number] = g;
    for (int32_t k = 0; k < n; ++k) {
        const int32_t i = local->n_item + k;
        if (local->item != NULL) {
            local->item[i] = whole->item[from + k];
            local->item[i].grain = g;
        }
        if (!local->all_round) {
            local->convex[i] = whole->convex[from + k];
        }
    }
    local->n_item += n;
    if (local->item != NULL) {
        local->item_begin[g + 1] = local->n_item;
        clx_items_place(local, g);
    }
}

/// The rank's grains and ghosts are those that came.
static clast_status receive_grains(clast_dem *whole, const clx_arrivals *a)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    clast_dem *local = r->local;
    clx_neighbour_list *l = &local->list;
    int64_t n_item = 0;
    for (int32_t i = 0; i < local->n_grain; ++i) {
        r->local_of[r->number[i]] = -1;
    }
    for (int64_t i = 0; i < a->n_grain; ++i) {
        n_item += clx_n_item(whole, a->grain[i]->number);
    }
    local->n_grain = 0;
    local->n_item = 0;
    CLX_TRY(reserve_local(whole, a->n_grain, n_item));
    l->n_known = 0;
    for (int64_t k = 0; k < a->n_grain; ++k) {
        const clx_wire_item *item = (const clx_wire_item *)(const void *)(a->grain[k] + 1);
        const int32_t first = local->n_item;
        add_grain(whole, a->grain[k]->number);
        clx_wire_set_state(local, (int32_t)k, a->grain[k]);
        for (int32_t i = first; i < local->n_item; ++i) {
            l->anchor[i] = item[i - first].anchor;
            l->limit[i] = item[i - first].limit;
            l->is_stale[i] = (uint8_t)item[i - first].is_stale;
            l->n_known += item[i - first].is_known;
        }
    }
    local->n_started = 0;
    while (local->n_started < local->n_grain && r->number[local->n_started] < whole->n_started) {
        ++local->n_started;
    }
    local->inner.is_due = true;
done:
    return status;
}

clast_status clx_ranks_append(clast_dem *whole, int32_t from)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    clast_dem *local = r->local;
    int64_t n_grain = local->n_grain;
    int64_t n_item = local->n_item;
    for (int32_t i = from; i < whole->n_grain; ++i) {
        if (r->owner[i] == r->comm->rank) {
            n_item += clx_n_item(whole, i);
            ++n_grain;
        }
    }
    CLX_TRY(reserve_local(whole, n_grain, n_item));
    for (int32_t i = from; i < whole->n_grain; ++i) {
        if (r->owner[i] == r->comm->rank) {
            add_grain(whole, i);
        }
    }
    local->inner.is_due = true;
done:
    return status;
}

/// Sends what was written, and reads what comes.
static clast_status swap_wires(const clast_dem *whole, clast_status status, clx_gathered *in,
                               clx_arrivals *arrivals)
{
    clx_ranks *r = whole->ranks;
    CLX_TRY(clast_comm_agree(r->comm, status, NULL));
    CLX_TRY(clx_comm_exchange(r->comm, r->wire.bytes, r->n_wire, in));
    r->counts.list_bytes += r->wire.n - r->n_wire[r->comm->rank];
    CLX_TRY(clx_wire_read(whole, in->bytes, in->n, arrivals));
done:
    return status;
}

/// First pairs of the items, where the pairs are in order.
static void set_begins(clast_dem *dem)
{
    clx_neighbour_list *l = &dem->list;
    int64_t k = 0;
    for (int32_t i = 0; dem->n_item > 0 && i <= dem->n_item; ++i) {
        while (k < l->n_pair && l->pair[k].a < i) {
            ++k;
        }
        l->begin[i] = k;
    }
}

/// The rank's pairs, whose items are numbers of the whole, by its own: those of grains that it no
/// longer sees go.
static void localize_pairs(const clast_dem *whole)
{
    clast_dem *local = whole->ranks->local;
    clx_neighbour_list *l = &local->list;
    int64_t n = 0;
    for (int64_t k = 0; k < l->n_pair; ++k) {
        clx_dem_pair pair = l->pair[k];
        const int32_t a = clx_item_to_local(whole, pair.a);
        const int32_t b = pair.b >= 0 ? clx_item_to_local(whole, pair.b) : pair.b;
        if (a < 0 || (pair.b >= 0 && b < 0)) {
            if (pair.slot != 0) {
                l->free_slot[l->n_free++] = (int32_t)pair.slot;
            }
            continue;
        }
        pair.a = a;
        pair.b = b;
        l->pair[n] = pair;
        if (local->law.has_history) {
            l->history[n] = l->history[k];
        }
        ++n;
    }
    l->n_pair = n;
    set_begins(local);
}

/// Pairs that came, into an empty list, by numbers of the whole.
clast_status clx_ranks_receive_pairs(clast_dem *dem, const clx_arrivals *a)
{
    clast_status status = CLAST_OK;
    clx_neighbour_list *l = &dem->list;
    l->n_pair = 0;
    l->n_slot = 0;
    l->n_free = 0;
    CLX_TRY(clx_grow_lines(&l->pair, &l->capacity, a->n_pair + 1, sizeof *l->pair));
    if (dem->law.has_history) {
        CLX_TRY(clx_grow(&l->history, &l->history_capacity, a->n_pair + 1, sizeof *l->history));
    }
    for (int64_t k = 0; k < a->n_pair; ++k) {
        const clx_wire_pair *from = a->pair[k];
        l->pair[k] = from->pair;
        l->pair[k].slot = 0;
        if (from->pair.slot != 0) {
            CLX_TRY(clx_neighbour_list_assign_slot(l, &l->pair[k]));
            l->warm_start[l->pair[k].slot].record = from->warm_start;
            l->pair[k].kind = from->warm_start.kind & 3U;
        }
        if (dem->law.has_history) {
            l->history[k] = from->history;
        }
        ++l->n_pair;
    }
    if (dem->number == NULL) {
        set_begins(dem);
    }
done:
    return status;
}

/// Where the rank's grains are, in the period.
static void find_middle(clx_ranks *r)
{
    const clast_dem *dem = r->local;
    for (int c = 0; c < 3; ++c) {
        double low = INFINITY;
        double high = -INFINITY;
        for (int32_t g = 0; g < dem->n_grain; ++g) { // those of a cell are in it
            const double x = dem->cell != NULL ? dem->grain[g].position[c]
                                               : wrap(dem, c, dem->grain[g].position[c], 0.0);
            low = r->is_ghost[g] != 0 ? low : fmin(low, x);
            high = r->is_ghost[g] != 0 ? high : fmax(high, x);
        }
        r->middle[c] = low <= high ? 0.5 * (low + high) : 0.0;
    }
}

/// Writes for rank k: grains that are its own from now on, the pairs of these, and the others'
/// grains. `stamp` [n_grain]: the last rank that a grain was written for.
static clast_status write_migrants(clast_dem *whole, const clast_dem *from, int32_t k,
                                   int32_t *stamp)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    int64_t at = 0;
    int64_t n_grain = 0;
    int64_t n_pair = 0;
    CLX_TRY(clx_wire_begin(&r->wire, &at));
    for (int64_t p = 0; p < from->list.n_pair; ++p) {
        const clx_dem_pair *pair = &from->list.pair[p];
        const int32_t a = clx_item_grain(from, pair->a);
        const int32_t b = pair->b >= 0 ? clx_item_grain(from, pair->b) : -1;
        if ((from->is_ghost == NULL || from->is_ghost[a] == 0) &&
            (r->next[clx_grain_number(from, a)] == k ||
             (b >= 0 && r->next[clx_grain_number(from, b)] == k))) {
            stamp[a] = k + 1;
            stamp[b >= 0 ? b : a] = k + 1;
        }
    }
    for (int32_t g = 0; g < from->n_grain; ++g) {
        const bool is_own = from->is_ghost == NULL || from->is_ghost[g] == 0;
        const bool is_its = is_own && r->next[clx_grain_number(from, g)] == k;
        if (is_its || stamp[g] == k + 1) {
            CLX_TRY(clx_wire_add_grain(&r->wire, from, g, is_own));
            ++n_grain;
        }
        r->counts.n_migrated +=
            is_its && from != whole && k != r->comm->rank ? 1 : 0; // each counted where it was
    }
    for (int64_t p = 0; p < from->list.n_pair; ++p) {
        const clx_dem_pair *pair = &from->list.pair[p];
        const int32_t a = clx_item_grain(from, pair->a);
        const int32_t b = pair->b >= 0 ? clx_item_grain(from, pair->b) : a;
        if ((from->is_ghost == NULL || from->is_ghost[a] == 0) &&
            (r->next[clx_grain_number(from, a)] == k || r->next[clx_grain_number(from, b)] == k)) {
            CLX_TRY(clx_wire_add_pair(&r->wire, whole, from, p));
            ++n_pair;
        }
    }
    clx_wire_end(&r->wire, at, n_grain, n_pair);
done:
    return status;
}

static clast_status write_all_migrants(clast_dem *whole, const clast_dem *from)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    int32_t *stamp = NULL;
    r->wire.n = 0;
    memset(r->n_wire, 0, (size_t)r->comm->n_rank * sizeof *r->n_wire);
    if (from == NULL) {
        return CLAST_OK;
    }
    CLX_TRY(clx_alloc(&stamp, from->n_grain, sizeof *stamp));
    for (int32_t k = 0; k < r->comm->n_rank; ++k) {
        const int64_t before = r->wire.n;
        CLX_TRY(write_migrants(whole, from, k, stamp));
        r->n_wire[k] = r->wire.n - before;
    }
done:
    clx_free(stamp);
    return status;
}

clast_status clx_ranks_migrate(clast_dem *whole, const clast_dem *from)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    clx_gathered in = {0};
    clx_arrivals a = {0};
    clx_inner_unpack(r->local);
    status = swap_wires(whole, write_all_migrants(whole, from), &in, &a);
    if (status == CLAST_OK) {
        memcpy(r->owner, r->next, (size_t)whole->n_grain * sizeof *r->owner);
        status = receive_grains(whole, &a);
    }
    if (status == CLAST_OK) {
        status = clx_ranks_receive_pairs(r->local, &a);
    }
    CLX_TRY(clast_comm_agree(r->comm, status, NULL));
    localize_pairs(whole);
    find_middle(r);
done:
    clx_arrivals_free(&a);
    clx_gathered_free(&in);
    return status;
}

/// Boxes of all ranks.
static clast_status share_boxes(const clx_ranks *r, clx_gathered *boxes)
{
    const box own = box_of_own(r);
    return clx_comm_share(r->comm, &own, (int64_t)sizeof own, boxes);
}

/// Writes for each rank the own grains that it may have pairs with.
static clast_status write_candidates(clast_dem *whole, const box *boxes)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    const clast_dem *local = r->local;
    const int32_t own = r->comm->rank;
    r->wire.n = 0;
    for (int32_t k = 0; k < r->comm->n_rank; ++k) {
        int64_t at = 0;
        int64_t n = 0;
        const bool is_near = k == own || boxes_meet(local, &boxes[own], &boxes[k]);
        CLX_TRY(clx_wire_begin(&r->wire, &at));
        for (int32_t g = 0; g < local->n_grain && is_near; ++g) {
            if (r->is_ghost[g] == 0 && (k == own || grain_meets(local, g, &boxes[k]))) {
                CLX_TRY(clx_wire_add_grain(&r->wire, local, g, true));
                ++n;
            }
        }
        clx_wire_end(&r->wire, at, n, 0);
        r->n_wire[k] = r->wire.n - at;
    }
done:
    return status;
}

static void globalize_pairs(const clast_dem *whole)
{
    clast_dem *local = whole->ranks->local;
    for (int64_t k = 0; k < local->list.n_pair; ++k) {
        clx_dem_pair *pair = &local->list.pair[k];
        pair->a = clx_item_to_whole(whole, local, pair->a);
        pair->b = clx_item_to_whole(whole, local, pair->b);
    }
}

clast_status clx_ranks_refresh(clast_dem *whole)
{
    clast_status status = CLAST_OK;
    clx_ranks *r = whole->ranks;
    clx_gathered boxes = {0};
    clx_gathered in = {0};
    clx_arrivals a = {0};
    clx_inner_unpack(r->local);
    CLX_TRY(clx_neighbour_list_check_width(whole));
    CLX_TRY(clast_comm_agree(r->comm, clx_neighbour_list_reserve(&r->local->list, r->local->n_item),
                             NULL));
    clx_neighbour_list_mark(r->local);
    CLX_TRY(share_boxes(r, &boxes));
    globalize_pairs(whole);
    status = write_candidates(whole, (const box *)(const void *)boxes.bytes);
    status = swap_wires(whole, status, &in, &a);
    if (status == CLAST_OK) {
        status = receive_grains(whole, &a);
    }
    if (status == CLAST_OK) {
        localize_pairs(whole);
        status = clx_neighbour_list_search(r->local);
    }
    CLX_TRY(clast_comm_agree(r->comm, status, NULL));
done:
    clx_arrivals_free(&a);
    clx_gathered_free(&in);
    clx_gathered_free(&boxes);
    return status;
}
