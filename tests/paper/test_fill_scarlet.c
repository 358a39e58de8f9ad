/* Paper [SCARLET-1.0]: the published filling against the measured runs of the original program
 * (300 spheres, 10 candidates, first sphere at the mean of a random third of the corners), and the
 * largest-first filling on the same shapes. The original is one run a shape; ours is the mean of
 * four seeds, and the tolerance four spreads of one run (twelve seeds; docs/theory/fill.md). */
#include "mesh_maker.h"
#include "support.h"

#include <clast/fill.h>

typedef struct {
    const char *name;
    double filled, filled_spread;
    double poking, poking_spread; /* share of the spheres that poke out */
    double drawn, drawn_spread;   /* points tested */
} original;

static const original originals[] = {
    {"scarlet/stl/ellipse.stl", 0.493, 0.014, 0.36, 0.024, 9766, 350},
    {"scarlet/stl/particle.stl", 0.422, 0.009, 0.35, 0.019, 21351, 440},
    {"scarlet/stl/t_rex.stl", 0.558, 0.024, 0.67, 0.032, 67512, 3100},
};
enum { N_ORIGINAL = sizeof originals / sizeof originals[0], N_SEED = 4 };

static clast_fill_report run(const clast_mesh *mesh, uint64_t seed, bool published)
{
    clast_fill_config config;
    clast_fill_report report;
    clast_spheres s = {0};
    CHECK_OK(clast_fields_default(clast_fill_fields, &config));
    config.strategy = published ? CLAST_FILL_PUBLISHED : CLAST_FILL_LARGEST;
    config.vertex_subset = published;
    config.seed = seed;
    CHECK_OK(clast_fill(mesh, &config, NULL, &s, &report));
    assert_int_equal(s.n, 300);
    clast_spheres_free(&s);
    clast_fields_free(clast_fill_fields, &config);
    return report;
}

static void published_filling_is_that_of_the_original(void **state)
{
    (void)state;
    for (int i = 0; i < N_ORIGINAL; ++i) {
        const original *o = &originals[i];
        clast_mesh mesh = {0};
        double filled = 0.0;
        double poking = 0.0;
        double drawn = 0.0;
        if (!mesh_read_data(o->name, &mesh)) {
            continue;
        }
        for (uint64_t seed = 1; seed <= N_SEED; ++seed) {
            const clast_fill_report r = run(&mesh, seed, true);
            filled += r.sphere_volume / r.solid_volume / N_SEED; // outside and all, as theirs
            poking += r.n_protruding / 300.0 / N_SEED;
            drawn += (double)r.n_tested / N_SEED;
        }
        print_message(
            "%s: filled %.3f (original %.3f), poking out %.3f (%.2f), drawn %.0f (%.0f)\n", o->name,
            filled, o->filled, poking, o->poking, drawn, o->drawn);
        CHECK_ABS(filled, o->filled, 4.0 * o->filled_spread);
        CHECK_ABS(poking, o->poking, 4.0 * o->poking_spread);
        CHECK_ABS(drawn, o->drawn, 4.0 * o->drawn_spread);
        clast_mesh_free(&mesh);
    }
}

static void largest_first_fills_more_and_pokes_out_nowhere(void **state)
{
    (void)state;
    for (int i = 0; i < N_ORIGINAL; ++i) {
        clast_mesh mesh = {0};
        if (!mesh_read_data(originals[i].name, &mesh)) {
            continue;
        }
        const clast_fill_report r = run(&mesh, 1, false);
        print_message("%s: filled %.4f, protrusion %.2g\n", originals[i].name, r.filled_fraction,
                      r.max_protrusion);
        assert_true(r.filled_fraction > originals[i].filled + 5.0 * originals[i].filled_spread);
        assert_true(r.max_protrusion <= 1e-6);
        clast_mesh_free(&mesh);
    }
}

/* O_ext on the published fillings: 175, 171 and 108 outer spheres were reconstructed for the three
 * shapes. (The fourth, the snowflake with 136, does not agree: ours keeps 186 +- 13.) */
static void outer_spheres_are_as_many_as_reconstructed(void **state)
{
    (void)state;
    static const double wanted[N_ORIGINAL][2] = {{175, 8.3}, {171, 18}, {108, 18}};
    for (int i = 0; i < N_ORIGINAL; ++i) {
        clast_mesh mesh = {0};
        double kept = 0.0;
        if (!mesh_read_data(originals[i].name, &mesh)) {
            continue;
        }
        for (uint64_t seed = 1; seed <= N_SEED; ++seed) {
            clast_fill_config config;
            clast_spheres s = {0};
            CHECK_OK(clast_fields_default(clast_fill_fields, &config));
            config.strategy = CLAST_FILL_PUBLISHED;
            config.vertex_subset = true;
            config.outer = true;
            config.seed = seed;
            CHECK_OK(clast_fill(&mesh, &config, NULL, &s, NULL));
            kept += (double)s.n / N_SEED;
            clast_spheres_free(&s);
            clast_fields_free(clast_fill_fields, &config);
        }
        print_message("%s: %.0f outer spheres (%.0f)\n", originals[i].name, kept, wanted[i][0]);
        CHECK_ABS(kept, wanted[i][0], 3.0 * wanted[i][1]);
        clast_mesh_free(&mesh);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(published_filling_is_that_of_the_original),
        cmocka_unit_test(largest_first_fills_more_and_pokes_out_nowhere),
        cmocka_unit_test(outer_spheres_are_as_many_as_reconstructed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
