/* Unit: named arrays come back bit for bit, equal content gives equal bytes, damage is refused.
   Built twice where HDF5 is there: over HDF5 and over the plain files of clast's own (PLAIN). */
#include "support.h"

#include "base/alloc.h"
#include "base/file.h"
#include "run/checkpoint.h"
#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#if !PLAIN
#include <hdf5.h>
#endif

enum { N = 5000, LONG = PLAIN ? 64999 : 200000 }; /* plain: all that fits an attribute */

static double number_at(int64_t i)
{
    return 1.0 / (1.0 + (double)i);
}

/* One of everything: all types, ranks 0 to 3, empty arrays, several chunks, long and empty texts.
 */
static clast_status fill(clx_h5 *h5)
{
    clast_status status = CLAST_OK;
    double(*x)[3] = NULL;
    char *text = NULL;
    const int32_t i32[2][2] = {{INT32_MIN, INT32_MAX}, {0, -1}};
    const int64_t i64[1] = {INT64_MIN};
    const uint64_t u64 = UINT64_MAX;
    const uint8_t u8[3] = {0, 255, 7};
    const double odd[4] = {-0.0, INFINITY, NAN, 5e-324};
    CLX_TRY(clx_alloc(&x, (int64_t)40 * N, sizeof *x));
    for (int64_t i = 0; i < (int64_t)120 * N; ++i) {
        x[i / 3][i % 3] = number_at(i);
    }
    CLX_TRY(clx_h5_write(h5, "/engine/deep/x", CLX_H5_F64, 2, (int64_t[]){40 * N, 3}, x));
    CLX_TRY(clx_h5_write(h5, "/engine/i32", CLX_H5_I32, 2, (int64_t[]){2, 2}, i32));
    CLX_TRY(clx_h5_write(h5, "/engine/i64", CLX_H5_I64, 1, (int64_t[]){1}, i64));
    CLX_TRY(clx_h5_write(h5, "/engine/u64", CLX_H5_U64, 0, NULL, &u64));
    CLX_TRY(clx_h5_write(h5, "/engine/u8", CLX_H5_U8, 3, (int64_t[]){1, 3, 1}, u8));
    CLX_TRY(clx_h5_write(h5, "/odd", CLX_H5_F64, 1, (int64_t[]){4}, odd));
    CLX_TRY(clx_h5_write(h5, "/empty", CLX_H5_F64, 2, (int64_t[]){0, 3}, NULL));
    CLX_TRY(clx_h5_write_folder(h5, "/just/folders"));
    CLX_TRY(clx_alloc(&text, LONG + 1, 1));
    memset(text, 'y', LONG);
    CLX_TRY(clx_h5_write_text(h5, "/", "long", text));
    CLX_TRY(clx_h5_write_text(h5, "/engine", "none", ""));
    CLX_TRY(clx_h5_write_text(h5, "/odd", "unit", "\xc2\xb5m"));
    CLX_TRY(clx_h5_write_number(h5, "/odd", "third", CLX_H5_F64, &x[0][2]));
    CLX_TRY(clx_h5_write_number(h5, "/", "seed", CLX_H5_U64, &u64));
done:
    clx_free(x);
    clx_free(text);
    return status;
}

static clast_status write_one(const char *path)
{
    clast_status status = CLAST_OK;
    clx_h5 *h5 = NULL;
    CLX_TRY(clx_h5_create(&h5));
    CLX_TRY(fill(h5));
    CLX_TRY(clx_h5_commit(h5, path));
done:
    clx_h5_close(h5);
    return status;
}

