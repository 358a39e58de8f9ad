/* Unit: a host program whose locale has a decimal comma reads and writes what any other does. */
#include "support.h"

#include "base/number.h"
#include <clast/aggregate_run.h>
#include <clast/chart.h>
#include <clast/field.h>
#include <clast/mesh.h>
#include <clast/porosity.h>
#include <clast/state.h>
#include <clast/table.h>
#include <clast/volume.h>
#include <dirent.h>
#include <locale.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/// Sets a locale with a decimal comma, made on the spot where none is installed.
static bool set_comma_locale(void)
{
    static const char *const wanted[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE"};
    char command[400];
    for (size_t i = 0; i < 4; ++i) {
        if (setlocale(LC_ALL, wanted[i]) != NULL) {
            return true;
        }
    }
    (void)snprintf(command, sizeof command,
                   "localedef -i de_DE -f UTF-8 %s/de_DE.UTF-8 > /dev/null 2>&1",
                   support_scratch());
    return system(command) == 0 && setenv("LOCPATH", support_scratch(), 1) == 0 &&
           setlocale(LC_ALL, "de_DE.UTF-8") != NULL;
}

/// Enters the locale and sees that the C library obeys it; without one the test is left out.
static void enter_comma_locale(void)
{
    char printed[16];
    if (!set_comma_locale()) {
        print_message("SKIPPED LOUDLY: no locale with a decimal comma can be had here; install "
                      "Debian's package locales\n");
        skip();
    }
    (void)snprintf(printed, sizeof printed, "%g", 1.5);
    assert_string_equal(printed, "1,5");
}

static int leave_locale(void **state)
{
    (void)state;
    return setlocale(LC_ALL, "C") != NULL ? 0 : -1;
}

static void numbers_have_a_point(void **state)
{
    (void)state;
    char text[CLX_NUMBER_SIZE];
    char *end = NULL;
    double value = 0.0;
    enter_comma_locale();
    (void)clx_number_format(-1234.5625, text);
    assert_string_equal(text, "-1234.5625");
    (void)clx_number_format(1.5e-30, text);
    assert_string_equal(text, "1.5e-30");
    assert_int_equal(clx_number_print(text, sizeof text, "%g;%.2f", 2.5, 0.125), 8);
    assert_string_equal(text, "2.5;0.12");
    assert_true(clx_number_read(" -0.5e1,7", &end) == -5.0);
    assert_string_equal(end, ",7");
    assert_true(clx_number_read("none", &end) == 0.0);
    assert_string_equal(end, "none");
    CHECK_OK(clast_unit_parse("2.5 mm", "m", &value));
    CHECK_REL(value, 2.5e-3, 1e-15);
    (void)snprintf(text, sizeof text, "%g", 1.5);
    assert_string_equal(text, "1,5"); // the host has its locale back
}

/* volume_nrrd.c read "0.5" as 0 there. */
static void volumes_have_their_edges(void **state)
{
    (void)state;
    static const char spaced[] = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 1 1 2\n"
                                 "spacings: 0.5 0.25 1.5\nencoding: raw\n\n\1\2";
    static const char steps[] = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 1 1 2\n"
                                "space directions: (0.5,0,0) ( 0 , 0.25 ,0) (0,0,1.5)\n"
                                "encoding: raw\n\n\1\2";
    const clast_volume_options options = {.n = {0}};
    enter_comma_locale();
    for (int k = 0; k < 2; ++k) {
        clast_volume volume = {0};
        CHECK_OK(clast_volume_parse(k == 0 ? spaced : steps,
                                    (k == 0 ? sizeof spaced : sizeof steps) - 1, &options,
                                    &volume));
        CHECK_ABS(volume.edge[0], 0.5, 0.0);
        CHECK_ABS(volume.edge[1], 0.25, 0.0);
        CHECK_ABS(volume.edge[2], 1.5, 0.0);
        clast_volume_free(&volume);
    }
}

static void path_in(const char *folder, const char *name, char path[600])
{
    (void)snprintf(path, 600, "%s/%s", folder, name);
}

/// A bed of two grains, measured and exported in every format.
static void write_bed(const char *folder)
{
    static const char *const ends[] = {"vtu", "obj", "ply", "3mf", "csv", "json", "dump"};
    static const char *const meshes[] = {"m.obj", "m.off", "m.ply", "m.3mf"};
    char path[600];
    char text[64];
    clast_assembly a = {0};
    clast_shape ball = {0};
    clast_mesh box = {0};
    clast_mesh back = {0};
    clast_table profile = {0};
    clast_table again = {0};
    clast_bed bed;
    clast_porosity_bulk bulk;
    clast_porosity_options options = clast_porosity_options_default();
    CHECK_OK(clast_shape_ellipsoid("ball", (double[3]){0.5, 0.25, 0.125}, &ball));
    CHECK_OK(clast_assembly_add_shape(&a, &ball, NULL));
    (void)snprintf(a.unit, sizeof a.unit, "m");
    for (int k = 0; k < 2; ++k) {
        CHECK_OK(clast_assembly_add_grain(&a, 0, (double[3]){0.75, 0.5, 0.25 + 0.5 * k},
                                          (double[4]){1.0, 0.0, 0.0, 0.0}, 1.5, 2650.5));
    }
    CHECK_OK(clast_bed_parse("box:-0.25,-0.5,1.75,1.5", &bed));
    assert_true(clast_bed_format(&bed, sizeof text, text) > 0);
    CHECK_OK(clast_bed_parse(text, &bed));
    options.layer = 0.0625;
    options.cut = 0.9;
    CHECK_OK(clast_porosity_profile(&a, &bed, &options, &profile));
    CHECK_OK(clast_porosity_measure(&a, &bed, &profile, &options, &bulk));
    path_in(folder, "profile.csv", path);
    CHECK_OK(clast_table_write_csv(&profile, path));
    CHECK_OK(clast_table_read_csv(path, NULL, &again, NULL));
    assert_memory_equal(clast_table_numbers(&again, "porosity"),
                        clast_table_numbers(&profile, "porosity"),
                        (size_t)profile.n_row * sizeof(double));
    path_in(folder, "profile.json", path);
    CHECK_OK(clast_table_write_json(&profile, path));
    path_in(folder, "profile.svg", path);
    CHECK_OK(clast_chart_porosity(&profile, &bulk, "m", path));
    for (size_t k = 0; k < sizeof ends / sizeof ends[0]; ++k) {
        (void)snprintf(text, sizeof text, "bed.%s", ends[k]);
        path_in(folder, text, path);
        CHECK_OK(clast_assembly_write(&a, path, NULL, NULL));
    }
    CHECK_OK(clast_mesh_box(0.5, 1.25, 1e-3, &box));
    for (size_t k = 0; k < sizeof meshes / sizeof meshes[0]; ++k) {
        path_in(folder, meshes[k], path);
        CHECK_OK(clast_mesh_write(&box, path, &(clast_mesh_write_options){.unit = "mm"}));
    }
    path_in(folder, "m.obj", path);
    CHECK_OK(clast_mesh_read(path, &back, NULL));
    assert_memory_equal(back.vert, box.vert, 8 * sizeof *box.vert);
    clast_mesh_free(&box);
    clast_mesh_free(&back);
    clast_table_free(&profile);
    clast_table_free(&again);
    clast_assembly_free(&a);
    clast_shape_free(&ball);
}

/// A run with its configuration, tables, charts and pictures.
static void write_run(const char *folder)
{
    static const char text[] = "core: ellipsoid:1.5,1.0,0.75\ncoat: sphere\ncore_size: 40.5 um\n"
                               "size_law: uniform\nsize_low: 8.5 um\nsize_high: 10.25 um\n"
                               "n_particle: 12\naxis: 0.5,0.25,1.5\ncone: 12.5 deg\n"
                               "core_density: 2650.5\nrepeats: 2\npicture: false\n";
    clast_aggregate_config config;
    clast_aggregate_report report = {0};
    char *summary = NULL;
    CHECK_OK(clast_fields_default(clast_aggregate_fields, &config));
    CHECK_OK(clast_fields_parse("run.yaml", text, clast_aggregate_fields, &config));
    CHECK_REL(config.params.core_size, 40.5e-6, 1e-15);
    CHECK_OK(clast_aggregate_run(&config, folder, NULL, NULL, &report));
    CHECK_OK(clast_aggregate_report_json(&report, false, &summary));
    assert_null(strchr(summary, ';'));
    clast_text_free(summary);
    clast_aggregate_report_free(&report);
    clast_fields_free(clast_aggregate_fields, &config);
}

/// Every file of two folders but those that hold the clock.
static void check_same_folders(const char *a, const char *b)
{
    char path[2][600];
    int n = 0;
    DIR *dir = opendir(a);
    assert_non_null(dir);
    for (const struct dirent *e = readdir(dir); e != NULL; e = readdir(dir)) { // NOLINT
        if (e->d_name[0] == '.' || strcmp(e->d_name, "manifest.json") == 0 ||
            strcmp(e->d_name, "report.html") == 0) {
            continue;
        }
        path_in(a, e->d_name, path[0]);
        path_in(b, e->d_name, path[1]);
        support_check_same_files(path[0], path[1]);
        ++n;
    }
    (void)closedir(dir);
    assert_true(n >= 5);
}

/* printf obeys the locale too: configurations, tables, charts and pictures of such a host held
 * "0,5". */
static void files_are_the_same_bytes(void **state)
{
    (void)state;
    char folder[4][400];
    for (int k = 0; k < 4; ++k) {
        (void)snprintf(folder[k], sizeof folder[k], "%s/%s-%s", support_scratch(),
                       k % 2 == 0 ? "bed" : "run", k < 2 ? "point" : "comma");
        assert_int_equal(k % 2 == 0 ? mkdir(folder[k], 0777) : 0, 0);
    }
    write_bed(folder[0]);
    write_run(folder[1]);
    enter_comma_locale();
    write_bed(folder[2]);
    write_run(folder[3]);
    (void)setlocale(LC_ALL, "C");
    check_same_folders(folder[0], folder[2]);
    check_same_folders(folder[1], folder[3]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(numbers_have_a_point, leave_locale),
        cmocka_unit_test_teardown(volumes_have_their_edges, leave_locale),
        cmocka_unit_test_teardown(files_are_the_same_bytes, leave_locale),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
