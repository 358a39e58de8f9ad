/* Unit: packings of spheres from other programs' files, and beds that repeat in three directions.
 */
#include "support.h"

#include "base/alloc.h"
#include "base/file.h"
#include "io/start_file.h"
#include <clast/assembly.h>
#include <clast/field.h>
#include <clast/mesh.h>
#include <clast/pack.h>
#include <clast/porosity.h>
#include <clast/state.h>
#include <clast/table.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define FCC "periodic:0,0,0,4.242640687119285,4.242640687119285,4.242640687119285"

/// Writes a text into a scratch file and reads it as a packing.
static clast_status read_text(const char *name, const char *text, const char *columns,
                              double diameter, clast_assembly *a)
{
    const clast_packing_options options = {columns, diameter};
    const char *path = support_scratch_file(name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fputs(text, file) >= 0, 1);
    assert_int_equal(fclose(file), 0);
    return clast_packing_read(path, &options, a, NULL);
}

static void check_read(const char *name, const char *text, const char *columns, double diameter,
                       const char *unit)
{
    clast_assembly a = {0};
    const double u = strcmp(unit, "m") == 0 ? 1e-3 : 1.0;
    CHECK_OK(read_text(name, text, columns, diameter, &a));
    assert_int_equal(a.n_grain, 2);
    assert_string_equal(a.unit, unit);
    CHECK_REL(a.position[0][0], 0.5 * u, 1e-15);
    CHECK_REL(a.position[1][2], 2.5 * u, 1e-15);
    CHECK_REL(a.scale[0], 0.75 * u, 1e-15);
    clast_assembly_free(&a);
}

static void files_of_other_programs_are_packings(void **state)
{
    (void)state;
    check_read("a.csv", "x,y,z,radius\n.5,0,0,.75\n0,1,2.5,.75\n", "", 0.0, "model");
    check_read("a.csv", "x,y,z,diameter\n.5,0,0,1.5\n0,1,2.5,1.5\n", "", 0.0, "model");
    check_read("a.csv", "x_mm,y_mm,z_mm,d_mm\n.5,0,0,1.5\n0,1,2.5,1.5\n", "", 0.0, "m");
    check_read("a.csv", "x (mm),y (mm),z (mm)\n.5,0,0\n0,1,2.5\n", "", 1.5e-3, "m");
    check_read("a.txt", ".5 0 0 .75\n0 1 2.5 .75\n", "", 0.0, "model");
    check_read("a.txt", "1 .5 0 0\n2 0 1 2.5\n", "", 1.5, "model");         // voro++
    check_read("a.txt", "1 .5 0 0 .75\n2 0 1 2.5 .75\n", "", 0.0, "model"); // its polydisperse text
    check_read("a.txt", "7 .5 0 0 1.5\n9 0 1 2.5 1.5\n", "id,x,y,z,d", 0.0, "model");
    check_read("a.xyz", "2\nbox 3\nC .5 0 0 .75\nC 0 1 2.5 .75\n", "", 0.0, "model");
    check_read("a.xyz", "2\nbox 3\nC .5 0 0\nC 0 1 2.5\n", "", 1.5, "model");
    check_read(
        "a.dump",
        "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n0 3\n0 3\n0 "
        "3\nITEM: ATOMS id x y z diameter\n1 .5 0 0 1.5\n2 0 1 2.5 1.5\n",
        "", 0.0, "model");
}

static void what_is_not_said_is_asked_for(void **state)
{
    (void)state;
    clast_assembly a = {0};
    CHECK_STATUS(read_text("b.txt", "1 .5 0 0\n2 0 1 2.5\n", "", 0.0, &a), CLAST_E_FORMAT);
    assert_non_null(strstr(clast_error_detail(), "--diameter"));
    CHECK_STATUS(read_text("b.csv", "x,y,z\n1,2,3\n", "", 0.0, &a), CLAST_E_FORMAT);
    CHECK_STATUS(read_text("b.csv", "x_mm,y_mm,z_mm,radius\n1,2,3,1\n", "", 0.0, &a),
                 CLAST_E_FORMAT);
    assert_non_null(strstr(clast_error_detail(), "unit"));
    CHECK_STATUS(read_text("b.csv", "x,y,z,radius\n1,2,3,-1\n", "", 0.0, &a), CLAST_E_FORMAT);
    CHECK_STATUS(read_text("b.txt", "1 2 3 4 5\n9 2 3 4 5\n", "", 0.0, &a), CLAST_E_FORMAT);
    CHECK_STATUS(read_text("b.txt", "1 2 3 4 5\n9 2 3 4 5\n", "id,x,y", 0.0, &a), CLAST_E_CONFIG);
    CHECK_STATUS(read_text("b.xyzd", "12345", "", 0.0, &a), CLAST_E_FORMAT);
    assert_int_equal(a.n_grain, 0);
}