static clast_status read_numbers(clx_h5 *h5, bool *correct)
{
    clast_status status = CLAST_OK;
    double(*x)[3] = NULL;
    int64_t n = 0;
    double odd[4];
    double third = 0.0;
    int32_t i32[2][2];
    uint64_t u64 = 0;
    uint8_t u8[3];
    CLX_TRY(clx_h5_read_new(h5, "/engine/deep/x", CLX_H5_F64, 3, &n, &x));
    *correct = n == (int64_t)40 * N;
    for (int64_t i = 0; i < (int64_t)120 * N && *correct; ++i) {
        *correct = x[i / 3][i % 3] == number_at(i);
    }
    CLX_TRY(clx_h5_read(h5, "/odd", CLX_H5_F64, 1, (int64_t[]){4}, odd));
    CLX_TRY(clx_h5_read(h5, "/engine/i32", CLX_H5_I32, 2, (int64_t[]){2, 2}, i32));
    CLX_TRY(clx_h5_read(h5, "/engine/u64", CLX_H5_U64, 0, NULL, &u64));
    CLX_TRY(clx_h5_read(h5, "/engine/u8", CLX_H5_U8, 3, (int64_t[]){1, 3, 1}, u8));
    CLX_TRY(clx_h5_read(h5, "/empty", CLX_H5_F64, 2, (int64_t[]){0, 3}, NULL));
    CLX_TRY(clx_h5_read_number(h5, "/odd", "third", CLX_H5_F64, &third));
    *correct = *correct && signbit(odd[0]) && isinf(odd[1]) && isnan(odd[2]) && odd[3] == 5e-324 &&
               i32[0][0] == INT32_MIN && i32[0][1] == INT32_MAX && i32[1][1] == -1 &&
               u64 == UINT64_MAX && u8[1] == 255 && third == number_at(2);
done:
    clx_free(x);
    return status;
}

static clast_status read_texts(clx_h5 *h5, bool *correct)
{
    clast_status status = CLAST_OK;
    char *text[3] = {0};
    CLX_TRY(clx_h5_read_text(h5, "/", "long", &text[0]));
    CLX_TRY(clx_h5_read_text(h5, "/engine", "none", &text[1]));
    CLX_TRY(clx_h5_read_text(h5, "/odd", "unit", &text[2]));
    *correct = *correct && strlen(text[0]) == LONG && text[0][LONG - 1] == 'y' &&
               text[1][0] == '\0' && strcmp(text[2], "\xc2\xb5m") == 0;
done:
    for (int i = 0; i < 3; ++i) {
        clx_free(text[i]);
    }
    return status;
}

static clast_status read_one(const char *path, bool *correct)
{
    clast_status status = CLAST_OK;
    clx_h5 *h5 = NULL;
    *correct = false;
    CLX_TRY(clx_h5_open(path, &h5));
    CLX_TRY(read_numbers(h5, correct));
    CLX_TRY(read_texts(h5, correct));
done:
    clx_h5_close(h5);
    return status;
}

static void everything_comes_back(void **state)
{
    (void)state;
    bool correct = false;
    CHECK_OK(write_one(support_scratch_file("all.h5")));
    CHECK_OK(read_one(support_scratch_file("all.h5"), &correct));
    assert_true(correct);
}

static void equal_content_gives_equal_bytes(void **state)
{
    (void)state;
    CHECK_OK(write_one(support_scratch_file("a.h5")));
    (void)sleep(1); /* object times have a resolution of one second */
    CHECK_OK(write_one(support_scratch_file("b.h5")));
    support_check_same_files(support_scratch_file("a.h5"), support_scratch_file("b.h5"));
}

static void members_are_listed_in_order(void **state)
{
    (void)state;
    clx_h5 *h5 = NULL;
    int64_t n = 0;
    char name[CLX_H5_NAME_LIMIT];
    CHECK_OK(write_one(support_scratch_file("list.h5")));
    CHECK_OK(clx_h5_open(support_scratch_file("list.h5"), &h5));
    CHECK_OK(clx_h5_count(h5, "/engine", &n));
    assert_int_equal(n, 5);
    CHECK_OK(clx_h5_member(h5, "/engine", 0, name));
    assert_string_equal(name, "deep");
    CHECK_OK(clx_h5_member(h5, "/engine", 4, name));
    assert_string_equal(name, "u8");
    CHECK_STATUS(clx_h5_member(h5, "/engine", 5, name), CLAST_E_FORMAT);
    CHECK_OK(clx_h5_count(h5, "/just/folders", &n));
    assert_int_equal(n, 0);
    CHECK_STATUS(clx_h5_count(h5, "/odd", &n), CLAST_E_FORMAT);
    assert_true(clx_h5_has(h5, "/just") && !clx_h5_has(h5, "/no/such"));
    clx_h5_close(h5);
}

