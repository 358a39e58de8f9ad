/* Unit: what a report page holds, and what it refuses. */
#include "support.h"

#include "base/file.h"
#include "report/page.h"
#include "report/view3d.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { N_GRAIN = 60, N_REPEAT = 3 };

static char *text_of(const char *path)
{
    char *text = NULL;
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    assert_int_equal(fseek(file, 0, SEEK_END), 0);
    const long n = ftell(file);
    rewind(file);
    text = calloc((size_t)n + 1, 1);
    assert_non_null(text);
    assert_int_equal(fread(text, 1, (size_t)n, file), n);
    (void)fclose(file);
    return text;
}

static void put(const char *folder, const char *name, const char *text)
{
    char path[1024];
    (void)snprintf(path, sizeof path, "%s/%s", folder, name);
    CHECK_OK(clx_file_write_all(path, text, strlen(text)));
}

static const char *folder_of(const char *name)
{
    static char path[4][1024];
    static int k = 0;
    char *at = path[k++ % 4];
    (void)snprintf(at, sizeof path[0], "%s/%s", support_scratch(), name);
    CHECK_OK(clx_folder_make(at));
    return at;
}

/// Balls and boxes on a spiral, by a box as the core.
static void make_assembly(const char *shape_name, clast_assembly *assembly)
{
    clast_shape ball = {0};
    clast_shape box = {0};
    clast_mesh mesh = {0};
    CHECK_OK(clast_shape_sphere("ball", 1e-5, &ball));
    CHECK_OK(clast_mesh_box(2e-5, 1.5e-5, 1e-5, &mesh));
    CHECK_OK(clast_shape_mesh(shape_name, &mesh, &box));
    CHECK_OK(clast_assembly_add_shape(assembly, &ball, NULL));
    CHECK_OK(clast_assembly_add_shape(assembly, &box, NULL));
    for (int i = 0; i < N_GRAIN; ++i) {
        const double r = i == 0 ? 0.0 : 4e-5 + 1e-5 * sqrt(i);
        const double position[3] = {r * cos(2.4 * i), r * sin(2.4 * i), r * sin(0.7 * i)};
        const double turn[4] = {cos(0.3 * i), sin(0.3 * i), 0.0, 0.0};
        CHECK_OK(clast_assembly_add_grain(assembly, i % 2, position, turn,
                                          i == 0 ? 4.0 : 0.5 + 0.02 * i, 2650.0));
    }
    memcpy(assembly->unit, "m", 2);
    clast_mesh_free(&mesh);
    clast_shape_free(&box);
    clast_shape_free(&ball);
}

static void put_history(const char *folder)
{
    char path[1024];
    FILE *file = NULL;
    (void)snprintf(path, sizeof path, "%s/history.csv", folder);
    file = fopen(path, "w");
    assert_non_null(file);
    (void)fprintf(file, "repeat,n,size_m,d_agg_m,density_kg/m^3,porosity_sphere_rays,"
                        "porosity_surface_hull\n");
    for (int r = 0; r < N_REPEAT; ++r) {
        for (int i = 0; i < N_GRAIN; ++i) {
            const double p = 0.7 * (1.0 - exp(-i / 9.0)) + 0.01 * r;
            (void)fprintf(file, "%d,%d,%g,%g,%g,%g,%g\n", r, i, 1e-5 * (1.0 + (i * 7 % 13)),
                          1e-4 + 2e-6 * i, 2650.0 * (1.0 - p), p, 0.8 * p);
        }
    }
    (void)fclose(file);
}

static const char summary[] =
    "{\"n_grain\": 60, \"mass\": 1.5e-8, \"solid_sum\": 5.6e-12, \"envelope\": {\"sphere_rays\": "
    "2e-11, \"surface_hull\": 1.4e-11}, \"porosity\": {\"sphere_rays\": 0.7231, \"surface_hull\": "
    "0.601}, \"d_agg\": 3.37e-4, \"density\": 734.5, \"radius_of_gyration\": 1.21e-4, \"wall_s\": "
    "0.71, \"repeats\": [{\"n_grain\": 60, \"porosity\": {\"sphere_rays\": 0.71}}, {\"n_grain\": "
    "60, \"porosity\": {\"sphere_rays\": 0.73}}]}";

