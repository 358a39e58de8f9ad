/* Unit: work on several threads, and what becomes of its faults. */
#include "support.h"

#include "base/parallel.h"
#include <clast/machine.h>
#include <clast/porosity.h>
#include <pthread.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

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

static void count(int64_t begin, int64_t end, int32_t worker, void *context)
{
    int *done = context;
    if (worker >= clx_parallel_workers()) {
        done[0] = -1000;
    }
    for (int64_t i = begin; i < end; ++i) {
        ++done[i];
    }
}

/// Works of many sizes one after another: each item once. True when it was so.
static bool counts_are_right(int32_t n_thread, int n_work)
{
    int done[200];
    clast_parallel_set_threads(n_thread);
    for (int k = 0; k < n_work; ++k) {
        const int64_t n = 1 + (k * 37) % 200;
        (void)memset(done, 0, sizeof done);
        clx_parallel_for(n, 1 + k % 5, count, done);
        for (int64_t i = 0; i < 200; ++i) {
            if (done[i] != (i < n ? 1 : 0)) {
                return false;
            }
        }
    }
    return true;
}

static void *count_beside(void *is_right)
{
    *(bool *)is_right = counts_are_right(3, 3000);
    return NULL;
}

/* Short works, so that threads often come late, to more threads than cores and fewer; then from two
   threads of the caller at once, who share one team. */
static void each_block_is_taken_once(void **state)
{
    (void)state;
    pthread_t beside;
    bool is_right = false;
    for (int32_t n = 1; n <= 6; ++n) {
        assert_true(counts_are_right(n, 3000));
    }
    assert_int_equal(pthread_create(&beside, NULL, count_beside, &is_right), 0);
    assert_true(counts_are_right(2, 3000));
    assert_int_equal(pthread_join(beside, NULL), 0);
    assert_true(is_right);
    clast_parallel_set_threads(0);
}

static void count_inside(int64_t begin, int64_t end, int32_t worker, void *context)
{
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        clx_parallel_for(N, BLOCK, count, (int(*)[N])context + i);
    }
}

static void work_inside_work_is_done(void **state)
{
    (void)state;
    static int done[8][N];
    clast_parallel_set_threads(3);
    clx_parallel_for(8, 1, count_inside, done);
    for (int i = 0; i < 8 * N; ++i) {
        assert_int_equal(done[i / N][i % N], 1);
    }
    clast_parallel_set_threads(0);
}

/* OpenMP's threads were gone in the child of a fork, which waited for them for ever. */
static void a_forked_child_has_its_own_team(void **state)
{
    (void)state;
    assert_true(counts_are_right(3, 100));
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        _exit(counts_are_right(3, 100) ? 0 : 1);
    }
    int how = -1;
    assert_int_equal(waitpid(child, &how, 0), child);
    assert_true(WIFEXITED(how) && WEXITSTATUS(how) == 0);
    clast_parallel_set_threads(0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(least_block_that_fails_is_told),
        cmocka_unit_test(each_block_is_taken_once),
        cmocka_unit_test(work_inside_work_is_done),
        cmocka_unit_test(a_forked_child_has_its_own_team),
#ifdef CLAST_ALLOC_INJECT
        cmocka_unit_test(porosities_say_what_their_workers_said),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