static void wrong_questions_are_refused(void **state)
{
    (void)state;
    clx_h5 *h5 = NULL;
    int64_t shape[4];
    double d[12];
    char *text = NULL;
    CHECK_OK(write_one(support_scratch_file("ask.h5")));
    CHECK_OK(clx_h5_open(support_scratch_file("ask.h5"), &h5));
    CHECK_STATUS(clx_h5_shape(h5, "/no", CLX_H5_F64, 1, shape), CLAST_E_FORMAT);
    CHECK_STATUS(clx_h5_shape(h5, "/engine", CLX_H5_F64, 1, shape), CLAST_E_FORMAT);
    CHECK_STATUS(clx_h5_shape(h5, "/odd", CLX_H5_I64, 1, shape), CLAST_E_FORMAT);
    CHECK_STATUS(clx_h5_shape(h5, "/odd", CLX_H5_F64, 2, shape), CLAST_E_FORMAT);
    CHECK_STATUS(clx_h5_read(h5, "/odd", CLX_H5_F64, 1, (int64_t[]){5}, d), CLAST_E_FORMAT);
    CHECK_STATUS(clx_h5_read_text(h5, "/odd", "third", &text), CLAST_E_FORMAT);
    CHECK_STATUS(clx_h5_read_number(h5, "/odd", "unit", CLX_H5_F64, d), CLAST_E_FORMAT);
    CHECK_STATUS(clx_h5_read_number(h5, "/odd", "absent", CLX_H5_F64, d), CLAST_E_FORMAT);
    clx_h5_close(h5);
    CHECK_OK(clx_h5_create(&h5));
    CHECK_OK(clx_h5_write(h5, "/a", CLX_H5_F64, 1, (int64_t[]){1}, d));
    CHECK_STATUS(clx_h5_write(h5, "/a", CLX_H5_F64, 1, (int64_t[]){1}, d), CLAST_E_USAGE);
    CHECK_STATUS(clx_h5_write(h5, "a", CLX_H5_F64, 1, (int64_t[]){1}, d), CLAST_E_USAGE);
    CHECK_STATUS(clx_h5_write(h5, "/b/", CLX_H5_F64, 1, (int64_t[]){1}, d), CLAST_E_USAGE);
    CHECK_STATUS(clx_h5_write_text(h5, "/absent", "x", ""), CLAST_E_USAGE);
    clx_h5_close(h5);
    clx_h5_close(NULL);
    CHECK_STATUS(clx_h5_open(support_scratch_file("absent.h5"), &h5), CLAST_E_IO);
    CHECK_STATUS(clx_h5_open("CMakeLists.txt", &h5), CLAST_E_FORMAT);
    CHECK_STATUS(clx_h5_open(support_scratch(), &h5), CLAST_E_FORMAT);
#if !PLAIN
    CHECK_STATUS(clx_h5_open_foreign(support_scratch_file("absent.h5"), &h5), CLAST_E_IO);
    CHECK_STATUS(clx_h5_open_foreign("CMakeLists.txt", &h5), CLAST_E_FORMAT);
#endif
}

static void put_file(const char *path, const char *bytes, int64_t n)
{
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(bytes, 1, (size_t)n, out), n);
    assert_int_equal(fclose(out), 0);
}

/* A small file, so that every kind of structure is hit: arrays, attributes, folders. */
static clast_status write_small(const char *path)
{
    clast_status status = CLAST_OK;
    clx_h5 *h5 = NULL;
    const double x[4] = {1.0, 2.0, 3.0, 4.0};
    CLX_TRY(clx_h5_create(&h5));
    CLX_TRY(clx_h5_write(h5, "/run/x", CLX_H5_F64, 2, (int64_t[]){2, 2}, x));
    CLX_TRY(clx_h5_write_text(h5, "/run", "unit", "m"));
    CLX_TRY(clx_h5_commit(h5, path));
done:
    clx_h5_close(h5);
    return status;
}

