// Unit: solid volume in slices against closed forms, the bulk value of known beds.
#include "support.h"

#include "math/vec3.h"
#include "porosity/discs.h"
#include <string.h>

static const double upright[4] = {1.0, 0.0, 0.0, 0.0};

static void one_grain(const clast_shape *shape, const double position[3],
                      const double orientation[4], double scale, clast_assembly *assembly)
{
    int32_t id = 0;
    CHECK_OK(clast_assembly_add_shape(assembly, shape, &id));
    CHECK_OK(clast_assembly_add_grain(assembly, id, position, orientation, scale, 2650.0));
}

static double below(const clast_assembly *a, double z)
{
    const double edge[2] = {-HUGE_VAL, z};
    double solid = 0.0;
    CHECK_OK(clast_porosity_grain_slabs(a, 0, CLAST_POROSITY_EXACT, 1, edge, &solid));
    return solid;
}

static void sphere_is_cut_into_segments(void **state)
{
    (void)state;
    clast_shape shape = {0};
    clast_assembly a = {0};
    const double position[3] = {3.0, -4.0, 10.0};
    CHECK_OK(clast_shape_sphere("ball", 1.0, &shape));
    one_grain(&shape, position, upright, 2.0, &a);
    for (int k = 0; k <= 8; ++k) {
        const double h = 0.5 * k; // height of the segment
        CHECK_ABS(below(&a, 8.0 + h), CLAST_PI * h * h * (6.0 - h) / 3.0, 1e-13);
    }
    clast_assembly_free(&a);
    clast_shape_free(&shape);
}

/// A box turned any way: the volume below its centroid's height is half, and the parts add up.
static void turned_box_is_halved_and_whole(void **state)
{
    (void)state;
    clast_mesh box = {0};
    clast_shape shape = {0};
    CHECK_OK(clast_mesh_box(1.0, 2.0, 3.0, &box));
    CHECK_OK(clast_shape_mesh("box", &box, &shape));
    for (int k = 0; k < 20; ++k) {
        clast_assembly a = {0};
        double q[4] = {1.0, 0.3 * k, 1.0 - 0.2 * k, 0.1 * k * k};
        const double position[3] = {100.0, 0.0, 5.0};
        double edge[12];
        double solid[11] = {0};
        double sum = 0.0;
        q_unit(q);
        one_grain(&shape, position, q, 1.5, &a);
        CHECK_REL(below(&a, 5.0), 0.5 * 6.0 * 1.5 * 1.5 * 1.5, 1e-13);
        for (int e = 0; e < 12; ++e) {
            edge[e] = -1.0 + e * 1.1;
        }
        CHECK_OK(clast_porosity_grain_slabs(&a, 0, CLAST_POROSITY_EXACT, 11, edge, solid));
        for (int e = 0; e < 11; ++e) {
            assert_true(solid[e] >= -1e-13);
            sum += solid[e];
        }
        CHECK_REL(sum, 6.0 * 1.5 * 1.5 * 1.5, 1e-13);
        clast_assembly_free(&a);
    }
    clast_shape_free(&shape);
    clast_mesh_free(&box);
}

/// A pyramid on its base: the part below h of height H holds 1 - (1 - h/H)^3.
static void pyramid_follows_the_cube_law(void **state)
{
    (void)state;
    double vert[5][3] = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0.7, 0.2, 3}};
    int32_t tri[6][3] = {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    const clast_mesh mesh = {.n_vert = 5, .n_tri = 6, .vert = vert, .tri = tri};
    clast_shape shape = {0};
    clast_assembly a = {0};
    const double position[3] = {0.0, 0.0, 0.75}; // centroid: base at 0
    CHECK_OK(clast_shape_mesh("pyramid", &mesh, &shape));
    one_grain(&shape, position, upright, 1.0, &a);
    for (int k = 0; k <= 6; ++k) {
        const double left = 1.0 - k / 6.0;
        CHECK_ABS(below(&a, 0.5 * k), 4.0 * (1.0 - left * left * left), 1e-13);
    }
    clast_assembly_free(&a);
    clast_shape_free(&shape);
}