#define SNAPSHOT(step, n, bounds, names, rows)                                                     \
    "ITEM: TIMESTEP\n" step "\nITEM: NUMBER OF ATOMS\n" n "\nITEM: BOX BOUNDS " bounds             \
    "\nITEM: ATOMS id " names "\n" rows

/* The last of several snapshots, its step and its box without what a tilt adds to the bounds. */
static void the_last_snapshot_is_read_with_its_frame(void **state)
{
    (void)state;
    static const char text[] = "ITEM: UNITS\ncgs\n" SNAPSHOT("5", "1", "pp ff pp\n0 3\n0 3\n0 3",
                                                             "x y z radius", "1 1 1 1 1\n")
        SNAPSHOT("70", "1", "xy xz yz pp pp ff\n-1 5 -1\n0 3 2\n0 3 0", "x y z radius mass",
                 "1 .5 0 2.5 .75 2\n");
    const char *path = support_scratch_file("several.dump");
    clast_packing_report report;
    clast_assembly a = {0};
    CHECK_OK(read_text("several.dump", text, "", 0.0, &a));
    assert_string_equal(a.unit, "m");
    CHECK_REL(a.position[0][2], 2.5e-2, 1e-15);
    CHECK_REL(a.density[0], 2e-3 / (4.0 / 3.0 * CLAST_PI * pow(0.75e-2, 3.0)), 1e-14);
    assert_false(a.no_density);
    clast_assembly_free(&a);
    CHECK_OK(clast_packing_read(path, NULL, &a, &report));
    assert_int_equal(report.snapshot, 2);
    assert_int_equal(report.n_snapshot, 2);
    assert_int_equal(report.frame.step, 70);
    CHECK_ABS(report.frame.low[0], 0.0, 1e-15);
    CHECK_REL(report.frame.high[0], 3e-2, 1e-14);
    CHECK_REL(report.frame.tilt[0], -1e-2, 1e-14);
    CHECK_REL(report.frame.tilt[1], 2e-2, 1e-14);
    assert_true(report.frame.is_periodic[0] && report.frame.is_periodic[1]);
    assert_false(report.frame.is_periodic[2]);
    clast_assembly_free(&a);
    CHECK_OK(read_text("lone.xyz", "1\none\nC 2 1 1 1\n\n", "", 0.0, &a));
    clast_assembly_free(&a);
    CHECK_OK(clast_packing_read(support_scratch_file("lone.xyz"), NULL, &a, &report));
    assert_int_equal(report.n_snapshot, 1);
    assert_int_equal(report.frame.step, -1);
    clast_assembly_free(&a);
}

/* Densities that no file tells are 1 and marked, through copies too; a writer that needs them
 * refuses, the others leave them out, until one is set. */
