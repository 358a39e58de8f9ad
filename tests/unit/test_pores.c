// Unit: radial porosity, the core away from side walls, and pore sizes of arrangements with known
// answers.
#include "support.h"

static const double upright[4] = {1.0, 0.0, 0.0, 0.0};

static void add(clast_assembly *a, const clast_shape *shape, double x, double y, double z)
{
    const double p[3] = {x, y, z};
    if (a->n_shape == 0) {
        CHECK_OK(clast_assembly_add_shape(a, shape, NULL));
    }
    CHECK_OK(clast_assembly_add_grain(a, 0, p, upright, 1.0, 1.0));
}

/// A box of 2 x 2 x 2 on the axis: solid within radius r <= 1 over height 2 is pi r^2 2.
static void box_on_the_axis_is_solid_within(void **state)
{
    (void)state;
    clast_mesh box = {0};
    clast_shape shape = {0};
    clast_assembly a = {0};
    clast_bed bed;
    clast_table radial = {0};
    CHECK_OK(clast_mesh_box(2.0, 2.0, 2.0, &box));
    CHECK_OK(clast_shape_mesh("box", &box, &shape));
    add(&a, &shape, 0.0, 0.0, 1.0);
    CHECK_OK(clast_bed_parse("cylinder:2", &bed));
    const double z[2] = {0.0, 2.0};
    const double none[2] = {2.0, 0.0};
    const clast_radial_options options = {CLAST_POROSITY_EXACT, 4, 20000};
    CHECK_OK(clast_porosity_radial(&a, &bed, z, &options, &radial));
    const double *porosity = clast_table_numbers(&radial, "porosity");
    const double *error = clast_table_numbers(&radial, "porosity_error");
    CHECK_ABS(porosity[0], 0.0, 4.0 * error[0]);
    CHECK_ABS(porosity[1], 0.0, 4.0 * error[1]);
    // between radius 1 and 1.5: the corners, 4 - pi, all within sqrt 2
    CHECK_ABS(porosity[2], 1.0 - (4.0 - CLAST_PI) / (CLAST_PI * 1.25), 4.0 * error[2]);
    CHECK_ABS(porosity[3], 1.0, 0.0);
    clast_table_free(&radial);
    // within 1 it is solid; what lies beyond is no grain at a wall: it made the last ring -0.70
    CHECK_OK(clast_bed_parse("cylinder:1", &bed));
    bed.is_part = true;
    CHECK_OK(clast_porosity_radial(&a, &bed, z, &options, &radial));
    for (int k = 0; k < 4; ++k) {
        CHECK_ABS(clast_table_numbers(&radial, "porosity")[k], 0.0,
                  4.0 * clast_table_numbers(&radial, "porosity_error")[k]);
    }
    clast_table_free(&radial);
    CHECK_STATUS(clast_porosity_radial(&a, &bed, none, &options, &radial), CLAST_E_USAGE);
    CHECK_OK(clast_bed_parse("box:0,0,1,1", &bed));
    CHECK_STATUS(clast_porosity_radial(&a, &bed, z, &options, &radial), CLAST_E_USAGE);
    clast_assembly_free(&a);
    clast_shape_free(&shape);
    clast_mesh_free(&box);
}

/// Bulk and core of an assembly in a bed.
static clast_status core_of(const clast_assembly *a, const char *text, double n_size,
                            clast_porosity_core *core)
{
    clast_bed bed;
    clast_table profile = {0};
    clast_porosity_bulk bulk;
    clast_porosity_options options = clast_porosity_options_default();
    options.layer = 0.5;
    options.cut = 0.999;
    options.at_slice = true;
    CHECK_OK(clast_bed_parse(text, &bed));
    CHECK_OK(clast_porosity_profile(a, &bed, &options, &profile));
    CHECK_OK(clast_porosity_measure(a, &bed, &profile, &options, &bulk));
    const clast_status status = clast_porosity_core_measure(a, &bed, &bulk, n_size, &options, core);
    clast_table_free(&profile);
    return status;
}