/// Independent routes to the same slices: closed form, and the integral over a fine surface whose
/// volume error is that of its triangles (level 5: 6e-4).
static void ellipsoid_agrees_with_its_surface(void **state)
{
    (void)state;
    const double axes[3] = {3.0, 2.0, 1.0};
    double q[4] = {0.5, -0.2, 0.7, 0.3};
    const double position[3] = {0.0, 0.0, 0.0};
    clast_shape smooth = {0};
    clast_shape faceted = {0};
    clast_mesh mesh = {0};
    clast_assembly a = {0};
    clast_assembly b = {0};
    q_unit(q);
    CHECK_OK(clast_shape_ellipsoid("smooth", axes, &smooth));
    CHECK_OK(clast_shape_surface(&smooth, 5, &mesh));
    CHECK_OK(clast_shape_mesh("faceted", &mesh, &faceted));
    one_grain(&smooth, position, q, 1.0, &a);
    one_grain(&faceted, position, q, 1.0, &b);
    const double ratio = smooth.volume / faceted.volume;
    CHECK_ABS(ratio, 1.0, 2e-3);
    for (int k = -5; k <= 5; ++k) {
        CHECK_ABS(below(&b, 0.4 * k) * ratio, below(&a, 0.4 * k), 1e-3 * smooth.volume);
    }
    clast_assembly_free(&a);
    clast_assembly_free(&b);
    clast_shape_free(&smooth);
    clast_shape_free(&faceted);
    clast_mesh_free(&mesh);
}

/// Two overlapping spheres one above the other: segments of one, lens left out.
static void clump_counts_overlap_once(void **state)
{
    (void)state;
    double centre[2][3] = {{0.0, 0.0, -0.5}, {0.0, 0.0, 0.5}};
    double radius[2] = {1.0, 1.0};
    const clast_spheres spheres = {2, centre, radius};
    const double position[3] = {0.0, 0.0, 0.0};
    double across[4] = {sqrt(0.5), sqrt(0.5), 0.0, 0.0};
    clast_shape shape = {0};
    clast_assembly a = {0};
    clast_assembly b = {0};
    CHECK_OK(clast_shape_clump("pair", &spheres, &shape));
    one_grain(&shape, position, upright, 1.0, &a);
    one_grain(&shape, position, across, 1.0, &b);
    const double half = CLAST_PI * 1.5 * 1.5 * (3.0 - 1.5) / 3.0; // segment of height 1.5
    // standing: the section is one disc everywhere, a polynomial that Gauss takes exactly
    CHECK_REL(below(&a, 0.0), half, 1e-11); // where the clump's own centroid is good to
    CHECK_REL(below(&a, -0.5), 2.0 / 3.0 * CLAST_PI, 1e-11);
    CHECK_REL(below(&a, 9.0), 2.0 * half, 1e-12);
    // lying: sections are two crossing discs, with a root at the rim where they part
    CHECK_REL(below(&b, 0.0), half, 1e-4);
    CHECK_REL(below(&b, 9.0), 2.0 * half, 1e-4);
    clast_assembly_free(&a);
    clast_assembly_free(&b);
    clast_shape_free(&shape);
}

static void union_of_discs_has_known_areas(void **state)
{
    (void)state;
    double area = 0.0;
    const clx_disc lens[2] = {{0.0, 0.0, 1.0}, {1.0, 0.0, 1.0}};
    const double overlap = 2.0 * CLAST_PI / 3.0 - sqrt(3.0) / 2.0;
    CHECK_OK(clx_discs_area(2, lens, &area));
    CHECK_REL(area, 2.0 * CLAST_PI - overlap, 1e-14);
    const clx_disc nested[3] = {{5.0, 5.0, 2.0}, {5.5, 5.0, 1.0}, {5.0, 5.0, 2.0}};
    CHECK_OK(clx_discs_area(3, nested, &area));
    CHECK_REL(area, 4.0 * CLAST_PI, 1e-14);
    const clx_disc apart[2] = {{0.0, 0.0, 1.0}, {9.0, -7.0, 3.0}};
    CHECK_OK(clx_discs_area(2, apart, &area));
    CHECK_REL(area, 10.0 * CLAST_PI, 1e-14);
    CHECK_OK(clx_discs_area(0, apart, &area));
    CHECK_ABS(area, 0.0, 0.0);
}