static const char manifest[] =
    "{\"format\": \"clast manifest\", \"clast_version\": \"0.1.0\", \"command\": \"aggregate\", "
    "\"command_line\": [\"clast\", \"aggregate\", \"my run.yaml\"], \"outcome\": \"done\", "
    "\"seed\": 18446744073709551615, \"config\": {\"cone\": 0.87, \"coat\": [\"a.stl\", "
    "\"b.stl\"]}, \"inputs\": [{\"role\": \"core\", \"path\": \"core.stl\", \"bytes\": 684, "
    "\"sha256\": \"e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855\"}], "
    "\"host\": {\"system\": \"Linux\", \"cores\": 2}, \"started\": \"2026-01-01T00:00:00Z\"}";

static const char *make_run(const char *name, const char *shape_name)
{
    const char *folder = folder_of(name);
    char path[1024];
    clast_assembly assembly = {0};
    make_assembly(shape_name, &assembly);
    (void)snprintf(path, sizeof path, "%s/state.h5", folder);
    CHECK_OK(clast_state_write_assembly(&assembly, path, NULL));
    clast_assembly_free(&assembly);
    put(folder, "summary.json", summary);
    put(folder, "manifest.json", manifest);
    put_history(folder);
    return folder;
}

static void check_has(const char *page, const char *part)
{
    if (strstr(page, part) == NULL) {
        fail_msg("the page lacks: %s", part);
    }
}

static void check_lacks(const char *page, const char *part)
{
    if (strstr(page, part) != NULL) {
        fail_msg("the page holds: %s", part);
    }
}

static void page_shows_every_part_of_a_run(void **state)
{
    (void)state;
    const char *folder = make_run("whole", "box");
    char path[1024];
    CHECK_OK(clast_report_write_run(folder, NULL));
    (void)snprintf(path, sizeof path, "%s/report.html", folder);
    char *page = text_of(path);
    check_has(page, "<title>whole</title>");
    check_has(page, ">0.7231</span>");
    check_has(page, "kg/m\302\263");
    check_has(page, "sphere rays");
    check_has(page, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    check_has(page, "half-angle");
    check_has(page, "&#39;my run.yaml&#39;");
    check_has(page, ">18446744073709551615<");
    check_has(page, ">337.0\302\240");
    check_has(page, "<a href=\"history.csv\">");
    check_has(page, "id=\"r0-history-glyph");
    check_has(page, "href=\"#r0-sizes-glyph");
    check_has(page, "class=\"view-data\"");
    check_has(page, "\"n_grain\": 60, \"n_shown\": 60");
    // As in the picture, which is logarithmic from a factor 4 on; here it is 8.0. The view began
    // at 8.
    check_has(page, "\"size\": {\"title\": \"equivalent diameter (\302\265m)\", \"log\": true");
    check_has(page, "\"50\"]");
    check_has(
        page,
        "\"order\": {\"title\": \"order of arrival\", \"log\": false, \"low\": 1, \"high\": 60");
    check_has(page, "</html>");
    check_lacks(page, "<?xml");
    check_lacks(page, "src=\"http");
    free(page);
}

static void two_runs_are_compared(void **state)
{
    (void)state;
    const char *runs[] = {make_run("first", "box"), make_run("second", "box")};
    char path[1024];
    (void)snprintf(path, sizeof path, "%s/both.html", support_scratch());
    CHECK_OK(clast_report_write(runs, 2, path, NULL));
    char *page = text_of(path);
    check_has(page, "Side by side");
    check_has(page, "<a href=\"#run-1\">first</a>");
    check_has(page, "<a href=\"#run-2\">second</a>");
    check_has(page, "id=\"r2-history-glyph");
    check_has(page, "<a href=\"first/history.csv\">");
    check_has(page, "id=\"all-glyph");
    free(page);
}

/* Names, keys, values and cells of a hostile run folder are text and nothing else. */
static void nothing_from_files_becomes_markup(void **state)
{
    (void)state;
    const char *folder = make_run("evil<script>alert(1)", "</script><b>");
    char path[1024];
    put(folder, "summary.json",
        "{\"n_grain\": 1, \"<img src=x onerror=a()>\": \"\\\"><script>x()</script>\", "
        "\"porosity\": "
        "{\"<i>\": 0.5}, \"list\": [{\"<u>\": \"</td>\"}]}");
    put(folder, "manifest.json",
        "{\"command\": \"<svg onload=y()>\", \"config\": {\"<s>\": \"<a>\"}, \"inputs\": "
        "[{\"role\": "
        "\"'\\\"&\"}], \"command_line\": [\"<q>\", 3]}");
    put(folder, "x<script>.csv", "a,<em>\n<mark>,\"</table>\"\n");
    put(folder, "p\" onerror=z() \".svg",
        "<svg xmlns='http://www.w3.org/2000/svg'><script/></svg>");
    (void)snprintf(path, sizeof path, "%s/evil.html", support_scratch());
    CHECK_OK(clast_report_write(
        &folder, 1, path,
        &(clast_report_config){
            .title = "<h1>&", .rows = 5, .view = true, .triangles = 1000, .picture_mb = 1}));
    char *page = text_of(path);
    // The page's own script comes last; what is before it came from the run.
    char *own = strstr(page, "<footer>");
    assert_non_null(own);
    *own = '\0';
    static const char *const bad[] = {
        "<img src=x", "<script>", "<svg onload", "<i>",  "<u>",          "<s>",        "<a>",
        "<q>",        "<em>",     "<mark>",      "<b>x", "</script><b>", "\" onerror", "<h1>&<"};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k) {
        check_lacks(page, bad[k]);
    }
    check_has(page, "&lt;img src=x onerror=a()&gt;");
    check_has(page, "\\u003c/script\\u003e");
    check_has(page, "x%3Cscript%3E.csv");
    free(page);
}

