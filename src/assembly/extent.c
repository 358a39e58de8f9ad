// How far an assembly reaches: greatest length and widths across the principal axes of its mass.
#include <clast/assembly.h>

#include "assembly/hull_part.h"
#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/status.h"
#include "math/sym3.h"

enum { MAX_STEPS = 200, N_START = 16 };

/// Farthest point of the hull along u, and its support.
static double farthest_along(clx_smooth_hull *hull, const double u[3], double x[3])
{
    const clx_hull_inc *inner = &hull->inner;
    int32_t body = -1;
    double best = clx_smooth_hull_support(hull, u, &body);
    if (body >= 0) {
        double y[3];
        clx_body_touch(&hull->body[body], u, x, y);
    }
    for (int32_t v = 0; v < inner->vert_end; ++v) {
        if (inner->vert[v].degree > 0 && v3_dot(u, inner->vert[v].point) > best) {
            best = v3_dot(u, inner->vert[v].point);
            v3_copy(x, inner->vert[v].point);
        }
    }
    return best;
}

/// Climbs from a pair of points to the locally longest chord: its ends touch the planes across it.
static double climb(clx_smooth_hull *hull, const double p[3], const double q[3])
{
    double x[3];
    double y[3];
    double length = v3_distance(p, q);
    v3_copy(x, p);
    v3_copy(y, q);
    for (int i = 0; i < MAX_STEPS; ++i) {
        double u[3];
        v3_sub(u, x, y);
        if (!v3_unit(u, u)) {
            break;
        }
        (void)farthest_along(hull, u, x);
        v3_scale(u, -1.0, u);
        (void)farthest_along(hull, u, y);
        const double longer = v3_distance(x, y);
        if (!(longer > length * (1.0 + 1e-14))) {
            return fmax(longer, length);
        }
        length = longer;
    }
    return length;
}

typedef struct chord {
    double d2;
    int32_t v, w;
} chord;

/// Keeps the N_START longest chords, longest first.
static void keep_chord(chord *best, double d2, int32_t v, int32_t w)
{
    int k = N_START - 1;
    if (d2 <= best[k].d2) {
        return;
    }
    for (; k > 0 && best[k - 1].d2 < d2; --k) {
        best[k] = best[k - 1];
    }
    best[k] = (chord){d2, v, w};
}

/// Longest chord between vertices, then climbed on the smooth bodies.
static double longest(clx_smooth_hull *hull)
{
    const clx_hull_inc *inner = &hull->inner;
    chord best[N_START] = {{0}};
    double length = 0.0;
    for (int32_t v = 0; v < inner->vert_end; ++v) {
        for (int32_t w = 0; w < v && inner->vert[v].degree > 0; ++w) {
            if (inner->vert[w].degree > 0) {
                keep_chord(best, v3_distance2(inner->vert[v].point, inner->vert[w].point), v, w);
            }
        }
    }
    for (int k = 0; k < N_START && best[k].d2 > 0.0; ++k) {
        length =
            fmax(length, climb(hull, inner->vert[best[k].v].point, inner->vert[best[k].w].point));
    }
    return length;
}

/// Second moments of the mass about its centre: sum m d d^T + R (trace/2 - I) R^T.
static void second_moments(const clast_assembly *a, double c[3][3])
{
    double centre[3];
    clast_assembly_centre(a, centre);
    for (int r = 0; r < 3; ++r) {
        v3_set(c[r], 0.0, 0.0, 0.0);
    }
    for (int32_t i = 0; i < a->n_grain; ++i) {
        const clast_shape *shape = &a->shape[a->shape_id[i]];
        const double s = a->scale[i];
        const double m = a->density[i] * s * s * s * shape->volume;
        const double own = a->density[i] * s * s * s * s * s;
        const double half =
            0.5 * (shape->inertia[0][0] + shape->inertia[1][1] + shape->inertia[2][2]);
        double rotation[3][3];
        double d[3];
        q_matrix(rotation, a->orientation[i]);
        v3_sub(d, a->position[i], centre);
        for (int r = 0; r < 3; ++r) {
            for (int k = 0; k < 3; ++k) {
                c[r][k] += m * d[r] * d[k];
                for (int p = 0; p < 3; ++p) {
                    for (int q = 0; q < 3; ++q) {
                        c[r][k] += own * rotation[r][p] * rotation[k][q] *
                                   ((p == q ? half : 0.0) - shape->inertia[p][q]);
                    }
                }
            }
        }
    }
}

clast_status clast_assembly_extent(const clast_assembly *assembly, clast_extent *extent)
{
    CLX_ARGUMENTS(assembly, extent);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    clx_hull_parts parts = {0};
    clx_smooth_hull hull = {0};
    double c[3][3];
    double value[3];
    clast_extent made;
    CLX_CHECK(assembly->n_grain > 0, CLAST_E_USAGE, "no grain to measure");
    CLX_TRY(clx_hull_parts_add_all(&parts, assembly, &hull));
    CLX_TRY(clx_smooth_hull_refine(&hull, 5e-3));
    made.length = longest(&hull);
    second_moments(assembly, c);
    clx_sym3_eigen(c, value, made.axis);
    for (int k = 0; k < 3; ++k) {
        double x[3];
        double back[3];
        v3_scale(back, -1.0, made.axis[k]);
        made.width[k] = farthest_along(&hull, made.axis[k], x) + farthest_along(&hull, back, x);
    }
    v3_sort_axes(made.width, made.axis);
    *extent = made;
done:
    clx_hull_parts_free(&parts);
    clx_smooth_hull_free(&hull);
    return status;
}
