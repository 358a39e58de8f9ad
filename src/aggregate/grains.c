// What every placed grain adds: to the assembly, the scene and the sums.
#include "aggregate/state.h"

#include "base/alloc.h"
#include "base/clock.h"
#include "math/vec3.h"
#include "touch/tree.h"
#include <math.h>

static clast_status enter_scene(clast_aggregate *a, int32_t grain)
{
    CLAST_ASSERT(grain >= 0 && grain < a->assembly.n_grain &&
                 clx_touch_scene_count(a->scene) == grain);
    clast_status status = CLAST_OK;
    const int64_t before = grain > 0 ? a->sphere_end[grain - 1] : 0;
    const clx_touch_body body = clx_aggregate_body(a, grain);
    CLX_TRY(clx_touch_scene_insert(a->scene, &body));
    CLX_TRY(clx_grow(&a->sphere_end, &a->sphere_capacity, grain + 1, sizeof *a->sphere_end));
    a->sphere_end[grain] = before + (body.tree != NULL ? body.tree->n_item : 1);
done:
    return status;
}

/// The composite of a grain enters the march: its centroid follows from the stored pose, so that a
/// restored run has the same bits.
static clast_status enter_march(clast_aggregate *a, int32_t grain)
{
    const clast_assembly *all = &a->assembly;
    const int32_t shape = a->templates.shape[a->template_shape[all->shape_id[grain]]].group;
    double centroid[3];
    q_rotate(centroid, all->orientation[grain], a->march.shape[shape].centroid);
    v3_axpy(centroid, all->position[grain], all->scale[grain], centroid);
    return clx_march_add(&a->march, shape, centroid, all->orientation[grain], all->scale[grain]);
}

static clast_status account(clast_aggregate *a, int32_t grain)
{
    CLAST_ASSERT(grain >= 0 && grain < a->assembly.n_grain);
    clast_status status = CLAST_OK;
    const clast_assembly *all = &a->assembly;
    const clx_template_shape *shape = &a->templates.shape[a->template_shape[all->shape_id[grain]]];
    const double s = all->scale[grain];
    const double volume = shape->shape->volume * s * s * s;
    const double mass = volume * all->density[grain];
    const double own = shape->inertia_trace / shape->shape->volume * s * s;
    if (a->scene != NULL) {
        CLX_TRY(enter_scene(a, grain));
    }
    if (a->march.n_shape > 0) {
        CLX_TRY(enter_march(a, grain));
    }
    a->bounding_radius =
        fmax(a->bounding_radius, v3_norm(all->position[grain]) + s * shape->shape->bounding_radius);
    a->volume += volume;
    a->mass += mass;
    a->second += mass * (v3_norm2(all->position[grain]) + own);
    v3_axpy(a->moment, a->moment, mass, all->position[grain]);
done:
    return status;
}

clast_status clx_aggregate_track(clast_aggregate *a, int32_t first)
{
    CLAST_ASSERT(first >= 0 && first <= a->assembly.n_grain);
    clast_status status = CLAST_OK;
    const double begun = clx_clock();
    for (int32_t i = first; i < a->assembly.n_grain && a->tracker != NULL; ++i) {
        CLX_TRY(clx_envelope_tracker_add(a->tracker, &a->assembly, i));
    }
done:
    a->envelope_s += clx_clock() - begun;
    return status;
}

clast_status clx_aggregate_lay_group(clast_aggregate *a, int32_t group, const double centre[3],
                                     const double orientation[4], double scale)
{
    CLAST_ASSERT(group >= 0 && group < a->templates.n_group && scale > 0.0);
    CLAST_ASSERT(q_is_unit(orientation, 1e-9));
    clast_status status = CLAST_OK;
    const clx_template *g = &a->templates.group[group];
    const int32_t first = a->assembly.n_grain;
    for (int32_t i = 0; i < g->n_part; ++i) {
        clx_template_part placed;
        clx_template_pose(g, i, centre, orientation, scale, &placed);
        CLX_TRY(clast_assembly_add_grain(&a->assembly, a->shape_id[placed.shape], placed.position,
                                         placed.orientation, placed.scale, placed.density));
    }
    for (int32_t i = 0; i < g->n_contact; ++i) {
        double point[3];
        q_rotate(point, orientation, g->contact_point[i]);
        v3_axpy(point, centre, scale, point);
        CLX_TRY(clast_assembly_add_contact(&a->assembly, first + g->contact[i][0],
                                           first + g->contact[i][1], point));
    }
done:
    return status;
}

clast_status clx_aggregate_account_all(clast_aggregate *a, int32_t first)
{
    CLAST_ASSERT(first >= 0 && first <= a->assembly.n_grain);
    clast_status status = CLAST_OK;
    for (int32_t i = first; i < a->assembly.n_grain; ++i) {
        CLX_TRY(account(a, i));
    }
done:
    return status;
}

clast_status clx_aggregate_add_group(clast_aggregate *a, int32_t group, const double centre[3],
                                     const double orientation[4], double scale)
{
    clast_status status = CLAST_OK;
    const int32_t first = a->assembly.n_grain;
    CLX_TRY(clx_aggregate_lay_group(a, group, centre, orientation, scale));
    CLX_TRY(clx_aggregate_account_all(a, first));
    CLX_TRY(clx_aggregate_track(a, first));
done:
    return status;
}

clast_status clx_aggregate_copy_grains(clast_aggregate *a, const clast_assembly *placed)
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