static void lattice(clast_assembly *a, int n)
{
    clast_shape shape = {0};
    int32_t id = 0;
    CHECK_OK(clast_shape_sphere("ball", 0.5, &shape));
    CHECK_OK(clast_assembly_add_shape(a, &shape, &id));
    for (int k = 0; k < n * n * n; ++k) {
        const double p[3] = {k % n + 0.5, k / n % n + 0.5, (double)(k / (n * n)) + 0.5};
        CHECK_OK(clast_assembly_add_grain(a, id, p, upright, 1.0, 2650.0));
    }
    clast_shape_free(&shape);
}

static void cubic_lattice_has_its_porosity(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_bed bed;
    clast_table profile = {0};
    clast_porosity_bulk bulk;
    clast_porosity_options options = clast_porosity_options_default();
    lattice(&a, 6);
    CHECK_OK(clast_bed_parse("periodic:0,0,6,6", &bed));
    options.layer = 0.125;
    options.trim = 1.0;
    options.at_slice = true;
    CHECK_OK(clast_porosity_profile(&a, &bed, &options, &profile));
    CHECK_OK(clast_porosity_measure(&a, &bed, &profile, &options, &bulk));
    // [1, top - 1]: layers 2, 3 and 4 whole, and the lowest part of layer 5
    const double part = bulk.top - 1.0 - 4.0;
    const double segment = CLAST_PI * part * part * (1.5 - part) / 3.0;
    const double expected = 36.0 * (3.0 * CLAST_PI / 6.0 + segment);
    assert_true(part > 0.0 && part < 1.0);
    CHECK_ABS(bulk.z_low, 1.0, 0.0);
    CHECK_REL(bulk.solid, expected, 1e-12);
    CHECK_REL(bulk.porosity, 1.0 - expected / (36.0 * (bulk.top - 2.0)), 1e-12);
    clast_table_free(&profile);
    clast_assembly_free(&a);
}

/* A window through the middle of balls holds what the lattice does; whole, they take 16/9 of it. */
static void a_window_of_a_lattice_has_its_porosity(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_bed bed;
    clast_bed_beyond beyond = {0};
    lattice(&a, 6);
    CHECK_OK(clast_bed_parse("box:1.5,1.5,4.5,4.5", &bed));
    for (int k = 0; k < 2; ++k) {
        const clast_porosity_options options = {.layer = 0.5, .cut = 1.0};
        clast_table profile = {0};
        clast_porosity_bulk bulk = {0};
        bed.is_part = k > 0;
        CHECK_OK(clast_porosity_profile(&a, &bed, &options, &profile));
        CHECK_OK(clast_porosity_measure(&a, &bed, &profile, &options, &bulk));
        CHECK_OK(clast_bed_beyond_measure(&bed, &a, &bulk, options.method, &beyond));
        CHECK_ABS(bulk.top, 6.0, 1e-12);
        CHECK_ABS(bulk.solid - (k == 0 ? beyond.solid : 0.0), 9.0 * CLAST_PI, 0.02);
        assert_int_equal(beyond.n, 192);
        clast_table_free(&profile);
    }
    clast_assembly_free(&a);
}

/* Sides that cut all balls alike, a quarter of a diameter beyond their faces: all had the same 512
 * points, whose error did not average (0.4436 for 0.4407). */
static void errors_of_balls_that_are_cut_alike_average(void **state)
{
    (void)state;
    const clast_porosity_options options = {.layer = 0.5, .cut = 1.0};
    const double cap = 5.0 / 32.0;  // CLAST_PI h^2 (3 r - h) / 3 of CLAST_PI / 6
    const double corner = 0.702489; // beyond neither of two planes, by quadrature
    clast_assembly a = {0};
    clast_table profile = {0};
    clast_porosity_bulk bulk = {0};
    clast_bed bed;
    lattice(&a, 10);
    CHECK_OK(clast_bed_parse("box:2.25,2.25,7.75,7.75", &bed));
    bed.is_part = true;
    CHECK_OK(clast_porosity_profile(&a, &bed, &options, &profile));
    CHECK_OK(clast_porosity_measure(&a, &bed, &profile, &options, &bulk));
    const double balls = 16.0 + 16.0 * (1.0 - cap) + 4.0 * corner;
    CHECK_ABS(bulk.porosity, 1.0 - balls * CLAST_PI / 6.0 / (5.5 * 5.5), 2e-4);
    clast_table_free(&profile);
    clast_assembly_free(&a);
}

