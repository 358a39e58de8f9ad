// A heartbeat over UDP: every rank sends rank 0 a datagram a second, which answers each. MPI itself
// waits for ever for a rank that is stopped, and may be called by one thread only, which computes.
//
// Rank 0 watches all others, they watch rank 0. A rank that was never heard (datagrams blocked
// between machines) is not watched. One that was stopped itself, as when a queue suspends the whole
// job, starts its clocks anew.
#include "watch.h"

#include <arpa/inet.h>
#include <math.h>
#include <netdb.h>
#include <netinet/in.h>
#include <pthread.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

static const double usual_limit = 60.0;
static const double most_limit = 1e6;

enum { HOST = 64, BEATS_A_LIMIT = 10, LOST_CODE = 4 };

/// In the place of a process: rank 0 ends the job.
enum { ENDING = -1 };

/// What a launcher has then to end the others; those that it leaves end themselves [s].
static const double ending_grace = 10.0;

/// Where rank 0 listens, told to all.
typedef struct {
    double limit;   ///< s, 0: nobody is watched
    uint64_t nonce; ///< of this job: other datagrams are not ours
    uint16_t port;
    char host[HOST];
} meeting;

/// A datagram.
typedef struct {
    uint64_t nonce;
    int32_t rank, process;
    char host[HOST];
} beat;

/// Who is watched.
typedef struct {
    double heard; ///< when, 0: never
    struct sockaddr_in from;
    int32_t process;
    char host[HOST];
} watched;

static struct {
    const char *command;
    int32_t rank, n_rank;
    int socket;
    meeting meeting;
    beat own;
    watched *other; ///< [n_rank] of rank 0, [1] else: rank 0
    double ending;  ///< when rank 0 said that it ends the job, 0: never
} watch;

