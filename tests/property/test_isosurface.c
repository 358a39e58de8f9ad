/* Property: the level surface of any field is closed, oriented and where the field says. */
#include "support.h"

#include "geom/isosurface.h"
#include "math/rng.h"
#include <stdlib.h>
#include <string.h>

static void fill_sphere(clx_grid *g, double radius)
{
    for (int64_t node = 0; node < (int64_t)g->n[0] * g->n[1] * g->n[2]; ++node) {
        const double x = g->low[0] + g->h * (double)(node % g->n[0]);
        const double y = g->low[1] + g->h * (double)(node / g->n[0] % g->n[1]);
        const double z = g->low[2] + g->h * (double)(node / ((int64_t)g->n[0] * g->n[1]));
        g->value[node] = (float)(sqrt(x * x + y * y + z * z) - radius);
    }
}

/* A dull twin of the closedness test: each directed edge has its reverse, once. */
static int compare_edges(const void *a, const void *b)
{
    return memcmp(a, b, 2 * sizeof(int32_t));
}

static void check_closed(const clast_mesh *mesh)
{
    const size_t n = 3 * (size_t)mesh->n_tri;
    int32_t(*edge)[2] = malloc(n * sizeof *edge);
    int32_t(*back)[2] = malloc(n * sizeof *back);
    for (size_t e = 0; e < n; ++e) {
        const int32_t *t = mesh->tri[e / 3];
        edge[e][0] = back[e][1] = t[e % 3];
        edge[e][1] = back[e][0] = t[(e + 1) % 3];
    }
    qsort(edge, n, sizeof *edge, compare_edges);
    qsort(back, n, sizeof *back, compare_edges);
    assert_memory_equal(edge, back, n * sizeof *edge);
    for (size_t e = 1; e < n; ++e) {
        assert_true(compare_edges(edge[e - 1], edge[e]) != 0);
    }
    free(edge);
    free(back);
}

static void sphere_volume_converges_with_the_square_of_the_spacing(void **state)
{
    (void)state;
    const double low[3] = {-1.4, -1.4, -1.4}, high[3] = {1.4, 1.4, 1.4};
    double error[2];
    for (int i = 0; i < 2; ++i) {
        clx_grid g = {0};
        clast_mesh mesh = {0};
        CHECK_OK(clx_grid_alloc(low, high, i == 0 ? 0.1 : 0.05, 1.0f, &g));
        fill_sphere(&g, 1.0);
        CHECK_OK(clx_isosurface(&g, 0.0, 1e-3, &mesh));
        check_closed(&mesh);
        assert_int_equal(mesh.n_vert - mesh.n_tri / 2, 2); /* Euler number of a sphere */
        error[i] = 1.0 - clast_mesh_volume(&mesh) / (4.0 * CLAST_PI / 3.0);
        clast_mesh_free(&mesh);
        clx_grid_free(&g);
    }
    assert_true(error[0] > 0.0 && error[0] < 0.01);
    CHECK_REL(error[0] / error[1], 4.0, 0.1);
}

static void noise_gives_a_closed_surface(void **state)
{
    (void)state;
    const double low[3] = {0, 0, 0}, high[3] = {12, 13, 14};
    for (uint64_t seed = 0; seed < 5; ++seed) {
        clx_grid g = {0};
        clast_mesh mesh = {0};
        clx_rng rng = clx_rng_at(seed, CLX_STREAM_TEST, 0);
        CHECK_OK(clx_grid_alloc(low, high, 1.0, 1.0f, &g));
        for (int k = 1; k < 14; ++k) {
            for (int j = 1; j < 13; ++j) {
                for (int i = 1; i < 12; ++i) {
                    g.value[(k * 14 + j) * 13 + i] = (float)clx_rng_uniform(&rng) - 0.5f;
                }
            }
        }
        CHECK_OK(clx_isosurface(&g, 0.0, 1e-3, &mesh));
        check_closed(&mesh);
        assert_true(clast_mesh_volume(&mesh) > 0.0);
        clast_mesh_free(&mesh);
        clx_grid_free(&g);
    }
}

static void empty_and_overfull_grids_are_refused(void **state)
{
    (void)state;
    const double low[3] = {0, 0, 0}, high[3] = {3, 3, 3};
    clx_grid g = {0};
    clast_mesh mesh = {0};
    CHECK_OK(clx_grid_alloc(low, high, 1.0, 1.0f, &g));
    CHECK_STATUS(clx_isosurface(&g, 0.0, 1e-3, &mesh), CLAST_E_GEOMETRY);
    g.value[0] = -1.0f;
    CHECK_STATUS(clx_isosurface(&g, 0.0, 1e-3, &mesh), CLAST_E_GEOMETRY);
    clx_grid_free(&g);
    CHECK_STATUS(clx_grid_alloc(low, high, 1e-4, 1.0f, &g), CLAST_E_LIMIT);
}

static clast_status make(void *context)
{
    clast_mesh mesh = {0};
    const clast_status status = clx_isosurface(context, 0.0, 1e-3, &mesh);
    clast_mesh_free(&mesh);
    return status;
}

static void survives_refused_memory(void **state)
{
    (void)state;
    const double low[3] = {-1.4, -1.4, -1.4}, high[3] = {1.4, 1.4, 1.4};
    clx_grid g = {0};
    CHECK_OK(clx_grid_alloc(low, high, 0.4, 1.0f, &g));
    fill_sphere(&g, 1.0);
    support_refuse_each_allocation(make, &g);
    clx_grid_free(&g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sphere_volume_converges_with_the_square_of_the_spacing),
        cmocka_unit_test(noise_gives_a_closed_surface),
        cmocka_unit_test(empty_and_overfull_grids_are_refused),
        cmocka_unit_test(survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