/* A square of side 9 about a circle of radius 5 has corners of 81 - pi 25 + four segments. */
static void what_of_a_bed_lies_outside_another_is_known(void **state)
{
    (void)state;
    const double z[2] = {0.0, 3.0};
    const double segment = 25.0 * acos(0.9) - 4.5 * sqrt(4.75);
    const double outside = 1.0 - (25.0 * CLAST_PI - 4.0 * segment) / 81.0;
    double share = -1.0;
    clast_bed own;
    clast_bed bed;
    CHECK_OK(clast_bed_parse("cylinder:5,1,1", &own));
    CHECK_OK(clast_bed_parse("box:-3.5,-3.5,5.5,5.5", &bed));
    CHECK_OK(clast_bed_outside(&bed, &own, z, &share));
    CHECK_ABS(share, outside, 1e-3);
    CHECK_OK(clast_bed_outside(&own, &own, z, &share));
    CHECK_ABS(share, 0.0, 0.0);
    CHECK_STATUS(clast_bed_outside(&bed, &own, (const double[2]){1.0, 1.0}, &share), CLAST_E_USAGE);
    CHECK_OK(clast_bed_parse("periodic:0,0,1,1", &bed));
    bed.is_part = true;
    CHECK_STATUS(clast_bed_outside(&bed, &own, z, &share), CLAST_E_ARGUMENT);
}

/* Of a period that is theirs grains cover nothing, wherever the first image begins; of a smaller
 * one the sixth plane lies in the first. */
static void images_cover_grains_that_repeat_otherwise(void **state)
{
    (void)state;
    static const struct {
        const char *bed;
        double solid; // in balls
    } cases[] = {{"periodic:0,0,6,6", 0.0},       {"periodic:-1.3,2.1,4.7,8.1", 0.0},
                 {"periodic:0,0,0,6,6,6,2", 0.0}, {"periodic:0,0,6,5", 36.0},
                 {"periodic:0,0,0,6,6,5", 36.0},  {"periodic:0,0,0,6,6,5,2", 36.0}};
    const clast_porosity_bulk none = {0};
    clast_assembly a = {0};
    lattice(&a, 6);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        clast_bed bed;
        clast_bed_beyond covered = {.n = -1};
        CHECK_OK(clast_bed_parse(cases[k].bed, &bed));
        CHECK_OK(clast_bed_beyond_measure(&bed, &a, &none, CLAST_POROSITY_EXACT, &covered));
        CHECK_ABS(covered.solid, cases[k].solid * CLAST_PI / 6.0, 1e-9);
        assert_int_equal(covered.n, cases[k].solid > 0.0 ? 72 : 0);
    }
    clast_bed one;
    clast_bed_beyond covered = {.n = -1};
    CHECK_OK(clast_bed_parse("periodic:0,0,0,1,1,1", &one)); // a heap: all pairs of all grains
    CHECK_STATUS(clast_bed_beyond_measure(&one, &a, &none, CLAST_POROSITY_EXACT, &covered),
                 CLAST_E_GEOMETRY);
    clast_assembly_free(&a);
}

