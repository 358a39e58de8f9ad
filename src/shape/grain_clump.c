// Measures of a union of spheres: those that have a closed form. The others are missing.
#include "shape/grain.h"

#include "base/status.h"
#include "geom/smooth_hull.h"
#include "math/vec3.h"
#include "shape/shape.h"
#include "shape/whole.h"
#include <clast/grain.h>
#include <clast/shape.h>

/// Width of the union along a unit direction.
static double width_along(const clast_spheres *s, const double axis[3])
{
    double low = INFINITY;
    double high = -INFINITY;
    for (int32_t i = 0; i < s->n; ++i) {
        const double at = v3_dot(s->centre[i], axis);
        low = fmin(low, at - s->radius[i]);
        high = fmax(high, at + s->radius[i]);
    }
    return high - low;
}

/// Volume of the convex hull, NaN where its faces cannot be solved for in closed form.
static clast_status hull_volume(const clast_spheres *s, double *volume)
{
    static const double bound = 1e-3; // of the polytope that finds the faces; the sum is exact
    clast_status status = CLAST_OK;
    clx_smooth_hull hull = {0};
    clx_hull_volume found = {0};
    for (int32_t i = 0; i < s->n; ++i) {
        clx_body ball;
        clx_body_sphere(&ball, s->centre[i], s->radius[i]);
        CLX_TRY(clx_smooth_hull_add_body(&hull, &ball));
    }
    CLX_TRY(clx_smooth_hull_refine(&hull, bound));
    CLX_TRY(clx_smooth_hull_exact(&hull, &found));
    *volume = found.is_exact ? found.value : (double)NAN;
done:
    clx_smooth_hull_free(&hull);
    return status;
}

/// No closed form is known here for what calipers and shadows of the hull say.
static void leave_out(clast_grain *grain)
{
    static const clast_axes_kind unknown[] = {CLAST_AXES_BOX, CLAST_AXES_FITTED, CLAST_AXES_FERET};
    for (int k = 0; k < 3; ++k) {
        clast_axes *axes = &grain->axes[unknown[k]];
        for (int i = 0; i < 3; ++i) {
            axes->lis[i] = NAN;
            v3_set(axes->direction[i], (double)NAN, (double)NAN, (double)NAN);
        }
    }
    grain->axes[CLAST_AXES_FITTED].lis[0] = grain->longest;
    grain->axes[CLAST_AXES_FERET].lis[0] = grain->longest;
    grain->pore_volume = NAN; // a union may enclose some, and its area then has their walls
    grain->pore_area = NAN;
    grain->shortest = NAN;
    grain->hull_area = NAN;
    grain->projected_mean = NAN;
    grain->projected_least = NAN;
    grain->projected_greatest = NAN;
    grain->roundness = NAN;
    grain->roundness_deviation = NAN;
    grain->normal_roundness = NAN;
    grain->angularity = NAN;
}

clast_status clast_grain_measure_clump(const clast_spheres *spheres, clast_grain *grain)
{
    CLX_ARGUMENTS(spheres, grain);
    CLX_WHOLE(spheres, spheres);
    clast_status status = CLAST_OK;
    clast_grain made = {0};
    clast_mass mass = {0};
    const double(*frame)[3] = (const double(*)[3])made.axes[CLAST_AXES_ELLIPSOID].direction;
    clast_axes *principal = &made.axes[CLAST_AXES_PRINCIPAL];
    CLX_TRY(clx_spheres_union_measure(spheres, &mass, &made.area));
    made.volume = mass.volume;
    v3_copy(made.centroid, mass.centroid);
    for (int k = 0; k < 3; ++k) {
        v3_copy(made.inertia[k], mass.inertia[k]);
    }
    CLX_TRY(clx_grain_inertia(&made));
    for (int k = 0; k < 3; ++k) {
        v3_copy(principal->direction[k], frame[k]);
        principal->lis[k] = width_along(spheres, frame[k]);
    }
    v3_sort_axes(principal->lis, principal->direction);
    CLX_TRY(hull_volume(spheres, &made.hull_volume));
    made.longest = clx_spheres_length(spheres);
    leave_out(&made);
    clx_grain_ratios(&made);
    *grain = made;
done:
    return status;
}
