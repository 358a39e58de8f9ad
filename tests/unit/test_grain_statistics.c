/* Unit: statistics and charts of sets of grains; the stand-in of 63 grains has the moments that its
 * README states. */
#include "support.h"

#include "base/alloc.h"
#include "base/file.h"
#include <clast/chart.h>
#include <clast/statistics.h>
#include <clast/table.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const clast_bootstrap few = {.n_resample = 200, .level = 0.95, .seed = 1};

static const char *folder(const char *name)
{
    static char path[512];
    (void)snprintf(path, sizeof path, "%s/%s", support_scratch(), name);
    (void)mkdir(path, 0777);
    return path;
}

static bool has_file(const char *in, const char *name)
{
    char path[1024];
    (void)snprintf(path, sizeof path, "%s/%s", in, name);
    return access(path, R_OK) == 0;
}

/* data/standin63/README.md: means 0.647 and 0.682, deviations 0.175 and 0.139 (n - 1), r = -0.0894,
 * 20 spheres, 15 discs, 10 rods, 18 blades; all from that set's own script. */
static void stand_in_has_its_stated_moments(void **state)
{
    (void)state;
    clast_table t = {0};
    clast_grain_statistics g = {0};
    CHECK_OK(clast_table_read_csv(support_data("standin63/grains.csv"), NULL, &t, NULL));
    CHECK_OK(clast_grain_statistics_of(&t, NULL, &few, &g));
    assert_int_equal(g.set.n, 63);
    const clast_sample_summary *fl = &g.statistics.summary[CLAST_FORM_FLATNESS];
    const clast_sample_summary *el = &g.statistics.summary[CLAST_FORM_ELONGATION];
    CHECK_ABS(fl->mean, 0.647, 1e-6);
    CHECK_ABS(fl->deviation, 0.175, 1e-6);
    CHECK_ABS(el->mean, 0.682, 1e-6);
    CHECK_ABS(el->deviation, 0.139, 1e-6);
    CHECK_ABS(g.statistics.r[CLAST_FORM_ELONGATION], -0.0894, 5e-5);
    static const int64_t zingg[CLAST_N_ZINGG] = {20, 15, 10, 18};
    for (int k = 0; k < CLAST_N_ZINGG; ++k) {
        assert_int_equal(g.zingg[k], zingg[k]);
    }
    /* section 2.3: two components explain the variance of the 13 factors */
    assert_true(g.statistics.explained[1] > 0.95);
    assert_int_equal(g.statistics.n_pca, 13);
    clast_grain_statistics_free(&g);
    clast_table_free(&t);
}

static void every_table_and_chart_is_written(void **state)
{
    (void)state;
    static const char *const files[] = {"factors.csv",
                                        "statistics.csv",
                                        "correlation.csv",
                                        "pca.csv",
                                        "zingg.svg",
                                        "pca.svg",
                                        "correlation.svg",
                                        "histogram_flatness.csv",
                                        "left_out.csv",
                                        "histogram_flatness.svg",
                                        "histogram_elongation.svg",
                                        "histogram_size.svg"};
    const char *out = folder("statistics");
    static char text[8192] = "L_mm,I_mm,S_mm\n,2,3\n";
    clast_table t = {0};
    clast_grain_statistics g = {0};
    for (int i = 0; i < 80; ++i) {
        const size_t n = strlen(text);
        const double s = 1.0 + 0.1 * i;
        (void)snprintf(text + n, sizeof text - n, "%g,%g,%g\n", s * (2.2 + sin(i)),
                       s * (1.1 + 0.1 * cos(i)), s * (0.7 + 0.2 * sin(1.7 * i)));
    }
    CHECK_OK(clast_table_parse_csv("grains", text, strlen(text), NULL, &t, NULL));
    CHECK_OK(clast_grain_statistics_of(&t, NULL, &few, &g));
    CHECK_OK(clast_grain_statistics_write(&g, out, "svg"));
    for (size_t k = 0; k < sizeof files / sizeof files[0]; ++k) {
        if (!has_file(out, files[k])) {
            fail_msg("%s is missing", files[k]);
        }
    }
    CHECK_STATUS(clast_grain_statistics_write(&g, out, "gif"), CLAST_E_USAGE);
    CHECK_STATUS(clast_grain_statistics_write(&g, "no/such/folder", "svg"), CLAST_E_DISK);
    clast_grain_statistics_free(&g);
    clast_table_free(&t);
}