static void densities_that_are_not_told_are_not_written(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_assembly copy = {0};
    clast_table table = {0};
    CHECK_OK(read_text("e.csv", "x_mm,y_mm,z_mm,d_mm\n1,2,3,2\n", "", 0.0, &a));
    assert_true(a.no_density && a.density[0] == 1.0);
    CHECK_OK(clast_assembly_copy(&a, &copy));
    assert_true(copy.no_density);
    CHECK_STATUS(clast_assembly_write(&a, support_scratch_file("e.data"), NULL, NULL),
                 CLAST_E_USAGE);
    CHECK_STATUS(clast_assembly_write(&a, support_scratch_file("e.conf"), NULL, NULL),
                 CLAST_E_USAGE);
    CHECK_OK(clast_assembly_table(&a, &table));
    assert_int_equal(clast_table_find(&table, "density_kg/m^3"), -1);
    assert_int_equal(clast_table_find(&table, "mass_kg"), -1);
    clast_table_free(&table);
    copy.density[0] = 2500.0;
    CHECK_OK(clast_assembly_write(&copy, support_scratch_file("e.data"), NULL, NULL));
    clast_assembly_free(&copy);
    clast_assembly_free(&a);
    CHECK_OK(read_text("e.csv", "x_mm,y_mm,z_mm,d_mm,Rho (g/cm3)\n1,2,3,2,2.5\n", "", 0.0, &a));
    assert_false(a.no_density);
    CHECK_REL(a.density[0], 2500.0, 1e-15);
    clast_assembly_free(&a);
    CHECK_STATUS(read_text("e.csv", "x,y,z,d,density (lb)\n1,2,3,2,2\n", "", 0.0, &a),
                 CLAST_E_FORMAT);
    CHECK_STATUS(read_text("e.csv", "x,y,z,d,density\n1,2,3,2,-2\n", "", 0.0, &a), CLAST_E_FORMAT);
    CHECK_OK(read_text("e.csv", "x,y,z,d,mass_kg\n1,2,3,2,2\n", "", 0.0, &a)); // in what volume?
    assert_true(a.no_density);
    clast_assembly_free(&a);
}

/// Whole box, every cell and every contact of a packing that repeats in three directions.
static void check_box(clast_assembly *a, const char *bed_text, double porosity, double tolerance,
                      int32_t n_contact, double gap)
{
    clast_bed bed;
    clast_table profile = {0};
    clast_porosity_bulk bulk;
    clast_overlaps overlaps;
    clast_porosity_options options = clast_porosity_options_default();
    double solid = 0.0;
    CHECK_OK(clast_bed_parse(bed_text, &bed));
    clast_bed_wrap(&bed, a);
    clast_period period = {.low = {bed.low[0], bed.low[1], bed.floor}};
    assert_true(clast_bed_period(&bed, period.length));
    options.layer = 0.3;
    CHECK_OK(clast_porosity_profile(a, &bed, &options, &profile));
    CHECK_OK(clast_porosity_measure(a, &bed, &profile, &options, &bulk));
    CHECK_ABS(bulk.porosity, porosity, tolerance);
    CHECK_REL(bulk.z_high - bulk.z_low, period.length[2], 1e-15);
    for (int64_t k = 0; k < profile.n_row; ++k) {
        solid += clast_table_numbers(&profile, "solid_m3")[k];
    }
    CHECK_REL(solid, bulk.solid, 1e-12);
    CHECK_REL(clast_table_numbers(&profile, "z_high_m")[profile.n_row - 1], bed.ceiling, 1e-15);
    CHECK_OK(clast_assembly_find_contacts_periodic(a, gap, &period));
    assert_int_equal(a->n_contact, n_contact);
    CHECK_OK(clast_assembly_overlaps(a, &period, &overlaps));
    assert_int_equal(overlaps.n, 0);
    options.trim = 0.1;
    CHECK_STATUS(clast_porosity_measure(a, &bed, &profile, &options, &bulk), CLAST_E_USAGE);
    clast_table_free(&profile);
}

/* Face-centred cubic: 1 - pi / (3 sqrt 2), twelve contacts and a rhombic dodecahedron each. */
static void close_packing_in_a_periodic_box_is_exact(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_bed bed;
    clast_table local = {0};
    const double porosity = 1.0 - CLAST_PI / (3.0 * sqrt(2.0));
    CHECK_OK(clast_packing_read(support_data("packings/fcc-108.txt"), NULL, &a, NULL));
    assert_int_equal(a.n_grain, 108);
    check_box(&a, FCC, porosity, 1e-13, 6 * 108, 1e-9);
    CHECK_OK(clast_bed_parse(FCC, &bed));
    CHECK_OK(clast_porosity_local(&a, &bed, bed.floor, bed.ceiling, &local));
    for (int64_t i = 0; i < local.n_row; ++i) {
        CHECK_ABS(clast_table_numbers(&local, "porosity")[i], porosity, 1e-12);
        CHECK_ABS(clast_table_numbers(&local, "border")[i], 0.0, 0.0);
    }
    assert_int_equal(local.n_row, 108);
    CHECK_STATUS(clast_porosity_local(&a, &bed, 1.0, 2.0, &local), CLAST_E_USAGE);
    clast_table_free(&local);
    clast_assembly_free(&a);
}

