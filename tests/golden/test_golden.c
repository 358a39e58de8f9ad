/* Golden: did a result move? Each scene runs on 1, 2 and 4 threads: the same bits, and the numbers
   of tests/golden/scenes.golden. Those are counts and hashes of counts (exact), or real numbers to
   1e-9, since sines and powers of another C library may differ in the last bit.

   To renew them on purpose (a commit of its own, with the reason):
       CLAST_RENEW_GOLDEN=1 build/dev/tests/golden_test_golden */
#include "aggregates.h"
#include "mesh_maker.h"

#include "math/rng.h"
#include <clast/aggregate_run.h>
#include <clast/decompose.h>
#include <clast/fill.h>
#include <clast/machine.h>
#include <clast/render.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_VALUE = 8 };

static const char golden_file[] = "tests/golden/scenes.golden";

/* What a scene came to. */
typedef struct {
    uint64_t bits; ///< hash of all bytes of the result
    int n;
    struct {
        const char *key;
        bool exact;
        double value;
    } item[MAX_VALUE];
} outcome;

/* FNV-1a. */
static uint64_t hash(uint64_t h, const void *bytes, size_t n)
{
    const uint8_t *p = bytes;
    for (size_t i = 0; i < n; ++i) {
        h = (h ^ p[i]) * 1099511628211u;
    }
    return h;
}

static void note(outcome *o, const char *key, bool exact, double value)
{
    assert_true(o->n < MAX_VALUE);
    o->item[o->n].key = key;
    o->item[o->n].exact = exact;
    o->item[o->n++].value = value;
}

/* A hash that a double holds. */
static double hash_value(uint64_t h)
{
    return (double)(h >> 16);
}

static void take_assembly(const clast_assembly *a, outcome *o)
{
    const size_t n = (size_t)a->n_grain;
    o->bits = hash(o->bits, a->position, n * sizeof *a->position);
    o->bits = hash(o->bits, a->orientation, n * sizeof *a->orientation);
    o->bits = hash(o->bits, a->scale, n * sizeof *a->scale);
    o->bits = hash(o->bits, a->contact_point, (size_t)a->n_contact * sizeof *a->contact_point);
    note(o, "n_grain", true, a->n_grain);
    note(o, "n_contact", true, a->n_contact);
    note(o, "contacts", true,
         hash_value(
             hash(14695981039346656037u, a->contact, (size_t)a->n_contact * sizeof *a->contact)));
}

static void grow(const char *options, outcome *o)
{
    clast_aggregate_config config;
    clast_aggregate_source source = {0};
    clast_aggregate *a = NULL;
    clast_aggregate_result result;
    CHECK_OK(clast_fields_default(clast_aggregate_fields, &config));
    support_aggregate_options(&config, options);
    CHECK_OK(clast_aggregate_load(&config, &source));
    CHECK_OK(clast_aggregate_create(&config.params, &source.input, 0, &a));
    CHECK_OK(clast_aggregate_grow(a, INT32_MAX, NULL));
    CHECK_OK(clast_aggregate_measure(a, &result));
    take_assembly(clast_aggregate_assembly(a), o);
    o->bits = hash(o->bits, result.porosity, (size_t)result.n_envelope * sizeof *result.porosity);
    o->bits = hash(o->bits, &result.solid_union, sizeof result.solid_union);
    note(o, "porosity", false, result.porosity[0]);
    note(o, "d_agg", false, result.d_agg);
    note(o, "radius_of_gyration", false, result.radius_of_gyration);
    clast_aggregate_destroy(a);
    clast_aggregate_unload(&source);
    clast_fields_free(clast_aggregate_fields, &config);
}

#define ASH                                                                                        \
    "core=data/scarlet/stl/27sk21_shape_coarse.stl;coat=data/scarlet/stl/27sk21_shape_fine.stl;"   \
    "coat=data/scarlet/stl/27sk21_shape_coarse.stl;unit=um;class_limit=63 um;core_size=40 um;"     \
    "sizes=data/scarlet/ej15_deq_um.csv;size_unit=um;size_meaning=mean_diameter;n_particle=16;"    \
    "cone=50 deg;rays=4;orientations=3;"
