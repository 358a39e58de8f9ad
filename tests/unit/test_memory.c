/* Unit: the limit on the memory of all blocks together. */
#include "support.h"

#include <clast/machine.h>

#include "base/alloc.h"
#include <string.h>

static void beyond_the_limit_nothing_is_taken(void **state)
{
    char *block = NULL;
    char *second = NULL;
    (void)state;
    const int64_t before = clast_memory_taken();
    CHECK_OK(clast_memory_set_limit(before + 3000000));
    CHECK_OK(clx_alloc(&block, 2000000, 1));
    assert_true(clast_memory_taken() >= before + 2000000);
    CHECK_STATUS(clx_alloc(&second, 2000000, 1), CLAST_E_MEMORY);
    assert_non_null(strstr(clast_error_detail(), "2 MB of memory more are wanted"));
    assert_null(second);
    CHECK_STATUS(clx_realloc(&block, 4000000, 1), CLAST_E_MEMORY);
    block[1999999] = 1; /* is still there */
    clx_free(block);
    assert_int_equal(clast_memory_taken(), before);
    CHECK_OK(clx_alloc(&second, 2000000, 1));
    clx_free(second);
    CHECK_OK(clast_memory_set_limit(0));
    assert_int_equal(clast_memory_limit(), 0);
    CHECK_STATUS(clast_memory_set_limit(-1), CLAST_E_ARGUMENT);
}

/* 64 GiB were once computed in a size_t, which is 0 in 32 bits: every allocation failed. */
static void sizes_beyond_a_pointer_are_refused_and_others_are_not(void **state)
{
    char *block = NULL;
    (void)state;
    const int64_t half = (int64_t)(SIZE_MAX / 2);
    CHECK_OK(clx_alloc(&block, 1000000, 1));
    clx_free(block);
    CHECK_STATUS(clx_alloc(&block, half / 8 + 1, 8), CLAST_E_MEMORY);
    CHECK_STATUS(clx_alloc(&block, (int64_t)1 << 32, (size_t)1 << 16), CLAST_E_MEMORY);
    CHECK_STATUS(clx_alloc(&block, INT64_MAX, 1), CLAST_E_MEMORY);
    assert_null(block);
}

static void blocks_of_a_pool_count_until_it_is_gone(void **state)
{
    clx_pool *pool = NULL;
    char *block = NULL;
    (void)state;
    const int64_t before = clast_memory_taken();
    CHECK_OK(clx_pool_create(&pool));
    clx_pool *outer = clx_pool_enter(pool);
    CHECK_OK(clx_alloc(&block, 100000, 1));
    clx_free(block);
    (void)clx_pool_enter(outer);
    assert_true(clast_memory_taken() >= before + 100000);
    clx_pool_destroy(pool);
    assert_int_equal(clast_memory_taken(), before);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(beyond_the_limit_nothing_is_taken),
        cmocka_unit_test(sizes_beyond_a_pointer_are_refused_and_others_are_not),
        cmocka_unit_test(blocks_of_a_pool_count_until_it_is_gone),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
