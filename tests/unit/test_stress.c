/* Unit: Love-Weber stress of a column at rest, means of realisations, porosity inside a surface. */
#include "support.h"

#include "dem_scenes.h"
#include <clast/porosity.h>

static const double RADIUS = 4e-3;
static const double DENSITY = 2650.0;
static const double WIDTH = 0.02;

/// Three balls on top of each other on a floor, at rest, in a periodic box.
static clast_dem *column(void)
{
    clast_dem_config c = scene_physics();
    clast_shape ball = {0};
    clast_dem_grain g[3] = {{0}};
    c.domain = CLAST_DEM_PERIODIC;
    c.width = WIDTH;
    for (int i = 0; i < 3; ++i) {
        g[i] = (clast_dem_grain){.scale = 1.0, .density = DENSITY, .orientation = {1.0}};
        g[i].position[2] = (2 * i + 1) * RADIUS;
    }
    CHECK_OK(scene_body(SCENE_BALL, &ball));
    clast_dem *dem = scene_bodies(&c, &ball, 3, g);
    assert_non_null(dem);
    clast_dem_set_drive(dem, &(clast_dem_drive){0.0, 1.0, 1e-30});
    CHECK_OK(clast_dem_step(dem, 30000));
    clast_shape_free(&ball);
    return dem;
}

/* Every height carries the weight of the centres above it, so between centres stress_zz is a whole
 * number of weights over the area: in slices of one radius 3, 2, 2, 1, 1, 0. */
static void column_carries_its_weight(void **state)
{
    (void)state;
    clast_dem *dem = column();
    clast_table contacts = {0};
    clast_table profile = {0};
    clast_table stress = {0};
    clast_table bulk = {0};
    clast_assembly a = {0};
    const clast_bed bed = {.kind = CLAST_BED_PERIODIC,
                           .low = {-0.5 * WIDTH, -0.5 * WIDTH},
                           .high = {0.5 * WIDTH, 0.5 * WIDTH}};
    clast_porosity_options o = clast_porosity_options_default();
    o.layer = RADIUS;
    CHECK_OK(clast_dem_contact_table(dem, &contacts));
    assert_int_equal(contacts.n_row, 3);
    CHECK_OK(clast_dem_assembly(dem, &a));
    CHECK_OK(clast_porosity_profile(&a, &bed, &o, &profile));
    CHECK_OK(clast_stress_profile(&contacts, &bed, &profile, &stress));
    const double weight =
        4.0 / 3.0 * CLAST_PI * RADIUS * RADIUS * RADIUS * (DENSITY - 1000.0) * 9.81;
    const double unit = weight / (WIDTH * WIDTH);
    const double expected[6] = {3.0, 2.0, 2.0, 1.0, 1.0, 0.0};
    const double *zz = clast_table_numbers(&stress, "stress_zz_Pa");
    const double *xx = clast_table_numbers(&stress, "stress_xx_Pa");
    for (int k = 0; k < 6; ++k) {
        /* centres lie an overlap (5e-8 m of 4e-3) below the slices' borders */
        CHECK_ABS(zz[k], expected[k] * unit, 4e-5 * unit);
        CHECK_ABS(xx[k], 0.0, 1e-9 * unit);
    }
    const double z[2] = {0.0, 6.0 * RADIUS};
    CHECK_OK(clast_stress(&contacts, &bed, z, &bulk));
    CHECK_REL(bulk.column[1].number[2], 9.0 / 6.0 * unit, 4e-5);
    clast_table_free(&contacts);
    clast_table_free(&profile);
    clast_table_free(&stress);
    clast_table_free(&bulk);
    clast_assembly_free(&a);
    clast_dem_destroy(dem);
}

/* A lattice pressed along z carries the same stress at all heights of a box that repeats: contacts
 * across the border were left out of the bulk and piled on the end slices of the profile. The last
 * slice is thinner than the others, which once took their contacts from the wrong slices. */