/// Grains in a hopper below the bed were all of the first slice, whose porosity fell below 0; what
/// dips into the floor by less than a slice still is.
static void what_lies_below_the_bed_is_of_no_slice(void **state)
{
    (void)state;
    const double z[2] = {-0.01, -7.0};
    clast_bed bed = {.kind = CLAST_BED_BOX, .high = {10.0, 10.0}};
    const clast_porosity_options options = {.layer = 0.5, .cut = 0.999, .at_slice = true};
    clast_shape shape = {0};
    CHECK_OK(clast_shape_sphere("ball", 1.0, &shape));
    for (int k = 0; k < 2; ++k) {
        clast_assembly a = {0};
        clast_table profile = {0};
        double sum = 0.0;
        const double at[2][3] = {{5.0, 5.0, 5.0}, {5.0, 5.0, 1.0 + z[k]}};
        one_grain(&shape, at[0], upright, 1.0, &a);
        CHECK_OK(clast_assembly_add_grain(&a, 0, at[1], upright, 1.0, 2650.0));
        CHECK_OK(clast_porosity_profile(&a, &bed, &options, &profile));
        for (int64_t i = 0; i < profile.n_row; ++i) {
            sum += clast_table_numbers(&profile, "solid_m3")[i];
        }
        CHECK_REL(sum, (k == 0 ? 2.0 : 1.0) * 4.0 / 3.0 * CLAST_PI, 1e-12);
        clast_porosity_bulk bulk = {0};
        CHECK_OK(clast_porosity_measure(&a, &bed, &profile, &options, &bulk));
        CHECK_REL(bulk.solid, sum, 1e-12);
        clast_table_free(&profile);
        clast_assembly_free(&a);
    }
    clast_shape_free(&shape);
}

static void top_lies_where_the_profile_crosses(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_bed bed;
    clast_table profile = {0};
    clast_porosity_bulk bulk;
    clast_porosity_options options = clast_porosity_options_default();
    lattice(&a, 4);
    CHECK_OK(clast_bed_parse("box:0,0,4,4", &bed));
    options.layer = 0.01;
    CHECK_OK(clast_porosity_profile(&a, &bed, &options, &profile));
    CHECK_OK(clast_porosity_measure(&a, &bed, &profile, &options, &bulk));
    // pi (1/4 - (z - 3.5)^2) = 1/2 above the last centre
    const double root = 3.5 + sqrt(0.25 - 0.5 / CLAST_PI);
    CHECK_ABS(bulk.top, root, 1e-4); // linear between centres 0.01 apart: h^2 n'' / (8 n')
    assert_int_equal(profile.n_row, 401);
    CHECK_ABS(clast_table_numbers(&profile, "porosity")[400], 1.0, 1e-12);
    options.trim = 2.0;
    CHECK_STATUS(clast_porosity_measure(&a, &bed, &profile, &options, &bulk), CLAST_E_GEOMETRY);
    options.trim = 0.0;
    options.cut = 0.01;
    CHECK_STATUS(clast_porosity_measure(&a, &bed, &profile, &options, &bulk), CLAST_E_GEOMETRY);
    clast_table_free(&profile);
    clast_assembly_free(&a);
}

static void profile_is_the_same_for_any_threads(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_bed bed;
    const clast_porosity_options options = {CLAST_POROSITY_EXACT, 0.03, 0.5, 0.0, false};
    clast_table profile[2] = {{0}, {0}};
    lattice(&a, 8);
    for (int32_t i = 0; i < a.n_grain; ++i) {
        a.position[i][2] += 0.1 * sin((double)i);
    }
    CHECK_OK(clast_bed_parse("box:0,0,8,8", &bed));
    for (int t = 0; t < 2; ++t) {
        clast_parallel_set_threads(1 + 3 * t);
        CHECK_OK(clast_porosity_profile(&a, &bed, &options, &profile[t]));
    }
    clast_parallel_set_threads(0);
    assert_memory_equal(profile[0].column[3].number, profile[1].column[3].number,
                        (size_t)profile[0].n_row * sizeof(double));
    clast_table_free(&profile[0]);
    clast_table_free(&profile[1]);
    clast_assembly_free(&a);
}