#define COMPOSITES                                                                                 \
    "core_spheres=data/scarlet/27sk21_shape_coarse_spheres.csv;"                                   \
    "coat_spheres=data/scarlet/27sk21_shape_fine_spheres.csv;"                                     \
    "coat_spheres=data/scarlet/27sk21_shape_coarse_spheres.csv;"

static void aggregate_exact(outcome *o)
{
    grow(ASH, o);
}

static void aggregate_spheres(outcome *o)
{
    grow(ASH COMPOSITES "contact=spheres;envelope=sphere_hull;solid_union=false", o);
}

static void aggregate_march(outcome *o)
{
    grow(ASH COMPOSITES "contact=march;flavour=figures;envelope=sphere_rays;envelope_rays=500;"
                        "envelope_every=100;solid_union=false;orientations=1",
         o);
}

static void fill_largest(outcome *o)
{
    clast_mesh mesh = {0};
    clast_spheres spheres = {0};
    clast_fill_report report;
    clast_fill_config config;
    CHECK_OK(clast_fields_default(clast_fill_fields, &config));
    config.spheres = 60;
    assert_true(mesh_read_data("scarlet/stl/27sk21_shape_coarse.stl", &mesh));
    CHECK_OK(clast_fill(&mesh, &config, NULL, &spheres, &report));
    o->bits = hash(o->bits, spheres.centre, (size_t)spheres.n * sizeof *spheres.centre);
    o->bits = hash(o->bits, spheres.radius, (size_t)spheres.n * sizeof *spheres.radius);
    note(o, "n_sphere", true, report.n_sphere);
    note(o, "n_tested", true, (double)report.n_tested);
    note(o, "filled_fraction", false, report.filled_fraction);
    note(o, "radius_max", false, report.radius_max);
    note(o, "radius_min", false, report.radius_min);
    clast_spheres_free(&spheres);
    clast_mesh_free(&mesh);
    clast_fields_free(clast_fill_fields, &config);
}

static void render_grain(outcome *o)
{
    const double none[3] = {0.0, 0.0, 0.0};
    const double turned[4] = {0.8, 0.6, 0.0, 0.0};
    clast_mesh mesh = {0};
    clast_shape shape = {0};
    clast_assembly assembly = {0};
    clast_image image = {0};
    clast_render_config config;
    uint64_t sum = 0;
    CHECK_OK(clast_fields_default(clast_render_fields, &config));
    config.width = 160;
    config.height = 120;
    config.colour_bar = false; /* no text: fonts differ between machines */
    config.scale_bar = false;
    assert_true(mesh_read_data("scarlet/stl/27sk21_shape_fine.stl", &mesh));
    CHECK_OK(clast_shape_mesh("grain", &mesh, &shape));
    CHECK_OK(clast_assembly_add_shape(&assembly, &shape, NULL));
    CHECK_OK(clast_assembly_add_grain(&assembly, 0, none, turned, 1.0, 2500.0));
    CHECK_OK(clast_render_assembly(&assembly, &config, NULL, &image));
    const size_t n = (size_t)image.width * (size_t)image.height * 4;
    for (size_t i = 0; i < n; ++i) {
        sum += image.rgba[i];
    }
    o->bits = hash(o->bits, image.rgba, n);
    note(o, "width", true, image.width);
    note(o, "height", true, image.height);
    note(o, "pixels", true, (double)sum);
    clast_image_free(&image);
    clast_assembly_free(&assembly);
    clast_shape_free(&shape);
    clast_mesh_free(&mesh);
    clast_fields_free(clast_render_fields, &config);
}