static void check_same_files(const char *a, const char *b)
{
    char *bytes[2] = {NULL, NULL};
    int64_t n[2] = {0};
    CHECK_OK(clx_file_read_all(a, 1 << 22, &bytes[0], &n[0]));
    CHECK_OK(clx_file_read_all(b, 1 << 22, &bytes[1], &n[1]));
    assert_int_equal(n[0], n[1]);
    assert_memory_equal(bytes[0], bytes[1], (size_t)n[0]);
    clx_free(bytes[0]);
    clx_free(bytes[1]);
}

/* A chart by itself has the bytes of that in the folder. */
static void charts_come_one_by_one(void **state)
{
    (void)state;
    static const char text[] = "FL,EL\n0.5,0.6\n0.7,0.9\n0.4,0.8\n0.9,0.5\n0.6,0.6\n";
    const char *out = folder("single");
    char path[600];
    char whole[600];
    clast_table t = {0};
    clast_grain_statistics g = {0};
    CHECK_OK(clast_table_parse_csv("grains", text, strlen(text), NULL, &t, NULL));
    CHECK_OK(clast_grain_statistics_of(&t, NULL, &few, &g));
    CHECK_OK(clast_grain_statistics_write(&g, out, "svg"));
    (void)snprintf(path, sizeof path, "%s/single.svg", support_scratch());
    (void)snprintf(whole, sizeof whole, "%s/zingg.svg", out);
    CHECK_OK(clast_chart_zingg(&g.set, path));
    check_same_files(path, whole);
    (void)snprintf(whole, sizeof whole, "%s/pca.svg", out);
    CHECK_OK(clast_chart_pca(&g.statistics, path));
    check_same_files(path, whole);
    (void)snprintf(whole, sizeof whole, "%s/histogram_flatness.svg", out);
    CHECK_OK(clast_chart_histogram(g.set.flatness, g.set.n, "flatness S/I", "-", path));
    check_same_files(path, whole);
    clast_grain_statistics_free(&g);
    clast_table_free(&t);
}

/* Sets that charts trip over: one grain, equal grains, spheres (disc-rod index undefined). */
static void degenerate_sets_are_drawn(void **state)
{
    (void)state;
    static const char *const sets[] = {"FL,EL\n0.5,0.6\n", "FL,EL\n0.5,0.6\n0.5,0.6\n0.5,0.6\n",
                                       "FL,EL\n1,1\n1,1\n",
                                       "FL,EL\n1,1\n0.5,0.7\n0.7,0.5\n1,0.4\n"};
    const char *out = folder("degenerate");
    for (size_t k = 0; k < sizeof sets / sizeof sets[0]; ++k) {
        clast_table t = {0};
        clast_grain_statistics g = {0};
        CHECK_OK(clast_table_parse_csv("grains", sets[k], strlen(sets[k]), NULL, &t, NULL));
        CHECK_OK(clast_grain_statistics_of(&t, NULL, &few, &g));
        CHECK_OK(clast_grain_statistics_write(&g, out, "svg"));
        clast_grain_statistics_free(&g);
        clast_table_free(&t);
    }
}

