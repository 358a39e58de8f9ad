/* Property: whatever the points and their order, the hull is a closed convex manifold that contains
 * them all, exactly, and its running volume is its volume. */
#include "support.h"

#include "geom/hull.h"
#include "geom/hull_inc.h"
#include "math/predicates.h"
#include "math/rng.h"
#include "math/vec3.h"
#include <stdlib.h>

typedef double point3[3];

/* The hull as a closed outward mesh. */
static void hull_mesh(const clx_hull_inc *hull, clast_mesh *mesh)
{
    int32_t *number = calloc((size_t)hull->vert_end, sizeof *number);
    int32_t n_vert = 0;
    int32_t n_tri = 0;
    CHECK_OK(clast_mesh_alloc(hull->n_vert, hull->n_facet, mesh));
    for (int32_t v = 0; v < hull->vert_end; ++v) {
        if (hull->vert[v].degree > 0) {
            v3_copy(mesh->vert[n_vert], hull->vert[v].point);
            number[v] = n_vert++;
        }
    }
    for (int32_t f = 0; f < hull->facet_end; ++f) {
        if (hull->facet[f].vert[0] >= 0) {
            for (int k = 0; k < 3; ++k) {
                mesh->tri[n_tri][k] = number[hull->facet[f].vert[k]];
            }
            ++n_tri;
        }
    }
    free(number);
}

/* Every edge has its partner, no point sees a facet, F = 2 V - 4, volume and mesh agree. */
static void check_hull(const clx_hull_inc *hull, int32_t n, const point3 *all)
{
    clast_mesh mesh = {0};
    for (int32_t f = 0; f < hull->facet_end; ++f) {
        const clx_hull_facet *facet = &hull->facet[f];
        if (facet->vert[0] < 0) {
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            const clx_hull_facet *other = &hull->facet[facet->adj[k]];
            int partners = 0;
            for (int j = 0; j < 3; ++j) {
                partners += other->vert[j] == facet->vert[(k + 1) % 3] &&
                            other->vert[(j + 1) % 3] == facet->vert[k] && other->adj[j] == f;
            }
            assert_int_equal(partners, 1);
        }
        for (int32_t i = 0; i < n; ++i) {
            assert_true(clx_orient3d(hull->vert[facet->vert[0]].point,
                                     hull->vert[facet->vert[1]].point,
                                     hull->vert[facet->vert[2]].point, all[i]) >= 0.0);
        }
    }
    assert_int_equal(hull->n_facet, 2 * hull->n_vert - 4);
    hull_mesh(hull, &mesh);
    CHECK_REL(clx_hull_inc_volume(hull), clast_mesh_volume(&mesh), 1e-12);
    clast_mesh_free(&mesh);
}

static void add_in_batches(clx_hull_inc *hull, int32_t n, const point3 *p, int32_t batch)
{
    int32_t *tag = calloc((size_t)n, sizeof *tag);
    for (int32_t i = 0; i < n; i += batch) {
        CHECK_OK(clx_hull_inc_add(hull, n - i < batch ? n - i : batch, p + i, tag));
    }
    free(tag);
}

static void lattice_of_points_gives_its_box(void **state)
{
    (void)state;
    point3 p[343];
    for (int order = 0; order < 6; ++order) {
        for (int batch = 1; batch <= 343; batch *= 7) {
            clx_hull_inc hull = {0};
            for (int i = 0; i < 343; ++i) { /* odd orders walk through the lattice in jumps */
                const int m = order % 2 == 0 ? i : (i * 5 + order) % 343;
                p[i][order % 3] = 0.1 * (m % 7);
                p[i][(order + 1) % 3] = 0.1 * (m / 7 % 7);
                p[i][(order + 2) % 3] = 0.1 * (m / 49);
            }
            add_in_batches(&hull, 343, (const point3 *)p, batch);
            CHECK_REL(clx_hull_inc_volume(&hull), 0.6 * 0.6 * 0.6, 1e-14);
            check_hull(&hull, 343, (const point3 *)p);
            clx_hull_inc_free(&hull);
        }
    }
}

