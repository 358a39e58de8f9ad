/* Property: a grain scanned ten kilometres from the origin, or turned, is the same grain. */
#include "support.h"

#include <math.h>

enum { N_CORNER = 8 };

/// A box of 10 x 20 x 30 mm at `shift` along all axes; its own sizes after rounding in edge [3].
static void box_at(double shift, clast_mesh *box, double edge[3])
{
    CHECK_OK(clast_mesh_box(0.01, 0.02, 0.03, box));
    for (int k = 0; k < 3; ++k) {
        double low = (double)INFINITY;
        double high = -(double)INFINITY;
        assert_int_equal(box->n_vert, N_CORNER);
        for (int v = 0; v < N_CORNER; ++v) {
            box->vert[v][k] += shift;
            low = fmin(low, box->vert[v][k]);
            high = fmax(high, box->vert[v][k]);
        }
        edge[k] = high - low; /* exact: the two are near each other */
    }
}

static void mass_ignores_position(void **state)
{
    (void)state;
    for (int decade = 0; decade <= 4; ++decade) {
        clast_mesh box = {0};
        clast_mass m;
        double e[3];
        const double shift = pow(10.0, decade);
        box_at(shift, &box, e);
        CHECK_OK(clast_mesh_mass(&box, &m));
        CHECK_REL(m.volume, e[0] * e[1] * e[2], 1e-14);
        CHECK_REL(clast_mesh_volume(&box), e[0] * e[1] * e[2], 1e-14);
        CHECK_REL(m.centroid[0], shift + 0.5 * e[0], 1e-15);
        for (int k = 0; k < 3; ++k) {
            const double a = e[(k + 1) % 3];
            const double b = e[(k + 2) % 3];
            CHECK_REL(m.inertia[k][k], m.volume * (a * a + b * b) / 12.0, 1e-13);
        }
        clast_mesh_free(&box);
    }
}

/// A turn about the axis (1, 1, 1), which is no symmetry of the box.
static void turning_keeps_volume_area_and_trace(void **state)
{
    (void)state;
    const double angle[] = {0.3, 1.1, 2.9};
    for (int k = 0; k < 3; ++k) {
        clast_mesh box = {0};
        clast_mass m;
        double edge[3];
        const double c = cos(angle[k]);
        const double s = sin(angle[k]) / sqrt(3.0);
        const double t = (1.0 - c) / 3.0;
        box_at(0.0, &box, edge);
        for (int v = 0; v < N_CORNER; ++v) {
            const double x[3] = {box.vert[v][0], box.vert[v][1], box.vert[v][2]};
            for (int i = 0; i < 3; ++i) { /* Rodrigues */
                box.vert[v][i] =
                    c * x[i] + s * (x[(i + 2) % 3] - x[(i + 1) % 3]) + t * (x[0] + x[1] + x[2]);
            }
        }
        CHECK_OK(clast_mesh_mass(&box, &m));
        CHECK_REL(m.volume, 6e-6, 1e-14);
        CHECK_REL(clast_mesh_area(&box), 2.2e-3, 1e-14);
        CHECK_REL(m.inertia[0][0] + m.inertia[1][1] + m.inertia[2][2], 6e-6 * 14e-4 / 6.0, 1e-13);
        clast_mesh_free(&box);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mass_ignores_position),
        cmocka_unit_test(turning_keeps_volume_area_and_trace),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