/// What is left of a cubic lattice of balls of diameter 1 in a wider box.
static void core_leaves_the_side_out(void **state)
{
    (void)state;
    clast_shape ball = {0};
    clast_assembly a = {0};
    clast_porosity_core core = {0};
    CHECK_OK(clast_shape_sphere("ball", 0.5, &ball));
    for (int k = 0; k < 216; ++k) {
        add(&a, &ball, k % 6 + 0.5, k / 6 % 6 + 0.5, k / 36 + 0.5);
    }
    // The ramp is a layer of balls. Along a side both ball and cell count half; in a corner the
    // lesser of two ramps does: 1/2 - E|x - y| / 2, which is 1/2 - 3 sqrt 2 / 32 of a ball, 1/3 of
    // a cell.
    for (int layer = 0; layer < 2; ++layer) {
        const double cells =
            layer == 0 ? (36.0 + 4.0 * 25.0 + 16.0) / 6.0 : (16.0 + 4.0 * 9.0 + 4.0) / 6.0;
        const double corners = 4.0 * (0.5 - 3.0 * sqrt(2.0) / 32.0 - 1.0 / 3.0) / cells;
        CHECK_OK(core_of(&a, "box:-2,-2,8,8", 2.5 + layer, &core));
        CHECK_ABS(core.porosity, 1.0 - CLAST_PI / 6.0 * (1.0 + corners), 2e-4);
        assert_true(core.error > 0.0 && core.error < 1e-3);
        CHECK_ABS(core.share, 1.0 - 0.36 * CLAST_PI / 6.0 - core.porosity, 1e-12);
    }
    CHECK_OK(core_of(&a, "box:-2,-2,8,8", 1.5, &core)); // before the balls: an empty ring's share
    CHECK_ABS(core.porosity, 1.0 - 36.0 / ((64.0 + 4.0 * 49.0 + 36.0) / 6.0) * CLAST_PI / 6.0,
              1e-12);
    CHECK_ABS(core.error, 0.0, 0.0);
    CHECK_STATUS(core_of(&a, "box:-2,-2,8,8", 4.5, &core), CLAST_E_GEOMETRY);
    CHECK_STATUS(core_of(&a, "box:-2,-2,8,8", 0.4, &core), CLAST_E_USAGE);
    CHECK_STATUS(core_of(&a, "periodic:0,0,6,6", 1.0, &core), CLAST_E_USAGE);
    clast_assembly_free(&a);
    clast_shape_free(&ball);
}

/// A box of 2 x 2 x 2 in a cylinder of radius 5: its corners are within sqrt 2 of the axis.
static void core_of_a_cylinder_is_round(void **state)
{
    (void)state;
    clast_mesh box = {0};
    clast_shape shape = {0};
    clast_assembly a = {0};
    clast_porosity_core core = {0};
    CHECK_OK(clast_mesh_box(2.0, 2.0, 2.0, &box));
    CHECK_OK(clast_shape_mesh("box", &box, &shape));
    add(&a, &shape, 0.0, 0.0, 1.0);
    const double size = cbrt(6.0 / CLAST_PI * 8.0);
    const double low = 2.0; // the ramp: from 2 to 2 + size around the axis
    const double high = low + size;
    CHECK_OK(core_of(&a, "cylinder:5", (5.0 - 0.5 * (low + high)) / size, &core));
    const double area = CLAST_PI / 3.0 * (low * low + low * high + high * high);
    CHECK_ABS(core.porosity, 1.0 - 4.0 / area, 1e-12);
    CHECK_ABS(core.error, 0.0, 0.0);
    clast_assembly_free(&a);
    clast_shape_free(&shape);
    clast_mesh_free(&box);
}

static void side_walls_are_told_in_grain_sizes(void **state)
{
    (void)state;
    clast_shape ball = {0};
    clast_assembly a = {0};
    clast_bed bed;
    CHECK_OK(clast_shape_sphere("ball", 0.5, &ball));
    add(&a, &ball, 0.0, 0.0, 0.0);
    const double p[3] = {3.0, 0.0, 0.0};
    CHECK_OK(clast_assembly_add_grain(&a, 0, p, upright, 2.0, 1.0));
    CHECK_OK(clast_bed_parse("cylinder:5", &bed));
    clast_bed_walls walls = clast_bed_side_walls(&bed, &a);
    CHECK_REL(walls.size, 17.0 / 9.0, 1e-14); // diameters 1 and 2, volumes 1 and 8
    CHECK_REL(walls.ratio, 5.0 * 9.0 / 17.0, 1e-14);
    CHECK_OK(clast_bed_parse("box:0,0,6,3", &bed));
    CHECK_REL(clast_bed_side_walls(&bed, &a).radius, 2.0, 1e-14);
    CHECK_OK(clast_bed_parse("periodic:0,0,6,3", &bed));
    walls = clast_bed_side_walls(&bed, &a);
    assert_true(isinf(walls.radius) && isinf(walls.ratio));
    clast_assembly_free(&a);
    clast_shape_free(&ball);
}