static double now(void)
{
    struct timespec t = {0};
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/// Ends this process, and with it the job, with one line.
static _Noreturn void end_job(int32_t lost, int32_t n_lost, const watched *w)
{
    char line[512];
    char more[48] = "";
    if (n_lost > 1) {
        (void)snprintf(more, sizeof more, " and %d more ranks", n_lost - 1);
    }
    const int n = snprintf(
        line, sizeof line,
        "clast %s: rank %d (process %d on %s)%s not heard of for %g s: stopped, or its machine is "
        "gone; the job ends, files that were finished are whole\n",
        watch.command, lost, w->process, w->host, more, watch.meeting.limit);
    watch.own.process = ENDING; // while the launcher ends the others, they miss nobody
    for (int32_t k = 1; k < watch.n_rank && watch.rank == 0; ++k) {
        (void)sendto(watch.socket, &watch.own, sizeof watch.own, 0, (void *)&watch.other[k].from,
                     sizeof watch.other[k].from);
    }
    clast_outputs_abandon();
    const size_t most = sizeof line - 1; // the command is a word of the user's
    const ssize_t written = write(STDERR_FILENO, line, n < (int)most ? (size_t)n : most);
    (void)written; // nobody is left to be told
    _exit(LOST_CODE);
}

/// Takes a datagram; rank 0 answers it.
static void note_beat(double at)
{
    beat got;
    struct sockaddr_in from;
    socklen_t size = sizeof from;
    const ssize_t n = recvfrom(watch.socket, &got, sizeof got, 0, (void *)&from, &size);
    const bool is_first = watch.rank == 0;
    if (n != (ssize_t)sizeof got || got.nonce != watch.meeting.nonce || got.rank < 0 ||
        got.rank >= watch.n_rank || (got.rank == 0) == is_first) {
        return;
    }
    watched *w = &watch.other[is_first ? got.rank : 0];
    w->heard = got.process == ENDING ? 0.0 : at;
    watch.ending = got.process == ENDING && watch.ending == 0.0 ? at : watch.ending;
    w->from = from;
    w->process = got.process;
    memcpy(w->host, got.host, sizeof w->host);
    w->host[HOST - 1] = '\0';
    if (is_first) {
        (void)sendto(watch.socket, &watch.own, sizeof watch.own, 0, (void *)&from, size);
    }
}

/// Takes what comes for so long.
static void listen_for(double seconds)
{
    const double until = now() + seconds;
    while (now() < until) {
        const double left = fmax(0.0, until - now()) + 1e-3;
        const struct timeval timeout = {
            .tv_sec = (time_t)left, .tv_usec = (suseconds_t)(1e6 * (left - (double)(time_t)left))};
        (void)setsockopt(watch.socket, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
        note_beat(now());
    }
}

/// Ends this process where rank 0, which said why, ended and the launcher did not end the others:
/// MPI would wait for ever.
static void end_after_first(double at)
{
    if (watch.ending > 0.0 && at - watch.ending > ending_grace) {
        clast_outputs_abandon();
        _exit(LOST_CODE);
    }
}

/// Looks for ranks that have been silent too long. Of several that miss rank 0 the first speaks.
static void look(double at)
{
    const double patience = watch.rank > 1 ? 2.0 * watch.rank : 0.0;
    const int32_t n = watch.rank == 0 ? watch.n_rank : 1;
    int32_t n_lost = 0;
    int32_t lost = 0;
    for (int32_t k = n - 1; k >= 0; --k) {
        const double heard = watch.other[k].heard;
        if (heard > 0.0 && at - heard > watch.meeting.limit + patience) {
            lost = k;
            ++n_lost;
        }
    }
    if (n_lost > 0) {
        end_job(lost, n_lost, &watch.other[lost]);
    }
}

static void *keep_watch(void *nothing)
{
    const double period =
        watch.meeting.limit < BEATS_A_LIMIT ? watch.meeting.limit / BEATS_A_LIMIT : 1.0;
    const int32_t n = watch.rank == 0 ? watch.n_rank : 1;
    (void)nothing;
    for (double last = now();;) {
        if (watch.rank > 0) {
            (void)send(watch.socket, &watch.own, sizeof watch.own, 0);
        }
        listen_for(period);
        const double at = now();
        for (int32_t k = 0; k < n && at - last > 3.0 * period; ++k) { // stopped, or starved, itself
            watch.other[k].heard = watch.other[k].heard > 0.0 ? at : 0.0;
        }
        look(at);
        end_after_first(at);
        last = at;
    }
    return NULL;
}

/// Rank 0's socket; false where there is none.
static bool open_first(meeting *m)
{
    struct sockaddr_in at = {.sin_family = AF_INET};
    socklen_t size = sizeof at;
    watch.socket = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (watch.socket < 0 || bind(watch.socket, (void *)&at, sizeof at) != 0 ||
        getsockname(watch.socket, (void *)&at, &size) != 0) {
        return false;
    }
    m->port = at.sin_port;
    memcpy(m->host, watch.own.host, sizeof m->host);
    m->nonce = (uint64_t)getpid() << 32 ^ (uint64_t)(1e9 * now());
    return true;
}

/// The socket of another rank, connected to rank 0's.
static bool open_other(const meeting *m)
{
    const struct addrinfo wanted = {.ai_family = AF_INET, .ai_socktype = SOCK_DGRAM};
    struct addrinfo *found = NULL;
    const bool is_here = strcmp(m->host, watch.own.host) == 0;
    if (getaddrinfo(is_here ? "127.0.0.1" : m->host, NULL, &wanted, &found) != 0) {
        return false;
    }
    struct sockaddr_in at;
    memcpy(&at, found->ai_addr, sizeof at);
    at.sin_port = m->port;
    freeaddrinfo(found);
    watch.socket = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    return watch.socket >= 0 && connect(watch.socket, (void *)&at, sizeof at) == 0;
}

/// The time limit of the environment; false where it is none.
static bool read_limit(double *limit)
{
    const char *word = getenv("CLAST_RANK_TIMEOUT"); // NOLINT(concurrency-mt-unsafe)
    char *end = NULL;
    *limit = word != NULL ? strtod(word, &end) : usual_limit;
    return word == NULL || (end != word && *end == '\0' &&
                            (*limit == 0.0 || (*limit >= 1.0 && *limit <= most_limit)));
}

/// A thread that no signal reaches: they are the main thread's.
static bool begin_thread(void)
{
    sigset_t all;
    sigset_t before;
    pthread_t thread;
    (void)sigfillset(&all);
    (void)pthread_sigmask(SIG_SETMASK, &all, &before);
    const bool is_begun = pthread_create(&thread, NULL, keep_watch, NULL) == 0;
    if (is_begun) {
        (void)pthread_detach(thread);
    }
    (void)pthread_sigmask(SIG_SETMASK, &before, NULL);
    return is_begun;
}

/// For those who asked for a watch: without a socket or a thread there is none.
static void tell_unwatched(int32_t rank)
{
    if (getenv("CLAST_RANK_TIMEOUT") != NULL) { // NOLINT(concurrency-mt-unsafe)
        (void)fprintf(stderr,
                      "clast-mpi: rank %d has no socket or thread for the watch of "
                      "CLAST_RANK_TIMEOUT: should it hang, the job waits\n",
                      rank);
    }
}

bool cli_watch_begin(const char *command, const clast_comm *comm)
{
    meeting *m = &watch.meeting;
    bool is_fine = true;
    watch.command = command;
    watch.rank = comm->rank;
    watch.n_rank = comm->n_rank;
    (void)gethostname(watch.own.host, HOST - 1);
    if (comm->rank == 0) {
        is_fine = read_limit(&m->limit);
        m->limit = is_fine ? m->limit : -1.0;
        if (m->limit > 0.0 && comm->n_rank > 1 && !open_first(m)) {
            tell_unwatched(0);
            m->limit = 0.0;
        }
    }
    comm->broadcast(comm->context, 0, m, (int64_t)sizeof *m);
    if (m->limit < 0.0) {
        if (comm->rank == 0) {
            (void)fprintf(stderr, "clast-mpi: CLAST_RANK_TIMEOUT is a number of seconds from 1 to "
                                  "1e6, or 0: ranks that hang are waited for\n");
        }
        return false;
    }
    watch.own.nonce = m->nonce;
    watch.own.rank = comm->rank;
    watch.own.process = (int32_t)getpid();
    watch.other = calloc(comm->rank == 0 ? (size_t)comm->n_rank : 1, sizeof *watch.other);
    if (m->limit > 0.0 && comm->n_rank > 1 &&
        !(watch.other != NULL && (comm->rank == 0 || open_other(m)) && begin_thread())) {
        tell_unwatched(comm->rank);
    }
    return true;
}
