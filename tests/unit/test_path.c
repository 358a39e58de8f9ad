/* Unit: the parts of a path, and that endings count in upper case too. */
#include "support.h"

#include "base/path.h"

static void paths_are_taken_apart(void **state)
{
    (void)state;
    static const struct {
        const char *path, *name, *extension;
        int stem;
    } cases[] = {
        {"a/b.c/grain.STL", "grain.STL", "STL", 5},
        {"grain", "grain", "", 5},
        {"a.b/grain", "grain", "", 5},
        {".profile", ".profile", "", 8},
        {"x.tar.gz", "x.tar.gz", "gz", 5},
        {"dot.", "dot.", "", 3},
        {"folder/", "", "", 0},
        {"", "", "", 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        assert_string_equal(clx_path_name(cases[i].path), cases[i].name);
        assert_string_equal(clx_path_extension(cases[i].path), cases[i].extension);
        assert_int_equal(clx_path_stem_length(cases[i].path), cases[i].stem);
    }
}

static void endings_count_in_any_case(void **state)
{
    (void)state;
    assert_true(clx_path_is("a/grain.STL", "stl"));
    assert_true(clx_path_is("a/grain.stl", "stl"));
    assert_false(clx_path_is("a/grain.stlx", "stl"));
    assert_false(clx_path_is("a.stl/grain", "stl"));
    assert_false(clx_path_is("stl", "stl"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(paths_are_taken_apart),
        cmocka_unit_test(endings_count_in_any_case),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
