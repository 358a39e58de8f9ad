/* Unit: grains joined by necks become one closed body of the right volume. */
#include "support.h"

#include "geom/isosurface.h"
#include <clast/assembly.h>
#include <stdio.h>
#include <string.h>

static const double upright[4] = {1.0, 0.0, 0.0, 0.0};

/* Two tangent unit spheres along x; the second may be a finely divided mesh of one. */
static void make_pair(clast_assembly *pair, bool as_mesh, double gap)
{
    clast_shape sphere = {0};
    clast_shape other = {0};
    clast_mesh mesh = {0};
    const double one[3] = {1.0, 1.0, 1.0};
    const double at[2][3] = {{0.0, 0.0, 0.0}, {2.0 + gap, 0.0, 0.0}};
    const double touch[3] = {1.0 + 0.5 * gap, 0.0, 0.0};
    int32_t id = 0;
    CHECK_OK(clast_shape_sphere("ball", 1.0, &sphere));
    CHECK_OK(clast_assembly_add_shape(pair, &sphere, &id));
    CHECK_OK(clast_assembly_add_grain(pair, id, at[0], upright, 1.0, 2500.0));
    if (as_mesh) {
        CHECK_OK(clast_mesh_ellipsoid(one, 4, &mesh));
        CHECK_OK(clast_shape_mesh("facets", &mesh, &other));
        CHECK_OK(clast_assembly_add_shape(pair, &other, &id));
    }
    CHECK_OK(clast_assembly_add_grain(pair, id, at[1], upright, 1.0, 2500.0));
    CHECK_OK(clast_assembly_add_contact(pair, 0, 1, touch));
    clast_shape_free(&sphere);
    clast_shape_free(&other);
    clast_mesh_free(&mesh);
}

/* A ball of radius r at the contact of two unit spheres adds itself less two lenses; lens of unit
   sphere and ball whose centre lies on it: d = 1, V = pi (1 + r - d)^2 (d^2 + 2 d r - 3 r^2 + 2 d -
   3 + 6 r) / (12 d). */
static double neck_volume(double r)
{
    const double lens =
        CLAST_PI * r * r * (1.0 + 2.0 * r - 3.0 * r * r + 2.0 - 3.0 + 6.0 * r) / 12.0;
    return 4.0 * CLAST_PI / 3.0 * r * r * r - 2.0 * lens;
}

static void tangent_spheres_become_one_body(void **state)
{
    (void)state;
    for (int as_mesh = 0; as_mesh < 2; ++as_mesh) {
        clast_assembly pair = {0};
        clast_mesh mesh = {0};
        clast_printable_report report;
        const clast_printable_config config = {.neck = 0.4, .spacing = 0.05};
        make_pair(&pair, as_mesh == 1, 0.0);
        CHECK_OK(clast_assembly_printable(&pair, &config, NULL, &mesh, &report));
        clast_printable_report plan;
        CHECK_OK(clast_assembly_printable_plan(&pair, &config, &plan));
        assert_true(plan.neck == report.neck && plan.spacing == report.spacing);
        CHECK_REL((double)plan.n_triangle_expected, (double)mesh.n_tri, 0.3);
        assert_int_equal(report.n_part, 1);
        assert_int_equal(report.n_void, 0);
        assert_int_equal(mesh.n_vert - mesh.n_tri / 2, 2);
        const double expected = clast_assembly_volume(&pair) + neck_volume(0.2);
        CHECK_REL(report.volume, expected, 3e-3);
        CHECK_REL(report.smallest_feature, 0.4, 1e-15);
        clast_mesh_free(&mesh);
        clast_assembly_free(&pair);
    }
}

static void a_neck_too_thin_for_the_gap_is_refused(void **state)
{
    (void)state;
    clast_assembly pair = {0};
    clast_mesh mesh = {0};
    clast_printable_report report;
    const clast_printable_config config = {.neck = 0.2, .spacing = 0.05};
    make_pair(&pair, false, 0.5);
    CHECK_STATUS(clast_assembly_printable(&pair, &config, NULL, &mesh, &report), CLAST_E_GEOMETRY);
    assert_non_null(
        strstr(clast_error_detail(), "3 pieces with necks of 200 mm sampled at 50 mm;"));
    assert_null(mesh.vert);
    clast_assembly_free(&pair);
}

/* Two balls of 8 m^3 came out as one of 4188. */
static void a_neck_that_would_be_the_body_is_refused(void **state)
{
    (void)state;
    clast_assembly pair = {0};
    clast_mesh mesh = {0};
    clast_printable_report report;
    clast_printable_config config = {.neck = 20.0, .spacing = 0.1};
    make_pair(&pair, false, 0.0);
    CHECK_STATUS(clast_assembly_printable(&pair, &config, NULL, &mesh, &report), CLAST_E_USAGE);
    assert_non_null(strstr(clast_error_detail(), "a neck of 20 m is thicker than every grain"));
    config.neck = 1.0;
    CHECK_OK(clast_assembly_printable_plan(&pair, &config, &report));
    clast_assembly_free(&pair);
}

