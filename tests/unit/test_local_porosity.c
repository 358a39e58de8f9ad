// Unit: convex cells and radical Voronoi cells against closed forms.
#include "support.h"

#include "geom/convex_cell.h"
#include "math/rng.h"
#include "math/vec3.h"

static const double upright[4] = {1.0, 0.0, 0.0, 0.0};

static void cube_is_cut_to_known_bodies(void **state)
{
    (void)state;
    clx_cell cell = {0};
    const double low[3] = {-1.0, -1.0, -1.0};
    const double high[3] = {1.0, 1.0, 1.0};
    CHECK_OK(clx_cell_box(low, high, &cell));
    CHECK_REL(clx_cell_volume(&cell), 8.0, 1e-15);
    CHECK_REL(clx_cell_reach2(&cell), 3.0, 1e-15);
    // eight corners off: the cuboctahedron (corners in edge middles), 5/6 of the cube
    for (int k = 0; k < 8; ++k) {
        const double normal[3] = {k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0};
        CHECK_OK(clx_cell_cut(&cell, normal, 2.0, k));
    }
    CHECK_REL(clx_cell_volume(&cell), 8.0 * 5.0 / 6.0, 1e-14);
    assert_int_equal(cell.n_face, 14);
    const double all[3] = {0.0, 0.0, 1.0};
    CHECK_OK(clx_cell_cut(&cell, all, 5.0, 99)); // misses
    assert_int_equal(cell.n_face, 14);
    CHECK_OK(clx_cell_cut(&cell, all, -5.0, 99)); // takes everything
    assert_int_equal(cell.n_face, 0);
    CHECK_ABS(clx_cell_volume(&cell), 0.0, 0.0);
    clx_cell_free(&cell);
}

static void add(clast_assembly *a, double x, double y, double z, double radius)
{
    const double p[3] = {x, y, z};
    if (a->n_shape == 0) {
        clast_shape ball = {0};
        CHECK_OK(clast_shape_sphere("ball", 1.0, &ball));
        CHECK_OK(clast_assembly_add_shape(a, &ball, NULL));
        clast_shape_free(&ball);
    }
    CHECK_OK(clast_assembly_add_grain(a, 0, p, upright, radius, 1.0));
}

/// Face-centred cubic, touching spheres: every cell is a rhombic dodecahedron, porosity 0.2595.
static void close_packing_has_twelve_faces_and_its_porosity(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_bed bed;
    clast_table local = {0};
    const double shift[4][3] = {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 0, 0.5}, {0, 0.5, 0.5}};
    for (int k = 0; k < 4 * 64; ++k) {
        const double *s = shift[k % 4];
        add(&a, k / 4 % 4 + s[0] + 0.1, k / 16 % 4 + s[1] + 0.1, k / 64 + s[2] + 0.1,
            sqrt(2.0) / 4.0);
    }
    CHECK_OK(clast_bed_parse("periodic:0,0,4,4", &bed));
    CHECK_OK(clast_porosity_local(&a, &bed, 0.0, 4.0, &local));
    const double *porosity = clast_table_numbers(&local, "porosity");
    const double *faces = clast_table_numbers(&local, "n_face");
    const double *border = clast_table_numbers(&local, "border");
    const double *cell = clast_table_numbers(&local, "cell_m3");
    double sum = 0.0;
    int n_inner = 0;
    for (int64_t i = 0; i < local.n_row; ++i) {
        sum += cell[i];
        if (border[i] == 0.0) {
            CHECK_ABS(porosity[i], 1.0 - CLAST_PI / (3.0 * sqrt(2.0)), 1e-13);
            assert_true(faces[i] >= 12.0);
            ++n_inner;
        }
    }
    assert_true(n_inner >= 128);
    CHECK_REL(sum, 64.0, 1e-13);
    clast_table_free(&local);
    clast_assembly_free(&a);
}