static void beds_are_read_and_written(void **state)
{
    (void)state;
    static const char *const bad[] = {"",
                                      "cylinder",
                                      "cylinder:0",
                                      "cylinder:-1",
                                      "box:1,2,3",
                                      "box:0,0,0,1",
                                      "ball:3",
                                      "box:0,0,1,x",
                                      "box:nan,0,1,1",
                                      "periodic:0,0,1,1,1",
                                      "periodic:0,0,0,1,1,1,1.5"};
    char text[200];
    clast_bed bed;
    clast_bed again;
    CHECK_OK(clast_bed_parse("cylinder:52 mm", &bed));
    CHECK_REL(clast_bed_area(&bed), CLAST_PI * 0.052 * 0.052, 1e-15);
    CHECK_OK(clast_bed_parse("periodic:-5cm,-5cm,0.05,0.07", &bed));
    CHECK_REL(clast_bed_area(&bed), 0.012, 1e-14);
    assert_true(clast_bed_format(&bed, sizeof text, text) > 0);
    CHECK_OK(clast_bed_parse(text, &again));
    assert_memory_equal(&bed, &again, sizeof bed);
    CHECK_OK(clast_bed_parse("periodic:-1,-2,-3,1,2,3,-0.3", &bed));
    assert_true(clast_bed_format(&bed, sizeof text, text) > 0);
    CHECK_OK(clast_bed_parse(text, &again));
    assert_memory_equal(&bed, &again, sizeof bed);
    CHECK_OK(clast_bed_parse("periodic:-5cm,-5cm,0.05,0.07", &bed));
    clast_table table = {0};
    bed.floor = 0.25;
    CHECK_OK(clast_bed_table(&bed, &table));
    CHECK_OK(clast_bed_from_table(&table, &again));
    CHECK_ABS(again.floor, 0.25, 0.0);
    CHECK_ABS(clast_bed_area(&again), clast_bed_area(&bed), 0.0);
    clast_table_free(&table);
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        CHECK_STATUS(clast_bed_parse(bad[i], &bed), CLAST_E_CONFIG);
    }
}

static void with_ball(clast_assembly *a)
{
    const double position[3] = {0.0, 0.0, 1.6};
    clast_shape shape = {0};
    CHECK_OK(clast_shape_sphere("ball", 1.0, &shape));
    one_grain(&shape, position, upright, 1.0, a);
    clast_shape_free(&shape);
}

/* Before: methods that there are not measured true shapes, a cut of NaN ended the bed below all,
 * and a trim below 0 went beyond it. */
static void options_that_cannot_be_are_refused(void **state)
{
    (void)state;
    const double nan = (double)NAN;
    const double inf = (double)INFINITY;
    const clast_porosity_options bad[] = {
        {(clast_porosity_method)9, 0.1, 0.5, 0.0, false},
        {(clast_porosity_method)-1, 0.1, 0.5, 0.0, false},
        {CLAST_POROSITY_EXACT, nan, 0.5, 0.0, false},
        {CLAST_POROSITY_EXACT, inf, 0.5, 0.0, false},
        {CLAST_POROSITY_EXACT, 0.0, 0.5, 0.0, false},
        {CLAST_POROSITY_EXACT, 0.1, nan, 0.0, false},
        {CLAST_POROSITY_EXACT, 0.1, 0.5, -1.0, false},
        {CLAST_POROSITY_EXACT, 0.1, 0.5, nan, false},
    };
    const clast_bed bed = {.kind = CLAST_BED_CYLINDER, .radius = 3.0};
    const clast_porosity_options good = {CLAST_POROSITY_EXACT, 0.1, 0.999, 0.0, false};
    clast_assembly a = {0};
    clast_table profile = {0};
    clast_table none = {0};
    clast_porosity_bulk bulk = {.porosity = -7.0};
    with_ball(&a);
    CHECK_OK(clast_porosity_profile(&a, &bed, &good, &profile));
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        const bool is_layer = !(bad[k].layer == 0.1); // as before
        const clast_status wanted = is_layer ? CLAST_E_USAGE : CLAST_E_ARGUMENT;
        CHECK_STATUS(clast_porosity_profile(&a, &bed, &bad[k], &none), wanted);
        CHECK_STATUS(clast_porosity_measure(&a, &bed, &profile, &bad[k], &bulk), wanted);
        assert_true(none.n_column == 0 && bulk.porosity == -7.0);
    }
    clast_table_free(&profile);
    clast_assembly_free(&a);
}

