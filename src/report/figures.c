// Charts and pictures of a run on a page.
#include "report/figures.h"

#include "base/alloc.h"
#include "base/file.h"
#include "base/path.h"
#include "plot/aggregate_charts.h"
#include "report/page.h"
#include "report/run.h"
#include <clast/chart.h>
#include <clast/table.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/// The table that a chart is drawn from, or NULL when the run does not have it.
static const clast_table *source_of(const clx_run *run, clast_aggregate_chart chart)
{
    const clast_table *table =
        clx_run_table(run, chart == CLAST_AGGREGATE_CHART_RADIAL ? "radial" : "history");
    return table != NULL && clast_aggregate_chart_fits(chart, table) ? table : NULL;
}

static clast_status write_chart(clx_file *file, const clx_run *run, clast_aggregate_chart chart,
                                int32_t index)
{
    clast_status status = CLAST_OK;
    unsigned char *svg = NULL;
    size_t n = 0;
    char prefix[48];
    const clast_table *wanted =
        chart == CLAST_AGGREGATE_CHART_SIZES ? clx_run_table(run, "sizes") : NULL;
    CLX_TRY(clast_aggregate_chart_svg(chart, source_of(run, chart), wanted, &svg, &n));
    (void)snprintf(prefix, sizeof prefix, "r%d-%s-", (int)index + 1,
                   clast_aggregate_chart_name(chart));
    (void)clx_file_print(file, "<figure class=\"chart\"><figcaption>%s</figcaption>",
                         clx_aggregate_chart_title(chart));
    clx_page_svg(file, (const char *)svg, n, prefix);
    (void)clx_file_print(file, "</figure>\n");
done:
    clast_chart_bytes_free(svg);
    return status;
}

clast_status clx_figures_charts(clx_file *file, const clx_run *run, int32_t index)
{
    clast_status status = CLAST_OK;
    bool is_open = false;
    for (int32_t k = 0; k < CLAST_N_AGGREGATE_CHART; ++k) {
        if (source_of(run, (clast_aggregate_chart)k) == NULL) {
            continue;
        }
        (void)clx_file_print(file, "%s", is_open ? "" : "<div class=\"charts\">\n");
        is_open = true;
        CLX_TRY(write_chart(file, run, (clast_aggregate_chart)k, index));
    }
    (void)clx_file_print(file, "%s", is_open ? "</div>\n" : "");
done:
    return status;
}

/// First porosity_* column of a run's history, or NULL.
static const clast_column *porosity_of(const clx_run *run)
{
    const clast_table *history = source_of(run, CLAST_AGGREGATE_CHART_POROSITY);
    for (int32_t c = 0; history != NULL && c < history->n_column; ++c) {
        const clast_column *column = &history->column[c];
        if (column->number != NULL && strncmp(column->name, "porosity_", 9) == 0) {
            return column;
        }
    }
    return NULL;
}

/// Whether the first envelopes of the runs are not all of one kind, which the legend then names.
static bool has_envelopes(const clx_run *run, int32_t n_run)
{
    const char *first = NULL;
    bool has = false;
    for (int32_t i = 0; i < n_run; ++i) {
        const clast_column *porosity = porosity_of(&run[i]);
        first = first == NULL && porosity != NULL ? porosity->name : first;
        has = has || (porosity != NULL && strcmp(porosity->name, first) != 0);
    }
    return has;
}

/// Adds a column "porosity_<k>: <run>" to `all`, filled from row `begin` on, nan elsewhere.
static clast_status add_run(const clx_run *run, int32_t k, int64_t begin, bool with_envelope,
                            clast_table *all)
{
    clast_status status = CLAST_OK;
    const clast_table *history = clx_run_table(run, "history");
    const clast_column *porosity = porosity_of(run);
    const double *n = clast_table_numbers(history, "n");
    char name[128];
    double *out = NULL;
    (void)snprintf(name, sizeof name, "porosity_%d: %.80s%s%.30s", (int)k + 1, run->name,
                   with_envelope ? ", " : "",
                   with_envelope ? porosity->name + strlen("porosity_") : "");
    CLX_TRY(clast_table_add_number(all, name, "-", &out));
    double *x = clast_table_numbers(all, "n");
    for (int64_t i = 0; i < all->n_row; ++i) {
        const bool is_own = i >= begin && i < begin + history->n_row;
        out[i] = is_own ? porosity->number[i - begin] : (double)NAN;
        x[i] = is_own ? n[i - begin] : x[i];
    }
done:
    return status;
}

