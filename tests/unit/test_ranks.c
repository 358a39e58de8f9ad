// Unit: studies and repeats end the same on 1, 2 and 4 ranks, and fail on all ranks when they fail
// on one.
#include "aggregates.h"
#include "ranks.h"

#include "base/alloc.h"
#include "base/file.h"
#include <clast/aggregate_run.h>
#include <clast/fill.h>
#include <clast/run_folder.h>
#include <clast/study.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static const int32_t counts[] = {1, 2, 4};

typedef struct {
    char folder[512];
    clast_aggregate_config *aggregate;
    int32_t bad_rank;   ///< whose runs cannot start; -1: none
    int32_t stop_rank;  ///< that is asked to stop; -1: none
    int32_t stop_after; ///< that many questions
    bool resumes;
    clast_status expects;
    const char *says;           ///< within the error text on every rank, or NULL
    clast_study_report *report; ///< shared: of each rank
} job;

/// A worker that runs nothing: each run ends when it is asked after, run 3 with code 4.
typedef struct {
    int64_t queue[8];
    int n, n_asked;
    const job *job;
    int32_t rank;
    bool stopped;
} pretender;

static clast_status pretend_start(void *context, const clast_study_item *item)
{
    pretender *p = context;
    char text[64];
    char path[600];
    const int n = snprintf(text, sizeof text, "{\"x\": %d}\n", (int)item->row * 10);
    (void)snprintf(path, sizeof path, "%s/result.json", item->folder);
    if (p->rank == p->job->bad_rank) {
        return clx_fail(CLAST_E_MEMORY, "no room for a process");
    }
    p->queue[p->n++] = item->row;
    return clx_file_write_all(path, text, (size_t)n);
}

static clast_status pretend_wait(void *context, int64_t *row, int *exit_code)
{
    pretender *p = context;
    *row = p->queue[--p->n];
    *exit_code = p->stopped ? 143 : *row == 2 ? 4 : 0;
    return CLAST_OK;
}

static void pretend_stop(void *context)
{
    ((pretender *)context)->stopped = true;
}

static bool wants_stop(void *context)
{
    pretender *p = context;
    return p->rank == p->job->stop_rank && ++p->n_asked > p->job->stop_after;
}

static int check_end(const job *j, clast_status status)
{
    RANK_CHECK(status == j->expects);
    RANK_CHECK(j->says == NULL || strstr(clast_error_detail(), j->says) != NULL);
    return 0;
}

static int do_study(const clast_comm *comm, void *context)
{
    const job *j = context;
    pretender p = {.job = j, .rank = comm->rank};
    const clast_study_worker worker = {true,         true,         false, pretend_start,
                                       pretend_wait, pretend_stop, &p};
    const clast_monitor monitor = {.stop = wants_stop, .context = &p};
    clast_study_config config;
    RANK_CHECK(clast_fields_default(clast_study_fields, &config) == CLAST_OK);
    RANK_CHECK(clast_field_set(clast_fields_find(clast_study_fields, "run"), &config, "aggregate",
                               false) == CLAST_OK);
    config.seeds = 40;
    const clast_status status =
        clast_study_run(&config, j->folder, &worker, comm, &monitor, &j->report[comm->rank]);
    clast_fields_free(clast_study_fields, &config);
    return check_end(j, status);
}

static job fresh(const char *name, int32_t n_rank)
{
    job j = {.bad_rank = -1, .stop_rank = -1};
    (void)snprintf(j.folder, sizeof j.folder, "%s/%s-%d", support_scratch(), name, (int)n_rank);
    j.report = support_shared_memory(8 * sizeof *j.report);
    return j;
}

/// Fails unless both folders hold the same bytes in the file.
static void check_same(const char *folder, const char *other, const char *name)
{
    char path[600];
    char *bytes[2] = {NULL, NULL};
    int64_t n[2] = {0, 0};
    for (int k = 0; k < 2; ++k) {
        (void)snprintf(path, sizeof path, "%s/%s", k == 0 ? folder : other, name);
        CHECK_OK(clx_file_read_all(path, 1 << 24, &bytes[k], &n[k]));
    }
    assert_int_equal(n[0], n[1]);
    assert_memory_equal(bytes[0], bytes[1], (size_t)n[0]);
    clx_free(bytes[0]);
    clx_free(bytes[1]);
}

