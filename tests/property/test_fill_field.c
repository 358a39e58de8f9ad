/* Property: the tree that a filling asks says what the general tree says, bit for bit where it is
 * exact, and never less than the distance where it is fast. */
#include "mesh_maker.h"
#include "support.h"

#include "math/rng.h"
#include "shape/fill_field.h"
#include <clast/mesh.h>
#include <stdlib.h>
#include <string.h>

/* Ellipsoids with a box into them, turned; every other one drawn out into needles and slivers. */
static void make_body(uint64_t seed, clast_mesh *mesh)
{
    clx_rng rng = clx_rng_at(seed, CLX_STREAM_TEST, 91);
    const double axes[3] = {0.3 + clx_rng_uniform(&rng), 0.3 + clx_rng_uniform(&rng),
                            0.3 + clx_rng_uniform(&rng)};
    CHECK_OK(clast_mesh_ellipsoid(axes, 3, mesh));
    mesh_add_box(mesh, 0.5 + 0.5 * clx_rng_uniform(&rng), clx_rng_uniform(&rng),
                 clx_rng_uniform(&rng), clx_rng_uniform(&rng) - 0.5);
    for (int32_t v = 0; seed % 2 == 1 && v < mesh->n_vert; ++v) {
        mesh->vert[v][0] *= 300.0;
    }
    mesh_tilt(mesh);
}

/* Corners, middles of edges, points nearby and points far away. */
static void make_point(const clast_mesh *mesh, clx_rng *rng, int i, double point[3])
{
    const int32_t *tri = mesh->tri[(int32_t)(clx_rng_uniform(rng) * mesh->n_tri)];
    double low[3];
    double high[3];
    clast_mesh_bounds(mesh, low, high);
    for (int k = 0; k < 3; ++k) {
        const double a = mesh->vert[tri[0]][k];
        const double b = mesh->vert[tri[1]][k];
        const double far = i % 5 == 3 ? 1e20 : 2.0;
        const double off = (clx_rng_uniform(rng) - 0.5) * far * (high[k] - low[k]);
        point[k] = i % 5 == 0 ? a : i % 5 == 1 ? 0.5 * (a + b) : 0.5 * (low[k] + high[k]) + off;
    }
}

static void compare(const clx_fill_field *field, const clast_bvh *bvh, const double point[3],
                    double share)
{
    double there[3];
    double here[3];
    int32_t tri = -1;
    const double whole = clast_bvh_closest(bvh, point, INFINITY, there, NULL);
    const double bound = whole * share;
    const double wanted = clast_bvh_closest(bvh, point, bound, there, NULL);
    const double exact = clx_fill_field_closest(field, point, bound, here);
    assert_true(clx_fill_field_inside(field, point) == clast_bvh_inside(bvh, point));
    assert_true(exact == wanted);
    for (int k = 0; k < 3 && wanted <= bound; ++k) {
        assert_true(here[k] == there[k]);
    }
    if (whole < 1e6) { /* fillings ask from nearby */
        const double fast = clx_fill_field_distance(field, point, INFINITY, here, &tri);
        assert_true(fast >= whole * (1.0 - 1e-12) - 1e-6 * field->error);
        assert_true(fast <= whole + field->error);
        assert_true(tri >= 0);
    }
}

static void tree_of_a_filling_agrees_with_the_general_one(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 12; ++seed) {
        clx_rng rng = clx_rng_at(seed, CLX_STREAM_TEST, 92);
        clast_mesh mesh = {0};
        clast_bvh *bvh = NULL;
        clx_fill_field field = {0};
        make_body(seed, &mesh);
        CHECK_OK(clast_bvh_create(&mesh, &bvh));
        CHECK_OK(clx_fill_field_create(&mesh, &field));
        for (int i = 0; i < 400; ++i) {
            double point[3];
            make_point(&mesh, &rng, i, point);
            compare(&field, bvh, point, i % 3 == 0 ? (double)INFINITY : i % 3 == 1 ? 1.0 : 0.99);
        }
        clx_fill_field_free(&field);
        clast_bvh_destroy(bvh);
        clast_mesh_free(&mesh);
    }
}

static void every_triangle_stands_in_one_leaf(void **state)
{
    clast_mesh mesh = {0};
    clx_fill_field field = {0};
    (void)state;
    make_body(4, &mesh);
    for (int32_t t = 0; t < 600; ++t) { /* many on one place: no plane parts them */
        memcpy(mesh.tri[t], mesh.tri[0], sizeof mesh.tri[0]);
    }
    CHECK_OK(clx_fill_field_create(&mesh, &field));
    bool *is_seen = calloc((size_t)mesh.n_tri, sizeof *is_seen);
    int32_t n_seen = 0;
    for (int64_t i = 0; i < field.n_leaf; ++i) {
        assert_in_range(field.leaf[i].count, 1, CLX_FILL_LANES);
        for (int32_t k = 0; k < field.leaf[i].count; ++k) {
            const int32_t tri = field.item[field.leaf[i].first + k];
            assert_false(is_seen[tri]);
            is_seen[tri] = true;
            ++n_seen;
        }
    }
    assert_int_equal(n_seen, mesh.n_tri);
    free(is_seen);
    clx_fill_field_free(&field);
    clast_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tree_of_a_filling_agrees_with_the_general_one),
        cmocka_unit_test(every_triangle_stands_in_one_leaf),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
