/* Property: whatever the triangles, check and repair end soon, keep their promises and do not
   depend on where the mesh lies. */
#include "mesh_maker.h"

#include "geom/intersect.h"
#include "math/rng.h"
#include <clast/mesh_repair.h>
#include <string.h>

/* Soup of n triangles over few vertices on a coarse lattice: many share corners, edges, places. */
static void make_soup(uint64_t trial, clast_mesh *mesh)
{
    clx_rng rng = clx_rng_at(4, CLX_STREAM_TEST, trial);
    const int32_t n_vert = 1 + (int32_t)clx_rng_below(&rng, trial % 2 == 0 ? 12 : 60);
    const int32_t n_tri = (int32_t)clx_rng_below(&rng, 150);
    const double lattice = trial % 3 == 0 ? 1e6 : 3.0;
    CHECK_OK(clast_mesh_alloc(n_vert, n_tri, mesh));
    for (int32_t i = 0; i < 3 * n_vert; ++i) {
        mesh->vert[i / 3][i % 3] = floor(lattice * clx_rng_uniform(&rng)) / lattice;
    }
    for (int32_t c = 0; c < 3 * n_tri; ++c) {
        mesh->tri[c / 3][c % 3] = (int32_t)clx_rng_below(&rng, n_vert);
    }
}

static void check_promises(const clast_mesh_check_result *r)
{
    int32_t n_triangle = 0;
    int32_t n_open = 0;
    for (int32_t i = 0; i < r->n_part; ++i) {
        n_triangle += r->part[i].n_triangle;
        n_open += r->part[i].n_open_edge;
    }
    assert_true(n_triangle <= r->n_triangle);
    assert_int_equal(n_open, r->n_open_edge);
    assert_int_equal(r->closed, r->n_edge > 0 && r->n_open_loop == 0);
    assert_true(r->n_fault <= CLAST_MESH_MAX_FAULT);
    for (int32_t i = 0; i < r->n_fault; ++i) {
        assert_true(strlen(r->fault[i].text) + 1 < sizeof r->fault[i].text); /* not cut short */
    }
}

static void any_soup_is_checked_and_repaired(void **state)
{
    (void)state;
    int n_closed = 0;
    for (uint64_t trial = 0; trial < 200; ++trial) {
        clast_mesh soup = {0};
        clast_mesh out = {0};
        clast_mesh_repair_report report = {0};
        clast_mesh_check_result r = {0};
        make_soup(trial, &soup);
        CHECK_OK(clast_mesh_check(&soup, &r));
        check_promises(&r);
        clast_mesh_check_free(&r);
        const clast_status status = clast_mesh_repair(&soup, NULL, &out, &report);
        if (status == CLAST_OK) {
            CHECK_OK(clast_mesh_check(&out, &r));
            check_promises(&r);
            assert_true(r.closed); /* loops of unbalanced edges always close, and all are filled */
            assert_int_equal(r.n_unused_vertex, 0);
            n_closed += r.closed;
            clast_mesh_check_free(&r);
        } else {
            assert_int_equal(status, CLAST_E_GEOMETRY);
            assert_null(out.vert);
        }
        clast_mesh_free(&out);
        clast_mesh_free(&soup);
    }
    assert_true(n_closed > 50);
}

/* Dropping random triangles from a closed body and turning others: filled, it is closed again. */
static void any_torn_ellipsoid_is_closed_again(void **state)
{
    (void)state;
    for (uint64_t trial = 0; trial < 12; ++trial) {
        clx_rng rng = clx_rng_at(5, CLX_STREAM_TEST, trial);
        clast_mesh mesh = {0};
        clast_mesh out = {0};
        clast_mesh_check_result r = {0};
        CHECK_OK(clast_mesh_ellipsoid((double[3]){3.0, 2.0, 1.0}, 3, &mesh));
        const double volume = clast_mesh_volume(&mesh);
        for (int i = 0; i < 60; ++i) {
            mesh_drop(&mesh, (int32_t)clx_rng_below(&rng, mesh.n_tri));
            mesh_flip(&mesh, (int32_t)clx_rng_below(&rng, mesh.n_tri));
        }
        CHECK_OK(clast_mesh_repair(&mesh, NULL, &out, NULL));
        CHECK_OK(clast_mesh_check(&out, &r));
        assert_true(clast_mesh_check_passed(&r));
        assert_int_equal(r.n_part, 1);
        CHECK_REL(r.volume, volume, 0.01);
        clast_mesh_check_free(&r);
        clast_mesh_free(&out);
        clast_mesh_free(&mesh);
    }
}

static void repair_of_the_repaired_changes_nothing(void **state)
{
    (void)state;
    for (uint64_t trial = 0; trial < 50; ++trial) {
        clast_mesh soup = {0};
        clast_mesh once = {0};
        clast_mesh twice = {0};
        clast_mesh_repair_report report = {0};
        clast_mesh_check_result r = {0};
        make_soup(trial, &soup);
        if (clast_mesh_repair(&soup, NULL, &once, NULL) == CLAST_OK) {
            CHECK_OK(clast_mesh_check(&once, &r));
            if (clast_mesh_check_passed(&r) && r.n_degenerate == 0) {
                CHECK_OK(clast_mesh_repair(&once, NULL, &twice, &report));
                assert_int_equal(twice.n_vert, once.n_vert);
                assert_int_equal(twice.n_tri, once.n_tri);
                assert_int_equal(report.n_turned, 0);
                assert_memory_equal(twice.tri, once.tri, (size_t)once.n_tri * sizeof *once.tri);
            }
            clast_mesh_check_free(&r);
        }
        clast_mesh_free(&twice);
        clast_mesh_free(&once);
        clast_mesh_free(&soup);
    }
}

static void make_dense_soup(int32_t n, clast_mesh *mesh)
{
    clx_rng rng = clx_rng_at(6, CLX_STREAM_TEST, 0);
    CHECK_OK(clast_mesh_alloc(3 * n, n, mesh));
    for (int32_t c = 0; c < 3 * n; ++c) {
        mesh->tri[c / 3][c % 3] = c;
        clx_rng_direction(&rng, mesh->vert[c]);
    }
}

/* A soup of large triangles, all of which overlap: the worst for pair searches and T-junctions. */
static void dense_soup_ends_in_bounded_time(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh out = {0};
    clast_mesh_check_result r = {0};
    clx_cuts cuts = {0};
    make_dense_soup(400, &mesh);
    CHECK_OK(clast_mesh_check(&mesh, &r));
    assert_int_equal(r.n_open_edge, 1200);
    CHECK_STATUS(clast_mesh_repair(&mesh, NULL, &out, NULL), CLAST_E_GEOMETRY);
    clast_mesh_check_free(&r);
    clast_mesh_free(&mesh);
    make_dense_soup(20000, &mesh);
    CHECK_OK(clx_mesh_cuts(&mesh, &cuts));
    assert_false(cuts.complete);
    clast_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_soup_is_checked_and_repaired),
        cmocka_unit_test(any_torn_ellipsoid_is_closed_again),
        cmocka_unit_test(repair_of_the_repaired_changes_nothing),
        cmocka_unit_test(dense_soup_ends_in_bounded_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
