/* Unit: plain states are HDF5 to HDF5, and of hostile bytes nothing is believed. */
#include "plain_images.h"
#include "support.h"

#include <stdio.h>
#include <unistd.h>
#if CLAST_HAVE_HDF5
#include <hdf5.h>
#endif

/* Bob Jenkins' own values, lookup3.c, driver5. */
static void checksums_are_lookup3(void **state)
{
    (void)state;
    assert_int_equal(clx_h5_sum("", 0), 0xdeadbeef);
    assert_int_equal(clx_h5_sum("Four score and seven years ago", 30), 0x17770551);
}

static clast_status fill(clx_h5 *h5)
{
    clast_status status = CLAST_OK;
    const double x[2][3] = {{0.1, -0.0, 5e-324}, {1e300, -7.0, 0.25}};
    const int32_t i32[2] = {INT32_MIN, 7};
    const int64_t i64[1] = {INT64_MIN};
    const uint64_t u64 = UINT64_MAX;
    const uint8_t u8[3] = {0, 255, 7};
    CLX_TRY(clx_h5_write(h5, "/run/deep/x", CLX_H5_F64, 2, (int64_t[]){2, 3}, x));
    CLX_TRY(clx_h5_write(h5, "/run/i32", CLX_H5_I32, 1, (int64_t[]){2}, i32));
    CLX_TRY(clx_h5_write(h5, "/run/i64", CLX_H5_I64, 1, (int64_t[]){1}, i64));
    CLX_TRY(clx_h5_write(h5, "/run/u64", CLX_H5_U64, 0, NULL, &u64));
    CLX_TRY(clx_h5_write(h5, "/run/u8", CLX_H5_U8, 1, (int64_t[]){3}, u8));
    CLX_TRY(clx_h5_write(h5, "/empty", CLX_H5_F64, 2, (int64_t[]){0, 3}, NULL));
    CLX_TRY(clx_h5_write_text(h5, "/run/i32", "unit", "\xc2\xb5m"));
    CLX_TRY(clx_h5_write_number(h5, "/", "seed", CLX_H5_U64, &u64));
done:
    return status;
}

/* Its image, in a block that the next call frees. */
static char *image_of(clx_h5 *h5, int64_t *n)
{
    static char *image = NULL;
    clx_free(image);
    image = NULL;
    if (h5 != NULL) {
        CHECK_OK(clx_h5_plain_image(h5, &image, n));
    }
    return image;
}

static char *filled(int64_t *n)
{
    clx_h5 *h5 = NULL;
    CHECK_OK(clx_h5_create(&h5));
    CHECK_OK(fill(h5));
    char *image = image_of(h5, n);
    clx_h5_close(h5);
    return image;
}

#if CLAST_HAVE_HDF5
static void read_by_hdf5(hid_t file, const char *name, hid_t type, void *data)
{
    const hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
    assert_true(set >= 0);
    assert_true(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0);
    assert_true(H5Dclose(set) >= 0);
}

static void hdf5_reads_them(void **state)
{
    (void)state;
    clx_h5 *h5 = NULL;
    double x[6] = {0};
    int32_t i32[2] = {0};
    int64_t i64 = 0;
    uint64_t u64 = 0;
    uint8_t u8[3] = {0};
    char unit[4] = "";
    H5G_info_t folder = {0};
    CHECK_OK(clx_h5_create(&h5));
    CHECK_OK(fill(h5));
    CHECK_OK(clx_h5_commit(h5, support_scratch_file("plain.h5")));
    clx_h5_close(h5);
    const hid_t file = H5Fopen(support_scratch_file("plain.h5"), H5F_ACC_RDONLY, H5P_DEFAULT);
    assert_true(file >= 0);
    read_by_hdf5(file, "/run/deep/x", H5T_NATIVE_DOUBLE, x);
    read_by_hdf5(file, "/run/i32", H5T_NATIVE_INT32, i32);
    read_by_hdf5(file, "/run/i64", H5T_NATIVE_INT64, &i64);
    read_by_hdf5(file, "/run/u64", H5T_NATIVE_UINT64, &u64);
    read_by_hdf5(file, "/run/u8", H5T_NATIVE_UINT8, u8);
    assert_memory_equal(x, ((double[]){0.1, -0.0, 5e-324, 1e300, -7.0, 0.25}), sizeof x);
    assert_true(i32[0] == INT32_MIN && i32[1] == 7 && i64 == INT64_MIN && u64 == UINT64_MAX);
    assert_true(u8[0] == 0 && u8[1] == 255 && u8[2] == 7);
    const hid_t attribute = H5Aopen_by_name(file, "/run/i32", "unit", H5P_DEFAULT, H5P_DEFAULT);
    const hid_t type = H5Aget_type(attribute);
    assert_int_equal(H5Tget_size(type), sizeof unit);
    assert_int_equal(H5Tget_cset(type), H5T_CSET_UTF8);
    assert_true(H5Aread(attribute, type, unit) >= 0);
    assert_string_equal(unit, "\xc2\xb5m");
    assert_true(H5Gget_info_by_name(file, "/run", &folder, H5P_DEFAULT) >= 0);
    assert_int_equal(folder.nlinks, 5);
    assert_true(H5Tclose(type) >= 0 && H5Aclose(attribute) >= 0 && H5Fclose(file) >= 0);
}
#endif

