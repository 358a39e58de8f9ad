// Smallest sphere about all grains: the exact sphere about a growing set of touch points.
//
// Each round finds, over all grains, the surface point farthest from the present centre and adds it
// to the set; the sphere about the set grows until nothing is outside. For polyhedra the points are
// vertices and the end is exact; for spheres and ellipsoids the rounds close in quadratically once
// the touched grains are known.
#include <clast/assembly.h>

#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/status.h"
#include "geom/miniball.h"
#include "math/vec3.h"
#include <clast/shape.h>

enum { MAX_ROUNDS = 300 };
static const double close_enough = 1e-13;

typedef struct far_point {
    double distance;
    double x[3];
} far_point;

static void keep_farther(far_point *far, const double centre[3], const double x[3])
{
    const double d = v3_distance(x, centre);
    if (d > far->distance) {
        far->distance = d;
        v3_copy(far->x, x);
    }
}

/// Root t in [|w_0|, |w|] of sum (w_i / (t + a_0^2 - a_i^2))^2 = 1, w_i = a_i c_i: the multiplier,
/// less a_0^2, of the farthest point of an ellipsoid. Halving, since Newton's pace is not needed.
static double multiplier(const double w[3], const double gap[3])
{
    double low = fabs(w[0]);
    double high = v3_norm(w);
    for (int pass = 0; pass < 200 && high - low > 1e-16 * high; ++pass) {
        const double t = 0.5 * (low + high);
        double sum = 0.0;
        for (int i = 0; i < 3; ++i) {
            const double y = w[i] / (t + gap[i]);
            sum += y * y;
        }
        if (t <= low || t >= high) {
            break;
        }
        *(sum > 1.0 ? &low : &high) = t;
    }
    return 0.5 * (low + high);
}

/// Farthest point from c (in the ellipsoid's frame) of the ellipsoid a_0 >= a_1 >= a_2.
static void ellipsoid_farthest(const double a[3], const double c[3], double x[3])
{
    double w[3];
    double gap[3];
    double rest = 1.0;
    for (int i = 0; i < 3; ++i) {
        w[i] = a[i] * c[i];
        gap[i] = a[0] * a[0] - a[i] * a[i];
    }
    const double t = multiplier(w, gap);
    for (int i = 2; i >= 0; --i) {
        const double bottom = t + gap[i];
        double y = bottom > 0.0 ? -w[i] / bottom : 0.0;
        if (i == 0) { // what the others leave: also right when w_0 = 0
            y = (w[0] > 0.0 ? -1.0 : 1.0) * sqrt(fmax(rest, 0.0));
        }
        rest -= y * y;
        x[i] = a[i] * y;
    }
}

static void sphere_farthest(far_point *far, const double centre[3], const double at[3], double r)
{
    CLAST_ASSERT(r >= 0.0);
    double u[3];
    double x[3];
    v3_sub(u, at, centre);
    if (!v3_unit(u, u)) {
        v3_set(u, 1.0, 0.0, 0.0);
    }
    v3_axpy(x, at, r, u);
    keep_farther(far, centre, x);
}

static void grain_farthest(const clast_assembly *assembly, int32_t i, const double centre[3],
                           far_point *far)
{
    CLAST_ASSERT(i >= 0 && i < assembly->n_grain);
    const clast_shape *shape = &assembly->shape[assembly->shape_id[i]];
    const double scale = assembly->scale[i];
    const double *position = assembly->position[i];
    double rotation[3][3];
    double c[3];
    double x[3];
    if (v3_distance(centre, position) + scale * shape->bounding_radius * (1.0 + 1e-12) <
        far->distance) {
        return;
    }
    q_matrix(rotation, assembly->orientation[i]);
    if (shape->kind == CLAST_SHAPE_SPHERE) {
        sphere_farthest(far, centre, position, scale * shape->semi_axes[0]);
    } else if (shape->kind == CLAST_SHAPE_ELLIPSOID) {
        v3_sub(c, centre, position);
        m3_to_local(c, rotation, c);
        v3_scale(c, 1.0 / scale, c);
        ellipsoid_farthest(shape->semi_axes, c, x);
        m3_to_world(x, rotation, x);
        v3_axpy(x, position, scale, x);
        keep_farther(far, centre, x);
    }
    for (int32_t k = 0; k < shape->spheres.n && shape->kind == CLAST_SHAPE_CLUMP; ++k) {
        m3_to_world(x, rotation, shape->spheres.centre[k]);
        v3_axpy(x, position, scale, x);
        sphere_farthest(far, centre, x, scale * shape->spheres.radius[k]);
    }
    for (int32_t v = 0; v < shape->mesh.n_vert && shape->kind == CLAST_SHAPE_MESH; ++v) {
        m3_to_world(x, rotation, shape->mesh.vert[v]);
        v3_axpy(x, position, scale, x);
        keep_farther(far, centre, x);
    }
}

clast_status clast_assembly_enclosing_sphere(const clast_assembly *assembly, double centre[3],
                                             double *radius)
{
    CLX_ARGUMENTS(assembly, centre, radius);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    double(*point)[3] = NULL;
    int32_t *order = NULL;
    int32_t n = 0;
    double c[3];
    double r = 0.0;
    far_point far = {.distance = INFINITY};
    CLX_CHECK(assembly->n_grain > 0, CLAST_E_USAGE, "no grain to enclose");
    CLX_TRY(clx_alloc(&point, MAX_ROUNDS, sizeof *point));
    CLX_TRY(clx_alloc(&order, MAX_ROUNDS, sizeof *order));
    v3_copy(c, assembly->position[0]);
    while (n < MAX_ROUNDS) {
        far = (far_point){.distance = -1.0};
        for (int32_t i = 0; i < assembly->n_grain; ++i) {
            grain_farthest(assembly, i, c, &far);
        }
        if (n > 0 && far.distance <= r * (1.0 + close_enough)) {
            break;
        }
        v3_copy(point[n++], far.x);
        clx_miniball(n, (const double(*)[3])point, order, c, &r);
    }
    CLX_CHECK(far.distance <= r * (1.0 + 1e-9), CLAST_E_CONVERGE,
              "enclosing sphere: a point %.3g of the radius outside after %d rounds",
              far.distance / r - 1.0, n);
    v3_copy(centre, c);
    *radius = fmax(far.distance, r); // all grains are inside, whatever the last round left
done:
    CLX_FREE(point, order);
    return status;
}
