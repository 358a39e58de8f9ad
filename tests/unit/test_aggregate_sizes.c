/* Unit: sizes, shapes by size, forms of groups, intervals: numbers that can be worked out. */
#include "aggregates.h"

#include "aggregate/form.h"
#include "aggregate/sizes.h"
#include "base/alloc.h"
#include <clast/aggregate_run.h>
#include <clast/grain.h>
#include <clast/mesh.h>
#include <stdio.h>
#include <string.h>

static void default_config(clast_aggregate_config *config)
{
    CHECK_OK(clast_fields_default(clast_aggregate_fields, config));
}

static void lists_are_repeated_and_ordered(void **state)
{
    (void)state;
    clast_aggregate_config c;
    clast_sizes sizes = {0};
    double *size = NULL;
    int32_t n = 0;
    default_config(&c);
    CHECK_OK(clast_sizes_parse("list", "d_um,count\n30,1\n10,2\n20,1\n", "", "", &sizes));
    c.params.replicate = 3;
    c.params.order = CLAST_ORDER_DESCENDING;
    CHECK_OK(clx_sizes_plan(&c.params, &sizes, 1, &size, &n));
    assert_int_equal(n, 12);
    CHECK_REL(size[0], 30e-6, 1e-15);
    CHECK_REL(size[3], 20e-6, 1e-15);
    CHECK_REL(size[11], 10e-6, 1e-15);
    clx_free(size);
    c.params.order = CLAST_ORDER_SHUFFLED;
    CHECK_OK(clx_sizes_plan(&c.params, &sizes, 1, &size, &n));
    double sum = 0.0;
    for (int32_t i = 0; i < n; ++i) {
        sum += size[i];
    }
    CHECK_REL(sum, 3.0 * 70e-6, 1e-14);
    clx_free(size);
    clast_sizes_free(&sizes);
    clast_fields_free(clast_aggregate_fields, &c);
}

static void histograms_are_drawn_by_number_or_mass(void **state)
{
    (void)state;
    clast_aggregate_config c;
    clast_sizes sizes = {0};
    default_config(&c);
    // one bin at 1 mm and one at 2 mm: equal masses mean 8 of 9 grains are small
    CHECK_OK(
        clast_sizes_parse("bins", "low_mm high_mm weight\n1 1 0.5\n2 2 0.5\n", "", "", &sizes));
    c.params.size_draw = true;
    c.params.n_particle = 20000;
    for (int by_mass = 0; by_mass < 2; ++by_mass) {
        double *size = NULL;
        int32_t n = 0;
        double small = 0.0;
        c.params.size_by_mass = by_mass == 1;
        CHECK_OK(clx_sizes_plan(&c.params, &sizes, 7, &size, &n));
        for (int32_t i = 0; i < n; ++i) {
            small += size[i] < 1.5e-3 ? 1.0 : 0.0;
        }
        const double share = by_mass == 1 ? 8.0 / 9.0 : 0.5;
        CHECK_ABS(small / n, share, 5.0 * sqrt(share * (1.0 - share) / n));
        clx_free(size);
    }
    clast_sizes_free(&sizes);
    clast_fields_free(clast_aggregate_fields, &c);
}

/* It said "end the column's name in it (size_mm, Size (mm), phi)" and cut "Size (mm)" at its blank
   where no comma stood in the line. */
static void a_lone_name_holds_its_unit_in_brackets(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double size, count;
    } list[] = {{"Size (mm)\n0.02\n0.04\n", 2e-5, 1.0},
                {"Size (um)\n20\n40\n", 2e-5, 1.0},
                {"Size (\xc2\xb5m)\r\n20\r\n40\r\n", 2e-5, 1.0},
                {"  size [mm]\n0.02\n0.04\n", 2e-5, 1.0},
                {"Size (phi)\n5.643856189774724\n4\n", 2e-5, 1.0},
                {"Size (mm) count\n0.02 3\n0.04 5\n", 2e-5, 3.0},
                {"count Size (mm)\n3 0.02\n5 0.04\n", 2e-5, 3.0},
                {"Size (mean) (mm),count\n0.02,3\n0.04,5\n", 2e-5, 3.0}};
    for (size_t k = 0; k < sizeof list / sizeof list[0]; ++k) {
        clast_sizes sizes = {0};
        CHECK_OK(clast_sizes_parse("list", list[k].text, "", "", &sizes));
        assert_int_equal(sizes.n, 2);
        CHECK_REL(sizes.low[0], list[k].size, 1e-12);
        CHECK_REL(sizes.count[0], list[k].count, 1e-15);
        clast_sizes_free(&sizes);
    }
}