static void studies_end_in_one_table(void **state)
{
    (void)state;
    job one = fresh("table", 1);
    for (size_t i = 0; i < 3; ++i) {
        job j = fresh("table", counts[i]);
        j.expects = CLAST_E_NO;
        j.says = "1 of 40 runs failed, the first is run 3";
        support_run_ranks(counts[i], do_study, &j);
        for (int32_t k = 0; k < counts[i]; ++k) {
            assert_int_equal(j.report[k].n_done, 39);
            assert_int_equal(j.report[k].n_failed, 1);
            assert_int_equal(j.report[k].first_failed, 3);
        }
        check_same(one.folder, j.folder, "results.csv");
    }
}

static void a_rank_that_cannot_work_is_heard_on_all(void **state)
{
    (void)state;
    job j = fresh("broken", 4);
    j.bad_rank = 2;
    j.expects = CLAST_E_MEMORY;
    j.says = "rank 2: no room for a process";
    support_run_ranks(4, do_study, &j);
}

static void a_stopped_study_goes_on_with_other_ranks(void **state)
{
    (void)state;
    job one = fresh("unstopped", 1);
    job j = fresh("stopped", 4);
    one.expects = CLAST_E_NO;
    support_run_ranks(1, do_study, &one);
    j.stop_rank = 0; // the others are waiting or at work
    j.stop_after = 4;
    j.expects = CLAST_E_STOPPED;
    j.says = "the same call goes on";
    support_run_ranks(4, do_study, &j);
    j.stop_rank = -1;
    j.expects = CLAST_E_NO;
    j.says = NULL;
    support_run_ranks(2, do_study, &j);
    assert_true(j.report[1].n_before > 0 && j.report[1].n_before < 39);
    check_same(one.folder, j.folder, "results.csv");
}

static int do_repeats(const clast_comm *comm, void *context)
{
    const job *j = context;
    pretender p = {.job = j, .rank = comm->rank};
    const clast_monitor monitor = {.stop = wants_stop, .context = &p};
    clast_aggregate_report report = {0};
    const clast_status status =
        j->resumes ? clast_aggregate_resume(j->folder, comm, &monitor, &report)
                   : clast_aggregate_run(j->aggregate, j->folder, comm, &monitor, &report);
    RANK_CHECK(status != CLAST_OK || report.n == (comm->rank == 0 ? j->aggregate->repeats : 0));
    clast_aggregate_report_free(&report);
    return check_end(j, status);
}

#define SMALL                                                                                      \
    "core=sphere;core_size=30 um;coat=sphere;size=8 um;n_particle=24;replicate=24;rays=10;"        \
    "repeats=5;picture=false;envelope=sphere_hull;solid_union=false;checkpoint_every=6;seed=3"

static clast_aggregate_config small(void)
{
    clast_aggregate_config config;
    CHECK_OK(clast_fields_default(clast_aggregate_fields, &config));
    support_aggregate_options(&config, SMALL);
    return config;
}

static void check_same_repeats(const job *a, const job *b)
{
    static const char *const files[] = {"history.csv",   "summary.json",  "history_band.csv",
                                        "sizes.csv",     "structure.csv", "aggregate.stl",
                                        "state-0003.h5", "state-0005.h5"};
    for (size_t k = 0; k < sizeof files / sizeof files[0]; ++k) {
        check_same(a->folder, b->folder, files[k]);
    }
}

static void repeats_end_in_the_same_bytes(void **state)
{
    (void)state;
    clast_aggregate_config config = small();
    job one = fresh("repeats", 1);
    for (size_t i = 0; i < 3; ++i) {
        job j = fresh("repeats", counts[i]);
        j.aggregate = &config;
        support_run_ranks(counts[i], do_repeats, &j);
        check_same_repeats(&one, &j);
    }
    clast_fields_free(clast_aggregate_fields, &config);
}

