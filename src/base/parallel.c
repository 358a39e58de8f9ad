// A team of threads that outlives the work it is given. docs/adr/0013-threads.md
//
// Idle threads spin for a bounded time, then sleep. Whoever has work opens it and begins at once;
// threads that wake in time join, the others are not waited for. Where other processes take the
// cores from threads that have joined, so that callers wait for them, the team rests for a while.
#if CLAST_HAVE_THREADS
// NOLINTNEXTLINE(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
#define _GNU_SOURCE 1 // sched_getaffinity; as HDF5 2 defines it
#endif
#include "base/parallel.h"

#include "base/clock.h"
#include <clast/machine.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

static void work_alone(int64_t n, int64_t block, clx_kernel kernel, void *context)
{
    for (int64_t begin = 0; begin < n; begin += block) {
        kernel(begin, begin + block < n ? begin + block : n, 0, context);
    }
}

#if CLAST_HAVE_THREADS
#include <fenv.h>
#include <math.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <unistd.h>

enum {
    MOST = 1024, // threads of a team
    SPIN = 2000  // looks before a thread sleeps, 40 to 100 us
};
static const double REST_LEAST = 0.02; // seconds of work alone after a team kept its caller waiting
static const double REST_MOST = 2.0;

// Work at hand: who is at it, whether it is open, which it is.
static const uint64_t ONE = 1;                  // thread at it
static const uint64_t OPEN = UINT64_C(1) << 31; // may be joined
static const uint64_t NEXT = UINT64_C(1) << 32; // number of the work
// Part of the time of recent works, over that at which n threads are no faster than one, 1 - 1/n:
// when so much is lost, the team rests.
static const double LOST = 0.8;

// What threads write stands in cache lines of its own.
// NOLINTNEXTLINE(clang-analyzer-optin.performance.Padding)
static struct {
    _Alignas(64) _Atomic uint64_t state;
    _Alignas(64) _Atomic int64_t next; ///< block to be taken
    // of the work at hand: written while it is closed and none is at it
    int64_t n, block;
    clx_kernel kernel;
    void *context;
    int32_t n_thread, n_look; ///< that may join; looks before they sleep
    // of the caller that has the team
    _Alignas(64) atomic_flag taken;
    int32_t n_made;              ///< threads, apart from callers
    int32_t n_refused;           ///< so many the system would not make; 0: none refused
    double rest_until, rest_for; ///< by clx_clock; how long after the next bad spell [s]
    double lost, spent;          ///< decaying sums over works [s]
    _Atomic int64_t off_ns;      ///< longest time that a thread at the work at hand had no core
    // for those that sleep
    pthread_mutex_t lock;
    pthread_cond_t wake, done;
    _Atomic int32_t n_asleep;
    _Atomic bool is_awaited; ///< the caller sleeps until none is at it
} team = {.taken = ATOMIC_FLAG_INIT,
          .rest_for = 0.02, // REST_LEAST
          .lock = PTHREAD_MUTEX_INITIALIZER,
          .wake = PTHREAD_COND_INITIALIZER,
          .done = PTHREAD_COND_INITIALIZER};

static _Thread_local int32_t n_wanted; // of this thread; 0: as the machine has

/// Cores that this process may use, as it was started: a caller may be bound to one by others.
static cpu_set_t cores;
static int32_t n_cores;

__attribute__((constructor)) static void note_cores(void)
{
    n_cores = sched_getaffinity(0, sizeof cores, &cores) == 0 ? CPU_COUNT(&cores)
                                                              : 0; // more than cpu_set_t holds
}

static int32_t n_core(void)
{
    return n_cores > 0 ? n_cores : (int32_t)fmax(1.0, (double)sysconf(_SC_NPROCESSORS_ONLN));
}

/// Where nobody asks for a number: OMP_NUM_THREADS, as other programs of a job script, or cores.
static int32_t n_usual(void)
{
    static _Atomic int32_t known;
    if (atomic_load(&known) == 0) {
        const char *asked = getenv("OMP_NUM_THREADS"); // NOLINT(concurrency-mt-unsafe)
        const int64_t n = asked != NULL ? strtoll(asked, NULL, 10) : 0;
        atomic_store(&known, n > 0 && n < MOST ? (int32_t)n : n_core());
    }
    return atomic_load(&known);
}

void clast_parallel_set_threads(int32_t n)
{
    n_wanted = n < 0 ? 0 : n < MOST ? n : MOST;
}

int32_t clast_parallel_threads(void)
{
    return n_wanted > 0 ? n_wanted : n_usual();
}

static void relax(void)
{
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    __asm__ volatile("yield");
#endif
}

static uint64_t number_of(uint64_t state)
{
    return state / NEXT;
}

static uint64_t n_at(uint64_t state)
{
    return state & (OPEN - 1);
}

