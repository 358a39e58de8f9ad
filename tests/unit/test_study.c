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

/* A caller of the library, and Python for what its pattern did not find, got 1. */
static void the_first_seed_is_as_the_command_reads_it(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        double seed; // 0: refused
    } row[] = {{"{mass: 1g, seed: 42}", 42},
               {"? seed\n: 42", 42},
               {"seed: !!int 42", 42},
               {"a: &a 7\nseed: *a", 7},
               {"seed: 010", 10},
               {"seed: 0x10", 16},
               {"seed: 1e3", 1000},
               {"a: 2", 1},
               {"seed: 9007199254740992", 0},
               {"seed: -1", 0},
               {"seed: few", 0},
               {"seed: [1, 2]", 0}};
    char path[512];
    (void)snprintf(path, sizeof path, "%s/seeds.yaml", support_scratch());
    for (size_t k = 0; k < sizeof row / sizeof *row; ++k) {
        clast_study_config config = fresh();
        clast_table plan = {0};
        FILE *file = fopen(path, "w");
        assert_non_null(file);
        (void)fputs(row[k].text, file);
        (void)fclose(file);
        set(&config, "run", "fill");
        set(&config, "config", path);
        const clast_status status = clast_study_plan(&config, &plan);
        CHECK_STATUS(status, row[k].seed > 0 ? CLAST_OK : CLAST_E_CONFIG);
        if (status == CLAST_OK) {
            CHECK_ABS(clast_table_numbers(&plan, "seed")[0], row[k].seed, 0.0);
        }
        set(&config, "seed", "3");
        clast_table_free(&plan);
        CHECK_OK(clast_study_plan(&config, &plan));
        CHECK_ABS(clast_table_numbers(&plan, "seed")[0], 3.0, 0.0);
        clast_table_free(&plan);
        clast_fields_free(clast_study_fields, &config);
    }
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

static const char *write_file(const char *name, const char *text)
{
    const char *path = support_scratch_file(name);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0 && fclose(file) == 0);
    return path;
}

/* A header without rows was a division by 0. */
static void a_table_without_rows_is_refused(void **state)
{
    (void)state;
    clast_study_config config = fresh();
    clast_table plan = {0};
    set(&config, "run", "fill");
    set(&config, "table", write_file("header.csv", "rays,cone\n"));
    CHECK_STATUS(clast_study_plan(&config, &plan), CLAST_E_FORMAT);
    assert_non_null(strstr(clast_error_detail(), "header.csv: a header and no rows"));
    set(&config, "vary", "a=1|2");
    CHECK_STATUS(clast_study_plan(&config, &plan), CLAST_E_FORMAT);
    assert_null(plan.column);
    clast_fields_free(clast_study_fields, &config);
}

/* "core-size" and "core_size" both varied, and the runs took the last of them. */
static void a_key_of_two_spellings_varies_once(void **state)
{
    (void)state;
    const struct {
        const char *table, *vary[2], *design;
    } twice[] = {{"", {"core-size=1|3", "core_size=2"}, "grid"},
                 {"", {"core_size=1|3", "core-size=2|4"}, "zip"},
                 {"core-size\n1\n", {"core_size=2", NULL}, "grid"},
                 {"core-size,core_size\n1,2\n", {NULL, NULL}, "grid"}};
    for (size_t i = 0; i < sizeof twice / sizeof twice[0]; ++i) {
        clast_study_config config = fresh();
        clast_table plan = {0};
        set(&config, "run", "aggregate");
        set(&config, "design", twice[i].design);
        if (twice[i].table[0] != '\0') {
            set(&config, "table", write_file("twice.csv", twice[i].table));
        }
        for (int k = 0; k < 2 && twice[i].vary[k] != NULL; ++k) {
            set(&config, "vary", twice[i].vary[k]);
        }
        CHECK_STATUS(clast_study_plan(&config, &plan), CLAST_E_CONFIG);
        assert_non_null(strstr(clast_error_detail(), "varies twice"));
        assert_null(plan.column);
        clast_fields_free(clast_study_fields, &config);
    }
}

