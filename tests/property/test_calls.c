/* Property: every public function, called with NULL for each argument that it needs, ends with
 * CLAST_E_ARGUMENT or CLAST_E_CONFIG and names it and itself; called with structs filled from bytes
 * it ends with some status, says why it refuses and leaves its outputs as they were; called with
 * objects that hold together and one double that is NaN, or one enumerator that there is not, it
 * refuses. In release builds too. Functions and structs come from the headers
 * (tests/fuzz/make_calls.py). Before, most crashed: 2 of 100 looked. Handles were NULL then, so
 * that clast_dem_read_grain took any number, and no call was good but for one number, so that a
 * confidence of NaN went through. */
#include "support.h"

#include "../fuzz/calls.h"
#include "base/status.h"

#include <signal.h>
#include <stdio.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

enum { UNTOUCHED = 0x5a, N_ROUND = 40, N_NUMBER = 1000 };

/// What is tried.
typedef enum { WITH_NULL, WITH_ANY_BYTES, WITH_A_WRONG_NUMBER } trial;
static const char *const trial_name[] = {"argument", "round", "number"};

/// Whether a call need not look at a number: options of files that there are not.
static bool is_any(const char *number)
{
    static const char options[] = "clast_grains_options.";
    return strncmp(number, options, sizeof options - 1) == 0;
}

static int n_number; ///< of the last call

/// What is wrong with a call, NULL for nothing; `k` is the argument that is NULL, the round, or
/// twice the number that is wrong: once with each of two good objects.
static const char *fault(const public_call *c, uint64_t seed, trial what, int k)
{
    static uint8_t byte[512];
    const int null = what == WITH_NULL ? k : -1;
    for (size_t i = 0; i < sizeof byte; ++i) {
        seed = seed * 6364136223846793005U + 1442695040888963407U;
        byte[i] = (uint8_t)(seed >> 56);
    }
    source s = {.byte = byte,
                .n = null >= 0 ? 0 : sizeof byte,
                .blank = null >= 0 ? UNTOUCHED : 0,
                .is_good = what == WITH_A_WRONG_NUMBER,
                .spoilt = k / 2};
    good_variant = k % 2;
    (void)clx_fail(CLAST_OK, "untold");
    const int status = c->call(&s, null);
    n_number = s.n_number;
    if (!c->has_status || (s.is_good && (s.wrong == NULL || is_any(s.wrong)))) {
        return NULL;
    }
    if (status <= CLAST_OK) {
        return null >= 0 ? "takes NULL" : s.is_good ? s.wrong : NULL;
    }
    if (null >= 0 && status == CLAST_E_ARGUMENT && strstr(clast_error_detail(), c->name) == NULL) {
        return "names another function";
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
static int try_calls(int first, trial what, volatile int *at)
{
    int bad = 0;
    for (int i = first; i < N_CALLS; ++i) {
        const public_call *c = &calls[i];
        const int n = what == WITH_NULL        ? 16
                      : c->is_long             ? 0
                      : what == WITH_ANY_BYTES ? N_ROUND
                                               : N_NUMBER;
        for (int k = 0; k < n; ++k) {
            at[0] = i;
            at[1] = k;
            if (what == WITH_NULL && (c->needed >> k & 1) == 0) {
                continue;
            }
            alarm(120); // a hang; the machine may have other work
            const char *wrong = fault(c, 7919U * (unsigned)i + (unsigned)k, what, k);
            alarm(0);
            if (wrong != NULL) {
                fprintf(stderr, "%s: %s (%s %d): %s\n", c->name, wrong, trial_name[what], k,
                        clast_error_detail());
                ++bad;
            }
            if (what == WITH_A_WRONG_NUMBER && k / 2 >= n_number) {
                break;
            }
        }
    }
    return bad < 100 ? bad : 100;
}

/// All calls, in a child that is started again behind each call that ends it.
static int count_faults(trial what)
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
            _exit(try_calls(first, what, at));
        }
        assert_int_equal(waitpid(child, &ended, 0), child);
        if (WIFEXITED(ended) && at[0] == N_CALLS - 1) {
            bad += WEXITSTATUS(ended);
            break;
        }
        fprintf(stderr, "%s ends the process (%s %d)\n", calls[at[0]].name, trial_name[what],
                at[1]);
        ++bad;
    }
    (void)munmap((void *)at, sizeof(int[2]));
    (void)fclose(file);
    return bad;
}

static void every_function_refuses_null(void **state)
{
    (void)state;
    assert_int_equal(count_faults(WITH_NULL), 0);
}

static void every_function_stands_structs_of_any_bytes(void **state)
{
    (void)state;
    assert_int_equal(count_faults(WITH_ANY_BYTES), 0);
}

static void no_function_takes_a_number_that_cannot_be(void **state)
{
    (void)state;
    assert_int_equal(count_faults(WITH_A_WRONG_NUMBER), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_function_refuses_null),
        cmocka_unit_test(every_function_stands_structs_of_any_bytes),
        cmocka_unit_test(no_function_takes_a_number_that_cannot_be),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