/* Lists had a grammar of their own: lines that end in CR, decimal commas, UTF-16 and long words
   were refused for what they are not. */
static void lists_are_read_as_tables_are(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double count; // of 1 mm and 2 mm together
    } list[] = {{"size_mm;count\r1;3\r2;4\r", 7.0},
                {"\xef\xbb\xbf\"size_mm\",\"count\"\r\n\"1\",3\r\n2,\"4\"", 7.0},
                {"size_mm,count # sieved, dry\n1,3 # first\n\n# then\n2,4# last\n", 7.0},
                {"size_mm # in mm, sieved\n1 # fine\n2\n", 2.0},
                {"size_mm\tcount\t\n1\t3\n2\t4\t\n", 7.0},
                {"size_mm, count\n1 3\n2 4\n", 7.0},
                {"Equivalent diameter (mm)\n1\n2\n", 2.0},
                {"name,size_mm,\"what\nthis is\"\na,1,2\nb,2,3\n", 2.0}};
    for (size_t k = 0; k < sizeof list / sizeof list[0]; ++k) {
        clast_sizes sizes = {0};
        CHECK_OK(clast_sizes_parse("list", list[k].text, "", "", &sizes));
        assert_int_equal(sizes.n, 2);
        CHECK_REL(sizes.low[0] + sizes.high[1], 3e-3, 1e-15);
        CHECK_ABS(sizes.count[0] + sizes.count[1], list[k].count, 0.0);
        clast_sizes_free(&sizes);
    }
    clast_sizes sizes = {0}; // a row that begins with a size is no header
    CHECK_OK(clast_sizes_parse("list", "1,3,a\n2,4,b\n", "", "mm", &sizes));
    assert_true(sizes.n == 2 && sizes.count[0] == 3.0);
    clast_sizes_free(&sizes);
}

static void wrong_lists_are_refused_with_their_line(void **state)
{
    (void)state;
    static const char *const list[][2] = {
        {"size_mm;count\n0,5;3\n", "l:2: '0,5' is not a number"},
        {"size_mm,count\n0,5,3,0\n",
         "l:2: 4 cells where the first row has 2; 1 such rows in all; dec"},
        {"# a\n\nsize_mm count\n1 2 # x\nabc 3\n", "l:5: 'abc' is not a number"},
        {"size_mm,count\n1,3\n\nNA,4\n", "l:4: 'NA' is not a number"},
        {"size_mm\n1e400\n", "l:2: the size '1e400' is not finite"},
        {"size_mm\n1\n-0.50\n", "l:3: the size -0.50 is not above 0"},
        {"size_mm,count\n1,few\n", "l:2: the count 'few' is not a number from 0 up"},
        {"size_mm,density\n1,2\n2,0\n", "l:3: the density '0' is not a number above 0"},
        {"low_mm,high_um\n2.50,1.1\n", "l:2: the size low, 2.50 mm, is above high, 1.1 um"},
        {"a,\"size_mm\",a\n1,2,3\n", "columns 1 and 3 are both called 'a'"},
        {"size_mm,count\n", "no sizes in it"},
        {"\n# a\n", "no row"},
        {"\xff\xfes", "UTF-16"}};
    for (size_t k = 0; k < sizeof list / sizeof list[0]; ++k) {
        clast_sizes sizes = {0};
        CHECK_STATUS(clast_sizes_parse("l", list[k][0], "", "", &sizes), CLAST_E_FORMAT);
        if (strstr(clast_error_detail(), list[k][1]) == NULL) {
            fail_msg("'%s' does not say '%s'", clast_error_detail(), list[k][1]);
        }
        assert_null(sizes.low);
    }
}

