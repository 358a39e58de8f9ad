/* Unit: what a chart shows, checked in its SVG text and by its bytes. */
#include "support.h"

#include "plot/figure.h"
#include <cairo.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { N = 50 };

static void fill(double *x, double *y, double *low, double *high)
{
    for (int i = 0; i < N; ++i) {
        x[i] = 1.0 + 15.0 * i;
        y[i] = 0.8 - 0.7 * exp(-i / 12.0);
        low[i] = y[i] - 0.05;
        high[i] = y[i] + 0.05;
    }
}

/// Draws into a file, or into memory where there is no path.
static clast_status write_history(const char *path, unsigned char **bytes, size_t *n)
{
    double x[N], y[N], low[N], high[N];
    fill(x, y, low, high);
    const double mark[] = {0.73};
    const char *const mark_label[] = {"published, 0.73"};
    const clast_series series[] = {
        {CLAST_SERIES_BAND, "95 % interval of 8 repeats", x, NULL, low, high, NULL, N, 0, false,
         0.0},
        {CLAST_SERIES_LINE, "mean", x, y, NULL, NULL, NULL, N, 0, false, 0.0},
        {CLAST_SERIES_POINTS, "observed", x, high, low, high, NULL, 5, 1, false, 0.0}};
    const clast_chart chart = {.title = "Porosity while the aggregate grows",
                               .x = {.label = "particles (-)"},
                               .y = {.label = "porosity (-)"},
                               .series = series,
                               .n_series = 3,
                               .mark_y = mark,
                               .mark_label = mark_label,
                               .n_mark = 1};
    return path ? clast_chart_write(&chart, path) : clast_chart_svg(&chart, bytes, n);
}

static clast_status write_heat(const char *path)
{
    double value[600];
    for (int i = 0; i < 600; ++i) {
        value[i] = pow(10.0, (i % 30) / 10.0 - (i / 30) / 20.0);
    }
    value[37] = NAN;
    const clast_heat heat = {.n_x = 30, .n_y = 20, .value = value, .x_high = 3.0, .y_high = 2.0};
    const clast_chart chart = {.title = "Heat",
                               .x = {.label = "x (m)"},
                               .y = {.label = "y (m)"},
                               .value_axis = {.label = "count (-)", .log = true},
                               .heat = &heat,
                               .equal = true};
    return clast_chart_write(&chart, path);
}

static void ticks_are_round_numbers(void **state)
{
    (void)state;
    clx_ticks t;
    clx_ticks_make(0.103, 0.777, false, true, 5, &t);
    CHECK_ABS(t.low, 0.1, 1e-12);
    CHECK_ABS(t.high, 0.8, 1e-12);
    assert_string_equal(t.label[0], "0.1");
    clx_ticks_make(3e-6, 4e-3, true, true, 6, &t);
    assert_int_equal(t.n, 5);
    assert_string_equal(t.label[0], "1e-06");
    CHECK_ABS(clx_ticks_place(&t, 1e-4), 0.5, 1e-12);
    clx_ticks_make(2.0, 7.0, true, true, 6, &t);
    assert_string_equal(t.label[0], "2");
    assert_string_equal(t.label[1], "5");
    // 125, 250 and 500 points had one label, and the first and the last lay on the frame
    clx_ticks_make(125.0, 500.0, true, true, 6, &t);
    assert_int_equal(t.n, 2);
    assert_string_equal(t.label[1], "500");
    assert_true(t.low < 124.0 && t.high > 504.0);
    clx_ticks_make(110.0, 190.0, true, false, 4, &t); // had none
    assert_int_equal(t.n, 4);
    assert_string_equal(t.label[0], "120");
    assert_string_equal(t.label[3], "180");
}

static size_t read_file(const char *path, char *bytes, size_t size)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t n = fread(bytes, 1, size, file);
    fclose(file);
    return n;
}