static clast_status read_small(const char *path, bool *correct)
{
    clast_status status = CLAST_OK;
    clx_h5 *h5 = NULL;
    double x[4] = {0};
    char *unit = NULL;
    CLX_TRY(clx_h5_open(path, &h5));
    CLX_TRY(clx_h5_read(h5, "/run/x", CLX_H5_F64, 2, (int64_t[]){2, 2}, x));
    CLX_TRY(clx_h5_read_text(h5, "/run", "unit", &unit));
    *correct = x[0] == 1.0 && x[1] == 2.0 && x[2] == 3.0 && x[3] == 4.0 && strcmp(unit, "m") == 0;
done:
    clx_free(unit);
    clx_h5_close(h5);
    return status;
}

static void check_refused(const char *path, const char *bytes, int64_t n)
{
    bool correct = false;
    put_file(path, bytes, n);
    CHECK_STATUS(read_small(path, &correct), CLAST_E_FORMAT);
    assert_non_null(strstr(clast_error_detail(), path));
    assert_null(strchr(clast_error_detail(), '\n'));
}

static void truncation_and_flipped_bytes_are_refused(void **state)
{
    (void)state;
    char path[512];
    char *bytes = NULL;
    int64_t n = 0;
    bool correct = false;
    (void)snprintf(path, sizeof path, "%s", support_scratch_file("damaged.h5"));
    CHECK_OK(write_small(path));
    CHECK_OK(read_small(path, &correct));
    assert_true(correct);
    CHECK_OK(clx_file_read_all(path, 1 << 20, &bytes, &n));
    assert_true(n < 20000);
    for (int64_t cut = 0; cut < n; ++cut) {
        check_refused(path, bytes, cut);
    }
    for (int64_t at = 0; at < n; ++at) {
        bytes[at] = (char)(bytes[at] ^ (1 << at % 8));
        check_refused(path, bytes, n);
        bytes[at] = (char)(bytes[at] ^ (1 << at % 8));
    }
    clx_free(bytes);
}

#if !PLAIN
/* A file by another hand: filters, links to other files, sizes without storage. */
static void hostile_arrays_are_refused(void **state)
{
    (void)state;
    const char *path = support_scratch_file("hostile.h5");
    const hsize_t huge[1] = {(hsize_t)1 << 31};
    const hsize_t chunk[1] = {1024};
    clx_h5 *h5 = NULL;
    int64_t shape[4];
    const hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t space = H5Screate_simple(1, huge, NULL);
    const hid_t create = H5Pcreate(H5P_DATASET_CREATE);
    (void)H5Pset_chunk(create, 1, chunk);
    hid_t set =
        H5Dcreate2(file, "/unstored", H5T_IEEE_F64LE, space, H5P_DEFAULT, create, H5P_DEFAULT);
    (void)H5Dclose(set);
    (void)H5Pset_deflate(create, 9);
    set = H5Dcreate2(file, "/squeezed", H5T_IEEE_F64LE, space, H5P_DEFAULT, create, H5P_DEFAULT);
    (void)H5Dclose(set);
    (void)H5Lcreate_external("all.h5", "/odd", file, "/elsewhere", H5P_DEFAULT, H5P_DEFAULT);
    (void)H5Lcreate_soft("/unstored", file, "/soft", H5P_DEFAULT, H5P_DEFAULT);
    (void)H5Pclose(create);
    (void)H5Sclose(space);
    (void)H5Fclose(file);
    CHECK_OK(write_one(support_scratch_file("all.h5")));
    CHECK_STATUS(clx_h5_open(path, &h5), CLAST_E_FORMAT);
    CHECK_OK(clx_h5_open_foreign(path, &h5));
    CHECK_STATUS(clx_h5_shape(h5, "/unstored", CLX_H5_F64, 1, shape), CLAST_E_FORMAT);
    assert_non_null(strstr(clast_error_detail(), "declares 17179869184 bytes"));
    CHECK_STATUS(clx_h5_shape(h5, "/squeezed", CLX_H5_F64, 1, shape), CLAST_E_FORMAT);
    assert_non_null(strstr(clast_error_detail(), "filter 1"));
    CHECK_STATUS(clx_h5_shape(h5, "/elsewhere", CLX_H5_F64, 1, shape), CLAST_E_FORMAT);
    CHECK_STATUS(clx_h5_shape(h5, "/soft", CLX_H5_F64, 1, shape), CLAST_E_FORMAT);
    assert_false(clx_h5_has(h5, "/elsewhere"));
    clx_h5_close(h5);
}
#endif

