/* Unit: work on several threads, and what becomes of its faults. */
#include "support.h"

#include "base/parallel.h"
#include <clast/machine.h>
#include <clast/porosity.h>
#include <string.h>

enum { N = 1000, BLOCK = 7 };

typedef struct {
    int64_t fault[2]; ///< items that fail
    int done[N];
} work;

static clast_status do_some(int64_t begin, int64_t end, int32_t worker, void *context)
{
    clast_status status = CLAST_OK;
    work *w = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        CLX_CHECK(i != w->fault[0] && i != w->fault[1], i == 503 ? CLAST_E_LIMIT : CLAST_E_GEOMETRY,
                  "item %lld is bad", (long long)i);
        ++w->done[i];
    }
done:
    return status;
}

/* With threads, the caller got the least block's status with whatever message its own thread had
   last, so that porosities failed with the text of an earlier call. */
static void least_block_that_fails_is_told(void **state)
{
    (void)state;
    for (int round = 0; round < 200; ++round) {
        work w = {.fault = {900, 503}};
        clast_parallel_set_threads(1 + round % 4);
        (void)clx_fail(CLAST_OK, "an earlier call");
        assert_int_equal(clx_parallel_try(N, BLOCK, do_some, &w), CLAST_E_LIMIT);
        assert_string_equal(clast_error_detail(), "item 503 is bad");
        for (int64_t i = 0; i < 503; ++i) {
            assert_int_equal(w.done[i], 1);
        }
        w = (work){.fault = {-1, N}};
        CHECK_OK(clx_parallel_try(N, BLOCK, do_some, &w));
        for (int64_t i = 0; i < N; ++i) {
            assert_int_equal(w.done[i], 1);
        }
    }
    clast_parallel_set_threads(0);
}

#ifdef CLAST_ALLOC_INJECT
static clast_status porosities_of(void *context)
{
    clast_status status = CLAST_OK;
    clast_bed bed;
    clast_table table = {0};
    const clast_porosity_options options = clast_porosity_options_default();
    CLX_TRY(clast_bed_parse("box:0,0,20,10", &bed));
    CLX_TRY(clast_porosity_local(context, &bed, 0.0, 2.0, &table));
    clast_table_free(&table);
    CLX_TRY(clast_porosity_profile(context, &bed, &options, &table));
done:
    clast_table_free(&table);
    return status;
}

/* Sixteen blocks of cells on four threads: whichever worker is refused memory, its message is the
   caller's (support_refuse_each_allocation asks for it). */
static void porosities_say_what_their_workers_said(void **state)
{
    (void)state;
    const double upright[4] = {1.0, 0.0, 0.0, 0.0};
    clast_assembly a = {0};
    clast_shape ball = {0};
    CHECK_OK(clast_shape_sphere("ball", 1.0, &ball));
    CHECK_OK(clast_assembly_add_shape(&a, &ball, NULL));
    for (int k = 0; k < 400; ++k) {
        const double at[3] = {k % 20 + 0.5, k / 20 % 10 + 0.5, k / 200 + 0.5};
        CHECK_OK(clast_assembly_add_grain(&a, 0, at, upright, 0.5, 1.0));
    }
    clast_parallel_set_threads(4);
    support_refuse_each_allocation(porosities_of, &a);
    clast_parallel_set_threads(0);
    clast_shape_free(&ball);
    clast_assembly_free(&a);
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(least_block_that_fails_is_told),
#ifdef CLAST_ALLOC_INJECT
        cmocka_unit_test(porosities_say_what_their_workers_said),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
