// Unit: the runs of a study, and what its folder says after failures and stops.
#include "support.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static clast_study_config fresh(void)
{
    clast_study_config config;
    CHECK_OK(clast_fields_default(clast_study_fields, &config));
    return config;
}

static void set(clast_study_config *config, const char *key, const char *text)
{
    CHECK_OK(clast_field_set(clast_fields_find(clast_study_fields, key), config, text, true));
}

static const char *cell(const clast_table *t, const char *column, int64_t row)
{
    return t->column[clast_table_find(t, column)].text[row];
}

static void grid_takes_all_combinations_last_fastest(void **state)
{
    (void)state;
    clast_study_config config = fresh();
    clast_table plan = {0};
    set(&config, "run", "fill");
    set(&config, "vary", " a = 1 | 2 ");
    set(&config, "vary", "b=x|y z|w");
    set(&config, "seeds", "2");
    set(&config, "seed", "7");
    CHECK_OK(clast_study_plan(&config, &plan));
    assert_int_equal(plan.n_row, 12);
    assert_string_equal(cell(&plan, "a", 5), "1");
    assert_string_equal(cell(&plan, "a", 6), "2");
    assert_string_equal(cell(&plan, "b", 2), "y z");
    assert_string_equal(cell(&plan, "b", 11), "w");
    CHECK_ABS(clast_table_numbers(&plan, "seed")[11], 8.0, 0.0);
    CHECK_ABS(clast_table_numbers(&plan, "run")[11], 12.0, 0.0);
    clast_table_free(&plan);
    clast_fields_free(clast_study_fields, &config);
}

static void zip_goes_through_lists_together(void **state)
{
    (void)state;
    clast_study_config config = fresh();
    clast_table plan = {0};
    set(&config, "run", "fill");
    set(&config, "design", "zip");
    set(&config, "vary", "a=1|2");
    set(&config, "vary", "b=x|y");
    CHECK_OK(clast_study_plan(&config, &plan));
    assert_int_equal(plan.n_row, 2);
    assert_string_equal(cell(&plan, "b", 1), "y");
    clast_table_free(&plan);
    set(&config, "vary", "c=1|2|3");
    CHECK_STATUS(clast_study_plan(&config, &plan), CLAST_E_CONFIG);
    clast_fields_free(clast_study_fields, &config);
}

static void table_rows_are_runs_and_cross_with_lists(void **state)
{
    (void)state;
    char path[512];
    clast_table rows = {0};
    clast_table plan = {0};
    double *number = NULL;
    clast_study_config config = fresh();
    (void)snprintf(path, sizeof path, "%s/rows.csv", support_scratch());
    CHECK_OK(clast_table_init(&rows, "rows", 2));
    CHECK_OK(clast_table_add_number(&rows, "cone", "-", &number));
    number[0] = 0.1;
    number[1] = 2e-7;
    CHECK_OK(clast_table_write_csv(&rows, path));
    clast_table_free(&rows);
    set(&config, "run", "aggregate");
    set(&config, "table", path);
    set(&config, "vary", "rays=1|2|3");
    CHECK_OK(clast_study_plan(&config, &plan));
    assert_int_equal(plan.n_row, 6);
    assert_string_equal(cell(&plan, "cone", 2), "0.1");
    assert_string_equal(cell(&plan, "cone", 3), "2e-07");
    assert_string_equal(cell(&plan, "rays", 4), "2");
    clast_table_free(&plan);
    clast_fields_free(clast_study_fields, &config);
}

static void malformed_designs_are_refused(void **state)
{
    (void)state;
    static const char *const bad[] = {"a", "=1", "a=", "a=1||2", "run=1|2", " = 1"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        clast_study_config config = fresh();
        clast_table plan = {0};
        set(&config, "run", "fill");
        set(&config, "vary", bad[i]);
        CHECK_STATUS(clast_study_plan(&config, &plan), CLAST_E_CONFIG);
        assert_null(plan.column);
        clast_fields_free(clast_study_fields, &config);
    }
}