/* Spheres, balls, needles, nearly flat sets; with every third point a copy of another. */
static void random_points_have_a_convex_hull(void **state)
{
    (void)state;
    enum { N = 400 };
    static point3 p[N];
    for (int kind = 0; kind < 8; ++kind) {
        clx_rng rng = clx_rng_at(11, CLX_STREAM_TEST, (uint64_t)kind);
        const double stretch[3] = {1.0, kind & 1 ? 1e-6 : 1.0, kind & 2 ? 1e-12 : 0.5};
        for (int i = 0; i < N; ++i) {
            if (i % 3 == 2) {
                for (int k = 0; k < 3; ++k) {
                    p[i][k] = p[i / 2][k];
                }
                continue;
            }
            clx_rng_direction(&rng, p[i]);
            const double radius = kind & 4 ? cbrt(clx_rng_uniform(&rng)) : 1.0;
            for (int k = 0; k < 3; ++k) {
                p[i][k] = 7.0 + p[i][k] * stretch[k] * radius;
            }
        }
        double volume = 0.0;
        for (int batch = 1; batch <= N; batch *= 20) {
            clx_hull_inc hull = {0};
            add_in_batches(&hull, N, (const point3 *)p, batch);
            if (batch > 1) {
                CHECK_REL(clx_hull_inc_volume(&hull), volume, 1e-12);
            }
            volume = clx_hull_inc_volume(&hull);
            if (stretch[2] > 1e-9) { /* the mesh sum itself loses digits on a flat set */
                check_hull(&hull, N, (const point3 *)p);
            }
            clx_hull_inc_free(&hull);
        }
    }
}

/* The oracle is qhull, another program with another algorithm. */
static void random_points_agree_with_qhull(void **state)
{
    (void)state;
    enum { N = 3000 };
    static point3 p[N];
    clx_rng rng = clx_rng_at(2, CLX_STREAM_TEST, 9);
    for (int i = 0; i < N; ++i) {
        clx_rng_direction(&rng, p[i]);
        const double radius = i % 2 == 0 ? cbrt(clx_rng_uniform(&rng)) : 1.0;
        v3_scale(p[i], radius, p[i]);
    }
    clx_hull_inc hull = {0};
    clast_mesh mesh = {0};
    clast_mesh own = {0};
    add_in_batches(&hull, N, (const point3 *)p, 100);
    CHECK_OK(clx_hull_points((const point3 *)p, N, &mesh));
    CHECK_REL(clx_hull_inc_volume(&hull), clast_mesh_volume(&mesh), 1e-12);
    hull_mesh(&hull, &own);
    CHECK_REL(clast_mesh_area(&own), clast_mesh_area(&mesh), 1e-12);
    clast_mesh_free(&own);
    assert_int_equal(hull.n_vert, mesh.n_vert);
    clast_mesh_free(&mesh);
    clx_hull_inc_free(&hull);
}

static void coplanar_points_wait_for_a_solid(void **state)
{
    (void)state;
    clx_hull_inc hull = {0};
    const point3 flat[6] = {{0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.1, 0.1, 0.1},
                            {0.3, 0.3, 0.3}, {0.1, 0.2, 0.1}, {0.3, 0.5, 0.3}};
    const int32_t tag[6] = {1, 2, 3, 4, 5, 6};
    const point3 bad[2] = {{0, 0, 0}, {1, NAN, 0}};
    const point3 apex[1] = {{0.1, 0.1, 0.7}};
    CHECK_OK(clx_hull_inc_add(&hull, 6, flat, tag));
    assert_true(!hull.is_solid);
    assert_true(clx_hull_inc_volume(&hull) == 0.0);
    CHECK_STATUS(clx_hull_inc_add(&hull, 2, bad, tag), CLAST_E_GEOMETRY);
    CHECK_OK(clx_hull_inc_add(&hull, 1, apex, tag));
    assert_true(hull.is_solid);
    check_hull(&hull, 6, flat);
    clx_hull_inc_free(&hull);
}

