/* Unit: an output file is whole or absent, whatever the disk does. */
#include "support.h"

#include "base/alloc.h"
#include "base/file.h"
#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Entries of a folder besides . and .. */
static int n_entry(const char *folder)
{
    int n = -2;
    DIR *list = opendir(folder);
    assert_non_null(list);
    while (readdir(list) != NULL) {
        ++n;
    }
    (void)closedir(list);
    return n;
}

static void check_content(const char *path, const char *expected)
{
    char *bytes = NULL;
    int64_t n = 0;
    CHECK_OK(clx_file_read_all(path, 1 << 20, &bytes, &n));
    assert_int_equal(n, (int64_t)strlen(expected));
    assert_string_equal(bytes, expected);
    clx_free(bytes);
}

static clast_status write_text(const char *path, const char *text)
{
    clast_status status = CLAST_OK;
    clx_file file = {0};
    CLX_TRY(clx_file_begin(path, &file));
    CLX_TRY(clx_file_print(&file, "%s", text));
    CLX_TRY(clx_file_commit(&file));
done:
    clx_file_abandon(&file);
    return status;
}

static void committed_file_is_there_and_replaces(void **state)
{
    (void)state;
    const char *folder = support_scratch_file("commit");
    const char *path = support_scratch_file("commit/a.txt");
    struct stat info;
    CHECK_OK(clx_folder_make(folder));
    CHECK_OK(write_text(path, "first\n"));
    check_content(path, "first\n");
    CHECK_OK(write_text(path, "second\n"));
    check_content(path, "second\n");
    assert_int_equal(n_entry(folder), 1);
    const mode_t mask = umask(0);
    (void)umask(mask);
    assert_int_equal(stat(path, &info), 0);
    assert_int_equal(info.st_mode & 0777, 0666 & ~mask);
}

static void abandoned_file_leaves_nothing(void **state)
{
    (void)state;
    const char *folder = support_scratch_file("abandon");
    clx_file file = {0};
    clx_file_abandon(&file);
    CHECK_OK(clx_folder_make(folder));
    CHECK_OK(clx_file_begin(support_scratch_file("abandon/a.txt"), &file));
    CHECK_OK(clx_file_write(&file, "half", 4));
    assert_int_equal(n_entry(folder), 1);
    clx_file_abandon(&file);
    clx_file_abandon(&file);
    assert_int_equal(n_entry(folder), 0);
}

static void unwritable_places_are_named(void **state)
{
    (void)state;
    clx_file file = {0};
    CHECK_STATUS(clx_file_begin(support_scratch_file("absent/a.txt"), &file), CLAST_E_DISK);
    assert_non_null(strstr(clast_error_detail(), "there is no folder"));
    CHECK_STATUS(clx_file_begin(support_scratch(), &file), CLAST_E_DISK);
    assert_non_null(strstr(clast_error_detail(), "it is a folder"));
    CHECK_STATUS(clx_file_begin("", &file), CLAST_E_DISK);
    CHECK_STATUS(clx_file_begin("/proc/clast.txt", &file), CLAST_E_DISK);
    CHECK_OK(write_text(support_scratch_file("plain"), "x"));
    CHECK_STATUS(clx_file_begin(support_scratch_file("plain/a.txt"), &file), CLAST_E_DISK);
    CHECK_STATUS(clx_folder_make(support_scratch_file("plain")), CLAST_E_DISK);
    CHECK_STATUS(clx_folder_make(support_scratch_file("plain/below")), CLAST_E_DISK);
    assert_null(file.path);
}

/* /dev/full says ENOSPC to every write: a real full disk, no hook. */
static void full_device_is_reported(void **state)
{
    (void)state;
    CHECK_STATUS(write_text("/dev/full", "x"), CLAST_E_DISK);
    assert_non_null(strstr(clast_error_detail(), "No space left"));
    CHECK_OK(write_text("/dev/null", "x"));
}

static void link_is_followed_not_replaced(void **state)
{
    (void)state;
    struct stat info;
    const char *link = support_scratch_file("link");
    CHECK_OK(write_text(support_scratch_file("linked"), "old"));
    assert_int_equal(symlink("linked", link), 0);
    CHECK_OK(write_text(link, "new"));
    check_content(support_scratch_file("linked"), "new");
    assert_int_equal(lstat(link, &info), 0);
    assert_true(S_ISLNK(info.st_mode));
}

