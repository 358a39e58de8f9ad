// Plain twin of the largest-first search.
#include "ref_fill.h"

#include "brute_mesh.h"
#include <math.h>

double ref_fill_room(const clast_mesh *mesh, const clast_spheres *spheres, int32_t n,
                     const double point[3])
{
    double room = brute_closest(mesh, point);
    if (fabs(brute_winding(mesh, point)) < 0.5) {
        return -room;
    }
    for (int32_t i = 0; i < n; ++i) {
        double d2 = 0.0;
        for (int k = 0; k < 3; ++k) {
            const double d = point[k] - spheres->centre[i][k];
            d2 += d * d;
        }
        room = fmin(room, sqrt(d2) - spheres->radius[i]);
    }
    return room;
}

double ref_fill_largest(const clast_mesh *mesh, const clast_spheres *spheres, int32_t n, int n_grid,
                        double *spacing)
{
    double low[3];
    double high[3];
    double longest = 0.0;
    double best = -INFINITY;
    int count[3];
    clast_mesh_bounds(mesh, low, high);
    for (int k = 0; k < 3; ++k) {
        longest = fmax(longest, high[k] - low[k]);
    }
    *spacing = longest / n_grid;
    for (int k = 0; k < 3; ++k) {
        count[k] = (int)ceil((high[k] - low[k]) / *spacing);
    }
    for (int i = 0; i < count[0]; ++i) {
        for (int j = 0; j < count[1]; ++j) {
            for (int k = 0; k < count[2]; ++k) {
                const double point[3] = {low[0] + (i + 0.5) * *spacing,
                                         low[1] + (j + 0.5) * *spacing,
                                         low[2] + (k + 0.5) * *spacing};
                best = fmax(best, ref_fill_room(mesh, spheres, n, point));
            }
        }
    }
    return best;
}
