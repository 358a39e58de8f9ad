// The state of a growing aggregate: its grains, their sums, its rows. All else follows from them.
#include "aggregate/state.h"

#include "aggregate/sizes.h"
#include "base/alloc.h"
#include "math/vec3.h"
#include <math.h>

void clx_aggregate_free(clast_aggregate *a)
{
    clx_touch_scene_destroy(a->scene);
    clx_march_free(&a->march);
    clx_templates_free(&a->templates);
    clast_assembly_free(&a->assembly);
    clx_history_free(&a->history);
    clx_envelope_tracker_destroy(a->tracker);
    CLX_FREE(a->shape_id, a->template_shape, a->size, a->sphere_end);
}

int32_t clx_aggregate_shape(const clast_aggregate *a, int32_t particle)
{
    CLAST_ASSERT(particle >= 0 && particle < a->n_particle);
    return clx_sizes_shape(a->params, a->input->n_coat, a->seed, particle, a->size[particle]);
}

double clx_aggregate_scale(const clast_aggregate *a, int32_t particle, int32_t shape)
{
    CLAST_ASSERT(particle >= 0 && particle < a->n_particle && shape >= 0 &&
                 shape + 1 < a->templates.n_group);
    return a->size[particle] /
           clx_template_size(&a->templates.group[1 + shape], a->params->size_meaning);
}

clx_touch_body clx_aggregate_body(const clast_aggregate *a, int32_t grain)
{
    CLAST_ASSERT(grain >= 0 && grain < a->assembly.n_grain);
    const clast_assembly *all = &a->assembly;
    clx_touch_body body = a->templates.shape[a->template_shape[all->shape_id[grain]]].body;
    clx_touch_body_place(&body, all->position[grain], all->orientation[grain], all->scale[grain]);
    return body;
}

clx_aim clx_aggregate_aim(const clast_aggregate *a)
{
    return (clx_aim){.seed = a->seed,
                     .particle = a->n_placed,
                     .n_ray = a->params->rays,
                     .random_axis = a->random_axis,
                     .axis = {a->axis[0], a->axis[1], a->axis[2]},
                     .cone = a->params->cone};
}

double clx_aggregate_gyration(const clast_aggregate *a)
{
    CLAST_ASSERT(a->mass >= 0.0);
    double centre[3];
    v3_scale(centre, 1.0 / a->mass, a->moment);
    return sqrt(fmax(0.0, a->second / a->mass - v3_norm2(centre)));
}

clast_status clx_aggregate_open_row(clast_aggregate *a, double **row)
{
    clast_status status = CLAST_OK;
    double *made = NULL;
    CLX_TRY(clx_history_row(&a->history, &made));
    made[CLX_HISTORY_REPEAT] = a->repeat;
    made[CLX_HISTORY_N] = a->n_placed;
    made[CLX_HISTORY_CLUSTERS] = 1.0;
    made[CLX_HISTORY_GRAINS] = a->assembly.n_grain;
    made[CLX_HISTORY_SHAPE] = -1.0;
    made[CLX_HISTORY_TOUCHED] = -1.0;
    if (a->params->contact == CLAST_CONTACT_MARCH) { // which does not look for it
        made[CLX_HISTORY_OVERLAP] = (double)NAN;
    }
    made[CLX_HISTORY_MASS] = a->mass;
    made[CLX_HISTORY_SOLID] = a->volume;
    made[CLX_HISTORY_GYRATION] = clx_aggregate_gyration(a);
    *row = made;
done:
    return status;
}