/* "density [g/cm3]" and "density mean (kg/m3)" were unknown units. */
static void densities_have_the_unit_of_their_name(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double factor; // 0: refused
    } list[] = {{"density", 1.0},         {"density_g/cm3", 1e3},    {"density (g/cm3)", 1e3},
                {"density [g/cm3]", 1e3}, {"density g/cm3", 1e3},    {"density mean (kg/m3)", 1.0},
                {"density_mean", 1.0},    {"density (lb/ft3)", 0.0}, {"density lb/ft3", 0.0},
                {"density (mm)", 0.0}};
    for (size_t k = 0; k < sizeof list / sizeof list[0]; ++k) {
        clast_sizes sizes = {0};
        char text[80];
        (void)snprintf(text, sizeof text, "size_mm,%s\n1,2.5\n", list[k].name);
        if (list[k].factor > 0.0) {
            CHECK_OK(clast_sizes_parse("list", text, "", "", &sizes));
            CHECK_REL(sizes.density[0], 2.5 * list[k].factor, 1e-15);
        } else {
            CHECK_STATUS(clast_sizes_parse("list", text, "", "", &sizes), CLAST_E_CONFIG);
            assert_non_null(strstr(clast_error_detail(), list[k].name));
            assert_non_null(strstr(clast_error_detail(), "known here: kg/m^3"));
        }
        clast_sizes_free(&sizes);
    }
}

static void sizes_of_a_caller_must_be_above_0(void **state)
{
    (void)state;
    const double bad[][3] = {{0.0, 1e-3, 1.0},         {-1e-3, 1e-3, 1.0},
                             {2e-3, 1e-3, 1.0},        {1e-3, 1e-3, -1.0},
                             {1e-3, (double)NAN, 1.0}, {1e-3, (double)INFINITY, 1.0}};
    clast_aggregate_config c;
    clast_sizes sizes = {0};
    double *size = NULL;
    int32_t n = 0;
    default_config(&c);
    CHECK_OK(clast_sizes_alloc(2, &sizes));
    sizes.low[0] = sizes.high[0] = 1e-3;
    sizes.count[0] = 1.0;
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        sizes.low[1] = bad[k][0];
        sizes.high[1] = bad[k][1];
        sizes.count[1] = bad[k][2];
        CHECK_STATUS(clx_sizes_plan(&c.params, &sizes, 1, &size, &n), CLAST_E_CONFIG);
        assert_null(size);
        assert_non_null(strstr(clast_error_detail(), "sizes: row 2"));
    }
    clast_sizes_free(&sizes);
    clast_fields_free(clast_aggregate_fields, &c);
}

/// Mean of f(size) over many draws of a law.
static void check_law(int32_t law, double mean_of_log, double deviation_of_log)
{
    clast_aggregate_config c;
    double *size = NULL;
    double sum = 0.0;
    double squares = 0.0;
    int32_t n = 0;
    default_config(&c);
    c.params.size_law = law;
    c.params.size_mean = 2e-3;
    c.params.size_deviation = 1e-5;
    c.params.size_shape = law == CLAST_SIZE_WEIBULL ? 2.0 : 0.3;
    c.params.size_low = law <= CLAST_SIZE_LOGUNIFORM ? 1e-3 : 0.0;
    c.params.size_high = law <= CLAST_SIZE_LOGUNIFORM ? 4e-3 : 0.0;
    c.params.n_particle = 40000;
    CHECK_OK(clx_sizes_plan(&c.params, NULL, 3, &size, &n));
    for (int32_t i = 0; i < n; ++i) {
        sum += log(size[i]);
        squares += log(size[i]) * log(size[i]);
    }
    const double mean = sum / n;
    CHECK_ABS(mean, mean_of_log, 5.0 * deviation_of_log / sqrt(n));
    CHECK_REL(sqrt(squares / n - mean * mean), deviation_of_log, 0.03);
    clx_free(size);
    clast_fields_free(clast_aggregate_fields, &c);
}