/* 10000000000000003 became ...4 without a word, and 10000000000000001 was 1e+16. */
static void seeds_of_a_table_keep_their_digits(void **state)
{
    (void)state;
    clast_study_config config = fresh();
    clast_table plan = {0};
    set(&config, "run", "pack");
    set(&config, "table",
        write_file("seeds.csv", "seed,friction\n10000000000000003,0.50\n10000000000000001,6e-1\n"
                                "20261130025411111,1\n20261130025411113,1\n"
                                "18446744073709551615,1\n7.0,1\n"));
    CHECK_OK(clast_study_plan(&config, &plan));
    static const char *const seed[] = {"10000000000000003",    "10000000000000001",
                                       "20261130025411111",    "20261130025411113",
                                       "18446744073709551615", "7"};
    for (int64_t i = 0; i < 6; ++i) {
        assert_string_equal(cell(&plan, "seed", i), seed[i]);
    }
    assert_string_equal(cell(&plan, "friction", 0), "0.5");
    assert_string_equal(cell(&plan, "friction", 1), "0.6");
    clast_table_free(&plan);
    clast_fields_free(clast_study_fields, &config);
}

/* Bare numbers and lists with one word in them were compared as texts, and were run twice. */
static void the_same_values_are_refused_however_they_are_written(void **state)
{
    (void)state;
    static const char *const same[] = {
        "friction=0.1|0.10",   "mass=0.0005|0.5e-3",
        "mass=0.5g|0.0005",    "mass=0.3mg|3e-7|U1",
        "gyroscopic=yes|true", "gyroscopic=0|off",
        "curve=4mm|U1|0.4cm",  "curve=2phi|250um",
        "rate=60/min|1 1/s",   "seed=10000000000000003|010000000000000003",
        "friction=0|-0"};
    static const char *const other[] = {"friction=0.1|0.10000000000001",
                                        "curve=4mm|U1|4cm",
                                        "seed=10000000000000003|"
                                        "10000000000000005",
                                        "seed=9007199254740993|9007199254740992",
                                        "config=a.yaml|b.yaml",
                                        "law=linear|hertz"};
    clast_table plan = {0};
    for (size_t i = 0; i < sizeof same / sizeof same[0]; ++i) {
        clast_study_config config = fresh();
        set(&config, "run", "pack");
        set(&config, "vary", same[i]);
        CHECK_STATUS(clast_study_plan(&config, &plan), CLAST_E_CONFIG);
        assert_non_null(strstr(clast_error_detail(), "are the same ("));
        clast_fields_free(clast_study_fields, &config);
    }
    for (size_t i = 0; i < sizeof other / sizeof other[0]; ++i) {
        clast_study_config config = fresh();
        set(&config, "run", "pack");
        set(&config, "vary", other[i]);
        CHECK_OK(clast_study_plan(&config, &plan));
        clast_table_free(&plan);
        clast_fields_free(clast_study_fields, &config);
    }
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

/* A caller of the library got runs that all failed. */
static void keys_of_another_command_are_refused(void **state)
{
    (void)state;
    static const clast_field fields[] = {{.name = "core_size", .type = CLAST_FIELD_F64},
                                         {.name = "size", .type = CLAST_FIELD_TEXT_LIST},
                                         {0}};
    static const struct {
        const char *key, *text, *says; // NULL: fine
    } row[] = {{"vary", "core-size = 1um | 2um", NULL},
               {"vary", "cor_size = 1um",
                "clast aggregate has no key 'cor_size' (did you mean 'core_size'?)"},
               {"table", "core_size=1\n1\n", "clast aggregate has no key 'core_size=1'"},
               {"fix", "core_size", "fix takes key=value, not 'core_size'"},
               {"fix", "friction=1", "clast aggregate has no key 'friction'"},
               {"fix", "size=1um", NULL},
               {"seeds", "2", "clast aggregate draws nothing at random: seeds must be 1"}};
    int64_t n_run = 0;
    for (size_t k = 0; k < sizeof row / sizeof *row; ++k) {
        clast_study_config config = fresh();
        const bool is_table = strcmp(row[k].key, "table") == 0;
        set(&config, "run", "aggregate");
        set(&config, row[k].key, is_table ? write_file("keys.csv", row[k].text) : row[k].text);
        CHECK_STATUS(clast_study_check(&config, fields, &n_run),
                     row[k].says == NULL ? CLAST_OK : CLAST_E_CONFIG);
        assert_true(row[k].says == NULL || strstr(clast_error_detail(), row[k].says) != NULL);
        assert_int_equal(n_run, k < 5 ? 2 : 1);
        clast_fields_free(clast_study_fields, &config);
    }
    clast_study_config config = fresh();
    set(&config, "run", "aggregate");
    set(&config, "fix", "core_size=1um");
    CHECK_STATUS(clast_study_check(&config, NULL, NULL), CLAST_E_CONFIG);
    set(&config, "fix", "core-size=2um");
    CHECK_STATUS(clast_study_check(&config, fields, NULL), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "core_size takes one value"));
    clast_fields_free(clast_study_fields, &config);
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
    bool is_mute;   ///< a run that does not end with 0 prints no result
    int stop_after; ///< the monitor asks to stop after as many runs were started
    const clast_study_report *report;
} pretender;