static clast_status make_plan(void *context)
{
    clast_table plan = {0};
    const clast_status status = clast_study_plan(context, &plan);
    clast_table_free(&plan);
    return status;
}

static void plan_survives_refused_memory(void **state)
{
    (void)state;
    clast_study_config config = fresh();
    set(&config, "run", "fill");
    set(&config, "vary", "a=1|2");
    set(&config, "vary", "b=1|2");
    support_refuse_each_allocation(make_plan, &config);
    clast_fields_free(clast_study_fields, &config);
}

/// A worker that runs nothing: each run ends at once with a code by its row.
typedef struct {
    int code[16];
    int64_t queue[16];
    int n_queue, n_started, n_resumed;
    bool stopped;
    int stop_after; ///< the monitor asks to stop after as many runs were started
    const clast_study_report *report;
} pretender;

static clast_status pretend_start(void *context, const clast_study_item *item)
{
    pretender *p = context;
    char path[600];
    (void)snprintf(path, sizeof path, "%s/result.json", item->folder);
    FILE *file = fopen(path, "w");
    (void)fprintf(file, "{\"x\": {\"y\": %d}, \"wall_s\": 3, \"list\": [5, 6], \"word\": \"a\"}\n",
                  (int)item->row * 10);
    (void)fclose(file);
    for (int i = 0; i < item->n_argument; ++i) {
        p->n_resumed += strcmp(item->argument[i], "--resume") == 0;
    }
    p->queue[p->n_queue++] = item->row;
    ++p->n_started;
    return CLAST_OK;
}

static clast_status pretend_wait(void *context, int64_t *row, int *exit_code)
{
    pretender *p = context;
    *row = p->queue[--p->n_queue];
    *exit_code = p->stopped ? 143 : p->code[*row];
    return CLAST_OK;
}

static void pretend_stop(void *context)
{
    ((pretender *)context)->stopped = true;
}

static bool wants_stop(void *context)
{
    const pretender *p = context;
    return p->stop_after > 0 && p->n_started >= p->stop_after;
}

static clast_study_worker worker_of(pretender *p)
{
    return (clast_study_worker){true, true, true, pretend_start, pretend_wait, pretend_stop, p};
}

static void folder_for(char folder[512], const char *name)
{
    (void)snprintf(folder, 512, "%s/%s", support_scratch(), name);
}

static double result(const char *folder, const char *file, const char *column, int64_t row)
{
    char path[600];
    clast_table table = {0};
    (void)snprintf(path, sizeof path, "%s/%s", folder, file);
    CHECK_OK(clast_table_read_csv(path, NULL, &table, NULL));
    const double *number = clast_table_numbers(&table, column);
    assert_non_null(number);
    const double value = number[row];
    clast_table_free(&table);
    return value;
}

static void failed_runs_are_noted_and_tried_again(void **state)
{
    (void)state;
    char folder[512];
    pretender p = {.code = {0, 3, 5, 0}};
    clast_study_report report;
    clast_study_config config = fresh();
    const clast_study_worker worker = worker_of(&p);
    folder_for(folder, "failing");
    set(&config, "run", "fill");
    set(&config, "vary", "a=1|2|3|4");
    CHECK_STATUS(clast_study_run(&config, folder, &worker, NULL, NULL, &report), CLAST_E_NO);
    assert_int_equal(report.n_failed, 1);
    assert_int_equal(report.first_failed, 2);
    assert_int_equal(report.n_done, 3);
    CHECK_ABS(result(folder, "results.csv", "exit_code", 1), 3.0, 0.0);
    assert_true(isnan(result(folder, "results.csv", "x.y", 1)));
    CHECK_ABS(result(folder, "results.csv", "x.y", 2), 20.0, 0.0);
    CHECK_ABS(result(folder, "times.csv", "wall_s", 2), 3.0, 0.0);
    p.code[1] = 0;
    p.n_started = 0;
    CHECK_OK(clast_study_run(&config, folder, &worker, NULL, NULL, &report));
    assert_int_equal(p.n_started, 1);
    assert_int_equal(report.n_before, 3);
    CHECK_ABS(result(folder, "results.csv", "x.y", 1), 10.0, 0.0);
    set(&config, "keep", "list.1");
    CHECK_OK(clast_study_run(&config, folder, &worker, NULL, NULL, &report));
    CHECK_ABS(result(folder, "results.csv", "list.1", 3), 6.0, 0.0);
    set(&config, "vary", "b=1|2");
    CHECK_STATUS(clast_study_run(&config, folder, &worker, NULL, NULL, &report), CLAST_E_USAGE);
    clast_fields_free(clast_study_fields, &config);
}

