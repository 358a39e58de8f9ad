/* Unit: coarse-grained fields and force chains against closed forms. */
#include "support.h"

#include "dem_scenes.h"
#include <clast/assembly.h>
#include <clast/porosity.h>
#include <clast/table.h>

enum { N_BALL = 3 };

static const double RADIUS = 4e-3;
static const double DENSITY = 2650.0;
static const double WIDTH = 0.02;

/* A column of balls at rest on a floor, in a periodic box. */
static clast_dem *column(void)
{
    clast_dem_config c = scene_physics();
    clast_shape ball = {0};
    clast_dem_grain g[N_BALL] = {{0}};
    c.domain = CLAST_DEM_PERIODIC;
    c.width = WIDTH;
    for (int i = 0; i < N_BALL; ++i) {
        g[i] = (clast_dem_grain){.scale = 1.0, .density = DENSITY, .orientation = {1.0}};
        g[i].position[2] = (2 * i + 1) * RADIUS;
    }
    CHECK_OK(scene_body(SCENE_BALL, &ball));
    clast_dem *dem = scene_bodies(&c, &ball, N_BALL, g);
    assert_non_null(dem);
    clast_dem_set_drive(dem, &(clast_dem_drive){0.0, 1.0, 1e-30});
    CHECK_OK(clast_dem_step(dem, 30000));
    clast_shape_free(&ball);
    return dem;
}

/* Mean over [low, high] of the share of a Gaussian about x that lies below a height. */
static double mean_below(double x, double width, double low, double high)
{
    double sum = 0.0;
    for (int side = 0; side < 2; ++side) {
        const double u = ((side == 1 ? high : low) - x) / width;
        const double bell = exp(-0.5 * u * u) / sqrt(2.0 * CLAST_PI);
        sum += (side == 1 ? 1.0 : -1.0) * (u * (0.5 + 0.5 * erf(u / sqrt(2.0))) + bell);
    }
    return width * sum / (high - low);
}

static double column_sum(const clast_table *t, const char *name)
{
    double sum = 0.0;
    const double *x = clast_table_numbers(t, name);
    const double *side[3] = {clast_table_numbers(t, "dx_m"), clast_table_numbers(t, "dy_m"),
                             clast_table_numbers(t, "dz_m")};
    assert_non_null(x);
    for (int64_t k = 0; k < t->n_row; ++k) {
        sum += x[k] * side[0][k] * side[1][k] * side[2][k];
    }
    return sum;
}

/* Over each layer of cells the mean stress is that of the weights above, smoothed by the kernel,
 * down to the floor and below it: the branch of the lowest ball ends in its contact, not in a
 * mirror ball. */
static void column_is_exact_at_its_floor(void **state)
{
    (void)state;
    clast_dem *dem = column();
    clast_table contacts = {0};
    clast_table fields = {0};
    clast_assembly a = {0};
    const clast_bed bed = {.kind = CLAST_BED_PERIODIC,
                           .low = {-0.5 * WIDTH, -0.5 * WIDTH},
                           .high = {0.5 * WIDTH, 0.5 * WIDTH}};
    const double w = 0.6 * RADIUS;
    CHECK_OK(clast_dem_contact_table(dem, &contacts));
    CHECK_OK(clast_dem_assembly(dem, &a));
    CHECK_OK(clast_bed_fields(&bed, &a, &contacts, NULL, w, &fields));
    const double volume = 4.0 / 3.0 * CLAST_PI * RADIUS * RADIUS * RADIUS;
    const double weight = volume * (DENSITY - 1000.0) * 9.81;
    CHECK_REL(column_sum(&fields, "density_kg/m^3"), N_BALL * volume * DENSITY, 1e-13);
    CHECK_REL(column_sum(&fields, "solid"), N_BALL * volume, 1e-13);
    CHECK_REL(column_sum(&fields, "wall_force_z_N/m^3"), N_BALL * weight, 1e-6);
    double virial = 0.0;
    for (int64_t k = 0; k < contacts.n_row; ++k) {
        virial += clast_table_numbers(&contacts, "force_z_N")[k] *
                  clast_table_numbers(&contacts, "branch_z_m")[k];
    }
    CHECK_REL(column_sum(&fields, "stress_zz_Pa"), virial, 1e-12);
    const double *z = clast_table_numbers(&fields, "z_m");
    const double *zz = clast_table_numbers(&fields, "stress_zz_Pa");
    int64_t n_layer = 1; /* cells of a layer */
    while (z[n_layer] == z[0]) {
        ++n_layer;
    }
    for (int64_t first = 0; first < fields.n_row; first += n_layer) {
        double mean = 0.0;
        for (int64_t k = first; k < first + n_layer; ++k) {
            mean += zz[k] / (double)n_layer;
        }
        double expected = 0.0;
        for (int i = 0; i < N_BALL;
             ++i) { /* a branch ends a diameter lower, the lowest in the floor */
            const double top = a.position[i][2];
            const double bottom = i > 0 ? a.position[i - 1][2] : 0.0;
            const double low = z[first] - 0.5 * w;
            const double high = z[first] + 0.5 * w;
            expected += (N_BALL - i) * weight / (WIDTH * WIDTH) *
                        (mean_below(bottom, w, low, high) - mean_below(top, w, low, high));
        }
        /* overlaps are 2e-5 of the kernel's width, the cut-off leaves out 6e-7 */
        CHECK_ABS(mean, expected, 1e-5 * N_BALL * weight / (WIDTH * WIDTH));
    }
    clast_table_free(&contacts);
    clast_table_free(&fields);
    clast_assembly_free(&a);
    clast_dem_destroy(dem);
}

