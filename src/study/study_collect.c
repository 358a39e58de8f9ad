// Results of a study's runs as one table.
#include "base/number.h"
#include "study/study.h"

#include "base/alloc.h"
#include "base/file.h"
#include "base/path.h"
#include <clast/table.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { KEY = 256, RESULT_LIMIT = 1 << 28, COLUMN_LIMIT = 4096 };

/// Tables under construction: what is equal in equal runs, and what is not.
typedef struct {
    const clast_study_config *config;
    clast_table results, times;
    int64_t row;
    int64_t n_read; ///< runs that have a result
    int64_t n_unconverged;
    bool *has_kept;  ///< [keep.n] whether one of them has it
    bool only_times; ///< of all numbers, where some are kept
    clast_status status;
} gatherer;

/// Clocks differ from run to run.
static bool is_time(const char *key)
{
    static const char *const clocks[] = {"wall_s", "contact_s", "envelope_s", "ns_per_grain_step"};
    const char *dot = strrchr(key, '.');
    for (size_t i = 0; i < sizeof clocks / sizeof clocks[0]; ++i) {
        if (strcmp(dot != NULL ? dot + 1 : key, clocks[i]) == 0) {
            return true;
        }
    }
    return false;
}

static void append_result(gatherer *g, const char *result, double value)
{
    clast_table *to = is_time(result) ? &g->times : &g->results;
    char key[512];
    (void)snprintf(key, sizeof key, "%s", result);
    if (clast_table_find(to, key) >= 0 && clast_table_numbers(to, key) == NULL) {
        // what was wanted has the name (a varied key, as flatness_mean of packings); this is what
        // came
        (void)snprintf(key, sizeof key, "result.%s", result);
    }
    double *number = clast_table_numbers(to, key);
    if (g->status != CLAST_OK) {
        return;
    }
    if (number == NULL) {
        if (to->n_column >= COLUMN_LIMIT) {
            g->status = clx_fail(CLAST_E_LIMIT, "more than %d results a run; name some by --keep",
                                 COLUMN_LIMIT);
            return;
        }
        g->status = clast_table_add_number(to, key, "-", &number);
        for (int64_t r = 0; r < to->n_row && g->status == CLAST_OK; ++r) {
            number[r] = NAN;
        }
    }
    if (g->status == CLAST_OK) {
        number[g->row] = value;
    }
}

static bool as_number(const json_t *value, double *number)
{
    *number = json_is_boolean(value) ? (double)json_is_true(value) : json_number_value(value);
    return json_is_number(value) || json_is_boolean(value);
}

static void add_all(gatherer *g, const char *prefix, const json_t *object, const json_t *around);

/// A number, the numbers of an object, or those of the only entry of a list, by the name that
/// --keep takes: "grains.0.volume". Lists of more are left to --keep.
///
/// @param twin  the number or object of the same name around the list that the value is in, or NULL
static void add_value(gatherer *g, const char *name, const json_t *value, const json_t *around,
                      const json_t *twin)
{
    double number = 0.0;
    char entry[KEY];
    if (json_is_object(value)) {
        add_all(g, name, value, twin);
    } else if (json_is_array(value) && json_array_size(value) == 1) {
        const int n = snprintf(entry, sizeof entry, "%s.0", name);
        if (n > 0 && n < KEY) {
            add_value(g, entry, json_array_get(value, 0), around, around);
        }
    } else if (as_number(value, &number) && (is_time(name) || !g->only_times) &&
               !json_equal(value, twin)) {
        append_result(g, name, number);
    }
}

/// Every number of an object and of objects within, without those that the object around a list
/// has, too: a mean of one repeat is that repeat.
static void add_all(gatherer *g, const char *prefix, const json_t *object, const json_t *around)
{
    const char *key = NULL;
    json_t *value = NULL;
    char name[KEY];
    json_object_foreach((json_t *)object, key, value)
    {
        const int n =
            snprintf(name, sizeof name, "%s%s%s", prefix, prefix[0] != '\0' ? "." : "", key);
        if (n > 0 && n < KEY) {
            add_value(g, name, value, object, json_object_get(around, key));
        }
    }
}

/// The value at "a.b.0"; NULL when there is none.
static json_t *find(json_t *root, const char *path)
{
    char part[KEY];
    while (root != NULL && *path != '\0') {
        const size_t n = strcspn(path, ".");
        (void)snprintf(part, sizeof part, "%.*s", (int)n, path);
        root = json_is_array(root) ? json_array_get(root, strtoul(part, NULL, 10))
                                   : json_object_get(root, part);
        path += n + (path[n] == '.');
    }
    return root;
}

static void add_kept(gatherer *g, json_t *root)
{
    for (int32_t i = 0; i < g->config->keep.n; ++i) {
        double number = NAN;
        const json_t *value = find(root, g->config->keep.item[i]);
        if (!as_number(value, &number)) {
            number = NAN;
        }
        // null is a number that this run has not
        g->has_kept[i] = g->has_kept[i] || isfinite(number) || json_is_null(value);
        append_result(g, g->config->keep.item[i], number);
    }
}

