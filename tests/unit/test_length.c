/* Unit: the greatest vertex distance, against closed forms and every pair. */
#include "support.h"

#include "math/rng.h"
#include "math/vec3.h"

static double brute_length(const clast_mesh *mesh)
{
    double best2 = 0.0;
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        for (int32_t j = 0; j < i; ++j) {
            best2 = fmax(best2, v3_distance2(mesh->vert[i], mesh->vert[j]));
        }
    }
    return sqrt(best2);
}

static void box_has_its_diagonal(void **state)
{
    (void)state;
    clast_mesh box = {0};
    double length = 0.0;
    CHECK_OK(clast_mesh_box(2.0, 3.0, 6.0, &box));
    CHECK_OK(clast_mesh_length(&box, &length));
    CHECK_REL(length, 7.0, 1e-15);
    clast_mesh_free(&box);
}

static void length_equals_every_pair_bit_for_bit(void **state)
{
    (void)state;
    for (uint64_t trial = 0; trial < 60; ++trial) {
        clx_rng rng = clx_rng_at(2, CLX_STREAM_TEST, trial);
        clast_mesh mesh = {0};
        double length = 0.0;
        CHECK_OK(clast_mesh_alloc(1 + (int32_t)clx_rng_below(&rng, 600), 0, &mesh));
        for (int32_t i = 0; i < mesh.n_vert; ++i) {
            clx_rng_direction(&rng, mesh.vert[i]); /* on a sphere: the worst kind */
            if (trial % 3 == 1) {                  /* many equal coordinates */
                for (int k = 0; k < 3; ++k) {
                    mesh.vert[i][k] = floor(3.0 * mesh.vert[i][k]);
                }
            }
            if (trial % 3 == 2) { /* flat */
                mesh.vert[i][2] = 5.0;
            }
        }
        CHECK_OK(clast_mesh_length(&mesh, &length));
        assert_true(length == brute_length(&mesh));
        clast_mesh_free(&mesh);
    }
}

static void length_of_nothing_is_refused(void **state)
{
    (void)state;
    const clast_mesh empty = {0};
    double vert[2][3] = {{0, 0, 0}, {INFINITY, 0, 0}};
    const clast_mesh infinite = {.n_vert = 2, .vert = vert};
    double length = -1.0;
    CHECK_STATUS(clast_mesh_length(&empty, &length), CLAST_E_GEOMETRY);
    CHECK_STATUS(clast_mesh_length(&infinite, &length), CLAST_E_GEOMETRY);
    assert_true(length == -1.0);
}

static clast_status measure(void *context)
{
    double length = 0.0;
    return clast_mesh_length(context, &length);
}

static void length_survives_refused_memory(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    CHECK_OK(clast_mesh_ellipsoid((double[3]){3.0, 2.0, 1.0}, 2, &mesh));
    support_refuse_each_allocation(measure, &mesh);
    clast_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(box_has_its_diagonal),
        cmocka_unit_test(length_equals_every_pair_bit_for_bit),
        cmocka_unit_test(length_of_nothing_is_refused),
        cmocka_unit_test(length_survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
