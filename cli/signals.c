// Signals that ask a command to end.
//
// A loop with a state to save looks at cli_stop_asked() and returns CLAST_E_STOPPED. Where no loop
// looks (a reader, a statistic, a last file), nothing is lost by ending at once: the process
// removes its temporary files and is gone. A loop that does look has twice the longest time between
// two looks so far, and 0.4 s at least, of a processor: on a busy machine, or while a disk is slow,
// that takes longer, 5 s at most.
#include "command.h"

#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

enum { GRACE_US = 400000, PATIENCE_US = 5000000, TICK_US = 50000 };

static volatile sig_atomic_t caught;
static _Atomic int64_t last_look;        ///< us since some moment, 0: no loop has looked
static _Atomic int64_t look_period;      ///< us between two looks, the most so far
static bool is_alone;                    ///< no other rank waits for what this one does
static clockid_t processor;              ///< time that the looking thread has had of a processor
static _Atomic int64_t asked[2];         ///< us of that clock and of the wall's when a signal came
static _Atomic int64_t grace;            ///< us
static volatile sig_atomic_t has_limit;  ///< --time-limit is set and not yet up
static volatile sig_atomic_t is_time_up; ///< it is what ended the command
static char last_words[2][160];          ///< of a signal, of the limit
static char way_on[512];                 ///< where a loop that looked has left checkpoints, or ""

static _Noreturn void leave(int number)
{
    clast_outputs_abandon();
    const bool has_state = way_on[0] != '\0' && atomic_load(&last_look) != 0;
    const char *const words[] = {last_words[is_time_up], has_state ? way_on : "", "\n"};
    for (size_t k = 0; k < sizeof words / sizeof *words; ++k) {
        const ssize_t n = write(STDERR_FILENO, words[k], strlen(words[k]));
        (void)n; // nobody is left to be told
    }
    _exit(128 + number);
}

static int64_t now_us(clockid_t clock)
{
    struct timespec t = {0};
    (void)clock_gettime(clock, &t);
    return (int64_t)t.tv_sec * 1000000 + t.tv_nsec / 1000;
}

static void on_signal(int number);

/// The time limit is up; else ends a process whose loop does not look although it had the time.
static void on_alarm(int number)
{
    (void)number;
    if (has_limit) {
        has_limit = 0;
        is_time_up = 1;
        on_signal(SIGTERM);
        return;
    }
    const int64_t most = atomic_load(&grace);
    if (now_us(processor) - atomic_load(&asked[0]) >= most ||
        now_us(CLOCK_MONOTONIC) - atomic_load(&asked[1]) >= most + PATIENCE_US) {
        leave(caught);
    }
}

static void on_signal(int number)
{
    if (caught == number || atomic_load(&last_look) == 0) {
        leave(number); // asked twice, or nothing to save
    }
    caught = number;
    has_limit = 0;
    const int64_t two = 2 * atomic_load(&look_period);
    const int64_t wait = two > GRACE_US ? two : GRACE_US;
    const struct itimerval timer = {
        .it_value = {.tv_sec = (time_t)(wait / 1000000), .tv_usec = (suseconds_t)(wait % 1000000)},
        .it_interval = {.tv_usec = TICK_US}};
    atomic_store(&grace, wait);
    atomic_store(&asked[0], now_us(processor));
    atomic_store(&asked[1], now_us(CLOCK_MONOTONIC));
    if (is_alone) {
        (void)setitimer(ITIMER_REAL, &timer, NULL);
    }
}

/// Processor time of the calling thread; the wall's where no signal comes (WebAssembly).
static clockid_t thread_clock(void)
{
    clockid_t clock = CLOCK_MONOTONIC;
#ifndef __EMSCRIPTEN__
    if (pthread_getcpuclockid(pthread_self(), &clock) != 0) {
        clock = CLOCK_MONOTONIC;
    }
#endif
    return clock;
}

bool cli_stop_asked(void)
{
    const int64_t now = (int64_t)(1e6 * cli_clock()) + 1;
    if (atomic_load(&last_look) == 0) {
        processor = thread_clock();
    }
    const int64_t last = atomic_exchange(&last_look, now);
    if (last != 0 && now - last > atomic_load(&look_period)) { // one thread looks
        atomic_store(&look_period, now - last);
    }
    if (caught != 0) {
        const struct itimerval never = {0};
        (void)setitimer(ITIMER_REAL, &never, NULL);
    }
    return caught != 0;
}

int cli_signal_code(void)
{
    return caught != 0 ? 128 + (int)caught : 0;
}

/// A run of a study ends with it, as by SIGTERM, however the study ended.
static void end_with_study(void)
{
#ifdef __linux__
    const char *study = getenv("CLAST_STUDY_PROCESS"); // NOLINT(concurrency-mt-unsafe)
    char parent[32];
    (void)snprintf(parent, sizeof parent, "%ld", (long)getppid());
    if (study != NULL && strcmp(study, parent) == 0) {
        (void)prctl(PR_SET_PDEATHSIG, SIGTERM);
        if (strtol(study, NULL, 10) != (long)getppid()) { // gone before the call
            leave(SIGTERM);
        }
    }
#endif
}

clast_status cli_time_limit(const char *text)
{
    double seconds = 0.0;
    if (text == NULL) {
        return CLAST_OK;
    }
    const clast_status status = clast_unit_parse_asked(text, "s", &seconds);
    if (status != CLAST_OK) {
        return cli_fail(status, "--time-limit: %s", clast_error_detail());
    }
    if (!(seconds >= 1e-3 && seconds <= 1e8)) {
        return cli_fail(CLAST_E_USAGE, "--time-limit takes a time from 1 ms to 1e8 s, not '%s'",
                        text);
    }
    const struct itimerval timer = {
        .it_value = {.tv_sec = (time_t)seconds,
                     .tv_usec = (suseconds_t)(1e6 * (seconds - floor(seconds)))}};
    has_limit = 1;
    (void)setitimer(ITIMER_REAL, &timer, NULL);
    return CLAST_OK;
}

void cli_signals_way_on(const char *command, const char *folder)
{
    (void)snprintf(way_on, sizeof way_on,
                   "; what it did after its last checkpoint is lost: clast %s --resume %.400s goes "
                   "on from there",
                   command, cli_name(folder));
}

void cli_signals_begin(const char *command, const clast_comm *comm)
{
    const struct sigaction action = {.sa_handler = on_signal, .sa_flags = SA_RESTART};
    const struct sigaction alarm = {.sa_handler = on_alarm, .sa_flags = SA_RESTART};
    static const int number[] = {SIGINT, SIGTERM, SIGHUP};
    is_alone = comm->n_rank == 1;
    for (int k = 0; k < 2 && comm->rank == 0; ++k) { // it speaks for all that mpirun ends
        (void)snprintf(last_words[k], sizeof last_words[k],
                       "clast %s: ended by %s; the files that it had finished are whole", command,
                       k == 0 ? "a signal" : "--time-limit");
    }
    for (size_t k = 0; k < sizeof number / sizeof number[0]; ++k) {
        struct sigaction before;
        if (sigaction(number[k], NULL, &before) == 0 && before.sa_handler != SIG_IGN) { // nohup
            (void)sigaction(number[k], &action, NULL);
        }
    }
    (void)sigaction(SIGALRM, &alarm, NULL);
    end_with_study();
}
