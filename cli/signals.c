// Signals that ask a command to end.
//
// A loop with a state to save looks at cli_stop_asked() and returns CLAST_E_STOPPED. Where no loop
// looks (a reader, a statistic, a last file), nothing is lost by ending at once: the process
// removes its temporary files and is gone. A loop that does look has twice the time between its
// last two looks, and 0.4 s at least, of a processor: on a busy machine, or while a disk is slow,
// that takes longer, 5 s at most.
#include "command.h"

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
static _Atomic int64_t last_look;   ///< us since some moment, 0: no loop has looked
static _Atomic int64_t look_period; ///< us between the last two looks
static bool is_alone;               ///< no other rank waits for what this one does
static clockid_t processor;         ///< time that the looking thread has had of a processor
static _Atomic int64_t asked[2];    ///< us of that clock and of the wall's when a signal came
static _Atomic int64_t grace;       ///< us
static char last_words[160];

static _Noreturn void leave(int number)
{
    clast_outputs_abandon();
    const ssize_t n = write(STDERR_FILENO, last_words, strlen(last_words));
    (void)n; // nobody is left to be told
    _exit(128 + number);
}

static int64_t now_us(clockid_t clock)
{
    struct timespec t = {0};
    (void)clock_gettime(clock, &t);
    return (int64_t)t.tv_sec * 1000000 + t.tv_nsec / 1000;
}

/// Ends a process whose loop does not look although it had the time.
static void on_alarm(int number)
{
    (void)number;
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
    if (last != 0) {
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

void cli_signals_begin(const char *command, const clast_comm *comm)
{
    const struct sigaction action = {.sa_handler = on_signal, .sa_flags = SA_RESTART};
    const struct sigaction alarm = {.sa_handler = on_alarm, .sa_flags = SA_RESTART};
    static const int number[] = {SIGINT, SIGTERM, SIGHUP};
    is_alone = comm->n_rank == 1;
    (void)snprintf(last_words, sizeof last_words,
                   "clast %s: ended by a signal; the files that it had finished are whole\n",
                   command);
    if (comm->rank != 0) {
        last_words[0] = '\0'; // the first rank speaks for all that mpirun ends
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
