/* Unit: a manifest says what ran, on what, and is JSON. */
#include "support.h"

#include "base/alloc.h"
#include "base/file.h"
#include "io/sha256.h"
#include <clast/run_folder.h>
#include <jansson.h>
#include <stdio.h>
#include <string.h>

static void check_digest(const char *text, int repeats, const char *expected)
{
    char hex[65];
    clx_sha256 sha = clx_sha256_begin();
    for (int i = 0; i < repeats; ++i) {
        clx_sha256_add(&sha, text, strlen(text));
    }
    clx_sha256_end(&sha, hex);
    assert_string_equal(hex, expected);
}

/* NIST: FIPS 180-4 examples and the SHAVS long message. */
static void sha256_gives_the_vectors_of_nist(void **state)
{
    (void)state;
    check_digest("", 1, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    check_digest("abc", 1, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    check_digest("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq", 1,
                 "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    check_digest("a", 1000000, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
    check_digest("abcdefghbcdefghicdefghijdefghijkefghijklfghijklmghijklmnhijklmnoijklmnopjklmnopq"
                 "klmnopqrlmnopqrsmnopqrstnopqrstu",
                 1, "cf5b16a778af8380036ce59e7b0492370b249b11e8f07a51afac45037afee9d1");
}

/* Every length around the block's end gives the same digest in one piece and byte by byte. */
static void sha256_does_not_depend_on_the_pieces(void **state)
{
    (void)state;
    char text[200];
    memset(text, 'x', sizeof text);
    for (size_t n = 0; n < sizeof text; ++n) {
        char whole[65];
        char pieces[65];
        clx_sha256 a = clx_sha256_begin();
        clx_sha256 b = clx_sha256_begin();
        clx_sha256_add(&a, text, n);
        for (size_t i = 0; i < n; ++i) {
            clx_sha256_add(&b, text + i, 1);
        }
        clx_sha256_end(&a, whole);
        clx_sha256_end(&b, pieces);
        assert_string_equal(whole, pieces);
    }
}

typedef struct {
    double cone;
    int32_t n_ray;
    uint64_t seed;
    bool fast;
    int32_t contact;
    char *core;
    clast_text_list coat;
    clast_f64_list weight;
    double unset;
} settings;

#define FIELD(type, name) #name, .offset = offsetof(settings, name), type
static const clast_field fields[] = {
    {FIELD(CLAST_FIELD_F64, cone), 0.1, 0.0, 4.0, "rad", "half-angle", NULL},
    {FIELD(CLAST_FIELD_I32, n_ray), 30, 1, 1e6, "-", "rays", NULL},
    {FIELD(CLAST_FIELD_U64, seed), 1, 0, 1e18, "-", "seed", NULL},
    {FIELD(CLAST_FIELD_BOOL, fast), 1, 0, 1, "-", "fast", NULL},
    {FIELD(CLAST_FIELD_CHOICE, contact), 1, 0, 2, "-", "contact", "exact|spheres|march"},
    {FIELD(CLAST_FIELD_TEXT, core), 0, 0, 0, "-", "core", "a \"b\"\\c\xc3\xa9\n.stl"},
    {FIELD(CLAST_FIELD_TEXT_LIST, coat), 0, 0, 0, "-", "coats", "x.stl,y.stl"},
    {FIELD(CLAST_FIELD_F64_LIST, weight), 0, 0, 1, "-", "weights", "0.3,0.7"},
    {FIELD(CLAST_FIELD_F64, unset), 0, 0, 0, "-", "not given", NULL},
    {0},
};

static clast_status make(void *context)
{
    const char *path = context;
    clast_status status = CLAST_OK;
    clast_manifest *m = NULL;
    settings config = {0};
    char *argv[] = {(char[]){"clast"}, (char[]){"aggregate"}, (char[]){"--cone=6deg\xff"}};
    CLX_TRY(clast_fields_default(fields, &config));
    config.unset = NAN;
    CLX_TRY(clast_manifest_create("aggregate", 3, argv, &m));
    CLX_TRY(clast_manifest_config(m, fields, &config));
    clast_manifest_seed(m, UINT64_MAX);
    CLX_TRY(clast_manifest_input(m, "core", "LICENSE"));
    CLX_TRY(clast_manifest_note(m, "resumed_from", "checkpoint-1"));
    CLX_TRY(clast_manifest_write(m, "running", path));
    CLX_TRY(clast_manifest_write(m, "done", path));
done:
    clast_fields_free(fields, &config);
    clast_manifest_destroy(m);
    return status;
}

static const json_t *at(const json_t *object, const char *key)
{
    const json_t *value = json_object_get(object, key);
    if (value == NULL) {
        fail_msg("no key %s", key);
    }
    return value;
}

static void manifest_holds_what_was_given(void **state)
{
    (void)state;
    json_error_t error;
    char hex[65];
    int64_t n = 0;
    CHECK_OK(make((void *)support_scratch_file("manifest.json")));
    json_t *m =
        json_load_file(support_scratch_file("manifest.json"), JSON_DECODE_INT_AS_REAL, &error);
    if (m == NULL) {
        fail_msg("%s at line %d", error.text, error.line);
    }
    const json_t *c = at(m, "config");
    assert_true(json_real_value(at(c, "cone")) == 0.1);
    assert_true(json_real_value(at(c, "n_ray")) == 30.0);
    assert_true(json_is_true(at(c, "fast")));
    assert_string_equal(json_string_value(at(c, "contact")), "spheres");
    assert_string_equal(json_string_value(at(c, "core")), "a \"b\"\\c\xc3\xa9\n.stl");
    assert_string_equal(json_string_value(json_array_get(at(c, "coat"), 1)), "y.stl");
    assert_true(json_real_value(json_array_get(at(c, "weight"), 1)) == 0.7);
    assert_true(json_is_null(at(c, "unset")));
    assert_string_equal(json_string_value(at(m, "outcome")), "done");
    assert_string_equal(json_string_value(at(m, "resumed_from")), "checkpoint-1");
    assert_string_equal(json_string_value(json_array_get(at(m, "command_line"), 2)),
                        "--cone=6deg\xef\xbf\xbd");
    assert_int_equal(strlen(json_string_value(at(m, "ended"))), 20);
    assert_true(json_real_value(at(m, "wall_s")) >= 0.0);
    assert_true(json_real_value(at(m, "peak_memory_bytes")) > 1e6);
    const json_t *input = json_array_get(at(m, "inputs"), 0);
    CHECK_OK(clast_sha256_file("LICENSE", hex, &n));
    assert_string_equal(json_string_value(at(input, "sha256")), hex);
    assert_true(json_real_value(at(input, "bytes")) == (double)n);
    json_decref(m);
}

/* JSON readers lose digits of 2^64 - 1, so it is looked for as text. */
static void seed_keeps_all_digits(void **state)
{
    (void)state;
    char *text = NULL;
    int64_t n = 0;
    CHECK_OK(make((void *)support_scratch_file("manifest.json")));
    CHECK_OK(clx_file_read_all(support_scratch_file("manifest.json"), 1 << 20, &text, &n));
    assert_non_null(strstr(text, "\"seed\": 18446744073709551615"));
    assert_non_null(strstr(text, "\"clast_source\": \""));
    clx_free(text);
}

static void wrong_uses_are_refused(void **state)
{
    (void)state;
    clast_manifest *m = NULL;
    CHECK_OK(clast_manifest_create("x", 0, NULL, &m));
    CHECK_STATUS(clast_manifest_input(m, "core", support_scratch_file("absent")), CLAST_E_IO);
    CHECK_STATUS(clast_manifest_input(m, "core", support_scratch()), CLAST_E_IO);
    CHECK_OK(clast_manifest_note(m, "a", "b"));
    CHECK_STATUS(clast_manifest_note(m, "a", "b"), CLAST_E_USAGE);
    CHECK_STATUS(clast_manifest_write(m, "done", "/dev/full"), CLAST_E_DISK);
    clast_manifest_destroy(m);
    clast_manifest_destroy(NULL);
}

static void manifest_survives_refused_memory(void **state)
{
    (void)state;
    support_refuse_each_allocation(make, (void *)support_scratch_file("memory.json"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sha256_gives_the_vectors_of_nist),
        cmocka_unit_test(sha256_does_not_depend_on_the_pieces),
        cmocka_unit_test(manifest_holds_what_was_given),
        cmocka_unit_test(seed_keeps_all_digits),
        cmocka_unit_test(wrong_uses_are_refused),
        cmocka_unit_test(manifest_survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
