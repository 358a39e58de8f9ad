// An aggregate from what an earlier run had placed: the grains are entered again in their order, so
// that scene, sums and envelopes come out the same to the last bit.
#include "aggregate/grow.h"

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

static clast_status copy_grains(clast_aggregate *a, const clast_assembly *placed)
{
    clast_status status = CLAST_OK;
    for (int32_t i = 0; i < placed->n_grain; ++i) {
        CLX_TRY(clast_assembly_add_grain(&a->assembly, placed->shape_id[i], placed->position[i],
                                         placed->orientation[i], placed->scale[i],
                                         placed->density[i]));
    }
    CLX_TRY(clx_aggregate_account_all(a, 0));
    CLX_TRY(clx_aggregate_track(a, 0));
    for (int32_t i = 0; i < placed->n_contact; ++i) {
        CLX_TRY(clast_assembly_add_contact(&a->assembly, placed->contact[i][0],
                                           placed->contact[i][1], placed->contact_point[i]));
    }
done:
    return status;
}

/// Grains that the core and the placed particles have together.
static int64_t count_grains(const clast_aggregate *a)
{
    int64_t n = a->kit.group[0].n_part;
    for (int64_t r = 1; r < a->history.n_row; ++r) {
        const double shape = a->history.value[r * a->history.n_column + CLX_HISTORY_SHAPE];
        if (!(shape >= 0.0 && shape < a->kit.n_group - 1)) {
            return -1;
        }
        n += a->kit.group[1 + (int32_t)shape].n_part;
    }
    return n;
}

static clast_status restore_core(clast_aggregate *a, const clast_assembly *placed)
{
    clast_status status = CLAST_OK;
    a->n_core = a->kit.group[0].n_part;
    a->n_placed = (int32_t)a->history.n_row - 1;
    CLX_CHECK(a->history.n_row >= 1 && a->n_placed <= a->n_step &&
                  count_grains(a) == placed->n_grain,
              CLAST_E_FORMAT, "%lld saved rows and %d saved grains do not belong together",
              (long long)a->history.n_row, placed->n_grain);
    CLX_TRY(copy_grains(a, placed));
    CLX_TRY(clx_aggregate_resolve_origin(a));
done:
    return status;
}

static clast_status restore_clusters(clast_aggregate *a, const clast_assembly *placed,
                                     const clast_table *members)
{
    clast_status status = CLAST_OK;
    a->n_placed = (int32_t)a->history.n_row;
    CLX_CHECK(a->n_placed <= a->n_step, CLAST_E_FORMAT, "%d saved mergers of %d", a->n_placed,
              a->n_step);
    CLX_TRY(copy_grains(a, placed));
    CLX_TRY(clx_clusters_restore(a, members));
done:
    return status;
}

clast_status clast_aggregate_restore(const clast_aggregate_config *config,
                                     const clast_aggregate_input *input,
                                     const clast_aggregate_saved *saved,
                                     clast_aggregate **aggregate)
{
    CLX_ARGUMENTS(config, input, saved, aggregate);
    CLX_GUARD(clast_fields_check(clast_aggregate_fields, config));
    clast_status status = CLAST_OK;
    clast_aggregate *a = NULL;
    CLX_TRY(clx_alloc(&a, 1, sizeof *a));
    CLX_TRY(clx_aggregate_begin(config, input, saved->repeat, a));
    CLX_TRY(check_shapes(a, saved->placed));
    CLX_TRY(clx_history_read(&a->history, saved->history));
    CLX_TRY(config->mode == CLAST_AGGREGATE_CLUSTER
                ? restore_clusters(a, saved->placed, saved->members)
                : restore_core(a, saved->placed));
    a->stop = clx_aggregate_stop_now(a);
    *aggregate = a;
    a = NULL;
done:
    clast_aggregate_destroy(a);
    return status;
}
