// How fast the aggregate settles, solid and permeable.
//
// Permeable: air flows through the coat, a shell of even porosity about the core (of everything
// where there is none: clusters). Its grain size is Sauter's mean of the placed grains.
#include "aggregate/state.h"

#include <clast/settling.h>
#include <math.h>

enum { SURFACE_LEVEL = 4 };

/// Surface of a shape at scale 1; of a clump, whose spheres hide parts of each other, that of the
/// sphere of its volume.
static clast_status surface_of(const clast_shape *shape, double *area)
{
    clast_status status = CLAST_OK;
    clast_mesh mesh = {0};
    if (shape->kind == CLAST_SHAPE_SPHERE || shape->kind == CLAST_SHAPE_CLUMP) {
        *area = cbrt(36.0 * CLAST_PI * shape->volume * shape->volume);
        return CLAST_OK;
    }
    CLX_TRY(clast_shape_surface(shape, SURFACE_LEVEL, &mesh));
    *area = clast_mesh_area(&mesh);
done:
    clast_mesh_free(&mesh);
    return status;
}

/// Solid and surface of the grains from `first` on.
static clast_status sum_coat(const clast_assembly *grains, int32_t first, double *volume,
                             double *surface)
{
    CLAST_ASSERT(first >= 0 && first <= grains->n_grain);
    clast_status status = CLAST_OK;
    *volume = 0.0;
    *surface = 0.0;
    for (int32_t k = 0; k < grains->n_shape; ++k) {
        double area = 0.0;
        CLX_TRY(surface_of(&grains->shape[k], &area));
        for (int32_t i = first; i < grains->n_grain; ++i) {
            if (grains->shape_id[i] == k) {
                const double s = grains->scale[i];
                *volume += grains->shape[k].volume * s * s * s;
                *surface += area * s * s;
            }
        }
    }
done:
    return status;
}

const char *clast_permeable_range_text(clast_permeable_range range)
{
    switch (range) {
    case CLAST_PERMEABLE_YES:
        return "air flows through the coat";
    case CLAST_PERMEABLE_THIN:
        return "the coat is thinner than its mean grain";
    case CLAST_PERMEABLE_POROSITY:
        return "the coat's porosity is outside of the law of permeability";
    case CLAST_PERMEABLE_REYNOLDS:
        return "Re is above 1 with beta < 15, or above 120";
    default:
        return "not measured";
    }
}

/// Sets why there is no permeable velocity, as long as there is none.
static clast_status permeable(const clast_aggregate *a, const clast_assembly *grains,
                              const clast_drag *drag, const clast_fluid *air,
                              clast_aggregate_result *r)
{
    clast_status status = CLAST_OK;
    clast_settling settling;
    double volume = 0.0;
    double surface = 0.0;
    const double radius = 0.5 * r->d_agg;
    const double whole = r->envelope[0].volume;
    CLX_TRY(sum_coat(grains, a->n_core, &volume, &surface));
    const double core = cbrt(0.75 / CLAST_PI * fmax(0.0, r->solid_sum - volume));
    const double size = 6.0 * volume / surface;
    r->coat_grain = size;
    r->coat_porosity = 1.0 - volume / (whole - (r->solid_sum - volume));
    r->permeable = CLAST_PERMEABLE_THIN;
    if (!(radius - core >= size)) { // no grain, too
        return CLAST_OK;
    }
    r->permeable = CLAST_PERMEABLE_POROSITY;
    if (clast_permeability((clast_permeability_law)a->params->permeability, size, r->coat_porosity,
                           &r->permeability) != CLAST_OK) {
        return CLAST_OK;
    }
    const clast_porous porous = {.permeability = r->permeability,
                                 .core = core < 1e-6 * radius ? 0.0 : core / radius};
    r->drag_permeable = clast_drag_permeable(radius / sqrt(r->permeability), porous.core);
    r->permeable = CLAST_PERMEABLE_REYNOLDS;
    CLX_TRY(clast_terminal_velocity_permeable(r->d_agg, r->density, drag, air, &porous, &settling));
    if (settling.in_range) {
        r->permeable = CLAST_PERMEABLE_YES;
        r->settling_velocity_permeable = settling.velocity;
    }
done:
    return status;
}

clast_status clx_aggregate_fall_speed(const double width[3], double diameter, double density,
                                      clast_drag *drag, double *velocity)
{
    clast_status status = CLAST_OK;
    clast_settling settling;
    const clast_fluid air = clast_fluid_air();
    CLX_TRY(
        clast_drag_of_form(width[0], width[1], width[2], diameter, density / air.density, drag));
    CLX_TRY(clast_terminal_velocity(diameter, density, drag, &air, &settling));
    *velocity = settling.velocity;
done:
    return status;
}

clast_status clx_aggregate_measure_settling(const clast_aggregate *a, const clast_assembly *grains,
                                            const double width[3], clast_aggregate_result *r)
{
    clast_status status = CLAST_OK;
    clast_drag drag;
    const clast_fluid air = clast_fluid_air();
    r->permeability = r->drag_permeable = r->settling_velocity_permeable = (double)NAN;
    CLX_TRY(clx_aggregate_fall_speed(width, r->d_agg, r->density, &drag, &r->settling_velocity));
    CLX_TRY(permeable(a, grains, &drag, &air, r));
done:
    return status;
}