static void charts_come_in_three_formats_with_equal_bytes(void **state)
{
    (void)state;
    static char a[1 << 20], b[1 << 20];
    const char *const names[] = {"a.svg", "a.pdf", "a.png"};
    const char *const magic[] = {"<?xml", "%PDF", "\x89PNG"};
    for (int i = 0; i < 3; ++i) {
        char path[512];
        snprintf(path, sizeof path, "%s/%s", support_scratch(), names[i]);
        CHECK_OK(write_history(path, NULL, NULL));
        const size_t n = read_file(path, a, sizeof a);
        CHECK_OK(write_history(path, NULL, NULL));
        assert_int_equal(read_file(path, b, sizeof b), n);
        assert_memory_equal(a, b, n);
        assert_memory_equal(a, magic[i], strlen(magic[i]));
    }
    unsigned char *svg = NULL;
    size_t n_svg = 0;
    CHECK_OK(write_history(NULL, &svg, &n_svg));
    char path[512];
    snprintf(path, sizeof path, "%s/a.svg", support_scratch());
    assert_int_equal(read_file(path, a, sizeof a), n_svg);
    assert_memory_equal(a, svg, n_svg);
    clast_chart_bytes_free(svg);
}

/* Pixels of a chart that are no grey: its points. */
static int64_t coloured(const char *path)
{
    cairo_surface_t *image = cairo_image_surface_create_from_png(path);
    assert_int_equal(cairo_surface_status(image), CAIRO_STATUS_SUCCESS);
    const unsigned char *byte = cairo_image_surface_get_data(image);
    int64_t n = 0;
    for (int y = 0; y < cairo_image_surface_get_height(image); ++y) {
        for (int x = 0; x < cairo_image_surface_get_width(image); ++x) {
            const unsigned char *p = byte + y * cairo_image_surface_get_stride(image) + 4L * x;
            n += p[0] > p[2] + 60 || p[2] > p[0] + 60 ? 1 : 0;
        }
    }
    cairo_surface_destroy(image);
    return n;
}

static int64_t coloured_with_point(double x, double y)
{
    char path[512];
    snprintf(path, sizeof path, "%s/point.png", support_scratch());
    const clast_series series = {.kind = CLAST_SERIES_POINTS, .x = &x, .y = &y, .n = 1};
    const clast_chart chart = {.x = {.low = 0.0, .high = 1.0},
                               .y = {.low = 0.0, .high = 1.0},
                               .series = &series,
                               .n_series = 1};
    CHECK_OK(clast_chart_write(&chart, path));
    return coloured(path);
}

/* Half of each was cut off; the frame's own line, half a point wide, lies on them. */
static void points_on_the_frame_are_whole(void **state)
{
    (void)state;
    const double inside = (double)coloured_with_point(0.37, 0.43);
    assert_true(inside > 80.0); /* radius 3 points of two pixels: 113 */
    for (int k = 0; k < 4; ++k) {
        const double part = (double)coloured_with_point(k % 2, k / 2) / inside;
        assert_true(part > 0.6 && part <= 1.1);
    }
    assert_int_equal(coloured_with_point(1.001, 0.5), 0);
    assert_int_equal(coloured_with_point(0.5, -0.001), 0);
}

/* Pixels that are no grey in the left or right half, above or below the middle. */
static int64_t coloured_quarter(const char *path, bool right, bool below)
{
    cairo_surface_t *image = cairo_image_surface_create_from_png(path);
    assert_int_equal(cairo_surface_status(image), CAIRO_STATUS_SUCCESS);
    const unsigned char *byte = cairo_image_surface_get_data(image);
    const int half[2] = {cairo_image_surface_get_width(image) / 2,
                         cairo_image_surface_get_height(image) / 2};
    int64_t n = 0;
    for (int y = below ? half[1] : 0; y < (below ? 2 : 1) * half[1]; ++y) {
        for (int x = right ? half[0] : 0; x < (right ? 2 : 1) * half[0]; ++x) {
            const unsigned char *p = byte + y * cairo_image_surface_get_stride(image) + 4L * x;
            n += p[0] > p[2] + 30 || p[2] > p[0] + 30 ? 1 : 0;
        }
    }
    cairo_surface_destroy(image);
    return n;
}