static char *escaped(const char *text)
{
    char path[1024];
    clx_file file = {0};
    (void)snprintf(path, sizeof path, "%s/escaped", support_scratch());
    CHECK_OK(clx_file_begin(path, &file));
    clx_page_text(&file, text);
    CHECK_OK(clx_file_commit(&file));
    return text_of(path);
}

static void escaping_keeps_text_and_replaces_bytes_that_are_none(void **state)
{
    (void)state;
    static const struct {
        const char *in, *out;
    } cases[] = {
        {"a<b>&\"'", "a&lt;b&gt;&amp;&quot;&#39;"},
        {"\302\265m \342\202\254 \360\237\230\200", "\302\265m \342\202\254 \360\237\230\200"},
        {"\001\177", "\357\277\275\357\277\275"},
        {"\300\257", "\357\277\275\357\277\275"},                 // overlong '/'
        {"\355\240\200", "\357\277\275\357\277\275\357\277\275"}, // surrogate
        {"x\342\202", "x\357\277\275\357\277\275"}};              // cut short
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        char *out = escaped(cases[k].in);
        assert_string_equal(out, cases[k].out);
        free(out);
    }
}

/* Vectors of RFC 4648 section 10. */
static void base64_is_that_of_the_rfc(void **state)
{
    (void)state;
    static const char *const out[] = {"",         "Zg==",     "Zm8=",    "Zm9v",
                                      "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
    for (size_t n = 0; n < 7; ++n) {
        char path[1024];
        clx_file file = {0};
        (void)snprintf(path, sizeof path, "%s/base64", support_scratch());
        CHECK_OK(clx_file_begin(path, &file));
        clx_page_base64(&file, "foobar", n);
        CHECK_OK(clx_file_commit(&file));
        char *text = text_of(path);
        assert_string_equal(text, out[n]);
        free(text);
    }
}

static void view_is_simplified_to_its_budget(void **state)
{
    (void)state;
    const double axes[3] = {3.0, 2.0, 1.0};
    clast_mesh fine = {0};
    clast_mesh simple = {0};
    CHECK_OK(clast_mesh_ellipsoid(axes, 5, &fine));
    CHECK_OK(clx_view3d_simplify(&fine, 1000, &simple));
    assert_in_range(simple.n_tri, 400, 1000);
    CHECK_REL(clast_mesh_volume(&simple), 8.0 * CLAST_PI, 0.1);
    clast_mesh_free(&simple);
    clast_mesh_free(&fine);
}

/* A notebook's frame: the view and the policy, no run. */
static void view_alone_is_a_page(void **state)
{
    (void)state;
    clast_assembly assembly = {0};
    clast_assembly empty = {0};
    char path[1024];
    (void)snprintf(path, sizeof path, "%s/view.html", support_scratch());
    make_assembly("</script><b>", &assembly);
    CHECK_OK(clast_report_write_view(&assembly, path, NULL));
    char *page = text_of(path);
    check_has(page, "<title>clast</title>");
    check_has(page, "Content-Security-Policy");
    check_has(page, "\"n_grain\": 60, \"n_shown\": 60");
    check_has(page, "</html>");
    check_lacks(page, "<b>");
    free(page);
    CHECK_STATUS(clast_report_write_view(&empty, path, NULL), CLAST_E_GEOMETRY);
    clast_assembly_free(&assembly);
}

static void folder_without_summary_is_refused(void **state)
{
    (void)state;
    const char *folder = folder_of("bare");
    char path[1024];
    (void)snprintf(path, sizeof path, "%s/none.html", support_scratch());
    CHECK_STATUS(clast_report_write(&folder, 1, path, NULL), CLAST_E_IO);
    assert_non_null(strstr(clast_error_detail(), "has no summary.json"));
    assert_null(fopen(path, "r"));
    put(folder, "summary.json", "{\"n_grain\": 1,\n oops}");
    CHECK_STATUS(clast_report_write(&folder, 1, path, NULL), CLAST_E_FORMAT);
    assert_non_null(strstr(clast_error_detail(), "summary.json:2:"));
    put(folder, "summary.json", "[1]");
    CHECK_STATUS(clast_report_write(&folder, 1, path, NULL), CLAST_E_FORMAT);
    put(folder, "summary.json", "{}");
    put(folder, "state.h5", "no HDF5");
    CHECK_STATUS(clast_report_write(&folder, 1, path, NULL), CLAST_E_FORMAT);
    assert_null(fopen(path, "r"));
}

static void charts_are_written_for_the_tables_that_fit(void **state)
{
    (void)state;
    const char *folder = make_run("charts", "box");
    char path[1024];
    clast_table history = {0};
    (void)snprintf(path, sizeof path, "%s/history.csv", folder);
    CHECK_OK(clast_table_read_csv(path, NULL, &history, NULL));
    CHECK_OK(clast_aggregate_charts_write(&history, NULL, folder));
    for (int k = 0; k < CLAST_AGGREGATE_CHART_RADIAL; ++k) {
        (void)snprintf(path, sizeof path, "%s/%s.svg", folder,
                       clast_aggregate_chart_name((clast_aggregate_chart)k));
        char *svg = text_of(path);
        check_has(svg, "<svg");
        free(svg);
    }
    assert_false(clast_aggregate_chart_fits(CLAST_AGGREGATE_CHART_RADIAL, &history));
    CHECK_STATUS(clast_aggregate_chart_write(CLAST_AGGREGATE_CHART_RADIAL, &history, NULL, path),
                 CLAST_E_FORMAT);
    CHECK_STATUS(clast_aggregate_chart_write(CLAST_AGGREGATE_CHART_SIZES, &history, &history, path),
                 CLAST_E_FORMAT);
    clast_table_free(&history);
}

static clast_status draw_sizes(void *context)
{
    unsigned char *bytes = NULL;
    size_t n = 0;
    const clast_status status =
        clast_aggregate_chart_svg(CLAST_AGGREGATE_CHART_POROSITY, context, NULL, &bytes, &n);
    clast_chart_bytes_free(bytes);
    return status;
}

static clast_status write_small(void *context)
{
    clx_file file = {0};
    char path[1024];
    (void)snprintf(path, sizeof path, "%s/small", support_scratch());
    clast_status status = clx_file_begin(path, &file);
    if (status == CLAST_OK) {
        status = clx_view3d_write(&file, context, NULL, NULL, 1000);
    }
    clx_file_abandon(&file);
    return status;
}

static void refused_memory_leaves_nothing(void **state)
{
    (void)state;
    clast_table table = {0};
    clast_assembly assembly = {0};
    double *n = NULL;
    double *porosity = NULL;
    CHECK_OK(clast_table_init(&table, "history", 3));
    CHECK_OK(clast_table_add_number(&table, "n", "-", &n));
    CHECK_OK(clast_table_add_number(&table, "porosity_rays", "-", &porosity));
    n = clast_table_numbers(&table, "n");
    for (int i = 0; i < 3; ++i) {
        n[i] = i;
        porosity[i] = 0.1 * i;
    }
    support_refuse_each_allocation(draw_sizes, &table);
    make_assembly("box", &assembly);
    support_refuse_each_allocation(write_small, &assembly);
    clast_assembly_free(&assembly);
    clast_table_free(&table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(page_shows_every_part_of_a_run),
        cmocka_unit_test(two_runs_are_compared),
        cmocka_unit_test(nothing_from_files_becomes_markup),
        cmocka_unit_test(escaping_keeps_text_and_replaces_bytes_that_are_none),
        cmocka_unit_test(base64_is_that_of_the_rfc),
        cmocka_unit_test(view_is_simplified_to_its_budget),
        cmocka_unit_test(view_alone_is_a_page),
        cmocka_unit_test(folder_without_summary_is_refused),
        cmocka_unit_test(charts_are_written_for_the_tables_that_fit),
        cmocka_unit_test(refused_memory_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