/* Two pairs overlap, one of them across two borders of the box. */
static void overlaps_count_across_borders(void **state)
{
    (void)state;
    clast_assembly a = {0};
    clast_bed bed;
    clast_overlaps overlaps;
    CHECK_OK(read_text("c.txt", "1 1 1\n2.9 1 1\n0.1 5 7.9\n7.9 5 1.77\n", "x,y,z", 2.0, &a));
    CHECK_OK(clast_bed_parse("periodic:0,0,0,8,8,8", &bed));
    clast_period period = {.low = {0.0, 0.0, 0.0}};
    (void)clast_bed_period(&bed, period.length);
    CHECK_OK(clast_assembly_overlaps(&a, NULL, &overlaps));
    assert_int_equal(overlaps.n, 1);
    CHECK_OK(clast_assembly_overlaps(&a, &period, &overlaps));
    assert_int_equal(overlaps.n, 2);
    CHECK_REL(overlaps.depth, 2.0 - hypot(0.2, 1.87), 1e-9);
    CHECK_REL(overlaps.share, overlaps.depth, 1e-12);
    clast_assembly_free(&a);
}

static void beds_in_three_directions_read_back(void **state)
{
    (void)state;
    clast_bed bed;
    clast_bed back;
    clast_table table = {0};
    char text[256];
    CHECK_OK(clast_bed_parse("periodic:-1,-2,-3mm,1,2,3", &bed));
    assert_int_equal(bed.kind, CLAST_BED_PERIODIC_3D);
    CHECK_REL(bed.floor, -3e-3, 1e-15);
    CHECK_REL(clast_bed_area(&bed), 8.0, 1e-15);
    assert_true(clast_bed_format(&bed, sizeof text, text) > 0);
    CHECK_OK(clast_bed_parse(text, &back));
    assert_true(back.ceiling == bed.ceiling && back.floor == bed.floor &&
                back.low[1] == bed.low[1]);
    CHECK_OK(clast_bed_table(&bed, &table));
    CHECK_OK(clast_bed_from_table(&table, &back));
    assert_true(back.ceiling == bed.ceiling && back.floor == bed.floor);
    clast_table_free(&table);
    CHECK_STATUS(clast_bed_parse("periodic:0,0,1,1,1,1", &bed), CLAST_E_CONFIG);
    CHECK_STATUS(clast_bed_parse("box:0,0,0,1,1,1", &bed), CLAST_E_CONFIG);
    CHECK_STATUS(clast_bed_parse("periodic:0,0,0,1,1", &bed), CLAST_E_CONFIG);
}

/* Random close packing of 10,000 spheres: its published porosity, with nothing trimmed; the stored
 * diameter is to be scaled to contact, says its README. */
static void the_jammed_packing_has_its_published_porosity(void **state)
{
    (void)state;
    const clast_packing_options scaled = {"", 1.0};
    clast_assembly a = {0};
    const char *path = support_shared("packings/rcp10000/packing.xyzd");
    if (path == NULL) {
        skip();
    }
    CHECK_OK(clast_packing_read(path, &scaled, &a, NULL));
    assert_int_equal(a.n_grain, 10000);
    check_box(&a, "periodic:0,0,0,20.0823593086113,20.0823593086113,20.0823593086113", 0.353520998,
              5e-9, 29753, 1e-4);
    clast_assembly_free(&a);
}

static clast_status make_packing(void *context)
{
    clast_assembly a = {0};
    const clast_status status = clast_packing_read(context, NULL, &a, NULL);
    clast_assembly_free(&a);
    return status;
}