clast_status clx_figures_compare(clx_file *file, const clx_run *run, int32_t n_run)
{
    enum { MAX_RUN = 8 };
    clast_status status = CLAST_OK;
    clast_table all = {0};
    unsigned char *svg = NULL;
    size_t n_byte = 0;
    int64_t n_row = 0;
    int32_t n_shown = 0;
    for (int32_t i = 0; i < n_run && n_shown < MAX_RUN; ++i) {
        if (porosity_of(&run[i]) != NULL) {
            n_row += clx_run_table(&run[i], "history")->n_row;
            ++n_shown;
        }
    }
    if (n_shown < 2) {
        goto done;
    }
    CLX_TRY(clast_table_init(&all, "comparison", n_row));
    CLX_TRY(clast_table_add_number(&all, "n", "-", NULL));
    n_row = 0;
    for (int32_t i = 0, k = 0; i < n_run && k < n_shown; ++i) {
        if (porosity_of(&run[i]) != NULL) {
            CLX_TRY(add_run(&run[i], i, n_row, has_envelopes(run, n_run), &all));
            n_row += clx_run_table(&run[i], "history")->n_row;
            ++k;
        }
    }
    CLX_TRY(clast_aggregate_chart_svg(CLAST_AGGREGATE_CHART_POROSITY, &all, NULL, &svg, &n_byte));
    (void)clx_file_print(file,
                         "<figure class=\"chart alone\"><figcaption>%s "
                         "<small>first envelope of each run%s</small></figcaption>",
                         clx_aggregate_chart_title(CLAST_AGGREGATE_CHART_POROSITY),
                         n_run > MAX_RUN ? ", first 8 runs" : "");
    clx_page_svg(file, (const char *)svg, n_byte, "all-");
    (void)clx_file_print(file, "</figure>\n");
done:
    clast_chart_bytes_free(svg);
    clast_table_free(&all);
    return status;
}

/// "history.svg" where the page draws that chart itself.
static bool is_drawn(const clx_run *run, const char *picture)
{
    const size_t n = strlen(picture) - 4;
    for (int32_t k = 0; k < CLAST_N_AGGREGATE_CHART; ++k) {
        const char *name = clast_aggregate_chart_name((clast_aggregate_chart)k);
        if (strlen(name) == n && strncmp(picture, name, n) == 0 &&
            source_of(run, (clast_aggregate_chart)k) != NULL) {
            return true;
        }
    }
    return false;
}

static bool is_picture(const clx_run *run, const char *name)
{
    return (clx_path_is(name, "png") || clx_path_is(name, "svg")) && !is_drawn(run, name);
}

/// As a data URI: an <img> never runs a script, not even that of an SVG.
static clast_status write_picture(clx_file *file, const clx_run *run, const char *name,
                                  int64_t *left)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    char *bytes = NULL;
    int64_t n = 0;
    CLX_TRY(clx_run_path(run, name, path, sizeof path));
    CLX_TRY(clx_file_read_all(path, (int64_t)1 << 30, &bytes, &n));
    (void)clx_file_print(file, "<figure>");
    if (n <= *left) {
        *left -= n;
        (void)clx_file_print(file, "<img alt=\"");
        clx_page_text(file, name);
        (void)clx_file_print(file, "\" src=\"data:image/%s;base64,",
                             clx_path_is(name, "png") ? "png" : "svg+xml");
        clx_page_base64(file, bytes, (size_t)n);
        (void)clx_file_print(file, "\">");
    } else {
        (void)clx_file_print(file, "<p class=\"note\">Left out: %.1f MB is beyond picture_mb.</p>",
                             1e-6 * (double)n);
    }
    (void)clx_file_print(file, "<figcaption>");
    clx_page_text(file, name);
    (void)clx_file_print(file, "</figcaption></figure>\n");
done:
    clx_free(bytes);
    return status;
}

clast_status clx_figures_pictures(clx_file *file, const clx_run *run, int64_t limit)
{
    clast_status status = CLAST_OK;
    bool is_open = false;
    int64_t left = limit;
    for (int32_t i = 0; i < run->files.n; ++i) {
        if (!is_picture(run, run->files.name[i])) {
            continue;
        }
        (void)clx_file_print(file, "%s",
                             is_open ? "" : "<h3>Pictures</h3>\n<div class=\"pictures\">\n");
        is_open = true;
        CLX_TRY(write_picture(file, run, run->files.name[i], &left));
    }
    (void)clx_file_print(file, "%s", is_open ? "</div>\n" : "");
done:
    return status;
}
