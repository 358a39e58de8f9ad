// Blocks of cells are cut by the number of occupied cells alone, and each is summed by one rank,
// its points in the order of their places: the sums of a block, and those of all added block by
// block, are the bytes of one process. Along the last axis a block is a slab, so what neighbours
// its points is a stretch of the keys.
#include "cloud/pair_partition.h"

#include "base/alloc.h"
#include "cloud/part.h"
#include <clast/machine.h>
#include <string.h>

/// Occupied cells of this rank's stretch.
static int64_t count_cells(const clx_ranked *r)
{
    int64_t n = 0;
    for (int64_t i = 0; i < r->n; ++i) {
        n += i == 0 || r->key[i] != r->key[i - 1] ? 1 : 0;
    }
    return n;
}

/// First keys and work of the blocks that begin or lie here; n_cell are on the ranks before.
static void count_blocks(const clx_ranked *r, int64_t n_cell, int64_t cells_a_block,
                         int64_t first[CLX_PAIR_BLOCKS], int64_t work[CLX_PAIR_BLOCKS])
{
    for (int64_t i = 0, next = 0; i < r->n; i = next) {
        for (next = i + 1; next < r->n && r->key[next] == r->key[i]; ++next) {
        }
        const int64_t b = n_cell / cells_a_block;
        CLAST_ASSERT(b < CLX_PAIR_BLOCKS);
        first[b] = n_cell % cells_a_block == 0 ? (int64_t)r->key[i] : first[b];
        work[b] += (next - i) * (next - i);
        ++n_cell;
    }
}

/// Blocks of each rank follow one another and have work alike.
static void share_out_blocks(const clast_comm *comm, clx_pair_partition *partition)
{
    double before = 0.0;
    partition->begin = partition->end = 0;
    for (int32_t b = 0; b < partition->n_block; ++b) {
        const double middle = (before + 0.5 * partition->candidates[b]) / partition->work;
        const int32_t last = comm->n_rank - 1;
        const int32_t owner =
            middle * comm->n_rank < last ? (int32_t)(middle * comm->n_rank) : last;
        before += partition->candidates[b];
        partition->begin += owner < comm->rank ? 1 : 0;
        partition->end += owner <= comm->rank ? 1 : 0;
    }
}

clast_status clx_pair_partition_make(const clast_comm *comm, const clx_pair_cells *grid,
                                     uint64_t **key, int64_t n, clx_pair_partition *partition)
{
    clast_status status = CLAST_OK;
    clx_ranked r = {0};
    int64_t sums[2][CLX_PAIR_BLOCKS] = {{0}}; // first keys and work
    int64_t before = 0;
    int64_t n_cell = 0;
    CLX_TRY(clx_ranked_sort(comm, key, n, clx_pair_keys(grid), &r));
    CLX_TRY(clx_comm_before(comm, count_cells(&r), &before, &n_cell));
    const int64_t cells_a_block = (n_cell + CLX_PAIR_BLOCKS - 1) / CLX_PAIR_BLOCKS;
    count_blocks(&r, before, cells_a_block, sums[0], sums[1]);
    clx_comm_sum(comm, sums[0], (int64_t)2 * CLX_PAIR_BLOCKS);
    *partition =
        (clx_pair_partition){.n_block = (int32_t)((n_cell + cells_a_block - 1) / cells_a_block)};
    for (int32_t b = 0; b < partition->n_block; ++b) {
        partition->first[b] = (uint64_t)sums[0][b];
        partition->candidates[b] = (double)sums[1][b];
        partition->work += partition->candidates[b];
    }
    partition->first[partition->n_block] = clx_pair_keys(grid);
    share_out_blocks(comm, partition);
done:
    clx_ranked_free(&r);
    return status;
}

/// First of the sorted entries whose key is at least `key`.
static int64_t first_from(const clx_keyed *entry, int64_t n, uint64_t key)
{
    int64_t begin = 0;
    while (begin < n) {
        const int64_t middle = begin + (n - begin) / 2;
        if (entry[middle].key < key) {
            begin = middle + 1;
        } else {
            n = middle;
        }
    }
    return begin;
}

