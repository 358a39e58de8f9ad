// Statistics of a set of grains, written as tables and charts.
#include <clast/statistics.h>

#include "base/path.h"
#include "base/status.h"
#include "math/whole.h"
#include "shape/whole.h"
#include <clast/chart.h>
#include <clast/table.h>
#include <stdio.h>
#include <string.h>

static clast_status path_of(const char *folder, const char *name, const char *extension,
                            char path[CLX_PATH_LIMIT])
{
    const int n = snprintf(path, CLX_PATH_LIMIT, "%s/%s.%s", folder, name, extension);
    return n < CLX_PATH_LIMIT
               ? CLAST_OK
               : clx_fail(CLAST_E_DISK, "the path of folder %.40s... is too long", folder);
}

/// Writes a table that one of the library's functions made, and frees it.
static clast_status write_table(clast_status made, clast_table *table, const char *folder,
                                const char *name)
{
    clast_status status = made;
    char path[CLX_PATH_LIMIT];
    CLX_TRY(status);
    CLX_TRY(path_of(folder, name, "csv", path));
    CLX_TRY(clast_table_write_csv(table, path));
done:
    clast_table_free(table);
    return status;
}

static clast_status write_tables(const clast_grain_statistics *g, const char *folder)
{
    clast_status status = CLAST_OK;
    const clast_statistics *s = &g->statistics;
    clast_table t = {0};
    CLX_TRY(write_table(clast_form_set_factors(&g->set, &t), &t, folder, "factors"));
    CLX_TRY(write_table(clast_statistics_summary_table(s, &t), &t, folder, "statistics"));
    CLX_TRY(write_table(clast_statistics_correlation_table(s, &t), &t, folder, "correlation"));
    CLX_TRY(write_table(clast_statistics_pca_table(s, &t), &t, folder, "pca"));
    if (g->set.n_left_out > 0) {
        CLX_TRY(write_table(clast_form_set_left_out(&g->set, &t), &t, folder, "left_out"));
    }
done:
    return status;
}

/// The table of a histogram with the unit of its numbers in the names of its columns: low_m,
/// density_1/m.
static clast_status histogram_table(const clast_histogram *h, const char *name, const char *unit,
                                    clast_table *table)
{
    clast_status status = CLAST_OK;
    clast_table plain = {0};
    clast_table made = {0};
    CLX_TRY(clast_histogram_table(h, name, &plain));
    CLX_TRY(clast_table_init(&made, name, plain.n_row));
    for (int32_t c = 0; c < plain.n_column; ++c) {
        static const char *const by[] = {"_", "_", NULL, "_1/", "_1/"}; // low high count density..
        char full[64];
        double *number = NULL;
        const bool has_unit = strcmp(unit, "-") != 0 && unit[0] != '\0' && c < 5 && by[c] != NULL;
        (void)snprintf(full, sizeof full, "%s%s%s", plain.column[c].name, has_unit ? by[c] : "",
                       has_unit ? unit : "");
        CLX_TRY(clast_table_add_number(
            &made, full, has_unit ? full + strlen(plain.column[c].name) + 1 : "-", &number));
        memcpy(number, plain.column[c].number, (size_t)plain.n_row * sizeof *number);
    }
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&plain);
    clast_table_free(&made);
    return status;
}

/// What a histogram is of: "size", "diameter", "mm".
typedef struct {
    const char *name, *label, *unit;
} measure;

/// Histogram of one column as table and chart.
static clast_status write_histogram(const double *x, int64_t n, const measure *of,
                                    const char *folder, const char *extension)
{
    clast_status status = CLAST_OK;
    clast_histogram h = {0};
    clast_table t = {0};
    char name[64];
    char path[CLX_PATH_LIMIT];
    (void)snprintf(name, sizeof name, "histogram_%s", of->name);
    CLX_TRY(clast_histogram_of(x, n, &h));
    CLX_TRY(write_table(histogram_table(&h, name, of->unit, &t), &t, folder, name));
    CLX_TRY(path_of(folder, name, extension, path));
    CLX_TRY(clast_chart_histogram(x, n, of->label, of->unit, path));
done:
    clast_histogram_free(&h);
    return status;
}

clast_status clast_grain_statistics_write(const clast_grain_statistics *statistics,
                                          const char *folder, const char *extension)
{
    CLX_ARGUMENTS(statistics, folder, extension);
    CLX_WHOLE(form_set, &statistics->set);
    CLX_WHOLE(statistics, &statistics->statistics);
    clast_status status = CLAST_OK;
    const clast_form_set *set = &statistics->set;
    const measure flatness = {"flatness", "flatness S/I", "-"};
    const measure elongation = {"elongation", "elongation I/L", "-"};
    const measure size = {"size", set->size_name, set->size_unit};
    char path[CLX_PATH_LIMIT];
    CLX_TRY(write_tables(statistics, folder));
    CLX_TRY(path_of(folder, "zingg", extension, path));
    CLX_TRY(clast_chart_zingg(set, path));
    CLX_TRY(write_histogram(set->flatness, set->n, &flatness, folder, extension));
    CLX_TRY(write_histogram(set->elongation, set->n, &elongation, folder, extension));
    const int32_t last = statistics->statistics.n - 1;
    if (set->size != NULL && last >= 0 && statistics->statistics.summary[last].n > 0) {
        CLX_TRY(write_histogram(set->size, set->n, &size, folder, extension));
    }
    CLX_TRY(path_of(folder, "correlation", extension, path));
    CLX_TRY(clast_chart_correlation(&statistics->statistics, path));
    if (statistics->statistics.n_pca > 0) {
        CLX_TRY(path_of(folder, "pca", extension, path));
        CLX_TRY(clast_chart_pca(&statistics->statistics, path));
    }
done:
    return status;
}