/// Periodic lattice of touching spheres: porosity 1 - pi / 6, largest pore in the cell's corner.
static void lattice_has_its_pores(void **state)
{
    (void)state;
    clast_shape ball = {0};
    clast_assembly a = {0};
    clast_bed bed;
    clast_pores pores = {0};
    const double slab[2] = {1.0, 4.0};
    const clast_pore_options options = {.n_point = 20000, .n_bin = 20, .period = {3.0, 3.0}};
    CHECK_OK(clast_shape_sphere("ball", 0.5, &ball));
    for (int k = 0; k < 45; ++k) {
        add(&a, &ball, k % 3 + 0.5, k / 3 % 3 + 0.5, k / 9 + 0.5);
    }
    CHECK_OK(clast_bed_parse("periodic:0,0,3,3", &bed));
    CHECK_OK(clast_pores_measure(&a, &bed, slab, &options, &pores));
    CHECK_ABS(pores.porosity, 1.0 - CLAST_PI / 6.0, 4.0 * sqrt(0.25 / 20000.0));
    // An independent mean: midpoints of a grid of 60^3 in an eighth of the cell.
    double sum = 0.0;
    double count = 0.0;
    for (int k = 0; k < 60 * 60 * 60; ++k) {
        const double x = (k % 60 + 0.5) / 120.0;
        const double y = (k / 60 % 60 + 0.5) / 120.0;
        const double z = (k / 3600 + 0.5) / 120.0;
        const double d = sqrt(x * x + y * y + z * z) - 0.5;
        sum += d > 0.0 ? d : 0.0;
        count += d > 0.0 ? 1.0 : 0.0;
    }
    CHECK_ABS(pores.mean, sum / count, 4.0 * 0.07 / sqrt(0.4764 * 20000.0));
    const double largest = clast_table_numbers(&pores.sizes, "delta_high_m")[19];
    assert_true(largest <= 0.5 * (sqrt(3.0) - 1.0) + 1e-12 && largest > 0.34);
    CHECK_ABS(clast_table_numbers(&pores.sizes, "share_smaller")[19], 1.0, 0.0);
    clast_pores_free(&pores);
    clast_assembly_free(&a);
    clast_shape_free(&ball);
}

typedef struct {
    clast_assembly assembly;
    clast_bed bed;
} scene;

static clast_status make_both(void *context)
{
    scene *s = context;
    clast_pores pores = {0};
    clast_table radial = {0};
    const double z[2] = {0.0, 1.0};
    const clast_pore_options options = {.n_point = 50, .n_bin = 5};
    const clast_radial_options rings = {CLAST_POROSITY_SPHERES, 3, 10};
    clast_status status = clast_pores_measure(&s->assembly, &s->bed, z, &options, &pores);
    if (status == CLAST_OK) {
        status = clast_porosity_radial(&s->assembly, &s->bed, z, &rings, &radial);
    }
    if (status == CLAST_OK) {
        const clast_porosity_options exact = clast_porosity_options_default();
        const clast_porosity_bulk bulk = {.z_high = 1.0};
        clast_porosity_core core;
        status = clast_porosity_core_measure(&s->assembly, &s->bed, &bulk, 0.5, &exact, &core);
    }
    clast_pores_free(&pores);
    clast_table_free(&radial);
    return status;
}

static void refused_memory_leaves_nothing(void **state)
{
    (void)state;
    scene s = {0};
    clast_shape ball = {0};
    CHECK_OK(clast_shape_sphere("ball", 0.5, &ball));
    add(&s.assembly, &ball, 0.0, 0.0, 0.5);
    CHECK_OK(clast_bed_parse("cylinder:2", &s.bed));
    support_refuse_each_allocation(make_both, &s);
    clast_assembly_free(&s.assembly);
    clast_shape_free(&ball);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(box_on_the_axis_is_solid_within),
        cmocka_unit_test(core_leaves_the_side_out),
        cmocka_unit_test(core_of_a_cylinder_is_round),
        cmocka_unit_test(side_walls_are_told_in_grain_sizes),
        cmocka_unit_test(lattice_has_its_pores),
        cmocka_unit_test(refused_memory_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