/// Which of the sorted points a rank with the blocks [begin, end) needs: range [2].
static void find_needed(const clx_pair_cells *grid, const clx_pair_partition *partition,
                        const int32_t block[2], const clx_keyed *entry, int64_t n, int64_t range[2])
{
    const uint64_t offset = clx_pair_offset(grid);
    range[0] = range[1] = 0;
    if (block[0] < block[1]) {
        const uint64_t low = partition->first[block[0]];
        range[0] = first_from(entry, n, low > offset ? low - offset : 0);
        range[1] = first_from(entry, n, partition->first[block[1]] + offset);
    }
}

typedef struct {
    int32_t (*block)[2]; ///< [n_rank] blocks of each rank
    int64_t (*range)[2]; ///< [n_rank] its points among those here, sorted by their cells
    int64_t *n_out;      ///< [n_rank] bytes
    double *out;
} parcel;

static clast_status alloc_parcel(int32_t n_rank, parcel *p)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&p->block, n_rank, sizeof *p->block));
    CLX_TRY(clx_alloc(&p->range, n_rank, sizeof *p->range));
    CLX_TRY(clx_alloc(&p->n_out, n_rank, sizeof *p->n_out));
done:
    return status;
}

/// The blocks of all ranks.
static clast_status share_blocks(const clast_comm *comm, const clx_pair_partition *partition,
                                 parcel *p)
{
    clast_status status = CLAST_OK;
    clx_gathered all = {0};
    const int32_t own[2] = {partition->begin, partition->end};
    CLX_TRY(clx_comm_share(comm, own, (int64_t)sizeof own, &all));
    memcpy(p->block, all.bytes, (size_t)all.n);
done:
    clx_gathered_free(&all);
    return status;
}

/// The points for each rank, one rank's behind the other's.
static clast_status fill_parcel(const clast_comm *comm, const clx_pair_points *points, int32_t d,
                                parcel *p)
{
    clast_status status = CLAST_OK;
    int64_t n = 0;
    const size_t size = (size_t)d * sizeof *points->x;
    for (int32_t k = 0; k < comm->n_rank; ++k) {
        n += p->range[k][1] - p->range[k][0];
    }
    CLX_TRY(clx_alloc(&p->out, n * d, sizeof *p->out));
    n = 0;
    for (int32_t k = 0; k < comm->n_rank; ++k) {
        for (int64_t i = p->range[k][0]; i < p->range[k][1]; ++i) {
            memcpy(p->out + n++ * d, points->x + (int64_t)points->entry[i].item * d, size);
        }
        p->n_out[k] = (p->range[k][1] - p->range[k][0]) * (int64_t)size;
    }
done:
    return status;
}

clast_status clx_pair_partition_points(const clast_comm *comm, const clx_pair_cells *grid,
                                       const clx_pair_partition *partition,
                                       const clx_pair_points *points, double **got, int64_t *n_got)
{
    clast_status status = CLAST_OK;
    parcel p = {0};
    clx_gathered in = {0};
    double *sorted = NULL;
    status = alloc_parcel(comm->n_rank, &p);
    if (status == CLAST_OK) {
        status = clx_sort_keyed(points->entry, points->n);
    }
    CLX_TRY(clast_comm_agree(comm, status, NULL));
    CLX_TRY(share_blocks(comm, partition, &p));
    for (int32_t k = 0; k < comm->n_rank; ++k) {
        find_needed(grid, partition, p.block[k], points->entry, points->n, p.range[k]);
    }
    CLX_TRY(clast_comm_agree(comm, fill_parcel(comm, points, grid->d, &p), NULL));
    CLX_TRY(clx_comm_exchange(comm, p.out, p.n_out, &in));
    *n_got = in.n / (grid->d * (int64_t)sizeof *sorted);
    status = clx_alloc(&sorted, *n_got * grid->d, sizeof *sorted);
    if (status == CLAST_OK) {
        status = clx_sort_places((const void *)in.bytes, *n_got, grid->d, sorted);
    }
    CLX_TRY(clast_comm_agree(comm, status, NULL));
    *got = sorted;
    sorted = NULL;
done:
    clx_gathered_free(&in);
    CLX_FREE(sorted, p.block, p.range, p.n_out, p.out);
    return status;
}