static clast_status make_overlaps(void *context)
{
    static const clast_period period = {{0.0, 0.0, 0.0}, {4.3, 4.3, 4.3}};
    clast_overlaps overlaps;
    return clast_assembly_overlaps(context, &period, &overlaps);
}

static void refused_memory_leaves_nothing(void **state)
{
    (void)state;
    clast_assembly a = {0};
    CHECK_OK(read_text("d.txt", "1 1 1 1\n2.9 1 1 1\n", "", 0.0, &a));
    support_refuse_each_allocation(make_overlaps, &a);
    support_refuse_each_allocation_at(make_packing, "d.txt");
    clast_assembly_free(&a);
}

static void set_text(char **field, const char *text)
{
    clx_free(*field);
    CHECK_OK(clx_alloc_text(field, text));
}

/* A run that an older clast began goes on with what that one read: the first snapshot, places and a
 * diameter in start_unit whatever ITEM: UNITS says, no densities of tables. */
static void old_runs_read_their_start_as_then(void **state)
{
    (void)state;
    static const char dump[] = "ITEM: UNITS\nsi\n" SNAPSHOT("5", "1", "ff ff ff\n0 3\n0 3\n0 3",
                                                            "x y z radius mass", "1 1 1 1 1 7\n")
        SNAPSHOT("70", "1", "ff ff ff\n0 3\n0 3\n0 3", "x y z radius mass", "1 .5 0 2.5 .75 7\n");
    clast_pack_config config = {0};
    clast_pack_source source = {0};
    clast_assembly a = {0};
    CHECK_OK(clast_fields_default(clast_pack_fields, &config));
    CHECK_OK(read_text("old.dump", dump, "", 0.0, &a));
    clast_assembly_free(&a);
    set_text(&config.start, support_scratch_file("old.dump"));
    set_text(&config.start_unit, "mm");
    CHECK_STATUS(clast_pack_load(&config, &source), CLAST_E_CONFIG);
    config.start_frame = CLX_START_OLD;
    CHECK_OK(clast_pack_load(&config, &source));
    CHECK_REL(source.start.scale[0], 1e-3, 1e-15);
    CHECK_REL(source.start.density[0], 2650.0, 1e-15);
    clast_pack_unload(&source);
    CHECK_OK(read_text("old.csv", "x,y,z,density\n1,2,3,2.65\n", "", 1.0, &a));
    clast_assembly_free(&a);
    set_text(&config.start, support_scratch_file("old.csv"));
    config.start_diameter = 4e-3;
    CHECK_OK(clast_pack_load(&config, &source));
    CHECK_REL(source.start.scale[0], 2e-6, 1e-15);
    CHECK_REL(source.start.density[0], 2650.0, 1e-15);
    clast_pack_unload(&source);
    clast_fields_free(clast_pack_fields, &config);
}

/// Starts from a file and writes that again over it: the same bytes, those of a file of shapes too.
static void check_start(const char *path)
{
    clast_pack_config config = {0};
    clast_pack_source source = {0};
    char *bytes[2][2] = {{NULL, NULL}, {NULL, NULL}};
    int64_t n[2][2] = {{0, 0}, {0, 0}};
    char shapes[4096];
    const char *dot = strrchr(path, '.');
    const int n_file = strcmp(dot, ".conf") == 0 ? 2 : 1;
    (void)snprintf(shapes, sizeof shapes, "%.*s.shp", (int)(dot - path), path);
    const char *const file[2] = {path, shapes};
    CHECK_OK(clast_fields_default(clast_pack_fields, &config));
    set_text(&config.start, path);
    set_text(&config.start_unit, "m");
    for (int time = 0; time < 2; ++time) {
        for (int k = 0; k < n_file; ++k) {
            CHECK_OK(clx_file_read_all(file[k], 1 << 24, &bytes[time][k], &n[time][k]));
        }
        if (time == 0) {
            CHECK_OK(clast_pack_load(&config, &source));
            CHECK_OK(clast_assembly_write(source.input.start, path, NULL, NULL));
        }
    }
    for (int k = 0; k < n_file; ++k) {
        assert_int_equal(n[0][k], n[1][k]);
        assert_memory_equal(bytes[0][k], bytes[1][k], (size_t)n[0][k]);
        clx_free(bytes[0][k]);
        clx_free(bytes[1][k]);
    }
    clast_pack_unload(&source);
    clast_fields_free(clast_pack_fields, &config);
}