static void decompose_block(outcome *o, const char *mesh)
{
    enum { N = 5000 };
    clast_cloud cloud = {0};
    clast_decomposition r = {0};
    clast_decompose_config config;
    clx_rng rng = clx_rng_at(3, CLX_STREAM_TEST, 0);
    CHECK_OK(clast_fields_default(clast_decompose_fields, &config));
    config.estimator = CLAST_ESTIMATOR_CELLS;
    CHECK_OK(clast_field_set(clast_fields_find(clast_decompose_fields, "domain"), &config,
                             "box:0,0,0,1,1,1", false));
    CHECK_OK(
        clast_field_set(clast_fields_find(clast_decompose_fields, "mesh"), &config, mesh, false));
    config.beta_dt = 1e-6; // m^3
    CHECK_OK(clast_cloud_alloc(N, 3, &cloud));
    for (int i = 0; i < 3 * N; ++i) { // half of the points in an eighth of the cube
        const double x = clx_rng_uniform(&rng);
        cloud.x[i] = i / 3 % 2 == 0 ? x : 0.25 + 0.5 * x;
    }
    CHECK_OK(clast_decompose(&cloud, &config, &r));
    o->bits = hash(o->bits, r.cells.of_point, N * sizeof *r.cells.of_point);
    o->bits = hash(o->bits, r.cells.events, (size_t)r.cells.n * sizeof *r.cells.events);
    note(o, "n_cell", true, r.cells.n);
    note(o, "cells", true,
         hash_value(hash(14695981039346656037u, r.cells.of_point, N * sizeof *r.cells.of_point)));
    note(o, "n_pass", true, r.n_pass);
    note(o, "events", false, r.events);
    note(o, "score", false, r.before.score);
    clast_decomposition_free(&r);
    clast_cloud_free(&cloud);
    clast_fields_free(clast_decompose_fields, &config);
}

static void decompose_boxes(outcome *o)
{
    decompose_block(o, "boxes");
}

static void decompose_tree(outcome *o)
{
    decompose_block(o, "tree");
}

static const struct {
    const char *name;
    void (*run)(outcome *o);
} scenes[] = {
    {"aggregate_exact", aggregate_exact}, {"aggregate_spheres", aggregate_spheres},
    {"aggregate_march", aggregate_march}, {"fill_largest", fill_largest},
    {"render_grain", render_grain},       {"decompose_block", decompose_boxes},
    {"decompose_tree", decompose_tree},
};
enum { N_SCENE = sizeof scenes / sizeof scenes[0] };

static outcome run_scene(int i, int32_t threads)
{
    outcome o = {.bits = 14695981039346656037u};
    clast_parallel_set_threads(threads);
    scenes[i].run(&o);
    clast_parallel_set_threads(0);
    return o;
}

static void threads_change_no_bit(void **state)
{
    (void)state;
    for (int i = 0; i < N_SCENE; ++i) {
        const outcome one = run_scene(i, 1);
        for (int32_t threads = 2; threads <= 4; threads *= 2) {
            const outcome many = run_scene(i, threads);
            if (many.bits != one.bits) {
                print_error("%s differs on %d threads\n", scenes[i].name, threads);
            }
            assert_true(many.bits == one.bits);
        }
    }
}

static void renew(FILE *file)
{
    for (int i = 0; i < N_SCENE; ++i) {
        const outcome o = run_scene(i, 1);
        for (int k = 0; k < o.n; ++k) {
            (void)fprintf(file, "%s %s %s %.17g\n", scenes[i].name, o.item[k].key,
                          o.item[k].exact ? "exact" : "1e-9", o.item[k].value);
        }
    }
}

/* Number of a line of the golden file, or NAN (said). */
static double golden(const char *scene, const char *key)
{
    char line[256];
    double found = (double)NAN;
    FILE *file = fopen(golden_file, "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file) != NULL) {
        char name[64];
        char what[64];
        char how[16];
        double value = 0.0;
        if (sscanf(line, "%63s %63s %15s %lf", name, what, how, &value) == 4 &&
            strcmp(name, scene) == 0 && strcmp(what, key) == 0) {
            found = value;
        }
    }
    (void)fclose(file);
    return found;
}

static void results_are_as_before(void **state)
{
    (void)state;
    bool same = true;
    if (getenv("CLAST_RENEW_GOLDEN") != NULL) {
        FILE *file = fopen(golden_file, "w");
        assert_non_null(file);
        renew(file);
        assert_int_equal(fclose(file), 0);
    }
    for (int i = 0; i < N_SCENE; ++i) {
        const outcome o = run_scene(i, 1);
        for (int k = 0; k < o.n; ++k) {
            const double was = golden(scenes[i].name, o.item[k].key);
            const double is = o.item[k].value;
            const double tolerance = o.item[k].exact ? 0.0 : 1e-9 * fabs(was);
            if (!(fabs(is - was) <= tolerance)) {
                print_error("%s: %s was %.17g, is %.17g\n", scenes[i].name, o.item[k].key, was, is);
                same = false;
            }
        }
    }
    assert_true(same);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_change_no_bit),
        cmocka_unit_test(results_are_as_before),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