/* A lower bound was a bar from the axis up to it, over the values that it rules out. */
static void bars_of_one_end_are_open_at_the_other(void **state)
{
    (void)state;
    const char *path = support_scratch_file("bound.png");
    const double x[2] = {0.2, 0.8};
    const double y[2] = {0.95, 0.05};
    const double low[2] = {0.7, NAN};
    const double high[2] = {NAN, 0.3};
    clast_series series = {
        .kind = CLAST_SERIES_POINTS, .x = x, .y = y, .low = low, .high = high, .n = 2};
    const clast_chart chart = {.x = {.low = 0.0, .high = 1.0},
                               .y = {.low = 0.0, .high = 1.0},
                               .series = &series,
                               .n_series = 1};
    CHECK_OK(clast_chart_write(&chart, path));
    const int64_t n = coloured_quarter(path, false, false);
    assert_true(n > 150);
    assert_int_equal(coloured_quarter(path, false, true), 0);
    assert_int_equal(coloured_quarter(path, true, false), 0);
    assert_true(coloured_quarter(path, true, true) > 150);
    const double none[2] = {NAN, NAN};
    series.low = none;
    series.high = none;
    CHECK_OK(clast_chart_write(&chart, path));
    assert_true(coloured_quarter(path, false, false) < n - 50);
}

/* The polygon went on over the missing value of one side alone. */
static void bands_part_where_a_value_is_missing(void **state)
{
    (void)state;
    const char *path = support_scratch_file("band.png");
    const double x[8] = {0.0, 0.1, 0.2, 0.3, 0.7, 0.8, 0.9, 1.0};
    const double low[8] = {0.6, 0.6, 0.6, 0.0, 0.0, 0.6, 0.6, 0.6};
    const double high[8] = {0.9, 0.9, 0.9, NAN, NAN, 0.9, 0.9, 0.9};
    const clast_series series = {
        .kind = CLAST_SERIES_BAND, .x = x, .low = low, .high = high, .n = 8};
    const clast_chart chart = {.x = {.low = 0.0, .high = 1.0},
                               .y = {.low = 0.0, .high = 1.0},
                               .series = &series,
                               .n_series = 1};
    CHECK_OK(clast_chart_write(&chart, path));
    for (int right = 0; right < 2; ++right) {
        assert_true(coloured_quarter(path, right, false) > 1000);
        assert_int_equal(coloured_quarter(path, right, true), 0);
    }
}

/* The last step of sizes.svg, at 80 um, lay on the frame: an end along which a line runs gets room,
 * one that it only meets does not. */
static void lines_along_the_frame_get_room(void **state)
{
    (void)state;
    const double x[] = {30.0, 50.0, 80.0};
    const double y[] = {0.25, 0.5, 1.0};
    const double flat[] = {0.0, 1.0, 1.0};
    clast_series series = {.kind = CLAST_SERIES_STEP, .x = x, .y = y, .n = 3};
    clast_chart chart = {.series = &series, .n_series = 1};
    clx_figure f = {.chart = &chart};
    CHECK_OK(clx_figure_measure(&f));
    assert_true(f.x.high > 81.0 && f.x.high < 82.0);
    CHECK_ABS(f.x.low, 30.0, 1e-12);
    CHECK_ABS(f.y.high, 1.0, 1e-12); /* one point only */
    series.kind = CLAST_SERIES_LINE;
    CHECK_OK(clx_figure_measure(&f));
    CHECK_ABS(f.x.high, 80.0, 1e-12);
    series.y = flat; /* a plateau at the top */
    CHECK_OK(clx_figure_measure(&f));
    CHECK_ABS(f.y.high, 1.03, 1e-12);
    CHECK_ABS(f.y.low, 0.0, 1e-12);
    chart.y.high = 1.0; /* a range that was asked for stays */
    CHECK_OK(clx_figure_measure(&f));
    CHECK_ABS(f.y.high, 1.0, 1e-12);
}

/* The energies of a bed stood as 1e-06 J, its stresses as 25000 Pa, sizes of a deposit as 2e-05 m.
 */
