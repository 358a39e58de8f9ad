/* Unit: work that is shared among threads is done once, whole, and by whom it should. */
#include "support.h"

#include "base/parallel.h"
#include <clast/parallel.h>
#include <pthread.h>
#include <stdatomic.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { MANY = 1000, MOST_WORKERS = 8, ROUNDS = 300 };

typedef struct {
    _Atomic int32_t done[MANY];
    _Atomic int32_t busy[MOST_WORKERS]; ///< blocks that this worker number is on
    int64_t n, block;
    int32_t n_worker;         ///< as whoever hands out the work knows it
    long pause;               ///< a block takes [ns], so that others come
    _Atomic int32_t n_helped; ///< blocks done by others than the caller
    _Atomic int32_t n_wrong;
} tally;

static void count(int64_t begin, int64_t end, int32_t worker, void *context)
{
    tally *t = context;
    const bool whole = begin % t->block == 0 && (end == begin + t->block || end == t->n);
    const bool known = worker >= 0 && worker < t->n_worker;
    if (!whole || !known || atomic_fetch_add(&t->busy[worker], 1) != 0) {
        atomic_fetch_add(&t->n_wrong, 1);
    }
    if (t->pause > 0) {
        (void)nanosleep(&(struct timespec){.tv_nsec = t->pause}, NULL);
    }
    for (int64_t i = begin; i < end; ++i) {
        atomic_fetch_add(&t->done[i], 1);
    }
    atomic_fetch_add(&t->n_helped, worker > 0 ? 1 : 0);
    if (known) {
        atomic_fetch_sub(&t->busy[worker], 1);
    }
}

/// 0 when every item was done once and no two threads had one number.
static int check_count(int64_t n, int64_t block, long pause, int *n_helped)
{
    static _Thread_local tally t;
    t = (tally){.n = n, .block = block, .n_worker = clx_parallel_workers(), .pause = pause};
    clx_parallel_for(n, block, count, &t);
    *n_helped += atomic_load(&t.n_helped);
    int wrong = atomic_load(&t.n_wrong);
    for (int64_t i = 0; i < MANY; ++i) {
        wrong += atomic_load(&t.done[i]) != (i < n ? 1 : 0);
    }
    return wrong;
}

enum { PAUSE = 100000 };

/// Whether other threads come in the end, however busy the machine is, and nothing goes wrong.
static bool is_helped(void)
{
    int n_helped = 0;
    int wrong = 0;
    for (int i = 0; i < 20 * ROUNDS && n_helped == 0; ++i) {
        wrong += check_count(20, 1, PAUSE, &n_helped);
    }
    return n_helped > 0 && wrong == 0;
}

static void every_item_is_done_once(void **state)
{
    (void)state;
    const int64_t sizes[] = {0, 1, 2, 3, 7, 64, MANY};
    const int64_t blocks[] = {1, 2, 5, MANY};
    for (int32_t threads = 1; threads <= MOST_WORKERS; ++threads) {
        int n_helped = 0;
        clast_parallel_set_threads(threads);
        for (int k = 0; k < 7 * 4; ++k) {
            const long pause = sizes[k % 7] < MANY ? PAUSE : 0;
            assert_int_equal(check_count(sizes[k % 7], blocks[k / 7], pause, &n_helped), 0);
        }
        assert_true(clx_parallel_workers() == 1 ? n_helped == 0 : is_helped());
    }
    clast_parallel_set_threads(0);
}

static void nest(int64_t begin, int64_t end, int32_t worker, void *context)
{
    _Atomic int32_t *n_wrong = context;
    int n_helped = 0;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        const int wrong = check_count(20, 1, i % 16 == 0 ? PAUSE : 0, &n_helped);
        atomic_fetch_add(n_wrong, wrong + n_helped);
    }
}

static void nested_work_stays_in_its_thread(void **state)
{
    (void)state;
    _Atomic int32_t n_wrong = 0;
    clast_parallel_set_threads(4);
    clx_parallel_for(200, 1, nest, &n_wrong);
    assert_int_equal(atomic_load(&n_wrong), 0);
    clast_parallel_set_threads(0);
}

static void *call_often(void *context)
{
    int *wrong = context;
    int n_helped = 0;
    clast_parallel_set_threads(4);
    for (int i = 0; i < ROUNDS; ++i) {
        *wrong += check_count(1 + i % 10, 1 + i % 3, PAUSE, &n_helped);
    }
    return NULL;
}

/* Two threads of a program may call at once: one of them then works alone. */
static void callers_do_not_disturb_each_other(void **state)
{
    (void)state;
    pthread_t caller[3];
    int wrong[3] = {0};
    for (int i = 0; i < 3; ++i) {
        assert_int_equal(pthread_create(&caller[i], NULL, call_often, &wrong[i]), 0);
    }
    for (int i = 0; i < 3; ++i) {
        assert_int_equal(pthread_join(caller[i], NULL), 0);
        assert_int_equal(wrong[i], 0);
    }
}

/* A forked process has none of its parent's threads and must not count on them. */
static void a_forked_process_has_threads_of_its_own(void **state)
{
    (void)state;
#ifdef __SANITIZE_THREAD__
    skip(); // it allows no thread after such a fork
#endif
    clast_parallel_set_threads(4);
    assert_true(is_helped() || clx_parallel_workers() == 1);
    const pid_t child = fork();
    if (child == 0) {
        (void)alarm(60);
        _exit(is_helped() || clx_parallel_workers() == 1 ? 0 : 1);
    }
    int how = -1;
    assert_true(child > 0);
    assert_int_equal(waitpid(child, &how, 0), child);
    assert_true(WIFEXITED(how) && WEXITSTATUS(how) == 0);
    clast_parallel_set_threads(0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_item_is_done_once),
        cmocka_unit_test(nested_work_stays_in_its_thread),
        cmocka_unit_test(callers_do_not_disturb_each_other),
        cmocka_unit_test(a_forked_process_has_threads_of_its_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