static clast_status write_and_read_small(void *context)
{
    bool correct = false;
    clast_status status = write_small(context);
    if (status == CLAST_OK) {
        status = read_small(context, &correct);
        assert_true(status != CLAST_OK || correct);
    }
    return status;
}

static void arrays_survive_refused_memory(void **state)
{
    (void)state;
    support_refuse_each_allocation_at(write_and_read_small, "memory.h5");
}

static int64_t newest(const char *folder, int32_t *n_damaged)
{
    char *path = NULL;
    int64_t step = -1;
    const clast_status status = clx_checkpoint_newest(folder, &path, &step, n_damaged);
    assert_true(status == CLAST_OK || status == CLAST_E_IO);
    clx_free(path);
    return step;
}

static clast_status write_checkpoint(const char *folder, int64_t step)
{
    clast_status status = CLAST_OK;
    clx_h5 *h5 = NULL;
    CLX_TRY(clx_h5_create(&h5));
    CLX_TRY(clx_h5_write_number(h5, "/", "step", CLX_H5_I64, &step));
    CLX_TRY(clx_checkpoint_write(h5, folder, step));
done:
    clx_h5_close(h5);
    return status;
}

static int n_file(const char *folder)
{
    int n = 0;
    DIR *list = opendir(folder);
    assert_non_null(list);
    while (readdir(list) != NULL) {
        ++n;
    }
    (void)closedir(list);
    return n - 2;
}

static void two_newest_checkpoints_are_kept(void **state)
{
    (void)state;
    char folder[512];
    (void)snprintf(folder, sizeof folder, "%s", support_scratch_file("run/checkpoints"));
    int32_t n_damaged = 0;
    for (int64_t step = 0; step < 5; ++step) {
        CHECK_OK(write_checkpoint(folder, 10 * step));
        assert_int_equal(newest(folder, NULL), 10 * step);
        assert_int_equal(n_file(folder), step == 0 ? 1 : 2);
    }
    put_file(support_scratch_file("run/checkpoints/checkpoint-000000000040.h5"), "cut short", 9);
    put_file(support_scratch_file("run/checkpoints/checkpoint-50.h5"), "not ours", 8);
    assert_int_equal(newest(folder, &n_damaged), 30);
    assert_int_equal(n_damaged, 1);
    CHECK_OK(clx_checkpoint_clear(folder));
    assert_int_equal(n_file(folder), 1);
    assert_int_equal(newest(folder, NULL), -1);
    assert_int_equal(newest(support_scratch_file("run/absent"), NULL), -1);
}

static void full_disk_keeps_the_last_checkpoint(void **state)
{
    (void)state;
#ifdef CLAST_ALLOC_INJECT
    char folder[512];
    (void)snprintf(folder, sizeof folder, "%s", support_scratch_file("full"));
    CHECK_OK(write_checkpoint(folder, 1));
    CHECK_OK(write_checkpoint(folder, 2));
    clast_status status = CLAST_E_DISK;
    for (int k = 1; status != CLAST_OK; ++k) {
        (void)clx_file_refuse(k, ENOSPC);
        status = write_checkpoint(folder, 3);
        (void)clx_file_refuse(0, 0);
        assert_true(status == CLAST_OK || status == CLAST_E_DISK);
        const int64_t step = newest(folder, NULL);
        assert_true(step == (status == CLAST_OK ? 3 : 2) || (step == 3 && k > 5));
        assert_true(k < 20);
    }
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everything_comes_back),
        cmocka_unit_test(equal_content_gives_equal_bytes),
        cmocka_unit_test(members_are_listed_in_order),
        cmocka_unit_test(wrong_questions_are_refused),
        cmocka_unit_test(truncation_and_flipped_bytes_are_refused),
#if !PLAIN
        cmocka_unit_test(hostile_arrays_are_refused),
#endif
        cmocka_unit_test(arrays_survive_refused_memory),
        cmocka_unit_test(two_newest_checkpoints_are_kept),
        cmocka_unit_test(full_disk_keeps_the_last_checkpoint),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