static void axes_have_the_prefix_that_a_person_writes(void **state)
{
    (void)state;
    static const struct {
        const char *label, *title, *last;
        double most;
        bool log;
    } axes[] = {{"stress (Pa)", "stress (kPa)", "25", 25000.0, false},
                {"energy (J)", "energy (\302\265J)", "100", 1e-4, true},
                {"size (m)", "size (\302\265m)", "40", 4e-5, false},
                {"mass (kg)", "mass (mg)", "5", 5e-6, false},
                {"time (s)", "time (s)", "0.10", 0.1, false},
                {"time (s)", "time (s)", "50000", 5e4, false},
                {"stress (Pa)", "stress (Pa)", "8000", 8000.0, false},
                {"density (1/m)", "density (1/m)", "0.0005", 5e-4, false}};
    for (size_t k = 0; k < sizeof axes / sizeof *axes; ++k) {
        const double x[2] = {0.0, 1.0};
        const double y[2] = {axes[k].log ? 1e-3 * axes[k].most : 0.0, axes[k].most};
        const clast_series line = {.kind = CLAST_SERIES_LINE, .x = x, .y = y, .n = 2};
        const clast_chart chart = {.x = {.label = "x (-)"},
                                   .y = {.label = axes[k].label, .log = axes[k].log},
                                   .series = &line,
                                   .n_series = 1};
        clx_figure f = {.chart = &chart};
        CHECK_OK(clx_figure_measure(&f));
        assert_string_equal(f.y.title, axes[k].title);
        assert_string_equal(f.y.label[f.y.n - 1], axes[k].last);
        CHECK_REL(f.y.at[f.y.n - 1], axes[k].most, 1e-12);
    }
    const double x[2] = {0.0, 0.05};
    const double y[2] = {0.0, 0.002};
    const clast_series line = {.kind = CLAST_SERIES_LINE, .x = x, .y = y, .n = 2};
    const clast_chart map = {.x = {.label = "x (m)"},
                             .y = {.label = "y (m)"},
                             .series = &line,
                             .n_series = 1,
                             .equal = true};
    clx_figure f = {.chart = &map};
    CHECK_OK(clx_figure_measure(&f)); // one unit for both axes of a map
    assert_string_equal(f.y.title, "y (m)");
}

static void heat_maps_have_a_colour_bar(void **state)
{
    (void)state;
    char path[512];
    snprintf(path, sizeof path, "%s/heat.png", support_scratch());
    CHECK_OK(write_heat(path));
}

/* The axis of sizes without a unit said "sieve size". */
static void histograms_tell_a_unit(void **state)
{
    (void)state;
    static const char *const unit[2] = {"", "model units"};
    static char bytes[2][1 << 17];
    size_t n[2];
    double x[N], y[N], low[N], high[N];
    fill(x, y, low, high);
    for (int i = 0; i < 2; ++i) {
        char path[512];
        snprintf(path, sizeof path, "%s/unit-%d.svg", support_scratch(), i);
        CHECK_OK(clast_chart_histogram(y, N, "sieve size", unit[i], path));
        n[i] = read_file(path, bytes[i], sizeof bytes[i]);
    }
    assert_int_equal(n[0], n[1]);
    assert_memory_equal(bytes[0], bytes[1], n[0]);
}

static void empty_axis_and_unknown_format_are_refused(void **state)
{
    (void)state;
    const double nan[2] = {NAN, NAN};
    const clast_series series = {.kind = CLAST_SERIES_LINE, .x = nan, .y = nan, .n = 2};
    const clast_chart chart = {.x = {.label = "x"}, .series = &series, .n_series = 1};
    CHECK_STATUS(clast_chart_write(&chart, "never.svg"), CLAST_E_USAGE);
    assert_non_null(strstr(clast_error_detail(), "'x' has no finite"));
    CHECK_STATUS(write_history("never.gif", NULL, NULL), CLAST_E_USAGE);
    CHECK_STATUS(write_history("/nowhere/at/all.svg", NULL, NULL), CLAST_E_DISK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ticks_are_round_numbers),
        cmocka_unit_test(lines_along_the_frame_get_room),
        cmocka_unit_test(charts_come_in_three_formats_with_equal_bytes),
        cmocka_unit_test(points_on_the_frame_are_whole),
        cmocka_unit_test(bars_of_one_end_are_open_at_the_other),
        cmocka_unit_test(bands_part_where_a_value_is_missing),
        cmocka_unit_test(axes_have_the_prefix_that_a_person_writes),
        cmocka_unit_test(heat_maps_have_a_colour_bar),
        cmocka_unit_test(histograms_tell_a_unit),
        cmocka_unit_test(empty_axis_and_unknown_format_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