/// Two spheres in a box: the radical plane lies where |x - a|^2 - R^2 = |x - b|^2 - r^2.
static void unequal_spheres_share_by_the_radical_plane(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_bed bed;
    clast_table local = {0};
    add(&a, 1.0, 1.0, 1.0, 0.9);
    add(&a, 3.0, 1.0, 1.0, 0.3);
    CHECK_OK(clast_bed_parse("box:0,0,4,2", &bed));
    CHECK_OK(clast_porosity_local(&a, &bed, 0.0, 2.0, &local));
    const double plane = 1.0 + (4.0 + 0.81 - 0.09) / 4.0;
    CHECK_REL(clast_table_numbers(&local, "cell_m3")[0], 4.0 * plane, 1e-14);
    CHECK_REL(clast_table_numbers(&local, "cell_m3")[1], 4.0 * (4.0 - plane), 1e-14);
    clast_table_free(&local);
    clast_assembly_free(&a);
}

/// The grain whose power distance to a point is least, images included.
static int32_t owner(const clast_assembly *a, const clast_bed *bed, const double x[3])
{
    int32_t best = -1;
    double least = HUGE_VAL;
    for (int32_t i = 0; i < a->n_grain; ++i) {
        double d[3];
        v3_sub(d, x, a->position[i]);
        for (int k = 0; k < 2 && bed->kind == CLAST_BED_PERIODIC; ++k) {
            d[k] -= 2.0 * round(d[k] / 2.0);
        }
        const double power = v3_norm2(d) - a->scale[i] * a->scale[i];
        if (power < least) {
            least = power;
            best = i;
        }
    }
    return best;
}

/// Even points fall into cells by their volumes: chi-squared of the counts within six deviations.
static void check_by_points(const clast_assembly *a, const clast_bed *bed, const clast_table *local)
{
    enum { POINTS = 20000 };
    double count[400] = {0};
    double chi2 = 0.0;
    double n = 0.0;
    for (int k = 0; k < POINTS; ++k) {
        const double x[3] = {2.0 * fmod(0.8191725134 * k, 1.0) - 1.0,
                             2.0 * fmod(0.6710436067 * k, 1.0) - 1.0,
                             3.0 * fmod(0.5497004779 * k, 1.0)};
        if (bed->kind != CLAST_BED_CYLINDER || hypot(x[0], x[1]) < 1.0) {
            count[owner(a, bed, x)] += 1.0;
            n += 1.0;
        }
    }
    for (int64_t i = 0; i < local->n_row; ++i) {
        const int32_t grain = (int32_t)clast_table_numbers(local, "grain")[i];
        const double expected =
            n * clast_table_numbers(local, "cell_m3")[i] / (3.0 * clast_bed_area(bed));
        chi2 += (count[grain] - expected) * (count[grain] - expected) / fmax(expected, 1.0);
    }
    const double free = (double)local->n_row - 1.0;
    assert_true(chi2 < free + 6.0 * sqrt(2.0 * free));
}

/// Random unequal spheres: cells add up to the container, in each kind of bed.
static void cells_fill_the_bed(void **state)
{
    (void)state;
    static const char *const beds[] = {"box:-1,-1,1,1", "periodic:-1,-1,1,1", "cylinder:1"};
    for (int b = 0; b < 3; ++b) {
        clast_assembly a = {0};
        clast_bed bed;
        clast_table local = {0};
        double sum = 0.0;
        for (uint64_t i = 0; i < 400; ++i) {
            double u[4];
            for (int k = 0; k < 4; ++k) {
                u[k] = fmod(
                    0.6180339887498949 * (double)(i * 4 + (uint64_t)k + 1) * (1.0 + 0.37 * k), 1.0);
            }
            u[0] = 2.0 * u[0] - 1.0;
            u[1] = 2.0 * u[1] - 1.0;
            if (b < 2 || hypot(u[0], u[1]) < 0.999) {
                add(&a, u[0], u[1], 3.0 * u[2], 0.01 + 0.1 * u[3] * u[3]);
            }
        }
        CHECK_OK(clast_bed_parse(beds[b], &bed));
        CHECK_OK(clast_porosity_local(&a, &bed, 0.0, 3.0, &local));
        for (int64_t i = 0; i < local.n_row; ++i) {
            sum += clast_table_numbers(&local, "cell_m3")[i];
        }
        CHECK_REL(sum, 3.0 * clast_bed_area(&bed), 1e-12);
        check_by_points(&a, &bed, &local);
        clast_table_free(&local);
        clast_assembly_free(&a);
    }
}