static void run_blocks(int32_t worker)
{
    const int64_t n_block = (team.n + team.block - 1) / team.block;
    for (int64_t b = 0; (b = atomic_fetch_add(&team.next, 1)) < n_block;) {
        const int64_t end = (b + 1) * team.block;
        team.kernel(b * team.block, end < team.n ? end : team.n, worker, team.context);
    }
}

/// How often to look before sleep; not at all where others wait for the core.
static int patience(void)
{
    return clast_parallel_threads() > n_core() ? 0 : SPIN;
}

/// Waits for a work of another number than this.
static void wait_for_work(uint64_t number, int n_look)
{
    for (int i = 0; i < n_look; ++i) {
        if (number_of(atomic_load(&team.state)) != number) {
            return;
        }
        relax();
    }
    (void)pthread_mutex_lock(&team.lock);
    (void)atomic_fetch_add(&team.n_asleep, 1);
    while (number_of(atomic_load(&team.state)) == number) {
        (void)pthread_cond_wait(&team.wake, &team.lock);
    }
    (void)atomic_fetch_sub(&team.n_asleep, 1);
    (void)pthread_mutex_unlock(&team.lock);
}

static bool join(uint64_t number)
{
    uint64_t state = atomic_load(&team.state);
    while (number_of(state) == number && (state & OPEN) != 0) {
        if (atomic_compare_exchange_weak(&team.state, &state, state + ONE)) {
            return true;
        }
    }
    return false;
}

static void leave(void)
{
    const uint64_t before = atomic_fetch_sub(&team.state, ONE);
    if (n_at(before) == 1 && (before & OPEN) == 0 && atomic_load(&team.is_awaited)) {
        (void)pthread_mutex_lock(&team.lock);
        (void)pthread_cond_signal(&team.done);
        (void)pthread_mutex_unlock(&team.lock);
    }
}

/// Takes blocks, and notes how long the thread was without a core meanwhile.
static void work_along(int32_t worker)
{
    const double begun[2] = {clx_clock(), clx_clock_thread()};
    run_blocks(worker);
    const double busy = clx_clock_thread() - begun[1];
    const int64_t off_ns = (int64_t)(1e9 * (clx_clock() - begun[0] - busy));
    int64_t most = atomic_load(&team.off_ns);
    while (off_ns > most && !atomic_compare_exchange_weak(&team.off_ns, &most, off_ns)) {
    }
}

static void *be_worker(void *number_of_worker)
{
    const int32_t worker = *(const int32_t *)number_of_worker;
    (void)fesetenv(FE_DFL_ENV); // not that of the caller who came first
    if (n_cores > 0) {
        (void)pthread_setaffinity_np(pthread_self(), sizeof cores, &cores);
    }
    uint64_t number = number_of(atomic_load(&team.state));
    for (;;) {
        int n_look = 0;
        if (join(number)) {
            if (worker < team.n_thread) {
                n_wanted = team.n_thread; // kernels ask how many they are
                work_along(worker);
                n_look = team.n_look;
            }
            leave();
        }
        wait_for_work(number, n_look);
        number = number_of(atomic_load(&team.state));
    }
    return NULL;
}

/// The child of a fork has none of the threads.
static void forget_team(void)
{
    atomic_store(&team.state, 0);
    atomic_store(&team.n_asleep, 0);
    atomic_store(&team.is_awaited, false);
    team.n_made = team.n_refused = 0;
    (void)pthread_mutex_init(&team.lock, NULL);
    (void)pthread_cond_init(&team.wake, NULL);
    (void)pthread_cond_init(&team.done, NULL);
    atomic_flag_clear(&team.taken);
}

static void watch_forks(void)
{
    (void)pthread_atfork(NULL, NULL, forget_team);
}

/// Signals are for the caller's threads, but for those of a fault in the thread itself and of
/// profilers.
static void block_signals(sigset_t *before)
{
    static const int own[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGABRT, SIGPROF};
    sigset_t blocked;
    (void)sigfillset(&blocked);
    for (size_t k = 0; k < sizeof own / sizeof own[0]; ++k) {
        (void)sigdelset(&blocked, own[k]);
    }
    (void)pthread_sigmask(SIG_SETMASK, &blocked, before);
}

/// Makes threads until there are so many; fewer where the system gives none, which is not asked
/// again.
static void grow_team(int32_t n)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    static int32_t worker[MOST];
    sigset_t before;
    if (team.n_made >= n || (team.n_refused > 0 && team.n_made + 1 >= team.n_refused)) {
        return;
    }
    (void)pthread_once(&once, watch_forks);
    block_signals(&before);
    while (team.n_made < n) {
        pthread_t thread;
        int32_t *own = &worker[team.n_made];
        *own = team.n_made + 1;
        if (pthread_create(&thread, NULL, be_worker, own) != 0) {
            team.n_refused = team.n_made + 1;
            break;
        }
        (void)pthread_detach(thread);
        ++team.n_made;
    }
    (void)pthread_sigmask(SIG_SETMASK, &before, NULL);
}