static void add_balls(clast_assembly *a, int n, double step)
{
    clast_shape ball = {0};
    CHECK_OK(clast_shape_sphere("ball", 1.0, &ball));
    CHECK_OK(clast_assembly_add_shape(a, &ball, NULL));
    for (int i = 0; i < n; ++i) {
        CHECK_OK(clast_assembly_add_grain(a, 0, (const double[3]){(i + 0.5) * step, 0.5, 0.5},
                                          (const double[4]){1.0, 0.0, 0.0, 0.0}, 0.5, 2.0 + i));
    }
    clast_shape_free(&ball);
}

/* Momentum and sum m v v are kept, across the borders of a periodic box too. */
static void motion_adds_up(void **state)
{
    (void)state;
    static const char *const name[3] = {"velocity_x_m/s", "velocity_y_m/s", "velocity_z_m/s"};
    clast_assembly a = {0};
    clast_table velocities = {0};
    clast_table fields = {0};
    double momentum = 0.0;
    double motion = 0.0;
    add_balls(&a, 3, 1.0);
    CHECK_OK(clast_table_init(&velocities, "velocities", 3));
    for (int k = 0; k < 3; ++k) {
        double *v = NULL;
        CHECK_OK(clast_table_add_number(&velocities, name[k], "m/s", &v));
        for (int i = 0; i < 3; ++i) {
            const double mass = CLAST_PI / 6.0 * (2.0 + i);
            v[i] = k == 0 ? 1.0 - 2.5 * i : 0.0;
            momentum += mass * v[i];
            motion += mass * v[i] * v[i];
        }
    }
    const clast_bed bed = {.kind = CLAST_BED_PERIODIC_3D, .high = {3.0, 2.0}, .ceiling = 2.5};
    CHECK_OK(clast_bed_fields(&bed, &a, NULL, &velocities, 0.4, &fields));
    const double *rho = clast_table_numbers(&fields, "density_kg/m^3");
    const double *v = clast_table_numbers(&fields, name[0]);
    const double *k = clast_table_numbers(&fields, "kinetic_stress_xx_Pa");
    double sum[2] = {0.0, 0.0};
    for (int64_t c = 0; c < fields.n_row; ++c) {
        const double cell = clast_table_numbers(&fields, "dx_m")[c] *
                            clast_table_numbers(&fields, "dy_m")[c] *
                            clast_table_numbers(&fields, "dz_m")[c];
        assert_true(k[c] >= -1e-12);
        sum[0] += isfinite(v[c]) ? cell * rho[c] * v[c] : 0.0;
        sum[1] += isfinite(v[c]) ? cell * (k[c] + rho[c] * v[c] * v[c]) : 0.0;
    }
    CHECK_REL(sum[0], momentum, 1e-12);
    CHECK_REL(sum[1], motion, 1e-12);
    clast_table_free(&fields);
    CHECK_STATUS(clast_bed_fields(&bed, &a, NULL, NULL, 2.1, &fields), CLAST_E_USAGE);
    CHECK_STATUS(clast_bed_fields(&bed, &a, &velocities, NULL, 0.4, &fields), CLAST_E_FORMAT);
    clast_table_free(&velocities);
    clast_assembly_free(&a);
}

/* Five of nine balls in a row press each other along it: one chain of four contacts. Without the
 * fifth's neighbour in line, the sixth pressed from the side is none of it. */
static void row_that_carries_is_a_chain(void **state)
{
    (void)state;
    static const char *const name[] = {"a",          "b",         "centre_z_m", "x_m",
                                       "y_m",        "z_m",       "branch_x_m", "branch_y_m",
                                       "branch_z_m", "force_x_N", "force_y_N",  "force_z_N"};
    enum { N_COLUMN = sizeof name / sizeof *name, N_CONTACT = 5 };
    clast_assembly a = {0};
    clast_table contacts = {0};
    clast_table chains = {0};
    add_balls(&a, 9, 1.0);
    CHECK_OK(clast_table_init(&contacts, "contacts", N_CONTACT));
    for (int c = 0; c < N_COLUMN; ++c) {
        CHECK_OK(clast_table_add_number(&contacts, name[c], "-", NULL));
    }
    for (int k = 0; k < N_CONTACT; ++k) {
        const double force = k < 4 ? 10.0 : 0.1;
        const double value[N_COLUMN] = {k,   k + 1, 0.5, k + 1.0, 0.5, 0.5,
                                        1.0, 0.0,   0.0, force,   0.0, 0.0};
        for (int c = 0; c < N_COLUMN; ++c) {
            contacts.column[c].number[k] = value[c];
        }
    }
    const clast_bed bed = {.kind = CLAST_BED_PERIODIC, .high = {9.0, 2.0}};
    CHECK_OK(clast_bed_chains(&bed, &a, &contacts, &chains));
    const double *chain = clast_table_numbers(&chains, "chain");
    for (int k = 0; k < N_CONTACT; ++k) {
        assert_int_equal((int)chain[k], k < 4 ? 1 : 0);
    }
    /* a grain between two forces F: sum f r / V = F d / V */
    CHECK_REL(clast_table_numbers(&chains, "pressure_b_Pa")[0], 10.0 / (CLAST_PI / 6.0), 1e-14);
    CHECK_REL(clast_table_numbers(&chains, "force_share")[0], 10.0 / (40.1 / 5.0), 1e-14);
    clast_table_free(&chains);
    contacts.column[1].number[2] = 9.0;
    CHECK_STATUS(clast_bed_chains(&bed, &a, &contacts, &chains), CLAST_E_FORMAT);
    clast_table_free(&contacts);
    clast_assembly_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(column_is_exact_at_its_floor),
        cmocka_unit_test(motion_adds_up),
        cmocka_unit_test(row_that_carries_is_a_chain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