static clast_status pretend_start(void *context, const clast_study_item *item)
{
    pretender *p = context;
    char path[600];
    (void)snprintf(path, sizeof path, "%s/result.json", item->folder);
    FILE *file = fopen(path, "w");
    const int y = (int)item->row * 10;
    if (!p->is_mute || p->code[item->row] == 0) {
        (void)fprintf(file,
                      "{\"x\": {\"y\": %d}, \"wall_s\": 3, \"list\": [5, 6], \"word\": \"a\", "
                      "\"only\": [{\"z\": %d, \"x\": {\"y\": %d}, \"wall_s\": 2}], \"one\": [7]}\n",
                      y, y + 1, y);
    }
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

static void check_outcomes(const char *folder, clast_study_outcomes wanted)
{
    char path[600];
    clast_table table = {0};
    clast_study_outcomes n = {0};
    (void)snprintf(path, sizeof path, "%s/results.csv", folder);
    CHECK_OK(clast_table_read_csv(path, NULL, &table, NULL));
    CHECK_OK(clast_study_count(&table, &n));
    assert_memory_equal(&n, &wanted, sizeof n);
    clast_table_free(&table);
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

static char *text_of(const char *folder, const char *name)
{
    static char text[4][4096];
    static int k = 0;
    char path[600];
    char *at = text[k++ % 4];
    (void)snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    at[fread(at, 1, sizeof text[0] - 1, file)] = '\0';
    (void)fclose(file);
    return at;
}

/* A bed that did not converge prints no result: no table was written, for good. */
static void a_run_without_a_result_has_its_exit_code_alone(void **state)
{
    (void)state;
    char folder[512];
    pretender p = {.code = {5, 0, 137, 1}, .is_mute = true};
    clast_study_report report;
    clast_study_config config = fresh();
    const clast_study_worker worker = worker_of(&p);
    folder_for(folder, "mute");
    set(&config, "run", "fill");
    set(&config, "vary", "a=1|2|3|4");
    CHECK_STATUS(clast_study_run(&config, folder, &worker, NULL, NULL, &report), CLAST_E_NO);
    assert_int_equal(report.n_done, 3);
    assert_int_equal(report.n_unconverged, 1);
    CHECK_ABS(result(folder, "results.csv", "exit_code", 0), 5.0, 0.0);
    CHECK_ABS(result(folder, "results.csv", "exit_code", 3), 1.0, 0.0);
    check_outcomes(folder, (clast_study_outcomes){4, 3, 1, 1});
    assert_true(isnan(result(folder, "results.csv", "x.y", 0)));
    CHECK_ABS(result(folder, "results.csv", "x.y", 1), 10.0, 0.0);
    assert_true(isnan(result(folder, "times.csv", "wall_s", 0)));
    const char *said = text_of(folder, "runs/000003.part/messages.txt");
    assert_non_null(strstr(said, "the run was ended by signal 9 ("));
    p.code[2] = 0;
    CHECK_OK(clast_study_run(&config, folder, &worker, NULL, NULL, &report));
    assert_int_equal(report.n_unconverged, 1);
    clast_fields_free(clast_study_fields, &config);
}

static bool has_column(const char *folder, const char *file, const char *column)
{
    char path[600];
    clast_table table = {0};
    (void)snprintf(path, sizeof path, "%s/%s", folder, file);
    CHECK_OK(clast_table_read_csv(path, NULL, &table, NULL));
    const bool has = clast_table_find(&table, column) >= 0;
    clast_table_free(&table);
    return has;
}

/* A study of shape had no column but the number of grains: all else is in a list, of one grain. */
static void numbers_of_a_list_of_one_are_columns(void **state)
{
    (void)state;
    char folder[512];
    pretender p = {0};
    clast_study_report report;
    clast_study_config config = fresh();
    const clast_study_worker worker = worker_of(&p);
    folder_for(folder, "listing");
    set(&config, "run", "fill");
    set(&config, "vary", "a=1|2");
    CHECK_OK(clast_study_run(&config, folder, &worker, NULL, NULL, &report));
    CHECK_ABS(result(folder, "results.csv", "only.0.z", 1), 11.0, 0.0);
    CHECK_ABS(result(folder, "results.csv", "one.0", 1), 7.0, 0.0);
    CHECK_ABS(result(folder, "times.csv", "only.0.wall_s", 0), 2.0, 0.0);
    assert_false(has_column(folder, "results.csv", "only.0.x.y")); // told above, as x.y
    assert_false(has_column(folder, "results.csv", "list.0"));
    set(&config, "keep", "only.0.z");
    CHECK_OK(clast_study_run(&config, folder, &worker, NULL, NULL, &report));
    CHECK_ABS(result(folder, "results.csv", "only.0.z", 1), 11.0, 0.0);
    clast_fields_free(clast_study_fields, &config);
}

static void check_says(const char *part)
{
    if (strstr(clast_error_detail(), part) == NULL) {
        fail_msg("'%s' does not say '%s'", clast_error_detail(), part);
    }
}

/* The runs of commands without a folder have no manifest: another file was taken without a word. */
static void a_study_keeps_to_its_input(void **state)
{
    (void)state;
    char folder[512];
    pretender p = {0};
    clast_study_report report;
    clast_study_config config = fresh();
    const clast_study_worker worker = worker_of(&p);
    folder_for(folder, "inputs");
    set(&config, "run", "shape");
    set(&config, "argument", write_file("grain.ply", "one"));
    set(&config, "vary", "axes=feret|fitted");
    set(&config, "shard", "1/2");
    CHECK_OK(clast_study_run(&config, folder, &worker, NULL, NULL, &report));
    (void)write_file("grain.ply", "another");
    set(&config, "shard", "2/2");
    CHECK_STATUS(clast_study_run(&config, folder, &worker, NULL, NULL, &report), CLAST_E_USAGE);
    check_says("grain.ply is not the file that run 1 of this study was made with");
    assert_int_equal(p.n_started, 1);
    (void)write_file("grain.ply", "one");
    CHECK_OK(clast_study_run(&config, folder, &worker, NULL, NULL, &report));
    assert_int_equal(p.n_started, 2);
    (void)unlink(support_scratch_file("grain.ply")); // whoever only tabulates does not need it
    CHECK_OK(clast_study_run(&config, folder, &worker, NULL, NULL, &report));
    clast_fields_free(clast_study_fields, &config);
}

/* Where no run has an answer, a mended input is what the same call is to be tried again with. */
static void an_input_may_be_mended_before_a_run_is_done(void **state)
{
    (void)state;
    char folder[512];
    pretender p = {.code = {3, 3}};
    clast_study_report report;
    clast_study_config config = fresh();
    const clast_study_worker worker = worker_of(&p);
    folder_for(folder, "mended");
    set(&config, "run", "grading");
    char name[600];
    (void)snprintf(name, sizeof name, "list:%s", write_file("sizes.csv", "broken"));
    set(&config, "argument", name);
    set(&config, "vary", "spread=step|means");
    CHECK_STATUS(clast_study_run(&config, folder, &worker, NULL, NULL, &report), CLAST_E_NO);
    (void)write_file("sizes.csv", "whole");
    p.code[0] = 0;
    CHECK_STATUS(clast_study_run(&config, folder, &worker, NULL, NULL, &report), CLAST_E_NO);
    (void)write_file("sizes.csv", "other");
    CHECK_STATUS(clast_study_run(&config, folder, &worker, NULL, NULL, &report), CLAST_E_USAGE);
    check_says("sizes.csv is not the file that run 1");
    (void)write_file("sizes.csv", "whole");
    p.code[1] = 0;
    CHECK_OK(clast_study_run(&config, folder, &worker, NULL, NULL, &report));
    clast_fields_free(clast_study_fields, &config);
}

static void another_table_or_configuration_is_named(void **state)
{
    (void)state;
    char folder[512];
    pretender p = {0};
    clast_study_report report;
    clast_study_config config = fresh();
    const clast_study_worker worker = worker_of(&p);
    folder_for(folder, "named");
    set(&config, "run", "fill");
    set(&config, "table", write_file("rows.csv", "a\n1\n2\n"));
    set(&config, "config", write_file("run.yaml", "b: 1\n"));
    CHECK_OK(clast_study_run(&config, folder, &worker, NULL, NULL, &report));
    (void)write_file("rows.csv", "# the same runs\na\n1\n2\n");
    CHECK_OK(clast_study_run(&config, folder, &worker, NULL, NULL, &report));
    (void)write_file("rows.csv", "a\n1\n3\n");
    CHECK_STATUS(clast_study_run(&config, folder, &worker, NULL, NULL, &report), CLAST_E_USAGE);
    check_says("rows.csv");
    (void)write_file("rows.csv", "a\n1\n2\n");
    (void)write_file("run.yaml", "b: 2\n");
    CHECK_STATUS(clast_study_run(&config, folder, &worker, NULL, NULL, &report), CLAST_E_USAGE);
    check_says("run.yaml");
    set(&config, "fix", "c=1");
    CHECK_STATUS(clast_study_run(&config, folder, &worker, NULL, NULL, &report), CLAST_E_USAGE);
    check_says("holds another study (fix differs)");
    clast_fields_free(clast_study_fields, &config);
}

/* study.json of before: no versions, no inputs. It stays as it is, so that the clast that began the
   study can go on with it, too. */
static void a_study_of_an_older_clast_goes_on(void **state)
{
    (void)state;
    static const char old[] = "{\"study\": {\"run\": \"fill\", \"config\": \"\", \"argument\": [], "
                              "\"fix\": [], \"vary\": "
                              "[\"a=1|2\"], \"design\": \"grid\", \"table\": \"\", \"seeds\": 1, "
                              "\"seed\": 1, \"keep\": [], "
                              "\"shard\": \"\"},\n\"config_sha256\": \"\"}\n";
    char folder[512];
    char path[600];
    pretender p = {0};
    clast_study_report report;
    clast_study_config config = fresh();
    const clast_study_worker worker = worker_of(&p);
    folder_for(folder, "older");
    assert_int_equal(mkdir(folder, 0777), 0);
    (void)snprintf(path, sizeof path, "%s/study.json", folder);
    FILE *file = fopen(path, "w");
    assert_true(file != NULL && fputs(old, file) >= 0 && fclose(file) == 0);
    set(&config, "run", "fill");
    set(&config, "vary", "a=1|2");
    CHECK_OK(clast_study_run(&config, folder, &worker, NULL, NULL, &report));
    assert_int_equal(report.n_done, 2);
    assert_string_equal(text_of(folder, "study.json"), old);
    set(&config, "seeds", "2");
    CHECK_STATUS(clast_study_run(&config, folder, &worker, NULL, NULL, &report), CLAST_E_USAGE);
    clast_fields_free(clast_study_fields, &config);
}

static void versions_that_worked_on_a_study_are_kept(void **state)
{
    (void)state;
    char folder[512];
    char path[600];
    char wanted[128];
    pretender p = {.code = {0, 3}};
    clast_study_report report;
    clast_study_config config = fresh();
    const clast_study_worker worker = worker_of(&p);
    folder_for(folder, "versions");
    set(&config, "run", "fill");
    set(&config, "vary", "a=1|2");
    CHECK_STATUS(clast_study_run(&config, folder, &worker, NULL, NULL, &report), CLAST_E_NO);
    (void)snprintf(wanted, sizeof wanted, "\"clast_versions\": [\"%s\"]", clast_version());
    char *text = text_of(folder, "study.json");
    char *at = strstr(text, wanted);
    assert_non_null(at);
    memcpy(strstr(at, "[\"") + 2, "9.8.7", 5); // begun by another
    (void)snprintf(path, sizeof path, "%s/study.json", folder);
    FILE *file = fopen(path, "w");
    assert_true(file != NULL && fputs(text, file) >= 0 && fclose(file) == 0);
    p.code[1] = 0;
    CHECK_OK(clast_study_run(&config, folder, &worker, NULL, NULL, &report));
    (void)snprintf(wanted, sizeof wanted, "\"clast_versions\": [\"9.8.7\", \"%s\"]",
                   clast_version());
    assert_non_null(strstr(text_of(folder, "study.json"), wanted));
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
        cmocka_unit_test(the_first_seed_is_as_the_command_reads_it),
        cmocka_unit_test(zip_goes_through_lists_together),
        cmocka_unit_test(table_rows_are_runs_and_cross_with_lists),
        cmocka_unit_test(a_table_without_rows_is_refused),
        cmocka_unit_test(a_key_of_two_spellings_varies_once),
        cmocka_unit_test(seeds_of_a_table_keep_their_digits),
        cmocka_unit_test(the_same_values_are_refused_however_they_are_written),
        cmocka_unit_test(malformed_designs_are_refused),
        cmocka_unit_test(keys_of_another_command_are_refused),
        cmocka_unit_test(plan_survives_refused_memory),
        cmocka_unit_test(failed_runs_are_noted_and_tried_again),
        cmocka_unit_test(a_run_without_a_result_has_its_exit_code_alone),
        cmocka_unit_test(numbers_of_a_list_of_one_are_columns),
        cmocka_unit_test(a_study_keeps_to_its_input),
        cmocka_unit_test(an_input_may_be_mended_before_a_run_is_done),
        cmocka_unit_test(another_table_or_configuration_is_named),
        cmocka_unit_test(a_study_of_an_older_clast_goes_on),
        cmocka_unit_test(versions_that_worked_on_a_study_are_kept),
        cmocka_unit_test(stopped_study_goes_on),
        cmocka_unit_test(shards_share_the_runs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
