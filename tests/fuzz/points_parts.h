#pragma once
// One text of points, read whole and by n ranks. The ranks are read one after another: what the
// first ones said is replayed to the later ones, which is all that a reader asks of its comm.
#include "io/points.h"
#include <clast/cloud.h>
#include <clast/machine.h>
#include <clast/status.h>
#include <clast/table.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { REPLAY_CALLS = 64, REPLAY_BYTES = 2048 };

/// What the ranks before said, call by call.
typedef struct {
    int32_t rank;
    int n_broadcast, n_sum; ///< calls of this rank
    char bytes[REPLAY_CALLS][REPLAY_BYTES];
    int64_t sum[REPLAY_CALLS][8];
} replay;

static int64_t replay_least(void *context, int64_t value)
{
    (void)context; // the first that fails ends the reading
    return value;
}

static void replay_broadcast(void *context, int32_t root, void *bytes, int64_t n)
{
    replay *r = context;
    if (root == 0 && n <= REPLAY_BYTES && r->n_broadcast < REPLAY_CALLS) {
        char *kept = r->bytes[r->n_broadcast++];
        memcpy(r->rank == 0 ? kept : bytes, r->rank == 0 ? bytes : kept, (size_t)n);
    }
}

static void replay_sum(void *context, int64_t *value, int64_t n)
{
    replay *r = context;
    int64_t *sum = r->sum[r->n_sum++ % REPLAY_CALLS];
    for (int64_t i = 0; i < n && i < 8; ++i) {
        sum[i] += value[i];
        value[i] = sum[i];
    }
}

static void replay_exchange(void *context, const void *out, const int64_t *n_out, void *in,
                            const int64_t *n_in)
{
    (void)context;
    (void)out;
    (void)n_out;
    (void)in;
    (void)n_in;
    abort(); // a reader exchanges nothing
}

/// Whether the rows of a part are those of the whole from `first` on.
static bool is_part_of(const clast_cloud *whole, const clast_cloud *part, int64_t first)
{
    const size_t size = (size_t)part->n * sizeof *part->x;
    const size_t row = (size_t)whole->dimension;
    if (part->dimension != whole->dimension || part->n > whole->n - first || whole->x == NULL ||
        part->x == NULL) {
        return false;
    }
    return part->n == 0 || (memcmp(part->x, whole->x + first * whole->dimension, size * row) == 0 &&
                            (whole->variable == NULL ||
                             memcmp(part->variable, whole->variable + first, size) == 0));
}

/// Reads a file by n ranks: the status that they agree on, and whether their rows are the whole's.
static clast_status read_parts(const char *path, const clast_cloud_columns *columns, int32_t n_rank,
                               const clast_cloud *whole, bool *is_same)
{
    replay *r = calloc(1, sizeof *r);
    clast_status status = r != NULL ? CLAST_OK : CLAST_E_MEMORY;
    int64_t n = 0;
    *is_same = true;
    for (int32_t k = 0; k < n_rank && status == CLAST_OK; ++k) {
        const clast_comm comm = {.rank = k,
                                 .n_rank = n_rank,
                                 .least = replay_least,
                                 .broadcast = replay_broadcast,
                                 .sum = replay_sum,
                                 .exchange = replay_exchange,
                                 .context = r};
        clast_cloud part = {0};
        r->rank = k;
        r->n_broadcast = 0;
        r->n_sum = 0;
        status = clast_cloud_read_ranks(&comm, path, columns, NULL, &part);
        if (status == CLAST_OK) {
            *is_same = *is_same && is_part_of(whole, &part, n);
            n += part.n;
        }
        clast_cloud_free(&part);
    }
    *is_same = *is_same && n == whole->n;
    free(r);
    return status;
}

/// The name of the k-th column of numbers that a list of columns can hold; "" where there is none.
static char *number_column(const clast_table *table, int k)
{
    static char none[] = "";
    for (int32_t c = 0; c < table->n_column; ++c) {
        const clast_column *column = &table->column[c];
        if (column->number != NULL && strchr(column->name, ',') == NULL && k-- == 0) {
            return column->name;
        }
    }
    return none;
}

/// Whether ranks read a file as one process does: the same rows, or a refusal too. Quoted cells,
/// and what is no delimited text, they may refuse alone.
static bool reads_alike(const char *path, const char *bytes, size_t n, int32_t n_rank)
{
    clast_table table = {0};
    clast_cloud whole = {0};
    static char x[] = "x";
    const clast_status is_kind = clx_points_check_kind(path, bytes, n); // not of OpenFOAM, ...
    const clast_status is_table =
        is_kind != CLAST_OK ? is_kind : clast_table_parse_csv(path, bytes, n, NULL, &table, NULL);
    char *first = is_table == CLAST_OK ? number_column(&table, 0) : x;
    clast_text_list list = {.n = 1, .item = &first};
    const clast_cloud_columns columns = {.columns = list,
                                         .variable_column = number_column(&table, 1)};
    const clast_status status =
        is_table == CLAST_OK ? clast_cloud_from_table(&table, &columns, &whole) : is_table;
    bool is_same = false;
    const clast_status found = read_parts(path, &columns, n_rank, &whole, &is_same);
    const bool may_refuse = (n > 0 && memchr(bytes, '"', n) != NULL) ||
                            (n >= 4 && memcmp(bytes, "\x89HDF", 4) == 0) ||
                            strstr(clast_error_detail(), "no other format") != NULL;
    clast_cloud_free(&whole);
    clast_table_free(&table);
    return found == CLAST_OK ? status == CLAST_OK && is_same : status != CLAST_OK || may_refuse;
}
