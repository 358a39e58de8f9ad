// A team of threads that waits for work behind one function; without threads the same blocks run in
// order. OpenMP says how many (OMP_NUM_THREADS, the cores that this process may use); its own
// regions are not used, since their threads spin for milliseconds where work comes in short
// pieces: on a machine whose two cores others use too, EJ15 tight took 4.0 s so, with 1.4 s of
// processor time, and one thread 1.0 s with 0.44 s.
//
// Here a thread spins for SPIN, about what it takes to wake one that sleeps, and whoever hands out
// work does not wait for threads that have not begun: they find the job closed when they come.
#ifdef __linux__
// NOLINTNEXTLINE(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp): glibc's, for affinity
#define _GNU_SOURCE 1
#endif
#include "base/parallel.h"

#include <clast/parallel.h>

#ifdef _OPENMP
#include "base/clock.h"
#include <omp.h>
#include <pthread.h>
#include <stdatomic.h>
#ifdef __linux__
#include <sched.h>
#endif

enum { PAUSES = 32 }; // between looks at the clock

static const double SPIN = 1e-4; // s

void clast_parallel_set_threads(int32_t n)
{
    omp_set_num_threads(n > 0 ? n : omp_get_num_procs());
}

int32_t clast_parallel_threads(void)
{
    return omp_get_max_threads();
}

/// The blocks of one call.
typedef struct {
    clx_kernel kernel;
    void *context;
    int64_t n, block, n_block;
} work;

static struct {
    pthread_mutex_t lock;     ///< of what has no other owner
    pthread_cond_t wake;      ///< a job has come
    pthread_cond_t left;      ///< its last worker has left
    _Atomic int64_t round;    ///< number of the job; changes under the lock
    _Atomic int32_t n_active; ///< workers in it; changes under the lock
    bool is_open;             ///< more may join
    int32_t n_wanted, n_joined;
    int32_t n_thread, n_asleep;
    work job;             ///< changes while no worker is active
    _Atomic int64_t next; ///< block to hand out
} team = {.lock = PTHREAD_MUTEX_INITIALIZER,
          .wake = PTHREAD_COND_INITIALIZER,
          .left = PTHREAD_COND_INITIALIZER};

static atomic_flag is_taken = ATOMIC_FLAG_INIT; ///< some thread hands out work
static _Thread_local bool is_inside;            ///< this one works on a block

static void run_blocks(const work *w, int64_t first, int64_t end, int32_t worker)
{
    for (int64_t b = first; b < end; ++b) {
        const int64_t stop = (b + 1) * w->block;
        w->kernel(b * w->block, stop < w->n ? stop : w->n, worker, w->context);
    }
}

/// Blocks as long as there are any.
static void run_shared(int32_t worker)
{
    is_inside = true;
    for (;;) {
        const int64_t b = atomic_fetch_add_explicit(&team.next, 1, memory_order_relaxed);
        if (b >= team.job.n_block) {
            break;
        }
        run_blocks(&team.job, b, b + 1, worker);
    }
    is_inside = false;
}

static void rest(void)
{
    for (int i = 0; i < PAUSES; ++i) {
#if defined(__x86_64__) || defined(__i386__)
        __builtin_ia32_pause();
#endif
    }
}

/// Spins until a job other than `seen` has come, for SPIN at most.
static void await_round(int64_t seen)
{
    const double end = clx_clock() + SPIN;
    while (atomic_load_explicit(&team.round, memory_order_relaxed) == seen && clx_clock() < end) {
        rest();
    }
}

/// Spins until no worker is active, for SPIN at most.
static void await_leave(void)
{
    const double end = clx_clock() + SPIN;
    while (atomic_load_explicit(&team.n_active, memory_order_relaxed) > 0 && clx_clock() < end) {
        rest();
    }
}

/// Joins the job under the lock, if it wants more; works on it without the lock.
static void join(void)
{
    if (!team.is_open || team.n_joined >= team.n_wanted) {
        return;
    }
    const int32_t worker = ++team.n_joined;
    atomic_fetch_add(&team.n_active, 1);
    (void)pthread_mutex_unlock(&team.lock);
    run_shared(worker);
    (void)pthread_mutex_lock(&team.lock);
    if (atomic_fetch_sub(&team.n_active, 1) == 1) {
        (void)pthread_cond_signal(&team.left);
    }
}

