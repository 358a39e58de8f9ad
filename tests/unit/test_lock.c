/* Unit: locks between processes. */
#include "support.h"

#include "base/lock.h"
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static const char *const PATH = "test_lock.h5";

static void who_has_it_is_named_and_nobody_else_gets_it(void **state)
{
    clx_lock lock = {0};
    bool is_busy = true;
    (void)state;
    assert_false(clx_lock_is_held(PATH));
    CHECK_OK(clx_lock_acquire(PATH, 0.0, &lock, &is_busy));
    assert_false(is_busy);
    assert_true(clx_lock_is_held(PATH));
    const pid_t child = fork();
    if (child == 0) {
        clx_lock other = {0};
        bool was_busy = false;
        const clast_status status = clx_lock_acquire(PATH, 0.05, &other, &was_busy);
        _exit(status == CLAST_E_DISK && was_busy && strstr(clast_error_detail(), "process ") != NULL
                  ? 0
                  : 1);
    }
    int end = 0;
    assert_int_equal(waitpid(child, &end, 0), child);
    assert_int_equal(end, 0);
    clx_lock_release(&lock);
    assert_int_not_equal(access("test_lock.h5.lock", F_OK), 0);
    clx_lock_release(&lock);
}

static void a_process_that_dies_lets_go(void **state)
{
    clx_lock lock = {0};
    bool is_busy = true;
    (void)state;
    const pid_t child = fork();
    if (child == 0) {
        _exit(clx_lock_acquire(PATH, 0.0, &lock, &is_busy) == CLAST_OK ? 0 : 1);
    }
    int end = 0;
    assert_int_equal(waitpid(child, &end, 0), child);
    assert_int_equal(end, 0);
    assert_false(clx_lock_is_held(PATH));
    assert_int_equal(access("test_lock.h5.lock", F_OK), 0); /* the file is left, the lock is not */
    CHECK_OK(clx_lock_acquire(PATH, 0.0, &lock, &is_busy));
    clx_lock_release(&lock);
    CHECK_STATUS(clx_lock_acquire("no/such/folder/x", 0.0, &lock, &is_busy), CLAST_E_DISK);
    assert_false(is_busy);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(who_has_it_is_named_and_nobody_else_gets_it),
        cmocka_unit_test(a_process_that_dies_lets_go),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
