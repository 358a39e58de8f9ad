/* Property: what holds for every aggregate, whatever its shapes and options. */
#include "aggregates.h"

#include "math/vec3.h"
#include <clast/mesh.h>
#include <string.h>

static const double axes[2][3] = {{1.0, 0.7, 0.4}, {1.0, 0.5, 0.5}};

#define COMMON "size_law=uniform;size_low=0.2;size_high=0.6;cone=60deg;envelope_every=7;"

#define DIFFUSIVE "size_law=uniform;size_low=0.2;size_high=0.6;envelope_every=7;approach=diffusive;"

#define SPHERE "envelope=enclosing_sphere;"

static const char *const runs[] = {
    COMMON "n_particle=12;rays=6;orientations=3;target=mass",
    /* Searches long enough to be shared: what follows a landing goes beside the next of them. */
    COMMON "n_particle=12;rays=1500;orientations=2;envelope_every=1",
    COMMON "n_particle=12;rays=1500;orientations=2;stop_size=1.3;envelope=surface_hull;"
           "envelope=enclosing_sphere",
    COMMON SPHERE "n_particle=30;contact=spheres;origin=sphere;rays=4;orientations=2",
    COMMON SPHERE "n_particle=30;contact=march;flavour=release;rays=3;orientations=2",
    COMMON SPHERE "n_particle=30;contact=march;flavour=figures;coat_weight=1;coat_weight=2",
    COMMON SPHERE "n_particle=30;axis=0,0,1;origin=grain;stop_mass=900",
    COMMON SPHERE "n_particle=30;mode=cluster;rays=2",
    COMMON SPHERE "n_particle=30;mode=cluster;n_final=3;pick=brownian;orientations=3",
    COMMON "n_particle=12;rays=3;orientations=2;approach=ballistic;target=mass",
    COMMON "n_particle=12;approach=ballistic;cone=180deg;rays=1500;envelope_every=1",
    DIFFUSIVE "n_particle=20",
    DIFFUSIVE SPHERE "n_particle=20;contact=spheres",
    DIFFUSIVE SPHERE "n_particle=20;mode=cluster;n_final=2;pick=brownian",
    COMMON SPHERE "n_particle=20;mode=cluster;approach=ballistic;rays=2",
};
enum { N_RUN = sizeof runs / sizeof runs[0] };

static void same_assembly(const clast_assembly *a, const clast_assembly *b)
{
    assert_int_equal(a->n_grain, b->n_grain);
    assert_int_equal(a->n_contact, b->n_contact);
    assert_memory_equal(a->position, b->position, (size_t)a->n_grain * sizeof *a->position);
    assert_memory_equal(a->orientation, b->orientation,
                        (size_t)a->n_grain * sizeof *a->orientation);
    assert_memory_equal(a->scale, b->scale, (size_t)a->n_grain * sizeof *a->scale);
    assert_memory_equal(a->shape_id, b->shape_id, (size_t)a->n_grain * sizeof *a->shape_id);
    assert_memory_equal(a->contact, b->contact, (size_t)a->n_contact * sizeof *a->contact);
    assert_memory_equal(a->contact_point, b->contact_point,
                        (size_t)a->n_contact * sizeof *a->contact_point);
}

static void same_history(const clast_aggregate *a, const clast_aggregate *b)
{
    clast_table x = {0};
    clast_table y = {0};
    CHECK_OK(clast_aggregate_history(a, &x));
    CHECK_OK(clast_aggregate_history(b, &y));
    assert_int_equal(x.n_row, y.n_row);
    assert_int_equal(x.n_column, y.n_column);
    for (int32_t c = 0; c < x.n_column; ++c) {
        assert_memory_equal(x.column[c].number, y.column[c].number,
                            (size_t)x.n_row * sizeof(double));
    }
    clast_table_free(&x);
    clast_table_free(&y);
}

static void threads_change_no_bit(void **state)
{
    (void)state;
    for (int r = 0; r < N_RUN; ++r) {
        support_aggregate s;
        support_aggregate_make(&s, axes, 2, runs[r]);
        clast_parallel_set_threads(1);
        clast_aggregate *one = support_aggregate_run(&s, 1);
        for (int32_t n = 2; n <= 4; n += 2) {
            clast_parallel_set_threads(n);
            clast_aggregate *many = support_aggregate_run(&s, 1);
            same_assembly(clast_aggregate_assembly(one), clast_aggregate_assembly(many));
            same_history(one, many);
            clast_aggregate_destroy(many);
        }
        clast_parallel_set_threads(0);
        clast_aggregate_destroy(one);
        support_aggregate_free(&s);
    }
}

/// Grows `first` steps, leaves, and goes on in another handle.
static clast_aggregate *run_in_two(support_aggregate *s, int32_t first)
{
    clast_aggregate *a = NULL;
    clast_aggregate *b = NULL;
    clast_table history = {0};
    clast_table members = {0};
    CHECK_OK(clast_aggregate_create(&s->config.params, &s->input, 2, &a));
    CHECK_OK(clast_aggregate_grow(a, first, NULL));
    CHECK_OK(clast_aggregate_history(a, &history));
    CHECK_OK(clast_aggregate_members(a, &members));
    const clast_aggregate_saved saved = {.repeat = 2,
                                         .placed = clast_aggregate_assembly(a),
                                         .history = &history,
                                         .members = &members};
    CHECK_OK(clast_aggregate_restore(&s->config.params, &s->input, &saved, &b));
    clast_aggregate_destroy(a);
    clast_table_free(&history);
    clast_table_free(&members);
    CHECK_OK(clast_aggregate_grow(b, INT32_MAX, NULL));
    return b;
}

