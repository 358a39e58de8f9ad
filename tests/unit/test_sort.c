/* Unit: radix sorts against the library's comparison sort. */
#include "support.h"

#include "math/rng.h"
#include "math/sort.h"
#include <clast/machine.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 200000 };

static double value[MOST], expected[MOST];
static clx_keyed entry[MOST], again[MOST];

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

/// Numbers of each kind: even, of many magnitudes and both signs, few distinct, all equal.
static double number_of(int kind, uint64_t i)
{
    clx_rng rng = clx_rng_at(5, CLX_STREAM_TEST, i);
    const double u = clx_rng_uniform(&rng);
    switch (kind) {
    case 0:
        return u;
    case 1:
        return (u - 0.5) * pow(10.0, 40.0 * clx_rng_uniform(&rng) - 20.0);
    case 2:
        return floor(5.0 * u) - 2.0;
    default:
        return 0.25;
    }
}

static void doubles_come_out_ascending(void **state)
{
    static const int64_t count[] = {0, 1, 2, 47, 48, 49, 1000, 4096, 4097, MOST};
    (void)state;
    for (int kind = 0; kind < 4; ++kind) {
        for (int k = 0; k < 10; ++k) {
            const int64_t n = count[k];
            for (int64_t i = 0; i < n; ++i) {
                value[i] = expected[i] = number_of(kind, (uint64_t)i);
            }
            qsort(expected, (size_t)n, sizeof *expected, ascending);
            CHECK_OK(clx_sort_doubles(value, n));
            assert_memory_equal(value, expected, (size_t)n * sizeof *value);
        }
    }
}

static void equal_keys_keep_their_order_for_any_thread_count(void **state)
{
    (void)state;
    const int32_t threads = clast_parallel_threads();
    for (int32_t t = 1; t <= 4; t *= 2) {
        for (uint64_t i = 0; i < MOST; ++i) {
            clx_rng rng = clx_rng_at(6, CLX_STREAM_TEST, i);
            entry[i] = (clx_keyed){(uint64_t)(clx_rng_uniform(&rng) * 30000.0) << 20, i};
        }
        clast_parallel_set_threads(t);
        CHECK_OK(clx_sort_keyed(entry, MOST));
        for (int i = 1; i < MOST; ++i) {
            assert_true(entry[i - 1].key < entry[i].key ||
                        (entry[i - 1].key == entry[i].key && entry[i - 1].item < entry[i].item));
        }
        if (t == 1) {
            memcpy(again, entry, sizeof again);
        }
        assert_memory_equal(again, entry, sizeof again);
    }
    clast_parallel_set_threads(threads);
}

static clast_status sort_once(void *context)
{
    (void)context;
    for (int i = 0; i < 5000; ++i) {
        value[i] = number_of(0, (uint64_t)i);
    }
    return clx_sort_doubles(value, 5000);
}

static void refused_memory_is_told(void **state)
{
    (void)state;
    support_refuse_each_allocation(sort_once, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(doubles_come_out_ascending),
        cmocka_unit_test(equal_keys_keep_their_order_for_any_thread_count),
        cmocka_unit_test(refused_memory_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
