/* Unit: a run that is to replace another does so whole or not at all, whatever the disk refuses. */
#include "support.h"

#include "base/alloc.h"
#include "base/file.h"
#include "run/run.h"
#include <clast/run_folder.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

/// A run whose summary is this text, and a second file of its own.
static clast_status make_run(const char *folder, bool force, const char *summary, const char *file)
{
    clast_status status = CLAST_OK;
    char path[CLAST_RUN_PATH];
    clast_run_folder *run = NULL;
    CLX_TRY(clast_run_folder_begin(folder, force, "test", NULL, &run));
    CLX_TRY(clast_run_folder_open(run));
    CLX_TRY(clast_run_folder_file(run, file, path));
    CLX_TRY(clx_file_write_all(path, summary, strlen(summary)));
    CLX_TRY(clast_run_folder_summary(run, summary));
done:
    status = clast_run_folder_end(run, status);
    clast_run_folder_destroy(run);
    return status;
}

static bool holds(const char *folder, const char *name, const char *text)
{
    char path[CLAST_RUN_PATH];
    char *found = NULL;
    int64_t n = 0;
    (void)snprintf(path, sizeof path, "%s/%s", folder, name);
    const bool is_there = clx_file_read_all(path, 1000, &found, &n) == CLAST_OK;
    const bool is_equal = text == NULL ? !is_there : is_there && strcmp(found, text) == 0;
    clx_free(found);
    return is_equal;
}

static bool is_run(const char *folder, const char *which)
{
    const bool is_new = strcmp(which, "new") == 0;
    return holds(folder, "summary.json", is_new ? "new\n" : "old\n") &&
           holds(folder, "old.csv", is_new ? NULL : "old") &&
           holds(folder, "new.csv", is_new ? "new" : NULL) && holds(folder, "notes.txt", "mine") &&
           clast_run_folder_check(folder) == CLAST_OK;
}

static void fresh(const char *folder)
{
    char path[CLAST_RUN_PATH];
    char beside[CLAST_RUN_PATH];
    (void)snprintf(path, sizeof path, "%s/notes.txt", folder);
    (void)snprintf(beside, sizeof beside, "%s.new", folder);
    CHECK_OK(clx_run_remove_tree(beside));
    CHECK_OK(clx_run_remove_tree(folder));
    CHECK_OK(make_run(folder, false, "old", "old.csv"));
    CHECK_OK(clx_file_write_all(path, "mine", 4));
}

static void every_refused_operation_leaves_a_whole_run(void **state)
{
    (void)state;
#ifdef CLAST_ALLOC_INJECT
    const char *folder = support_scratch_file("replace");
    int n_old = 0;
    for (int64_t k = 1;; ++k) {
        fresh(folder);
        (void)clx_file_refuse(k, ENOSPC);
        const clast_status status = make_run(folder, true, "new", "new.csv");
        const bool struck = clx_file_refuse(0, 0) <= 0;
        if (!struck) {
            CHECK_OK(status);
            assert_true(is_run(folder, "new"));
            break;
        }
        assert_true(status == CLAST_OK || status == CLAST_E_DISK);
        const bool is_old = is_run(folder, "old");
        n_old += is_old;
        if (status == CLAST_OK) {
            assert_true(is_run(folder, "new"));
        } else {
            assert_true(is_old || holds(folder, "summary.json", "new\n"));
        }
        /* what is left beside is no obstacle */
        CHECK_OK(make_run(folder, true, "new", "new.csv"));
        assert_true(is_run(folder, "new"));
    }
    assert_true(n_old > 8);
#endif
}

static clast_status replace_once(void *context)
{
    return make_run(context, true, "new", "new.csv");
}

static void refused_memory_leaves_a_whole_run(void **state)
{
    (void)state;
    char folder[CLAST_RUN_PATH];
    (void)snprintf(folder, sizeof folder, "%s", support_scratch_file("memory"));
    fresh(folder);
    support_refuse_each_allocation(replace_once, folder);
    CHECK_OK(replace_once(folder));
    assert_true(is_run(folder, "new"));
}

/* flock: the second finds the first at work; a finished one gives the folder free. */
static void a_folder_under_way_is_refused(void **state)
{
    (void)state;
    const char *folder = support_scratch_file("under-way");
    clast_run_folder *first = NULL;
    clast_run_folder *second = NULL;
    CHECK_OK(clx_run_remove_tree(folder));
    CHECK_OK(clast_run_folder_begin(folder, false, "test", NULL, &first));
    CHECK_OK(clast_run_folder_open(first));
    CHECK_STATUS(clast_run_folder_begin(folder, true, "test", NULL, &second), CLAST_E_DISK);
    CHECK_STATUS(clx_run_folder_resume(folder, "test", NULL, &second), CLAST_E_DISK);
    CHECK_STATUS(clast_run_folder_check(folder), CLAST_E_IO);
    assert_non_null(strstr(clast_error_detail(), "still running"));
    (void)clast_run_folder_end(first, CLAST_E_CONVERGE);
    clast_run_folder_destroy(first);
    CHECK_STATUS(clast_run_folder_check(folder), CLAST_E_IO);
    assert_non_null(strstr(clast_error_detail(), "failed"));
    CHECK_OK(make_run(folder, true, "new", "new.csv"));
    CHECK_OK(clast_run_folder_check(folder));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_refused_operation_leaves_a_whole_run),
        cmocka_unit_test(refused_memory_leaves_a_whole_run),
        cmocka_unit_test(a_folder_under_way_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
