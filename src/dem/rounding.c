// Hulls with rounded edges: a smaller hull grown on all sides, of the same volume.
//
// Steiner's formula for the convex body K grown by m:
//   V(K + mB) = V + A m + H m^2 + 4/3 pi m^3,  H = 1/2 sum over edges of length times outer angle.
//                                                    [docs/theory/dem.md "Rounded edges"]
#include "dem/dem.h"

void clx_rounding_prepare(clx_dem_body *body)
{
    const clx_hull_core *core = body->core;
    body->steiner[0] = body->steiner[1] = 0.0;
    for (int32_t i = 0; i < core->n_edge; ++i) {
        const clx_core_edge *e = &core->edge[i];
        const double *n0 = core->face[e->face[0]].normal;
        const double *n1 = core->face[e->face[1]].normal;
        double cross[3];
        v3_cross(cross, n0, n1);
        const double angle = atan2(sqrt(v3_norm2(cross)), v3_dot(n0, n1));
        const double length = sqrt(v3_norm2(e->along));
        for (int k = 0; k < 2; ++k) { // a face is its sides' triangles about a point of its plane
            body->steiner[0] += 0.5 * length * v3_dot(e->out[k], e->from);
        }
        body->steiner[1] += 0.5 * length * angle;
    }
}

double clx_rounding_factor(const clx_dem_body *body, double margin)
{
    const double v = body->shape.volume;
    const double a = body->steiner[0] * margin;
    const double h = body->steiner[1] * margin * margin;
    const double rest = 4.0 / 3.0 * CLAST_PI * margin * margin * margin - v;
    double f = 1.0;
    for (int i = 0; i < 60; ++i) { // convex and rising: Newton's steps come down to the root
        const double step = (((v * f + a) * f + h) * f + rest) / ((3.0 * v * f + 2.0 * a) * f + h);
        f -= step;
        if (!(step > 1e-16)) {
            break;
        }
    }
    return f;
}