#ifdef CLAST_ALLOC_INJECT
/* 200,000 bytes: several buffers, so that the refused operation is each of open, write, sync,
   rename and folder sync. */
static clast_status write_long(const char *path)
{
    clast_status status = CLAST_OK;
    clx_file file = {0};
    CLX_TRY(clx_file_begin(path, &file));
    for (int i = 0; i < 20000; ++i) {
        (void)clx_file_print(&file, "%09d\n", i); /* errors are sticky */
    }
    CLX_TRY(clx_file_commit(&file));
done:
    clx_file_abandon(&file);
    return status;
}

static int64_t size_of(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 ? (int64_t)info.st_size : -1;
}
#endif

static void every_refused_operation_keeps_the_old_file(void **state)
{
    (void)state;
#ifdef CLAST_ALLOC_INJECT
    const char *folder = support_scratch_file("refuse");
    const char *path = support_scratch_file("refuse/a.txt");
    CHECK_OK(clx_folder_make(folder));
    int k = 1;
    for (;; ++k) {
        CHECK_OK(write_text(path, "old"));
        const int64_t live = clx_alloc_live();
        (void)clx_file_refuse(k, ENOSPC);
        const clast_status status = write_long(path);
        const bool struck = clx_file_refuse(0, 0) <= 0;
        assert_int_equal(clx_alloc_live(), live);
        assert_int_equal(n_entry(folder), 1); /* no temporary file is left */
        if (!struck) {
            CHECK_OK(status);
            break;
        }
        CHECK_STATUS(status, CLAST_E_DISK);
        assert_non_null(strstr(clast_error_detail(), "No space left on device"));
        assert_null(strchr(clast_error_detail(), '\n'));
        assert_true(size_of(path) == 3 ||
                    (size_of(path) == 200000 && strstr(clast_error_detail(), "folder") != NULL));
    }
    assert_int_equal(size_of(path), 200000);
    assert_int_equal(k,
                     1 + 4 + 1 + 1 + 2 + 1); /* open, 4 writes, sync, rename, folder open, sync */
#endif
}

static clast_status write_and_read(void *context)
{
    char *bytes = NULL;
    int64_t n = 0;
    clast_status status = write_text(context, "some text");
    if (status == CLAST_OK) {
        status = clx_file_read_all(context, 100, &bytes, &n);
    }
    clx_free(bytes);
    return status;
}

static void files_survive_refused_memory(void **state)
{
    (void)state;
    support_refuse_each_allocation_at(write_and_read, "memory.txt");
}

static void reading_is_bounded(void **state)
{
    (void)state;
    char *bytes = NULL;
    int64_t n = 0;
    const char *path = support_scratch_file("bounded");
    CHECK_OK(write_text(path, "12345"));
    CHECK_OK(clx_file_read_all(path, 5, &bytes, &n));
    clx_free(bytes);
    CHECK_STATUS(clx_file_read_all(path, 4, &bytes, &n), CLAST_E_LIMIT);
    CHECK_STATUS(clx_file_read_all("/dev/zero", 100000, &bytes, &n), CLAST_E_LIMIT);
    CHECK_STATUS(clx_file_read_all(support_scratch_file("absent"), 4, &bytes, &n), CLAST_E_IO);
    CHECK_STATUS(clx_file_read_all(support_scratch(), 4, &bytes, &n), CLAST_E_IO);
}

static void folders_are_made_with_their_parents(void **state)
{
    (void)state;
    CHECK_OK(clx_folder_make(support_scratch_file("f1/f2/f3/")));
    CHECK_OK(clx_folder_make(support_scratch_file("f1/f2/f3")));
    assert_int_equal(n_entry(support_scratch_file("f1/f2")), 1);
    CHECK_STATUS(clx_folder_make(""), CLAST_E_DISK);
    CHECK_STATUS(clx_folder_make("/proc/clast"), CLAST_E_DISK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(committed_file_is_there_and_replaces),
        cmocka_unit_test(abandoned_file_leaves_nothing),
        cmocka_unit_test(unwritable_places_are_named),
        cmocka_unit_test(full_device_is_reported),
        cmocka_unit_test(link_is_followed_not_replaced),
        cmocka_unit_test(every_refused_operation_keeps_the_old_file),
        cmocka_unit_test(files_survive_refused_memory),
        cmocka_unit_test(reading_is_bounded),
        cmocka_unit_test(folders_are_made_with_their_parents),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