static void laws_have_their_moments(void **state)
{
    (void)state;
    const double euler = 0.57721566490153286;
    check_law(CLAST_SIZE_LOGUNIFORM, log(2e-3), log(4.0) / sqrt(12.0));
    check_law(CLAST_SIZE_NORMAL, log(2e-3), 5e-3); // narrow: ln is linear
    check_law(CLAST_SIZE_LOGNORMAL, log(2e-3), 0.3);
    check_law(CLAST_SIZE_WEIBULL, log(2e-3) - euler / 2.0, CLAST_PI / sqrt(6.0) / 2.0);
}

static void classes_and_weights_choose_shapes(void **state)
{
    (void)state;
    support_aggregate s;
    support_aggregate_make(&s, NULL, 3, "class_limit=1;class_limit=2");
    assert_int_equal(clx_sizes_shape(&s.config.params, s.config.coat.n, 1, 0, 1.0),
                     0); // a limit belongs to its class
    assert_int_equal(clx_sizes_shape(&s.config.params, s.config.coat.n, 1, 0, 1.5), 1);
    assert_int_equal(clx_sizes_shape(&s.config.params, s.config.coat.n, 1, 0, 9.0), 2);
    support_aggregate_free(&s);
    support_aggregate_make(&s, NULL, 3, "coat_weight=1;coat_weight=0;coat_weight=3");
    int32_t count[3] = {0};
    for (int64_t i = 0; i < 4000; ++i) {
        ++count[clx_sizes_shape(&s.config.params, s.config.coat.n, 1, i, 1.0)];
    }
    assert_int_equal(count[1], 0);
    CHECK_ABS(count[2] / 4000.0, 0.75, 5.0 * sqrt(0.75 * 0.25 / 4000.0));
    support_aggregate_free(&s);
}

static void form_of_groups_is_exact(void **state)
{
    (void)state;
    support_aggregate s;
    clx_templates templates = {0};
    double form[3];
    const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    const double at[3] = {1.0, 2.0, 2.0};
    support_aggregate_make(&s, NULL, 1, "size_meaning=mean_diameter");
    CHECK_OK(clast_assembly_add_grain(&s.core, 0, at, unturned, 2.0, 2500.0));
    CHECK_OK(clx_templates_make(&s.config.params, &s.input, &templates));
    CHECK_OK(clx_form_dimensions(&templates, &templates.group[0], form));
    CHECK_REL(form[0], 3.0 + 0.5 + 1.0, 1e-12); // radii 0.5 and 1, centres 3 apart
    CHECK_REL(form[1], 2.0, 1e-2);              // of points on the spheres
    CHECK_REL(form[2], 2.0, 1e-2);
    CHECK_REL(templates.group[0].length, 4.5, 1e-12);
    CHECK_REL(templates.group[1].mean_diameter, 1.0, 1e-15);
    clx_templates_free(&templates);
    support_aggregate_free(&s);
}

static void meanings_of_size_agree_for_an_ellipsoid(void **state)
{
    (void)state;
    const double axes[1][3] = {{4.0, 2.0, 1.0}};
    const double wanted[] = {4.0, 2.0, 2.0}; // length, volume-equivalent, (L I S)^(1/3)
    support_aggregate s;
    clx_templates templates = {0};
    support_aggregate_make(&s, axes, 1, "size_meaning=mean_diameter");
    CHECK_OK(clx_templates_make(&s.config.params, &s.input, &templates));
    for (int32_t meaning = 0; meaning < 3; ++meaning) {
        CHECK_REL(clx_template_size(&templates.group[1], meaning), wanted[meaning], 1e-14);
    }
    clx_templates_free(&templates);
    support_aggregate_free(&s);
}

/* (L I S)^(1/3) is of the axes that clast shape --axes fitted prints, as help and documents say;
   not of its default, the ellipsoid of equal moments. */
