// Repeats from several ranks as one list.
//
// On their way to rank 0 they are bytes of this machine: a head, the result, the history's columns
// one after another. Names and units of the columns are those of rank 0's own repeats.
#include "study/aggregate_repeats.h"

#include "base/alloc.h"
#include "math/sort.h"
#include <clast/machine.h>
#include <clast/table.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    int64_t index, n_row, n_column;
} head;

static void free_repeat(clx_repeat *repeat)
{
    clast_table_free(&repeat->history);
}

void clx_repeats_free(clx_repeats *repeats)
{
    for (int32_t i = 0; i < repeats->n; ++i) {
        free_repeat(&repeats->item[i]);
    }
    clx_free(repeats->item);
    *repeats = (clx_repeats){0};
}

static clast_status append(clx_repeats *repeats, clx_repeat *repeat)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_realloc(&repeats->item, repeats->n + 1, sizeof *repeats->item));
    repeats->item[repeats->n++] = *repeat;
    *repeat = (clx_repeat){0};
done:
    return status;
}

clast_status clx_repeats_add(clx_repeats *repeats, int32_t index, clast_aggregate *aggregate)
{
    CLAST_ASSERT(index >= 0);
    clast_status status = CLAST_OK;
    clx_repeat made = {.index = index};
    CLX_TRY(clast_aggregate_measure(aggregate, &made.result));
    CLX_TRY(clast_aggregate_history(aggregate, &made.history));
    CLX_TRY(append(repeats, &made));
done:
    free_repeat(&made);
    return status;
}

static size_t packed_size(const clx_repeat *r)
{
    return sizeof(head) + sizeof r->result +
           (size_t)r->history.n_row * (size_t)r->history.n_column * sizeof(double);
}

/// Appends bytes at *to and moves it on.
static void append_bytes(char **to, const void *bytes, size_t n)
{
    if (n > 0) {
        memcpy(*to, bytes, n);
    }
    *to += n;
}

static clast_status pack(const clx_repeats *repeats, char **bytes, int64_t *n)
{
    clast_status status = CLAST_OK;
    size_t size = 0;
    for (int32_t i = 0; i < repeats->n; ++i) {
        size += packed_size(&repeats->item[i]);
    }
    CLX_TRY(clx_alloc(bytes, (int64_t)size, 1));
    *n = (int64_t)size;
    char *to = *bytes;
    for (int32_t i = 0; i < repeats->n; ++i) {
        const clx_repeat *r = &repeats->item[i];
        const clast_table *h = &r->history;
        append_bytes(&to, &(const head){r->index, h->n_row, h->n_column}, sizeof(head));
        append_bytes(&to, &r->result, sizeof r->result);
        for (int32_t c = 0; c < h->n_column; ++c) {
            append_bytes(&to, h->column[c].number, (size_t)h->n_row * sizeof(double));
        }
    }
done:
    return status;
}

/// A table of this shape with the columns of another.
static clast_status like(const clast_table *other, const head *shape, clast_table *table)
{
    clast_status status = CLAST_OK;
    double *number = NULL;
    CLX_CHECK(shape->n_column == other->n_column, CLAST_E_USAGE,
              "ranks run different programs: %lld and %d columns of history",
              (long long)shape->n_column, other->n_column);
    CLX_TRY(clast_table_init(table, other->name, shape->n_row));
    for (int32_t c = 0; c < other->n_column; ++c) {
        CLX_TRY(
            clast_table_add_number(table, other->column[c].name, other->column[c].unit, &number));
    }
done:
    return status;
}

static void unpack_bytes(const char **from, void *bytes, size_t n)
{
    if (n > 0) {
        memcpy(bytes, *from, n);
    }
    *from += n;
}

static clast_status unpack_one(const char **from, const clast_table *first, clx_repeat *repeat)
{
    clast_status status = CLAST_OK;
    head shape;
    unpack_bytes(from, &shape, sizeof shape);
    unpack_bytes(from, &repeat->result, sizeof repeat->result);
    repeat->index = (int32_t)shape.index;
    CLX_TRY(like(first, &shape, &repeat->history));
    for (int32_t c = 0; c < repeat->history.n_column; ++c) {
        unpack_bytes(from, repeat->history.column[c].number, (size_t)shape.n_row * sizeof(double));
    }
done:
    return status;
}

static clast_status unpack(const clx_gathered *all, const clast_table *first, clx_repeats *repeats)
{
    clast_status status = CLAST_OK;
    const char *from = all->bytes;
    clx_repeat made = {0};
    while (from < all->bytes + all->n) {
        CLX_TRY(unpack_one(&from, first, &made));
        CLX_TRY(append(repeats, &made));
    }
done:
    free_repeat(&made);
    return status;
}

clast_status clx_repeats_gather(const clast_comm *comm, clx_repeats *repeats)
{
    clast_status status = CLAST_OK;
    clx_gathered all = {0};
    clx_repeats made = {0};
    char *bytes = NULL;
    int64_t n = 0;
    if (comm->n_rank == 1) {
        return CLAST_OK;
    }
    CLX_TRY(clast_comm_agree(comm, pack(repeats, &bytes, &n), NULL));
    CLX_TRY(clx_comm_gather(comm, bytes, n, &all));
    if (comm->rank == 0) {
        status = unpack(&all, &repeats->item[0].history, &made);
    }
    CLX_TRY(clast_comm_agree(comm, status, NULL));
    clx_repeats_free(repeats);
    *repeats = made;
    made = (clx_repeats){0};
done:
    clx_repeats_free(&made);
    clx_gathered_free(&all);
    clx_free(bytes);
    return status;
}

CLX_RISING(by_index, clx_repeat, index)

static clast_status append_rows(clast_table *all, clast_table *rows)
{
    clast_status status = CLAST_OK;
    if (all->n_column == 0) {
        *all = *rows;
        *rows = (clast_table){0};
        return CLAST_OK;
    }
    const int64_t before = all->n_row;
    CLX_TRY(clast_table_resize(all, before + rows->n_row));
    for (int32_t c = 0; c < all->n_column; ++c) {
        memcpy(&all->column[c].number[before], rows->column[c].number,
               (size_t)rows->n_row * sizeof(double));
    }
done:
    return status;
}

clast_status clx_repeats_merge(clx_repeats *repeats, clast_aggregate_report *report,
                               clast_table *history)
{
    clast_status status = CLAST_OK;
    if (repeats->n > 1) {
        qsort(repeats->item, (size_t)repeats->n, sizeof *repeats->item, by_index);
    }
    CLX_TRY(clx_alloc(&report->result, repeats->n, sizeof *report->result));
    for (int32_t i = 0; i < repeats->n; ++i) {
        report->result[report->n++] = repeats->item[i].result;
        CLX_TRY(append_rows(history, &repeats->item[i].history));
    }
done:
    clx_repeats_free(repeats);
    return status;
}
