// Grains and pairs as bytes between ranks.
//
// A message is a header, grains with their items, pairs. What never changes of a grain (mass,
// shape, size) every rank has.
#include "dem/ranks.h"

#include "base/alloc.h"
#include <stdlib.h>
#include <string.h>

typedef struct {
    int64_t n_grain, n_pair;
} header;

void clx_arrivals_free(clx_arrivals *a)
{
    CLX_FREE(a->grain, a->pair);
    *a = (clx_arrivals){0};
}

int32_t clx_item_to_whole(const clast_dem *whole, const clast_dem *from, int32_t item)
{
    if (item < 0 || from == whole) {
        return item;
    }
    const int32_t g = clx_item_grain(from, item);
    return clx_first_item(whole, clx_grain_number(from, g)) + item - clx_first_item(from, g);
}

int32_t clx_item_to_local(const clast_dem *whole, int32_t item)
{
    CLAST_ASSERT(item >= 0 && item < whole->n_item);
    const int32_t number = clx_item_grain(whole, item);
    const int32_t g = whole->ranks->local_of[number];
    return g < 0 ? -1
                 : clx_first_item(whole->ranks->local, g) + item - clx_first_item(whole, number);
}

static clast_status append(clx_wire *wire, const void *bytes, size_t n)
{
    CLAST_ASSERT(wire->n >= 0 && n % sizeof(double) == 0);
    clast_status status = CLAST_OK;
    CLX_TRY(clx_grow(&wire->bytes, &wire->capacity, wire->n + (int64_t)n, 1));
    memcpy(wire->bytes + wire->n, bytes, n);
    wire->n += (int64_t)n;
done:
    return status;
}

clast_status clx_wire_begin(clx_wire *wire, int64_t *at)
{
    const header none = {0};
    *at = wire->n;
    return append(wire, &none, sizeof none);
}

void clx_wire_end(clx_wire *wire, int64_t at, int64_t n_grain, int64_t n_pair)
{
    CLAST_ASSERT(at >= 0 && at + (int64_t)sizeof(header) <= wire->n);
    const header counts = {n_grain, n_pair};
    memcpy(wire->bytes + at, &counts, sizeof counts);
}

clast_status clx_wire_add_grain(clx_wire *wire, const clast_dem *from, int32_t i, bool is_own)
{
    CLAST_ASSERT(i >= 0 && i < from->n_grain);
    clast_status status = CLAST_OK;
    const clx_grain *g = &from->grain[i];
    const clx_neighbour_list *l = &from->list;
    const int32_t first = clx_first_item(from, i);
    clx_wire_grain record = {.number = clx_grain_number(from, i), .is_own = is_own ? 1 : 0};
    v3_copy(record.state, g->position);
    v3_copy(record.state + 3, g->velocity);
    v3_copy(record.state + 6, g->omega);
    memcpy(record.state + 9, from->motion[i].orientation, 4 * sizeof(double));
    v3_copy(record.state + 13, from->motion[i].angular);
    record.state[16] = from->travel[i];
    record.state[17] = g->held;
    CLX_TRY(append(wire, &record, sizeof record));
    for (int32_t k = first; k < first + clx_n_item(from, i); ++k) {
        clx_wire_item item = {.is_known = k < l->n_known};
        if (item.is_known) {
            item.anchor = l->anchor[k];
            item.limit = l->limit[k];
            item.is_stale = l->is_stale[k];
        }
        CLX_TRY(append(wire, &item, sizeof item));
    }
done:
    return status;
}

clast_status clx_wire_add_pair(clx_wire *wire, const clast_dem *whole, const clast_dem *from,
                               int64_t k)
{
    CLAST_ASSERT(k >= 0 && k < from->list.n_pair);
    const clx_neighbour_list *l = &from->list;
    clx_wire_pair record = {.pair = l->pair[k]};
    record.pair.a = clx_item_to_whole(whole, from, l->pair[k].a);
    record.pair.b = clx_item_to_whole(whole, from, l->pair[k].b);
    record.pair.slot = l->pair[k].slot != 0;
    if (record.pair.slot != 0) {
        record.warm_start = l->warm_start[l->pair[k].slot].record;
    }
    if (from->law.has_history) {
        record.history = l->history[k];
    }
    return append(wire, &record, sizeof record);
}