/// OMP_PROC_BIND and OMP_PLACES bind the first thread to the first place, and new threads would
/// share it: each goes to the next place. Nothing to do where nothing is bound.
static void take_place(void)
{
#ifdef __linux__
    static _Atomic int32_t number = 0;
    const int n_place = omp_get_num_places();
    int id[CPU_SETSIZE];
    if (n_place < 1) {
        return;
    }
    const int place = (int)(1 + atomic_fetch_add(&number, 1)) % n_place;
    const int n = omp_get_place_num_procs(place);
    cpu_set_t set;
    CPU_ZERO(&set);
    if (n < 1 || n > CPU_SETSIZE) {
        return;
    }
    omp_get_place_proc_ids(place, id);
    for (int i = 0; i < n; ++i) {
        if (id[i] >= 0 && id[i] < CPU_SETSIZE) {
            CPU_SET((size_t)id[i], &set);
        }
    }
    (void)pthread_setaffinity_np(pthread_self(), sizeof set, &set);
#endif
}

/// A worker's life.
static void *serve(void *nothing)
{
    int64_t seen = -1;
    take_place();
    (void)pthread_mutex_lock(&team.lock);
    for (;;) {
        while (atomic_load(&team.round) != seen) {
            seen = atomic_load(&team.round);
            join();
        }
        (void)pthread_mutex_unlock(&team.lock);
        await_round(seen);
        (void)pthread_mutex_lock(&team.lock);
        if (atomic_load(&team.round) == seen) {
            ++team.n_asleep;
            (void)pthread_cond_wait(&team.wake, &team.lock);
            --team.n_asleep;
        }
    }
    return nothing;
}

/// A child process has none of its parent's threads.
static void start_afresh(void)
{
    (void)pthread_mutex_init(&team.lock, NULL);
    (void)pthread_cond_init(&team.wake, NULL);
    (void)pthread_cond_init(&team.left, NULL);
    team.n_thread = team.n_asleep = 0;
    team.is_open = false;
    atomic_store(&team.n_active, 0);
    atomic_flag_clear(&is_taken);
}

static void watch_forks(void)
{
    (void)pthread_atfork(NULL, NULL, start_afresh);
}

/// Under the lock; a thread that cannot be had is done without.
static void enlist(int32_t n)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    (void)pthread_once(&once, watch_forks);
    while (team.n_thread < n) {
        pthread_t thread;
        if (pthread_create(&thread, NULL, serve, NULL) != 0) {
            break;
        }
        (void)pthread_detach(thread);
        ++team.n_thread;
    }
}

static void open_job(const work *w, int32_t n_helper)
{
    (void)pthread_mutex_lock(&team.lock);
    enlist(n_helper);
    team.job = *w;
    team.n_joined = 0;
    team.n_wanted = n_helper;
    team.is_open = true;
    atomic_store_explicit(&team.next, 0, memory_order_relaxed);
    atomic_fetch_add(&team.round, 1);
    if (team.n_asleep > 0) {
        (void)pthread_cond_broadcast(&team.wake);
    }
    (void)pthread_mutex_unlock(&team.lock);
}

/// Nobody joins any more; waits for those who have.
static void close_job(void)
{
    (void)pthread_mutex_lock(&team.lock);
    team.is_open = false;
    if (atomic_load(&team.n_active) > 0) {
        (void)pthread_mutex_unlock(&team.lock);
        await_leave();
        (void)pthread_mutex_lock(&team.lock);
        while (atomic_load(&team.n_active) > 0) {
            (void)pthread_cond_wait(&team.left, &team.lock);
        }
    }
    (void)pthread_mutex_unlock(&team.lock);
}

void clx_parallel_for(int64_t n, int64_t block, clx_kernel kernel, void *context)
{
    const int64_t n_block = (n + block - 1) / block;
    const work w = {kernel, context, n, block, n_block};
    const int64_t n_thread = omp_get_max_threads();
    if (n_block <= 1 || n_thread == 1 || is_inside || atomic_flag_test_and_set(&is_taken)) {
        run_blocks(&w, 0, n_block, 0);
        return;
    }
    open_job(&w, (int32_t)((n_block < n_thread ? n_block : n_thread) - 1));
    run_shared(0);
    close_job();
    atomic_flag_clear(&is_taken);
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
    for (int64_t begin = 0; begin < n; begin += block) {
        kernel(begin, begin + block < n ? begin + block : n, 0, context);
    }
}
#endif

int32_t clx_parallel_workers(void)
{
    return clast_parallel_threads();
}
