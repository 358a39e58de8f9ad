/* Property: every public function, called with NULL for each argument that it needs, ends with
 * CLAST_E_ARGUMENT or CLAST_E_CONFIG and names it; called with structs filled from bytes it ends
 * with some status, says why it refuses and leaves its outputs as they were. In release builds too.
 * Functions and structs come from the headers (tests/fuzz/make_calls.py). Before, most crashed: 2
 * of 100 looked. */
#include "support.h"

#include "../fuzz/calls.h"
#include "base/status.h"

#include <signal.h>
#include <stdio.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

enum { UNTOUCHED = 0x5a, N_ROUND = 40 };

/// What is wrong with a call, NULL for nothing; `null` as in public_call.
static const char *fault(const public_call *c, uint64_t seed, int null)
{
    static uint8_t byte[512];
    for (size_t i = 0; i < sizeof byte; ++i) {
        seed = seed * 6364136223846793005U + 1442695040888963407U;
        byte[i] = (uint8_t)(seed >> 56);
    }
    source s = {.byte = byte, .n = null >= 0 ? 0 : sizeof byte, .blank = null >= 0 ? UNTOUCHED : 0};
    (void)clx_fail(CLAST_OK, "untold");
    const int status = c->call(&s, null);
    if (!c->has_status) {
        return NULL;
    }
    if (status <= CLAST_OK) {
        return null >= 0 ? "takes NULL" : NULL;
    }
    if (null >= 0 && status != CLAST_E_ARGUMENT && status != CLAST_E_CONFIG) {
        return "does not refuse NULL";
    }
    if (strcmp(clast_error_detail(), "untold") == 0 || clast_error_detail()[0] == '\0') {
        return "says nothing";
    }
    return has_written(&s) ? "has changed an output" : NULL;
}

/// Runs calls from `first` on, each call's place written to `at`; the number of faults.
static int try_calls(int first, bool with_null, volatile int *at)
{
    int bad = 0;
    for (int i = first; i < N_CALLS; ++i) {
        const public_call *c = &calls[i];
        const int n = with_null ? 16 : c->is_long ? 0 : N_ROUND;
        for (int k = 0; k < n; ++k) {
            at[0] = i;
            at[1] = k;
            if (with_null && (c->needed >> k & 1) == 0) {
                continue;
            }
            alarm(20);
            const char *what = fault(c, 7919U * (unsigned)i + (unsigned)k, with_null ? k : -1);
            alarm(0);
            if (what != NULL) {
                fprintf(stderr, "%s %s (%s %d): %s\n", c->name, what,
                        with_null ? "argument" : "round", k, clast_error_detail());
                ++bad;
            }
        }
    }
    return bad < 100 ? bad : 100;
}

/// All calls, in a child that is started again behind each call that ends it.
static int count_faults(bool with_null)
{
    FILE *file = tmpfile();
    assert_non_null(file);
    assert_int_equal(ftruncate(fileno(file), sizeof(int[2])), 0);
    volatile int *at =
        mmap(NULL, sizeof(int[2]), PROT_READ | PROT_WRITE, MAP_SHARED, fileno(file), 0);
    int bad = 0;
    int ended = 0;
    assert_true(at != MAP_FAILED);
    for (int first = 0; first < N_CALLS; first = at[0] + 1) {
        const pid_t child = fork();
        if (child == 0) {
            const int fatal[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
            for (int k = 0; k < 5; ++k) {
                (void)signal(fatal[k], SIG_DFL); // cmocka would go on
            }
            (void)clast_memory_set_limit(1 << 30);
            _exit(try_calls(first, with_null, at));
        }
        assert_int_equal(waitpid(child, &ended, 0), child);
        if (WIFEXITED(ended) && at[0] == N_CALLS - 1) {
            bad += WEXITSTATUS(ended);
            break;
        }
        fprintf(stderr, "%s ends the process (%s %d)\n", calls[at[0]].name,
                with_null ? "argument" : "round", at[1]);
        ++bad;
    }
    (void)munmap((void *)at, sizeof(int[2]));
    (void)fclose(file);
    return bad;
}

static void every_function_refuses_null(void **state)
{
    (void)state;
    assert_int_equal(count_faults(true), 0);
}

static void every_function_stands_structs_of_any_bytes(void **state)
{
    (void)state;
    assert_int_equal(count_faults(false), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_function_refuses_null),
        cmocka_unit_test(every_function_stands_structs_of_any_bytes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