static int by_number(const void *left, const void *right)
{
    const clx_wire_grain *a = *(const clx_wire_grain *const *)left;
    const clx_wire_grain *b = *(const clx_wire_grain *const *)right;
    return a->number != b->number ? (a->number > b->number) - (a->number < b->number)
                                  : b->is_own - a->is_own;
}

static int by_items(const void *left, const void *right)
{
    const clx_dem_pair *a = &(*(const clx_wire_pair *const *)left)->pair;
    const clx_dem_pair *b = &(*(const clx_wire_pair *const *)right)->pair;
    return a->a != b->a ? (a->a > b->a) - (a->a < b->a)
                        : clx_pair_order(a->b, a->period, b->b, b->period);
}

/// Each grain once, from its owner where it came from there.
static void sort_grains(clx_arrivals *a)
{
    int64_t n = 0;
    if (a->n_grain > 1) {
        qsort(a->grain, (size_t)a->n_grain, sizeof *a->grain, by_number);
    }
    for (int64_t i = 0; i < a->n_grain; ++i) {
        if (n == 0 || a->grain[n - 1]->number != a->grain[i]->number) {
            a->grain[n++] = a->grain[i];
        }
    }
    a->n_grain = n;
}

clast_status clx_wire_read(const clast_dem *whole, const char *bytes, int64_t n,
                           clx_arrivals *arrivals)
{
    clast_status status = CLAST_OK;
    clx_arrivals a = {0};
    const char *at = bytes;
    while (at < bytes + n) {
        const header *counts = (const header *)(const void *)at;
        at += sizeof *counts;
        CLX_TRY(
            clx_grow(&a.grain, &a.grain_capacity, a.n_grain + counts->n_grain, sizeof *a.grain));
        CLX_TRY(clx_grow(&a.pair, &a.pair_capacity, a.n_pair + counts->n_pair, sizeof *a.pair));
        for (int64_t i = 0; i < counts->n_grain; ++i) {
            const clx_wire_grain *g = (const clx_wire_grain *)(const void *)at;
            a.grain[a.n_grain++] = g;
            at += sizeof *g + (size_t)clx_n_item(whole, g->number) * sizeof(clx_wire_item);
        }
        for (int64_t i = 0; i < counts->n_pair; ++i) {
            a.pair[a.n_pair++] = (const clx_wire_pair *)(const void *)at;
            at += sizeof(clx_wire_pair);
        }
    }
    CLAST_ASSERT(at == bytes + n);
    sort_grains(&a);
    if (a.n_pair > 1) {
        qsort(a.pair, (size_t)a.n_pair, sizeof *a.pair, by_items);
    }
    *arrivals = a;
    a = (clx_arrivals){0};
done:
    clx_arrivals_free(&a);
    return status;
}

void clx_wire_set_state(clast_dem *dem, int32_t i, const clx_wire_grain *from)
{
    CLAST_ASSERT(i >= 0 && i < dem->n_grain);
    clx_grain *g = &dem->grain[i];
    clx_motion *m = &dem->motion[i];
    v3_copy(g->position, from->state);
    v3_copy(g->velocity, from->state + 3);
    v3_copy(g->omega, from->state + 6);
    memcpy(m->orientation, from->state + 9, sizeof m->orientation);
    v3_copy(m->angular, from->state + 13);
    dem->travel[i] = from->state[16];
    g->held = from->state[17];
    if (g->kind != CLAST_SHAPE_SPHERE) {
        q_matrix(g->rotation, m->orientation);
    }
    if (dem->item != NULL) {
        clx_items_place(dem, i);
    }
}