/// Puts the numbers of a whole run's result. One that ended with another code than 0, such as a bed
/// that did not converge, may have printed none.
static clast_status read_result(gatherer *g, const char *run, double exit_code)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    char *text = NULL;
    int64_t n = 0;
    json_t *root = NULL;
    json_error_t error;
    CLX_TRY(clx_path_join(path, run, "result.json"));
    CLX_TRY(clx_file_read_all(path, RESULT_LIMIT, &text, &n));
    if (n == 0 && exit_code != 0.0) {
        goto done;
    }
    root = json_loadb(text, (size_t)n, 0, &error);
    CLX_CHECK(json_is_object(root), CLAST_E_FORMAT, "%s: not one JSON object (line %d: %s)", path,
              error.line, error.text);
    if (g->config->keep.n > 0) {
        add_kept(g, root);
    }
    add_all(g, "", root, NULL);
    ++g->n_read;
done:
    clx_free(text);
    json_decref(root);
    return status;
}

static clast_status read_run(gatherer *g, const char *folder, bool whole)
{
    clast_status status = CLAST_OK;
    char run[CLX_PATH_LIMIT];
    char path[CLX_PATH_LIMIT];
    char *text = NULL;
    int64_t n = 0;
    CLX_TRY(clx_study_run_folder(folder, g->row, whole ? "" : ".part", run));
    CLX_TRY(clx_path_join(path, run, "exit_code"));
    if (access(path, F_OK) != 0) {
        goto done; // never begun, or under way
    }
    CLX_TRY(clx_file_read_all(path, 64, &text, &n));
    const double exit_code = clx_number_read(text, NULL);
    append_result(g, "exit_code", exit_code);
    if (whole) {
        g->n_unconverged += exit_code == clast_status_exit_code(CLAST_E_CONVERGE);
        CLX_TRY(read_result(g, run, exit_code));
    }
    status = g->status;
done:
    clx_free(text);
    return status;
}

/// True for names that differ in up to two letters at one place: slips, not other quantities.
static bool is_slip(const char *a, const char *b)
{
    const size_t n = strlen(a);
    const size_t m = strlen(b);
    size_t begin = 0;
    size_t end = 0;
    while (begin < n && begin < m && a[begin] == b[begin]) {
        ++begin;
    }
    while (end < n - begin && end < m - begin && a[n - 1 - end] == b[m - 1 - end]) {
        ++end;
    }
    return begin + end >= 3 && begin + end + 2 >= n && begin + end + 2 >= m;
}

/// The key of an object of which a name that is not there is a slip, or NULL.
static const char *find_meant(json_t *root, const char *name)
{
    const char *key = NULL;
    json_t *value = NULL;
    json_object_foreach(root, key, value)
    {
        if (is_slip(name, key)) {
            return key;
        }
    }
    return NULL;
}

clast_status clx_study_check_kept(const clast_study_config *config, const char *run_folder)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    char *text = NULL;
    int64_t n = 0;
    json_t *root = NULL;
    CLX_TRY(clx_path_join(path, run_folder, "result.json"));
    CLX_TRY(clx_file_read_all(path, RESULT_LIMIT, &text, &n));
    root = json_loadb(text, (size_t)n, 0, NULL);
    for (int32_t i = 0; i < config->keep.n && json_is_object(root); ++i) {
        const char *name = config->keep.item[i];
        const char *meant = find(root, name) == NULL ? find_meant(root, name) : NULL;
        CLX_CHECK(meant == NULL, CLAST_E_CONFIG,
                  "keep: '%s': a run's result has no such number (did you mean '%s'?); the runs "
                  "that are done stay",
                  name, meant);
    }
done:
    clx_free(text);
    json_decref(root);
    return status;
}

/// A copy of the plan's columns.
static clast_status copy_plan(const clast_table *plan, const char *name, clast_table *copy)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clast_table_init(copy, name, plan->n_row));
    for (int32_t c = 0; c < plan->n_column; ++c) {
        const clast_column *from = &plan->column[c];
        if (from->text != NULL) {
            CLX_TRY(clast_table_add_text(copy, from->name));
            for (int64_t r = 0; r < plan->n_row; ++r) {
                CLX_TRY(clast_table_set_text(copy, c, r, from->text[r]));
            }
        } else {
            double *number = NULL;
            CLX_TRY(clast_table_add_number(copy, from->name, from->unit, &number));
            memcpy(number, from->number, (size_t)plan->n_row * sizeof *number);
        }
    }
done:
    return status;
}

static clast_status write_in(const char *folder, const char *name, const clast_table *table)
{
    char path[CLX_PATH_LIMIT];
    CLX_GUARD(clx_path_join(path, folder, name));
    return clast_table_write_csv(table, path);
}

clast_status clx_study_collect(const clast_study_config *config, const char *folder,
                               const clast_table *plan, clast_study_report *report)
{
    clast_status status = CLAST_OK;
    gatherer g = {.config = config, .only_times = config->keep.n > 0};
    CLX_TRY(clx_alloc(&g.has_kept, config->keep.n + 1, sizeof *g.has_kept));
    CLX_TRY(copy_plan(plan, "results", &g.results));
    CLX_TRY(copy_plan(plan, "times", &g.times));
    for (g.row = 0; g.row < plan->n_row; ++g.row) {
        CLX_TRY(read_run(&g, folder, clx_study_is_done(folder, g.row)));
    }
    CLX_TRY(write_in(folder, "results.csv", &g.results));
    CLX_TRY(write_in(folder, "times.csv", &g.times));
    for (int32_t i = config->keep.n - 1; i >= 0 && g.n_read > 0; --i) {
        report->n_unknown += !g.has_kept[i];
        report->first_unknown = g.has_kept[i] ? report->first_unknown : i;
    }
    report->n_unconverged = g.n_unconverged;
done:
    clx_free(g.has_kept);
    clast_table_free(&g.results);
    clast_table_free(&g.times);
    return status;
}
