// Real volumes of the cells of a mesh domain. [docs/theory/decompose.md section 12]
#include "cloud/cut_cells.h"

#include "base/alloc.h"
#include "base/comm.h"
#include "base/parallel.h"
#include "cloud/surface.h"
#include "geom/cut_volume.h"
#include <clast/machine.h>
#include <math.h>

static double box_volume(const clast_domain *domain)
{
    double volume = 1.0;
    for (int k = 0; k < 3; ++k) {
        volume *= domain->high[k] - domain->low[k];
    }
    return volume;
}

/// Cells out of bins: sums over their bins.
static clast_status cut_bins(const clast_domain *domain, clast_cells *cells)
{
    clast_status status = CLAST_OK;
    double *share = NULL;
    clx_cut_grid grid;
    int64_t n_bin = 1;
    for (int k = 0; k < 3; ++k) {
        grid.low[k] = domain->low[k];
        grid.high[k] = domain->high[k];
        grid.nb[k] = cells->nb[k];
        n_bin *= cells->nb[k];
    }
    CLX_TRY(clx_alloc(&share, n_bin, sizeof *share));
    CLX_TRY(clx_cut_grid_shares(&domain->surface->mesh, &grid, share));
    for (int32_t c = 0; c < cells->n; ++c) {
        cells->volume[c] = 0.0;
    }
    for (int64_t b = 0; b < n_bin; ++b) {
        cells->volume[cells->of_bin[b]] += share[b];
        cells->of_bin[b] = share[b] > 0.0 ? cells->of_bin[b] : -1;
    }
    for (int32_t c = 0; c < cells->n; ++c) {
        cells->volume[c] *= box_volume(domain) / (double)n_bin;
    }
done:
    clx_free(share);
    return status;
}

typedef struct {
    const clast_domain *domain;
    clast_cells *cells;
} box_context;

static void cut_boxes(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const box_context *b = context;
    (void)worker;
    for (int64_t c = begin; c < end; ++c) {
        double corner[2][3];
        clast_domain_unmap(b->domain, b->cells->low[c], corner[0]);
        clast_domain_unmap(b->domain, b->cells->high[c], corner[1]);
        b->cells->volume[c] *= box_volume(b->domain) *
                               clx_cut_box_share(b->domain->surface->bvh, corner[0], corner[1]);
    }
}

/// Nearest cell with a volume, by boxes.
static int32_t nearest_cell(const clast_cells *cells, const double *u)
{
    CLAST_ASSERT(cells->n > 0);
    int32_t nearest = 0;
    double least = INFINITY;
    for (int32_t c = 0; c < cells->n; ++c) {
        double far = 0.0;
        for (int k = 0; k < 3; ++k) {
            far += fmax(0.0, fmax(cells->low[c][k] - u[k], u[k] - cells->high[c][k]));
        }
        if (cells->volume[c] > 0.0 && far < least) {
            least = far;
            nearest = c;
        }
    }
    return nearest;
}

static void move_cell(clast_cells *cells, int32_t from, int32_t to)
{
    CLAST_ASSERT(to >= 0 && to <= from && from < cells->n);
    for (int k = 0; k < 3; ++k) {
        cells->low[to][k] = cells->low[from][k];
        cells->high[to][k] = cells->high[from][k];
    }
    cells->volume[to] = cells->volume[from];
    cells->count[to] = cells->count[from];
    if (cells->key != NULL) {
        cells->key[to] = cells->key[from];
    }
    if (cells->group != NULL) {
        cells->group[to] = cells->group[from];
    }
    cells->label[to] = cells->label[from];
    cells->pass[to] = cells->pass[from];
}

static clast_status leave_out_empty(const clx_sample *m, clast_cells *cells)
{
    clast_status status = CLAST_OK;
    int32_t *number = NULL;
    int64_t *moved = NULL; // points that a cell gets, less those that it loses
    int32_t n = 0;
    status = clx_alloc(&number, cells->n, sizeof *number);
    if (status == CLAST_OK) {
        status = clx_alloc(&moved, cells->n, sizeof *moved);
    }
    CLX_TRY(clast_comm_agree(m->comm, status, NULL));
    CLAST_ASSERT(number != NULL && moved != NULL);
    for (int64_t i = 0; i < m->n; ++i) { // points on the surface
        const int32_t c = m->number[i] >= 0 ? cells->of_point[m->number[i]] : -1;
        if (c >= 0 && !(cells->volume[c] > 0.0)) {
            const int32_t other = nearest_cell(cells, m->u + 3 * i);
            cells->of_point[m->number[i]] = other;
            --moved[c];
            ++moved[other];
        }
    }
    clx_comm_sum(m->comm, moved, cells->n);
    for (int32_t c = 0; c < cells->n; ++c) {
        cells->count[c] += moved[c];
        number[c] = cells->volume[c] > 0.0 ? n : -1;
        if (number[c] >= 0) {
            move_cell(cells, c, n++);
        }
    }
    cells->n = n;
    for (int64_t i = 0; i < m->n; ++i) {
        if (m->number[i] >= 0) {
            cells->of_point[m->number[i]] = number[cells->of_point[m->number[i]]];
        }
    }
    const int64_t n_bin = (int64_t)cells->nb[0] * cells->nb[1] * cells->nb[2];
    for (int64_t b = 0; b < n_bin && cells->of_bin != NULL; ++b) {
        cells->of_bin[b] = cells->of_bin[b] >= 0 ? number[cells->of_bin[b]] : -1;
    }
done:
    CLX_FREE(number, moved);
    return status;
}

clast_status clx_cells_cut(const clx_sample *sample, clast_cells *cells)
{
    clast_status status = CLAST_OK;
    box_context context = {sample->domain, cells};
    if (cells->n == 1) {
        cells->volume[0] = sample->domain->surface->volume;
        return CLAST_OK;
    }
    if (cells->of_bin != NULL) {
        CLX_TRY(clast_comm_agree(sample->comm, cut_bins(sample->domain, cells), NULL));
    } else {
        clx_parallel_for(cells->n, 16, cut_boxes, &context);
    }
    CLX_TRY(leave_out_empty(sample, cells));
done:
    return status;
}
