#include "brute_caliper.h"

#include "math/vec3.h"

static double width(const clast_mesh *hull, const double n[3])
{
    double low = INFINITY;
    double high = -INFINITY;
    for (int32_t v = 0; v < hull->n_vert; ++v) {
        const double r = v3_dot(hull->vert[v], n);
        low = fmin(low, r);
        high = fmax(high, r);
    }
    return high - low;
}

static void edge_of(const clast_mesh *hull, int32_t half, double edge[3])
{
    const int32_t *tri = hull->tri[half / 3];
    v3_sub(edge, hull->vert[tri[(half + 1) % 3]], hull->vert[tri[half % 3]]);
}

void brute_caliper(const clast_mesh *hull, double *longest, double *shortest)
{
    *longest = 0.0;
    *shortest = INFINITY;
    for (int32_t i = 0; i < hull->n_vert; ++i) {
        for (int32_t j = 0; j < i; ++j) {
            *longest = fmax(*longest, v3_distance(hull->vert[i], hull->vert[j]));
        }
    }
    for (int32_t i = 0; i < 3 * hull->n_tri; ++i) { /* two edges of a face give its normal */
        for (int32_t j = 0; j < i; ++j) {
            double p[3];
            double q[3];
            double n[3];
            edge_of(hull, i, p);
            edge_of(hull, j, q);
            v3_cross(n, p, q);
            if (v3_norm(n) > 1e-9 * v3_norm(p) * v3_norm(q) && v3_unit(n, n)) {
                *shortest = fmin(*shortest, width(hull, n));
            }
        }
    }
}
