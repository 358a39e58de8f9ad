// An aggregate as one rigid grain: its spheres as a clump, or its parts.
#include "io/rigid_grain.h"

#include "base/status.h"
#include "math/vec3.h"
#include <clast/shape.h>
#include <math.h>

/// Whether an aggregate is made of spheres alone; how many.
static bool is_of_spheres(const clast_assembly *a, int64_t *n)
{
    *n = 0;
    for (int32_t i = 0; i < a->n_grain; ++i) {
        const clast_shape *shape = &a->shape[a->shape_id[i]];
        if (shape->kind != CLAST_SHAPE_SPHERE && shape->kind != CLAST_SHAPE_CLUMP) {
            return false;
        }
        *n += shape->kind == CLAST_SHAPE_SPHERE ? 1 : shape->spheres.n;
    }
    return true;
}

/// The spheres of an aggregate's state.
static clast_status spheres_of(const clast_assembly *a, int64_t n, clast_spheres *out)
{
    clast_status status = CLAST_OK;
    clast_spheres made = {0};
    CLX_CHECK(n > 0 && n <= INT32_MAX, CLAST_E_GEOMETRY, "the aggregate holds %lld spheres",
              (long long)n);
    CLX_TRY(clast_spheres_alloc((int32_t)n, &made));
    n = 0;
    for (int32_t i = 0; i < a->n_grain; ++i) {
        const clast_shape *shape = &a->shape[a->shape_id[i]];
        const bool is_ball = shape->kind == CLAST_SHAPE_SPHERE;
        for (int32_t k = 0; k < (is_ball ? 1 : shape->spheres.n); ++k) {
            double x[3] = {0.0, 0.0, 0.0};
            if (!is_ball) {
                q_rotate(x, a->orientation[i], shape->spheres.centre[k]);
            }
            v3_axpy(made.centre[n], a->position[i], a->scale[i], x);
            made.radius[n++] =
                a->scale[i] * (is_ball ? shape->semi_axes[0] : shape->spheres.radius[k]);
        }
    }
    *out = made;
    made = (clast_spheres){0};
done:
    clast_spheres_free(&made);
    return status;
}

static bool is_of_one_density(const clast_assembly *a)
{
    for (int32_t i = 1; i < a->n_grain; ++i) {
        if (!(fabs(a->density[i] - a->density[0]) <= 1e-9 * a->density[0])) {
            return false;
        }
    }
    return true;
}

clast_status clx_rigid_grain(const clast_assembly *a, const char *name,
                             const clast_rigid_options *options, clast_shape *shape, double *added)
{
    clast_status status = CLAST_OK;
    clast_spheres spheres = {0};
    int64_t n = 0;
    if (is_of_spheres(a, &n) && is_of_one_density(a)) {
        CLX_TRY(spheres_of(a, n, &spheres));
        CLX_TRY(clast_shape_clump(name, &spheres, shape));
        shape->own.density = a->density[0];
        *added = (double)NAN;
    } else {
        CLX_TRY(clast_assembly_rigid(a, name, options, shape, added));
    }
done:
    clast_spheres_free(&spheres);
    return status;
}
