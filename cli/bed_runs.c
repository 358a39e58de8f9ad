// Several beds of one kind: the mean of every number that clast porosity finds, and its interval.
#include "bed_runs.h"

#include "command.h"
#include "json.h"
#include "results.h"

#include <clast/chart.h>
#include <clast/porosity.h>
#include <clast/report.h>
#include <clast/table.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/// One number of all runs.
typedef struct {
    const char *group; ///< "" or fabric, stress
    const char *key;
    clast_mean mean;
} quantity;

enum { MOST_QUANTITIES = 96 };

typedef struct {
    int n;
    quantity of[MOST_QUANTITIES];
} quantities;

/// Numbers of an object, and of the objects in it, at most.
static size_t size_of(const json_t *found)
{
    const char *key = NULL;
    json_t *value = NULL;
    size_t n = json_object_size(found);
    json_object_foreach((json_t *)found, key, value)
    {
        n += json_object_size(value); // 0 for what is no object
    }
    return n;
}

static clast_status check(const cli_bed_runs *runs, const char *name, const char *unit,
                          const json_t *found)
{
    if (found == NULL) {
        return CLAST_E_MEMORY;
    }
    if (runs->n == CLI_MOST_RUNS) {
        return cli_fail(CLAST_E_USAGE, "more than %d runs", CLI_MOST_RUNS);
    }
    if (size_of(found) > MOST_QUANTITIES) {
        return cli_fail(CLAST_E_LIMIT, "%s: more than %d numbers", name, MOST_QUANTITIES);
    }
    return runs->n == 0 || strcmp(unit, runs->unit) == 0
               ? CLAST_OK
               : cli_fail(CLAST_E_USAGE, "%s is in %s, the runs before in %s", name, unit,
                          runs->unit);
}

clast_status cli_bed_runs_add(cli_bed_runs *runs, const char *name, const char *unit, json_t *found,
                              clast_table *profile, clast_table *radial)
{
    const int32_t i = runs->n;
    const clast_status status = check(runs, name, unit, found);
    if (status != CLAST_OK) {
        json_decref(found);
        clast_table_free(profile);
        clast_table_free(radial);
        return status;
    }
    cli_json_text(found, "run", name);
    runs->found[i] = found;
    runs->profile[i] = *profile;
    runs->radial[i] = *radial;
    *profile = (clast_table){0};
    *radial = (clast_table){0};
    (void)snprintf(runs->unit, sizeof runs->unit, "%s", unit);
    runs->n = i + 1;
    return CLAST_OK;
}

void cli_bed_runs_free(cli_bed_runs *runs)
{
    for (int32_t i = 0; i < runs->n; ++i) {
        json_decref(runs->found[i]);
        clast_table_free(&runs->profile[i]);
        clast_table_free(&runs->radial[i]);
    }
    *runs = (cli_bed_runs){0};
}

/// The means of an object's numbers; one that some run does not have is NAN.
static void gather(const cli_bed_runs *runs, const char *group, quantities *q)
{
    const char *key = NULL;
    json_t *value = NULL;
    json_t *first = group[0] != '\0' ? json_object_get(runs->found[0], group) : runs->found[0];
    json_object_foreach(first, key, value)
    {
        double number[CLI_MOST_RUNS];
        for (int32_t i = 0; i < runs->n; ++i) {
            const json_t *own =
                group[0] != '\0' ? json_object_get(runs->found[i], group) : runs->found[i];
            const json_t *found = json_object_get(own, key);
            number[i] = json_is_number(found) ? json_number_value(found) : (double)NAN;
        }
        if (json_is_object(value)) {
            gather(runs, key, q);
        } else if (!json_is_string(value) && !json_is_boolean(value)) {
            q->of[q->n++] = (quantity){group, key, clast_mean_of(runs->n, number)};
        }
    }
}

static quantities means_of(const cli_bed_runs *runs)
{
    quantities q = {0};
    gather(runs, "", &q);
    return q;
}

static json_t *mean_json(const clast_mean *m)
{
    json_t *object = json_object();
    cli_json_number(object, "mean", m->mean);
    cli_json_number(object, "deviation", m->deviation);
    cli_json_number(object, "low", m->low);
    cli_json_number(object, "high", m->high);
    return object;
}

json_t *cli_bed_runs_json(const cli_bed_runs *runs)
{
    const quantities q = means_of(runs);
    json_t *object = json_object();
    json_t *each = json_array();
    for (int32_t i = 0; i < runs->n; ++i) {
        (void)json_array_append(each, runs->found[i]);
    }
    cli_json_count(object, "n_run", runs->n);
    cli_json_text(object, "unit", runs->unit);
    if (json_object_get(runs->found[0], "is_part") != NULL) { // all are alike
        (void)json_object_set(object, "is_part", json_object_get(runs->found[0], "is_part"));
    }
    (void)json_object_set_new(object, "runs", each);
    for (int k = 0; k < q.n; ++k) {
        const bool is_inner = q.of[k].group[0] != '\0';
        if (is_inner && json_object_get(object, q.of[k].group) == NULL) {
            (void)json_object_set_new(object, q.of[k].group, json_object());
        }
        json_t *into = is_inner ? json_object_get(object, q.of[k].group) : object;
        (void)json_object_set_new(into, q.of[k].key, mean_json(&q.of[k].mean));
    }
    return object;
}

