// Groups of grains that contacts join, and one of them alone.
#include "assembly/pieces.h"

#include "assembly/whole.h"
#include "base/alloc.h"
#include "geom/union_find.h"
#include <clast/assembly.h>
#include <clast/shape.h>
#include <string.h>

clast_status clx_assembly_pieces(const clast_assembly *assembly, int32_t *piece, int32_t *n_piece)
{
    clast_status status = CLAST_OK;
    int32_t *parent = NULL;
    int32_t n = 0;
    CLX_TRY(clx_alloc(&parent, assembly->n_grain, sizeof *parent));
    clx_sets_init(parent, assembly->n_grain);
    for (int32_t c = 0; c < assembly->n_contact; ++c) {
        clx_sets_join(parent, assembly->contact[c][0], assembly->contact[c][1]);
    }
    for (int32_t i = 0; i < assembly->n_grain; ++i) { // a group's root is its first grain
        const int32_t root = clx_sets_find(parent, i);
        piece[i] = root == i ? n++ : piece[root];
    }
    *n_piece = n;
done:
    clx_free(parent);
    return status;
}

/// Copies the chosen grains; at[i] is where grain i went, -1 for nowhere.
static clast_status copy_grains(const clast_assembly *all, const int32_t *of, int32_t which,
                                int32_t *at, clast_assembly *part)
{
    clast_status status = CLAST_OK;
    for (int32_t i = 0; i < all->n_grain; ++i) {
        at[i] = of[i] == which ? part->n_grain : -1;
        if (at[i] >= 0) {
            CLX_TRY(clast_assembly_add_grain(part, all->shape_id[i], all->position[i],
                                             all->orientation[i], all->scale[i], all->density[i]));
            part->id[at[i]] = all->id[i];
        }
    }
done:
    return status;
}

clast_status clx_assembly_part(const clast_assembly *assembly, const int32_t *of, int32_t which,
                               clast_assembly *part)
{
    clast_status status = CLAST_OK;
    clast_assembly made = {0};
    int32_t *at = NULL;
    CLX_TRY(clx_alloc(&at, assembly->n_grain, sizeof *at));
    memcpy(made.unit, assembly->unit, sizeof made.unit);
    CLX_TRY(clx_assembly_add_shapes(&made, assembly->n_shape, assembly->shape, sizeof *made.shape));
    CLX_TRY(copy_grains(assembly, of, which, at, &made));
    for (int32_t c = 0; c < assembly->n_contact; ++c) {
        const int32_t i = at[assembly->contact[c][0]];
        const int32_t j = at[assembly->contact[c][1]];
        if (i >= 0 && j >= 0) {
            CLX_TRY(clast_assembly_add_contact(&made, i, j, assembly->contact_point[c]));
        }
    }
    *part = made;
    made = (clast_assembly){0};
done:
    clx_free(at);
    clast_assembly_free(&made);
    return status;
}