/// A boulder in gravel, 12 : 1, has a cell of hundreds of faces; the command failed whole beyond
/// 200.
static void boulder_in_gravel_has_a_cell(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_bed bed;
    clast_table local = {0};
    const double turn = CLAST_PI * (3.0 - sqrt(5.0)); // Fibonacci points of the sphere
    double sum = 0.0;
    add(&a, 0.0, 0.0, 3.0, 1.2);
    for (int k = 0; k < 600; ++k) {
        const double z = 1.0 - (2.0 * k + 1.0) / 600.0;
        const double r = 1.3 * sqrt(1.0 - z * z);
        add(&a, r * cos(turn * k), r * sin(turn * k), 3.0 + 1.3 * z, 0.1);
    }
    CHECK_OK(clast_bed_parse("box:-3,-3,3,3", &bed));
    CHECK_OK(clast_porosity_local(&a, &bed, 0.0, 6.0, &local));
    for (int64_t i = 0; i < local.n_row; ++i) {
        sum += clast_table_numbers(&local, "cell_m3")[i];
    }
    CHECK_REL(sum, 216.0, 1e-12);
    CHECK_ABS(clast_table_numbers(&local, "n_face")[0], 600.0, 0.0);
    // planes at 1.3 / 2 + (1.44 - 0.01) / 2.6 = 1.2 around it: a little more than the sphere
    const double cell = clast_table_numbers(&local, "cell_m3")[0];
    const double ball = 4.0 / 3.0 * CLAST_PI * 1.2 * 1.2 * 1.2;
    assert_true(cell > ball && cell < 1.02 * ball);
    clast_table_free(&local);
    clast_assembly_free(&a);
}

/// A grain inside of another has no cell: no porosity, where 1 - V / 0 was written.
static void hidden_grain_has_no_porosity(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_bed bed;
    clast_table local = {0};
    add(&a, 1.0, 1.0, 1.0, 0.9);
    add(&a, 1.1, 1.0, 1.0, 0.1);
    CHECK_OK(clast_bed_parse("box:0,0,2,2", &bed));
    CHECK_OK(clast_porosity_local(&a, &bed, 0.0, 2.0, &local));
    CHECK_REL(clast_table_numbers(&local, "cell_m3")[0], 8.0, 1e-14);
    CHECK_ABS(clast_table_numbers(&local, "cell_m3")[1], 0.0, 0.0);
    assert_true(isnan(clast_table_numbers(&local, "porosity")[1]));
    clast_table_free(&local);
    clast_assembly_free(&a);
}