static void going_on_changes_no_bit(void **state)
{
    (void)state;
    const int32_t firsts[] = {0, 1, 13};
    for (int r = 0; r < N_RUN; ++r) {
        support_aggregate s;
        support_aggregate_make(&s, axes, 2, runs[r]);
        clast_aggregate *whole = support_aggregate_run(&s, 2);
        for (int k = 0; k < 3; ++k) {
            clast_aggregate *parts = run_in_two(&s, firsts[k]);
            same_assembly(clast_aggregate_assembly(whole), clast_aggregate_assembly(parts));
            same_history(whole, parts);
            clast_aggregate_destroy(parts);
        }
        clast_aggregate_destroy(whole);
        support_aggregate_free(&s);
    }
}

static void another_repeat_is_another_aggregate(void **state)
{
    (void)state;
    support_aggregate s;
    support_aggregate_make(&s, axes, 2, runs[0]);
    clast_aggregate *a = support_aggregate_run(&s, 0);
    clast_aggregate *b = support_aggregate_run(&s, 1);
    assert_memory_not_equal(clast_aggregate_assembly(a)->position[5],
                            clast_aggregate_assembly(b)->position[5], 3 * sizeof(double));
    clast_aggregate_destroy(a);
    clast_aggregate_destroy(b);
    support_aggregate_free(&s);
}

enum { FINE = 5 };

/// Distance of the nearest facet of the unit icosphere: scaled by its inverse it holds the ball.
static double inner_radius(void)
{
    clast_mesh ball = {0};
    double least = 1.0;
    CHECK_OK(clast_mesh_ellipsoid((double[3]){1.0, 1.0, 1.0}, FINE, &ball));
    for (int32_t t = 0; t < ball.n_tri; ++t) {
        const double *a = ball.vert[ball.tri[t][0]];
        double u[3], v[3], n[3];
        v3_sub(u, ball.vert[ball.tri[t][1]], a);
        v3_sub(v, ball.vert[ball.tri[t][2]], a);
        v3_cross(n, u, v);
        least = fmin(least, v3_dot(n, a) / v3_norm(n));
    }
    clast_mesh_free(&ball);
    return least;
}

/// Volume of the hull (by qhull) of the first n grains' tessellations, each scaled about its
/// centre.
static double tessellated_hull(const clast_assembly *all, int32_t n, double scale)
{
    clast_mesh points = {0};
    clast_mesh hull = {0};
    clast_mass mass;
    for (int32_t i = 0; i < n; ++i) {
        clast_mesh grain = {0};
        const clast_shape *shape = &all->shape[all->shape_id[i]];
        CHECK_OK(clast_mesh_ellipsoid(shape->semi_axes, FINE, &grain));
        clast_mesh_transform(&grain, scale * all->scale[i], all->orientation[i], all->position[i]);
        CHECK_OK(clast_mesh_append(&points, &grain));
        clast_mesh_free(&grain);
    }
    CHECK_OK(clast_mesh_hull(&points, &hull));
    CHECK_OK(clast_mesh_mass(&hull, &mass));
    clast_mesh_free(&hull);
    clast_mesh_free(&points);
    return mass.volume;
}

/* The hull of curved grains is refined to a gap of 2e-3 of its volume: so exact must the porosity
   of a row be, told by tessellations inside the grains and around them. At the end it is exact. */
static void porosity_of_rows_is_that_of_tessellated_grains(void **state)
{
    (void)state;
    const double tolerance = 2e-3;
    const double around = 1.0 / inner_radius();
    const int32_t rows[] = {0, 1, 4, 16};
    support_aggregate s;
    clast_table history = {0};
    clast_aggregate_result result;
    support_aggregate_make(&s, axes, 2, COMMON "envelope_every=1;n_particle=16;rays=3");
    clast_aggregate *a = support_aggregate_run(&s, 0);
    const clast_assembly *all = clast_aggregate_assembly(a);
    CHECK_OK(clast_aggregate_history(a, &history));
    CHECK_OK(clast_aggregate_measure(a, &result));
    const double *porosity = clast_table_numbers(&history, "porosity_surface_hull");
    const double *solid = clast_table_numbers(&history, "solid_m3");
    for (int k = 0; k < 4; ++k) {
        const int32_t row = rows[k];
        const double low = 1.0 - solid[row] / tessellated_hull(all, row + 1, 1.0);
        const double high = 1.0 - solid[row] / tessellated_hull(all, row + 1, around);
        const double slack = tolerance * (1.0 - low);
        assert_true(high - low < 0.5 * slack); /* the tessellations are fine enough to tell */
        assert_true(high - slack <= porosity[row] && porosity[row] <= low + slack);
        if (row == 16) {
            assert_true(low <= result.porosity[0] && result.porosity[0] <= high);
        }
    }
    clast_table_free(&history);
    clast_aggregate_destroy(a);
    support_aggregate_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_change_no_bit),
        cmocka_unit_test(going_on_changes_no_bit),
        cmocka_unit_test(another_repeat_is_another_aggregate),
        cmocka_unit_test(porosity_of_rows_is_that_of_tessellated_grains),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