static void stress_goes_through_a_periodic_border(void **state)
{
    (void)state;
    enum { LAYERS = 4 };
    static const char *const name[] = {"a",          "b",         "centre_z_m", "x_m",
                                       "y_m",        "z_m",       "branch_x_m", "branch_y_m",
                                       "branch_z_m", "force_x_N", "force_y_N",  "force_z_N"};
    clast_table contacts = {0};
    clast_table profile = {0};
    clast_table out = {0};
    double *column[12];
    const clast_bed bed = {
        .kind = CLAST_BED_PERIODIC_3D, .high = {1.0, 1.0}, .floor = -0.5, .ceiling = 3.5};
    const double edge[] = {-0.5, 0.9, 2.3, 3.5};
    CHECK_OK(clast_table_init(&contacts, "contacts", LAYERS));
    for (int k = 0; k < 12; ++k) {
        CHECK_OK(clast_table_add_number(&contacts, name[k], "-", &column[k]));
    }
    for (int i = 0; i < LAYERS; ++i) { /* the second and the last from above, in other images */
        const double up = i % 2 == 0 ? 1.0 : -1.0;
        column[2][i] = (up > 0.0 ? i : i + 1) + 4.0 * (i - 1);
        column[8][i] = up;
        column[11][i] = 7.0 * up;
    }
    CHECK_OK(clast_table_init(&profile, "profile", 3));
    CHECK_OK(clast_table_add_number(&profile, "z_low_m", "m", &column[0]));
    CHECK_OK(clast_table_add_number(&profile, "z_high_m", "m", &column[1]));
    for (int k = 0; k < 3; ++k) {
        column[0][k] = edge[k];
        column[1][k] = edge[k + 1];
    }
    CHECK_OK(clast_stress_profile(&contacts, &bed, &profile, &out));
    for (int k = 0; k < 3; ++k) {
        CHECK_REL(clast_table_numbers(&out, "stress_zz_Pa")[k], 7.0, 1e-14);
    }
    clast_table_free(&out);
    const double whole[2] = {-0.5, 3.5};
    const double part[2] = {3.0, 3.4};
    const double more[2] = {0.0, 4.1};
    CHECK_OK(clast_stress(&contacts, &bed, whole, &out));
    CHECK_REL(out.column[1].number[2], 7.0, 1e-14);
    clast_table_free(&out);
    CHECK_OK(clast_stress(&contacts, &bed, part, &out));
    CHECK_REL(out.column[1].number[2], 7.0, 1e-13);
    clast_table_free(&out);
    CHECK_STATUS(clast_stress(&contacts, &bed, more, &out), CLAST_E_USAGE);
    const clast_bed window = {.kind = CLAST_BED_BOX, .is_part = true, .high = {1.0, 1.0}};
    CHECK_STATUS(clast_stress(&contacts, &window, whole, &out), CLAST_E_USAGE);
    CHECK_STATUS(clast_stress_profile(&contacts, &window, &profile, &out), CLAST_E_USAGE);
    contacts.column[8].number[0] = 1e300;
    CHECK_STATUS(clast_stress(&contacts, &bed, whole, &out), CLAST_E_FORMAT);
    clast_table_free(&contacts);
    clast_table_free(&profile);
}

/* Student 1908: t(0.975, 2) = 4.30265. */
static void mean_has_its_interval(void **state)
{
    (void)state;
    const double value[3] = {1.0, 2.0, 3.0};
    const clast_mean m = clast_mean_of(3, value);
    CHECK_REL(m.mean, 2.0, 1e-15);
    CHECK_REL(m.deviation, 1.0, 1e-15);
    CHECK_REL(m.high - m.mean, 4.30265272991 / sqrt(3.0), 1e-9);
    CHECK_REL(m.mean - m.low, 4.30265272991 / sqrt(3.0), 1e-9);
    assert_true(isnan(clast_mean_of(1, value).low));
}

/* One ball in a box and the same box as an open surface: the porosity of every slice is equal. */
static void inside_of_a_surface_is_a_bed(void **state)
{
    (void)state;
    clast_assembly a = {.unit = "m"};
    clast_shape ball = {0};
    clast_mesh box = {0};
    clast_mesh closed = {0};
    clast_table in_box = {0};
    clast_table in_surface = {0};
    clast_porosity_bulk one;
    clast_porosity_bulk other;
    const double at[3] = {5e-3, 5e-3, 5e-3};
    CHECK_OK(scene_body(SCENE_BALL, &ball));
    CHECK_OK(clast_assembly_add_shape(&a, &ball, NULL));
    CHECK_OK(clast_assembly_add_grain(&a, 0, at, (const double[4]){1.0, 0.0, 0.0, 0.0}, 1.0, 1.0));
    CHECK_OK(clast_mesh_box(0.01, 0.01, 0.02, &box));
    box.n_tri -= 1; /* a hole, which is covered */
    CHECK_OK(clast_bed_close(&box, &closed));
    CHECK_REL(clast_mesh_volume(&closed), 2e-6, 1e-12);
    const clast_bed bed = {.kind = CLAST_BED_BOX, .high = {0.01, 0.01}};
    const clast_bed surface = clast_bed_of_surface(&closed);
    clast_porosity_options o = clast_porosity_options_default();
    CHECK_OK(clast_porosity_profile(&a, &bed, &o, &in_box));
    CHECK_OK(clast_porosity_profile(&a, &surface, &o, &in_surface));
    assert_int_equal(in_box.n_row, in_surface.n_row);
    for (int64_t k = 0; k < in_box.n_row; ++k) {
        CHECK_ABS(clast_table_numbers(&in_surface, "porosity")[k],
                  clast_table_numbers(&in_box, "porosity")[k], 1e-12);
    }
    o.cut = 0.8;
    CHECK_OK(clast_porosity_measure(&a, &bed, &in_box, &o, &one));
    CHECK_OK(clast_porosity_measure(&a, &surface, &in_surface, &o, &other));
    CHECK_REL(other.porosity, one.porosity, 1e-12);
    box.n_tri = 1; /* a triangle encloses nothing */
    clast_mesh_free(&closed);
    CHECK_STATUS(clast_bed_close(&box, &closed), CLAST_E_GEOMETRY);
    clast_table_free(&in_box);
    clast_table_free(&in_surface);
    clast_mesh_free(&box);
    clast_shape_free(&ball);
    clast_assembly_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(column_carries_its_weight),
        cmocka_unit_test(stress_goes_through_a_periodic_border),
        cmocka_unit_test(mean_has_its_interval),
        cmocka_unit_test(inside_of_a_surface_is_a_bed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