static void buried_vertices_are_forgotten(void **state)
{
    (void)state;
    clx_hull_inc hull = {0};
    point3 p[200];
    clx_rng rng = clx_rng_at(3, CLX_STREAM_TEST, 1);
    for (int shell = 1; shell <= 50; ++shell) {
        for (int i = 0; i < 200; ++i) {
            clx_rng_direction(&rng, p[i]);
            v3_scale(p[i], shell, p[i]);
        }
        add_in_batches(&hull, 200, (const point3 *)p, 200);
    }
    assert_in_range(hull.n_vert, 200, 320); /* the last shell and a few of the one before */
    assert_true(hull.vert_end < 500);
    assert_true(hull.facet_end < 2000);
    clx_hull_inc_free(&hull);
}

/* A hull that was large in facets keeps its slots; closing the gaps changes no facet of it, then or
 * later. */
static void compacted_hull_goes_on_as_before(void **state)
{
    (void)state;
    enum { N = 600 };
    static point3 p[N];
    clx_rng rng = clx_rng_at(3, CLX_STREAM_TEST, 7);
    clx_hull_inc hull[2] = {{0}, {0}};
    for (int i = 0; i < N; ++i) {
        clx_rng_direction(&rng, p[i]);
        v3_scale(p[i], i < 400 ? 1.0 : 1.3, p[i]);
    }
    p[400][0] = p[400][1] = p[400][2] = 5.0; /* hides most of what there was */
    add_in_batches(&hull[0], 401, (const point3 *)p, 401);
    add_in_batches(&hull[1], 401, (const point3 *)p, 401);
    const int32_t before = hull[1].facet_end;
    CHECK_OK(clx_hull_inc_compact(&hull[1]));
    assert_true(hull[1].facet_end == hull[1].n_facet && hull[1].vert_end == hull[1].n_vert);
    assert_true(hull[1].facet_end < before);
    check_hull(&hull[1], 401, (const point3 *)p);
    add_in_batches(&hull[0], N - 401, (const point3 *)p + 401, 60);
    add_in_batches(&hull[1], N - 401, (const point3 *)p + 401, 60);
    check_hull(&hull[1], N, (const point3 *)p);
    assert_int_equal(hull[0].n_facet, hull[1].n_facet);
    CHECK_REL(clx_hull_inc_volume(&hull[1]), clx_hull_inc_volume(&hull[0]), 1e-13);
    clx_hull_inc_free(&hull[0]);
    clx_hull_inc_free(&hull[1]);
}

static clast_status make_hull(void *context)
{
    clast_status status = CLAST_OK;
    clx_hull_inc hull = {0};
    point3 p[60];
    int32_t tag[60] = {0};
    (void)context;
    clx_rng rng = clx_rng_at(5, CLX_STREAM_TEST, 2);
    for (int i = 0; i < 60; ++i) {
        clx_rng_direction(&rng, p[i]);
    }
    for (int i = 0; i < 60 && status == CLAST_OK; i += 20) {
        status = clx_hull_inc_add(&hull, 20, (const point3 *)p + i, tag);
    }
    if (status == CLAST_OK) {
        status = clx_hull_inc_compact(&hull);
    }
    clx_hull_inc_free(&hull);
    return status;
}

static void hull_survives_refused_memory(void **state)
{
    (void)state;
    support_refuse_each_allocation(make_hull, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lattice_of_points_gives_its_box),
        cmocka_unit_test(random_points_have_a_convex_hull),
        cmocka_unit_test(random_points_agree_with_qhull),
        cmocka_unit_test(coplanar_points_wait_for_a_solid),
        cmocka_unit_test(buried_vertices_are_forgotten),
        cmocka_unit_test(compacted_hull_goes_on_as_before),
        cmocka_unit_test(hull_survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