static void mean_diameters_are_of_the_fitted_axes(void **state)
{
    (void)state;
    double point[8][3] = {{0.0, 0.0, 0.0}, {3.0, 0.2, 0.1}, {0.5, 2.0, 0.3},  {0.4, 0.6, 1.4},
                          {2.6, 1.1, 0.9}, {1.2, 1.8, 1.1}, {2.2, -0.4, 0.7}, {1.0, 0.3, -0.5}};
    const clast_mesh points = {.n_vert = 8, .vert = point};
    clast_mesh hull = {0};
    clast_shape rock = {0};
    clast_assembly grain = {0};
    clast_grain measured;
    clx_templates templates = {0};
    support_aggregate s;
    support_aggregate_make(&s, NULL, 1, "size_meaning=mean_diameter");
    CHECK_OK(clast_mesh_hull(&points, &hull));
    CHECK_OK(clast_grain_measure(&hull, &measured));
    CHECK_OK(clast_shape_mesh("rock", &hull, &rock));
    CHECK_OK(clast_assembly_add_shape(&grain, &rock, NULL));
    CHECK_OK(clast_assembly_add_grain(&grain, 0, (double[3]){0.0, 0.0, 0.0},
                                      (double[4]){1.0, 0.0, 0.0, 0.0}, 1.0, 2500.0));
    s.input.coat = &grain;
    CHECK_OK(clx_templates_make(&s.config.params, &s.input, &templates));
    const double *fitted = measured.axes[CLAST_AXES_FITTED].lis;
    const double *equal = measured.axes[CLAST_AXES_ELLIPSOID].lis;
    const double mean = clx_template_size(&templates.group[1], CLAST_SIZE_MEAN);
    CHECK_REL(mean, cbrt(fitted[0] * fitted[1] * fitted[2]), 1e-12);
    assert_true(fabs(mean / cbrt(equal[0] * equal[1] * equal[2]) - 1.0) > 0.05);
    clx_templates_free(&templates);
    support_aggregate_free(&s);
    clast_assembly_free(&grain);
    clast_shape_free(&rock);
    clast_mesh_free(&hull);
}

static void intervals_are_students(void **state)
{
    (void)state;
    const double value[3] = {1.0, 2.0, 6.0};
    const clast_interval i = clast_interval_of(3, value, 0.95);
    CHECK_REL(i.mean, 3.0, 1e-15);
    CHECK_REL(i.deviation, sqrt(7.0), 1e-15);
    CHECK_REL(i.high - i.mean, 4.302652729911275 * sqrt(7.0 / 3.0), 1e-10); // t(0.975, 2)
    const clast_interval one = clast_interval_of(1, value, 0.95);
    assert_true(one.mean == 1.0 && one.deviation == 0.0 && isinf(one.high));
}

static void bands_are_means_over_repeats(void **state)
{
    (void)state;
    clast_table history = {0};
    clast_table band = {0};
    double *n = NULL;
    double *porosity = NULL;
    CHECK_OK(clast_table_init(&history, "history", 5));
    CHECK_OK(clast_table_add_number(&history, "n", "-", NULL));
    CHECK_OK(clast_table_add_number(&history, "porosity_surface_hull", "-", &porosity));
    n = clast_table_numbers(&history, "n");
    for (int i = 0; i < 4; ++i) {
        n[i] = i % 2;
        porosity[i] = 0.1 * i;
    }
    n[4] = 2.0; /* the second repeat alone: no mean of two */
    porosity[4] = 9.0;
    CHECK_OK(clast_aggregate_band(&history, 0.95, &band));
    assert_int_equal(band.n_row, 2);
    assert_true(clast_table_numbers(&band, "n_repeat")[1] == 2.0);
    CHECK_REL(clast_table_numbers(&band, "mean_porosity_surface_hull")[1], 0.2, 1e-14);
    assert_true(clast_table_numbers(&band, "low_porosity_surface_hull")[1] < 0.2);
    clast_table_free(&band);
    clast_table_free(&history);
}

