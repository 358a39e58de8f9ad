/* Paper [Rettinger2022 table 2, section 2.3]: the stand-in has the published statistics of form.
   It is made to have them; what is tested is that the shipped files do, as measured here. */
#include "support.h"

#include <clast/form.h>
#include <clast/mesh.h>
#include <stdio.h>

enum { N = 63 };

typedef struct {
    double flatness[N], elongation[N];
} forms;

static void read_grain(int i, clast_mesh *mesh)
{
    char name[64];
    (void)snprintf(name, sizeof name, "standin63/grain%02d.ply", i);
    CHECK_OK(clast_mesh_read(support_data(name), mesh, NULL));
}

static void read_forms(forms *f)
{
    for (int i = 0; i < N; ++i) {
        clast_mesh mesh = {0};
        clast_mesh turned = {0};
        double lis[3];
        read_grain(i, &mesh);
        CHECK_OK(clast_reform_principal(&mesh, &turned, lis));
        f->flatness[i] = lis[2] / lis[1];
        f->elongation[i] = lis[1] / lis[0];
        CHECK_REL(clast_form_sieve_size(lis[1], lis[2]), 1.0, 1e-12);
        clast_mesh_free(&turned);
        clast_mesh_free(&mesh);
    }
}

static double mean_of(const double *x)
{
    double sum = 0.0;
    for (int i = 0; i < N; ++i) {
        sum += x[i];
    }
    return sum / N;
}

/// Sum of products of deviations by n - 1.
static double covariance(const double *x, const double *y)
{
    const double mx = mean_of(x);
    const double my = mean_of(y);
    double sum = 0.0;
    for (int i = 0; i < N; ++i) {
        sum += (x[i] - mx) * (y[i] - my);
    }
    return sum / (N - 1);
}

static void form_has_the_published_statistics(void **state)
{
    (void)state;
    forms f;
    read_forms(&f);
    const double deviation_f = sqrt(covariance(f.flatness, f.flatness));
    const double deviation_e = sqrt(covariance(f.elongation, f.elongation));
    CHECK_ABS(mean_of(f.flatness), 0.647, 1e-3);
    CHECK_ABS(deviation_f, 0.175, 1e-3);
    CHECK_ABS(mean_of(f.elongation), 0.682, 1e-3);
    CHECK_ABS(deviation_e, 0.139, 1e-3);
    CHECK_ABS(covariance(f.flatness, f.elongation) / (deviation_f * deviation_e), -0.089, 1e-3);
}

static void grains_are_convex_in_their_frame(void **state)
{
    (void)state;
    double volume = 0.0;
    for (int i = 0; i < N; ++i) {
        clast_mesh mesh = {0};
        clast_mesh hull = {0};
        clast_mass mass;
        read_grain(i, &mesh);
        assert_true(mesh.n_tri <= 300 && mesh.n_tri >= 290);
        CHECK_OK(clast_mesh_hull(&mesh, &hull));
        CHECK_OK(clast_mesh_mass(&mesh, &mass));
        CHECK_REL(mass.volume, clast_mesh_volume(&hull), 1e-12);
        for (int k = 0; k < 3; ++k) {
            CHECK_ABS(mass.centroid[k], 0.0, 1e-14);
            CHECK_ABS(mass.inertia[k][(k + 1) % 3], 0.0, 1e-14);
        }
        assert_true(mass.inertia[0][0] <= mass.inertia[1][1] &&
                    mass.inertia[1][1] <= mass.inertia[2][2]);
        volume += mass.volume / N;
        clast_mesh_free(&hull);
        clast_mesh_free(&mesh);
    }
    CHECK_ABS(volume, 0.784, 5e-4); // what data/standin63/README.md says
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(form_has_the_published_statistics),
        cmocka_unit_test(grains_are_convex_in_their_frame),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