static void fitted_models_are_drawn(void **state)
{
    (void)state;
    const char *out = folder("fit");
    static char text[8192] = "flatness,elongation,porosity\n";
    clast_porosity_fit_config c;
    clast_table t = {0};
    clast_fit_data d = {0};
    clast_porosity_fit f = {0};
    for (int i = 0; i < 60; ++i) {
        const size_t n = strlen(text);
        const double fl = 0.62 + 0.3 * sin(1.3 * i);
        const double el = 0.7 + 0.2 * cos(2.1 * i);
        (void)snprintf(text + n, sizeof text - n, "%g,%g,%g\n", fl, el,
                       0.278 + 0.019 / (fl * el) + 0.014 / el + 0.006 * sin(i * i));
    }
    CHECK_OK(clast_fields_default(clast_porosity_fit_fields, &c));
    CHECK_OK(clast_table_parse_csv("beds", text, strlen(text), NULL, &t, NULL));
    CHECK_OK(clast_fit_data_single(&t, &c, &d));
    CHECK_OK(clast_porosity_fit_data(&d, "m", "test", &c, &f));
    for (int k = 0; k < CLAST_N_FIT_CHART; ++k) {
        char path[1024];
        (void)snprintf(path, sizeof path, "%s/%s.svg", out,
                       clast_fit_chart_name((clast_fit_chart)k));
        CHECK_OK(clast_chart_fit((clast_fit_chart)k, &d, &f, path));
        assert_int_equal(access(path, R_OK), 0);
    }
    clast_porosity_fit_free(&f);
    clast_fit_data_free(&d);
    clast_table_free(&t);
    clast_fields_free(clast_porosity_fit_fields, &c);
}

/* Lines of a fit before it is made go on with those of the fit. */
static void notes_of_a_fit_come_one_by_one(void **state)
{
    (void)state;
    static const char *const says[] = {
        "1 of 20 rows left out (first: row 20, porosity missing)",
        "1 column of words is no candidate: site",
        "1 of 2 features: no candidate is left of 1 (0 like a chosen one, 0 constant or not finite "
        "in some row)",
        "column 'bed' names the bed and is no candidate",
        "feature 'a' counts the rows; if it says nothing of a bed, name the candidates: --features "
        "columns --columns a,b"};
    static char text[2048] = "a,site,bed,porosity\n";
    clast_porosity_fit_config c;
    clast_table t = {0};
    clast_fit_data d = {0};
    clast_porosity_fit f = {0};
    clast_fit_note note;
    for (int i = 0; i < 20; ++i) {
        const size_t n = strlen(text);
        (void)snprintf(text + n, sizeof text - n, "%d,x%d,%d,%.*g\n", i, i, i + 1, i < 19 ? 6 : 1,
                       i < 19 ? 0.3 + 0.01 * sin(3.0 * i) : (double)NAN);
    }
    CHECK_OK(clast_fields_default(clast_porosity_fit_fields, &c));
    c.n_permutation = 0;
    CHECK_OK(clast_table_parse_csv("beds", text, strlen(text), NULL, &t, NULL));
    CHECK_OK(clast_fit_data_columns(&t, &c, &d));
    CHECK_OK(clast_porosity_fit_data(&d, "m", "test", &c, &f));
    for (int32_t k = 0; k < 6; ++k) {
        assert_int_equal(clast_porosity_fit_note(NULL, &t, &d, k, &c, &note), k < 2);
        assert_int_equal(clast_porosity_fit_note(&f, &t, &d, k, &c, &note), k < 5);
        assert_string_equal(note.text, says[k < 5 ? k : 4]);
        assert_int_equal(note.is_of_table, k != 2);
    }
    clast_porosity_fit_free(&f);
    clast_fit_data_free(&d);
    clast_table_free(&t);
    clast_fields_free(clast_porosity_fit_fields, &c);
}

static const clast_table *study_beds;

static clast_status read_study(void *path)
{
    clast_table grains = {0};
    const clast_status status = clast_study_grains(path, study_beds, "run", &grains);
    clast_table_free(&grains);
    return status;
}