/// The same, each name once: a group may repeat a number.
static quantities named_means_of(const cli_bed_runs *runs)
{
    const quantities all = means_of(runs);
    quantities q = {0};
    for (int k = 0; k < all.n; ++k) {
        bool is_new = true;
        for (int i = 0; i < q.n; ++i) {
            is_new = is_new && strcmp(q.of[i].key, all.of[k].key) != 0;
        }
        q.of[q.n] = all.of[k];
        q.n += is_new ? 1 : 0;
    }
    return q;
}

clast_status cli_bed_runs_print(const cli_bed_runs *runs)
{
    const quantities q = named_means_of(runs);
    for (int32_t i = 0; i < runs->n; ++i) {
        (void)printf("%-32s %.6f\n", json_string_value(json_object_get(runs->found[i], "run")),
                     json_number_value(json_object_get(runs->found[i], "bulk")));
    }
    (void)printf("%-21s %12s %12s   95 %% interval of the mean of %d runs (lengths in %s)\n", "",
                 "mean", "deviation", runs->n,
                 strcmp(runs->unit, "model") == 0 ? "model units" : runs->unit);
    for (int k = 0; k < q.n; ++k) {
        const clast_mean *m = &q.of[k].mean;
        if (isfinite(m->mean)) {
            (void)printf("%-21s %12.6g %12.3g   %.6g to %.6g\n", q.of[k].key, m->mean, m->deviation,
                         m->low, m->high);
        }
    }
    if (json_is_true(json_object_get(runs->found[0], "is_part"))) {
        (void)printf("the beds are parts of packings: bulk and profile count what lies inside, "
                     "contacts do not; no stress\n");
    }
    return CLAST_OK;
}

static clast_status write_table(const clast_run_folder *run, const char *name,
                                const clast_table *table)
{
    char path[CLAST_RUN_PATH];
    CLI_GUARD(clast_run_folder_file(run, name, path));
    return clast_table_write_csv(table, path);
}

/// SI unit of a number of clast porosity as reports have it; "-" for none, and for lengths in the
/// unit of a file that does not tell it.
static const char *unit_of(const cli_bed_runs *runs, const char *key)
{
    const char *unit = clast_report_unit(key);
    const bool is_length = strcmp(unit, "m") == 0 || strcmp(unit, "m^3") == 0;
    return unit[0] == '\0' || (is_length && strcmp(runs->unit, "m") != 0) ? "-" : unit;
}

static clast_status write_means(const cli_bed_runs *runs, const clast_run_folder *run)
{
    static const char *const name[] = {"mean", "deviation", "low", "high"};
    const quantities q = named_means_of(runs);
    clast_table table = {0};
    clast_status status = CLAST_OK;
    CLI_TRY(clast_table_init(&table, "means", q.n));
    CLI_TRY(clast_table_add_text(&table, "quantity"));
    CLI_TRY(clast_table_add_text(&table, "unit"));
    for (int c = 0; c < 4; ++c) {
        CLI_TRY(clast_table_add_number(&table, name[c], "-", NULL));
    }
    for (int k = 0; k < q.n; ++k) {
        const clast_mean *m = &q.of[k].mean;
        const double value[4] = {m->mean, m->deviation, m->low, m->high};
        CLI_TRY(clast_table_set_text(&table, 0, k, q.of[k].key));
        CLI_TRY(clast_table_set_text(&table, 1, k, unit_of(runs, q.of[k].key)));
        for (int c = 0; c < 4; ++c) {
            table.column[c + 2].number[k] = value[c];
        }
    }
    CLI_TRY(write_table(run, "means.csv", &table));
done:
    clast_table_free(&table);
    return status;
}

/// The mean of profiles as a table and a chart.
static clast_status write_band(const cli_bed_runs *runs, const clast_table *profile,
                               const clast_run_folder *run, const char *csv, const char *svg)
{
    char path[CLAST_RUN_PATH];
    clast_table band = {0};
    clast_status status = CLAST_OK;
    CLI_TRY(clast_porosity_mean_profile(runs->n, profile, &band));
    CLI_TRY(clast_run_folder_file(run, svg, path));
    CLI_TRY(clast_chart_porosity_band(&band, runs->unit, path));
    if (strcmp(runs->unit, "m") != 0) {
        cli_table_without_unit(&band);
    }
    CLI_TRY(write_table(run, csv, &band));
done:
    clast_table_free(&band);
    return status;
}

clast_status cli_bed_runs_write(const cli_bed_runs *runs, const clast_run_folder *run)
{
    CLI_GUARD(write_means(runs, run));
    CLI_GUARD(write_band(runs, runs->profile, run, "mean_profile.csv", "mean_profile.svg"));
    if (runs->radial[0].n_column > 0) {
        CLI_GUARD(write_band(runs, runs->radial, run, "mean_radial.csv", "mean_radial.svg"));
    }
    return CLAST_OK;
}