static void open_work(int64_t n, int64_t block, clx_kernel kernel, void *context)
{
    team.n = n;
    team.block = block;
    team.kernel = kernel;
    team.context = context;
    team.n_thread = clast_parallel_threads();
    team.n_look = patience();
    atomic_store(&team.next, 0);
    atomic_store(&team.off_ns, 0);
    const uint64_t state = atomic_load(&team.state);
    atomic_store(&team.state, (number_of(state) + 1) * NEXT + OPEN);
    if (atomic_load(&team.n_asleep) > 0) {
        (void)pthread_mutex_lock(&team.lock);
        (void)pthread_cond_broadcast(&team.wake);
        (void)pthread_mutex_unlock(&team.lock);
    }
}

/// No block is left: none may join any more, and those at it come to their ends.
static void close_work(void)
{
    (void)atomic_fetch_and(&team.state, ~OPEN);
    for (int i = 0; i < team.n_look; ++i) {
        if (n_at(atomic_load(&team.state)) == 0) {
            return;
        }
        relax();
    }
    (void)pthread_mutex_lock(&team.lock);
    atomic_store(&team.is_awaited, true);
    while (n_at(atomic_load(&team.state)) != 0) {
        (void)pthread_cond_wait(&team.done, &team.lock);
    }
    atomic_store(&team.is_awaited, false);
    (void)pthread_mutex_unlock(&team.lock);
}

/// Lets the team rest where its callers wait for threads that have no core.
static void judge(double begun, double worked, double ended)
{
    const double fade = 1.0 - 1.0 / 32;
    const double off = 1e-9 * (double)atomic_load(&team.off_ns);
    const double waited = ended - worked;
    const double most = LOST * (1.0 - 1.0 / team.n_thread);
    team.lost = fade * team.lost + (off < waited ? off : waited);
    team.spent = fade * team.spent + (ended - begun);
    if (team.lost > most * team.spent && team.spent > 1e-3) {
        team.rest_until = ended + team.rest_for;
        team.rest_for = fmin(2.0 * team.rest_for, REST_MOST);
        team.lost = team.spent = 0.0;
    } else if (team.lost < 0.25 * most * team.spent) {
        team.rest_for = REST_LEAST;
    }
}

void clx_parallel_for(int64_t n, int64_t block, clx_kernel kernel, void *context)
{
    CLAST_ASSERT(block > 0);
    const int32_t n_thread = clast_parallel_threads();
    if (n <= block || n_thread == 1 || atomic_flag_test_and_set(&team.taken)) {
        work_alone(n, block, kernel, context); // the team is another caller's, or this is inside it
        return;
    }
    const double begun = clx_clock();
    if (begun < team.rest_until) {
        work_alone(n, block, kernel, context);
    } else {
        grow_team(n_thread - 1);
        open_work(n, block, kernel, context);
        run_blocks(0);
        const double worked = clx_clock();
        close_work();
        judge(begun, worked, clx_clock());
    }
    atomic_flag_clear(&team.taken);
}

#else

void clast_parallel_set_threads(int32_t n)
{
    (void)n;
}

int32_t clast_parallel_threads(void)
{
    return 1;
}

void clx_parallel_for(int64_t n, int64_t block, clx_kernel kernel, void *context)
{
    work_alone(n, block, kernel, context);
}
#endif

/// The failed block of least number so far: where it begins, its status, its worker's message.
typedef struct {
    clx_task task;
    void *context;
    atomic_flag lock; ///< of what follows
    _Atomic int64_t failed;
    clast_status status;
    char detail[CLX_DETAIL_SIZE];
} attempt;

static void note_failure(attempt *a, int64_t begin, clast_status status)
{
    while (atomic_flag_test_and_set(&a->lock)) {
    }
    if (begin < atomic_load(&a->failed)) {
        atomic_store(&a->failed, begin);
        a->status = status;
        (void)snprintf(a->detail, sizeof a->detail, "%s", clast_error_detail());
    }
    atomic_flag_clear(&a->lock);
}

static void try_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    attempt *a = context;
    if (begin > atomic_load(&a->failed)) {
        return; // those before it are done all the same: the least one that fails is always found
    }
    const clast_status status = a->task(begin, end, worker, a->context);
    if (status != CLAST_OK) {
        note_failure(a, begin, status);
    }
}

clast_status clx_parallel_try(int64_t n, int64_t block, clx_task task, void *context)
{
    attempt a = {.task = task, .context = context, .lock = ATOMIC_FLAG_INIT};
    atomic_init(&a.failed, INT64_MAX);
    clx_parallel_for(n, block, try_block, &a);
    return a.status == CLAST_OK ? CLAST_OK : clx_fail(a.status, "%s", a.detail);
}

int32_t clx_parallel_workers(void)
{
    return clast_parallel_threads();
}