static void slabs_that_cannot_be_are_refused(void **state)
{
    (void)state;
    const double nan = (double)NAN;
    const double bad[][3] = {{nan, 1.0, 2.0}, {0.0, nan, 2.0}, {0.0, 1.0, nan},
                             {1.0, 0.0, 2.0}, {0.0, 2.0, 1.0}, {0.0, 0.0, 1.0}};
    const double good[3] = {-(double)INFINITY, 1.6, (double)INFINITY};
    double solid[2] = {0.0, 0.0};
    clast_assembly a = {0};
    with_ball(&a);
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        CHECK_STATUS(clast_porosity_grain_slabs(&a, 0, CLAST_POROSITY_EXACT, 2, bad[k], solid),
                     CLAST_E_ARGUMENT);
    }
    CHECK_STATUS(clast_porosity_grain_slabs(&a, 0, (clast_porosity_method)5, 2, good, solid),
                 CLAST_E_ARGUMENT);
    assert_true(solid[0] == 0.0 && solid[1] == 0.0);
    CHECK_OK(clast_porosity_grain_slabs(&a, 0, CLAST_POROSITY_EXACT, 2, good, solid));
    CHECK_REL(solid[0], 2.0 / 3.0 * CLAST_PI, 1e-12);
    clast_assembly_free(&a);
}

/* Before, a period of -1 or NaN was none; the message told of points in grains. */
static void pores_of_periods_that_cannot_be_are_refused(void **state)
{
    (void)state;
    const double bad[] = {(double)NAN, -1.0, (double)INFINITY};
    const clast_bed bed = {.kind = CLAST_BED_CYLINDER, .radius = 3.0};
    const double z[2] = {0.0, 3.0};
    const double endless[2] = {0.0, (double)INFINITY};
    clast_assembly a = {0};
    clast_pores pores = {0};
    clast_pore_options options = {.n_point = 50, .n_bin = 5};
    with_ball(&a);
    for (int k = 0; k < 9; ++k) {
        options.period[k % 3] = bad[k / 3];
        CHECK_STATUS(clast_pores_measure(&a, &bed, z, &options, &pores), CLAST_E_ARGUMENT);
        assert_non_null(strstr(clast_error_detail(), "period"));
        options.period[k % 3] = 0.0;
    }
    CHECK_STATUS(clast_pores_measure(&a, &bed, endless, &options, &pores), CLAST_E_USAGE);
    CHECK_OK(clast_pores_measure(&a, &bed, z, &options, &pores));
    clast_pores_free(&pores);
    clast_assembly_free(&a);
}

static clast_status make_profile(void *context)
{
    const clast_bed bed = {.kind = CLAST_BED_CYLINDER, .radius = 3.0};
    const clast_porosity_options options = {CLAST_POROSITY_EXACT, 0.1, 0.5, 0.0, false};
    clast_table profile = {0};
    const clast_status status = clast_porosity_profile(context, &bed, &options, &profile);
    clast_table_free(&profile);
    return status;
}

static clast_status measure_parts(void *context)
{
    clast_status status = CLAST_OK;
    const clast_bed bed[2] = {
        {.kind = CLAST_BED_BOX, .is_part = true, .high = {1.0, 1.0}},
        {.kind = CLAST_BED_PERIODIC, .low = {-1.0, -1.0}, .high = {1.0, 1.0}}};
    const clast_porosity_options options = {.layer = 0.1, .cut = 0.5};
    const clast_porosity_bulk bulk = {.z_high = 3.0};
    clast_bed_beyond beyond;
    clast_table profile = {0};
    for (int k = 0; k < 2 && status == CLAST_OK; ++k) {
        status = clast_bed_beyond_measure(&bed[k], context, &bulk, options.method, &beyond);
    }
    if (status == CLAST_OK) {
        status = clast_porosity_profile(context, &bed[0], &options, &profile);
    }
    clast_table_free(&profile);
    return status;
}

/// A window of a lattice of which all is measured that grains alone can tell, as clast porosity
/// does it.
static clast_status measure_window(void *context)
{
    clast_bed bed;
    clast_assembly grains = {0};
    clast_bed_findings found = {0};
    const clast_bed_known known = {.bed = &bed};
    const clast_bed_options options = {
        .porosity = {.cut = 1.0}, .gap = 1e-9, .local = true, .rings = 2, .pores = 50};
    clast_status status = clast_bed_parse("cylinder:0.8,1,1", &bed);
    if (status == CLAST_OK) {
        status = clast_assembly_copy(context, &grains);
    }
    if (status == CLAST_OK) {
        status = clast_bed_measure(&grains, &known, &options, &found);
    }
    clast_bed_findings_free(&found);
    clast_assembly_free(&grains);
    return status;
}