static void stopped_study_goes_on(void **state)
{
    (void)state;
    char folder[512];
    char path[600];
    pretender p = {.stop_after = 2};
    clast_study_report report;
    clast_study_config config = fresh();
    const clast_study_worker worker = worker_of(&p);
    const clast_monitor monitor = {.stop = wants_stop, .context = &p};
    folder_for(folder, "stopping");
    set(&config, "run", "aggregate");
    set(&config, "seeds", "6");
    clast_parallel_set_threads(2);
    CHECK_STATUS(clast_study_run(&config, folder, &worker, NULL, &monitor, &report),
                 CLAST_E_STOPPED);
    clast_parallel_set_threads(0);
    assert_int_equal(p.n_started, 2);
    // Whatever was cut off and left a checkpoint is resumed.
    (void)snprintf(path, sizeof path, "%s/runs/000001.part/out", folder);
    assert_int_equal(mkdir(path, 0777), 0);
    (void)snprintf(path, sizeof path, "%s/runs/000001.part/out/checkpoint-000000000200.h5", folder);
    (void)fclose(fopen(path, "w"));
    p.stop_after = 0;
    p.stopped = false;
    CHECK_OK(clast_study_run(&config, folder, &worker, NULL, &monitor, &report));
    assert_int_equal(p.n_resumed, 1);
    assert_int_equal(report.n_before + report.n_done, 6);
    clast_fields_free(clast_study_fields, &config);
}

static void shards_share_the_runs(void **state)
{
    (void)state;
    char folder[512];
    pretender p = {0};
    clast_study_report report;
    clast_study_config config = fresh();
    const clast_study_worker worker = worker_of(&p);
    folder_for(folder, "sharded");
    set(&config, "run", "aggregate");
    set(&config, "seeds", "5");
    set(&config, "shard", "2/2");
    CHECK_OK(clast_study_run(&config, folder, &worker, NULL, NULL, &report));
    assert_int_equal(report.n_done, 2);
    assert_int_equal(report.n_other, 3);
    assert_true(isnan(result(folder, "results.csv", "x.y", 0)));
    set(&config, "shard", "1/2");
    CHECK_OK(clast_study_run(&config, folder, &worker, NULL, NULL, &report));
    assert_int_equal(report.n_done, 3);
    CHECK_ABS(result(folder, "results.csv", "x.y", 1), 10.0, 0.0);
    set(&config, "shard", "3/2");
    CHECK_STATUS(clast_study_run(&config, folder, &worker, NULL, NULL, &report), CLAST_E_CONFIG);
    clast_fields_free(clast_study_fields, &config);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grid_takes_all_combinations_last_fastest),
        cmocka_unit_test(zip_goes_through_lists_together),
        cmocka_unit_test(table_rows_are_runs_and_cross_with_lists),
        cmocka_unit_test(malformed_designs_are_refused),
        cmocka_unit_test(plan_survives_refused_memory),
        cmocka_unit_test(failed_runs_are_noted_and_tried_again),
        cmocka_unit_test(stopped_study_goes_on),
        cmocka_unit_test(shards_share_the_runs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