/* Parsed or refused by one line; what is parsed holds no more than the image has. */
static bool is_taken(const char *image, int64_t n)
{
    clx_h5 *h5 = NULL;
    const clast_status status = plain_parse(image, n, &h5);
    if (status == CLAST_OK) {
        assert_true(plain_is_kept(h5, n));
    } else {
        assert_true(status == CLAST_E_FORMAT || status == CLAST_E_USAGE || status == CLAST_E_LIMIT);
        assert_null(h5);
        assert_non_null(strstr(clast_error_detail(), "image"));
        assert_null(strchr(clast_error_detail(), '\n'));
    }
    clx_h5_close(h5);
    return status == CLAST_OK;
}

static void an_image_of_each_length_is_refused(void **state)
{
    (void)state;
    int64_t n = 0;
    const char *whole = filled(&n);
    char *image = malloc((size_t)n);
    assert_non_null(image);
    assert_true(is_taken(whole, n));
    for (int64_t cut = 0; cut < n; ++cut) { /* "/" comes last, so it is not whole */
        memcpy(image, whole, (size_t)n);
        assert_false(is_taken(image, cut));
        plain_mend(image, cut);
        assert_false(is_taken(image, cut));
    }
    free(image);
}

/* Checksums as they were, then set right, by which a flipped bit comes to what it means. */
static void each_flipped_bit_is_refused_or_harmless(void **state)
{
    (void)state;
    int64_t n = 0;
    int64_t n_taken = 0;
    const char *whole = filled(&n);
    char *image = malloc((size_t)n);
    assert_non_null(image);
    for (int64_t bit = 0; bit < 8 * n; ++bit) {
        memcpy(image, whole, (size_t)n);
        image[bit / 8] = (char)(image[bit / 8] ^ (1 << bit % 8));
        (void)is_taken(image, n);
        plain_mend(image, n);
        n_taken += is_taken(image, n) ? 1 : 0;
    }
    assert_in_range(n_taken, n, 4 * n); /* numbers, names, texts, flags that nothing asks for */
    free(image);
}

/* Puts the largest numbers, and 0, over each place: as counts, sizes, addresses. */
static void huge_counts_are_refused(void **state)
{
    (void)state;
    static const uint64_t huge[] = {UINT64_MAX, INT64_MAX, (uint64_t)1 << 61, INT32_MAX, 0};
    int64_t n = 0;
    const char *whole = filled(&n);
    char *image = malloc((size_t)n);
    assert_non_null(image);
    for (int width = 1; width <= 8; width *= 2) {
        for (size_t k = 0; k < sizeof huge / sizeof *huge; ++k) {
            for (int64_t at = 0; at + width <= n; ++at) {
                memcpy(image, whole, (size_t)n);
                plain_put_word(image + at, width, huge[k]);
                plain_mend(image, n);
                (void)is_taken(image, n);
            }
        }
    }
    free(image);
}

/* The address in the link to a member, which stands behind its name. */
static char *address_in(char *image, int64_t n, const char *name)
{
    const size_t length = strlen(name);
    int64_t at = 0;
    while (memcmp(image + at, name, length) != 0) {
        ++at;
        assert_true(at + (int64_t)length + 8 <= n);
    }
    return image + at + length;
}

static uint64_t word_at(const char *at)
{
    uint64_t word = 0;
    for (int k = 0; k < 8; ++k) {
        word |= (uint64_t)(unsigned char)at[k] << 8 * k;
    }
    return word;
}

static void circles_of_links_are_refused(void **state)
{
    (void)state;
    int64_t n = 0;
    char *whole = filled(&n);
    const uint64_t root = word_at(whole + 36);
    const uint64_t run = word_at(address_in(whole, n, "run"));
    plain_put_word(address_in(whole, n, "deep"), 8, run); /* /run/deep is /run */
    plain_mend(whole, n);
    assert_false(is_taken(whole, n));
    assert_non_null(strstr(clast_error_detail(), "is damaged"));
    whole = filled(&n);
    plain_put_word(address_in(whole, n, "run"), 8, root); /* /run is / */
    plain_mend(whole, n);
    assert_false(is_taken(whole, n));
    assert_non_null(strstr(clast_error_detail(), "is damaged"));
}

static void names_that_come_twice_are_refused(void **state)
{
    (void)state;
    clx_h5 *h5 = NULL;
    int64_t n = 0;
    CHECK_OK(clx_h5_create(&h5));
    CHECK_OK(clx_h5_write_folder(h5, "/first"));
    CHECK_OK(clx_h5_write_folder(h5, "/other"));
    CHECK_OK(clx_h5_write_text(h5, "/", "1st unit", "m"));
    CHECK_OK(clx_h5_write_text(h5, "/", "2nd unit", "m"));
    char *image = image_of(h5, &n);
    memcpy(address_in(image, n, "other") - 5, "first", 5);
    plain_mend(image, n);
    assert_false(is_taken(image, n));
    image = image_of(h5, &n);
    memcpy(address_in(image, n, "2nd unit") - 8, "1st", 3);
    plain_mend(image, n);
    assert_false(is_taken(image, n));
    clx_h5_close(h5);
}