/// A box whose upper images lie half its width farther along x, and the straight one of twice its
/// height that is the same bed; cells of sheared beds ended at a floor and a top.
static void sheared_bed_is_the_straight_one_of_twice_its_height(void **state)
{
    (void)state;
    enum { N = 40 };
    clast_assembly a[2] = {{0}, {0}};
    clast_bed bed[2];
    clast_table local[2] = {{0}, {0}};
    clast_table fields[2] = {{0}, {0}};
    clast_pores pores[2] = {0};
    const double z[2][2] = {{0.0, 3.0}, {0.0, 6.0}};
    double sum = 0.0;
    for (int i = 0; i < N; ++i) {
        const double u[4] = {fmod(0.5 + 0.819 * i, 1.0), fmod(0.5 + 0.671 * i, 1.0),
                             fmod(0.5 + 0.5497 * i, 1.0), 0.25 + 0.005 * i};
        add(&a[0], 4.0 * u[0], 3.0 * u[1], 3.0 * u[2], u[3]);
        add(&a[1], 4.0 * u[0], 3.0 * u[1], 3.0 * u[2], u[3]);
    }
    for (int i = 0; i < N; ++i) {
        const double *x = a[0].position[i];
        add(&a[1], x[0] + (x[0] < 2.0 ? 2.0 : -2.0), x[1], x[2] + 3.0, a[0].scale[i]);
    }
    CHECK_OK(clast_bed_parse("periodic:0,0,0,4,3,3,2", &bed[0]));
    CHECK_OK(clast_bed_parse("periodic:0,0,0,4,3,6", &bed[1]));
    for (int k = 0; k < 2; ++k) {
        clast_pore_options o = {.n_point = 20000, .n_bin = 10};
        (void)clast_bed_period(&bed[k], o.period);
        CHECK_OK(clast_porosity_local(&a[k], &bed[k], z[k][0], z[k][1], &local[k]));
        CHECK_OK(clast_pores_measure(&a[k], &bed[k], z[k], &o, &pores[k]));
        CHECK_OK(clast_bed_fields(&bed[k], &a[k], NULL, NULL, 0.5, &fields[k]));
    }
    for (int i = 0; i < N; ++i) {
        const double cell = clast_table_numbers(&local[0], "cell_m3")[i];
        CHECK_REL(cell, clast_table_numbers(&local[1], "cell_m3")[i], 1e-12);
        CHECK_ABS(clast_table_numbers(&local[0], "border")[i], 0.0, 0.0);
        sum += cell;
    }
    CHECK_REL(sum, 36.0, 1e-12);
    CHECK_ABS(pores[0].porosity, pores[1].porosity, 5e-3);
    CHECK_REL(pores[0].mean, pores[1].mean, 2e-2);
    assert_int_equal(2 * fields[0].n_row, fields[1].n_row);
    for (int64_t k = 0; k < fields[0].n_row; ++k) {
        CHECK_REL(clast_table_numbers(&fields[0], "solid")[k],
                  clast_table_numbers(&fields[1], "solid")[k], 1e-12);
    }
    const double far[3] = {1.0, 1.0, 4.0}; /* above the box: wrapped, half a width along x */
    CHECK_OK(clast_assembly_add_grain(&a[0], 0, far, upright, 0.1, 1.0));
    clast_bed_wrap(&bed[0], &a[0]);
    const double *home = a[0].position[N];
    CHECK_ABS(home[0], 3.0, 0.0);
    CHECK_ABS(home[2], 1.0, 0.0);
    for (int k = 0; k < 2; ++k) {
        clast_table_free(&local[k]);
        clast_table_free(&fields[k]);
        clast_pores_free(&pores[k]);
        clast_assembly_free(&a[k]);
    }
}

static clast_status make_local(void *context)
{
    clast_bed bed;
    clast_table local = {0};
    CHECK_OK(clast_bed_parse("box:0,0,4,2", &bed));
    const clast_status status = clast_porosity_local(context, &bed, 0.0, 2.0, &local);
    clast_table_free(&local);
    return status;
}

static void refused_memory_leaves_nothing(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_bed bed;
    clast_table local = {0};
    add(&a, 1.0, 1.0, 1.0, 0.9);
    add(&a, 3.0, 1.0, 1.0, 0.3);
    support_refuse_each_allocation(make_local, &a);
    CHECK_OK(clast_bed_parse("box:0,0,4,2", &bed));
    CHECK_STATUS(clast_porosity_local(&a, &bed, 5.0, 6.0, &local), CLAST_E_USAGE);
    CHECK_STATUS(clast_porosity_local(&a, &bed, 6.0, 5.0, &local), CLAST_E_USAGE);
    clast_assembly_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cube_is_cut_to_known_bodies),
        cmocka_unit_test(close_packing_has_twelve_faces_and_its_porosity),
        cmocka_unit_test(unequal_spheres_share_by_the_radical_plane),
        cmocka_unit_test(cells_fill_the_bed),
        cmocka_unit_test(boulder_in_gravel_has_a_cell),
        cmocka_unit_test(hidden_grain_has_no_porosity),
        cmocka_unit_test(sheared_bed_is_the_straight_one_of_twice_its_height),
        cmocka_unit_test(refused_memory_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
