// A bed that begins with grains placed elsewhere.
//
// Grains that overlap are parted by their springs, whose energy the dashpots take; how many there
// are, and how deep, is told. Deeper than dem/start.c allows, the run ends before its first step.
// [docs/theory/load.md "Starts from elsewhere"]
#include "pack/start.h"

#include "base/alloc.h"
#include "dem/dem.h"
#include "dem/touch.h"
#include <clast/assembly.h>
#include <clast/status.h>
#include <math.h>

clast_status clx_pack_start_check(clast_pack *p)
{
    clast_status status = CLAST_OK;
    const clast_assembly *a = p->input.start;
    for (int32_t i = 0; i < a->n_shape; ++i) {
        CLX_CHECK(!a->shape[i].own.is_mixed, CLAST_E_CONFIG,
                  "start: shape %s has parts of several densities; such grains cannot be brought",
                  a->shape[i].name);
    }
    p->config.mass = clast_assembly_mass(a);
done:
    return status;
}

void clx_pack_start_densities(const clast_pack *p, double *low, double *high)
{
    const clast_assembly *a = p->input.start;
    *low = INFINITY;
    *high = 0.0;
    for (int32_t i = 0; i < a->n_grain; ++i) {
        *low = fmin(*low, a->density[i]);
        *high = fmax(*high, a->density[i]);
    }
}

/// Overlaps of the grains as they were brought, which every rank finds: none has begun.
static clast_status count_overlaps(clast_pack *p)
{
    clast_status status = CLAST_OK;
    clast_dem *dem = p->dem;
    CLX_TRY(clx_neighbour_list_refresh(dem));
    for (int64_t k = 0; k < dem->list.n_pair; ++k) {
        const clx_dem_pair *pair = &dem->list.pair[k];
        clx_dem_touch t = {0};
        clx_find_again(dem, pair, &t);
        if (t.distance < 0.0) {
            const double ra = clx_item_radius(dem, pair->a);
            const double rb = pair->b >= 0 ? clx_item_radius(dem, pair->b) : ra;
            ++p->n_overlap;
            p->deepest = fmax(p->deepest, -t.distance / fmin(ra, rb));
        }
    }
done:
    return status;
}

clast_status clx_pack_start_place(clast_pack *p)
{
    clast_status status = CLAST_OK;
    const clast_assembly *a = p->input.start;
    clast_dem_grain *grain = NULL;
    CLX_TRY(clx_alloc(&grain, a->n_grain, sizeof *grain));
    if (p->dem->cell != NULL) {
        p->dem->cell->shift = p->input.start_shift;
    }
    for (int32_t i = 0; i < a->n_grain; ++i) {
        clast_dem_grain *g = &grain[i];
        *g = (clast_dem_grain){
            .shape = a->shape_id[i], .scale = a->scale[i], .density = a->density[i]};
        v3_copy(g->position, a->position[i]);
        for (int k = 0; k < 4; ++k) {
            g->orientation[k] = a->orientation[i][k];
        }
        if (p->dem->cell != NULL) {
            clx_cell_wrap(p->dem->cell, g->position);
        }
    }
    CLX_TRY(clast_dem_add_grains(p->dem, a->n_grain, grain));
    CLX_TRY(count_overlaps(p));
    p->n_made = p->n_drawn = a->n_grain;
    p->mass = p->drawn_mass = p->config.mass;
    p->n_fill = 1;
    p->fill_step = clast_dem_n_step(p->dem);
done:
    clx_free(grain);
    return status;
}
