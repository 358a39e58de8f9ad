// An aggregate from what an earlier run had placed: the grains are entered again in their order, so
// that scene, sums and envelopes come out the same to the last bit.
#include "aggregate/state.h"

#include "base/alloc.h"
#include <string.h>

static clast_status check_shapes(const clast_aggregate *a, const clast_assembly *placed)
{
    bool same = placed->n_shape == a->assembly.n_shape;
    for (int32_t i = 0; i < placed->n_shape && same; ++i) {
        const clast_shape *x = &placed->shape[i];
        const clast_shape *y = &a->assembly.shape[i];
        same = strcmp(x->name, y->name) == 0 && x->kind == y->kind && x->volume == y->volume &&
               x->length == y->length && x->spheres.n == y->spheres.n &&
               x->mesh.n_tri == y->mesh.n_tri;
    }
    return same ? CLAST_OK
                : clx_fail(CLAST_E_FORMAT,
                           "the saved grains have other shapes than the configuration names");
}

clast_status clast_aggregate_restore(const clast_aggregate_params *params,
                                     const clast_aggregate_input *input,
                                     const clast_aggregate_saved *saved,
                                     clast_aggregate **aggregate)
{
    CLX_ARGUMENTS(params, input, saved, aggregate);
    clast_status status = CLAST_OK;
    clast_aggregate *a = NULL;
    CLX_TRY(clx_alloc(&a, 1, sizeof *a));
    CLX_TRY(clx_aggregate_begin(params, input, saved->repeat, a));
    CLX_TRY(check_shapes(a, saved->placed));
    CLX_TRY(clx_history_read(&a->history, saved->history));
    CLX_TRY(a->mode->restore(a, saved));
    a->stop = clx_aggregate_stop_now(a);
    *aggregate = a;
    a = NULL;
done:
    clast_aggregate_destroy(a);
    return status;
}