static void take_history(double *size, int n, clast_table *history)
{
    double *step = NULL;
    double *placed = NULL;
    CHECK_OK(clast_table_init(history, "history", n + 1));
    CHECK_OK(clast_table_add_number(history, "n", "-", &step));
    CHECK_OK(clast_table_add_number(history, "size_m", "m", &placed));
    placed[0] = 1.0; /* the core counts for nothing */
    for (int i = 1; i <= n; ++i) {
        step[i] = i;
        placed[i] = size[i - 1];
    }
}

static void wanted_sizes_stand_beside_placed_ones(void **state)
{
    (void)state;
    clast_aggregate_config c;
    clast_sizes sizes = {0};
    clast_table history = {0};
    clast_table table = {0};
    default_config(&c);
    CHECK_OK(clast_sizes_parse("list", "d_um,count\n30,1\n10,2\n10,3\n20,1\n", "", "", &sizes));
    c.params.replicate = 2;
    take_history((double[]){10e-6, 30e-6, 10e-6}, 3, &history); /* stopped early */
    CHECK_OK(clast_aggregate_achieved(&c.params, &sizes, &history, &table));
    assert_int_equal(table.n_row, 3); /* two rows of 10 um are one class */
    const double wanted[] = {10.0, 2.0, 2.0};
    const double placed[] = {2.0, 0.0, 1.0};
    const double finer[] = {2.0 / 3.0, 2.0 / 3.0, 1.0};
    for (int i = 0; i < 3; ++i) {
        CHECK_REL(clast_table_numbers(&table, "wanted")[i], wanted[i], 1e-15);
        CHECK_ABS(clast_table_numbers(&table, "placed")[i], placed[i], 1e-15);
        CHECK_REL(clast_table_numbers(&table, "placed_finer")[i], finer[i], 1e-15);
    }
    CHECK_REL(clast_table_numbers(&table, "wanted_finer")[0], 10.0 / 14.0, 1e-15);
    clast_table_free(&table);
    /* a law: shares of the logarithm of its range, 1/12 to each class */
    c.params.size_law = CLAST_SIZE_LOGUNIFORM;
    c.params.size_low = 10e-6;
    c.params.size_high = 30e-6;
    c.params.n_particle = 60;
    CHECK_OK(clast_aggregate_achieved(&c.params, NULL, &history, &table));
    assert_int_equal(table.n_row, 12);
    CHECK_REL(clast_table_numbers(&table, "wanted")[5], 10.0, 1e-9);
    CHECK_REL(clast_table_numbers(&table, "placed")[0], 2.0, 1e-15);
    CHECK_REL(clast_table_numbers(&table, "placed")[11], 1.0, 1e-15);
    clast_table_free(&table);
    clast_table_free(&history);
    clast_sizes_free(&sizes);
    c.params.size_law = CLAST_SIZE_LIST;
    clast_fields_free(clast_aggregate_fields, &c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_lone_name_holds_its_unit_in_brackets),
        cmocka_unit_test(lists_are_read_as_tables_are),
        cmocka_unit_test(wrong_lists_are_refused_with_their_line),
        cmocka_unit_test(densities_have_the_unit_of_their_name),
        cmocka_unit_test(lists_are_repeated_and_ordered),
        cmocka_unit_test(histograms_are_drawn_by_number_or_mass),
        cmocka_unit_test(sizes_of_a_caller_must_be_above_0),
        cmocka_unit_test(laws_have_their_moments),
        cmocka_unit_test(classes_and_weights_choose_shapes),
        cmocka_unit_test(form_of_groups_is_exact),
        cmocka_unit_test(meanings_of_size_agree_for_an_ellipsoid),
        cmocka_unit_test(mean_diameters_are_of_the_fitted_axes),
        cmocka_unit_test(intervals_are_students),
        cmocka_unit_test(bands_are_means_over_repeats),
        cmocka_unit_test(wanted_sizes_stand_beside_placed_ones),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