/* A run that failed is left out. Run 1.5 was run 2, and one whose number was missing run nan. */
static void grains_of_a_study_are_those_of_its_runs(void **state)
{
    (void)state;
    static const struct {
        const char *beds, *says; /* NULL: fine */
    } row[] = {
        {"run,exit_code\n2,0\n7,1\n1,0\n,1\n", NULL},
        {"bed,exit_code\n1,0\n", "table results has no column of numbers 'run' that names the run"},
        {"run,exit_code\n1,0\n1.5,0\n",
         "table results, row 2: column 'run' has no number of a run"},
        {"run\n1\nnan\n", "row 2: column 'run' has no number of a run"},
        {"run,exit_code\n1,3\n2,3\n", "ended well"},
        {"run\n3\n", "out/grains.csv: no column is called elongation"},
    };
    static const char *const file[] = {"flatness,elongation\n0.5,0.6\n0.7,0.8\n",
                                       "size,elongation,flatness\n9,0.4,0.3\n", "flatness\n0.3\n"};
    char path[1024];
    const char *const study = folder("study");
    (void)snprintf(path, sizeof path, "%s/runs", study);
    (void)mkdir(path, 0777);
    for (int k = 0; k < 3; ++k) {
        (void)snprintf(path, sizeof path, "%s/runs/%06d", study, k + 1);
        (void)mkdir(path, 0777);
        (void)snprintf(path, sizeof path, "%s/runs/%06d/out", study, k + 1);
        (void)mkdir(path, 0777);
        (void)snprintf(path, sizeof path, "%s/runs/%06d/out/grains.csv", study, k + 1);
        CHECK_OK(clx_file_write_all(path, file[k], strlen(file[k])));
    }
    for (size_t k = 0; k < sizeof row / sizeof *row; ++k) {
        clast_table beds = {0};
        clast_table grains = {0};
        CHECK_OK(
            clast_table_parse_csv("results", row[k].beds, strlen(row[k].beds), NULL, &beds, NULL));
        CHECK_STATUS(clast_study_grains(study, &beds, "run", &grains),
                     row[k].says == NULL ? CLAST_OK : CLAST_E_FORMAT);
        if (row[k].says != NULL) {
            assert_non_null(strstr(clast_error_detail(), row[k].says));
            assert_null(grains.column);
        } else {
            assert_int_equal(grains.n_row, 3);
            CHECK_ABS(clast_table_numbers(&grains, "run")[0], 2.0, 0.0);
            CHECK_ABS(clast_table_numbers(&grains, "elongation")[0], 0.4, 0.0);
            CHECK_ABS(clast_table_numbers(&grains, "run")[2], 1.0, 0.0);
            CHECK_ABS(clast_table_numbers(&grains, "flatness")[2], 0.7, 0.0);
            study_beds = &beds;
            (void)snprintf(path, sizeof path, "%s", study);
            support_refuse_each_allocation(read_study, path);
        }
        clast_table_free(&grains);
        clast_table_free(&beds);
    }
}

/* A heat map of names: each name and each value is in the SVG once as text would be; the file
 * differs from that of the opposite signs. */
static void signs_of_a_correlation_show(void **state)
{
    (void)state;
    char path[2][600];
    char *bytes[2] = {NULL, NULL};
    int64_t n[2] = {0};
    for (int k = 0; k < 2; ++k) {
        clast_table t = {0};
        clast_statistics s = {0};
        const char *text = k == 0 ? "a,b\n1,1\n2,2\n3,2\n4,5\n" : "a,b\n1,5\n2,2\n3,2\n4,1\n";
        CHECK_OK(clast_table_parse_csv("t", text, strlen(text), NULL, &t, NULL));
        CHECK_OK(clast_statistics_of(&t, &few, &s));
        (void)snprintf(path[k], sizeof path[k], "%s/sign%d.svg", support_scratch(), k);
        CHECK_OK(clast_chart_correlation(&s, path[k]));
        CHECK_OK(clx_file_read_all(path[k], 1 << 22, &bytes[k], &n[k]));
        clast_statistics_free(&s);
        clast_table_free(&t);
    }
    assert_false(n[0] == n[1] && memcmp(bytes[0], bytes[1], (size_t)n[0]) == 0);
    clx_free(bytes[0]);
    clx_free(bytes[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stand_in_has_its_stated_moments),
        cmocka_unit_test(every_table_and_chart_is_written),
        cmocka_unit_test(charts_come_one_by_one),
        cmocka_unit_test(degenerate_sets_are_drawn),
        cmocka_unit_test(fitted_models_are_drawn),
        cmocka_unit_test(notes_of_a_fit_come_one_by_one),
        cmocka_unit_test(grains_of_a_study_are_those_of_its_runs),
        cmocka_unit_test(signs_of_a_correlation_show),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