/* "use a thicker neck or a finer spacing" was said of grains that no neck joins, too. */
static void grains_without_a_contact_are_told_as_such(void **state)
{
    (void)state;
    clast_assembly three = {0};
    clast_mesh mesh = {0};
    clast_printable_report report;
    clast_printable_config config = {.neck = 0.4, .spacing = 0.1};
    const double away[3] = {8.0, 0.0, 0.0};
    make_pair(&three, false, 0.0);
    CHECK_OK(clast_assembly_add_grain(&three, 0, away, upright, 1.0, 2500.0));
    CHECK_STATUS(clast_assembly_printable(&three, &config, NULL, &mesh, &report), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(),
                           "the 3 grains are 2 groups without a contact between them, which no "
                           "neck joins"));
    config.spacing = 1e-4;
    CHECK_STATUS(clast_assembly_printable_plan(&three, &config, &report), CLAST_E_LIMIT);
    assert_non_null(strstr(clast_error_detail(), "a spacing of 100 um on a body of extent 10 m"));
    config.spacing = 6.0;
    CHECK_STATUS(clast_assembly_printable_plan(&three, &config, &report), CLAST_E_USAGE);
    assert_non_null(
        strstr(clast_error_detail(), "a spacing of 6 m cannot show a body of extent 10 m"));
    (void)snprintf(three.unit, sizeof three.unit, "model");
    CHECK_STATUS(clast_assembly_printable_plan(&three, &config, &report), CLAST_E_USAGE);
    assert_non_null(strstr(clast_error_detail(), "a spacing of 6 cannot show a body of extent 10"));
    clast_assembly_free(&three);
}

static void a_closed_void_is_filled_or_kept(void **state)
{
    (void)state;
    clast_assembly shell = {0};
    clast_shape bubble = {0};
    clast_mesh outer = {0};
    clast_mesh inner = {0};
    const double big[3] = {1.0, 1.0, 1.0};
    const double small[3] = {0.5, 0.5, 0.5};
    const double origin[3] = {0.0, 0.0, 0.0};
    int32_t id = 0;
    CHECK_OK(clast_mesh_ellipsoid(big, 3, &outer));
    CHECK_OK(clast_mesh_ellipsoid(small, 3, &inner));
    for (int32_t t = 0; t < inner.n_tri; ++t) { /* inside out: a void */
        const int32_t first = inner.tri[t][0];
        inner.tri[t][0] = inner.tri[t][1];
        inner.tri[t][1] = first;
    }
    CHECK_OK(clast_mesh_append(&outer, &inner));
    CHECK_OK(clast_shape_mesh("bubble", &outer, &bubble));
    CHECK_OK(clast_assembly_add_shape(&shell, &bubble, &id));
    CHECK_OK(clast_assembly_add_grain(&shell, id, origin, upright, 1.0, 2500.0));
    for (int keep = 0; keep < 2; ++keep) {
        clast_mesh mesh = {0};
        clast_printable_report report;
        const clast_printable_config config = {.spacing = 0.05, .keep_voids = keep == 1};
        CHECK_OK(clast_assembly_printable(&shell, &config, NULL, &mesh, &report));
        assert_int_equal(report.n_void, 1);
        CHECK_REL(report.void_volume, 4.0 * CLAST_PI / 3.0 / 8.0, 0.05);
        CHECK_REL(report.volume, 4.0 * CLAST_PI / 3.0 * (keep == 1 ? 0.875 : 1.0), 0.02);
        clast_mesh_free(&mesh);
    }
    clast_shape_free(&bubble);
    clast_mesh_free(&outer);
    clast_mesh_free(&inner);
    clast_assembly_free(&shell);
}

static void the_same_bytes_for_any_thread_count(void **state)
{
    (void)state;
    clast_assembly pair = {0};
    clast_mesh mesh[3] = {{0}};
    clast_printable_report report;
    const clast_printable_config config = {.neck = 0.4, .spacing = 0.1};
    make_pair(&pair, true, 0.0);
    for (int i = 0; i < 3; ++i) {
        clast_parallel_set_threads(1 << i);
        CHECK_OK(clast_assembly_printable(&pair, &config, NULL, &mesh[i], &report));
        assert_int_equal(mesh[i].n_vert, mesh[0].n_vert);
        assert_memory_equal(mesh[i].vert, mesh[0].vert,
                            (size_t)mesh[0].n_vert * sizeof *mesh[0].vert);
    }
    for (int i = 0; i < 3; ++i) {
        clast_mesh_free(&mesh[i]);
    }
    clast_assembly_free(&pair);
}

static clast_status make(void *context)
{
    clast_mesh mesh = {0};
    clast_printable_report report;
    const clast_printable_config config = {.neck = 0.6, .spacing = 0.25};
    const clast_status status = clast_assembly_printable(context, &config, NULL, &mesh, &report);
    clast_mesh_free(&mesh);
    return status;
}

static void survives_refused_memory(void **state)
{
    (void)state;
    clast_assembly pair = {0};
    clast_parallel_set_threads(1);
    make_pair(&pair, false, 0.0);
    support_refuse_each_allocation(make, &pair);
    clast_assembly_free(&pair);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tangent_spheres_become_one_body),
        cmocka_unit_test(a_neck_that_would_be_the_body_is_refused),
        cmocka_unit_test(a_neck_too_thin_for_the_gap_is_refused),
        cmocka_unit_test(grains_without_a_contact_are_told_as_such),
        cmocka_unit_test(a_closed_void_is_filled_or_kept),
        cmocka_unit_test(the_same_bytes_for_any_thread_count),
        cmocka_unit_test(survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