static void a_bed_is_measured_whole_or_not(void **state)
{
    (void)state;
    clast_bed bed;
    clast_assembly a = {0};
    clast_assembly none = {.unit = "model"};
    clast_bed_findings found = {0};
    const clast_bed_known known = {.bed = &bed};
    clast_bed_options options = {.porosity = clast_porosity_options_default(), .gap = 1e-9};
    lattice(&a, 3);
    (void)strcpy(a.unit, "model");
    CHECK_OK(clast_bed_parse("box:0,0,3,3", &bed));
    options.porosity.layer = 0.0; // a tenth of the diameter
    CHECK_OK(clast_bed_measure(&a, &known, &options, &found));
    CHECK_ABS(found.options.porosity.layer, 0.1, 1e-12);
    CHECK_ABS(found.mean_coordination, 4.0, 0.0);
    assert_int_equal(found.beyond.n, 0);
    assert_true(isnan(found.core.porosity) && isnan(found.outside) && found.local.n_column == 0);
    clast_bed_findings_free(&found);
    // of no grain a mean diameter was 1, or of 1 mm
    CHECK_STATUS(clast_bed_measure(&none, &known, &options, &found), CLAST_E_USAGE);
    options.gap = (double)NAN;
    CHECK_STATUS(clast_bed_measure(&a, &known, &options, &found), CLAST_E_ARGUMENT);
    options.gap = 0.0;
    options.chains = true;
    CHECK_STATUS(clast_bed_measure(&a, &known, &options, &found), CLAST_E_USAGE);
    options.chains = false;
    CHECK_OK(clast_bed_parse("box:1,1,2,2", &bed));
    CHECK_STATUS(clast_bed_measure(&a, &known, &options, &found), CLAST_E_GEOMETRY);
    assert_int_equal(found.profile.n_column, 0);
    support_refuse_each_allocation(measure_window, &a);
    clast_assembly_free(&a);
}

static void profile_survives_refused_memory(void **state)
{
    (void)state;
    double centre[2][3] = {{0.0, 0.2, -0.5}, {0.0, 0.0, 0.5}};
    double radius[2] = {1.0, 1.0};
    const clast_spheres spheres = {2, centre, radius};
    const double position[3] = {0.0, 0.0, 1.6};
    clast_shape shape = {0};
    clast_assembly a = {0};
    CHECK_OK(clast_shape_clump("pair", &spheres, &shape));
    one_grain(&shape, position, upright, 1.0, &a);
    support_refuse_each_allocation(make_profile, &a);
    support_refuse_each_allocation(measure_parts, &a);
    clast_assembly_free(&a);
    clast_shape_free(&shape);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sphere_is_cut_into_segments),
        cmocka_unit_test(turned_box_is_halved_and_whole),
        cmocka_unit_test(pyramid_follows_the_cube_law),
        cmocka_unit_test(ellipsoid_agrees_with_its_surface),
        cmocka_unit_test(clump_counts_overlap_once),
        cmocka_unit_test(union_of_discs_has_known_areas),
        cmocka_unit_test(cubic_lattice_has_its_porosity),
        cmocka_unit_test(a_window_of_a_lattice_has_its_porosity),
        cmocka_unit_test(errors_of_balls_that_are_cut_alike_average),
        cmocka_unit_test(what_of_a_bed_lies_outside_another_is_known),
        cmocka_unit_test(images_cover_grains_that_repeat_otherwise),
        cmocka_unit_test(what_lies_below_the_bed_is_of_no_slice),
        cmocka_unit_test(top_lies_where_the_profile_crosses),
        cmocka_unit_test(profile_is_the_same_for_any_threads),
        cmocka_unit_test(beds_are_read_and_written),
        cmocka_unit_test(options_that_cannot_be_are_refused),
        cmocka_unit_test(slabs_that_cannot_be_are_refused),
        cmocka_unit_test(pores_of_periods_that_cannot_be_are_refused),
        cmocka_unit_test(a_bed_is_measured_whole_or_not),
        cmocka_unit_test(profile_survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