static void check_format(const clast_assembly *a, const char *name)
{
    char path[4096];
    (void)snprintf(path, sizeof path, "%s", support_scratch_file(name));
    CHECK_OK(clast_assembly_write(a, path, NULL, NULL));
    check_start(path);
}

static void add_shape(clast_assembly *a, clast_status status, clast_shape *shape)
{
    CHECK_OK(status);
    CHECK_OK(clast_assembly_add_shape(a, shape, NULL));
    clast_shape_free(shape);
}

/* Grains of any places, turns, scales and densities, as floating-point numbers have them. */
static void fill_bed(clast_assembly *a, int32_t n)
{
    (void)snprintf(a->unit, sizeof a->unit, "m");
    for (int32_t i = 0; i < n; ++i) {
        const double x[3] = {0.1 * sin(i), 0.1 * cos(3.0 * i), i / 7.0};
        double q[4] = {cos(i), sin(2.0 * i), 0.3, sin(i)};
        const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        for (int k = 0; k < 4; ++k) {
            q[k] /= length;
        }
        CHECK_OK(clast_assembly_add_grain(a, i % a->n_shape, x, q, 3e-3 + 1e-4 * sin(5.0 * i),
                                          2650.0 + i % 3));
    }
}

/* What goes out as a bed of another program comes back as a start in the same bytes. */
static void beds_come_back_in_equal_bytes(void **state)
{
    (void)state;
    static const char *const spheres[] = {"s.data", "s.dump", "s.txt", "s.voro",
                                          "s.xyzd", "s.conf", "s.csv"};
    static const char *const ellipsoids[] = {"e.data", "e.dump"};
    clast_assembly a = {0};
    clast_shape shape = {0};
    clast_mesh box = {0};
    add_shape(&a, clast_shape_sphere("1-sphere", 0.5, &shape), &shape);
    fill_bed(&a, 20);
    for (size_t k = 0; k < sizeof spheres / sizeof *spheres; ++k) {
        check_format(&a, spheres[k]);
    }
    clast_assembly_free(&a);
    add_shape(&a, clast_shape_ellipsoid("1-e", (double[3]){0.7, 0.5, 0.3}, &shape), &shape);
    add_shape(&a, clast_shape_ellipsoid("2-e", (double[3]){0.9, 0.4, 0.4}, &shape), &shape);
    fill_bed(&a, 20);
    for (size_t k = 0; k < sizeof ellipsoids / sizeof *ellipsoids; ++k) {
        check_format(&a, ellipsoids[k]);
    }
    clast_assembly_free(&a);
    CHECK_OK(clast_mesh_box(0.9, 0.7, 0.55, &box));
    clast_mesh_transform(&box, 1.0, (double[4]){0.8, 0.0, 0.6, 0.0}, (double[3]){0.1, 0.2, 0.3});
    add_shape(&a, clast_shape_mesh("1-box", &box, &shape), &shape);
    add_shape(&a, clast_shape_sphere("2-sphere", 0.5, &shape), &shape);
    fill_bed(&a, 20);
    check_format(&a, "b.conf");
    clast_mesh_free(&box);
    clast_assembly_free(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_of_other_programs_are_packings),
        cmocka_unit_test(what_is_not_said_is_asked_for),
        cmocka_unit_test(the_last_snapshot_is_read_with_its_frame),
        cmocka_unit_test(densities_that_are_not_told_are_not_written),
        cmocka_unit_test(close_packing_in_a_periodic_box_is_exact),
        cmocka_unit_test(overlaps_count_across_borders),
        cmocka_unit_test(beds_in_three_directions_read_back),
        cmocka_unit_test(the_jammed_packing_has_its_published_porosity),
        cmocka_unit_test(refused_memory_leaves_nothing),
        cmocka_unit_test(old_runs_read_their_start_as_then),
        cmocka_unit_test(beds_come_back_in_equal_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