/* 2000 links to one array of 64 kB ask for 128 MB of a file of 200 kB. */
static void links_to_one_array_are_refused(void **state)
{
    (void)state;
    enum { SIZE = 65536, LINKS = 2000 };
    static uint8_t data[SIZE];
    clx_h5 *h5 = NULL;
    int64_t n = 0;
    char name[32];
    CHECK_OK(clx_h5_create(&h5));
    CHECK_OK(clx_h5_write(h5, "/large", CLX_H5_U8, 1, (int64_t[]){SIZE}, data));
    for (int k = 0; k < LINKS; ++k) {
        (void)snprintf(name, sizeof name, "/link%06d", k);
        CHECK_OK(clx_h5_write(h5, name, CLX_H5_U8, 1, (int64_t[]){0}, NULL));
    }
    char *image = image_of(h5, &n);
    clx_h5_close(h5);
    assert_true(is_taken(image, n));
    const uint64_t large = word_at(address_in(image, n, "large"));
    for (int k = 0; k < LINKS; ++k) {
        (void)snprintf(name, sizeof name, "link%06d", k);
        plain_put_word(address_in(image, n, name), 8, large);
    }
    plain_mend(image, n);
    assert_false(is_taken(image, n));
}

static void an_attribute_of_65000_bytes_is_the_largest(void **state)
{
    (void)state;
    static char text[65001];
    clx_h5 *h5 = NULL;
    int64_t n = 0;
    memset(text, 'y', 65000);
    CHECK_OK(clx_h5_create(&h5));
    CHECK_STATUS(clx_h5_write_text(h5, "/", "long", text), CLAST_E_LIMIT);
    text[64999] = '\0';
    CHECK_OK(clx_h5_write_text(h5, "/", "long", text));
    const char *image = image_of(h5, &n);
    assert_true(is_taken(image, n));
    clx_h5_close(h5);
}

/* Ninety thousand names in time that goes with their number: all pairs would be 4e9 steps. */
static void names_are_found_at_once(void **state)
{
    (void)state;
    enum { FOLDERS = 300, EACH = 300 };
    clx_h5 *h5 = NULL;
    clx_h5 *again = NULL;
    int64_t n = 0;
    char name[CLX_H5_NAME_LIMIT];
    CHECK_OK(clx_h5_create(&h5));
    for (int k = 0; k < FOLDERS * EACH; ++k) {
        const double x = k;
        (void)snprintf(name, sizeof name, "/table/%06d/%06d", k / EACH, k % EACH);
        CHECK_OK(clx_h5_write(h5, name, CLX_H5_F64, 0, NULL, &x));
    }
    const char *image = image_of(h5, &n);
    CHECK_OK(plain_parse(image, n, &again));
    for (int k = 0; k < FOLDERS * EACH; ++k) {
        double x = 0.0;
        (void)snprintf(name, sizeof name, "/table/%06d/%06d", k / EACH, k % EACH);
        CHECK_OK(clx_h5_read(again, name, CLX_H5_F64, 0, NULL, &x));
        assert_true(x == k);
    }
    CHECK_OK(clx_h5_count(again, "/table/000299", &n));
    assert_int_equal(n, EACH);
    CHECK_OK(clx_h5_member(again, "/table", 41, name));
    assert_string_equal(name, "000041");
    clx_h5_close(again);
    CHECK_OK(clx_h5_create(&again)); /* and of one folder, one by one */
    for (int k = FOLDERS * EACH - 1; k >= 0; --k) {
        const double x = k;
        (void)snprintf(name, sizeof name, "/table/%06d", k);
        CHECK_OK(clx_h5_write(again, name, CLX_H5_F64, 0, NULL, &x));
    }
    for (int k = 0; k < FOLDERS * EACH; ++k) {
        char expected[CLX_H5_NAME_LIMIT];
        (void)snprintf(expected, sizeof expected, "%06d", k);
        CHECK_OK(clx_h5_member(again, "/table", k, name));
        assert_string_equal(name, expected);
    }
    clx_h5_close(again);
    clx_h5_close(h5);
}

static int free_image(void **state)
{
    (void)state;
    (void)image_of(NULL, NULL);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(checksums_are_lookup3),
#if CLAST_HAVE_HDF5
        cmocka_unit_test(hdf5_reads_them),
#endif
        cmocka_unit_test(an_image_of_each_length_is_refused),
        cmocka_unit_test(each_flipped_bit_is_refused_or_harmless),
        cmocka_unit_test(huge_counts_are_refused),
        cmocka_unit_test(circles_of_links_are_refused),
        cmocka_unit_test(names_that_come_twice_are_refused),
        cmocka_unit_test(links_to_one_array_are_refused),
        cmocka_unit_test(an_attribute_of_65000_bytes_is_the_largest),
        cmocka_unit_test(names_are_found_at_once),
    };
    return cmocka_run_group_tests(tests, NULL, free_image);
}