static void stopped_repeats_go_on_with_other_ranks(void **state)
{
    (void)state;
    char path[600];
    clast_aggregate_config config = small();
    job one = fresh("whole", 1);
    one.aggregate = &config;
    support_run_ranks(1, do_repeats, &one);
    for (int32_t stop_rank = 0; stop_rank < 3; stop_rank += 2) {
        job j = fresh(stop_rank == 0 ? "cut" : "cut-on-another", 3);
        struct stat found;
        j.aggregate = &config;
        j.stop_rank = stop_rank;
        j.stop_after = 15; // within the rank's first repeat
        j.expects = CLAST_E_STOPPED;
        j.says = "--resume";
        support_run_ranks(3, do_repeats, &j);
        (void)snprintf(path, sizeof path, "%s/summary.json", j.folder);
        assert_int_not_equal(stat(path, &found), 0);
        j.stop_rank = -1;
        j.expects = CLAST_OK;
        j.says = NULL;
        j.resumes = true;
        support_run_ranks(2, do_repeats, &j);
        check_same_repeats(&one, &j);
        (void)snprintf(path, sizeof path, "%s/repeat-0002", j.folder);
        assert_int_not_equal(stat(path, &found), 0); // its checkpoints went with the end
    }
    clast_fields_free(clast_aggregate_fields, &config);
}

/// What ranks read, rank 2 in a way of its own.
typedef struct {
    const char *seed[2];
    int32_t spheres[2];
    char path[2][512];
    int32_t n_file;
    const char *says; ///< NULL: they agree
} reading;

static int read_inputs(const clast_comm *comm, void *context)
{
    const reading *r = context;
    const int own = comm->rank == 2;
    const char *const file[2] = {r->path[own], "absent"};
    clast_fill_config config;
    RANK_CHECK(clast_fields_default(clast_fill_fields, &config) == CLAST_OK);
    RANK_CHECK(clast_field_set(clast_fields_find(clast_fill_fields, "seed"), &config, r->seed[own],
                               false) == CLAST_OK);
    config.spheres = r->spheres[own];
    const clast_status status =
        clast_run_inputs_agree(comm, clast_fill_fields, &config, r->n_file, file);
    clast_fields_free(clast_fill_fields, &config);
    RANK_CHECK(status == (r->says != NULL ? CLAST_E_FORMAT : CLAST_OK));
    RANK_CHECK(r->says == NULL || strstr(clast_error_detail(), r->says) != NULL);
    return 0;
}

static void ranks_that_read_other_things_are_refused(void **state)
{
    (void)state;
    reading r = {{"1", "1"}, {3, 3}, .n_file = 2};
    for (int k = 0; k < 2; ++k) {
        (void)snprintf(r.path[k], sizeof r.path[k], "%s/copy-%d", support_scratch(), k);
        CHECK_OK(clx_file_write_all(r.path[k], "same", 4));
    }
    support_run_ranks(3, read_inputs, &r); // of other names: a caller's options would differ
    support_run_ranks(1, read_inputs, &r);
    CHECK_OK(clx_file_write_all(r.path[1], "some", 4));
    r.says = "rank 2: reads another ";
    support_run_ranks(3, read_inputs, &r);
    (void)snprintf(r.path[1], sizeof r.path[1], "absent on rank 2");
    r.says = NULL; // whoever opens it says so
    support_run_ranks(3, read_inputs, &r);
    r.n_file = 0;
    r.spheres[1] = 4;
    r.says = "rank 2: reads another configuration than rank 0 (spheres differs)";
    support_run_ranks(3, read_inputs, &r);
    r.spheres[1] = 3;
    r.seed[0] = "18446744073709551614"; // one number, where JSON's are doubles
    r.seed[1] = "18446744073709551615";
    r.says = "rank 2: reads another configuration than rank 0 (the seed differs)";
    support_run_ranks(3, read_inputs, &r);
}

static void a_disk_that_refuses_one_repeat_fails_all_ranks(void **state)
{
    (void)state;
    char path[600];
    clast_aggregate_config config = small();
    job j = fresh("refusing", 3);
    j.aggregate = &config;
    j.expects = CLAST_E_DISK;
    j.says = "state-0003.h5";
    assert_int_equal(mkdir(j.folder, 0777), 0);
    (void)snprintf(path, sizeof path, "%s/state-0003.h5", j.folder);
    assert_int_equal(mkdir(path, 0777), 0);
    support_run_ranks(3, do_repeats, &j);
    clast_fields_free(clast_aggregate_fields, &config);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(studies_end_in_one_table),
        cmocka_unit_test(a_rank_that_cannot_work_is_heard_on_all),
        cmocka_unit_test(a_stopped_study_goes_on_with_other_ranks),
        cmocka_unit_test(repeats_end_in_the_same_bytes),
        cmocka_unit_test(stopped_repeats_go_on_with_other_ranks),
        cmocka_unit_test(ranks_that_read_other_things_are_refused),
        cmocka_unit_test(a_disk_that_refuses_one_repeat_fails_all_ranks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
